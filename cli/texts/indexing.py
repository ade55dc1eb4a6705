"""Makes what `known` keeps: the index from the design classes of every kind, the schemas from the models."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from dataclasses import asdict
from typing import Any

from gearlink.cli.texts.known import Index
from gearlink.cli.texts.model_schema import made_parts
from gearlink.cli.texts.worked_designs import worked_design
from gearlink.core.kind import Kind
from gearlink.core.kinds import FILES


def index_text() -> str:
    """What belongs in its file."""
    parts = [f'"{name}": {_in_lines(value)}' for name, value in asdict(made()).items()]
    return "{" + ",\n".join(parts) + "}\n"


def _in_lines(value: dict[str, Any] | list[str]) -> str:
    if isinstance(value, list):
        return json.dumps(value)
    lines = [f"{json.dumps(key)}: {json.dumps(each, ensure_ascii=False)}" for key, each in value.items()]
    return "{\n" + ",\n".join(lines) + "\n}"


def schemas_text() -> str:
    """What belongs in the file of the schemas: each definition once, whatever kinds have it."""
    definitions: dict[str, str] = {}
    kinds = {}
    for kind in FILES.values():
        body, own = made_parts(kind)
        kinds[kind.name] = [body, [_kept(definitions, name, json.dumps(node)) for name, node in own.items()]]
    rows = ",\n".join(f"{json.dumps(name)}: {text}" for name, text in definitions.items())
    return f'{{"definitions": {{\n{rows}\n}},\n"kinds": {_in_lines(kinds)}}}\n'


def _kept(definitions: dict[str, str], name: str, text: str) -> str:
    """The name under which a definition is kept: NAME#2 where another kind's of the same name differs."""
    number, key = 1, name
    while definitions.setdefault(key, text) != text:
        number += 1
        key = f"{name}#{number}"
    return key


def made() -> Index:
    """The index of all kinds."""
    from gearlink.cli.texts.codes import explanations
    from gearlink.core.cams.laws import REST_TO_REST, REST_TO_SPEED
    from gearlink.core.nomenclature import TERMS

    shown = _shown()
    checks = dict.fromkeys(check for text in explanations().values() for check in text.checks)
    return Index(
        {check: [kind.name for kind in FILES.values() if _makes(kind, check)] for check in checks},
        {name: list(_givers(name, shown)) for name in TERMS},
        [*REST_TO_REST, *REST_TO_SPEED, "half-345", "half-4567", "velocity-345", "velocity-4567"],
        {kind.name: _first_command(kind, worked_design(kind)) for kind in FILES.values()},
    )


def _makes(kind: Kind, check: str) -> bool:
    """Whether a class of the kind makes a check: a command always shows it, or a section calls for it."""
    classes = {kind.design_class(command) for command in kind.commands}
    shown = {name for cls in classes for outline in cls.outlines.values() for name in outline.checks}
    return check in shown or any(hasattr(cls, "check_" + check.replace("-", "_")) for cls in classes)


def _shown() -> dict[str, tuple[dict[str, set[str]], set[str]]]:
    """Of each kind the quantities that each command always shows, and all that it has."""
    found = {}
    for kind in FILES.values():
        classes = {command: kind.design_class(command) for command in kind.commands}
        always = {command: _ends(cls.outlines[command].quantities) for command, cls in classes.items()}
        known = {name for cls in set(classes.values()) for name in _ends(cls.quantity_names())}
        found[kind.name] = always, known
    return found


def _ends(paths: Iterable[str]) -> set[str]:
    return {path.rpartition(".")[2] for path in paths}


def _givers(name: str, shown: dict[str, tuple[dict[str, set[str]], set[str]]]) -> Iterator[str]:
    """Kinds that have the quantity and the commands that show it."""
    for kind, (by_command, known) in shown.items():
        always = [command for command, names in by_command.items() if name in names]
        if always:
            yield f"{kind} ({', '.join(always)})"
        elif name in known:
            yield f"{kind} (where the file has the sections for it)"


def _first_command(kind: Kind, text: str) -> str:
    from gearlink.cli.reading.design_file import parse, validate

    return str(validate(parse(text.encode(), "template"), kind.spec_model()).commands()[0])
