"""The motion table of a mutilated gear: the rocker's acceleration is the slope of its speed while it moves.

Central differences of a table with h = 0.1 deg of the driven gear are good to h^2 times the jerk, 1e-5 here.
"""

from __future__ import annotations

import numpy as np
from factory import design


def test_acceleration_is_the_slope_of_the_speed() -> None:
    rows = design("mutilated_gear_press").table("motion", samples=3600)
    data = {name: np.asarray(column) for name, column in zip(rows.columns, rows.data, strict=True)}
    moving = np.flatnonzero(data["driven_speed_ratio"] > 0.0)[5:-5]
    slope = np.gradient(data["rocker_speed_ratio"], np.radians(data["input_angle"]))
    assert np.abs(slope - data["rocker_acceleration_ratio"])[moving].max() < 3e-5
    resting = data["driven_speed_ratio"] == 0.0
    assert not data["rocker_acceleration_ratio"][resting].any()


def test_the_least_transmission_angle_stands_in_the_table() -> None:
    made = design("mutilated_gear_press")
    rows = made.table("motion", samples=3600)
    column = np.asarray(rows.data[rows.columns.index("transmission_angle")])
    least = made.quantity("min_transmission_angle").value
    assert least - 1e-9 <= column.min() < least + 0.05
    assert column.max() <= 90.0
