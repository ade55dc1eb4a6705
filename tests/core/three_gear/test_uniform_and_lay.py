"""Even stretches, the front lay, feed by step, and instant centres: against fine rows and the poles' own geometry.

Tolerances: sliding windows over rows are good to two rows; closed forms to rounding.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from factory import design
from sweeps import ALL

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.three_gear.families import window_of_family
from gearlink.core.parts.linkages.feed import gentlest
from gearlink.core.parts.linkages.standstills import Turning

FEED: dict[str, Any] = {
    "kind": "three-gear-four-bar",
    "gears": {"module": 2.0, "crank": 20, "idler": 21, "output": 20},
    "links": {"crank": 7.125067096538422, "frame": 57.543317760360544},
}
RING: dict[str, Any] = {
    "kind": "three-gear-four-bar",
    "gears": {"module": 2.5, "crank": 20, "idler": 20, "output": 60},
    "links": {"crank": 16.0, "frame": 122.83941479186771},
}


def longest(values: np.ndarray, rho: float) -> tuple[int, int]:
    """Rows of the longest cyclic stretch of positive values with max/min <= rho."""
    twice, best, first, place = np.concatenate([values, values]), 0, 0, 0
    for last in range(twice.size):
        while (
            last - first >= values.size
            or np.min(twice[first : last + 1]) <= 0.0
            or (np.max(twice[first : last + 1]) > rho * np.min(twice[first : last + 1]))
        ):
            first += 1
            if first > last:
                break
        if last - first > best:
            best, place = last - first, first
    return best, place % values.size


@pytest.mark.quick(1)
@pytest.mark.parametrize("share", [0.005, 0.02, 0.1])
@pytest.mark.parametrize("data", [FEED, RING, "candy_feed"])
def test_even_stretch_is_that_of_a_sliding_window(data: Any, share: float) -> None:
    found = design(data, uniform_tolerance=share)
    table = found.table("motion", samples=1440)
    rows, _ = longest(np.asarray(table["speed_ratio"]), (1.0 + share) / (1.0 - share))
    assert math.degrees(found.uniform_angle) == pytest.approx(0.25 * rows, abs=0.51)
    inside = np.linspace(found.uniform_start, found.uniform_start + found.uniform_angle, 721)
    ratio = [found.output.ahead.speed(x) for x in inside]
    assert max(ratio) / min(ratio) == pytest.approx((1.0 + share) / (1.0 - share), rel=1e-6)
    assert found.uniform_ratio == pytest.approx(0.5 * (max(ratio) + min(ratio)), rel=1e-6)


def test_window_of_equal_gears_in_closed_form() -> None:
    found = design(FEED, uniform_tolerance=0.02)
    assert found.uniform_angle == pytest.approx(window_of_family(found.frame_ratio, 1.0 - found.i3, 0.02), rel=1e-9)
    assert design(FEED, uniform_tolerance=0.9).uniform_angle == pytest.approx(2.0 * math.pi, rel=1e-15)
    made = design(FEED, command="synth variable-speed", links=None, gears__idler=30,
                  speed={"uniform_angle": 80.0, "uniform_tolerance": 0.03})  # fmt: skip
    assert math.degrees(made.uniform_angle) == pytest.approx(80.0, rel=1e-9)
    assert made.back_step_angle is None
    shorter = window_of_family(made.frame_ratio * 0.999, 1.0 - made.i3, 0.03)
    assert shorter < made.uniform_angle


TWO_GEARS: dict[str, Any] = {
    "kind": "two-gear-four-bar",
    "gears": {"module": 2.0, "planet": 16, "sun": 12},
    "links": {"coupler": 60.0, "rocker": 80.0, "frame": 90.0},
}


@pytest.mark.quick(1)
@pytest.mark.parametrize(("given", "distance"), [(FEED, 5.0), (FEED, 20.0), (FEED, 60.0), (TWO_GEARS, 20.0)])
def test_gentlest_arrival_is_the_least_of_all(given: Any, distance: float) -> None:
    keys: dict[str, Any] = {"input_speed": 200.0}
    keys |= {"feed": {"radius": 40.0, "lay": {"distance": distance, "speed": 470.0}}}
    found = design(given, **keys)
    each = []
    for angle in np.arange(0.0, 360.0, 3.0 if ALL else 6.0):
        keys["feed"]["lay"]["angle"] = float(angle)
        one = design(given, **keys)
        each.append(one.lay_speed)
        phi = np.linspace(one.lay.start, one.lay.end, 181)
        ratio = np.array([one.running[0](x) for x in phi])
        assert one.lay_speed == pytest.approx(ratio.max() * 40.0 * one.angular_speed, rel=1e-4)
        assert 40.0 * float(np.trapezoid(ratio, phi)) == pytest.approx(distance, rel=1e-4)
        assert one.arrival_speed == pytest.approx(ratio[-1] * 40.0 * one.angular_speed, rel=1e-12)
    assert found.lay_speed <= min(each) * (1.0 + 1e-12)
    assert found.lay_speed == pytest.approx(min(each), rel=2e-2)
    assert found.arrival_speed is None
    assert found.lay_time == pytest.approx((found.lay.end - found.lay.start) / found.angular_speed * 1e3, rel=1e-13)
    status = [one.status for one in found.check("lay-speed")]
    assert status == ["pass" if found.lay_speed <= 470.0 else "fail"]


def test_feed_by_step() -> None:
    assert design(FEED, feed={"step": 200.0}).feed_radius == pytest.approx(100.0 / math.pi, rel=1e-12)
    assert design(FEED, feed={"step": 200.0}).feed_per_turn == pytest.approx(200.0, rel=1e-12)
    belt = design(FEED, feed={"step": 200.0, "belt_thickness": 2.0})
    assert belt.feed_radius == pytest.approx(100.0 / math.pi - 1.0, rel=1e-12)
    same = design(FEED, feed={"radius": belt.feed_radius, "belt_thickness": 2.0})
    assert same.feed_per_turn == pytest.approx(200.0, rel=1e-12)
    chain = design(FEED, feed={"step": 101.6, "pitch": 12.7, "teeth": 16})
    assert chain.feed_ratio == pytest.approx(0.5, rel=1e-12)
    assert chain.feed_per_turn == pytest.approx(101.6, rel=1e-12)
    rounded = design(FEED, feed={"step": 100.0, "pitch": 12.7, "ratio": 0.5})
    assert rounded.feed_teeth == 16
    assert rounded.feed_per_turn == pytest.approx(101.6, rel=1e-12)
    assert [each.status for each in rounded.check("rounded-ratio")] == ["warn"]
    for feed, words in (
        ({"step": 100.0, "radius": 40.0}, "radius"),
        ({"step": 100.0, "pitch": 12.7, "teeth": 16, "ratio": 0.5}, "ratio"),
        ({"step": 100.0, "pitch": 12.7}, "pitch and ratio"),
        ({"radius": 40.0, "lay": {"distance": 20.0, "speed": 470.0}}, "input_speed"),
    ):
        with pytest.raises(ValueError, match=words):
            design(FEED, feed=feed)
    with pytest.raises(NoSolution) as refused:
        design(FEED, input_speed=200.0, feed={"radius": 40.0, "lay": {"distance": 260.0, "speed": 470.0}}).lay_speed  # noqa: B018
    assert refused.value.key == "feed.lay.distance"
    back = design("candy_feed", command="synth dwell", input_speed=100.0,
                  feed={"radius": 40.0, "lay": {"distance": 20.0, "speed": 470.0}})  # fmt: skip
    with pytest.raises(NoSolution, match="moves backwards"):
        back.lay_speed  # noqa: B018


def test_a_back_step_elsewhere_does_not_keep_the_sheet_from_the_lay() -> None:
    """W = 1 + 0.5 sin x + 0.9 cos 2x goes below 0 about 270 deg, and has a minimum of 0.6 at 90 deg."""
    flat = math.asin(0.5 / 3.6)
    extremes = [Turning(x, speed(x)) for x in (0.5 * math.pi, math.pi - flat, 1.5 * math.pi, 2.0 * math.pi + flat)]
    assert min(each.value for each in extremes) < -0.3
    for order in (extremes, extremes[::-1]):
        found = gentlest(speed, travel, order, 0.3)
        assert found.start + found.end == pytest.approx(math.pi, abs=1e-9)
        assert travel(found.end) - travel(found.start) == pytest.approx(0.3, rel=1e-9)
        assert found.greatest == pytest.approx(speed(found.end), rel=1e-9)
    # what is left is the way about the back-step
    with pytest.raises(NoSolution, match=r"speed ratio -0\.4"):
        gentlest(speed, travel, extremes[1:], 0.3)


def speed(x: float) -> float:
    return 1.0 + 0.5 * math.sin(x) + 0.9 * math.cos(2.0 * x)


def travel(x: float) -> float:
    return x - 0.5 * math.cos(x) + 0.45 * math.sin(2.0 * x)


@pytest.mark.parametrize("data", [FEED, RING, "ring_feed"])
def test_poles_give_the_speed_by_their_distances(data: Any) -> None:
    """W = AP15/DP15; each pole has one velocity on both of its bodies."""
    found = design(data) if data != "ring_feed" else design(data, command="synth dwell")
    table = found.table("poles", samples=48)
    x, frame = table["P15_x"], found.frame_length
    finite = np.isfinite(x)  # where both gears turn at one speed, P15 is at infinity
    assert (x / (x - frame))[finite] == pytest.approx(table["speed_ratio"][finite], rel=1e-8)
    assert table["speed_ratio"][~finite] == pytest.approx(np.ones(np.count_nonzero(~finite)), abs=1e-12)
    phi = np.radians(table["crank_angle"])
    links = found.moving.at(phi, 1).links
    for name, one, other in (("P13", "crank", "idler"), ("P35", "idler", "output")):
        place = table[f"{name}_x"] + 1j * table[f"{name}_y"]
        speeds = []
        for link in (links[one], links[other]):
            speeds.append(link.origin.first + 1j * link.turn.first * (place - link.origin.value))
        assert np.abs(speeds[0] - speeds[1]).max() < 1e-9 * frame
    errors = found.dwell_pole_line_error
    assert errors is None or max(errors) < 1e-6 * frame
