"""A gear pair with all that its drawing needs, and its quantities by name."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.parts.gears.drawing_names import GEARS, PLACES, Roles
from gearlink.core.parts.gears.measures.inspection import Ball, chord, preferred_pin
from gearlink.core.parts.gears.mesh.contact import PathOfContact
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.mesh.pitch_pair import Both, Pair, by_gear
from gearlink.core.parts.gears.rating.flank_strength import FlankStrength
from gearlink.core.parts.gears.rating.load import Factors, Load, Material, Required
from gearlink.core.parts.gears.rating.root_stress import RootStress
from gearlink.core.parts.gears.tooth.tools import RackTool

if TYPE_CHECKING:
    from gearlink.core.parts.gears.measures.allowances import Backlash
    from gearlink.core.parts.gears.measures.iso_1328 import ToothTolerances
    from gearlink.core.parts.gears.mesh.ring_cutter import InternalInterference, ShapedRing
    from gearlink.core.parts.gears.rating.conditions import Conditions
    from gearlink.core.parts.gears.rating.rated import Rated
    from gearlink.core.parts.gears.rating.true_root import TrueRoot

_OF_TIP_LOAD = frozenset(("tip_form_factor", "tip_stress_correction_factor", "contact_ratio_factor_bending"))
"""Of method C: for comparison with a rating that was made by it."""
_LIVES = frozenset(("pitting_life", "bending_life"))
"""Without a value of either gear where none of them is damaged, which is known."""
_REQUIRED = Required()
MAGNITUDES = frozenset(
    (
        *("center_distance", "reference_center_distance", "reference_radius", "base_radius", "working_radius"),
        *("tip_radius", "root_radius", "used_root_radius", "form_radius"),
    )
)


@dataclass(frozen=True, kw_only=True)
class GearData:
    """A gear pair with its widths, allowances, load and materials; parts are computed when they are asked for.

    Parameters
        face_width : (float, float) or None [mm] - of gear 1 and 2
        pins : (float or None, float or None) [mm] - diameters of measuring balls; None: a preferred one
        allowances : ((upper, lower), (upper, lower)) or None [mm] - E_sns, E_sni of gear 1 and 2
        distance_allowance : float or None [mm] - plus and minus of the centre distance
        materials : (Material, Material)
        edition : int - of ISO 6336
        load_share : str - "third" or "half", what a pair of flanks carries beside another
        rims : (float or None, float or None) [mm] - rim under the tooth roots; None: solid
        accuracy_grade : int or None - of ISO 1328
        idlers : (bool, bool) - gears that have another mate besides
        roles : (str, str) - what findings call the two gears
        conditions : Conditions or None - of the rating with all factors; None: K and life factors are inputs
        required : Required - the safeties asked for
    """

    pair: GearPair
    face_width: Pair | None = None
    pins: Both = (None, None)
    allowances: tuple[Pair, Pair] | None = None
    distance_allowance: float | None = None
    load: Load | None = None
    materials: tuple[Material, Material] = (Material(), Material())
    edition: int = 2006
    load_share: str = "third"
    rims: Both = (None, None)
    accuracy_grade: int | None = None
    idlers: tuple[bool, bool] = (False, False)
    roles: Roles = GEARS
    conditions: Conditions | None = None
    required: Required = _REQUIRED

    @cached_property
    def path(self) -> PathOfContact:
        """The path of contact, with the lesser width."""
        return PathOfContact(self.pair, self._common_width)

    @property
    def _common_width(self) -> float | None:
        return None if self.face_width is None else min(self.face_width)

    @cached_property
    def internal(self) -> InternalInterference | None:
        """The interferences of a pinion in a ring; None for an external pair."""
        return interference(self.pair) if self.pair.internal else None

    @cached_property
    def pin_diameter(self) -> Both:
        """D of the balls that measure each gear [mm]."""
        return by_gear(lambda gear: preferred_pin(self.pair, gear) if self.pins[gear] is None else self.pins[gear])

    def ball(self, gear: int, shift: float | None = None) -> Ball | None:
        """The ball in a space of a gear; None where it falls through."""
        diameter = self.pin_diameter[gear]
        if diameter is None:
            return None
        ball = Ball(pair=self.pair, gear=gear, diameter=diameter, shift=shift)
        try:
            return ball if ball.pressure_angle > 0.0 else None
        except NoSolution:
            return None

    def _over_balls(self, gear: int, shift: float | None = None) -> float | None:
        ball = self.ball(gear, shift)
        return None if ball is None else ball.over_balls

    @property
    def measure_over_balls(self) -> Both:
        """M over (in a ring between) two balls [mm]."""
        return by_gear(self._over_balls)

    @property
    def measure_over_pins(self) -> Both:
        """M over two pins [mm]; a helical ring takes none."""
        one, other = self.ball(0), self.ball(1)
        return None if one is None else one.over_pins, None if other is None else other.over_pins

    @cached_property
    def _chords(self) -> tuple[Pair, Pair]:
        return by_gear(lambda gear: chord(self.pair, gear))

    @property
    def chordal_thickness(self) -> Pair:
        """s_c on the reference circle [mm]."""
        return self._chords[0][0], self._chords[1][0]

    @property
    def chordal_height(self) -> Pair:
        """h_c of that chord below the tip [mm]."""
        return self._chords[0][1], self._chords[1][1]

    @cached_property
    def generating_shift(self) -> tuple[Pair, Pair] | None:
        """x_E of each gear, minimum and maximum [module]: x + E_sn/(2 m tan(alpha_n))."""
        return None if self.allowances is None else by_gear(self._generated)

    def _generated(self, gear: int) -> Pair:
        assert self.allowances is not None
        upper, lower = self.allowances[gear]
        x, over = self.pair.profile_shift[gear], 2.0 * self.pair.module * math.tan(self.pair.pressure_angle)
        return x + lower / over, x + upper / over

    @property
    def cut_shift(self) -> Pair:
        """x_E of the upper allowances, nominal without allowances [module]."""
        found = self.generating_shift
        if self.conditions is not None and not self.conditions.generating_root:
            return self.pair.profile_shift
        return self.pair.profile_shift if found is None else (found[0][1], found[1][1])

    @cached_property
    def span_measurement_limits(self) -> tuple[Pair | None, Pair | None] | None:
        """W_k of each gear with its minimum and maximum thickness [mm]; of a ring the other way round."""
        shifts, spans = self.generating_shift, self.pair.span_teeth
        if shifts is None:
            return None

        def ends(gear: int) -> Pair | None:
            count = spans[gear]
            if count is None:
                return None
            low, high = sorted(self.pair.span_over(gear, count, shift) for shift in shifts[gear])
            return low, high

        return by_gear(ends)

    @cached_property
    def measure_limits(self) -> tuple[Both | None, Both | None] | None:
        """M over balls of each gear, minimum and maximum [mm]."""
        shifts = self.generating_shift
        if shifts is None:
            return None

        def ends(gear: int) -> Both | None:
            found = [self._over_balls(gear, shift) for shift in shifts[gear]]
            known = sorted(each for each in found if each is not None)
            return (known[0], known[1]) if len(known) == 2 else None

        return by_gear(ends)

    @cached_property
    def backlash(self) -> Backlash | None:
        """Minimum and maximum backlash; None where the file leaves none open."""
        both_given = self.pair.given_shift is not None and self.pair.given_distance is not None
        if self.allowances is None and self.distance_allowance is None and not both_given:
            return None
        one, other = self.allowances or ((0.0, 0.0), (0.0, 0.0))
        from gearlink.core.parts.gears.measures.allowances import Backlash

        return Backlash(
            pair=self.pair,
            upper=(one[0], other[0]),
            lower=(one[1], other[1]),
            distance_allowance=self.distance_allowance or 0.0,
        )

    @cached_property
    def flank(self) -> FlankStrength:
        """Surface durability."""
        return FlankStrength(path=self.path, load=self.load, materials=self.materials)

    def cutting_tool(self, gear: int) -> RackTool:
        """The rack tool whose fillet the root of a gear has, or what stands for it in a ring."""
        if gear == 1 and self.cut_ring is not None:
            return self.cut_ring.substitute
        return self.pair.tool(gear)

    @cached_property
    def cut_ring(self) -> ShapedRing | None:
        """The ring as its cutter leaves it at the upper allowance, to whose thickness it goes deeper; None without."""
        shaped = self.pair.shaped
        return None if shaped is None else replace(shaped, shift=self.cut_shift[1])

    @cached_property
    def root(self) -> RootStress:
        """Root strength, at the upper allowances."""
        return RootStress(**self._of_roots)

    @property
    def _of_roots(self) -> dict[str, Any]:
        return {
            "path": self.path,
            "tools": (self.cutting_tool(0), self.cutting_tool(1)),
            "shifts": self.cut_shift,
            "widths": self.face_width,
            "load": self.load,
            "materials": self.materials,
            "edition": self.edition,
            "rims": self.rims,
            "accuracy_grade": self.accuracy_grade,
            "idlers": self.idlers,
            **self._ring_fillet,
        }

    @property
    def _ring_fillet(self) -> dict[str, Any]:
        """What the root of a shaped ring takes its fillet radius from."""
        shaped = self.cut_ring
        if shaped is None:
            return {}
        if self.conditions is not None and not self.conditions.generated_ring:
            return {"standard_ring": True}
        return {"ring_fillet": shaped.fillet_radius}

    @cached_property
    def rated(self) -> Rated | None:
        """The rating with all factors; None of a file without one."""
        if self.conditions is None or self.load is None:
            return None
        from gearlink.core.parts.gears.rating.rated import Rated

        return Rated(data=self, conditions=self.conditions, load=self.load, given=self.load.given)

    @property
    def tolerances(self) -> tuple[ToothTolerances, ToothTolerances] | None:
        """Of ISO 1328-1, of the rating's grade and edition or of `accuracy_grade` by that of 2013.

        None without a grade or a width, or outside of the standard's range.
        """
        if self.rated is not None:
            return self.rated.bodies.tolerances
        if self.accuracy_grade is None or self.face_width is None:
            return None
        from gearlink.core.parts.gears.measures.iso_1328 import ToothTolerances

        grade, widths, pair = self.accuracy_grade, self.face_width, self.pair
        diameters = [2.0 * abs(radius) for radius in pair.reference_radius]
        try:
            return by_gear(
                lambda i: ToothTolerances(grade=grade, module=pair.module, diameter=diameters[i], width=widths[i])
            )
        except NoSolution:
            return None

    @property
    def factors(self) -> Factors:
        """The K factors, given or computed."""
        if self.rated is not None:
            return self.rated.factors
        return Factors() if self.load is None else self.load.factors

    @property
    def contact_stress(self) -> Both | None:
        """sigma_H of gear 1 and 2."""
        return self.flank.stress_under(self.factors)

    @property
    def root_stress(self) -> Both | None:
        """sigma_F of gear 1 and 2."""
        return self.root.stress_under(self.factors)

    @property
    def safety_pitting(self) -> Both | None:
        """S_H of gear 1 and 2."""
        return self.flank.safety if self.rated is None else self.rated.safety_pitting

    @property
    def safety_bending(self) -> Both | None:
        """S_F of gear 1 and 2."""
        return self.root.safety if self.rated is None else self.rated.safety_bending

    @cached_property
    def true_roots(self) -> tuple[TrueRoot | None, TrueRoot | None]:
        """The roots as they are generated, for the boundary integral; None of one that is not known."""
        from gearlink.core.parts.gears.rating.true_root import true_root

        return by_gear(lambda gear: true_root(self, gear))

    @property
    def generated_root_factor(self) -> Both:
        """Maximum tension on the generated fillet over F_t/(b m)."""
        one, other = (None if root is None else root.tension.factor for root in self.true_roots)
        return one, other

    @property
    def root_stress_scale(self) -> Pair:
        """F_t/(b m) Y_beta K_A K_gamma K_v K_Fbeta K_Falpha of each gear [N/mm^2]; 0 without load or width."""
        widths, turned = self.root.bearing_width, self.root.helix_angle_factor
        if self.load is None or widths is None or turned is None:
            return 0.0, 0.0
        line = self.load.tangential_force(self.pair.reference_radius[0]) / self.pair.module * turned
        line *= self.factors.bending
        return line / widths[0], line / widths[1]

    @property
    def generated_root_stress(self) -> Both | None:
        """The same with the load and all its factors [N/mm^2]; None without load or width."""
        return self.root_stress_of(self.generated_root_factor)

    def root_stress_of(self, factors: Sequence[float | None]) -> Both | None:
        """Stress of roots by their factors over F_t/(b m) [N/mm^2]; None without load or width."""
        scale = self.root_stress_scale
        if not any(scale):
            return None
        one, other = (None if factor is None else factor * each for factor, each in zip(factors, scale, strict=True))
        return one, other

    @property
    def measured(self) -> tuple[int, ...]:
        """The gears that balls measure."""
        return 0, 1

    def called(self, gear: int) -> str:
        """What findings call gear 0 or 1."""
        return self.roles[gear]

    def rated_with(self, _gear: int) -> str:
        """What a root needs so that it can be rated, in words."""
        return "use more teeth or a smaller rounding"

    def quantity(self, name: str) -> Any:
        """A quantity by name, its radii and distances as magnitudes; None where it does not apply."""
        if name in _OF_TIP_LOAD and self.load is None:
            return None
        if name in _LIVES and self.rated is not None:
            return getattr(self.rated, name)
        value: Any = self
        for step in PLACES.get(name, name).split("."):
            value = _part(value, step)
        return shown(name, value)


def _part(value: Any, name: str) -> Any:
    """An attribute of a value, or of that of each gear; None of None."""
    if isinstance(value, tuple):
        return tuple(_part(each, name) for each in value)
    return None if value is None else getattr(value, name)


def interference(pair: GearPair) -> InternalInterference:
    """What may keep a pinion and a ring from turning."""
    from gearlink.core.parts.gears.mesh.ring_cutter import InternalInterference

    return InternalInterference(pair)


def shown(name: str, value: Any) -> Any:
    """A value as results give it: magnitudes of radii and distances, None where both gears have none."""
    if isinstance(value, tuple):
        both = shown("", value[0]), *(shown(name, each) for each in value[1:])  # gear 1 is no ring
        return None if all(each is None for each in both) else both
    if value is None or (isinstance(value, float) and not math.isfinite(value)):
        return None
    return abs(value) if name in MAGNITUDES else value
