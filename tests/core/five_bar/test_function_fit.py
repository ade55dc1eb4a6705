"""Functions over an interval and timed points: what is found, and how far it is from what is asked for.

Tolerances: the error of given links against a dense grid of 20 000 places 1e-6 of itself (the grid misses an extreme by
the square of its step); links are found again from exact points within 1e-9 mm; a levelled error is compared with the
best of random small changes, none of which may lower it by more than 2 %, the share by which its extremes may differ.
"""

from __future__ import annotations

import json
import math
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from factory import changed, design, worked
from pydantic import ValidationError

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.five_bar import function_fit
from gearlink.core.machines.five_bar.fit import fit_timed
from gearlink.core.machines.five_bar.function_motion import FunctionFiveBar, structural_error
from gearlink.core.machines.five_bar.path import points
from gearlink.core.machines.five_bar.path_motion import PathFiveBar
from gearlink.core.parts.linkages.functions import Wanted

CASES = json.loads((Path(__file__).parents[2] / "reference" / "dwell.json").read_text())
LOG = Wanted("log", (1.0, 2.0), math.radians(60.0), math.radians(90.0))
GIVEN = FunctionFiveBar(1.0, 0.110143, 1.18548, 0.320633, 0.503643, 2.0, 0.375818, 1)


def by_hand(bar: FunctionFiveBar, start: float, wanted: Wanted, count: int = 20_001) -> float:
    """Half the range of psi - wanted, each angle by the kernel for one angle."""
    s = [i / (count - 1) for i in range(count)]
    reached = bar.output_angles([start + wanted.input_swing * x for x in s])
    miss = np.array(reached) - wanted.output(np.array(s))
    return 0.5 * float(miss.max() - miss.min())


def test_reference() -> None:
    case = next(found for found in CASES if found["name"].startswith("D1.1"))
    want, start = case["expected"], case["input"]["phi0_rad"]
    found = structural_error(GIVEN, start, LOG)
    assert math.degrees(found.greatest) == pytest.approx(want["structural_error"], rel=1e-6)
    angle, _ = GIVEN.min_transmission_angle(start, start + LOG.input_swing)
    assert math.degrees(angle) == pytest.approx(want["transmission_angle"], rel=1e-6)
    assert found.greatest == pytest.approx(by_hand(GIVEN, start, LOG, 4001), rel=1e-5)
    assert max(found.errors) == pytest.approx(-min(found.errors), rel=1e-12)


OPEN = FunctionFiveBar(1.0, 0.2, 3.0, 2.8, 2.5, 1.8, 0.4, 1)
"""It turns all the way, with gears under which the phase counts the turns of its start."""


@pytest.mark.parametrize("turns", [-1, 0, 1, 5])
def test_whole_turns_of_the_start_are_taken_out_with_the_phase(turns: int) -> None:
    """The phase is the coupler's direction at input angle 0: begun turns later, the same motion has another."""
    start = 0.7 + math.tau * turns
    psi = OPEN.output_angles([start, start + 0.5])
    wanted = Wanted("exp", (0.0, 0.1), 0.5, psi[1] - psi[0])
    logs = map(math.log, (OPEN.coupler, OPEN.follower, OPEN.output, OPEN.frame))
    ((made, begun),) = function_fit._moving(OPEN, np.array([*logs, OPEN.phase, start, 0.0]), wanted)
    assert begun == pytest.approx(0.7, abs=1e-12)
    for swing in (0.0, 0.2, 0.5):
        assert made.joint(begun + swing) == pytest.approx(OPEN.joint(start + swing), abs=1e-12)


def test_the_links_of_the_file_are_the_first_start(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of the first round alone; they move as in the file."""
    psi = OPEN.output_angles([0.7, 1.2])
    wanted = Wanted("exp", (0.0, 0.1), 0.5, psi[1] - psi[0])
    begun: list[Any] = []
    monkeypatch.setattr(function_fit, "_descended", lambda x, *_: begun.append(x) or (x[:0], np.empty(0)))
    for number in (0, 1):
        assert list(function_fit._round(OPEN, 0.7, wanted, 0.0, number)) == []
    ((made, start),) = function_fit._moving(OPEN, begun[0][0], wanted)
    assert start == pytest.approx(0.7, abs=1e-15)
    for swing in (0.0, 0.2, 0.5):
        assert made.joint(start + swing) == pytest.approx(OPEN.joint(start + swing), abs=1e-12)
    assert begun[1][0][0] != pytest.approx(begun[0][0][0], abs=1e-3)


@pytest.fixture(scope="module")
def best() -> Any:
    return design("five_bar_function")


@pytest.mark.slow
def test_found_links_keep_what_they_promise(best: Any) -> None:
    fit = best.function_fit
    assert best.structural_error == pytest.approx(by_hand(fit.bar, fit.start, best.wanted, 2001), rel=1e-4)
    assert math.degrees(best.structural_error) < 5e-4
    assert best.min_transmission_angle >= math.radians(40.0)
    assert best.error_extremes >= 7  # one condition is the transmission angle at its limit
    assert [check.status for check in best.check("target")] == ["pass"]
    places = best.structural_error_at
    low, high = best.input_range
    assert all(low - 1e-12 <= place <= high + 1e-12 for place in places)


@pytest.mark.slow
def test_no_change_of_the_links_lowers_the_error(best: Any) -> None:
    fit, wanted = best.function_fit, best.wanted
    rng = np.random.default_rng(3)
    bar, least = fit.bar, math.radians(40.0)
    for scale in (1e-2, 1e-3, 1e-4, 1e-5):
        for _ in range(40):
            change = scale * rng.standard_normal(6)
            b, c, e, d = np.exp(change[:4]) * (bar.coupler, bar.follower, bar.output, bar.frame)
            tried = FunctionFiveBar(bar.input, b, c, e, d, bar.coupler_ratio, bar.phase + change[4], bar.assembly)
            start = fit.start + change[5]
            try:
                angle, _ = tried.min_transmission_angle(start, start + wanted.input_swing)
                error = structural_error(tried, start, wanted).greatest
            except NoSolution:
                continue
            assert angle < least or error > 0.98 * fit.error.greatest


@pytest.mark.slow
def test_error_table_is_the_difference(best: Any) -> None:
    table = best.table("structural_error", samples=40)
    np.testing.assert_allclose(table["error"], table["output_angle"] - table["wanted_angle"], rtol=0.0, atol=1e-12)
    each = [math.degrees(best.function_bar.output_angle(math.radians(x))) for x in table["input_angle"]]
    np.testing.assert_allclose(np.remainder(table["output_angle"] - each + 180.0, 360.0), 180.0, rtol=0.0, atol=1e-9)
    assert np.abs(table["error"]).max() <= math.degrees(best.structural_error) * (1.0 + 1e-6)
    swing = table["wanted_angle"] - table["wanted_angle"][0]
    x = 1.0 + np.linspace(0.0, 1.0, 41)
    np.testing.assert_allclose(swing, 90.0 * np.log2(x), rtol=0.0, atol=1e-11)


def test_slopes_of_levelling_are_those_of_differences() -> None:
    """By central differences of 1e-6, which are off by some 1e-9 (1e-16/1e-6 of rounding, 1e-12 of bend)."""
    swing, start = LOG.input_swing * np.linspace(0.0, 1.0, 31), 1.343624
    links = [math.log(length) for length in (GIVEN.coupler, GIVEN.follower, GIVEN.output, GIVEN.frame)]
    x, step = np.array([*links, GIVEN.phase, start]), 1e-6

    def moved(x: np.ndarray) -> Any:
        b, c, e, d = np.exp(x[:4])
        made = replace(GIVEN, coupler=b, follower=c, output=e, frame=d, phase=x[4])
        return function_fit.state(made, x[5], swing, 0.0 * swing)

    angles, cosines = function_fit.slopes(GIVEN, start, swing)
    for i in range(6):
        ahead, behind = (moved(x + side * step * np.eye(6)[i]) for side in (1.0, -1.0))
        by_angle, by_cosine = ((one - other) / (2.0 * step) for one, other in zip(ahead, behind, strict=True))
        assert np.ptp(angles[:, i] - by_angle) < 2e-8  # misses count about their middle
        assert np.abs(cosines[:, i] - by_cosine).max() < 2e-8


@pytest.mark.slow
def test_slopes_of_the_squares_are_those_of_differences() -> None:
    """Central differences of 1e-6: rounding 1e-16/1e-6 of the misses, up to some hundreds; one length out of bounds."""
    rng = np.random.default_rng(3)
    x, phi, psi = rng.normal(size=(40, 7)), np.linspace(0.1, 1.0, 9), np.linspace(0.0, 1.3, 9)
    x[0, 1] = 7.0
    given = phi, psi, 1.7, 0.6
    misses = function_fit._misses(x, *given)
    found = function_fit._slopes(x, misses, *given)
    for i in range(7):
        step = 1e-6 * np.eye(7)[i]
        slope = (function_fit._misses(x + step, *given) - function_fit._misses(x - step, *given)) / 2e-6
        assert found[..., i] == pytest.approx(slope, rel=1e-8, abs=1e-8 * float(np.abs(misses).max()))


@pytest.mark.slow
def test_corrected_steps_follow_a_curved_valley(monkeypatch: pytest.MonkeyPatch) -> None:
    """Slopes alone say that extremes stay level which the bend of the errors raises; steps then shrink to nothing."""
    found = []
    for corrected in (function_fit._CORRECTED, -math.inf):
        monkeypatch.setattr(function_fit, "_CORRECTED", corrected)
        running = function_fit.Levelling(GIVEN, 1.343624, LOG, math.cos(math.radians(30.0)))
        first = running.worst
        running.advance(40)
        assert structural_error(running.bar, running.start, LOG).greatest == pytest.approx(running.worst, rel=5e-3)
        found.append((first - running.worst) / first)
    assert found[0] > 0.36 > 0.32 > found[1] > 0.3


def test_a_link_beyond_its_bound_goes_no_further(monkeypatch: pytest.MonkeyPatch) -> None:
    couplers = []
    for bound in (function_fit.WIDEST, math.log(2.0)):
        monkeypatch.setattr(function_fit, "WIDEST", bound)
        running = function_fit.Levelling(GIVEN, 1.343624, LOG, 1.0)
        running.advance(7)
        couplers.append(running.bar.coupler)
    assert couplers[0] < 0.1095
    assert couplers[1] == pytest.approx(GIVEN.coupler, rel=1e-9)


@pytest.mark.parametrize(
    ("name", "x", "exponent", "half"),
    [
        ("log", (1.0, 2.0), 1.0, math.log(1.5) / math.log(2.0)),
        ("exp", (0.0, 1.0), 1.0, (math.sqrt(math.e) - 1.0) / (math.e - 1.0)),
        ("power", (0.0, 2.0), 2.0, 0.25),
        ("sine", (0.0, math.pi / 2.0), 1.0, math.sqrt(0.5)),
        ("tangent", (0.0, math.pi / 4.0), 1.0, math.tan(math.pi / 8.0)),
    ],
)
def test_functions(name: Any, x: Any, exponent: float, half: float) -> None:
    made = Wanted(name, x, 1.0, -2.0, exponent)
    np.testing.assert_allclose(made.output(np.array([0.0, 0.5, 1.0])), [0.0, -2.0 * half, -2.0], rtol=0.0, atol=1e-15)


@pytest.mark.parametrize(
    ("name", "x", "exponent"),
    [
        ("log", (-1.0, 2.0), 1.0),
        ("power", (-1.0, 1.0), 0.5),
        ("sine", (0.0, math.pi), 1.0),
        ("tangent", (0.0, 2.0), 1.0),
    ],
)
def test_functions_that_are_none_are_refused(name: Any, x: Any, exponent: float) -> None:
    with pytest.raises(NoSolution, match="change the interval"):
        Wanted(name, x, 1.0, 1.0, exponent)


def test_given_links_are_judged() -> None:
    function = {"name": "log", "x": [1, 2], "input_swing": 60, "output_swing": 90, "links": "given", "tolerance": 0.001}
    gears = {"module": 0.02, "planet": 50, "sun": 50}
    links = {"coupler": 0.110143, "follower": 1.18548, "output": 0.320633, "frame": 0.503643}
    start = math.degrees(1.343624)
    made = design(
        changed(worked("five_bar_function"), target={"function": function}),
        gears=gears,
        links=links,
        phase=math.degrees(0.375818),
        range={"start": start, "end": start + 60},
    )
    assert math.degrees(made.structural_error) == pytest.approx(0.005921465340283822, rel=1e-6)
    assert [check.status for check in made.check("target")] == ["fail"]
    assert made.starts_tried is None


@pytest.mark.slow
def test_search_without_a_result_is_refused_with_the_key() -> None:
    keys = {"target__function__output_swing": 350, "target__function__input_swing": 20}
    made = design("five_bar_function", limits__transmission_angle=85, **keys)
    with pytest.raises(NoSolution, match=r"reduce limits\.transmission_angle") as caught:
        _ = made.function_bar
    assert caught.value.key == "target.function"


# Timed points

TIMED = PathFiveBar(20.0, 55.0, 60.0, 16.0, 50.0, Fraction(-1), math.radians(70.0))
START = PathFiveBar(20.0, 60.0, 60.0, 20.0, 50.0, Fraction(-1), math.radians(90.0))


@pytest.mark.slow
def test_timed_points_of_a_five_bar_find_it_again() -> None:
    angles = np.radians([0.0, 40.0, 80.0, 120.0, 200.0, 280.0])
    targets = points(TIMED, 0.6 + angles, 50 + 12j)
    found = fit_timed(START, 60 + 0j, targets, angles, math.radians(25.0))
    assert found.fit.rms < 1e-9
    assert found.first_angle == pytest.approx(0.6, abs=1e-9)
    assert found.fit.bar.coupler == pytest.approx(55.0, abs=1e-8)
    assert found.rounds[0].starts > 100


def test_timed_design() -> None:
    made = design("five_bar_timed_points")
    table = made.table("deviations")
    bar, first = made.path_bar, made.first_point_angle
    for x, y, angle, distance in zip(table["x"], table["y"], table["input_angle"], table["distance"], strict=True):
        at = complex(points(bar, np.array([math.radians(angle)]), made.offset)[0])
        assert abs(at - complex(x, y)) == pytest.approx(distance, abs=1e-9)
    assert table["input_angle"][0] == pytest.approx(math.degrees(first), rel=1e-12)
    assert [check.status for check in made.check("target")] == ["pass"]
    assert made.table("search").length == 1


@pytest.mark.slow
def test_budget_is_kept_and_what_was_reached_is_told() -> None:
    made = design("five_bar_timed_points", target__budget=0.05)
    rounds = made.search_rounds
    assert len(rounds) >= 1
    assert made.starts_tried == rounds[-1].starts
    errors = [each.error for each in rounds]
    assert errors == sorted(errors, reverse=True)


@pytest.mark.parametrize(
    ("name", "keys", "words"),
    [
        ("five_bar_timed_points", {"target__input_angles": [0, 40]}, "at least 3"),
        ("five_bar_timed_points", {"target__input_angles": [0, 40, 80]}, "3 for 5"),
        ("five_bar_timed_points", {"target__input_angles": [1, 40, 80, 120, 200]}, "count from the first"),
        ("five_bar_points", {"target__budget": 5}, "budget applies only to"),
        ("five_bar_function", {"target__positions": [[0, 0], [1, 1]]}, "exclude each other"),
        ("five_bar_function", {"range": {"start": 0, "end": 60}}, "omit range"),
        ("five_bar_function", {"target__function__links": "given"}, "give range"),
        ("five_bar_function", {"target__function__name": "power"}, "exponent is required with power"),
        ("five_bar_function", {"target__function__x": [2, 2]}, "the same value at both ends"),
        ("five_bar_function", {"target__function__output_swing": 0}, "a moving output"),
        ("five_bar_points", {"target__points": None, "target__function": {"name": "log", "x": [1, 2],
         "input_swing": 60, "output_swing": 90}}, "form: function"),
    ],
)  # fmt: skip
def test_wrong_files(name: str, keys: dict[str, Any], words: str) -> None:
    with pytest.raises(ValidationError, match=words):
        design(name, **keys)
