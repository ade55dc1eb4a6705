"""Root stresses of both gears of a pair by ISO 6336-3, method B."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from gearlink.core.errors import NoSolution
from gearlink.core.gears.contact import PathOfContact
from gearlink.core.gears.load import Load, Material
from gearlink.core.gears.pair import Pair
from gearlink.core.gears.root_strength import RootSection
from gearlink.core.gears.tools import RackTool
from gearlink.core.results import cached_property

Both = tuple[float | None, float | None]
_STRESS_CORRECTION = 2.0
"""Y_ST of the reference test gears."""
_OVERHANG = 2.0
"""Modules by which a gear may be wider than its mate and still carry with all its width."""


@dataclass(frozen=True, kw_only=True)
class RootStress:
    """Root stresses and safeties; a value that does not exist is None.

    sigma_F = F_t/(b m) Y_F Y_S Y_beta K_A K_v K_Fb K_Fa,  S_F = sigma_Flim Y_ST Y_N.../sigma_F

    Parameters
        path : PathOfContact
        tools : (RackTool, RackTool) - those that cut the gears; of a ring the substitute of its cutter
        shifts : (float, float) [module] - generating shifts x_E, of the upper allowances
        widths : (float, float) or None [mm] - face widths
        load : Load or None
        materials : (Material, Material)
        edition : int - 2006, or 2019, whose Y_beta and f_eps were not compared with any published value
    Returns
        Properties: a pair is (gear 1, gear 2); lengths in mm, stresses in N/mm^2.

    Source
        ISO 6336-3:2006; the standard was not opened
    """

    path: PathOfContact
    tools: tuple[RackTool, RackTool]
    shifts: Pair
    widths: Pair | None
    load: Load | None
    materials: tuple[Material, Material]
    edition: int = 2006

    @cached_property
    def sections(self) -> tuple[RootSection | None, RootSection | None]:
        """The root sections; None where the tool leaves none with a 30 (60) deg tangent and a fillet."""
        return self._section(0), self._section(1)

    def _section(self, gear: int) -> RootSection | None:
        tool, pair = self.tools[gear], self.path.pair
        if tool.rounding_center(pair.pressure_angle) < 0.0:
            return None
        section = RootSection(pair=pair, gear=gear, tool=tool, shift=self.shifts[gear])
        try:
            enough = section.stress_correction_factor > 0.0 and section.form_factor > 0.0
        except NoSolution:
            return None
        return section if enough else None

    def _each(self, value: Callable[[RootSection], float]) -> Both:
        one, other = self.sections
        return None if one is None else value(one), None if other is None else value(other)

    @property
    def chord(self) -> Both:
        """s_Fn."""
        return self._each(lambda root: root.chord * self.path.pair.module)

    @property
    def moment_arm(self) -> Both:
        """h_Fe."""
        return self._each(lambda root: root.moment_arm * self.path.pair.module)

    @property
    def fillet_radius(self) -> Both:
        """rho_F."""
        return self._each(lambda root: root.fillet_radius * self.path.pair.module)

    @property
    def form_factor(self) -> Both:
        """Y_F."""
        return self._each(lambda root: root.form_factor)

    @property
    def stress_correction_factor(self) -> Both:
        """Y_S."""
        return self._each(lambda root: root.stress_correction_factor)

    @cached_property
    def helix_angle_factor(self) -> float | None:
        """Y_beta = 1 - eps_beta beta/120 deg, eps_beta <= 1, beta <= 30 deg; of 2019: that over cos^3(beta)."""
        overlap, beta = self.path.overlap_ratio, self.path.pair.helix_angle
        if overlap is None:
            return None
        factor = 1.0 - min(overlap, 1.0) * min(math.degrees(beta), 30.0) / 120.0
        return factor if self.edition == 2006 else factor / math.cos(beta) ** 3

    @cached_property
    def load_distribution(self) -> float:
        """f_eps of the edition of 2019 (unverified); 1 before."""
        overlap = self.path.overlap_ratio
        if self.edition == 2006 or overlap is None:
            return 1.0
        eps = self.path.pair.contact_ratio / math.cos(self.path.pair.base_helix_angle) ** 2
        if overlap >= 1.0:
            return 1.0 / math.sqrt(eps)
        if overlap == 0.0:
            return 1.0 if eps < 2.0 else 0.7
        shared = 1.0 - overlap if eps < 2.0 else 0.5 * (1.0 - overlap)
        return math.sqrt(shared + overlap / eps)

    @cached_property
    def bearing_width(self) -> Pair | None:
        """b that carries: the own width, at most the lesser one and two modules."""
        if self.widths is None:
            return None
        most = min(self.widths) + _OVERHANG * self.path.pair.module
        return min(self.widths[0], most), min(self.widths[1], most)

    @cached_property
    def nominal_stress(self) -> Both | None:
        """sigma_F0 = F_t/(b m) Y_F Y_S Y_beta."""
        if self.load is None or self.bearing_width is None or self.helix_angle_factor is None:
            return None
        if self.path.pair.contact_ratio <= 0.0:
            return None
        force = self.load.tangential_force(self.path.pair.reference_radius[0])
        line = force / self.path.pair.module * self.helix_angle_factor * self.load_distribution
        b1, b2 = self.bearing_width
        one, other = self._each(lambda root: root.form_factor * root.stress_correction_factor * line)
        return None if one is None else one / b1, None if other is None else other / b2

    @cached_property
    def stress(self) -> Both | None:
        """sigma_F."""
        if self.nominal_stress is None or self.load is None:
            return None
        one, other = self.nominal_stress
        raised = self.load.factors.bending
        return None if one is None else one * raised, None if other is None else other * raised

    @cached_property
    def safety(self) -> Both | None:
        """S_F = sigma_Flim Y_ST Y_N (Y_drelT Y_RrelT Y_X)/sigma_F."""
        return None if self.stress is None else (self._safety(0, self.stress[0]), self._safety(1, self.stress[1]))

    def _safety(self, gear: int, stress: float | None) -> float | None:
        limit = self.materials[gear].bending_limit
        if limit is None or not stress:
            return None
        return limit * _STRESS_CORRECTION * self.materials[gear].bending_factors / stress
