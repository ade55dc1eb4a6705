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
    record.write_text(json.dumps({"press": {"chains, 1": 2.0, "scipy newton, 1": 1.0}}))
    monkeypatch.setattr(bench.guard, "RECORD", record)
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


def test_the_record_has_every_family_that_is_guarded(guard: Any) -> None:
    record = json.loads((ROOT / "docs" / "benchmarks.json").read_text())
    assert set(guard.FAMILIES) <= set(record)
    assert set(record) <= set(FAMILIES)
