"""Sheet of the motion of every output: place, velocity, acceleration, jerk in line, per angle and in time."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gearlink.cli.figures.drawing import panels, style, time_axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    Reals = NDArray[Any]

_TURN = 2.0 * math.pi
_COLORS = (style.BLUE, style.GREEN, style.PURPLE, style.RED)
_NAMES = ("place", "velocity", "acceleration", "jerk")


@dataclass(frozen=True, slots=True)
class Course:
    """The course of one output over its input.

    name : what moves; over : label of the x axis
    x : (N,) array [deg]
    rates : place and its derivatives by the input angle, as many as are known [unit, unit/rad, ...]
    unit : "mm" or "rad"; places in rad are shown in degrees
    speed : of the input [rad/s], None where it is not known
    bands : stretches with a name and a colour [deg]
    """

    name: str
    over: str
    x: Reals
    rates: tuple[Reals, ...]
    unit: str
    speed: float | None = None
    bands: tuple[panels.Phase, ...] = ()


def courses(design: Any) -> list[Course]:
    """The outputs of a design; none where nothing moves.

    Raises
        NoSolution - where the mechanism cannot make its turn
    """
    make = _KINDS.get(design.kind)
    return [] if make is None else make(design)


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
    axes.set_xlim(float(course.x[0]), float(course.x[-1]))
    if float(course.x[-1]) == 360.0:
        axes.set_xticks(range(0, 361, 60))
    if order:
        axes.axhline(0.0, color=style.GREY, linewidth=0.6)
    axes.plot(course.x, values, color=_COLORS[order], linewidth=1.6, gid=f"{_NAMES[order]}-{course.name}")
    if order and np.isfinite(values).all():
        for pick, above in ((np.argmax, True), (np.argmin, False)):
            i = int(pick(values))
            if i not in (0, len(values) - 1) or abs(values[i]) > 1e-9 * np.ptp(values):  # a rest at an end is seen
                panels.extreme(axes, *_vertex(course.x, values, i), above=above)
        axes.margins(y=0.2)
    if order:
        measure, scale = ("m", 1e-3) if course.unit == "mm" else ("rad", 1.0)
        time_axes.in_time(axes, course.speed, order, measure, scale)
    if last and course.speed is not None:
        time_axes.in_ms(axes, 1e3 * math.radians(1.0) / course.speed)


def _vertex(x: Reals, y: Reals, i: int) -> tuple[float, float]:
    """An extreme between the points of a smooth curve, by the parabola through three; at a corner the point itself."""
    if not 0 < i < len(y) - 1:
        return float(x[i]), float(y[i])
    left, middle, right = (float(value) for value in y[i - 1 : i + 2])
    bend = left - 2.0 * middle + right
    if bend == 0.0 or max(abs(left - middle), abs(right - middle)) > 0.01 * float(np.ptp(y)):
        return float(x[i]), middle
    shift = 0.5 * (left - right) / bend
    return float(x[i]) + shift * float(x[i + 1] - x[i]), middle - 0.25 * (left - right) * shift


def _per_angle(course: Course, order: int) -> str:
    """The label of a panel: what it shows and per which angle."""
    if order == 0:
        return f"{_NAMES[0]} [{'deg' if course.unit == 'rad' else course.unit}]"
    power = ("", "", "²", "³")[order]
    per = f"{course.unit}/rad{power}" if course.unit != "rad" else ("1", "1", "1/rad", "1/rad²")[order]
    return f"{_NAMES[order]}\n[{per}]"


# Outputs, kind by kind


def _angles() -> Reals:
    return np.arange(721) * 0.5


def _three_gears(design: Any) -> list[Course]:
    from gearlink.core.linkages.fourbar import sweep as fourbar_sweep

    train, x = design.train, _angles()
    state = fourbar_sweep.solve(design.linkage, np.radians(x), 3)
    p, q = train.coupler_share, train.rocker_share
    start = fourbar_sweep.solve(design.linkage, np.zeros(1))
    coupler, rocker = state.coupler_angle - start.coupler_angle, state.rocker_angle - start.rocker_angle
    rates = (
        train.ratio * np.radians(x) + p * coupler + q * rocker,
        train.ratio + p * state.coupler_velocity + q * state.rocker_velocity,
        p * state.coupler_acceleration + q * state.rocker_acceleration,
        p * state.coupler_jerk + q * state.rocker_jerk,
    )
    speed = design.angular_speed
    rocking = (state.rocker_angle, state.rocker_velocity, state.rocker_acceleration, state.rocker_jerk)
    over = "crank angle [deg]"
    return [Course("Output gear 5", over, x, rates, "rad", speed), Course("Rocker CD", over, x, rocking, "rad", speed)]


def _planets(design: Any) -> list[Course]:
    x, drive = _angles(), design.drive
    kinds: tuple[Callable[[float], float], ...] = (drive.angle, drive.speed, drive.acceleration, drive.jerk)
    rates = tuple(np.array([rate(phi) for phi in np.radians(x).tolist()]) for rate in kinds)
    return [Course("Output gear 5", "crank angle [deg]", x, rates, "rad", design.angular_speed)]


def _slider_crank(design: Any) -> list[Course]:
    from gearlink.core.linkages.slider_crank import sweep as slider_crank_sweep

    x, part = _angles(), design.slider_crank
    rates = slider_crank_sweep.slider(np.radians(x), part.crank_length, part.rod, part.offset, 3)
    places = (rates[0] - rates[0].min(), *rates[1:])
    return [Course("Slider F", "crank angle [deg]", x, places, "mm", design.angular_speed)]


def _press(design: Any) -> list[Course]:
    x, speed = _angles(), design.input_speed
    phi = np.radians(x)
    zone = (panels.Phase("sync", math.degrees(design.sync_start), math.degrees(design.sync_end)),)
    found = []
    for name, chain in (("Bed", design.bed), ("Cylinder surface", design.cylinder)):
        travel = chain.travel(phi, 2)
        rates = (travel.value, travel.first, travel.second, chain.jerk(phi))
        found.append(Course(name, "input angle [deg]", x, rates, "mm", speed, zone))
    return found


def _gripper(design: Any) -> list[Course]:
    from gearlink.core.swing_gripper.law import PHASES

    x = np.arange(1441) * 0.25
    rates = tuple(np.asarray(rate) for rate in design.law.evaluate(np.minimum(x, 360.0 - 1e-9), 3))
    starts = design.law.starts
    named = zip(PHASES, starts, starts[1:], strict=False)
    phases = tuple(panels.Phase(name, start, end) for name, start, end in named)
    return [Course("Gripper arm", "cylinder angle [deg]", x, rates, "rad", design.shaft_speed, phases)]


def _hypocycloid(design: Any) -> list[Course]:
    table = design.table("motion", samples=720)
    data = dict(zip(table.columns, table.data, strict=True))
    x = np.append(np.asarray(data["carrier_angle"]), 360.0)
    # The table counts the deviation inwards, velocities along the slide.
    curves = (-np.asarray(data["deviation"]), np.asarray(data["velocity"]), np.asarray(data["acceleration"]))
    rates = tuple(np.append(curve, curve[:1]) for curve in curves)
    return [Course("Slider F, outwards", "carrier angle [deg]", x, rates, "mm", getattr(design, "angular_speed", None))]


def _five_bar(design: Any) -> list[Course]:
    if not design.is_path or design.period_turns != 1:
        return []
    table = design.table("path", samples=720)
    data = dict(zip(table.columns, table.data, strict=True))
    x = np.append(np.asarray(data["input_angle"]), 360.0)
    found = []
    for axis in ("x", "y"):
        names = (axis, f"{axis}_velocity", f"{axis}_acceleration")
        rates = tuple(np.append(np.asarray(data[name]), data[name][0]) for name in names)
        speed = getattr(design, "angular_speed", None)
        found.append(Course(f"Point M, {axis}", "input angle [deg]", x, rates, "mm", speed))
    return found


def _wide_swing(design: Any) -> list[Course]:
    """The rocker over its working stroke, and the slider that it drives."""
    motion = design.motion
    law, angle, swing = motion.law, motion.cycle_angle, motion.swing
    k = np.linspace(0.0, 1.0, 721)
    x, speed = math.degrees(angle) * k, angle / motion.working_time
    has_jerk = design.spec.slider is None
    found = law.invariants(k, 3 if has_jerk else 2)
    rates = tuple(swing * rate / angle**order for order, rate in enumerate(found))
    shown = [Course("Rocker, working stroke", "cam angle [deg]", x, rates, "rad", speed)]
    if not has_jerk:
        slider = motion.slider
        moved = tuple(slider.stroke * r / angle**order for order, r in enumerate(slider.slider_invariants(k)))
        shown.append(Course("Slider", "cam angle [deg]", x, moved, "mm", speed))
    return shown


def _six_bar(design: Any) -> list[Course]:
    course = design.course
    x = np.linspace(math.degrees(course.start), math.degrees(course.end), 720 * (course.period_turns or 1) + 1)
    phi = np.radians(x)
    _, *rates = course.rates(phi)
    output = (design.output(phi), *(rate[3] for rate in rates))
    return [Course("Output link EF", "input angle [deg]", x, output, "rad", design.angular_speed)]


_KINDS: dict[str, Callable[[Any], list[Course]]] = {
    "three-gear-four-bar": _three_gears,
    "two-gear-four-bar": _planets,
    "geared-rocker": _planets,
    "slider-crank": _slider_crank,
    "flatbed-press": _press,
    "swing-gripper": _gripper,
    "hypocycloid-dwell": _hypocycloid,
    "geared-five-bar": _five_bar,
    "geared-six-bar": _six_bar,
    "wide-swing-cam": _wide_swing,
}


def kinds() -> Sequence[str]:
    """The kinds that have such a sheet."""
    return tuple(_KINDS)
