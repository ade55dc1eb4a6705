"""Two-gear four-bars of a ring gear whose output steps back with every frame: they have no momentary dwell."""

from __future__ import annotations

import math

from gearlink.core.linkages.always_stepping import AlwaysStepping
from gearlink.core.planet_linkages import two_gear_family as kernel
from gearlink.core.planet_linkages.two_gear_family import Family

_INSIDE = math.radians(1e-3)  # beside a limit of the transmission angle, for the digits of a printed frame


def always_stepping(family: Family) -> AlwaysStepping | None:
    """The frames of a family whose output steps back with each of them; None of one with a momentary dwell, or without
    any standstill.

    Raises
        NoSolution - where no frame makes a linkage that turns
    Example
        >>> found = always_stepping(Family(25.0, 45.28, 72.727, 44 / 69))
        >>> [round(math.degrees(angle), 3) for angle in (found.step(87.613), found.window(87.613, math.radians(0.2)))]
        [0.399, 61.394]
    """
    if not family.ring or kernel.stationary_frames(family):
        return None
    low, high = sorted((kernel.steep_end(family), kernel.quiet_end(family)))
    if kernel.back_step(family.drive(0.5 * (low + high))) is None:  # as many standstills as with every other frame
        return None
    return AlwaysStepping(lambda frame: kernel.valley(family.drive(frame)), low, high)


def keeping(always: AlwaysStepping, family: Family, angle: float) -> AlwaysStepping | None:
    """Those frames of crank-rockers whose transmission angle [rad] is nowhere less; None where there are none.

    d - a >= sqrt(b^2 + c^2 - 2 b c cos mu),   d + a <= sqrt(b^2 + c^2 + 2 b c cos mu)
    """
    a, b, c = family.crank, family.coupler, family.rocker
    short, long = (math.sqrt(b * b + c * c + sign * 2.0 * b * c * math.cos(angle + _INSIDE)) for sign in (-1.0, 1.0))
    return always.within(short + a, long - a)
