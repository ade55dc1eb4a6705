"""The loop equation of a four-bar that one link drives: the triangle of the other two, its angles and rates.

With n = |BD| and the half crank angle, everything follows from three sums of two terms,

    n^2 = n_0 cos^2(phi/2) + n_pi sin^2(phi/2)                      n_0 = (d-a)^2,  n_pi = (d+a)^2
    P = (b+c)^2 - n^2 = p_0 cos^2(phi/2) + p_pi sin^2(phi/2)        P >= 0: coupler and rocker reach
    Q = n^2 - (b-c)^2 = q_0 cos^2(phi/2) + q_pi sin^2(phi/2)        Q >= 0: coupler and rocker fold

whose end values are products of correctly rounded sums of the four lengths. The terms are not negative where the
crank turns fully, so a dead centre on the line of the frame, and a change point, cost no digits.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple, TypeAlias

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_below
from gearlink.core.base.wording import short, unlike, within

Triangle: TypeAlias = tuple[float, float, float, float, float, float]


BY_ANGLE = (1.0, 0.0, 0.0)


class Reading(NamedTuple):
    """Constants of one reading of the loop: `a` drives, its pivot is the origin, the other pivot is (d, 0).

    `d` is negative in the inverse reading. n, p, q: values of n^2, P, Q at driving angles 0 and pi;
    e = b^2 - c^2, f = (a^2 - d^2)/2; s = +1 where C lies left of the vector B->D.
    """

    a: float
    b: float
    c: float
    d: float
    s: int
    n_0: float
    n_pi: float
    p_0: float
    p_pi: float
    q_0: float
    q_pi: float
    e: float
    f: float


def make_reading(
    a: float, b: float, c: float, d: float, s: int, total: Callable[[tuple[float, ...]], float] = math.fsum
) -> Reading:
    """Constants from the lengths; every factor is a correctly rounded sum (of arrays, by `sum`, a plain one).

    A product of 0 and a negative factor is 0, not -0, of which the root would turn the triangle over."""
    return Reading(
        *(a, b, c, d, s),
        n_0=(d - a) ** 2,
        n_pi=(d + a) ** 2,
        p_0=total((a, b, c, -d)) * total((-a, b, c, d)) + 0.0,
        p_pi=total((-a, b, c, -d)) * total((a, b, c, d)) + 0.0,
        q_0=total((-a, -b, c, d)) * total((-a, b, -c, d)) + 0.0,
        q_pi=total((a, -b, c, d)) * total((a, b, -c, d)) + 0.0,
        e=(b - c) * (b + c),
        f=0.5 * (a - d) * (a + d),
    )


def solve_loop(reading: Reading, phi: float, order: int, motion: tuple[float, float, float]) -> list[float]:
    """Coupler, rocker and transmission angle, then pairs (coupler, rocker) of rates up to the order.

    The rocker angle of an inverse reading is short of half a revolution.
    """
    if not (0 <= order <= 3):
        raise ValueError(f"order is {order}; the rates go from 0 to 3")
    s, e = reading.s, reading.e
    sin_phi, cc, ss, n2, r, z = found = _triangle(reading, phi, order)
    winding, nu = _to_far_pivot(reading, phi, sin_phi, cc, ss)
    b, c = nu + s * math.atan2(r, e + n2), nu + s * math.atan2(r, e - n2)
    result = [winding + b, winding + c, math.atan2(r, z)]
    if order > 0:
        by_angle = rates(reading, found, order)
        result += by_angle if motion == BY_ANGLE else in_motion(by_angle, *motion)
    return result


def rates_of(reading: Reading, phi: float, order: int) -> tuple[float, float]:
    """Rates of coupler and rocker of that order by the driving angle: those of `solve_loop`, to the last bit, without
    its angles."""
    *_, coupler, rocker = rates(reading, _triangle(reading, phi, order), order)
    return coupler, rocker


def rocker_and_rate(reading: Reading, phi: float) -> tuple[float, float]:
    """Rocker angle and its rate by the driving angle: those of `solve_loop`, to the last bit, and nothing else."""
    s, e = reading.s, reading.e
    sin_phi, cc, ss, n2, r, _ = _triangle(reading, phi, 1)
    winding, nu = _to_far_pivot(reading, phi, sin_phi, cc, ss)
    return winding + (nu + s * math.atan2(r, e - n2)), _rocker_rate(reading, sin_phi, cc, ss, n2, r)


def rocker_rate(reading: Reading, phi: float) -> float:
    """The rate of `rocker_and_rate` alone."""
    sin_phi, cc, ss, n2, r, _ = _triangle(reading, phi, 1)
    return _rocker_rate(reading, sin_phi, cc, ss, n2, r)


def _triangle(reading: Reading, phi: float, order: int) -> Triangle:
    """`triangle`, or the refusal of an angle at which there is none, or no rate."""
    if not math.isfinite(phi):
        raise refusal(reading, phi, math.nan, math.nan)
    sin_phi, cc, ss, n2, p, q = triangle(reading, math.sin(0.5 * phi), math.cos(0.5 * phi))
    pq = p * q
    if not (pq > 0.0 or (pq == 0.0 and order == 0 and n2 > 0.0)):
        raise refusal(reading, phi, p, q)
    return sin_phi, cc, ss, n2, math.sqrt(pq), 0.5 * (p - q)


def triangle(reading: Any, sin_half: Any, cos_half: Any) -> Any:
    """sin(phi), the squares of cosine and sine of phi/2, n^2, P and Q; of numbers, or of arrays."""
    n_0, n_pi, p_0, p_pi, q_0, q_pi = reading[5:11]
    ss, cc = sin_half * sin_half, cos_half * cos_half
    return (*(2.0 * sin_half * cos_half, cc, ss), *(n_0 * cc + n_pi * ss, p_0 * cc + p_pi * ss, q_0 * cc + q_pi * ss))


def _to_far_pivot(reading: Reading, phi: float, sin_phi: float, cc: float, ss: float) -> tuple[float, float]:
    """Direction of D seen from B in two parts: what winds with the driving link, and the rest."""
    a, d = reading.a, reading.d
    if a > abs(d):
        # Wind with the crank: arg(D - B) = phi - pi + a part that stays within a quarter turn.
        return phi - math.pi if d > 0.0 else phi, math.atan2(d * sin_phi, (a - d) * cc + (a + d) * ss)
    if d > 0.0:
        return 0.0, math.atan2(-a * sin_phi, (d - a) * cc + (d + a) * ss)
    return 0.0, math.atan2(a * sin_phi, (a - d) * cc - (a + d) * ss)


def _rocker_rate(reading: Reading, sin_phi: float, cc: float, ss: float, n2: float, r: float) -> float:
    """nu' + g' h, as in `rates`."""
    a, d, m = reading.a, reading.d, 1.0 / n2
    return a * ((a - d) * cc + (a + d) * ss) * m + 2.0 * reading.s * (a * d * sin_phi) / r * (0.5 + 0.5 * reading.e * m)


def rates(reading: Any, found: Any, order: int) -> tuple[Any, ...]:
    """Pairs (coupler, rocker) of rates from coupler' = nu' - g' (1 - h) and rocker' = nu' + g' h.

    g = s gamma is the rocker's lead on the coupler: g' = 2 s a d sin(phi)/R; h = 1/2 + e/(2 n^2);
    nu' = a [(a - d) cos^2(phi/2) + (a + d) sin^2(phi/2)]/n^2, which is 1/2 + f/n^2 but keeps the digits of a short
    crank. The higher rates differentiate these three.

    Parameters
        reading : Reading - of numbers, or of arrays
        found : sin(phi), cos^2 and sin^2 of phi/2, n^2, R = sqrt(P Q), (P - Q)/2
        order : int - 1 to 3
    Returns
        rates : (coupler', rocker', coupler'', ...) - by the driving angle
    """
    a, d, s, e, f = reading.a, reading.d, reading.s, reading.e, reading.f
    sin_phi, cc, ss, n2, r, z = found
    ad, m = a * d, 1.0 / n2
    half_n1 = ad * sin_phi
    h = 0.5 + 0.5 * e * m
    g_1 = 2.0 * s * half_n1 / r
    nu_1 = a * ((a - d) * cc + (a + d) * ss) * m
    b_1, c_1 = nu_1 - g_1 * (0.5 - 0.5 * e * m), nu_1 + g_1 * h
    if order == 1:
        return b_1, c_1
    u_1, cos_phi = half_n1 * m * m, cc - ss
    g_2 = s * (2.0 * ad * cos_phi - g_1 * g_1 * z) / r
    c_2 = g_2 * h - u_1 * (2.0 * f + e * g_1)
    if order == 2:
        return b_1, c_1, c_2 - g_2, c_2
    u_2 = (ad * cos_phi - 4.0 * half_n1 * half_n1 * m) * m * m
    g_3 = g_1 * (g_1 * g_1 - 1.0) - 3.0 * g_1 * g_2 * s * z / r
    c_3 = g_3 * h - 2.0 * e * g_2 * u_1 - u_2 * (2.0 * f + e * g_1)
    return b_1, c_1, c_2 - g_2, c_2, c_3 - g_3, c_3


def in_motion(found: Sequence[Any], velocity: Any, acceleration: Any, jerk: Any) -> list[Any]:
    """Rates by time, the driving link turning with velocity, acceleration and jerk; of numbers, or of arrays."""
    b_1, c_1, *more = found
    result = [velocity * b_1, velocity * c_1]
    if not more:
        return result
    b_2, c_2, *more = more
    v2 = velocity * velocity
    result += (v2 * b_2 + acceleration * b_1, v2 * c_2 + acceleration * c_1)
    if more:
        (b_3, c_3), v3, va = more, v2 * velocity, 3.0 * velocity * acceleration
        result += (v3 * b_3 + va * b_2 + jerk * b_1, v3 * c_3 + va * c_2 + jerk * c_1)
    return result


def closing_range(reading: Reading) -> tuple[float, float]:
    """Driving angles, either way from the frame, between which a linkage that closes somewhere closes.

    Example
        >>> closing_range(make_reading(18.0, 50.0, 100.0, 121.4, 1))
        (0.0, 3.141592653589793)

    Source
        own derivation: the roots of P and Q in the half angle
    """
    _, _, _, d, _, _, _, p_0, p_pi, q_0, q_pi, _, _ = reading
    if d < 0.0:
        p_0, p_pi, q_0, q_pi = p_pi, p_0, q_pi, q_0
    low = 2.0 * math.atan2(math.sqrt(-q_0), math.sqrt(q_pi)) if q_0 < 0.0 else 0.0
    high = 2.0 * math.atan2(math.sqrt(p_0), math.sqrt(-p_pi)) if p_pi < 0.0 else math.pi
    return (low, high) if d > 0.0 else (math.pi - high, math.pi - low)


def refusal(reading: Reading, phi: float, p: float, q: float) -> NoSolution:
    """Why there is no position, or no rate, at this driving angle (p, q: signs of P and Q), and what to change.

    Example
        >>> reading = make_reading(150.0, 160.0, 100.0, 300.0, 1)
        >>> refusal(reading, math.pi / 2, -1.0, 1.0).message
        'the four-bar does not close at crank angle 90 deg: BD 335.4 mm is 75.4 mm too long (reach 60 to 260 mm)'
    """
    a, b, c, d = reading[:4]
    driver, ends, far = ("crank", "BD", "rocker") if d > 0.0 else ("rocker", "AC", "crank")
    if not math.isfinite(phi):
        return NoSolution(f"{driver} angle is {phi!r}; it must be finite")
    n = math.hypot((d - a) * math.cos(0.5 * phi), (d + a) * math.sin(0.5 * phi))
    where = f"at {driver} angle {short(math.degrees(phi))} deg"
    if p < 0.0 or q < 0.0:
        excess = n - (b + c) if p < 0.0 else abs(b - c) - n
        wrong = f"{ends} {short(n)} mm is {max(excess, math.ulp(n)):.3g} mm too {'long' if p < 0.0 else 'short'}"
        reach = f"reach {short(abs(b - c))} to {short(b + c)} mm"
        text = f"the four-bar does not close {where}: {wrong} ({reach})"
        return NoSolution(text, fix=_remedy(reading, driver, far))
    if n == 0.0:
        text = f"the position is not determined {where}"
        return NoSolution(text, fix=f"make coupler and {far}, or {driver} and frame, differ")
    text = f"the four-bar is in a dead centre {where}: coupler and {far} are collinear, their rates not determined"
    return NoSolution(text, fix=f"move the {driver} angle off it or change a length")


def _remedy(reading: Reading, driver: str, far: str) -> str:
    """Where the linkage closes, or which link keeps it from closing anywhere."""
    if not closes_somewhere(reading):
        *others, longest = sorted((reading.a, reading.b, reading.c, abs(reading.d)))
        return f"shorten the longest link, {short(longest)} mm, below {safely_below(math.fsum(others))} mm"
    low, high = (math.degrees(x) for x in closing_range(reading))
    return (
        f"keep the {driver} angle {within(low, high, 'deg')} either way from the frame, or change "
        f"coupler or {far} by that much"
    )


def closes_somewhere(reading: Reading) -> bool:
    return max(reading.p_0, reading.p_pi) > 0.0 and max(reading.q_0, reading.q_pi) > 0.0


def never_closes(reading: Reading) -> str:
    lengths = sorted((reading.a, reading.b, reading.c, abs(reading.d)))
    others = math.fsum(lengths[:3])
    return (
        f"closes nowhere: longest link {unlike(lengths[3], others)} mm (limit < {unlike(others, lengths[3])} mm, the "
        "other three together)"
    )
