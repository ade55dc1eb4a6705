"""A three-gear four-bar whose centre distances are not those of its teeth: each part as made, one at a time.

The teeth keep the ratio of the gears, so coupler and rocker may differ a little from the centre distances; standstills
are those of `gearlink.core.three_gear.dwell.by_roots`.
"""

from __future__ import annotations

import math
from typing import Any

from gearlink.core.design import placed
from gearlink.core.errors import at_key
from gearlink.core.linkages.band_dwell import ToleranceDwell
from gearlink.core.linkages.checks import check_linkage
from gearlink.core.linkages.fourbar.position import FourBar
from gearlink.core.linkages.standstills import BackStep
from gearlink.core.results import cached_property
from gearlink.core.three_gear import motion
from gearlink.core.three_gear.design import ThreeGearFourBar
from gearlink.core.three_gear.dwell.dwells import MOMENTARY_DWELL, UNIDIRECTIONAL

_TURN = 2.0 * math.pi


class TolerancedDrive(ThreeGearFourBar):
    """A drive of given links, coupler and rocker among them.

    Parameters
        spec : ThreeGearSpec
        lengths : (crank, coupler, rocker, frame) [mm]
        window : (start, length) [rad] - crank angles over which `dwell_swing` is taken
    """

    advises = False

    def __init__(
        self, spec: Any, lengths: tuple[float, float, float, float], window: tuple[float, float] = (0.0, 0.0)
    ) -> None:
        super().__init__(spec)
        self.lengths, self.window = lengths, window

    coupler_length: float = placed("lengths.1")
    rocker_length: float = placed("lengths.2")

    @cached_property
    def linkage(self) -> FourBar:
        """The four-bar as it is made."""
        linkage = FourBar(*self.lengths, self.spec.assembly)
        with at_key("links"):
            check_linkage(linkage)
        return linkage

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
