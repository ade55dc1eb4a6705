"""Checks that several geared linkages share: transmission angle, what a synthesis reached."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.judged import Judged, below
from gearlink.core.base.report import Check, Shown, safely_above, without_noise
from gearlink.core.base.wording import short, unlike
from gearlink.core.parts.linkages.codes import DWELL_EDGE, DWELL_WINDOW, TARGET, TRANSMISSION_ANGLE

if TYPE_CHECKING:
    from gearlink.core.parts.linkages.fourbar.position import FourBar

_POOR = math.radians(3.0)
_LITTLE = 5.0
"""So much above its limit a transmission angle is no longer called little [deg]."""
EDGE = 0.992  # back-step over band from which on a frame a little off may lose a quarter of the window
_NARROW = 0.05  # mm, an interval of the frame that a workshop holds with care
WINDOW_FIT = 1e-9
_LINK_TOLERANCE = 1e-9


def transmission_check(
    angle: float, limit: float, remedy: str, subject: str = "minimum transmission angle", *, at: str = ""
) -> Check:
    """GL303: the least transmission angle [rad] against its limit [deg]; near a dead point with the condition number.

    Source
        VDI 2142
    """
    value, note = math.degrees(angle), ""
    if angle < _POOR:
        enlarged = f"up to {short(1.0 / math.sin(angle))} times" if angle else "without bound"
        note = f"clearance and rounding errors are magnified {enlarged} there (condition number)"
    return TRANSMISSION_ANGLE.below(value, limit, limit + _LITTLE, "deg", subject, remedy, at=at, note=note)


def recommended_angle(limit: float) -> float:
    """The minimum transmission angle above which GL303 no longer warns [deg]."""
    return limit + _LITTLE


def transmission_judged(value: Any, limit: Any) -> Judged:
    """GL303 of minimum transmission angles [deg]."""
    return below(TRANSMISSION_ANGLE, value, limit, limit + _LITTLE, "deg")


def target_check(what: str, residual: float, tolerance: float, unit: str, key: str = "") -> Check:
    """GL307: the residual of a synthesis, measured on the motion of the design that it gives.

    Parameters
        key : str - of the tolerance; without one the target is to be met
    """
    met = abs(residual) <= tolerance
    shown = without_noise(residual, 360.0) if unit == "deg" else residual
    compared = Shown(abs(shown), tolerance, unit, "<=")
    fix = "let more of the links change"
    if key:
        fix = f"set {key} to at least {safely_above(abs(residual))} {unit} (relaxes the requirement)"
    return TARGET.check(
        "pass" if met else "fail", f"deviation of {what}", residual, tolerance, unit, shown=compared, fix=fix
    )


def window_judged(window: Any, asked: Any) -> Judged:
    """GL313 of windows [deg]: they are as long as those asked for, but for rounding."""
    return Judged(DWELL_WINDOW, window, asked, (window >= asked * (1.0 - WINDOW_FIT)) ^ True, False, "deg")


def dwell_window_check(window: float, asked: float, tolerance: float, remedy: str = "") -> Check:
    """GL313: the crank angle over which the output stays within +- a tolerance, against the one asked for [all rad]."""
    got, wanted, band = math.degrees(window), math.degrees(asked), math.degrees(tolerance)
    fix = remedy or "reduce the dwell window, or allow a larger tolerance"
    return window_judged(got, wanted).check("dwell window", fix, aside=f"output within +-{short(band)} deg")


def dwell_edge_check(share: float, interval: list[float] | None) -> Check:
    """GL314: how near a window is to its jump, by the share of its band that the back-step takes, or by the frames.

    Parameters
        share : float - back-step over band
        interval : list of 2 float [mm] - frames between which the request is met, where there is one
    """
    width = None if interval is None else interval[1] - interval[0]
    found, fix = edge_judged(share), "reduce dwell.window"
    if not found.warns and width is not None and width < _NARROW:
        what = "range of the frame that gives the dwell"
        return DWELL_EDGE.check("warn", what, width, _NARROW, "mm", side=">=", fix=fix)
    what, aside = "share of the dwell band that the back-step takes", ""
    if share > 1.0 + WINDOW_FIT:
        aside = "the output dwells about only one of its two positions of zero velocity"
    elif width is not None:
        aside = f"the frame may vary by {short(width)} mm"
    note = "a frame error can shorten the dwell by a quarter" if found.warns else ""
    shown = Shown(share, EDGE if found.warns else None, "1", "<=")
    return found.check(what, fix, side=">=" if share > EDGE else None, aside=aside, note=note, shown=shown)


def edge_judged(share: Any) -> Judged:
    """GL314 of the shares of bands that back-steps take."""
    return Judged(DWELL_EDGE, share, EDGE, False, (share > EDGE) & (share <= 1.0 + WINDOW_FIT), "1")


def of_gears(link: str, given: float | None, distance: float, gears: Any) -> float:
    """The length of a link that is the centre distance of two gears; given too, it must agree.

    Parameters
        link : str - its key below `links`
        given, distance : float [mm] - in the file, and by the gears
        gears : the section; with profile shifts a length in the file is what the distance was found for
    Returns
        length : float [mm]
    Raises
        NoSolution - for another length in the file
    """
    if given is not None and gears.profile_shift is None and abs(given - distance) > _LINK_TOLERANCE * distance:
        raise NoSolution(
            f"{link}: {unlike(given, distance)} mm (centre distance of the gears {unlike(distance, given)} mm)",
            key=f"links.{link}",
            fix="omit it, or change module or teeth",
        )
    return distance


def check_linkage(linkage: FourBar) -> str:
    """Kind of a linkage that may drive the gears, 'crank-rocker' or 'drag-link'; any other is refused.

    Raises
        NoSolution - for a linkage whose crank does not turn fully, and for a change-point linkage
    Example
        >>> from gearlink.core.parts.linkages.fourbar.position import FourBar
        >>> check_linkage(FourBar(18.0, 50.0, 100.0, 121.4))
        'crank-rocker'

    Source
        thesis 4.1.4: the input must turn; Grashof's rule
    """
    kind = linkage.kind()
    if kind in ("crank-rocker", "drag-link"):
        return kind
    shortest, p, q, longest = sorted((linkage.crank, linkage.coupler, linkage.rocker, linkage.frame))
    excess = math.fsum((shortest, longest, -p, -q))
    wrong = (
        f"Grashof: {short(shortest)} + {short(longest)} {'=' if excess == 0.0 else '>'} {short(p)} + {short(q)}"
        if excess >= 0.0
        else "neither crank nor frame is the shortest link"
    )
    found = "the four links cannot be assembled" if kind == "impossible" else f"the linkage is a {kind}"
    if kind == "change-point":
        found = "the linkage is at its change point"
    raise NoSolution(
        f"{found}, not a crank-rocker or drag link ({wrong}): crank {short(linkage.crank)}, coupler "
        f"{short(linkage.coupler)}, rocker {short(linkage.rocker)}, frame {short(linkage.frame)} mm",
        fix=_full_turn(excess, shortest, longest, linkage),
    )


def _full_turn(excess: float, shortest: float, longest: float, linkage: FourBar) -> str:
    """What lets the crank turn fully: only conditions that are not met."""
    changes = []
    if excess > 0.0:
        changes.append(f"shorten the longest link, {short(longest)} mm, by more than {safely_above(excess)} mm")
    elif excess == 0.0:
        changes.append(f"shorten the longest link, {short(longest)} mm")
    if shortest < min(linkage.crank, linkage.frame):
        changes.append("make crank or frame the shortest link")
    return ", and ".join(changes)
