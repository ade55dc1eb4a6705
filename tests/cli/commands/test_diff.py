"""`gearlink diff`: inputs, quantities, checks and tables that changed.

Tolerances: the program's own results are compared with themselves, exactly; changes are made far larger (1e-3) or
far smaller (1e-12) than the tolerance of the comparison (1e-9) that is under test.
"""

from __future__ import annotations

import json
import re
from itertools import combinations
from pathlib import Path
from typing import Any

import pytest
from conftest import ROOT
from systems import LINUX

from gearlink.cli.commands import diff
from gearlink.cli.commands.diff import Change, Difference, relative_change, same, show_difference
from gearlink.cli.options import Options

DESIGNS = ROOT / "designs"

CRANK = "kind: slider-crank\nstroke: 310\nrod: 520\noffset: 50\n"
PAIR = "kind: gear-pair\nmodule: 4\nteeth: [72, 72]\ncenter_distance: 290.2912330746487\n"
LINKAGE = """kind: three-gear-four-bar
gears: {module: 2.5, crank: 20, idler: 20, output: 60}
links: {crank: 18, frame: 125}
"""


pytestmark = pytest.mark.usefixtures("no_remedies")


@pytest.fixture
def two(tmp_path: Path) -> Any:
    """Write an old and a new file; give their paths."""

    def write(old: str, new: str, suffix: str = ".yaml") -> tuple[Path, Path]:
        paths = tmp_path / f"old{suffix}", tmp_path / f"new{suffix}"
        for path, text in zip(paths, (old, new), strict=True):
            path.write_text(text)
        return paths

    return write


def names(changes: list[dict[str, Any]]) -> list[str]:
    return [change["name"] for change in changes]


def test_equal_files(gearlink: Any, two: Any) -> None:
    ended = gearlink("diff", *two(CRANK, CRANK))
    assert ended.status == 0
    assert "are equal" in ended.out
    assert ended.err == ""


def test_order_comments_and_written_defaults_are_no_change(gearlink: Any, two: Any) -> None:
    new = "# the same\nrod: 520.0\noffset: 50\nkind: slider-crank\nstroke: 310\n"
    assert gearlink("diff", *two(CRANK, new)).status == 0
    assert gearlink("diff", *two(PAIR, PAIR + "pressure_angle: 20\nlimits: {contact_ratio: 1.1}\n")).status == 0


def test_inputs_and_quantities_with_units_and_relative_change(gearlink: Any, two: Any) -> None:
    ended = gearlink("diff", *two(CRANK, CRANK.replace("310", "341")), "--format", "json")
    assert ended.status == 1
    found = ended.json
    assert found["equal"] is False
    (stroke,) = found["inputs"]
    assert (stroke["name"], stroke["old"], stroke["new"], stroke["unit"]) == ("stroke", 310.0, 341.0, "mm")
    assert stroke["relative"] == pytest.approx(0.1, rel=1e-15, abs=0.0)
    crank = next(change for change in found["quantities"] if change["name"] == "crank_length")
    assert crank["unit"] == "mm"
    assert crank["relative"] == (crank["new"] - crank["old"]) / crank["old"]
    assert "max_stroke" not in names(found["quantities"])


def test_table_shows_physical_units(gearlink: Any, two: Any) -> None:
    out = gearlink("diff", *two(CRANK, CRANK.replace("310", "341"))).out
    row = next(line for line in out.splitlines() if line.startswith("stroke"))
    assert row.split() == ["stroke", "310", "341", "mm", "+10", "%"]
    assert out.splitlines()[-1].endswith(": 1 input, 17 quantities, 1 check")


def test_members_of_long_lists_stand_below_each_other(gearlink: Any, two: Any) -> None:
    """Beside them the numbers keep their place; a list without members is told from nothing."""
    wishes = "[crank_length <= 156 mm, quick_return_ratio <= 1.2]"
    more = f"tolerance: {{sources: {{rod: {{plus_minus: 0.02}}}}, require: {wishes}}}\n"
    out = gearlink("diff", *two(CRANK, CRANK + more)).out
    assert "crank_length <= 156 mm quick_return_ratio" not in out
    assert max(len(line) for line in out.splitlines() if line.startswith("tolerance.")) <= 80
    empty = "loads: {links: {crank: {mass: 1, inertia: 1}}, speed: 60, forces: []}\n"
    out = gearlink("diff", *two(CRANK, CRANK + empty)).out
    (row,) = (line.split() for line in out.splitlines() if line.startswith("loads.forces"))
    assert row == ["loads.forces", "-", "[]"]


def test_long_names_fit_the_terminal(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """Names break behind points, words of values too, and the commands stand above their rows; no figure is lost."""
    monkeypatch.setenv("COLUMNS", "80")
    key = "tolerance.sources.pins.planet_and_carrier.clearance.plus_minus[0]"
    draft = Change("name", "loaded-oscillating-cam-of-the-first-draft", "b", "", None)
    inputs = [Change(key, 1.23456789e-05, -0.123456789, "N mm/rad", -1e4), draft]
    quantities = [
        Change("acceleration_ratio_max_at[0]", 1.23456789, -0.123456789, "mm", -1.1, command)
        for command in ("synth momentary-dwell", "loads")
    ]
    found = Difference("old.yaml", "new.yaml", 1e-9, inputs, quantities)
    show_difference(found, Options())
    lines = capsys.readouterr().out.splitlines()
    assert max(map(len, lines)) <= 80
    # What was folded stands whole in its column: the names in the first one.
    start = lines.index(next(line for line in lines if line.startswith("inputs")))
    names = "".join(line.split()[0] for line in lines[start + 2 : lines.index("", start)] if not line.startswith(" "))
    assert names == f"{key}name"
    assert "1.23456789e-05" in "".join(lines)
    assert "-0.123456789" in "".join(lines)
    assert "quantities of synth momentary-dwell" in "\n".join(lines)
    monkeypatch.setenv("COLUMNS", "200")
    show_difference(found, Options())
    wide = capsys.readouterr().out
    assert key in wide
    assert "quantities of" not in wide


def _pairs() -> list[tuple[str, str]]:
    kinds: dict[str, list[str]] = {}
    for path in sorted(DESIGNS.glob("*.yaml")):
        kinds.setdefault(re.search(r"^kind: *(\S+)", path.read_text(), re.MULTILINE)[1], []).append(path.name)  # type: ignore[index]
    return [pair for names in kinds.values() for pair in list(combinations(names, 2))[:2]]


@pytest.mark.slow
@pytest.mark.parametrize(("old", "new"), _pairs())
def test_worked_designs_of_a_kind_differ_within_the_terminal(
    gearlink: Any, monkeypatch: pytest.MonkeyPatch, old: str, new: str
) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    lines = gearlink("diff", DESIGNS / old, DESIGNS / new).out.splitlines()
    assert max(map(len, lines[:-1]), default=0) <= 80  # the last one names the files


def test_markdown(gearlink: Any, two: Any) -> None:
    out = gearlink("diff", *two(CRANK, CRANK.replace("310", "341")), "--format", "md").out
    assert "## inputs\n\n| inputs | old | new | unit | change | command |" in out
    assert "| stroke | 310.0 | 341.0 | mm | +10 % |  |" in out


def test_members_of_a_pair_are_told_apart(gearlink: Any, two: Any) -> None:
    old = "kind: gear-pair\nmodule: 4\nteeth: [30, 40]\nprofile_shift: [0.2, 0.1]\n"
    found = gearlink("diff", *two(old, old.replace("0.2,", "0.25,")), "--format", "json").json
    assert names(found["inputs"]) == ["profile_shift[0]"]
    changed = names(found["quantities"])
    assert "root_radius[0]" in changed
    assert "root_radius[1]" not in changed


def test_a_check_that_turns_bad(gearlink: Any, two: Any) -> None:
    found = gearlink("diff", *two(LINKAGE, LINKAGE.replace("125", "121.4")), "--format", "json").json
    (collision,) = [change for change in found["checks"] if change["name"] == "GL301 gear-collision"]
    assert collision["detail"] == "pass -> fail"
    assert collision["unit"] == "mm"
    assert collision["new"] - collision["old"] == pytest.approx(-3.6, rel=1e-12, abs=0.0)


def test_a_changed_limit_is_told(gearlink: Any, two: Any) -> None:
    found = gearlink("diff", *two(LINKAGE, LINKAGE + "limits: {gear_gap: 0.5}\n"), "--format", "json").json
    assert names(found["inputs"]) == ["limits.gear_gap"]
    (collision,) = found["checks"]
    assert collision["detail"] == "pass, limit 0 -> 0.5"


def test_a_quantity_that_only_one_side_has(gearlink: Any, two: Any) -> None:
    """With a frame of 115 mm the output never steps back (the momentary dwell is at 115.52 mm)."""
    ended = gearlink("diff", *two(LINKAGE, LINKAGE.replace("125", "115")), "--format", "json")
    (step,) = [change for change in ended.json["quantities"] if change["name"] == "back_step_angle"]
    assert step["old"] > 0.0
    assert (step["new"], step["relative"], step["unit"]) == (None, None, "deg")


def test_sections_that_come_and_go(gearlink: Any, two: Any) -> None:
    ended = gearlink("diff", *two(LINKAGE, LINKAGE + "momentary: {eccentricity: 16}\n"), "--format", "json")
    assert ended.status == 1
    assert names(ended.json["inputs"]) == ["momentary.eccentricity", "command synth momentary-dwell"]


@pytest.mark.parametrize(("options", "status"), [((), 1), (("--tolerance", "1e-2"), 0), (("--tolerance", "0"), 1)])
def test_tolerance(gearlink: Any, two: Any, options: tuple[str, ...], status: int) -> None:
    assert gearlink("diff", *two(CRANK, CRANK.replace("310", "310.31")), *options).status == status


def test_rounding_is_no_change_by_default(gearlink: Any, two: Any) -> None:
    files = two(CRANK, CRANK.replace("310", "310.0000000000001"))
    assert gearlink("diff", *files).status == 0
    assert gearlink("diff", *files, "--tolerance", "0").status == 1


@pytest.mark.slow
def test_small_inputs_are_compared_by_their_magnitude(gearlink: Any, two: Any) -> None:
    """Half of a tolerance of 1e-9 deg is another design, though it is less than 1e-9."""
    window = LINKAGE + "dwell: {tolerance: 1e-9}\n"
    found = gearlink("diff", *two(window, window.replace("1e-9", "1.5e-9")), "--format", "json").json
    assert names(found["inputs"]) == ["dwell.tolerance"]


CHECKED = (
    '{"gearlink": 1, "kind": "flatbed-press", "name": "a", "command": "cam", "ok": true, "tables": {}, '
    '"quantities": {}, "checks": [{"code": "GL403", "name": "velocity-step", "status": "pass", "message": "", '
    '"unit": "mm/rad", "value": %s, "limit": %s}]}'
)


def test_rounding_of_what_is_zero_is_no_change_of_a_check(gearlink: Any, two: Any) -> None:
    """Not reported by itself, and not shown beside a limit that did change; JSON has both numbers as they are."""
    quiet = two(CHECKED % ("7.1e-15", "1.8e-4"), CHECKED % ("2.3e-13", "1.8e-4"), ".json")
    assert gearlink("diff", *quiet).status == 0
    files = two(CHECKED % ("7.1e-15", "1.8e-4"), CHECKED % ("2.3e-13", "1.9e-4"), ".json")
    for form in ("table", "md"):
        ended = gearlink("diff", *files, "--format", form)
        assert (ended.status, "7.1e-15" in ended.out, "2.3e-13" in ended.out) == (1, False, True)
    (check,) = gearlink("diff", *files, "--format", "json").json["checks"]
    assert (check["old"], check["new"], check["relative"]) == (7.1e-15, 2.3e-13, None)


def test_negative_tolerance_is_refused(gearlink: Any, two: Any) -> None:
    assert gearlink("diff", *two(CRANK, CRANK), "--tolerance", "-1").status == 2


# Results


def result(gearlink: Any, text: str, tmp_path: Path, *arguments: str) -> str:
    path = tmp_path / "design.yaml"
    path.write_text(text)
    return str(gearlink(*arguments, path, "--format", "json").out)


def test_results_with_tables(gearlink: Any, two: Any, tmp_path: Path) -> None:
    old = result(gearlink, LINKAGE, tmp_path, "analyze")
    new = result(gearlink, LINKAGE.replace("125", "126"), tmp_path, "analyze")
    assert gearlink("diff", *two(old, old, ".json")).status == 0
    ended = gearlink("diff", *two(old, new, ".json"), "--format", "json")
    assert ended.status == 1
    assert ended.json["inputs"] == []
    assert "frame_length" in names(ended.json["quantities"])
    (speed,) = [change for change in ended.json["tables"] if change["name"] == "motion.speed_ratio"]
    rows = [json.loads(text)["tables"]["motion"]["rows"] for text in (old, new)]
    worst = max(range(360), key=lambda row: abs(rows[1][row][2] - rows[0][row][2]))
    assert speed["detail"].endswith(f"most in row {worst}")
    assert (speed["old"], speed["new"]) == (rows[0][worst][2], rows[1][worst][2])
    assert "motion.crank_angle" not in names(ended.json["tables"])


def test_tables_of_other_length(gearlink: Any, two: Any, tmp_path: Path) -> None:
    old = result(gearlink, LINKAGE, tmp_path, "analyze")
    new = result(gearlink, LINKAGE, tmp_path, "analyze", "--samples", "12")
    (table,) = gearlink("diff", *two(old, new, ".json"), "--format", "json").json["tables"]
    assert table["old"].startswith("360 rows of crank_angle")
    assert table["new"].startswith("12 rows of crank_angle")


def test_a_table_of_one_side_only(gearlink: Any, two: Any, tmp_path: Path) -> None:
    old = json.loads(result(gearlink, LINKAGE, tmp_path, "analyze"))
    new = {**old, "tables": {}}
    (table,) = gearlink("diff", *two(json.dumps(old), json.dumps(new), ".json"), "--format", "json").json["tables"]
    assert (table["name"], table["new"]) == ("motion", None)


def test_results_of_a_batch(gearlink: Any, two: Any, tmp_path: Path) -> None:
    folder = tmp_path / "designs"
    folder.mkdir()
    texts = []
    for stroke in ("310", "311"):
        (folder / "crank.yaml").write_text(CRANK.replace("310", stroke))
        (folder / "pair.yaml").write_text(PAIR)
        texts.append(gearlink("batch", folder, "--format", "json").out)
    found = gearlink("diff", *two(*texts, ".json"), "--format", "json").json
    assert {change["command"] for change in found["quantities"]} == {"crank: crank", "crank: analyze"}
    assert gearlink("diff", *two(texts[0], texts[0], ".json")).status == 0


# Errors


def test_different_kinds(gearlink: Any, two: Any) -> None:
    ended = gearlink("diff", *two(CRANK, PAIR))
    assert ended.status == 2
    assert "GL117" in ended.err
    assert "a slider-crank and a gear-pair" in ended.err


def test_a_design_and_a_result(gearlink: Any, two: Any, tmp_path: Path) -> None:
    ended = gearlink("diff", *two(CRANK, result(gearlink, CRANK, tmp_path, "crank")))
    assert ended.status == 2
    assert "GL117" in ended.err


@pytest.mark.parametrize(
    "text",
    [
        '{"gearlink": 1, "errors": [{"code": "GL105"}]}',
        '{"gearlink": 1, "command": "check", "findings": []}',
        '{"gearlink": 1, "quantities": {}}',
        '{"gearlink": 1, "designs": [1]}',
        '{"gearlink": 1, "kind": "x", "command": "y", "quantities": {"a": 3}}',
        '{"gearlink": 1, "kind": "x", "command": "y", "quantities": {}, "checks": [{}]}',
        '{"gearlink": 1, "kind": "x", "command": "y", "quantities": {}, "tables": {"t": {"rows": 1}}}',
    ],
)
def test_json_that_is_no_result(gearlink: Any, two: Any, text: str) -> None:
    ended = gearlink("diff", *two(text, text, ".json"), "--format", "json")
    assert ended.status == 2
    assert ended.json["errors"][0]["code"] == "GL117"


def test_broken_json_is_read_as_a_design_file(gearlink: Any, two: Any) -> None:
    ended = gearlink("diff", *two('{"gearlink": 1', CRANK))
    assert ended.status == 2
    assert "GL103" in ended.err


RESULT = (
    '{"gearlink": 1, "kind": "slider-crank", "name": "a", "command": "crank", "ok": true, "checks": [], "tables": {}, '
    '"quantities": {"q": {"value": %s, "unit": "mm", "symbol": "x"}}}'
)


@pytest.mark.quick(2)
@pytest.mark.parametrize(
    ("old", "new", "status"),
    [
        ("1", "Infinity", 1),
        ("Infinity", "1e308", 1),
        ("1e999", "Infinity", 0),
        ("-Infinity", "Infinity", 1),
        ("[1, Infinity]", "[1, 2]", 1),
        ("1", "NaN", 1),
        ("1e308", "-1e308", 1),
    ],
)
def test_infinities(gearlink: Any, two: Any, old: str, new: str, status: int) -> None:
    files = two(RESULT % old, RESULT % new, ".json")
    for form in ("table", "md", "json"):
        assert gearlink("diff", *files, "--format", form).status == status
    found = gearlink("diff", *files, "--format", "json").out
    json.loads(found, parse_constant=lambda word: pytest.fail(f"{word} is no JSON"))


@pytest.mark.parametrize(
    ("value", "word"),
    [
        ("1" + "0" * 400, "401 digits"),
        ("-1" + "0" * 5000, "5001 digits"),
        ("[" * 100_000 + "]" * 100_000, "nested deeper"),
        ("[" * 500 + "]" * 500, "nested deeper"),
        ("[" * 20 + "]" * 20, "nested deeper"),
        ('"' + "x" * (1 << 20) + '"', "larger than 1 MiB"),
    ],
    ids=["10^400", "10^5000", "depth 100000", "depth 500", "depth 20", "1 MiB"],
)
def test_what_no_result_holds(gearlink: Any, two: Any, monkeypatch: pytest.MonkeyPatch, value: str, word: str) -> None:
    monkeypatch.setattr(diff, "LARGEST", 1 << 20)  # 64 of them take half a second
    ended = gearlink("diff", *two(RESULT % value, RESULT % "1", ".json"))
    assert ended.status == 2
    assert "GL117" in ended.err
    assert word in ended.err


@LINUX
def test_an_endless_file(gearlink: Any, two: Any) -> None:
    import resource

    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    ended = gearlink("diff", "/dev/zero", two(CRANK, CRANK)[0])
    assert ended.status == 2
    assert "GL110" in ended.err
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 100_000


def test_no_such_file(gearlink: Any, tmp_path: Path) -> None:
    ended = gearlink("diff", tmp_path / "a.yaml", tmp_path / "b.yaml")
    assert ended.status == 2
    assert "GL101" in ended.err


def test_a_mechanism_that_does_not_exist(gearlink: Any, two: Any) -> None:
    old, new = two(CRANK, CRANK.replace("310", "1040"))
    ended = gearlink("diff", old, new)
    assert ended.status == 2
    assert f"{new}:2:1: error GL112" in ended.err


# The comparison itself


@pytest.mark.quick(3)
@pytest.mark.parametrize(
    ("old", "new", "equal"),
    [
        (1.0, 1.0 + 1e-12, True),
        (1.0, 1.001, False),
        (1e6, 1e6 + 1e-4, True),
        (1e6, 1e6 + 1e-2, False),
        (0.0, 1e-12, True),
        (0, 0.0, True),
        ("a", "a", True),
        ("a", "b", False),
        (None, 0.0, False),
        (None, None, True),
        (1, True, False),
    ],
)
def test_same(old: Any, new: Any, equal: bool) -> None:
    assert same(old, new, 1e-9) is equal
    assert same(new, old, 1e-9) is equal


@pytest.mark.parametrize(
    ("old", "new", "relative"), [(2.0, 3.0, 0.5), (-2.0, -3.0, -0.5), (0.0, 1.0, None), ("a", 1.0, None)]
)
def test_relative_change(old: Any, new: Any, relative: float | None) -> None:
    assert relative_change(old, new) == relative


def test_help_has_an_example(gearlink: Any) -> None:
    assert "Example: gearlink diff" in gearlink("diff", "--help").out
