"""From a measured profile to the motion of the follower, and to the dwells and strokes that it is made of."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short, unlike, within
from gearlink.core.numerics.arrays import Points, Reals
from gearlink.core.parts.cams.laws import REST_TO_REST, law

TURN = 2.0 * math.pi
_STEPS = 100
_EXACT, _SETTLED = 1e-13, 1e-9
"""Errors of the cam angle [rad] at which Newton's steps end: below the first, or no longer falling below the second."""
_LARGEST_CONDITION = 1e6
ROWS = 1440
"""Places in a revolution at which the motion is looked at."""
_SHORTEST_DWELL = math.radians(10.0)
_SHORTEST_STROKE = math.radians(3.0)
_FIT_STEPS = 30


class Series(NamedTuple):
    """Radius of a profile over its own angle, rho(t) = a_0 + sum a_k cos kt + b_k sin kt [mm]."""

    cosines: Reals
    sines: Reals

    @classmethod
    def fitted(cls, t: Reals, radius: Reals, order: int) -> Series:
        """The series of least squares through points.

        Raises
            NoSolution - where a gap between the points leaves it open
        """
        k = np.arange(1, order + 1)
        columns = np.concatenate([np.ones((t.size, 1)), np.cos(np.outer(t, k)), np.sin(np.outer(t, k))], axis=1)
        found, _, _, singular = np.linalg.lstsq(columns, radius, rcond=None)
        if singular[0] > _LARGEST_CONDITION * singular[-1]:
            widest = math.degrees(float(np.max(np.diff(np.append(t, t[0] + TURN)))))
            raise NoSolution(
                f"the points leave the profile open: gap of {widest:.4g} deg for {order} harmonics",
                key="harmonics",
                fix="lower harmonics, or give points in the gap",
            )
        return cls(np.append(found[0], found[1 : order + 1]), np.append(0.0, found[order + 1 :]))

    def at(self, t: Reals, order: int) -> list[Reals]:
        """Radius and its derivatives."""
        k = np.arange(self.cosines.size)
        cos, sin = np.cos(np.multiply.outer(t, k)), np.sin(np.multiply.outer(t, k))
        a, b, found = self.cosines, self.sines, []
        for _ in range(order + 1):
            found.append((cos * a).sum(axis=-1) + (sin * b).sum(axis=-1))
            a, b = k * b, -k * a
        return found


class Contact(NamedTuple):
    """The roller's centre in the cam, its first two derivatives by t, and the outward normal."""

    center: Points
    first: Points
    second: Points
    normal: Points


class Follower(NamedTuple):
    """The coordinate of the follower [rad or mm] and the cam angle [rad], with derivatives by t; way of its roller."""

    value: tuple[Reals, Reals, Reals]
    cam_angle: tuple[Reals, Reals, Reals]
    way: Points


@dataclass(frozen=True)
class MeasuredCam:
    """A profile by its series, and a follower on it.

    Parameters
        series : Series
        roller : float [mm]
        sense : +1 or -1 - of the cam
        pivot : complex [mm] or None - of an oscillating follower
        arm : float [mm], side : +1 or -1 - of it
        direction : complex, offset : float [mm] - of a translating one
    Notes
        The profile is touched by the roller's centre R = C + r_g N; t runs along the profile, the cam angle is the turn
        that brings R to where the follower takes its roller.
    Source
        own derivation
    """

    series: Series
    roller: float
    sense: int
    pivot: complex | None = None
    arm: float = 0.0
    side: int = 1
    direction: complex = 1j
    offset: float = 0.0

    @property
    def outward_sense(self) -> float:
        """+1 where the follower's coordinate grows as its roller leaves the cam axis."""
        return 1.0 if self.pivot is None else -float(self.side)

    def outward(self, value: Any) -> Any:
        """Its coordinate away from the cam axis [mm, or rad]; that of a rocker from the line pivot -> cam axis."""
        return value if self.pivot is None else math.pi - self.side * (value - cmath.phase(self.pivot))

    def contact(self, t: Reals) -> Contact:
        """R = C + r_g N with N = -i T, T = C'/|C'|, T' = i w T."""
        rho, d1, d2, d3 = self.series.at(t, 3)
        e = np.exp(1j * t)
        c1 = (d1 + 1j * rho) * e
        c2 = (d2 + 2j * d1 - rho) * e
        c3 = (d3 + 3j * d2 - 3.0 * d1 - 1j * rho) * e
        length = np.abs(c1)
        tangent, square = c1 / length, length * length
        w = (np.conj(c1) * c2).imag / square
        w1 = (np.conj(c1) * c3).imag / square - 2.0 * w * (np.conj(c1) * c2).real / square
        r = self.roller
        return Contact(
            rho * e - 1j * r * tangent, c1 + r * w * tangent, c2 + r * (w1 + 1j * w * w) * tangent, -1j * tangent
        )

    def follower(self, t: Reals) -> Follower:
        """Coordinate of the follower, cam angle, and the direction in which the roller goes.

        Raises
            NoSolution - where the follower does not reach the profile
        """
        at = self.contact(t)
        value, place, way = self._placed(at)
        there, here = _turned(*place), _turned(at.center, at.first, at.second)
        # Both are continuous over a revolution: the roller stays on one side of the cam, its centre near t in the cam.
        direction = np.angle(place[0] / self._reference) + cmath.phase(self._reference)
        lead = np.angle(at.center * np.exp(-1j * t))
        cam = self.sense * (direction - t - lead), self.sense * (there[0] - here[0]), self.sense * (there[1] - here[1])
        return Follower(value, cam, way)

    @cached_property
    def _reference(self) -> complex:
        """Where the roller's centre stands while the profile's angle 0 touches it [mm]."""
        return complex(self._placed(self.contact(np.zeros(1)))[1][0][0])

    def _placed(self, at: Contact) -> tuple[tuple[Reals, Reals, Reals], list[Points], Points]:
        """Coordinate of the follower, centre of the roller with derivatives, and direction of its way."""
        q = np.abs(at.center) ** 2
        q1 = 2.0 * (np.conj(at.center) * at.first).real
        q2 = 2.0 * (np.abs(at.first) ** 2 + (np.conj(at.center) * at.second).real)
        return self._on_slide(q, q1, q2) if self.pivot is None else self._on_rocker(self.pivot, q, q1, q2)

    def _on_slide(self, q: Reals, q1: Reals, q2: Reals) -> tuple[tuple[Reals, Reals, Reals], list[Points], Points]:
        square = q - self.offset**2
        if np.min(square) <= 0.0:
            least = math.sqrt(float(np.min(q)))
            raise NoSolution(
                f"distance of the line of travel from the cam axis: {unlike(abs(self.offset), least)} mm (limit < "
                f"{unlike(least, abs(self.offset))} mm, the minimum radius of the roller's centre)",
                key="follower.offset",
                fix=f"set follower.offset below {safely_below(least)} mm",
            )
        y = np.sqrt(square)
        y1 = 0.5 * q1 / y
        y2 = (0.5 * q2 - y1 * y1) / y
        u = self.direction
        return (
            (y, y1, y2),
            [np.asarray(u * each) for each in (y - 1j * self.offset, y1, y2)],
            np.full_like(y, u, dtype=np.complex128),
        )

    def _on_rocker(
        self, pivot: complex, q: Reals, q1: Reals, q2: Reals
    ) -> tuple[tuple[Reals, Reals, Reals], list[Points], Points]:
        f, l = abs(pivot), self.arm  # noqa: E741
        c = (q - f * f - l * l) / (2.0 * f * l)
        if np.max(np.abs(c)) >= 1.0:
            low, high = math.sqrt(float(np.min(q))), math.sqrt(float(np.max(q)))
            raise NoSolution(
                f"distance of the roller's centre from the cam axis: {short(low)} to {short(high)} mm (reach of the "
                "arm "
                f"{within(abs(f - l), f + l, 'mm')})",
                key="follower.arm",
                fix="check pivot, arm and roller_radius against the machine",
            )
        c1, c2, root = q1 / (2.0 * f * l), q2 / (2.0 * f * l), np.sqrt((1.0 - c) * (1.0 + c))
        angle = cmath.phase(pivot) + self.side * np.arccos(c)
        first = -self.side * c1 / root
        second = -self.side * (c2 / root + c * c1 * c1 / root**3)
        arm = l * np.exp(1j * angle)
        place = [pivot + arm, 1j * first * arm, (1j * second - first * first) * arm]
        return (angle, first, second), place, 1j * arm / l

    @cached_property
    def _grid(self) -> tuple[Reals, Reals]:
        """Close places on the profile in the order of the cam angle, and that angle over a revolution."""
        count = 16 * self.series.cosines.size + 720
        t = -self.sense * np.linspace(0.0, TURN, count + 1)
        found = self.follower(t)
        rate = -self.sense * found.cam_angle[1]
        if np.min(rate) <= 0.0:
            worst = math.degrees(float(np.mod(t[int(np.argmin(rate))], TURN)))
            raise NoSolution(
                f"undercut or noise: the cam angle turns back at {worst:.4g} deg of the profile",
                key="profile",
                fix="lower harmonics, or check roller_radius",
            )
        return t, found.cam_angle[0]

    def at_cam_angle(self, phi: Reals) -> Reals:
        """The place t on the profile that the roller touches at cam angles [rad], by Newton's steps.

        Raises
            NoSolution - where the cam angle turns back along the profile or is not found on it, at the key `profile`
        """
        grid, angle = self._grid
        last = math.inf
        turned = angle[0] + np.mod(phi - angle[0], TURN)
        t = np.asarray(np.interp(turned, angle, grid), dtype=np.float64)
        for _ in range(_STEPS):
            found = self.follower(t)
            off = found.cam_angle[0] - turned
            off = off - TURN * np.round(off / TURN)
            t = t - off / found.cam_angle[1]
            most = float(np.max(np.abs(off), initial=0.0))
            if most <= _EXACT or last <= most <= _SETTLED:  # what is left is rounding
                return np.asarray(t)
            last = most
        raise NoSolution(
            f"no point of the profile to the cam angle, {math.degrees(last):.3g} deg missed",
            key="profile",
            fix="lower harmonics, or check the points",
        )

    def motion(self, phi: Reals) -> tuple[Reals, Reals, Reals]:
        """Coordinate of the follower and its derivatives by the cam angle [rad or mm]."""
        found = self.follower(self.at_cam_angle(phi))
        value, first, second = found.value
        speed = first / found.cam_angle[1]
        return value, speed, (second - speed * found.cam_angle[2]) / found.cam_angle[1] ** 2

    def pressure_angle(self, t: Reals) -> Reals:
        """Angle between the normal of the profile and the way of the roller [rad], without sign."""
        found, at = self.follower(t), self.contact(t)
        normal = at.normal * np.exp(1j * self.sense * found.cam_angle[0])
        along = np.conj(found.way) * normal
        return np.asarray(np.arctan2(np.abs(along.imag), np.abs(along.real)))

    def curvature(self, t: Reals) -> Reals:
        """Curvature of the pitch curve [1/mm], convex positive."""
        at = self.contact(t)
        return np.asarray((np.conj(at.first) * at.second).imag / np.abs(at.first) ** 3)


def _turned(place: Points, first: Points, second: Points) -> tuple[Reals, Reals]:
    """First two derivatives of the direction of a point."""
    square = np.abs(place) ** 2
    rate = np.asarray((np.conj(place) * first).imag / square)
    bend = (np.conj(place) * second).imag / square - 2.0 * rate * (np.conj(place) * first).real / square
    return rate, np.asarray(bend)


def places(points: Sequence[Sequence[float]]) -> tuple[Reals, Reals]:
    """Angles [rad] and radii [mm] of a measured profile."""
    angle, radius = np.array(points, dtype=np.float64).T
    return np.radians(angle), np.asarray(radius)


# What the motion is made of


class MeasuredPhase(NamedTuple):
    """A stretch of the cam angle [rad]; of a stroke the law that comes nearest, and by how much it misses.

    Fields
        start, end : float [rad] - the last phase may end beyond a revolution
        motion : str - rise, return, dwell
        law : str or None - None of a dwell
        deviation : float [rad or mm] - maximum; of a dwell half of its range
    """

    start: float
    end: float
    motion: str
    law: str | None
    deviation: float


def phases_of(value: Reals, tolerance: float) -> list[MeasuredPhase]:
    """Dwells and strokes of a motion over a revolution.

    Parameters
        value : (ROWS,) array [rad or mm] - the follower at equal steps of the cam angle
        tolerance : float - range of it within a dwell
    Notes
        A dwell is at least 10 deg long. A stroke between dwells is taken from one level to the other and its ends are
        fitted, for within the tolerance the eye cannot tell where it begins. Where the motion only turns round, the
        stroke ends at that place.
    Source
        own derivation
    """
    count, dwells = value.size, _dwells(value, tolerance)
    if not dwells:
        turns = _turning(value, -1, count)
        cuts = [*turns, turns[0] + count] if turns else []
        return sorted(_stroke(value, a, b, *value[[a % count, b % count]].tolist()) for a, b in pairwise(cuts))
    inside = [value[np.arange(start, start + length) % count] for start, length in dwells]
    levels = [float(np.median(each)) for each in inside]
    found: list[list[MeasuredPhase]] = []
    for k, (start, length) in enumerate(dwells):
        after = (k + 1) % len(dwells)
        first, last = start + length - 1, dwells[after][0] + (count if after <= k else 0)
        cuts = [first, *_turning(value, first, last), last]
        heights = [levels[k], *(float(value[i % count]) for i in cuts[1:-1]), levels[after]]
        pairs = zip(pairwise(cuts), pairwise(heights), strict=True)
        found.append(
            [
                _stroke(value, *ends, *rise, free=(ends[0] == first, ends[1] == last))
                for ends, rise in pairs
                if ends[1] - ends[0] > 1
            ]
        )
    strokes = [each for between in found for each in between]
    for k, each in enumerate(inside):
        start, length = dwells[k]
        begin = found[k - 1][-1].end if found[k - 1] else start * TURN / count
        end = found[k][0].start if found[k] else (start + length) * TURN / count
        half = 0.5 * float(each.max() - each.min())
        strokes.append(_within(MeasuredPhase(begin, begin + (end - begin) % TURN or TURN, "dwell", None, half)))
    return sorted(map(_within, strokes))


def _within(phase: MeasuredPhase) -> MeasuredPhase:
    """The phase with its start in the first turn."""
    turns = TURN * math.floor(phase.start / TURN)
    return phase._replace(start=phase.start - turns, end=phase.end - turns)


def _dwells(value: Reals, tolerance: float) -> list[tuple[int, int]]:
    """First place and number of places of the dwells, in their order; the longest are taken first."""
    count = value.size
    twice = np.concatenate([value, value])
    lengths = np.zeros(count, dtype=int)
    high = np.array(twice[:count])
    low = np.array(twice[:count])
    open_ = np.ones(count, dtype=bool)
    for step in range(1, count + 1):
        lengths[open_] = step
        if step == count:
            break
        now = twice[step : step + count]
        high, low = np.maximum(high, now), np.minimum(low, now)
        open_ &= high - low <= tolerance
        if not open_.any():
            break
    free, found = np.ones(count, dtype=bool), []
    for start in np.argsort(-lengths, kind="stable").tolist():
        length = int(lengths[start])
        if length * TURN / count < _SHORTEST_DWELL:
            break
        inside = np.arange(start, start + length) % count
        if free[inside].all():
            free[inside] = False
            found.append((start, length))
    return sorted(found)


def _turning(value: Reals, first: int, last: int) -> list[int]:
    """Places between two others, or in a revolution, at which the motion turns round."""
    count, found = value.size, []
    size = float(value.max() - value.min())
    for k in range(first + 1, last):
        before, now, after = (float(value[i % count]) for i in (k - 1, k, k + 1))
        if (now - before) * (after - now) < 0.0 or (now - before != 0.0 and after == now):
            near = value[np.arange(k - 12, k + 13) % count]  # 3 deg to either side: no ripple of the points
            if now in (near.max(), near.min()) and size > 0.0:
                found.append(k)
    return found


def _stroke(
    value: Reals, first: int, last: int, low: float, high: float, free: tuple[bool, bool] = (False, False)
) -> MeasuredPhase:
    """The stroke between two places and levels, by the law that comes nearest; those of its ends that are free move."""
    count = value.size
    x = np.arange(first, last + 1)
    s, step = value[x % count], TURN / count
    motion, height = "rise" if high > low else "return", high - low
    best = MeasuredPhase(first * step, last * step, motion, None, math.inf)
    share = (s - low) / height if height else np.zeros_like(s)
    for name in REST_TO_REST:
        start, end, off = _fitted(name, np.asarray(x * step, dtype=np.float64), share, free)
        if abs(height) * off < best.deviation:
            best = MeasuredPhase(start, end, motion, name, abs(height) * off)
    return best


def _fitted(name: str, phi: Reals, share: Reals, free: tuple[bool, bool]) -> tuple[float, float, float]:
    """Ends of a law that bring it nearest to a stroke, by Gauss's and Newton's steps, and its maximum deviation."""
    named, moved = law(name), np.array(free, dtype=np.float64)

    def off(ends: Reals) -> tuple[Reals, Reals]:
        x = (phi - ends[0]) / (ends[1] - ends[0])
        moves = (x > 0.0) & (x < 1.0)
        s, v = named.evaluate(np.where(moves, x, 0.5), 1)
        at = np.where(moves, s, np.where(x >= 1.0, 1.0, 0.0))
        rate = np.where(moves, v, 0.0) / (ends[1] - ends[0])
        return at - share, np.array([-rate * (1.0 - x), -rate * x]).T * moved

    ends = np.array([phi[0], phi[-1]])
    residual, slopes = off(ends)
    for _ in range(_FIT_STEPS if any(free) else 0):
        change = np.linalg.lstsq(slopes, -residual, rcond=None)[0]
        tried = ends + change
        if not (tried[1] - tried[0] > _SHORTEST_STROKE and np.abs(change).max() < 0.5 * (phi[-1] - phi[0])):
            break
        after, slopes_there = off(tried)
        if not (after @ after) < (residual @ residual) * (1.0 - 1e-12):
            break
        ends, residual, slopes = tried, after, slopes_there
    return float(ends[0]), float(ends[1]), float(np.abs(residual).max())
