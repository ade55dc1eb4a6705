"""Outcomes of unchanged designs, kept by the content of the file and of everything that decides the result."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable
from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gearlink.cli.batch.outcome import Outcome
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.files import write_atomically
from gearlink.cli.reading.diagnostics import Diagnostic
from gearlink.core.report import Check, Quantity, Report, Table
from gearlink.core.version import VERSION

if TYPE_CHECKING:
    from gearlink.cli.batch.options import BatchOptions


def cached_outcomes(path: Path, options: BatchOptions, compute: Callable[[], list[Outcome]]) -> list[Outcome]:
    """The kept outcomes of a file, or those computed now, which are then kept.

    Notes
        A design whose result files are wanted, or that met a fault, is always computed. A cache entry that
        cannot be read counts as absent.
    """
    assert options.cache is not None
    try:
        content = path.read_bytes()
    except OSError:
        return compute()
    entry = options.cache / f"{_key(path, content, options)}.json"
    if options.out is None and entry.exists():
        try:
            if kept := [_from_plain(item) for item in json.loads(entry.read_text())]:
                return kept
        except (OSError, ValueError, KeyError, TypeError, AttributeError):
            pass
    results = compute()
    if all(outcome.status != ExitCode.FAULT for outcome in results):
        data = json.dumps([_plain(outcome) for outcome in results]).encode()
        write_atomically(entry, lambda stream: stream.write(data))
    return results


def _key(path: Path, content: bytes, options: BatchOptions) -> str:
    design = options.design
    decides = (
        VERSION,
        str(path),
        options.findings_only,
        options.with_places,
        design.strict,
        design.overrides,
        design.samples,
    )
    return hashlib.sha256(repr(decides).encode() + b"\0" + content).hexdigest()


def _plain(outcome: Outcome) -> dict[str, Any]:
    report = outcome.report
    whole = {name: getattr(outcome, name) for name in ("file", "kind", "name", "command", "status")}
    whole["places"] = outcome.places
    whole["errors"] = [asdict(error) for error in outcome.errors]
    if report is not None:
        whole["report"] = {
            "kind": report.kind,
            "name": report.name,
            "command": report.command,
            "quantities": [asdict(q) for q in report.quantities],
            "checks": [asdict(c) for c in report.checks],
            "tables": [[t.name, t.columns, t.units, list(zip(*t.rows(), strict=True))] for t in report.tables],
        }
    return whole


def _from_plain(item: dict[str, Any]) -> Outcome:
    errors = tuple(Diagnostic(**error) for error in item.pop("errors"))
    kept = item.pop("report", None)
    places = tuple((line, column) for line, column in item.pop("places"))
    outcome = Outcome(**item, errors=errors, places=places, cached=True)
    if kept is None:
        return outcome
    report = Report(
        kept["kind"],
        kept["name"],
        kept["command"],
        tuple(Quantity(**q) for q in kept["quantities"]),
        tuple(Check(**c) for c in kept["checks"]),
        tuple(Table(n, tuple(columns), tuple(units), tuple(data)) for n, columns, units, data in kept["tables"]),
    )
    return replace(outcome, report=report)
