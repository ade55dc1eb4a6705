"""The search for the number that a remedy names: the nearest one that repairs a finding."""

from __future__ import annotations

import math
from collections.abc import Callable

_STEPS = 16


def nearest_good(bad: float, limit: float, good: Callable[[float], bool], step: float) -> float | None:
    """The multiple of `step` nearest to `bad` on the way to `limit` that is good; None where none is found.

    Notes
        Sixteen wide steps to the first good value, then halving back.
    Example
        >>> nearest_good(100.0, 20.0, lambda x: x * x < 3000.0, 0.1), nearest_good(1.0, 2.0, lambda x: x > 5.0, 0.1)
        (54.7, None)
    """
    sense = math.copysign(1.0, limit - bad)

    def value(count: int) -> float:
        nearest = math.floor(sense * bad / step + 1e-9)
        return round(sense * (nearest + count) * step, 9)

    most = int(sense * (limit - bad) / step)
    last, found = 0, None
    for i in range(1, _STEPS + 1):
        count = max(last + 1, most * i // _STEPS)
        if count <= most and good(value(count)):
            found = count
            break
        last = count
    if found is None:
        return None
    while found - last > 1:
        middle = (last + found) // 2
        last, found = (last, middle) if good(value(middle)) else (middle, found)
    return value(found)
