"""Undercut of cam profiles: does any position of the roller cut into what another position has left?"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from gearlink.core.numerics.arrays import Points, Reals

_GRID = 17


class Undercut(NamedTuple):
    """The place where the profile comes nearest to a roller centre.

    Attributes
        depth : float [mm] - r_g - distance there: how deep the roller cuts, 0 (to rounding) where it does not
        cam_angle : float [rad] - of the profile point that is cut away
        roller_angle : float [rad] - cam angle of the roller position that cuts it
    """

    depth: float
    cam_angle: float
    roller_angle: float


def undercut(
    points: Callable[[Reals], tuple[Points, Points]],
    roller_radius: float,
    *,
    start: float = 0.0,
    end: float = 2.0 * math.pi,
    closed: bool = True,
    samples: int = 4096,
) -> Undercut:
    """Deepest cut of the roller into its own cam, near (a swallowtail) or far along the profile.

    depth = r_g - min |C(phi) - P(t)|  over all phi and t

    Parameters
        points : function of cam angles [rad] - returns pitch points P and profile points C [mm], complex
        roller_radius : float [mm] - r_g
        start, end : float [rad] - range of cam angles; a whole turn by default
        closed : bool - the profile closes from end to start
        samples : int - cam angles tried before the deepest place is refined
    Returns
        undercut : Undercut - depth below about 1e-12 of the cam's size means none
    Notes
        N log N by a k-d tree of the pitch points. A far cut shallower than h^2/(8 r_g), h the step along the
        pitch curve, may pass (0.2 um for a 300 mm cam, 30 mm roller and 4096 samples); the onset of a
        swallowtail is found earlier by the curvature (see least_convex_radius).
    Example
        >>> circle = lambda phi: (50 * np.exp(-1j * phi), 30 * np.exp(-1j * phi))
        >>> undercut(circle, 20.0).depth < 1e-12
        True

    Source
        own derivation: |C(phi) - P(t)| >= r_g for a machinable profile
    """
    from scipy.spatial import cKDTree

    phi = np.linspace(start, end, samples)
    pitch, profile = points(phi)
    distance, nearest = cKDTree(_plane(pitch)).query(_plane(profile))
    worst = int(np.argmin(distance))
    at, by, least = float(phi[worst]), float(phi[int(nearest[worst])]), float(distance[worst])
    if least < roller_radius * (1.0 - 1e-12):
        at, by, least = _deepest(points, at, by, float(phi[1] - phi[0]), (start, end), closed)
    return Undercut(max(0.0, roller_radius - least), at, by)


def _plane(points: Points) -> Reals:
    return np.column_stack((points.real, points.imag))


def _deepest(
    points: Callable[[Reals], tuple[Points, Points]],
    at: float,
    by: float,
    reach: float,
    limits: tuple[float, float],
    closed: bool,
) -> tuple[float, float, float]:
    """Least |C(phi) - P(t)| around a first guess, on grids that shrink by half."""
    least = math.inf
    while reach > 1e-10:
        phi, t = (_within(centre + reach * np.linspace(-1.0, 1.0, _GRID), limits, closed) for centre in (at, by))
        gaps = np.abs(points(phi)[1][:, None] - points(t)[0][None, :])
        i, j = divmod(int(np.argmin(gaps)), _GRID)
        if gaps[i, j] < least:
            at, by, least = float(phi[i]), float(t[j]), float(gaps[i, j])
        reach *= 0.5
    return at, by, least


def _within(angles: Reals, limits: tuple[float, float], closed: bool) -> Reals:
    start, end = limits
    if closed:
        return start + np.mod(angles - start, end - start)
    return np.clip(angles, start, end)
