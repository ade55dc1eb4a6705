"""Scene and sheets of a geared rocker, over one revolution of the crank: both ends of the output's swing, the swing."""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.figures.drawing import linkage, panels, scene_axes, style
from gearlink.cli.views.figures.gears import Mesh, mesh_figure
from gearlink.cli.views.scenes.gears import Toothed, train
from gearlink.cli.views.scenes.of_motion import Positions, Seen
from gearlink.cli.views.scenes.scene import Reals, Scene, fixed_circle
from gearlink.core.machines.planet_linkages.mechanism import OUTPUT
from gearlink.core.machines.planet_linkages.rocker_design import GearedRocker
from gearlink.core.mechanism.courses import turned

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def build(design: GearedRocker, fraction: Reals) -> Scene:
    """Positions over fractions of the loop; a hand on the output shows its swing."""
    here = Positions.of(design, fraction)
    two, five = train(
        here,
        [design.mesh],
        (
            Toothed("coupler", "C", style.BLUE, "2", "gear 2 on the coupler"),
            Toothed("output", 0j, style.ORANGE, "5", "gear 5, output"),
        ),
    )
    tip = np.array([0.0, 1.7j * design.mesh.tip_radius[1]])
    hand = here.body("output", tip, style.ORANGE, 0.0, width=5.0, name="hand on the output")
    rocker = turned("rocker").less(float(here.whole.turn("rocker")[0]))
    return here.scene(
        (*five, *two, hand, fixed_circle(0j, design.crank_length), here.chain),
        {"output": Seen(OUTPUT, style.ORANGE), "rocker": Seen(rocker, style.BLACK)},
        "angle from crank angle 0 [deg]",
        values={"output": ("°", np.degrees(here.turn("output")))},
    )


_WORDS = {
    **linkage.FOUR_BAR,
    "rocker_swing": "swing of the rocker",
    "output_swing": "swing of the output",
    "swing_multiple": "output swing/rocker swing",
    "naive_multiple": "1 + z₂/z₅",
    "min_transmission_angle": "minimum transmission angle",
}


def draw(command: str, design: GearedRocker) -> Figure:
    """The sheet of a command on a geared rocker."""
    title = f"{design.spec.name}: {command}"
    if command == "gear":
        return mesh_figure(title, [Mesh(design.mesh, "", ("2", "5"))])
    marked = partial(linkage.rate, mark=_mark, color=style.ORANGE)
    charts: list[linkage.Panel] = [
        _angles,
        linkage.transmission,
        partial(marked, title="Output speed", ylabel="speed ratio", name="speed_ratio", order=1),
        partial(marked, title="Output acceleration", ylabel="acceleration ratio\n[1/rad]", name="acceleration_ratio",
                order=2),
    ]  # fmt: skip
    return linkage.sheet(title, design, mechanism, _WORDS, charts)


def mechanism(axes: Axes, design: GearedRocker) -> None:
    """Links and gears to scale at one end of the output's swing, lightly at the other."""
    panels.heading(axes, "Mechanism at both ends of the output's swing")
    low, high = sorted(design.extreme_crank_angles, key=design.drive.angle)
    scene = scene_axes.turned(axes, design, build, high / (2.0 * math.pi), low / (2.0 * math.pi))
    scene_axes.lightly(axes, scene, 1, name=f"other end, crank angle {math.degrees(low):.5g}°")


def _angles(axes: Axes, design: GearedRocker) -> None:
    """Output and rocker, each from its place at crank angle 0."""
    linkage.chart(axes, "Angles from crank angle 0", "angle [deg]")
    linkage.standstills(axes, design.extreme_crank_angles)
    axes.plot(*linkage.over_turn(design, "output_angle"), color=style.ORANGE, linewidth=1.6, label="output")
    turns, rocker = linkage.over_turn(design, "rocker_angle")
    axes.plot(turns, rocker - rocker[0], color=style.BLACK, linewidth=1.2, label="rocker")
    panels.legend_above(axes, 2)


def _mark(axes: Axes, design: GearedRocker) -> None:
    linkage.standstills(axes, design.extreme_crank_angles)
