"""Files of a batch: per design and command a JSON report, its tables as CSV, and the plot where one is asked for."""

from __future__ import annotations

import csv
import io
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from gearlink.cli.files import safe_stem, write_atomically
from gearlink.cli.render.csv_report import table_rows
from gearlink.cli.render.json_report import as_json

if TYPE_CHECKING:
    from gearlink.cli.batch.options import BatchOptions
    from gearlink.core.design import Design
    from gearlink.core.report import Report


def write_results(source: Path, design: Design, report: Report, options: BatchOptions) -> None:
    """Write STEM-COMMAND.json, STEM-COMMAND-TABLE.csv and the plot into the design's place below `out`.

    Notes
        The place repeats the design file's folders, so that two designs of one name do not meet.

    Raises
        CannotWrite - where the folder or the disk does not take a file
    """
    assert options.out is not None
    folder = options.out.joinpath(*(safe_stem(part) for part in source.parent.parts if part not in ("/", "..", ".")))
    stem = f"{safe_stem(source.stem)}-{report.command.replace(' ', '-')}"
    write_atomically(folder / f"{stem}.json", lambda stream: stream.write(as_json(report).encode()))
    for table in report.tables:
        text = io.StringIO()
        csv.writer(text, lineterminator="\n").writerows(table_rows(table))
        data = text.getvalue().encode()
        write_atomically(folder / f"{stem}-{table.name}.csv", lambda stream, data=data: stream.write(data))  # type: ignore[misc]
    if options.design.plot:
        from gearlink.cli.figures.write import write_plot

        named = replace(options.design, out=folder)
        write_plot(report.command, design, named, stem=safe_stem(source.stem))
