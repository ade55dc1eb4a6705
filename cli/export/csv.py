"""CSV: comment lines with units, tolerance and the design's hash, then a row for each point at full precision."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterator
from itertools import chain, repeat
from typing import Any

from gearlink.cli.export.contour import Contour, rows_of
from gearlink.cli.export.header import describe
from gearlink.cli.export.sampling import Sampled

_HEADS = {
    "PROFILE": ("x [mm]", "y [mm]"),
    "PITCH_CURVE": ("pitch_x [mm]", "pitch_y [mm]"),
    "PATH": ("x [mm]", "y [mm]"),
}
_LEADING = ("k", "cam_angle [deg]", "input_angle [deg]", "input_position [mm]")


def as_csv(contour: Contour, spec: Any) -> bytes:
    """The part as a CSV file; of a closed curve the last row is the first point again.

    Notes
        The rows of a spline are the points that the cubics pass through. A value that does not exist (no contact,
        a straight pitch curve, the pressure angle at a corner) is left empty; the column `curve` stands where a piece
        of the contour has a name.
    """
    text = io.StringIO()
    for key, value in describe(contour, spec).items():
        text.write(f"# {key}: {' '.join(value.encode('utf-8', 'replace').decode().split())}\n")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerows(_rows(contour))
    return text.getvalue().encode("utf-8")


def _rows(contour: Contour) -> Iterator[list[Any]]:
    drawn = tuple(piece for piece in contour.pieces if piece.stretch.layers[0] in _HEADS)  # no construction lines
    layers = tuple(dict.fromkeys(layer for piece in drawn for layer in piece.stretch.layers))
    leading = [head for head in contour.part.extra_columns if head in _LEADING]
    trailing = [head for head in contour.part.extra_columns if head not in leading]
    named = ["curve"] if any(piece.stretch.name for piece in drawn) else []
    yield [*leading, *(head for layer in layers for head in _HEADS[layer]), *trailing, *named]
    if contour.part.teeth:
        yield from _tooth_by_tooth(contour)
        return
    for piece, shown in rows_of(drawn):
        columns = _columns(piece, layers, contour.part.extra_columns, len(leading))
        for row in zip(*(column[shown] for column in columns), strict=True):
            yield [*(_cell(value) for value in row), *([piece.stretch.name] if named else ())]


def _tooth_by_tooth(contour: Contour) -> Iterator[list[Any]]:
    """Rows of a gear: x, y and the name of the curve."""
    (line,) = contour.lines
    names = [piece.stretch.name for piece in line.pieces for _ in piece.parameter[1:]]
    curves = chain(*repeat(names, contour.part.teeth), names[-1:])
    nodes = line.nodes
    yield from map(list, zip(nodes.real.tolist(), nodes.imag.tolist(), curves, strict=True))


def _columns(
    piece: Sampled, layers: tuple[str, ...], extra_columns: tuple[str, ...], leading: int
) -> list[list[float]]:
    """The columns of a piece: leading extras, x and y of each layer, the other extras."""
    count = piece.parameter.size
    empty = [math.nan] * count
    extra = [empty] * len(extra_columns)
    if piece.stretch.extra is not None:
        extra = piece.stretch.extra(piece.parameter).tolist()
    places: list[list[float]] = []
    for layer in layers:
        if layer in piece.stretch.layers:
            nodes = piece.nodes[piece.stretch.layers.index(layer)]
            places += [nodes.real.tolist(), nodes.imag.tolist()]
        else:
            places += [empty, empty]
    return [*extra[:leading], *places, *extra[leading:]]


def _cell(value: float) -> float | str:
    return value if math.isfinite(value) else ""
