"""Minimum cams that keep a pressure angle and a curvature radius, for a given motion of the follower: closed forms.

Angles in rad, lengths in mm; eps is the sense of the cam, ' is by the cam angle.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import combinations
from typing import NamedTuple

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.extremes import maximum_over, minimum_over
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.parts.cams.follower_motion import TURN, FollowerMotion

Apart = Callable[[Reals], tuple[Reals, Reals]]
_SAMPLES = 512
_POLISH = 4
_INSIDE = 1e-12


class Line(NamedTuple):
    """A limit y0 >= height + slope e of the start height over the offset."""

    height: float
    slope: float


class Placed(NamedTuple):
    """A minimum cam of a translating roller: offset and start height [mm]."""

    offset: float
    height: float

    @property
    def prime_radius(self) -> float:
        """r_p = |(e, y0)| [mm]."""
        return math.hypot(self.offset, self.height)


def most_in_strokes(motion: FollowerMotion, course: Callable[[Reals], Reals], sense: int) -> float | None:
    """Maximum value of a course over the strokes of one sense; None where there are none."""
    found = []
    for stroke in motion.strokes:
        if stroke.sense == sense:
            inner = [joint for joint in motion.joints if stroke.start < joint < stroke.end]
            samples = max(33, math.ceil(_SAMPLES * (stroke.end - stroke.start) / TURN))
            found.append(maximum_over(course, stroke.start, stroke.end, joints=inner, samples=samples).value)
    return max(found, default=None)


def wedge(motion: FollowerMotion, limits: Sequence[float], sense: int) -> list[Line]:
    """The offsets and start heights that keep a pressure angle: y0 >= A - e/T, y0 >= B + e/T for each stroke.

    A = max(eps s'/T - s),  B = max(-eps s'/T - s),  T = tan alpha_max

    Parameters
        limits : (rise, return, dwell) [rad]
    Source
        own derivation from tan alpha = (eps s' - e)/(y0 + s); the hodograph of Flocke is its drawing
    """
    lines = []
    for stroke, limit in zip((1, -1, 0), limits, strict=True):
        slope = math.tan(limit)
        for sign in (1.0, -1.0):

            def course(phi: Reals, slope: float = slope, sign: float = sign) -> Reals:
                s, s1 = motion.evaluate(phi, 1)
                return sign * sense * s1 / slope - s

            if (height := most_in_strokes(motion, course, stroke)) is not None:
                lines.append(Line(height, -sign / slope))
    return lines


def nearest(lines: Sequence[Line]) -> Placed:
    """The point of a wedge that is nearest to the cam axis: a corner, or the foot of a perpendicular on one side."""
    found = [Placed(0.0, max(line.height for line in lines))]
    for line in lines:
        share = line.height / (1.0 + line.slope**2)
        found.append(Placed(-line.slope * share, share))
    for one, other in combinations(lines, 2):
        if one.slope != other.slope:
            offset = (one.height - other.height) / (other.slope - one.slope)
            found.append(Placed(offset, one.height + one.slope * offset))
    room = _INSIDE * max(abs(line.height) for line in lines)
    kept = [
        each for each in found if all(each.height >= line.height + line.slope * each.offset - room for line in lines)
    ]
    return min(kept, key=lambda each: each.prime_radius)


def height_at(lines: Sequence[Line], offset: float) -> float:
    """Minimum start height at an offset [mm]."""
    return max(line.height + line.slope * offset for line in lines)


def height_for_curvature(motion: FollowerMotion, radius: float, offset: float, sense: int) -> float:
    """Start height of a translating roller from which on no convex curvature radius is below a limit [mm].

    y0 = max (Y - s), Y the largest root of (y^2 + w^2)^(3/2) = R (y^2 - y s'' + w (w + s')), w = s' - eps e

    Raises
        NoSolution - no height is bound by it
    Source
        own derivation from the curvature of the pitch curve
    """

    def course(phi: Reals) -> Reals:
        s, s1, s2 = motion.evaluate(phi, 2)
        w = s1 - sense * offset
        return _largest_root(radius, s2, w * w, w * (w + s1)) - s

    return maximum_over(course, joints=motion.joints, samples=_SAMPLES).value


def _largest_root(radius: float, bend: Reals, square: Reals, rest: Reals) -> Reals:
    """Largest root of (y^2 + square)^(3/2) = R (y^2 - y bend + rest); 0 where there is none above."""
    scale = radius
    a, b, c = bend / scale, square / scale**2, rest / scale**2
    # (y^2 + b)^3 - (y^2 - a y + c)^2 = 0 in y/R
    powers = np.stack(
        [np.ones_like(a), 0.0 * a, 3.0 * b - 1.0, 2.0 * a, 3.0 * b * b - a * a - 2.0 * c, 2.0 * a * c, b**3 - c * c], -1
    )
    companion = np.zeros((a.size, 6, 6))
    companion[:, np.arange(1, 6), np.arange(5)] = 1.0
    companion[:, 0, :] = -powers[:, 1:]
    roots = np.linalg.eigvals(companion)
    real = np.where(np.abs(roots.imag) < 1e-6, roots.real, -np.inf)
    finite = np.where(np.isfinite(real), real, 0.0)
    real = np.where(finite * finite - a[:, None] * finite + c[:, None] > 0.0, real, -np.inf)
    y = real.max(axis=1)
    seen = y > 0.0
    y = np.where(seen, y, 1.0)
    for _ in range(_POLISH):
        value = (y * y + b) ** 1.5 - (y * y - a * y + c)
        slope = 3.0 * y * np.sqrt(y * y + b) - (2.0 * y - a)
        with np.errstate(all="ignore"):
            step = value / slope
        y = y - np.where(np.isfinite(step) & (np.abs(step) < 1e-3), step, 0.0)
    return np.where(seen, scale * y, 0.0)


class Rocking(NamedTuple):
    """A roller on a rocking arm whose pivot is given.

    Fields
        motion : FollowerMotion - lift in rad
        arm, distance : l, f [mm]
        sense, side : eps; +1 where the roller lies left of the vector cam axis -> pivot
    """

    motion: FollowerMotion
    arm: float
    distance: float
    sense: int
    side: int

    def start_angles(self, limits: Sequence[float]) -> tuple[float, float]:
        """Minimum and maximum angle Psi_0 that keep a pressure angle [rad].

        f cos(Psi + alpha) <= c cos alpha <= f cos(Psi - alpha),  c = l (1 + side eps s'),  Psi = Psi_0 + s:
        |arccos(c cos alpha/f) - alpha| <= Psi <= arccos(c cos alpha/f) + alpha

        Parameters
            limits : (rise, return, dwell) [rad]
        Raises
            NoSolution - no start angle keeps them
        Source
            own derivation from tan alpha = (f cos Psi - c)/(f sin Psi)
        """
        least: list[float] = []
        most: list[float] = []
        for stroke, limit in zip((1, -1, 0), limits, strict=True):

            def apart(phi: Reals, limit: float = limit) -> tuple[Reals, Reals]:
                s, s1 = self.motion.evaluate(phi, 1)
                share = self.arm * (1.0 + self.side * self.sense * s1) * math.cos(limit) / self.distance
                if np.any(np.abs(share) > 1.0):  # one of the two sides cannot be
                    raise _nowhere()
                return s, np.arccos(share)

            def lower(phi: Reals, limit: float = limit, apart: Apart = apart) -> Reals:
                s, angle = apart(phi)
                return np.abs(angle - limit) - s

            def upper(phi: Reals, limit: float = limit, apart: Apart = apart) -> Reals:
                s, angle = apart(phi)
                return s - angle - limit

            found = most_in_strokes(self.motion, lower, stroke), most_in_strokes(self.motion, upper, stroke)
            least += [each for each in found[:1] if each is not None]
            most += [-each for each in found[1:] if each is not None]
        low, high = max(least), min(most)
        if not low <= high * (1.0 + 1e-12) or high <= 0.0:
            raise _nowhere()
        return max(low, 0.0), high

    def prime_radius(self, start: float) -> float:
        """r_p of a start angle Psi_0 [mm]."""
        return math.sqrt(self.arm**2 + self.distance**2 - 2.0 * self.arm * self.distance * math.cos(start))


def _nowhere() -> NoSolution:
    message = "no cam keeps this pressure angle at this center_distance"
    return NoSolution(message, key="cam.size", fix="raise the limit, or move the pivot")


def first_from_which(least: Callable[[float], float], low: float, high: float, key: str, *, steps: int = 1) -> float:
    """The first value from which on a margin is not negative, between a low one and a high one.

    Parameters
        steps : int - between both, where the margin rises and falls again: of several the first that does
    Raises
        NoSolution - at the key, where none does
    """
    if least(low) >= 0.0:
        return low
    before = low
    for k in range(1, steps + 1):
        place = low + (high - low) * k / steps
        if least(place) >= 0.0:
            return bracketed_root(least, before, place)
        before = place
    raise NoSolution("no cam keeps this curvature_radius here", key=key, fix="lower it, or lengthen the motion")


def flat_base_radius(motion: FollowerMotion, radius: float) -> float:
    """Base radius of a sliding flat face whose profile has a minimum curvature radius [mm]: R - min(s + s'')."""

    def course(phi: Reals) -> Reals:
        s, _, s2 = motion.evaluate(phi, 2)
        return s + s2

    return radius - minimum_over(course, joints=motion.joints, samples=_SAMPLES).value
