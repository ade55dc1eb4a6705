"""The energy parameter of an unloading law, by quadrature, by the dissertation's iteration, by an ODE solver."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from bench.timing import Family, Method, measure, mpmath
from gearlink.core.machines.wide_swing.device import Pneumatic
from gearlink.core.machines.wide_swing.law import ElasticLaw, legacy_law
from gearlink.core.numerics.elliptic import complete_integral, jacobi_sn_cn

RATIO, SWING = 2.5, math.radians(120.0)
DEVICE = Pneumatic(RATIO)


def family(quick: bool) -> Family:
    """The table of the family."""
    true = float(reference())
    methods = [
        *(_method(f"quadrature, {n} nodes", _quadrature(n), true) for n in (2, 4, 8, 16, 32)),
        *(
            _method(f"the dissertation's iteration, {n} steps", _iteration(n), true)
            for n in (20, 100, *(() if quick else (500,)))
        ),
        *(_method(f"ODE (solve_ivp), rtol 1e-{d}", _ode(d), true) for d in (4, 8, 12)),
    ]
    rows = measure(methods, _quadrature(8), 1, 5)
    return Family(
        "unloading",
        "Law of a balancing device: energy parameter N, pneumatic, pivot ratio 2.5, swing 120 deg",
        "relative",
        "the quadrature with 8 nodes",
        rows,
        ("nodes over half the stroke; the law itself doubles them until they agree to the last digits",),
    )


def _method(name: str, run: Callable[[], float], true: float) -> Method:
    return Method(name, 1, run, abs(run() / true - 1.0))


def _quadrature(nodes: int) -> Callable[[], float]:
    law = ElasticLaw(DEVICE, SWING)
    span = complete_integral(law.modulus_complement)

    def run() -> float:
        z = (np.arange(nodes) + 0.5) * (span / nodes)
        cosine, sine = jacobi_sn_cn(z, law.modulus, law.modulus_complement)
        slowness = law.slowness(sine, cosine) * law.geometry.length(sine) / law.geometry.longest
        return (2.0 / SWING * span * float(np.mean(slowness))) ** 2

    return run


def _iteration(steps: int) -> Callable[[], float]:
    return lambda: legacy_law(DEVICE, SWING, steps=steps).energy_parameter


def _ode(digits: int) -> Callable[[], float]:
    """sqrt(N) as the time of the half stroke over the pendulum angle."""
    from scipy.integrate import solve_ivp

    law = ElasticLaw(DEVICE, SWING)

    def rate(u: float, _time: Any) -> Any:
        return law.slowness(np.array([math.sin(u)]), np.array([math.cos(u)]))

    def run() -> float:
        done = solve_ivp(rate, (0.0, 0.5 * math.pi), [0.0], rtol=max(10.0**-digits, 3e-14), atol=1e-14)
        return float((2.0 / SWING * done.y[0, -1]) ** 2)

    return run


def reference() -> Any:
    """N in 30 digits."""
    mp = mpmath(30)
    ratio, half = mp.mpf(RATIO), mp.mpf(SWING) / 4
    sine, cosine = mp.sin(half), mp.cos(half)
    shortest, reach = ratio - 1, 2 * mp.sqrt(ratio)
    longest = mp.hypot(shortest, reach * sine)

    def slowness(u: Any) -> Any:
        length = mp.hypot(shortest, reach * sine * mp.sin(u))
        return mp.sqrt((longest + length) / ratio) / mp.hypot(cosine, sine * mp.cos(u))

    return (2 / mp.mpf(SWING) * mp.quad(slowness, mp.linspace(0, mp.pi / 2, 5))) ** 2
