"""`gearlink verify`: the program computes published cases where it is installed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.options import Format, Options
from gearlink.core.base.errors import named

if TYPE_CHECKING:
    from gearlink.cli.reading.diagnostics import Diagnostic

_FILE = "<command line>"


def run_verify(prefixes: Sequence[str], options: Options, *, everything: bool = False) -> int:
    """Compute the cases that begin with one of some prefixes, without a prefix all, and give the exit status.

    Parameters
        everything : bool - in the table form every number, as where prefixes are given
    """
    from gearlink.cli.patience import patience
    from gearlink.cli.render.errors import show_errors
    from gearlink.cli.verification.cases import sources
    from gearlink.cli.verification.computing import computed
    from gearlink.cli.verification.report import report_of

    cases = [case for source in sources(prefixes) for case in source.cases]
    if unknown := _unknown(prefixes, [case.id for case in cases]):
        show_errors(unknown, options)
        return ExitCode.WRONG_INPUT
    with patience(f"computing {len(cases)} published cases", quiet=options.quiet):
        outcomes = list(computed(cases))
    report = report_of(outcomes)
    if options.format is Format.TABLE:
        from gearlink.cli.verification.terminal import as_text

        print(as_text(outcomes, everything=everything or bool(prefixes)))
    else:
        from gearlink.cli.commands.design import print_report

        print_report(report, options)
    return ExitCode.OK if report.ok else ExitCode.FINDING


def _unknown(prefixes: Sequence[str], ids: Sequence[str]) -> list[Diagnostic]:
    from gearlink.cli.reading.diagnostics import Diagnostic
    from gearlink.cli.verification.cases import names

    return [
        Diagnostic(
            "GL115",
            f"no case begins with {named(prefix)}",
            _FILE,
            key=prefix,
            help=f"cases begin with: {', '.join(names())}",
        )
        for prefix in dict.fromkeys(prefixes)
        if not any(each.startswith(prefix.lower()) for each in ids)
    ]
