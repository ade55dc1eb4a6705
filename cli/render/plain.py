"""Quantities alone, a line each: the value at full precision and its unit."""

from __future__ import annotations

from gearlink.cli.printable import visible
from gearlink.cli.render.markdown_report import text_of
from gearlink.core.base.report import Report


def as_lines(report: Report) -> str:
    """`149.11 149.11 mm` for one quantity; `name = ...` where several were asked for."""
    several = len(report.quantities) > 1
    lines = []
    for quantity in report.quantities:
        unit = "" if quantity.unit == "1" else f" {quantity.unit}"
        lines.append((f"{quantity.name} = " if several else "") + visible(text_of(quantity.value)) + unit)
    return "\n".join(lines)
