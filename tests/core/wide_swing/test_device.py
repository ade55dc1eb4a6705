"""Unloading devices: what can be built, sizing, refusals.

Tolerances: 4 ulp, closed formulas of about ten roundings, each written without cancellation; the length condition
solved by bracketing is known to the same.
"""

from __future__ import annotations

import json
import math
from pathlib import Path

import factory
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sweeps import examples

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.wide_swing.device import (
    DeviceGeometry,
    Pneumatic,
    Spring,
    least_pivot_ratio_pneumatic,
    least_pivot_ratio_spring,
    least_pivot_ratio_spring_material,
)
from gearlink.core.numerics.roots import bracketed_root

ROUNDING = 1e-15
CASES = {
    case["id"]: case["outputs_float"]
    for case in json.loads((Path(__file__).parents[2] / "reference" / "wide_swing.json").read_text())["cases"]
}
swings = st.floats(1e-6, math.radians(300.0))


def lengths(ratio: float, swing: float) -> tuple[float, float]:
    """L and l0 by the law of cosines, in arms."""
    return math.sqrt(1.0 + ratio**2 - 2.0 * ratio * math.cos(0.5 * swing)), ratio - 1.0


@pytest.mark.parametrize("swing", [30, 60, 90, 120, 180, 240, 300])
def test_least_pivot_ratios_of_the_reference(swing: int) -> None:
    gamma = math.radians(swing)
    assert least_pivot_ratio_pneumatic(gamma) == pytest.approx(CASES["D12"][f"pneu_{swing}"], rel=ROUNDING)
    spring = least_pivot_ratio_spring_material(gamma, 0.2, 1.5, 0.3)
    assert spring == pytest.approx(CASES["D12"][f"spring_{swing}"], rel=ROUNDING)


def test_the_dissertation_s_printed_form() -> None:
    # (3) with its three- and five-digit coefficients: 0.212, 0.460, 4.1728
    for swing in (60.0, 120.0, 240.0):
        inner = 2.0 * math.cos(math.radians(0.5 * swing)) - 4.1728
        printed = math.sqrt(0.212 * inner**2 - 1.0) - 0.460 * inner
        assert least_pivot_ratio_pneumatic(math.radians(swing)) == pytest.approx(printed, rel=1.5e-3)


@given(swing=swings, extension=st.floats(1.01, 5.0))
@examples(100)
def test_cylinder_at_the_limit_uses_its_whole_extension(swing: float, extension: float) -> None:
    geometry = DeviceGeometry(Pneumatic(least_pivot_ratio_pneumatic(swing, extension)), swing)
    # lambda - 1 carries the rounding of lambda
    slack = 4 * ROUNDING * (1.0 + 1.0 / geometry.shortest)
    assert geometry.longest / geometry.shortest == pytest.approx(extension, rel=slack)


@given(swing=swings, stretch=st.floats(0.0, 3.0), closed=st.floats(1.0, 500.0), fittings=st.floats(0.0, 100.0))
@examples(100)
def test_spring_at_the_limit_just_fits(swing: float, stretch: float, closed: float, fittings: float) -> None:
    ratio = least_pivot_ratio_spring(swing, stretch, 120.0, closed, fittings)
    geometry = DeviceGeometry(Spring(ratio, stretch), swing)
    room = 120.0 * geometry.shortest
    assert closed + fittings + stretch * 120.0 * geometry.stroke == pytest.approx(room, rel=8 * ROUNDING, abs=1e-12)


def test_spring_limit_against_bracketing() -> None:
    def spare(ratio: float) -> float:
        longest, shortest = lengths(ratio, math.pi)
        return shortest - (150.0 + 40.0) / 120.0 - 0.5 * (longest - shortest)

    assert least_pivot_ratio_spring(math.pi, 0.5, 120.0, 150.0, 40.0) == pytest.approx(
        bracketed_root(spare, 1.5, 9.0), rel=4 * ROUNDING
    )


def test_small_swings_keep_their_digits() -> None:
    # p - 1 = 2 (gamma/4)^2/(q^2 - 1) and lambda - 1 = sqrt(2 (p - 1)) to first order
    excess = least_pivot_ratio_pneumatic(1e-7) - 1.0
    assert excess == pytest.approx(1e-7 * math.sqrt(81.0 / 88.0) / 2.0, rel=1e-7)


@given(swing=swings, ratio=st.floats(1.001, 100.0), u=st.floats(0.0, 1.0))
@examples(100)
def test_stable_lengths_equal_the_law_of_cosines(swing: float, ratio: float, u: float) -> None:
    geometry = DeviceGeometry(Spring(ratio, 0.3), swing)
    sine = np.array([u])
    phi = 2.0 * math.asin(geometry.half_sine * u)
    longest, shortest = lengths(ratio, swing)
    length = lengths(ratio, 2.0 * phi)[0]
    # the law of cosines loses (1 + lambda^2)/l^2
    loss = 4 * ROUNDING * (1.0 + ratio**2) / shortest**2
    assert geometry.longest == pytest.approx(longest, rel=loss)
    assert float(geometry.length(sine)[0]) == pytest.approx(length, rel=loss)
    x, d = longest - length, longest - shortest
    energy = (1.3 * d - 0.5 * x) * x
    stable = float(geometry.mean_force(sine)[0]) * (geometry.stroke - float(geometry.extension(sine)[0]))
    assert stable == pytest.approx(energy, abs=loss * longest * (d + longest))


def test_sizing_of_the_reference() -> None:
    """D02 and D08 of a rocker of 0.5 kg m^2 with an arm of 120 mm; N is that of the law, known to 2e-15."""
    expected, turn = CASES["D20"], {"inertia": 0.5, "speed": 60.0 * 1.66}
    cylinder = {"type": "pneumatic", "pivot_ratio": 2.5, "arm": 120.0}
    spring = {"type": "spring", "pivot_ratio": 4.0, "stretch_ratio": 0.5, "arm": 120.0}
    of_cylinder = factory.design("wide_swing_twin_cam", command="swing", unloader=cylinder, **turn)
    # both strokes take the same time
    of_spring = factory.design(
        "wide_swing_twin_cam", command="swing", unloader=spring, swing=180.0, **turn, cycle_angle=120.0
    )
    assert of_cylinder.raw("force") == pytest.approx(expected["P_force_N"], rel=4 * ROUNDING)
    # N/m to N/mm
    assert of_spring.raw("spring_rate") == pytest.approx(expected["spring_c_N_per_m"] / 1000.0, rel=4 * ROUNDING)


@pytest.mark.parametrize("ratio", [1.0, 0.4, -2.0, math.nan, math.inf])
def test_pivot_ratio_not_above_one(ratio: float) -> None:
    with pytest.raises(NoSolution, match=r"pivot ratio: .*limit > 1.*increase the pivot distance or reduce the arm"):
        Pneumatic(ratio)
    with pytest.raises(NoSolution, match="pivot ratio"):
        Spring(ratio, 0.5)


def test_refusals_name_value_and_remedy() -> None:
    with pytest.raises(NoSolution, match=r"stretch ratio -0\.1: the spring is slack.*mounting stretch"):
        Spring(3.0, -0.1)
    with pytest.raises(NoSolution, match=r"extension ratio of the cylinder: 1 .*13/9"):
        least_pivot_ratio_pneumatic(2.0, 1.0)
    with pytest.raises(NoSolution, match="closed length of the spring: 0 mm"):
        least_pivot_ratio_spring(2.0, 0.5, 120.0, 0.0)
    with pytest.raises(NoSolution, match="arm: -1 mm"):
        least_pivot_ratio_spring(2.0, 0.5, -1.0, 100.0)
    with pytest.raises(NoSolution, match="end fittings: -1 mm"):
        least_pivot_ratio_spring(2.0, 0.5, 120.0, 100.0, -1.0)
    with pytest.raises(NoSolution, match=r"stretch capacity 0 .limit > 0"):
        least_pivot_ratio_spring_material(2.0, 0.5, 0.0)
