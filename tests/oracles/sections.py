"""Area of the section that a solid is made of, from the control points of its contour."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from scipy.interpolate import BSpline

from gearlink.cli.export.contour import Contour


def section_area(contour: Contour, holes: Sequence[float] = ()) -> float:
    """Area between profile and rim [mm^2]: the integral of Im(conj(z) dz)/2 over its cubics, exact by Gauss.

    Parameters
        holes : radii of the holes through it [mm]
    Notes
        The integrand is of degree 5 on each cubic, which three points integrate exactly.
    """
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
    area = math.pi * contour.part.rim**2 - area if contour.part.rim else area
    return area - math.pi * math.fsum(radius**2 for radius in holes)
