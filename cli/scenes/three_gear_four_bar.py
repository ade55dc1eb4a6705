"""The three-gear four-bar in motion: one turn of the crank."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.figures import style
from gearlink.cli.scenes.gears import gear
from gearlink.cli.scenes.scene import TURN, Chain, Chart, Curve, Mark, Readout, Reals, Scene, fixed_circle, loop, track
from gearlink.core.gears.mesh_phase import driven_turn
from gearlink.core.linkages import fourbar_sweep
from gearlink.core.three_gear.sweep import output_motion

if TYPE_CHECKING:
    from gearlink.core.three_gear.design import ThreeGearFourBar


def build(design: ThreeGearFourBar, fraction: Reals) -> Scene:
    """Positions over fractions of the loop."""
    linkage, phi = design.linkage, TURN * fraction
    state = fourbar_sweep.solve(linkage, phi)
    a, d = track(0.0, fraction), track(linkage.frame, fraction)
    b = linkage.crank * np.exp(1j * phi)
    c = linkage.frame + linkage.rocker * np.exp(1j * state.rocker_angle)
    first, second = design.meshes.values()
    idler = driven_turn(first.teeth, state.coupler_angle, phi)
    output = driven_turn(second.teeth, state.rocker_angle + math.pi, idler)
    turns = fourbar_sweep.solve(linkage, np.array([0.0, TURN]))
    wound = float(np.diff(turns.coupler_angle)[0]) / TURN
    idler_turns = wound * (1.0 + first.teeth[0] / first.teeth[1]) - first.teeth[0] / first.teeth[1]
    return Scene(
        parts=(
            fixed_circle(0j, linkage.crank, style.GREY, dashed=True),
            *gear(second, 1, d, output, design.mean_ratio, style.ORANGE, "5"),
            *gear(first, 1, c, idler, idler_turns, style.GREEN, "3"),
            *gear(first, 0, b, phi, 1.0, style.BLUE, "1"),
            Chain(joints=(a, b, c, d), color=style.BLACK),
        ),
        marks=(
            Mark(point=a, text="A", pivot=True),
            Mark(point=b, text="B"),
            Mark(point=c, text="C"),
            Mark(point=d, text="D", pivot=True),
        ),
        chart=_chart(design, phi),
        readouts=_readouts(design, phi),
    )


def _chart(design: ThreeGearFourBar, phi: Reals) -> Chart:
    whole = output_motion(design.linkage, design.train, TURN * loop())
    now = output_motion(design.linkage, design.train, phi)
    curve = Curve(
        label="output", color=style.ORANGE, y=np.degrees(whole.output_angle), now=np.degrees(now.output_angle)
    )
    return Chart(
        xlabel="crank angle [deg]",
        ylabel="output angle [deg]",
        x=360.0 * loop(),
        now=np.degrees(phi),
        curves=(curve,),
    )


def _readouts(design: ThreeGearFourBar, phi: Reals) -> tuple[Readout, ...]:
    now = output_motion(design.linkage, design.train, phi)
    return (
        Readout(label="crank", unit="°", values=np.degrees(phi)),
        Readout(label="output", unit="°", values=np.degrees(now.output_angle)),
        Readout(label="speed ratio", unit="", values=now.speed_ratio),
    )
