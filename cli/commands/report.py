"""`gearlink report`: a design as one self-contained HTML page, for reading and for print.

Everything is in the file: inputs, results with symbol, unit and source, findings, tables, sheets, film, and the scripts
of player and cursor. It holds no date, so the same design gives the same bytes.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator, Sequence
from dataclasses import replace
from html import escape
from itertools import chain
from typing import TYPE_CHECKING, Any

from gearlink.cli.evaluate import build, exit_status, open_design, read_spec
from gearlink.cli.files import CannotWrite, safe_stem, write_atomically
from gearlink.cli.options import Options
from gearlink.cli.patience import patience
from gearlink.cli.printable import visible
from gearlink.cli.reading.diagnostics import DesignFileError
from gearlink.cli.render.errors import show_refusal
from gearlink.core.errors import NoSolution

if TYPE_CHECKING:
    from gearlink.core.design import Design
    from gearlink.core.kinds import Kind
    from gearlink.core.report import Report

    Part = tuple[Design, Report]

_PARTS: list[Part] = []
"""What forked processes draw: it needs no way to them."""


def run_report(source: str, options: Options) -> int:
    """Write NAME.html into the folder of the options and give the worst exit status of the design's commands."""
    from gearlink.cli.page.sections import whole_page

    try:
        loaded, kind = open_design(source, options)
        spec = read_spec(loaded, kind, source)
        with patience(f"computing {spec.name}", quiet=options.quiet):
            parts = [
                build(loaded, kind, command, spec, replace(options, tables=_tables(kind, command, spec)))
                for command in (*spec.commands(), *_budgets(kind, spec))
            ]
        with patience(f"drawing {spec.name}", quiet=options.quiet):
            page = whole_page(spec.name, _body(loaded.text, spec, parts))
        path = options.out / f"{safe_stem(spec.name)}.html"
        write_atomically(path, lambda stream: stream.write(page.encode()))
    except (DesignFileError, CannotWrite, NoSolution) as error:
        return show_refusal(error, source, options)
    if not options.quiet:
        print(f"wrote {visible(str(path))}", file=sys.stderr)
    return max(exit_status(report, strict=options.strict) for _, report in parts)


def _tables(kind: Kind, command: str, spec: Any) -> tuple[str, ...]:
    """The extra tables of a command on the page."""
    shown: tuple[str, ...] = kind.design_class(command).tables_of_page(command, spec)
    return shown


def _budgets(kind: Kind, spec: Any) -> Iterator[str]:
    """Register budget and tolerance study of a file that has them; samples that take long have their own command."""
    if getattr(spec, "tolerance", None) is None:
        return
    if getattr(spec, "register_", None) is not None and "register" in kind.commands:
        yield "register"
    study: Any = kind.design("tolerance", spec)
    if study.is_short:
        yield "tolerance"


def _body(text: str, spec: Any, parts: Sequence[Part]) -> Iterator[str]:
    from gearlink.cli.page import sections

    sheets = _sheets(parts)
    first = next(sheets)  # what is not a sheet is made while other processes draw the others
    yield sections.head(spec, parts)
    yield sections.film(parts)
    yield sections.given(text, spec)
    results = [sections.results(report) for _, report in parts]
    for (_, report), sheet, result in zip(parts, chain([first], sheets), results, strict=True):
        yield f"<h2>{escape(report.command)}</h2>"
        yield sheet
        yield result


def _sheets(parts: Sequence[Part]) -> Iterator[str]:
    """The sheets, which take most of the time: on a machine with several processors the others beside the first."""
    spare = len(os.sched_getaffinity(0)) - 1 if sys.platform == "linux" else 0
    if min(spare, len(parts) - 1) < 1:
        yield from (_sheet(part) for part in parts)
        return
    import matplotlib.figure  # noqa: F401 - the forked processes have it then

    from gearlink.cli.workers import workers

    _PARTS[:] = parts
    with workers(min(spare, len(parts) - 1)) as pool:
        others = [pool.submit(_other_sheet, i) for i in range(1, len(parts))]
        yield _sheet(parts[0])
        for part, other in zip(parts[1:], others, strict=True):
            yield other.result() or _sheet(part)


def _sheet(part: Part) -> str:
    from gearlink.cli.page.sheets import sheet

    design, report = part
    return sheet(report.command, design, report.checks)


def _other_sheet(i: int) -> str:
    """A sheet in a process of its own; empty where the design refuses it, which the parent then says."""
    try:
        return _sheet(_PARTS[i])
    except NoSolution:
        return ""
