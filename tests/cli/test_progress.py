"""One line on a terminal alone: after a second, with what is left or what has passed, and taken back at the end.

Times are tenths of a second: nothing here asks how long something took.
"""

from __future__ import annotations

import io
import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gearlink.cli import progress as module
from gearlink.cli.progress import counted, duration, foretell, progress

FILES = {
    "crank": "kind: slider-crank\nstroke: 310\nrod: 520\noffset: 50\n",
    "failing": "kind: three-gear-four-bar\ngears: {module: 2.5, crank: 20, idler: 20, output: 60}\n"
    "links: {crank: 18, frame: 121.4}\n",
    "study": "kind: study\ndesign: {kind: slider-crank, stroke: 310, rod: 520}\ncommand: crank\n"
    "variables: {rod: {from: 300, to: 600, step: 100}}\nminimize: {crank_length: 1 mm}\n",
}


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def terminal(monkeypatch: pytest.MonkeyPatch) -> Terminal:
    """No fixture: the streams of the process are pytest's own again when a test begins."""
    made = Terminal()
    monkeypatch.setattr("sys.stderr", made)
    monkeypatch.setattr(module, "_AFTER", 0.0)
    monkeypatch.setattr(module, "_EVERY", 0.01)
    monkeypatch.setenv("TERM", "xterm")
    return made


def until(seen: Callable[[], bool]) -> None:
    latest = time.monotonic() + 10.0
    while not seen() and time.monotonic() < latest:
        time.sleep(0.01)
    assert seen()


def test_how_far_the_work_is(monkeypatch: pytest.MonkeyPatch) -> None:
    shown = terminal(monkeypatch)
    with progress(4, "designs", quiet=False, each=1000) as advance:
        until(lambda: "designs [                    ]   0 %, 0 s so far" in shown.getvalue())
        advance(2)
        until(lambda: "designs [##########          ]  50 %, " in shown.getvalue())
        until(lambda: " designs/s, " in shown.getvalue() and " s left" in shown.getvalue())
    assert shown.getvalue().endswith("\r\033[K")


def test_nothing_where_it_is_soon_done(monkeypatch: pytest.MonkeyPatch) -> None:
    shown = terminal(monkeypatch)
    monkeypatch.setattr(module, "_AFTER", 10.0)
    with progress(4, "designs", quiet=False) as advance:
        advance(1)
        time.sleep(0.1)
    assert shown.getvalue() == ""


@pytest.mark.parametrize(("quiet", "term"), [(True, "xterm"), (False, "dumb")])
def test_nothing_where_quiet_or_on_a_terminal_that_takes_nothing_back(
    monkeypatch: pytest.MonkeyPatch, quiet: bool, term: str
) -> None:
    shown = terminal(monkeypatch)
    monkeypatch.setenv("TERM", term)
    with progress(5, "designs", quiet=quiet) as advance:
        advance(1)
        time.sleep(0.1)
    foretell("designs", 1000.0, quiet=quiet)
    assert shown.getvalue() == ""


@pytest.mark.slow
def test_none_where_nobody_looks(monkeypatch: pytest.MonkeyPatch) -> None:
    stream = io.StringIO()
    monkeypatch.setattr("sys.stderr", stream)
    monkeypatch.setattr(module, "_AFTER", 0.0)
    for _ in counted(range(3), "drawing", quiet=False):
        time.sleep(0.1)
    foretell("designs", 1000.0, quiet=False)
    assert stream.getvalue() == ""


def test_counted_gives_the_numbers_and_shows_them(monkeypatch: pytest.MonkeyPatch) -> None:
    shown, found = terminal(monkeypatch), []
    for number in counted(range(5), "drawing", quiet=False):
        found.append(number)
        until(lambda: f"drawing [{'#' * 4 * number:<20}]" in shown.getvalue())  # noqa: B023 - called at once
    assert found == [0, 1, 2, 3, 4]


def test_the_innermost_work_is_shown(monkeypatch: pytest.MonkeyPatch) -> None:
    """A command that computes and draws has one line, not two that write over each other."""
    shown = terminal(monkeypatch)
    with progress(1, "computing", quiet=False):
        until(lambda: shown.getvalue().endswith("computing ... 0 s"))
        with progress(3, "samples", quiet=False):
            until(lambda: "samples [" in shown.getvalue())
        until(lambda: shown.getvalue().endswith("computing ... 0 s"))


@pytest.mark.slow
def test_what_takes_more_than_a_minute_is_said_once(monkeypatch: pytest.MonkeyPatch) -> None:
    shown = terminal(monkeypatch)
    with progress(100_000, "samples", quiet=False) as advance:
        time.sleep(0.1)
        advance(1)
        until(lambda: "; Ctrl-C ends it\n" in shown.getvalue())
        advance(1)
        time.sleep(0.1)
    assert shown.getvalue().count("samples: this takes about ") == 1


def test_foretold(monkeypatch: pytest.MonkeyPatch) -> None:
    shown = terminal(monkeypatch)
    foretell("10 samples", 59.0, quiet=False)
    assert shown.getvalue() == ""
    foretell("10 samples", 610.0, quiet=False)
    assert shown.getvalue() == "10 samples: this takes about 10 min 10 s; Ctrl-C ends it\n"


def test_a_name_does_nothing_to_the_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    shown = terminal(monkeypatch)
    with progress(1, "drawing \033[31m", quiet=False):
        until(lambda: r"drawing \x1b[31m" in shown.getvalue())


FORKING = """
import os, sys, time
from gearlink.cli import progress as module
from gearlink.cli.parallel.workers import workers
module._AFTER, module._EVERY = 0.0, 1e-5

def writes(number):
    assert not module._drawn
    with module.progress(1, "of a worker", quiet=False):
        pass
    module._wipe()  # as a signal that ends the worker does: the line is not its own
    print("x" * 100, file=sys.stderr, flush=True)
    return number

with module.progress(8, "forking", quiet=False) as advance:
    for number in range(8):
        with workers(2) as pool:
            assert pool.submit(writes, number).result(20) == number
        advance(1)
print("done", file=sys.stderr)
"""


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="forked processes")
def test_processes_are_forked_while_it_is_drawn() -> None:
    """The thread that draws holds no lock that a forked process would find taken, and wait for."""
    import pty

    reader, terminal = pty.openpty()
    with subprocess.Popen([sys.executable, "-c", FORKING], stderr=terminal) as forking:
        os.close(terminal)
        said = b""
        while True:
            try:
                part = os.read(reader, 65536)
            except OSError:  # the other end is closed
                break
            if not part:
                break
            said += part
        assert forking.wait(30) == 0
    os.close(reader)
    assert said.endswith(b"done\r\n")
    assert b"forking [" in said


@pytest.mark.parametrize(("seconds", "words"), [(0.4, "0 s"), (59.6, "1 min 0 s"), (7200.0, "2 h 0 min")])
def test_times_in_words(seconds: float, words: str) -> None:
    assert duration(seconds) == words


@pytest.mark.quick(3)
@pytest.mark.parametrize(
    ("line", "shown"),
    [
        (
            "analyze failing.yaml --suggest --save - --quantity frame_length",
            ["searching for changes with which all checks of failing pass 8", "computing the design to be saved"],
        ),
        ("animate crank.yaml --format html --out out --seconds 1", ["drawing crank.yaml"]),
        ("animate crank.yaml --out out --seconds 1 --size 160x160", ["drawing crank.yaml", "drawing 25"]),
        ("check crank.yaml", ["checking crank.yaml"]),
        ("check crank.yaml failing.yaml", ["checking 2"]),
        (
            "explore study.yaml",
            ["exploring", "combining the designs", "computing the results of the study"],
        ),
        ("report crank.yaml --out out", ["computing and drawing crank"]),
    ],
)
@pytest.mark.usefixtures("small_pictures", "no_remedies")
def test_commands_that_may_take_long_show_it(
    gearlink: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, line: str, shown: list[str]
) -> None:
    """What a terminal would show after a second, with the number of pieces where there are several."""
    noted: list[str] = []

    class Noted(module._Work):
        def __init__(self, words: str, total: int, each: int) -> None:
            super().__init__(words, total, each)
            noted.append(f"{words} {total}" if total > 1 else words)

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(module, "on_terminal", lambda: True)
    monkeypatch.setattr(module, "_Work", Noted)
    for name, text in FILES.items():
        (tmp_path / f"{name}.yaml").write_text(text)
    assert gearlink(*line.split()).status in (0, 1)
    assert noted == shown
    assert gearlink(*line.split(), "--quiet").status in (0, 1)
    assert noted == shown, "nothing where quiet"
