"""`gearlink schema`: the JSON Schema of one kind of design file, or of all."""

from __future__ import annotations

import json

from gearlink.cli.commands.kind_names import kind_named
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.texts.schema import all_kinds_schema, kind_schema
from gearlink.core.kinds import FILES


def run_schema(kind_name: str | None) -> int:
    """Print the schema of a kind, or the one of all kinds; give the exit status."""

    if kind_name is None:
        whole = all_kinds_schema(list(FILES.values()))
    elif (kind := kind_named(kind_name)) is not None:
        whole = kind_schema(kind)
    else:
        return ExitCode.WRONG_INPUT
    print(json.dumps(whole, indent=2, ensure_ascii=False, allow_nan=False))
    return ExitCode.OK
