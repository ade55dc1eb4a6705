"""A machine as a design: its timing, what its members do over the machine angle, and its main shaft."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from gearlink.core.base.design import Design, Found, NamesOfFile, Outline, UnknownName, in_unit, placed
from gearlink.core.base.errors import MissingSection, NoSolution, at_key, in_section
from gearlink.core.base.nomenclature import term
from gearlink.core.base.report import Check, Quantity, Remedy, Shown, Status, Table
from gearlink.core.base.results import cached_property
from gearlink.core.base.spec_paths import whole_paths
from gearlink.core.base.wording import short
from gearlink.core.machines.machine import codes
from gearlink.core.machines.machine.codes import NEAR
from gearlink.core.machines.machine.relations import VALUES, Moment, Relation, Value, Within, common_member
from gearlink.core.machines.machine.speeds import own_speeds, wanted_speed

if TYPE_CHECKING:
    from gearlink.core.base.remedies.ways import Way
    from gearlink.core.machines.machine.series import Known, Members, OverMachine
    from gearlink.core.machines.machine.shaft import Chain
    from gearlink.core.machines.machine.spec import MachineSpec
    from gearlink.core.machines.machine.timing import Solution, Tie, Timing
    from gearlink.core.numerics.arrays import Reals

_OF_MEMBER = {"phase": "deg", "phase_room": "deg"}
OWN = (
    "least_margin", "limiting_relations", "cycle_turns", "natural_frequencies", "critical_speeds", "servo_rows",
    "servo_error",
)  # fmt: skip
_OWN_CHECKS = ("timing-relation", "member-speed", "critical-speed")
_SAME_SPEED = 1e-9


class OfMembers(Design):
    """What a machine shares for all its commands: results and findings of its members beside its own.

    `command` is that which is asked of the members.
    """

    kind = "machine"
    spec: MachineSpec
    quantity_names = NamesOfFile()
    advises = False
    command = "analyze"
    before: Mapping[str, Known] = {}  # of the members of a machine that differs in some keys

    @cached_property
    def members(self) -> Members:
        """The members, each behind what drives it."""
        from gearlink.core.machines.machine.series import Members

        return Members(self.spec, self.before, self.warnings)

    def member(self, name: str) -> Design | None:
        """The design of a member that answers the command; None where it does not take it."""
        return self.members[name].design

    @cached_property
    def _answering(self) -> dict[str, Design]:
        """The members that answer the command."""
        found = {name: self.member(name) for name in self.spec.members}
        return {name: design for name, design in found.items() if design is not None}

    @classmethod
    def _classes(cls, spec: MachineSpec) -> dict[str, type[Design]]:
        """The class of each member that answers the command; none of them is made for that."""
        return {name: member.kind.class_for(cls.command, member.spec) for name, member in spec.members.items()}

    @classmethod
    def _shown(cls, spec: MachineSpec) -> tuple[str, ...]:
        """The machine's own quantities, and those of free members."""
        return (*cls.outlines[cls.command].quantities, *(f"{name}.{what}" for name in spec.free for what in _OF_MEMBER))

    @classmethod
    def names_for(cls, spec: Any, /) -> tuple[str, ...]:
        """The machine's quantities, those of free members, and of every member its own as MEMBER.NAME."""
        of_members = (
            f"{name}.{each}"
            for name, own in cls._classes(spec).items()
            for each in own.names_for(spec.members[name].spec)
        )
        return tuple(dict.fromkeys([*cls._shown(spec), *of_members]))

    @cached_property
    def own_names(self) -> tuple[str, ...]:
        """The quantities of this machine."""
        return self.names_for(self.spec)

    @classmethod
    def unit_for(cls, spec: Any, name: str, /) -> str:
        """The unit of a quantity: of a member's own what its kind says."""
        member, _, rest = name.partition(".")
        if name == "servo_error" and cls(spec).rocks:
            return "deg"
        if rest in _OF_MEMBER:
            return _OF_MEMBER[rest]
        own = cls._classes(spec).get(member) if rest else None
        return term(name).unit if own is None else own.unit_for(spec.members[member].spec, rest)

    def outline(self, command: str) -> Outline:
        """With the phases that are found, and the checks of the members."""
        found = super().outline(command)
        return found._replace(quantities=self._shown(self.spec), checks=self.judged(command, self.spec))

    @classmethod
    def _checks_of(cls, own: type[Design], spec: Any) -> tuple[str, ...]:
        """The checks of the command of a member, of a kind that has it by another name those of its first."""
        return own.judged(cls.command if cls.command in own.outlines else next(iter(own.outlines)), spec)

    @classmethod
    def judged(cls, command: str, spec: Any, /) -> tuple[str, ...]:
        """Own checks and those of the members."""
        members = cls._classes(spec).items()
        more = (check for name, own in members for check in cls._checks_of(own, spec.members[name].spec))
        return tuple(dict.fromkeys([*cls.outlines[command].checks, *more]))

    def decisive(self, command: str) -> Iterable[str]:
        """What can say that there is no such machine."""
        return (name for name in type(self).outlines[command].quantities if name not in self.derived)

    def raw(self, name: str) -> Any:
        """A quantity in mm and radians; of a member under its name."""
        member, _, rest = name.partition(".")
        if not rest:
            return super().raw(name)
        if rest in _OF_MEMBER:
            return self.phase_of(member, rest)
        own = self._answering[member]  # where another member refuses, its key stands there
        with in_section(f"members.{member}.design"):
            return own.raw(rest)

    @property
    def rocks(self) -> bool:
        """Whether the output that a drive makes turns."""
        return False

    def phase_of(self, _member: str, _what: str) -> float | None:
        """Phase and its room of a free member [rad]."""
        return None

    def quantity(self, name: str) -> Quantity | None:
        """A quantity in the units of design files; of a member as its own design gives it."""
        member, _, rest = name.partition(".")
        if not rest:
            return super().quantity(name)
        if rest in _OF_MEMBER and member in self.spec.free:
            entry, value = term(rest, self.kind), self.raw(name)
            return Quantity(name, in_unit(value, entry.unit), entry.unit, entry.symbol, entry.words)
        if name not in self.quantity_names():
            raise UnknownName("quantity", name, self.quantity_names())
        own = self._answering[member]
        with in_section(f"members.{member}.design"):
            found = own.quantity(rest)
        return None if found is None else replace(found, name=name)

    def check(self, name: str) -> list[Check]:
        """The findings of a check: the machine's own, then those of the members with their names before them."""
        found = super().check(name) if name in type(self).outlines[self.command].checks else []
        for member, design in self._answering.items():
            if name in self._checks_of(type(design), design.spec):
                found += [of_member(member, design.spec, each) for each in self.found_of(member, design, name)]
        return found

    def found_of(self, member: str, design: Design, check: str) -> list[Check]:
        """The findings of a check of a member."""
        with in_section(f"members.{member}.design"):
            return design.check(check)


def of_member(member: str, spec: Any, found: Check) -> Check:
    """A finding of a member as one of the machine, its keys by their paths in the machine's file."""
    section = f"members.{member}.design"
    remedy = tuple((f"{section}.{key}", value) for key, value in found.remedy)
    advice = whole_paths(found.advice, spec, section)
    return found._replace(what=f"{member}: {found.what}", remedy=remedy, advice=advice)


class Machine(OfMembers):
    """Several mechanisms on one main shaft."""

    keys = {
        "analyze": (
            ("least_margin", ">limits.timing_margin"),
            "limiting_relations",
            "*.phase",
            "*.phase_room",
            "critical_speeds",
            "cycle_turns",
        )
    }
    outlines = {"analyze": Outline(OWN, _OWN_CHECKS, ("timing", "relations", "motion"))}
    extra_tables = ("modes", "servo")
    repaired_where_they_warn = frozenset(("critical-speed",))
    at_once = 64
    requirements = Design.requirements | {"require"}

    def varied(self, spec: Any) -> Machine:
        """The machine of another file, with the members that are as they were."""
        made = type(self)(spec)
        made.before = self.members.known
        return made

    @classmethod
    def find_together(cls, designs: Sequence[Machine], names: Sequence[str]) -> None:
        """Members that differ, by their classes."""
        from gearlink.core.machines.machine.series import find_together

        find_together([design.members for design in designs], names)

    def found_of(self, member: str, design: Design, check: str) -> list[Check]:
        """The findings of a check of a member, known while its own file stays as it is."""
        known = self.members.known[member].findings
        if check not in known:
            known[check] = super().found_of(member, design, check)
        found: list[Check] = known[check]
        return found

    def completion(self) -> Iterator[Found]:
        """The phases that were found, instead of free ones."""
        for name in self.spec.free:
            yield Found(f"members.{name}.phase", self.phases[name], "phase: free")

    @cached_property
    def timing(self) -> Timing:
        """Runs and events of all members."""
        from gearlink.core.machines.machine.timing import Timing

        return Timing(self.spec, self.members)

    def outline(self, command: str) -> Outline:
        """With the shapes of the main shaft where there is one, without relations where there are none."""
        found = super().outline(command)
        tables = tuple(name for name in found.tables if name != "relations" or self.spec.require)
        return found._replace(tables=(*tables, "modes") if self.spec.shaft else tables)

    # Timing

    cycle_turns: int = placed("members.turns")

    def _ties(self, free: Collection[str]) -> list[Tie]:
        """The relations between events as ways between members, some of them with phases that are sought."""
        found = []
        for i, relation in enumerate(self.spec.relations):
            if not isinstance(relation, Value):
                with at_key(f"require[{i}]"):
                    found.append(self._tie(relation, free))
        return found

    def _tie(self, relation: Any, free: Collection[str]) -> Tie:
        from gearlink.core.machines.machine.timing import Tie

        if isinstance(relation, Within):
            inner, outer = (
                self._free_offset(relation.one._replace(end="start"), free),
                self._free_offset(relation.two._replace(end="start"), free),
            )
            most = self.timing.room(relation) - relation.by
            return Tie(outer[0], inner[0], inner[1] - outer[1], relation.by, most, relation.text)
        one, two = self._free_offset(relation.one, free), self._free_offset(relation.two, free)
        return Tie(one[0], two[0], two[1] - one[1], relation.by, math.inf, relation.text)

    def _free_offset(self, moment: Moment, free: Collection[str]) -> tuple[str, float]:
        """A moment by the free member that it moves with, "" for none, and its angle from that phase, or from 0."""
        root, offset = self.timing.offset(moment)
        if root in free:
            return root, offset
        return "", offset + ((self.timing.phase_of_root(root) or 0.0) if root else 0.0)

    @cached_property
    def solution(self) -> Solution:
        """The free phases, and the minimum margin of the relations between events."""
        return self.solved()

    @property
    def driven(self) -> tuple[str, ...]:
        """Members on the main shaft whose phase is given."""
        return tuple(name for name, each in self.spec.members.items() if each.input is None and each.phase != "free")

    @cached_property
    def unbound(self) -> Solution:
        """The maximum margin with every phase free."""
        return self.solved(self.driven)

    def solved(self, also: Sequence[str] = ()) -> Solution:
        """The free phases as if those of other members were free as well."""
        from gearlink.core.machines.machine.timing import solve

        free = (*self.spec.free, *also)
        return solve(free, self._ties(free), self.timing.dial)

    @cached_property
    def phases(self) -> Mapping[str, float]:
        """Phase of every member on the main shaft [deg], free ones as they were found."""
        found = {}
        for name, member in self.spec.members.items():
            if member.input is None:
                free = member.phase == "free"
                found[name] = self.timing.on_dial(self.solution.phases[name]) if free else float(member.phase)
        return found

    def phase_of(self, member: str, what: str) -> float | None:
        return math.radians(self.phases[member] if what == "phase" else self.solution.room[member])

    @cached_property
    def margins(self) -> list[tuple[Relation, float]]:
        """Every relation with its margin [deg, or the value's unit]."""
        found = []
        for i, relation in enumerate(self.spec.relations):
            with at_key(f"require[{i}]"):
                found.append((relation, self.timing.margin(relation, self.phases)))
        return found

    @property
    def least_margin(self) -> float | None:
        """Minimum margin of the relations between events [rad]; None where there are none."""
        found = [margin for relation, margin in self.margins if not isinstance(relation, Value)]
        return math.radians(min(found)) if found else None

    @property
    def limiting_relations(self) -> list[str] | None:
        """The relations that leave free phases no greater margin; None without free phases or relations."""
        return list(self.solution.limiting) or None if self.spec.free else None

    def candidates(self, check: str, /) -> Iterable[Remedy]:
        """Phases with which the relations hold, and relations that ask for less."""
        from gearlink.core.machines.machine.remedies import candidates

        if check == "critical-speed" and self.spec.shaft is not None and self.spec.speed is not None:
            import numpy as np

            from gearlink.core.machines.machine.shaft import stiffened

            return stiffened(self.spec.shaft, np.array([2.0 * math.pi / 60.0 * self.spec.speed]))
        return candidates(self) if check == "timing-relation" else ()

    def ways_of(self, check: str) -> Iterable[Way]:
        """The motions of members whose relations do not hold."""
        from gearlink.core.machines.machine.remedies import ways

        return ways(self) if check == "timing-relation" else ()

    def asks_less(self, keys: Iterable[str]) -> bool:
        """Whether keys say what the machine has to do: its relations, and what is required of members."""
        keys = tuple(keys)
        of_members = (
            self.members[name].design.asks_less(key.removeprefix(f"members.{name}.design.") for key in keys)
            for name in self.spec.members
        )
        return super().asks_less(keys) or any(of_members)

    # A drive instead of a member

    @cached_property
    def follower_motion(self) -> OverMachine:
        """The output of the member of `servo` over the machine angle.

        Raises
            MissingSection, NoSolution - without the section, or for a member that repeats only after several turns
        """
        from gearlink.core.machines.machine.series import OverMachine

        if self.spec.servo is None:
            raise MissingSection("the table of a drive needs servo: {member: feed, rows: 73}", key="servo")
        name = self.spec.servo.member
        member = self.members[name]
        if member.turns > 1:
            message = f"{name} repeats only after {member.turns} turns of the main shaft: a table is that of one"
            raise NoSolution(message, key="servo.member")
        return OverMachine(member, math.radians(self.phases[self.spec.root(name)]))

    @property
    def rocks(self) -> bool:
        """Whether that output turns."""
        return self.spec.servo is not None and self.members[self.spec.servo.member].course.unit == "rad"

    @cached_property
    def servo_rows(self) -> int | None:
        """Rows of the table of a drive, both ends."""
        from gearlink.core.parts.cams.servo import rows_for

        servo = self.spec.servo
        if servo is None or servo.rows is not None:
            return None if servo is None else servo.rows
        return rows_for(self.follower_motion, servo.tolerance or 0.0, rocks=self.rocks)

    @cached_property
    def servo_error(self) -> float | None:
        """Maximum error of its position between them [mm or rad]."""
        from gearlink.core.parts.cams.servo import greatest_error

        return None if self.servo_rows is None else greatest_error(self.follower_motion, self.servo_rows)

    def table_servo(self, _samples: int | None = None) -> Table:
        """The table of a drive instead of the member of `servo`, over the machine angle."""
        from gearlink.core.parts.cams.servo import servo_table

        motion = self.follower_motion
        assert self.servo_rows is not None, "there is a section"
        return servo_table(motion, self.servo_rows, rocks=self.rocks)

    # Main shaft

    @cached_property
    def chain(self) -> Chain:
        """The main shaft.

        Raises
            MissingSection
        """
        from gearlink.core.machines.machine.shaft import Chain

        if self.spec.shaft is None:
            message = (
                "the command needs the main shaft: shaft: {inertias: [0.8, 0.3], stiffnesses: [9000]} (kg m^2, N m/rad)"
            )
            raise MissingSection(message, key="shaft")
        return Chain.of(self.spec.shaft)

    @property
    def natural_frequencies(self) -> list[float] | None:
        """Natural frequencies of the main shaft [Hz]."""
        return None if self.spec.shaft is None else (self.chain.natural / (2.0 * math.pi)).tolist()

    @property
    def critical_speeds(self) -> list[float] | None:
        """Speeds at which the main shaft turns once a period of its own [1/min]."""
        return None if self.spec.shaft is None else (self.chain.natural * 30.0 / math.pi).tolist()

    # Tables

    def table_timing(self, _samples: int | None = None) -> Table:
        """Every run of every member on the machine angle."""
        rows = []
        for name in self.spec.members:
            phase = self.phases[self.spec.root(name)]
            for run in self.timing.runs(name):
                start, end = (self.timing.on_dial(phase + run.start + share * run.duration) for share in (0.0, 1.0))
                rows.append((name, run.name, start, end, run.duration, run.of, run.to))
        columns = ("member", "motion", "start", "end", "duration", "from", "to")
        return Table("timing", columns, ("1", "1", "deg", "deg", "deg", "1", "1"), tuple(zip(*rows, strict=True)))

    def table_relations(self, _samples: int | None = None) -> Table:
        """Every relation with its margin and what comes of it."""
        rows = [(relation.text, margin, self.status_of(relation, margin)) for relation, margin in self.margins]
        data = tuple(zip(*rows, strict=True)) or ((), (), ())
        return Table("relations", ("relation", "margin", "status"), ("1", "1", "1"), data)

    def table_motion(self, samples: int | None = None) -> Table:
        """What every member does over the machine angle."""
        from gearlink.core.numerics.arrays import turn_degrees

        degrees = turn_degrees(samples, self.members.turns)
        columns: dict[str, tuple[Any, str]] = {"machine_angle": (degrees, "deg")}
        for name in self.spec.members:
            columns |= self._motion_of(name, degrees)
        return Table.of("motion", columns)

    def _motion_of(self, name: str, degrees: Reals) -> dict[str, tuple[Any, str]]:
        import numpy as np

        from gearlink.core.mechanism.courses import unit_of

        member = self.members[name]
        turning = member.course.unit == "rad"
        value, first, second = member.rates(np.radians(degrees - self.phases[self.spec.root(name)]), 2)
        unit = member.course.unit
        return {
            f"{name}.position": (np.degrees(value) if turning else value, "deg" if turning else unit),
            f"{name}.velocity": (first, unit_of(unit, 1)),
            f"{name}.acceleration": (second, unit_of(unit, 2)),
        }

    def table_modes(self, _samples: int | None = None) -> Table:
        """Shapes of the main shaft, the last disc 1."""
        self.require_table("modes")
        shapes, shaft = self.chain.shapes, self.spec.shaft
        assert shaft is not None
        names: Any = shaft.discs if shaft.members else list(range(1, self.chain.discs + 1))
        columns: dict[str, tuple[Any, str]] = {"disc": (names, "1")}
        return Table.of("modes", columns | {f"mode_{k + 1}": (shapes[:, k], "1") for k in range(shapes.shape[1])})

    def require_table(self, name: str, /) -> None:
        """The shapes need the main shaft, the table of a drive its section."""
        if name == "modes":
            _ = self.chain
        if name == "servo":
            _ = self.follower_motion

    # Checks

    def status(self, margin: float) -> Status:
        """What comes of a margin."""
        return "fail" if margin < -1e-9 else "warn" if margin < self.spec.limits.timing_margin - 1e-9 else "pass"

    def status_of(self, relation: Relation, margin: float) -> Status:
        """What comes of a relation: a value is judged at 0."""
        return ("pass" if margin >= 0.0 else "fail") if isinstance(relation, Value) else self.status(margin)

    def check_timing_relation(self) -> Iterator[Check]:
        """GL530: each relation."""
        for relation, margin in self.margins:
            of_value = isinstance(relation, Value)
            limit = 0.0 if of_value else self.spec.limits.timing_margin
            status = self.status_of(relation, margin)
            unit = self._unit_of_value(relation) if of_value else "deg"
            what, limiting = f"{relation.text}, margin", self._limiting(relation, status)
            fix, note = "shift a phase that is given" if self.spec.free else "shift a phase, or give phase: free", ""
            if limiting == (relation.text,):
                within = isinstance(relation, Within)
                note = (
                    "no phases give a larger margin: the durations of both motions determine it"
                    if within
                    else "no free phase changes it"
                )
                fix = "change the duration of one of the two motions" if within else fix
            elif limiting:
                note = f"no phases give a larger margin: these relations conflict: {', '.join(limiting)}"
                fix = "relax one of the conflicting relations"
            if own := common_member(relation):
                fix, note = (
                    f"change the motion of {own}",
                    "both events belong to one member: no phase changes the margin",
                )
            yield codes.TIMING.check(status, what, margin, limit, unit, fix=fix, note=note)

    def _unit_of_value(self, relation: Any) -> str:
        from gearlink.core.mechanism.courses import unit_of

        order, unit = VALUES.index(relation.quantity), self.timing.place(relation.of).course.unit
        return "deg" if unit == "rad" and order == 0 else unit_of(unit, order)

    def _limiting(self, relation: Any, status: Status) -> tuple[str, ...]:
        """Relations that limit each other, where one does not hold that is among them."""
        if status != "fail" and not self.spec.free:
            return ()
        limiting = self.unbound.limiting if status == "fail" and self.unbound.margin < 0.0 else self.solution.limiting
        return tuple(limiting) if status != "pass" and relation.text in limiting else ()

    def check_member_speed(self) -> Iterator[Check]:
        """GL531: speeds of members' own files."""
        for name, member in self.spec.members.items():
            given = [each for each in own_speeds(member.spec) if each.speed is not None]
            wanted = wanted_speed(self.spec, name)
            if wanted is None:
                continue
            for each in given:
                off = abs(abs(each.speed or 0.0) / abs(wanted) - 1.0)
                speed = abs(wanted) / each.per
                status: Status = "fail" if off > _SAME_SPEED else "pass"
                unit = "1/min" if each.per == 1.0 else "sheets/h"
                what, shown = f"{name}: {each.key}", Shown(each.value, speed, unit, "")
                aside, fix = "at the speed of the machine", f"remove {each.key} of member {name}"
                aside = aside if status == "fail" else ""
                yield codes.MEMBER_SPEED.check(status, what, off, _SAME_SPEED, shown=shown, fix=fix, aside=aside)

    def check_critical_speed(self) -> Iterator[Check]:
        """GL532 of the first order; with `loads` of every harmonic of the torque."""
        if self.spec.shaft is None or self.spec.speed is None:
            return
        for f in self.critical_speeds or ():
            off = abs(self.spec.speed / f - 1.0)
            status: Status = "warn" if off < NEAR else "pass"
            what, shown = "distance of the speed from a critical speed", Shown(100.0 * off, 100.0 * NEAR, "%", ">=")
            aside, fix = f"critical speed {short(f)} 1/min", "change the speed, or stiffen the main shaft"
            yield codes.CRITICAL_SPEED.check(status, what, off, NEAR, shown=shown, aside=aside, fix=fix)

    def require_named(self) -> None:
        """Refuse what the file names and the machine does not have."""
        _ = self.margins
