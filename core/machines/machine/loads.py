"""The loads of a machine: every member felt at the main shaft, one motor, one flywheel, and the shaft that winds up."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property as kept
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from gearlink.core.base.design import Design, Outline, geometry, placed
from gearlink.core.base.errors import MissingSection, NoSolution, in_section
from gearlink.core.base.report import Check, Quantity, Remedy, Shown, Status, Table, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short
from gearlink.core.machines.machine import codes
from gearlink.core.machines.machine.codes import NEAR
from gearlink.core.machines.machine.design import Machine, OfMembers
from gearlink.core.machines.machine.series import MOST_TURNS, OnShaft
from gearlink.core.machines.machine.speeds import own_speeds
from gearlink.core.mechanism.dynamics import Reduced
from gearlink.core.mechanism.joints import Contact
from gearlink.core.mechanism.motion import TURN, Motion
from gearlink.core.numerics.arrays import Reals, turn_degrees
from gearlink.core.studies.loads.design import SLOWED, LoadsDesign, slower
from gearlink.core.studies.loads.machine import Machine as Loaded
from gearlink.core.studies.loads.names import RUN, TORQUE

if TYPE_CHECKING:
    from gearlink.core.machines.machine.shaft import Swing
    from gearlink.core.machines.machine.spec import MachineSpec, Member

_SHEETS = 60.0
_QUANTITIES = (
    *TORQUE, *RUN, "machine_speed_limit", "speed_limit_member", "speed_limit_check", "natural_frequencies",
    "critical_speeds", "wind_up_max", "wind_up_max_at", "wind_up_disc", "members_without_loads",
)  # fmt: skip
_CHECKS = ("member-speed", "motor-torque", "motor-speed", "speed-fluctuation", "critical-speed", "machine-speed")
_LIMITS = {"lift_off_speed": "lift-off", "residual_speed_limit": "residual-vibration"}
_SMALL, _NEAR_LIMIT = 0.01, 0.9
_SAMPLES = 720


class Limited(NamedTuple):
    """A speed of the main shaft that a member does not bear.

    Fields
        member, check : str - which member, and by which check
        speed : float [1/min]
    """

    member: str
    check: str
    speed: float


@dataclass(frozen=True)
class Felt:
    """A member as the main shaft feels it.

    Fields
        phase : float [rad] - of the row on the main shaft
    """

    place: OnShaft
    phase: float
    loads: LoadsDesign

    @kept
    def machine(self) -> Loaded:
        """Its own machine under its loads."""
        with in_section(f"members.{self.place.name}.design"):
            found = self.loads.machine
            if found.stroke:
                raise NoSolution("these loads cover only a stroke", key="loads", fix="give the whole cycle")
            if found.friction is not None and self.place.driver is not None:
                message = "friction of a member that another member drives depends on its driver"
                raise NoSolution(message, key="loads.friction", fix="omit it")
            return found

    @kept
    def backwards(self) -> Loaded:
        """The same turning the other way, in which resistances act the other way."""
        return replace(self.machine, speed=-self.machine.speed)

    @property
    def period(self) -> float | None:
        """Input after which its loads repeat [rad]; None over a range."""
        return None if self.place.period is None else self.machine.period

    @property
    def turns(self) -> int:
        """Turns of the main shaft after which its loads repeat."""
        if self.period is None or self.place.period is None:
            return self.place.turns
        periods = abs(self.place.periods)  # motion periods in the turns of the motion
        times = round(self.period / self.place.period)
        return self.place.turns * (times // math.gcd(times, round(periods)) if periods else 1)

    def breaks(self, turns: int) -> list[float]:
        """Machine angles over some revolutions at which a force jumps or bends [rad]."""
        times, end = turns // self.place.turns, TURN * turns
        found = [each + k * TURN * self.place.turns for k in range(times) for each in self.place.joints]
        with in_section(f"members.{self.place.name}.design"):
            own = self.machine.breaks
        found += self.place.places([0.0, *own], self.period, turns)
        return [(each + self.phase) % end for each in found]

    def input(self, angle: Reals) -> list[Reals]:
        """Its input and two derivatives at machine angles, the input within a period."""
        u, first, second = self.place.input(angle - self.phase, 2)
        return [u if self.period is None else np.mod(u, self.period), first, second]

    def reduced(self, angle: Reals) -> Reduced:
        """Inertia and load on the main shaft at machine angles.

        J = u'^2 J_m,  J' = 2 u' u'' J_m + u'^3 J_m',  Q = u' Q_m

        Source
            virtual power, (Y1)
        """
        u, first, second = self.input(angle)
        inertia, slope, weight, static = np.zeros((4, angle.size))
        forth = np.ones(angle.size, dtype=bool) if self.place.driver is None else first >= 0.0
        for rows, machine in ((forth, "machine"), (~forth, "backwards")):
            if rows.any():
                loaded: Loaded = getattr(self, machine)
                with in_section(f"members.{self.place.name}.design"):
                    own = loaded.reduced(u[rows])
                    static[rows] = loaded.load_torque(u[rows])
                inertia[rows], slope[rows], weight[rows] = own.inertia, own.slope, own.weight
        return Reduced(
            first**2 * inertia,
            2.0 * first * second * inertia + first**3 * slope,
            first * weight,
            -first * (static + weight),
        )

    def lift_off(self) -> float | None:
        """Speed of the main shaft at which a contact that something presses is lost [rad/s], by its own u', u''.

        N = N_0 + W^2 N_1, lost where it comes to 0; None where none is pressed or lost

        Source
            own derivation: the equations of Newton and Euler are linear in W^2
        """
        angle = np.linspace(0.0, TURN * self.turns, _SAMPLES * self.turns, endpoint=False)
        u, first, second = self.input(angle)
        with in_section(f"members.{self.place.name}.design"):
            rest, swung = self.machine.parted(u, first, second)
        found = []
        for each in rest.mechanism.connections:
            if not isinstance(each, Contact) or each.back is not None:
                continue
            still, moving = (part.unknowns[each.name][0] for part in (rest, swung))
            lost = moving < -1e-12 * np.abs(moving).max()
            if lost.any():
                found.append(float(np.sqrt(np.maximum(still[lost], 0.0) / -moving[lost]).min()))
        return min(found) if found else None


def _no_links(_q: Reals, _order: int, _side: int) -> Any:
    raise AssertionError("a machine has only the links of its members")


@dataclass(frozen=True)
class Together(Loaded):
    """All members on the main shaft, as the loads of a machine.

    Fields
        felt : Felt of every member with loads
    """

    felt: Sequence[Felt] = ()

    def _reduced(self, phi: Reals) -> Reduced:
        found = Reduced(*np.zeros((4, phi.size)))
        for each in self.felt:
            own = each.reduced(phi)
            for name in ("inertia", "slope", "weight", "applied"):
                getattr(found, name)[:] += getattr(own, name)
        return found

    def _given_breaks(self) -> list[float]:
        """Those of the members."""
        return [angle for each in self.felt for angle in each.breaks(self.turns)]

    def _turning_back(self) -> list[float]:
        """None besides those of the members."""
        return []


class _Section:
    """The section `loads` of a machine: its keys, and None for those that members have alone."""

    friction = vibration = backlash = None

    def __init__(self, given: Any) -> None:
        self.flywheel = None if given is None else given.flywheel
        self.motor = None if given is None else given.motor


def has_loads(member: Member) -> bool:
    """Whether a member has the section."""
    return "loads" in member.kind.commands and getattr(member.spec, "loads", None) is not None


class MachineLoads(OfMembers, LoadsDesign):
    """Torques of all members on the main shaft; input angle: the machine angle."""

    spec: MachineSpec
    command = "loads"
    outlines = {"loads": Outline(_QUANTITIES, _CHECKS, ("torque", "wind_up"))}
    extra_tables = ("speed", "resonances", "speed_limits", "wind_up_course")
    links, pins, meshes = (), (), ()
    derived = frozenset(_QUANTITIES[len(TORQUE) :])
    repaired_where_they_warn = frozenset(("critical-speed",))
    design: cached_property[Machine] = geometry(Machine)

    def varied(self, spec: Any) -> MachineLoads:
        """The loads of another file, with the members, and their loads, that are as they were."""
        made = type(self)(spec)
        made.design = self.design.varied(spec)
        return made

    @property
    def members(self) -> Any:
        """Those of the design."""
        return self.design.members

    @classmethod
    def _classes(cls, spec: MachineSpec) -> dict[str, type[Design]]:
        """Those of members on the main shaft that have loads."""
        having = {name: member for name, member in spec.members.items() if has_loads(member) and member.input is None}
        return {name: member.kind.class_for("loads", member.spec) for name, member in having.items()}

    def member(self, name: str) -> Design | None:
        """The loads of a member on the main shaft; None of one behind another, whose speed is not even."""
        return self._loads.get(name) if self.spec.members[name].input is None else None

    @cached_property
    def _loads(self) -> dict[str, LoadsDesign]:
        """The loads of every member that has some.

        Raises
            MissingSection - where none has
        """
        found: dict[str, LoadsDesign] = {}
        for name, member in self.spec.members.items():
            if has_loads(member):
                with in_section(f"members.{name}.design"):
                    found[name] = self._made(name)
                    self._refuse_drives(found[name])
        if not found:
            raise MissingSection("no member has loads", key="members", fix="give one of them the section loads")
        return found

    def _refuse_drives(self, made: LoadsDesign) -> None:
        for key in ("motor", "flywheel"):
            if getattr(made.section, key, None) is not None:
                message = f"the machine has one {key}"
                raise NoSolution(
                    message, key=f"loads.{key}", fix="give it in loads of the machine, not in those of a member"
                )

    def _made(self, name: str) -> LoadsDesign:
        """The loads of a member; one behind another is made at the machine's speed, and moved by its driver."""
        member = self.spec.members[name]
        if member.input is None:
            shared: LoadsDesign = self.members.own(name).design.of_command("loads")  # on that of its motion
            return shared
        given = own_speeds(member.spec)
        spec = member.changed([(each.key, abs(self.given_speed) / each.per) for each in given[-1:]])
        return member.kind.design("loads", spec)  # type: ignore[return-value]

    def phase_of(self, member: str, what: str) -> float | None:
        return self.design.phase_of(member, what)

    def candidates(self, check: str, /) -> Iterable[Remedy]:
        """Of its own checks as of any loads; a finding of a member may have less speed of the machine."""
        if check == "critical-speed" and self.spec.shaft is not None:
            from gearlink.core.machines.machine.shaft import stiffened

            return stiffened(self.spec.shaft, TURN / _SHEETS * self.given_speed * self._strong[0])
        if check in _CHECKS:
            return super().candidates(check)
        return slower(self) if check in SLOWED else ()

    @property
    def members_without_loads(self) -> list[str] | None:
        """Members that add nothing, since they have no loads."""
        return [name for name in self.spec.members if name not in self._loads] or None

    # What the loads of any machine ask

    @cached_property
    def section(self) -> Any:
        """Motor and flywheel."""
        return _Section(self.spec.loads)

    @property
    def given_speed(self) -> float:
        """Speed of the main shaft [1/min]."""
        if self.spec.speed is None:
            raise MissingSection("`loads` needs the speed of the main shaft", key="speed", fix="give speed (1/min)")
        return self.spec.speed

    @property
    def friction(self) -> None:
        """That of the members is in their torques."""
        return

    @cached_property
    def felt(self) -> dict[str, Felt]:
        """The members with loads as the main shaft feels them."""
        phases = self.design.phases
        return {
            name: Felt(self.members[name], math.radians(phases[self.spec.root(name)]), loads)
            for name, loads in self._loads.items()
        }

    @cached_property
    def turns(self) -> int:
        """Turns of the main shaft after which everything repeats."""
        found = math.lcm(self.members.turns, *(each.turns for each in self.felt.values()))
        if found > MOST_TURNS:
            message = f"the loads repeat only after {found} turns, more than {MOST_TURNS}"
            raise NoSolution(message, key="members", fix="use simpler ratios")
        return found

    @cached_property
    def machine(self) -> Together:
        """All members together."""
        felt = tuple(self.felt.values())
        return Together(Motion(_no_links), {}, None, 0j, self.speed, self.turns, felt=felt)  # type: ignore[arg-type]

    @property
    def cost(self) -> float:
        """As much as all members."""
        return sum(each.cost for each in self._loads.values())

    pins_found = meshes_found = property(lambda _self: dict[str, Any](), doc="None of the machine's own.")

    def has(self, _name: str) -> bool:
        """It has no joints of its own."""
        return False

    # Speeds that the members bear

    @cached_property
    def limits(self) -> list[Limited]:
        """Speeds of the main shaft that members do not bear, the minimum first."""
        found: list[Limited] = []
        for name in self.spec.members:
            found += self._limits_of(name) if self.spec.members[name].input is None else self._limits_behind(name)
        return sorted(found, key=lambda each: each.speed)

    def _limits_of(self, name: str) -> Iterator[Limited]:
        """Of a member on the main shaft: those of its own design over its ratio."""
        own, ratio = self.members[name].design, abs(self.spec.members[name].ratio)
        for quantity, check in _LIMITS.items():
            design: Any = self._loads.get(name) or own
            design = design if quantity in design.quantity_names() else own
            if quantity not in design.quantity_names():
                continue
            with in_section(f"members.{name}.design"):
                value: Quantity | None = design.quantity(quantity)
            if value is not None and isinstance(value.value, (int, float)) and math.isfinite(value.value):
                per = _SHEETS if value.unit == "sheets/h" else 1.0
                yield Limited(name, check, value.value / per / ratio)

    def _limits_behind(self, name: str) -> Iterator[Limited]:
        """Of a member behind another whose cam something presses: by the rates of its own input."""
        felt, own = self.felt.get(name), self.members[name].design
        if felt is None or "lift_off_speed" not in own.quantity_names() or own.raw("lift_off_speed") is None:
            return
        speed = felt.lift_off()
        if speed is not None:
            yield Limited(name, "lift-off", speed * 30.0 / math.pi)

    @property
    def _least(self) -> Limited | None:
        """The minimum of those speeds."""
        return self.limits[0] if self.limits else None

    machine_speed_limit: float | None = placed("_least.speed")
    speed_limit_member: str | None = placed("_least.member")
    speed_limit_check: str | None = placed("_least.check")

    # The main shaft

    natural_frequencies: list[float] | None = placed("design.natural_frequencies")
    critical_speeds: list[float] | None = placed("design.critical_speeds")

    @property
    def discs(self) -> list[str]:
        """Names of the discs of the main shaft."""
        shaft = self.spec.shaft
        assert shaft is not None, "needed only with a main shaft"
        return shaft.discs

    def disc_of(self, name: str) -> int:
        """The disc on which a member acts: that with its name or its driver's; else the first."""
        shaft, root = self.spec.shaft, self.spec.root(name)
        assert shaft is not None, "needed only with a main shaft"
        return next((i for i, names in enumerate(shaft.acting) if root in names), 0)

    @cached_property
    def swing(self) -> Swing:
        """The steady swing of the main shaft under the members' torques.

        Raises
            MissingSection - without a main shaft
        """
        from gearlink.core.machines.machine.shaft import Swing

        chain, count = self.design.chain, _SAMPLES * self.turns
        angle: Reals = np.arange(count, dtype=np.float64) * (TURN * self.turns / count)
        torques = np.zeros((chain.discs, count))
        for name, each in self.felt.items():
            torques[self.disc_of(name)] -= each.reduced(angle).torque(self.speed)
        return Swing(chain, torques, self.turns, self.speed)

    @cached_property
    def _most_wound(self) -> tuple[float, float, str] | None:
        """Maximum wind-up against the first disc [rad], a magnitude, machine angle of its row [rad], and disc."""
        if self.spec.shaft is None:
            return None
        twist = np.abs(self.swing.twist)
        disc, row = np.unravel_index(np.argmax(twist), twist.shape)
        return float(twist[disc, row]), TURN * int(row) / _SAMPLES, self.discs[disc]

    wind_up_max: float | None = placed("_most_wound.0")
    wind_up_max_at: float | None = placed("_most_wound.1")
    wind_up_disc: str | None = placed("_most_wound.2")

    # Tables

    def outline(self, command: str) -> Outline:
        """Without the wind-up where no main shaft is given."""
        found = super().outline(command)
        return found if self.spec.shaft else found._replace(tables=tuple(t for t in found.tables if t != "wind_up"))

    def require_table(self, name: str, /) -> None:
        """Those of the main shaft need it."""
        if name in ("wind_up", "wind_up_course", "resonances"):
            _ = self.design.chain

    def table_torque(self, samples: int | None = None) -> Table:
        """Torque on the main shaft and each member's share."""
        phi, columns = self.rows(samples)
        columns["input_torque"] = self.machine.torque(phi), "N m"
        for name, each in self.felt.items():
            columns[f"{name}.torque"] = each.reduced(phi).torque(self.speed), "N m"
        return Table.of("torque", columns)

    def table_speed_limits(self, _samples: int | None = None) -> Table:
        """Speeds of the main shaft that members do not bear, the minimum first."""
        data = tuple(zip(*self.limits, strict=True)) or ((), (), ())
        return Table("speed_limits", ("member", "check", "speed"), ("1", "1", "1/min"), data)

    def table_resonances(self, _samples: int | None = None) -> Table:
        """Speeds at which a harmonic of the members' torque meets a natural frequency, by order."""
        rows = []
        whole = np.abs(self.swing.amplitudes.sum(axis=0))
        for k in range(1, min(len(self.swing.orders), 40 * self.turns + 1)):
            for mode, frequency in enumerate(self.natural_frequencies or (), 1):
                rows.append((float(self.swing.orders[k]), mode, _SHEETS * frequency / float(self.swing.orders[k]),
                             float(whole[k])))  # fmt: skip
        columns = ("harmonic", "mode", "speed", "torque")
        return Table("resonances", columns, ("1", "1", "1/min", "N m"), tuple(zip(*rows, strict=True)))

    def table_wind_up(self, _samples: int | None = None) -> Table:
        """Wind-up at each member against the first disc, and what it costs at the member's own output.

        Notes
            y'(theta) times the wind-up: maximum over the cycle, and where `register.at` stands at that angle.
        """
        self.require_table("wind_up")
        rows = []
        count = self.swing.twist.shape[1]
        angle = np.arange(count) * (TURN * self.turns / count)
        for name in self.spec.members:
            twist, member = self.swing.twist[self.disc_of(name)], self.members[name]
            lost = member.rates(angle - math.radians(self.design.phases[self.spec.root(name)]), 1)[1] * twist
            unit, scale = ("deg", 180.0 / math.pi) if member.course.unit == "rad" else ("mm", 1.0)
            degrees = np.degrees(twist)
            rows.append((name, self.discs[self.disc_of(name)], float(degrees.mean()), float(degrees.max()),
                         float(degrees.min()), scale * float(np.abs(lost).max()), self._at_print(angle, lost, scale),
                         unit))  # fmt: skip
        columns = ("member", "disc", "mean", "max", "min", "output_error", "output_error_at_print", "output_unit")
        units = ("1", "1", "deg", "deg", "deg", "1", "1", "1")
        return Table("wind_up", columns, units, tuple(zip(*rows, strict=True)))

    def _at_print(self, angle: Reals, lost: Reals, scale: float) -> float | None:
        section = self.spec.register_
        return None if section is None else scale * self._between(angle, lost, section.at)

    def _between(self, angle: Reals, course: Reals, at: float) -> float:
        """A course over the rows at a machine angle [deg] between them."""
        end = TURN * self.turns
        return float(np.interp(math.radians(at) % end, np.append(angle, end), np.append(course, course[0])))

    def twist_at(self, name: str, at: float) -> float:
        """Wind-up of the disc of a member against the first at a machine angle [deg]; [rad]."""
        count = self.swing.twist.shape[1]
        angle: Reals = np.arange(count, dtype=np.float64) * (TURN * self.turns / count)
        return self._between(angle, self.swing.twist[self.disc_of(name)], at)

    def table_wind_up_course(self, samples: int | None = None) -> Table:
        """Wind-up of every disc against the first over the machine angle."""
        self.require_table("wind_up_course")
        degrees = turn_degrees(samples, self.turns)
        twist = np.degrees(self.swing.twist)
        at = np.linspace(0.0, 360.0 * self.turns, twist.shape[1] + 1)
        columns: dict[str, tuple[Any, str]] = {"input_angle": (degrees, "deg")}
        for disc, course in zip(self.discs, twist, strict=True):
            columns[disc] = np.interp(degrees, at, np.append(course, course[0])), "deg"
        return Table.of("wind_up_course", columns)

    # Checks

    def check_member_speed(self) -> Iterator[Check]:
        """GL531."""
        return self.design.check_member_speed()

    def check_critical_speed(self) -> Iterator[Check]:
        """GL532: harmonics of the members' torque near a natural frequency."""
        if self.spec.shaft is None:
            return
        orders, whole = self._strong
        for mode, frequency in enumerate(self.natural_frequencies or (), 1):
            off = np.abs(orders * self.given_speed / (_SHEETS * frequency) - 1.0)
            near = np.flatnonzero(off < NEAR)
            what = f"distance of mode {mode} of the main shaft ({short(frequency)} Hz) from harmonics of the torque"
            if not near.size:
                value = float(off.min()) if off.size else None
                shown = Shown(None if value is None else 100.0 * value, 100.0 * NEAR, "%")
                yield codes.CRITICAL_SPEED.check("pass", what, value, NEAR, side=">=", shown=shown)
                continue
            k = int(near[np.argmax(whole[near])])
            shown, value = Shown(100.0 * float(off[k]), 100.0 * NEAR, "%"), float(off[k])
            aside = f"harmonic {orders[k]:g}, {short(float(whole[k]))} N m"
            at = f"{short(float(_SHEETS * frequency / orders[k]))} 1/min"
            fix = "change the speed, or stiffen the shaft"
            yield codes.CRITICAL_SPEED.check(
                "warn", what, value, NEAR, side=">=", shown=shown, aside=aside, at=at, fix=fix
            )

    @property
    def _strong(self) -> tuple[Reals, Reals]:
        """Orders of the harmonics of the members' torque that have more than a hundredth of the largest [N m]."""
        whole = np.abs(self.swing.amplitudes.sum(axis=0))[1:]
        strong = whole > _SMALL * float(whole.max())
        return self.swing.orders[1:][strong], whole[strong]

    def check_machine_speed(self) -> Iterator[Check]:
        """GL533: the machine's speed against what its members bear."""
        if not self.limits:
            return
        first = self.limits[0]
        speed, most = self.given_speed, _NEAR_LIMIT * first.speed
        status: Status = "fail" if speed > first.speed else "warn" if speed > most else "pass"
        what, aside = "speed of the main shaft", f"{first.member}, {first.check}"
        fix = f"set speed to at most {safely_below(most)} 1/min"
        yield codes.MACHINE_SPEED.check(
            status, what, speed, first.speed, "1/min", side="<=", recommended=most, aside=aside, fix=fix
        )
