"""Sheet of the loads of any design: torque over the turn, reflected inertia, joint forces, teeth, shaking force."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import cycle
from typing import TYPE_CHECKING, Any

from gearlink.cli.views.figures import loads_contact
from gearlink.cli.views.figures.drawing import panels, style, time_axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.studies.loads.design import LoadsDesign

Panel = Callable[["Axes", "LoadsDesign"], None]
_COLORS = (style.BLUE, style.ORANGE, style.GREEN, style.RED, style.PURPLE, style.SKY, style.BLACK, style.GREY)
_POLAR_COLUMNS = 3
_LINES: tuple[Any, ...] = ("-", style.LONG, style.CHAIN, style.DOTTED)
"""Curves of one panel differ in their lines as well, for grey print."""


def draw(design: Any) -> Figure:
    """The sheet of `loads`: curves over the turn one below the other, then the loads of the pins as polar diagrams."""
    if design.kind == "wide-swing-cam" and not design.whole and not design.locked:
        return loads_contact.stroke_sheet(design)
    curves, pins, cams = _panels_of(design)
    polar = math.ceil((len(pins) + len(cams) + 1) / _POLAR_COLUMNS)
    heights = [1.0 if i else 1.3 for i in range(len(curves))] + [1.55] * polar
    made = panels.page(f"{design.spec.name}: loads", min(1.6, 0.115 * sum(heights)))
    grid = made.add_gridspec(len(heights), _POLAR_COLUMNS, height_ratios=heights)
    stacked = [made.add_subplot(grid[row, :]) for row in range(len(curves))]
    for axes, panel in zip(stacked, curves, strict=True):
        panel(axes, design)
    time_axes.once(stacked, 2e3 * math.pi / design.speed)
    places = [(len(curves) + i // _POLAR_COLUMNS, i % _POLAR_COLUMNS) for i in range(len(pins) + len(cams) + 1)]
    for (row, column), name in zip(places, [*pins, *(f"cam {cam}" for cam in cams), ""], strict=True):
        axes = made.add_subplot(grid[row, column])
        if name.startswith("cam "):
            _profile(axes, design, name.removeprefix("cam "))
        elif name:
            _pin(axes, design, name)
        else:
            _shaking(axes, design)
    return made


def _panels_of(design: Any) -> tuple[list[Panel], list[str], list[str]]:
    """Curves, pins and cams that are drawn; of a machine that friction locks, what needs no forces."""
    if design.locked:
        return ([] if hasattr(design, "strokes") else [_inertia]), [], []
    curves = [panel for panel, wanted in _CURVES if wanted(design)]
    pins = [name for name in design.pins if design.has(name) and name not in design.unknown_joints]
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
        stroke = next(each for each in design.strokes if each.name == name)
        loads_contact.stroke_profile(axes, stroke)
    else:
        loads_contact.profile(axes, design, name)


def _columns(design: LoadsDesign, table: str) -> dict[str, Any]:
    import numpy as np

    found = design.table(table)
    return {name: np.asarray(values) for name, values in zip(found.columns, found.data, strict=True)}


def _closed(values: Any) -> Any:
    import numpy as np

    return np.append(values, values[:1])


def _over_turn(axes: Axes, design: LoadsDesign, title: str, ylabel: str) -> None:
    turns = min(design.turns, 100)
    style.curves(axes, "input angle [deg]", ylabel)
    panels.small_ticks(axes)
    panels.heading(axes, title)
    axes.set_xlim(0.0, 360.0 * turns)
    step = 30.0 if turns == 1 else 360.0 * max(1, turns // 10)
    style.numbers_at(axes, [i * step for i in range(math.floor(360.0 * turns / step) + 1)])


def _angles(columns: dict[str, Any], design: LoadsDesign) -> Any:
    import numpy as np

    return np.append(columns["input_angle"], 360.0 * min(design.turns, 100))


def _torque(axes: Axes, design: LoadsDesign) -> None:
    """Input torque with its two parts and its mean."""
    _over_turn(axes, design, "Input torque", "torque [N m]")
    columns = _columns(design, "torque")
    x = _angles(columns, design)
    axes.axhline(0.0, color=style.BLACK, linewidth=0.8)
    axes.plot(
        x,
        _closed(columns["inertia_part"]),
        color=style.ORANGE,
        linewidth=0.9,
        linestyle=style.LONG,
        label="of the masses",
    )
    axes.plot(
        x, _closed(columns["load_part"]), color=style.GREEN, linewidth=0.9, linestyle=style.CHAIN, label="of the load"
    )
    axes.plot(x, _closed(columns["input_torque"]), color=style.BLUE, linewidth=1.7, label="whole", gid="input-torque")
    mean = design.input_torque_mean
    axes.axhline(mean, color=style.GREY, linewidth=0.9, linestyle=style.DOTTED, label="mean")
    for extreme, above in zip(design.torque_range, (False, True), strict=True):
        panels.extreme(axes, math.degrees(extreme.place), extreme.value, above=above, unit=" N m")
    axes.margins(y=0.3)
    panels.legend_above(axes, 4)


def _inertia(axes: Axes, design: LoadsDesign) -> None:
    """Inertia of all links as the input feels it."""
    _over_turn(axes, design, "Reflected inertia", "J [kg m²]")
    columns = _columns(design, "torque")
    axes.plot(_angles(columns, design), _closed(columns["reflected_inertia"]), color=style.PURPLE, linewidth=1.5)
    axes.set_ylim(bottom=0.0)


def _teeth(axes: Axes, design: LoadsDesign) -> None:
    """Tangential force of every mesh; where it crosses zero the teeth change flanks."""
    _over_turn(axes, design, "Tooth forces, tangential", "force [N]")
    columns = _columns(design, "teeth")
    axes.axhline(0.0, color=style.BLACK, linewidth=0.8)
    for name, color, line in zip(design.meshes_found, cycle(_COLORS), cycle(_LINES)):
        look: Any = {"color": color, "linestyle": line}
        axes.plot(_angles(columns, design), _closed(columns[name]), linewidth=1.4, label=name, **look)
        places = design.meshes_found[name].reversal_places
        axes.plot([math.degrees(p) for p in places], [0.0] * len(places), "o", color=style.RED, markersize=4)
    panels.legend_above(axes, 4)


def _forces(axes: Axes, design: LoadsDesign) -> None:
    """Magnitude of the force of every pin."""
    _over_turn(axes, design, "Joint forces", "force [N]")
    columns = _columns(design, "joints")
    for i, name in enumerate(n for n in design.pins if n in columns):
        # A machine has more pins than there are colours or lines, not than pairs of them.
        look: Any = {"color": _COLORS[i % len(_COLORS)], "linestyle": _LINES[(i + i // len(_COLORS)) % len(_LINES)]}
        axes.plot(_angles(columns, design), _closed(columns[name]), linewidth=1.2, label=name, **look)
    axes.set_ylim(bottom=0.0)
    panels.legend_above(axes, 8)


def _speed(axes: Axes, design: LoadsDesign) -> None:
    """Speed of the input with its flywheel or motor."""
    _over_turn(axes, design, "Speed of the input", "speed [rev/min]")
    columns = _columns(design, "speed")
    axes.plot(_angles(columns, design), _closed(columns["speed"]), color=style.BLUE, linewidth=1.5)
    axes.margins(y=0.15)


def _deflection(axes: Axes, design: LoadsDesign) -> None:
    """Output with and without its deflection, in the dwells; steady state."""
    import numpy as np

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
    columns = _columns(design, "joints")
    _locus(axes, f"Pin {name}", columns[f"{name}_x"], columns[f"{name}_y"], style.BLUE)


def _shaking(axes: Axes, design: LoadsDesign) -> None:
    columns = _columns(design, "frame")
    _locus(axes, "Shaking force", columns["force_x"], columns["force_y"], style.RED)


def _locus(axes: Axes, title: str, x: Any, y: Any, color: str) -> None:
    style.curves(axes, "", "")
    panels.heading(axes, f"{title} [N]")
    axes.set_aspect("equal", adjustable="datalim")
    axes.plot(_closed(x), _closed(y), color=color, linewidth=1.4)
    axes.plot([0.0], [0.0], "+", color=style.BLACK, markersize=9)
    axes.plot(x[:1], y[:1], "o", color=color, markersize=4)
    panels.small_ticks(axes)
    from gearlink.cli.views.figures.drawing.ticks import RoundNumbers

    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(RoundNumbers(4))
    axes.tick_params(labelsize=7)


def _always(_design: LoadsDesign) -> bool:
    return True


_CURVES: tuple[tuple[Panel, Callable[[Any], bool]], ...] = (
    (_torque, _always),
    (_inertia, _always),
    (_forces, _always),
    (_teeth, lambda design: bool(design.meshes_found)),
    (_speed, lambda design: design.speed_min is not None),
    (loads_contact.forces, lambda design: hasattr(design, "own_rollers")),
    (loads_contact.pressures, lambda design: hasattr(design, "own_rollers") and design.section.roller is not None),
    (loads_contact.stroke_forces, lambda design: hasattr(design, "strokes")),
    (loads_contact.stroke_pressures, lambda design: hasattr(design, "strokes") and design.section.roller is not None),
    (loads_contact.residual, lambda design: design.section.vibration is not None and design.residual_amplitude),
    (_deflection, lambda design: design.section.vibration is not None and design.dwell_twist is not None),
)
