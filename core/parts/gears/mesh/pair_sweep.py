"""Many external gear pairs at once: `GearPair` over arrays of its parameters.

Every formula is that of the class of one pair, with the functions of `functions_sweep`. What one pair refuses is NaN
here, and so is what it lacks.

Many pinions in rings at once: `GearPairs` with gear 2 a ring, and their interferences.

Corners of tips in the roots of their mates, of many pairs at once.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace
from typing import Any, ClassVar

import numpy as np

from gearlink.core.base.results import cached_property
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.roots_sweep import bracketed_roots
from gearlink.core.parts.gears.mesh.contact import PathOfContact
from gearlink.core.parts.gears.mesh.pair import GearPair, bound_of_shift_sum, least_distance
from gearlink.core.parts.gears.mesh.pitch_pair import PitchPair
from gearlink.core.parts.gears.mesh.ring_cutter import InternalInterference, ShapedRing
from gearlink.core.parts.gears.mesh.tip_corner import TipCorner, near_of, places_towards
from gearlink.core.parts.gears.tooth import teeth
from gearlink.core.parts.gears.tooth.functions import GearFunctions
from gearlink.core.parts.gears.tooth.functions_sweep import ARRAYS
from gearlink.core.parts.gears.tooth.root_fillet import REACH, RackCutRoot
from gearlink.core.parts.gears.tooth.tools import RackTool, standard_tool

_NO_DISTANCE = 1e-9
_BARELY = 1e-6


@dataclass(frozen=True, kw_only=True)
class GearPairs(GearPair):
    """External pairs by centre distance or shifts; parameters are arrays or numbers.

    Notes
        Agrees with `GearPair` to a few ulp times the condition number that it names.
    Example
        >>> pairs = GearPairs(module=2.0, teeth=(np.array([20.0, 40.0]), 72.0), given_shift=(0.1, 0.0))
        >>> pairs.contact_ratio.round(6).tolist()
        [1.649966, 1.738995]
    """

    fn: ClassVar[GearFunctions] = ARRAYS

    def __post_init__(self) -> None:
        """Nothing is refused; `exist` tells."""

    @cached_property
    def exist(self) -> Any:
        """Where teeth and distance or shifts leave a pressure angle."""
        if self.given_distance is not None:
            return least_distance(self) <= self.given_distance
        return bound_of_shift_sum(self) <= self.shift_sum

    @property
    def barely_exist(self) -> Any:
        """Where that hangs by few digits: pressure angles near 0."""
        if self.given_distance is not None:
            least = least_distance(self)
            return abs(self.given_distance - least) <= _BARELY * least
        return abs(self.shift_sum - bound_of_shift_sum(self)) <= _BARELY

    @property
    def have_flanks(self) -> Any:
        """Where both tips lie outside the base circles."""
        return (self._tip_rise[0] == self._tip_rise[0]) & (self._tip_rise[1] == self._tip_rise[1])

    @property
    def barely_have_flanks(self) -> Any:
        """Where that hangs by few digits, or a mate's tip comes near to the base tangent point."""
        margins, tips = self.interference_margin, self.tip_radius
        least = _BARELY * self.module
        near = [abs(tips[k] - self.base_radius[k]) <= least for k in (0, 1)]
        return near[0] | near[1] | (abs(margins[0]) <= least) | (abs(margins[1]) <= least)

    @property
    def internal(self) -> bool:
        """None of them."""
        return False

    @property
    def keeps_clearance(self) -> bool:
        """All of them."""
        return True

    def _rise_to(self, radius: float, increase: float, _what: str = "radius") -> float:
        return teeth.rise_between(radius, increase, self.transverse_pressure_angle, self.fn)

    @property
    def tip_shortening(self) -> float:
        """dy, one number of both gears."""
        return 0.0 - self.tip_alteration[0]

    @property
    def slides(self) -> Any:
        """Where both root ends of the flanks in contact lie on their involutes."""
        return np.minimum(*self.interference_margin) > 0.0

    def _specific_sliding_of(self, gear: int) -> Any:
        return np.where(self.slides, self._sliding_at_root(gear), np.nan)

    def tool(self, gear: int) -> RackTool:
        """The given one, or that of the profile."""
        return self.tools[gear] or self._standard_tool

    @cached_property
    def _standard_tool(self) -> RackTool:
        return standard_tool(self.pressure_angle, self.addendum, self.clearance, self.fn)

    @cached_property
    def roots(self) -> tuple[RackCutRoots, RackCutRoots]:
        """The roots of both gears."""
        one, other = (
            RackCutRoots(
                teeth=self.teeth[gear],
                shift=self.profile_shift[gear],
                tool=self.tool(gear),
                pressure_angle=self.pressure_angle,
                helix_angle=self.helix_angle,
            )
            for gear in (0, 1)
        )
        return one, other

    def cut_root(self, gear: int) -> RackCutRoots:
        """The root of a gear of each pair."""
        return self.roots[gear]

    def form_radius_of(self, gear: int) -> Any:
        """r_Ff of one gear of each pair."""
        return np.where(self._pointed(gear), np.nan, self.module * self.roots[gear].form_radius)

    def _pointed(self, gear: int) -> Any:
        """Where the tool has no tip."""
        return self.tool(gear).rounding_center(self.pressure_angle, self.fn) < 0.0

    @property
    def form_is_doubtful(self) -> Any:
        """Where the cut of fillet and involute was not found."""
        one, other = (~self._pointed(gear) & np.isnan(self.form_radius_of(gear)) for gear in (0, 1))
        return one | other

    @property
    def flank_ends_on_base(self) -> Any:
        """Where a flank ends so near to its base circle that its length hangs by few digits."""
        return self._ends_on_base(0) | self._ends_on_base(1)

    def _ends_on_base(self, gear: int) -> Any:
        return self.form_radius_of(gear) - self.base_radius[gear] <= _BARELY * self.base_radius[gear]

    @cached_property
    def span_teeth(self) -> Any:
        """Numbers k of teeth whose span measurement touches nearest to the circle r + x m."""
        return tuple(np.where(high[1] < low[1], high[0], low[0]) for low, high in self._rivals)

    @cached_property
    def _rivals(self) -> Any:
        spanned = self._spanned(0), self._spanned(1)
        return [teeth.span_rivals(z, x, self.pressure_angle, self.helix_angle, self.fn) for z, x in spanned]

    @property
    def span_is_doubtful(self) -> Any:
        """Where two numbers of spanned teeth suit a gear equally well."""
        near = [(abs(low[1] - high[1]) < _NO_DISTANCE) & (low[0] != high[0]) for low, high in self._rivals]
        return near[0] | near[1]

    def _spanned(self, gear: int) -> tuple[int, float]:
        return self.teeth[gear], self.profile_shift[gear]


@dataclass(frozen=True)
class PathsOfContact(PathOfContact):
    """The paths of contact of many pairs."""

    @cached_property
    def overlap_ratio(self) -> Any:
        """eps_beta; NaN for helical gears without a width."""
        helix = self.pair.helix_angle
        width = np.nan if self.face_width is None else self.face_width
        return np.where(helix == 0.0, 0.0, width * np.sin(helix) / (math.pi * self.pair.module))

    @property
    def sliding_at_tip(self) -> Any:
        """zeta at the tips."""
        return self._sliding_at_tip()

    def _lost(self, gear: int, root_end: float) -> Any:
        form = self.pair.form_radius[gear]
        return np.where(np.isnan(form), 0.0, super()._lost(gear, root_end))  # type: ignore[arg-type]


@dataclass(frozen=True, kw_only=True)
class RackCutRoots(RackCutRoot):
    """The roots of many gears, whose tools share their protuberance."""

    fn: ClassVar[GearFunctions] = ARRAYS

    def part(self, places: Any) -> RackCutRoots:
        """The roots of the gears at some places."""

        def at(value: Any) -> Any:
            return value[places] if np.ndim(value) else value

        given = self.tool
        tool = replace(given, addendum=at(given.addendum), rounding=at(given.rounding))
        return RackCutRoots(
            teeth=at(self.teeth),
            shift=at(self.shift),
            tool=tool,
            pressure_angle=at(self.pressure_angle),
            helix_angle=at(self.helix_angle),
        )

    @cached_property
    def _cut_into(self) -> tuple[Any, RackCutRoots | None]:
        """Places of the gears whose involute the tool cuts into, or may with a protuberance; and their roots."""
        places = np.flatnonzero(np.atleast_1d(self.undercut) | (self.tool.residual_undercut != 0.0))
        return places, self.part(places) if places.size else None

    @cached_property
    def form_radius(self) -> Any:
        """r_Ff; where the tool undercuts or protrudes from the cut through the involute."""
        found, (places, cut) = np.atleast_1d(self.form_radius_uncut), self._cut_into
        if cut is not None:
            found[places] = np.maximum(cut.base_radius, abs(cut.fillet(cut.cut_end)))
        return found

    @cached_property
    def end_normal(self) -> Any:
        """Where the fillet ends; NaN where it meets no involute. One number where it is the same of all."""
        places, cut = self._cut_into
        if cut is None:
            return self.last_normal
        found: Any = np.broadcast_to(self.last_normal, np.atleast_1d(self.flank_start).shape).copy()
        found[places] = cut.cut_end
        return found

    def corner_path(self, left: Any, above: Any, rolled: Any) -> Any:
        """As of one gear; where no tool has rolled on, the corner is where it was."""
        return super().corner_path(left, above, rolled) if np.any(rolled > 0.0) else left

    @cached_property
    def cut_end(self) -> Any:
        """`end_normal` of gears that are all cut into."""
        size = np.atleast_1d(self.flank_start).shape
        end: Any = np.broadcast_to(np.asarray(self.last_normal, dtype=float), size)
        base = np.broadcast_to(self.base_radius, size)
        start: Any = np.zeros(size)
        inside = abs(self.fillet(start)) < base
        ends_inside = inside & (abs(self.fillet(end)) <= base)
        start[inside] = self._root("_above_base", start[inside], end[inside], np.flatnonzero(inside))
        past = (self.tool.residual_undercut > 0.0) & (self._into_tooth(end) > 0.0)
        meets = ~ends_inside & ~past & ((self._into_tooth(start) > 0.0) != (self._into_tooth(end) > 0.0))
        cut = np.where(ends_inside, end, start)
        cut[meets] = self._root("_into_tooth", start[meets], end[meets], np.flatnonzero(meets))
        cut[past] = self._root("_into_tooth", end[past], end[past] + REACH, np.flatnonzero(past))
        return cut

    def _above_base(self, normal: Any) -> Any:
        return abs(self.fillet(normal)) - self.base_radius

    def _root(self, name: str, low: Reals, high: Reals, places: Any) -> Reals:
        """Where a function of the normal is zero, of the gears at some places."""
        if not low.size:
            return low
        part = self.part(places)
        return bracketed_roots(getattr(part, name), low, high)


@dataclass(frozen=True, kw_only=True)
class RingPairs(GearPairs):
    """Pairs whose gear 2 is a ring; without a cutter its fillets are not known.

    Notes
        As `GearPair` does, they keep their tips whole.
    Example
        >>> rings = RingPairs(module=2.0, teeth=(21.0, np.array([-67.0, -90.0])), given_shift=(0.3, -0.3))
        >>> rings.contact_ratio.round(6).tolist()
        [1.736394, 1.71631]
    """

    @cached_property
    def exist(self) -> Any:
        """Where teeth and distance or shifts leave a pressure angle."""
        if self.given_distance is not None:
            return super().exist
        return self.shift_sum <= bound_of_shift_sum(self)

    @property
    def internal(self) -> bool:
        """All of them."""
        return True

    @property
    def keeps_clearance(self) -> bool:
        """None of them."""
        return False

    @property
    def min_shift_no_undercut(self) -> Any:
        """x_min of the pinions; rings have none."""
        return self.min_shift_of(0), np.nan

    @cached_property
    def shaped(self) -> ShapedRings | None:
        """The rings as their cutter leaves them; None without one."""
        if self.cutter is None:
            return None
        return ShapedRings(
            module=self.module,
            teeth=self.teeth[1],
            shift=self.profile_shift[1],
            cutter=self.cutter,
            pressure_angle=self.pressure_angle,
            helix_angle=self.helix_angle,
        )

    def form_radius_of(self, gear: int) -> Any:
        """r_Ff of one gear of each pair; of a ring only with a cutter."""
        if gear == 0:
            return super().form_radius_of(0)
        return np.nan if self.shaped is None else -self.shaped.form_radius

    @property
    def form_is_doubtful(self) -> Any:
        """Where the cut of fillet and involute was not found."""
        return ~self._pointed(0) & np.isnan(self.form_radius_of(0))

    @property
    def flank_ends_on_base(self) -> Any:
        """Where a pinion's flank ends so near to its base circle that its length hangs by few digits."""
        return self._ends_on_base(0)

    @cached_property
    def span_teeth(self) -> Any:
        """As of external gears; a helical ring has none."""
        first, second = super().span_teeth
        return first, np.where(self.helix_angle != 0.0, np.nan, second)

    def _spanned(self, gear: int) -> Any:
        z, x = self.teeth[gear], self.profile_shift[gear]
        return (z, x) if gear == 0 else (-z, -x)


class _Meshes(PitchPair):
    """Cutters and rings."""

    fn: ClassVar[GearFunctions] = ARRAYS


@dataclass(frozen=True, kw_only=True)
class ShapedRings(ShapedRing):
    """Rings of many shifts as one pinion cutter shapes them."""

    @cached_property
    def mesh(self) -> PitchPair:
        """Cutter and rings while the last cut is taken."""
        return _Meshes(
            module=self.module,
            teeth=(self.cutter.teeth, self.teeth),
            pressure_angle=self.pressure_angle,
            helix_angle=self.helix_angle,
            given_shift=(self.cutter.shift, self.shift),
        )

    @cached_property
    def fillet_radius(self) -> Any:
        """rho_F* [module]; NaN where no tangent of 60 deg touches the fillet."""
        ring = self.virtual
        start, end = np.broadcast_arrays(*ring.turns)
        return ring.radius_at(bracketed_roots(ring.leaning, start, end))  # type: ignore[arg-type]


@dataclass(frozen=True)
class InternalInterferences(InternalInterference):
    """The interferences of many; NaN where the class of one has None."""

    @cached_property
    def tip_fouling_angle(self) -> Any:
        """F [rad]."""
        return self._fouling_angle

    @cached_property
    def radial_assembly_angle(self) -> Any:
        """G [rad]."""
        always = self._always_opens
        return np.where(self._is_too_large, -np.inf, np.where(always, np.nan, self._assembly_angle))

    @property
    def is_doubtful(self) -> Any:
        """Where tip circles nearly touch, or a pinion is nearly as large as the opening."""
        near, tips = 1e-9, self._tips
        ratio = -self.pair.teeth[0] / self.pair.teeth[1] * self._opening
        touch = np.abs(self.tip_circles_apart) <= near * tips[1]
        touch = touch | (np.abs(-self.pair.center_distance - tips[0] - tips[1]) <= near * tips[1])
        return touch | (np.abs(self._opening - 1.0) <= near) | (np.abs(ratio - 1.0) <= near)


_GOLDEN = (math.sqrt(5.0) - 1.0) / 2.0
_FEW = 512
"""Pairs of which none is left out: what they share is known already."""
_ROUNDS = 40
"""Of a golden section: the place to the root of a rounding, the gap to rounding."""


@dataclass(frozen=True)
class TipCorners(TipCorner):
    """The corners of many pairs beside the fillets of a gear; the pair is a `GearPairs`.

    Example
        >>> from gearlink.core.parts.gears.mesh.pair_sweep import GearPairs
        >>> pairs = GearPairs(module=2.0, teeth=(20.0, np.array([40.0, 72.0])), given_shift=(0.2, 0.0))
        >>> TipCorners(pairs, 0).may_cut(np.array([True, True])).tolist()
        [False, False]
    """

    @property
    def _form(self) -> Any:
        """r_Ff of the gear alone: where a tool cuts into flanks, that of the mating gear is another search."""
        return self.pair.form_radius_of(self.gear)

    def may_cut(self, judged: Any) -> Any:
        """Where the steps of the search for the minimum gap pass a valley in which the corner could be in the fillet.

        Parameters
            judged : (N,) array - pairs whose contact ends on the flank; of others nothing is said
        """
        near = self._leaves_tool(judged)
        if not near.any():
            return near
        some, places = self._those(near)
        gaps = some._gaps(some._steps)
        found = np.zeros(near.shape, dtype=bool)
        found[places] = some._valleys(gaps).any(axis=0) | (gaps[0] < 0.0)
        return found & near

    def least_gaps(self, judged: Any) -> Any:
        """`TipCorner.minimum` of each pair that is judged [mm]; infinite where the corner stays in the tool."""
        near, found = self._leaves_tool(judged), np.full(judged.shape, np.inf)
        if near.any():
            some, places = self._those(near)
            found[places] = some._least_gaps
        return np.where(near, found, np.inf)

    @property
    def _least_gaps(self) -> Any:
        gaps = self._gaps(self._steps)
        valleys = self._valleys(gaps)
        if not valleys.any():
            return gaps.min(axis=0)
        steps, depth = np.broadcast_to(self._steps, gaps.shape), np.where(valleys, gaps[1:-1], np.inf)
        middle, columns = depth.argmin(axis=0) + 1, np.arange(depth.shape[1])
        within = self._least_between(steps[middle - 1, columns], steps[middle + 1, columns])
        return np.minimum(gaps.min(axis=0), np.where(valleys.any(axis=0), within, np.inf))

    @cached_property
    def _steps(self) -> Any:
        """`places_towards` as rows; of fillets that are all alike one column."""
        _, start, end = self._fillet
        places = np.array(places_towards(start, end))
        return places.reshape(len(places), -1)

    def _gaps(self, places: Any) -> Any:
        """Gaps along circles [mm]; infinite where no corner comes."""
        radius, beside = self._fillet[0](places)
        squared = self.path.squared(radius)
        reached = squared >= 0.0
        return np.where(reached, self.path.gap(np.where(reached, squared, 0.0), beside) * radius, np.inf)

    def _valleys(self, gaps: Any) -> Any:
        """Of the steps between the first and the last, those whose gap is none of its neighbours' more, and near."""
        inside = gaps[1:-1]
        return (gaps[:-2] >= inside) & (inside <= gaps[2:]) & (inside < near_of(self.pair.module))

    def _least_between(self, low: Any, high: Any) -> Any:
        """The minimum gaps between places, by golden section."""
        one, other = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
        at_one, at_other = self._gaps(one), self._gaps(other)
        least = np.minimum(at_one, at_other)
        for _ in range(_ROUNDS):
            left = at_one <= at_other
            low, high = np.where(left, low, one), np.where(left, other, high)
            middle = np.where(left, high - _GOLDEN * (high - low), low + _GOLDEN * (high - low))
            at_middle = self._gaps(middle)
            one, other = np.where(left, middle, other), np.where(left, one, middle)
            at_one, at_other = np.where(left, at_middle, at_other), np.where(left, at_one, at_middle)
            least = np.minimum(least, at_middle)
        return least

    def _leaves_tool(self, judged: Any) -> Any:
        """Where the corner comes near, and is not known to be in the tool all the way."""
        near = judged & self.comes_near
        return near if self.pair.internal else near & ~self.stays_in_tool

    def _those(self, near: Any) -> tuple[TipCorners, Any]:
        """Corners of pairs that are near, few others among them, and their places."""
        if near.size < _FEW:
            return self, slice(None)
        places = np.flatnonzero(near)
        given = {field.name: _part(getattr(self.pair, field.name), near.shape, places) for field in fields(self.pair)}
        return TipCorners(type(self.pair)(**given), self.gear), places


def _part(value: Any, shape: tuple[int, ...], places: Any) -> Any:
    """The values at some places of an array, or of each of a tuple; a number stays."""
    if isinstance(value, tuple):
        return tuple(_part(each, shape, places) for each in value)
    return np.broadcast_to(value, shape)[places] if isinstance(value, np.ndarray) else value
