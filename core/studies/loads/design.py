"""What `loads` shows of any design: the machine's own part gives links, connections and masses, this the results."""

from __future__ import annotations

import cmath
from contextlib import suppress
from typing import TYPE_CHECKING, Any, ClassVar

from gearlink.core.base.design import Outline
from gearlink.core.base.errors import GearlinkError, MissingSection
from gearlink.core.base.nomenclature import term
from gearlink.core.base.report import Quantity
from gearlink.core.base.results import cached_property
from gearlink.core.studies.loads import checks, tables, vibration_checks
from gearlink.core.studies.loads.base import RPM, LoadsBase
from gearlink.core.studies.loads.vibration_checks import VIBRATION_CHECKS

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from gearlink.core.base.report import Remedy
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.studies.loads.base import Wanted
    from gearlink.core.studies.loads.machine import Machine
    from gearlink.core.studies.loads.vibrating import Vibrating


# Shaking force and moment of a machine, and the counterweights that balance it


class BalancedLoads(LoadsBase):
    """The forces of the masses on the frame, as they are and with counterweights."""

    @cached_property
    def shaking_force_max(self) -> float:
        """Greatest shaking force [N]."""
        return self.extreme_of("shaking_force").value

    @cached_property
    def shaking_moment_max(self) -> float:
        """Greatest magnitude of the shaking moment about the input's pivot [N m]."""
        return self.extreme_of("shaking_moment").value

    def shaking(self, phi: Reals) -> Any:
        """Force and moment of the masses on the frame."""
        from gearlink.core.mechanism.dynamics import shaking

        return shaking(self.machine.at(phi), self.masses, self.speed)

    # Counterweights

    def counterweights(self) -> dict[str, complex]:
        """Mass moments [kg mm] by link in its coordinates that balance the machine as the file asks."""
        return {}

    @cached_property
    def balance(self) -> dict[str, complex]:
        """The counterweights that the file asks for."""
        asked = getattr(self.section, "balance", None)
        if asked is None:
            return {}
        share = getattr(asked, "share", 1.0)
        return {name: share * moment for name, moment in self.counterweights().items()}

    def balanced_force(self, moments: dict[str, complex]) -> float:
        """Greatest shaking force with these counterweights [N]."""
        from gearlink.core.mechanism.dynamics import Mass, shaking

        # On a link that turns about its origin, 1 kg at U mm has the mass moment U, and nothing else in the force.
        weights = {name: Mass(1.0, 0.0, moment) for name, moment in moments.items()}

        def force(phi: Reals) -> Reals:
            added = shaking(self.machine.at(phi), weights, self.speed)[0]
            return np_abs(self.shaking(phi)[0] + added)

        return self.extreme(force).value

    def _moment(self, name: str) -> complex | None:
        return self.balance.get(name)

    @property
    def counterweight_crank(self) -> float | None:
        """Mass moment of the crank's counterweight [kg mm]."""
        return _size(self._moment("crank"))

    @property
    def counterweight_crank_direction(self) -> float | None:
        """Its direction in the crank's coordinates [rad]."""
        return _direction(self._moment("crank"))

    @property
    def counterweight_rocker(self) -> float | None:
        """Mass moment of the rocker's counterweight [kg mm]."""
        return _size(self._moment("rocker"))

    @property
    def counterweight_rocker_direction(self) -> float | None:
        """Its direction in the rocker's coordinates [rad]."""
        return _direction(self._moment("rocker"))

    @cached_property
    def balanced_force_max(self) -> float | None:
        """Greatest shaking force with the counterweights [N]."""
        from gearlink.core.base.report import without_noise

        if not self.balance:
            return None
        return without_noise(self.balanced_force(self.balance), 64.0 * self.shaking_force_max)


def np_abs(values: Any) -> Reals:
    """Magnitudes of plane vectors."""
    found: Reals = abs(values)
    return found


def _size(moment: complex | None) -> float | None:
    return None if moment is None else abs(moment)


def _direction(moment: complex | None) -> float | None:
    return None if moment is None else cmath.phase(moment)


_HIGHEST = 10_000
_CANCELLED = 1e-6
MOST_TURNS = 100
"""Turns of the period that tables show at most."""
TORQUE = (
    "input_torque_mean",
    "input_torque_rms",
    "input_torque_max",
    "input_torque_max_at",
    "input_torque_min",
    "input_torque_min_at",
    "input_power_mean",
    "input_power_peak",
    "reflected_inertia_min",
    "reflected_inertia_max",
    "reflected_inertia_mean",
    "torque_reversals",
    "energy_fluctuation",
)
RUN = (
    "flywheel_inertia",
    "speed_min",
    "speed_max",
    "speed_fluctuation",
    "motor_torque_rms",
    "motor_torque_peak",
)
FRAME = ("shaking_force_max", "shaking_moment_max")
BALANCE = (
    "counterweight_crank",
    "counterweight_crank_direction",
    "counterweight_rocker",
    "counterweight_rocker_direction",
    "balanced_force_max",
)
PIN = ("peak", "equivalent", "travel", "life", "bearing_pressure")
MESH = ("tooth_force_max", "reversals")
TABLES = ("torque", "joints", "teeth", "frame", "speed", "spectrum", "harmonics")
OF_VIBRATION = ("spectrum", "harmonics")
VIBRATION = (
    "natural_frequency",
    "frequency_ratio",
    "rise_periods",
    "residual_amplitude",
    "residual_speed_limit",
    "dwell_twist",
    "twisted_ripple",
)


def loads_outline(
    pins: tuple[str, ...],
    meshes: tuple[str, ...],
    more: tuple[str, ...] = (),
    more_checks: tuple[str, ...] = (),
    shown: tuple[str, ...] = ("torque",),
) -> dict[str, Outline]:
    """The outline of `loads` for a machine with these joints."""
    own = [f"pin_{pin}.{name}" for pin in pins for name in PIN]
    own += [f"{mesh}.{name}" for mesh in meshes for name in MESH]
    names = (*TORQUE, *RUN, *FRAME, *more, *own, *VIBRATION, "massless", "power_identity")
    return {"loads": Outline(names, (*checks.CHECKS, *more_checks, *VIBRATION_CHECKS), shown)}


class LoadsDesign(BalancedLoads):
    """The loads of a design file that has the section; a subclass per machine says how its links move."""

    extra_tables: ClassVar[tuple[str, ...]] = TABLES[1:]

    def raw(self, name: str) -> Any:
        """Quantities of a joint stand under its name."""
        joint, dot, quantity = name.partition(".")
        if not dot:
            return super().raw(name)
        found = self.pin(joint.removeprefix("pin_")) if joint.startswith("pin_") else self.mesh(joint)
        return self._unless_locked(lambda: getattr(found, quantity, None), None)

    def rows(self, samples: int | None) -> tuple[Reals, dict[str, tuple[Any, str]]]:
        """Input angles [rad] of a table's rows, and its first columns."""
        import numpy as np

        from gearlink.core.numerics.arrays import turn_degrees

        degrees = turn_degrees(samples, min(self.turns, MOST_TURNS))
        return np.radians(degrees), {"input_angle": (degrees, "deg")}

    @cached_property
    def power_identity(self) -> float:
        """Largest difference of the two input torques over the largest of them.

        Notes
            Where the parts of the torque cancel to a millionth, as those of an unbalanced wheel that turns evenly, a
            millionth of the parts takes its place: both ways round at 1e-16 of them.
        """
        import numpy as np

        from gearlink.core.numerics.blocks import BLOCK

        machine, apart, sizes = self.machine, [0.0], [0.0]
        phi = np.linspace(0.0, machine.period, 360 * self.turns, endpoint=False)
        if machine.friction is not None and machine.locks:
            machine.reactions(phi)  # which says so
        for rows, block in machine.by_blocks(phi.size) if phi.size > 2 * BLOCK else [(slice(None), machine)]:
            torque, power, parts = _both_torques(block, phi[rows])
            apart.append(float(np.max(np.abs(torque - power))))
            sizes += [*(float(np.max(np.abs(each))) for each in (torque, power)), _CANCELLED * float(np.max(parts))]
        return max(apart) / max(sizes) if max(sizes) else 0.0

    @cached_property
    def nearest_locking(self) -> tuple[float, float | None]:
        """How near friction is to locking the machine, the worst of the period, and the input angle [rad].

        Notes
            As `Machine.locking`, of some rows alone, where the machine locks itself.
        """
        from gearlink.core.mechanism.rubbing import SelfLocking

        if self.locked:
            return self.machine.locking
        try:
            found = self.extreme(self.machine.passes_ratio)
        except SelfLocking:
            return float("inf"), None
        return found.value, found.place % self.machine.period

    # Frame and joints

    def course(self, name: str) -> Callable[[Reals], Reals]:
        """Shaking and the forces of the joints as well."""
        if name in ("shaking_force", "shaking_moment"):
            part = 0 if name == "shaking_force" else 1
            return lambda phi: abs(self.shaking(phi)[part])
        joint = self.pin(name.removeprefix("pin_")) or self.mesh(name)
        size: Callable[[Reals], Reals] | None = getattr(joint, "size", None)
        return size or super().course(name)

    def wanted(self, quantity: str) -> Iterable[Wanted]:
        """The extremes that a quantity needs."""
        joint, dot, of_joint = quantity.partition(".")
        if not dot:
            return ((quantity.removesuffix("_max"), True),) if quantity in FRAME else super().wanted(quantity)
        pin = self.pin(joint.removeprefix("pin_"))
        known = self.has(joint) if pin is None else pin.known and of_joint != "travel"
        return ((joint, True),) if known else ()

    # What the checks ask

    def limit(self, name: str) -> float:
        """A limit of the file."""
        return float(getattr(self.spec.limits, name))

    def prepare(self, quantities: Iterable[str]) -> None:
        """Search extremes together, and then the reversals of pins, and those of meshes."""
        from gearlink.core.studies.loads.joints import find_reversals, find_ways

        super().prepare(names := tuple(quantities))
        with suppress(GearlinkError):  # it is said where the quantity is asked for
            asked = [name.partition(".") for name in names]
            held = [joint[4:] for joint, _, name in asked if name in ("equivalent", "travel", "life")]
            pins = [pin for pin in map(self.pin, held) if pin]
            meshes = [self.mesh(joint) for joint, _, name in asked if name == "reversals"]
            size = self.torque_size if "torque_reversals" in names else None
            turned = find_reversals(self.machine, pins, [mesh for mesh in meshes if mesh], size)
            if turned is not None:
                vars(self)["torque_reversals"] = len(turned)
            find_ways(self.machine, pins, pressed=any(name in ("equivalent", "life") for _, _, name in asked))

    @property
    def quiet_zones(self) -> list[tuple[float, float]]:
        """Where the output must stand or run true: first input angle and width of each [rad]."""
        return []

    def is_quiet(self, place: float) -> bool:
        """Whether an input angle lies in one of them."""
        return any((place - start) % self.machine.period <= width for start, width in self.quiet_zones)

    @property
    def transmission_angle(self) -> float | None:
        """Least transmission angle over the period [rad], of machines that have one."""
        found: float | None = getattr(getattr(self, "design", None), "min_transmission_angle", None)
        return found

    # Vibration

    @cached_property
    def vibrating(self) -> Vibrating:
        """The output on its spring."""
        from gearlink.core.studies.loads.vibrating import Vibrating

        return Vibrating(self)

    @property
    def vibrating_given(self) -> Vibrating:
        """The same, refused where the file does not give it."""
        self._require_vibration()
        return self.vibrating

    def _require_vibration(self) -> None:
        if self.section.vibration is None:
            raise MissingSection("this table needs loads.vibration: {frequency: Hz}", key="loads")

    def require_table(self, name: str, /) -> None:
        """Those of the vibration need its section."""
        if name in OF_VIBRATION:
            self._require_vibration()

    speed_unit_name: ClassVar[str] = "1/min"

    @property
    def dwell_zones(self) -> list[tuple[float, float]]:
        """Dwells of the output: first input angle and width of each [rad]."""
        return self.quiet_zones

    speed_unit: ClassVar[float] = RPM
    speed_seconds: ClassVar[float] = 60.0
    speed_words: ClassVar[str] = "rev/min"

    def quantity(self, name: str) -> Quantity | None:
        """Places of the output are in mm where it slides, speeds in the unit of the kind's own."""
        unit = self._own_unit(name)
        if unit is None:
            return super().quantity(name)
        value, entry = self.raw(name), term(name)
        return None if value is None else Quantity(name, value, unit, entry.symbol, entry.words)

    def _own_unit(self, name: str) -> str | None:
        if name in ("residual_amplitude", "dwell_twist", "twisted_ripple"):
            return "mm" if self.output in self.sliding else "deg"
        return self.speed_unit_name if name == "residual_speed_limit" else None

    def _of_vibration(self, value: Callable[[Vibrating], float | None]) -> float | None:
        return None if self.section.vibration is None else value(self.vibrating)

    @property
    def natural_frequency(self) -> float | None:
        """Natural frequency of the output [Hz]."""
        return self._of_vibration(lambda v: v.frequency)

    @property
    def frequency_ratio(self) -> float | None:
        """It over the frequency of the input."""
        return self._of_vibration(lambda v: v.frequency_ratio)

    @property
    def rise_periods(self) -> float | None:
        """Natural periods in the shortest motion between two dwells."""
        return self._of_vibration(lambda v: v.rise_periods)

    @property
    def residual_amplitude(self) -> float | None:
        """Amplitude that a motion leaves in the dwell after it [deg or mm]."""
        return self._of_vibration(lambda v: v.residual)

    @property
    def residual_speed_limit(self) -> float | None:
        """Least speed at which that passes what is allowed, in the unit of the kind's own speed."""
        limit = self._of_vibration(lambda v: v.speed_limit)
        return None if limit is None else limit / self.speed_unit

    @property
    def dwell_twist(self) -> float | None:
        """Greatest deflection in the dwells in the steady state [deg or mm]."""
        return self._of_vibration(lambda v: v.twist)

    @property
    def twisted_ripple(self) -> float | None:
        """Range of the output with its deflection in a dwell [deg or mm]."""
        return self._of_vibration(lambda v: v.twisted_ripple)

    def harmonic_shares(self, orders: Sequence[int]) -> list[float]:
        """Acceleration of harmonics of the output over that of the greatest.

        Parameters
            orders : ascending - cycles over the period
        Notes
            0 above 10000 a turn: even where the acceleration jumps, it has fallen below 1e-3 there.
        """
        import numpy as np

        from gearlink.core.studies.loads.vibration import harmonics

        seen = [order for order in orders if order <= _HIGHEST * self.turns]
        rows = max([720 * self.turns, *(4 * order for order in seen[-1:])])
        phi = np.arange(rows, dtype=np.float64) * (self.machine.period / rows)
        found = harmonics(self.vibrating.bend(phi), rows // 2) if seen else np.zeros(1)
        top = float(np.max(found))
        shares = [float(found[order - 1]) / top if top > 0.0 else 0.0 for order in seen]
        return shares + [0.0] * (len(orders) - len(seen))

    def has(self, name: str) -> bool:
        """Whether this design has a joint of the name."""
        return name in self._names

    @cached_property
    def _names(self) -> tuple[str, ...]:
        import numpy as np

        return tuple(each.name for each in self.machine.at(np.zeros(1)).connections)

    def pin(self, name: str) -> Any:
        """Peak, equivalent load and travel of a pin; None where this design has none of the name."""
        return self.pins_found.get(name, None)

    @cached_property
    def pins_found(self) -> dict[str, Any]:
        """The pins of this design, by name."""
        from gearlink.core.mechanism.joints import Pin
        from gearlink.core.studies.loads.joints import PinLoad

        bearings = self.section.bearings
        self._require_joints("bearings", bearings, Pin)
        self._require_directions(bearings)
        return {name: PinLoad(self, name, bearings.get(name)) for name in self.pins if self.has(name)}

    @property
    def own_directions(self) -> tuple[str, ...]:
        """Keys of the section that say which way something stands that this design has."""
        return tuple(key for key in type(self.section).model_fields if key.endswith("_direction"))

    def _require_directions(self, bearings: Iterable[str]) -> None:
        """Refuse bearings whose force the file leaves open."""
        section = self.section
        for name in bearings:
            if name in self.unknown_joints:
                keys = " and ".join(f"loads.{key}" for key in self.own_directions if getattr(section, key) is None)
                message = f"the force on the bearing of {name} depends on where its neighbours stand: give {keys}"
                raise MissingSection(message, key=f"loads.bearings.{name}")

    def mesh(self, name: str) -> Any:
        """Greatest tooth force and reversals of a mesh; None where this design has none of the name."""
        return self.meshes_found.get(name, None)

    @cached_property
    def meshes_found(self) -> dict[str, Any]:
        """The meshes of this design, by name."""
        from gearlink.core.mechanism.joints import Toothed
        from gearlink.core.studies.loads.joints import MeshLoad

        if isinstance(self.section.backlash, dict):
            self._require_joints("backlash", self.section.backlash, *Toothed)
        return {name: MeshLoad(self, name) for name in self.meshes if self.has(name)}

    def candidates(self, check: str, /) -> Iterable[Remedy]:
        """Remedies from closed forms."""
        from gearlink.core.studies.loads.remedies import candidates

        return candidates(self, check)

    table_torque, table_joints = tables.torque, tables.joints
    table_teeth, table_frame, table_speed = tables.teeth, tables.frame, tables.speed
    table_spectrum, table_harmonics = tables.spectrum, tables.harmonics

    check_power_identity, check_load_reversal = checks.power_identity, checks.load_reversal
    check_motor_speed, check_tooth_load = checks.motor_speed, checks.tooth_load
    check_motor_torque, check_speed_fluctuation = checks.motor_torque, checks.speed_fluctuation
    check_bearing_life, check_force_amplification = checks.bearing_life, checks.force_amplification
    check_rigid_model, check_resonance = vibration_checks.rigid_model, vibration_checks.resonance
    check_residual_vibration = vibration_checks.residual_vibration
    check_impact, check_self_locking = checks.impact, checks.self_locking


def _both_torques(machine: Machine, phi: Reals) -> tuple[Reals, Reals, Reals]:
    """Input torque by the forces between the links and by virtual power, and the sizes of what cancels in it [N m]."""
    from gearlink.core.mechanism.dynamics import power_parts

    found, power = machine.reactions(phi), machine.reduced(phi).torque(machine.speed)
    if machine.friction is not None:
        from gearlink.core.mechanism.friction import losses

        power = power + losses(found, machine.friction, machine.speed) / machine.speed
    parts = power_parts(machine.at(phi), machine.masses, machine.applied(phi), machine.gravity, machine.speed)
    return found.torque, power, parts
