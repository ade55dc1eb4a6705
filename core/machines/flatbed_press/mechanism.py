"""The mechanism of a flatbed press: both chains from gears 1 and 2 to bed and cylinder, racks and the cam's follower.

Frame: A at 0, D on +x (which is the machine's vertical), the bed travels along +y. The lower rack and the follower of
the cams move by the lift along +y. Bed and lower rack lie on two sides of F along x, N lies from G along x as the bed
from F: towards +x, or towards -x as the machine is drawn (`loads.bed_side`).
"""

from __future__ import annotations

import cmath
import math
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.machines.flatbed_press.chains import Travel
from gearlink.core.machines.flatbed_press.loads_spec import PressLoads as Section
from gearlink.core.mechanism.closures import slider
from gearlink.core.mechanism.courses import coordinate, turned
from gearlink.core.mechanism.joints import Connection, Contact, Guide, Mesh, Pin, Rack
from gearlink.core.mechanism.links import FRAME, Later, Link, Mechanism
from gearlink.core.mechanism.motion import TURN, Course, Input, Motion, Output
from gearlink.core.mechanism.rates import Point, Turn, carried, fixed, from_start, mixed, standing, steady
from gearlink.core.mechanism.vectors import least_transmission
from gearlink.core.parts.linkages.fourbar import position as fourbar
from gearlink.core.parts.linkages.fourbar.mechanism import turns

if TYPE_CHECKING:
    from gearlink.core.machines.flatbed_press.design import FlatbedPress
    from gearlink.core.numerics.arrays import Reals

_PINION = 5.0 / 31.0
_GEAR_4 = 34.0 / 35.0
_RACK_ANGLE = math.radians(20.0)
SLIDING = ("carriage", "rack", "bed")


def motion(design: FlatbedPress) -> Motion:
    """Links and joints over the input angle.

    Without the section `cam` the lower rack stands, and no cam is on D; with one whose size is open its rack moves, but
    no roller is on it. Without `input_gears` gear 1 stands on the
    axis of gear 2, and their mesh is left out.

    Raises
        NoSolution - where a chain does not turn, or the cam that the file asks for cannot be
    """
    press = _Press(design)
    zone = (("sync", design.sync_start, design.sync_end),)
    outputs = Output("Bed", bed(design), press.phases or zone), Output("Cylinder surface", cylinder(design), zone)
    return Motion(press.at, Input(joints=press.joints), outputs, transmission=least_transmission("C", "M", "F"))


def bed(design: FlatbedPress) -> Course:
    """Travel of the bed from input angle 0, where it stands at its dead centre [mm]."""
    start = _Press(design).rods(np.zeros(1), 0)["carriage"].origin.value[0]
    return coordinate("bed", along=1j).less(2.0 * float(start.imag))


def cylinder(design: FlatbedPress) -> Course:
    """Travel of the cylinder's surface from input angle 0 [mm]."""
    return turned("cylinder").scaled(design.spec.cylinder.radius, "mm")


def pitch_radii(design: FlatbedPress) -> tuple[float, float]:
    """Of gears 3 and 4 [mm]: those of their teeth, where the file gives them."""
    if design.spec.cylinder.gears is not None:
        one, other = design.teeth.cylinder.pair.working_radius
        return one, other
    given = _section(design).cylinder_gear_radius
    gear_4 = design.spec.cylinder.radius * _GEAR_4 if given is None else given
    return gear_4 * design.spec.cylinder.ratio, gear_4


def pinion_radius(design: FlatbedPress) -> float:
    """Pitch radius of the pinion [mm]: that of its teeth, where the file gives them."""
    if design.spec.bed.pinion is not None:
        return design.teeth.pinion.pair.reference_radius[0]
    given = _section(design).pinion_radius
    return design.motion.bed_stroke * _PINION if given is None else given


def _section(design: FlatbedPress) -> Section:
    found: Section = Section.model_construct() if design.spec.loads is None else design.spec.loads
    return found


def follower_lift(mechanism: Mechanism) -> Travel:
    """Lift of the follower over the angle of the cams, with two derivatives by it [mm], where links were computed."""
    found: Travel = mechanism.once("lift", _no_cam)
    return found


def _no_cam() -> Travel:
    raise AssertionError("this press has no cam")


class _Press:
    """The links at input angles."""

    def __init__(self, design: FlatbedPress) -> None:
        self.design, self.section = design, _section(design)
        self.side = float(self.section.bed_side)
        self.follower = None if design.spec.cam is None else design.cams.follower
        cam = design.spec.cam
        self.has_profile = design.spec.size is not None or (cam is not None and cam.base_radius is not None)
        self.to_bed = self.side * pinion_radius(design)

    @property
    def phases(self) -> tuple[tuple[str, float, float], ...]:
        """The stretches of the follower's law in the order of the turn."""
        if self.follower is None:
            return ()
        angle = self.design.motion.bed.input_angle
        return tuple((each.phase, float(angle(each.start)), float(angle(each.end))) for each in self.follower.segments)

    @property
    def joints(self) -> tuple[float, ...]:
        """Input angles at which the follower's law changes [rad]."""
        return tuple(sorted(start % TURN for _, start, _ in self.phases))

    def at(self, phi: Reals, order: int, _side: int) -> Mechanism:
        """All links; one derivative at least, for the normals of the rollers."""
        order = max(order, 1)
        links = self.rods(phi, order)
        self._cylinder_chain(links, phi, order)
        cam = self._racks(links, phi)

        def joints() -> list[Connection]:
            follower = [self._follower_joint(links, cam)] if cam is not None and self.has_profile else []
            return [*self._bed_joints(links), *follower, *self._cylinder_joints(links)]

        drive, sense = ("gear2", 1.0) if self.section.drive_gear == 2 else ("gear1", -1.0)
        made = Mechanism(links, Later(joints), drive, sense, travel={name: 1j for name in SLIDING if name in links})
        if cam is not None:
            made.once("lift", lambda: cam)
        return made

    # Bed

    def rods(self, phi: Reals, order: int) -> dict[str, Link]:
        """The links from gear 2 to the carriage."""
        chain = self.design.motion.bed
        four = chain.linkage
        coupler, rocker = turns(four, chain.initial_crank_angle + phi, order)
        start = steady(phi, 1.0, chain.initial_crank_angle, order=order)
        gear2 = Link(fixed(0j, phi, order=order), start, {"A": 0.0, "B": four.crank})
        pivot = fixed(four.frame, phi, order=order)
        e = carried(pivot, from_start(rocker, chain.crank_offset_angle), chain.slider_crank_length)
        rod, f = slider(e, chain.rod, four.frame - chain.offset + 0j, -1j)
        return {
            "gear2": gear2,
            "BC": Link(gear2.at("B"), coupler, {"B": 0.0, "C": four.coupler}),
            "CDE": Link(pivot, rocker, {
                "D": 0.0, "C": four.rocker, "E": cmath.rect(chain.slider_crank_length, -chain.crank_offset_angle),
            }),
            "EF": Link(e, rod, {"E": 0.0, "F": chain.rod}),
            "carriage": Link(f, standing(0.0, phi, order=order), {"F": 0.0}),
        }  # fmt: skip

    def _lift(self, phi: Reals, links: dict[str, Link]) -> tuple[Travel, tuple[Reals, ...]]:
        """The lift over the cam's angle, two derivatives at most, and by the input angle as many as CDE has [mm].

        s' c',  s'' c'^2 + s' c'',  s''' c'^3 + 3 s'' c' c'' + s' c''';  in the zone p''' - q'''
        """
        rocker, follower = links["CDE"].turn, self.follower
        assert follower is not None, "there is a cam"
        angle, order = rocker.value - self.design.bed.cam_angle_start, min(rocker.order, 2)
        cam = follower.lift_at(phi, Travel(angle, *rocker[1 : order + 1]), order)
        parts = [cam.value, cam.first * rocker.first]
        if rocker.order > 1:
            parts.append(cam.second * rocker.first**2 + cam.first * rocker.second)
        if rocker.order > 2:
            third = follower.jerk(angle)
            bend = third * rocker.first**3 + 3.0 * cam.second * rocker.first * rocker.second + cam.first * rocker.third
            surface = self.design.spec.cylinder.radius * links["cylinder"].turn.third
            parts.append(np.where(np.isnan(third), 2.0 * links["carriage"].origin.third.imag - surface, bend))
        return cam, tuple(parts)

    def _racks(self, links: dict[str, Link], phi: Reals) -> Travel | None:
        """Pinion, lower rack and bed, put to the links that move them; the lift of the follower."""
        f, still = links["carriage"].origin, links["carriage"].turn
        cam, lift = None, tuple(np.zeros_like(phi) for _ in f)
        if self.follower is not None:
            cam, lift = self._lift(phi, links)
        rolled = [(part.imag - value) / self.to_bed for part, value in zip(f, lift, strict=True)]
        travel = tuple(2.0 * part.imag - value for part, value in zip(f, lift, strict=True))
        links["pinion"] = Link(f, Turn(rolled[0] - self._rolled_at_start, *rolled[1:]), {"F": 0.0})
        if self.follower is not None:
            links["rack"] = Link(_sliding(f.value.real - self.to_bed, lift), still)
        links["bed"] = Link(_sliding(f.value.real + self.to_bed, travel), still)
        return cam

    @cached_property
    def _rolled_at_start(self) -> float:
        """What the pinion has rolled at input angle 0, where its own x axis lies along that of the frame [rad]."""
        start = np.zeros(1)
        links = self.rods(start, 1)
        lift = 0.0 if self.follower is None else float(self._lift(start, links)[1][0][0])
        return (float(links["carriage"].origin.value.imag[0]) - lift) / self.to_bed

    def _bed_joints(self, links: dict[str, Link]) -> list[Connection]:
        f, r8 = links["carriage"].origin.value, abs(self.to_bed)
        given = self.design.spec.bed.pinion
        tangent = math.tan(_RACK_ANGLE if given is None else self.design.teeth.pinion.working_pressure_angle)
        lower = "rack" if self.follower is not None else FRAME
        return [
            Pin("A", FRAME, "gear2", links["gear2"].origin.value),
            Pin("B", "gear2", "BC", links["BC"].origin.value),
            Pin("C", "BC", "CDE", links["CDE"].at("C").value),
            Pin("D", FRAME, "CDE", links["CDE"].origin.value),
            Pin("E", "CDE", "EF", links["EF"].origin.value),
            Pin("F", "EF", "carriage", f),
            Pin("F_pinion", "carriage", "pinion", f),
            *(Guide(f"guide_{name}", FRAME, name, links[name].origin.value, -1j) for name in SLIDING if name in links),
            Rack("rack_lower", lower, "pinion", f, -1j, self.side + 0j, r8, tangent),
            Rack("rack_upper", "bed", "pinion", f, -1j, -self.side + 0j, r8, tangent),
        ]

    def _follower_joint(self, links: dict[str, Link], cam: Travel) -> Connection:
        """The roller of the rack's follower on the cams, one force: positive on the main cam, negative on the other."""
        rho = self.design.cams.base_radius + cam.value
        normal = (rho + 1j * cam.first) * 1j / np.hypot(rho, cam.first)
        axis = links["CDE"].origin.value
        # Against its own force, so that a negative one is carried by the return cam's roller.
        rho_2 = self.design.cams.roller_center_distance - rho
        other = (rho_2 - 1j * cam.first) * 1j / np.hypot(rho_2, cam.first)
        return Contact("cam", "CDE", "rack", axis + 1j * rho, normal, (axis - 1j * rho_2, other))

    # Cylinder

    def _cylinder_chain(self, links: dict[str, Link], phi: Reals, order: int) -> None:
        """The links from gear 1 to the cylinder."""
        chain, section = self.design.motion.cylinder, self.section
        four = chain.linkage
        coupler, rocker = turns(four, chain.initial_angle - phi, order, velocity=-1.0)
        toward = _unit(section.gear_1_direction, 90.0)
        half_turn = 0.0 if self.side > 0.0 else math.pi
        g = fixed(self.design.gear_distance * toward, phi, order=order)
        crank = steady(phi, -1.0, chain.initial_angle + half_turn, order=order)
        links["gear1"] = Link(g, crank, {"G": 0.0, "H": four.crank})
        links["HM"] = Link(links["gear1"].at("H"), from_start(coupler, -half_turn), {"H": 0.0, "M": four.coupler})
        n = fixed(complex(g.value[0]) + self.side * four.frame, phi, order=order)
        links["MN"] = Link(n, from_start(rocker, -half_turn), {"N": 0.0, "M": four.rocker})
        axis = fixed(complex(n.value[0]) + sum(pitch_radii(self.design)) * self._to_cylinder, phi, order=order)
        at_start = fourbar.solve(four, chain.initial_angle).rocker_angle
        links["cylinder"] = Link(axis, mixed((-chain.gear_ratio, from_start(rocker, at_start))))

    @property
    def _to_cylinder(self) -> complex:
        return _unit(self.section.cylinder_direction, 0.0)

    def _cylinder_joints(self, links: dict[str, Link]) -> list[Connection]:
        pair = None if self.design.spec.input_gears is None else self.design.gear_pair
        n, toward = links["MN"].origin.value, _unit(self.section.gear_1_direction, 90.0)
        r3, r4 = pitch_radii(self.design)
        joints: list[Connection] = [
            Pin("G", FRAME, "gear1", links["gear1"].origin.value),
            Pin("H", "gear1", "HM", links["HM"].origin.value),
            Pin("M", "HM", "MN", links["MN"].at("M").value),
            Pin("N", FRAME, "MN", n),
            Pin("cylinder", FRAME, "cylinder", links["cylinder"].origin.value),
        ]
        if pair is not None:
            (r1, r2), tangent = pair.working_radius, math.tan(pair.working_pressure_angle)
            joints.append(Mesh("mesh_12", "gear2", "gear1", links["gear2"].origin.value, toward, r2, r1, tangent))
        given = self.design.spec.cylinder.gears
        angle = _RACK_ANGLE if given is None else self.design.teeth.cylinder.pair.working_pressure_angle
        return [*joints, Mesh("mesh_34", "MN", "cylinder", n, self._to_cylinder, r3, r4, math.tan(angle))]


def _sliding(place: Reals, way: tuple[Reals, ...]) -> Point:
    """A point that moves along +y by a way with its derivatives."""
    return Point(*(np.asarray(1j * each + (place if k == 0 else 0.0)) for k, each in enumerate(way)))


def _unit(direction: float | None, default: float) -> complex:
    return cmath.exp(1j * math.radians(default if direction is None else direction))
