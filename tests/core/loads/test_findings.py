"""Findings of loads that no example has: where each begins, and the number that its message names."""

from __future__ import annotations

import math
import re
from types import SimpleNamespace
from typing import Any

import factory
import pytest

from gearlink.core.studies.loads import checks
from gearlink.core.studies.loads.cams import CamLoadsDesign

FEED = "loaded_feed"


def found(name: str, base: str = FEED, **keys: Any) -> Any:
    (check,) = factory.design(base, command="loads", **keys).check(name)
    return check


def test_a_bearing_of_the_rating_that_is_named_lives_long_enough() -> None:
    """And one of a hundredth less does not: the rating is rounded up to four digits."""
    short = found("bearing-life", loads__bearings__C__dynamic_rating=900)
    assert (short.code, short.status, short.limit, short.unit) == ("GL606", "fail", 20_000, "h")
    named = float(re.findall(r"dynamic rating of ([\d.]+) N", short.fix)[0])
    long = found("bearing-life", loads__bearings__C__dynamic_rating=named)
    assert 20_000 <= long.value < 20_000 * 1.02
    assert long.status == "warn", "little above what is wanted"
    assert found("bearing-life", loads__bearings__C__dynamic_rating=0.99 * named).status == "fail"


@pytest.mark.parametrize(("frequency", "status"), [(6.12, "warn"), (7.2, "pass")])
def test_a_resonance_is_one_over_whatever_turns_the_period_has(frequency: float, status: str) -> None:
    """An idler out of balance makes the period nine turns: of its harmonics only every ninth is one of the motion."""
    vibration = {"frequency": frequency, "damping": 0.01}
    plain = found("resonance", loads__vibration=vibration)
    heavy = found("resonance", loads__vibration=vibration, loads__links__idler__center=[3, 0])
    assert (plain.status, heavy.status) == (status, status)
    assert status == "pass" or (
        heavy.value == pytest.approx(plain.value, rel=1e-12)
        and "distance of harmonic 27 over 9 revolutions from the natural frequency" in heavy.message
    )


def test_a_bearing_beside_helical_teeth_is_told_their_axial_force() -> None:
    """400 N m at r = 69.28 mm push with 5773.5 N, 3333.3 N along the axis at 30 deg; spur gears with nothing."""
    bearing = {"kind": "ball", "dynamic_rating": 2e5, "life": 1000}
    loads = {"speed": 1000, "forces": [{"on": "gear2", "torque": -400}], "bearings": {"gear2": bearing}}
    pair = {"kind": "gear-pair", "module": 3, "teeth": [20, 40], "profile_shift": [0, 0], "loads": loads}
    helical = factory.design({**pair, "helix_angle": 30}, command="loads").check("bearing-life")
    assert [check.status for check in helical] == ["warn", "pass"]
    assert helical[0].value == pytest.approx(400e3 / 69.282032 * math.tan(math.radians(30)), rel=1e-6)
    spur = factory.design(pair, command="loads").check("bearing-life")
    assert [check.status for check in spur] == ["pass"]
    teeth = {"gears__helix_angle": 12, "gears__face_width": 20, "gears__profile_shift": [0, 0, 0]}
    feed = factory.design(FEED, command="loads", **teeth, links__crank=38.857, links__frame=157)
    assert [check.status for check in feed.check("bearing-life")] == ["warn", "pass"]


def test_a_bearing_that_hardly_swings_has_no_life() -> None:
    """Rolling bodies are to change places: 720 deg over their number, 20 deg where none is given."""

    def swinging(swing: float, bodies: int | None, kind: str = "needle") -> list[tuple[str, float, float]]:
        bearing = SimpleNamespace(kind=kind, rolling_bodies=bodies, life=None)
        pin = SimpleNamespace(bearing=bearing, life=None, swing=math.radians(swing))
        design = SimpleNamespace(section=SimpleNamespace(bearings={"C": bearing}), borne_by={"C": pin}.get)
        return [(each.status, each.value, each.limit) for each in checks.bearing_life(design)]

    assert swinging(29.0, 24) == [("warn", pytest.approx(29.0, rel=1e-12), 30.0)]
    assert swinging(31.0, 24) == []
    assert swinging(19.0, None) == [("warn", pytest.approx(19.0, rel=1e-12), 20.0)]
    assert swinging(1.0, 24, kind="plain") == []


@pytest.mark.parametrize(
    ("frequency", "off", "status"), [(6.5, 1.0 / 12.0, "warn"), (6.7, 0.7 / 6.0, "pass"), (5.9, 1.0 / 60.0, "warn")]
)
def test_a_harmonic_near_the_natural_frequency_is_a_resonance(frequency: float, off: float, status: str) -> None:
    """At 120 1/min the harmonics are the even numbers of hertz, here the third; nearer than a tenth counts."""
    check = found("resonance", loads__vibration={"frequency": frequency, "damping": 0.01, "allowed_residual": 2})
    assert (check.code, check.status, check.limit) == ("GL611", status, 0.1)
    assert check.value == pytest.approx(off, abs=1e-12)
    assert "distance of harmonic 3 from the natural frequency" in check.message


def test_without_damping_a_resonance_has_no_limit() -> None:
    check = found("resonance", loads__vibration={"frequency": 26, "damping": 0, "allowed_residual": 2})
    assert (check.code, check.status) == ("GL611", "fail")
    assert check.value < 1e-12
    assert "distance of harmonic 13 from the natural frequency, resonance without damping" in check.message


@pytest.mark.parametrize(
    ("base", "mass", "unit"),
    [
        ("ty460_slider_crank", {"slider": {"mass": 240}}, "mm"),
        ("loaded_six_bar", {"output": {"inertia": 0.004}}, "deg"),
    ],
)
def test_a_vibration_that_nothing_is_held_against_has_its_unit(base: str, mass: Any, unit: str) -> None:
    vibration = {"frequency": 60, "allowed_residual": 0.1}
    loads = {"links": mass, "vibration": vibration} | ({"speed": 75} if unit == "mm" else {})
    check = found("residual-vibration", base, loads=loads)
    assert (check.status, check.value, check.limit, check.unit) == ("warn", None, 0.1, unit)


@pytest.mark.parametrize(("frequency", "status"), [(19.9, "warn"), (20.1, "pass")])
def test_links_count_as_rigid_from_ten_times_the_input_on(frequency: float, status: str) -> None:
    check = found("rigid-model", loads__vibration={"frequency": frequency, "damping": 0.05})
    assert (check.code, check.status, check.limit) == ("GL605", status, 10.0)
    assert check.value == pytest.approx(frequency / 2.0, rel=1e-12)


def test_a_natural_frequency_at_the_limit_itself_passes() -> None:
    """60 Hz over 120 revolutions a minute are 30: by way of rad/s a rounding was missing, and the check warned."""
    check = found("rigid-model", limits={"frequency_ratio": 30}, loads__vibration={"frequency": 60, "damping": 0.05})
    assert (check.status, check.value, check.limit) == ("pass", 30.0, 30.0)
    ratios = {"loaded_gripper": 110 * 3600 / 12000, "loaded_oscillating_cam": 60.0, "loaded_six_bar": 30.0}
    for name, ratio in ratios.items():
        made = factory.design(name, command="loads")
        assert made.frequency_ratio == ratio
        assert made.natural_frequency == made.section.vibration.frequency


@pytest.mark.parametrize(("angle", "status"), [(11.53, "warn"), (11.55, "pass"), (90.0, "pass")])
def test_forces_grow_as_one_over_the_sine_of_the_transmission_angle(angle: float, status: str) -> None:
    """Five times those at a right angle are too much: arcsin(1/5) = 11.537 deg."""
    (check,) = checks.force_amplification(SimpleNamespace(transmission_angle=math.radians(angle)))
    assert (check.code, check.status, check.limit) == ("GL612", status, 5.0)
    assert check.value == pytest.approx(1.0 / math.sin(math.radians(angle)), rel=1e-12)
    assert list(checks.force_amplification(SimpleNamespace(transmission_angle=None))) == []


@pytest.mark.parametrize(("given", "status"), [(1233.0, "warn"), (1234.6, "pass")])
def test_a_preload_holds_both_rollers_or_says_what_would(given: float, status: str) -> None:
    roller = SimpleNamespace(preload=given)
    design = SimpleNamespace(preload_needed=1234.56, section=SimpleNamespace(roller=roller))
    (check,) = CamLoadsDesign.check_preload(design)
    assert (check.code, check.status, check.value, check.limit) == ("GL613", status, given, 1234.56)
    assert (check.fix == "set loads.roller.preload to 1235") == (status == "warn")
    roller.preload = None
    assert list(CamLoadsDesign.check_preload(design)) == []


def test_a_jump_of_speed_is_an_impact() -> None:
    (check,) = checks.impact(SimpleNamespace(engagement_energy=3.25))
    assert (check.code, check.status, check.value, check.unit) == ("GL614", "warn", 3.25, "J")
    assert list(checks.impact(SimpleNamespace())) == []


@pytest.mark.parametrize(("most", "status"), [(1.9, "fail"), (2.05, "warn"), (2.5, "pass")])
def test_a_motor_that_a_load_drives_brakes_with_what_it_may_give(most: float, status: str) -> None:
    """6 N m that drive the input, at a ratio of 3: 2 N m at the motor, against its turning."""
    pair = {"kind": "gear-pair", "module": 2, "teeth": [30, 30], "profile_shift": [0, 0]}
    motor = {"no_load_speed": 1500, "slope": 0.5, "ratio": 3, "max_torque": most}
    links = {"gear1": {"inertia": 0.01}}
    loads = {"speed": 500, "links": links, "forces": [{"on": "gear1", "torque": 6.0}], "motor": motor}
    design = factory.design({**pair, "loads": loads}, command="loads")
    (peak,) = design.check("motor-torque")
    assert (peak.status, peak.value) == (status, pytest.approx(2.0, rel=1e-9))
    assert design.motor_torque_peak == pytest.approx(-2.0, rel=1e-9)
    assert "peak torque of the motor" in peak.message


@pytest.mark.parametrize(("ratio", "status"), [(12, "pass"), (11.5, "warn"), (11, "fail"), (14, "fail"), (1, "fail")])
def test_a_motor_runs_the_machine_at_the_speed_at_which_its_forces_are_computed(ratio: float, status: str) -> None:
    """1500/12 less the slip are 122.7 1/min beside 120; a ratio that was left out is 1, twelve times as fast."""
    motor = {"no_load_speed": 1500, "slope": 0.5, "ratio": ratio}
    check = found("motor-speed", loads__motor=motor, loads__flywheel={"inertia": 20.0})
    assert (check.code, check.status) == ("GL603", status)
    slip = 18.0 / (0.5 * ratio**2) * 30.0 / math.pi
    assert check.value == pytest.approx(abs((1500.0 / ratio - slip) / 120.0 - 1.0), rel=1e-2, abs=2e-3)


@pytest.mark.parametrize(
    ("torque", "application", "status"), [(40, 1.0, "pass"), (41, 1.0, "warn"), (41, 1.25, "pass")]
)
def test_teeth_are_rated_for_what_they_carry(torque: float, application: float, status: str) -> None:
    """The output of the lever is rated for 40 N m; on shifted teeth the force at the pitch circle is less."""
    load = {"torque": 40, "gear": "output", "factors": {"application": application}}
    forces = [{"on": "output", "torque": -float(torque)}]
    design = factory.design("drawn_lever", command="loads", gears__load=load, loads={"speed": 60, "forces": forces})
    (check,) = design.check("tooth-load")
    assert (check.code, check.status) == ("GL616", status)
    radius = design.design.mesh.working_radius[1]
    assert check.value == pytest.approx(1e3 * torque / radius, rel=1e-12)
    assert check.limit == pytest.approx(1e3 * 40 * application / radius, rel=1e-12)


@pytest.mark.parametrize(("back", "status"), [(0.0, "pass"), (20.0, "warn"), (40.0, "warn")])
def test_teeth_that_are_bent_both_ways_need_a_higher_rating(back: float, status: str) -> None:
    """A load that turns round fully is as one of 1/0.7, with which idlers are rated; half of it back as 1 + 3/14."""
    load = {"torque": 41, "gear": "output"}
    zones = [{"from": 0, "to": 180, "value": -40.0}, {"from": 180, "to": 360, "value": back}]
    forces = [{"on": "output", "torque": {"zones": zones}}]
    design = factory.design("drawn_lever", command="loads", gears__load=load, loads={"speed": 60, "forces": forces})
    (check,) = design.check("tooth-load")
    radius = design.design.mesh.working_radius[1]
    assert (check.status, "opposite flanks" in check.message) == (status, back > 0.0)
    assert check.value == pytest.approx(1e3 * (40.0 + 3.0 / 7.0 * back) / radius, rel=1e-12)
    if back == 40.0:
        assert check.value == pytest.approx(1e3 * 40.0 / (0.7 * radius), rel=1e-12)


def test_every_mesh_of_a_train_is_held_against_its_rating() -> None:
    rated = {"gears__face_width": 20, "gears__load": {"torque": 18, "gear": "output"}}
    both = factory.design(FEED, command="loads", **rated).check("tooth-load")
    assert [check.message.partition(":")[0] for check in both] == ["mesh_13", "mesh_35"]
    assert {check.status for check in both} == {"warn"}, "masses add to the 18 N m that the output takes"
    assert factory.design(FEED, command="loads").check("tooth-load") == []


@pytest.mark.slow
@pytest.mark.parametrize(("loads", "status"), [({}, "fail"), ({"backlash": 0.0}, "warn"), ({"backlash": 0.05}, "fail")])
def test_play_that_the_drawing_of_the_gears_leaves_counts_in_a_dwell(loads: dict[str, Any], status: str) -> None:
    """Without a load the teeth change flanks in the middle of the dwell; 25cd leaves play, unless loads say none."""
    masses = {"links": {"output": {"inertia": 0.05}}, "speed": 400, **loads}
    keys = {"dwell_tolerance": 1.0, "loads": masses}
    design = factory.design("drawn_feed", command="loads", **keys)
    assert {check.status for check in design.check("load-reversal")} == {status}
    plain = factory.design("drawn_feed", command="loads", **keys, gears__allowances=None)
    assert {check.status for check in plain.check("load-reversal")} == {"fail" if loads.get("backlash") else "warn"}


# A press: its input gears are the ones that the file draws and rates

GEARS = {"module": 4, "horizontal_distance": 290, "pressure_angle": 20}


def pressed(gears: dict[str, Any], **loads: Any) -> Any:
    return factory.design("loaded_press", command="loads", input_gears={**GEARS, **gears}, **loads)


@pytest.mark.slow
def test_input_gears_of_a_press_are_held_against_their_rating() -> None:
    """Rated for 20 N m they carried 374 N m without a word; rated for that, K_A 1.1 for the other flanks, they pass."""
    weak = pressed({"load": {"torque": 20}, "face_width": 20})
    (check,) = weak.check("tooth-load")
    assert (check.code, check.status, check.message.partition(":")[0]) == ("GL616", "warn", "mesh_12")
    radius = weak.design.gear_pair.working_radius[0]
    assert check.limit == pytest.approx(20e3 / radius, rel=1e-12)
    torque = check.value * radius / 1e3
    strong = pressed({"load": {"torque": torque * 1.001}, "face_width": 20})
    assert [each.status for each in strong.check("tooth-load")] == ["pass"]


@pytest.mark.slow
def test_drawn_play_of_a_press_counts_in_its_zone() -> None:
    """A print that ends in the zone lets the input gears change flanks there; 25cd leaves play."""
    print_ = {"on": "cylinder", "torque": {"zones": [{"from": 34, "to": 150, "value": -120}]}}
    forces = {"loads__forces": [{"on": "bed", "resistance": 350}, print_]}
    statuses = [
        next(each.status for each in pressed(gears, **forces).check("load-reversal") if "mesh_12" in each.message)
        for gears in ({}, {"allowances": {"series": "25cd"}})
    ]
    assert statuses == ["warn", "fail"]


@pytest.mark.slow
def test_helical_input_gears_push_on_their_own_bearings_alone() -> None:
    bearing = {"kind": "roller", "dynamic_rating": 300000, "life": 1000}
    teeth = {"helix_angle": 20, "face_width": 60}
    found = pressed(teeth, loads__bearings={"A": bearing, "C": bearing}).check("bearing-life")
    assert [(each.status, each.message.partition("bearing of ")[2][0]) for each in found] == [
        ("warn", "A"),
        ("pass", "A"),
        ("pass", "C"),
    ]


# Limits that allow what physics does not


@pytest.mark.parametrize(("most", "status"), [(10.0, "warn"), (100.0, "pass"), (1.0, "fail")])
def test_a_margin_below_1_does_not_make_a_motor_stronger(most: float, status: str) -> None:
    motor = {"no_load_speed": 125, "slope": 23.2, "max_torque": most}  # 22.26 N m are needed
    design = factory.design("loaded_feed", command="loads", loads__motor=motor, limits={"torque_margin": 0.05})
    (check,) = design.check("motor-torque")
    assert (check.status, "recommended" in check.message) == (status, status == "warn")


def test_a_natural_frequency_below_the_input_is_never_rigid() -> None:
    vibration = {"frequency": 0.5, "damping": 0.05}
    design = factory.design(
        "loaded_feed", command="loads", loads__vibration=vibration, limits={"frequency_ratio": 1e-6}
    )
    assert [check.status for check in design.check("rigid-model")] == ["warn"]


@pytest.mark.parametrize(("least", "status"), [(1.4, "fail"), (0.1, "warn")])
def test_a_safety_below_1_never_passes(least: float, status: str) -> None:
    gears = {"load": {"torque": 374}, "face_width": 4, "material": {"contact_limit": 1500, "bending_limit": 150}}
    spec = {"kind": "gear-pair", "module": 4, "teeth": [72, 72], "profile_shift": [0, 0], **gears}
    found = factory.design({**spec, "limits": {"safety_bending": least}}, command="gear").check("bending")
    assert {check.status for check in found if 0.1 < check.value < 1.0} == {status}


@pytest.mark.slow
def test_the_lag_is_half_the_play_over_the_radius_of_the_gear_that_is_named() -> None:
    """0.1 mm in the racks, a pinion of 100 mm: 0.05/100 rad, which the pinion lags by."""
    press = factory.design("loaded_press", command="loads", loads__backlash=0.1)
    (found,) = (each for each in press.check("load-reversal") if each.message.startswith("rack_upper"))
    assert "rack_upper: the teeth change flanks 4 times over the period" in found.message


def test_rated_teeth_of_a_mechanism_without_a_mesh_of_its_own() -> None:
    """A cam-gear takes `gears.load`, and has no data of its mesh to be rated by."""
    made = factory.design("loaded_cam_gear", command="loads", gears__load={"tangential_force": 100.0})
    assert checks.rated_forces(made) == {}
