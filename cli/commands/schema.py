"""`gearlink schema`: the JSON Schema of one kind of design file, or of all, and names near an unknown one."""

from __future__ import annotations

import json
import sys
from pathlib import Path

from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.files import CannotWrite, write_atomically
from gearlink.cli.options import Options
from gearlink.cli.printable import visible
from gearlink.cli.texts.schema import all_kinds_schema, for_editors, kind_schema
from gearlink.core.base.errors import named
from gearlink.core.base.kind import Kind
from gearlink.core.base.kinds import FILES


def kind_named(name: str) -> Kind | None:
    """The kind, or None after the error has been shown."""
    if name in FILES:
        return FILES[name]
    from difflib import get_close_matches

    from gearlink.cli.glossary import kinds_named
    from gearlink.cli.reading.diagnostics import Diagnostic
    from gearlink.cli.render.errors import show_errors

    spelled = name.lower().replace("_", "-").replace(" ", "-")
    near = [] if get_close_matches(spelled, FILES, n=1, cutoff=0.8) else kinds_named(name, FILES)
    near = near or get_close_matches(spelled, FILES, n=3, cutoff=0.4)
    known = f"the kinds are {', '.join(FILES)}"
    remedy = f"nearest: {', '.join(near)}; {known}" if near else known
    show_errors([Diagnostic("GL109", f"no kind {named(name)}", "<command line>", key=name, help=remedy)], Options())
    return None


PATTERNS = ("designs/**/*.yaml", "*.gearlink.yaml")
"""Names of files that an editor takes for design files."""


def run_schema(kind_name: str | None) -> int:
    """Print the schema of a kind, or the one of all kinds; give the exit status."""
    text = _text(kind_name)
    if text is None:
        return ExitCode.WRONG_INPUT
    print(text)
    return ExitCode.OK


def write_schema(kind_name: str | None, folder: Path) -> int:
    """Write the schema into a folder, and there the settings by which an editor knows design files by their name."""
    text = _text(kind_name)
    if text is None:
        return ExitCode.WRONG_INPUT
    schema, settings = folder / "gearlink.schema.json", folder / ".vscode" / "settings.json"
    try:
        write_atomically(schema, lambda stream: stream.write(f"{text}\n".encode()))
        print(f"wrote {visible(str(schema))}", file=sys.stderr)
        line = json.dumps({"yaml.schemas": {f"./{schema.name}": list(PATTERNS)}}, indent=2)
        if settings.exists():
            print(f"{visible(str(settings))} is left as it is; it needs\n{line}", file=sys.stderr)
        else:
            write_atomically(settings, lambda stream: stream.write(f"{line}\n".encode()))
            print(f"wrote {visible(str(settings))}", file=sys.stderr)
    except CannotWrite as error:
        from gearlink.cli.render.errors import show_refusal

        return show_refusal(error, "<--write>", Options())
    return ExitCode.OK


def _text(kind_name: str | None) -> str | None:
    """The schema of a kind or of all; None where no kind is called so, which has been said."""
    if kind_name is None:
        whole = all_kinds_schema(list(FILES.values()))
    elif (kind := kind_named(kind_name)) is not None:
        whole = kind_schema(kind)
    else:
        return None
    return json.dumps(for_editors(whole), indent=2, ensure_ascii=False, allow_nan=False)
