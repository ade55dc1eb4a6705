"""Smallest cams for limits of pressure angle and curvature radius: cam centres of rocking arms, and closed forms.

Angles in rad, lengths in mm; eps is the sense of the cam, ' is by the cam angle.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import combinations
from typing import NamedTuple, TypeAlias

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.numerics.arrays import Points, Reals
from gearlink.core.numerics.extremes import TURN, greatest, maximum_over, minimum_over
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.parts.cams.follower_motion import FollowerMotion

# Cutting planes converge quadratically; the example of the swing gripper takes four rounds.
_ROUNDS = 60
_PLACES = 2049


@dataclass(frozen=True, slots=True)
class RockingRoller:
    """A roller on a rocking arm, and its law.

    Attributes
        law : function of cam angles [rad] - returns psi [rad] and psi' of the arm
        pivot, arm : complex, float [mm] - A and l, in any frame
        side : +1 where the cam lies on the left of the arm (seen from the pivot to the roller), -1 on the right
    """

    law: Callable[[Reals], tuple[Reals, Reals]]
    pivot: complex
    arm: float
    side: int


def smallest_cam_of_rollers(
    rollers: Sequence[RockingRoller],
    max_pressure_angle: float,
    *,
    sense: int,
    joints: Sequence[float] = (),
    refined: bool = True,
    strokes: Sequence[tuple[float, float, float]] = (),
) -> complex:
    """Cam centre nearest to the first roller at which every roller of a cam shaft keeps a pressure-angle limit.

    z = (O - A) e^(-i psi) - l (1 - eps psi');  side (Im z tan alpha_max +- Re z) >= 0 for every cam angle and roller

    Parameters
        rollers : sequence of RockingRoller - in one frame; the first one's prime circle is made smallest
        max_pressure_angle : float [rad] - in (0, pi/2), for either sign
        sense : +1 or -1 - eps
        joints : floats [rad] - ends of the phases of the law
        refined : bool - False looks at 2048 cam angles alone: limits are met to about 1e-6, ten times as fast
        strokes : start, end and limit of each stroke [rad] - instead of one limit for all cam angles
    Returns
        center : complex [mm] - O, in the frame of the rollers
    Raises
        NoSolution - limit outside 0 to 90 deg; no centre keeps it
    Notes
        Two cams on one shaft share O. The limits are half-planes in O; their intersection is convex, and its point
        nearest to the roller is found by cutting planes, each refined to the cam angle of the largest violation:
        exact to rounding.
    Example
        >>> first = RockingRoller(lambda phi: (0.0 * phi, 0.0 * phi), 0j, 100.0, 1)
        >>> second = RockingRoller(lambda phi: (0.0 * phi + 1.5, 0.0 * phi), 0j, 100.0, -1)
        >>> center = smallest_cam_of_rollers([first, second], math.radians(30.0), sense=1)
        >>> round(abs(100.0 - center), 6)
        30.67862

    Source
        own derivation: tan alpha = -Re z/Im z
    """
    families: list[Callable[[complex], _Violation]] = []
    for start, end, limit in strokes or [(0.0, TURN, max_pressure_angle)]:
        if not 0.0 < limit < math.pi / 2.0:
            raise NoSolution(f"pressure angle: {math.degrees(limit):g} deg (above 0, below 90 deg; usual 30 deg)")
        slope = math.tan(limit)
        inner = [joint for joint in joints if start < joint < end] if strokes else joints
        for planes in (partial(_rocker_planes, roller, slope, sense, sign) for roller in rollers for sign in (1, -1)):
            if refined:
                families.append(partial(_largest_violation, planes, start, end, inner))
            else:
                families.append(partial(_largest_of, *planes(np.linspace(start, end, _PLACES))))
    target = complex(rollers[0].pivot + rollers[0].arm * np.exp(1j * rollers[0].law(np.array([0.0]))[0][0]))
    return _nearest_admissible(families, target, max_pressure_angle)


def _rocker_planes(roller: RockingRoller, slope: float, sense: int, sign: int, phi: Reals) -> tuple[Points, Reals]:
    psi, psi1 = roller.law(phi)
    # side (Im z tan a + sign Re z) = Re(conj(n0) z) with n0 = side (sign + i tan a); sign +1 is the upper limit
    local = complex(roller.side * sign, roller.side * slope) / math.hypot(1.0, slope)
    normal: Points = local * np.exp(1j * psi)
    reach = roller.arm * (1.0 - sense * psi1) * local.real
    return normal, (np.conj(normal) * roller.pivot).real + reach


_Planes: TypeAlias = Callable[[Reals], tuple[Points, Reals]]
_Violation: TypeAlias = tuple[float, tuple[complex, float]]


def _nearest_admissible(
    families: Sequence[Callable[[complex], _Violation]], target: complex, max_pressure_angle: float
) -> complex:
    """Point nearest to the target with Re(conj(n) p) >= c for every family of planes, by cutting planes."""
    cuts: list[tuple[complex, float]] = []
    point, scale = target, 1.0
    for _ in range(_ROUNDS):
        worst = [largest(point) for largest in families]
        scale = max(scale, abs(point), *(abs(cut[1]) for _, cut in worst))
        if max(violation for violation, _ in worst) <= 1e-13 * scale:
            return point
        cuts = [*cuts, *(cut for violation, cut in worst if violation > -1e-6 * scale)]
        point = _nearest_point(cuts, target, scale)
    message = f"a pressure angle of {math.degrees(max_pressure_angle):g} deg does not determine the smallest cam"
    raise NoSolution(message, fix="increase the pressure angle of cam.size slightly")


def _largest_of(normal: Points, limit: Reals, point: complex) -> _Violation:
    """How far the most violated of some planes is, and the plane."""
    short = limit - (np.conj(normal) * point).real
    i = int(np.argmax(short))
    return float(short[i]), (complex(normal[i]), float(limit[i]))


def _largest_violation(
    planes: _Planes, start: float, end: float, joints: Sequence[float], point: complex
) -> _Violation:
    def violation(phi: Reals) -> Reals:
        normal, limit = planes(phi)
        short: Reals = limit - (np.conj(normal) * point).real
        return short

    top = maximum_over(violation, start, end, joints=joints)
    normal, limit = planes(np.array([top.place]))
    return top.value, (complex(normal[0]), float(limit[0]))


def _nearest_point(cuts: list[tuple[complex, float]], target: complex, scale: float) -> complex:
    """Point of an intersection of half-planes nearest to a target: a foot on one, or a corner of two."""
    normals, limits = np.array([n for n, _ in cuts]), np.array([c for _, c in cuts])
    short = limits - (np.conj(normals) * target).real
    candidates = [target, *(target + short * normals)]
    for i, j in combinations(range(len(cuts)), 2):
        cross = (normals[i].conjugate() * normals[j]).imag
        if abs(cross) > 1e-12:
            candidates.append(complex(1j * (limits[j] * normals[i] - limits[i] * normals[j]) / cross))
    points = np.array(candidates)
    missing = (limits[:, None] - (np.conj(normals)[:, None] * points[None, :]).real).max(axis=0)
    feasible = points[missing <= 1e-13 * scale]
    if feasible.size == 0:
        raise NoSolution(
            "no cam centre keeps the pressure angle within its limit over the whole revolution",
            fix="increase the limit of the pressure angle, lengthen the phases or reduce the swing",
        )
    return complex(feasible[int(np.argmin(np.abs(feasible - target)))])


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


def most_in_strokes(motion: FollowerMotion, courses: Sequence[Callable[[Reals], Reals]], sense: int) -> float | None:
    """Maximum value of courses over the strokes of one sense; None where there are none."""
    found = []
    for stroke in motion.strokes:
        if stroke.sense == sense:
            inner = [joint for joint in motion.joints if stroke.start < joint < stroke.end]
            samples = max(33, math.ceil(_SAMPLES * (stroke.end - stroke.start) / TURN))
            for course in courses:
                found.append(maximum_over(course, stroke.start, stroke.end, joints=inner, samples=samples).value)
    return greatest(found) if found else None


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

            if (height := most_in_strokes(motion, [course], stroke)) is not None:
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
    kept = (each for each in found if each.height >= height_at(lines, each.offset) - room)
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

            def beyond(phi: Reals, lower: bool, limit: float = limit) -> Reals:
                s, s1 = self.motion.evaluate(phi, 1)
                share = self.arm * (1.0 + self.side * self.sense * s1) * math.cos(limit) / self.distance
                if np.any(np.abs(share) > 1.0):  # one of the two sides cannot be
                    raise _nowhere()
                angle = np.arccos(share)
                return np.abs(angle - limit) - s if lower else s - angle - limit

            for found, lower in ((least, True), (most, False)):
                if (each := most_in_strokes(self.motion, [partial(beyond, lower=lower)], stroke)) is not None:
                    found.append(each)
        low, high = max(least), -max(most)
        if not low <= high * (1.0 + 1e-12) or high <= 0.0:
            raise _nowhere()
        return max(low, 0.0), high

    def prime_radius(self, start: float) -> float:
        """r_p of a start angle Psi_0 [mm]."""
        return math.sqrt(self.arm**2 + self.distance**2 - 2.0 * self.arm * self.distance * math.cos(start))


def _nowhere() -> NoSolution:
    fix = "increase cam.size.pressure_angle, or change follower.center_distance"
    return NoSolution("no cam meets this pressure angle at this center_distance", key="cam.size", fix=fix)


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
    fix = f"reduce {key}.curvature_radius, or lengthen the motion"
    raise NoSolution("no cam meets this curvature_radius here", key=key, fix=fix)


def flat_base_radius(motion: FollowerMotion, radius: float) -> float:
    """Base radius of a sliding flat face whose profile has a minimum curvature radius [mm]: R - min(s + s'')."""

    def course(phi: Reals) -> Reals:
        s, _, s2 = motion.evaluate(phi, 2)
        return s + s2

    return radius - minimum_over(course, joints=motion.joints, samples=_SAMPLES).value
