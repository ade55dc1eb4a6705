"""Motion laws: the optimal law of a degree and the residual vibration of a law, against grids and integrations."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache, partial
from typing import Any

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from bench.timing import Family, Method, measure, mpmath, numpy_pass
from gearlink.core.parts.cams.laws import law
from gearlink.core.parts.cams.optimal import Wish, optimum
from gearlink.core.parts.cams.shaped import residuals

Array = NDArray[np.float64]
PASS = 360
WISH = Wish("jerk", acceleration=6.0)
"""Least jerk of a polynomial s'' of degree 15 whose acceleration does not pass 6."""
PERIODS = np.linspace(1.3, 4.7, 16)
"""Natural periods per phase."""
PLACES = (25, 100, 400)
FINEST = 6000
"""Places of the reference of the optimal law: with twice as many its jerk is 1e-7 larger."""


def family(quick: bool) -> Family:
    """The table of the family."""
    methods = [*_optimal(quick), *_residual(quick)]
    return Family(
        "motion-laws",
        "Motion laws: optimal law of degree 15, and residual vibration of a cycloid at 16 frequencies",
        "relative",
        f"one numpy pass of sin + cos + arctan2 + sqrt over {PASS} numbers",
        measure(methods, numpy_pass(PASS), 1, 5 if quick else 9),
        (
            "least jerk with an acceleration of 6: error by which jerk or acceleration of the law are above the least "
            f"jerk of a programme with {FINEST} places, or above 6",
            "gearlink adds places to its programme where a limit is passed, and proves the law between them",
            "residual: maximum error over the maximum residual, closed form in 30 digits",
        ),
    )


def _optimal(quick: bool) -> list[Method]:
    fresh = optimum.__wrapped__  # each time anew

    def excess(series: Array) -> float:
        x = np.linspace(-1.0, 1.0, 40_001)
        jerk = float(np.abs(chebyshev.chebval(x, chebyshev.chebder(series, scl=2))).max())
        return max(jerk / least_jerk() - 1.0, float(np.abs(chebyshev.chebval(x, series)).max()) / 6.0 - 1.0)

    found = fresh(WISH)
    methods = [Method("optimal law, proved", 1, lambda: fresh(WISH), found.value / least_jerk() - 1.0)]
    for places in PLACES[1:2] if quick else PLACES:
        run = partial(by_linprog, places)
        methods.append(Method(f"scipy linprog, {places} places", 1, run, excess(run()[0])))
    return methods


@cache
def least_jerk() -> float:
    """Of a programme with many places."""
    return by_linprog(FINEST)[1]


def by_linprog(places: int) -> tuple[Array, float]:
    """Chebyshev series of s'' and its jerk: limits at equal places of the phase alone."""
    from scipy.optimize import linprog

    unit = np.eye(WISH.degree + 1)[:, 1::2]  # antisymmetric about the middle of the phase
    x = np.linspace(-1.0, 0.0, places)
    bend, jerk = (chebyshev.chebval(x, each).T for each in (unit, chebyshev.chebder(unit, scl=2)))
    rise = chebyshev.chebint(chebyshev.chebint(unit, lbnd=-1, scl=0.5), lbnd=-1, scl=0.5)
    ends = np.array([chebyshev.chebval(-1.0, unit), chebyshev.chebval(1.0, rise)])
    one, none = np.ones((places, 1)), np.zeros((places, 1))
    rows = np.block([[jerk, -one], [-jerk, -one], [bend, none], [-bend, none]])
    most = np.concatenate([np.zeros(2 * places), np.full(2 * places, 6.0)])
    cost = np.append(np.zeros(unit.shape[1]), 1.0)
    done = linprog(cost, rows, most, np.pad(ends, ((0, 0), (0, 1))), [0.0, 1.0], (None, None), method="highs")
    series = np.zeros(WISH.degree + 1)
    series[1::2] = done.x[:-1]
    return series, float(done.x[-1])


def _residual(quick: bool) -> list[Method]:
    true = cycloid_reference()
    ways: list[tuple[str, Callable[[], Array]]] = [
        ("residual: Gauss panels", lambda: residuals(law("cycloidal"), PERIODS)),
        *((f"textbook trapezoids, {n} places", partial(by_trapezoids, n)) for n in PLACES),
        *((f"scipy solve_ivp, to {h:g}", partial(by_ivp, h)) for h in ((1e-6,) if quick else (1e-4, 1e-6, 1e-8))),
    ]
    return [Method(name, 1, run, _off(run(), true)) for name, run in ways]


def cycloid_reference() -> list[Any]:
    """R = 8 pi^2 |sin(w/2)|/(w |w^2 - 4 pi^2|), w = 2 pi lambda, in 30 digits."""
    mp = mpmath(30)
    rates = [2 * mp.pi * mp.mpf(each) for each in PERIODS.tolist()]
    return [8 * mp.pi**2 * abs(mp.sin(w / 2)) / (w * abs(w**2 - 4 * mp.pi**2)) for w in rates]


def _off(found: Array, true: list[Any]) -> float:
    return float(max(abs(float(f) - t) for f, t in zip(found, true, strict=True)) / max(true))


def by_trapezoids(places: int) -> Array:
    """The integral of s'' exp(i w (1 - x)) by equal steps."""
    x = np.linspace(0.0, 1.0, places)
    w = 2.0 * math.pi * PERIODS[:, None]
    values = 2.0 * math.pi * np.sin(2.0 * math.pi * x) * np.exp(1j * w * (1.0 - x))
    return np.asarray(np.abs(np.trapezoid(values, x, axis=1)) / w[:, 0])


def by_ivp(tolerance: float) -> Array:
    """y'' + w^2 y = -s'' integrated over the phase, its amplitude at the end; one after the other."""
    from scipy.integrate import solve_ivp

    found = []
    for w in (2.0 * math.pi * PERIODS).tolist():

        def rates(x: float, u: Array, w: float = w) -> list[float]:
            return [u[1], -w * w * u[0] - 2.0 * math.pi * math.sin(2.0 * math.pi * x)]

        done = solve_ivp(rates, (0.0, 1.0), [0.0, 0.0], rtol=tolerance, atol=1e-3 * tolerance)
        found.append(math.hypot(done.y[0, -1], done.y[1, -1] / w))
    return np.array(found)
