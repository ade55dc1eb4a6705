"""Three-gear four-bars whose parts are as made, not as designed: one at a time, and many near one at once.

The teeth keep the ratio of the gears, so coupler and rocker may differ a little from the centre distances; standstills
of one drive are those of `gearlink.core.machines.three_gear.dwell.ByRoots`.

Of many drives every place of the turn (standstill, extreme, end of a dwell) is found by Newton steps from the nominal
drive's place. Where they do not come to rest at the right kind of place the element is not settled, and
`TolerancedDrive` computes it alone.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.base.design import placed
from gearlink.core.base.errors import at_key
from gearlink.core.base.results import cached_property
from gearlink.core.machines.three_gear import motion
from gearlink.core.machines.three_gear.design import ThreeGearFourBar
from gearlink.core.machines.three_gear.dwell import STANDSTILL_TOLERANCE, ByRoots
from gearlink.core.numerics.arrays import Mask, Reals
from gearlink.core.parts.linkages.checks import check_linkage
from gearlink.core.parts.linkages.fourbar import position as fourbar
from gearlink.core.parts.linkages.fourbar.lengths import Lengths, Places, least_transmission_angle, solve
from gearlink.core.parts.linkages.fourbar.position import FourBar

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

    @cached_property
    def output(self) -> ByRoots:
        """Standstills as roots: the links as made are in no proportion to the teeth."""
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


STEPS = 12
REST = 3e-8  # of a step [rad]: the next one, its square, is below rounding
_BENT_REST = 1e-15  # what a bent step leaves: the error before it, times its square over the root's curvature
_BENT_STEP = 1e-5  # [rad] its cube, by which an angle beside the place is wrong, is below rounding
_MOST_BENT = 0.3


@dataclass(frozen=True, slots=True)
class Branch:
    """How far a link has turned since the crank angle 0 [rad], and its direction there, reversed."""

    turned: float
    back: complex


@dataclass(frozen=True, slots=True)
class Seen:
    """What is known at crank angles: the loop, and as many rates of the output as were asked for."""

    phi: Reals
    places: Places
    rates: tuple[Reals, ...]


@dataclass(frozen=True, slots=True)
class Stop:
    """Where Newton steps came to rest: the place, what was last seen, and the step from there to the place."""

    place: Reals
    seen: Seen
    step: Reals


class NearDrives:
    """Drives near a nominal one.

    Parameters
        nominal : ThreeGearFourBar
        links : Lengths - (N,) arrays
        frame_turn : (N,) array [rad] - by how much the line A-D is turned: crank angles count from the nominal line
    """

    def __init__(self, nominal: ThreeGearFourBar, links: Lengths, frame_turn: Reals | float = 0.0) -> None:
        self.nominal, self.links, self.frame_turn = nominal, links, frame_turn
        self.train = motion.forward(nominal.linkage, nominal.train)
        self.counted = nominal.train.sense * self.train.sense  # -1 where the file counts the output backward
        self.count = np.broadcast(links.crank, links.coupler, links.rocker, links.frame, frame_turn).size
        self.unsettled: Mask = np.zeros(self.count, dtype=bool)
        self._branches: dict[float, tuple[Branch, Branch]] = {}

    @cached_property
    def extremes(self) -> motion.Extremes:
        """Extremes of the nominal drive's speed, the output counted in the direction of its mean motion."""
        found = self.nominal.speed_extremes
        if self.counted > 0:
            return found
        return motion.Extremes(-found.least, found.least_angle, -found.greatest, found.greatest_angle)

    def seen(self, phi: Reals, order: int) -> Seen:
        """The output's rates at crank angles, as many as asked for."""
        places = solve(self.links, phi, order)
        p, q = self.train.coupler_share, self.train.rocker_share
        pairs = (
            (places.coupler_velocity, places.rocker_velocity),
            (places.coupler_acceleration, places.rocker_acceleration),
            (places.coupler_jerk, places.rocker_jerk),
        )
        rates = [p * two + q * three for two, three in pairs[:order]]
        if rates:
            rates[0] += self.train.ratio
        return Seen(phi, places, tuple(rates))

    def rates(self, phi: Reals, order: int) -> tuple[Reals, ...]:
        """Speed, acceleration and jerk ratio of the output, as many as asked for."""
        return self.seen(phi, order).rates

    def angle(self, seen: Seen, near: float) -> Reals:
        """Output angle [rad] on the branch of the nominal drive at the crank angle `near`."""
        coupler, rocker = self._branch(near)
        found = seen.places
        second = coupler.turned + np.angle(found.coupler * coupler.back)
        third = rocker.turned + np.angle(found.rocker * rocker.back)
        turned: Reals = (
            self.train.ratio * seen.phi + self.train.coupler_share * second + self.train.rocker_share * third
        )
        return turned

    def angle_of(self, stop: Stop, near: float) -> Reals:
        """Output angle at a place, from what was seen a step beside it."""
        speed, acceleration = stop.seen.rates
        angle: Reals = self.angle(stop.seen, near) - (speed - 0.5 * acceleration * stop.step) * stop.step
        return angle

    def angle_at(self, phi: Reals, near: float) -> Reals:
        """Output angle at crank angles."""
        return self.angle(self.seen(phi, 0), near)

    def _branch(self, near: float) -> tuple[Branch, Branch]:
        """Coupler and rocker of the nominal drive at a crank angle."""
        found = self._branches.get(near)
        if found is None:
            at, start = fourbar.solve(self.nominal.linkage, near), fourbar.solve(self.nominal.linkage, 0.0)
            found = (
                Branch(at.coupler_angle - start.coupler_angle, cmath.exp(-1j * at.coupler_angle)),
                Branch(at.rocker_angle - start.rocker_angle, cmath.exp(-1j * at.rocker_angle)),
            )
            self._branches[near] = found
        return found

    def rooted(self, wanted: Callable[[Seen], tuple[Reals, Reals]], order: int, start: Reals | float) -> Stop:
        """Newton steps to rest, bent by how the slope changed between the two latest places.

        Elements that do not rest are not settled; those whose request is zero stay where they are.
        """
        place = np.broadcast_to(np.asarray(start, dtype=float), (self.count,))
        rests: Mask = np.zeros(self.count, dtype=bool)
        moved = last = np.full(self.count, math.nan)
        with np.errstate(all="ignore"):
            for _ in range(STEPS):
                seen = self.seen(place, order)
                value, slope = wanted(seen)
                change = value / slope
                rests = np.abs(change) <= REST
                # As a step begins, the root's curvature is the change of slope over the step before.
                bent = 0.5 * change * (last - slope) / (moved * slope)
                usable = np.abs(bent) < _MOST_BENT
                rests |= (
                    usable
                    & (np.abs(change) <= _BENT_STEP)
                    & (np.abs(moved) * (2.0 * np.abs(bent) + np.abs(change)) ** 2 <= _BENT_REST)
                )
                change = np.where(usable, change * (1.0 + bent), change)
                place = place - change
                moved, last = change, slope
                if (rests | np.isnan(change)).all():
                    break
        self.unsettled |= ~rests
        return Stop(place, seen, change)

    def chord(self, wanted: Callable[[Seen], Reals], order: int, start: float, rest: float) -> Stop:
        """Steps to rest that the request gives itself; elements that do not rest are not settled."""
        place, step = np.full(self.count, start), np.full(self.count, math.inf)
        with np.errstate(all="ignore"):
            for _ in range(STEPS):
                seen = self.seen(place, order)
                step = wanted(seen)
                place = place - step
                if np.nanmax(np.abs(step), initial=0.0) <= rest:
                    break
        self.unsettled |= ~(np.abs(step) <= rest)
        return Stop(place, seen, step)


_NEAR_EXTREME = 3e-5  # of a step [rad]: a value at an extreme is wrong by the square of the place's error
_CHORD_REST = 3e-7  # of a step whose slope is the nominal drive's


@dataclass(frozen=True, slots=True)
class Extreme:
    """An extreme of the speed: its place [rad], the speed and jerk ratio there, the loop beside it."""

    place: Reals
    speed: Reals
    jerk: Reals
    places: Places


class DriveSamples(NearDrives):
    """What a study asks of many drives near a nominal one."""

    # Extremes

    def _extreme(self, place: float, sign: float) -> Extreme:
        """The extreme of the speed near the nominal one; sign +1 for the greatest."""
        found = self.chord(lambda seen: seen.rates[1] / seen.rates[2], 3, place, _NEAR_EXTREME)
        speed, acceleration, jerk = found.seen.rates
        self.unsettled |= ~(jerk * sign < 0.0) | ~(np.abs(found.place - place) < 0.5)
        return Extreme(found.place, speed - 0.5 * acceleration * found.step, jerk, found.seen.places)

    @cached_property
    def _least(self) -> Extreme:
        return self._extreme(self.extremes.least_angle, -1.0)

    @cached_property
    def _greatest(self) -> Extreme:
        return self._extreme(self.extremes.greatest_angle, 1.0)

    @property
    def speed_ratio_min(self) -> Reals:
        """Least speed ratio."""
        return self._least.speed if self.counted > 0 else -self._greatest.speed

    @property
    def speed_ratio_max(self) -> Reals:
        """Greatest speed ratio."""
        return self._greatest.speed if self.counted > 0 else -self._least.speed

    def _acceleration_extreme(self, place: float) -> Reals:
        h = 1e-4
        slope = float(np.diff(self._nominal_jerk(np.array([place - h, place + h])))[0] / (2.0 * h))
        found = self.chord(lambda seen: seen.rates[2] / slope, 3, place, _CHORD_REST)
        self.unsettled |= ~(np.abs(found.place - place) < 0.5)
        _, acceleration, jerk = found.seen.rates
        value: Reals = self.counted * (acceleration - 0.5 * jerk * found.step)
        return value

    def _nominal_jerk(self, phi: Reals) -> Reals:
        links = self.nominal.linkage
        a, b, c, d = (np.array([x]) for x in (links.crank, links.coupler, links.rocker, links.frame))
        lengths = Lengths(a, b, c, d, links.assembly)
        places = solve(lengths, phi, 3)
        jerk: Reals = self.train.coupler_share * places.coupler_jerk + self.train.rocker_share * places.rocker_jerk
        return jerk

    @cached_property
    def acceleration_ratio_max(self) -> Reals:
        """Greatest acceleration ratio [1/rad]."""
        return self._acceleration_extreme(self.nominal.acceleration_extremes.greatest_angle)

    @cached_property
    def acceleration_ratio_min(self) -> Reals:
        """Least acceleration ratio [1/rad]."""
        return self._acceleration_extreme(self.nominal.acceleration_extremes.least_angle)

    @cached_property
    def nonuniformity(self) -> Reals:
        """(max - min)/mean of the speed ratio."""
        return (self.speed_ratio_max - self.speed_ratio_min) / abs(self.nominal.mean_ratio)

    # Back-step

    @cached_property
    def turns_back(self) -> Mask:
        """Where the output turns back."""
        least, train = self._least, self.train
        terms = abs(train.ratio) + np.abs(train.coupler_share * least.places.coupler_velocity)
        terms += np.abs(train.rocker_share * least.places.rocker_velocity)
        return np.asarray(least.speed < -STANDSTILL_TOLERANCE * terms)

    @cached_property
    def _stops(self) -> tuple[Stop, Stop]:
        """The standstills; of a drive without them the least speed's place twice."""
        least, back = self._least.place, self.turns_back
        guesses = self._guesses(least, back)
        ends = []
        for guess, sign in zip(guesses, (-1.0, 1.0), strict=True):
            found = self.rooted(lambda seen: (np.where(back, seen.rates[0], 0.0), seen.rates[1]), 2, guess)
            self.unsettled |= back & ~(found.seen.rates[1] * sign > 0.0)
            ends.append(found)
        return ends[0], ends[1]

    def _guesses(self, least: Reals, back: Mask) -> tuple[Reals, Reals]:
        """Near a momentary dwell the roots of the parabola, else the nominal places."""
        step, spread = self.nominal.back_step, np.zeros(self.count)
        with np.errstate(invalid="ignore"):
            deep = np.maximum(-2.0 * self._least.speed, 0.0)
            spread = np.where(back, np.sqrt(deep / self._least.jerk), 0.0)
        if step is None:
            return least - spread, least + spread
        near = self.extremes.least_angle
        start = near - (near - step.start) % _TURN
        short = spread < 0.5 * step.crank_angle
        return np.where(short, least - spread, start), np.where(short, least + spread, start + step.crank_angle)

    @property
    def standstills(self) -> tuple[Reals, Reals]:
        """Start and end of the back-step [rad], against the line A-D; without one the least speed's place twice."""
        first, second = self._stops
        return first.place, second.place

    @property
    def _near(self) -> float:
        """The crank angle whose branch the output angles of the dwell are counted on."""
        return float(self.extremes.least_angle)

    @cached_property
    def _top_and_bottom(self) -> tuple[Reals, Reals]:
        first, second = (self.angle_of(stop, self._near) for stop in self._stops)
        return first, second

    @cached_property
    def back_step_angle(self) -> Reals:
        """How far the output turns back [rad]; NaN where it does not."""
        top, bottom = self._top_and_bottom
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
    def regained(self) -> Reals:
        """Where the output is back at its place [rad], against the line A-D."""
        first, second = self.standstills
        top, _ = self._top_and_bottom
        back, width = self.turns_back, second - first
        nominal = self.nominal.dwell_angle
        guess = second + 0.6 * width
        if nominal is not None and self.nominal.back_step is not None:
            further = nominal - self.nominal.back_step.crank_angle
            guess = np.where(width < 0.5 * self.nominal.back_step.crank_angle, guess, second + further)
        there = guess[np.isfinite(guess)]
        found = self._level(top, guess, float(there[0]) if there.size else self._near, back)
        self.unsettled |= back & ~(found > second)
        return found

    @cached_property
    def dwell_angle(self) -> Reals:
        """Crank angle until the output regains its place [rad]."""
        return np.where(self.turns_back, self.regained - self.standstills[0], np.nan)

    # Dwell within a tolerance

    def _level(self, level: Reals, guess: Reals, near: float, where: Mask) -> Reals:
        """Crank angle near the guess at which the output is at a level."""

        def above(seen: Seen) -> tuple[Reals, Reals]:
            return np.where(where, self.angle(seen, near) - level, 0.0), seen.rates[0]

        return self.rooted(above, 1, np.where(where, guess, near)).place

    @cached_property
    def tolerance_dwell(self) -> tuple[Reals, Reals]:
        """Start, against the line A-D, and length [rad] of the longest dwell within the tolerance; NaN without one.

        Source
            `gearlink.core.parts.linkages.band_dwell`, many at once
        """
        tolerance, dwell = self.nominal.output_tolerance, self.nominal.tolerance_dwell
        if tolerance is None or dwell is None:
            return np.full(self.count, np.nan), np.full(self.count, np.nan)
        top, bottom = self._top_and_bottom
        drop = np.where(self.turns_back, top - bottom, 0.0)
        fits: Mask = drop <= 2.0 * tolerance * (1.0 + 1e-13)
        left, right = self._around_both(tolerance, drop, fits)
        if not fits.all():
            beside = self._around_one(tolerance, ~fits)
            left, right = np.where(fits, left, beside[0]), np.where(fits, right, beside[1])
        return left, right - left

    def _around_both(self, tolerance: float, drop: Reals, fits: Mask) -> tuple[Reals, Reals]:
        """Both ends of the dwell that holds the whole back-step."""
        first, second = self.standstills
        near, (top, bottom) = self._near, self._top_and_bottom
        bottom, spare = np.where(self.turns_back, bottom, top), 2.0 * tolerance - drop
        start, length = self._nominal_ends
        beyond = 0.5 * (second - first)
        left, right = np.minimum(start, first - beyond), np.maximum(start + length, second + beyond)
        left, right = self._equal_speeds(tolerance, left, right, fits)
        raised = bottom - self.angle_at(left, near)
        good = fits & (left <= first) & (right >= second) & (raised >= 0.0) & (raised <= spare) & (right - left < _TURN)
        rest = fits & ~good
        if rest.any():
            ends = self._at_an_end(rest, bottom, spare, start, start + length)
            left, right = np.where(rest, ends[0], left), np.where(rest, ends[1], right)
        return left, right

    @cached_property
    def _nominal_ends(self) -> tuple[float, float]:
        """Start and length of the nominal dwell, on the branch of the least speed's place."""
        dwell = self.nominal.tolerance_dwell
        assert dwell is not None
        return self._near - (self._near - dwell.start) % _TURN, dwell.crank_angle

    def _equal_speeds(self, tolerance: float, left: Reals, right: Reals, where: Mask) -> tuple[Reals, Reals]:
        """phi5(R) - phi5(L) = 2 tol and W(L) = W(R), by Newton steps in both ends."""
        near = self._near
        with np.errstate(all="ignore"):
            for _ in range(STEPS):
                at_left, at_right = self.seen(left, 2), self.seen(right, 2)
                (speed_l, slope_l), (speed_r, slope_r) = at_left.rates, at_right.rates
                gain = self.angle(at_right, near) - self.angle(at_left, near) - 2.0 * tolerance
                unequal = speed_r - speed_l
                scale = speed_r * slope_l - speed_l * slope_r
                move_l = (unequal * speed_r - gain * slope_r) / scale
                move_r = (unequal * speed_l - gain * slope_l) / scale
                left, right = left + move_l, right + move_r
                moved = np.where(where, np.abs(move_l) + np.abs(move_r), 0.0)
                if np.nanmax(moved, initial=0.0) <= REST:
                    break
        return left, right

    def _at_an_end(self, where: Mask, bottom: Reals, spare: Reals, left: float, right: float) -> tuple[Reals, Reals]:
        """Ends of the dwell where a standstill binds: the output rises from L not at all, or by all there is."""
        first, second = self.standstills
        near, found = self._near, []
        beyond = 0.5 * (second - first)  # as a cubic has it
        guess_l, guess_r = np.minimum(left, first - beyond), np.maximum(right, second + beyond)
        for rise in (np.zeros(self.count), spare):
            ends = (
                self._level(bottom - rise, guess_l, near, where),
                self._level(bottom + 2.0 * float(self.nominal.output_tolerance or 0.0) - rise, guess_r, near, where),
            )
            found.append((*ends, self.rates(ends[1], 1)[0] - self.rates(ends[0], 1)[0]))
        (low_l, low_r, low_gain), (high_l, high_r, high_gain) = found
        self.unsettled |= where & (low_gain > 0.0) & (high_gain < 0.0)
        self.unsettled |= where & ~((low_l <= first) & (low_r >= second))
        low = low_gain <= 0.0
        return np.where(low, low_l, high_l), np.where(low, low_r, high_r)

    def _around_one(self, tolerance: float, where: Mask) -> tuple[Reals, Reals]:
        """Ends of the longer of the two dwells beside one standstill, where the back-step leaves the band."""
        best_l = best_r = np.zeros(self.count)
        for place, level, sign in zip(self.standstills, self._top_and_bottom, (-1.0, 1.0), strict=True):
            with np.errstate(all="ignore"):
                spread = np.sqrt(4.0 * tolerance / np.abs(self.rates(place, 2)[1]))
            ends = [
                self._level(level + sign * 2.0 * tolerance, place + side * spread, self._near, where)
                for side in (-1.0, 1.0)
            ]
            self.unsettled |= where & ~((ends[0] < place) & (ends[1] > place))
            longer = ends[1] - ends[0] > best_r - best_l
            best_l, best_r = np.where(longer, ends[0], best_l), np.where(longer, ends[1], best_r)
        return best_l, best_r

    @property
    def tolerance_dwell_angle(self) -> Reals:
        """Crank angle of the dwell within the tolerance [rad]."""
        return self.tolerance_dwell[1]

    # Dwell over a fixed window

    def swing(self, start: float, length: float) -> Reals:
        """Half the range of the output over crank angles that are fixed in the machine [rad].

        Parameters
            start, length : float [rad] - of the window, from the nominal line A-D
        """
        near = start + 0.5 * length
        ends = [np.broadcast_to(start + share * length - self.frame_turn, (self.count,)) for share in (0.0, 1.0)]
        angles = [self.angle_at(end, near) for end in ends]
        for stop in self._stops if self.turns_back.any() else ():
            turns = np.rint((stop.place - near) / _TURN)
            inside = self.turns_back & (stop.place - turns * _TURN > ends[0]) & (stop.place - turns * _TURN < ends[1])
            angle = self.angle_of(stop, self._near) - turns * _TURN * abs(self.nominal.mean_ratio)
            angles.append(np.where(inside, angle, angles[0]))
        swing: Reals = 0.5 * (np.max(angles, axis=0) - np.min(angles, axis=0))
        return swing

    # Closed forms

    @cached_property
    def min_transmission_angle(self) -> Reals:
        """Least transmission angle over the turn [rad]."""
        links = self.links
        return least_transmission_angle(links.crank, links.coupler, links.rocker, links.frame)

    @cached_property
    def gear_gap(self) -> Reals:
        """Least gap of the tips of gears 1 and 5 [mm]; NaN where they are not judged."""
        nominal, links = self.nominal.gear_gap, self.nominal.linkage
        if nominal is None:
            return np.full(self.count, np.nan)
        return np.abs(self.links.frame - self.links.crank) + (nominal - abs(links.frame - links.crank))

    def distances(self) -> dict[str, tuple[Reals, Reals]]:
        """Least and greatest distance of the axes over the turn [mm], by their ends."""
        links, turning = self.links, self.nominal.linkage.kind()
        # Of the triangle A-B-C or A-D-C the one whose angle at the middle joint turns fully.
        one, other = (links.coupler, links.crank) if turning == "crank-rocker" else (links.rocker, links.frame)
        return {
            "AC": (np.abs(one - other), one + other),
            "AD": (links.frame, links.frame),
            "BD": (np.abs(links.frame - links.crank), links.frame + links.crank),
            "CD": (links.rocker, links.rocker),
        }
