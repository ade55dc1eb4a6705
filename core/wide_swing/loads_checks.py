"""Checks of the loads of a wide-swing mechanism."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from gearlink.core.loads import codes, vibration_checks
from gearlink.core.loads.cam_checks import no_width
from gearlink.core.report import Check

if TYPE_CHECKING:
    from gearlink.core.wide_swing.loads import WideSwingLoads

_NEAR = 0.9


def contact_pressure(design: WideSwingLoads) -> Iterator[Check]:
    """GL607, where the file gives an allowed pressure."""
    allowed = None if design.section.material is None else design.section.material.allowed_pressure
    found, roller = design.hertz_pressure_max, design.section.roller
    if allowed is None:
        return
    if found is None or roller is None:
        yield no_width(allowed)
        return
    text = f"the roller presses with {found:.5g} N/mm^2"
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
    if not design.own_forces:
        return
    least = design.least_contact_force
    text = f"with all that acts the roller presses its cam with at least {least:.5g} N"
    if least < 0.0:
        message = f"{text}: it leaves the profile; raise unloader.reserve, or lessen loads.forces"
        yield codes.CONTACT_LOSS.check("fail", message, least, 0.0, "N")
    else:
        yield codes.CONTACT_LOSS.check("pass", text, least, 0.0, "N")


def resonance(design: WideSwingLoads) -> Iterator[Check]:
    """GL611, of a whole turn."""
    return vibration_checks.resonance(design) if design.whole else iter(())
