"""Plain command lines mean the same whether they are read directly or by Typer."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from sweeps import examples

import gearlink.cli.commands.animate
import gearlink.cli.commands.design
import gearlink.cli.commands.report
import gearlink.cli.commands.suggest
from gearlink.cli import app
from gearlink.cli.options import COMMANDS, OPTIONS, Format, Options, PlotFormat
from gearlink.cli.quick import plain_line, plain_reference, run_reference
from gearlink.core.base.kinds import KINDS

WORDS = st.sampled_from(["x.yaml", "a b", "-", "speed=4500", "teeth[1]=20", "crank_length", "press", "."])
WRITTEN = st.one_of(
    st.sampled_from(
        [
            "--plot",
            "--all",
            "--strict",
            "--profile",
            "--suggest",
            "--no-color",
            "--quiet",
            "-q",
            "--quiet=1",
            "-h",
            "--help",
            "--unknown",
            "--",
            "-",
            "",
        ]
    ),
    WORDS,
    st.tuples(
        st.sampled_from(
            [
                "--format",
                "-f",
                "--plot-format",
                "--out",
                "--set",
                "--quantity",
                "--table",
                "--samples",
                "--digits",
                "--form",
            ]
        ),
        st.sampled_from(
            [
                "json",
                "md",
                "csv",
                "svg",
                "out",
                "a=1",
                "-q",
                "",
                "12",
                "1",
                "1e3",
                " 7",
                "10000001",
                "JSON",
                "full",
                "²",
            ]
        ),
        st.booleans(),
    ).map(lambda t: f"{t[0]}={t[1]}" if t[2] else f"{t[0]}\0{t[1]}"),
)


def by_typer(arguments: list[str], monkeypatch: pytest.MonkeyPatch) -> Any:
    """What Typer hands to run_design; None where it refuses the line or asks for something else."""
    seen: list[Any] = []
    with monkeypatch.context() as patch:
        patch.setattr(gearlink.cli.commands.design, "run_design", lambda *line: seen.append(line) or 0)
        patch.setattr(gearlink.cli.commands.suggest, "run_suggested", lambda *line: seen.append(line) or 0)
        patch.setattr(gearlink.cli.commands.report, "run_report", lambda *line: seen.append(("report", *line)) or 0)
        patch.setattr(gearlink.cli.commands.animate, "run_animate", lambda *line: seen.append(("animate", *line)) or 0)
        app.invoke(arguments)
    found = seen[0] if seen else None
    if found is None or found[0] != "animate":
        return found
    _, source, asked, options = found
    return ("animate", source, options) if asked == gearlink.cli.commands.animate.Asked() else None


@examples(300)
@given(st.sampled_from([*COMMANDS, "report", "animate"]), st.lists(WRITTEN, max_size=4), WORDS, st.integers(0, 4))
def test_plain_lines_are_read_as_typer_reads_them(command: str, options: list[str], source: str, at: int) -> None:
    line = [part for option in [*options[:at], source, *options[at:]] for part in option.split("\0")]
    arguments = [*command.split(), *line]
    quick = plain_line(arguments)
    if quick is None:
        return
    with pytest.MonkeyPatch.context() as patch:
        assert quick == by_typer(arguments, patch)


def test_every_common_line_is_plain(monkeypatch: pytest.MonkeyPatch) -> None:
    for command in COMMANDS:
        arguments = [*command.split(), "x.yaml", "-f", "json", "--set", "a=1", "--set=b=2", "--samples", "12", "-q"]
        quick = plain_line(arguments)
        assert quick is not None
        assert quick == by_typer(arguments, monkeypatch)
        assert quick[2].overrides == ("a=1", "b=2")


@pytest.mark.parametrize(
    "arguments",
    [
        [],
        ["press"],
        ["press", "a.yaml", "b.yaml"],
        ["press", "a.yaml", "--help"],
        ["press", "a.yaml", "--set"],
        ["press", "a.yaml", "--set", "--plot"],
        ["press", "a.yaml", "--format", "xml"],
        ["press", "a.yaml", "--samples", "1"],
        ["press", "a.yaml", "--samples", "10000001"],
        ["press", "a.yaml", "--samples", "²"],
        ["press", "a.yaml", "--plo"],
        ["press", "a.yaml", "-qf", "json"],
        ["press", "a.yaml", "--quiet=1"],
        ["synth", "a.yaml"],
        ["batch", "designs"],
    ],
)
def test_anything_else_is_left_to_typer(arguments: list[str]) -> None:
    assert plain_line(arguments) is None


REFERENCES = [
    ["explain", "GL301"],
    ["explain", "no such"],
    ["new", "gear-pair"],
    ["new", "no-such"],
    ["schema", "gear-pair"],
    ["schema", "no-such"],
    ["verify", "khurmi-12.7"],
    ["verify", "no-such-book"],
    ["check", "ty460_slider_crank.yaml"],
    ["check", "ty460_slider_crank.yaml", "no_such.yaml"],
    ["batch", "ty460_slider_crank.yaml", "gear_pair.yaml", "no_such.yaml"],
    ["explore", "studies/gear_pair.yaml"],
    ["explore", "gear_pair.yaml"],
    ["sheet", "no_such.yaml", "motion"],
    pytest.param(["sheet", "gear_pair.yaml", "drawing"], marks=pytest.mark.slow),
]


@pytest.mark.parametrize("arguments", REFERENCES)
def test_reference_lines_do_what_typer_does(
    arguments: list[str],
    designs: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """The same text on both streams, the same status."""
    place = tmp_path / "designs"
    shutil.copytree(designs, place)
    monkeypatch.chdir(place)
    words = plain_reference(arguments)
    assert words is not None
    quick = run_reference(*words), *capsys.readouterr()
    assert quick == (app.invoke(arguments), *capsys.readouterr())


@pytest.mark.parametrize(
    "arguments",
    [
        [],
        ["explain"],
        ["explain", ""],
        ["explain", "GL301", "-f", "json"],
        ["new", "a", "b"],
        ["schema", "--write", "x"],
        ["check", "-"],
        ["check", "a.yaml", "--strict"],
        ["batch"],
        ["batch", "a", "--plot"],
        ["diff", "a"],
    ],
)
def test_other_reference_lines_are_left_to_typer(arguments: list[str]) -> None:
    assert plain_reference(arguments) is None


def test_a_report_takes_its_own_options_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    arguments = ["report", "x.yaml", "--out", "pages", "--set", "a=1", "--strict", "-q"]
    quick = plain_line(arguments)
    assert quick is not None
    assert quick == by_typer(arguments, monkeypatch)
    others = [["--plot"], ["-f", "json"], ["--samples", "12"], ["--no-color"]]
    assert [plain_line(["report", "x.yaml", *other]) for other in others] == [None] * len(others)


def test_an_animation_takes_its_own_options_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    arguments = ["animate", "x.yaml", "--out", "films", "--set", "a=1", "-q"]
    quick = plain_line(arguments)
    assert quick is not None
    assert quick == by_typer(arguments, monkeypatch)
    others = [["--plot"], ["--format", "html"], ["-f", "json"], ["--strict"], ["--fps", "10"], ["y.yaml"]]
    assert [plain_line(["animate", "x.yaml", *other]) for other in others] == [None] * len(others)


def test_every_shared_option_is_plain(monkeypatch: pytest.MonkeyPatch) -> None:
    texts = {"format": "md", "plot_format": "svg", "out": "pictures", "samples": "12", "round": "0.01", "dpi": "300"}
    texts["digits"] = "5"
    for name, option in OPTIONS.items():
        for flag in option.flags:
            arguments = ["press", "x.yaml", flag, *([] if option.type is bool else [texts.get(name, "a=1")])]
            quick = plain_line(arguments)
            assert quick is not None
            assert getattr(quick[2], name) != getattr(Options(), name)
            assert quick == by_typer(arguments, monkeypatch)


def test_commands_and_forms_are_those_of_the_program() -> None:
    own_options = {"tolerance", "register", "laws"}  # which Typer alone reads
    assert set(COMMANDS) | own_options == {command for kind in KINDS.values() for command in kind.commands}
    assert [form.value for form in Format] == ["table", "json", "csv", "md"]
    assert [form.value for form in PlotFormat] == ["png", "svg", "pdf"]
    found = plain_line(["cam", "x.yaml", "--plot", "--out", "pictures", "--plot-format=pdf"])
    assert found is not None
    assert (found[2].out, found[2].plot_format, found[2].plot) == (Path("pictures"), PlotFormat.PDF, True)
