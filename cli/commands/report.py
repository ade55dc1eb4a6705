"""`gearlink report`: a design as one self-contained HTML page, for reading and for print.

Everything is in the file: inputs, results with symbol, unit and source, findings, tables, pictures. It holds no
date and no script, so the same design gives the same bytes.
"""

from __future__ import annotations

import base64
import io
import math
import sys
from collections.abc import Iterable, Iterator, Sequence
from html import escape
from typing import TYPE_CHECKING, Any

from gearlink.cli.evaluate import build, exit_status, open_design, read_spec
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.files import CannotWrite, safe_stem, write_atomically
from gearlink.cli.options import Options
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.render.errors import show_errors
from gearlink.cli.render.numbers import number, quiet, readable_rows, scales, thinning
from gearlink.core.nomenclature import term
from gearlink.core.version import VERSION

if TYPE_CHECKING:
    from gearlink.core.design import Design
    from gearlink.core.report import Report, Table

_MOST_ROWS = 37
_STYLE = """
body { font: 11pt/1.45 system-ui, sans-serif; color: #222; max-width: 52em; margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.6em; margin-bottom: 0; } h2 { margin-top: 2em; border-bottom: 2px solid #0072b2; }
h3 { margin-bottom: .3em; } .kind { color: #666; margin-top: 0; }
table { border-collapse: collapse; margin: .5em 0 1em; font-size: .9em; }
th, td { padding: .15em .7em .15em 0; text-align: left; vertical-align: top; border-bottom: 1px solid #ddd; }
td.n, th.n { text-align: right; font-variant-numeric: tabular-nums; }
td.n { white-space: nowrap; } th { vertical-align: bottom; }
h2, h3 { break-after: avoid; } .keys { columns: 2; }
.pass { color: #00704f; } .warn { color: #9a6700; } .fail { color: #c0392b; font-weight: bold; }
pre { background: #f6f6f6; padding: .8em; white-space: pre-wrap; font-size: .85em; }
img { max-width: 100%; height: auto; break-inside: avoid; } tr, pre { break-inside: avoid; }
.note { color: #666; font-size: .85em; }
@page { size: A4; margin: 18mm 16mm; }
@media print {
  body { margin: 0; max-width: none; font-size: 9.5pt; }
  img { max-height: 235mm; width: auto; display: block; margin: 0 auto; }
  h2 { break-before: page; } h2.first { break-before: auto; }
}
"""


def run_report(source: str, options: Options) -> int:
    """Write NAME.html into the folder of the options and give the worst exit status of the design's commands."""
    try:
        loaded, kind = open_design(source, options)
        spec = read_spec(loaded, kind, source)
        parts = [build(loaded, kind, command, spec, options) for command in spec.commands()]
        page = _page(loaded.text, spec, parts)
        path = options.out / f"{safe_stem(spec.name)}.html"
        write_atomically(path, lambda stream: stream.write(page.encode()))
    except DesignFileError as error:
        show_errors(error.diagnostics, options)
        return ExitCode.WRONG_INPUT
    except CannotWrite as error:
        show_errors([Diagnostic("GL116", str(error), file=source)], options)
        return ExitCode.WRONG_INPUT
    if not options.quiet:
        print(f"wrote {path}", file=sys.stderr)
    return max(exit_status(report, strict=options.strict) for _, report in parts)


def _page(text: str, spec: Any, parts: Sequence[tuple[Design, Report]]) -> str:
    name = escape(spec.name)
    body = [
        f"<h1>{name}</h1>",
        f'<p class="kind">{escape(spec.kind)}, computed with gearlink {VERSION}</p>',
        _verdict(parts),
        '<h2 class="first">Input</h2>',
        f"<pre>{escape(text.rstrip())}</pre>",
        "<h3>Keys in force, defaults included</h3>",
        f'<div class="keys">{_table(("key", "value"), _keys(spec.model_dump(by_alias=True)), numeric=())}</div>',
    ]
    for design, report in parts:
        body += _part(design, report)
    head = f'<meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>{name}</title>'
    return f'<!DOCTYPE html>\n<html lang="en"><head>{head}<style>{_STYLE}</style></head>\n<body>\n' + "\n".join(
        [*body, "</body></html>", ""]
    )


def _verdict(parts: Sequence[tuple[Design, Report]]) -> str:
    checks = [check for _, report in parts for check in report.checks]
    words = []
    for status, word in (("fail", "failed"), ("warn", "warnings"), ("pass", "passed")):
        count = sum(check.status == status for check in checks)
        if count:
            words.append(f'<span class="{status}">{count} {word}</span>')
    return f"<p>Checks: {', '.join(words) or 'none'}</p>"


def _keys(node: Any, path: str = "") -> Iterator[tuple[str, str]]:
    """Dotted keys and values of a spec, those left out without a default not shown."""
    if isinstance(node, dict):
        for key, value in node.items():
            yield from _keys(value, f"{path}.{key}" if path else str(key))
    elif node is not None:
        yield path, str(node)


def _part(design: Design, report: Report) -> Iterator[str]:
    yield f"<h2>{escape(report.command)}</h2>"
    yield _picture(report.command, design)
    if report.quantities:
        scale = scales(report)
        rows = (
            (
                q.name.replace("_", " "),
                q.symbol,
                number(quiet(q.value, scale.get(q.unit, 0.0)), 9),
                "" if q.unit == "1" else q.unit,
                q.words,
                term(q.name).source,
            )
            for q in report.quantities
        )
        yield "<h3>Results</h3>" + _table(
            ("quantity", "symbol", "value", "unit", "meaning", "source"), rows, numeric=(2,)
        )
    if report.checks:
        order = ("fail", "warn", "pass")
        found = sorted(report.checks, key=lambda check: order.index(check.status))
        findings = ((c.status, f"{c.code} {c.name}", c.message) for c in found)
        yield "<h3>Checks</h3>" + _table(("status", "check", "finding"), findings, numeric=(), marked=True)
    for table in report.tables:
        yield _data(table)


def _picture(command: str, design: Design) -> str:
    from gearlink.cli.figures.write import picture

    stream = io.BytesIO()
    picture(command, design, stream, "png")
    data = base64.b64encode(stream.getvalue()).decode()
    return f'<p><img alt="{escape(command)} of {escape(design.spec.name)}" src="data:image/png;base64,{data}"></p>'


def _data(table: Table) -> str:
    count = len(table.data[0])
    step = max(1, math.ceil(count / _MOST_ROWS))
    step = next((s for s in (1, 2, 5, 10, 20, 30) if s >= step), step)
    heads = [
        f"{c.replace('_', ' ')} [{u}]" if u != "1" else c.replace("_", " ")
        for c, u in zip(table.columns, table.units, strict=True)
    ]
    note = f'<p class="note">{thinning(step, table)}</p>' if step > 1 else ""
    title = escape(table.name.replace("_", " "))
    return f"<h3>{title}</h3>{note}" + _table(heads, readable_rows(table, step), numeric=range(len(heads)))


def _table(heads: Sequence[str], rows: Iterable[Sequence[str]], *, numeric: Iterable[int], marked: bool = False) -> str:
    """An HTML table; with `marked` the first cell of a row is its style."""
    right = set(numeric)

    def cells(tag: str, row: Sequence[str]) -> str:
        return "".join(f"<{tag}{' class=n' if i in right else ''}>{escape(cell)}</{tag}>" for i, cell in enumerate(row))

    lines = [f"<tr{f' class={row[0]}' if marked else ''}>{cells('td', row)}</tr>" for row in rows]
    return f"<table><thead><tr>{cells('th', heads)}</tr></thead><tbody>\n" + "\n".join(lines) + "</tbody></table>"
