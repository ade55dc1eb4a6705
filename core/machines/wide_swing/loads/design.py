"""The loads of a wide-swing mechanism: rocker with its device, cam shaft, and the roller between them.

The input angle is that of the cam, from the start of the working stroke; torques are positive in the sense of that
stroke. With `cycle` the whole turn is computed, with `cycle_angle` the working stroke alone. In a stroke its own cam
guides the rocker, and in the rest after it that cam's arc holds it against the device. A cam on a crank-rocker swings
home on the profile of its stroke: the whole turn is that of the crank, without a rest.
"""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING, Any

from gearlink.core.base.design import placed
from gearlink.core.base.errors import MissingSection, NoSolution
from gearlink.core.base.report import Quantity
from gearlink.core.base.results import cached_property
from gearlink.core.machines.wide_swing import bodies
from gearlink.core.machines.wide_swing.design import WideSwingDesign
from gearlink.core.machines.wide_swing.loads import checks as loads_checks
from gearlink.core.machines.wide_swing.loads import tables as loads_tables
from gearlink.core.studies.loads.cams.checks import CAM_CHECKS
from gearlink.core.studies.loads.design import LoadsDesign, loads_outline

if TYPE_CHECKING:
    from collections.abc import Iterable

    from gearlink.core.base.report import Remedy
    from gearlink.core.machines.wide_swing.cams.outline import AnyCam
    from gearlink.core.machines.wide_swing.loads.rest import SwingRest
    from gearlink.core.machines.wide_swing.loads.spec import SwingLoads as Section
    from gearlink.core.machines.wide_swing.loads.stroke import SwingStroke
    from gearlink.core.machines.wide_swing.spec import WideSwingSpec
    from gearlink.core.mechanism.dynamics import Force, Mass, Torque
    from gearlink.core.mechanism.links import Mechanism
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.studies.loads.machine import Machine
    from gearlink.core.studies.loads.vibrating import Vibrating


class Pressing:
    """Forces and pressures of rollers and cams; every result is computed when it is read."""

    def __init__(self, loads: WideSwingLoads) -> None:
        self.loads = loads

    @cached_property
    def rests(self) -> tuple[SwingRest, ...]:
        """The rests of a whole cycle, each on the cam of the stroke before it; those of no length left out."""
        from gearlink.core.machines.wide_swing.loads.rest import LEAST, SwingRest

        zones = zip(self.loads.strokes, self.loads.dwell_zones, strict=False)
        return tuple(SwingRest(stroke, *zone) for stroke, zone in zones if zone[1] > LEAST)

    def _all(self, name: str) -> list[float]:
        """A value of every stroke and every rest."""
        return [each.pressed[name].value for each in self.loads.strokes] + [each.pressed[name] for each in self.rests]

    @cached_property
    def force(self) -> float:
        """Greatest force of the roller on any of the cams [N]; from geometry alone where nothing acts besides."""
        if self.loads.own_forces:
            return max(self._all("force"))
        design = self.loads.design
        in_rests = design.unloading.dwell_force([rest.stroke.cam for rest in self.rests]) if self.rests else 0.0
        return max(design.contact_force, in_rests)

    @cached_property
    def least_force(self) -> float:
        """Least force of the roller where it touches a cam [N]."""
        return min(self._all("least_force"))

    @cached_property
    def exists(self) -> bool:
        """Whether the roller has a width and bears on its cams wherever it touches them."""
        if self.loads.section.roller is None or any(rest.relative_radius <= 0.0 for rest in self.rests):
            return False
        return not any(stroke.is_undercut for stroke in self.loads.strokes)

    @cached_property
    def pressure(self) -> float | None:
        """Greatest pressure of roller and cam [N/mm^2]; None without a width, and where the cam is undercut."""
        return max(self._all("pressure")) if self.exists else None

    @property
    def hardest_rest(self) -> SwingRest | None:
        """The rest in which the pressure is greatest; None where that is in a stroke."""
        return next((rest for rest in self.rests if rest.pressed["pressure"] == self.pressure), None)

    @cached_property
    def shear_depth(self) -> float | None:
        """Greatest depth of the greatest shear stress [mm]; with a drive, that where the pressure is greatest."""
        if not self.exists:
            return None
        if self.loads.spec.drive is None:
            return max(self._all("shear_depth"))
        hardest = max(self.loads.strokes, key=lambda each: each.pressed["pressure"].value)
        return hardest.shear_depth_at_greatest_pressure


_RPM = 2.0 * math.pi / 60.0
_CONTACT = (
    "contact_force_max",
    "hertz_pressure_max",
    "shear_depth",
    "roller_speed_max",
    "entrainment_speed_max",
    "cam_torque_max",
    "cam_torque_min",
    "cam_torque_rms",
    "lift_off_speed",
)
_OF_TURN = ("bearings", "flywheel", "motor")
_PINS = ("O", "O_return", "D", "E", "F", "A", "B", "C")


class WideSwingLoads(LoadsDesign):
    """Cam on O, rocker on D; a twin-cam with its whole cycle has a second cam that turns the other way, on O_return.

    A slider hangs on the rocker by a rod from E to F; a cam on a crank-rocker is driven by its crank, A to B, and its
    coupler, B to C.
    """

    kind = "wide-swing-cam"
    spec: WideSwingSpec
    section: Section
    section_example = "roller: {width: 20}"
    links = ("rocker", "cam", "return_cam", "rod", "slider", "crank", "coupler")
    sliding = ("slider",)
    output = "rocker"
    pins, meshes = _PINS, ()
    stands = True
    outlines = loads_outline(_PINS, (), _CONTACT, (*CAM_CHECKS[:2], "body-clearance"), ("torque", "contact_stroke"))
    extra_tables = (*LoadsDesign.extra_tables, "contact_stroke")

    @cached_property
    def design(self) -> WideSwingDesign:
        """The geometry."""
        return WideSwingDesign(self.spec)

    @property
    def cam(self) -> AnyCam:
        """The cam of the working stroke."""
        return self.design.cam

    @property
    def whole(self) -> bool:
        """Whether the file gives the whole turn."""
        return self.spec.cycle is not None or self.spec.drive is not None

    @property
    def cost(self) -> float:
        """Each stroke with its rests takes as long to judge as a whole turn of other machines."""
        return (2 if self.spec.cycle is not None else 1) * super().cost

    @cached_property
    def strokes(self) -> tuple[SwingStroke, ...]:
        """The working stroke, and what brings the rocker back where the whole turn is known."""
        from gearlink.core.machines.wide_swing.loads.stroke import SwingStroke
        from gearlink.core.machines.wide_swing.strokes import strokes_of

        return tuple(SwingStroke(stroke, self) for stroke in strokes_of(self.design))

    @property
    def has_return_cam(self) -> bool:
        """Whether a second cam turns the other way."""
        return self.spec.cycle is not None and self.spec.layout == "twin-cam"

    @cached_property
    def own_links(self) -> tuple[str, ...]:
        """Rocker and cam, and what the file has besides."""
        spec = self.spec
        has = {"return_cam": self.has_return_cam}
        has |= dict.fromkeys(("rod", "slider"), spec.slider is not None)
        has |= dict.fromkeys(("crank", "coupler"), spec.drive is not None)
        for name, given in self.section.links:
            if given is not None and not has.get(name, True):
                raise NoSolution(f"this mechanism has no {name}: leave its mass out", key=f"loads.links.{name}")
        return tuple(name for name in self.links if has.get(name, True))

    @property
    def given_speed(self) -> float:
        """Speed of the cam [1/min]."""
        return self.spec.speed

    @cached_property
    def masses(self) -> dict[str, Mass]:
        """Rocker and slider of their own sections, and what the file gives the others."""
        from gearlink.core.mechanism.dynamics import Mass

        found = super().masses
        if self.spec.inertia:
            found["rocker"] = Mass(0.0, self.spec.inertia)
        if self.spec.slider is not None:
            found["slider"] = Mass(self.spec.slider.mass)
        return found

    @cached_property
    def machine(self) -> Machine:
        """Everything, with the device."""
        from dataclasses import replace
        from functools import partial

        self._require_turn()
        self._require_own_directions()
        for stroke in self.strokes:
            stroke.cam.require_profile()
        return replace(
            super().machine, more=partial(_pull_of_device, self), stroke=0.0 if self.whole else self.cam.cycle_angle
        )

    def _require_turn(self) -> None:
        """Refuse what a stroke alone cannot tell."""
        given = next((key for key in _OF_TURN if getattr(self.section, key)), None)
        if self.whole or given is None:
            return
        message = f"{given} needs the whole turn of the cam: give cycle in place of cycle_angle"
        if self.spec.slider is not None:
            message = (
                f"{given} needs the whole turn of the cam, and with slider the stroke alone is known: leave it out"
            )
        raise MissingSection(message, key=f"loads.{given}")

    def _require_own_directions(self) -> None:
        """Refuse a direction of what is not there, and a weight whose direction the file leaves open."""
        for name in ("slider", "drive"):
            key, has = f"{name}_direction", getattr(self.spec, name) is not None
            given = getattr(self.section, key) is not None
            if given and not has:
                raise NoSolution(f"this mechanism has no {name}: leave {key} out", key=f"loads.{key}")
            if has and not given and any(self.section.gravity):
                words = f"the weight depends on which way the {name} stands: give loads.{key}"
                raise MissingSection(words, key="loads.gravity")

    @property
    def own_joints(self) -> list[float]:
        """The ends of the strokes, and where the rollers change sides."""
        return list(self.moving.input.joints)

    @property
    def dwell_zones(self) -> list[tuple[float, float]]:
        """Both rests of a whole turn."""
        if self.spec.cycle is None:
            return []
        working, far, back, near = self.design.motion.cycle_angles
        return [(working, far), (working + far + back, near)]

    @property
    def own_directions(self) -> tuple[str, ...]:
        """That of the device, and those of slider and drive where the file has them."""
        others = tuple(f"{name}_direction" for name in ("slider", "drive") if getattr(self.spec, name) is not None)
        return ("device_direction", *others)

    @property
    def unknown_joints(self) -> tuple[str, ...]:
        """Those of a link on which something pulls whose direction the file leaves open."""
        section, spec = self.section, self.spec
        slider_open = spec.slider is not None and section.slider_direction is None
        found = ["D"] if section.device_direction is None or slider_open else []
        if spec.drive is not None and section.drive_direction is None:
            found.append("O")
        return tuple(found)

    # The stroke

    @property
    def own_forces(self) -> bool:
        """Whether more acts than the inertia of rocker and slider, and the device."""
        others = set(self.machine.masses) - {"rocker", "slider"}
        return self.machine.sources.any or self.machine.friction is not None or bool(others)

    def _greatest(self, name: str, *, curved: bool = False) -> float:
        """Greatest value over the strokes of a method of theirs, where the roller touches."""
        import numpy as np

        return max(
            stroke.greatest(lambda k, stroke=stroke: np.abs(getattr(stroke, name)(k)), curved=curved)  # type: ignore[misc]
            for stroke in self.strokes
        )

    @cached_property
    def pressing(self) -> Pressing:
        """How hard the rollers press."""

        return Pressing(self)

    contact_force_max: float = placed("pressing.force")
    least_contact_force: float = placed("pressing.least_force")
    lift_off_speed: float = placed("design.unloading.lift_off_speed")
    hertz_pressure_max: float | None = placed("pressing.pressure")
    shear_depth: float | None = placed("pressing.shear_depth")

    @property
    def roller_speed_max(self) -> float:
        """Greatest speed of the roller where it touches [1/min]."""
        return self._greatest("roller_speed") / _RPM

    @property
    def entrainment_speed_max(self) -> float:
        """Greatest entrainment speed where the roller touches [mm/s]."""
        return self._greatest("entrainment", curved=True)

    cam_torque_max: float = placed("input_torque_max")
    cam_torque_min: float = placed("input_torque_min")
    cam_torque_rms: float = placed("input_torque_rms")

    # Vibration

    @cached_property
    def vibrating(self) -> Vibrating:
        """The rocker on the shaft that drives it."""
        from gearlink.core.machines.wide_swing.loads.vibration import SwingVibrating

        return SwingVibrating(self)

    def quantity(self, name: str) -> Quantity | None:
        """The speed of lift-off is the cam's."""
        from dataclasses import replace

        found = super().quantity(name)
        return replace(found, unit="1/min") if found is not None and name == "lift_off_speed" else found

    def raw(self, name: str) -> Any:
        """A stroke alone has no turns to count; a crank drives no cam shaft."""
        no_shaft = self.spec.drive is not None and name.startswith("cam_torque")
        return None if no_shaft or (name.endswith(".travel") and not self.whole) else super().raw(name)

    def candidates(self, check: str, /) -> Iterable[Remedy]:
        """Of a slider whose arm stands ill that comes first."""
        return (*loads_checks.candidates(self, check), *super().candidates(check))

    rows = loads_tables.rows
    table_contact_stroke, table_harmonics = loads_tables.contact_stroke, loads_tables.harmonics
    check_contact_pressure, check_contact_loss = loads_checks.contact_pressure, loads_checks.contact_loss
    check_resonance, check_body_clearance = loads_checks.resonance, bodies.placed_clearance


def _pull_of_device(loads: WideSwingLoads, mechanism: Mechanism, _phi: Reals) -> list[Force | Torque]:
    """The pull of the device on its pin of the rocker, towards its base pin."""
    import numpy as np

    from gearlink.core.mechanism.dynamics import Force

    unloader, unloading = loads.spec.unloader, loads.design.unloading
    way = cmath.rect(1.0, math.radians(loads.section.device_direction or 0.0))
    rocker = mechanism.links["rocker"]
    arm = unloader.arm
    pin = rocker.at(arm * way)
    # In arms from the pivot: of any size, and a short one is not lost.
    along = way * (unloader.pivot_ratio - rocker.unit)
    length = np.abs(along)
    if unloader.type == "pneumatic":
        pull = np.full(length.shape, unloading.force or 0.0)
    else:
        geometry = loads.design.motion.law.geometry
        mounted = geometry.shortest - unloader.stretch_ratio * geometry.stroke
        pull = (unloading.spring_rate or 0.0) * arm * (length - mounted)
    return [Force("rocker", pull * along / length, pin)]
