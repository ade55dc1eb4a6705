"""Standstills and the momentary dwell with internal meshes: the radius of a gear in internal mesh counts negative.

With r1 < 0 where the mesh of crank gear and idler is internal, r5 < 0 where that of idler and output gear is, one
theory holds for all arrangements: b = |r1 + r3|, c = |r3 + r5|, S = r1 + 2 r3 + r5, T = r1 + r3 + r5,

    P = S^2 + r1^2 - r5^2,   Q = P^2 - 4 S^2 r1^2 = 16 r3 (r3 + r5)(r1 + r3) T,   h = e^2 - r1^2,   g = h + r5^2 - d^2

and X = cos^2(beta) at a standstill is a root of Q X^2 + (2 P g - 4 S^2 h) X + g^2 = 0. With sigma = sign(T) the output
just stops where g = h (P + sigma sqrt Q)/(2 r1^2): it steps back with a longer frame for sigma = +1, and with a shorter
one for sigma = -1, a ring gear 5 round the whole train.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.three_gear.dwell.momentary_dwell import Tangency, crank_angle, wrap
from gearlink.core.machines.three_gear.motion import GearTrain, output_acceleration, output_speed

if TYPE_CHECKING:
    from gearlink.core.parts.linkages.fourbar.position import FourBar

_NEWTON_STEPS = 4
_ZERO = 1e-11  # speed ratio at a standstill, of the terms that cancel there
_APART = 1e-7  # crank angle [rad] below which two candidates are one standstill


def is_internal(*radii: float) -> bool:
    """Whether one of the meshes is internal."""
    return any(radius < 0.0 for radius in radii)


@dataclass(frozen=True, slots=True)
class Shape:
    """What the radii of an arrangement with a momentary dwell give.

    sigma : +1 or -1 - on which side of d* the output steps back
    kappa : float - d*^2 = r5^2 + (r1^2 - e^2) kappa
    low, high : float [mm] - cranks between which some frame just stops the output
    offset : float [mm] - e_t = w/x of the tangency
    facing : +1 or -1 - sign of (r1 + r3)(r3 + r5)
    """

    sigma: int
    kappa: float
    low: float
    high: float
    offset: float
    facing: int


def shape(r1: float, r3: float, r5: float) -> Shape:
    """Side, range and factor of the momentary dwell of gears with an internal mesh.

    d*^2 = r5^2 + (r1^2 - e^2) kappa,   kappa = (P + sigma sqrt Q)/(2 r1^2) - 1

    Parameters
        r1, r3, r5 : float [mm] - reference radii, negative for a gear in internal mesh with the idler
    Returns
        shape : Shape
    Raises
        NoSolution - for gears whose output never just stops: a crank gear that is a ring round the idler, or an output
            ring that does not reach round the whole train
    Example
        >>> found = shape(24.0, 17.0, -54.0)
        >>> found.sigma, round(found.kappa, 9)
        (-1, -5.027825753)
    """
    s, t = r1 + 2.0 * r3 + r5, r1 + r3 + r5
    q = 16.0 * r3 * (r3 + r5) * (r1 + r3) * t
    if r1 < -r3:
        raise NoSolution("a crank gear that is a ring round the idler never stops the output: make it an external gear")
    if not q > 0.0:
        raise NoSolution(
            f"a ring gear of {abs(2.0 * r5):.9g} mm reference diameter never just stops the output: to reach round the "
            f"crank gear and the idler it must be larger than {2.0 * (r1 + r3):.9g} mm"
        )
    sigma = 1 if t > 0.0 else -1
    p, root = s * s + (r1 - r5) * (r1 + r5), math.sqrt(q)
    whole = p + sigma * root
    slope = -sigma * whole / (2.0 * r1 * r1 * root)  # X* = slope h
    reach = r1 * r1 + 1.0 / slope
    if not slope < 0.0 or reach >= r1 * r1:
        raise NoSolution("no crank makes these gears just stop the output: change the teeth")
    facing = 1 if (r1 + r3) * (r3 + r5) > 0.0 else -1
    low = math.sqrt(max(0.0, reach))
    return Shape(sigma, whole / (2.0 * r1 * r1) - 1.0, low, abs(r1), 2.0 * s * r1 * r1 / whole, facing)


def tangency(r1: float, r3: float, r5: float, eccentricity: float) -> Tangency | None:
    """Where the output of given gears and crank just stops; None where no frame does that.

    X* = -sigma g*/sqrt Q,   d*^2 = r5^2 + (r1^2 - e^2) kappa

    Parameters
        r1, r3, r5 : float [mm] - signed reference radii
        eccentricity : float [mm] - crank length
    Returns
        tangency : Tangency or None
    Example
        >>> found = tangency(24.0, 17.0, -54.0, 22.0)
        >>> round(found.frame, 12)
        49.532212051926
    """
    try:
        found = shape(r1, r3, r5)
    except NoSolution:
        return None
    span = (r1 - found.low) * (r1 + found.low)
    x2 = (r1 - eccentricity) * (r1 + eccentricity) / span
    square = r5 * r5 + (r1 - eccentricity) * (r1 + eccentricity) * found.kappa
    if not 0.0 < x2 < 1.0 or square <= 0.0:
        return None
    sine = math.sqrt((eccentricity - found.low) * (eccentricity + found.low) / span)
    return Tangency(math.sqrt(square), math.sqrt(x2), found.facing * sine, found.offset)


def standstills(linkage: FourBar, train: GearTrain, radii: tuple[float, float, float]) -> list[float]:
    """Crank angles of both standstills of an output with an internal mesh, or none.

    phi = atan2(-r1 s, -w) - atan2(-r5 s, S x - w),   w = (P X + g)/(2 S x),   s = sign((r1 + r3)(r3 + r5)) sqrt(1 - X)

    Parameters
        linkage : FourBar [mm]
        train : GearTrain
        radii : r1, r3, r5, signed [mm]
    Returns
        places : list of float [rad] - ascending in [0, 2 pi)
    Notes
        Each root of the quadratic is followed by Newton steps on the speed ratio, which take out what cancels where
        both roots are near each other: always so for S near 0, a ring output with coupler and rocker of equal length.
    """
    r1, r3, r5 = radii
    s, facing = r1 + 2.0 * r3 + r5, math.copysign(1.0, (r1 + r3) * (r3 + r5))
    h = (linkage.crank - r1) * (linkage.crank + r1)
    found: list[float] = []
    for x2 in _roots(linkage, radii):
        reach, square = s * math.sqrt(x2), h + r1 * r1 * x2
        if square < 0.0:
            continue
        for w in (math.sqrt(square), -math.sqrt(square)):
            start = crank_angle(r1, r5, reach, w, facing * math.sqrt(1.0 - x2), linkage.assembly)
            place = _polished(linkage, train, start)
            if place is not None and all(abs(math.remainder(place - other, math.tau)) > _APART for other in found):
                found.append(place)
    return sorted(found) if len(found) == 2 else []


def _roots(linkage: FourBar, radii: tuple[float, float, float]) -> list[float]:
    """Roots X of the quadratic in (0, 1); a discriminant that rounding made negative counts as 0."""
    r1, r3, r5 = radii
    s = r1 + 2.0 * r3 + r5
    p = s * s + (r1 - r5) * (r1 + r5)
    q = 16.0 * r3 * (r3 + r5) * (r1 + r3) * (r1 + r3 + r5)
    h = (linkage.crank - r1) * (linkage.crank + r1)
    g = h + (r5 - linkage.frame) * (r5 + linkage.frame)
    half = p * g - 2.0 * s * s * h
    # P^2 - Q = 4 S^2 r1^2 takes the squares out of the discriminant
    rest = s * s * (r1 * r1 * g * g - p * g * h + s * s * h * h)
    if rest < -1e-12 * half * half:
        return []
    top = -(half + math.copysign(2.0 * math.sqrt(max(0.0, rest)), half))
    found = {top / q if q else math.inf, g * g / top if top else math.inf}
    return [x for x in found if 0.0 < x < 1.0]


def _polished(linkage: FourBar, train: GearTrain, place: float) -> float | None:
    """The standstill that Newton steps reach from a place near it; None from a place that is none."""
    size = abs(train.ratio) + abs(train.coupler_share) + abs(train.rocker_share)
    for _ in range(_NEWTON_STEPS):
        speed = output_speed(linkage, train, place)
        slope = output_acceleration(linkage, train, place)
        if slope == 0.0 or abs(speed) > 0.1 * size:
            return None
        step = speed / slope
        if abs(step) > 0.1:
            return None
        place -= step
        if abs(step) <= 1e-15:
            break
    return wrap(place) if abs(output_speed(linkage, train, place)) <= _ZERO * size else None
