"""Scrambled Sobol' points against scipy's: no tolerance, the bits are the same."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import qmc

from gearlink.core.numerics.quasi_random import MOST_DIMENSIONS, Sobol


def _rng(seed: int) -> np.random.Generator:
    return np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(0,)))


@pytest.mark.quick(3)
@pytest.mark.parametrize("bits", [30, 32, 53])
@pytest.mark.parametrize("dimensions", [1, 2, 13, MOST_DIMENSIONS])
def test_points_are_those_of_scipy(dimensions: int, bits: int) -> None:
    """scipy takes the child of a generator that is given to it."""
    theirs = qmc.Sobol(dimensions, scramble=True, bits=bits, rng=np.random.default_rng(7)).random_base2(9)
    assert np.array_equal(Sobol(dimensions, _rng(7), bits).points(0, 512), theirs)


@pytest.mark.parametrize(("first", "count"), [(0, 1), (1, 1), (5, 3), (1023, 700), (8192, 8192), (3 * 4096 + 17, 1000)])
def test_any_share_is_that_of_the_whole(first: int, count: int) -> None:
    sequence = qmc.Sobol(5, scramble=True, bits=30, rng=np.random.default_rng(2))
    if first:
        sequence.fast_forward(first)
    assert np.array_equal(Sobol(5, _rng(2)).points(first, count), np.atleast_2d(sequence.random(count)))


def test_a_block_has_one_point_in_every_interval() -> None:
    """The property that makes the sequence: of 2^k points one in each 2^-k of every coordinate."""
    points = Sobol(MOST_DIMENSIONS, np.random.default_rng(3), 53).points(256, 256)
    assert np.array_equal(np.sort((points * 256).astype(int), axis=0), np.arange(256)[:, None] + 0 * points)


def test_more_dimensions_are_refused() -> None:
    with pytest.raises(ValueError, match="161 dimensions"):
        Sobol(MOST_DIMENSIONS + 1, np.random.default_rng(0))
