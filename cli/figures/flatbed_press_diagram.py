"""The kinematic diagram of a whole flatbed cylinder press."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from gearlink.cli.figures import panels, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from gearlink.core.flatbed_press.design import FlatbedPress

LEVEL = -1j
"""Turns the bed chain's frame so that the bed moves level, printing to the right: AD points down, F stands left."""
UPRIGHT = 1j
"""Turns the cylinder chain's frame so that N stands above G; its cylinder, geared to N, then runs with the bed."""
_SHOWN = math.radians(60.0)


def machine(axes: Axes, design: FlatbedPress) -> None:
    """Input gears, both chains at an input angle of 60 deg, cylinder, bed with its racks and pinion.

    The chains are to scale; where the design file leaves a place free (cylinder, racks, and the gears' axes where
    it has no input gears) the diagram takes one that keeps the parts apart.
    """
    import numpy as np

    from gearlink.core.flatbed_press.positions import bed_positions, cylinder_positions

    style.drawing(axes)
    panels.heading(axes, "Kinematic diagram at input angle 60°")
    axes.set_xlabel("")
    axes.set_xticks([])
    axes.set_yticks([])
    phi = np.array([_SHOWN])
    bed, cylinder = bed_positions(design.bed, phi), cylinder_positions(design.cylinder, phi)
    a, d = 0j, bed.d * LEVEL
    b, c, e, f = (complex(points[0]) * LEVEL for points in (bed.b, bed.c, bed.e, bed.f))
    slide = f.imag
    gear_axis, radius = input_gear_place(design, slide)
    h, m, n = (gear_axis + UPRIGHT * p for p in (complex(cylinder.h[0]), complex(cylinder.m[0]), cylinder.n))
    _gears(axes, a, gear_axis, radius)
    style.link(axes, [a, b, c, d, e, f], style.BLUE, 1.8)
    style.link(axes, [gear_axis, h, m, n], style.GREEN, 1.8)
    panels.letters(axes, [a, b, c, d, e, f], "ABCDEF")
    panels.letters(axes, [gear_axis, h, m, n], "GHMN")
    for pivot in (a, d, gear_axis, n):
        style.pivot(axes, pivot, "", 5.5)
    top = _bed(axes, design, f)
    _cylinder(axes, design, n, top)


def input_gear_place(design: FlatbedPress, slide: float) -> tuple[complex, float | None]:
    """Axis G on the height of the slide line, and the working radius of the equal input gears."""
    gears = design.spec.input_gears
    if gears is not None:
        return complex(-gears.horizontal_distance, slide), 0.5 * design.gear_pair.center_distance
    bed, cylinder = design.bed, design.cylinder.linkage
    reach = max(bed.slider_crank_length, bed.linkage.crank) + bed.linkage.frame
    return complex(-1.1 * (reach + cylinder.crank + cylinder.frame), slide), None


def _gears(axes: Axes, a: complex, g: complex, radius: float | None) -> None:
    if radius is None:
        return
    for center, name in ((g, "1"), (a, "2")):
        style.circle(axes, center, radius, color=style.GREY, linewidth=0.9, linestyle="-.")
        axes.text(center.real, center.imag - 0.82 * radius, name, fontsize=8, color=style.GREY, ha="center")


def _bed(axes: Axes, design: FlatbedPress, f: complex) -> float:
    """Pinion on F between the lower rack, which the cams move, and the rack of the bed; the bed's top."""
    from matplotlib.patches import Rectangle

    stroke = design.spec.bed.stroke
    pinion = 0.12 * stroke
    style.circle(axes, f, pinion, color=style.BLUE, linewidth=1.2, zorder=3)
    axes.plot([f.real], [f.imag], "o", color="white", markeredgecolor=style.BLUE, markersize=5, zorder=6)
    thick = 0.05 * stroke
    lower = (f.real - 0.4 * stroke, f.imag - pinion - thick)
    upper = (f.real - 0.45 * stroke, f.imag + pinion)
    axes.add_patch(Rectangle(lower, 0.8 * stroke, thick, facecolor="#F6E3C0", edgecolor=style.BLACK, linewidth=0.8))
    axes.add_patch(Rectangle(upper, 0.9 * stroke, thick, facecolor="#CFE8F7", edgecolor=style.BLACK, linewidth=0.8))
    below = lower[1] - 0.5 * thick
    axes.text(f.real, below, "rack moved by the cams on D", fontsize=7, ha="center", va="top")
    axes.text(f.real, upper[1] + 0.5 * thick, "bed", fontsize=7, ha="center", va="center")
    return upper[1] + thick


def _cylinder(axes: Axes, design: FlatbedPress, n: complex, top: float) -> None:
    """The cylinder on the bed, geared to N; its gear is drawn as large as the cylinder where that reaches N."""
    radius, ratio = design.cylinder.radius, design.cylinder.gear_ratio
    rise = top + radius - n.imag
    distance = max(radius * (1.0 + ratio), 1.001 * abs(rise))
    center = complex(n.real - math.sqrt(distance**2 - rise**2), top + radius)
    driven = distance / (1.0 + ratio)
    style.circle(axes, center, radius, color=style.GREEN, linewidth=1.6, zorder=3)
    driver = distance - driven
    for axis, size, name, place in ((n, driver, "3", 0.5 + 0.65j), (center, driven, "4", -0.75j)):
        style.circle(axes, axis, size, color=style.GREY, linewidth=0.9, linestyle="-.")
        spot = axis + size * place
        axes.text(spot.real, spot.imag, name, fontsize=8, color=style.GREY, ha="center", va="center")
    style.pivot(axes, center, "", 5.5)
    axes.text(center.real, center.imag + 0.25 * radius, "cylinder", fontsize=7.5, ha="center")
