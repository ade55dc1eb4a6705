"""Where a refusal stands, and what it names: the `--set` that changed something, values, units, what is allowed."""

from __future__ import annotations

from typing import Any

import pytest
from factory import DESIGNS


def refusal(gearlink: Any, words: str, *sets: str) -> dict[str, Any]:
    """The one error of a command line on an example, with its keys set."""
    *command, name = words.split()
    changes = [word for each in sets for word in ("--set", each)]
    ended = gearlink(*command, DESIGNS / f"{name}.yaml", *changes, "--format", "json")
    assert ended.status == 2
    (found,) = ended.json["errors"]
    return found  # type: ignore[no-any-return]


@pytest.mark.quick(2)
@pytest.mark.parametrize(
    ("words", "change"),
    [
        ("gripper swing_gripper", "phases.near_dwell=80"),
        ("gripper swing_gripper", "links.coupler=2600"),
        ("press ty460", "bed.double_crank.frame=300"),
        ("analyze five_bar_path", "links.coupler=5"),
        ("synth variable-speed thesis_example_2", "speed.min=400"),
        ("press ty460", "bed.stroke=62"),
    ],
)
def test_what_a_set_has_made_impossible_is_shown_there(gearlink: Any, words: str, change: str) -> None:
    assert refusal(gearlink, words, change)["file"] == "<--set>"


def test_a_set_elsewhere_does_not_take_the_place_of_an_error(gearlink: Any) -> None:
    path = DESIGNS / "swing_gripper.yaml"
    ended = gearlink("gripper", path, "--set", "links.input=140", "--set", "phases.near_dwell=80", "--no-color")
    assert ended.err.startswith("<--set>:1:1: error GL111")
    assert "phases.near_dwell=80" in ended.err
    assert "links.input" not in ended.err


def test_a_set_beside_a_key_whose_refusal_does_not_name_it_leaves_the_file_its_place(
    gearlink: Any, tmp_path: Any
) -> None:
    text = (DESIGNS / "ty460.yaml").read_text().replace("  radius: 140", "  radius: 170")
    path = tmp_path / "press.yaml"
    path.write_text(text)
    ended = gearlink("press", path, "--set", "cylinder.gear_ratio=1.0", "--format", "json")
    (found,) = ended.json["errors"]
    assert (found["file"], found["key"]) == (str(path), "cylinder.initial_crank_angle")


@pytest.mark.parametrize(
    ("words", "change", "message"),
    [
        ("gear gear_pair", "teeth=[72]", "teeth must have exactly 2 entries, [gear 1, gear 2], not 1"),
        ("gear gear_pair", "teeth=72", "teeth must be a list [gear 1, gear 2], such as [25, 40], not 72"),
        ("gripper swing_gripper", "pivots.input=[230]", "exactly 2 entries, [x, y] in mm, not 1"),
        ("gripper swing_gripper", "cam.center=[1]", "exactly 2 entries, [x, y] in mm, not 1"),
        ("gripper swing_gripper", "cam.center=[1, 2, 3]", "exactly 2 entries, [x, y] in mm, not 3"),
        (
            "loads loaded_gripper",
            "loads.roller.stiffness=[1]",
            "exactly 2 entries, [main roller, return roller] in N/mm, not 1",
        ),
        ("loads loaded_feed", "loads.gravity=9.81", "must be a list [x, y] in m/s^2, such as [0, -9.81], not 9.81"),
        ("analyze five_bar_path", "target.points=[[1, 2], [2], [3, 4]]", "exactly 2 entries, [x, y] in mm, not 1"),
        (
            "loads loaded_feed",
            "loads.speed=0",
            "no inertia forces at a speed of 0 1/min",
        ),
        (
            "loads loaded_feed",
            "loads.motor={no_load_speed: 1500, rated_speed: 1600, rated_torque: 5}",
            "rated_speed, 1600 1/min, must lie below no_load_speed, 1500 1/min",
        ),
        (
            "loads loaded_feed",
            "loads.forces=[{on: output, torque: {table: [[0, 1], [30, 1], [20, 2]]}}]",
            "the angles of a table must ascend: table[2] is at 20 deg, after 30 deg",
        ),
        ("swing wide_swing_cycle", "cycle.near_dwell=10", "260 deg (required 360 deg, one revolution of the cam)"),
    ],
)
def test_a_refusal_names_values_units_and_what_is_allowed(gearlink: Any, words: str, change: str, message: str) -> None:
    assert message in refusal(gearlink, words, change)["message"]


@pytest.mark.parametrize("key", ["function", "points", "positions"])
def test_the_help_of_a_key_says_its_name_once(gearlink: Any, key: str) -> None:
    name = "five_bar_path" if key == "points" else "five_bar_function"
    help_ = refusal(gearlink, f"analyze {name}", f"target.{key}=1")["help"]
    assert help_.startswith(f"{key}: ")
    assert not help_.startswith((f"{key}: {key}:", f"{key}: path:", f"{key}: function:"))


def test_a_kind_without_sheets_is_told_which_have_some(gearlink: Any) -> None:
    ended = gearlink("sheet", DESIGNS / "six_bar_two_trains.yaml", "drawing")
    assert "the kinds with sheets are three-gear-four-bar" in " ".join(ended.err.split())


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("synth foo", "`gearlink synth` takes one of dwell, back-step, variable-speed, momentary-dwell"),
        ("laws foo", "give --law NAME; the laws are simple-harmonic, cycloidal"),
        ("laws modified-sine", "give --law modified-sine"),
    ],
)
def test_a_word_that_is_no_command_or_law(gearlink: Any, line: str, words: str) -> None:
    ended = gearlink(*line.split())
    assert ended.status == 2
    assert words in " ".join(ended.err.split())


@pytest.mark.parametrize(
    ("words", "change", "fix"),
    [
        ("cam barrel_cam", "motion[3].to=147", "motion[3].to to 360"),
        ("cam lift_cam", "motion[1].to=350", "motion[1].to to 160"),
        ("cam lift_cam", "motion[3].to=300", "motion[3].to to 360"),
        ("cam lift_cam", "motion[2].lift=4", "motion[2].lift to 0"),
        ("analyze cam_gear", "motion[1].output=300", "motion[1].output to 360"),
        ("analyze planar_cam", "cams.cam.motion[2].lift=3", "cams.cam.motion[2].lift to 0"),
        ("analyze five_bar_positions", "target.positions[2][0]=157.1", "target.positions[2][0] to 100"),
    ],
)
def test_a_motion_out_of_order_is_told_the_value(gearlink: Any, words: str, change: str, fix: str) -> None:
    """They told to count from 0, to add a segment, or nothing; the value is taken as printed."""
    assert refusal(gearlink, words, change)["help"] == f"set {fix}"
    *command, name = words.split()
    key, _, value = fix.partition(" to ")
    repaired = (
        ("--set", f"{key}={value}") if change.startswith(f"{key}=") else ("--set", change, "--set", f"{key}={value}")
    )
    assert gearlink(*command, DESIGNS / f"{name}.yaml", *repaired, "-q").status in (0, 1)
