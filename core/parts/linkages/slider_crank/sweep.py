"""The offset slider-crank at many crank positions; frame and signs as in `position`."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from gearlink.core.base.errors import NoSolution
from gearlink.core.numerics.arrays import Reals
from gearlink.core.parts.linkages.slider_crank.position import not_reached


def slider(psi: ArrayLike, crank: float, rod: float, offset: float = 0.0, order: int = 0) -> tuple[Reals, ...]:
    """Depths of the slider below the crank pivot, with derivatives with respect to the crank direction.

    h = w - r sin(psi),  w = sqrt(L^2 - u^2),  u = r cos(psi) + e

    Parameters
        psi : float array of any shape [rad] - directions of the crank from +x, counter-clockwise
        crank, rod, offset : float [mm] - r, L, e (signed)
        order : 0..3 - derivatives wanted
    Returns
        h, h', h'', h''' up to the order : tuple of arrays of that shape [mm, mm/rad ... mm/rad^3]
    Raises
        NoSolution - when the rod does not reach the slide line at one of the positions
    Example
        >>> slider([0.0, -np.pi / 2], 50.0, 200.0)[0].round(6)
        array([193.649167, 250.      ])

    Source
        TY-460 report 2.1; own derivation
    """
    angles = np.asarray(psi, dtype=np.float64)
    return slider_at(np.cos(angles), np.sin(angles), crank, rod, offset, order)


def slider_at(
    cosine: Reals, sine: Reals, crank: float, rod: float, offset: float = 0.0, order: int = 0
) -> tuple[Reals, ...]:
    """The same as `slider` for crank directions given as unit vectors.

    Parameters
        cosine, sine : float arrays of one shape [1] - the unit vector along the crank
        crank, rod, offset : float [mm] - r, L, e (signed)
        order : 0..3 - derivatives wanted
    Returns
        h, h', h'', h''' up to the order : tuple of arrays [mm, mm/rad ... mm/rad^3]
    Raises
        NoSolution - when the rod does not reach the slide line at one of the positions
    Example
        >>> slider_at(np.array([0.6]), np.array([-0.8]), 50.0, 200.0, 10.0)[0].round(6)
        array([235.959179])

    Source
        TY-460 report 2.1; own derivation
    """
    along, across = crank * cosine, crank * sine
    u = along + offset
    square = (rod - u) * (rod + u)
    reached = square >= 0.0 if order == 0 else square > 0.0
    if not np.all(reached):
        first = int(np.argmin(reached))
        psi = float(np.arctan2(np.ravel(sine)[first], np.ravel(cosine)[first]))
        raise NoSolution(not_reached(psi, crank, rod, offset))
    w = np.sqrt(square)
    depth = w - across
    if order == 0:
        return (depth,)
    w1 = u * across / w
    if order == 1:
        return depth, w1 - along
    w2 = -(across * across - u * along + w1 * w1) / w
    if order == 2:
        return depth, w1 - along, across + w2
    # w w' = -u u' twice more, with u' = -r sin(psi), u'' = -r cos(psi), u''' = r sin(psi)
    w3 = -(3.0 * across * along + u * across + 3.0 * w1 * w2) / w
    return depth, w1 - along, across + w2, along + w3
