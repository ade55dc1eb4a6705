"""The offset slider-crank: one turn of the crank, counter-clockwise from its level place; the slider runs below."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.scenes.colors import BLUE, GREEN, GREY, ORANGE, pale
from gearlink.cli.views.scenes.linkages import crank_readout, over_crank
from gearlink.cli.views.scenes.scene import (
    TURN,
    Body,
    Chain,
    Curve,
    Line,
    Part,
    Points,
    Readout,
    Reals,
    Scene,
    block,
    circle,
    fixed_circle,
    letters,
    loop,
)
from gearlink.core.machines.slider_crank.mechanism import DEPTH

if TYPE_CHECKING:
    from gearlink.core.machines.slider_crank.design import SliderCrankDesign


def _racks(design: SliderCrankDesign, psi: Reals) -> list[Part]:
    """Pinion and both racks, as their pitch circles and lines with a back."""
    drive = design.rack_drive
    if drive is None:
        return []
    links, (fixed, moving) = design.moving.at(psi, 0).links, drive.radii
    pinion, rack = links["pinion"], links["rack"]
    whole = DEPTH.rates(design.moving, TURN * loop(361), 0)[0]
    still, module = np.zeros_like(psi), drive.given.module
    found: list[Part] = []
    for radius in sorted({fixed, moving}, reverse=True):
        outline = np.concatenate([[0.0], circle(radius)])
        found.append(Body(outline=outline, place=pinion.origin.value, turn=pinion.turn.value, color=ORANGE,
                          fill=pale(ORANGE, 0.25), name="pinion"))  # fmt: skip
    x, low, high = -design.slider_crank.offset + fixed, -whole.max() - moving, -whole.min() + moving
    found.append(Body(outline=_bar(x, low, high, 3.0 * module), place=0.0 * pinion.origin.value, turn=still,
                      color=GREY, fill=pale(GREY, 0.3), name="fixed rack"))  # fmt: skip
    # the moving rack is touched beside the rod end, which it outruns
    touched = (drive.stroke_ratio - 1.0) * whole
    outline = _bar(0.0, touched.min() - moving, touched.max() + moving, -3.0 * module * drive.side)
    found.append(Body(outline=outline, place=rack.origin.value, turn=still, color=GREEN, fill=pale(GREEN, 0.3),
                      name="moving rack"))  # fmt: skip
    return found


def _bar(x: float, low: float, high: float, back: float) -> Points:
    """A closed bar along y, its pitch line at x."""
    return np.array([x + 1j * low, x + 1j * high, x + back + 1j * high, x + back + 1j * low, x + 1j * low])


def build(design: SliderCrankDesign, fraction: Reals) -> Scene:
    """Positions over fractions of the loop."""
    part, psi = design.slider_crank, TURN * fraction
    crank, rod, offset = part.crank_length, part.rod, part.offset
    depth = DEPTH.rates(design.moving, psi, 1)
    whole = DEPTH.rates(design.moving, TURN * loop(721), 0)[0]
    links = design.moving.at(psi, 1).links
    d, e, f = (links[name].origin.value for name in ("crank", "rod", "slider"))
    size = min(0.2 * rod, max(1.5 * float(np.ptp(whole)), 0.05 * rod))  # beside a short stroke no block that hides it
    ways = np.array([whole.min() - 0.15 * rod, whole.max() + 0.15 * rod])
    dead = [-offset - 1j * place + 0.11 * rod * np.array([-1.0, 1.0]) for place in (whole.min(), whole.max())]
    return Scene(
        parts=(
            Line(points=-offset - 1j * ways),
            *(Line(points=points, dashed=True) for points in dead),
            fixed_circle(0j, crank),
            block(f, 0.8 * size, size, BLUE),
            *_racks(design, psi),
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
