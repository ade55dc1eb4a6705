"""What several test modules share."""

from __future__ import annotations

import faulthandler
import gc
import io
import itertools
import json
import os
import signal
import sys
from collections.abc import Generator
from dataclasses import dataclass
from functools import wraps
from pathlib import Path
from typing import Any

import pytest
import sweeps
from hypothesis import HealthCheck, given, settings
from hypothesis.internal.conjecture import providers
from hypothesis.internal.constants_ast import Constants
from hypothesis.strategies import booleans

from gearlink.cli.main import run

ROOT = Path(__file__).resolve().parents[1]

# A shell starts what runs in its background with interrupts ignored, and every process that is started from there
# inherits it: the tests that interrupt a command would wait for ever.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

# The collector finds little here and walks all modules, specs and figures to say so: what has been looked at once, it
# leaves alone in `make test`, at a sixtieth more memory; the many figures of `make check-full` would fill it.
gc.set_threshold(50_000, 20 if sweeps.ALL else 1000, 100)


def _leave_what_is_kept() -> None:
    """What the run has kept so far is left alone by the collector, whoever asks it: pytest and the interpreter walk all
    five times before they end, which took a twelfth of `make test`, and a batch or the loads of a machine once for each
    few designs. Young rings that nothing holds are still looked at, and with them what they never closed;
    `make check-full` looks at all."""
    if not sweeps.ALL:
        _register_random()
        gc.collect(0)
        gc.freeze()


@pytest.hookimpl(tryfirst=True)
def pytest_unconfigure() -> None:
    _leave_what_is_kept()


_files = itertools.count(1)


def pytest_runtest_teardown(item: pytest.Item, nextitem: pytest.Item | None) -> None:
    if nextitem is not None and nextitem.path != item.path and next(_files) % 16 == 0:
        _leave_what_is_kept()


# Commands that are run in the process of the tests fork workers. A thread of OpenBLAS that is at work just then leaves
# its locks taken in the fork, which waits for them for ever. The program leaves them out likewise; no numpy is loaded
# yet.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

# The same examples every time, and no verdict on the speed of drawing them (too_slow): machines that run tests are
# shared and noisy. GEARLINK_SEEDS=random draws new examples with every run.
settings.register_profile(
    "steady",
    sweeps.examples(100),
    derandomize=os.environ.get("GEARLINK_SEEDS") != "random",
    database=None,
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.load_profile("steady")


@given(booleans())
def _register_random(_: bool) -> None:
    """With the first examples Hypothesis registers its random generator, and asks the collector who holds it. Since
    Python 3.14 that is a dictionary which exists before: left alone as the rest of what is kept, it is not found, and
    the first test with examples ends in a warning."""


_NONE = Constants()


@wraps(providers._get_local_constants)
def _no_local_constants() -> Constants:
    """Hypothesis strews constants of the loaded modules of the project among its examples. Which modules are loaded
    depends on the tests that ran before in the same process, so the examples would too, seeds or no seeds. There is
    no setting for it; tests/test_examples.py says whether this way of switching it off still works."""
    return _NONE


providers._get_local_constants = _no_local_constants


# Which cases are quick


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Of a test marked `quick(count)` so many cases stay in `make test`, from the first on evenly spread.

    A function that is marked `slow` as well would have none: only single cases may be."""
    cases: dict[tuple[Path, str], list[pytest.Item]] = {}
    for item in items:
        if {mark.name for mark in getattr(getattr(item, "function", None), "pytestmark", [])} >= {"quick", "slow"}:
            raise pytest.UsageError(f"{item.nodeid} is marked slow and quick: no case of it would be quick")
        if item.get_closest_marker("quick") and not any(map(item.get_closest_marker, ("slow", "stress"))):
            cases.setdefault((item.path, item.nodeid.partition("[")[0]), []).append(item)
    for found in cases.values():
        (count,) = next(mark.args for mark in [found[0].get_closest_marker("quick")] if mark)
        kept = {i * len(found) // count for i in range(count)}
        for i, item in enumerate(found):
            if i not in kept:
                item.add_marker("slow")


# A test that waits for ever


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--patience", type=float, help="seconds after which a test that does not end is shown and ends all"
    )


class Watch:
    """Shows the stacks of all threads and ends the run when a test takes longer than `patience` seconds.

    By a timer of the system where there is one: a thread would be in the way of every process that the tests fork."""

    def __init__(self, patience: float, stderr: int) -> None:
        self.patience, self.stderr = patience, stderr
        if sys.platform != "win32":
            faulthandler.register(signal.SIGALRM, file=stderr, chain=True)

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtest_logstart(self) -> None:
        if sys.platform != "win32":
            signal.setitimer(signal.ITIMER_REAL, self.patience)
        else:
            faulthandler.dump_traceback_later(self.patience, exit=True, file=self.stderr)

    def pytest_unconfigure(self) -> None:
        if sys.platform != "win32":
            signal.setitimer(signal.ITIMER_REAL, 0.0)
        else:
            faulthandler.cancel_dump_traceback_later()


def pytest_configure(config: pytest.Config) -> None:
    if (patience := config.getoption("--patience", None)) is not None:
        with config.pluginmanager.getplugin("capturemanager").global_and_fixture_disabled():
            stderr = os.dup(2)
        config.pluginmanager.register(Watch(patience, stderr))


# What the tests cost

SHARE = 0.2
"""A test file may take so much of the processor time of its part of `make test`: a share does not depend on the
machine."""
WHOLE = 500
"""A run of so many tests is a part of `make test`, or more."""
BUDGET = 60
"""Processor seconds that each half of `make test` may take. It is said in red, and fails nothing: machines differ."""
FULL_BUDGET = 2400
"""The same of all tests of `make check-full`; what goes beyond it belongs to `make stress`."""


def pytest_collection_finish() -> None:
    """Start and collection are part of what a half takes."""
    global _collected
    _leave_what_is_kept()
    _collected = _processor_seconds()


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol(item: pytest.Item) -> Generator[None, object, object]:
    begun = _processor_seconds()
    try:
        return (yield)
    finally:
        seconds = _processor_seconds() - begun
        _full[item.location[0]] = _full.get(item.location[0], 0.0) + seconds
        if not item.get_closest_marker("slow") and not item.get_closest_marker("stress"):
            _taken.setdefault(item.location[0], []).append(seconds)


@pytest.hookimpl(optionalhook=True)
def pytest_testnodedown(node: Any) -> None:
    """What the tests of another process took."""
    output = getattr(node, "workeroutput", {})
    for path, seconds in output.get("taken", {}).items():
        _taken.setdefault(path, []).extend(seconds)
    for path, seconds in output.get("full", {}).items():
        _full[path] = _full.get(path, 0.0) + seconds


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    if sum(map(len, _taken.values())) < WHOLE:
        return
    spent = _full if sweeps.ALL else {path: sum(seconds) for path, seconds in _taken.items()}
    whole = sum(spent.values())
    dearest = sorted(spent, key=lambda path: -spent[path])[:5]
    terminalreporter.write_line(f"most expensive files: {', '.join(f'{path} {spent[path]:.1f}' for path in dearest)}")
    if sweeps.ALL:
        budget, line = FULL_BUDGET, f"all tests: {whole:.0f} processor seconds (budget {FULL_BUDGET})"
    else:
        whole += _collected
        budget, line = BUDGET, f"quick tests: {whole:.0f} processor seconds (budget {BUDGET} each half)"
    terminalreporter.write_line(line, bold=whole > budget, red=whole > budget)


@pytest.hookimpl(trylast=True)
def pytest_sessionfinish(session: pytest.Session) -> None:
    if hasattr(session.config, "workeroutput"):
        session.config.workeroutput |= {"taken": _taken, "full": _full}
        return
    if sweeps.ALL or session.exitstatus != pytest.ExitCode.OK or sum(map(len, _taken.values())) < WHOLE:
        return
    whole = sum(map(sum, _taken.values()))
    if dear := [path for path, seconds in _taken.items() if sum(seconds) > SHARE * whole]:
        print(f"\nmore than {SHARE:.0%} of all time: {', '.join(dear)}; mark long sweeps slow (tests/sweeps.py)")
        session.exitstatus = pytest.ExitCode.TESTS_FAILED


_taken: dict[str, list[float]] = {}
_full: dict[str, float] = {}
_collected = 0.0


def _processor_seconds() -> float:
    """Of this process and of those that it has waited for."""
    return sum(os.times()[:4])


@dataclass(frozen=True)
class Ended:
    """How a command ended."""

    status: int
    out: str
    err: str

    @property
    def json(self) -> Any:
        return json.loads(self.out)


@pytest.fixture
def designs() -> Path:
    return ROOT / "designs"


@pytest.fixture(scope="module")
def forty_digits() -> Generator[None, None, None]:
    """mpmath reckons with 40 digits."""
    from mpmath import workdps

    with workdps(40):
        yield


@pytest.fixture
def small_pictures(monkeypatch: pytest.MonkeyPatch) -> None:
    """Pictures of commands are empty ones, where a test asks which files there are and not what they show."""
    from matplotlib.figure import Figure

    monkeypatch.setattr("gearlink.cli.views.figures.write.draw", lambda *_: Figure(figsize=(1, 1)))


@pytest.fixture
def standard_input(monkeypatch: pytest.MonkeyPatch) -> Any:
    """Put bytes where `-` reads: `standard_input(b"kind: ...")`."""
    return lambda given: monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO(given)))


@pytest.fixture
def gearlink(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Any:
    """Run a command line in this process, whatever the terminal of the tests: `gearlink("crank", path)`."""
    for name in ("NO_COLOR", "COLUMNS", "LINES"):
        monkeypatch.delenv(name, raising=False)

    def call(*arguments: object) -> Ended:
        capsys.readouterr()
        status = run([str(argument) for argument in arguments])
        captured = capsys.readouterr()
        return Ended(int(status), captured.out, captured.err)

    return call
