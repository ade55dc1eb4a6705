"""The loads of a flatbed press: what presses the rollers of its cams, beside what all machines have."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from gearlink.core.base.design import geometry
from gearlink.core.base.errors import MissingSection
from gearlink.core.base.report import NO_NUMBER, Check, Shown, Status, safely_above
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short
from gearlink.core.machines.flatbed_press import mechanism
from gearlink.core.machines.flatbed_press.codes import PLACE
from gearlink.core.machines.flatbed_press.design import FlatbedPress
from gearlink.core.mechanism.joints import Pin, Rack
from gearlink.core.mechanism.rates import Turn, from_start
from gearlink.core.studies.loads.cams import CAM_CHECKS, CONTACT, CamLoadsDesign
from gearlink.core.studies.loads.design import Wanted, loads_outline

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from gearlink.core.machines.flatbed_press.loads_spec import PressLoads as Section
    from gearlink.core.machines.flatbed_press.spec import FlatbedPressSpec
    from gearlink.core.mechanism.motion import Motion
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.studies.loads.contact import RollerOnCam


PLACE_CHECKS = PLACE.checks
_NEAR = 1.0
"""A direction of whole degrees [deg]."""
_DRAWN = "set loads.bed_side to -1 and gravity to [9.81, 0] (the machine as drawn: the cylinder is above the bed)"


class _Places(NamedTuple):
    """Where the parts stand in the frame of the loads [mm]."""

    axes: dict[str, complex]
    """of the shafts that stand still, those that are known"""
    cylinder: complex
    slide: float
    """x of the slide line"""
    pitch_line: float
    """x of the pitch line of the bed's rack"""


def _places(design: PressLoads) -> _Places:
    """Out of the joints that bear the forces; without a direction of gear 1 its axis stands on the slide line."""
    pins, racks = design.places
    slide, known = pins["F"].real, design.section.gear_1_direction is not None
    shift = 0.0 if known else slide - pins["G"].real
    axes = {name: pins[name] for name in "ADGN"} if known else {}
    return _Places(axes, pins["cylinder"] + shift, slide, racks["rack_upper"].real)


def _beside_bed(design: PressLoads, at: _Places, direction: float) -> Check:
    """The bed runs along +y, the cylinder turns counter-clockwise: at the printing line, which lies at the maximum x
    of the cylinder, both run the same way."""
    radius = design.spec.cylinder.radius
    room = at.pitch_line - at.cylinder.real - radius
    fix = _DRAWN if design.section.bed_side > 0 else _clear(design, at, direction)
    what = "distance of the cylinder from the pitch line of the bed's rack"
    shown: Shown | None = NO_NUMBER
    if at.cylinder.real >= at.pitch_line:
        what = "the surface of the cylinder runs against the bed"
    elif design.section.bed_side > 0:
        over = at.cylinder.real + radius > at.slide
        what = f"the cylinder lies on the side of the pinion{', over the slide line' if over else ''}"
    else:
        shown = None
    status: Status = "warn" if shown or room < 0.0 else "pass"
    overlap = "overlap of the cylinder and the pitch line of the bed's rack"
    return PLACE.check(status, what, room, 0.0, "mm", shown=shown, overlap=overlap, fix=fix)


def _clear(design: PressLoads, at: _Places, direction: float) -> str:
    """The directions in which the cylinder stands clear of the bed's rack."""
    distance = sum(design.pitch_radii)
    n = at.cylinder.real - distance * math.cos(math.radians(direction))
    share = (at.pitch_line - design.spec.cylinder.radius - n) / distance
    if share < -1.0:
        return f"set the gears at least {safely_above(-share * distance)} mm apart"
    least = math.degrees(math.acos(share))
    low, high = math.ceil(10.0 * least) / 10.0, math.floor(10.0 * (360.0 - least)) / 10.0
    return f"set loads.cylinder_direction from {low:g} to {high:g} deg"


_TURN = 2.0 * math.pi


class PressLoads(CamLoadsDesign):
    """The twelve links of the machine; input angle and senses are the press's own."""

    kind = "flatbed-press"
    spec: FlatbedPressSpec
    section: Section
    links = ("gear2", "BC", "CDE", "EF", "carriage", "pinion", "rack", "bed", "gear1", "HM", "MN", "cylinder")
    sliding = ("carriage", "rack", "bed")
    pins = ("A", "B", "C", "D", "E", "F", "F_pinion", "G", "H", "M", "N", "cylinder")
    meshes = ("mesh_12", "mesh_34", "rack_lower", "rack_upper")
    output = "bed"
    outlines = loads_outline(pins, meshes, CONTACT, (*CAM_CHECKS, *PLACE_CHECKS))
    on_two_sides = has_pair = True
    design: cached_property[FlatbedPress] = geometry(FlatbedPress)

    @property
    def given_speed(self) -> float:
        """Sheets an hour, one revolution of the input each."""
        return self.spec.speed

    @cached_property
    def speed(self) -> float:
        """One turn of the input a sheet [rad/s]."""
        return self.design.input_speed

    @property
    def quiet_zones(self) -> list[tuple[float, float]]:
        """The synchronous zone."""
        motion = self.design.motion
        return [(motion.sync_start, motion.sync_end - motion.sync_start)]

    @property
    def transmission_angle(self) -> float:
        """The minimum of both chains and the rod [rad]."""
        motion = self.design.motion
        return min(motion.min_transmission_angle_bed, motion.min_transmission_angle_cylinder, motion.min_rod_angle)

    @property
    def unknown_joints(self) -> tuple[str, ...]:
        """Bearings whose forces depend on where the gears' axes stand."""
        gears = () if self.section.gear_1_direction is not None else ("A", "G")
        return gears if self.section.cylinder_direction is not None else (*gears, "N", "cylinder")

    @cached_property
    def pitch_radii(self) -> tuple[float, float]:
        """Of gears 3 and 4 [mm]."""
        return mechanism.pitch_radii(self.design)

    @cached_property
    def pinion_radius(self) -> float:
        """Pitch radius of the pinion [mm]."""
        return mechanism.pinion_radius(self.design)

    @property
    def moving(self) -> Motion:
        """The motion of the twelve links, which needs cam and input gears."""
        if self.spec.cam is None:
            raise MissingSection(
                "`loads` of a press needs the section cam: its follower moves the lower rack", key="cam"
            )
        _ = self.design.gear_pair, self.design.cams.base_radius
        return self.design.moving

    def check_cylinder_place(self) -> Iterator[Check]:
        """GL516: the cylinder beside the bed on which it rolls, and beside the axes."""
        direction = self.section.cylinder_direction
        if direction is None:
            return
        at, radius = _places(self), self.spec.cylinder.radius
        yield _beside_bed(self, at, direction)
        for name, axis in at.axes.items():
            room = abs(at.cylinder - axis) - radius
            if room < 0.0:
                what, fix = f"overlap of the cylinder and the axis {name}", "turn loads.cylinder_direction"
                yield PLACE.check("warn", what, room, 0.0, "mm", overlap=what, fix=fix)

    def check_gear_direction(self) -> Iterator[Check]:
        """GL516: the direction from A to G against that of the axes' distances."""
        given, gears, bed = self.section.gear_1_direction, self.spec.input_gears, self.spec.bed
        if given is None or gears is None:
            return
        across, up = gears.horizontal_distance, bed.double_crank.frame - bed.offset
        wanted = math.degrees(math.atan2(across, up))
        off, nearest = min((abs(math.remainder(given - at, 360.0)), at) for at in (wanted, -wanted))
        what = "deviation of loads.gear_1_direction from the direction of the axes"
        fix = f"set loads.gear_1_direction to {short(nearest)} deg"
        status: Status = "warn" if off > _NEAR else "pass"
        yield PLACE.check(status, what, off, _NEAR, "deg", name=PLACE.checks[1], side="<=", fix=fix)

    @cached_property
    def places(self) -> tuple[dict[str, complex], dict[str, complex]]:
        """Where pins and racks stand at input angle 0 [mm], in the frame of the forces."""
        joints = self._connections
        return (
            {each.name: complex(each.at[0]) for each in joints if isinstance(each, Pin)},
            {each.name: complex(each.pitch_point[0]) for each in joints if isinstance(each, Rack)},
        )

    @property
    def dwell_zones(self) -> list[tuple[float, float]]:
        """The bed does not stand anywhere."""
        return []

    speed_unit, speed_unit_name, speed_words = _TURN / 3600.0, "sheets/h", "sheets/h"
    speed_seconds = 3600.0

    # Rollers

    def roller_at(self, name: str, phi: Reals) -> RollerOnCam:
        """A roller of the rack's follower from the cam axis, over the angle turned by the cams."""
        from gearlink.core.studies.loads.contact import RollerOnCam

        cams, links = self.design.cams, self.machine.at(phi)
        cam = mechanism.follower_lift(links)
        at = cams.base_radius if name == "main" else cams.base_radius - cams.roller_center_distance
        rates = (at + cam.value, cam.first, cam.second)
        position, first, second = (1j * part for part in rates)
        return RollerOnCam(position, first, second, 1, cams.section.roller_radius)

    def _cam_turn(self, phi: Reals) -> Turn:
        """Angle turned by the cams."""
        return from_start(self.machine.at(phi).links["CDE"].turn, self.design.bed.cam_angle_start)

    def contact_force(self, name: str, phi: Reals) -> Reals:
        """Out of the reactions: the main cam pushes, the return cam pulls back; with a preload both press."""
        from gearlink.core.studies.loads.contact import positive_drive

        net = self.side_force(phi)
        if not self._preload:
            return np.asarray(np.maximum(net if name == "main" else -net, 0.0))
        both = positive_drive(net, self._preload, self.roller_stiffness)
        return both[0] if name == "main" else both[1]

    def side_force(self, phi: Reals) -> Reals:
        """What the cams give the follower of the rack along +y [N], less a preload."""
        found: Reals = self.machine.reactions(phi).unknowns["cam"][0]
        return found

    @property
    def _preload(self) -> float:
        roller = self.section.roller
        return 0.0 if roller is None else roller.preload

    @cached_property
    def preload_needed(self) -> float | None:
        """Minimum preload that keeps both rollers on their cams [N]; equal stiffness where the file gives none."""
        if self.section.roller is None:
            return None
        return self.extreme_of("preload").value

    def _needed(self, phi: Reals) -> Reals:
        share = self.roller_stiffness[0] / sum(self.roller_stiffness)
        net = self.side_force(phi)
        return np.asarray(np.maximum(net * (1.0 - share), -net * share))

    def course(self, name: str) -> Callable[[Reals], Reals]:
        """The preload that an input angle needs as well."""
        return self._needed if name == "preload" else super().course(name)

    def wanted(self, quantity: str) -> Iterable[Wanted]:
        if quantity in ("preload_needed", "preload") and self.section.roller is not None:
            return (("preload", True),)
        return super().wanted(quantity)

    def cam_speed(self, phi: Reals) -> Reals:
        """Speed of CDE [rad/s]."""
        found: Reals = self._cam_turn(phi).first * self.speed
        return found

    def cam_acceleration(self, phi: Reals) -> Reals:
        found: Reals = self._cam_turn(phi).second * self.speed**2
        return found

    def cam_degrees(self, phi: Reals) -> Reals:
        """Angle turned by the cams [deg]."""
        return np.degrees(self._cam_turn(phi).value)
