"""Contact about mid-swing: exact limits, leading order, and the dissertation's estimates.

Tolerances: 1e-12 in k for roots of functions known to a few ulp; the leading order in the roller radius is met to
the first order of what it leaves out, checked by making the roller ten times smaller.
"""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.wide_swing.cam import (
    Layout,
    WideSwingCam,
    middle_radius_estimate,
    start_radius_estimate,
)
from gearlink.core.machines.wide_swing.device import Pneumatic
from gearlink.core.machines.wide_swing.law import ElasticLaw

CASES = {
    case["id"]: case["outputs_float"]
    for case in json.loads((Path(__file__).parents[2] / "reference" / "wide_swing.json").read_text())["cases"]
}
LAW = ElasticLaw(Pneumatic(2.5), math.radians(120.0))
BOTH = [("D13", "twin-cam"), ("D15", "twin-rocker")]


def cam(layout: Layout) -> WideSwingCam:
    """The cams of D13 and D15."""
    cycle, roller = (120.0, 0.04) if layout == "twin-cam" else (80.0, 0.02)
    return WideSwingCam(layout, LAW, math.radians(cycle), 1.0, roller)


def undercut_start(mechanism: WideSwingCam) -> float:
    """k where the pitch curve's radius has fallen to the roller's, by halving."""
    low, high = 0.0, 0.5
    for _ in range(60):
        middle = 0.5 * (low + high)
        radius = mechanism.sense * float(mechanism.points(np.array([middle])).curvature_radius[0])
        low, high = (middle, high) if not 0.0 < radius < mechanism.roller_radius else (low, middle)
    return low


@pytest.mark.parametrize(("case", "layout"), BOTH)
def test_reference_limits_and_estimates(case: str, layout: Layout) -> None:
    expected, mechanism = CASES[case], cam(layout)
    assert undercut_start(mechanism) == pytest.approx(expected["k_R_eq_rp"], abs=1e-12)
    leading = 0.5 - 0.75 * mechanism.transition_zone_estimate
    assert leading == pytest.approx(expected["k_R_eq_rp_leading"], abs=1e-14)
    assert start_radius_estimate(mechanism) == pytest.approx(expected["R_eq23(k=0.1)"], rel=1e-13)
    # the angle at k = 0.45 is a difference of two numbers a hundred times larger
    assert middle_radius_estimate(mechanism) == pytest.approx(expected["R_eq27(k=0.45)"], rel=1e-12)


@pytest.mark.parametrize(("case", "layout"), BOTH)
def test_no_profile_point_in_contact_is_cut_by_the_roller(case: str, layout: Layout) -> None:
    """The roller's envelope by brute force: points before the end of contact stay clear of every roller place."""
    mechanism = cam(layout)
    end = mechanism.contact[0][1]
    rollers = mechanism.points(np.linspace(0.0, 0.5, 2001)).pitch
    before = mechanism.points(np.linspace(0.0, end - 1e-6, 300)).profile
    after = mechanism.points(np.linspace(end + 1e-3, 0.5 - 1e-4, 50)).profile
    radius = mechanism.roller_radius
    assert np.abs(before[:, None] - rollers[None, :]).min() >= radius * (1 - 1e-12)
    assert np.all(np.abs(after[:, None] - rollers[None, :]).min(axis=1) < radius * (1 - 1e-9))


@pytest.mark.quick(1)
@pytest.mark.parametrize(("case", "layout"), BOTH)
def test_four_thirds(case: str, layout: Layout) -> None:
    mechanism = cam(layout)
    excess = []
    for roller in (mechanism.roller_radius, 0.1 * mechanism.roller_radius):
        smaller = replace(mechanism, roller_radius=roller)
        lost, cut = 0.5 - smaller.contact[0][1], 0.5 - undercut_start(smaller)
        excess.append(abs(lost / cut - 4.0 / 3.0))
        # the next order is the square of the roller's radius
        share = roller / mechanism.roller_radius
        assert lost == pytest.approx(smaller.transition_zone_estimate, rel=0.003 * share**2 + 1e-6)
    assert excess[0] < 2e-3
    assert excess[1] < 0.2 * excess[0]


def test_estimate_of_the_middle_is_three_eighths() -> None:
    """(27) against the curvature at its own place: 3/8 to the leading order of the cusp."""
    mechanism = cam("twin-cam")
    true = float(mechanism.points(np.array([0.499])).curvature_radius[0])
    assert middle_radius_estimate(mechanism, 0.499) == pytest.approx(0.375 * true, rel=1e-3)


def test_estimate_of_the_start_serves_the_twin_cam_alone() -> None:
    """(23) leaves the pressure angle at the start out: 3 % high to 11 % low where that is small."""
    external, internal = cam("twin-cam"), cam("twin-rocker")
    assert -0.11 < start_radius_estimate(external) / external.start_curvature_radius - 1.0 < 0.03
    assert abs(start_radius_estimate(internal) / internal.start_curvature_radius - 1.0) > 0.5


def test_roller_too_large() -> None:
    large = replace(cam("twin-cam"), roller_radius=0.5)
    with pytest.raises(NoSolution, match=r"set cam.roller_radius below") as refusal:
        _ = large.contact[0][1]
    limit = float(str(refusal.value).split("below ")[1].split(" mm")[0])
    # four digits of the limit are printed
    assert replace(large, roller_radius=limit).contact[0][1] < 1e-3
    with pytest.raises(NoSolution):
        _ = replace(large, roller_radius=1.001 * limit).contact[0][1]


@pytest.mark.quick(2)
@pytest.mark.parametrize(("case", "layout"), BOTH)
@pytest.mark.parametrize("zone", [0.2, 0.04, 1e-3])
def test_largest_roller_has_the_zone_that_was_asked_for(case: str, layout: Layout, zone: float) -> None:
    mechanism = cam(layout)
    fitted = replace(mechanism, roller_radius=mechanism.largest_roller(zone))
    assert fitted.transition_zone == pytest.approx(zone, rel=1e-9)


@pytest.mark.parametrize(("case", "layout"), BOTH)
def test_leading_order_takes_over_without_a_step(case: str, layout: Layout) -> None:
    """Rollers with zones just above and below 1e-4 of the stroke: both forms agree to the 1e-7 that either keeps."""
    mechanism = cam(layout)
    small = replace(mechanism, roller_radius=mechanism.largest_roller(1.0001e-4))
    smaller = replace(mechanism, roller_radius=0.9998 * small.roller_radius)
    for each in (small, smaller):
        assert each.transition_zone == pytest.approx(each.transition_zone_estimate, rel=1e-7)


@pytest.mark.quick(1)
@pytest.mark.parametrize(("share", "free"), [(0.9, True), (0.99, True), (0.9999, False)])
def test_shorter_rocker_is_judged_to_mid_swing_where_nothing_is_cut(share: float, free: bool) -> None:
    """A smooth curve carries through mid-swing, with 90 deg there; next to (18) the standing roller still cuts it."""
    nominal = cam("twin-cam")
    shorter = replace(nominal, given_rocker_radius=share * nominal.rocker_radius)
    rollers = shorter.points(np.linspace(0.0, 1.0, 4001)).pitch
    profile = shorter.points(np.linspace(0.0, 0.5, 400)).profile
    clear = np.abs(profile[:, None] - rollers[None, :]).min() >= shorter.roller_radius * (1 - 1e-9)
    assert clear == free
    if free:
        assert shorter.contact == ((0.0, 0.5), (0.5, 1.0))
        assert math.degrees(shorter.max_pressure_angle) == pytest.approx(90.0, abs=1e-6)
    else:
        assert shorter.transition_zone == pytest.approx(nominal.transition_zone, rel=0.1)
        assert math.degrees(shorter.max_pressure_angle) < 45.0


@pytest.mark.quick(1)
@pytest.mark.parametrize(("share", "roller"), [(0.9995, 8.0), (0.999, 8.0), (0.998, 12.0), (0.99, 30.0)])
def test_a_smooth_bend_is_cut_before_the_roller_stands_at_mid_swing(share: float, roller: float) -> None:
    """Every place of the roller is tried, 4,000 of them: what stands at mid-swing alone leaves up to 0.002 more."""
    nominal = WideSwingCam("twin-cam", LAW, math.radians(120.0), 200.0, roller)
    shorter = replace(nominal, given_rocker_radius=share * nominal.rocker_radius)
    end = shorter.contact[0][1]
    path = shorter.points(np.linspace(0.0, 0.5, 4001)).pitch
    kept, cut = shorter.points(np.array([end - 1e-4, end + 1e-4])).profile
    assert np.abs(path - kept).min() > roller * (1.0 - 1e-12)
    assert np.abs(path - cut).min() < roller * (1.0 - 1e-12)
    larger = replace(shorter, roller_radius=shorter.largest_roller(0.5 - end))
    assert math.isclose(larger.roller_radius, roller, rel_tol=1e-9)
