"""A finding of `gearlink check`, as data."""

from __future__ import annotations

from dataclasses import dataclass

from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.reading.diagnostics import Diagnostic
from gearlink.core.base.report import Check

_STATUS = {"pass": ExitCode.OK, "warn": ExitCode.OK, "fail": ExitCode.FINDING, "error": ExitCode.WRONG_INPUT}


@dataclass(frozen=True, slots=True)
class Finding:
    """A check's outcome, or an error of the file, at a place in the design file.

    `status` is pass, warn, fail, error or fault; `check` is None for errors and faults.
    """

    status: str
    place: Diagnostic
    command: str = ""
    check: Check | None = None

    def exit_status(self, *, strict: bool) -> int:
        """What this finding alone would end the run with."""
        if strict and self.status == "warn":
            return ExitCode.FINDING
        return _STATUS.get(self.status, ExitCode.FAULT)
