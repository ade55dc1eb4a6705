"""`gearlink laws`: constants and curves of the motion laws."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.options import OPTIONS, STREAM, Options
from gearlink.cli.typer_options import offers, option, takes

if TYPE_CHECKING:
    from gearlink.cli.reading.diagnostics import Diagnostic
    from gearlink.core.parts.cams.laws import Law

_WHERE = "<--law>"


_OF_FILES = ("overrides", "quantities", "tables", "strict", "save", "force")


@takes(
    *("format", "all", "digits", "plot", "plot_format", "dpi", "out", "color", "quiet", *_OF_FILES),
    plot="write the figure motion-laws.png, of a design file NAME-laws.png",
)
def laws(
    options: Options,
    spec: Annotated[str, typer.Argument(metavar="SPEC", help="design file of kind motion-law; default: all laws")] = "",
    law: Annotated[
        list[str],
        typer.Option(
            "--law", metavar="NAME", help="print s, v, a, j of this law (repeatable)", autocompletion=offers("laws")
        ),
    ] = [],  # noqa: B006 - Typer copies it
    samples: Annotated[int | None, option("samples", help="number of steps of x; default: 100", least=1)] = None,
) -> None:
    """Constants Cv, Ca, Cj, Cm, kappa of every motion law; with --law, s, v, a, j of one law over x.

    NAME is written as in a design file: modified-sine, mcv-33, velocity-345, '{scca: [0.25, 0, 0.75, 0]}'.
    With SPEC, a law with its vibration, and where it is optimal the proof.

    Example: gearlink laws --law modified-sine --law polynomial-345 --plot
    """
    options = options._replace(samples=samples)
    if spec and spec != STREAM.name and not Path(spec).suffix and not Path(spec).exists():
        from gearlink.cli.usage_errors import of_law

        raise typer.BadParameter(f"no such file\n{of_law(spec)}", param_hint=spec)
    if spec and law:
        raise typer.BadParameter("a design file already defines its law\nomit --law, or the file", param_hint="--law")
    if not spec:
        for name in _OF_FILES:
            if getattr(options, name) != getattr(Options(), name):
                flag = OPTIONS[name].flags[0]
                raise typer.BadParameter("needs SPEC, a design file of kind motion-law", param_hint=flag)
        raise typer.Exit(run_laws(law, options))
    from gearlink.cli.commands.design import run_design

    raise typer.Exit(run_design("laws", spec, options))


def run_laws(names: Sequence[str], options: Options) -> int:
    """Print the constants of all laws or the course of those named, and give the exit status."""
    from gearlink.cli.commands.design import plotted, print_report
    from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
    from gearlink.cli.render.errors import show_errors
    from gearlink.core.base.errors import NoSolution
    from gearlink.core.parts.cams.law_tables import LawChoice, MotionLaws

    chosen: list[Law] = []
    wrong: list[Diagnostic] = []
    for name in names:
        try:
            chosen.append(_law(name))
        except NoSolution as error:
            wrong.append(Diagnostic("GL115", error.message, _WHERE, key="law", source=name, help=error.fix))
        except DesignFileError as error:
            wrong += error.diagnostics
    if wrong:
        show_errors(wrong, options)
        return ExitCode.WRONG_INPUT
    design = MotionLaws(LawChoice(tuple(dict.fromkeys(chosen))))
    report = design.report("laws", samples=options.samples)
    print_report(report, options)
    return plotted("laws", design, options, report, "<--out>")


def _law(text: str) -> Law:
    """The law of a name, or of a mapping written as in a design file."""
    from gearlink.core.parts.cams.laws import law

    definition: Any = text
    if text.lstrip().startswith("{"):
        from gearlink.cli.reading.yaml_reader import read

        definition = read(text.encode(), _WHERE).data
    return law(definition)
