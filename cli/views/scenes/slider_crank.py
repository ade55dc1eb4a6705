"""The offset slider-crank: one turn of the crank, counter-clockwise from its level place; the slider runs below."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.scenes.colors import BLUE
from gearlink.cli.views.scenes.linkages import crank_readout, over_crank
from gearlink.cli.views.scenes.scene import (
    TURN,
    Chain,
    Curve,
    Line,
    Readout,
    Reals,
    Scene,
    block,
    fixed_circle,
    letters,
    loop,
)
from gearlink.core.machines.slider_crank.mechanism import DEPTH

if TYPE_CHECKING:
    from gearlink.core.machines.slider_crank.design import SliderCrankDesign


def build(design: SliderCrankDesign, fraction: Reals) -> Scene:
    """Positions over fractions of the loop."""
    part, psi = design.slider_crank, TURN * fraction
    crank, rod, offset = part.crank_length, part.rod, part.offset
    depth = DEPTH.rates(design.moving, psi, 1)
    whole = DEPTH.rates(design.moving, TURN * loop(721), 0)[0]
    links = design.moving.at(psi, 1).links
    d, e, f = (links[name].origin.value for name in ("crank", "rod", "slider"))
    ways = np.array([whole.min() - 0.15 * rod, whole.max() + 0.15 * rod])
    dead = [-offset - 1j * place + 0.11 * rod * np.array([-1.0, 1.0]) for place in (whole.min(), whole.max())]
    return Scene(
        parts=(
            Line(points=-offset - 1j * ways),
            *(Line(points=points, dashed=True) for points in dead),
            fixed_circle(0j, crank),
            block(f, 0.16 * rod, 0.2 * rod, BLUE),
            Chain(joints=(d, e, f)),
        ),
        marks=letters("D", D=d, E=e, F=f),
        chart=over_crank(psi, (Curve("slider", BLUE, whole[::4], depth[0]),), "depth of the slider [mm]"),
        readouts=(
            crank_readout(psi),
            Readout("depth", " mm", depth[0]),
            Readout("speed", " mm/rad", depth[1]),
        ),
    )
