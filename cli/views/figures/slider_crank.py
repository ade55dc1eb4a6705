"""Scene and sheet of a slider-crank: dead centres and a position between; travel, velocity, transmission angle.

The scene is one revolution of the crank, counter-clockwise from its level position; the slider runs below.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.figures.drawing import linkage, panels, scene_axes, style, time_axes
from gearlink.cli.views.scenes.of_motion import Positions, Seen
from gearlink.cli.views.scenes.scene import TURN, Line, Part, Points, Reals, Scene, block, circle, fixed_circle
from gearlink.core.machines.slider_crank.mechanism import DEPTH
from gearlink.core.mechanism.links import FRAME

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.machines.slider_crank.design import SliderCrankDesign


def _racks(design: SliderCrankDesign, here: Positions, whole: Reals) -> list[Part]:
    """Pinion and both racks, as their pitch circles and lines with a back.

    whole : (N,) array [mm] - depths of the slider over the revolution
    """
    drive = design.rack_drive
    if drive is None:
        return []
    fixed, moving = drive.radii
    discs = [
        here.body("pinion", np.concatenate([[0.0], circle(radius)]), style.ORANGE, name="pinion")
        for radius in sorted({fixed, moving}, reverse=True)
    ]
    x, low, high, back = -design.slider_crank.offset + fixed, -whole.max(), -whole.min(), 3.0 * drive.given.module
    touched = (drive.stroke_ratio - 1.0) * whole  # the moving rack is touched beside the rod end, which it outruns
    still = _bar(x, low - moving, high + moving, back)
    run = _bar(0.0, touched.min() - moving, touched.max() + moving, -back * drive.side)
    racks = ((FRAME, still, style.GREY, "fixed rack"), ("rack", run, style.GREEN, "moving rack"))
    return [*discs, *(here.body(link, bar, color, 0.3, name=name) for link, bar, color, name in racks)]


def _bar(x: float, low: float, high: float, back: float) -> Points:
    """A closed bar along y, its pitch line at x."""
    return np.array([x + 1j * low, x + 1j * high, x + back + 1j * high, x + back + 1j * low, x + 1j * low])


def build(design: SliderCrankDesign, fraction: Reals) -> Scene:
    """Positions over fractions of the loop."""
    part, here = design.slider_crank, Positions.of(design, fraction)
    crank, rod, offset = part.crank_length, part.rod, part.offset
    depth, rate = DEPTH.rates(here.motion, here.inputs, 1)
    whole = DEPTH.rates(here.motion, np.linspace(0.0, TURN, 721), 0)[0]
    size = min(0.2 * rod, max(1.5 * float(np.ptp(whole)), 0.05 * rod))  # beside a short stroke no block that hides it
    ways = np.array([whole.min() - 0.15 * rod, whole.max() + 0.15 * rod])
    dead = [-offset - 1j * place + 0.11 * rod * np.array([-1.0, 1.0]) for place in (whole.min(), whole.max())]
    return here.scene(
        (
            Line(points=-offset - 1j * ways),
            *(Line(points=points, dashed=True) for points in dead),
            fixed_circle(crank),
            block(here.at("slider"), 0.8 * size, size, style.BLUE),
            *_racks(design, here, whole),
            here.chain,
        ),
        {"slider": Seen(DEPTH, style.BLUE, "mm")},
        "depth of the slider [mm]",
        over="crank angle",
        values={"depth": (" mm", depth), "speed": (" mm/rad", rate)},
    )


_SMALL = 1.0 / 12.0
"""Of the rod: a shorter crank is drawn a second time, magnified."""


def draw(command: str, design: SliderCrankDesign) -> Figure:
    """The sheet of a command on a slider-crank."""
    figure = panels.page(f"{design.spec.name}: {command}", 0.8)
    grid = figure.add_gridspec(3, 2, width_ratios=[1.0, 1.15], height_ratios=[1.0, 1.0, 0.75])
    mechanism(figure.add_subplot(grid[:, 0]), design)
    travel, velocity, transmission = (figure.add_subplot(grid[row, 1]) for row in range(3))
    motion(travel, velocity, design)
    linkage.transmission(transmission, design)
    time_axes.over_input(transmission, time_axes.turn_time(design))
    return figure


def mechanism(axes: Axes, design: SliderCrankDesign) -> None:
    """Both dead centres and the position half-way, with stroke and offset."""
    part, (folded, extended) = design.slider_crank, (design.dead_center_folded_at, design.dead_center_extended_at)
    panels.drawing(axes, f"Crank {part.crank_length:.6g}, rod {part.rod:.6g}")
    scene = build(design, np.array([0.5 * (folded + extended), folded, extended]) / TURN)
    ahead = build(design, np.array([0.5 * (folded + extended) / TURN + scene_axes.AHEAD]))
    scene_axes.draw(axes, scene, ahead=ahead)
    ends = ("folded", style.ORANGE, part.dead_center_folded), ("stretched", style.BLUE, part.dead_center_extended)
    for i, (name, color, angle) in enumerate(ends, 1):
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
    center, box = complex(scene.marks[0].point[0]), (0.64, 0.38, 0.35, 0.24)
    detail = scene_axes.magnified(axes, box, scene, center, 1.7 * crank, "crank,\nmagnified [mm]", ahead)
    way = center + circle(crank, 120)
    detail.plot(way.real, way.imag, color=style.GREY, linewidth=0.8, linestyle=style.DASHED)
    detail.tick_params(labelsize=6, colors=style.GREY)


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
    dead = design.dead_center_folded_at, design.dead_center_extended_at
    folded, extended = (math.degrees(at) % 360.0 for at in dead)
    degrees = np.unique(np.append(np.arange(721) * 0.5, (folded, extended)))
    depth, speed = DEPTH.rates(design.moving, np.radians(degrees), 1)
    title = f"Travel, quick return {design.slider_crank.quick_return_ratio:.6g}"
    panels.turn_panel(travel, "travel of the\nslider [mm]", title=title)
    travel.plot(degrees, depth - depth.min(), color=style.BLUE, linewidth=1.7, gid="travel", label="slider")
    if design.rack_drive is not None:
        rack = design.rack_drive.stroke_ratio * (depth - depth.min())
        travel.plot(degrees, rack, color=style.GREEN, linewidth=1.7, label="rack")
        panels.legend_above(travel)
    panels.turn_panel(velocity, "velocity per crank\nspeed [mm/rad]", title="Velocity")
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
