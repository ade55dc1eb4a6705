"""Corners of tips in the roots of their mates, of many pairs at once."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from gearlink.core.base.results import cached_property
from gearlink.core.parts.gears.mesh.tip_corner import TipCorner, near_of, places_towards

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
