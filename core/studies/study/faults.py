"""What is wrong with a study, each fault with its place in the file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from gearlink.core.base.errors import GearlinkError

Place = tuple[str | int, ...]


@dataclass(frozen=True, slots=True)
class Fault:
    """One fault: code, what is wrong, the keys that lead to it, `("variables", "gears.crank", "to")`, what helps."""

    code: str
    message: str
    place: Place = ()
    help: str = ""


class WrongStudy(GearlinkError):
    """A study that cannot be computed: all that was found wrong with it."""

    def __init__(self, faults: Sequence[Fault]) -> None:
        super().__init__("; ".join(fault.message for fault in faults))
        self.faults = tuple(faults)


class BrokenPromise(Exception):
    """GL160: two ways to the same number differ. A fault of the program, never of the study."""
