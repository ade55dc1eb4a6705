"""docs/howto/measured_gears.md: module, shifts and allowances of a gear pair from what is measured on it.

Tolerance: 1e-11 of the numbers, which are differences of spans by up to a tenth of them.
"""

from __future__ import annotations

import math

import pytest
from factory import design

MODULE, ALPHA = 2.5, math.radians(20.0)
SHIFTS, TEETH_SPANNED = [0.286, 0.06], [4, 9]


def spans(shifts: list[float], teeth: list[int]) -> list[float]:
    made = design("gear_pair", profile_shift=shifts, span_teeth=teeth, allowances=None)
    return [float(each) for each in made.span_measurement]


def test_spans_over_k_and_one_more_give_the_module() -> None:
    more = spans(SHIFTS, [k + 1 for k in TEETH_SPANNED])
    for one, other in zip(spans(SHIFTS, TEETH_SPANNED), more, strict=True):
        assert (other - one) / (math.pi * math.cos(ALPHA)) == pytest.approx(MODULE, rel=1e-11)


def test_a_span_gives_the_shift() -> None:
    measured, plain = spans(SHIFTS, TEETH_SPANNED), spans([0.0, 0.0], TEETH_SPANNED)
    found = [(a - b) / (2.0 * MODULE * math.sin(ALPHA)) for a, b in zip(measured, plain, strict=True)]
    assert found == pytest.approx(SHIFTS, rel=1e-11)


def test_what_the_shifts_lack_is_an_allowance() -> None:
    """Nominal shifts with allowances have the spans of the smaller shifts."""
    nominal = [0.35, 0.15]
    lack = [2.0 * MODULE * math.tan(ALPHA) * (x - full) for x, full in zip(SHIFTS, nominal, strict=True)]
    limits = {"upper": lack, "lower": lack}
    made = design("gear_pair", profile_shift=nominal, span_teeth=TEETH_SPANNED, allowances=limits)
    for (least, most), span in zip(made.span_measurement_limits, spans(SHIFTS, TEETH_SPANNED), strict=True):
        assert (least, most) == pytest.approx((span, span), rel=1e-11)
