"""The checks of rollers on cams."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from gearlink.core.base.report import Check, safely_above
from gearlink.core.base.wording import amount
from gearlink.core.studies.loads import checks, codes

if TYPE_CHECKING:
    from gearlink.core.studies.loads.cams.design import CamLoadsDesign

CAM_CHECKS = ("contact-pressure", "contact-loss", "roller-skid", "preload")
_NEAR = 0.9
_LEAST_SHARE = 0.1


def no_width(allowed: float) -> Check:
    """GL607 of a file that allows a pressure, and gives no width."""
    message = "without a width there is no pressure to hold against the allowed one: give loads.roller: {width: mm}"
    return codes.CONTACT_PRESSURE.check("warn", message, None, allowed, "N/mm^2")


def pressed_where_undercut(words: str, allowed: float) -> Check:
    """GL607 of a roller that would press where its profile is cut away."""
    message = f"{words} is undercut, and no pressure holds: enlarge the cam, or take a smaller roller"
    return codes.CONTACT_PRESSURE.check("fail", message, None, allowed, "N/mm^2")


def contact_pressure(design: CamLoadsDesign) -> Iterator[Check]:
    """GL607, where the file gives an allowed pressure."""
    material = design.section.material
    allowed = None if material is None else material.allowed_pressure
    found = design.pressure_extremes
    if allowed is None:
        return
    if found is None:
        yield no_width(allowed)
        return
    for name, extreme in zip(design.own_rollers, found, strict=True):
        if extreme is None:
            yield pressed_where_undercut(f"the {name} roller presses where its cam", allowed)
            continue
        text = f"the {name} roller presses with {extreme.value:.5g} N/mm^2 at {math.degrees(extreme.place):.5g} deg"
        if extreme.value > allowed:
            message = f"{text}, above {allowed:g}: take wider rollers"
            yield codes.CONTACT_PRESSURE.check("fail", message, extreme.value, allowed, "N/mm^2")
        elif extreme.value > _NEAR * allowed:
            message = f"{text}, little below {allowed:g}"
            yield codes.CONTACT_PRESSURE.check("warn", message, extreme.value, allowed, "N/mm^2")
        else:
            yield codes.CONTACT_PRESSURE.check("pass", text, extreme.value, allowed, "N/mm^2")


def load_reversal(design: CamLoadsDesign) -> Iterator[Check]:
    """GL602: each mesh, and a follower between two cams that no preload holds to both."""
    yield from checks.load_reversal(design)
    roller = design.section.roller
    if not design.on_two_sides or (roller is not None and roller.preload):
        return
    from gearlink.core.studies.loads.reversals import places

    size = max(abs(high.value) for _, high in design.force_extremes)
    found = [math.degrees(place) for place in places(design.side_force, design.machine, size)]
    if found:
        text = f"the follower changes cams {amount(len(found), 'time')} over the period, at {checks.listed(found)} deg"
        message = f"{text}: it strikes there; press both rollers on (loads.roller.preload)"
        yield codes.LOAD_REVERSAL.check("warn", message, float(len(found)), 0.0)
    else:
        yield codes.LOAD_REVERSAL.check("pass", "the follower stays on one cam", 0.0, 0.0)


def contact_loss(design: CamLoadsDesign) -> Iterator[Check]:
    """GL608: rollers that something presses to their cams."""
    if design.on_two_sides:
        return
    for name, (low, _) in zip(design.own_rollers, design.force_extremes, strict=True):
        import numpy as np

        mean = design.machine.mean(lambda phi, name=name: np.abs(design.contact_force(name, phi)))  # type: ignore[misc]
        text = f"the {name} roller presses with at least {low.value:.5g} N, at {math.degrees(low.place):.5g} deg"
        if low.value < 0.0:
            message = f"the {name} roller leaves its cam at {math.degrees(low.place):.5g} deg: {design.closing_remedy}"
            yield codes.CONTACT_LOSS.check("fail", message, low.value, 0.0, "N")
        elif low.value < _LEAST_SHARE * mean:
            message = f"{text}, under a tenth of its mean {mean:.5g}: {design.closing_remedy}"
            yield codes.CONTACT_LOSS.check("warn", message, low.value, 0.0, "N")
        else:
            yield codes.CONTACT_LOSS.check("pass", text, low.value, 0.0, "N")


def roller_skid(design: CamLoadsDesign) -> Iterator[Check]:
    """GL609, where the file gives a roller."""
    found = design.traction_needed
    if found is None:
        return
    limit = design.section.roller.friction
    for name, share in zip(design.own_rollers, found, strict=True):
        if share is None:
            message = f"the {name} roller leaves its cam, where nothing drives it round: press it harder"
            yield codes.ROLLER_SKID.check("warn", message, None, limit)
            continue
        text = f"the {name} roller needs {share:.3g} of its contact force to be driven round"
        if share > limit:
            message = f"{text}, more than the friction {limit:g}: take a lighter roller, or press it harder"
            yield codes.ROLLER_SKID.check("warn", message, share, limit)
        else:
            yield codes.ROLLER_SKID.check("pass", text, share, limit)


def preload(design: CamLoadsDesign) -> Iterator[Check]:
    """GL613, of a positive drive with preload."""
    needed = design.preload_needed
    if needed is None or not design.section.roller.preload:
        return
    given = design.section.roller.preload
    text = f"both rollers stay on their cams with a preload of {needed:.5g} N"
    if given < needed:
        message = f"{text}, {given:g} N is given: set loads.roller.preload to {safely_above(needed, 4)}"
        yield codes.PRELOAD.check("warn", message, given, needed, "N")
    else:
        yield codes.PRELOAD.check("pass", text, given, needed, "N")
