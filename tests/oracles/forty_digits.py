"""Plain formulas of every family in mpmath: definitions, the law of cosines, roots and quadrature; no closed form of
the program's. Call them at 40 digits or more; floats that come in are taken as exact."""

from __future__ import annotations

from fractions import Fraction
from math import factorial
from typing import Any

import mpmath as mp

SHARES = {  # of acceleration: sine up, constant, cosine down, and of constant velocity
    "simple-harmonic": (0, 0, 1, 0),
    "cycloidal": (Fraction(1, 2), 0, Fraction(1, 2), 0),
    "modified-trapezoid": (Fraction(1, 4), Fraction(1, 2), Fraction(1, 4), 0),
    "modified-sine": (Fraction(1, 4), 0, Fraction(3, 4), 0),
    "mcv-50": (Fraction(1, 8), 0, Fraction(3, 8), Fraction(1, 2)),
    "mcv-33": (Fraction(1, 6), 0, Fraction(1, 2), Fraction(1, 3)),
    "mcv-20": (Fraction(1, 5), 0, Fraction(3, 5), Fraction(1, 5)),
}
COEFFICIENTS = {"polynomial-345": (0, 0, 0, 10, -15, 6), "polynomial-4567": (0, 0, 0, 0, 35, -84, 70, -20)}


def four_bar(lengths: tuple, side: int, phi: float, order: int = 2) -> tuple[list, list]:
    """Coupler and rocker angle and their derivatives by the crank angle."""
    a, b, c, d = map(mp.mpf, lengths)

    def to_d(x: Any) -> tuple[Any, Any]:
        v = d - a * mp.expj(x)
        return abs(v), mp.atan2(mp.im(v), mp.re(v))

    def coupler(x: Any) -> Any:
        n, direction = to_d(x)
        return direction + side * mp.acos((b * b + n * n - c * c) / (2 * b * n))

    def rocker(x: Any) -> Any:
        n, direction = to_d(x)
        return direction + mp.pi - side * mp.acos((c * c + n * n - b * b) / (2 * c * n))

    return tuple(
        [term * factorial(i) for i, term in enumerate(mp.taylor(f, mp.mpf(phi), order))] for f in (coupler, rocker)
    )


def working_pressure_angle(teeth: tuple, shifts: tuple, alpha: float) -> Any:
    """Root of tan a - a = tan alpha - alpha + 2 (x1 + x2)/(z1 + z2) tan alpha; None where there is none."""
    alpha = mp.mpf(alpha)
    wanted = mp.tan(alpha) - alpha + 2 * (mp.mpf(shifts[0]) + mp.mpf(shifts[1])) / sum(teeth) * mp.tan(alpha)
    if wanted <= 0:
        return None
    low, high = mp.mpf(0), mp.pi / 2
    for _ in range(20):
        middle = (low + high) / 2
        low, high = (middle, high) if mp.tan(middle) - middle < wanted else (low, middle)
    return mp.findroot(lambda x: mp.tan(x) - x - wanted, (low, high), solver="anderson", tol=mp.eps**2)


def stroke(crank: float, rod: float, offset: float) -> Any:
    """Distance of the dead centres of a slider-crank."""
    r, rod, e = map(mp.mpf, (crank, rod, offset))
    return mp.sqrt((rod + r) ** 2 - e * e) - mp.sqrt((rod - r) ** 2 - e * e)


def scca_acceleration(shares: Any, x: Any) -> Any:
    """Unscaled acceleration of the law of shares (a, b, c, d), straight from its definition."""
    a, b, c, d = (mp.mpf(share.numerator) / share.denominator for share in map(Fraction, shares))
    y = min(x, 1 - x)
    if y < a / 2:
        size = mp.sin(mp.pi * y / a)
    elif y < (a + b) / 2:
        size = mp.mpf(1)
    elif y < (1 - d) / 2:
        size = mp.cos(mp.pi * (y - (a + b) / 2) / c)
    else:
        size = mp.mpf(0)
    return size if 2 * x <= 1 else -size


def rise(definition: Any, x: float) -> tuple[Any, Any, Any]:
    """Rise, velocity and acceleration of a law of motion from its definition."""
    x = mp.mpf(x)
    if str(definition) in COEFFICIENTS:
        terms = list(enumerate(COEFFICIENTS[definition]))
        velocity = mp.fsum(k * n * x ** (n - 1) for n, k in terms[1:])
        acceleration = mp.fsum(k * n * (n - 1) * x ** (n - 2) for n, k in terms[2:])
        return mp.fsum(k * x**n for n, k in terms), velocity, acceleration
    shares = definition["scca"] if isinstance(definition, dict) else SHARES[definition]
    a, b, c, _ = (mp.mpf(share.numerator) / share.denominator for share in map(Fraction, shares))
    first = [mp.mpf(0), a / 2, (a + b) / 2, (a + b + c) / 2, mp.mpf(1) / 2]
    joints = sorted({*first, *(1 - joint for joint in first)})

    def integral(end: Any, power: int) -> Any:
        ends = [joint for joint in joints if joint < end] + [end]
        return mp.quad(lambda t: (end - t) ** power * scca_acceleration(shares, t), ends) if end else mp.mpf(0)

    whole = integral(mp.mpf(1), 1)
    return integral(x, 1) / whole, integral(x, 0) / whole, scca_acceleration(shares, x) / whole


def translating_profile(phi: float, y: float, y1: float, offset: float, sense: int, radius: float) -> Any:
    """Contact of a translating roller, turned into the cam's frame."""
    return _contact(phi, mp.mpc(y, -mp.mpf(offset)), mp.mpc(y1), sense, radius)


def oscillating_profile(phi: float, rocker: tuple, sense: int, radius: float) -> Any:
    """Contact of a roller on an arm: pivot, arm, angle and its derivative by the cam angle."""
    pivot, arm, psi, psi1 = rocker
    spoke = mp.mpf(arm) * mp.expj(mp.mpf(psi))
    return _contact(phi, mp.mpc(pivot) + spoke, mp.mpc(0, 1) * spoke * mp.mpf(psi1), sense, radius)


def _contact(phi: float, center: Any, rate: Any, sense: int, radius: float) -> Any:
    turned = lambda t: mp.expj(-sense * t)  # noqa: E731
    pitch = turned(mp.mpf(phi)) * center
    along = turned(mp.mpf(phi)) * (rate - mp.mpc(0, sense) * center)
    return pitch - mp.mpc(0, sense) * mp.mpf(radius) * along / abs(along)


def dwell_angle(i3: float, phi12: float) -> Any:
    """phi13 of the symmetric family, by its own equation."""
    n, h = 1 - mp.mpf(i3), mp.mpf(phi12) / 2
    k = 1 / mp.sqrt(n * n * mp.cos(h) ** 2 + mp.sin(h) ** 2)
    left = lambda y: n * (mp.asin(k * mp.sin(y)) + mp.asin(k * mp.sin(h))) - h - y  # noqa: E731
    ends = h * (1 + mp.mpf("1e-9")), min(3 * h, 2 * mp.pi * n / (1 + n) - h) * (1 + mp.mpf("1e-12"))
    return h + mp.findroot(left, ends, solver="anderson", tol=mp.mpf(10) ** -60)


def momentary_frame(r1: float, r3: float, r5: float, e: float) -> Any:
    """Frame of the momentary dwell, step by step as in the thesis (4-26)..(4-33), with its slips corrected."""
    r1, r3, r5, e = map(mp.mpf, (r1, r3, r5, e))
    s = r1 + 2 * r3 + r5
    k = r1**2 * ((r5**2 - r1**2) ** 2 - 2 * (r5**2 + r1**2) * s**2 + s**4)
    linear, constant = k * (e**2 - r1**2) / r1**2, -(s**2) * (r1**2 - e**2) ** 2
    cosine = mp.sqrt((-linear + mp.sqrt(linear**2 - 4 * k * constant)) / (2 * k))
    sine = mp.sqrt(1 - cosine**2)
    to_pole = r1 * cosine - e * mp.sqrt(1 - (r1 * sine / e) ** 2)
    return mp.hypot(to_pole + 2 * r3 * cosine + r5 * cosine, r5 * sine)


def energy_parameter(ratio: float, stretch: float | None, swing: float) -> Any:
    """Energy parameter of an unloading law: the time of half the swing by quadrature, phi = th0 (1 - v^2)."""
    lam, th0 = mp.mpf(ratio), mp.mpf(swing) / 2
    shortest, longest = lam - 1, mp.sqrt(1 + lam**2 - 2 * lam * mp.cos(th0))

    def slowness(v: Any) -> Any:
        phi = th0 * (1 - v * v)
        length = mp.sqrt(1 + lam**2 - 2 * lam * mp.cos(phi))
        chord = mp.sin(th0 * (1 - v * v / 2)) * mp.sin(th0 * v * v / 2)
        shortened = 4 * lam * chord / (longest + length)
        pull = 1 if stretch is None else (1 + mp.mpf(stretch)) * (longest - shortest) - shortened / 2
        return 2 * th0 * v / mp.sqrt(pull * shortened)

    half = mp.quad(slowness, [0, *(1 - mp.mpf(4) ** -j for j in range(1, 6)), 1])
    return (half / th0) ** 2
