"""What published and forty-digit cases say beyond quantities of a pair: single gears, angles, factors, contact places.

Tolerances: each value's own, half a unit of its last printed digit or 1e-9 relative.
"""

from __future__ import annotations

import math
import runpy
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from factory import design
from gear_cases import CASES, spec_of

from gearlink.core.gears.data import GearData
from gearlink.core.gears.mesh.pair import GearPair
from gearlink.core.gears.rating.load import Material
from gearlink.core.gears.rating.root_stress import RootStress
from gearlink.core.gears.tooth import teeth
from gearlink.core.gears.tooth.involute import inverse_involute, involute

ELSEWHERE = {  # compared by the tests named after them
    "profile_shift_1", "zeta_root", "profile_shift_2", "pressure_A", "pressure_B-", "pressure_B+", "pressure_C",
    "pressure_D-", "pressure_D+", "pressure_E", "least", "greatest", "js7", "allowances_um", "upper_um", "lower_um",
    "M_1", "theta", "tip_fouling_angle", "trimming_angle", "d_Ff", "x_Emin",
}  # fmt: skip


def pair_of(given: dict[str, Any]) -> Any:
    return design(spec_of(given), command="gear")


def single(given: dict[str, Any]) -> GearData:
    """A gear by itself, as gear 1 of a pair without a sum of shifts."""
    known = {"module": given["module"], "pressure_angle": math.radians(given["pressure_angle"])}
    shift = given["profile_shift"]
    helix = math.radians(given.get("helix_angle", 0.0))
    tip = {}
    if "tip_diameter" in given:
        tip["given_tip_radius"] = (given["tip_diameter"] / 2.0, given["tip_diameter"] / 2.0)
    pair = GearPair(teeth=(given["teeth"],) * 2, given_shift=(shift, -shift), helix_angle=helix, **known, **tip)
    return GearData(pair=pair)


def at_radius(given: dict[str, Any], factor: float = 1.05) -> dict[str, float]:
    """Thickness (normal section), curvature and helix of a gear at a multiple of its reference circle."""
    pair = single(given).pair
    r = pair.reference_radius[0]
    radius, alpha_t = factor * r, pair.transverse_pressure_angle
    alpha_y = math.acos(pair.base_radius[0] / radius)
    half = (math.pi / 2.0 + 2.0 * given["profile_shift"] * math.tan(pair.pressure_angle)) / given["teeth"]
    helix = math.atan(radius / r * math.tan(pair.helix_angle))
    thickness = 2.0 * radius * (half + involute(alpha_t) - involute(alpha_y))
    return {"s_y": thickness, "rho": pair.base_radius[0] * math.tan(alpha_y), "beta": math.degrees(helix)}


def root_radius(given: dict[str, Any]) -> float:
    depth = given["tool"]["addendum"] - given["profile_shift"]
    return single(given).pair.reference_radius[0] - given["module"] * depth


def rounded_steel(given: dict[str, Any]) -> float:
    """sigma_H0 with Z_E rounded to 189.8."""
    return (
        189.8
        * pair_of(given).quantity("nominal_contact_stress").value
        / pair_of(given).quantity("elasticity_factor").value
    )


def contact_diameters(given: dict[str, Any]) -> list[float]:
    data = pair_of(given).data
    return [2.0 * abs(data.ball(gear).contact_radius) for gear in (0, 1)]


def distribution(given: dict[str, Any]) -> float:
    """f_eps of the edition of 2019."""
    data = pair_of(given).data
    root = data.root
    later = RootStress(
        path=root.path, tools=root.tools, shifts=root.shifts, widths=root.widths, load=root.load,
        materials=(Material(), Material()), edition=2019,
    )  # fmt: skip
    return later.load_distribution


def factor_product(given: dict[str, Any]) -> float:
    known = {"module": 1, "teeth": given["teeth"], "tool": given["tool"], "center_distance": 0.0}
    pair = GearPair(module=1.0, teeth=tuple(given["teeth"]), given_shift=(given["shift_sum"], 0.0))
    spec = {"kind": "gear-pair"} | known | {"center_distance": pair.center_distance, "shift_split": "root"}
    made = design(spec, command="gear")
    return made.quantity("form_factor").value[0] * made.quantity("stress_correction_factor").value[0]


def of(name: str, place: int | None = None, factor: float = 1.0) -> Callable[[dict[str, Any]], Any]:
    def value(given: dict[str, Any]) -> Any:
        found = pair_of(given).quantity(name).value
        found = found if place is None else found[place]
        return [factor * each for each in found] if isinstance(found, list) else factor * found

    return value


FOUND: dict[str, Callable[[dict[str, Any]], Any]] = {
    "angle": lambda given: inverse_involute(given["involute"]),
    "chordal_thickness": lambda given: single(given).chordal_thickness[0],
    "chordal_height": lambda given: single(given).chordal_height[0],
    "tooth_thickness": lambda given: single(given).pair.tooth_thickness[0],
    "d": lambda given: 2.0 * single(given).pair.reference_radius[0],
    "d_b": lambda given: 2.0 * single(given).pair.base_radius[0],
    "d_fE": lambda given: 2.0 * root_radius(given),
    "s_an": lambda given: single(given).pair.tip_thickness[0],
    "alpha_t": lambda given: math.degrees(single(given).pair.transverse_pressure_angle),
    "beta_b": lambda given: math.degrees(single(given).pair.base_helix_angle),
    "s_n": lambda given: single(given).pair.tooth_thickness[0],
    "s_t": lambda given: single(given).pair.tooth_thickness[0] / math.cos(single(given).pair.helix_angle),
    "s_y_at_1_05_d": lambda given: at_radius(given)["s_y"],
    "rho_y": lambda given: at_radius(given)["rho"],
    "beta_y": lambda given: at_radius(given)["beta"],
    "K_g_tip": lambda given: of("sliding_factor")(given)[::-1],
    "M_2": lambda given: pair_of(given).data.flank.single_contact_ratios[1],
    "Z_B": of("single_contact_factor", 0),
    "Z_D": of("single_contact_factor", 1),
    "Y_Fa": of("tip_form_factor"),
    "Y_Sa": of("tip_stress_correction_factor"),
    "root_chord_s_Fn": of("root_chord"),
    "root_rounding_rho_F": of("root_fillet_radius"),
    "sigma_H0_with_Z_E_189.8": rounded_steel,
    "measure_over_pins_odd_helical": of("measure_over_pins", 0),
    "span_module_1_z20_k3": lambda _: teeth.span_measurement(1.0, 20, 0.0, math.radians(20.0), 3),
    "ball_contact_diameter": contact_diameters,
    "tip_alteration_k": of("tip_shortening", None, -1.0),
    "f_eps": distribution,
    "Y_F_Y_S": factor_product,
}  # fmt: skip
ROWS = [(case, name) for case in CASES for name in case["expected"] if name in FOUND]
EARLY = {"root_chord_s_Fn", "root_rounding_rho_F", "Y_Fa", "Y_Sa"}
PAIRED = {"chordal_thickness", "chordal_height"}  # of pairs, among the quantities


@pytest.mark.parametrize(
    ("case", "name"),
    [row for row in ROWS if not (row[1] in PAIRED and isinstance(row[0]["input"]["teeth"], list))],
    ids=lambda each: each if isinstance(each, str) else each["name"],
)
def test_value(case: dict[str, Any], name: str) -> None:
    expected = case["expected"][name]
    assert FOUND[name](case["input"]) == pytest.approx(expected["value"], rel=0.0, abs=expected["tolerance"])
    if name in EARLY:  # its program stops an iteration early; the exact values are known as well
        assert FOUND[name](case["input"]) == pytest.approx(expected["reference"], rel=1e-9)


def test_every_value_of_every_case_is_compared() -> None:
    others = runpy.run_path(str(Path(__file__).with_name("test_published.py")))
    known = {*FOUND, *ELSEWHERE, *others["NAMES"], *others["PLAIN"], *others["DIAMETERS"]}
    assert {name for case in CASES for name in case["expected"]} <= known
