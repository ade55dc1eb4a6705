"""What a study found, on a terminal: a line of counts, the rows to be shown, and why there are no more."""

from __future__ import annotations

from gearlink.cli.options import Options
from gearlink.cli.printable import visible
from gearlink.cli.render.numbers import number
from gearlink.cli.render.terminal import console_for, grid_for, show_findings, show_grid, show_table
from gearlink.core.base.report import Report, Table
from gearlink.core.base.wording import amount
from gearlink.core.studies.explore.exploration import Exploration
from gearlink.core.studies.explore.front import SHOWN


def show(study: Exploration, report: Report, options: Options) -> None:
    """Print a study."""
    from rich.text import Text

    console = console_for(options)
    console.print(
        Text(f"{visible(' '.join(report.name.split()))}: explore {study.problem.base.kind.name}", style="bold")
    )
    console.print(Text(_counts(study)))
    front = next(table for table in report.tables if table.name == "front")
    if study.kept:
        show_table(_shown(study, front), console, most=SHOWN, digits=options.digits)
        for line in _below(study):
            console.print(Text(line))
    _why(study, console)
    show_findings(report, console)


def _counts(study: Exploration) -> str:
    how = "all evaluated" if study.exhaustive else "sampled, not exhaustive"
    objectives = study.problem.objectives
    resolution = ", ".join(f"{w.resolution:g}{'' if w.unit == '1' else ' ' + w.unit}" for w in objectives)
    front = f"front {study.front_size:,}, kept {study.kept:,} (resolution {resolution})"
    if len(objectives) == 1:
        front = f"best {study.kept:,} (resolution {resolution})"
    return (
        f"{amount(study.designs, 'design', spec=',')}, {how}; {study.refused:,} without a mechanism; "
        f"{study.feasible:,} {'satisfies' if study.feasible == 1 else 'satisfy'} {study.problem.asked}; {front}"
    )


def _shown(study: Exploration, front: Table) -> Table:
    """The rows that are shown, the knee marked."""
    places = study.found.chosen
    data = [[column[i] for i in places] for column in front.data]
    data[0] = [f"{index} *" if index == study.knee else f"{index}" for index in data[0]]
    heads = tuple(name.replace(".", "_") for name in front.columns)  # a heading is folded there
    return Table(front.name, heads, front.units, tuple(data))


def _below(study: Exploration) -> list[str]:
    lines = []
    if study.kept > study.shown:
        lines.append(
            f"{study.shown} of {amount(study.kept, 'row')}, far from each other; coarsen the resolutions, or use csv"
        )
    if study.knee is not None:
        lines.append("* knee: the minimum sum of objectives scaled to the front; a mark, no verdict")
    lines.append("--show INDEX prints a design's file, --write DIR writes all kept ones")
    return lines


def _why(study: Exploration, console: object) -> None:
    """Rows that fail some design; the others have removed nothing."""
    rows = [(i, *row) for i, row in enumerate(study.found.why, 1) if row[2].fails]
    if not rows:
        return
    grid = grid_for(console)  # type: ignore[arg-type]
    for head in ("fails", "code", "designs", "alone", "nearest miss", "file of it"):
        grid.add_column(head, justify="right" if head in ("designs", "alone") else "left", overflow="fold")
    for place, name, code, miss in rows:
        unit = "" if miss.unit == "1" else f" {miss.unit}"
        near = "" if miss.value is None else f"{_beside(miss.value, miss.limit)}{unit}"
        grid.add_row(name, code or "", f"{miss.fails:,}", f"{miss.alone:,}", near, f"--show m{place}")
    console.print()  # type: ignore[attr-defined]
    show_grid(grid, console)  # type: ignore[arg-type]


def _beside(value: float, limit: float | None) -> str:
    """A value and its limit to five digits, or to as many as it takes to tell them apart.

    Example
        >>> _beside(44.7, 45.0), _beside(44.9999987, 45.0), _beside(45.0, 45.0)
        ('44.7 (limit 45)', '44.999999 (limit 45)', '45 (limit 45)')
    """
    apart = (digits for digits in range(5, 18) if number(value, digits) != number(limit, digits))
    digits = next(apart, 5)
    return f"{number(value, digits)} (limit {number(limit, digits)})"
