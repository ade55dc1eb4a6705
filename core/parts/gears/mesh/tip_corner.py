"""The corner of a tip in the root of its mate: whether its path, outside the path of contact, cuts into a fillet.

In the frame of the gear with the fillet, its centre the origin, the x axis to the pitch point when contact is there,
the mating gear A turned by psi from where its corner stands deepest (signs of ISO 21771, s that of the gear's teeth):

    corner = s (a_w - r_aA exp(i psi)) exp(-i z_A (delta - psi)/z),  delta = inv(alpha_aA) - inv(alpha_wt)
    fillet at s beside - eta_b - inv(alpha_wt),  r^2 = (a_w - r_aA)^2 + 4 a_w r_aA sin^2(psi/2)

From the end of contact on, psi = alpha_wt - alpha_aA, to 0. Most corners never leave the tool: see `stays_in_tool`.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

from gearlink.core.base.results import cached_property
from gearlink.core.numerics.roots import maximum
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.tooth.teeth import GearFunctions

_STEPS = 12
"""Steps in which the gap is looked at first, shorter towards the flank."""
_OPEN = 0.01
"""Gap between two steps that a closer look does not close, in modules."""
_TURNS = 8
"""Turns of the mating gear in which a corner is looked for in the tool, nearer to each other at the end of contact."""
_LESS = 0.97
"""Of the tool's rounding, so that nothing between two revolutions matters."""


class CornerGap(NamedTuple):
    """How far a tip's corner keeps off the mating gear's fillet along the circle of some radius [mm]; negative in it.

    Of a rack: along the line in some depth.
    """

    gap: float
    place: float


class CornerPath(NamedTuple):
    """The way of a corner past a fillet, as the gap needs it; of many pairs each is an array."""

    fn: GearFunctions
    deepest: Any
    four_areas: Any
    turned: Any
    across: Any
    along: Any
    on: Any
    rolled: Any

    def squared(self, radius: Any) -> Any:
        """sin^2(psi/2) of the corner on a circle [mm]; negative where it does not come so deep."""
        return (radius - self.deepest) * (radius + self.deepest) / self.four_areas

    def gap(self, squared: Any, beside: Any) -> Any:
        """How far a point of the fillet, so far beside the middle of the space, stands from the corner [rad]."""
        half = self.fn.sqrt(squared)
        corner = self.fn.atan2(self.across * half * self.fn.sqrt(1.0 - squared), self.along + self.on * squared)
        return beside - self.turned - corner - self.rolled * self.fn.asin(half)


def near_of(module: float) -> float:
    """Gap between two places that a closer look does not close [mm]."""
    return _OPEN * module


def places_towards(start: Any, end: Any) -> list[Any]:
    """Places on a fillet from its root to the flank, in steps that shrink."""
    return [start + (end - start) * (1.0 - (1.0 - k / _STEPS) ** 2) for k in range(_STEPS + 1)]


def least_gap(gap: Callable[[float], float], places: list[float], near: float) -> tuple[float, float]:
    """The minimum gap and its place; a valley between places is gone through where its gap is below `near`.

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
    """The corner of the mating gear's tip beside the root fillet of a gear, where contact ends on the flank above it.

    Parameters
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

    @property
    def _mate(self) -> int:
        return 1 - self.gear

    @property
    def _form(self) -> Any:
        """r_Ff of the gear [mm]."""
        return self.pair.form_radius[self.gear]

    @cached_property
    def comes_near(self) -> Any:
        """Whether the corner comes deeper than the flank goes."""
        deepest = abs(self.pair.center_distance - self.pair.tip_radius[self._mate])
        return self.pair.signs[self.gear] * (deepest - abs(self._form)) < 0.0

    @cached_property
    def _rise(self) -> Any:
        """alpha_aA - alpha_wt, by which the mate turns from where its corner is deepest to the end of contact [rad]."""
        return self.pair.tip_pressure_angle[self._mate] - self.pair.working_pressure_angle

    @cached_property
    def path(self) -> CornerPath:
        """The way of the corner."""
        pair, fn, sign = self.pair, self.pair.fn, self.pair.signs[self.gear]
        a, tip, working = pair.center_distance, pair.tip_radius[self._mate], pair.working_pressure_angle
        z = pair.teeth[self.gear]
        ratio, sense = pair.teeth[self._mate] / z, -fn.copysign(2.0, self._rise)
        # eta_b = (pi/2 - 2 x tan(alpha_n))/z - inv(alpha_t), and how far all has turned when the corner is deepest
        half_space = (math.pi / 2.0 - 2.0 * pair.profile_shift[self.gear] * fn.tan(pair.pressure_angle)) / z
        half_space = half_space - fn.involute(pair.transverse_pressure_angle)
        return CornerPath(
            fn=fn,
            deepest=abs(a - tip),
            four_areas=4.0 * a * tip,
            turned=sign * (half_space + fn.involute(working) - fn.involute_rise(working, self._rise) * ratio),
            across=-sense * tip,
            along=sign * (a - tip),
            on=2.0 * sign * tip,
            rolled=sign * sense * ratio,
        )

    @property
    def stays_in_tool(self) -> Any:
        """Whether the corner of an external mate is inside the tool that cut the fillet, all the way; it cuts nothing.

        While the flanks touch at a point of the gear's involute, so far before the end of contact, the tool touched it
        there too, with its flank along the same tangent. From there the mate's corner lies inwards of the tangent, and
        beyond the end of the tool's straight flank, by

            d = rho_a (1 - cos t) - r_bA (t - sin t),  h = rho_a sin t - r_bA (1 - cos t) - tan(alpha_t) (g + r_bA t)

        t the turn of the mate to the end of contact, rho_a = r_bA tan(alpha_aA), g what the used flank keeps off its
        form circle on the line of action. The corner is in the tool beside the straight flank, h <= 0, or in the circle
        of the rounding, which touches the flank at its end. It may be in the tool at another time all the same.
        """
        pair, fn, mate = self.pair, self.pair.fn, self._mate
        tool, slope = pair.tool(self.gear), fn.tan(pair.transverse_pressure_angle)
        base, own, form = pair.base_radius[mate], pair.base_radius[self.gear], self._form
        flank_end = fn.sqrt(fn.greatest(0.0, (form - own) * (form + own)))
        spare = slope * (pair.interference_margin[mate] - flank_end)
        rho, rounding = base * fn.tan(pair.tip_pressure_angle[mate]), _LESS * pair.module * tool.rounding
        stays = spare >= 0.0
        for k in range(1, _TURNS + 1):
            turn = self._rise * (k / _TURNS) ** 2
            sine, lost = fn.sin(turn), 2.0 * fn.sin(0.5 * turn) ** 2
            inwards = rho * lost - base * (turn - sine)
            beyond = rho * sine - base * lost - spare - slope * base * turn
            inwards, beyond = self._in_normal_section(inwards, beyond)
            rounded = beyond * beyond <= inwards * (2.0 * rounding - inwards)
            stays = stays & (inwards >= 0.0) & ((beyond <= 0.0) | rounded)
        return stays

    def _in_normal_section(self, inwards: Any, beyond: Any) -> tuple[Any, Any]:
        """Lengths across and along the tool's flank, from the transverse section."""
        pair, fn = self.pair, self.pair.fn
        if isinstance(pair.helix_angle, float) and pair.helix_angle == 0.0:
            return inwards, beyond
        angle, normal = pair.transverse_pressure_angle, pair.pressure_angle
        across = fn.cos(pair.helix_angle) * (beyond * fn.sin(angle) + inwards * fn.cos(angle))
        down = beyond * fn.cos(angle) - inwards * fn.sin(angle)
        return across * fn.cos(normal) - down * fn.sin(normal), across * fn.sin(normal) + down * fn.cos(normal)

    @cached_property
    def _fillet(self) -> tuple[Callable[[Any], tuple[Any, Any]], Any, Any]:
        """Radius [mm] and angle beside the middle of the space [rad] of a fillet's point, and its parameter's range."""
        pair = self.pair
        if self.gear and pair.shaped is not None:
            shaped = pair.shaped

            def of_ring(turn: Any) -> tuple[Any, Any]:
                point = shaped.fillet(turn)
                return abs(point), pair.fn.phase(point)

            return of_ring, *shaped.turns
        root = pair.roots[self.gear]

        def of_gear(normal: Any) -> tuple[Any, Any]:
            radius, beside = root.polar(normal)
            return pair.module * radius, beside

        return of_gear, 0.0, root.end_normal

    def _gap(self, place: float) -> float:
        """Gap along the circle through a point of the fillet [mm]; infinite where no corner comes."""
        radius, beside = self._fillet[0](place)
        squared = self.path.squared(radius)
        gap: float = self.path.gap(squared, beside) * radius if squared >= 0.0 else math.inf
        return gap

    @cached_property
    def least(self) -> CornerGap:
        """The minimum gap; that of the flank's end at most, where the corner leaves it."""
        _, start, end = self._fillet
        gap, place = least_gap(self._gap, places_towards(start, end), near_of(self.pair.module))
        return CornerGap(gap, self._fillet[0](place)[0])

    @property
    def cut(self) -> CornerGap | None:
        """The minimum gap where it may be negative: of a corner that comes near and is not in the tool all the way."""
        if not self.comes_near or (not self.pair.internal and self.stays_in_tool):
            return None
        return self.least
