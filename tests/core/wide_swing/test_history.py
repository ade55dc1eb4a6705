"""Torques over the stroke with an elastic drive, and the blow at the change of flanks.

Tolerances: 1e-7 of the peak against DOP853 (own control 1e-11); the formula of the blow is of leading order: 8 %
against the free rocker integrated, 2 to 5 % in the example; 1e-6 for a difference quotient of the arc.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from sweeps import examples

from gearlink.core.machines.wide_swing.design import WideSwingDesign
from gearlink.core.machines.wide_swing.spec import WideSwingSpec
from gearlink.core.machines.wide_swing.torques import crossing_time

CYLINDER = {"type": "pneumatic", "pivot_ratio": 2.6, "arm": 120.0, "reserve": 0.24, "residual": 0.02}
CAM = {"center_distance": 200.0, "roller_radius": 8.0, "shaft_radius": 25.0}
SLIDER = {"crank": 150.0, "rod": 450.0, "middle_angle": 73.18, "mass": 6.0}
SHAFT = {"natural_frequency": 15.0, "damping": 0.05}


def design_of(**more: Any) -> WideSwingDesign:
    data = {"kind": "wide-swing-cam", "layout": "twin-cam", "swing": 120.0, "cycle_angle": 120.0, "speed": 100.0}
    return WideSwingDesign(WideSwingSpec.model_validate(data | {"inertia": 0.5, "unloader": CYLINDER} | more))


def columns(design: WideSwingDesign) -> dict[str, Any]:
    table = design.table("history")
    return dict(zip(table.columns, (np.array(each, dtype=float) for each in table.data), strict=True))


@pytest.mark.slow
@pytest.mark.parametrize("slider", [SLIDER, None])
@pytest.mark.parametrize("damping", [0.08, 0.0])
def test_history_is_the_motion_of_the_shaft(slider: dict[str, Any] | None, damping: float) -> None:
    design = design_of(slider=slider, shaft=SHAFT | {"damping": damping})
    at = columns(design)
    motion, own = design.motion, 2.0 * math.pi * 15.0
    stroke, scale = motion.working_time, motion.inertia * motion.swing / motion.working_time**2
    share = -(0.24 + 0.02)

    def rate(t: float, y: Any, driven: float) -> list[float]:
        load = share * scale * float(motion.law.device_torque(np.array([min(1.0, t / stroke)]))[0]) if driven else 0.0
        return [y[1], own**2 * (load - y[0]) - 2.0 * damping * own * y[1]]

    time = 1e-3 * at["time"]
    first = time <= stroke * (1.0 + 1e-12)
    control = {"method": "DOP853", "rtol": 1e-11, "atol": 1e-11}
    during = solve_ivp(rate, (0.0, stroke), [0.0, 0.0], t_eval=np.minimum(time[first], stroke), args=(1.0,), **control)
    after = solve_ivp(rate, (stroke, time[-1]), during.y[:, -1], t_eval=time[~first], args=(0.0,), **control)
    expected = np.concatenate((during.y[0], after.y[0]))
    np.testing.assert_allclose(at["rocker_torque_elastic"], expected, rtol=0, atol=1e-7 * np.abs(expected).max())
    assert not at["rocker_torque"][~first].any()
    assert not at["drive_torque_elastic"][~first].any()
    # the work of the main shaft is that of the rocker: torques times angles, row by row
    way = np.gradient(motion.law.invariants(at["cam_angle"][first] / 120.0, 0)[0] * 120.0, at["cam_angle"][first])
    inner = slice(2, -2)
    balanced = at["rocker_torque_balanced"][first] * way
    np.testing.assert_allclose(
        at["drive_torque_balanced"][first][inner], balanced[inner], rtol=0, atol=0.02 * balanced.max()
    )


def test_device_of_a_shorter_return_stroke() -> None:
    design = design_of(
        cycle_angle=None, cycle={"working": 120, "far_dwell": 60, "return": 100, "near_dwell": 80}, shaft=SHAFT
    )
    at = columns(design)
    assert len(at["time"]) == 181
    share = at["rocker_torque_balanced"][10] / at["rocker_torque"][10]
    square = (120.0 / 100.0) ** 2
    assert share == pytest.approx(1.0 - 1.24 * square - 0.02 * square, rel=1e-12)


def test_coefficient_over_the_speed() -> None:
    unloading = design_of(shaft=SHAFT).unloading
    slow = design_of(shaft=SHAFT, speed=50.0).unloading
    assert unloading.dynamic_coefficients([0.5])[0] == pytest.approx(slow.dynamic_coefficient, rel=1e-9)
    assert math.isnan(design_of(shaft={"natural_frequency": 15_000.0}).unloading.dynamic_coefficients([0.5])[0])


@given(free=st.floats(0.0, 0.1), clearance=st.floats(0.0, 1.0), growth=st.floats(1.0, 1e6))
@example(free=0.0, clearance=1.0, growth=7.0)  # the cube root of 6/7 cubed is less than 6/7
@examples(50)
def test_crossing_solves_its_cubic(free: float, clearance: float, growth: float) -> None:
    time = crossing_time(free, clearance, growth)
    assert time >= 2.0 * free * (1.0 - 1e-12)
    assert (time - 2.0 * free) * (time + free) ** 2 == pytest.approx(6.0 * clearance / growth, rel=1e-8, abs=1e-18)


@pytest.mark.quick(1)
@pytest.mark.parametrize(("slider", "clearance"), [(None, 0.05), (None, 0.0), (SLIDER, 0.05)])
def test_blow_of_the_free_rocker(slider: dict[str, Any] | None, clearance: float) -> None:
    design = design_of(slider=slider, cam=CAM | {"roller_clearance": clearance, "contact_stiffness": 2e4})
    motion, impact = design.motion, design.impact
    time, arm, middle = (
        motion.working_time,
        design.cam.rocker_radius,
        0.5 if slider is None else motion.slider.middle_place,
    )
    start = middle - design.cam.transition_zone
    g, law = motion.law.geometry, motion.law
    parameter, size = law.energy_parameter, motion.inertia

    def inertia(a: float) -> float:
        return 1.0 if slider is None else motion.slider.inertia_at(a)

    def rate(_k: float, y: Any) -> list[float]:
        a, b = y
        phi = (0.5 - a) * motion.swing
        length = math.sqrt(g.shortest**2 + 4.0 * g.ratio * math.sin(0.5 * phi) ** 2)
        push = 0.5 * parameter * g.ratio * motion.swing * math.sin(phi) / length * 1.24
        step = 1e-6
        bend = (inertia(a + step) - inertia(a - step)) / (2.0 * step)
        return [b, (push - 0.5 * bend * b * b) / inertia(a)]

    def ahead(k: float, y: Any) -> float:
        """Roller path against the law, the far flank `clearance` behind the near one."""
        return arm * motion.swing * (y[0] - float(law.invariants(np.array([k]), 0)[0][0])) + clearance

    ahead.terminal, ahead.direction = True, -1.0  # type: ignore[attr-defined]
    begin = [float(x[0]) for x in law.invariants(np.array([start]), 1)]
    run = solve_ivp(rate, (start, 1.0), begin, events=ahead, method="DOP853", rtol=1e-11, atol=1e-14)
    k, b = float(run.t_events[0][-1]), float(run.y_events[0][-1][1])
    speed = arm * motion.swing / time * (float(law.invariants(np.array([k]), 1)[1][0]) - b)
    assert impact.speed == pytest.approx(speed, rel=0.08)
    assert impact.place == pytest.approx(k, abs=0.01)
    assert impact.energy is not None
    assert impact.speed is not None
    assert impact.energy == pytest.approx(0.5 * size * inertia(0.5) * (impact.speed / arm) ** 2, rel=1e-12)
    assert impact.force == pytest.approx(math.sqrt(2.0 * impact.energy * 2e7), rel=1e-12)


def test_no_blow_without_reserve() -> None:
    design = design_of(unloader=CYLINDER | {"reserve": 0.0}, cam=CAM | {"roller_clearance": 0.05})
    assert design.impact.speed is None
    limits = {"impact_speed": 10.0}
    (check,) = design_of(cam=CAM | {"roller_clearance": 0.05}, limits=limits).check("flank-impact")
    assert check.status == "warn"
    assert not design_of(cam=CAM | {"roller_clearance": 0.05}).check("flank-impact")


@pytest.mark.parametrize("layout", ["twin-cam", "twin-rocker"])
def test_gain_is_the_slope_of_the_arc(layout: str) -> None:
    design = design_of(layout=layout, cam=CAM, output_radius=300.0, cycle_angle=90.0)
    cam, a = design.cam, 200.0
    r = cam.rocker_radius

    def angle(rho: float) -> float:
        return math.acos((a * a + r * r - rho * rho) / (2.0 * a * r))

    slope = (angle(cam.end_radius + 1e-4) - angle(cam.end_radius - 1e-4)) / 2e-4
    assert design.end_position_gain == pytest.approx(300.0 * slope, rel=1e-6)
