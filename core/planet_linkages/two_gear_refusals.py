"""What gears and links of a two-gear four-bar cannot do, in words, with the limits that they have."""

from __future__ import annotations

import math

from gearlink.core.linkages import standstills
from gearlink.core.linkages.fourbar.loop import rates_of
from gearlink.core.linkages.standstills import Turning
from gearlink.core.planet_linkages import two_gear_family as kernel
from gearlink.core.planet_linkages.planet import PlanetLinkage
from gearlink.core.planet_linkages.two_gear_family import Family
from gearlink.core.report import safely_above, safely_below

_AT_CHANGE_POINT = 1e-10  # for limits of the teeth, which approach theirs with the root of this share


def beyond_reach(what: str, most: float, drive: PlanetLinkage) -> str:
    """The refusal of a request that is more than the most [rad] of a family, which one of its drives reaches."""
    angle = math.degrees(drive.linkage.min_transmission_angle())
    return (
        f"{what} is more than these gears and links reach, {safely_below(math.degrees(most))} deg, and that with a "
        f"transmission angle of {angle:.3g} deg; ask for less"
    )


def never(family: Family) -> str:
    """Why gears and links have no momentary dwell, and the teeth that have."""
    low, high = kernel.frame_range(family)
    margin = _AT_CHANGE_POINT * (high - low)
    limits = f"frames between {low:.9g} and {high:.9g} mm"
    teeth = abs(1.0 / family.ratio)
    if not family.ring:
        reach = max(t.value for t in coupler_turnings(family.drive(high - margin))) - 1.0
        return (
            f"with {limits} the output never stands still: z5/z2 = {teeth:.6g} must be below {safely_below(reach)} "
            "with links of these lengths; take fewer teeth on the sun or more on the planet"
        )
    reach, least = (
        1.0 - min(t.value for t in coupler_turnings(family.drive(d))) for d in (low + margin, high - margin)
    )
    if teeth < least:
        return (
            f"with {limits} the output steps back always, with no momentary dwell to start from: z5/z2 = {teeth:.6g} "
            f"must be above {safely_above(least)} with links of these lengths; take more teeth on the ring gear"
        )
    return (
        f"with {limits} the output never stands still: z5/z2 = {teeth:.6g} must be below {safely_below(reach)} with "
        "links of these lengths; take fewer teeth on the ring gear or more on the planet"
    )


def coupler_turnings(drive: PlanetLinkage) -> list[Turning]:
    """Extremes of the coupler's speed per crank speed; those of the output lie at the same crank angles."""
    links = drive.linkage.reading
    return standstills.turnings(lambda phi: rates_of(links, phi, 1)[0], lambda phi: rates_of(links, phi, 2)[0])
