"""Figures of a three-gear four-bar: the mechanism in its dwell, and its output over a turn; its meshes for `gear`."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from gearlink.cli.plots import panels, style
from gearlink.core.fourbar import FourBar, solve
from gearlink.core.three_gear_four_bar import ThreeGearFourBar

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

CRANK_GEAR, IDLER, OUTPUT_GEAR = style.BLUE, style.GREEN, style.ORANGE
DWELL, BACKWARD = "#CFE8F7", "#FBE3C8"
_DASHED: Any = (0, (5, 3))
_DOTTED: Any = (0, (1, 2))
_TURN = 360.0
_WORDS = {
    "crank_length": "crank AB",
    "coupler_length": "coupler BC",
    "rocker_length": "rocker CD",
    "frame_length": "frame AD",
    "gear_gap": "gap of gears 1 and 5",
    "min_transmission_angle": "least transmission angle",
    "mean_ratio": "output turns per crank turn",
    "speed_ratio_max": "greatest speed ratio",
    "speed_ratio_min": "least speed ratio",
    "back_step_angle": "back-step of the output",
    "back_step_crank_angle": "crank angle of it, $\\varphi_{12}$",
    "dwell_angle": "dwell, $\\varphi_{13}$",
}


def draw(command: str, design: ThreeGearFourBar) -> Figure:
    """The figure of a command on a three-gear four-bar."""
    title = f"{design.spec.name}: {command}"
    if command == "gear":
        from gearlink.cli.plots.gear_mesh import Mesh, mesh_figure

        names = (("crank-idler", ("1", "3")), ("idler-output", ("3", "5")))
        pairs = design.meshes.values()
        return mesh_figure(title, [Mesh(pair, *name) for pair, name in zip(pairs, names, strict=True)])
    charts = [_output, *([_magnified] if design.dwell_crank_angles else []), _speed]
    if command == "analyze":
        charts += [_acceleration, _transmission]
    return _page(title, design, charts)


def _page(title: str, design: ThreeGearFourBar, charts: Sequence[Callable[[Axes, ThreeGearFourBar], None]]) -> Figure:
    """The mechanism and its numbers over the charts, two to a row, an odd one as wide as the page."""
    rows = math.ceil(len(charts) / 2)
    figure = panels.page(title, min(0.42 + 0.19 * rows, 1.0))
    halves = figure.add_gridspec(2, 1, height_ratios=[2.0, rows])
    head = halves[0].subgridspec(1, 2, width_ratios=[1.75, 1.0])
    drawing = figure.add_subplot(head[0])
    mechanism(drawing, design)
    _numbers(figure.add_subplot(head[1]), drawing, design)
    grid = halves[1].subgridspec(rows, 2)
    for i, chart in enumerate(charts):
        last_alone = i == len(charts) - 1 and i % 2 == 0
        chart(figure.add_subplot(grid[i // 2, :] if last_alone else grid[i // 2, i % 2]), design)
    return style.settled(figure)


# The mechanism


@dataclass(frozen=True, slots=True)
class Position:
    """The joints of the linkage at a crank angle [mm]."""

    a: complex
    b: complex
    c: complex
    d: complex


def position(linkage: FourBar, crank_angle: float) -> Position:
    """Joints A, B, C, D with A in the origin and D on the x axis."""
    rocker = solve(linkage, crank_angle).rocker_angle
    d = complex(linkage.frame)
    return Position(
        0j,
        linkage.crank * complex(math.cos(crank_angle), math.sin(crank_angle)),
        d + linkage.rocker * complex(math.cos(rocker), math.sin(rocker)),
        d,
    )


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
    at = position(design.linkage, angle)
    style.drawing(axes)
    degrees = math.degrees(angle) % _TURN
    panels.heading(axes, f"Mechanism at the {words}, crank angle {degrees:.5g}°")
    middle = (at.a + at.b + at.c + at.d) / 4.0
    for gear, center in ((1, at.b), (3, at.c), (5, at.d)):
        _gear(axes, design, gear, center, center - middle)
    style.circle(
        axes, at.a, design.crank_length, color=style.GREY, linewidth=0.9, linestyle=_DOTTED, gid="crank-circle"
    )
    axes.plot([], [], color=style.GREY, linewidth=0.9, linestyle=_DOTTED, label="path of the crank pin B")
    _closest(axes, design, angle)
    _shafts(axes, design)
    style.link(axes, [at.a, at.b, at.c, at.d])
    style.pivot(axes, at.a)
    style.pivot(axes, at.d)
    _letters(axes, at)
    axes.margins(0.05)
    axes.autoscale_view()


def _parts(design: ThreeGearFourBar) -> dict[int, tuple[str, int, str]]:
    """Name, teeth and colour of each gear."""
    return {
        1: ("crank gear", design.crank_teeth, CRANK_GEAR),
        3: ("idler", design.idler_teeth, IDLER),
        5: ("output gear", design.output_teeth, OUTPUT_GEAR),
    }


def _radii(design: ThreeGearFourBar, gear: int) -> tuple[float, float]:
    """Pitch and tip radius [mm]."""
    pair, side = {1: ("crank_idler", 0), 3: ("crank_idler", 1), 5: ("idler_output", 1)}[gear]
    mesh = design.meshes[pair]
    return mesh.reference_radius[side], mesh.tip_radius[side]


def _gear(axes: Axes, design: ThreeGearFourBar, gear: int, center: complex, outward: complex) -> None:
    """Pitch circle solid, tip circle dashed, the gear's number on the rim, away from the links."""
    from matplotlib.patches import Circle

    name, teeth, color = _parts(design)[gear]
    pitch, tip = _radii(design, gear)
    axes.add_patch(Circle((center.real, center.imag), pitch, facecolor=color, alpha=0.10, linewidth=0, zorder=1))
    style.circle(axes, center, pitch, color=color, linewidth=1.5, zorder=3, gid=f"pitch-{gear}")
    style.circle(axes, center, tip, color=color, linewidth=0.9, linestyle=_DASHED, zorder=3, gid=f"tip-{gear}")
    axes.plot([], [], color=color, linewidth=1.5, label=f"gear {gear}, {name}, z = {teeth}")
    box = {"boxstyle": "circle,pad=0.2", "facecolor": "white", "edgecolor": color, "linewidth": 1.2}
    rim = center + pitch * outward / abs(outward)
    axes.text(rim.real, rim.imag, str(gear), fontsize=8, bbox=box, ha="center", va="center", zorder=6)


def _closest(axes: Axes, design: ThreeGearFourBar, drawn: float) -> None:
    """Gears 1 and 5 where they come nearest, the crank on the frame line; red where they overlap."""

    at = position(design.linkage, 0.0)
    r1, r5 = (_radii(design, gear)[1] for gear in (1, 5))
    if abs(math.remainder(drawn, 2.0 * math.pi)) > math.radians(1.0):
        for center, radius, color in ((at.b, r1, CRANK_GEAR), (at.c, _radii(design, 3)[1], IDLER)):
            style.circle(axes, center, radius, color=color, linewidth=0.7, alpha=0.45, linestyle=_DASHED, gid="closest")
        points = [at.a, at.b, at.c, at.d]
        x, y = [p.real for p in points], [p.imag for p in points]
        axes.plot(x, y, "o-", color=style.GREY, alpha=0.5, linewidth=1.0, markersize=2.5, label="gears 1 and 5 closest")
    if design.gear_gap < 0.0:
        both = _overlap(at.b, r1, at.d, r5)
        axes.fill(both.real, both.imag, color=style.RED, linewidth=0, zorder=6, gid="collision")
        where = (design.frame_length - math.copysign(r5, design.frame_length - design.crank_length), 0.0)
        pointer = {"arrowstyle": "-|>", "color": style.RED, "linewidth": 0.9}
        axes.annotate(
            "collision",
            where,
            (0, -62),
            textcoords="offset points",
            color=style.RED,
            fontsize=8,
            ha="center",
            arrowprops=pointer,
            zorder=8,
        )
        axes.fill([], [], color=style.RED, label=f"gears 1 and 5 collide by {-design.gear_gap:.4g} mm")


def _overlap(center_1: complex, radius_1: float, center_2: complex, radius_2: float) -> Any:
    """Outline of what two circles share: the points of each that lie within the other, in order round their middle."""
    import numpy as np

    turn = np.exp(1j * np.linspace(0.0, 2.0 * math.pi, 20001))
    first, second = center_1 + radius_1 * turn, center_2 + radius_2 * turn
    points = np.concatenate([first[abs(first - center_2) <= radius_2], second[abs(second - center_1) <= radius_1]])
    return points[np.argsort(np.angle(points - points.mean()))]


def _shafts(axes: Axes, design: ThreeGearFourBar) -> None:
    """The shafts that the file names."""
    from matplotlib.patches import Circle

    shafts = design.spec.shafts
    if shafts is None:
        return
    for name, radius, x in (
        ("input", shafts.input_radius, 0.0),
        ("output", shafts.output_radius, design.frame_length),
    ):
        if radius is not None:
            axes.add_patch(
                Circle(
                    (x, 0.0),
                    radius,
                    facecolor=style.GREY,
                    edgecolor=style.BLACK,
                    alpha=0.6,
                    zorder=2,
                    gid=f"shaft-{name}",
                )
            )
            axes.fill([], [], color=style.GREY, alpha=0.6, label=f"{name} shaft, radius {radius:g} mm")


def _letters(axes: Axes, at: Position) -> None:
    """The letters of the joints, away from the links that meet there."""
    joints = {
        "A": (at.a, (at.b, at.d)),
        "B": (at.b, (at.a, at.c)),
        "C": (at.c, (at.b, at.d)),
        "D": (at.d, (at.c, at.a)),
    }
    for name, (point, neighbours) in joints.items():
        ways = [(other - point) / abs(other - point) for other in neighbours if other != point]
        away = -sum(ways, 0j)
        if abs(away) < 0.2:
            away = 1j * ways[0]
        away *= 12.0 / abs(away)
        box = {"boxstyle": "round,pad=0.1", "facecolor": "white", "edgecolor": "none", "alpha": 0.7}
        axes.annotate(
            name,
            (point.real, point.imag),
            (away.real, away.imag),
            textcoords="offset points",
            ha="center",
            va="center",
            fontsize=10,
            fontweight="bold",
            bbox=box,
            zorder=8,
        )


def _numbers(axes: Axes, drawing: Axes, design: ThreeGearFourBar) -> None:
    """The legend of the drawing, and under it the numbers that it is to scale with."""
    panels.legend_beside(axes, drawing)
    names = ("crank_length", "coupler_length", "rocker_length", "frame_length", "gear_gap", "min_transmission_angle")
    found = [design.quantity(name) for name in (*names, *_motion_names(design))]
    shown = [
        (_WORDS.get(q.name, q.words), f"{q.value:.6g} {q.unit}".removesuffix(" 1")) for q in found if q is not None
    ]
    for i, (words, value) in enumerate(reversed(shown)):
        axes.text(0.0, 0.062 * i, words, transform=axes.transAxes, va="bottom", fontsize=8)
        axes.text(1.0, 0.062 * i, value, transform=axes.transAxes, va="bottom", ha="right", fontsize=8)


def _motion_names(design: ThreeGearFourBar) -> tuple[str, ...]:
    if design.back_step is None:
        return ("mean_ratio", "speed_ratio_max", "speed_ratio_min")
    return ("mean_ratio", "back_step_angle", "back_step_crank_angle", "dwell_angle")


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


def _column(design: ThreeGearFourBar, name: str) -> tuple[Any, Any]:
    """A column of the motion table over the crank angle [deg], closed at 360 deg."""
    import numpy as np

    table = design.table("motion")
    data = dict(zip(table.columns, table.data, strict=True))
    gained = _TURN * design.mean_ratio if name == "output_angle" else 0.0
    return np.append(data["crank_angle"], _TURN), np.append(data[name], data[name][0] + gained)


def _mark(axes: Axes, design: ThreeGearFourBar, label: bool = False) -> None:
    """The dwell shaded, the back-step darker, lines at the standstills."""
    dwell = _dwell(design)
    if dwell is None:
        return
    if dwell.width:
        _shade(axes, dwell, DWELL, "dwell $\\varphi_{13}$" if label else None)
    if design.back_step is not None:
        step = Stretch(dwell.start, math.degrees(design.back_step.crank_angle))
        _shade(axes, step, BACKWARD, "back-step $\\varphi_{12}$" if label else None)
    for i, place in enumerate(design.dwell_crank_angles):
        words = "standstill" if label and i == 0 else None
        axes.axvline(math.degrees(place), color=style.GREY, linewidth=0.8, linestyle=_DASHED, zorder=1, label=words)


def _shade(axes: Axes, stretch: Stretch, color: str, label: str | None) -> None:
    phase = panels.Phase("dwell", stretch.start, stretch.start + stretch.width)
    for start, end in phase.within_turn():
        axes.axvspan(start, end, color=color, linewidth=0, zorder=0, label=label)
        label = None


def _chart(axes: Axes, title: str, ylabel: str) -> None:
    style.curves(axes, "crank angle [deg]", ylabel)
    panels.small_ticks(axes)
    style.full_turn(axes)
    panels.heading(axes, title)


def _output(axes: Axes, design: ThreeGearFourBar) -> None:
    _chart(axes, "Output angle", "output angle [deg]")
    _mark(axes, design, label=True)
    x, y = _column(design, "output_angle")
    axes.plot(x, y, color=style.BLUE, linewidth=1.6, gid="output-angle")
    axes.plot(
        [0.0, _TURN], [0.0, _TURN * design.mean_ratio], color=style.GREY, linewidth=0.9, linestyle=_DOTTED, label="mean"
    )
    panels.legend_above(axes, 2)


def _magnified(axes: Axes, design: ThreeGearFourBar) -> None:
    """The output about its dwell, counted from its place at the start of it."""
    import numpy as np

    from gearlink.core.gear_linkage import output_angle
    from gearlink.core.gear_linkage_sweep import output_motion

    dwell = _dwell(design)
    assert dwell is not None, "drawn only where the output stands still"
    width = dwell.width or 60.0
    low = dwell.start - (0.25 * width if dwell.width else 0.5 * width)
    high = dwell.start + (1.25 * width if dwell.width else 0.5 * width)
    degrees = np.linspace(low, high, 401)
    at_start = output_angle(design.linkage, design.train, math.radians(dwell.start))
    output = output_motion(design.linkage, design.train, np.radians(degrees)).output_angle - at_start
    style.curves(axes, "crank angle [deg]", "output from its\nstandstill [deg]")
    panels.small_ticks(axes)
    panels.heading(axes, "Dwell, magnified")
    axes.plot(degrees, np.degrees(output), color=style.BLUE, linewidth=1.6, gid="magnified")
    axes.axhline(0.0, color=style.GREY, linewidth=0.8)
    _tolerance(axes, design, at_start, low)
    if dwell.width:
        _back_step_marks(axes, design, dwell)
    else:
        axes.axvline(dwell.start, color=style.GREY, linewidth=0.8, linestyle=_DASHED)
        axes.plot([dwell.start], [0.0], "o", color=style.RED, markersize=4.5)
        axes.annotate(
            f"{dwell.start % _TURN:.5g}°", (dwell.start, 0.0), (6, -12), textcoords="offset points", fontsize=8
        )
    axes.set_xlim(low, high)


def _back_step_marks(axes: Axes, design: ThreeGearFourBar, dwell: Stretch) -> None:
    """phi12 and phi13 shaded, the places 1, 2 and 3, and how far the output steps back."""
    step = design.back_step
    assert step is not None, "a dwell of some width comes from a back-step"
    width, back = math.degrees(step.crank_angle), math.degrees(step.angle)
    axes.axvspan(dwell.start, dwell.start + dwell.width, color=DWELL, linewidth=0, zorder=0)
    axes.axvspan(dwell.start, dwell.start + width, color=BACKWARD, linewidth=0, zorder=0)
    marks = ((1, 0.0, 0.0, "center", 6), (2, width, -back, "center", -6), (3, dwell.width, 0.0, "right", 6))
    for number, after, level, side, lift in marks:
        axes.plot([dwell.start + after], [level], "o", color=style.RED, markersize=4.5, zorder=5)
        axes.annotate(
            f"{number}: {(dwell.start + after) % _TURN:.5g}°",
            (dwell.start + after, level),
            (0 if side == "center" else -3, lift),
            textcoords="offset points",
            ha=side,
            va="bottom" if lift > 0 else "top",
            fontsize=7.5,
        )
    low, high = axes.get_ylim()
    axes.set_ylim(min(low, -2.2 * back), max(high, 0.9 * back))


def _tolerance(axes: Axes, design: ThreeGearFourBar, at_start: float, low: float) -> None:
    """The band that the tolerance dwell keeps to, where the file asks for one."""
    found = design.tolerance_dwell
    if found is None or design.spec.tolerance is None:
        return
    from gearlink.core.gear_linkage import output_angle

    turns = math.ceil((math.radians(low) - found.start) / (2.0 * math.pi) - 0.5)
    start = found.start + 2.0 * math.pi * max(turns, 0)
    shift = output_angle(design.linkage, design.train, start) - output_angle(design.linkage, design.train, found.start)
    middle = math.degrees(found.output_angle + shift - at_start)
    band = design.spec.tolerance
    axes.fill_between(
        [math.degrees(start), math.degrees(start + found.crank_angle)],
        middle - band,
        middle + band,
        color=style.GREEN,
        alpha=0.25,
        linewidth=0,
        label=f"within ±{band:g}° over {math.degrees(found.crank_angle):.5g}°",
    )
    panels.legend_above(axes, 1)


def _extreme(axes: Axes, place: float, value: float, above: bool) -> None:
    """A marked extreme with its value."""
    degrees = math.degrees(place) % _TURN
    axes.plot([degrees], [value], "o", color=style.RED, markersize=4.0, zorder=5)
    side = "right" if degrees > 0.85 * _TURN else "left" if degrees < 0.15 * _TURN else "center"
    axes.annotate(
        f"{value:.5g} at {degrees:.5g}°",
        (degrees, value),
        (0, 5 if above else -5),
        textcoords="offset points",
        ha=side,
        va="bottom" if above else "top",
        fontsize=7.5,
        zorder=6,
    )


def _speed(axes: Axes, design: ThreeGearFourBar) -> None:
    _chart(axes, "Speed ratio", "output speed/\ncrank speed")
    _mark(axes, design)
    x, y = _column(design, "speed_ratio")
    axes.axhline(0.0, color=style.BLACK, linewidth=0.8)
    axes.axhline(design.mean_ratio, color=style.GREY, linewidth=0.9, linestyle=_DOTTED, label="mean")
    axes.plot(x, y, color=style.BLUE, linewidth=1.6, gid="speed-ratio")
    extremes = design.speed_extremes
    _extreme(axes, extremes.greatest_angle, extremes.greatest, True)
    _extreme(axes, extremes.least_angle, extremes.least, False)
    axes.margins(y=0.18)
    panels.legend_above(axes, 3)


def _acceleration(axes: Axes, design: ThreeGearFourBar) -> None:
    _chart(axes, "Acceleration ratio", "output acceleration/\n(crank speed)²")
    _mark(axes, design)
    x, y = _column(design, "acceleration_ratio")
    axes.axhline(0.0, color=style.BLACK, linewidth=0.8)
    axes.plot(x, y, color=style.PURPLE, linewidth=1.6, gid="acceleration-ratio")
    extremes = design.acceleration_extremes
    _extreme(axes, extremes.greatest_angle, extremes.greatest, True)
    _extreme(axes, extremes.least_angle, extremes.least, False)
    axes.margins(y=0.18)


def _transmission(axes: Axes, design: ThreeGearFourBar) -> None:
    _chart(axes, "Transmission angle", "transmission\nangle [deg]")
    _mark(axes, design)
    x, y = _column(design, "transmission_angle")
    limit = design.spec.limits.transmission_angle
    axes.plot(x, y, color=style.GREEN, linewidth=1.6, gid="transmission-angle")
    axes.axhline(limit, color=style.RED, linewidth=1.1, linestyle=_DASHED, label=f"limit {limit:g}°")
    least = math.degrees(design.min_transmission_angle)
    axes.axhline(least, color=style.GREY, linewidth=0.8, linestyle=_DOTTED, label=f"least {least:.5g}°")
    axes.set_ylim(0.0, 92.0)
    axes.set_yticks(range(0, 91, 15))
    panels.legend_above(axes, 1)
