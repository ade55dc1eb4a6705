"""Load factors by ISO 6336-1: stiffness, dynamic factor (method B), face load factor (method C), transverse one."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from gearlink.core.base.errors import at_key
from gearlink.core.base.results import cached_property
from gearlink.core.parts.gears.measures.iso_1328 import ToothTolerances
from gearlink.core.parts.gears.mesh.pitch_pair import Pair
from gearlink.core.parts.gears.rating.conditions import Conditions, Point

if TYPE_CHECKING:
    from gearlink.core.parts.gears.mesh.contact import PathOfContact
    from gearlink.core.parts.gears.rating.load import Load, Material

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
        conditions : Conditions

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
        return self._mass(0), self._mass(1)

    def _mass(self, gear: int) -> float:
        pair, bore = self.path.pair, self.conditions.bores[gear]
        middle = abs(pair.tip_radius[gear] + pair.root_radius[gear])
        inertia = abs(middle**4 - bore**4)
        return math.pi / 8.0 * _DENSITY * inertia / (2.0 * pair.base_radius[gear]) ** 2

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
        pair, edition = self.path.pair, self.conditions.edition
        with at_key("rating.grade"):
            one, other = (
                ToothTolerances(
                    grade=self.conditions.grades[gear],
                    module=pair.module,
                    diameter=2.0 * abs(pair.reference_radius[gear]),
                    width=self.widths[gear],
                    edition=edition,
                )
                for gear in (0, 1)
            )
        return one, other

    @cached_property
    def base_pitch_deviations(self) -> Pair:
        """f_pb of both gears [um]."""
        one, other = (each.base_pitch(self.path.pair.transverse_pressure_angle) for each in self.tolerances)
        return one, other

    @property
    def base_pitch_deviation(self) -> float:
        """The greater f_pb [um]."""
        return max(self.base_pitch_deviations)

    @property
    def profile_form_deviation(self) -> float:
        """The greater f_f,alpha [um]."""
        return max(each.profile_form for each in self.tolerances)

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
        bodies : Bodies
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
        return math.fsum(0.5 * run_in(each, deviation, v) for each in self.run_in_by)

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
        one, other = (each.helix_slope for each in self.bodies.tolerances)
        bent, made = self._conditions.left
        found = 1.33 * bent * self.shaft_deflection + made * math.hypot(one, other)
        return max(found, 0.005 * self.dynamic_load, 0.5 * max(one, other))

    @cached_property
    def face_run_in(self) -> float:
        """y_beta [um], mean of both gears."""
        found, v = self.mesh_misalignment, self.pitch_line_speed
        return math.fsum(0.5 * run_in(each, found, v, face=True) for each in self.run_in_by)

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
