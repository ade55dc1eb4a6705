"""Designs that differ by some numbers as one whose numbers are columns: what all of them need is then sought at once.

A search whose function gives a row for each design gives an extreme whose value and place are arrays.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from pydantic import BaseModel

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import keep

Spec = Any
_FEWEST = 8
"""Designs that are better computed one by one."""


class Unlike(Exception):
    """Designs differ by more than numbers, or by numbers that no column may stand for."""


def column(values: Sequence[Any]) -> Any:
    """One value for all, or a column of them.

    Returns
        value : as it is where all are alike, else (N, 1) array
    Raises
        Unlike - for what differs and is no number
    Example
        >>> column([2.0, 2.0]), column([2.0, 3.0]).tolist()
        (2.0, [[2.0], [3.0]])
    """
    first = values[0]
    if all(value == first for value in values):
        return first
    if not all(isinstance(value, float | int) for value in values):
        raise Unlike
    return np.array(values, dtype=float)[:, None]


def together(specs: Sequence[Spec], alike: Sequence[str] = ()) -> Spec:
    """One spec with a column at each key by which some specs differ.

    Parameters
        specs : of one model
        alike : keys, wherever they stand, by which they must not differ
    Raises
        Unlike
    """
    first, changed = specs[0], {}
    for name in type(first).model_fields:
        values = [getattr(spec, name) for spec in specs]
        if all(value == values[0] for value in values):
            continue
        if name in alike:
            raise Unlike
        is_section = all(isinstance(value, BaseModel) and type(value) is type(values[0]) for value in values)
        changed[name] = together(values, alike) if is_section else column(values)
    return first.model_copy(update=changed) if changed else first


def sought(find: Callable[[Sequence[Any]], None], designs: Sequence[Any]) -> None:
    """Let designs keep what a function finds for all of them; those among which one does not exist in halves.

    Parameters
        find : raises `Unlike` for designs that it leaves to themselves, NoSolution where one of them does not exist
    """
    if len(designs) < _FEWEST:
        return
    try:
        find(designs)
    except Unlike:
        return
    except NoSolution:
        half = len(designs) // 2
        sought(find, designs[:half])
        sought(find, designs[half:])


def hand_out(found: Any, owners: Sequence[Any], *names: str) -> None:
    """Let each of the owners keep its own of the results that one found for all of them.

    Parameters
        found : of the class of the owners, with columns for their numbers
        owners : whose results are asked for later
        names : of kept results - numbers, None, or tuples and lists of these
    """
    for name in names:
        value = getattr(found, name)
        for row, owner in enumerate(owners):
            keep(owner, **{name: _of_row(value, row)})


def _of_row(value: Any, row: int) -> Any:
    if isinstance(value, np.ndarray):
        return value.reshape(-1)[row].item()
    if isinstance(value, tuple | list):
        parts = [_of_row(part, row) for part in value]
        return type(value)(*parts) if hasattr(value, "_fields") else type(value)(parts)
    return value
