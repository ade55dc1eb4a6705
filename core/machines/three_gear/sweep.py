"""Motion of three-gear four-bars of any teeth for arrays of designs: speeds, standstills, back-step, dwells.

The formulas are those of `linkages.fourbar.loop`, `momentary` and `dwell`, which take arrays. Searches stand
here: Newton's, where each design that rests is frozen, so that its last bit does not depend on its neighbours.

The longest dwell within a tolerance is that of `linkages.band_dwell`.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import fields
from typing import Any, NamedTuple

import numpy as np

from gearlink.core.machines.three_gear.dwell import standing
from gearlink.core.machines.three_gear.momentary import angle_of_poles, pole_lengths, touching
from gearlink.core.numerics.arrays import Mask, Reals
from gearlink.core.numerics.elementary_sweep import ARRAYS
from gearlink.core.numerics.roots_sweep import bracketed_roots, newton_roots
from gearlink.core.parts.linkages.band_dwell import (
    MOST_STEPS,
    REST,
    Valley,
    ends_in_band,
    half_of_parabola,
    to_one_speed,
)
from gearlink.core.parts.linkages.fourbar.loop import make_reading, rates, triangle
from gearlink.core.parts.linkages.fourbar.sweep import least_transmission_angle
from gearlink.core.parts.linkages.geared_output import blend

_TURN = 2.0 * math.pi
_LONGEST_STEP, _RESTS, _MOST_STEPS = 0.6, 1e-8, 40  # of a search for an extreme [rad]
_NEAR, _SLOW = 1e-9, 1e-5


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

    def angle(self, phi: Reals) -> Reals:
        """Angle of the output [rad], continuous in the crank angle; its zero is any."""
        return _angle(phi, self, _triangle(phi, self))

    def speed(self, phi: Reals) -> Reals:
        """Speed ratio of the output."""
        return speed(phi, self, 1)[0]

    def rates(self, phi: Reals, order: int) -> tuple[Reals, ...]:
        """`angle`, and its derivatives by the crank angle up to an order; of one triangle."""
        found = _triangle(phi, self)
        return _angle(phi, self, found), *_speeds(self, found, order)


def drives_of(lengths: Any, assembly: int, *shares: Any) -> Drives:
    """Drives of crank, coupler, rocker and frame [mm], of I and the shares of coupler and rocker: arrays or numbers."""
    crank, coupler, rocker, frame = lengths
    reading = make_reading(crank, coupler, rocker, frame, assembly, total=sum)
    return Drives(*np.broadcast_arrays(*reading, *shares))


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
    half = np.tan(0.5 * phi)  # which numpy computes several times as fast as a sine
    cosine = 1.0 / np.sqrt(1.0 + half * half)
    *found, p, q = triangle(links, half * cosine, cosine)
    return *found, np.sqrt(p * q), 0.5 * (p - q)


def speed(phi: Reals, links: Drives, order: int = 3) -> tuple[Reals, ...]:
    """Speed ratio of the output and its derivatives with respect to the crank angle, `order` of them in all."""
    return _speeds(links, _triangle(phi, links), order)


def _speeds(links: Drives, found: Any, order: int) -> tuple[Reals, ...]:
    pairs = rates(links, found, order)
    ratio, *more = (blend(links, *pairs[i : i + 2]) for i in range(0, 2 * order, 2))
    return links.ratio + ratio, *more


def terms(phi: Reals, links: Drives) -> Reals:
    """The size of what the speed ratio is summed from."""
    b_1, c_1 = rates(links, _triangle(phi, links), 1)
    return np.asarray(np.abs(links.ratio) + np.abs(links.coupler_share * b_1) + np.abs(links.rocker_share * c_1))


def _angle(phi: Reals, links: Drives, found: Any) -> Reals:
    a, d, s, e = links.a, links.d, links.s, links.e
    sin, cc, ss, n2, r, _ = found
    drag = a > d
    # The direction of D, seen from B, and R are never negative; coupler and rocker as in `linkages.fourbar.sweep`.
    nu = np.arctan(np.where(drag, d, -a) * sin / (np.abs(d - a) * cc + (a + d) * ss))
    nu = np.where(drag, nu + (phi - math.pi), nu)
    coupler, rocker = (nu + s * (0.5 * math.pi - np.arctan(x / r)) for x in (e + n2, e - n2))
    return np.asarray(links.ratio * phi + links.coupler_share * coupler + links.rocker_share * rocker)


def extreme(links: Drives, start: Reals, sign: float) -> tuple[Reals, Reals, Mask]:
    """Maximum (sign 1) or minimum (-1) speed ratio, its crank angle, and where the search came to rest on one.

    Notes
        Newton's method on the acceleration from the start, steps of 0.6 rad at most.
    """
    phi = np.array(start)
    rests = np.zeros(phi.shape, dtype=bool)
    live = np.flatnonzero(np.isfinite(least_transmission_angle(*links[:4])))
    some = links if live.size == phi.size else links.part(live)
    for _ in range(_MOST_STEPS):
        if not live.size:
            break
        _, slope, bend = speed(phi[live], some)
        step = slope / bend
        # Where the speed is bent the other way, the step leads uphill (or downhill) by the slope's sign.
        wrong = bend * sign >= 0.0
        step = np.where(wrong, -np.sign(slope) * sign * _LONGEST_STEP, step)
        step = np.clip(step, -_LONGEST_STEP, _LONGEST_STEP)  # a step of the search, no result
        moves = ~rests[live]
        phi[live] -= np.where(moves, step, 0.0)
        moves &= wrong | ~(np.abs(step) <= _RESTS)
        rests[live] = ~moves
        left = np.count_nonzero(moves)
        if 2 * left < live.size:  # to copy all links takes as long as a step
            live, some = live[moves], some.part(moves)
    return speed(phi, links, 1)[0], phi, rests


def standstills(radii: tuple[Reals, Reals, Reals], links: Drives) -> tuple[Reals, Reals, Mask]:
    """Crank angles [rad] of both standstills, ascending, NaN where there is none; and where there may be just one.

    Parameters
        radii : (N,) arrays [mm] - reference radii of crank gear, idler and output gear
    Source
        as `dwell.Output.places`
    """
    r1, r3, r5 = radii
    a, d = links.a, links.d
    _, e_lo = _least_cranks(radii)
    e_hi = r1 * (r1 / e_lo)
    frame = touching(r1, r3, r5, a, np.where(a < r1, e_lo, e_hi), ARRAYS).frame
    reached = (e_lo < a) & (a < e_hi)
    near = reached & (np.abs(d - frame) <= 1e-5 * frame)
    near |= np.minimum(np.abs(a - e_lo), np.abs(a - e_hi)) <= 1e-9 * a
    found = standing(a, d, frame, radii, ARRAYS)
    places = [wrapped(links.s * angle_of_poles(r1, r5, *each, ARRAYS)) for each in found]
    exists = reached & (d > frame)
    return np.where(exists, np.minimum(*places), np.nan), np.where(exists, np.maximum(*places), np.nan), near


def _least_cranks(radii: tuple[Any, Any, Any]) -> tuple[Any, Any]:
    """S, and e_lo of `momentary.least_eccentricity` [mm]."""
    r1, r3, r5 = radii
    total = r1 + 2.0 * r3 + r5
    return total, r1 * r1 * total / sum(pole_lengths(*radii, ARRAYS)) ** 2


def around(least: Reals, greatest: Reals, links: Drives) -> tuple[Reals, Reals]:
    """Standstills before and after the minimum speed, of outputs that turn back there; of any links."""
    value, _, bend = speed(least, links)
    after = least + np.mod(greatest - least, _TURN)
    spread = np.sqrt(-2.0 * value / bend)  # of the parabola
    found = []
    for low, high, sign in ((after - _TURN, least, -1.0), (least, after, 1.0)):

        def rising(phi: Reals, *rows: Reals, sign: float = sign) -> tuple[Reals, Reals]:
            ratio, slope = speed(phi, Drives(*rows), 2)
            return sign * ratio, sign * slope

        start = np.where(spread < high - low, least + sign * spread, 0.5 * (low + high))
        found.append(newton_roots(rising, low, high, start, *links))
    return found[0], found[1]


def wrapped(angle: Any) -> Reals:
    """The angle within [0, 2 pi)."""
    turned = np.mod(angle, _TURN)
    return np.where(turned >= _TURN, 0.0, turned)


def back_step(low: Reals, high: Reals, links: Drives) -> tuple[Reals, Reals, Reals]:
    """Start, crank angle and size of the back-step between two standstills [rad], as `GearedOutput.back_step`."""
    falls = speed(low, links, 2)[1] <= 0.0
    start, end = np.where(falls, low, high), np.where(falls, high, low)
    width = wrapped(end - start)
    return start, width, links.angle(start) - links.angle(start + width)


def dwell_angle(start: Reals, width: Reals, links: Drives) -> Reals:
    """phi13 [rad]: the crank angle from the start until the output is back, as `GearedOutput.dwell_angle`."""
    level = links.angle(start)

    def gained(x: Reals, start: Reals, level: Reals, *rows: Reals) -> tuple[Reals, Reals]:
        angle, ratio = Drives(*rows).rates(start + x, 1)
        return angle - level, ratio

    high = np.full(width.shape, _TURN)
    return newton_roots(gained, width, high, np.minimum(1.5 * width, 0.5 * (width + high)), start, level, *links)


class Dwells(NamedTuple):
    """Start and length of the dwells [rad], whether the start is one of two as good, and whether a root is doubtful."""

    start: Reals
    crank_angle: Reals
    tied: Mask
    doubtful: Mask


class Valleys(Valley):
    """The `Valley` of many outputs, whose `course` are their `Drives`; places are (N,) arrays."""

    fn = ARRAYS

    def part(self, places: Any) -> Valleys:
        """Some of the outputs."""
        rows = (getattr(self, each.name)[places] for each in fields(self)[1:])
        return Valleys(self.course.part(places), *rows)

    def reach(self, level: Any, left: Any, right: Any, sign: float = 1.0, start: Any = None) -> Any:

        def above(x: Reals, level: Reals, *rows: Reals) -> tuple[Reals, Reals]:
            angle, ratio = Drives(*rows).rates(x, 1)
            return sign * (angle - level), sign * ratio

        at_left, at_right = (sign * (self.angle(end) - level) for end in (left, right))
        middle = 0.5 * (left + right)
        begin = middle if start is None else np.where((left < start) & (start < right), start, middle)
        found = newton_roots(above, left, right, begin, level, *self.course)
        return np.where(at_left >= 0.0, left, np.where(at_right <= 0.0, right, found))

    def either(self, holds: Any, one: Callable[..., Any], other: Callable[..., Any], *given: Any) -> Any:
        """As of one, for each of them."""
        found: list[Any] = []
        for places, function in ((np.flatnonzero(holds), one), (np.flatnonzero(~holds), other)):
            if places.size == holds.size:
                return function(self, *given)
            if not places.size:
                continue
            parts = function(self.part(places), *(each[places] for each in given))
            found = found or [np.empty(holds.shape, dtype=part.dtype) for part in parts]
            for whole, part in zip(found, parts, strict=True):
                whole[places] = part
        return found

    def settled(self, tolerance: Any) -> tuple[Any, Any, Any]:
        """As of one, each by itself."""
        half = half_of_parabola(self, tolerance)
        left, right = self.least - half, self.least + half
        rests, live = np.zeros(left.shape, dtype=bool), np.arange(left.size)
        for _ in range(MOST_STEPS):
            if not live.size:
                break
            some = self.course.part(live)
            back, on = to_one_speed(some, left[live], right[live], tolerance[live], ARRAYS)
            left[live] += back
            right[live] += on
            rest = (np.abs(back) <= REST) & (np.abs(on) <= REST)
            rests[live[rest]] = True
            live = live[~rest & np.isfinite(back) & np.isfinite(on)]
        return left, right, rests

    def held(self, f: Callable[..., Any], most: Any, *given: Any) -> Any:
        """As of one, each by itself; NaN where there is no root."""
        least = np.zeros(most.shape)
        first, last = f(self, least, *given), f(self, most, *given)
        found = np.where(first >= 0.0, least, most)
        places = np.flatnonzero(~(first >= 0.0) & ~(last <= 0.0))
        if places.size:
            some, rest, ends = self.part(places), [each[places] for each in given], (first[places], last[places])
            found[places] = bracketed_roots(lambda x: f(some, x, *rest), least[places], most[places], ends=ends)
        return found


def longest_in_band(valleys: Valleys, tolerance: Reals) -> Dwells:
    """The longest crank interval over which each output stays within +- tol of a place that is free to choose.

    Parameters
        tolerance : (N,) array [rad] - below half of what the output gains in a revolution
    """
    left, right, _, unsure, wide = ends_in_band(valleys, tolerance)
    drop = valleys.drop
    doubtful = np.asarray((drop > 0.0) & (np.abs(drop - 2.0 * tolerance) <= _NEAR)) | (unsure & ~wide)
    slowest = np.minimum(*(np.abs(valleys.speed(end)) for end in (left, right)))
    return Dwells(wrapped(left), right - left, unsure & wide, doubtful | ~(slowest > _SLOW))


class MomentaryDwells(NamedTuple):
    """Momentary-dwell designs: frame length [mm], crank angle of the standstill [rad], both NaN where not `exists`."""

    frame: Reals
    crank_angle: Reals
    exists: Mask


def momentary_dwells(r1: Any, r3: Any, r5: Any, eccentricity: Any) -> MomentaryDwells:
    """Frame length and crank angle of the momentary dwell for many gears and cranks.

    d*^2 = (S - e_lo)^2 cos^2(beta) + r5^2 sin^2(beta),   cos^2(beta) = (r1^2 - e^2)/(r1^2 - e_lo^2)

    Parameters
        r1, r3, r5, eccentricity : arrays that broadcast [mm] - positive
    Returns
        dwells : MomentaryDwells - `exists` where a crank-rocker has one: e_lo < e < e_up as in
            `momentary.eccentricity_range`; assembly +1
    Example
        >>> found = momentary_dwells(25.0, 25.0, 75.0, np.array([5.0, 16.0, 18.0, 26.0]))
        >>> found.exists.tolist(), np.round(found.frame[1:3], 9).tolist()
        ([False, True, True, False], [122.839414792, 115.522215625])

    Source
        own derivation; scalar form in `gearlink.core.machines.three_gear.momentary`
    """
    total, e_lo = _least_cranks((r1, r3, r5))
    exists = (e_lo < eccentricity) & (eccentricity < r1 - 2.0 * np.maximum(0.0, r1 - r5) * e_lo / total)
    with np.errstate(invalid="ignore"):
        found = touching(r1, r3, r5, eccentricity, e_lo, ARRAYS)
        x = found.cos_beta
        turned = angle_of_poles(r1, r5, total * x, e_lo * x, found.sin_beta, ARRAYS)
    turned = np.where(turned < 0.0, turned + _TURN, turned)
    return MomentaryDwells(np.where(exists, found.frame, np.nan), np.where(exists, turned, np.nan), exists)
