"""Searches answered together find what each finds alone, to the last bit, and ask for what they share once a round."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.extremes import extremes_over, maximum_over, minimum_over
from gearlink.core.numerics.together import together

JOINTS = (1.0, 2.5)


def _kinked(x: Reals) -> Reals:
    return np.where(x < 1.0, np.abs(x - 0.3), np.sin(3.0 * x))


FUNCTIONS: list[Callable[[Reals], Reals]] = [np.cos, _kinked, lambda x: np.floor(x) * x, np.ones_like]


def test_extremes_found_together_are_those_found_alone() -> None:
    """Maximum and minimum of smooth, kinked, jumping and constant functions."""
    wanted = [(f, greatest) for f in FUNCTIONS for greatest in (True, False)]
    alone = [(maximum_over if greatest else minimum_over)(f, joints=JOINTS, samples=300) for f, greatest in wanted]
    assert extremes_over(wanted, joints=JOINTS, samples=300) == alone


def test_what_functions_share_is_asked_once_a_round() -> None:
    """Rounds of five searches together are those of the longest of them, and the first grid is evaluated once."""
    sizes: list[int] = []
    kept: dict[bytes, Reals] = {}

    def shared(x: Reals) -> Reals:
        if x.tobytes() not in kept:
            kept[x.tobytes()] = np.cos(x)
            sizes.append(x.size)
        return kept[x.tobytes()]

    functions = [lambda x, k=k: k * shared(x) + x * (k == 3) for k in range(1, 6)]
    extremes_over([(f, True) for f in functions], samples=300)
    longest = 0
    for f in functions:
        first = len(sizes)
        kept.clear()
        maximum_over(f, samples=300)
        longest = max(longest, len(sizes) - first)
    assert sizes[0] < 400
    kept.clear()
    sizes.clear()
    extremes_over([(f, True) for f in functions], samples=300)
    assert len(sizes) == longest


def test_no_search_finds_nothing() -> None:
    """An empty list of functions is no error."""
    assert together([], []) == []


def test_what_a_function_raises_comes_through() -> None:
    """A refusal ends all searches."""

    def refuses(_: Reals) -> Reals:
        raise ValueError("no")

    with pytest.raises(ValueError, match="no"):
        extremes_over([(np.cos, True), (refuses, True)])
