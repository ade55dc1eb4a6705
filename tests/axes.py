"""Array forms against the design classes: studies over random designs, and the comparison of both."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest

from gearlink.core.studies.explore.chunks import evaluated, one_by_one
from gearlink.core.studies.explore.preparing import problem
from gearlink.core.studies.explore.problem import Problem
from gearlink.core.studies.study.spec import StudySpec

SOAK = pytest.param(16384, marks=pytest.mark.stress)
"""So many designs of a study are compared by `make stress` alone: the class takes a millisecond or two of each."""


def sampled(
    base: dict[str, Any], command: str, variables: dict[str, Any], quantities: list[str], count: int, seed: int = 5
) -> Problem:
    """A sampled study of some designs, which asks for some quantities and all checks, and has an array form."""
    data = {
        "kind": "study",
        "design": base,
        "command": command,
        "variables": variables,
        "minimize": {quantities[0]: 1},
        "where": [f"{quantity} > -1e9" for quantity in quantities],
        "checks": {"must_pass": "all"},
        "sampling": {"method": "sobol", "budget": count, "seed": seed},
    }
    made = problem(StudySpec.model_validate_json(json.dumps(data)))
    assert made.axis is not None
    return made


def by_path(made: Problem, columns: Any) -> dict[str, Any]:
    """Columns of a study's order as its array form takes them."""
    found = {}
    for variable, row in zip(made.variables, columns, strict=True):
        values = np.array(variable.values, dtype=float)[row.astype(int)] if variable.values else row
        found |= dict.fromkeys((variable.path, *variable.also), values)
    return found


def _counted(found: Any, code: str, what: str, count: int) -> Any:
    return sum((getattr(f, what).astype(int) for f in found.findings if f.code == code), np.zeros(count, dtype=int))


def _reasons(found: Any) -> list[str]:
    return [found.reasons[i - 1] if i else "" for i in found.refused]


SCALES = {"speed_ratio_min": 1.0, "min_transmission_angle": 1.0, "center_distance_modification": 1.0}
"""Sizes below which a value has not so many digits; all other quantities are compared relatively, however small.

The minimum speed of an output that stands still is nothing but the rounding of the speeds whose difference it is. Of a
transmission angle [deg] near a dead point, tan^2(mu/2) is a difference of link lengths: their last digit costs eps/mu^2
of it, 3e-9 at 0.015 deg. The modification of a centre distance, in modules, is what is left of two distances of tens.
"""


def agree(made: Problem, *, values: float = 1e-9, median: float = 1e-12, unsure: float = 0.02) -> None:
    """Refusals and statuses of the array form are the class's; values agree; few designs are left to the class."""
    count = made.order.count
    columns = made.order.columns(np.arange(count))
    many, single = made.axis.evaluate(by_path(made, columns)), one_by_one(made, columns)
    sure = ~many.unsure
    assert _reasons(evaluated(made, columns)) == _reasons(single)
    assert [r for r, known in zip(_reasons(many), sure, strict=True) if known] == [
        r for r, known in zip(_reasons(single), sure, strict=True) if known
    ]
    assert many.unsure.mean() < unsure
    for code in made.must_pass:
        for what in ("fails", "warns"):
            a, b = (_counted(found, code, what, count) for found in (many, single))
            assert (a[sure] == b[sure]).all(), (code, what, columns[:, np.flatnonzero(sure & (a != b))[:1]])
    for quantity in made.names:
        a, b = many.quantities[quantity].astype(float), single.quantities[quantity].astype(float)
        assert (np.isnan(a) == np.isnan(b))[sure].all(), quantity
        exists = np.isfinite(b) & sure
        size = np.maximum(np.abs(b[exists]), SCALES.get(quantity, np.finfo(float).tiny))
        away = np.abs(a - b)[exists] / size
        assert away.max(initial=0.0) < values, (quantity, columns[:, np.flatnonzero(exists)[away.argmax()]])
        assert not away.size or np.median(away) < median, quantity


def bits_stand_alone(made: Problem) -> None:
    """No bit of a design depends on which designs are computed beside it."""
    columns = made.order.columns(np.arange(made.order.count))
    whole = made.axis.evaluate(by_path(made, columns))
    for share in (slice(0, 7), slice(300, 301), slice(11, 788)):
        part = made.axis.evaluate(by_path(made, columns[:, share]))
        for quantity in made.names:
            same = np.array_equal(part.quantities[quantity], whole.quantities[quantity][share], equal_nan=True)
            assert same, quantity
