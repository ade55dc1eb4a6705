"""Three gears with a crank so long that the output steps back with every frame: its dwells about one standstill."""

from __future__ import annotations

from gearlink.core.machines.three_gear.dwell.tolerance_dwell import valley
from gearlink.core.machines.three_gear.families.external import Family, back_step_of
from gearlink.core.machines.three_gear.motion import GearTrain, forward
from gearlink.core.parts.linkages.always_stepping import AlwaysStepping
from gearlink.core.parts.linkages.band_dwell import Valley


def always_stepping(family: Family, train: GearTrain) -> AlwaysStepping | None:
    """The frames of a given crank, where the output steps back with each of them; None where one just stops it.

    Example
        >>> from gearlink.core.machines.three_gear.families.external import with_crank
        >>> found = always_stepping(with_crank(54.0, 78.0, 49.0, 72.778), GearTrain(54, 78, 49))
        >>> round(found.least_step[1], 6)
        0.455302
    """
    if family.low is None or family.low != family.least or family.least == 0.0:
        return None
    low, high = sorted(family.stepping())
    if back_step_of(train)(family.linkage(0.5 * (low + high))) <= 0.0:
        return None

    def valley_of(frame: float) -> Valley:
        linkage = family.linkage(frame)
        return valley(linkage, forward(linkage, train))

    return AlwaysStepping(valley_of, low, high)
