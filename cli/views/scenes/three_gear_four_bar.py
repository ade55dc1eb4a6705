"""The three-gear four-bar: one revolution of the crank."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.scenes.colors import BLUE, DWELL, GREEN, ORANGE, STEP
from gearlink.cli.views.scenes.gears import gear
from gearlink.cli.views.scenes.linkages import Joints, coupler_windings, crank_readout, over_crank, whole_turn
from gearlink.cli.views.scenes.scene import TURN, Band, Curve, Readout, Reals, Scene, bands, fixed_circle
from gearlink.core.machines.three_gear.mechanism import OUTPUT
from gearlink.core.parts.gears.outline.mesh_geometry import driven_turn, ring_turn

if TYPE_CHECKING:
    from gearlink.core.machines.three_gear.design import ThreeGearFourBar


def build(design: ThreeGearFourBar, fraction: Reals) -> Scene:
    """Positions over fractions of the loop."""
    linkage, phi = design.linkage, TURN * fraction
    at = Joints.of(design.moving, phi)
    first, second = design.meshes.values()
    idler = _idler_turn(design, at.coupler, phi)
    output = _output_turn(design, at.rocker, idler)
    share = design.crank_teeth / design.idler_teeth
    idler_turns = coupler_windings(design.moving) * (1.0 + share) - share
    (now, rate), (whole, _) = (OUTPUT.rates(design.moving, angles, 1) for angles in (phi, whole_turn()))
    swept = np.degrees(now)
    ring = design.crank_teeth < 0
    crank_gear = gear(first, int(ring), at.b, phi, 1.0, BLUE, "1", f"gear 1, crank {_kind(design.crank_teeth)}")
    return Scene(
        parts=(
            *gear(
                second,
                1,
                at.d,
                output,
                design.mean_ratio,
                ORANGE,
                "5",
                f"gear 5, output {_kind(design.output_teeth)}",
                design.outer_rim("idler_output"),
            ),
            *(crank_gear if ring else ()),
            *gear(first, 0 if ring else 1, at.c, idler, idler_turns, GREEN, "3", "gear 3, idler"),
            *(() if ring else crank_gear),
            fixed_circle(0j, linkage.crank, "path of the crank pin B"),
            at.chain(),
        ),
        marks=at.marks(),
        chart=over_crank(
            phi, (Curve("output", ORANGE, np.degrees(whole), swept),), "output angle [deg]", _bands(design)
        ),
        readouts=(crank_readout(phi), Readout("output", "°", swept), Readout("speed ratio", "", rate)),
    )


def _bands(design: ThreeGearFourBar) -> tuple[Band, ...]:
    """The dwell within a tolerance; phi13 where the file asks for that angle, or there is no other; the back-step."""
    found, wish = [], design.spec.dwell
    by_angle = wish is not None and wish.angle is not None
    by_angle &= design.spec.dwell_tolerance is None and design.spec.dwell_backlash is None
    if design.tolerance_dwell is not None and not by_angle:
        start, width = design.tolerance_dwell.start, design.tolerance_dwell.crank_angle
        found.append(("dwell", math.degrees(start), math.degrees(start + width), DWELL))
    elif design.back_step is not None and design.dwell_angle is not None:
        start = design.back_step.start
        found.append(("dwell", math.degrees(start), math.degrees(start + design.dwell_angle), DWELL))
    if design.back_step is not None:
        step = design.back_step
        found.append(("back-step", math.degrees(step.start), math.degrees(step.start + step.crank_angle), STEP))
    return bands(found)


def _kind(teeth: int) -> str:
    return "ring gear" if teeth < 0 else "gear"


def _idler_turn(design: ThreeGearFourBar, coupler: Reals, phi: Reals) -> Reals:
    """Direction of the idler's first tooth space [rad]; a ring on the crank has a tooth where a gear has a space."""
    crank, idler = design.crank_teeth, design.idler_teeth
    return coupler - crank / idler * (phi - coupler) if crank < 0 else driven_turn((crank, idler), coupler, phi)


def _output_turn(design: ThreeGearFourBar, rocker: Reals, idler: Reals) -> Reals:
    """Direction of the output gear's first tooth space, or of a tooth of the ring [rad]."""
    second = design.idler_teeth, abs(design.output_teeth)
    return ring_turn(second, rocker, idler) if design.output_teeth < 0 else driven_turn(second, rocker + math.pi, idler)
