"""Sheets of the motion of every output, with rates per angle and in time, and of what is too small on them.

What is too small is an output in its dwell, bed minus cylinder, and a cam by its pressure angle.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gearlink.cli.views.figures.drawing import panels, style, time_axes
from gearlink.cli.views.figures.sheets import cam_sheets
from gearlink.cli.views.scenes.shown import speed_of
from gearlink.core.base.kind import load
from gearlink.core.base.kinds import KINDS
from gearlink.core.mechanism.courses import Dwell, gain_of, longest_dwell
from gearlink.core.mechanism.motion import Input
from gearlink.core.numerics.extremes import extremes_over

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    Reals = NDArray[Any]

_TURN = 2.0 * math.pi
_COLORS = (style.BLUE, style.GREEN, style.PURPLE, style.RED)
_NAMES = ("place", "velocity", "acceleration", "jerk")
_EQUAL = 1e-11
"""Of the height of a curve: what differs by less is equal."""
_BEFORE = 8.0
"""Units in the last place by which a place is surely before a joint, in deg and in rad."""
_MOST = 2


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

        def rate(x: Reals) -> Reals:
            return np.asarray(self.at(x)[order])

        x, values = self.x, self.rates[order]
        end, beside, equal = float(x[-1]), 2.0 * float(np.diff(x).max()), _EQUAL * float(np.ptp(values))
        found = None
        while end > x[0]:
            most = extremes_over([(rate, greatest)], float(x[0]), end, joints=self.joints, samples=len(x))[0]
            if found is not None and abs(most.value - found.value) > equal:
                break
            found, end = most, most.place - beside
        assert found is not None, "a course has a length"
        reached = np.flatnonzero(np.abs(values - found.value) <= equal)
        return float(x[reached[0]]) if reached.size else found.place, found.value


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
    """The same of a motion, with so many steps a degree; 720 of a slide."""
    given, turning = motion.input, motion.input.unit == "rad"
    shown, hidden = (np.degrees, np.radians) if turning else (np.asarray, np.asarray)
    start, end, joints = float(shown(given.start)), float(shown(given.end)), np.array(given.joints)
    after = shown(joints)
    before = after - _BEFORE * np.spacing(after)
    even = np.linspace(start, end, (math.ceil(steps * (end - start)) if turning else 720) + 1)
    x = np.unique(np.concatenate([even, after, before[after > start]]))

    def at(course: Any) -> Callable[[Reals], tuple[Reals, ...]]:
        def rates(x: Reals) -> tuple[Reals, ...]:
            q = np.array(hidden(x))
            for joint, place in zip(joints, after, strict=True):
                q[x == place] = joint
            # At the very end the law is the last one, not that with which a new turn begins.
            q[q == given.end] -= _BEFORE * np.spacing(given.end)
            return tuple(course.rates(motion, q, 3))

        return rates

    over = f"{input_words(given)} [{'deg' if turning else 'mm'}]"
    shared: Any = {"speed": speed, "per": given.unit, "joints": tuple(after.tolist())}
    bands = panels.phases_of if turning else lambda _: ()
    return [
        Course(each.name, over, x, at(each.course), each.course.unit, bands=bands(each), **shared)
        for each in motion.outputs
    ]


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
        panels.heading(axes[0], panels.abridged(course.name, 64))
        if course.bands:
            panels.shade(axes, course.bands)
        columns.append(axes)
    vars(made)["over_input"] = columns
    return made


def _panel(axes: Axes, course: Course, order: int, *, last: bool) -> None:
    values = np.degrees(course.rates[0]) if course.unit == "rad" and order == 0 else course.rates[order]
    name, unit = f"{_NAMES[order]}\n" if order else "position ", panels.per_input(course.unit, order, course.per)
    panels.turn_panel(axes, f"{name}[{unit}]", course.over if last else "")
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


# Outputs, kind by kind


def press(design: Any) -> list[Course]:
    """Bed and cylinder; of a bed whose cam cannot be, its chain alone."""
    if not design.bed_moves:
        bed, cylinder = _courses(design.without_cam.moving, design.input_speed)
        return [replace(bed, name="Bed, without its cam"), cylinder]
    bed, cylinder = _courses(design.moving, design.input_speed)

    def place(x: Reals) -> Reals:
        return np.asarray(bed.at(x)[0])

    turning = extremes_over([(place, True)], float(bed.x[0]), float(bed.x[-1]))[0].place
    return [replace(bed, bands=(*cylinder.bands, panels.Phase("back", turning, 360.0))), cylinder]


def gripper(design: Any) -> list[Course]:
    """The gripper's arm, and the cam rocker, whose law makes the cam; both from the pick-up position."""
    from gearlink.core.machines.swing_gripper.mechanism import rocker_too

    return _courses(rocker_too(design), design.shaft_speed, 4.0)


def wide_swing(design: Any) -> list[Course]:
    """The rocker over its working stroke, and the slider that it drives, both from where the stroke begins."""
    from gearlink.core.machines.wide_swing.mechanism import working_stroke

    moving, angle = working_stroke(design), design.motion.cycle_angle
    column = "cam_angle" if design.spec.drive is None else "crank_angle"
    outputs = [
        each._replace(name=name, course=each.course.less(float(each.course.rates(moving, np.zeros(1), 0)[0][0])))
        for name, each in zip(("Rocker, working stroke", "Slider"), moving.outputs, strict=False)
    ]
    stroke = replace(moving, input=Input(column, end=angle, turns=None), outputs=tuple(outputs))
    return _courses(stroke, angle / design.motion.working_time, 720.0 / math.degrees(angle))


_ROLLERS = 12
_WIDER = 0.35
"""Of a dwell: shown to each side of it."""


def dwell_of(design: Any) -> Dwell | None:
    """The dwell of the first output within what the file allows."""
    return longest_dwell(design.moving, _asked(design), dwells="dwell" in design.kind)


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
    y = y + (gain_of(motion) or 0.0) * np.floor(q / _TURN)
    angle = output.course.unit == "rad"
    error = np.degrees(y - found.middle) if angle else y - found.middle
    tolerance = math.degrees(found.tolerance) if angle else found.tolerance
    unit = "deg" if angle else "mm"
    made, (upper, lower) = panels.stack(f"{design.spec.name}: dwell, magnified", (1.6, 1.0), 0.5)
    words = input_words(motion.input)
    x = np.degrees(q)
    labels = f"{output.name} from the\nmiddle of the band [{unit}]", "velocity [1]" if angle else "velocity [mm/rad]"
    for axes, label in zip((upper, lower), labels, strict=True):
        panels.curves(axes, f"{words} [deg]" if axes is lower else "", label)
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
    """Bed minus cylinder at inputs, from the start of the zone on: travel [mm] and speed [mm/s].

    Parameters
        cams : bool - with what the cams add to the bed, where there are some
    """
    motion = (design if cams else design.without_cam).moving
    phi = np.append(design.sync_start, np.radians(degrees))
    bed, cylinder = (each.course.rates(motion, phi, 1) for each in motion.outputs)
    way, rate = (one - other for one, other in zip(bed, cylinder, strict=True))
    return way[1:] - way[0], rate[1:] * design.input_speed


_ROUNDING = 1e-9
"""Of mm and mm/s: what cams leave of the difference is that of floating-point numbers."""


def zone(design: Any) -> Figure:
    """Bed minus cylinder in the synchronous zone: of the drives alone, and with the cams."""
    start, end = math.degrees(design.sync_start), math.degrees(design.sync_end)
    x = np.linspace(start, end, 1161)
    made, rows = panels.stack(f"{design.spec.name}: bed minus cylinder in the synchronous zone", (1.0, 1.0), 0.5)
    errors = {"drives alone": zone_errors(design, x, cams=False)}
    if design.spec.cam is not None:
        errors["with cams"] = zone_errors(design, x)
    for row, (axes, words, unit) in enumerate(zip(rows, ("travel", "speed"), ("mm", "mm/s"), strict=True)):
        panels.curves(axes, "input angle [deg]" if row else "", f"{words} [{unit}]")
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
    cams, limit = cam_sheets.discs(design), cam_sheets.pressure_limit(design)
    title, share = f"{design.spec.name}: pressure angle on the cam", min(1.0, 0.5 * len(cams) + 0.02)
    made, rows = panels.stack(title, [1.0] * len(cams), share)
    theta = np.linspace(0.0, _TURN, 1441)
    for axes, cam in zip(rows, cams, strict=True):
        worst = cam.max_pressure_angle
        at_worst = f"{math.degrees(worst.value):.4g}° at cam angle {math.degrees(worst.place):.4g}°"
        places = {"roller": "rollers", "edge": "edges"}[cam_sheets.touching(cam)]
        panels.drawing(axes, f"{cam.name}: at most {at_worst}, limit {limit:g}°, {places} every 30°")
        pitch, profile = cam.points(theta)
        angle = np.degrees(np.abs(cam.pressure_angle(0.5 * (theta[1:] + theta[:-1]))))
        pieces, bar = panels.by_value(axes, profile, angle, limit, 4.0, (1.02, 0.1, 0.025, 0.8))
        bar.set_ylabel("|pressure angle| [deg]", fontsize=7)
        if (angle > limit).any():
            panels.again(axes, pieces[angle > limit], style.WRONG, 4.6, gid="fails")
        for k in range(_ROLLERS):
            at = complex(pitch[k * (len(theta) - 1) // _ROLLERS])
            style.circle(axes, at, cam.roller_radius, color=style.GREY, linewidth=0.8, gid="roller")
            style.letter(axes, at, f"{360 * k // _ROLLERS}°", (0.0, 0.0))
        axes.plot(pitch.real, pitch.imag, color=style.GREY, linewidth=0.7, linestyle=style.CHAIN)
        at = complex(cam.points(np.array([worst.place]))[0][0])
        style.circle(axes, at, cam.roller_radius, color=style.BLACK, linewidth=1.5, gid="worst")
        axes.plot([0.0], [0.0], "+", color=style.BLACK, markersize=10)
        axes.autoscale_view()
    return made
