"""`gearlink bench`: run time against error of the solver families."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from gearlink.cli.bench.families import FAMILIES, measured
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.files import require_folder
from gearlink.cli.options import Format, Options
from gearlink.cli.typer_options import offers, option, takes

NAMES = tuple(FAMILIES)


class BenchFormat(StrEnum):
    """How the tables are printed."""

    TABLE = "table"
    JSON = "json"
    MARKDOWN = "md"


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command("bench")(_bench)


@takes("quiet")
def _bench(
    options: Options,
    families: Annotated[
        list[str] | None, typer.Argument(metavar="FAMILY", help=", ".join(NAMES), autocompletion=offers("families"))
    ] = None,
    quick: Annotated[bool, typer.Option("--quick", help="fewer rounds, nothing above 1e5")] = False,
    out: Annotated[Path | None, option("out", help="write a picture of each family")] = None,
    format: Annotated[BenchFormat, option("format", help="how the tables are printed")] = BenchFormat.TABLE,
) -> None:
    """Measure time per result against error for each family of solvers and its textbook equivalents; needs mpmath.

    Example: gearlink bench involute dwell --quick
    """
    raise typer.Exit(run_bench(families or NAMES, format, quick=quick, out=out, quiet=options.quiet))


def run_bench(names: Sequence[str], form: BenchFormat, *, quick: bool, out: Path | None, quiet: bool) -> int:
    """Measure the families, print their tables, give the exit status."""
    from gearlink.cli.bench import page
    from gearlink.cli.bench.timing import BenchNeedsMpmath, machine, mpmath

    if wrong := [name for name in names if name not in NAMES]:
        message = f"no family {', '.join(wrong)}; the families are {', '.join(NAMES)}"
        from gearlink.cli.reading.diagnostics import Diagnostic
        from gearlink.cli.render.errors import show_errors

        shown = Options(format=Format.JSON if form is BenchFormat.JSON else Format.TABLE)
        show_errors([Diagnostic("GL115", message, file="<command line>", key=wrong[0])], shown)
        return ExitCode.WRONG_INPUT

    def say(text: str) -> None:
        if not quiet:
            print(text, file=sys.stderr)

    try:
        mpmath()
    except BenchNeedsMpmath as error:
        print(f"error: {error}", file=sys.stderr)
        return ExitCode.WRONG_INPUT
    if out is not None:
        require_folder(out)
    found = []
    for name in dict.fromkeys(names):
        say(f"measuring {name} ...")
        found.append(measured(name, quick))
    pictures = page.write_pictures(found, out, say) if out else {}
    if form is BenchFormat.JSON:
        print(page.as_json(found, machine()))
    elif form is BenchFormat.MARKDOWN:
        print(page.as_markdown(found, machine(), pictures), end="")
    else:
        print(page.as_text(found, machine()))
    return ExitCode.OK
