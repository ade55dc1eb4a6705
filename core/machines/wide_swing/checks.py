"""Checks of a wide-swing design: device, stroke and cams; each is a function of the design."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import Check, Status, safely_above, safely_below
from gearlink.core.machines.wide_swing import codes, cycle_checks, remedies
from gearlink.core.machines.wide_swing.motion import MOST_STRETCH
from gearlink.core.parts.cams import codes as cams
from gearlink.core.parts.linkages import codes as linkages
from gearlink.core.parts.linkages.checks import transmission_check

if TYPE_CHECKING:
    from gearlink.core.machines.wide_swing.cams.outline import AnyCam
    from gearlink.core.machines.wide_swing.design import WideSwingDesign

_ROUNDING = 1e-9
_UNGUIDED = 0.1
"""Half-width of the contact change, as a share of the stroke, that no limit allows without a word: twice the usual."""

# Device and stroke


def unloader_turnability(design: WideSwingDesign) -> Iterator[Check]:
    """GL504: the device can follow the whole swing."""
    least, ratio = design.motion.min_pivot_ratio, design.spec.unloader.pivot_ratio
    if least is None:
        yield from _room_for_steel(design, "give unloader.closed_length or stretch_capacity of the spring that fits")
        return
    status: Status = "fail" if ratio < least else "pass"
    text = f"pivot ratio {ratio:g}, at least {least:.6g} is needed over a swing of {design.spec.swing:g} deg"
    if status == "fail":
        text += f": increase unloader.pivot_ratio to at least {safely_above(least)}, or reduce the swing"
    yield codes.TURNABILITY.check(status, text, ratio, least)
    capacity = getattr(design.spec.unloader, "stretch_capacity", None) or 0.0
    if status == "pass" and capacity > MOST_STRETCH:
        yield from _room_for_steel(design, f"take another device: unloader.stretch_capacity is {capacity:g}")


def _room_for_steel(design: WideSwingDesign, otherwise: str) -> Iterator[Check]:
    """GL504 of a spring of which the file gives no length, or a stretch that no steel bears: whether any spring of
    steel finds room between the pins."""
    ratio, least = design.spec.unloader.pivot_ratio, design.motion.least_ratio_of_steel
    if ratio < least:
        text = (
            f"pivot ratio {ratio:g}: a spring of steel, which bears a stretch of {MOST_STRETCH:g} times its closed "
            f"length, needs {least:.6g} over a swing of {design.spec.swing:g} deg; increase unloader.pivot_ratio to at "
            f"least {safely_above(least)}, or {otherwise}"
        )
        yield codes.TURNABILITY.check("warn", text, ratio, least)


def force_closure(design: WideSwingDesign) -> Iterator[Check]:
    """GL509: a spring that is slack at mid-swing does not hold the roller there."""
    unloader = design.spec.unloader
    if unloader.type == "pneumatic":
        return
    stretch = unloader.stretch_ratio
    status: Status = "warn" if stretch == 0.0 else "pass"
    text = f"the spring's mounting stretch is {stretch:g} of its stroke"
    if status == "warn":
        text += ": it is slack at mid-swing; make unloader.stretch_ratio above 0, such as 0.1"
    yield codes.FORCE_CLOSURE.check(status, text, stretch, 0.0)


def cycle_angles(design: WideSwingDesign) -> Iterator[Check]:
    """GL510: both strokes find room in one turn of the cam."""
    if design.spec.drive is not None:
        return
    if design.spec.cycle is not None:
        yield from cycle_checks.cycle_angles(design)
        return
    both = 2.0 * math.degrees(design.motion.cycle_angle)
    text = f"both strokes take {both:g} deg of the cam's turn"
    if both > 360.0:
        text += ", more than 360 deg: reduce cycle_angle to 180 deg or less"
    yield codes.CYCLE_ANGLES.check("fail" if both > 360.0 else "pass", text, both, 360.0, "deg")


def balancing(design: WideSwingDesign) -> Iterator[Check]:
    """GL508: speeds at which the device does harm."""
    harm = design.unloading.harmful_speed
    text = f"the device lowers the torque above {harm:.5g} rev/min and raises it below"
    lowest = design.spec.operating_speed_min
    if lowest is None:
        return
    status: Status = "warn" if lowest < harm else "pass"
    if status == "warn":
        share = (lowest / design.spec.speed) ** 2
        text += f"; at {lowest:g} rev/min lower its force or rate to {share:.3g} of the design value, or take it off"
    yield codes.BALANCING.check(status, text, lowest, harm, "1/min")


_TRANSMISSION = {
    "drive": ("the least transmission angle of the drive", "shorten drive.crank, or bring coupler and rocker nearer"),
    "slider.rod": (
        "the least angle between the slider's rod and the normal of its slide line",
        "lengthen slider.rod, or bring the slide line nearer",
    ),
}
"""What a message calls an angle, and what raises it."""


def transmission_angle(design: WideSwingDesign) -> Iterator[Check]:
    """GL303: the crank-rocker that carries the cam, over its turn, and the slider's rod, over the swing."""
    limit = design.spec.limits.transmission_angle
    for key, angle in design.motion.transmission_angles.items():
        subject, remedy = _TRANSMISSION[key]
        yield transmission_check(angle, limit, remedy, subject)


def force_reserve(design: WideSwingDesign) -> Check:
    """GL511: the device presses the roller to its cam at the design speed, with a tenth of speed to spare."""
    speed, lift_off, unloader = design.spec.speed, design.unloading.lift_off_speed, design.spec.unloader
    status: Status = "pass"
    if lift_off < 1.1 * speed * (1.0 - 1e-9):
        status = "fail" if speed > lift_off * (1.0 + 1e-9) else "warn"
    text = f"above {lift_off:.6g} rev/min the roller leaves its cam; the design speed is {speed:g} rev/min"
    back = design.unloading.way_back
    if back is not None and back.value > 1.0:
        text += (
            f"; least is left at k = {back.place:.4g} on the way back, which asks {back.value:.4g} times the stroke's"
        )
    if status != "pass":
        need = design.unloading.need
        just, safe = (safely_above(remedies.reserve(unloader.residual, margin, need)) for margin in (0.0, 0.1))
        text += f": make unloader.reserve {safe} or more for a tenth of speed to spare, {just} just holds it"
        if back is not None and back.value > 1.0:
            text += "; drive.coupler and drive.frame longer make the way back more like the stroke"
    return codes.FORCE_RESERVE.check(status, text, lift_off, speed, "1/min")


def side_change(design: WideSwingDesign) -> Iterator[Check]:
    """GL514: device and roller change sides together, at the slot of a cam whose rocker drives a slider."""
    if design.spec.slider is None or not design.has_profile or not design.has_zone(design.cam):
        return
    start, end = design.slot_of(design.cam)
    middle = design.motion.slider.middle_place
    beyond = max(start - middle, middle - end)
    text = f"the device changes sides at k = {middle:.4g}, the roller between {start:.4g} and {end:.4g}"
    if beyond > 0.0:
        text += (
            f": between both the device pushes the roller off its profile; {remedies.side_words(design.spec.slider)}"
        )
    yield codes.SIDE_CHANGE.check("fail" if beyond > 0.0 else "pass", text, beyond, 0.0)


# Cams


def _judged(design: WideSwingDesign) -> list[tuple[str, AnyCam]]:
    """The cams with a profile."""
    return [(words, cam) for words, cam in design.cams.items() if cam is not design.cam or design.has_profile]


def profile_exists(design: WideSwingDesign) -> Check:
    """GL505: a cam for this stroke, no loop, and a phase angle above zero."""
    if design.refusal is not None:
        return codes.PROFILE_EXISTS.check("fail", design.refusal.message, None, 0.0)
    margin = design.cam.loop_margin
    shown = margin if math.isfinite(margin) else None
    try:
        design.cam.require_profile()
    except NoSolution as error:
        crank = remedies.drive_crank(design) if design.spec.drive is not None else None
        text = error.message + (f": make drive.crank at most {crank:.12g} mm" if crank else "")
        return codes.PROFILE_EXISTS.check("fail", text, shown, 0.0)
    text = "the pitch curve has no loop"
    if design.spec.drive is None and design.spec.slider is None:
        text += f"; the run-up takes {math.degrees(design.even_cam.phase_angle):.6g} deg of the cam"
    return codes.PROFILE_EXISTS.check("pass", text, shown, 0.0)


def pressure_angle(design: WideSwingDesign) -> Iterator[Check]:
    """GL401 where the roller touches the profile."""
    limit = design.spec.limits.pressure_angle
    for words, cam in _judged(design):
        if not design.has_zone(cam):
            continue
        value = math.degrees(cam.max_pressure_angle)
        text = f"the pressure angle of the {words} reaches {value:.6g} deg"
        if design.spec.drive is None:
            text += (
                " outside the transition zone" if cam.transition_zone > 0.0 else ", the contact lasting to mid-swing"
            )
        if value > limit:
            text += f", above the limit {limit:g} deg: {_pressure_remedy(design)}"
        yield cams.PRESSURE_ANGLE.check("fail" if value > limit else "pass", text, value, limit, "deg")


def _pressure_remedy(design: WideSwingDesign) -> str:
    if design.spec.cycle is not None:
        return "change swing, or give that stroke another angle in cycle"
    keys = "cycle_angle" if design.spec.drive is None else "drive.crank"
    return f"change {keys} or swing; a twin-cam needs a swing near 2 acos(r/a)"


def cam_undercut(design: WideSwingDesign) -> Iterator[Check]:
    """GL402: roller against the curvature where it touches the profile, and against the source's (27)."""
    roller = design.section.roller_radius
    for words, cam in _judged(design):
        status, text, share = _undercut(cam, words) if design.has_zone(cam) else _covered(cam, words)
        if status != "pass":
            most = safely_below(remedies.roller_for_curvature(design))
            text += f": take a roller of at most {most} mm or a larger cam.center_distance"
        yield cams.CAM_UNDERCUT.check(status, text, share, 1.0)
    if design.spec.layout == "twin-rocker" and design.has_profile:
        yield from _against_estimate(design, roller)


def _undercut(cam: AnyCam, words: str) -> tuple[Status, str, float]:
    roller, least = cam.roller_radius, cam.min_curvature_radius
    share, place = roller / least, f"outside {_left_out(cam)}"
    status: Status = "fail" if share >= 1.0 else "warn" if share > 0.8 else "pass"
    if share == 0.0:
        return status, f"the pitch curve of the {words} bulges nowhere {place}: no roller undercuts it", share
    return (
        status,
        f"roller radius {roller:g} mm against the least curvature radius {least:.6g} mm of the {words} {place}",
        share,
    )


def _covered(cam: AnyCam, words: str) -> tuple[Status, str, None]:
    return (
        "fail",
        f"the roller, radius {cam.roller_radius:g} mm, where it stands still covers the profile of the {words}",
        None,
    )


def _left_out(cam: AnyCam) -> str:
    """The parts of the stroke in which the roller does not touch the profile."""
    (first, _), (_, last) = cam.contact
    ends = [
        f"the {name} {part:.3g} of the stroke" for name, part in (("first", first), ("last", 1.0 - last)) if part > 0.0
    ]
    if not ends:
        return "the transition zone"
    return f"the transition zone and {' and '.join(ends)}, where the roller that stands still covers the profile"


def _against_estimate(design: WideSwingDesign, roller: float) -> Iterator[Check]:
    """The source's own criterion of the internal profile: a warning, since its radius is an estimate."""
    estimate = design.middle_radius_estimate
    if roller >= estimate:
        text = (
            f"roller radius {roller:g} mm is not below the source's estimate {estimate:.6g} mm of the curvature "
            f"radius at mid-swing: to keep its rule take a roller of at most {safely_below(0.999 * estimate)} mm"
        )
        yield cams.CAM_UNDERCUT.check("warn", text, roller / estimate, 1.0)


def transition_zone(design: WideSwingDesign) -> Iterator[Check]:
    """GL507: the contact changes sides within a small part of the stroke."""
    limit = design.spec.limits.transition_zone
    for words, cam in _judged(design):
        zone = cam.transition_zone
        text = f"the roller changes sides of the {words} over {zone:.4g} of the stroke each side of mid-swing"
        if zone > limit:
            roller = remedies.roller_for_zone(design)
            smaller = f"take a roller of at most {safely_below(roller)} mm or a larger cam.center_distance"
            advice = smaller if math.isfinite(roller) else "leave cam.rocker_radius out"
            text += f", above the limit {limit:g}: {advice}"
        status: Status = "fail" if zone > limit else "pass"
        if status == "pass" and zone > _UNGUIDED:
            text += f", as limits.transition_zone allows: over {2.0 * zone:.3g} of the stroke the device guides alone"
            status = "warn"
        yield codes.TRANSITION_ZONE.check(status, text, zone, limit)


def shaft_clearance(design: WideSwingDesign) -> Iterator[Check]:
    """GL302: roller against the cam shaft, and the rocker's axis against the cam."""
    from gearlink.core.machines.wide_swing.cams.outline import is_external
    from gearlink.core.parts.cams.checks import HUB

    section, shaft = design.section, design.section.shaft_radius
    yield from _over_rocker_axis(design)
    if shaft == 0.0:
        return
    for words, cam in design.cams.items():
        bottom = cam.min_radius - section.roller_radius
        room = bottom - shaft
        status: Status = "pass"
        text = f"the roller of the {words} keeps {room:.4g} mm from the cam shaft (radius {shaft:g} mm)"
        if room <= 0.0:
            text = f"the roller of the {words} comes {-room:.4g} mm into the cam shaft (radius {shaft:g} mm)"
            status = "fail"
        elif is_external(cam) and bottom < HUB * shaft * (1.0 - _ROUNDING):
            text = f"below the slot of the {words} {room:.4g} mm are left round its shaft (radius {shaft:g} mm)"
            text += f": take a shaft_radius of at most {safely_below(bottom / HUB)} mm (hub of {HUB:g} times the shaft)"
            status = "warn"
        if status != "pass":
            text += f"{':' if status == 'fail' else ', or'} {_shaft_remedy(design)}"
        yield linkages.SHAFT_CLEARANCE.check(status, text, room, 0.0, "mm")


def _shaft_remedy(design: WideSwingDesign) -> str:
    """A smaller roller where its profile does not bear it either, else a larger distance first."""
    roller, least = remedies.roller_of_profile(design), safely_above(remedies.center_distance(design))
    if roller is not None:
        return f"take a roller of at most {safely_below(roller)} mm, as the profile needs as well"
    return f"make cam.center_distance at least {least} mm, or the roller smaller"


def _over_rocker_axis(design: WideSwingDesign) -> Iterator[Check]:
    """The cam's arc about the dwells may reach over the rocker's axis."""
    from gearlink.core.parts.cams.checks import over_axis_check

    place, roller = design.section.center_distance, design.section.roller_radius
    for words, cam in design.cams.items():
        sense = -1.0 if design.spec.layout == "twin-rocker" and cam is design.cam else 1.0
        room = sense * (place - cam.end_radius) + roller
        if design.spec.drive is not None and design.has_profile:
            # Both stop there, so that the normal of the pitch curve does not point to the cam's axis.
            (first, _), (_, last) = cam.contact
            room = place - float(np.abs(cam.points(np.array([first, last])).profile).max())
        advice = "overhang the rocker beside the cam, or reduce the swing"
        rule, axis = linkages.SHAFT_CLEARANCE, "the rocker's axis at the ends of the stroke"
        yield from over_axis_check(rule, words, room, roller, axis, advice)
