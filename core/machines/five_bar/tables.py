"""Tables of a geared five-bar; each is a function of the design and the number of rows."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from gearlink.core.base.report import Table
from gearlink.core.base.rows import row_numbers

if TYPE_CHECKING:
    from gearlink.core.machines.five_bar.design import GearedFiveBar


def path(design: GearedFiveBar, samples: int | None = None) -> Table:
    """Coupler point, its speed and the links over the period, or the first hundred turns of a longer one."""
    from gearlink.core.mechanism.courses import Shown, between, coordinate, motion_table, turned
    from gearlink.core.numerics.arrays import turn_degrees

    x, y = (coordinate("coupler", "M", along) for along in (1.0 + 0j, 1j))
    shown = [
        Shown("output_angle", turned("output")),
        Shown("coupler_angle", turned("coupler")),
        Shown("x", x),
        Shown("y", y),
        Shown("x_velocity", x, 1, "point_x_velocity"),
        Shown("y_velocity", y, 1, "point_y_velocity"),
        Shown("x_acceleration", x, 2, "point_x_acceleration"),
        Shown("y_acceleration", y, 2, "point_y_acceleration"),
        Shown("transmission_angle", between("coupler", "follower")),
    ]
    return motion_table("path", design, shown, samples, degrees=turn_degrees(samples, design.shown_turns))


def deviations(design: GearedFiveBar, _samples: int | None = None) -> Table:
    """Every point that is asked for and its distance from the path."""
    target, fit = design.spec.target, design.fit
    assert target is not None, "shown only with a fit"
    assert target.points is not None, "shown only with a fit"
    assert fit is not None, "shown only with a fit"
    x, y = zip(*target.points, strict=True)
    columns: dict[str, tuple[Any, str]] = {"x": (x, "mm"), "y": (y, "mm"), "distance": (fit.distance, "mm")}
    if design.timed_fit is not None and target.input_angles is not None:
        first = math.degrees(design.timed_fit.first_angle)
        columns = {"input_angle": ([first + angle for angle in target.input_angles], "deg"), **columns}
    return Table.of("deviations", columns)


def function(design: GearedFiveBar, samples: int | None = None) -> Table:
    """Output angle and speed over the range of the input, both ends included."""
    start, end = design.input_range
    count, bar = samples or 180, design.function_bar
    rows = row_numbers(samples, count + 1)
    angles = [start + (end - start) * i / count if i < count else end for i in rows]
    followed = bar.output_angles([start, *angles])[1:]
    columns = {
        "input_angle": ([math.degrees(angle) for angle in angles], "deg"),
        "output_angle": ([math.degrees(angle) for angle in followed], "deg"),
        "speed_ratio": ([bar.output_speed(angle) for angle in angles], "1"),
        "acceleration_ratio": ([bar.output_acceleration(angle) for angle in angles], "1"),
    }
    rates = {"output_speed": ("speed_ratio", 1), "output_acceleration": ("acceleration_ratio", 2)}
    return Table.of("function", design.timed(columns, "input_angle", rates))


def structural_error(design: GearedFiveBar, samples: int | None = None) -> Table:
    """Output angle, what it should be, and the difference, over the interval of the function."""
    import numpy as np

    from gearlink.core.machines.five_bar.wanted import outputs

    found, wanted = design.function_fit, design.wanted
    assert found is not None, "shown only with a function"
    assert wanted is not None, "shown only with a function"
    s = np.linspace(0.0, 1.0, (samples or 60) + 1)
    fine = np.linspace(0.0, 1.0, 721)
    phi = found.start + wanted.input_swing * np.concatenate([fine, s])
    order = np.argsort(phi, kind="stable")
    reached = np.empty(phi.size)
    reached[order] = outputs(found.bar, phi[order])
    output, asked = reached[fine.size :], found.error.zero + wanted.output(s)
    turns = 2.0 * math.pi * round(float(output[0] - asked[0]) / (2.0 * math.pi))
    columns = {
        "input_angle": (np.degrees(phi[fine.size :]), "deg"),
        "output_angle": (np.degrees(output - turns), "deg"),
        "wanted_angle": (np.degrees(asked), "deg"),
        "error": (np.degrees(output - turns - asked), "deg"),
    }
    return Table.of("structural_error", columns)


def search(design: GearedFiveBar, _samples: int | None = None) -> Table:
    """What the search had reached after each of its rounds."""
    rounds, unit = design.search_rounds, "mm" if design.is_path else "deg"
    error = [each.error if design.is_path else math.degrees(each.error) for each in rounds]
    return Table.of("search", {"starts": ([each.starts for each in rounds], "1"), "error": (error, unit)})
