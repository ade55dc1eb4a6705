"""`gearlink animate`: scenes that hold together, teeth that mesh, loops without a jump, files that are whole.

Tolerances: joints come from closed forms, so links keep their length within 1e-9 mm times the size of the mechanism
over 100 mm; places at both ends of a loop agree as closely. Teeth are polygons with a chord error of 0.012 module, so
flanks in contact may cross by twice that. A cam of 720 chords lies within 0.01 mm of its roller.
"""

from __future__ import annotations

import json
import os
import re
from functools import cache
from pathlib import Path
from typing import Any

import machines
import numpy as np
import pytest
import yaml
from factory import each_kind
from matplotlib.path import Path as Outline
from PIL import Image
from sweeps import mostly_slow
from systems import UNIX

from gearlink.cli.evaluate import open_design, read_spec, whole_design
from gearlink.cli.options import Options
from gearlink.cli.views.films import raster
from gearlink.cli.views.films.page import page, player_stage
from gearlink.cli.views.films.raster import FINER, Raster, backdrop
from gearlink.cli.views.films.stage import ChartScale, Stage
from gearlink.cli.views.scenes import shown
from gearlink.cli.views.scenes.linkages import build, moving_kinds, pictures_for
from gearlink.cli.views.scenes.scene import TURN, Body, Chain, Scene
from tests.oracles.three_gear_output import output_motion

ROOT = Path(__file__).resolve().parents[3]
DESIGNS = ROOT / "designs"
STANDING = {"gear-train-mobility", "measured-cam", "motion-law"}
QUICK = ("--fps", 4, "--seconds", 1, "--size", "240x180")


@cache
def design_of(path: Path | str) -> Any:
    loaded, kind = open_design(str(path), Options())
    spec = read_spec(loaded, kind, str(path))
    return whole_design(kind, spec)


def kind_in(path: Path) -> str:
    return str(yaml.safe_load(path.read_text())["kind"])


MOVING = [path for path in sorted(DESIGNS.glob("*.yaml")) if kind_in(path) in moving_kinds()]
each_design = pytest.mark.parametrize("path", each_kind(MOVING), ids=lambda path: path.stem)


def bodies(scene: Scene) -> list[Body]:
    return [part for part in scene.parts if isinstance(part, Body)]


def chains(scene: Scene) -> list[Chain]:
    return [part for part in scene.parts if isinstance(part, Chain)]


def size_of(scene: Scene) -> float:
    return max(float(np.abs(mark.point).max()) for mark in scene.marks) + max(
        (float(np.abs(body.outline).max()) for body in bodies(scene)), default=0.0
    )


def gears(scene: Scene) -> list[Body]:
    """Bodies with teeth, in the order in which they are drawn."""
    return [body for body in bodies(scene) if body.repeats > 12]


def placed(body: Body, i: int) -> np.ndarray:
    return body.place[i] + body.outline * np.exp(1j * body.turn[i])


def depth(points: np.ndarray, polygon: np.ndarray, inside: bool) -> float:
    """How deep points stand inside, or outside, a polygon."""
    path = Outline(np.column_stack([polygon.real, polygon.imag]))
    near = points[path.contains_points(np.column_stack([points.real, points.imag])) == inside]
    if not near.size:
        return 0.0
    start, way = polygon[:-1, None], np.diff(polygon)[:, None]
    along = np.clip(((near[None, :] - start) * way.conj()).real / np.maximum(np.abs(way) ** 2, 1e-300), 0.0, 1.0)
    return float(np.abs(near[None, :] - start - along * way).min(axis=0).max())


# Scenes


def test_every_kind_with_a_design_moves_but_for_those_that_cannot() -> None:
    assert {kind_in(path) for path in DESIGNS.glob("*.yaml")} - set(moving_kinds()) <= STANDING


@pytest.mark.quick(6)
@each_design
def test_links_keep_their_length(path: Path) -> None:
    scene = build(design_of(path), np.arange(61) / 60.0)
    room = 1e-11 * size_of(scene)
    for chain in chains(scene):
        telescope = chain.width > 5.0  # the unloading device of a wide-swing mechanism
        for start, end in zip(chain.joints, chain.joints[1:], strict=False):
            lengths = np.abs(end - start)
            assert telescope or float(np.ptp(lengths)) <= room


@pytest.mark.quick(3)
@each_design
def test_nothing_jumps_at_the_seam(path: Path) -> None:
    scene = build(design_of(path), np.array([0.0, 1.0]))
    room = 1e-9 * size_of(scene)
    for part in scene.parts:
        if isinstance(part, Body):
            assert abs(part.place[1] - part.place[0]) <= room
            patterns = (part.turn[1] - part.turn[0]) * part.repeats / TURN
            assert patterns == pytest.approx(round(patterns), abs=1e-7)
        elif isinstance(part, Chain):
            assert all(abs(joint[1] - joint[0]) <= room for joint in part.joints)
    assert all(abs(mark.point[1] - mark.point[0]) <= room for mark in scene.marks)


@pytest.mark.quick(3)
@each_design
def test_nothing_jumps_within_the_loop(path: Path) -> None:
    count = 240
    scene = build(design_of(path), np.arange(count + 1) / count)
    far = size_of(scene)
    for body in bodies(scene):
        # No part comes round in less than a twentieth of the loop.
        assert float(np.abs(np.diff(body.place)).max()) <= 20.0 * TURN * far / count
        assert float(np.abs(np.diff(body.turn)).max()) <= 20.0 * TURN / count


@pytest.mark.quick(3)
@each_design
def test_pictures_are_as_many_as_teeth_need(path: Path) -> None:
    scene = build(design_of(path), np.arange(96) / 96.0)
    count = pictures_for(scene, 25)
    assert 100 <= count <= 300
    finer = build(design_of(path), np.arange(count) / count)
    for gear in gears(finer):
        pitches = np.abs(np.diff(gear.turn)) * gear.repeats / TURN
        assert count == 300 or float(pitches.max()) < 0.5


def test_the_three_gears_roll_on_each_other(designs: Path) -> None:
    design = design_of(designs / "thesis_example_1.yaml")
    fraction = np.arange(50) / 50.0
    scene = build(design, fraction)
    output, idler, crank = gears(scene)
    assert (output.repeats, idler.repeats, crank.repeats) == (40, 72, 40)
    motion = output_motion(design.linkage, design.train, TURN * fraction)
    np.testing.assert_allclose(output.turn - output.turn[0], motion.output_angle, rtol=0.0, atol=1e-11)
    np.testing.assert_allclose(np.abs(idler.place - crank.place), 112.0, rtol=1e-13)
    np.testing.assert_allclose(np.abs(output.place - idler.place), 112.0, rtol=1e-13)


@pytest.mark.quick(5)
@pytest.mark.parametrize(
    "name",
    [
        "thesis_example_1",
        "thesis_example_2",
        "two_gear_drag_link",
        "wide_lever",
        "five_bar_path",
        "five_bar_positions",
        "ty460_input_gears",
        "ty460",
    ],
)
def test_teeth_of_outer_gears_do_not_cross(name: str) -> None:
    design = design_of(DESIGNS / f"{name}.yaml")
    pairs = list(design.meshes.values()) if hasattr(design, "meshes") else [_mesh(design)]
    scene = build(design, np.array([0.0, 0.137, 0.511, 0.873]))
    toothed = gears(scene)
    assert len(toothed) == len(pairs) + 1
    for pair, first, second in zip(reversed(pairs), toothed, toothed[1:], strict=False):
        for i in range(4):
            one, two = placed(first, i), placed(second, i)
            near = one[np.abs(one - second.place[i]) < np.abs(two - second.place[i]).max() + pair.module]
            assert near.size
            assert depth(near, two, inside=True) < 0.03 * pair.module


@pytest.mark.parametrize("name", ["geared_six_bar", "six_bar_swing"])
def test_both_trains_of_a_six_bar_turn_in_mesh(name: str) -> None:
    design = design_of(DESIGNS / f"{name}.yaml")
    toothed = gears(build(design, np.array([0.0, 0.137, 0.511, 0.873])))
    for first, second, mesh in zip(toothed[::2], toothed[1::2], design.meshes.values(), strict=True):
        for i in range(4):
            one, two = placed(first, i), placed(second, i)
            near = one[np.abs(one - second.place[i]) < np.abs(two - second.place[i]).max() + mesh.module]
            assert near.size
            assert depth(near, two, inside=True) < 0.03 * mesh.module


def _mesh(design: Any) -> Any:
    return design.mesh if hasattr(design, "mesh") else design.gear_pair


def test_an_idler_and_a_ring_of_a_five_bar_turn_in_mesh(tmp_path: Path) -> None:
    spec = yaml.safe_load((DESIGNS / "five_bar_path.yaml").read_text())
    for name, gears, frame in (
        ("idler", {"module": 2.5, "input": 20, "output": 20, "idler": 17}, 80.0),
        ("ring", {"module": 2.5, "input": 20, "output": 40, "mesh": "internal"}, None),
        ("ring-input", {"module": 2.5, "input": 40, "output": 20, "mesh": "internal"}, None),
    ):
        path = tmp_path / f"{name}.yaml"
        links = {"input": 12, "coupler": 80, "follower": 80, "output": 12, **({"frame": frame} if frame else {})}
        path.write_text(json.dumps({**spec, "gears": gears, "links": links}))
        toothed = gears_of_pictures(path)
        for i in range(3):
            if name == "idler":
                first, output, idler = (placed(gear, i) for gear in toothed)
                assert max(depth(first, idler, inside=True), depth(output, idler, inside=True)) < 0.03 * 2.5
            else:
                assert depth(placed(toothed[1], i), placed(toothed[0], i), inside=False) < 0.03 * 2.5


def gears_of_pictures(path: Path) -> list[Body]:
    scene = build(design_of(path), np.array([0.0, 0.137, 0.511, 1.0]))
    for gear in gears(scene):
        patterns = (gear.turn[3] - gear.turn[0]) * gear.repeats / TURN
        assert patterns == pytest.approx(round(patterns), abs=1e-7)
    return gears(scene)


@pytest.mark.parametrize("name", ["two_gear_ring", "hypocycloid_slider"])
def test_teeth_in_a_ring_do_not_cross(name: str) -> None:
    design = design_of(DESIGNS / f"{name}.yaml")
    scene = build(design, np.array([0.0, 0.137, 0.511, 0.873]))
    ring, planet = gears(scene)
    assert (planet.repeats, -ring.repeats) == design.mesh.teeth
    for i in range(4):
        assert depth(placed(planet, i), placed(ring, i), inside=False) < 0.03 * design.mesh.module


def test_the_resting_gear_of_a_mutilated_wheel_is_passed_freely() -> None:
    # Between the groups the wheel is cut to its root circle; first and last tooth are cut where they would strike.
    design = design_of(DESIGNS / "mutilated_gear_press.yaml")
    share = design.motion_share
    scene = build(design, np.array([0.1, 0.2, share + 0.004, share + 0.008, 0.6, 0.988, 0.992, 0.996]))
    wheel = next(body for body in bodies(scene) if body.repeats == design.mutilated.groups)
    driven = gears(scene)[-1]
    assert all(depth(placed(driven, i), placed(wheel, i), inside=True) < 0.03 * design.mesh.module for i in range(8))


@pytest.mark.parametrize("name", ["ty460", "swing_gripper"])
def test_rollers_touch_their_cams(name: str) -> None:
    scene = build(design_of(DESIGNS / f"{name}.yaml"), np.arange(8) / 8.0)
    cams = [body for body in bodies(scene) if len(body.outline) == 721]
    rollers = [body for body in bodies(scene) if len(body.outline) == 73][: 3 if name == "ty460" else 2][-2:]
    assert len(cams) == 2
    for i in range(8):
        gaps = [
            min(abs(np.abs(placed(cam, i) - roller.place[i]).min() - abs(roller.outline[0])) for roller in rollers)
            for cam in cams
        ]
        assert max(gaps) < 0.01


def test_wide_swing_rollers_touch_their_profile_in_the_stroke() -> None:
    design = design_of(DESIGNS / "wide_swing_twin_cam.yaml")
    scene = build(design, np.array([0.03, 0.1, 0.25, 0.6, 0.75]))
    main = next(body for body in bodies(scene) if body.width == 2.4 and body.color == "#0072B2")
    back = next(body for body in bodies(scene) if body.width == 2.4 and body.color == "#D55E00")
    roller = next(body for body in bodies(scene) if len(body.outline) == 73)
    for i, cam in enumerate([main, main, main, back, back]):
        assert np.abs(placed(cam, i) - roller.place[i]).min() == pytest.approx(design.spec.cam.roller_radius, abs=0.05)


def test_bed_and_cylinder_run_together_in_the_zone() -> None:
    design = design_of(DESIGNS / "ty460.yaml")
    scene = build(design, np.linspace(design.sync_start, design.sync_end, 20) / TURN)
    values = {readout.label: readout.values for readout in scene.readouts}
    gap = values["bed"] - values["cylinder"]
    # The cam was made to take the difference away.
    assert float(np.ptp(gap)) < 1e-9 * 420.0


@pytest.mark.quick(2)
@pytest.mark.parametrize("without", [("cam",), ("input_gears",), ("cam", "input_gears")])
def test_a_press_without_its_optional_sections_moves(tmp_path: Path, without: tuple[str, ...]) -> None:
    spec = yaml.safe_load((DESIGNS / "ty460.yaml").read_text())
    for section in without:
        del spec[section]
    path = tmp_path / "press.yaml"
    path.write_text(json.dumps(spec))
    scene = build(design_of(path), np.arange(3) / 3.0)
    assert Raster(Stage(scene, "press", 240, 180)).picture(2).size == (240, 180)


@pytest.mark.parametrize("factor", [1e-6, 1e6])
def test_tiny_and_huge_mechanisms_move(tmp_path: Path, factor: float) -> None:
    path = tmp_path / "slider.yaml"
    path.write_text(f"kind: slider-crank\nstroke: {310 * factor!r}\nrod: {520 * factor!r}\noffset: {50 * factor!r}\n")
    scene = build(design_of(path), np.arange(4) / 4.0)
    assert Raster(Stage(scene, "slider", 240, 180)).picture(1).getcolors(100000) is not None


# Files


def test_a_gif_has_the_pictures_and_the_time_asked_for(gearlink: Any, designs: Path, tmp_path: Path) -> None:
    spec = designs / "thesis_example_1.yaml"
    ended = gearlink("animate", spec, "--out", tmp_path, "--fps", 6, "--seconds", 2, "--size", "320x241")
    path = tmp_path / "thesis-example-1-motion.gif"
    assert (ended.status, ended.out, ended.err) == (0, "", f"wrote {path}\n")
    with Image.open(path) as image:
        assert (image.n_frames, image.size, image.info["loop"]) == (12, (320, 240), 0)
        times = []
        for i in range(image.n_frames):
            image.seek(i)
            times.append(image.info["duration"])
    assert sum(times) == 2000


@pytest.mark.quick(1)
@pytest.mark.parametrize("path", mostly_slow(MOVING[::9] + MOVING, len(MOVING[::9])), ids=lambda path: path.stem)
def test_every_design_becomes_a_gif(gearlink: Any, tmp_path: Path, path: Path) -> None:
    ended = gearlink("animate", path, "--out", tmp_path, "--quiet", "--fps", 2, "--seconds", 1, "--size", "240x180")
    assert (ended.status, ended.out, ended.err) == (0, "", "")
    (made,) = tmp_path.iterdir()
    assert made.name.endswith("-motion.gif")


@pytest.mark.slow
def test_what_fails_in_a_later_picture_is_red_in_a_gif(gearlink: Any, designs: Path, tmp_path: Path) -> None:
    """Colours were those of the first picture: of a cam that passes at cam angle 0 the red came out as orange."""
    line = ("animate", designs / "lift_cam.yaml", "--set", "limits.pressure_angle=20", "--seconds", 1, "--fps", 12)
    assert gearlink(*line, "--out", tmp_path).status == 0
    with Image.open(tmp_path / "lift-cam-motion.gif") as found:
        corners = []
        for i in range(found.n_frames):
            found.seek(i)
            corners.append(found.convert("RGB").getpixel((1, 1)))
    assert corners[0] == (255, 255, 255)
    assert set(corners[1:]) == {(255, 255, 255), (208, 0, 0)}


@pytest.mark.slow
@pytest.mark.parametrize("form", ["gif", "html"])
def test_the_same_design_gives_the_same_bytes(gearlink: Any, designs: Path, tmp_path: Path, form: str) -> None:
    for folder in ("a", "b"):
        command = ("animate", designs / "ty460.yaml", "--format", form, "--out", tmp_path / folder, *QUICK)
        assert gearlink(*command).status == 0
    first, second = (tmp_path / folder / f"TY-460-motion.{form}" for folder in ("a", "b"))
    assert first.read_bytes() == second.read_bytes()


@pytest.mark.slow
def test_pictures_of_several_processes_are_those_of_one(
    gearlink: Any, designs: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(raster, "_WORTH_PROCESSES", 2)
    for jobs in (1, 2):
        monkeypatch.setattr(raster, "processors", lambda jobs=jobs: jobs)
        command = ("animate", designs / "ty460.yaml", "--out", tmp_path / str(jobs), *QUICK)
        assert gearlink(*command).status == 0
    first, second = (tmp_path / folder / "TY-460-motion.gif" for folder in ("1", "2"))
    assert first.read_bytes() == second.read_bytes()


def test_a_page_needs_nothing_else(gearlink: Any, designs: Path, tmp_path: Path) -> None:
    spec = designs / "swing_gripper.yaml"
    ended = gearlink("animate", spec, "--format", "html", "--out", tmp_path, *QUICK, "--set", "name=a</script>b&c")
    assert ended.status == 0
    (path,) = tmp_path.iterdir()
    text = path.read_text()
    assert not re.search(r"https?:|src=|href=|@import|url\(", text)
    assert text.count("</script>") == 1
    assert "<title>a&lt;/script&gt;b&amp;c</title>" in text
    data = json.loads(re.search(r"const DATA = (.*);\n", text)[1])  # type: ignore[index]
    assert (data["count"], data["fps"], data["title"]) == (4, 4, "a</script>b&c")
    for part in data["parts"]:
        if part["is"] == "body":
            assert len(part["p"]) == 2 * len(part["t"]) == 8
    for control in ('id="play"', 'id="place" type="range"', 'id="speed"'):
        assert control in text


def test_page_and_picture_place_parts_alike(designs: Path) -> None:
    scene = build(design_of(designs / "thesis_example_1.yaml"), np.arange(4) / 4.0)
    stage = player_stage(scene, "one", (400, 300))
    data = json.loads(re.search(r"const DATA = (.*);\n", page(Stage(scene, "one", 400, 300), 4))[1])  # type: ignore[index]
    drawn = [part for part in data["parts"] if part["is"] == "body"]
    for body, part in zip(bodies(scene), drawn, strict=True):
        outline = np.array(part["o"][0::2]) + 1j * np.array(part["o"][1::2])
        there = part["p"][4] + 1j * part["p"][5] + outline * np.exp(1j * part["t"][2])
        assert np.abs(there - stage.pixels(placed(body, 2))).max() < 0.05


@pytest.mark.quick(3)
@each_design
def test_all_that_moves_stays_on_the_picture(path: Path) -> None:
    stage = Stage(build(design_of(path), np.arange(24) / 24.0), path.stem, 640, 480)
    for body in bodies(stage.scene):
        for i in range(0, 24, 5):
            points = stage.pixels(placed(body, i))
            assert points.real.min() > 0.0
            assert points.real.max() < 640.0
            assert points.imag.min() > stage.head
            assert points.imag.max() < 480.0


def test_what_fails_stands_above_the_names_of_the_members() -> None:
    """Of four findings three lines are shown, the last of them their number; they lay on the uppermost members."""
    plain = machines.cam([(90, 12), (180, 0), (360, None)])
    members = {f"m{speed}": machines.of(plain | {"speed": speed}) for speed in (50, 60, 70, 80)}
    press = machines.machine(members, speed=120)
    scene = shown.build(press, np.arange(4) / 4.0, checks=press.report("analyze").checks)
    stage = Stage(scene, "press", 960, 720)
    lines = stage.failing(1)
    assert lines[-1] == "and 2 more"
    names = [stage.pixels(mark.point)[1].imag for mark in stage.scene.marks if mark.text in members]
    assert min(names) - 0.5 * stage.text_size > (4.0 + 1.2 * len(lines)) * stage.text_size


def test_mp4_without_ffmpeg_says_so(
    gearlink: Any, designs: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path / "nothing"))
    out = tmp_path / "out"
    ended = gearlink("animate", designs / "thesis_example_1.yaml", "--format", "mp4", "--out", out)
    assert (ended.status, ended.out) == (2, "")
    assert "mp4 needs the program ffmpeg" in ended.err
    assert not out.exists()


def _ffmpeg(folder: Path, script: str) -> None:
    folder.mkdir()
    program = folder / "ffmpeg"
    program.write_text(f"#!/bin/sh\n{script}\n")
    program.chmod(0o755)


@UNIX
def test_mp4_is_fed_with_every_picture(
    gearlink: Any, designs: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    _ffmpeg(tmp_path / "bin", 'for last; do :; done; cat > "$last"')
    monkeypatch.setenv("PATH", f"{tmp_path / 'bin'}{os.pathsep}{os.environ['PATH']}")
    out = tmp_path / "out"
    command = ("animate", designs / "thesis_example_1.yaml", "--format", "mp4", "--out", out, *QUICK)
    assert gearlink(*command).status == 0
    (path,) = out.iterdir()
    assert (path.name, path.stat().st_size) == ("thesis-example-1-motion.mp4", 4 * 240 * 180 * 3)


@UNIX
@pytest.mark.parametrize("script", ["echo it broke >&2; exit 1", "cat > /dev/null; echo it broke >&2; exit 1"])
def test_nothing_is_left_where_ffmpeg_fails(
    gearlink: Any, designs: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, script: str
) -> None:
    _ffmpeg(tmp_path / "bin", script)
    monkeypatch.setenv("PATH", f"{tmp_path / 'bin'}{os.pathsep}{os.environ['PATH']}")
    out = tmp_path / "out"
    ended = gearlink("animate", designs / "thesis_example_1.yaml", "--format", "mp4", "--out", out, *QUICK)
    assert (ended.status, ended.out) == (2, "")
    assert "ffmpeg failed: it broke" in ended.err
    assert list(out.iterdir()) == []


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("designs/six_bar_two_trains.yaml",), "a gear-train-mobility does not move; kinds that do: three-gear"),
        (("designs/none.yaml",), "none.yaml"),
        (("designs/thesis_example_1.yaml", "--size", "big"), "must be WIDTHxHEIGHT"),
        (("designs/thesis_example_1.yaml", "--size", "100x100"), "from 160 to 3840 pixels"),
        (("designs/thesis_example_1.yaml", "--set", "back_step.crank_angle=179.99999999"), "thesis_example_1.yaml"),
        (("designs/thesis_example_1.yaml", "--set", "gears.output=41"), "gears.output"),
    ],
)
def test_refusals(
    gearlink: Any, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, arguments: tuple[str, ...], words: str
) -> None:
    monkeypatch.chdir(ROOT)
    ended = gearlink("animate", *arguments, "--out", tmp_path)
    assert ended.status == 2
    assert words in ended.err
    assert list(tmp_path.iterdir()) == []


def test_nothing_half_written_where_drawing_breaks(
    gearlink: Any, designs: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn = Raster.picture

    def broken(self: Raster, i: int) -> Any:
        if i == 2:
            raise OSError("disk full")
        return drawn(self, i)

    monkeypatch.setattr(Raster, "picture", broken)
    ended = gearlink("animate", designs / "thesis_example_1.yaml", "--out", tmp_path, *QUICK)
    assert ended.status == 2
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "options"),
    [
        ("candy_feed", QUICK),
        ("wide_swing_twin_rocker", ("--fps", "5", "--seconds", "0.4")),
    ],
)
def test_paper_is_white_in_every_picture(
    gearlink: Any, designs: Path, tmp_path: Path, name: str, options: tuple[str, ...]
) -> None:
    assert gearlink("animate", designs / f"{name}.yaml", "--out", tmp_path, *options).status == 0
    (path,) = tmp_path.iterdir()
    with Image.open(path) as film:
        for i in range(film.n_frames):
            film.seek(i)
            assert film.convert("RGB").getpixel((film.width - 2, 2)) == (255, 255, 255)


def test_a_word_keeps_its_hyphen_beside_a_negative_number() -> None:
    assert raster._MINUS.sub("\u2212", "rocker from mid-swing -11.7\u00b0") == "rocker from mid-swing \u221211.7\u00b0"


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("name", "wanted"),
    [
        ("wide_swing_slider_cam", {"D", "device", "O", "E", "F"}),
        ("wide_swing_oscillating_cam", {"D", "device", "O", "A", "B", "C"}),
    ],
)
def test_joints_of_a_wide_swing_have_the_letters_of_its_loads(designs: Path, name: str, wanted: set[str]) -> None:
    made = build(design_of(designs / f"{name}.yaml"), np.linspace(0.0, 0.9, 4))
    assert {mark.text for mark in made.marks} == wanted


def test_curves_of_the_chart_show_no_steps(designs: Path) -> None:
    """Column by column the middle of the ink is where the curve passes, to a fifth of a pixel beside a shift that is
    the same all along: a line from whole pixel to whole pixel of the large picture is off by a third and more."""
    made = design_of(designs / "ty460_slider_crank.yaml")
    scene = build(made, np.arange(4) / 4)
    stage = Stage(scene, "curve", 480, 360)
    assert scene.chart is not None
    scale = ChartScale(scene.chart, stage.chart_room)
    ink = np.ptp(np.asarray(backdrop(stage).reduce(FINER), dtype=float), axis=2)  # frame, grid and words are grey
    (curve,) = scene.chart.curves
    exact = scale.points(scene.chart.x, curve.y)
    columns = np.arange(int(scale.room.left) + 4, int(scale.room.right) - 4)
    rows = np.arange(ink.shape[0])[:, None] + 0.5
    middle = (rows * ink[:, columns]).sum(axis=0) / ink[:, columns].sum(axis=0)
    off = middle - np.interp(columns + 0.5, exact.real, exact.imag)
    assert np.abs(off - off.mean()).max() < 0.2
