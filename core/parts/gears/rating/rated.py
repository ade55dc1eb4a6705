"""A pair rated by ISO 6336 with all factors computed: limit stresses, safeties, life and damage."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.parts.gears.mesh.pitch_pair import Pair
from gearlink.core.parts.gears.rating.conditions import Conditions, Point
from gearlink.core.parts.gears.rating.fatigue import LimitLine, damage, limit_line, safety_of
from gearlink.core.parts.gears.rating.load_factors import Bodies, LoadFactors
from gearlink.core.parts.gears.rating.materials import GearSteel

if TYPE_CHECKING:
    from gearlink.core.parts.gears.data import GearData
    from gearlink.core.parts.gears.rating.load import Factors, Load
    from gearlink.core.parts.gears.rating.scuffing import Scuffing

Both = tuple[float | None, float | None]
_STRESS_CORRECTION = 2.0
"""Y_ST of the reference test gears."""
_NOTCH = ((300.0, 0.0833), (400.0, 0.0445), (500.0, 0.0281), (600.0, 0.0194), (800.0, 0.0064), (1000.0, 0.0014))
"""Yield point and rho' [mm] of steels that are not hardened at the surface."""
_SURFACE = {
    "steel": (1.674, 0.529, 0.1, 1.12),
    "normalized": (5.306, 4.203, 0.01, 1.07),
    "iron": (4.299, 3.259, 0.0058, 1.025),
}
"""Constants of Y_RrelT, and its value below Rz 1 um."""
_SIZE = {"soft": (1.03, 0.006, 30.0), "hard": (1.05, 0.01, 25.0), "iron": (1.075, 0.015, 25.0)}
"""Constants of Y_X from module 5 to the one named, from which on it stays."""
_SOFTENED = (130.0, 470.0)
"""HBW between which Z_W falls from 1.2 to 1."""
REVERSED = 0.7
"""Y_M of teeth that are bent both ways, those of idlers and planets."""


@dataclass(frozen=True, kw_only=True)
class Rated:
    """The rating of a pair.

    Parameters
        data : GearData - whose nominal stresses do not depend on the rating
        conditions : Conditions
        load : Load - with speed
        given : frozenset of str - names of the factors that the file gives
    Raises
        NoSolution - sizes outside of ISO 1328-1, key rating.grade

    Source
        ISO 6336-1, -2, -3, -5 and -6, as public programs and three KISSsoft reports have them; no standard was opened
    """

    data: GearData
    conditions: Conditions
    load: Load
    given: frozenset[str]

    @cached_property
    def bodies(self) -> Bodies:
        """What does not change with the load."""
        widths = self.data.face_width
        assert widths is not None, "a file with a rating gives them"
        return Bodies(path=self.data.path, widths=widths, materials=self.data.materials, conditions=self.conditions)

    def factors_at(self, point: Point) -> LoadFactors:
        """The load factors at a point of the spectrum."""
        ratio = self.data.flank.contact_ratio_factor
        if ratio is None:
            raise NoSolution(f"contact ratio {self.data.path.contact_ratio:.4g}: ISO 6336 rates none above 4")
        return LoadFactors(
            bodies=self.bodies, load=self.load, given=self.given, point=point, contact_ratio_factor=ratio
        )

    @cached_property
    def at_load(self) -> LoadFactors:
        """The load factors of the load itself."""
        return self.factors_at(Point())

    @cached_property
    def factors(self) -> Factors:
        """The K factors of the load itself, given or computed."""
        at = self.at_load
        return replace(
            self.load.factors,
            dynamic=at.dynamic,
            face_contact=at.face_contact,
            face_bending=at.face_bending,
            transverse_contact=at.transverse_contact,
            transverse_bending=at.transverse_bending,
        )

    @property
    def steels(self) -> tuple[GearSteel, GearSteel]:
        """The materials."""
        return self.conditions.steels

    # Load cycles

    def cycles_at(self, gear: int, point: Point) -> float:
        """Load cycles of a gear in a part of its life."""
        teeth, at = self.data.pair.teeth, self.load.speed
        assert at is not None, "a file with a rating gives it"
        turns = 60.0 * at * point.speed * self.conditions.life * point.share * abs(teeth[0] / teeth[gear])
        return turns * self.conditions.contacts[gear]

    @cached_property
    def load_cycles(self) -> Pair:
        """N_L = 60 n L_h times the load contacts per revolution, of the load itself."""
        return self.cycles_at(0, Point()), self.cycles_at(1, Point())

    # Flank

    @cached_property
    def contact_limits(self) -> Pair:
        """sigma_Hlim."""
        return self.steels[0].contact_limit, self.steels[1].contact_limit

    @property
    def softer_limit(self) -> float:
        """The lesser sigma_Hlim of the pair, for the lubricant film."""
        return min(self.contact_limits)

    @cached_property
    def lubricant_constant(self) -> float:
        """C_ZL."""
        limit = self.softer_limit
        if limit < 850.0:
            return 0.83
        return 0.91 if limit > 1200.0 else limit / 4375.0 + 0.6357

    @cached_property
    def lubricant_factor(self) -> float:
        """Z_L."""
        c = self.lubricant_constant
        return c + 4.0 * (1.0 - c) / (1.2 + 134.0 / self.conditions.viscosity_40) ** 2

    def velocity_factor_at(self, speed: float) -> float:
        """Z_V at a pitch line speed [m/s]."""
        c = self.lubricant_constant + 0.02
        return c + 2.0 * (1.0 - c) / math.sqrt(0.8 + 32.0 / speed)

    @property
    def velocity_factor(self) -> float:
        """Z_V of the load itself."""
        return self.velocity_factor_at(self.at_load.pitch_line_speed)

    @cached_property
    def reduced_curvature(self) -> float:
        """rho_red at the pitch point, of the transverse section [mm]."""
        one, other = (r * math.tan(self.data.pair.working_pressure_angle) for r in self.data.pair.base_radius)
        return one * other / (one + other)

    @cached_property
    def roughness_factor(self) -> float:
        """Z_R."""
        limit, rz = self.softer_limit, self.conditions.flank_roughness
        power = 0.15 if limit < 850.0 else 0.08 if limit > 1200.0 else 0.32 - 0.0002 * limit
        mean = 0.5 * (rz[0] + rz[1]) * (10.0 / self.reduced_curvature) ** (1.0 / 3.0)
        return float((3.0 / mean) ** power)

    @cached_property
    def equivalent_roughness(self) -> float:
        """R_zH of the hard flank on the soft one [um], from 3 to 16; 3 of pairs without work hardening."""
        if not any(self.hardened):
            return 3.0
        hard = self.hardened.index(True) ^ 1
        rz = self.conditions.flank_roughness
        film = self.conditions.viscosity_40 * self.at_load.pitch_line_speed / 1500.0
        found = rz[hard] * (10.0 / self.reduced_curvature) ** 0.33 * (rz[hard] / rz[1 - hard]) ** 0.66 / film**0.33
        return float(min(max(found, 3.0), 16.0))

    @cached_property
    def hardened(self) -> tuple[bool, bool]:
        """Which gear is a soft one on a hard mate."""
        one, other = (steel.kind.hard for steel in self.steels)
        return other and not one, one and not other

    def _brinell(self, gear: int) -> float:
        found = self.steels[gear].brinell
        if found is None:
            raise NoSolution(f"gear {gear + 1} is hardened by its mating gear: its HBW is needed", key="rating.brinell")
        return min(max(found, _SOFTENED[0]), _SOFTENED[1])

    @cached_property
    def work_hardening_factor(self) -> Pair:
        """Z_W."""
        smooth = (3.0 / self.equivalent_roughness) ** 0.15

        def of(gear: int) -> float:
            if not self.hardened[gear]:
                return 1.0
            return float((1.2 - (self._brinell(gear) - _SOFTENED[0]) / 1700.0) * smooth)

        return of(0), of(1)

    @property
    def size_factor_contact(self) -> Pair:
        """Z_X, 1 by ISO 6336-2."""
        return 1.0, 1.0

    def flank_line_at(self, gear: int, speed: float) -> LimitLine:
        """sigma_HG over the load cycles at a pitch line speed [m/s]."""
        steel = self.steels[gear]
        limit = steel.contact_limit
        film = self.lubricant_factor * self.velocity_factor_at(speed) * self.roughness_factor
        reference = limit * film * self.work_hardening_factor[gear] * self.size_factor_contact[gear]
        static = 1.05 - (self._brinell(gear) - _SOFTENED[0]) / 6800.0 if self.hardened[gear] else 1.0
        return limit_line(
            steel.kind.flank,
            limit * static,
            reference,
            self.conditions.long_life,
            pitting_allowed=self.conditions.pitting_allowed,
        )

    @cached_property
    def flank_lines(self) -> tuple[LimitLine, LimitLine]:
        """sigma_HG of both gears over the load cycles at the speed of the load."""
        v = self.at_load.pitch_line_speed
        return self.flank_line_at(0, v), self.flank_line_at(1, v)

    @cached_property
    def life_factor_contact(self) -> Pair:
        """Z_NT at N_L."""
        one, other = (line.factor_at(n) for line, n in zip(self.flank_lines, self._counted, strict=True))
        return one, other

    @property
    def _counted(self) -> Pair:
        """N_L, at least one load cycle."""
        return max(self.load_cycles[0], 1.0), max(self.load_cycles[1], 1.0)

    @cached_property
    def pitting_limit_stress(self) -> Pair:
        """sigma_HG at N_L."""
        one, other = (line.at(n) for line, n in zip(self.flank_lines, self._counted, strict=True))
        return one, other

    # Root

    @cached_property
    def bending_limits(self) -> Pair:
        """sigma_Flim."""
        return self.steels[0].bending_limit, self.steels[1].bending_limit

    @cached_property
    def slip_layer(self) -> Pair:
        """rho' [mm]."""
        return slip_layer(self.steels[0]), slip_layer(self.steels[1])

    @cached_property
    def notch_sensitivity_factor(self) -> Both:
        """Y_delta,relT; None of a root that is not rated."""
        return self._notched(0), self._notched(1)

    def _notched(self, gear: int) -> float | None:
        section = self.data.root.sections[gear]
        if section is None:
            return None
        slip, steepness = self.slip_layer[gear], 0.2 * (1.0 + 2.0 * section.notch)
        return (1.0 + math.sqrt(slip * steepness)) / (1.0 + math.sqrt(1.2 * slip))

    @cached_property
    def static_notch_sensitivity(self) -> Both:
        """Y_delta,relT at the static knee."""
        one, other = (
            None if section is None else static_notch(self.steels[gear], section.stress_correction_factor)
            for gear, section in enumerate(self.data.root.sections)
        )
        return one, other

    @cached_property
    def surface_factor(self) -> Pair:
        """Y_R,relT."""
        one, other = (
            surface_factor(steel.kind.surface, rz)
            for steel, rz in zip(self.steels, self.conditions.root_roughness, strict=True)
        )
        return one, other

    @cached_property
    def size_factor_bending(self) -> Pair:
        """Y_X."""
        one, other = (size_factor(steel.kind.size, self.data.pair.module) for steel in self.steels)
        return one, other

    @cached_property
    def mean_stress_factor(self) -> Pair:
        """Y_M: given, or 0.7 of an idler or planet."""
        given, system, idlers = self.conditions.mean_stress, self.conditions.system, self.data.idlers
        if given is not None:
            return given
        reversed_ = (idlers[0] or system == "planet-ring", idlers[1] or system == "sun-planet")
        return REVERSED if reversed_[0] else 1.0, REVERSED if reversed_[1] else 1.0

    @cached_property
    def root_lines(self) -> tuple[LimitLine | None, LimitLine | None]:
        """sigma_FG of both gears over the load cycles."""
        return self._root_line(0), self._root_line(1)

    def _root_line(self, gear: int) -> LimitLine | None:
        lasting, static = self.notch_sensitivity_factor[gear], self.static_notch_sensitivity[gear]
        if lasting is None or static is None:
            return None
        steel = self.steels[gear]
        limit = steel.bending_limit * _STRESS_CORRECTION * self.mean_stress_factor[gear]
        surface = self.surface_factor[gear] * self.size_factor_bending[gear]
        return limit_line(steel.kind.root, limit * static, limit * lasting * surface, self.conditions.long_life)

    @cached_property
    def life_factor_bending(self) -> Both:
        """Y_NT at N_L."""
        one, other = (
            None if line is None else line.factor_at(n) for line, n in zip(self.root_lines, self._counted, strict=True)
        )
        return one, other

    @cached_property
    def root_limit_stress(self) -> Both:
        """sigma_FG at N_L."""
        one, other = (
            None if line is None else line.at(n) for line, n in zip(self.root_lines, self._counted, strict=True)
        )
        return one, other

    # Safety, damage and life

    @cached_property
    def _points(self) -> tuple[tuple[Point, LoadFactors], ...]:
        """The points of the spectrum that carry a load, with their factors."""
        rows = (point for point in self.conditions.points if point.torque > 0.0 and point.share > 0.0)
        return tuple((point, self.at_load if point == Point() else self.factors_at(point)) for point in rows)

    @cached_property
    def flank_rows(self) -> tuple[tuple[tuple[float, float, LimitLine], ...], ...]:
        """Load cycles, contact stress and limit line of each point, of both gears; empty of a gear without stress."""
        return self._flank_rows(0), self._flank_rows(1)

    def _flank_rows(self, gear: int) -> tuple[tuple[float, float, LimitLine], ...]:
        flank = self.data.flank
        nominal, single = flank.nominal_stress, flank.single_contact_factor
        z = None if single is None else single[gear]
        if nominal is None or z is None:
            return ()
        return tuple(
            (
                self.cycles_at(gear, point),
                z * nominal * math.sqrt(point.torque * at.contact),
                self.flank_line_at(gear, at.pitch_line_speed),
            )
            for point, at in self._points
        )

    @cached_property
    def root_rows(self) -> tuple[tuple[tuple[float, float, LimitLine], ...], ...]:
        """Load cycles, root stress and limit line of each point, of both gears; empty of a root that is not rated."""
        return self._root_rows(0), self._root_rows(1)

    def _root_rows(self, gear: int) -> tuple[tuple[float, float, LimitLine], ...]:
        nominal, line = self.data.root.nominal_stress, self.root_lines[gear]
        stress = None if nominal is None else nominal[gear]
        if stress is None or line is None:
            return ()
        return tuple(
            (self.cycles_at(gear, point), stress * point.torque * at.bending, line) for point, at in self._points
        )

    @cached_property
    def safety_pitting(self) -> Both:
        """S_H: sigma_HG/sigma_H, of a spectrum the S at which the damage is 1."""
        if self.conditions.spectrum:
            return self._at_damage_one(self.flank_rows)
        one, other = self.pitting_limit_stress
        return self._over(one, self.flank_rows[0]), self._over(other, self.flank_rows[1])

    @cached_property
    def safety_bending(self) -> Both:
        """S_F: sigma_FG/sigma_F, of a spectrum the S at which the damage is 1."""
        if self.conditions.spectrum:
            return self._at_damage_one(self.root_rows)
        one, other = self.root_limit_stress
        return self._over(one, self.root_rows[0]), self._over(other, self.root_rows[1])

    @staticmethod
    def _over(limit: float | None, rows: tuple[tuple[float, float, LimitLine], ...]) -> float | None:
        return None if limit is None or not rows else limit / rows[0][1]

    @staticmethod
    def _at_damage_one(rows: tuple[tuple[tuple[float, float, LimitLine], ...], ...]) -> Both:
        one, other = (safety_of(each) if each else None for each in rows)
        return one, other

    def _damage(self, rows: tuple[tuple[tuple[float, float, LimitLine], ...], ...], safety: float) -> Both:
        one, other = (damage(each, safety) if each else None for each in rows)
        return one, other

    @cached_property
    def damage_pitting(self) -> Both:
        """U of the flanks at the required safety."""
        return self._damage(self.flank_rows, self.data.required.pitting)

    @cached_property
    def damage_bending(self) -> Both:
        """U of the roots at the required safety."""
        return self._damage(self.root_rows, self.data.required.bending)

    def _life(self, found: Both) -> Both:
        one, other = (self.conditions.life / each if each else None for each in found)
        return one, other

    @cached_property
    def pitting_life(self) -> Both:
        """L_h/U [h]; None where no damage arises."""
        return self._life(self.damage_pitting)

    @cached_property
    def bending_life(self) -> Both:
        """L_h/U [h]; None where no damage arises."""
        return self._life(self.damage_bending)

    @cached_property
    def static_safety(self) -> tuple[Both, Both]:
        """Static limit over the maximum stress of the spectrum, of flanks and roots."""

        def least(rows: tuple[tuple[float, float, LimitLine], ...]) -> float | None:
            return min((line.static / stress for _, stress, line in rows), default=None)

        flank, root = ((least(rows[0]), least(rows[1])) for rows in (self.flank_rows, self.root_rows))
        return flank, root

    # Others

    @property
    def single_pitch_deviation(self) -> Pair:
        """f_pt [um]."""
        return self.bodies.tolerances[0].single_pitch, self.bodies.tolerances[1].single_pitch

    @property
    def profile_form_deviation(self) -> Pair:
        """f_f,alpha [um]."""
        return self.bodies.tolerances[0].profile_form, self.bodies.tolerances[1].profile_form

    @property
    def helix_slope_deviation(self) -> Pair:
        """f_H,beta [um]."""
        return self.bodies.tolerances[0].helix_slope, self.bodies.tolerances[1].helix_slope

    @cached_property
    def running_in_relief(self) -> float:
        """C_ay = (sigma_Hlim/97 - 18.45)^2/18 + 1.5 [um], mean of both gears."""
        return math.fsum(0.5 * ((limit / 97.0 - 18.45) ** 2 / 18.0 + 1.5) for limit in self.contact_limits)

    @cached_property
    def scuffing(self) -> Scuffing | None:
        """The integral temperature; None of rings, and without what the oil needs."""
        if self.conditions.scuffing_stage is None or self.data.pair.internal:
            return None
        from gearlink.core.parts.gears.rating.scuffing import Scuffing

        return Scuffing(self)


def slip_layer(steel: GearSteel) -> float:
    """rho' of a material [mm]: of its class, or linear between yield points; beyond them that of the end.

    Source
        ISO 6336-3, of steels with a yield point of 1000 N/mm^2 and case-hardened ones in three KISSsoft reports
    """
    if steel.kind.notch is not None:
        return steel.kind.notch
    at = steel.yield_strength
    if at <= _NOTCH[0][0]:
        return _NOTCH[0][1]
    for (low, one), (high, other) in pairwise(_NOTCH):
        if at <= high:
            return one + (at - low) / (high - low) * (other - one)
    return _NOTCH[-1][1]


def static_notch(steel: GearSteel, stress_correction: float) -> float:
    """Y_delta,relT at the static knee.

    Source
        ISO 6336-3, from memory
    """
    form = steel.kind.static_notch
    if form == "case":
        return 0.44 * stress_correction + 0.12
    if form == "nitrided":
        return 0.2 * stress_correction + 0.6
    if form == "none":
        return 1.0
    share = 0.82 * (300.0 / steel.yield_strength) ** 0.25
    return float((1.0 + share * (stress_correction - 1.0)) / (1.0 + share))


def surface_factor(form: str, roughness: float) -> float:
    """Y_R,relT of a root with Rz [um].

    Example
        >>> round(surface_factor("steel", 20.0), 4)
        0.9567

    Source
        ISO 6336-3; of steel in three KISSsoft reports
    """
    start, slope, power, smooth = _SURFACE[form]
    return smooth if roughness < 1.0 else float(start - slope * (roughness + 1.0) ** power)


def size_factor(form: str, module: float) -> float:
    """Y_X of a module [mm].

    Example
        >>> [round(size_factor("hard", m), 3) for m in (3.0, 14.0, 45.0)]
        [1.0, 0.91, 0.8]

    Source
        ISO 6336-3; of hard and soft steel in three KISSsoft reports
    """
    start, slope, most = _SIZE[form]
    return 1.0 if module <= 5.0 else start - slope * min(module, most)
