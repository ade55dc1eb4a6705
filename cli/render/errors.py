"""Errors of the input: as text on standard error, or as JSON on standard output."""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence

from gearlink.cli.options import Format, Options
from gearlink.cli.reading.diagnostics import Diagnostic
from gearlink.cli.render.json_report import FORMAT


def errors_as_json(diagnostics: Sequence[Diagnostic]) -> str:
    """The errors in the JSON form of the results."""
    return json.dumps({"gearlink": FORMAT, "errors": [d.as_json() for d in diagnostics]}, ensure_ascii=False)


def show_errors(diagnostics: Sequence[Diagnostic], options: Options) -> None:
    """Print the errors where the chosen format wants them."""
    if options.format is Format.JSON:
        print(errors_as_json(diagnostics))
        return
    for diagnostic in diagnostics:
        print(diagnostic.as_text(sys.stderr.encoding or "utf-8"), file=sys.stderr)
