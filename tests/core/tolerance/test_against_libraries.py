"""Laws, copula and Sobol' indices against openturns and SALib: their numbers stand in reference/statistics.json.

`oracles/make_statistics.py` made them. Tolerances: quantiles to rounding of the width; shares of samples and indices
within the intervals of both sides.
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import factory
import numpy as np
import pytest

from gearlink.core.studies.tolerance.correlation import together
from gearlink.core.studies.tolerance.laws import Law
from gearlink.core.studies.tolerance.sampling import estimate, replications

NUMBERS = json.loads((Path(__file__).parents[2] / "reference/statistics.json").read_text(encoding="utf-8"))
FIELDS = ("form", "lower", "upper", "mean", "sigma", "mode")


def law(row: dict[str, Any]) -> Law:
    return Law(**{name: row[name] for name in FIELDS if name in row})


@pytest.mark.parametrize("row", NUMBERS["laws"], ids=lambda row: str(row["form"]))
def test_laws_are_those_of_openturns(row: dict[str, Any]) -> None:
    made = law(row)
    found = made.deviations(np.array(NUMBERS["shares"]))
    assert found == pytest.approx(row["quantiles"], abs=1e-14)
    # openturns integrates the moments of a truncated law
    assert made.moments() == pytest.approx((row["mean_of"], row["sigma_of"]), rel=1e-10)


@pytest.mark.parametrize("row", NUMBERS["copula"], ids=lambda row: str(row["rho"]))
def test_sizes_scatter_together_as_the_copula_of_openturns(row: dict[str, Any]) -> None:
    values, vectors = np.linalg.eigh(np.array([[1.0, row["rho"]], [row["rho"], 1.0]]))
    root = (vectors * np.sqrt(values)) @ vectors.T
    shares = []
    for points in replications(2, 2**15, 1):
        both = together(points, root)
        shares.append(float(np.mean((both[:, 0] <= 0.3) & (both[:, 1] <= 0.6))))
    found = estimate(np.array(shares))
    assert found.value == pytest.approx(row["share"], abs=2.0 * found.half_width)
    assert found.half_width < 1e-3


@pytest.mark.slow
def test_sobol_indices_of_a_kinked_swing_are_those_of_salib() -> None:
    """Other estimators on other points of the same drive: each within both intervals together."""
    data = {
        "kind": "three-gear-four-bar",
        "name": "candy",
        "gears": {"module": 2.0, "crank": 40, "idler": 72, "output": 40},
        "links": {"crank": 38.94178567, "frame": 153.53024891},
    }
    names = NUMBERS["swing"]["names"]
    section = {
        "sources": {key: {"plus_minus": 0.02} for key in names},
        "require": ["dwell_swing <= 10.2 deg"],
        "samples": 2**14,
        "sobol": True,
    }
    made = factory.design(data | {"tolerance": section}, command="tolerance")
    for i, found in enumerate(made._indices["dwell_swing"]):
        for one, name in ((found.first, "S1"), (found.total, "ST")):
            theirs, width = NUMBERS["swing"][name][i], NUMBERS["swing"][f"{name}_conf"][i]
            assert one.value == pytest.approx(theirs, abs=1.5 * math.hypot(width, one.half_width)), (names[i], name)


def test_salib_finds_ishigami_where_the_closed_form_has_it() -> None:
    """Against the numbers themselves: what checks the oracle."""
    found = NUMBERS["ishigami"]
    assert found["S1"] == pytest.approx([0.3139051911, 0.4424111448, 0.0], abs=1e-4)
    assert found["ST"] == pytest.approx([0.5575888552, 0.4424111448, 0.2436836641], abs=1e-4)
