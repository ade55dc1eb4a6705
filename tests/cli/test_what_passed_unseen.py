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


@pytest.mark.parametrize(
    ("text", "code", "words"),
    [
        (_FIVE_BAR.replace("INPUT", "40").replace("OUTPUT", "40"), "GL301", "collide by 14 mm"),
        (_FIVE_BAR.replace("INPUT", "80").replace("OUTPUT", "20"), "GL301", "collide by 34 mm"),
        (_DRAG_LINK.replace("IN,", "2,").replace("OUT", "10"), "GL302", "comes 9 mm into the input shaft"),
        (_DRAG_LINK.replace("IN,", "2.9,").replace("OUT", "14"), "GL302", "comes 1.9 mm into the output shaft"),
        (_RING, "GL206", "cut 1 mm into each other"),
        (_TRAINS, "GL308", "mesh at 50 mm, but train 1 holds A and E 40 mm apart"),
        (_TWIN_ROCKER, "GL507", "over 0.05163 of the stroke"),
    ],
    ids=["idler", "large input", "shaft", "shafts", "ring", "trains", "zone"],
)
def test_a_body_or_a_limit_that_no_check_saw(gearlink: Any, tmp_path: Path, text: str, code: str, words: str) -> None:
    path = tmp_path / "design.yaml"
    path.write_text(text)
    ended = gearlink("check", path, "--format", "json")
    assert ended.status == 1
    assert [f["message"] for f in ended.json["findings"] if f["code"] == code and words in f["message"]]


@pytest.mark.parametrize("radius", [70, 74])
def test_a_rocker_without_a_gap_is_judged_to_mid_swing(gearlink: Any, designs: Path, radius: int) -> None:
    line = ("check", designs / "wide_swing_twin_cam.yaml", "--set", f"cam.rocker_radius={radius}", "--format", "json")
    ended = gearlink(*line)
    assert ended.status == 1
    assert any("reaches 90 deg" in f["message"] for f in ended.json["findings"] if f["code"] == "GL401")


def test_a_lead_in_brings_the_speed_to_the_zone(gearlink: Any, designs: Path) -> None:
    settings = ("--set", "sync.start=50", "--set", "cam.transition_end=145")
    assert gearlink("check", designs / "ty460.yaml", *settings).status == 0
