"""Scene and sheet of a hypocycloid dwell: gears, curve, rod and slider; the slider over a revolution, its dwell.

The scene is one revolution of the carrier.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.figures.drawing import linkage, panels, scene_axes, style
from gearlink.cli.views.figures.gears import Mesh, mesh_figure
from gearlink.cli.views.scenes.gears import Toothed, train
from gearlink.cli.views.scenes.of_motion import Positions, Seen
from gearlink.cli.views.scenes.scene import DWELL, Chain, Line, Part, Reals, Scene, bands, block, letters, loop
from gearlink.core.machines.dwell_gears.hypocycloid_design import HypocycloidDwell, outwards
from gearlink.core.mechanism.courses import turned
from gearlink.core.mechanism.links import FRAME

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def build(design: HypocycloidDwell, fraction: Reals) -> Scene:
    """Positions over fractions of the loop from mid-dwell on; with an arm over the turns that bring the planet home."""
    here, whole = Positions.of(design, fraction), Positions.of(design, loop(721))
    a, b, m = here.at("carrier", "A"), here.at("carrier", "B"), here.at("planet", "M")
    path = whole.at("planet", "M")
    gears = (
        Toothed(FRAME, 0j, style.ORANGE, "", "ring gear, fixed", ring=True, rim=design.rim_of("")),
        Toothed("planet", 0j, style.BLUE, "2", "planet"),
    )
    ring, planet = train(here, [design.mesh], gears)
    drawn = here.body(FRAME, path, style.GREEN, 0.0, width=1.5, name="path of the point M")
    parts: list[Part] = [*ring, *planet, drawn]
    links = Chain(joints=(a, b, m), color=style.BLUE)
    if design.spec.is_arm:
        far = 1.1 * float(np.abs(path).max()) * np.exp(1j * here.turn("arm"))
        arm = Chain(joints=(a, far), color=style.PURPLE, width=5.0, marked=False)
        seen, marks = {"Arm": Seen(turned("arm"), style.BLUE)}, letters("A", A=a, B=b, M=m)
        return here.scene((*parts, arm, links), seen, "Arm [deg]", marks=marks)
    f, size, ends = here.at("rod", "F"), 0.5 * design.point_radius, whole.at("slider").real
    way = np.array([ends.max() + size, ends.min() - size]) + 0j
    parts += [Line(points=way + side * 0.5j * size, width=1.5) for side in (-1.0, 1.0)]
    half = math.degrees(0.5 * design.dwell_carrier_angle)
    return here.scene(
        (*parts, block(f, 1.6 * size, size, style.BLACK), links, Chain(joints=(m, f))),
        {"slider": _slider(design)},
        "slider, inwards from mid-dwell [mm]",
        marked=bands([("required dwell", -half, half, DWELL)]),
        marks=letters("A", A=a, B=b, M=m, F=f),
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
    title = f"{design.spec.name}: {command}"
    if command == "gear":
        return mesh_figure(title, [Mesh(design.mesh, "", ("2", "ring"))])
    if design.spec.is_arm:
        from gearlink.cli.views.figures import of_motion

        return of_motion.draw(command, design)
    return linkage.sheet(title, design, mechanism, _WORDS, [_turn, _magnified, _transmission])


def mechanism(axes: Axes, design: HypocycloidDwell) -> None:
    """The mechanism at an end of its dwell, its links apart; lightly in mid-dwell and at the other end."""
    slider, half = design.slider, 0.5 * design.dwell_carrier_angle
    panels.heading(axes, f"Mechanism at the end of the dwell, carrier angle {math.degrees(half):.5g}°")
    share = half / (2.0 * math.pi)
    scene = scene_axes.turned(axes, design, build, share, 0.0, -share)
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


def _inwards(axes: Axes, design: HypocycloidDwell, title: str, half: float) -> None:
    """The slider over carrier angles [deg] about mid-dwell."""
    linkage.chart(axes, title, "inwards from\nmid-dwell [mm]", "carrier angle [deg]", turn=False)
    degrees = np.linspace(-half, half, 401)
    axes.plot(degrees, _slider(design).at(design.moving, np.radians(degrees)), color=style.BLUE, linewidth=1.6)


def _turn(axes: Axes, design: HypocycloidDwell) -> None:
    _inwards(axes, design, "Slider over a revolution", 180.0)
    _mark(axes, design, "required dwell")
    panels.legend_above(axes, 1)
    _whole(axes)


def _magnified(axes: Axes, design: HypocycloidDwell) -> None:
    """The dwell and a little beside it, with the band of the tolerance."""
    reach = max(design.dwell_carrier_angle, design.tolerance_carrier_angle or 0.0)
    _inwards(axes, design, "Dwell, magnified", math.degrees(0.55 * reach))
    _mark(axes, design)
    tolerance, angle = design.spec.dwell.tolerance, design.tolerance_carrier_angle
    if tolerance is not None and angle is not None:
        low, high = design.slider.deviation_range(angle)
        for edge, words in ((low, None), (high, f"band of ±{tolerance:g} mm")):
            axes.axhline(edge, color=style.RED, linewidth=0.9, linestyle=style.DASHED, label=words)
        panels.legend_above(axes, 1)


def _transmission(axes: Axes, design: HypocycloidDwell) -> None:
    """Angle between the rod and the normal of the slide line."""
    degrees = np.arange(-360, 361) * 0.5
    linkage.transmission(axes, design, degrees, "carrier angle [deg]", turn=False)
    _mark(axes, design)
    _whole(axes)


def _whole(axes: Axes) -> None:
    """A revolution about mid-dwell."""
    axes.set_xlim(-180.0, 180.0)
    axes.set_xticks(range(-180, 181, 60))


def _slider(design: HypocycloidDwell) -> Seen:
    return Seen(outwards(design).scaled(-1.0), style.BLUE, "mm")
