"""Standstills and dwells of three-gear drives whose coupler and rocker are not in proportion to the teeth.

The closed forms of `core.machines.three_gear.dwell.dwells` do not hold there; standstills are bracketed roots of the
output's speed.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from gearlink.core.base.results import cached_property
from gearlink.core.machines.three_gear import motion
from gearlink.core.machines.three_gear.dwell.dwells import STANDSTILL_TOLERANCE
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.parts.linkages.band_dwell import ToleranceDwell, Valley, longest_in_band
from gearlink.core.parts.linkages.fourbar.position import FourBar, solve
from gearlink.core.parts.linkages.standstills import BackStep, back_steps, standstills, turnings

_TURN = 2.0 * math.pi


@dataclass(frozen=True)
class ByRoots:
    """The output of a drive whose teeth keep the ratio of the gears at any length of coupler and rocker.

    Parameters
        linkage : FourBar [mm]
        train : GearTrain
    """

    linkage: FourBar
    train: motion.GearTrain

    @cached_property
    def ahead(self) -> motion.GearTrain:
        """The train counted in the direction of its mean motion, in which turning back has its meaning."""
        return motion.forward(self.linkage, self.train)

    def _speed(self, phi: float) -> float:
        return motion.output_speed(self.linkage, self.ahead, phi)

    def _angle(self, phi: float) -> float:
        return motion.output_angle(self.linkage, self.ahead, phi)

    @cached_property
    def places(self) -> list[float]:
        """Crank angles of zero output speed [rad], ascending."""
        extremes = turnings(self._speed, lambda phi: motion.output_acceleration(self.linkage, self.ahead, phi))
        state = solve(self.linkage, min(extremes, key=lambda one: one.value).place, 1)
        train = self.ahead
        terms = (train.ratio, train.coupler_share * state.coupler_velocity, train.rocker_share * state.rocker_velocity)
        return standstills(self._speed, extremes, STANDSTILL_TOLERANCE * sum(map(abs, terms)))

    @cached_property
    def back_step(self) -> BackStep | None:
        """The back-step, where there is one."""
        found = back_steps(self._speed, self._angle, self.places)
        return found[0] if found else None

    @cached_property
    def dwell_angle(self) -> float | None:
        """Crank angle until the output regains its place [rad]."""
        step = self.back_step
        if step is None:
            return None
        level = self._angle(step.start)
        ends = (min(-step.angle, 0.0), self._angle(step.start + _TURN) - level)
        return bracketed_root(lambda x: self._angle(step.start + x) - level, step.crank_angle, _TURN, ends=ends)

    def within(self, tolerance: float, extremes: motion.Extremes, mean_ratio: float) -> ToleranceDwell:
        """The longest dwell within a tolerance that has an end.

        Parameters
            tolerance : float [rad] - of the output to either side
            extremes : Extremes - of the speed ratio
            mean_ratio : float
        """
        step, forward = self.back_step, self.train.sense * self.ahead.sense
        least, greatest = (extremes.least_angle, extremes.greatest_angle)[::forward]
        first = second = least
        if step is not None:
            first, second = step.start, step.start + step.crank_angle
        after = first + (greatest - first) % _TURN
        low = after - _TURN
        valley = Valley(self._angle, self._speed, first, second, low, after, abs(mean_ratio))
        found = longest_in_band(valley, tolerance)
        return found._replace(output_angle=forward * found.output_angle)
