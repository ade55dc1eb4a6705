"""Sheets of what is too small on others: the output in its dwell, bed minus cylinder, a cam by its pressure angle."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from gearlink.cli.views.figures.drawing import panels, style
from gearlink.cli.views.figures.sheets import cam_sheets, motion_sheet

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.cli.views.scenes.scene import Reals

_SAMPLES = 7200
_TURN = 2.0 * math.pi
_ROLLERS = 12
_USUAL = 0.005
"""Of the range of an output: how far it may move in a dwell of which the file says nothing."""
_WIDER = 0.35
"""Of a dwell: shown to each side of it."""
_LEAST = math.radians(2.0)


class Dwell(NamedTuple):
    """The longest stretch of the input in which an output stays within a tolerance.

    Fields
        start, width : float [rad] - of the input
        middle, tolerance : float [rad, mm] - the output stays within middle +- tolerance
    """

    start: float
    width: float
    middle: float
    tolerance: float


def longest(q: Reals, y: Reals, tolerance: float, gain: float | None = None) -> Dwell:
    """The longest stretch in which a course stays within +- tolerance of some value.

    Parameters
        q : (N,) array - equal steps, of a course that goes on without the end of the period
        gain : float or None - what a course that goes on as it began adds in a period; None: it ends
    Example
        >>> q = np.arange(8.0)
        >>> found = longest(q, np.array([0.0, 3.0, 5.0, 5.1, 5.0, 3.0, 1.0, 0.5]), 0.06)
        >>> found.start, found.width
        (2.0, 2.0)
    """
    n, step = len(q), float(q[1] - q[0])
    track = y if gain is None else np.concatenate([y, y + gain])
    best, start = (0, 0), 0
    low: list[int] = []
    high: list[int] = []
    for end, value in enumerate(track.tolist()):
        while low and track[low[-1]] >= value:
            low.pop()
        while high and track[high[-1]] <= value:
            high.pop()
        low.append(end)
        high.append(end)
        while track[high[0]] - track[low[0]] > 2.0 * tolerance:
            start += 1
            if low[0] < start:
                low.pop(0)
            if high[0] < start:
                high.pop(0)
        if end - start > best[1] - best[0] and end - start < n:
            best = start, end
    part = track[best[0] : best[1] + 1]
    middle = 0.5 * float(part.min() + part.max())
    return Dwell(float(q[0]) + step * best[0], step * (best[1] - best[0]), middle, tolerance)


def dwell_of(design: Any) -> Dwell | None:
    """The dwell of the first output; None of one that stops nowhere, and where the input does not turn."""
    motion = design.moving
    given = motion.input
    if given.unit != "rad" or not motion.outputs or given.turns not in (1, None):
        return None
    q = np.linspace(given.start, given.end, _SAMPLES, endpoint=given.turns is None)
    y, rate = motion.outputs[0].course.rates(motion, q, 1)
    standing = float(np.mean(np.abs(rate) < 1e-6 * np.abs(rate).max())) * (given.end - given.start)
    asked = _asked(design)
    if asked is None and standing < _LEAST and "dwell" not in design.kind:
        return None  # what only turns back
    found = longest(q, np.asarray(y), asked or _usual(motion.outputs[0].course.unit, float(np.ptp(y))), _gain(motion))
    return found if found.width >= _LEAST else None


def _usual(unit: str, reach: float) -> float:
    """A share of the range of an output, of two digits in its unit on the sheet."""
    shown = math.degrees(1.0) if unit == "rad" else 1.0
    return float(f"{_USUAL * reach * shown:.2g}") / shown


def _gain(motion: Any) -> float | None:
    """What the first output gains in a period; None of a motion over a range."""
    if motion.input.turns is None:
        return None
    ends = motion.outputs[0].course.rates(motion, np.array([motion.input.start, motion.input.end]), 0)[0]
    return float(ends[1] - ends[0])


def _asked(design: Any) -> float | None:
    """What the file allows the output to move to each side in its dwell [rad, mm]; None where it says nothing."""
    spec = design.spec
    asked = getattr(getattr(spec, "dwell", None), "tolerance", None) or getattr(spec, "dwell_tolerance", None)
    if isinstance(asked, float) and design.moving.outputs[0].course.unit == "rad":
        return math.radians(asked)
    return asked if isinstance(asked, float) else None


def dwell(design: Any) -> Figure:
    """The output in its dwell, far magnified: from the middle of its band, and its velocity."""
    found = dwell_of(design)
    assert found is not None, "asked for only where there is one"
    motion, output = design.moving, design.moving.outputs[0]
    q = np.linspace(found.start - _WIDER * found.width, found.start + (1.0 + 2.0 * _WIDER - _WIDER) * found.width, 801)
    if motion.input.turns is None:
        q = q[(q >= motion.input.start) & (q <= motion.input.end)]
    y, rate = output.course.rates(motion, np.asarray(q % _TURN if motion.input.turns else q), 1)
    y = y + (_gain(motion) or 0.0) * np.floor(q / _TURN)
    angle = output.course.unit == "rad"
    error = np.degrees(y - found.middle) if angle else y - found.middle
    tolerance = math.degrees(found.tolerance) if angle else found.tolerance
    unit = "deg" if angle else "mm"
    made = panels.page(f"{design.spec.name}: dwell, magnified", 0.5)
    grid = made.add_gridspec(2, 1, height_ratios=(1.6, 1.0))
    words = motion.input.column.replace("_", " ")
    x = np.degrees(q)
    upper, lower = made.add_subplot(grid[0]), made.add_subplot(grid[1])
    labels = f"{output.name} from the\nmiddle of the band [{unit}]", "velocity [1]" if angle else "velocity [mm/rad]"
    for axes, label in zip((upper, lower), labels, strict=True):
        style.curves(axes, f"{words} [deg]" if axes is lower else "", label)
        panels.small_ticks(axes)
        axes.set_xlim(float(x[0]), float(x[-1]))
        style.stretch(axes, math.degrees(found.start), math.degrees(found.start + found.width), color="#CFE8F7",
                      linewidth=0, zorder=0)  # fmt: skip
    begins = math.degrees(found.start % _TURN if motion.input.turns else found.start)
    panels.heading(upper, f"Within ±{tolerance:.4g} {unit} over {math.degrees(found.width):.5g}°, from {begins:.5g}°")
    upper.plot(x, error, color=style.BLUE, linewidth=1.5, gid="dwell")
    for side in (-1.0, 1.0):
        upper.axhline(side * tolerance, color=style.RED, linewidth=1.0, linestyle=style.DASHED)
    upper.set_ylim(-2.6 * tolerance, 2.6 * tolerance)
    lower.plot(x, rate, color=style.GREEN, linewidth=1.5)
    lower.axhline(0.0, color=style.GREY, linewidth=0.7)
    return made


def has_zone(design: Any) -> bool:
    """Whether two outputs are to run together over a stretch: bed and cylinder of a press."""
    return hasattr(design, "sync_start") and len(motion_sheet.courses(design)) == 2


def zone_errors(design: Any, degrees: Reals, *, cams: bool = True) -> tuple[Reals, Reals]:
    """Bed minus cylinder at inputs, from the start of the zone on: way [mm] and speed [mm/s].

    Parameters
        cams : bool - with what the cams add to the bed, where there are some
    """
    with_cams, cylinder = motion_sheet.courses(design)
    start, speed = np.array([math.degrees(design.sync_start)]), with_cams.speed or 1.0

    def bed(x: Reals) -> tuple[Reals, ...]:
        return with_cams.at(x) if cams else tuple(design.bed.travel(np.radians(x), 1))

    (one, one_rate, *_), (other, other_rate, *_) = bed(degrees), cylinder.at(degrees)
    offset = float(bed(start)[0][0] - cylinder.at(start)[0][0])
    return np.asarray(one - other - offset), np.asarray((one_rate - other_rate) * speed)


def zone(design: Any) -> Figure:
    """Bed minus cylinder in the synchronous zone: of the drives alone, and with the cams."""
    start, end = math.degrees(design.sync_start), math.degrees(design.sync_end)
    x = np.linspace(start, end, 1161)
    made = panels.page(f"{design.spec.name}: bed minus cylinder in the synchronous zone", 0.5)
    grid, cams = made.add_gridspec(2, 1), design.spec.cam is not None
    errors = {"drives alone": zone_errors(design, x, cams=False)}
    if cams:
        errors["with cams"] = zone_errors(design, x)
    for row, (words, unit) in enumerate((("way", "mm"), ("speed", "mm/s"))):
        axes = made.add_subplot(grid[row])
        style.curves(axes, "input angle [deg]" if row else "", f"{words} [{unit}]")
        panels.small_ticks(axes)
        axes.set_xlim(start, end)
        axes.axhline(0.0, color=style.GREY, linewidth=0.7)
        for (name, values), color, line in zip(errors.items(), panels.CAM_COLORS, panels.CAM_LINES, strict=False):
            most = float(np.abs(values[row]).max())
            label = f"{name}: at most {most:.3g} {unit}"
            axes.plot(x, values[row], color=color, linestyle=line, linewidth=1.5, label=label, gid=f"{words} {name}")
        axes.margins(y=0.12)
        panels.legend_under_heading(axes, f"Bed minus cylinder, {words}", 2)
    return made


def contact(design: Any) -> Figure:
    """Each cam coloured by its pressure angle, with the roller at twelve cam angles; red above the limit."""
    from matplotlib.collections import LineCollection

    cams, limit = cam_sheets.discs(design), cam_sheets.pressure_limit(design)
    made = panels.page(f"{design.spec.name}: pressure angle on the cam", min(1.0, 0.5 * len(cams) + 0.02))
    grid = made.add_gridspec(len(cams), 1)
    theta = np.linspace(0.0, _TURN, 1441)
    for row, cam in enumerate(cams):
        axes = made.add_subplot(grid[row])
        worst = cam.max_pressure_angle
        at_worst = f"{math.degrees(worst.value):.4g}° at cam angle {math.degrees(worst.place):.4g}°"
        panels.drawing(axes, f"{cam.name}: at most {at_worst}, limit {limit:g}°, rollers every 30°")
        pitch, profile = cam.points(theta)
        angle = np.degrees(np.abs(cam.pressure_angle(0.5 * (theta[1:] + theta[:-1]))))
        pieces = np.stack([np.column_stack([z.real, z.imag]) for z in (profile[:-1], profile[1:])], axis=1)
        lines = LineCollection(list(pieces), cmap="viridis", linewidths=4.0, gid="pressure angle")
        lines.set_array(angle)
        lines.set_clim(0.0, limit)
        axes.add_collection(lines)
        if (angle > limit).any():
            red = LineCollection(list(pieces[angle > limit]), colors=style.WRONG, linewidths=4.6, gid="fails")
            axes.add_collection(red)
        for k in range(_ROLLERS):
            at = complex(pitch[k * (len(theta) - 1) // _ROLLERS])
            style.circle(axes, at, cam.roller_radius, color=style.GREY, linewidth=0.8, gid="roller")
            style.letter(axes, at, f"{360 * k // _ROLLERS}°", (0.0, 0.0))
        axes.plot(pitch.real, pitch.imag, color=style.GREY, linewidth=0.7, linestyle=style.CHAIN)
        _worst(axes, cam, worst.place)
        axes.plot([0.0], [0.0], "+", color=style.BLACK, markersize=10)
        axes.autoscale_view()
        bar = made.colorbar(lines, cax=axes.inset_axes((1.02, 0.1, 0.025, 0.8)))
        bar.set_label("|pressure angle| [deg]", fontsize=7)
        bar.ax.tick_params(labelsize=7)
    return made


def _worst(axes: Axes, cam: Any, place: float) -> None:
    """The roller where the pressure angle is largest."""
    at = complex(cam.points(np.array([place]))[0][0])
    style.circle(axes, at, cam.roller_radius, color=style.BLACK, linewidth=1.5, gid="worst")
