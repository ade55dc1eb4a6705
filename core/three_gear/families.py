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

from gearlink.core.errors import NoSolution
from gearlink.core.linkages.fourbar import FourBar
from gearlink.core.linkages.standstills import BackStep
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.three_gear.dwells import back_step, dwell_angle, gain
from gearlink.core.three_gear.momentary_dwell import (
    balanced_eccentricity,
    eccentricity_for_frame,
    eccentricity_range,
    momentary_frame_length,
)
from gearlink.core.three_gear.motion import GearTrain, speed_extremes

_AFTER_LOW, _BEFORE_HIGH = 1e-12, 1e-6  # shares of a range left out: at its high end stands a change-point linkage


@dataclass(frozen=True, slots=True)
class Family:
    """Linkages in one unknown length.

    linkage : of the unknown [mm]
    low, high : the range of the unknown [mm]; at low the output just stops, or the linkage folds
    unknown : 'frame' or 'crank'
    """

    linkage: Callable[[float], FourBar]
    low: float
    high: float
    unknown: str

    def ends(self) -> tuple[float, float]:
        """The range without its ends."""
        width = self.high - self.low
        return self.low + _AFTER_LOW * width, self.high - _BEFORE_HIGH * width


@dataclass(frozen=True, slots=True)
class Ripple:
    """A dwell whose band the back-step fills: start and crank angle [rad] of the window, the band's half [rad]."""

    start: float
    crank_angle: float
    tolerance: float


def with_crank(r1: float, r3: float, r5: float, crank: float, assembly: int = 1) -> Family:
    """The linkages of a given crank.

    Parameters
        r1, r3, r5 : float [mm] - reference radii of crank gear, idler and output gear
        crank : float [mm] - e
    Raises
        NoSolution - for a crank with which no crank-rocker exists
    """
    b, c = r1 + r3, r3 + r5
    low, high = max(abs(b - c) + crank, crank), b + c - crank
    if not low < high:
        raise NoSolution(
            f"a crank of {crank:.9g} mm cannot turn with a coupler of {b:.9g} and a rocker of {c:.9g} mm: it must be "
            f"shorter than {min(b, c):.9g} mm"
        )
    e_lo, e_up = _momentary_range(r1, r3, r5)
    if crank <= e_lo:
        raise NoSolution(
            f"a crank of {crank:.9g} mm never stops the output, whatever the frame: it must be longer than "
            f"{e_lo:.9g} mm"
        )
    if crank < e_up:
        low = max(low, momentary_frame_length(r1, r3, r5, crank))
    return Family(lambda d: FourBar(crank, b, c, d, assembly), low, high, "frame")


def with_frame(r1: float, r3: float, r5: float, frame: float, assembly: int = 1) -> Family:
    """The linkages of a given frame.

    Raises
        NoSolution - for a frame with which no crank-rocker exists
    """
    b, c = r1 + r3, r3 + r5
    high = min(frame - abs(b - c), b + c - frame, frame)
    if not high > 0.0:
        raise NoSolution(
            f"no crank turns in a frame of {frame:.9g} mm with a coupler of {b:.9g} and a rocker of {c:.9g} mm: it "
            f"must lie between {abs(b - c):.9g} and {b + c:.9g} mm"
        )
    try:
        low = eccentricity_for_frame(r1, r3, r5, frame)
    except NoSolution:
        low = 0.0
    return Family(lambda e: FourBar(e, b, c, frame, assembly), min(low, high), high, "crank")


def balanced(r1: float, r3: float, r5: float, assembly: int = 1) -> Family:
    """The linkages whose transmission angle deviates from 90 deg equally at both ends."""
    b, c = r1 + r3, r3 + r5

    def linkage(e: float) -> FourBar:
        return FourBar(e, b, c, math.sqrt((b - e) * (b + e) + c * c), assembly)

    return Family(linkage, balanced_eccentricity(r1, r3, r5), min(b, c), "crank")


def solved(family: Family, measure: Callable[[FourBar], float], target: float, what: str) -> FourBar:
    """The linkage of a family whose rising measure meets a target.

    Parameters
        measure : rises along the family, 0 where the output does not step back
        target : float - above 0
        what : str - the wish in words, for a refusal
    Raises
        NoSolution - for a target beyond the family, naming its limits
    Notes
        The two-thirds power of the difference would be linear near the momentary dwell; the bracketing method needs a
        few steps more without it and keeps the last bit.
    """
    low, high = family.ends()
    least, most = measure(family.linkage(low)), measure(family.linkage(high))
    if not target <= most:
        raise NoSolution(f"{what} is beyond what a linkage of these gears reaches, {_deg(most)} deg")
    if not target >= least:
        raise NoSolution(f"{what} is less than the least of these linkages, {_deg(least)} deg: take a shorter crank")
    return family.linkage(bracketed_root(lambda x: measure(family.linkage(x)) - target, low, high))


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
    step = back_step(linkage, train)
    end = step.start + step.crank_angle
    before = bracketed_root(lambda x: gain(linkage, train, end - x, x), step.crank_angle, 2.0 * math.pi)
    after = dwell_angle(linkage, train, step)
    return Ripple((end - before) % (2.0 * math.pi), before + after - step.crank_angle, 0.5 * step.angle)


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


def speed_quotient_of(train: GearTrain) -> Callable[[FourBar], float]:
    """Measure: -W_min/W_max, which rises with the frame."""

    def quotient(linkage: FourBar) -> float:
        found = speed_extremes(linkage, train)
        return -found.least / found.greatest

    return quotient


def _measure(train: GearTrain, of_step: Callable[[FourBar, BackStep], float]) -> Callable[[FourBar], float]:
    def measure(linkage: FourBar) -> float:
        try:
            step = back_step(linkage, train)
        except NoSolution:
            return 0.0
        return of_step(linkage, step)

    return measure


def _momentary_range(r1: float, r3: float, r5: float) -> tuple[float, float]:
    from gearlink.core.three_gear.momentary_dwell import least_eccentricity

    try:
        return eccentricity_range(r1, r3, r5)
    except NoSolution:
        low = least_eccentricity(r1, r3, r5)
        return low, low


def _deg(angle: float) -> str:
    return f"{math.degrees(angle):.9g}"
