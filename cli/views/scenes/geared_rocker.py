"""The geared rocker: one revolution of the crank."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.scenes.colors import BLACK, BLUE, ORANGE
from gearlink.cli.views.scenes.gears import gear
from gearlink.cli.views.scenes.linkages import Joints, coupler_windings, crank_readout, over_crank, whole_turn
from gearlink.cli.views.scenes.scene import TURN, Body, Curve, Readout, Reals, Scene, fixed_circle
from gearlink.core.parts.gears.outline.mesh_geometry import driven_turn

if TYPE_CHECKING:
    from gearlink.core.machines.planet_linkages.rocker_design import GearedRocker


def build(design: GearedRocker, fraction: Reals) -> Scene:
    """Positions over fractions of the loop; a hand on the output shows its swing."""
    phi = TURN * fraction
    at, output = Joints.of(design.moving, phi), _turn(design, phi)
    wound = coupler_windings(design.moving)
    reach = design.mesh.tip_radius[1]
    start, whole = _turn(design, np.zeros(1))[0], _turn(design, whole_turn())
    tip = np.array([0.0, 1.7 * reach * 1j])
    hand = Body(outline=tip, place=at.d, turn=output - start, color=ORANGE, width=5.0, name="hand on the output")
    rocker = Joints.of(design.moving, whole_turn()).rocker
    return Scene(
        parts=(
            *gear(design.mesh, 1, at.d, output, wound, ORANGE, "5", "gear 5, output"),
            *gear(design.mesh, 0, at.c, at.coupler, wound, BLUE, "2", "gear 2 on the coupler"),
            hand,
            fixed_circle(0j, design.crank_length),
            at.chain(),
        ),
        marks=at.marks(),
        chart=over_crank(
            phi,
            (
                Curve("output", ORANGE, np.degrees(whole - start), np.degrees(output - start)),
                Curve("rocker", BLACK, np.degrees(rocker - rocker[0]), np.degrees(at.rocker - rocker[0])),
            ),
            "angle from crank angle 0 [deg]",
        ),
        readouts=(crank_readout(phi), Readout("output", "°", np.degrees(output - start))),
    )


def _turn(design: GearedRocker, phi: Reals) -> Reals:
    at, teeth = Joints.of(design.moving, phi), design.mesh.teeth
    return driven_turn((teeth[0], teeth[1]), at.rocker + math.pi, at.coupler)
