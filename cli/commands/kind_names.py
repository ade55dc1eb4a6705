"""A kind of design by name, or the nearest names on standard error."""

from __future__ import annotations

from gearlink.cli.options import Options
from gearlink.cli.reading.diagnostics import Diagnostic
from gearlink.cli.render.errors import show_errors
from gearlink.core.base.errors import named
from gearlink.core.base.kind import Kind
from gearlink.core.base.kinds import FILES


def kind_named(name: str) -> Kind | None:
    """The kind, or None after the error has been shown."""
    if name in FILES:
        return FILES[name]
    from difflib import get_close_matches

    near = get_close_matches(name.lower().replace("_", "-"), FILES, n=3, cutoff=0.4)
    known = f"the kinds are {', '.join(FILES)}"
    remedy = f"nearest: {', '.join(near)}; {known}" if near else known
    show_errors([Diagnostic("GL109", f"no kind {named(name)}", "<command line>", key=name, help=remedy)], Options())
    return None
