"""Wide swings whose searches run together have what each finds by itself.

Tolerance: 1e-12 of a value, for extremes that are refined to rounding over other samples; 1e-9 for the end of contact,
a root that rounding leaves uncertain by so much where the roller is small, and for the curvature there.
"""

from __future__ import annotations

import random
from typing import Any

import factory
import numpy as np
import pytest

from gearlink.core.machines.wide_swing.oscillating_cam import need_home
from gearlink.core.machines.wide_swing.together import law_of
from gearlink.core.studies.explore.base import Base, single, singles

CAM = {"cam.center_distance": 20.0, "cam.roller_radius": 1.5}
LAW = {"swing": 8.0, "unloader.pivot_ratio": 0.3, "inertia": 0.02}
SLIDER = {**CAM, "swing": 4.0, "slider.rod": 20.0, "slider.crank": 8.0}
STUDIES: dict[str, tuple[str, dict[str, float]]] = {
    "law": ("wide_swing_twin_cam", CAM | LAW | {"cycle_angle": 10.0}),
    "cam": ("wide_swing_twin_cam", CAM | {"unloader.arm": 10.0, "speed": 10.0}),
    "whole cycle": ("wide_swing_cycle", CAM | LAW | {"cycle.working": 5.0, "cam.free_clearance": 0.3}),
    "slider": ("wide_swing_slider_cam", SLIDER),
    "parallel shafts": ("wide_swing_parallel", CAM | {"cam.second.center_distance": 10.0}),
    "rocker": ("wide_swing_twin_rocker", CAM),
    "laws on a crank-rocker": (
        "wide_swing_oscillating_cam",
        LAW | {"swing": 4.0, "drive.crank": 2.0, "drive.frame": 4.0},
    ),
    "carried by a crank-rocker": ("wide_swing_oscillating_cam", CAM | {"drive.coupler": 10.0}),
    "slider and crank-rocker": ("wide_swing_slider_drive", SLIDER | {"drive.crank": 2.0, "unloader.pivot_ratio": 0.1}),
    "one slider and crank-rockers": ("wide_swing_slider_drive", CAM | {"drive.coupler": 10.0}),
}
OF_CONTACT = ("transition_zone", "min_curvature_radius")


def _base(name: str) -> Base:
    return Base(factory.worked(name), "analyze")


def _rows(base: Base, widths: dict[str, float], count: int) -> list[list[tuple[str, Any]]]:
    own, rows = random.Random(11), []
    for _ in range(count):
        rows.append([(path, _value(base.data, path) + own.uniform(-by, by)) for path, by in widths.items()])
    return rows


def _value(data: Any, path: str) -> float:
    for key in path.split("."):
        data = data[key]
    return float(data)


def _compare(one: Any, other: Any) -> None:
    assert one.refused == other.refused
    assert one.what == other.what
    for name, value in one.values.items():
        exact = 1e-9 if name in OF_CONTACT else 1e-12
        assert other.values[name] == (value if value is None else pytest.approx(value, rel=exact, abs=exact)), name
    assert [(c.code, c.status, c.what) for c in one.findings] == [(c.code, c.status, c.what) for c in other.findings]


NAMES = ("max_radius", "max_pressure_angle", "min_curvature_radius", "transition_zone", "contact_force")


def _study(name: str, rows: Any) -> list[Any]:
    base, alone = _base(name), _base(name)
    codes, own = list(base.codes), base.design()
    names = [each for each in NAMES if own.raw(each) is not None]
    found = singles(base, rows, names, codes)
    for row, other in zip(rows, found, strict=True):
        _compare(single(alone, row, names, codes), other)
    return found


@pytest.mark.quick(1)
@pytest.mark.parametrize("study", STUDIES)
def test_designs_of_a_study_are_those_of_each_alone(study: str) -> None:
    name, widths = STUDIES[study]
    _study(name, _rows(_base(name), widths, 9))


def _found(name: str, widths: dict[str, float], *asked: str) -> list[Any]:
    base = _base(name)
    designs: list[Any] = [base.design(row) for row in _rows(base, widths, 9)]
    type(designs[0]).find_together(designs, asked)
    return designs


def test_cams_are_found_together() -> None:
    for design in _found("wide_swing_twin_cam", CAM | LAW, "contact_force"):
        assert {"least_loop_measures", "contact_ends", "tops", "pressing"} <= set(vars(design.cam))


@pytest.mark.slow
def test_cams_of_sliders_and_free_sectors_are_found_together() -> None:
    for design in _found("wide_swing_slider_cam", SLIDER, "max_pressure_angle"):
        assert {"least_loop_measures", "contact_ends", "tops"} <= set(vars(design.slider_cam))
        assert "pressing" not in vars(design.slider_cam)
    for design in _found("wide_swing_cycle", CAM | LAW, "closed-contour"):
        assert all("free" in vars(closed) for closed in design.cycle.contours.values())


@pytest.mark.quick(1)
@pytest.mark.parametrize(("name", "widths"), [
    ("wide_swing_oscillating_cam", CAM),
    ("wide_swing_oscillating_cam", CAM | {"swing": 5.0}),
    ("wide_swing_slider_drive", {"slider.mass": 2.0, "cam.roller_radius": 1.5}),
])  # fmt: skip
def test_cams_on_crank_rockers_are_found_together(name: str, widths: dict[str, float]) -> None:
    for design in _found(name, widths, "max_pressure_angle"):
        assert {"stops", "contact", "tops", "max_pressure_angle"} <= set(vars(design.oscillating_cam))
        assert "way_back" in vars(design.unloading)


@pytest.mark.slow
def test_crank_rockers_that_do_not_exist_leave_the_others_found_together() -> None:
    wrong: list[list[tuple[str, Any]]] = [
        [("cam.roller_radius", 150.0)],  # covers its profile
        [("cam.roller_radius", 1e-3)],
        [("drive.crank", 200.0)],  # no crank-rocker
        [("drive.frame", 320.0)],
        [("unloader.pivot_ratio", 1.0)],
        [("swing", 10.0)],
    ]
    rows = [*_rows(_base("wide_swing_oscillating_cam"), CAM | {"drive.crank": 2.0}, 12), *wrong]
    random.Random(3).shuffle(rows)
    found = _study("wide_swing_oscillating_cam", rows)
    assert sum(bool(one.refused) for one in found) >= 2


def test_designs_of_one_device_and_swing_share_their_law() -> None:
    designs = _found("wide_swing_twin_cam", CAM, "max_radius")
    assert len({id(design.motion.plain_law) for design in designs}) == 1
    assert len({id(design.motion.plain_law) for design in _found("wide_swing_twin_cam", LAW, "max_radius")}) == 9


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["wide_swing_slider_drive", "wide_swing_slider_cam", "wide_swing_oscillating_cam"])
def test_forces_of_cams_that_are_not_symmetric_are_found_together(name: str) -> None:
    """The maximum of the force at many places, in the stroke and on the way home."""
    for design in _found(name, {"unloader.pivot_ratio": 0.1, "cam.roller_radius": 1.5}, "contact_force"):
        assert "contact_force" in vars(design)
        cam, unloading = design.cam, design.unloading
        grids = [np.linspace(start, end, 400) for start, end in cam.contact]
        forces = [unloading.contact_force(cam, k).max() for k in grids]
        if design.spec.drive is not None:
            forces += [unloading.contact_force(cam, k, need=need_home(cam, k)).max() for k in grids]
        assert design.contact_force == pytest.approx(max(forces), rel=1e-4)
        assert design.contact_force >= max(forces) * (1.0 - 1e-12)


def test_extremes_of_laws_are_found_together() -> None:
    for design in _found("wide_swing_slider_drive", {"slider.mass": 1.0, "drive.crank": 2.0}, "power_peak"):
        assert "peaks" in vars(design.motion.slider)
        law, drive = design.aimed_law, design.motion.drive
        assert {"turns", "_at", "middle_jerk"} <= set(vars(law))
        # where the rocker's way over the cam's has an extremum, between places beside it
        k = law.place + np.array([-1e-4, 0.0, 1e-4])
        ratio = law.law.rates(k)[0] / drive.motion(k, 1)[1]
        assert (ratio[0] - ratio[1]) * (ratio[2] - ratio[1]) > 0.0
    for design in _found("wide_swing_twin_cam", {"swing": 8.0}, "drive_torque_peak"):
        assert "power_peak" in vars(design.motion.plain_law)


def test_laws_of_many_rockers_are_read_backwards_together() -> None:
    """k where each law has an angle, by the times that nothing has to be solved for."""
    own = random.Random(5)
    k = np.array([[own.random() for _ in range(40)] for _ in range(9)])
    k[:, :4] = 0.0, 0.25, 0.5, 1.0
    for name in ("wide_swing_twin_cam", "wide_swing_slider"):
        laws = [design.motion.law for design in _found(name, {"swing": 8.0, "unloader.pivot_ratio": 0.3})]
        sine, cosine = law_of(laws).pendulum(k)
        for row, law in enumerate(laws):
            if name == "wide_swing_slider":
                found = law.share_from(np.arctan2(cosine[row], sine[row]), late=False)
            else:
                side = np.where(k[row] > 0.5, 1.0, -1.0)
                found = 0.5 + law.share_from_middle(side * np.arctan2(sine[row], cosine[row]))
            assert found == pytest.approx(k[row], rel=0.0, abs=1e-14)


def test_designs_of_alike_cams_share_them() -> None:
    found = _found("wide_swing_parallel", {"cam.second.direction": 5.0}, "closed-contour")
    assert len({id(design.even_cam) for design in found}) == len({id(design.cycle.main) for design in found}) == 1
    assert found[0].even_cam is not found[0].return_cam
    found = _found("wide_swing_slider_drive", {"cam.roller_radius": 1.0}, "max_radius")
    assert len({id(design.aimed_law) for design in found}) == 1
    assert len({id(design.cam) for design in found}) == 9


@pytest.mark.slow
def test_those_that_do_not_exist_leave_the_others_found_together() -> None:
    wrong: list[list[tuple[str, Any]]] = [
        [("cam.roller_radius", 150.0)],  # covers its profile
        [("cam.roller_radius", 1e-3)],  # leaves it later than is solved for
        [("cam.rocker_radius", 60.0)],
        [("cam.rocker_radius", 90.0)],  # has a loop
        [("unloader.pivot_ratio", 1.0)],
        [("swing", 10.0), ("cycle_angle", 300.0)],
    ]
    rows = [*_rows(_base("wide_swing_twin_cam"), CAM | LAW, 10), *wrong]
    random.Random(3).shuffle(rows)
    found = _study("wide_swing_twin_cam", rows)
    assert sum(bool(one.refused) for one in found) >= 2
