"""Checks that several gear-linkages share: transmission angle, what a synthesis reached."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.judged import Judged, below
from gearlink.core.base.report import Check, safely_above, without_noise
from gearlink.core.parts.linkages.codes import DWELL_EDGE, DWELL_WINDOW, TARGET, TRANSMISSION_ANGLE

if TYPE_CHECKING:
    from gearlink.core.parts.linkages.fourbar.position import FourBar

_POOR = math.radians(3.0)
_LITTLE = 5.0
"""So much above its limit a transmission angle is no longer called little [deg]."""
EDGE = 0.992  # back-step over band from which on a frame a little off may lose a quarter of the window
_NARROW = 0.05  # mm, an interval of the frame that a workshop holds with care
WINDOW_FIT = 1e-9


def transmission_check(
    angle: float, limit: float, remedy: str, subject: str = "the least transmission angle over the turn"
) -> Check:
    """GL303: the least transmission angle [rad] against its limit [deg]; near a dead point with the condition number.

    Source
        VDI 2142
    """
    value = math.degrees(angle)
    if angle < _POOR:
        condition = 1.0 / math.sin(angle) if angle else math.inf
        remedy = f"play and rounding come out up to {condition:.3g} times as large (condition number); {remedy}"
    return TRANSMISSION_ANGLE.below(value, limit, limit + _LITTLE, "deg", subject, remedy)


def transmission_judged(value: Any, limit: Any) -> Judged:
    """GL303 of least transmission angles [deg]."""
    return below(TRANSMISSION_ANGLE, value, limit, limit + _LITTLE, "deg")


def target_check(what: str, residual: float, tolerance: float, unit: str) -> Check:
    """GL307: the residual of a synthesis, measured on the motion of the design that it gives."""
    met = abs(residual) <= tolerance
    shown = without_noise(residual, 360.0) if unit == "deg" else residual
    text = f"{what} is missed by {shown:.3g} {unit}"
    if not met:
        text += f", more than {tolerance:.3g} {unit}: ask for less, or free more of the links"
    return TARGET.check("pass" if met else "fail", text, residual, tolerance, unit)


def window_judged(window: Any, asked: Any) -> Judged:
    """GL313 of windows [deg]: they are as long as those asked for, but for rounding."""
    return Judged(DWELL_WINDOW, window, asked, (window >= asked * (1.0 - WINDOW_FIT)) ^ True, False, "deg")


def dwell_window_check(window: float, asked: float, tolerance: float, remedy: str = "") -> Check:
    """GL313: the crank angle over which the output stays within +- a tolerance, against the one asked for [all rad]."""
    got, wanted, band = math.degrees(window), math.degrees(asked), math.degrees(tolerance)
    text = f"the output stays within +-{band:g} deg over {got:.6g} deg of the crank"
    words = f", {wanted:g} deg were asked for: {remedy or 'ask for less, or allow a greater tolerance'}"
    return window_judged(got, wanted).check(text, words)


def dwell_edge_check(share: float, interval: list[float] | None) -> Check:
    """GL314: how near a window is to its jump, by the share of its band that the back-step takes, or by the frames.

    Parameters
        share : float - back-step over band
        interval : list of 2 float [mm] - frames between which the request is met, where there is one
    """
    text = f"the back-step takes {share:.5g} of the band"
    if share > 1.0 + WINDOW_FIT:
        text = f"the back-step is {share:.5g} times the band: the output dwells about one of its standstills"
    width = None if interval is None else interval[1] - interval[0]
    if width is not None:
        text += f"; the frame may lie within {width:.4g} mm"
    found = edge_judged(share)
    if not found.warns and width is not None and width < _NARROW:
        text += f", less than {_NARROW} mm: ask for a shorter window or a greater tolerance"
        return DWELL_EDGE.check("warn", text, width, _NARROW, "mm")
    remedy = ": a frame a little off makes it exceed the band and costs a quarter of the window; ask for less"
    return found.check(text, remedy, side=">=" if share > EDGE else None)


def edge_judged(share: Any) -> Judged:
    """GL314 of the shares of bands that back-steps take."""
    return Judged(DWELL_EDGE, share, EDGE, False, (share > EDGE) & (share <= 1.0 + WINDOW_FIT), "1")


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
    remedies = []
    if excess >= 0.0 or kind in ("change-point", "impossible"):
        remedies.append(
            f"shorten the longest link, {longest:.9g} mm, by more than {safely_above(max(excess, 0.0), 3)} mm"
        )
    if shortest < min(linkage.crank, linkage.frame):
        remedies.append("make crank or frame the shortest link")
    remedy = " and ".join(remedies)
    raise NoSolution(
        f"crank {linkage.crank:.9g}, coupler {linkage.coupler:.9g}, rocker {linkage.rocker:.9g}, frame "
        f"{linkage.frame:.9g} mm form a linkage that is {kind}; the drive needs a crank-rocker or a drag link: "
        "shortest + longest link must be below the sum of the other two, crank or frame the shortest; "
        f"{remedy}"
    )
