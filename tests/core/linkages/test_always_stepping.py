"""Linkages that step back with every frame, against windows that are read off dense positions of their own.

Positions here are those of two circles that meet, nothing of the program's. A window on a grid of 0.5 deg is up to two
steps shorter than the exact one, and never longer than the longest of any frame but for these steps.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Callable
from typing import Any, NamedTuple

import factory
import numpy as np
import pytest
from scipy.ndimage import maximum_filter1d, minimum_filter1d

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.planet_linkages.two_gear_family import Family
from gearlink.core.machines.planet_linkages.two_gear_family import always_stepping as two_gear_frames
from gearlink.core.machines.three_gear.dwell_synthesis import always_stepping as three_gear_frames
from gearlink.core.machines.three_gear.families import with_crank
from gearlink.core.machines.three_gear.train import GearTrain
from gearlink.core.parts.linkages.band_dwell import AlwaysStepping, keeping

STEP = 0.5  # deg
GRID = np.radians(np.arange(0.0, 720.0, STEP))


def angles(a: float, b: float, c: float, d: float, assembly: int) -> tuple[Any, Any]:
    """Directions of coupler and rocker over two revolutions, by the triangle of B, C and D."""
    to_d = d - a * np.exp(1j * GRID)
    length = np.abs(to_d)
    inner = np.arccos((b * b + length**2 - c * c) / (2.0 * b * length))
    coupler = np.angle(to_d) + assembly * inner
    rocker = np.angle(a * np.exp(1j * GRID) + b * np.exp(1j * coupler) - d)
    return np.unwrap(coupler), np.unwrap(rocker)


def scanned_window(output: Any, tolerance: float) -> float:
    """Longest window [deg] within +- a tolerance [rad] among the samples of two revolutions."""

    def too_long(steps: int) -> bool:
        samples = steps + 1
        half = samples // 2
        inside = slice(half, len(output) - half)
        spread = maximum_filter1d(output, samples)[inside] - minimum_filter1d(output, samples)[inside]
        return bool(spread.min() > 2.0 * tolerance)

    return (bisect_left(range(len(output) // 2 + 1), True, key=too_long) - 1) * STEP


class Case(NamedTuple):
    """Frames of a design, and its output [rad] over two revolutions at one of them."""

    name: str
    frames: AlwaysStepping
    output: Callable[[float], Any]
    links: tuple[float, float, float]


def two_gears(planet: int, ring: int, coupler: float, rocker: float, assembly: int = 1) -> Case | None:
    """Module 2."""
    ratio = planet / ring
    try:
        frames = two_gear_frames(Family(float(ring - planet), coupler, rocker, ratio, assembly))
    except NoSolution:
        return None
    links = float(ring - planet), coupler, rocker

    def output(frame: float) -> Any:
        return (1.0 - ratio) * GRID + ratio * angles(*links, frame, assembly)[0]

    name = f"{planet}/{ring} {coupler:.5g} {rocker:.5g}"
    return None if frames is None else Case(name, frames, output, links)


def three_gears(z1: int, z3: int, z5: int, crank: float, assembly: int = 1) -> Case | None:
    """Module 2, so that radii are teeth; z5 < 0 is a ring round the train."""
    i2, i3 = -z1 / z3, -z3 / z5
    links = crank, float(z1 + z3), float(abs(z3 + z5))
    try:
        frames = three_gear_frames(with_crank(float(z1), float(z3), float(z5), crank, assembly), GearTrain(z1, z3, z5))
    except NoSolution:
        return None

    def output(frame: float) -> Any:
        coupler, rocker = angles(*links, frame, assembly)
        return i3 * (i2 * GRID + (1.0 - i2) * coupler) + (1.0 - i3) * rocker

    return None if frames is None else Case(f"{z1}/{z3}/{z5} {crank:.5g}", frames, output, links)


def named() -> list[Case]:
    """Those that a user asked for and was refused."""
    found = [
        two_gears(44, 69, 45.28, 72.727),
        two_gears(47, 63, 21.043, 56.683),
        two_gears(49, 69, 40.848, 61.501),
        three_gears(54, 78, 49, 72.778),
        three_gears(31, 70, -148, 31.906),
    ]
    return [each for each in found if each is not None]


def drawn(count: int, seed: int) -> list[Case]:
    """Gears and links at random, two gears and three by turns, whose output steps back with every frame."""
    rng = np.random.default_rng(seed)
    found: list[Case] = []
    while len(found) < count:
        planet, assembly = int(rng.integers(20, 60)), int(rng.choice((-1, 1)))
        if len(found) % 2:
            ring = planet + int(rng.integers(12, 50))
            b, c = ((ring - planet) * math.exp(rng.uniform(0.1, 1.3)) for _ in range(2))
            case = two_gears(planet, ring, b, c, assembly)
        else:
            idler, more = (int(rng.integers(20, 90)) for _ in range(2))
            last = more if len(found) % 4 else -(planet + idler + more)
            case = three_gears(planet, idler, last, planet * rng.uniform(1.02, 1.6), assembly)
        if case is not None and case.frames.high - case.frames.low > 5.0:
            found.append(case)
    return found


CASES = [*named(), *drawn(32, 8)]


def test_the_named_ones_are_there() -> None:
    assert len(named()) == 5


@pytest.mark.slow
@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
@pytest.mark.parametrize("share", [0.03, 0.7])
def test_no_frame_has_a_longer_window(case: Case, share: float) -> None:
    """For bands narrower than every back-step, and for those that a longer one fills."""
    frames = case.frames
    least, most = 0.5 * frames.least_step[1], 0.5 * max(frames.step(frames.low), frames.step(frames.high))
    tolerance = min(
        share * least if share < 0.1 else least + 0.2 * (most - least), 0.9 * math.pi * frames.valley(frames.low).mean
    )
    frame, window = frames.longest(tolerance)
    limit = math.degrees(window)
    scanned = [scanned_window(case.output(x), tolerance) for x in np.linspace(frames.low, frames.high, 13)]
    assert max(scanned) <= limit + 1e-6
    # the frame that fills its band does so to rounding: read off a hair inside of it
    assert limit - 2.0 * STEP <= scanned_window(case.output(frame), tolerance * (1.0 + 1e-6)) <= limit + 0.01


@pytest.mark.quick(1)
@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
@pytest.mark.parametrize("window", [12.0, 50.0, 140.0])
def test_no_frame_is_flatter(case: Case, window: float) -> None:
    frames = case.frames
    frame, least = frames.flattest(math.radians(window))
    assert scanned_window(case.output(frame), least * (1.0 + 1e-6)) >= window - 2.0 * STEP
    narrower = 0.99 * least
    others = np.linspace(frames.low, frames.high, 13)
    assert max(scanned_window(case.output(x), narrower) for x in others) <= window


@pytest.mark.parametrize("case", named(), ids=lambda case: case.name)
def test_frames_that_keep_a_transmission_angle(case: Case) -> None:
    """The angle between coupler and rocker, over the revolution, at the ends of those frames and beyond them."""

    def least(frame: float) -> float:
        coupler, rocker = angles(*case.links, frame, 1)
        return float(np.degrees(np.arcsin(np.abs(np.sin(coupler - rocker)).min())))

    assert len(keeping(case.frames, *case.links, math.radians(89.9))) == 1
    kept, whole = keeping(case.frames, *case.links, math.radians(10.0))
    assert whole is case.frames
    for end, outward in ((kept.low, -1e-2), (kept.high, 1e-2)):
        assert least(end) >= 10.0
        if whole.low < end + outward < whole.high:
            assert least(end + outward) < 10.0


def test_long_windows_reach_beyond_the_greatest_speed() -> None:
    """Both ends of such a window lie to one side of the maximum speed; it was cut off there, at 260 deg."""
    case = two_gears(47, 63, 21.043, 56.683)
    assert case is not None
    drive = Family(16.0, 21.043, 56.683, 47 / 63).drive(61.7259)
    for tolerance in (math.radians(degrees) for degrees in (18.45, 18.944, 21.0, 25.0)):
        scanned = scanned_window(case.output(61.7259), tolerance)
        assert scanned > 290.0
        assert math.degrees(drive.within(tolerance).crank_angle) == pytest.approx(scanned, abs=2.0 * STEP)


# The designs


RING = {"gears": {"module": 2.0, "planet": 44, "ring": 69}, "links": {"coupler": 45.28, "rocker": 72.727}}
TRAIN = {"module": 2, "crank": 54, "idler": 78, "output": 49}


def two(command: str, data: dict[str, Any], **sections: Any) -> Any:
    return factory.design({"kind": "two-gear-four-bar", "name": "x"} | data | sections, command=f"synth {command}")


def three(gears: dict[str, Any], command: str = "dwell", **sections: Any) -> Any:
    data = {"kind": "three-gear-four-bar", "name": "x", "gears": gears}
    return factory.design(data | sections, command=f"synth {command}")


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("window", "angle", "kept"), [(55.0, 35.0, True), (38.0, 40.0, True), (55.0, 40.0, False), (15.0, 40.0, True)]
)
def test_two_gears_that_always_step_back_dwell(window: float, angle: float, kept: bool) -> None:
    """With the asked transmission angle where such a frame serves; 61.4 deg are the most, at 35.8 deg."""
    found = two("dwell", RING, dwell={"window": window, "tolerance": 0.2}, limits={"transmission_angle": angle})
    case = two_gears(44, 69, 45.28, 72.727)
    assert case is not None
    tolerance = math.radians(0.2)
    assert scanned_window(case.output(found.linkage.frame), tolerance) >= window - 2.0 * STEP
    assert (math.degrees(found.linkage.min_transmission_angle()) >= angle) is kept
    assert found.dwell_tolerance <= tolerance
    assert scanned_window(case.output(found.linkage.frame), found.dwell_tolerance * (1.0 + 1e-6)) >= window - 2.0 * STEP
    assert math.degrees(found.window_limit) == pytest.approx(61.4, abs=0.05)
    assert [check.status for check in found.check_dwell_window()] == ["pass"]
    assert [check.status for check in found.check_dwell_edge()] == ["pass"]
    low, high = found.frame_length_interval
    for frame in np.linspace(low, high, 5):
        assert scanned_window(case.output(frame), tolerance * (1.0 + 1e-6)) >= window - 2.0 * STEP
    assert low == case.frames.low or scanned_window(case.output(low - 0.02), tolerance) < window


@pytest.mark.slow
def test_two_gears_that_always_step_back_and_a_tolerance_alone() -> None:
    """The longest dwell with the transmission angle of 40 deg, and without that limit the longest of all."""
    case = two_gears(44, 69, 45.28, 72.727)
    assert case is not None
    for angle, expected in ((40.0, 39.0), (30.0, 61.2)):
        found = two("dwell", RING, dwell={"tolerance": 0.2}, limits={"transmission_angle": angle})
        assert math.degrees(found.tolerance_dwell_angle) == pytest.approx(expected, abs=2.0 * STEP)
        assert scanned_window(case.output(found.linkage.frame), math.radians(0.2)) == pytest.approx(
            expected, abs=2.0 * STEP
        )
        assert found.dwell_tolerance == pytest.approx(math.radians(0.198), rel=0.02)


@pytest.mark.slow
def test_two_gears_that_always_step_back_name_their_limits() -> None:
    with pytest.raises(NoSolution, match=r"dwell within \+-0\.2 deg: 62 deg \(limit <= "):
        two("dwell", RING, dwell={"window": 62.0, "tolerance": 0.2}).linkage  # noqa: B018
    with pytest.raises(NoSolution, match=r"a window of 244 deg is out of reach: .* .transmission angle 0\.0\d+ deg"):
        two("dwell", RING, dwell={"window": 244.0}).linkage  # noqa: B018


@pytest.mark.slow
def test_two_gears_that_always_step_back_by_an_angle() -> None:
    """The maximum less the minimum output between the standstills, on the positions; the minimum of all is refused."""
    found = two("back-step", RING, back_step={"angle": 5.0})
    case = two_gears(44, 69, 45.28, 72.727)
    assert case is not None
    output = case.output(found.linkage.frame)
    falls = np.flatnonzero(np.diff(output) < 0.0)
    falls = falls[falls < len(GRID) // 2]
    assert math.degrees(output[falls[0]] - output[falls[-1] + 1]) == pytest.approx(5.0, abs=0.02)
    low = {"gears": {"module": 2.0, "planet": 47, "ring": 63}, "links": {"coupler": 21.043, "rocker": 56.683}}
    with pytest.raises(NoSolution, match=r"is out of reach: at least 32\.5\d+ deg"):
        two("back-step", low, back_step={"angle": 5.0}).linkage  # noqa: B018
    with pytest.raises(NoSolution, match="is out of reach"):
        two("back-step", RING, back_step={"angle": 60.0}).linkage  # noqa: B018


@pytest.mark.slow
@pytest.mark.parametrize(
    ("teeth", "crank", "dwell"),
    [
        ((54, 78, 49), 72.778, {"window": 15.0, "tolerance": 0.2}),
        ((54, 78, 49), 72.778, {"window": 30.0}),
        ((54, 78, 49), 72.778, {"tolerance": 0.2}),
        ((31, 70, -148), 31.906, {"tolerance": 0.5}),
        ((31, 70, -148), 31.906, {"window": 100.0, "tolerance": 0.5}),
        ((31, 70, -148), 31.906, {"window": 40.0}),
    ],
)
def test_three_gears_that_always_step_back_dwell(teeth: tuple[int, int, int], crank: float, dwell: Any) -> None:
    gears = dict(zip(("crank", "idler", "output"), teeth, strict=True)) | {"module": 2}
    found = three(gears, dwell={**dwell, "crank": crank}, limits={"transmission_angle": 5.0})
    case = three_gears(*teeth, crank)
    assert case is not None
    output = case.output(found.linkage.frame)
    assert math.degrees(found.linkage.min_transmission_angle()) >= 5.0
    if "window" in dwell:
        assert scanned_window(output, found.dwell_tolerance * (1.0 + 1e-6)) >= dwell["window"] - 2.0 * STEP
    if "tolerance" in dwell:
        tolerance = math.radians(dwell["tolerance"])
        assert found.dwell_tolerance <= tolerance
        window = math.degrees(found.tolerance_dwell.crank_angle)
        assert window == pytest.approx(scanned_window(output, tolerance), abs=2.0 * STEP)
        assert window <= math.degrees(found.window_limit) + 1e-9
    if len(dwell) == 2:
        low, high = found.frame_length_interval
        assert low <= found.linkage.frame <= high
        for frame in np.linspace(low, high, 5):
            assert scanned_window(case.output(frame), tolerance * (1.0 + 1e-6)) >= dwell["window"] - 2.0 * STEP


@pytest.mark.slow
def test_three_gears_that_always_step_back_say_so() -> None:
    """A window is not "less than the least": what is the least is the back-step, and crank-rockers alone are sought."""
    words = r"dwell within \+-0\.2 deg: 30 deg \(limit <= .* as a crank-rocker"
    with pytest.raises(NoSolution, match=words):
        three(TRAIN, dwell={"window": 30.0, "tolerance": 0.2, "crank": 72.778}).linkage  # noqa: B018
    with pytest.raises(NoSolution, match="a crank-rocker with this crank, whose output steps back with every frame"):
        three(TRAIN, "back-step", back_step={"angle": 5.0, "crank": 72.778}).linkage  # noqa: B018
    with pytest.raises(NoSolution, match=r"is out of reach: .* .transmission angle 0\.\d+ deg"):
        three(TRAIN, "back-step", back_step={"angle": 300.0, "crank": 72.778}).linkage  # noqa: B018
