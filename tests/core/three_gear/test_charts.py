"""Design charts against the reference tables and the scalar closed forms.

Tolerances: the tables hold 16 digits, so 1e-12 relative leaves room for some hundred ulp; the scalar forms differ from
the arrays by the last bits of tan, cos and expm1 alone, 64 ulp.
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sweeps import examples

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.three_gear import charts, symmetric

_CASES: dict[str, Any] = {
    case["id"]: case
    for case in json.loads((Path(__file__).parents[2] / "reference" / "gear_linkage.json").read_text())["cases"]
}
_PUBLISHED = 1e-12
_SCALAR = 64.0 * 2.0**-52

ratios = st.floats(-50.0, -0.01)
angles = st.floats(0.0, math.radians(179.0))


def _grid(case: str, parameter: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    found = _CASES[case]
    rows = np.array(found["inputs"][parameter], dtype=float)[:, None]
    return np.array(found["inputs"]["i3"], dtype=float), rows, np.array(found["outputs"]["table"])


def test_thesis_figure_4_4() -> None:
    case = _CASES["fig4_4"]
    assert charts.speed_swing_share(case["inputs"]["d"]) == pytest.approx(case["outputs"]["y"], rel=_PUBLISHED, abs=0.0)


def test_thesis_figure_4_5() -> None:
    i3, phi12, table = _grid("fig4_5", "phi12_deg")
    found = np.degrees(charts.back_step_at_crank_angle(i3, np.radians(phi12)))
    np.testing.assert_allclose(found, table, rtol=_PUBLISHED)


def test_thesis_4_18() -> None:
    i3, phi12, table = _grid("chart_d_i3_phi12", "phi12_deg")
    found = charts.frame_ratio_at_crank_angle(i3, np.radians(phi12))
    np.testing.assert_allclose(found, table, rtol=_PUBLISHED)


def test_thesis_figure_4_6() -> None:
    i3, delta, table = _grid("fig4_6", "delta")
    np.testing.assert_allclose(charts.frame_ratio_at_nonuniformity(i3, delta), table, rtol=_PUBLISHED)


def test_nonuniformity_2_is_the_momentary_dwell() -> None:
    i3 = np.linspace(-8.0, -0.1, 40)
    momentary = charts.frame_ratio_at_crank_angle(i3, 0.0)
    np.testing.assert_allclose(charts.frame_ratio_at_nonuniformity(i3, 2.0), momentary, rtol=_SCALAR)


@given(ratios, angles)
@examples(200)
def test_arrays_agree_with_the_scalar_forms(i3: float, phi12: float) -> None:
    d = symmetric.frame_ratio_for_back_step(i3, phi12)
    assert float(charts.frame_ratio_at_crank_angle(i3, phi12)) == pytest.approx(d, rel=_SCALAR, abs=0.0)
    step = symmetric.back_step_angle(i3, phi12)
    # The addition theorem of larger angles subtracts two arc tangents: their size is what the ulp counts of.
    room = _SCALAR * (step + (phi12 if math.tan(0.5 * phi12) >= 0.25 else 0.0))
    assert float(charts.back_step_at_crank_angle(i3, phi12)) == pytest.approx(step, rel=0.0, abs=room)


@given(ratios, st.floats(0.01, 0.99))
@examples(100)
def test_nonuniformity_comes_back_from_its_frame_ratio(i3: float, share: float) -> None:
    delta = 2.0 * share * (1.0 - i3)
    d = float(charts.frame_ratio_at_nonuniformity(i3, delta))
    high, low = symmetric.speed_ratio_limits(i3, d)
    # W_min = 1 - delta/2: what is subtracted from 1 carries its rounding into the difference of the two.
    assert high - low == pytest.approx(delta, rel=_SCALAR, abs=_SCALAR * (1.0 + abs(low)))


def test_back_step_keeps_its_digits_next_to_the_momentary_dwell() -> None:
    # 2 (n - 1)(n + 1)/(3 n^2) h^3 is the first term; the next is smaller by h^2.
    h, n = 1e-6, 3.0
    step = float(charts.back_step_at_crank_angle(1.0 - n, 2.0 * h))
    assert step == pytest.approx(2.0 * (n * n - 1.0) / (3.0 * n * n) * h**3, rel=1e-11, abs=0.0)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: charts.frame_ratio_at_crank_angle([-1.0, 0.5], 0.1), "i3: 0.5"),
        (lambda: charts.back_step_at_crank_angle(-1.0, [0.1, math.pi]), "below 180 deg"),
        (lambda: charts.back_step_at_crank_angle(-1.0, math.nan), "nan deg"),
        (lambda: charts.speed_swing_share([2.0, 0.5]), "frame over crank: 0.5"),
        (lambda: charts.frame_ratio_at_nonuniformity([-0.4, -0.5], 3.2), r"2 \(1 - i3\) = 2.8;"),
        (lambda: charts.frame_ratio_at_nonuniformity(-1.0, 0.0), "above 0"),
    ],
)
def test_refusals_name_value_and_limit(call: Any, words: str) -> None:
    with pytest.raises(NoSolution, match=words):
        call()


def test_a_ratio_that_does_not_reach_the_nonuniformity_has_no_value():
    """At i3 = -0.5 it ends at 2 (1 - i3) = 3."""
    reached, blank = charts.frame_ratio_at_nonuniformity([-1.0, -0.5], 3.2)
    assert reached == charts.frame_ratio_at_nonuniformity(-1.0, 3.2)
    assert math.isnan(blank)
