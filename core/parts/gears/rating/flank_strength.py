"""Surface durability of the flanks by ISO 6336-2, method B; all K and life factors are inputs."""

from __future__ import annotations

import math
from dataclasses import dataclass

from gearlink.core.base.results import cached_property
from gearlink.core.parts.gears.mesh.contact import PathOfContact
from gearlink.core.parts.gears.mesh.pitch_pair import Both
from gearlink.core.parts.gears.rating.load import Factors, Load, Material


@dataclass(frozen=True, kw_only=True)
class FlankStrength:
    """Contact stress of a pair.

    sigma_H0 = Z_H Z_E Z_eps Z_beta sqrt(F_t/(d_1 b) (u + 1)/u),  sigma_H1,2 = Z_B,D sigma_H0 sqrt(K_A K_v K_Hb K_Ha)

    Parameters
        path : PathOfContact - with the common width where stresses are wanted
        materials : (Material, Material)
    Returns
        Properties: stresses in N/mm^2; None where data are missing or the formula is out of its range.
    Notes
        ISO 6336-2:2006: Z_beta = 1/sqrt(cos(beta)). Z_H Z_E sqrt(...) is the Hertz pressure at the pitch point, M_1
        and M_2 the ratios of the pressures at B and D to it: held by the tests.
    Example
        >>> from gearlink.core.parts.gears.mesh.pair import GearPair
        >>> steel = (Material(), Material())
        >>> flank = FlankStrength(path=PathOfContact(GearPair.from_shift(2.0, (20, 40))), load=None, materials=steel)
        >>> round(flank.zone_factor, 6), round(flank.elasticity_factor, 4)
        (2.494573, 189.8117)

    Source
        ISO 6336-2:2006, as public code, worked examples and IACS UR M56 (Rev. 4), M56.2, quote it; it was not opened
    """

    path: PathOfContact
    load: Load | None
    materials: tuple[Material, Material]

    @cached_property
    def zone_factor(self) -> float:
        """Z_H = sqrt(2 cos(beta_b) cos(alpha_wt)/(cos^2(alpha_t) sin(alpha_wt)))."""
        pair = self.path.pair
        up = 2.0 * math.cos(pair.base_helix_angle) * math.cos(pair.working_pressure_angle)
        down = math.cos(pair.transverse_pressure_angle) ** 2 * math.sin(pair.working_pressure_angle)
        return math.sqrt(up / down) if down > 0.0 else math.inf

    @cached_property
    def elasticity_factor(self) -> float:
        """Z_E = (pi ((1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2))^(-1/2) [sqrt(N/mm^2)]."""
        return 1.0 / math.sqrt(math.pi * (self.materials[0].compliance + self.materials[1].compliance))

    @cached_property
    def contact_ratio_factor(self) -> float | None:
        """Z_eps; None without the width of helical gears, and for spur gears beyond eps_alpha = 4."""
        eps, overlap = self.path.contact_ratio, self.path.overlap_ratio
        if overlap is None or eps <= 0.0:
            return None
        square = (4.0 - eps) / 3.0 * (1.0 - overlap) + overlap / eps if overlap < 1.0 else 1.0 / eps
        return math.sqrt(square) if square >= 0.0 else None

    @cached_property
    def helix_angle_factor(self) -> float:
        """Z_beta = 1/sqrt(cos(beta))."""
        return 1.0 / math.sqrt(math.cos(self.path.pair.helix_angle))

    @cached_property
    def single_contact_ratios(self) -> Both:
        """M_1 and M_2: pressure at B and at D over that at the pitch point."""
        path, pitch = self.path, self.path.pair.base_pitch
        at_pitch = path.curvature(path.pitch)

        def ratio(rho: float) -> float | None:
            square = path.curvature(rho) / at_pitch
            return math.sqrt(square) if 0.0 < square < math.inf else None

        return ratio(path.end - pitch), ratio(path.start + pitch)

    @cached_property
    def single_contact_factor(self) -> Both | None:
        """Z_B, Z_D; a ring has Z_D = 1, and so have both from eps_beta = 1 on."""
        overlap, m = self.path.overlap_ratio, self.single_contact_ratios
        if overlap is None:
            return None
        other = 1.0 if self.path.pair.internal else _at_least_one(m[1], overlap)
        return _at_least_one(m[0], overlap), other

    @cached_property
    def tangential_force(self) -> float | None:
        """F_t [N]."""
        if self.load is None:
            return None
        return self.load.tangential_force(self.path.pair.reference_radius[0])

    @cached_property
    def nominal_stress(self) -> float | None:
        """sigma_H0."""
        force, width, z_eps = self.tangential_force, self.path.face_width, self.contact_ratio_factor
        if force is None or width is None or z_eps is None:
            return None
        line = force / (2.0 * self.path.pair.reference_radius[0] * width) * (1.0 + 1.0 / self.path.gear_ratio)
        return self.zone_factor * self.elasticity_factor * z_eps * self.helix_angle_factor * math.sqrt(line)

    @cached_property
    def stress(self) -> Both | None:
        """sigma_H of gear 1 and 2."""
        return self.stress_under(Factors() if self.load is None else self.load.factors)

    def stress_under(self, factors: Factors) -> Both | None:
        """sigma_H of gear 1 and 2 with other K factors."""
        nominal, single = self.nominal_stress, self.single_contact_factor
        if nominal is None or single is None:
            return None
        raised = nominal * math.sqrt(factors.contact)
        return _times(single[0], raised), _times(single[1], raised)

    @cached_property
    def safety(self) -> Both | None:
        """S_H = sigma_Hlim Z_N (Z_L Z_v Z_R Z_W Z_X)/sigma_H."""
        return None if self.stress is None else (self._safety(0, self.stress[0]), self._safety(1, self.stress[1]))

    def _safety(self, gear: int, stress: float | None) -> float | None:
        limit = self.materials[gear].contact_limit
        if limit is None or not stress:
            return None
        return limit * self.materials[gear].contact_factors / stress


def _at_least_one(ratio: float | None, overlap: float) -> float | None:
    if overlap >= 1.0:
        return 1.0
    return None if ratio is None else max(1.0, ratio - overlap * (ratio - 1.0))


def _times(one: float | None, other: float) -> float | None:
    return None if one is None else one * other


def hertz_pressure(path: PathOfContact, rho: float, line_force: float, materials: tuple[Material, Material]) -> float:
    """Pressure of two cylinders at a place on the path of contact.

    p = sqrt(w (1/rho_1 + 1/rho_2) cos(beta_b)/(pi sum (1 - nu^2)/E))

    Parameters
        rho : float [mm] - rho_1, radius of curvature of gear 1 in the transverse section
        line_force : float [N/mm] - normal force per length of the line of contact
        materials : (Material, Material)
    Returns
        p : float [N/mm^2] - infinite on a base circle
    """
    curvature = path.curvature(rho) * math.cos(path.pair.base_helix_angle)
    if not 0.0 <= curvature < math.inf:
        return math.inf
    return math.sqrt(line_force * curvature / (math.pi * (materials[0].compliance + materials[1].compliance)))
