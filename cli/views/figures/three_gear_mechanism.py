"""The three-gear four-bar to scale in its dwell, with the nearest approach of gears 1 and 5, and its shafts."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import panels, scene_axes, style
from gearlink.cli.views.scenes.three_gear_four_bar import build
from gearlink.core.machines.three_gear.design import ThreeGearFourBar

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_LINKS = {
    "crank_length": "crank AB",
    "coupler_length": "coupler BC",
    "rocker_length": "rocker CD",
    "frame_length": "frame AD",
    "gear_gap": "gap of gears 1 and 5",
    "min_transmission_angle": "least transmission angle",
    "mean_ratio": "output turns per crank turn",
}
_STEADY = {"speed_ratio_max": "greatest speed ratio", "speed_ratio_min": "least speed ratio"}
_BACK_STEP = {
    "back_step_angle": "back-step of the output",
    "back_step_crank_angle": "crank angle of it, φ₁₂",
    "dwell_angle": "dwell, φ₁₃",
}

_WITHIN = {"tolerance_dwell_angle": "window within the tolerance", "tolerance_dwell_start": "start of the window"}


def dwell_position(design: ThreeGearFourBar) -> tuple[float, str]:
    """Crank angle [rad] at which the mechanism is drawn, and what that position is."""
    places = design.dwell_crank_angles
    if design.back_step is not None:
        return design.back_step.start + 0.5 * design.back_step.crank_angle, "middle of the back-step"
    if places:
        return places[0], "momentary dwell"
    return design.speed_extremes.least_angle, "least output speed"


def mechanism(axes: Axes, design: ThreeGearFourBar) -> None:
    """Links and gears to scale in the dwell position; lightly, gears 1 and 5 at their closest."""
    angle, words = dwell_position(design)
    panels.heading(axes, f"Mechanism at the {words}, crank angle {math.degrees(angle) % 360.0:.5g}°")
    scene = build(design, np.array([angle / (2.0 * math.pi), 0.0]))
    scene_axes.draw(axes, scene, ahead=build(design, np.array([angle / (2.0 * math.pi) + scene_axes.AHEAD])))
    if abs(math.remainder(angle, 2.0 * math.pi)) > math.radians(1.0):
        scene_axes.lightly(
            axes, scene, 1, name="crank along the frame" if design.gear_gap is None else "gears 1 and 5 closest"
        )
    if design.gear_gap is not None and design.gear_gap < 0.0:
        _collision(axes, design)
    _shafts(axes, design)


def _collision(axes: Axes, design: ThreeGearFourBar) -> None:
    """What the tip circles of gears 1 and 5 share where the crank lies on the frame line."""
    (first, second), frame, gap = design.meshes.values(), design.frame_length, design.gear_gap
    assert gap is not None, "external gears have a gap"
    r1, r5 = first.tip_radius[0], second.tip_radius[1]
    both = _overlap(complex(design.crank_length), r1, complex(frame), r5)
    style.area(axes, both, color=style.RED, linewidth=0, zorder=6, gid="collision")
    where = (frame - math.copysign(r5, frame - design.crank_length), 0.0)
    shape = {"arrowstyle": "-|>", "color": style.RED, "linewidth": 0.9}
    look: dict[str, Any] = {"color": style.RED, "fontsize": 8, "ha": "center", "arrowprops": shape, "zorder": 8}
    axes.annotate("collision", where, (0, -62), textcoords="offset points", path_effects=style.outlined(), **look)
    axes.fill([], [], color=style.RED, label=f"gears 1 and 5 collide by {-gap:.4g} mm")


def _overlap(center_1: complex, radius_1: float, center_2: complex, radius_2: float) -> Any:
    """Outline of what two circles share: the points of each that lie within the other, in order round their middle."""
    turn = np.exp(1j * np.linspace(0.0, 2.0 * math.pi, 20001))
    first, second = center_1 + radius_1 * turn, center_2 + radius_2 * turn
    points = np.concatenate([first[abs(first - center_2) <= radius_2], second[abs(second - center_1) <= radius_1]])
    return points[np.argsort(np.angle(points - points.mean()))]


def _shafts(axes: Axes, design: ThreeGearFourBar) -> None:
    """The shafts that the file names."""
    shafts = design.spec.shafts
    if shafts is None:
        return
    for name, radius, x in (
        ("input", shafts.input_radius, 0.0),
        ("output", shafts.output_radius, design.frame_length),
    ):
        if radius is not None:
            style.disc(axes, complex(x), radius, facecolor=style.GREY, alpha=0.6, zorder=3.3, gid=f"shaft-{name}")
            axes.fill([], [], color=style.GREY, alpha=0.6, label=f"{name} shaft, radius {radius:g} mm")


def words(design: ThreeGearFourBar) -> dict[str, str]:
    """The quantities beside the drawing, in short words."""
    links = {name: text for name, text in _LINKS.items() if name != "gear_gap" or design.gear_gap is not None}
    return {**links, **(_STEADY if design.back_step is None else _BACK_STEP), **_window(design)}


def _window(design: ThreeGearFourBar) -> dict[str, str]:
    """The dwell within a tolerance, where the file asks for one."""
    request = design.spec.dwell
    asked = design.spec.dwell_tolerance is not None or (request is not None and request.angle is None)
    return _WITHIN if asked and design.tolerance_dwell is not None else {}
