"""The tables of a planar mechanism: a row per degree of input over its period, or steps of its range."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gearlink.core.base.report import Table

if TYPE_CHECKING:
    from collections.abc import Iterable

    from gearlink.core.machines.planar.design import PlanarMechanism
    from gearlink.core.mechanism.courses import Shown
    from gearlink.core.numerics.arrays import Reals

MOST_TURNS = 100
_RANGE_ROWS = 180
_REAL = {"rad": ("rad/s", "rad/s^2", "rad/s^3"), "mm": ("mm/s", "mm/s^2", "mm/s^3")}


def inputs(design: PlanarMechanism, samples: int | None) -> Reals:
    """Inputs of the rows, in deg or mm."""
    import numpy as np

    from gearlink.core.base.rows import row_numbers
    from gearlink.core.numerics.arrays import turn_degrees

    if (turns := design.period_turns) is not None:
        return turn_degrees(samples, min(turns, MOST_TURNS))
    asked, count = design.spec.range, samples or _RANGE_ROWS
    assert asked is not None, "without a period there is a range"
    rows = row_numbers(samples, count + 1)
    share = np.arange(rows.start, rows.stop) / count
    return np.asarray(asked.start + (asked.end - asked.start) * share)


def _made(design: PlanarMechanism, name: str, shown: Iterable[Shown], samples: int | None) -> Table:
    from gearlink.core.mechanism.courses import columns_of

    given = design.moving.input
    rows, asked = inputs(design, samples), list(shown)
    q = _in_rad(design, rows)
    columns: dict[str, tuple[Any, str]] = {given.column: (rows, "deg" if given.unit == "rad" else "mm")}
    columns |= columns_of(design.moving, q, asked)
    speed = design.angular_speed
    if speed is not None and name == "motion":
        columns["time"] = 1e3 * q / speed, "ms"
        for each in asked:
            if each.order and each.timed:
                data = columns[each.column][0] * speed**each.order
                columns[each.timed] = data, _REAL[each.course.unit][each.order - 1]
    return Table.of(name, columns)


def motion(design: PlanarMechanism, samples: int | None = None) -> Table:
    """Every output with speed and acceleration, and the minimum transmission angle."""
    from gearlink.core.machines.planar.mechanism import transmission
    from gearlink.core.machines.planar.outputs import moved
    from gearlink.core.mechanism.courses import Shown

    structure, shown = design.structure, []
    for name in design.spec.shown:
        parts = moved(structure, name)
        columns = [[*part.shown(structure.names, 2)] for part in parts]
        shown += [each for orders in zip(*columns, strict=True) for each in orders]
    if design.course.dyads:
        shown.append(Shown("transmission_angle", transmission(structure, design.course.dyads)))
    return _made(design, "motion", shown, samples)


def links(design: PlanarMechanism, samples: int | None = None) -> Table:
    """Angle, speed, acceleration and jerk of every link."""
    from gearlink.core.machines.planar.outputs import link_output

    names = design.structure.names
    shown = (each for name in names[1:] for each in link_output(design.structure, name).shown(names, 3))
    return _made(design, "links", shown, samples)


def points(design: PlanarMechanism, samples: int | None = None) -> Table:
    """Place, velocity, acceleration and jerk of every point of a moving link."""
    from gearlink.core.machines.planar.outputs import point_output

    structure = design.structure
    moving = dict.fromkeys(point for body, points in structure.bodies.items() if body != "frame" for point in points)
    shown: list[Shown] = []
    for point in moving:
        columns = [[*part.shown(structure.names, 3)] for part in point_output(structure, point)]
        shown += [each for orders in zip(*columns, strict=True) for each in orders]
    return _made(design, "points", shown, samples)


def slides(design: PlanarMechanism, samples: int | None = None) -> Table:
    """Place, velocity, acceleration and jerk of every slide and slot."""
    from gearlink.core.machines.planar.outputs import line_output

    structure = design.structure
    shown = (
        each
        for name in (*structure.slides, *structure.slots)
        for each in line_output(structure, name).shown(structure.names, 3)
    )
    return _made(design, "slides", shown, samples)


def cams(design: PlanarMechanism, samples: int | None = None) -> Table:
    """The profile of every cam about its axis, as it stands in the start position less its phase."""
    import numpy as np

    from gearlink.core.numerics.arrays import turn_degrees
    from gearlink.core.parts.cams.flat_cam import FlatCam

    degrees = turn_degrees(samples)
    phi = np.radians(degrees)
    columns: dict[str, tuple[Any, str]] = {"cam_angle": (degrees, "deg")}
    for name, cam in design.structure.cams.items():
        found = cam.profile
        flat = isinstance(found, FlatCam)
        points = found.points(phi)[0 if flat else 1]
        radius = found.touch(phi).radius if isinstance(found, FlatCam) else found.at(phi).curvature_radius
        columns |= {
            f"{name}_x": (points.real, "mm"),
            f"{name}_y": (points.imag, "mm"),
            f"{name}_pressure_angle": (np.degrees(found.pressure_angle(phi)), "deg"),
            f"{name}_curvature_radius": (radius, "mm"),
        }
    return Table.of("cams", columns)


def poles(design: PlanarMechanism, samples: int | None = None) -> Table:
    """The instant centre of every moving link against the frame; none where it does not turn."""
    from gearlink.core.machines.planar.mechanism import poles as pole
    from gearlink.core.mechanism.motion import Course

    table = _made(design, "poles", (), samples)
    columns: dict[str, tuple[Any, str]] = {table.columns[0]: (table.data[0], table.units[0])}
    q = _in_rad(design, table.data[0])
    for name in design.structure.names[1:]:
        # Two numbers instead of a number and its derivative: both take the first derivatives of the link.
        both = Course("mm", lambda links, name=name: [pole(links, name).real, pole(links, name).imag])  # type: ignore[misc]
        x, y = both.rates(design.moving, q, 1)
        columns |= {f"{name}_pole_x": (x, "mm"), f"{name}_pole_y": (y, "mm")}
    return Table.of("poles", columns)


def _in_rad(design: PlanarMechanism, rows: Any) -> Reals:
    """Inputs of rows as the motion takes them."""
    import numpy as np

    return np.radians(rows) if design.moving.input.unit == "rad" else np.asarray(rows)
