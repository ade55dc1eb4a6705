"""Words where something takes longer than a second: on a terminal alone, then taken back. Tenths of a second wide."""

import io
import time

import pytest

from gearlink.cli import progress as module
from gearlink.cli.progress import patience


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.mark.parametrize(("stream", "quiet", "wait", "said"), [
    (Terminal(), False, 0.3, "drawing ... 0 s\r\033[K"),
    (Terminal(), False, 0.0, ""),
    (Terminal(), True, 0.3, ""),
    (io.StringIO(), False, 0.3, ""),
])  # fmt: skip
def test_words_come_late_and_go(monkeypatch, stream, quiet, wait, said):
    monkeypatch.setattr(module, "_AFTER", 0.1)
    monkeypatch.setattr(module, "_EVERY", 0.02)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setattr("sys.stderr", stream)
    with patience("drawing", quiet=quiet):
        time.sleep(wait)
    assert stream.getvalue() == said


def test_words_are_taken_back_where_the_work_fails(monkeypatch):
    stream = Terminal()
    monkeypatch.setattr(module, "_AFTER", 0.01)
    monkeypatch.setattr(module, "_EVERY", 0.01)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setattr("sys.stderr", stream)

    def fails():
        with patience("drawing"):
            time.sleep(0.1)
            raise ValueError("no")

    with pytest.raises(ValueError, match="no"):
        fails()
    assert stream.getvalue().endswith("\r\033[K")
