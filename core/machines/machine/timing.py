"""Runs of the members and events on the machine angle, margins of their relations, and the phases of largest margin.

Angles are in deg here, as files and tables have them, so that what a file gives in whole degrees stays whole.

Free phases are found exactly. With the whole turns of each relation chosen its margins are differences of two phases,
so the greatest least margin is the least mean slack of the circles of relations (R. M. Karp, Discrete Math. 23 (1978)
309); over the whole turns it is periodic event scheduling (P. Serafini, W. Ukovich, SIAM J. Discrete Math. 2 (1989)
550). Relations that tie members together for the first time need no turns; those that close a circle are branched, and
given up where what is known of them leaves no better margin.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from gearlink.core.base.errors import NoSolution, at_key, named
from gearlink.core.base.wording import short
from gearlink.core.machines.machine.relations import (
    EXTREMES,
    RUNS,
    VALUES,
    Before,
    Moment,
    Named,
    NotARelation,
    Relation,
    Value,
    Within,
    moment_of,
)
from gearlink.core.mechanism.motion import TURN, Course
from gearlink.core.numerics.roots import bracketed_root

if TYPE_CHECKING:
    from gearlink.core.machines.machine.series import Members, OnShaft
    from gearlink.core.machines.machine.spec import Event, MachineSpec
    from gearlink.core.numerics.arrays import Reals


_NOTHING = 1e-12  # of the maximum rate: below it is rounding
_SAMPLES, _FEWEST = 720, 33
_ROUND = 1e-9  # deg: events that are nearer to a whole revolution stand upon it
_WORDS = {1: "rise", -1: "return", 0: "dwell"}
_FULL = 360.0
_MOST_KEPT = 1000


class Stretch(NamedTuple):
    """A way over which a function rises (+1), falls (-1) or stands (0), from `start` to `end`."""

    start: float
    end: float
    sense: int


def stretches(rate: Callable[[Reals], Reals], start: float, end: float, joints: Sequence[float]) -> list[Stretch]:
    """Where a function rises, falls and stands over a period, by its rate.

    Parameters
        rate : function of inputs
        joints : places where the rate or its slope may jump
    Returns
        stretches : those of one sense that follow each other are one, across the end of the period too; that which
            crosses it ends beyond it
    Notes
        Between joints the sense is that of samples, each change of it a bracketed root; a rate that is rounding at all
        samples stands.
    """
    bounds = [start, *sorted(each for each in set(joints) if start < each < end), end]
    grids = [_inside(a, b, end - start) for a, b in pairwise(bounds)]
    values = np.split(rate(np.concatenate(grids)), np.cumsum([each.size for each in grids])[:-1])
    nothing = _NOTHING * max(float(np.abs(each).max()) for each in values)
    found: list[Stretch] = []
    for (a, b), grid, seen in zip(pairwise(bounds), grids, values, strict=True):
        found += _between(rate, (a, b), grid, np.where(np.abs(seen) <= nothing, 0.0, seen))
    return _merged(found, start, end)


def _inside(a: float, b: float, whole: float) -> Reals:
    count = max(_FEWEST, math.ceil(_SAMPLES * max(1.0, whole / TURN) * (b - a) / whole))
    return a + (b - a) * (np.arange(count) + 0.5) / count


def _between(rate: Callable[[Reals], Reals], ends: tuple[float, float], grid: Reals, seen: Reals) -> list[Stretch]:
    """Between two joints."""
    moving, signs = np.flatnonzero(seen), np.sign(seen)
    if not moving.size:
        return [Stretch(*ends, 0)]
    cuts, senses = [ends[0]], [int(signs[moving[0]])]
    for i, j in pairwise(moving.tolist()):
        if signs[i] != signs[j]:
            cuts.append(_root(rate, grid[[i, j]], seen[[i, j]]))
            senses.append(int(signs[j]))
    return [Stretch(a, b, sense) for (a, b), sense in zip(pairwise([*cuts, ends[1]]), senses, strict=True)]


def _root(f: Callable[[Reals], Reals], places: Reals, values: Reals) -> float:
    """Where a function changes its sign between two places, or at one, with its values there."""
    low, high = values.tolist()
    return bracketed_root(lambda x: float(f(np.array([x]))[0]), *places.tolist(), ends=(low, high))


def _merged(found: Sequence[Stretch], start: float, end: float) -> list[Stretch]:
    merged: list[Stretch] = []
    for each in found:
        if merged and merged[-1].sense == each.sense:
            merged[-1] = merged[-1]._replace(end=each.end)
        else:
            merged.append(each)
    if len(merged) > 1 and merged[0].sense == merged[-1].sense:
        first = merged.pop(0)
        merged[-1] = merged[-1]._replace(end=first.end + (end - start))
    return merged


class Run(NamedTuple):
    """A rise, return or dwell, angles from the phase of the row on.

    Fields
        name : str - rise, return or dwell, as it goes on the machine
        start, duration : float [deg]
        of, to : float [mm or deg] - the output at both ends
    """

    name: str
    start: float
    duration: float
    of: float
    to: float


class Place(NamedTuple):
    """One output of a member over the machine angle."""

    member: OnShaft
    course: Course


class Timing:
    """Runs and events of all members."""

    def __init__(self, spec: MachineSpec, members: Members) -> None:
        self.spec, self.members = spec, members
        self._runs: dict[Any, list[Run]] = {}
        self._offsets: dict[Any, float] = {}

    @cached_property
    def dial(self) -> float:
        """Machine angle after which everything repeats [deg]."""
        return _FULL * self.members.turns

    def wrap(self, angle: float) -> float:
        """An angle between two events, in (-dial/2, dial/2] [deg]."""
        found = math.fmod(angle, self.dial)
        if abs(abs(found) - 0.5 * self.dial) <= _ROUND:
            return 0.5 * self.dial
        half = 0.5 * self.dial
        return found - self.dial if found > half else found + self.dial if found <= -half else found

    def on_dial(self, angle: float) -> float:
        """A machine angle in [0, dial) [deg]."""
        return _remainder(angle, self.dial)

    # Runs

    def place(self, of: str) -> Place:
        """Member and output of MEMBER or MEMBER.OUTPUT."""
        name, _, output = of.partition(".")
        return Place(self.members[name], self.members[name].course_of(output))

    def runs(self, of: str) -> list[Run]:
        """The runs of an output over the dial, numbered as they stand: by turns of its own from the phase on, within
        one in the order of its own input."""
        member, course = self.place(of)
        known, key = self._runs, (of, member.ratio, self.dial)
        if member.driver is None:
            known = self.members.known[member.name].runs
            key = (of.partition(".")[2], member.ratio, self.dial)
        if key not in known:
            known[key] = (self._of_series if member.driver is not None else self._of_shaft)(member, course)
        return known[key]

    def _of_shaft(self, member: OnShaft, course: Course) -> list[Run]:
        """Of a member on the main shaft: those of its own input, exact at its joints."""
        given, period = member.motion.input, member.period
        assert period is not None
        found = stretches(lambda q: course.rates(member.motion, q, 1)[1], given.start, given.end, given.joints)
        found = _with_standing(found, member, given.start, given.end)
        ratio, width = member.ratio, math.degrees(period)
        first = []
        for a, b, sense in ((math.degrees(each.start), math.degrees(each.end), each.sense) for each in found):
            own = _remainder(a if ratio > 0.0 else b, width)  # where it begins as the machine turns
            after = own if ratio > 0.0 else _remainder(-b, width)
            first.append((own, after / abs(ratio), (b - a) / abs(ratio), sense if ratio > 0.0 else -sense))
        times, turn = round(self.dial * abs(ratio) / width), width / abs(ratio)
        ways = [
            (start + k * turn, duration, sense) for k in range(times) for _, start, duration, sense in sorted(first)
        ]
        return _runs(member, course, ways)

    def _of_series(self, member: OnShaft, course: Course) -> list[Run]:
        """Of a member behind another: over the machine angle, counted from machine angle 0."""
        end, shift = math.radians(self.dial), math.radians(self.phase_of_root(member.name) or 0.0)
        joints = [
            each + k * TURN * member.turns for k in range(self.members.turns // member.turns) for each in member.joints
        ]
        found = stretches(lambda angle: member.rates(angle, 1, course=course)[1], 0.0, end, joints)
        runs = _runs(member, course, [(math.degrees(a), math.degrees(b - a), sense) for a, b, sense in found])
        return sorted(runs, key=lambda run: self.on_dial(run.start + math.degrees(shift)))

    def phase_of_root(self, name: str) -> float | None:
        """The phase of the member on the main shaft that drives a member [deg]; None where it is free."""
        phase = self.spec.members[self.spec.root(name)].phase
        return None if phase == "free" else float(phase)

    def run(self, wanted: Named) -> Run:
        """A run by its name and number.

        Raises
            NoSolution - for a run that the member does not have
        """
        found = [each for each in self.runs(wanted.of) if each.name == wanted.what]
        if wanted.number > len(found):
            have = str(len(found)) if found else ", ".join(self._named_runs(wanted.of))
            message = f"{wanted.of} has no {wanted.what}[{wanted.number}]: it has {have}"
            raise NoSolution(message, fix=self._way_to(wanted, len(found)))
        return found[wanted.number - 1]

    def _way_to(self, wanted: Named, count: int) -> str:
        """The fix for a run that the member does not have; it has so many of this name."""
        if count:
            return f"name one from {wanted.what}[1] to {wanted.what}[{count}]"
        member = wanted.of.partition(".")[0]
        if wanted.what == "dwell" and "dwell_tolerance" in type(self.members[member].design.spec).model_fields:
            return f"give members.{member}.design.dwell_tolerance: then a dwell within this tolerance is found"
        return f"name {' or '.join(self._named_runs(wanted.of))}"

    def _named_runs(self, of: str) -> list[str]:
        return list(dict.fromkeys(each.name for each in self.runs(of)))

    # Events

    def offset(self, moment: Moment) -> tuple[str, float]:
        """A moment as the member on the main shaft that it moves with, "" for none, and the angle from its phase [deg].

        Raises
            NoSolution - for an event that the member does not have
        """
        if isinstance(moment, float):
            return "", moment
        event = None if moment.of else self.spec.events[moment.what]
        member = self.members[moment.member if event is None else event.of.partition(".")[0]]
        known, key = self._offsets, (moment, event, member.ratio, self.dial)
        if member.driver is None:
            known = self.members.known[member.name].offsets
        if key not in known:
            if len(known) >= _MOST_KEPT:  # of events of many machines
                known.clear()
            known[key] = self._offset(moment, event)
        return self.spec.root(member.name), known[key]

    def _offset(self, moment: Named, event: Event | None) -> float:
        """From the phase of the member on the main shaft [deg]."""
        if event is not None:
            with at_key(f"events.{moment.what}"):
                return self._passing(moment.what, event)
        if moment.what in EXTREMES:
            return self._extreme(moment)
        run = self.run(moment)
        return run.start + (run.duration if moment.end == "end" else 0.0)

    def _passing(self, name: str, event: Event) -> float:
        """Where an output passes a value."""
        member, course = self.place(event.of)
        value = math.radians(event.output) if course.unit == "rad" else event.output

        def off(angle: Reals) -> Reals:
            return member.rates(np.radians(angle), 0, course=course)[0] - value

        for run in self._seen(name, event):
            grid = np.linspace(run.start, run.start + run.duration, _FEWEST)
            seen = off(grid)
            if run.name != "dwell" and seen[0] * seen[-1] <= 0.0:
                change = int(np.argmax(np.sign(seen) != np.sign(seen[0])))
                beside = slice(change - 1, change + 1)
                return _root(off, grid[beside], seen[beside]) if seen[0] else run.start
        where = f" in {event.on}" if event.on else ""
        message = f"{event.of} does not pass {event.output:g}{where}: {self._range(event.of)}"
        raise NoSolution(message, key=f"events.{name}.output")

    def _range(self, of: str) -> str:
        ends = [value for run in self.runs(of) for value in (run.of, run.to)]
        return f"it goes from {short(min(ends))} to {short(max(ends))}"

    def _seen(self, name: str, event: Event) -> list[Run]:
        """The runs in which a value is looked for."""
        if event.on is None:
            return self.runs(event.of)
        try:
            wanted = moment_of(f"{event.of}.{event.on}")
        except NotARelation:
            wanted = Named(event.of, event.on)
        if wanted.what not in RUNS[:2] or wanted.end:
            message = f"on is rise, return, rise[2] and so on, not {named(event.on)}"
            raise NoSolution(message, key=f"events.{name}.on")
        with at_key(f"events.{name}.on"):
            return [self.run(wanted)]

    def _extreme(self, moment: Named) -> float:
        """Where an output or a rate of it is largest or minimum, the first of equal places."""
        from gearlink.core.numerics.extremes import extremes_over

        member, course = self.place(moment.of)
        order = 0 if "_" not in moment.what else VALUES.index(moment.what.partition("_")[0])
        greatest = moment.what.endswith("maximum")
        cycle = _FULL * member.turns
        if moment.number > round(self.dial / cycle):
            raise NoSolution(f"{moment.of} has {moment.what} {round(self.dial / cycle)} times in a cycle")
        turn = (moment.number - 1) * cycle
        if order == 0:
            ends = [(value, run.start + i * run.duration) for run in self.runs(moment.of)
                    for i, value in enumerate((run.of, run.to))]  # fmt: skip
            if len({run.name for run in self.runs(moment.of)}) == 1:
                raise NoSolution(f"{moment.of} turns continuously: it has no {moment.what}")
            best = max(value for value, _ in ends) if greatest else min(value for value, _ in ends)
            near = _NOTHING * max(abs(value) for value, _ in ends)
            return min(place % cycle for value, place in ends if abs(value - best) <= near) + turn
        (found,) = extremes_over(
            [(lambda angle: member.rates(angle, order, course=course)[order], greatest)],
            0.0, math.radians(cycle), joints=member.joints, samples=720 * member.turns,
        )  # fmt: skip
        return math.degrees(found.place) + turn

    # Relations

    def angle(self, moment: Moment, phases: Mapping[str, float]) -> float:
        """Machine angle of a moment [deg], in [0, dial)."""
        root, offset = self.offset(moment)
        return self.on_dial(offset + (phases[root] if root else 0.0))

    def margin(self, relation: Relation, phases: Mapping[str, float]) -> float:
        """How far a relation holds [deg, or the value's unit]; below 0 how far it does not.

        Source
            (T1) to (T3): the way from one event to the other, by the shorter way round
        """
        if isinstance(relation, Value):
            found = self.value(relation.of, relation.quantity, self.angle(relation.at, phases), phases)
            return relation.limit - found if relation.side == "<=" else found - relation.limit
        if isinstance(relation, Before):
            return self.wrap(self.angle(relation.two, phases) - self.angle(relation.one, phases)) - relation.by
        before, room = (
            self.wrap(self._start(relation.one, phases) - self._start(relation.two, phases)),
            self.room(relation),
        )
        return min(before, room - before) - relation.by

    def _start(self, run: Named, phases: Mapping[str, float]) -> float:
        return self.angle(run._replace(end="start"), phases)

    def room(self, relation: Within) -> float:
        """What the outer run lasts longer than the inner one [deg]."""
        return self.run(relation.two).duration - self.run(relation.one).duration

    def value(self, of: str, quantity: str, angle: float, phases: Mapping[str, float]) -> float:
        """Position (mm or deg), velocity or acceleration (per rad) of an output at a machine angle [deg]."""
        member, course = self.place(of)
        order = VALUES.index(quantity)
        at = np.radians(np.array([angle - phases[self.spec.root(member.name)]]))
        found = float(member.rates(at, order, course=course)[order][0])
        return math.degrees(found) if course.unit == "rad" and order == 0 else found


def _runs(member: OnShaft, course: Course, ways: Sequence[tuple[float, float, int]]) -> list[Run]:
    """Runs of an output by start, duration and sense."""
    at = np.radians([(start, start + duration) for start, duration, _ in ways])
    values = member.rates(at.ravel(), 0, course=course)[0].reshape(at.shape)
    ends = np.asarray(np.degrees(values) if course.unit == "rad" else values).tolist()
    return [
        Run(_WORDS[sense], start, length, of, to) for (start, length, sense), (of, to) in zip(ways, ends, strict=True)
    ]


def _remainder(angle: float, width: float) -> float:
    """An angle in [0, width); what is a whole number of widths but for rounding is 0."""
    found = math.fmod(angle, width)
    found = found + width if found < 0.0 else found
    return 0.0 if width - found <= _ROUND or found <= _ROUND else found


def _with_standing(found: list[Stretch], member: OnShaft, start: float, end: float) -> list[Stretch]:
    """With the dwell of a design that has one within a tolerance: it stands there, and moves between."""
    names = ("tolerance_dwell_start", "tolerance_dwell_angle")
    design = member.design
    if not set(names) <= set(design.quantity_names()):
        return found
    at, width = (design.raw(name) for name in names)
    if at is None or width is None:
        return found
    period = end - start
    at = start + (float(at) - start) % period
    outside: list[Stretch] = []
    for each in found:  # what lies outside the dwell, the period laid out from its end on
        for shift in (-period, 0.0, period):
            a, b = max(each.start + shift, at + width), min(each.end + shift, at + period)
            if b - a > _NOTHING * period:
                outside.append(Stretch(a, b, each.sense))
    laid = [Stretch(at, at + width, 0), *_joined(sorted(outside))]
    return sorted(
        Stretch(start + (each.start - start) % period, start + (each.start - start) % period + each.end - each.start,
                each.sense)
        for each in laid
    )  # fmt: skip


def _joined(found: Sequence[Stretch]) -> list[Stretch]:
    """Neighbours of one sense as one."""
    joined = [found[0]]
    for each in found[1:]:
        if each.sense == joined[-1].sense and abs(each.start - joined[-1].end) <= _NOTHING * max(1.0, abs(each.end)):
            joined[-1] = joined[-1]._replace(end=each.end)
        else:
            joined.append(each)
    return joined


_NEAR = 1e-10  # deg: less is rounding
_STEPS = 10_000


class Tie(NamedTuple):
    """A way x = p_two - p_one + offset, taken the shorter way round the dial, and the margins that hang on it.

    Fields
        one, two : str - members on the main shaft whose phases are free, "" for all that stands fast
        offset : float [deg]
        least : float [deg] - x - least is a margin
        most : float [deg] - most - x is a margin; infinite where there is none
        text : str - the relation
    """

    one: str
    two: str
    offset: float
    least: float
    most: float
    text: str


class Edge(NamedTuple):
    """p_two - p_one >= weight + share t."""

    one: int
    two: int
    weight: float
    share: int
    text: str


@dataclass(frozen=True)
class Solution:
    """Phases and what limits them.

    Fields
        margin : float [deg] - the minimum of all margins, the maximum there is
        phases, room : by member [deg] - phase, and how wide the interval was in which it was taken
        limiting : texts of the relations that leave no greater margin
    """

    margin: float
    phases: dict[str, float]
    room: dict[str, float]
    limiting: tuple[str, ...]


@dataclass
class _Best:
    margin: float = -math.inf
    edges: list[Edge] = field(default_factory=list)
    circle: tuple[Edge, ...] = ()


def solve(names: Sequence[str], ties: Sequence[Tie], dial: float) -> Solution:
    """The phases of free members.

    Parameters
        names : free members in the order of the file
        ties : of all relations between events, those that no phase changes among them
        dial : float [deg]
    Returns
        solution : margin inf where there is no relation; a phase that is left open is the middle of its interval, 0
            where that is the whole dial
    Example
        >>> ties = [Tie("g", "", -30.0, 2.0, math.inf, "up"), Tie("", "g", 70.0, 2.0, math.inf, "down")]
        >>> found = solve(["g"], ties, 360.0)
        >>> round(found.margin, 9), round(found.phases["g"], 9), found.limiting
        (18.0, -50.0, ('up', 'down'))
    """
    number = {"": 0, **{name: i for i, name in enumerate(names, 1)}}
    first, closing = _ordered(ties, number)
    edges = [edge for tie in first for edge in _edges(tie, number, _turns_of_still(tie, dial), dial)]
    best = _Best()
    _branch(edges, closing, number, dial, math.inf, best)
    phases, room = _middles(names, best, dial) if names else ({}, {})
    texts = dict.fromkeys(edge.text for edge in best.circle if edge.share)
    return Solution(best.margin, phases, room, tuple(texts))


def _ordered(ties: Sequence[Tie], number: dict[str, int]) -> tuple[list[Tie], list[Tie]]:
    """Ties that join what was apart or leave no choice, and those that close a circle."""
    group = list(range(len(number)))
    first, closing = [], []
    for tie in ties:
        one, two = group[number[tie.one]], group[number[tie.two]]
        if one == two and tie.one != tie.two:
            closing.append(tie)
            continue
        first.append(tie)
        group = [one if each == two else each for each in group]
    return first, closing


def _turns_of_still(tie: Tie, dial: float) -> int:
    """Whole turns of a tie between moments that do not move against each other."""
    return -math.ceil(tie.offset / dial - 0.5 - _NEAR) if tie.one == tie.two else 0


def _edges(tie: Tie, number: dict[str, int], turns: int, dial: float) -> list[Edge]:
    """What a tie asks with its whole revolutions: its margins, and x in (-dial/2, dial/2]."""
    one, two, offset = number[tie.one], number[tie.two], tie.offset + turns * dial
    found = [Edge(one, two, tie.least - offset, 1, tie.text)]
    if math.isfinite(tie.most):
        found.append(Edge(two, one, offset - tie.most, 1, tie.text))
    half = 0.5 * dial
    return [*found, Edge(two, one, offset - half, 0, tie.text), Edge(one, two, -half - offset, 0, tie.text)]


def _branch(
    edges: list[Edge], closing: Sequence[Tie], number: dict[str, int], dial: float, most: float, best: _Best
) -> None:
    """Choose the whole revolutions of what closes circles, one after the other, the most promising first."""
    count = len(number)
    margin, circle = _greatest(edges, count, most)
    if not margin > best.margin + _NEAR:
        return
    if not closing:
        best.margin, best.edges, best.circle = margin, edges, circle or _greatest(edges, count, math.inf)[1]
        return
    tie, rest = closing[0], closing[1:]
    found = []
    for turns in _possible(tie, edges, number, dial):
        more = [*edges, *_edges(tie, number, turns, dial)]
        reached, _ = _greatest(more, count, margin)
        if reached > best.margin + _NEAR:
            found.append((-reached, abs(turns), turns, more))
    for reached, _, _, more in sorted(found, key=lambda each: each[:3]):
        _branch(more, rest, number, dial, -reached, best)


def _possible(tie: Tie, edges: Sequence[Edge], number: dict[str, int], dial: float) -> range:
    """Whole turns with which a tie can lie within half a dial, by how far its members can be apart."""
    still = [edge for edge in edges if not edge.share]
    one, two = number[tie.one], number[tie.two]
    low, high = _longest(still, len(number), one)[two], -_longest(still, len(number), two)[one]
    return range(
        math.ceil((-0.5 * dial - tie.offset - high) / dial - _NEAR),
        math.floor((0.5 * dial - tie.offset - low) / dial + _NEAR) + 1,
    )


def _greatest(edges: Sequence[Edge], count: int, most: float) -> tuple[float, tuple[Edge, ...]]:
    """The maximum t at which phases exist, at most `most`, and the circle of edges that allows no more.

    Notes
        A circle that does not close at t closes at -sum(weight)/sum(share), the next t; each is less than the one
        before, and there are finitely many circles. -inf where one does not close at any t.
    """
    t, found = most, tuple[Edge, ...]()
    if math.isinf(t):
        shares = [edge.weight for edge in edges if edge.share]
        if not shares:
            return t, found
        t = 1.0 + sum(abs(edge.weight) for edge in edges)
    for _ in range(_STEPS):
        circle = _open_circle(edges, count, t)
        if circle is None:
            return t, found
        share = sum(edge.share for edge in circle)
        if not share:
            return -math.inf, circle
        t, found = min(t - max(_NEAR, 4.0 * math.ulp(t)), -sum(edge.weight for edge in circle) / share), circle
    raise AssertionError("the circles of the relations do not come to an end")


def _open_circle(edges: Sequence[Edge], count: int, t: float) -> tuple[Edge, ...] | None:
    """A circle whose sum is above 0, by longest ways (R. Bellman, Q. Appl. Math. 16 (1958) 87); None without."""
    far, by = [0.0] * count, list[Edge | None]([None]) * count
    last = None
    for _ in range(count + 1):
        last = None
        for edge in edges:
            reached = far[edge.one] + edge.weight + t * edge.share
            if reached > far[edge.two] + _NEAR:
                far[edge.two], by[edge.two], last = reached, edge, edge
        if last is None:
            return None
    assert last is not None
    at = last.two
    for _ in range(count):
        step = by[at]
        assert step is not None
        at = step.one
    circle: list[Edge] = []
    while not circle or circle[-1].one != circle[0].two:
        step = by[circle[-1].one if circle else at]
        assert step is not None
        circle.append(step)
    return tuple(reversed(circle))


def _longest(edges: Sequence[Edge], count: int, start: int, t: float = 0.0) -> list[float]:
    """Longest ways from a node, -inf where there is none."""
    far = [-math.inf] * count
    far[start] = 0.0
    for _ in range(count):
        changed = False
        for edge in edges:
            reached = far[edge.one] + edge.weight + t * edge.share
            if reached > far[edge.two] + _NEAR:
                far[edge.two], changed = reached, True
        if not changed:
            break
    return far


def _middles(names: Sequence[str], best: _Best, dial: float) -> tuple[dict[str, float], dict[str, float]]:
    """Phases at the maximum margin: each the middle of what those before it in the file leave."""
    edges, count = list(best.edges), len(names) + 1
    t = best.margin if math.isfinite(best.margin) else 0.0
    phases, room = {}, {}
    for i, name in enumerate(names, 1):
        low, high = _longest(edges, count, 0, t)[i], -_longest(edges, count, i, t)[0]
        width = high - low
        if not width < dial - _NEAR:
            phase, width = 0.0, dial
        else:
            phase, width = 0.5 * (low + high), width if width > 1e3 * _NEAR else 0.0
        phases[name], room[name] = phase, width
        edges += [Edge(0, i, phase, 0, ""), Edge(i, 0, -phase, 0, "")]
    return phases, room
