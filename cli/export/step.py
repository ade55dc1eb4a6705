"""STEP: a part as one closed solid, its profile as cubic B-splines extruded along the axis."""

from __future__ import annotations

import math
import tempfile
from importlib import import_module
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from gearlink.cli.export.contour import Contour
from gearlink.cli.export.header import describe
from gearlink.cli.export.options import CurveForm
from gearlink.cli.export.sampling import Points
from gearlink.core.errors import GearlinkError

_ARRAYS = {
    "gp_Pnt": ("TColgp", "TColgp_Array1OfPnt"),
    "double": ("TColStd", "TColStd_Array1OfReal"),
    "int": ("TColStd", "TColStd_Array1OfInteger"),
}
_MOST_SPANS = 8
_TIME = "1970-01-01T00:00:00"
"""The same design gives the same file."""


class NoStep(GearlinkError):
    """The library that writes STEP is not installed, or the part is no body of one section."""


def as_step(contour: Contour, spec: Any, width: float | None = None) -> bytes:
    """The part as a STEP file (AP214, mm), from z = 0 to its width.

    Parameters
        contour : Contour - of splines
        width : float or None [mm] - in place of the part's own
    Raises
        NoStep - without the library, without a width, for an open profile, and for helical gears
    """
    require_body(contour, width)
    across = width or contour.part.width
    assert across is not None, "required above"
    occ = _Occ()
    solid = occ.prism(_edges(occ, contour), contour.part.rim, across)
    words = describe(contour, spec)
    return occ.written(solid, f"{spec.name} {contour.part.name}", f"{words['design_sha256']}")


def require_body(contour: Contour, width: float | None) -> None:
    """Refuse what has no volume or another section at every height.

    Raises
        NoStep - saying what is missing
    """
    part = contour.part
    if not part.closed or len(contour.lines) == 0 or not contour.lines[0].closed:
        raise NoStep(
            f"the profile of {part.name} is open, a solid wants a closed one: take another --part, or --as dxf"
        )
    if not part.spur:
        raise NoStep(
            f"{part.name} is helical: its solid is no straight prism; take --as dxf for the transverse section"
        )
    if width is None and part.width is None:
        raise NoStep(f"a solid of {part.name} needs a width: give --width MM, or face_width in the file of a gear pair")


def section_area(contour: Contour) -> float:
    """Area between profile and rim [mm^2]: the integral of Im(conj(z) dz)/2 over its cubics, exact by Gauss.

    Notes
        The integrand is of degree 5 on each cubic, which three points integrate exactly.
    """
    from scipy.interpolate import BSpline

    places, weights = np.polynomial.legendre.leggauss(3)
    total = 0.0
    for piece in (piece for piece in contour.pieces if piece.stretch.layers[0] == "PROFILE"):
        control = piece.control[0]
        spline = BSpline(piece.knots, np.column_stack([control.real, control.imag]), 3)
        knots = np.unique(piece.knots)
        half = 0.5 * np.diff(knots)
        at = (knots[:-1] + half)[:, None] + half[:, None] * places
        (x, y), (dx, dy) = (np.moveaxis(spline(at.ravel(), order), -1, 0) for order in (0, 1))
        total += float(((x * dy - y * dx).reshape(at.shape) * half[:, None] * weights).sum())
    area = abs(0.5 * total * contour.turns.size)
    return math.pi * contour.part.rim**2 - area if contour.part.rim else area


def _edges(occ: _Occ, contour: Contour) -> list[Any]:
    """An edge for each stretch of the profile, all round; of a hole the other way round."""
    (line,) = (line for line in contour.lines if line.layer == "PROFILE")
    assert contour.form is CurveForm.SPLINE, "chosen by the command"
    edges = [(turn * piece.control[0], piece.knots) for turn in contour.turns.tolist() for piece in line.pieces]
    if contour.part.rim:
        edges = [(control[::-1], (knots[-1] - knots)[::-1]) for control, knots in reversed(edges)]
    return [edge for control, knots in edges for edge in occ.edges(control, knots)]


class _Occ:
    """The few calls of Open CASCADE that are needed, imported when a solid is made."""

    def __init__(self) -> None:
        try:
            import_module("OCP")
        except ImportError as error:
            raise NoStep("STEP needs the library cadquery-ocp: pip install cadquery-ocp, or take --as dxf") from error
        messenger = _static(self.Message.Message, "DefaultMessenger")()
        for printer in list(messenger.Printers()):  # it reports every transfer on standard output
            messenger.RemovePrinter(printer)

    def __getattr__(self, name: str) -> Any:
        return import_module(f"OCP.{name}")

    def edges(self, control: Points, knots: Any) -> list[Any]:
        """A cubic B-spline from its control points and knots, as edges of few spans each.

        Notes
            What measures volumes takes so many points of an edge, however long: of edges with 40 spans the volume of
            a cam was 2e-6 off.
        """
        places, counts = np.unique(knots, return_counts=True)
        poles = self._array("gp_Pnt", len(control))
        for i, point in enumerate(control.tolist(), 1):
            poles.SetValue(i, self.gp.gp_Pnt(point.real, point.imag, 0.0))
        at, times = self._array("double", len(places)), self._array("int", len(places))
        for i, (place, count) in enumerate(zip(places.tolist(), counts.tolist(), strict=True), 1):
            at.SetValue(i, place)
            times.SetValue(i, count)
        curve = self.Geom.Geom_BSplineCurve(poles, at, times, 3)
        parts = -(-(len(places) - 1) // _MOST_SPANS)
        ends = [places[round(i * (len(places) - 1) / parts)] for i in range(parts + 1)]
        make = self.BRepBuilderAPI.BRepBuilderAPI_MakeEdge
        return [make(curve, float(low), float(high)).Edge() for low, high in pairwise(ends)]

    def _array(self, of: str, length: int) -> Any:
        """An array of Open CASCADE, whose names changed from release 7 to 8."""
        module, name = _ARRAYS[of]
        old = getattr(import_module(f"OCP.{module}"), name, None)
        return (old or getattr(import_module("OCP.collections"), f"Array1_{of}"))(1, length)

    def prism(self, edges: list[Any], rim: float, width: float) -> Any:
        """The solid between the profile and its rim, or within the profile."""
        wire = self.BRepBuilderAPI.BRepBuilderAPI_MakeWire()
        for edge in edges:
            wire.Add(edge)
        profile = wire.Wire()
        if rim:
            axes = self.gp.gp_Ax2(self.gp.gp_Pnt(0.0, 0.0, 0.0), self.gp.gp_Dir(0.0, 0.0, 1.0))
            circle = self.BRepBuilderAPI.BRepBuilderAPI_MakeEdge(self.gp.gp_Circ(axes, rim)).Edge()
            outer = self.BRepBuilderAPI.BRepBuilderAPI_MakeWire(circle).Wire()
            made = self.BRepBuilderAPI.BRepBuilderAPI_MakeFace(outer, True)
            made.Add(profile)
            face = made.Face()
        else:
            face = self.BRepBuilderAPI.BRepBuilderAPI_MakeFace(profile, True).Face()
        return self.BRepPrimAPI.BRepPrimAPI_MakePrism(face, self.gp.gp_Vec(0.0, 0.0, width)).Shape()

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
        with tempfile.TemporaryDirectory(prefix="gearlink-") as folder:
            path = Path(folder) / "part.step"
            writer.Write(str(path))
            return path.read_bytes()


def _static(kind: Any, name: str) -> Any:
    """A static method, whose name ends in _s up to release 7."""
    return getattr(kind, f"{name}_s", None) or getattr(kind, name)


def _ascii(words: str) -> str:
    return "".join(letter if letter.isascii() and letter.isprintable() else "_" for letter in words).replace("'", "_")
