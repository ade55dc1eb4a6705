"""What is known of every kind of file, kept in two files: reading all models and design classes takes a second.

`make docs` writes them; a test compares them with models and classes.
"""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gearlink import designs

if TYPE_CHECKING:
    from gearlink.core.base.kind import Kind


_KIND = re.compile(r"^kind:\s*([\w-]+)", re.MULTILINE)


def worked_design(kind: Kind) -> str:
    """The text of the kind's example: the file that bears its name, else the first by name."""
    folder = Path(str(designs.__file__)).parent
    files = [(file.stem, file.read_text(encoding="utf-8")) for file in folder.rglob("*.yaml")]
    own = {stem: text for stem, text in files if (found := _KIND.search(text)) and found[1] == kind.name}
    if not own:
        raise LookupError(f"no example of kind {kind.name} in gearlink.designs")
    return own.get(kind.worked or kind.name.replace("-", "_"), own[min(own)])


Node = dict[str, Any]
SCHEMAS = Path(__file__).parent / "schemas.json"
INDEX = Path(__file__).parent / "index.json"


@dataclass(frozen=True, slots=True)
class Index:
    """Who gives what.

    Fields
        checks : check -> kinds that make it
        quantities : quantity -> kinds with the commands that show it
        laws : names of motion laws
        first_commands : kind -> the first command that its example asks for
    """

    checks: dict[str, list[str]]
    quantities: dict[str, list[str]]
    laws: list[str]
    first_commands: dict[str, str]


@cache
def index() -> Index:
    """The index, as the file has it."""
    return Index(**json.loads(INDEX.read_text(encoding="utf-8")))


def schema_parts(kind: Kind, prefix: str) -> tuple[Node, Node]:
    """The schema of a kind and its definitions, whose names get a prefix."""
    stored = _schemas()
    body, names = stored["kinds"][kind.name]
    found = {name.partition("#")[0]: stored["definitions"][name] for name in names}
    if prefix:
        text = json.dumps([body, found]).replace('"#/definitions/', f'"#/definitions/{prefix}')
        body, found = json.loads(text)
    return body, {prefix + name: node for name, node in found.items()}


@cache
def _schemas() -> Node:
    found: Node = json.loads(SCHEMAS.read_text(encoding="utf-8"))
    return found
