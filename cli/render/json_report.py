"""Reports as JSON: shortest round-trip doubles, in the units of the design files."""

from __future__ import annotations

from typing import Any

from gearlink.cli.printable import json_text
from gearlink.core.base.report import Check, Report

FORMAT = 1


def as_plain(report: Report) -> dict[str, Any]:
    """The report as plain dictionaries and lists."""
    return {
        "gearlink": FORMAT,
        "kind": report.kind,
        "name": report.name,
        "command": report.command,
        "ok": report.ok,
        "quantities": {q.name: {"value": q.value, "unit": q.unit, "symbol": q.symbol} for q in report.quantities},
        "checks": [plain_check(check) for check in report.checks],
        "tables": {
            t.name: {"columns": list(t.columns), "units": list(t.units), "rows": t.rows()} for t in report.tables
        },
    }


def plain_check(check: Check) -> dict[str, Any]:
    """One check as it stands in the `checks` of a result."""
    plain: dict[str, Any] = {
        "code": check.code,
        "name": check.name,
        "status": check.status,
        "value": check.value,
        "limit": check.limit,
        "unit": check.unit,
        "message": check.message,
        "fix": check.fix,
        "note": list(check.note),
    }
    if check.remedy:
        plain["remedy"] = [{"key": key, "value": value} for key, value in check.remedy]
    return plain


def as_json(report: Report) -> str:
    """The report as JSON text."""
    return json_text(as_plain(report))
