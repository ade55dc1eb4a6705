"""STEP: a part as one closed solid, its profile as cubic B-splines extruded along the axis, or turned along it."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from importlib import import_module
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from gearlink.cli.export.contour import Circle, Contour, design_hash
from gearlink.cli.export.options import CurveForm
from gearlink.cli.files import unfinished
from gearlink.core.base.errors import GearlinkError
from gearlink.core.numerics.arrays import Points, Reals

_ARRAYS = {
    "gp_Pnt": ("TColgp", "TColgp_Array{}OfPnt"),
    "double": ("TColStd", "TColStd_Array{}OfReal"),
    "int": ("TColStd", "TColStd_Array{}OfInteger"),
}
_MOST_SPANS = 8
_HELIX_SHARE = 0.01
"""Of the tolerance, what the flanks of a helical gear may be off beside their section."""
_SEWN = 1e-6
"""Edges that lie nearer to each other [mm] are one."""
_TIME = "1970-01-01T00:00:00"
"""The same design gives the same file."""


class NoStep(GearlinkError):
    """The library that writes STEP is not installed, or the part is no body of one section."""


def as_step(contour: Contour, spec: Any, width: float | None = None) -> bytes:
    """The part as a STEP file (AP214, mm), from z = 0 to its width.

    Parameters
        contour : Contour - of splines
        width : float or None [mm] - instead of the part's own
    Raises
        NoStep - without the library, without a width, and for an open profile
        TooLong - for helical gears that turn too often over their width
    Notes
        Helical flanks are within `helix_error` of the section turned along the axis; everything else is the section's.
    """
    across = width_of(contour, width)
    part, turned = contour.part, _turning(contour, across)
    occ = _Occ()
    if turned is None:
        edges = [edge for control, knots in _profile(contour) for edge in occ.edges(control, knots)]
        face, way = occ.face(edges, part.rim, contour.holes), occ.gp.gp_Vec(part.slant * across, 0.0, across)
        solid = occ.BRepPrimAPI.BRepPrimAPI_MakePrism(face, way).Shape()
    else:
        solid = occ.helicoid(_profile(contour), turned, part.rim, across, contour.holes)
    return occ.written(solid, f"{spec.name} {part.name}", design_hash(spec))


def helix_error(contour: Contour, width: float | None) -> float:
    """Maximum distance of a solid's flanks from the section turned along the axis [mm]; 0 where it does not turn."""
    turned = _turning(contour, width_of(contour, width))
    return 0.0 if turned is None else turned.error * _reach(contour)


def _turning(contour: Contour, across: float) -> Turning | None:
    if not contour.part.twist:
        return None
    return turning(contour.part.twist * across, _HELIX_SHARE * contour.tolerance / _reach(contour))


def _reach(contour: Contour) -> float:
    """Radius of the outermost point of the profile [mm]."""
    return max(float(np.abs(piece.control).max()) for piece in contour.pieces)


def width_of(contour: Contour, width: float | None) -> float:
    """The width of the solid [mm].

    Raises
        NoStep - without one, and for a profile that is open
    """
    part = contour.part
    if not part.closed or len(contour.lines) == 0 or not contour.lines[0].closed:
        words = f"the profile of {part.name} is open, a solid needs a closed one"
        raise NoStep(f"{words}\ngive another --part, or --as dxf")
    across = part.width if width is None else width
    if across is None:
        raise NoStep(f"a solid of {part.name} needs a width\ngive --width MM, or face_width in the file of a gear pair")
    return across


def _profile(contour: Contour) -> list[tuple[Points, Any]]:
    """Control points and knots of each stretch of the profile, all round; of a hole the other way round."""
    (line,) = (line for line in contour.lines if line.layer == "PROFILE")
    assert contour.form is CurveForm.SPLINE, "chosen by the command"
    curves = [(turn * piece.control[0], piece.knots) for turn in line.turns.tolist() for piece in line.pieces]
    if contour.part.rim:
        return [(control[::-1], (knots[-1] - knots)[::-1]) for control, knots in reversed(curves)]
    return curves


class _Occ:
    """The few calls of Open CASCADE that are needed, imported when a solid is made."""

    def __init__(self) -> None:
        try:
            import_module("OCP")
        except ModuleNotFoundError as error:
            raise NoStep("STEP needs the library cadquery-ocp: pip install cadquery-ocp, or use --as dxf") from error
        except ImportError as error:  # as on a computer without a screen
            words = f"cadquery-ocp is installed, but a library that it needs is not: {error}"
            fix = "install it (libGL.so.1 on Debian and Ubuntu: apt-get install libgl1), or use --as dxf"
            raise NoStep(f"{words}\n{fix}") from error
        messenger = _static(self.Message.Message, "DefaultMessenger")()
        for printer in list(messenger.Printers()):  # it reports every transfer on standard output
            messenger.RemovePrinter(printer)

    def __getattr__(self, name: str) -> Any:
        return import_module(f"OCP.{name}")

    def edges(self, control: Points, knots: Any, height: float = 0.0) -> list[Any]:
        """A cubic B-spline from its control points and knots at a height, as edges of few spans each.

        Notes
            What measures volumes takes so many points of an edge, however long: of edges with 40 spans the volume of
            a cam was 2e-6 off.
        """
        places, counts = np.unique(knots, return_counts=True)
        poles = self._array("gp_Pnt", len(control))
        for i, point in enumerate(control.tolist(), 1):
            poles.SetValue(i, self.gp.gp_Pnt(point.real, point.imag, height))
        curve = self.Geom.Geom_BSplineCurve(poles, *self._knots(places, counts), 3)
        make = self.BRepBuilderAPI.BRepBuilderAPI_MakeEdge
        return [make(curve, low, high).Edge() for low, high in _few_spans(places)]

    def _flanks(self, control: Points, knots: Any, turned: Turning, width: float) -> list[Any]:
        """The faces that the edges of a cubic B-spline pass over on their way along the axis."""
        (along, times), (up, often) = (np.unique(each, return_counts=True) for each in (knots, turned.knots))
        poles = self._array("gp_Pnt", len(control), turned.control.size)
        for j, (turn, share) in enumerate(zip(turned.control.tolist(), turned.heights.tolist(), strict=True), 1):
            for i, point in enumerate((control * turn).tolist(), 1):
                poles.SetValue(i, j, self.gp.gp_Pnt(point.real, point.imag, share * width))
        (u, u_times), (v, v_times) = self._knots(along, times), self._knots(up, often)
        surface = self.Geom.Geom_BSplineSurface(poles, u, v, u_times, v_times, 3, 3)
        make = self.BRepBuilderAPI.BRepBuilderAPI_MakeFace
        return [make(surface, low, high, 0.0, 1.0, _SEWN).Face() for low, high in _few_spans(along)]

    def helicoid(
        self, profile: list[tuple[Points, Any]], turned: Turning, rim: float, width: float, holes: Sequence[Circle]
    ) -> Any:
        """The solid whose section turns along the axis, within its rim where it has one; holes are straight.

        Raises
            NoStep - where its faces leave a gap
        """
        sewing = self.BRepBuilderAPI.BRepBuilderAPI_Sewing(_SEWN)
        for control, knots in profile:
            for flank in self._flanks(control, knots, turned, width):
                sewing.Add(flank)
        for turn, height in ((1.0, 0.0), (complex(turned.control[-1]), width)):
            edges = [e for c, k in profile for e in self.edges(turn * c, k, height)]
            sewing.Add(self.face(edges, rim, holes, height))
        for each in (*holes, *((Circle("RIM", rim),) if rim else ())):
            axes = self.gp.gp_Ax3(self._place(each), self.gp.gp_Dir(0.0, 0.0, 1.0))
            cylinder = self.gp.gp_Cylinder(axes, each.radius)
            sewing.Add(self.BRepBuilderAPI.BRepBuilderAPI_MakeFace(cylinder, 0.0, 2.0 * math.pi, 0.0, width).Face())
        sewing.Perform()
        if sewing.NbFreeEdges():
            raise NoStep(f"the faces of the solid leave {sewing.NbFreeEdges()} gaps\ngive a smaller --tolerance")
        shell = _static(self.TopoDS.TopoDS, "Shell")(sewing.SewedShape())
        solid = self.BRepBuilderAPI.BRepBuilderAPI_MakeSolid(shell).Solid()
        _static(self.BRepLib.BRepLib, "OrientClosedSolid")(solid)
        return solid

    def _knots(self, places: Any, counts: Any) -> tuple[Any, Any]:
        at, times = self._array("double", len(places)), self._array("int", len(places))
        for i, (place, count) in enumerate(zip(places.tolist(), counts.tolist(), strict=True), 1):
            at.SetValue(i, place)
            times.SetValue(i, count)
        return at, times

    def _array(self, of: str, *lengths: int) -> Any:
        """An array of one or two dimensions of Open CASCADE, whose names changed from release 7 to 8."""
        module, name = _ARRAYS[of]
        rank = len(lengths)
        old = getattr(import_module(f"OCP.{module}"), name.format(rank), None)
        make = old or getattr(import_module("OCP.collections"), f"Array{rank}_{of}")
        return make(*(end for length in lengths for end in (1, length)))

    def _place(self, circle: Circle, height: float = 0.0) -> Any:
        return self.gp.gp_Pnt(circle.center.real, circle.center.imag, height)

    def _round(self, circle: Circle, height: float, sense: float) -> Any:
        """A circle, counter-clockwise with the sense +1."""
        axes = self.gp.gp_Ax2(self._place(circle, height), self.gp.gp_Dir(0.0, 0.0, sense))
        edge = self.BRepBuilderAPI.BRepBuilderAPI_MakeEdge(self.gp.gp_Circ(axes, circle.radius)).Edge()
        return self.BRepBuilderAPI.BRepBuilderAPI_MakeWire(edge).Wire()

    def face(self, edges: list[Any], rim: float, holes: Sequence[Circle], height: float = 0.0) -> Any:
        """The plane between the profile and its rim, or within the profile, without its holes."""
        wire = self.BRepBuilderAPI.BRepBuilderAPI_MakeWire()
        for edge in edges:
            wire.Add(edge)
        outer, *inner = [wire.Wire()] if not rim else [self._round(Circle("RIM", rim), height, 1.0), wire.Wire()]
        made = self.BRepBuilderAPI.BRepBuilderAPI_MakeFace(outer, True)
        for each in (*inner, *(self._round(hole, height, -1.0) for hole in holes)):
            made.Add(each)
        return made.Face()

    def written(self, solid: Any, name: str, signature: str) -> bytes:
        """The bytes of a STEP file that holds one solid."""
        _static(self.Interface.Interface_Static, "SetCVal")("write.step.unit", "MM")
        writer = self.STEPControl.STEPControl_Writer()
        writer.Transfer(solid, self.STEPControl.STEPControl_StepModelType.STEPControl_ManifoldSolidBrep)
        header = self.APIHeaderSection.APIHeaderSection_MakeHeader(writer.Model())
        text = self.TCollection.TCollection_HAsciiString
        header.SetName(text(_ascii(name)))
        header.SetTimeStamp(text(_TIME))
        header.SetDescriptionValue(1, text(f"gearlink, design {signature}"))
        with tempfile.TemporaryDirectory(prefix="gearlink-") as folder, unfinished(folder):
            path = Path(folder) / "part.step"
            writer.Write(str(path))
            return path.read_bytes()


def _few_spans(places: Any) -> list[tuple[float, float]]:
    """The range of a spline in parts of few spans each, by its knots."""
    parts = -(-(len(places) - 1) // _MOST_SPANS)
    ends = [float(places[round(i * (len(places) - 1) / parts)]) for i in range(parts + 1)]
    return list(pairwise(ends))


def _static(kind: Any, name: str) -> Any:
    """A static method, whose name ends in _s up to release 7."""
    return getattr(kind, f"{name}_s", None) or getattr(kind, name)


def _ascii(words: str) -> str:
    return "".join(letter if letter.isascii() and letter.isprintable() else "_" for letter in words).replace("'", "_")


_FIRST_STEP = 0.5
_HELICOID_MOST_SPANS = 500
_PROBES = 16


class TooLong(GearlinkError):
    """The gear turns so often over its width that its file would be too large."""


@dataclass(frozen=True)
class Turning:
    """A turn along the axis as a cubic B-spline over 0 to 1.

    Attributes
        knots : with four at each end
        control : complex - control points of the turned unit vector; the first is 1, the last lies on the circle
        heights : share of the width at each control point
        error : float - maximum distance from the circle's point at the same height, of radius 1
    """

    knots: Reals
    control: Points
    heights: Reals
    error: float


def turning(angle: float, tolerance: float) -> Turning:
    """The turn by an angle [rad], refined until it is within a tolerance of the exact one.

    Parameters
        angle : float [rad]
        tolerance : float - maximum distance at radius 1
    Raises
        TooLong - where that takes more spans than a file should hold
    Notes
        Cubic interpolation with the slopes at both ends: 1/384 of the fourth power of the turn in a span.
    Example
        >>> made = turning(0.6, 1e-7)
        >>> made.error < 1e-7, round(float(made.control[-1].real - math.cos(0.6)), 15)
        (True, 0.0)
    """
    from scipy.interpolate import make_interp_spline

    spans = max(1, math.ceil(abs(angle) / _FIRST_STEP))
    while spans <= _HELICOID_MOST_SPANS:
        places = np.linspace(0.0, 1.0, spans + 1)
        exact = np.exp(1j * angle * places)
        slopes = 1j * angle * exact[[0, -1]]
        first, last = ([(1, [slope.real, slope.imag])] for slope in slopes.tolist())
        spline = make_interp_spline(places, np.column_stack([exact.real, exact.imag]), 3, bc_type=(first, last))
        probes = np.linspace(0.0, 1.0, _PROBES * spans + 1)
        off = spline(probes) @ np.array([1.0, 1j]) - np.exp(1j * angle * probes)
        if float(np.abs(off).max()) <= tolerance:
            knots, control = spline.t, spline.c @ np.array([1.0, 1j])
            control[[0, -1]] = exact[[0, -1]]
            heights = np.array([knots[i + 1 : i + 4].mean() for i in range(control.size)])
            return Turning(knots, control, heights, float(np.abs(off).max()))
        spans *= 2
    words = f"a helical gear that turns by {math.degrees(abs(angle)):.4g} deg over its width is too long for a file"
    raise TooLong(f"{words}\ngive a smaller --width, or a larger --tolerance")
