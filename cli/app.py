"""The command tree. Each command imports what it runs when it runs."""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Annotated, Any

import typer
import typer.main

from gearlink.cli.batch.options import Added, BatchFormat, BatchOptions, FailOn, Unchanged
from gearlink.cli.command_groups import OrderOfWork
from gearlink.cli.commands.gears import gears
from gearlink.cli.commands.laws import laws
from gearlink.cli.completing import better_scripts
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.options import COMMANDS, OF_REPORT, OPTIONS, Options
from gearlink.cli.quick import run_line
from gearlink.cli.typer_commands import COMMANDS as OTHERS
from gearlink.cli.typer_commands import ReportFormat, Show
from gearlink.cli.typer_options import Dask, Jobs, Spec, offers, option, share, takes
from gearlink.core.base.kinds import KINDS

_HELP = """Design calculator for the mechanisms of printing machines.

A design is a YAML file; `gearlink analyze FILE` gives its full analysis.

Exit status: 0 all checks pass, 1 a check fails, 2 the input is wrong or the
mechanism does not exist, 3 a fault of the program, 130 interrupted.
"""

app = typer.Typer(
    help=_HELP,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    name="gearlink",
    cls=OrderOfWork,
    context_settings={"help_option_names": ["--help", "-h"]},
)
synth = typer.Typer(help="Size a linkage for an output motion.", no_args_is_help=True, rich_markup_mode=None)
app.add_typer(synth, name="synth")


def _design_command(command: str, words: str) -> Callable[..., None]:
    """A Typer command that runs `command` on one design file."""

    @takes(*OPTIONS)
    def run(spec: Spec, options: Options) -> None:
        raise typer.Exit(run_line(command, spec, options))

    served = ", ".join(kind.name for kind in KINDS.values() if command in kind.commands)
    run.__doc__ = f"{words}\n\nFor: {served}.\n\nExample: gearlink {command} design.yaml --format json"
    return run


for _name, _words in COMMANDS.items():
    _group, _, _last = _name.rpartition(" ")
    (synth if _group else app).command(_last)(_design_command(_name, _words))


@app.command("report")
@takes(*OF_REPORT)
def _report(
    spec: Spec,
    options: Options,
    format: Annotated[
        ReportFormat, typer.Option("--format", "-f", help="file format of the report")
    ] = ReportFormat.HTML,
    against: Annotated[
        str, typer.Option(metavar="OLD", help="older file of the same kind: report what has changed")
    ] = "",
    show: Show = "",
) -> None:
    """Write a design as one self-contained HTML page: results, findings, animation, figures, tables, input.

    Example: gearlink report designs/ty460.yaml --against old.yaml --out reports
    """
    if format is ReportFormat.HTML and not against and not show:
        raise typer.Exit(run_line("report", spec, options))
    from gearlink.cli.commands.report import Asked, run_report

    raise typer.Exit(run_report(spec, options, Asked(format.value, against, show)))


@app.command("watch")
@takes("overrides", "strict", "quiet")
def _watch(
    spec: Annotated[str, typer.Argument(metavar="SPEC", help="design file")],
    options: Options,
    port: Annotated[int, typer.Option(min=0, max=65535, help="port of the page; 0: a free one")] = 0,
    show: Annotated[bool, typer.Option("--open", help="open the page in the browser")] = False,
) -> None:
    """Show the report of a design in the browser, live while the file is edited; Ctrl-C ends it.

    The page is served on the loopback address of this machine alone.

    Example: gearlink watch press.yaml --open
    """
    from gearlink.cli.commands.watch import run_watch

    raise typer.Exit(run_watch(spec, options, port=port, show=show))


@app.command("studio")
@takes("quiet")
def _studio(
    spec: Annotated[str, typer.Argument(metavar="SPEC", help="design file")],
    options: Options,
    port: Annotated[int, typer.Option(min=0, max=65535, help="port of the page; 0: a free one")] = 0,
    show: Annotated[bool, typer.Option("--open", help="open the page in the browser")] = False,
) -> None:
    """Change a design in the browser: every number on a slider, all results live; Ctrl-C ends it.

    The page is served on the loopback address of this machine alone; its button Save writes the file.

    Needs NiceGUI: pip install 'nicegui>=3.18'

    Example: gearlink studio press.yaml --open
    """
    from gearlink.cli.studio.command import run_studio

    raise typer.Exit(run_studio(spec, options, port=port, show=show))


@app.command("batch")
@takes(
    "plot", "plot_format", "dpi", "overrides", "strict", "color", "quiet", plot="with --out: draw each design as well"
)
def _batch(
    places: Annotated[list[str], typer.Argument(metavar="DIR", help="folders, design files or patterns")],
    options: Options,
    format: Annotated[BatchFormat, option("format", help="form of the summary")] = BatchFormat.TABLE,
    fail_on: Annotated[
        FailOn, typer.Option("--fail-on", help="lowest result that gives exit status 1")
    ] = FailOn.FAILURE,
    out: Annotated[Path | None, option("out", help="folder for reports and tables of each design")] = None,
    unchanged: Annotated[
        Unchanged, typer.Option("--unchanged", help="with --out: skip designs that passed and are unchanged since")
    ] = Unchanged.COMPUTE,
    shard: Annotated[str, typer.Option(metavar="I/N", help="run only the I-th of N shares of the files")] = "1/1",
    jobs: Jobs = 0,
    dask: Dask = "",
    added: Annotated[
        list[Added] | None, typer.Option("--with", help="run this as well on files with tolerances (repeatable)")
    ] = None,
) -> None:
    """Run every design file in folders; print one summary and give one exit status.

    Example: gearlink batch designs --format junit > results.xml
    """
    from gearlink.cli.batch.run import run_batch

    if options.plot and out is None:
        raise typer.BadParameter("--plot of a batch needs --out DIR", param_hint="--plot")
    if unchanged is Unchanged.SKIP and out is None:
        raise typer.BadParameter("--unchanged skip needs --out DIR, where the results are", param_hint="--unchanged")
    design = options._replace(strict=options.strict or fail_on is FailOn.WARNING)
    more = tuple(dict.fromkeys(one.value for one in added or ()))
    raise typer.Exit(run_batch(places, BatchOptions(design, format, out, unchanged, share(shard), jobs, dask, more)))


for _name, _command in {**OTHERS, "laws": laws, "gears": gears}.items():
    app.command(_name)(_command)


@app.command("help")
def _help(
    words: Annotated[
        list[str] | None, typer.Argument(metavar="COMMAND", help="command", autocompletion=offers("commands"))
    ] = None,
) -> None:
    """Show the help of a command, as COMMAND --help does.

    Example: gearlink help synth dwell
    """
    raise typer.Exit(invoke([*(words or ()), "--help"]))


for _each in (*app.registered_commands, *synth.registered_commands):  # whole in the list of commands, not cut short
    _each.short_help = (_each.callback.__doc__ or "").strip().partition("\n")[0] if _each.callback else None


@app.callback(invoke_without_command=True)
def _root(version: Annotated[bool, typer.Option("--version", "-V", help="show the version and exit")] = False) -> None:
    if version:
        from gearlink.core.version import VERSION

        typer.echo(f"gearlink {VERSION}")
        raise typer.Exit


@cache
def _tree() -> Callable[..., Any]:
    """The commands with their parameters, made once for all lines that a process runs."""
    better_scripts()
    return typer.main.get_command(app)


def invoke(arguments: list[str]) -> int:
    """Run the command line and give its exit status."""
    try:
        status = _tree()(args=arguments, standalone_mode=False)
    except typer.Exit as end:
        return int(end.exit_code)
    except typer.Abort:
        return ExitCode.INTERRUPTED
    except typer.TyperException as wrong:
        return _usage_error(wrong, arguments)
    return int(status or 0)


def _usage_error(wrong: typer.TyperException, arguments: list[str]) -> int:
    from gearlink.cli.usage_errors import complete

    complete(wrong, arguments, _tree())
    message = wrong.format_message().replace(" \n", "\n")
    if not _wants_json(arguments):
        if not message.startswith("Usage: "):  # else no arguments: the help of the command is the message
            wrong.message = wrong.message.replace("\n", "\n  help: ", 1)
        show = getattr(wrong, "show", None)  # errors of usage know the command's usage line
        if show is not None:
            show(file=sys.stderr)
        else:
            typer.echo(f"error: {wrong.format_message()}", err=True)
        return ExitCode.WRONG_INPUT
    from gearlink.cli.reading.diagnostics import Diagnostic
    from gearlink.cli.render.errors import errors_as_json

    print(errors_as_json([Diagnostic("GL115", message, file="<command line>", line=1, column=1, key="")]))
    return ExitCode.WRONG_INPUT


def _wants_json(arguments: list[str]) -> bool:
    following = dict(pairwise(arguments))
    return "--format=json" in arguments or "json" in (following.get("--format"), following.get("-f"))
