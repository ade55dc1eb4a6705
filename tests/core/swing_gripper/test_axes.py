"""Drum and gripper arm beside the axes of cam and cam rocker, against points along the arm in many places."""

from __future__ import annotations

import cmath
import math
from typing import Any

import factory
import numpy as np
import pytest

from gearlink.core.machines.swing_gripper.design import room_beside_arm


def warned(made: Any) -> dict[str, float]:
    """Values of the warnings of GL302, by what they are of."""
    return {"; ".join(check.lines): check.value for check in made.check("shaft-clearance") if check.status == "warn"}


def test_a_drum_over_the_cam_shaft_is_warned_of() -> None:
    """Turned by arm.direction alone, the drum stood round the cam shaft, and every check passed."""
    made = factory.design("swing_gripper", arm__direction=211)
    drum = complex(made.handover_center)
    assert abs(drum) < 135.0 - 40.0  # the cam axis is the origin
    (text, value), *_ = [item for item in warned(made).items() if "cam shaft" in item[0]]
    assert "overlap of the cylinder that takes the sheet and the cam shaft" in text
    assert value == pytest.approx(abs(drum) - 135.0 - 40.0, rel=1e-12)


def test_no_limit_takes_the_drum_off_the_cam_shaft() -> None:
    """limits.handover_place had said too which axes are one."""
    made = factory.design("swing_gripper", arm__direction=211, limits={"handover_place": 1e6})
    assert [
        text for text in warned(made) if "overlap of the cylinder that takes the sheet" in text and "cam shaft" in text
    ]


@pytest.mark.quick(2)
@pytest.mark.parametrize(
    ("arms", "angle", "beside"),
    [
        ((100.0, 100.0), 178.0, 100.0 * math.cos(math.radians(89.0))),
        ((120.0, 110.0), 88.0, None),
        ((40.0, 100.0), 140.0, 4000.0 * math.sin(math.radians(140.0))),
        ((20.0, 100.0), 40.0, 20.0),  # the foot lies beyond the spring's end
    ],
)
def test_a_spring_across_the_axis_of_its_rockers_is_warned_of(
    arms: tuple[float, float], angle: float, beside: float | None
) -> None:
    """The lever of the torque, p q sin(delta)/L, where the foot lies within the spring."""
    if beside is not None and beside > max(arms):
        beside /= math.sqrt(arms[0] ** 2 + arms[1] ** 2 - 2.0 * arms[0] * arms[1] * math.cos(math.radians(angle)))
    made = factory.design("swing_gripper", spring={"arms": list(arms), "angle": angle, "preload": 9000.0})
    found = {text: value for text, value in warned(made).items() if "spring" in text}
    assert list(found.values()) == ([] if beside is None else [pytest.approx(beside, rel=1e-12)])
    assert all("spring.arms" in text or "spring.angle" in text for text in found)


def test_a_cam_on_the_shaft_of_the_drum_is_none_of_it() -> None:
    made = factory.design("swing_gripper", arm__direction=211)
    drum = made.handover_center
    coaxial = factory.design("swing_gripper", arm__direction=211, cam__center=[drum.real, drum.imag])
    assert not [text for text in warned(coaxial) if "takes the sheet" in text and "cam shaft" in text]
    assert not warned(factory.design("swing_gripper"))


def test_an_arm_over_the_axis_of_the_cam_rocker_is_warned_of() -> None:
    made = factory.design("swing_gripper", arm__direction=211)
    arm, between = made.spec.arm.length, abs(complex(*made.spec.pivots.input) - complex(*made.spec.pivots.output))
    (text, value), *_ = [item for item in warned(made).items() if "gripper arm" in item[0]]
    assert "overlap of the gripper arm and the cam rocker's axis" in text
    assert value == pytest.approx(between - arm, rel=1e-12)


@pytest.mark.quick(2)
@pytest.mark.parametrize(("arm", "radius", "reaches"), [(28.0, 30.0, True), (40.0, 30.0, True), (61.0, 30.0, False)])
def test_a_roller_over_the_axis_of_its_own_rocker_is_warned_of(arm: float, radius: float, reaches: bool) -> None:
    """On an arm shorter than its radius a roller stands round the pivot; nothing was said of it."""
    both = {"cam__roller__arm": arm, "cam__roller__radius": radius, "cam__return_roller__arm": arm}
    made = factory.design(
        "swing_gripper",
        **both,
        cam__return_roller__radius=radius,
        cam__return_roller__angle=150,
        cam__center=[135, -57],
    )
    found = {text: value for text, value in warned(made).items() if "roller" in text and "rocker's axis" in text}
    found = {text: value for text, value in found.items() if "main roller" in text}
    assert list(found.values()) == ([pytest.approx(arm - radius, rel=1e-12)] if reaches else [])


def test_the_thinnest_shaft_that_would_be_built_takes_the_place_of_the_roller() -> None:
    """Nothing is wrong with the worked gripper until its shafts are to be as thick as a barrel."""
    assert not warned(factory.design("swing_gripper", limits={"least_shaft": 30.0}))
    found = warned(factory.design("swing_gripper", limits={"least_shaft": 250.0}, cam__shaft_radius=0.0))
    assert len(found) > 8
    near = [text for text in found if "overlap" not in text and "sweeps over" not in text]
    assert near
    assert all("(limit >= 250 mm; minimum shaft radius, limits.least_shaft)" in text for text in near)
    crossed = {"arms": [100.0, 100.0], "angle": 178.0, "preload": 9000.0}
    assert not warned(factory.design("swing_gripper", limits={"least_shaft": 1.5}, spring=crossed))


@pytest.mark.parametrize("sense", [1, -1])
def test_room_beside_the_arm(sense: int) -> None:
    """Sampled arms are as far from points around them as the closed form says, to the step of the samples."""
    made = factory.design("swing_gripper", swing_sense=sense)
    pivot, swing = complex(*made.spec.pivots.output), made.law.total_swing
    turns = math.radians(125.0) + sense * np.linspace(0.0, swing, 400)
    along = np.linspace(0.0, 300.0, 301)
    points = pivot + along[:, None] * np.exp(1j * turns)
    over = 0
    for radius, angle in ((r, a) for r in (20.0, 150.0, 290.0, 330.0) for a in np.arange(0.1, 6.2, 0.5)):
        place = pivot + cmath.rect(radius, angle)
        room = room_beside_arm(made, place)
        nearest = float(np.abs(points - place).min())
        if room < 0.0:
            over += 1
            assert nearest < 0.8
            assert room == pytest.approx(radius - 300.0, rel=1e-12)
        else:
            assert nearest == pytest.approx(room, abs=0.8)
    assert over
