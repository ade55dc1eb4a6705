"""A pair rated by ISO 6336 with all factors computed: limit stresses, safeties, life and damage.

Load factors are those of ISO 6336-1: stiffness, dynamic factor (method B), face load factor (method C), transverse one.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from gearlink.core.base.errors import NoSolution, at_key
from gearlink.core.base.results import cached_property
from gearlink.core.parts.gears.measures.iso_1328 import ToothTolerances
from gearlink.core.parts.gears.mesh.pitch_pair import Both, Pair, by_gear
from gearlink.core.parts.gears.rating.conditions import Conditions, LimitLine, Point, damage, limit_line, safety_of
from gearlink.core.parts.gears.rating.materials import GearSteel

if TYPE_CHECKING:
    from gearlink.core.parts.gears.data import GearData
    from gearlink.core.parts.gears.mesh.contact import PathOfContact
    from gearlink.core.parts.gears.rating.load import Factors, Load, Material


_DENSITY = 7.83e-6
"""Of steel [kg/mm^3]."""
_STEEL = 206000.0
_LIGHT = 100.0
"""Line load [N/mm] below which the stiffness falls."""
_ROOTS_SHARE = 1.0 / 3.0
"""The maximum h/b of K_Fbeta."""


@dataclass(frozen=True, kw_only=True)
class Bodies:
    """What of a pair does not change with its load: stiffness of heavily loaded teeth, masses, tolerances.

    Parameters
        path : PathOfContact - with the common width
        widths : (float, float) [mm] - of each gear, for its tolerances
        materials : (Material, Material) - for E

    Source
        ISO 6336-1:2006, as two public programs and three KISSsoft reports have it; the standard was not opened
    """

    path: PathOfContact
    widths: Pair
    materials: tuple[Material, Material]
    conditions: Conditions

    @property
    def width(self) -> float:
        """b, that of the narrower gear [mm]."""
        assert self.path.face_width is not None, "a file with a rating gives it"
        return self.path.face_width

    @cached_property
    def order(self) -> tuple[int, int]:
        """The gear with fewer teeth, and the other."""
        one, other = self.path.pair.teeth
        return (0, 1) if one <= abs(other) else (1, 0)

    @cached_property
    def theoretical_stiffness(self) -> float:
        """c'_th = 1/q' [N/(mm um)] of a pair of solid discs.

        q' of the teeth of the virtual gears; the first index is that of the gear with fewer teeth, a ring's 1/z_n is 0
        """
        pair = self.path.pair
        turned = math.cos(pair.base_helix_angle) ** 2 * math.cos(pair.helix_angle)
        first, second = self.order
        one, other = (0.0 if pair.teeth[i] < 0 else turned / pair.teeth[i] for i in self.order)
        x, y = pair.profile_shift[first], pair.profile_shift[second]
        bent = 0.04723 + 0.15551 * one + 0.25791 * other - 0.00635 * x - 0.11654 * x * one
        return 1.0 / (bent - 0.00193 * y - 0.24188 * y * other + 0.00529 * x * x + 0.00182 * y * y)

    @cached_property
    def basic_rack_factor(self) -> float:
        """C_B, the mean of both gears; of a ring with the tool of the pair."""
        pair = self.path.pair
        flat = 1.0 - 0.02 * (20.0 - math.degrees(pair.pressure_angle))
        depths = [pair.addendum + pair.clearance if tool is None else tool.addendum for tool in pair.tools]
        return math.fsum(0.5 * (1.0 + 0.5 * (1.2 - depth)) * flat for depth in depths)

    @cached_property
    def blank_factor(self) -> float:
        """C_R of rims on webs; 1 of solid gears."""
        web = self.conditions.web
        return 1.0 if web is None else 1.0 + math.log(web[0]) / (5.0 * math.exp(web[1] / 5.0))

    @cached_property
    def stiffness(self) -> float:
        """c' from a line load of 100 N/mm on [N/(mm um)]."""
        one, other = (material.elastic_modulus for material in self.materials)
        shared = 2.0 * one * other / (one + other) / _STEEL
        tilt = math.cos(self.path.pair.helix_angle)
        return self.theoretical_stiffness * 0.8 * self.blank_factor * self.basic_rack_factor * tilt * shared

    @cached_property
    def masses(self) -> Pair:
        """m_1 and m_2: moment of inertia over b r_b^2 [kg/mm]; of a ring between its teeth and its outside."""
        pair = self.path.pair

        def mass(gear: int) -> float:
            middle = abs(pair.tip_radius[gear] + pair.root_radius[gear])
            inertia = abs(middle**4 - self.conditions.bores[gear] ** 4)
            return math.pi / 8.0 * _DENSITY * inertia / (2.0 * pair.base_radius[gear]) ** 2

        return by_gear(mass)

    @cached_property
    def reduced_mass(self) -> float:
        """m_red of the pair, of sun and planets, or of a planet in its fixed ring [kg/mm]."""
        given, (one, other) = self.conditions, self.masses
        if given.reduced_mass is not None:
            return given.reduced_mass
        if given.system == "planet-ring":
            return one
        planets = given.planets if given.system == "sun-planet" else 1
        return other * one / (planets * other + one)

    @cached_property
    def tolerances(self) -> tuple[ToothTolerances, ToothTolerances]:
        """Of ISO 1328-1, of each gear.

        Raises
            NoSolution - outside of the standard's range
        """
        pair, given = self.path.pair, self.conditions
        with at_key("rating.grade"):
            return by_gear(
                lambda gear: ToothTolerances(
                    grade=given.grades[gear],
                    module=pair.module,
                    diameter=2.0 * abs(pair.reference_radius[gear]),
                    width=self.widths[gear],
                    edition=given.edition,
                )
            )

    @cached_property
    def base_pitch_deviations(self) -> Pair:
        """f_pb of both gears [um]."""
        return by_gear(lambda gear: self.tolerances[gear].base_pitch(self.path.pair.transverse_pressure_angle))

    @property
    def base_pitch_deviation(self) -> float:
        """The greater f_pb [um]."""
        return max(self.base_pitch_deviations)

    @property
    def profile_form_deviation(self) -> float:
        """The greater f_f,alpha [um]."""
        return max(gear.profile_form for gear in self.tolerances)

    @cached_property
    def height_ratio(self) -> float:
        """h/b of the higher teeth, at most 1/3."""
        pair = self.path.pair
        heights = [abs(pair.tip_radius[gear] - pair.root_radius[gear]) for gear in (0, 1)]
        return min(max(heights) / self.width, _ROOTS_SHARE)


@dataclass(frozen=True, kw_only=True)
class LoadFactors:
    """The load factors of a pair at one point of its spectrum.

    Parameters
        load : Load - with speed; its factors replace those that `given` names
        given : frozenset of str - names of Factors that the file gives
        point : Point - factors of torque and speed; a torque above 0
        contact_ratio_factor : float - Z_eps

    Source
        ISO 6336-1:2006, as two public programs and three KISSsoft reports have it; the standard was not opened
    """

    bodies: Bodies
    load: Load
    given: frozenset[str]
    point: Point
    contact_ratio_factor: float

    # Load and speed

    @property
    def _conditions(self) -> Conditions:
        return self.bodies.conditions

    @property
    def _path(self) -> PathOfContact:
        return self.bodies.path

    @cached_property
    def speed(self) -> float:
        """n_1 [1/min]."""
        assert self.load.speed is not None, "a file with a rating gives it"
        return self.load.speed * self.point.speed

    @cached_property
    def pitch_line_speed(self) -> float:
        """v on the reference circle [m/s]."""
        return math.pi * 2.0 * self._path.pair.reference_radius[0] * self.speed / 60000.0

    @cached_property
    def line_load(self) -> float:
        """w = F_t K_A K_gamma/b [N/mm]."""
        factors = self.load.factors
        force = self.load.tangential_force(self._path.pair.reference_radius[0]) * self.point.torque
        return force * factors.application * factors.distribution / self.bodies.width

    @property
    def dynamic_load(self) -> float:
        """F_m/b = w K_v [N/mm]."""
        return self.line_load * self.dynamic

    # Stiffness

    @cached_property
    def single_stiffness(self) -> float:
        """c' [N/(mm um)]: below 100 N/mm it falls with the fourth root of the line load."""
        found, light = self.bodies.stiffness, self.line_load / _LIGHT
        return found * light**0.25 if light < 1.0 else found

    @property
    def mesh_stiffness(self) -> float:
        """c_gamma,alpha = c' (0.75 eps_alpha + 0.25)."""
        return self.single_stiffness * (0.75 * self._path.contact_ratio + 0.25)

    @property
    def mesh_stiffness_face(self) -> float:
        """c_gamma,beta = 0.85 c_gamma,alpha."""
        return 0.85 * self.mesh_stiffness

    # Dynamic factor

    @cached_property
    def resonance_speed(self) -> float:
        """n_E1 [1/min]."""
        return (
            30000.0 / (math.pi * self._path.pair.teeth[0]) * math.sqrt(self.mesh_stiffness / self.bodies.reduced_mass)
        )

    @property
    def resonance_ratio(self) -> float:
        """N = n_1/n_E1."""
        return self.speed / self.resonance_speed

    @cached_property
    def resonance_from(self) -> float:
        """N_S, where the main resonance begins."""
        light = self.line_load / _LIGHT
        return 0.5 + 0.35 * math.sqrt(light) if light < 1.0 else 0.85

    def _run_in(self, deviation: float) -> float:
        """y_p or y_f: the part of a deviation that running in takes away, mean of both gears [um]."""
        v = self.pitch_line_speed
        return math.fsum(0.5 * run_in(gear, deviation, v) for gear in self.run_in_by)

    @property
    def run_in_by(self) -> tuple[tuple[str, float], ...]:
        """How each gear runs in, and its sigma_Hlim."""
        return tuple((steel.kind.running_in, steel.contact_limit) for steel in self._conditions.steels)

    @cached_property
    def pitch_run_in(self) -> float:
        """y_p = y_alpha of f_pb [um]."""
        return self._run_in(self.bodies.base_pitch_deviation)

    @cached_property
    def profile_run_in(self) -> float:
        """y_f of f_f,alpha [um]."""
        return self._run_in(self.bodies.profile_form_deviation)

    @cached_property
    def deviation_shares(self) -> tuple[float, float, float]:
        """B_p, B_f and B_k: what deviations and relief are of the deflection."""
        per, bodies = self.single_stiffness / self.line_load, self.bodies
        relief = self._conditions.tip_relief or 0.0
        pitch = per * (bodies.base_pitch_deviation - self.pitch_run_in)
        return pitch, per * (bodies.profile_form_deviation - self.profile_run_in), abs(1.0 - per * relief)

    @property
    def total_contact_ratio(self) -> float:
        """eps_gamma."""
        found = self._path.total_contact_ratio
        assert found is not None, "the width is known"
        return found

    @cached_property
    def dynamic(self) -> float:
        """K_v, method B."""
        if "dynamic" in self.given:
            return self.load.factors.dynamic
        by = dynamic_constants(self.total_contact_ratio)
        p, f, k = self.deviation_shares
        ratio = self.resonance_ratio
        if ratio <= self.resonance_from:
            return 1.0 + ratio * (by[0] * p + by[1] * f + by[2] * k)
        in_resonance = 1.0 + by[0] * p + by[1] * f + by[3] * k
        if ratio <= 1.15:
            return in_resonance
        above = by[4] * p + by[5] * f + by[6]
        return above if ratio >= 1.5 else above + (in_resonance - above) * (1.5 - ratio) / 0.35

    # Face load factor

    @cached_property
    def shaft_deflection(self) -> float:
        """f_sh of the pinion and its shaft [um]."""
        gear = self.bodies.order[0]
        diameter, width = 2.0 * abs(self._path.pair.reference_radius[gear]), self.bodies.width
        shaft = self._conditions.shaft
        bent = 0.0
        if shaft is not None:
            bent = shaft.factor * shaft.span * shaft.offset / diameter**2 * (diameter / shaft.diameter) ** 4
        return self.dynamic_load * 0.023 * (abs(1.0 + bent - 0.3) + 0.3) * (width / diameter) ** 2

    @cached_property
    def mesh_misalignment(self) -> float:
        """F_betax before running in [um]: deflection and deviations added, the safe of their two signs."""
        given = self._conditions.misalignment
        if given is not None:
            return given
        one, other = (gear.helix_slope for gear in self.bodies.tolerances)
        bent, made = self._conditions.left
        found = 1.33 * bent * self.shaft_deflection + made * math.hypot(one, other)
        return max(found, 0.005 * self.dynamic_load, 0.5 * max(one, other))

    @cached_property
    def face_run_in(self) -> float:
        """y_beta [um], mean of both gears."""
        found, v = self.mesh_misalignment, self.pitch_line_speed
        return math.fsum(0.5 * run_in(gear, found, v, face=True) for gear in self.run_in_by)

    @cached_property
    def face_contact(self) -> float:
        """K_Hbeta, method C."""
        if "face_contact" in self.given:
            return self.load.factors.face_contact
        left = self.mesh_misalignment - self.face_run_in
        ratio = left * self.mesh_stiffness_face / (2.0 * self.dynamic_load)
        return 1.0 + ratio if ratio <= 1.0 else 2.0 * math.sqrt(ratio)

    @cached_property
    def face_bending(self) -> float:
        """K_Fbeta = K_Hbeta^(1/(1 + h/b + (h/b)^2))."""
        if "face_bending" in self.given:
            return self.load.factors.face_bending
        height = self.bodies.height_ratio
        return float(self.face_contact ** (1.0 / (1.0 + height + height * height)))

    # Transverse load factor

    @cached_property
    def transverse(self) -> float:
        """K_alpha before its bounds, with the greater of f_pb and f_f,alpha and y_alpha of f_pb."""
        bodies, eps = self.bodies, self.total_contact_ratio
        deviation = max(bodies.base_pitch_deviation, bodies.profile_form_deviation) - self.pitch_run_in
        q = self.mesh_stiffness * deviation / (self.dynamic_load * self.face_contact)
        if eps <= 2.0:
            return 0.5 * eps * (0.9 + 0.4 * q)
        return 0.9 + 0.4 * q * math.sqrt(2.0 * (eps - 1.0) / eps)

    @cached_property
    def transverse_contact(self) -> float:
        """K_Halpha, from 1 to eps_gamma/(eps_alpha Z_eps^2)."""
        if "transverse_contact" in self.given:
            return self.load.factors.transverse_contact
        most = self.total_contact_ratio / (self._path.contact_ratio * self.contact_ratio_factor**2)
        return max(1.0, min(self.transverse, most))

    @cached_property
    def transverse_bending(self) -> float:
        """K_Falpha, from 1 to eps_gamma/(eps_alpha Y_eps)."""
        if "transverse_bending" in self.given:
            return self.load.factors.transverse_bending
        eps = self._path.contact_ratio
        share = 0.25 + 0.75 * math.cos(self._path.pair.base_helix_angle) ** 2 / eps
        return max(1.0, min(self.transverse, self.total_contact_ratio / (eps * share)))

    @property
    def contact(self) -> float:
        """K_A K_gamma K_v K_Hbeta K_Halpha."""
        factors = self.load.factors
        return factors.application * factors.distribution * self.dynamic * self.face_contact * self.transverse_contact

    @property
    def bending(self) -> float:
        """K_A K_gamma K_v K_Fbeta K_Falpha."""
        factors = self.load.factors
        return factors.application * factors.distribution * self.dynamic * self.face_bending * self.transverse_bending


def dynamic_constants(total_contact_ratio: float) -> tuple[float, ...]:
    """C_v1 to C_v7 of the dynamic factor.

    Example
        >>> dynamic_constants(1.5)
        (0.32, 0.34, 0.23, 0.9, 0.47, 0.47, 0.75)

    Source
        ISO 6336-1:2006, table of C_v; those of N > 0.85 from memory, in two public programs alike
    """
    eps = total_contact_ratio
    last = 0.125 * math.sin(math.pi * (min(max(eps, 1.5), 2.5) - 2.0)) + 0.875  # 0.75 below, 1 above
    if eps <= 2.0:
        return 0.32, 0.34, 0.23, 0.9, 0.47, 0.47, last
    in_resonance = (0.57 - 0.05 * eps) / (eps - 1.44)
    return 0.32, 0.57 / (eps - 0.3), 0.096 / (eps - 1.56), in_resonance, 0.47, 0.12 / (eps - 1.74), last


def run_in(material: tuple[str, float], deviation: float, speed: float, *, face: bool = False) -> float:
    """What running in takes away of a deviation [um].

    Parameters
        material : (str, float) - "soft", "iron" or "hard", and sigma_Hlim [N/mm^2]
        deviation : float [um] - f_pb or f_f,alpha, or F_betax across the face
        speed : float [m/s] - on the reference circle
        face : bool - y_beta, else y_alpha
    Example
        >>> run_in(("hard", 1500.0), 16.0, 20.0), run_in(("soft", 800.0), 16.0, 20.0)
        (1.2, 3.2)

    Source
        ISO 6336-1:2006; the bounds from memory
    """
    of, limit = material
    part = 2.0 if face else 1.0
    if of == "hard":
        return min((0.15 if face else 0.075) * deviation, 6.0 if face else 3.0)
    if of == "iron":
        most = math.inf if speed <= 5.0 else (45.0 if face else 22.0) if speed <= 10.0 else (22.0 if face else 11.0)
        return min((0.55 if face else 0.275) * deviation, most)
    most = math.inf if speed <= 5.0 else part * (12800.0 if speed <= 10.0 else 6400.0) / limit
    return min(part * 160.0 * deviation / limit, most, deviation)


Rows = tuple[tuple[float, float, LimitLine], ...]
"""Load cycles, stress and limit line of each point of a spectrum."""
_COMPUTED = ("dynamic", "face_contact", "face_bending", "transverse_contact", "transverse_bending")
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
            eps = self.data.path.contact_ratio
            limit = "above 4" if eps > 0.0 else "where no teeth touch"
            raise NoSolution(f"contact ratio {eps:.4g}: ISO 6336 rates none {limit}")
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
        return replace(self.load.factors, **{name: getattr(self.at_load, name) for name in _COMPUTED})

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
        return by_gear(lambda gear: self.cycles_at(gear, Point()))

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

        return by_gear(of)

    @property
    def size_factor_contact(self) -> Pair:
        """Z_X, 1 by ISO 6336-2."""
        return 1.0, 1.0

    def flank_line_at(self, gear: int, speed: float) -> LimitLine:
        """sigma_HG over the load cycles at a pitch line speed [m/s]."""
        steel = self.steels[gear]
        limit = steel.contact_limit
        film = self.lubricant_factor * self.velocity_factor_at(speed) * self.roughness_factor
        reference = limit * film * self.work_hardening_factor[gear]
        static = 1.05 - (self._brinell(gear) - _SOFTENED[0]) / 6800.0 if self.hardened[gear] else 1.0
        long, pitting = self.conditions.long_life, self.conditions.pitting_allowed
        return limit_line(steel.kind.flank, limit * static, reference, long, pitting_allowed=pitting)

    @cached_property
    def flank_lines(self) -> tuple[LimitLine, LimitLine]:
        """sigma_HG of both gears over the load cycles at the speed of the load."""
        return by_gear(lambda gear: self.flank_line_at(gear, self.at_load.pitch_line_speed))

    @cached_property
    def life_factor_contact(self) -> Pair:
        """Z_NT at N_L."""
        return self._at_life(self.flank_lines, LimitLine.factor_at)

    def _at_life(self, lines: tuple[Any, Any], value: Callable[[LimitLine, float], float]) -> tuple[Any, Any]:
        """A value of limit lines at N_L, at least one load cycle; None without a line."""
        return by_gear(lambda i: None if lines[i] is None else value(lines[i], max(self.load_cycles[i], 1.0)))

    @cached_property
    def pitting_limit_stress(self) -> Pair:
        """sigma_HG at N_L."""
        return self._at_life(self.flank_lines, LimitLine.at)

    # Root

    @cached_property
    def slip_layer(self) -> Pair:
        """rho' [mm]."""
        return by_gear(lambda gear: slip_layer(self.steels[gear]))

    @cached_property
    def notch_sensitivity_factor(self) -> Both:
        """Y_delta,relT; None of a root that is not rated."""
        return by_gear(self._notched)

    def _notched(self, gear: int) -> float | None:
        section = self.data.root.sections[gear]
        if section is None:
            return None
        slip, steepness = self.slip_layer[gear], 0.2 * (1.0 + 2.0 * section.notch)
        return (1.0 + math.sqrt(slip * steepness)) / (1.0 + math.sqrt(1.2 * slip))

    @cached_property
    def static_notch_sensitivity(self) -> Both:
        """Y_delta,relT at the static knee."""

        def of(gear: int) -> float | None:
            section = self.data.root.sections[gear]
            return None if section is None else static_notch(self.steels[gear], section.stress_correction_factor)

        return by_gear(of)

    @cached_property
    def surface_factor(self) -> Pair:
        """Y_R,relT."""
        return by_gear(lambda i: surface_factor(self.steels[i].kind.surface, self.conditions.root_roughness[i]))

    @cached_property
    def size_factor_bending(self) -> Pair:
        """Y_X."""
        return by_gear(lambda gear: size_factor(self.steels[gear].kind.size, self.data.pair.module))

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
        return by_gear(self._root_line)

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
        return self._at_life(self.root_lines, LimitLine.factor_at)

    @cached_property
    def root_limit_stress(self) -> Both:
        """sigma_FG at N_L."""
        return self._at_life(self.root_lines, LimitLine.at)

    # Safety, damage and life

    @cached_property
    def _points(self) -> tuple[tuple[Point, LoadFactors], ...]:
        """The points of the spectrum that carry a load, with their factors."""
        rows = (point for point in self.conditions.points if point.torque > 0.0 and point.share > 0.0)
        return tuple((point, self.at_load if point == Point() else self.factors_at(point)) for point in rows)

    @cached_property
    def flank_rows(self) -> tuple[Rows, Rows]:
        """Those of both flanks; empty of a gear without stress."""
        return by_gear(self._flank_rows)

    def _flank_rows(self, gear: int) -> Rows:
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
    def root_rows(self) -> tuple[Rows, Rows]:
        """Those of both roots; empty of a root that is not rated."""
        return by_gear(self._root_rows)

    def _root_rows(self, gear: int) -> Rows:
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
        return self._safety(self.flank_rows, lambda: self.pitting_limit_stress)

    @cached_property
    def safety_bending(self) -> Both:
        """S_F: sigma_FG/sigma_F, of a spectrum the S at which the damage is 1."""
        return self._safety(self.root_rows, lambda: self.root_limit_stress)

    def _safety(self, rows: tuple[Rows, Rows], limits: Callable[[], tuple[Any, Any]]) -> Both:
        if self.conditions.spectrum:
            return by_gear(lambda gear: safety_of(rows[gear]))
        limit = limits()
        return by_gear(lambda gear: limit[gear] / rows[gear][0][1] if rows[gear] else None)

    @cached_property
    def damage_pitting(self) -> Both:
        """U of the flanks at the required safety."""
        return _damage(self.flank_rows, self.data.required.pitting)

    @cached_property
    def damage_bending(self) -> Both:
        """U of the roots at the required safety."""
        return _damage(self.root_rows, self.data.required.bending)

    @cached_property
    def pitting_life(self) -> Both:
        """L_h/U [h]; None where no damage arises."""
        return self._life(self.damage_pitting)

    @cached_property
    def bending_life(self) -> Both:
        """L_h/U [h]; None where no damage arises."""
        return self._life(self.damage_bending)

    def _life(self, found: Both) -> Both:
        one, other = (self.conditions.life / used if used else None for used in found)
        return one, other

    @cached_property
    def static_safety(self) -> tuple[Both, Both]:
        """Static limit over the maximum stress of the spectrum, of flanks and roots."""

        def least(rows: Rows) -> float | None:
            return min((line.static / stress for _, stress, line in rows), default=None)

        flank, root = ((least(rows[0]), least(rows[1])) for rows in (self.flank_rows, self.root_rows))
        return flank, root

    # Others

    @cached_property
    def running_in_relief(self) -> float:
        """C_ay = (sigma_Hlim/97 - 18.45)^2/18 + 1.5 [um], mean of both gears."""
        return math.fsum(0.5 * ((limit / 97.0 - 18.45) ** 2 / 18.0 + 1.5) for limit in self.contact_limits)

    @cached_property
    def scuffing(self) -> Scuffing | None:
        """The integral temperature; None of rings, and without what the oil needs."""
        if self.conditions.scuffing_stage is None or self.data.pair.internal:
            return None
        return Scuffing(self)


def _damage(rows: tuple[Rows, Rows], safety: float) -> Both:
    return by_gear(lambda gear: damage(rows[gear], safety) if rows[gear] else None)


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


_TEST_TORQUE = {8: 239.3, 9: 302.0, 10: 372.6, 11: 450.1, 12: 534.5, 13: 626.9, 14: 714.2}
"""Torque of the pinion at each load stage of the test FZG A/8.3/90 [N m]; that of stage 14 in a printed report."""
_KELVIN = 273.15


@dataclass(frozen=True)
class Scuffing:
    """The integral temperature of a pair and the one at which its oil fails.

    Parameters
        rated : Rated - of an external pair, whose conditions have oil temperature and load stage
    Notes
        The pinion, the gear with fewer teeth, drives. Of the tip relief no more counts than the deflection C_eff.

    Source
        ISO/TR 13989-2, ISO/TS 6336-21: all values of a KISSsoft report are met to the digits that it prints; X_Q where
        it is not 1, X_eps where a part of the path is longer than a base pitch, and X_mp of several mates from memory
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

    @property
    def speed(self) -> float:
        """v on the reference circle [m/s]."""
        return self.rated.at_load.pitch_line_speed

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
        pair = self._path.pair
        rolling = 2.0 * self.speed * math.tan(pair.working_pressure_angle) * math.cos(pair.transverse_pressure_angle)
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
    def angle_factor(self) -> float:
        """X_alphabeta."""
        pair = self._path.pair
        working, transverse = pair.working_pressure_angle, pair.transverse_pressure_angle
        above = math.sin(working) * math.cos(pair.pressure_angle) * math.cos(pair.helix_angle)
        return float(1.22 * above**0.25 / math.sqrt(math.cos(working) * math.cos(transverse)))

    @cached_property
    def approach_factor(self) -> float:
        """X_Q of the approach, the part of the path before the pitch point, over the recess."""
        recess, approach = self.addendum_contact_ratios
        return min(1.0, max(0.6, 1.4 - 4.0 / 15.0 * approach / recess)) if recess > 0.0 else 0.6

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
        hot = self.friction * self.thermal_flash_factor * self.geometry_factor * self.angle_factor
        hot *= (self.helical_factor * self.line_load) ** 0.75 * math.sqrt(self.speed)
        spread = abs(self._path.pair.center_distance) ** 0.25
        return float(hot / spread * self.contact_ratio_factor / (self.approach_factor * self.relief_factor))

    @property
    def mates(self) -> int:
        """n_p, the mates of that gear of the pair which has more: a sun has its planets, a planet sun and ring."""
        if self._conditions.system == "sun-planet":
            return max(self._conditions.planets, 2)
        return 2 if any(self.rated.data.idlers) else 1

    @property
    def mating_factor(self) -> float:
        """X_mp of the heat that all mates of a gear bring into it."""
        return (1.0 + self.mates) / 2.0

    @cached_property
    def mass_temperature(self) -> float:
        """theta_M [deg C], with X_S = 1 of dip lubrication."""
        oil = self._conditions.oil_temperature
        assert oil is not None, "given with the load stage"
        return oil + 0.7 * self.mating_factor * self.flash_temperature

    @cached_property
    def integral_temperature(self) -> float:
        """theta_int [deg C]."""
        return self.mass_temperature + 1.5 * self.flash_temperature

    @cached_property
    def scuffing_temperature(self) -> float:
        """theta_Sint of the oil, by its test, with X_W = 1 of case-hardened steel [deg C]."""
        stage = self._conditions.scuffing_stage
        assert stage is not None, "the rating requires it"
        torque = _TEST_TORQUE[stage]
        thin = (100.0 / self._conditions.viscosity_40) ** 0.02
        return float(80.0 + 0.23 * torque + 0.3 * torque * thin)

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
