"""Smallest cams for a pressure-angle limit: the cam centre that the rollers of rocking arms allow."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import combinations
from typing import TypeAlias

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.numerics.arrays import Points, Reals
from gearlink.core.numerics.extremes import TURN, maximum_over

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
) -> complex:
    """Cam centre nearest to the first roller at which every roller of a cam shaft keeps a pressure-angle limit.

    z = (O - A) e^(-i psi) - l (1 - eps psi');  side (Im z tan alpha_max +- Re z) >= 0 for every cam angle and roller

    Parameters
        rollers : sequence of RockingRoller - in one frame; the first one's prime circle is made smallest
        max_pressure_angle : float [rad] - in (0, pi/2), for either sign
        sense : +1 or -1 - eps
        joints : floats [rad] - ends of the phases of the law
        refined : bool - False looks at 2048 cam angles alone: limits are met to about 1e-6, ten times as fast
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
    slope = _checked_slope(max_pressure_angle)
    planes = [partial(_rocker_planes, roller, slope, sense, sign) for roller in rollers for sign in (1, -1)]
    first = rollers[0]
    psi, _ = first.law(np.array([0.0]))
    target = complex(first.pivot + first.arm * np.exp(1j * psi[0]))
    if refined:
        families = [partial(_largest_violation, family, 0.0, TURN, joints) for family in planes]
    else:
        phi = np.linspace(0.0, TURN, _PLACES)
        families = [partial(_largest_of, *family(phi)) for family in planes]
    return _nearest_admissible(families, target, max_pressure_angle)


def _rocker_planes(roller: RockingRoller, slope: float, sense: int, sign: int, phi: Reals) -> tuple[Points, Reals]:
    psi, psi1 = roller.law(phi)
    # side (Im z tan a + sign Re z) = Re(conj(n0) z) with n0 = side (sign + i tan a); sign +1 is the upper limit
    local = complex(roller.side * sign, roller.side * slope) / math.hypot(1.0, slope)
    normal: Points = local * np.exp(1j * psi)
    reach = roller.arm * (1.0 - sense * psi1) * local.real
    return normal, (np.conj(normal) * roller.pivot).real + reach


def _checked_slope(max_pressure_angle: float) -> float:
    if not 0.0 < max_pressure_angle < math.pi / 2.0:
        raise NoSolution(
            f"max_pressure_angle = {math.degrees(max_pressure_angle):.6g} deg must lie between 0 and 90 deg: "
            "30 deg is usual"
        )
    return math.tan(max_pressure_angle)


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
    raise NoSolution(
        (f"the smallest cam is not determined by a pressure angle of {math.degrees(max_pressure_angle):.6g} deg"),
        fix="allow a little more",
    )


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
            "no cam centre keeps the pressure angle within its limit for the whole revolution",
            fix="raise the limit, lengthen the phases or reduce the swing",
        )
    return complex(feasible[int(np.argmin(np.abs(feasible - target)))])
