"""Tables of the manual that the program gives: keys, checks, quantities."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import cache

from gearlink.cli.texts import schema
from gearlink.cli.texts.codes import explanations
from gearlink.cli.texts.schema import SpecKey, spec_keys
from gearlink.core.base.codes import rules
from gearlink.core.base.kinds import FILES
from gearlink.core.base.nomenclature import TERMS

SHARED = {
    "loads": "loads.md",
    "tolerance": "tolerance.md",
    "register": "tolerance.md",
    "rating": "rating.md",
}
"""Sections that many kinds have, each with the page that describes it."""


@cache
def keys_of(kind: str) -> list[SpecKey]:
    """The keys of a kind."""
    return [key for key in spec_keys(FILES[kind]) if key.path != "kind"]


def keys(kind: str, sections: list[str]) -> str:
    """Keys of a kind; those of sections, where some are named; else all but those of the shared sections; `own`: of
    these the required ones and those that few kinds have."""
    own = sections == ["own"]
    found = [key for key in keys_of(kind) if _wanted(key.path, [] if own else sections)]
    found = [
        key
        for key in found
        if not own or _needed(kind, key) or len(_kinds_by_key()[key.path.rpartition(".")[2], key.words]) <= _FEW
    ]
    if not found:
        raise ValueError(f"{kind} has no section {' '.join(sections)}")
    rows = ["| key | meaning | unit | required | default | range |", "| --- | --- | --- | --- | --- | --- |"]
    return "\n".join([*rows, *_rows(found)]) + "\n"


def _rows(found: list[SpecKey]) -> Iterator[str]:
    """A row for each key; a section whose keys are those of an earlier one refers to it."""
    known: dict[tuple[tuple[str, str], ...], str] = {}
    told = ""
    for key in found:
        if told and key.path.startswith(told):
            continue
        told = ""
        below = [each for each in found if each.path.startswith(f"{key.path}.")]
        inner = tuple((each.path.removeprefix(key.path), each.words) for each in below)
        if len(inner) >= _MANY and known.setdefault(inner, key.path) != key.path:
            told = f"{key.path}."
            yield _row(replace(key, words=f"{key.words.rstrip('.')}; keys as in `{known[inner]}`"))
        else:
            yield _row(key)


_MANY = 4
"""Keys of a section that are not said again."""


def _needed(kind: str, key: SpecKey) -> bool:
    """Whether no file of the kind goes without a key: it is required, and so are the sections that hold it."""
    names = key.path.split(".")
    above = {".".join(names[:i]) for i in range(1, len(names))}
    return key.required and all(each.required for each in keys_of(kind) if each.path in above)


_FEW = 4
"""Kinds that have an own key."""


@cache
def _kinds_by_key() -> dict[tuple[str, str], set[str]]:
    """The kinds that have a key of a name, in the same words."""
    found: dict[tuple[str, str], set[str]] = {}
    for kind in FILES:
        for key in keys_of(kind):
            found.setdefault((key.path.rpartition(".")[2], key.words), set()).add(kind)
    return found


def _wanted(path: str, sections: list[str]) -> bool:
    first = path.partition(".")[0]
    return first in sections if sections else first not in SHARED


def _row(key: SpecKey) -> str:
    name = f"`{key.path}`" + (f" (also `{'`, `'.join(key.also)}`)" if key.also else "")
    unit = "" if key.unit in ("", "1") else key.unit
    default = "" if key.default is None or key.required or key.section else f"`{_value(key.default)}`"
    required = "required" if key.required else "optional"
    return f"| {name} | {cell(key.words)} | {cell(unit)} | {required} | {cell(default)} | {cell(key.range)} |"


def _value(value: object) -> str:
    return (
        str(value).lower() if isinstance(value, bool) else f"{value:.10g}" if isinstance(value, float) else str(value)
    )


def cell(text: str) -> str:
    """A text in a cell of a table."""
    return text.replace("|", "\\|").replace("\n", " ").replace("<", "&lt;")


@cache
def _checks_of() -> dict[str, list[str]]:
    """Codes by kind, in their order."""
    found: dict[str, list[str]] = {kind: [] for kind in FILES}
    for code, rule in rules().items():
        for kind in dict.fromkeys(kind for name in rule.checks for kind in schema.index().checks.get(name, ())):
            found[kind].append(code)
    return found


def codes_of(kind: str) -> list[str]:
    """Codes of the checks that a kind makes."""
    return _checks_of()[kind]


def known(code: str) -> bool:
    """Whether a code has a page."""
    return code in explanations()


def checks(kind: str, up: str) -> str:
    """The checks of a kind, each with its page."""
    rows = [
        f"| [{code}]({up}checks/{code}.md) | {', '.join(f'`{name}`' for name in rules()[code].checks)} "
        f"| {cell(rules()[code].title)} |"
        for code in codes_of(kind)
    ]
    return "\n".join(["| code | check | finding |", "| --- | --- | --- |", *rows]) + "\n"


def quantities(kind: str) -> str:
    """The quantities of a kind with the commands that show them."""
    shown: dict[str, list[str]] = {}
    record = FILES[kind]
    for command in record.commands:
        for name in record.design_class(command).quantity_names():
            shown.setdefault(name, []).append(command)
    rows = ["| quantity | symbol | unit | meaning | commands |", "| --- | --- | --- | --- | --- |"]
    for name in sorted(shown):
        term = TERMS.get(name) or TERMS.get(name.rpartition(".")[2])
        if term is None:
            continue
        told = ", ".join(shown[name]) if len(shown[name]) < len(record.commands) else "all"
        unit = "" if term.unit == "1" else term.unit
        rows.append(f"| `{name}` | {cell(term.symbol)} | {cell(unit)} | {cell(term.words)} | {told} |")
    return "\n".join(rows) + "\n" if len(rows) > 2 else ""
