"""A measured cam: the fit of its series, the motion of its follower, and the dwells and strokes that it is made of.

With that motion it is a disc cam: figure, film, loads, tolerances and export are those of one.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from gearlink.core.base.design import Design, Outline, placed
from gearlink.core.base.errors import NoSolution
from gearlink.core.base.many_designs import column, hand_on, hand_out, sought, stacked, together
from gearlink.core.base.remedies.ways import REFUSAL
from gearlink.core.base.report import Remedy, Table, safely_below
from gearlink.core.base.results import cached_property, keep
from gearlink.core.base.wording import short, unlike, within
from gearlink.core.machines.disc_cam.cams import FollowerCams, Place
from gearlink.core.machines.disc_cam.design import Closing, DiscCamDesign, found_forces
from gearlink.core.numerics.arrays import Points, Reals, median, turn_degrees, unit_vector
from gearlink.core.numerics.extremes import Extreme, greatest, least_convex_radius, maximum_over, minimum_over
from gearlink.core.parts.cams.disc_cam import DiscCam
from gearlink.core.parts.cams.follower_design import in_time
from gearlink.core.parts.cams.follower_motion import Stroke
from gearlink.core.parts.cams.laws import REST_TO_REST, law

if TYPE_CHECKING:
    from gearlink.core.machines.disc_cam.measured_spec import MeasuredCamSpec


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
_FEWEST = 3
"""Harmonics below which a series has no rise and no dwell."""
_ALIKE = ("profile", "harmonics", "speed", "sense", "type", "side", "dwell_tolerance", "loads")
_TURNING = ("pivot", "direction")
_BEYOND = 0.1
"""Share of a stroke by which its ends may lie elsewhere in the designs of a study."""


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
            message = f"the points leave the profile open: gap of {widest:.4g} deg for {order} harmonics"
            raise NoSolution(message, key="harmonics", fix="reduce harmonics, or give points in the gap")
        return cls(np.append(found[0], found[1 : order + 1]), np.append(0.0, found[order + 1 :]))

    def at(self, t: Reals, order: int) -> list[Reals]:
        """Radius and its derivatives."""
        k = np.arange(self.cosines.size)
        turns = np.multiply.outer(t, k)
        a, b, of_each = self.cosines, self.sines, []
        for _ in range(order + 1):
            of_each.append((a, b))
            a, b = k * b, -k * a
        a, b = np.array(of_each).transpose(1, 2, 0)
        return list(np.moveaxis(np.cos(turns) @ a + np.sin(turns) @ b, -1, 0))


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
        return value if self.pivot is None else math.pi - self.side * (value - np.angle(self.pivot))

    def turned(self, other: MeasuredCam) -> tuple[MeasuredCam, float]:
        """It with its follower turned about the cam axis to where that of another stands, and by how much [rad]."""
        if self.pivot is None or other.pivot is None:
            return replace(self, direction=other.direction), cmath.phase(other.direction / self.direction)
        pivot = abs(self.pivot) / abs(other.pivot) * other.pivot
        return replace(self, pivot=pivot), cmath.phase(other.pivot / self.pivot)

    def contact(self, t: Reals) -> Contact:
        """R = C + r_g N with N = -i T, T = C'/|C'|, T' = i w T."""
        rho, d1, d2, d3 = self.series.at(t, 3)
        e = unit_vector(t)
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
        return self._touching(t, self.contact(t))

    def _touching(self, t: Reals, at: Contact) -> Follower:
        value, place, way = self._placed(at)
        there, here = _turned(*place), _turned(at.center, at.first, at.second)
        # Both are continuous over a revolution: the roller stays on one side of the cam, its centre near t in the cam.
        direction = np.angle(place[0] / self._reference) + np.angle(self._reference)
        lead = np.angle(at.center * np.exp(-1j * t))
        cam = self.sense * (direction - t - lead), self.sense * (there[0] - here[0]), self.sense * (there[1] - here[1])
        return Follower(value, cam, way)

    @cached_property
    def _reference(self) -> Points:
        """Where the roller's centre stands while the profile's angle 0 touches it [mm]."""
        return self._placed(self.contact(np.zeros(1)))[1][0]

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
        place = [np.asarray(u * each) for each in (y - 1j * self.offset, y1, y2)]
        return (y, y1, y2), place, np.full_like(y, u, dtype=np.complex128)

    def _on_rocker(
        self, pivot: complex, q: Reals, q1: Reals, q2: Reals
    ) -> tuple[tuple[Reals, Reals, Reals], list[Points], Points]:
        f, l = abs(pivot), self.arm  # noqa: E741
        c = (q - f * f - l * l) / (2.0 * f * l)
        if np.max(np.abs(c)) >= 1.0:
            low, high = math.sqrt(float(np.min(q))), math.sqrt(float(np.max(q)))
            raise NoSolution(
                f"distance of the roller's centre from the cam axis: {short(low)} to {short(high)} mm (reach of the "
                f"arm {within(abs(f - l), f + l, 'mm')})",
                key="follower.arm",
                fix="check pivot, arm and roller_radius against the machine",
            )
        c1, c2, root = q1 / (2.0 * f * l), q2 / (2.0 * f * l), np.sqrt((1.0 - c) * (1.0 + c))
        angle = np.angle(pivot) + self.side * np.arccos(c)
        first = -self.side * c1 / root
        second = -self.side * (c2 / root + c * c1 * c1 / root**3)
        arm = l * unit_vector(angle)
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
            message = f"undercut or noise: the cam angle turns back at {worst:.4g} deg of the profile"
            raise NoSolution(message, key="profile", fix="reduce harmonics, or check roller_radius")
        return t, found.cam_angle[0]

    def at_cam_angle(self, phi: Reals) -> Reals:
        """The place t on the profile that the roller touches at cam angles [rad], by Newton's steps.

        Raises
            NoSolution - where the cam angle turns back along the profile or is not found on it, at the key `profile`
        """
        grid, angle = self._grid
        last = math.inf
        first = angle[..., :1] if angle.ndim > 1 else angle[0]
        turned = first + np.mod(phi - first, TURN)
        if angle.ndim > 1:
            t = np.array([np.interp(turned[k], row, grid) for k, row in enumerate(angle)])
        else:
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
        message = f"no point of the profile to the cam angle, {math.degrees(last):.3g} deg missed"
        raise NoSolution(message, key="profile", fix="reduce harmonics, or check the points")

    def motion(self, phi: Reals) -> tuple[Reals, Reals, Reals]:
        """Coordinate of the follower and its derivatives by the cam angle [rad or mm]."""
        return self.over_profile(self.at_cam_angle(phi))

    def over_profile(self, t: Reals) -> tuple[Reals, Reals, Reals]:
        """The same at places t on the profile."""
        found = self.follower(t)
        value, first, second = found.value
        speed = first / found.cam_angle[1]
        return value, speed, (second - speed * found.cam_angle[2]) / found.cam_angle[1] ** 2

    def pressure_angle(self, t: Reals) -> Reals:
        """Angle between the normal of the profile and the way of the roller [rad], without sign."""
        at = self.contact(t)
        found = self._touching(t, at)
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
    levels = [median(each) for each in inside]
    found: list[list[MeasuredPhase]] = []
    for k, (start, length) in enumerate(dwells):
        after = (k + 1) % len(dwells)
        first, last = start + length - 1, dwells[after][0] + (count if after <= k else 0)
        cuts = [first, *_turning(value, first, last), last]
        heights = [levels[k], *(float(value[i % count]) for i in cuts[1:-1]), levels[after]]
        pairs = zip(pairwise(cuts), pairwise(heights), strict=True)
        inner = [(ends, rise) for ends, rise in pairs if ends[1] - ends[0] > 1]
        found.append([_stroke(value, a, b, *rise, free=(a == first, b == last)) for (a, b), rise in inner])
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
    lengths, high, low = np.zeros(count, dtype=int), np.array(value), np.array(value)
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


QUANTITIES = (
    "swing",
    "stroke",
    "fit_rms",
    "fit_max",
    "fit_harmonics",
    "min_curvature_radius",
    "min_curvature_radius_at",
    "max_pressure_angle",
    "max_pressure_angle_at",
    "pressure_angle_rise",
    "pressure_angle_return",
    "prime_radius",
    "max_radius",
    "min_radius",
    "follower_velocity_max",
    "follower_acceleration_max",
    "spring_preload",
    "lift_off_speed",
)
_CHECKS = ("pressure-angle", "cam-undercut", "shaft-clearance", "outer-wall", "lift-off")
_SENSES = {"rise": 1, "dwell": 0, "return": -1}


class MeasuredMotion:
    """The lift over a revolution of the cam, as that of a disc cam, to its second derivative."""

    joints: tuple[float, ...] = ()
    highest = 2
    """Points of a profile have no third derivative that means something."""

    def __init__(self, design: MeasuredCamDesign) -> None:
        self.design, self.cam = design, design.cam

    def evaluate(self, phi: Reals, order: int = 2, *, side: int = 1) -> list[Reals]:
        """Lift and its derivatives by the cam angle [mm or rad]; `side` is for laws that jump."""
        del side
        return _lift(self.cam, self.cam.motion(phi), self.design.least)[: order + 1]

    @cached_property
    def whole(self) -> list[Stroke]:
        """Where the lift rises, falls and stands; the last may run over the end of the revolution.

        Notes
            The ends of the phases are fitted and may miss each other a little: strokes meet in the middle of that.
        """
        phases, outward = self.design.phases, round(self.cam.outward_sense)
        beside = zip(phases, [*phases[1:], *phases[:1]], strict=True)
        apart = [(after.start - before.end + math.pi) % TURN - math.pi for before, after in beside]
        return [
            Stroke(each.start - 0.5 * apart[k - 1], each.end + 0.5 * apart[k], _SENSES[each.motion] * outward)
            for k, each in enumerate(phases)
        ]

    @cached_property
    def strokes(self) -> tuple[Stroke, ...]:
        """The same within a revolution: what runs over its end in two parts."""
        shifted = ((begin + off, end + off, sense) for begin, end, sense in self.whole for off in (-TURN, 0.0, TURN))
        found = (Stroke(max(begin, 0.0), min(end, TURN), sense) for begin, end, sense in shifted)
        return tuple(sorted(each for each in found if each.end > each.start))


class OverProfile:
    """That lift over the places t on the profile instead of the cam angle: its extremes need no Newton's steps."""

    joints: tuple[float, ...] = ()

    def __init__(self, cam: MeasuredCam, least: Any) -> None:
        self.cam, self.least = cam, least

    def evaluate(self, t: Reals, order: int = 2) -> list[Reals]:
        """Lift and its derivatives by the cam angle [mm or rad]."""
        return _lift(self.cam, self.cam.over_profile(t), self.least)[: order + 1]


def _lift(cam: MeasuredCam, rates: Sequence[Reals], least: Any) -> list[Reals]:
    """Lift and its derivatives from the coordinate of the follower and its own, outward [mm or rad]."""
    value, *others = rates
    return [cam.outward(value) - least, *(cam.outward_sense * rate for rate in others)]


class MeasuredClosing(Closing):
    """Forces along the lift of a file without forces of its own over the cam angle."""

    def __init__(self, design: MeasuredCamDesign) -> None:
        super().__init__(design.spec, SimpleNamespace(motion=OverProfile(design.cam, design.least)))  # type: ignore[arg-type]
        self.design = design

    def _most(self, course: Callable[[Reals], Reals]) -> Extreme:
        return maximum_over(course, samples=self.design.samples)

    @property
    def unloading(self) -> Extreme | None:
        """As of any cam, at its cam angle."""
        found = super().unloading
        return None if found is None else found._replace(place=self.design.cam_angle(found.place))


class MeasuredCams(FollowerCams):
    """Motion, place and cam of a measured profile."""

    spec: Any

    def __init__(self, design: MeasuredCamDesign) -> None:
        self.design, self.spec, self.sense = design, design.spec, design.spec.sense

    @cached_property
    def follower(self) -> Any:
        """The follower as that of a disc cam."""
        return self.spec.disc_follower

    @cached_property
    def motion(self) -> Any:
        return MeasuredMotion(self.design)

    @cached_property
    def main(self) -> DiscCam:
        """The cam of the roller; its extremes are sought over the profile."""
        found, design = super().main, self.design
        sharp, (near, far) = design.sharpest, design.reach
        known = {"max_radius": far - found.roller_radius, "min_radius": near - found.roller_radius}
        known["star_shaped"] = design.star_shaped
        if math.isfinite(sharp.value):
            keep(found, most_convex=Extreme(1.0 / sharp.value, design.cam_angle(sharp.place)))
        keep(found, **known, max_pressure_angle=design.steepest._replace(place=design.max_pressure_angle_at))
        return found

    def _most_in_strokes(self, sense: int) -> float | None:
        found = [each.value for each in self.steepest_of(sense)]
        return greatest(found) if found else None

    def steepest_of(self, sense: int, beyond: float = 0.0) -> list[Extreme]:
        """Maximum pressure angle of each stroke, over the stretch of the profile that it touches; places in its share.

        Parameters
            sense : of strokes
            beyond : share of a stroke - by how much farther is looked to either side
        """
        cam, found = self.design.cam, []
        for stroke in self.motion.whole:
            if stroke.sense == sense:
                t = cam.at_cam_angle(np.array([stroke.start, stroke.end]))
                start, length = t[..., :1], np.mod(-cam.sense * (t[..., 1:] - t[..., :1]), TURN)
                length = np.where(length <= 0.0, TURN, length)
                samples = max(33, math.ceil(self.design.samples * (stroke.end - stroke.start) / TURN))

                def course(share: Reals, start: Reals = start, length: Reals = length) -> Reals:
                    return cam.pressure_angle(start - cam.sense * length * share)

                found.append(maximum_over(course, -beyond, 1.0 + beyond, samples=samples))
        return found

    @cached_property
    def place(self) -> Place:
        """The roller at lift 0, where it is nearest to the cam axis."""
        least, follower = self.design.least, self.follower
        if not self.spec.oscillates:
            return Place(math.hypot(least, follower.offset), follower.offset)
        f, l = follower.center_distance, follower.arm  # noqa: E741
        return Place(math.sqrt(f * f + l * l - 2.0 * f * l * math.cos(least)), 0.0, f, least)


class MeasuredCamDesign(DiscCamDesign):
    """A follower on a cam whose profile was measured."""

    kind = "measured-cam"
    spec: MeasuredCamSpec  # type: ignore[assignment]  # it has what a disc cam's has
    keys = {"analyze": ("swing", "stroke", "fit_rms", "fit_max", "max_pressure_angle", "min_curvature_radius")}
    outlines = {"analyze": Outline(QUANTITIES, _CHECKS, ("law", "phases"))}
    extra_tables = ("profile_fit", "main_cam", "radius")
    extreme_names = ()

    ways = Design.ways

    @property
    def cost(self) -> float:
        """A series is fitted, and followed round the turn: a tenth of a second, three where its follower jams."""
        return 60.0

    def candidates(self, check: str) -> Iterator[Remedy]:
        """Where the cam is refused, fewer harmonics, by a quarter each time: noise has many."""
        order = self.spec.order if check == REFUSAL else 0
        while (order := 3 * order // 4) >= _FEWEST:
            yield (("harmonics", order),)

    @classmethod
    def find_together(cls, designs: Sequence[Any], names: Sequence[str]) -> None:
        """Followers on one profile are sought together."""
        del names
        sought(_find_together, designs)

    @property
    def law_definitions(self) -> Mapping[str, Any]:
        """None: the motion is that of the profile."""
        return {}

    @cached_property
    def cams(self) -> MeasuredCams:
        """The cam as a disc cam."""
        return MeasuredCams(self)

    @cached_property
    def points(self) -> tuple[Reals, Reals]:
        """Angles [rad] and radii [mm] of the measured profile."""
        return places(self.spec.profile.points or ())

    @cached_property
    def cam(self) -> MeasuredCam:
        """Series and follower."""
        return self.cam_of(Series.fitted(*self.points, self.spec.order))

    def cam_of(self, series: Series) -> MeasuredCam:
        """The follower of the file on a profile."""
        spec, follower = self.spec, self.spec.follower
        if follower.type == "oscillating":
            pivot = complex(*follower.pivot)
            return MeasuredCam(series, spec.roller_radius, spec.sense, pivot, follower.arm, follower.side)
        direction = cmath.rect(1.0, math.radians(follower.direction))
        return MeasuredCam(series, spec.roller_radius, spec.sense, direction=direction, offset=follower.offset)

    # Quantities

    @cached_property
    def residuals(self) -> Reals:
        """Measured radii less those of the series [mm]."""
        t, radius = self.points
        return np.asarray(radius - self.cam.series.at(t, 0)[0])

    @property
    def fit_rms(self) -> float:
        """Root of the mean square of what the series leaves [mm]."""
        return math.sqrt(float((self.residuals**2).mean()))

    @property
    def fit_max(self) -> float:
        """Maximum of it [mm]."""
        return float(abs(self.residuals).max())

    fit_harmonics: int = placed("spec.order")

    @cached_property
    def span(self) -> tuple[float, float]:
        """Minimum and maximum coordinate of the follower [rad or mm]."""
        self.require_runs()
        return self._ends(lambda t: self.cam.follower(t).value[0])

    def _ends(self, course: Callable[[Reals], Reals]) -> tuple[float, float]:
        return minimum_over(course, samples=self.samples).value, maximum_over(course, samples=self.samples).value

    @cached_property
    def least(self) -> float:
        """Minimum coordinate outward, that of lift 0 [rad or mm]."""
        return float(min(self.cam.outward(value) for value in self.span))

    @property
    def samples(self) -> int:
        """Places of a revolution that show each harmonic."""
        return 16 * self.spec.order + 512

    def require_runs(self) -> None:
        """Refuse a profile along which the cam angle turns back."""
        self.cam.at_cam_angle(np.zeros(1))

    @property
    def swing(self) -> float | None:
        """Swing of an oscillating follower [rad]."""
        return self.span[1] - self.span[0] if self.spec.oscillates else None

    @property
    def stroke(self) -> float | None:
        """Stroke of a translating follower [mm]."""
        return None if self.spec.oscillates else self.span[1] - self.span[0]

    @cached_property
    def sharpest(self) -> Extreme:
        """Minimum convex radius of the pitch curve [mm] and its place on the profile [rad]."""
        self.require_runs()
        return least_convex_radius(self.cam.curvature, samples=self.samples)

    @cached_property
    def steepest(self) -> Extreme:
        """Maximum pressure angle [rad] and its place on the profile [rad]."""
        self.require_runs()
        return maximum_over(self.cam.pressure_angle, samples=self.samples)

    @cached_property
    def rates(self) -> tuple[float, float]:
        """Maximum magnitude of velocity and acceleration by the cam angle [mm or rad]."""
        self.require_runs()
        first, second = (partial(lambda k, t: np.abs(self.cam.over_profile(t)[k]), k) for k in (1, 2))
        return maximum_over(first, samples=self.samples).value, maximum_over(second, samples=self.samples).value

    @cached_property
    def reach(self) -> tuple[float, float]:
        """Minimum and maximum distance of the roller's centre from the cam axis [mm]."""
        return self._ends(lambda t: np.abs(self.cam.contact(t).center))

    @cached_property
    def star_shaped(self) -> bool:
        """Whether the series has a radius at every angle, as the points have."""
        return bool(np.all(self.cam.series.at(np.linspace(0.0, TURN, self.samples), 0)[0] > 0.0))

    @cached_property
    def closing(self) -> Closing:
        return super().closing if self.spec.loads is not None else MeasuredClosing(self)

    @property
    def min_curvature_radius(self) -> float | None:
        """Minimum convex radius of the pitch curve [mm]; None where it is convex nowhere."""
        return self.sharpest.value if math.isfinite(self.sharpest.value) else None

    @property
    def min_curvature_radius_at(self) -> float:
        """Cam angle of it [rad]."""
        return self.cam_angle(self.sharpest.place)

    @property
    def max_pressure_angle(self) -> float:
        return self.steepest.value

    @property
    def max_pressure_angle_at(self) -> float:
        """Cam angle of it [rad]."""
        return self.cam_angle(self.steepest.place)

    def cam_angle(self, t: float) -> float:
        """Cam angle at which a place on the profile is touched [rad]."""
        return float(np.mod(self.cam.follower(np.array([t])).cam_angle[0][0], TURN))

    follower_velocity_max: float | None = in_time(lambda design: design.rates[0], 1)
    follower_acceleration_max: float | None = in_time(lambda design: design.rates[1], 2)

    @cached_property
    def phases(self) -> list[MeasuredPhase]:
        """Dwells and strokes."""
        value = self.cam.motion(np.linspace(0.0, TURN, ROWS, endpoint=False))[0]
        tolerance = self.spec.dwell_tolerance
        return phases_of(value, math.radians(tolerance) if self.spec.oscillates else tolerance)

    # Tables

    def table_law(self, samples: int | None = None) -> Table:
        """The follower over the cam angle, and what the series leaves of the points that touch it there."""
        degrees = turn_degrees(samples)
        phi = np.asarray(np.radians(degrees), dtype=np.float64)
        value, speed, acceleration = self.cam.motion(phi)
        if self.spec.oscillates:
            columns = {"cam_angle": (degrees, "deg"), "follower_angle": (np.degrees(value), "deg")}
            units = ("rad/rad", "rad/rad^2")
        else:
            columns = {"cam_angle": (degrees, "deg"), "lift": (value - self.span[0], "mm")}
            units = ("mm/rad", "mm/rad^2")
        t, left = self.points[0], self.residuals
        residual = np.interp(np.mod(self.cam.at_cam_angle(phi), TURN), np.mod(t, TURN), left, period=TURN)
        rates = {"velocity": (speed, units[0]), "acceleration": (acceleration, units[1]), "residual": (residual, "mm")}
        return Table.of("law", columns | rates)

    def table_phases(self, _samples: int | None = None) -> Table:
        """Dwells and strokes over the cam angle, with the law that comes nearest to each stroke."""
        unit = "deg" if self.spec.oscillates else "mm"
        scale = math.degrees(1.0) if self.spec.oscillates else 1.0
        columns: dict[str, tuple[list[Any], str]] = {
            "start": ([math.degrees(each.start) for each in self.phases], "deg"),
            "end": ([math.degrees(each.end) for each in self.phases], "deg"),
            "motion": ([each.motion for each in self.phases], "1"),
            "law": ([each.law for each in self.phases], "1"),
            "deviation": ([scale * each.deviation for each in self.phases], unit),
        }
        return Table.of("phases", columns)

    def table_profile_fit(self, _samples: int | None = None) -> Table:
        """The points, the series at their angles, and the difference."""
        t, radius = self.points
        columns = {
            "profile_angle": (np.degrees(t), "deg"),
            "radius": (radius, "mm"),
            "fitted_radius": (radius - self.residuals, "mm"),
            "residual": (self.residuals, "mm"),
        }
        return Table.of("profile_fit", columns)


def _find_together(designs: Sequence[MeasuredCamDesign]) -> None:
    """Followers on one profile, turned to where that of the first stands; the strokes are those of the first."""
    first = designs[0]
    follower = {key: getattr(first.spec.follower, key) for key in _TURNING if hasattr(first.spec.follower, key)}
    specs = [one.spec.model_copy(update={"follower": one.spec.follower.model_copy(update=follower)}) for one in designs]
    many = type(first)(together(specs, _ALIKE))  # before anything is kept: designs of other profiles are unlike
    for design in designs:
        keep(design, cam=design.cam_of(first.cam.series), residuals=first.residuals)
    cams, turns = zip(*(design.cam.turned(first.cam) for design in designs), strict=True)
    keep(many, cam=stacked(cams), residuals=first.residuals)
    hand_out(many, designs, "span", "sharpest", "steepest", "rates", "reach", "star_shaped")
    for design, turn in zip(designs, turns, strict=True):
        if turn and design.spec.oscillates:
            keep(design, span=tuple(value - turn for value in design.span))
    keep(many, least=column([design.least for design in designs]), phases=first.phases)
    _find_strokes(many.cams, [one.cams for one in designs])
    if first.spec.loads is None or not any(turns):  # loads act at cam angles, and gravity along the travel
        found_forces(many, designs)


def _find_strokes(many: MeasuredCams, cams: Sequence[MeasuredCams]) -> None:
    """Pressure angles of the strokes, where these may begin and end elsewhere and have the same."""
    count = len(cams)
    for sense, name in ((1, "steepest_rise"), (-1, "steepest_return")):
        found = many.steepest_of(sense, _BEYOND)
        if not found:
            hand_on(cams, **{name: None})
            continue
        values, places = (
            np.array([np.broadcast_to(np.ravel(part), count) for part in parts]) for parts in zip(*found, strict=True)
        )
        best = values.argmax(axis=0), np.arange(count)
        if not np.all(abs(places[best] - 0.5) < 0.5 - _BEYOND):
            return
        hand_on(cams, **{name: values[best]})
    hand_out(many, cams, "steepest_dwell")
