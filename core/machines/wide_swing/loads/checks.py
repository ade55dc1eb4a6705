"""Checks of the loads of a wide-swing mechanism."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from gearlink.core.base.remedies.ways import at_least
from gearlink.core.base.report import Check
from gearlink.core.base.spec_paths import changed
from gearlink.core.machines.wide_swing import bodies
from gearlink.core.machines.wide_swing.remedies import side_changes, side_words
from gearlink.core.studies.loads import codes, vibration_checks
from gearlink.core.studies.loads.cams.checks import no_width, pressed_where_undercut

if TYPE_CHECKING:
    from gearlink.core.base.report import Remedy
    from gearlink.core.machines.wide_swing.loads.design import WideSwingLoads

_NEAR = 0.9
_TURN_BY = 15
"""Steps in which a direction is turned [deg]."""


def contact_pressure(design: WideSwingLoads) -> Iterator[Check]:
    """GL607, where the file gives an allowed pressure."""
    allowed = None if design.section.material is None else design.section.material.allowed_pressure
    found, roller = design.hertz_pressure_max, design.section.roller
    if allowed is None:
        return
    if roller is None:
        yield no_width(allowed)
        return
    if found is None:
        yield pressed_where_undercut("the roller presses where its cam", allowed)
        return
    rest = design.pressing.hardest_rest
    text = f"the roller presses with {found:.5g} N/mm^2" + (f" in the {rest.words}" if rest is not None else "")
    if found > allowed:
        message = f"{text}, above {allowed:g}: take a wider roller"
        yield codes.CONTACT_PRESSURE.check("fail", message, found, allowed, "N/mm^2")
    elif found > _NEAR * allowed:
        yield codes.CONTACT_PRESSURE.check("warn", f"{text}, little below {allowed:g}", found, allowed, "N/mm^2")
    else:
        yield codes.CONTACT_PRESSURE.check("pass", text, found, allowed, "N/mm^2")


def contact_loss(design: WideSwingLoads) -> Iterator[Check]:
    """GL608: the device holds the roller on its cam up to the speed of lift-off, and against all that acts besides."""
    speed, limit = design.spec.speed, design.lift_off_speed
    text = f"the roller leaves its cam at {limit:.5g} rev/min"
    if limit < speed * (1.0 - 1e-9):
        message = f"{text}, below the design's {speed:g}: raise unloader.reserve"
        yield codes.CONTACT_LOSS.check("fail", message, limit, speed, "1/min")
    else:
        yield codes.CONTACT_LOSS.check("pass", text, limit, speed, "1/min")
    if not design.own_forces and design.spec.slider is None:
        return
    least = design.least_contact_force
    text = f"with all that acts the roller presses its cam with at least {least:.5g} N"
    if least < 0.0:
        remedy = "raise unloader.reserve, or reduce loads.forces"
        if design.spec.slider is not None and changes_apart(design):
            remedy = f"the device changes sides before or after the roller; {side_words(design.spec.slider)}"
        message = f"{text}: it leaves the profile; {remedy}"
        yield codes.CONTACT_LOSS.check("fail", message, least, 0.0, "N")
    else:
        yield codes.CONTACT_LOSS.check("pass", text, least, 0.0, "N")


def resonance(design: WideSwingLoads) -> Iterator[Check]:
    """GL611, of a whole turn."""
    return vibration_checks.resonance(design) if design.whole else iter(())


def changes_apart(design: WideSwingLoads) -> bool:
    """Whether device and roller change sides at different places."""
    return any(check.status == "fail" for check in design.design.check("side-change"))


def candidates(design: WideSwingLoads, check: str) -> Iterator[Remedy]:
    """What lets the device hold the roller all the way, alone and with more reserve, and directions that are clear."""
    if check == "body-clearance":
        yield from _clear_directions(design)
    section, reserve = design.spec.slider, design.spec.unloader.reserve
    if check != "contact-loss" or section is None or not changes_apart(design):
        return
    for changes in side_changes(section):
        yield changes
        yield from ((*changes, ("unloader.reserve", at_least(reserve + more, 0.01))) for more in (0.25, 1.0))


def _clear_directions(design: WideSwingLoads) -> Iterator[Remedy]:
    """The nearest direction each way in which every body keeps clear, by geometry alone."""
    for name in design.own_directions:
        given = getattr(design.section, name)
        for sense in (1.0, -1.0) if given is not None else ():
            turned = (_in_turn(given + sense * step) for step in range(_TURN_BY, 180, _TURN_BY))
            found = next((each for each in turned if _is_clear(design, f"loads.{name}", each)), None)
            if found is not None:
                yield ((f"loads.{name}", found),)


def _in_turn(angle: float) -> float:
    return math.remainder(angle, 360.0)


def _is_clear(design: WideSwingLoads, path: str, value: float) -> bool:
    spec = changed(design.spec, ((path, value),))
    return spec is not None and not any(True for _ in bodies.placed_clearance(type(design)(spec)))
