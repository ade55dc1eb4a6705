"""Many pinions in rings at once: `GearPairs` with gear 2 a ring, and their interferences."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from gearlink.core.base.results import cached_property
from gearlink.core.numerics.roots_sweep import bracketed_roots
from gearlink.core.parts.gears.mesh.pair_limits import bound_of_shift_sum
from gearlink.core.parts.gears.mesh.pair_sweep import GearPairs
from gearlink.core.parts.gears.mesh.pitch_pair import PitchPair
from gearlink.core.parts.gears.mesh.ring_cutter import ShapedRing
from gearlink.core.parts.gears.mesh.ring_interference import InternalInterference
from gearlink.core.parts.gears.tooth.functions import GearFunctions
from gearlink.core.parts.gears.tooth.functions_sweep import ARRAYS


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
