"""What became of one command on one design file of a batch."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.reading.diagnostics import Diagnostic
from gearlink.core.base.report import Check, Report


@dataclass(frozen=True, slots=True)
class Fix:
    """A value of a design file to be replaced: its line, first column, the column after it, and the new text."""

    line: int
    column: int
    end: int
    text: str


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of one command on one design file.

    `places` holds line and column of each check that did not pass, where the output of the batch shows them, `fixes`
    what its remedy replaces together; nothing where the file does not have all of its values.
    `wrote` names the files of its results; of a design that was not computed `unchanged` is the report in them, where
    the output of the batch shows reports.
    """

    file: str
    kind: str
    name: str
    command: str
    status: int
    report: Report | None = None
    errors: tuple[Diagnostic, ...] = ()
    places: tuple[tuple[int, int], ...] = ()
    fixes: tuple[tuple[Fix, ...], ...] = ()
    seconds: float = 0.0
    wrote: tuple[str, ...] = ()
    unchanged: dict[str, Any] | None = None

    @property
    def has_report(self) -> bool:
        """Whether the command gave a report, now or when its results were written."""
        return self.report is not None or self.unchanged is not None

    @property
    def verdict(self) -> str:
        """One word: pass, warn, fail, error or fault."""
        if self.unchanged is not None:
            return "pass"
        if self.report is None:
            return "error" if self.status == ExitCode.WRONG_INPUT else "fault"
        found = {check.status for check in self.to_repair}
        return "fail" if "fail" in found else "warn" if "warn" in found else "pass"

    @property
    def findings(self) -> list[str]:
        """Every error, or everything to repair, the worst first."""
        errors = [f"{error.line}:{error.column} {error.code}: " + "\n".join(error.lines) for error in self.errors]
        worst_first = sorted(self.to_repair, key=lambda check: check.status != "fail")
        return errors + ["\n".join((f"{c.code} {c.name}: {c.lines[0]}", *c.lines[1:])) for c in worst_first]

    @property
    def to_repair(self) -> list[Check]:
        """The checks that did not pass."""
        return [] if self.report is None else [c for c in self.report.checks if c.status != "pass"]


def summary(results: Sequence[Outcome]) -> dict[str, int]:
    """How many designs came out how."""
    counts = dict.fromkeys(("pass", "warn", "fail", "error", "fault"), 0)
    for outcome in results:
        counts[outcome.verdict] += 1
    return counts
