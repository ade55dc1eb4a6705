"""Instant centres of a three-gear four-bar: P13, P35 where its gears roll, P15 on the line of the shafts.

P13 = B + r_1/(r_1 + r_3) (C - B),  P35 = C + r_3/(r_3 + r_5) (D - C), a ring's radius negative; the line through both
meets AD in P15, and W = AP15/DP15. In a standstill A, F = P13 and E = P35 lie in line.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from gearlink.core.base.report import without_noise
from gearlink.core.machines.three_gear.mechanism import rolling

if TYPE_CHECKING:
    from gearlink.core.machines.three_gear.design import ThreeGearFourBar
    from gearlink.core.numerics.arrays import Points, Reals


_SIZE = 64.0
"""Frames: rounding of places, and of the standstills themselves, is that of some lengths."""


class Poles(NamedTuple):
    """At crank angles: P13, P35, their joints B and C, and the place of P15 on AD, NaN at infinity [mm]."""

    first: Points
    second: Points
    crank_pin: Points
    idler_pin: Points
    on_frame: Reals


def poles(design: ThreeGearFourBar, phi: Reals) -> Poles:
    """The poles at crank angles [rad].

    Source
        thesis figures 4-9, 4-10
    """
    links = design.moving.at(phi, 0).links
    b, c = links["coupler"].origin.value, links["rocker"].at("C").value
    (r1, r3, _), (r3_out, r5, _) = rolling(design)
    first = b + r1 / (r1 + r3) * (c - b)
    second = c + r3_out / (r3_out + r5) * (design.frame_length - c)
    way = second - first
    with np.errstate(divide="ignore", invalid="ignore"):
        place = first.real - first.imag * way.real / way.imag
    known = ~np.isnan(design.pole_places(phi))
    return Poles(first, second, b, c, np.where(known, place, np.nan))


def columns(design: ThreeGearFourBar, degrees: Reals) -> dict[str, tuple[Any, str]]:
    """The table `poles`."""
    phi = np.radians(degrees)
    found = poles(design, phi)
    speed = design.moving.at(phi, 1).links["output"].turn.first
    return {
        "crank_angle": (degrees, "deg"),
        "P13_x": (found.first.real, "mm"),
        "P13_y": (found.first.imag, "mm"),
        "P35_x": (found.second.real, "mm"),
        "P35_y": (found.second.imag, "mm"),
        "P15_x": (found.on_frame, "mm"),
        "P15_y": (np.zeros_like(phi), "mm"),
        "speed_ratio": (speed, "1"),
    }


def line_errors(design: ThreeGearFourBar) -> list[float]:
    """Distance of A from the line of P13 and P35 in each standstill, which must be 0 [mm]."""
    phi = np.array(design.dwell_crank_angles, dtype=np.float64)
    if not phi.size:
        return []
    found = poles(design, phi)
    way = found.second - found.first
    apart = np.abs((np.conj(way) * found.first).imag) / np.abs(way)
    return [without_noise(float(each), _SIZE * design.frame_length) for each in apart]
