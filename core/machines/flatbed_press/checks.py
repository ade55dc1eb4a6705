"""Checks of a flatbed press: chains, zone, cams, bodies that meet outside of the print, pinion and both racks.

Each is a function of the design.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

from gearlink.core.base.errors import MissingSection, NoSolution, in_section
from gearlink.core.base.remedies.ways import (
    REFUSAL,
    Way,
    at_least,
    at_most,
    can_be_built,
    down,
    either,
    greatest_length,
    left_out,
    refusal_ways,
    shared,
    up,
    wider,
)
from gearlink.core.base.report import Check, Rule, Shown, Status, safely_above, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.spec_paths import changed
from gearlink.core.base.wording import short
from gearlink.core.machines.flatbed_press import codes
from gearlink.core.machines.flatbed_press.codes import RACK_LENGTH
from gearlink.core.machines.flatbed_press.zone import zone_end
from gearlink.core.parts.cams.checks import (
    HUB,
    ROLLER_SHARE,
    hub_checks,
    impossible,
    pressure_angle_checks,
    step_check,
    undercut_checks,
)
from gearlink.core.parts.cams.codes import ACCELERATION_STEP, CONSTANT_SUM, LARGER, VELOCITY_STEP
from gearlink.core.parts.gears.checks import GEAR_QUANTITIES, gear_quantity
from gearlink.core.parts.gears.codes import AT_LIMITS
from gearlink.core.parts.gears.drawing_names import DRAWING_QUANTITIES
from gearlink.core.parts.linkages.checks import transmission_check
from gearlink.core.parts.linkages.codes import SHAFT_CLEARANCE
from gearlink.core.parts.linkages.slider_crank import SliderCrank
from gearlink.core.studies.clearance import LEAST_SHAFT_MODULES

if TYPE_CHECKING:
    from gearlink.core.base.report import Remedy
    from gearlink.core.machines.flatbed_press.compensation import Joint
    from gearlink.core.machines.flatbed_press.design import FlatbedPress
    from gearlink.core.parts.gears.data import GearData
    from gearlink.core.parts.gears.rack import RackMesh


_TURN = 2.0 * math.pi
_ROWS = 721
_NAME = SHAFT_CLEARANCE.checks[2]


def crank_axes(design: FlatbedPress) -> Iterator[Check]:
    """GL302: crank AB, which gear 2 carries, over the axis G of gear 1, and crank GH over A.

    AB + r_s <= AG, the crank pin on its circle about A; r_s of the thinnest shaft
    """
    gears = design.spec.input_gears
    if gears is None:
        return
    bed = design.spec.bed
    apart, least = (
        math.hypot(gears.horizontal_distance, bed.offset - bed.double_crank.frame),
        LEAST_SHAFT_MODULES * gears.module,
    )
    cranks = (("AB", "G", bed), ("GH", "A", design.spec.cylinder))
    for name, other, part in cranks:
        reach = part.double_crank.crank
        gap = apart - reach - least
        yield SHAFT_CLEARANCE.check(
            "pass" if gap >= 0.0 else "warn",
            f"crank {name} to the minimum shaft at {other}",
            gap,
            0.0,
            "mm",
            name=_NAME,
            overlap=f"overlap of the crank {name} and the minimum shaft at {other}",
            aside=f"axes {short(apart)} mm apart",
            fix=f"end the shaft at {other} before the plane of the crank (overhung)",
        )


def return_overlap(design: FlatbedPress) -> Iterator[Check]:
    """GL506: whether the print's arc of the cylinder comes round again while the forme stands at the printing line.

    q(phi) - q(phi_s) in [j C, j C + L] with p(phi) - p(phi_s) in [0, L], C the circumference, L the print

    Notes
        p is the travel of the bed's chain; the lift of the cams, some per cent of it, is left out.
    """
    turns = max(1, round(design.spec.cylinder.ratio))
    if turns == 1 or abs(turns - design.spec.cylinder.ratio) > 1e-9:
        return
    import numpy as np

    motion, spec = design.motion, design.spec
    start, about = motion.sync_start, _TURN * spec.cylinder.radius
    length = spec.sync.print_length or motion.zone_length
    phi = np.linspace(start, start + _TURN, _ROWS)
    rolled = motion.cylinder.travel(phi).value - motion.cylinder.travel(start).value
    first = motion.bed.travel(start).value
    for again in range(1, turns):
        ends = np.interp([again * about, again * about + length], rolled, phi)
        places = np.linspace(ends[0], ends[1], _ROWS)
        passed = motion.bed.travel(places).value - first
        beneath = places[(passed > 0.0) & (passed < length)]
        if beneath.size:
            low, high = (math.degrees(end) % 360.0 for end in beneath[[0, -1]])
            what, aside = "revolutions of the cylinder per sheet", "the printed area passes the forme again"
            at, fix = f"input angles {short(low)} to {short(high)} deg", "set cylinder.gear_ratio to 1"
            yield codes.REGISTER.check("warn", what, float(turns), 1.0, aside=aside, at=at, fix=fix)
            return


# A share of the speed that is nothing but the rounding of the chains.
_ROUNDING = 1e-12

# Chains and zone


def transmission_angle(design: FlatbedPress) -> Iterator[Check]:
    """GL303 for both chains, and for the rod of the bed's slider-crank."""
    limit, motion = design.spec.limits.transmission_angle, design.motion
    angles = {"bed": motion.min_transmission_angle_bed, "cylinder": motion.min_transmission_angle_cylinder}
    for chain, angle in angles.items():
        yield transmission_check(
            angle,
            limit,
            f"shorten {chain}.double_crank.frame, or lengthen its coupler",
            f"minimum transmission angle of the {chain} drive",
        )
    subject = "minimum angle of the rod EF to the normal of its slide line"
    yield transmission_check(motion.min_rod_angle, limit, "lengthen bed.rod", subject)


def sync_speed(design: FlatbedPress) -> Iterator[Check]:
    """GL501: bed and cylinder at the start of the zone, and without a cam what their travels gather over it."""
    yield _start_speed(design)
    ahead = design.motion.compensation
    if design.spec.cam is None and abs(ahead) > _ROUNDING * design.motion.zone_length:
        side = "ahead of" if ahead > 0.0 else "behind"
        what = f"travel of the bed {side} the cylinder over the zone, without a compensation cam"
        yield codes.SYNC_SPEED.check("warn", what, abs(ahead), 0.0, "mm", fix="give the section cam")


def _start_speed(design: FlatbedPress) -> Check:
    """What the speeds differ by at the start of the zone, where a jump would be a blow."""
    gap, cylinder = _speed_gap(design)
    share, limit = abs(gap / cylinder), 1e-3
    status: Status = "fail" if share > limit else "pass"
    return codes.SYNC_SPEED.check(
        status,
        "speed difference of bed and cylinder at the start of the zone",
        share,
        limit,
        shown=Shown(100.0 * share if share >= _ROUNDING else 0.0, 100.0 * limit, "%", "<="),
        aside=f"{short(abs(gap) * design.motion.input_speed, 3)} mm/s" if share >= _ROUNDING else "",
        fix="remove sync.start, so that the zone starts where the speeds are equal",
    )


def _speed_gap(design: FlatbedPress) -> tuple[float, float]:
    """What is left of the difference of the speeds, and the cylinder's speed, by the input angle [mm/rad].

    Without a lead-in the rack stands before the zone, p' - q'; with one it moves already, and what is left is the
    jump of its own velocity.
    """
    motion, cam = design.motion, design.spec.cam
    cylinder = motion.cylinder.speed(motion.sync_start)
    if cam is not None and cam.lead_in > 0.0 and design.cams.follows:
        step = design.cams.follower.velocity_step("sync")
        return step * float(motion.bed.cam_angle(motion.sync_start, 1).first), cylinder
    return motion.bed.speed(motion.sync_start) - cylinder, cylinder


def sync_length(design: FlatbedPress) -> Iterator[Check]:
    """GL502: the zone covers the print, ends before the bed turns back, and the print finds room on the cylinder."""
    yield _zone_length(design)
    yield from _turning_back(design)
    asked, room = design.spec.sync.print_length, math.tau * design.spec.cylinder.radius
    if asked > room:
        what, aside = "circumference of the cylinder", "print length"
        fix = f"set sync.print_length to at most {safely_below(room)} mm"
        yield codes.SYNC_LENGTH.check("fail", what, room, asked, "mm", aside=aside, fix=fix)


def _turning_back(design: FlatbedPress) -> Iterator[Check]:
    motion = design.motion
    turning = motion.bed_turns_back
    if turning is not None:
        at, end = (math.degrees(angle) for angle in (turning, motion.sync_end))
        what, aside, fix = "input angle at which the bed reverses", "end of the zone", "reduce sync.length"
        yield codes.SYNC_LENGTH.check("fail", what, at, end, "deg", aside=aside, fix=fix)


def _zone_length(design: FlatbedPress) -> Check:
    length, asked = design.motion.zone_length, design.spec.sync.print_length
    if asked == 0.0:
        what, aside = "length of the synchronous zone", "no print_length given"
        return codes.SYNC_LENGTH.check("pass", what, length, 0.0, "mm", shown=Shown(length, None, "mm"), aside=aside)
    remedy = "raise sync.length" if design.spec.sync.end is None else "raise sync.end"
    return codes.SYNC_LENGTH.below(length, asked, asked, "mm", "travel of the cylinder in the zone", remedy)


def register(design: FlatbedPress) -> Iterator[Check]:
    """GL506: the cylinder makes whole revolutions per sheet, and of several prints in one alone."""
    ratio = design.spec.cylinder.ratio
    off = abs(ratio - max(1, round(ratio)))
    shown = Shown(ratio, None, "per sheet")
    what, fix = "revolutions of the cylinder", f"set cylinder.gear_ratio to {max(1, round(ratio))}"
    aside = "a whole number is required" if off > 1e-9 else ""
    yield codes.REGISTER.check("fail" if off > 1e-9 else "pass", what, off, 1e-9, shown=shown, aside=aside, fix=fix)
    yield from return_overlap(design)


# Cams


def pressure_angle(design: FlatbedPress) -> Iterator[Check]:
    """GL401 for both cams; it fails as well where no cam can make the motion at all."""
    limit = design.spec.limits.pressure_angle
    if design.cams.refusal is not None:
        yield impossible("no cam pair is possible", design.cams.refusal, limit)
        return
    over = design.advises and max(cam.max_pressure_angle.value for cam in design.cams.discs) > math.radians(limit) > 0.0
    remedy = _larger(design, limit) if over else ""
    yield from pressure_angle_checks(design.cams.discs, limit, remedy)


def _larger(design: FlatbedPress, limit: float) -> str:
    """The base radius that keeps a pressure angle [deg], with room for roller and shaft where there is such a one."""
    cams, angle = design.cams, math.radians(limit)
    try:
        radius = cams.base_radius_for(angle)
    except NoSolution:
        radius = cams.base_radius_for_pressure(angle)
    return _with_base_radius(design, radius)


def _with_base_radius(design: FlatbedPress, radius: float) -> str:
    """In words, the minimum base radius [mm], where a press with such a cam can be built."""
    if can_be_built(design.spec, (("cam.base_radius", radius),), greatest_length(design.spec)):
        return f"set cam.base_radius to at least {safely_above(radius)} mm"
    return f"allow a larger pressure angle (a cam.base_radius of {safely_above(radius)} mm is more than can be built)"


def cam_undercut(design: FlatbedPress) -> Iterator[Check]:
    """GL402 for both cams."""
    larger = partial(_base_radius_for_roller, design) if design.advises else str
    if design.cams.refusal is None:
        yield from undercut_checks(design.cams.discs, larger)


def _base_radius_for_roller(design: FlatbedPress) -> str:
    try:
        radius = design.cams.base_radius_for_roller(design.cams.base_radius)
    except NoSolution:
        return LARGER
    return _with_base_radius(design, radius)


def shaft_clearance(design: FlatbedPress) -> Iterator[Check]:
    """GL302: the profiles against the cam shaft."""
    if design.cams.refusal is not None:
        return
    base = design.cams.base_radius
    yield from hub_checks(
        SHAFT_CLEARANCE,
        design.cams.discs,
        design.cams.section.shaft_radius,
        lambda missing: f"set cam.base_radius to at least {safely_above(base + missing)} mm",
    )


def velocity_step(design: FlatbedPress) -> Check:
    """GL403 at every joint of the lift."""
    remedy = "remove sync.start, so that the zone starts where the speeds are equal"
    return _steps(design, VELOCITY_STEP, "first", "mm/rad", "fail", remedy)


def acceleration_step(design: FlatbedPress) -> Check:
    """GL404 at every joint of the lift."""
    remedy = "give a cam.lead_in before the zone, transition quartic and return_law cycloidal"
    return _steps(design, ACCELERATION_STEP, "second", "mm/rad^2", "warn", remedy)


def _steps(design: FlatbedPress, rule: Rule, derivative: str, unit: str, bad: Any, remedy: str) -> Check:
    follower = design.cams.follower
    peak = max(
        abs(float(getattr(segment.lift(angle, 2), derivative)))
        for segment in follower.segments
        for angle in (segment.start, 0.5 * (segment.start + segment.end), segment.end)
    )
    steps = [(_joint(joint), float(getattr(joint, rule.name.replace("-", "_")))) for joint in follower.joints]
    return step_check(rule, steps, peak, unit, bad, remedy)


def _joint(joint: Joint) -> str:
    return f"the joint {joint.before}/{joint.after}, {short(math.degrees(joint.cam_angle))} deg"


def constant_sum(design: FlatbedPress) -> Check:
    """GL405: the two pitch radii in contact add up to the roller distance at every cam angle."""
    import numpy as np

    theta, distance = np.radians(np.arange(0.0, 360.0, 1.0)), design.cams.roller_center_distance
    radii = [np.abs(cam.points(theta)[0]) for cam in design.cams.discs]
    off = float(np.abs(radii[0] + radii[1] - distance).max())
    limit = 1e-9 * distance
    what, aside = "deviation of the sum of the pitch radii", f"roller distance {short(distance)} mm"
    fix = "raise cam.base_radius: the return cam's roller passes the cam axis"
    return CONSTANT_SUM.check("fail" if off > limit else "pass", what, off, limit, "mm", aside=aside, fix=fix)


_LEAD_IN = 10.0
_STEEPEST = 1e-3
_ROUNDS = 20
"""So often a rod is found from its crank, which grows less than the rod does."""
_BEHIND = (15.0, 25.0, 40.0, 60.0)
"""Cam angles behind the end of the zone at which the lift may be maximum [deg]."""
_LINKS = tuple(
    f"{chain}.double_crank.{link}" for chain in ("bed", "cylinder") for link in ("frame", "coupler", "crank", "rocker")
)
_LARGER = (up("cam.base_radius"), up("cam.return_angle", step=0.5))
_ZONE = (left_out("sync.start"), up("cam.lead_in", step=1.0))
_LATER = (*shared("cam.transition_end", "cam.return_angle", step=0.5)[:1], down("cam.return_angle", step=0.5))
_GEARS = tuple(f"input_gears.profile_shift[{gear}]" for gear in (0, 1))
_SHIFTS = (*shared(*_GEARS, step=0.01), *either(*_GEARS, step=0.01))
_TEETH = (*either("input_gears.pressure_angle", step=0.5), down("input_gears.addendum", step=0.01))
_WIDER = (wider("input_gears.face_width"), wider("input_gears.face_width[0]", "input_gears.face_width[1]"))
_OF_TEETH = ("undercut", "tip-thickness", "involute-interference", "tooth-form", "fillet-interference", "tip-fouling")
_WAYS = {
    **dict.fromkeys(_OF_TEETH, (*_SHIFTS, *_TEETH)),
    "contact-ratio": (*_SHIFTS, *_TEETH[:2], up("input_gears.addendum", step=0.01)),
    "root-clearance": (up("input_gears.clearance", step=0.01), up("input_gears.tool.addendum", step=0.01)),
    "backlash": tuple(
        Way((f"input_gears.allowances.upper[{gear}]", f"input_gears.allowances.lower[{gear}]"), -0.005)
        for gear in (0, 1)
    )
    + tuple(down(f"input_gears.profile_shift[{gear}]", step=0.01) for gear in (0, 1)),
    **dict.fromkeys(AT_LIMITS, (down("input_gears.center_distance_allowance", step=0.001),)),
    "pitting": _WIDER,
    "bending": (*_WIDER, up("input_gears.tool.rounding", step=0.01)),
    "transmission-angle": either(*_LINKS),
    "sync-speed": _ZONE,
    "sync-length": (left_out("sync.end"),),
    "register": either("cylinder.gear_ratio", step=1.0),
    "pressure-angle": _LARGER,
    "cam-undercut": _LARGER,
    "shaft-clearance": (up("cam.base_radius"),),
    "velocity-step": _ZONE,
    "constant-sum": (up("cam.base_radius"),),
}


def ways_of(design: FlatbedPress, check: str) -> tuple[Way, ...]:
    """Ways in which a check that fails may be repaired; for cams that cannot be, those of their refusal."""
    if check == "pressure-angle" and design.cams.refusal is not None:
        return (*refusal_ways(design.spec, design.cams.refusal.key), *_LATER, *_ZONE, *_WAYS[check])
    return _WAYS.get(check, ())


def candidates(design: FlatbedPress, check: str) -> Iterator[Remedy]:
    """Remedies of a check from closed forms, the first to be tried first."""
    return _CLOSED[check](design) if check in _CLOSED else iter(())


def _rod(design: FlatbedPress) -> Iterator[Remedy]:
    """The rod of the bed that keeps the limit, well or just; the crank grows with it."""
    bed, limit = design.spec.bed, design.spec.limits.transmission_angle
    for aim in (limit + 5.0, limit):
        rod, lean = bed.rod, math.cos(math.radians(aim))
        if math.degrees(design.motion.min_rod_angle) >= aim or lean < _STEEPEST:
            continue
        for _ in range(_ROUNDS):
            rod = (SliderCrank(bed.stroke / 2.0, rod, bed.offset).crank_length + abs(bed.offset)) / lean
        yield (("bed.rod", at_least(rod)),)


def _length(design: FlatbedPress) -> Iterator[Remedy]:
    """A zone as long as the print, by its length or its end; last a print that fits into zone and circumference."""
    sync, motion = design.spec.sync, design.motion
    if motion.bed_turns_back is not None:
        yield _before_turning(design, motion.bed_turns_back)
    if sync.end is None:
        yield (("sync.length", sync.print_length),)
    else:
        end = math.degrees(zone_end(motion.cylinder, motion.sync_start, sync.print_length))
        yield (("sync.end", at_least(end, 0.5)),)
        yield ("sync.length", sync.print_length), ("sync.end", None)
    yield (("sync.print_length", at_most(min(motion.zone_length, math.tau * design.spec.cylinder.radius))),)


def _before_turning(design: FlatbedPress, turning: float) -> Remedy:
    """The zone that ends where the bed turns back [rad]."""
    motion = design.motion
    most = motion.cylinder.travel(turning).value - motion.cylinder.travel(motion.sync_start).value
    shorter = ("sync.length", at_most(float(most)))
    return (shorter,) if design.spec.sync.end is None else (shorter, ("sync.end", None))


def _pressure(design: FlatbedPress) -> Iterator[Remedy]:
    """The base radius that keeps the limit with room for roller and shaft, or the angle that it is chosen for."""
    cams, limit = design.cams, design.spec.limits.pressure_angle
    if cams.refusal is not None and cams.refusal.key == "cam.transition_end":
        yield from _later_transition(design)
    elif cams.refusal is not None and cams.refusal.key in ("sync.length", "sync.end"):
        yield from _without_turning(design)
    elif design.spec.size is not None and design.cams.section.base_radius is None:
        yield (("size.pressure_angle", at_most(limit, 0.5)),)
    elif cams.follows:
        try:
            radius = cams.base_radius_for(math.radians(limit))
        except NoSolution:
            radius = cams.base_radius_for_pressure(math.radians(limit))
        yield (("cam.base_radius", at_least(radius)),)


def _without_turning(design: FlatbedPress) -> Iterator[Remedy]:
    """A zone that ends before the bed turns back, alone or with a transition that ends behind it."""
    turning = design.motion.bed_turns_back
    if turning is None:
        return
    shorter = _before_turning(design, turning)
    yield shorter
    spec = changed(design.spec, shorter)
    if spec is not None:
        yield from ((*shorter, *later) for later in _later_transition(type(design)(spec)))


def _later_transition(design: FlatbedPress) -> Iterator[Remedy]:
    """The maximum lift farther behind the zone, with the base radius that its cams then need; none where one of them
    needs no larger one, which a way finds."""
    end, given = math.degrees(design.motion.cam_sync_end), design.cams.section.base_radius
    found: list[tuple[float, Remedy]] = []
    for more in _BEHIND:
        later: Remedy = (("cam.transition_end", at_least(end + more, 0.5)),)
        spec = changed(design.spec, later)
        if spec is None or given is None:
            break
        with suppress(NoSolution):
            cams = type(design)(spec).cams
            if cams.refusal is None:
                radius = at_least(cams.base_radius_for(math.radians(design.spec.limits.pressure_angle)))
                found.append((radius, (*later, ("cam.base_radius", radius))))
    if given is not None and all(radius > given for radius, _ in found):
        yield from (remedy for _, remedy in sorted(found))


def _roller(design: FlatbedPress) -> Iterator[Remedy]:
    """A roller well below the minimum curvature radius, or a cam large enough for the roller."""
    least = min(cam.min_curvature_radius.value for cam in design.cams.discs)
    yield (("cam.roller_radius", at_most(ROLLER_SHARE * least)),)
    yield (("cam.base_radius", at_least(design.cams.base_radius_for_roller(design.cams.base_radius))),)


def _shaft(design: FlatbedPress) -> Iterator[Remedy]:
    """A cam large enough for its hub, or a thinner shaft."""
    cams = design.cams
    missing = HUB * cams.section.shaft_radius - cams.min_radius
    yield (("cam.base_radius", at_least(cams.base_radius + missing)),)
    if cams.min_radius > 0.0:
        yield (("cam.shaft_radius", at_most(cams.min_radius / HUB)),)


def _smooth(design: FlatbedPress) -> Iterator[Remedy]:
    """The laws that end without acceleration, and a lead-in where there is none."""
    cam = design.cams.section
    wanted: Remedy = (("cam.transition", "quartic"), ("cam.return_law", "cycloidal"))
    given = {"cam.transition": cam.transition, "cam.return_law": cam.return_law}
    better = tuple((key, value) for key, value in wanted if given[key] != value)
    if better:
        yield better
    if cam.lead_in == 0.0:
        yield (*better, ("cam.lead_in", _LEAD_IN))


_CLOSED: dict[str, Callable[[FlatbedPress], Iterator[Remedy]]] = {
    REFUSAL: lambda _: iter(((("cam.return_law", "cycloidal"),),)),
    "transmission-angle": _rod,
    "sync-length": _length,
    "pressure-angle": _pressure,
    "cam-undercut": _roller,
    "shaft-clearance": _shaft,
    "acceleration-step": _smooth,
}


CYLINDER, PINION = "cylinder_gears", "pinion_rack"
OF_CYLINDER = tuple(f"{CYLINDER}.{name}" for name in (*GEAR_QUANTITIES, *DRAWING_QUANTITIES))
OF_PINION = tuple(f"{PINION}.{name}" for name in (*GEAR_QUANTITIES, *DRAWING_QUANTITIES))
OF_RACKS = ("pinion_radius", "rack_teeth", "rack_travel")


class PressTeeth:
    """The gears beside those of the input, as far as the file gives them."""

    def __init__(self, design: FlatbedPress) -> None:
        self.design = design

    @property
    def names(self) -> tuple[str, ...]:
        """What there is of them to look at."""
        found = OF_CYLINDER if self.design.spec.cylinder.gears is not None else ()
        return (*found, *OF_PINION, *OF_RACKS) if self.design.spec.bed.pinion is not None else found

    @cached_property
    def cylinder(self) -> GearData:
        """Gears 3 and 4, without backlash by their shifts."""
        from gearlink.core.parts.gears.from_spec import data_of, pair_at, required_of

        given = self.design.spec.cylinder.gears
        if given is None:
            raise MissingSection("give cylinder.gears: {module, teeth: [z3, z4]}", key="cylinder")
        plain = 0.5 * given.module * sum(given.teeth) / math.cos(math.radians(given.helix_angle))
        with in_section("cylinder.gears"):
            pair = pair_at(given, (given.teeth[0], given.teeth[1]), plain if given.profile_shift is None else None)
            return replace(data_of(given, pair), required=required_of(self.design.spec.limits))

    @cached_property
    def pinion(self) -> RackMesh:
        """The pinion on either rack."""
        from gearlink.core.parts.gears.from_spec import rack_at

        given = self.design.spec.bed.pinion
        if given is None:
            raise MissingSection("give bed.pinion: {module, teeth}", key="bed")
        with in_section("bed.pinion"):
            return rack_at(given, given.teeth)

    @property
    def pinion_radius(self) -> float | None:
        """Radius with which the pinion rolls [mm]."""
        return None if self.design.spec.bed.pinion is None else self.pinion.pair.reference_radius[0]

    @cached_property
    def rack_travel(self) -> list[float] | None:
        """How far the pinion goes along the lower and the upper rack [mm]: stroke of F, and the follower's with it."""
        if self.design.spec.bed.pinion is None:
            return None
        stroke = 0.5 * self.design.spec.bed.stroke
        lift = 0.0 if self.design.spec.cam is None else float(self.design.cams.follower_stroke)
        return [stroke + lift, stroke]

    @property
    def least_rack_teeth(self) -> list[int]:
        """Teeth that travel, path of contact and a pitch take."""
        pitch = self.pinion.pitch_on_line
        contact = (self.pinion.path.end - self.pinion.path.start) * math.cos(self.pinion.working_pressure_angle)
        return [math.ceil((travel + contact + pitch) / pitch) for travel in self.rack_travel or ()]

    @property
    def rack_teeth(self) -> list[int] | None:
        """Teeth of the lower and the upper rack, given or as many as they need."""
        if self.design.spec.bed.pinion is None:
            return None
        return self.design.spec.bed.rack_teeth or self.least_rack_teeth

    def quantity(self, name: str) -> Any:
        """A quantity by name, None where the file has not these gears."""
        mesh, _, last = name.rpartition(".")
        if name not in self.names:
            return None
        if mesh == CYLINDER:
            with in_section("cylinder.gears"):
                data = self.cylinder
                return gear_quantity(data.pair, last) if last in GEAR_QUANTITIES else data.quantity(last)
        if mesh == PINION:
            with in_section("bed.pinion"):
                return self.pinion.quantity(last)
        return getattr(self, name)

    def checks(self, name: str) -> Iterator[Check]:
        """The findings of a gear check on gears 3 and 4, and on pinion and racks."""
        from gearlink.core.parts.gears.drawing_checks import pair_check

        spec = self.design.spec
        if spec.cylinder.gears is not None:
            shifts = spec.cylinder.gears.profile_shift is not None
            with in_section("cylinder.gears"):
                yield from pair_check(name, self.cylinder, spec.limits, mesh=CYLINDER, shifts=shifts)
        if spec.bed.pinion is not None:
            with in_section("bed.pinion"):
                for found in self.pinion.checks(name, spec.limits):
                    yield replace(found, what=f"{PINION}: {found.what}")

    def check_racks(self) -> Iterator[Check]:
        """GL346: teeth of both racks against what the travel takes."""
        if self.design.spec.bed.rack_teeth is None:
            return
        for name, has, needs in zip(
            ("lower", "upper"), self.design.spec.bed.rack_teeth, self.least_rack_teeth, strict=True
        ):
            what, aside = f"length of the {name} rack", "travel and path of contact"
            status: Status = "fail" if has < needs else "pass"
            fix = f"give it {needs} teeth (bed.rack_teeth)"
            yield RACK_LENGTH.check(status, what, float(has), float(needs), "teeth", aside=aside, fix=fix)


def polygons(design: FlatbedPress, samples: int | None = None) -> dict[str, tuple[Any, str]]:
    """Velocity polygons of both chains: v_C = v_B + v_CB, v_F = v_E + v_FE, v_M = v_H + v_MH.

    Returns
        columns : by name - input angle, magnitudes [mm/s], then directions from +x of the frame of the chains [deg]
    Source
        TY-460 report, sheets 1 and 2
    """
    import numpy as np

    from gearlink.core.base.rows import row_numbers
    from gearlink.core.machines.flatbed_press.mechanism import bare

    count = samples or 12
    degrees = np.array([360.0 * k / count for k in row_numbers(samples, count)])
    links = bare(design).moving.at(np.radians(degrees), 1).links
    at = {
        point: design.input_speed * links[link].at(point).first
        for point, link in {"B": "gear2", "C": "CDE", "E": "CDE", "F": "carriage", "H": "gear1", "M": "MN"}.items()
    }
    found: dict[str, Any] = {}
    for start, end in (("B", "C"), ("E", "F"), ("H", "M")):
        found |= {f"v_{start}": at[start], f"v_{end}{start}": at[end] - at[start], f"v_{end}": at[end]}
    columns: dict[str, tuple[Any, str]] = {"input_angle": (degrees, "deg")}
    columns |= {name: (np.abs(vector), "mm/s") for name, vector in found.items()}
    angles = {name: np.degrees(np.angle(vector)) for name, vector in found.items()}
    return columns | {f"{name}_direction": (angle, "deg") for name, angle in angles.items()}
