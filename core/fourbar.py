"""The four-bar linkage at one position: closing, angles and rates in closed form, with `math` alone.

Frame of all four-bar modules: crank pivot A = (0, 0), rocker pivot D = (d, 0), crank a = AB, coupler b = BC,
rocker c = CD, frame d = AD. The crank angle phi, the coupler angle (direction B->C) and the rocker angle
(direction D->C) count counter-clockwise from A->D.

With n = |BD| and the half crank angle, everything follows from three sums of non-negative terms,

    n^2           = (d-a)^2 cos^2(phi/2) + (d+a)^2 sin^2(phi/2)
    P = (b+c)^2 - n^2 = P_0 cos^2(phi/2) + P_pi sin^2(phi/2)      P >= 0: the linkage reaches
    Q = n^2 - (b-c)^2 = Q_0 cos^2(phi/2) + Q_pi sin^2(phi/2)      Q >= 0: the linkage folds

whose end values are products of correctly rounded sums of the four lengths. So a dead centre on the line of
the frame, and a change point, cost no digits.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from gearlink.core.errors import NoSolution

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
    # End values at phi = 0 and pi of n^2, P and Q, then b^2 - c^2 and (a^2 - d^2)/2.
    n_0: float = field(init=False, repr=False, compare=False)
    n_pi: float = field(init=False, repr=False, compare=False)
    p_0: float = field(init=False, repr=False, compare=False)
    p_pi: float = field(init=False, repr=False, compare=False)
    q_0: float = field(init=False, repr=False, compare=False)
    q_pi: float = field(init=False, repr=False, compare=False)
    e: float = field(init=False, repr=False, compare=False)
    f: float = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        a, b, c, d = self.crank, self.coupler, self.rocker, self.frame
        for name, length in (("crank", a), ("coupler", b), ("rocker", c), ("frame", d)):
            if not (math.isfinite(length) and length > 0.0):
                raise NoSolution(f"{name} length is {length:g} mm; it must be positive and finite")
        if self.assembly not in (1, -1):
            raise NoSolution(f"assembly is {self.assembly!r}; it must be +1 or -1")
        keep = object.__setattr__
        keep(self, "n_0", (d - a) ** 2)
        keep(self, "n_pi", (d + a) ** 2)
        keep(self, "p_0", math.fsum((a, b, c, -d)) * math.fsum((-a, b, c, d)))
        keep(self, "p_pi", math.fsum((-a, b, c, -d)) * math.fsum((a, b, c, d)))
        keep(self, "q_0", math.fsum((-a, -b, c, d)) * math.fsum((-a, b, -c, d)))
        keep(self, "q_pi", math.fsum((a, -b, c, d)) * math.fsum((a, b, -c, d)))
        keep(self, "e", (b - c) * (b + c))
        keep(self, "f", 0.5 * (a - d) * (a + d))

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
        return min(self.p_0, self.p_pi, self.q_0, self.q_pi) >= 0.0

    def crank_range(self) -> tuple[float, float]:
        """Crank angles, measured either way from the frame, between which the linkage closes.

        tan^2(phi/2) = -Q_0/Q_pi  and  -P_0/P_pi

        Returns
            low, high : float, float [rad] - it closes where low <= |phi| <= high, phi reduced to [-pi, pi];
            (0, pi) for a crank that turns fully
        Raises
            NoSolution - when the linkage closes nowhere
        Example
            >>> low, high = FourBar(150.0, 160.0, 100.0, 300.0).crank_range()
            >>> low, round(high, 9)
            (0.0, 1.048480077)

        Source
            own derivation: the roots of P and Q in the half angle
        """
        if self.p_0 < 0.0 or self.q_pi < 0.0:
            raise NoSolution(_never_closes(self))
        low = 2.0 * math.atan2(math.sqrt(-self.q_0), math.sqrt(self.q_pi)) if self.q_0 < 0.0 else 0.0
        high = 2.0 * math.atan2(math.sqrt(self.p_0), math.sqrt(-self.p_pi)) if self.p_pi < 0.0 else math.pi
        return low, high

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
            raise NoSolution(_not_turning(self))
        at_0 = 2.0 * math.atan2(math.sqrt(self.q_0), math.sqrt(self.p_0))
        at_pi = 2.0 * math.atan2(math.sqrt(self.q_pi), math.sqrt(self.p_pi))
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
        return min(min(gamma, math.pi - gamma) for gamma in self.transmission_extremes())

    def inverse(self) -> FourBar:
        """The same linkage driven at the rocker: crank and rocker change places.

        psi' = psi + pi,   phi = rocker' + pi,   coupler = coupler'

        Returns
            linkage : FourBar - crank c, coupler b, rocker a, frame d, assembly of the other sign. Solved at
            the crank angle psi + pi (psi the rocker angle here), it gives the crank angle here less pi as its
            rocker angle, and the coupler angle here as its own
        Notes
            The frame is turned by half a turn and the coupler runs from C to B. With assembly s the inverse
            reading has sign sin(crank angle - coupler angle) = s: +1 puts B left of the vector A->C. In a
            drag link this is the same assembly as C left of B->D; elsewhere it is the caller's choice.
        Example
            >>> FourBar(50.0, 45.0, 48.0, 20.0).inverse()
            FourBar(crank=48.0, coupler=45.0, rocker=50.0, frame=20.0, assembly=-1)

        Source
            own derivation: exchange symmetry of the loop equation
        """
        return FourBar(self.rocker, self.coupler, self.crank, self.frame, -self.assembly)


@dataclass(frozen=True, slots=True)
class FourBarState:
    """Four-bar at one crank angle: angles [rad], and rates as far as their order was asked for.

    The rates are time derivatives for the driving velocity, acceleration and jerk given to `solve`; with its
    defaults they are the derivatives after the crank angle. Rates that were not asked for are NaN.
    """

    coupler_angle: float
    rocker_angle: float
    transmission_angle: float
    coupler_velocity: float = math.nan
    rocker_velocity: float = math.nan
    coupler_acceleration: float = math.nan
    rocker_acceleration: float = math.nan
    coupler_jerk: float = math.nan
    rocker_jerk: float = math.nan


@dataclass(frozen=True, slots=True)
class FourBarInverseState:
    """Four-bar at one rocker angle, the rocker driving; fields and rates as in `FourBarState`.

    `transmission_angle` is that of this drive: the angle ABC between crank and coupler.
    """

    crank_angle: float
    coupler_angle: float
    transmission_angle: float
    crank_velocity: float = math.nan
    coupler_velocity: float = math.nan
    crank_acceleration: float = math.nan
    coupler_acceleration: float = math.nan
    crank_jerk: float = math.nan
    coupler_jerk: float = math.nan


def solve(
    linkage: FourBar,
    crank_angle: float,
    order: int = 0,
    *,
    velocity: float = 1.0,
    acceleration: float = 0.0,
    jerk: float = 0.0,
) -> FourBarState:
    """Angles of coupler and rocker at a crank angle, and their rates up to the wanted order.

    coupler = nu + s atan2(R, n^2 + b^2 - c^2),  rocker = nu + s atan2(R, b^2 - c^2 - n^2),
    nu = arg(D - B),  R = sqrt(P Q),  gamma = atan2(R, (P - Q)/2),  s = assembly

    Parameters
        linkage : FourBar
        crank_angle : float [rad] - any real angle
        order : 0..3 - 0 angles only, 1 velocities, 2 accelerations, 3 jerks too
        velocity, acceleration, jerk : float [rad/s, rad/s2, rad/s3] - motion of the crank; the defaults give
            the derivatives after the crank angle
    Returns
        state : FourBarState - both angles are continuous in the crank angle, over any number of turns: where
            the crank is shorter than the frame neither winds, where it is longer both go round with it
            (drag link). For 0 <= crank angle <= 2 pi, nu lies within [-pi, pi]
    Raises
        NoSolution - when the linkage does not close there, or rates are wanted at a dead point
    Notes
        Closed form. Condition eps/dev for angles and eps/dev^2 for rates, dev = min(gamma, pi - gamma); no
        loss at a dead centre on the line of the frame of a crank that turns fully.
    Example
        >>> state = solve(FourBar(18.0, 50.0, 100.0, 121.4), math.radians(45.0), order=1)
        >>> round(math.degrees(state.rocker_angle), 9), round(state.rocker_velocity, 9)
        (146.168778216, -0.044209716)

    Source
        thesis (4-3), (4-4); swing-gripper paper (5)-(7) with the sign of l3 cos theta3 put right; rates: own
        derivation from the angles of the triangle BCD
    """
    return FourBarState(*_solve(linkage, crank_angle, order, velocity, acceleration, jerk))


def solve_inverse(
    linkage: FourBar,
    rocker_angle: float,
    order: int = 0,
    *,
    velocity: float = 1.0,
    acceleration: float = 0.0,
    jerk: float = 0.0,
) -> FourBarInverseState:
    """Angles of crank and coupler at a rocker angle, the rocker driving, and their rates.

    Parameters
        linkage : FourBar - its assembly reads here: sign of sin(crank angle - coupler angle), see
            `FourBar.inverse`; in a drag link this is the assembly of `solve` as well
        rocker_angle : float [rad] - any real angle, direction D->C
        order : 0..3
        velocity, acceleration, jerk : float [rad/s, rad/s2, rad/s3] - motion of the rocker
    Returns
        state : FourBarInverseState - angles continuous in the rocker angle; in a drag link the crank angle
            is the very one that `solve` was given, whole turns included
    Raises
        NoSolution - when the linkage does not close there, or rates are wanted where crank and coupler align
    Example
        >>> drag = FourBar(50.0, 45.0, 48.0, 20.0)
        >>> round(solve_inverse(drag, solve(drag, 12.5).rocker_angle).crank_angle, 12)
        12.5

    Source
        own derivation: exchange symmetry of the loop equation
    """
    rates = _solve(linkage.inverse(), rocker_angle + math.pi, order, velocity, acceleration, jerk, driver="rocker")
    coupler, rest, crank = rates[0], rates[2:], rates[1] + math.pi
    swapped = [rest[0]]
    for i in range(1, len(rest), 2):
        swapped += (rest[i + 1], rest[i])
    return FourBarInverseState(crank, coupler, *swapped)


def _solve(
    linkage: FourBar,
    phi: float,
    order: int,
    velocity: float,
    acceleration: float,
    jerk: float,
    driver: str = "crank",
) -> list[float]:
    """Coupler, rocker and transmission angle, then pairs (coupler, rocker) of rates up to the order."""
    if not math.isfinite(phi):
        raise NoSolution(f"{driver} angle is {phi!r}; it must be finite")
    a, d, s = linkage.crank, linkage.frame, linkage.assembly
    sin_half, cos_half = math.sin(0.5 * phi), math.cos(0.5 * phi)
    ss, cc = sin_half * sin_half, cos_half * cos_half
    n2 = linkage.n_0 * cc + linkage.n_pi * ss
    p = linkage.p_0 * cc + linkage.p_pi * ss
    q = linkage.q_0 * cc + linkage.q_pi * ss
    pq = p * q
    if not (pq > 0.0 or (pq == 0.0 and order == 0 and n2 > 0.0)):
        raise NoSolution(_why_not(linkage, phi, p, q, driver))
    r = math.sqrt(pq)
    sin_phi = 2.0 * sin_half * cos_half
    if d >= a:
        nu = math.atan2(-a * sin_phi, (d - a) * cc + (d + a) * ss)
    else:
        nu = phi - math.pi + math.atan2(d * sin_phi, (a - d) * cc + (a + d) * ss)
    e, z = linkage.e, 0.5 * (p - q)
    result = [nu + s * math.atan2(r, e + n2), nu + s * math.atan2(r, e - n2), math.atan2(r, z)]
    if order == 0:
        return result
    # nu, the signed gamma = g and the share h of g in the rocker, rocker' = nu' + s g' h, each differentiated.
    ad, m = a * d, 1.0 / n2
    f = linkage.f
    a_0 = ad * sin_phi
    h = 0.5 + 0.5 * e * m
    g_1 = 2.0 * a_0 / r
    w_g = s * g_1
    w_c = 0.5 + f * m + w_g * h
    w_b = 0.5 + f * m - w_g * (0.5 - 0.5 * e * m)
    result += (velocity * w_b, velocity * w_c)
    if order == 1:
        return result
    a_1 = ad * (cc - ss)
    am = a_0 * m * m
    h_1 = -e * am
    g_2 = (2.0 * a_1 - g_1 * g_1 * z) / r
    e_g = s * g_2
    nu_2 = -2.0 * f * am
    e_c = nu_2 + e_g * h + w_g * h_1
    e_b = e_c - e_g
    v2 = velocity * velocity
    result += (v2 * e_b + acceleration * w_b, v2 * e_c + acceleration * w_c)
    if order == 2:
        return result
    am_1 = (a_1 - 4.0 * a_0 * a_0 * m) * m * m
    j_g = s * (2.0 * a_0 * (g_1 * g_1 - 1.0) - 3.0 * g_1 * g_2 * z) / r
    j_c = -2.0 * f * am_1 + j_g * h + 2.0 * e_g * h_1 - w_g * e * am_1
    j_b = j_c - j_g
    v3, va = v2 * velocity, 3.0 * velocity * acceleration
    result += (v3 * j_b + va * e_b + jerk * w_b, v3 * j_c + va * e_c + jerk * w_c)
    return result


def _why_not(linkage: FourBar, phi: float, p: float, q: float, driver: str) -> str:
    """Why the linkage has no position, or no rates, at this angle of its driving link, and what to change."""
    a, b, c, d = linkage.crank, linkage.coupler, linkage.rocker, linkage.frame
    if driver == "rocker":
        phi, ends, far = phi - math.pi, "AC", "crank"
    else:
        ends, far = "BD", "rocker"
    n = math.sqrt(linkage.n_0 * math.cos(0.5 * phi) ** 2 + linkage.n_pi * math.sin(0.5 * phi) ** 2)
    if driver == "rocker":
        n = math.sqrt(linkage.n_0 * math.sin(0.5 * phi) ** 2 + linkage.n_pi * math.cos(0.5 * phi) ** 2)
    where = f"at {driver} angle {math.degrees(phi):.9g} deg: |{ends}| = {n:.9g} mm"
    limits = f"coupler and {far} span {abs(b - c):.9g} to {b + c:.9g} mm"
    if p < 0.0 or q < 0.0:
        if linkage.p_0 < 0.0 or linkage.q_pi < 0.0:
            return f"the four-bar does not close {where}, {limits}; {_never_closes(linkage)}"
        wrong = "too long" if p < 0.0 else "too short"
        low, high = (math.degrees(x) for x in linkage.crank_range())
        if driver == "rocker":
            low, high = 180.0 - high, 180.0 - low
        by = n - (b + c) if p < 0.0 else abs(b - c) - n
        change = f"lengthen coupler or {far}" if p < 0.0 else f"bring coupler and {far} nearer to equal length"
        return (
            f"the four-bar does not close {where} is {wrong}, {limits}; keep the {driver} angle between "
            f"{low:.9g} and {high:.9g} deg (either way from the frame), or {change} by {by:.3g} mm"
        )
    if b == c and n <= 0.0:
        return f"{ends[0]} falls on {ends[1]} {where}: the position is not determined; make a and d, or b and c, differ"
    return (
        f"the four-bar stands in a dead point {where}, {limits}: coupler and {far} align and the rates are "
        f"not determined; move the {driver} angle off it or change the lengths ({a:g}, {b:g}, {c:g}, {d:g} mm)"
    )


def _never_closes(linkage: FourBar) -> str:
    """Message for four lengths that form no quadrilateral."""
    longest = max(linkage.crank, linkage.coupler, linkage.rocker, linkage.frame)
    others = math.fsum((linkage.crank, linkage.coupler, linkage.rocker, linkage.frame, -longest))
    return (
        f"it closes nowhere: the longest link {longest:.9g} mm must be shorter than the other three together, "
        f"{others:.9g} mm"
    )


def _not_turning(linkage: FourBar) -> str:
    """Message for a crank that is asked to turn fully and cannot."""
    if linkage.p_0 < 0.0 or linkage.q_pi < 0.0:
        return f"the crank does not turn fully: {_never_closes(linkage)}"
    low, high = (math.degrees(x) for x in linkage.crank_range())
    return (
        f"the crank does not turn fully: the {linkage.kind()} {linkage.crank:g}, {linkage.coupler:g}, "
        f"{linkage.rocker:g}, {linkage.frame:g} mm closes between {low:.9g} and {high:.9g} deg only; make the crank "
        f"or the frame the shortest link, and shortest + longest less than the other two together"
    )
