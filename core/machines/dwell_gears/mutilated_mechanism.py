"""The mechanism of a mutilated gear: crank with the driven gear, coupler, rocker; the wheel turns evenly."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.machines.dwell_gears.mutilated_design import MutilatedGear
from gearlink.core.mechanism.courses import turned
from gearlink.core.mechanism.joints import Connection, Pin, ToothDrive
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.motion import TURN, Input, Motion, Output
from gearlink.core.mechanism.rates import Point, Rates, Turn, fixed
from gearlink.core.parts.linkages.fourbar.mechanism import four_bar, four_bar_pins

if TYPE_CHECKING:
    from gearlink.core.machines.dwell_gears.mutilated_design import MutilatedGearDwell
    from gearlink.core.numerics.arrays import Mask, Reals
    from gearlink.core.studies.movable import Movable


def errors(design: MutilatedGearDwell, mechanism: Mechanism) -> Movable:
    """The links of the four-bar, the angle at which it starts, and the runout of the driven gear."""
    from gearlink.core.mechanism.dual import Shift, longer
    from gearlink.core.studies.movable import Movable, Turned
    from gearlink.core.studies.tolerance.sources import GearOfSource

    bar, gears = design.linkage, design.spec.gears
    diameter = gears.module * design.driven_teeth
    driven = GearOfSource(gears.module, diameter, math.radians(gears.pressure_angle))
    found = {"driven": Turned("crank", driven)}
    if bar is None:
        return Movable(gears=found, radius=0.5 * diameter)
    ends = {f"links.{name}": (name, getattr(bar, name)) for name in ("crank", "coupler", "rocker")}
    sizes = longer(mechanism, ends | {"links.frame": (FRAME, bar.frame)})
    sizes["start_angle"] = (Shift("crank", ("B",), math.radians(1.0), turned=True),)
    return Movable(sizes, gears=found, radius=bar.rocker)


_NEAR = 8.0
"""Units in the last place by which a place may lie before the start of a motion and be it."""


def motion(design: MutilatedGearDwell) -> Motion:
    """Links and joints over the input angle; a motion begins at 0, and the driven gear's axis is at 0.

    Without the four-bar on its shaft the driven gear is alone.
    """
    linkage, start = design.linkage, design.start_crank_angle or 0.0
    ratio, section = design.mutilated.speed_ratio, design.spec.loads
    direction = math.radians((section.wheel_direction if section is not None else None) or 0.0)
    radius, tangent = design.mesh.working_radius[1], math.tan(design.mesh.working_pressure_angle)

    def make(phi: Reals, order: int, side: int) -> Mechanism:
        angle, moves = driven(design.mutilated, phi, side)
        rate = np.where(moves, ratio, 0.0)
        if linkage is None:
            still, even = fixed(0j, phi, order=order), [start + angle, np.ones_like(phi), *[np.zeros_like(phi)] * 2]
            links = {"crank": Link(still, Turn(*even[: order + 1]))}
        else:
            links = four_bar(linkage, start + angle, order)
        links = {
            name: Link(Point(*_by_input(link.origin, rate)), Turn(*_by_input(link.turn, rate)), link.points)
            for name, link in links.items()
        }
        axis = links["crank"].origin.value
        joints: list[Connection] = [Pin("A", FRAME, "crank", axis)] if linkage is None else [*four_bar_pins(links)]
        joints.append(ToothDrive("mesh_wheel", "crank", axis, cmath.rect(1.0, direction), radius, tangent, moves))
        return Mechanism(links, joints, "mesh_wheel", gain=radius * rate)

    outputs: tuple[Output, ...] = (Output("Driven gear", turned("crank").less(start)),)
    if linkage is not None:
        outputs = Output("Rocker CD", turned("rocker")), *outputs
    turns = design.cycle_turns * design.cycles_to_repeat
    return Motion(make, Input(end=TURN * turns, turns=None, joints=_joints(design)), outputs)


def _by_input(rates: Rates[Any], rate: Reals) -> list[Any]:
    """Derivatives by the driven gear's angle as those by the input, which drives it at a rate that stays."""
    return [each if k == 0 else each * rate**k for k, each in enumerate(rates)]


def _joints(design: MutilatedGearDwell) -> tuple[float, ...]:
    """Input angles at which a motion begins or ends, until wheel and linkage come home [rad]."""
    cycle, moved = TURN * design.cycle_turns, TURN * design.motion_turns
    return tuple(start for k in range(design.cycles_to_repeat) for start in (k * cycle, k * cycle + moved))


def driven(gear: MutilatedGear, phi: Reals, side: int = 1) -> tuple[Reals, Mask]:
    """Angle that the driven gear has turned since input angle 0, where a motion begins, and whether it moves.

    psi = k n/Z_F 2 pi + min(speed_ratio * rest, n/Z_F 2 pi),   k whole cycles

    Parameters
        phi : (N,) array [rad] - input angles
        side : +1 or -1 - just after them, or just before: it is then that a start or an end of the motion counts
    Returns
        psi, moves : (N,) arrays [rad], bool
    Notes
        A place that is the start or the end of a motion but for rounding is that.
    Example
        >>> psi, moves = driven(MutilatedGear(6.0, 80, 20, 1, 20), TURN * np.array([0.75, 3.0, 6.75]))
        >>> (psi / TURN).round(12).tolist(), moves.tolist()
        ([0.5, 1.0, 1.5], [True, False, True])
    """
    cycle, step, moved = TURN * gear.cycle_turns, TURN * gear.driven_turn, TURN * gear.motion_turns
    rest = np.mod(phi, cycle)
    near = _NEAR * np.spacing(np.maximum(np.abs(phi), cycle))
    rest = np.where(cycle - rest <= near, 0.0, rest)
    whole = np.round((phi - rest) / cycle)
    # Within a cycle the gear turns by one step, and then stands.
    angle = np.asarray(whole * step + np.minimum(gear.speed_ratio * rest, step))
    moves = rest < moved - near if side > 0 else (rest > near) & (rest <= moved + near)
    return angle, np.asarray(moves)
