"""Position, velocity and acceleration of a four-bar, by closed form, textbook form and Newton."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bench.timing import EPS, Family, Method, Row, measure, mpmath, numpy_pass, sample_of
from gearlink.core.parts.linkages.fourbar import position as fourbar
from gearlink.core.parts.linkages.fourbar import sweep as fourbar_sweep
from gearlink.core.parts.linkages.fourbar.position import FourBar

Array = NDArray[np.float64]
LINKAGE = FourBar(18.0, 50.0, 100.0, 121.4)
QUICK = (1, 360, 3600, 100_000)
FULL = (*QUICK, 1_000_000)


def positions(size: int) -> Array:
    """Crank angles all over two revolutions."""
    return np.random.default_rng(1).uniform(-2.0 * math.pi, 2.0 * math.pi, size)


def family(quick: bool) -> Family:
    """The table of the family."""
    rows: list[Row] = []
    for size in QUICK if quick else FULL:
        rounds = 5 if size >= 100_000 else 9
        rows += measure(_methods(size), numpy_pass(size), size, rounds)
    return Family(
        "four-bar",
        "Four-bar: position, velocity and acceleration of coupler and rocker",
        "eps",
        "one numpy pass of sin + cos + arctan2 + sqrt over as many numbers",
        tuple(rows),
        (
            "error: worst of rocker direction and its two derivatives, in eps = 2^-52, at 40 positions",
            "the linkage 18, 50, 100, 121.4 stays far from its dead centres: the condition number is 1.5",
        ),
    )


def _methods(size: int) -> list[Method]:
    phi = positions(size)
    methods = [
        Method("closed form, angles", size, lambda: fourbar_sweep.solve(LINKAGE, phi, 2)),
        Method("textbook acos", size, lambda: textbook(LINKAGE, phi)),
    ]
    if size <= 3600:
        methods.append(
            Method("closed form, scalar", size, lambda: [fourbar.solve(LINKAGE, x, 2) for x in phi.tolist()])
        )
        for digits in (4, 8, 12):
            tolerance = 10.0**-digits
            name = f"Newton with predictor to 1e-{digits}"
            methods.append(Method(name, size, _bound(march, np.sort(phi), tolerance)))
    if size <= 100_000:
        methods.append(
            Method("Newton sweep", size, lambda: _with_rates(phi, fourbar_sweep.solve_by_newton(LINKAGE, phi)))
        )
        methods += _scipy(phi)
    return [Method(m.name, m.size, m.run, error_of(m.run, m.name, phi)) for m in methods]


def _bound(function: Callable[..., object], *arguments: Any) -> Callable[[], Any]:
    return lambda: function(*arguments)


def textbook(linkage: FourBar, phi: Array) -> tuple[Array, Array, Array]:
    """Rocker angle by the law of cosines with acos, and its derivatives by Cramer's rule from all four angles."""
    a, b, c, d = linkage.crank, linkage.coupler, linkage.rocker, linkage.frame
    x, y = d - a * np.cos(phi), -a * np.sin(phi)
    n = np.sqrt(x * x + y * y)
    nu = np.arctan2(y, x)
    at_d = np.arccos((n * n + c * c - b * b) / (2.0 * n * c))
    rocker = nu + math.pi - at_d
    coupler = np.arctan2(y + c * np.sin(rocker), x + c * np.cos(rocker))
    return _by_cramer(linkage, phi, coupler, rocker)


def _by_cramer(linkage: FourBar, phi: Array, coupler: Array, rocker: Array) -> tuple[Array, Array, Array]:
    a, b, c = linkage.crank, linkage.coupler, linkage.rocker
    across = np.sin(rocker - coupler)
    w_b, w_c = a * np.sin(phi - rocker) / (b * across), a * np.sin(phi - coupler) / (c * across)
    pull = a * np.cos(phi - coupler) + b * w_b * w_b - c * w_c * w_c * np.cos(rocker - coupler)
    return rocker, w_c, pull / (c * across)


def march(phi: Array, tolerance: float) -> tuple[Array, Array, Array]:
    """Newton from position to position, predicted by velocity and acceleration, until a step is below `tolerance`."""
    a, b, c, d = LINKAGE.crank, LINKAGE.coupler, LINKAGE.rocker, LINKAGE.frame
    first = fourbar.solve(LINKAGE, float(phi[0]), 2)
    at, p, q = float(phi[0]), first.coupler_angle, first.rocker_angle
    rates = (first.coupler_velocity, first.rocker_velocity, first.coupler_acceleration, first.rocker_acceleration)
    rows: list[tuple[float, float, float]] = []
    for x in phi.tolist():
        h, at = x - at, x
        p, q = p + h * (rates[0] + 0.5 * h * rates[2]), q + h * (rates[1] + 0.5 * h * rates[3])
        for _ in range(20):
            cos_p, sin_p, cos_q, sin_q = math.cos(p), math.sin(p), math.cos(q), math.sin(q)
            r_x = a * math.cos(x) + b * cos_p - d - c * cos_q
            r_y = a * math.sin(x) + b * sin_p - c * sin_q
            sine = sin_p * cos_q - cos_p * sin_q
            d_p, d_q = (r_x * cos_q + r_y * sin_q) / (b * sine), (r_x * cos_p + r_y * sin_p) / (c * sine)
            p, q = p + d_p, q + d_q
            if abs(d_p) + abs(d_q) < tolerance:
                break
        across = math.sin(q - p)
        w_p, w_q = a * math.sin(x - q) / (b * across), a * math.sin(x - p) / (c * across)
        e_q = (a * math.cos(x - p) + b * w_p**2 - c * w_q**2 * math.cos(q - p)) / (c * across)
        e_p = (a * math.cos(x - q) + b * w_p**2 * math.cos(q - p) - c * w_q**2) / (b * across)
        rates = (w_p, w_q, e_p, e_q)
        rows.append((q, w_q, e_q))
    rocker, velocity, acceleration = np.array(rows).T
    return rocker, velocity, acceleration


def _with_rates(phi: Array, found: Any) -> tuple[Array, Array, Array]:
    return _by_cramer(LINKAGE, phi, found.coupler_angle, found.rocker_angle)


def _scipy(phi: Array) -> list[Method]:
    """scipy's vector Newton and its bracketed vector root, on the rocker angle of the loop's length condition."""
    from scipy.optimize import newton

    a, b, c, d = LINKAGE.crank, LINKAGE.coupler, LINKAGE.rocker, LINKAGE.frame
    k = (a * a + c * c + d * d - b * b) / (2.0 * a * c)

    def loop(q: Array, x: Array) -> Array:
        value: Array = k + d / a * np.cos(q) - d / c * np.cos(x) - np.cos(x - q)
        return value

    def slope(q: Array, x: Array) -> Array:
        value: Array = -d / a * np.sin(q) - np.sin(x - q)
        return value

    start = np.full(phi.shape, 2.6)

    def complete(rocker: Array) -> tuple[Array, Array, Array]:
        coupler = np.arctan2(c * np.sin(rocker) - a * np.sin(phi), d + c * np.cos(rocker) - a * np.cos(phi))
        return _by_cramer(LINKAGE, phi, coupler, rocker)

    methods = [Method("scipy newton", phi.size, lambda: complete(newton(loop, start, slope, args=(phi,))))]
    try:
        from scipy.optimize.elementwise import find_root
    except ImportError:  # scipy before 1.15
        return methods
    low, high = np.full(phi.shape, math.pi / 2), np.full(phi.shape, math.pi)

    def bracketed() -> tuple[Array, Array, Array]:
        return complete(find_root(loop, (low, high), args=(phi,)).x)

    return [*methods, Method("scipy find_root", phi.size, bracketed)]


def reference(phi: float) -> tuple[Any, Any, Any, Any]:
    """Unit vector of the rocker, its velocity and acceleration, in 30 digits."""
    mp = mpmath(30)
    a, b, c, d = (mp.mpf(x) for x in (LINKAGE.crank, LINKAGE.coupler, LINKAGE.rocker, LINKAGE.frame))
    x = mp.mpf(phi)
    v = mp.mpc(d) - a * mp.expj(x)  # from B to D
    n = abs(v)
    along = (b * b - n * n - c * c) / (2 * n * c)
    e_c = v / n * mp.mpc(along, mp.sqrt(1 - along * along))
    e_b = (v + c * e_c) / b
    e_a = mp.expj(x)
    across = mp.im(e_c * mp.conj(e_b))
    w_b, w_c = a * mp.im(e_a * mp.conj(e_c)) / (b * across), a * mp.im(e_a * mp.conj(e_b)) / (c * across)
    pull = a * mp.re(e_a * mp.conj(e_b)) + b * w_b**2 - c * w_c**2 * mp.re(e_c * mp.conj(e_b))
    return mp.re(e_c), mp.im(e_c), w_c, pull / (c * across)


def error_of(run: Callable[[], Any], name: str, phi: Array) -> float:
    """Worst error in eps of what a method returns."""
    angles = np.sort(phi) if name.startswith("Newton with") else phi
    columns = _columns(run())
    worst = 0.0
    for i in sample_of(angles.size):
        exact = reference(float(angles[i]))
        found = [float(column[i]) for column in columns]
        if len(found) == 3:
            found = [math.cos(found[0]), math.sin(found[0]), *found[1:]]
        worst = max(worst, *(abs(float(type(e)(f) - e)) for f, e in zip(found, exact, strict=True)))
    return worst / EPS


def _columns(result: Any) -> list[Any]:
    if isinstance(result, np.ndarray):
        return [result[2], result[3], result[5], result[7]]
    if isinstance(result, list):
        return [[getattr(s, n) for s in result] for n in ("rocker_angle", "rocker_velocity", "rocker_acceleration")]
    if isinstance(result, fourbar.FourBarState):
        return [result.rocker_angle, result.rocker_velocity, result.rocker_acceleration]
    return list(result)
