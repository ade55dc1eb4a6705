"""The command line as a user meets it: options, formats, streams, exit status."""

from __future__ import annotations

import csv
import io
import os
import shlex
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from sweeps import mostly_slow
from systems import LINUX, UNIX

from gearlink.cli import main, process
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.render.csv_report import write_csv

ROOT = Path(__file__).resolve().parents[2]
CRANK = "kind: slider-crank\nstroke: 310\nrod: 520\noffset: 50\n"


@pytest.fixture
def crank(tmp_path: Path) -> Path:
    path = tmp_path / "bed-drive.yaml"
    path.write_text(CRANK)
    return path


PROGRAM = [sys.executable, "-m", "gearlink.cli.main"]
TYPED = shlex.join(PROGRAM)
"""The same on a line of a shell."""


def shell(*arguments: str, **options: Any) -> subprocess.CompletedProcess[bytes]:
    command = [*PROGRAM, *arguments]
    return subprocess.run(command, capture_output=True, cwd=ROOT, check=False, **options)


def test_version(gearlink: Any) -> None:
    ended = gearlink("--version")
    assert ended.status == 0
    assert ended.out.startswith("gearlink ")


def test_quantity_alone_prints_value_and_unit(gearlink: Any, crank: Path) -> None:
    ended = gearlink("crank", crank, "--quantity", "crank_length")
    assert ended.out == "154.21159203908383 mm\n" or abs(float(ended.out.split()[0]) - 154.21159203908383) < 1e-13 * 154
    assert ended.out.split()[1] == "mm"
    assert ended.err == ""


def test_several_quantities_are_named(gearlink: Any, crank: Path) -> None:
    ended = gearlink("crank", crank, "--quantity", "max_stroke", "--quantity", "quick_return_ratio")
    assert [line.split(" = ")[0] for line in ended.out.splitlines()] == ["max_stroke", "quick_return_ratio"]


def test_unknown_quantity_names_the_nearest(gearlink: Any, crank: Path) -> None:
    ended = gearlink("crank", crank, "--quantity", "crank_lenght")
    assert ended.status == ExitCode.WRONG_INPUT
    assert "crank_length" in ended.err
    assert ended.out == ""


def test_name_is_the_files_stem(gearlink: Any, crank: Path) -> None:
    assert gearlink("crank", crank, "--format", "json").json["name"] == "bed-drive"


def test_set_overrides_a_key(gearlink: Any, crank: Path) -> None:
    ended = gearlink("crank", crank, "--set", "offset=0", "--format", "json")
    assert ended.json["quantities"]["crank_length"]["value"] == 155.0


def test_wrong_set_is_located_there(gearlink: Any, crank: Path) -> None:
    ended = gearlink("crank", crank, "--set", "rod=-1", "--format", "json")
    assert ended.status == ExitCode.WRONG_INPUT
    assert ended.json["errors"][0]["file"] == "<--set>"
    assert ended.json["errors"][0]["key"] == "rod"


def test_mistyped_key(gearlink: Any, crank: Path) -> None:
    crank.write_text(CRANK.replace("stroke", "strok"))
    ended = gearlink("crank", crank)
    assert ended.status == ExitCode.WRONG_INPUT
    assert f"{crank}:2:1: error GL105" in ended.err
    assert "stroke" in ended.err
    assert "^" in ended.err


def test_standard_input(gearlink: Any, standard_input: Any) -> None:
    standard_input(CRANK.encode())
    ended = gearlink("crank", "-", "--format", "json")
    assert ended.status == 0
    assert ended.json["quantities"]["crank_length"]["unit"] == "mm"


def test_standard_input_in_errors(gearlink: Any, standard_input: Any) -> None:
    standard_input(b"kind: slider-crank\nrod: 3\n")
    ended = gearlink("crank", "-", "--format", "json")
    assert ended.status == 2
    assert ended.json["errors"][0]["file"] == "<stdin>"


def test_csv_blocks(gearlink: Any, designs: Path) -> None:
    ended = gearlink("press", designs / "ty460.yaml", "--format", "csv")
    blocks = [list(csv.reader(io.StringIO(block))) for block in ended.out.split("\n\n")]
    assert [block[0][0] for block in blocks] == ["quantity", "code", "input_angle [deg]"]
    assert len(blocks[2]) == 13


def test_csv_of_one_table_is_that_table(gearlink: Any, designs: Path) -> None:
    ended = gearlink("press", designs / "ty460.yaml", "--format", "csv", "--table", "positions", "--samples", "4")
    rows = list(csv.reader(io.StringIO(ended.out)))
    assert rows[0][0] == "input_angle [deg]"
    assert [float(row[0]) for row in rows[1:]] == [0.0, 90.0, 180.0, 270.0]


def test_markdown(gearlink: Any, crank: Path) -> None:
    ended = gearlink("crank", crank, "--format", "md")
    assert ended.out.startswith("# bed-drive: crank\n")
    assert "| `crank_length` | l1 | 154.2115920390838" in ended.out


@pytest.mark.parametrize("format", ["table", "md"])
def test_a_name_of_several_lines_stays_in_the_heading(gearlink: Any, crank: Path, format: str) -> None:
    ended = gearlink("crank", crank, "--set", r'name="a\nb"', "--format", format)
    assert ended.out.splitlines()[0].removeprefix("# ").startswith("a b: crank")


def test_errors_in_json_name_the_remedy(gearlink: Any, crank: Path) -> None:
    ended = gearlink("crank", crank, "--set", "strok=5", "--format", "json")
    assert ended.json["errors"][0]["help"].startswith("did you mean 'stroke'?")


def test_markdown_and_json_agree_to_the_last_digit(gearlink: Any, crank: Path) -> None:
    value = gearlink("crank", crank, "--format", "json").json["quantities"]["max_stroke"]["value"]
    assert repr(value) in gearlink("crank", crank, "--format", "md").out


def test_added_table(gearlink: Any, designs: Path) -> None:
    ended = gearlink("synth", "dwell", designs / "candy_feed.yaml", "--table", "motion", "--format", "json")
    assert len(ended.json["tables"]["motion"]["rows"]) == 360


def test_warning_counts_with_strict(gearlink: Any, designs: Path) -> None:
    path = designs / "thesis_example_1.yaml"
    assert gearlink("synth", "back-step", path).status == ExitCode.OK
    assert gearlink("synth", "back-step", path, "--strict").status == ExitCode.FINDING


def test_command_that_does_not_fit_the_kind(gearlink: Any, crank: Path) -> None:
    ended = gearlink("press", crank)
    assert ended.status == ExitCode.WRONG_INPUT
    assert "crank" in ended.err
    assert "kinds with `press`: flatbed-press; `gearlink new flatbed-press` writes a file of one" in ended.err


def test_missing_section(gearlink: Any, designs: Path) -> None:
    ended = gearlink("analyze", designs / "candy_feed.yaml", "--set", "dwell=null", "--format", "json")
    assert ended.status == ExitCode.WRONG_INPUT
    assert ended.json["errors"][0]["code"] == "GL113"
    assert ended.json["errors"][0]["key"] == "links"


def test_wrong_option_in_json(gearlink: Any, crank: Path) -> None:
    ended = gearlink("crank", crank, "--format", "json", "--nonsense")
    assert ended.status == ExitCode.WRONG_INPUT
    assert ended.json["errors"][0]["file"] == "<command line>"


def test_every_command_stands_under_a_heading(gearlink: Any) -> None:
    assert "More:" not in gearlink("--help").out


@pytest.mark.parametrize("words", [(), ("synth",), ("synth", "dwell"), ("explain",)])
def test_help_by_every_name(gearlink: Any, words: tuple[str, ...]) -> None:
    wanted = gearlink(*words, "--help").out
    assert wanted.startswith("Usage:")
    assert gearlink(*words, "-h").out == wanted
    assert gearlink("help", *words).out == wanted


@pytest.mark.parametrize("arguments", [(), ("synth",)])
def test_no_command_is_answered_with_help(gearlink: Any, arguments: tuple[str, ...]) -> None:
    ended = gearlink(*arguments)
    assert ended.status == ExitCode.WRONG_INPUT
    heading = "Commands:" if arguments else "Learn and start:"
    assert heading in ended.err
    assert "..." not in ended.err.partition(heading)[2]


@pytest.mark.parametrize("value", ["1e300", "-1e300", "1e-300", "5e-324"])
def test_numbers_that_no_machine_has_are_refused(gearlink: Any, crank: Path, value: str) -> None:
    ended = gearlink("crank", crank, "--set", f"rod={value}", "--format", "json")
    assert ended.status == ExitCode.WRONG_INPUT
    assert ended.json["errors"][-1]["message"] == f"rod is {float(value):g}, which no machine can have"


def test_missing_file(gearlink: Any) -> None:
    ended = gearlink("crank", "nowhere.yaml")
    assert ended.status == ExitCode.WRONG_INPUT
    assert "GL101" in ended.err


@pytest.mark.quick(3)
@pytest.mark.parametrize("width", [80, 160])
@pytest.mark.parametrize(
    ("command", "file"),
    [
        (("synth", "dwell"), "candy_feed.yaml"),
        (("analyze",), "thesis_example_3_as_printed.yaml"),
        (("press",), "ty460.yaml"),
        (("cam",), "ty460.yaml"),
        (("gear",), "ty460_input_gears.yaml"),
    ],
    ids=["synth", "analyze", "press", "cam", "gear"],
)
def test_tables_fit_the_width(
    gearlink: Any, designs: Path, monkeypatch: pytest.MonkeyPatch, width: int, command: tuple[str, ...], file: str
) -> None:
    monkeypatch.setenv("COLUMNS", str(width))
    ended = gearlink(*command, designs / file)
    lines = ended.out.splitlines()
    assert max(len(line.rstrip()) for line in lines) <= width
    assert "…" not in ended.out
    assert "\x1b" not in ended.out


@pytest.mark.quick(1)
@pytest.mark.parametrize("width", [1, 20, 45, 60])
def test_a_narrow_terminal_keeps_every_number(
    gearlink: Any, designs: Path, monkeypatch: pytest.MonkeyPatch, width: int
) -> None:
    monkeypatch.setenv("COLUMNS", "100")
    usual = gearlink("gear", designs / "ring_pair.yaml", "--all").out
    monkeypatch.setenv("COLUMNS", str(width))
    narrow = gearlink("gear", designs / "ring_pair.yaml", "--all").out
    numbers = [word for word in usual.partition("checks:")[0].split() if word.lstrip("-").replace(".", "").isdigit()]
    assert len(numbers) > 60
    assert set(numbers) <= set(narrow.split())
    assert "…" not in narrow


@pytest.mark.parametrize("line", ["batch nowhere -f json", "batch nowhere -f jsonl", "check nowhere -f json"])
def test_errors_before_any_file_are_in_json_too(gearlink: Any, line: str) -> None:
    ended = gearlink(*line.split())
    (error,) = ended.json["errors"]
    assert ended.status == ExitCode.WRONG_INPUT
    assert {"code", "message", "file", "line", "column", "key"} <= set(error)


def test_known_quantities_are_listed_once(gearlink: Any, designs: Path) -> None:
    ended = gearlink("analyze", designs / "candy_feed.yaml", "--quantity", "zzzzzz")
    assert ended.status == ExitCode.WRONG_INPUT
    assert "crank_length" in ended.err
    assert "more, which --all shows, and those of a mesh as MESH.NAME" in ended.err
    assert "crank_idler." not in ended.err


def test_a_file_for_a_folder_is_said_so(gearlink: Any, crank: Path, tmp_path: Path) -> None:
    (tmp_path / "taken").write_text("")
    ended = gearlink("crank", crank, "--plot", "--out", tmp_path / "taken")
    assert ended.status == ExitCode.WRONG_INPUT
    assert f"{tmp_path / 'taken'} is not a folder" in ended.err.replace("\n", "")
    assert (tmp_path / "taken").read_text() == ""


@pytest.mark.parametrize(("given", "folder"), [("films/a.gif", "films"), ("a.gif", ". for the current one")])
def test_a_name_of_a_file_is_answered_by_the_folder(gearlink: Any, crank: Path, given: str, folder: str) -> None:
    """The current folder was a dot that the end of a sentence swallowed."""
    ended = gearlink("animate", crank, "--out", given)
    assert ended.status == ExitCode.WRONG_INPUT
    assert f"help: give {folder}" in ended.err


@pytest.mark.slow
def test_ascii_terminal() -> None:
    environment = {**os.environ, "PYTHONIOENCODING": "ascii", "PYTHONUTF8": "0"}
    done = shell("synth", "dwell", "designs/candy_feed.yaml", env=environment)
    assert done.returncode == 0
    done.stdout.decode("ascii")


def bash(line: str) -> subprocess.CompletedProcess[bytes]:
    """A line of the shell, in the one locale that every system has: of another bash warns."""
    every = {**os.environ, "LC_ALL": "C"}
    return subprocess.run(["bash", "-c", line], capture_output=True, cwd=ROOT, env=every, check=False)


@UNIX
def test_closed_pipe_is_no_error() -> None:
    program = f"{TYPED} cam designs/ty460.yaml --format csv"
    command = f"{program} | head -n 1; exit ${{PIPESTATUS[0]}}"
    done = bash(command)
    assert done.stderr == b""
    assert done.returncode == 0


@pytest.mark.parametrize("read", [True, False])
def test_no_more_rows_are_made_than_somebody_reads(read: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """The reader of standard output has gone by the first row, or a pipe besides it has lost its own."""
    monkeypatch.setattr(process, "output_is_read", True)
    begun, given = [], os.pipe()
    os.close(given[0])
    monkeypatch.setattr(main, "_STANDARD_OUTPUT", 1 if read else given[1])

    def rows() -> Iterator[tuple[int]]:
        for number in range(100):
            begun.append(number)
            yield (number,)

    table = SimpleNamespace(columns=("x",), units=("1",), each_row=rows)
    report: Any = SimpleNamespace(quantities=(), checks=(), tables=[table])
    raw = main._Output(given[1], "w")
    raw.ignored = BrokenPipeError
    with io.TextIOWrapper(raw, write_through=True) as stream:
        write_csv(report, stream)
    assert len(begun) == (100 if read else 1)


_FAILS = "designs/thesis_example_3_as_printed.yaml"


@UNIX
@pytest.mark.slow
@pytest.mark.parametrize(
    ("line", "status"),
    mostly_slow(
        [
            (f"check -q {_FAILS}", 1),
            ("schema", 0),
            ("cam designs/ty460.yaml", 0),
            ("laws --law cycloidal", 0),
            ("--help", 0),
            (f"analyze {_FAILS}", 1),
            (f"batch {_FAILS}", 1),
        ],
        1,
    ),
)
def test_a_reader_that_leaves_early_does_not_change_the_status(line: str, status: int) -> None:
    pipe = f"set -o pipefail; {TYPED} {line} | true"
    ended = bash(pipe)
    assert (ended.returncode, ended.stderr) == (status, b"")


@LINUX
@pytest.mark.parametrize(
    ("line", "status"),
    mostly_slow([("crank nosuch.yaml", 2), ("nosuch", 2), (f"analyze {_FAILS} --plot --out OUT", 1)], 1),
)
def test_notes_that_cannot_be_written_do_not_change_the_status(line: str, status: int, tmp_path: Path) -> None:
    command = [*PROGRAM, *shlex.split(line.replace("OUT", shlex.quote(str(tmp_path))))]
    with open("/dev/full", "w") as full:
        ended = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=full, cwd=ROOT, check=False)
    assert ended.returncode == status


@pytest.mark.slow
def test_the_backend_of_the_environment_does_not_matter(tmp_path: Path) -> None:
    environment = {**os.environ, "MPLBACKEND": "bogus"}
    done = shell("crank", "designs/ty460_slider_crank.yaml", "--plot", "--out", str(tmp_path), env=environment)
    assert done.returncode == 0
    assert (tmp_path / "TY-460-slider-crank-crank.png").exists()


def test_a_width_of_nothing_is_an_unknown_width(gearlink: Any, crank: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    usual = gearlink("crank", crank).out
    monkeypatch.setenv("COLUMNS", "0")
    assert gearlink("crank", crank).out == usual != ""


@pytest.mark.parametrize("size", ["²", "٨٠²", "9" * 5000, "8" * 10])
def test_a_size_of_the_terminal_that_is_none_counts_as_none(monkeypatch: pytest.MonkeyPatch, size: str) -> None:
    from gearlink.cli import main

    monkeypatch.setenv("MPLBACKEND", "agg")
    monkeypatch.setenv("COLUMNS", size)
    monkeypatch.setenv("LINES", "24")
    monkeypatch.setattr(main.process, "collect_rarely", lambda: None)
    for name in ("PYDANTIC_DISABLE_PLUGINS", "OPENBLAS_NUM_THREADS"):
        monkeypatch.setenv(name, "1")
    main._prepare_process()
    assert "COLUMNS" not in os.environ
    assert os.environ["LINES"] == "24"


def test_an_interrupt_before_the_command_has_begun(monkeypatch: pytest.MonkeyPatch) -> None:
    from gearlink.cli import main

    def interrupted() -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(main, "_prepare_process", interrupted)
    monkeypatch.setattr(main.gc, "freeze", lambda: None)
    with pytest.raises(SystemExit) as ended:
        main.main()
    assert ended.value.code == ExitCode.INTERRUPTED


@pytest.mark.quick(3)
@pytest.mark.parametrize("share", ["١/٢", "1/²", "1/+2", " 1/2", "0/2", "3/2", "1", "1/"])
def test_a_share_is_written_in_plain_digits(gearlink: Any, crank: Path, share: str) -> None:
    ended = gearlink("batch", crank, "--shard", share)
    assert ended.status == ExitCode.WRONG_INPUT
    assert "--shard" in ended.err


@LINUX
@pytest.mark.parametrize("line", mostly_slow(["--version", "crank designs/ty460_slider_crank.yaml"], 1))
def test_a_full_disk_is_said_without_traceback(line: str) -> None:
    command = [*PROGRAM, *line.split()]
    with open("/dev/full", "w") as full:
        ended = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, cwd=ROOT, check=False)
    assert (ended.returncode, ended.stderr) == (
        2,
        b"error: standard output cannot be written: No space left on device\n",
    )


@UNIX
@pytest.mark.slow
@pytest.mark.parametrize(
    ("line", "status"),
    mostly_slow(
        [("crank designs/ty460_slider_crank.yaml >&-", 0), ("crank - <&-", 2), ("crank nosuch.yaml 2>&-", 2)], 1
    ),
)
def test_closed_streams(line: str, status: int) -> None:
    shell = f"{TYPED} {line}"
    ended = bash(shell)
    assert ended.returncode == status
    assert b"fault" not in ended.stderr


def test_a_fault_is_said_in_one_line(gearlink: Any, crank: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object, **__: object) -> None:
        raise ZeroDivisionError("planted")

    monkeypatch.setattr("gearlink.cli.commands.design.build", broken)
    ended = gearlink("crank", crank)
    assert ended.status == ExitCode.FAULT
    assert "ZeroDivisionError: planted" in ended.err
    assert "Traceback" not in ended.err


class TestBatch:
    def test_one_broken_file_is_a_line(self, gearlink: Any, tmp_path: Path) -> None:
        (tmp_path / "good.yaml").write_text(CRANK)
        (tmp_path / "sub").mkdir()
        (tmp_path / "sub" / "bad.yaml").write_text("kind: slider-crank\nrod: [\n")
        ended = gearlink("batch", tmp_path, "--format", "json")
        assert ended.status == ExitCode.WRONG_INPUT
        results = {Path(d["file"]).name: d["result"] for d in ended.json["designs"]}
        assert results == {"good.yaml": "pass", "bad.yaml": "error"}
        assert ended.json["summary"]["pass"] == 2

    def test_worst_status(self, gearlink: Any, designs: Path) -> None:
        ended = gearlink("batch", designs / "thesis_example_2.yaml", designs / "thesis_example_3_as_printed.yaml")
        assert ended.status == ExitCode.FINDING
        assert "thesis_example_3_as_printed.yaml" in ended.out

    def test_all_that_a_file_asks_for(self, gearlink: Any, designs: Path) -> None:
        ended = gearlink("batch", designs / "ty460.yaml", "--format", "json")
        assert [d["command"] for d in ended.json["designs"]] == ["press", "cam", "gear"]

    def test_nothing_to_do_is_an_error(self, gearlink: Any, tmp_path: Path) -> None:
        ended = gearlink("batch", tmp_path)
        assert ended.status == ExitCode.WRONG_INPUT
        assert "no design file" in ended.err

    def test_fault_in_one_design_does_not_end_the_batch(
        self, gearlink: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        for name in ("a", "b"):
            (tmp_path / f"{name}.yaml").write_text(CRANK)
        from gearlink.cli.batch import run

        original = run.build

        def sometimes(loaded: Any, kind: Any, command: str, spec: Any, *rest: Any, **options: Any) -> Any:
            if spec.name == "a":
                raise ZeroDivisionError("planted")
            return original(loaded, kind, command, spec, *rest, **options)

        monkeypatch.setattr(run, "build", sometimes)
        ended = gearlink("batch", tmp_path, "--format", "json")
        assert ended.status == ExitCode.FAULT
        assert [d["result"] for d in ended.json["designs"]] == ["fault", "pass", "pass"]


@LINUX
def test_a_process_with_too_little_memory_says_so() -> None:
    """Below the limit libraries would end the process with status 1, which says that a check failed."""
    line = f"ulimit -v 200000; {TYPED} check {_FAILS}"
    ended = bash(line)
    assert (ended.returncode, ended.stdout) == (2, b"")
    assert ended.stderr.startswith(b"error: the memory of this process is limited to 195 MB")


@LINUX
@pytest.mark.slow
@pytest.mark.parametrize("line", ["crank designs/ty460_slider_crank.yaml", "report designs/ty460.yaml --out OUT -q"])
def test_the_least_memory_suffices(line: str, tmp_path: Path) -> None:
    command = f"{TYPED} {line.replace('OUT', shlex.quote(str(tmp_path)))}"
    shell = f"ulimit -v {500 << 10}; {command}"
    ended = bash(shell)
    assert (ended.returncode, ended.stderr) == (0, b"")


def test_no_memory_is_no_fault_of_the_program(gearlink: Any, crank: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object, **__: object) -> None:
        raise MemoryError

    monkeypatch.setattr("gearlink.cli.commands.design.build", broken)
    ended = gearlink("crank", crank)
    assert (ended.status, ended.err[:20]) == (ExitCode.WRONG_INPUT, "error: out of memory")


@pytest.mark.quick(3)
@pytest.mark.parametrize(
    "words", [["chart"], ["new"], ["explain"], ["laws"], ["gears", "--ratio", "2", "--center-distance", "150"]]
)
def test_lists_fit_the_terminal(gearlink: Any, monkeypatch: pytest.MonkeyPatch, words: list[str]) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    assert max(map(len, gearlink(*words).out.splitlines())) <= 80
