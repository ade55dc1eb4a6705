"""Many gear pairs at once, external or with a ring: `GearPair` over arrays of its parameters, and interferences.

Every formula is that of the class of one pair, with the functions of `gearlink.core.parts.gears.tooth.teeth` for
arrays. What one pair refuses is NaN here, and so is what it lacks.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.elementary_sweep import FUNCTIONS
from gearlink.core.numerics.roots_sweep import bracketed_roots
from gearlink.core.parts.gears.mesh.contact import PathOfContact
from gearlink.core.parts.gears.mesh.pair import GearPair, least_distance
from gearlink.core.parts.gears.mesh.pitch_pair import PitchPair, bound_of_shift_sum
from gearlink.core.parts.gears.mesh.ring_cutter import InternalInterference, ShapedRing
from gearlink.core.parts.gears.mesh.tip_corner import TipCorner, near_of, places_towards
from gearlink.core.parts.gears.tooth import teeth
from gearlink.core.parts.gears.tooth.root_fillet import REACH, RackCutRoot
from gearlink.core.parts.gears.tooth.teeth import GearFunctions
from gearlink.core.parts.gears.tooth.tools import RackTool, standard_tool


def _involute(alpha: Any) -> Any:
    angles = np.asarray(alpha, dtype=float)
    good = np.abs(angles) < 0.5 * math.pi
    if good.all():
        return involute(angles)
    return np.where(good, involute(np.where(good, angles, 0.0)), np.nan)


def _inverse_involute(v: Reals) -> Reals:
    good = (v >= 0.0) & (v < math.inf)
    if good.all():
        return inverse_involute(v)
    return np.where(good, inverse_involute(np.where(good, v, 0.0)), np.nan)


def _involute_rise(alpha: Any, rise: Any) -> Any:
    return _involute(rise) + np.tan(rise) * np.tan(alpha) * np.tan(alpha + rise)


def _rise_of_involute(alpha: Any, difference: Any) -> Any:
    rise = _inverse_involute(np.asarray(_involute(alpha) + difference)) - alpha
    finer = rise
    for _ in range(2):
        finer = finer - (_involute_rise(alpha, finer) - difference) / np.tan(alpha + finer) ** 2
    return np.where(np.abs(rise) > 0.5 * alpha, rise, finer)


ARRAYS = GearFunctions(
    **FUNCTIONS, involute=_involute, involute_rise=_involute_rise, rise_of_involute=_rise_of_involute
)


_BLOCK = 8192
_SPLIT = 2.0**36 + 1.0  # leaves the upper 17 bits of a double: their cube is exact
_DIRECT = 0.9  # from here on tan(a) - a loses less than the rational form gains
_LAST = 2.0  # the rational forms of the inverse end here

# (inv a)/(a^3/3) = 1 + w N(w)/D(w), w = a^2: relative error 2e-16 of the second term for a <= 1
_CUBIC_TOP = (0.00025617902645565054, -0.02383080179654133, 0.39999999999999997)
_CUBIC_BOTTOM = (-0.00025623292284188164, 0.02456598490947275, -0.46433890925326576, 1.0)
# alpha/c, c = cbrt(3 v), as a function of c^2: relative error 3e-9 for v <= 2
_START_TOP = (0.000510174231457081, 0.030806259854765993, 0.2164747465587811, 0.9999999977766952)
_START_BOTTOM = (0.0038231201481075134, 0.060304900663855875, 0.34980800147156677, 1.0)
# (pi^2/4 - w) (inv a)/a^3, w = a^2: relative error 6e-18 for a <= 1.28
_POLE_TOP = (0.0006460240453031124, -0.05377753195692445, 0.8224670334241132)
_POLE_BOTTOM = (2.519912699940214e-10, 7.151751063605589e-08, 0.0006769856505923604, -0.06010090372552, 1.0)


def involute(alpha: ArrayLike) -> Reals:
    """Involutes of many pressure angles.

    inv(alpha) = tan(alpha) - alpha

    Parameters
        alpha : float array of any shape [rad] - -pi/2 < alpha < pi/2
    Returns
        v : float array of that shape [rad] - odd in alpha
    Raises
        NoSolution - when an angle lies beyond +-90 deg or is no number
    Notes
        tan(a) - a from 0.9 rad on, below it a rational form with the cube of the angle's upper 17 bits kept
        exact. Measured against 50 digits: 2.1 ulp or better; 5 to 10 ns a value.
    Example
        >>> involute([0.0, 0.35])
        array([0.        , 0.01502849])

    Source
        TY-460 report 1.1; rational form fitted for this program
    """
    angles = np.asarray(alpha, dtype=np.float64)
    if angles.size and not np.abs(angles).max() < math.pi / 2:
        worst = angles.flat[int(np.argmax(~(np.abs(angles) < math.pi / 2)))]
        raise NoSolution(f"pressure angle: {math.degrees(worst):.4g} deg (within -90 and 90 deg: no involute)")
    return _in_blocks(_involute_block, angles, 4)


def inverse_involute(v: ArrayLike) -> Reals:
    """Pressure angles of many involutes.

    tan(alpha) - alpha = v

    Parameters
        v : float array of any shape [rad] - v >= 0
    Returns
        alpha : float array of that shape [rad] - 0 <= alpha < pi/2; exactly 0 at 0
    Raises
        NoSolution - when a value is negative, infinite or no number
    Notes
        Up to v = 2 a rational start in cbrt(3 v), good to 3e-9, and one Newton step with the derivative
        tan^2(alpha); beyond it alpha = atan(v + alpha). Measured against 50 digits: 1.7 ulp or better;
        about 7 ns a value up to v = 2, 17 where larger ones are mixed in. Below v = 1e-300, where the cube
        underflows, the start's own error remains.
    Example
        >>> inverse_involute([0.0, 0.0149, 10.0])
        array([0.        , 0.34903275, 1.48393727])

    Source
        own derivation; rational forms fitted for this program
    """
    values = np.asarray(v, dtype=np.float64)
    if not values.size:
        return np.empty(values.shape)
    if not (values.min() >= 0.0 and values.max() < math.inf):
        worst = values.flat[int(np.argmax(~((values >= 0.0) & (values < math.inf))))]
        raise NoSolution(
            f"involute of the pressure angle: {worst:.4g} (limit >= 0)",
            fix="increase the sum of the profile shifts, or the centre distance",
        )
    if values.max() <= _LAST:
        return _in_blocks(_inverse_block, values, 4)
    low = values <= _LAST
    alpha = np.empty(values.shape)
    alpha[low] = _in_blocks(_inverse_block, values[low], 4)
    alpha[~low] = _inverse_near_pole(values[~low])
    return alpha


def _in_blocks(kernel: Callable[..., None], values: Reals, buffers: int) -> Reals:
    """Run a kernel over blocks of the flattened array; its buffers are made once."""
    flat = np.ascontiguousarray(values).reshape(-1)
    result = np.empty(flat.size)
    space = np.empty((buffers, min(_BLOCK, flat.size)))
    for first in range(0, flat.size, _BLOCK):
        block = flat[first : first + _BLOCK]
        kernel(block, result[first : first + _BLOCK], *space[:, : block.size])
    return result.reshape(values.shape)


def _polynomial(coefficients: tuple[float, ...], x: Reals, out: Reals) -> Reals:
    """Horner's rule in place, highest power first."""
    np.multiply(x, coefficients[0], out=out)
    out += coefficients[1]
    for c in coefficients[2:]:
        out *= x
        out += c
    return out


def _involute_block(a: Reals, out: Reals, w: Reals, second: Reals, p: Reals, q: Reals) -> None:
    np.multiply(a, a, out=w)
    _polynomial(_CUBIC_TOP, w, second)
    second /= _polynomial(_CUBIC_BOTTOM, w, p)
    second *= w
    np.multiply(a, _SPLIT, out=p)
    np.subtract(p, a, out=q)
    p -= q  # the upper part of a
    np.subtract(a, p, out=q)
    np.add(a, p, out=out)
    out *= p
    out += w
    out *= q  # a^3 less the cube of the upper part
    out *= 1.0 / 3.0
    np.multiply(p, p, out=w)
    w *= p
    w /= 3.0
    np.add(w, out, out=p)
    p *= second
    out += p
    out += w
    np.abs(a, out=q)
    if q.max() >= _DIRECT:
        np.tan(a, out=w)
        w -= a
        np.copyto(out, w, where=q >= _DIRECT)


def _inverse_block(v: Reals, out: Reals, w: Reals, p: Reals, q: Reals, inv: Reals) -> None:
    np.multiply(v, 3.0, out=q)
    np.cbrt(q, out=out)
    np.multiply(out, out, out=w)
    out *= _polynomial(_START_TOP, w, p)
    out /= _polynomial(_START_BOTTOM, w, p)
    np.multiply(out, out, out=w)
    _polynomial(_POLE_TOP, w, inv)
    inv *= w
    inv *= out
    _polynomial(_POLE_BOTTOM, w, p)
    np.subtract(math.pi**2 / 4.0, w, out=q)
    p *= q
    inv /= p
    np.add(inv, out, out=p)  # tan(alpha)
    p *= p
    p += 1e-300  # v = 0: a step of 0/1e-300 instead of 0/0
    inv -= v
    inv /= p
    out -= inv


def _inverse_near_pole(v: Reals) -> Reals:
    alpha = np.arctan(v + 1.3)
    for _ in range(3):
        tangent = v + alpha
        alpha -= (alpha - np.arctan(tangent)) * (1.0 + 1.0 / tangent / tangent)
    return np.asarray(np.arctan(v + alpha))


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

    def _rise_to(self, radius: float, increase: float, _what: str = "radius") -> float:
        """NaN inside the base circle, and where a tip is shortened beyond the axis: R^2 may exceed r_b^2 there."""
        found = teeth.rise_between(radius, increase, self.transverse_pressure_angle, self.fn)
        return np.where(radius + increase > 0.0, found, np.nan)  # type: ignore[return-value]

    @property
    def tip_shortening(self) -> float:
        return 0.0 - self.tip_alteration[0]

    def _specific_sliding_of(self, gear: int) -> Any:
        return np.where(self.slides, self._sliding_at_root(gear), np.nan)

    def tool(self, gear: int) -> RackTool:
        return self.tools[gear] or self._standard_tool

    @cached_property
    def _standard_tool(self) -> RackTool:
        return standard_tool(self.pressure_angle, self.addendum, self.clearance, self.fn)

    def _kind_of_root(self) -> type[RackCutRoots]:
        return RackCutRoots

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

        tool = replace(self.tool, addendum=at(self.tool.addendum), rounding=at(self.tool.rounding))
        others = ("teeth", "shift", "pressure_angle", "helix_angle")
        return replace(self, tool=tool, **{name: at(getattr(self, name)) for name in others})

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
        if self.given_distance is not None:
            return super().exist
        return self.shift_sum <= bound_of_shift_sum(self)

    @property
    def internal(self) -> bool:
        """All of them."""
        return True

    @property
    def min_shift_no_undercut(self) -> Any:
        """x_min of the pinions; rings have none."""
        return self.min_shift_of(0), np.nan

    @property
    def min_teeth_no_undercut(self) -> Any:
        """z_min of the pinions; rings have none."""
        return self.min_teeth_of(0), np.nan

    def _kind_of_ring(self) -> type[ShapedRings]:
        return ShapedRings

    def form_radius_of(self, gear: int) -> Any:
        """r_Ff of one gear of each pair; of a ring only with a cutter."""
        if gear == 0:
            return super().form_radius_of(0)
        return np.nan if self.shaped is None else -self.shaped.form_radius

    @property
    def form_is_doubtful(self) -> Any:
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


class _Meshes(PitchPair):
    """Cutters and rings."""

    fn: ClassVar[GearFunctions] = ARRAYS


@dataclass(frozen=True, kw_only=True)
class ShapedRings(ShapedRing):
    """Rings of many shifts as one pinion cutter shapes them."""

    meshes: ClassVar[type[PitchPair]] = _Meshes

    def _require_pressure_angle(self) -> None:
        """Nothing is refused; without one they are NaN."""

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
        return self._fouling_angle

    @cached_property
    def radial_assembly_angle(self) -> Any:
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
