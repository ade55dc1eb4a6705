"""The corner of a tip in its mating gear's fillet, against drawn teeth that are turned in mesh."""

from __future__ import annotations

import cmath
import math
import random
import re
from typing import Any

import numpy as np
import pytest
from sweeps import ALL

import gearlink
from gearlink.core.base.errors import NoSolution
from gearlink.core.numerics.arrays import Points
from gearlink.core.parts.gears.mesh.contact import PathOfContact
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.mesh.pair_sweep import GearPairs, TipCorners
from gearlink.core.parts.gears.mesh.tip_corner import TipCorner
from gearlink.core.parts.gears.outline.mesh_geometry import MeshGeometry
from gearlink.core.parts.gears.outline.ring_profile import RingProfile
from gearlink.core.parts.gears.outline.tooth_profile import ToothProfile
from gearlink.core.parts.gears.tooth.tools import PinionCutter, RackTool

EXTERNAL = {"module": 1, "pressure_angle": 10, "teeth": [32, 63], "profile_shift": [0.587, 0.427]}
RING = {
    "module": 1,
    "pressure_angle": 14.5,
    "helix_angle": 20,
    "teeth": [47, -155],
    "profile_shift": [0.602, -0.594],
    "addendum": 0.572,
    "tool": {"addendum": 0.94, "rounding": 0.139},
    "cutter": {"teeth": 48, "shift": 0.128, "addendum": 0.681, "rounding": 0.3},
}


def drawn_fillet(pair: GearPair, gear: int) -> Points:
    """Points of a fillet, the x axis in the middle of a space, on the side of growing polar angles."""
    if pair.teeth[gear] < 0:
        curve, low, high = next(piece[1:] for piece in RingProfile(pair).pieces() if piece[0] == "fillet")
        return curve(np.linspace(low, high, 4001))
    curve, low, high = ToothProfile.of(pair, gear).pieces()[1]
    return curve(np.linspace(low, high, 4001))


def rolled(pair: GearPair, gear: int) -> float:
    """The minimum gap of the mating gear's corners to a fillet along circles, of drawn teeth in many places [mm]."""
    mate, mesh = 1 - gear, MeshGeometry(pair)
    first = list(mesh.first_space)
    if pair.internal:  # of a ring the middle of a tooth is told
        first[1] += math.pi / -pair.teeth[1]
    fillet = drawn_fillet(pair, gear)
    outwards = np.argsort(np.abs(fillet))
    radii, beside = np.abs(fillet)[outwards], np.angle(fillet)[outwards]
    tip, z = abs(pair.tip_radius[mate]), abs(pair.teeth[mate])
    half_tooth = abs(pair.tip_thickness[mate] / pair.cos_helix_at(pair.tip_radius[mate], mate)) / tip / 2.0
    to_gear = cmath.phase(mesh.axes[gear] - mesh.axes[mate]) if not pair.internal else 0.0
    least = math.inf
    for sense in (1.0, -1.0):
        corner = first[mate] + math.pi / z + sense * half_tooth
        turn = np.linspace(-0.5, 0.5, 40001) + to_gear - corner
        of_gear = -turn * pair.teeth[mate] / pair.teeth[gear]
        place = mesh.axes[mate] + tip * np.exp(1j * (corner + turn)) - mesh.axes[gear]
        angle = np.angle(place) - first[gear] - of_gear
        pitch = 2.0 * math.pi / abs(pair.teeth[gear])
        angle = np.abs(angle - pitch * np.round(angle / pitch))
        radius = np.abs(place)
        within = (radius >= radii[0]) & (radius <= radii[-1])
        if within.any():
            gaps = (np.interp(radius[within], radii, beside) - angle[within]) * radius[within]
            least = min(least, float(gaps.min()))
    return least


def random_pair(rng: random.Random) -> GearPair:
    """A pair as a drawing may ask for it, often with little room at its roots."""
    alpha, beta = rng.choice([10.0, 14.5, 20.0, 20.0, 25.0]), rng.choice([0.0, 0.0, 15.0, 30.0])
    ring, height = rng.random() < 0.4, rng.uniform(0.5, 1.2)
    z = rng.randint(12, 70)
    cutter = PinionCutter(
        teeth=rng.randint(12, 25), shift=rng.uniform(-0.2, 0.3), addendum=height + rng.uniform(0.05, 0.3),
        rounding=rng.uniform(0.05, 0.4),
    )  # fmt: skip
    tools = [
        RackTool(
            addendum=height + rng.uniform(0.05, 0.4),
            rounding=rng.uniform(0.0, 0.45),
            residual_undercut=rng.choice([0.0, 0.0, 0.05]),
        )
        for _ in (0, 1)
    ]
    x = rng.uniform(-0.6, 1.0)
    return GearPair(
        module=1.0,
        teeth=(z, -z - rng.randint(15, 110) if ring else rng.randint(12, 200)),
        pressure_angle=math.radians(alpha),
        helix_angle=math.radians(beta),
        given_shift=(x, rng.uniform(-0.2, 0.2) - x if ring else rng.uniform(-0.6, 1.0)),
        addendum=height,
        tools=(tools[0], None if ring else tools[1]),
        cutter=cutter if ring else None,
        tip=(rng.uniform(-0.2, 0.05), rng.uniform(-0.2, 0.05)),
    )


@pytest.mark.slow
@pytest.mark.parametrize("count", [60, pytest.param(600, marks=pytest.mark.slow)])
def test_the_least_gap_is_that_of_drawn_teeth_turned_in_mesh(count: int) -> None:
    """1e-6 mm: what 4001 points of a fillet and 40001 places leave of a module of 1 mm."""
    rng, compared, cut = random.Random(7), 0, [0, 0]
    while compared < count:
        try:
            pair = random_pair(rng)
            path = PathOfContact(pair)
            if min(pair.tip_thickness) < 0.0 or pair.contact_ratio < 0.5:
                continue
            for gear in (0, 1):
                form, used = pair.form_radius[gear], path.used_root_radius[gear]
                corner = TipCorner(pair, gear)
                if form is None or pair.interference_margin[1 - gear] <= 0.0 or pair.signs[gear] * (used - form) < 0.0:
                    continue
                if not corner.comes_near or not 0.0 < pair.tip_clearance[1 - gear] < 0.2:
                    continue
                near, drawn = corner.least.gap, rolled(pair, gear)
                compared += 1
                assert (near < -1e-4) == (drawn < -1e-4), (pair, gear)
                if not pair.internal and corner.stays_in_tool:
                    assert near > -1e-12, (pair, gear)
                if near < -1e-4:
                    assert drawn == pytest.approx(near, abs=1e-6), (pair, gear)
                    cut[pair.teeth[gear] < 0] += 1
        except NoSolution:
            continue
    assert min(cut) > 0, cut


@pytest.mark.parametrize(
    ("given", "gear", "status", "gap", "radius"),
    [
        ({**EXTERNAL, "tip_shortening": "none"}, 1, "warn", -0.00878, 15.418),
        ({**EXTERNAL, "tip_shortening": "none", "tool": {"rounding": 0.25}}, 1, "pass", None, None),
        (RING, 2, "fail", -0.00325, 83.611),
    ],
)
def test_a_corner_in_a_fillet_is_found(given: dict[str, Any], gear: int, status: str, gap: Any, radius: Any) -> None:
    """Found by rolling cut teeth; contact itself begins on the involute in all of them."""
    design = gearlink.design(kind="gear-pair", **given)
    found = design.check("fillet-interference")[gear - 1]
    assert found.status == status
    if gap is not None:
        assert found.value == pytest.approx(gap, abs=5e-6)
        told = re.search(rf"into the root fillet of gear {gear}: .* at radius ([0-9.]+) mm", found.message)
        assert told
        assert float(told[1]) == pytest.approx(radius, abs=3e-3)


def test_many_pairs_are_left_to_the_class_where_a_corner_may_cut() -> None:
    """None that cuts is missed, and few others are looked at again."""
    rng = np.random.default_rng(3)
    count = 400 if ALL else 160
    shifts, angle = rng.uniform(-0.1, 1.0, (2, count)), np.radians(rng.uniform(10.0, 25.0, count))
    clearance, teeth = rng.uniform(0.1, 0.3, count), rng.integers(20, 80, (2, count)).astype(float)
    many = GearPairs(
        module=1.0,
        teeth=(teeth[0], teeth[1]),
        pressure_angle=angle,
        given_shift=(shifts[0], shifts[1]),
        clearance=clearance,
        tip="none",
    )
    told = TipCorners(many, 0).may_cut(np.ones(count, dtype=bool))
    gaps = TipCorners(many, 0).least_gaps(np.ones(count, dtype=bool))
    cuts, in_tool = np.zeros(count, dtype=bool), 0
    for k in range(count):
        one = GearPair(
            module=1.0,
            teeth=(int(teeth[0, k]), int(teeth[1, k])),
            pressure_angle=float(angle[k]),
            given_shift=(float(shifts[0, k]), float(shifts[1, k])),
            clearance=float(clearance[k]),
            tip="none",
        )
        single = TipCorner(one, 0)
        cuts[k] = single.comes_near and single.least.gap < -1e-4
        if single.comes_near and single.stays_in_tool:
            in_tool += 1
            assert not cuts[k]
        if cuts[k]:
            assert gaps[k] == pytest.approx(single.least.gap, abs=1e-12)
    assert count // 40 < cuts.sum() <= (told & cuts).sum()
    assert told.sum() < 2 * cuts.sum() + 40
    assert in_tool > count // 4
