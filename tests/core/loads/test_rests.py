"""Rollers in the rests of a wide-swing cycle, against the closed form (1e-12) and dense rows (1e-4)."""

from __future__ import annotations

import math
from typing import Any

import factory
import numpy as np
import pytest

ROLLER = {"roller": {"width": 20}, "material": {"allowed_pressure": 800}}


def made(**changes: Any) -> Any:
    return factory.design("wide_swing_cycle", command="loads", **changes)


def in_rest(design: Any, cam: Any, internal: bool) -> tuple[float, float]:
    """Force [N] and pressure [N/mm^2] on an arc: its normal, through O, has a lever a r sin(gamma/2)/rho about D."""
    spec, half = design.spec, 0.5 * math.radians(design.spec.swing)
    ratio, arm = spec.unloader.pivot_ratio, spec.unloader.arm
    length = math.sqrt(1.0 + ratio**2 - 2.0 * ratio * math.cos(half))
    moment = design.design.unloading.force * arm * ratio * math.sin(half) / length
    a, r, roller = spec.cam.center_distance, cam.rocker_radius, spec.cam.roller_radius
    rho = math.sqrt(a * a + r * r - 2.0 * a * r * math.cos(math.pi - half if internal else half))
    force = moment * rho / (a * r * math.sin(half))
    radius = roller * (1.0 + roller / rho if internal else 1.0 - roller / rho)
    return force, math.sqrt(force * 206_000.0 / (2.0 * (1.0 - 0.09)) / (math.pi * 20.0 * radius))


@pytest.mark.slow
@pytest.mark.parametrize("layout", ["twin-rocker", "twin-cam"])
def test_pressure_of_the_rests_in_closed_form(layout: str) -> None:
    """Far rest on the arc of the working stroke's cam, near rest on the return stroke's; harder than either stroke."""
    design = made(layout=layout, loads=ROLLER)
    internal = layout == "twin-rocker"
    main, back = (stroke.cam for stroke in design.strokes)
    expected = [in_rest(design, main, internal), in_rest(design, back, False)]
    for rest, (force, pressure) in zip(design.rests, expected, strict=True):
        assert (rest.pressed["force"], rest.pressed["least_force"]) == pytest.approx((force, force), rel=1e-12)
        assert rest.pressed["pressure"] == pytest.approx(pressure, rel=1e-12)
    assert design.contact_force_max == pytest.approx(max(force for force, _ in expected), rel=1e-12)
    assert design.hertz_pressure_max == pytest.approx(max(pressure for _, pressure in expected), rel=1e-12)


def test_a_cycle_that_fails_in_its_rest_alone() -> None:
    design = made(loads=ROLLER)
    (check,) = design.check("contact-pressure")
    strokes = max(stroke.pressed["pressure"].value for stroke in design.strokes)
    assert round(strokes) == 692
    assert (check.status, round(check.value)) == ("fail", 965)
    assert "near rest" in check.message


def test_a_rest_of_no_length_presses_nothing() -> None:
    design = made(cycle={"working": 80, "far_dwell": 180, "return": 100, "near_dwell": 0}, loads=ROLLER)
    (rest,) = design.rests
    assert rest.words == "far rest"
    assert design.contact_force_max == pytest.approx(in_rest(design, design.strokes[0].cam, True)[0], rel=1e-12)


VARYING = {
    **ROLLER,
    "device_direction": 40,
    "forces": [{"on": "rocker", "torque": {"table": [[0, -5], [90, -30], [120, 40], [300, 60], [330, -40]]}}],
    "springs": [{"between": ["rocker", "frame"], "points": [[40, 0], [160, 90]], "rate": 0.02, "free_length": 60}],
    "friction": {"pins": 0.05, "pin_radius": 8},
}


@pytest.mark.quick(1)
@pytest.mark.parametrize("layout", ["twin-rocker", "twin-cam"])
def test_forces_that_vary_over_the_rests_against_dense_rows(layout: str) -> None:
    design = made(layout=layout, loads=VARYING)
    least = []
    for rest in design.rests:
        phi = np.linspace(rest.start, rest.start + rest.width, 20_001)[1:-1]
        forces = design.machine.reactions(phi).unknowns["roller"][0]
        assert np.ptp(forces) > 0.1 * forces.max()
        assert rest.pressed["force"] == pytest.approx(forces.max(), rel=1e-4)
        assert rest.pressed["least_force"] == pytest.approx(forces.min(), rel=1e-4)
        assert rest.pressed["force"] >= forces.max() * (1.0 - 1e-12)
        assert rest.pressed["least_force"] <= forces.min() * (1.0 + 1e-12)
        least.append(rest.pressed["least_force"])
    of_strokes = [stroke.pressed["least_force"].value for stroke in design.strokes]
    assert design.least_contact_force == min(least + of_strokes)


def test_a_roller_pulled_off_its_cam_in_a_rest_is_found() -> None:
    """The device holds the rocker with 84.7 N m in the near rest, where 100 N m pull it away."""
    pull = {"forces": [{"on": "rocker", "torque": {"zones": [{"from": 270, "to": 300, "value": -100}]}}]}
    design = made(loads={**ROLLER, **pull})
    assert min(stroke.pressed["least_force"].value for stroke in design.strokes) > 0.0
    assert design.least_contact_force < 0.0
    assert [check.status for check in design.check("contact-loss")] == ["fail", "fail"]
