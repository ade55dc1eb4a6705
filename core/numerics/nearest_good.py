"""The search for the number that a remedy names: the nearest one that repairs a finding."""

from __future__ import annotations

from collections.abc import Callable

from gearlink.core.report import safely_above, safely_below

_STEPS, _HALVINGS = 16, 12


def nearest_good(bad: float, limit: float, good: Callable[[float], bool]) -> float | None:
    """The value nearest to `bad` on the way to `limit` that is good, to four digits; None where none is found.

    Notes
        Equal steps to the first good value, then halving; rounded away from `bad` and tried again.
    Example
        >>> nearest_good(100.0, 20.0, lambda x: x * x < 3000.0), nearest_good(1.0, 2.0, lambda x: x > 5.0)
        (54.77, None)
    """
    last, found = bad, None
    for i in range(1, _STEPS + 1):
        found = bad + (limit - bad) * i / _STEPS
        if good(found):
            break
        last = found
    else:
        return None
    for _ in range(_HALVINGS):
        middle = 0.5 * (last + found)
        last, found = (last, middle) if good(middle) else (middle, found)
    rounded = float((safely_above if limit > bad else safely_below)(found, 4))
    return rounded if good(rounded) else found
