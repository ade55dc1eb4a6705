"""Motion of many three-gear drives that differ a little from one, and the places found near its own."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from gearlink.core.base.results import cached_property
from gearlink.core.machines.three_gear import motion
from gearlink.core.machines.three_gear.design import ThreeGearFourBar
from gearlink.core.numerics.arrays import Mask, Reals
from gearlink.core.parts.linkages.fourbar import position as fourbar
from gearlink.core.parts.linkages.fourbar.lengths import Lengths, Places, solve

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
