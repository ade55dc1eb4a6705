"""The loads of a geared six-bar: five links, the free gears inside the trains, all meshes on their carriers."""

from __future__ import annotations

import math
from fractions import Fraction
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.machines.six_bar.design import GearedSixBar
from gearlink.core.machines.six_bar.spec import LINKS, PINS, GearedSixBarSpec, gear_bodies
from gearlink.core.studies.loads.design import LoadsDesign, homecoming, is_directed, loads_outline

if TYPE_CHECKING:
    from gearlink.core.machines.six_bar.loads_spec import SixBarLoads as Section
    from gearlink.core.mechanism.motion import Motion

_ON_PINS = tuple(f"{train}{pin}" for train in (1, 2) for pin in PINS)


class SixBarLoads(LoadsDesign):
    """Input, three couplers, output; of a train with more than two gears those between its ends too."""

    kind = "geared-six-bar"
    spec: GearedSixBarSpec
    section: Section
    links = (*LINKS[1:], *(f"gear_{place}" for place in _ON_PINS))
    pins = (*PINS, *(f"gear_{place}" for place in _ON_PINS))
    meshes = tuple(f"mesh_{k}{one}{other}" for k in (1, 2) for one, other in pairwise(PINS + PINS[0]))
    outlines = loads_outline(pins, meshes)

    @cached_property
    def design(self) -> GearedSixBar:
        """The geometry over its whole period, whatever the range."""
        if self.spec.range is None:
            return self.of_file(GearedSixBar)
        return GearedSixBar(self.spec.model_copy(update={"range": None}))

    @cached_property
    def own_links(self) -> tuple[str, ...]:
        free = [gear for bodies in self._bodies for gear in bodies[1:-1]]
        for name in type(self.section.links).model_fields:
            if name not in LINKS and name not in free and getattr(self.section.links, name) is not None:
                known = f", only {' and '.join(free)}" if free else ""
                raise NoSolution(
                    f"this six-bar has no gear that turns freely there{known}",
                    key=f"loads.links.{name}",
                    fix="omit its mass; a gear at the end of a train belongs to the link that it is fixed to",
                )
        return (*LINKS[1:], *free)

    @cached_property
    def turns(self) -> int:
        """Input turns until the links are home, and the free gears that are loaded in a direction of their own."""
        homes = [self._gear_turns[name].denominator for name in self.own_links[5:] if is_directed(self.section, name)]
        turns = self._period_turns * math.lcm(*homes)
        return homecoming(turns, "the gears inside the trains are back in their initial positions", "trains")

    @cached_property
    def _gear_turns(self) -> dict[str, Fraction]:
        """Turns of the free gears while the links come home."""
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
            fix = error.fix.replace(", or give range: {start, end}", "")
            if "dead centre at" in error.message:
                fix = "lengthen the couplers, or shorten input and output"
            message = (
                f"loads are computed over the whole period{', whatever the range' if ranged else ''}: {error.message}"
            )
            raise NoSolution(message, key="range" if ranged else error.key, fix=fix) from error
        assert turns is not None, "without a range there is a period"
        return turns

    @cached_property
    def _bodies(self) -> list[list[str]]:
        """By train, what each gear is fixed to, or its own name where it turns freely."""
        return [gear_bodies(train, number) for number, train in enumerate(self.spec.trains, start=1)]

    @cached_property
    def moving(self) -> Motion:
        """The motion over the whole period; a loop that does not come home is refused in the words of loads."""
        _ = self._period_turns
        return self.design.moving
