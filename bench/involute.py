"""The inverse involute, by method and iteration."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bench.timing import Family, Method, Row, measure, mpmath, numpy_pass, sample_of, worst
from gearlink.core.parts.gears.mesh.pair_sweep import inverse_involute
from gearlink.core.parts.gears.tooth.involute import inverse_involute as scalar

Array = NDArray[np.float64]


def family(quick: bool) -> Family:
    """The table of the family."""
    size = 100_000
    v = 10.0 ** np.random.default_rng(2).uniform(-12.0, math.log10(2.0), size)
    few = v[: 200 if quick else 1000]
    methods = [
        _method("rational start, one Newton step", v, lambda: inverse_involute(v)),
        _method("scalar", few, lambda: [scalar(x) for x in few.tolist()]),
        *(_method(f"tan a - a, {k} Newton steps", v, _plain(v, k)) for k in (2, 4, 6, 8)),
        _method("brentq loop on tan a - a", few, lambda: brentq_loop(few)),
    ]
    rows: tuple[Row, ...] = measure(methods, numpy_pass(size), size, 5)
    return Family(
        "involute",
        "Inverse involute: pressure angle from tan(a) - a = v, v over 1e-12 .. 2",
        "ulp",
        "one numpy pass of sin + cos + arctan2 + sqrt over 1e5 numbers",
        rows,
        ("tan(a) - a loses 8 digits at 1e-4 rad: its exact root is then a wrong angle",),
    )


def _method(name: str, v: Array, run: Callable[[], Any]) -> Method:
    found = np.asarray(run())
    chosen = sample_of(v.size, 200)
    return Method(name, v.size, run, worst((found[i] for i in chosen), (reference(float(v[i])) for i in chosen)))


def _plain(v: Array, steps: int) -> Callable[[], Array]:
    def run() -> Array:
        a = np.minimum(np.cbrt(3.0 * v), 1.4)
        for _ in range(steps):
            t = np.tan(a)
            a = a - (t - a - v) / (t * t)
        return a

    return run


def brentq_loop(v: Array) -> list[float]:
    """Every value by scipy's brentq on tan(a) - a between 0 and just below a right angle."""
    from scipy.optimize import brentq

    return [brentq(lambda a, x=x: math.tan(a) - a - x, 0.0, 1.5) for x in v.tolist()]


def reference(v: float) -> Any:
    """The pressure angle in 30 digits."""
    mp = mpmath(45)
    x = mp.mpf(v)
    a = mp.mpf(scalar(v))
    for _ in range(3):
        t = mp.tan(a)
        a -= (t - a - x) / t**2
    return a
