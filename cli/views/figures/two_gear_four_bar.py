"""Scene and sheets of a two-gear four-bar: the mechanism where the output stands, and its output over a revolution."""

from __future__ import annotations

import cmath
import math
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import linkage, panels, scene_axes, style, time_axes
from gearlink.cli.views.scenes.gears import gear
from gearlink.cli.views.scenes.linkages import Joints, coupler_windings, crank_readout, over_crank, whole_turn
from gearlink.cli.views.scenes.scene import (
    BLUE,
    ORANGE,
    STEP,
    TURN,
    Band,
    Curve,
    Readout,
    Reals,
    Scene,
    bands,
    fixed_circle,
)
from gearlink.core.machines.planet_linkages.mechanism import OUTPUT
from gearlink.core.machines.planet_linkages.two_gear_design import TwoGearFourBar
from gearlink.core.parts.gears.outline.mesh_geometry import driven_turn, ring_turn

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def build(design: TwoGearFourBar, fraction: Reals) -> Scene:
    """Positions over fractions of the loop."""
    phi = TURN * fraction
    at = Joints.of(design.moving, phi)
    name = "gear 5, ring gear" if design.internal else "gear 5, sun"
    planet = gear(design.mesh, 0, at.b, at.coupler, coupler_windings(design.moving), BLUE, "2", "gear 2, planet on BC")
    rim = design.outer_rim()
    output = gear(design.mesh, 1, at.a, output_turn(design, phi), design.mean_ratio, ORANGE, "5", name, rim)
    swept, whole = (np.degrees(OUTPUT.rates(design.moving, angles, 0)[0]) for angles in (phi, whole_turn()))
    curve = Curve("output", ORANGE, whole, swept)
    return Scene(
        parts=(*output, *planet, fixed_circle(0j, design.crank_length), at.chain()),
        marks=at.marks(),
        chart=over_crank(phi, (curve,), "output angle [deg]", _bands(design)),
        readouts=(crank_readout(phi), Readout("output", "°", swept)),
    )


def output_turn(design: TwoGearFourBar, phi: Reals) -> Reals:
    """Direction of the output gear's first space, or of a tooth of the ring [rad]."""
    coupler = Joints.of(design.moving, phi).coupler
    teeth = design.planet_teeth, design.output_teeth
    return ring_turn(teeth, phi, coupler) if design.internal else driven_turn(teeth, phi + math.pi, coupler)


def _bands(design: TwoGearFourBar) -> tuple[Band, ...]:
    return bands(("back-step", math.degrees(step.start), math.degrees(step.end), STEP) for step in design.back_steps)


_WORDS = {
    "crank_length": "crank AB",
    "coupler_length": "coupler BC",
    "rocker_length": "rocker CD",
    "frame_length": "frame AD",
    "gear_ratio": "gear ratio, −z₂/z₅ (ring: z₂/z₅)",
    "standstill_coupler_ratio": "ω₂/ω₁ at a standstill",
    "dwell_teeth_ratio": "maximum z₅/z₂ with a standstill",
    "dwell_crank_angles": "standstills",
    "back_step_angle": "back-step of the output",
    "tolerance_dwell_angle": "window within the tolerance",
    "tolerance_dwell_start": "start of the window",
    "min_transmission_angle": "minimum transmission angle",
}


def draw(command: str, design: TwoGearFourBar) -> Figure:
    """The sheet of a command on a two-gear four-bar."""
    title = f"{design.spec.name}: {command}"
    if command == "gear":
        from gearlink.cli.views.figures.gears import Mesh, mesh_figure

        return mesh_figure(title, [Mesh(design.mesh, "", ("2", "5"))])
    charts: list[linkage.Panel] = [
        _output,
        *([_magnified] if design.tolerance_dwell is not None else []),
        linkage.over_crank,
        partial(_curve, title="Output speed", ylabel="speed ratio", name="speed_ratio"),
        partial(_curve, title="Coupler speed", ylabel="ω₂/ω₁", name="coupler_ratio"),
        partial(_curve, title="Output acceleration", ylabel="acceleration ratio\n[1/rad]", name="acceleration_ratio"),
    ]
    known = design.quantity_names()  # a synthesis for a back-step or a momentary dwell has no window
    return linkage.sheet(title, design, mechanism, {name: _WORDS[name] for name in _WORDS if name in known}, charts)


def mechanism(axes: Axes, design: TwoGearFourBar) -> None:
    """Links and gears to scale where the output stands, or is slowest; the pitch point lies on the line CD there."""
    places = design.dwell_crank_angles
    phi = places[0] if places else design.speed_ratio_min_at
    words = "standstill" if places else "minimum output speed"
    panels.heading(axes, f"Mechanism at the {words}, crank angle {math.degrees(phi):.5g}°")
    scene = build(design, np.array([phi / (2.0 * math.pi)]))
    scene_axes.draw(axes, scene, ahead=build(design, np.array([phi / (2.0 * math.pi) + scene_axes.AHEAD])))
    pole, d = cmath.rect(abs(design.mesh.reference_radius[1]), phi), complex(design.frame_length)
    axes.plot([pole.real], [pole.imag], "D", color=style.RED, markersize=5, zorder=7, label="pitch point of the gears")
    joint, far = complex(scene.marks[2].point[0]), d + 1.15 * (pole - d)
    look = {"color": style.RED, "linewidth": 0.8, "linestyle": style.DASHED, "zorder": 3.8}
    axes.plot([joint.real, far.real], [joint.imag, far.imag], **look, label="from D through the pitch point")


def _curve(axes: Axes, design: TwoGearFourBar, title: str, ylabel: str, name: str) -> None:
    linkage.chart(axes, title, ylabel)
    _marks(axes, design)
    axes.axhline(0.0, color=style.GREY, linewidth=0.8)
    axes.plot(*linkage.over_turn(design, name), color=style.BLUE, linewidth=1.6)
    if name == "coupler_ratio":
        stands = design.standstill_coupler_ratio
        axes.axhline(stands, color=style.RED, linewidth=0.9, linestyle=style.DASHED, label="output stands")
        panels.legend_above(axes, 1)
    time_axes.in_time(axes, design.angular_speed, 2 if name == "acceleration_ratio" else 1, "rad")


def _output(axes: Axes, design: TwoGearFourBar) -> None:
    linkage.chart(axes, "Output angle", "output angle [deg]")
    _marks(axes, design, label=True)
    gained = linkage.TURN * design.mean_ratio
    axes.plot(*linkage.over_turn(design, "output_angle", gained), color=style.BLUE, linewidth=1.6, label="output")
    look = {"color": style.GREY, "linewidth": 0.9, "linestyle": style.DOTTED}
    axes.plot([0.0, linkage.TURN], [0.0, gained], **look, label="mean")
    panels.legend_above(axes, 2)


def _magnified(axes: Axes, design: TwoGearFourBar) -> None:
    """The output about its dwell, counted from the middle of the tolerance, and the window asked for."""
    found, band = design.tolerance_dwell, math.degrees(design.output_tolerance or 0.0)
    assert found is not None, "drawn only with it"
    start, width = math.degrees(found.start), math.degrees(found.crank_angle)
    degrees = np.linspace(start - 0.25 * width, start + 1.25 * width, 481)
    angle = np.degrees(np.unwrap(OUTPUT.rates(design.moving, np.radians(degrees), 0)[0]))
    inside = angle[(degrees >= start) & (degrees <= start + width)]
    angle -= 0.5 * (inside.min() + inside.max())
    linkage.chart(axes, "Dwell, magnified", "output from the\nmiddle [deg]", turn=False)
    axes.fill_between([start, start + width], -band, band, color=style.GREEN, alpha=0.25, linewidth=0,
                      label=f"within ±{band:g}° over {width:.5g}°", gid="within")  # fmt: skip
    axes.axhline(0.0, color=style.GREY, linewidth=0.8)
    axes.plot(degrees, angle, color=style.BLUE, linewidth=1.6, gid="magnified")
    linkage.standstills(axes, [turn + place for place in design.dwell_crank_angles for turn in (0.0, -TURN, TURN)])
    window = getattr(design, "window", None)
    asked = design.spec.dwell_window if window is None else math.degrees(window)
    if asked is not None:
        short = asked > width
        look: Any = {"color": style.WRONG if short else style.GREY, "linewidth": 2.5, "solid_capstyle": "butt"}
        ends = start + 0.5 * (width - asked), start + 0.5 * (width + asked)
        axes.plot(ends, [-1.4 * band] * 2, **look, label=f"required: {asked:g}°", gid="fails" if short else "asked")
    axes.set_xlim(float(degrees[0]), float(degrees[-1]))
    axes.set_ylim(-2.0 * band, 2.0 * band)
    panels.legend_above(axes, 2)


def _marks(axes: Axes, design: TwoGearFourBar, label: bool = False) -> None:
    """Back-steps hatched, standstills as lines."""
    for i, step in enumerate(design.back_steps):
        start, end = math.degrees(step.start), math.degrees(step.end)
        linkage.shade(axes, linkage.BACKWARD, start, end - start, "back-step" if label and i == 0 else None)
    linkage.standstills(axes, design.dwell_crank_angles, "standstill" if label else None)
