"""Designs that differ in some numbers, as one design whose numbers are columns, so that searches run for all at once.

A search whose function returns a row for each design gives an extreme whose value and position are arrays.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from dataclasses import fields, is_dataclass
from typing import Any, TypeVar

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
    if not all(isinstance(value, float | int | complex) for value in values):
        raise Unlike
    found = np.array(values)[:, None]
    return found if found.dtype.kind == "c" else found.astype(float)


Part = TypeVar("Part")


def stacked(parts: Sequence[Part], **known: Any) -> Part:
    """One dataclass with a column at each number by which some of them differ; nothing of it is checked.

    Parameters
        parts : of one dataclass, whose fields are numbers, dataclasses, tuples of these, or alike
        known : fields that are known already
    Raises
        Unlike
    Example
        >>> from gearlink.core.parts.linkages.fourbar.position import FourBar
        >>> stacked([FourBar(18.0, 50.0, 100.0, 121.0), FourBar(19.0, 50.0, 100.0, 121.0)]).crank.tolist()
        [[18.0], [19.0]]
    """
    made = object.__new__(type(parts[0]))
    for field in fields(made):  # type: ignore[arg-type]
        name = field.name
        value = known[name] if name in known else _joined([getattr(part, name) for part in parts])
        object.__setattr__(made, name, value)
    return made


def _joined(values: Sequence[Any]) -> Any:
    first = values[0]
    if all(value is first or value == first for value in values):
        return first
    if any(type(value) is not type(first) for value in values):
        raise Unlike
    if is_dataclass(first):
        return stacked(values)
    if isinstance(first, dict):
        if any(value.keys() != first.keys() for value in values):
            raise Unlike
        return {name: _joined([value[name] for value in values]) for name in first}
    if not isinstance(first, tuple):
        return column(values)
    if any(len(value) != len(first) for value in values):
        raise Unlike
    found = [_joined(each) for each in zip(*values, strict=True)]
    return type(first)(*found) if hasattr(first, "_fields") else tuple(found)


def hand_in(many: Any, owners: Sequence[Any], *names: str) -> None:
    """Store in one combined owner, as columns, the results that each of the owners has.

    Raises
        Unlike
    """
    keep(many, **{name: _joined([getattr(owner, name) for owner in owners]) for name in names})


def in_groups(designs: Sequence[Part], key: Callable[[Part], Hashable]) -> list[list[Part]]:
    """Groups of designs with equal values of a key, in their order."""
    found: dict[Hashable, list[Part]] = {}
    for design in designs:
        found.setdefault(key(design), []).append(design)
    return list(found.values())


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
    """Store in each of the owners its own part of the results that one owner found for all.

    Parameters
        found : of the class of the owners, with columns for their numbers
        owners : whose results are asked for later
        names : of kept results - numbers, None, or tuples, lists and dicts of these
    """
    hand_on(owners, **{name: getattr(found, name) for name in names})


def hand_on(owners: Sequence[Any], **found: Any) -> None:
    """Store in each of the owners its own part of results that were found for all of them."""
    for name, value in found.items():
        for row, owner in enumerate(owners):
            keep(owner, **{name: _of_row(value, row)})


def _of_row(value: Any, row: int) -> Any:
    if isinstance(value, np.ndarray):
        return value.reshape(-1)[row].item()
    if isinstance(value, dict):
        return {name: _of_row(part, row) for name, part in value.items()}
    if isinstance(value, tuple | list):
        parts = [_of_row(part, row) for part in value]
        return type(value)(*parts) if hasattr(value, "_fields") else type(value)(parts)
    return value
