"""Root stresses of both gears of a pair by ISO 6336-3, method B, on the virtual spur gear.

The section of an external tooth stands where a tangent of 30 deg touches the fillet, that of a ring at 60 deg. The
standard's auxiliary angle theta is the direction of the tool's normal there, so it is found as a bracketed root.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, ClassVar, TypeVar

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.parts.gears.mesh.contact import PathOfContact
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.mesh.pitch_pair import Both, Pair, by_gear
from gearlink.core.parts.gears.rating.load import Factors, Load, Material
from gearlink.core.parts.gears.tooth.tools import RackTool


@dataclass(frozen=True, kw_only=True)
class RootSection:
    """The root section of one gear of a pair, in normal modules of its virtual spur gear.

    Parameters
        gear : int - 0 or 1
        tool : RackTool - the one that cuts it; of a ring its substitute
        shift : float [module] - generating profile shift x_E
        contact_radius : float or None [module] - radius on the virtual gear where the load acts, signed; None: the
            outer point of single contact (method B)
        contact_ratio : float or None - eps_alpha of the mesh; None: the pair's
        given_fillet_radius : float or None [module] - of a ring, the one that its cutter leaves; None: the tool's
    Returns
        Properties: lengths in modules, angles in rad.
    Raises
        NoSolution - where the tool leaves no such tangent
    Notes
        theta, the section and rho_F were compared with the tangent of the generated fillet by differentiation: 1e-23
        at forty digits over 520 gears.
    Example
        >>> pair = GearPair(module=3.0, teeth=(17, 40), given_shift=(0.4, 0.2))
        >>> hob = RackTool(addendum=1.25, rounding=0.25)
        >>> root = RootSection(pair=pair, gear=0, tool=hob, shift=0.4)
        >>> round(root.form_factor, 9), round(root.stress_correction_factor, 9)
        (1.46980356, 2.234815374)

    Source
        ISO 6336-3:2006, as public code and worked examples quote it; the form of the equations is an own derivation
    """

    pair: GearPair
    gear: int
    tool: RackTool
    shift: float
    contact_radius: float | None = None
    contact_ratio: float | None = None
    given_fillet_radius: float | None = None

    @property
    def _ring(self) -> bool:
        return self.pair.teeth[self.gear] < 0

    @cached_property
    def virtual_teeth(self) -> float:
        """z_n = z/(cos^2(beta_b) cos(beta)), negative for a ring."""
        pair, fn = self.pair, self.pair.fn
        return pair.teeth[self.gear] / (fn.cos(pair.base_helix_angle) ** 2 * fn.cos(pair.helix_angle))

    @cached_property
    def virtual_contact_ratio(self) -> float:
        """eps_alpha,n = eps_alpha/cos^2(beta_b)."""
        eps = self.pair.contact_ratio if self.contact_ratio is None else self.contact_ratio
        return eps / self.pair.fn.cos(self.pair.base_helix_angle) ** 2

    @property
    def _depth(self) -> float:
        """G = rho* - h_fP* + x_E."""
        return self.tool.rounding - self.tool.addendum + self.shift

    @property
    def _tangent(self) -> float:
        return math.pi / 6.0 if self._ring else math.pi / 3.0

    @cached_property
    def theta(self) -> float:
        """Direction of the tool's normal at the tangent: theta = 2 G/z_n tan(theta) - H.

        Raises
            NoSolution - where no tangent of this direction touches the fillet
        """
        slope, h = self._tangent_line
        try:
            return bracketed_root(lambda b: b - slope * math.tan(b) + h, 0.0, math.pi / 2.0 - self.pair.pressure_angle)
        except NoSolution:
            degrees = "60" if self._ring else "30"
            raise NoSolution(f"no tangent of {degrees} deg touches the root fillet of gear {self.gear + 1}") from None

    @property
    def _tangent_line(self) -> tuple[float, float]:
        """2 G/z_n and H of the equation of theta."""
        z, center = self.virtual_teeth, self.tool.rounding_center(self.pair.pressure_angle, self.pair.fn)
        return 2.0 * self._depth / z, 2.0 / z * (math.pi / 2.0 - center) - self._tangent

    @property
    def _out(self) -> float:
        """G/cos(theta) - rho*."""
        return self._depth / self.pair.fn.cos(self.theta) - self.tool.rounding

    @cached_property
    def chord(self) -> float:
        """s_Fn*, thickness of the root section."""
        factor = 1.0 if self._ring else math.sqrt(3.0)
        return self.virtual_teeth * self.pair.fn.sin(self._tangent - self.theta) + factor * self._out

    @cached_property
    def fillet_radius(self) -> float:
        """rho_F*, radius of the fillet at the tangent."""
        return self._radius(self.virtual_teeth) if self.given_fillet_radius is None else self.given_fillet_radius

    def _radius(self, virtual_teeth: float) -> float:
        g, cosine = self._depth, self.pair.fn.cos(self.theta)
        return self.tool.rounding + 2.0 * g * g / (cosine * (virtual_teeth * cosine * cosine - 2.0 * g))

    @property
    def standard_fillet_radius(self) -> float:
        """rho_F* of a ring by ISO 6336-3:2006 and 2007, with |z_n|: a hollow root is not as flat as that of a gear."""
        return self._radius(abs(self.virtual_teeth))

    @property
    def tip_radius(self) -> float:
        """d_an*/2 of the virtual gear; signed."""
        height = (self.pair.tip_radius[self.gear] - self.pair.reference_radius[self.gear]) / self.pair.module
        return 0.5 * self.virtual_teeth + height

    def loaded(self, radius: float) -> RootSection:
        """The same section with its load elsewhere on the flank, by contact_radius [module]."""
        return replace(self, contact_radius=radius)

    def loaded_at(self, path: PathOfContact, rho: float) -> RootSection:
        """The same section, loaded at a place rho_1 [mm] on the path of contact."""
        pair, gear = self.pair, self.gear
        own = rho if gear == 0 else path.line - rho
        radius = pair.signs[gear] * math.hypot(pair.base_radius[gear], own)
        return self.loaded(0.5 * self.virtual_teeth + (radius - pair.reference_radius[gear]) / pair.module)

    @cached_property
    def load_radius(self) -> float:
        """d_en*/2, where the load acts on the virtual gear; signed."""
        if self.contact_radius is not None:
            return self.contact_radius
        z, fn, sign = self.virtual_teeth, self.pair.fn, self.pair.signs[self.gear]
        cosine, tip = fn.cos(self.pair.pressure_angle), self.tip_radius
        base = 0.5 * z * cosine
        roll = sign * fn.sqrt(fn.greatest(0.0, (tip - base) * (tip + base)))
        at = roll - math.pi * cosine * (self.virtual_contact_ratio - 1.0)
        return sign * fn.hypot(at, base)

    @cached_property
    def load_angle(self) -> float:
        """alpha_Fen, between the load and the normal of the tooth's middle: alpha_en - gamma."""
        z, alpha, fn = self.virtual_teeth, self.pair.pressure_angle, self.pair.fn
        base = 0.5 * z * fn.cos(alpha)
        at = fn.acos(fn.least(1.0, base / self.load_radius))
        gamma = (0.5 * math.pi + 2.0 * self.shift * fn.tan(alpha)) / z + fn.involute(alpha) - fn.involute(at)
        return at - gamma

    @cached_property
    def moment_arm(self) -> float:
        """h_Fe*, from the root section to where the load crosses the middle of the tooth."""
        z, fn, factor = self.virtual_teeth, self.pair.fn, math.sqrt(3.0) if self._ring else 1.0
        crossing = z * fn.cos(self.pair.pressure_angle) / fn.cos(self.load_angle)
        return 0.5 * (crossing - z * fn.cos(self._tangent - self.theta) - factor * self._out)

    @cached_property
    def form_factor(self) -> float:
        """Y_F = 6 h_Fe* cos(alpha_Fen)/(s_Fn*^2 cos(alpha_n))."""
        lever = 6.0 * self.moment_arm * self.pair.fn.cos(self.load_angle)
        return lever / (self.chord**2 * self.pair.fn.cos(self.pair.pressure_angle))

    @cached_property
    def notch(self) -> float:
        """q_s = s_Fn/(2 rho_F); the standard covers 1 to 8."""
        return self.chord / (2.0 * self.fillet_radius)

    @cached_property
    def stress_correction_factor(self) -> float:
        """Y_S = (1.2 + 0.13 L) q_s^(1/(1.21 + 2.3/L)), L = s_Fn/h_Fe.

        Raises
            NoSolution - where fillet radius, section or lever is not positive
        """
        if min(self.fillet_radius, self.chord, self.moment_arm) <= 0.0:
            raise NoSolution(
                f"the root fillet of gear {self.gear + 1} has no radius that a stress could be formed with"
            )
        return float(self._stress_correction)

    @property
    def _stress_correction(self) -> Any:
        slender = self.chord / self.moment_arm
        return (1.2 + 0.13 * slender) * self.notch ** (1.0 / (1.21 + 2.3 / slender))


T = TypeVar("T")
_STRESS_CORRECTION = 2.0
"""Y_ST of the reference test gears."""
_GEAR_RIM = (1.2, 0.5, 1.6, 2.242)
_RING_RIM = (3.5, 1.75, 1.15, 8.324)
"""Of Y_B: the rim from which on it is 1, that down to which it is known, and its two constants between."""
_DEEP_GRADE = 4
"""Deep teeth share the load from this accuracy grade on."""
_BOTH_WAYS = 0.7
"""Y_d of teeth that are bent both ways, those of idlers."""
_OVERHANG = 2.0
"""Modules by which a gear may be wider than its mating gear and still carry with all its width."""


@dataclass(frozen=True, kw_only=True)
class RootStress:
    """Root stresses and safeties; a value that does not exist is None.

    sigma_F = F_t/(b m) Y_F Y_S Y_beta Y_B Y_DT K_A K_v K_Fb K_Fa,  S_F = sigma_Flim Y_ST Y_N.../sigma_F

    Parameters
        tools : (RackTool, RackTool) - those that cut the gears; of a ring the substitute of its cutter
        shifts : (float, float) [module] - generating shifts x_E, of the upper allowances
        widths : (float, float) or None [mm] - face widths
        materials : (Material, Material)
        edition : int - 2006, or 2019, whose Y_beta and f_eps were not compared with any published value
        rims : (float or None, float or None) [mm] - rim under the tooth roots; None: solid
        accuracy_grade : int or None - of ISO 1328; 4 or better lowers the stress of deep teeth
        idlers : (bool, bool) - gears with two mates, which load one flank and the other
        ring_fillet : float or None [module] - rho_F* of gear 2, a ring, as its cutter leaves it
        standard_ring : bool - rho_F* of a ring by ISO 6336-3 with |z_n|
    Returns
        Properties: a pair is (gear 1, gear 2); lengths in mm, stresses in N/mm^2.

    Source
        ISO 6336-3:2006; the standard was not opened. Y_S, Y_beta, Y_B and Y_DT stand as here in IACS UR M56 (Rev. 4),
        which has Y_d in M56.3.9
    """

    path: PathOfContact
    tools: tuple[RackTool, RackTool]
    shifts: Pair
    widths: Pair | None
    load: Load | None
    materials: tuple[Material, Material]
    edition: int = 2006
    rims: Both = (None, None)
    accuracy_grade: int | None = None
    idlers: tuple[bool, bool] = (False, False)
    ring_fillet: float | None = None
    standard_ring: bool = False

    section_of: ClassVar[type[RootSection]] = RootSection

    @cached_property
    def sections(self) -> tuple[RootSection | None, RootSection | None]:
        """The root sections; None where the tool leaves none with a 30 (60) deg tangent and a fillet."""
        return by_gear(self._section)

    def _section(self, gear: int) -> RootSection | None:
        tool, pair = self.tools[gear], self.path.pair
        if tool.rounding_center(pair.pressure_angle) < 0.0:
            return None
        section = self._made(gear)
        try:
            enough = section.stress_correction_factor > 0.0 and section.form_factor > 0.0
        except NoSolution:
            return None
        return section if enough else None

    def _made(self, gear: int) -> RootSection:
        pair, eps = self.path.pair, self.path.contact_ratio
        made = self.section_of(pair=pair, gear=gear, tool=self.tools[gear], shift=self.shifts[gear], contact_ratio=eps)
        if gear == 0 or not pair.internal:
            return made
        radius = made.standard_fillet_radius if self.standard_ring else self.ring_fillet
        return made if radius is None else replace(made, given_fillet_radius=radius)

    @cached_property
    def at_tip(self) -> tuple[RootSection | None, RootSection | None]:
        """The same sections loaded at the tip, for Y_Fa and Y_Sa of method C."""
        return self._each(lambda root: root.loaded(root.tip_radius))

    @property
    def tip_stress_correction_factor(self) -> Both:
        """Y_Sa, with the load at the tip; None where the lever is none."""
        return by_gear(lambda gear: _corrected(self.at_tip[gear]))

    @property
    def contact_ratio_factor(self) -> float | None:
        """Y_eps = 0.25 + 0.75/eps_alpha,n of method C, never beside Y_F and Y_S; None out of its range, 1 to 2."""
        eps = self.virtual_contact_ratio
        return 0.25 + 0.75 / eps if 1.0 <= eps <= 2.0 else None

    @property
    def virtual_contact_ratio(self) -> float:
        """eps_alpha,n = eps_alpha/cos^2(beta_b)."""
        return self.path.contact_ratio / math.cos(self.path.pair.base_helix_angle) ** 2

    @cached_property
    def rim_factor(self) -> Both | None:
        """Y_B of gear 1 and 2; None without rims, and of a rim that is too thin to be rated."""
        return None if self.rims == (None, None) else by_gear(self._rim_factor)

    def _rim_factor(self, gear: int) -> float | None:
        rim, pair = self.rims[gear], self.path.pair
        if rim is None:
            return 1.0
        ring = pair.teeth[gear] < 0
        height = pair.tip_radius[gear] - pair.root_radius[gear]
        return rim_factor(rim / (pair.module if ring else height), ring=ring)

    @property
    def deep_tooth_factor(self) -> float | None:
        """Y_DT; None where the file names no accuracy grade."""
        grade = self.accuracy_grade
        return None if grade is None else deep_tooth_factor(self.virtual_contact_ratio, grade)

    @property
    def load_reversal_factor(self) -> Pair | None:
        """Y_d, what teeth that are bent both ways bear of what others do; None without an idler."""
        one, other = (_BOTH_WAYS if idler else 1.0 for idler in self.idlers)
        return (one, other) if any(self.idlers) else None

    def raised(self, gear: int) -> float | None:
        """Y_B Y_DT of a gear, 1 where the file has no data for them; None for a rim too thin to be rated."""
        rim = 1.0 if self.rim_factor is None else self.rim_factor[gear]
        deep = 1.0 if self.deep_tooth_factor is None else self.deep_tooth_factor
        return None if rim is None else rim * deep

    def _each(self, value: Callable[[RootSection], T]) -> tuple[T | None, T | None]:
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
        eps = self.virtual_contact_ratio
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
        """sigma_F0 = F_t/(b m) Y_F Y_S Y_beta Y_B Y_DT."""
        if self.load is None or self.bearing_width is None or self.helix_angle_factor is None:
            return None
        if self.path.contact_ratio <= 0.0:
            return None
        force = self.load.tangential_force(self.path.pair.reference_radius[0])
        line = force / self.path.pair.module * self.helix_angle_factor * self.load_distribution
        found = self._each(lambda root: root.form_factor * root.stress_correction_factor * line)
        return self._over_width(found, 0), self._over_width(found, 1)

    def _over_width(self, force: Both, gear: int) -> float | None:
        loaded, raised, widths = force[gear], self.raised(gear), self.bearing_width
        return None if loaded is None or raised is None or widths is None else loaded * raised / widths[gear]

    @cached_property
    def stress(self) -> Both | None:
        """sigma_F."""
        return self.stress_under(Factors() if self.load is None else self.load.factors)

    def stress_under(self, factors: Factors) -> Both | None:
        """sigma_F with other K factors."""
        if self.nominal_stress is None:
            return None
        one, other = self.nominal_stress
        raised = factors.bending
        return None if one is None else one * raised, None if other is None else other * raised

    @cached_property
    def safety(self) -> Both | None:
        """S_F = sigma_Flim Y_ST Y_d Y_N (Y_drelT Y_RrelT Y_X)/sigma_F."""
        return None if self.stress is None else (self._safety(0, self.stress[0]), self._safety(1, self.stress[1]))

    def _safety(self, gear: int, stress: float | None) -> float | None:
        limit = self.materials[gear].bending_limit
        if limit is None or not stress:
            return None
        borne = limit * (_BOTH_WAYS if self.idlers[gear] else 1.0)
        return borne * _STRESS_CORRECTION * self.materials[gear].bending_factors / stress


def _corrected(section: RootSection | None) -> float | None:
    try:
        return None if section is None else section.stress_correction_factor
    except NoSolution:
        return None


def rim_factor(rim: float, *, ring: bool) -> float | None:
    """Y_B of the rim under the roots: of a gear over the height of its teeth, of a ring in modules; None if too thin.

    Example
        >>> rim_factor(1.2, ring=False), round(rim_factor(0.8, ring=False), 6), rim_factor(0.5, ring=False)
        (1.0, 1.648819, None)
        >>> rim_factor(3.5, ring=True), round(rim_factor(2.5, ring=True), 6), rim_factor(1.75, ring=True)
        (1.0, 1.38328, None)

    Source
        ISO 6336-3, as IACS UR M56 (Rev. 4) prints it in M56.3.6
    """
    solid, thin, slope, scale = _RING_RIM if ring else _GEAR_RIM
    if rim >= solid:
        return 1.0
    return slope * math.log(scale / rim) if rim > thin else None


def deep_tooth_factor(virtual_contact_ratio: float, grade: int) -> float:
    """Y_DT: less stress where two pairs of deep, accurate teeth share the load.

    Example
        >>> [round(deep_tooth_factor(eps, 4), 4) for eps in (2.05, 2.5, 2.6)], deep_tooth_factor(2.4, 5)
        ([1.0, 0.701, 0.7], 1.0)

    Source
        ISO 6336-3, as IACS UR M56 (Rev. 4) prints it in M56.3.7: 1 up to 2.05 and for grades above 4, 0.7 above 2.5
    """
    if grade > _DEEP_GRADE or virtual_contact_ratio <= 2.05:
        return 1.0
    return 2.366 - 0.666 * virtual_contact_ratio if virtual_contact_ratio <= 2.5 else 0.7
