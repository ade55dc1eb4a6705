"""Bodies that once passed unseen, rings, ranges of distance, and what the findings say and advise.

Tolerances: sums of a few lengths, 1e-12 of them. Remedies are applied as printed and must hold exactly.
"""

from __future__ import annotations

import math
import re
from typing import Any

import numpy as np
import pytest
from factory import design
from pydantic import ValidationError

from gearlink.core.base.codes import rules
from gearlink.core.parts.linkages.fourbar.position import FourBar
from gearlink.core.studies.clearance import (
    Gear,
    Layout,
    Reach,
    Shaft,
    constant,
    coupler_joint,
    crank_pin,
    least_gap,
    shaft_checks,
)

IDLER = {
    "kind": "geared-five-bar",
    "gears": {"module": 2, "input": 40, "idler": 20, "output": 40},
    "links": {"input": 15, "coupler": 80, "follower": 80, "output": 15, "frame": 70},
    "phase": 90,
    "coupler_point": {"along": 60},
    "limits": {"transmission_angle": 10},
}
DRAG_LINK = {
    "kind": "three-gear-four-bar",
    "gears": {"module": 2, "crank": 20, "idler": 60, "output": 20},
    "links": {"crank": 65, "frame": 15},
    "shafts": {"input_radius": 2, "output_radius": 10},
    "limits": {"transmission_angle": 20},
}
RING = {
    "kind": "two-gear-four-bar",
    "gears": {"module": 2, "planet": 25, "ring": 75},
    "links": {"coupler": 90, "rocker": 95, "frame": 79},
    "limits": {"transmission_angle": 15},
}
FIXED_RING = {
    "kind": "geared-five-bar",
    "form": "function",
    "gears": {"module": 2, "planet": 30, "ring": 60},
    "links": {"coupler": 10, "follower": 70, "output": 60, "frame": 61},
    "phase": 0,
    "limits": {"transmission_angle": 5},
}
FIXED_SUN = {
    "kind": "geared-five-bar",
    "form": "function",
    "gears": {"module": 2, "planet": 30, "sun": 30},
    "links": {"coupler": 20, "follower": 90, "output": 90, "frame": 65},
    "phase": 0,
    "limits": {"transmission_angle": 5},
}
EXAMPLE_3 = {
    "kind": "three-gear-four-bar",
    "gears": {"module": 2.5, "crank": 20, "idler": 20, "output": 60},
    "links": {"crank": 16, "frame": 122.83941479},
}


def findings(data: dict[str, Any], **keys: Any) -> dict[str, Any]:
    """The findings of GL301 and GL302 that do not pass, by the words before their first figure."""
    made = design(data, **keys)
    names = {name for code in ("GL301", "GL302") for name in rules()[code].checks} & {*made.outline("analyze").checks}
    return {check.message: check for name in sorted(names) for check in made.check(name) if check.status != "pass"}


def finding(data: dict[str, Any], words: str, **keys: Any) -> Any:
    (check,) = [check for message, check in findings(data, **keys).items() if words in message]
    return check


# What passed unseen


def test_input_and_output_gear_with_an_idler_overlap() -> None:
    found = design(IDLER)
    (check,) = found.check("gear-collision")
    assert (check.code, check.status, check.value, check.limit) == ("GL301", "fail", -14.0, 0.0)
    assert "interference of the input gear and the output gear" in check.message
    assert found.quantity("gear_gap").value == -14.0
    assert not found.report("analyze").ok


def test_output_shaft_within_the_input_gear() -> None:
    teeth = {"gears__input": 80, "gears__output": 20, "links__frame": 70}
    assert finding(IDLER, "the input gear and the output gear", **teeth).status == "fail"
    check = finding(IDLER, "overlap of the input gear and the axis of the shaft at E", **teeth)
    assert (check.code, check.status, check.value) == ("GL302", "warn", 70.0 - 82.0)
    check = finding(IDLER, "overlap of the input gear and the shaft at E", shafts__E_radius=5.0, **teeth)
    assert (check.status, check.value) == ("fail", 70.0 - 82.0 - 5.0)


def test_output_gear_of_a_drag_link_over_the_input_shaft() -> None:
    check = finding(DRAG_LINK, "overlap of the output gear and the input shaft: 9 mm")
    assert (check.code, check.status, check.value, check.limit) == ("GL302", "fail", 15.0 - 22.0 - 2.0, 0.0)
    assert not design(DRAG_LINK).report("analyze").ok


def test_shafts_of_a_drag_link_that_overlap() -> None:
    shafts = {"shafts__input_radius": 2.9, "shafts__output_radius": 14.0}
    check = finding(DRAG_LINK, "overlap of the input shaft and the output shaft: 1.9", **shafts)
    assert (check.code, check.status) == ("GL302", "fail")
    assert check.value == pytest.approx(15.0 - 2.9 - 14.0, abs=1e-12)


@pytest.mark.quick(1)
@pytest.mark.parametrize(("teeth", "frame"), [((25, 75), 79.0), ((20, 60), 64.0)])
def test_rim_of_a_ring_gear_over_the_axis_of_the_rocker(teeth: tuple[int, int], frame: float) -> None:
    keys = {"gears__planet": teeth[0], "gears__ring": teeth[1], "links__frame": frame}
    check = finding(RING, "overlap of the ring gear", **keys)
    rim = teeth[1] + 2.5 + 4.0
    assert (check.status, check.value) == ("warn", frame - rim)
    assert "overlap of the ring gear and the axis of the shaft at D" in check.message
    # a rim only just outside the root circle clears an axis that lies outside it, a thick one does not
    assert (
        finding(
            RING, "distance of the ring gear from the axis of the shaft at D: 0.5 mm", **keys, gears__rim=frame - 0.5
        ).value
        == 0.5
    )
    assert finding(RING, "overlap of the ring gear and the shaft at D", **keys, shafts__D_radius=3.0).status == "fail"


def test_teeth_of_the_fixed_ring_over_the_output_axis() -> None:
    check = finding(FIXED_RING, "overlap of the ring gear and the axis of the shaft at E: 3 mm")
    assert (check.code, check.status, check.value) == ("GL302", "warn", 58.0 - 61.0)


def test_planet_of_the_function_form_sweeps_over_the_output_axis() -> None:
    check = finding(FIXED_SUN, "overlap of the planet and the axis of the shaft at E: 27 mm")
    assert (check.code, check.status, check.value) == ("GL302", "warn", 5.0 - 32.0)
    assert "at input angle 0 deg" in check.message
    away = finding(FIXED_SUN, "the planet and the axis of the shaft at E", range={"start": 20.0, "end": 340.0})
    nearest = abs(65.0 - 60.0 * complex(math.cos(math.radians(20.0)), math.sin(math.radians(20.0))))
    assert away.value == pytest.approx(nearest - 32.0, abs=1e-12)
    assert (
        "overlap of the planet and the axis of the shaft at E" in away.message
        or "at input angle 340 deg" in away.message
    )


# No cliff beside an axis


@pytest.mark.parametrize(
    ("least", "status"), [(None, "pass"), (6.4, "pass"), (6.6, "warn"), (0.0, "pass"), (20.0, "warn")]
)
def test_least_shaft_beside_a_bare_axis(least: float | None, status: str) -> None:
    # C comes to b - a = 34 mm of A, the idler's tips reach 27.5 mm: 6.5 mm are left, 2 modules are 5
    check = design(EXAMPLE_3, limits__least_shaft=least).check("shaft-clearance")[0]
    assert check.value == pytest.approx(6.5, abs=1e-12)
    assert (check.status, check.limit) == (status, 5.0 if least is None else least)


def test_least_shaft_of_two_bare_axes_counts_twice() -> None:
    checks = design(EXAMPLE_3, limits__least_shaft=62.0).check("shaft-clearance")
    assert (checks[-1].limit, checks[-1].status) == (124.0, "warn")
    assert "distance of the axis of the input shaft from the axis of the output shaft" in checks[-1].message


def test_shaft_over_a_bare_axis() -> None:
    check = finding(
        DRAG_LINK, "overlap of the axis of the input shaft and", shafts__input_radius=None, shafts__output_radius=16.0
    )
    assert (check.status, check.value) == ("warn", -1.0)


# What the findings advise


@pytest.mark.parametrize(("key", "thick"), [("input_radius", 9.0), ("output_radius", 99.0)])
def test_shaft_that_is_too_thick_is_to_be_thinner(key: str, thick: float) -> None:
    data = EXAMPLE_3 | {"limits": {"least_shaft": 1.0}, "shafts": {key: thick}}
    failed = [check for check in design(data).check("shaft-clearance") if check.status == "fail"]
    assert failed
    assert all("overlap of" in check.message for check in failed)
    radius = thick + min(check.value for check in failed)
    for off, statuses in ((-1e-9, {"pass"}), (1e-9, {"pass", "fail"})):
        found = design(data, shafts={key: radius + off}).check("shaft-clearance")
        assert {check.status for check in found} == statuses


def test_shaft_that_no_radius_clears_is_to_be_overhung() -> None:
    check = finding(DRAG_LINK, "overlap of the output gear and the input shaft: 9 mm")
    assert check.fix == "end the shaft before the plane of the gears (overhung)"


def test_radius_named_in_place_of_a_bare_axis_passes() -> None:
    thin = design(EXAMPLE_3, limits__least_shaft=9.0).check("shaft-clearance")[0]
    assert (thin.status, thin.fix) == ("warn", "end the input shaft before the plane of the gears (overhung)")
    check = design(EXAMPLE_3, limits__least_shaft=7.0).check("shaft-clearance")[0]
    assert check.status == "warn"
    radius = float(re.search(r"set shafts\.input_radius to at most ([\d.]+) mm", check.fix)[1])
    assert design(EXAMPLE_3, shafts={"input_radius": radius}).check("shaft-clearance")[0].status == "pass"


def test_a_shaft_that_one_body_forbids_gets_no_radius_from_another() -> None:
    """The sun leaves 3.7 mm beside the axis at D; with a shaft of that radius the planet failed."""
    found = design("two_gear_drag_link", links__frame=23.701).check("shaft-clearance")
    warned = [check for check in found if check.status == "warn"]
    assert [check.message.split(" of ")[1].split(" and ")[0].split(" from ")[0] for check in warned] == [
        "the planet",
        "the sun",
    ]
    assert {check.fix for check in warned} == {"end the shaft at D before the plane of the gears (overhung)"}


def test_the_radius_that_is_named_is_clear_of_all_bodies() -> None:
    gears = [Gear(name, axis, outer=20.0, inner=0.0) for name, axis in (("gear 1", "A"), ("gear 2", "B"))]
    reaches = {"AD": constant(23.75), "BD": constant(23.25)}
    bare, thin = (Shaft("shaft at D", "D", radius, "shafts.D_radius") for radius in (None, 3.2))
    warned = list(shaft_checks(Layout(tuple(gears), (bare,), reaches, 4.0)))
    assert [(check.status, check.fix) for check in warned] == [("warn", "set shafts.D_radius to at most 3.2 mm")] * 2
    assert [check.status for check in shaft_checks(Layout(tuple(gears), (thin,), reaches, 4.0))] == ["pass"] * 2


@pytest.mark.quick(1)
@pytest.mark.parametrize("limit", [0.0, 3.3])
def test_frame_that_is_named_parts_input_and_output_gear(limit: float) -> None:
    found = design(IDLER, limits__gear_gap=limit).findings("analyze", "gear-collision")
    (check,) = [check for check in found if "the input gear and the output gear" in check.message]
    ((path, frame),) = check.remedy
    assert path == "links.frame"
    assert 84.0 + limit <= frame < 84.2 + limit
    assert design(IDLER, limits__gear_gap=limit, links__frame=frame).report("analyze").ok


# The kernel


RINGS = Gear("the ring gear", "A", outer=81.5, inner=73.0)


@pytest.mark.parametrize(
    ("reach", "radius", "gap", "angle"),
    [
        (constant(60.0), 5.0, 8.0, None),  # within the teeth
        (constant(90.0), 5.0, 3.5, None),  # outside the rim
        (constant(78.0), 0.0, -3.5, None),  # in the rim, nearer to its outside
        (constant(74.0), 1.0, -2.0, None),  # in the teeth
        (Reach(10.0, 70.0, 1.0, 2.0), 1.0, 2.0, 2.0),  # within: the farthest counts
        (Reach(90.0, 99.0, 1.0, 2.0), 1.0, 7.5, 1.0),  # outside: the nearest counts
        (Reach(60.0, 99.0, 1.0, 2.0), 1.0, 60.0 - 82.5, 1.0),  # right through
    ],
)
def test_a_shaft_and_a_ring(reach: Reach, radius: float, gap: float, angle: float | None) -> None:
    shaft = Shaft("shaft at D", "D", radius, "shafts.D_radius")
    for found in (least_gap(RINGS, shaft, reach), least_gap(shaft, RINGS, reach)):
        assert found.gap == pytest.approx(gap, abs=1e-12)
        assert found.angle == angle


@pytest.mark.quick(3)
@pytest.mark.parametrize("frame", [12.0, 40.0, 55.5])
@pytest.mark.parametrize(
    ("start", "end"), [(0.0, 360.0), (10.0, 170.0), (-30.0, 5.0), (175.0, 190.0), (350.0, 800.0), (361.0, 539.0)]
)
def test_pin_of_a_crank_over_a_range(frame: float, start: float, end: float) -> None:
    found = crank_pin(40.0, frame, math.radians(start), math.radians(end))
    angles = [math.radians(start + (end - start) * i / 9000) for i in range(9001)]
    distances = [abs(frame - 40.0 * complex(math.cos(phi), math.sin(phi))) for phi in angles]
    # between samples the distance changes by less than the pin moves
    step = 40.0 * (angles[1] - angles[0])
    assert found.nearest <= min(distances) + 1e-12
    assert found.farthest >= max(distances) - 1e-12
    assert min(distances) - found.nearest < step
    assert found.farthest - max(distances) < step
    for distance, place in ((found.nearest, found.nearest_at), (found.farthest, found.farthest_at)):
        assert angles[0] <= place <= angles[-1]
        there = abs(frame - 40.0 * complex(math.cos(place), math.sin(place)))
        assert there == pytest.approx(distance, abs=1e-12)


def test_coupler_joint_of_a_drag_link() -> None:
    found = coupler_joint(FourBar(116.0, 100.0, 100.0, 37.0))
    assert (found.nearest, found.farthest) == (63.0, 137.0)


# The design files


@pytest.mark.parametrize(
    ("data", "keys", "words"),
    [
        (RING, {"gears__rim": 77.5}, "limit > 77.5 mm, the root radius of the ring gear"),
        (FIXED_RING, {"gears__rim": 60.0}, "the root radius"),
        (FIXED_SUN, {"gears__rim": 90.0}, "rim applies only to a ring gear"),
        (IDLER, {"gears__rim": 90.0}, "rim applies only to a ring gear"),
        (FIXED_SUN, {"shafts__O_radius": 5.0}, "O_radius applies only with an idler"),
        ("mutilated_gear_press", {"links": None, "shafts__D_radius": 5.0}, "D_radius applies only with the four-bar"),
        (RING, {"shafts__E_radius": 5.0}, "Extra inputs"),
    ],
)
def test_keys_that_do_not_apply_are_refused(data: Any, keys: dict[str, Any], words: str) -> None:
    with pytest.raises(ValidationError, match=re.escape(words)):
        design(data, **keys)


@pytest.mark.quick(4)
@pytest.mark.parametrize(
    ("name", "keys"),
    [
        ("candy_feed", ("input_radius", "output_radius")),
        ("two_gear_ring", ("A_radius", "D_radius")),
        ("wide_lever", ("A_radius", "D_radius")),
        ("five_bar_path", ("A_radius", "E_radius")),
        ("five_bar_positions", ("A_radius", "E_radius")),
        ("hypocycloid_slider", ("O_radius",)),
        ("mutilated_gear_press", ("A_radius", "D_radius", "W_radius")),
    ],
)
def test_every_kind_with_gears_takes_shafts_and_limits(name: str, keys: tuple[str, ...]) -> None:
    command = "synth dwell" if name == "candy_feed" else "analyze"
    for key in keys:
        found = design(name, command=command, shafts={key: 1000.0}, limits__gear_gap=0.5, limits__least_shaft=1.0)
        fails = [check.message for check in found.check("shaft-clearance") if check.status == "fail"]
        assert fails
        assert all("radius 1000 mm" in message for message in fails)


def test_a_long_period_costs_no_sweep() -> None:
    links = {"input": 15, "coupler": 180, "follower": 180, "output": 15, "frame": 200.0}
    found = design(IDLER, gears__input=97, gears__idler=30, gears__output=89, links=links)
    assert found.period_turns == 89
    assert found.gear_gap == 200.0 - (97 + 2) - (89 + 2)


def test_a_gear_on_the_input_link_is_one_body_with_the_input_shaft() -> None:
    """Gear 1 of the second train is fixed to AB: its blank may lie round A. A planet there, fixed to BC, may not."""
    fixed = [{"pins": ["A", "B"], "module": 2, "gears": [10, 10]}, {"pins": ["B", "C"], "module": 1, "gears": [18, 18]}]
    machine = design("geared_six_bar", trains=fixed, shafts={"A_radius": 12.0})
    gaps = {(gear.name, shaft.name) for gear, shaft, *_ in machine.layouts[1].shaft_pairs}
    assert machine.lengths[1] == 20.0 < 18 / 2 + 1 + 12.0  # the blank on B meets the shaft at A
    assert ("the gear on B", "shaft at A") not in gaps
    assert ("the gear on C", "shaft at A") in gaps
    assert ("the gear on B", "shaft at F") in gaps
    assert ("the gear on B", "shaft at A") in {
        (one.name, other.name) for one, other, *_ in machine.layouts[0].shaft_pairs
    }


def test_a_mutilated_wheel_is_tried_against_the_rocker_shaft_where_its_direction_is_given() -> None:
    """W stands 150 mm from A, D 140 mm along x: the wheel with tips of 123 mm covers D, 10 mm away, or is far off."""
    for direction, status in ((0.0, "warn"), (180.0, "pass"), (None, None)):
        loads = {} if direction is None else {"loads": {"wheel_direction": direction}}
        found = [
            (check.status, check.value)
            for check in design("mutilated_gear_press", **loads).check("shaft-clearance")
            if "wheel" in check.message and "shaft at D" in check.message
        ]
        assert found == (
            [] if direction is None else [(status, abs(150.0 - 140.0 * math.cos(math.radians(direction))) - 123.0)]
        )


def test_a_crank_gear_that_stays_within_the_output_ring_needs_no_plane_of_its_own() -> None:
    """BD is at most 55 mm: with the tips of 22 mm the gear stays within the ring's tips, 98 mm, by 21 mm."""
    gears = {"module": 2, "crank": 20, "idler": 20, "output": -100}
    train = {"kind": "three-gear-four-bar", "gears": gears, "links": {"crank": 5, "frame": 50}}
    (within,) = design(train).check("gear-collision")
    assert (within.status, within.limit) == ("pass", 0.0)
    assert math.isclose(within.value, 98.0 - 55.0 - 22.0, rel_tol=1e-12)
    (near,) = design(train, limits__gear_gap=21.5).check("gear-collision")
    (through,) = design("ring_feed", command="synth dwell").check("gear-collision")
    assert near.status == through.status == "warn"
    assert "separate planes" in through.fix


SEATS = {
    "three gears": ("candy_feed", "shafts__output_radius", 2.0, 40),
    "geared rocker": ("wide_lever", "shafts__D_radius", None, None),
    "five-bar": ("five_bar_path", "shafts__E_radius", None, None),
    "two gears": ("two_gear_drag_link", "shafts__A_radius", None, None),
    "mutilated gear": ("mutilated_gear_press", "shafts__A_radius", None, None),
}


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", SEATS)
def test_a_shaft_that_leaves_its_gear_no_rim_is_warned_of(name: str) -> None:
    """Standard teeth: root 1.25 modules within the reference circle, half the height of the teeth 1.125 modules."""
    worked, key, module, teeth = SEATS[name]
    made = design(worked)
    if module is None:
        gears, place = made.spec.gears, {"E": 1, "D": 1, "A": -1}[key[8]]
        module, teeth = gears.module, abs(made.signed_teeth[place])
    root = module * (0.5 * teeth - 1.25)
    for radius, status in ((root - 1.13 * module, []), (root - 1.12 * module, ["warn"]), (root + 0.1, ["warn"])):
        found = design(worked, **{key: radius}).check("shaft-seat")
        assert [check.status for check in found] == status, radius
        assert [check.code for check in found] == ["GL302"] * len(status)
        assert all(check.value == pytest.approx(root - radius, abs=1e-9) for check in found)
    assert design(worked).check("shaft-seat") == []


@pytest.mark.parametrize(
    ("nearest", "farthest", "words", "side", "deepest"),
    [
        (20.0, 130.0, "65 mm (limit <= 0 mm; shaft at D radius 5 mm) at input angle 0 deg", "without", 15.0),
        (20.0, 70.0, "15 mm (limit <= 0 mm; shaft at D radius 5 mm) at input angle 180 deg", "within", 15.0),
        (78.0, 130.0, "7 mm (limit <= 0 mm; shaft at D radius 5 mm) at input angle 0 deg", "without", 7.0),
    ],
)
def test_a_moving_ring_and_a_shaft_say_what_is_missing(
    nearest: float, farthest: float, words: str, side: str, deepest: float
) -> None:
    """What is missing is a length to move by; the depth at a moment, read off a scan, may be less than that."""
    ring, shaft = Gear("the ring gear", "C", outer=80.0, inner=60.0), Shaft("shaft at D", "D", 5.0, "shafts.D_radius")
    layout = Layout((ring,), (shaft,), {"CD": Reach(nearest, farthest, 0.0, math.pi)}, 4.0)
    (check,) = shaft_checks(layout)
    assert check.status == "fail"
    assert words in check.message
    depths = [max(60.0 - d - 5.0, d - 80.0 - 5.0) for d in np.linspace(nearest, farthest, 1001)]
    assert -min(depths) == pytest.approx(deepest, abs=0.06)
    lacking = -check.value
    assert lacking >= deepest - 1e-12
    moved = lacking if side == "without" else -lacking
    freed = Layout((ring,), (shaft,), {"CD": Reach(nearest + moved, farthest + moved, 0.0, math.pi)}, 4.0)
    assert [each.status for each in shaft_checks(freed)] == ["pass"]
