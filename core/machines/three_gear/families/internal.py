"""Linkages of three gears with an internal mesh in one unknown, as in `external`, on the side where the output steps
back: with r5 < 0, a ring gear round the whole train, that is a frame shorter than d*.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.three_gear.dwell.internal_dwell import shape, tangency
from gearlink.core.machines.three_gear.families.external import Family, frames_of, longest_crank
from gearlink.core.parts.linkages.fourbar.position import FourBar


def with_crank(r1: float, r3: float, r5: float, crank: float, assembly: int = 1) -> Family:
    """The linkages of a given crank; the unknown is the frame.

    Parameters
        r1, r3, r5 : float [mm] - reference radii, negative for a gear in internal mesh with the idler
        crank : float [mm] - e
    Raises
        NoSolution - for a crank that cannot turn
    Example
        >>> family = with_crank(24.0, 17.0, -54.0, 22.0)
        >>> round(family.low, 9), family.high
        (49.532212052, 26.0)
    """
    b, c = abs(r1 + r3), abs(r3 + r5)
    short, long = frames_of(crank, b, c)

    def linkage(d: float) -> FourBar:
        return FourBar(crank, b, c, d, assembly)

    found = shape(r1, r3, r5)
    least, high = (short, long) if found.sigma > 0 else (long, short)
    if crank >= found.high:  # steps back with every frame
        return Family(linkage, least, least, high)
    if not found.low < crank:
        why = f"a crank of {crank:.9g} mm never stops the output: it must be longer than {found.low:.9g} mm"
        return Family(linkage, least, None, high, why)
    touching = tangency(r1, r3, r5, crank)
    assert touching is not None, "a crank in the range has a frame that just stops the output"
    inside = min(max(touching.frame, short), long)
    if inside == high:
        why = f"a crank of {crank:.9g} mm makes no crank-rocker whose output steps back: choose another"
        return Family(linkage, least, None, high, why)
    return Family(linkage, least, inside, high)


def with_frame(r1: float, r3: float, r5: float, frame: float, assembly: int = 1) -> Family:
    """The linkages of a given frame; the unknown is the crank.

    Raises
        NoSolution - for a frame with which no crank-rocker exists
    """
    b, c = abs(r1 + r3), abs(r3 + r5)
    high = longest_crank(frame, b, c)
    why = f"no crank makes the output step back with a frame of {frame:.9g} mm"
    return _rising(r1, r3, r5, lambda e: FourBar(e, b, c, frame, assembly), min(high, abs(r1)), why)


def balanced(r1: float, r3: float, r5: float, assembly: int = 1) -> Family:
    """The linkages whose transmission angle deviates from 90 deg equally at both ends; the unknown is the crank.

    Raises
        NoSolution - for gears whose output never just stops
    """
    b, c = abs(r1 + r3), abs(r3 + r5)

    def linkage(e: float) -> FourBar:
        return FourBar(e, b, c, math.sqrt((b - e) * (b + e) + c * c), assembly)

    why = "these gears have no balanced linkage whose output steps back; give crank or frame"
    return _rising(r1, r3, r5, linkage, min(b, c, abs(r1)), why)


def balanced_eccentricity(r1: float, r3: float, r5: float) -> float:
    """Crank length of the balanced momentary dwell: e^2 + d*^2 = b^2 + c^2.

    e_bal^2 = (r5^2 + kappa r1^2 - b^2 - c^2)/(kappa - 1)

    Parameters
        r1, r3, r5 : float [mm] - signed reference radii
    Returns
        eccentricity : float [mm]
    Raises
        NoSolution - where the balanced linkage has no momentary dwell
    Example
        >>> round(balanced_eccentricity(24.0, 17.0, -60.0), 9)
        22.063426867
    """
    found, square = shape(r1, r3, r5), (r1 + r3) ** 2 + (r3 + r5) ** 2
    crank2 = (r5 * r5 + found.kappa * r1 * r1 - square) / (found.kappa - 1.0)
    if not found.low**2 < crank2 < min(found.high**2, (r1 + r3) ** 2, (r3 + r5) ** 2):
        raise NoSolution("these gears have no balanced linkage with a momentary dwell; give crank or frame")
    return math.sqrt(crank2)


def eccentricity_for_frame(r1: float, r3: float, r5: float, frame: float) -> float:
    """Crank length whose momentary dwell has a given frame.

    e^2 = r1^2 - (d^2 - r5^2)/kappa

    Raises
        NoSolution - for a frame outside the range, naming it
    Example
        >>> round(eccentricity_for_frame(24.0, 17.0, -54.0, 49.53221205192578), 9)
        22.0
    """
    found = shape(r1, r3, r5)
    square = r1 * r1 - (frame - r5) * (frame + r5) / found.kappa
    if not found.low**2 < square < found.high**2:
        ends = [r5 * r5 + (r1 - e) * (r1 + e) * found.kappa for e in (found.low, found.high)]
        low, high = sorted(math.sqrt(max(0.0, end)) for end in ends)
        raise NoSolution(
            f"no crank gives these gears a momentary dwell with a frame of {frame:.9g} mm: it must lie between "
            f"{low:.9g} and {high:.9g} mm"
        )
    return math.sqrt(square)


def momentary_linkage(r1: float, r3: float, r5: float, crank: float, assembly: int = 1) -> FourBar:
    """The crank-rocker of a given crank whose output just stops.

    Raises
        NoSolution - where no crank-rocker of these gears and crank does so
    Example
        >>> round(momentary_linkage(24.0, 17.0, -54.0, 22.0).frame, 9)
        49.532212052
    """
    family, found = with_crank(r1, r3, r5, crank, assembly), shape(r1, r3, r5)
    if family.low is None:
        raise NoSolution(family.why)
    if crank >= found.high:
        raise NoSolution(
            f"a crank of {crank:.9g} mm never just stops the output: it must lie between {found.low:.9g} and "
            f"{found.high:.9g} mm"
        )
    if family.low == family.least:
        raise NoSolution(
            f"a crank of {crank:.9g} mm cannot turn with the frame of its momentary dwell: choose another between "
            f"{found.low:.9g} and {found.high:.9g} mm"
        )
    return family.linkage(family.low)


def _rising(r1: float, r3: float, r5: float, linkage: Callable[[float], FourBar], high: float, why: str) -> Family:
    """The family along the crank from where the output just stops; the frame of a linkage is compared with d* of it.

    sigma (d^2 - d*^2), linear in e^2, rises through zero there.
    """
    found = shape(r1, r3, r5)

    def beyond(e: float) -> float:
        star = r5 * r5 + (r1 - e) * (r1 + e) * found.kappa
        return found.sigma * (linkage(e).frame ** 2 - star)

    most = high * (1.0 - 1e-12)
    if beyond(most) <= 0.0:
        return Family(linkage, 0.0, None, high, why)
    at_zero = beyond(1e-9 * high)
    if at_zero >= 0.0:
        return Family(linkage, 0.0, found.low if found.low < high else None, high, why)
    low = max(found.low, most * math.sqrt(at_zero / (at_zero - beyond(most))))
    return Family(linkage, 0.0, low, high, why)
