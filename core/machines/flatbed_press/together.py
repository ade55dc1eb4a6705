"""What many presses seek at once: the extremes of their cams, whose follower is one with columns for its numbers."""

from __future__ import annotations

import math
from collections.abc import Hashable, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.base.errors import GearlinkError
from gearlink.core.base.many_designs import column, hand_in, hand_out, in_groups, sought, stacked
from gearlink.core.base.results import keep
from gearlink.core.machines.flatbed_press.chains import Travel
from gearlink.core.machines.flatbed_press.compensation import STEPS, Compensation, peaks
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.together import kept_last
from gearlink.core.parts.cams.disc_cam import FOUND_TOGETHER, seek_together
from gearlink.core.parts.cams.profile import RollerPath, translating

if TYPE_CHECKING:
    from gearlink.core.machines.flatbed_press.design import PressCams

_TURN = 2.0 * math.pi
_OF_BED, _OF_CYLINDER = ("_start", "initial_crank_angle", "inverse", "start_input"), ("_start",)
_OF_FOLLOWER = ("cam_sync_start", "cam_sync_end", "_difference_at_start", "lead_in_lift", "top")


def find_together(cams: Sequence[PressCams]) -> None:
    """Let cams keep what is found for all of them."""
    for group in in_groups([each for each in cams if _stand(each)], _alike):
        sought(_find, group)


def _stand(cams: PressCams) -> bool:
    """Whether there are a follower and a size; what is wrong with others they say themselves."""
    with suppress(GearlinkError):
        return cams.follows and cams.base_radius > 0.0
    return False


def _alike(cams: PressCams) -> Hashable:
    """What no column stands for."""
    follower = cams.follower
    sides = follower.bed.linkage.assembly, follower.cylinder.linkage.assembly
    return sides, follower.transition, follower.lead_in > 0.0, follower.end_given, id(follower.return_law)


def _as_one(followers: Sequence[Compensation]) -> Compensation:
    beds, cylinders = [each.bed for each in followers], [each.cylinder for each in followers]
    bed, cylinder = stacked(beds), stacked(cylinders)
    hand_in(bed, beds, *_OF_BED)
    hand_in(cylinder, cylinders, *_OF_CYLINDER)
    many = stacked(followers, bed=bed, cylinder=cylinder)
    of_transition = "arc_radius" if many.transition == "arc" else "_transition_terms"
    hand_in(many, followers, *_OF_FOLLOWER, of_transition)
    if np.all(many.lead_in > 0.0):
        hand_in(many, followers, "_lead_in_terms")
    return many


class _Lift:
    """The lift of many followers over one revolution, a row for each."""

    def __init__(self, followers: Sequence[Compensation]) -> None:
        many = _as_one(followers)
        own = [follower.segments for follower in followers]
        laws = {"lead-in": many._lead_in, "sync": many._sync, "transition": many._transition, "return": many._return}
        self.stretches = [
            (laws[one.phase], column([each[k].start for each in own]), column([each[k].end for each in own]))
            for k, one in enumerate(own[0][:-1])
        ]
        self.count, self.begin = len(followers), self.stretches[0][1]

    def over(self, theta: Reals, order: int) -> Travel:
        """As of `Compensation.lift`: at angles for all, (K,), or at a row for each; every stretch at all of them."""
        turned = np.broadcast_to(theta, (self.count, theta.shape[-1])) - self.begin
        turned = self.begin + np.mod(turned, _TURN)
        found = [np.zeros_like(turned) for _ in range(order + 1)]
        for lift, start, end in self.stretches:
            here, part = (turned >= start) & (turned < end), lift(np.clip(turned, start, end), order)
            found = [np.where(here, rate, before) for rate, before in zip(part[: order + 1], found, strict=True)]
        return Travel(*found)

    def grids(self) -> list[tuple[Reals, Reals]]:
        """Evenly spaced places of every stretch but the dwell, and the lift there; a row for each follower."""
        shares = np.arange(STEPS + 1) / STEPS
        places = [np.broadcast_to(start + (end - start) * shares, (self.count, shares.size))
                  for _, start, end in self.stretches]  # fmt: skip
        return [(grid, lift(grid, 0).value) for grid, (lift, _, _) in zip(places, self.stretches, strict=True)]


def _find(cams: Sequence[PressCams]) -> None:
    followers = [each.follower for each in cams]
    lift = _Lift(followers)
    grids = [(grid.tolist(), values.tolist()) for grid, values in lift.grids()]
    for k, follower in enumerate(followers):
        of_each = [(grid[k], values[k]) for grid, values in grids]
        keep(follower, lift_range=peaks(follower.segments, of_each))
    lifted = [kept_last(lambda theta, order=order: lift.over(theta, order)) for order in range(3)]  # type: ignore[misc]
    pairs = list(zip(*(each.discs for each in cams), strict=True))
    many = []
    for discs, at_rest in zip(pairs, zip(*(each.radii_at_rest for each in cams), strict=True), strict=True):
        many.append(stacked(discs, path=_path(lifted, column(at_rest))))
    seek_together(many)
    for found, discs in zip(many, pairs, strict=True):
        hand_out(found, discs, *FOUND_TOGETHER)


def _path(lifted: Sequence[Any], at_rest: Any) -> Any:
    def path(theta: Reals, order: int) -> RollerPath:
        lift = lifted[order](theta)
        return translating(at_rest + lift.value, lift.first, lift.second if order > 1 else 0.0)

    return path
