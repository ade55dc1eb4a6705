"""What a summary costs: lines of a large batch are written one after the other."""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import pytest

from gearlink.cli.batch.options import BatchFormat, BatchOptions
from gearlink.cli.batch.summary import JsonLines, Outcome, write_batch
from gearlink.core.base.report import Check, Quantity, Report


class Pieces:
    """A stream that keeps what it was given, piece by piece."""

    def __init__(self) -> None:
        self.pieces: list[str] = []

    def write(self, text: str) -> None:
        self.pieces.append(text)

    def writelines(self, lines: Iterable[str]) -> None:
        for line in lines:
            self.write(line)


RESULTS = [Outcome(f"{i:03d}.yaml", "gear-pair", "pair", "gear", 2).for_output(BatchFormat.JSON) for i in range(50)]


def test_lines_are_written_in_the_order_of_the_files_as_soon_as_they_can_be() -> None:
    stream: Any = Pieces()
    lines = JsonLines([Path(result.file) for result in reversed(RESULTS)], stream)

    def written() -> list[str]:
        return [json.loads(line)["file"] for line in stream.pieces]

    lines.add(RESULTS[2:4])
    assert written() == []
    lines.add(RESULTS[:2])
    assert written() == [result.file for result in RESULTS[:4]]
    lines.add(RESULTS[9:10])
    lines.add(RESULTS[7:8])  # interrupted here
    lines.end()
    assert written()[4:] == ["007.yaml", "009.yaml"]


def test_an_outcome_keeps_no_more_than_the_output_shows() -> None:
    checks = (Check("GL301", "gap", "pass", "gap"), Check("GL302", "shaft", "fail", "shaft"))
    quantity = Quantity("module", 2.0, "mm", "m", "module")
    whole = Outcome("a.yaml", "k", "n", "gear", 1, Report("k", "n", "gear", (quantity,), checks))
    light = whole.for_output(BatchFormat.JSON)
    assert light.report is not None
    assert json.loads(light.shown)["quantities"]["module"]["value"] == 2.0
    assert (light.report.quantities, [one.code for one in light.report.checks]) == ((), ["GL302"])
    assert (light.verdict, light.findings) == (whole.verdict, whole.findings)
    assert whole.for_output(BatchFormat.TABLE).shown == ""


@pytest.mark.parametrize("count", [0, 1, 50])
def test_json_is_written_design_by_design_and_is_one_value(count: int) -> None:
    stream: Any = Pieces()
    write_batch(RESULTS[:count], BatchOptions(format=BatchFormat.JSON), stream)
    whole = json.loads("".join(stream.pieces))
    assert [design["file"] for design in whole["designs"]] == [result.file for result in RESULTS[:count]]
    assert (whole["command"], whole["ok"]) == ("batch", count == 0)
    assert sum(".yaml" in piece for piece in stream.pieces) == count
