"""`make bench-guard`: fails for what is more than a quarter slower than on record in every try, and only for that."""

from __future__ import annotations

import json
import math
import sys
from pathlib import Path
from typing import Any

import pytest

import bench.guard
from bench.families import FAMILIES
from bench.timing import Family, Row

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture
def guard(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Any:
    """The module, with a record of its own."""
    record = tmp_path / "benchmarks.json"
    other, own = ("with AVX-512", "without AVX-512")
    press = {"chains, 1": 2.0, "scipy newton, 1": 1.0}
    record.write_text(json.dumps({other: {"press": {"chains, 1": 99.0}}, own: {"press": press}}))
    monkeypatch.setattr(bench.guard, "RECORD", record)
    monkeypatch.setattr(bench.guard, "machine", lambda: {"AVX-512": "no"})
    monkeypatch.setattr(sys, "argv", ["guard", "press"])
    return bench.guard


def _measured(ratios: list[float]) -> Any:
    """A family whose own method takes these ratios try by try; the other is slow for ever."""
    left = iter(ratios)

    def measured(_name: str, *, quick: bool) -> Family:
        rows = (Row("chains", 1, 1.0, math.nan, next(left)), Row("scipy newton", 1, 1.0, math.nan, 99.0))
        return Family("press", "", "none", "", rows)

    return measured


@pytest.mark.parametrize(
    ("ratios", "status"), [([2.4], 0), ([3.0, 2.6, 2.5], 0), ([3.0, 2.4], 0), ([2.6, 2.51, 9.0], 1)]
)
def test_a_quarter_is_allowed_in_one_of_three_tries(
    guard: Any, monkeypatch: pytest.MonkeyPatch, ratios: list[float], status: int
) -> None:
    monkeypatch.setattr(guard, "measured", _measured(ratios))
    assert guard.main() == status


def test_a_family_that_the_record_does_not_know_fails(
    guard: Any, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    guard.RECORD.write_text("{}")
    monkeypatch.setattr(guard, "measured", _measured([1.0]))
    assert guard.main() == 1
    assert "has nothing of press" in capsys.readouterr().out


def test_a_record_is_renewed_for_processors_such_as_this_one(guard: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(guard, "measured", _measured([3.0, 3.5]))
    monkeypatch.setattr(sys, "argv", ["guard", "--record", "press"])
    assert guard.main() == 0
    assert guard.record()["press"]["chains, 1"] == 3.0
    monkeypatch.setattr(sys, "argv", ["guard", "press"])
    assert guard.main() == 0
    monkeypatch.setattr(guard, "machine", lambda: {"AVX-512": "yes"})
    assert guard.record() == {"press": {"chains, 1": 99.0}}


@pytest.mark.parametrize("kind", ["with AVX-512", "without AVX-512"])
def test_the_record_has_every_family_that_is_guarded(guard: Any, kind: str) -> None:
    record = json.loads((ROOT / "docs" / "benchmarks.json").read_text())[kind]
    assert set(guard.FAMILIES) <= set(record)
    assert set(record) <= set(FAMILIES)
