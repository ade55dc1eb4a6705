"""Sheet of the motion of every output: place, velocity, acceleration, jerk in line, per angle and in time."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gearlink.cli.views.figures.drawing import panels, style, time_axes
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
    return _courses(design.moving, getattr(design, "angular_speed", None))[:_MOST]


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

    over = f"{given.column.replace('_', ' ')} [deg]"
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
    for column, course in enumerate(shown):
        axes = [made.add_subplot(grid[row, column]) for row in range(len(course.rates))]
        for order, each in enumerate(axes):
            _panel(each, course, order, last=order == len(axes) - 1)
        panels.heading(axes[0], course.name)
        if course.bands:
            panels.shade(axes, course.bands)
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
    from gearlink.core.numerics.extremes import extremes_over

    def place(x: Reals) -> Reals:
        return np.asarray(course.at(x)[0])

    return extremes_over([(place, True)], float(course.x[0]), float(course.x[-1]))[0].place


def gripper(design: Any) -> list[Course]:
    """The gripper's arm, and the cam rocker, whose law makes the cam; both from the pick-up position."""
    from gearlink.core.machines.swing_gripper.mechanism import rocker_too

    found = _courses(rocker_too(design), design.shaft_speed, 4.0)
    return [replace(each, over="cylinder angle [deg]") for each in found]


def five_bar(design: Any) -> list[Course]:
    """Both coordinates of a path that one revolution closes."""
    return of_motion(design) if design.is_path and design.period_turns == 1 else []


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
