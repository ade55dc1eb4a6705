"""Limits, tooth tolerances and laws; their printed values are cases of `gearlink verify`."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.gears.measures.iso_1328 import cumulative_pitch
from gearlink.core.studies.tolerance.iso_286 import fit_clearances, limit_deviations, standard_tolerance
from gearlink.core.studies.tolerance.laws import Law, normal_between

CASES = json.loads((Path(__file__).parents[2] / "reference/tolerance.json").read_text(encoding="utf-8"))


def _cases(what: str) -> list[dict[str, Any]]:
    return [case for case in CASES if case["input"]["what"] == what]


@pytest.mark.parametrize(("size", "grade", "half"), [(25.0, 7, 10.5), (40.0, 6, 8.0), (60.0, 9, 37.0), (8.0, 5, 3.0)])
def test_js_lies_evenly_about_the_size(size: float, grade: int, half: float) -> None:
    """Printed in ISO 286-2, in um."""
    for letters in ("js", "JS"):
        assert limit_deviations(size, f"{letters}{grade}") == pytest.approx((-half / 1e3, half / 1e3), rel=1e-12)


@pytest.mark.parametrize("size", [0.5, 3.0, 3.001, 24.0, 50.0, 120.0, 260.0, 500.0])
@pytest.mark.parametrize("letter", "defgh")
def test_a_hole_is_the_shaft_turned_about(size: float, letter: str) -> None:
    lower, upper = limit_deviations(size, f"{letter}8")
    assert limit_deviations(size, f"{letter.upper()}8") == pytest.approx((-upper, -lower), rel=1e-12)
    assert upper - lower == pytest.approx(standard_tolerance(size, 8), rel=1e-12)


@pytest.mark.parametrize(("size", "letter"), [(40.0, "n"), (40.0, "p"), (100.0, "k"), (10.0, "s")])
def test_equal_fits_of_hole_basis_and_shaft_basis(size: float, letter: str) -> None:
    """ISO 286-1: H7/p6 and P7/h6 have the same clearances; that is what the step of the grades is for."""
    assert fit_clearances(size, f"H7/{letter}6") == pytest.approx(
        fit_clearances(size, f"{letter.upper()}7/h6"), rel=1e-12
    )


@pytest.mark.parametrize(
    ("size", "name"),
    [(0.0, "H7"), (500.1, "H7"), (40.0, "j4"), (40.0, "J9"), (40.0, "K9"), (40.0, "q6"), (40.0, "H19"), (40.0, "")],
)
def test_what_the_standard_does_not_have_is_refused(size: float, name: str) -> None:
    with pytest.raises(NoSolution):
        limit_deviations(size, name)


@pytest.mark.parametrize(
    ("grade", "module", "diameter", "width"),
    [(0, 3, 120, 30), (12, 3, 120, 30), (6, 0.4, 120, 30), (6, 3, 4, 30), (6, 3, 120, 2)],
)
def test_the_pitch_tolerance_is_not_extrapolated(grade: int, module: float, diameter: float, width: float) -> None:
    with pytest.raises(NoSolution):
        cumulative_pitch(grade, module, diameter, width)


LAWS = [
    normal_between(-0.02, 0.03, 1.33, 1.0),
    Law("uniform", -0.01, 0.03),
    Law("triangular", -0.02, 0.05, mode=0.015),
    Law("triangular", 0.0, 0.01, mode=0.01),
    Law("truncated", -0.01, 0.02, 0.008, 0.01),
    Law("fixed", 0.004, 0.004, mean=0.004),
]


@pytest.mark.quick(1)
@pytest.mark.parametrize("law", LAWS, ids=lambda law: str(law.form))
def test_moments_are_those_of_the_quantiles(law: Law) -> None:
    """Midpoint rule in the share: 2e6 points leave the tails' 1e-6 of the width."""
    values = law.deviations((np.arange(2_000_000) + 0.5) / 2_000_000)
    mean, sigma = law.moments()
    width = max(law.upper - law.lower, 1e-9)
    assert float(values.mean()) == pytest.approx(mean, abs=2e-6 * width)
    assert float(values.std()) == pytest.approx(sigma, abs=1e-5 * width)


def test_the_triangular_case() -> None:
    (case,) = _cases("law-moments")
    given = case["input"]
    law = Law("triangular", given["lower"], given["upper"], mode=0.5 * (given["lower"] + given["upper"]))
    mean, sigma = law.moments()
    assert [given["nominal"] + mean, sigma] == pytest.approx(case["expected"], abs=case["tolerance"])
