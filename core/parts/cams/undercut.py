"""Undercut of cam profiles: does any position of the roller cut into what another position has left?"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from gearlink.core.numerics.arrays import Points, Reals

_GRID = 17
_STRETCH = 8
_COARSE = 8
_PAIRS = 1 << 14


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
        start, end : float [rad] - range of cam angles; a whole revolution by default
        closed : bool - the profile closes from end to start
        samples : int - cam angles tried before the deepest place is refined
    Returns
        undercut : Undercut - depth below about 1e-12 of the cam's size means none
    Notes
        Distances are taken only between stretches of both curves whose circles come near enough. A far cut
        shallower than h^2/(8 r_g), h the step along the pitch curve, may pass (0.2 um for a 300 mm cam, 30 mm
        roller and 4096 samples); the onset of a swallowtail is found earlier by the curvature (see
        least_convex_radius).
    Example
        >>> circle = lambda phi: (50 * np.exp(-1j * phi), 30 * np.exp(-1j * phi))
        >>> undercut(circle, 20.0).depth < 1e-12
        True

    Source
        own derivation: |C(phi) - P(t)| >= r_g for a machinable profile
    """
    phi = np.linspace(start, end, samples)
    worst, cutting, least = nearest(*points(phi))
    at, by = float(phi[worst]), float(phi[cutting])
    if least < roller_radius * (1.0 - 1e-12):
        at, by, least = _deepest(points, at, by, float(phi[1] - phi[0]), (start, end), closed)
    return Undercut(max(0.0, roller_radius - least), at, by)


def nearest(pitch: Points, profile: Points) -> tuple[int, int, float]:
    """The profile point and the pitch point that come nearest to each other, and their distance.

    Two stretches of `_STRETCH` points each are no nearer than their centres less the radii about these; all points are
    compared where that is not more than the least distance of points of the same cam angle, stretches where it is not
    of `_COARSE` of them. scipy's k-d tree finds the same, but to import it takes ten times as long as all of this.

    Raises
        ValueError - where a point is not finite
    """
    known = float(np.abs(profile - pitch).min())
    if not math.isfinite(known):
        raise ValueError("the points of pitch curve and profile must be finite")
    of_pitch, of_profile = _in_stretches(pitch, _STRETCH), _in_stretches(profile, _STRETCH)
    rows, columns = _near(_circles(of_profile), _circles(of_pitch), known)
    found, last = (math.inf, 0, 0), len(pitch) - 1
    for start in range(0, len(rows), _PAIRS):
        some = slice(start, start + _PAIRS)
        gaps = np.abs(of_profile[rows[some]][:, :, None] - of_pitch[columns[some]][:, None, :])
        pair, i, j = np.unravel_index(int(np.argmin(gaps)), gaps.shape)
        at, by = int(_STRETCH * rows[some][pair] + i), int(_STRETCH * columns[some][pair] + j)
        found = min(found, (float(gaps[pair, i, j]), min(last, at), min(last, by)))
    least, at, by = found
    return at, by, least


def _in_stretches(points: NDArray[Any], size: int) -> NDArray[Any]:
    """The points in rows of so many, the last filled up with its last point."""
    missing = -len(points) % size
    return np.concatenate((points, np.repeat(points[-1:], missing))).reshape(-1, size)


_Circles: TypeAlias = tuple[Points, Reals]


def _circles(stretches: Points, radii: Reals | float = 0.0) -> _Circles:
    """Centre and radius of a circle about each stretch of points, or of circles with their radii."""
    centres = stretches.mean(axis=1)
    return centres, (np.abs(stretches - centres[:, None]) + radii).max(axis=1)


def _near(one: _Circles, other: _Circles, most: float) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Pairs of circles that are no farther apart; first of circles about some of them each."""
    (centre, radius), (to, reach) = one, other
    rounding = 1e-14 * float(np.abs(to).max() + reach.max() + most)
    about = [_circles(_in_stretches(c, _COARSE), _in_stretches(r, _COARSE)) for c, r in (one, other)]
    (wide, wide_radius), (far, far_radius) = about
    rows, columns = np.nonzero(np.abs(wide[:, None] - far) - wide_radius[:, None] - far_radius <= most + 2.0 * rounding)
    within = np.arange(_COARSE)
    rows = (rows[:, None] * _COARSE + within).repeat(_COARSE, axis=1).ravel()
    columns = np.tile(columns[:, None] * _COARSE + within, (1, _COARSE)).ravel()
    there = (rows < len(centre)) & (columns < len(to))
    rows, columns = rows[there], columns[there]
    close = np.abs(centre[rows] - to[columns]) - radius[rows] - reach[columns] <= most + rounding
    return rows[close], columns[close]


def _deepest(
    points: Callable[[Reals], tuple[Points, Points]],
    at: float,
    by: float,
    reach: float,
    limits: tuple[float, float],
    closed: bool,
) -> tuple[float, float, float]:
    """Minimum |C(phi) - P(t)| around a first guess, on grids that shrink by half."""
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
