"""Grippers whose searches run together have what each finds by itself.

Tolerance: 1e-12 of a value, for extremes that are refined to rounding over other samples; their places to the root of
that.
"""

from __future__ import annotations

import random
from typing import Any

import factory
import pytest
from sweeps import spread

from gearlink.core.base.errors import NoSolution
from gearlink.core.studies.explore.base import Base, single, singles

LINKS = {"links.input": 4.0, "links.coupler": 6.0, "links.output": 3.0, "output_direction": 4.0, "pivots.input[0]": 3.0}
CAMS = {"cam.roller.arm": 8.0, "cam.roller.angle": 4.0, "cam.return_roller.angle": 4.0, "cam.center[0]": 5.0}
LAW = {"phases.accelerate": 6.0, "phases.return": 6.0, "arm.length": 8.0, "cylinder.radius": 3.0}
REST = {"spring.torque": 50.0, "inertia.input": 0.03, "cam.roller.radius": 3.0, "speed": 500.0}
CHANGES = {"links": LINKS, "cams": CAMS, "law": LAW, "rest": REST, "all": {**LINKS, **CAMS, **LAW, **REST}}
PLACES = ("_at", "_angle")


def _base(name: str = "swing_gripper_stop", *, warnings: bool = True) -> Base:
    return Base(factory.worked(name), "analyze", warnings)


def _rows(base: Base, widths: dict[str, float], count: int) -> list[list[tuple[str, Any]]]:
    own, rows = random.Random(7), []
    for _ in range(count):
        rows.append([(path, _value(base.data, path) + own.uniform(-by, by)) for path, by in widths.items()])
    return rows


def _value(data: Any, path: str) -> float:
    for key in path.replace("]", "").replace("[", ".").split("."):
        data = data[int(key)] if key.isdecimal() else data[key]
    return float(data)


def _compare(one: Any, other: Any) -> None:
    assert one.refused == other.refused
    assert one.what == other.what
    for name, value in one.values.items():
        exact = {"abs": 2e-5} if name.partition("[")[0].endswith(PLACES) else {"rel": 1e-12, "abs": 1e-12}
        assert other.values[name] == (value if value is None else pytest.approx(value, **exact)), name  # type: ignore[arg-type]
    assert [(c.code, c.status, c.what) for c in one.findings] == [(c.code, c.status, c.what) for c in other.findings]


def _names(base: Base) -> list[str]:
    return [name for name in base.design().outline("analyze").quantities if base.design().raw(name) is not None]


@pytest.mark.quick(1)
@pytest.mark.parametrize("varied", ["all", "cams", "links", "law", "rest"])
def test_designs_of_a_study_are_those_of_each_alone(varied: str) -> None:
    base, alone = _base(), _base()
    names, codes = _names(base), list(base.codes)
    rows = _rows(base, CHANGES[varied], 8)
    for row, other in spread(zip(rows, singles(base, rows, names, codes), strict=True), 1):
        _compare(single(alone, row, names, codes), other)


def test_all_that_is_searched_for_is_found_together() -> None:
    base = _base()
    designs: list[Any] = [base.design(row) for row in _rows(base, CHANGES["all"], 8)]
    checks = ["conditioning", "cam-undercut", "shaft-clearance", "lift-off"]
    checks += ["velocity-step", "pressure-angle"]
    type(designs[0]).find_together(designs, ["input_velocity_max", "newton_agreement", "max_radius[0]", *checks])
    for design in designs:
        assert "peaks" in vars(design.motion.law)
        assert {"steepest_accelerating", "beside_coupler"} <= {*vars(design.cams), *vars(design)}
        assert {"max_pressure_angle", "most_convex", "least_support"} <= set(vars(design.fingers.cylinder_cam))
        assert "least_transmission" in vars(design.motion.linkage)
        assert {"rates", "newton_agreement", "rough_agreement"} <= set(vars(design.motion))
        assert {"outward", "worst_unloading"} <= set(vars(design.closure))
        for cam in design.cams.discs:
            assert {"max_pressure_angle", "most_convex", "max_radius", "min_radius", "least_support"} <= set(vars(cam))


def test_what_only_warns_is_left_out_where_nobody_asks() -> None:
    base = _base(warnings=False)
    designs: list[Any] = [base.design(row) for row in _rows(base, CHANGES["all"], 8)]
    type(designs[0]).find_together(designs, ["shaft-clearance", "pressure-angle"])
    for design in designs:
        assert "max_pressure_angle" in vars(design.cams.main_cam)
        assert {"max_radius", "least_support"}.isdisjoint(vars(design.cams.main_cam))
        assert {"steepest_accelerating", "beside_coupler"}.isdisjoint({*vars(design.cams), *vars(design)})


def test_designs_of_one_motion_share_it() -> None:
    base = _base()
    first, second = (base.design([("cam.roller.arm", arm)]) for arm in (160.0, 165.0))
    third, fourth = (base.design([("links.input", length)]) for length in (151.0, 152.0))
    assert first.motion is second.motion  # type: ignore[attr-defined]
    assert third.motion is not fourth.motion  # type: ignore[attr-defined]
    assert third.motion.law is fourth.motion.law  # type: ignore[attr-defined]
    assert base.design([("phases.return", 121.0)]).motion.timing is not third.motion.timing  # type: ignore[attr-defined]
    fifth, sixth = base.design([("spring.torque", 410.0)]), base.design([("spring.torque", 420.0)])
    assert fifth.fingers is sixth.fingers  # type: ignore[attr-defined]
    assert base.design([("fingers.lever", 44.0)]).fingers is not sixth.fingers  # type: ignore[attr-defined]


def test_those_that_do_not_exist_leave_the_others_found_together() -> None:
    base, alone = _base("swing_gripper"), _base("swing_gripper")
    names, codes = ["max_radius", "min_transmission_angle", "lift_off_speed"], list(base.codes)
    wrong: list[list[tuple[str, Any]]] = [
        [("links.coupler", 400.0)],  # opens
        [("links.coupler", 225.7)],  # comes to a dead centre
        [("cam.roller.arm", 10.0)],  # passes the pole
        [("cam.return_roller.angle", 5.0)],  # on the same side as the main roller
        [("pivots.output", [230.0, 0.0])],  # one point
        [("total_swing", 80.0)],
    ]
    rows = [*_rows(base, LINKS, 9), *wrong]
    random.Random(2).shuffle(rows)
    found = singles(base, rows, names, codes)
    for row, other in spread(zip(rows, found, strict=True), 5):
        _compare(single(alone, row, names, codes), other)
    assert sum(bool(one.refused) for one in found) >= 3
    designs: list[Any] = [base.design(row) for row in rows]
    type(designs[0]).find_together(designs, codes)
    kept = [
        "least_transmission" in vars(each.motion.linkage)
        for each, row in zip(designs, rows, strict=True)
        if row not in wrong
    ]
    assert all(kept)


@pytest.mark.slow
def test_designs_of_several_laws_and_rollers() -> None:
    base, alone = _base("swing_gripper"), _base("swing_gripper")
    laws = ["modified-sine", {"scca": [0.25, 0.25, 0.25, 0.25]}]
    rows = [[("laws.return", law), *row] for law in laws for row in _rows(base, {**LINKS, **LAW}, 5)]
    rows += [[("cam.return_roller", None), *row] for row in _rows(base, LINKS, 2)]
    random.Random(4).shuffle(rows)
    names, codes = ["max_pressure_angle", "lift_off_speed"], list(base.codes)
    for row, other in spread(zip(rows, singles(base, rows, names, codes), strict=True), 3):
        _compare(single(alone, row, names, codes), other)


@pytest.mark.slow
def test_laws_that_are_nearly_each_its_own_leave_designs_to_themselves() -> None:
    base, alone = _base("swing_gripper"), _base("swing_gripper")
    rows: list[list[tuple[str, Any]]] = [[("laws.accelerate", {"quintic": 0.5 + 0.005 * k})] for k in range(10)]
    names, codes = ["max_pressure_angle", "lift_off_speed"], list(base.codes)
    for row, other in spread(zip(rows, singles(base, rows, names, codes), strict=True), 3):
        _compare(single(alone, row, names, codes), other)


def test_the_reach_over_a_swing_is_sure_where_every_sample_closes() -> None:
    """Against 1801 samples; near the limit neither is asked."""
    base = _base("swing_gripper")
    for coupler in (150.0, 199.0, 226.0, 260.0, 380.0, 401.0, 430.0):
        design: Any = base.design([("links.coupler", coupler)])
        linkage, closes = design.motion.unchecked, True
        try:
            _ = design.motion.linkage
        except NoSolution as error:
            closes = "cannot be assembled" not in str(error)
        assert linkage.surely_reaches == closes, coupler
