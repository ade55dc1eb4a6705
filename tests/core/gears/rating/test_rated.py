"""The rating with all factors: reports in `gearlink verify` hold the numbers, here stand second ways and both sides.

Tolerances: closed forms 1e-12 of themselves; lives by bracketing 1e-9; Simpson's rule on 400 panels 1e-9.
Y_RrelT leaps by up to 0.013 where the standard begins to count the roughness.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from factory import design
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.gears.measures.iso_1328 import ToothTolerances
from gearlink.core.parts.gears.rating.conditions import LimitLine, Point, damage, limit_line, safety_of
from gearlink.core.parts.gears.rating.materials import CLASSES, STEELS, Endurance, gear_steel
from gearlink.core.parts.gears.rating.rated import (
    contact_ratio_factor,
    dynamic_constants,
    run_in,
    size_factor,
    slip_layer,
    surface_factor,
)

PAIR: dict[str, Any] = {
    "kind": "gear-pair",
    "module": 4,
    "teeth": [23, 71],
    "profile_shift": [0.25, 0.1],
    "face_width": 40,
    "tool": {"addendum": 1.25, "rounding": 0.38},
    "load": {"torque": 220.0, "speed": 480.0, "factors": {"application": 1.25}},
    "rating": {"life": 20000, "material": "42CrMo4", "grade": 6, "lubricant": {"vg": 220}},
}
EXACT = 1e-12


def rated(rating: Any = (), load: Any = (), **keys: Any) -> Any:
    """The design with changes of its sections."""
    data = PAIR | keys
    data |= {"rating": data["rating"] | dict(rating), "load": data["load"] | dict(load)}
    for section in (data, data["rating"], data["load"]):
        for key in [key for key, value in section.items() if value is None]:
            del section[key]
    return design(data, command="gear")


def of(name: str, **keys: Any) -> Any:
    found = rated(**keys).quantity(name)
    return None if found is None else found.value


# Tolerances of ISO 1328-1:1995: the numbers of three reports

PRINTED = {
    (45, 855, 491): (33, 33, 27, 42, 21, 21, 30, 81, 65),
    (45, 2520, 491): (38, 40, 32, 51, 24, 24, 34, 132, 105),
    (21, 378, 550): (18, 21, 17, 27, 21, 21, 29, 54, 43),
    (21, 756, 550): (19, 23, 19, 30, 21, 21, 30, 67, 53),
    (21, 1953, 550): (22, 27, 22, 35, 23, 23, 32, 97, 78),
    (14, 341.183, 360): (14, 18, 15, 23, 18, 18, 25, 50, 40),
    (14, 1350.517, 360): (17, 22, 18, 28, 19, 19, 27, 78, 63),
}
_NAMES = (
    *("single_pitch", "profile_form", "profile_slope", "profile_total", "helix_form", "helix_slope", "helix_total"),
    *("cumulative_pitch", "runout"),
)


@pytest.mark.parametrize(("sizes", "printed"), PRINTED.items())
def test_tolerances_of_1995_as_printed(sizes: tuple[float, ...], printed: tuple[int, ...]) -> None:
    module, diameter, width = sizes
    found = ToothTolerances(grade=6, module=module, diameter=diameter, width=width, edition=1995)
    assert tuple(getattr(found, name) for name in _NAMES) == printed


def test_tolerances_of_2013_against_their_formulas() -> None:
    """Printed by a public program, totals of what is not rounded yet: 7.82 and 9.05, not 7.75 and 8.85 um."""
    found = ToothTolerances(grade=5, module=2.0, diameter=100.0, width=20.0)
    assert (found.single_pitch, found.cumulative_pitch, found.runout) == (6.0, 19.0, 17.0)
    assert (found.profile_slope, found.profile_form, found.profile_total) == (4.9, 6.0, 8.0)
    assert (found.helix_slope, found.helix_form, found.helix_total) == (6.0, 6.5, 9.0)
    coarser = ToothTolerances(grade=6, module=2.0, diameter=100.0, width=20.0)
    assert coarser.single_pitch == 8.5  # 5.9 sqrt 2 = 8.34


def test_a_tolerance_outside_of_the_standard_is_refused() -> None:
    with pytest.raises(NoSolution, match="grade 12 of ISO 1328-1:2013"):
        ToothTolerances(grade=12, module=2.0, diameter=50.0, width=20.0)
    with pytest.raises(NoSolution, match="5 to 10000 mm"):
        ToothTolerances(grade=6, module=2.0, diameter=11000.0, width=20.0, edition=1995)


# Load factors


def test_the_mass_of_a_gear_is_its_inertia_over_the_base_circle() -> None:
    one = rated(rating={"bore": [30.0, 60.0]}).data
    masses = one.rated.bodies.masses
    for gear, bore in enumerate((30.0, 60.0)):
        outside = one.pair.tip_radius[gear] + one.pair.root_radius[gear]
        radii = np.linspace(0.5 * bore, 0.5 * outside, 801)
        weights = np.ones(801)
        weights[1:-1:2], weights[2:-1:2] = 4.0, 2.0
        inertia = 7.83e-6 * 2.0 * math.pi * float((radii**3 * weights).sum()) * (radii[1] - radii[0]) / 3.0
        assert masses[gear] == pytest.approx(inertia / one.pair.base_radius[gear] ** 2, rel=1e-9)
    alone = masses[0] * masses[1] / (masses[0] + masses[1])
    assert one.rated.bodies.reduced_mass == pytest.approx(alone, rel=EXACT)


def test_planets_weigh_on_the_sun_and_a_fixed_ring_not_at_all() -> None:
    one, many = (of("reduced_mass", rating={"system": "sun-planet", "planets": count}) for count in (1, 4))
    assert one == pytest.approx(of("reduced_mass"), rel=EXACT)
    masses = rated().data.rated.bodies.masses
    assert 1.0 / many == pytest.approx(1.0 / masses[1] + 4.0 / masses[0], rel=EXACT)
    ring = {"teeth": [20, -71], "profile_shift": [0.3, -0.1]}
    fixed = rated(rating={"system": "planet-ring", "planets": 3}, **ring).data.rated.bodies
    assert fixed.reduced_mass == fixed.masses[0]


@pytest.mark.parametrize("eps", [1.3, 1.9, 2.0, 2.4, 3.1])
def test_the_dynamic_factor_is_continuous_beyond_the_resonance(eps: float) -> None:
    found = rated(helix_angle=12.0 if eps > 2.0 else 0.0).data.rated
    speeds = [ratio * found.at_load.resonance_speed / 480.0 for ratio in (1.15, 1.1501, 1.3249, 1.325, 1.4999, 1.5)]
    k = [found.factors_at(Point(speed=speed)).dynamic for speed in speeds]
    assert abs(k[1] - k[0]) < 1e-3 * k[0]
    assert abs(k[5] - k[4]) < 1e-3 * k[4]
    middle = found.factors_at(Point(speed=1.325 * found.at_load.resonance_speed / 480.0)).dynamic
    assert middle == pytest.approx(0.5 * (k[0] + k[5]), rel=1e-9)
    low, high = (dynamic_constants(2.0 + side * 1e-9) for side in (-1.0, 1.0))
    assert np.allclose(low[6], high[6], rtol=0.0, atol=1e-8)
    assert low == pytest.approx(high, rel=0.08)  # the two columns of the table do not quite meet: C_v4 0.9 and 0.839


@given(st.sampled_from(["soft", "iron", "hard"]), st.floats(100, 1600), st.floats(0.1, 200), st.floats(0.1, 40))
def test_running_in_takes_no_more_than_there_is(kind: str, limit: float, deviation: float, speed: float) -> None:
    for face in (False, True):
        taken = run_in((kind, limit), deviation, speed, face=face)
        assert 0.0 < taken <= deviation
        assert taken <= run_in((kind, limit), 2.0 * deviation, speed, face=face)


def test_running_in_of_large_deviations_ends_at_the_bounds_of_the_standard() -> None:
    """Largest y_beta and y_alpha [um] below 5, to 10 and above 10 m/s."""
    large = 1e4
    for face, iron, hard, soft in ((True, (45.0, 22.0), 6.0, 25600.0), (False, (22.0, 11.0), 3.0, 12800.0)):
        assert [run_in(("iron", 300.0), large, v, face=face) for v in (9.0, 11.0)] == list(iron)
        assert {run_in(("hard", 1500.0), large, v, face=face) for v in (4.0, 9.0, 11.0)} == {hard}
        found = [run_in(("soft", 800.0), large, v, face=face) for v in (9.0, 11.0)]
        assert found == pytest.approx([soft / 800.0, soft / 1600.0], rel=EXACT)
        assert run_in(("iron", 300.0), large, 4.0, face=face) == pytest.approx(5500.0 if face else 2750.0, rel=EXACT)


def test_given_factors_win() -> None:
    given_k = {"dynamic": 1.2, "face_contact": 1.3, "transverse_contact": 1.1, "distribution": 1.15}
    one = rated(load={"factors": {"application": 1.25, **given_k}})
    stress = one.raw("nominal_contact_stress") * math.sqrt(1.25 * 1.15 * 1.2 * 1.3 * 1.1)
    assert one.raw("contact_stress")[1] == pytest.approx(stress, rel=EXACT)
    origins = dict(zip(one.table("factors").data[0], one.table("factors").data[7], strict=True))
    assert {origins[name] for name in ("K_v", "K_Hbeta", "K_Halpha", "K_gamma")} == {"given"}
    assert origins["K_Fbeta"] == "computed"


@pytest.mark.parametrize("gear", [0, 1])
def test_the_stiffness_of_teeth_is_of_the_second_degree_in_the_shift(gear: int) -> None:
    """1/c'_th by three shifts, at constant other shift: twice 0.00529 and 0.00182 um mm/N (C_8, C_9 of ISO 6336-1)."""
    found = []
    for shift in (-0.2, 0.1, 0.4):
        shifts = [shift, 0.1] if gear == 0 else [0.1, shift]
        found.append(1.0 / rated(profile_shift=shifts).data.rated.bodies.theoretical_stiffness)
    second = (found[0] - 2.0 * found[1] + found[2]) / 0.3**2
    assert second == pytest.approx(2.0 * (0.00529, 0.00182)[gear], rel=1e-9)


@pytest.mark.parametrize(("position", "factor"), [("a", 0.8), ("b", -0.8), ("c", 1.33), ("e", -1.0)])
def test_a_shaft_bends_with_the_offset_of_its_pinion(position: str, factor: float) -> None:
    """f_sh over that without a shaft, |1 + K' l s/d^2 (d/d_sh)^4 - 0.3| + 0.3, over offsets where it turns its sign."""
    plain = rated().data.rated.at_load.shaft_deflection
    bent = set()
    for offset in (0.0, 20.0, 60.0, 150.0):
        shaft = {"position": position, "span": 300.0, "offset": offset, "diameter": 60.0}
        ratio = rated(rating={"face": {"shaft": shaft}}).data.rated.at_load.shaft_deflection / plain
        moment = factor * 300.0 * offset / 92.0**2 * (92.0 / 60.0) ** 4
        assert ratio == pytest.approx(abs(0.7 + moment) + 0.3, rel=1e-12)
        bent.add(0.7 + moment > 0.0)
    assert bent == ({True} if factor > 0.0 else {True, False})


def test_every_factor_of_the_load_bends_the_teeth() -> None:
    """K_A K_gamma K_v K_Fbeta K_Falpha: doubled one by one, each doubles the root stress and halves the safety."""
    given_k = {"application": 1.1, "distribution": 1.2, "dynamic": 1.3, "face_bending": 1.4, "transverse_bending": 1.5}
    once, safety = (of(name, load={"factors": given_k}) for name in ("root_stress", "safety_bending"))
    for name, value in given_k.items():
        twice = of("root_stress", load={"factors": given_k | {name: 2.0 * value}})
        assert twice == pytest.approx([2.0 * each for each in once], rel=1e-12), name
        less = of("safety_bending", load={"factors": given_k | {name: 2.0 * value}})
        assert less == pytest.approx([0.5 * each for each in safety], rel=1e-12), name
    nominal = of("nominal_root_stress", load={"factors": given_k})
    assert once == pytest.approx([1.1 * 1.2 * 1.3 * 1.4 * 1.5 * each for each in nominal], rel=1e-12)


def test_crowning_halves_and_a_measured_misalignment_replaces() -> None:
    plain, crowned = rated().data.rated, rated(rating={"face": {"modification": "crowning"}}).data.rated
    assert crowned.at_load.mesh_misalignment == pytest.approx(0.5 * plain.at_load.mesh_misalignment, rel=EXACT)
    given_f = rated(rating={"face": {"misalignment": plain.at_load.mesh_misalignment}})
    assert given_f.raw("face_load_factor_contact") == pytest.approx(plain.at_load.face_contact, rel=EXACT)


def test_the_pinion_s_shaft_is_the_smaller_gear_s() -> None:
    turned = rated(
        teeth=[71, 23], profile_shift=[0.1, 0.25], load={"torque": 220.0 * 71 / 23, "speed": 480.0 * 23 / 71}
    )
    assert turned.raw("face_load_factor_contact") == pytest.approx(of("face_load_factor_contact"), rel=1e-9)
    assert turned.raw("single_stiffness") == pytest.approx(of("single_stiffness"), rel=1e-9)
    assert turned.raw("safety_pitting")[::-1] == pytest.approx(of("safety_pitting"), rel=1e-9)


@pytest.mark.parametrize("deep", [False, True])
def test_the_load_of_a_helix_is_shared_between_spur_and_wide_teeth(deep: bool) -> None:
    """f_eps^2 of ISO 6336-3:2019 is straight in eps_beta, from 1, of deep teeth 1/2, to 1/eps_alphan at 1."""
    teeth = {"module": 2.0, "teeth": [45, 60], "helix_angle": 12.0, "tool": {"addendum": 1.6 if deep else 1.25}}
    found = {}
    for width in (5.0, 10.0, 15.0, 60.0):
        keys = teeth | {"addendum": 1.35 if deep else 1.0, "face_width": width, "profile_shift": [0.0, 0.0]}
        root = replace(rated(**keys).data.root, edition=2019)
        eps, overlap = root.virtual_contact_ratio, root.path.overlap_ratio
        assert (eps >= 2.0) == deep
        found[overlap] = root.load_distribution**2
    *inside, wide = found
    assert max(inside) < 1.0 <= wide
    assert found[wide] == pytest.approx(1.0 / eps, rel=EXACT)
    start = 0.5 if deep else 1.0
    for overlap in inside:
        assert found[overlap] == pytest.approx(np.interp(overlap, [0.0, 1.0], [start, 1.0 / eps]), rel=EXACT)


# Life


@given(st.floats(200, 3000), st.floats(0.3, 2.0), st.floats(0.85, 1.0), st.floats(3, 10), st.booleans())
def test_load_cycles_and_limit_stress_are_each_other_s_inverse(
    reference: float, ratio: float, long: float, digits: float, pitted: bool
) -> None:
    line = limit_line(Endurance(1e5, 5e7, 1.6), ratio * reference, reference, long, pitting_allowed=pitted)
    cycles = 10.0**digits
    falls = line.static > line.at(line.endurance.reference)
    if falls and line.endurance.static < cycles < (1e10 if long < 0.999 else line.endurance.reference):
        assert line.cycles(line.at(cycles)) == pytest.approx(cycles, rel=1e-6)
    assert line.at(1e10) == pytest.approx(long * reference, rel=EXACT)
    assert line.at(1.0) == pytest.approx(line.static, rel=EXACT)


@given(st.floats(300, 3000), st.floats(300, 3000))
def test_at_the_bend_the_influence_is_that_of_its_place_between_the_knees(static: float, reference: float) -> None:
    """Life factor 1.3 at 1e7 load cycles; influences of 6e5 and 1e9, of the powers that its place gives each."""
    line = limit_line(Endurance(1e5, 5e7, 1.6), static, reference, 1.0, pitting_allowed=True)
    share = math.log(1e7 / 6e5) / math.log(1e9 / 6e5)
    assert line.at(1e7) == pytest.approx(1.3 * static ** (1.0 - share) * reference**share, rel=1e-12)
    assert line.at(6e5) == pytest.approx(1.6 * static, rel=1e-12)


def test_pits_allowed_lengthen_the_line() -> None:
    plain, pitted = (
        rated(rating={"material": "16MnCr5", "pitting": pits}, load={"speed": 10.0}) for pits in ("none", "allowed")
    )
    cycles = plain.raw("load_cycles")[0]
    assert 1e7 < cycles < 5e7
    factor = 1.3 * (1e7 / cycles) ** (math.log(1.3) / math.log(100.0))
    assert pitted.raw("life_factor_contact")[0] == pytest.approx(factor, rel=1e-9)
    assert factor > plain.raw("life_factor_contact")[0]


def test_a_spectrum_of_one_row_is_the_load_itself() -> None:
    alone, row = rated(), rated(rating={"spectrum": [{"share": 1.0}]})
    for name in ("safety_pitting", "safety_bending", "pitting_life"):
        assert row.raw(name) == pytest.approx(alone.raw(name), rel=1e-9)
    split = rated(rating={"spectrum": [{"share": 0.3}, {"share": 0.6}, {"share": 0.1}, {"torque": 0.0, "share": 0.0}]})
    assert split.raw("damage_pitting") == pytest.approx(alone.raw("damage_pitting"), rel=1e-9)


def test_the_life_is_that_at_which_the_safety_is_what_is_required() -> None:
    life = of("pitting_life")[0]
    assert of("safety_pitting", rating={"life": life})[0] == pytest.approx(1.0, rel=1e-9)


def test_each_row_forms_its_own_factors() -> None:
    rows = [{"torque": 1.0, "share": 0.4}, {"torque": 0.7, "speed": 2.0, "share": 0.6}]
    whole = rated(rating={"material": "16MnCr5", "spectrum": rows}, load={"torque": 900.0})
    parts = [
        rated(
            rating={"material": "16MnCr5", "life": 20000 * row["share"]},
            load={"torque": 900.0 * row["torque"], "speed": 480.0 * row.get("speed", 1.0)},
        ).raw("damage_pitting")[0]
        for row in rows
    ]
    assert whole.raw("damage_pitting")[0] == pytest.approx(math.fsum(parts), rel=1e-9)
    at_one = safety_of(whole.data.rated.flank_rows[0])
    assert damage(whole.data.rated.flank_rows[0], at_one * (1.0 - 1e-9)) <= 1.0
    assert damage(whole.data.rated.flank_rows[0], at_one * (1.0 + 1e-9)) >= 1.0


def test_a_load_below_the_long_life_does_no_damage() -> None:
    one = rated(load={"torque": 20.0})
    assert one.raw("damage_pitting") == (0.0, 0.0)
    assert one.quantity("pitting_life").value == [None, None]


# Materials and influence factors


@pytest.mark.parametrize("name", [*STEELS])
def test_a_named_steel_is_its_class_at_its_hardness(name: str) -> None:
    steel = STEELS[name]
    made, by_class = gear_steel(name, "MQ"), gear_steel(steel.of, "MQ", hardness=steel.hardness)
    assert (made.contact_limit, made.bending_limit) == (by_class.contact_limit, by_class.bending_limit)
    low, high = CLASSES[steel.of].range_of("MQ")
    assert low <= steel.hardness <= high


def test_better_quality_bears_more() -> None:
    for name, made in CLASSES.items():
        for lines in (made.contact, made.bending):
            hardness = 0.5 * sum(made.range_of("MQ"))
            worst, usual, best = (line.at(hardness) for line in lines)
            assert worst <= usual <= best, name


def test_influence_factors_are_continuous_where_their_lines_join() -> None:
    for form in ("soft", "hard", "iron"):
        most = 30.0 if form == "soft" else 25.0
        for join in (5.0, most):
            assert size_factor(form, join - 1e-9) == pytest.approx(size_factor(form, join + 1e-9), abs=1e-9)
    for form, near in (("steel", 0.02), ("normalized", 0.01), ("iron", 0.01)):
        assert surface_factor(form, 0.999) == pytest.approx(surface_factor(form, 1.0), abs=near)
    for strength in (400.0, 600.0, 1000.0):
        sides = [
            slip_layer(gear_steel("through-hardened", "MQ", hardness=300, yield_strength=strength + d))
            for d in (-1e-6, 1e-6)
        ]
        assert sides[0] == pytest.approx(sides[1], abs=1e-9)


@given(st.floats(0.05, 0.999), st.floats(0.05, 0.999))
def test_the_contact_ratio_factor_of_scuffing_joins(one: float, other: float) -> None:
    assert contact_ratio_factor(1.0 - 1e-9, other) == pytest.approx(contact_ratio_factor(1.0, other), rel=1e-6)
    assert contact_ratio_factor(one, 1.0 - 1e-9) == pytest.approx(contact_ratio_factor(one, 1.0), rel=1e-6)


@given(st.floats(0.05, 1.95), st.floats(0.05, 1.95))
def test_of_the_contact_ratio_factor_of_scuffing_only_the_mean_turns(one: float, other: float) -> None:
    """X_eps eps_1 is the same whichever gear drives; where both parts together are two pitches, its forms meet."""
    there, turned = contact_ratio_factor(one, other), contact_ratio_factor(other, one)
    assert there * one == pytest.approx(turned * other, rel=1e-12)
    assert contact_ratio_factor(one, 2.0 - one) == pytest.approx(contact_ratio_factor(one, 2.0 - 1e-9 - one), rel=1e-6)


def test_the_approach_of_scuffing_counts_where_it_is_long() -> None:
    """X_Q over eps_2/eps_1: 1 to 1.5, 0.6 from 3 on, straight between; the shift moves the path."""
    oil = {"lubricant": {"vg": 220, "viscosity_100": 19, "temperature": 80, "scuffing_stage": 12}}
    seen = set()
    for shift in (0.5, 0.1, -0.2, -0.3, -0.5):
        found = rated(rating=oil, profile_shift=[shift, 0.35 - shift]).data.rated.scuffing
        recess, approach = found.addendum_contact_ratios
        ratio = approach / recess
        assert found.approach_factor == pytest.approx(np.interp(ratio, [1.5, 3.0], [1.0, 0.6]), rel=1e-12)
        seen.add("long" if ratio >= 3.0 else "short" if ratio <= 1.5 else "between")
    assert seen == {"long", "short", "between"}


def test_the_oil_has_the_viscosities_it_was_given() -> None:
    oil = {"vg": 220, "viscosity_100": 19, "scuffing_stage": 12}
    for temperature, kinematic in ((40.0, 220.0), (100.0, 19.0)):
        found = rated(rating={"lubricant": oil | {"temperature": temperature}}).data.rated.scuffing
        density = 0.89 - 0.0007 * (temperature - 15.0)
        assert found.viscosity == pytest.approx(kinematic * density, rel=1e-9)


def test_scuffing_does_not_ask_which_gear_is_called_1() -> None:
    oil = {"lubricant": {"vg": 220, "viscosity_100": 19, "temperature": 80, "scuffing_stage": 12}}
    there = of("safety_scuffing", rating=oil)
    turned = {"teeth": [71, 23], "profile_shift": [0.1, 0.25]}
    load = {"torque": 220.0 * 71 / 23, "speed": 480.0 * 23 / 71}
    assert of("safety_scuffing", rating=oil, load=load, **turned) == pytest.approx(there, rel=1e-9)


def test_the_velocity_factor_starts_at_the_constants_of_the_standard() -> None:
    """Z_V of a standstill: 0.85 below 850 N/mm^2, 0.93 above 1200; 1 at 10 m/s whatever the material."""
    for steel, hardness, start in (("16MnCr5", 650, 0.93), ("C45", 200, 0.85)):
        found = rated(rating={"material": steel, "brinell": hardness}).data.rated
        assert found.velocity_factor_at(1e-24) == pytest.approx(start, rel=1e-9)
        assert found.velocity_factor_at(10.0) == pytest.approx(1.0, rel=EXACT)


@pytest.mark.parametrize("helix", [0.0, 14.0])
def test_the_flash_temperature_from_the_file_on(helix: float) -> None:
    """ISO/TR 13989-2 once more, from teeth and diameters; load factors, mesh stiffness and tip circles are taken."""
    oil = {"lubricant": {"vg": 220, "viscosity_100": 19, "temperature": 80, "scuffing_stage": 12}}
    data = rated(rating=oil, helix_angle=helix).data
    found, at, pair = data.rated.scuffing, data.rated.at_load, data.pair
    z, normal, beta = (23, 71), math.radians(20.0), math.radians(helix)
    transverse = math.atan(math.tan(normal) / math.cos(beta))
    base = [0.5 * 4.0 * teeth / math.cos(beta) * math.cos(transverse) for teeth in z]
    distance = sum(base) / math.cos(working := pair.working_pressure_angle)
    tips = [math.sqrt(tip**2 - r**2) for tip, r in zip(pair.tip_radius, base, strict=True)]
    pitch = 2.0 * math.pi * base[0] / z[0]
    eps = [(tip - r * math.tan(working)) / pitch for tip, r in zip(tips, base, strict=True)]
    first, second = tips[0], distance * math.sin(working) - tips[0]
    u = z[1] / z[0]
    x_be = 0.51 * math.sqrt(u + 1.0) * abs(math.sqrt(first) - math.sqrt(second / u)) / (first * second) ** 0.25
    turned = (math.sin(working) * math.cos(normal) * math.cos(beta)) ** 0.25
    angle = 1.22 * turned / math.sqrt(math.cos(working) * math.cos(transverse))
    base_helix = math.asin(math.sin(beta) * math.cos(normal))
    curvature = base[0] * math.tan(working) * base[1] * math.tan(working)
    curvature /= (base[0] + base[1]) * math.tan(working) * math.cos(base_helix)
    load = at.line_load * at.dynamic * at.face_contact * at.transverse_contact
    total = at.total_contact_ratio
    shared = 1.0 if total <= 2.0 else min(1.3, 1.0 + 0.2 * math.sqrt((total - 2.0) * (5.0 - total)))
    speed = 480.0 * math.pi / 30.0 * base[0] / math.cos(transverse) / 1000.0
    rolling = 2.0 * speed * math.tan(working) * math.cos(transverse)
    rough = 2.2 * (np.mean(data.rated.conditions.ra) / curvature) ** 0.25
    friction = 0.045 * (load * shared / (rolling * curvature)) ** 0.2 * found.viscosity**-0.05 * rough
    relief = np.mean([(limit / 97.0 - 18.45) ** 2 / 18.0 + 1.5 for limit in data.rated.contact_limits])
    share = min(1.0, relief / (at.line_load / at.mesh_stiffness))
    longest = max(eps)
    x_ca = 1.0 + (0.06 + 0.18 * share) * longest + (0.02 + 0.69 * share) * longest**2
    flash = friction * found.thermal_flash_factor * x_be * angle * (shared * load) ** 0.75 * speed**0.5 / distance**0.25
    flash *= contact_ratio_factor(*eps) / (found.approach_factor * x_ca)
    assert found.thermal_flash_factor == pytest.approx(50.0, abs=0.1)  # as printed for steel on steel
    assert found.flash_temperature == pytest.approx(flash, rel=1e-9)
    assert found.integral_temperature == pytest.approx(80.0 + 2.2 * flash, rel=1e-9)


@pytest.mark.parametrize(
    ("rating", "mates"),
    [({}, 1), ({"system": "sun-planet", "planets": 1}, 2), ({"system": "sun-planet", "planets": 3}, 3)],
)
def test_every_mate_heats_its_gear(rating: dict[str, Any], mates: int) -> None:
    """Half of a mesh's heat goes into either gear: `mates` halves into the one, and one into the other."""
    oil = {"vg": 220, "viscosity_100": 19, "temperature": 80, "scuffing_stage": 12}
    found = rated(rating=rating | {"lubricant": oil}).data.rated.scuffing
    mean = np.mean([mates, 1.0])
    assert found.mass_temperature - 80.0 == pytest.approx(0.7 * mean * found.flash_temperature, rel=EXACT)
    assert found.integral_temperature - found.mass_temperature == pytest.approx(1.5 * found.flash_temperature, rel=1e-9)


def test_the_scuffing_temperature_is_that_of_the_test_of_the_oil() -> None:
    """Printed for stage 14; of 100 mm^2/s the viscosity counts nothing; 3.726 stage^2 N m is the torque, within 3 %."""

    def temperature(stage: int, vg: float) -> float:
        oil = {"vg": vg, "viscosity_100": 11, "temperature": 60, "scuffing_stage": stage}
        return float(rated(rating={"lubricant": oil}).data.rated.scuffing.scuffing_temperature)

    assert temperature(14, 220) == pytest.approx(455.17, abs=0.005)
    for stage in range(8, 15):
        rise = temperature(stage, 100) - 80.0
        assert rise == pytest.approx(0.53 * 3.726 * stage**2, rel=0.03)
        bath, flash = 0.23 * rise / 0.53, 0.3 * rise / 0.53
        assert temperature(stage, 320) - 80.0 - bath == pytest.approx(flash * 3.2**-0.02, rel=1e-12)


def test_the_face_load_of_the_root_is_that_of_the_height() -> None:
    """The exponent as the standard prints it, (b/h)^2/(1 + b/h + (b/h)^2), b/h of the higher teeth, at least 3."""
    for width, least in ((40.0, 4.0), (20.0, 3.0)):
        data = rated(face_width=width).data
        heights = [tip - root for tip, root in zip(data.pair.tip_radius, data.pair.root_radius, strict=True)]
        x = max(3.0, width / max(heights))
        assert least <= x < least + 1.0
        power = x * x / (1.0 + x + x * x)
        assert data.rated.at_load.face_bending == pytest.approx(data.rated.at_load.face_contact**power, rel=EXACT)


def test_a_soft_wheel_on_a_hard_pinion_is_smoothed_and_hardened() -> None:
    keys = {"material": ["16MnCr5", "42CrMo4"], "brinell": [650, 300]}
    one = of("work_hardening_factor", rating=keys)
    assert one[0] == 1.0
    rough = of("work_hardening_factor", rating=keys | {"roughness": {"flank": [12.0, 3.0]}})
    assert rough[1] < one[1] <= 1.2 - 170.0 / 1700.0 + EXACT


# Sheet and checks


def statuses(one: Any, name: str) -> list[str]:
    return [check.status for check in one.check(name)]


def test_the_sheet_says_where_every_factor_is_from() -> None:
    table = rated().table("factors")
    rows = [dict(zip(table.columns, row, strict=True)) for row in table.each_row()]
    symbols = [row["symbol"] for row in rows]
    assert len(set(symbols)) == len(symbols)
    by = {row["symbol"]: row for row in rows}
    assert by["K_v"]["gear1"] == of("dynamic_factor")
    assert by["K_v"]["gear2"] is None
    assert by["sigma_HG"]["gear2"] == of("pitting_limit_stress")[1]
    assert {row["origin"] for row in rows} == {"computed", "given", "default"}
    assert all(row["rule"].startswith("R") for row in rows)
    assert not by["sigma_Hlim"]["confirmed"]
    for edition in (1995, 2013):  # both have printed numbers, in PRINTED and of `verify iso1328`
        tolerances = rated(rating={"tolerance_edition": edition}).table("factors")
        assert dict(zip(tolerances.data[0], tolerances.data[8], strict=True))["f_pt"]


def test_what_is_met_by_a_report_alone_needs_no_warning() -> None:
    quiet = rated(
        rating={"tolerance_edition": 1995, "material": "18CrNiMo7-6"},
        material={"bending_limit": 430},
        load={"factors": {"face_contact": 1.2, "dynamic": 1.05, "transverse_contact": 1.1, "transverse_bending": 1.1}},
    )
    assert statuses(quiet, "rating-range") == ["pass"]
    planets = {"system": "sun-planet", "planets": 3}
    (several,) = rated(rating=planets).check("rating-range")
    assert "the sun meets 3 planets (give rating.contacts)" in " ".join(several.note)
    (given,) = rated(rating=planets | {"contacts": [3, 1]}).check("rating-range")
    assert "planets" not in " ".join(given.note)
    (hard,) = rated(rating={"hardness": 500}).check("rating-range")
    assert hard.status == "warn"
    assert "hardness 500 HV of gear 1, through-hardened MQ has 200 to 360" in hard.note[0]


def test_resonance_warns_about_it_alone() -> None:
    near = rated().raw("resonance_speed")
    for ratio, status in ((0.8, "pass"), (0.9, "warn"), (1.1, "warn"), (1.2, "pass")):
        assert statuses(rated(load={"speed": ratio * near}), "resonance") == [status], ratio


def test_scuffing_on_both_sides() -> None:
    oil = {"lubricant": {"vg": 220, "viscosity_100": 19, "temperature": 80, "scuffing_stage": 12}}
    safety = of("safety_scuffing", rating=oil)
    for factor, status in ((0.999, "pass"), (1.001, "fail")):
        assert statuses(rated(rating=oil, limits={"safety_scuffing": factor * safety}), "scuffing") == [status]
    assert rated().check("scuffing") == []


def test_damage_and_static_limit_on_both_sides() -> None:
    life = of("pitting_life")[0]
    for factor, status in ((0.999, "pass"), (1.001, "fail")):
        assert statuses(rated(rating={"life": factor * life}), "damage")[0] == status
    blow = {"spectrum": [{"torque": 30.0, "share": 0.0}, {"torque": 0.1, "share": 1.0}]}
    assert "fail" not in statuses(rated(rating=blow), "damage")
    blow["spectrum"][0]["share"] = 1e-9
    blow["spectrum"][1]["share"] = 1.0 - 1e-9
    assert "static safety at the maximum load" in rated(rating=blow).check("damage")[0].note[0]


def test_load_on_one_end_warns_above_2() -> None:
    for misalignment, status in ((18.0, "pass"), (60.0, "warn")):
        one = rated(rating={"face": {"misalignment": misalignment}})
        assert (one.raw("face_load_factor_contact") > 2.0) == (status == "warn")
        assert statuses(one, "face-load") == [status]


def test_a_failing_safety_says_what_helps() -> None:
    (first, _) = rated().check("pitting")
    crowned = of("safety_pitting", rating={"face": {"modification": "crowning"}})[0]
    assert "gear 1: pitting safety S_H" in first.message
    assert "K_Hb 1.49 reduces the safety by 18 %" in first.note[0]
    assert f"to crowning, which gives a safety of {crowned:.4g}, and use a better grade" in first.fix


@pytest.mark.parametrize(
    ("torque", "plain", "words"),
    [(150, True, "set rating.face"), (220, True, "set rating.face"), (400, True, "use a larger face width"),
     (400, False, "use a larger face width"), (220, False, "reduce K_Hb: a stiffer shaft")],
)  # fmt: skip
def test_an_even_load_is_named_where_it_helps_enough(torque: float, plain: bool, words: str) -> None:
    """K_Hb of 1 is the most that any such remedy gives: beyond it only width, module and material are left."""
    face = {"face": {"modification": "none" if plain else "crowning"}}
    (first, _) = rated(load={"torque": torque}, rating=face).check("pitting")
    assert (first.status, first.value < 1.0) == ("fail", True)
    assert first.fix.startswith(words)
    even_load = {"torque": torque, "factors": {"face_contact": 1.0}}
    even = rated(load=even_load, rating={"face": None}).raw("safety_pitting")[0]
    assert ("use a larger face width" in words) == (even < 1.0)
    if words.startswith("set"):
        (reached, _) = rated(load={"torque": torque}, rating={"face": {"modification": "crowning"}}).raw(
            "safety_pitting"
        )
        assert ("and use a better grade" in first.fix) == (reached < 1.0)


def test_a_remedy_names_nothing_that_the_file_has() -> None:
    narrow = {"grade": 9, "face": {"modification": "crowning"}}
    (found,) = rated(rating=narrow, face_width=120).check("face-load")
    assert found.status == "warn"
    assert "crowning" not in found.fix
    for each in rated(rating=narrow, face_width=120, load={"torque": 3000}).check("pitting"):
        assert each.note[0].count("reduces the safety by") == 1


WRONG: list[tuple[dict[str, Any], str, str]] = [
    ({"rating": {"material": "42CrM04"}}, "material", "did you mean 42CrMo4"),
    ({"rating": {"material": "through-hardened"}}, "rating.hardness", "depends on its hardness"),
    ({"rating": {"material": None}}, "rating.material", "a steel, or both limits"),
    ({"rating": {"grade": None}}, "rating.grade", "accuracy grade"),
    ({"rating": {"lubricant": {"vg": 220, "viscosity_40": 220}}}, "viscosity_40", "exclude each other"),
    ({"rating": {"lubricant": {"vg": 220, "temperature": 80}}}, "viscosity_100", "is missing"),
    (
        {"rating": {"lubricant": {"vg": 20, "viscosity_100": 30, "temperature": 8, "scuffing_stage": 9}}},
        "100",
        "not below the viscosity at 40",
    ),
    ({"rating": {"spectrum": [{"share": 0.5}]}}, "spectrum", "shares of the spectrum: 0.5"),
    ({"rating": {"spectrum": [{"torque": 0.0, "share": 1.0}]}}, "spectrum", "has no load"),
    ({"rating": {"web": [0.3, 0.5]}}, "web", "must be from 1 to 30"),
    (
        {"rating": {"system": "planet-ring", "planets": 3}},
        "rating.system",
        "planet-ring needs a gear and its ring",
    ),
    ({"rating": {"system": "sun-planet"}}, "planets", "needs planets"),
    ({"rating": {"planets": 3}}, "planets", "omit it"),
    ({"rating": {"face": {"misalignment": 5.0, "modification": "crowning"}}}, "modification", "all effects"),
    ({"rating": {"face": {}}, "load": {"factors": {"face_contact": 1.2}}}, "rating.face", "omit face"),
    ({"load": {"speed": None}}, "load.speed", "needs load.speed"),
    ({"face_width": None}, "face_width", "needs face_width"),
    ({"material": {"contact_factors": 0.9}}, "material.contact_factors", "omit it"),
    ({"teeth": [23, "rack"], "profile_shift": [0.2, 0.0]}, "rating", "gear on a rack"),
]


@pytest.mark.parametrize(("keys", "key", "words"), WRONG, ids=[words for _, _, words in WRONG])
def test_what_is_missing_or_contradicts_is_refused(keys: dict[str, Any], key: str, words: str) -> None:
    with pytest.raises(ValidationError) as refused:
        rated(**keys)
    error, *_ = (each for each in refused.value.errors() if words in each["msg"])
    assert words in error["msg"]
    assert key in f"{error['loc']}{error.get('ctx', {}).get('key', '')}{error['msg']}"


def test_a_gear_beyond_the_tolerances_is_refused_at_its_grade() -> None:
    with pytest.raises(NoSolution) as refused:
        of("dynamic_factor", rating={"grade": 12})
    assert refused.value.key == "rating.grade"


def test_without_rating_nothing_of_it_appears() -> None:
    plain = {key: value for key, value in PAIR.items() if key != "rating"}
    report = design(plain, command="gear").report("gear")
    names = {quantity.name for quantity in report.quantities}
    assert "dynamic_factor" not in names
    assert not {check.code for check in report.checks} & {f"GL{n}" for n in range(214, 220)}


def test_a_train_rates_its_meshes_as_pairs() -> None:
    gears = {
        "module": 4, "crank": 23, "output": 71, "idler": 30, "profile_shift": [0.2, -0.2, 0.2], "face_width": 40,
        "tool": {"addendum": 1.25, "rounding": 0.38},
        "rating": PAIR["rating"] | {"material": ["16MnCr5", "42CrMo4", "C45"]},
        "load": {"torque": 220.0, "speed": 480.0},
    }  # fmt: skip
    train = design(
        {"kind": "three-gear-four-bar", "gears": gears, "links": {"crank": 18, "frame": 240}}, command="gear"
    )
    pair = design(
        PAIR
        | {
            "teeth": [23, 30],
            "profile_shift": [0.2, -0.2],
            "load": gears["load"],
            "rating": PAIR["rating"] | {"material": ["16MnCr5", "42CrMo4"], "mean_stress": [1.0, 0.7]},
        },
        command="gear",
    )
    for name in ("safety_pitting", "safety_bending", "dynamic_factor", "work_hardening_factor"):
        assert train.raw(f"crank_idler.{name}") == pytest.approx(pair.raw(name), rel=1e-9)
    assert train.raw("idler_output.mean_stress_factor") == (0.7, 1.0)
    assert train.table("factors").columns[0] == "mesh"


def test_the_nominal_shift_of_the_root_is_the_reports_way() -> None:
    thin = {"allowances": {"series": "25cd"}}
    nominal = of("form_factor", rating={"root_shift": "nominal"}, **thin)
    assert nominal == pytest.approx(of("form_factor"), rel=EXACT)
    assert of("form_factor", **thin)[0] > nominal[0]


def test_a_point_of_the_spectrum_is_frozen() -> None:
    line = LimitLine(endurance=Endurance(1e5, 5e7, 1.6), static=2400.0, reference=1500.0, long_life=1.0)
    assert math.isinf(line.cycles(1500.0 * (1.0 - 1e-12)))
    assert line.cycles(0.0) == math.inf
    assert replace(Point(), torque=2.0) == Point(2.0)
