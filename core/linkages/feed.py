"""What the output of a gear-linkage feeds: a chain, a roller's web or a belt on its shaft."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from gearlink.core.real_speed import RealSpeed

if TYPE_CHECKING:
    from gearlink.core.linkages.spec_parts import Feed
    from gearlink.core.report import Column

FEED_QUANTITIES = (
    "feed_radius",
    "feed_per_turn",
    "feed_back_step",
    "chain_ripple",
    "feed_velocity_max",
    "feed_velocity_min",
    "feed_velocity_mean",
    "feed_acceleration_max",
    "feed_acceleration_min",
)


def feed_radius(feed: Feed) -> float:
    """Radius at which the output's angle becomes travel.

    roller: r,   belt: r + s/2,   chain: z p/(2 pi), by which a turn feeds z pitches

    Parameters
        feed : Feed - lengths [mm]
    Returns
        radius : float [mm] - times the ratio of feed shaft and output
    Source
        thesis 3.3.2: chain, roller or belt carry the product
    """
    ratio: float = feed.ratio
    if feed.pitch is not None and feed.teeth is not None:
        return ratio * feed.teeth * feed.pitch / (2.0 * math.pi)
    return ratio * ((feed.radius or 0.0) + 0.5 * feed.belt_thickness)


class FeedResults(RealSpeed):
    """Results of a design whose file may have a section `feed`; None of them without it."""

    mean_ratio: Any
    speed_ratio_max: Any
    speed_ratio_min: Any
    acceleration_ratio_max: Any
    acceleration_ratio_min: Any
    back_step_angle: Any

    @property
    def feed_radius(self) -> float | None:
        """Radius at which the output's angle becomes travel [mm]."""
        return None if self.spec.feed is None else feed_radius(self.spec.feed)

    @property
    def feed_per_turn(self) -> float | None:
        """Net travel per turn of the input [mm]."""
        return self._fed(2.0 * math.pi * self.mean_ratio) if self.spec.feed is not None else None

    @property
    def feed_back_step(self) -> float | None:
        """How far the travel goes back [mm]."""
        return self._fed(self.back_step_angle) if self.spec.feed is not None else None

    @property
    def chain_ripple(self) -> float | None:
        """Share by which a chain's speed falls between two teeth, 1 - cos(pi/z); none without a chain."""
        feed = self.spec.feed
        return None if feed is None or feed.teeth is None else 2.0 * math.sin(0.5 * math.pi / feed.teeth) ** 2

    @property
    def feed_velocity_max(self) -> float | None:
        """Greatest velocity of what is fed [mm/s]."""
        return self._real("speed_ratio_max", 1)

    @property
    def feed_velocity_min(self) -> float | None:
        """Least velocity of what is fed [mm/s]."""
        return self._real("speed_ratio_min", 1)

    @property
    def feed_velocity_mean(self) -> float | None:
        """Mean velocity of what is fed [mm/s]."""
        return self._real("mean_ratio", 1)

    @property
    def feed_acceleration_max(self) -> float | None:
        """Greatest acceleration of what is fed [mm/s^2]."""
        return self._real("acceleration_ratio_max", 2)

    @property
    def feed_acceleration_min(self) -> float | None:
        """Least acceleration of what is fed [mm/s^2]."""
        return self._real("acceleration_ratio_min", 2)

    def _fed(self, angle: float | None) -> float | None:
        return None if angle is None or self.feed_radius is None else angle * self.feed_radius

    def _real(self, name: str, order: int) -> float | None:
        if self.spec.feed is None or self.angular_speed is None:
            return None
        return self._fed(getattr(self, name) * self.angular_speed**order)

    def timed(
        self, columns: Mapping[str, tuple[Column, str]], angle: str, rates: Mapping[str, tuple[str, int]]
    ) -> dict[str, tuple[Column, str]]:
        """As `RealSpeed.timed`; what is fed after it, where the table has the output's motion."""
        whole, radius = super().timed(columns, angle, rates), self.feed_radius
        if radius is None or "speed_ratio" not in columns:
            return whole
        whole["feed_travel"] = (radius * math.pi / 180.0 * _array(columns["output_angle"][0]), "mm")
        for name, column, unit in (
            ("feed_velocity", "output_speed", "mm/s"),
            ("feed_acceleration", "output_acceleration", "mm/s^2"),
        ):
            if column in whole:
                whole[name] = (radius * _array(whole[column][0]), unit)
        return whole


def _array(data: Any) -> Any:
    import numpy as np

    return np.asarray(data)
