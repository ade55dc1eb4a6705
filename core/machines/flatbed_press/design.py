"""The flatbed press as a design: chains, zone, cams, bodies that meet outside of the print, pinion and racks."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

from gearlink.core.base.candidates import Sought, table
from gearlink.core.base.design import Design, Found, Outline, placed
from gearlink.core.base.errors import MissingSection, NoSolution, at_key, in_section
from gearlink.core.base.remedies.ways import (
    MODULES,
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
from gearlink.core.base.report import Check, Remedy, Rule, Shown, Status, Table, safely_above, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.rows import row_numbers
from gearlink.core.base.spec_paths import changed
from gearlink.core.base.wording import short
from gearlink.core.machines.flatbed_press.chains import BedChain, CylinderChain, Travel, difference
from gearlink.core.machines.flatbed_press.codes import RACK_LENGTH, REGISTER, SYNC_LENGTH, SYNC_SPEED
from gearlink.core.machines.flatbed_press.compensation import Compensation, Joint, turns_back
from gearlink.core.machines.flatbed_press.zone import equal_speed_angle, turning_within, zone_end
from gearlink.core.numerics.motion_extremes import WithExtremes, extremes, names
from gearlink.core.numerics.roots import bracketed_root
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
from gearlink.core.parts.cams.disc_cams import DiscCams, OnDiscCams
from gearlink.core.parts.cams.laws import Law, law
from gearlink.core.parts.cams.shaped_design import LAW_CHECKS, LAW_TABLE, WithShapedLaws, is_shaped
from gearlink.core.parts.gears.checks import GEAR_CHECKS, GEAR_QUANTITIES, GearQuantities, gear_quantity
from gearlink.core.parts.gears.codes import AT_LIMITS
from gearlink.core.parts.gears.drawing_names import DERIVED, DRAWING_CHECKS, DRAWING_QUANTITIES, lacking
from gearlink.core.parts.linkages.checks import transmission_check
from gearlink.core.parts.linkages.codes import SHAFT_CLEARANCE
from gearlink.core.parts.linkages.dyad import acute
from gearlink.core.parts.linkages.fourbar.position import FourBar
from gearlink.core.parts.linkages.slider_crank import SLIDER_QUANTITIES, SliderCrank, SliderCrankQuantities
from gearlink.core.studies.clearance import LEAST_SHAFT_MODULES

if TYPE_CHECKING:
    from gearlink.core.machines.flatbed_press.spec import DoubleCrank, FlatbedPressSpec, PressCam
    from gearlink.core.mechanism.courses import Shown as Column
    from gearlink.core.mechanism.motion import Course
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.parts.cams.disc_cam import DiscCam
    from gearlink.core.parts.cams.profile import RollerPath
    from gearlink.core.parts.cams.shaped import Phase
    from gearlink.core.parts.gears.data import GearData
    from gearlink.core.parts.gears.mesh.pair import GearPair
    from gearlink.core.parts.gears.rack import RackMesh


_ROWS = 721
_NAME = SHAFT_CLEARANCE.checks[2]


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
            what, aside = "revolutions of the cylinder per sheet", "the print area passes the forme again"
            at, fix = f"input angles {short(low)} to {short(high)} deg", _whole_turns(design, 1)
            yield REGISTER.check("warn", what, float(turns), 1.0, aside=aside, at=at, fix=fix)
            return


def _whole_turns(design: FlatbedPress, count: int) -> str:
    """What lets the cylinder make so many revolutions per sheet."""
    if design.spec.cylinder.gears is None:
        return f"set cylinder.gear_ratio to {count}"
    return f"give gear 3 {f'{count} times ' if count > 1 else ''}as many teeth as gear 4 (cylinder.gears.teeth)"


# A share of the speed that is nothing but the rounding of the chains.
_ROUNDING = 1e-12

# Chains and zone


def _start_speed(design: FlatbedPress) -> Check:
    """What the speeds differ by at the start of the zone, where a jump would be a blow."""
    gap, cylinder = _speed_gap(design)
    share, limit = abs(gap / cylinder), 1e-3
    status: Status = "fail" if share > limit else "pass"
    return SYNC_SPEED.check(
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


def _turning_back(design: FlatbedPress) -> Iterator[Check]:
    motion = design.motion
    turning = motion.bed_turns_back
    if turning is not None:
        at, end = (math.degrees(angle) for angle in (turning, motion.sync_end))
        what, aside = "input angle at which the bed reverses", "end of the zone"
        key = "sync.length" if design.spec.sync.end is None else "sync.end"
        fix = f"set {key} to at most {_zone_before(design, turning)}"
        yield SYNC_LENGTH.check("fail", what, at, end, "deg", aside=aside, fix=fix)


def _zone_length(design: FlatbedPress) -> Check:
    length, asked = design.motion.zone_length, design.spec.sync.print_length
    if asked == 0.0:
        what, aside = "length of the synchronous zone", "no print_length given"
        return SYNC_LENGTH.check("pass", what, length, 0.0, "mm", shown=Shown(length, None, "mm"), aside=aside)
    remedy = "increase sync.length" if design.spec.sync.end is None else "increase sync.end"
    return SYNC_LENGTH.below(length, asked, asked, "mm", "travel of the cylinder in the zone", remedy)


# Cams


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
    return f"allow a larger pressure angle (a cam.base_radius of {safely_above(radius)} mm is too large to build)"


def _base_radius_for_roller(design: FlatbedPress) -> str:
    try:
        radius = design.cams.base_radius_for_roller(design.cams.base_radius)
    except NoSolution:
        return LARGER
    return _with_base_radius(design, radius)


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


_LEAD_IN = 10.0
_STEEPEST = 1e-3
_ROUNDS = 20
"""So often a rod is found from its crank, which grows less than the rod does."""
_BEHIND = (15.0, 25.0, 40.0, 60.0)
"""Cam angles behind the end of the zone at which the lift may be maximum [deg]."""
_OF_ROOM = (0.25, 0.5, 0.75, 1.0)
"""Shares of the cam angle between transition and next sheet that the return may take."""
_LINKS = tuple(
    f"{chain}.double_crank.{link}" for chain in ("bed", "cylinder") for link in ("frame", "coupler", "crank", "rocker")
)
_LARGER = (up("cam.base_radius"), up("cam.return_angle", step=0.5))
_ZONE = (left_out("sync.start"), up("cam.lead_in", step=1.0))
_LATER = (*shared("cam.transition_end", "cam.return_angle", step=0.5)[:1], down("cam.return_angle", step=0.5))
_GEARS = tuple(f"input_gears.profile_shift[{gear}]" for gear in (0, 1))
_SHIFTS = (*shared(*_GEARS, step=0.01), *either(*_GEARS, step=0.01))
_TEETH = (
    *either("input_gears.teeth", step=1),
    *either("input_gears.pressure_angle", step=0.5),
    down("input_gears.addendum", step=0.01),
)
_WIDER = (wider("input_gears.face_width"), wider("input_gears.face_width[0]", "input_gears.face_width[1]"))
_TOOTH_CHECKS = (
    "undercut",
    "tip-thickness",
    "involute-interference",
    "tooth-form",
    "fillet-interference",
    "tip-fouling",
)
_WAYS = {
    **dict.fromkeys(_TOOTH_CHECKS, (*_SHIFTS, *_TEETH)),
    "contact-ratio": (*_SHIFTS, *_TEETH[:4], up("input_gears.addendum", step=0.01)),
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


def _rod(design: FlatbedPress) -> Iterator[Remedy]:
    """The rod of the bed that keeps the limit, well or just; the crank grows with it."""
    bed, limit = design.spec.bed, design.spec.limits.transmission_angle
    for aim in (limit + 5.0, limit):
        rod, lean = bed.rod, math.cos(math.radians(aim))
        if math.degrees(design.motion.min_rod_angle) >= aim or lean < _STEEPEST:
            continue
        for _ in range(_ROUNDS):
            crank = bed.crank or SliderCrank(design.motion.bed_stroke / 2.0, rod, bed.offset).crank_length
            rod = (crank + abs(bed.offset)) / lean
        yield (("bed.rod", at_least(rod)),)


def _length(design: FlatbedPress) -> Iterator[Remedy]:
    """A zone as long as the print, by its length or its end; last a print that fits into zone and circumference."""
    sync, motion = design.spec.sync, design.motion
    if sync.start is not None:
        yield (("sync.start", None),)
    if motion.bed_turns_back is not None:
        yield _before_turning(design, motion.bed_turns_back)
    if sync.end is None:
        yield (("sync.length", sync.print_length),)
    else:
        end = math.degrees(zone_end(motion.cylinder, motion.sync_start, sync.print_length))
        yield (("sync.end", at_least(end, 0.5)),)
        yield ("sync.length", sync.print_length), ("sync.end", None)
    yield (("sync.print_length", at_most(min(motion.zone_length, math.tau * design.spec.cylinder.radius))),)


def _zone_before(design: FlatbedPress, turning: float) -> str:
    """The length of the zone, or its end, with which it ends where the bed turns back [rad]."""
    motion = design.motion
    if design.spec.sync.end is not None:
        return f"{safely_below(math.degrees(turning))} deg"
    travel = motion.cylinder.travel
    return f"{safely_below(float(travel(turning).value - travel(motion.sync_start).value))} mm"


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
        yield from _longer_return(design)


def _longer_return(design: FlatbedPress) -> Iterator[Remedy]:
    """A return over more of the cam angle that is left for it, with the base radius that its cams then need."""
    limit, given = math.radians(design.spec.limits.pressure_angle), design.cams.section.base_radius
    follower = design.cams.follower
    most = math.degrees(follower.cam_sync_start - follower.lead_in + math.tau - follower.transition_end)
    for share in _OF_ROOM:
        longer: Remedy = (("cam.return_angle", at_most(share * most, 0.5)),)
        spec = changed(design.spec, longer)
        if given is None or spec is None or share * most <= design.cams.section.return_angle:
            continue
        with suppress(NoSolution):
            radius = at_least(type(design)(spec).cams.base_radius_for(limit))
            yield longer if radius <= given else (*longer, ("cam.base_radius", radius))


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


def _refused(design: FlatbedPress) -> Iterator[Remedy]:
    """A law of the return that every command takes, and what lets the cams be."""
    yield (("cam.return_law", "cycloidal"),)
    if design.spec.sync.start is not None:
        yield (("sync.start", None),)
    if design.spec.cam is not None:
        yield from _pressure(design)


_CLOSED: dict[str, Callable[[FlatbedPress], Iterator[Remedy]]] = {
    REFUSAL: _refused,
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
        stroke = self.design.motion.slider_crank.stroke
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
                    yield found._replace(what=f"{PINION}: {found.what}")

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

    count = samples or 12
    degrees = np.array([360.0 * k / count for k in row_numbers(samples, count)])
    links = design.without_cam.moving.at(np.radians(degrees), 1).links
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


_SHOWN = ("profile_shift", "contact_ratio", "tip_thickness", "specific_sliding")


def input_gears(design: FlatbedPress) -> Table:
    """The modules of ISO 54 about the file's own, each with as many teeth as fit, the own with those of the file."""
    gears = design.spec.input_gears
    if gears is None:
        raise MissingSection("candidates are the input gears", key="input_gears", fix="give the section input_gears")
    near = sorted({*MODULES, gears.module}, key=lambda module: abs(module / gears.module - 1.0))[:7]
    keys = {"input_gears.module": ("module", "mm"), "input_gears.teeth": ("", "1")}
    rows = [(module, gears.teeth if module == gears.module else None) for module in sorted(near)]
    return table(design, Sought("gear", keys, rows, _SHOWN, counted={"teeth": lambda trial: trial.input_gear_teeth}))


# The motion of a flatbed press: input, both chains, and the zone in which they run together


class PressMotion:
    """Chains and synchronous zone of a design file; one that is to advise says in a refusal what would help."""

    def __init__(self, spec: FlatbedPressSpec, *, advise: bool = True) -> None:
        self.spec = spec
        self.advise = advise

    @cached_property
    def input_speed(self) -> float:
        """Angular velocity of the input [rad/s]: one revolution a sheet."""
        return self.spec.speed / 3600.0 * 2.0 * math.pi

    @property
    def turn_time(self) -> float:
        """Time of an input turn [ms]."""
        return 2e3 * math.pi / self.input_speed

    @cached_property
    def slider_crank(self) -> SliderCrank:
        """D-E-F, whose slider makes half the bed's stroke."""
        bed = self.spec.bed
        with at_key(self.bed_size):
            if bed.crank is not None:
                return SliderCrank.of_crank(bed.crank, bed.rod, bed.offset)
            assert bed.stroke is not None
            return SliderCrank(bed.stroke / 2.0, bed.rod, bed.offset)

    @property
    def bed_size(self) -> str:
        """The key that gives the size of the slider-crank."""
        return "bed.stroke" if self.spec.bed.crank is None else "bed.crank"

    @property
    def bed_stroke(self) -> float:
        """Stroke of the bed, twice the slider's [mm]."""
        return 2.0 * self.slider_crank.stroke if self.spec.bed.stroke is None else self.spec.bed.stroke

    @cached_property
    def bed(self) -> BedChain:
        """Drag link ABCD and slider-crank DEF."""
        bed, crank = self.spec.bed, self.slider_crank.crank_length
        return BedChain(_four_bar(bed.double_crank), math.radians(bed.crank_offset_angle), crank, bed.rod, bed.offset)

    @cached_property
    def cylinder(self) -> CylinderChain:
        """Drag link GHMN and the cylinder's gears."""
        cylinder = self.spec.cylinder
        angle = math.radians(cylinder.initial_crank_angle)
        return CylinderChain(_four_bar(cylinder.double_crank), angle, cylinder.radius, cylinder.ratio)

    @cached_property
    def min_transmission_angle_bed(self) -> float:
        """Minimum transmission angle of ABCD over the revolution [rad]."""
        return self.bed.linkage.min_transmission_angle()

    @cached_property
    def min_transmission_angle_cylinder(self) -> float:
        """Minimum transmission angle of GHMN over the revolution [rad]."""
        return self.cylinder.linkage.min_transmission_angle()

    @cached_property
    def min_rod_angle(self) -> float:
        """Minimum angle between the rod EF and the normal of the slide line over the revolution [rad]."""
        return math.acos((self.slider_crank.crank_length + abs(self.spec.bed.offset)) / self.spec.bed.rod)

    @cached_property
    def extremes(self) -> dict[str, float]:
        """Extremes of velocity and acceleration of the cylinder [mm/s, mm/s^2], and their places and those of the least
        transmission angles [rad]."""
        speed, cylinder = self.input_speed, self.cylinder
        curves = {
            "cylinder_velocity": lambda phi: cylinder.travel(phi, 1).first * speed,
            "cylinder_acceleration": lambda phi: cylinder.travel(phi, 2).second * speed**2,
        }
        return extremes(curves, 0.0, _TURN) | self._transmission_places()

    def _transmission_places(self) -> dict[str, float]:
        """Input angles of the minimum transmission angles: the driving crank then lies in the line of the frame."""
        bed, cylinder = (_crank_of_least(chain.linkage) for chain in (self.bed, self.cylinder))
        return {
            "min_transmission_angle_bed_at": (bed - self.bed.initial_crank_angle) % _TURN,
            "min_transmission_angle_cylinder_at": (self.cylinder.initial_angle - cylinder) % _TURN,
        }

    # The synchronous zone

    @cached_property
    def sync_start(self) -> float:
        """Input angle at the start of the zone [rad]."""
        given = self.spec.sync.start
        if given is not None:
            return math.radians(given)
        return equal_speed_angle(self.bed, self.cylinder, advise=self.advise, size=self.bed_size)

    @cached_property
    def sync_end(self) -> float:
        """Input angle at the end of the zone [rad]."""
        given = self.spec.sync.end
        if given is None:
            return zone_end(self.cylinder, self.sync_start, self.spec.sync.length)
        if math.radians(given) <= self.sync_start:
            start = math.degrees(self.sync_start)
            raise NoSolution(
                f"end of the zone: input angle {given:g} deg (limit > {safely_above(start)} deg, its start)",
                key="sync.end",
                fix=f"set sync.end above {safely_above(start)} deg, or omit it and give sync.length",
            )
        return math.radians(given)

    @cached_property
    def bed_turns_back(self) -> float | None:
        """First input angle within the zone at which the bed turns back [rad]; None where it never does."""
        return turning_within(self.bed, self.sync_start, self.sync_end)

    @cached_property
    def zone_length(self) -> float:
        """Cylinder travel in the zone [mm]: as asked for, unless the file says where the zone ends."""
        if self.spec.sync.end is None:
            return self.spec.sync.length
        return float(self.cylinder.travel(self.sync_end).value - self.cylinder.travel(self.sync_start).value)

    @cached_property
    def compensation(self) -> float:
        """Bed travel that the cam makes good in the zone [mm]."""
        gap = [float(difference(self.bed, self.cylinder, phi).value) for phi in (self.sync_start, self.sync_end)]
        return gap[1] - gap[0]

    @cached_property
    def cam_sync_start(self) -> float:
        """Cam angle at the start of the zone [rad]."""
        return float(self.bed.cam_angle(self.sync_start).value)

    @cached_property
    def cam_sync_end(self) -> float:
        """Cam angle at the end of the zone [rad]."""
        return float(self.bed.cam_angle(self.sync_end).value)


def _crank_of_least(linkage: FourBar) -> float:
    """Crank angle of the minimum transmission angle [rad], 0 or pi."""
    folded, stretched = map(acute, linkage.transmission_extremes())
    return 0.0 if folded <= stretched else math.pi


def _four_bar(links: DoubleCrank) -> FourBar:
    return FourBar(links.crank, links.coupler, links.rocker, links.frame, links.assembly)


# The compensation cam pair of a flatbed press: its follower, its size, main and return cam

# By so much of its limits a chosen radius keeps to the safe side: its cams are checked in other roundings.
_HAIR = 1e-9
_KEPT = 8192
_OF_SIZE = ("cam.base_radius", "cam")
"""Keys that say how large the cams are: the radius, or the section where `size` chooses it."""


def _require_rest(return_law: Law) -> None:
    if return_law.kind != "rest-to-rest":
        raise NoSolution(
            f"the return needs a law from rest to rest; {return_law.name} does not end at rest with rise 1"
        )


class PressCams(DiscCams):
    """The follower of the rack and the two cams that drive it both ways."""

    def __init__(self, spec: FlatbedPressSpec, motion: PressMotion) -> None:
        self.spec, self.motion = spec, motion

    @property
    def section(self) -> PressCam:
        """The section `cam` of the design file."""
        if self.spec.cam is None:
            raise MissingSection("`cam` needs the section cam: base_radius, roller_radius, ...", key="cam")
        return self.spec.cam

    @cached_property
    def follower(self) -> Compensation:
        """The lift of the compensation cam's follower."""
        cam, motion = self.section, self.motion
        with in_section("cam.return_law"):
            return_law = law("cycloidal" if self._shaped_return else cam.return_law)
            _require_rest(return_law)
        plain = Compensation(
            motion.bed,
            motion.cylinder,
            motion.sync_start,
            motion.sync_end,
            cam.transition,
            math.radians(cam.lead_in),
            self.transition_end,
            math.radians(cam.return_angle),
            return_law,
            self.spec.sync.end is not None,
        )
        return replace(plain, return_law=self._return_of(plain.top)) if self._shaped_return else plain

    @property
    def _shaped_return(self) -> bool:
        return is_shaped(self.section.return_law)

    def _return_of(self, rise: float) -> Law:
        """The law of a return that numbers shape, over the rise that it takes back [mm]."""
        with in_section("cam.return_law"):
            found = law(self.section.return_law, self.return_phase(rise))
            _require_rest(found)
        return found

    def return_phase(self, rise: float | None = None) -> Phase:
        """What the law of the return is told of its phase; the cam turns once a sheet."""
        from gearlink.core.parts.cams.shaped import Drive

        drive = Drive.of(self.spec, rate=2.0 * math.pi / 3600.0, unit="sheets/h")
        return drive.phase(math.radians(self.section.return_angle), rise)

    @property
    def transition_end(self) -> float:
        """Cam angle at which the lift is largest [rad]: given, or counted from the end of the zone."""
        cam = self.section
        if cam.transition_angle is not None:
            return self.motion.cam_sync_end + math.radians(cam.transition_angle)
        return math.radians(cam.transition_end or 0.0)

    @property
    def follower_stroke(self) -> float:
        """Maximum less minimum lift [mm]."""
        low, high = self.follower.lift_range
        return high - low

    # Size

    @property
    def is_sized(self) -> bool:
        """Whether the file gives the base radius, or says how it is chosen."""
        return self.spec.cam is not None and (self.spec.cam.base_radius is not None or self.spec.size is not None)

    @cached_property
    def base_radius(self) -> float:
        """Cam axis to roller centre at zero lift [mm], given or the minimum with which both cams pass their checks."""
        if self.section.base_radius is not None:
            return self.section.base_radius
        if self.spec.size is None:
            text = "give cam.base_radius, or size: {pressure_angle: 25} at the level of cam to have it chosen"
            raise MissingSection(text, key="cam.base_radius")
        return self.base_radius_for(math.radians(self.spec.size.pressure_angle))

    def base_radius_for(self, pressure_angle: float) -> float:
        """Minimum base radius [mm] for a pressure angle [rad] that leaves roller and shaft their room as well."""
        hub = HUB * self.section.shaft_radius * (1.0 + _HAIR) + self.section.roller_radius - self.follower.lift_range[0]
        return self.base_radius_for_roller(max(self.base_radius_for_pressure(pressure_angle), hub))

    def base_radius_for_pressure(self, pressure_angle: float) -> float:
        """Minimum base radius [mm] with which both cams keep a pressure angle [rad].

        r_b + s >= |s'|/tan(alpha)  and  r_b + s_max + s_min - s >= |s'|/tan(alpha)
        """
        import numpy as np

        from gearlink.core.numerics.extremes import maximum_over

        both = sum(self.follower.lift_range)

        def needed(theta: Reals) -> Reals:
            lift = self.follower.lift(theta, 1)
            nearer: Reals = np.minimum(lift.value, both - lift.value)
            radius: Reals = np.abs(lift.first) / math.tan(pressure_angle * (1.0 - 1e-3 * _HAIR)) - nearer
            return radius

        joints = tuple(segment.start % (2.0 * math.pi) for segment in self.follower.segments)
        return maximum_over(needed, joints=joints, samples=512).value

    def base_radius_for_roller(self, least: float) -> float:
        """Base radius [mm], from `minimum` on, whose pitch curves bend no sharper than the roller allows.

        rho_min(r_b) = r_g/0.8 of the sharper cam

        Raises
            NoSolution - where no cam of a thousand rollers' size is large enough
        Notes
            Within a step of doubling the curvature is taken to grow with the radius; the radius that is found is
            checked by its own cams.
        """
        roller = self.section.roller_radius
        wanted = roller / ROLLER_SHARE * (1.0 + _HAIR)

        def room(radius: float) -> float:
            return min(cam.min_curvature_radius.value for cam in self._pair(radius)) - wanted

        low = high = max(least, roller)
        while room(high) < 0.0:
            low, high = high, 2.0 * high
            if high > 1000.0 * (roller + self.follower_stroke):
                raise NoSolution(
                    f"base radius of the cams for a roller of {roller:g} mm: above {short(low)} mm, none found "
                    "(undercut)",
                    key="cam.roller_radius",
                    fix="increase cam.return_angle, or use a smaller roller",
                )
        return high if high == low else bracketed_root(room, low, high)

    @cached_property
    def roller_center_distance(self) -> float:
        """Distance of the two rollers [mm] that gives both cams the same largest radius."""
        return self._distance(self.base_radius)

    def _distance(self, base_radius: float) -> float:
        """L = 2 r_b + s_max + s_min; with s_min = 0 it is the report's 2 r_b + h

        Source
            TY-460 report 3.6
        """
        low, high = self.follower.lift_range
        return 2.0 * base_radius + high + low

    # The cams

    @property
    def max_radius(self) -> float:
        """Largest radius of either profile [mm]: where the lift is largest, the normal is radial."""
        return self.base_radius - self.section.roller_radius + self.follower.lift_range[1]

    @property
    def min_radius(self) -> float:
        """Smallest radius of either profile [mm]."""
        return self.base_radius - self.section.roller_radius + self.follower.lift_range[0]

    @property
    def main_cam(self) -> DiscCam:
        """The cam of roller 1: pitch radius r_b + s."""
        return self.discs[0]

    @property
    def return_cam(self) -> DiscCam:
        """The cam of roller 2: its centre stands at r_b + s - L on the same line."""
        return self.discs[1]

    @cached_property
    def discs(self) -> tuple[DiscCam, DiscCam]:
        """Main and return cam."""
        return self._pair(self.base_radius)

    @property
    def radii_at_rest(self) -> tuple[float, float]:
        """Where the centres of both rollers stand at zero lift, on the line of travel [mm]."""
        return self._at_rest(self.base_radius)

    def _at_rest(self, base_radius: float) -> tuple[float, float]:
        return base_radius, base_radius - self._distance(base_radius)

    def _pair(self, base_radius: float) -> tuple[DiscCam, DiscCam]:
        main, back = self._at_rest(base_radius)
        return self._disc_cam("main cam", main), self._disc_cam("return cam", back)

    def _disc_cam(self, name: str, at_zero_lift: float) -> DiscCam:
        from gearlink.core.parts.cams.disc_cam import DiscCam
        from gearlink.core.parts.cams.profile import translating

        def path(theta: Reals, order: int) -> RollerPath:
            lift = self._lift(theta, order)
            return translating(at_zero_lift + lift.value, lift.first, lift.second if order > 1 else 0.0)

        joints = tuple(segment.start for segment in self.follower.segments)
        key = _OF_SIZE[self.section.base_radius is None]
        return DiscCam(name, path, 1, self.section.roller_radius, joints, key)

    def _lift(self, theta: Reals, order: int) -> Travel:
        """The follower's lift; that of the last angles is kept, for both cams are looked at in the same places."""
        if theta.size > _KEPT:  # for the memory's sake
            return self.follower.lift(theta, order)
        places = theta.tobytes()
        if self._last.get(order, (b"",))[0] != places:
            self._last[order] = places, self.follower.lift(theta, order)
        return self._last[order][1]

    @cached_property
    def _last(self) -> dict[int, tuple[bytes, Travel]]:
        return {}

    def explained(self, refusal: NoSolution) -> NoSolution:
        """Where the bed turns back within the zone no size of the cams helps."""
        turned = turns_back(self.follower) if refusal.key in ("", *_OF_SIZE) and self.follows else None
        return turned or refusal

    def require_motion(self) -> None:
        """Compute chains and zone."""
        _ = self.motion.cam_sync_end

    @property
    def follows(self) -> bool:
        """Whether the follower's lift exists over the revolution."""
        try:
            return bool(self.follower.segments)
        except NoSolution:
            return False


# The motion of the bed itself: its chain's travel less the lift of the lower rack, where the press has its cam

_TURN = 2.0 * math.pi


class BedMotion:
    """Travel of the bed over arrays of the input angle."""

    def __init__(self, design: FlatbedPress) -> None:
        self.design = design

    @cached_property
    def _course(self) -> Course:
        from gearlink.core.machines.flatbed_press.mechanism import bed

        return bed(self.design)

    def travel(self, input_angle: Reals) -> Travel:
        """Travel of the bed [mm] and its first two derivatives by the input angle."""
        return Travel(*self._course.rates(self.design.moving, input_angle, 2))

    @property
    def joints(self) -> tuple[float, ...]:
        """Input angles in [0, 2 pi) at which the law of the lift changes [rad]."""
        return self.design.moving.input.joints

    @cached_property
    def extremes(self) -> dict[str, float]:
        """Extremes of velocity and acceleration of the bed [mm/s, mm/s^2] and their places [rad].

        Notes
            Where the lift's acceleration jumps both sides count.
        """
        speed = self.design.input_speed
        curves = {
            "bed_velocity": lambda phi: self.travel(phi).first * speed,
            "bed_acceleration": lambda phi: self.travel(phi).second * speed**2,
        }
        return extremes(curves, 0.0, _TURN, joints=self.joints)


_SYNC = ("sync_start", "sync_end", "cam_sync_start", "cam_sync_end", "compensation")
_CHAINS = ("min_transmission_angle_bed", "min_transmission_angle_cylinder")
_CAM = (
    "cam_base_radius",
    "end_slope",
    "transition_rise",
    "follower_stroke",
    "return_end",
    "roller_center_distance",
    "max_pressure_angle",
    "min_curvature_radius",
    "max_radius",
    "min_radius",
    "max_pressure_angle_at",
    "min_curvature_radius_at",
    "return_max_pressure_angle",
    "return_max_pressure_angle_at",
    "return_min_curvature_radius_at",
    "return_min_curvature_radius",
    "return_max_radius",
    "return_min_radius",
)
_PRESS_CHECKS = ("transmission-angle", "sync-speed", "sync-length", "register", "body-clearance")
_BEARING = ("pressure-angle", "cam-undercut", "shaft-clearance")
_CAM_CHECKS = (*_BEARING, "velocity-step", "acceleration-step", "constant-sum", "sync-length", *LAW_CHECKS)
_CAM_TABLES = ("follower", "main_cam", "return_cam")
_PRESS_QUANTITIES = ("crank_length", "bed_stroke", "initial_crank_angle", *_SYNC, *_CHAINS)


_BED_EXTREMES = names("bed_velocity", "bed_acceleration")
_EXTREMES = (
    "min_transmission_angle_bed_at",
    "min_transmission_angle_cylinder_at",
    *_BED_EXTREMES,
    *names("cylinder_velocity", "cylinder_acceleration"),
)


_OF_TEETH = frozenset((*OF_CYLINDER, *OF_PINION, *OF_RACKS))


class FlatbedPress(WithExtremes, WithShapedLaws, SliderCrankQuantities, GearQuantities, OnDiscCams):
    """A flatbed cylinder press, from its design file to every quantity that is asked for."""

    kind = "flatbed-press"
    spec: FlatbedPressSpec
    keys = {
        "press": (
            ("sync_start", "sync.start"),
            ("sync_end", "sync.end"),
            "compensation",
            "crank_length",
            "bed_stroke",
            "initial_crank_angle",
            ("min_transmission_angle_bed", ">limits.transmission_angle"),
            ("min_transmission_angle_cylinder", ">limits.transmission_angle"),
            "cam_sync_start",
            "cam_sync_end",
        ),
        "analyze": (
            ("sync_start", "sync.start"),
            ("sync_end", "sync.end"),
            "compensation",
            "crank_length",
            ("min_transmission_angle_bed", ">limits.transmission_angle"),
            ("min_transmission_angle_cylinder", ">limits.transmission_angle"),
            "bed_velocity_min",
            "bed_acceleration_min",
            "cylinder_acceleration_max",
            ("max_pressure_angle", "<limits.pressure_angle"),
        ),
        "cam": (
            ("max_pressure_angle", "<limits.pressure_angle"),
            ("return_max_pressure_angle", "<limits.pressure_angle"),
            "min_curvature_radius",
            "return_min_curvature_radius",
            "follower_stroke",
            "compensation",
            ("cam_base_radius", "cam.base_radius"),
            "roller_center_distance",
            "max_radius",
            "min_radius",
        ),
        "crank": ("crank_length", "bed_stroke", "quick_return_ratio", "max_stroke"),
    }
    outlines = {
        "press": Outline(_PRESS_QUANTITIES, _PRESS_CHECKS, ("positions",)),
        "cam": Outline((*_SYNC, *_CAM), _CAM_CHECKS, _CAM_TABLES),
        "crank": Outline(("crank_length", "bed_stroke", *SLIDER_QUANTITIES)),
        "gear": Outline(
            ("input_gear_teeth", *GEAR_QUANTITIES, *DRAWING_QUANTITIES, *OF_CYLINDER, *OF_PINION, *OF_RACKS),
            (*GEAR_CHECKS, *DRAWING_CHECKS, "rack-length"),
        ),
        "analyze": Outline((*_PRESS_QUANTITIES, *_EXTREMES), _PRESS_CHECKS, ("positions",)),
    }

    derived = DERIVED
    extreme_names = _EXTREMES
    at_once = 64
    alone = frozenset(("transmission-angle", "register", "body-clearance"))
    motion_extremes: dict[str, float] = placed("motion.extremes")
    extra_tables = (
        "chains",
        "polygons",
        "drawing",
        "factors",
        "cylinder_gears",
        "pinion_rack",
        "candidates",
        LAW_TABLE,
    )
    requirements = Design.requirements | {"sync.print_length"}
    cost = 5.0

    @classmethod
    def find_together(cls, designs: Sequence[FlatbedPress], names: Sequence[str]) -> None:
        """Extremes of the cams."""
        from gearlink.core.machines.flatbed_press.together import find_together

        if not {*_CAM, *_CAM_CHECKS}.isdisjoint(names):
            find_together([design.cams for design in designs if design.spec.cam is not None])

    def candidates(self, check: str) -> Iterator[Remedy]:
        """Remedies of a check from closed forms, the first to be tried first."""
        return _CLOSED[check](self) if check in _CLOSED else iter(())

    def ways_of(self, check: str) -> tuple[Way, ...]:
        """Ways in which a check that fails may be repaired; for cams that cannot be, those of their refusal."""
        if check == "pressure-angle" and self.cams.refusal is not None:
            return (*refusal_ways(self.spec, self.cams.refusal.key), *_LATER, *_ZONE, *_WAYS[check])
        return _WAYS.get(check, ())

    def completion(self) -> Iterator[Found]:
        """The base radius instead of the rule that chose it."""
        if self.spec.size is not None and self.spec.cam is not None and self.spec.cam.base_radius is None:
            yield Found("cam.base_radius", float(self.cams.base_radius), "found for size")
            yield Found("size", None)
        yield from self.solved_laws()

    def as_found(self) -> Iterator[Found]:
        """Teeth, shifts and tips that the nominal distance asks for: gears are cut once, wherever their axes lie."""
        yield from self.completion()
        gears, by = self.spec.input_gears, "found for input_gears.horizontal_distance"
        if gears is None:
            return
        try:
            pair = self.gear_pair
        except NoSolution:  # of the command gear, which says so
            return
        yield Found("input_gears.teeth", pair.teeth[0], by)
        if gears.profile_shift is None:
            yield Found("input_gears.profile_shift", list(pair.profile_shift), by)
        if gears.tip_shortening in (None, "full"):
            yield Found("input_gears.tip_shortening", list(pair.tip_alteration), by)

    @property
    def law_definitions(self) -> Mapping[str, Any]:
        """The law of the follower's return."""
        return {} if self.spec.cam is None else {"cam.return_law": self.spec.cam.return_law}

    def law_at(self, _path: str, /) -> Law:
        """The law of the follower's return."""
        return self.cams.follower.return_law

    def law_phase(self, _path: str, /) -> Phase:
        """The phase of the follower's return."""
        return self.cams.return_phase()

    def table_candidates(self, _samples: int | None = None) -> Table:
        """Input gears of other modules side by side."""
        return input_gears(self)

    # Parts

    @cached_property
    def motion(self) -> PressMotion:
        """Chains and synchronous zone."""
        return PressMotion(self.spec, advise=self.advises)

    @cached_property
    def cams(self) -> PressCams:
        """The compensation cams and their follower."""
        return PressCams(self.spec, self.motion)

    @cached_property
    def teeth(self) -> PressTeeth:
        """Gears 3 and 4, the pinion and its racks."""
        return PressTeeth(self)

    @cached_property
    def bed_motion(self) -> BedMotion:
        """The bed, the lift of its cam taken off where the file has one."""
        return BedMotion(self)

    @property
    def bed_moves(self) -> bool:
        """Whether the motion of the bed exists, for which a cam that the file has must have its lift."""
        return self.spec.cam is None or self.cams.follows

    @property
    def without_cam(self) -> FlatbedPress:
        """The same press without its cam: the lower rack stands."""
        return self if self.spec.cam is None else self._without_cam

    @cached_property
    def _without_cam(self) -> FlatbedPress:
        return type(self)(self.spec.model_copy(update={"cam": None}))

    @property
    def gear_distance(self) -> float:
        """Distance of the axes A and G of gears 1 and 2 [mm]; 0 without `input_gears`."""
        gears, bed = self.spec.input_gears, self.spec.bed
        return 0.0 if gears is None else math.hypot(gears.horizontal_distance, bed.offset - bed.double_crank.frame)

    @cached_property
    def gear_pair(self) -> GearPair:
        """Gears 1 and 2 on the axes A and G, equal (TY-460 report 1.1)."""
        from gearlink.core.parts.gears.from_spec import pair_at

        teeth, gears = self.input_gear_teeth, self.spec.input_gears
        assert gears is not None, "their teeth require it"
        with in_section("input_gears"):
            return pair_at(gears, (teeth, teeth), self.gear_distance)

    @property
    def input_gear_teeth(self) -> int:
        """Teeth of gears 1 and 2, given or as many as fit unshifted."""
        gears = self.spec.input_gears
        if gears is None:
            raise MissingSection("`gear` needs the section input_gears: module, horizontal_distance", key="input_gears")
        if gears.teeth is not None:
            return gears.teeth
        distance = self.gear_distance
        # A centre distance of whole teeth is not to lose one of them to the rounding of the quotient.
        transverse = gears.module / math.cos(math.radians(gears.helix_angle))
        teeth = math.floor(distance / transverse * (1.0 + 1e-12))
        if teeth < 1:
            raise NoSolution(
                f"module {gears.module:g} mm leaves no tooth at the centre distance {short(distance)} mm",
                key="input_gears.module",
                fix="reduce input_gears.module",
            )
        return teeth

    @cached_property
    def gear_data(self) -> GearData:
        """The input gears with all that their drawing needs."""
        from gearlink.core.parts.gears.from_spec import data_of, required_of

        pair = self.gear_pair
        assert self.spec.input_gears is not None, "the pair requires it"
        with in_section("input_gears"):
            return replace(data_of(self.spec.input_gears, pair), required=required_of(self.spec.limits))

    @property
    def mesh_data(self) -> dict[str, GearData]:
        """The meshes that the file draws: the input gears alone."""
        return {"": self.gear_data}

    input_speed: float = placed("motion.input_speed")
    angular_speed: float = placed("motion.input_speed")
    turn_time: float = placed("motion.turn_time")
    zone_length: float = placed("motion.zone_length")
    slider_crank: SliderCrank = placed("motion.slider_crank")
    bed: BedChain = placed("motion.bed")
    cylinder: CylinderChain = placed("motion.cylinder")
    follower: Compensation = placed("cams.follower")
    main_cam: DiscCam = placed("cams.main_cam")
    return_cam: DiscCam = placed("cams.return_cam")

    # Quantities

    @property
    def bed_stroke(self) -> float | None:
        """Stroke that a given crank makes [mm]; None where the file gives it."""
        return None if self.spec.bed.crank is None else self.motion.bed_stroke

    initial_crank_angle: float = placed("motion.bed.initial_crank_angle")
    min_transmission_angle_bed: float = placed("motion.min_transmission_angle_bed")
    min_transmission_angle_cylinder: float = placed("motion.min_transmission_angle_cylinder")
    sync_start: float = placed("motion.sync_start")
    sync_end: float = placed("motion.sync_end")
    cam_sync_start: float = placed("motion.cam_sync_start")
    cam_sync_end: float = placed("motion.cam_sync_end")
    compensation: float = placed("motion.compensation")
    cam_base_radius: float = placed("cams.base_radius")
    end_slope: float = placed("cams.follower.end_slope")
    transition_rise: float = placed("cams.follower.transition_rise")
    follower_stroke: float = placed("cams.follower_stroke")
    return_end: float = placed("cams.follower.return_end")
    roller_center_distance: float = placed("cams.roller_center_distance")
    max_pressure_angle: float = placed("cams.main_cam.max_pressure_angle.value")
    max_pressure_angle_at: float = placed("cams.main_cam.max_pressure_angle.place")
    min_curvature_radius_at: float = placed("cams.main_cam.min_curvature_radius.place")
    return_max_pressure_angle_at: float = placed("cams.return_cam.max_pressure_angle.place")
    return_min_curvature_radius_at: float = placed("cams.return_cam.min_curvature_radius.place")
    min_curvature_radius: float = placed("cams.main_cam.min_curvature_radius.value")
    max_radius: float = placed("cams.max_radius")
    min_radius: float = placed("cams.min_radius")
    return_max_pressure_angle: float = placed("cams.return_cam.max_pressure_angle.value")
    return_min_curvature_radius: float = placed("cams.return_cam.min_curvature_radius.value")
    return_max_radius: float = placed("cams.max_radius")
    return_min_radius: float = placed("cams.min_radius")

    def raw(self, name: str) -> Any:
        """Quantities of the gear pair are its own, and so are extremes of the bed."""
        if name in _BED_EXTREMES:
            return self.bed_motion.extremes[name]
        if name in _OF_TEETH:
            return self.teeth.quantity(name)
        if name in GEAR_QUANTITIES:
            return gear_quantity(self.gear_pair, name)
        if name not in DRAWING_QUANTITIES:
            return super().raw(name)
        with at_key("input_gears"):
            return self.gear_data.quantity(name)

    def needs(self, name: str) -> str:
        """The keys that the input gears lack for a quantity."""
        mesh, _, last = name.rpartition(".")
        if mesh:
            section = {"cylinder_gears": "cylinder.gears", "pinion_rack": "bed.pinion"}[mesh]
            given = self.spec.cylinder.gears if mesh == "cylinder_gears" else self.spec.bed.pinion
            return section if given is None else lacking(last, given, f"{section}.")
        return lacking(name, self.spec.input_gears, "input_gears.")

    def rests_on(self, name: str) -> str:
        """The factors of the rating."""
        from gearlink.core.parts.gears.strength_checks import rests_on

        return rests_on(name, self.gear_data) if name in DRAWING_QUANTITIES else ""

    @property
    def _shifts_given(self) -> bool:
        return self.spec.input_gears is not None and self.spec.input_gears.profile_shift is not None

    # Tables and checks

    def table_drawing(self, _samples: int | None = None) -> Table:
        """The gear table of the drawing of the input gears."""
        from gearlink.core.parts.gears.drawing import drawing_table

        with at_key("input_gears"):
            return drawing_table(self.gear_data)

    def table_factors(self, _samples: int | None = None) -> Table:
        """The calculation sheet of the rating of the input gears."""
        from gearlink.core.parts.gears.rating.sheet import factors_table

        with at_key("input_gears"):
            rated = self.gear_data.rated
            if rated is None:
                raise MissingSection("the table factors needs input_gears.rating", key="input_gears.rating")
            return factors_table(rated)

    def tables_of_data(self, command: str, /) -> tuple[str, ...]:
        """The calculation sheet of the input gears, where the file rates them."""
        given = self.spec.input_gears
        return ("factors",) if command == "gear" and given is not None and given.rating is not None else ()

    def table_cylinder_gears(self, _samples: int | None = None) -> Table:
        """The gear table of the drawing of gears 3 and 4."""
        from gearlink.core.parts.gears.drawing import drawing_table

        with at_key("cylinder.gears"):
            return replace(drawing_table(self.teeth.cylinder), name="cylinder_gears")

    def table_pinion_rack(self, _samples: int | None = None) -> Table:
        """The gear table of the drawing of pinion and racks."""
        from gearlink.core.parts.gears.drawing import rack_drawing

        with at_key("bed.pinion"):
            return replace(rack_drawing(self.teeth.pinion, None), name="pinion_rack")

    def table_polygons(self, samples: int | None = None) -> Table:
        """The velocity polygons of both chains at twelve positions."""
        return Table.of("polygons", polygons(self, samples))

    def table_positions(self, samples: int | None = None) -> Table:
        """Both chains at equal input angles (TY-460 report 1.2, 2.2), and the bed with the lift of its cam."""
        import numpy as np

        from gearlink.core.machines.flatbed_press.mechanism import bed, cylinder
        from gearlink.core.mechanism.courses import Shown, between, turned

        without = self.without_cam
        plain, surface = bed(without), cylinder(self)
        shown = [
            Shown("cam_angle", turned("CDE").less(self.bed.cam_angle_start)),
            Shown("bed_displacement", plain),
            Shown("bed_velocity", plain, 1),
            Shown("cylinder_displacement", surface),
            Shown("cylinder_velocity", surface, 1),
            Shown("transmission_angle_bed", between("BC", "CDE")),
            Shown("transmission_angle_cylinder", between("HM", "MN")),
        ]
        columns = without._in_time(samples or 12, shown)
        for name in ("cam_angle", "bed_velocity"):  # 0 at the start, which directions give to rounding
            values, unit = columns[name]
            columns[name] = np.where(columns["input_angle"][0] == 0.0, 0.0, values), unit
        if self.spec.cam is not None and self.bed_moves:
            with_cam = bed(self)
            shown = [Shown("compensated_displacement", with_cam), Shown("compensated_velocity", with_cam, 1)]
            columns |= self._in_time(samples or 12, shown)
        return Table.of("positions", columns)

    def _in_time(self, samples: int | None, shown: Sequence[Column]) -> dict[str, Any]:
        """Columns over the input angle, rates by time."""
        import numpy as np

        from gearlink.core.mechanism.courses import columns_of
        from gearlink.core.numerics.arrays import turn_degrees

        degrees = turn_degrees(samples)
        return {
            "input_angle": (degrees, "deg"),
            **columns_of(self.moving, np.radians(degrees), shown, self.input_speed),
        }

    def table_follower(self, samples: int | None = None) -> Table:
        """Lift of the follower over the cam angle (TY-460 report 3.4)."""
        import numpy as np

        from gearlink.core.numerics.arrays import turn_degrees

        degrees = turn_degrees(samples)
        lift, phases = self.cams.follower.evaluate(np.radians(degrees), 2)
        columns = {
            "cam_angle": (degrees, "deg"),
            "lift": (lift.value, "mm"),
            "velocity": (lift.first, "mm/rad"),
            "acceleration": (lift.second, "mm/rad^2"),
            "phase": (phases, "1"),
        }
        return Table.of("follower", columns)

    def table_chains(self, samples: int | None = None) -> Table:
        """Accelerations of bed and cylinder and the directions of all links over the input angle, with the time.

        Of a bed whose cam cannot be nothing is said.
        """
        from gearlink.core.machines.flatbed_press.mechanism import bed, cylinder
        from gearlink.core.mechanism.courses import Shown, turned

        # as gear 1 and its chain are turned there
        half_turn = 0.0 if self.spec.loads is None or self.spec.loads.bed_side > 0 else math.pi
        rates = [("bed", bed(self))] if self.bed_moves else []
        shown = [
            Shown(f"{name}_{rate}", course, order)
            for name, course in (*rates, ("cylinder", cylinder(self)))
            for order, rate in enumerate(("velocity", "acceleration"), 1)
        ]
        shown += [
            Shown("BC_angle", turned("BC")),
            Shown("CD_angle", turned("CDE")),
            Shown("DE_angle", turned("CDE").less(self.bed.crank_offset_angle)),
            Shown("rod_angle", turned("EF", sense=-1.0).less(0.5 * math.pi)),
            Shown("HM_angle", turned("HM").less(half_turn)),
            Shown("MN_angle", turned("MN").less(half_turn)),
        ]
        found = (self if self.bed_moves else self.without_cam)._in_time(samples, shown)
        time = found["input_angle"][0] / 360.0 * 3.6e6 / self.spec.speed
        return Table.of("chains", {"input_angle": found["input_angle"], "time": (time, "ms"), **found})

    def table_main_cam(self, samples: int | None = None) -> Table:
        """The main cam, point for point (TY-460 report 3.5)."""
        return self.main_cam.table("main_cam", samples)

    def table_return_cam(self, samples: int | None = None) -> Table:
        """The return cam, point for point (TY-460 report 3.6)."""
        return self.return_cam.table("return_cam", samples)

    def check_transmission_angle(self) -> Iterator[Check]:
        """GL303 for both chains, and for the rod of the bed's slider-crank."""
        limit, motion = self.spec.limits.transmission_angle, self.motion
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

    def check_register(self) -> Iterator[Check]:
        """GL506: the cylinder makes whole revolutions per sheet, and of several prints in one alone."""
        ratio = self.spec.cylinder.ratio
        off = abs(ratio - max(1, round(ratio)))
        shown = Shown(ratio, None, "per sheet")
        what, fix = "revolutions of the cylinder", _whole_turns(self, max(1, round(ratio)))
        aside = "a whole number is required" if off > 1e-9 else ""
        yield REGISTER.check("fail" if off > 1e-9 else "pass", what, off, 1e-9, shown=shown, aside=aside, fix=fix)
        yield from return_overlap(self)

    def check_body_clearance(self) -> Iterator[Check]:
        """GL302: crank AB, which gear 2 carries, over the axis G of gear 1, and crank GH over A.

        AB + r_s <= AG, the crank pin on its circle about A; r_s of the thinnest shaft
        """
        gears = self.spec.input_gears
        if gears is None:
            return
        bed = self.spec.bed
        apart, least = (
            math.hypot(gears.horizontal_distance, bed.offset - bed.double_crank.frame),
            LEAST_SHAFT_MODULES * gears.module,
        )
        cranks = (("AB", "G", bed), ("GH", "A", self.spec.cylinder))
        for name, other, part in cranks:
            reach = part.double_crank.crank
            gap = apart - reach - least
            yield SHAFT_CLEARANCE.check(
                "pass" if gap >= 0.0 else "warn",
                f"distance of the crank {name} from the minimum shaft at {other}",
                gap,
                0.0,
                "mm",
                name=_NAME,
                overlap=f"overlap of the crank {name} and the minimum shaft at {other}",
                aside=f"axes {short(apart)} mm apart",
                fix=f"end the shaft at {other} before the plane of the crank (overhung)",
            )

    def check_sync_speed(self) -> Iterator[Check]:
        """GL501: bed and cylinder at the start of the zone, and without a cam what their travels gather over it."""
        yield _start_speed(self)
        ahead = self.motion.compensation
        if self.spec.cam is None and abs(ahead) > _ROUNDING * self.motion.zone_length:
            side = "ahead of" if ahead > 0.0 else "behind"
            what = f"travel of the bed {side} the cylinder at the end of the zone, without a compensation cam"
            yield SYNC_SPEED.check("warn", what, abs(ahead), 0.0, "mm", fix="give the section cam")

    def check_sync_length(self) -> Iterator[Check]:
        """GL502: the zone covers the print and ends before the bed turns back; the print finds room on the cylinder."""
        yield _zone_length(self)
        yield from _turning_back(self)
        asked, room = self.spec.sync.print_length, math.tau * self.spec.cylinder.radius
        if asked > room:
            what, aside = "circumference of the cylinder", "print length"
            fix = f"set sync.print_length to at most {safely_below(room)} mm"
            yield SYNC_LENGTH.check("fail", what, room, asked, "mm", aside=aside, fix=fix)

    def check_pressure_angle(self) -> Iterator[Check]:
        """GL401 for both cams; it fails as well where no cam can make the motion at all."""
        limit = self.spec.limits.pressure_angle
        if self.cams.refusal is not None:
            yield impossible("no cam pair is possible", self.cams.refusal, limit)
            return
        over = self.advises and max(cam.max_pressure_angle.value for cam in self.cams.discs) > math.radians(limit) > 0.0
        remedy = _larger(self, limit) if over else ""
        yield from pressure_angle_checks(self.cams.discs, limit, remedy)

    def check_cam_undercut(self) -> Iterator[Check]:
        """GL402 for both cams."""
        larger = partial(_base_radius_for_roller, self) if self.advises else str
        if self.cams.refusal is None:
            yield from undercut_checks(self.cams.discs, larger)

    def check_shaft_clearance(self) -> Iterator[Check]:
        """GL302: the profiles against the cam shaft."""
        if self.cams.refusal is not None:
            return
        base = self.cams.base_radius
        yield from hub_checks(
            SHAFT_CLEARANCE,
            self.cams.discs,
            self.cams.section.shaft_radius,
            lambda missing: f"set cam.base_radius to at least {safely_above(base + missing)} mm",
        )

    def check_constant_sum(self) -> Check:
        """GL405: the two pitch radii in contact add up to the roller distance at every cam angle."""
        import numpy as np

        theta, distance = np.radians(np.arange(0.0, 360.0, 1.0)), self.cams.roller_center_distance
        radii = [np.abs(cam.points(theta)[0]) for cam in self.cams.discs]
        off = float(np.abs(radii[0] + radii[1] - distance).max())
        limit = 1e-9 * distance
        what, aside = "deviation of the sum of the pitch radii", f"roller distance {short(distance)} mm"
        fix = "increase cam.base_radius: the return cam's roller passes the cam axis"
        return CONSTANT_SUM.check("fail" if off > limit else "pass", what, off, limit, "mm", aside=aside, fix=fix)

    def check_velocity_step(self) -> Check:
        """GL403 at every joint of the lift."""
        remedy = "remove sync.start, so that the zone starts where the speeds are equal"
        return _steps(self, VELOCITY_STEP, "first", "mm/rad", "fail", remedy)

    def check_acceleration_step(self) -> Check:
        """GL404 at every joint of the lift."""
        follower = self.cams.follower
        at_ends = max(abs(follower.return_law.evaluate(x, 2)[2]) for x in (0.0, 1.0))
        changes = (
            (follower.lead_in == 0.0, "give a cam.lead_in before the zone"),
            (follower.transition != "quartic", "set cam.transition to quartic"),
            (at_ends > 1e-9, "set cam.return_law to cycloidal"),
        )
        remedy = ", ".join(words for missing, words in changes if missing)
        return _steps(self, ACCELERATION_STEP, "second", "mm/rad^2", "warn", remedy)

    def check(self, name: str) -> list[Check]:
        """Gear checks come from the gear pair, all others are the press's own."""
        if name not in GEAR_CHECKS and name not in DRAWING_CHECKS:
            return super().check(name)
        from gearlink.core.parts.gears.drawing_checks import pair_check

        found: list[Check] = []
        if self.spec.input_gears is not None or not self.teeth.names:
            with at_key("input_gears"):
                found = pair_check(name, self.gear_data, self.spec.limits, shifts=self._shifts_given)
        return [*found, *self.teeth.checks(name)]

    def check_rack_length(self) -> Iterator[Check]:
        """GL346."""
        return self.teeth.check_racks()

    @classmethod
    def judged(cls, command: str, spec: Any, /) -> tuple[str, ...]:
        """`press` judges whether the cams can bear the motion, `analyze` the cams."""
        of_cams = {} if spec.cam is None else {"press": _BEARING, "analyze": _CAM_CHECKS}
        return tuple(dict.fromkeys((*super().judged(command, spec), *of_cams.get(command, ()))))

    def outline(self, command: str) -> Outline:
        """With the section `cam`, `press` judges whether the cams can bear the motion; `analyze` shows them too."""
        outline = self.outlines[command]
        if command == "gear":
            others = self.teeth.names
            own = outline.quantities if self.spec.input_gears is not None or not others else ()
            checks = outline.checks if self.spec.bed.rack_teeth is not None else outline.checks[:-1]
            shown = (*(name for name in own if name not in _OF_TEETH), *others)
            return outline._replace(quantities=shown, checks=checks)
        if command not in ("press", "analyze") or self.spec.cam is None:
            return outline
        bearing = _BEARING if self.cams.is_sized else ()
        if command == "press":
            return Outline(outline.quantities, (*outline.checks, *bearing), outline.tables)
        if bearing and self.cams.is_refused:
            left_out = () if self.bed_moves else _BED_EXTREMES
            quantities = tuple(name for name in outline.quantities if name not in left_out)
            return Outline(quantities, (*outline.checks, *bearing), outline.tables)
        return Outline(
            (*outline.quantities, *_CAM),
            tuple(dict.fromkeys([*outline.checks, *_CAM_CHECKS])),
            (*outline.tables, *_CAM_TABLES),
        )
