"""Scene and pictures of a machine: timing as a line and as a circle, torques on the main shaft, register.

The scene has all members side by side on one machine angle, each as large as its panel allows.
"""

from __future__ import annotations

import math
from dataclasses import replace
from textwrap import fill
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import panels, style
from gearlink.cli.views.figures.sheets import timing_sheet
from gearlink.cli.views.scenes.linkages import builder
from gearlink.cli.views.scenes.scene import (
    PHASE_TINTS,
    Arrow,
    Body,
    Chain,
    Chart,
    Curve,
    Line,
    Mark,
    Part,
    Points,
    Readout,
    Reals,
    Scene,
    loop,
    points_of,
    track,
)
from gearlink.core.machines.machine.relations import Before, Value

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.machines.machine.design import Machine
    from gearlink.core.machines.machine.series import OnShaft


_MEMBER_COLORS = (style.BLUE, style.ORANGE, style.GREEN, style.PURPLE, style.RED, style.SKY, style.GREY, style.BLACK)
_CELL = 100.0
"""Width of the place of a member, and its height; what it shows is scaled into nine tenths of it."""
_MOST_CURVES = 12
"""Members that an animation can tell apart in one chart and one line of values."""
_WIDE = 1.7
"""Places beside each other over those one above the other."""


def build(design: Machine, fraction: Reals) -> Scene:
    """Positions over fractions of the cycle of the machine."""
    names = list(design.spec.members)
    columns = max(1, math.ceil(math.sqrt(_WIDE * len(names))))
    parts: list[Part] = []
    marks: list[Mark] = []
    for i, name in enumerate(names):
        corner = _CELL * complex(i % columns, -(i // columns))
        own = _own(design, name, fraction)
        scale, shift = _fit(own, corner)
        parts += [_moved(part, scale, shift) for part in own.parts]
        marks += [Mark(track(scale * mark.point + shift, fraction), "", pivot=True) for mark in own.marks if mark.pivot]
        marks.append(Mark(track(corner + complex(0.5, 0.96) * _CELL, fraction), name))
    degrees = 360.0 * design.cycle_turns * fraction
    readouts, chart = [Readout("machine", "°", degrees)], None
    if len(names) <= _MOST_CURVES:
        now = {name: _shown(design, name, degrees) for name in names}
        readouts += [Readout(name, unit, y) for name, (y, unit) in now.items()]
        chart = _chart(design, degrees)
    return Scene(parts=tuple(parts), marks=tuple(marks), chart=chart, readouts=tuple(readouts))


def _own(design: Machine, name: str, fraction: Reals) -> Scene:
    """The scene of a member where its own input stands."""
    member = design.members[name]
    angle = 2.0 * math.pi * design.cycle_turns * fraction - math.radians(design.phases[design.spec.root(name)])
    return builder(member.design.kind)(member.design, _fraction(member, angle))


def _fraction(member: OnShaft, angle: Reals) -> Reals:
    """Fractions of the loop of a member: over a range it goes forth and back as a cosine."""
    given = member.motion.input
    share = (member.reduced(member.input(angle, 0)[0])[0] - given.start) / (given.end - given.start)
    if member.period is not None:
        return np.asarray(share)
    return np.asarray(np.arccos(1.0 - 2.0 * share) / (2.0 * math.pi))


def _fit(own: Scene, corner: complex) -> tuple[float, complex]:
    """Scale and shift that bring a scene into its place."""
    ends = np.concatenate([_ends(part) for part in own.parts])
    low = complex(ends.real.min(), ends.imag.min())
    size = complex(ends.real.max(), ends.imag.max()) - low
    scale = 0.88 * _CELL / max(size.real, size.imag)
    return scale, corner + 0.5 * complex(_CELL, 0.94 * _CELL) - scale * (low + 0.5 * size)


def _ends(part: Part) -> Points:
    """Points as far out as a part ever reaches."""
    if not isinstance(part, Body):
        return np.concatenate([points_of([part]), part.start if isinstance(part, Arrow) else []])
    if part.repeats == 0 or np.ptp(part.turn) > math.pi:
        reach = float(np.abs(part.outline).max(initial=0.0))
        return np.concatenate([part.place + reach * corner for corner in (1.0, -1.0, 1j, -1j)])
    return points_of([part])


def _moved(part: Part, scale: float, shift: complex) -> Part:
    if isinstance(part, Line):
        return replace(part, points=scale * part.points + shift, name="")
    if isinstance(part, Chain):
        return replace(part, joints=tuple(scale * joint + shift for joint in part.joints), width=0.7 * part.width)
    if isinstance(part, Arrow):
        return replace(part, start=scale * part.start + shift, vector=scale * part.vector)
    turn = np.unwrap(part.turn, period=2.0 * math.pi / max(part.repeats, 1))  # its loop may end within the cycle
    body: Body = replace(part, outline=scale * part.outline, place=scale * part.place + shift, pitch=scale * part.pitch)
    return replace(body, turn=turn, label="", name="")


def _shown(design: Any, name: str, degrees: Reals) -> tuple[Reals, str]:
    """The output of a member at machine angles, in mm or deg."""
    member: Any = design.members[name]
    value = member.rates(np.radians(degrees - design.phases[design.spec.root(name)]), 0)[0]
    return (np.degrees(value), "°") if member.course.unit == "rad" else (value, " mm")


def _chart(design: Machine, degrees: Reals) -> Chart:
    """The output of every member as a share of its own range."""
    whole = 360.0 * design.cycle_turns * loop(361)
    curves = []
    for i, name in enumerate(design.spec.members):
        y, now = _shown(design, name, whole)[0], _shown(design, name, degrees)[0]
        low, span = float(y.min()), float(np.ptp(y)) or 1.0
        curves.append(Curve(name, _MEMBER_COLORS[i % len(_MEMBER_COLORS)], (y - low) / span, (now - low) / span))
    return Chart("machine angle [deg]", "share of the range [1]", whole, degrees, tuple(curves))


_BAR = 0.16
"""Height of the bar with the runs below a curve, the row being 1."""
_STATUS = {"pass": style.GREEN, "warn": style.ORANGE, "fail": style.WRONG}
_INNER = 3.0
_AROUND = 0.16
"""Of the height of A4: title, axis and legend of the timing."""


def draw(command: str, design: Any) -> Figure:
    """The picture of a command, as wide as a page."""
    if command == "loads":
        return _loads(design)
    if command == "register":
        return _register(design)
    return line_sheet(design, share=_AROUND + 0.085 * len(design.spec.members))


_ROW, _RING = 0.034, 0.03
"""Of the height of A4: two lines of letters in a row of the timing, and one in a ring, above and below its middle."""


def _least_height(design: Any, each: float) -> float:
    """Height in which the names of the members can be read, that of A4 being 1."""
    return _AROUND + each * len(design.spec.members)


def line_sheet(design: Any, **paper: Any) -> Figure:
    """The timing as a line, on A3 or larger where nothing is said of the paper."""
    paper = paper or {"large": True, "lying": True}
    made = panels.page(f"{design.spec.name}: timing", least=_least_height(design, _ROW), **paper)
    _line(made.add_subplot(), design)
    return made


def circle_sheet(design: Any) -> Figure:
    """The timing as a circle, A3 or larger."""
    made = panels.page(f"{design.spec.name}: timing\n", least=_least_height(design, _RING), large=True, lying=True)
    axes: Any = made.add_subplot(projection="polar")
    _circle(axes, design)
    return made


def _degrees(design: Any) -> Any:
    return np.linspace(0.0, design.timing.dial, 720 * design.cycle_turns + 1)


def _runs(design: Any, name: str) -> list[tuple[str, float, float]]:
    """Runs of a member, from a start on the dial."""
    phase = design.phases[design.spec.root(name)]
    runs = [(run, design.timing.on_dial(phase + run.start)) for run in design.timing.runs(name)]
    return [(run.name, start, start + run.duration) for run, start in runs]


_NAME_WIDTH, _RELATION_WIDTH = 16, 54
"""Characters in a line of a member's name beside its row, and of a relation beside the circle."""

# The line

_SAMPLED = 1e-5  # of the range: rows do not meet a minimum more closely


def _line(axes: Axes, design: Any) -> None:
    """A row for each member: its curve, its runs below; relations as arrows with their margins."""
    members, dial = list(design.spec.members), design.timing.dial
    rows = {name: float(len(members) - 1 - i) for i, name in enumerate(members)}
    labels = []
    for name, bottom in rows.items():
        values, unit = _shown(design, name, _degrees(design))
        low, high = float(values.min()), float(values.max())
        share = (values - low) / (high - low) if high > low else np.zeros_like(values)
        axes.plot(_degrees(design), bottom + _BAR + 0.1 + 0.6 * share, color=style.BLUE, linewidth=1.6, label=name)
        _bars(axes, design, name, bottom)
        low, high = (0.0 if abs(end) < _SAMPLED * (high - low) else end for end in (low, high))
        labels.append(
            f"{fill(name.replace('_', ' '), _NAME_WIDTH)}\n{style.number(low, 4)} to {style.number(high, 4)}{unit}"
        )
    for relation, margin in design.margins:
        _relation(axes, design, rows, relation, margin)
    style.curves(axes, "machine angle [deg]", "")
    axes.set_xlim(0.0, dial)
    axes.set_ylim(-0.08, len(members) + 0.12)
    style.numbers_at(axes, list(range(0, int(dial) + 1, 30 * design.cycle_turns)))
    axes.set_yticks([bottom + 0.5 for bottom in rows.values()], labels, fontsize=8)
    axes.tick_params(axis="y", length=0)
    for bottom in rows.values():
        axes.axhline(bottom - 0.04, color=style.LIGHT, linewidth=0.8)
    _key(axes, design)


def _bars(axes: Axes, design: Any, name: str, bottom: float) -> None:
    from matplotlib.patches import Rectangle

    dial = design.timing.dial
    for word, start, end in _runs(design, name):
        for shift in (0.0, -dial):
            if end + shift <= 0.0:
                continue
            look: dict[str, Any] = {"facecolor": PHASE_TINTS[word], "edgecolor": style.GREY, "linewidth": 0.6}
            axes.add_artist(Rectangle((start + shift, bottom), end - start, _BAR, **look))
        middle = 0.5 * (start + end) % dial
        if end - start > 0.06 * dial and 0.03 * dial < middle < 0.97 * dial:
            axes.text(middle, bottom + 0.5 * _BAR, word, ha="center", va="center", fontsize=6.5)


def _relation(axes: Axes, design: Any, rows: dict[str, float], relation: Any, margin: float) -> None:
    """An arrow from one event to the other, or a mark at the place of a value."""
    color = _STATUS[design.status_of(relation, margin)]
    words = style.number(margin, 4) + ("" if isinstance(relation, Value) else "°")
    if isinstance(relation, Value):
        at = design.timing.angle(relation.at, design.phases)
        y = rows[relation.of.partition(".")[0]] + 0.85
        axes.plot([at], [y], "v", color=color, markersize=5, zorder=6)
        _words(axes, at, y, words, color)
        return
    one, two = (relation.one, relation.two) if isinstance(relation, Before) else (
        relation.two._replace(end="start"), relation.one._replace(end="start")
    )  # fmt: skip
    start = design.timing.angle(one, design.phases)
    way = design.timing.wrap(design.timing.angle(two, design.phases) - start)
    ends = _height(design, rows, one, two), _height(design, rows, two, one)
    for shift in (0.0, -design.timing.dial if start + way > design.timing.dial else design.timing.dial):
        a, b = start + shift, start + way + shift
        if max(a, b) <= 0.0 or min(a, b) >= design.timing.dial:
            continue
        shape = {"arrowstyle": "-|>", "color": color, "linewidth": 1.1, "shrinkA": 0, "shrinkB": 0}
        drawn = axes.annotate("", (b, ends[1]), (a, ends[0]), arrowprops=shape, annotation_clip=False, zorder=6)
        if drawn.arrow_patch is not None:
            drawn.arrow_patch.set_clip_box(axes.bbox)
        middle = 0.5 * (a + b)
        if 0.0 <= middle <= design.timing.dial:
            _words(axes, middle, 0.5 * sum(ends), words, color)


def _height(design: Any, rows: dict[str, float], moment: Any, other: Any) -> float:
    """Where an event stands in its row; an angle of the machine stands with the other one."""
    named = moment if not isinstance(moment, float) else other
    of = named.member or design.spec.events[named.what].of.partition(".")[0]
    return rows[of] + 0.5


def _words(axes: Axes, x: float, y: float, words: str, color: str) -> None:
    axes.annotate(words, (x, y), (0, 3), textcoords="offset points", ha="center", va="bottom", fontsize=7.5,
                  color=color, path_effects=style.outlined(), zorder=8)  # fmt: skip


def _key(axes: Axes, design: Any) -> None:
    """What bars and arrows mean, below."""
    from matplotlib.transforms import ScaledTranslation

    for word in ("rise", "dwell", "return"):
        axes.bar([0.0], [0.0], color=PHASE_TINTS[word], edgecolor=style.GREY, linewidth=0.6, label=word)
    for status, words in (("pass", "relation met, with its margin"), ("fail", "relation not met")):
        if any(design.status_of(relation, margin) == status for relation, margin in design.margins):
            axes.plot([], [], color=_STATUS[status], linewidth=1.4, label=words)
    handles, labels = axes.get_legend_handles_labels()
    kept = [(handle, label) for handle, label in zip(handles, labels, strict=True) if label not in design.spec.members]
    down = ScaledTranslation(0.0, -0.47, axes.figure.dpi_scale_trans)
    place: dict[str, Any] = {"bbox_to_anchor": (0.5, 0.0), "bbox_transform": axes.transAxes + down}
    axes.legend(*zip(*kept, strict=True), loc="upper center", ncols=5, frameon=False, fontsize=7.5, **place)


# The circle


def _circle(axes: Any, design: Any) -> None:
    """A ring for each member with its runs and its curve, the first outside; machine angle 0 at the top, clockwise."""
    members, dial = list(design.spec.members), design.timing.dial
    marks = np.arange(0.0, dial, 10 * design.cycle_turns)
    named = [f"{each:g}°" if i % 3 == 0 else "" for i, each in enumerate(marks)]
    timing_sheet.clock(axes, 2.0 * math.pi * marks / dial, named, linewidth=0.5)
    radii = {name: _INNER + len(members) - 1 - i for i, name in enumerate(members)}
    turn = 2.0 * math.pi / dial
    for name, radius in radii.items():
        for word, start, end in _runs(design, name):
            look: dict[str, Any] = {"color": PHASE_TINTS[word], "edgecolor": style.GREY, "linewidth": 0.7}
            axes.bar(start * turn, 0.92, (end - start) * turn, radius, align="edge", **look)
            middle = 0.5 * (start + end) * turn
            if (end - start) * turn * (radius + 0.5) > 0.55:
                last = end % dial or dial  # a run that ends with the turn ends at 360
                turned = timing_sheet.along(middle)
                axes.text(middle, radius + 0.14, f"{word} {start % dial:.4g}–{last:.4g}°", fontsize=7,
                          ha="center", va="center", rotation=turned, rotation_mode="anchor")  # fmt: skip
        values, _ = _shown(design, name, _degrees(design))
        span = float(np.ptp(values))
        share = (values - values.min()) / span if span > 0.0 else np.zeros_like(values)
        axes.plot(_degrees(design) * turn, radius + 0.26 + 0.58 * share, color=style.BLUE, linewidth=1.3)
        axes.text(0.0, radius + 0.46, name.replace("_", " "), fontsize=9, fontweight="bold", ha="center", va="center",
                  path_effects=style.outlined(), zorder=8)  # fmt: skip
    axes.set_ylim(0.0, _INNER + len(members))
    axes.text(0.5, 0.5, "machine angle,\nclockwise from the top", transform=axes.transAxes, ha="center", va="center",
              fontsize=9, color=style.GREY)  # fmt: skip
    _list_of_relations(axes, design)


def _list_of_relations(axes: Any, design: Any) -> None:
    """Relations with their margins beside the circle."""
    for relation, margin in design.margins:
        unit = "" if isinstance(relation, Value) else "°"
        words = f"{relation.text}: {style.number(margin, 4)}{unit}"
        axes.plot([], [], color=_STATUS[design.status_of(relation, margin)], linewidth=3,
                  label=fill(words, _RELATION_WIDTH, subsequent_indent="  "))  # fmt: skip
    if design.margins:
        axes.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0), frameon=False, fontsize=8, title="margins")


# Loads and register

_COLORS = (style.BLUE, style.ORANGE, style.GREEN, style.PURPLE, style.SKY, style.RED, style.GREY, style.BLACK)
_LINES: tuple[Any, ...] = ("-", style.LONG, style.CHAIN, style.DOTTED)


def _loads(design: Any) -> Figure:
    """Torques of the members on the main shaft and their sum, the speed, and the wind-up of the shaft."""
    found = design.table("torque")
    x = np.asarray(found.data[0])
    wound = design.spec.shaft is not None
    runs = design.speed_min is not None
    made = panels.page(f"{design.spec.name}: loads", 0.45 + 0.25 * (wound + runs))
    grid = made.add_gridspec(1 + runs + wound, 1, height_ratios=[1.6, *[1.0] * (runs + wound)])
    axes = made.add_subplot(grid[0])
    _over(axes, design, "Torque on the main shaft", "torque [N m]")
    for i, column in enumerate(name for name in found.columns if name.endswith(".torque")):
        look: Any = {"color": _COLORS[i % len(_COLORS)], "linestyle": _LINES[(i // len(_COLORS) + i) % len(_LINES)]}
        words = column.removesuffix(".torque").replace("_", " ")
        axes.plot(x, found[column], **look, linewidth=1.1, label=words)
    axes.plot(x, found["input_torque"], color=style.BLACK, linewidth=1.9, label="sum")
    panels.legend_above(axes, 6)
    if runs:
        speed = made.add_subplot(grid[1])
        _over(speed, design, "Speed of the main shaft", "speed [1/min]")
        speed.plot(x, design.table("speed")["speed"], color=style.BLUE, linewidth=1.4)
        speed.margins(y=0.15)
    if wound:
        swing = made.add_subplot(grid[1 + runs])
        _over(swing, design, "Twist of the discs relative to the first", "wind-up [deg]")
        table = design.table("wind_up_course")
        for i, column in enumerate(table.columns[2:]):
            look = {"color": _COLORS[i % len(_COLORS)], "linewidth": 1.2, "label": column.replace("_", " ")}
            swing.plot(table["input_angle"], table[column], **look)
        panels.legend_above(swing, 6)
    return made


def _over(axes: Axes, design: Any, title: str, ylabel: str) -> None:
    panels.curves(axes, "machine angle [deg]", ylabel, title)
    axes.set_xlim(0.0, 360.0 * design.turns)
    style.numbers_at(axes, list(range(0, 360 * design.turns + 1, 30 * design.turns)))


def _register(design: Any) -> Figure:
    """What every source of every member gives to the register at the print."""
    found = design.table("budget")
    words = [f"{a}: {b}" for a, b in zip(found["member"], found["source"], strict=True)]
    sigma = np.asarray(found["sigma"])
    order = np.argsort(sigma)
    made = panels.page(f"{design.spec.name}: register", 0.2 + 0.03 * len(order))
    axes = made.add_subplot()
    style.curves(axes, "standard deviation [mm]", "")
    panels.heading(axes, "Main contributions to the register error at the print")
    axes.barh(np.arange(len(order)), sigma[order], color=style.BLUE)
    panels.bars_named(axes, [words[i] for i in order], 8)
    return made
