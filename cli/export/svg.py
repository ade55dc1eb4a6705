"""SVG to scale: one user unit is one millimetre."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any
from xml.sax.saxutils import escape, quoteattr

import numpy as np

from gearlink.cli.export.contour import Contour, Line, describe, extents
from gearlink.cli.export.options import CurveForm
from gearlink.cli.export.sampling import Points

_COLORS = {"PROFILE": "#000000", "PITCH_CURVE": "#0072b2", "PATH": "#0072b2", "CENTER": "#d55e00"}
_CONSTRUCTION = "#009e73"
_DASHES = {"PITCH_CURVE": "6 1 1 1", "CENTER": "6 1 1 1"}


def as_svg(contour: Contour, spec: Any) -> bytes:
    """The part as an SVG file whose width and height are given in mm, y pointing up.

    Notes
        Coordinates are rounded to a thousandth of the tolerance; the error that the file states includes that.
    """
    digits = 3 + max(0, math.ceil(-math.log10(contour.tolerance)))
    said = describe(contour, spec, extra_error=10.0**-digits)
    left, bottom, right, top = _frame(contour)
    width, height = f"{right - left:.0f}", f"{top - bottom:.0f}"
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        "<!--",
        *(_comment(f"{key}: {text}") for key, text in said.items()),
        "-->",
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" '
        f'width="{width}mm" height="{height}mm" '
        f'viewBox="{left:.0f} {-top:.0f} {width} {height}">',
        f"<title>{escape(_clean(spec.name))} {escape(contour.part.title)}</title>",
        '<g transform="scale(1 -1)" fill="none" stroke-width="0.2" stroke-linejoin="round">',
        *_body(contour, digits),
        "</g>",
        "</svg>",
        "",
    ]
    return "\n".join(lines).encode("utf-8")


def _body(contour: Contour, digits: int) -> Iterator[str]:
    for circle in contour.part.circles:
        x, y, r = (_number(value, digits) for value in (circle.center.real, circle.center.imag, circle.radius))
        yield f'<circle {_style(circle.layer)} cx="{x}" cy="{y}" r="{r}"/>'
    arm = 0.08 * _reach(contour)
    yield f'<path {_style("CENTER")} d="M{-arm:g} 0H{2.0 * arm:g}M0 {-arm:g}V{arm:g}"/>'
    for line in contour.lines:
        path = _chords(line, digits) if contour.form is CurveForm.POLYLINE else _cubics(line, digits)
        yield f'<path {_style(line.layer)} d="{path}"/>'


def _style(layer: str) -> str:
    dash = f" stroke-dasharray={quoteattr(_DASHES[layer])}" if layer in _DASHES else ""
    return f'class="{layer}" stroke="{_COLORS.get(layer, _CONSTRUCTION)}"{dash}'


def _chords(line: Line, digits: int) -> str:
    nodes = line.nodes[:-1] if line.closed else line.nodes
    return "M" + "L".join(_pairs(nodes, digits)) + ("Z" if line.closed else "")


def _cubics(line: Line, digits: int) -> str:
    """The B-spline as Bezier cubics, which are the same curve."""
    points = bezier(line)
    pairs = _pairs(points, digits)
    parts = [f"M{pairs[0]}", *(f"C{' '.join(pairs[i : i + 3])}" for i in range(1, len(pairs), 3))]
    return "".join(parts) + ("Z" if line.closed else "")


def bezier(line: Line) -> Points:
    """Control points of a line's spline as a chain of Bezier cubics, three to a cubic after the first point."""
    from scipy.interpolate import BSpline

    chain = []
    for piece in line.pieces:
        knots, control = piece.knots, piece.control[0]
        places = np.unique(knots)
        spline = BSpline(knots, np.column_stack([control.real, control.imag]), 3)
        values, slopes = (_complex(rows) for rows in (spline(places), spline(places, 1)))
        third = np.diff(places) / 3.0
        values[0], values[-1] = control[0], control[-1]
        cubics = np.stack([values[:-1] + third * slopes[:-1], values[1:] - third * slopes[1:], values[1:]], axis=1)
        chain.append(cubics.ravel())
    points = np.concatenate([line.control[:1], line.repeated(np.concatenate(chain))])
    points[-1] = line.control[-1]
    return points


def _complex(rows: Any) -> Points:
    values: Points = rows[:, 0] + 1j * rows[:, 1]
    return values


def _pairs(points: Points, digits: int) -> list[str]:
    return [f"{_number(p.real, digits)} {_number(p.imag, digits)}" for p in points.tolist()]


def _number(value: float, digits: int) -> str:
    text = f"{value:.{digits}f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def _reach(contour: Contour) -> float:
    return max(float(abs(line.nodes).max()) for line in contour.lines)


def _frame(contour: Contour) -> tuple[float, float, float, float]:
    """Left, bottom, right, top of all curves, circles and the axis with a margin, in whole millimetres."""
    left, bottom, right, top = extents(contour)
    return math.floor(left) - 2.0, math.floor(bottom) - 2.0, math.ceil(right) + 2.0, math.ceil(top) + 2.0


def _comment(text: str) -> str:
    """Text that may stand in an XML comment, where two hyphens may not."""
    return escape(_clean(text).replace("--", "- -"))


def _clean(text: str) -> str:
    printable = "".join(char if char.isprintable() else " " for char in text)
    return printable.encode("utf-8", "replace").decode()
