"""Drawings of contours: DXF with closed polylines or B-splines on named layers, SVG to scale; a unit is a millimetre.

The same design gives the same bytes.
"""

from __future__ import annotations

import io
import math
import os
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout
from importlib import import_module
from typing import TYPE_CHECKING, Any
from xml.sax.saxutils import escape, quoteattr

import numpy as np

from gearlink.cli.export.contour import Contour, Line, describe
from gearlink.cli.export.options import CurveForm
from gearlink.cli.quiet import without_notes
from gearlink.core.base.errors import GearlinkError
from gearlink.core.numerics.arrays import Points, Reals

if TYPE_CHECKING:
    from ezdxf.document import Drawing
    from ezdxf.layouts.layout import Modelspace


# Colours of the AutoCAD index: black or white, cyan, grey, green, red.
_COLORS = {"PROFILE": 7, "PITCH_CURVE": 4, "PATH": 5, "CENTER": 1, "TEXT": 8}
_CONSTRUCTION = 3
_DASHED = {"PITCH_CURVE": "CENTER", "CENTER": "CENTER"}
_MM = 4
_OF_HOME = {"XDG_CONFIG_HOME": ("~/.config", "ezdxf.ini"), "XDG_CACHE_HOME": ("~/.cache", "font_manager_cache.json")}
"""What ezdxf reads in the user's home, by the variable that names another place for it."""


class NoDxf(GearlinkError):
    """The library that writes DXF is not installed."""


def as_dxf(contour: Contour, spec: Any) -> bytes:
    """The part as a DXF file (R2010).

    Raises
        NoDxf - where ezdxf is not installed
    Notes
        A closed polyline carries the flag and not its first vertex twice, so that it has no segment without
        length; a closed spline ends in the control point in which it begins. The text layer is not plotted.
    """
    with _ezdxf() as ezdxf:
        document = ezdxf.new("R2010", setup=["linetypes"], units=_MM)
        said = describe(contour, spec)
        for key, text in said.items():
            document.header.custom_vars.append(key.upper(), _one_line(text))
        space = document.modelspace()
        _add_layers(document, contour)
        for line in contour.lines:
            _add_line(space, line, contour.form)
        for circle in contour.part.circles:
            center = (circle.center.real, circle.center.imag)
            space.add_circle(center, circle.radius, dxfattribs={"layer": circle.layer})
        _add_center(space, _reach(contour))
        _add_text(space, said, contour)
        left, bottom, right, top = _extents(contour)
        document.header["$EXTMIN"], document.header["$EXTMAX"] = (left, bottom, 0.0), (right, top, 0.0)
        space.dxf_layout.dxf.extmin, space.dxf_layout.dxf.extmax = (left, bottom, 0.0), (right, top, 0.0)
        # Registered when written, they would stand in the order of a set, which changes from run to run.
        for used in sorted(document.entitydb.dxf_types_in_use()):
            document.classes.add_class(used)
        stream = io.StringIO()
        document.write(stream)
        data: bytes = document.encode(stream.getvalue())
        return data


@contextmanager
def _home_that_can_be_read() -> Iterator[None]:
    """While ezdxf is loaded, it looks for its settings and its list of fonts in the user's home.

    A service and `sudo -u` run with the home of somebody else, in which they may not look, and ezdxf would not load. It
    does without files that are not there, so it is sent to a place that has none. Of folders of fonts it prints.
    """
    before = {name: os.environ.get(name) for name in _OF_HOME}
    for name, (folder, file) in _OF_HOME.items():
        try:
            os.stat(os.path.join(before[name] or os.path.expanduser(folder), "ezdxf", file))
        except PermissionError:
            os.environ[name] = os.devnull
        except OSError:
            pass  # there is none
    try:
        with redirect_stdout(io.StringIO()):
            yield
    finally:
        for name, value in before.items():
            os.environ.pop(name, None)
            if value is not None:
                os.environ[name] = value


@contextmanager
def _ezdxf() -> Iterator[Any]:
    """ezdxf, writing no dates and no random identities as long as it is used here."""
    try:
        with without_notes("ezdxf"), _home_that_can_be_read():
            ezdxf: Any = import_module("ezdxf")
    except ImportError as error:
        raise NoDxf("DXF needs the library ezdxf: pip install ezdxf, or use --as svg or csv") from error
    before = ezdxf.options.write_fixed_meta_data_for_testing
    ezdxf.options.write_fixed_meta_data_for_testing = True
    try:
        yield ezdxf
    finally:
        ezdxf.options.write_fixed_meta_data_for_testing = before


def _add_layers(document: Drawing, contour: Contour) -> None:
    layers = [line.layer for line in contour.lines] + [circle.layer for circle in contour.part.circles]
    for name in dict.fromkeys([*layers, "CENTER", "TEXT"]):
        layer = document.layers.add(name, color=_COLORS.get(name, _CONSTRUCTION))
        layer.dxf.linetype = _DASHED.get(name, "CONTINUOUS")
    document.layers.get("TEXT").dxf.plot = 0


def _add_line(space: Modelspace, line: Line, form: CurveForm) -> None:
    attributes = {"layer": line.layer}
    if form is CurveForm.POLYLINE:
        polyline = space.add_lwpolyline([], close=line.closed, dxfattribs=attributes)
        polyline.lwpoints = _points(line.nodes[:-1] if line.closed else line.nodes)
        return
    spline = space.add_spline(dxfattribs=attributes)
    spline.control_points = np.column_stack([line.control.real, line.control.imag, np.zeros(line.control.size)])
    spline.knots = line.knots
    spline.closed = line.closed
    spline.export_spline_data = lambda tagwriter: tagwriter.write_str(_spline_text(line))  # type: ignore[method-assign]


def _spline_text(line: Line) -> str:
    knots = [f" 40\n{knot}\n" for knot in line.knots.tolist()]
    return "".join([*knots, *(f" 10\n{p.real}\n 20\n{p.imag}\n 30\n0.0\n" for p in line.control.tolist())])


def _points(nodes: Points) -> Any:
    """Vertices of a polyline that write their text at once: ezdxf makes four objects of each, and a gear has 1e5."""
    from ezdxf.entities.lwpolyline import LWPolylinePoints

    class Text:
        def dxfstr(self) -> str:
            return "".join([f" 10\n{point.real}\n 20\n{point.imag}\n" for point in nodes.tolist()])

    class Written(LWPolylinePoints):
        def dxftags(self) -> Iterator[Any]:
            yield Text()

    points = Written()
    points.values = np.pad(np.column_stack([nodes.real, nodes.imag]), ((0, 0), (0, 3)))
    return points


def _add_center(space: Modelspace, reach: float) -> None:
    """A cross on the axis, its long arm along +x to tell the frame's direction."""
    arm = 0.08 * reach
    for start, end in (((-arm, 0.0), (2.0 * arm, 0.0)), ((0.0, -arm), (0.0, arm))):
        space.add_line(start, end, dxfattribs={"layer": "CENTER"})
    space.add_point((0.0, 0.0), dxfattribs={"layer": "CENTER"})


def _add_text(space: Modelspace, said: dict[str, str], contour: Contour) -> None:
    """The header once more where it can be seen, below the part."""
    reach = _reach(contour)
    height = 0.02 * reach
    for row, (key, text) in enumerate(said.items()):
        place = (-reach, -reach - (2.0 + 1.6 * row) * height)
        entity = space.add_text(_one_line(f"{key}: {text}"), height=height, dxfattribs={"layer": "TEXT"})
        entity.set_placement(place)


def _reach(contour: Contour) -> float:
    return max(float(abs(line.nodes).max()) for line in contour.lines)


def _one_line(text: str) -> str:
    return " ".join(text.encode("utf-8", "replace").decode().split())


_SVG_COLORS = {"PROFILE": "#000000", "PITCH_CURVE": "#0072b2", "PATH": "#0072b2", "CENTER": "#d55e00"}
_SVG_CONSTRUCTION = "#009e73"
_DASHES = {"PITCH_CURVE": "6 1 1 1", "CENTER": "6 1 1 1"}


def as_svg(contour: Contour, spec: Any) -> bytes:
    """The part as an SVG file whose width and height are given in mm, y pointing up.

    Notes
        Coordinates are rounded to a thousandth of the tolerance; the error that the file states includes that.
    """
    digits = 3 + max(0, math.ceil(-math.log10(contour.tolerance)))
    said = describe(contour, spec, extra_error=10.0**-digits)
    sides = _extents(contour)  # with a margin, in whole millimetres
    (left, bottom), (right, top) = (math.floor(x) - 2.0 for x in sides[:2]), (math.ceil(x) + 2.0 for x in sides[2:])
    width, height = f"{right - left:.0f}", f"{top - bottom:.0f}"
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        "<!--",
        *(escape(_clean(f"{key}: {text}").replace("--", "- -")) for key, text in said.items()),  # no two hyphens in it
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
    return f'class="{layer}" stroke="{_SVG_COLORS.get(layer, _SVG_CONSTRUCTION)}"{dash}'


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


def _extents(contour: Contour) -> tuple[float, float, float, float]:
    """Left, bottom, right, top of all curves, circles and the cross on the axis [mm]."""
    spline = contour.form is CurveForm.SPLINE
    boxes = [_box(bezier(line)) if spline else (line.nodes.real, line.nodes.imag) for line in contour.lines]
    for circle in contour.part.circles:
        sides = np.array([-circle.radius, circle.radius])
        boxes.append((circle.center.real + sides, circle.center.imag + sides))
    arm = 0.16 * _reach(contour)
    boxes.append((np.array([-arm, arm]), np.array([-arm, arm])))
    low = [min(float(box[axis].min()) for box in boxes) for axis in (0, 1)]
    high = [max(float(box[axis].max()) for box in boxes) for axis in (0, 1)]
    return low[0], low[1], high[0], high[1]


def _box(chain: Points) -> tuple[Reals, Reals]:
    """x and y of the ends of a chain of Bezier cubics, and where they turn back between these."""
    x, y = (np.append(row[::3], _turns(row)) for row in (chain.real, chain.imag))
    return x, y


def _turns(row: Reals) -> Reals:
    """One coordinate of a chain of Bezier cubics where its derivative vanishes inside them."""
    start, first, second, end = row[:-1:3], row[1::3], row[2::3], row[3::3]
    square, linear, constant = end - start + 3.0 * (first - second), 2.0 * (start - 2.0 * first + second), first - start
    with np.errstate(divide="ignore", invalid="ignore"):
        half = -0.5 * (linear + np.copysign(np.sqrt(linear**2 - 4.0 * square * constant), linear))
        t = np.stack([half / square, constant / half])
        value = (1.0 - t) ** 2 * ((1.0 - t) * start + 3.0 * t * first) + t**2 * (3.0 * (1.0 - t) * second + t * end)
        found: Reals = value[(t > 0.0) & (t < 1.0)]
    return found


def _complex(rows: Any) -> Points:
    values: Points = rows[:, 0] + 1j * rows[:, 1]
    return values


def _pairs(points: Points, digits: int) -> list[str]:
    return [f"{_number(p.real, digits)} {_number(p.imag, digits)}" for p in points.tolist()]


def _number(value: float, digits: int) -> str:
    text = f"{value:.{digits}f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def _clean(text: str) -> str:
    printable = "".join(char if char.isprintable() else " " for char in text)
    return printable.encode("utf-8", "replace").decode()
