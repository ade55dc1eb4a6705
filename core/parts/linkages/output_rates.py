"""Maximum and minimum speed and acceleration ratio of an output with their places, as several kinds of drive have."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gearlink.core.base.design import placed

if TYPE_CHECKING:
    from gearlink.core.parts.linkages.standstills import Turning


class OutputRates:
    """The extremes of the output's ratios; a design gives all turnings of both over its period."""

    @property
    def speed_turnings(self) -> list[Turning]:
        """Extremes of the output's speed ratio."""
        raise NotImplementedError

    @property
    def acceleration_turnings(self) -> list[Turning]:
        """Extremes of its acceleration ratio."""
        raise NotImplementedError

    fastest = property(lambda self: max(self.speed_turnings, key=lambda t: t.value))
    slowest = property(lambda self: min(self.speed_turnings, key=lambda t: t.value))
    hardest = property(lambda self: max(self.acceleration_turnings, key=lambda t: t.value))
    hardest_back = property(lambda self: min(self.acceleration_turnings, key=lambda t: t.value))
    speed_ratio_max: float = placed("fastest.value")
    speed_ratio_max_at: float = placed("fastest.place")
    speed_ratio_min: float = placed("slowest.value")
    speed_ratio_min_at: float = placed("slowest.place")
    acceleration_ratio_max: float = placed("hardest.value")
    acceleration_ratio_max_at: float = placed("hardest.place")
    acceleration_ratio_min: float = placed("hardest_back.value")
    acceleration_ratio_min_at: float = placed("hardest_back.place")
