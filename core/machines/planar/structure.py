"""What a planar mechanism is made of: bodies with points, and the joints between them, from its file.

Lengths in mm, angles in rad; the frame is body 0. A point that several bodies have is a pin: the first of them, frame
first, then in the order of the file, holds it, and each other one has a pin of its own with that one.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.wording import short
from gearlink.core.machines.planar.wiring import FRAME, bearer_of, carrier_of, tied

if TYPE_CHECKING:
    from gearlink.core.machines.planar.cams import CamJoint
    from gearlink.core.machines.planar.spec import PlanarSpec, Slide, Slot, Teeth


class PinJoint(NamedTuple):
    """A pin: its name, its bodies by number, its place in coordinates of each, and how far the second is off [mm]."""

    name: str
    first: int
    second: int
    at_first: complex
    at_second: complex
    play: complex = 0j


class Line(NamedTuple):
    """A line of a body, and a point of another one that is seen from it.

    z = e^(-i(t_a + g)) (P_b - x_a - w e^(i t_a)): its real part is the place along the line, the imaginary one across
    """

    body: int
    through: complex
    direction: float
    other: int
    point: complex


class LineJoint(NamedTuple):
    """A slot, or with `lean` a slide, whose link's x axis leads the line by that."""

    name: str
    line: Line
    lean: float | None = None


class GearJoint(NamedTuple):
    """Two gears on a carrier; radii are signed, of an internal mesh that of the smaller gear is negative."""

    name: str
    first: int
    second: int
    carrier: int
    at: tuple[complex, complex]
    radii: tuple[float, float]
    internal: bool
    module: float
    teeth: tuple[int, int]
    tangent: float


class RackJoint(NamedTuple):
    """A rack, the line's body, and a pinion that stands on a side of its pitch line."""

    name: str
    line: Line
    radius: float
    side: int
    module: float
    tangent: float


class Driven(NamedTuple):
    """What a drive moves: a body that turns, or a slide; and how far per input [1]."""

    name: str
    body: int
    slide: LineJoint | None
    ratio: float


def _tangents(cosine: Any) -> Any:
    """Tangents of angles, NaN where gears do not mesh; (N,)."""
    import numpy as np

    with np.errstate(invalid="ignore"):
        return np.sqrt(1.0 - cosine * cosine) / cosine


@dataclass(frozen=True)
class Structure:
    """Bodies and joints of a file.

    Parameters
        plays : by pin - by how much the second body's hole is off the first one's, in the frame's directions [mm]
        sizes : by key of the file - numbers in place of those of the file [mm, deg], or (N,) arrays of N mechanisms
    """

    spec: PlanarSpec
    plays: Mapping[str, complex] = field(default_factory=dict)
    sizes: Mapping[str, Any] = field(default_factory=dict)

    @cached_property
    def bodies(self) -> dict[str, dict[str, complex]]:
        """Points by body, the frame first."""
        found = self.spec.bodies
        for name, points in found.items() if self.sizes else ():
            group, link = (FRAME, None) if name == FRAME else (f"links.{name}", self.spec.links[name])
            if isinstance(link, list):
                points[str(link[1])] = self.sizes.get(f"{group}[2]", points[str(link[1])]) + 0j
                continue
            for point, place in points.items():
                points[point] = self._sized(f"{group}.{point}", place)
        return found

    @cached_property
    def count(self) -> int:
        """How many mechanisms."""
        return max((getattr(each, "size", 1) for each in (*self.plays.values(), *self.sizes.values())), default=1)

    def _angle(self, key: str, given: float) -> float:
        """An angle of the file [rad]."""
        found: float = self.sizes.get(key, given) * (math.pi / 180.0)
        return found

    def _sized(self, key: str, place: complex) -> complex:
        """A pair of coordinates with the sizes that differ."""
        x, y = self.sizes.get(f"{key}[0]", place.real), self.sizes.get(f"{key}[1]", place.imag)
        found: complex = x + 1j * y
        return found

    @cached_property
    def numbers(self) -> dict[str, int]:
        """Numbers of the bodies."""
        return {name: number for number, name in enumerate(self.bodies)}

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Names of the bodies."""
        return tuple(self.bodies)

    @cached_property
    def size(self) -> float:
        """L, the maximum distance of a point of a link from its origin, or of two points of the frame, or of a slide's
        start from the frame's origin [mm].
        """
        bodies = self.spec.bodies
        links = [abs(place) for name, body in bodies.items() if name != FRAME for place in body.values()]
        frame = [abs(one - other) for one in bodies[FRAME].values() for other in bodies[FRAME].values()]
        slides = [
            abs(complex(*each.through)) + abs(self.spec.start.get(name, 0.0)) for name, each in self.spec.slides.items()
        ]
        return max(links) or max(frame) or max(slides, default=0.0) or 1.0

    @cached_property
    def largest(self) -> float:
        """The largest distance of two points of one body, which closures are judged by [mm]."""
        bodies = [[*body.values()] for body in self.spec.bodies.values()]
        found = max(abs(one - other) for places in bodies for one in places for other in places)
        return found or self.size

    @cached_property
    def pins(self) -> tuple[PinJoint, ...]:
        """The pins, by point in the order in which points first occur."""
        found = []
        for point in dict.fromkeys(point for body in self.bodies.values() for point in body):
            for name, (first, other) in self.pins_at(point).items():
                places = self.bodies[first][point], self.bodies[other][point]
                found.append(
                    PinJoint(name, self.numbers[first], self.numbers[other], *places, self.plays.get(name, 0j))
                )
        return tuple(found)

    def pins_at(self, point: str) -> dict[str, tuple[str, str]]:
        """The pins of a point by name, each of the first body that has it and one of the others."""
        first, *others = (name for name, body in self.bodies.items() if point in body)
        return {point if k == 0 else f"{point}_{other}": (first, other) for k, other in enumerate(others)}

    @cached_property
    def slides(self) -> dict[str, LineJoint]:
        """The slides."""
        found = {}
        for name, each in self.spec.slides.items():
            points = self.bodies[each.link]
            point = points[each.point] if each.point is not None else next(iter(points.values()))
            line = self._line(f"slides.{name}", each, each.link, point)
            found[name] = LineJoint(name, line, self._angle(f"slides.{name}.angle", each.angle))
        return found

    def _line(self, key: str, each: Slide | Slot, other: str, point: complex) -> Line:
        """The line of a joint, and the point of another body on it."""
        through = self._sized(f"{key}.through", complex(*each.through))
        direction = self._angle(f"{key}.direction", each.direction)
        return Line(self.numbers[each.on], through, direction, self.numbers[other], point)

    @cached_property
    def slots(self) -> dict[str, LineJoint]:
        """The slots; of a pin the first body that has its point and not the slot counts."""
        found = {}
        for name, each in self.spec.slots.items():
            other = next(body for body, points in self.bodies.items() if each.point in points and body != each.on)
            line = self._line(f"slots.{name}", each, other, self.bodies[other][each.point])
            found[name] = LineJoint(name, line)
        return found

    @cached_property
    def meshes(self) -> dict[str, GearJoint | RackJoint]:
        """The meshes.

        Raises
            NoSolution - where the centres of gears are on no common body
        """
        return {
            name: self._rack(name, each) if each.gears is None else self._gears(name, each)
            for name, each in self.spec.meshes.items()
        }

    def _rack(self, name: str, each: Teeth) -> RackJoint:
        assert each.rack is not None, "the spec has seen to it"
        assert each.pinion is not None, "the same"
        assert isinstance(each.at, str), "the same"
        assert isinstance(each.teeth, int), "the same"
        assert each.module is not None, "the same"
        assert each.side is not None, "the same"
        assert each.direction is not None, "the same"
        pinion = self.numbers[each.pinion]
        direction = self._angle(f"meshes.{name}.direction", each.direction)
        line = Line(self.numbers[each.rack], 0j, direction, pinion, self.bodies[each.pinion][each.at])
        tangent, module = (
            math.tan(math.radians(each.pressure_angle)),
            self.sizes.get(f"meshes.{name}.module", each.module),
        )
        return RackJoint(name, line, 0.5 * module * each.teeth, each.side, module, tangent)

    def _gears(self, name: str, each: Teeth) -> GearJoint:
        assert each.gears is not None, "the spec has seen to it"
        assert isinstance(each.teeth, list), "the same"
        points = tuple(each.at)
        carrier = carrier_of(self.spec, each)
        assert carrier is not None, "the same"
        one, other = (self.bodies[carrier][point] for point in points)
        distance, (z1, z2) = abs(other - one), each.teeth
        module = self.sizes.get(f"meshes.{name}.module", each.module or 2.0 * distance / abs(z1 + z2))
        nominal, alpha = 0.5 * module * abs(z1 + z2), math.radians(each.pressure_angle)
        cosine = nominal * math.cos(alpha) / distance  # of the working pressure angle: base circles stay
        many = getattr(cosine, "ndim", 0) > 0
        if not many and cosine >= 1.0:
            raise NoSolution(
                f"gears of module {module:g} mm with {z1} and {z2} teeth do not mesh at {short(distance)} "
                "mm, less than their base radii together",
                key=f"meshes.{name}.module",
                fix=f"set module to {2.0 * distance / abs(z1 + z2):.6g} mm, or omit it",
            )
        tangent = _tangents(cosine) if many else math.sqrt(1.0 - cosine * cosine) / cosine
        radii = distance * z1 / (z1 + z2), distance * z2 / (z1 + z2)
        first, second = (self.numbers[gear] for gear in each.gears)
        internal = min(z1, z2) < 0
        return GearJoint(
            name, first, second, self.numbers[carrier], (one, other), radii, internal, module, (z1, z2), tangent
        )

    @cached_property
    def cams(self) -> dict[str, CamJoint]:
        """The cams with their followers.

        Raises
            NoSolution - where a cam cannot be, at its key
        """
        if not self.spec.cams:
            return {}
        from gearlink.core.machines.planar.cams import CamJoint

        return {
            name: CamJoint(self, name, bearer_of(self.spec, each) or FRAME) for name, each in self.spec.cams.items()
        }

    @cached_property
    def drives(self) -> tuple[Driven, ...]:
        """The drives, the input's own first."""
        given: Mapping[str, float] = {self.spec.drive.main: 1.0, **self.spec.drive.others}
        return tuple(
            Driven(name, 0 if name in self.slides else self.numbers[name], self.slides.get(name), ratio)
            for name, ratio in given.items()
        )

    @cached_property
    def tied(self) -> dict[str, str]:
        """By cam and mesh, the link or slide whose start it makes exact."""
        return tied(self.spec)

    @property
    def freedoms(self) -> int:
        """Gruebler's degrees of freedom, 3 n - 2 pins - 2 slides - slots - meshes - cams."""
        taken = 2 * len(self.pins) + 2 * len(self.slides) + len(self.slots) + len(self.meshes) + len(self.spec.cams)
        return 3 * (len(self.bodies) - 1) - taken

    def start_of(self, name: str) -> float | None:
        """Start value of a link [rad] or slide [mm]; None where the file has none."""
        given = self.spec.start.get(name)
        return given if given is None or name in self.slides else math.radians(given)
