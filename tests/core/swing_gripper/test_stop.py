"""The stop in the near dwell, against the machine itself in small steps and the rebounds one by one.

Tolerances: the swing at the stop is of first order in the clearance; against the exact place at a tenth of it the
difference is of the second order, 1e-3 of it. Energies by central differences of 1e-4 rad: 1e-7.
"""

from __future__ import annotations

import math
from typing import Any

import factory
import numpy as np
import pytest
from pydantic import ValidationError

from gearlink.core.base.errors import NoSolution

STOP = {"radius": 280.0, "clearance": 0.05, "restitution": 0.4, "stiffness": 20_000.0}


def gripper(**keys: Any) -> Any:
    return factory.design("swing_gripper", command="gripper", stop=STOP, **keys)


def angles(design: Any, beta: float) -> tuple[float, float]:
    """Directions of cam rocker and coupler at a swing of the arm [rad]."""
    found = design.linkage.at((np.array([beta]),))
    return float(found.input.value[0]), float(found.coupler.value[0])


def test_at_the_swing_of_the_stop_the_roller_clears_its_cam() -> None:
    clearance = 0.005
    design = gripper(stop__clearance=clearance)
    turn = angles(design, design.raw("stop_angle"))[0] - angles(design, 0.0)[0]
    cam, arm = design.main_cam, design.cams.section.roller.arm
    path = cam.path(np.zeros(1), 1)
    center, pivot = complex(path.position[0]), -design.cams.from_pivot
    moved = pivot + (center - pivot) * np.exp(1j * turn)
    around = np.linspace(-0.05, 0.05, 200_001)
    profile = cam.at(np.mod(around, 2.0 * math.pi)).pitch
    gap = float(np.abs(profile - moved).min())
    assert abs(abs(center - pivot) - arm) < 1e-9
    assert gap == pytest.approx(clearance, rel=1e-3)


def test_the_force_is_the_work_of_the_spring_and_the_mass_the_energy() -> None:
    design, step = gripper(), 1e-4
    (a0, c0), (a1, c1) = angles(design, -step), angles(design, step)
    first, third = (a1 - a0) / (2.0 * step), (c1 - c0) / (2.0 * step)
    lever = STOP["radius"] * 1e-3
    assert design.raw("stop_force") == pytest.approx(400.0 * abs(first) / lever, rel=1e-7)
    linkage, mass = design.linkage, design.spec.inertia
    ends = [linkage.input * np.exp(1j * a) + 0.5 * linkage.coupler * np.exp(1j * c) for a, c in ((a0, c0), (a1, c1))]
    speed = abs(ends[1] - ends[0]) / (2.0 * step) * 1e-3
    twice = mass.output + mass.input * first**2 + mass.coupler * third**2 + mass.coupler_mass * speed**2
    assert design.raw("stop_mass") == pytest.approx(twice / lever**2, rel=1e-7)


@pytest.mark.parametrize("assembly", [1, -1])
@pytest.mark.parametrize("swing_sense", [1, -1])
@pytest.mark.parametrize("angle", [49.0, 120.0])
def test_the_stop_holds_the_arm_where_the_roller_leaves_its_cam(angle: float, swing_sense: int, assembly: int) -> None:
    """In the near dwell the cam is a circle about its axis: on the stop, a little into the swing, its roller is farther
    out; else the spring, which presses it on the cam, would turn the arm away from the stop."""
    keys = {"cam__roller__angle": angle, "cam__return_roller": None}
    design = gripper(**keys, swing_sense=swing_sense, assembly=assembly)
    turn = angles(design, 1e-4)[0] - angles(design, 0.0)[0]
    center, pivot = complex(design.main_cam.path(np.zeros(1), 1).position[0]), -design.cams.from_pivot
    moved = pivot + (center - pivot) * np.exp(1j * turn)
    if abs(moved) > abs(center):
        assert design.raw("stop_force") > 0.0
    else:
        with pytest.raises(NoSolution, match="turns the arm away"):
            design.raw("stop_force")


def test_the_law_meets_the_stop_where_it_is_said_to() -> None:
    design = gripper()
    rates = {"stop_impact_angle": "stop_impact_speed", "take_off_angle": "take_off_speed"}
    for place, speed in rates.items():
        at, step = math.degrees(design.raw(place)), 1e-4
        beta = design.law.evaluate(np.array([at - step, at, at + step]), 0)[0]
        assert beta[1] == pytest.approx(design.raw("stop_angle"), rel=1e-9)
        rate = abs(beta[2] - beta[0]) / math.radians(2.0 * step)
        assert design.raw(speed) == pytest.approx(STOP["radius"] * design.shaft_speed * rate, rel=1e-6)
    assert 170.0 < math.degrees(design.raw("stop_impact_angle")) < 290.0
    assert 0.0 < math.degrees(design.raw("take_off_angle")) < 100.0


def test_rebounds_one_by_one() -> None:
    design = gripper()
    speed, time = 1e-3 * design.raw("stop_impact_speed"), 0.0
    acceleration = design.raw("stop_force") / design.raw("stop_mass")
    for _ in range(200):
        speed *= STOP["restitution"]
        time += 2.0 * speed / acceleration
    assert design.raw("settling_time") == pytest.approx(1e3 * time, rel=1e-12)


def test_the_greatest_force_is_that_of_an_oscillator_that_meets_a_spring() -> None:
    design = gripper()
    mass, force, k = design.raw("stop_mass"), design.raw("stop_force"), 1e3 * STOP["stiffness"]
    w = math.sqrt(k / mass)
    time = np.linspace(0.0, math.pi / w * 1.5, 200_001)
    rest = force / k  # about which it swings
    way = rest - rest * np.cos(w * time) + 1e-3 * design.raw("stop_impact_speed") / w * np.sin(w * time)
    assert design.raw("stop_force_max") == pytest.approx(k * float(way.max()), rel=1e-8)
    assert gripper(stop__stiffness=None).raw("stop_force_max") is None


@pytest.mark.parametrize(
    ("keys", "status"),
    [({}, "pass"), ({"stop__restitution": 0.98}, "fail"), ({"stop__restitution": 0.975}, "warn")],
)
def test_settling_is_judged(keys: dict[str, Any], status: str) -> None:
    design = gripper(**keys)
    (found,) = design.check("stop-settling")
    left = 360.0 - math.degrees(design.raw("stop_impact_angle") + design.raw("settling_angle"))
    assert (found.code, found.status) == ("GL421", status)
    assert found.value == pytest.approx(left, abs=1e-9)


def test_a_clearance_that_reaches_the_constant_speed_is_refused() -> None:
    design = gripper(stop__clearance=45.0)
    with pytest.raises(NoSolution, match="where the constant speed begins") as refused:
        design.raw("take_off_angle")
    assert refused.value.key == "stop.clearance"
    most = float(refused.value.fix.split()[-2])
    assert gripper(stop__clearance=0.999 * most).raw("take_off_angle") > 0.0
    with pytest.raises(NoSolution, match="where the constant speed begins"):
        gripper(stop__clearance=1.001 * most).raw("take_off_angle")


@pytest.mark.parametrize("keys", [{"spring": None}, {"inertia": None}, {"stop__clearance": 0.0}])
def test_a_stop_needs_its_sections_and_a_clearance(keys: dict[str, Any]) -> None:
    with pytest.raises(ValidationError):
        gripper(**keys)


def test_without_a_stop_nothing_is_said_of_it() -> None:
    design = factory.design("swing_gripper", command="gripper")
    assert design.raw("stop_force") is None
    assert "stop-settling" not in design.outline("gripper").checks
