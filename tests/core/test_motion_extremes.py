"""Extremes of motions and their places: against dense grids, and against the design's tables.

A grid of h misses a smooth extreme by h^2/8 of its bend: 20000 steps of a revolution leave 1e-7 of the range.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from factory import design
from sweeps import mostly_slow

TURN = 2.0 * math.pi


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("name", "table", "angle", "curves"),
    [
        ("ty460", "chains", "input_angle", ("bed_velocity", "bed_acceleration", "cylinder_velocity")),
        ("swing_gripper", "motion", "theta", ("input_velocity", "output_velocity")),
        ("five_bar_positions", "function", "input_angle", ("speed_ratio", "acceleration_ratio")),
    ],
)
def test_extremes_are_those_of_the_table(name: str, table: str, angle: str, curves: tuple[str, ...]) -> None:
    made = design(name)
    rows = made.table(table, samples=3600)
    x = np.asarray(rows.data[rows.columns.index(angle)])
    for curve in curves:
        y = np.asarray(rows.data[rows.columns.index(curve)])
        for side, pick in (("max", np.argmax), ("min", np.argmin)):
            value, place = (made.quantity(f"{curve}_{side}{end}").value for end in ("", "_at"))
            i = int(pick(y))
            assert abs(value - y[i]) < 1e-4 * np.ptp(y)
            assert (value - y[i]) * (1.0 if side == "max" else -1.0) > -1e-9 * np.ptp(y)
            assert abs(np.interp(place, x, y) - value) < 1e-4 * np.ptp(y)


def test_the_point_of_a_five_bar() -> None:
    made = design("five_bar_path")
    rows = made.table("path", samples=7200)
    data = {name: np.asarray(column) for name, column in zip(rows.columns, rows.data, strict=True)}
    for curve, rate in (("velocity", "velocity"), ("acceleration", "acceleration")):
        size = np.hypot(data[f"x_{rate}"], data[f"y_{rate}"])
        assert abs(getattr(made, f"{curve}_max") - size.max()) < 1e-4 * size.max()
        assert abs(getattr(made, f"{curve}_min") - size.min()) < 1e-4 * size.max()
        at = np.interp(made.quantity(f"{curve}_max_at").value, data["input_angle"], size)
        assert abs(at - size.max()) < 1e-4 * size.max()
    real = design("five_bar_path", input_speed=90.0)
    assert real.point_speed_max == pytest.approx(made.velocity_max * 3.0 * math.pi, rel=1e-12)
    assert made.point_speed_max is None


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    "name", mostly_slow(["wide_swing_twin_cam", "wide_swing_oscillating_cam", "wide_swing_slider_cam"], 2)
)
def test_wide_swings(name: str) -> None:
    made = design(name)
    k = np.linspace(0.0, 1.0, 20001)
    _, speed, acceleration = made.motion.law.invariants(k, 2)
    scale = made.motion.swing / made.motion.working_time
    assert made.quantity("rocker_speed_max").value == pytest.approx(scale * speed.max(), rel=1e-7)
    least = scale / made.motion.working_time * acceleration.min()
    assert made.quantity("rocker_acceleration_min").value == pytest.approx(least, rel=1e-6)
    place = made.quantity("max_pressure_angle_at").value / math.degrees(made.motion.cycle_angle)
    angle = abs(float(made.cam.pressure_angle(np.array([place]))[0]))
    assert angle == pytest.approx(made.cam.max_pressure_angle, rel=1e-6)
    place = made.quantity("min_curvature_radius_at").value / math.degrees(made.motion.cycle_angle)
    assert 1.0 / float(made.cam.bulge(np.array([place]))[0]) == pytest.approx(made.cam.min_curvature_radius, rel=1e-6)


def test_places_on_cams_and_chains() -> None:
    press = design("ty460")
    for prefix, cam in (("", press.main_cam), ("return_", press.return_cam)):
        place = math.radians(press.quantity(f"{prefix}max_pressure_angle_at").value)
        angle = abs(float(cam.pressure_angle(np.array([place]))[0]))
        assert math.degrees(angle) == pytest.approx(press.quantity(f"{prefix}max_pressure_angle").value, rel=1e-9)
    for chain in ("bed", "cylinder"):
        rows = press.table("positions", samples=7200)
        column = np.asarray(rows.data[rows.columns.index(f"transmission_angle_{chain}")])
        angles = np.asarray(rows.data[rows.columns.index("input_angle")])
        least, place = (press.quantity(f"min_transmission_angle_{chain}{end}").value for end in ("", "_at"))
        assert column.min() == pytest.approx(least, abs=1e-4)
        assert np.interp(place, angles, column) == pytest.approx(least, abs=1e-3)
    gripper = design("swing_gripper")
    found = [math.degrees(place) for place in gripper.raw("min_transmission_angle_at")]
    for j, place in enumerate(found):
        beta = gripper.law.evaluate(np.array([place]), 0)[0]
        angle = gripper.linkage.transmission(gripper.linkage.local_output(beta))[j]
        assert float(angle[0]) == pytest.approx(gripper.min_transmission_angle[j], rel=1e-6)
