"""Factors of the root stress that need more than the teeth: rims, deep teeth, load at the tip.

Tolerances: closed forms 1e-12; the rim factors meet 1 within what their rounded constants leave (4e-3).
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import pytest
from factory import design

from gearlink.core.parts.gears.rating.root_stress import RootSection, deep_tooth_factor, rim_factor

LOADED: dict[str, Any] = {
    "kind": "gear-pair",
    "module": 3,
    "teeth": [23, 61],
    "profile_shift": [0.3, 0.1],
    "face_width": 30,
    "load": {"torque": 200},
    "material": {"bending_limit": 430, "contact_limit": 1400},
}
RING = {"teeth": [21, -67], "profile_shift": [0.3, -0.3], "cutter": {"teeth": 25}}


def of(name: str, **keys: Any) -> Any:
    found = design(LOADED | keys, command="gear").quantity(name)
    return None if found is None else found.value


def test_a_thin_rim_raises_the_stress_by_its_factor() -> None:
    plain, thin = of("nominal_root_stress"), of("nominal_root_stress", rim_thickness=[5.0, None])
    first, second = of("rim_factor", rim_thickness=[5.0, None])
    height = of("tip_radius")[0] - of("root_radius")[0]
    assert (first, second) == (pytest.approx(1.6 * math.log(2.242 * height / 5.0), rel=1e-12), 1.0)
    assert thin == pytest.approx([plain[0] * first, plain[1]], rel=1e-12)
    assert of("root_stress", rim_thickness=5.0)[1] > of("root_stress")[1]
    assert of("rim_factor") is None
    made = design(LOADED | {"rim_thickness": [5.0, None]}, command="gear")
    table = made.table("path")
    assert max(table["root_stress"]) == pytest.approx(thin[0], rel=1e-9)


def test_the_rim_of_a_ring_counts_in_modules() -> None:
    assert of("rim_factor", **RING, rim_thickness=[None, 8.0])[1] == pytest.approx(
        1.15 * math.log(8.324 * 3 / 8.0), rel=1e-12
    )


def test_a_rim_that_is_left_out_is_rated_as_it_stands_in_the_machine() -> None:
    """Two modules, against which the shafts are checked: the root stress is not that of a solid ring."""
    left_out = design("drawn_ring", command="gear", gears__rim=None)
    root = left_out.quantity("root_radius").value[1]
    given = design("drawn_ring", command="gear", gears__rim=root + 2.0 * left_out.spec.gears.module)
    for name in ("rim_factor", "root_stress", "safety_bending"):
        assert left_out.quantity(name).value == pytest.approx(given.quantity(name).value, rel=1e-12), name
    assert left_out.quantity("rim_factor").value == pytest.approx([1.0, 1.15 * math.log(8.324 / 2.0)], rel=1e-12)
    thicker = design("drawn_ring", command="gear", gears__rim=None, gears__rim_thickness=[None, 8.0])
    assert thicker.quantity("rim_factor").value == [1.0, 1.0]


@pytest.mark.parametrize("keys", [{"rim_thickness": 2.0}, RING | {"rim_thickness": [None, 4.0]}])
def test_a_rim_too_thin_is_not_rated_and_said_so(keys: dict[str, Any]) -> None:
    made = design(LOADED | keys, command="gear")
    warned = [check for check in made.check("bending") if "rim" in check.message]
    assert [check.status for check in warned] == ["warn"] * len(warned) != []
    assert made.quantity("nominal_root_stress").value[1] is None if made.quantity("nominal_root_stress") else True
    assert made.quantity("safety_bending") is None or made.quantity("safety_bending").value[1] is None


@pytest.mark.parametrize(("ring", "start", "end"), [(False, 0.5, 1.2), (True, 1.75, 3.5)])
def test_rim_factors_fall_to_one_and_end_where_they_may_not_be_used(ring: bool, start: float, end: float) -> None:
    def factor(rim: float) -> Any:
        return rim_factor(rim, ring=ring)

    grid = [start + (end - start) * k / 50 for k in range(1, 51)]
    values = [factor(place) for place in grid]
    assert all(one >= other for one, other in pairwise(values[:-1]))
    assert values[-2] == pytest.approx(1.0, abs=0.04)
    assert factor(end - 1e-9) == pytest.approx(1.0, abs=4e-3)
    assert (factor(start), factor(end)) == (None, 1.0)


def test_deep_teeth_share_the_load_only_where_they_are_accurate() -> None:
    assert deep_tooth_factor(2.5, 4) == pytest.approx(0.701, abs=1e-12)  # as published
    assert [deep_tooth_factor(2.3, grade) for grade in (0, 4, 5, 12)] == [2.366 - 0.666 * 2.3] * 2 + [1.0] * 2
    deep = {"addendum": 1.2, "profile_shift": [0.0, 0.0], "teeth": [60, 80], "pressure_angle": 17.0}
    eps = of("contact_ratio", **deep)
    assert 2.05 < eps < 2.5
    assert of("deep_tooth_factor", **deep, accuracy_grade=4) == pytest.approx(2.366 - 0.666 * eps, rel=1e-12)
    assert of("deep_tooth_factor", **deep) is None
    plain, less = of("nominal_root_stress", **deep), of("nominal_root_stress", **deep, accuracy_grade=3)
    assert less[0] == pytest.approx(plain[0] * (2.366 - 0.666 * eps), rel=1e-12)


@pytest.mark.parametrize("keys", [{}, {"helix_angle": 14}, {"tool": {"addendum": 1.4, "rounding": 0.25}}])
def test_load_at_the_tip_bends_a_cantilever(keys: dict[str, Any]) -> None:
    """The lever from the geometry: the normal at the tip corner cut with the middle of the tooth, above the section."""
    made = design(LOADED | keys, command="gear")
    forms = made.quantity("tip_form_factor").value
    for gear in (0, 1):
        section: RootSection = made.data.root.at_tip[gear]
        z, alpha = section.virtual_teeth, made.gear_pair.pressure_angle
        base, tip = z / 2.0 * math.cos(alpha), section.tip_radius
        pressure = math.acos(base / tip)
        half = (math.pi / 2.0 + 2.0 * section.shift * math.tan(alpha)) / z
        half += (math.tan(alpha) - alpha) - (math.tan(pressure) - pressure)  # half the tooth's angle at its tip
        load = pressure - half  # the normal's angle to the straight across
        crossing = base / math.cos(load)
        height = crossing - (
            base / math.cos(made.data.root.sections[gear].load_angle) - made.data.root.sections[gear].moment_arm
        )
        assert section.moment_arm == pytest.approx(height, rel=1e-9)
        form = 6.0 * height * math.cos(load) / (section.chord**2 * math.cos(alpha))
        assert forms[gear] == pytest.approx(form, rel=1e-9)
        assert forms[gear] > made.quantity("form_factor").value[gear]
    eps = made.data.root.virtual_contact_ratio
    assert made.quantity("contact_ratio_factor_bending").value == pytest.approx(0.25 + 0.75 / eps, rel=1e-12)


def test_without_a_load_there_is_no_method_c() -> None:
    bare = {key: value for key, value in LOADED.items() if key != "load"}
    assert design(bare, command="gear").quantity("tip_form_factor") is None
