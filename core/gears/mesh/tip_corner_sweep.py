"""Corners of tips in the roots of their mates, of many pairs at once: where one has to be looked at more closely."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from gearlink.core.gears.mesh.tip_corner import CornerPath, TipCorner, near_of, places_towards


@dataclass(frozen=True)
class TipCorners(TipCorner):
    """The corners of many pairs beside the fillets of a gear that a rack tool cuts; its pair is a `GearPairs`.

    Example
        >>> from gearlink.core.gears.mesh.pair_sweep import GearPairs
        >>> pairs = GearPairs(module=2.0, teeth=(20.0, np.array([40.0, 72.0])), given_shift=(0.2, 0.0))
        >>> TipCorners(pairs, 0).may_cut(np.array([True, True])).tolist()
        [False, False]
    """

    def may_cut(self, judged: Any) -> Any:
        """Where the steps of the search for the least gap pass a valley in which the corner could be in the fillet.

        Parameters
            judged : (N,) array - pairs whose contact ends on the flank; of others nothing is said
        """
        near = judged & self.comes_near
        if not self.pair.internal:
            near = near & ~self.stays_in_tool
        found = np.zeros(near.shape, dtype=bool)
        places = np.flatnonzero(near)
        if places.size:
            found[places] = self._pass_valleys(places, near.shape)
        return found

    def _pass_valleys(self, places: Any, shape: tuple[int, ...]) -> Any:
        def part(value: Any) -> Any:
            return np.broadcast_to(value, shape)[places]

        fn, *way = self.path
        path, module = CornerPath(fn, *map(part, way)), part(self.pair.module)
        root: Any = self.pair.cut_root(self.gear)  # a RackCutRoots
        root = root.part(places)
        steps = np.array(places_towards(0.0, root.end_normal))
        radius, beside = root.polar(steps.reshape(len(steps), -1))
        radius = module * radius
        squared = path.squared(radius)
        reached = squared >= 0.0
        gaps = np.where(reached, path.gap(np.where(reached, squared, 0.0), beside) * radius, np.inf)
        inside = gaps[1:-1]
        valleys = (gaps[:-2] >= inside) & (inside <= gaps[2:]) & (inside < near_of(module))
        return valleys.any(axis=0) | (gaps[0] < 0.0)
