"""Three-gear four-bars of any teeth over arrays: momentary dwells, and the analysis of given links.

Mirrors `MomentaryDwellSynthesis` (an eccentricity) and `ThreeGearFourBar`.
"""

from __future__ import annotations

import math
from functools import cached_property
from typing import Any

import numpy as np

from gearlink.core.machines.three_gear.many import general as many
from gearlink.core.machines.three_gear.many.batch import Batch
from gearlink.core.machines.three_gear.sweep import momentary_dwells
from gearlink.core.numerics.arrays import Mask, Reals
from gearlink.core.parts.linkages.fourbar.lengths import least_transmission_angle

_OF_STANDSTILLS = (
    "motion",
    "dwell_crank_angles[0]",
    "dwell_crank_angles[1]",
    "back_step_angle",
    "back_step_crank_angle",
    "dwell_angle",
    "dwell_angle_approximate",
)


class General(Batch):
    """Designs whose links are known; their motion is found by Newton's method."""

    @cached_property
    def radii(self) -> tuple[Reals, Reals, Reals]:
        """Reference radii of gears 1, 3 and 5."""
        return 0.5 * self.module * self.z1, 0.5 * self.module * self.z3, 0.5 * self.module * self.z5

    @cached_property
    def mu(self) -> Reals:
        """Of the folded and the stretched place."""
        return least_transmission_angle(*self.drives[:4])

    @cached_property
    def _extremes(self) -> tuple[tuple[Reals, Reals, Mask], tuple[Reals, Reals, Mask]]:
        return many.extreme(self.drives, 0.5 * math.pi, 1.0), many.extreme(self.drives, 1.5 * math.pi, -1.0)

    @cached_property
    def speeds(self) -> tuple[Reals, Reals]:
        """Both extremes."""
        greatest, least = self._extremes
        return greatest[0], least[0]

    @cached_property
    def places_of_speeds(self) -> tuple[Reals, Reals]:
        """Where they stand."""
        greatest, least = self._extremes
        return greatest[1], least[1]

    @cached_property
    def _seeks_speeds(self) -> bool:
        return self.seeks_band or any(
            name in ("speed_ratio_max", "speed_ratio_min", "nonuniformity") for name in self.wanted
        )

    @cached_property
    def links_are_doubtful(self) -> Mask:
        """Poor transmission, and links next to a change point."""
        return np.asarray(many.turns(self.drives)[2] | (self.mu < 1e-3))

    @cached_property
    def doubtful(self) -> Mask:
        """Besides: searches that did not come to rest."""
        greatest, least = self._extremes if self._seeks_speeds else ((None, None, ~self.none),) * 2
        return self.links_are_doubtful | ~(greatest[2] & least[2])


class Momentary(General):
    """`synth momentary-dwell` with an eccentricity."""

    keys = ("momentary.eccentricity",)
    given = ("crank",)
    reasons = ("momentary.eccentricity",)

    @property
    def wrong_with_every_idler(self) -> Mask:
        """A crank not below the radius of gear 1."""
        return np.asarray(self.key("momentary.eccentricity") >= self.radii[0])

    @cached_property
    def _found(self) -> Any:
        return momentary_dwells(*self.radii, self.key("momentary.eccentricity"))

    @cached_property
    def reason(self) -> Any:
        """A crank that never just stops the output."""
        return np.where(self._found.exists, 0, 1)

    @cached_property
    def links(self) -> tuple[Reals, Reals]:
        """The frame in closed form."""
        return np.where(self.exists, self.key("momentary.eccentricity"), np.nan), self._found.frame

    @cached_property
    def standstills(self) -> tuple[Reals, Reals]:
        """The one of the momentary dwell."""
        angle = self._found.crank_angle
        return (angle if self.spec.assembly == 1 else many.wrapped(-angle)), np.full(self.count, np.nan)

    @cached_property
    def back_step(self) -> tuple[Reals, Reals]:
        """None."""
        return np.full(self.count, np.nan), np.full(self.count, np.nan)

    @cached_property
    def dwell_angle(self) -> Reals:
        """None."""
        return np.full(self.count, np.nan)


class Analysis(General):
    """`analyze` of given links."""

    keys = ("links.crank", "links.frame")
    given = ("crank", "frame")
    reasons = ("links",)
    chooses_idler = False

    @cached_property
    def links(self) -> tuple[Reals, Reals]:
        """As given."""
        return self.key("links.crank"), self.key("links.frame")

    @cached_property
    def reason(self) -> Any:
        """Neither crank-rocker nor drag link."""
        rocker, drag, _ = many.turns(self.drives)
        return np.where(rocker | drag, 0, 1)

    @cached_property
    def _standing(self) -> tuple[Reals, Reals, Mask]:
        low, high, near = many.standstills(self.radii, self.drives)
        return np.where(self.exists, low, np.nan), np.where(self.exists, high, np.nan), near

    @cached_property
    def standstills(self) -> tuple[Reals, Reals]:
        """Roots of the quadratic."""
        low, high, _ = self._standing
        return low, high

    @cached_property
    def doubtful(self) -> Mask:
        """Besides: where the output just stops, links at a change point whether they turn or not."""
        seeks = self.seeks_band or any(name in _OF_STANDSTILLS for name in self.wanted)
        near = self._standing[2] if seeks else self.none
        return np.asarray(super().doubtful | near)

    @cached_property
    def _places(self) -> Any:
        return np.flatnonzero(np.isfinite(self.standstills[1]))

    @cached_property
    def _stepping(self) -> tuple[Reals, Reals, Reals]:
        """Start, crank angle and size of the back-steps of `_places`."""
        low, high = self.standstills
        return many.back_step(low[self._places], high[self._places], self.drives.part(self._places))

    @property
    def start_of_back_step(self) -> Reals:
        """Of standstills in ascending order it may be the second."""
        return self._spread(self._stepping[0])

    def _spread(self, values: Reals) -> Reals:
        found = np.full(self.count, np.nan)
        found[self._places] = values
        return found

    @cached_property
    def back_step(self) -> tuple[Reals, Reals]:
        """Between the standstills."""
        _, width, size = self._stepping
        return self._spread(size), self._spread(width)

    @cached_property
    def dwell_angle(self) -> Reals:
        """Until the output has regained its place."""
        start, width, _ = self._stepping
        return self._spread(many.dwell_angle(start, width, self.drives.part(self._places)))
