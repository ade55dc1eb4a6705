"""The command tree. Each command imports what it runs when it runs."""

from __future__ import annotations

import sys
from collections.abc import Callable
from inspect import signature
from itertools import pairwise
from pathlib import Path
from typing import Annotated

import typer

from gearlink.cli.batch.options import BatchFormat, BatchOptions, FailOn
from gearlink.cli.bench.command import register as register_bench
from gearlink.cli.commands.laws import laws
from gearlink.cli.commands.picture_options import register as register_pictures
from gearlink.cli.commands.reference_options import register
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.export.register import register as register_export
from gearlink.cli.options import Format, Options, PlotFormat

_HELP = """Design calculator for the mechanisms of printing machines.

A design is a YAML file; `gearlink analyze FILE` gives its full analysis.

Exit status: 0 all checks pass, 1 a check fails, 2 the input is wrong or no such mechanism exists, 3 a fault.
"""

app = typer.Typer(
    help=_HELP, no_args_is_help=True, pretty_exceptions_enable=False, rich_markup_mode=None, name="gearlink"
)
synth = typer.Typer(
    help="Size a three-gear four-bar for an output motion.", no_args_is_help=True, rich_markup_mode=None
)
app.add_typer(synth, name="synth")

Spec = Annotated[str, typer.Argument(metavar="SPEC", help="design file, or - for standard input")]
FormatOption = Annotated[Format, typer.Option("--format", "-f", help="how results are printed")]
PlotOption = Annotated[bool, typer.Option("--plot", help="write NAME-COMMAND.png")]
PlotFormatOption = Annotated[PlotFormat, typer.Option("--plot-format", help="kind of picture")]
OutOption = Annotated[Path, typer.Option("--out", metavar="DIR", help="folder for files that are written")]
SetOption = Annotated[list[str], typer.Option("--set", metavar="PATH=VALUE", help="override a key (repeatable)")]
QuantityOption = Annotated[list[str], typer.Option("--quantity", metavar="NAME", help="print this alone (repeatable)")]
TableOption = Annotated[list[str], typer.Option("--table", metavar="NAME", help="add a table (repeatable)")]
SamplesOption = Annotated[int | None, typer.Option("--samples", min=2, max=10_000_000, help="rows per turn or stroke")]
StrictOption = Annotated[bool, typer.Option("--strict", help="a warning counts as a failure")]
NoColorOption = Annotated[bool, typer.Option("--no-color", help="no colours, as with NO_COLOR=1")]
SuggestOption = Annotated[bool, typer.Option("--suggest", help="try the recommended changes, show the repaired design")]
ProfileOption = Annotated[bool, typer.Option("--profile", help="report what was computed and how long each took")]
QuietOption = Annotated[bool, typer.Option("--quiet", "-q", help="print no notes on standard error")]


_WITH_SUGGESTIONS = {"swing"}


def _design_command(command: str, words: str) -> Callable[..., None]:
    """A Typer command that runs `command` on one design file."""

    def run(
        spec: Spec,
        format: FormatOption = Format.TABLE,
        plot: PlotOption = False,
        plot_format: PlotFormatOption = PlotFormat.PNG,
        out: OutOption = Path(),
        set_: SetOption = [],  # noqa: B006 - Typer copies it
        quantity: QuantityOption = [],  # noqa: B006
        table: TableOption = [],  # noqa: B006
        samples: SamplesOption = None,
        strict: StrictOption = False,
        no_color: NoColorOption = False,
        quiet: QuietOption = False,
        profile: ProfileOption = False,
        suggest: SuggestOption = False,
    ) -> None:
        options = Options(
            format=format,
            plot=plot,
            plot_format=plot_format,
            out=out,
            overrides=tuple(set_),
            quantities=tuple(quantity),
            tables=tuple(table),
            samples=samples,
            strict=strict,
            color=not no_color,
            quiet=quiet,
            profile=profile,
        )
        if suggest:
            from gearlink.cli.commands.suggest import run_suggested

            raise typer.Exit(run_suggested(command, spec, options))
        from gearlink.cli.commands.design import run_design

        raise typer.Exit(run_design(command, spec, options))

    if command not in _WITH_SUGGESTIONS:
        given = signature(run, eval_str=True)
        shown = [each for name, each in given.parameters.items() if name != "suggest"]
        run.__signature__ = given.replace(parameters=shown)  # type: ignore[attr-defined]
    run.__doc__ = f"{words}\n\nExample: gearlink {command} design.yaml --format json"
    return run


_DESIGN_COMMANDS = {
    "analyze": "Full analysis of a design: kinematics over a turn, dwells, all checks.",
    "gear": "Gear pairs: a gear-pair design, or the pairs inside a press or a gear-linkage.",
    "crank": "Crank length from the stroke of a slider-crank.",
    "press": "Flatbed press: both chains, 12 positions, velocities, synchronous zone.",
    "gripper": "Swing gripper: six-phase law, vector loop, handover, cams, force closure.",
    "swing": "Wide-swing cam mechanism with unloading device: law, sizing, profile, balancing.",
    "cam": "The cams of a design: follower motion, profiles, pressure angle, curvature.",
}
_SYNTH_COMMANDS = {
    "dwell": "Size the linkage for a dwell over a given crank angle.",
    "back-step": "Size the linkage for a back-step.",
    "variable-speed": "Size the linkage for an output speed that swings between two values.",
    "momentary-dwell": "Size the frame for one momentary standstill per turn.",
}
for _name, _words in _DESIGN_COMMANDS.items():
    app.command(_name)(_design_command(_name, _words))
for _name, _words in _SYNTH_COMMANDS.items():
    synth.command(_name)(_design_command(f"synth {_name}", _words))


@app.command("report")
def _report(
    spec: Spec,
    out: OutOption = Path(),
    set_: SetOption = [],  # noqa: B006 - Typer copies it
    strict: StrictOption = False,
    quiet: QuietOption = False,
) -> None:
    """All of a design on one self-contained HTML page: input, results, findings, tables, pictures.

    Example: gearlink report designs/ty460.yaml --out reports
    """
    from gearlink.cli.commands.report import run_report

    raise typer.Exit(run_report(spec, Options(out=out, overrides=tuple(set_), strict=strict, quiet=quiet)))


@app.command("batch")
def _batch(
    places: Annotated[list[str], typer.Argument(metavar="DIR", help="folders, design files or patterns")],
    format: Annotated[BatchFormat, typer.Option("--format", "-f", help="form of the summary")] = BatchFormat.TABLE,
    fail_on: Annotated[FailOn, typer.Option("--fail-on", help="what ends with status 1")] = FailOn.FAILURE,
    out: Annotated[Path | None, typer.Option(metavar="DIR", help="write reports and tables of each design")] = None,
    plot: Annotated[bool, typer.Option("--plot", help="with --out: draw each design as well")] = False,
    plot_format: PlotFormatOption = PlotFormat.PNG,
    cache: Annotated[Path | None, typer.Option(metavar="DIR", help="keep results; skip unchanged designs")] = None,
    shard: Annotated[str, typer.Option(metavar="I/N", help="the I-th of N shares of the files")] = "1/1",
    jobs: Annotated[
        int, typer.Option("--jobs", "-j", min=0, help="number of processes; 0: chosen by the work at hand")
    ] = 0,
    set_: SetOption = [],  # noqa: B006 - Typer copies it
    strict: StrictOption = False,
    no_color: NoColorOption = False,
    quiet: QuietOption = False,
) -> None:
    """Every design file below the folders: each does what it asks for; one summary, one exit status.

    Example: gearlink batch designs --format junit > results.xml
    """
    from gearlink.cli.batch.run import run_batch

    design = Options(
        plot=plot,
        plot_format=plot_format,
        overrides=tuple(set_),
        strict=strict or fail_on is FailOn.WARNING,
        color=not no_color,
        quiet=quiet,
    )
    if plot and out is None:
        raise typer.BadParameter("--plot of a batch needs --out DIR", param_hint="--plot")
    raise typer.Exit(run_batch(places, BatchOptions(design, format, out, cache, _share(shard), jobs)))


def _share(text: str) -> tuple[int, int]:
    index, _, count = text.partition("/")
    if index.isdecimal() and count.isdecimal() and 1 <= int(index) <= int(count):
        return int(index), int(count)
    raise typer.BadParameter(f"{text!r} is not I/N with 1 <= I <= N", param_hint="--shard")


register(app)
register_export(app)
register_bench(app)
register_pictures(app)
app.command("laws")(laws)
for _command in (*app.registered_commands, *synth.registered_commands):  # whole in the list of commands, not cut short
    _command.short_help = (_command.callback.__doc__ or "").strip().partition("\n")[0] if _command.callback else None


@app.callback(invoke_without_command=True)
def _root(
    version: Annotated[bool, typer.Option("--version", "-V", help="show the version and leave")] = False,
) -> None:
    if version:
        from gearlink.core.version import VERSION

        typer.echo(f"gearlink {VERSION}")
        raise typer.Exit


def invoke(arguments: list[str]) -> int:
    """Run the command line and give its exit status."""
    try:
        status = app(args=arguments, standalone_mode=False)
    except typer.Exit as end:
        return int(end.exit_code)
    except typer.Abort:
        return ExitCode.INTERRUPTED
    except typer.TyperException as wrong:
        return _usage_error(wrong, arguments)
    return int(status or 0)


def _usage_error(wrong: typer.TyperException, arguments: list[str]) -> int:
    message = wrong.format_message()
    if not _wants_json(arguments):
        show = getattr(wrong, "show", None)  # errors of usage know the command's usage line
        if show is not None:
            show(file=sys.stderr)
        else:
            typer.echo(f"error: {message}", err=True)
        return ExitCode.WRONG_INPUT
    from gearlink.cli.reading.diagnostics import Diagnostic
    from gearlink.cli.render.errors import errors_as_json

    print(errors_as_json([Diagnostic("GL115", message, file="<command line>", line=1, column=1, key="")]))
    return ExitCode.WRONG_INPUT


def _wants_json(arguments: list[str]) -> bool:
    following = dict(pairwise(arguments))
    return "--format=json" in arguments or "json" in (following.get("--format"), following.get("-f"))
