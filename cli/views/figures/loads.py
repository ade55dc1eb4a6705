"""Sheets of the loads of any design: torque over the revolution, reflected inertia, joint forces, teeth, shaking force.

The sheet of forces has on one A4 the mechanism with force arrows, the torque, a small panel for each joint and mesh.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from itertools import cycle
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from gearlink.cli.views.figures.drawing import failing, panels, scene_axes, style, time_axes
from gearlink.cli.views.figures.drawing.linkage import closed
from gearlink.cli.views.figures.sheets.vector_sheet import fraction_at, frame_of
from gearlink.cli.views.scenes import shown
from gearlink.core.mechanism import vectors

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.cli.views.scenes.scene import Reals
    from gearlink.core.studies.loads.design import LoadsDesign


_TURN = 360.0


def forces(axes: Axes, design: Any) -> None:
    """Force between each roller and its cam; of a stroke empty where it touches nothing."""
    if hasattr(design, "strokes"):
        _stroke(axes, design, "Force of the roller on its cam", "force [N]", "{}_force", lambda rest: rest.force)
    else:
        _rollers(axes, design, "Contact forces", "force [N]", "force")
    axes.axhline(0.0, color=style.BLACK, linewidth=0.8)
    if not hasattr(design, "strokes"):
        panels.legend_above(axes, 2)


def pressures(axes: Axes, design: Any) -> None:
    """Hertzian pressure of each roller, and what is allowed."""
    if hasattr(design, "strokes"):
        _stroke(axes, design, "Hertzian pressure", "p [N/mm²]", "{}_pressure", lambda rest: rest.pressure)
    else:
        _rollers(axes, design, "Hertzian pressure", "p [N/mm²]", "pressure")
    _allowed(axes, design)
    axes.set_ylim(bottom=0.0)
    panels.legend_above(axes, 4 if hasattr(design, "strokes") else 3)


def _rollers(axes: Axes, design: Any, title: str, ylabel: str, column: str) -> None:
    """What each roller bears on its cam."""
    table = design.table("contact", samples=720)
    panels.turn_panel(axes, ylabel, "input angle [deg]", title)
    x = np.arange(table.length) * (_TURN * design.turns / table.length)
    for name, color, line in zip(design.own_rollers, panels.CAM_COLORS, panels.CAM_LINES, strict=False):
        values = table[f"{name}_{column}"]
        axes.plot(x, values, color=color, linestyle=line, linewidth=1.4, label=design.called(name))
        if column == "pressure":
            _too_much(axes, design, x, values)


def _allowed_pressure(design: Any) -> float | None:
    """What the file allows [N/mm²]; None where it says nothing."""
    material = design.section.material
    return None if material is None else material.allowed_pressure


def _too_much(axes: Axes, design: Any, x: Any, pressure: Any) -> None:
    """A pressure in red where it is above the limit."""
    limit = _allowed_pressure(design)
    if limit is not None:
        values = np.asarray(pressure, dtype=float)
        failing.past(axes, x, values, np.nan_to_num(values) > limit, "above the limit")


def _allowed(axes: Axes, design: Any) -> None:
    limit = _allowed_pressure(design)
    if limit is not None:
        axes.axhline(limit, color=style.RED, linewidth=1.0, linestyle=style.DASHED, label=f"allowed {limit:g}")


def residual(axes: Axes, design: Any) -> None:
    """Vibration that is left in the dwell, over the speed, with the working speed and what is allowed."""
    table = design.table("spectrum")
    speed, units = table["speed"], dict(zip(table.columns, table.units, strict=True))
    unit, title = units["residual"], "Residual vibration over the speed"
    panels.curves(axes, f"speed [{units['speed']}]", f"residual [{unit}]", title)
    axes.plot(speed, table["residual"], color=style.PURPLE, linewidth=1.4)
    at = float(speed[-1]) / 1.3
    axes.axvline(at, color=style.GREY, linewidth=0.9, linestyle=style.DASHED, label=f"speed {at:.5g}")
    left = design.quantity("residual_amplitude")
    allowed, here = design.section.vibration.allowed_residual, 0.0 if left is None else float(left.value)
    if allowed is not None:
        if here > allowed:
            words = f"{here:.4g} {unit} at this speed"
            axes.plot([at], [here], "o", color=style.WRONG, markersize=6.0, zorder=7, label=words, gid="fails")
        axes.axhline(allowed, color=style.RED, linewidth=1.0, linestyle=style.DASHED, label=f"allowed {allowed:g}")
    axes.set_xlim(float(speed[0]), float(speed[-1]))
    axes.set_ylim(bottom=0.0)
    panels.legend_above(axes, 2)


def profile(axes: Axes, design: Any, name: str) -> None:
    """A cam, its profile coloured by the pressure."""
    phi = np.linspace(0.0, design.machine.period, 361)
    roller = design.roller_on_cam(name, phi)
    turned = np.radians(design.cam_degrees(phi))
    contact = roller.position - roller.radius * roller.normal
    points = np.exp(-1j * roller.sense * turned) * contact
    _colored(axes, design, points, design.contact(name, phi).pressure, f"{name} cam: pressure [N/mm²]")


def _colored(axes: Axes, design: Any, points: Any, values: Any, title: str) -> None:
    """A profile by its pressure, on a scale from 0 to what is allowed, where that is known; red above it."""
    limit = _allowed_pressure(design)
    panels.drawing(axes, title)
    panels.few_ticks(axes.xaxis, 4)
    panels.heading(axes, title)
    level = 0.5 * (values[:-1] + values[1:])
    pieces, _ = panels.by_value(axes, points, level, limit, 2.6, (1.03, 0.1, 0.05, 0.8))
    above = np.nan_to_num(level) > (math.inf if limit is None else limit)
    undercut = np.isfinite(pieces).all(axis=(1, 2)) & ~np.isfinite(level)
    if above.any():
        panels.again(axes, pieces[above], style.WRONG, 3.2, label=f"above {limit:g}", gid="fails")
    if undercut.any():
        panels.again(axes, pieces[undercut], style.RED, 2.6, label="undercut")
    if above.any() or undercut.any():
        panels.legend_above(axes, 1)
    axes.autoscale_view()
    axes.plot([0.0], [0.0], "+", color=style.BLACK, markersize=8)


def stroke_sheet(design: Any) -> Figure:
    """The sheet of a wide-swing stroke: force, pressure, torque of the cam, residual vibration, and the cam."""
    has = {"pressure": design.section.roller is not None, "residual": design.section.vibration is not None}
    count = 2 + sum(has.values())
    heights, share = [1.0] * count + [1.5] * has["pressure"], 0.21 * count + 0.3 * has["pressure"]
    made, rows = panels.stack(f"{design.spec.name}: loads", heights, share, large=False)
    grid = iter(rows)
    forces(next(grid), design)
    if has["pressure"]:
        pressures(next(grid), design)
    axes = next(grid)
    title = "Torque on the cam" if design.spec.drive is None else "Torque on the crank"
    _stroke(axes, design, title, "torque [N m]", "input_torque")
    axes.axhline(0.0, color=style.BLACK, linewidth=0.8)
    time_axes.once(rows[: 2 + has["pressure"]], 2e3 * math.pi / design.speed)
    if has["residual"]:
        residual(next(grid), design)
    if has["pressure"]:
        stroke_profile(next(grid), design, design.strokes[0])
    return made


def stroke_profile(axes: Axes, design: Any, stroke: Any) -> None:
    """The cam of a stroke, its profile coloured by the pressure; open where the roller stands in its slot."""
    from gearlink.core.machines.wide_swing.strokes import dwell_arc

    parts = [np.linspace(low, high, 121) for low, high in stroke.parts]
    gap = 0.5 * (parts[0][-1] + parts[1][0])
    k = np.concatenate([parts[0], [gap], parts[1]])
    points, pressure = stroke.cam.points(stroke.at.profile(k)[0]).profile, stroke.contact(k).pressure
    rest = dwell_arc(stroke.cam)
    points[len(parts[0])] = complex(np.nan, np.nan)
    axes.plot(rest.real, rest.imag, color=style.GREY, linewidth=0.9, label="_rest of the turn")
    _colored(axes, design, points, pressure, f"{stroke.cam_words}: pressure [N/mm²]")


def _stroke(axes: Axes, design: Any, title: str, ylabel: str, column: str, in_rest: Any = None) -> None:
    """A column of each stroke over the cam angle, and a function of the rests, in which the rollers press as well."""
    table = design.table("contact_stroke", samples=400)
    panels.curves(axes, f"{'cam' if design.spec.drive is None else 'crank'} angle [deg]", ylabel, title)
    for stroke, color, line in zip(design.strokes, panels.CAM_COLORS, panels.CAM_LINES, strict=False):
        later = "" if stroke.name == "main" else "return_"
        values = table[column.format(stroke.name) if "{}" in column else f"{later}{column}"].astype(float)
        x = table[f"{later}cam_angle"]
        axes.plot(x, values, color=color, linewidth=1.5, linestyle=line, label=stroke.words)
        if column.endswith("pressure"):
            _too_much(axes, design, x, values)
    look: Any = {"color": style.GREEN, "linewidth": 1.5, "linestyle": style.CHAIN}
    for number, rest in enumerate(design.rests if in_rest is not None else ()):
        phi = np.linspace(rest.start, rest.start + rest.width, 61)
        axes.plot(np.degrees(phi), in_rest(rest)(phi), **look, label=None if number else "rests")
    axes.set_xlim(0.0, _TURN if design.whole else math.degrees(design.cam.cycle_angle))
    if design.whole:
        style.numbers_at(axes, [30.0 * i for i in range(13)])
    if len(design.strokes) > 1:
        panels.legend_above(axes, 3)


Panel = Callable[["Axes", "LoadsDesign"], None]
_LOCI = "Pins: force on the second link in the axes of the frame, a mark every 30° of the input; dotted: it jumps"
_COLORS = (style.BLUE, style.ORANGE, style.GREEN, style.RED, style.PURPLE, style.SKY, style.BLACK, style.GREY)
_MOST_CURVES = 5
_XY = ("_x", "_y")
_ROUNDING = 1e-12  # of the largest joint force
_SAME = 1e-9
"""Of a force: joints whose forces differ by less are drawn once."""
_LEAST_JUMP, _STEEPER = 0.08, 6.0
"""A jump of a locus: a share of its size, so many times what the steps next to it are."""
_POLAR, _MECHANISM = 1.55, 2.6
"""Height of a polar diagram, and of the mechanism with its forces: the height of its panel, those of curves being 1."""
_LINES: tuple[Any, ...] = ("-", style.LONG, style.CHAIN, style.DOTTED)
"""Curves of one panel differ in their lines as well, for grey print."""


class _Layout(NamedTuple):
    """Small multiples on a page: curves, and below them polar diagrams, in so many columns each.

    Fields
        shown : float - height of the mechanism above them, that of a curve being 1
    """

    curves: int
    polars: int
    across: int
    beside: int
    shown: float

    @property
    def rows(self) -> tuple[int, int]:
        """Of curves and of polar diagrams."""
        return max(1, math.ceil(self.curves / self.across)), math.ceil(self.polars / self.beside)

    @property
    def height(self) -> float:
        """Height that it needs, that of A4 being 1."""
        curves, polars = self.rows
        return 0.115 * (self.row * curves + 0.3 + _POLAR * polars + self.shown)

    @property
    def row(self) -> float:
        """Height of a row of curves: in several columns the legend takes two lines."""
        return 1.0 if self.across == 1 else 1.4


def draw(design: Any) -> Figure:
    """The sheet of `loads` on A4, of many panels on A3: mechanism, curves over the revolution, loads of the pins."""
    if design.kind == "wide-swing-cam" and not design.whole and not design.locked:
        return stroke_sheet(design)
    curves, pins, cams = _panels_of(design)
    names = [*pins, *(f"cam {cam}" for cam in cams), ""]
    shown = 0.0 if design.locked else _MECHANISM
    layout = _Layout(len(curves), len(names), 1, 3, shown)
    large = layout.height > 1.0
    if large:
        layout = _Layout(len(curves), len(names), 2, 5, shown)
    made = panels.page(f"{design.spec.name}: loads", layout.height, large=large)
    curve_rows, polar_rows = layout.rows
    parts = made.add_gridspec(
        3, 1, height_ratios=(max(shown, 1e-3), layout.row * curve_rows + 0.3, _POLAR * polar_rows)
    )
    if shown:
        mechanism(made.add_subplot(parts[0]), design)
    grid: Any = parts[1].subgridspec(curve_rows, layout.across, height_ratios=[1.3, *(curve_rows - 1) * [1.0]])
    odd = -len(curves) % layout.across
    cells = [grid[0, :]] * odd + [grid[divmod(i, layout.across)] for i in range(2 * odd, len(curves) + odd)]
    drawn = [made.add_subplot(cell) for cell in cells]
    for axes, panel in zip(drawn, curves, strict=True):
        panel(axes, design)
        if large:
            panels.few_ticks(axes.yaxis, 4)
    for column in range(layout.across):
        time_axes.once([*drawn[:odd], *drawn[odd + column :: layout.across]], 2e3 * math.pi / design.speed)
    if pins:
        made.supxlabel(_LOCI, fontsize=7.5)
    grid = parts[2].subgridspec(polar_rows, layout.beside)
    for i, name in enumerate(names):
        axes = made.add_subplot(grid[divmod(i, layout.beside)])
        if name.startswith("cam "):
            _profile(axes, design, name.removeprefix("cam "))
        elif name:
            _pin(axes, design, name)
        else:
            _round(axes, "Shaking force", _forces_of(design, "frame"), "force", style.RED)
    return made


def _panels_of(design: Any) -> tuple[list[Panel], list[str], list[str]]:
    """Curves, pins and cams that are drawn; of a machine that friction locks, what needs no forces."""
    if design.locked:
        return ([] if hasattr(design, "strokes") else [_inertia]), [], []
    curves = [panel for panel, wanted in _CURVES if wanted(design)]
    curves[2:2] = _joint_panels(design)
    known = {name for name in design.pins if design.has(name) and name not in design.unknown_joints}
    pins = [names[0] for names in _alike_pins(design, _XY) if names[0] in known]
    return curves, pins, _cams(design)


def _cams(design: Any) -> list[str]:
    """Rollers whose cams are coloured by pressure, which needs a width."""
    if design.section_roller is None:
        return []
    if hasattr(design, "strokes"):
        return [stroke.name for stroke in design.strokes]
    return list(getattr(design, "own_rollers", ()))


def _profile(axes: Axes, design: Any, name: str) -> None:
    if hasattr(design, "strokes"):
        stroke_profile(axes, design, next(each for each in design.strokes if each.name == name))
    else:
        profile(axes, design, name)


def _forces_of(design: LoadsDesign, table: str = "joints") -> dict[str, Any]:
    """Columns of the joints, or of the frame, with 0 for what is rounding beside the largest joint force."""
    found = design.table(table)
    columns = {name: found[name] for name in found.columns}
    if design.locked:  # by friction: the joints have no forces
        return columns
    joints = columns if table == "joints" else design.table("joints")
    sizes = (float(np.abs(joints[name]).max()) for name in _pins_in(design))
    rounding = _ROUNDING * max(sizes, default=0.0)
    return {name: np.where(np.abs(values) < rounding, 0.0, values) for name, values in columns.items()}


def _pins_in(design: LoadsDesign) -> list[str]:
    """The pins that the table of the joints has."""
    columns = design.table("joints").columns
    return [name for name in design.pins if name in columns]


def _over_turn(axes: Axes, design: LoadsDesign, title: str, ylabel: str) -> None:
    turns = min(design.turns, 100)
    panels.curves(axes, "input angle [deg]", ylabel, title)
    axes.set_xlim(0.0, 360.0 * turns)
    step = 30.0 if turns == 1 else 360.0 * max(1, turns // 10)
    style.numbers_at(axes, [i * step for i in range(math.floor(360.0 * turns / step) + 1)])


def _angles(table: Any, design: LoadsDesign) -> Any:
    return np.append(table["input_angle"], 360.0 * min(design.turns, 100))


def _torque(axes: Axes, design: LoadsDesign) -> None:
    """Input torque with its two parts and its mean."""
    _over_turn(axes, design, "Input torque", "torque [N m]")
    table = design.table("torque")
    x = _angles(table, design)
    axes.axhline(0.0, color=style.BLACK, linewidth=0.8)
    parts = ("inertia_part", style.ORANGE, style.LONG, "masses"), ("load_part", style.GREEN, style.CHAIN, "load")
    for column, color, line, words in parts:
        axes.plot(x, closed(table[column]), color=color, linewidth=0.9, linestyle=line, label=f"of the {words}")
    axes.plot(x, closed(table["input_torque"]), color=style.BLUE, linewidth=1.7, label="whole", gid="input-torque")
    mean = design.input_torque_mean
    axes.axhline(mean, color=style.GREY, linewidth=0.9, linestyle=style.DOTTED, label="mean")
    for extreme, above in zip(design.torque_range, (False, True), strict=True):
        panels.extreme(axes, math.degrees(extreme.place), extreme.value, above=above, unit=" N m")
    axes.margins(y=0.3)
    panels.legend_above(axes, 4)


def _inertia(axes: Axes, design: LoadsDesign) -> None:
    """Inertia of all links as the input feels it."""
    _over_turn(axes, design, "Reflected inertia", "J [kg m²]")
    table = design.table("torque")
    axes.plot(_angles(table, design), closed(table["reflected_inertia"]), color=style.PURPLE, linewidth=1.5)
    axes.set_ylim(bottom=0.0)


def _teeth(axes: Axes, design: LoadsDesign) -> None:
    """Tangential force of every mesh; where it crosses zero the teeth change flanks."""
    _over_turn(axes, design, "Tooth forces, tangential", "force [N]")
    table = design.table("teeth")
    axes.axhline(0.0, color=style.BLACK, linewidth=0.8)
    for name, color, line in zip(design.meshes_found, cycle(_COLORS), cycle(_LINES)):
        look: Any = {"color": color, "linestyle": line}
        axes.plot(_angles(table, design), closed(table[name]), linewidth=1.4, label=_words([name]), **look)
        places = design.meshes_found[name].reversal_places
        axes.plot([math.degrees(p) for p in places], [0.0] * len(places), "o", color=style.RED, markersize=4)
    panels.legend_above(axes, 4)


def _joint_panels(design: LoadsDesign) -> list[Panel]:
    """Panels of the joint forces, the largest first: few curves in each, on a scale of their own."""
    joints = design.table("joints")
    groups = sorted(_alike_pins(design, ("",)), key=lambda names: -float(joints[names[0]].max()))
    count = math.ceil(len(groups) / _MOST_CURVES)
    share = math.ceil(len(groups) / max(count, 1))
    return [partial(_forces, groups=groups[share * i : share * (i + 1)], first=i == 0) for i in range(count)]


def _alike_pins(design: LoadsDesign, parts: Sequence[str]) -> list[list[str]]:
    """The pins, those together whose forces have the same parts: "" for the magnitude, "_x", "_y"."""
    joints = design.table("joints")
    return _alike({name: np.stack([joints[name + part] for part in parts]) for name in _pins_in(design)})


def _alike(forces: Mapping[str, Reals]) -> list[list[str]]:
    """Names of forces, those together that are the same but for rounding of the largest."""
    found: list[list[str]] = []
    rounding = _SAME * max((float(np.abs(values).max()) for values in forces.values()), default=0.0)
    for name, values in forces.items():
        for names in found:
            other = forces[names[0]]
            if np.allclose(values, other, rtol=_SAME, atol=rounding):
                names.append(name)
                break
        else:
            found.append([name])
    return found


def _words(names: Sequence[str]) -> str:
    """Joints or meshes as they are called on sheets.

    Example
        >>> _words(["A", "F_pinion"])
        'A, F pinion'
    """
    return ", ".join(name.replace("_", " ") for name in names)


def _forces(axes: Axes, design: LoadsDesign, groups: Sequence[Sequence[str]], *, first: bool) -> None:
    """Magnitude of the force of some pins, with the maximum of each."""
    _over_turn(axes, design, "Joint forces" if first else "Joint forces, smaller ones", "force [N]")
    columns = _forces_of(design)
    for names, color, line in zip(groups, cycle(_COLORS), cycle(_LINES)):
        values = columns[names[0]]
        label = f"{_words(names)}, ≤ {float(f'{values.max():.3g}'):g} N"
        axes.plot(_angles(columns, design), closed(values), color=color, linestyle=line, linewidth=1.3, label=label)
    axes.set_ylim(bottom=0.0)
    panels.legend_above(axes, 4)


def _speed(axes: Axes, design: LoadsDesign) -> None:
    """Speed of the input with its flywheel or motor."""
    _over_turn(axes, design, "Speed of the input", "speed [1/min]")
    table = design.table("speed")
    axes.plot(_angles(table, design), closed(table["speed"]), color=style.BLUE, linewidth=1.5)
    axes.margins(y=0.15)


def _deflection(axes: Axes, design: LoadsDesign) -> None:
    """Output with and without its deflection, in the dwells; steady state."""
    vibrating = design.vibrating
    unit = "mm" if vibrating.slides else "deg"
    _over_turn(axes, design, "Deflection of the output, steady state", f"deflection [{unit}]")
    phi = np.linspace(0.0, design.machine.period, max(721, vibrating.rows(design.machine.period)))
    axes.axhline(0.0, color=style.BLACK, linewidth=0.8)
    axes.plot(np.degrees(phi), vibrating.deflection(phi), color=style.PURPLE, linewidth=1.2)
    words: str | None = "dwell"
    for start, width in design.dwell_zones:
        for turn in (-1, 0):
            low = math.degrees(start + turn * design.machine.period)
            axes.axvspan(low, low + math.degrees(width), color=style.LIGHT, linewidth=0, zorder=0, label=words)
            words = None
    panels.legend_above(axes, 1)


def _pin(axes: Axes, design: LoadsDesign, name: str) -> None:
    """Force on the second link of a joint as a curve, round the joint."""
    columns = _forces_of(design)
    names = next(names for names in _alike_pins(design, _XY) if name in names)
    title = f"Pin{'s' if len(names) > 1 else ''} {_words(names)}"
    _round(axes, title, columns, name, style.BLUE)


def _round(axes: Axes, title: str, columns: dict[str, Any], name: str, color: str) -> None:
    """A force about its joint with marks of the input angle, or that it is 0."""
    x, y = columns[f"{name}_x"], columns[f"{name}_y"]
    _locus(axes, title, x, y, color)
    if x.any() or y.any():
        _angle_marks(axes, columns, x, y)
    else:
        axes.text(0.5, 0.62, "0 N throughout", transform=axes.transAxes, fontsize=8, ha="center")


_CROWDED = 0.13
"""Of the size of a curve: numbers of marks that are nearer to each other would lie on each other."""


def _angle_marks(axes: Axes, columns: dict[str, Any], x: Any, y: Any) -> None:
    """Marks every 30 deg of the input's first turn, with the angle every quarter; near ones share their words."""
    near = _CROWDED * max(np.ptp(x), np.ptp(y))
    named: list[tuple[complex, list[str]]] = []
    for i, angle in enumerate(columns["input_angle"].tolist()):
        if angle % 30.0 or angle >= _TURN:
            continue
        at, quarter = complex(x[i], y[i]), angle % 90.0 == 0.0
        axes.plot([x[i]], [y[i]], "o", color=style.BLACK, markersize=3.6 if quarter else 2.0, zorder=4,
                  gid="angle-mark")  # fmt: skip
        if quarter:
            words = next((words for place, words in named if abs(place - at) < near), None)
            if words is None:
                named.append((at, words := []))
            words.append(f"{angle:.0f}°")
    for at, words in named:
        look: Any = {"fontsize": 6.0, "path_effects": style.outlined(), "zorder": 6}
        axes.annotate(", ".join(words), (at.real, at.imag), (3, 3), textcoords="offset points", **look)


def _jumps(points: Any) -> Any:
    """Numbers of the steps of a closed locus that are jumps: loads begin or end there.

    Example
        >>> import numpy as np
        >>> _jumps(np.array([0, 1, 2, 30, 31, 32, 0]) + 0j).tolist()
        [2, 5]
    """
    steps = np.abs(np.diff(points))
    usual = np.maximum(np.roll(steps, 1), np.roll(steps, -1))
    return np.flatnonzero((steps > _LEAST_JUMP * np.abs(points).max()) & (steps > _STEEPER * usual))


def _locus(axes: Axes, title: str, x: Any, y: Any, color: str) -> None:
    """A force as a curve about its joint; what is drawn dotted is a jump."""
    style.curves(axes, "", "")
    panels.heading(axes, f"{title} [N]")
    axes.set_aspect("equal", adjustable="datalim")
    whole = closed(x) + 1j * closed(y)
    places = _jumps(whole)
    torn = np.insert(whole, places + 1, complex(math.nan, math.nan))
    axes.plot(torn.real, torn.imag, color=color, linewidth=1.4)
    for i in places:
        chord = whole[i : i + 2]
        axes.plot(chord.real, chord.imag, color=color, linewidth=0.7, linestyle=style.DOTTED, gid="jump")
    axes.plot([0.0], [0.0], "+", color=style.BLACK, markersize=9)
    panels.small_ticks(axes)
    panels.few_ticks(axes.xaxis, 4)
    panels.few_ticks(axes.yaxis, 4)
    axes.tick_params(labelsize=7)


def _rolls(design: Any) -> bool:
    """Whether rollers of the design run on cams."""
    return hasattr(design, "own_rollers") or hasattr(design, "strokes")


_CURVES: tuple[tuple[Panel, Callable[[Any], bool]], ...] = (
    (_torque, lambda _: True),
    (_inertia, lambda _: True),
    (_teeth, lambda design: bool(design.meshes_found)),
    (_speed, lambda design: design.speed_min is not None),
    (forces, _rolls),
    (pressures, lambda design: _rolls(design) and design.section.roller is not None),
    (residual, lambda design: design.section.vibration is not None and design.residual_amplitude),
    (_deflection, lambda design: design.section.vibration is not None and design.dwell_twist is not None),
)


_COLUMNS = 4
"""Of a force: joints whose forces differ by less share a panel."""


def draws(design: Any) -> bool:
    """Whether a design has forces."""
    loads = shown.loads_design(design)
    return loads is not None and not loads.locked


def draw_forces(design: Any) -> Figure:
    """The mechanism at the largest torque, the torque over the input, and every force on a scale of its own."""
    loads = shown.loads_design(design)
    groups = list(courses(loads).items())
    rows = math.ceil(len(groups) / _COLUMNS)
    made = panels.page(f"{loads.spec.name}: forces", min(1.0, 0.34 + 0.135 * rows))
    grid: Any = made.add_gridspec(rows + 1, _COLUMNS, height_ratios=[2.4] + [1.0] * rows)
    half = _COLUMNS // 2
    mechanism(made.add_subplot(grid[0, :half]), loads)
    _force_torque(made.add_subplot(grid[0, half:]), loads)
    for k, (names, values) in enumerate(groups):
        _force(made.add_subplot(grid[1 + k // _COLUMNS, k % _COLUMNS]), loads, names, values)
    return made


def _inputs(loads: Any) -> Reals:
    return np.linspace(0.0, loads.machine.period, 361)


def courses(loads: Any) -> dict[str, Reals]:
    """Magnitudes of all forces over the period [N], those that are equal under one name, the largest first."""
    found = vectors.loads_of(loads.machine.reactions(_inputs(loads)), tuple(loads.unknown_joints))
    sizes = {name: np.abs(load.force) for name, load in found.items()}
    rounding = _ROUNDING * max((float(each.max()) for each in sizes.values()), default=0.0)
    sizes = {name: np.where(each < rounding, 0.0, each) for name, each in sizes.items()}
    groups = sorted(_alike(sizes), key=lambda names: -float(sizes[names[0]].max()))
    return {_words(names): sizes[names[0]] for names in groups}


def largest_torque(loads: Any) -> float:
    """Input at which the torque is largest in magnitude [rad]."""
    return float(max(loads.torque_range, key=lambda extreme: abs(extreme.value)).place)


def mechanism(axes: Axes, loads: Any) -> None:
    """The mechanism with the forces on the second link of each joint, at the input of the largest torque."""
    design, q = analysed(loads), largest_torque(loads)
    given = design.moving.input
    within = q % (given.end - given.start) if given.turns else q
    scene = shown.build(design, np.array([fraction_at(frame_of(design), within)]), shown.wishes("force"))
    panels.drawing(axes, f"At the largest torque, input angle {math.degrees(q):.4g}°")
    scene_axes.draw(axes, scene)


def analysed(loads: Any) -> Any:
    """The design of the same file that its scene is made of."""
    if not hasattr(type(loads), "unknown_joints"):
        return loads
    commands = loads.spec.commands()
    return loads.of_command("analyze" if "analyze" in commands else commands[0])


def _over_input(axes: Axes, loads: Any) -> Reals:
    x = np.degrees(_inputs(loads))
    panels.curves(axes, "", "")
    axes.set_xlim(0.0, float(x[-1]))
    style.numbers_at(axes, [float(each) for each in np.linspace(0.0, x[-1], 5)])
    axes.tick_params(labelsize=6.5)
    return x


def _force_torque(axes: Axes, loads: Any) -> None:
    x = _over_input(axes, loads)
    panels.heading(axes, "Input torque [N m] over the input [deg]")
    axes.axhline(0.0, color=style.BLACK, linewidth=0.7)
    axes.plot(x, loads.machine.torque(_inputs(loads)), color=style.BLUE, linewidth=1.5, gid="torque")
    axes.axvline(math.degrees(largest_torque(loads)), color=style.GREY, linewidth=0.9, linestyle=style.DASHED)
    for extreme, above in zip(loads.torque_range, (False, True), strict=True):
        panels.extreme(axes, math.degrees(extreme.place), extreme.value, above=above, unit=" N m")
    axes.margins(y=0.25)


def _force(axes: Axes, loads: Any, names: str, values: Reals) -> None:
    x = _over_input(axes, loads)
    k = int(np.argmax(values))
    words = names if len(names) < 24 else f"{names[:22]}…"
    axes.set_title(f"{words}: ≤ {float(f'{values[k]:.4g}'):g} N", loc="left", fontsize=7.5, fontweight="bold")
    axes.plot(x, values, color=style.RED, linewidth=1.2, gid=f"force {names}")
    axes.plot(x[k : k + 1], values[k : k + 1], "o", color=style.BLACK, markersize=3)
    panels.few_ticks(axes.yaxis, 4)
    axes.set_ylim(0.0, 1.15 * float(values[k]) or 1.0)
