"""Slider-cranks over arrays against their class: refusals and statuses equal, values within 1e-9 of their size.

The formulas are shared; extremes of the motion are roots of the same derivative in the same brackets.
"""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest
from axes import SOAK, agree, bits_stand_alone, by_path, sampled
from factory import design
from sweeps import spread

from gearlink.core.machines.slider_crank.axis import axis
from gearlink.core.parts.linkages.slider_crank import slider_sweep
from gearlink.core.studies.explore.preparing import problem
from gearlink.core.studies.study.spec import StudySpec

BASE: dict[str, Any] = {"kind": "slider-crank", "stroke": 300, "rod": 500, "offset": 40}
SIZES = [
    *("crank_length", "quick_return_ratio", "dead_center_extended", "dead_center_folded", "max_stroke"),
    *("forward_angle", "return_angle", "min_transmission_angle"),
]
MOTION = ["velocity_max", "velocity_min", "acceleration_max", "acceleration_min"]
PLACES = [f"{name}_at" for name in MOTION]
TIMES = [
    *("turn_time", "forward_time", "return_time", "input_speed", "slider_velocity_max", "slider_velocity_min"),
    *("slider_acceleration_max", "slider_acceleration_min"),
]
LENGTHS = {"rod": {"from": 100, "to": 600}, "offset": {"from": -300, "to": 300}}
STUDIES: dict[str, tuple[dict[str, Any], dict[str, Any], list[str]]] = {
    "stroke": (BASE, {**LENGTHS, "stroke": {"from": 5, "to": 700}}, [*SIZES, *MOTION, *PLACES]),
    "crank": (
        {"kind": "slider-crank", "crank": 100, "rod": 500},
        {**LENGTHS, "crank": {"from": 1, "to": 400}, "limits.transmission_angle": {"from": 20, "to": 70}},
        ["stroke", *SIZES, *MOTION, *PLACES],
    ),
    "times": (
        {**BASE, "input_speed": 100},
        {"stroke": {"from": 5, "to": 700}, "input_speed": {"from": 1, "to": 3000}},
        [*SIZES, *MOTION, *TIMES],
    ),
    "centric": ({**BASE, "offset": 0}, {"rod": {"from": 100, "to": 900}}, [*SIZES, *MOTION]),
}


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", STUDIES)
@pytest.mark.parametrize("count", [64, pytest.param(1024, marks=pytest.mark.slow), SOAK])
def test_refusals_statuses_and_values_are_those_of_the_class(name: str, count: int) -> None:
    base, variables, quantities = STUDIES[name]
    agree(sampled(base, "analyze", variables, quantities, count))


@pytest.mark.parametrize(
    "count", [512, pytest.param(2048, marks=pytest.mark.slow), pytest.param(131072, marks=pytest.mark.stress)]
)
def test_sizes_of_many(count: int) -> None:
    agree(sampled(BASE, "analyze", {**LENGTHS, "stroke": {"from": 5, "to": 1200}}, SIZES, count))


def test_no_bit_depends_on_the_neighbours() -> None:
    bits_stand_alone(sampled(*_of("stroke"), 1024))


def _of(name: str) -> tuple[dict[str, Any], str, dict[str, Any], list[str]]:
    base, variables, quantities = STUDIES[name]
    return base, "analyze", variables, quantities


def test_an_extreme_at_two_places_is_left_to_the_class() -> None:
    data = {
        "kind": "study",
        "design": {**BASE, "offset": 0},
        "variables": {"rod": {"from": 320, "to": 330, "step": 1}},
        "minimize": {"acceleration_max_at": 1},
    }
    made = problem(StudySpec.model_validate_json(json.dumps(data)))
    assert made.axis is not None

    assert made.axis.evaluate(by_path(made, made.order.columns(np.arange(11)))).unsure.all()


def test_acceleration_that_peaks_on_both_sides_of_the_dead_centre() -> None:
    """Class and array form against the maximum of a fine grid, h = 2e-6 rad, off by h^2/8 of the bend: 1e-12."""
    rods = [500.0, 568.46282557, 568.67, 590.0, 599.9]
    made = axis(design({**BASE, "offset": 0}, command="analyze").spec, "analyze", ["rod"], ["acceleration_max"], [])
    assert made is not None
    many = made.evaluate({"rod": np.array(rods)})
    assert not many.unsure.any()
    phi = np.linspace(0.5 * np.pi - 0.6, 0.5 * np.pi + 0.6, 600_001)
    for rod, value in spread(zip(rods, many.quantities["acceleration_max"], strict=True), 2):
        greatest = slider_sweep(phi, 150.0, rod, 0.0, 2)[2].max()
        alone = design({**BASE, "rod": rod, "offset": 0}, command="analyze").quantity("acceleration_max")
        assert alone is not None
        assert (value, alone.value) == pytest.approx((greatest, greatest), rel=1e-12)
