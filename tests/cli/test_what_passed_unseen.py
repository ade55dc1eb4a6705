"""Designs that once passed, or failed wrongly, with the finding that each must have: status and words, no tolerance."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

_FIVE_BAR = (
    "{kind: geared-five-bar, form: path, gears: {module: 2, input: INPUT, idler: 20, output: OUTPUT}, "
    "links: {input: 15, coupler: 80, follower: 80, output: 15, frame: 70}, phase: 90, coupler_point: {along: 60}, "
    "limits: {transmission_angle: 10}}"
)
_DRAG_LINK = (
    "{kind: three-gear-four-bar, gears: {module: 2, crank: 20, idler: 60, output: 20}, links: {crank: 65, frame: 15}, "
    "shafts: {input_radius: IN, output_radius: OUT}, limits: {transmission_angle: 20}}"
)
_RING = """\
{kind: two-gear-four-bar, gears: {module: 1, planet: 62, ring: 63}, links: {coupler: 1.2, rocker: 1.5, frame: 1.6}}
"""
_TRAINS = """\
kind: gear-train-mobility
links:
  {frame: {pins: [A, E]}, crank: {pins: [A, B]}, coupler: {pins: [B, C]}, follower: {pins: [C, D]},
   output: {pins: [D, E]}}
trains:
  - {module: 2, gears: [{at: A, teeth: 20, fixed_to: crank}, {at: E, teeth: 20, fixed_to: output}]}
  - {module: 2, gears: [{at: A, teeth: 20, fixed_to: crank}, {at: E, teeth: 30, fixed_to: output}]}
"""
_TWIN_ROCKER = """\
{kind: wide-swing-cam, layout: twin-rocker, swing: 126.1, cycle_angle: 49.3, speed: 60, inertia: 0.3,
 unloader: {type: spring, pivot_ratio: 4.1098, stretch_ratio: 0.334, arm: 60},
 cam: {center_distance: 127.3, roller_radius: 8.05}}
"""


@pytest.mark.usefixtures("no_remedies")
@pytest.mark.parametrize(
    ("text", "code", "words"),
    [
        (
            _FIVE_BAR.replace("INPUT", "40").replace("OUTPUT", "40"),
            "GL301",
            "interference of the input gear and the output gear: 14 mm",
        ),
        (
            _FIVE_BAR.replace("INPUT", "80").replace("OUTPUT", "20"),
            "GL301",
            "interference of the input gear and the output gear: 34 mm",
        ),
        (
            _DRAG_LINK.replace("IN,", "2,").replace("OUT", "10"),
            "GL302",
            "overlap of the output gear and the input shaft: 9 mm",
        ),
        (
            _DRAG_LINK.replace("IN,", "2.9,").replace("OUT", "14"),
            "GL302",
            "overlap of the input shaft and the output shaft: 1.9",
        ),
        (_RING, "GL206", "interference of the tip"),
        (_TRAINS, "GL308", "50 mm (by train 1 40 mm between A and E)"),
        (_TWIN_ROCKER, "GL507", "over the stroke: 0.0516"),
    ],
    ids=["idler", "large input", "shaft", "shafts", "ring", "trains", "zone"],
)
def test_a_body_or_a_limit_that_no_check_saw(gearlink: Any, tmp_path: Path, text: str, code: str, words: str) -> None:
    path = tmp_path / "design.yaml"
    path.write_text(text)
    ended = gearlink("check", path, "--format", "json")
    assert ended.status == 1
    assert [f["message"] for f in ended.json["findings"] if f["code"] == code and words in f["message"]]


@pytest.mark.quick(1)
@pytest.mark.parametrize("radius", [70, 74])
def test_a_rocker_without_a_gap_is_judged_to_mid_swing(gearlink: Any, designs: Path, radius: int) -> None:
    line = ("check", designs / "wide_swing_twin_cam.yaml", "--set", f"cam.rocker_radius={radius}", "--format", "json")
    ended = gearlink(*line)
    assert ended.status == 1
    assert any(": 90 deg (limit" in f["message"] for f in ended.json["findings"] if f["code"] == "GL401")


def test_a_lead_in_brings_the_speed_to_the_zone(gearlink: Any, designs: Path) -> None:
    settings = ("--set", "sync.start=50", "--set", "cam.transition_end=145")
    assert gearlink("check", designs / "ty460.yaml", *settings).status == 0


@pytest.mark.quick(3)
@pytest.mark.parametrize("asked_for", ["dwell_tolerance=0.5", "dwell_backlash=0.5"])
@pytest.mark.parametrize("name", ["tolerance_dwell_angle", "acceleration_ratio_max"])
def test_a_synthesis_honours_the_requests_of_an_analysis(
    gearlink: Any, tmp_path: Path, asked_for: str, name: str
) -> None:
    """As `analyze` of the links that it found: both solve the same extremes, links are equal to an ulp."""
    gears = "kind: three-gear-four-bar\ngears: {module: 2, crank: 40, idler: 72, output: 40}\n"
    (tmp_path / "request.yaml").write_text(gears + "dwell: {angle: 90}\n")
    asked = ("--set", asked_for, "--format", "json")
    found = gearlink("synth", "dwell", tmp_path / "request.yaml", *asked).json["quantities"]
    links = {key: found[f"{key}_length"]["value"] for key in ("crank", "frame")}
    (tmp_path / "links.yaml").write_text(f"{gears}links: {links}\n".replace("'", ""))
    again = gearlink("analyze", tmp_path / "links.yaml", *asked).json["quantities"]
    assert found[name]["value"] == pytest.approx(again[name]["value"], rel=1e-12)
    alone = gearlink("synth", "dwell", tmp_path / "request.yaml", "--set", asked_for, "--quantity", name)
    assert alone.status == 0
    assert float(alone.out.split()[0]) == found[name]["value"]


@pytest.mark.parametrize(("frame", "motion", "sign"), [("122.8394", "unidirectional", 1), ("122.84", "back-step", -1)])
def test_a_momentary_dwell_with_a_rounded_frame_still_shows_its_place(
    gearlink: Any, tmp_path: Path, frame: str, motion: str, sign: int
) -> None:
    """Frame 122.83941479 makes the dwell at 275.9429 deg. Rounded, the kind of motion is another, the place is not."""
    path = tmp_path / "rounded.yaml"
    path.write_text(
        "kind: three-gear-four-bar\ngears: {module: 2.5, crank: 20, idler: 20, output: 60}\n"
        f"links: {{crank: 16, frame: {frame}}}\n"
    )
    found = gearlink("analyze", path, "--format", "json").json["quantities"]
    assert found["motion"]["value"] == motion
    assert 0.0 < sign * found["speed_ratio_min"]["value"] < 1e-5
    assert found["speed_ratio_min_at"]["value"] == pytest.approx(275.942, abs=1e-3)
    assert bool(found["dwell_crank_angles"]["value"]) == (motion == "back-step")


def test_a_ratio_above_the_estimate_but_below_the_least_fails(gearlink: Any, tmp_path: Path) -> None:
    """3.17 lies between the estimate of the stretch at 4.43, 3.1583, and the minimum ratio, 3.1923."""
    path = tmp_path / "swing.yaml"
    path.write_text(
        "{kind: wide-swing-cam, layout: twin-cam, swing: 219.9, cycle_angle: 60, speed: 60, inertia: 0.3, unloader: "
        "{type: spring, pivot_ratio: 3.17, arm: 106.8, stretch_ratio: 1.09, closed_length: 51.1, end_fittings: 12.6}, "
        "cam: {center_distance: 500, roller_radius: 8}}"
    )
    ended = gearlink("swing", path)
    assert ended.status == 1
    assert "(limit >= 3.193; swing 219.9 deg)" in " ".join(ended.out.split())
    assert "set unloader.pivot_ratio to 3.2" in " ".join(ended.out.split())


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("natural_frequency", "Unit: Hz"),
        ("drive_ratio", "torque of the cam shaft without over that with the device"),
        ("drive_torque_peak", "without device and without linkage_share"),
    ],
)
def test_words_of_the_wide_swing_are_explained(gearlink: Any, name: str, words: str) -> None:
    ended = gearlink("explain", name)
    assert ended.status == 0
    assert words in " ".join(ended.out.split())
