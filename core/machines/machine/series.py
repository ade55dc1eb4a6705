"""What the members of a machine do over the machine angle: the main shaft drives them, or one drives another.

A member's input is u = r (y - p): y the machine angle or the output of its driver, r its ratio, p its phase. Angles and
rates here are counted from the phase of the member on the main shaft with which a row of members begins.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.base.errors import GearlinkError, NoSolution, in_section, named
from gearlink.core.base.many_designs import in_groups
from gearlink.core.base.wording import short
from gearlink.core.mechanism.motion import TURN, Course, Motion
from gearlink.core.mechanism.rates import chained
from gearlink.core.numerics.arrays import Reals, distinct
from gearlink.core.numerics.extremes import extremes_over
from gearlink.core.numerics.roots_sweep import zeros_of

if TYPE_CHECKING:
    from gearlink.core.base.design import Design
    from gearlink.core.machines.machine.spec import MachineSpec, Member

MOST_TURNS = 100
"""Turns of the main shaft after which a machine repeats, at most."""
_LARGEST = 1000
_WHOLE = 1e-9
_AT_JOINT = 1e-11  # rad or mm: an input that is off a joint by the rounding of its phase stands on it
_SCALE = {"rad": math.pi / 180.0, "mm": 1.0}
"""Of the units of design files in those of motions."""


@dataclass(frozen=True, eq=False)
class OnShaft:
    """A member on the main shaft, or behind another member.

    Fields
        design : Design - its own, of `analyze`
        ratio : float - in the units of design files: deg or mm of its input per deg or mm of the driver
        phase : float [deg or mm] - of the driver; of a member on the main shaft 0, as angles count from it
        driver : OnShaft or None - None: the main shaft
        driving : Course or None - the output of the driver
    """

    name: str
    design: Design
    ratio: float
    phase: float = 0.0
    driver: OnShaft | None = None
    driving: Course | None = None

    @cached_property
    def motion(self) -> Motion:
        """Links and joints over its own input."""
        return self.design.moving

    @property
    def course(self) -> Course:
        """Its main output."""
        return self.motion.outputs[0].course

    def course_of(self, output: str) -> Course:
        """An output by its name, in small letters with `_`, or by the first word of it; "" or output: the main one.

        Raises
            NoSolution
        """
        if output in ("", "output"):
            return self.course
        found = {slug(each.name): each.course for each in self.motion.outputs}
        if output in found:
            return found[output]
        alike = [course for name, course in found.items() if name.split("_")[0] == output]
        if len(alike) == 1:
            return alike[0]
        raise NoSolution(f"{self.name} has no output {named(output)}: it has output, {', '.join(found)}")

    @property
    def scale(self) -> float:
        """The unit of its input in design files in that of its motion."""
        return _SCALE[self.motion.input.unit]

    @cached_property
    def period(self) -> float | None:
        """Input after which it repeats [rad]; None of a range."""
        given = self.motion.input
        return None if given.turns is None else given.end - given.start

    @cached_property
    def turns(self) -> int:
        """Turns of the main shaft after which it repeats, with all that drives it.

        Raises
            NoSolution - at its ratio
        """
        with in_section(f"members.{self.name}"):
            if self.driver is None:
                if self.period is None:
                    raise NoSolution(
                        "its input has a range and does not turn", key="input", fix="give it a driver by input"
                    )
                return self._whole(abs(self.ratio) * TURN / self.period)
            gained = gain(self.driver.motion, self._driving) * self._driver_periods
            if abs(gained) < _WHOLE:
                self._require_range()
                return self.driver.turns
            if self.period is None:
                message = "its driver turns continuously, but its input has a range"
                raise NoSolution(message, key="input", fix="use a driver that oscillates")
            return self.driver.turns * self._whole(abs(self._step * gained) / self.period)

    def _require_range(self) -> None:
        """Refuse a driver that swings beyond the range of the input.

        Raises
            NoSolution
        """
        if self.period is None and self.driver is not None:
            end = TURN * self.driver.turns
            joints = self._of_driver(self.driver.turns)

            def own(angle: Reals) -> Reals:
                return self.input(angle, 0)[0]

            found = extremes_over([(own, True), (own, False)], 0.0, end, joints=joints, samples=360)
            self._in_range(np.array([value for value, _ in found]))

    @property
    def _driving(self) -> Course:
        assert self.driving is not None, "needed only of members with a driver"
        return self.driving

    @property
    def _driver_periods(self) -> float:
        """Periods of the driver's own input in the turns after which it repeats, with their sign."""
        assert self.driver is not None
        return self.driver.periods

    @cached_property
    def periods(self) -> float:
        """Periods of its own input in `turns`, with their sign; 0 where it swings."""
        if self.period is None:
            return 0.0
        if self.driver is None:
            return float(round(self.ratio * self.turns * TURN / self.period))
        gained = gain(self.driver.motion, self._driving) * self._driver_periods * self.turns / self.driver.turns
        return float(round(self._step * gained / self.period))

    def _whole(self, share: float) -> int:
        """Turns that make a share of periods a revolution a whole number."""
        found = Fraction(share).limit_denominator(_LARGEST)
        if abs(float(found) - share) > _WHOLE * max(1.0, share):
            message = f"at ratio {self.ratio:.6g} its input never repeats with the machine within {_LARGEST} turns"
            period = "" if self.period is None else f", its own period being {short(math.degrees(self.period))} deg"
            fix = "give a ratio of whole numbers, with all its digits"
            raise NoSolution(f"{message}{period}", key="ratio", fix=fix)
        return found.denominator

    @property
    def _step(self) -> float:
        """Own input per output of the driver, in the units of motions."""
        per = 1.0 if self.driver is None else self.scale / _SCALE[_unit(self._driving)]
        return self.ratio * per

    # Over the machine angle

    def input(self, angle: Reals, order: int = 3, *, side: int = 1) -> list[Reals]:
        """Its input and the derivatives of it over machine angles from the phase of the row on.

        Parameters
            angle : (N,) array [rad]
            side : +1 or -1 - at a joint the rates just after it or just before, as the machine turns
        Returns
            u, u', ... : (N,) arrays [rad or mm, per rad]
        """
        if self.driver is None:
            still = np.zeros_like(angle)
            return [self.ratio * angle, still + self.ratio, still, still][: order + 1]
        value, *rates = self.driver.rates(angle, order, side=side, course=self._driving)
        start = self.phase * _SCALE[_unit(self._driving)]
        return [self._step * (value - start), *(self._step * rate for rate in rates)]

    def rates(self, angle: Reals, order: int = 2, *, side: int = 1, course: Course | None = None) -> list[Reals]:
        """Its output and the derivatives of it by the machine angle, over angles from the phase of the row on.

        Parameters
            angle : (N,) array [rad]
            order : int - 0 to 3
            side : as of `input`
            course : Course - another output than the main one
        Returns
            y, y', ... : (N,) arrays [rad or mm, per rad]
        Raises
            NoSolution - where it does not close, or its input leaves its range
        """
        course = course or self.course
        inner = self.input(angle, max(order, 1), side=side)
        ways = self._ways(inner, side)
        found = [np.empty_like(angle) for _ in range(min(order, self.motion.highest) + 1)]
        with in_section(f"members.{self.name}.design"):
            for way in distinct(ways).tolist():
                rows = ways == way
                outer = self._own(inner[0][rows], order, int(way), course)
                for into, values in zip(found, chained(outer, [each[rows] for each in inner]), strict=True):
                    into[rows] = values
        return found

    def _ways(self, inner: Sequence[Reals], side: int) -> Reals:
        """On which side of its own joints it stands: that to which its input goes, or from which it comes."""
        sense = np.sign(inner[1])
        return np.asarray(side * np.where(sense == 0.0, 1.0, sense))

    def _own(self, u: Reals, order: int, side: int, course: Course) -> list[Reals]:
        q, periods = self.reduced(u)
        found = course.rates(self.motion, q, order, side=side)
        gained = gain(self.motion, course)
        if gained:
            found = [found[0] + gained * periods, *found[1:]]
        return found

    def reduced(self, u: Reals) -> tuple[Reals, Reals]:
        """Its input within one period, that at a joint upon it, and the periods before.

        Raises
            NoSolution - where it leaves the range of the member
        """
        given = self.motion.input
        if self.period is None:
            return self._in_range(u), np.zeros_like(u)
        periods = np.floor((u - given.start + _AT_JOINT) / self.period)
        q = u - periods * self.period
        joints = np.array([given.start, *given.joints, given.end])
        nearest = joints[np.argmin(np.abs(q[:, None] - joints), axis=1)]
        q = np.where(np.abs(q - nearest) <= _AT_JOINT, nearest, q)
        return q, periods

    def _in_range(self, u: Reals) -> Reals:
        given = self.motion.input
        low, high = float(u.min()), float(u.max())
        if low < given.start - _AT_JOINT or high > given.end + _AT_JOINT:
            unit = "mm" if given.unit == "mm" else "deg"
            ends = [each / self.scale for each in (low, high, given.start, given.end)]
            message = "its input goes from {} to {} {unit}, outside its range from {} to {} {unit}"
            words = message.format(*map(short, ends), unit=unit)
            raise NoSolution(words, key="range", fix="change its phase or ratio, or widen range")
        return np.asarray(np.minimum(np.maximum(u, given.start), given.end))

    @cached_property
    def joints(self) -> tuple[float, ...]:
        """Angles from the phase of the row on, over `turns`, at which a rate may jump [rad], ascending."""
        end = TURN * self.turns
        own = (self.motion.input.start, *self.motion.input.joints)
        found = [*self._of_driver(self.turns), *self.places(own, self.period, self.turns)]
        return tuple(sorted({0.0, *(each for each in found if 0.0 <= each < end)}))

    def _of_driver(self, turns: int) -> list[float]:
        """The joints of its driver over some revolutions of the main shaft."""
        if self.driver is None:
            return []
        times = turns // self.driver.turns
        return [each + k * TURN * self.driver.turns for k in range(times) for each in self.driver.joints]

    def places(self, own: Sequence[float], period: float | None, turns: int) -> list[float]:
        """Angles from the phase of the row on, over some turns of the main shaft, at which its input comes to a place.

        Parameters
            own : places of its input, repeated after `period` [rad or mm]; None: over its range
        """
        end = TURN * turns
        if self.driver is None:
            assert period is not None
            times = round(abs(self.ratio) * end / period)
            repeated = [each % period + k * period for k in range(times) for each in own]
            return [each / abs(self.ratio) if self.ratio > 0.0 else end - each / abs(self.ratio) for each in repeated]
        seen = self.input(np.linspace(0.0, end, 360 * turns + 1), 0)[0]
        low, high = float(seen.min()), float(seen.max())
        wanted = list(own)
        if period is not None:
            first, last = (math.floor(each / period) for each in (low, high))
            wanted = [each % period + k * period for k in range(first, last + 1) for each in own]
        reached = [each for each in dict.fromkeys(wanted) if low < each < high]
        courses = [lambda angle, at=at: self.input(angle, 0)[0] - at for at in reached]
        return [each for found in zeros_of(courses, end, turns, jumps=self._of_driver(turns)) for each in found]


def _unit(course: Course) -> str:
    return "rad" if course.unit == "rad" else "mm"


def gain(motion: Motion, course: Course) -> float:
    """What an output gains in a period of the input, 0 where it comes home [rad or mm]; rounding is none."""
    given = motion.input
    if given.turns is None:
        return 0.0
    ends = course.rates(motion, np.array([given.start, given.end]), 0)[0]
    gained = float(ends[1] - ends[0])
    return 0.0 if abs(gained) < _WHOLE * max(1.0, float(np.abs(ends).max())) else gained


def slug(name: str) -> str:
    """The name of an output as a design file has it.

    Example
        >>> slug("Cylinder surface"), slug("Slider F, outwards")
        ('cylinder_surface', 'slider_f_outwards')
    """
    return "_".join("".join(each if each.isalnum() else " " for each in name.lower()).split())


@dataclass(frozen=True)
class OverMachine:
    """The output of a member over the machine angle, as a drive instead makes it.

    Fields
        phase : float [rad] - of its row
    """

    member: OnShaft
    phase: float

    @property
    def joints(self) -> tuple[float, ...]:
        """Machine angles within a revolution at which a rate may jump [rad]."""
        return tuple(sorted((each + self.phase) % TURN for each in self.member.joints))

    def evaluate(self, phi: Reals, order: int = 3, *, side: int = 1) -> list[Reals]:
        """Position and its derivatives by the machine angle [mm or rad, per rad]."""
        return self.member.rates(phi - self.phase, order, side=side)


@dataclass(frozen=True)
class Known:
    """What is known of a member by its own file alone, so that machines that differ elsewhere share it.

    Fields
        given : spec of the member, and the speed that the machine gives it
        design : of the member, at that speed
        findings : by check
        runs, offsets : by output, and by moment, each with ratio and dial
    """

    given: tuple[Any, float | None]
    design: Design
    findings: dict[str, Any] = field(default_factory=dict)
    runs: dict[Any, Any] = field(default_factory=dict)
    offsets: dict[Any, Any] = field(default_factory=dict)


class Members:
    """All members of a machine, each behind what drives it.

    Parameters
        before : by member - what is known of a machine that differs in some keys, or will be when it is computed
        warnings : bool - whether findings of members that can only warn are wanted
    """

    def __init__(self, spec: MachineSpec, before: Mapping[str, Known], warnings: bool = True) -> None:
        self.spec = spec
        self._made: dict[str, OnShaft] = {}
        self._before, self._warnings = before, warnings
        self.known: dict[str, Known] = {}

    def __getitem__(self, name: str) -> OnShaft:
        """A member by name, made when first asked for."""
        if name not in self._made:
            self._made[name] = self._make(name, self.spec.members[name])
        return self._made[name]

    def __iter__(self) -> Any:
        return iter(self.spec.members)

    def _make(self, name: str, member: Member) -> OnShaft:
        with in_section(f"members.{name}.design"):
            design = self.own(name).design
            if not design.moving.outputs:
                raise NoSolution("this design has no motion", key="kind")
        if member.input is None:
            return OnShaft(name, design, member.ratio)
        of, _, output = member.input.partition(".")
        with in_section(f"members.{name}.input"):
            driving = self[of].course_of(output)
        return OnShaft(name, design, member.ratio, float(member.phase), self[of], driving)

    def own(self, name: str) -> Known:
        """A member by itself."""
        from gearlink.core.machines.machine.speeds import at_speed, wanted_speed

        if name not in self.known:
            member, before = self.spec.members[name], self._before.get(name)
            given = member.spec, wanted_speed(self.spec, name)
            if before is None or before.given != given:
                design = member.kind.design("analyze", at_speed(self.spec, name))
                if not self._warnings:
                    design.advises = design.warnings = False
                before = Known(given, design)
            self.known[name] = before
        return self.known[name]

    @cached_property
    def turns(self) -> int:
        """Turns of the main shaft after which all members repeat.

        Raises
            NoSolution - for more than are computed
        """
        found = 1
        for name in self.spec.members:
            found = math.lcm(found, self[name].turns)
            if found > MOST_TURNS:
                message = f"the machine repeats only after {found} turns, more than {MOST_TURNS}"
                raise NoSolution(message, key=f"members.{name}.ratio", fix="use simpler ratios")
        return found


def find_together(machines: Sequence[Members], names: Sequence[str]) -> None:
    """Let members of machines, each once, find together what their classes do.

    Parameters
        names : of quantities and checks that will be asked for
    """
    for name in machines[0]:
        designs = {}
        for members in machines:
            with suppress(GearlinkError):  # it is refused where it is asked for
                design = members.own(name).design
                designs[id(design)] = design
        asked = [each.removeprefix(f"{name}.") for each in names]
        for group in in_groups(list(designs.values()), type):
            type(group[0]).find_together(group, asked)
