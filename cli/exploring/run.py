"""`gearlink explore` from the study file to the page."""

from __future__ import annotations

from gearlink.cli.commands.design import print_report
from gearlink.cli.evaluate import build, exit_status, open_design, read_spec, require_command
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.options import Options
from gearlink.cli.reading.diagnostics import DesignFileError
from gearlink.cli.render.errors import show_errors


def run_explore(source: str, options: Options) -> int:
    """Compute a study, print it, and give the exit status."""
    try:
        loaded, kind = open_design(source, options)
        require_command(loaded, kind, "explore")
        _, report = build(loaded, kind, "explore", read_spec(loaded, kind, source), options)
    except DesignFileError as error:
        show_errors(error.diagnostics, options)
        return ExitCode.WRONG_INPUT
    print_report(report, options)
    return exit_status(report, strict=options.strict)
