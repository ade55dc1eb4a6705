"""Figures of a hypocycloid dwell: gears, curve, rod and slider to scale; the slider over a turn, and near its dwell."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from gearlink.cli.figures import linkage, panels, style
from gearlink.core.dwell_gears.hypocycloid import HypocycloidSlider
from gearlink.core.dwell_gears.hypocycloid_design import HypocycloidDwell

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_FACTS = (
    "cusps",
    "carrier_length",
    "rod_length",
    "stroke",
    "dwell_ripple",
    "dwell_carrier_angle",
    "tolerance_carrier_angle",
    "min_transmission_angle",
)


def draw(command: str, design: HypocycloidDwell) -> Figure:
    """The figure of a command on a hypocycloid dwell."""
    figure = panels.page(f"{design.spec.name}: {command}", 0.8)
    top, bottom = linkage.two_parts(figure, 0.9)
    mechanism(top.add_subplot(), design)
    turn, near = bottom.subplots(1, 2)
    _turn(turn, design)
    _magnified(near, design)
    return figure


def mechanism(axes: Axes, design: HypocycloidDwell) -> None:
    """The mechanism in mid-dwell, the rod lightly at both ends of the dwell, the arc of the dwell marked."""
    import numpy as np

    slider, r = design.slider, design.point_radius
    style.drawing(axes)
    panels.heading(axes, "Mechanism in mid-dwell, carrier angle 0°")
    pitch, tip = design.mesh.reference_radius, design.mesh.tip_radius
    linkage.gear(axes, 0j, pitch[1], tip[1], style.ORANGE, f"ring gear, fixed, z = {design.ring_teeth}")
    center = complex(design.carrier_length)
    linkage.gear(axes, center, pitch[0], tip[0], style.BLUE, f"planet, z = {design.planet_teeth}")
    curve = np.array([slider.point(t) for t in np.linspace(-math.pi, math.pi, 721)])
    axes.plot(curve.real, curve.imag, color=style.GREEN, linewidth=1.0, label="path of the point M")
    half = 0.5 * design.dwell_carrier_angle
    arc = np.array([slider.point(t) for t in np.linspace(-half, half, 121)])
    axes.plot(arc.real, arc.imag, color=style.RED, linewidth=2.4, label="arc of the dwell")
    rest = slider.point(0.0) + slider.rod
    circle = rest - slider.rod * np.exp(1j * np.linspace(-0.6, 0.6, 121))
    axes.plot(circle.real, circle.imag, color=style.GREY, linewidth=0.8, linestyle=linkage.DASHED, label="rod's circle")
    for t in (half, -half):
        end = slider.point(t)
        axes.plot([end.real, slider_place(slider, t)], [end.imag, 0.0], color=style.GREY, linewidth=0.9)
    axes.axhline(0.0, color=style.GREY, linewidth=0.7, linestyle=linkage.DOTTED)
    point = slider.point(0.0)
    style.link(axes, [0j, center])
    style.link(axes, [center, point], color=style.BLUE)
    style.link(axes, [point, rest])
    axes.plot([rest.real], [0.0], "s", color=style.BLACK, markersize=10, zorder=5)
    style.pivot(axes, 0j)
    up = 1j * r
    linkage.letters(axes, {"A": (0j, (up,)), "B": (center, (up + center,)), "M": (point, (point - up,))})
    linkage.facts(axes, design, _FACTS)


def slider_place(slider: HypocycloidSlider, t: float) -> float:
    """The slider's place on the x axis [mm]."""
    return slider.point(0.0).real + slider.rod - slider.deviation(t)


def _mark(axes: Axes, design: HypocycloidDwell, words: str | None = None) -> None:
    half = math.degrees(0.5 * design.dwell_carrier_angle)
    axes.axvspan(-half, half, color=linkage.DWELL, linewidth=0, zorder=0, label=words)


def _deviations(design: HypocycloidDwell, half: float) -> tuple[list[float], list[float]]:
    """Carrier angle [deg] and deviation [mm] about mid-dwell."""
    degrees = [half * (i / 200.0 - 1.0) for i in range(401)]
    return degrees, [design.slider.deviation(math.radians(x)) for x in degrees]


def _turn(axes: Axes, design: HypocycloidDwell) -> None:
    linkage.chart(axes, "Slider over a turn", "inwards from mid-dwell [mm]", "carrier angle [deg]", turn=False)
    _mark(axes, design, "dwell wanted")
    axes.plot(*_deviations(design, 180.0), color=style.BLUE, linewidth=1.6)
    panels.legend_above(axes, 1)
    axes.set_xticks(range(-180, 181, 60))


def _magnified(axes: Axes, design: HypocycloidDwell) -> None:
    """The dwell and a little beside it, with the band of the tolerance."""
    linkage.chart(axes, "Dwell, magnified", "inwards from mid-dwell [mm]", "carrier angle [deg]", turn=False)
    _mark(axes, design)
    reach = max(design.dwell_carrier_angle, design.tolerance_carrier_angle or 0.0)
    degrees, values = _deviations(design, math.degrees(0.55 * reach))
    axes.plot(degrees, values, color=style.BLUE, linewidth=1.6)
    tolerance, angle = design.spec.dwell.tolerance, design.tolerance_carrier_angle
    if tolerance is not None and angle is not None:
        low, high = design.slider.deviation_range(angle)
        for edge, words in ((low, None), (high, f"band of ±{tolerance:g} mm")):
            axes.axhline(edge, color=style.RED, linewidth=0.9, linestyle=linkage.DASHED, label=words)
        panels.legend_above(axes, 1)
