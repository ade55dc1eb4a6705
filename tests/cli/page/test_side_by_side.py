"""Pieces made by several processes are those that one would make, each made once."""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path

import pytest

from gearlink.cli.commands.report import side_by_side
from gearlink.core.base.errors import NoSolution

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="forked processes")


@pytest.fixture(autouse=True)
def three_processors(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("os.sched_getaffinity", lambda _: {0, 1, 2})


def test_every_piece_is_made_once_and_stands_in_its_place(tmp_path: Path) -> None:
    def make(i: int) -> tuple[int, int]:
        with (tmp_path / "made").open("a") as stream:
            stream.write(f"{i}\n")
        time.sleep(0.02)
        return i, os.getpid()

    found = side_by_side(make, 7)
    assert found is not None
    assert [i for i, _ in found] == list(range(7))
    assert found[0][1] == os.getpid()
    assert {pid for _, pid in found} > {os.getpid()}, "others made some"
    assert sorted((tmp_path / "made").read_text().split()) == [str(i) for i in range(7)]


@pytest.mark.quick(1)
@pytest.mark.parametrize("which", [0, 3])
def test_nothing_is_given_where_a_piece_is_refused(which: int) -> None:
    def make(i: int) -> int:
        if i == which:
            raise NoSolution("it does not close")
        return i

    assert side_by_side(make, 4) is None


def test_nothing_is_given_where_a_process_dies() -> None:
    here = os.getpid()

    def make(i: int) -> int:
        if os.getpid() != here:
            os._exit(9)
        time.sleep(0.1)
        return i

    assert side_by_side(make, 3) is None


def test_a_single_processor_or_piece_is_left_to_the_caller(monkeypatch: pytest.MonkeyPatch) -> None:
    assert side_by_side(lambda i: i, 1) is None
    monkeypatch.setattr("os.sched_getaffinity", lambda _: {0})
    assert side_by_side(lambda i: i, 3) is None
