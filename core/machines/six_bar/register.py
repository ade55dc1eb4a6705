"""What the errors of a geared six-bar move."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from gearlink.core.machines.six_bar.spec import LINKS, gear_bodies
from gearlink.core.mechanism.dual import longer
from gearlink.core.mechanism.links import FRAME
from gearlink.core.studies.register.movable import Movable, Turned
from gearlink.core.studies.tolerance.sources import GearOfSource

if TYPE_CHECKING:
    from gearlink.core.machines.six_bar.design import GearedSixBar
    from gearlink.core.mechanism.links import Mechanism


def errors(design: GearedSixBar, mechanism: Mechanism) -> Movable:
    """Links, where they carry a mesh its centre distance, and the runout of free gears; measured at the pin E."""
    ends = {f"links.{name}": (name, length) for name, length in zip(LINKS[1:], design.lengths[1:], strict=True)}
    sizes = longer(mechanism, ends | {"links.frame": (FRAME, design.lengths[0])})
    centers = {name: design.lengths[LINKS.index(name)] for name in LINKS if getattr(design.spec.links, name) is None}
    sizes |= {f"centers.{name}": sizes[f"links.{name}"] for name in centers}
    gears = {}
    for number, train in enumerate(design.spec.trains, start=1):
        for name, z in list(zip(gear_bodies(train, number), train.gears, strict=True))[1:-1]:
            teeth = GearOfSource(train.module, train.module * abs(z), math.radians(train.pressure_angle))
            gears[name] = Turned(name, teeth)
    return Movable(sizes, centers, gears=gears, radius=design.lengths[5])
