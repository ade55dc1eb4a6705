"""Real speeds: what the ratios of a design become where its file names the speed of its input, `input_speed`.

w = 2 pi n/60,   time = angle/w,   speed = w (per radian),   acceleration = w^2 (per radian squared)
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from gearlink.core.base.design import placed
from gearlink.core.base.wording import apart

if TYPE_CHECKING:
    from gearlink.core.base.report import Column

OUTPUT_SPEEDS = ("output_speed_max", "output_speed_min", "output_acceleration_max", "output_acceleration_min")
SLIDER_SPEEDS = ("slider_velocity_max", "slider_velocity_min", "slider_acceleration_max", "slider_acceleration_min")
_MILLISECONDS = 1000.0
OF_TIME = {0: "", 1: "/s", 2: "/s^2", 3: "/s^3"}


def per_time(path: str, order: int) -> Any:
    """A quantity in real time from one per input angle; None without `input_speed`, or where that is None.

    Parameters
        path : str - dotted, from the design on, to a value per rad^order of the input
        order : int - 1 for a speed, 2 for an acceleration, 3 for a jerk, -1 for the time of an input angle [ms]
    Returns
        quantity : property, to be annotated with the type of the value
    """

    def value(design: Any) -> Any:
        speed = design.angular_speed
        found = None if speed is None else design
        for name in path.split("."):
            found = None if found is None else getattr(found, name)
        if found is None:
            return None
        return found / speed * _MILLISECONDS if order < 0 else found * speed**order

    return property(value, doc=f"`{path}` in real time.")


class RealSpeed:
    """Results in real time of a design whose file may have `input_speed`."""

    spec: Any

    @property
    def input_speed(self) -> float | None:
        """Speed of the input [1/min], where it is known."""
        speed: float | None = self.spec.input_speed
        return speed

    @property
    def angular_speed(self) -> float | None:
        """Speed of the input [rad/s], where it is known."""
        return None if self.input_speed is None else self.input_speed * (math.pi / 30.0)

    @property
    def turn_time(self) -> float | None:
        """Time of an input turn [ms]."""
        return None if self.input_speed is None else 60.0 * _MILLISECONDS / self.input_speed

    def timed(
        self, columns: Mapping[str, tuple[Column, str]], angle: str, rates: Mapping[str, tuple[str, int]]
    ) -> dict[str, tuple[Column, str]]:
        """The columns of a table, and where the input's speed is known time and real speeds after them.

        Parameters
            columns : name -> (data, unit), as `Table.of` takes them
            angle : str - the column of the input angle [deg]
            rates : new name -> (column per rad^order of the input, order)
        Returns
            columns : dict - with `time` [ms] and every name of `rates` in rad/s, mm/s^2, ...
        """
        speed, turn = self.angular_speed, self.turn_time
        if speed is None or turn is None:
            return dict(columns)
        found: dict[str, tuple[Column, str]] = {"time": (_scaled(columns[angle][0], turn / 360.0), "ms")}
        for name, (column, order) in rates.items():
            data, unit = columns[column]
            measure = "mm" if unit.startswith("mm") else "rad"
            found[name] = (_scaled(data, speed**order), measure + OF_TIME[order])
        return {**columns, **found}


class OutputSpeed:
    """Maximum and minimum speed [rad/s] and acceleration [rad/s^2] of an output, from its ratios to the input."""

    output_speed_max: float | None = per_time("speed_ratio_max", 1)
    output_speed_min: float | None = per_time("speed_ratio_min", 1)
    output_acceleration_max: float | None = per_time("acceleration_ratio_max", 2)
    output_acceleration_min: float | None = per_time("acceleration_ratio_min", 2)


class SliderSpeed(RealSpeed):
    """Maximum and minimum velocity and acceleration of a slider, by the input angle and in real time [mm/s, mm/s^2].

    Fields
        fastest, hardest : two Turnings - maximum, then minimum of its velocity [mm/rad] and acceleration [mm/rad^2]
    """

    fastest: Any
    hardest: Any
    velocity_max: float = placed("fastest.0.value")
    velocity_max_at: float = placed("fastest.0.place")
    velocity_min: float = placed("fastest.1.value")
    velocity_min_at: float = placed("fastest.1.place")
    acceleration_max: float = placed("hardest.0.value")
    acceleration_max_at: float = placed("hardest.0.place")
    acceleration_min: float = placed("hardest.1.value")
    acceleration_min_at: float = placed("hardest.1.place")
    slider_velocity_max: float | None = per_time("velocity_max", 1)
    slider_velocity_min: float | None = per_time("velocity_min", 1)
    slider_acceleration_max: float | None = per_time("acceleration_max", 2)
    slider_acceleration_min: float | None = per_time("acceleration_min", 2)


def _scaled(data: Any, factor: float) -> Any:
    return data * factor if hasattr(data, "dtype") else [value * factor for value in data]


def other_speed(given: float | None, found: float) -> str:
    """What is wrong with an input speed that contradicts the one that follows from the file; empty where they agree.

    Example
        >>> other_speed(200.0, 200.0), other_speed(None, 200.0), other_speed(180.0, 200.0)
        ('', '', 'input_speed: 180 1/min (required by speed.min and speed.max: 200 1/min)\\nomit input_speed')
    """
    if given is None or abs(given - found) <= 1e-9 * abs(found):
        return ""
    now, required = apart(given, found)
    return f"input_speed: {now} 1/min (required by speed.min and speed.max: {required} 1/min)\nomit input_speed"
