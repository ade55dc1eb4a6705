"""Offset slider-crank: crank from stroke, dead centres, position and derivatives, scalar and sweep.

Tolerances
* reference cases and mpmath: 8 eps relative for crank, stroke and ratio; angles whose tangent is e/Q carry the
  condition number of Q in the data, S/(S_max - S) from the stroke and r/(L - r - |e|) from the crank.
* position: 8 eps of the largest length; derivatives: 32 eps of that times (L/w)^2 and (L/w)^4, the powers in
  which the rod's projection w stands below.
"""

import json
import math
from pathlib import Path

import factory
import mpmath as mp
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from sweeps import examples

from gearlink.core.base.errors import NoSolution
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.parts.linkages import slider_crank
from gearlink.core.parts.linkages.slider_crank import SliderCrank, slider_sweep

EPS = 2.0**-52
REFERENCE = Path(__file__).parents[2] / "reference"
CASES = [
    (c["input"], c["expect"]) for c in json.loads((REFERENCE / "flatbed_press.json").read_text())["slider_crank"]
] + [(c["spec"], c["quantities"]) for c in json.loads((REFERENCE / "contract" / "crank.json").read_text())]


@pytest.fixture(autouse=True)
def _digits():
    with mp.workdps(50):
        yield


def exact_stroke(crank, rod, offset):
    r, length, e = (mp.mpf(v) for v in (crank, rod, offset))
    return mp.sqrt((length + r) ** 2 - e**2) - mp.sqrt((length - r) ** 2 - e**2)


def exact_crank(stroke, rod, offset):
    """Bisection on the stroke's own equation: knows nothing of the closed form and of its false root."""
    low, high = mp.mpf(0), mp.mpf(rod) - abs(mp.mpf(offset))
    for _ in range(150):
        middle = (low + high) / 2
        low, high = (low, middle) if exact_stroke(middle, rod, offset) > stroke else (middle, high)
    return low


@pytest.mark.parametrize(("data", "wanted"), CASES)
def test_reference_cases(data, wanted):
    design = SliderCrank(data["stroke"], data["rod"], data["offset"])
    back = SliderCrank.of_crank(design.crank_length, data["rod"], data["offset"])
    for name, value in wanted.items():
        got = [getattr(design, name)]
        if name == "max_stroke":
            got.append(slider_crank.max_stroke(data["rod"], data["offset"]))
        elif name != "crank_length":
            got.append(getattr(back, name))
        got = [math.degrees(v) for v in got] if name.startswith("dead_center") else got
        assert got == pytest.approx([value] * len(got), rel=8 * EPS, abs=0.0), name


strokes = st.tuples(st.floats(1e-3, 1.0 - 1e-9), st.floats(1.0, 1e3), st.floats(-0.999, 0.999))


@examples(100)
@given(strokes)
def test_crank_against_bisection(drawn):
    share, rod, part = drawn
    offset = part * rod
    stroke = share * slider_crank.max_stroke(rod, offset)
    design = SliderCrank(stroke, rod, offset)
    with mp.workdps(50):
        r = exact_crank(stroke, rod, offset)
        near = mp.sqrt((rod - r) ** 2 - mp.mpf(offset) ** 2)
        folded, extended = mp.atan2(offset, near), mp.asin(offset / (rod + r))
        t = folded - extended
        ratio = (mp.pi + t) / (mp.pi - t)
    # L - |e| is exact, but L and |e| near one another are data whose difference the largest stroke hangs on
    assert abs(design.crank_length - float(r)) <= 8 * EPS * float(r)
    steep = 1.0 + 1.0 / (1.0 - share)
    assert abs(design.dead_center_folded - float(folded)) <= 8 * EPS * steep * abs(float(folded))
    assert abs(design.dead_center_extended - float(extended)) <= 8 * EPS * abs(float(extended))
    assert abs(design.quick_return_ratio - float(ratio)) <= 16 * EPS * steep * float(ratio)


def test_crank_against_the_bracketed_root_finder():
    for stroke in (1.0, 50.0, 200.0, 310.0, 700.0, 980.0):
        root = bracketed_root(lambda r, s=stroke: float(exact_stroke(r, 520.0, 50.0)) - s, 1e-3, 470.0)
        assert SliderCrank(stroke, 520.0, 50.0).crank_length == pytest.approx(root, rel=4 * EPS, abs=0.0)


@pytest.mark.quick(3)
@pytest.mark.parametrize("gap", [1e-3, 1e-6, 1e-9, 1e-12, 1e-15])
@pytest.mark.parametrize(("rod", "offset"), [(200.5, 5.0), (520.0, -50.0), (100.0, 99.0), (100.0, 0.0), (1.0, 1e-9)])
def test_up_to_the_largest_stroke(rod, offset, gap):
    stroke = slider_crank.max_stroke(rod, offset) * (1.0 - gap)
    design = SliderCrank(stroke, rod, offset)
    assert design.crank_length == pytest.approx(float(exact_crank(stroke, rod, offset)), rel=8 * EPS, abs=0.0)
    assert 0.0 <= abs(design.dead_center_folded) < math.pi / 2
    assert math.copysign(1.0, design.dead_center_folded) == math.copysign(1.0, offset)


def test_largest_stroke_belongs_to_the_longest_crank():
    for rod, offset in ((200.5, 5.0), (520.0, 50.0), (100.0, 99.0)):
        longest = rod - offset
        assert float(exact_stroke(longest, rod, offset)) == pytest.approx(
            slider_crank.max_stroke(rod, offset), rel=4 * EPS, abs=0.0
        )
        assert slider_crank.dead_center_folded(longest, rod, offset) == math.pi / 2


lengths = st.tuples(st.floats(0.01, 0.99), st.floats(0.5, 500.0), st.floats(-0.95, 0.95))


@examples(100)
@given(lengths)
def test_round_trip_mirror_and_scale(drawn):
    share, rod, part = drawn
    offset = part * rod
    crank = share * (rod - abs(offset))
    stroke = SliderCrank.of_crank(crank, rod, offset).stroke
    # dr/dS goes to 0 at the largest stroke, so that the return stroke is never worse than the stroke itself
    assert SliderCrank(stroke, rod, offset).crank_length == pytest.approx(crank, rel=16 * EPS, abs=0.0)
    ratio = SliderCrank.of_crank(crank, rod, offset).quick_return_ratio
    assert SliderCrank.of_crank(crank, rod, -offset).quick_return_ratio == pytest.approx(
        1.0 / ratio, rel=8 * EPS, abs=0.0
    )
    assert (ratio - 1.0) * offset >= 0.0
    assert SliderCrank.of_crank(crank, rod, -offset).stroke == stroke
    assert SliderCrank.of_crank(1024.0 * crank, 1024.0 * rod, 1024.0 * offset).stroke == 1024.0 * stroke
    for angle in (slider_crank.dead_center_extended, slider_crank.dead_center_folded):
        assert angle(crank, rod, -offset) == -angle(crank, rod, offset)


@examples(60)
@given(lengths)
def test_dead_centers_are_the_extremes_of_the_slider(drawn):
    share, rod, part = drawn
    offset = part * rod
    crank = share * (rod - abs(offset))
    extended = slider_crank.dead_center_extended(crank, rod, offset)
    folded = slider_crank.dead_center_folded(crank, rod, offset)
    low, low_rate = slider_crank.slider(-math.pi / 2 - extended, crank, rod, offset, 1)
    high, high_rate = slider_crank.slider(math.pi / 2 - folded, crank, rod, offset, 1)
    steep = rod / (rod - crank - abs(offset))
    assert low - high == pytest.approx(SliderCrank.of_crank(crank, rod, offset).stroke, abs=16 * EPS * rod * steep)
    assert max(abs(low_rate), abs(high_rate)) <= 32 * EPS * rod * steep
    # the counter-clockwise turn from folded to stretched over the one back
    away = 2.0 * math.pi - (math.pi - folded + extended)
    assert SliderCrank.of_crank(crank, rod, offset).quick_return_ratio == pytest.approx(
        away / (2.0 * math.pi - away), rel=64 * EPS * steep, abs=0.0
    )


def exact_depth(psi, crank, rod, offset):
    return mp.sqrt(mp.mpf(rod) ** 2 - (crank * mp.cos(psi) + offset) ** 2) - crank * mp.sin(psi)


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("crank", "rod", "offset"), [(154.21159203908383, 520.0, 50.0), (50.0, 120.0, -30.0), (99.0, 200.0, 100.0)]
)
def test_position_and_derivatives_against_many_digits(crank, rod, offset):
    psi = np.linspace(-7.0, 7.0, 41)
    sweep = slider_sweep(psi, crank, rod, offset, 3)
    for i, angle in enumerate(psi.tolist()):
        scalar = slider_crank.slider(angle, crank, rod, offset, 2)
        w = math.sqrt(rod**2 - (crank * math.cos(angle) + offset) ** 2)
        for order in range(4):
            true = float(mp.diff(lambda p: exact_depth(p, crank, rod, offset), mp.mpf(angle), order))
            limit = (8.0, 32.0, 32.0, 64.0)[order] * EPS * (rod + crank) * (rod / w) ** (2 * order)
            assert order == 3 or abs(scalar[order] - true) <= limit
            assert abs(float(sweep[order][i]) - true) <= limit


def test_orders_and_shapes():
    for order in range(3):
        assert len(slider_crank.slider(0.3, 50.0, 200.0, 10.0, order)) == order + 1
        values = slider_sweep(np.zeros((3, 4)), 50.0, 200.0, 10.0, order)
        assert [v.shape for v in values] == [(3, 4)] * (order + 1)
        full = slider_crank.slider(0.3, 50.0, 200.0, 10.0, 2)
        assert slider_crank.slider(0.3, 50.0, 200.0, 10.0, order) == full[: order + 1]


@examples(60)
@given(st.floats(-3.0, 3.0), lengths)
def test_mirror_of_the_position(psi, drawn):
    share, rod, part = drawn
    offset = part * rod
    crank = share * (rod - abs(offset))
    assume(rod - crank - abs(offset) > 1e-3 * rod)
    h, v, a = slider_crank.slider(psi, crank, rod, offset, 2)
    mh, mv, ma = slider_crank.slider(math.pi - psi, crank, rod, -offset, 2)
    size = 64 * EPS * rod * 1e3
    assert (mh, -mv) == pytest.approx((h, v), abs=size)
    assert ma == pytest.approx(a, abs=1e3 * size)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: SliderCrank(399.0, 200.5, 5.0), r"set stroke below 395\.9 mm"),
        (lambda: SliderCrank(399.0, 200.5, 5.0), r"stroke: 399 mm .* with rod 200\.5 mm and offset 5 mm"),
        (lambda: SliderCrank(400.0, 200.0), "stroke: 400 mm .limit < 400 mm"),
        (lambda: SliderCrank(100.0, 200.0, -200.0), "limit < 200 mm, the rod"),
        (lambda: SliderCrank(0.0, 200.0), "stroke 0 mm: it must be positive"),
        (lambda: SliderCrank(math.nan, 200.0), "it must be positive"),
        (lambda: SliderCrank(10.0, -1.0), "rod -1 mm"),
        (lambda: SliderCrank(10.0, 20.0, math.nan), "offset: nan mm"),
        (lambda: SliderCrank.of_crank(96.0, 100.0, 5.0), "limit < 95 mm, rod - offset"),
        (lambda: SliderCrank.of_crank(95.0, 100.0, 5.0), "limit < 95 mm, .*; set the crank below 95 mm"),
        (lambda: slider_crank.dead_center_folded(96.0, 100.0, -5.0), "to turn fully"),
        (lambda: SliderCrank.of_crank(-1.0, 100.0), "crank -1 mm"),
        (lambda: slider_crank.slider(0.0, 96.0, 100.0, 5.0), r"limit > 101 mm, .* at crank direction 0 deg"),
        (lambda: slider_crank.slider(0.0, 95.0, 100.0, 5.0, 1), "does not reach"),
        (lambda: slider_sweep([-1.5, 0.0], 96.0, 100.0, 5.0), "at crank direction 0 deg"),
        (lambda: slider_sweep([-1.5, 0.0], 95.0, 100.0, 5.0, 1), "at crank direction 0 deg"),
    ],
)
def test_refusals_name_the_limit(call, message):
    with pytest.raises(NoSolution, match=message):
        call()


def test_false_root_of_the_squared_equation_is_not_taken():
    stroke, rod, offset = 399.0, 200.5, 5.0
    false = stroke / 2 * math.sqrt((4 * rod**2 - 4 * offset**2 - stroke**2) / (4 * rod**2 - stroke**2))
    assert false == pytest.approx(193.17, abs=0.005)
    assert float(exact_stroke(false, rod, offset)) < 394.0  # it is the root of the sum of the square roots


@pytest.mark.parametrize("offset", [50.0, 0.0, -80.0])
def test_dead_centers_are_named_at_the_angles_of_the_motion(offset: float) -> None:
    """There the slider of the table stands still, farthest from the crank and nearest to it: one origin for both."""
    made = factory.design("ty460_slider_crank", command="analyze", offset=offset)
    found = made.table("motion", samples=36_000)
    for name, row in (("extended", found["displacement"].argmax()), ("folded", found["displacement"].argmin())):
        place = made.quantity(f"dead_center_{name}_at").value
        assert place == pytest.approx(found["input_angle"][row], abs=0.006)  # half of the table's step
        assert made.depth(math.radians(place), 1) == pytest.approx(0.0, abs=1e-10)
    assert made.quantity("forward_angle").value == pytest.approx(
        made.quantity("dead_center_extended_at").value - made.quantity("dead_center_folded_at").value, rel=1e-14
    )


@pytest.mark.parametrize("offset", [22.0, -22.0])
def test_rod_turns_as_its_angle_to_the_slide_line_says(offset: float) -> None:
    """sin(rod_angle) = (r cos(theta) + e)/L, its 50-digit derivatives; 64 eps of the maximum, as (L/w)^3 is below 2."""
    spec = {"stroke": None, "crank": 75.0, "rod": 260.0, "offset": offset, "input_speed": 300.0}
    found = factory.design("ty460_slider_crank", command="analyze", **spec).table("motion", samples=24)
    w = 10.0 * math.pi

    def angle(theta: mp.mpf) -> mp.mpf:
        return mp.asin((75 * mp.cos(theta) + offset) / 260)

    for order, ratio, timed in ((1, "rod_speed_ratio", "rod_speed"), (2, "rod_acceleration_ratio", "rod_acceleration")):
        exact = [float(mp.diff(angle, mp.radians(row), order)) for row in found["input_angle"].tolist()]
        close = 64.0 * EPS * max(map(abs, exact))
        assert found[ratio] == pytest.approx(exact, abs=close)
        assert found[timed] == pytest.approx(np.multiply(exact, w**order), abs=close * w**order)
