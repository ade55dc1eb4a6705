"""`gearlink export` as a user meets it: files, header, formats, exit status, failures.

Tolerances: coordinates of an SVG are rounded to a thousandth of the tolerance, so half of that (5e-7 mm) is allowed
against the CSV of the same run; numbers in a CSV are shortest round-trip doubles and compared exactly.
"""

from __future__ import annotations

import csv
import json
import os
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from collections import Counter
from pathlib import Path
from typing import Any

import ezdxf
import factory
import numpy as np
import pytest
from sweeps import mostly_slow

from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.export.contour import rounded_up

ROOT = Path(__file__).resolve().parents[3]
CASES = ROOT / "tests" / "reference" / "contract"
PRESS = ROOT / "designs" / "ty460.yaml"
GEARS = ROOT / "designs" / "ty460_input_gears.yaml"


def case(command: str, number: int = 0) -> Any:
    """Spec of a reference case."""
    return json.loads((CASES / f"{command}.json").read_text())[number]["spec"]


@pytest.fixture
def swing(tmp_path: Path) -> Path:
    path = tmp_path / "swing.yaml"
    path.write_text(json.dumps(case("swing")))
    return path


def comments(path: Path) -> dict[str, str]:
    """Header lines of an exported CSV."""
    lines = [line[2:] for line in path.read_text().splitlines() if line.startswith("# ")]
    return dict(line.split(": ", 1) for line in lines)


def table(path: Path) -> list[dict[str, str]]:
    """Rows of an exported CSV."""
    return list(csv.DictReader(line for line in path.read_text().splitlines() if not line.startswith("#")))


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("design", "parts"),
    [
        ("ty460.yaml", {"main_cam", "return_cam", "gear1", "gear2"}),
        ("ty460_input_gears.yaml", {"gear1", "gear2"}),
        ("candy_feed.yaml", {"gear1", "gear3", "gear5"}),
        ("thesis_example_1.yaml", {"gear1", "gear3", "gear5"}),
        ("thesis_example_2.yaml", {"gear1", "gear3", "gear5"}),
        ("thesis_example_3_as_printed.yaml", {"gear1", "gear3", "gear5"}),
        ("thesis_example_3_mended.yaml", {"gear1", "gear3", "gear5"}),
        ("swing_gripper.yaml", {"main_cam", "return_cam"}),
        ("wide_swing_twin_cam.yaml", {"main_cam", "return_cam"}),
        ("wide_swing_twin_rocker.yaml", {"main_cam", "return_cam"}),
        ("wide_swing_cycle.yaml", {"main_cam", "return_cam", "contour", "return_contour"}),
        ("wide_swing_oscillating_cam.yaml", {"main_cam"}),
        ("wide_swing_slider_cam.yaml", {"main_cam"}),
        ("two_gear_drag_link.yaml", {"gear2", "gear5"}),
        ("two_gear_ring.yaml", {"gear2", "gear5"}),
        ("wide_lever.yaml", {"gear2", "gear5"}),
    ],
)
def test_every_part_of_every_design(gearlink: Any, tmp_path: Path, design: str, parts: set[str]) -> None:
    ended = gearlink("export", ROOT / "designs" / design, "--out", tmp_path, "--tolerance", 0.05)
    fails = design == "thesis_example_3_as_printed.yaml"
    assert (ended.status, "warning: the design fails GL301" in ended.err) == (int(fails), fails)
    assert {path.stem.rpartition("-")[2] for path in tmp_path.glob("*.dxf")} == parts
    assert len(ended.out.splitlines()) == len(parts)


def test_a_gripper_without_return_roller_has_one_cam(gearlink: Any, tmp_path: Path) -> None:
    spec = case("gripper")
    del spec["cam"]["return_roller"]
    del spec["spring"], spec["inertia"]
    (tmp_path / "one.yaml").write_text(json.dumps(spec))
    assert gearlink("export", tmp_path / "one.yaml", "--as", "csv", "--out", tmp_path / "out").status == 0
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["one-main_cam.csv"]


def test_the_reached_error_is_the_same_in_print_and_in_every_file(gearlink: Any, tmp_path: Path) -> None:
    formats = [word for name in ("dxf", "svg", "csv") for word in ("--as", name)]
    ended = gearlink("export", PRESS, "--part", "main_cam", *formats, "--out", tmp_path)
    (said,) = set(re.findall(r"chord error (\S+) mm \(tolerance 0.001 mm\)", ended.out))
    assert 0.0 < float(said) <= 0.001
    assert comments(tmp_path / "TY-460-main_cam.csv")["chord_error"] == f"{said} mm"
    document = ezdxf.readfile(tmp_path / "TY-460-main_cam.dxf")
    assert document.header.custom_vars.get("CHORD_ERROR") == f"{said} mm"
    texts = [entity.dxf.text for entity in document.modelspace().query("TEXT")]
    assert f"chord_error: {said} mm" in texts
    svg = (tmp_path / "TY-460-main_cam.svg").read_text()
    stated = float(re.search(r"chord_error: (\S+) mm", svg)[1])  # type: ignore[index]
    assert float(said) <= stated <= float(said) + 2e-6  # its own rounding is added


def test_points_are_counted_for_each_curve(gearlink: Any, tmp_path: Path) -> None:
    """A cam's file holds its profile and the pitch curve, a gear's one closed profile."""
    ended = gearlink("export", PRESS, "--part", "main_cam", "--part", "gear1", "--as", "csv", "--out", tmp_path)
    cam, gear = ended.out.splitlines()
    found = re.search(r": (\d+) points \(profile (\d+), pitch curve (\d+)\),", cam)
    assert found
    whole, profile, pitch = map(int, found.groups())
    assert whole == profile + pitch
    assert comments(tmp_path / "TY-460-main_cam.csv")["points"] == f"PROFILE {profile}, PITCH_CURVE {pitch}"
    assert re.search(r": \d+ points, chord", gear)


def test_csv_says_what_it_is(gearlink: Any, tmp_path: Path) -> None:
    gearlink("export", PRESS, "--part", "main_cam", "--as", "csv", "--out", tmp_path)
    said = comments(tmp_path / "TY-460-main_cam.csv")
    assert said["unit"] == "mm"
    assert said["tolerance"] == "0.001 mm"
    assert re.fullmatch(r"[0-9a-f]{64}", said["design_sha256"])
    rows = table(tmp_path / "TY-460-main_cam.csv")
    names = ["x [mm]", "y [mm]", "pitch_x [mm]", "pitch_y [mm]", "pressure_angle [deg]", "curvature_radius [mm]"]
    assert list(rows[0]) == ["cam_angle [deg]", *names], "and no column of names, which its one piece has not"
    angles = [float(row["cam_angle [deg]"]) for row in rows]
    assert angles == sorted(angles)
    assert (angles[0], angles[-1]) == (0.0, 360.0)
    assert [rows[-1][name] for name in names[:4]] == [rows[0][name] for name in names[:4]]


def test_the_hash_is_the_designs(gearlink: Any, tmp_path: Path) -> None:
    """Comments, order and defaults of the file do not matter; every number does, --set included."""

    def digest(path: Path, *more: str) -> str:
        gearlink("export", path, "--part", "gear1", "--as", "csv", "--tolerance", 0.1, "--out", tmp_path, *more)
        return comments(tmp_path / "TY-460-input-gears-gear1.csv")["design_sha256"]

    same = tmp_path / "other.yaml"
    same.write_text(
        "# another file\naddendum: 1\nteeth: [72, 72]\nmodule: 4.0\ncenter_distance: 290.2912330746487\n"
        "name: TY-460-input-gears\nkind: gear-pair\n"
    )
    assert digest(GEARS) == digest(same)
    assert digest(GEARS) != digest(GEARS, "--set", "center_distance=290.3")


def test_svg_is_to_scale_and_holds_the_points_of_the_csv(gearlink: Any, tmp_path: Path) -> None:
    gearlink("export", PRESS, "--part", "main_cam", "--as", "csv", "--as", "svg", "--out", tmp_path)
    root = ElementTree.parse(tmp_path / "TY-460-main_cam.svg").getroot()
    left, top, width, height = (float(word) for word in root.attrib["viewBox"].split())
    assert (root.attrib["width"], root.attrib["height"]) == (f"{width:.0f}mm", f"{height:.0f}mm")
    path = root.find(".//{*}path[@class='PROFILE']")
    assert path is not None
    data = path.attrib["d"]
    assert data.startswith("M")
    assert data.endswith("Z")
    drawn = [tuple(map(float, pair.split())) for pair in data[1:-1].split("L")]
    # Outlines run counter-clockwise, rows with the angle of the cam, which turns that way under its roller.
    rows = table(tmp_path / "TY-460-main_cam.csv")[:0:-1]
    assert len(drawn) == len(rows)
    for (x, y), row in zip(drawn, rows, strict=True):
        assert x == pytest.approx(float(row["x [mm]"]), rel=0.0, abs=5.1e-7)
        assert y == pytest.approx(float(row["y [mm]"]), rel=0.0, abs=5.1e-7)
    pitch = [float(row["pitch_x [mm]"]) for row in rows]
    assert left < min(pitch)
    assert left + width > max(pitch)
    assert top < -max(float(row["pitch_y [mm]"]) for row in rows)


@pytest.mark.slow
@pytest.mark.parametrize("curve", mostly_slow(["polyline", "spline"], 1))
def test_the_same_design_gives_the_same_bytes(gearlink: Any, tmp_path: Path, curve: str) -> None:
    """In another process with another hash seed."""
    words = ["export", str(PRESS), "--part", "main_cam", "--as", "dxf", "--as", "svg", "--as", "csv", "--curve", curve]
    assert gearlink(*words, "--out", tmp_path / "a").status == 0
    command = [sys.executable, "-m", "gearlink.cli.main", *words, "--out", str(tmp_path / "b")]
    subprocess.run(command, check=True, capture_output=True, env={**os.environ, "PYTHONHASHSEED": "7"}, cwd=ROOT)
    for path in (tmp_path / "a").iterdir():
        assert (tmp_path / "b" / path.name).read_bytes() == path.read_bytes()


def test_the_library_is_left_as_it_was(gearlink: Any, tmp_path: Path) -> None:
    before = ezdxf.options.write_fixed_meta_data_for_testing
    gearlink("export", GEARS, "--tolerance", 0.1, "--out", tmp_path)
    assert ezdxf.options.write_fixed_meta_data_for_testing == before


STEEP = """
kind: disc-cam
motion: [{to: 40, lift: 30, law: modified-sine}, {to: 150}, {to: 240, lift: 0}, {to: 360}]
follower: {type: translating-roller, roller_radius: 12}
cam: {prime_radius: 60}
"""


@pytest.mark.quick(1)
@pytest.mark.parametrize("more", [(), ("--cam-table",)])
def test_what_fails_is_said_of_what_was_written(gearlink: Any, tmp_path: Path, more: tuple[str, ...]) -> None:
    file = tmp_path / "steep.yaml"
    file.write_text(STEEP)
    ended = gearlink("export", file, "--out", tmp_path / "out", "-q", *more)
    assert ended.status == ExitCode.FINDING
    assert ended.err == "warning: the design fails GL401 pressure-angle 45.79 deg (limit <= 30 deg)\n"
    assert len(list((tmp_path / "out").iterdir())) == 1
    ended = gearlink("export", file, "--out", tmp_path / "out", "-q", "--set", "limits.pressure_angle=50", *more)
    assert (ended.status, ended.err) == (0, "")


def test_a_kind_without_profiles(gearlink: Any, tmp_path: Path) -> None:
    ended = gearlink("export", ROOT / "designs" / "quiet_law.yaml", "--out", tmp_path)
    assert ended.status == 2
    assert "motion-law has no profile" in ended.err
    assert "gear-pair" in ended.err
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("command", ["gripper", "swing"])
def test_a_design_without_its_cam(gearlink: Any, tmp_path: Path, command: str) -> None:
    spec = case(command)
    del spec["cam"]
    path = tmp_path / "bare.yaml"
    path.write_text(json.dumps(spec))
    ended = gearlink("export", path, "--out", tmp_path / "out")
    assert ended.status == 2
    assert "no section cam" in ended.err


def test_a_press_with_gears_alone(gearlink: Any, tmp_path: Path) -> None:
    bare = re.sub(r"^cam:\n( .*\n)+", "", PRESS.read_text(), flags=re.MULTILINE)
    (tmp_path / "bare.yaml").write_text(bare)
    assert gearlink("export", tmp_path / "bare.yaml", "--as", "svg", "--out", tmp_path / "out").status == 0
    assert {path.name for path in (tmp_path / "out").iterdir()} == {"TY-460-gear1.svg", "TY-460-gear2.svg"}


def test_an_unknown_part_names_the_nearest(gearlink: Any, tmp_path: Path) -> None:
    ended = gearlink("export", PRESS, "--part", "main-cam", "--out", tmp_path)
    assert ended.status == 2
    assert "nearest: main_cam" in ended.err
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("tolerance", ["0", "-1", "1e-9", "nan", "inf", "11", "fine"])
def test_a_tolerance_out_of_range(gearlink: Any, tmp_path: Path, tolerance: str) -> None:
    ended = gearlink("export", PRESS, "--tolerance", tolerance, "--out", tmp_path)
    assert ended.status == 2
    assert "tolerance" in ended.err
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
@pytest.mark.parametrize("more", [(), ("--curve", "spline"), ("--as", "svg")])
@pytest.mark.parametrize("teeth", mostly_slow([2000, 9000], 1))
def test_what_a_refusal_of_too_many_points_recommends_works(
    gearlink: Any, tmp_path: Path, teeth: int, more: tuple[str, ...]
) -> None:
    def asked(count: int, *options: object) -> Any:
        pair = ("--set", f"teeth=[{count}, {count}]", "--set", f"center_distance={4 * count}")
        return gearlink("export", GEARS, *pair, *more, *options, "--part", "gear1", "--out", tmp_path)

    ended = asked(teeth, "--tolerance", 1e-5)
    assert ended.status == ExitCode.WRONG_INPUT
    remedy = re.search(
        r"needs more than 100000 points: (increase --tolerance to (\S+)|.* at most (\d+) teeth)", ended.err
    )
    assert remedy
    if remedy[2]:
        assert asked(teeth, "--tolerance", remedy[2]).status == ExitCode.OK
    else:
        assert asked(int(remedy[3]), "--tolerance", 10).status == ExitCode.OK
        assert asked(int(remedy[3]) + 1, "--tolerance", 10).status == ExitCode.WRONG_INPUT


@pytest.mark.slow
def test_a_gear_of_a_thousand_teeth_is_written_in_bounded_work(gearlink: Any, tmp_path: Path) -> None:
    """Each vertex is written once: to copy the polyline for every vertex would call numpy 40,000 times."""
    many = ("--set", "teeth=[1000, 1000]", "--set", "center_distance=4000", "--part", "gear1", "--out", tmp_path)
    calls = Counter[str]()
    sys.setprofile(lambda *call: calls.update([call[1]]))
    try:
        ended = gearlink("export", GEARS, *many)
    finally:
        sys.setprofile(None)
    assert ended.status == ExitCode.OK
    points = int(re.search(r": (\d+) points", ended.out)[1])  # type: ignore[index]
    assert points > 50_000
    assert calls["call"] < 3 * points


def test_a_wrong_file_is_located(gearlink: Any, tmp_path: Path) -> None:
    ended = gearlink("export", PRESS, "--set", "cam.roller_radius=-1", "--out", tmp_path)
    assert ended.status == 2
    assert "roller_radius" in ended.err


def test_a_profile_that_does_not_exist(gearlink: Any, swing: Path, tmp_path: Path) -> None:
    ended = gearlink("export", swing, "--set", "cam.roller_radius=150", "--out", tmp_path / "out")
    assert ended.status == 2
    assert "GL112" in ended.err
    assert "set cam.roller_radius below" in ended.err
    assert not (tmp_path / "out").exists()


@pytest.mark.quick(1)
@pytest.mark.parametrize("key", ["cam.roller_radius=60", "sync.start=20"])
def test_a_profile_that_the_roller_cuts_is_told(gearlink: Any, tmp_path: Path, key: str) -> None:
    more = ("--set", key, "--set", "cam.lead_in=0", "--part", "main_cam", "--as", "csv")
    ended = gearlink("export", PRESS, *more, "--out", tmp_path)
    assert ended.status == 1
    assert "main_cam" in ended.err
    assert "warning_1" in comments(tmp_path / "TY-460-main_cam.csv")


def test_without_the_dxf_library(gearlink: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "ezdxf", None)
    ended = gearlink("export", GEARS, "--out", tmp_path)
    assert ended.status == 2
    assert "pip install ezdxf" in ended.err
    assert not list(tmp_path.iterdir())
    assert gearlink("export", GEARS, "--as", "svg", "--as", "csv", "--tolerance", 0.1, "--out", tmp_path).status == 0


@pytest.mark.slow
def test_a_home_that_may_not_be_looked_into(tmp_path: Path) -> None:
    """That of a service. The administrator may look everywhere, so the system's answer is planted."""
    code = (
        "import os, sys\n"
        "from gearlink.cli.main import run\n"
        "real, folder = os.stat, sys.argv[1]\n"
        "def stat(path, *rest, **more):\n"
        "    if str(path).startswith(folder):\n"
        "        raise PermissionError(13, 'Permission denied', str(path))\n"
        "    return real(path, *rest, **more)\n"
        "os.stat = stat\n"
        "sys.exit(run(sys.argv[2:]))"
    )
    line = ["export", str(GEARS), "--as", "dxf", "--tolerance", "0.1", "--out", str(tmp_path / "out")]
    environment = {name: value for name, value in os.environ.items() if not name.startswith("XDG_")}
    environment["HOME"] = str(tmp_path / "home")
    command = [sys.executable, "-c", code, environment["HOME"], *line]
    ended = subprocess.run(command, capture_output=True, text=True, env=environment, check=False, timeout=60)
    assert (ended.returncode, ended.stderr) == (0, "")
    assert len(ended.stdout.splitlines()) == len(list((tmp_path / "out").glob("*.dxf"))) == 2


def test_a_full_disk_leaves_nothing(gearlink: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("gearlink.cli.files.os.replace", full)
    ended = gearlink("export", PRESS, "--as", "dxf", "--as", "svg", "--tolerance", 0.1, "--out", tmp_path)
    assert ended.status == 2
    assert "No space left" in ended.err
    assert not list(tmp_path.iterdir())


def test_a_file_in_the_way_of_the_folder(gearlink: Any, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    ended = gearlink("export", GEARS, "--as", "csv", "--tolerance", 0.1, "--out", tmp_path / "file")
    assert ended.status == 2
    assert "cannot write" in ended.err


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["../../x", "a--b -->", "ü漢字", "</svg>", "line\\nbreak"])
def test_a_name_breaks_no_file(gearlink: Any, tmp_path: Path, name: str) -> None:
    formats = [word for form in ("dxf", "svg", "csv") for word in ("--as", form)]
    path = tmp_path / "named.yaml"
    path.write_text(
        f'{{"kind": "gear-pair", "name": "{name}", "module": 1, "teeth": [20, 30], "profile_shift": [0, 0]}}'
    )
    assert gearlink("export", path, "--part", "gear1", *formats, "--out", tmp_path / "out").status == 0
    (svg,) = (tmp_path / "out").glob("*.svg")
    ElementTree.parse(svg)
    (dxf,) = (tmp_path / "out").glob("*.dxf")
    assert not ezdxf.readfile(dxf).audit().errors
    (rows,) = (tmp_path / "out").glob("*.csv")
    assert table(rows)[0]["curve"] == "tip circle"


def test_standard_input_and_quiet(gearlink: Any, standard_input: Any, tmp_path: Path) -> None:
    standard_input(GEARS.read_bytes())
    ended = gearlink("export", "-", "--as", "csv", "-q", "--tolerance", 0.1, "--out", tmp_path)
    assert (ended.status, ended.out) == (0, "")
    assert len(list(tmp_path.iterdir())) == 2


@pytest.mark.parametrize("value", [0.00087212, 0.000999999, 1.0, 9.995, 3e-14])
def test_a_stated_error_is_never_below_the_reached_one(value: float) -> None:
    assert value <= float(rounded_up(value)) <= 1.011 * value


def test_walls_of_a_drum_stand_a_roller_off_its_pitch_line(gearlink: Any, tmp_path: Path) -> None:
    """The developed wall is a roller radius from the pitch line and square to it, by differences of the CSV."""
    gearlink("export", ROOT / "designs" / "barrel_cam.yaml", "--as", "csv", "--out", tmp_path, "--part", "bottom_lower")
    (path,) = tmp_path.glob("*.csv")
    assert "plane development: on the cylinder a wall lies up to about 0.0014 mm from its line" in path.read_text()
    rows = table(path)
    wall, pitch = (
        [complex(float(row[f"{head}x [mm]"]), float(row[f"{head}y [mm]"])) for row in rows] for head in ("", "pitch_")
    )
    off = [w - p for w, p in zip(wall, pitch, strict=True)]
    assert [abs(each) for each in off] == pytest.approx([10.0] * len(off), rel=1e-12)
    assert max(each.imag for each in off) < 0.0  # the lower wall
    for before, at, after, each in zip(pitch, pitch[1:], pitch[2:], off[1:], strict=False):
        way = (after - before) / abs(after - before)
        # the chord over two rows leans by half of their difference of slope
        bend = abs((after - at) / abs(after - at) - (at - before) / abs(at - before))
        assert abs((way * each.conjugate()).real) <= 10.0 * (bend + 1e-3)  # lifts of the file are rounded
    assert float(rows[0]["x [mm]"]) == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize(("sense", "view"), [(1, "inside"), (-1, "outside")])
def test_a_development_says_from_where_the_drum_is_seen(gearlink: Any, tmp_path: Path, sense: int, view: str) -> None:
    """From outside, the axis up, x grows to the right: counter-clockwise, as the wall in space runs or does not."""
    of_sense = ("--set", f"cam.sense={sense}", "--part", "outside_upper")
    gearlink("export", ROOT / "designs" / "barrel_cam.yaml", *of_sense, "--as", "csv", "--out", tmp_path)
    (path,) = tmp_path.glob("*.csv")
    assert f"seen from {view} the drum" in path.read_text(encoding="utf-8")
    walls = factory.design("barrel_cam", cam__sense=sense).table("walls")
    azimuth = np.unwrap(np.arctan2(walls["outside_upper_y"], walls["outside_upper_x"]))
    assert (azimuth[-1] > azimuth[0]) == (view == "outside")
    assert float(table(path)[-1]["x [mm]"]) > 0.0
