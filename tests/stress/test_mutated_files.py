"""Mutated design files: exit status 0, 1 or 2, no traceback, each within two seconds and 200 MB more.

GEARLINK_MUTATIONS=100000 make stress tries so many; 100,000 take some hours of one core.
"""

from __future__ import annotations

import io
import os
import resource
import signal
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from pathlib import Path
from random import Random
from time import perf_counter
from typing import Any

import pytest
from stress.mutations import ROOT, SEEDS, command_of, mutated

from gearlink.cli.main import run

SECONDS = 2.0  # of processor time, so that other work on the machine does not count
MEGABYTES = 200.0
FEW, MANY = 20, int(os.environ.get("GEARLINK_MUTATIONS", "6000"))
FORMATS = ("json", "json", "json", "table", "csv", "md")


class TooSlow(BaseException):
    """Not an Exception: the program must not be able to answer it."""


@contextmanager
def deadline(seconds: float) -> Iterator[None]:
    def stop(*_: Any) -> None:
        raise TooSlow

    before = signal.signal(signal.SIGVTALRM, stop)
    signal.setitimer(signal.ITIMER_VIRTUAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0.0)
        signal.signal(signal.SIGVTALRM, before)


def verdict(arguments: list[str]) -> str:
    """What is wrong with the end of a command; empty where nothing is."""
    talk = io.StringIO()
    try:
        with deadline(SECONDS), redirect_stdout(io.StringIO()), redirect_stderr(talk):
            status = run(arguments)
    except TooSlow:
        return f"longer than {SECONDS:g} s"
    except BaseException as error:
        return f"{type(error).__name__}: {error}"
    text = talk.getvalue()
    return "" if status in (0, 1, 2) and "Traceback" not in text else f"status {status}: {text.strip()[:300]}"


def fuzz(count: int, seed: int, folder: Path) -> list[str]:
    """Failures among so many mutated files, each with the seed that makes it again."""
    names = list(SEEDS)
    failures: list[str] = []
    path = folder / "design.yaml"
    for i in range(count):
        rng = Random(f"{seed}/{i}")
        name = rng.choice(names)
        text = SEEDS[name]
        data = mutated(text, rng)
        path.write_bytes(data)
        arguments = [*command_of(text, rng), str(path), "--format", rng.choice(FORMATS), "--quiet"]
        if wrong := verdict(arguments):
            failures.append(f"{seed}/{i} {' '.join(arguments[:2])}: {wrong}\n{data.decode('utf-8', 'replace')}")
    return failures


def test_a_few_mutated_files(tmp_path: Path) -> None:
    assert not fuzz(FEW, 1, tmp_path)


@pytest.mark.stress
def test_many_mutated_files(tmp_path: Path) -> None:
    begun, before = perf_counter(), resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    failures = fuzz(MANY, 2, tmp_path)
    grown = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024.0
    print(f"\n{MANY} mutated files, {len(failures)} failures, {perf_counter() - begun:.0f} s, {grown:.0f} MB more")
    assert not failures, "\n\n".join(failures[:5])
    assert grown < MEGABYTES


@pytest.mark.parametrize(
    "line",
    [
        "swing wide_swing_twin_cam.yaml --set swing=1e-17",  # the arm ratio rounded to 1
    ],
)
def test_what_once_failed(line: str) -> None:
    command, name, *rest = line.split()
    assert not verdict([command, str(ROOT / "designs" / name), *rest, "--quiet"])
