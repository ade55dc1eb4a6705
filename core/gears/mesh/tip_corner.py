"""The corner of a tip in the root of its mate: whether its path, outside the path of contact, cuts into a fillet.

In the frame of the gear with the fillet, its centre the origin, the x axis to the pitch point when contact is there,
the mate A turned by psi from where its corner stands deepest (signs of ISO 21771, s that of the gear's teeth):

    corner = s (a_w - r_aA exp(i psi)) exp(-i z_A (delta - psi)/z),  delta = inv(alpha_aA) - inv(alpha_wt)
    fillet at s beside - eta_b - inv(alpha_wt),  r^2 = (a_w - r_aA)^2 + 4 a_w r_aA sin^2(psi/2)

From the end of contact on, psi = alpha_wt - alpha_aA, to 0.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import reduce
from itertools import pairwise
from operator import or_
from typing import Any, NamedTuple

from gearlink.core.gears.mesh.pair import GearPair
from gearlink.core.numerics.roots import maximum
from gearlink.core.results import cached_property

_STEPS = 12
"""Steps in which the gap is looked at first, shorter towards the flank."""
_OPEN = 0.01
"""Gap between two steps that a closer look does not close, in modules."""


class CornerGap(NamedTuple):
    """How far a tip's corner keeps off the mate's fillet along the circle of some radius [mm]; negative in it.

    Of a rack: along the line in some depth.
    """

    gap: float
    place: float


def near_of(module: float) -> float:
    """Gap between two places that a closer look does not close [mm]."""
    return _OPEN * module


def places_towards(start: Any, end: Any) -> list[Any]:
    """Places on a fillet from its root to the flank, in steps that shrink."""
    return [start + (end - start) * (1.0 - (1.0 - k / _STEPS) ** 2) for k in range(_STEPS + 1)]


def least_gap(gap: Callable[[float], float], places: list[float], near: float) -> tuple[float, float]:
    """The least gap and its place; a valley between places is gone through where its gap is below `near`.

    Example
        >>> least_gap(lambda b: (b - 0.3) ** 2 - 0.01, places_towards(0.0, 1.0), 0.1)[0]
        -0.01
    """
    gaps = [gap(place) for place in places]
    found = min(zip(gaps, places, strict=True))
    for k in range(1, len(places) - 1):
        if gaps[k - 1] >= gaps[k] <= gaps[k + 1] and gaps[k] < near:
            place, raised = maximum(lambda at: -gap(at), places[k - 1], places[k + 1])
            found = min(found, (-raised, place))
    return found


@dataclass(frozen=True)
class TipCorner:
    """The corner of the mate's tip beside the root fillet of a gear, where contact ends on the flank above it.

    Parameters
        pair : GearPair - or many over arrays, which have `comes_near` and `may_cut` alone
        gear : int - 0 or 1, whose fillet; that of a ring needs its cutter
    Notes
        Both flanks touch, whatever the backlash. Compared with drawn teeth that are turned in mesh.
    Example
        >>> pair = GearPair(module=1.0, teeth=(32, 63), pressure_angle=math.radians(10.0), given_shift=(0.587, 0.427),
        ...                 tip="none")
        >>> least = TipCorner(pair, 0).least
        >>> round(least.gap, 6), round(least.place, 4)
        (-0.00878, 15.4182)

    Source
        own derivation from the law of gearing
    """

    pair: GearPair
    gear: int

    @cached_property
    def _deepest(self) -> Any:
        """Radius on which the corner crosses the line of centres [mm]."""
        return abs(self.pair.center_distance - self.pair.tip_radius[1 - self.gear])

    @property
    def comes_near(self) -> Any:
        """Whether the corner comes deeper than the flank goes."""
        form: Any = self.pair.form_radius[self.gear]
        return self.pair.signs[self.gear] * (self._deepest - abs(form)) < 0.0

    @cached_property
    def _beside(self) -> Callable[[Any, Any], Any]:
        """How far the fillet stands from the corner when that is on its circle [rad], as a function.

        Of the radius [mm] and the fillet's angle beside the middle of the space [rad].
        """
        pair, fn, sign = self.pair, self.pair.fn, self.pair.signs[self.gear]
        working, rise = (
            pair.working_pressure_angle,
            pair.tip_pressure_angle[1 - self.gear] - pair.working_pressure_angle,
        )
        a, tip, z = pair.center_distance, pair.tip_radius[1 - self.gear], pair.teeth[self.gear]
        ratio, four, sense = pair.teeth[1 - self.gear] / z, 4.0 * a * tip, -fn.copysign(2.0, rise)
        # eta_b = (pi/2 - 2 x tan(alpha_n))/z - inv(alpha_t), and how far the mate has turned when the corner is deepest
        half_space = (math.pi / 2.0 - 2.0 * pair.profile_shift[self.gear] * fn.tan(pair.pressure_angle)) / z
        half_space = half_space - fn.involute(pair.transverse_pressure_angle)
        turned = half_space + fn.involute(working) - fn.involute_rise(working, rise) * ratio

        def gap(radius: Any, beside: Any) -> Any:
            squared = (radius - self._deepest) * (radius + self._deepest) / four
            reached = squared >= 0.0
            psi = sense * fn.asin(fn.sqrt(fn.least(1.0, fn.where(reached, squared, 0.0))))
            corner = fn.atan2(-sign * tip * fn.sin(psi), sign * (a - tip * fn.cos(psi))) + ratio * psi
            return fn.where(reached, beside - sign * (turned + corner), math.inf)

        return gap

    @cached_property
    def _fillet(self) -> tuple[Callable[[Any], tuple[Any, Any]], Any, Any]:
        """Radius [mm] and angle beside the middle of the space [rad] of a fillet's point, and its parameter's range."""
        pair, fn = self.pair, self.pair.fn
        if self.gear and pair.shaped is not None:
            shaped = pair.shaped

            def of_ring(turn: Any) -> tuple[Any, Any]:
                point = shaped.fillet(turn)
                return abs(point), fn.phase(point)

            return of_ring, *shaped.turns
        root = pair.cut_root(self.gear)

        def of_gear(normal: Any) -> tuple[Any, Any]:
            point = root.fillet(normal)
            return pair.module * abs(point), fn.atan2(point.real, point.imag)

        return of_gear, 0.0, root.end_normal

    def _gap(self, place: Any) -> Any:
        """Gap along the circle through a point of the fillet [mm]; infinite where no corner comes."""
        radius, beside = self._fillet[0](place)
        return self._beside(radius, beside) * radius

    def _places(self) -> list[Any]:
        """Places on the fillet from the root circle to the flank."""
        _, start, end = self._fillet
        return places_towards(start, end)

    @cached_property
    def least(self) -> CornerGap:
        """The least gap; that of the flank's end at most, where the corner leaves it."""
        gap, place = least_gap(self._gap, self._places(), near_of(self.pair.module))
        return CornerGap(gap, self._fillet[0](place)[0])

    @property
    def may_cut(self) -> Any:
        """Of many pairs: where a closer look could find the corner in the fillet."""
        gaps = [self._gap(place) for place in self._places()]
        held = [near <= after for near, after in pairwise(gaps)]
        low = (held[k] & ~held[k - 1] & (gaps[k] < near_of(self.pair.module)) for k in range(1, _STEPS))
        return reduce(or_, low, gaps[0] < 0.0)
