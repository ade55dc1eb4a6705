"""Checks of a wide swing, and of a whole cycle: joints of its contours, free sectors, two profiles on one body."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import NO_NUMBER, Check, Shown, Status, safely_above, safely_below
from gearlink.core.base.wording import short
from gearlink.core.machines.wide_swing import codes, remedies
from gearlink.core.machines.wide_swing.motion import MOST_STRETCH
from gearlink.core.machines.wide_swing.sizing import ISENTROPIC
from gearlink.core.parts.cams import codes as cams
from gearlink.core.parts.linkages import codes as linkages
from gearlink.core.parts.linkages.checks import transmission_check

if TYPE_CHECKING:
    from gearlink.core.machines.wide_swing.cycle import ClosedCam
    from gearlink.core.machines.wide_swing.design import WideSwingDesign
    from gearlink.core.machines.wide_swing.strokes import AnyCam


_ROUNDING = 1e-9
_UNGUIDED = 0.1
"""Half-width of the contact change, as a share of the stroke, that no limit allows without a word: twice the usual."""

MOST_RISE = 0.05
"""Rise of a cylinder's force over its stroke up to which the law of constant force is taken."""

# Device and stroke


def unloader_turnability(design: WideSwingDesign) -> Iterator[Check]:
    """GL504: the device can follow the whole swing."""
    unloader = design.spec.unloader
    if unloader.type == "gravity":
        return
    least, ratio = design.motion.min_pivot_ratio, unloader.pivot_ratio
    if least is None:
        yield from _room_for_steel(design, "give unloader.closed_length or stretch_capacity of the spring that fits")
        return
    status: Status = "fail" if ratio < least else "pass"
    fix, aside = (
        f"increase unloader.pivot_ratio to at least {safely_above(least)}",
        f"swing {short(design.spec.swing)} deg",
    )
    yield codes.TURNABILITY.check(status, "pivot ratio of the balancing device", ratio, least, aside=aside, fix=fix)
    capacity = getattr(design.spec.unloader, "stretch_capacity", None) or 0.0
    if status == "pass" and capacity > MOST_STRETCH:
        yield from _room_for_steel(design, "take another device, or a smaller unloader.stretch_capacity")


def _room_for_steel(design: WideSwingDesign, otherwise: str) -> Iterator[Check]:
    """GL504 of a spring of which the file gives no length, or a stretch that no steel bears: whether any spring of
    steel finds room between the pins."""
    ratio, least = design.motion.device.pivot_ratio, design.motion.least_ratio_of_steel
    if ratio < least:
        what, aside = "pivot ratio for a steel spring", f"stretch of {MOST_STRETCH:g} times its closed length"
        fix = f"increase unloader.pivot_ratio to at least {safely_above(least)}, or {otherwise}"
        yield codes.TURNABILITY.check("warn", what, ratio, least, aside=aside, fix=fix)


_USUAL_SWING = 300.0
_STEEPEST = 60.0


def swing_range(design: WideSwingDesign) -> Iterator[Check]:
    """GL543: a swing beyond those of the source, near the far dead centre of the device."""
    swing, law = design.spec.swing, design.motion.law
    if swing <= _USUAL_SWING * (1.0 + _ROUNDING):
        return
    half, g = 0.5 * design.motion.swing, law.geometry
    lever = math.sin(half) if design.spec.unloader.type == "gravity" else g.ratio * math.sin(half) / g.longest
    steps = [replace(law, swing=scale * law.swing).energy_parameter for scale in (0.9999, 1.0001)]
    growth = math.log(steps[1] / steps[0]) / (2e-4 * swing)
    yield codes.SWING_RANGE.check(
        "warn",
        "swing",
        swing,
        _USUAL_SWING,
        "deg",
        aside=f"lever of the device at the ends {short(lever)} arms, force +{short(100.0 * growth)} % per deg of swing",
        fix=f"reduce swing to {_USUAL_SWING:g} deg, or add a gear stage",
        note=f"an external profile has pressure angles above {_STEEPEST:g} deg",
    )


def device_pressure(design: WideSwingDesign) -> Iterator[Check]:
    """GL540: the pressure in a closed reservoir rises little over the stroke."""
    unloader = design.spec.unloader
    if unloader.type != "pneumatic" or unloader.reservoir is None:
        return
    rise = design.unloading.size.force_variation
    litres = unloader.reservoir
    fix = ""
    if rise > MOST_RISE:
        swept, most = (1.0 - (1.0 + each) ** (-1.0 / ISENTROPIC) for each in (rise, MOST_RISE))
        fix = f"set unloader.reservoir to at least {safely_above(litres * swept / most)}"
    yield codes.DEVICE_PRESSURE.check(
        "warn" if rise > MOST_RISE else "pass",
        "rise of the cylinder's force over its stroke",
        rise,
        MOST_RISE,
        aside=f"{litres:g} l of air; the law assumes a constant force",
        fix=fix,
    )


def force_closure(design: WideSwingDesign) -> Iterator[Check]:
    """GL509: a spring that is slack at mid-swing does not hold the roller there."""
    unloader = design.spec.unloader
    if unloader.type != "spring":
        return
    stretch = design.motion.stretch_ratio
    status: Status = "warn" if stretch == 0.0 else "pass"
    what, aside, fix = "mounting stretch of the spring over its stroke", "", ""
    if status == "warn":
        aside = "the spring is slack at mid-swing"
        given = unloader.free_length is not None
        fix = "take a shorter spring" if given else "set unloader.stretch_ratio above 0, such as 0.1"
    yield codes.FORCE_CLOSURE.check(status, what, stretch, 0.0, aside=aside, fix=fix)


def cycle_angles(design: WideSwingDesign) -> Iterator[Check]:
    """GL510: both strokes find room in one revolution of the cam."""
    if design.spec.drive is not None:
        return
    if design.spec.cycle is not None:
        yield from _angles_of_cycle(design)
        return
    both = 2.0 * math.degrees(design.motion.cycle_angle)
    what, fix = "cam angle of both strokes", "reduce cycle_angle to 180 deg or less"
    status: Status = "fail" if both > 360.0 else "pass"
    yield codes.CYCLE_ANGLES.check(status, what, both, 360.0, "deg", side="<=", fix=fix)


def balancing(design: WideSwingDesign) -> Iterator[Check]:
    """GL508: speeds at which the device does harm."""
    harm = design.unloading.harmful_speed
    lowest = design.spec.operating_speed_min
    if lowest is None:
        return
    status: Status = "warn" if lowest < harm else "pass"
    share = (lowest / design.spec.speed) ** 2
    yield codes.BALANCING.check(
        status,
        "minimum speed with the balancing device",
        lowest,
        harm,
        "1/min",
        aside="below, the device increases the torque" if status == "warn" else "",
        fix=f"reduce its force or rate to {safely_below(share, 3)} of the design value at that speed, or remove it",
    )


_TRANSMISSION = {
    "drive": ("minimum transmission angle of the drive", "shorten drive.crank"),
    "slider.rod": ("minimum angle of the slider's rod to the normal of its slide line", "lengthen slider.rod"),
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
    speed, lift_off = design.spec.speed, design.unloading.lift_off_speed
    status: Status = "pass"
    if lift_off < 1.1 * speed * (1.0 - 1e-9):
        status = "fail" if speed > lift_off * (1.0 + 1e-9) else "warn"
    back, fix = design.unloading.way_back, ""
    if status != "pass":
        fix = _more_force(design)
    governs = back is not None and back.value > 1.0
    at = f"k = {short(back.place)} of the return stroke" if back is not None and governs else ""
    return codes.FORCE_RESERVE.check(
        status,
        "lift-off speed of the roller",
        lift_off,
        speed,
        "1/min",
        recommended=1.1 * speed,
        aside=f"the return stroke requires {short(back.value)} times the force" if back is not None and governs else "",
        at=at,
        fix=fix,
    )


def _more_force(design: WideSwingDesign) -> str:
    """The reserve that holds the roller with a tenth of speed as margin, or the strength of a given device."""
    unloader, need, size = design.spec.unloader, design.unloading.need, design.unloading.size
    safe = remedies.reserve(unloader.residual, 0.1, need)
    key = {"pneumatic": "force", "spring": "rate", "gravity": "mass"}[unloader.type]
    if getattr(unloader, key) is None:
        return f"raise unloader.reserve to {safely_above(safe)} (10 % speed margin)"
    if unloader.type == "gravity":
        if safe >= design.motion.most_pendulum_reserve:
            return "move the mass closer to the axis, or lower the speed"
        return f"raise unloader.mass to {safely_above(design.motion.pendulum_mass(1.0 + safe))} (10 % speed margin)"
    return f"raise unloader.{key} to {safely_above(size.balancing * (1.0 + safe))} (10 % speed margin)"


def side_change(design: WideSwingDesign) -> Iterator[Check]:
    """GL514: device and roller change sides together, at the slot of a cam whose rocker drives a slider."""
    if design.spec.slider is None or not design.has_profile or not design.has_zone(design.cam):
        return
    start, end = design.slot_of(design.cam)
    middle = design.motion.slider.middle_place
    beyond = max(start - middle, middle - end)
    aside = f"force reverses at k {short(middle)}, roller contact at k {short(start)} to {short(end)}"
    if beyond > 0.0:
        what, fix = "the roller is pushed off its cam near mid-swing", remedies.side_words(design.spec.slider)
    else:
        what, fix = "balancing force and roller contact reverse together", ""
    status: Status = "fail" if beyond > 0.0 else "pass"
    yield codes.SIDE_CHANGE.check(status, what, beyond, 0.0, shown=NO_NUMBER, aside=aside, fix=fix)


# Cams


def _judged(design: WideSwingDesign) -> list[tuple[str, AnyCam]]:
    """The cams with a profile."""
    return [(words, cam) for words, cam in design.cams.items() if cam is not design.cam or design.has_profile]


def profile_exists(design: WideSwingDesign) -> Check:
    """GL505: a cam for this stroke, no loop, and a phase angle above zero."""
    if design.refusal is not None:
        return codes.PROFILE_EXISTS.check("fail", design.refusal.message, None, 0.0, fix=design.refusal.fix)
    margin = design.cam.loop_margin
    shown = margin if math.isfinite(margin) else None
    try:
        design.cam.require_profile()
    except NoSolution as error:
        crank = remedies.drive_crank(design) if design.spec.drive is not None else None
        fix = f"make drive.crank at most {crank:.12g} mm" if crank else error.fix
        return codes.PROFILE_EXISTS.check("fail", error.message, shown, 0.0, shown=NO_NUMBER, fix=fix)
    aside = ""
    if design.spec.drive is None and design.spec.slider is None:
        aside = f"acceleration phase over {short(math.degrees(design.even_cam.phase_angle))} deg of the cam"
    what = "the pitch curve has no loop"
    return codes.PROFILE_EXISTS.check("pass", what, shown, 0.0, shown=NO_NUMBER, aside=aside)


def pressure_angle(design: WideSwingDesign) -> Iterator[Check]:
    """GL401 where the roller touches the profile."""
    limit = design.spec.limits.pressure_angle
    for words, cam in _judged(design):
        if not design.has_zone(cam):
            continue
        value = math.degrees(cam.max_pressure_angle)
        aside = ""
        if design.spec.drive is None:
            aside = "outside the transition zone" if cam.transition_zone > 0.0 else "contact lasts to mid-swing"
        status: Status = "fail" if value > limit else "pass"
        what, fix = f"pressure angle of the {words}", _pressure_remedy(design)
        yield cams.PRESSURE_ANGLE.check(status, what, value, limit, "deg", aside=aside, fix=fix)


def _pressure_remedy(design: WideSwingDesign) -> str:
    if design.spec.cycle is not None:
        return "give that stroke a larger angle in cycle"
    return f"change {'cycle_angle' if design.spec.drive is None else 'drive.crank'} or swing"


def cam_undercut(design: WideSwingDesign) -> Iterator[Check]:
    """GL402: roller against the curvature where it touches the profile, and against the source's (27)."""
    from gearlink.core.parts.cams.checks import against_curvature

    roller = design.section.roller_radius
    for words, cam in _judged(design):
        if not design.has_zone(cam):
            yield _covered(cam, words)
            continue
        least, fix = cam.min_curvature_radius, ""
        share = roller / least
        status: Status = "fail" if share >= 1.0 else "warn" if share > 0.8 else "pass"
        if status != "pass":
            fix = f"take a roller of at most {safely_below(remedies.roller_for_curvature(design))} mm"
        what = f"roller radius, {words}"
        shown = against_curvature(roller, least, status)
        yield cams.CAM_UNDERCUT.check(status, what, share, 1.0, shown=shown, aside=_left_out(cam), fix=fix)
    if design.spec.layout == "twin-rocker" and design.has_profile:
        yield from _against_estimate(design, roller)


def _covered(cam: AnyCam, words: str) -> Check:
    what = f"the roller (radius {short(cam.roller_radius)} mm) covers the whole profile of the {words}"
    return cams.CAM_UNDERCUT.check("fail", what, None, 1.0, fix="take a smaller cam.roller_radius")


def _left_out(cam: AnyCam) -> str:
    """The parts of the stroke in which the roller does not touch the profile."""
    (first, _), (_, last) = cam.contact
    parts = [
        f"{name} {short(part, 3)} of the stroke"
        for name, part in (("first", first), ("last", 1.0 - last))
        if part > 0.0
    ]
    return " and ".join(("outside the transition zone", *parts))


def _against_estimate(design: WideSwingDesign, roller: float) -> Iterator[Check]:
    """The source's own criterion of the internal profile: a warning, since its radius is an estimate."""
    estimate = design.middle_radius_estimate
    if roller >= estimate:
        what, shown = "roller radius, internal profile", Shown(roller, estimate, "mm", "<=")
        aside = "the source's estimate of the curvature radius at mid-swing"
        fix = f"take a roller of at most {safely_below(0.999 * estimate)} mm"
        yield cams.CAM_UNDERCUT.check("warn", what, roller / estimate, 1.0, shown=shown, aside=aside, fix=fix)


def transition_zone(design: WideSwingDesign) -> Iterator[Check]:
    """GL507: the contact changes sides within a small part of the stroke."""
    limit = design.spec.limits.transition_zone
    for words, cam in _judged(design):
        zone = cam.transition_zone
        fix = note = ""
        if zone > limit:
            roller = remedies.roller_for_zone(design)
            fix = "remove cam.rocker_radius"
            if math.isfinite(roller):
                fix = f"take a roller of at most {safely_below(roller)} mm"
        status: Status = "fail" if zone > limit else "pass"
        if status == "pass" and zone > _UNGUIDED:
            status, note = (
                "warn",
                f"over {short(2.0 * zone, 3)} of the stroke the balancing device alone guides the rocker",
            )
        what = f"half-width of the contact change from one flank of the {words} to the other, over the stroke"
        yield codes.TRANSITION_ZONE.check(status, what, zone, limit, recommended=_UNGUIDED, fix=fix, note=note)


def shaft_clearance(design: WideSwingDesign) -> Iterator[Check]:
    """GL302: roller against the cam shaft, and the rocker's axis against the cam."""
    from gearlink.core.machines.wide_swing.strokes import is_external
    from gearlink.core.parts.cams.checks import HUB

    section, shaft = design.section, design.section.shaft_radius
    yield from _over_rocker_axis(design)
    if shaft == 0.0:
        return
    for words, cam in design.cams.items():
        bottom = cam.min_radius - section.roller_radius
        room = bottom - shaft
        status: Status = "pass"
        fix, recommended = _shaft_remedy(design), None
        if room <= 0.0:
            status = "fail"
        elif is_external(cam) and bottom < HUB * shaft * (1.0 - _ROUNDING):
            status, recommended = "warn", (HUB - 1.0) * shaft
            fix = f"take a shaft_radius of at most {safely_below(bottom / HUB)} mm"
        yield linkages.SHAFT_CLEARANCE.check(
            status,
            f"roller of the {words} to the cam shaft",
            room,
            0.0,
            "mm",
            overlap=f"roller of the {words} within the cam shaft",
            recommended=recommended,
            aside=f"shaft radius {short(shaft)} mm",
            fix=fix,
        )


def _shaft_remedy(design: WideSwingDesign) -> str:
    """A smaller roller where its profile does not bear it either, else a larger distance first."""
    roller, least = remedies.roller_of_profile(design), safely_above(remedies.center_distance(design))
    if roller is not None:
        return f"take a roller of at most {safely_below(roller)} mm"
    return f"set cam.center_distance to at least {least} mm"


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
        advice = "overhang the rocker next to the cam, or reduce the swing"
        rule, axis = linkages.SHAFT_CLEARANCE, "the rocker's axis"
        at = "the ends of the stroke"
        yield from over_axis_check(rule, words, room, roller, axis, advice, at=at)


# Checks of a whole cycle: the joints of its contours, the roller in the free sectors, two profiles on one body


_CUT = 1e-7
"""Cut, in roller radii, that rounding and the search of the nearest place leave of none."""


def _angles_of_cycle(design: WideSwingDesign) -> Iterator[Check]:
    """GL510 of a whole cycle, whose angles fill the turn: rests of no length, and the stroke that sizes the device."""
    section = design.spec.cycle
    assert section is not None, "asked for where there is a cycle"
    working, far, back, near = section.lengths
    aside = f"strokes {short(working)} and {short(back)} deg, dwells {short(far)} and {short(near)} deg"
    for name, rest in (("far_dwell", far), ("near_dwell", near)):
        if rest == 0.0:
            what, fix = (
                f"no {name.replace('_', ' ')}: two concave flanks of each cam meet in an edge",
                f"set cycle.{name} above 0",
            )
            yield codes.CYCLE_ANGLES.check("warn", what, rest, 0.0, "deg", shown=NO_NUMBER, aside=aside, fix=fix)
    note = ""
    if working != back:
        longer, reserve = "working" if working > back else "return", design.cycle.longer_stroke_reserve
        note = (
            f"the balancing device is sized for the shorter stroke: force reserve {short(100.0 * (reserve or 0.0))} %"
        )
        note += f" in the {longer} stroke"
    if far > 0.0 and near > 0.0:
        whole = working + far + back + near
        what = "angles of strokes and dwells"
        yield codes.CYCLE_ANGLES.check("pass", what, whole, 360.0, "deg", side="", aside=aside, note=note)


def _contours(design: WideSwingDesign) -> list[tuple[str, ClosedCam]]:
    """The closed contours of the cams that have a profile."""
    try:
        found = list(design.cycle.contours.items())
        for _, cam in found:
            _ = cam.slot
    except NoSolution:
        # what is refused here fails in checks of its own
        return []
    return found


def acceleration_step(design: WideSwingDesign) -> Iterator[Check]:
    """GL404: at the joints of strokes and rests the tangent goes over, the rocker's acceleration jumps."""
    import numpy as np

    for words, cam in _contours(design):
        first, pace = cam.joints[0], design.spec.speed * math.tau / 60.0
        start = float(design.motion.plain_law.invariants(np.zeros(1), 2)[2][0])
        step = start * design.motion.swing * (pace / cam.own) ** 2
        what, aside = f"acceleration step of the rocker at the dwells of the {words}", "no velocity step"
        note = f"the radius of the pitch curve steps from {short(first.before)} to {short(first.after)} mm there"
        fix = "compute the vibration with the section shaft"
        yield cams.ACCELERATION_STEP.check("warn", what, step, 0.0, "rad/s^2", aside=aside, fix=fix, note=note)


def closed_contour(design: WideSwingDesign) -> Iterator[Check]:
    """GL512: the roller goes round each closed contour without a cut, and the contour does not cross itself."""
    from gearlink.core.parts.cams.checks import HUB

    shaft, clearance = design.section.shaft_radius, design.section.free_clearance
    for words, cam in _contours(design):
        cut, least = cam.cut, cam.least_radius
        if cut.depth > _CUT * cam.cam.roller_radius:
            what = f"cut of the roller into the contour of the {words}"
            at = f"cam angle {short(math.degrees(cut.cam_angle))} deg"
            fix, shown = "take a smaller cam.roller_radius", Shown(cut.depth, 0.0, "mm", "<=")
            yield codes.CLOSED_CONTOUR.check("fail", what, -cut.depth, 0.0, "mm", shown=shown, at=at, fix=fix)
        elif clearance >= cam.largest_clearance:
            most = cam.largest_clearance
            what = f"clearance of the roller in the free sector of the {words}"
            fix, shown = "take a smaller cam.roller_radius", NO_NUMBER
            if most > 0.0:
                fix, shown = f"set cam.free_clearance below {safely_below(most)} mm", Shown(clearance, most, "mm", "<=")
            else:
                what = f"the contour of the {words} crosses itself in its free sector"
            yield codes.CLOSED_CONTOUR.check("fail", what, clearance, most, "mm", shown=shown, fix=fix)
        elif least <= shaft:
            what, fix = f"minimum radius of the contour of the {words}", "set a larger cam.center_distance"
            yield codes.CLOSED_CONTOUR.check("fail", what, least, shaft, "mm", aside="shaft radius", fix=fix)
        elif cam.cam.sense > 0 and least < HUB * shaft and least < cam.cam.min_radius - cam.cam.roller_radius:
            what, shown = (
                f"minimum radius of the contour of the {words}",
                Shown(least, HUB * shaft, "mm", ">=", "recommended"),
            )
            aside, fix = f"{HUB:g} times the shaft radius", "set a smaller cam.free_clearance"
            yield codes.CLOSED_CONTOUR.check("warn", what, least, shaft, "mm", shown=shown, aside=aside, fix=fix)
        else:
            what = f"minimum radius of the contour of the {words}"
            yield codes.CLOSED_CONTOUR.check("pass", what, least, shaft, "mm")


def profile_planes(design: WideSwingDesign) -> Iterator[Check]:
    """GL513: whether the two profiles of a twin-rocker's cam can stand in one plane."""
    if not _contours(design):
        return
    room = design.cycle.plane_room
    if room is None:
        return
    status: Status = "pass" if room > 0.0 else "warn"
    what, overlap = "distance of the two profiles at the dwells", "overlap of the two profiles at the dwells"
    fix = "cut the profiles in two planes next to each other"
    yield codes.PROFILE_PLANES.check(status, what, room, 0.0, "mm", overlap=overlap, fix=fix)
