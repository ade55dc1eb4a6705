"""What a summary costs: lines of a large batch are written one after the other."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from gearlink.cli.batch.options import BatchFormat, BatchOptions
from gearlink.cli.batch.outcome import Outcome
from gearlink.cli.batch.summary import write_batch


class Pieces:
    """A stream that keeps how long each piece was."""

    def __init__(self) -> None:
        self.lengths: list[int] = []

    def write(self, text: str) -> None:
        self.lengths.append(len(text))

    def writelines(self, lines: Iterable[str]) -> None:
        for line in lines:
            self.write(line)


def test_lines_are_written_one_after_the_other() -> None:
    stream: Any = Pieces()
    results = [Outcome(f"{i:03d}.yaml", "gear-pair", "pair", "gear", 2) for i in range(50)]
    write_batch(results, BatchOptions(format=BatchFormat.JSONL), stream)
    assert len(stream.lengths) == 50
    assert len(set(stream.lengths)) == 1
