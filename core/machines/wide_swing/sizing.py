"""The unloading device as it is bought: its lengths, bore or spring, and what a given one balances."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import Table, safely_above, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import unlike

if TYPE_CHECKING:
    from gearlink.core.machines.wide_swing.device import DeviceGeometry
    from gearlink.core.machines.wide_swing.motion import Motion
    from gearlink.core.machines.wide_swing.spec import Pneumatic, WideSwingSpec
    from gearlink.core.numerics.arrays import Reals

BORES = (8, 10, 12, 16, 20, 25, 32, 40, 50, 63, 80, 100, 125, 160, 200, 250, 320)
"""Standard bores [mm], up to 25 of ISO 6432, above of ISO 15552."""
ISENTROPIC = 1.4

OF_LINE = ("base_distance", "device_length_min", "device_length_max", "device_stroke")
OF_ALL = ("force_max", "stored_energy", "balanced_speed", "reserve")
OF_SPRING = ("mounting_stretch", "stretch_max", "free_length", "force_min")
OF_GRAVITY = ("mass", "max_distance")
OF_CYLINDER = ("bore", "standard_bore", "set_pressure", "force_variation")
QUANTITIES = {name: f"unloading.size.{name}" for name in (*OF_LINE, *OF_ALL, *OF_CYLINDER, *OF_SPRING, *OF_GRAVITY)}


def names(spec: WideSwingSpec) -> tuple[str, ...]:
    """The quantities that the device of a file has."""
    unloader = spec.unloader
    if unloader.type == "gravity":
        return (*OF_GRAVITY, *OF_ALL)
    if unloader.type == "spring":
        return (*OF_LINE, *OF_ALL, *OF_SPRING)
    cylinder = OF_CYLINDER[2:3] if unloader.bore is not None else OF_CYLINDER[:3]
    shown = cylinder if unloader.bore is not None or unloader.pressure is not None else ()
    return (*OF_LINE, *OF_ALL, *shown, *(OF_CYLINDER[3:] if unloader.reservoir is not None else ()))


class DeviceSize:
    """Lengths, force and energy of the device, in mm, N and J, from the file and the rocker's motion.

    The pin stands at r_d on the rocker, the base pin at lambda r_d, in line with the rocker's axis at mid-swing.

    Source
        wide-swing dissertation (2), (6), (11); own derivation
    """

    def __init__(self, spec: WideSwingSpec, motion: Motion) -> None:
        self.spec, self.motion = spec, motion

    @property
    def _geometry(self) -> DeviceGeometry:
        return self.motion.law.geometry

    @property
    def _arm(self) -> float:
        unloader = self.spec.unloader
        assert unloader.type != "gravity", "a pendulum has no pins"
        return unloader.arm

    # What balances, and what is given

    @cached_property
    def balancing(self) -> float:
        """Force [N], rate [N/mm] or mass [kg] that balances the inertia at the design speed.

        P = N J gamma^2/(2 r_d T^2), c = P/r_d; m = kappa J_0/(g s - kappa s^2), kappa = N gamma^2/(2 T^2)
        """
        motion, unloader = self.motion, self.spec.unloader
        if unloader.type == "gravity":
            return motion.pendulum_mass(1.0)
        work = motion.law.energy_parameter * motion.inertia * motion.swing**2
        force = work / (2.0e-3 * unloader.arm * motion.stroke_time**2)
        return force if unloader.type == "pneumatic" else force / unloader.arm

    @cached_property
    def reserve(self) -> float:
        """Force of the device over the one that balances, less 1; of a given device a result, negative where weak."""
        unloader, motion = self.spec.unloader, self.motion
        if unloader.type == "gravity":
            return unloader.reserve if unloader.mass is None else motion.pendulum_reserve(unloader.mass)
        given = unloader.force if unloader.type == "pneumatic" else unloader.rate
        return unloader.reserve if given is None else given / self.balancing - 1.0

    @cached_property
    def strength(self) -> float:
        """Force [N] or rate [N/mm] of the device: the given one, or the balancing one with the reserve."""
        unloader = self.spec.unloader
        assert unloader.type != "gravity", "a pendulum has a mass"
        given = unloader.force if unloader.type == "pneumatic" else unloader.rate
        return (1.0 + self.reserve) * self.balancing if given is None else given

    @property
    def balanced_speed(self) -> float:
        """Speed of the cam at which the device balances the inertia, n sqrt(1 + reserve) [1/min].

        n_bal = (phi_ud/(2 pi gamma)) sqrt(2 P r_d/(N J))
        """
        return self.spec.speed * math.sqrt(1.0 + self.reserve)

    # Lengths

    @property
    def base_distance(self) -> float:
        """a_d = lambda r_d, from the rocker's axis to the base pin [mm]."""
        return self._geometry.ratio * self._arm

    @property
    def device_length_min(self) -> float:
        """Between the pins at mid-swing, r_d (lambda - 1) [mm]."""
        return self._geometry.shortest * self._arm

    @property
    def device_length_max(self) -> float:
        """Between the pins at the ends of the swing [mm]."""
        return self._geometry.longest * self._arm

    @property
    def device_stroke(self) -> float:
        """S = r_d D [mm]."""
        return self._geometry.stroke * self._arm

    # Force and energy

    @cached_property
    def force_max(self) -> float:
        """Maximum pull of the device: P, c (S0 + S), or the weight of a pendulum [N]."""
        unloader = self.spec.unloader
        if unloader.type == "gravity":
            return self.mass * unloader.gravity
        return self.strength if unloader.type == "pneumatic" else self.strength * self.stretch_max

    @property
    def stored_energy(self) -> float:
        """Energy from mid-swing to an end: P S, c (S0 S + S^2/2), m g s (1 - cos(gamma/2)) [J]."""
        unloader = self.spec.unloader
        if unloader.type == "gravity":
            return 2e-3 * self.force_max * unloader.distance * self._geometry.half_sine**2
        if unloader.type == "pneumatic":
            return 1e-3 * self.strength * self.device_stroke
        return 1e-3 * self.strength * self.device_stroke * (self.mounting_stretch + 0.5 * self.device_stroke)

    # Spring

    @property
    def mounting_stretch(self) -> float:
        """S0 = eps S, stretch at mid-swing [mm]."""
        return self._geometry.mounting * self._arm

    @property
    def stretch_max(self) -> float:
        """S0 + S, stretch at the ends [mm]."""
        return self.mounting_stretch + self.device_stroke

    @property
    def force_min(self) -> float:
        """c S0, at mid-swing [N]."""
        return self.strength * self.mounting_stretch

    @property
    def free_length(self) -> float:
        """Between the pins where the force is zero [mm]; of the spring itself less the end fittings."""
        return self.device_length_min - self.mounting_stretch

    # Cylinder

    @property
    def _cylinder(self) -> Pneumatic:
        unloader = self.spec.unloader
        assert unloader.type == "pneumatic", "needed of a cylinder alone"
        return unloader

    @cached_property
    def bore(self) -> float:
        """d = sqrt(4 P/(pi p eta) + d_rod^2), the cylinder pulling with the side of its rod [mm]."""
        cylinder = self._cylinder
        if cylinder.bore is not None:
            return cylinder.bore
        assert cylinder.pressure is not None, "needed where there is a pressure"
        area = self.strength / (cylinder.pressure * cylinder.efficiency)
        return math.hypot(2.0 * math.sqrt(area / math.pi), cylinder.rod_diameter)

    @property
    def standard_bore(self) -> float | None:
        """The next bore of ISO 6432 or ISO 15552 [mm]; None above the greatest."""
        return next((float(bore) for bore in BORES if bore >= self.bore * (1.0 - 1e-12)), None)

    @property
    def _built_bore(self) -> float:
        """The bore that is built: the given one, or the standard one where there is one."""
        return self.bore if self._cylinder.bore is not None else self.standard_bore or self.bore

    @property
    def _area(self) -> float:
        """Area of the piston round its rod [mm^2]."""
        rod = self._cylinder.rod_diameter
        return 0.25 * math.pi * (self._built_bore - rod) * (self._built_bore + rod)

    @property
    def set_pressure(self) -> float:
        """4 P/(pi eta (d^2 - d_rod^2)), gauge pressure that gives the force in the bore that is built [N/mm^2]."""
        return self.strength / (self._cylinder.efficiency * self._area)

    @cached_property
    def force_variation(self) -> float:
        """(V/(V - A S))^1.4 - 1, rise of the force over the stroke in a closed volume, isentropic.

        Raises
            NoSolution - where the piston sweeps the whole volume
        """
        litres = self._cylinder.reservoir
        assert litres is not None, "needed where there is a reservoir"
        swept = 1e-6 * self._area * self.device_stroke
        if swept >= litres:
            least = safely_above(1.05 * swept)
            message = f"reservoir: {unlike(litres, swept)} l (limit > {unlike(swept, litres)} l, swept by the piston)"
            fix = f"set unloader.reservoir to at least {least} l"
            raise NoSolution(message, key="unloader.reservoir", fix=fix)
        return math.pow(litres / (litres - swept), ISENTROPIC) - 1.0

    # Pendulum

    @property
    def mass(self) -> float:
        """Mass that hangs at `unloader.distance` [kg]."""
        return self.motion.hanging_mass

    @property
    def max_distance(self) -> float:
        """g/((1 + reserve) kappa), from which on a pendulum is too slow [mm]."""
        return 1e3 * self.motion.pendulum.gravity / ((1.0 + self.reserve) * self.motion.pendulum_rate)

    # Over the stroke

    def table(self, k: Reals) -> Table:
        """What the device does over the stroke, and what it leaves: torques in the sense of the stroke."""
        motion, g = self.motion, self._geometry
        sine, cosine = motion.law.pendulum(k)
        side = np.where(k < motion.law.middle_place, 1.0, -1.0)
        angle = g.angle(np.abs(sine), cosine)
        unloader = self.spec.unloader
        if unloader.type == "gravity":
            length, force = np.full_like(k, np.nan), np.full_like(k, self.force_max)
            lever, size = np.sin(angle), unloader.distance * self.force_max
        else:
            arm = unloader.arm
            size = self.strength * (arm if unloader.type == "pneumatic" else arm * arm)
            length, force = arm * g.length(sine), size / arm * g.force(sine)
            lever = g.force(sine) * g.lever(np.abs(sine), cosine)
        inertia = motion.inertia * motion.swing / motion.stroke_time**2 * motion.law.device_torque(k)
        torque, stored = 1e-3 * size * side * lever, 1e-3 * size * g.energy(sine, cosine)
        moving = motion.inertia * motion.swing / motion.stroke_time**2 * 0.5 * motion.swing * motion.law.kinetic(k)
        columns = {
            "k": (k, "1"),
            "angle": (np.degrees(-side * angle), "deg"),
            "device_length": (length, "mm"),
            "device_force": (force, "N"),
            "device_torque": (torque, "N m"),
            "inertia_torque": (inertia, "N m"),
            "residual_torque": (torque - inertia, "N m"),
            "energy": (stored, "J"),
            "kinetic_energy": (moving, "J"),
        }
        return Table.of("device", columns)


def free_stretch(free: float, arm: float, shortest: float, stroke: float) -> float:
    """Mounting stretch over stroke of a spring of given free length.

    eps = (r_d (lambda - 1) - free_length)/(r_d D)

    Parameters
        free, arm : float [mm] - free length between the pins, r_d
        shortest, stroke : float - lambda - 1 and D, in arms
    Raises
        NoSolution - where the spring is slack at mid-swing
    Example
        >>> free_stretch(150.0, 100.0, 2.0, 0.5)
        1.0
    """
    left = arm * shortest - free
    if left < 0.0:
        raise NoSolution(
            f"free length of the spring: {unlike(free, arm * shortest)} mm (limit <= {unlike(arm * shortest, free)} "
            "mm, distance of the pins at mid-swing: it is slack there)",
            key="unloader.free_length",
            fix=f"set unloader.free_length to at most {safely_below(arm * shortest)} mm",
        )
    return left / (arm * stroke)
