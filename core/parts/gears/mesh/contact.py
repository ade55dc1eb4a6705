"""The path of contact of a gear pair in the transverse section: its ends, contact ratios and sliding.

Places on the line of action are radii of curvature rho_1 of gear 1, the distance from its base tangent point; signs
are those of ISO 21771, so that one set of formulas serves external and internal pairs:

    T = a_w sin(alpha_wt),  rho_2 = T - rho_1,  A: tip of gear 2, C: pitch point, E: tip of gear 1
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

from gearlink.core.base.results import cached_property
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.mesh.pitch_pair import Pair


@dataclass(frozen=True)
class PathOfContact:
    """Where the flanks of a pair touch.

    Parameters
        face_width : float or None [mm] - common width of both gears, for the overlap of helical ones
    Returns
        Properties: lengths in mm; a pair is (gear 1, gear 2).
    Raises
        NoSolution - where a tip circle lies inside its base circle
    Notes
        Compared with the common base tangent cut by the tip circles in the plane, and the velocities of both
        bodies at the contact: 1e-37 at forty digits, a few ulp here.
    Example
        >>> path = PathOfContact(GearPair.from_shift(2.0, (40, 72)))
        >>> round(path.length / path.pair.base_pitch - path.pair.contact_ratio, 12)
        0.0

    Source
        ISO 21771
    """

    pair: GearPair
    face_width: float | None = None

    @cached_property
    def line(self) -> float:
        """T = (r_b1 + r_b2) tan(alpha_wt), from base tangent point to base tangent point; negative with a ring."""
        r = self.pair.base_radius
        return (r[0] + r[1]) * self.pair.fn.tan(self.pair.working_pressure_angle)

    def shortened(self, gear: int) -> float | None:
        """k of a gear [module] with which contact begins where its mate's flank ends towards the root.

        None where it begins farther out already, or that end is not known.
        """
        pair, mate = self.pair, 1 - gear
        form, base, tip = pair.form_radius[mate], pair.base_radius, pair.tip_radius[gear]
        if form is None:
            return None
        own = self.line - math.copysign(math.sqrt(form**2 - base[mate] ** 2), form)
        k = pair.tip_alteration[gear] + (math.copysign(math.hypot(base[gear], own), tip) - tip) / pair.module
        return k if k < pair.tip_alteration[gear] else None

    @property
    def contact_ratio(self) -> float:
        """eps_alpha."""
        return self.pair.contact_ratio

    @property
    def gear_ratio(self) -> float:
        """u = z_2/z_1, negative with a ring."""
        return self.pair.gear_ratio

    @cached_property
    def start(self) -> float:
        """rho_A1, where contact begins: at the tip of gear 2."""
        return self.pair.interference_margin[1]

    @cached_property
    def end(self) -> float:
        """rho_E1 = sqrt(r_a1^2 - r_b1^2), where contact ends: at the tip of gear 1."""
        return self.pair.base_radius[0] * self.pair.fn.tan(self.pair.tip_pressure_angle[0])

    @cached_property
    def pitch(self) -> float:
        """rho_C1 = r_b1 tan(alpha_wt), at the pitch point."""
        return self.pair.base_radius[0] * self.pair.fn.tan(self.pair.working_pressure_angle)

    @cached_property
    def mate_at_start(self) -> float:
        """rho_A2 = sqrt(r_a2^2 - r_b2^2), signed as the radii of gear 2."""
        return self.pair.base_radius[1] * self.pair.fn.tan(self.pair.tip_pressure_angle[1])

    @cached_property
    def mate_at_end(self) -> float:
        """rho_E2 = T - rho_E1, signed as the radii of gear 2."""
        return self.pair.signs[1] * self.pair.interference_margin[0]

    @cached_property
    def length(self) -> float:
        """g_alpha = rho_E1 - rho_A1."""
        return self.pair.contact_ratio * self.pair.base_pitch

    @cached_property
    def used_root_radius(self) -> Pair:
        """r_Nf, where contact reaches the root of a gear (nominal); signed."""
        r1, r2 = self.pair.base_radius
        return self.pair.fn.hypot(r1, self.start), self.pair.signs[1] * self.pair.fn.hypot(r2, self.mate_at_end)

    @cached_property
    def overlap_ratio(self) -> float | None:
        """eps_beta = b sin(beta)/(pi m); None for helical gears without a width."""
        if self.pair.helix_angle == 0.0:
            return 0.0
        if self.face_width is None:
            return None
        return self.face_width * self.pair.fn.sin(self.pair.helix_angle) / (math.pi * self.pair.module)

    @cached_property
    def total_contact_ratio(self) -> float | None:
        """eps_gamma = eps_alpha + eps_beta."""
        return None if self.overlap_ratio is None else self.contact_ratio + self.overlap_ratio

    @cached_property
    def lost(self) -> Pair:
        """What the path loses at A and E because a flank ends before the mating gear's tip reaches it [mm]."""
        return self._lost(0, self.start), self._lost(1, self.pair.interference_margin[0])

    def _lost(self, gear: int, root_end: float) -> float:
        form, base = self.pair.form_radius[gear], self.pair.base_radius[gear]
        if form is None:
            return 0.0
        fn = self.pair.fn
        flank_end = fn.sqrt(fn.greatest(0.0, (form - base) * (form + base)))
        return fn.greatest(0.0, self.pair.signs[gear] * (flank_end - root_end))

    @cached_property
    def usable_contact_ratio(self) -> float:
        """Contact ratio over the involutes that the tools leave, as far as the form radii are known."""
        return self.pair.contact_ratio - (self.lost[0] + self.lost[1]) / self.pair.base_pitch

    @cached_property
    def sliding_at_tip(self) -> Pair | None:
        """zeta at the tips: zeta_E1 = 1 - rho_E2/(u rho_E1), zeta_A2 = 1 - u rho_A1/rho_A2."""
        return None if self.end == 0.0 or self.mate_at_start == 0.0 else self._sliding_at_tip()

    def _sliding_at_tip(self) -> Pair:
        u = self.pair.gear_ratio
        return 1.0 - self.mate_at_end / (u * self.end), 1.0 - u * self.start / self.mate_at_start

    @cached_property
    def sliding_factor(self) -> Pair:
        """K_g = v_g/v_t at A and at E: (rho_C1 - rho_A1)(1 + 1/u)/r_w1, (rho_E1 - rho_C1)(1 + 1/u)/r_w1."""
        share = (1.0 + 1.0 / self.gear_ratio) / self.pair.working_radius[0]
        return (self.pitch - self.start) * share, (self.end - self.pitch) * share

    @cached_property
    def loss_factor(self) -> float:
        """H_v: friction power of the teeth over the transmitted one and the coefficient of friction, with the load
        shared equally by the pairs of teeth in contact.

        H_v = 2 pi (1/z_1 + 1/z_2)/cos(beta_b) Int |g|/n dg,  g from the pitch point in base pitches, n pairs at g

        Notes
            Where one pair is in contact at the pitch point, the integral is (1 - eps_alpha + eps_1^2 + eps_2^2)/2.
        Source
            ISO/TR 14179-2, Ohlendorf's factor
        """
        pair = self.pair
        first, last = (self.start - self.pitch) / pair.base_pitch, (self.end - self.pitch) / pair.base_pitch
        more = range(1, math.ceil(last - first))
        inside = {0.0, *(first + k for k in more), *(last - k for k in more)}
        cuts = [first, *sorted(each for each in inside if first < each < last), last]
        sliding = 0.0
        for low, high in pairwise(cuts):
            middle = 0.5 * (low + high)
            pairs = math.floor(last - middle) + math.floor(middle - first) + 1
            sliding += 0.5 * abs(high - low) * abs(high + low) / pairs
        return 2.0 * math.pi * (1.0 + 1.0 / self.gear_ratio) / pair.teeth[0] / math.cos(pair.base_helix_angle) * sliding

    def sliding(self, rho: float) -> Pair:
        """zeta_1 = 1 - rho_2/(u rho_1) and zeta_2 = 1 - u rho_1/rho_2 at rho_1 [mm]; infinite on a base circle."""
        u, mate = self.gear_ratio, self.line - rho
        one = 1.0 - mate / (u * rho) if rho else -math.inf
        return one, 1.0 - u * rho / mate if mate else -math.inf

    def curvature(self, rho: float) -> float:
        """1/rho_1 + 1/rho_2 at rho_1 [1/mm]; infinite on a base circle."""
        mate = self.line - rho
        return math.inf if 0.0 in (rho, mate) else 1.0 / rho + 1.0 / mate
