"""The corner of a gear's tip in the rounding of a rack, against drawn teeth that are turned in mesh."""

from __future__ import annotations

import math
import random

import numpy as np
import pytest

import gearlink
from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.outline.rack_profile import RackGeometry
from gearlink.core.parts.gears.rack import CornerInRack, RackData, RackMesh
from gearlink.core.parts.gears.tooth.tools import RackTool


def rolled(rack: RackMesh) -> float:
    """The minimum gap of the tip's corners to the rounding along the rack, of drawn teeth in many places [mm]."""
    pair, (own, height) = rack.pair, RackGeometry(rack).first_space
    curve, low, high = rack.profile.pieces()[1]
    rounding = curve(np.linspace(low, high, 4001))
    tip, least = pair.tip_radius[0], math.inf
    half_tooth = pair.tip_thickness[0] / pair.cos_helix_at(tip, 0) / tip / 2.0
    for sense in (1.0, -1.0):
        corner = own + math.pi / pair.teeth[0] + sense * half_tooth
        turn = np.linspace(-0.6, 0.6, 40001) - corner
        place = tip * np.exp(1j * (corner + turn))
        above = rack.center_distance - place.real
        along = place.imag - height - pair.reference_radius[0] * turn
        along = np.abs(along - rack.pitch_on_line * np.round(along / rack.pitch_on_line))
        within = (above >= rounding.imag[0]) & (above <= rounding.imag[-1])
        if within.any():
            gaps = np.interp(above[within], rounding.imag, rounding.real) - along[within]
            least = min(least, float(gaps.min()))
    return least


def random_rack(rng: random.Random) -> RackMesh:
    """A gear on a rack with little room at the root of the rack."""
    height, x = rng.uniform(0.5, 1.2), rng.uniform(-0.5, 0.8)
    tools = (
        RackTool(addendum=height + 0.25, rounding=0.2),
        RackTool(addendum=height + rng.uniform(0.05, 0.3), rounding=rng.uniform(0.0, 0.5)),
    )
    pair = GearPair(
        module=1.0,
        teeth=(rng.randint(10, 120), 10_000),
        pressure_angle=math.radians(rng.choice([10.0, 14.5, 20.0, 25.0])),
        helix_angle=math.radians(rng.choice([0.0, 0.0, 20.0])),
        given_shift=(x, -x),
        addendum=height,
        tools=tools,
        tip=(rng.uniform(-0.2, 0.1), 0.0),
    )
    return RackMesh(RackData(pair=pair))


@pytest.mark.parametrize("count", [20, pytest.param(600, marks=pytest.mark.slow)])
def test_the_least_gap_is_that_of_drawn_teeth_turned_in_mesh(count: int) -> None:
    """1e-6 mm: what 4001 points of a rounding and 40001 places leave of a module of 1 mm."""
    rng, compared, cut = random.Random(5), 0, 0
    while compared < count:
        try:
            rack = random_rack(rng)
            on_flank = rack.pair.tip_thickness[0] > 0.0 and rack.form_depth >= rack.end_depth
            corner = CornerInRack(rack.pair, rack.center_distance, rack.end_depth)
            if not on_flank or not 0.0 < rack.tip_clearance[0] < 0.25 or corner.deepest <= rack.form_depth:
                continue
            near, drawn = corner.least.gap, rolled(rack)
        except NoSolution:
            continue
        compared += 1
        assert (near < -1e-4) == (drawn < -1e-4), rack
        if near < -1e-4:
            assert drawn == pytest.approx(near, abs=1e-6), rack
            cut += 1
    assert cut > count // 20


def test_a_corner_in_the_rounding_of_a_rack_fails() -> None:
    """A tool with a smaller rounding leaves the corner its way."""
    given = {"kind": "gear-pair", "module": 2, "teeth": [80, "rack"], "profile_shift": [0, 0], "pressure_angle": 10}
    tools = [{"addendum": 1.25, "rounding": 0.2}, {"addendum": 1.15, "rounding": 0.4}]
    *_, found = gearlink.design(**given, tool=tools).check("fillet-interference")
    assert found.status == "fail"
    assert found.value == pytest.approx(-0.01742, abs=5e-6)
    assert "at 1.95 mm below the datum line" in found.message
    tools[1]["rounding"] = 0.3
    *_, less = gearlink.design(**given, tool=tools).check("fillet-interference")
    assert less.status == "pass"
