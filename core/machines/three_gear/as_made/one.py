"""A three-gear four-bar whose centre distances are not those of its teeth: each part as made, one at a time.

The teeth keep the ratio of the gears, so coupler and rocker may differ a little from the centre distances; standstills
are those of `gearlink.core.machines.three_gear.dwell.by_roots`.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from gearlink.core.base.design import placed
from gearlink.core.base.errors import at_key
from gearlink.core.base.results import cached_property
from gearlink.core.machines.three_gear import motion
from gearlink.core.machines.three_gear.design import ThreeGearFourBar
from gearlink.core.machines.three_gear.dwell.dwells import MOMENTARY_DWELL, UNIDIRECTIONAL
from gearlink.core.parts.linkages.band_dwell import ToleranceDwell
from gearlink.core.parts.linkages.checks import check_linkage
from gearlink.core.parts.linkages.fourbar.position import FourBar
from gearlink.core.parts.linkages.standstills import BackStep

if TYPE_CHECKING:
    from gearlink.core.parts.gears.mesh.pair import GearPair

_TURN = 2.0 * math.pi


class TolerancedDrive(ThreeGearFourBar):
    """A drive of given links, coupler and rocker among them.

    Parameters
        spec : ThreeGearSpec
        lengths : (crank, coupler, rocker, frame) [mm]
        window : (start, length) [rad] - crank angles over which `dwell_swing` is taken
        cut : ThreeGearFourBar or None - the drive of the same file, whose teeth these are; None: it is made here
    """

    advises = False

    def __init__(
        self,
        spec: Any,
        lengths: tuple[float, float, float, float],
        window: tuple[float, float] = (0.0, 0.0),
        cut: ThreeGearFourBar | None = None,
    ) -> None:
        super().__init__(spec)
        self.lengths, self.window = lengths, window
        self.cut = ThreeGearFourBar(spec) if cut is None else cut

    coupler_length: float = placed("lengths.1")
    rocker_length: float = placed("lengths.2")

    @cached_property
    def linkage(self) -> FourBar:
        """The four-bar as it is made."""
        linkage = FourBar(*self.lengths, self.spec.assembly)
        with at_key("links"):
            check_linkage(linkage)
        return linkage

    @cached_property
    def meshes(self) -> dict[str, GearPair]:
        """The teeth as they were cut, at the centre distances as made."""
        if self.own_teeth:
            return dict(self._own_pairs)
        return {
            name: at_distance(mesh, off) for (name, mesh), off in zip(self.cut.meshes.items(), self._off, strict=True)
        }

    @cached_property
    def _own_pairs(self) -> dict[str, GearPair]:
        pairs = zip(self.cut._own_pairs.items(), self._off, strict=True)
        return {name: at_distance(pair, off) for (name, pair), off in pairs}

    @property
    def _off(self) -> tuple[float, float]:
        """By how much the centre distances are greater than those that the teeth were cut for [mm]."""
        return self.lengths[1] - self.cut.coupler_length, self.lengths[2] - self.cut.rocker_length

    dwell_crank_angles: list[float] = placed("by_roots.places")

    @cached_property
    def motion(self) -> str:
        """unidirectional, momentary-dwell or back-step."""
        places = self.dwell_crank_angles
        if len(places) == 2:
            return "back-step"
        return MOMENTARY_DWELL if places else UNIDIRECTIONAL

    back_step: BackStep | None = placed("by_roots.back_step")
    dwell_angle: float | None = placed("by_roots.dwell_angle")

    @cached_property
    def tolerance_dwell(self) -> ToleranceDwell | None:
        """The longest dwell within the tolerance of the output, where the file gives one that has an end."""
        tolerance = self.output_tolerance
        if tolerance is None or tolerance >= math.pi * abs(self.mean_ratio):
            return None
        return self.by_roots.within(tolerance, self.speed_extremes, self.mean_ratio)

    @cached_property
    def dwell_swing(self) -> float:
        """Half the range of the output over the window [rad]."""
        start, length = self.window
        inside = [start + (place - start) % _TURN for place in self.dwell_crank_angles]
        places = [start, start + length, *(place for place in inside if place < start + length)]
        angles = [motion.output_angle(self.linkage, self.train, place) for place in places]
        return 0.5 * (max(angles) - min(angles))


def at_distance(mesh: Any, off: float) -> Any:
    """A mesh whose teeth and tips stay as they are, its axes farther apart by `off` [mm].

    Raises
        NoSolution - where the axes stand nearer than the base circles let them
    """
    if off == 0.0:
        return mesh
    distance = abs(mesh.center_distance) + off
    return replace(mesh, given_shift=mesh.profile_shift, given_distance=distance, tip=mesh.tip_alteration)
