"""What the stress tests share: how many designs, and the worst error of each quantity with the design it belongs to."""

from __future__ import annotations

import os
from typing import Any

import numpy as np
import pytest
from sweeps import ALL

LONG = np.longdouble
LONGER_NUMBERS = pytest.mark.skipif(np.finfo(LONG).nmant < 63, reason="no longer numbers on this machine")

EPS = 2.0**-52
FEW, MANY = 400 if ALL else 100, int(os.environ.get("GEARLINK_DESIGNS", "100000"))
COUNTS = [FEW, pytest.param(MANY, marks=pytest.mark.stress)]


def report(family: str, count: int, errors: dict[str, tuple[float, Any]]) -> None:
    """Worst error of each quantity with its design, on standard output (make stress shows it)."""
    print(f"\n{family}, {count} designs:")
    for name, (worst, design) in errors.items():
        print(f"  {name:28s} {worst:8.2f}  {design}")


class Worst:
    """The worst error of each quantity and the design it belongs to."""

    def __init__(self) -> None:
        self.found: dict[str, tuple[float, Any]] = {}

    def take(self, name: str, error: float, design: Any) -> None:
        if not error <= self.found.get(name, (-1.0, None))[0]:
            self.found[name] = (error, design)

    def check(self, family: str, count: int, limits: dict[str, float]) -> None:
        report(family, count, self.found)
        for name, limit in limits.items():
            assert self.found[name][0] <= limit, (family, name, self.found[name])
