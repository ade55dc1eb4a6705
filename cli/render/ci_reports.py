"""Batch results in the formats that CI systems read: JUnit XML, SARIF 2.1.0, GitHub workflow commands."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Sequence
from functools import lru_cache
from pathlib import PurePath
from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree

from gearlink.cli.batch import Outcome
from gearlink.core.version import VERSION

if TYPE_CHECKING:
    from gearlink.cli.design_file import LoadedFile
    from gearlink.core.report import Check

_SARIF_LEVEL = {"fail": "error", "warn": "warning"}


def _findings(outcome: Outcome) -> Iterator[tuple[str, str, str, str, int, int]]:
    """Status, code, name, message, line, column of everything to mend."""
    for error in outcome.errors:
        yield "fail", error.code, "input", error.message, error.line, error.column
    if outcome.report is not None:
        for check in outcome.report.checks:
            if check.status != "pass":
                yield check.status, check.code, check.name, check.message, *_place(outcome.file, check)


def _place(file: str, check: Check) -> tuple[int, int]:
    """Line and column of the key that a check is about; the file's start where it can no longer be read."""
    from gearlink.cli.check import key_of
    from gearlink.cli.design_file import DesignFileError, parse_path

    try:
        loaded = _loaded(file)
    except DesignFileError:
        return 1, 1
    line, column, _ = loaded.locate(parse_path(key_of(loaded.data, check)) or ("kind",))
    return line, column


@lru_cache(maxsize=1)
def _loaded(file: str) -> LoadedFile:
    """The file read once for all its findings."""
    from gearlink.cli.design_file import load

    return load(file)


def as_junit(results: Sequence[Outcome]) -> str:
    """JUnit XML: a suite per design file, a case per command; a wrong file is an error, a failed check a failure."""
    root = ElementTree.Element("testsuites", name="gearlink")
    by_file: dict[str, list[Outcome]] = {}
    for outcome in results:
        by_file.setdefault(outcome.file, []).append(outcome)
    for file, group in by_file.items():
        bad = [outcome.verdict for outcome in group]
        suite = ElementTree.SubElement(
            root,
            "testsuite",
            name=_xml_text(file),
            tests=str(len(group)),
            failures=str(sum(_is_failure(o) for o in group)),
            errors=str(sum(v in ("error", "fault") for v in bad)),
            time=f"{sum(o.seconds for o in group):.6f}",
        )
        for outcome in group:
            _junit_case(suite, outcome)
    ElementTree.indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + ElementTree.tostring(root, encoding="unicode") + "\n"


def _is_failure(outcome: Outcome) -> bool:
    return outcome.report is not None and outcome.status != 0


def _junit_case(suite: ElementTree.Element, outcome: Outcome) -> None:
    case = ElementTree.SubElement(
        suite,
        "testcase",
        classname=_xml_text(outcome.kind or "unreadable"),
        name=_xml_text(f"{outcome.name}: {outcome.command or 'read'}"),
        time=f"{outcome.seconds:.6f}",
    )
    found = list(_findings(outcome))
    if outcome.report is None:
        tag = "error"
    elif _is_failure(outcome):
        tag = "failure"
    else:
        tag = "system-out" if found else ""
    if not tag:
        return
    text = "\n".join(
        f"{outcome.file}:{line}:{column}: {code} {name}: {words}" for _, code, name, words, line, column in found
    )
    node = ElementTree.SubElement(case, tag)
    node.text = _xml_text(text)
    if tag != "system-out":
        node.set("message", _xml_text(found[0][3] if found else ""))
        node.set("type", found[0][1] if found else "")


_NOT_XML = re.compile("[\x00-\x08\x0b-\x1f\ud800-\udfff]")


def _xml_text(text: str) -> str:
    """Without the control characters that XML 1.0 does not know."""
    return _NOT_XML.sub("?", text)


def as_sarif(results: Sequence[Outcome]) -> str:
    """SARIF 2.1.0: a result per finding, at the line of the design file."""
    entries: list[dict[str, Any]] = []
    rules: dict[str, dict[str, Any]] = {}
    for outcome in results:
        for status, code, name, message, line, column in _findings(outcome):
            rules.setdefault(code, {"id": code, "name": name, "shortDescription": {"text": name}})
            region = {"startLine": line, "startColumn": column}
            place = {"artifactLocation": {"uri": _uri(outcome.file)}, "region": region}
            entries.append(
                {
                    "ruleId": code,
                    "level": _SARIF_LEVEL[status],
                    "message": {"text": f"{outcome.name} ({outcome.command or 'read'}): {message}"},
                    "locations": [{"physicalLocation": place}],
                }
            )
    driver = {"name": "gearlink", "version": VERSION, "rules": [rules[code] for code in sorted(rules)]}
    run = {"tool": {"driver": driver}, "columnKind": "unicodeCodePoints", "results": entries}
    schema = "https://json.schemastore.org/sarif-2.1.0.json"
    return json.dumps({"$schema": schema, "version": "2.1.0", "runs": [run]}, ensure_ascii=False, indent=1) + "\n"


def _uri(file: str) -> str:
    from urllib.parse import quote

    return quote(PurePath(file).as_posix())


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
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")
