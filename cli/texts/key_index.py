"""Every key of every kind of file in one list, kept in a file: reading all schemas takes a second.

`make docs` writes it; a test compares it with the schemas.
"""

from __future__ import annotations

import json
from dataclasses import astuple
from functools import cache
from pathlib import Path

from gearlink.cli.texts.spec_keys import SpecKey, spec_keys

FILE = Path(__file__).parent / "keys.json"


@cache
def known_keys() -> list[tuple[SpecKey, list[str]]]:
    """Each key with the kinds that have it in the same words, as the file has them."""
    return [(SpecKey(*row), kinds) for *row, kinds in json.loads(FILE.read_text(encoding="utf-8"))]


def text() -> str:
    """What belongs into the file: a line for each key, in the order of the kinds."""
    rows = [json.dumps([*astuple(key), kinds], ensure_ascii=False) for key, kinds in _collected()]
    return "[\n" + ",\n".join(rows) + "\n]\n"


def _collected() -> list[tuple[SpecKey, list[str]]]:
    from gearlink.core.kinds import FILES

    found: dict[tuple[str, str], tuple[SpecKey, list[str]]] = {}
    for kind in FILES.values():
        for key in spec_keys(kind):
            if key.path != "kind":
                found.setdefault((key.path, key.words), (key, []))[1].append(kind.name)
    return list(found.values())
