"""`batch`: whatever the format, the number of processes or the share, the outcomes are the same."""

from __future__ import annotations

import errno
import gc
import itertools
import json
import os
import re
import signal
import subprocess
import sys
import time
import weakref
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
from sweeps import ALL

from gearlink.cli.exit_codes import ExitCode

ROOT = Path(__file__).resolve().parents[3]
CRANK = "kind: slider-crank\nstroke: {stroke}\nrod: 520\noffset: 50\n"
BROKEN = "kind: slider-crank\nrod: 5\n"
MANY = 24 if ALL else 8


@pytest.fixture
def folder(tmp_path: Path, designs: Path) -> Path:
    """Designs of every verdict: pass, warn, fail, error; one in a sub-folder, one hidden, one not a design."""
    (tmp_path / "sub").mkdir()
    (tmp_path / ".hidden").mkdir()
    (tmp_path / "pass.yaml").write_text(CRANK.format(stroke=310))
    (tmp_path / "sub" / "warn.yaml").write_text((designs / "thesis_example_1.yaml").read_text())
    (tmp_path / "fail.yml").write_text((designs / "thesis_example_3_as_printed.yaml").read_text())
    (tmp_path / "wrong.yaml").write_text(BROKEN)
    (tmp_path / ".hidden" / "x.yaml").write_text("not: seen")
    (tmp_path / "notes.txt").write_text("not a design")
    return tmp_path


def plain(ended: Any) -> list[dict[str, Any]]:
    """The designs of a JSON result without what may differ from run to run."""
    return [{k: v for k, v in d.items() if k not in ("seconds", "unchanged")} for d in ended.json["designs"]]


def test_verdicts(gearlink: Any, folder: Path) -> None:
    ended = gearlink("batch", folder, "--format", "json")
    verdicts = {Path(d["file"]).name: d["result"] for d in ended.json["designs"]}
    assert verdicts == {"pass.yaml": "pass", "warn.yaml": "warn", "fail.yml": "fail", "wrong.yaml": "error"}
    assert ended.status == ExitCode.WRONG_INPUT
    assert not ended.json["ok"]


def test_processes_change_nothing(gearlink: Any, folder: Path) -> None:
    for i in range(MANY):
        (folder / f"crank_{i:02}.yaml").write_text(CRANK.format(stroke=100 + i))
    one = gearlink("batch", folder, "--format", "json", "-j", "1")
    two = gearlink("batch", folder, "--format", "json", "-j", "2")
    assert plain(one) == plain(two)
    assert len(plain(one)) == 5 + 2 * MANY


def test_shares_make_up_the_whole(gearlink: Any, folder: Path) -> None:
    whole = plain(gearlink("batch", folder, "--format", "json"))
    parts = [d for i in (1, 2, 3) for d in plain(gearlink("batch", folder, "--format", "json", "--shard", f"{i}/3"))]
    assert sorted(parts, key=lambda d: d["file"]) == whole


@pytest.mark.parametrize("share", ["0/2", "3/2", "x", "1/", "-1/2"])
def test_wrong_share(gearlink: Any, folder: Path, share: str) -> None:
    assert gearlink("batch", folder, "--shard", share).status == ExitCode.WRONG_INPUT


def test_warning_as_failure(gearlink: Any, folder: Path) -> None:
    path = folder / "sub"
    assert gearlink("batch", path).status == ExitCode.OK
    assert gearlink("batch", path, "--fail-on", "warning").status == ExitCode.FINDING


def test_pattern(gearlink: Any, folder: Path) -> None:
    ended = gearlink("batch", f"{folder}/*.yml", "--format", "json")
    assert [Path(d["file"]).name for d in ended.json["designs"]] == ["fail.yml"]


class TestOut:
    @pytest.mark.usefixtures("small_pictures")
    def test_reports_tables_and_plots(self, gearlink: Any, designs: Path, tmp_path: Path) -> None:
        out = tmp_path / "out"
        gearlink("batch", designs / "ty460_slider_crank.yaml", "--out", out, "--plot")
        gearlink("batch", designs / "ty460.yaml", "--out", out)
        names = {path.name for path in out.rglob("*") if path.is_file()}
        assert {"ty460_slider_crank-crank.json", "ty460_slider_crank-crank.png", "ty460-press-positions.csv"} <= names
        report = json.loads(next(out.rglob("ty460-cam.json")).read_text())
        assert report["command"] == "cam"

    def test_plot_without_place(self, gearlink: Any, designs: Path) -> None:
        assert gearlink("batch", designs, "--plot").status == ExitCode.WRONG_INPUT

    def test_place_that_cannot_be_written(self, gearlink: Any, folder: Path, tmp_path: Path) -> None:
        blocked = tmp_path / "blocked"
        blocked.write_text("")
        ended = gearlink("batch", folder / "pass.yaml", "--out", blocked, "--format", "json")
        assert ended.status == ExitCode.WRONG_INPUT
        assert ended.json["designs"][0]["errors"][0]["code"] == "GL116"


class TestFormats:
    def test_json_lines(self, gearlink: Any, folder: Path) -> None:
        ended = gearlink("batch", folder, "--format", "jsonl")
        found = [json.loads(line)["result"] for line in ended.out.splitlines()]
        assert found == ["fail", "pass", "pass", "warn", "error"]

    def test_junit(self, gearlink: Any, folder: Path) -> None:
        root = ElementTree.fromstring(gearlink("batch", folder, "--format", "junit").out.split("\n", 1)[1])
        suites = {Path(s.get("name", "")).name: s for s in root.iter("testsuite")}
        assert suites["fail.yml"].get("failures") == "1"
        assert suites["wrong.yaml"].get("errors") == "1"
        assert suites["pass.yaml"].find("testcase/failure") is None
        failure = suites["fail.yml"].find("testcase/failure")
        assert failure is not None
        assert "interference of" in failure.get("message", "")

    def test_junit_says_hostile_names_as_they_are(self, gearlink: Any, tmp_path: Path) -> None:
        name = """a"b'c <d> &amp; ]]> \u00e9\t"""
        path = tmp_path / "x'&<.yaml"
        path.write_text(f"kind: slider-crank\nname: {json.dumps(name)}\nstroke: 310\nrod: 520\noffset: 50\n")
        text = gearlink("batch", path, "--format", "junit").out
        (case, motion) = ElementTree.fromstring(text.split("\n", 1)[1]).iter("testcase")
        (suite,) = ElementTree.fromstring(text.split("\n", 1)[1]).iter("testsuite")
        assert suite.get("name") == str(path)
        assert [case.get("name"), motion.get("name")] == [f"{name}: crank", f"{name}: analyze"]

    def test_sarif(self, gearlink: Any, folder: Path) -> None:
        sarif = json.loads(gearlink("batch", folder, "--format", "sarif").out)
        run = sarif["runs"][0]
        assert {rule["id"] for rule in run["tool"]["driver"]["rules"]} == {r["ruleId"] for r in run["results"]}
        collision = next(rule for rule in run["tool"]["driver"]["rules"] if rule["id"] == "GL301")
        assert collision["shortDescription"]["text"] == "gears interfere"
        assert collision["help"]["text"].startswith("Lengthen the frame")
        levels = {(r["ruleId"], r["level"]) for r in run["results"]}
        assert {("GL301", "error"), ("GL302", "warning"), ("GL106", "error")} <= levels

    def test_a_fix_of_sarif_put_into_the_file_repairs_it(self, gearlink: Any, tmp_path: Path) -> None:
        path = tmp_path / "colliding.yaml"
        path.write_text(
            "kind: three-gear-four-bar\ngears: {module: 2.5, crank: 20, idler: 20, output: 60}\n"
            "links:\n  crank: 18\n  frame: 121.4   # too short\n"
        )
        out = gearlink("batch", path, "--format", "sarif").out
        (result,) = (r for r in json.loads(out)["runs"][0]["results"] if r["ruleId"] == "GL301")
        (change,) = result["fixes"][0]["artifactChanges"]
        assert change["artifactLocation"] == result["locations"][0]["physicalLocation"]["artifactLocation"]
        (replacement,) = change["replacements"]
        region, lines = replacement["deletedRegion"], path.read_text().splitlines(keepends=True)
        row = lines[region["startLine"] - 1]
        assert row[region["startColumn"] - 1 : region["endColumn"] - 1] in ("18", "121.4")
        new = row[: region["startColumn"] - 1] + replacement["insertedContent"]["text"] + row[region["endColumn"] - 1 :]
        lines[region["startLine"] - 1] = new
        path.write_text("".join(lines))
        assert gearlink("analyze", path).status == ExitCode.OK
        overridden = gearlink(
            "batch", path, "--format", "sarif", "--set", "links.crank=18", "--set", "links.frame=121.4"
        ).out
        (result,) = (r for r in json.loads(overridden)["runs"][0]["results"] if r["ruleId"] == "GL301")
        assert "fixes" not in result

    def test_a_fix_of_several_values(self, gearlink: Any, tmp_path: Path) -> None:
        path = tmp_path / "small.yaml"
        path.write_text(
            "kind: three-gear-four-bar\ngears: {module: 2, crank: 14, idler: 40, output: 40}\n"
            "links: {crank: 10, frame: 90}\n"
        )
        (result,) = (
            r
            for r in json.loads(gearlink("batch", path, "--format", "sarif").out)["runs"][0]["results"]
            if r["ruleId"] == "GL201"
        )
        (change,) = result["fixes"][0]["artifactChanges"]
        lines = path.read_text().splitlines(keepends=True)
        for replacement in reversed(change["replacements"]):
            region, text = replacement["deletedRegion"], replacement["insertedContent"]["text"]
            row, start, end = lines[region["startLine"] - 1], region["startColumn"] - 1, region["endColumn"] - 1
            assert row[start:end] in ("14", "40")
            lines[region["startLine"] - 1] = row[:start] + text + row[end:]
        assert len(change["replacements"]) == 2
        path.write_text("".join(lines))
        assert gearlink("analyze", path).status == ExitCode.OK

    @pytest.mark.slow
    @pytest.mark.parametrize("form", ["junit", "sarif", "github"])
    def test_what_is_skipped_changes_no_finding(self, gearlink: Any, folder: Path, tmp_path: Path, form: str) -> None:
        line = ("batch", folder, "--format", form, "--out", tmp_path / ".out", "--unchanged", "skip")
        first, again = (re.sub(r'time="[\d.]+"', "", gearlink(*line).out) for _ in range(2))
        assert first == again
        assert "fail.yml" in first

    def test_what_is_set_over_a_file_keeps_its_line(self, gearlink: Any, folder: Path) -> None:
        out = gearlink("batch", folder / "fail.yml", "--format", "github", "--set", "links.crank=25.01").out
        line = next(
            i for i, text in enumerate((folder / "fail.yml").read_text().splitlines(), 1) if text[:6] == "links:"
        )
        assert f"line={line}," in next(text for text in out.splitlines() if "GL301" in text)

    def test_findings_stand_at_their_line(self, gearlink: Any, folder: Path) -> None:
        results = json.loads(gearlink("batch", folder, "--format", "sarif").out)["runs"][0]["results"]
        (collision,) = (r for r in results if r["ruleId"] == "GL301")
        line = collision["locations"][0]["physicalLocation"]["region"]["startLine"]
        assert (folder / "fail.yml").read_text().splitlines()[line - 1].startswith("links:")

    def test_github(self, gearlink: Any, folder: Path) -> None:
        ended = gearlink("batch", folder, "--format", "github")
        lines = ended.out.splitlines()
        assert re.search(r"^\d+ results: \d+ pass, .*fail", ended.err, re.MULTILINE)
        assert gearlink("batch", folder, "--format", "github", "--quiet").err == ""
        pattern = re.compile(r"::(error|warning) file=[^,]+,line=\d+,col=\d+,title=GL\d{3} [\w-]+::.+")
        assert lines
        assert all(pattern.fullmatch(line) for line in lines)

    def test_github_is_told_once_what_two_commands_find(self, gearlink: Any, tmp_path: Path) -> None:
        """A planet of 16 teeth is undercut: `analyze` and `gear` find it."""
        links = "links: {crank: 29, coupler: 100, rocker: 90, frame: 110}"
        (tmp_path / "a.yaml").write_text(
            f"kind: two-gear-four-bar\ngears: {{module: 1, planet: 16, sun: 42}}\n{links}\n"
        )
        lines = gearlink("batch", tmp_path, "--format", "github").out.splitlines()
        (told,) = (line for line in lines if "GL201" in line)
        assert "::a (analyze, gear): profile shift" in told
        assert len(set(lines)) == len(lines)

    @pytest.mark.quick(3)
    @pytest.mark.parametrize("form", ["table", "csv", "md", "github", "junit", "sarif"])
    def test_a_wrong_file_is_told_its_remedy(self, gearlink: Any, tmp_path: Path, form: str) -> None:
        (tmp_path / "a.yaml").write_text("kind: slider-crank\nstroek: 310\nrod: 520\noffset: 50\n")
        out = gearlink("batch", tmp_path, "--format", form).out
        told = re.sub(r"<br>|%0A|\\n|\\s+", " ", out).replace("&apos;", "'")
        assert "unknown key 'stroek' help: did you mean 'stroke'?" in " ".join(told.split())

    @pytest.mark.quick(1)
    @pytest.mark.parametrize("form", ["table", "csv", "md"])
    def test_readers(self, gearlink: Any, folder: Path, form: str) -> None:
        out = gearlink("batch", folder, "--format", form).out
        assert "interference of the crank gear and the output gear: 1.6 mm" in " ".join(out.split())


def test_only_json_computes_tables(gearlink: Any, designs: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from gearlink.core.machines.flatbed_press.design import FlatbedPress

    def fail(self: object) -> None:
        raise AssertionError("a table that nobody reads")

    monkeypatch.setattr(FlatbedPress, "table_positions", fail)
    assert gearlink("batch", designs / "ty460.yaml").status == ExitCode.OK


def _written(folder: Path) -> int:
    return sum(1 for _ in folder.rglob("*.json"))


@pytest.mark.slow
def test_interrupt_keeps_what_is_finished(tmp_path: Path, designs: Path) -> None:
    press = (designs / "ty460.yaml").read_text()
    for i in range(500):
        (tmp_path / f"press_{i:04}.yaml").write_text(press)
    out_files = tmp_path / ".out"
    command = [sys.executable, "-m", "gearlink.cli.main", "batch", str(tmp_path), "--format", "jsonl"]
    command += ["--out", str(out_files)]
    environment = {**os.environ, "PYTHONUNBUFFERED": "1"}
    lines = (tmp_path / ".lines").open("w+b")  # a pipe that nobody reads would stop the batch
    process = subprocess.Popen(
        command,
        stdout=lines,
        stderr=subprocess.PIPE,
        cwd=ROOT,
        env=environment,
        # A runner started in the background hands an ignored SIGINT down to its children.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    try:
        while (begun := _written(out_files)) < 30:  # so some have come back whole
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=60)  # no verdict on the speed of a busy machine: see `later`
    finally:
        process.kill()
        process.communicate()
    assert process.returncode == ExitCode.INTERRUPTED, err
    assert b"Traceback" not in err
    with lines:
        lines.seek(0)
        found = [json.loads(line)["file"] for line in lines]
    assert 0 < len(found) < 1500
    assert found == sorted(found)
    # How soon it ends is told by the work done after the signal, which does not depend on who else computes: what the
    # processes had in reserve, a quarter of a second each, not what was left.
    later = _written(out_files) - begun
    assert later < 600, f"{later} of 1500 results written after the interrupt"


@pytest.mark.skipif(sys.platform != "linux", reason="forked processes")
def test_what_is_finished_is_not_computed_again_where_processes_fail(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from gearlink.cli.batch import run
    from gearlink.cli.batch.options import BatchOptions
    from gearlink.cli.batch.summary import Outcome

    real = run.workers

    @contextmanager
    def failing(count: int) -> Iterator[Any]:
        with real(count) as executor:
            yield executor
        raise OSError("no descriptors are left")

    monkeypatch.setattr(run, "outcomes", lambda path, _: [Outcome(str(path), "", path.stem, "", 0)])
    monkeypatch.setattr(run, "workers", failing)
    results, _ = run.run_files([tmp_path / f"{i:03}" for i in range(100)], BatchOptions(jobs=2))
    assert len(results) == len({result.file for result in results}) == 100


@pytest.mark.quick(1)
@pytest.mark.skipif(sys.platform != "linux", reason="forked processes")
@pytest.mark.parametrize("deadly", [{"064"}, {"070", "071", "092"}])
def test_a_process_that_dies_costs_its_one_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str], deadly: set[str]
) -> None:
    from gearlink.cli.batch import run
    from gearlink.cli.batch.options import BatchOptions
    from gearlink.cli.batch.summary import Outcome

    parent = os.getpid()

    def outcome(path: Path, _: BatchOptions) -> list[Outcome]:
        if os.getpid() != parent and path.name in deadly:
            os.kill(os.getpid(), signal.SIGKILL)
        return [Outcome(str(path), "", path.stem, "", 0)]

    monkeypatch.setattr(run, "outcomes", outcome)
    results, interrupted = run.run_files([tmp_path / f"{i:03}" for i in range(100)], BatchOptions(jobs=2))
    assert not interrupted
    assert len(results) == len({result.file for result in results}) == 100
    assert {Path(result.file).name for result in results if result.errors} == deadly
    assert capfd.readouterr().err == ""


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="forked processes")
def test_files_that_take_their_time_are_left_to_the_processes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """One tried file of a fifth of a second says enough; no second one waits here for its turn."""
    from gearlink.cli.batch import run
    from gearlink.cli.batch.options import BatchOptions
    from gearlink.cli.batch.summary import Outcome

    parent, first = os.getpid(), tmp_path / "00"

    def outcome(path: Path, _: BatchOptions) -> list[Outcome]:
        time.sleep(0.2 if path == first else 0.0)
        return [Outcome(str(path), "here" if os.getpid() == parent else "there", path.stem, "", 0)]

    monkeypatch.setattr(run, "outcomes", outcome)
    monkeypatch.setattr(run, "processors", lambda: 2)
    found, _ = run.run_files([tmp_path / f"{i:02}" for i in range(40)], BatchOptions(jobs=2))
    assert len({outcome.file for outcome in found}) == len(found) == 40
    assert [Path(outcome.file).name for outcome in found if outcome.kind == "here"] == ["00"]


@pytest.mark.parametrize(
    ("seconds", "here"),
    [([0.1, 0.01], 4), ([0.01], 4), ([0.1], 2), ([0.1, 0.001], 17)],
    ids=["quick but for imports", "alike", "slow", "hardly anything but imports"],
)
def test_processes_begin_as_soon_as_the_rest_is_known_to_take_its_time(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, seconds: list[float], here: int
) -> None:
    from gearlink.cli.batch import run
    from gearlink.cli.batch.options import BatchOptions
    from gearlink.cli.batch.summary import Outcome

    clock, left = [0.0], iter([*seconds, *[seconds[-1]] * 100])

    def outcome(path: Path, _: BatchOptions) -> list[Outcome]:
        clock[0] += next(left)
        return [Outcome(str(path), "", path.stem, "", 0)]

    begun: list[int] = []

    def processes(chunks: list[Any], options: BatchOptions, jobs: int) -> Iterator[tuple[int, list[Outcome]]]:
        begun.append(sum(map(len, chunks)))
        yield from ()

    monkeypatch.setattr(run, "perf_counter", lambda: clock[0])
    monkeypatch.setattr(run, "outcomes", outcome)
    monkeypatch.setattr(run, "processors", lambda: 2)
    monkeypatch.setattr(run, "_in_processes", processes)
    results, _ = run.run_files([tmp_path / f"{i:03}" for i in range(100)], BatchOptions())
    assert begun == [100 - here]
    assert len(results) == here


@pytest.mark.skipif(sys.platform != "linux", reason="forked processes")
def test_without_processes_the_batch_is_done_here(gearlink: Any, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The system's limit of processes or open files is reached."""

    def none_left(*_: object) -> None:
        raise OSError(errno.EAGAIN, "Resource temporarily unavailable")

    one = gearlink("batch", folder, "--format", "json", "-j", "1")
    monkeypatch.setattr(os, "fork", none_left)
    for i in range(MANY):
        (folder / f"crank_{i:02}.yaml").write_text(CRANK.format(stroke=100 + i))
    two = gearlink("batch", folder, "--format", "json", "-j", "2")
    assert len(plain(two)) == 5 + 2 * MANY
    assert [d for d in plain(two) if "crank_" not in d["file"]] == plain(one)


def test_what_refused_processes_held_is_free_for_the_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Pipes of a pool that was half made took the last descriptors, and no file could be opened."""
    from gearlink.cli.batch import run
    from gearlink.cli.batch.options import BatchOptions
    from gearlink.cli.batch.summary import Outcome

    class Pipes:
        pass

    held: list[weakref.ref[Pipes]] = []

    @contextmanager
    def refused(_: int) -> Iterator[Any]:
        pipes = Pipes()
        held.append(weakref.ref(pipes))
        raise OSError(errno.EMFILE, "Too many open files")
        yield

    def outcome(path: Path, _: BatchOptions) -> list[Outcome]:
        return [Outcome(str(path), "" if not held or held[0]() is None else "held", path.stem, "", 0)]

    monkeypatch.setattr(run, "workers", refused)
    monkeypatch.setattr(run, "outcomes", outcome)
    found, _ = run.run_files([tmp_path / f"{i:02}" for i in range(40)], BatchOptions(jobs=2))
    assert len(found) == 40
    assert held
    assert not [each.file for each in found if each.kind]


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="forked processes")
def test_a_file_whose_process_was_killed_by_chance_is_computed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from gearlink.cli.batch import run
    from gearlink.cli.batch.options import BatchOptions
    from gearlink.cli.batch.summary import Outcome

    parent, killed = os.getpid(), tmp_path / "killed"

    def outcome(path: Path, _: BatchOptions) -> list[Outcome]:
        if os.getpid() != parent and not killed.exists():
            killed.touch()
            os.kill(os.getpid(), signal.SIGKILL)
        return [Outcome(str(path), "", path.stem, "", 0)]

    monkeypatch.setattr(run, "outcomes", outcome)
    results, _ = run.run_files([tmp_path / f"{i:03}" for i in range(100)], BatchOptions(jobs=2))
    assert len({result.file for result in results}) == 100
    assert not any(result.errors for result in results)


@pytest.mark.slow
def test_what_files_left_is_freed(gearlink: Any, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Designs know their parts and these the design: 0.3 MB of each file of wide swings stayed."""
    from gearlink.cli.batch import run

    asked: list[int] = []

    def collected(phase: str, found: dict[str, int]) -> None:
        if phase == "start" and found["generation"] > 0:
            asked.append(found["generation"])

    monkeypatch.setattr(run, "_files", itertools.count(1))
    monkeypatch.setattr(run, "_AT_A_TIME", 2)
    monkeypatch.setattr(run, "_ALL", 4)
    gc.disable()
    gc.callbacks.append(collected)
    try:
        assert len(gearlink("batch", folder, "--format", "json", "-j", "1").json["designs"]) == 5
    finally:
        gc.callbacks.remove(collected)
        gc.enable()
    assert asked == [1, 2], "of the last files, of all files"
