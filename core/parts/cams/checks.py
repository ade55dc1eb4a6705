"""Checks that every cam pair has: pressure angle, undercut, steps at the joints of the law."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.remedies.ways import THINNEST
from gearlink.core.base.report import NO_NUMBER, Check, Rule, Shown, Status, safely_above, safely_below, without_noise
from gearlink.core.base.wording import amount, short
from gearlink.core.parts.cams.codes import CAM_UNDERCUT, LARGER, PRESSURE_ANGLE

if TYPE_CHECKING:
    from gearlink.core.numerics.extremes import Extreme
    from gearlink.core.parts.cams.disc_cam import DiscCam
    from gearlink.core.parts.cams.flat_cam import FlatCam


# A hub of 1.5 times the shaft is the usual minimum, a roller of 0.8 of the minimum curvature radius the usual most.
HUB = 1.5
ROLLER_SHARE = 0.8
AS_THICK_AS_ROLLER = "a shaft as thick as the roller"
WITHOUT_STEP = "remove the step of the lift's velocity at cam angle {} deg"
_SIZED = 1.0 + 1e-9
_FIT = 1e-11
"""Of the limit: cams that are sized to it came out up to 2e-13 above it."""


def impossible(what: str, refusal: NoSolution, limit: float) -> Check:
    """GL401 for cams that cannot be at all, and why."""
    return PRESSURE_ANGLE.check("fail", f"{what}: {refusal.message}", None, limit, "deg", fix=refusal.fix)


def is_steep(value: float, limit: float) -> bool:
    """Whether a pressure angle is above its limit by more than cams that are sized to it are off, which is rounding.

    Example
        >>> is_steep(28.000000000002, 28.0), is_steep(28.000001, 28.0)
        (False, True)
    """
    return value > limit * (1.0 + _FIT)


def pressure_angle_checks(cams: Sequence[DiscCam | FlatCam], limit: float, remedy: str) -> Iterator[Check]:
    """GL401 for each cam; `limit` in degrees."""
    for cam in cams:
        worst = cam.max_pressure_angle
        value = math.degrees(worst.value)
        status: Status = "fail" if is_steep(value, limit) else "pass"
        at = f"cam angle {short(math.degrees(worst.place))} deg"
        yield PRESSURE_ANGLE.check(status, f"pressure angle of the {cam.name}", value, limit, "deg", at=at, fix=remedy)


def undercut_checks(
    cams: Sequence[DiscCam],
    larger: Callable[[], str] | None = None,
    *,
    plainly: str = LARGER,
    profile_stays: bool = False,
) -> Iterator[Check]:
    """GL402 for each cam: roller against the minimum convex curvature, and the profile against itself.

    Parameters
        cams : the cams
        larger : gives the words for a cam that is large enough, needed where one is not
        plainly : the words for a larger cam where no size is known
        profile_stays : bool - with another roller; else the pitch curve does
    """
    for cam in cams:
        least, roller = cam.min_curvature_radius, cam.roller_radius
        share = roller / least.value
        what, at = f"roller radius of the {cam.name}", f"cam angle {short(math.degrees(least.place))} deg"
        status: Status = "fail" if share >= 1.0 else "warn" if share > ROLLER_SHARE * _SIZED else "pass"
        fix = ""
        if status == "pass" and cam.undercut.depth > 1e-9 * roller:
            status, cut = "fail", cam.undercut
            what = f"cut of the roller of the {cam.name} into its own profile"
            shown, at = Shown(cut.depth, 0.0, "mm", "<="), f"cam angle {short(math.degrees(cut.cam_angle))} deg"
            # at a convex corner of the pitch curve a roller of any radius cuts, however large the cam
            corner, fix = max(cam.corners, default=None), plainly
            if corner is not None and corner.value > 0.0:
                fix = WITHOUT_STEP.format(short(math.degrees(corner.place)))
            yield CAM_UNDERCUT.check(status, what, share, 1.0, shown=shown, at=at, fix=fix)
            continue
        if status != "pass":
            most = ROLLER_SHARE * least.value
            if profile_stays:  # r <= q (rho + r) of its radius rho
                most = ROLLER_SHARE / (1.0 - ROLLER_SHARE) * (least.value - roller)
            fix = f"use a roller of at most {safely_below(most)} mm"
            if most <= 0.0:
                fix = larger() if larger else plainly
        shown = against_curvature(roller, least.value, status)
        yield CAM_UNDERCUT.check(status, what, share, 1.0, shown=shown, at=at, fix=fix)


def flat_undercut_check(cam: FlatCam, limit: float, larger: str) -> Check:
    """GL402 of the profile under a flat face.

    Parameters
        limit : float [mm] - curvature radius below which it warns
        larger : str - the words for a larger cam, with {} for by how much [mm]
    """
    least, crossing = cam.min_curvature_radius, cam.crossing
    if crossing is not None:
        what, place = "profile: it is undercut by a step of the lift's velocity", short(math.degrees(crossing.place))
        at, fix = f"cam angle {place} deg", WITHOUT_STEP.format(place)
        return CAM_UNDERCUT.check("fail", what, None, limit, "mm", side=">=", shown=NO_NUMBER, at=at, fix=fix)
    room = 1e-9 * max(limit, abs(least.value))
    status: Status = "fail" if least.value <= 0.0 else "warn" if least.value < limit - room else "pass"
    cut = least.value < 0.0
    what, shown = (
        "minimum curvature radius of the profile" + (": it is undercut" if cut else ""),
        NO_NUMBER if cut else None,
    )
    at = f"cam angle {short(math.degrees(least.place))} deg"
    fix = larger.format(safely_above(max(limit, 0.0) - least.value))
    return CAM_UNDERCUT.check(status, what, least.value, limit, "mm", side=">=", shown=shown, at=at, fix=fix)


def edge_check(least: Extreme, limit: float, larger: str) -> Check:
    """GL402 of the profile under a knife edge, which cuts no profile: whether it is as sharp as the file allows.

    Parameters
        least : minimum convex radius of the profile [mm] and its cam angle [rad]
        limit : float [mm] - below which it warns
        larger : str - the words for a larger cam
    """
    status: Status = "warn" if least.value < limit * (1.0 - 1e-9) else "pass"
    what, at = "minimum convex radius of the profile", f"cam angle {short(math.degrees(least.place))} deg"
    return CAM_UNDERCUT.check(status, what, least.value, limit, "mm", side=">=", at=at, fix=larger)


def against_curvature(roller: float, least: float, status: Status) -> Shown:
    """What a message compares with a roller radius: the minimum curvature radius, or its usual share."""
    if not math.isfinite(least):
        return Shown(roller, None, "mm")
    usual = status == "warn"
    return Shown(roller, (ROLLER_SHARE if usual else 1.0) * least, "mm", "<=", "recommended" if usual else "limit")


def hub_checks(
    rule: Rule, cams: Sequence[DiscCam | FlatCam], shaft: float, farther: Callable[[float], str]
) -> Iterator[Check]:
    """GL302 for each cam against its shaft.

    Parameters
        rule : Rule - of a roller or cam that reaches a shaft
        cams : the cams
        shaft : float [mm] - radius; 0: nothing is judged
        farther : gives the words for a profile that stands so much [mm] farther from the axis
    """
    for cam in cams if shaft > 0.0 else ():
        room = without_noise(cam.min_radius - shaft, shaft)
        thin = without_noise(cam.min_radius - HUB * shaft, shaft) < 0.0
        status: Status = "fail" if room <= 0.0 else "warn" if thin else "pass"
        fix = farther(HUB * shaft - cam.min_radius) if status != "pass" else ""
        if status == "warn" and cam.min_radius >= HUB * THINNEST * shaft:
            fix = f"use a shaft_radius of at most {safely_below(cam.min_radius / HUB)} mm"
        what, overlap = f"distance of the {cam.name} from its shaft", f"overlap of the {cam.name} and its shaft"
        most, aside = (HUB - 1.0) * shaft, f"shaft radius {short(shaft)} mm"
        yield rule.check(status, what, room, 0.0, "mm", overlap=overlap, recommended=most, aside=aside, fix=fix)


def over_axis_check(
    rule: Rule,
    words: str,
    room: float,
    shaft: float,
    axis: str,
    remedy: str,
    *,
    takes: str = AS_THICK_AS_ROLLER,
    at: str = "",
) -> Iterator[Check]:
    """GL302: a cam that turns over another axis of the frame, or leaves no room for a shaft there, is warned of.

    Parameters
        rule : Rule - of a roller or cam that reaches a shaft
        words : str - "main cam"
        room : float [mm] - from the body to the axis, negative where it reaches over it
        shaft : float [mm] - radius of the thinnest shaft that would be built there: the roller's
        axis, remedy : str - "the cam rocker's axis", and what would clear it
        takes, at : str - what shaft that is, and where in the cycle
    Notes
        Never a failure, since what turns there may be overhung beside the cam.
    """
    if room < shaft:
        what, overlap, aside = f"{words} to {axis}", f"overlap of the {words} and {axis}", takes if room > 0.0 else ""
        yield rule.check("warn", what, room, shaft, "mm", overlap=overlap, aside=aside, at=at, fix=remedy)


def step_check(
    rule: Rule, steps: Sequence[tuple[str, float]], peak: float, unit: str, bad: Status, remedy: str
) -> Check:
    """GL403 or GL404: the largest jump of a lift derivative at a joint.

    Parameters
        rule : VELOCITY_STEP or ACCELERATION_STEP
        steps : (joint, jump) pairs
        peak : float - largest magnitude of that derivative; a jump below 1e-5 of it is rounding of the input
        bad : 'warn' or 'fail' - what a jump means
    """
    step = max((jump for _, jump in steps), key=abs)
    quantity = rule.name.removesuffix("-step")
    limit = 1e-5 * peak
    if abs(step) <= limit:
        what = f"the lift's {quantity} is continuous at every joint"
        return rule.check("pass", what, abs(step), limit, unit, shown=NO_NUMBER)
    largest = max((jump for jump in steps if abs(jump[1]) > limit), key=lambda each: abs(each[1]))
    more = sum(abs(jump) > limit for _, jump in steps) - 1
    aside = f"and {amount(more, 'further step')} at other joints" if more else ""
    what, shown = f"step of the lift's {quantity}", Shown(abs(step), 0.0, unit, "<=")
    return rule.check(bad, what, abs(step), limit, unit, shown=shown, aside=aside, at=largest[0], fix=remedy)
