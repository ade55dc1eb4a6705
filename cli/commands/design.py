"""One command on one design file: read, build the design, report, render, plot."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from difflib import get_close_matches
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.files import CannotWrite
from gearlink.cli.options import Format, Options
from gearlink.cli.reading.design_file import (
    DesignFileError,
    LoadedFile,
    diagnose_no_solution,
    load,
    read_kind,
    validate,
)
from gearlink.cli.reading.diagnostics import Diagnostic
from gearlink.cli.render.errors import show_errors
from gearlink.core.design import UnknownName
from gearlink.core.errors import NoSolution
from gearlink.core.kinds import KINDS, Kind

if TYPE_CHECKING:
    from gearlink.core.design import Design
    from gearlink.core.report import Report


def run_design(command: str, source: str, options: Options) -> int:
    """Run `command` on the design file `source`, print the result, and give the exit status."""
    if options.profile:
        from gearlink.cli.commands.profile import run_profiled

        return run_profiled(command, source, options)
    try:
        design, report = evaluate(command, source, options)
        if options.plot:
            plot(command, design, options)
    except (DesignFileError, CannotWrite, NoSolution) as error:
        return show_refusal(error, source, options)
    print_report(report, options)
    return exit_status(report, strict=options.strict)


def show_refusal(error: DesignFileError | CannotWrite | NoSolution, source: str, options: Options) -> int:
    """Print why there is no result, and give the exit status.

    A NoSolution that comes here is the plot's: it may show what the report did not ask for.
    """
    if isinstance(error, DesignFileError):
        show_errors(error.diagnostics, options)
    elif isinstance(error, NoSolution):
        show_errors([Diagnostic(error.code, error.message, file=source, key=error.key)], options)
    else:
        show_errors([Diagnostic("GL116", str(error), file=source, line=1, column=1, key="")], options)
    return ExitCode.WRONG_INPUT


def evaluate(command: str, source: str, options: Options) -> tuple[Design, Report]:
    """The design of a file and the report of a command on it.

    Raises
        DesignFileError - for everything that is wrong with the file, the command for it, or the mechanism
    """
    loaded, kind = open_design(source, options)
    require_command(loaded, kind, command)
    return build(loaded, kind, command, read_spec(loaded, kind, source), options)


def open_design(source: str, options: Options) -> tuple[LoadedFile, Kind]:
    """The text of a design file as located data, and its kind."""
    loaded = load(source, overrides=options.overrides)
    return loaded, KINDS[read_kind(loaded, tuple(KINDS))]


def read_spec(loaded: LoadedFile, kind: Kind, source: str) -> Any:
    """The validated spec, named after the file where it names no design."""
    return named(validate(loaded, kind.spec_model()), source)


def build(
    loaded: LoadedFile, kind: Kind, command: str, spec: Any, options: Options, *, findings_only: bool = False
) -> tuple[Design, Report]:
    """The design of a validated spec and its report; what the mechanism refuses becomes a located error."""
    only = bool(options.tables) and options.format is Format.CSV
    wanted = {"quantities": options.quantities, "tables": options.tables, "only": only, "findings_only": findings_only}
    try:
        design = kind.design(command, spec, options.samples)
        report = design.report(command, **wanted)  # type: ignore[arg-type]
    except NoSolution as error:
        raise DesignFileError([diagnose_no_solution(loaded, error)]) from error
    except UnknownName as error:
        raise DesignFileError([_unknown_name(error)]) from error
    return design, report


def named(spec: Any, source: str) -> Any:
    """The spec with the file's stem for a name where the file gives none."""
    if "name" in spec.model_fields_set or source == "-":
        return spec
    return spec.model_copy(update={"name": Path(source).stem})


def require_command(loaded: LoadedFile, kind: Kind, command: str) -> None:
    """Refuse a command that this kind of design does not understand.

    Raises
        DesignFileError - naming the commands that it does understand
    """
    if command in kind.commands:
        return
    message = f"`{command}` does not apply to a {kind.name}; this kind understands: {', '.join(kind.commands)}"
    raise DesignFileError([loaded.report("GL113", message, ("kind",))])


def exit_status(report: Report, *, strict: bool = False) -> int:
    """0 where all checks pass, 1 where one fails (with `strict`, also where one warns)."""
    bad = {"fail", "warn"} if strict else {"fail"}
    return ExitCode.FINDING if any(check.status in bad for check in report.checks) else ExitCode.OK


def _unknown_name(error: UnknownName) -> Diagnostic:
    near: Sequence[str] = get_close_matches(error.name, error.known, n=3, cutoff=0.5)
    remedy = f"nearest: {', '.join(near)}" if near else f"known: {', '.join(error.known)}"
    return Diagnostic("GL115", str(error), file=f"<--{error.what}>", line=1, column=1, key=error.name, help=remedy)


def plot(command: str, design: Design, options: Options) -> None:
    """Write the design's figure and say where."""
    from gearlink.cli.figures.write import write_plot

    path = write_plot(command, design, options)
    if not options.quiet:
        print(f"wrote {path}", file=sys.stderr)


def print_report(report: Report, options: Options) -> None:
    """Print a report in the format of the options."""
    if options.format is Format.JSON:
        from gearlink.cli.render.json_report import as_json

        print(as_json(report))
    elif options.format is Format.CSV:
        from gearlink.cli.render.csv_report import write_csv

        write_csv(report, sys.stdout)
    elif options.format is Format.MARKDOWN:
        from gearlink.cli.render.markdown_report import as_markdown

        print(as_markdown(report))
    elif options.quantities:
        from gearlink.cli.render.plain import as_lines

        print(as_lines(report))
    else:
        from gearlink.cli.render.terminal import show

        show(report, options)
