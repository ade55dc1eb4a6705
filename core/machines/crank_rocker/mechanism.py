"""The mechanism of a crank-rocker: crank, coupler, rocker, and what their errors move."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from gearlink.core.mechanism.courses import turned
from gearlink.core.mechanism.dual import longer
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.motion import Course, Input, Motion, Output
from gearlink.core.parts.linkages.fourbar.mechanism import four_bar, four_bar_pins
from gearlink.core.studies.movable import Movable

if TYPE_CHECKING:
    from gearlink.core.machines.crank_rocker.design import CrankRocker
    from gearlink.core.numerics.arrays import Reals


def motion(design: CrankRocker) -> Motion:
    """Links and joints over the crank angle, A at 0 and D on +x: a revolution, or the range of the file."""
    linkage, span = design.linkage, design.crank_range
    point = design.coupler_point

    def make(phi: Reals, order: int, _side: int) -> Mechanism:
        links = four_bar(linkage, phi, order)
        if point is not None:
            coupler = links["coupler"]
            links["coupler"] = Link(coupler.origin, coupler.turn, {**coupler.points, "P": point})
        return Mechanism(links, [*four_bar_pins(links)], "crank")

    inputs = Input("crank_angle") if span is None else Input("crank_angle", start=span[0], end=span[1], turns=None)
    return Motion(make, inputs, (Output("Rocker CD", rocker(design)),))


def rocker(design: CrankRocker) -> Course:
    """Direction of the rocker from D to C, at the first crank angle in (-180, 180] deg [rad]."""
    first = design.state(0.0 if design.crank_range is None else design.crank_range[0]).rocker_angle
    turns = math.ceil((first - math.pi) / (2.0 * math.pi))
    return turned("rocker").less(2.0 * math.pi * turns) if turns else turned("rocker")


def errors(design: CrankRocker, mechanism: Mechanism) -> Movable:
    """The four links; the error is measured at the joint on the rocker where the file says nothing else."""
    bar = design.linkage
    ends = {f"links.{name}": (name, getattr(bar, name)) for name in ("crank", "coupler", "rocker")}
    return Movable(longer(mechanism, ends | {"links.frame": (FRAME, bar.frame)}), radius=bar.rocker)
