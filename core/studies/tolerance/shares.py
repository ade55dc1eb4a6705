"""Replications as shares of a command's work: computed here, or by whatever the command line names."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from contextvars import ContextVar
from typing import Protocol, TypeVar

from gearlink.core.studies.tolerance.sampling import REPLICATIONS

Found = TypeVar("Found")


class Compute(Protocol):
    """Computes a module's function, or a partial of one, at some numbers, and gives what it found in their order."""

    def __call__(self, function: Callable[[int], Found], numbers: Sequence[int], work: int) -> Iterable[Found]:
        """What the function gives for each number, for each of which so many designs are computed."""
        ...


COMPUTED_BY: ContextVar[Compute | None] = ContextVar("COMPUTED_BY", default=None)
"""By what replications are computed; None: here, one after the other."""
SEEN: ContextVar[Callable[[int], None] | None] = ContextVar("SEEN", default=None)
"""Who counts the designs that are computed, if anybody does."""


def seen(count: int) -> None:
    """Say that so many more designs are computed."""
    told = SEEN.get()
    if told is not None:
        told(count)


def is_shared() -> bool:
    """Whether replications may be computed elsewhere."""
    return COMPUTED_BY.get() is not None


def of_replications(function: Callable[[int], Found], work: int = 1) -> Iterable[Found]:
    """What a function finds in every replication, in order.

    Parameters
        function : of the replication's number - of a module, or a partial of one, so that it can be sent elsewhere
        work : int - designs of a replication, as it tells `seen`; 1 where it tells nothing
    """
    by = COMPUTED_BY.get()
    if by is None:
        return (function(number) for number in range(REPLICATIONS))
    return by(function, range(REPLICATIONS), work)
