"""The rating of a gear on a rack: the limit of ever larger wheels, the section on the drawn teeth, Hertz's pressure.

Tolerances: a wheel of 1e7 teeth is off by some module over its radius, 1e-6, and by the rounding of its large radii,
1e-16 times 1e7; what is measured on the drawn outline 1e-9; closed forms 1e-12.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from factory import design

from gearlink.core.parts.gears.data import GearData
from gearlink.core.parts.gears.drawing_names import RATING
from gearlink.core.parts.gears.outline.rack_profile import RackGeometry

DATA: dict[str, Any] = {
    "kind": "gear-pair",
    "module": 2,
    "teeth": [23, "rack"],
    "profile_shift": [0.2, 0],
    "face_width": [30, 28],
    "load": {"torque": 80, "factors": {"application": 1.25, "face_contact": 1.2}},
    "material": {"contact_limit": [1400, 1100], "bending_limit": [430, 370]},
}
SHAPES: list[dict[str, Any]] = [
    {},
    {"helix_angle": 14},
    {"helix_angle": 25, "face_width": 60, "profile_shift": [-0.1, 0]},
    {"tool": {"addendum": 1.4, "rounding": 0.3}, "pressure_angle": 17.5, "addendum": 1.15},
    {"allowances": {"upper": [-0.06, -0.09], "lower": [-0.1, -0.13]}, "teeth": [60, "rack"], "load_share": "half"},
    {"rim_thickness": [None, 4.0], "accuracy_grade": 4, "edition": 2019},
    {"tip_shortening": [-0.05, -0.1], "pressure_angle": 25},
]


def gear(keys: dict[str, Any]) -> Any:
    return design(DATA | keys, command="gear")


def wheel(keys: dict[str, Any], teeth: int = 10**7) -> GearData:
    """A pair at its reference centre distance, its wheel of so many teeth and the gear's shift with the other sign."""
    given = DATA | keys
    first, shift = given["teeth"][0], given["profile_shift"][0]
    made: GearData = gear(keys | {"teeth": [first, 9999], "profile_shift": [shift, -shift]}).data
    return replace(made, pair=replace(made.pair, teeth=(first, teeth)))


@pytest.mark.parametrize("keys", SHAPES)
def test_the_rating_is_the_limit_of_large_wheels(keys: dict[str, Any]) -> None:
    made, limit = gear(keys), wheel(keys)
    compared = 0
    for name in sorted(RATING):
        one, other = made.data.quantity(name), limit.quantity(name)
        assert (one is None) == (other is None), name
        if one is not None:
            assert one == pytest.approx(other, rel=1e-5), name
            compared += 1
    assert compared > 15
    assert made.quantity("safety_bending").value[1] > 0.0


@pytest.mark.parametrize("keys", [each for each in SHAPES if "helix_angle" not in each])
def test_the_section_stands_where_a_tangent_of_30_deg_touches_the_drawn_teeth(keys: dict[str, Any]) -> None:
    """Thickness, lever and radius on the outline of the rack, as far up or down as allowances move its tool."""
    made = gear(keys)
    rack, m, alpha = made.rack, made.spec.module, made.gear_pair.pressure_angle
    bend, low, high = rack.profile.pieces()[1]
    points = bend(np.linspace(low, high, 40_001))
    between, ways = 0.5 * (points[1:] + points[:-1]), np.angle(np.diff(points))
    at = complex(np.interp(math.pi / 3.0, ways, between.real), np.interp(math.pi / 3.0, ways, between.imag))
    thinner, section = made.data.cut_shift[1] * m, made.data.root.sections[1]
    assert 2.0 * (rack.pitch_on_line / 2.0 - at.real) == pytest.approx(section.chord * m, rel=1e-7)
    mesh, path = RackGeometry(rack), rack.path
    contact = mesh.pitch_point + (path.end - mesh.base_pitch - path.pitch) * mesh.direction  # B
    height = rack.center_distance - contact.real
    half = 0.25 * math.pi * m - (height - thinner) * math.tan(alpha)
    crossing = height - half * abs(mesh.direction.real / mesh.direction.imag)  # of the push and the tooth's middle
    assert crossing - (at.imag + thinner) == pytest.approx(section.moment_arm * m, rel=1e-7)
    turned = (ways[-1] - ways[0]) / (ways.size - 1)
    assert float(np.abs(np.diff(points)).mean() / turned) == pytest.approx(section.fillet_radius * m, rel=1e-6)


@pytest.mark.parametrize("keys", [{}, {"helix_angle": 14}, {"load_share": "half"}])
def test_a_cylinder_is_pressed_on_a_plane(keys: dict[str, Any]) -> None:
    made = gear(keys)
    flank, path, pair = made.data.flank, made.rack.path, made.gear_pair
    line = flank.tangential_force / math.cos(pair.transverse_pressure_angle) / 28.0  # the common width
    softness = math.pi * sum(each.compliance for each in made.data.materials)
    at_pitch = math.sqrt(line * math.cos(pair.base_helix_angle) / (path.pitch * softness))
    factors = flank.contact_ratio_factor * flank.helix_angle_factor
    assert flank.nominal_stress / factors == pytest.approx(at_pitch, rel=1e-12)
    ratio = math.sqrt(path.pitch / (path.end - pair.base_pitch))
    inner = max(1.0, ratio - min(path.overlap_ratio, 1.0) * (ratio - 1.0))
    assert flank.single_contact_factor == (pytest.approx(inner, rel=1e-12), 1.0)
    table = made.table("path")
    places = {name: value for name, value in zip(table["place"], table["pressure"], strict=True) if name}
    assert places["C"] == pytest.approx(at_pitch, rel=1e-12)
    assert set(places) == {"A", "B-", "B+", "C", "D-", "D+", "E"}


def test_method_b_takes_the_worst_places_of_the_path() -> None:
    table, found = gear({}).table("path"), gear({}).quantity("nominal_root_stress").value
    for name, worst, place in (("root_stress", found[0], "D-"), ("root_stress_2", found[1], "B+")):
        assert max(value for value in table[name] if value is not None) == pytest.approx(worst, rel=1e-12)
        assert dict(zip(table["place"], table[name], strict=True))[place] == pytest.approx(worst, rel=1e-12)


def test_findings_name_the_rack_and_what_it_lacks() -> None:
    (_, weak) = gear({"load": {"torque": 600}}).check("bending")
    assert weak.status == "fail"
    assert weak.message.startswith("the rack: tooth root safety S_F")
    sharp = gear({"tool": [{"addendum": 1.25}, {"addendum": 1.25, "rounding": 0}]})
    steep = gear({"pressure_angle": 31, "addendum": 0.8})
    for made in (sharp, steep):
        assert made.quantity("safety_bending").value[1] is None
        (said,) = [check for check in made.check("bending") if "no root section" in check.message]
        assert said.status == "warn"
        assert said.message.startswith("no root stress of the rack: it has no root section as of ISO 6336-3")
        assert "a pressure angle of at most 30 deg" in said.fix
    thin = gear({"rim_thickness": [None, 1.5]}).check("bending")
    assert "no root stress of the rack: its rim is too thin" in thin[0].message
