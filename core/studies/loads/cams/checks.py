"""The checks of rollers on cams."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from gearlink.core.base.report import NO_NUMBER, Check, Status, safely_above
from gearlink.core.base.wording import amount, short
from gearlink.core.studies.loads import checks, codes

if TYPE_CHECKING:
    from gearlink.core.studies.loads.cams.design import CamLoadsDesign

CAM_CHECKS = ("contact-pressure", "contact-loss", "roller-skid", "preload")
_NEAR = 0.9
_LEAST_SHARE = 0.1


def no_width(allowed: float) -> Check:
    """GL607 of a file that allows a pressure, and gives no width."""
    what, fix = "no contact pressure without the width of the roller", "give loads.roller: {width: mm}"
    return codes.CONTACT_PRESSURE.check("warn", what, None, allowed, "N/mm^2", fix=fix)


def pressed_where_undercut(words: str, allowed: float) -> Check:
    """GL607 of a roller that would press where its profile is cut away."""
    what, fix = f"{words} is undercut: no contact pressure", "enlarge the cam, or take a smaller roller"
    return codes.CONTACT_PRESSURE.check("fail", what, None, allowed, "N/mm^2", fix=fix)


def pressure_check(what: str, found: float, allowed: float, at: str) -> Check:
    """GL607 of a contact pressure [N/mm^2]."""
    status: Status = "fail" if found > allowed else "warn" if found > _NEAR * allowed else "pass"
    fix = "take a wider roller"
    most = _NEAR * allowed
    return codes.CONTACT_PRESSURE.check(status, what, found, allowed, "N/mm^2", recommended=most, at=at, fix=fix)


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
        at = f"{short(math.degrees(extreme.place))} deg"
        yield pressure_check(f"contact pressure of the {name} roller", extreme.value, allowed, at)


def load_reversal(design: CamLoadsDesign) -> Iterator[Check]:
    """GL602: each mesh, and a follower between two cams that no preload holds to both."""
    yield from checks.load_reversal(design)
    roller = design.section.roller
    if not design.on_two_sides or (roller is not None and roller.preload):
        return
    from gearlink.core.studies.loads.joints import places

    size = max(abs(high.value) for _, high in design.force_extremes)
    found = [math.degrees(place) for place in places(design.side_force, design.machine, size)]
    if found:
        what, fix = "the follower changes cams", "press both rollers on (loads.roller.preload)"
        yield codes.LOAD_REVERSAL.check(
            "warn",
            f"{what} {amount(len(found), 'time')} over the period and strikes there",
            float(len(found)),
            0.0,
            shown=NO_NUMBER,
            at=f"{checks.listed(found)} deg",
            fix=fix,
        )
    else:
        yield codes.LOAD_REVERSAL.check("pass", "the follower stays on one cam", 0.0, 0.0, shown=NO_NUMBER)


def contact_loss(design: CamLoadsDesign) -> Iterator[Check]:
    """GL608: rollers that something presses to their cams."""
    if design.on_two_sides:
        return
    for name, (low, _) in zip(design.own_rollers, design.force_extremes, strict=True):
        import numpy as np

        mean = design.machine.mean(lambda phi, name=name: np.abs(design.contact_force(name, phi)))  # type: ignore[misc]
        status: Status = "fail" if low.value < 0.0 else "warn" if low.value < _LEAST_SHARE * mean else "pass"
        yield codes.CONTACT_LOSS.check(
            status,
            f"minimum contact force of the {name} roller",
            low.value,
            0.0,
            "N",
            overlap=f"contact force lacking: the {name} roller leaves its cam",
            recommended=_LEAST_SHARE * mean,
            at=f"{short(math.degrees(low.place))} deg",
            fix=design.closing_remedy,
        )


def roller_skid(design: CamLoadsDesign) -> Iterator[Check]:
    """GL609, where the file gives a roller."""
    found = design.traction_needed
    if found is None:
        return
    limit = design.section.roller.friction
    for name, share in zip(design.own_rollers, found, strict=True):
        if share is None:
            what, fix = f"the {name} roller leaves its cam, where nothing drives it round", "press it harder"
            yield codes.ROLLER_SKID.check("warn", what, None, limit, fix=fix)
            continue
        what = f"friction that drives the {name} roller round, over its contact force"
        status: Status = "warn" if share > limit else "pass"
        yield codes.ROLLER_SKID.check(status, what, share, limit, fix="take a lighter roller, or press it harder")


def preload(design: CamLoadsDesign) -> Iterator[Check]:
    """GL613, of a positive drive with preload."""
    needed = design.preload_needed
    if needed is None or not design.section.roller.preload:
        return
    given = design.section.roller.preload
    status: Status = "warn" if given < needed else "pass"
    fix = f"set loads.roller.preload to {safely_above(needed)}"
    yield codes.PRELOAD.check(status, "preload that holds both rollers on their cams", given, needed, "N", fix=fix)
