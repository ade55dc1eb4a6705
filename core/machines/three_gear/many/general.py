"""Motion of three-gear four-bars of any teeth for arrays of designs: speeds, their extremes, standstills, back-step.

The formulas are those of `linkages.fourbar.loop`, `motion`, `momentary_dwell` and `dwells`, which take arrays. Searches
stand here: Newton's, where each design that rests is frozen, as in `many.symmetric`.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from gearlink.core.machines.three_gear.dwell.dwells import standing
from gearlink.core.machines.three_gear.dwell.momentary_dwell import angle_of_poles, pole_lengths, touching
from gearlink.core.machines.three_gear.motion import blend
from gearlink.core.numerics.arrays import Mask, Reals
from gearlink.core.numerics.elementary_sweep import ARRAYS
from gearlink.core.numerics.roots_sweep import newton_roots
from gearlink.core.parts.linkages.fourbar.lengths import least_transmission_angle
from gearlink.core.parts.linkages.fourbar.loop import rates, triangle

_TURN = 2.0 * math.pi
_LONGEST_STEP, _RESTS, _MOST_STEPS = 0.6, 1e-8, 40


class Drives(NamedTuple):
    """Linkages [mm] with their gears, arrays: the fields of a `Reading`, I = z1/z5, shares of coupler and rocker."""

    a: Any
    b: Any
    c: Any
    d: Any
    s: Any
    n_0: Any
    n_pi: Any
    p_0: Any
    p_pi: Any
    q_0: Any
    q_pi: Any
    e: Any
    f: Any
    ratio: Any
    coupler_share: Any
    rocker_share: Any

    def part(self, places: Any) -> Drives:
        """Some of the designs."""
        return Drives(*(row[places] for row in self))


def turns(links: Drives) -> tuple[Mask, Mask, Mask]:
    """Which are crank-rockers, which drag links, and which stand so near to a change point that sums of floats may err.

    Source
        Grashof's rule, as `FourBar.kind`
    """
    lengths = np.sort(np.array(links[:4]), axis=0)
    margin = (lengths[1] - lengths[0]) + (lengths[2] - lengths[3])
    near = np.abs(margin) <= 1e-9 * lengths[3]
    good = margin > 0.0
    return good & (links.a == lengths[0]), good & (links.d == lengths[0]), near


def _triangle(phi: Reals, links: Drives) -> Any:
    """sin(phi), squares of the half angle's cosine and sine, n^2, R and (P - Q)/2 of `linkages.fourbar.loop`."""
    *found, p, q = triangle(links, np.sin(0.5 * phi), np.cos(0.5 * phi))
    return *found, np.sqrt(p * q), 0.5 * (p - q)


def speed(phi: Reals, links: Drives) -> tuple[Reals, Reals, Reals]:
    """Speed ratio of the output and its first two derivatives with respect to the crank angle."""
    b_1, c_1, b_2, c_2, b_3, c_3 = rates(links, _triangle(phi, links), 3)
    return links.ratio + blend(links, b_1, c_1), blend(links, b_2, c_2), blend(links, b_3, c_3)


def output_angle(phi: Reals, links: Drives) -> Reals:
    """Angle of the output [rad], continuous in the crank angle; its zero is any."""
    a, d, s = links.a, links.d, links.s
    sin, cc, ss, n2, r, _ = _triangle(phi, links)
    e = links.e
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
    total, poles = r1 + 2.0 * r3 + r5, sum(pole_lengths(*radii, ARRAYS))
    e_lo = r1 * r1 * total / poles**2
    e_hi = r1 * (r1 / e_lo)
    frame = touching(r1, r3, r5, a, np.where(a < r1, e_lo, e_hi), ARRAYS).frame
    reached = (e_lo < a) & (a < e_hi)
    near = reached & (np.abs(d - frame) <= 1e-5 * frame)
    near |= np.minimum(np.abs(a - e_lo), np.abs(a - e_hi)) <= 1e-9 * a
    found = standing(a, d, frame, radii, ARRAYS)
    places = [wrapped(links.s * angle_of_poles(r1, r5, *each, ARRAYS)) for each in found]
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
