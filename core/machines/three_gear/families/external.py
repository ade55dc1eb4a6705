"""Linkages of any three external gears in one unknown, along which every task rises: one bracketed root solves each.

Gears fix coupler and rocker; a task (a back-step, a dwell, a swing of the speed) fixes one of crank and frame. The
other is given, or the linkage is balanced: its transmission angle deviates equally at both ends,

    given crank e:   unknown d in (max(d*(e), |b - c| + e, e), b + c - e)
    given frame d:   unknown e in (e*(d), min(d - |b - c|, b + c - d))
    balanced:        d^2 = b^2 + c^2 - e^2, unknown e in (e_bal, min(b, c))

with d*(e), e*(d) and e_bal of the momentary dwell, where the back-step begins. Back-step, phi12, phi13 and the window
of equal ripple rise along each of them; the speed swing W_max - W_min too.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_above, safely_below
from gearlink.core.machines.three_gear.dwell.dwells import back_step, dwell_angle, gain
from gearlink.core.machines.three_gear.dwell.momentary_dwell import (
    balanced_eccentricity,
    eccentricity_for_frame,
    eccentricity_range,
    least_eccentricity,
    momentary_frame_length,
    wrap,
)
from gearlink.core.machines.three_gear.motion import GearTrain, forward, output_angle, speed_extremes
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.parts.linkages.fourbar.position import FourBar
from gearlink.core.parts.linkages.standstills import BackStep

_AFTER_LOW, _BEFORE_HIGH = 1e-12, 1e-6  # shares of a range left out: at its high end stands a change-point linkage


@dataclass(frozen=True, slots=True)
class Family:
    """Linkages in one unknown length.

    linkage : of the unknown [mm]
    least, high : the range of the unknown [mm]
    low : the value [mm] at which the output just stops, or `least`; None where it never stops
    why : str - the reason for that
    """

    linkage: Callable[[float], FourBar]
    least: float
    low: float | None
    high: float
    why: str = ""

    def ends(self) -> tuple[float, float]:
        """The range of linkages that turn, without its ends."""
        return self._inside(self.least, _BEFORE_HIGH)

    def stepping(self) -> tuple[float, float]:
        """The range of linkages whose output steps back, without its ends.

        Raises
            NoSolution - where none does
        """
        if self.low is None:
            raise NoSolution(self.why)
        return self._inside(self.low, _AFTER_LOW)

    def _inside(self, low: float, margin: float) -> tuple[float, float]:
        width = self.high - low
        return low + margin * width, self.high - _BEFORE_HIGH * width


@dataclass(frozen=True, slots=True)
class Ripple:
    """A dwell whose band the back-step fills.

    start, crank_angle : float [rad] - where the window starts, in [0, 2 pi), and its length
    tolerance : float [rad] - half the band
    output_angle : float [rad] - the middle of the band, counted from the crank angle 0 with the start as it stands
    """

    start: float
    crank_angle: float
    tolerance: float
    output_angle: float


def frames_of(crank: float, b: float, c: float) -> tuple[float, float]:
    """The shortest and the longest frame in which a crank turns [mm].

    Raises
        NoSolution - for a crank that turns in none
    """
    least, high = max(abs(b - c) + crank, crank), b + c - crank
    if not least < high:
        raise NoSolution(
            f"a crank of {crank:.9g} mm cannot turn with a coupler of {b:.9g} and a rocker of {c:.9g} mm: it must be "
            f"shorter than {min(b, c):.9g} mm"
        )
    return least, high


def longest_crank(frame: float, b: float, c: float) -> float:
    """The longest crank that turns in a frame [mm].

    Raises
        NoSolution - for a frame in which none turns
    """
    high = min(frame - abs(b - c), b + c - frame, frame)
    if not high > 0.0:
        raise NoSolution(
            f"no crank turns in a frame of {frame:.9g} mm with a coupler of {b:.9g} and a rocker of {c:.9g} mm: it "
            f"must lie between {abs(b - c):.9g} and {b + c:.9g} mm"
        )
    return high


def with_crank(r1: float, r3: float, r5: float, crank: float, assembly: int = 1) -> Family:
    """The linkages of a given crank.

    Parameters
        r1, r3, r5 : float [mm] - reference radii of crank gear, idler and output gear
        crank : float [mm] - e
    Raises
        NoSolution - for a crank that cannot turn
    """
    b, c = r1 + r3, r3 + r5
    least, high = frames_of(crank, b, c)
    e_lo, e_up = _momentary_range(r1, r3, r5)
    low: float | None = least
    if crank <= e_lo:
        low = None
    elif crank < e_up:
        low = max(least, momentary_frame_length(r1, r3, r5, crank))
    why = f"a crank of {crank:.9g} mm never stops the output: it must be longer than {e_lo:.9g} mm"
    return Family(lambda d: FourBar(crank, b, c, d, assembly), least, low, high, why)


def with_frame(r1: float, r3: float, r5: float, frame: float, assembly: int = 1) -> Family:
    """The linkages of a given frame.

    Raises
        NoSolution - for a frame with which no crank-rocker exists
    """
    b, c = r1 + r3, r3 + r5
    high = longest_crank(frame, b, c)
    try:
        low = eccentricity_for_frame(r1, r3, r5, frame)
    except NoSolution:
        low = 0.0
    return Family(lambda e: FourBar(e, b, c, frame, assembly), 0.0, min(low, high), high)


def balanced(r1: float, r3: float, r5: float, assembly: int = 1) -> Family:
    """The linkages whose transmission angle deviates from 90 deg equally at both ends."""
    b, c = r1 + r3, r3 + r5

    def linkage(e: float) -> FourBar:
        return FourBar(e, b, c, math.sqrt((b - e) * (b + e) + c * c), assembly)

    try:
        return Family(linkage, 0.0, balanced_eccentricity(r1, r3, r5), min(b, c))
    except NoSolution as error:
        return Family(linkage, 0.0, None, min(b, c), error.message)


def solved(
    family: Family, measure: Callable[[FourBar], float], target: float, what: str, share: float = 1.0
) -> FourBar:
    """The linkage of a family whose output steps back and whose rising measure meets a target.

    Parameters
        measure : of a back-step [rad], such as `window_of`; rises along the family
        target : float [rad]
        what : str - the request in words, for a refusal
        share : float - of the target that the words speak of: a tolerance is half a back-step
    Raises
        NoSolution - for a target beyond the family, naming its limits
    """
    low, high = family.stepping()
    least, most = measure(family.linkage(low)), measure(family.linkage(high))
    if most <= 0.0:
        raise NoSolution(f"{what} cannot be had: no linkage with this crank or frame makes the output step back")
    if not target <= most:
        angle = f"{math.degrees(family.linkage(high).min_transmission_angle()):.3g}"
        raise NoSolution(
            f"{what} is more than these gears reach, {_deg(share * most)} deg, and that with a "
            f"transmission angle of {angle} deg; ask for less"
        )
    if not target >= least:
        raise NoSolution(
            f"{what} is less than that of any crank-rocker with this crank: its output steps back with every frame, "
            f"and the least is {_deg(share * least)} deg; take a shorter crank"
        )
    ends = (least - target, most - target)
    return family.linkage(bracketed_root(lambda x: measure(family.linkage(x)) - target, low, high, ends=ends))


def filling(family: Family, train: GearTrain, band: float) -> FourBar | None:
    """The linkage whose back-step fills a band, of which the dwell is longest; None where none steps back so far.

    Parameters
        band : float [rad] - the tolerance to either side
    Raises
        NoSolution - for a family of which each back-step is wider
    """
    measure = back_step_of(train)
    if 0.0 < measure(family.linkage(family.stepping()[1])) < 2.0 * band:
        return None
    return solved(family, measure, 2.0 * band, f"a tolerance of {_deg(band)} deg", 0.5)


def with_speed_quotient(family: Family, train: GearTrain, quotient: float) -> FourBar:
    """The linkage of a family whose least output speed is a given part of the greatest.

    W_min/W_max = quotient

    Parameters
        quotient : float - below 1; negative for an output that steps back
    Raises
        NoSolution - for a quotient that the family does not reach, naming its limits
    """

    def reached(x: float) -> float:
        linkage = family.linkage(x)
        found = speed_extremes(linkage, forward(linkage, train))
        return found.least / found.greatest

    low, high = family.ends()
    most, least = reached(low), reached(high)
    if not min(least, most) <= quotient <= max(least, most):
        raise NoSolution(
            f"no linkage of these gears gives min/max = {quotient:.6g}: it must lie between "
            f"{safely_above(min(least, most), 4)} and {safely_below(max(least, most), 4)}"
        )
    ends = (most - quotient, least - quotient)
    return family.linkage(bracketed_root(lambda x: reached(x) - quotient, low, high, ends=ends))


def ripple(linkage: FourBar, train: GearTrain) -> Ripple:
    """The window over which the output stays within the band that its back-step fills.

    phi5(L) = phi5(phi(2)),   phi5(R) = phi5(phi(1)),   window = R - L,   band = D = 2 tau

    Raises
        NoSolution - where the output does not step back
    Example
        >>> found = ripple(FourBar(18.0, 50.0, 100.0, 120.79635262063678), GearTrain(20, 20, 60))
        >>> round(math.degrees(found.crank_angle), 6), round(math.degrees(found.tolerance), 6)
        (108.824649, 0.5)
    """
    given, train = train, forward(linkage, train)
    step = back_step(linkage, train)
    end = step.start + step.crank_angle
    ends = (min(-step.angle, 0.0), gain(linkage, train, end - 2.0 * math.pi, 2.0 * math.pi))
    before = bracketed_root(lambda x: gain(linkage, train, end - x, x), step.crank_angle, 2.0 * math.pi, ends=ends)
    after = dwell_angle(linkage, train, step)
    start = wrap(end - before)
    middle = output_angle(linkage, train, start) + 0.5 * step.angle
    return Ripple(start, before + after - step.crank_angle, 0.5 * step.angle, given.sense * train.sense * middle)


def back_step_of(train: GearTrain) -> Callable[[FourBar], float]:
    """Measure: the back-step D [rad]."""
    return _measure(train, lambda _, step: step.angle)


def back_step_crank_angle_of(train: GearTrain) -> Callable[[FourBar], float]:
    """Measure: the crank angle phi12 [rad] of the back-step."""
    return _measure(train, lambda _, step: step.crank_angle)


def dwell_angle_of(train: GearTrain) -> Callable[[FourBar], float]:
    """Measure: phi13 [rad]."""
    return _measure(train, lambda linkage, step: dwell_angle(linkage, train, step))


def window_of(train: GearTrain) -> Callable[[FourBar], float]:
    """Measure: the window of equal ripple [rad]."""
    return _measure(train, lambda linkage, _: ripple(linkage, train).crank_angle)


def _measure(train: GearTrain, of_step: Callable[[FourBar, BackStep], float]) -> Callable[[FourBar], float]:
    def measure(linkage: FourBar) -> float:
        try:
            step = back_step(linkage, train)
        except NoSolution:
            return 0.0
        return of_step(linkage, step)

    return measure


def _momentary_range(r1: float, r3: float, r5: float) -> tuple[float, float]:
    try:
        return eccentricity_range(r1, r3, r5)
    except NoSolution:
        low = least_eccentricity(r1, r3, r5)
        return low, low


def _deg(angle: float) -> str:
    return f"{math.degrees(angle):.9g}"
