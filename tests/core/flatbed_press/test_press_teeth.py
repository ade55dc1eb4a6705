"""Gears 3 and 4, pinion and racks of a press, and its velocity polygons.

Tolerances: rounding; the bed's speed is that of a table made by another way, to 1e-9.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from factory import design


def press(**keys: Any) -> Any:
    return design("ty460_gears", command="press", **keys)


def test_polygons_close_and_move_bed_and_cylinder() -> None:
    """v_bed = 2 v_F without the lift of a cam, v_cylinder = v_M R/MN."""
    found = press(cam=None)
    table = found.table("polygons")
    vector = {
        name: table[name] * np.exp(1j * np.radians(table[f"{name}_direction"]))
        for name in ("v_B", "v_CB", "v_C", "v_E", "v_FE", "v_F", "v_H", "v_MH", "v_M")
    }
    for start, end in ("BC", "EF", "HM"):
        assert vector[f"v_{start}"] + vector[f"v_{end}{start}"] == pytest.approx(vector[f"v_{end}"], abs=1e-9)
    speed = 4500.0 / 3600.0 * 2.0 * math.pi
    assert table["v_B"] == pytest.approx(np.full(12, 116.0 * speed), rel=1e-12)
    assert table["v_E"] == pytest.approx(table["v_C"] * found.slider_crank.crank_length / 100.0, rel=1e-12)
    positions = found.table("positions")
    assert np.abs(positions["bed_velocity"]) == pytest.approx(2.0 * table["v_F"], abs=1e-9)
    assert np.abs(positions["cylinder_velocity"]) == pytest.approx(table["v_M"] * 140.0 / 95.0, rel=1e-9)
    assert found.table("polygons", samples=36).length == 36


@pytest.mark.parametrize("teeth", [70, 72, 73, 74])
def test_given_teeth_shift_the_input_gears(teeth: int) -> None:
    """The report's 1.1 for another number of teeth: the equations of the involute, written here once more."""
    found = press(input_gears__teeth=teeth)
    distance, alpha = math.hypot(290.0, 13.0), math.radians(20.0)
    working = math.acos(4.0 * teeth * math.cos(alpha) / distance)
    involute = math.tan(working) - working - math.tan(alpha) + alpha
    assert found.input_gear_teeth == teeth
    assert found.raw("shift_sum") == pytest.approx(teeth * involute / math.tan(alpha), rel=1e-10)
    assert found.raw("working_radius") == pytest.approx((distance / 2.0, distance / 2.0), rel=1e-13)
    assert press().input_gear_teeth == 72
    rows = found.table("candidates")
    own = dict(zip(rows["module"], rows["teeth"], strict=True))
    assert own[4.0] == teeth
    assert own[5.0] == math.floor(distance / 5.0)


@pytest.mark.slow
def test_input_gears_are_cut_once() -> None:
    """Samples of the axes' distance have the teeth, shifts and tips of the nominal gears, as those of a gear-pair.

    Its source is the centre distance a_w = sqrt(w^2 + 13^2), at da_w = w/a_w dw; bends of second order count 1e-6.
    """
    across, play = math.sqrt(288.0**2 - 13.0**2) + 1e-6, 0.05
    sources = {"input_gears.horizontal_distance": {"plus_minus": play}}
    section: dict[str, Any] = {"command": "gear", "samples": 64, "sources": sources}
    gears = {"module": 4.0, "horizontal_distance": across}
    found = press(input_gears=gears, tolerance=section)
    assert found.input_gear_teeth == 72  # and 71 in every other sample, if it were cut to the sample's distance
    distance = math.hypot(across, 13.0)
    pair = {"kind": "gear-pair", "module": 4.0, "teeth": [72, 72], "center_distance": distance}
    alone = {**section, "sources": {"center_distance": {"plus_minus": play * across / distance}}}
    both = [
        {name: (mean, sigma) for name, mean, sigma in zip(t["quantity"], t["mean"], t["sigma"], strict=True)}
        for t in (
            design("ty460_gears", command="tolerance", input_gears=gears, tolerance=section).table("quantities"),
            design({**pair, "tolerance": alone}, command="tolerance").table("quantities"),
        )
    ]
    for name in ("working_pressure_angle", "contact_ratio", "center_distance"):
        assert both[0][name] == pytest.approx(both[1][name], rel=1e-3)


def test_gears_are_those_of_a_pair_and_of_a_pinion_on_a_rack() -> None:
    found = press()
    pair = design({"kind": "gear-pair", "module": 4.0, "teeth": [68, 68], "center_distance": 272.0}, command="gear")
    rack = design(
        {"kind": "gear-pair", "module": 4.0, "teeth": [50, "rack"], "profile_shift": [0.0, 0.0]}, command="gear"
    )
    for name in ("contact_ratio", "center_distance", "specific_sliding", "tip_radius", "total_contact_ratio"):
        assert found.raw(f"cylinder_gears.{name}") == pytest.approx(pair.raw(name), rel=1e-13)
    for name in ("contact_ratio", "center_distance", "tip_thickness"):
        assert found.raw(f"pinion_rack.{name}") == rack.raw(name)
    assert found.raw("pinion_radius") == 100.0
    travel = found.raw("rack_travel")
    assert travel == pytest.approx([310.0 + found.follower_stroke, 310.0], rel=1e-12)
    assert all(z * 4.0 * math.pi > way + 20.0 for z, way in zip(found.raw("rack_teeth"), travel, strict=True))
    names = [each.name for each in found.report("gear").quantities]
    assert "cylinder_gears.contact_ratio" in names
    assert "contact_ratio" in names
    alone = press(input_gears=None).report("gear")
    assert "contact_ratio" not in [each.name for each in alone.quantities]
    assert {each.status for each in alone.checks} <= {"pass", "warn"}


def test_teeth_feed_the_loads() -> None:
    loads = design("loaded_press", command="loads", cylinder__gear_ratio=None,
                   cylinder__gears={"module": 4.0, "teeth": [68, 68]},
                   bed__pinion={"module": 5.0, "teeth": 44, "pressure_angle": 25.0})  # fmt: skip
    assert loads.pitch_radii == pytest.approx((136.0, 136.0), rel=1e-14)
    assert loads.pinion_radius == pytest.approx(110.0, rel=1e-14)
    mesh = next(each for each in loads.moving.at(np.zeros(1), 1).connections if each.name == "rack_upper")
    assert mesh.tangent == pytest.approx(math.tan(math.radians(25.0)), rel=1e-14)
    ratio = design("ty460_gears", command="press", cylinder__gears__teeth=[136, 68])
    assert ratio.cylinder.gear_ratio == 2.0


def test_checks_and_refusals() -> None:
    short = press(bed__rack_teeth=[20, 28])
    found = {each.message.split()[3]: each.status for each in short.check("rack-length")}
    assert found == {"lower": "fail", "upper": "pass"}
    few = press(bed__pinion__teeth=12).check("undercut")
    assert [each.status for each in few if "pinion_rack" in each.message] == ["fail"]
    for keys, words in (
        ({"cylinder__gear_ratio": 2.0}, "omit gear_ratio"),
        ({"bed__pinion": None, "bed__rack_teeth": [30, 30]}, "rack_teeth needs pinion"),
        ({"loads": {"pinion_radius": 90.0}}, "omit pinion_radius"),
    ):
        with pytest.raises(ValueError, match=words):
            press(**keys)
    assert press(loads={"pinion_radius": 100.0, "cylinder_gear_radius": 136.0})
