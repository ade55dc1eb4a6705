"""A cylindrical gear pair without its heights: pressure angles, centre distance, shifts, circles that roll.

Signs are those of ISO 21771: a ring has negative teeth, and with them its radii, the centre distance and the gear
ratio are negative; every formula then holds for both kinds. The shift multiplies the normal module.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar, TypeVar

from gearlink.core.base.results import cached_property
from gearlink.core.parts.gears.tooth import teeth
from gearlink.core.parts.gears.tooth.teeth import SCALARS, GearFunctions

Pair = tuple[float, float]
Both = tuple[float | None, float | None]
T = TypeVar("T")


def by_gear(value: Callable[[int], T]) -> tuple[T, T]:
    """A value of gear 1 and of gear 2, by their places 0 and 1."""
    return value(0), value(1)


@dataclass(frozen=True, kw_only=True)
class PitchPair:
    """What module, teeth, angles, and shifts or centre distance fix of a gear pair.

    Parameters
        module : float [mm] - normal module m > 0
        teeth : (int, int) - z_1 >= 1; z_2 >= 1, or negative for a ring with |z_2| > z_1
        pressure_angle : float [rad] - alpha_n of the reference profile, 0 < alpha_n < pi/2
        helix_angle : float [rad] - magnitude of beta, 0 <= beta < pi/2
        given_shift : (float, float) or None [module] - x_1, x_2
        given_distance : float or None [mm] - a_w, its magnitude; with shifts that do not suit it there is backlash
        given_first_shift : float or None [module] - x_1 beside a centre distance; None shares equally
    Returns
        Properties: lengths in mm, angles in rad, coefficients in modules; a pair is (gear 1, gear 2). Radii of a
        ring and the centre distance of its pair are negative.

    Source
        ISO 21771; the difference forms are an own derivation
    """

    module: float
    teeth: tuple[int, int]
    pressure_angle: float = math.radians(20.0)
    given_shift: Pair | None = None
    given_distance: float | None = None
    given_first_shift: float | None = None
    helix_angle: float = 0.0

    fn: ClassVar[GearFunctions] = SCALARS
    """What the formulas are made of; the class of many pairs has those for arrays."""

    @property
    def _teeth_sum(self) -> int:
        return self.teeth[0] + self.teeth[1]

    @property
    def internal(self) -> bool:
        """Whether gear 2 is a ring."""
        return self.teeth[1] < 0

    @property
    def signs(self) -> Pair:
        """1 for an external gear, -1 for a ring."""
        return 1.0, self.fn.copysign(1.0, self.teeth[1])

    @property
    def gear_ratio(self) -> float:
        """u = z_2/z_1, negative with a ring."""
        return self.teeth[1] / self.teeth[0]

    @property
    def _cos_helix(self) -> float:
        return self.fn.cos(self.helix_angle)

    @property
    def transverse_module(self) -> float:
        """m_t = m/cos(beta) [mm]."""
        return self.module / self._cos_helix

    @cached_property
    def transverse_pressure_angle(self) -> float:
        """alpha_t [rad]: tan(alpha_t) = tan(alpha_n)/cos(beta)."""
        return teeth.transverse(self.pressure_angle, self.helix_angle, self.fn)

    @cached_property
    def base_helix_angle(self) -> float:
        """beta_b [rad]: sin(beta_b) = sin(beta) cos(alpha_n)."""
        return self.fn.asin(self.fn.sin(self.helix_angle) * self.fn.cos(self.pressure_angle))

    @cached_property
    def base_pitch(self) -> float:
        """p_et = pi m_t cos(alpha_t) [mm], from one contact point to the next in the transverse section."""
        return math.pi * self.transverse_module * self.fn.cos(self.transverse_pressure_angle)

    @cached_property
    def _rise(self) -> float:
        """alpha_wt - alpha_t [rad]."""
        if self.given_distance is None:
            tangent = self.fn.tan(self.pressure_angle)
            alpha = self.transverse_pressure_angle
            return self.fn.rise_of_involute(alpha, 2.0 * self.shift_sum * tangent / self._teeth_sum)
        a = abs(self.reference_center_distance)
        return self._rise_to(a, self.given_distance - a, "centre distance")

    def _rise_to(self, radius: float, increase: float, what: str = "radius") -> float:
        """Rise of the transverse pressure angle from one radius to another [rad].

        Raises
            NoSolution - inside the base circle
        """
        return teeth.pressure_angle_rise(radius, increase, self.transverse_pressure_angle, what=what)

    @cached_property
    def working_pressure_angle(self) -> float:
        """Pressure angle alpha_wt of the mesh [rad]: cos(alpha_wt) = a cos(alpha_t)/a_w."""
        return self.transverse_pressure_angle + self._rise

    @cached_property
    def reference_center_distance(self) -> float:
        """a = m_t (z_1 + z_2)/2 [mm]."""
        return self.transverse_module * self._teeth_sum / 2.0

    @cached_property
    def center_distance(self) -> float:
        """a_w [mm]: the given one, or a + y m."""
        if self.given_distance is not None:
            return self.fn.copysign(self.given_distance, self._teeth_sum)
        return self.reference_center_distance + self.module * self.center_distance_modification

    @cached_property
    def center_distance_modification(self) -> float:
        """y = (a_w - a)/m = (z_1 + z_2) sin((alpha_wt + alpha_t)/2) sin((alpha_wt - alpha_t)/2)
        /(cos(alpha_wt) cos(beta)) [module].
        """
        if self.given_distance is not None:
            return (self.center_distance - self.reference_center_distance) / self.module
        half = self._rise / 2.0
        product = self.fn.sin(self.transverse_pressure_angle + half) * self.fn.sin(half)
        return self._teeth_sum * product / self.fn.cos(self.working_pressure_angle) / self._cos_helix

    @cached_property
    def shift_sum(self) -> float:
        """x_1 + x_2 = (z_1 + z_2)(inv(alpha_wt) - inv(alpha_t))/(2 tan(alpha_n)) [module], that of the mesh."""
        if self.given_distance is None and self.given_shift is not None:
            return self.given_shift[0] + self.given_shift[1]
        difference = self.fn.involute_rise(self.transverse_pressure_angle, self._rise)
        return self._teeth_sum * difference / (2.0 * self.fn.tan(self.pressure_angle)) + 0.0  # never -0

    @cached_property
    def profile_shift(self) -> Pair:
        """x_1, x_2 [module]."""
        if self.given_shift is not None:
            return self.given_shift
        first = self.shift_sum / 2.0 if self.given_first_shift is None else self.given_first_shift
        return first, self.shift_sum - first

    @cached_property
    def reference_radius(self) -> Pair:
        """r = m_t z/2 [mm]."""
        return self.transverse_module * self.teeth[0] / 2.0, self.transverse_module * self.teeth[1] / 2.0

    @cached_property
    def base_radius(self) -> Pair:
        """r_b = r cos(alpha_t) [mm]."""
        cosine = self.fn.cos(self.transverse_pressure_angle)
        return self.reference_radius[0] * cosine, self.reference_radius[1] * cosine

    @cached_property
    def working_radius(self) -> Pair:
        """r_w = a_w z/(z_1 + z_2) = r_b/cos(alpha_wt) [mm], the pitch circles that roll on each other."""
        a = self.center_distance
        return a * self.teeth[0] / self._teeth_sum, a * self.teeth[1] / self._teeth_sum

    @cached_property
    def tooth_thickness(self) -> Pair:
        """s_n = m (pi/2 + 2 x tan(alpha_n)) [mm], on the reference circle in the normal section."""
        tangent, x = self.fn.tan(self.pressure_angle), self.profile_shift
        return (
            self.module * (math.pi / 2.0 + 2.0 * x[0] * tangent),
            self.module * (math.pi / 2.0 + 2.0 * x[1] * tangent),
        )


def bound_of_shift_sum(pair: PitchPair) -> float:
    """The sum of shifts at which the pressure angle is 0 [module]: -(z_1 + z_2) inv(alpha_t)/(2 tan(alpha_n))."""
    involute_t = pair.fn.involute(pair.transverse_pressure_angle)
    return -(pair.teeth[0] + pair.teeth[1]) * involute_t / (2.0 * pair.fn.tan(pair.pressure_angle))
