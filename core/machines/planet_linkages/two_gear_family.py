"""Two-gear four-bars of given gears, coupler and rocker in one unknown, the frame: momentary dwell, back-step, window.

From the frame of the momentary dwell on the output steps back, the further the nearer its frame is to the change point.

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
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_above, safely_below
from gearlink.core.base.wording import short, unlike, within
from gearlink.core.machines.planet_linkages.planet import PlanetLinkage
from gearlink.core.numerics.roots import bracketed_root, maximum, roots_on
from gearlink.core.parts.linkages.band_dwell import AlwaysStepping, least_band
from gearlink.core.parts.linkages.fourbar.position import FourBar

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

    @lru_cache(maxsize=16)  # noqa: B019 - a back-step, its window and its valley look at the same ones
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
                f"crank by the gears: {unlike(a, min(b, c))} mm (limit < {unlike(min(b, c), a)} mm, the shorter of "
                "coupler and rocker; with a ring gear only a crank-rocker stops)",
                key="links.coupler" if b <= c else "links.rocker",
                fix=f"set links.coupler and links.rocker above {safely_above(a)} mm, or reduce gears.module",
            )
        return math.fsum((a, abs(b - c))), math.fsum((b, c, -a))
    longest = max(a, b, c)
    high = math.fsum((a, b, c, -2.0 * longest))
    others = math.fsum((a, b, c, -longest))
    if high <= 0.0:
        raise NoSolution(
            f"longest of crank (by the gears), coupler and rocker: {unlike(longest, others)} mm (limit < "
            f"{unlike(others, longest)} mm, the other two together; with a sun only a drag link stops)",
            key="links.rocker" if c == longest else "links.coupler",
            fix=f"shorten it below {safely_below(others)} mm",
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


def beyond_reach(what: str, most: float, drive: PlanetLinkage, key: str = "") -> str:
    """The refusal of a request that is more than the most [rad] of a family, which one of its drives reaches."""
    angle, limit = math.degrees(drive.linkage.min_transmission_angle()), safely_below(math.degrees(most))
    return (
        f"{what} is out of reach: at most {limit} deg with these gears and links (transmission angle {angle:.3g} deg)\n"
        f"set {key or 'it'} to at most {limit} deg, or change gears or links"
    )


def never(family: Family) -> str:
    """Why gears and links have no momentary dwell, and the teeth that have."""
    low, high = frame_range(family)
    margin = _AT_CHANGE_POINT * (high - low)
    limits = f"frames of {within(low, high, 'mm')}"
    teeth = abs(1.0 / family.ratio)
    if not family.ring:
        reach = max(t.value for t in family.drive(high - margin).coupler_turnings()) - 1.0
        return (
            f"the output never stops: z5/z2 {unlike(teeth, reach)} (limit < {safely_below(reach)} for {limits})\n"
            "use fewer teeth on the sun or more on the planet"
        )
    reach, least = (
        1.0 - min(t.value for t in family.drive(d).coupler_turnings()) for d in (low + margin, high - margin)
    )
    if teeth < least:
        return (
            f"no momentary dwell, the output always steps back: z5/z2 {unlike(teeth, least)} (limit > "
            f"{safely_above(least)} for {limits})\ntake more teeth on the ring gear"
        )
    return (
        f"the output never stops: z5/z2 {unlike(teeth, reach)} (limit < {safely_below(reach)} for {limits})\n"
        "use fewer teeth on the ring gear or more on the planet"
    )


_BEFORE_CHANGE_POINT = 1e-6  # share of a range of frames left out at the end where the linkage flattens
_PROBES = (1e-3, 1e-2, 0.1)  # shares of the way to the momentary dwell at which a hump shows
_PROBED = 1e-9


def stepping(family: Family) -> tuple[float, float]:
    """Frames between which the output steps back, from the momentary dwell to just before the change point.

    Returns
        quiet, steep : float [mm] - for a ring gear the quiet one is the longer
    Raises
        NoSolution - see `momentary_frame`
    """
    return momentary_frame(family), steep_end(family)


def steep_end(family: Family) -> float:
    """The frame [mm] just before the change point at which the back-step is greatest."""
    low, high = frame_range(family)
    margin = _BEFORE_CHANGE_POINT * (high - low)
    return low + margin if family.ring else high - margin


def quiet_end(family: Family) -> float:
    """The frame [mm] at the other end of the range, where no drive of the family steps back."""
    low, high = frame_range(family)
    margin = _BEFORE_CHANGE_POINT * (high - low)
    return high - margin if family.ring else low + margin


def back_step_of(drive: PlanetLinkage) -> float:
    """Measure: the back-step D [rad]."""
    return 0.0 if drive.back_step is None else drive.back_step.angle


def window_of(drive: PlanetLinkage) -> float:
    """Measure: the window over which the output stays within the band that its back-step fills [rad].

    0 without a back-step, or with one of rounding, at the momentary dwell itself
    """
    found = drive.ripple if back_step_of(drive) > 0.0 else None
    return 0.0 if found is None else found.crank_angle


def solved(
    family: Family,
    measure: Callable[[PlanetLinkage], float],
    target: float,
    what: str,
    share: float = 1.0,
    key: str = "",
) -> float:
    """Frame with which the output steps back and a measure that rises with the back-step meets a target.

    Parameters
        measure : `back_step_of` or `window_of`
        target : float [rad] - positive
        what : str - the request in words, for a refusal
        share : float - of the target that the words speak of: a tolerance is half a back-step
        key : str - the key of the request, for the remedy
    Returns
        frame : float [mm]
    Raises
        NoSolution - for a target beyond what the frames reach, naming the limit
    Example
        >>> family = Family(50.0, 80.0, 90.0, 0.375)
        >>> round(solved(family, back_step_of, math.radians(3.3965353000171943), "this back-step"), 9)
        74.216

    Source
        own derivation: back-step and window rise from the momentary dwell to the change point (scans in the tests)
    """
    quiet, steep = stepping(family)
    most = measure(family.drive(steep))
    if not target <= most:
        raise NoSolution(beyond_reach(what, share * most, family.drive(steep), key))
    ends = (-target, most - target)  # at the momentary dwell itself rounding may leave a back-step
    return bracketed_root(lambda frame: measure(family.drive(frame)) - target, quiet, steep, ends=ends)


@lru_cache(8)
def filling(family: Family, tolerance: float) -> float | None:
    """The frame whose back-step fills the band of a tolerance: the dwell is longest; None where none steps back so far.

    Parameters
        tolerance : float [rad] - to either side
    """
    if back_step_of(family.drive(stepping(family)[1])) < 2.0 * tolerance:
        return None
    return solved(family, back_step_of, 2.0 * tolerance, f"a tolerance of {short(math.degrees(tolerance))} deg", 0.5)


def longest(family: Family, tolerance: float) -> tuple[float, float] | None:
    """The frame of the longest dwell within a tolerance; None where no back-step fills the band.

    Parameters
        tolerance : float [rad] - to either side
    Returns
        frame, window : float [mm], float [rad]
    Notes
        Of the frames whose output steps back or just stops. The back-step fills the band, unless the output is so much
        faster at one end of the window than at the other that a shorter back-step leaves more room beside it than it
        costs: of long windows at poor transmission angles.
    Example
        >>> frame, window = longest(Family(18.0, 51.39, 41.202, 62 / 98), math.radians(17.519))
        >>> round(frame, 2), round(math.degrees(window), 6)
        (28.86, 195.27792)

    Source
        own derivation; that there is one hump: scans in the tests
    """
    filled = filling(family, tolerance)
    if filled is None:
        return None
    window = window_of(family.drive(filled))

    def reached(frame: float) -> float:
        return family.drive(frame).within(tolerance).crank_angle

    return _better(family, reached, filled, window) or (filled, window)


def flattest(family: Family, window: float, what: str, *, beyond: bool = False, key: str = "") -> tuple[float, float]:
    """The frame with which the output keeps nearest to its place over a window, and how near.

    Parameters
        window : float [rad]
        what : str - the request in words, for a refusal
        beyond : bool - whether to seek windows too that no back-step fills
        key : str - the key of the window, for the remedy
    Returns
        frame, tolerance : float [mm], float [rad] - of equal ripple; where a shorter back-step serves better (see
            `longest`) the frame of the minimum tolerance
    Raises
        NoSolution - for a window that neither gives
    """
    steep, refusal = stepping(family)[1], None
    try:
        frame = solved(family, window_of, window, what, key=key)
        least = 0.5 * back_step_of(family.drive(frame))
    except NoSolution as error:
        if not beyond:
            raise
        frame, least, refusal = steep, least_band(family.drive(steep).valley, window), error
    better = _better(family, lambda other: -least_band(family.drive(other).valley, window), frame, -least)
    if better is not None:
        return better[0], -better[1]
    if refusal is not None:
        raise refusal
    return frame, least


def _better(
    family: Family, measure: Callable[[float], float], frame: float, value: float
) -> tuple[float, float] | None:
    """Frame and value where a measure has its maximum behind a frame, towards the quieter ones; None at its edge."""
    quiet = stepping(family)[0]
    probes = (measure(frame + share * (quiet - frame)) for share in _PROBES)
    if not any(probe - value > _PROBED * abs(value) for probe in probes):
        return None
    return maximum(measure, frame, quiet)


# Of a ring gear whose output steps back with every frame: such drives have no momentary dwell


def always_stepping(family: Family) -> AlwaysStepping | None:
    """The frames of a family whose output steps back with each of them; None of one with a momentary dwell, or without
    any standstill.

    Raises
        NoSolution - where no frame makes a linkage that turns
    Example
        >>> found = always_stepping(Family(25.0, 45.28, 72.727, 44 / 69))
        >>> round(found.step(87.613), 6), round(found.window(87.613, 0.0035), 6)
        (0.006966, 1.071927)
    """
    if not family.ring or stationary_frames(family):
        return None
    low, high = sorted((steep_end(family), quiet_end(family)))
    if family.drive(0.5 * (low + high)).back_step is None:  # as many standstills as with every other frame
        return None
    return AlwaysStepping(lambda frame: family.drive(frame).valley, low, high)
