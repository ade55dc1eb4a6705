"""Guidance of a body: links that are found against those that made the poses, and against the motion itself.

Tolerances: closed forms to rounding times the condition of three points of a circle; searches to 1e-7 of the frame.
"""

from __future__ import annotations

import cmath
import math
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from factory import design

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.five_bar.guidance import circumcenter, in_order, is_ordered
from gearlink.core.machines.five_bar.path_motion import PathFiveBar

MAKER = PathFiveBar(22.0, 55.0, 62.0, 18.0, 50.0, Fraction(-1), math.radians(75.0))
OFFSET, TILT = complex(40.0, 12.0), math.radians(30.0)
GIVEN: dict[str, Any] = {
    "kind": "geared-five-bar",
    "form": "path",
    "gears": {"module": 2.5, "input": 20, "output": 20},
    "links": {"input": 25.0, "coupler": 60.0, "follower": 60.0, "output": 18.0},
    "phase": 75.0,
    "coupler_point": {"along": 30.0},
    "limits": {"transmission_angle": 20.0},
}


def poses(inputs: list[float], place: complex = 0j, direction: float = 0.0) -> list[list[float]]:
    """Poses that the maker goes through, seen from a frame that lies elsewhere."""
    found = []
    for degrees in inputs:
        phi = math.radians(degrees)
        point = place + cmath.exp(1j * direction) * MAKER.point(phi, OFFSET)
        found.append([point.real, point.imag, math.degrees(MAKER.coupler_angle(phi) + direction - TILT)])
    return found


def test_three_poses_give_back_their_maker() -> None:
    found = design(GIVEN, target={"poses": poses([20.0, 110.0, 250.0]), "keep": ["links.output", "phase"]})
    assert [found.input_length, found.coupler_length, found.follower_length] == pytest.approx(
        [22.0, 55.0, 62.0], rel=1e-9
    )
    assert found.offset == pytest.approx(OFFSET, rel=1e-9)
    assert found.body_angle == pytest.approx(TILT, rel=1e-9)
    assert np.degrees(found.guidance.inputs) == pytest.approx([20.0, 110.0, 250.0], rel=1e-9)
    assert found.pose_error_max < 1e-9
    assert found.pose_angle_error_max < 1e-11
    assert found.frame_place is None


@pytest.mark.slow
def test_three_poses_leave_output_and_phase_for_the_transmission_angle() -> None:
    found = design(GIVEN, target={"poses": poses([20.0, 110.0, 250.0])})
    assert found.pose_error_max < 1e-8
    assert found.input_length == pytest.approx(22.0, rel=1e-9)  # it does not depend on them
    assert found.min_transmission_angle >= math.degrees(0.0)
    kept = design(GIVEN, target={"poses": poses([20.0, 110.0, 250.0]), "keep": ["links.output", "phase"]})
    assert found.min_transmission_angle > kept.min_transmission_angle
    assert {each.status for each in found.report("analyze").checks if each.name in ("target", "pose-order")} == {"pass"}


@pytest.mark.slow
def test_free_frame_goes_through_five_poses() -> None:
    asked = poses([10.0, 60.0, 120.0, 200.0, 290.0], complex(-30.0, 45.0), math.radians(-35.0))
    found = design(GIVEN, target={"poses": asked, "frame": "free"})
    assert found.pose_error_max < 1e-6
    assert math.degrees(found.pose_angle_error_max) < 1e-6
    table = found.table("poses")
    place, direction = complex(*found.frame_place), found.frame_direction
    for row, phi in zip(asked, np.radians(table["input_angle"]), strict=True):
        point = place + cmath.exp(1j * direction) * found.bar.point(float(phi), found.offset)
        assert [point.real, point.imag] == pytest.approx(row[:2], abs=1e-6)


@pytest.mark.slow
def test_more_poses_take_a_tolerance() -> None:
    asked = poses([10.0, 80.0, 160.0, 240.0, 320.0])
    asked[2][0] += 0.2
    near = design(GIVEN, target={"poses": asked, "tolerance": 1.0, "angle_tolerance": 3.0})
    assert 1e-4 < near.pose_error_max < 1.0
    assert [each.status for each in near.check("target")] == ["pass", "pass"]
    assert near.pose_error_rms <= near.pose_error_max
    strict = design(GIVEN, target={"poses": asked, "tolerance": 1e-5})
    assert [each.status for each in strict.check("target")] == ["fail"]


def test_order() -> None:
    order = in_order(np.radians([20.0, 250.0, 110.0, 300.0]))
    assert not is_ordered(order)
    assert is_ordered(in_order(np.radians([350.0, 20.0, 300.0])))
    kept = {"keep": ["links.output", "phase"]}
    mixed = design(GIVEN, target={"poses": poses([20.0, 110.0, 250.0])[::-1], **kept})
    assert [each.status for each in mixed.check("pose-order")] == ["pass"]  # they fall


def test_circle_through_three_points() -> None:
    center, points = complex(3.0, -2.0), 5.0 * np.exp(1j * np.array([0.2, 1.9, 4.0]))
    assert circumcenter(points + center) == pytest.approx(center, abs=1e-14)


def test_refusals() -> None:
    line = [[0.0, 0.0, 10.0], [10.0, 0.0, 10.0], [20.0, 0.0, 10.0]]
    with pytest.raises(NoSolution) as refused:
        design(GIVEN, target={"poses": line}).report("analyze")
    assert refused.value.key == "target.poses"
    for target, words in (
        ({"poses": poses([0.0, 90.0, 180.0, 270.0])}, "at most 3"),
        ({"poses": poses([0.0, 50.0, 90.0, 180.0, 230.0, 270.0]), "frame": "free"}, "at most 5"),
        ({"poses": poses([0.0, 90.0]), "points": [[0.0, 0.0], [1.0, 1.0], [2.0, 0.0]]}, "exclude"),
    ):
        with pytest.raises(ValueError, match=words):
            design(GIVEN, target=target)
