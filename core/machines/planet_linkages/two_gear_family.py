"""Two-gear four-bars of given gears, coupler and rocker in one unknown, the frame: momentary dwell, back-step, window.

From the frame of the momentary dwell on the output steps back, the further the nearer its frame is to the change point;
see `two_gear_frames` for both.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.planet_linkages.planet import PlanetLinkage
from gearlink.core.machines.planet_linkages.two_gear_frames import (
    Family,
    beyond_reach,
    frame_range,
    momentary_frame,
    stationary_frames,
)
from gearlink.core.numerics.gauss import integral
from gearlink.core.numerics.roots import bracketed_root, maximum
from gearlink.core.parts.linkages import standstills
from gearlink.core.parts.linkages.band_dwell import AlwaysStepping, ToleranceDwell, Valley, least_band, longest_in_band
from gearlink.core.parts.linkages.standstills import BackStep, Turning

_BEFORE_CHANGE_POINT = 1e-6  # share of a range of frames left out at the end where the linkage flattens
_PROBES = (1e-3, 1e-2, 0.1)  # shares of the way to the momentary dwell at which a hump shows
_PROBED = 1e-9
_TURN = 2.0 * math.pi


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


@lru_cache(8)
def turnings(drive: PlanetLinkage) -> tuple[Turning, ...]:
    """Extremes of the speed ratio over the turn."""
    return tuple(standstills.turnings(drive.speed, drive.acceleration))


def back_step(drive: PlanetLinkage) -> BackStep | None:
    """The back-step of an output that makes one, else None.

    Notes
        The angle of a short back-step is the integral of the speed, as it would cancel in the difference of angles.
    """
    places = standstills.standstills(drive.speed, turnings(drive), 0.0)
    steps = standstills.back_steps(drive.speed, drive.angle, places)
    if not steps:
        return None
    step = max(steps, key=lambda one: one.angle)
    return step._replace(angle=-_gain(drive, _strip(drive), step.start, step.end))


def _strip(drive: PlanetLinkage) -> float:
    """How far from the real crank angles the speed is analytic [rad]: to a dead centre, and to where B meets D."""
    links = drive.linkage
    return min(links.min_transmission_angle(), abs(math.log(links.frame / links.crank)))


def _gain(drive: PlanetLinkage, strip: float, start: float, end: float) -> float:
    """Output angle gained from one crank angle to another, over a short way as the integral of the speed."""
    if abs(end - start) < 0.5 * strip:
        return integral(drive.speed, start, end)
    return drive.angle(end) - drive.angle(start)


def tolerance_dwell(drive: PlanetLinkage, tolerance: float) -> ToleranceDwell:
    """Longest crank interval over which the output stays within +- a tolerance [rad] of a place that is free.

    Raises
        NoSolution - for a tolerance that is not positive, or so wide that the whole revolution lies within it
    Notes
        See `gearlink.core.parts.linkages.band_dwell`; the speed runs one way between the extremes beside the least one.
    """
    return longest_in_band(valley(drive), tolerance)


def valley(drive: PlanetLinkage) -> Valley:
    """The part of the turn around the minimum speed."""
    extremes, step = turnings(drive), back_step(drive)
    at = min(range(len(extremes)), key=lambda i: extremes[i].value)
    least = extremes[at].place
    before, after = extremes[at - 1].place, extremes[(at + 1) % len(extremes)].place
    first = second = least
    if step is not None:
        first = least - (least - step.start) % _TURN
        second = first + step.crank_angle
    low, high = least - (least - before) % _TURN, least + (after - least) % _TURN
    return Valley(drive.angle, drive.speed, first, second, low, high, drive.mean_ratio())


def back_step_of(drive: PlanetLinkage) -> float:
    """Measure: the back-step D [rad]."""
    step = back_step(drive)
    return 0.0 if step is None else step.angle


def window_of(drive: PlanetLinkage) -> float:
    """Measure: the window over which the output stays within the band that its back-step fills [rad].

    phi5(L) = phi5(phi(2)),   phi5(R) = phi5(phi(1)),   window = R - L,   band = D = 2 tau; 0 without a back-step
    """
    step = back_step(drive)
    if step is None or step.angle <= 0.0:  # one of rounding, at the momentary dwell itself
        return 0.0
    strip, start, end = _strip(drive), step.start, step.end
    ends = (-step.angle, drive.angle(start + _TURN) - drive.angle(start))
    before = bracketed_root(lambda x: _gain(drive, strip, end - x, end), step.crank_angle, _TURN, ends=ends)
    after = bracketed_root(lambda x: _gain(drive, strip, start, start + x), step.crank_angle, _TURN, ends=ends)
    return before + after - step.crank_angle


def solved(
    family: Family, measure: Callable[[PlanetLinkage], float], target: float, what: str, share: float = 1.0
) -> float:
    """Frame with which the output steps back and a measure that rises with the back-step meets a target.

    Parameters
        measure : `back_step_of` or `window_of`
        target : float [rad] - positive
        what : str - the request in words, for a refusal
        share : float - of the target that the words speak of: a tolerance is half a back-step
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
        raise NoSolution(beyond_reach(what, share * most, family.drive(steep)))
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
    return solved(family, back_step_of, 2.0 * tolerance, f"a tolerance of {math.degrees(tolerance):.9g} deg", 0.5)


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
        return tolerance_dwell(family.drive(frame), tolerance).crank_angle

    return _better(family, reached, filled, window) or (filled, window)


def flattest(family: Family, window: float, what: str, *, beyond: bool = False) -> tuple[float, float]:
    """The frame with which the output keeps nearest to its place over a window, and how near.

    Parameters
        window : float [rad]
        what : str - the request in words, for a refusal
        beyond : bool - whether to seek windows too that no back-step fills
    Returns
        frame, tolerance : float [mm], float [rad] - of equal ripple; where a shorter back-step serves better (see
            `longest`) the frame of the minimum tolerance
    Raises
        NoSolution - for a window that neither gives
    """
    steep, refusal = stepping(family)[1], None
    try:
        frame = solved(family, window_of, window, what)
        least = 0.5 * back_step_of(family.drive(frame))
    except NoSolution as error:
        if not beyond:
            raise
        frame, least, refusal = steep, least_band(valley(family.drive(steep)), window), error
    better = _better(family, lambda other: -least_band(valley(family.drive(other)), window), frame, -least)
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
    if back_step(family.drive(0.5 * (low + high))) is None:  # as many standstills as with every other frame
        return None
    return AlwaysStepping(lambda frame: valley(family.drive(frame)), low, high)
