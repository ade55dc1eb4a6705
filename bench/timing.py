"""Timing that can be compared: every method of a table in turn, round after round, and the medians of the rounds."""

from __future__ import annotations

import math
import os
import platform
import statistics
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from time import perf_counter
from typing import Any

import numpy as np

EPS = 2.0**-52
_LEAST_SECONDS = 2e-3


@dataclass(frozen=True, slots=True)
class Method:
    """One way to get `size` results; `error` is its worst one, in the unit of the family."""

    name: str
    size: int
    run: Callable[[], object]
    error: float = math.nan


@dataclass(frozen=True, slots=True)
class Row:
    """A measured method: time of one result, worst error, time over that of the family's reference."""

    method: str
    size: int
    nanoseconds: float
    error: float
    ratio: float


@dataclass(frozen=True, slots=True)
class Family:
    """The table of a family; `unit` is that of its errors, `reference` what the ratios divide by."""

    name: str
    title: str
    unit: str
    reference: str
    rows: tuple[Row, ...]
    notes: tuple[str, ...] = field(default=())

    def row(self, method: str, size: int | None = None) -> Row | None:
        """The row of a method, of the largest size where none is given."""
        found = [row for row in self.rows if row.method == method and size in (None, row.size)]
        return max(found, key=lambda row: row.size, default=None)


def mpmath(digits: int = 30) -> Any:
    """mpmath at a number of digits."""
    import mpmath

    mpmath.mp.dps = digits
    return mpmath


def measure(
    methods: Sequence[Method],
    reference: Callable[[], object],
    size: int,
    rounds: int,
    clock: Callable[[], float] = perf_counter,
) -> tuple[Row, ...]:
    """Rows of the methods, timed in turn with a reference that gives `size` results."""
    runs = [reference, *(method.run for method in methods)]
    seconds = interleaved(runs, rounds, clock)
    base = seconds[0] / size
    return tuple(
        Row(method.name, method.size, 1e9 * took / method.size, method.error, took / method.size / base)
        for method, took in zip(methods, seconds[1:], strict=True)
    )


def interleaved(
    runs: Sequence[Callable[[], object]], rounds: int, clock: Callable[[], float] = perf_counter
) -> list[float]:
    """Median seconds of one call of each, all called in turn so that a slow spell of the machine hits them alike."""
    repeats = [_repeats(run) for run in runs]
    taken: list[list[float]] = [[] for _ in runs]
    for _ in range(rounds):
        for run, count, seconds in zip(runs, repeats, taken, strict=True):
            start = clock()
            for _ in range(count):
                run()
            seconds.append((clock() - start) / count)
    return [statistics.median(seconds) for seconds in taken]


def _repeats(run: Callable[[], object]) -> int:
    """How often to call so that the clock's own steps do not count; the first call also warms up."""
    run()
    start = perf_counter()
    run()
    return max(1, math.ceil(_LEAST_SECONDS / max(perf_counter() - start, 1e-9)))


def numpy_pass(size: int) -> Callable[[], object]:
    """One pass of sine, cosine, arc tangent and square root over `size` numbers, into arrays that are there."""
    x = np.linspace(-3.0, 3.0, size)
    sine, cosine, angle, root = (np.empty(size) for _ in range(4))

    def run() -> None:
        np.sin(x, out=sine)
        np.cos(x, out=cosine)
        np.arctan2(sine, cosine, out=angle)
        np.multiply(sine, sine, out=root)
        np.sqrt(root, out=root)

    return run


def sample_of(size: int, most: int = 40) -> list[int]:
    """Indices spread over an array, for a comparison that is too slow for all of it."""
    return sorted({round(i * (size - 1) / (most - 1)) for i in range(most)}) if size > 1 else [0]


def worst(found: Iterable[float], true: Iterable[Any]) -> float:
    """Maximum error in units in the last place of the true value."""
    return max(float(abs(type(t)(float(f)) - t)) / math.ulp(float(t)) for f, t in zip(found, true, strict=True))


def machine() -> dict[str, str]:
    """What the figures hold for: processor, its vector units, versions."""
    import gearlink.core.version as own

    return {
        "processor": _cpu("model name") or platform.processor() or platform.machine(),
        "AVX-512": "yes" if "avx512f" in _cpu("flags").split() else "no",
        "cores": str(os.cpu_count()),
        "load": f"{os.getloadavg()[0]:.1f} processes" if hasattr(os, "getloadavg") else "unknown",
        "system": f"{platform.system()} {platform.release()}",
        "Python": platform.python_version(),
        "numpy": np.__version__,
        "gearlink": own.VERSION,
    }


def _cpu(key: str) -> str:
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as lines:
            return next((line.partition(":")[2].strip() for line in lines if line.startswith(key)), "")
    except OSError:
        return ""
