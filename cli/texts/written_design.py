"""A design as the text of a file: every key with its unit, its meaning, and whether it is the designer's to choose."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from gearlink.cli.texts.schema import SpecKey, kind_schema, spec_keys

if TYPE_CHECKING:
    from gearlink.core.base.kind import Kind

_PLAIN = re.compile(r"[A-Za-z_][\w/.-]*( [\w/.-]+)*")
_NOT_TEXT = {"true", "false", "null", "yes", "no", "on", "off", "y", "n"}
_WIDEST = 44  # comments begin no farther to the right than this
_LONG = 72


def written(
    kind: Kind, data: Mapping[str, Any], head: Sequence[str] = (), notes: Mapping[str, str] | None = None
) -> str:
    """The text of a design file.

    Parameters
        data : plain data as a design file has it; None leaves a key out
        head : lines of the comment on top
        notes : path -> what is said of that key's value instead of who chooses it
    Returns
        text : str - read again, it gives the same data
    Example
        >>> from gearlink.core.base.kinds import KINDS
        >>> print(written(KINDS["slider-crank"], {"kind": "slider-crank", "stroke": 310.0, "rod": 520}))
        kind: slider-crank   # an offset slider-crank given by its stroke or its crank
        stroke: 310          # mm: stroke of the slider; optional
        rod: 520             # mm: connecting rod; optional
        <BLANKLINE>
    """
    keys = {key.path: key for key in spec_keys(kind)}
    lines = list(_lines(data, "", keys, notes or {}, kind))
    width = max((len(text) for text, words in lines if words and len(text) <= _WIDEST), default=0)
    body = [f"{text:<{width}}   # {words}" if words else text for text, words in lines]
    return "\n".join([*(f"# {line}".rstrip() for line in head), *body, ""])


def _lines(
    data: Mapping[str, Any], before: str, keys: Mapping[str, SpecKey], notes: Mapping[str, str], kind: Kind
) -> Iterator[tuple[str, str]]:
    """Each line of a section and the words behind it; keys of the kind, such as y, are not quoted."""
    indent = "  " * before.count(".")
    for name, value in data.items():
        path = before + name
        label = f"{indent}{name if path in keys else scalar(name)}:"
        if value is None:
            continue
        words = _summary(kind) if path == "kind" else _words(keys.get(path), notes.get(path, ""))
        if isinstance(value, Mapping) and value:
            yield label, words
            yield from _lines(value, path + ".", keys, notes, kind)
        elif isinstance(value, list) and len(flow(value)) > _LONG:
            yield label, words
            yield from ((f"{indent}  - {flow(item)}", "") for item in value)
        else:
            yield f"{label} {flow(value)}", words


def _summary(kind: Kind) -> str:
    return uncapitalised(kind_schema(kind)["description"].partition("\n")[0])


def uncapitalised(words: str) -> str:
    """A sentence of a section as a remark among those of keys: no capital, no full stop."""
    return words[:1].lower() + words[1:].rstrip(".")


def _words(key: SpecKey | None, note: str) -> str:
    """Unit and meaning of a key, and where its value comes from or who chooses it."""
    if key is None or key.path == "name":
        return note
    unit = "" if key.unit in ("", "1", "teeth") else f"{key.unit}: "
    words = uncapitalised(key.words) if key.section else unit + key.words
    return "; ".join(part for part in (words, note or choice(key)) if part)


def choice(key: SpecKey) -> str:
    """Whether a key is the designer's to choose; nothing for a section, whose keys say it.

    Example
        >>> key = SpecKey("rod", "mm", "connecting rod", "above 0", None, True, False)
        >>> choice(key)
        'required'
    """
    if key.section:
        return ""
    if key.required:
        return "required"
    return "optional" if key.default is None else f"default {flow(key.default)}"


def flow(value: Any) -> str:
    """A value on one line.

    Example
        >>> flow([1.0, 0.1, "a b", {"at": "A: B", "ring": True}])
        '[1, 0.1, a b, {at: "A: B", ring: true}]'
    """
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{scalar(k)}: {flow(v)}" for k, v in value.items() if v is not None) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(flow, value)) + "]"
    return scalar(value)


def scalar(value: Any) -> str:
    """A single value; text is quoted where YAML would take it for something else.

    Example
        >>> scalar(2.0), scalar(1e-7), scalar("no"), scalar("feed 1"), scalar("40:20")
        ('2', '1e-07', '"no"', 'feed 1', '"40:20"')
    """
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return str(int(value)) if value.is_integer() and abs(value) < 1e15 else repr(value)
    if isinstance(value, str):
        plain = _PLAIN.fullmatch(value) and value.isascii() and value.lower() not in _NOT_TEXT
        return value if plain else json.dumps(value, ensure_ascii=False)
    return "null" if value is None else str(value)
