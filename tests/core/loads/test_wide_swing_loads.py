"""Loads of a wide-swing stroke: the reference without its device, and the contact with it; 1e-7 as it was printed."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import factory
import numpy as np
import pytest

DATA = json.loads((Path(__file__).parents[2] / "reference" / "loads.json").read_text())
EXPECTED = DATA["wide_swing"]["expected"]
K = np.array(EXPECTED["k"])


@pytest.fixture(scope="module")
def swing() -> Any:
    loads = {"roller": {"width": 20}, "vibration": {"frequency": 60, "damping": 0, "allowed_residual": 0.2}}
    return factory.design("wide_swing_twin_cam", command="loads", loads=loads)


def test_stroke_against_the_reference(swing: Any) -> None:
    assert swing.inertia_torque(K) == pytest.approx(EXPECTED["torque"], rel=1e-7)
    assert swing.relative_radius(K) == pytest.approx(EXPECTED["relative_radius"], rel=1e-7)
    assert swing.inertia_torque(K) * swing.ratio(K) == pytest.approx(EXPECTED["cam_torque"], rel=1e-7)
    # With its device the cam carries what the device gives too much, the other way.
    without = -swing.force(K) / swing.spec.unloader.reserve
    assert without == pytest.approx(EXPECTED["contact_force"], rel=1e-7)


def test_torque_of_the_cam_is_that_of_the_contact(swing: Any) -> None:
    """By power, and by the pressure angle: T = N r cos(delta)."""
    cam = swing.cam
    lever = 1e-3 * cam.rocker_radius * np.cos(cam.pressure_angle(K))
    assert swing.force(K) * lever == pytest.approx(np.abs(swing.torque(K)), rel=1e-12)


def test_residual_after_the_stroke_by_another_integral(swing: Any) -> None:
    """Simpson over 200001 rows in time; 1e-8 of the swing."""
    n = 200_001
    u = np.linspace(0.0, 1.0, n)
    time = swing.cam.cycle_angle / swing.speed
    bend = swing.design.motion.plain_law.invariants(u, 2)[2] * 120.0 / time**2
    w = 2.0 * math.pi * 60.0
    weights = np.ones(n)
    weights[1:-1:2], weights[2:-1:2] = 4.0, 2.0
    whole = np.sum(weights * bend * np.exp(1j * w * time * (1.0 - u))) * time / (3.0 * (n - 1))
    assert swing.residual_amplitude == pytest.approx(abs(whole) / w, abs=1e-8 * 120.0)


def test_every_result_can_be_asked_for(swing: Any) -> None:
    report = swing.report("loads", tables=("spectrum",))
    assert {table.name for table in report.tables} == {"contact_stroke", "spectrum"}
    assert all(math.isfinite(quantity.value) for quantity in report.quantities)
