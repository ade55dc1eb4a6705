"""Scenes and sheets of four-bars with a gear on the coupler, over one revolution of the crank.

A two-gear four-bar is drawn where its output stands, a geared rocker at both ends of its output's swing.
"""

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
from gearlink.cli.views.scenes.scene import STEP, TURN, Reals, Scene, bands, fixed_circle
from gearlink.core.machines.planet_linkages.mechanism import OUTPUT
from gearlink.core.mechanism.courses import turned

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.machines.planet_linkages.rocker_design import GearedRocker
    from gearlink.core.machines.planet_linkages.two_gear_design import TwoGearFourBar


def _sheet(command: str, design: Any, mechanism: linkage.Panel, words: dict[str, str], charts: list[Any]) -> Figure:
    title = f"{design.spec.name}: {command}"
    if command == "gear":
        return mesh_figure(title, [Mesh(design.mesh, "", ("2", "5"))])
    return linkage.sheet(title, design, mechanism, {**linkage.FOUR_BAR, **words}, charts)


def _rates(mark: linkage.Marks, color: str = style.BLUE) -> tuple[linkage.Panel, linkage.Panel]:
    """Speed and acceleration of the output."""
    rate = partial(linkage.rate, mark=mark, color=color)
    ratio = "acceleration ratio\n[1/rad]"
    return (
        partial(rate, title="Output speed", ylabel="speed ratio", name="speed_ratio", order=1),
        partial(rate, title="Output acceleration", ylabel=ratio, name="acceleration_ratio", order=2),
    )


# The geared rocker


def build_rocker(design: GearedRocker, fraction: Reals) -> Scene:
    """Positions over fractions of the loop; a hand on the output shows its swing."""
    here = Positions.of(design, fraction)
    gears = (
        Toothed("coupler", "C", style.BLUE, "2", "gear 2 on the coupler"),
        Toothed("output", 0j, style.ORANGE, "5", "gear 5, output"),
    )
    two, five = train(here, [design.mesh], gears)
    tip = np.array([0.0, 1.7j * design.mesh.tip_radius[1]])
    hand = here.body("output", tip, style.ORANGE, 0.0, width=5.0, name="hand on the output")
    rocker = turned("rocker").less(float(here.whole.turn("rocker")[0]))
    return here.scene(
        (*five, *two, hand, fixed_circle(design.crank_length), here.chain),
        {"output": Seen(OUTPUT, style.ORANGE), "rocker": Seen(rocker, style.BLACK)},
        "angle from crank angle 0 [deg]",
        values={"output": ("°", np.degrees(here.turn("output")))},
    )


_ROCKER_WORDS = {
    "rocker_swing": "swing of the rocker",
    "output_swing": "swing of the output",
    "swing_multiple": "output swing/rocker swing",
    "naive_multiple": "1 + z₂/z₅",
    "min_transmission_angle": "minimum transmission angle",
}


def draw_rocker(command: str, design: GearedRocker) -> Figure:
    """The sheet of a command on a geared rocker."""
    charts = [_angles, linkage.transmission, *_rates(_swing_ends, style.ORANGE)]
    return _sheet(command, design, _both_ends, _ROCKER_WORDS, charts)


def _both_ends(axes: Axes, design: GearedRocker) -> None:
    """Links and gears to scale at one end of the output's swing, lightly at the other."""
    panels.heading(axes, "Mechanism at both ends of the output's swing")
    low, high = sorted(design.extreme_crank_angles, key=design.drive.angle)
    scene = scene_axes.turned(axes, design, build_rocker, high / TURN, low / TURN)
    scene_axes.lightly(axes, scene, 1, name=f"other end, crank angle {math.degrees(low):.5g}°")


def _angles(axes: Axes, design: GearedRocker) -> None:
    """Output and rocker, each from its place at crank angle 0."""
    linkage.chart(axes, "Angles from crank angle 0", "angle [deg]")
    _swing_ends(axes, design)
    axes.plot(*linkage.over_turn(design, "output_angle"), color=style.ORANGE, linewidth=1.6, label="output")
    turns, rocker = linkage.over_turn(design, "rocker_angle")
    axes.plot(turns, rocker - rocker[0], color=style.BLACK, linewidth=1.2, label="rocker")
    panels.legend_above(axes, 2)


def _swing_ends(axes: Axes, design: GearedRocker) -> None:
    linkage.standstills(axes, design.extreme_crank_angles)


# The two-gear four-bar


def build_two_gears(design: TwoGearFourBar, fraction: Reals) -> Scene:
    """Positions over fractions of the loop."""
    here = Positions.of(design, fraction)
    name = "gear 5, ring gear" if design.internal else "gear 5, sun"
    gears = (
        Toothed("coupler", "B", style.BLUE, "2", "gear 2, planet on BC"),
        Toothed("output", 0j, style.ORANGE, "5", name, design.internal, design.outer_rim()),
    )
    planet, output = train(here, [design.mesh], gears)
    steps = bands(("back-step", math.degrees(step.start), math.degrees(step.end), STEP) for step in design.back_steps)
    seen = {"output": Seen(OUTPUT, style.ORANGE)}
    path = fixed_circle(design.crank_length)
    return here.scene((*output, *planet, path, here.chain), seen, "output angle [deg]", marked=steps)


_WORDS = {
    "gear_ratio": "gear ratio, −z₂/z₅ (ring: z₂/z₅)",
    "standstill_coupler_ratio": "ω₂/ω₁ at a standstill",
    "dwell_teeth_ratio": "maximum z₅/z₂ with a standstill",
    "dwell_crank_angles": "standstills",
    "back_step_angle": "back-step of the output",
    "tolerance_dwell_angle": "window within the tolerance",
    "tolerance_dwell_start": "start of the window",
    "min_transmission_angle": "minimum transmission angle",
}


def draw_two_gears(command: str, design: TwoGearFourBar) -> Figure:
    """The sheet of a command on a two-gear four-bar."""
    charts: list[linkage.Panel] = [
        partial(linkage.output, mark=_marks, label="output"),
        *([_magnified] if design.tolerance_dwell is not None else []),
        linkage.transmission,
        (rates := _rates(_marks))[0],
        _coupler,
        rates[1],
    ]
    known = design.quantity_names()  # a synthesis for a back-step or a momentary dwell has no window
    words = {name: word for name, word in _WORDS.items() if name in known}
    return _sheet(command, design, _standing, words, charts)


def _standing(axes: Axes, design: TwoGearFourBar) -> None:
    """Links and gears to scale where the output stands, or is slowest; the pitch point lies on the line CD there."""
    places = design.dwell_crank_angles
    phi = places[0] if places else design.speed_ratio_min_at
    words = "standstill" if places else "minimum output speed"
    panels.heading(axes, f"Mechanism at the {words}, crank angle {math.degrees(phi):.5g}°")
    scene = scene_axes.turned(axes, design, build_two_gears, phi / TURN)
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
