"""A bar on a terminal alone, drawn without a thread: workers are forked while it is shown."""

from __future__ import annotations

import io
import threading

import pytest

from gearlink.cli.progress import counted, progress


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def terminal(monkeypatch: pytest.MonkeyPatch) -> Terminal:
    """No fixture: the streams of the process are pytest's own again when a test begins."""
    made = Terminal()
    monkeypatch.setattr("sys.stderr", made)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "80")
    return made


def test_how_far_the_work_is_without_a_thread(monkeypatch: pytest.MonkeyPatch) -> None:
    shown, before = terminal(monkeypatch), threading.active_count()
    with progress(4, "designs", quiet=False, each=1000) as advance:
        advance(2)
        assert threading.active_count() == before
    assert "designs" in shown.getvalue()
    assert "50 %" in shown.getvalue()
    assert "designs/s" in shown.getvalue()


@pytest.mark.parametrize(("total", "quiet"), [(1, False), (5, True)])
def test_no_bar_for_one_piece_or_where_quiet(monkeypatch: pytest.MonkeyPatch, total: int, quiet: bool) -> None:
    shown = terminal(monkeypatch)
    with progress(total, "designs", quiet=quiet) as advance:
        advance(1)
    assert shown.getvalue() == ""


def test_none_where_nobody_looks(monkeypatch: pytest.MonkeyPatch) -> None:
    stream = io.StringIO()
    monkeypatch.setattr("sys.stderr", stream)
    assert list(counted(range(3), "drawing", quiet=False)) == [0, 1, 2]
    assert stream.getvalue() == ""


def test_counted_gives_the_numbers_and_shows_them(monkeypatch: pytest.MonkeyPatch) -> None:
    shown = terminal(monkeypatch)
    assert list(counted(range(5), "drawing", quiet=False)) == [0, 1, 2, 3, 4]
    assert "drawing" in shown.getvalue()
