"""The options of `batch`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import TypeVar

from gearlink.cli.options import Options

Item = TypeVar("Item")


class BatchFormat(StrEnum):
    """How the summary of a batch is printed."""

    TABLE = "table"
    JSON = "json"
    JSONL = "jsonl"
    CSV = "csv"
    MARKDOWN = "md"
    JUNIT = "junit"
    SARIF = "sarif"
    GITHUB = "github"


class Added(StrEnum):
    """Commands that a batch runs on request alone."""

    TOLERANCE = "tolerance"
    REGISTER = "register"


class FailOn(StrEnum):
    """What ends a batch with status 1."""

    FAILURE = "failure"
    WARNING = "warning"


class Unchanged(StrEnum):
    """What becomes of designs that have not changed since they passed."""

    COMPUTE = "compute"
    SKIP = "skip"


@dataclass(frozen=True, slots=True)
class BatchOptions:
    """What the user asked for; `design` holds what each design is run with.

    `shard` is (i, n): the i-th of n shares of the files, counted from 1. `jobs` 0 lets the program choose;
    `dask` is the address of a scheduler whose workers compute, instead of processes.
    `unchanged` says what becomes of designs whose results in `out` are those that would be made again. `added` are
    commands that run on files with a section `tolerance` as well.
    """

    design: Options = field(default_factory=Options)
    format: BatchFormat = BatchFormat.TABLE
    out: Path | None = None
    unchanged: Unchanged = Unchanged.COMPUTE
    shard: tuple[int, int] = (1, 1)
    jobs: int = 0
    dask: str = ""
    added: tuple[str, ...] = ()

    @property
    def findings_only(self) -> bool:
        """Whether no output shows the designs' quantities and tables; then no table is computed."""
        return self.format not in (BatchFormat.JSON, BatchFormat.JSONL) and self.out is None

    @property
    def with_places(self) -> bool:
        """Whether the output names the line of the file that a finding is about."""
        return self.format in (BatchFormat.JUNIT, BatchFormat.SARIF, BatchFormat.GITHUB)

    def share_of(self, items: Sequence[Item]) -> list[Item]:
        """This shard's share; the shares of all shards are disjoint and make up the whole.

        Example
            >>> [BatchOptions(shard=(i, 3)).share_of("abcde") for i in (1, 2, 3)]
            [['a', 'd'], ['b', 'e'], ['c']]
        """
        index, count = self.shard
        return list(items[index - 1 :: count])
