"""The two-gear four-bar: one revolution of the crank."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.scenes.colors import BLUE, ORANGE, STEP
from gearlink.cli.views.scenes.gears import gear
from gearlink.cli.views.scenes.linkages import Joints, coupler_windings, crank_readout, over_crank, whole_turn
from gearlink.cli.views.scenes.scene import TURN, Band, Curve, Readout, Reals, Scene, bands, fixed_circle
from gearlink.core.machines.planet_linkages.mechanism import OUTPUT
from gearlink.core.parts.gears.outline.mesh_geometry import driven_turn, ring_turn

if TYPE_CHECKING:
    from gearlink.core.machines.planet_linkages.two_gear_design import TwoGearFourBar


def build(design: TwoGearFourBar, fraction: Reals) -> Scene:
    """Positions over fractions of the loop."""
    phi = TURN * fraction
    at = Joints.of(design.moving, phi)
    name = "gear 5, ring gear" if design.internal else "gear 5, sun"
    planet = gear(design.mesh, 0, at.b, at.coupler, coupler_windings(design.moving), BLUE, "2", "gear 2, planet on BC")
    rim = design.outer_rim()
    output = gear(design.mesh, 1, at.a, output_turn(design, phi), design.mean_ratio, ORANGE, "5", name, rim)
    swept, whole = (np.degrees(OUTPUT.rates(design.moving, angles, 0)[0]) for angles in (phi, whole_turn()))
    curve = Curve("output", ORANGE, whole, swept)
    return Scene(
        parts=(*output, *planet, fixed_circle(0j, design.crank_length), at.chain()),
        marks=at.marks(),
        chart=over_crank(phi, (curve,), "output angle [deg]", _bands(design)),
        readouts=(crank_readout(phi), Readout("output", "°", swept)),
    )


def output_turn(design: TwoGearFourBar, phi: Reals) -> Reals:
    """Direction of the output gear's first space, or of a tooth of the ring [rad]."""
    coupler = Joints.of(design.moving, phi).coupler
    teeth = design.planet_teeth, design.output_teeth
    return ring_turn(teeth, phi, coupler) if design.internal else driven_turn(teeth, phi + math.pi, coupler)


def _bands(design: TwoGearFourBar) -> tuple[Band, ...]:
    return bands(("back-step", math.degrees(step.start), math.degrees(step.end), STEP) for step in design.back_steps)
