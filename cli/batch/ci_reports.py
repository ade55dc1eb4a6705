"""Batch results in the formats that CI systems read: JUnit XML, SARIF 2.1.0, GitHub workflow commands."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import PurePath
from typing import Any
from xml.sax.saxutils import escape, quoteattr

from gearlink.cli.batch.outcome import Fix, Outcome
from gearlink.cli.printable import json_text, visible
from gearlink.cli.texts.codes import explanations
from gearlink.core.version import VERSION

_SARIF_LEVEL = {"fail": "error", "warn": "warning"}


def _findings(outcome: Outcome) -> Iterator[tuple[str, str, str, str, int, int]]:
    """Status, code, name, message, line, column of everything to repair."""
    for error in outcome.errors:
        yield "fail", error.code, "input", error.as_sentence, error.line, error.column
    for check, (line, column) in zip(outcome.to_repair, outcome.places, strict=True):
        yield check.status, check.code, check.name, check.message, line, column


def as_junit(results: Sequence[Outcome]) -> str:
    """JUnit XML: a suite per design file, a case per command; a wrong file is an error, a failed check a failure."""
    by_file: dict[str, list[Outcome]] = {}
    for outcome in results:
        by_file.setdefault(outcome.file, []).append(outcome)
    lines = ['<?xml version="1.0" encoding="UTF-8"?>', '<testsuites name="gearlink">']
    for file, group in by_file.items():
        failures = sum(_is_failure(o) for o in group)
        errors = sum(not o.has_report for o in group)
        seconds = sum(o.seconds for o in group)
        lines.append(
            f'  <testsuite name={_attribute(file)} tests="{len(group)}" failures="{failures}" errors="{errors}" '
            f'time="{seconds:.6f}">'
        )
        for outcome in group:
            lines += _junit_case(outcome)
        lines.append("  </testsuite>")
    return "\n".join([*lines, "</testsuites>"]) + "\n"


def _is_failure(outcome: Outcome) -> bool:
    return outcome.has_report and outcome.status != 0


def _junit_case(outcome: Outcome) -> Iterator[str]:
    kind, name = outcome.kind or "unreadable", f"{outcome.name}: {outcome.command or 'read'}"
    case = f'<testcase classname={_attribute(kind)} name={_attribute(name)} time="{outcome.seconds:.6f}"'
    found = list(_findings(outcome))
    if outcome.has_report and not found:
        yield f"    {case} />"
        return
    tag = head = "system-out"
    if not outcome.has_report or _is_failure(outcome):
        tag = "failure" if outcome.has_report else "error"
        _, code, _, message, _, _ = found[0]
        head = f"{tag} message={_attribute(message)} type={_attribute(code)}"
    text = "\n".join(
        f"{outcome.file}:{line}:{column}: {code} {name}: {words}" for _, code, name, words, line, column in found
    )
    yield f"    {case}>"
    yield f"      <{head}>{escape(_xml_text(text))}</{tag}>"
    yield "    </testcase>"


def _attribute(text: str) -> str:
    return quoteattr(_xml_text(text))


_NOT_XML = re.compile("[\x00-\x08\x0b-\x1f\ud800-\udfff\ufffe\uffff]")


def _xml_text(text: str) -> str:
    """Without the control characters that XML 1.0 does not know."""
    return _NOT_XML.sub("?", text)


def as_sarif(results: Sequence[Outcome]) -> str:
    """SARIF 2.1.0: a result per finding, at the line of the design file."""
    entries: list[dict[str, Any]] = []
    rules: dict[str, dict[str, Any]] = {}
    for outcome in results:
        found = list(_findings(outcome))
        fixes: list[tuple[Fix, ...]] = [()] * len(outcome.errors) + list(outcome.fixes)
        fixes += [()] * (len(found) - len(fixes))
        for fix, (status, code, name, message, line, column) in zip(fixes, found, strict=True):
            rules.setdefault(code, _rule(code, name))
            region = {"startLine": line, "startColumn": column}
            place = {"artifactLocation": {"uri": _uri(outcome.file)}, "region": region}
            entry = {
                "ruleId": code,
                "level": _SARIF_LEVEL[status],
                "message": {"text": f"{outcome.name} ({outcome.command or 'read'}): {message}"},
                "locations": [{"physicalLocation": place}],
            }
            entries.append(entry | {"fixes": [_sarif_fix(outcome.file, fix)]} if fix else entry)
    driver = {"name": "gearlink", "version": VERSION, "rules": [rules[code] for code in sorted(rules)]}
    run = {"tool": {"driver": driver}, "columnKind": "unicodeCodePoints", "results": entries}
    schema = "https://json.schemastore.org/sarif-2.1.0.json"
    return json_text({"$schema": schema, "version": "2.1.0", "runs": [run]}, indent=1) + "\n"


def _sarif_fix(file: str, fix: Sequence[Fix]) -> dict[str, Any]:
    """The replacement of values, as SARIF writes it."""
    replacements = [
        {
            "deletedRegion": {"startLine": f.line, "startColumn": f.column, "endLine": f.line, "endColumn": f.end},
            "insertedContent": {"text": f.text},
        }
        for f in fix
    ]
    words = " and ".join(f"line {f.line}, column {f.column} by {f.text}" for f in fix)
    return {
        "description": {"text": f"replace {words}"},
        "artifactChanges": [{"artifactLocation": {"uri": _uri(file)}, "replacements": replacements}],
    }


def _rule(code: str, name: str) -> dict[str, Any]:
    known = explanations()[code]
    return {
        "id": code,
        "name": name,
        "shortDescription": {"text": known.title},
        "fullDescription": {"text": f"{known.what} {known.why}"},
        "help": {"text": known.remedy},
    }


def _uri(file: str) -> str:
    from urllib.parse import quote

    return quote(PurePath(file).as_posix().encode("utf-8", "surrogateescape"))


def as_github(results: Sequence[Outcome]) -> str:
    """Workflow commands, which GitHub shows at the line of the file."""
    lines = []
    for outcome in results:
        for status, code, name, message, line, column in _findings(outcome):
            place = f"file={_property(outcome.file)},line={line},col={column},title={_property(f'{code} {name}')}"
            words = _data(f"{outcome.name} ({outcome.command or 'read'}): {message}")
            lines.append(f"::{_SARIF_LEVEL[status]} {place}::{words}")
    return "".join(line + "\n" for line in lines)


def _data(text: str) -> str:
    return visible(text).replace("%", "%25")


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")
