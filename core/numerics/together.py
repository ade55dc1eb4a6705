"""Searches that look at functions of one argument, answered together: what the functions share is computed once."""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from typing import Any, TypeAlias, TypeVar

import numpy as np

from gearlink.core.numerics.arrays import BLOCK, Reals

Function: TypeAlias = Callable[[Reals], Reals]
Found = TypeVar("Found")
Given = TypeVar("Given")
Search: TypeAlias = Generator[Reals, Reals, Found]
"""Yields places, is sent the values of its function there, returns what it found."""


def kept_last(f: Callable[[Reals], Given]) -> Callable[[Reals], Given]:
    """The function with its last answer kept, for others that ask at the very same array.

    Example
        >>> asked = []
        >>> square = kept_last(lambda x: asked.append(1) or x * x)
        >>> places = np.arange(3.0)
        >>> square(places).tolist(), square(places).tolist(), len(asked)
        ([0.0, 1.0, 4.0], [0.0, 1.0, 4.0], 1)
    """
    last: list[Any] = [None, None]

    def again(places: Reals) -> Given:
        if places is not last[0]:
            last[:] = places, f(places)
        found: Given = last[1]
        return found

    return again


def together(functions: Sequence[Function], searches: Sequence[Search[Found]]) -> list[Found]:
    """What each search finds of its function; in every round all functions are asked at the same places.

    Parameters
        functions : functions of a float64 array, returning one like it; no value may depend on the other places
        searches : a Search for each of them
    Returns
        found : what the searches return, in their order
    Notes
        Functions that keep what they last computed at an array (a mechanism under its loads) compute it once a
        round. A search alone is answered at its own places.
    Example
        >>> def largest(grid):
        ...     values = yield grid
        ...     return float(values.max())
        >>> places = np.linspace(0.0, 1.0, 5)
        >>> together([np.square, np.negative], [largest(places), largest(places)])
        [1.0, -0.0]
    """
    found: list[Any] = [None] * len(searches)
    asked: dict[int, Reals] = {}
    for k, search in enumerate(searches):
        _advance(k, search, None, asked, found)
    while asked:
        places, parts = _joined(asked)
        of = list(asked)
        for k, values in zip(of, values_of([functions[k] for k in of], places), strict=True):
            _advance(k, searches[k], values[parts[k]], asked, found)
    return found


def values_of(functions: Sequence[Function], places: Reals) -> list[Reals]:
    """Values of functions at the same places; at very many of them block by block, for the memory's sake.

    Parameters
        functions, places : as of `together`; what the functions share is computed once a block
    Example
        >>> [float(values.sum()) for values in values_of([np.ones_like, np.zeros_like], np.arange(20_000.0))]
        [20000.0, 0.0]
    """
    if places.size <= 2 * BLOCK:
        return [f(places) for f in functions]
    found = [np.empty(places.shape) for _ in functions]
    for start in range(0, places.size, BLOCK):
        rows = slice(start, start + BLOCK)
        for values, f in zip(found, functions, strict=True):
            values[rows] = f(places[rows])
    return found


def _advance(
    k: int, search: Search[Found], values: Reals | None, asked: dict[int, Reals], found: list[Found | None]
) -> None:
    """Give a search its values; note what it asks next, or what it found."""
    try:
        asked[k] = next(search) if values is None else search.send(values)
    except StopIteration as end:
        asked.pop(k, None)
        found[k] = end.value


def _joined(asked: dict[int, Reals]) -> tuple[Reals, dict[int, slice]]:
    """All places in one array, the same ones once, and where each search has its own."""
    starts: dict[bytes, slice] = {}
    arrays, parts, size = [], {}, 0
    for k, places in asked.items():
        key = places.tobytes()
        if key not in starts:
            starts[key] = slice(size, size + places.size)
            arrays.append(places)
            size += places.size
        parts[k] = starts[key]
    return arrays[0] if len(arrays) == 1 else np.concatenate(arrays), parts
