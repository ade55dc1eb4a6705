"""Scene and sheet of a hypocycloid dwell: gears, curve, rod and slider to scale; the slider over a turn, and its dwell.

The scene is one revolution of the carrier.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.figures.drawing import linkage, panels, scene_axes, style
from gearlink.cli.views.scenes import of_motion
from gearlink.cli.views.scenes.gears import gear
from gearlink.cli.views.scenes.scene import (
    BLACK,
    BLUE,
    DWELL,
    GREEN,
    ORANGE,
    PURPLE,
    TURN,
    Chain,
    Chart,
    Curve,
    Line,
    Readout,
    Reals,
    Scene,
    bands,
    block,
    letters,
    loop,
    standing,
)
from gearlink.core.machines.dwell_gears.hypocycloid_design import HypocycloidDwell
from gearlink.core.parts.gears.outline.mesh_geometry import ring_turn

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def _arm(design: HypocycloidDwell, fraction: Reals) -> Scene:
    """With an arm: positions over the turns of the carrier that bring the planet home."""
    scene = of_motion.build(design, fraction)
    whole = of_motion.inputs(design.moving.input, fraction)
    links = design.moving.at(whole, 0).links
    a, b, m = (links[link].at(name).value for link, name in (("carrier", "A"), ("planet", "B"), ("planet", "M")))
    path = design.moving.at(of_motion.inputs(design.moving.input, loop(721)), 0).links["planet"].at("M").value
    planet, ring = design.planet_teeth, design.ring_teeth
    turn = ring_turn((ring, planet), whole, np.zeros_like(whole))
    reach = float(np.abs(path).max()) * 1.1
    far = reach * np.exp(1j * links["arm"].turn.value)
    return replace(
        scene,
        parts=(
            *gear(design.mesh, 1, a, np.zeros_like(whole), 0.0, ORANGE, "", "ring gear, fixed", design.rim_of("")),
            *gear(design.mesh, 0, b, turn, 1.0 - ring / planet, BLUE, "2", "planet"),
            standing(path, fraction, GREEN, "path of the point M"),
            Chain(joints=(a, far), color=PURPLE, width=5.0, marked=False),
            Chain(joints=(a, b, m), color=BLUE),
        ),
        marks=letters("A", A=a, B=b, M=m),
    )


def build(design: HypocycloidDwell, fraction: Reals) -> Scene:
    """Positions over fractions of the loop, from mid-dwell on."""
    if design.spec.is_arm:
        return _arm(design, fraction)
    t = TURN * fraction
    now, whole = (design.moving.at(angles, 0).links for angles in (t, TURN * loop(361)))
    a, b, m, f = (
        now[link].at(name).value for link, name in (("carrier", "A"), ("carrier", "B"), ("rod", "M"), ("rod", "F"))
    )
    rest = design.slider.point(0.0).real + design.slider.rod
    inwards, course = rest - now["slider"].origin.value.real, rest - whole["slider"].origin.value.real
    planet, ring = design.planet_teeth, design.ring_teeth
    turn = ring_turn((ring, planet), t, np.zeros_like(t))
    size = 0.5 * design.point_radius
    half = np.degrees(0.5 * design.dwell_carrier_angle)
    way = rest - np.array([course.min() - size, course.max() + size]) + 0j
    return Scene(
        parts=(
            *gear(design.mesh, 1, a, np.zeros_like(t), 0.0, ORANGE, "", "ring gear, fixed", design.rim_of("")),
            *gear(design.mesh, 0, b, turn, 1.0 - ring / planet, BLUE, "2", "planet"),
            standing(whole["planet"].at("M").value, fraction, GREEN, "path of the point M"),
            *(Line(points=way + side * 0.5j * size, width=1.5) for side in (-1.0, 1.0)),
            block(f, 1.6 * size, size, BLACK),
            Chain(joints=(a, b, m), color=BLUE),
            Chain(joints=(m, f)),
        ),
        marks=letters("A", A=a, B=b, M=m, F=f),
        chart=Chart(
            "carrier angle [deg]",
            "slider, inwards from mid-dwell [mm]",
            360.0 * loop(361),
            np.degrees(t),
            (Curve("slider", BLUE, course, inwards),),
            bands([("required dwell", -half, half, DWELL)]),
        ),
        readouts=(Readout("carrier", "°", np.degrees(t)), Readout("slider", " mm", inwards)),
    )


_WORDS = {
    "cusps": "cusps of the curve",
    "carrier_length": "carrier AB",
    "rod_length": "rod MF",
    "stroke": "stroke of the slider",
    "dwell_ripple": "range of the slider in the dwell",
    "dwell_carrier_angle": "required dwell",
    "tolerance_carrier_angle": "widest dwell within the tolerance",
    "min_transmission_angle": "minimum transmission angle",
}


def draw(command: str, design: HypocycloidDwell) -> Figure:
    """The sheet of a command on a hypocycloid dwell."""
    if command == "gear":
        from gearlink.cli.views.figures.gears import Mesh, mesh_figure

        return mesh_figure(f"{design.spec.name}: {command}", [Mesh(design.mesh, "", ("2", "ring"))])
    if design.spec.is_arm:
        from gearlink.cli.views.figures import of_motion

        return of_motion.draw(command, design)
    return linkage.sheet(
        f"{design.spec.name}: {command}", design, mechanism, _WORDS, [_turn, _magnified, _transmission]
    )


def mechanism(axes: Axes, design: HypocycloidDwell) -> None:
    """The mechanism at an end of its dwell, its links apart; lightly in mid-dwell and at the other end."""
    slider, half = design.slider, 0.5 * design.dwell_carrier_angle
    panels.heading(axes, f"Mechanism at the end of the dwell, carrier angle {math.degrees(half):.5g}°")
    scene = build(design, np.array([half, 0.0, -half]) / (2.0 * math.pi))
    scene_axes.draw(axes, scene, ahead=build(design, np.array([half / (2.0 * math.pi) + scene_axes.AHEAD])))
    scene_axes.lightly(axes, scene, 1, name="mid-dwell and start of the dwell")
    scene_axes.lightly(axes, scene, 2)
    arc = np.array([slider.point(t) for t in np.linspace(-half, half, 121)])
    axes.plot(arc.real, arc.imag, color=style.RED, linewidth=2.4, label="arc of the dwell", zorder=3.3)
    circle = slider.point(0.0) + slider.rod - slider.rod * np.exp(1j * np.linspace(-0.6, 0.6, 121))
    look = {"color": style.RED, "linewidth": 0.8, "linestyle": style.DASHED, "zorder": 3.2}
    axes.plot(circle.real, circle.imag, **look, label="circle about mid-dwell's F")


def _mark(axes: Axes, design: HypocycloidDwell, words: str | None = None) -> None:
    half = math.degrees(0.5 * design.dwell_carrier_angle)
    axes.axvspan(-half, half, **linkage.DWELL, label=words)


def _deviations(design: HypocycloidDwell, half: float) -> tuple[list[float], list[float]]:
    """Carrier angle [deg] and deviation [mm] about mid-dwell."""
    degrees = [half * (i / 200.0 - 1.0) for i in range(401)]
    return degrees, [design.slider.deviation(math.radians(x)) for x in degrees]


def _turn(axes: Axes, design: HypocycloidDwell) -> None:
    linkage.chart(axes, "Slider over a revolution", "inwards from\nmid-dwell [mm]", "carrier angle [deg]", turn=False)
    _mark(axes, design, "required dwell")
    axes.plot(*_deviations(design, 180.0), color=style.BLUE, linewidth=1.6)
    panels.legend_above(axes, 1)
    axes.set_xlim(-180.0, 180.0)
    axes.set_xticks(range(-180, 181, 60))


def _magnified(axes: Axes, design: HypocycloidDwell) -> None:
    """The dwell and a little beside it, with the band of the tolerance."""
    linkage.chart(axes, "Dwell, magnified", "inwards from\nmid-dwell [mm]", "carrier angle [deg]", turn=False)
    _mark(axes, design)
    reach = max(design.dwell_carrier_angle, design.tolerance_carrier_angle or 0.0)
    degrees, values = _deviations(design, math.degrees(0.55 * reach))
    axes.plot(degrees, values, color=style.BLUE, linewidth=1.6)
    tolerance, angle = design.spec.dwell.tolerance, design.tolerance_carrier_angle
    if tolerance is not None and angle is not None:
        low, high = design.slider.deviation_range(angle)
        for edge, words in ((low, None), (high, f"band of ±{tolerance:g} mm")):
            axes.axhline(edge, color=style.RED, linewidth=0.9, linestyle=style.DASHED, label=words)
        panels.legend_above(axes, 1)


def _transmission(axes: Axes, design: HypocycloidDwell) -> None:
    """Angle between the rod and the normal of the slide line."""
    degrees = np.arange(-360, 361) * 0.5
    angles = [90.0 - abs(math.degrees(design.slider.rod_angle(math.radians(x)))) for x in degrees.tolist()]
    linkage.transmission(axes, design, degrees, np.array(angles), "carrier angle [deg]", turn=False)
    _mark(axes, design)
    axes.set_xlim(-180.0, 180.0)
    axes.set_xticks(range(-180, 181, 60))
