"""The calculation sheet of a rating: every factor with its formula, its inputs, where it is from, and what confirms it.

A formula goes by R and the number of its section in docs/rating.md. It is confirmed where a number printed elsewhere (a
report, a worked example) meets it, in the branch that is used here; what is given has no formula to confirm.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from gearlink.core.base.report import Table

if TYPE_CHECKING:
    from gearlink.core.parts.gears.rating.rated import Rated

_1, _2, _3, _5, _6 = (f"ISO 6336-{part}" for part in (1, 2, 3, 5, 6))
COLUMNS = ("symbol", "name", "gear1", "gear2", "unit", "rule", "inputs", "origin", "confirmed")


@dataclass(frozen=True)
class Line:
    """A line of the sheet.

    Fields
        values : (gear 1, gear 2) - gear 2 None of what is the pair's
        rule : str - "R4 ISO 6336-1"
        inputs : str - "name=value, ..."
        origin : str - "computed", "given" or "default"
    """

    symbol: str
    name: str
    values: tuple[Any, Any]
    unit: str
    rule: str
    inputs: str = ""
    origin: str = "computed"
    confirmed: bool = True

    @property
    def decides(self) -> bool:
        """Whether an unconfirmed formula changes the result: a factor of 1 does not."""
        neutral = self.unit == "1" and all(value is None or value == 1.0 for value in self.values)
        return not self.confirmed and not neutral


def factors_table(rated: Rated) -> Table:
    """The table `factors`."""
    rows = [
        (line.symbol, line.name, *line.values, line.unit, line.rule, line.inputs, line.origin, line.confirmed)
        for line in lines(rated)
    ]
    return Table("factors", COLUMNS, ("",) * len(COLUMNS), tuple(list(column) for column in zip(*rows, strict=True)))


def lines(rated: Rated) -> Iterator[Line]:
    """The lines of the sheet, in the order of the calculation."""
    for part in (_tolerances, _stiffness, _dynamics, _face, _transverse, _flank, _root, _life, _scuffing):
        yield from part(rated)


def unconfirmed(rated: Rated) -> list[str]:
    """Symbols of the lines without a printed number that decide, each once."""
    return list(dict.fromkeys(line.symbol for line in lines(rated) if line.decides))


def _said(**values: Any) -> str:
    """Inputs as text."""
    shown = ((name, value) for name, value in values.items() if value is not None)
    return ", ".join(f"{name}={_shown(value)}" for name, value in shown)


def _shown(value: Any) -> str:
    if isinstance(value, tuple):
        return "/".join(map(_shown, value))
    return value if isinstance(value, str) else f"{value:.6g}"


def _tolerances(rated: Rated) -> Iterator[Line]:
    given, bodies, pair = rated.conditions, rated.bodies, rated.data.pair
    rule = f"R2 ISO 1328-1:{given.edition}"
    inputs = _said(
        grade=given.grades, m=pair.module, d=tuple(2.0 * abs(r) for r in pair.reference_radius), b=bodies.widths
    )
    one, other = bodies.tolerances
    for symbol, name, values in (
        ("f_pt", "single pitch deviation", (one.single_pitch, other.single_pitch)),
        ("f_f,alpha", "profile form deviation", (one.profile_form, other.profile_form)),
        ("f_H,beta", "helix slope deviation", (one.helix_slope, other.helix_slope)),
    ):
        yield Line(symbol, name, values, "um", rule, inputs)
    turned = _said(f_pt=(one.single_pitch, other.single_pitch), alpha_t=math.degrees(pair.transverse_pressure_angle))
    yield Line("f_pb", "base pitch deviation", bodies.base_pitch_deviations, "um", rule, turned)


def _stiffness(rated: Rated) -> Iterator[Line]:
    bodies, at, pair = rated.bodies, rated.at_load, rated.data.pair
    per, rule = "N/(mm um)", f"R3 {_1}"
    teeth = _said(z=pair.teeth, x=pair.profile_shift)
    yield Line("c'_th", "theoretical stiffness", (bodies.theoretical_stiffness, None), per, rule, teeth)
    web = rated.conditions.web
    origin = "default" if web is None else "computed"
    yield Line("C_R", "blank factor", (bodies.blank_factor, None), "1", rule, _said(web=web), origin)
    inputs = _said(alpha_n=math.degrees(pair.pressure_angle))
    yield Line("C_B", "basic rack factor", (bodies.basic_rack_factor, None), "1", rule, inputs)
    light = _said(c_th=bodies.theoretical_stiffness, C_M=0.8, C_R=bodies.blank_factor, C_B=bodies.basic_rack_factor)
    heavy = at.line_load >= 100.0
    inputs = light if heavy else f"{light}, {_said(w=at.line_load)}"
    yield Line("c'", "single stiffness", (at.single_stiffness, None), per, rule, inputs, confirmed=heavy)
    inputs = _said(c=at.single_stiffness, eps_alpha=rated.data.path.contact_ratio)
    yield Line("c_gamma,alpha", "mesh stiffness", (at.mesh_stiffness, None), per, rule, inputs)
    inputs = _said(c_gamma_alpha=at.mesh_stiffness)
    yield Line("c_gamma,beta", "mesh stiffness across the face", (at.mesh_stiffness_face, None), per, rule, inputs)


def _origin(rated: Rated, factor: str) -> str:
    return "given" if factor in rated.given else "computed"


def _dynamics(rated: Rated) -> Iterator[Line]:
    bodies, at, given = rated.bodies, rated.at_load, rated.conditions
    rule, pair = f"R4 {_1}", rated.data.pair
    factors = rated.load.factors
    for name, symbol, value in (
        ("application", "K_A", factors.application),
        ("distribution", "K_gamma", factors.distribution),
    ):
        origin = "given" if name in rated.given else "default"
        yield Line(symbol, f"{name} factor", (value, None), "1", f"R1 {_1}", origin=origin)
    inputs = _said(F_t=rated.load.tangential_force(pair.reference_radius[0]), K_A=factors.application, b=bodies.width)
    yield Line("w", "line load F_t K_A K_gamma/b", (at.line_load, None), "N/mm", f"R1 {_1}", inputs)
    yield Line("v", "pitch line speed", (at.pitch_line_speed, None), "m/s", f"R1 {_1}", _said(n_1=at.speed))
    inputs = _said(system=given.system, m=bodies.masses, bore=given.bores)
    origin = "computed" if given.reduced_mass is None else "given"
    yield Line("m_red", "reduced mass", (bodies.reduced_mass, None), "kg/mm", rule, inputs, origin)
    inputs = _said(c_gamma_alpha=at.mesh_stiffness, m_red=bodies.reduced_mass, z_1=pair.teeth[0])
    yield Line("n_E1", "resonance speed", (at.resonance_speed, None), "1/min", rule, inputs)
    inputs = _said(n_1=at.speed, n_E1=at.resonance_speed)
    yield Line("N", "resonance ratio", (at.resonance_ratio, None), "1", rule, inputs)
    for symbol, name, value, deviation in (
        ("y_p", "pitch run-in", at.pitch_run_in, bodies.base_pitch_deviation),
        ("y_f", "profile run-in", at.profile_run_in, bodies.profile_form_deviation),
    ):
        inputs = _said(f=deviation, sigma_Hlim=rated.contact_limits, v=at.pitch_line_speed)
        printed = all(_run_in_is_printed(kind, limit, deviation, at.pitch_line_speed) for kind, limit in at.run_in_by)
        yield Line(symbol, name, (value, None), "um", rule, inputs, confirmed=printed)
    u = abs(pair.gear_ratio)
    reach = at.pitch_line_speed * pair.teeth[0] / 100.0 * u / math.sqrt(1.0 + u * u)
    near_1 = " (below 3 m/s it hardly matters)" if reach < 3.0 else ""
    shares = _said(
        N=at.resonance_ratio,
        **dict(zip(("B_p", "B_f", "B_k"), at.deviation_shares, strict=True)),
        v_z=f"{reach:.3g}{near_1}",
    )
    origin = _origin(rated, "dynamic")
    below = at.resonance_ratio <= at.resonance_from or origin == "given"
    yield Line("K_v", "dynamic factor", (at.dynamic, None), "1", rule, shares, origin, below)


def _run_in_is_printed(kind: str, limit: float, deviation: float, speed: float, *, face: bool = False) -> bool:
    """Whether a report prints this branch of the running in: neither iron nor a bound, nor y_beta of soft steel."""
    if kind == "hard":
        return (0.15 if face else 0.075) * deviation < (6.0 if face else 3.0)
    if kind == "iron" or face:
        return False
    bound = 1.0 if speed <= 5.0 else (12800.0 if speed <= 10.0 else 6400.0) / (160.0 * deviation)
    return 160.0 / limit < 1.0 and bound >= 1.0


def _face(rated: Rated) -> Iterator[Line]:
    at, given, rule = rated.at_load, rated.conditions, f"R5 {_1}"
    origin = _origin(rated, "face_contact")
    if origin == "computed":
        plain, name = given.shaft is None, "deflection of pinion and shaft"
        if given.misalignment is None:
            position = None if given.shaft is None else given.shaft.position
            inputs = _said(F_m_b=at.dynamic_load, b=rated.bodies.width, position=position)
            yield Line("f_sh", name, (at.shaft_deflection, None), "um", rule, inputs, confirmed=plain)
        inputs = _said(
            f_sh=at.shaft_deflection,
            f_H_beta=tuple(gear.helix_slope for gear in rated.bodies.tolerances),
            modification=given.modification,
        )
        measured, name = given.misalignment is not None, "misalignment before running in"
        inputs, how = ("", "given") if measured else (inputs, "computed")
        sure = measured or given.modification == "none"
        yield Line("F_beta,x", name, (at.mesh_misalignment, None), "um", rule, inputs, how, sure)
        inputs = _said(F_beta_x=at.mesh_misalignment, sigma_Hlim=rated.contact_limits)
        printed = all(
            _run_in_is_printed(kind, limit, at.mesh_misalignment, at.pitch_line_speed, face=True)
            for kind, limit in at.run_in_by
        )
        yield Line("y_beta", "run-in across the face", (at.face_run_in, None), "um", rule, inputs, confirmed=printed)
    left, per = at.mesh_misalignment - at.face_run_in, at.mesh_stiffness_face
    inputs = "" if origin == "given" else _said(F_beta_y=left, c_gamma_beta=per, F_m_b=at.dynamic_load)
    straight = at.face_contact <= 2.0 or origin == "given"
    yield Line("K_Hbeta", "face load factor, flank", (at.face_contact, None), "1", rule, inputs, origin, straight)
    inputs, origin = _said(K_Hbeta=at.face_contact, h_b=rated.bodies.height_ratio), _origin(rated, "face_bending")
    yield Line("K_Fbeta", "face load factor, root", (at.face_bending, None), "1", rule, inputs, origin)


def _transverse(rated: Rated) -> Iterator[Line]:
    at, bodies, rule = rated.at_load, rated.bodies, f"R6 {_1}"
    deviation = max(bodies.base_pitch_deviation, bodies.profile_form_deviation)
    inputs = _said(
        f=deviation, y_alpha=at.pitch_run_in, c_gamma_alpha=at.mesh_stiffness, eps_gamma=at.total_contact_ratio
    )
    for symbol, where, name, value in (
        ("K_Halpha", "flank", "transverse_contact", at.transverse_contact),
        ("K_Falpha", "root", "transverse_bending", at.transverse_bending),
    ):
        origin = _origin(rated, name)
        free = origin == "given" or value == 1.0 or value >= at.transverse
        yield Line(symbol, f"transverse load factor, {where}", (value, None), "1", rule, inputs, origin, free)


def _limit_origin(rated: Rated, key: str) -> str:
    return "given" if all(key in steel.given for steel in rated.steels) else "computed"


def _flank(rated: Rated) -> Iterator[Line]:
    given, rule, steels = rated.conditions, f"R7 {_2}", rated.steels
    origin = _limit_origin(rated, "contact_limit")
    inputs = _said(material=tuple(steel.name for steel in steels), quality=given.quality, hardness=_hardness(rated))
    printed = all(
        "contact_limit" in steel.given or (steel.of == "case-hardened" and given.quality == "MQ") for steel in steels
    )
    yield Line("sigma_Hlim", "contact strength", rated.contact_limits, "N/mm^2", f"R11 {_5}", inputs, origin, printed)
    sure = not 850.0 <= rated.softer_limit <= 1200.0
    inputs = _said(C_ZL=rated.lubricant_constant, nu_40=given.viscosity_40)
    yield Line("Z_L", "lubricant factor", (rated.lubricant_factor, None), "1", rule, inputs, confirmed=sure)
    inputs = _said(C_ZV=rated.lubricant_constant + 0.02, v=rated.at_load.pitch_line_speed)
    yield Line("Z_V", "velocity factor", (rated.velocity_factor, None), "1", rule, inputs, confirmed=sure)
    inputs = _said(Rz=given.flank_roughness, rho_red=rated.reduced_curvature)
    rough = "computed" if "roughness.flank" in given.given else "default"
    yield Line("Z_R", "roughness factor", (rated.roughness_factor, None), "1", rule, inputs, rough, sure)
    inputs = _said(
        HB=tuple("-" if s.brinell is None else f"{s.brinell:g}" for s in steels), R_zH=rated.equivalent_roughness
    )
    smooth = rated.equivalent_roughness <= 3.0
    yield Line("Z_W", "work hardening factor", rated.work_hardening_factor, "1", rule, inputs, confirmed=smooth)
    yield Line("Z_X", "size factor, flank", rated.size_factor_contact, "1", rule)


def _hardness(rated: Rated) -> tuple[str, ...]:
    return tuple("-" if steel.hardness is None else f"{steel.hardness:g}" for steel in rated.steels)


def _root(rated: Rated) -> Iterator[Line]:
    given, rule, steels = rated.conditions, f"R8 {_3}", rated.steels
    origin, limits = _limit_origin(rated, "bending_limit"), (steels[0].bending_limit, steels[1].bending_limit)
    inputs = _said(material=tuple(steel.name for steel in steels), quality=given.quality, hardness=_hardness(rated))
    printed = origin == "given"
    yield Line(
        "sigma_Flim",
        "bending strength",
        limits,
        "N/mm^2",
        f"R11 {_5}",
        inputs,
        origin,
        printed,
    )
    yield Line("Y_ST", "stress correction of the test gears", (2.0, 2.0), "1", rule)
    sections = rated.data.root.sections
    notches = tuple("-" if section is None else f"{section.notch:.6g}" for section in sections)
    printed = all(steel.of in ("case-hardened", "induction-hardened") or _hard_by_yield(steel) for steel in steels)
    inputs, values = _said(rho=rated.slip_layer, q_s=notches), rated.notch_sensitivity_factor
    yield Line("Y_delta,relT", "notch sensitivity factor", values, "1", rule, inputs, confirmed=printed)
    printed = all(s.kind.surface == "steel" for s in steels) and min(given.root_roughness) >= 1.0
    rough = "computed" if "roughness.root" in given.given else "default"
    inputs = _said(Rz=given.root_roughness)
    yield Line("Y_R,relT", "surface factor", rated.surface_factor, "1", rule, inputs, rough, printed)
    printed = all(steel.kind.size != "iron" for steel in steels)
    inputs = _said(m=rated.data.pair.module)
    yield Line("Y_X", "size factor, root", rated.size_factor_bending, "1", rule, inputs, confirmed=printed)
    origin = "default" if given.mean_stress is None else "given"
    yield Line("Y_M", "mean stress influence factor", rated.mean_stress_factor, "1", rule, origin=origin)


def _hard_by_yield(steel: Any) -> bool:
    return steel.kind.notch is None and steel.yield_strength >= 1000.0


def _life(rated: Rated) -> Iterator[Line]:
    given = rated.conditions
    inputs = _said(L_h=given.life, contacts=given.contacts)
    yield Line("N_L", "load cycles", rated.load_cycles, "1", f"R9 {_6}", inputs)
    plain = all(
        line.bend is None and steel.kind.flank.factor == 1.6
        for line, steel in zip(rated.flank_lines, rated.steels, strict=True)
    )
    inputs = _said(N_L=rated.load_cycles, long_life=given.long_life)
    yield Line("Z_NT", "life factor, flank", rated.life_factor_contact, "1", f"R9 {_2}", inputs, confirmed=plain)
    yield Line("sigma_HG", "limit stress of the flank", rated.pitting_limit_stress, "N/mm^2", f"R7 {_2}")
    lasting = all(
        line is None or cycles >= line.endurance.reference
        for line, cycles in zip(rated.root_lines, rated.load_cycles, strict=True)
    )
    yield Line("Y_NT", "life factor, root", rated.life_factor_bending, "1", f"R9 {_3}", inputs, confirmed=lasting)
    if not lasting:
        inputs = _said(yield_strength=tuple(steel.yield_strength for steel in rated.steels))
        name, values = "notch sensitivity at the static knee", rated.static_notch_sensitivity
        yield Line("Y_delta,relT st", name, values, "1", f"R9 {_3}", inputs, confirmed=False)
    yield Line("sigma_FG", "limit stress of the root", rated.root_limit_stress, "N/mm^2", f"R8 {_3}")
    required, rule = rated.data.required, f"R9 {_6}"
    yield Line("U_H", "damage of the flank", rated.damage_pitting, "1", rule, _said(S=required.pitting))
    yield Line("U_F", "damage of the root", rated.damage_bending, "1", rule, _said(S=required.bending))


def _scuffing(rated: Rated) -> Iterator[Line]:
    found, given, rule = rated.scuffing, rated.conditions, "R10 ISO/TR 13989-2"
    if found is None:
        return
    inputs = _said(nu_40=given.viscosity_40, nu_100=given.viscosity_100, oil=given.oil_temperature)
    yield Line("eta", "viscosity at the oil temperature", (found.viscosity, None), "mPa s", rule, inputs)
    inputs = _said(w=rated.at_load.line_load)
    yield Line("w'", "line load w K_v K_Hbeta K_Halpha", (found.line_load, None), "N/mm", rule, inputs)
    yield Line("K_Bgamma", "helical load factor of scuffing", (found.helical_factor, None), "1", rule)
    inputs = _said(w=found.line_load, rho_C=found.curvature, Ra=given.ra, eta=found.viscosity)
    yield Line("mu", "mean coefficient of friction", (found.friction, None), "1", rule, inputs)
    yield Line("X_M", "thermal flash factor", (found.thermal_flash_factor, None), "K N^-3/4 s^1/2 m^-1/2 mm", rule)
    yield Line("X_BE", "geometry factor", (found.geometry_factor, None), "1", rule, _said(rho_E=found.tip_curvatures))
    yield Line("X_alphabeta", "angle factor", (found.angle_factor, None), "1", rule)
    short = max(found.addendum_contact_ratios) < 1.0
    inputs, met = _said(eps=found.addendum_contact_ratios), found.approach_factor == 1.0
    yield Line("X_Q", "approach factor", (found.approach_factor, None), "1", rule, inputs, confirmed=met)
    name, value = "contact ratio factor of scuffing", found.contact_ratio_factor
    yield Line("X_eps", name, (value, None), "1", rule, inputs, confirmed=short)
    inputs, origin = _said(C_a=given.tip_relief, C_a_C_eff=found.relief_share), "computed"
    if given.tip_relief is None:
        inputs, origin = _said(C_a=rated.running_in_relief, C_a_C_eff=found.relief_share), "default"
    value, full = found.relief_factor, found.relief_share < 1.0
    yield Line("X_Ca", "tip relief factor", (value, None), "1", rule, inputs, origin, full)
    yield Line("theta_fl", "mean flash temperature", (found.flash_temperature, None), "K", rule, _said(v=found.speed))
    met, inputs = found.mates == 1, _said(n_p=found.mates)
    yield Line("X_mp", "multiple mating factor", (found.mating_factor, None), "1", rule, inputs, confirmed=met)
    inputs = _said(oil=given.oil_temperature, theta_fl=found.flash_temperature)
    yield Line("theta_int", "integral temperature", (found.integral_temperature, None), "deg C", rule, inputs)
    inputs = _said(stage=given.scuffing_stage, nu_40=given.viscosity_40)
    value, printed = found.scuffing_temperature, given.scuffing_stage == 14
    yield Line("theta_intS", "scuffing temperature", (value, None), "deg C", rule, inputs, confirmed=printed)
    yield Line("S_intS", "safety against scuffing", (found.safety, None), "1", rule)
