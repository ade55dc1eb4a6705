"""Scene and sheets of a two-gear four-bar: the mechanism where the output stands, and its output over a revolution."""

from __future__ import annotations

import cmath
import math
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import linkage, panels, scene_axes, style
from gearlink.cli.views.figures.gears import Mesh, mesh_figure
from gearlink.cli.views.scenes.gears import Toothed, train
from gearlink.cli.views.scenes.of_motion import Positions, Seen
from gearlink.cli.views.scenes.scene import STEP, TURN, Part, Reals, Scene, bands, fixed_circle
from gearlink.core.machines.planet_linkages.mechanism import OUTPUT
from gearlink.core.machines.planet_linkages.two_gear_design import TwoGearFourBar

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def build(design: TwoGearFourBar, fraction: Reals) -> Scene:
    """Positions over fractions of the loop."""
    here = Positions.of(design, fraction)
    name = "gear 5, ring gear" if design.internal else "gear 5, sun"
    gears = (
        Toothed("coupler", "B", style.BLUE, "2", "gear 2, planet on BC"),
        Toothed("output", 0j, style.ORANGE, "5", name, design.internal, design.outer_rim()),
    )
    planet, output = train(here, [design.mesh], gears)
    links: tuple[Part, ...] = (fixed_circle(0j, design.crank_length), here.chain)
    steps = bands(("back-step", math.degrees(step.start), math.degrees(step.end), STEP) for step in design.back_steps)
    seen = {"output": Seen(OUTPUT, style.ORANGE)}
    return here.scene((*output, *planet, *links), seen, "output angle [deg]", marked=steps)


_WORDS = {
    **linkage.FOUR_BAR,
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
        return mesh_figure(title, [Mesh(design.mesh, "", ("2", "5"))])
    marked = partial(linkage.rate, mark=_marks)
    charts: list[linkage.Panel] = [
        partial(linkage.output, mark=_marks, label="output"),
        *([_magnified] if design.tolerance_dwell is not None else []),
        linkage.transmission,
        partial(marked, title="Output speed", ylabel="speed ratio", name="speed_ratio", order=1),
        _coupler,
        partial(marked, title="Output acceleration", ylabel="acceleration ratio\n[1/rad]", name="acceleration_ratio",
                order=2),
    ]  # fmt: skip
    known = design.quantity_names()  # a synthesis for a back-step or a momentary dwell has no window
    return linkage.sheet(title, design, mechanism, {name: _WORDS[name] for name in _WORDS if name in known}, charts)


def mechanism(axes: Axes, design: TwoGearFourBar) -> None:
    """Links and gears to scale where the output stands, or is slowest; the pitch point lies on the line CD there."""
    places = design.dwell_crank_angles
    phi = places[0] if places else design.speed_ratio_min_at
    words = "standstill" if places else "minimum output speed"
    panels.heading(axes, f"Mechanism at the {words}, crank angle {math.degrees(phi):.5g}°")
    scene = scene_axes.turned(axes, design, build, phi / TURN)
    pole, d = cmath.rect(abs(design.mesh.reference_radius[1]), phi), complex(design.frame_length)
    axes.plot([pole.real], [pole.imag], "D", color=style.RED, markersize=5, zorder=7, label="pitch point of the gears")
    joint, far = complex(scene.marks[2].point[0]), d + 1.15 * (pole - d)
    look = {"color": style.RED, "linewidth": 0.8, "linestyle": style.DASHED, "zorder": 3.8}
    axes.plot([joint.real, far.real], [joint.imag, far.imag], **look, label="from D through the pitch point")


def _coupler(axes: Axes, design: TwoGearFourBar) -> None:
    linkage.rate(axes, design, "Coupler speed", "ω₂/ω₁", "coupler_ratio", 1, mark=_marks)
    stands = design.standstill_coupler_ratio
    axes.axhline(stands, color=style.RED, linewidth=0.9, linestyle=style.DASHED, label="output stands")
    panels.legend_above(axes, 1)


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
