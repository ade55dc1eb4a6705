"""Frames with which the output of a two-gear four-bar stands still: the range, the momentary dwell, what is refused.

The output stands still where the line CD passes through the pitch point P of the gears on AB. With u = PC along that
line, positive towards D, the triangle BCP and the triangle of A, P and D give

    d^2 = r5^2 + (u - c)^2 + q (u - c) (r2^2 + u^2 - b^2)/u,   q = r5/r2, negative for a ring gear

so that standstills come in pairs, and a pair is one momentary dwell where d^2 is stationary in u:

    2 (1 + q) u^3 - c (2 + q) u^2 - c q (b^2 - r2^2) = 0

With a sun the output stands still in drag links alone, with frames from that of the momentary dwell up to the change
point; with a ring gear in crank-rockers alone, with frames from the change point up to that of the momentary dwell.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_above, safely_below
from gearlink.core.machines.planet_linkages.planet import PlanetLinkage
from gearlink.core.numerics.roots import roots_on
from gearlink.core.parts.linkages import standstills
from gearlink.core.parts.linkages.fourbar.loop import rates_of
from gearlink.core.parts.linkages.fourbar.position import FourBar
from gearlink.core.parts.linkages.standstills import Turning

_AT_CHANGE_POINT = 1e-10  # for limits of the teeth, which approach theirs with the root of this share


@dataclass(frozen=True, slots=True)
class Family:
    """Gears and links without the frame.

    crank, coupler, rocker : float [mm] - the crank is the centre distance of the gears
    ratio : float - i = -z2/z5 for a sun, +z2/z5 for a ring gear
    assembly : +1 or -1
    """

    crank: float
    coupler: float
    rocker: float
    ratio: float
    assembly: int = 1

    @property
    def ring(self) -> bool:
        """Whether the output is a ring gear."""
        return self.ratio > 0.0

    def drive(self, frame: float) -> PlanetLinkage:
        """The drive of a frame [mm]."""
        linkage = FourBar(self.crank, self.coupler, self.rocker, frame, self.assembly)
        return PlanetLinkage(linkage, self.ratio, "crank")


def frame_range(family: Family) -> tuple[float, float]:
    """Frames between which the output may stand still at all, by the class of the linkage.

    sun, drag link:       0 < d < a + b + c - 2 max(a, b, c)
    ring, crank-rocker:   a + |b - c| < d < b + c - a

    Returns
        low, high : float [mm] - the linkage flattens at the high end (sun), at both (ring)
    Raises
        NoSolution - where no frame makes such a linkage of the links
    Example
        >>> frame_range(Family(54.0, 48.0, 50.0, -2.0)), frame_range(Family(50.0, 80.0, 90.0, 0.375))
        ((0.0, 44.0), (60.0, 120.0))

    Source
        Grashof's rule; that each gear stands in one class alone: own derivation for the sun
    """
    a, b, c = family.crank, family.coupler, family.rocker
    if family.ring:
        if not a < min(b, c):
            raise NoSolution(
                (
                    f"with a ring gear the output stops in a crank-rocker alone: the crank, {a:.6g} mm "
                    "by the gears, must be shorter than coupler and rocker"
                ),
                key="links.coupler" if b <= c else "links.rocker",
                fix="make both longer than that, or the module smaller",
            )
        return math.fsum((a, abs(b - c))), math.fsum((b, c, -a))
    longest = max(a, b, c)
    high = math.fsum((a, b, c, -2.0 * longest))
    if high <= 0.0:
        raise NoSolution(
            f"with a sun the output stops in a drag link alone, the frame its shortest link; with crank "
            f"{a:.6g} (by the gears), coupler {b:.6g} and rocker {c:.6g} mm there is none: the longest must be "
            f"shorter than the other two together, {a + b + c - longest:.6g} mm",
            key="links.rocker" if c == longest else "links.coupler",
        )
    return 0.0, high


def stationary_frames(family: Family) -> list[float]:
    """Frames [mm] of the range at which the number of standstills changes, from the cubic in u; one or none.

    Example
        >>> [round(d, 9) for d in stationary_frames(Family(54.0, 48.0, 50.0, -2.0))]
        [17.077972858]

    Source
        own derivation, see the module
    """
    q, c = -1.0 / family.ratio, family.rocker
    r2 = family.crank / abs(1.0 + q)
    k = (family.coupler - r2) * (family.coupler + r2)
    terms = (2.0 * (1.0 + q), -c * (2.0 + q), -c * q * k)
    low, high = frame_range(family)
    found = []
    for u in _places(*terms):
        cosine = (u - k / u) / (2.0 * r2)
        square = q * q * r2 * r2 + (u - c) ** 2 + 2.0 * q * r2 * (u - c) * cosine
        if abs(cosine) <= 1.0 and low * low < square < high * high:
            found.append(math.sqrt(square))
    return sorted(found)


def _places(cubic: float, square: float, constant: float) -> list[float]:
    """Real roots u, none of them 0, of cubic u^3 + square u^2 + constant; it turns at 0 and at -2 square/(3 cubic)."""
    if constant == 0.0:
        return [-square / cubic] if square else []
    far = 1.0 + (abs(square) + math.sqrt(abs(constant * cubic)) + abs(constant)) / abs(cubic)
    turning = -2.0 * square / (3.0 * cubic)
    return roots_on(lambda u: (cubic * u + square) * u * u + constant, sorted({-far, 0.0, turning, far}))


def momentary_frame(family: Family) -> float:
    """Frame with which the output stops once a revolution without stepping back.

    Returns
        frame : float [mm] - d*
    Raises
        NoSolution - where the links and gears have none, naming the teeth that have
    Example
        >>> round(momentary_frame(Family(50.0, 80.0, 90.0, 0.375)), 9)
        82.462174487

    Source
        own derivation, see the module
    """
    found = stationary_frames(family)
    if not found:
        raise NoSolution(never(family), key="gears.ring" if family.ring else "gears.sun")
    return found[0]


def beyond_reach(what: str, most: float, drive: PlanetLinkage) -> str:
    """The refusal of a request that is more than the most [rad] of a family, which one of its drives reaches."""
    angle = math.degrees(drive.linkage.min_transmission_angle())
    return (
        f"{what} is more than these gears and links reach, {safely_below(math.degrees(most))} deg, and that with a "
        f"transmission angle of {angle:.3g} deg; specify less"
    )


def never(family: Family) -> str:
    """Why gears and links have no momentary dwell, and the teeth that have."""
    low, high = frame_range(family)
    margin = _AT_CHANGE_POINT * (high - low)
    limits = f"frames between {low:.9g} and {high:.9g} mm"
    teeth = abs(1.0 / family.ratio)
    if not family.ring:
        reach = max(t.value for t in coupler_turnings(family.drive(high - margin))) - 1.0
        return (
            f"with {limits} the output never stops: z5/z2 = {teeth:.6g} must be below {safely_below(reach)} "
            "with links of these lengths; take fewer teeth on the sun or more on the planet"
        )
    reach, least = (
        1.0 - min(t.value for t in coupler_turnings(family.drive(d))) for d in (low + margin, high - margin)
    )
    if teeth < least:
        return (
            f"with {limits} the output steps back always, with no momentary dwell to start from: z5/z2 = {teeth:.6g} "
            f"must be above {safely_above(least)} with links of these lengths; take more teeth on the ring gear"
        )
    return (
        f"with {limits} the output never stops: z5/z2 = {teeth:.6g} must be below {safely_below(reach)} with "
        "links of these lengths; take fewer teeth on the ring gear or more on the planet"
    )


def coupler_turnings(drive: PlanetLinkage) -> list[Turning]:
    """Extremes of the coupler's speed per crank speed; those of the output lie at the same crank angles."""
    links = drive.linkage.reading
    return standstills.turnings(lambda phi: rates_of(links, phi, 1)[0], lambda phi: rates_of(links, phi, 2)[0])
