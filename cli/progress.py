"""A bar on a terminal that shows how far the work is.

It is drawn by the thread that works: a process forked while another thread writes would find that thread's locks taken.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from time import monotonic
from typing import Any

_SECONDS_BETWEEN = 0.1


@contextmanager
def progress(total: int, words: str, *, quiet: bool, each: int = 0) -> Iterator[Callable[[int], None]]:
    """What to call with the number of pieces that are done; a bar where standard error is a terminal.

    Parameters
        total : int - pieces; of less than two there is no bar
        words : str - what is going on
        quiet : bool - no bar
        each : int - designs of a piece, whose rate is shown then; 0: none
    """
    if quiet or total < 2 or not sys.stderr.isatty():
        yield lambda _: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    class Rate(TextColumn):
        def render(self, task: Any) -> Any:
            speed = task.finished_speed or task.speed or 0.0
            return type(super().render(task))(f"{speed * each:,.0f} designs/s")

    columns = [TextColumn(words), BarColumn(), TextColumn("{task.percentage:>3.0f} %")]
    columns += [Rate("")] if each else []
    console = Console(stderr=True)
    with Progress(*columns, TimeRemainingColumn(), console=console, transient=True, auto_refresh=False) as bar:
        task, drawn = bar.add_task("", total=total), 0.0

        def advance(count: int) -> None:
            nonlocal drawn
            bar.advance(task, count)
            if monotonic() - drawn > _SECONDS_BETWEEN:
                bar.refresh()
                drawn = monotonic()

        yield advance


def counted(pieces: range, words: str, *, quiet: bool) -> Iterable[int]:
    """The numbers of a range, with a bar."""
    with progress(len(pieces), words, quiet=quiet) as advance:
        for piece in pieces:
            yield piece
            advance(1)
