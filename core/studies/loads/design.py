"""The loads of a design file: the machine's own part gives links, connections and masses, this the results."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, Any, ClassVar, TypeAlias

import numpy as np

from gearlink.core.base.design import Design, Outline, placed
from gearlink.core.base.errors import GearlinkError, MissingSection, NoSolution
from gearlink.core.base.remedies.ways import at_least, at_most
from gearlink.core.base.report import Check, Remedy, without_noise
from gearlink.core.base.results import cached_property, keep
from gearlink.core.base.spec_paths import number_at
from gearlink.core.base.torsion import torsional_stiffness
from gearlink.core.mechanism.joints import Connection, Guide, Pin, Toothed
from gearlink.core.numerics.arrays import BLOCK, Reals, turn_degrees
from gearlink.core.studies.loads import checks, tables
from gearlink.core.studies.loads.checks import VIBRATION_CHECKS, residual_vibration, resonance, rigid_model
from gearlink.core.studies.loads.names import (
    DERIVED,
    FRAME,
    MESH,
    OF_VIBRATION,
    PIN,
    RPM,
    RUN,
    TABLES,
    TORQUE,
    VIBRATION,
)

if TYPE_CHECKING:
    from gearlink.core.mechanism.dynamics import Mass
    from gearlink.core.mechanism.motion import Motion
    from gearlink.core.numerics.extremes import Extreme
    from gearlink.core.studies.loads.flywheel import Energy
    from gearlink.core.studies.loads.machine import Machine
    from gearlink.core.studies.loads.running import Running
    from gearlink.core.studies.loads.vibration import Vibrating


_SLOWEST = 1e-6
_TURN_COST = 15.0
_OF_TORQUE = frozenset(
    (
        "input_torque_mean", "input_torque_max", "input_torque_max_at", "input_torque_min", "input_torque_min_at",
        "input_power_mean", "input_power_peak", "torque_reversals",
    )
)  # fmt: skip
Wanted: TypeAlias = tuple[str, bool]
"""A course by name, and whether its maximum or its minimum value is shown."""
_OF_OUTPUT = frozenset({"residual_amplitude", "dwell_twist", "twisted_ripple"})
_HIGHEST = 10_000
_CANCELLED = 1e-6
_BESIDE_BREAK = 1e-11
"""Of the maximum, what a torque changes by between a break of the motion and where it is looked for beside it."""
MOST_TURNS = 100
"""Turns of the period that tables show at most."""


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


def at_extreme(course: str, greatest: bool = True) -> Any:
    """A quantity that is the maximum or minimum value over the period of a `course`."""
    return property(lambda design: design.extreme_of(course, greatest).value, doc=f"Extreme of `{course}`.")


def _of_counterweight(link: str, of: Callable[[complex], float]) -> Any:
    """Size [kg mm] of the mass moment of a link's counterweight, or its direction [rad]; None without one."""

    def value(design: LoadsDesign) -> float | None:
        moment = design.balance.get(link)
        return None if moment is None else of(moment)

    return property(value, doc=f"Of the counterweight of the {link}.")


def _deflection(name: str) -> Any:
    """A deflection of the output, of its vibration [deg or mm], in rad where the output turns; None without either."""

    def value(design: LoadsDesign) -> float | None:
        found = None if design.section.vibration is None else getattr(design.vibrating, name)
        return found if found is None or design.output in design.sliding else math.radians(found)

    return property(value, doc=f"`{name}` of the vibration.")


class LoadsDesign(Design):
    """The loads of a design file that has the section; a subclass per machine says how its links move.

    `links` names what has a mass, `sliding` those of them that slide, `pins` and `meshes` the joints (those that a
    design does not have are left out where they are asked for).
    """

    joints_of_period: ClassVar[bool] = False
    design: Any
    """The geometry."""
    links: ClassVar[tuple[str, ...]]
    output: ClassVar[str] = "output"
    extra_tables: ClassVar[tuple[str, ...]] = TABLES[1:]
    other_bearings: ClassVar[tuple[str, ...]] = ()
    """Names of bearings that are no pin's."""
    stands: ClassVar[bool] = False
    """Whether the output truly rests in its dwells."""
    jumps: ClassVar[bool] = False
    """Whether its speed jumps."""
    sliding: ClassVar[tuple[str, ...]] = ()
    section_example: ClassVar[str] = ""
    """A key of it [mm] where masses and speed stand in sections of the machine's own."""
    pins: ClassVar[tuple[str, ...]]
    meshes: ClassVar[tuple[str, ...]]
    advises = False
    derived = DERIVED
    highest: int = 3
    """The highest derivative that the machine's law of motion has."""

    @cached_property
    def moving(self) -> Motion:
        """The motion of the geometry."""
        found: Motion = self.design.moving
        return found

    # The section and the machine

    @cached_property
    def section(self) -> Any:
        """The section `loads`."""
        if self.spec.loads is None:
            raise MissingSection(self._first_section(), key="loads")
        return self.spec.loads

    def _first_section(self) -> str:
        """What to write where the file has no section; the speed where the machine's own keys do not give it."""
        if self.section_example:
            return self._needs(self.section_example, "mm")
        own = (
            type(self).given_speed is not LoadsDesign.given_speed or getattr(self.spec, "input_speed", None) is not None
        )
        keys = ("" if own else "speed: 90, ") + f"links: {{{self.links[0]}: {{mass: 2, inertia: 0.01}}}}"
        return self._needs(keys, "kg, kg m^2" if own else "1/min, kg, kg m^2")

    def _needs(self, keys: str, units: str) -> str:
        return f"`loads` needs the section loads, such as loads: {{{keys}}} ({units}); `new {self.kind}` shows its keys"

    @property
    def section_roller(self) -> Any:
        """The rollers of the file, of kinds that have cams; None without."""
        return getattr(self.section, "roller", None)

    @cached_property
    def speed(self) -> float:
        """Speed of the input [rad/s], signed."""
        return self.given_speed * RPM

    @property
    def given_speed(self) -> float:
        """The same in the unit of the file's own key, as it stands there."""
        given: float | None = self.section.speed
        if given is None and (given := getattr(self.spec, "input_speed", None)) is None:
            raise MissingSection("`loads` needs the speed of the input", key="loads.speed", fix="give loads.speed")
        if abs(given) < _SLOWEST:
            words = f"{_SLOWEST:g} 1/min or more, or -{_SLOWEST:g} 1/min or less for a revolution the other way"
            raise NoSolution(f"no inertia forces at a speed of {given:g} 1/min", key="loads.speed", fix=f"give {words}")
        return given

    @property
    def own_joints(self) -> list[float]:
        """Input angles [rad] at which the machine's own motion has a jump in its accelerations."""
        return list(self.moving.input.joints)

    @property
    def turns(self) -> int:
        """Input turns after which everything repeats."""
        return 1

    @property
    def motion_turns(self) -> int:
        """Input turns after which the links come home, gears out of balance apart; dwells begin with those."""
        return self.turns

    @property
    def cost(self) -> float:
        """Loads are computed over every revolution of the period; with friction they take some twenty times as long."""
        rubs = "machine" in self.__dict__ and self.machine.friction is not None
        return _TURN_COST * (1 + (self.turns - 1) * (20 if rubs else 1))

    @property
    def shaft_inertia(self) -> float:
        """Inertia of what turns evenly with the input, reduced to it [kg m^2]."""
        return 0.0

    @property
    def own_links(self) -> tuple[str, ...]:
        """The links that this design has; of a kind with several forms some of `links`."""
        return self.links

    @cached_property
    def masses(self) -> dict[str, Mass]:
        """Masses by link, those of the file."""
        from gearlink.core.studies.loads.sources import mass_of
        from gearlink.core.studies.loads.spec import of_body

        bodies = {name: of_body(self.section.links, name) for name in self.own_links}
        return {name: mass_of(body) for name, body in bodies.items() if body.mass or body.inertia}

    @property
    def massless(self) -> list[str] | None:
        """Links that count as without mass and inertia; None where every link has some."""
        return [name for name in self.own_links if name not in self.masses] or None

    @cached_property
    def machine(self) -> Machine:
        """Everything together."""
        from gearlink.core.studies.loads.machine import Machine, free_what_others_kept
        from gearlink.core.studies.loads.sources import Sources, gravity_of

        free_what_others_kept()
        sources = Sources(self.section, self.own_links, self.sliding)
        if not self.masses and not sources.any and not self.shaft_inertia:
            raise MissingSection(
                "no loads without a mass, an inertia or a force",
                key="loads.links" if "links" in type(self.section).model_fields else "loads",
                fix="give loads.links or loads.forces",
            )
        return Machine(
            self.moving,
            self.masses,
            sources,
            gravity_of(self.section),
            self.speed,
            self.turns,
            self.friction,
            tuple(self.own_joints),
            self.shaft_inertia,
            self.joints_of_period,
        )

    @cached_property
    def friction(self) -> Any:
        """Coefficients of friction, where the file gives any."""
        if (given := self.section.friction) is None:
            return None
        from gearlink.core.studies.loads.sources import coefficients_of

        rubbing = [c for c in self._connections if isinstance(c, (Pin, Guide, *Toothed)) or getattr(c, "slides", False)]
        self._require_joints("friction.joints", given.joints, rubbing)
        return coefficients_of(given, self._connections)

    @property
    def unknown_joints(self) -> tuple[str, ...]:
        """Joints whose force depends on something that the file does not say."""
        return ()

    @cached_property
    def _connections(self) -> Sequence[Connection]:
        """What joins the links."""
        return self.moving.at(np.zeros(1), 1).connections

    def _require_joints(self, section: str, names: Iterable[str], joints: Iterable[Connection]) -> None:
        """Refuse names of a section that none of some joints has."""
        known = [joint.name for joint in joints]
        for name in names:
            if name not in known:
                has = f"it has {', '.join(known)}" if known else "omit it"
                raise NoSolution(f"this machine has no joint {name!r} there: {has}", key=f"loads.{section}.{name}")

    # Friction that locks

    def raw(self, name: str) -> Any:
        """A quantity, of a joint under its name; None where it needs the forces of a machine that locks itself."""
        joint, dot, quantity = name.partition(".")
        if not dot:
            return self._unless_locked(lambda: super(LoadsDesign, self).raw(name), None)
        found = self.pin(joint.removeprefix("pin_")) if joint.startswith("pin_") else self.mesh(joint)
        return self._unless_locked(lambda: getattr(found, quantity, None), None)

    def check(self, name: str) -> list[Check]:
        """The findings of a check; none where it needs the forces of a machine that locks itself, which one tells."""
        found: list[Check] = self._unless_locked(lambda: super(LoadsDesign, self).check(name), [])
        return found

    def _unless_locked(self, find: Callable[[], Any], otherwise: Any) -> Any:
        if self.section.friction is None:
            return find()
        from gearlink.core.mechanism.friction import SelfLocking

        try:
            return find()
        except SelfLocking:
            return otherwise

    @property
    def locked(self) -> bool:
        """Whether friction locks the machine anywhere."""
        machine = self.machine
        return machine.friction is not None and (machine.locks or self.locks_between)

    @cached_property
    def locks_between(self) -> bool:
        """Whether the machine locks itself at angles between those that are looked at first."""
        from gearlink.core.mechanism.friction import SelfLocking

        try:
            _ = self.torque_range
        except SelfLocking:
            return True
        return False

    # Torque

    def extreme(self, f: Callable[[Reals], Reals], greatest: bool = True) -> Extreme:
        """Maximum or minimum value over the period of a function of the input angle, refined."""
        return self.extremes_of([(f, greatest)])[0]

    def extremes_of(self, wanted: list[tuple[Callable[[Reals], Reals], bool]]) -> list[Extreme]:
        """Maximum or minimum values over the period of functions of the input angle, refined."""
        from gearlink.core.numerics.extremes import extremes_over

        return extremes_over(wanted, 0.0, self.machine.period, **self._looked_at)

    @cached_property
    def _looked_at(self) -> dict[str, Any]:
        """Where searches over the period begin: at a place a degree, at more where there are many breaks."""
        from gearlink.core.studies.loads.panels import fewest_samples

        breaks = self.machine.breaks
        return {"joints": breaks, "samples": 360 * self.turns, "fewest": fewest_samples(breaks)}

    @cached_property
    def _found(self) -> dict[Wanted, Extreme]:
        """Extremes of courses that were asked for."""
        return {}

    def extreme_of(self, course: str, greatest: bool = True) -> Extreme:
        """Maximum or minimum value over the period of a `course`."""
        if (course, greatest) not in self._found:
            self._found[course, greatest] = self.extreme(self.course(course), greatest)
        return self._found[course, greatest]

    def course(self, name: str) -> Callable[[Reals], Reals]:
        """A function of the input angle whose extremes are results: torque, inertia, shaking or a joint's force."""
        if name == "locking":
            return self.machine.passes_ratio
        if name in ("shaking_force", "shaking_moment"):
            part = 0 if name == "shaking_force" else 1
            return lambda phi: abs(self.shaking(phi)[part])
        joint = self.pin(name.removeprefix("pin_")) or self.mesh(name)
        size: Callable[[Reals], Reals] | None = getattr(joint, "size", None)
        if size is not None:
            return size
        return self.machine.torque if name == "torque" else lambda phi: self.machine.reduced(phi).inertia

    def wanted(self, quantity: str) -> Iterable[Wanted]:
        """The extremes that a quantity or a check needs."""
        if quantity == "self-locking":
            return (("locking", True),) if self.machine.friction is not None else ()
        joint, dot, of_joint = quantity.partition(".")
        if joint in self.other_bearings:
            return ()
        if dot:
            pin = self.pin(joint.removeprefix("pin_"))
            known = self.has(joint) if pin is None else pin.known and of_joint != "travel"
            return ((joint, True),) if known else ()
        if quantity in FRAME:
            return ((quantity.removesuffix("_max"), True),)
        if quantity in _OF_TORQUE:
            return ("torque", False), ("torque", True)
        return (("inertia", quantity.endswith("max")),) if quantity.startswith("reflected_inertia_m") else ()

    def decisive(self, command: str) -> Iterable[str]:
        """With what the checks look at of bearings and meshes, so that it is searched together."""
        names, borne = super().decisive(command), self.section.bearings
        return (name for name in names if not name.endswith(".life") or name[:-5].removeprefix("pin_") in borne)

    def prepare(self, quantities: Iterable[str]) -> None:
        """Search extremes together, the links being computed once for all, then reversals of pins, those of meshes."""
        names = tuple(quantities)
        with suppress(GearlinkError):  # it is said where the quantity is asked for
            wanted = dict.fromkeys(key for name in names for key in self.wanted(name) if key not in self._found)
            found = self.extremes_of([(self.course(course), greatest) for course, greatest in wanted])
            self._found.update(zip(wanted, found, strict=True))
        with suppress(GearlinkError):
            self._find_reversals(names)

    def _find_reversals(self, names: tuple[str, ...]) -> None:
        from gearlink.core.studies.loads.joints import find_reversals, find_ways

        asked = [name.partition(".") for name in names]
        held = [joint[4:] for joint, _, name in asked if name in ("equivalent", "travel", "life")]
        pins = [pin for pin in map(self.pin, held) if pin]
        meshes = [self.mesh(joint) for joint, _, name in asked if name == "reversals"]
        changing = self.changing(names)
        found = find_reversals(self.machine, pins, [mesh for mesh in meshes if mesh], tuple(changing.values()))
        keep(self, **dict(zip(changing, found, strict=True)))
        find_ways(self.machine, pins, pressed=any(name in ("equivalent", "life") for _, _, name in asked))

    def changing(self, names: tuple[str, ...]) -> dict[str, tuple[Callable[[Reals], Reals], float]]:
        """Functions whose changes of sign some quantities and checks ask for, with their sizes, by the kept result."""
        return {"torque_changes": (self.machine.torque, self.torque_size)} if "torque_reversals" in names else {}

    @cached_property
    def torque_range(self) -> tuple[Extreme, Extreme]:
        """Minimum and maximum input torque [N m], with their places.

        Where the motion breaks off they are looked for at 1e-12 rad from there: what the torque does on that way is no
        torque.
        """
        low, high = self.extreme_of("torque", False), self.extreme_of("torque")
        size = _BESIDE_BREAK * max(abs(low.value), abs(high.value))
        low, high = (each if abs(each.value) > size else each._replace(value=0.0) for each in (low, high))
        return low, high

    input_torque_max: float = placed("torque_range.1.value")
    input_torque_min: float = placed("torque_range.0.value")

    @property
    def torque_size(self) -> float:
        """Maximum magnitude of the input torque [N m]."""
        return max(abs(self.input_torque_max), abs(self.input_torque_min))

    @property
    def input_torque_max_at(self) -> float:
        """Input angle of the maximum [rad]."""
        return self.torque_range[1].place % self.machine.period

    @property
    def input_torque_min_at(self) -> float:
        """Input angle of the minimum [rad]."""
        return self.torque_range[0].place % self.machine.period

    @cached_property
    def input_torque_mean(self) -> float:
        """Mean input torque [N m]; what is below the rounding of the torque's size is 0."""
        return without_noise(self.machine.mean(self.machine.torque), 16.0 * self.torque_size)

    @cached_property
    def input_torque_rms(self) -> float:
        """Root mean square of the input torque [N m]."""
        return math.sqrt(self.machine.mean(lambda phi: self.machine.torque(phi) ** 2))

    @property
    def input_power_mean(self) -> float:
        """Mean input power [W]."""
        return self.input_torque_mean * self.machine.speed

    @property
    def input_power_peak(self) -> float:
        """Maximum input power [W]."""
        return max(self.input_torque_max * self.machine.speed, self.input_torque_min * self.machine.speed)

    @cached_property
    def torque_changes(self) -> list[float]:
        """Input angles at which the input torque changes its sign [rad]."""
        from gearlink.core.studies.loads.joints import places

        return places(self.machine.torque, self.machine, self.torque_size)

    @property
    def torque_reversals(self) -> int:
        """Changes of sign of the input torque over the period."""
        return len(self.torque_changes)

    reflected_inertia_max: float = at_extreme("inertia")
    reflected_inertia_min: float = at_extreme("inertia", False)

    @property
    def reflected_inertia_mean(self) -> float:
        """Mean reflected inertia over the input angle [kg m^2]."""
        return self.machine.mean(lambda phi: self.machine.reduced(phi).inertia)

    @cached_property
    def energy(self) -> Energy:
        """Energy that flywheel and masses take up at a constant drive torque, the mean of the load."""
        from gearlink.core.studies.loads.flywheel import Energy

        return Energy.of(self.machine)

    @property
    def energy_fluctuation(self) -> float:
        """Maximum less minimum energy surplus over the period [J]; what is below the rounding of its size is 0."""
        return without_noise(self.energy.fluctuation, 16.0 * self.torque_size * self.machine.period)

    @cached_property
    def running(self) -> Running:
        """Flywheel, motor, and the speed over the input angle."""
        from gearlink.core.studies.loads.running import Running

        return Running(self)

    flywheel_inertia: float | None = placed("running.needed")

    @property
    def _run(self) -> Running | None:
        """The run where the file has a flywheel or a motor and the machine does not stop."""
        given = self.section.flywheel is not None or self.section.motor is not None
        return self.running if given and not self.running.stops else None

    speed_min: float | None = placed("_run.range.0")
    speed_max: float | None = placed("_run.range.1")
    speed_fluctuation: float | None = placed("_run.fluctuation")
    motor_torque_rms: float | None = placed("running.motor_rms")
    motor_torque_peak: float | None = placed("running.motor_peak")

    # Shaking force and moment

    shaking_force_max: float = at_extreme("shaking_force")
    shaking_moment_max: float = at_extreme("shaking_moment")

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
        """Maximum shaking force with these counterweights [N]."""
        from gearlink.core.mechanism.dynamics import Mass, shaking

        # On a link that turns about its origin, 1 kg at U mm has the mass moment U, and nothing else in the force.
        weights = {name: Mass(1.0, 0.0, moment) for name, moment in moments.items()}

        def force(phi: Reals) -> Reals:
            added = shaking(self.machine.at(phi), weights, self.speed)[0]
            return np.asarray(np.abs(self.shaking(phi)[0] + added))

        return self.extreme(force).value

    counterweight_crank: float | None = _of_counterweight("crank", abs)
    counterweight_crank_direction: float | None = _of_counterweight("crank", cmath.phase)
    counterweight_rocker: float | None = _of_counterweight("rocker", abs)
    counterweight_rocker_direction: float | None = _of_counterweight("rocker", cmath.phase)

    @cached_property
    def balanced_force_max(self) -> float | None:
        """Maximum shaking force with the counterweights [N]."""
        if not self.balance:
            return None
        return without_noise(self.balanced_force(self.balance), 64.0 * self.shaking_force_max)

    # Tables and checks

    def rows(self, samples: int | None) -> tuple[Reals, dict[str, tuple[Any, str]]]:
        """Input angles [rad] of a table's rows, and its first columns."""
        degrees = turn_degrees(samples, min(self.turns, MOST_TURNS))
        return np.radians(degrees), {"input_angle": (degrees, "deg")}

    @cached_property
    def power_identity(self) -> float:
        """Largest difference of the two input torques over the largest of them, where the search of extremes begins.

        Notes
            Where the parts of the torque cancel to a millionth, as those of an unbalanced wheel that turns evenly, a
            millionth of the parts takes its place: both ways round at 1e-16 of them.
        """
        from gearlink.core.numerics.extremes import places_over

        machine, apart, sizes = self.machine, [0.0], [0.0]
        phi = places_over(0.0, machine.period, **self._looked_at)
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
        from gearlink.core.mechanism.friction import SelfLocking

        if self.locked:
            return self.machine.locking
        try:
            found = self.extreme_of("locking")
        except SelfLocking:
            return float("inf"), None
        return found.value, found.place % self.machine.period

    # What the checks ask

    def limit(self, name: str) -> float:
        """A limit of the file."""
        return float(getattr(self.spec.limits, name))

    @property
    def quiet_zones(self) -> list[tuple[float, float]]:
        """Where the output must stand or run true: first input angle and width of each [rad]."""
        return []

    def is_quiet(self, place: float) -> bool:
        """Whether an input angle lies in one of them."""
        return any((place - start) % self.machine.period <= width for start, width in self.quiet_zones)

    @property
    def transmission_angle(self) -> float | None:
        """Minimum transmission angle over the period [rad], of machines that have one."""
        found: float | None = getattr(getattr(self, "design", None), "min_transmission_angle", None)
        return found

    # Vibration

    @cached_property
    def vibrating(self) -> Vibrating:
        """The output on its spring."""
        from gearlink.core.studies.loads.vibration import Vibrating

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
    speed_words: ClassVar[str] = "1/min"

    @classmethod
    def unit_for(cls, spec: Any, name: str, /) -> str:
        """Places of the output are in mm where it slides, speeds in the unit of the kind's own."""
        if name in _OF_OUTPUT:
            return cls(spec).unit_of(name)
        of_speed = name in ("residual_speed_limit", "lift_off_speed")
        return cls.speed_unit_name if of_speed else super().unit_for(spec, name)

    def unit_of(self, name: str) -> str:
        """Of this design, whose output is known."""
        if name in _OF_OUTPUT:
            return "mm" if self.output in self.sliding else "deg"
        return super().unit_of(name)

    @property
    def _twisting(self) -> Vibrating | None:
        return None if self.section.vibration is None else self.vibrating

    natural_frequency: float | None = placed("_twisting.frequency")
    frequency_ratio: float | None = placed("_twisting.frequency_ratio")
    rise_periods: float | None = placed("_twisting.rise_periods")

    residual_amplitude: float | None = _deflection("residual")
    dwell_twist: float | None = _deflection("twist")
    twisted_ripple: float | None = _deflection("twisted_ripple")

    @property
    def residual_speed_limit(self) -> float | None:
        """Minimum speed at which the amplitude passes what is allowed, in the unit of the kind's own speed."""
        limit = None if self._twisting is None else self._twisting.speed_limit
        return None if limit is None else limit / self.speed_unit

    def harmonic_shares(self, orders: Sequence[int]) -> list[float]:
        """Acceleration of harmonics of the output over that of the greatest.

        Parameters
            orders : ascending - cycles over the period
        Notes
            0 above 10000 a revolution: even where the acceleration jumps, it has fallen below 1e-3 there.
        """
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
        return tuple(each.name for each in self.machine.at(np.zeros(1)).connections)

    def pin(self, name: str) -> Any:
        """Peak, equivalent load and travel of a pin; None where this design has none of the name."""
        return self.pins_found.get(name, None)

    def borne_by(self, name: str) -> Any:
        """What a bearing of the file bears: that of a pin, or of another name where a kind has one."""
        return self.pins_found.get(name)

    @cached_property
    def pins_found(self) -> dict[str, Any]:
        """The pins of this design, by name."""
        from gearlink.core.studies.loads.joints import PinLoad

        bearings = self.section.bearings
        pins = [joint for joint in self._connections if isinstance(joint, Pin)]
        self._require_joints("bearings", [name for name in bearings if name not in self.other_bearings], pins)
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
                message = f"the force on the bearing of {name} depends on the positions of its neighbours"
                raise MissingSection(message, key=f"loads.bearings.{name}", fix=f"give {keys}")

    def mesh(self, name: str) -> Any:
        """Maximum tooth force and reversals of a mesh; None where this design has none of the name."""
        return self.meshes_found.get(name, None)

    @cached_property
    def meshes_found(self) -> dict[str, Any]:
        """The meshes of this design, by name."""
        from gearlink.core.studies.loads.joints import MeshLoad

        if isinstance(self.section.backlash, dict):
            teeth = [joint for joint in self._connections if isinstance(joint, Toothed)]
            self._require_joints("backlash", self.section.backlash, teeth)
        return {name: MeshLoad(self, name) for name in self.meshes if self.has(name)}

    lacking_spring: tuple[str, float] | None = None
    """Of a cam mechanism without a spring: the key and the minimum value that hold the rollers on their cams."""

    def candidates(self, check: str, /) -> Iterable[Remedy]:
        """Remedies from closed forms, the minimum change first."""
        return _FINDERS[check](self) if check in _FINDERS else ()

    table_torque, table_joints = tables.torque, tables.joints
    table_teeth, table_frame, table_speed = tables.teeth, tables.frame, tables.speed
    table_spectrum, table_harmonics = tables.spectrum, tables.harmonics

    check_power_identity, check_load_reversal = checks.power_identity, checks.load_reversal
    check_motor_speed, check_tooth_load = checks.motor_speed, checks.tooth_load
    check_motor_torque, check_speed_fluctuation = checks.motor_torque, checks.speed_fluctuation
    check_bearing_life, check_force_amplification = checks.bearing_life, checks.force_amplification
    check_rigid_model, check_resonance = rigid_model, resonance
    check_residual_vibration = residual_vibration
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


_HOLDS = 0.9
_LIFE_MARGIN = 1.2
_RATIO = 0.45
_MORE = (1.0, 1.1, 1.3, 1.6, 2.0, 3.0)
_STRONGER = (1.25, 1.6, 2.0, 3.0, 5.0)
_SLOWER = (0.9, 0.8, 0.6, 0.4)
_HALVINGS = 12
_USUAL_FLUCTUATION, _USUAL_DAMPING = 0.1, 0.03


def _wider(design: LoadsDesign) -> Iterator[Remedy]:
    """p ~ 1/sqrt(width)"""
    allowed, found = design.section.material.allowed_pressure, design.raw("hertz_pressure_max")
    found = found if isinstance(found, list) else [found]
    if None in found:  # an undercut, which no width repairs
        return
    worst = max(found)
    yield (("loads.roller.width", at_least(design.section.roller.width * (worst / (_HOLDS * allowed)) ** 2)),)


def _stronger_motor(design: LoadsDesign) -> Iterator[Remedy]:
    """Rated and maximum torque for what runs; a motor with another slope gives another peak."""
    motor, margin = design.section.motor, design.limit("torque_margin") / _HOLDS
    needs = {"rated_torque": design.running.motor_rms, "max_torque": abs(design.running.motor_peak or 0.0)}
    for more in _MORE:
        given = {name: (getattr(motor, name), (need or 0.0) * margin * more) for name, need in needs.items()}
        found = {name: at_least(need) for name, (was, need) in given.items() if was is not None and was < need}
        if found:
            yield tuple((f"loads.motor.{name}", value) for name, value in found.items())


def _other_ratio(design: LoadsDesign) -> Iterator[Remedy]:
    """The ratio with which the motor runs the input at the speed of the file."""
    ratio = design.running.ratio_of_speed
    if ratio is None:
        return
    yield from ((("loads.motor.ratio", float(f"{ratio:.{digits}g}")),) for digits in (2, 3))


def _heavier_flywheel(design: LoadsDesign) -> Iterator[Remedy]:
    """The minimum that holds the speed within nine tenths of what is allowed; with a motor it may need more."""
    if design.section.flywheel is None:
        return
    allowed, running = design.section.flywheel.fluctuation, design.running
    share = _HOLDS * allowed if allowed is not None else _USUAL_FLUCTUATION
    needed = design.energy.flywheel_for(share, abs(design.speed), running.motor_inertia)
    yield from ((("loads.flywheel.inertia", at_least(needed * more, 0.01)),) for more in _MORE)


def _better_bearing(design: LoadsDesign) -> Iterator[Remedy]:
    """C ~ L^(1/p), for all bearings that do not last."""
    found = {}
    for name, bearing in design.section.bearings.items():
        pin = design.borne_by(name)
        if pin is not None and pin.life is not None and bearing.life is not None and pin.life < bearing.life:
            rating = bearing.dynamic_rating * (_LIFE_MARGIN * bearing.life / pin.life) ** (1.0 / pin.exponent)
            found[f"loads.bearings.{name}.dynamic_rating"] = at_least(rating, 10.0)
    if found:
        yield tuple(found.items())


def _stiffer(design: LoadsDesign) -> Iterator[Remedy]:
    """A higher natural frequency, by as much as the speed is too high; else a lower speed."""
    vibration, limit = design.section.vibration, design.vibrating.speed_limit
    key, power = ("frequency", 1.0) if vibration.frequency is not None else ("stiffness", 2.0)
    given, ratio = torsional_stiffness(getattr(vibration, key)), abs(design.speed) / limit if limit else 1.1
    for more in (1.02, 1.1, 1.3, 1.6, 2.0, 3.0):
        yield ((f"loads.vibration.{key}", at_least(given * (ratio * more) ** power, 0.1)),)


def slower(design: LoadsDesign) -> Iterator[Remedy]:
    """Less speed, where the file has one."""
    for key in ("loads.speed", "speed", "input_speed"):
        old = number_at(design.spec, key)
        if old is not None:
            yield from (((key, at_most(share * old, 1.0)),) for share in _SLOWER)
            return


def _loaded_one_way(design: LoadsDesign) -> Iterator[Remedy]:
    """More of the constant load that the output has, or less speed."""
    for i, load in enumerate(design.section.forces):
        name = "torque" if isinstance(load.torque, float) else "force" if isinstance(load.force, float) else ""
        if name and load.on == design.output:
            old = getattr(load, name)
            yield from (((f"loads.forces[{i}].{name}", _rounded(old * more)),) for more in _STRONGER)
    yield from slower(design)


def _rounded(value: float) -> float:
    return math.copysign(at_least(abs(value)), value)


def _damped(design: LoadsDesign) -> Iterator[Remedy]:
    if not design.section.vibration.damping:
        yield (("loads.vibration.damping", _USUAL_DAMPING),)


def _less_friction(design: LoadsDesign) -> Iterator[Remedy]:
    """All coefficients in the share with which a pass leaves less than half of a change, by halving."""
    low, high = 0.0, 1.0
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if design.machine.rubbing(middle).locking[0] < _RATIO else (low, middle)
    for less in (1.0, 0.3, 0.1):  # the motor must carry what is left of it
        found = _scaled(design, low * less)
        if found:
            yield found


def _scaled(design: LoadsDesign, share: float) -> Remedy:
    given = design.section.friction
    found = [(f"loads.friction.{name}", getattr(given, name) * share) for name in ("pins", "guides", "contacts")]
    found = [(key, at_most(value, 0.001)) for key, value in found if value]
    if given.meshes < 1.0:
        found.append(("loads.friction.meshes", 1.0 - at_most(share * (1.0 - given.meshes), 0.001)))
    for name, value in given.joints.items():
        less = 1.0 - share * (1.0 - value) if name in design.meshes else share * value
        found.append((f"loads.friction.joints.{name}", less))
    return tuple(found)


def _closed_rollers(design: LoadsDesign) -> Iterator[Remedy]:
    """A stronger spring, or more reserve of a device; else a lower speed."""
    for key, step in (("spring.torque", 1.0), ("spring.preload", 1.0)):
        old = number_at(design.spec, key)
        if old is not None:
            yield from (((key, at_least(old * more, step)),) for more in (1.1, 1.25, 1.5, 2.0, 3.0, 5.0))
    if design.lacking_spring is not None:
        key, least = design.lacking_spring
        yield from (((key, at_least(least * more)),) for more in (1.1, 1.25, 1.5, 2.0, 3.0, 5.0))
    old = number_at(design.spec, "unloader.reserve")
    if old is not None:
        yield from ((("unloader.reserve", at_least(old + more, 0.01)),) for more in (0.1, 0.25, 0.5, 1.0, 2.0))
    yield from slower(design)


_FINDERS: dict[str, Callable[[LoadsDesign], Iterator[Remedy]]] = {
    "contact-pressure": _wider,
    "contact-loss": _closed_rollers,
    "motor-torque": _stronger_motor,
    "motor-speed": _other_ratio,
    "speed-fluctuation": _heavier_flywheel,
    "bearing-life": _better_bearing,
    "residual-vibration": lambda design: iter((*_stiffer(design), *slower(design))),
    "load-reversal": _loaded_one_way,
    "resonance": _damped,
    "self-locking": _less_friction,
}


SLOWED = frozenset(("contact-loss", "residual-vibration", "load-reversal"))
"""Checks that less speed may repair."""
_MOST_REVOLUTIONS = 1000
"""Input turns of a period that loads are computed for at most."""


_BALANCE = "balance these gears (center: [0, 0]), or choose teeth with a common factor"


def is_directed(section: Any, link: str) -> bool:
    """Whether the direction of a link matters: a centre of mass beside its axis, a spring, a force at a point."""
    body = getattr(section.links, link, None)
    joined = {name for spring in section.springs for name in spring.between}
    pushed = {each.on for each in section.forces if each.point is not None}
    return (body is not None and any(body.center or ())) or link in joined | pushed


def homecoming(turns: int, gears: str, key: str, remedy: str = _BALANCE) -> int:
    """So many input turns bring gears home.

    Raises
        NoSolution - for more than are computed
    """
    if turns > _MOST_REVOLUTIONS:
        message = f"{gears} only after {turns} input revolutions (limit <= {_MOST_REVOLUTIONS})"
        raise NoSolution(message, key=key, fix=remedy)
    return turns
