"""Panels of the wide-swing figures: the cam to scale with its rocker, pressure angle and curvature."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from gearlink.cli.views.figures.drawing import failing, panels, style, time_axes
from gearlink.core.base.errors import NoSolution

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from gearlink.core.machines.wide_swing.design import WideSwingDesign
    from gearlink.core.machines.wide_swing.strokes import AnyCam

_DASHED: Any = (0, (5, 3))
_DOTTED: Any = (0, (1, 2))
ZONE = "#F7D9A8"


def cams_of(design: WideSwingDesign) -> list[tuple[str, AnyCam, float]]:
    """The cams to be drawn: title, cam, and -1 where the mirror image serves the return stroke."""
    working = "Cam of the working stroke"
    if design.spec.drive is not None:
        return [("Oscillating cam", design.cam, 1.0)]
    if design.spec.slider is not None:
        return [("Cam of both strokes, turning back in the return", design.cam, 1.0)]
    if design.return_cam is None:
        return [(working, design.cam, 1.0), ("Cam of the return stroke (mirror image)", design.cam, -1.0)]
    if design.spec.layout != "twin-rocker":
        return [(working, design.cam, 1.0), ("Cam of the return stroke", design.return_cam, -1.0)]
    return [
        ("Internal profile, working stroke", design.cam, 1.0),
        ("External profile, return stroke", design.return_cam, 1.0),
    ]


def kind_words(design: WideSwingDesign) -> str:
    """Which of the mechanisms it is, and its swing, for the title."""
    layout = design.spec.layout if design.spec.drive is None else "oscillating cam"
    return f"{layout}, {design.spec.swing:g}° swing"


def has_slots(design: WideSwingDesign) -> bool:
    """Whether every cam can be drawn: no loop, and a roller that leaves a profile."""
    try:
        for _, cam, _ in cams_of(design):
            design.slot_of(cam)
    except NoSolution:
        return False
    return True


def zone_words(axes: Axes, cam: AnyCam) -> None:
    """How much of the stroke the change of sides takes, in the corner of a drawing."""
    words = f"changes flank within ±{100.0 * cam.transition_zone:.3g} % of the stroke"
    axes.text(0.5, 0.02, words, transform=axes.transAxes, ha="center", va="bottom", fontsize=7.5, zorder=8)


def cam_panel(axes: Axes, design: WideSwingDesign, title: str, cam: AnyCam, mirror: float) -> None:
    """A cam at rest, to scale: contour, pitch curve, transition zone, shaft, and the rocker carried round it."""
    panels.drawing(axes, title)
    _body(axes, design, cam, mirror)
    _pitch(axes, cam, mirror)
    _rockers(axes, cam, mirror)
    shaft = design.section.shaft_radius
    if shaft > 0.0:
        style.circle(axes, 0j, shaft, color=style.BLACK, linewidth=1.2, hatch="////", zorder=4)
    axes.plot([0.0], [0.0], "+", color=style.BLACK, markersize=10, zorder=6, label="cam axis")


def _mirrored(z: Any, mirror: float) -> tuple[Any, Any]:
    return z.real, mirror * z.imag


def _body(axes: Axes, design: WideSwingDesign, cam: AnyCam, mirror: float) -> None:
    import numpy as np

    from gearlink.core.machines.wide_swing.strokes import contour, dwell_arc, is_external

    run_up, bottom, run_out = contour(cam, design.slot_of(cam))
    edge = np.concatenate((run_up, bottom, run_out))
    rest = dwell_arc(cam) if design.spec.cycle is None else _rest_of_turn(design, cam, mirror)
    x, y = _mirrored(np.concatenate((edge, rest)), mirror)
    if is_external(cam):
        style.area(axes, x + 1j * y, color=style.BLUE, alpha=0.10, linewidth=0, zorder=1)
    else:
        _ring(axes, x, y, 1.12 * float(np.abs(edge).max()) + cam.roller_radius)
    axes.plot(*_mirrored(rest, mirror), color=style.BLUE, linewidth=0.8, zorder=2)
    for part, label in ((run_up, "profile"), (run_out, None)):
        axes.plot(*_mirrored(part, mirror), color=style.BLUE, linewidth=1.8, zorder=3, label=label)
    axes.plot(
        *_mirrored(bottom, mirror),
        color=style.ORANGE,
        linewidth=3.4,
        solid_capstyle="butt",
        zorder=3,
        label="slot, in which the roller changes flank",
    )


def _rest_of_turn(design: WideSwingDesign, cam: AnyCam, mirror: float) -> Any:
    """Arcs and free sector of a closed contour, in the frame of the cam's own stroke."""
    import numpy as np

    from gearlink.core.machines.wide_swing.strokes import is_external

    closed = design.cycle.back if cam is design.return_cam or mirror < 0.0 else design.cycle.main
    rest = np.concatenate([points for _, points in closed.outline()[3:]])
    return rest if is_external(cam) else -rest.conj()


def _ring(axes: Axes, x: Any, y: Any, radius: float) -> None:
    """The body outside an internal contour, as far as a circle."""
    import numpy as np
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    turn = np.linspace(0.0, 2.0 * math.pi, 361)
    inside = np.stack((x, y), axis=1)
    around = radius * np.stack((np.cos(turn), np.sin(turn)), axis=1)
    if _area(x, y) > 0.0:
        inside = inside[::-1]
    paths = [Path(around, closed=True), Path(inside, closed=True)]
    style.cornered(
        axes, PathPatch(Path.make_compound_path(*paths), facecolor=style.BLUE, alpha=0.10, linewidth=0, zorder=1)
    )
    axes.plot(around[:, 0], around[:, 1], color=style.BLUE, linewidth=0.8, zorder=2)


def _area(x: Any, y: Any) -> float:
    import numpy as np

    return float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))


def _pitch(axes: Axes, cam: AnyCam, mirror: float) -> None:
    import numpy as np

    pitch = cam.points(np.linspace(0.0, 1.0, 601)).pitch
    axes.plot(
        *_mirrored(pitch, mirror), color=style.BLUE, linewidth=1.0, linestyle=_DASHED, label="pitch curve", zorder=3
    )
    from gearlink.core.machines.wide_swing.strokes import middle_of

    middle = middle_of(cam)
    zone = min(cam.transition_zone, middle, 1.0 - middle)
    part = cam.points(np.linspace(middle - zone, middle + zone, 101)).pitch
    axes.plot(*_mirrored(part, mirror), color=style.ORANGE, linewidth=3.0, solid_capstyle="butt", zorder=4)


def _rockers(axes: Axes, cam: AnyCam, mirror: float) -> None:
    """The rocker at start, mid-swing and end as the cam sees it."""
    import numpy as np

    from gearlink.core.machines.wide_swing.strokes import middle_of, rocker_pivots

    points = cam.points(np.array([0.0, middle_of(cam), 1.0]))
    pivots = rocker_pivots(cam, points)
    looks = (("start", style.GREEN), ("mid-swing", style.BLACK), ("end", style.PURPLE))
    for roller, pivot, (name, color) in zip(points.pitch, pivots, looks, strict=True):
        arm = [complex(z.real, mirror * z.imag) for z in (pivot, roller)]
        axes.plot(
            [z.real for z in arm], [z.imag for z in arm], color=color, linewidth=2.0, zorder=5, label=f"rocker, {name}"
        )
        axes.plot([arm[0].real], [arm[0].imag], "^", color=color, markersize=6, zorder=6)
        style.circle(axes, arm[1], cam.roller_radius, color=color, linewidth=1.1, zorder=6)
    style.circle(axes, 0j, cam.center_distance, color=style.GREY, linewidth=0.7, linestyle=_DOTTED, zorder=1)


def stroke_axis(axes: Axes, design: WideSwingDesign, ylabel: str) -> None:
    """Curves over a stroke, and its time where both strokes take the same."""
    style.curves(axes, "fraction of the stroke k", ylabel)
    axes.set_xlim(0.0, 1.0)
    panels.small_ticks(axes)
    if design.motion.return_angle == design.motion.cycle_angle:
        time_axes.in_ms(axes, 1e3 * design.motion.working_time)


def pressure_panel(axes: Axes, design: WideSwingDesign) -> None:
    """Pressure angle of each cam over the stroke with the limit; the transition zone is shaded."""
    import numpy as np

    stroke_axis(axes, design, "pressure angle [deg]")
    k = np.linspace(0.0, 1.0, 401)
    for (words, cam), color in zip(design.cams.items(), (style.BLUE, style.GREEN), strict=False):
        label = f"{words}, ≤ {math.degrees(cam.max_pressure_angle):.4g}°" if design.has_zone(cam) else words
        angle = np.degrees(cam.points(k).pressure_angle)
        axes.plot(k, angle, color=color, linewidth=1.6, label=label)
        touching = np.array([any(low <= at <= high for low, high in cam.contact) for at in k.tolist()])
        over = np.abs(angle) > design.spec.limits.pressure_angle
        failing.past(axes, k, angle, over & touching, f"{words}, above the limit")
    _zone(axes, design)
    limit = design.spec.limits.pressure_angle
    for sign in (1.0, -1.0):
        name = f"limit ±{limit:g}°" if sign > 0.0 else None
        axes.axhline(sign * limit, color=style.RED, linewidth=1.0, linestyle=_DASHED, label=name)
    panels.legend_under_heading(axes, "Pressure angle")


def _zone(axes: Axes, design: WideSwingDesign) -> None:
    from gearlink.core.machines.wide_swing.strokes import middle_of

    zone, middle = min(0.5, max(cam.transition_zone for cam in design.cams.values())), middle_of(design.cam)
    axes.axvspan(middle - zone, middle + zone, color=ZONE, linewidth=0, zorder=0)


def curvature_panel(axes: Axes, design: WideSwingDesign) -> None:
    """Curvature radius of each pitch curve where the roller touches the profile, against the roller's."""
    import numpy as np

    from gearlink.cli.views.figures.drawing.ticks import powers_of_ten
    from gearlink.core.machines.wide_swing.strokes import is_external

    stroke_axis(axes, design, "radius [mm]")
    axes.set_yscale("log")
    powers_of_ten(axes.yaxis)
    k = np.linspace(0.0, 1.0, 1001)[1:-1]
    k, greatest = k[k != 0.5], 0.0
    for (words, cam), color in zip(design.cams.items(), (style.BLUE, style.GREEN), strict=False):
        radius, least = cam.points(k).curvature_radius * (1.0 if is_external(cam) else -1.0), ""
        if design.has_zone(cam):
            least = f", ≥ {cam.min_curvature_radius:.4g} mm"
            radius = np.where([any(low <= at <= high for low, high in cam.contact) for at in k], radius, np.nan)
        greatest = max(greatest, float(np.abs(radius).max(where=np.isfinite(radius), initial=0.0)))
        axes.plot(k, np.where(radius > 0.0, radius, np.nan), color=color, linewidth=1.6, label=words + least)
        failing.past(axes, k, radius, (radius > 0.0) & (radius <= cam.roller_radius), f"{words}, undercut")
        if (radius < 0.0).any():
            hollow = np.where(radius < 0.0, -radius, np.nan)
            axes.plot(k, hollow, color=color, linewidth=1.2, linestyle=_DOTTED, label=f"{words}, concave")
    _zone(axes, design)
    roller = design.section.roller_radius
    axes.axhline(roller, color=style.RED, linewidth=1.0, linestyle=_DASHED, label=f"roller radius {roller:g} mm")
    axes.set_ylim(0.3 * roller, min(100.0 * design.section.center_distance, 3.0 * max(greatest, 10.0 * roller)))
    panels.legend_under_heading(axes, "Curvature radius of the pitch curve")
