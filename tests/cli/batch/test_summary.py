"""What a summary costs: lines of a large batch are written one after the other."""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import Any

import pytest

from gearlink.cli.batch.options import BatchFormat, BatchOptions
from gearlink.cli.batch.summary import Outcome, write_batch


class Pieces:
    """A stream that keeps what it was given, piece by piece."""

    def __init__(self) -> None:
        self.pieces: list[str] = []

    def write(self, text: str) -> None:
        self.pieces.append(text)

    def writelines(self, lines: Iterable[str]) -> None:
        for line in lines:
            self.write(line)


RESULTS = [Outcome(f"{i:03d}.yaml", "gear-pair", "pair", "gear", 2) for i in range(50)]


def test_lines_are_written_one_after_the_other() -> None:
    stream: Any = Pieces()
    write_batch(RESULTS, BatchOptions(format=BatchFormat.JSONL), stream)
    assert len(stream.pieces) == 50
    assert len(set(map(len, stream.pieces))) == 1


@pytest.mark.parametrize("count", [0, 1, 50])
def test_json_is_written_design_by_design_and_is_one_value(count: int) -> None:
    stream: Any = Pieces()
    write_batch(RESULTS[:count], BatchOptions(format=BatchFormat.JSON), stream)
    whole = json.loads("".join(stream.pieces))
    assert [design["file"] for design in whole["designs"]] == [result.file for result in RESULTS[:count]]
    assert (whole["command"], whole["ok"]) == ("batch", count == 0)
    assert sum(".yaml" in piece for piece in stream.pieces) == count
