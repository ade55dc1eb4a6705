"""`batch --unchanged skip`: what is skipped is what would come out the same; anything else is computed."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import pytest
import yaml

from gearlink.cli.batch import run as batches
from gearlink.cli.exit_codes import ExitCode

CRANK = "kind: slider-crank\nstroke: 310\nrod: 520\noffset: 50\n"
STUDY = {
    "kind": "study",
    "of": "base.yaml",
    "command": "crank",
    "variables": {"rod": {"values": [520]}},
    "minimize": {"crank_length": 1},
}


@pytest.fixture
def box(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a design that passes."""
    monkeypatch.chdir(tmp_path)
    Path("designs").mkdir()
    Path("designs/pass.yaml").write_text(CRANK)
    return tmp_path


@pytest.fixture
def run(gearlink: Any, box: Path) -> Any:
    def run(*words: str) -> Any:
        return gearlink("batch", "designs", "--out", "out", "--unchanged", "skip", "--format", "json", *words)

    return run


def skipped(ended: Any) -> set[str]:
    return {Path(d["file"]).stem for d in ended.json["designs"] if d["unchanged"]}


def plain(ended: Any) -> list[dict[str, Any]]:
    return [{k: v for k, v in d.items() if k not in ("seconds", "unchanged")} for d in ended.json["designs"]]


@pytest.mark.slow
def test_what_passed_is_skipped_and_the_summary_stays_the_same(gearlink: Any, run: Any, designs: Path) -> None:
    """Beside it one with a warning, one that fails, one that is wrong."""
    Path("designs/warn.yaml").write_text((designs / "thesis_example_1.yaml").read_text())
    Path("designs/fail.yaml").write_text((designs / "thesis_example_3_as_printed.yaml").read_text())
    Path("designs/wrong.yaml").write_text("kind: slider-crank\nrod: 5\n")
    first, second = run(), run()
    assert (skipped(first), skipped(second)) == (set(), {"pass"})
    assert plain(first) == plain(second)
    assert first.status == second.status == ExitCode.WRONG_INPUT
    assert skipped(gearlink("batch", "designs", "--out", "out", "--format", "json")) == set(), "it is asked for"
    table = gearlink("batch", "designs/pass.yaml", "--out", "out", "--unchanged", "skip")
    assert (table.status, "unchanged" in table.out) == (ExitCode.OK, True)


def other_code(monkeypatch: pytest.MonkeyPatch) -> None:
    own = dict(batches.program())
    batches._program.cache_clear()
    monkeypatch.setattr(batches, "program", lambda: {**own, "gearlink": "0.2.0 (code 0123456789ab)"})


CHANGES: dict[str, Any] = {
    "design": lambda _: Path("designs/pass.yaml").write_text(CRANK.replace("310", "300")),
    "result": lambda _: Path("out/designs/pass-crank.json").write_text("{}"),
    "no result": lambda _: Path("out/designs/pass-crank.json").unlink(),
    "note": lambda _: Path("out/designs/pass~made-of.json").write_text("{"),
    "another note": lambda _: Path("out/designs/pass~made-of.json").write_text('{"read": 1}'),
    "no note": lambda _: Path("out/designs/pass~made-of.json").unlink(),
    "code": other_code,
}


@pytest.mark.quick(4)
@pytest.mark.parametrize("name", CHANGES)
def test_what_has_changed_is_computed(run: Any, monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    run()
    CHANGES[name](monkeypatch)
    try:
        again = run()
    finally:
        batches._program.cache_clear()
    assert skipped(again) == set()
    assert json.loads(Path("out/designs/pass-crank.json").read_text())["kind"] == "slider-crank"


@pytest.mark.parametrize(
    "more",
    [("--set", "rod=530"), ("--strict",), pytest.param(("--plot", "--plot-format", "svg"), marks=pytest.mark.slow)],
)
def test_options_that_decide_a_result_count(run: Any, more: tuple[str, ...]) -> None:
    run()
    assert skipped(run("--no-color", "--jobs", "1")) == {"pass"}
    first, second = run(*more), run(*more)
    assert skipped(first) == set()
    assert skipped(second) <= {"pass"}


def test_the_base_of_a_study_counts(run: Any) -> None:
    """Its file is not the study's; nor does the time of either count."""
    Path("designs/pass.yaml").unlink()
    Path("designs/base.yaml").write_text(CRANK)
    Path("designs/study.yaml").write_text(yaml.safe_dump(STUDY, sort_keys=False))
    assert [d["result"] for d in run().json["designs"]] == ["pass", "pass", "pass"]
    os.utime("designs/base.yaml", (0, 0))
    assert skipped(run()) == {"base", "study"}
    Path("designs/base.yaml").write_text(CRANK.replace("offset: 50", "offset: 40"))
    assert skipped(run()) == set()


def test_a_design_that_passes_no_more_is_never_skipped(run: Any) -> None:
    """Its earlier results stand there still, and are believed again only for what they were made of."""
    run()
    Path("designs/pass.yaml").write_text("kind: slider-crank\nrod: 5\n")
    assert [d["result"] for d in run().json["designs"]] == ["error"]
    assert run().status == ExitCode.WRONG_INPUT
    Path("designs/pass.yaml").write_text(CRANK)
    assert skipped(run()) == {"pass"}


def test_a_note_of_another_design_is_not_believed(run: Any) -> None:
    run()
    Path("designs/other.yaml").write_text(CRANK)
    note = Path("out/designs/pass~made-of.json").read_text()
    Path("out/designs/other~made-of.json").write_text(note)
    assert skipped(run()) == {"pass"}


def test_results_are_needed(gearlink: Any, box: Path) -> None:
    ended = gearlink("batch", "designs", "--unchanged", "skip")
    assert (ended.status, ended.out) == (2, "")
    assert "needs --out DIR" in ended.err


def test_a_link_below_out_is_not_followed(run: Any) -> None:
    run()
    Path("out/designs").rename("elsewhere")
    os.symlink("../elsewhere", "out/designs")
    assert skipped(run()) == set()


def test_a_note_that_cannot_be_written_costs_no_result(run: Any) -> None:
    Path("out/designs/pass~made-of.json").mkdir(parents=True)
    first, second = run(), run()
    assert skipped(first) == skipped(second) == set()
    assert [d["result"] for d in second.json["designs"]] == ["pass", "pass"]
