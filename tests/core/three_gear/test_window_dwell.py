"""Dwell of the symmetric family within a tolerance, against 38-digit cases and against scans that know no formula.

Tolerances: the cases are given to 16 digits and hold to 1e-12 relative, some ten times the condition number of the
window (it is a cube root of the tolerance). A scan can only find less than the optimum, up to the refinement of the
longest interval, 1e-9 of it.
"""

from __future__ import annotations

import json
import math
from contextlib import suppress
from decimal import Decimal
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest
from factory import design
from hypothesis import given, settings
from hypothesis import strategies as st
from oracles.symmetric import momentary_frame_ratio

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.three_gear import symmetric
from gearlink.core.machines.three_gear.dwell import Output
from gearlink.core.machines.three_gear.symmetric import (
    crank_angle_for_window,
    dwell_angle,
    frame_ratio_for_back_step,
    symmetric_linkage,
    window_limit,
)
from gearlink.core.machines.three_gear.train import GearTrain

CASES = json.loads((Path(__file__).parents[2] / "reference" / "dwell.json").read_text())
EXACT = 1e-12


def cases(letter: str) -> list[Any]:
    return [pytest.param(c["input"], c["expected"], id=c["name"]) for c in CASES if c["name"].startswith(letter)]


def rad(angle: float) -> float:
    return math.radians(angle)


@pytest.mark.parametrize(("given_", "wanted"), cases("A1."))
def test_longest_window(given_: Any, wanted: Any) -> None:
    i3, tau = given_["i3"], rad(given_["tolerance_deg"])
    phi12 = symmetric.crank_angle_for_tolerance(i3, tau)
    assert math.degrees(symmetric.longest_window(i3, tau)) == pytest.approx(wanted["window"], rel=EXACT)
    assert math.degrees(phi12) == pytest.approx(wanted["back_step_crank_angle"], rel=EXACT)
    assert math.degrees(dwell_angle(i3, phi12)) == pytest.approx(wanted["dwell_angle"], rel=EXACT)
    assert frame_ratio_for_back_step(i3, phi12) == pytest.approx(wanted["frame_ratio"], rel=EXACT)


@pytest.mark.parametrize(("given_", "wanted"), cases("A2."))
def test_flattest_window(given_: Any, wanted: Any) -> None:
    i3, window = given_["i3"], rad(given_["window_deg"])
    phi12 = crank_angle_for_window(i3, window)
    assert math.degrees(symmetric.least_tolerance(i3, window)) == pytest.approx(wanted["tolerance"], rel=EXACT)
    assert math.degrees(phi12) == pytest.approx(wanted["back_step_crank_angle"], rel=EXACT)
    assert frame_ratio_for_back_step(i3, phi12) == pytest.approx(wanted["frame_ratio"], rel=EXACT)


@pytest.mark.parametrize(("given_", "wanted"), cases("A3."))
def test_frame_interval(given_: Any, wanted: Any) -> None:
    i3, window, tau = given_["i3"], rad(given_["window_deg"]), rad(given_["tolerance_deg"])
    low, high = symmetric.frame_ratio_interval(i3, window, tau)
    assert low == pytest.approx(wanted["frame_ratio_limit_of_tolerance"], rel=EXACT)
    assert high == pytest.approx(wanted["frame_ratio_least_back_step"], rel=EXACT)


@pytest.mark.parametrize(("given_", "wanted"), cases("A5."))
def test_greatest_idler(given_: Any, wanted: Any) -> None:
    ratios = symmetric.reaching_ratios(rad(given_["window_deg"]), rad(given_["tolerance_deg"]))
    assert -ratios[1] == pytest.approx(wanted["i3_limit"], rel=1e-10)


def test_the_closed_form_at_i3_minus_two() -> None:
    """There Y = 2 h, so that tau = 3 atan(tan(Phi/4)/3) - Phi/4 needs no root."""
    for window in (0.01, 0.3, 1.0, 1.5):
        tau = 3.0 * math.atan(math.tan(0.25 * window) / 3.0) - 0.25 * window
        lost = 4.0 * 2.0**-52 * (0.5 * window) / tau  # cancellation of the formula here
        assert symmetric.longest_window(-2.0, tau) == pytest.approx(window, rel=1e-14 + lost)
        assert symmetric.least_tolerance(-2.0, window) == pytest.approx(tau, rel=1e-14 + lost)


@given(st.floats(-8.0, -0.3), st.floats(0.02, 5.0))
def test_flattest_and_longest_are_inverse(i3: float, tolerance: float) -> None:
    tau = rad(tolerance)
    window = symmetric.longest_window(i3, tau)
    # d ln(tau)/d ln(window) lies near 3 and grows towards the folded linkage
    assert symmetric.least_tolerance(i3, window) == pytest.approx(tau, rel=2e-12)


@pytest.mark.slow
@settings(max_examples=12)
@given(st.floats(-6.0, -0.3), st.floats(0.1, 5.0))
def test_no_frame_has_a_longer_window(i3: float, tolerance: float) -> None:
    """The longest interval of any frame of the family, found without the formulas of this module."""
    tau = rad(tolerance)
    train = GearTrain(10_000, round(-i3 * 10_000), 10_000)
    i3 = train.i3
    longest = symmetric.longest_window(i3, tau)
    best = frame_ratio_for_back_step(i3, symmetric.crank_angle_for_tolerance(i3, tau))
    found = [
        Output(symmetric_linkage(1.0 + (best - 1.0) * share, 100.0), train).within(tau).crank_angle
        for share in (0.8, 0.97, 0.999, 1.0 + 1e-9, 1.001, 1.03, 1.3)
    ]
    assert max(found) <= longest * (1.0 + 1e-9)
    assert found[3] == pytest.approx(longest, rel=1e-6)
    # beyond the jump less than three quarters and a bit are left: phi13 of the window 2 phi13 - phi12
    assert max(found[:3]) < 0.8 * longest


@settings(max_examples=12)
@given(st.floats(-6.0, -0.3), st.floats(0.1, 3.0), st.floats(0.3, 0.98), st.floats(0.02, 0.98))
def test_every_frame_of_the_interval_meets_the_request(i3: float, tolerance: float, part: float, share: float) -> None:
    tau = rad(tolerance)
    train = GearTrain(10_000, round(-i3 * 10_000), 10_000)
    window = max(2.5 * tau, part * symmetric.longest_window(train.i3, tau))
    low, high = symmetric.frame_ratio_interval(train.i3, window, tau)
    inside = symmetric_linkage(low + share * (high - low), 100.0)
    assert Output(inside, train).within(tau).crank_angle >= window * (1.0 - 1e-9)
    outside = symmetric_linkage(high + 0.02 * (high - low), 100.0)
    assert Output(outside, train).within(tau).crank_angle < window


def test_asymptote() -> None:
    """4 (3 tau n^2/(n^2 - 1))^(1/3), with an error of the next order, tau^(2/3)."""
    for n in (1.5, 2.8, 6.0):
        for tau in (1e-6, 1e-9):
            leading = 4.0 * (3.0 * tau * n * n / (n * n - 1.0)) ** (1.0 / 3.0)
            assert symmetric.longest_window(1.0 - n, tau) == pytest.approx(leading, rel=3.0 * tau ** (2.0 / 3.0))
            assert symmetric.longest_window(1.0 - n, tau) / leading != 1.0


def test_gain_over_the_momentary_dwell() -> None:
    tau, train = rad(1e-3), GearTrain(40, 72, 40)
    momentary = symmetric_linkage(momentary_frame_ratio(train.i3), 112.0)
    gain = symmetric.longest_window(train.i3, tau) / Output(momentary, train).within(tau).crank_angle
    assert gain == pytest.approx(4.0 ** (1.0 / 3.0), rel=1e-3)


def test_window_of_large_idler_is_the_limit() -> None:
    for tolerance in (0.5, 1.0, 10.0):
        tau = rad(tolerance)
        assert symmetric.longest_window(-1e6, tau) == pytest.approx(symmetric.window_of_large_idler(tau), rel=1e-9)


def test_equal_ripple_at_forty_digits() -> None:
    """The output as f(y) = y - n asin(k sin y): both edges are touched twice, exactly."""
    n, tau = mpmath.mpf(2.8), mpmath.radians(mpmath.mpf(0.5))
    with mpmath.workdps(40):
        h = mpmath.findroot(lambda x: 2 * n * mpmath.atan(mpmath.tan(x) / n) - 2 * x - 2 * tau, 0.3)
        k = 1 / mpmath.sqrt((n * mpmath.cos(h)) ** 2 + mpmath.sin(h) ** 2)
        y = mpmath.findroot(lambda x: x - n * mpmath.asin(k * mpmath.sin(x)) - tau, 0.6)
        assert symmetric.longest_window(-1.8, float(tau)) == pytest.approx(float(2 * y), rel=4e-16)


class TestRefusals:
    def test_tolerance_beyond_every_back_step(self) -> None:
        with pytest.raises(NoSolution, match="below 45 deg"):
            symmetric.longest_window(-0.5, rad(46.0))

    def test_window_beyond_reach_names_what_is_possible(self) -> None:
        with pytest.raises(NoSolution) as caught:
            symmetric.frame_ratio_interval(-1.8, rad(72.0), rad(0.5))
        words = str(caught.value)
        assert "limit <= 70.43 deg" in words
        assert "or +-0.5349 deg" in words
        assert "-i3 of at most 1.305 " in words

    def test_what_is_named_is_possible(self) -> None:
        symmetric.frame_ratio_interval(-1.8, rad(70.43), rad(0.5))
        symmetric.frame_ratio_interval(-1.8, rad(72.0), rad(0.5349))

    @pytest.mark.parametrize(
        ("i3", "window", "tolerance", "words"),
        [
            (-0.5, 300.0, 100.0, "or use -i3 of at least 1.001 "),
            (-0.6, 265.0, 50.0, "or use -i3 of at least 0.8312 "),
            (-0.2, 218.0, 20.0, "or use -i3 of at least 0.2642 "),
            (-3.0, 218.0, 20.0, "-i3 of at most 1.043 "),
        ],
    )
    def test_wide_bands_name_the_idler_that_reaches(
        self, i3: float, window: float, tolerance: float, words: str
    ) -> None:
        with pytest.raises(NoSolution) as caught:
            symmetric.frame_ratio_interval(i3, rad(window), rad(tolerance))
        assert words in str(caught.value)
        ratio = float(words.rpartition(" of at ")[2].split()[1])
        low, high = symmetric.frame_ratio_interval(-ratio, rad(window), rad(tolerance))
        assert low < high

    def test_window_that_needs_no_linkage(self) -> None:
        with pytest.raises(NoSolution, match="needs no linkage"):
            symmetric.frame_ratio_interval(-1.8, rad(2.0), rad(1.0))

    def test_window_beyond_the_family(self) -> None:
        with pytest.raises(NoSolution, match="with any tolerance"):
            crank_angle_for_window(-1.8, window_limit(-1.8))


def test_frames_of_the_longest_window_are_one_up_to_rounding() -> None:
    """There both ends of the interval are the same frame: exchanged by a last bit they would hold nothing."""
    for i3 in (-0.1 * tenths for tenths in range(4, 61)):
        for tolerance in map(math.radians, (0.01, 0.3, 2.0, 9.0)):
            window = symmetric.longest_window(i3, tolerance)
            low, high = symmetric.frame_ratio_interval(i3, window, tolerance)
            assert low <= high
            assert low == pytest.approx(high, rel=1e-6)


@pytest.mark.slow
def test_what_the_limits_leave_is_named_and_can_be_had() -> None:
    request = {"kind": "three-gear-four-bar", "gears": {"module": 2.0, "crank": 40, "output": 40}}
    refused = design({**request, "dwell": {"window": 80.0, "tolerance": 0.5}}, command="synth dwell")
    with pytest.raises(NoSolution, match="within the limits") as caught:
        _ = refused.linkage
    assert caught.value.key == "gears.idler"
    longest = float(str(caught.value).rpartition("set dwell.window to ")[2].split()[0])
    made = design({**request, "dwell": {"window": longest, "tolerance": 0.5}}, command="synth dwell")
    assert {check.status for check in made.report("synth dwell").checks} <= {"pass", "warn"}


def test_a_tiny_dwell_angle_is_met() -> None:
    made = design(
        {
            "kind": "three-gear-four-bar",
            "gears": {"module": 2.0, "crank": 40, "idler": 60, "output": 40},
            "dwell": {"angle": 0.001},
        },
        command="synth dwell",
    )
    window = made.quantity("tolerance_dwell_angle")
    assert window is not None
    assert window.value == pytest.approx(4.0 / 3.0 * 0.001, rel=1e-9)


@pytest.mark.parametrize("quantity", ["linkage", "window_limit", "crank_length"])
def test_a_tolerance_without_longest_window_is_refused_whatever_is_asked_for(quantity: str) -> None:
    """Less a margin of 1 % it would have one."""
    gears = {"module": 1, "crank": 25, "idler": 34, "output": 25}
    request = {"kind": "three-gear-four-bar", "gears": gears, "dwell": {"tolerance": 123.0}}
    made = design(request, command="synth dwell")
    with pytest.raises(NoSolution, match=r"123 deg .* below 122\.4 deg") as caught:
        made.raw(quantity)
    assert caught.value.key == "dwell.tolerance"


@pytest.mark.parametrize("module", [0.1, 2.0])
def test_the_edge_of_a_dwell_shows_what_it_is_judged_by(module: float) -> None:
    """The frame's interval grows with the module; at 0.1 mm it is below 0.05 mm, while the band has room left."""
    gears = {"module": module, "crank": 40, "idler": 44, "output": 40}
    data = {"kind": "three-gear-four-bar", "gears": gears, "dwell": {"window": 70.0, "tolerance": 0.5}}
    made = design(data, command="synth dwell")
    (found,) = made.check("dwell_edge")
    low, high = made.frame_length_interval
    if module < 1.0:
        assert (found.status, found.value, found.limit, found.unit) == ("warn", high - low, 0.05, "mm")
    else:
        assert (found.status, found.limit, found.unit) == ("pass", 0.992, "1")
        assert found.value == pytest.approx(made.back_step.angle / 2.0 / math.radians(0.5), rel=1e-12)


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("teeth", "idler", "window", "tolerance"),
    [(20, 69, 115.44535400634571, 2.4995416995056456), (41, 106, 13.829586868504954, 0.003874342583871178)],
)
def test_the_longest_window_leaves_one_frame(teeth: int, idler: int, window: float, tolerance: float) -> None:
    """There rounding decides on which side of the request the frame that was found lies, or whether there is one: which
    double is the longest window depends on the processor's sines. A hundred ulp below there is a frame on each."""
    gears = {"module": 2, "crank": teeth, "idler": idler, "output": teeth}

    def lengths(ulps: int) -> list[float]:
        dwell = {"window": window - ulps * math.ulp(window), "tolerance": tolerance}
        made = design({"kind": "three-gear-four-bar", "gears": gears, "dwell": dwell}, command="synth dwell")
        return [made.frame_length, *made.frame_length_interval]

    found = [lengths(100)]
    for ulps in (0, 1, 2, 4, 8):
        with suppress(NoSolution):
            found.append(lengths(ulps))
    for frame, *interval in found:
        assert interval == pytest.approx([frame] * 2, rel=1e-6)


RING = {"kind": "three-gear-four-bar", "gears": {"module": 2, "crank": 39, "idler": 50, "output": -163}}
EXTERNAL = {"kind": "three-gear-four-bar", "gears": {"module": 2, "crank": 47, "idler": 20, "output": 47}}


@pytest.mark.quick(1)
@pytest.mark.parametrize("tolerance", [0.97, 0.98, 3.62])
def test_a_tolerance_that_no_back_step_fills_is_met_the_better(tolerance: float) -> None:
    """A back-step of these gears is at most 1.948 deg: up to 0.974 deg the band can be filled."""
    wide = design({**RING, "dwell": {"window": 44.5, "tolerance": tolerance}}, command="synth dwell")
    plain = design({**RING, "dwell": {"window": 44.5}}, command="synth dwell")
    assert wide.linkage == plain.linkage
    assert (wide.window_limit is None) is (tolerance > 0.974)
    assert wide.report("synth dwell").ok
    (just, last), crank = wide.frame_length_interval, wide.crank_length
    for frame in (just + 1e-6, 0.5 * (just + last), last - 1e-6):
        links = {"crank": crank, "frame": frame}
        made = design({**RING, "links": links, "dwell_tolerance": tolerance}, command="analyze")
        assert made.tolerance_dwell_angle > math.radians(44.5), frame


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("base", "dwell"),
    [
        (RING, {}),
        (EXTERNAL, {"crank": 24.0, "margin": 0.2}),
        pytest.param(EXTERNAL, {"frame": 114.4}, marks=pytest.mark.slow),
        pytest.param(EXTERNAL, {"crank": 24.0}, marks=pytest.mark.slow),
    ],
)
def test_the_limit_of_a_tolerance_is_its_own(base: Any, dwell: Any) -> None:
    """Not that of the back-step, which is twice as wide; with a margin too it is the tolerance that is asked for."""
    refused = design({**base, "dwell": {**dwell, "tolerance": 60.0}}, command="synth dwell")
    with pytest.raises(NoSolution, match="a tolerance of 60 deg is out of reach") as caught:
        refused.report("synth dwell")
    assert caught.value.key == "dwell.tolerance"
    shown = Decimal(str(caught.value).partition("at most ")[2].split()[0])  # rounded to the safe side
    limit, digit = float(shown), 10.0 ** int(shown.as_tuple().exponent)
    less = design({**base, "dwell": {**dwell, "tolerance": limit * (1.0 - 1e-6)}}, command="synth dwell")
    assert less.report("synth dwell").quantities
    more = design({**base, "dwell": {**dwell, "tolerance": limit + 1.01 * digit}}, command="synth dwell")
    with pytest.raises(NoSolution, match="out of reach"):
        _ = more.linkage


@pytest.mark.quick(2)
@pytest.mark.parametrize("tolerance", [10.0, 20.0, 31.0, 45.0])
def test_the_reach_of_an_idler_rises_to_one_maximum_and_falls(tolerance: float) -> None:
    """Which the ratios that reach a window stand on: its maximum is 180 deg + 2 tau where it is not at infinity."""
    ratios = np.geomspace(0.1, 1e3, 400)
    reached = [math.degrees(symmetric.reach(-ratio, rad(tolerance))) for ratio in ratios]
    turns = np.flatnonzero(np.diff(np.sign(np.diff(reached))))
    assert len(turns) == (1 if tolerance < 32.0 else 0)
    assert max(reached) == pytest.approx(180.0 + 2.0 * tolerance, abs=0.02) if tolerance < 32.0 else reached[-1]
    window = 0.5 * (max(reached) + reached[-1]) if tolerance < 32.0 else 0.99 * reached[-1]
    low, high = symmetric.reaching_ratios(rad(window), rad(tolerance))
    inside = [low <= ratio <= high for ratio in ratios]
    assert inside == [value >= window for value in reached]


@pytest.mark.parametrize(("idler", "window", "tolerance"), [(20, 150.0, 46.0), (20, 150.0, 60.0), (20, 240.0, 45.0)])
def test_equal_gears_keep_a_band_that_no_back_step_fills(idler: int, window: float, tolerance: float) -> None:
    """A back-step of 40/20/40 teeth is below 90 deg: a band of +-45 deg and more cannot be filled, but met."""
    base = {"kind": "three-gear-four-bar", "gears": {"module": 2, "crank": 40, "idler": idler, "output": 40}}
    wide = design({**base, "dwell": {"window": window, "tolerance": tolerance}}, command="synth dwell")
    assert wide.linkage == design({**base, "dwell": {"window": window}}, command="synth dwell").linkage
    assert wide.window_limit is None
    assert wide.dwell_tolerance < math.radians(45.0)
    low, high = wide.frame_ratio_interval
    assert low == 1.0
    for ratio, met in ((1.0 + 1e-4, True), (0.5 * (low + high), True), (high - 1e-6, True), (high + 1e-6, False)):
        made = symmetric_linkage(ratio, 60.0)
        found = Output(made, GearTrain(40, idler, 40)).within(math.radians(tolerance)).crank_angle
        assert (found > math.radians(window)) is met, ratio


def test_a_long_window_is_refused_by_the_longest_within_the_tolerance() -> None:
    """The family ends with 119.3 deg, at a wider band."""
    gears = {"module": 2, "crank": 52, "idler": 118, "output": 36}
    request = {"window": 125.9, "tolerance": 4.781, "crank": 11.8}
    base = {"kind": RING["kind"], "gears": gears}
    refused = design({**base, "dwell": request}, command="synth dwell")
    with pytest.raises(NoSolution, match=r"dwell within \+-4\.781 deg: 125\.9 deg \(limit <= ") as caught:
        _ = refused.linkage
    longest = float(str(caught.value).partition("limit <= ")[2].split()[0])
    made = design({**base, "dwell": {**request, "window": longest}}, command="synth dwell")
    assert made.tolerance_dwell_angle >= math.radians(longest)
