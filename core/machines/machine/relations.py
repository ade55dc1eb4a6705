"""The lines of `require:` read: relations between events on the machine angle, and between a value and its limit."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cache
from typing import ClassVar, Literal, NamedTuple, TypeAlias

from gearlink.core.base.errors import GearlinkError, named

RUNS = ("rise", "return", "dwell")
EXTREMES = ("maximum", "minimum", "velocity_maximum", "velocity_minimum", "acceleration_maximum",
            "acceleration_minimum")  # fmt: skip
VALUES = ("position", "velocity", "acceleration")
_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_PLACE = r"[A-Za-z]\w*(?:\.[A-Za-z]\w*)*(?:\[\d{1,4}\])?(?:_start|_end)?"
_BY = rf"(?:\s+by\s+(?P<by>{_NUMBER})(?:\s*deg)?)?"
_BEFORE = re.compile(rf"(?P<one>{_PLACE}|{_NUMBER})\s+before\s+(?P<two>{_PLACE}|{_NUMBER}){_BY}")
_WITHIN = re.compile(rf"(?P<one>{_PLACE})\s+within\s+(?P<two>{_PLACE}){_BY}")
_VALUE = re.compile(
    rf"(?P<of>[A-Za-z]\w*(?:\.[A-Za-z]\w*)*)\s+at\s+(?P<at>{_PLACE}|{_NUMBER})\s*(?P<side><=|>=)\s*(?P<limit>{_NUMBER})"
)
_NAME = re.compile(r"(?P<of>[A-Za-z]\w*(?:\.[A-Za-z]\w*)*?)\.(?P<what>[a-z_]+)(?:\[(?P<k>\d+)\](?P<end>_start|_end)?)?")
_FORMS = "write EVENT before EVENT by DEG, RUN within RUN by DEG, or MEMBER.velocity at EVENT <= VALUE"


class NotARelation(GearlinkError):
    """A line that is no relation; `code` says whether its form is wrong or a name."""

    def __init__(self, message: str, code: str = "GL108") -> None:
        super().__init__(message)
        self.code = code


class Named(NamedTuple):
    """A run or an event of a member, or one of the file by its name.

    Fields
        of : str - member, or MEMBER.OUTPUT; "" of an event of the file
        what : str - rise, return, dwell, maximum ..., or the event's name
        number : int - the how-manieth, from 1
        end : "start", "end" or "" - of a run; "" the run itself
    """

    of: str
    what: str
    number: int = 1
    end: str = ""

    @property
    def member(self) -> str:
        """The member."""
        return self.of.partition(".")[0]


Moment: TypeAlias = "Named | float"
"""An event, or a machine angle [deg]."""


@dataclass(frozen=True)
class _Pair:
    text: str
    one: Moment
    two: Moment
    by: float
    of_runs: ClassVar[bool] = False

    def with_by(self, by: float) -> str:
        """The line with another angle [deg]."""
        head = self.text.partition(" by ")[0]
        return f"{head} by {by:.12g}" if by else head

    def require_names(self, members: Sequence[str], events: Sequence[str]) -> None:
        """Refuse names that the machine does not have."""
        for moment in (self.one, self.two):
            _require(moment, members, events, runs=self.of_runs)


@dataclass(frozen=True)
class Before(_Pair):
    """One event comes before another by an angle [deg]."""


@dataclass(frozen=True)
class Within(_Pair):
    """One run lies within another, an angle [deg] from either end."""

    one: Named
    two: Named
    of_runs = True


@dataclass(frozen=True)
class Value:
    """A value of a member at a moment stands on one side of a limit."""

    text: str
    of: str
    quantity: Literal["position", "velocity", "acceleration"]
    at: Moment
    side: str
    limit: float

    def require_names(self, members: Sequence[str], events: Sequence[str]) -> None:
        """Refuse names that the machine does not have."""
        _require_member(self.of, members)
        _require(self.at, members, events, runs=False)


Relation: TypeAlias = "Before | Within | Value"


def common_member(relation: Relation) -> str:
    """The member of both runs or events of a relation, "" where two members or the machine angle have a part in it.

    Example
        >>> common_member(parse("feed.rise_end before feed.return_start by 9"))
        'feed'
        >>> common_member(parse("feed.rise_end before 90"))
        ''
    """
    if isinstance(relation, Value):
        return ""
    one, two = relation.one, relation.two
    return one.member if isinstance(one, Named) and isinstance(two, Named) and one.member == two.member else ""


@cache
def parse(text: str) -> Relation:
    """A line of `require`.

    Raises
        NotARelation
    Example
        >>> found = parse("gripper.rise_end before feed.rise_start by 2")
        >>> found.one, found.by
        (Named(of='gripper', what='rise', number=1, end='end'), 2.0)
    """
    line = " ".join(text.split())
    if found := _BEFORE.fullmatch(line):
        return Before(line, _moment(found["one"]), _moment(found["two"]), float(found["by"] or 0.0))
    if found := _WITHIN.fullmatch(line):
        one, two = moment_of(found["one"]), moment_of(found["two"])
        return Within(line, one, two, float(found["by"] or 0.0))
    if found := _VALUE.fullmatch(line):
        of, _, quantity = found["of"].rpartition(".")
        if quantity not in VALUES or not of:
            raise NotARelation(
                f"{named(found['of'])} is not a value of a member\nwrite MEMBER.position, .velocity or .acceleration"
            )
        return Value(line, of, quantity, _moment(found["at"]), found["side"], float(found["limit"]))  # type: ignore[arg-type]
    raise NotARelation(f"{named(text)} is not a relation: {_FORMS}")


def _moment(text: str) -> Moment:
    return float(text) if re.fullmatch(_NUMBER, text) else moment_of(text)


def moment_of(text: str) -> Named:
    """A run or an event by its name.

    Example
        >>> moment_of("feed.dwell[2]_start")
        Named(of='feed', what='dwell', number=2, end='start')
        >>> moment_of("feed.rise_end[3]") == Named("feed", "rise", 3, "end"), moment_of("grip").what
        (True, 'grip')
    """
    found = _NAME.fullmatch(text)
    if found is None:
        head, bracket, rest = text.partition("[")
        number = int(rest.rstrip("]")) if bracket and rest.rstrip("]").isdecimal() else 1
        return Named("", head, number)
    what, end = found["what"], (found["end"] or "").removeprefix("_")
    for tail in ("start", "end"):
        if not end and what.endswith(f"_{tail}"):
            what, end = what.removesuffix(f"_{tail}"), tail
    return Named(found["of"], what, int(found["k"] or 1), end)


def _require(moment: Moment, members: Sequence[str], events: Sequence[str], *, runs: bool) -> None:
    if isinstance(moment, float):
        return
    if not moment.of:
        if moment.what not in events or runs:
            own = ", ".join(events) or "none"
            message = f"no event {named(moment.what)}: those of `events` are {own}; for a member write MEMBER.rise_end"
            raise NotARelation(message, "GL109")
        return
    _require_member(moment.of, members)
    known = RUNS if moment.end or runs else (*EXTREMES, *(f"{run}_{end}" for run in RUNS for end in ("start", "end")))
    if runs and moment.end and moment.what in RUNS:
        run, event = f"{moment.of}.{moment.what}", f"{moment.of}.{moment.what}_{moment.end}"
        raise NotARelation(
            f"{named(event)} is an event, not a run\nwrite {run} within RUN, or {event} before EVENT", "GL109"
        )
    if moment.what not in known or (runs and moment.end):
        near = get_close_matches(moment.what, known, n=1)
        remedy = f"did you mean {near[0]}? " if near else ""
        sort = "run" if runs else "event"
        raise NotARelation(f"no {sort} {named(moment.what)}: {remedy}there are {', '.join(known)}", "GL109")
    if moment.number < 1:
        raise NotARelation("runs and events are counted from [1]")


def _require_member(of: str, members: Sequence[str]) -> None:
    member = of.partition(".")[0]
    if member not in members:
        near = get_close_matches(member, members, n=1)
        remedy = f"did you mean {near[0]}? " if near else ""
        raise NotARelation(f"no member {named(member)}: {remedy}there are {', '.join(members)}", "GL109")
