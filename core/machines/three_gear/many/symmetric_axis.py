"""The syntheses of equal gears in closed form over arrays: a dwell angle, a back-step, a band of speed.

Mirrors `DwellSynthesis` (an angle phi13, a window or a tolerance alone), `BackStepSynthesis`, `VariableSpeedSynthesis`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import cached_property
from typing import Any

import numpy as np

from gearlink.core.base.design_axis import Findings
from gearlink.core.machines.three_gear.dwell_checks import back_step_judged, target_judged
from gearlink.core.machines.three_gear.many import symmetric as many
from gearlink.core.machines.three_gear.many.batch import Batch
from gearlink.core.machines.three_gear.many.general import wrapped
from gearlink.core.machines.three_gear.symmetric import family
from gearlink.core.machines.three_gear.symmetric.back_step import dwell_angle_limit, window_limit
from gearlink.core.machines.three_gear.synthesis.dwell import PLAIN_TOLERANCE
from gearlink.core.machines.three_gear.synthesis.dwell_task import MARGIN
from gearlink.core.numerics.arrays import Mask, Reals
from gearlink.core.numerics.elementary_sweep import ARRAYS
from gearlink.core.parts.linkages.checks import edge_judged
from gearlink.core.parts.linkages.fourbar.sweep import dead_point_distance

_SMALL, _STEEP = 1e-3, 1e-4


class Symmetric(Batch):
    """Designs of the family I = 1; a task gives h = phi12/2."""

    idlers_rise = True

    @property
    def possible(self) -> Mask:
        """Where equal gears meet the task."""
        raise NotImplementedError

    @property
    def impossible(self) -> Any:
        """Place among the reasons of a task that cannot be met."""
        return 1

    @property
    def h(self) -> Reals:
        """Half of phi12 [rad]; NaN where the output has no standstill."""
        raise NotImplementedError

    @property
    def wrong_with_every_idler(self) -> Mask:
        """Unequal gears."""
        return np.asarray(self.z1 != self.z5)

    @cached_property
    def i3(self) -> Reals:
        """Ratio of idler and output gear."""
        return -self.z3 / self.z5

    @cached_property
    def n(self) -> Reals:
        """1 - i3."""
        return 1.0 - self.i3

    @cached_property
    def reason(self) -> Any:
        """Unequal gears, then an impossible task."""
        return np.where(self.z1 != self.z5, 1, np.where(self.possible, 0, 1 + self.impossible))

    @cached_property
    def frame_ratio(self) -> Reals:
        """d."""
        found: Reals = family.frame_ratio(self.i3, self.h, ARRAYS)
        return found

    @cached_property
    def links(self) -> tuple[Reals, Reals]:
        """From the frame ratio (thesis (4-10))."""
        crank = family.crank_length(self.frame_ratio, self.coupler, ARRAYS)
        return crank, self.frame_ratio * crank

    @cached_property
    def speeds(self) -> tuple[Reals, Reals]:
        """In closed form (thesis (4-13))."""
        return family.speed_ratio_limits(self.i3, self.frame_ratio)

    @cached_property
    def places_of_speeds(self) -> tuple[Reals, Reals]:
        """At 90 and 270 deg."""
        quarter = np.full(self.count, 0.5 * math.pi * self.spec.assembly)
        return quarter, quarter + math.pi

    @cached_property
    def mu(self) -> Reals:
        """The triangle BCD is isosceles: half of gamma has the sine of half of BD over b."""
        (crank, frame), b = self.links, self.coupler
        at = [2.0 * np.arctan2(x, np.sqrt((2.0 * b - x) * (2.0 * b + x))) for x in (frame - crank, frame + crank)]
        return np.asarray(np.minimum(*map(dead_point_distance, at)))

    @cached_property
    def _steps_back(self) -> Mask:
        return np.asarray(self.h > 0.0)

    @cached_property
    def standstills(self) -> tuple[Reals, Reals]:
        """phi12/2 on either side of the least speed."""
        middle = 1.5 * math.pi if self.spec.assembly == 1 else 0.5 * math.pi
        first = np.where(np.isfinite(self.h), middle - self.h, np.nan)
        return first, np.where(self._steps_back, middle + self.h, np.nan)

    @cached_property
    def back_step(self) -> tuple[Reals, Reals]:
        """In closed form (thesis (4-19))."""
        size = np.where(self._steps_back, many.back_step(self.n, self.h), np.nan)
        return size, np.where(self._steps_back, 2.0 * self.h, np.nan)

    @cached_property
    def dwell_angle(self) -> Reals:
        """From its equation."""
        angle, places = np.full(self.count, np.nan), np.flatnonzero(self._steps_back)
        if places.size:
            angle[places] = many.dwell_angle(self.n[places], self.h[places])
        return angle

    @cached_property
    def doubtful(self) -> Mask:
        """Where the root for h hangs by few digits."""
        return np.asarray((self.h > 0.0) & ((self.h < _SMALL) | (self.h > 0.5 * math.pi - _STEEP)))

    @property
    def links_are_doubtful(self) -> Mask:
        """The same: links and motion hang by h."""
        return self.doubtful


class Dwells(Symmetric):
    """`synth dwell` with an angle."""

    keys = ("dwell.angle",)
    reasons = ("gears.output", "dwell.angle")

    @cached_property
    def _asked(self) -> Reals:
        return np.radians(self.key("dwell.angle"))

    @cached_property
    def possible(self) -> Mask:
        """Below the limit of the gears."""
        return many.in_range(self._asked, 0.0, dwell_angle_limit(self.i3))

    @cached_property
    def h(self) -> Reals:
        """From phi13."""
        h, good = np.full(self.count, np.nan), self.exists
        h[good] = many.half_angle_for_dwell(self.n[good], self._asked[good])
        return h

    @cached_property
    def dwell_angle(self) -> Reals:
        """As asked for."""
        return np.where(self.exists, self._asked, np.nan)

    @cached_property
    def tolerance(self) -> Reals:
        """As given, or half of the back-step."""
        return np.where(np.isnan(self.given_tolerance), 0.5 * self.back_step[0], self.given_tolerance)

    @cached_property
    def band(self) -> tuple[Reals, Reals]:
        """In closed form where the back-step fills the band."""
        start, width = super().band
        fills = np.isnan(self.given_tolerance)
        before = self.standstills[0] - (self.dwell_angle - self.back_step[1])
        length = 2.0 * self.dwell_angle - self.back_step[1]
        return np.where(fills, wrapped(before), start), np.where(fills, length, width)

    def of_task(self) -> Iterator[Findings]:
        """GL315: half of the back-step."""
        half = np.degrees(0.5 * self.back_step[0])
        limit = np.where(np.isnan(self.given_tolerance), PLAIN_TOLERANCE, np.degrees(self.given_tolerance))
        yield back_step_judged(half, limit).of(self.count)


class Windows(Symmetric):
    """`synth dwell` with a window or a tolerance; what asks for both is the class's."""

    keys = ("dwell.window", "dwell.tolerance", "dwell.margin")
    chooses_idler = False

    @property
    def reasons(self) -> tuple[str, ...]:  # type: ignore[override]
        """The key that asks for the dwell is the one at fault."""
        return "gears.output", "dwell.window" if self._by_window else "dwell.tolerance"

    @cached_property
    def _by_window(self) -> bool:
        return bool(np.isfinite(self.key("dwell.window")).any())

    @cached_property
    def _window(self) -> Reals:
        return np.radians(self.key("dwell.window"))

    @cached_property
    def given_tolerance(self) -> Reals:
        """That of the dwell."""
        return np.radians(self.key("dwell.tolerance"))

    @cached_property
    def _back_step_sought(self) -> Reals:
        """Twice the tolerance less the margin."""
        margin = self.key("dwell.margin")
        return 2.0 * (self.given_tolerance * (1.0 - np.where(np.isnan(margin), MARGIN, margin)))

    @cached_property
    def possible(self) -> Mask:
        """Windows and tolerances that the gears reach."""
        if self._by_window:
            return many.in_range(self._window, 0.0, window_limit(self.i3))
        most = np.minimum(math.pi, 0.5 * (self.z3 / self.z5) * math.pi)
        return many.in_range(self.given_tolerance, 0.0, most) & (self._back_step_sought > 0.0)

    @cached_property
    def h(self) -> Reals:
        """From the window, or from the back-step that fills the band but for the margin."""
        h, good = np.full(self.count, np.nan), self.exists
        found = many.half_angle_for_window if self._by_window else many.half_angle_for_back_step
        h[good] = found(self.n[good], (self._window if self._by_window else self._back_step_sought)[good])
        return h

    @cached_property
    def tolerance(self) -> Reals:
        """As given, or half of the back-step."""
        return np.where(np.isnan(self.given_tolerance), 0.5 * self.back_step[0], self.given_tolerance)

    @cached_property
    def band(self) -> tuple[Reals, Reals]:
        """In closed form where the back-step fills the band."""
        if not self._by_window:
            return super().band
        before = self.standstills[0] - (self.dwell_angle - self.back_step[1])
        return wrapped(before), 2.0 * self.dwell_angle - self.back_step[1]

    @cached_property
    def _longest(self) -> Reals:
        """The longest window that the tolerance leaves to the gears."""
        longest, good = np.full(self.count, np.nan), self.exists
        if good.any():
            h = many.half_angle_for_back_step(self.n[good], 2.0 * self.given_tolerance[good])
            longest[good] = many.longest_window(self.n[good], h)
        return longest

    @property
    def plain(self) -> dict[str, Callable[[], Any]]:
        """With what a window has."""
        own = {"dwell_tolerance": lambda: np.degrees(0.5 * self.back_step[0])}
        if not self._by_window:
            own["window_limit"] = lambda: np.degrees(self._longest)
        return {**super().plain, **own}

    def of_task(self) -> Iterator[Findings]:
        """GL314: the back-step's share of the band."""
        share = 0.5 * self.back_step[0] / self.given_tolerance
        yield edge_judged(share).of(self.count)


class BackSteps(Symmetric):
    """`synth back-step`."""

    keys = ("back_step.angle", "back_step.crank_angle")
    reasons = ("gears.output", "back_step.angle")

    @cached_property
    def _asked(self) -> Reals:
        return np.radians(self.key("back_step.angle"))

    @cached_property
    def _given(self) -> Reals:
        return np.radians(self.key("back_step.crank_angle")) / 2.0

    @cached_property
    def possible(self) -> Mask:
        """A crank angle always is; a back-step below the limit of the gears."""
        return np.isfinite(self._given) | many.in_range(self._asked, 0.0, math.pi * (self.n - 1.0))

    @cached_property
    def h(self) -> Reals:
        """As given, or from the back-step."""
        h = np.where(self.exists, self._given, np.nan)
        sought = np.flatnonzero(self.exists & np.isnan(self._given))
        if sought.size:
            h[sought] = many.half_angle_for_back_step(self.n[sought], self._asked[sought])
        return h

    def of_task(self) -> Iterator[Findings]:
        """GL304: the back-step that was asked for."""
        asked, got = self.key("back_step.angle"), np.degrees(np.where(self.h == 0.0, 0.0, self.back_step[0]))
        value = np.where(np.isnan(asked), np.nan, got)
        yield target_judged(value, asked).of(self.count)


class Speeds(Symmetric):
    """`synth variable-speed`."""

    keys = ("speed.min", "speed.max")
    reasons = ("gears.output", "speed.max", "speed.min")

    @cached_property
    def possible(self) -> Mask:
        """A band that does not reach below zero."""
        low, high = self.key("speed.min"), self.key("speed.max")
        return np.asarray((low >= 0.0) & (low < high))

    @property
    def wrong_with_every_idler(self) -> Mask:
        """A wrong band too."""
        return np.asarray((self.z1 != self.z5) | ~self.possible)

    @property
    def impossible(self) -> Any:
        """The key at fault."""
        return np.where(self.key("speed.max") <= self.key("speed.min"), 1, 2)

    @cached_property
    def h(self) -> Reals:
        """0 where the output just stops."""
        return np.where(self.exists & (self.key("speed.min") == 0.0), 0.0, np.nan)

    @cached_property
    def frame_ratio(self) -> Reals:
        """From the band."""
        d = family.frame_ratio_between(self.i3, self.key("speed.min"), self.key("speed.max"), ARRAYS)
        return np.where(self.exists, d, np.nan)
