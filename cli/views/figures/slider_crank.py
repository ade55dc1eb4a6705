"""Sheet of a slider-crank: dead centres and a position between; travel, velocity, transmission angle over a turn."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.figures.drawing import linkage, panels, scene_axes, style, time_axes
from gearlink.cli.views.scenes.slider_crank import build
from gearlink.core.parts.linkages.slider_crank import sweep as slider_crank_sweep

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.cli.views.scenes.scene import Scene
    from gearlink.core.machines.slider_crank.design import SliderCrankDesign

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
    detail.set_title("crank, magnified [mm]", loc="left", fontsize=7)
    detail.tick_params(labelsize=6, colors=style.GREY)
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
    depth, speed = slider_crank_sweep.slider(np.radians(degrees), crank, part.rod, part.offset, 1)
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
