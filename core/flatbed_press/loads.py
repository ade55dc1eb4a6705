"""The loads of a flatbed press: both chains from gears 1 and 2 to bed and cylinder, the racks and the cam's follower.

Frame: A at 0, D on +x (which is the machine's vertical), the bed travels along +y. The lower rack and the follower of
the cams move by the lift along +y. Bed and lower rack lie on two sides of F along x, N lies from G along x as the bed
from F: towards +x, or towards -x as the machine is drawn (`loads.bed_side`).
"""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING, Any

from gearlink.core.errors import MissingSection
from gearlink.core.flatbed_press import loads_checks
from gearlink.core.flatbed_press.design import FlatbedPress
from gearlink.core.loads.cams.checks import CAM_CHECKS
from gearlink.core.loads.cams.design import CONTACT, CamLoadsDesign
from gearlink.core.loads.design import loads_outline
from gearlink.core.results import cached_property

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from gearlink.core.flatbed_press.chains import Travel
    from gearlink.core.flatbed_press.loads_spec import PressLoads as Section
    from gearlink.core.flatbed_press.spec import FlatbedPressSpec
    from gearlink.core.loads.base import Wanted
    from gearlink.core.loads.cams.contact import RollerOnCam
    from gearlink.core.mechanism.joints import Connection
    from gearlink.core.mechanism.links import Link, Mechanism
    from gearlink.core.mechanism.rates import Point, Turn
    from gearlink.core.numerics.arrays import Reals

_TURN = 2.0 * math.pi
_PINION = 5.0 / 31.0
_GEAR_4 = 34.0 / 35.0
_RACK_ANGLE = math.radians(20.0)


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
    outlines = loads_outline(pins, meshes, CONTACT, (*CAM_CHECKS, *loads_checks.PLACE_CHECKS))
    on_two_sides = True

    @cached_property
    def design(self) -> FlatbedPress:
        """The geometry."""
        return FlatbedPress(self.spec)

    @property
    def given_speed(self) -> float:
        """Sheets an hour, one turn of the input each."""
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
        """The least of both chains and the rod [rad]."""
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
        given = self.section.cylinder_gear_radius
        gear_4 = self.spec.cylinder.radius * _GEAR_4 if given is None else given
        return gear_4 * self.spec.cylinder.gear_ratio, gear_4

    @cached_property
    def pinion_radius(self) -> float:
        """Pitch radius of the pinion [mm]."""
        given = self.section.pinion_radius
        return self.spec.bed.stroke * _PINION if given is None else given

    @property
    def _side(self) -> float:
        """Towards +x or -x, where the bed lies from F and N from G."""
        return float(self.section.bed_side)

    @cached_property
    def own_joints(self) -> list[float]:
        """Input angles at which the follower's law changes [rad]."""
        bed = self.design.bed
        return [float(bed.input_angle(segment.start)) for segment in self.design.cams.follower.segments]

    def lift(self, phi: Reals, rocker: Turn) -> Travel:
        """Lift of the cam's follower [mm] at input angles, with CDE's motion there; two derivatives by it at most."""
        from gearlink.core.flatbed_press.chains import Travel

        turned, order = rocker.value - self.design.bed.cam_angle_start, min(rocker.order, 2)
        return self.design.cams.follower.lift_at(phi, Travel(turned, *rocker[1 : order + 1]), order)

    def kinematics(self, phi: Reals, order: int = 2) -> Mechanism:
        """The twelve links at input angles; one derivative at least, for the normals of the rollers."""
        from gearlink.core.mechanism.links import Mechanism

        if self.spec.cam is None:
            raise MissingSection(
                "`loads` of a press needs the section cam: its follower moves the lower rack", key="cam"
            )
        links = self._rods(phi, order := max(order, 1))
        cam = self._racks(links, phi)
        connections = [*self._bed_joints(links), *self._follower(links, cam)]
        connections += self._cylinder_chain(links, phi, order)
        drive, sense = ("gear2", 1.0) if self.section.drive_gear == 2 else ("gear1", -1.0)
        made = Mechanism(links, connections, drive, sense, travel=dict.fromkeys(self.sliding, 1j))
        made.once("lift", lambda: cam)
        return made

    check_cylinder_place, check_gear_direction = loads_checks.cylinder_place, loads_checks.gear_direction

    @cached_property
    def places(self) -> tuple[dict[str, complex], dict[str, complex]]:
        """Where pins and racks stand at input angle 0 [mm], in the frame of the forces."""
        from gearlink.core.mechanism.joints import Pin, Rack

        joints = self._connections
        return (
            {each.name: complex(each.at[0]) for each in joints if isinstance(each, Pin)},
            {each.name: complex(each.pitch_point[0]) for each in joints if isinstance(each, Rack)},
        )

    # Bed

    def _rods(self, phi: Reals, order: int) -> dict[str, Link]:
        """The links from gear 2 to the carriage."""
        from gearlink.core.linkages.fourbar.mechanism import turns
        from gearlink.core.mechanism.closures import slider
        from gearlink.core.mechanism.links import Link
        from gearlink.core.mechanism.rates import carried, fixed, from_start, standing, steady

        bed = self.design.bed
        four = bed.linkage
        coupler, rocker = turns(four, bed.initial_crank_angle + phi, order)
        gear2 = Link(fixed(0j, phi, order=order), steady(phi, 1.0, bed.initial_crank_angle, order=order))
        pivot = fixed(four.frame, phi, order=order)
        e = carried(pivot, from_start(rocker, bed.crank_offset_angle), bed.slider_crank_length)
        rod, f = slider(e, bed.rod, four.frame - bed.offset + 0j, -1j)
        return {
            "gear2": gear2,
            "BC": Link(gear2.at(four.crank), coupler),
            "CDE": Link(pivot, rocker),
            "EF": Link(e, rod),
            "carriage": Link(f, standing(0.0, phi, order=order)),
        }

    def _lift_by_input(self, phi: Reals, rocker: Turn) -> tuple[Travel, tuple[Reals, ...]]:
        """The lift over the cam's angle, and the same with its derivatives by the input angle [mm]."""
        cam = self.lift(phi, rocker)
        parts = [cam.value, cam.first * rocker.first]
        if rocker.order > 1:
            parts.append(cam.second * rocker.first**2 + cam.first * rocker.second)
        if rocker.order > 2:  # what the bed's chain gives it, less the bed's own
            parts.append(self.design.bed.jerk(phi) - self.design.bed_motion.jerk(phi))
        return cam, tuple(parts)

    def _racks(self, links: dict[str, Link], phi: Reals) -> Travel:
        """Pinion, lower rack and bed, put to the links that move them; the lift of the follower."""
        from gearlink.core.mechanism.links import Link
        from gearlink.core.mechanism.rates import Turn

        f, still = links["carriage"].origin, links["carriage"].turn
        cam, lift = self._lift_by_input(phi, links["CDE"].turn)
        to_bed = self._side * self.pinion_radius
        rolled = [(part.imag - value) / to_bed for part, value in zip(f, lift, strict=True)]
        travel = tuple(2.0 * part.imag - value for part, value in zip(f, lift, strict=True))
        links["pinion"] = Link(f, Turn(rolled[0] - self._rolled_at_start, *rolled[1:]))
        links["rack"] = Link(_sliding(f.value.real - to_bed, lift), still)
        links["bed"] = Link(_sliding(f.value.real + to_bed, travel), still)
        return cam

    @cached_property
    def _rolled_at_start(self) -> float:
        """What the pinion has rolled at input angle 0, where its own x axis lies along that of the frame [rad]."""
        import numpy as np

        start = np.zeros(1)
        links = self._rods(start, 1)
        _, (lift, *_) = self._lift_by_input(start, links["CDE"].turn)
        depth = links["carriage"].origin.value.imag - lift
        return float(depth[0]) / (self._side * self.pinion_radius)

    def _bed_joints(self, links: dict[str, Link]) -> list[Connection]:
        from gearlink.core.mechanism.joints import Guide, Pin, Rack
        from gearlink.core.mechanism.links import FRAME

        four, side = self.design.bed.linkage, self._side
        f, tangent, r8 = links["carriage"].origin.value, math.tan(_RACK_ANGLE), self.pinion_radius
        return [
            Pin("A", FRAME, "gear2", links["gear2"].origin.value),
            Pin("B", "gear2", "BC", links["BC"].origin.value),
            Pin("C", "BC", "CDE", links["CDE"].at(four.rocker).value),
            Pin("D", FRAME, "CDE", links["CDE"].origin.value),
            Pin("E", "CDE", "EF", links["EF"].origin.value),
            Pin("F", "EF", "carriage", f),
            Pin("F_pinion", "carriage", "pinion", f),
            *(Guide(f"guide_{name}", FRAME, name, links[name].origin.value, -1j) for name in self.sliding),
            Rack("rack_lower", "rack", "pinion", f, -1j, side + 0j, r8, tangent, carrier="carriage"),
            Rack("rack_upper", "bed", "pinion", f, -1j, -side + 0j, r8, tangent, carrier="carriage"),
        ]

    def _follower(self, links: dict[str, Link], cam: Travel) -> list[Connection]:
        """The roller of the rack's follower on the cams, one force: positive on the main cam, negative on the other."""
        import numpy as np

        from gearlink.core.mechanism.joints import Contact

        rho = self.design.cams.base_radius + cam.value
        normal = (rho + 1j * cam.first) * 1j / np.hypot(rho, cam.first)
        axis = links["CDE"].origin.value
        # Against its own force, so that a negative one is carried by the return cam's roller.
        rho_2 = self.design.cams.roller_center_distance - rho
        other = (rho_2 - 1j * cam.first) * 1j / np.hypot(rho_2, cam.first)
        return [Contact("cam", "CDE", "rack", axis + 1j * rho, normal, (axis - 1j * rho_2, other))]

    @property
    def dwell_zones(self) -> list[tuple[float, float]]:
        """The bed does not stand anywhere."""
        return []

    speed_unit, speed_unit_name, speed_words = _TURN / 3600.0, "sheets/h", "sheets/h"
    speed_seconds = 3600.0

    # Rollers

    def roller_at(self, name: str, phi: Reals) -> RollerOnCam:
        """A roller of the rack's follower from the cam axis, over the angle turned by the cams."""
        from gearlink.core.loads.cams.contact import RollerOnCam

        cams, links = self.design.cams, self.machine.at(phi)
        cam = links.once("lift", lambda: self.lift(phi, links.links["CDE"].turn))
        at = cams.base_radius if name == "main" else cams.base_radius - cams.roller_center_distance
        rates = (at + cam.value, cam.first, cam.second)
        position, first, second = (1j * part for part in rates)
        return RollerOnCam(position, first, second, 1, cams.section.roller_radius)

    def _cam_turn(self, phi: Reals) -> Turn:
        """Angle turned by the cams."""
        from gearlink.core.mechanism.rates import from_start

        return from_start(self.machine.at(phi).links["CDE"].turn, self.design.bed.cam_angle_start)

    def contact_force(self, name: str, phi: Reals) -> Reals:
        """Out of the reactions: the main cam pushes, the return cam pulls back; with a preload both press."""
        import numpy as np

        from gearlink.core.loads.cams.contact import positive_drive

        net = self.side_force(phi)
        if not self._preload:
            return np.asarray(np.maximum(net if name == "main" else -net, 0.0))
        both = positive_drive(net, self._preload, self._stiffness)
        return both[0] if name == "main" else both[1]

    def side_force(self, phi: Reals) -> Reals:
        """What the cams give the follower of the rack along +y [N], less a preload."""
        found: Reals = self.machine.reactions(phi).unknowns["cam"][0]
        return found

    @property
    def _preload(self) -> float:
        roller = self.section.roller
        return 0.0 if roller is None else roller.preload

    @property
    def _stiffness(self) -> tuple[float, float]:
        roller = self.section.roller
        if roller is None or roller.stiffness is None:
            return 1.0, 1.0
        return roller.stiffness[0], roller.stiffness[1]

    @cached_property
    def preload_needed(self) -> float | None:
        """Least preload that keeps both rollers on their cams [N]; equal stiffness where the file gives none."""
        if self.section.roller is None:
            return None
        return self.extreme_of("preload").value

    def _needed(self, phi: Reals) -> Reals:
        import numpy as np

        share = self._stiffness[0] / sum(self._stiffness)
        net = self.side_force(phi)
        return np.asarray(np.maximum(net * (1.0 - share), -net * share))

    def course(self, name: str) -> Callable[[Reals], Reals]:
        """The preload that an input angle needs as well."""
        return self._needed if name == "preload" else super().course(name)

    def wanted(self, quantity: str) -> Iterable[Wanted]:
        """The extremes that a quantity needs."""
        if quantity == "preload_needed" and self.section.roller is not None:
            return (("preload", True),)
        return super().wanted(quantity)

    def cam_speed(self, phi: Reals) -> Reals:
        """Speed of CDE [rad/s]."""
        found: Reals = self._cam_turn(phi).first * self.speed
        return found

    def cam_acceleration(self, phi: Reals) -> Reals:
        """Its derivative by time [rad/s^2]."""
        found: Reals = self._cam_turn(phi).second * self.speed**2
        return found

    def cam_degrees(self, phi: Reals) -> Reals:
        """Angle turned by the cams [deg]."""
        import numpy as np

        return np.degrees(self._cam_turn(phi).value)

    # Cylinder

    def _cylinder_chain(self, links: dict[str, Link], phi: Reals, order: int) -> list[Connection]:
        from gearlink.core.linkages.fourbar.mechanism import turns
        from gearlink.core.mechanism.joints import Mesh, Pin
        from gearlink.core.mechanism.links import FRAME, Link
        from gearlink.core.mechanism.rates import fixed, from_start, mixed, steady

        chain, pair = self.design.cylinder, self.design.gear_pair
        four = chain.linkage
        coupler, rocker = turns(four, chain.initial_angle - phi, order, velocity=-1.0)
        toward = _unit(self.section.gear_1_direction, 90.0)
        turned = 0.0 if self._side > 0.0 else math.pi
        g = fixed(pair.center_distance * toward, phi, order=order)
        links["gear1"] = Link(g, steady(phi, -1.0, chain.initial_angle + turned, order=order))
        links["HM"] = Link(links["gear1"].at(four.crank), from_start(coupler, -turned))
        n = complex(g.value[0]) + self._side * four.frame
        links["MN"] = Link(fixed(n, phi, order=order), from_start(rocker, -turned))
        r3, r4 = self.pitch_radii
        side = _unit(self.section.cylinder_direction, 0.0)
        axis = fixed(complex(links["MN"].origin.value[0]) + (r3 + r4) * side, phi, order=order)
        links["cylinder"] = Link(axis, mixed((-chain.gear_ratio, from_start(rocker, _start(chain)))))
        r1, r2 = pair.working_radius
        tangent = math.tan(pair.working_pressure_angle)
        return [
            Pin("G", FRAME, "gear1", g.value),
            Pin("H", "gear1", "HM", links["HM"].origin.value),
            Pin("M", "HM", "MN", links["MN"].at(four.rocker).value),
            Pin("N", FRAME, "MN", links["MN"].origin.value),
            Pin("cylinder", FRAME, "cylinder", axis.value),
            Mesh("mesh_12", "gear2", "gear1", links["gear2"].origin.value, toward, r2, r1, tangent),
            Mesh("mesh_34", "MN", "cylinder", links["MN"].origin.value, side, r3, r4, math.tan(_RACK_ANGLE)),
        ]


def _sliding(place: Reals, way: tuple[Reals, ...]) -> Point:
    """A point that moves along +y by a way with its derivatives."""
    from gearlink.core.mechanism.rates import Point

    along: list[Any] = [1j * each for each in way]
    return Point(place + along[0], *along[1:])


def _unit(direction: float | None, default: float) -> complex:
    return cmath.exp(1j * math.radians(default if direction is None else direction))


def _start(chain: Any) -> float:
    from gearlink.core.linkages.fourbar import position as fourbar

    return fourbar.solve(chain.linkage, chain.initial_angle).rocker_angle
