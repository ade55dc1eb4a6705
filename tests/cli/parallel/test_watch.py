"""How far shares of a work are: counted here and in workers, shown in small steps, told where it is long."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from typing import Any

import pytest

from gearlink.cli.parallel import shares
from gearlink.cli.parallel.shares import TooLong, Watch
from gearlink.core.studies.tolerance.sampling import of_replications, seen


class Clock:
    """Seconds that pass when told."""

    now = 100.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Clock:
    made = Clock()
    monkeypatch.setattr(shares, "monotonic", made)
    return made


def counted(total: int, quiet: bool = False) -> tuple[Watch, list[int]]:
    steps: list[int] = []
    return Watch(4, total // 4, steps.append, quiet=quiet), steps


def test_designs_and_ended_shares_are_counted_once() -> None:
    made, steps = counted(400)
    made(30)
    made(30)
    made.share()  # 100 of it, 60 of which are shown
    made(50)
    assert sum(steps) == made.done == 110
    for _ in range(3):
        made.share()
    assert sum(steps) == made.done == made.whole == 400
    assert all(step > 0 for step in steps)


@pytest.mark.parametrize(("whole", "words"), [(40_000, "about 7 min: 40,000 designs"), (4_000, "")])
def test_what_takes_longer_than_a_minute_says_so_once(
    clock: Clock, capsys: pytest.CaptureFixture[str], whole: int, words: str
) -> None:
    """100 designs a second; the five seconds before the first of them do not count."""
    made, _ = counted(whole)
    clock.now += 5.0
    made(10)
    for _ in range(20):
        clock.now += 0.1
        made(10)
    told = capsys.readouterr().err
    assert words in told
    assert told.count("this takes") == bool(words)


def test_nothing_is_said_where_quiet(clock: Clock, capsys: pytest.CaptureFixture[str]) -> None:
    made, steps = counted(40_000_000, quiet=True)
    for _ in range(5):
        clock.now += 1.0
        made(10)
    assert capsys.readouterr().err == ""
    assert sum(steps) == 50


def test_a_share_is_given_up_here_as_soon_as_it_is_known_to_be_long(clock: Clock) -> None:
    made, _ = counted(40_000)
    made.most_seconds = 1.0
    clock.now += 0.2
    made(1)  # too early to tell
    clock.now += 0.1
    with pytest.raises(TooLong):
        made(1)


def work(number: int) -> int:
    """A share that says what it computes, block by block."""
    for _ in range(20):
        seen(5)
    return number


@contextmanager
def threads(count: int) -> Iterator[Any]:
    with ThreadPoolExecutor(count) as pool:
        yield pool


def test_a_long_first_share_is_left_to_workers(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(shares, "processors", lambda: 2)
    monkeypatch.setattr("gearlink.cli.parallel.workers.workers", threads)
    monkeypatch.setattr(shares, "_FIRST_LOOK", -1.0)
    monkeypatch.setattr(shares, "_WORTH_SECONDS", -1.0)
    assert _found(0) == list(range(16))


@pytest.mark.quick(1)
@pytest.mark.skipif(sys.platform != "linux", reason="workers that are started anew share no memory")
@pytest.mark.parametrize("jobs", [1, 2])
def test_the_bar_moves_within_a_share(monkeypatch: pytest.MonkeyPatch, jobs: int) -> None:
    """16 shares of 100 designs, told by fives: every design is shown, by more steps than there are shares here."""
    steps: list[int] = []

    @contextmanager
    def bar(total: int, _words: str, **_: Any) -> Iterator[Callable[[int], None]]:
        assert total == 1600
        yield steps.append

    monkeypatch.setattr(shares, "progress", bar)
    assert _found(jobs) == list(range(16))
    assert sum(steps) == 1600
    if jobs == 1:
        assert max(steps) == 5


def _found(jobs: int) -> list[int]:
    with shares.shares_by(jobs, "", words="samples", quiet=False):
        return list(of_replications(work, 100))
