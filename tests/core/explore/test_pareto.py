"""Fronts, boxes and knee: against published fronts, against all pairs, and in any order of the designs.

Fronts are exact (whole numbers are compared); figures of re36 agree within 1e-12, some ulp of their size.
"""

from __future__ import annotations

import itertools
import json
from pathlib import Path

import numpy as np
import pytest
from sweeps import mostly_slow

from gearlink.core.studies.explore.pareto import PARTS, best_boxes, boxes, counted, front, knee, spread

CASES = json.loads((Path(__file__).parents[2] / "reference" / "explore.json").read_text())
RNG = np.random.default_rng(7)


def by_all_pairs(values: np.ndarray) -> list[int]:
    return [i for i, v in enumerate(values) if not ((values <= v).all(axis=1) & (values < v).any(axis=1)).any()]


@pytest.mark.parametrize("case", [c for c in CASES if c["input"]["what"] == "pareto"], ids=lambda c: c["name"])
def test_fronts_of_record(case: dict) -> None:
    assert front(np.array(case["input"]["objectives"], dtype=float)).tolist() == case["expected"]


@pytest.mark.quick(3)
@pytest.mark.parametrize("objectives", [1, 2, 3, 4, 6])
@pytest.mark.parametrize(("designs", "values"), mostly_slow([(1, 3), (60, 3), (400, 8), (1500, 60)], 3))
def test_fronts_against_all_pairs(objectives: int, designs: int, values: int) -> None:
    drawn = RNG.integers(0, values, (designs, objectives)).astype(float)
    assert front(drawn).tolist() == by_all_pairs(drawn)


@pytest.mark.quick(6)
@pytest.mark.parametrize("objectives", [2, 3, 4, 5, 6])
@pytest.mark.parametrize("values", [4, 12, 1000, 0])
def test_fronts_against_moocore(objectives: int, values: int) -> None:
    """Of whole numbers with many ties, and of real ones (0)."""
    moocore = pytest.importorskip("moocore")
    for designs in (1, 7, 300, 2000):
        drawn = (
            RNG.integers(0, values, (designs, objectives)).astype(float)
            if values
            else RNG.random((designs, objectives))
        )
        wanted = np.flatnonzero(moocore.is_nondominated(drawn, keep_weakly=True))
        assert front(drawn).tolist() == wanted.tolist()


def test_empty_front() -> None:
    assert front(np.empty((0, 3))).size == boxes(np.empty((0, 3))).size == 0


def gear_trains() -> np.ndarray:
    """|6.931 - z3 z4/(z1 z2)| and the largest number of teeth, of every train of 12 to 60 teeth that may be best: for
    each pair of largest teeth the nearest product."""
    pairs = list(itertools.combinations_with_replacement(range(12, 61), 2))
    product = np.array([a * b for a, b in pairs], dtype=float)
    largest = np.array([b for _, b in pairs], dtype=float)
    rows = []
    for m in range(12, 61):
        inside = product[largest <= m]
        driven = inside[largest[largest <= m] == m] if m > 12 else inside
        errors = np.abs(6.931 - inside[:, None] / inside[None, :])
        rows += [(errors.min(), m), (np.abs(6.931 - driven[:, None] / inside[None, :]).min(), m)]
    return np.array(rows)


def test_gear_train_of_sandgren() -> None:
    """1/6.931 is met best by 16*19/(43*49), error 2.7e-12 in the square; the two-objective form has 28 points."""
    trains = gear_trains()
    best = trains[trains[:, 1] <= 60][:, 0].min()
    assert best == pytest.approx(abs(6.931 - 43 * 49 / (16 * 19)), abs=1e-12)
    unique = np.unique(trains, axis=0)
    assert len(front(unique)) == 28


def test_boxes_of_the_gear_train() -> None:
    (case,) = (c for c in CASES if c["input"]["what"] == "re36-boxes")
    trains = np.unique(gear_trains(), axis=0)
    multiples = counted(trains, np.array(case["input"]["resolution"]))
    best = front(multiples)
    kept = trains[best[boxes(multiples[best])]]
    assert np.allclose(kept[np.argsort(kept[:, 0])], case["expected"], rtol=0, atol=case["tolerance"])


def test_boxes_cover_every_design_within_a_resolution() -> None:
    """For every design a kept one that is no worse by more than the resolution in any objective; all on the front."""
    for objectives in (2, 3, 5):
        resolution = np.linspace(0.05, 0.2, objectives)
        values = RNG.random((500, objectives))
        multiples = counted(values, resolution)
        best = front(multiples)
        kept = best[boxes(multiples[best])]
        assert set(kept) <= set(by_all_pairs(multiples))
        for value in values:
            assert (values[kept] <= value + resolution * (1 + 1e-6)).all(axis=1).any()


def test_boxes_do_not_depend_on_the_order_of_the_designs() -> None:
    values = RNG.integers(0, 30, (300, 3)) * 0.1
    order = RNG.permutation(300)
    chosen = []
    for rows in (values, values[order]):
        multiples = counted(rows, np.array([0.25, 0.5, 0.7]))
        best = front(multiples)
        chosen.append(np.unique(rows[best[boxes(multiples[best])]], axis=0).tolist())
    assert chosen[0] == chosen[1]


def test_of_a_box_the_nearest_to_its_corner_stays_then_the_first() -> None:
    rows = np.array([[0.6, 0.2], [0.2, 0.6], [0.9, 0.1], [0.2, 0.6]]) * PARTS
    assert boxes(rows).tolist() == [1]  # equally near: the smaller first objective, then the lower place


def test_last_bits_do_not_make_a_front() -> None:
    values = np.array([[0.1 + 0.2, 1.0], [0.3, 1.0], [0.3, np.nextafter(1.0, 2.0)]])
    assert front(counted(values, np.array([0.1, 0.1]))).tolist() == [0, 1, 2]


def test_ranking_by_one_objective() -> None:
    values = counted(np.array([[3.0], [1.2], [1.1], [7.0], [1.1]]), np.array([1.0]))
    assert front(values).tolist() == [2, 4]
    assert best_boxes(values, 2).tolist() == [0, 2]


def test_knee_and_spread() -> None:
    rows = np.array([[0.0, 10.0], [1.0, 2.0], [2.0, 1.9], [8.0, 0.0]])
    assert knee(rows) == 1
    assert knee(rows[:2]) is None
    assert spread(rows, 3, 1).tolist() == [0, 1, 3]
    assert spread(rows, 9, 1).tolist() == [0, 1, 2, 3]


def test_an_objective_that_is_alike_but_for_rounding_moves_no_knee() -> None:
    rows = np.array([[0.0, 9.0], [4.0, 2.0], [4.5, 2.0], [9.0, 0.0], [5.0, 5.0]])
    noise = np.array([3.0, 0.0, -2.0, 1.0, 2.0])[:, None] * 2.0**-52
    for third in (0.0, 8.36, -8.36):
        level = third * (1.0 + noise)
        assert knee(np.hstack([rows, level])) == knee(rows) == 1
        assert spread(np.hstack([rows, level]), 3, 1).tolist() == spread(rows, 3, 1).tolist()
