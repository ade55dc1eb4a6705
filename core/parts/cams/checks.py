"""Checks that every cam pair has: pressure angle, undercut, steps at the joints of the law."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import Check, Rule, Status, safely_below, without_noise
from gearlink.core.parts.cams.codes import CAM_UNDERCUT, LARGER, PRESSURE_ANGLE

if TYPE_CHECKING:
    from gearlink.core.parts.cams.disc_cam import DiscCam
    from gearlink.core.parts.cams.flat_cam import FlatCam


# A hub of 1.5 times the shaft is the usual least, a roller of 0.8 of the least curvature radius the usual most.
HUB = 1.5
ROLLER_SHARE = 0.8
AS_THICK_AS_ROLLER = "a shaft as thick as the roller takes"
_SIZED = 1.0 + 1e-9
_FIT = 1e-11
"""Of the limit: cams that are sized to it came out up to 2e-13 above it."""


def impossible(what: str, refusal: NoSolution, limit: float) -> Check:
    """GL401 for cams that cannot be at all, and why."""
    return PRESSURE_ANGLE.check("fail", f"{what}: {refusal.message}", None, limit, "deg")


def is_steep(value: float, limit: float) -> bool:
    """Whether a pressure angle is above its limit by more than cams that are sized to it are off, which is rounding.

    Example
        >>> is_steep(28.000000000002, 28.0), is_steep(28.000001, 28.0)
        (False, True)
    """
    return value > limit * (1.0 + _FIT)


def pressure_angle_checks(cams: Sequence[DiscCam], limit: float, remedy: str) -> Iterator[Check]:
    """GL401 for each cam; `limit` in degrees."""
    for cam in cams:
        worst = cam.max_pressure_angle
        value = math.degrees(worst.value)
        place = f"cam angle {math.degrees(worst.place):.5g} deg"
        text = f"the pressure angle of the {cam.name} reaches {value:.6g} deg at {place}"
        over = is_steep(value, limit)
        text += f", above the limit {limit:g} deg: {remedy}" if over else ""
        yield PRESSURE_ANGLE.check("fail" if over else "pass", text, value, limit, "deg")


def undercut_checks(
    cams: Sequence[DiscCam], larger: Callable[[], str] | None = None, *, plainly: str = LARGER
) -> Iterator[Check]:
    """GL402 for each cam: roller against the least convex curvature, and the profile against itself.

    Parameters
        cams : the cams
        larger : gives the words for a cam that is large enough, asked for where one is not
        plainly : the words for a larger cam where no size is known
    """
    for cam in cams:
        least, roller = cam.min_curvature_radius, cam.roller_radius
        share = roller / least.value
        place = f"cam angle {math.degrees(least.place):.5g} deg"
        text = (
            f"roller radius {roller:g} mm of the {cam.name} against the least curvature radius {least.value:.6g} mm "
            f"at {place}"
        )
        status: Status = "fail" if share >= 1.0 else "warn" if share > ROLLER_SHARE * _SIZED else "pass"
        if status == "pass" and cam.undercut.depth > 1e-9 * roller:
            cut = cam.undercut
            status = "fail"
            text = (
                f"the roller of the {cam.name} cuts {cut.depth:.4g} mm into its own profile at cam angle "
                f"{math.degrees(cut.cam_angle):.5g} deg: {plainly} or take a smaller roller"
            )
        elif status != "pass":
            enlarged = larger() if larger else plainly
            text += f": take a roller of at most {safely_below(ROLLER_SHARE * least.value)} mm or {enlarged}"
        yield CAM_UNDERCUT.check(status, text, share, 1.0)


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
        status: Status = "fail" if room <= 0.0 else "warn" if cam.min_radius < HUB * shaft else "pass"
        text = f"the {cam.name} leaves {room:.4g} mm round its shaft (radius {shaft:g} mm)"
        if status == "fail":
            reach = f"comes {-room:.4g} mm into" if room else "touches"
            text = f"the {cam.name} {reach} its shaft (radius {shaft:g} mm)"
        if status != "pass":
            thinner = ""
            if cam.min_radius > 0.0:
                most = safely_below(cam.min_radius / HUB)
                thinner = f"take a shaft_radius of at most {most} mm (hub of {HUB:g} times the shaft), or "
            text += f": {thinner}{farther(HUB * shaft - cam.min_radius)}"
        yield rule.check(status, text, room, 0.0, "mm")


def over_axis_check(
    rule: Rule, words: str, room: float, shaft: float, axis: str, remedy: str, *, takes: str = AS_THICK_AS_ROLLER
) -> Iterator[Check]:
    """GL302: a cam that turns over another axis of the frame, or leaves no room for a shaft there, is warned of.

    Parameters
        rule : Rule - of a roller or cam that reaches a shaft
        words : str - "main cam"
        room : float [mm] - from the body to the axis, negative where it reaches over it
        shaft : float [mm] - radius of the thinnest shaft that would be built there: the roller's
        axis, remedy : str - "the cam rocker's axis", and what would clear it
        takes : str - what shaft that is
    Notes
        Never a failure, since what turns there may be overhung beside the cam.
    """
    if room >= shaft:
        return
    text = f"the {words} reaches {-room:.4g} mm over {axis}"
    if room > 0.0:
        text = f"the {words} leaves only {room:.4g} mm to {axis}, {takes} {shaft:g} mm"
    yield rule.check("warn", f"{text}: {remedy}", room, shaft, "mm")


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
        return rule.check("pass", f"the lift's {quantity} is continuous at every joint", abs(step), limit, unit)
    listed = ", ".join(f"{joint} {jump:+.4g}" for joint, jump in steps if abs(jump) > limit)
    text = f"the lift's {quantity} jumps ({listed} {unit}): {remedy}"
    return rule.check(bad, text, abs(step), limit, unit)
