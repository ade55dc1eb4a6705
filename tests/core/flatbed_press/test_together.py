"""Presses whose cams are sought together have what each finds by itself.

Tolerance: 1e-12 of a value, for extremes that are refined to rounding; their places to the root of that.
"""

from __future__ import annotations

from typing import Any

import factory
import pytest
from sweeps import spread

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.spec_paths import number_at
from gearlink.core.machines.flatbed_press.design import FlatbedPress
from gearlink.core.parts.cams.disc_cam import FOUND_TOGETHER
from gearlink.core.studies.explore.base import Base, single, singles

CAMS = {"as printed": {}, "arc": {"transition": "arc", "lead_in": 0.0}, "parabola": {"transition": "parabola"},
        "led in": {"transition": "quartic", "lead_in": 20.0, "return_law": "cycloidal"}}  # fmt: skip
VARIED = {
    "bed": ("bed.double_crank.rocker", "bed.stroke", "bed.rod", "bed.offset"),
    "cylinder": ("cylinder.double_crank.crank", "cylinder.double_crank.coupler"),
    "cam": ("cam.base_radius", "cam.roller_radius", "cam.return_angle"),
}


def _base(cam: str, command: str = "cam") -> Base:
    data: dict[str, Any] = factory.worked("ty460")
    data["cam"] = data["cam"] | CAMS[cam]
    return Base({key: value for key, value in data.items() if key not in ("tolerance", "register")}, command)


def _rows(base: Base, varied: tuple[str, ...], by: float = 1e-4) -> list[list[tuple[str, Any]]]:
    values = {key: float(number_at(base.spec(), key)) for key in varied}  # type: ignore[arg-type]
    return [[(key, value * (1.0 + by * ((i * (k + 2)) % 9))) for k, (key, value) in enumerate(values.items())]
            for i in range(9)]  # fmt: skip


@pytest.mark.quick(1)
@pytest.mark.parametrize(("cam", "part"), [("as printed", "bed"), ("led in", "bed"), ("arc", "cylinder"),
                                           ("parabola", "cam"), ("led in", "cylinder"), ("arc", "bed")])  # fmt: skip
def test_presses_of_a_study_are_those_of_each_alone(cam: str, part: str) -> None:
    base = _base(cam)
    names, codes, rows = list(base.design().outline("cam").quantities), list(base.codes), _rows(base, VARIED[part])
    for row, many in spread(zip(rows, singles(base, rows, names, codes), strict=True), 2):
        alone = single(base, row, names, codes)
        assert alone.refused == many.refused == ""
        for each, value in alone.values.items():
            exact = {"abs": 2e-5} if each.endswith("_at") else {"rel": 1e-12, "abs": 1e-12}
            assert many.values[each] == pytest.approx(value, **exact), each  # type: ignore[arg-type]
        shown = [[(c.code, c.status, c.what) for c in one.findings] for one in (alone, many)]
        assert shown[0] == shown[1]


def test_no_press_of_a_study_is_computed_twice(monkeypatch: pytest.MonkeyPatch) -> None:
    """The register's value, 0, is next to its limit, 1e-9; no cam that was found among others moves it."""
    base = _base("as printed", "press")
    made, make = [0], Base.design

    def counted(self: Base, changes: Any = ()) -> Any:
        made[0] += 1
        return make(self, changes)

    monkeypatch.setattr(Base, "design", counted)
    rows = _rows(base, VARIED["bed"])
    found = singles(base, rows, ["min_transmission_angle_bed"], list(base.codes))
    assert made[0] == len(found) == len(rows)
    assert any(check.name == "register" and check.value == 0.0 for each in found for check in each.findings)


@pytest.mark.parametrize("name", sorted(FlatbedPress.alone))
def test_checks_that_judge_no_cam_need_none(name: str) -> None:
    with_cams, without = (factory.design("ty460", command="press") for _ in range(2))
    vars(without)["cams"] = None  # asked of anything, it raises
    assert without.check(name) == with_cams.check(name)


def test_all_cams_are_found_together() -> None:
    base = _base("as printed", "analyze")
    designs: list[Any] = [base.design(row) for row in _rows(base, VARIED["bed"])]
    stuck = base.design([("cam.return_angle", 359.0)])
    with pytest.raises(NoSolution):
        stuck.raw("follower_stroke")
    FlatbedPress.find_together([*designs, stuck], ["pressure-angle"])
    for design in designs:
        assert "lift_range" in vars(design.cams.follower)
        assert all(set(FOUND_TOGETHER) <= set(vars(disc)) for disc in design.cams.discs)
    assert len({design.cams.main_cam.max_pressure_angle.value for design in designs}) == 9
