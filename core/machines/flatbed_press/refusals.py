"""Why a follower cannot make its lift, and which key would let it: the nearest cause first."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_above, safely_below
from gearlink.core.base.wording import short
from gearlink.core.machines.flatbed_press.zone import turning_within

if TYPE_CHECKING:
    from gearlink.core.machines.flatbed_press.compensation import Compensation

_TURN = 2.0 * math.pi


def transition_too_early(follower: Compensation) -> NoSolution:
    """The transition ends before the zone does."""
    end = math.degrees(follower.cam_sync_end)
    text = (
        f"the transition ends at cam angle {short(math.degrees(follower.transition_end))} deg, the synchronous zone at "
        f"{short(end)} deg"
    )
    if end >= 360.0:
        return NoSolution(text, key="cam.transition_end", fix="shorten the zone")
    later = f"set cam.transition_end above {safely_above(end)} deg, the farther the flatter the cam"
    return turns_back(follower) or NoSolution(text, key="cam.transition_end", fix=later)


def return_too_late(follower: Compensation) -> NoSolution:
    """The return runs into the next sheet: shorten it, or the lead-in where that leaves no room at all."""
    next_sheet = follower.cam_sync_start - follower.lead_in + _TURN
    text = (
        f"the return ends at cam angle {short(math.degrees(follower.return_end))} deg, after the next sheet begins at "
        f"{short(math.degrees(next_sheet))} deg"
    )
    turned = turns_back(follower)
    if turned is not None:
        return turned
    most = math.degrees(next_sheet - follower.transition_end)
    if most > 0.0:
        return NoSolution(text, key="cam.return_angle", fix=f"set cam.return_angle to at most {safely_below(most)} deg")
    room = safely_below(math.degrees(follower.cam_sync_start + _TURN - follower.transition_end))
    fix = f"shorten cam.lead_in and cam.return_angle to {room} deg together"
    return NoSolution(text, key="cam.lead_in", fix=fix)


def turns_back(follower: Compensation) -> NoSolution | None:
    """The bed turns back within the zone, so that the zone is to end before; None where it does not."""
    turning = turning_within(follower.bed, follower.sync_start, follower.sync_end)
    if turning is None:
        return None
    key, unit = ("sync.end", "deg") if follower.end_given else ("sync.length", "mm")
    text = (
        f"the bed reverses at input angle {short(math.degrees(turning))} deg, before the synchronous zone ends "
        f"({short(math.degrees(follower.sync_end))} deg)"
    )
    fix = f"set {key} to at most {_most(follower, turning)} {unit}"
    begin, there = (float(follower.bed.cam_angle(angle).value) for angle in (follower.sync_start, turning))
    if begin < follower.transition_end <= there:
        most = _most(follower, float(follower.bed.input_angle(follower.transition_end)))
        fix = f"set {key} to at most {most} {unit}, where cam.transition_end ends the zone"
    elif follower.transition_end <= there:
        fix += ", and cam.transition_end behind the end of the zone"
    return NoSolution(text, key=key, fix=fix)


def _most(follower: Compensation, end: float) -> str:
    """The key of a zone that ends at an input angle: its length [mm], or the angle [deg]; to the safe side."""
    if follower.end_given:
        return safely_below(math.degrees(end))
    travel = follower.cylinder.travel
    return safely_below(float(travel(end).value - travel(follower.sync_start).value))
