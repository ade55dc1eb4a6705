"""Many pairs with the data of one: `GearData` over arrays of profile shifts; what one pair lacks or refuses is NaN."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from gearlink.core.gears.data import GearData
from gearlink.core.gears.mesh.pair_sweep import GearPairs, PathsOfContact
from gearlink.core.gears.mesh.ring_sweep import InternalInterferences, RingPairs
from gearlink.core.gears.rating.root_strength import RootSection
from gearlink.core.gears.rating.root_stress import RootStress
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.roots_sweep import bracketed_roots
from gearlink.core.results import cached_property


@dataclass(frozen=True, kw_only=True)
class GearDatas(GearData):
    """Pairs that differ in their shifts alone.

    Example
        >>> from gearlink.core.gears.mesh.pair import GearPair
        >>> one = GearData(pair=GearPair(module=2.0, teeth=(20, 40), given_shift=(0.1, 0.0)))
        >>> many = shifted(one, np.array([0.1, 0.3]), np.zeros(2))
        >>> many.pair.contact_ratio.round(6).tolist(), many.root.form_factor[0].round(6).tolist()
        ([1.601225, 1.532794], [1.494699, 1.349281])
    """

    pairs: GearPairs
    """The pair, known to be many."""

    @cached_property
    def path(self) -> PathsOfContact:
        """Their paths of contact, with the lesser width."""
        return PathsOfContact(self.pair, self._common_width)

    @cached_property
    def internal(self) -> InternalInterferences | None:
        """Their interferences; None for external pairs."""
        return InternalInterferences(self.pair) if self.pair.internal else None

    @cached_property
    def root(self) -> RootStresses:
        """Root strength, at the upper allowances."""
        return RootStresses(**self._of_roots)


@dataclass(frozen=True, kw_only=True)
class RootStresses(RootStress):
    """Root stresses of many pairs."""

    def _section(self, gear: int) -> RootSection | None:
        return self._made(gear)

    def _made(self, gear: int) -> RootSection:
        pair, eps = self.path.pair, self.path.contact_ratio
        return RootSections(pair=pair, gear=gear, tool=self.tools[gear], shift=self.shifts[gear], contact_ratio=eps)


@dataclass(frozen=True, kw_only=True)
class RootSections(RootSection):
    """The root sections of one gear of many pairs."""

    @cached_property
    def theta(self) -> Any:
        """Direction of the tool's normal at the tangent; NaN where no tangent of this direction touches the fillet."""
        alpha, fn = self.pair.pressure_angle, self.pair.fn
        slope, h, center = np.broadcast_arrays(*self._tangent_line, self.tool.rounding_center(alpha, fn))
        low = np.where(center < 0.0, np.nan, 0.0)
        high = np.full(low.shape, np.pi / 2.0 - alpha)
        return bracketed_roots(lambda b: b - slope * np.tan(b) + h, low, high)

    @cached_property
    def stress_correction_factor(self) -> Any:
        """Y_S; NaN where fillet radius, section, lever or form factor is not positive."""
        least = np.minimum(np.minimum(self.fillet_radius, self.chord), self.moment_arm)
        return np.where((least > 0.0) & (self.form_factor > 0.0), self._stress_correction, np.nan)


def shifted(data: GearData, first: Reals, second: Reals) -> GearDatas:
    """The data of a pair with other shifts (x_1, x_2) [module], (N,) arrays each."""
    made = RingPairs if data.pair.internal else GearPairs
    of_pair = {each.name: getattr(data.pair, each.name) for each in fields(data.pair)}
    of_pair |= {"given_shift": (first, second), "given_distance": None, "given_first_shift": None}
    rest = {each.name: getattr(data, each.name) for each in fields(data) if each.name != "pair"}
    pairs = made(**of_pair)
    return GearDatas(pair=pairs, pairs=pairs, **rest)
