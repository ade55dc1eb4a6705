"""Indices of designs against plain loops. No tolerance: indices and values of these grids are exact."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest

from gearlink.core.studies.explore.order import Grid, Sample, TooManyDesigns, Variable


def whole(path: str, low: float, high: float, times: str = "", step: float = 1.0) -> Variable:
    return Variable(path, low=low, high=high, step=step, whole=True, times=times)


def test_multiples_of_an_earlier_variable_and_lists_between() -> None:
    variables = [
        whole("c", 3, 6),
        Variable("list", values=(1.5, "word")),
        whole("i", 1, 2, "c"),
        Variable("j", low=0.5, high=1.0, step=0.5, times="i"),
        whole("k", 0.5, 1.0, "c"),
    ]
    want = []
    for c, word in itertools.product(range(3, 7), (0, 1)):
        for i in range(c, 2 * c + 1):
            for j in np.arange(0.5 * i, i + 1e-9, 0.5):
                want += [[c, word, i, j, k] for k in range(math.ceil(c / 2), c + 1)]
    grid = Grid(variables)
    assert grid.count == len(want)
    assert grid.columns(np.arange(grid.count)).T.tolist() == want
    some = np.array([0, 17, 911, 5, grid.count - 1])
    assert grid.columns(some).T.tolist() == [want[i] for i in some]


def test_multiples_of_a_list() -> None:
    grid = Grid([Variable("c", values=(4, 3)), whole("i", 1.0, 1.5, "c")])
    assert grid.columns(np.arange(grid.count)).T.tolist() == [[0, 4], [0, 5], [0, 6], [1, 3], [1, 4]]


def test_an_empty_range_of_multiples_counts_no_design() -> None:
    grid = Grid([whole("c", 2, 3), whole("i", 1.4, 1.45, "c"), Variable("m", values=(1, 2))])
    assert grid.count == 0
    assert Grid([whole("c", 2, 5), whole("i", 1.4, 1.45, "c")]).columns(np.arange(1)).T.tolist() == [[5, 7]]


def test_too_many_are_counted_not_listed() -> None:
    with pytest.raises(TooManyDesigns) as caught:
        Grid([Variable(str(i), low=0, high=1e6, step=1) for i in range(3)])
    assert caught.value.count == pytest.approx(1e18, rel=1e-5)


def test_a_sample_is_the_same_in_any_share_and_stays_in_its_ranges() -> None:
    variables = [
        whole("c", 3, 6),
        Variable("x", low=0.1, high=10.0, log=True),
        whole("i", 1, 2, "c"),
        Variable("v", values=(1, 2, 3)),
    ]
    sample = Sample(variables, 256, seed=3)
    points = sample.columns(np.arange(256))
    parts = [sample.columns(np.arange(first, first + 64)) for first in range(0, 256, 64)]
    assert (np.concatenate(parts, axis=1) == points).all()
    c, x, i, v = points
    assert set(c) == {3, 4, 5, 6}
    assert set(v) == {0, 1, 2}
    assert ((i >= c) & (i <= 2 * c) & (i == np.floor(i))).all()
    assert ((x >= 0.1) & (x <= 10.0)).all()
    assert np.median(x) == pytest.approx(1.0, rel=0.1)  # equal shares of the logarithm


def test_values_of_a_range_are_what_a_file_would_write() -> None:
    """As texts with the decimals of first value and step are read: no 0.6000000000000001 in a design's file."""
    steps = Variable("x", low=-1.05, high=1.0, step=0.1)
    values = steps.at(np.arange(steps.count()))
    assert values.tolist() == [round(-1.05 + 0.1 * i, 2) for i in range(21)]
    below = Grid(
        [Variable("c", values=(0.1, 3)), Variable("i", low=0.7, high=2.0, step=0.1, times="c", times_decimals=1)]
    )
    rows = below.columns(np.arange(below.count)).T.tolist()
    assert rows[:2] == [[0, 0.07], [0, 0.17]]
    assert rows[2:5] == [[1, 2.1], [1, 2.2], [1, 2.3]]


def test_values_with_more_digits_than_a_float_stay() -> None:
    third, tiny = 1.0 / 3.0, Variable("x", low=1e-30, high=1e-29, step=1e-30)
    large = Variable("x", low=1e12 + third, high=2e12, step=third)
    assert tiny.at(np.arange(3)).tolist() == [1e-30, 2e-30, 1e-30 + 2 * 1e-30]
    assert large.at(np.arange(3)).tolist() == [1e12 + third + i * third for i in range(3)]
