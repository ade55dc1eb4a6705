"""Free phases with which the minimum margin of all relations is largest, exact.

With the whole turns of each relation chosen its margins are differences of two phases, so the greatest least margin is
the least mean slack of the circles of relations (R. M. Karp, Discrete Math. 23 (1978) 309); over the whole turns it is
periodic event scheduling (P. Serafini, W. Ukovich, SIAM J. Discrete Math. 2 (1989) 550). Relations that tie members
together for the first time need no turns; those that close a circle are branched, and given up where what is known of
them leaves no better margin.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

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
