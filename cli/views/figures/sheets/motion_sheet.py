"""Sheets of the motion of every output, with rates per angle and in time, and of what is too small on them.

What is too small is an output in its dwell, bed minus cylinder, and a cam by its pressure angle.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gearlink.cli.views.figures.drawing import panels, style, time_axes
from gearlink.cli.views.figures.sheets import cam_sheets
from gearlink.cli.views.scenes.shown import speed_of
from gearlink.core.base.kind import load
from gearlink.core.base.kinds import KINDS
from gearlink.core.mechanism.courses import unit_of
from gearlink.core.numerics.extremes import extremes_over

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    Reals = NDArray[Any]

_TURN = 2.0 * math.pi
_COLORS = (style.BLUE, style.GREEN, style.PURPLE, style.RED)
_NAMES = ("place", "velocity", "acceleration", "jerk")
_NEAR = 0.02
"""Of the height of a curve: by so much a hump of its points may lie below the highest and be the extreme."""
_EQUAL = 1e-11
"""Of the height of a curve: what differs by less is equal."""
_BEFORE = 8.0
"""Units in the last place by which a place is surely before a joint, in deg and in rad."""
_MOST = 2
_FEW = 9
"""Points between a place and those beside it."""


@dataclass(frozen=True, slots=True)
class Course:
    """The course of one output over its input.

    name : what moves; over : label of the x axis
    x : (N,) array [deg]
    at : place and its derivatives by the input angle at such places, as many as are known [unit, unit/rad, ...]
    unit : "mm" or "rad"; places in rad are shown in degrees
    speed : of the input [rad/s], None where it is not known
    bands : stretches with a name and a colour [deg]
    joints : where derivatives may jump [deg]
    per : unit of the input of the derivatives, "rad", or "mm" of a slide, whose x and speed are in mm as well
    rates : what `at` gives at x
    """

    name: str
    over: str
    x: Reals
    at: Callable[[Reals], tuple[Reals, ...]]
    unit: str
    speed: float | None = None
    bands: tuple[panels.Phase, ...] = ()
    per: str = "rad"
    joints: tuple[float, ...] = ()
    rates: tuple[Reals, ...] = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "rates", self.at(self.x))

    def extreme(self, order: int, *, greatest: bool) -> tuple[float, float]:
        """Place [deg] and value of an extreme of a rate: the first of equal ones, and the start of a plateau.

        A jump counts with the values on both sides of it.
        """
        sign = 1.0 if greatest else -1.0
        values = sign * self.rates[order]
        top, height = float(values.max()), float(np.ptp(values))
        best = -math.inf, 0.0
        for i in np.flatnonzero(_humps(values, _EQUAL * height) & (values >= top - _NEAR * height)).tolist():
            low, high = self._beside(i)

            def rate(x: Reals) -> Reals:
                return np.asarray(self.at(x)[order])

            found = extremes_over([(rate, greatest)], low, high, joints=self.joints, samples=_FEW, fewest=_FEW)[0]
            value, place = float(values[i]), float(self.x[i])
            if sign * found.value > value + _EQUAL * height:
                value, place = sign * found.value, found.place
            if value > best[0] + _EQUAL * height:
                best = value, place
        return best[1], sign * best[0]

    def _beside(self, i: int) -> tuple[float, float]:
        """A little beyond the neighbours of a place, which lie within the course."""
        step = 1.01 * float(np.diff(self.x).max())
        place = float(self.x[i])
        return max(place - step, float(self.x[0])), min(place + step, float(self.x[-1]))


def courses(design: Any) -> list[Course]:
    """The outputs of a design; none where nothing moves.

    Raises
        NoSolution - where the mechanism cannot make its turn
    """
    place = KINDS[design.kind].all_sheets.get("motion")
    found: list[Course] = load(place)(design) if place else []
    return found


def of_motion(design: Any) -> list[Course]:
    """The outputs of its motion, over the whole period or range of the input; of many the first that a page holds."""
    return _courses(design.moving, speed_of(design))[:_MOST]


def _courses(motion: Any, speed: float | None, steps: float = 2.0) -> list[Course]:
    """The same of a motion, with so many steps a degree."""
    given = motion.input
    if given.unit == "mm":
        return _of_slide(motion, speed)
    start, end = math.degrees(given.start), math.degrees(given.end)
    joints = np.array(given.joints)
    after = np.degrees(joints)
    before = after - _BEFORE * np.spacing(after)
    even = np.linspace(start, end, math.ceil(steps * (end - start)) + 1)
    x = np.unique(np.concatenate([even, after, before[after > start]]))

    def at(course: Any) -> Callable[[Reals], tuple[Reals, ...]]:
        def rates(x: Reals) -> tuple[Reals, ...]:
            q = np.radians(x)
            for joint, degrees in zip(joints, after, strict=True):
                q[x == degrees] = joint
            # At the very end the law is the last one, not that with which a new turn begins.
            q[q == given.end] -= _BEFORE * np.spacing(given.end)
            return tuple(course.rates(motion, q, 3))

        return rates

    over = f"{input_words(given)} [deg]"
    return [
        Course(
            each.name,
            over,
            x,
            at(each.course),
            each.course.unit,
            speed,
            tuple(panels.Phase(name, math.degrees(low), math.degrees(high)) for name, low, high in each.phases),
            joints=tuple(after.tolist()),
        )
        for each in motion.outputs
    ]


def _of_slide(motion: Any, speed: float | None) -> list[Course]:
    """The same where a slide drives."""
    given = motion.input
    x, over = np.linspace(given.start, given.end, 721), f"{given.column.replace('_', ' ')} [mm]"

    def at(course: Any) -> Callable[[Reals], tuple[Reals, ...]]:
        return lambda x: tuple(course.rates(motion, x, 3))

    return [Course(each.name, over, x, at(each.course), each.course.unit, speed, per="mm") for each in motion.outputs]


def draw(design: Any) -> Figure:
    """A column for each output, its rates aligned; on the right in time where the speed is known."""
    shown = courses(design)
    made = panels.page(f"{design.spec.name}: motion", 1.0 if len(shown) < 3 else 0.95)
    rows = max(len(course.rates) for course in shown)
    grid = made.add_gridspec(rows, len(shown))
    columns: list[list[Axes]] = []
    for column, course in enumerate(shown):
        axes = [made.add_subplot(grid[row, column]) for row in range(len(course.rates))]
        for order, each in enumerate(axes):
            _panel(each, course, order, last=order == len(axes) - 1)
        panels.heading(axes[0], course.name)
        if course.bands:
            panels.shade(axes, course.bands)
        columns.append(axes)
    vars(made)["over_input"] = columns
    return made


def _panel(axes: Axes, course: Course, order: int, *, last: bool) -> None:
    values = np.degrees(course.rates[0]) if course.unit == "rad" and order == 0 else course.rates[order]
    panels.turn_panel(axes, _per_angle(course, order), course.over if last else "")
    if course.per == "rad":
        style.degrees(axes, float(course.x[0]), float(course.x[-1]))
    else:
        axes.set_xlim(float(course.x[0]), float(course.x[-1]))
        panels.few_ticks(axes.xaxis)
    if order:
        axes.axhline(0.0, color=style.GREY, linewidth=0.6)
    axes.plot(course.x, values, color=_COLORS[order], linewidth=1.6, gid=f"{_NAMES[order]}-{course.name}")
    if order and np.isfinite(values).all():
        uneven = np.ptp(values) > 1e-9 * np.abs(values).max()
        for greatest in (True, False) if uneven else (True,):
            place, value = course.extreme(order, greatest=greatest)
            at_end = place in (float(course.x[0]), float(course.x[-1]))
            if not at_end or abs(value) > 1e-9 * np.ptp(values):  # a rest at an end is seen
                panels.extreme(axes, place, value, above=greatest, at="°" if course.per == "rad" else " mm")
        axes.margins(y=0.2)
    if order:
        measure, scale = ("m", 1e-3) if course.unit == "mm" else ("rad", 1.0)
        time_axes.in_time(axes, course.speed, order, measure, scale)
    if last and course.speed is not None:
        time_axes.in_ms(axes, 1e3 * (math.radians(1.0) if course.per == "rad" else 1.0) / course.speed)


def _humps(values: Reals, equal: float) -> Any:
    """Whether a value is no less than those beside it; of a plateau its two ends alone."""
    beyond = np.concatenate([[-math.inf], values, [-math.inf]])
    level = (np.abs(values - beyond[:-2]) <= equal) & (np.abs(values - beyond[2:]) <= equal)
    return (values >= beyond[:-2]) & (values >= beyond[2:]) & ~level


def _per_angle(course: Course, order: int) -> str:
    """The label of a panel: what it shows and per which angle."""
    if order == 0:
        return f"position [{'deg' if course.unit == 'rad' else course.unit}]"
    power = ("", "", "²", "³")[order]
    if course.per == "mm":
        per = unit_of(course.unit, order, "mm").replace("^2", "²").replace("^3", "³")
        return f"{_NAMES[order]}\n[{per}]"
    per = f"{course.unit}/rad{power}" if course.unit != "rad" else ("1", "1", "1/rad", "1/rad²")[order]
    return f"{_NAMES[order]}\n[{per}]"


# Outputs, kind by kind


def _angles() -> Reals:
    return np.arange(721) * 0.5


def press(design: Any) -> list[Course]:
    """Bed and cylinder; of a bed whose cam cannot be, its chain alone."""
    if not design.bed_moves:
        from gearlink.core.machines.flatbed_press.mechanism import bare

        bed, cylinder = _courses(bare(design).moving, design.input_speed)
        return [replace(bed, name="Bed, without its cam"), cylinder]
    bed, cylinder = _courses(design.moving, design.input_speed)
    zone, back = cylinder.bands, panels.Phase("back", _turning(bed), 360.0)
    return [replace(bed, bands=(*zone, back)), cylinder]


def _turning(course: Course) -> float:
    """Where a course that starts at its minimum has its maximum [deg]."""

    def place(x: Reals) -> Reals:
        return np.asarray(course.at(x)[0])

    return extremes_over([(place, True)], float(course.x[0]), float(course.x[-1]))[0].place


def gripper(design: Any) -> list[Course]:
    """The gripper's arm, and the cam rocker, whose law makes the cam; both from the pick-up position."""
    from gearlink.core.machines.swing_gripper.mechanism import rocker_too

    return _courses(rocker_too(design), design.shaft_speed, 4.0)


def wide_swing(design: Any) -> list[Course]:
    """The rocker over its working stroke, and the slider that it drives, both from where the stroke begins."""
    from gearlink.core.machines.wide_swing.mechanism import working_stroke

    moving, angle = working_stroke(design), design.motion.cycle_angle
    x, speed = math.degrees(angle) * np.linspace(0.0, 1.0, 721), angle / design.motion.working_time
    over = "cam angle [deg]" if design.spec.drive is None else "crank angle [deg]"

    def at(course: Any) -> Callable[[Reals], tuple[Reals, ...]]:
        at_start = float(course.rates(moving, np.zeros(1), 0)[0][0])
        return lambda x: tuple(course.less(at_start).rates(moving, np.minimum(np.radians(x), angle), 3, side=-1))

    names = ("Rocker, working stroke", "Slider")
    return [
        Course(name, over, x, at(each.course), each.course.unit, speed)
        for name, each in zip(names, moving.outputs, strict=False)
    ]


_SAMPLES = 7200
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
    words = input_words(motion.input)
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


def input_words(given: Any) -> str:
    """What an input is called on sheets: that of a gripper's tables is a letter."""
    return "cylinder angle" if given.column == "theta" else str(given.column).replace("_", " ")


def has_zone(design: Any) -> bool:
    """Whether two outputs are to run together over a stretch: bed and cylinder of a press."""
    return hasattr(design, "sync_start") and len(courses(design)) == 2


def zone_errors(design: Any, degrees: Reals, *, cams: bool = True) -> tuple[Reals, Reals]:
    """Bed minus cylinder at inputs, from the start of the zone on: way [mm] and speed [mm/s].

    Parameters
        cams : bool - with what the cams add to the bed, where there are some
    """
    with_cams, cylinder = courses(design)
    start, speed = np.array([math.degrees(design.sync_start)]), with_cams.speed or 1.0

    def bed(x: Reals) -> tuple[Reals, ...]:
        return with_cams.at(x) if cams else tuple(design.bed.travel(np.radians(x), 1))

    (one, one_rate, *_), (other, other_rate, *_) = bed(degrees), cylinder.at(degrees)
    offset = float(bed(start)[0][0] - cylinder.at(start)[0][0])
    return np.asarray(one - other - offset), np.asarray((one_rate - other_rate) * speed)


_ROUNDING = 1e-9
"""Of mm and mm/s: what cams leave of the difference is that of floating-point numbers."""


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
            most = 0.0 if most < _ROUNDING else most
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
