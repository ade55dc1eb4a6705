"""Samples of every kind, each design by its class: the same from the study's text, and spread as the slopes say.

Few samples each; a deviation of 64 scrambled points of a normal law lies within a tenth of its own.
"""

from __future__ import annotations

import math
from typing import Any

import factory
import numpy as np
import pytest

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.kinds import KINDS
from gearlink.core.studies.tolerance_study.samples import judged_replication, problem_of, text_of

NARROW = {"plus_minus": 0.003}
STUDIES: dict[str, tuple[list[str], str]] = {
    "two_gear_standing": (["links.coupler", "links.frame"], "back_step_angle <= 90 deg"),
    "wide_lever": (["links.crank", "links.frame"], "min_transmission_angle >= 1 deg"),
    "crank_rocker_links": (["links.crank", "links.frame"], "rocker_swing >= 1 deg"),
    "five_bar_path": (["links.input", "links.coupler", "phase"], "min_transmission_angle >= 1 deg"),
    "ty460_slider_crank": (["stroke", "rod", "offset"], "crank_length >= 1 mm"),
    "cycloidal_reducer": (["pin_circle_radius", "eccentricity"], "min_curvature_radius >= 1 mm"),
    "cam_gear": (["lever.length", "lever.angle"], "max_radius >= 1 mm"),
    "cam_linkage": (["links.coupler", "phase"], "max_pressure_angle <= 89 deg"),
    "linked_cams": (["cams.x.base_radius", "cams.y.base_radius"], "min_curvature_radius[1] >= 1 mm"),
    "geneva_drive": (["center_distance", "pin_radius"], "lip_thickness >= 1 mm"),
    "barrel_cam": (["cam.radius", "follower.roller_radius"], "least_wall_factor >= 0.1"),
    "loaded_cam": (["cam.prime_radius", "follower.roller_radius"], "min_curvature_radius >= 1 mm"),
    "loaded_measured_cam": (["follower.offset", "roller_radius"], "min_curvature_radius >= 1 mm"),
    "gear_pair": (["profile_shift[0]", "profile_shift[1]"], "center_distance >= 1 mm"),
    "ring_pair": (["profile_shift[0]"], "contact_ratio >= 1"),
    "mutilated_gear_press": (["links.crank", "links.rocker"], "rocker_swing >= 1 deg"),
    "hypocycloid_slider": (["rod.length"], "dwell_ripple <= 9 mm"),
    "wide_swing_slider": (["slider.crank", "slider.rod"], "force >= 1 N"),
    "ty460": (["bed.rod", "cylinder.double_crank.crank"], "sync_end >= 1 deg"),
    "drawn_feed": (["links.crank", "gears.profile_shift[0]"], "min_transmission_angle >= 1 deg"),
    "two_gear_drag_link": (["links.coupler", "links.frame"], "back_step_angle <= 90 deg"),
    "swing_gripper": (["links.input", "pivots.output[0]"], "min_transmission_angle[0] >= 1 deg"),
    "geared_six_bar": (["links.output", "links.frame"], "min_transmission_angle >= 1 deg"),
    "planar_watt": (["links.crank[2]", "frame.D[0]"], "output.swing >= 1 deg"),
    "sheet_feeder": (["members.forwarder.phase", "members.lays.design.cam.prime_radius"], "lays.max_radius >= 1 mm"),
}

QUICK = {"two_gear_standing", "ty460_slider_crank", "mutilated_gear_press"}

PAIR = {
    "kind": "gear-pair",
    "module": 2.5,
    "teeth": [26, 53],
    "center_distance": 100.0,
    "shift_split": "sliding",
    "allowances": {"upper": [-0.1, -0.1], "lower": [-0.15, -0.15]},
}


@pytest.mark.parametrize("more", [{}, {"tip_shortening": "none"}, {"shift_split": 0.4}])
def test_gears_are_cut_once_whatever_their_distance(more: dict[str, Any]) -> None:
    """Backlash rises by 2 tan(alpha_wt) of what the axes stand apart, as between two racks; it had stayed the same."""
    source = {"center_distance": {"plus_minus": 0.02}}
    made = factory.design({**PAIR, **more}, command="tolerance", tolerance={"sources": source, "samples": 16})
    base = made.problem.base
    near, nominal, far = (base.design([("center_distance", 100.0 + step)]) for step in (-0.02, 0.0, 0.02))
    assert near.profile_shift == nominal.profile_shift == far.profile_shift
    assert near.tip_radius == pytest.approx(nominal.tip_radius, rel=1e-15)
    assert nominal.profile_shift == pytest.approx(
        factory.design({**PAIR, **more}, command="gear").profile_shift, abs=1e-15
    )
    angle = nominal.gear_pair.working_pressure_angle
    for one, other in ((near, nominal), (nominal, far)):
        rises = [b - a for a, b in zip(one.backlash_circumferential, other.backlash_circumferential, strict=True)]
        assert rises == pytest.approx([2.0 * math.tan(angle) * 0.02] * 2, rel=1e-2)
    assert far.contact_ratio < nominal.contact_ratio < near.contact_ratio


def study(name: str, **section: Any) -> Any:
    return factory.design(name, command="tolerance", tolerance=section)


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    "name", [name if name in QUICK else pytest.param(name, marks=pytest.mark.slow) for name in STUDIES]
)
def test_samples_spread_as_the_slopes_say_and_are_the_same_from_their_text(name: str) -> None:
    keys, requirement = STUDIES[name]
    made = study(name, sources=dict.fromkeys(keys, NARROW), require=[requirement], samples=64)
    quantity = made.problem.requirements[0].expression.text
    row = made.result.spreads[quantity]
    slopes = made.slopes[quantity]
    assert made.result.missing == 0.0
    if not any(slope.kink for slope in slopes):
        assert row.sigma.value == pytest.approx(math.hypot(*(slope.sigma for slope in slopes)), rel=0.2)
    here, there = (judged_replication(one, 3) for one in (made.problem, problem_of(text_of(made.problem))))
    assert here.quantities[quantity].tolist() == there.quantities[quantity].tolist()
    assert {code: mask.tolist() for code, mask in here.passes.items()} == {
        code: mask.tolist() for code, mask in there.passes.items()
    }


def test_every_kind_that_has_the_command_is_tried() -> None:
    tried = {factory.worked(name)["kind"] for name in STUDIES}
    assert tried == {name for name, kind in KINDS.items() if "tolerance" in kind.commands}


@pytest.mark.slow
def test_a_search_is_done_once_and_its_function_goes_on_judging() -> None:
    """The found links scatter: the error of the search itself, below 0.0002 deg, grows to some thousandths."""
    sources = {key: {"plus_minus": 0.02} for key in ("links.coupler", "links.frame")}
    made = study("five_bar_function", sources=sources, samples=16)
    nominal = made.problem.nominal
    assert nominal.spec.target.function.links == "given"
    searched = factory.design("five_bar_function").structural_error
    assert nominal.structural_error == pytest.approx(searched, rel=1e-8)  # 3e-6 rad, of angles that end at 1e-16
    assert math.degrees(searched) < 0.0002
    assert made.result.spreads["structural_error"].mean.value > 0.001


@pytest.mark.slow
def test_a_rule_is_followed_once() -> None:
    """The rod of the tangent circle is 140 mm; made shorter, it is not sized anew."""
    made = study("hypocycloid_slider", sources={"rod.length": {"measured": 139.9}}, samples=16)
    assert made.result.spreads["rod_length"].mean.value == pytest.approx(139.9, abs=1e-12)
    assert made.nominal == {}


@pytest.mark.slow
def test_cams_are_placed_once() -> None:
    """Arms that turn out longer run on the cams that were made."""
    cam: dict[str, Any] = {"cam__center": None, "size": {"pressure_angle": 28}}
    sized = factory.design("swing_gripper", command="cam", **cam)
    sources = {"cam.roller.arm": {"measured": 160.1}}
    made = factory.design("swing_gripper", command="tolerance", **cam, tolerance={"sources": sources, "samples": 16})
    assert made.problem.nominal.cam_center == sized.cam_center
    assert made.problem.nominal.spec.size is None


def test_what_counts_in_a_register_alone_makes_no_samples() -> None:
    with pytest.raises(Exception, match="counts in `register` alone") as found:
        study("ty460", sources={"pins.A": {"clearance": [0.0, 0.02]}}, samples=16).raw("yield")
    assert found.value.faults[0].code == "GL170"


def test_a_measured_size_that_no_design_has_is_refused() -> None:
    with pytest.raises(Exception, match="greater than 0") as found:
        study("ty460_slider_crank", sources={"rod": {"measured": -3.0}}, samples=16).raw("yield")
    assert found.value.faults[0].place == ("tolerance", "sources", "rod")


def test_a_command_that_the_file_has_nothing_for_is_refused_at_its_key() -> None:
    with pytest.raises(NoSolution) as found:
        study("candy_feed_tolerances", sources={"links.crank": NARROW}, command="synth back-step").raw("yield")
    assert found.value.key == "tolerance.command"


def test_a_share_of_missing_designs_is_counted() -> None:
    """A slider-crank whose rod is hardly longer than crank and offset: some designs as manufactured do not turn."""
    data = {"kind": "slider-crank", "name": "short", "crank": 40.0, "rod": 50.2, "offset": 10.0}
    section = {"sources": {"rod": {"plus_minus": 0.3}}, "samples": 64}
    made = factory.design(data, command="tolerance", tolerance=section)
    # rod < 50 is 2 sigma below: 2.3 %, of 64 scrambled points one or two
    assert 0.0 < made.no_mechanism < 0.08
    assert made.raw("yield") <= 1.0 - made.no_mechanism
    assert np.isfinite(made.result.spreads["stroke"].mean.value)


@pytest.mark.slow
def test_cams_that_a_section_brings_are_judged_as_made() -> None:
    """A shaft hardly thinner than the cam's room for it: `press` does not look at it, `analyze` does."""
    room = factory.design("ty460").quantity("min_radius").value
    keys = {"sources": {"cam.shaft_radius": {"plus_minus": 3.0}}, "samples": 16, "command": "analyze"}
    keys["require"] = ["crank_length >= 1 mm"]
    tight = factory.design("ty460", command="tolerance", cam__shaft_radius=room, tolerance=keys)
    assert 0.2 < tight.raw("yield") < 0.8
    assert "shaft-clearance" in tight.outline("tolerance").checks
