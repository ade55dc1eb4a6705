"""Motion of three-gear four-bars of any teeth for arrays of designs: speeds, their extremes, standstills, back-step.

The equations are those of `linkages.fourbar.loop`, `motion` and `dwells` for arrays of linkages. Roots freeze each
design that rests, as in `many.symmetric`.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from gearlink.core.numerics.arrays import Mask, Reals
from gearlink.core.numerics.roots_sweep import newton_roots
from gearlink.core.parts.linkages.fourbar.lengths import least_transmission_angle

_TURN = 2.0 * math.pi
_LONGEST_STEP, _RESTS, _MOST_STEPS = 0.6, 1e-8, 40


class Drives(NamedTuple):
    """Linkages [mm] with their gears: a, b, c, d, assembly, I = z1/z5, shares of coupler and rocker in the output."""

    a: Reals
    b: Reals
    c: Reals
    d: Reals
    s: Reals
    ratio: Reals
    coupler_share: Reals
    rocker_share: Reals

    def part(self, places: Any) -> Drives:
        """Some of the designs."""
        return Drives(*(row[places] for row in self))


def turns(links: Drives) -> tuple[Mask, Mask, Mask]:
    """Which are crank-rockers, which drag links, and which stand so near to a change point that sums of floats may err.

    Source
        Grashof's rule, as `FourBar.kind`
    """
    lengths = np.sort(np.array([links.a, links.b, links.c, links.d]), axis=0)
    margin = (lengths[1] - lengths[0]) + (lengths[2] - lengths[3])
    near = np.abs(margin) <= 1e-9 * lengths[3]
    good = margin > 0.0
    return good & (links.a == lengths[0]), good & (links.d == lengths[0]), near


def _loop(phi: Reals, links: Drives) -> tuple[Any, ...]:
    """sin and cos of phi, squares of the half angle's, n^2, R and z of `linkages.fourbar.loop`."""
    a, b, c, d = links[:4]
    half_sin, half_cos = np.sin(0.5 * phi), np.cos(0.5 * phi)
    ss, cc = half_sin * half_sin, half_cos * half_cos
    n2 = (d - a) ** 2 * cc + (d + a) ** 2 * ss
    p = (a + b + c - d) * (b + c + d - a) * cc + (b + c - a - d) * (a + b + c + d) * ss
    q = (c + d - a - b) * (b + d - a - c) * cc + (a + c + d - b) * (a + b + d - c) * ss
    return 2.0 * half_sin * half_cos, cc - ss, ss, cc, n2, np.sqrt(p * q), 0.5 * (p - q)


def speed(phi: Reals, links: Drives) -> tuple[Reals, Reals, Reals]:
    """Speed ratio of the output and its first two derivatives with respect to the crank angle."""
    a, b, c, d, s = links[:5]
    sin, cos, ss, cc, n2, r, z = _loop(phi, links)
    e, f, ad, m = (b - c) * (b + c), 0.5 * (a - d) * (a + d), a * d, 1.0 / n2
    half = ad * sin
    h = 0.5 + 0.5 * e * m
    g_1 = 2.0 * s * half / r
    nu_1 = a * ((a - d) * cc + (a + d) * ss) * m
    c_1 = nu_1 + g_1 * h
    u_1 = half * m * m
    g_2 = s * (2.0 * ad * cos - g_1 * g_1 * z) / r
    c_2 = g_2 * h - u_1 * (2.0 * f + e * g_1)
    u_2 = (ad * cos - 4.0 * half * half * m) * m * m
    g_3 = g_1 * (g_1 * g_1 - 1.0) - 3.0 * g_1 * g_2 * s * z / r
    c_3 = g_3 * h - 2.0 * e * g_2 * u_1 - u_2 * (2.0 * f + e * g_1)
    p, q = links.coupler_share, links.rocker_share
    return links.ratio + p * (c_1 - g_1) + q * c_1, p * (c_2 - g_2) + q * c_2, p * (c_3 - g_3) + q * c_3


def output_angle(phi: Reals, links: Drives) -> Reals:
    """Angle of the output [rad], continuous in the crank angle; its zero is any."""
    a, b, c, d, s = links[:5]
    sin, _, ss, cc, n2, r, _ = _loop(phi, links)
    e = (b - c) * (b + c)
    drag = a > d
    nu = np.where(
        drag,
        phi - math.pi + np.arctan2(d * sin, (a - d) * cc + (a + d) * ss),
        np.arctan2(-a * sin, (d - a) * cc + (d + a) * ss),
    )
    coupler, rocker = nu + s * np.arctan2(r, e + n2), nu + s * np.arctan2(r, e - n2)
    return np.asarray(links.ratio * phi + links.coupler_share * coupler + links.rocker_share * rocker)


def extreme(links: Drives, start: float, sign: float) -> tuple[Reals, Reals, Mask]:
    """Greatest (sign 1) or least (-1) speed ratio, its crank angle, and where the search came to rest on one.

    Notes
        Newton's method on the acceleration from s times the start, steps of 0.6 rad at most.
    """
    phi = links.s * start
    rests = np.zeros(phi.shape, dtype=bool)
    live = np.flatnonzero(np.isfinite(least_transmission_angle(*links[:4])))
    for _ in range(_MOST_STEPS):
        _, slope, bend = speed(phi[live], links.part(live))
        step = slope / bend
        # Where the speed is bent the other way, the step leads uphill (or downhill) by the slope's sign.
        wrong = bend * sign >= 0.0
        step = np.where(wrong, -np.sign(slope) * sign * _LONGEST_STEP, step)
        step = np.clip(step, -_LONGEST_STEP, _LONGEST_STEP)  # a step of the search, no result
        phi[live] -= step
        done = ~wrong & (np.abs(step) <= _RESTS)
        rests[live[done]] = True
        live = live[~done]
        if not live.size:
            break
    return speed(phi, links)[0], phi, rests


def standstills(radii: tuple[Reals, Reals, Reals], links: Drives) -> tuple[Reals, Reals, Mask]:
    """Crank angles [rad] of both standstills, ascending, NaN where there is none; and where there may be just one.

    Parameters
        radii : (N,) arrays [mm] - reference radii of crank gear, idler and output gear
    Source
        as `dwells.dwell_positions`
    """
    r1, r3, r5 = radii
    a, d = links.a, links.d
    b, outer, total = r1 + r3, r3 + r5, r1 + 2.0 * r3 + r5
    share = r1 / (np.sqrt(b * (b + r5)) + np.sqrt(r3 * outer))
    e_lo = share * share * (b + outer)
    e_hi = r1 * (r1 / e_lo)
    e_t = np.where(a < r1, e_lo, e_hi)
    span = (r1 - e_t) * (r1 + e_t)
    cos_beta, sin_beta = np.sqrt((r1 - a) * (r1 + a) / span), np.sqrt((a - e_t) * (a + e_t) / span)
    frame = np.hypot((total - e_t) * cos_beta, r5 * sin_beta)
    reached = (e_lo < a) & (a < e_hi)
    near = reached & (np.abs(d - frame) <= 1e-5 * frame)
    near |= np.minimum(np.abs(a - e_lo), np.abs(a - e_hi)) <= 1e-9 * a
    u, v = np.sqrt(b * (b + r5)), np.sqrt(r3 * outer)
    h = (a - r1) * (a + r1)
    factor = np.where(a < r1, u + v, total * r1 / (u + v)) / r1
    delta = (d - frame) * (d + frame)
    four = 4.0 * np.abs(h) * u * v
    p = 2.0 * (u * u + v * v)
    mean = p * delta + four * factor * factor
    root = 2.0 * total * np.sqrt(delta * (r1 * r1 * delta + four))
    g = h * factor * factor - delta
    places = []
    for x2 in ((mean + root) / (4.0 * u * v) ** 2, g * g / (mean + root)):
        x = np.sqrt(x2)
        w = (p * x2 + g) / (2.0 * total * x)
        sine = np.sqrt(1.0 - x2)
        phi = np.arctan2(-r1 * sine, -w) - np.arctan2(-r5 * sine, total * x - w)
        places.append(wrapped(links.s * phi))
    exists = reached & (d > frame)
    return np.where(exists, np.minimum(*places), np.nan), np.where(exists, np.maximum(*places), np.nan), near


def wrapped(angle: Any) -> Reals:
    """The angle within [0, 2 pi)."""
    turned = np.mod(angle, _TURN)
    return np.where(turned >= _TURN, 0.0, turned)


def back_step(low: Reals, high: Reals, links: Drives) -> tuple[Reals, Reals, Reals]:
    """Start, crank angle and size of the back-step between two standstills [rad], as `dwells.back_step`."""
    falls = speed(low, links)[1] <= 0.0
    start, end = np.where(falls, low, high), np.where(falls, high, low)
    width = wrapped(end - start)
    return start, width, output_angle(start, links) - output_angle(start + width, links)


def dwell_angle(start: Reals, width: Reals, links: Drives) -> Reals:
    """phi13 [rad]: the crank angle from the start until the output has regained its place, as `dwells.dwell_angle`."""
    level = output_angle(start, links)

    def gained(x: Reals, start: Reals, level: Reals, *rows: Reals) -> tuple[Reals, Reals]:
        drives = Drives(*rows)
        return output_angle(start + x, drives) - level, speed(start + x, drives)[0]

    high = np.full(width.shape, _TURN)
    return newton_roots(gained, width, high, np.minimum(1.5 * width, 0.5 * (width + high)), start, level, *links)
