"""Designs of a study whose class seeks extremes for many at once: what each by itself has, but for rounding.

Tolerance: 1e-12 of a value, for extremes that are refined to rounding in other arrays.
"""

from __future__ import annotations

from typing import Any

import pytest
from factory import worked
from sweeps import spread

from gearlink.core.base.design import Design
from gearlink.core.base.report import Check
from gearlink.core.machines.cylindrical_cam import CylindricalCamDesign
from gearlink.core.studies.explore.base import Base, _is_next_to_its_limit, single, singles

NAMES = ("max_pressure_angle", "min_curvature_radius")


def changes(count: int) -> list[list[tuple[str, Any]]]:
    return [[("cam.radius", 60.0 + i)] for i in range(count)]


def test_designs_of_a_study_are_those_of_each_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    sizes, together = [], CylindricalCamDesign.find_together.__func__  # type: ignore[attr-defined]

    def find_together(cls: type[Design], designs: Any, names: Any) -> None:
        sizes.append(len(designs))
        together(cls, designs, names)

    monkeypatch.setattr(CylindricalCamDesign, "find_together", classmethod(find_together))
    monkeypatch.setattr(CylindricalCamDesign, "at_once", 10)
    asked = [*changes(12), [("cam.radius", -1.0)], [("speed", 91.0)]]
    base = Base(worked("barrel_cam"), "cam")
    many = singles(base, asked, NAMES, list(base.codes))
    assert sizes == [10, 3]
    assert [one.refused for one in many] == [*[""] * 12, "cam.radius", ""]
    for one, each in [*spread(zip(many, asked, strict=True), 2), *zip(many[-2:], asked[-2:], strict=True)]:
        other = single(Base(worked("barrel_cam"), "cam"), each, NAMES, list(base.codes))
        assert one.refused == other.refused
        assert one.values == pytest.approx(other.values, rel=1e-12)
        assert [(found.code, found.status) for found in one.findings] == [
            (found.code, found.status) for found in other.findings
        ]


def test_designs_that_seek_nothing_together_keep_for_the_next(monkeypatch: pytest.MonkeyPatch) -> None:
    order = []
    monkeypatch.setattr(
        Base, "design", lambda self, changes, make=Base.design: order.append("made") or make(self, changes)
    )
    monkeypatch.setattr(Base, "values", lambda self, *asked, of=Base.values: order.append("asked") or of(self, *asked))
    singles(Base(worked("geneva_drive"), "analyze"), [[("input_speed", 60.0)]] * 2, (), ())
    assert order == ["made", "asked"] * 2


def test_a_design_next_to_a_limit_is_judged_by_itself(monkeypatch: pytest.MonkeyPatch) -> None:
    alone = single(Base(worked("barrel_cam"), "cam"), [("cam.radius", 70.0)], NAMES, ())
    data = worked("barrel_cam")
    data["limits"] = {**data.get("limits", {}), "pressure_angle": alone.values["max_pressure_angle"]}
    made, design = [], Base.design

    def counted(self: Base, changes: Any = ()) -> Design:
        made.append(dict(changes))
        return design(self, changes)

    monkeypatch.setattr(Base, "design", counted)
    base = Base(data, "cam")
    many = singles(base, changes(12), NAMES, list(base.codes))
    assert made[12:] == [{"cam.radius": 70.0}]
    assert many[10].values == alone.values


def test_a_design_far_from_a_limit_that_is_all_but_0_is_judged_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """The power identity of 1e-15 lay within 1e-9 of its limit, 1e-9: each design of a study was computed twice."""
    made, design = [], Base.design

    def counted(self: Base, changes: Any = ()) -> Design:
        made.append(dict(changes))
        return design(self, changes)

    monkeypatch.setattr(Base, "design", counted)
    asked = [[("loads.roller.width", 20.0 + i)] for i in (1, 2)]
    many = singles(Base(worked("loaded_oscillating_cam"), "loads"), asked, (), ["GL601"])
    assert [found.code for one in many for found in one.findings] == ["GL601"] * 2
    assert made == [dict(each) for each in asked]


@pytest.mark.parametrize(
    ("value", "limit", "near"),
    [
        (0.0, 1e-9, False),
        (1e-9, 1e-9, True),
        (1e-12, 0.0, True),
        (1e-6, 0.0, False),
        (40.0 + 1e-8, 40.0, True),
        (40.001, 40.0, False),
    ],
)
def test_what_is_next_to_a_limit(value: float, limit: float, near: bool) -> None:
    """By 1e-9 of the larger of both, next to 0 of the unit."""
    assert _is_next_to_its_limit(Check("GL1", "c", "pass", "w", value, limit)) is near


def test_measured_cams_of_other_profiles_keep_their_own() -> None:
    """A measured point that varies gives each design a profile of its own, a follower beside it none to share."""
    base = Base(worked("measured_cam"), "analyze")
    radius = base.data["profile"]["points"][40][1]
    asked = [[("profile.points[40][1]", radius + 0.01 * i), ("follower.direction", 90.0 + 0.01 * i)] for i in range(9)]
    names = ("min_curvature_radius", "max_pressure_angle", "fit_max")
    many = [one.values for one in singles(base, asked, names, ())]
    alone = [single(base, each, names, ()).values for each in asked]
    assert many == [pytest.approx(each, rel=1e-12) for each in alone]
    assert len({round(each["fit_max"], 6) for each in many}) == len(asked)
