"""Hypocycloid dwell.

Tolerances: reference cases 1e-14 of the planet's radius (no difference of large lengths), angles 1e-11 deg; the closed
form of |MH0|^2 - L^2 for three cusps 1e-14 of the rod squared; mpmath 4 eps of the rod. Rods that are best in some
sense are known to about 1e-9 (golden section); they are held to quality against a scan of 500 rods, not to a number.
"""

import json
import math
from functools import partial
from pathlib import Path

import factory
import mpmath as mp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracles.hypocycloid import acceleration, jerk
from sweeps import examples

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.dwell_gears.hypocycloid_design import (
    HypocycloidSlider,
    least_ripple,
    minimax,
    osculating,
    tangent_circle,
    widest_dwell,
    widest_offset,
)

REFERENCE = Path(__file__).parents[2] / "reference"
CASES = {case["id"]: case for case in json.loads((REFERENCE / "gear_linkage.json").read_text())["cases"]}
OUT = CASES["hypocycloid_3"]["outputs"]
ARC = math.radians(120.0)


@pytest.mark.parametrize("cusps", [3, 4, 5])
def test_rates_are_each_other_s_slopes(cusps):
    """Central differences over 1e-5 rad: 1e-8 of the largest, some tens of the planet's radius."""
    slider = HypocycloidSlider(1.0, cusps, 4.0 * cusps)
    t, h = np.linspace(-2.9, 3.1, 25), 1e-5
    for rate, slope in (
        (lambda x: -slider.deviation(x), slider.speed),
        (slider.speed, partial(acceleration, slider)),
        (partial(acceleration, slider), partial(jerk, slider)),
    ):
        for x in t:
            assert slope(x) == pytest.approx((rate(x + h) - rate(x - h)) / (2.0 * h), abs=1e-7)


@pytest.mark.parametrize("rod", [7.0, 8.0, 7.5])
def test_reference_deviations(rod):
    out, slider = OUT[f"L{rod}"], HypocycloidSlider(1.0, 3, rod)
    assert slider.deviation(math.radians(60.0)) == pytest.approx(out["dev60"], abs=1e-14)
    assert slider.deviation(math.radians(30.0)) == pytest.approx(out["dev30"], abs=1e-14)
    assert slider.deviation(math.pi) == pytest.approx(out["stroke_end"], abs=1e-14)
    inner = slider.extremes[1:-1]
    assert [math.degrees(t) for t, _ in inner] == pytest.approx(out["extrema_deg"], abs=1e-11)
    assert [value for _, value in inner] == pytest.approx(out["extrema_dev_over_r"], abs=1e-14)


def test_reference_dwell_within_the_ripple():
    """The band of the ripple itself, a hair wider so that its own hump stays inside."""
    hump = OUT["L7.0"]["extrema_dev_over_r"][0]
    angle = HypocycloidSlider(1.0, 3, 7.0).dwell_angle(0.5 * hump * (1.0 + 1e-13))
    assert math.degrees(angle) == pytest.approx(OUT["L7_dwell_deg_tol_full"], abs=1e-9)


@examples(100)
@given(st.floats(0.1, 50.0), st.floats(2.7, 40.0), st.floats(-3.1, 3.1))
def test_closed_form_for_three_cusps(r, ratio, t):
    slider, c = HypocycloidSlider(r, 3, ratio * r), math.cos(t)
    rest = r + slider.rod
    away = abs(slider.point(t) - rest) ** 2 - slider.rod**2
    expected = 4.0 * r * r * (1.0 - c) * (4.0 * c * c + (3.0 - ratio) * c + 1.0)
    assert away == pytest.approx(expected, abs=2e-14 * (rest + 3 * r) ** 2)


@examples(60)
@given(st.integers(3, 8), st.floats(1.05, 5.0), st.floats(1e-4, 3.1))
def test_deviation_keeps_its_digits(cusps, share, t):
    rod = share * widest_offset(1.0, cusps)
    with mp.workdps(40):
        k, tt, long = cusps - 1, mp.mpf(t), mp.mpf(rod)
        x, y = k * mp.cos(tt) - mp.cos(k * tt), k * mp.sin(tt) + mp.sin(k * tt)
        exact = float((k - 1) + long - (x + mp.sqrt(long**2 - y**2)))
        terms = float(y * y / (long + mp.sqrt(long**2 - y * y)) + abs(x - k + 1))
        near = float(long / mp.sqrt(long**2 - y**2))  # the root of a small difference
    assert HypocycloidSlider(1.0, cusps, rod).deviation(t) == pytest.approx(
        exact, abs=1e-15 * terms * (4 + near) * cusps
    )


def test_rates_are_derivatives():
    slider, h = HypocycloidSlider(20.0, 4, 120.0), 1e-5
    for t in (0.3, 1.2, 2.9):
        slope = -(slider.deviation(t + h) - slider.deviation(t - h)) / (2 * h)
        assert slider.speed(t) == pytest.approx(slope, abs=1e-7)
        bend = (slider.speed(t + h) - slider.speed(t - h)) / (2 * h)
        assert acceleration(slider, t) == pytest.approx(bend, abs=1e-6)


def test_the_planet_rolls_without_slip():
    """The point is the carrier's end plus the planet's radius, turned back by n - 1 per carrier turn."""
    for cusps in (3, 4, 7):
        slider = HypocycloidSlider(2.0, cusps, 100.0)
        for t in (0.0, 0.4, 2.0):
            center = 2.0 * (cusps - 1) * complex(math.cos(t), math.sin(t))
            radius = slider.point(t) - center
            assert abs(radius) == pytest.approx(2.0, rel=1e-14)
            turned = radius * complex(math.cos((cusps - 1) * t), math.sin((cusps - 1) * t))
            assert turned == pytest.approx(-2.0, abs=1e-13)


def test_named_circles():
    assert tangent_circle(1.0, 3) == pytest.approx(7.0, rel=1e-15)
    assert osculating(1.0, 3) == 8.0
    slider = HypocycloidSlider(1.0, 3, 8.0)
    ratio = slider.deviation(2e-2) / slider.deviation(1e-2)
    assert ratio == pytest.approx(16.0, rel=2e-3)  # fourth order in mid-dwell
    other = HypocycloidSlider(1.0, 3, 7.9)
    assert other.deviation(2e-2) / other.deviation(1e-2) == pytest.approx(4.0, rel=2e-2)
    for cusps in (3, 4, 5):
        half = math.pi / cusps
        rod = tangent_circle(1.0, cusps)
        center = cusps - 2 + rod
        cusp = complex(cusps * math.cos(half), cusps * math.sin(half))
        assert abs(cusp - center) == pytest.approx(rod, rel=1e-14)


def test_widest_offset_against_sampling():
    t = np.linspace(0.0, math.pi, 5001)
    for cusps in range(3, 12):
        # y of the point by theory's own sum, (n - 1) sin t + sin((n - 1) t)
        top = np.abs((cusps - 1) * np.sin(t) + np.sin((cusps - 1) * t)).max()
        assert -1e-12 <= widest_offset(1.0, cusps) - top < 1e-3


RODS = [3.0 + 11.0 * i / 150 for i in range(151)]


@pytest.mark.slow
@pytest.mark.parametrize("degrees", [120.0, 90.0, 45.0])
def test_minimax_and_least_ripple_against_a_scan(degrees):
    angle = math.radians(degrees)
    sliders = [HypocycloidSlider(1.0, 3, rod) for rod in RODS]

    def greatest(slider):
        low, high = slider.deviation_range(angle)
        return max(high, -low)

    found = HypocycloidSlider(1.0, 3, minimax(1.0, 3, angle))
    assert greatest(found) <= min(map(greatest, sliders))
    low, high = found.deviation_range(angle)
    assert high == pytest.approx(-low, rel=1e-6)
    assert tangent_circle(1.0, 3, angle) < found.rod < 8.0
    calm = HypocycloidSlider(1.0, 3, least_ripple(1.0, 3, angle))
    assert calm.ripple(angle) <= min(s.ripple(angle) for s in sliders)
    assert calm.rod == pytest.approx(tangent_circle(1.0, 3, angle), rel=1e-8)


@pytest.mark.quick(1)
@pytest.mark.parametrize("tolerance", [0.001, 0.01, 0.0111, 0.05])
def test_widest_dwell_against_a_scan(tolerance):
    found = HypocycloidSlider(1.0, 3, widest_dwell(1.0, 3, tolerance)).dwell_angle(tolerance)
    assert found >= max(HypocycloidSlider(1.0, 3, rod).dwell_angle(tolerance) for rod in RODS)


@pytest.mark.quick(2)
@pytest.mark.parametrize("rod", [7.0, 8.0, 7.3, 6.5])
def test_dwell_angle_against_sampling(rod):
    slider, tolerance = HypocycloidSlider(1.0, 3, rod), 0.013
    low = high = 0.0
    t = 0.0
    while high - low <= 2.0 * tolerance:
        t += 1e-4
        low, high = min(low, slider.deviation(t)), max(high, slider.deviation(t))
    assert slider.dwell_angle(tolerance) == pytest.approx(2.0 * t, abs=4e-4)


def test_scale():
    small, large = HypocycloidSlider(1.0, 4, 6.0), HypocycloidSlider(30.0, 4, 180.0)
    assert large.stroke == pytest.approx(30.0 * small.stroke, rel=1e-14)
    assert large.dwell_angle(0.3) == pytest.approx(small.dwell_angle(0.01), rel=1e-12)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: HypocycloidSlider(1.0, 3, 2.59), r"rod: 2\.59 mm .limit > 2\.598"),
        (lambda: HypocycloidSlider(1.0, 2, 9.0), "straight line"),
        (lambda: HypocycloidSlider(0.0, 3, 9.0), "radius"),
        (lambda: tangent_circle(1.0, 3, math.radians(300.0)), "at most the whole arc, 120 deg"),
        (lambda: minimax(1.0, 3, math.radians(121.0)), "at most 120 deg"),
        (lambda: HypocycloidSlider(1.0, 3, 7.0).dwell_angle(2.0), "below 2 mm, half the stroke"),
        (lambda: HypocycloidSlider(1.0, 3, 7.0).dwell_angle(0.0), "above 0"),
    ],
)
def test_refusals(call, words):
    with pytest.raises(NoSolution, match=words):
        call()


design = partial(factory.design, {"kind": "hypocycloid-dwell", "gears": {"module": 2.0, "planet": 25, "ring": 75}})


def test_rules_and_lengths():
    assert design(rod={"rule": "tangent-circle"}).rod_length == pytest.approx(175.0, rel=1e-15)
    assert design(rod={"rule": "osculating"}).rod_length == 200.0
    assert design(rod={"length": 190.0}).rod_length == 190.0
    assert design(rod={"rule": "minimax"}).rod_length == pytest.approx(25.0 * minimax(1.0, 3, ARC), rel=1e-8)


def test_four_cusps_and_a_share_of_the_arc():
    made = design(
        gears={"module": 2.0, "planet": 25, "ring": 100}, rod={"rule": "tangent-circle"}, dwell={"angle": 60.0}
    )
    assert made.cusps == 4
    assert made.slider.deviation(math.radians(30.0)) == pytest.approx(0.0, abs=1e-12)
    assert 0.0 < made.dwell_ripple < 0.5 * made.slider.ripple(math.radians(90.0))


def test_motion_table():
    made = design(rod={"rule": "tangent-circle"})
    data = dict(zip(made.table("motion").columns, made.table("motion").data, strict=True))
    assert data["deviation"][60] == pytest.approx(0.0, abs=1e-12)
    assert data["deviation"][300] == pytest.approx(data["deviation"][60], abs=1e-12)
    assert data["deviation"][180] == pytest.approx(100.0, rel=1e-14)
    assert max(data["rod_angle"]) <= math.degrees(made.slider.max_rod_angle) + 1e-12
