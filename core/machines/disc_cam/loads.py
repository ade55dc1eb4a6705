"""The loads of a disc cam: cam and follower, which a spring, a groove or a second roller holds on it."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.base.design import geometry, placed
from gearlink.core.base.errors import MissingSection
from gearlink.core.base.report import Table
from gearlink.core.base.results import cached_property
from gearlink.core.machines.disc_cam.design import Closing, DiscCamDesign
from gearlink.core.mechanism.friction import relative
from gearlink.core.mechanism.joints import NEWTON_METER, Contact
from gearlink.core.mechanism.rates import cross
from gearlink.core.numerics.extremes import maximum_over
from gearlink.core.studies.loads.cams import CAM_CHECKS, CONTACT, CamLoadsDesign, contact_table
from gearlink.core.studies.loads.contact import plane_modulus, positive_drive, roller_on
from gearlink.core.studies.loads.design import Wanted, loads_outline

if TYPE_CHECKING:
    from collections.abc import Iterable

    from gearlink.core.machines.disc_cam.spec import DiscCamSpec
    from gearlink.core.mechanism.dynamics import Force, Mass, Torque
    from gearlink.core.mechanism.links import Mechanism
    from gearlink.core.numerics.arrays import Points, Reals
    from gearlink.core.studies.loads.machine import Machine
    from gearlink.core.studies.loads.spec import CamLoads

_SHOWN = (*CONTACT, "spring_preload", "lift_off_speed", "face_width_needed")
_OF_ROLLERS = ("roller_speed_max", "roller_acceleration_max", "traction_needed", "entrainment_speed_max")
_EACH = (*_OF_ROLLERS, "contact_force_max", "contact_force_min", "hertz_pressure_max", "shear_depth")


if TYPE_CHECKING:
    _Loads = CamLoadsDesign
else:
    _Loads = object  # the kinds below have it


class FollowerCamLoads(_Loads):
    """Input angle: that of the cam; O is its bearing, A the pivot of a rocker."""

    spec: DiscCamSpec
    section: CamLoads
    section_example = "roller: {width: 20}"
    links, output = ("cam", "follower"), "follower"
    pins, meshes = ("O", "A"), ()
    stands = True
    outlines = loads_outline(pins, meshes, _SHOWN, CAM_CHECKS)

    if TYPE_CHECKING:

        @cached_property
        def design(self) -> DiscCamDesign:
            """The geometry."""

    closing: Closing = placed("design.closing")

    @property
    def sliding(self) -> tuple[str, ...]:  # type: ignore[override]
        """A follower that slides."""
        return () if self.spec.oscillates else ("follower",)

    @property
    def given_speed(self) -> float:
        """Speed of the cam [1/min]."""
        if self.spec.speed is None:
            raise MissingSection("`loads` needs the speed of the cam", key="speed", fix="give speed")
        return self.spec.speed

    @cached_property
    def masses(self) -> dict[str, Mass]:
        """Those of the follower; a rocker's centre of mass is its pivot."""
        from gearlink.core.mechanism.dynamics import Mass

        mass, inertia = (float(getattr(self.spec.follower, key, None) or 0.0) for key in ("mass", "inertia"))
        return {"follower": Mass(mass, inertia)} if mass or inertia else {}

    @cached_property
    def machine(self) -> Machine:
        """Everything, with the spring."""
        from dataclasses import replace

        from gearlink.core.studies.loads.machine import Machine
        from gearlink.core.studies.loads.sources import Sources, gravity_of

        self.require_pair()
        sources = Sources(self.section, self.own_links, self.sliding)
        if not self.masses and not sources.any and self.spec.spring is None:
            message = "no loads without a mass, a spring or a force"
            raise MissingSection(message, key="follower", fix="give follower.mass or spring")
        made = Machine(
            self.moving, self.masses, sources, gravity_of(self.section), self.speed, self.turns, self.friction,
            tuple(self.own_joints),
        )  # fmt: skip
        return replace(made, more=self._spring)

    def _spring(self, mechanism: Mechanism, phi: Reals) -> list[Force | Torque]:
        """The spring presses the follower on the cam."""
        from gearlink.core.mechanism.dynamics import Force, Torque

        if self.spec.spring is None:
            return []
        lift = self.design.cams.motion.evaluate(phi, 0)[0]
        press = (self.closing.preload or 0.0) + self.closing.rate * lift
        if self.spec.oscillates:
            return [Torque("follower", np.asarray(float(self.design.cams.follower.side) * press * NEWTON_METER))]
        push = np.asarray(-press * self.design.cams.direction, dtype=np.complex128)
        return [Force("follower", push, mechanism.links["follower"].origin)]

    @property
    def own_joints(self) -> list[float]:
        """Cam angles at which the law changes [rad]."""
        return list(self.design.cams.motion.joints)

    @property
    def quiet_zones(self) -> list[tuple[float, float]]:
        """The dwells."""
        strokes = self.design.cams.motion.strokes
        found = [(stroke.start, stroke.end - stroke.start) for stroke in strokes if stroke.sense == 0]
        if len(found) > 1 and found[0][0] == 0.0 and math.isclose(sum(found[-1]), 2.0 * math.pi):
            (_, first), (start, last) = found[0], found.pop()
            found[0] = (start, first + last)
        return found

    @property
    def transmission_angle(self) -> float | None:
        """None: the pressure angle of the cam stands instead."""
        return None

    # Rollers, and what does not roll

    @cached_property
    def own_rollers(self) -> tuple[str, ...]:
        """Main, and return where the file has one."""
        return ("main",) if self.spec.return_roller is None else ("main", "return")

    @property
    def on_two_sides(self) -> bool:  # type: ignore[override]
        """A groove or a conjugate pair takes the force of either sense."""
        return self.spec.closure != "spring"

    @property
    def has_pair(self) -> bool:  # type: ignore[override]
        """A conjugate pair."""
        return self.spec.closure == "conjugate"

    @property
    def change_of_side(self) -> str:  # type: ignore[override]
        """What a force of the other sense does."""
        return super().change_of_side if self.has_pair else "the roller changes walls"

    @property
    def side_remedy(self) -> str:
        """What holds it on one side."""
        if self.has_pair:
            return super().side_remedy
        return f"{self.closing_remedy}, which keeps the roller on one wall"

    def called(self, name: str) -> str:
        """A roller, a flat face or a knife edge."""
        return super().called(name) if self.spec.rolls else "flat face" if self.spec.is_flat else "knife edge"

    def roller_at(self, name: str, phi: Reals) -> Any:
        """A roller from the cam axis; a flat face and an edge give what their contact has."""
        if self.spec.is_flat:
            touch = self.design.cams.flat.touch(phi)
            return SlidingOnCam(self.spec.cam.sense, touch.point, touch.normal, touch.radius)
        if self.spec.is_edge:
            edge = roller_on(self.design.cams.main, phi)
            return SlidingOnCam(edge.sense, edge.position, edge.normal, np.zeros_like(phi))
        return roller_on(self.design.cams.discs[self.own_rollers.index(name)], phi)

    def side_force(self, phi: Reals) -> Reals:
        """Force along the normal of the main roller [N], positive on the main cam."""
        found: Reals = self.machine.reactions(phi).unknowns["main"][0]
        return found

    def contact_force(self, name: str, phi: Reals) -> Reals:
        """Out of the reactions; of a positive drive what the preload leaves on each roller."""
        found = self.side_force(phi)
        if self.spec.closure == "spring":
            return found
        if self.spec.closure == "groove":
            return np.abs(found)
        preload = 0.0 if self.section.roller is None else self.section.roller.preload
        one, other = positive_drive(found, preload, self.roller_stiffness)
        return one if name == "main" else other

    @property
    def preload_needed(self) -> float | None:
        """Minimum preload that keeps both rollers of a conjugate pair on their cams [N]."""
        if not self.has_pair:
            return None
        high, low = (self.extreme(self.side_force, greatest).value for greatest in (True, False))
        share = self.roller_stiffness[0] / sum(self.roller_stiffness)
        return max(high * (1.0 - share), -low * share, 0.0)

    def cam_torque(self, phi: Reals) -> Reals:
        """Torque that drives the cam about its axis against the contact and its friction, counter-clockwise [N m]."""
        found = self.machine.reactions(phi)
        contact = next(each for each in found.mechanism.connections if isinstance(each, Contact))
        force = found.unknowns[contact.name][0]
        push: Points = np.asarray(force * contact.normal)
        share = 0.0 if self.friction is None else self.friction.of(contact)
        if share:
            sliding = np.sign(relative(found.mechanism, contact))
            push = push - share * np.maximum(force, 0.0) * sliding * 1j * contact.normal
        return cross(contact.at, push) / NEWTON_METER

    @cached_property
    def face_width_needed(self) -> float | None:
        """Width that keeps the allowed contact pressure [mm], b = max(N/R) E*/(pi p^2); None without one."""
        material = self.section.material
        if material is None or material.allowed_pressure is None or self.on_two_sides or self.spec.is_edge:
            return None
        if self._is_pressed_on_undercut("main"):
            return None

        def narrow(phi: Reals) -> Reals:
            pressed = np.maximum(self.contact_force("main", phi), 0.0)
            return np.asarray(pressed / self.roller_on_cam("main", phi).relative_radius)

        modulus = plane_modulus(material.modulus, material.poisson)
        return float(self.extreme(narrow, True).value * modulus / (math.pi * material.allowed_pressure**2))

    @property
    def lacking_spring(self) -> tuple[str, float] | None:  # type: ignore[override]
        """What its inertia and the forces on it pull it off with [N, or N m]; None with a spring."""
        if self.spec.spring is not None or self.on_two_sides:
            return None
        joints = self.design.cams.motion.joints
        pull = maximum_over(lambda phi: -self.closing.force(phi), joints=joints)
        return "spring.preload", max(pull.value, 0.0)

    @property
    def closing_remedy(self) -> str:
        """What presses the follower harder."""
        if self.spec.spring is not None:
            return "increase spring.preload"
        rate, force = ("N m/rad", "N m") if self.spec.oscillates else ("N/mm", "N")
        return f"give spring: {{preload: {force}, rate: {rate}}}"

    spring_preload: float | None = placed("closing.preload")
    lift_off_speed: float | None = placed("closing.lift_off_speed")

    @cached_property
    def traction_needed(self) -> list[float | None] | None:
        """Share of the contact force that drives a roller round; None without one."""
        return super().traction_needed if self.spec.rolls else None

    def wanted(self, quantity: str) -> Iterable[Wanted]:
        """The extremes that a quantity needs; a face and an edge have no roller."""
        return super().wanted(quantity) if self.spec.rolls or quantity not in _OF_ROLLERS else ()

    def table_contact(self, samples: int | None = None) -> Table:
        """Force of the contact; of a face pressure and radius as well, of a roller its speeds too."""
        found = contact_table(self, samples)
        if self.spec.rolls:
            return found
        left_out = ("roller_speed", "entrainment", *(("main_pressure", "main_radius") if self.spec.is_edge else ()))
        kept = [k for k, column in enumerate(found.columns) if column not in left_out]
        columns = {found.columns[k]: (found.data[k], found.units[k]) for k in kept}
        return Table.of("contact", columns)

    def raw(self, name: str) -> Any:
        """Single numbers with one roller; a face and an edge have none."""
        if not self.spec.rolls and name in _OF_ROLLERS:
            return None
        found = super().raw(name)
        return found[0] if name in _EACH and isinstance(found, list) and len(found) == 1 else found

    @classmethod
    def unit_for(cls, spec: Any, name: str, /) -> str:
        """That of the spring is the unit of the geometry."""
        return DiscCamDesign.unit_for(spec, name) if name == "spring_preload" else super().unit_for(spec, name)


class DiscCamLoads(FollowerCamLoads, CamLoadsDesign):
    """The loads of a disc cam."""

    kind = "disc-cam"
    design: cached_property[DiscCamDesign] = geometry(DiscCamDesign)


class MeasuredCamLoads(FollowerCamLoads, CamLoadsDesign):
    """The loads of a measured cam."""

    kind = "measured-cam"
    spec: Any

    @cached_property
    def design(self) -> DiscCamDesign:
        """The geometry, by the motion of the profile."""
        from gearlink.core.machines.disc_cam.measured import MeasuredCamDesign

        return self.of_file(MeasuredCamDesign)

    @property
    def cost(self) -> float:
        """With the motion, which is sought on the profile."""
        return super().cost + self.design.cost


class SlidingOnCam:
    """The contact of a face or an edge in the words of a roller, as far as it has them; neither rolls."""

    def __init__(self, sense: int, position: Points, normal: Points, relative_radius: Reals) -> None:
        self.sense, self.radius = sense, 0.0
        self.position, self.normal, self.relative_radius = position, normal, relative_radius
        self.roller_speed = self.roller_acceleration = self.entrainment = np.zeros_like(relative_radius)
