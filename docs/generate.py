"""Writes docs/nomenclature.md, docs/validation.md and what `explain`, `schema` and `new` read.

Run by `make docs`, checked by the tests.
"""

from __future__ import annotations

from pathlib import Path

from gearlink.cli.texts import indexing, known
from gearlink.cli.verification import page
from gearlink.core.base.kinds import FILES
from gearlink.core.base.nomenclature import TERMS

TARGET = Path(__file__).parent / "nomenclature.md"
VALIDATION = Path(__file__).parent / "validation.md"
_HEAD = """# Nomenclature

A quantity has one name, the same in design files, results, code and messages. Gears follow ISO 21771,
laws of motion and cams VDI 2142 and VDI 2143. Units are those of design files and results; inside the engine an
angle is in radians. This page is written by `make docs` from `core/base/nomenclature.py`.

| name | symbol | unit | meaning | source | kinds |
| --- | --- | --- | --- | --- | --- |
"""


def text() -> str:
    """The page."""
    kinds = _kinds_by_quantity()
    rows = [
        f"| `{name}` | {term.symbol} | {term.unit} | {term.words} | {term.source} | {', '.join(kinds.get(name, []))} |"
        for name, term in sorted(TERMS.items())
    ]
    return _HEAD + "\n".join(row.replace("|max", "\\|max") for row in rows) + "\n"


def _kinds_by_quantity() -> dict[str, list[str]]:
    """For each quantity, the kinds that give it."""
    found: dict[str, list[str]] = {}
    for kind in FILES.values():
        names: dict[str, None] = {}
        for command in kind.commands:
            names.update(dict.fromkeys(kind.design_class(command).quantity_names()))
        for name in dict.fromkeys(name.rpartition(".")[2] for name in names):
            found.setdefault(name, []).append(kind.name)
    return found


if __name__ == "__main__":
    TARGET.write_text(text())
    VALIDATION.write_text(page.text(), encoding="utf-8")
    known.SCHEMAS.write_text(indexing.schemas_text(), encoding="utf-8")
    known.INDEX.write_text(indexing.index_text(), encoding="utf-8")
