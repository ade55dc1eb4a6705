"""The loads of a swing gripper: cam rocker with linkage, return rocker, and the cams that drive both.

The input angle is the cylinder's, which the cams turn with. The spring pulls the two rockers together with its torque.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.base.design import geometry
from gearlink.core.base.errors import MissingSection, NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.base.spec_paths import changed
from gearlink.core.machines.swing_gripper.design import SwingGripper
from gearlink.core.machines.swing_gripper.motion import require
from gearlink.core.mechanism.joints import NEWTON_METER
from gearlink.core.studies.loads.cams import CAM_CHECKS, CONTACT, CamLoadsDesign
from gearlink.core.studies.loads.contact import RollerOnCam, roller_on
from gearlink.core.studies.loads.design import loads_outline

if TYPE_CHECKING:
    from gearlink.core.machines.swing_gripper.spec import SwingGripperSpec
    from gearlink.core.mechanism.dynamics import Force, Mass, Torque
    from gearlink.core.mechanism.links import Mechanism
    from gearlink.core.mechanism.motion import Motion
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.parts.cams.disc_cam import DiscCam
    from gearlink.core.studies.loads.machine import Machine
    from gearlink.core.studies.loads.spec import CamLoads


class GripperLoads(CamLoadsDesign):
    """Input angle: that of the cylinder shaft; A, C, D, E are the pins of the linkage, O the bearing of the cams."""

    kind = "swing-gripper"
    spec: SwingGripperSpec
    section: CamLoads
    section_example = "roller: {width: 20}"
    links = ("input", "coupler", "output", "return_rocker", "cam")
    pins, meshes = ("A", "C", "D", "E", "A_return", "O"), ()
    stands = True
    speed_unit, speed_unit_name, speed_words = 2.0 * math.pi / 3600.0, "sheets/h", "sheets/h"
    speed_seconds = 3600.0
    outlines = loads_outline(pins, meshes, (*CONTACT, "lift_off_speed"), CAM_CHECKS)
    design: cached_property[SwingGripper] = geometry(SwingGripper)

    @property
    def given_speed(self) -> float:
        """Sheets an hour, one revolution of the input each."""
        return self.spec.speed

    @cached_property
    def speed(self) -> float:
        """Speed of the cylinder shaft [rad/s], one revolution a sheet, in the sense of the cams."""
        return self.design.shaft_speed

    @cached_property
    def own_rollers(self) -> tuple[str, ...]:
        """Main, and return where the file has one."""
        return self.rollers if self.design.return_cam is not None else self.rollers[:1]

    @cached_property
    def own_links(self) -> tuple[str, ...]:
        """Without a return roller there is no return rocker."""
        has = "return" in self.own_rollers
        return self.links if has else tuple(name for name in self.links if name != "return_rocker")

    @cached_property
    def masses(self) -> dict[str, Mass]:
        """From the section `inertia`."""
        from gearlink.core.mechanism.dynamics import Mass

        given = require(self.spec, "inertia", "input, output, coupler, coupler_mass, return_rocker")
        found = {
            "input": Mass(0.0, given.input),
            "coupler": Mass(given.coupler_mass, given.coupler, complex(0.5 * self.spec.links.coupler)),
            "output": Mass(0.0, given.output),
        }
        if "return" in self.own_rollers:
            found["return_rocker"] = Mass(0.0, given.return_rocker)
        return found

    @cached_property
    def machine(self) -> Machine:
        """Everything, with the closing spring."""
        return replace(super().machine, more=self._spring)

    def _spring(self, _mechanism: Mechanism, phi: Reals) -> list[Force | Torque]:
        """The spring presses both rockers to their cams; it turns with them and does no work."""
        from gearlink.core.mechanism.dynamics import Torque

        if self.spec.spring is None:
            return []
        closing = self.design.closure.lift_sense * self.design.closing_torque * NEWTON_METER
        torque = np.full_like(phi, closing)
        found: list[Force | Torque] = [Torque("input", -torque)]
        if "return" in self.own_rollers:
            found.append(Torque("return_rocker", torque))
        return found

    @property
    def quiet_zones(self) -> list[tuple[float, float]]:
        """Both dwells; the near one alone where the arm turns back at once."""
        a, b, c, far, back, near = (math.radians(length) for length in self.design.motion.phases)
        return [zone for zone in ((a + b + c, far), (a + b + c + far + back, near)) if zone[1] > 0.0]

    @property
    def transmission_angle(self) -> float:
        """The lesser of those at D and C [rad]."""
        return min(self.design.min_transmission_angle)

    def _cam(self, name: str) -> DiscCam:
        cam = self.design.main_cam if name == "main" else self.design.return_cam
        assert cam is not None, "needed only where the file has it"
        return cam

    def roller_at(self, name: str, phi: Reals) -> RollerOnCam:
        """A roller from the cam axis; the cam turns as far as the cylinder."""
        return roller_on(self._cam(name), phi)

    def contact_force(self, name: str, phi: Reals) -> Reals:
        """Out of the reactions."""
        found: Reals = self.machine.reactions(phi).unknowns[name][0]
        return found

    @cached_property
    def lift_off_speed(self) -> float | None:
        """Speed at which a roller leaves its cam, by all that acts but friction [sheets/h]; None without a spring, and
        where nothing ever lifts one."""
        if self.spec.spring is None:
            return None
        if not self.machine.sources.any and not self.machine.gravity:
            return self.design.lift_off_speed
        if min(self.extreme(partial(self._pressed_at_rest, name), False).value for name in self.own_rollers) <= 0.0:
            return 0.0
        worst = max(self.extreme(partial(self._unloading, name), True).value for name in self.own_rollers)
        return None if worst <= 0.0 else math.sqrt(1.0 / worst) / self.speed_unit

    def _pressed_at_rest(self, name: str, phi: Reals) -> Reals:
        """Force of a roller at rest [N]."""
        return np.asarray(self.machine.parted(phi)[0].unknowns[name][0])

    def _unloading(self, name: str, phi: Reals) -> Reals:
        """1/W^2 of the speed at which the roller is without force [s^2]."""
        rest, swung = (part.unknowns[name][0] for part in self.machine.parted(phi))
        return np.asarray(-swung / rest)

    @property
    def lacking_spring(self) -> tuple[str, float] | None:  # type: ignore[override]
        """The torque that a roller lacks most, by all that acts [N m]; None with a spring."""
        key = "spring.torque"
        spec = None if self.spec.spring is not None else changed(self.given, ((key, 1.0),))
        if spec is None:
            return None
        sprung: Any = self.varied(spec)

        def lacking(name: str, phi: Reals) -> Reals:
            force = self.contact_force(name, phi)
            return np.asarray(force / (force - sprung.contact_force(name, phi)))

        return key, max(self.extreme(partial(lacking, name), True).value for name in self.own_rollers)

    @property
    def closing_remedy(self) -> str:
        """What presses the rollers harder."""
        spring = self.spec.spring
        if spring is None:
            return "give spring: {torque: N m}"
        return f"increase spring.{'torque' if spring.torque is not None else 'preload'}"

    @property
    def moving(self) -> Motion:
        """The motion of the links, which needs the cams."""
        if self.spec.cam is None:
            raise MissingSection("`loads` needs the section cam: its rollers carry the forces", key="cam")
        return self.design.moving

    def raw(self, name: str) -> Any:
        """Lists of one roller are what they are; a refused cam says where it could stand."""
        try:
            return super().raw(name)
        except NoSolution as error:
            raise self.design.cams.explained(error) from error
