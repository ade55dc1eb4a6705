"""What `gearlink diff` found, as data."""

from __future__ import annotations

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
