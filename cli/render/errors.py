"""Errors of the input: as text on standard error, or as JSON on standard output."""

from __future__ import annotations

import re
import sys
from collections.abc import Sequence
from typing import TextIO

from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.files import CannotWrite
from gearlink.cli.options import Format, Options
from gearlink.cli.printable import json_text
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.render.json_report import FORMAT
from gearlink.core.base.errors import NoSolution

_NARROWEST = 40
_MESSAGE = r"\S.*: (error|fail|warn|pass|fault) GL\d|  (help|fix|note): "  # the source line and its caret stay


def errors_as_json(diagnostics: Sequence[Diagnostic]) -> str:
    """The errors in the JSON form of the results."""
    return json_text({"gearlink": FORMAT, "errors": [d.as_json() for d in diagnostics]})


def show_errors(diagnostics: Sequence[Diagnostic], options: Options) -> None:
    """Print the errors where the chosen format wants them."""
    if options.format is Format.JSON:
        print(errors_as_json(diagnostics))
        return
    for diagnostic in diagnostics:
        print(fitted(diagnostic.as_text(sys.stderr.encoding or "utf-8"), sys.stderr), file=sys.stderr)


def show_refusal(error: DesignFileError | CannotWrite | NoSolution, source: str, options: Options) -> int:
    """Print why there is no result, and give the exit status.

    A NoSolution that comes here is the plot's: it may show what the report did not ask for.
    """
    if isinstance(error, DesignFileError):
        show_errors(error.diagnostics, options)
    elif isinstance(error, NoSolution):
        show_errors([Diagnostic(error.code, error.message, file=source, key=error.key, help=error.fix)], options)
    else:
        show_errors([Diagnostic("GL116", str(error), file=source)], options)
    return ExitCode.WRONG_INPUT


def fitted(text: str, stream: TextIO) -> str:
    """The lines of a message, folded where a terminal shows them; programs that read a stream get them whole.

    Example
        >>> import io
        >>> fitted("a.yaml:1:1: error GL112: too long", io.StringIO())
        'a.yaml:1:1: error GL112: too long'
    """
    if not stream.isatty():
        return text
    from shutil import get_terminal_size

    width = max(_NARROWEST, get_terminal_size().columns)
    lines = text.split("\n")
    folded = [_folded(line, width) if re.match(_MESSAGE, line) else line for line in lines]
    return "\n".join(folded)


def _folded(line: str, width: int) -> str:
    import textwrap

    return "\n".join(
        textwrap.wrap(line, width, subsequent_indent="    ", break_long_words=False, break_on_hyphens=False)
    )
