"""Gear pairs computed in forty digits by a second way: every value at its own tolerance; published ones beside them.

Published pairs are cases of `gearlink verify`, held by tests/cli/commands/test_verify.py; here stands what they say of
parts. Tolerances: 1e-9 relative for what has forty digits, of which the doubles keep all but a few ulp.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import replace
from typing import Any

import pytest
from factory import design
from gear_cases import CASES, spec_of

from gearlink.cli.verification.cases import Case, read
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.mesh.ring_cutter import ShapedRing
from gearlink.core.parts.gears.tooth.involute import involute
from gearlink.core.parts.gears.tooth.root_fillet import RackCutRoot
from gearlink.core.parts.gears.tooth.tools import PinionCutter, RackTool

PAIRS = [case for case in CASES if isinstance(case["input"].get("teeth"), list) and "module" in case["input"]]
SINGLE = [case for case in read("gearcore").cases if case.id.startswith("gearcore-generation")]
PLAIN = {
    "working_pressure_angle", "center_distance", "shift_sum", "contact_ratio", "overlap_ratio", "span_teeth",
    "span_measurement", "measure_over_balls",
}  # fmt: skip
NAMES = {
    "zeta_root": "specific_sliding",
    "zeta_tip": "specific_sliding_tip",
    "K_g_A_E": "sliding_factor",
    "normal_tip_thickness": "tip_thickness",
    "x_min": "min_shift_no_undercut",
    "rho_A1": "involute_margin",
    "Z_H": "zone_factor",
    "Z_eps": "contact_ratio_factor",
    "Z_beta": "helix_angle_factor_contact",
    "sigma_H0": "nominal_contact_stress",
    "Y_beta": "helix_angle_factor_bending",
    "Y_F": "form_factor",
    "Y_S": "stress_correction_factor",
    "s_Fn": "root_chord",
    "h_Fe": "bending_moment_arm",
    "rho_F": "root_fillet_radius",
    "sigma_F0": "nominal_root_stress",
}
DIAMETERS = {
    "reference_diameter": "reference_radius",
    "base_diameter": "base_radius",
    "tip_diameter": "tip_radius",
    "root_diameter": "root_radius",
    "working_diameter": "working_radius",
    "d_Nf": "used_root_radius",
    "d_Ff_external": "form_radius",
}
WITHOUT_BOUND = {("spur-undercut-9-50", "zeta_root")}  # the mating gear's tip reaches beyond the base tangent point


def quantities(case: dict[str, Any]) -> list[tuple[str, str, float, Any]]:
    """What a case expects: its own name, the quantity, a factor, value and tolerance."""
    found = []
    for name, expected in case["expected"].items():
        if (case["name"], name) in WITHOUT_BOUND:
            continue
        quantity = name if name in PLAIN else NAMES.get(name) or DIAMETERS.get(name)
        if quantity:
            found.append((name, quantity, 2.0 if name in DIAMETERS else 1.0, expected))
    return found


@pytest.mark.parametrize("case", PAIRS, ids=lambda case: case["name"])
def test_pair(case: dict[str, Any]) -> None:
    pair = design(spec_of(case["input"]))
    for name, quantity, factor, expected in quantities(case):
        value, wanted = pair.quantity(quantity).value, expected["value"]
        if isinstance(wanted, list):
            got = [factor * each for each in value if each is not None][: len(wanted)]
        else:
            got = factor * value
        assert got == pytest.approx(wanted, rel=0.0, abs=expected["tolerance"]), name


@pytest.mark.parametrize(
    "case", [case for case in PAIRS if "tip_fouling_angle" in case["expected"]], ids=lambda c: c["name"]
)
def test_internal_interference(case: dict[str, Any]) -> None:
    internal = design(spec_of(case["input"])).data.internal
    wanted = case["expected"]
    assert internal.tip_fouling_angle == pytest.approx(wanted["tip_fouling_angle"]["value"], abs=1e-12)
    assert internal.radial_assembly_angle == pytest.approx(wanted["trimming_angle"]["value"], abs=1e-12)


@pytest.mark.parametrize(
    ("pinion", "shift", "fouling", "assembly"),
    [
        (49, -1.0, 0.0215, -math.inf),
        (47, -0.4, 0.002985, -math.inf),
        (46, -0.3, 0.002899, -0.03854),
        (45, -0.2, 0.001613, -0.02997),
        (44, -0.11, 0.0002132, -0.02611),
        (43, -0.06, 0.0004113, -0.02215),
    ],
)
def test_rings_that_are_published_as_free_but_not_to_be_assembled_radially(
    pinion: int, shift: float, fouling: float, assembly: float
) -> None:
    pair = design({"kind": "gear-pair", "module": 1, "teeth": [pinion, -50], "profile_shift": [0, shift]})
    internal = pair.data.internal
    assert internal.tip_fouling_angle == pytest.approx(fouling, rel=1e-3)
    assert internal.radial_assembly_angle == pytest.approx(assembly, rel=1e-3)
    statuses = {found.name: found.status for found in pair.check("tip-fouling") + pair.check("radial-assembly")}
    assert statuses == {"tip-fouling": "pass", "radial-assembly": "warn"}


@pytest.mark.parametrize("case", SINGLE, ids=lambda case: case.id)
def test_gear_as_its_tool_cuts_it(case: Case) -> None:
    given, wanted = case.design, {number.name.partition(" ")[0]: number for number in case.numbers}
    root = RackCutRoot(
        teeth=given["teeth"][0],
        shift=given["profile_shift"][0],
        tool=RackTool(**given["tool"]),
        pressure_angle=math.radians(20.0),
        helix_angle=math.radians(given.get("helix_angle", 0.0)),
    )
    diameter = 2.0 * given["module"] * root.form_radius
    assert diameter == pytest.approx(wanted["d_Ff"].value, rel=0.0, abs=wanted["d_Ff"].limit)
    least, tolerance = wanted["x_Emin"].value, wanted["x_Emin"].limit
    undercut = [replace(root, shift=least + side * tolerance).undercut for side in (-1, 1)]
    assert undercut == [True, False]


@pytest.mark.parametrize("case", [case for case in PAIRS if "M_1" in case["expected"]], ids=lambda case: case["name"])
def test_pressures_at_b_and_d_over_that_at_the_pitch_point(case: dict[str, Any]) -> None:
    found = design(spec_of(case["input"])).data.flank.single_contact_ratios
    for name, value in zip(("M_1", "M_2"), found, strict=True):
        assert value == pytest.approx(case["expected"][name]["value"], abs=case["expected"][name]["tolerance"])


@pytest.mark.parametrize("case", [case for case in PAIRS if "theta" in case["expected"]], ids=lambda case: case["name"])
def test_direction_of_the_tool_at_the_root_tangent(case: dict[str, Any]) -> None:
    sections = design(spec_of(case["input"])).data.root.sections
    found = [math.degrees(section.theta) for section in sections]
    assert found == pytest.approx(case["expected"]["theta"]["value"], abs=case["expected"]["theta"]["tolerance"])


def test_backlash_limits() -> None:
    case = next(case for case in CASES if case["name"] == "backlash-limits-24-55")
    given, wanted = case["input"], case["expected"]
    spec = spec_of(given) | {
        "allowances": {"upper": given["thickness_allowance_upper"], "lower": given["thickness_allowance_lower"]},
        "center_distance_allowance": given["center_distance_allowance"],
    }
    pair = design(spec)
    assert pair.data.distance_allowance == wanted["js7"]["value"]
    circumferential, normal = pair.quantity("backlash_circumferential").value, pair.quantity("backlash_normal").value
    first, second = pair.quantity("backlash_angle").value
    for end, name in enumerate(("least", "greatest")):
        found = [circumferential[end], normal[end], first[end], second[end]]
        assert found == pytest.approx(wanted[name]["value"], abs=wanted[name]["tolerance"])


@pytest.mark.parametrize(("teeth", "x0", "rounding"), [(25, 0.1, 0.25), (18, -0.1, 0.2), (40, 0.0, 0.3)])
def test_fillet_of_a_shaped_ring_meets_its_involute_where_the_form_radius_says(
    teeth: int, x0: float, rounding: float
) -> None:
    """Fillet and involute share the form circle to 1e-9 mm: the fillet is an envelope, the radius a closed form."""
    z, x, alpha = 67, -0.3, math.radians(20.0)
    cutter = PinionCutter(teeth=teeth, shift=x0, rounding=rounding)
    ring = ShapedRing(module=2.0, teeth=-z, shift=x, cutter=cutter, pressure_angle=alpha)
    start, end = ring.turns
    assert abs(ring.fillet(start)) == pytest.approx(ring.root_radius, abs=1e-9)
    at_form = math.acos(z * math.cos(alpha) / ring.form_radius)
    half_tooth = (math.pi / 2 + 2 * x * math.tan(alpha)) / z - involute(alpha) + involute(at_form)
    assert cmath.phase(ring.fillet(end)) == pytest.approx(math.pi / z - half_tooth, abs=1e-10)
    before = abs(cmath.phase(ring.fillet(end - 1e-4)) - cmath.phase(ring.fillet(end)))
    assert before < 1e-4  # it ends along the flank, without a corner
    assert ring.substitute.rounding > rounding


@pytest.mark.parametrize(("beta", "x"), [(0.0, 0.0), (0.0, 0.3), (15.0, -0.1)])
def test_a_rack_is_the_limit_of_ever_more_teeth(beta: float, x: float) -> None:
    """What a wheel of 10000 teeth lacks of a rack is of the order 1/10000; of a million, a hundred times less."""
    spec = {"kind": "gear-pair", "module": 2, "helix_angle": beta, "profile_shift": [x, 0]}
    rack = design(spec | {"teeth": [20, "rack"]})
    mesh = GearPair(module=2.0, teeth=(20, 10**6), helix_angle=math.radians(beta), given_shift=(x, 0.0), tip="none")
    assert rack.quantity("contact_ratio").value == pytest.approx(mesh.contact_ratio, rel=1e-4)
    assert rack.quantity("specific_sliding").value[0] == pytest.approx(mesh.specific_sliding[0], rel=1e-3)
    assert rack.quantity("center_distance").value == rack.quantity("reference_radius").value[0] + 2.0 * x
    assert [rack.quantity(name).value[1] for name in ("tip_radius", "measure_over_balls", "span_teeth")] == [None] * 3
    placed = design(
        {key: value for key, value in spec.items() if key != "profile_shift"}
        | {"teeth": [20, "rack"], "center_distance": rack.quantity("center_distance").value}
    )
    assert placed.quantity("profile_shift").value[0] == pytest.approx(x, abs=1e-14)
