"""The cam of the fingers, against the arm and the cam in the machine's frame.

Tolerances: points to 1e-9 mm, rates by differences of 1e-3 deg to 1e-6.
"""

from __future__ import annotations

import math
from typing import Any

import factory
import numpy as np
import pytest
from pydantic import ValidationError

from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.cams.disc_cam import DiscCam

DEGREES = np.array([0.0, 55.0, 103.0, 107.0, 111.0, 150.0, 200.0, 260.0, 318.0, 330.0, 345.0, 355.0])


FINGERS = {
    "lever": 35.0,
    "pivot": 60.0,
    "angle": 100.0,
    "roller_radius": 8.0,
    "length": 30.0,
    "open_angle": 25.0,
    "open": {"from": 102.0, "over": 8.0},
    "close": {"to": 352.0, "over": 40.0},
}
"""A cam that the roller cuts away where the fingers open."""


def gripper(**keys: Any) -> Any:
    return factory.design("swing_gripper_stop", command="gripper", **({"fingers": FINGERS} | keys))


@pytest.mark.parametrize("mirrored", [False, True])
def test_the_roller_meets_the_cam_in_the_frame_of_the_machine(mirrored: bool) -> None:
    keys: dict[str, Any] = {}
    if mirrored:
        keys = {"swing_sense": 1, "assembly": -1, "output_direction": 70.0, "arm__direction": 55.0, "cam": None}
        keys |= {"pivots": {"input": [-230, 0], "output": [-498, 55]}, "stop": None, "spring": None, "inertia": None}
        keys |= {"links": {"input": 150, "coupler": 260, "output": 100}}
    design = gripper(**keys)
    section, sense = design.spec.fingers, design.spec.swing_sense
    beta = design.law.evaluate(DEGREES, 0)[0]
    opening = design.fingers.opening(DEGREES, 0)[0]
    on_arm = section.pivot + section.lever * np.exp(1j * (math.radians(section.angle) + opening))
    # The arm turns by s beta from the pick-up position, the cam by theta the other way.
    in_machine = on_arm * np.exp(1j * sense * beta)
    in_cam = in_machine * np.exp(1j * sense * np.radians(DEGREES))
    pitch = design.fingers.cam.points(np.radians(DEGREES) + beta)[0]
    np.testing.assert_allclose(pitch, in_cam, rtol=0.0, atol=1e-9)


def test_the_path_has_the_rates_of_its_differences() -> None:
    cam, phi, step = gripper().fingers.cam, np.radians(np.arange(3.0, 360.0, 17.0)), 1e-4
    path = cam.path(phi, 2)
    before, after = (cam.path(phi + k * step, 2) for k in (-1, 1))
    np.testing.assert_allclose(path.first, (after.position - before.position) / (2.0 * step), rtol=0.0, atol=1e-4)
    np.testing.assert_allclose(path.second, (after.first - before.first) / (2.0 * step), rtol=0.0, atol=1e-2)


def test_the_fingers_open_and_close_where_the_file_says() -> None:
    design = gripper()
    whole = math.radians(design.spec.fingers.open_angle)
    eta = design.fingers.opening(np.array([0.0, 102.0, 106.0, 110.0, 312.0, 332.0, 352.0, 359.0]), 0)[0]
    np.testing.assert_allclose(eta / whole, [0.0, 0.0, 0.5, 1.0, 1.0, 0.5, 0.0, 0.0], rtol=0.0, atol=1e-12)
    assert design.raw("finger_lift") == pytest.approx(30.0 * design.fingers.opened, rel=1e-12)


@pytest.mark.parametrize(("start", "status"), [(102.0, "pass"), (104.0, "fail")])
def test_fingers_that_still_hold_the_sheet_are_told_of(start: float, status: str) -> None:
    design = gripper(fingers__open={"from": start, "over": 8.0})
    (found,) = design.check("finger-release")
    assert (found.code, found.status, found.limit) == ("GL423", status, 12.5)
    assert found.value == pytest.approx(math.degrees(design.fingers.opened), rel=1e-12)


def test_fingers_that_close_before_they_are_open_are_refused() -> None:
    with pytest.raises(ValidationError, match="let them close later"):
        gripper(fingers__close={"to": 352.0, "over": 250.0})


def test_fingers_rest_before_and_after() -> None:
    with pytest.raises(NoSolution, match="rest-to-speed") as refused:
        gripper(fingers__open={"from": 102.0, "over": 8.0, "law": "velocity-345"}).raw("finger_lift")
    assert refused.value.key == "fingers.open.law"


def test_without_fingers_nothing_is_said_of_them() -> None:
    design = gripper(fingers=None)
    assert design.raw("finger_lift") is None
    with pytest.raises(NoSolution, match="section fingers"):
        design.table("finger_cam")


def test_the_cam_of_the_fingers_is_judged_as_others_are() -> None:
    """Undercut where 1/curvature, by differences of the path, falls below the roller; none in the worked design."""
    for design, status in ((gripper(), "fail"), (factory.design("swing_gripper_stop", command="gripper"), "pass")):
        cam = design.fingers.cam
        pitch = cam.points(np.linspace(0.0, 2.0 * math.pi, 40_001))[0]
        first, second = np.gradient(pitch), np.gradient(np.gradient(pitch))
        bend = (first.conj() * second).imag / np.abs(first) ** 3 * -cam.sense
        inside = bend[5:-5].max()
        assert (8.0 * inside >= 1.0) == (status == "fail")
        for name in ("cam-undercut", "pressure-angle"):
            (found,) = [each for each in design.check(name) if "finger" in each.what]
            assert found.status == status
        assert cam in design.discs


@pytest.mark.parametrize("fingers", [FINGERS, None])
def test_extremes_over_the_cylinder_angle_are_those_over_the_cam_angle(fingers: Any) -> None:
    """Sought the other way, with the cylinder angle solved for at each cam angle; places to the root of rounding."""
    keys = {} if fingers is None else {"fingers": fingers}
    cam = factory.design("swing_gripper_stop", command="gripper", **keys).fingers.cam
    other = DiscCam(cam.name, cam.path, cam.sense, cam.roller_radius, cam.joints, cam.key)
    for name in ("max_pressure_angle", "most_convex"):
        found, expected = getattr(cam, name), getattr(other, name)
        assert found.value == pytest.approx(expected.value, rel=1e-11)
        assert found.place == pytest.approx(expected.place, abs=1e-6)
    assert cam.least_support == pytest.approx(other.least_support, rel=1e-11)


def test_an_arm_that_returns_as_fast_as_the_cylinder_turns_has_no_cam_of_its_fingers() -> None:
    design = gripper(phases={"accelerate": 100, "constant": 12, "decelerate": 50, "far_dwell": 8, "return": 60})
    with pytest.raises(NoSolution, match="returns as fast as the cam of the fingers turns, at cylinder angle"):
        design.check("cam-undercut")
    slow = {"accelerate": 100, "constant": 12, "decelerate": 50, "far_dwell": 8, "return": 150}
    assert gripper(phases=slow).fingers.cam.max_pressure_angle.value > 0.0


def test_a_roller_of_the_fingers_that_passes_the_pole_is_refused_at_the_cam_angle() -> None:
    design = gripper(fingers=FINGERS | {"open": {"from": 102.0, "over": 0.5}, "open_angle": 120.0})
    with pytest.raises(NoSolution, match="passes the relative pole") as refused:
        _ = design.fingers.cam.max_pressure_angle
    assert refused.value.key == "fingers"
