"""Findings of `gearlink check`: compiler-like lines with the source, JSON, CSV or Markdown."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from gearlink.cli.commands.finding import Finding
from gearlink.cli.options import Format, Options
from gearlink.cli.printable import json_text
from gearlink.cli.render.errors import fitted
from gearlink.cli.render.json_report import FORMAT, plain_check
from gearlink.core.base.wording import amount

_STATUSES = ("pass", "warn", "fail", "error", "fault")
_HEADS = ("file", "line", "column", "key", "status", "code", "check", "command", "value", "limit", "unit", "message")


def show_findings(found: Sequence[Finding], designs: int, options: Options, *, ok: bool, verbose: bool) -> None:
    """Print the findings and their count; passes only with `verbose`."""
    shown = [finding for finding in found if verbose or finding.status != "pass"]
    counts = {status: sum(finding.status == status for finding in found) for status in _STATUSES}
    if options.format is Format.JSON:
        plain = [_plain(finding) for finding in shown]
        whole = {"gearlink": FORMAT, "command": "check", "ok": ok, "summary": {"designs": designs, **counts}}
        print(json_text({**whole, "findings": plain, **_as_results(found)}))
        return
    if options.format is Format.CSV:
        from gearlink.cli.render.csv_report import write_rows

        rows = [list(_plain(finding).values()) for finding in shown]
        write_rows([_HEADS, *rows], sys.stdout)
        return
    words = ", ".join(f"{count} {status}" for status, count in counts.items() if count) or "nothing wrong"
    verdict = f"{amount(designs, 'design')}: {words}"
    print(_as_markdown(shown, verdict) if options.format is Format.MARKDOWN else _as_text(shown, verdict))
    if shown and not options.quiet:
        print("`gearlink explain CODE` says what a code means and how to repair the design", file=sys.stderr)


def _as_results(found: Sequence[Finding]) -> dict[str, Any]:
    """All checks, and the errors if there are any, each in the form that the results of the other commands have."""
    checks = [{"file": item.place.as_json()["file"], **plain_check(item.check)} for item in found if item.check]
    errors = [finding.place.as_json() for finding in found if finding.status in ("error", "fault")]
    return {"checks": checks} | ({"errors": errors} if errors else {})


def _plain(finding: Finding) -> dict[str, Any]:
    """The finding as a flat record, in the order of `_HEADS`."""
    place, check = finding.place.as_json(), finding.check
    measured = (check.name, check.value, check.limit, check.unit) if check else ("", None, None, "")
    name, value, limit, unit = measured
    values = (place["file"], place["line"], place["column"], place["key"], finding.status, place["code"], name)
    return dict(zip(_HEADS, (*values, finding.command, value, limit, unit, place["message"]), strict=True))


def _as_text(shown: Sequence[Finding], verdict: str) -> str:
    encoding = sys.stdout.encoding or "utf-8"
    lines = []
    for finding in shown:
        name = f" {finding.check.name}" if finding.check else ""
        # A pass needs no line of the source: nothing is to be changed there.
        source = "" if finding.status == "pass" else finding.place.source
        text = replace(finding.place, code=finding.place.code + name, source=source).as_text(encoding)
        lines.append(fitted(text, sys.stdout))
    return "\n".join([*lines, verdict])


def _as_markdown(shown: Sequence[Finding], verdict: str) -> str:
    from gearlink.cli.render.markdown_report import markdown_table

    heads = ("place", "status", "code", "check", "finding")
    rows = []
    for finding in shown:
        plain = _plain(finding)
        place = f"{plain['file']}:{plain['line']}:{plain['column']}"
        rows.append((place, finding.status, plain["code"], plain["check"], plain["message"]))
    return (markdown_table(heads, rows) + "\n\n" if rows else "") + verdict
