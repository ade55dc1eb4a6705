"""An external spur gear pair with profile shift, each value worked out when it is asked for."""

from __future__ import annotations

import math
from dataclasses import dataclass

from gearlink.core.errors import NoSolution
from gearlink.core.gears import teeth
from gearlink.core.gears.involute import involute, involute_rise, rise_of_involute
from gearlink.core.report import safely_above
from gearlink.core.results import cached_property

Pair = tuple[float, float]


@dataclass(frozen=True, kw_only=True)
class GearPair:
    """External spur gear pair without backlash, from its profile shifts or from its centre distance.

    cos(alpha') = a cos(alpha)/a',  x_1 + x_2 = (z_1 + z_2)(inv(alpha') - inv(alpha))/(2 tan(alpha))

    Parameters
        module : float [mm] - m > 0
        teeth : (int, int) - z_1, z_2 >= 1
        pressure_angle : float [rad] - alpha of the reference profile, 0 < alpha < pi/2
        addendum, clearance : float [module] - h_a*, c* of the reference profile
        given_shift : (float, float) or None [module] - x_1, x_2
        given_distance : float or None [mm] - a'; exactly one of shifts and distance is given
        given_first_shift : float or None [module] - x_1 beside a centre distance; None shares equally
    Returns
        Properties: lengths in mm, angles in rad, coefficients in modules; a pair is (gear 1, gear 2).
    Raises
        NoSolution - on construction for impossible data; from a property that does not exist
    Notes
        Everything is written in the rise alpha' - alpha of the pressure angle, so that neither the sum of
        shifts nor the tip shortening is a small difference of large numbers; at the reference centre distance
        both are exactly 0. Of the data the shift sum from a centre distance inherits the condition number
        a'/(a' - a): a' carries only so many digits. Otherwise a few ulp. Pressure angles near 0 (a centre
        distance near the sum of the base radii) have the condition number 1/tan^2(alpha').
    Example
        >>> pair = GearPair.from_center_distance(4.0, (72, 72), 290.2912330746487)
        >>> round(math.degrees(pair.working_pressure_angle), 10), round(pair.shift_sum, 10)
        (21.2076131545, 0.5895483575)
        >>> [round(r, 4) for r in pair.tip_radius]
        [149.1121, 149.1121]

    Source
        TY-460 report 1.1; the difference forms are an own derivation
    """

    module: float
    teeth: tuple[int, int]
    pressure_angle: float = math.radians(20.0)
    addendum: float = 1.0
    clearance: float = 0.25
    given_shift: Pair | None = None
    given_distance: float | None = None
    given_first_shift: float | None = None

    def __post_init__(self) -> None:
        if not 0.0 < self.module < math.inf:
            raise NoSolution(f"module {self.module:g} mm: it must be positive")
        for z in self.teeth:
            if isinstance(z, bool) or not isinstance(z, int) or z < 1:
                raise NoSolution(f"teeth {z!r}: a gear has a whole number of teeth, at least 1")
        if not 0.0 < self.pressure_angle < math.pi / 2:
            degrees = math.degrees(self.pressure_angle)
            raise NoSolution(f"pressure angle {degrees:g} deg: it must lie between 0 and 90 deg, usually 20 deg")
        if not (0.0 < self.addendum < math.inf and 0.0 <= self.clearance < math.inf):
            raise NoSolution(
                f"addendum {self.addendum:g} and clearance {self.clearance:g}: "
                "the addendum must be positive (usually 1), the clearance not negative (usually 0.25)"
            )
        if (self.given_shift is None) == (self.given_distance is None):
            raise NoSolution("give either both profile shifts or the centre distance of a gear pair")
        if self.given_shift is None:
            self._check_distance()
        else:
            self._check_shift()

    def _check_distance(self) -> None:
        least = self.base_radius[0] + self.base_radius[1]
        if self.given_distance is not None and not least <= self.given_distance < math.inf:
            raise NoSolution(
                f"centre distance {self.given_distance:.6g} mm does not suit gears of {self.teeth[0]} and "
                f"{self.teeth[1]} teeth of module {self.module:g} mm: the least is the sum of the base radii, "
                f"{safely_above(least, 9)} mm; change it or the teeth"
            )

    def _check_shift(self) -> None:
        least = -self._teeth_sum * involute(self.pressure_angle) / (2.0 * math.tan(self.pressure_angle))
        if not least <= self.shift_sum < math.inf:
            raise NoSolution(
                f"profile shifts with the sum {self.shift_sum:.6g} leave no pressure angle to {self.teeth[0]} and "
                f"{self.teeth[1]} teeth: the sum must be at least {safely_above(least, 6)}; raise a shift or "
                "take more teeth"
            )

    @classmethod
    def from_shift(
        cls,
        module: float,
        teeth: tuple[int, int],
        profile_shift: Pair = (0.0, 0.0),
        pressure_angle: float = math.radians(20.0),
        *,
        addendum: float = 1.0,
        clearance: float = 0.25,
    ) -> GearPair:
        """Pair with the given profile shifts (x_1, x_2) [module] at the centre distance without backlash.

        Example
            >>> GearPair.from_shift(2.0, (40, 72)).center_distance
            112.0
        """
        return cls(
            module=module,
            teeth=teeth,
            pressure_angle=pressure_angle,
            addendum=addendum,
            clearance=clearance,
            given_shift=profile_shift,
        )

    @classmethod
    def from_center_distance(
        cls,
        module: float,
        teeth: tuple[int, int],
        center_distance: float,
        pressure_angle: float = math.radians(20.0),
        *,
        split: float | str = "equal",
        addendum: float = 1.0,
        clearance: float = 0.25,
    ) -> GearPair:
        """Pair at a centre distance [mm]; `split` shares the shift sum: "equal", or the number x_1 [module].

        Example
            >>> GearPair.from_center_distance(2.0, (40, 72), 112.0, split=0.1).profile_shift
            (0.1, -0.1)
        """
        if isinstance(split, str) and split != "equal":
            raise NoSolution(f"shift split {split!r}: it must be 'equal' or the profile shift of gear 1")
        return cls(
            module=module,
            teeth=teeth,
            pressure_angle=pressure_angle,
            addendum=addendum,
            clearance=clearance,
            given_distance=center_distance,
            given_first_shift=None if isinstance(split, str) else split,
        )

    @cached_property
    def _teeth_sum(self) -> int:
        return self.teeth[0] + self.teeth[1]

    @cached_property
    def _rise(self) -> float:
        """alpha' - alpha [rad]."""
        if self.given_distance is None:
            tangent = math.tan(self.pressure_angle)
            return rise_of_involute(self.pressure_angle, 2.0 * self.shift_sum * tangent / self._teeth_sum)
        a = self.reference_center_distance
        return teeth.pressure_angle_rise(a, self.given_distance - a, self.pressure_angle, what="centre distance")

    @cached_property
    def working_pressure_angle(self) -> float:
        """Pressure angle alpha' of the mesh [rad]: cos(alpha') = a cos(alpha)/a'."""
        return self.pressure_angle + self._rise

    @cached_property
    def reference_center_distance(self) -> float:
        """a = m (z_1 + z_2)/2 [mm]."""
        return self.module * self._teeth_sum / 2.0

    @cached_property
    def center_distance(self) -> float:
        """a' [mm]: the given one, or a + y m."""
        if self.given_distance is not None:
            return self.given_distance
        return self.reference_center_distance + self.module * self.center_distance_modification

    @cached_property
    def center_distance_modification(self) -> float:
        """y = (a' - a)/m = (z_1 + z_2) sin((alpha' + alpha)/2) sin((alpha' - alpha)/2)/cos(alpha') [module]."""
        if self.given_distance is not None:
            return (self.given_distance - self.reference_center_distance) / self.module
        half = self._rise / 2.0
        product = math.sin(self.pressure_angle + half) * math.sin(half)
        return self._teeth_sum * product / math.cos(self.working_pressure_angle)

    @cached_property
    def shift_sum(self) -> float:
        """x_1 + x_2 = (z_1 + z_2)(inv(alpha') - inv(alpha))/(2 tan(alpha)) [module]."""
        if self.given_shift is not None:
            return self.given_shift[0] + self.given_shift[1]
        difference = involute_rise(self.pressure_angle, self._rise)
        return self._teeth_sum * difference / (2.0 * math.tan(self.pressure_angle))

    @cached_property
    def profile_shift(self) -> Pair:
        """x_1, x_2 [module]."""
        if self.given_shift is not None:
            return self.given_shift
        first = self.shift_sum / 2.0 if self.given_first_shift is None else self.given_first_shift
        return first, self.shift_sum - first

    @cached_property
    def tip_shortening(self) -> float:
        """dy = x_1 + x_2 - y [module], never negative; with it the tip clearance is c* m.

        dy = (z_1 + z_2)/2 (inv(d)/tan(alpha) + 2 sin^2(d/2) cos(alpha)/(cos(alpha') cos(d))), d = alpha' - alpha
        """
        d, alpha = self._rise, self.pressure_angle
        bend = 2.0 * math.sin(d / 2.0) ** 2 * math.cos(alpha)
        bend /= math.cos(self.working_pressure_angle) * math.cos(d)
        return self._teeth_sum / 2.0 * (involute(d) / math.tan(alpha) + bend)

    @cached_property
    def reference_radius(self) -> Pair:
        """r = m z/2 [mm]."""
        return self.module * self.teeth[0] / 2.0, self.module * self.teeth[1] / 2.0

    @cached_property
    def base_radius(self) -> Pair:
        """r_b = r cos(alpha) [mm]."""
        cosine = math.cos(self.pressure_angle)
        return self.reference_radius[0] * cosine, self.reference_radius[1] * cosine

    @cached_property
    def working_radius(self) -> Pair:
        """r' = a' z/(z_1 + z_2) = r_b/cos(alpha') [mm], the pitch circles that roll on each other."""
        a = self.center_distance
        return a * self.teeth[0] / self._teeth_sum, a * self.teeth[1] / self._teeth_sum

    @cached_property
    def _tip_height(self) -> Pair:
        """h_a* + x - dy [module], tip circle above reference circle."""
        x, lost = self.profile_shift, self.tip_shortening
        return self.addendum + x[0] - lost, self.addendum + x[1] - lost

    @cached_property
    def tip_radius(self) -> Pair:
        """r_a = r + (h_a* + x - dy) m [mm]."""
        r, h = self.reference_radius, self._tip_height
        return r[0] + self.module * h[0], r[1] + self.module * h[1]

    @cached_property
    def root_radius(self) -> Pair:
        """r_f = r - (h_a* + c* - x) m [mm]."""
        r, x, depth = self.reference_radius, self.profile_shift, self.addendum + self.clearance
        return r[0] - self.module * (depth - x[0]), r[1] - self.module * (depth - x[1])

    @cached_property
    def tooth_thickness(self) -> Pair:
        """s = m (pi/2 + 2 x tan(alpha)) [mm], on the reference circle."""
        tangent, x = math.tan(self.pressure_angle), self.profile_shift
        return (
            self.module * (math.pi / 2.0 + 2.0 * x[0] * tangent),
            self.module * (math.pi / 2.0 + 2.0 * x[1] * tangent),
        )

    def _tip_rise_of(self, gear: int) -> float:
        """alpha_a - alpha [rad] of one gear (0 or 1)."""
        height = self.module * self._tip_height[gear]
        try:
            return teeth.pressure_angle_rise(self.reference_radius[gear], height, self.pressure_angle)
        except NoSolution:
            base = self.base_radius[gear]
            missing = (base - self.tip_radius[gear]) / self.module
            raise NoSolution(
                f"tip radius {self.tip_radius[gear]:.6g} mm of gear {gear + 1} lies below its base radius "
                f"{base:.6g} mm: no involute is left; raise its profile shift or the addendum by at least "
                f"{missing:.3g} modules"
            ) from None

    @cached_property
    def _tip_rise(self) -> Pair:
        return self._tip_rise_of(0), self._tip_rise_of(1)

    @cached_property
    def tip_pressure_angle(self) -> Pair:
        """Pressure angle alpha_a on the tip circle [rad]: cos(alpha_a) = r_b/r_a."""
        return self.pressure_angle + self._tip_rise[0], self.pressure_angle + self._tip_rise[1]

    @cached_property
    def tip_thickness(self) -> Pair:
        """s_a = r_a (s/r - 2 (inv(alpha_a) - inv(alpha))) [mm]; negative where the flanks meet below the tip."""
        return self._tip_thickness_of(0), self._tip_thickness_of(1)

    def _tip_thickness_of(self, gear: int) -> float:
        angle = (math.pi + 4.0 * self.profile_shift[gear] * math.tan(self.pressure_angle)) / self.teeth[gear]
        lost = involute_rise(self.pressure_angle, self._tip_rise[gear])
        return self.tip_radius[gear] * (angle - 2.0 * lost)

    @cached_property
    def _action(self) -> Pair:
        """z (tan(alpha_a) - tan(alpha')), the way of contact from pitch point to tip in base circle angle z.

        tan(alpha_a) - tan(alpha') = (r_a^2 - r'^2)/(r_b^2 (tan(alpha_a) + tan(alpha')))
        """
        return self._action_of(0), self._action_of(1)

    def _action_of(self, gear: int) -> float:
        z, y = self.teeth[gear], self.center_distance_modification
        above = self.module * (self._tip_height[gear] - y * z / self._teeth_sum)
        squares = above * (self.tip_radius[gear] + self.working_radius[gear]) / self.base_radius[gear] ** 2
        return z * squares / (math.tan(self.tip_pressure_angle[gear]) + math.tan(self.working_pressure_angle))

    @cached_property
    def contact_ratio(self) -> float:
        """eps = (z_1 (tan(alpha_a1) - tan(alpha')) + z_2 (tan(alpha_a2) - tan(alpha')))/(2 pi), the nominal one."""
        return (self._action[0] + self._action[1]) / (2.0 * math.pi)

    def _left_at_root(self, gear: int) -> float:
        """z tan(alpha') - z_mate (tan(alpha_a,mate) - tan(alpha')): what the mate's tip leaves of the line."""
        return self.teeth[gear] * math.tan(self.working_pressure_angle) - self._action[1 - gear]

    @cached_property
    def interference_margin(self) -> Pair:
        """a' sin(alpha') - sqrt(r_a^2 - r_b^2) [mm]: how far the tip stays short of the mate's base tangent point.

        Negative where the tip meets the mate beyond its involute.
        """
        scale = self.module * math.cos(self.pressure_angle) / 2.0
        return scale * self._left_at_root(1), scale * self._left_at_root(0)

    @cached_property
    def specific_sliding(self) -> Pair:
        """1 - (w_mate rho_mate)/(w rho) at the root end of the active flank, contact at the mate's tip [1]."""
        return self._specific_sliding_of(0), self._specific_sliding_of(1)

    def _specific_sliding_of(self, gear: int) -> float:
        left = self._left_at_root(gear)
        if not left > 0.0:
            beyond = -self.interference_margin[1 - gear]
            raise NoSolution(
                f"tip of gear {2 - gear} reaches {beyond:.6g} mm beyond the base tangent point of gear {gear + 1}, "
                "where sliding has no bound: lower its profile shift or the addendum, or take more teeth"
            )
        mate = self.teeth[1 - gear]
        return -self._action[1 - gear] * self._teeth_sum / (mate * left)

    @cached_property
    def min_shift_no_undercut(self) -> Pair:
        """x_min = h_a* - z sin^2(alpha)/2 [module], for a rack cutter."""
        x_min = teeth.min_shift_no_undercut
        alpha, h = self.pressure_angle, self.addendum
        return x_min(self.teeth[0], alpha, h), x_min(self.teeth[1], alpha, h)

    @cached_property
    def span_teeth(self) -> tuple[int, int]:
        """Numbers k of teeth whose span measurement touches nearest to the circle r + x m."""
        (z1, z2), (x1, x2), alpha = self.teeth, self.profile_shift, self.pressure_angle
        return teeth.span_teeth(z1, x1, alpha), teeth.span_teeth(z2, x2, alpha)

    @cached_property
    def span_measurement(self) -> Pair:
        """W_k over span_teeth = m cos(alpha) (pi (k - 1/2) + z inv(alpha)) + 2 x m sin(alpha) [mm]."""
        m, (z1, z2), (x1, x2), (k1, k2) = self.module, self.teeth, self.profile_shift, self.span_teeth
        width = teeth.span_measurement
        return width(m, z1, x1, self.pressure_angle, k1), width(m, z2, x2, self.pressure_angle, k2)
