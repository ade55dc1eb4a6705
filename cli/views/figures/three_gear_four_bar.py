"""Scene and figures of a three-gear four-bar: dwell, output over a revolution, instant centres, meshes for `gear`.

The scene is one revolution of the crank.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import linkage, panels, scene_axes, style
from gearlink.cli.views.figures.gears import Mesh, mesh_figure
from gearlink.cli.views.scenes.gears import Toothed, train
from gearlink.cli.views.scenes.of_motion import Positions, Seen
from gearlink.cli.views.scenes.scene import DWELL, STEP, TURN, Band, Reals, Scene, bands, fixed_circle
from gearlink.core.machines.three_gear.design import ThreeGearFourBar
from gearlink.core.machines.three_gear.mechanism import OUTPUT, poles

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.parts.linkages.standstills import Turning


def build(design: ThreeGearFourBar, fraction: Reals) -> Scene:
    """Positions over fractions of the loop."""
    here = Positions.of(design, fraction)
    ring, end = design.crank_teeth < 0, design.output_teeth < 0
    gears = (
        Toothed("crank", "B", style.BLUE, "1", f"gear 1, crank {_kind(design.crank_teeth)}", ring),
        Toothed("idler", 0j, style.GREEN, "3", "gear 3, idler"),
        Toothed("output", 0j, style.ORANGE, "5", f"gear 5, output {_kind(design.output_teeth)}", end,
                design.outer_rim("idler_output")),
    )  # fmt: skip
    crank, idler, output = train(here, list(design.meshes.values()), gears)
    path = fixed_circle(design.linkage.crank, "path of the crank pin B")
    now, rate = OUTPUT.rates(design.moving, here.inputs, 1)
    return here.scene(
        (*output, *(crank if ring else ()), *idler, *(() if ring else crank), path, here.chain),
        {"output": Seen(OUTPUT, style.ORANGE)},
        "output angle [deg]",
        marked=_bands(design),
        values={"output": ("°", np.degrees(now)), "speed ratio": ("", rate)},
    )


def _bands(design: ThreeGearFourBar) -> tuple[Band, ...]:
    """The dwell within a tolerance; phi13 where the file asks for that angle, or there is no other; the back-step."""
    found, wish = [], design.spec.dwell
    by_angle = wish is not None and wish.angle is not None
    by_angle &= design.spec.dwell_tolerance is None and design.spec.dwell_backlash is None
    if design.tolerance_dwell is not None and not by_angle:
        start, width = design.tolerance_dwell.start, design.tolerance_dwell.crank_angle
        found.append(("dwell", math.degrees(start), math.degrees(start + width), DWELL))
    elif design.back_step is not None and design.dwell_angle is not None:
        start = design.back_step.start
        found.append(("dwell", math.degrees(start), math.degrees(start + design.dwell_angle), DWELL))
    if design.back_step is not None:
        step = design.back_step
        found.append(("back-step", math.degrees(step.start), math.degrees(step.start + step.crank_angle), STEP))
    return bands(found)


def _kind(teeth: int) -> str:
    return "ring gear" if teeth < 0 else "gear"


def draw(command: str, design: ThreeGearFourBar) -> Figure:
    """The figure of a command on a three-gear four-bar."""
    title = f"{design.spec.name}: {command}"
    if command == "gear":
        names = (("crank-idler", ("3", "1") if design.crank_teeth < 0 else ("1", "3")), ("idler-output", ("3", "5")))
        meshes = zip(design.meshes.values(), names, strict=True)
        return mesh_figure(title, [Mesh(mesh, *name) for mesh, name in meshes])
    output: linkage.Panel = partial(linkage.output, mark=_mark, gid="output-angle")
    charts = [output, *([_magnified] if design.dwell_crank_angles else []), _speed]
    if command == "analyze":
        charts += [_acceleration, _transmission]
    return linkage.sheet(title, design, mechanism, words(design), charts)


# The motion


@dataclass(frozen=True, slots=True)
class Stretch:
    """A marked stretch of the turn [deg], from `start` over `width`; a momentary dwell has none."""

    start: float
    width: float


def _dwell(design: ThreeGearFourBar) -> Stretch | None:
    """phi13 from the start of the back-step; a point for a momentary dwell."""
    if design.back_step is not None and design.dwell_angle is not None:
        return Stretch(math.degrees(design.back_step.start), math.degrees(design.dwell_angle))
    places = design.dwell_crank_angles
    return Stretch(math.degrees(places[0]), 0.0) if places else None


def _mark(axes: Axes, design: ThreeGearFourBar, label: bool = False) -> None:
    """The dwell tinted, the back-step hatched, lines at the standstills."""
    dwell = _dwell(design)
    if dwell is None:
        return
    if dwell.width:
        linkage.shade(axes, linkage.DWELL, dwell.start, dwell.width, "dwell φ₁₃" if label else None)
    if design.back_step is not None:
        width, words = math.degrees(design.back_step.crank_angle), "back-step φ₁₂" if label else None
        linkage.shade(axes, linkage.BACKWARD, dwell.start, width, words)
    linkage.standstills(axes, design.dwell_crank_angles, "standstill" if label else None)


def _magnified(axes: Axes, design: ThreeGearFourBar) -> None:
    """The output about its dwell, counted from its place at the start of it."""
    dwell = _dwell(design)
    assert dwell is not None, "drawn only where the output has zero velocity"
    width = dwell.width or 60.0
    low = dwell.start - (0.25 * width if dwell.width else 0.5 * width)
    high = dwell.start + (1.25 * width if dwell.width else 0.5 * width)
    if (window := _window(design, dwell.start)) is not None:
        room = 0.08 * window.width
        low, high = min(low, window.start - room), max(high, window.start + window.width + room)
    degrees = np.linspace(low, high, 401)
    at_start = design.output.angle(math.radians(dwell.start))
    output = OUTPUT.rates(design.moving, np.radians(degrees), 0)[0] - at_start
    panels.curves(axes, "crank angle [deg]", "output from its\nstandstill [deg]", "Dwell, magnified")
    axes.plot(degrees, np.degrees(output), color=style.BLUE, linewidth=1.6, gid="magnified")
    axes.axhline(0.0, color=style.GREY, linewidth=0.8)
    _tolerance(axes, design, at_start, dwell.start)
    if dwell.width:
        _back_step_marks(axes, design, dwell)
    else:
        axes.axvline(dwell.start, color=style.GREY, linewidth=0.8, linestyle=style.DASHED)
        axes.plot([dwell.start], [0.0], "o", color=style.RED, markersize=4.5)
        words = f"{dwell.start % linkage.TURN:.5g}°"
        axes.annotate(words, (dwell.start, 0.0), (6, -12), textcoords="offset points", fontsize=8)
    axes.set_xlim(low, high)


def _window(design: ThreeGearFourBar, near: float) -> Stretch | None:
    """The dwell within a tolerance, in the turn [deg] that starts half a revolution before a place."""
    found = design.tolerance_dwell
    if found is None:
        return None
    start = math.degrees(found.start)
    turns = math.floor((start - near) / linkage.TURN + 0.5)
    return Stretch(start - linkage.TURN * turns, math.degrees(found.crank_angle))


def _back_step_marks(axes: Axes, design: ThreeGearFourBar, dwell: Stretch) -> None:
    """phi12 and phi13 shaded, the places 1, 2 and 3, and how far the output steps back."""
    step = design.back_step
    assert step is not None, "a dwell of some width comes from a back-step"
    width, back = math.degrees(step.crank_angle), math.copysign(math.degrees(step.angle), design.mean_ratio)
    axes.axvspan(dwell.start, dwell.start + dwell.width, **linkage.DWELL)
    axes.axvspan(dwell.start, dwell.start + width, **linkage.BACKWARD)
    lift = math.copysign(6.0, back)
    marks = ((1, 0.0, 0.0, "center", lift), (2, width, -back, "center", -lift), (3, dwell.width, 0.0, "right", lift))
    for number, after, level, side, lift in marks:
        axes.plot([dwell.start + after], [level], "o", color=style.RED, markersize=4.5, zorder=5)
        words, shift = f"{number}: {(dwell.start + after) % linkage.TURN:.5g}°", (0 if side == "center" else -3, lift)
        look: Any = {"ha": side, "va": "bottom" if lift > 0 else "top", "fontsize": 7.5}
        axes.annotate(words, (dwell.start + after, level), shift, textcoords="offset points", **look)
    low, high = axes.get_ylim()
    axes.set_ylim(min(low, -2.2 * back, 0.9 * back), max(high, -2.2 * back, 0.9 * back))


def _tolerance(axes: Axes, design: ThreeGearFourBar, at_start: float, near: float) -> None:
    """The band that the tolerance dwell keeps to, where there is one."""
    found, window = design.tolerance_dwell, _window(design, near)
    if found is None or window is None or design.output_tolerance is None:
        return
    start = math.radians(window.start)
    shift = design.output.angle(start) - design.output.angle(found.start)
    middle = math.degrees(found.output_angle + shift - at_start)
    band = math.degrees(design.output_tolerance)
    look: Any = {"color": style.GREEN, "alpha": 0.25, "linewidth": 0}
    x, words = [window.start, window.start + window.width], f"within ±{band:g}° over {window.width:.5g}°"
    axes.fill_between(x, middle - band, middle + band, **look, label=words)
    panels.legend_above(axes, 1)


def _speed(axes: Axes, design: ThreeGearFourBar) -> None:
    axes.axhline(design.mean_ratio, color=style.GREY, linewidth=0.9, linestyle=style.DOTTED, label="mean")
    words = "Speed ratio", "output speed/\ncrank speed", "speed_ratio"
    linkage.rate(axes, design, *words, 1, mark=_mark, zero=style.BLACK, gid="speed-ratio")
    _extremes(axes, design.output.fastest, design.output.slowest)
    panels.legend_above(axes, 3)


def _acceleration(axes: Axes, design: ThreeGearFourBar) -> None:
    words = "Acceleration ratio", "output acceleration/\n(crank speed)²", "acceleration_ratio"
    look: Any = {"color": style.PURPLE, "zero": style.BLACK, "gid": "acceleration-ratio"}
    linkage.rate(axes, design, *words, 2, mark=_mark, **look)
    _extremes(axes, design.output.hardest, design.output.hardest_back)


def _extremes(axes: Axes, greatest: Turning, least: Turning) -> None:
    panels.extreme(axes, math.degrees(greatest.place) % linkage.TURN, greatest.value, above=True)
    panels.extreme(axes, math.degrees(least.place) % linkage.TURN, least.value, above=False)
    axes.margins(y=0.25)


def _transmission(axes: Axes, design: ThreeGearFourBar) -> None:
    linkage.transmission(axes, design)
    _mark(axes, design)
    least = math.degrees(design.min_transmission_angle)
    axes.axhline(least, color=style.GREY, linewidth=0.8, linestyle=style.DOTTED, label=f"minimum {least:.5g}°")
    axes.set_yticks(range(0, 91, 15))
    panels.legend_above(axes, 3)


_LINKS = {
    **linkage.FOUR_BAR,
    "gear_gap": "gap of gears 1 and 5",
    "min_transmission_angle": "minimum transmission angle",
    "mean_ratio": "output revolutions per crank revolution",
}
_STEADY = {"speed_ratio_max": "maximum speed ratio", "speed_ratio_min": "minimum speed ratio"}
_BACK_STEP = {
    "back_step_angle": "back-step of the output",
    "back_step_crank_angle": "back-step crank angle, φ₁₂",
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
    return design.speed_ratio_min_at, "minimum output speed"


def mechanism(axes: Axes, design: ThreeGearFourBar) -> None:
    """Links and gears to scale in the dwell position; lightly, gears 1 and 5 at their closest."""
    angle, words = dwell_position(design)
    panels.heading(axes, f"Mechanism at the {words}, crank angle {math.degrees(angle) % 360.0:.5g}°")
    scene = scene_axes.turned(axes, design, build, angle / TURN, 0.0)
    if abs(math.remainder(angle, TURN)) > math.radians(1.0):
        name = "crank along the frame" if design.gear_gap is None else "gears 1 and 5 closest"
        scene_axes.lightly(axes, scene, 1, name=name)
    if design.gear_gap is not None and design.gear_gap < 0.0:
        _collision(axes, design)
    _shafts(axes, design)


def _collision(axes: Axes, design: ThreeGearFourBar) -> None:
    """What the tip circles of gears 1 and 5 share where the crank lies on the frame line."""
    (first, second), frame, gap = design.meshes.values(), design.frame_length, design.gear_gap
    assert gap is not None, "external gears have a gap"
    r1, r5 = first.tip_radius[0], second.tip_radius[1]
    both = _overlap(complex(design.crank_length), r1, complex(frame), r5)
    style.area(axes, both, color=style.WRONG, linewidth=0, zorder=6, gid="collision")
    where = (frame - math.copysign(r5, frame - design.crank_length), 0.0)
    shape = {"arrowstyle": "-|>", "color": style.WRONG, "linewidth": 0.9}
    look: dict[str, Any] = {"color": style.WRONG, "fontsize": 8, "ha": "center", "arrowprops": shape, "zorder": 8}
    axes.annotate("collision", where, (0, -62), textcoords="offset points", path_effects=style.outlined(), **look)
    axes.fill([], [], color=style.WRONG, label=f"gears 1 and 5 collide by {-gap:.4g} mm")


def _overlap(center_1: complex, radius_1: float, center_2: complex, radius_2: float) -> Any:
    """Outline of what two circles share: the points of each that lie within the other, in order round their middle."""
    turn = np.exp(1j * np.linspace(0.0, TURN, 20001))
    first, second = center_1 + radius_1 * turn, center_2 + radius_2 * turn
    points = np.concatenate([first[abs(first - center_2) <= radius_2], second[abs(second - center_1) <= radius_1]])
    return points[np.argsort(np.angle(points - points.mean()))]


def _shafts(axes: Axes, design: ThreeGearFourBar) -> None:
    """The shafts that the file names."""
    shafts = design.spec.shafts
    if shafts is None:
        return
    for name, radius, x in (("input", shafts.input_radius, 0.0), ("output", shafts.output_radius, design.frame_length)):
        if radius is not None:
            style.disc(axes, complex(x), radius, facecolor=style.GREY, alpha=0.6, zorder=3.3, gid=f"shaft-{name}")
            axes.fill([], [], color=style.GREY, alpha=0.6, label=f"{name} shaft, radius {radius:g} mm")


def words(design: ThreeGearFourBar) -> dict[str, str]:
    """The quantities beside the drawing, in short words."""
    links = {name: text for name, text in _LINKS.items() if name != "gear_gap" or design.gear_gap is not None}
    request = design.spec.dwell  # within a tolerance, where the file asks for one
    asked = design.spec.dwell_tolerance is not None or (request is not None and request.angle is None)
    within = _WITHIN if asked and design.tolerance_dwell is not None else {}
    return {**links, **(_STEADY if design.back_step is None else _BACK_STEP), **within}


_MOST = 2
_CLOSE = 0.06


def draw_poles(design: ThreeGearFourBar) -> Figure:
    """The linkage at each standstill with its poles; A, F = P13 and E = P35 lie in line there."""
    places = design.dwell_crank_angles[:_MOST] or [design.speed_ratio_min_at]
    title, share = f"{design.spec.name}: instant centres", 0.5 * len(places) + 0.1
    made, rows = panels.stack(title, [1.0] * len(places), share)
    words = "standstill" if design.dwell_crank_angles else "minimum speed"
    for axes, phi in zip(rows, places, strict=True):
        panels.drawing(axes, f"Poles at the {words}, crank angle {math.degrees(phi):.5g}°")
        scene_axes.draw(axes, build(design, np.array([phi / TURN])))
        _poles(axes, design, phi)
    return made


def _poles(axes: Axes, design: ThreeGearFourBar, phi: float) -> None:
    """The three poles, the line through them, and the feet of B and D on it."""
    found = poles(design, np.array([phi]))
    first, second, x = complex(found.first[0]), complex(found.second[0]), float(found.on_frame[0])
    points = {"F = P13": first, "E = P35": second}
    if math.isfinite(x) and abs(x) < 3.0 * design.frame_length:
        points["P15"] = complex(x, 0.0)
    way = (second - first) / abs(second - first)
    ends = {"G": complex(design.frame_length, 0.0), "G'": complex(found.crank_pin[0])}
    feet = {name: first + way * ((point - first) * way.conjugate()).real for name, point in ends.items()}
    along = sorted(((point - first) * way.conjugate()).real for point in (*points.values(), *feet.values(), 0j))
    line = first + way * np.array([along[0], along[-1]])
    axes.plot(line.real, line.imag, color=style.RED, linewidth=1.2, linestyle=style.DASHED, zorder=8)
    close = _CLOSE * design.frame_length
    for name, point in {**points, **feet}.items():
        axes.plot([point.real], [point.imag], "o", color=style.RED, markersize=4.0, zorder=9)
        crowded = name == "G'" and min(abs(point), *(abs(point - other) for other in points.values())) < close
        axes.annotate(name, (point.real, point.imag), (-14, -16) if crowded else (5, 5), textcoords="offset points",
                      fontsize=8, zorder=10, path_effects=style.outlined())  # fmt: skip
