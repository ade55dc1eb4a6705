"""What the errors of a gear pair move."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from gearlink.core.mechanism.dual import Shift
from gearlink.core.mechanism.links import FRAME
from gearlink.core.studies.register.movable import Movable, Turned
from gearlink.core.studies.tolerance.sources import GearOfSource

if TYPE_CHECKING:
    from gearlink.core.machines.gear_pair.design import GearPairDesign
    from gearlink.core.mechanism.links import Mechanism


def errors(design: GearPairDesign, _mechanism: Mechanism) -> Movable:
    """The centre distance, and the runout of both gears; measured at the reference circle of gear 2."""
    pair = design.gear_pair
    farther = (Shift(FRAME, ("gear2",)),)
    teeth = [
        GearOfSource(pair.module, 2.0 * abs(radius), math.radians(design.spec.pressure_angle))
        for radius in pair.reference_radius
    ]
    gears = {name: Turned(name, each) for name, each in zip(("gear1", "gear2"), teeth, strict=True)}
    return Movable(
        {"center_distance": farther, "centers.gears": farther},
        {"gears": abs(pair.center_distance)},
        gears=gears,
        radius=abs(pair.reference_radius[1]),
    )
