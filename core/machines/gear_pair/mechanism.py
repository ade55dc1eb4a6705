"""The mechanism of a gear pair: two gears on the frame."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from gearlink.core.mechanism.courses import turned
from gearlink.core.mechanism.joints import Mesh, Pin
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.motion import TURN, Input, Motion, Output
from gearlink.core.mechanism.rates import fixed, steady

if TYPE_CHECKING:
    from gearlink.core.machines.gear_pair.design import GearPairDesign
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.studies.movable import Movable


def errors(design: GearPairDesign, _mechanism: Mechanism) -> Movable:
    """The centre distance, and the runout of both gears; measured at the reference circle of gear 2."""
    from gearlink.core.mechanism.dual import Shift
    from gearlink.core.studies.movable import Movable, Turned
    from gearlink.core.studies.tolerance.sources import GearOfSource

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


def motion(design: GearPairDesign) -> Motion:
    """Links and mesh over the angle of gear 1, which stands at 0; gear 2 on +x, or about gear 1 where it is a ring."""
    pair = design.gear_pair
    r1, r2 = pair.working_radius
    center, tangent = complex(abs(pair.center_distance)), math.tan(pair.working_pressure_angle)
    turns = abs(pair.teeth[1]) // math.gcd(*pair.teeth)

    def make(phi: Reals, order: int, _side: int) -> Mechanism:
        links = {
            "gear1": Link(fixed(0j, phi, order=order), steady(phi, order=order)),
            "gear2": Link(fixed(center, phi, order=order), steady(phi, -r1 / r2, order=order)),
        }
        a, b = links["gear1"].origin.value, links["gear2"].origin.value
        if r2 < 0.0:
            mesh = Mesh("mesh_12", "gear2", "gear1", b, -1.0 + 0j, -r2, r1, tangent, True)
        else:
            mesh = Mesh("mesh_12", "gear1", "gear2", a, 1.0 + 0j, r1, r2, tangent)
        return Mechanism(links, [Pin("gear1", FRAME, "gear1", a), Pin("gear2", FRAME, "gear2", b), mesh], "gear1")

    return Motion(make, Input(end=TURN * turns, turns=turns), (Output("Gear 2", turned("gear2")),))
