"""Loads at the edge of what a file may say: they end with a place and a remedy, and take neither memory nor time."""

from __future__ import annotations

import math
from typing import Any

import factory
import numpy as np
import pytest
from pydantic import ValidationError

from gearlink.core.base.errors import GearlinkError
from gearlink.core.studies.loads import sources
from gearlink.core.studies.loads.spec import Course

FEED = "loaded_feed"


def _value_of_zones(zones: list[tuple[float, float, float]], phi: float) -> float:
    """The definition: each zone from its start up to its end, through 360 deg where the end lies below."""
    turn, total = 2.0 * math.pi, 0.0
    for start, end, value in zones:
        width = math.radians(end - start) % turn or (turn if start != end else 0.0)
        total += value if math.fmod(math.fmod(phi - math.radians(start), turn) + turn, turn) < width else 0.0
    return total


def test_zones_add_and_pass_through_the_turn() -> None:
    rng = np.random.default_rng(3)
    ends = [tuple(float(x) for x in pair) for pair in rng.integers(-7, 8, (12, 2)) * 45.0 + rng.uniform(-0.1, 0.1)]
    zones = [(start, end, float(k + 1)) for k, (start, end) in enumerate(ends)]
    course = Course.model_validate({"zones": [{"from": a, "to": b, "value": v} for a, b, v in zones]})
    phi = rng.uniform(-10.0, 20.0, 400)
    assert sources.values(course, phi).tolist() == [_value_of_zones(zones, float(x)) for x in phi]


def test_zone_holds_from_its_start_up_to_its_end() -> None:
    course = Course.model_validate({"zones": [{"from": 34, "to": 154, "value": 3}]})
    places = np.radians([34.0, 154.0]) + 2.0 * math.pi * np.arange(4)[:, None]
    assert sources.values(course, places[:, 0]).tolist() == [3.0] * 4
    assert sources.values(course, places[:, 1]).tolist() == [0.0] * 4


def test_blocks_of_rows_are_solved_alike() -> None:
    """Systems are solved a block of rows at a time; what a row gets does not depend on the others."""
    machine = factory.design(FEED, command="loads").machine
    phi = np.linspace(0.0, 6.0, 5000)
    whole, few = machine.reactions(phi), machine.reactions(phi[::500])
    for name, values in few.unknowns.items():
        assert np.array_equal(whole.unknowns[name][:, ::500], values)


@pytest.mark.slow
def test_long_arrays_are_not_kept() -> None:
    machine = factory.design(FEED, command="loads").machine
    for start in range(6):
        machine.at(np.linspace(start, start + 1.0, 60_000))
    assert sum(len(key[1]) // 8 for key in machine.kept) <= 200_000


@pytest.mark.quick(4)
@pytest.mark.parametrize(
    ("keys", "place"),
    [
        ({"loads__vibration__frequency": 1e7}, "loads.vibration.frequency"),
        ({"loads__vibration__frequency": 1e-300}, "loads.vibration.frequency"),
        ({"loads__vibration": {"stiffness": 1e12}}, "loads.vibration.stiffness"),
        ({"loads__speed": 1e-300}, "loads.speed"),
        ({"loads__speed": 0.0}, "loads.speed"),
        ({"loads__forces": [{"on": "nobody", "torque": 1}]}, "loads.forces[0].on"),
    ],
)
def test_refused_with_the_key(keys: dict[str, Any], place: str) -> None:
    with pytest.raises(GearlinkError) as caught:
        factory.design(FEED, command="loads", **keys).report("loads")
    assert caught.value.key == place


@pytest.mark.parametrize(
    "keys",
    [
        {"loads__links__crank__mass": -1.0},
        {"loads__links__output__inertia": -1e-9},
        {"loads__motor__slope": 0.0},
        {"loads__forces": [{"on": "output", "torque": {"zones": []}}]},
        {"loads__forces": [{"on": "output", "torque": {"table": [[0, 1], [90, 2], [45, 3]]}}]},
    ],
)
def test_refused_by_the_section(keys: dict[str, Any]) -> None:
    with pytest.raises(ValidationError):
        factory.design(FEED, command="loads", **keys)


@pytest.mark.slow
def test_wide_swing_refuses_such_a_frequency_too() -> None:
    with pytest.raises(GearlinkError, match="6e\\+05 times") as caught:
        factory.design("loaded_wide_swing", command="loads", loads__vibration__frequency=1e6).report("loads")
    assert caught.value.key == "loads.vibration.frequency"


def test_friction_that_vanishes_in_rounding_is_none() -> None:
    data = {"kind": "slider-crank", "stroke": 310.0, "rod": 520.0, "offset": 50.0, "input_speed": 60.0}
    section = {"links": {"rod": {"mass": 12.0}}, "forces": [{"on": "slider", "resistance": 200.0}]}
    found = [
        factory.design(data | {"loads": section | extra}, command="loads").table("torque", samples=36)
        for extra in ({"friction": {"pins": 1e-17, "pin_radius": 8}}, {})
    ]
    assert list(found[0]["input_torque"]) == pytest.approx(list(found[1]["input_torque"]), rel=1e-12)


def test_a_roller_that_leaves_its_cam_is_driven_by_nothing(gearlink: Any, designs: Any) -> None:
    made = factory.design("loaded_gripper", command="loads", spring__torque=180)
    assert made.traction_needed[0] is None
    (skid,) = [check for check in made.check("roller-skid") if check.code == "GL609" and check.status == "warn"]
    assert "leaves its cam" in skid.message
    alone = gearlink(
        "loads", designs / "loaded_gripper.yaml", "--set", "spring.torque=180", "--quantity", "traction_needed"
    )
    assert alone.out.startswith("- 0.")


@pytest.mark.quick(2)
@pytest.mark.parametrize(
    ("base", "section", "key"),
    [
        ("loaded_six_bar", {"friction": {"joints": {"gear_1B": 0.1}}}, "loads.friction.joints.gear_1B"),
        (
            "loaded_six_bar",
            {"bearings": {"gear_2C": {"kind": "ball", "dynamic_rating": 1e4}}},
            "loads.bearings.gear_2C",
        ),
        ("loaded_feed", {"backlash": {"mesh_25": 0.1}}, "loads.backlash.mesh_25"),
        (
            "loaded_press",
            {"cylinder_direction": None, "bearings": {"N": {"kind": "ball", "dynamic_rating": 1e4}}},
            "loads.bearings.N",
        ),
    ],
)
def test_what_would_have_no_effect_is_refused(base: str, section: dict[str, Any], key: str) -> None:
    """A joint of the kind that this design has not, and a bearing whose force the file leaves open."""
    loads = factory.design(base, command="loads", **{f"loads__{name}": value for name, value in section.items()})
    with pytest.raises(GearlinkError) as refused:
        loads.report("loads")
    assert refused.value.key == key


@pytest.mark.parametrize(
    ("base", "section", "check"),
    [
        ("loaded_six_bar", {"vibration": {"frequency": 60, "allowed_residual": 0.1}}, "residual-vibration"),
        ("loaded_press", {"roller": None}, "contact-pressure"),
        ("loaded_wide_swing", {"roller": None, "material": {"allowed_pressure": 500}}, "contact-pressure"),
    ],
)
def test_a_limit_that_nothing_is_held_against_is_told(base: str, section: dict[str, Any], check: str) -> None:
    """No dwell, or no width: a warning without a value."""
    loads = factory.design(base, command="loads", **{f"loads__{name}": value for name, value in section.items()})
    (found,) = loads.check(check)
    assert (found.status, found.value) == ("warn", None)


def test_a_torque_that_turns_at_the_start_of_the_period_is_looked_at_from_both_sides() -> None:
    """The law of a gripper has no angles below 0; what stands there is the end of the turn."""
    loads = {"forces": [{"on": "input", "resistance": 1e6}]}
    design = factory.design("swing_gripper", command="loads", loads=loads)
    torque = design.machine.torque(np.linspace(0.0, 2.0 * np.pi, 4001)[1:-1])
    moving = np.sign(torque[np.abs(torque) > 1e-9 * np.abs(torque).max()])
    assert design.raw("torque_reversals") == np.count_nonzero(np.diff(moving)) + (moving[0] != moving[-1])


@pytest.mark.slow
def test_an_unbalanced_wheel_that_turns_evenly_needs_no_torque() -> None:
    """Reactions of 1e13 N m leave some rounding in a torque of 0: no fault of either way."""
    links = {"gear1": {"mass": 1e9, "inertia": 0.5, "center": [1e6, 1e6]}}
    design = factory.design("gear_pair", command="loads", loads={"speed": 1, "links": links})
    (found,) = design.check("power-identity")
    assert found.status == "pass"


def test_a_direction_of_what_is_not_there_is_refused() -> None:
    with pytest.raises(GearlinkError, match="has no slider") as caught:
        factory.design("wide_swing_twin_cam", command="loads", loads={"slider_direction": 5}).report("loads")
    assert caught.value.key == "loads.slider_direction"
    bearings = {"D": {"kind": "ball", "dynamic_rating": 1e4}}
    with pytest.raises(GearlinkError) as caught:
        factory.design("wide_swing_cycle", command="loads", loads={"bearings": bearings}).report("loads")
    assert str(caught.value).endswith("give loads.device_direction")


@pytest.mark.parametrize("base", ["swing_gripper", "wide_swing_twin_cam"])
def test_the_section_that_a_missing_one_is_asked_for_is_one(base: str) -> None:
    """Kinds with a speed of their own are not told to write loads.speed."""
    with pytest.raises(GearlinkError, match=r"loads: \{roller") as caught:
        factory.design(base, command="loads").report("loads")
    assert caught.value.key == "loads"
    factory.design(base, command="loads", loads={"roller": {"width": 20}}).raw("input_torque_max")


@pytest.mark.parametrize(
    ("friction", "key"),
    [
        ({"joints": {"mesh_13": 0.0}}, "loads.friction.joints.mesh_13"),
        ({"joints": {"A": 1.0}, "pin_radius": 8}, "loads.friction.joints.A"),
        ({"pins": 0.1}, "loads.friction"),
        ({"joints": {"A": 0.1}}, "loads.friction"),
    ],
)
def test_coefficients_that_no_joint_has_are_refused(friction: dict[str, Any], key: str) -> None:
    with pytest.raises(GearlinkError) as caught:
        factory.design(FEED, command="loads", loads__friction=friction).raw("input_torque_max")
    assert caught.value.key == key


def test_a_mesh_by_name_may_lose_nothing() -> None:
    free, whole = (
        factory.design(FEED, command="loads", loads__friction=friction).raw("input_torque_max")
        for friction in ({"meshes": 1.0}, {"meshes": 0.9, "joints": {"mesh_13": 1.0, "mesh_35": 1.0}})
    )
    assert whole == pytest.approx(free, rel=1e-12)


def test_a_follower_that_stands_vibrates_not() -> None:
    """What is left of its motion was divided by a lift of 0."""
    made = factory.design("loaded_cam", command="loads", motion=[{"to": 100, "lift": 0}, {"to": 360, "lift": 0}])
    assert [check.status for check in made.check("rigid-model")] == ["pass"]


def test_a_mutilated_wheel_out_of_balance_is_refused() -> None:
    """Neither its weight nor its force on W is in any result; on its axis the mass adds nothing to the inertia."""
    loads: dict[str, Any] = {"speed": 60, "links": {"rocker": {"mass": 1.5, "inertia": 0.01}}}

    def made(wheel: dict[str, Any]) -> Any:
        links = {**loads["links"], "wheel": wheel}
        return factory.design("mutilated_gear_press", command="loads", loads={**loads, "links": links})

    balanced = made({"mass": 3.0, "inertia": 0.02, "center": [0.0, 0.0]})
    assert balanced.reflected_inertia_max == made({"inertia": 0.02}).reflected_inertia_max
    with pytest.raises(GearlinkError) as caught:
        made({"mass": 3.0, "inertia": 0.02, "center": [10.0, 0.0]}).report("loads")
    assert caught.value.key == "loads.links.wheel.center"
