"""Effect of the tolerance sources of a machine: the link elements moved by each size, centre distance, pin and gear."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

from gearlink.core.studies.tolerance.sources import GearOfSource

if TYPE_CHECKING:
    from gearlink.core.mechanism.dual import Shift
    from gearlink.core.mechanism.motion import Course

Errors = Mapping[str, "tuple[Shift, ...]"]
"""By key of the file, or centre distance, the elements that an error of it moves."""


class Turned(NamedTuple):
    """A gear whose runout counts: its link, and what the tolerance of its teeth depends on."""

    link: str
    teeth: GearOfSource

    @classmethod
    def of(cls, link: str, section: Any, teeth: int) -> Turned:
        """A gear of a section with module and pressure_angle [deg]; a ring has negative teeth."""
        module, alpha = section.module, math.radians(section.pressure_angle)
        return cls(link, GearOfSource(module, module * abs(teeth), alpha))


@dataclass(frozen=True)
class Movable:
    """What a kind knows of its sources.

    Fields
        sizes : by key of the file, or "centers.NAME" - what an error of it moves, mm per mm, of angles per degree
        centers : by NAME of a centre distance that no key of the file gives - its nominal value [mm]
        others : by key, nominal values of what no key of the file gives either, as of a cam's profile [mm]
        pins : of those whose play moves another element than that on the first link, what it moves
        rollers : rollers that have play on their pins beside the pins of the links
        gears : by name
        radius : float [mm] - at which an error of the output in angle is measured by default; 0: the file must say
        places : by name, first and last input angle of a part of the cycle beside its whole range [rad]
    own : by key of the file - what an error of it adds to the output by itself [unit of the output per mm or deg]
    """

    sizes: Errors = field(default_factory=dict)
    centers: Mapping[str, float] = field(default_factory=dict)
    others: Mapping[str, float] = field(default_factory=dict)
    pins: Errors = field(default_factory=dict)
    rollers: tuple[str, ...] = ()
    gears: Mapping[str, Turned] = field(default_factory=dict)
    radius: float = 0.0
    places: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    own: Mapping[str, Course] = field(default_factory=dict)
