"""Two-gear four-bars of a ring gear whose output steps back with every frame: they have no momentary dwell."""

from __future__ import annotations

from gearlink.core.linkages.always_stepping import AlwaysStepping
from gearlink.core.planet_linkages import two_gear_family as kernel
from gearlink.core.planet_linkages.two_gear_frames import Family, stationary_frames


def always_stepping(family: Family) -> AlwaysStepping | None:
    """The frames of a family whose output steps back with each of them; None of one with a momentary dwell, or without
    any standstill.

    Raises
        NoSolution - where no frame makes a linkage that turns
    Example
        >>> found = always_stepping(Family(25.0, 45.28, 72.727, 44 / 69))
        >>> round(found.step(87.613), 6), round(found.window(87.613, 0.0035), 6)
        (0.006966, 1.071927)
    """
    if not family.ring or stationary_frames(family):
        return None
    low, high = sorted((kernel.steep_end(family), kernel.quiet_end(family)))
    if kernel.back_step(family.drive(0.5 * (low + high))) is None:  # as many standstills as with every other frame
        return None
    return AlwaysStepping(lambda frame: kernel.valley(family.drive(frame)), low, high)
