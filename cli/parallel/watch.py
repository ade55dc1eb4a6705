"""How far shares of a work are, counted by the processes that compute them."""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Callable
from time import monotonic
from typing import Any

_FIRST_LOOK = 0.25
_TIMED = 1.0
_LONG = 60.0


class TooLong(Exception):
    """A share takes longer than it may here."""


class Watch:
    """Counts designs, shows how far the work is, and says once that it is long.

    Parameters
        shares : int - parts of the work
        work : int - designs of a share
        advance : Callable - shows that so many more are done
        quiet : bool - say nothing

    Notes
        A share that would go on for more than `most_seconds` in this process is given up as soon as that is known.
        Forked workers count in memory that they share with this process; of others only ended shares are known.
    """

    def __init__(self, shares: int, work: int, advance: Callable[[int], None], *, quiet: bool) -> None:
        self.work, self.whole = work, shares * work
        self._advance, self._told, self._process = advance, quiet, os.getpid()
        self._shown = self._ended = self._here = 0
        self._start = monotonic()
        self._timed_from: tuple[float, int] | None = None
        self._count: Any = None
        self.most_seconds = math.inf

    def __call__(self, count: int) -> None:
        """So many more designs are computed, here or in a worker."""
        if self._count is not None:
            with self._count.get_lock():
                self._count.value += count
        if os.getpid() == self._process:
            self._here += count
            self.show()
            if self.elapsed > _FIRST_LOOK and self.elapsed * (self.work / self._here - 1.0) > self.most_seconds:
                raise TooLong

    def share(self) -> None:
        """One more share has ended."""
        self._ended += 1
        self.show()

    def for_workers(self) -> None:
        """From now on workers count too, which are about to be made; the time of the work begins again."""
        if sys.platform == "linux":  # elsewhere they are started anew
            from multiprocessing import get_context

            self._count = get_context("fork").Value("Q", 0)
        self._here, self._start = self._ended * self.work, monotonic()
        self._timed_from = None

    @property
    def done(self) -> int:
        """Designs that are computed, as far as is known."""
        of_workers = 0 if self._count is None else int(self._count.value)
        return min(self.whole, max(self._here + of_workers, self._ended * self.work))

    @property
    def elapsed(self) -> float:
        """Seconds since it began."""
        return monotonic() - self._start

    def show(self) -> None:
        """Show how far the work is."""
        done = self.done
        if done > self._shown:
            self._advance(done - self._shown)
            self._shown = done
        if not self._told:
            self._tell(done)

    def _tell(self, done: int) -> None:
        """Say how long it takes, once a second of it is timed: from the first designs on, not from the preparations."""
        now = monotonic()
        if self._timed_from is None or done <= self._timed_from[1]:
            self._timed_from = (now, done) if done else None
            return
        seconds, counted = now - self._timed_from[0], done - self._timed_from[1]
        if seconds < _TIMED:
            return
        self._told = True
        left = seconds / counted * (self.whole - done)
        if left > _LONG:
            words = f"this takes about {_duration(left)}: {self.whole:,} designs as made are computed"
            print(f"{words}, fewer with --samples", file=sys.stderr)


def _duration(seconds: float) -> str:
    """A time in words, as exact as an estimate is.

    Example
        >>> _duration(95.0), _duration(1020.0), _duration(9000.0)
        ('2 min', '17 min', '2.5 h')
    """
    return f"{seconds / 60.0:.0f} min" if seconds < 5400.0 else f"{seconds / 3600.0:.1f} h"
