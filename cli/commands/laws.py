"""`gearlink laws`: constants and curves of the motion laws."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.options import Format, Options, PlotFormat

if TYPE_CHECKING:
    from gearlink.cli.reading.diagnostics import Diagnostic
    from gearlink.core.cams.laws import Law

_WHERE = "<--law>"


def laws(
    law: Annotated[list[str], typer.Option("--law", metavar="NAME", help="s, v, a, j of this law (repeatable)")] = [],  # noqa: B006 - Typer copies it
    samples: Annotated[int | None, typer.Option("--samples", min=1, max=10_000_000, help="steps of x, 100")] = None,
    format: Annotated[Format, typer.Option("--format", "-f", help="how results are printed")] = Format.TABLE,
    plot: Annotated[bool, typer.Option("--plot", help="write motion-laws.png")] = False,
    plot_format: Annotated[PlotFormat, typer.Option("--plot-format", help="kind of picture")] = PlotFormat.PNG,
    out: Annotated[Path, typer.Option("--out", metavar="DIR", help="folder for files that are written")] = Path(),
    no_color: Annotated[bool, typer.Option("--no-color", help="no colours, as with NO_COLOR=1")] = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="print no notes on standard error")] = False,
) -> None:
    """Constants Cv, Ca, Cj, Cm, kappa of every motion law; with --law, the course of one over x.

    NAME is written as in a design file: modified-sine, mcv-33, velocity-345, '{scca: [0.25, 0, 0.75, 0]}'.

    Example: gearlink laws --law modified-sine --law polynomial-345 --plot
    """
    options = Options(
        format=format, plot=plot, plot_format=plot_format, out=out, samples=samples, color=not no_color, quiet=quiet
    )
    raise typer.Exit(run_laws(law, options))


def run_laws(names: Sequence[str], options: Options) -> int:
    """Print the constants of all laws or the course of those named, and give the exit status."""
    from gearlink.cli.commands.design import plot as draw
    from gearlink.cli.commands.design import print_report, show_refusal
    from gearlink.cli.files import CannotWrite
    from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
    from gearlink.cli.render.errors import show_errors
    from gearlink.core.cams.law_tables import LawChoice, MotionLaws
    from gearlink.core.errors import NoSolution

    chosen: list[Law] = []
    wrong: list[Diagnostic] = []
    for name in names:
        try:
            chosen.append(_law(name))
        except NoSolution as error:
            wrong.append(Diagnostic("GL115", error.message, _WHERE, key="law", source=name))
        except DesignFileError as error:
            wrong += error.diagnostics
    if wrong:
        show_errors(wrong, options)
        return ExitCode.WRONG_INPUT
    design = MotionLaws(LawChoice(tuple(dict.fromkeys(chosen))), options.samples)
    try:
        if options.plot:
            draw("laws", design, options)
    except CannotWrite as error:
        return show_refusal(error, "<--out>", options)
    print_report(design.report("laws"), options)
    return ExitCode.OK


def _law(text: str) -> Law:
    """The law of a name, or of a mapping written as in a design file."""
    from gearlink.core.cams.laws import law

    definition: Any = text
    if text.lstrip().startswith("{"):
        from gearlink.cli.reading.yaml_reader import read

        definition = read(text.encode(), _WHERE).data
    return law(definition)
