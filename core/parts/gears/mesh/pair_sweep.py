"""Many external gear pairs at once: `GearPair` over arrays of its parameters.

Every formula is that of the class of one pair, with the functions of `functions_sweep`. What one pair refuses is NaN
here, and so is what it lacks.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np

from gearlink.core.base.results import cached_property
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.roots_sweep import bracketed_roots
from gearlink.core.parts.gears.mesh.contact import PathOfContact
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.mesh.pair_limits import bound_of_shift_sum, least_distance
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
