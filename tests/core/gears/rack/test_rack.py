"""A gear on a rack: teeth that roll on each other, sliding from velocities, backlash from strings, the rack's outline.

Tolerances: outlines are chords, within 1e-4 mm; closed forms 1e-12 relative.
"""

from __future__ import annotations

import cmath
import math
from typing import Any

import numpy as np
import pytest
from factory import design
from matplotlib.path import Path

from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.gears.measures.allowances import Backlash
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.outline.rack_profile import RackGeometry, RackProfile
from gearlink.core.parts.gears.outline.tooth_profile import ToothProfile, outline
from gearlink.core.parts.gears.tooth.tools import RackTool

CHORD = 1e-4
DATA = {"kind": "gear-pair", "module": 2, "teeth": [20, "rack"]}
SHAPES: list[dict[str, Any]] = [
    {"profile_shift": [0.0, 0]},
    {"profile_shift": [0.4, 0]},
    {"profile_shift": [0.1, 0], "helix_angle": 20},
    {"profile_shift": [-0.05, 0], "teeth": [35, "rack"], "tool": {"addendum": 1.4, "rounding": 0.3}},
    {"profile_shift": [0.2, 0], "teeth": [40, "rack"], "tip_shortening": [-0.1, -0.2]},
]


def gear(keys: dict[str, Any]) -> Any:
    return design(DATA | keys, command="gear")


def to_line(points: Any, line: Any) -> Any:
    """Distance of each point from a line of chords."""
    start, way = line[:-1], np.diff(line)
    keep = np.abs(way) > 0.0
    start, way = start[keep], way[keep]
    apart = np.atleast_1d(points)[:, None] - start
    along = np.clip((apart * way.conj()).real / np.abs(way) ** 2, 0.0, 1.0)
    return np.min(np.abs(apart - along * way), axis=1)


def placed(made: Any, travel: float) -> tuple[Any, Any]:
    """Outlines of some teeth of both after the rack went so far up."""
    mesh = RackGeometry(made.rack)
    pair = made.rack.pair
    pitch = 2.0 * math.pi / pair.teeth[0]
    teeth = outline(ToothProfile.of(pair, 0), CHORD, 9, mesh.first_space[0] - 4.0 * pitch)
    rack = 1j * made.rack.profile.body(CHORD, 11, 4.0) + made.rack.center_distance
    return teeth * cmath.exp(1j * travel / pair.reference_radius[0]), rack + 1j * (mesh.first_space[1] + travel)


@pytest.mark.quick(2)
@pytest.mark.parametrize("keys", SHAPES)
def test_teeth_touch_where_the_line_of_action_says_and_never_cross(keys: dict[str, Any]) -> None:
    made = gear(keys)
    mesh = RackGeometry(made.rack)
    for share in (0.0, 0.21, -0.37):
        teeth, rack = placed(made, share * mesh.rack.pitch_on_line)
        moved = share * mesh.rack.pitch_on_line * math.cos(mesh.rack.working_pressure_angle)
        touching = np.array([point + moved * mesh.direction for point in mesh.contacts])
        path = mesh.rack.path
        places = ((touching - mesh.pitch_point) / mesh.direction).real + path.pitch
        on_path = touching[(path.start < places) & (places < path.end)]
        assert on_path.size
        assert to_line(on_path, teeth).max() < 3.0 * CHORD
        assert to_line(on_path, rack).max() < 3.0 * CHORD
        inside = teeth[
            Path(np.column_stack([rack.real, rack.imag])).contains_points(np.column_stack([teeth.real, teeth.imag]))
        ]
        assert to_line(inside, rack).max(initial=0.0) < 3.0 * CHORD


def test_a_shifted_rack_would_cut_into_the_teeth() -> None:
    """The test above can fail: a rack that stands 0.05 mm too near is found inside."""
    teeth, rack = placed(gear(SHAPES[1]), 0.0)
    rack = rack - 0.05
    inside = teeth[
        Path(np.column_stack([rack.real, rack.imag])).contains_points(np.column_stack([teeth.real, teeth.imag]))
    ]
    assert to_line(inside, rack).max() > 0.01


@pytest.mark.parametrize("keys", SHAPES)
def test_sliding_is_that_of_the_bodies_velocities(keys: dict[str, Any]) -> None:
    """zeta = 1 - speed of the mating gear over that of the gear, both along the flank at the contact."""
    rack = gear(keys).rack
    mesh, r = RackGeometry(rack), rack.pair.reference_radius[0]
    along = mesh.direction * 1j
    table = gear(keys).table("path", samples=16)
    for rho, one, other in zip(table["rho"], table["sliding"], table["sliding_2"], strict=True):
        contact = mesh.pitch_point + (rho - rack.path.pitch) * mesh.direction
        speed = ((1j * contact) * along.conjugate()).real  # of the gear at 1 rad/s
        mate = ((1j * r) * along.conjugate()).real
        assert one == pytest.approx(1.0 - mate / speed, rel=1e-9, abs=1e-12)
        assert other == pytest.approx(1.0 - speed / mate, rel=1e-9, abs=1e-12)
    assert rack.contact_ratio == pytest.approx(abs(mesh.contact_end - mesh.contact_start) / mesh.base_pitch, rel=1e-12)
    assert table["place"][0] == "A"
    assert abs(mesh.contact_end) == pytest.approx(rack.pair.tip_radius[0], rel=1e-12)
    tip_line = rack.center_distance - rack.path.height * rack.pair.module
    assert mesh.contact_start.real == pytest.approx(tip_line, rel=1e-12)


@pytest.mark.parametrize("beta", [0.0, 18.0])
def test_backlash_is_the_limit_of_large_wheels(beta: float) -> None:
    keys = {"helix_angle": beta, "profile_shift": [0.2, 0], "center_distance_allowance": 0.04}
    made = gear(keys | {"allowances": {"upper": [-0.05, -0.06], "lower": [-0.1, -0.13]}})
    wheel = GearPair(module=2.0, teeth=(20, 10**6), helix_angle=math.radians(beta), given_shift=(0.2, -0.2))
    limit = Backlash(pair=wheel, upper=(-0.05, -0.06), lower=(-0.1, -0.13), distance_allowance=0.04)
    assert made.quantity("backlash_circumferential").value == pytest.approx(limit.circumferential, rel=1e-4)
    assert made.quantity("backlash_normal").value == pytest.approx(limit.normal, rel=1e-4)
    angles = made.quantity("backlash_angle").value
    assert angles[0] == pytest.approx([math.degrees(angle) for angle in limit.angle[0]], rel=1e-4)
    assert angles[1] is None
    assert [check.status for check in made.check("backlash")] == ["pass"]
    tight = gear(keys | {"allowances": {"upper": [0.05, 0.06], "lower": [0.0, 0.0]}})
    assert [check.status for check in tight.check("backlash")] == ["fail"]


def test_tooth_and_space_are_equal_on_the_datum_line() -> None:
    profile = RackProfile(module=3.0, tool=RackTool(), helix_angle=math.radians(25.0))
    flank = profile.half_tooth(1e-5)
    crossing = np.interp(0.0, flank.imag[-3:-1], flank.real[-3:-1])
    assert crossing == pytest.approx(profile.pitch / 4.0, rel=1e-12)
    assert np.all(np.diff(flank.real) >= 0.0)


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"height": 2.3}, "the teeth of the rack are pointed"),
        ({"tool": RackTool(residual_undercut=0.05)}, "protuberance"),
        ({"height": -1.3}, "no flank"),
    ],
)
def test_racks_that_cannot_be(keys: dict[str, Any], words: str) -> None:
    with pytest.raises(NoSolution, match=words):
        RackProfile(**({"module": 2.0, "tool": RackTool()} | keys))


def test_a_datum_line_far_from_the_gear_is_refused() -> None:
    data = {key: value for key, value in DATA.items() if key != "profile_shift"}
    assert design(data | {"center_distance": 29.9}).quantity("profile_shift").value[0] == pytest.approx(4.95, rel=1e-12)
    for distance in (30.1, 9.9, 1e300):
        with pytest.raises(NoSolution, match="10 to 30 mm from the axis"):
            _ = design(data | {"center_distance": distance}).gear_pair


def test_tips_and_roots_of_the_rack_are_judged() -> None:
    thin = gear({"profile_shift": [0.0, 0], "tip_shortening": [0.0, 0.9]})
    (_, rack) = thin.check("tip-thickness")
    assert (rack.status, round(rack.value, 9)) == ("fail", round(math.pi / 2 - 3.8 * math.tan(math.radians(20)), 9))
    deep = gear({"profile_shift": [0.6, 0], "tip_shortening": [0.1, 0.0]})
    (_, root) = deep.check("fillet-interference")
    assert root.status == "pass"
    mesh = RackGeometry(deep.rack)
    depth = mesh.contact_end.real - deep.rack.center_distance
    assert root.value == pytest.approx(deep.rack.form_depth - depth, abs=1e-12)
    through = gear({"profile_shift": [0.6, 0], "tip_shortening": [0.3, 0.0]})  # its corner goes through the root line
    (_, root) = through.check("fillet-interference")
    assert root.status == through.check("root-clearance")[1].status == "fail"
    assert RackGeometry(through.rack).contact_end.real - through.rack.center_distance < through.rack.form_depth
