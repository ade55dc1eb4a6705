"""The geared five-bar: path form, function form, and both syntheses.

Tolerances: reference cases (40 digits, rounded to double) 1e-13 of a length, 1e-12 deg; closing of the loop 1e-14 of
the links times 1/sin(gamma) of the dyad; rates against central differences 1e-7. Syntheses: positions 1e-12 rad on the
motion of the result (1e-9 is the engine's own limit), a path that is known to exist 1e-9 mm.
"""

import cmath
import json
import math
from dataclasses import replace
from fractions import Fraction
from functools import partial
from itertools import pairwise
from pathlib import Path

import factory
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sweeps import ALL, examples, mostly_slow

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.five_bar.fit import fit_path, judge
from gearlink.core.machines.five_bar.function_fit import five_bar_for_positions
from gearlink.core.machines.five_bar.function_motion import FunctionFiveBar
from gearlink.core.machines.five_bar.path import coupler_angles, distances, points, rates, spread
from gearlink.core.machines.five_bar.path_motion import PathFiveBar
from gearlink.core.numerics.harmonic_sum import HarmonicSum
from gearlink.core.numerics.quasi_random import halton
from gearlink.core.parts.linkages.dyad import close_dyad, transmission_angle
from gearlink.core.parts.linkages.fourbar.position import FourBar, solve

REFERENCE = Path(__file__).parents[2] / "reference"
CASES = {case["id"]: case for case in json.loads((REFERENCE / "gear_linkage.json").read_text())["cases"]}
OUT = CASES["five_bar"]["outputs"]
BAR = PathFiveBar(20.0, 60.0, 60.0, 20.0, 50.0, Fraction(-1), math.radians(90.0))
FUNCTION = FunctionFiveBar(45.0, 18.0, 40.0, 40.0, 38.0, 1.8, math.radians(154.0))
RADIANS = math.radians


# Parts


@examples(200)
@given(
    st.floats(1.0, 50.0), st.floats(1.0, 50.0), st.floats(0.01, 0.99), st.floats(-3.1, 3.1), st.sampled_from((1, -1))
)
def test_dyad_closes(b, c, share, turn, side):
    n = abs(b - c) + share * (b + c - abs(b - c))
    start, end = 3.0 - 7.0j, 3.0 - 7.0j + cmath.rect(n, turn)
    pin = close_dyad(start, end, b, c, side)
    assert abs(pin - start) == pytest.approx(b, rel=1e-13)
    assert abs(pin - end) == pytest.approx(c, rel=1e-13, abs=1e-13 * b)
    assert math.copysign(1.0, ((end - start).conjugate() * (pin - start)).imag) == side
    angle = abs(cmath.phase((start - pin) / (end - pin)))
    assert transmission_angle(n, b, c) == pytest.approx(angle, abs=1e-12)


@pytest.mark.parametrize(("n", "words"), [(12.0, "lengthen the links by 1 mm"), (0.5, "their difference by 0.5 mm")])
def test_dyad_that_does_not_reach(n, words):
    with pytest.raises(NoSolution, match=words):
        close_dyad(0j, complex(n), 6.0, 5.0, 1)


def test_harmonic_sum_against_sampling():
    made = HarmonicSum(3.0, ((2.0, 1.0, 0.4), (-1.5, -2.5, 1.0), (0.7, 6.0, 0.0)))
    x = np.linspace(0.0, 4.0 * math.pi, 200001)
    sampled = 3.0 + 2.0 * np.cos(x + 0.4) - 1.5 * np.cos(-2.5 * x + 1.0) + 0.7 * np.cos(6.0 * x)
    (_, low), (_, high) = made.extremes(0.0, 4.0 * math.pi)
    assert 0.0 <= sampled.min() - low < 1e-6
    assert 0.0 <= high - sampled.max() < 1e-6


def test_halton_is_even_and_fixed():
    rows = halton(1, 2000, 5)
    assert np.allclose(rows.mean(axis=0), 0.5, rtol=0.0, atol=0.01)
    assert halton(7, 1, 2)[0] == pytest.approx([0.875, 5.0 / 9.0], rel=1e-15)


# Path form


def test_reference_path():
    for degrees, t2, x, y in OUT["rows_phi_t2_Mx_My"]:
        phi = RADIANS(degrees)
        point = BAR.point(phi, 60.0 + 0j)
        assert math.degrees(BAR.coupler_angle(phi)) == pytest.approx(t2, abs=1e-12)
        assert (point.real, point.imag) == pytest.approx((x, y), rel=1e-13)


def test_the_room_in_which_a_five_bar_closes_is_that_of_a_fine_grid():
    """GL305, which only passes: what does not close is refused before."""
    made = factory.design("five_bar_path")
    bar, (check,) = made.path_bar, made.check("closure")
    ends = [bar.ends(bar.period * i / 4000) for i in range(4000)]
    spans = [abs(one - other) for one, other in ends]
    room = min(bar.coupler + bar.follower - max(spans), min(spans) - abs(bar.coupler - bar.follower))
    assert (check.code, check.status, check.unit) == ("GL305", "pass", "mm")
    assert check.value == pytest.approx(room, rel=1e-5)


def test_reference_closure():
    (low, least), (high, greatest) = BAR.span_extremes
    assert (least, greatest) == pytest.approx((OUT["BD_min"], OUT["BD_max"]), rel=1e-14)
    assert math.degrees(low) == pytest.approx(OUT["BD_min_phi_deg"], abs=1e-11)
    assert math.degrees(high) == pytest.approx(OUT["BD_max_phi_deg"], abs=1e-11)
    BAR.closure()


def test_a_ratio_of_one_on_one_side_is_a_four_bar():
    """An output link so short that D stays at E: the five-bar is the four-bar of the other links."""
    bar = PathFiveBar(20.0, 70.0, 60.0, 1e-12, 80.0, Fraction(1), 0.0)
    linkage = FourBar(20.0, 70.0, 60.0, 80.0)
    for phi in (0.3, 2.0, 5.5):
        assert bar.coupler_angle(phi) == pytest.approx(solve(linkage, phi).coupler_angle, abs=1e-13)


@pytest.mark.parametrize("ratio", [Fraction(-1), Fraction(2, 3), Fraction(-5, 4), Fraction(3)])
def test_sweep_follows_the_scalar_kernel_over_the_whole_period(ratio):
    bar, offset = replace(BAR, ratio=ratio, coupler=70.0, follower=65.0), 30.0 + 12.0j
    phi = np.linspace(0.0, bar.period, 97)
    point, angle = points(bar, phi, offset), coupler_angles(bar, phi)
    for i, x in enumerate(phi):
        assert point[i] == pytest.approx(bar.point(float(x), offset), abs=1e-11)
        turns = (angle[i] - bar.coupler_angle(float(x))) / (2.0 * math.pi)
        assert turns == pytest.approx(round(turns), abs=1e-12)
    assert point[-1] == pytest.approx(point[0], abs=1e-11)
    assert np.max(np.abs(np.diff(angle))) < math.pi
    h = 1e-6
    slope = (points(bar, phi + h, offset) - points(bar, phi - h, offset)) / (2.0 * h)
    assert rates(bar, phi, offset)[0] == pytest.approx(slope, abs=1e-6)


def test_coarse_rows_keep_the_winding():
    bar = PathFiveBar(60.0, 50.0, 48.0, 10.0, 20.0, Fraction(1), 1.0)
    fine = coupler_angles(bar, np.linspace(0.0, bar.period, 721))
    coarse = coupler_angles(bar, np.linspace(0.0, bar.period, 4))
    assert coarse == pytest.approx(fine[::240], abs=1e-11)
    assert coarse[-1] - coarse[0] == pytest.approx(2.0 * math.pi, abs=1e-11)


def test_mirror_image():
    mirrored = replace(BAR, phase=-BAR.phase, assembly=-1)
    for phi in (0.0, 1.0, 4.0):
        assert mirrored.point(-phi, 60 - 5j) == pytest.approx(BAR.point(phi, 60 + 5j).conjugate(), abs=1e-12)


def test_extent_and_distances():
    offset = 60.0 + 0j
    left, right, low, high = spread(BAR, offset)
    path = points(BAR, np.linspace(0.0, BAR.period, 100001), offset)
    assert (left.value, right.value) == pytest.approx((path.real.min(), path.real.max()), abs=1e-6)
    assert (low.value, high.value) == pytest.approx((path.imag.min(), path.imag.max()), abs=1e-6)
    targets = np.array([10 + 50j, 60 + 60j, *points(BAR, np.array([0.7, 3.3]), offset)])
    away, phi = distances(BAR, offset, targets)
    sampled = np.min(np.abs(path[None, :] - targets[:, None]), axis=1)
    assert away[:2] == pytest.approx(sampled[:2], abs=1e-6)
    assert away[2:] == pytest.approx([0.0, 0.0], abs=1e-6)
    assert phi[2:] == pytest.approx([0.7, 3.3], abs=1e-7)


def test_least_transmission_angle_against_sampling():
    angle, place = BAR.min_transmission_angle()
    spans = [abs(d - b) for b, d in (BAR.ends(float(phi)) for phi in np.linspace(0.0, BAR.period, 20001))]
    gamma = [math.acos((BAR.coupler**2 + BAR.follower**2 - n * n) / (2.0 * BAR.coupler * BAR.follower)) for n in spans]
    assert angle == pytest.approx(min(min(each, math.pi - each) for each in gamma), abs=1e-6)
    assert place == pytest.approx(RADIANS(OUT["BD_min_phi_deg"]), abs=1e-12)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"coupler": 100.0}, "limit >= 40 mm, .* at input angle 287.1 deg .* by more than 4.645 mm"),
        (
            {"coupler": 40.0, "follower": 42.0},
            "BD 83.24 mm .limit <= 82 mm, .* at input angle 135 deg .* than 1.238 mm",
        ),
        ({"ratio": Fraction(-3, 2), "coupler": 40.0, "follower": 42.0}, "of 720"),
    ],
)
def test_opening_is_refused_with_the_worst_angle(change, words):
    with pytest.raises(NoSolution, match=words):
        replace(BAR, **change).closure()


def test_remedy_closes_it():
    with pytest.raises(NoSolution):
        replace(BAR, coupler=40.0, follower=42.0).closure()
    replace(BAR, coupler=40.0, follower=43.2373).closure()


# Function form


def test_function_closes_and_its_speed_is_the_derivative():
    for phi in (1.1, 1.8, 2.4):
        end = FUNCTION.end(phi)
        assert abs(end - FUNCTION.joint(phi)) == pytest.approx(40.0, rel=1e-14)
        assert abs(end - 38.0) == pytest.approx(40.0, rel=1e-14)
        h = 1e-6
        slope = (FUNCTION.output_angle(phi + h) - FUNCTION.output_angle(phi - h)) / (2.0 * h)
        speed, acceleration = FUNCTION.output_rates(np.array([phi - h, phi, phi + h]))
        assert speed[1] == pytest.approx(slope, abs=1e-8)
        assert acceleration[1] == pytest.approx((speed[2] - speed[0]) / (2.0 * h), abs=1e-8)
        assert FUNCTION.directions(np.array([phi]))[0] == pytest.approx(FUNCTION.output_angle(phi), rel=1e-14)


def test_planet_rolls_on_the_fixed_sun():
    """The tooth of the planet that touches the sun stands still."""
    z2, z5, a = 25, 20, 45.0
    bar = replace(FUNCTION, coupler_ratio=1.0 + z5 / z2)
    pitch = a * z5 / (z2 + z5)
    phi, h = 1.3, 1e-6
    contact = cmath.rect(pitch, phi)

    def tooth(x):
        pin = cmath.rect(a, x)
        spin = cmath.exp(1j * bar.coupler_ratio * (x - phi))
        return pin + (contact - cmath.rect(a, phi)) * spin

    assert abs(tooth(phi + h) - tooth(phi - h)) / (2.0 * h) < 1e-8


def test_output_angles_do_not_jump():
    angles = [RADIANS(60.0 + 80.0 * i / 400) for i in range(401)]
    fine = FUNCTION.output_angles(angles)
    assert max(abs(q - p) for p, q in pairwise(fine)) < 0.05
    assert FUNCTION.output_angles([angles[0], angles[-1]])[1] == pytest.approx(fine[-1], abs=1e-12)


# Syntheses


@pytest.mark.slow
@pytest.mark.parametrize("count", mostly_slow([5, 2, 3, 4], 1))
def test_positions_are_met_on_the_real_motion(count):
    pairs = [(60.0, 60.0), (80.0, 63.75), (100.0, 75.0), (120.0, 93.75), (140.0, 120.0)][:count]
    positions = [(RADIANS(p), RADIANS(q)) for p, q in pairs]
    start = FunctionFiveBar(45.0, 27.0, 72.0, 54.0, 90.0, 1.8, RADIANS(60.0))
    bar = five_bar_for_positions(start, positions, RADIANS(40.0))
    assert (bar.input, bar.coupler_ratio) == (45.0, 1.8)
    assert max(map(abs, bar.position_errors(positions))) < 1e-12
    assert bar.min_transmission_angle(positions[0][0], positions[-1][0])[0] >= RADIANS(40.0)
    for phi, psi in positions:  # the loop itself, by complex numbers
        gap = bar.joint(phi) - bar.frame - cmath.rect(bar.output, psi)
        assert abs(gap) == pytest.approx(bar.follower, rel=1e-12)
    if ALL:
        assert five_bar_for_positions(start, positions, RADIANS(40.0)) == bar


@pytest.mark.slow
@pytest.mark.parametrize("length", ["coupler", "output"])
def test_a_start_with_a_link_far_too_long_is_refused(length):
    pairs = [(60.0, 60.0), (80.0, 63.75), (100.0, 75.0), (120.0, 93.75), (140.0, 120.0)]
    positions = [(RADIANS(p), RADIANS(q)) for p, q in pairs]
    start = replace(FunctionFiveBar(45.0, 27.0, 72.0, 54.0, 90.0, 1.8, RADIANS(60.0)), **{length: 1e12})
    with pytest.raises(NoSolution, match="start from other links"):
        five_bar_for_positions(start, positions)


def test_whole_turns_count_as_errors():
    reached = FUNCTION.output_angles([1.2, 2.0])
    exact = [(1.2, reached[0]), (2.0, reached[1])]
    assert FUNCTION.position_errors(exact) == pytest.approx([0.0, 0.0], abs=1e-14)
    wound = [(1.2, reached[0]), (2.0, reached[1] + 2.0 * math.pi)]
    assert FUNCTION.position_errors(wound)[1] == pytest.approx(-2.0 * math.pi, abs=1e-14)


@pytest.mark.quick(2)
@pytest.mark.parametrize(
    ("pairs", "words"),
    [
        ([(0.0, 0.0)], "give two to 5"),
        ([(float(i), float(i)) for i in range(6)], "give two to 5"),
        ([(1.0, 0.0), (0.5, 1.0)], "must ascend"),
        ([(0.0, 0.0), (0.01, 3.0), (0.02, 0.0), (0.03, 3.0), (0.04, 0.0)], "no five-bar was found"),
    ],
)
def test_positions_refused(pairs, words):
    with pytest.raises(NoSolution, match=words):
        five_bar_for_positions(FUNCTION, pairs)


@pytest.mark.slow
def test_path_that_exists_is_found():
    true = PathFiveBar(17.0, 66.0, 52.0, 24.0, 50.0, Fraction(-1), RADIANS(40.0))
    targets = points(true, np.linspace(0.0, 6.0, 15), 40.0 + 25.0j)
    fit = fit_path(BAR, 60.0 + 0j, targets, RADIANS(25.0))
    assert fit.distance.max() < 1e-9
    again = judge(fit.bar, fit.offset, targets)
    assert again.distance.tolist() == fit.distance.tolist()


@pytest.mark.slow
def test_fit_never_loses_to_its_start_and_keeps_its_limits():
    targets = np.array([-10 + 60j, 10 + 70j, 30 + 75j, 50 + 70j, 60 + 55j, 30 + 50j, 0 + 50j])
    fit = fit_path(BAR, 60.0 + 0j, targets, RADIANS(30.0))
    assert fit.rms <= judge(BAR, 60.0 + 0j, targets).rms
    assert fit.rms < 0.6
    assert fit.bar.min_transmission_angle()[0] >= RADIANS(30.0)
    fit.bar.closure()
    path = points(fit.bar, np.linspace(0.0, fit.bar.period, 20001), fit.offset)
    sampled = np.min(np.abs(path[None, :] - targets[:, None]), axis=1)
    assert np.all(fit.distance <= sampled + 1e-12)
    assert fit.distance == pytest.approx(sampled, abs=5e-3)


@pytest.mark.slow
def test_fit_is_the_same_at_any_scale():
    """A power of two changes no digit: a search that took another way would end elsewhere in its flat minimum."""
    targets = np.array([-10 + 60j, 10 + 70j, 30 + 75j, 50 + 70j, 60 + 55j])
    one = fit_path(BAR, 60.0 + 0j, targets, RADIANS(30.0))
    large = replace(BAR, input=320.0, coupler=960.0, follower=960.0, output=320.0, frame=800.0)
    other = fit_path(large, 960.0 + 0j, 16.0 * targets, RADIANS(30.0))
    assert (16.0 * one.distance).tolist() == other.distance.tolist()
    assert (16.0 * one.bar.coupler, one.bar.phase) == (other.bar.coupler, other.bar.phase)


@pytest.mark.parametrize(("targets", "words"), [([0j, 1 + 0j], "at least three"), ([1j, 1j, 1j], "the same")])
def test_fit_refused(targets, words):
    with pytest.raises(NoSolution, match=words):
        fit_path(BAR, 60.0 + 0j, np.array(targets), 0.0)


# The design


PATH = {
    "kind": "geared-five-bar",
    "gears": {"module": 2.5, "input": 20, "output": 20},
    "links": {"input": 20.0, "coupler": 60.0, "follower": 60.0, "output": 20.0},
    "phase": 90.0,
    "coupler_point": {"along": 60.0},
}
path_design = partial(factory.design, PATH)


def test_ratio_period_and_table():
    made = path_design(gears={"module": 2.5, "input": 16, "output": 24})
    assert (made.ratio, made.period_turns, made.frame_length) == (Fraction(-2, 3), 3, 50.0)
    table = made.table("path")
    assert len(table.data[0]) == 3 * 360
    data = dict(zip(table.columns, table.data, strict=True))
    assert data["output_angle"][-1] == pytest.approx(90.0 - 2.0 / 3.0 * 1079.0, rel=1e-12)
    internal = path_design(gears={"module": 2.5, "input": 20, "output": 60, "mesh": "internal"})
    assert (internal.ratio, internal.frame_length) == (Fraction(1, 3), 50.0)


def test_phase_step_is_one_tooth():
    made = path_design()
    moved = 20.0 * made.phase_step  # a whole revolution of the output link is as many steps as it has teeth
    assert moved == pytest.approx(2.0 * math.pi, rel=1e-15)


def test_whole_period_is_the_range_of_a_function_without_one():
    data = {
        "kind": "geared-five-bar",
        "form": "function",
        "gears": {"module": 2.0, "planet": 20, "sun": 20},
        "links": {"coupler": 10.0, "follower": 90.0, "output": 90.0, "frame": 100.0},
        "phase": 0.0,
    }
    made = factory.design(data)
    assert made.input_range == (0.0, 2.0 * math.pi)
    table = made.table("function")
    assert table.data[1][-1] == pytest.approx(table.data[1][0], abs=1e-11)


@pytest.mark.parametrize(("length", "change", "factor"), [(60.0, "shorten", 0.98), (43.0, "lengthen", 1.02)])
def test_links_that_fold_are_to_be_shortened_and_stretched_ones_lengthened(
    length: float, change: str, factor: float
) -> None:
    """It said always to lengthen both, which made folded ones worse."""

    def of(length: float):
        links = {"input": 20.0, "coupler": length, "follower": length, "output": 20.0}
        return factory.design("five_bar_path", links=links, limits={"transmission_angle": 50.0})

    (found,) = of(length).check("transmission-angle")
    assert (found.status, found.advice) == ("fail", f"{change} coupler and follower")
    assert of(factor * length).min_transmission_angle > of(length).min_transmission_angle


@pytest.mark.parametrize("name", ["five_bar_points", "five_bar_positions"])
def test_links_that_were_found_are_not_to_be_changed(name: str) -> None:
    (found,) = factory.design(name).check("transmission-angle")
    assert found.advice.startswith("start from other links")
