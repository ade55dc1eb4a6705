"""Sheet of velocities and accelerations: the mechanism with its vectors, their polygons, hodographs of points."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import cycle
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import labels, panels, scene_axes, style
from gearlink.cli.views.figures.sheets import motion_sheet
from gearlink.cli.views.scenes import linkages, of_motion, shown
from gearlink.cli.views.scenes.of_motion import Frame
from gearlink.cli.views.scenes.scene import Body, Reals
from gearlink.core.mechanism import vectors

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.mechanism.links import Mechanism
    from gearlink.core.mechanism.motion import Input

MOST = 4
"""Instants of one sheet."""
_COLORS = (style.BLUE, style.RED, style.GREEN, style.PURPLE, style.BLACK, style.ORANGE, style.SKY)
_LINES = ("-", style.LONG, style.CHAIN, style.DOTTED)
"""Seven and four have no common factor: 28 curves, each with a look of its own."""
_LETTER = 5.5
"""Width of a letter, and half the height of a word [pt]."""
_NOTHING = 1e-3
"""Share of the largest vector of the period below which one is nothing: the input is rounded to 1e-4 deg."""
_WISHES = "velocity,acceleration"
_NAMES = ("velocity", "acceleration")


def draws(design: Any) -> bool:
    """Whether a design has points that move."""
    if not shown.has_motion(design):
        return False
    motion = design.moving
    few = np.linspace(motion.input.start, motion.input.end, 5)[:4]
    return bool(vectors.moving_points(motion.at(few, 0)))


def draw(design: Any, at: Sequence[float] = (), wanted: str = "") -> Figure:
    """A row for each instant: the mechanism, its velocity and its acceleration polygon; below them the hodographs.

    Parameters
        at : inputs [deg, mm]; none: where the first output is fastest, and where it is accelerated most
        wanted : what is drawn on the mechanism, as `--show` has it
    Raises
        WrongShow - for what the design has not
    """
    places = list(at)[:MOST] or default_places(design)
    count = len(places)
    made = panels.page(f"{design.spec.name}: velocities and accelerations", min(1.0, 0.28 * count + 0.34))
    grid: Any = made.add_gridspec(count + 1, 1, height_ratios=[1.0] * count + [1.15])
    motion = design.moving
    for row, place in enumerate(places):
        q = math.radians(place) if motion.input.unit == "rad" else place
        if motion.input.turns is not None:  # within the period
            q = motion.input.start + (q - motion.input.start) % (motion.input.end - motion.input.start)
        columns = grid[row].subgridspec(1, 3, width_ratios=(1.25, 0.95, 1.15))
        _mechanism(made.add_subplot(columns[0]), design, q, wanted or _WISHES)
        for order in (1, 2):
            polygon(made.add_subplot(columns[order]), design, q, order)
    below: Any = grid[count].subgridspec(1, 2)
    for order in (1, 2):
        hodographs(made.add_subplot(below[order - 1]), design, order, wanted)
    return made


def beyond(design: Any, at: Sequence[float]) -> str:
    """What is wrong with inputs [deg, mm] that are beyond the range of the motion; "" where none is."""
    given = design.moving.input
    low, high, unit = given.start, given.end, "mm"
    if given.unit == "rad":
        low, high, unit = math.degrees(low), math.degrees(high), "deg"
    room = 1e-9 * (high - low)
    wrong = [each for each in at if given.turns is None and not low - room <= each <= high + room]
    words = motion_sheet.input_words(given)
    return f"{wrong[0]:g}: the {words} runs from {low:.7g} to {high:.7g} {unit}" if wrong else ""


def _largest(motion: Any, q: Reals, order: int) -> int:
    """Number of the input at which the rate of the first output is largest."""
    size = np.abs(np.asarray(motion.outputs[0].course.rates(motion, q, order)[order]))
    return int(np.where(np.isfinite(size), size, -1.0).argmax())


def default_places(design: Any) -> list[float]:
    """Inputs of the greatest velocity and acceleration of the first output [deg, mm]: a thousand, then twice a
    hundred beside the best."""
    motion = design.moving
    found = []
    for order in (1, 2):
        q = np.linspace(motion.input.start, motion.input.end, 1001)
        for _ in range(2):
            k = _largest(motion, q, order)
            q = np.linspace(q[max(k - 1, 0)], q[min(k + 1, len(q) - 1)], 101)
        found.append(float(q[_largest(motion, q, order)]))
    shown_ = [math.degrees(each) if motion.input.unit == "rad" else each for each in found]
    return [round(each, 4) for each in dict.fromkeys(shown_)]


def fraction_at(frame: Frame, q: float) -> float:
    """The fraction of the loop at which the scene stands at an input, within 1e-6 of it."""
    many = np.linspace(0.0, 1.0, 3601)
    inputs = frame.inputs(many)
    k = int(np.argmin(np.abs(inputs - q)))
    low, high = max(k - 1, 0), min(k + 1, len(many) - 1)
    fine = np.linspace(many[low], many[high], 2001)
    return float(fine[int(np.argmin(np.abs(frame.inputs(fine) - q)))])


def _mechanism(axes: Axes, design: Any, q: float, wanted: str) -> None:
    frame = frame_of(design)
    scene = shown.build(design, np.array([fraction_at(frame, q)]), shown.wishes(wanted))
    # Without remarks of several words: it is small.
    marks = tuple(mark for mark in scene.marks if " " not in mark.text.replace(", ", "").removeprefix("P "))
    parts = (replace(each, label="") if isinstance(each, Body) and " " in each.label else each for each in scene.parts)
    scene = replace(scene, marks=marks, parts=tuple(parts))
    words = motion_sheet.input_words(design.moving.input)
    panels.drawing(
        axes, f"At {words} {f'{math.degrees(q):.5g}°' if design.moving.input.unit == 'rad' else f'{q:.5g} mm'}"
    )
    for axis in (axes.xaxis, axes.yaxis):
        panels.few_ticks(axis, 4)
    scene_axes.draw(axes, scene)


def frame_of(design: Any) -> Frame:
    """Where the drawing stands: in the kind's own scene, or in that of the motion."""
    return shown.frame_of(design, linkages.builder(design.kind)) or of_motion.frame(design)


def _short(name: str, others: Iterable[str]) -> str:
    """A point of a link, "output.F", by its own name where no other point has it."""
    own = name.rpartition(".")[2]
    told = own if sum(other.rpartition(".")[2].lower() == own.lower() for other in others) == 1 else name
    return told.replace("_", " ")


def rates(design: Any, q: Reals, order: int) -> tuple[dict[str, Any], dict[str, list[str]]]:
    """Velocity or acceleration of every moving point by name, and the points of every link.

    Returns
        rates : by point - (N,) complex [mm/s, mm/s^2], per rad of the input where its speed is not known, in the
            directions of the drawing
        links : by link - the names of its points
    """
    frame, speed = frame_of(design), shown.speed_of(design)
    motion = frame.motion
    factor = 1.0 if speed is None else speed**order
    whole = motion.at(np.linspace(motion.input.start, motion.input.end, 25)[:24], 0)
    mechanism, places = motion.at(q, order), vectors.moving_points(whole)
    found = {
        name: frame.along(factor * vectors.rates_of(mechanism, each).derivative(order)) for name, each in places.items()
    }
    links: dict[str, list[str]] = {}
    for name, each in places.items():
        for link in mechanism.links:
            if link == each.link or _on(whole, link, vectors.rates_of(whole, each).value):
                links.setdefault(link, []).append(name)
    return found, links


def _on(mechanism: Mechanism, link: str, at: Any) -> bool:
    """Whether a point keeps its place on a link."""
    held = mechanism.links[link]
    arms = (at - held.origin.value) / held.unit
    return float(np.abs(arms - arms[0]).max()) <= 1e-6 * (1.0 + float(np.abs(arms).max()))


def unit(design: Any, order: int) -> str:
    """Unit of velocities or accelerations on the sheet."""
    if shown.speed_of(design) is not None:
        return ("mm/s", "mm/s²")[order - 1]
    per = design.moving.input.unit
    return (f"mm/{per}", f"mm/{per}²")[order - 1]


def polygon(axes: Axes, design: Any, q: float, order: int) -> None:
    """The polygon of velocities or accelerations: rays from the pole, and lines between the points of a link."""
    found, links = rates(design, np.array([q]), order)
    name, color = _NAMES[order - 1], (style.GREEN, style.PURPLE)[order - 1]
    _vector_axes(axes, f"{name.capitalize()} polygon [{unit(design, order)}]")
    ends = {point: complex(value[0]) for point, value in found.items()}
    for point, end in ends.items():
        style.arrow(axes, 0j, end, color)
        axes.plot([end.real], [end.imag], ".", color=color, markersize=3, gid=f"{name} {point}")
    for link, points in links.items():
        corners = [ends[point] for point in points]
        if len(corners) > 1:
            shape = np.array([*corners, corners[0]] if len(corners) > 2 else corners)
            look: dict[str, Any] = {"color": style.BLACK, "linewidth": 0.9, "zorder": 3}
            axes.plot(shape.real, shape.imag, **look, gid=f"{name} of {link}")
    longest, largest = max(map(abs, ends.values()), default=0.0), _largest_rate(design, order)
    reach = longest if longest > _NOTHING * largest else 0.1 * largest or 1.0
    taken: list[complex] = []
    for point, end in ends.items():
        if all(abs(end - other) > 0.06 * reach for other in taken):
            away = end / abs(end) if abs(end) > 0.02 * reach else (1.0 + 1.0j) / math.sqrt(2.0)
            word = _short(point, ends).lower()
            away *= labels.reach(away / abs(away), complex(0.5 * _LETTER * len(word), _LETTER)) + 3.5
            style.letter(axes, end, word, (away.real, away.imag))
            taken.append(end)
    if reach > longest:  # a zero with its rounding is a point, not an arrow on an axis of its own
        axes.update_datalim([(-reach, -reach), (reach, reach)])
    axes.plot([0.0], [0.0], "o", color=style.BLACK, markersize=3, zorder=7)
    style.letter(axes, 0j, "p" if order == 1 else "p'", (-7.0, -7.0))
    axes.margins(0.18)


def _all_inputs(given: Input) -> Reals:
    """Inputs of the whole period, so many in each turn of it that a circle is round."""
    return np.linspace(given.start, given.end, 720 * min(given.turns or 1, 40) + 1)


def _largest_rate(design: Any, order: int) -> float:
    """The largest velocity or acceleration of a point over the period."""
    given = design.moving.input
    found, _ = rates(design, _all_inputs(given), order)
    return max((float(np.nanmax(np.abs(each))) for each in found.values()), default=0.0)


def _vector_axes(axes: Axes, title: str) -> None:
    panels.curves(axes, "", "", title)
    axes.set_aspect("equal", adjustable="datalim")
    for axis in (axes.xaxis, axes.yaxis):
        panels.few_ticks(axis, 4)
    axes.tick_params(labelsize=7)


def hodographs(axes: Axes, design: Any, order: int, wanted: str = "") -> None:
    """The ends of the vectors of each point over the period, with a dot at input 0 and a tick at every 30 deg."""
    given = design.moving.input
    found, _ = rates(design, _all_inputs(given), order)
    asked = [wish.point for wish in shown.wishes(wanted) if wish.what == _NAMES[order - 1] and wish.point]
    chosen = {name: each for name, each in found.items() if not asked or name in asked}
    _vector_axes(axes, f"Hodographs, {_NAMES[order - 1]} [{unit(design, order)}]")
    for (name, each), color, line in zip(chosen.items(), cycle(_COLORS), cycle(_LINES), strict=False):
        look: dict[str, Any] = {"color": color, "linestyle": line, "linewidth": 1.3, "gid": f"hodograph {name}"}
        axes.plot(each.real, each.imag, label=_short(name, found), **look)
        axes.plot(each.real[:1], each.imag[:1], "o", color=color, markersize=4)
        if given.unit == "rad" and given.turns == 1:
            axes.plot(each.real[60:-1:60], each.imag[60:-1:60], ".", color=color, markersize=3)
    axes.plot([0.0], [0.0], "+", color=style.BLACK, markersize=8)
    panels.legend_above(axes, 4)
