"""What a planar mechanism moves: links, places of slides and slots, points, as numbers over the input, and tables."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import chain
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from gearlink.core.base.report import Table
from gearlink.core.machines.planar.dyads import folded
from gearlink.core.machines.planar.system import Jets, scaled
from gearlink.core.numerics.arrays import Points, Reals, range_rows, turn_degrees

if TYPE_CHECKING:
    from gearlink.core.machines.planar.design import PlanarMechanism
    from gearlink.core.machines.planar.dyads import Dyad
    from gearlink.core.machines.planar.extremes import Coefficient
    from gearlink.core.machines.planar.structure import Line, Structure
    from gearlink.core.mechanism.courses import Shown
    from gearlink.core.mechanism.links import Mechanism
    from gearlink.core.mechanism.motion import Course

RATES = {
    "link": ("angle", "speed_ratio", "acceleration_ratio", "jerk_ratio"),
    "line": ("position", "velocity_ratio", "acceleration_ratio", "jerk_ratio"),
}
"""By what moves, names of its value and its derivatives."""


@dataclass(frozen=True)
class Moved:
    """One number that moves.

    Fields
        name : str - as tables and quantities begin with it: of a link `rocker`, of a point `P_x`
        sort : what it is
        place : complex [mm] - of a point on its body
        line : Line or None - along which a place is
        size : float [mm] - unit of length of the system
    """

    name: str
    sort: Literal["link", "line", "x", "y"]
    body: int
    size: float
    place: complex = 0j
    line: Line | None = None

    @property
    def unit(self) -> Literal["rad", "mm"]:
        """Of the value."""
        return "rad" if self.sort == "link" else "mm"

    @property
    def columns(self) -> tuple[str, str, str, str]:
        """Columns of the value and its derivatives."""
        value, *rates = (f"{self.name}_{rate}" for rate in RATES.get(self.sort, RATES["line"]))
        return (self.name if self.sort in ("x", "y") else value, *rates)  # type: ignore[return-value]

    @cached_property
    def _line(self) -> Line:
        assert self.line is not None
        return scaled(self.line, self.size)

    @property
    def coefficient(self) -> Coefficient:
        """Its Taylor coefficients [rad or mm]."""
        if self.sort == "link":
            return lambda jets, k: jets.t[k][:, self.body]
        if self.sort == "line":
            return lambda jets, k: jets.seen(self._line, k).real * self.size
        arm = self.place / self.size
        if self.sort == "x":
            return lambda jets, k: jets.point(self.body, arm, k).real * self.size
        return lambda jets, k: jets.point(self.body, arm, k).imag * self.size

    def course(self, names: Sequence[str]) -> Course:
        """The same of the links of the mechanism; `names` are those of the bodies."""
        from gearlink.core.mechanism.courses import coordinate, turned

        if self.sort == "link":
            return turned(names[self.body])
        if self.sort in ("x", "y"):
            return coordinate(names[self.body], self.place, 1.0 if self.sort == "x" else 1j)
        return _place_on(self._line, self.size, names)

    def shown(self, names: Sequence[str], orders: int) -> Iterator[Shown]:
        """Columns of a table up to an order."""
        from gearlink.core.mechanism.courses import Shown

        course = self.course(names)
        for order in range(orders + 1):
            column = self.columns[order]
            yield Shown(column, course, order, column.removesuffix("_ratio") if order else "")


def _place_on(line: Line, size: float, names: Sequence[str]) -> Course:
    """The place along a line, from the derivatives of the two links."""
    from gearlink.core.mechanism.motion import Course

    def of(mechanism: Mechanism) -> Sequence[Reals]:
        pair = names[line.body], names[line.other]
        jets, near = jets_of(mechanism, pair, size), line._replace(body=0, other=1)
        order, moving = jets.order, next(name for name in pair if name in mechanism.links)
        shape = mechanism.links[moving].turn.value.shape
        return [(jets.seen(near, k).real * (size * math.factorial(k))).reshape(shape) for k in range(order + 1)]

    return Course("mm", of)


def jets_of(mechanism: Mechanism, names: Sequence[str], size: float) -> Jets:
    """Taylor coefficients of some links of a mechanism, lengths in units of size; of all its rows one after another."""
    links = [mechanism.link(name) for name in names]
    order = min(link.turn.order for link in links if link is not None)
    still = np.zeros(next(link.turn.value.size for link in links if link is not None))
    x, t = [], []
    for k in range(order + 1):
        share = 1.0 / math.factorial(k)
        places = [still + 0j if link is None else link.origin[k].ravel() * (share / size) for link in links]
        x.append(np.stack(places, axis=1))
        t.append(np.stack([still if link is None else link.turn[k].ravel() * share for link in links], axis=1))
    return Jets(x, t)


def link_output(structure: Structure, name: str) -> Moved:
    """The direction of a link."""
    return Moved(name, "link", structure.numbers[name], structure.size)


def line_output(structure: Structure, name: str) -> Moved:
    """The place of a slide or slot."""
    joint = structure.slides.get(name) or structure.slots[name]
    return Moved(name, "line", joint.line.other, structure.size, line=joint.line)


def point_output(structure: Structure, name: str) -> tuple[Moved, Moved]:
    """Both coordinates of a point; of a pin those on the first moving body that has it."""
    body = next(body for body, points in structure.bodies.items() if name in points and body != "frame")
    number, place = structure.numbers[body], structure.bodies[body][name]
    x, y = (Moved(f"{name}_{axis}", axis, number, structure.size, place) for axis in ("x", "y"))
    return x, y


def moved(structure: Structure, name: str) -> tuple[Moved, ...]:
    """The numbers of an output of the file."""
    if name in structure.numbers and name != "frame":
        return (link_output(structure, name),)
    if name in structure.slides or name in structure.slots:
        return (line_output(structure, name),)
    return point_output(structure, name)


# Tables

MOST_TURNS = 100
_REAL = {"rad": ("rad/s", "rad/s^2", "rad/s^3"), "mm": ("mm/s", "mm/s^2", "mm/s^3")}


def inputs(design: PlanarMechanism, samples: int | None) -> Reals:
    """Inputs of the rows, in deg or mm."""
    if (turns := design.period_turns) is not None:
        return turn_degrees(samples, min(turns, MOST_TURNS))
    asked = design.spec.range
    assert asked is not None, "without a period there is a range"
    return range_rows(asked.start, asked.end, samples)


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


def _shown(structure: Structure, outputs: Iterable[tuple[Moved, ...]], orders: int) -> Iterator[Shown]:
    """Columns of outputs up to an order; of a point both coordinates side by side."""
    for parts in outputs:
        columns = (part.shown(structure.names, orders) for part in parts)
        yield from chain.from_iterable(zip(*columns, strict=True))


def motion(design: PlanarMechanism, samples: int | None = None) -> Table:
    """Every output with speed and acceleration, and the minimum transmission angle."""
    from gearlink.core.mechanism.courses import Shown

    structure = design.structure
    shown = [*_shown(structure, (moved(structure, name) for name in design.spec.shown), 2)]
    if design.course.dyads:
        shown.append(Shown("transmission_angle", transmission(structure, design.course.dyads)))
    return _made(design, "motion", shown, samples)


def links(design: PlanarMechanism, samples: int | None = None) -> Table:
    """Angle, speed, acceleration and jerk of every link."""
    structure = design.structure
    outputs = ((link_output(structure, name),) for name in structure.names[1:])
    return _made(design, "links", _shown(structure, outputs, 3), samples)


def points(design: PlanarMechanism, samples: int | None = None) -> Table:
    """Position, velocity, acceleration and jerk of every point of a moving link."""
    structure = design.structure
    moving = dict.fromkeys(point for body, points in structure.bodies.items() if body != "frame" for point in points)
    outputs = (point_output(structure, point) for point in moving)
    return _made(design, "points", _shown(structure, outputs, 3), samples)


def slides(design: PlanarMechanism, samples: int | None = None) -> Table:
    """Position, velocity, acceleration and jerk of every slide and slot."""
    structure = design.structure
    outputs = ((line_output(structure, name),) for name in (*structure.slides, *structure.slots))
    return _made(design, "slides", _shown(structure, outputs, 3), samples)


def cams(design: PlanarMechanism, samples: int | None = None) -> Table:
    """The profile of every cam about its axis, as it stands in the start position less its phase."""
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
    from gearlink.core.mechanism.motion import Course

    table = _made(design, "poles", (), samples)
    columns: dict[str, tuple[Any, str]] = {table.columns[0]: (table.data[0], table.units[0])}
    q = _in_rad(design, table.data[0])
    for name in design.structure.names[1:]:
        # Two numbers in place of a number and its derivative: both take the first derivatives of the link.
        both = Course("mm", lambda links, name=name: [_pole(links, name).real, _pole(links, name).imag])  # type: ignore[misc]
        x, y = both.rates(design.moving, q, 1)
        columns |= {f"{name}_pole_x": (x, "mm"), f"{name}_pole_y": (y, "mm")}
    return Table.of("poles", columns)


def _in_rad(design: PlanarMechanism, rows: Any) -> Reals:
    """Inputs of rows as the motion takes them."""
    return np.radians(rows) if design.moving.input.unit == "rad" else np.asarray(rows)


def transmission(structure: Structure, dyads: Sequence[Dyad]) -> Course:
    """The minimum transmission angle of all dyads."""
    from gearlink.core.mechanism.motion import Course

    def of(links: Mechanism) -> Sequence[Reals]:
        jets = jets_of(links, structure.names, structure.size)
        return [np.min([folded(dyad.angle(jets, 0)) for dyad in dyads], axis=0)]

    return Course("rad", of)


def _pole(links: Mechanism, name: str) -> Points:
    """Instant centre of a link against the frame, x + i x'/t'; NaN where it does not turn."""
    link = links.links[name]
    rate = link.turn.first
    turning = np.abs(rate) > 1e-12
    with np.errstate(all="ignore"):
        found = link.origin.value + 1j * link.origin.first / rate
    return np.where(turning, found, complex(math.nan, math.nan))
