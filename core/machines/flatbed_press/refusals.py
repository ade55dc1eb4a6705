"""Why a follower cannot make its lift, and which key would let it: the nearest cause first."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_below
from gearlink.core.machines.flatbed_press.zone import turning_within

if TYPE_CHECKING:
    from gearlink.core.machines.flatbed_press.compensation import Compensation

_TURN = 2.0 * math.pi


def transition_too_early(follower: Compensation) -> NoSolution:
    """The transition ends before the zone does."""
    end = math.degrees(follower.cam_sync_end)
    text = (
        f"the transition ends at cam angle {math.degrees(follower.transition_end):.6g} deg, but the synchronous zone "
        f"only at {end:.6g} deg"
    )
    if end >= 360.0:
        return NoSolution(f"{text}: shorten the zone", key="cam.transition_end")
    behind = f"{text}: put cam.transition_end behind it, the farther the flatter the cam"
    return turns_back(follower) or NoSolution(behind, key="cam.transition_end")


def return_too_late(follower: Compensation) -> NoSolution:
    """The return runs into the next sheet: shorten it, or the lead-in where that leaves no room at all."""
    next_sheet = follower.cam_sync_start - follower.lead_in + _TURN
    text = (
        f"the return ends at cam angle {math.degrees(follower.return_end):.6g} deg, after the next sheet begins at "
        f"{math.degrees(next_sheet):.6g} deg"
    )
    turned = turns_back(follower)
    if turned is not None:
        return turned
    most = math.degrees(next_sheet - follower.transition_end)
    if most > 0.0:
        return NoSolution(
            f"{text}: it leaves cam.return_angle {safely_below(most)} deg, the shorter the steeper the cam",
            key="cam.return_angle",
        )
    room = safely_below(math.degrees(follower.cam_sync_start + _TURN - follower.transition_end))
    return NoSolution(f"{text}: cam.lead_in and cam.return_angle have {room} deg together", key="cam.lead_in")


def turns_back(follower: Compensation) -> NoSolution | None:
    """The bed turns back within the zone, so that the zone is to end before; None where it does not."""
    turning = turning_within(follower.bed, follower.sync_start, follower.sync_end)
    if turning is None:
        return None
    key, unit = ("sync.end", "deg") if follower.end_given else ("sync.length", "mm")
    text = (
        f"the bed turns back at input angle {math.degrees(turning):.6g} deg, within the synchronous zone, which ends "
        f"at {math.degrees(follower.sync_end):.6g} deg: set {key} to at most {_most(follower, turning)} {unit}"
    )
    begin, there = (float(follower.bed.cam_angle(angle).value) for angle in (follower.sync_start, turning))
    if follower.transition_end <= there:
        text += ", and cam.transition_end behind the end of the zone"
    if begin < follower.transition_end <= there:
        most = _most(follower, float(follower.bed.input_angle(follower.transition_end)))
        text += f" (the {math.degrees(follower.transition_end):.6g} deg that it has do for {most} {unit})"
    return NoSolution(text, key=key)


def _most(follower: Compensation, end: float) -> str:
    """The key of a zone that ends at an input angle: its length [mm], or the angle [deg]; to the safe side."""
    if follower.end_given:
        return safely_below(math.degrees(end))
    travel = follower.cylinder.travel
    return safely_below(float(travel(end).value - travel(follower.sync_start).value))
