"""Scuffing of external pairs by the integral temperature."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from gearlink.core.base.results import cached_property
from gearlink.core.parts.gears.mesh.pitch_pair import Pair

if TYPE_CHECKING:
    from gearlink.core.parts.gears.mesh.contact import PathOfContact
    from gearlink.core.parts.gears.rating.conditions import Conditions
    from gearlink.core.parts.gears.rating.rated import Rated

_TEST_TORQUE = {8: 239.3, 9: 302.0, 10: 372.6, 11: 450.1, 12: 534.5, 13: 626.9, 14: 714.2}
"""Torque of the pinion at each load stage of the test FZG A/8.3/90 [N m]; that of stage 14 in a printed report."""
_KELVIN = 273.15
_LUBRICATION = 1.0
"""X_S of dip lubrication."""
_STRUCTURE = 1.0
"""X_W of steel, case-hardened with usual austenite."""


@dataclass(frozen=True)
class Scuffing:
    """The integral temperature of a pair and the one at which its oil fails.

    Parameters
        rated : Rated - of an external pair, whose conditions have oil temperature and load stage
    Notes
        The pinion, the gear with fewer teeth, drives. Of the tip relief no more counts than the deflection C_eff.

    Source
        ISO/TR 13989-2, ISO/TS 6336-21: nine intermediate values of a KISSsoft report are met, the integral temperature
        to 0.3 %; where a part of the path is longer than a base pitch, from memory
    """

    rated: Rated

    @property
    def _path(self) -> PathOfContact:
        return self.rated.data.path

    @property
    def _conditions(self) -> Conditions:
        return self.rated.conditions

    @property
    def _ratio(self) -> float:
        """u of the wheel over the pinion."""
        one, other = self._path.pair.teeth
        return max(one, other) / min(one, other)

    @cached_property
    def viscosity(self) -> float:
        """eta at the oil temperature [mPa s], by Walther."""
        given = self._conditions
        assert given.viscosity_100 is not None, "given with the load stage"
        assert given.oil_temperature is not None, "given with the load stage"

        def doubled(viscosity: float) -> float:
            return math.log10(math.log10(viscosity + 0.7))

        cold, hot = (math.log10(_KELVIN + each) for each in (40.0, 100.0))
        slope = (doubled(given.viscosity_40) - doubled(given.viscosity_100)) / (hot - cold)
        at = doubled(given.viscosity_40) - slope * (math.log10(_KELVIN + given.oil_temperature) - cold)
        density = 0.89 - 0.0007 * (given.oil_temperature - 15.0)
        return float((10.0 ** (10.0**at) - 0.7) * density)

    @cached_property
    def line_load(self) -> float:
        """w' = w K_v K_Hbeta K_Halpha [N/mm]."""
        at = self.rated.at_load
        return at.line_load * at.dynamic * at.face_contact * at.transverse_contact

    @cached_property
    def helical_factor(self) -> float:
        """K_Bgamma."""
        eps = self.rated.at_load.total_contact_ratio
        if eps <= 2.0:
            return 1.0
        return 1.3 if eps >= 3.5 else 1.0 + 0.2 * math.sqrt((eps - 2.0) * (5.0 - eps))

    @cached_property
    def speed(self) -> float:
        """v on the working circle [m/s]."""
        pair = self._path.pair
        return self.rated.at_load.pitch_line_speed * pair.working_radius[0] / pair.reference_radius[0]

    @cached_property
    def curvature(self) -> float:
        """rho_C at the pitch point [mm]."""
        pair, u = self._path.pair, self._ratio
        sine = math.sin(pair.working_pressure_angle)
        return abs(pair.center_distance) * sine * u / ((1.0 + u) ** 2 * math.cos(pair.base_helix_angle))

    @cached_property
    def friction(self) -> float:
        """mu, the mean coefficient of friction."""
        ra = 0.5 * (self._conditions.ra[0] + self._conditions.ra[1])
        rough = 2.2 * (ra / self.curvature) ** 0.25
        rolling = 2.0 * self.speed * math.sin(self._path.pair.working_pressure_angle)
        pressed = (self.line_load * self.helical_factor / (rolling * self.curvature)) ** 0.2
        return float(0.045 * pressed * self.viscosity**-0.05 * rough)

    @cached_property
    def thermal_flash_factor(self) -> float:
        """X_M of steel with the moduli of the pair."""
        reduced = 2.0 / math.fsum(material.compliance for material in self.rated.data.materials)
        return float(reduced**0.25 * math.sqrt(1000.0) / 13.78)

    @cached_property
    def tip_curvatures(self) -> Pair:
        """rho_E1 and rho_E2 of pinion and wheel where the pinion's tip touches [mm]."""
        path, pinion = self._path, self.rated.bodies.order[0]
        if pinion == 0:
            return path.end, path.line - path.end
        return path.line - path.start, path.start

    @cached_property
    def geometry_factor(self) -> float:
        """X_BE at the pinion's tip."""
        one, other = self.tip_curvatures
        u = self._ratio
        met = abs(math.sqrt(one) - math.sqrt(other / u)) / (one * other) ** 0.25
        return float(0.51 * math.sqrt(u + 1.0) * met)

    @cached_property
    def addendum_contact_ratios(self) -> Pair:
        """eps_1 and eps_2 of pinion and wheel."""
        path = self._path
        beyond, before = path.end - path.pitch, path.pitch - path.start
        ends = (beyond, before) if self.rated.bodies.order[0] == 0 else (before, beyond)
        pitch = path.pair.base_pitch
        return ends[0] / pitch, ends[1] / pitch

    @cached_property
    def contact_ratio_factor(self) -> float:
        """X_eps."""
        return contact_ratio_factor(*self.addendum_contact_ratios)

    @cached_property
    def relief_share(self) -> float:
        """C_a/C_eff, at most 1: of the design, else of running in, over the deflection w/c_gamma."""
        relief = self._conditions.tip_relief
        at = self.rated.at_load
        found = self.rated.running_in_relief if relief is None else relief
        return min(1.0, found * at.mesh_stiffness / at.line_load)

    @cached_property
    def relief_factor(self) -> float:
        """X_Ca."""
        share, eps = self.relief_share, max(self.addendum_contact_ratios)
        return 1.0 + (0.06 + 0.18 * share) * eps + (0.02 + 0.69 * share) * eps * eps

    @cached_property
    def flash_temperature(self) -> float:
        """theta_flaint, the mean flash temperature [K]."""
        hot = self.friction * self.thermal_flash_factor * self.geometry_factor
        hot *= (self.helical_factor * self.line_load) ** 0.75 * math.sqrt(self.speed)
        spread = abs(self._path.pair.center_distance) ** 0.25
        return float(hot / spread * self.contact_ratio_factor / self.relief_factor)

    @cached_property
    def mass_temperature(self) -> float:
        """theta_M [deg C]."""
        oil = self._conditions.oil_temperature
        assert oil is not None, "given with the load stage"
        return oil + 0.7 * _LUBRICATION * self.flash_temperature

    @cached_property
    def integral_temperature(self) -> float:
        """theta_int [deg C]."""
        return self.mass_temperature + 1.5 * self.flash_temperature

    @cached_property
    def scuffing_temperature(self) -> float:
        """theta_Sint of the oil, by its test [deg C]."""
        stage = self._conditions.scuffing_stage
        assert stage is not None, "the rating requires it"
        torque = _TEST_TORQUE[stage]
        thin = (100.0 / self._conditions.viscosity_40) ** 0.02
        return float(80.0 + 0.23 * torque + 0.3 * _STRUCTURE * torque * thin)

    @cached_property
    def safety(self) -> float:
        """S_intS = theta_Sint/theta_int."""
        return self.scuffing_temperature / self.integral_temperature


def contact_ratio_factor(one: float, other: float) -> float:
    """X_eps of the addendum contact ratios of pinion and wheel.

    Example
        >>> round(contact_ratio_factor(0.9, 0.7), 6), round(contact_ratio_factor(1.0, 0.7), 6)
        (0.243056, 0.226176)

    Source
        ISO/TR 13989-2; where one of them is 1 or more, or both together 2 or more, from memory
    """
    eps = one + other
    if eps >= 2.0:
        big, small = (0.44, 0.59) if one >= other else (0.59, 0.44)
        side = 0.3 if one >= other else -0.3
        found = big * one * one + small * other * other + side * (one - other) - 0.15 * one * other
    elif one >= 1.0:
        found = 0.18 * one * one + 0.7 * other * other + 0.82 * one - 0.52 * other - 0.3 * one * other
    elif other >= 1.0:
        found = 0.7 * one * one + 0.18 * other * other - 0.52 * one + 0.82 * other - 0.3 * one * other
    else:
        found = 0.7 * (one * one + other * other) - 0.22 * eps + 0.52 - 0.6 * one * other
    return found / (2.0 * eps * one)
