"""The offset slider-crank in motion: one turn of the crank, counter-clockwise."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.figures import style
from gearlink.cli.scenes.scene import (
    TURN,
    Body,
    Chain,
    Chart,
    Curve,
    Line,
    Mark,
    Points,
    Readout,
    Reals,
    Scene,
    fixed_circle,
    loop,
    pale,
    track,
)
from gearlink.core.linkages.slider_crank_sweep import slider

if TYPE_CHECKING:
    from gearlink.core.linkages.slider_crank_design import SliderCrankDesign


def build(design: SliderCrankDesign, fraction: Reals) -> Scene:
    """Positions over fractions of the loop, from the crank's level place on."""
    part, psi = design.slider_crank, TURN * fraction
    crank, rod, offset = part.crank_length, part.rod, part.offset
    depth = slider(psi, crank, rod, offset, 1)
    whole = slider(TURN * loop(721), crank, rod, offset)[0]
    d, e = track(0.0, fraction), crank * np.exp(1j * psi)
    f = -offset - 1j * depth[0]
    ways = Line(points=-offset - 1j * np.array([whole.min() - 0.15 * rod, whole.max() + 0.15 * rod]), color=style.GREY)
    dead = [
        Line(points=-offset - 1j * place + 0.11 * rod * np.array([-1.0, 1.0]), color=style.GREY, dashed=True)
        for place in (whole.min(), whole.max())
    ]
    curve = Curve(label="slider", color=style.BLUE, y=whole[::4], now=depth[0])
    return Scene(
        parts=(
            ways,
            *dead,
            fixed_circle(0j, crank, style.GREY, dashed=True),
            block(f, 0.16 * rod, 0.2 * rod, style.BLUE),
            Chain(joints=(d, e, f), color=style.BLACK),
        ),
        marks=(Mark(point=d, text="D", pivot=True), Mark(point=e, text="E"), Mark(point=f, text="F")),
        chart=Chart(
            xlabel="crank angle [deg]",
            ylabel="depth of the slider [mm]",
            x=360.0 * loop(),
            now=np.degrees(psi),
            curves=(curve,),
        ),
        readouts=(
            Readout(label="crank", unit="°", values=np.degrees(psi)),
            Readout(label="depth", unit=" mm", values=depth[0]),
            Readout(label="speed", unit=" mm/rad", values=depth[1]),
        ),
    )


def block(place: Points, width: float, height: float, color: str, label: str = "") -> Body:
    """A rectangle about a moving point."""
    corners = 0.5 * np.array([-width - 1j * height, width - 1j * height, width + 1j * height, -width + 1j * height])
    return Body(
        outline=np.append(corners, corners[0]),
        place=place,
        turn=np.zeros(len(place)),
        color=color,
        fill=pale(color),
        label=label,
    )
