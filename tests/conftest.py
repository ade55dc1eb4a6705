"""What several test modules share."""

from __future__ import annotations

import gc
import io
import json
import os
from dataclasses import dataclass
from functools import wraps
from pathlib import Path
from typing import Any

import pytest
import sweeps
from hypothesis import HealthCheck, settings
from hypothesis.internal.conjecture import providers
from hypothesis.internal.constants_ast import Constants

from gearlink.cli.main import run

ROOT = Path(__file__).resolve().parents[1]

# The collector finds little here and walks all modules, specs and figures to say so: as the program itself does.
gc.set_threshold(50_000, 20, 100)

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

_NONE = Constants()


@wraps(providers._get_local_constants)
def _no_local_constants() -> Constants:
    """Hypothesis strews constants of the loaded modules of the project among its examples. Which modules are loaded
    depends on the tests that ran before in the same process, so the examples would too, seeds or no seeds. There is
    no setting for it; tests/test_examples.py says whether this way of switching it off still works."""
    return _NONE


providers._get_local_constants = _no_local_constants


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


@pytest.fixture
def standard_input(monkeypatch: pytest.MonkeyPatch) -> Any:
    """Put bytes where `-` reads: `standard_input(b"kind: ...")`."""
    return lambda given: monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO(given)))


@pytest.fixture
def gearlink(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Any:
    """Run a command line in this process: `gearlink("crank", path)`."""
    monkeypatch.delenv("NO_COLOR", raising=False)

    def call(*arguments: object) -> Ended:
        capsys.readouterr()
        status = run([str(argument) for argument in arguments])
        captured = capsys.readouterr()
        return Ended(int(status), captured.out, captured.err)

    return call
