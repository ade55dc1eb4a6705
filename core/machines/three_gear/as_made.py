"""Three-gear four-bars whose parts are as manufactured, not as designed: one at a time, and many near one at once.

The teeth keep the ratio of the gears, so coupler and rocker may differ a little from the centre distances; standstills
of one drive are those of `gearlink.core.machines.three_gear.dwell.ByRoots`, of many those of `sweep`. What comes to
rest far from the nominal drive, or hangs by few digits, is not settled, and `TolerancedDrive` computes it alone.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.base.design import placed
from gearlink.core.base.errors import at_key
from gearlink.core.base.results import cached_property
from gearlink.core.machines.three_gear import motion, sweep
from gearlink.core.machines.three_gear.design import ThreeGearFourBar
from gearlink.core.machines.three_gear.dwell import STANDSTILL_TOLERANCE, ByRoots
from gearlink.core.numerics.arrays import Mask, Reals
from gearlink.core.parts.linkages.checks import check_linkage
from gearlink.core.parts.linkages.fourbar.position import FourBar
from gearlink.core.parts.linkages.fourbar.sweep import least_transmission_angle

if TYPE_CHECKING:
    from gearlink.core.parts.gears.mesh.pair import GearPair


_TURN = 2.0 * math.pi
_MOST_OFF = 0.5  # [rad] by which an extreme may lie beside the nominal one
_CHORD_REST, _MOST_STEPS = 3e-7, 12  # of a step whose slope is the nominal drive's: a value there is off by its cube


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
        """The teeth as they were cut, at the centre distances as manufactured."""
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

    @cached_property
    def output(self) -> ByRoots:
        """Standstills as roots: the links as manufactured are in no proportion to the teeth."""
        return ByRoots(self.linkage, self.train)

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


class DriveSamples:
    """What a study asks of many drives near a nominal one.

    Parameters
        nominal : ThreeGearFourBar
        lengths : crank, coupler, rocker, frame - (N,) arrays [mm]
        frame_turn : (N,) array [rad] - by how much the line A-D is turned: crank angles count from the nominal line
    """

    def __init__(
        self, nominal: ThreeGearFourBar, lengths: tuple[Reals, Reals, Reals, Reals], frame_turn: Reals | float = 0.0
    ) -> None:
        self.nominal, self.lengths = nominal, lengths
        self.count = lengths[0].size
        self.frame_turn = np.broadcast_to(frame_turn, (self.count,))
        self.train = motion.forward(nominal.linkage, nominal.train)
        self.counted = nominal.train.sense * self.train.sense  # -1 where the file counts the output backward
        self.unsettled: Mask = np.zeros(self.count, dtype=bool)

    @cached_property
    def drives(self) -> sweep.Drives:
        """Linkages and gears."""
        train = self.train
        shares = train.ratio, train.coupler_share, train.rocker_share
        return sweep.drives_of(self.lengths, self.nominal.spec.assembly, *shares)

    def turning(self) -> tuple[Mask, Mask]:
        """Which are of the nominal drive's kind, crank-rocker or drag link, and which of the other; the rest do not
        turn."""
        rocker, drag, near = sweep.turns(self.drives)
        self.unsettled |= near
        positive = np.minimum.reduce(self.lengths) > 0.0
        own, other = (rocker, drag) if self.nominal.linkage.kind() == "crank-rocker" else (drag, rocker)
        return positive & own, positive & other

    def angle_at(self, phi: Reals) -> Reals:
        """Output angles [rad] at crank angles against the line A-D, of any zero."""
        return sweep.output_angle(phi, self.drives)

    # Extremes

    def _extreme(self, place: float, sign: float) -> tuple[Reals, Reals]:
        """The extreme of the speed near the nominal one, and its place; sign +1 for the greatest."""
        value, found, rests = sweep.extreme(self.drives, np.full(self.count, place), sign)
        self.unsettled |= ~rests | ~(np.abs(found - place) < _MOST_OFF)
        return value, found

    @cached_property
    def _extremes(self) -> motion.Extremes:
        """Of the nominal drive's speed, the output counted in the direction of its mean motion."""
        found = self.nominal.speed_extremes
        if self.counted > 0:
            return found
        return motion.Extremes(-found.least, found.least_angle, -found.greatest, found.greatest_angle)

    @cached_property
    def _least(self) -> tuple[Reals, Reals]:
        return self._extreme(self._extremes.least_angle, -1.0)

    @cached_property
    def _greatest(self) -> tuple[Reals, Reals]:
        return self._extreme(self._extremes.greatest_angle, 1.0)

    @property
    def speed_ratio_min(self) -> Reals:
        """Minimum speed ratio."""
        return self._least[0] if self.counted > 0 else -self._greatest[0]

    @property
    def speed_ratio_max(self) -> Reals:
        """Maximum speed ratio."""
        return self._greatest[0] if self.counted > 0 else -self._least[0]

    def _acceleration_extreme(self, place: float) -> Reals:
        """Of the parabola about a place where the next step, with the nominal drive's slope of the jerk, is small."""
        linkage, h = self.nominal.linkage, 1e-4
        jerks = [motion.output_jerk(linkage, self.train, place + side) for side in (-h, h)]
        slope = (jerks[1] - jerks[0]) / (2.0 * h)
        phi, value, live = np.full(self.count, place), np.full(self.count, np.nan), np.arange(self.count)
        for _ in range(_MOST_STEPS):
            _, acceleration, jerk = sweep.speed(phi[live], self.drives.part(live))
            step = jerk / slope
            phi[live] -= step
            value[live] = acceleration - 0.5 * jerk * step
            live = live[np.abs(step) > _CHORD_REST]
            if not live.size:
                break
        self.unsettled[live] = True
        self.unsettled |= ~(np.abs(phi - place) < _MOST_OFF)
        return self.counted * value

    @cached_property
    def acceleration_ratio_max(self) -> Reals:
        """Maximum acceleration ratio [1/rad]."""
        return self._acceleration_extreme(self.nominal.acceleration_extremes.greatest_angle)

    @cached_property
    def acceleration_ratio_min(self) -> Reals:
        """Minimum acceleration ratio [1/rad]."""
        return self._acceleration_extreme(self.nominal.acceleration_extremes.least_angle)

    @cached_property
    def nonuniformity(self) -> Reals:
        """(max - min)/mean of the speed ratio."""
        return (self.speed_ratio_max - self.speed_ratio_min) / abs(self.nominal.mean_ratio)

    # Back-step

    @cached_property
    def turns_back(self) -> Mask:
        """Where the output turns back."""
        value, place = self._least
        return np.asarray(value < -STANDSTILL_TOLERANCE * sweep.terms(place, self.drives))

    @cached_property
    def standstills(self) -> tuple[Reals, Reals]:
        """Start and end of the back-step [rad], against the line A-D; without one the minimum speed's place twice."""
        least, some = self._least[1], np.flatnonzero(self.turns_back)
        first, second = least.copy(), least.copy()
        if not some.size:
            return first, second
        drives = self.drives if some.size == self.count else self.drives.part(some)
        # any place between the second standstill and the first of the next revolution ends the brackets
        fast = np.full(some.size, self._extremes.greatest_angle)
        self.unsettled[some] |= ~(sweep.speed(fast, drives, 1)[0] > 0.0)
        first[some], second[some] = sweep.around(least[some], fast, drives)
        return first, second

    @cached_property
    def back_step_angle(self) -> Reals:
        """How far the output turns back [rad]; NaN where it does not."""
        top, bottom = (self.angle_at(place) for place in self.standstills)
        return np.where(self.turns_back, top - bottom, np.nan)

    @cached_property
    def back_step_crank_angle(self) -> Reals:
        """Crank angle of the back-step [rad]."""
        first, second = self.standstills
        return np.where(self.turns_back, second - first, np.nan)

    @property
    def dwell_angle_approximate(self) -> Reals:
        """1.5 times the crank angle of the back-step [rad]."""
        return 1.5 * self.back_step_crank_angle

    @cached_property
    def dwell_angle(self) -> Reals:
        """Crank angle until the output is back at its starting position [rad]."""
        found, some = np.full(self.count, np.nan), np.flatnonzero(self.turns_back)
        first, width = self.standstills[0][some], self.back_step_crank_angle[some]
        found[some] = sweep.dwell_angle(first, width, self.drives.part(some))
        return found

    @cached_property
    def tolerance_dwell_angle(self) -> Reals:
        """Crank angle of the longest dwell within the tolerance [rad]; NaN without one."""
        tolerance, dwell = self.nominal.output_tolerance, self.nominal.tolerance_dwell
        if tolerance is None or dwell is None:
            return np.full(self.count, np.nan)
        places = (*self.standstills, self._least[1], self._greatest[1])
        found = sweep.longest_in_band(sweep.Valleys(self.drives, *places, np.full(self.count, tolerance)))
        self.unsettled |= found.doubtful
        return found.crank_angle

    def swing(self, start: float, length: float) -> Reals:
        """Half the range of the output over crank angles that are fixed in the machine [rad].

        Parameters
            start, length : float [rad] - of the window, from the nominal line A-D
        """
        ends = [start + share * length - self.frame_turn for share in (0.0, 1.0)]
        angles = [self.angle_at(end) for end in ends]
        for place in self.standstills if self.turns_back.any() else ():
            here = place - np.rint((place - start - 0.5 * length) / _TURN) * _TURN
            inside = self.turns_back & (here > ends[0]) & (here < ends[1])
            angles.append(np.where(inside, self.angle_at(here), angles[0]))
        swing: Reals = 0.5 * (np.max(angles, axis=0) - np.min(angles, axis=0))
        return swing

    # Closed forms

    @cached_property
    def min_transmission_angle(self) -> Reals:
        """Minimum transmission angle over the turn [rad]."""
        return least_transmission_angle(*self.lengths)

    @cached_property
    def gear_gap(self) -> Reals:
        """Minimum gap of the tips of gears 1 and 5 [mm]; NaN where they are not judged."""
        nominal, links, (crank, *_, frame) = self.nominal.gear_gap, self.nominal.linkage, self.lengths
        if nominal is None:
            return np.full(self.count, np.nan)
        return np.abs(frame - crank) + (nominal - abs(links.frame - links.crank))

    def distances(self) -> dict[str, tuple[Reals, Reals]]:
        """Minimum and maximum distance of the axes over the turn [mm], by their ends."""
        crank, coupler, rocker, frame = self.lengths
        # Of the triangle A-B-C or A-D-C the one whose angle at the middle joint turns fully.
        one, other = (coupler, crank) if self.nominal.linkage.kind() == "crank-rocker" else (rocker, frame)
        return {
            "AC": (np.abs(one - other), one + other),
            "AD": (frame, frame),
            "BD": (np.abs(frame - crank), frame + crank),
            "CD": (rocker, rocker),
        }
