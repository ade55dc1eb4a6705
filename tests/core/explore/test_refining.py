"""Local refinement of a sample: it reaches the best of a range, and of a weighed front what a fine grid finds.

Tolerances: the last step is 1/4096 of a range, so the best of a smooth range is missed by at most that share.
"""

from __future__ import annotations

import json
from typing import Any

import factory
import numpy as np
import pytest

from gearlink.core.studies.explore.exploration import Exploration
from gearlink.core.studies.explore.front import _Search, _stepped
from gearlink.core.studies.explore.order import Variable
from gearlink.core.studies.study.spec import StudySpec

FEED = {
    "kind": "three-gear-four-bar",
    "gears": {"module": 2, "crank": 40, "idler": 72, "output": 40},
    "links": {"crank": 35, "frame": 150},
}
FRAMES = {"links.frame": {"from": 130, "to": 180}}


def study(budget: int = 8, **keys: Any) -> Exploration:
    data = {"kind": "study", "design": FEED, "sampling": {"method": "sobol", "budget": budget}, **keys}
    data.setdefault("variables", FRAMES)
    return Exploration(StudySpec.model_validate_json(json.dumps({"checks": {"must_pass": "none"}, **data})))


def best(found: Exploration) -> float:
    (values, *_) = found.found.extra.values
    return float(values[0])


@pytest.mark.quick(1)
@pytest.mark.parametrize(("requirement", "end"), [("minimize", 130.0), ("maximize", 180.0)])
def test_an_end_of_the_range_is_reached_and_never_left(requirement: str, end: float) -> None:
    found = study(**{requirement: {"frame_length": 0.001}})
    assert abs(best(found) - end) <= 50.0 / 4096.0
    assert 130.0 <= best(found) <= 180.0


@pytest.mark.slow
def test_the_best_within_a_range_is_that_of_a_fine_grid() -> None:
    """A maximum value inside: the transmission angle is best where neither dead centre is nearer than the other."""
    found = study(maximize={"min_transmission_angle": 1e-6})
    grid = study(
        variables={"links.frame": {"from": 130, "to": 180, "step": 0.01}},
        sampling={"method": "grid"},
        maximize={"min_transmission_angle": 1e-6},
    )
    refined, fine = (each.found.changes(each.found.rows[0].index)[0][1] for each in (found, grid))
    assert 131.0 < best(found) < 179.0
    assert abs(refined - fine) < 0.01 + 50.0 / 4096.0


@pytest.mark.parametrize("requirement", ["minimize", "maximize"])
def test_no_search_ever_moves_to_a_worse_design(requirement: str) -> None:
    found = study(**{requirement: {"min_transmission_angle": 1e-6}}, refine={"steps": 0})
    search = _Search(found.problem, found.found.kept_rows)
    before = search.at.copy()
    moved = search.try_variable(0)
    assert moved.any()
    for (start,), (end,), better in zip(before, search.at, moved, strict=True):
        gain = angle(end) - angle(start)
        assert (gain > 0.0 if requirement == "maximize" else gain < 0.0) if better else gain == 0.0


def angle(frame: float) -> float:
    made = factory.design(FEED, links__frame=frame).quantity("min_transmission_angle")
    assert made is not None
    return float(made.value)


@pytest.mark.slow
def test_conditions_hold_for_what_is_found() -> None:
    found = study(minimize={"frame_length": 0.001}, where=["frame_length >= 151.3 mm"])
    assert 151.3 <= best(found) <= 151.3 + 50.0 / 4096.0


def test_no_steps_no_refinement() -> None:
    assert not len(study(minimize={"frame_length": 0.001}, refine={"steps": 0}).found.extra.rows)


def test_steps_are_shares_of_a_range_or_of_its_ratio() -> None:
    value, share = np.array([10.0, 20.0]), np.array([0.25, -0.5])
    plain = _stepped(Variable("x", low=10.0, high=160.0), value, share, 10.0, 160.0)
    assert plain.tolist() == [47.5, -55.0]
    ratio = _stepped(Variable("x", low=10.0, high=160.0, log=True), value, share, 10.0, 160.0)
    assert ratio == pytest.approx([20.0, 5.0], rel=1e-15)
