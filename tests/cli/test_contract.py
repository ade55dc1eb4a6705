"""The contract as runnable cases: a design file, a command, the status, quantities, checks and table rows it must give.

Tolerance: each case's own `rtol` and `atol`; the references are 30- to 40-digit results rounded to double, and the
cases allow 1e-9 to 1e-12 relative because a few quantities are roots of roots.
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import pytest
from sweeps import ALL

FOLDER = Path(__file__).parents[1] / "reference" / "contract"
CASES = [(path.stem, case) for path in sorted(FOLDER.glob("*.json")) for case in json.loads(path.read_text())]
LONG = {"cam-gripper-cams", "swing-twin-rocker-pneumatic-120", "dwell-b1-5", "dwell-a3-3"}
"""A fifth of a second each; their numbers are in the reference cases of their rooms too."""


@pytest.fixture(autouse=True)
def no_remedies(monkeypatch: pytest.MonkeyPatch) -> None:
    """What would repair a finding is sought for long, and is no part of the contract; `make check-full` seeks it."""
    if not ALL:
        monkeypatch.setattr("gearlink.core.base.remedies.trials.Bench.remedy", lambda *_: ())


def close(got: Any, want: Any, rtol: float, atol: float) -> bool:
    if isinstance(want, list):
        return len(got) == len(want) and all(close(g, w, rtol, atol) for g, w in zip(got, want, strict=True))
    if isinstance(want, (str, bool)) or want is None:
        return bool(got == want)
    return math.isfinite(got) and abs(got - want) <= atol + rtol * abs(want)


def row_of(table: dict[str, Any], key: dict[str, float]) -> dict[str, Any]:
    for row in table["rows"]:
        named = dict(zip(table["columns"], row, strict=True))
        if all(abs(named[name] - value) <= 1e-9 for name, value in key.items()):
            return named
    raise AssertionError(f"no row {key}")


@pytest.mark.quick(20)
@pytest.mark.parametrize(
    ("group", "case"),
    [
        pytest.param(group, case, id=name, marks=[pytest.mark.slow] if name in LONG else [])
        for group, case in CASES
        for name in [f"{group}-{case['id']}"]
    ],
)
def test_case(group: str, case: dict[str, Any], gearlink: Any, tmp_path: Path) -> None:
    path = tmp_path / "design.yaml"
    text = json.dumps(case["spec"], indent=1)
    path.write_text(text)
    ended = gearlink(*case["command"].split(), path, *case.get("args", []), "--format", "json")
    assert ended.status == case["exit"] or (case["exit"] is None and ended.status in (0, 1)), ended.out
    if "error" in case:
        check_error(case["error"]["key"], ended.json["errors"], text)
        return
    rtol, atol = case["rtol"], max(case.get("atol", 0.0), 1e-12)
    for name, want in case.get("quantities", {}).items():
        got = ended.json["quantities"][name]["value"]
        assert close(got, want, rtol, atol), f"{name} = {got!r}, want {want!r}"
    for name, want in case.get("checks", {}).items():
        assert want in [c["status"] for c in ended.json["checks"] if c["name"] == name]
    for expected in case.get("tables", []):
        row = row_of(ended.json["tables"][expected["table"]], expected["key"])
        for name, want in expected["expect"].items():
            assert close(row[name], want, rtol, max(expected.get("atol", 0.0), atol)), f"{expected['key']} {name}"


def check_error(key: str, errors: list[dict[str, Any]], text: str) -> None:
    named = [e for e in errors if e["key"] == key or e["key"].startswith((key + ".", key + "["))]
    assert named, errors
    lines = [n for n, line in enumerate(text.splitlines(), 1) if line.strip().startswith(f'"{key.split(".")[-1]}":')]
    if len(lines) == 1 and named[0]["key"] == key:
        assert named[0]["line"] == lines[0]
    assert all(e["line"] and e["column"] and e["code"] and e["message"] for e in errors)
