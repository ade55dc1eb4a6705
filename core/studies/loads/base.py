"""The section `loads` of a design, the machine under it, and its input torque, which all kinds share."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, Any, ClassVar, TypeAlias

from gearlink.core.base.design import Design, placed
from gearlink.core.base.errors import GearlinkError, MissingSection, NoSolution
from gearlink.core.base.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.base.report import Check
    from gearlink.core.mechanism.dynamics import Mass
    from gearlink.core.mechanism.joints import Connection
    from gearlink.core.mechanism.motion import Motion
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.numerics.extremes import Extreme
    from gearlink.core.studies.loads.flywheel import Energy
    from gearlink.core.studies.loads.machine import Machine
    from gearlink.core.studies.loads.running import Running

RPM = 2.0 * math.pi / 60.0
_SLOWEST = 1e-6
_TURN_COST = 15.0
_OF_TORQUE = frozenset(
    (
        "input_torque_mean", "input_torque_max", "input_torque_max_at", "input_torque_min", "input_torque_min_at",
        "input_power_mean", "input_power_peak", "torque_reversals",
    )
)  # fmt: skip
Wanted: TypeAlias = tuple[str, bool]
"""A course by name, and whether its greatest value is wanted or its least."""


class LoadsBase(Design):
    """The loads of a design file that has the section; a subclass per machine says how its links move.

    `links` names what has a mass, `sliding` those of them that slide, `pins` and `meshes` the joints (those that a
    design does not have are left out where they are asked for).
    """

    joints_of_period: ClassVar[bool] = False
    design: Any
    """The geometry."""
    links: ClassVar[tuple[str, ...]]
    output: ClassVar[str] = "output"
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
        own = type(self).given_speed is not LoadsBase.given_speed or getattr(self.spec, "input_speed", None) is not None
        keys = ("" if own else "speed: 90, ") + f"links: {{{self.links[0]}: {{mass: 2, inertia: 0.01}}}}"
        return self._needs(keys, "kg, kg m^2" if own else "rev/min, kg, kg m^2")

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
            raise MissingSection("`loads` needs the speed of the input: give loads.speed", key="loads.speed")
        if abs(given) < _SLOWEST:
            words = f"{_SLOWEST:g} 1/min or more, or -{_SLOWEST:g} 1/min or less for a turn the other way"
            raise NoSolution(f"no loads of motion at a speed of {given:g} 1/min: give {words}", key="loads.speed")
        return given

    @property
    def own_joints(self) -> list[float]:
        """Input angles [rad] at which the machine's own motion has a jump in its accelerations."""
        return []

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
        """Loads are computed over every turn of the period; with friction they take some twenty times as long."""
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
                "without a mass, an inertia or a force there is no load: give loads.links or loads.forces",
                key="loads.links" if "links" in type(self.section).model_fields else "loads",
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
        from gearlink.core.mechanism.joints import Guide, Pin, Toothed
        from gearlink.core.studies.loads.sources import coefficients_of

        self._require_joints("friction.joints", given.joints, Pin, Guide, *Toothed)
        return coefficients_of(given, self._connections)

    @property
    def unknown_joints(self) -> tuple[str, ...]:
        """Joints whose force depends on something that the file does not say."""
        return ()

    @cached_property
    def _connections(self) -> Sequence[Connection]:
        """What joins the links."""
        import numpy as np

        return self.moving.at(np.zeros(1), 1).connections

    def _require_joints(self, section: str, names: Iterable[str], *sorts: type) -> None:
        """Refuse names of a section that no joint of some sorts in this design has."""
        known = [c.name for c in self._connections if isinstance(c, sorts)]
        for name in names:
            if name not in known:
                has = f"it has {', '.join(known)}" if known else "leave it out"
                raise NoSolution(f"this machine has no joint {name!r} there: {has}", key=f"loads.{section}.{name}")

    # Friction that locks

    def raw(self, name: str) -> Any:
        """A quantity; None where it needs the forces of a machine that locks itself."""
        return self._unless_locked(lambda: super(LoadsBase, self).raw(name), None)

    def check(self, name: str) -> list[Check]:
        """The findings of a check; none where it needs the forces of a machine that locks itself, which one tells."""
        found: list[Check] = self._unless_locked(lambda: super(LoadsBase, self).check(name), [])
        return found

    def _unless_locked(self, find: Callable[[], Any], otherwise: Any) -> Any:
        if self.section.friction is None:
            return find()
        from gearlink.core.mechanism.rubbing import SelfLocking

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
        from gearlink.core.mechanism.rubbing import SelfLocking

        try:
            _ = self.torque_range
        except SelfLocking:
            return True
        return False

    # Torque

    def extreme(self, f: Callable[[Reals], Reals], greatest: bool = True) -> Extreme:
        """Greatest or least value over the period of a function of the input angle, refined."""
        return self._extremes([(f, greatest)])[0]

    def _extremes(self, wanted: list[tuple[Callable[[Reals], Reals], bool]]) -> list[Extreme]:
        from gearlink.core.numerics.extremes import extremes_over
        from gearlink.core.studies.loads.panels import fewest_samples

        machine = self.machine
        samples, fewest = 360 * self.turns, fewest_samples(machine.breaks)
        return extremes_over(wanted, 0.0, machine.period, joints=machine.breaks, samples=samples, fewest=fewest)

    @cached_property
    def _found(self) -> dict[Wanted, Extreme]:
        """Extremes of courses that were asked for."""
        return {}

    def extreme_of(self, course: str, greatest: bool = True) -> Extreme:
        """Greatest or least value over the period of a `course`."""
        if (course, greatest) not in self._found:
            self._found[course, greatest] = self.extreme(self.course(course), greatest)
        return self._found[course, greatest]

    def course(self, name: str) -> Callable[[Reals], Reals]:
        """A function of the input angle whose extremes are results, by name."""
        return self.machine.torque if name == "torque" else lambda phi: self.machine.reduced(phi).inertia

    def wanted(self, quantity: str) -> Iterable[Wanted]:
        """The extremes that a quantity needs."""
        if quantity in _OF_TORQUE:
            return ("torque", False), ("torque", True)
        return (("inertia", quantity.endswith("max")),) if quantity.startswith("reflected_inertia_m") else ()

    def prepare(self, quantities: Iterable[str]) -> None:
        """Search the extremes of these quantities together: the links are computed once for all that looks at them."""
        with suppress(GearlinkError):  # it is said where the quantity is asked for
            wanted = dict.fromkeys(key for name in quantities for key in self.wanted(name) if key not in self._found)
            found = self._extremes([(self.course(course), greatest) for course, greatest in wanted])
            self._found.update(zip(wanted, found, strict=True))

    @cached_property
    def torque_range(self) -> tuple[Extreme, Extreme]:
        """Least and greatest input torque [N m], with their places."""
        return self.extreme_of("torque", False), self.extreme_of("torque")

    input_torque_max: float = placed("torque_range.1.value")
    input_torque_min: float = placed("torque_range.0.value")

    @property
    def torque_size(self) -> float:
        """Greatest magnitude of the input torque [N m]."""
        return max(abs(self.input_torque_max), abs(self.input_torque_min))

    @property
    def input_torque_max_at(self) -> float:
        """Input angle of the greatest [rad]."""
        return self.torque_range[1].place % self.machine.period

    @property
    def input_torque_min_at(self) -> float:
        """Input angle of the least [rad]."""
        return self.torque_range[0].place % self.machine.period

    @cached_property
    def input_torque_mean(self) -> float:
        """Mean input torque [N m]; what is below the rounding of the torque's size is 0."""
        from gearlink.core.base.report import without_noise

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
        """Greatest input power [W]."""
        return max(self.input_torque_max * self.machine.speed, self.input_torque_min * self.machine.speed)

    @cached_property
    def torque_reversals(self) -> int:
        """Changes of sign of the input torque over the period."""
        from gearlink.core.studies.loads.reversals import sign_changes

        return sign_changes(self.machine.torque, self.machine, self.torque_size)

    @property
    def reflected_inertia_max(self) -> float:
        """Greatest reflected inertia [kg m^2]."""
        return self.extreme_of("inertia").value

    @property
    def reflected_inertia_min(self) -> float:
        """Least reflected inertia [kg m^2]."""
        return self.extreme_of("inertia", False).value

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
        """Greatest less least energy surplus over the period [J]; what is below the rounding of its size is 0."""
        from gearlink.core.base.report import without_noise

        return without_noise(self.energy.fluctuation, 16.0 * self.torque_size * self.machine.period)

    @cached_property
    def running(self) -> Running:
        """Flywheel, motor, and the speed over the input angle."""
        from gearlink.core.studies.loads.running import Running

        return Running(self)

    flywheel_inertia: float | None = placed("running.needed")

    def _of_run(self, value: Callable[[], float]) -> float | None:
        """A result of the run, where the file has a flywheel or a motor and the machine does not stop."""
        if self.section.flywheel is None and self.section.motor is None:
            return None
        return None if self.running.stops else value()

    @property
    def speed_min(self) -> float | None:
        """Least speed of the input [1/min]."""
        return self._of_run(lambda: self.running.range[0])

    @property
    def speed_max(self) -> float | None:
        """Greatest speed of the input [1/min]."""
        return self._of_run(lambda: self.running.range[1])

    @property
    def speed_fluctuation(self) -> float | None:
        """(greatest - least)/mean speed."""
        return self._of_run(lambda: self.running.fluctuation)

    motor_torque_rms: float | None = placed("running.motor_rms")
    motor_torque_peak: float | None = placed("running.motor_peak")
