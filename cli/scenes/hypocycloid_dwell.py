"""The dwell on an arc of a hypocycloid in motion: one turn of the carrier."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.figures import style
from gearlink.cli.scenes.gears import gear
from gearlink.cli.scenes.scene import (
    TURN,
    Chain,
    Chart,
    Curve,
    Line,
    Mark,
    Points,
    Readout,
    Reals,
    Scene,
    loop,
    standing,
    track,
)
from gearlink.cli.scenes.slider_crank import block
from gearlink.core.gears.mesh_phase import ring_turn

if TYPE_CHECKING:
    from gearlink.core.dwell_gears.hypocycloid_design import HypocycloidDwell


def build(design: HypocycloidDwell, fraction: Reals) -> Scene:
    """Positions over fractions of the loop, from mid-dwell on."""
    t = TURN * fraction
    a, b = track(0.0, fraction), design.carrier_length * np.exp(1j * t)
    m, inwards = _points(design, t), _inwards(design, t)
    rest = design.slider.point(0.0).real + design.slider.rod
    f = track(rest - inwards, fraction)
    planet, ring = design.mesh.teeth
    turn = ring_turn((ring, planet), t, np.zeros_like(t))
    whole = _inwards(design, TURN * loop())
    way = Line(points=rest - np.array([whole.min(), whole.max()]) + 0j, color=style.GREY, width=1.5)
    size = 0.5 * design.point_radius
    return Scene(
        parts=(
            *gear(design.mesh, 1, a, np.zeros_like(t), 0.0, style.ORANGE, ""),
            *gear(design.mesh, 0, b, turn, 1.0 - ring / planet, style.BLUE, "2"),
            standing(_points(design, TURN * loop(361)), fraction, style.GREEN),
            way,
            block(f, 1.6 * size, size, style.BLACK),
            Chain(joints=(a, b, m), color=style.BLUE),
            Chain(joints=(m, f), color=style.BLACK),
        ),
        marks=(
            Mark(point=a, text="A", pivot=True),
            Mark(point=b, text="B"),
            Mark(point=m, text="M"),
            Mark(point=f, text="F"),
        ),
        chart=Chart(
            xlabel="carrier angle [deg]",
            ylabel="slider, inwards from mid-dwell [mm]",
            x=360.0 * loop(),
            now=np.degrees(t),
            curves=(Curve(label="slider", color=style.BLUE, y=whole, now=inwards),),
        ),
        readouts=(
            Readout(label="carrier", unit="°", values=np.degrees(t)),
            Readout(label="slider", unit=" mm", values=inwards),
        ),
    )


def _points(design: HypocycloidDwell, t: Reals) -> Points:
    return np.array([design.slider.point(angle) for angle in t.tolist()])


def _inwards(design: HypocycloidDwell, t: Reals) -> Reals:
    return np.array([design.slider.deviation(angle) for angle in t.tolist()])
