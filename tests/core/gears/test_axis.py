"""Gear pairs over arrays against their class: refusals and statuses equal, values within 1e-9 of their size.

Both forms share their formulas; what is left are the last bits of elementary functions, times the condition of a
pressure angle near 0, and of the cut between fillet and involute.
"""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest
from axes import SOAK, agree, bits_stand_alone, by_path, sampled

from gearlink.core.studies.explore.chunks import chunk_of, evaluated, together
from gearlink.core.studies.explore.preparing import problem
from gearlink.core.studies.study.spec import StudySpec

BASE: dict[str, Any] = {"kind": "gear-pair", "module": 2, "teeth": [23, 48], "center_distance": 72}
SHIFTED = {"kind": "gear-pair", "module": 2, "teeth": [23, 48], "profile_shift": [0.2, 0.1]}
_OF_BOTH = (
    *("profile_shift", "reference_radius", "base_radius", "working_radius", "tip_radius", "root_radius"),
    *("tooth_thickness", "tip_pressure_angle", "tip_thickness", "min_shift_no_undercut", "span_measurement"),
    *("span_teeth", "specific_sliding", "form_radius", "tip_clearance", "used_root_radius", "specific_sliding_tip"),
    *("sliding_factor", "min_teeth_no_undercut"),
)
QUANTITIES = [
    *("contact_ratio", "working_pressure_angle", "center_distance", "reference_center_distance", "shift_sum"),
    *("center_distance_modification", "tip_shortening", "transverse_pressure_angle", "base_helix_angle"),
    *("path_of_contact", "usable_contact_ratio"),
    *(f"{name}[{gear}]" for name in _OF_BOTH for gear in (0, 1)),
]
WIDE = [*QUANTITIES, "overlap_ratio", "total_contact_ratio"]
TEETH = {"teeth[0]": {"from": 3, "to": 60}, "teeth[1]": {"from": 3, "to": 120}}
STUDIES: dict[str, tuple[dict[str, Any], dict[str, Any], list[str]]] = {
    "distance": (
        BASE,
        {
            "teeth[0]": {"from": 12, "to": 30},
            "teeth[1]": {"from": 36, "to": 60},
            "center_distance": {"from": 66, "to": 78},
        },
        QUANTITIES,
    ),
    "distance, split": (
        {**BASE, "face_width": [20, 18], "limits": {"undercut": 0.2, "tip_thickness": 0.3, "sliding": 2}},
        {
            "module": {"from": 1.8, "to": 2.2},
            "shift_split": {"from": -1, "to": 1.2},
            "center_distance": {"from": 66, "to": 78},
        },
        WIDE,
    ),
    "shifts": (
        SHIFTED,
        {**TEETH, "profile_shift[0]": {"from": -1.2, "to": 1.5}, "profile_shift[1]": {"from": -1.2, "to": 1.5}},
        QUANTITIES,
    ),
    "profile": (
        SHIFTED,
        {
            **TEETH,
            "profile_shift[0]": {"from": -0.6, "to": 1},
            "module": {"values": [0.3, 1, 2.5, 12]},
            "pressure_angle": {"from": 12, "to": 32},
            "addendum": {"from": 0.5, "to": 1.5},
            "clearance": {"from": 0.02, "to": 0.4},
        },
        QUANTITIES,
    ),
    "helix": (
        {**SHIFTED, "helix_angle": 15, "face_width": 20},
        {
            **TEETH,
            "helix_angle": {"values": [0, 0, 5, 10.5, 20, 30, 45]},
            "profile_shift[1]": {"from": -0.6, "to": 1},
        },
        WIDE,
    ),
    "helix, distance": (
        {**BASE, "helix_angle": 10},
        {"helix_angle": {"from": 0, "to": 30}, "center_distance": {"from": 70, "to": 80}},
        QUANTITIES,
    ),
}

RING: dict[str, Any] = {"kind": "gear-pair", "module": 2, "teeth": [21, -67], "profile_shift": [0.3, -0.3]}
RING_QUANTITIES = [
    *(name for name in QUANTITIES if name not in ("min_shift_no_undercut[1]", "min_teeth_no_undercut[1]")),
    *("involute_margin", "tip_fouling_margin", "radial_assembly_margin"),
]
RING_TEETH = {"teeth[0]": {"from": 10, "to": 60}, "teeth[1]": {"from": -160, "to": -55}}
STUDIES |= {
    "ring": (
        RING,
        {**RING_TEETH, "profile_shift[0]": {"from": -0.8, "to": 1}, "profile_shift[1]": {"from": -1, "to": 0.8}},
        RING_QUANTITIES,
    ),
    "ring, distance": (
        {**{key: RING[key] for key in ("kind", "module", "teeth")}, "center_distance": 46, "assembly": "radial"},
        {
            "teeth[0]": {"from": 17, "to": 25},
            "teeth[1]": {"from": -72, "to": -62},
            "center_distance": {"from": 40, "to": 52},
            "shift_split": {"from": -1, "to": 1},
        },
        RING_QUANTITIES,
    ),
    "ring, profile": (
        {**RING, "tip_shortening": "none", "limits": {"undercut": 0.2, "sliding": 2}},
        {
            **RING_TEETH,
            "module": {"values": [0.3, 1, 2.5, 12]},
            "pressure_angle": {"from": 14, "to": 32},
            "addendum": {"from": 0.5, "to": 1.3},
            "clearance": {"from": 0.02, "to": 0.4},
        },
        RING_QUANTITIES,
    ),
    "ring, helix": (
        {**RING, "helix_angle": 15, "face_width": 20},
        {
            **RING_TEETH,
            "helix_angle": {"values": [0, 0, 5, 10.5, 20, 30, 45]},
            "profile_shift[1]": {"from": -0.6, "to": 0.6},
        },
        [*RING_QUANTITIES, "overlap_ratio", "total_contact_ratio"],
    ),
    "few teeth less": (
        RING,
        {
            "teeth[0]": {"from": 50, "to": 64},
            "profile_shift[0]": {"from": -0.5, "to": 0.5},
            "addendum": {"from": 0.6, "to": 1.1},
        },
        RING_QUANTITIES,
    ),
}


def test_a_span_that_leaves_the_face_of_a_narrow_helical_gear_is_counted() -> None:
    """GL213 of some designs and not of others, by the array form as by the class."""
    base, variables, quantities = STUDIES["helix"]
    made = sampled(base, "gear", variables, quantities, 24)
    agree(made)
    found = [each for each in evaluated(made, made.order.columns(np.arange(24))).findings if each.code == "GL213"]
    assert 0 < sum(int(each.warns.sum()) for each in found) < 24


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", STUDIES)
@pytest.mark.parametrize("count", [64, pytest.param(1024, marks=pytest.mark.slow), SOAK])
def test_refusals_statuses_and_values_are_those_of_the_class(name: str, count: int) -> None:
    base, variables, quantities = STUDIES[name]
    agree(sampled(base, "gear", variables, quantities, count))


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["distance", "profile", "helix", "ring"])
def test_no_bit_depends_on_the_neighbours(name: str) -> None:
    base, variables, quantities = STUDIES[name]
    bits_stand_alone(sampled(base, "gear", variables, quantities, 1024))


@pytest.mark.quick(2)
def test_tips_that_are_shortened_beyond_the_axis_are_refused() -> None:
    """A wide centre distance takes 31 modules from the tips: the square of the radius, then below -r_b, exceeds that of
    the base radius, and the pair had a contact ratio of 1.37."""
    base = {"kind": "gear-pair", "module": 2.5, "teeth": [26, 53], "center_distance": 100, "shift_split": 0.2}
    variables = {"module": {"from": 1.65, "to": 1.8}, "teeth[1]": {"from": 36, "to": 42}}
    made = sampled(base, "gear", variables, ["contact_ratio", "tip_thickness[0]"], 64)
    agree(made)
    assert (made.axis.evaluate(by_path(made, made.order.columns(np.arange(64)))).refused > 0).any()


@pytest.mark.parametrize("must_pass", ["none", ["GL201", "GL205"], ["GL210"], "all"])
def test_a_design_is_refused_where_what_is_asked_for_needs_it(must_pass: Any) -> None:
    data = {
        "kind": "study",
        "design": SHIFTED,
        "variables": {
            "teeth[1]": {"values": [9, 48, -90, 1]},
            "profile_shift[0]": {"values": [-2.2, -1, 0, 1]},
            "profile_shift[1]": {"values": [0.5, 2, 4.5]},
        },
        "minimize": {"base_radius[1]": 1, "shift_sum": 0.1},
        "checks": {"must_pass": must_pass},
    }
    made = problem(StudySpec.model_validate_json(json.dumps(data)))
    alone = problem(made.spec)
    vars(alone)["axis"] = None
    assert made.axis is not None
    many, single = (together(each, (chunk_of(each, k) for k in range(each.chunks))) for each in (made, alone))
    assert many.feasible == single.feasible
    assert {name: (m.fails, m.alone, m.index) for name, m in many.misses.items()} == {
        name: (m.fails, m.alone, m.index) for name, m in single.misses.items()
    }
    assert np.allclose(many.rows, single.rows, rtol=1e-9, atol=0.0)


@pytest.mark.parametrize(
    ("change", "served"),
    [
        ({}, True),
        ({"tip_shortening": "full"}, True),
        ({"tip_shortening": "none"}, False),
        ({"shift_split": "sliding"}, False),
        ({"teeth": [23, -90], "center_distance": 66.5}, True),
        ({"teeth": [23, -90], "center_distance": 66.5, "tip_shortening": "full"}, False),
        ({"teeth": [23, -90], "center_distance": 66.5, "cutter": {"teeth": 30}}, False),
        ({"teeth": [23, "rack"], "center_distance": 23.5}, False),
        ({"load": {"torque": 100}, "face_width": 20}, False),
        ({"allowances": {"series": "25cd"}}, False),
        ({"profile_shift": [0.2, 0.2]}, False),
        ({"tool": {"addendum": 1.3}}, False),
    ],
)
def test_what_the_form_has_not_is_left_to_the_class(change: dict[str, Any], served: bool) -> None:
    data = {
        "kind": "study",
        "design": {**BASE, **change},
        "variables": {"module": {"values": [2, 2.01]}},
        "minimize": {"working_pressure_angle": 1},
        "checks": {"must_pass": "none"},
    }
    assert (problem(StudySpec.model_validate_json(json.dumps(data))).axis is not None) is served


def study(name: str, count: int) -> Any:
    base, variables, quantities = STUDIES[name]
    return sampled(base, "gear", variables, quantities, count)
