"""A part as it goes into a file: its stretches sampled, unfolded over the teeth, joined without gaps."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np

from gearlink.cli.export.options import CurveForm
from gearlink.cli.export.sampling import (
    MOST_POINTS,
    Points,
    Reals,
    Sampled,
    Stretch,
    TooFine,
    sample,
)

# Ends of stretches that lie nearer to each other [mm] are one vertex; the gap counts as error.
JOIN = 1e-6


@dataclass(frozen=True)
class Circle:
    """A circle about the part's origin or another point."""

    layer: str
    radius: float
    center: complex = 0j


@dataclass(frozen=True)
class Part:
    """What is to be drawn of one cam or gear; the axis is the origin of its frame.

    Parameters
        name : str - as in --part
        title : str - in words
        stretches : in their order along the curves; a curve ends where the next stretch lacks its layer
        closed : bool - the last stretch ends where the first begins
        teeth : int - above 0: the stretches run from the middle of a tooth space on the x axis to the middle of
            the next tooth, and the rest of the gear is made of their mirror images and turns
        circles : construction circles
        notes : sentences for whoever uses the file
        findings : what makes the profile unfit for use
        extra_columns : heads of the columns that `Stretch.extra` gives
    """

    name: str
    title: str
    stretches: tuple[Stretch, ...]
    closed: bool
    teeth: int = 0
    circles: tuple[Circle, ...] = ()
    notes: tuple[str, ...] = ()
    findings: tuple[str, ...] = ()
    extra_columns: tuple[str, ...] = ()


@dataclass(frozen=True)
class Line:
    """One curve without gaps.

    Attributes
        layer : str
        pieces : the sampled stretches, each with this curve alone
        closed : bool - the last node of the last piece is the first node of the first, to the bit
    """

    layer: str
    pieces: tuple[Sampled, ...]
    closed: bool

    @cached_property
    def nodes(self) -> Points:
        """Every node once; of a closed line the last is the first again."""
        shared = [piece.nodes[0, :-1] for piece in self.pieces]
        return np.concatenate([*shared, self.pieces[-1].nodes[0, -1:]])

    @cached_property
    def control(self) -> Points:
        """Control points of the pieces' cubics as those of one B-spline."""
        shared = [piece.control[0, :-1] for piece in self.pieces]
        return np.concatenate([*shared, self.pieces[-1].control[0, -1:]])

    @cached_property
    def knots(self) -> Reals:
        """Its knots, about the length along the line: threefold where pieces meet, for a vertex may be a corner."""
        rows, start = [np.zeros(1)], 0.0
        for piece in self.pieces:
            length = float(np.abs(np.diff(piece.nodes[0])).sum())
            scale = length / float(piece.knots[-1] - piece.knots[0])
            rows.append(start + scale * (piece.knots[1:-4] - piece.knots[0]))
            start += length
        return np.concatenate([*rows, np.full(4, start)])


@dataclass(frozen=True)
class Contour:
    """A sampled part.

    Attributes
        pieces : the stretches, unfolded and joined
        error : float [mm] - greatest distance of any curve from its chords or cubics
    """

    part: Part
    form: CurveForm
    tolerance: float
    pieces: tuple[Sampled, ...]
    error: float

    @cached_property
    def lines(self) -> tuple[Line, ...]:
        """The curves, layer by layer."""
        layers = dict.fromkeys(layer for piece in self.pieces for layer in piece.stretch.layers)
        return tuple(line for layer in layers for line in self._lines(layer))

    def _lines(self, layer: str) -> Iterator[Line]:
        run: list[Sampled] = []
        for piece in self.pieces:
            if layer not in piece.stretch.layers:
                continue
            alone = _only(piece, layer)
            if run and run[-1].nodes[0, -1] != alone.nodes[0, 0]:
                yield self._line(layer, run)
                run = []
            run.append(alone)
        yield self._line(layer, run)

    def _line(self, layer: str, run: list[Sampled]) -> Line:
        closed = self.part.closed and bool(run[-1].nodes[0, -1] == run[0].nodes[0, 0])
        return Line(layer, tuple(run), closed)

    @property
    def points(self) -> int:
        """Number of nodes of all lines."""
        return sum(line.nodes.size for line in self.lines)


def contour(part: Part, tolerance: float, form: CurveForm) -> Contour:
    """Sample a part.

    Parameters
        part : Part
        tolerance : float [mm] - greatest distance of a curve from its chords or cubics
        form : CurveForm
    Returns
        contour : Contour
    Raises
        TooFine - where the tolerance asks for more than a million points
        NoSolution - where a curve does not exist
    """
    copies = max(1, 2 * part.teeth)
    most = MOST_POINTS // copies
    sampled = [sample(stretch, tolerance, form, most) for stretch in part.stretches]
    if sum(piece.parameter.size for piece in sampled) > most:
        raise TooFine(tolerance)
    pieces = _unfolded(sampled, part.teeth) if part.teeth else sampled
    pieces, gap = _joined(pieces, part.closed)
    return Contour(part, form, tolerance, tuple(pieces), max(piece.error for piece in sampled) + gap)


def _unfolded(half: list[Sampled], teeth: int) -> list[Sampled]:
    """All pitches of a gear from the half of one."""
    space = [piece.mirrored() for piece in reversed(half)] + half
    turns = np.exp(2j * math.pi / teeth * np.arange(teeth))
    return [piece.turned(complex(turn)) for turn in turns for piece in space]


def _joined(pieces: list[Sampled], closed: bool) -> tuple[list[Sampled], float]:
    """Ends of stretches that meet made the same to the bit, and the greatest gap that was there."""
    gap, joined = 0.0, []
    followers = [*pieces[1:], pieces[0] if closed else None]
    for piece, following in zip(pieces, followers, strict=True):
        nodes, control = piece.nodes, piece.control
        for row, layer in enumerate(piece.stretch.layers):
            if following is None or layer not in following.stretch.layers:
                continue
            start = following.nodes[following.stretch.layers.index(layer), 0]
            off = float(abs(start - nodes[row, -1]))
            if off <= JOIN:
                nodes, control = _with_end(nodes, row, start), _with_end(control, row, start)
                gap = max(gap, off)
        joined.append(replace(piece, nodes=nodes, control=control))
    return joined, gap


def _with_end(curves: Points, row: int, end: complex) -> Points:
    if not curves.size:
        return curves
    moved = curves.copy()
    moved[row, -1] = end
    return moved


def _only(piece: Sampled, layer: str) -> Sampled:
    """A sampled stretch with one of its curves."""
    row = piece.stretch.layers.index(layer)
    control = piece.control[row : row + 1] if piece.control.size else piece.control[:1]
    return replace(piece, nodes=piece.nodes[row : row + 1], control=control)


def rows_of(pieces: tuple[Sampled, ...]) -> Iterator[tuple[Sampled, slice]]:
    """Which nodes of each piece a table shows, so that a vertex stands in it once and with all its curves."""
    first = 0
    for piece, following in pairwise([*pieces, None]):
        assert piece is not None
        stop, begin = len(piece.parameter), 0
        if following is not None and set(piece.stretch.layers) & set(following.stretch.layers):
            if set(piece.stretch.layers) <= set(following.stretch.layers):
                stop -= 1
            else:
                begin = 1
        yield piece, slice(first, stop)
        first = begin
