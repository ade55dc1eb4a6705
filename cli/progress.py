"""One line on a terminal that shows what is going on: how far it is and how long it will take, or how long it took.

It comes after a second and is taken back at the end. A thread draws it past the streams of Python, so that a process
that is forked meanwhile finds none of their locks taken.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from time import monotonic

from gearlink.cli import process
from gearlink.cli.printable import visible

TYPE_CHECKING = False  # as typing has it

if TYPE_CHECKING:
    import threading
    from collections.abc import Callable, Iterable

_AFTER = 1.0
"""Nothing is shown of what takes less [s]."""
_EVERY = 0.2
"""Between two looks at how far the work is [s]."""
_LONG = 60.0
"""What takes longer [s] is said in a line that stays."""
_BAR, _NARROW = 20, 80
_WIPE = "\r\033[K"
_SIMPLE = ("dumb", "unknown")
"""Terminals that cannot take back a line."""


class _Work:
    """Something that is going on: what, of how many pieces, and how many designs a piece has."""

    def __init__(self, words: str, total: int, each: int) -> None:
        self.words, self.total, self.each = words, total, each
        self.done, self.told, self.began = 0, False, monotonic()

    def left(self) -> float:
        """How long it will still take [s], by what has been done so far; 0 where nothing has."""
        return (monotonic() - self.began) * (self.total - self.done) / self.done if self.done else 0.0

    def line(self) -> str:
        """What the terminal shows."""
        elapsed = monotonic() - self.began
        if self.total < 2:
            return f"{self.words} ... {duration(elapsed)}"
        share = self.done / self.total
        text = f"{self.words} [{'#' * int(_BAR * share):<{_BAR}}] {100 * share:3.0f} %"
        if not self.done:
            return f"{text}, {duration(elapsed)} so far"
        if self.each:
            text += f", {self.done * self.each / elapsed:,.0f} designs/s"
        return f"{text}, {duration(self.left())} left"


_works: list[_Work] = []
"""What is going on, the innermost last: that is shown."""
_drawn = ""


@contextmanager
def progress(total: int, words: str, *, quiet: bool, each: int = 0) -> Iterator[Callable[[int], None]]:
    """What to call with the number of pieces that are done; a line where standard error is a terminal.

    Parameters
        total : int - pieces; of less than two the time that has passed is shown
        words : str - what is going on, "exploring"
        quiet : bool - nothing is shown
        each : int - designs of a piece, whose rate is shown then; 0: none
    Notes
        What takes more than a minute is said as soon as it is known, in a line that stays.
    """
    if quiet or not on_terminal():
        yield lambda _: None
        return
    import threading

    work = _Work(visible(words), total, each)

    def advance(count: int) -> None:
        work.done += count

    ended = threading.Event()
    thread = None if _works else threading.Thread(target=_show, args=(ended,), daemon=True)
    _works.append(work)
    if thread is not None:
        thread.start()
    try:
        yield advance
    finally:
        _works.remove(work)
        if thread is not None:
            ended.set()
            thread.join()
            _wipe()


def counted(pieces: range, words: str, *, quiet: bool) -> Iterable[int]:
    """The numbers of a range, with a line that shows how many are done."""
    with progress(len(pieces), words, quiet=quiet) as advance:
        for piece in pieces:
            yield piece
            advance(1)


def foretell(words: str, seconds: float, *, quiet: bool) -> None:
    """Say before something begins how long it will take, where that is more than a minute and there is a terminal.

    Parameters
        words : str - what begins, "10,000,000 samples"
        seconds : float - about how long it takes [s]
    """
    if seconds > _LONG and not quiet and on_terminal():
        _wipe()
        _write(f"{visible(words)}: this takes about {duration(seconds)}; Ctrl-C ends it\n")


def duration(seconds: float) -> str:
    """A time in words, as exact as such a time is known.

    Example
        >>> duration(7.4), duration(250.0), duration(7500.0)
        ('7 s', '4 min 10 s', '2 h 5 min')
    """
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60} s"
    return f"{whole // 3600} h {whole % 3600 // 60} min"


def on_terminal() -> bool:
    """Whether standard error is a terminal that can take back what it shows."""
    return sys.stderr.isatty() and os.environ.get("TERM") not in _SIMPLE


def _show(ended: threading.Event) -> None:
    """Draw the innermost work until the outermost has ended."""
    global _drawn
    begin = monotonic()
    while not ended.wait(_EVERY):
        for work in _works[-1:]:
            if monotonic() - begin < _AFTER:
                continue
            if not work.told and work.left() > _LONG:
                work.told = True
                foretell(work.words, work.left(), quiet=False)
            line = work.line()[: _width() - 1]
            if line != _drawn:
                _write(f"{_WIPE if _drawn else ''}{line}")
                _drawn = line


def _wipe() -> None:
    """Take the line back."""
    global _drawn
    if _drawn:
        _write(_WIPE)
        _drawn = ""


process.before_the_end.append(_wipe)


def _forget() -> None:
    """In a process that was forked: the line is its parent's, who alone draws and wipes it out."""
    global _drawn
    _drawn = ""


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_forget)


def _write(text: str) -> None:
    """Past the stream, which may be in the middle of something, where it has a descriptor; not to a console of Windows,
    which takes bytes for those of an old code page."""
    if sys.platform == "win32" and sys.stderr.isatty():
        sys.stderr.write(text)
        sys.stderr.flush()
        return
    try:
        descriptor = sys.stderr.fileno()
    except (OSError, ValueError):
        sys.stderr.write(text)
        return
    with suppress(OSError):
        os.write(descriptor, text.encode(sys.stderr.encoding or "utf-8", "replace"))


def _width() -> int:
    with suppress(OSError, ValueError):
        return os.get_terminal_size(sys.stderr.fileno()).columns or _NARROW
    return _NARROW


@contextmanager
def patience(words: str, *, quiet: bool = False) -> Iterator[None]:
    """Say what is going on, and for how long, once it takes more than a second; take the words back when it is done.

    Parameters
        words : str - "drawing ty460", shown with dots and the time that has passed behind it
        quiet : bool - say nothing; nothing is said either where standard error is no terminal
    """
    with progress(1, words, quiet=quiet):
        yield
