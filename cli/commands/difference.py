"""What `gearlink diff` found, as data, and when two values count as equal."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True, slots=True)
class Change:
    """One difference; `old` or `new` is None where one side does not have it.

    Fields
        name : str - 'gears.idler', 'frame_length', 'min_transmission_angle[1]', 'GL301 gear-collision'
        relative : float - (new - old)/|old|; None for text, lists of other length and old = 0
        command : str - the command whose result it is; empty for inputs
        detail : str - 'pass -> fail' of a check, 'row 3' of a table
    """

    name: str
    old: Any
    new: Any
    unit: str = ""
    relative: float | None = None
    command: str = ""
    detail: str = ""


@dataclass(frozen=True, slots=True)
class Difference:
    """All that changed."""

    old: str
    new: str
    tolerance: float
    inputs: list[Change] = field(default_factory=list)
    quantities: list[Change] = field(default_factory=list)
    checks: list[Change] = field(default_factory=list)
    tables: list[Change] = field(default_factory=list)

    @property
    def equal(self) -> bool:
        """Nothing changed beyond the tolerance."""
        return not (self.inputs or self.quantities or self.checks or self.tables)


def same(old: Any, new: Any, tolerance: float, least: float = 1.0) -> bool:
    """Whether two values count as equal; numbers do within tolerance * max(minimum, |old|, |new|).

    Example
        >>> same(100.0, 100.0 + 1e-8, 1e-9), same(0.0, 1e-10, 1e-9), same("a", "b", 1.0), same(0.0, 1e-10, 1e-9, 0.0)
        (True, True, False, False)
    """
    if is_number(old) and is_number(new):
        if math.isinf(old) or math.isinf(new):
            return bool(old == new)
        return bool(abs(new - old) <= tolerance * max(least, abs(old), abs(new)))
    return bool(old == new) and isinstance(old, bool) == isinstance(new, bool)


def relative_change(old: Any, new: Any) -> float | None:
    """(new - old)/|old| of two numbers; None where there is none."""
    if not (is_number(old) and is_number(new)) or old == 0:
        return None
    change = (new - old) / abs(old)
    return change if math.isfinite(change) else None


def is_number(value: Any) -> bool:
    """Whether a value is a number, which yes and no are not."""
    return isinstance(value, (int, float)) and not isinstance(value, bool)
