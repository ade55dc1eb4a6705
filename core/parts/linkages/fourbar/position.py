"""The four-bar linkage at one position: closing, angles and rates in closed form, with `math` alone.

Frame of all four-bar modules: crank pivot A = (0, 0), rocker pivot D = (d, 0), crank a = AB, coupler b = BC,
rocker c = CD, frame d = AD. The crank angle phi, the coupler angle (direction B->C) and the rocker angle
(direction D->C) count counter-clockwise from A->D.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any, Generic, NamedTuple, TypeVar

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.wording import within
from gearlink.core.parts.linkages.dyad import acute
from gearlink.core.parts.linkages.fourbar.loop import (
    Reading,
    closes_somewhere,
    closing_range,
    make_reading,
    never_closes,
    solve_loop,
)

Number = TypeVar("Number")
_NOT_ASKED: Any = math.nan
_CHANGE_POINT_ULPS = 4.0


@dataclass(frozen=True, slots=True)
class FourBar:
    """A four-bar linkage: four lengths [mm] and the side on which it is assembled.

    Parameters
        crank, coupler, rocker, frame : float [mm] - a = AB, b = BC, c = CD, d = AD; positive, finite
        assembly : +1 or -1 - +1: C lies left of the vector B->D; -1: right of it (the mirror image)
    Raises
        NoSolution - for a length that is not positive and finite, or another assembly
    Notes
        A linkage that never closes may be made (`kind` tells); solving it raises.
    Example
        >>> FourBar(18.0, 50.0, 100.0, 121.4).kind()
        'crank-rocker'
    """

    crank: float
    coupler: float
    rocker: float
    frame: float
    assembly: int = 1
    reading: Reading = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        a, b, c, d = self.crank, self.coupler, self.rocker, self.frame
        for name, length in (("crank", a), ("coupler", b), ("rocker", c), ("frame", d)):
            if not (math.isfinite(length) and length > 0.0):
                raise NoSolution(f"{name} length is {length:g} mm; it must be positive and finite")
        if self.assembly not in (1, -1):
            raise NoSolution(f"assembly is {self.assembly!r}; it must be +1 or -1")
        object.__setattr__(self, "reading", make_reading(a, b, c, d, self.assembly))

    def kind(self) -> str:
        """Class of the linkage by Grashof's rule.

        s + l < p + q    (shortest, longest, the other two)

        Returns
            'crank-rocker' (crank shortest), 'drag-link' (frame shortest), 'rocker-crank' (rocker shortest),
            'double-rocker' (coupler shortest, or s + l > p + q), 'change-point' (equality within 4 ulp of the
            sum of lengths), 'impossible' (the longest is not shorter than the other three together)
        Example
            >>> FourBar(50.0, 45.0, 48.0, 20.0).kind(), FourBar(40.0, 90.0, 40.0, 90.0).kind()
            ('drag-link', 'change-point')

        Source
            own derivation; the rule is F. Grashof's
        """
        shortest, p, q, longest = sorted((self.crank, self.coupler, self.rocker, self.frame))
        if math.fsum((shortest, p, q, -longest)) <= 0.0:
            return "impossible"
        margin = math.fsum((p, q, -shortest, -longest))
        if abs(margin) <= _CHANGE_POINT_ULPS * math.ulp(math.fsum((shortest, p, q, longest))):
            return "change-point"
        if margin < 0.0 or shortest == self.coupler:
            return "double-rocker"
        if shortest == self.crank:
            return "crank-rocker"
        return "drag-link" if shortest == self.frame else "rocker-crank"

    def turns_fully(self) -> bool:
        """Whether the linkage closes at every crank angle (P and Q are not negative at phi = 0 and pi).

        Example
            >>> FourBar(18.0, 50.0, 100.0, 121.4).turns_fully(), FourBar(100.0, 50.0, 18.0, 121.4).turns_fully()
            (True, False)
        """
        return min(self.reading.p_0, self.reading.p_pi, self.reading.q_0, self.reading.q_pi) >= 0.0

    def transmission_extremes(self) -> tuple[float, float]:
        """Transmission angle BCD at crank angles 0 and pi; between them it runs monotonically.

        tan^2(gamma/2) = Q/P

        Returns
            gamma_0, gamma_pi : float, float [rad] - the smallest and the largest angle of the turn
        Raises
            NoSolution - when the crank does not turn fully
        Example
            >>> [round(math.degrees(g), 3) for g in FourBar(16.0, 50.0, 100.0, 122.83941479).transmission_extremes()]
            [83.769, 132.659]

        Source
            thesis (4-3)
        """
        if not self.turns_fully():
            raise _not_turning(self)
        at_0 = 2.0 * math.atan2(math.sqrt(self.reading.q_0), math.sqrt(self.reading.p_0))
        at_pi = 2.0 * math.atan2(math.sqrt(self.reading.q_pi), math.sqrt(self.reading.p_pi))
        return at_0, at_pi

    def min_transmission_angle(self) -> float:
        """Smallest transmission angle of the turn, an obtuse one counted from the other side.

        mu_min = min(gamma_0, pi - gamma_0, gamma_pi, pi - gamma_pi)

        Returns
            mu_min : float [rad] - 0..pi/2
        Raises
            NoSolution - when the crank does not turn fully
        Example
            >>> round(math.degrees(FourBar(16.0, 50.0, 100.0, 122.83941479).min_transmission_angle()), 3)
            47.341

        Source
            thesis 4.2 (transmission angle)
        """
        return min(map(acute, self.transmission_extremes()))

    def inverse(self) -> FourBar:
        """The same linkage driven at the rocker: crank and rocker change places.

        psi' = psi + pi,   phi = rocker' + pi,   coupler = coupler'

        Returns
            linkage : FourBar - crank c, coupler b, rocker a, frame d, assembly of the other sign. Solved at
            the crank angle psi + pi (psi the rocker angle here), it gives the crank angle here less pi as its
            rocker angle, and the coupler angle here as its own
        Notes
            The frame is turned by half a revolution and the coupler runs from C to B. With assembly s the inverse
            reading has sign sin(crank angle - coupler angle) = s: +1 puts B left of the vector A->C. In a
            drag link this is the same assembly as C left of B->D; elsewhere it is the caller's choice.
        Example
            >>> FourBar(50.0, 45.0, 48.0, 20.0).inverse()
            FourBar(crank=48.0, coupler=45.0, rocker=50.0, frame=20.0, assembly=-1)

        Source
            own derivation: exchange symmetry of the loop equation
        """
        return FourBar(self.rocker, self.coupler, self.crank, self.frame, -self.assembly)


class FourBarState(NamedTuple, Generic[Number]):
    """Four-bar at one crank angle, or at an array of them: angles [rad], and rates as far as they were asked for.

    The rates are time derivatives for the driving velocity, acceleration and jerk given to `solve`; with its
    defaults they are the derivatives with respect to the crank angle. Rates that were not asked for are NaN.
    """

    coupler_angle: Number
    rocker_angle: Number
    transmission_angle: Number
    coupler_velocity: Number = _NOT_ASKED
    rocker_velocity: Number = _NOT_ASKED
    coupler_acceleration: Number = _NOT_ASKED
    rocker_acceleration: Number = _NOT_ASKED
    coupler_jerk: Number = _NOT_ASKED
    rocker_jerk: Number = _NOT_ASKED


class FourBarInverseState(NamedTuple, Generic[Number]):
    """Four-bar at one rocker angle or many, the rocker driving; fields and rates as in `FourBarState`.

    `transmission_angle` is that of this drive: the angle ABC between crank and coupler.
    """

    crank_angle: Number
    coupler_angle: Number
    transmission_angle: Number
    crank_velocity: Number = _NOT_ASKED
    coupler_velocity: Number = _NOT_ASKED
    crank_acceleration: Number = _NOT_ASKED
    coupler_acceleration: Number = _NOT_ASKED
    crank_jerk: Number = _NOT_ASKED
    coupler_jerk: Number = _NOT_ASKED


def solve(
    linkage: FourBar,
    crank_angle: float,
    order: int = 0,
    *,
    velocity: float = 1.0,
    acceleration: float = 0.0,
    jerk: float = 0.0,
) -> FourBarState[float]:
    """Angles of coupler and rocker at a crank angle, and their rates up to the wanted order.

    coupler = nu + s atan2(R, n^2 + b^2 - c^2),  rocker = nu + s atan2(R, b^2 - c^2 - n^2),
    nu = arg(D - B),  R = sqrt(P Q),  gamma = atan2(R, (P - Q)/2),  s = assembly

    Parameters
        crank_angle : float [rad] - any real angle
        order : 0..3 - 0 angles only, 1 velocities, 2 accelerations, 3 jerks too
        velocity, acceleration, jerk : float [rad/s, rad/s2, rad/s3] - motion of the crank; the defaults give
            the derivatives with respect to the crank angle
    Returns
        state : FourBarState - both angles are continuous in the crank angle, over any number of revolutions: where
            the crank is shorter than the frame neither winds, where it is longer both go round with it
            (drag link). For 0 <= crank angle <= 2 pi, nu lies within [-pi, pi]
    Raises
        NoSolution - when the linkage does not close there, or rates are wanted at a dead centre
    Notes
        Closed form. Condition eps/dev for angles and eps/dev^2 for rates, dev = min(gamma, pi - gamma); no
        loss at a dead centre on the line of the frame of a crank that turns fully.
    Example
        >>> state = solve(FourBar(18.0, 50.0, 100.0, 121.4), math.radians(45.0), order=1)
        >>> round(math.degrees(state.rocker_angle), 9), round(state.rocker_velocity, 9)
        (146.168778216, -0.044209716)

    Source
        thesis (4-3), (4-4); swing-gripper paper (5)-(7) with the sign of l3 cos theta3 corrected; rates: own
        derivation from the angles of the triangle BCD
    """
    return FourBarState(*solve_loop(linkage.reading, crank_angle, order, (velocity, acceleration, jerk)))


def solve_inverse(
    linkage: FourBar,
    rocker_angle: float,
    order: int = 0,
    *,
    velocity: float = 1.0,
    acceleration: float = 0.0,
    jerk: float = 0.0,
) -> FourBarInverseState[float]:
    """Angles of crank and coupler at a rocker angle, the rocker driving, and their rates.

    Parameters
        linkage : FourBar - its assembly reads here: sign of sin(crank angle - coupler angle), see
            `FourBar.inverse`; in a drag link this is the assembly of `solve` as well
        rocker_angle : float [rad] - any real angle, direction D->C
        order : 0..3
        velocity, acceleration, jerk : float [rad/s, rad/s2, rad/s3] - motion of the rocker
    Returns
        state : FourBarInverseState - angles continuous in the rocker angle; in a drag link the crank angle
            is the very one that `solve` was given, whole revolutions included
    Raises
        NoSolution - when the linkage does not close there, or rates are wanted where crank and coupler align
    Example
        >>> drag = FourBar(50.0, 45.0, 48.0, 20.0)
        >>> round(solve_inverse(drag, solve(drag, 12.5).rocker_angle).crank_angle, 12)
        12.5

    Source
        own derivation: exchange symmetry of the loop equation
    """
    motion = (velocity, acceleration, jerk)
    coupler, crank, transmission, *rates = solve_loop(inverse_reading(linkage), rocker_angle, order, motion)
    for i in range(0, len(rates), 2):
        rates[i], rates[i + 1] = rates[i + 1], rates[i]
    return FourBarInverseState(crank + math.pi, coupler, transmission, *rates)


@lru_cache(maxsize=16)
def inverse_reading(linkage: FourBar) -> Reading:
    """Constants of the loop with the rocker driving, D the origin and A at (-d, 0): no angle is shifted.

    Example
        >>> inverse_reading(FourBar(50.0, 45.0, 48.0, 20.0))[:5]
        (48.0, 45.0, 50.0, -20.0, -1)

    Source
        own derivation: exchange symmetry of the loop equation
    """
    return make_reading(linkage.rocker, linkage.coupler, linkage.crank, -linkage.frame, -linkage.assembly)


def _not_turning(linkage: FourBar) -> NoSolution:
    """The refusal of a crank that is asked to turn fully and cannot."""
    if not closes_somewhere(linkage.reading):
        return NoSolution(f"the crank does not turn fully: the four-bar {never_closes(linkage.reading)}")
    low, high = (math.degrees(x) for x in closing_range(linkage.reading))
    return NoSolution(
        f"the crank does not turn fully: the {linkage.kind()} of {linkage.crank:g}, {linkage.coupler:g}, "
        f"{linkage.rocker:g}, {linkage.frame:g} mm closes {within(low, high, 'deg')} only",
        fix="change the lengths to those of a crank-rocker or drag link",
    )
