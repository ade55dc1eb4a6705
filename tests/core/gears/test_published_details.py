"""What cases in forty digits say beyond quantities of a pair: single gears, angles, factors, contact places.

Tolerances: each value's own, mostly 1e-9 relative.
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

from gearlink.core.parts.gears.data import GearData
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.rating.load import Material
from gearlink.core.parts.gears.rating.root_stress import RootStress
from gearlink.core.parts.gears.tooth.involute import inverse_involute, involute

ELSEWHERE = {  # compared by the tests named after them
    "profile_shift_1", "zeta_root", "profile_shift_2", "pressure_A", "pressure_B-", "pressure_B+", "pressure_C",
    "pressure_D-", "pressure_D+", "pressure_E", "least", "greatest", "js7",
    "M_1", "theta", "tip_fouling_angle", "trimming_angle",
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
    "s_t": lambda given: single(given).pair.tooth_thickness[0] / math.cos(single(given).pair.helix_angle),
    "s_y_at_1_05_d": lambda given: at_radius(given)["s_y"],
    "rho_y": lambda given: at_radius(given)["rho"],
    "beta_y": lambda given: at_radius(given)["beta"],
    "M_2": lambda given: pair_of(given).data.flank.single_contact_ratios[1],
    "Y_Fa": of("tip_form_factor"),
    "Y_Sa": of("tip_stress_correction_factor"),
    "root_chord_s_Fn": of("root_chord"),
    "root_rounding_rho_F": of("root_fillet_radius"),
    "ball_contact_diameter": contact_diameters,
    "tip_alteration_k": of("tip_shortening", None, -1.0),
    "f_eps": distribution,
    "Y_F_Y_S": factor_product,
}  # fmt: skip
ROWS = [(case, name) for case in CASES for name in case["expected"] if name in FOUND]


@pytest.mark.parametrize(("case", "name"), ROWS, ids=lambda each: each if isinstance(each, str) else each["name"])
def test_value(case: dict[str, Any], name: str) -> None:
    expected = case["expected"][name]
    assert FOUND[name](case["input"]) == pytest.approx(expected["value"], rel=0.0, abs=expected["tolerance"])


def test_every_value_of_every_case_is_compared() -> None:
    others = runpy.run_path(str(Path(__file__).with_name("test_published.py")))
    known = {*FOUND, *ELSEWHERE, *others["NAMES"], *others["PLAIN"], *others["DIAMETERS"]}
    assert {name for case in CASES for name in case["expected"]} <= known
