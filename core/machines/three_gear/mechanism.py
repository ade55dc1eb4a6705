"""The mechanism of a three-gear four-bar: crank, coupler, rocker, idler on C, output gear on D; its instant centres.

P13 and P35 are where its gears roll, P15 is on the line of the shafts: the line through both meets AD in P15, and
W = AP15/DP15. In a standstill A, F = P13 and E = P35 lie in line.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from gearlink.core.mechanism.courses import between, turned
from gearlink.core.mechanism.joints import Mesh, Pin
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.motion import Input, Motion, Output
from gearlink.core.mechanism.rates import from_start, mixed
from gearlink.core.parts.linkages.fourbar.mechanism import four_bar, four_bar_pins
from gearlink.core.parts.linkages.fourbar.position import solve

if TYPE_CHECKING:
    from gearlink.core.machines.three_gear.design import ThreeGearFourBar
    from gearlink.core.numerics.arrays import Points, Reals


OUTPUT = turned("output")


def motion(design: ThreeGearFourBar) -> Motion:
    """Links and joints over the crank angle, A at 0 and D on +x; idler and output gear count from crank angle 0.

    th3 = i2 phi + (1 - i2) t2,   th5 = i3 th3 + (1 - i3) t3,   i2 = -z1/z3,  i3 = -z3/z5

    Source
        thesis (4-21), (4-22)
    """
    linkage, train, radii = design.linkage, design.train, design.rolling
    at_start = solve(linkage, 0.0)
    section = design.spec.loads
    holds_idler = "coupler" if section is None else section.idler_pin

    def make(phi: Reals, order: int, _side: int) -> Mechanism:
        links = four_bar(linkage, phi, order)
        b, d = links["coupler"], links["rocker"]
        coupler, rocker = from_start(b.turn, at_start.coupler_angle), from_start(d.turn, at_start.rocker_angle)
        idler = mixed((train.i2, links["crank"].turn), (1.0 - train.i2, coupler))
        pins = four_bar_pins(links)
        links["idler"] = Link(d.at("C"), idler)
        links["output"] = Link(d.origin, mixed((train.i3, idler), (1.0 - train.i3, rocker)))
        (r1, r3, flank), (r3_out, r5, flank_out) = radii
        return Mechanism(
            links,
            [
                *pins,
                Pin("C_idler", holds_idler, "idler", d.at("C").value),
                Pin("D_output", FRAME, "output", d.origin.value),
                Mesh("mesh_13", "crank", "idler", b.origin.value, b.unit, abs(r1), r3, flank, r1 < 0.0, "coupler"),
                Mesh("mesh_35", "output", "idler", d.origin.value, d.unit, abs(r5), r3_out, flank_out, r5 < 0.0,
                     "rocker"),
            ],
            "crank",
        )  # fmt: skip

    outputs = Output("Output gear 5", OUTPUT), Output("Rocker CD", turned("rocker"))
    return Motion(make, Input("crank_angle"), outputs, transmission=between("coupler", "rocker"))


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
    first, second = design.rolling_points(b, c)
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
