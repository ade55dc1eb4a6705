"""Mutated design files: exit status 0, 1 or 2, no traceback, each within two seconds (more
where a command computes many designs) and 200 MB more.

GEARLINK_MUTATIONS=100000 make stress tries so many, in parts that go to different processes; 100,000 take about half
an hour of one core.
"""

from __future__ import annotations

import io
import json
import os
import re
import signal
from collections.abc import Iterator
from contextlib import chdir, contextmanager, redirect_stderr, redirect_stdout
from importlib import import_module
from itertools import pairwise
from pathlib import Path
from pkgutil import walk_packages
from random import Random
from time import perf_counter
from typing import Any

import pytest
from stress.mutations import ROOT, SEEDS, base_of, command_of, mutated

import gearlink.cli
import gearlink.core
from gearlink.cli.main import run

SECONDS = 2.0  # of processor time, so that other work on the machine does not count
LONGER = {
    "loads": 3.0,
    "batch": 5.0,
    "check": 5.0,
    "--worst-case": 2.0,
    "--allocate": 2.0,
    "--sobol": 8.0,
    "--suggest": 5.0,
    "--candidates": 3.0,
    "--budget": 2.0,
}
"""How many times the seconds of one design, by how many designs a command computes.

`check` and `batch` run each command of a file, up to five; `--worst-case` and `--allocate` have some hundred designs
with their cams, `--sobol` as many times the samples as there are coordinates and two more (278 of the gripper of 9),
`--suggest` the checks of every command anew for up to eight repairs, `--candidates` whole designs
side by side (a five-bar's function is searched for each), `--budget 8` eight designs. `loads` has the design and, for
a flywheel or a motor, the forces of several hundred positions for each trial speed. All other commands, and so the
limit that a reader waits for, keep 2 s.
"""
OF_A_STUDY = 40.0
"""The same of `batch` on a study: half a million designs as arrays (17 s), or 4,096 of a kind without (15 ms each)."""
MEGABYTES = 200.0
FEW, MANY, PARTS = 10, int(os.environ.get("GEARLINK_MUTATIONS", "6000")), 8
CONTROLS = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f]")
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
    shown, talk = io.StringIO(), io.StringIO()
    limit = SECONDS * max(OF_A_STUDY if _is_study(arguments) else 1.0, *(LONGER.get(word, 1.0) for word in arguments))
    try:
        with deadline(limit), redirect_stdout(shown), redirect_stderr(talk):
            status = run(arguments)
    except TooSlow:
        return f"longer than {limit:g} s"
    except BaseException as error:
        return f"{type(error).__name__}: {error}"
    text = talk.getvalue()
    if status not in (0, 1, 2) or "Traceback" in text or "Warning" in text:
        return f"status {status}: {text.strip()[:300]}"
    designs = "--show" in arguments or ("--save", "-") in pairwise(arguments)  # as YAML, instead of results
    return unreadable(shown.getvalue(), "json" in arguments and not designs)


def _is_study(arguments: list[str]) -> bool:
    files = [word for word in arguments if word.endswith(".yaml") and arguments[0] == "batch"]
    return any(b"kind: study" in Path(name).read_bytes() for name in files)


def unreadable(text: str, is_json: bool) -> str:
    """What no reader of the results can bear: characters that steer a terminal, numbers that JSON has not."""
    if found := CONTROLS.search(text):
        return f"control character {found[0]!r} in what is shown"
    if not is_json or not text:
        return ""
    try:
        json.loads(text, parse_constant=_no_number)
    except ValueError as error:
        return f"no JSON: {error}"
    return ""


def _no_number(word: str) -> Any:
    raise ValueError(f"{word} is no number")


def fuzz(draws: range, seed: int, folder: Path) -> list[str]:
    """Failures among mutated files, each with the seed and the draw that make it again."""
    names = list(SEEDS)
    failures: list[str] = []
    path = folder / "design.yaml"
    for i in draws:
        rng = Random(f"{seed}/{i}")
        name = rng.choice(names)
        text = base_of(name)
        data = mutated(text, rng)
        path.write_bytes(data)
        arguments = [*command_of(text, rng), str(path), "--quiet"]
        if arguments[0] != "export":
            arguments += ["--format", rng.choice(FORMATS)]
        with chdir(folder):  # where exports and `--save` go
            wrong = verdict(arguments)
        if wrong := wrong or left_behind(folder):
            failures.append(f"{seed}/{i} {' '.join(arguments)}: {wrong}\n{data.decode('utf-8', 'replace')}")
    return failures


def import_all() -> None:
    """Modules take 140 MB, which are no design's; which of them other tests have imported depends on their order."""
    for package in (gearlink.cli, gearlink.core):
        for found in walk_packages(package.__path__, f"{package.__name__}."):
            if not found.name.endswith("__main__"):
                import_module(found.name)
    for name in ("ezdxf", "highspy", "matplotlib.backends.backend_svg", "matplotlib.pyplot", "scipy.special"):
        import_module(name)


def left_behind(folder: Path) -> str:
    hidden = [path.name for path in folder.iterdir() if path.name.startswith(".")]
    return f"left behind: {hidden}" if hidden else ""


def test_a_few_mutated_files(tmp_path: Path) -> None:
    assert not fuzz(range(FEW), 1, tmp_path)


@pytest.mark.stress
@pytest.mark.parametrize("part", range(PARTS))
def test_many_mutated_files(part: int, tmp_path: Path) -> None:
    resource = pytest.importorskip("resource")
    import_all()
    begun, before = perf_counter(), resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    draws = range(part, MANY, PARTS)
    failures = fuzz(draws, 2, tmp_path)
    grown = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024.0
    print(
        f"\n{len(draws)} mutated files, {len(failures)} failures, {perf_counter() - begun:.0f} s, {grown:.0f} MB more"
    )
    assert not failures, "\n\n".join(failures[:5])
    assert grown < MEGABYTES


@pytest.mark.slow
@pytest.mark.parametrize(
    "line",
    [
        "swing wide_swing_twin_cam.yaml --set swing=1e-17",  # the arm ratio rounded to 1
        "register swing_gripper_register.yaml --set cam.roller.radius=1e-17",  # the contact rounded to the centre
        "loads loaded_wide_swing.yaml --set unloader.arm=1e-17",  # the pin rounded to the pivot: no direction
    ],
)
def test_what_once_failed(line: str) -> None:
    command, name, *rest = line.split()
    assert not verdict([command, str(ROOT / "designs" / name), *rest, "--quiet"])
