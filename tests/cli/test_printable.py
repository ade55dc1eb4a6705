"""What strangers wrote (names of files and designs, lines of a file) does nothing where it is printed."""

from __future__ import annotations

import csv
import io
import json
import os
import re
import unicodedata
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from sweeps import ALL, mostly_slow

from gearlink.cli.printable import cell, glyphs, visible

CRANK = "kind: slider-crank\nstroke: 310\nrod: 520\noffset: 50\n"
NAMES = (
    "esc\x1b[31mred",
    "osc\x1b]0;title\x07",
    "c1\x9b31m",
    "nl\n::error file=pwn::gotcha",
    "cr\r##[error]x",
    "::add-mask::a",
    " ::stop-commands::x",
    "##[group]x",
    "##vso[task.setvariable variable=a]b",
    "bidi\u202egnp.exe\u2066",
    "ls\u2028x\u2029",
    "=cmd|calc!A1",
    "+1+1",
    "-1+1",
    "@SUM(A1)",
    "a|b <img src=x>",
    "-12",
)
COMMAND = re.compile(r"^\s*::|##\[|##vso\[", re.MULTILINE)


def harmless(text: str) -> bool:
    """As a terminal and the log of a CI see it."""
    shown = all(char == "\n" or unicodedata.category(char) not in {"Cc", "Cf", "Zl", "Zp", "Cs"} for char in text)
    return shown and not COMMAND.search(text)


@given(st.text(st.one_of(st.characters(), st.sampled_from(":#[\x1b\n\r\x9b\u202e"))))
def test_visible(text: str) -> None:
    for encoding in ("utf-8", "ascii"):
        shown = visible(text, encoding)
        assert harmless(shown)
        assert "\n" not in shown
        assert "::" not in shown
        assert "##" not in shown
        assert shown == "".join(glyphs(text, encoding))
        assert len(glyphs(text, encoding)) == len(text)
        shown.encode(encoding)


def test_what_is_ordinary_stays() -> None:
    for text in ("TY-460", "a: 1", "Kurbel Ø 40°", "中文", "# note", "x:\\y"):
        assert visible(text) == text


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("=1", "'=1"),
        ("+a", "'+a"),
        ("@x", "'@x"),
        ("-x", "'-x"),
        ("\t=1", "\\t=1"),
        ("\r=1", "\\r=1"),
        ("\uff1d1", "'\uff1d1"),
        ("a;=1;-2;@x; -3", "a;'=1;-2;'@x; -3"),
    ]
    + [(text, text) for text in ("-1", "+2.5", "-4e-13", "-inf", "a=b", "", "x-1")],
)
def test_no_cell_is_a_formula(text: str, shown: str) -> None:
    assert cell(text) == shown


@pytest.mark.parametrize("form", [[], ["--table", "motion"]])
def test_markdown_loads_no_picture_of_a_stranger(gearlink: Any, tmp_path: Path, form: list[str]) -> None:
    """In a comment of a pull request it would tell who reads it."""
    path = tmp_path / "x.yaml"
    path.write_text(CRANK + "name: '![x](https://example.org/t.png) [a] <b> &lt;'\n")
    other = tmp_path / "![x](y) <b>.yaml"
    other.write_text(CRANK)
    for line in (("crank", path, *form), ("batch", path), ("batch", other), ("diff", path, other)):
        out = gearlink(*line, "--format", "md").out
        assert "](" not in out
        assert "<b>" not in out
    assert gearlink("crank", path, "--format", "md").out.startswith(
        "# ![x]\\(https://example.org/t.png) [a] &lt;b> &amp;lt;: crank\n"
    )


@pytest.fixture(params=["pass", "fail", "wrong"])
def hostile(request: Any, tmp_path: Path, designs: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder of designs that pass, fail or are wrong, with hostile names and lines."""
    monkeypatch.chdir(tmp_path)
    text = {
        "pass": CRANK,
        "fail": re.sub(
            r"\nname:.*", "", (designs / "six_bar_two_trains.yaml").read_text().replace("mobility: 1", "mobility: 2")
        ),
        "wrong": "kind: slider-crank\n::add-mask::a: 1\n'##[error]b': 2\n\"\\e[31m\": {::x::: 3}\n",
    }[request.param]
    place = Path("files")
    place.mkdir()
    for i, name in enumerate(NAMES):
        (place / f"{name}.yaml").write_text(text)
        if request.param != "wrong":
            (place / f"named{i}.yaml").write_text(text + f"\nname: {json.dumps(name)}\n")
    return place


@pytest.mark.quick(1)
@pytest.mark.parametrize("form", mostly_slow(["csv", "table", "md"], 1))
def test_batch_and_check(gearlink: Any, hostile: Path, form: str) -> None:
    for command in ("batch", "check"):
        ended = gearlink(command, hostile, "--format", form)
        assert harmless(ended.out), command
        assert harmless(ended.err), command
        if form == "csv":
            for row in csv.reader(io.StringIO(ended.out)):
                assert not any(text[:1] in "=+-@" and not re.fullmatch(r"-?[\d.e+-]+", text) for text in row if text)


@pytest.mark.quick(1)
def test_annotations(gearlink: Any, hostile: Path) -> None:
    """Each line is one workflow command of the program's own."""
    for line in gearlink("batch", hostile, "--format", "github").out.splitlines():
        assert re.fullmatch(r"::(error|warning) file=[^:]*,title=GL\d+ [\w-]+::((?!::).)*", line)
        assert harmless(line[2:])


@pytest.mark.quick(1)
@pytest.mark.parametrize("form", mostly_slow(["table", "csv", "md"], 1))
def test_design_commands(gearlink: Any, hostile: Path, form: str) -> None:
    for path in sorted(hostile.iterdir())[:: 1 if ALL else 5]:  # batch and check print all of them
        for line in (("analyze", path), ("check", path), ("diff", path, path)):
            ended = gearlink(*line, *(() if line[0] == "diff" and form == "csv" else ("--format", form)))
            assert harmless(ended.out), path
            assert harmless(ended.err), path


def test_every_error_of_a_file_is_shown(gearlink: Any, tmp_path: Path) -> None:
    path = tmp_path / "x.yaml"
    path.write_text("kind: slider-crank\nstroke: a\nrodd: 5\noffset: [1]\nspeed: {}\n")
    codes = [(e["code"], e["line"]) for e in gearlink("check", path, "--format", "json").json["errors"]]
    assert len(codes) == 4
    for form in ("table", "csv", "md", "json", "jsonl", "junit", "sarif", "github"):
        out = gearlink("batch", path, "--format", form).out
        assert all(len(re.findall(rf"\b{code}\b", out)) >= 1 for code, _ in codes), form
        assert sum(out.count(code) for code in {code for code, _ in codes}) >= len(codes), form


def test_every_finding_of_a_design_is_shown(gearlink: Any, designs: Path) -> None:
    line = ("batch", designs / "thesis_example_3_as_printed.yaml", "--set", "limits.transmission_angle=85")
    findings = [
        "\n".join(
            (
                check["message"],
                *([f"fix: {check['fix']}"] if check["fix"] else []),
                *(f"note: {n}" for n in check["note"]),
            )
        )
        for design in gearlink(*line, "--format", "json").json["designs"]
        for check in design["checks"]
        if check["status"] != "pass"
    ]
    assert len(findings) > 1
    rows = list(csv.DictReader(io.StringIO(gearlink(*line, "--format", "csv").out)))
    assert sorted(row["finding"].partition(": ")[2] for row in rows) == sorted(
        finding.replace("\n", "\\n") for finding in findings
    )


@pytest.mark.slow
@pytest.mark.parametrize(
    "line",
    mostly_slow(["report", "animate --format html", "crank --format json", "crank --format csv", "crank --plot"], 4),
)
def test_a_file_name_that_is_no_utf8(gearlink: Any, tmp_path: Path, line: str) -> None:
    """The design has its name from the file, and pictures, pages and results bear it."""
    path = tmp_path / os.fsdecode(b"bad\xff.yaml")
    path.write_text(CRANK)
    command, *options = line.split()
    ended = gearlink(command, path, "--out", tmp_path / "out", *options)
    assert ended.status == 0, ended.err
    assert "\udcff" not in ended.out + ended.err


@pytest.mark.quick(2)
@pytest.mark.parametrize(
    "name", ["##vso[task.x]", "a##[error]\u202eb\u200b", "20° ###", "a\u061cb\U000e0041c\U0001d6fc"]
)
def test_json_keeps_the_name_and_shows_nothing_that_steers(
    gearlink: Any, designs: Path, tmp_path: Path, name: str
) -> None:
    text = (designs / "ring_pair.yaml").read_text().replace("name: pinion-in-ring", f"name: {_in_yaml(name)}")
    path = tmp_path / "pair.yaml"
    path.write_text(text)
    for line in (("gear", path), ("check", path), ("batch", path)):
        ended = gearlink(*line, "--format", "json")
        assert harmless(ended.out), line
        found = {"gear": [ended.json], "batch": ended.json.get("designs")}.get(line[0], [])
        assert [design["name"] for design in found] == [name] * len(found)


def _in_yaml(text: str) -> str:
    """Text as YAML escapes it; JSON would write a character beyond the first 65,536 in two halves, which are none."""
    return '"' + "".join(f"\\U{ord(char):08x}" for char in text) + '"'


LONG = "x" * 10_000


@pytest.mark.parametrize(
    "line",
    [
        pytest.param(("explain", LONG), marks=pytest.mark.slow),
        ("new", LONG),
        ("chart", LONG),
        ("crank", "SPEC", "--quantity", LONG),
        ("crank", "SPEC", "--table", LONG),
        ("sheet", "SPEC", LONG),
        ("check", "SPEC", "--set", f"tolerance.sources.{LONG}.plus_minus=1"),
        ("check", "SPEC", "--set", f"{LONG}=1"),
        ("laws", "--law", LONG),
    ],
    ids=lambda line: f"{line[0]} {line[-2][:12]}",
)
def test_a_long_name_is_cut_where_a_message_repeats_it(gearlink: Any, designs: Path, line: tuple[str, ...]) -> None:
    ended = gearlink(*(designs / "slider_crank_tolerances.yaml" if word == "SPEC" else word for word in line))
    assert ended.status == 2
    assert "x" * 30 in ended.err + ended.out
    assert "x" * 200 not in ended.err + ended.out
