"""Two-gear four-bars with a sought frame, against 38-digit cases, the standstills' cubic, and scans of the output.

Tolerances: the cases hold to 1e-12 relative, the condition number of the frame being near 1. A scan on a grid of
0.1 deg finds a window up to two of its steps shorter than the exact one, and never a longer one than the optimum.
"""

from __future__ import annotations

import json
import math
import random
from bisect import bisect_left
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import factory
import mpmath
import numpy as np
import pytest
from scipy.ndimage import maximum_filter1d, minimum_filter1d
from sweeps import ALL

from gearlink.core.base.errors import MissingSection, NoSolution
from gearlink.core.machines.planet_linkages import two_gear_family as kernel
from gearlink.core.machines.planet_linkages.planet import PlanetLinkage
from gearlink.core.machines.planet_linkages.two_gear_family import (
    Family,
    frame_range,
    momentary_frame,
    stationary_frames,
)
from gearlink.core.parts.linkages.fourbar import sweep as fourbar_sweep
from gearlink.core.parts.linkages.fourbar.position import FourBar, solve
from gearlink.core.parts.linkages.standstills import standstills

CASES = json.loads((Path(__file__).parents[2] / "reference" / "dwell.json").read_text())
SUN, RING = Family(54.0, 48.0, 50.0, -2.0), Family(32.0, 64.0, 80.0, 0.6)
GRID = 0.1  # deg
EXACT = 1e-12


def families(count: int, seed: int) -> Iterator[Family]:
    """Gears and links whose output has a momentary dwell, suns and ring gears by turns."""
    draw = random.Random(seed)
    while count:
        ratio = draw.uniform(0.2, 0.9) if count % 2 else -math.exp(draw.uniform(-1.0, 1.0))
        lengths = [math.exp(draw.uniform(-1.0, 1.2)) for _ in range(2)]
        family = Family(1.0, *lengths, ratio, draw.choice((1, -1)))
        try:
            low, high = frame_range(family)
            frame = momentary_frame(family)
        except NoSolution:
            continue
        if 0.02 < (frame - low) / (high - low) < 0.98:
            count -= 1
            yield family


def standing(family: Family, frame: float) -> int:
    """Number of standstills by the cubic in u for a given frame, (1 + q) u^3 - ..., solved by numpy."""
    q, b, c = -1.0 / family.ratio, family.coupler, family.rocker
    r2 = family.crank / abs(1.0 + q)
    k = r2 * r2 - b * b
    u = np.roots([1.0 + q, -c * (2.0 + q), (q * r2) ** 2 + c * c - frame * frame + q * k, -q * c * k])
    u = u[np.abs(u.imag) < 1e-9 * np.abs(u)].real
    return int(np.sum(np.abs((k + u * u) / (2.0 * r2 * u)) <= 1.0))


def by_turnings(drive: PlanetLinkage) -> int:
    return len(standstills(drive.speed, drive.speed_turnings, 0.0))


def outputs(drive: PlanetLinkage) -> np.ndarray[Any, Any]:
    """Output angle [deg] over two revolutions on the grid."""
    places = np.radians(np.arange(0.0, 720.0, GRID))
    coupler = fourbar_sweep.solve(drive.linkage, places, 0).coupler_angle
    return np.degrees((1.0 - drive.ratio) * places + drive.ratio * coupler)


def scanned_window(drive: PlanetLinkage, tolerance: float) -> float:
    """Longest window [deg] within +- a tolerance [deg] among the samples of two revolutions."""
    angles = outputs(drive)

    def too_long(steps: int) -> bool:
        samples = steps + 1
        half = samples // 2
        inside = slice(half, len(angles) - half)
        spread = maximum_filter1d(angles, samples)[inside] - minimum_filter1d(angles, samples)[inside]
        return bool(spread.min() > 2.0 * tolerance)

    turn = range(len(angles) // 2 + 1)
    return (bisect_left(turn, True, key=too_long) - 1) * GRID


@pytest.mark.parametrize("case", [pytest.param(c, id=c["name"]) for c in CASES if c["name"].startswith("B6.")])
def test_momentary_frame(case: Any) -> None:
    given, wanted = case["input"], case["expected"]
    family = Family(abs(given["r2"] + given["r5"]), given["coupler"], given["rocker"], -given["r2"] / given["r5"])
    assert momentary_frame(family) == pytest.approx(wanted["frame"], rel=EXACT)
    for name, value in wanted.items():
        if name.startswith("back_step_at_frame_"):
            frame = float(name.rpartition("_")[2])
            step = kernel.back_step_of(family.drive(frame))
            assert math.degrees(step) == pytest.approx(value, rel=1e-11)
            assert kernel.solved(family, kernel.back_step_of, step, "this") == pytest.approx(frame, rel=1e-11)


@pytest.mark.quick(3)
@pytest.mark.parametrize("family", list(families(24, 1)))
def test_the_number_of_standstills_changes_at_the_momentary_dwell_alone(family: Family) -> None:
    low, high = frame_range(family)
    limit = momentary_frame(family)
    below, above = (2, 0) if family.ring else (0, 2)
    near = 1e-7 * limit
    for count in (lambda d: by_turnings(family.drive(d)), lambda d: standing(family, d)):
        assert (count(limit - near), count(limit + near)) == (below, above)
    for part in np.linspace(0.01, 0.99, 25):
        frame = low + part * (high - low)
        assert standing(family, frame) == (below if frame < limit else above)


def test_each_output_gear_stands_in_one_class_of_linkage_alone() -> None:
    """A sun never in a crank-rocker, a ring gear never in a drag link: random links and gears."""
    draw, seen = random.Random(2), {"crank-rocker": 0, "drag-link": 0}
    while min(seen.values()) < (60 if ALL else 20):
        linkage = FourBar(*(math.exp(draw.uniform(0.0, 2.0)) for _ in range(4)))
        kind = linkage.kind()
        if kind not in seen:
            continue
        seen[kind] += 1
        ratio = -math.exp(draw.uniform(-2.0, 2.0)) if kind == "crank-rocker" else draw.uniform(0.05, 0.95)
        assert by_turnings(PlanetLinkage(linkage, ratio, "crank")) == 0


@pytest.mark.quick(4)
@pytest.mark.parametrize("family", list(families(12, 3)))
def test_back_step_and_window_rise_towards_the_change_point(family: Family) -> None:
    quiet, steep = kernel.stepping(family)
    frames = [quiet + part * (steep - quiet) for part in (0.001, 0.05, 0.2, 0.4, 0.6, 0.8, 0.95, 1.0)]
    steps = [kernel.back_step_of(family.drive(d)) for d in frames]
    windows = [kernel.window_of(family.drive(d)) for d in frames]
    assert steps == sorted(steps)
    assert steps[0] > 0.0
    assert windows == sorted(windows)
    assert family.drive(quiet + 1e-6 * (quiet - steep)).back_step is None


@pytest.mark.slow
def test_a_window_is_found_whatever_the_momentary_dwell_rounds_to() -> None:
    """The search starts at the momentary dwell, where a back-step of rounding may end above its start."""
    for coupler, rocker, teeth in ((64.0, 76.61909275997998, 78), (55.91474905081777, 84.52689629494145, 76)):
        family = Family(float(teeth - 48), coupler, rocker, 48 / teeth)
        assert kernel.window_of(family.drive(momentary_frame(family))) < 1e-3
        for degrees in (0.5, 30.0, 36.25450179146391, 61.369491027139205):
            frame = kernel.solved(family, kernel.window_of, math.radians(degrees), "this")
            assert math.degrees(kernel.window_of(family.drive(frame))) == pytest.approx(degrees, rel=1e-9)


@pytest.mark.parametrize("family", [SUN, RING])
def test_a_short_back_step_keeps_its_digits(family: Family) -> None:
    """D = c (d - d*)^(3/2) near the momentary dwell, where it is far below the rounding of the output angle."""
    quiet, steep = kernel.stepping(family)
    shares = [1e-7, 1e-8]
    one, other = (kernel.back_step_of(family.drive(quiet + s * (steep - quiet))) for s in shares)
    assert one / other == pytest.approx(10.0**1.5, rel=1e-5)


@pytest.mark.quick(4)
@pytest.mark.parametrize(("family", "tolerance"), [(SUN, 0.5), (SUN, 2.0), (RING, 0.5), (RING, 0.1)])
@pytest.mark.parametrize("share", [0.6, 1.5, 0.0])
def test_tolerance_dwell_against_a_scan(family: Family, tolerance: float, share: float) -> None:
    """With a back-step of a share of the band: within it, beyond it, none."""
    if share:
        frame = kernel.solved(family, kernel.back_step_of, math.radians(2.0 * share * tolerance), "this")
    else:
        frame = momentary_frame(family)
    drive = family.drive(frame)
    found = drive.within(math.radians(tolerance))
    scanned = scanned_window(drive, tolerance)
    assert scanned <= math.degrees(found.crank_angle) <= scanned + 2.0 * GRID
    inside = [drive.angle(found.start + part * found.crank_angle) for part in np.linspace(0.0, 1.0, 201)]
    assert max(inside) - min(inside) <= math.radians(2.0 * tolerance) * (1.0 + 1e-9)


@pytest.mark.quick(1)
@pytest.mark.parametrize("family", [SUN, RING])
def test_no_frame_has_a_longer_window_than_the_one_whose_back_step_fills_the_band(family: Family) -> None:
    tolerance = 0.5
    best = kernel.solved(family, kernel.back_step_of, math.radians(2.0 * tolerance), "this")
    window = math.degrees(kernel.window_of(family.drive(best)))
    low, high = frame_range(family)
    frames = [low + part * (high - low) for part in np.linspace(0.02, 0.98, 15)]
    frames += [best + step * (high - low) for step in (-0.01, -0.001, 0.001, 0.01)]
    assert max(scanned_window(family.drive(d), tolerance) for d in frames) < window


ONE_SIDED = [
    (Family(18.0, 51.39, 41.202, 62 / 98), 17.519),
    (Family(9.0, 23.3163, 17.7381, 20 / 29), 14.2911),
    (Family(53.0, 69.006, 56.71, -49 / 42, -1), 31.798),
]
"""With a tolerance [deg] of which the longest window does not fill the band with its back-step."""


@pytest.mark.slow
@pytest.mark.parametrize(("family", "tolerance"), ONE_SIDED)
def test_a_window_of_uneven_ends_is_longest_with_a_shorter_back_step(family: Family, tolerance: float) -> None:
    """No frame whose output stops is better in a scan; its own is by 0.007 to 0.4 deg longer than that of ripple."""
    band = math.radians(tolerance)
    frame, window = kernel.longest(family, band)
    filled, (quiet, steep) = kernel.filling(family, band), kernel.stepping(family)
    assert kernel.window_of(family.drive(filled)) < window
    assert kernel.back_step_of(family.drive(frame)) < 2.0 * band * (1.0 - 1e-3)
    assert scanned_window(family.drive(frame), tolerance) >= math.degrees(window) - 2.0 * GRID
    for other in (filled + part * (end - filled) for end in (quiet, steep) for part in (0.01, 0.1, 0.5, 1.0)):
        assert scanned_window(family.drive(other), tolerance) <= math.degrees(window)
    assert kernel.flattest(family, window, "this", beyond=True) == pytest.approx((frame, band), rel=1e-6)


@pytest.mark.quick(1)
@pytest.mark.parametrize(("family", "tolerance"), ONE_SIDED)
def test_the_longest_window_of_uneven_ends_at_thirty_digits(family: Family, tolerance: float) -> None:
    """The chain closed by circles: the window begins at the height of phi(2) and ends a band above it, or begins a band
    below phi(1) and ends at its height; and its derivative by the frame is zero, to the second order of which it is
    exact."""
    frame, window = kernel.longest(family, math.radians(tolerance))
    drive = family.drive(frame)
    step, start = drive.back_step, drive.within(math.radians(tolerance)).start
    start -= 2.0 * math.pi * (start > step.start)
    places = start, step.start, step.start + step.crank_angle, start + window
    with mpmath.workdps(30):
        output = partial(closed_by_circles, drive)
        left, first, second, right = (output(frame, place) for place in places)
        near = mpmath.mpf("1e-10")
        rates = [(output(frame, at + near) - output(frame, at - near)) / (2 * near) for at in places]
        drifts = [(output(frame + near, at) - output(frame - near, at)) / (2 * near) for at in places]
        band = 2 * mpmath.mpf(math.radians(tolerance))
        touched = 2 if rates[0] > rates[3] else 1
        off = (left - second, right - second - band) if touched == 2 else (right - first, left - first + band)
        assert max(map(abs, off)) < 1e-14 * max(1.0, abs(left))
        assert max(abs(rates[1]), abs(rates[2])) < 1e-13
        ends = [-(drifts[place] - drifts[touched]) / rates[place] for place in (0, 3)]
        assert abs(ends[1] - ends[0]) < 1e-7 * abs(ends[0])


def closed_by_circles(drive: PlanetLinkage, frame: Any, place: Any) -> Any:
    """Output angle of a linkage with another frame: C where the circles round B and D meet, beside where it was."""
    links, place = drive.linkage, mpmath.mpf(place)
    b = links.crank * mpmath.expj(place)
    across = frame - b
    along = (abs(across) ** 2 + mpmath.mpf(links.coupler) ** 2 - mpmath.mpf(links.rocker) ** 2) / (2 * abs(across))
    height = mpmath.sqrt(mpmath.mpf(links.coupler) ** 2 - along**2)
    about = solve(links, float(place)).coupler_angle
    turns = (mpmath.arg(across * mpmath.mpc(along, side * height) * mpmath.expj(-about)) for side in (1, -1))
    ratio = mpmath.mpf(drive.ratio)
    return (1 - ratio) * place + ratio * (about + min(turns, key=abs))


@pytest.mark.slow
@pytest.mark.parametrize("margin", [0.0, 0.01])
def test_designs_of_uneven_ends_reach_the_limit(margin: float) -> None:
    """A ring gear whose window was said to be at most 206.54 deg long."""
    data = {"gears": {"module": 2.0, "planet": 20, "ring": 29}, "links": {"coupler": 23.3163, "rocker": 17.7381}}
    tolerance = 14.2911
    alone = made("dwell", data, dwell={"tolerance": tolerance, "margin": margin})
    limit = math.degrees(alone.window_limit)
    assert limit > 206.551
    lost = limit - math.degrees(alone.tolerance_dwell_angle)
    assert (lost == pytest.approx(0.0, abs=1e-6)) if margin == 0.0 else (0.0 < lost < 0.1)
    both = made("dwell", data, dwell={"window": limit * (1.0 - 1e-9), "tolerance": tolerance})
    assert [check.status for check in both.check_dwell_window()] == ["pass"]
    assert math.degrees(both.dwell_tolerance) == pytest.approx(tolerance, rel=1e-6)
    low, high = both.frame_length_interval
    assert low <= both.linkage.frame <= high < low + 0.01
    longer = made("dwell", data, dwell={"window": limit * (1.0 + 1e-9), "tolerance": tolerance})
    with pytest.raises(NoSolution, match=r"limit <= 206\.5 deg"):
        longer.linkage  # noqa: B018


@pytest.mark.parametrize(
    ("family", "words", "nearer"),
    [
        (Family(100.0, 80.0, 60.0, -0.05), "limit < ", -2e-3),
        (Family(20.0, 80.0, 90.0, 0.15), "limit < ", -2e-3),
        (Family(20.0, 30.0, 35.0, 0.95), "limit > ", 2e-3),
    ],
)
def test_teeth_that_a_refusal_names(family: Family, words: str, nearer: float) -> None:
    """A little beyond the limit there is a momentary dwell, a little short of it there is none."""
    with pytest.raises(NoSolution, match=words) as refusal:
        momentary_frame(family)
    limit = float(str(refusal.value).split(words)[1].split()[0])
    sign = 1.0 if family.ring else -1.0
    beyond, short = (replace(family, ratio=sign / (limit * (1.0 + step))) for step in (nearer, -nearer))
    assert stationary_frames(beyond)
    assert not stationary_frames(short)


# The designs

SUNS = {"gears": {"module": 2.0, "planet": 36, "sun": 18}, "links": {"coupler": 48.0, "rocker": 50.0}}
RINGS = {"gears": {"module": 2.0, "planet": 48, "ring": 80}, "links": {"coupler": 64.0, "rocker": 80.0}}
MOMENTARY = {"target": {"motion": "momentary-dwell"}}


def made(command: str, data: dict[str, Any], **sections: Any) -> Any:
    return factory.design({"kind": "two-gear-four-bar"} | data | sections, command=f"synth {command}")


@pytest.mark.parametrize("data", [SUNS, RINGS])
def test_momentary_design(data: dict[str, Any]) -> None:
    design = made("momentary-dwell", data, **MOMENTARY)
    assert design.motion == "momentary-dwell"
    assert abs(design.speed_ratio_min) < 1e-12


@pytest.mark.parametrize("data", [SUNS, RINGS])
def test_back_step_design(data: dict[str, Any]) -> None:
    design = made("back-step", data, back_step={"angle": 5.0})
    assert math.degrees(design.back_step_angle) == pytest.approx(5.0, rel=1e-11)
    assert design.check_target().status == "pass"


@pytest.mark.quick(1)
@pytest.mark.parametrize("data", [SUNS, RINGS])
def test_dwell_design(data: dict[str, Any]) -> None:
    alone = made("dwell", data, dwell={"tolerance": 0.5})
    assert math.degrees(alone.dwell_tolerance) == pytest.approx(0.495, rel=1e-9)
    assert alone.window_limit > alone.tolerance_dwell_angle > 0.98 * alone.window_limit
    request = math.degrees(alone.window_limit) - 5.0
    both = made("dwell", data, dwell={"window": request, "tolerance": 0.5})
    flattest = made("dwell", data, dwell={"window": request})
    assert both.linkage == flattest.linkage
    assert math.degrees(flattest.tolerance_dwell_angle) == pytest.approx(request, rel=1e-9)
    assert math.degrees(flattest.dwell_tolerance) < 0.5
    low, high = both.frame_length_interval
    assert low < both.linkage.frame < high
    # One end of the interval is the edge of the window, the other the back-step that fills the band.
    for frame, inward in ((low, 1.0), (high, -1.0)):
        inside, outside = (
            both.family.drive(frame + sign * inward * 1e-5).within(math.radians(0.5)).crank_angle
            for sign in (1.0, -1.0)
        )
        assert math.degrees(outside) < request < math.degrees(inside)
    assert {check.status for check in (*both.check_dwell_window(), *both.check_dwell_edge())} == {"pass"}
    bare = made("dwell", data, dwell={"tolerance": 0.5, "margin": 0.0})
    assert [check.status for check in bare.check_dwell_edge()] == ["warn"]


@pytest.mark.slow
@pytest.mark.parametrize("data", [SUNS, RINGS])
@pytest.mark.parametrize("tolerance", [1e-6, 0.5, 5.0])
def test_window_as_long_as_the_limit(data: dict[str, Any], tolerance: float) -> None:
    """There the frames that meet the request shrink to one, and the check of the edge says so."""
    limit = math.degrees(made("dwell", data, dwell={"tolerance": tolerance}).window_limit) * (1.0 - 1e-9)
    design = made("dwell", data, dwell={"window": limit, "tolerance": tolerance})
    low, high = design.frame_length_interval
    assert 0.0 <= high - low < 1e-6
    assert [check.status for check in design.check_dwell_window()] == ["pass"]
    assert [check.status for check in design.check_dwell_edge()] == ["warn"]


@pytest.mark.parametrize(
    ("links", "ring", "module", "section"),
    [
        ((61.04527447989075, 83.77966461221384), 84, 2.0, {"dwell": {"window": 36.690220252121875, "tolerance": 0.5}}),
        ((75.69085571669393, 80), 80, 1.0, {"back_step": {"angle": 5}}),
    ],
)
def test_where_the_least_speed_of_the_momentary_dwell_rounds_to_either_side(
    links: tuple[float, float], ring: int, module: float, section: dict[str, Any]
) -> None:
    """The search starts at the momentary dwell, whose least speed is zero to rounding, of another sign a turn later."""
    gears = {"module": module, "planet": 48, "ring": ring}
    data = {"gears": gears, "links": dict(zip(("coupler", "rocker"), links, strict=True))}
    design = made("dwell" if "dwell" in section else "back-step", data, **section)
    if "dwell" in section:
        assert math.degrees(kernel.window_of(design.drive)) == pytest.approx(section["dwell"]["window"], rel=1e-12)
    else:
        assert math.degrees(design.back_step_angle) == pytest.approx(section["back_step"]["angle"], rel=1e-12)


@pytest.mark.quick(1)
@pytest.mark.parametrize("degrees", [0.01, 0.1, 1.0])
def test_short_windows_keep_their_digits(degrees: float) -> None:
    """A window is as uncertain as the root of the frame: 1e-15 of it over the share that the window leaves, squared."""
    frame = kernel.solved(RING, kernel.window_of, math.radians(degrees), "this")
    found = math.degrees(kernel.window_of(RING.drive(frame)))
    assert found == pytest.approx(degrees, rel=4e-15 / math.radians(degrees) ** 2)


@pytest.mark.parametrize(
    ("command", "data", "sections", "key", "words"),
    [
        ("dwell", RINGS, {"dwell": {"window": 100.0, "tolerance": 0.5}}, "dwell.window", "limit <= 65.7"),
        ("dwell", RINGS, {"dwell": {"window": 2.0, "tolerance": 0.5}}, "dwell.window", "no linkage needed"),
        ("dwell", RINGS, {"dwell": {"tolerance": 72.0}}, "dwell.tolerance", "limit < 72 deg"),
        ("back-step", SUNS, {"back_step": {"angle": 300.0}}, "back_step.angle", "173.9"),
        (
            "momentary-dwell",
            SUNS | {"links": {"coupler": 20.0, "rocker": 80.0}},
            MOMENTARY,
            "links.rocker",
            "limit < 74 mm, the other two together",
        ),
        (
            "momentary-dwell",
            RINGS | {"links": {"coupler": 31.0, "rocker": 80.0}},
            MOMENTARY,
            "links.coupler",
            "only a crank-rocker",
        ),
    ],
)
def test_refusals(command: str, data: dict[str, Any], sections: Any, key: str, words: str) -> None:
    with pytest.raises(NoSolution) as refusal:
        made(command, data, **sections).linkage  # noqa: B018
    assert refusal.value.key == key
    assert words in str(refusal.value)


NARROW = {"gears": {"module": 2.0, "planet": 28, "ring": 71}, "links": {"coupler": 73.7, "rocker": 122.9}}


def test_a_tolerance_that_no_back_step_fills_is_met_the_better() -> None:
    """Its limit is that of a tolerance, half the back-step; a window asks for no more than it needs."""
    with pytest.raises(NoSolution, match=r"a tolerance of 4\.975 deg is out of reach") as refusal:
        made("dwell", NARROW, dwell={"tolerance": 4.975}).linkage  # noqa: B018
    limit = float(str(refusal.value).partition("at most ")[2].split()[0])
    assert made("dwell", NARROW, dwell={"tolerance": limit}).window_limit is not None
    with pytest.raises(NoSolution, match="is out of reach"):
        made("dwell", NARROW, dwell={"tolerance": 1.001 * limit}).linkage  # noqa: B018
    wide = made("dwell", NARROW, dwell={"window": 65.87, "tolerance": 4.975})
    assert wide.linkage == made("dwell", NARROW, dwell={"window": 65.87}).linkage
    assert wide.window_limit is None
    low, high = wide.frame_length_interval
    for frame in (low + 1e-6, 0.5 * (low + high), high - 1e-6):
        dwell = wide.family.drive(frame).within(math.radians(4.975))
        assert dwell.crank_angle > math.radians(65.87), frame


@pytest.mark.slow
def test_frames_end_where_the_window_becomes_too_short() -> None:
    """At the far change point this output rests about one extreme for as long: the frames before it do not meet it."""
    links = {"coupler": 72.936, "rocker": 64.056}
    data = {"gears": {"module": 2.0, "planet": 56, "ring": 63}, "links": links}
    found = made("dwell", data, dwell={"window": 37.27, "tolerance": 0.0839})
    low, high = found.frame_length_interval
    for frame in np.linspace(low + 1e-6, high - 1e-6, 5):
        dwell = found.family.drive(float(frame)).within(math.radians(0.0839))
        assert dwell.crank_angle > math.radians(37.27), frame
    dwell = found.family.drive(high + 1e-3).within(math.radians(0.0839))
    assert math.degrees(dwell.crank_angle) < 37.27
    assert high == pytest.approx(66.73, abs=0.05)


def test_frame_and_sections() -> None:
    with pytest.raises(NoSolution, match="omit it"):
        made("momentary-dwell", SUNS | {"links": {"coupler": 48.0, "rocker": 50.0, "frame": 20.0}}).linkage  # noqa: B018
    with pytest.raises(MissingSection, match="section dwell"):
        made("dwell", SUNS, **MOMENTARY).linkage  # noqa: B018


def test_a_wrong_frame_of_a_momentary_dwell_is_repaired() -> None:
    """The frame of the closed form, which no grid of lengths holds: with it the output stops for a moment."""
    data = {
        "kind": "two-gear-four-bar",
        "gears": {"module": 2, "planet": 48, "ring": 80},
        "links": {"coupler": 64, "rocker": 80, "frame": 60},
        "target": {"motion": "momentary-dwell"},
    }
    (missed,) = factory.design(data, command="analyze").findings("analyze", "dwell-condition")
    ((key, frame),) = missed.remedy
    assert (missed.status, key) == ("fail", "links.frame")
    repaired = factory.design(data, command="analyze", links__frame=frame)
    assert repaired.motion == "momentary-dwell"
    assert all(check.status != "fail" for check in repaired.report("analyze").checks)
