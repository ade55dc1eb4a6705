"""A part as it goes into a file: its stretches sampled, unfolded over the teeth, joined without gaps."""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from gearlink.cli.export.options import MOST_TOLERANCE, CurveForm
from gearlink.cli.export.sampling import MOST_POINTS, Sampled, Stretch, TooFine, sample
from gearlink.core.numerics.arrays import Points, Reals
from gearlink.core.version import VERSION

# Ends of stretches that lie nearer to each other [mm] are one vertex; the gap counts as error.
JOIN = 1e-6


@dataclass(frozen=True)
class Circle:
    """A circle about the part's origin or another point."""

    layer: str
    radius: float
    center: complex = 0j


class Dimension(NamedTuple):
    """A size that the drawing of a part shows.

    Fields
        words : str - what it says
        start, end : complex [mm] - between which it lies; of a radius the centre and a point of the arc
        places : int - so many times it lies alike about the axis: the drawing takes the clearest place
        row : int - above 0: in this row below the view, or beside it if it is upright; else where it lies
    """

    words: str
    start: complex
    end: complex
    places: int = 1
    row: int = 0


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
        width : float or None [mm] - along the axis
        twist : float [rad/mm] - how far the section turns along the axis; above 0 with right-hand teeth
        slant : float - how far the section moves along x on its way along the axis: the teeth of a helical rack
        rim : float [mm] - above 0: the body lies between the profile and this circle
        lines : gives the lines of its table on a drawing: item, symbol, value, unit
        dimensions : what a drawing shows beside diameters of circles
        body : the profile bounds a body, which the path of a cutter does not
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
    width: float | None = None
    twist: float = 0.0
    slant: float = 0.0
    rim: float = 0.0
    lines: Callable[[], list[tuple[str, str, Any, str]]] | None = None
    dimensions: tuple[Dimension, ...] = ()
    body: bool = True


@dataclass(frozen=True)
class Line:
    """One curve without gaps; a closed one runs counter-clockwise.

    Attributes
        pieces : the sampled stretches, each with this curve alone; of a gear those of one pitch
        turns : unit vectors - the places about the axis at which the pieces stand, one after the other
        closed : bool - the last node of the last piece is the first node of the first, to the bit
    """

    layer: str
    pieces: tuple[Sampled, ...]
    closed: bool
    turns: Points

    @cached_property
    def nodes(self) -> Points:
        """Every node once; of a closed line the last is the first again."""
        return self._whole([piece.nodes[0] for piece in self.pieces])

    @cached_property
    def control(self) -> Points:
        """Control points of the pieces' cubics as those of one B-spline."""
        return self._whole([piece.control[0] for piece in self.pieces])

    @property
    def area(self) -> float:
        """The area inside a closed line by its chords, negative where it runs clockwise [mm^2]."""
        return 0.5 * float(np.sum((self.nodes[:-1].conj() * self.nodes[1:]).imag))

    def reversed(self) -> Line:
        """The same curve, run through backwards."""
        return replace(self, pieces=tuple(piece.backwards() for piece in self.pieces[::-1]), turns=self.turns[::-1])

    def _whole(self, rows: list[Points]) -> Points:
        points = self.repeated(np.concatenate([row[:-1] for row in rows]))
        return np.concatenate([points, points[:1] if self.closed else rows[-1][-1:]])

    def repeated(self, points: Points) -> Points:
        """The points of the pieces, turned into each of their places."""
        return (self.turns[:, None] * points).ravel()

    @cached_property
    def knots(self) -> Reals:
        """Its knots, about the length along the line: threefold where pieces meet, for a vertex may be a corner."""
        rows, start = [], 0.0
        for piece in self.pieces:
            length = float(np.abs(np.diff(piece.nodes[0])).sum())
            scale = length / float(piece.knots[-1] - piece.knots[0])
            rows.append(start + scale * (piece.knots[1:-4] - piece.knots[0]))
            start += length
        places = start * np.arange(self.turns.size + 1)
        inner = np.add.outer(places[:-1], np.concatenate(rows)).ravel()
        return np.concatenate([[0.0], inner, np.repeat(places[-1], 4)])


@dataclass(frozen=True)
class Contour:
    """A sampled part.

    Attributes
        pieces : the stretches, joined; of a gear those of one pitch, both halves of it
        turns : unit vectors - the places of the pieces: one, or one for each tooth
        error : float [mm] - maximum distance of any curve from its chords or cubics
    """

    part: Part
    form: CurveForm
    tolerance: float
    pieces: tuple[Sampled, ...]
    turns: Points
    error: float

    def has_bore(self, circle: Circle) -> bool:
        """Whether a circle is a shaft that goes through the part, and not beside it or through its edge."""
        if circle.layer != "SHAFT":
            return False
        edge = np.concatenate([line.nodes for line in self.lines if line.layer == "PROFILE"])
        round_ = not self.part.closed or abs(np.angle(edge[1:] / edge[:-1]).sum()) > math.pi
        return bool(np.abs(edge).min() > circle.radius and round_)

    @property
    def holes(self) -> tuple[Circle, ...]:
        """Holes through the part: its bore, and those beside it."""
        circles, always = self.part.circles, ("BORE", "OUTPUT_HOLES")
        return tuple(each for each in circles if each.layer in always or self.has_bore(each))

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
        gap = abs(run[-1].nodes[0, -1] - _step(self.turns) * run[0].nodes[0, 0])
        line = Line(layer, tuple(run), self.part.closed and bool(gap <= JOIN), self.turns)
        return line.reversed() if line.closed and line.area < 0.0 else line

    @property
    def points(self) -> int:
        """Number of nodes of all lines."""
        return sum(line.nodes.size for line in self.lines)


def contour(part: Part, tolerance: float, form: CurveForm) -> Contour:
    """Sample a part.

    Parameters
        tolerance : float [mm] - maximum distance of a curve from its chords or cubics
    Raises
        TooFine - where the tolerance asks for more than MOST_POINTS, with the tolerance that does not
        NoSolution - where a curve does not exist
    """
    try:
        sampled = _sampled(part, tolerance, form, MOST_POINTS)
    except TooFine as error:
        raise TooFine(tolerance, _remedy(part, tolerance, form)) from error
    copies = max(1, part.teeth)
    turns = np.exp(2j * math.pi / copies * np.arange(copies))
    pieces, gap = _joined(sampled, part.closed, _step(turns))
    return Contour(part, form, tolerance, tuple(pieces), turns, max(piece.error for piece in sampled) + gap)


def _sampled(part: Part, tolerance: float, form: CurveForm, most: int) -> list[Sampled]:
    """The stretches as nodes, of which the whole part has `most` at most; of a gear those of one pitch."""
    left = most // max(1, 2 * part.teeth)
    sampled = []
    for stretch in part.stretches:
        piece = sample(stretch, tolerance, form, left + 1)
        left -= _steps(piece)
        sampled.append(piece)
    if left < 0:
        raise TooFine(tolerance)
    return [*(piece.mirrored() for piece in reversed(sampled)), *sampled] if part.teeth else sampled


def _steps(piece: Sampled) -> int:
    """Nodes of all curves of a stretch but the last of each, with which the next begins."""
    return len(piece.nodes) * (piece.parameter.size - 1)


def _remedy(part: Part, tolerance: float, form: CurveForm) -> str:
    """The minimum round tolerance that works, or the number of teeth that does."""
    steps = [digit * 10.0**power for power in range(-5, 2) for digit in (1, 2, 5)]
    for coarser in (step for step in steps if tolerance < step <= MOST_TOLERANCE):
        with suppress(TooFine):
            _sampled(part, coarser, form, MOST_POINTS)
            return f"increase --tolerance to {coarser:g}"
    if not part.teeth:
        return f"no tolerance up to {MOST_TOLERANCE:g} mm is sufficient for a part of this size"
    least = sum(_steps(piece) for piece in _sampled(part, MOST_TOLERANCE, form, MOST_POINTS * part.teeth))
    other = "" if form is CurveForm.POLYLINE else ", or use --curve polyline"
    return f"a file holds a gear of at most {MOST_POINTS // least} teeth{other}"


def _step(turns: Points) -> complex:
    """The turn from one place of the pieces to the next."""
    return complex(turns[1 % turns.size])


def _joined(pieces: list[Sampled], closed: bool, step: complex) -> tuple[list[Sampled], float]:
    """Ends of stretches that meet made the same to the bit, and the maximum gap that was there."""
    gap, joined = 0.0, []
    followers = [*pieces[1:], pieces[0].turned(step) if closed else None]
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


def design_hash(spec: Any) -> str:
    """sha256 of the design's canonical form: every key with its value, defaults included, in JSON, sorted."""
    plain = spec.model_dump(mode="json", by_alias=True)
    text = json.dumps(plain, sort_keys=True, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()


def rounded_up(value: float) -> str:
    """Three digits that are not below the value.

    Example
        >>> rounded_up(0.00087212), rounded_up(0.0)
        ('0.000873', '0')
    """
    if value == 0.0:
        return "0"
    unit = 10.0 ** (math.floor(math.log10(value)) - 2)
    up = math.ceil(value / unit)
    text = f"{up * unit:.3g}"
    return text if float(text) >= value else f"{(up + 1) * unit:.3g}"


def error_name(contour: Contour) -> str:
    """What the reached error is called: that of chords, or that of cubics through the points."""
    return "spline error" if contour.form is CurveForm.SPLINE else "chord error"


def describe(contour: Contour, spec: Any, extra_error: float = 0.0) -> dict[str, str]:
    """The lines of a file's header.

    Parameters
        spec : the design's spec
        extra_error : float [mm] - what the file's own rounding adds
    """
    part = contour.part
    named = {
        "program": f"gearlink {VERSION}",
        "design": spec.name,
        "kind": spec.kind,
        "design_sha256": design_hash(spec),
        "part": f"{part.name} ({part.title})",
        "unit": "mm",
        "curve": str(contour.form),
        "tolerance": f"{contour.tolerance:g} mm",
        error_name(contour).replace(" ", "_"): f"{rounded_up(contour.error + extra_error)} mm",
        "points": ", ".join(f"{line.layer} {line.nodes.size}" for line in contour.lines),
    }
    notes = {f"note_{number}": note for number, note in enumerate(part.notes, 1)}
    return named | notes | {f"warning_{number}": text for number, text in enumerate(part.findings, 1)}
