"""A cylindrical gear pair with profile shift, spur or helical, external or internal, each value worked out when asked.

Signs are those of ISO 21771: a ring has negative teeth, and with them its radii, the centre distance, and the gear
ratio are negative; every formula then holds for both kinds. Shift, heights and tool multiply the normal module.

What a pair must satisfy to exist is checked, with a message where it does not.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_above
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short, unlike
from gearlink.core.parts.gears.mesh.pitch_pair import Pair, PitchPair, bound_of_shift_sum, by_gear
from gearlink.core.parts.gears.tooth import teeth

if TYPE_CHECKING:
    from gearlink.core.parts.gears.mesh.ring_cutter import ShapedRing
    from gearlink.core.parts.gears.tooth.root_fillet import RackCutRoot
    from gearlink.core.parts.gears.tooth.tools import PinionCutter, RackTool


_MOST_TEETH = 10_000
_LEAST_MODULE = 1e-100
"""Squares of lengths stay finite."""


def require_profile(pair: GearPair) -> None:
    """Refuse a module, teeth, angles or heights that no gear has.

    Raises
        NoSolution
    """
    if not 0.0 < pair.module < math.inf:
        raise NoSolution(f"module {pair.module:g} mm: it must be positive")
    if not _LEAST_MODULE <= pair.module <= 1.0 / _LEAST_MODULE:
        message = f"module {pair.module:g} mm is out of range: it must lie between 1e-100 and 1e100 mm"
        raise NoSolution(message, key="module")
    _require_teeth(pair)
    if not 0.0 < pair.pressure_angle < math.pi / 2:
        degrees = math.degrees(pair.pressure_angle)
        raise NoSolution(f"pressure angle {degrees:g} deg: it must lie between 0 and 90 deg, usually 20 deg")
    if not 0.0 <= pair.helix_angle < math.pi / 2:
        raise NoSolution(
            f"helix angle {math.degrees(pair.helix_angle):g} deg", fix="give its magnitude, from 0 to below 90 deg"
        )
    if not (0.0 < pair.addendum < math.inf and 0.0 <= pair.clearance < math.inf):
        raise NoSolution(
            f"addendum {pair.addendum:g} and clearance {pair.clearance:g}: "
            "the addendum must be positive (usually 1), the clearance not negative (usually 0.25)"
        )


def _require_teeth(pair: GearPair) -> None:
    first, second = pair.teeth
    for z in pair.teeth:
        if isinstance(z, bool) or not isinstance(z, int) or z == 0:
            raise NoSolution(f"teeth {z!r}: a gear has a whole number of teeth, at least 1")
    if first < 0:
        raise NoSolution(f"teeth {first!r}: gear 1 is external", key=pair.teeth_keys[0], fix="make the ring gear 2")
    if second < 0 and -second <= first:
        raise NoSolution(
            f"a gear of {first} teeth does not fit into a ring of {-second}: the ring needs more teeth",
            key=pair.teeth_keys[1],
        )
    own_ring = second < 0 and pair.given_shift != (0.0, 0.0)
    unusual = own_ring or pair.helix_angle != 0.0 or any(pair.tools)
    if unusual and min(first, abs(second)) < 3:
        place = 0 if first < 3 else 1
        raise NoSolution(f"a gear of {pair.teeth[place]} teeth: it needs at least 3", key=pair.teeth_keys[place])


def least_distance(pair: PitchPair) -> float:
    """The minimum centre distance [mm]: |r_b1 + r_b2|."""
    return abs(pair.base_radius[0] + pair.base_radius[1])


def require_distance(pair: GearPair, distance: float) -> None:
    """Refuse a centre distance below the sum of the base radii (their difference, with a ring).

    Raises
        NoSolution
    """
    least = least_distance(pair)
    if least <= distance < math.inf:
        return
    sum_of = "difference" if pair.internal else "sum"
    raise NoSolution(
        f"centre distance: {unlike(distance, least)} mm (limit >= {unlike(least, distance)} mm, {sum_of} of the "
        f"base radii of gears of {pair.teeth[0]} and {pair.teeth[1]} teeth, module {pair.module:g} mm)",
        fix=f"set the centre distance to at least {safely_above(least)} mm, or use fewer teeth",
    )


def require_shift(pair: GearPair) -> None:
    """Refuse a sum of shifts that leaves no pressure angle: inv(alpha_t) + 2 Sx tan(alpha_n)/Z < 0.

    Raises
        NoSolution
    """
    bound = bound_of_shift_sum(pair)
    total = pair.shift_sum
    if not pair.internal and not bound <= total < math.inf:
        raise NoSolution(
            f"sum of the profile shifts: {unlike(total, bound)} (limit >= {unlike(bound, total)}: no working "
            f"pressure angle of {pair.teeth[0]} and {pair.teeth[1]} teeth)",
            fix="increase a shift or use more teeth",
        )
    if pair.internal and not -math.inf < total <= bound:
        raise NoSolution(
            f"sum of the profile shifts: {unlike(total, bound)} (limit <= {unlike(bound, total)}: no working "
            f"pressure angle of {pair.teeth[0]} teeth in a ring of {-pair.teeth[1]}; a positive shift thickens the "
            "teeth of a ring too)",
            fix="reduce a shift",
        )


def no_involute_at_tip(pair: GearPair, gear: int) -> NoSolution:
    """What is wrong where a tip circle lies inside its base circle."""
    base, tip = abs(pair.base_radius[gear]), pair.tip_radius[gear] * pair.signs[gear]
    missing = safely_above(abs(base - tip) / pair.module, 3)
    if not pair.internal and pair.tip_radius[gear] - pair.tip_alteration[gear] * pair.module >= base:
        return _no_tip_left(pair, gear)
    limit = f"{unlike(tip, base)} mm (limit >= {unlike(base, tip)} mm, its base radius: no involute is left)"
    follows = pair.given_distance is not None and pair.given_shift is None and pair.given_first_shift is None
    if pair.teeth[gear] > 0:
        fix = f"increase its profile shift or the addendum by at least {missing} modules"
        return NoSolution(f"tip radius of gear {gear + 1}: {limit}", fix=_fitting(pair) if follows else fix)
    teeth, fix = least_ring(pair), f"reduce its profile shift or its addendum by at least {missing} modules"
    return NoSolution(
        f"tip radius of the ring: {limit}",
        key=pair.teeth_keys[1],
        fix=fix if teeth is None else f"give it at least {teeth} teeth",
    )


def least_ring(pair: GearPair) -> int | None:
    """Teeth from which on the tips of a ring lie on its involutes, |z_2| (1 - cos(alpha_t)) >= 2 cos(beta) h_a2;
    None where they are too many to be made.
    """
    height = pair.addendum + pair.profile_shift[1] + pair.tip_alteration[1]
    lost = math.sin(pair.transverse_pressure_angle / 2.0) ** 2 / math.cos(pair.helix_angle)
    return math.ceil(height / lost) if height <= _MOST_TEETH * lost else None


def _no_tip_left(pair: GearPair, gear: int) -> NoSolution:
    """What is wrong where the centre distance takes so much from the tips that none is left outside the base circle."""
    first, second = pair.teeth
    return NoSolution(
        f"the tips vanish at gear {gear + 1}: tip shortening {-pair.tip_alteration[gear]:.3g} modules, sum of the "
        f"profile shifts {pair.shift_sum:.3g} (centre distance {short(pair.center_distance)} mm, {first} and {second} "
        f"teeth, module {pair.module:g} mm)",
        fix=_fitting(pair),
    )


def _fitting(pair: GearPair) -> str:
    """The centre distance and the module at which the profile shifts of a pair cancel."""
    reference = pair.reference_center_distance
    fitting = pair.module * pair.center_distance / reference
    return (
        f"set the centre distance near {short(abs(reference))} mm, or use a module near {fitting:.3g} mm or more teeth"
    )


TipRule = Literal["full", "none"] | Pair


@dataclass(frozen=True, kw_only=True)
class GearPair(PitchPair):
    """Cylindrical gear pair, from its profile shifts, its centre distance, or both.

    cos(alpha_wt) = a cos(alpha_t)/a_w,  x_1 + x_2 = (z_1 + z_2)(inv(alpha_wt) - inv(alpha_t))/(2 tan(alpha_n))

    Parameters
        module, teeth, pressure_angle, given_shift, given_distance, given_first_shift, helix_angle - as PitchPair
        addendum, clearance : float [module] - h_a*, c* of the reference profile
        tip : "full", "none" or (k_1, k_2) [module] - tip alteration; None: full for external pairs, none for a ring
        given_tip_radius : (float, float) or None [mm] - magnitudes, instead of the tip alteration
        tools : (RackTool or None, ...) - tool of each gear; None: addendum and clearance of the profile
        given_spans : (int or None, ...) - teeth that a span measurement goes over; None: chosen
        cutter : PinionCutter or None - of a ring; None leaves its fillets unknown
        teeth_keys : keys of the design file that hold the teeth
    Returns
        Properties: lengths in mm, angles in rad, coefficients in modules; a pair is (gear 1, gear 2). Radii of a
        ring and the centre distance of its pair are negative.
    Raises
        NoSolution - on construction for impossible data; from a property that does not exist
    Notes
        Everything is written in the rise alpha_wt - alpha_t of the pressure angle, so that neither the sum of
        shifts nor the tip shortening is a small difference of large numbers; at the reference centre distance
        both are exactly 0. Of the data the shift sum from a centre distance inherits the condition number
        a_w/(a_w - a). Otherwise a few ulp. Pressure angles near 0 (a centre distance near the sum of the base
        radii) have the condition number 1/tan^2(alpha_wt).
    Example
        >>> pair = GearPair(module=4.0, teeth=(72, 72), given_distance=290.2912330746487)
        >>> round(math.degrees(pair.working_pressure_angle), 10), round(pair.shift_sum, 10)
        (21.2076131545, 0.5895483575)
        >>> ring = GearPair(module=2.0, teeth=(21, -67), given_shift=(0.3, -0.3))
        >>> ring.center_distance, ring.tip_radius, round(ring.contact_ratio, 6)
        (-46.0, (23.6, -65.6), 1.736394)

    Source
        ISO 21771; the difference forms are an own derivation
    """

    addendum: float = 1.0
    clearance: float = 0.25
    tip: TipRule | None = None
    given_tip_radius: Pair | None = None
    tools: tuple[RackTool | None, RackTool | None] = (None, None)
    given_spans: tuple[int | None, int | None] = (None, None)
    cutter: PinionCutter | None = None
    teeth_keys: tuple[str, str] = ("teeth[0]", "teeth[1]")

    def __post_init__(self) -> None:
        require_profile(self)
        if self.given_shift is None and self.given_distance is None:
            raise NoSolution("give either both profile shifts or the centre distance of a gear pair")
        if self.given_distance is not None:
            require_distance(self, self.given_distance)
        else:
            require_shift(self)
        for tool in self.tools:
            if tool is not None:
                tool.require_tip(self.pressure_angle)

    @classmethod
    def from_shift(
        cls,
        module: float,
        teeth: tuple[int, int],
        profile_shift: Pair = (0.0, 0.0),
        pressure_angle: float = math.radians(20.0),
        **profile: Any,
    ) -> GearPair:
        """Pair with the given profile shifts (x_1, x_2) [module] at the centre distance without backlash.

        Parameters
            profile : addendum, clearance [module] and what else a pair has
        Example
            >>> GearPair.from_shift(2.0, (40, 72)).center_distance
            112.0
        """
        return cls(module=module, teeth=teeth, pressure_angle=pressure_angle, given_shift=profile_shift, **profile)

    @cached_property
    def _full_shortening(self) -> float:
        """dy = x_1 + x_2 - y [module]; with it the tip clearance is c* m.

        dy = (z_1 + z_2)/(2 cos(beta)) (inv(d)/tan(alpha_t) + 2 sin^2(d/2) cos(alpha_t)/(cos(alpha_wt) cos(d))),
        d = alpha_wt - alpha_t
        """
        if self.given_shift is not None and self.given_distance is not None:
            return self.fn.greatest(0.0, sum(self.given_shift) - self.center_distance_modification)
        d, alpha = self._rise, self.transverse_pressure_angle
        bend = 2.0 * self.fn.sin(d / 2.0) ** 2 * self.fn.cos(alpha)
        bend /= self.fn.cos(self.working_pressure_angle) * self.fn.cos(d)
        return self._teeth_sum / 2.0 / self._cos_helix * (self.fn.involute(d) / self.fn.tan(alpha) + bend)

    @cached_property
    def tip_alteration(self) -> Pair:
        """k_1, k_2 [module]; negative where tips are shortened."""
        if self.given_tip_radius is not None:
            h, x = self._tip_height, self.profile_shift
            return h[0] - self.addendum - x[0], h[1] - self.addendum - x[1]
        rule = self.tip or ("none" if self.internal else "full")
        if not isinstance(rule, str):
            return rule
        lost = self._full_shortening if rule == "full" else 0.0
        return 0.0 - lost, 0.0 - lost

    @cached_property
    def tip_shortening(self) -> float | Pair:
        """dy = -k [module], one number where both gears share it; x_1 + x_2 - y where the clearance is kept."""
        one, other = self.tip_alteration
        return 0.0 - one if one == other else (0.0 - one, 0.0 - other)

    @property
    def keeps_clearance(self) -> bool:
        """Whether full tip shortening leaves exactly the clearance of the profile between tips and roots."""
        full = (self.tip or ("none" if self.internal else "full")) == "full"
        placed_once = self.given_shift is None or self.given_distance is None
        return full and placed_once and self.given_tip_radius is None and self.tools == (None, None)

    @cached_property
    def _tip_height(self) -> Pair:
        """h_a* + x + k [module], tip circle above reference circle."""
        if self.given_tip_radius is not None:
            r, given = self.reference_radius, self.given_tip_radius
            return (given[0] - r[0]) / self.module, (self.signs[1] * given[1] - r[1]) / self.module
        x, k = self.profile_shift, self.tip_alteration
        return self.addendum + x[0] + k[0], self.addendum + x[1] + k[1]

    @cached_property
    def tip_radius(self) -> Pair:
        """r_a = r + (h_a* + x + k) m [mm]."""
        r, h = self.reference_radius, self._tip_height
        return r[0] + self.module * h[0], r[1] + self.module * h[1]

    def tool(self, gear: int) -> RackTool:
        """The rack tool of a gear: the given one, or that of the profile."""
        from gearlink.core.parts.gears.tooth.tools import tool_of_profile

        return self.tools[gear] or tool_of_profile(self.pressure_angle, self.addendum, self.clearance)

    def root_depth(self, gear: int) -> float:
        """h_fP* of a gear's tool [module]."""
        tool = self.tools[gear]
        return self.addendum + self.clearance if tool is None else tool.addendum

    @cached_property
    def shaped(self) -> ShapedRing | None:
        """The ring as its pinion cutter leaves it; None without one."""
        if self.cutter is None or not self.internal:
            return None
        return self._kind_of_ring()(
            module=self.module,
            teeth=self.teeth[1],
            shift=self.profile_shift[1],
            cutter=self.cutter,
            pressure_angle=self.pressure_angle,
            helix_angle=self.helix_angle,
        )

    def _kind_of_ring(self) -> type[ShapedRing]:
        from gearlink.core.parts.gears.mesh.ring_cutter import ShapedRing

        return ShapedRing

    @cached_property
    def root_radius(self) -> Pair:
        """r_f = r - (h_fP* - x) m [mm]; of a ring that a pinion cutter shapes what it leaves."""
        r, x = self.reference_radius, self.profile_shift
        first = r[0] - self.module * (self.root_depth(0) - x[0])
        rack_cut = r[1] - self.module * (self.root_depth(1) - x[1])
        return first, rack_cut if self.shaped is None else -self.shaped.root_radius

    @cached_property
    def tip_clearance(self) -> Pair:
        """c_1 = a_w - r_a1 - r_f2 and c_2 = a_w - r_f1 - r_a2 [mm], between a gear's tip and the mating gear's root."""
        a, tip, root = self.center_distance, self.tip_radius, self.root_radius
        return a - tip[0] - root[1], a - root[0] - tip[1]

    def _tip_rise_of(self, gear: int) -> float:
        """alpha_a - alpha_t [rad] of one gear (0 or 1)."""
        height = self.signs[gear] * self.module * self._tip_height[gear]
        radius = abs(self.reference_radius[gear])
        try:
            return self._rise_to(radius, height)
        except NoSolution:
            raise no_involute_at_tip(self, gear) from None

    @cached_property
    def _tip_rise(self) -> Pair:
        return self._tip_rise_of(0), self._tip_rise_of(1)

    @property
    def ring_tip_margin(self) -> float:
        """How far the tips of a ring stay outside its base circle [mm]; negative where they have no involute."""
        return self.base_radius[1] - self.tip_radius[1]

    @cached_property
    def tip_pressure_angle(self) -> Pair:
        """Transverse pressure angle alpha_a on the tip circle [rad]: cos(alpha_a) = r_b/r_a."""
        alpha = self.transverse_pressure_angle
        return alpha + self._tip_rise[0], alpha + self._tip_rise[1]

    @cached_property
    def tip_thickness(self) -> Pair:
        """s_an = r_a (s_t/r - 2 (inv(alpha_a) - inv(alpha_t))) cos(beta_a) [mm]; negative where flanks cross."""
        return self._tip_thickness_of(0), self._tip_thickness_of(1)

    def _tip_thickness_of(self, gear: int) -> float:
        angle = (math.pi + 4.0 * self.profile_shift[gear] * self.fn.tan(self.pressure_angle)) / self.teeth[gear]
        lost = self.fn.involute_rise(self.transverse_pressure_angle, self._tip_rise[gear])
        return self.tip_radius[gear] * (angle - 2.0 * lost) * self.cos_helix_at(self.tip_radius[gear], gear)

    def cos_helix_at(self, radius: float, gear: int) -> float:
        """cos(beta_y) on a circle: tan(beta_y) = r_y/r tan(beta); exactly 1 for spur gears."""
        return 1.0 / self.fn.hypot(1.0, radius / self.reference_radius[gear] * self.fn.tan(self.helix_angle))

    @cached_property
    def _action(self) -> Pair:
        """z (tan(alpha_a) - tan(alpha_wt)), the way of contact from pitch point to tip in base circle angle z.

        tan(alpha_a) - tan(alpha_wt) = (r_a^2 - r_w^2)/(r_b^2 (tan(alpha_a) + tan(alpha_wt)))
        """
        return self._action_of(0), self._action_of(1)

    def _action_of(self, gear: int) -> float:
        z, y = self.teeth[gear], self.center_distance_modification
        above = self.module * (self._tip_height[gear] - y * z / self._teeth_sum)
        squares = above * (self.tip_radius[gear] + self.working_radius[gear]) / self.base_radius[gear] ** 2
        return z * squares / (self.fn.tan(self.tip_pressure_angle[gear]) + self.fn.tan(self.working_pressure_angle))

    @cached_property
    def contact_ratio(self) -> float:
        """eps = (z_1 (tan(alpha_a1) - tan(alpha_wt)) + z_2 (tan(alpha_a2) - tan(alpha_wt)))/(2 pi), the nominal one."""
        return (self._action[0] + self._action[1]) / (2.0 * math.pi)

    def _left_at_root(self, gear: int) -> float:
        """z tan(alpha_wt) - z_mate (tan(alpha_a,mate) - tan(alpha_wt)): what the mate's tip leaves of the line."""
        return self.teeth[gear] * self.fn.tan(self.working_pressure_angle) - self._action[1 - gear]

    @cached_property
    def interference_margin(self) -> Pair:
        """How far the tip of a gear stays short of the mating gear's base tangent point on the line of action [mm].

        a_w sin(alpha_wt) - sqrt(r_a^2 - r_b^2) for external pairs; negative where the tip meets the mate beyond its
        involute.
        """
        scale = self.transverse_module * self.fn.cos(self.transverse_pressure_angle) / 2.0
        return self.signs[1] * scale * self._left_at_root(1), scale * self._left_at_root(0)

    @cached_property
    def specific_sliding(self) -> Pair:
        """1 - (w_mate rho_mate)/(w rho) at the root end of the active flank, contact at the mating gear's tip [1]."""
        return self._specific_sliding_of(0), self._specific_sliding_of(1)

    def _specific_sliding_of(self, gear: int) -> float:
        if not self._left_at_root(gear) * self.signs[gear] > 0.0:
            raise NoSolution(
                f"tip of gear {2 - gear} beyond the base tangent point of gear {gear + 1}: "
                f"{short(-self.interference_margin[1 - gear])} mm (limit < 0 mm: sliding is infinite there)",
                fix="reduce its profile shift or the addendum, or use more teeth",
            )
        return self._sliding_at_root(gear)

    def _sliding_at_root(self, gear: int) -> float:
        return -self._action[1 - gear] * self._teeth_sum / (self.teeth[1 - gear] * self._left_at_root(gear))

    @property
    def slides(self) -> bool:
        """Whether both root ends of the flanks in contact lie on their involutes, where sliding has a bound."""
        return self.fn.least(*self.interference_margin) > 0.0

    def min_shift_of(self, gear: int) -> float:
        """x_min of an external gear [module]: to the profile's addendum, or to where its tool's straight flank ends.

        Source
            own derivation: the cutter's tip line passes the point where the line of action touches the base circle
        """
        sine = self.fn.sin(self.transverse_pressure_angle)
        return self._straight_height(gear) - self.teeth[gear] * sine**2 / 2.0 / self._cos_helix

    def min_teeth_of(self, gear: int) -> float:
        """z_min of an external gear, at its profile shift."""
        height, sine = self._straight_height(gear), self.fn.sin(self.transverse_pressure_angle)
        return 2.0 * self._cos_helix * (height - self.profile_shift[gear]) / sine**2

    def _straight_height(self, gear: int) -> float:
        """How far the straight flank of a gear's tool reaches below its datum line [module]."""
        tool = self.tools[gear]
        return self.addendum if tool is None else tool.straight_end(self.pressure_angle)

    @cached_property
    def min_shift_no_undercut(self) -> tuple[float, float | None]:
        """x_min = h - z sin^2(alpha_t)/(2 cos(beta)) [module], for a rack tool; a ring has none."""
        return self.min_shift_of(0), None if self.internal else self.min_shift_of(1)

    @cached_property
    def min_teeth_no_undercut(self) -> tuple[float, float | None]:
        """z_min = 2 cos(beta) (h - x)/sin^2(alpha_t), for a rack tool; a ring has none."""
        return self.min_teeth_of(0), None if self.internal else self.min_teeth_of(1)

    @cached_property
    def roots(self) -> tuple[RackCutRoot, RackCutRoot]:
        """The roots as their tools leave them, in modules; what it says of a ring is nothing."""
        made = self._kind_of_root()
        return by_gear(
            lambda gear: made(
                teeth=self.teeth[gear],
                shift=self.profile_shift[gear],
                tool=self.tool(gear),
                pressure_angle=self.pressure_angle,
                helix_angle=self.helix_angle,
            )
        )

    def _kind_of_root(self) -> type[RackCutRoot]:
        from gearlink.core.parts.gears.tooth.root_fillet import RackCutRoot

        return RackCutRoot

    @cached_property
    def form_radius(self) -> tuple[float | None, float | None]:
        """r_Ff [mm], where the flank ends towards the root; None for a ring without cutter, and for a pointed tool."""
        return self.form_radius_of(0), self.form_radius_of(1)

    def form_radius_of(self, gear: int) -> float | None:
        """r_Ff of one gear [mm]."""
        if self.teeth[gear] < 0:
            return None if self.shaped is None else -self.shaped.form_radius
        if self.tool(gear).rounding_center(self.pressure_angle) < 0.0:
            return None
        return self.module * self.roots[gear].form_radius

    @cached_property
    def span_teeth(self) -> tuple[int, int | None]:
        """Numbers k of teeth (of a ring: spaces) whose span measurement touches nearest to the circle r + x m.

        Where a tool is given the planes must touch between form and tip circle, if any k lets them; a helical ring
        has no span.
        """
        return self._span_teeth_of(0) or 1, self._span_teeth_of(1)

    def _span_teeth_of(self, gear: int) -> int | None:
        if self.teeth[gear] < 0 and self.helix_angle != 0.0:
            return None
        given, (z, x) = self.given_spans[gear], self._spanned(gear)
        if given is not None:
            return given
        low, high = teeth.span_rivals(z, x, self.pressure_angle, self.helix_angle)
        k = high[0] if high[1] < low[1] else low[0]
        form = self.form_radius[gear] if self.tools[gear] is not None else None
        if form is None:
            return k
        inside = [n for n in range(1, z + 1) if form < self.span_contact(gear, n) < self.tip_radius[gear]]
        return min(inside, key=lambda n: abs(n - k), default=k)

    def span_contact(self, gear: int, count: int) -> float:
        """Radius on which the planes of a span measurement over so many teeth touch [mm]."""
        return teeth.span_contact_radius(self.base_radius[gear], self.span_over(gear, count), self.base_helix_angle)

    def _spanned(self, gear: int) -> tuple[int, float]:
        """Teeth and shift of the external gear that a span measurement sees: the spaces of a ring are its teeth."""
        sign = -1 if gear == 1 and self.internal else 1
        return sign * self.teeth[gear], sign * self.profile_shift[gear]

    @cached_property
    def span_measurement(self) -> tuple[float, float | None]:
        """W_k over span_teeth = m cos(alpha_n) (pi (k - 1/2) + z inv(alpha_t)) + 2 x m sin(alpha_n) [mm]."""
        k1, k2 = self.span_teeth
        return self.span_over(0, k1), None if k2 is None else self.span_over(1, k2)

    def span_over(self, gear: int, count: int, shift: float | None = None) -> float:
        """W_k of a gear over so many teeth [mm], of a ring over so many spaces; `shift` is a generating one."""
        z, x = self._spanned(gear)
        x = x if shift is None else math.copysign(1.0, self.teeth[gear]) * shift
        return teeth.span_measurement(self.module, z, x, self.pressure_angle, count, self.helix_angle, self.fn)
