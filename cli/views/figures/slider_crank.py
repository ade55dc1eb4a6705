"""Scene and sheet of a slider-crank: dead centres and a position between; travel, velocity, transmission angle.

The scene is one revolution of the crank, counter-clockwise from its level position; the slider runs below.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.figures.drawing import linkage, panels, scene_axes, style, time_axes
from gearlink.cli.views.scenes.linkages import crank_readout, over_crank
from gearlink.cli.views.scenes.scene import (
    BLUE,
    GREEN,
    GREY,
    ORANGE,
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
    pale,
)
from gearlink.core.machines.slider_crank.mechanism import DEPTH
from gearlink.core.parts.linkages.slider_crank import slider_sweep

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

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


_TURN = 2.0 * math.pi
_SMALL = 1.0 / 12.0
"""Of the rod: a shorter crank is drawn a second time, magnified."""


def draw(command: str, design: SliderCrankDesign) -> Figure:
    """The sheet of a command on a slider-crank."""
    figure = panels.page(f"{design.spec.name}: {command}", 0.8)
    grid = figure.add_gridspec(3, 2, width_ratios=[1.0, 1.15], height_ratios=[1.0, 1.0, 0.75])
    mechanism(figure.add_subplot(grid[:, 0]), design)
    travel, velocity, transmission = (figure.add_subplot(grid[row, 1]) for row in range(3))
    motion(travel, velocity, design)
    table = linkage.columns(design, "motion")
    linkage.transmission(transmission, design, table["input_angle"], table["transmission_angle"])
    time_axes.over_input(transmission, time_axes.turn_time(design))
    return figure


def dead_centers(design: SliderCrankDesign) -> tuple[float, float]:
    """Directions of the crank at the folded and at the stretched dead centre [rad], the second after the first."""
    folded = 0.5 * math.pi - design.slider_crank.dead_center_folded
    return folded, 1.5 * math.pi - design.slider_crank.dead_center_extended


def mechanism(axes: Axes, design: SliderCrankDesign) -> None:
    """Both dead centres and the position half-way, with stroke and offset."""
    part, (folded, extended) = design.slider_crank, dead_centers(design)
    panels.drawing(axes, f"Crank {part.crank_length:.6g}, rod {part.rod:.6g}")
    scene = build(design, np.array([0.5 * (folded + extended), folded, extended]) / _TURN)
    ahead = build(design, np.array([0.5 * (folded + extended) / _TURN + scene_axes.AHEAD]))
    scene_axes.draw(axes, scene, ahead=ahead)
    angles = part.dead_center_folded, part.dead_center_extended
    for i, (name, color, angle) in enumerate(
        zip(("folded", "stretched"), (style.ORANGE, style.BLUE), angles, strict=True), 1
    ):
        words = f"{name}, rod at {style.number(math.degrees(angle), 5)}° to the slide line"
        scene_axes.lightly(axes, scene, i, color, words)
    axes.plot([], [], color=style.BLACK, linewidth=2.4, label="half-way in crank angle")
    near, far = (complex(point) for point in scene.marks[2].point[1:])
    _dimensions(axes, design, near, far)
    if part.crank_length < _SMALL * part.rod:
        _crank_alone(axes, scene, ahead, part.crank_length)
    axes.margins(0.06)
    axes.autoscale_view()
    panels.legend_below(axes)


def _crank_alone(axes: Axes, scene: Scene, ahead: Scene, crank: float) -> None:
    """A crank that is short beside its rod, magnified beside the rod."""
    detail = axes.inset_axes((0.64, 0.38, 0.35, 0.24), zorder=9)
    scene_axes.draw(detail, scene, ahead=ahead)
    center = complex(scene.marks[0].point[0])
    way = center + crank * np.exp(1j * np.linspace(0.0, _TURN, 121))
    detail.plot(way.real, way.imag, color=style.GREY, linewidth=0.8, linestyle=style.DASHED)
    detail.set_aspect("equal")
    detail.set_xlim(center.real - 1.7 * crank, center.real + 1.7 * crank)
    detail.set_ylim(center.imag - 1.7 * crank, center.imag + 1.7 * crank)
    detail.set_title("crank,\nmagnified [mm]", loc="left", fontsize=7)
    detail.tick_params(labelsize=6, colors=style.GREY)
    detail.set_yticks([])  # to scale: numbers beside it would stand on the rod
    for text in detail.texts:
        text.set_clip_on(True)


def _dimensions(axes: Axes, design: SliderCrankDesign, near: complex, far: complex) -> None:
    """Stroke beside the dead centres, offset above the crank."""
    part, crank = design.slider_crank, design.slider_crank.crank_length
    aside = max(0.2 * part.rod, crank) if part.offset >= 0.0 else -max(0.2 * part.rod, crank)
    start, end = (complex(-part.offset - 1.1 * aside, point.imag) for point in (near, far))
    stroke = f"stroke {design.slider_crank.stroke:.6g} mm"
    style.dimension(axes, start, end, stroke, from_points=(near, far), upright=True)
    if part.offset:
        level = 1.25 * crank
        feet = (complex(-part.offset, level), complex(0.0, level))
        style.dimension(axes, *feet, f"offset {style.number(part.offset, scale=0.0)} mm", from_points=(near, 0j))


# The motion


def motion(travel: Axes, velocity: Axes, design: SliderCrankDesign) -> None:
    """Travel of the slider from its nearest place, velocity per crank speed, over the direction of the crank."""
    part, crank = design.slider_crank, design.slider_crank.crank_length
    folded, extended = (math.degrees(angle) % 360.0 for angle in dead_centers(design))
    degrees = np.unique(np.append(np.arange(721) * 0.5, (folded, extended)))
    depth, speed = slider_sweep(np.radians(degrees), crank, part.rod, part.offset, 1)
    panels.turn_panel(travel, "travel of the\nslider [mm]")
    panels.heading(travel, f"Travel, quick return {design.slider_crank.quick_return_ratio:.6g}")
    travel.plot(degrees, depth - depth.min(), color=style.BLUE, linewidth=1.7, gid="travel", label="slider")
    if design.rack_drive is not None:
        rack = design.rack_drive.stroke_ratio * (depth - depth.min())
        travel.plot(degrees, rack, color=style.GREEN, linewidth=1.7, label="rack")
        panels.legend_above(travel)
    panels.turn_panel(velocity, "velocity per crank\nspeed [mm/rad]")
    panels.heading(velocity, "Velocity")
    velocity.plot(degrees, speed, color=style.RED, linewidth=1.7, gid="velocity")
    velocity.axhline(0.0, color=style.BLACK, linewidth=0.8)
    time_axes.in_time(velocity, getattr(design, "angular_speed", None), 1, "m", 1e-3)
    for axes in (travel, velocity):
        for place, color in ((folded, style.ORANGE), (extended, style.BLUE)):
            axes.axvline(place, color=color, linewidth=0.9, linestyle=style.DASHED)
        axes.set_xticks(range(0, 361, 60))
        axes.margins(y=0.15)
    _phases(travel, folded, extended, design.slider_crank.stroke)
    for turning, above in zip(design.fastest, (True, False), strict=True):
        place = math.degrees(turning.place) % 360.0
        panels.extreme(velocity, place, turning.value, above=above, unit=" mm/rad")


def _phases(axes: Axes, folded: float, extended: float, stroke: float) -> None:
    """Crank angles of the stroke out and of the stroke back, which may pass the end of the turn."""
    out = (extended - folded) % 360.0
    for name, start, width in (("out", folded, out), ("back", extended, 360.0 - out)):
        parts = panels.Phase(name, start, start + width).within_turn()
        longest = max(parts, key=lambda part: part[1] - part[0])
        for left, right in parts:
            words = f"{name}: {width:.5g}°" if (left, right) == longest else ""
            style.dimension(axes, complex(left, -0.09 * stroke), complex(right, -0.09 * stroke), words, shift=(0, 2))
