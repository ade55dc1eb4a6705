"""The four-bar linkage over arrays of lengths and crank angles: many linkages, each at its own position.

For one linkage at many positions `core.parts.linkages.fourbar.sweep` is faster; this one carries unit vectors, so
any of the four lengths may differ from one element to the next.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from gearlink.core.numerics.arrays import Points, Reals
from gearlink.core.parts.linkages.fourbar.sweep import dead_point_distance


def _not_asked() -> Reals:
    return np.empty(0)


@dataclass(frozen=True, slots=True)
class Lengths:
    """Lengths of many linkages, (N,) arrays or floats [mm], and the side on which they are assembled."""

    crank: Reals
    coupler: Reals
    rocker: Reals
    frame: Reals
    assembly: int = 1

    def part(self, chosen: Any) -> Lengths:
        """Some of the linkages."""
        size = np.broadcast(self.crank, self.coupler, self.rocker, self.frame).shape
        a, b, c, d = (
            np.broadcast_to(length, size)[chosen] for length in (self.crank, self.coupler, self.rocker, self.frame)
        )
        return Lengths(a, b, c, d, self.assembly)


@dataclass(frozen=True, slots=True)
class Places:
    """Directions of coupler and rocker as unit vectors, and their rates with respect to the crank angle.

    Rates beyond the order asked for are empty arrays. A linkage that does not close has NaN.
    """

    coupler: Points
    rocker: Points
    coupler_velocity: Reals = field(default_factory=_not_asked)
    rocker_velocity: Reals = field(default_factory=_not_asked)
    coupler_acceleration: Reals = field(default_factory=_not_asked)
    rocker_acceleration: Reals = field(default_factory=_not_asked)
    coupler_jerk: Reals = field(default_factory=_not_asked)
    rocker_jerk: Reals = field(default_factory=_not_asked)


def solve(links: Lengths, crank_angle: Reals, order: int = 0) -> Places:
    """Close each loop at its crank angle.

    a e1 + b e2 = d + c e3, and its derivatives, crossed with e2 and with e3

    Parameters
        links : Lengths - (N,)
        crank_angle : (N,) array [rad]
        order : 0..3 - rates that are wanted
    Returns
        places : Places
    Notes
        Agrees with `core.parts.linkages.fourbar.position` to a few ulp times the condition number 1/sin(t2 - t3).
    Example
        >>> links = Lengths(np.array([18.0, 18.5]), np.array([50.0]), np.array([100.0]), np.array([121.4]))
        >>> np.degrees(np.angle(solve(links, np.zeros(2)).rocker)).round(6).tolist()
        [151.60249, 151.513737]

    Source
        thesis (4-26)..(4-33), as vectors
    """
    e1 = _direction(crank_angle)
    line = links.frame - links.crank * e1
    length = np.abs(line)
    with np.errstate(invalid="ignore", divide="ignore"):
        along = 0.5 * (length + (links.coupler - links.rocker) * ((links.coupler + links.rocker) / length))
        across = links.assembly * np.sqrt((links.coupler - along) * (links.coupler + along))
        knee = (along + 1j * across) * (line / length)
        e2, e3 = knee / links.coupler, (knee - line) / links.rocker
        return _rates(links, e1, e2, e3, order)


def _direction(angle: Reals) -> Points:
    """exp(i angle) by the half-angle tangent, which numpy computes ten times as fast as a sine."""
    half = np.tan(0.5 * np.asarray(angle))
    share = 1.0 / (1.0 + half * half)
    found = np.empty(half.shape, dtype=complex)
    found.real, found.imag = (1.0 - half * half) * share, 2.0 * half * share
    return found


def _rates(links: Lengths, e1: Points, e2: Points, e3: Points, order: int) -> Places:
    if order == 0:
        return Places(e2, e3)
    a, b, c = links.crank, links.coupler, links.rocker
    angle = e2 * np.conj(e3)  # of the coupler from the rocker: cos + i sin
    from_rocker, from_coupler = e1 * np.conj(e3), e1 * np.conj(e2)
    to_coupler, to_rocker = 1.0 / (b * angle.imag), 1.0 / (c * angle.imag)
    w2, w3 = -a * from_rocker.imag * to_coupler, -a * from_coupler.imag * to_rocker
    if order == 1:
        return Places(e2, e3, w2, w3)
    square2, square3 = b * w2 * w2, c * w3 * w3
    g2 = (square3 - a * from_rocker.real - square2 * angle.real) * to_coupler
    g3 = (square3 * angle.real - a * from_coupler.real - square2) * to_rocker
    if order == 2:
        return Places(e2, e3, w2, w3, g2, g3)
    mixed2, mixed3 = 3.0 * b * w2 * g2, 3.0 * c * w3 * g3
    j2 = w2**3 + (a * from_rocker.imag - mixed2 * angle.real + mixed3) * to_coupler
    j3 = w3**3 + (a * from_coupler.imag - mixed2 + mixed3 * angle.real) * to_rocker
    return Places(e2, e3, w2, w3, g2, g3, j2, j3)


def least_transmission_angle(crank: Reals, coupler: Reals, rocker: Reals, frame: Reals) -> Reals:
    """Least transmission angle over the turn [rad], as `FourBar.min_transmission_angle`; NaN where the crank stops.

    tan^2(gamma/2) = (x - (b - c))(x + (b - c))/((b + c - x)(b + c + x)),   x = |d - a| and d + a

    Example
        >>> lengths = (np.array([x]) for x in (18.0, 50.0, 100.0, 121.4))
        >>> np.degrees(least_transmission_angle(*lengths)).round(6).tolist()
        [46.113185]
    """
    found = []
    for apart in (np.abs(frame - crank), frame + crank):
        q = (apart - (coupler - rocker)) * (apart + (coupler - rocker))
        p = (coupler + rocker - apart) * (coupler + rocker + apart)
        found.append(dead_point_distance(2.0 * np.arctan2(np.sqrt(q), np.sqrt(p))))
    return np.asarray(np.minimum(*found))
