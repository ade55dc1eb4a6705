"""Figures of a slider-crank: both dead centres and a position between, travel and velocity over a turn.

The drawing lies on its side: the slide line runs to the right, as the depth of the slider does in the kernel.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gearlink.cli.figures import panels, style
from gearlink.core.linkages.slider_crank import slider

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.linkages.slider_crank_design import SliderCrankDesign

_DASHED: Any = (0, (5, 3))
_CHAIN: Any = (0, (9, 2.5, 1.5, 2.5))
_DOTTED: Any = (0, (1, 2))
_FOLDED, _EXTENDED, _BETWEEN = style.ORANGE, style.BLUE, style.BLACK


def draw(command: str, design: SliderCrankDesign) -> Figure:
    """The figure of a command on a slider-crank."""
    figure = panels.page(f"{design.spec.name}: {command}", 0.75)
    grid = figure.add_gridspec(3, 1, height_ratios=[1.9, 1.0, 1.0])
    mechanism(figure.add_subplot(grid[0]), design)
    travel = figure.add_subplot(grid[1])
    motion(travel, figure.add_subplot(grid[2]), design)
    return figure


def dead_centers(design: SliderCrankDesign) -> tuple[float, float]:
    """Directions of the crank at the folded and at the stretched dead centre [rad], the second after the first."""
    folded = 0.5 * math.pi - design.slider_crank.dead_center_folded
    return folded, 1.5 * math.pi - design.slider_crank.dead_center_extended


def pin_and_slider(design: SliderCrankDesign, psi: float) -> tuple[complex, complex]:
    """Crank pin E and slider F at a crank direction, turned so that the slide line runs to the right [mm]."""
    crank, rod, offset = design.slider_crank.crank_length, design.spec.rod, design.spec.offset
    depth = slider(psi, crank, rod, offset)[0]
    return 1j * crank * complex(math.cos(psi), math.sin(psi)), complex(depth, -offset)


# The mechanism


def mechanism(axes: Axes, design: SliderCrankDesign) -> None:
    """Both dead centres and the position half-way, with stroke, offset, crank and rod."""
    folded, extended = dead_centers(design)
    crank = design.slider_crank.crank_length
    style.drawing(axes)
    panels.heading(axes, f"Crank {crank:.6g} mm, rod {design.spec.rod:.6g} mm")
    style.circle(axes, 0j, crank, color=style.GREY, linewidth=0.9, linestyle=_DOTTED)
    positions = (
        (
            folded,
            _FOLDED,
            f"folded, rod at {math.degrees(design.slider_crank.dead_center_folded):.5g}° to the slide line",
        ),
        (
            extended,
            _EXTENDED,
            f"stretched, rod at {math.degrees(design.slider_crank.dead_center_extended):.5g}° to the slide line",
        ),
        (0.5 * (folded + extended), _BETWEEN, "half-way in crank angle"),
    )
    for psi, color, name in positions:
        pin, block = pin_and_slider(design, psi)
        style.link(axes, [0j, pin, block], color, 2.4 if color == _BETWEEN else 1.8, label=name)
        _block(axes, block, crank, color)
    _slide_line(axes, design)
    style.pivot(axes, 0j)
    style.letter(axes, 0j, "D", (-14, 4))
    pin, block = pin_and_slider(design, positions[2][0])
    style.letter(axes, pin, "E", (4, -13 if pin.imag < 0 else 6))
    style.letter(axes, block, "F", (-3, 10))
    _dimensions(axes, design)
    axes.margins(0.06)
    axes.autoscale_view()
    axes.set_xlabel("mm along the slide line from the crank's axis", fontsize=7)
    panels.legend_above(axes, 1)


def _block(axes: Axes, place: complex, crank: float, color: str) -> None:
    """The slider as a block."""
    from matplotlib.patches import Rectangle

    half_length, half_height = 0.13 * crank, 0.075 * crank
    corner = (place.real - half_length, place.imag - half_height)
    axes.add_patch(
        Rectangle(corner, 2 * half_length, 2 * half_height, facecolor=color, alpha=0.35, edgecolor=color, zorder=3)
    )


def _slide_line(axes: Axes, design: SliderCrankDesign) -> None:
    """The slide line, and the parallel to it through the crank's axis."""
    folded, extended = dead_centers(design)
    near, far = (pin_and_slider(design, psi)[1] for psi in (folded, extended))
    crank = design.slider_crank.crank_length
    low, high = min(near.real, 0.0) - 0.3 * crank, far.real + 0.3 * crank
    axes.plot([low, high], [near.imag] * 2, color=style.GREY, linewidth=0.9, linestyle=_CHAIN, zorder=1)
    axes.plot([-1.15 * crank, 1.3 * crank], [0.0, 0.0], color=style.GREY, linewidth=0.7, linestyle=_CHAIN, zorder=1)


def _dimensions(axes: Axes, design: SliderCrankDesign) -> None:
    """Stroke under the dead centres, offset beside the crank's axis."""
    spec, crank = design.spec, design.slider_crank.crank_length
    folded, extended = dead_centers(design)
    near, far = (pin_and_slider(design, psi)[1] for psi in (folded, extended))
    level = min(-1.18 * crank, near.imag - 0.3 * crank)
    below_near, below_far = complex(near.real, level), complex(far.real, level)
    style.dimension(axes, below_near, below_far, f"stroke {spec.stroke:.6g} mm", shift=(0, -4), from_points=(near, far))
    axes.update_datalim([(far.real, level - 0.05 * (far.real + crank))])  # room for the words
    if spec.offset:
        x = -1.25 * crank
        top, bottom = complex(x, 0.0), complex(x, -spec.offset)
        axes.plot([x, near.real], [-spec.offset] * 2, color=style.GREY, linewidth=0.6, zorder=1)
        style.dimension(axes, top, bottom, "", from_points=(0j,))
        middle = (top + bottom) / 2.0
        words = f"offset\n{spec.offset:.6g} mm"
        axes.annotate(
            words, (middle.real, middle.imag), (-6, 0), textcoords="offset points", ha="right", va="center", fontsize=8
        )
        axes.update_datalim([(-1.9 * crank, middle.imag)])


# The motion


def motion(travel: Axes, velocity: Axes, design: SliderCrankDesign) -> None:
    """Travel of the slider and its velocity per crank speed over a turn from the folded dead centre."""
    import numpy as np

    from gearlink.core.linkages import slider_crank_sweep

    folded, extended = dead_centers(design)
    crank, spec = design.slider_crank.crank_length, design.spec
    forward = math.degrees(extended - folded)
    degrees = np.unique(np.append(np.arange(721) * 0.5, forward))
    depth, speed = slider_crank_sweep.slider(folded + np.radians(degrees), crank, spec.rod, spec.offset, 1)
    nearest = pin_and_slider(design, folded)[1].real
    panels.turn_panel(travel, "travel of the\nslider [mm]")
    panels.heading(travel, f"Travel, quick return {design.slider_crank.quick_return_ratio:.6g}")
    travel.plot(degrees, depth - nearest, color=style.BLUE, linewidth=1.7, gid="travel")
    panels.turn_panel(velocity, "velocity per crank\nspeed [mm/rad]", "crank angle from the folded dead centre [deg]")
    panels.heading(velocity, "Velocity")
    velocity.plot(degrees, speed, color=style.RED, linewidth=1.7, gid="velocity")
    velocity.axhline(0.0, color=style.BLACK, linewidth=0.8)
    for axes in (travel, velocity):
        axes.axvline(forward, color=style.GREY, linewidth=0.9, linestyle=_DASHED)
        axes.margins(y=0.15)
    _phases(travel, forward, spec.stroke)
    _greatest(velocity, degrees, speed, np.argmax)
    _greatest(velocity, degrees, speed, np.argmin)


def _phases(axes: Axes, forward: float, stroke: float) -> None:
    """Crank angles of the stroke out and of the stroke back."""
    for start, end, name in ((0.0, forward, "out"), (forward, 360.0, "back")):
        words = f"{name}: {end - start:.5g}°"
        style.dimension(axes, complex(start, -0.09 * stroke), complex(end, -0.09 * stroke), words, shift=(0, 2))


def _greatest(axes: Axes, degrees: Any, speed: Any, pick: Callable[[Any], Any]) -> None:
    """The greatest velocity of a sense, as plotted."""
    i = int(pick(speed))
    axes.plot([degrees[i]], [speed[i]], "o", color=style.RED, markersize=4.0)
    up = speed[i] > 0.0
    axes.annotate(
        f"{speed[i]:.5g} at {degrees[i]:.4g}°",
        (degrees[i], speed[i]),
        (0, 4 if up else -4),
        textcoords="offset points",
        ha="center",
        va="bottom" if up else "top",
        fontsize=7.5,
    )
