"""The two-gear four-bar in motion: one turn of the crank."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.figures import style
from gearlink.cli.scenes.gears import gear
from gearlink.cli.scenes.linkages import Joints, coupler_windings, crank_readout, over_crank, whole_turn
from gearlink.cli.scenes.scene import TURN, Curve, Readout, Reals, Scene, fixed_circle
from gearlink.core.gears.mesh_phase import driven_turn, ring_turn

if TYPE_CHECKING:
    from gearlink.core.planet_linkages.two_gear_design import TwoGearFourBar


def build(design: TwoGearFourBar, fraction: Reals) -> Scene:
    """Positions over fractions of the loop."""
    phi = TURN * fraction
    at = Joints.of(design.linkage, phi)
    planet = gear(design.mesh, 0, at.b, at.coupler, coupler_windings(design.linkage), style.BLUE, "2")
    output = gear(design.mesh, 1, at.a, output_turn(design, phi), design.mean_ratio, style.ORANGE, "5")
    swept = np.degrees(_output(design, phi))
    curve = Curve(label="output", color=style.ORANGE, y=np.degrees(_output(design, whole_turn())), now=swept)
    return Scene(
        parts=(*output, *planet, fixed_circle(0j, design.crank_length, style.GREY, dashed=True), at.chain()),
        marks=at.marks(),
        chart=over_crank(phi, (curve,), "output angle [deg]"),
        readouts=(crank_readout(phi), Readout(label="output", unit="°", values=swept)),
    )


def output_turn(design: TwoGearFourBar, phi: Reals) -> Reals:
    """Direction of the output gear's first space, or of a tooth of the ring [rad]."""
    coupler = Joints.of(design.linkage, phi).coupler
    teeth = design.mesh.teeth
    if design.internal:
        return ring_turn((teeth[0], teeth[1]), phi, coupler)
    return driven_turn((teeth[0], teeth[1]), phi + math.pi, coupler)


def _output(design: TwoGearFourBar, phi: Reals) -> Reals:
    return np.asarray(output_turn(design, phi) - output_turn(design, np.zeros(1))[0])
