"""The loads of a geared six-bar: five links, the free gears inside the trains, all meshes on their carriers."""

from __future__ import annotations

import math
from fractions import Fraction
from itertools import pairwise
from typing import TYPE_CHECKING

from gearlink.core.errors import NoSolution
from gearlink.core.loads.design import LoadsDesign, loads_outline
from gearlink.core.loads.periods import homecoming, is_directed
from gearlink.core.results import cached_property
from gearlink.core.six_bar.design import GearedSixBar
from gearlink.core.six_bar.spec import PINS

if TYPE_CHECKING:
    from gearlink.core.mechanism.joints import Connection, Mesh
    from gearlink.core.mechanism.links import Link, Mechanism
    from gearlink.core.mechanism.rates import Point, Turn
    from gearlink.core.numerics.arrays import Points, Reals
    from gearlink.core.six_bar.loads_spec import SixBarLoads as Section
    from gearlink.core.six_bar.spec import GearedSixBarSpec

_LINKS = ("frame", "input", "coupler_1", "coupler_2", "coupler_3", "output")
_HOLDING = ("frame", *_LINKS[1:5], "frame")
"""By pin, the link that it is held in: what else turns on the pin runs against this one."""
_ON_PINS = tuple(f"{train}{pin}" for train in (1, 2) for pin in PINS)


class SixBarLoads(LoadsDesign):
    """Input, three couplers, output; of a train with more than two gears those between its ends too."""

    kind = "geared-six-bar"
    spec: GearedSixBarSpec
    section: Section
    links = (*_LINKS[1:], *(f"gear_{place}" for place in _ON_PINS))
    pins = (*PINS, *(f"gear_{place}" for place in _ON_PINS))
    meshes = tuple(f"mesh_{k}{one}{other}" for k in (1, 2) for one, other in pairwise(PINS + PINS[0]))
    outlines = loads_outline(pins, meshes)

    @cached_property
    def design(self) -> GearedSixBar:
        """The geometry over its whole period, whatever the range."""
        return GearedSixBar(self.spec.model_copy(update={"range": None}))

    @cached_property
    def own_links(self) -> tuple[str, ...]:
        """The links that this design has."""
        free = [gear for bodies in self._bodies for gear in bodies[1:-1]]
        for name in type(self.section.links).model_fields:
            if name not in _LINKS and name not in free and getattr(self.section.links, name) is not None:
                known = f", only {' and '.join(free)}" if free else ""
                raise NoSolution(
                    f"this six-bar has no gear that turns freely there{known}: "
                    "leave its mass out; a gear at the end of a train belongs to the link that it is fixed to",
                    key=f"loads.links.{name}",
                )
        return (*_LINKS[1:], *free)

    @cached_property
    def turns(self) -> int:
        """Input turns until the links are home, and the free gears that are loaded in a direction of their own."""
        homes = [self._gear_turns[name].denominator for name in self.own_links[5:] if is_directed(self.section, name)]
        turns = self._period_turns * math.lcm(*homes)
        return homecoming(turns, "the gears inside the trains come home", "trains")

    @cached_property
    def _gear_turns(self) -> dict[str, Fraction]:
        """Turns of the free gears while the links come home."""
        import numpy as np

        angles = self.design.course.angles(np.array([0.0, self.design.course.end]))
        gains = [round(float(gain) / (2.0 * math.pi)) for gain in angles[:, 1] - angles[:, 0]]
        links = [Fraction(turns) for turns in (0, self._period_turns, *gains)]
        found = {}
        for train, bodies in zip(self.spec.trains, self._bodies, strict=True):
            gear = links[train.first_pin]
            for k, name in enumerate(bodies[1:-1], start=1):
                ratio = Fraction(train.gears[k - 1], train.gears[k])
                gear = (1 + ratio) * links[(train.first_pin + k) % 6] - ratio * gear
                found[name] = gear
        return found

    @cached_property
    def _period_turns(self) -> int:
        """Input turns until the links are home."""
        try:
            turns = self.design.period_turns
        except NoSolution as error:
            ranged = self.spec.range is not None
            words = error.message.replace(", or give range: {start, end}", "")
            if "dead centre at" in words:
                words = words.partition(": ")[0] + ": lengthen the couplers, or shorten input and output"
            message = f"loads are those of the whole period{', whatever the range' if ranged else ''}: {words}"
            raise NoSolution(message, key="range" if ranged else error.key) from error
        assert turns is not None, "without a range there is a period"
        return turns

    @cached_property
    def _bodies(self) -> list[list[str]]:
        """By train, what each gear is fixed to, or its own name where it turns freely."""
        found = []
        for number, train in enumerate(self.spec.trains, start=1):
            free = [f"gear_{number}{pin}" for pin in train.pins[1:-1]]
            ends = _LINKS[train.first_pin], _LINKS[(train.first_pin + len(train.pins)) % 6]
            found.append([ends[0], *free, ends[1]])
        return found

    def kinematics(self, phi: Reals, order: int = 2) -> Mechanism:
        """The links at input angles, A at 0 and F on +x."""
        from gearlink.core.mechanism.joints import Pin
        from gearlink.core.mechanism.links import Mechanism

        _ = self._period_turns  # a loop that does not come home is refused in the words of loads
        links, places, turned = self._loop(phi, order)
        connections: list[Connection] = [
            Pin(pin, first, second, place.value)
            for pin, first, second, place in zip(PINS, _HOLDING, (*_LINKS[1:], "output"), places, strict=True)
        ]
        for number in range(len(self.spec.trains)):
            links |= self._free_gears(number, places, turned)
            connections += self._gears(number, links, places)
        return Mechanism(links, connections, "input")

    def _loop(self, phi: Reals, order: int) -> tuple[dict[str, Link], list[Point], list[Turn]]:
        """The five links, the six pins, and what all six links have turned since the start, the frame first."""
        from gearlink.core.mechanism.links import Link
        from gearlink.core.mechanism.rates import Turn, fixed, from_start, standing, steady

        lengths, starts = self.design.lengths, (0.0, *self.design.bar.start_angles)
        directions = zip(*self.design.course.rates(phi, order), strict=True)
        turns = [steady(phi, order=order), *(Turn(*rows) for rows in directions)]
        links, places = {}, [fixed(0j, phi, order=order)]
        for name, turn, length in zip(_LINKS[1:5], turns[:4], lengths[1:5], strict=True):
            links[name] = Link(places[-1], turn)
            places.append(links[name].at(length))
        places.append(fixed(lengths[0], phi, order=order))
        # The loop runs from E to F, the x axis of the output from its pivot F to E.
        links["output"] = Link(places[-1], from_start(turns[4], -math.pi))
        turned = [from_start(turn, start) for turn, start in zip(turns, starts, strict=True)]
        return links, places, [standing(0.0, phi, order=order), *turned]

    def _free_gears(self, number: int, places: list[Point], turned: list[Turn]) -> dict[str, Link]:
        """The gears between the ends of a train, by Willis's equation from its first one on; x along the frame at 0."""
        from gearlink.core.mechanism.links import Link
        from gearlink.core.mechanism.rates import mixed

        train, links = self.spec.trains[number], {}
        gear = turned[train.first_pin]
        for k, name in enumerate(self._bodies[number][1:-1], start=1):
            at = (train.first_pin + k) % 6
            ratio = train.gears[k - 1] / train.gears[k]
            gear = mixed((1.0 + ratio, turned[at]), (-ratio, gear))
            links[name] = Link(places[at], gear)
        return links

    def _gears(self, number: int, links: dict[str, Link], places: list[Point]) -> list[Connection]:
        """The pins of a train's free gears, and its meshes, which join the links."""
        from gearlink.core.mechanism.joints import Pin

        train, bodies = self.spec.trains[number], self._bodies[number]
        pins: list[Connection] = []
        for pin, body in list(zip(train.pins, bodies, strict=True))[1:-1]:
            at = PINS.index(pin)
            pins.append(Pin(body, _HOLDING[at], body, places[at].value))
        return [*pins, *(self._mesh(number, k, links, places) for k in range(len(bodies) - 1))]

    def _mesh(self, number: int, k: int, links: dict[str, Link], places: list[Point]) -> Mesh:
        """The mesh of gears k and k + 1 of a train on the link between their pins, a ring first."""
        from gearlink.core.mechanism.joints import Mesh
        from gearlink.core.mechanism.links import FRAME

        train, bodies = self.spec.trains[number], self._bodies[number]
        one, other = (PINS.index(pin) for pin in train.pins[k : k + 2])
        first, second = bodies[k : k + 2]
        carrier = _LINKS[other]
        toward: Points | complex = -1.0 + 0j if carrier == FRAME else links[carrier].unit
        toward = -toward if carrier == "output" else toward
        teeth = train.gears[k : k + 2]
        r1, r2 = (0.5 * train.module * abs(z) for z in teeth)  # gears without shift roll on their pitch circles
        tangent, name = math.tan(math.radians(train.pressure_angle)), f"mesh_{number + 1}{PINS[one]}{PINS[other]}"
        if teeth[1] < 0:
            return Mesh(name, second, first, places[other].value, -toward, r2, r1, tangent, True, carrier)
        return Mesh(name, first, second, places[one].value, toward, r1, r2, tangent, teeth[0] < 0, carrier)
