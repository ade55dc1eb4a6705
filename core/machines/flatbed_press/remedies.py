"""What to change in a flatbed press that fails: ways to go, and numbers from closed forms."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import TYPE_CHECKING

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.remedies.ways import (
    REFUSAL,
    Way,
    at_least,
    at_most,
    down,
    either,
    left_out,
    refusal_ways,
    shared,
    up,
)
from gearlink.core.base.spec_paths import changed
from gearlink.core.machines.flatbed_press.zone import zone_end
from gearlink.core.parts.cams.checks import HUB, ROLLER_SHARE
from gearlink.core.parts.gears.codes import AT_LIMITS
from gearlink.core.parts.linkages.slider_crank.position import SliderCrank

if TYPE_CHECKING:
    from gearlink.core.base.report import Remedy
    from gearlink.core.machines.flatbed_press.design import FlatbedPress

_LEAD_IN = 10.0
_STEEPEST = 1e-3
_ROUNDS = 20
"""So often a rod is found from its crank, which grows less than the rod does."""
_BEHIND = (15.0, 25.0, 40.0, 60.0)
"""Cam angles behind the end of the zone at which the lift may be greatest [deg]."""
_LINKS = tuple(
    f"{chain}.double_crank.{link}" for chain in ("bed", "cylinder") for link in ("frame", "coupler", "crank", "rocker")
)
_LARGER = (up("cam.base_radius"), up("cam.return_angle", step=0.5))
_ZONE = (left_out("sync.start"), up("cam.lead_in", step=1.0))
_LATER = (*shared("cam.transition_end", "cam.return_angle", step=0.5)[:1], down("cam.return_angle", step=0.5))
_GEARS = tuple(f"input_gears.profile_shift[{gear}]" for gear in (0, 1))
_SHIFTS = (*shared(*_GEARS, step=0.01), *either(*_GEARS, step=0.01))
_TEETH = (*either("input_gears.pressure_angle", step=0.5), down("input_gears.addendum", step=0.01))
_WIDER = (up("input_gears.face_width", step=1.0), Way(("input_gears.face_width[0]", "input_gears.face_width[1]"), 1.0))
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
    """The greatest lift farther behind the zone, with the base radius that its cams then need; none where one of them
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
    """A roller well below the least curvature radius, or a cam large enough for the roller."""
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
