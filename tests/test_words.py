"""The words of the field in all texts that users read: of the program, README, docs and comments of designs."""

from __future__ import annotations

import json
import re
from bisect import bisect_right
from collections.abc import Iterator
from functools import cache
from itertools import accumulate
from pathlib import Path
from types import CodeType

import pytest

ROOT = Path(__file__).parents[1]

WORDS = {
    r"\bgreatest\b(?! common)": "maximum",
    r"(?<!at )(?<!--)\bleast\b(?! squares|-| common)": "minimum",
    r"\bas made\b": "as manufactured",
    r"\b(come|comes|coming|bring|brings|brought|way|is) home\b": "return",
    r"\bway back\b": "return stroke",
    r"(?<!oil )(?<!lubricant )\bfilms?\b(?![\"(]| thickness)": "animation",
    r"\byours to choose\b": "required",
    r"\bmay be left out\b": "optional",
    r"\b(to spare|in hand)\b": "margin, reserve",
    r"\bthinnest shaft\b": "minimum shaft radius",
    r"\bdead points?\b": "dead centre",
    r"\b(worked|mended) (design|file)s?\b": "example",
    r"\bremed(y|ies)\b": "fix",
    r"(?<!also: )\bgear-linkages?\b": "geared linkage",
    r"\bthe mate\b": "the mating gear",
    r"\bbesides\b": "in addition",
    r"\b(is|are|was|were) wanted\b": "required",
    r"\b(one|per|each|every|whole|full|half a|of a) turn\b": "revolution",
    r"\bmakes? good\b": "compensates",
    r"(?<!last )(?<!decimal )\bplaces?\b": "position",
    r"\brooms?\b": "clearance, margin",
    r"\bleft out\b|\bleaves? [^ ]+ out\b": "default, omit",
    r"\bask(s|ed|ing)?( [^ ]+){0,2} (for|of)\b": "specify, require",
    r"\bwanted\b|\bwish(es)?\b": "required, target",
    r"\bscatters?\b(?!-)": "vary, variation",
    r"\bjudge[sd]?\b": "check, evaluate",
    r"\bhollows?\b(?! shaft)|\bbulges?\b": "concave, convex",
    r"\bchanges sides\b": "changes flank",
    r"\bpictures?\b": "figure",
    r"\bbeside\b": "next to, in addition to",
    r"\bstands? still\b": "dwells, is at rest",
    r"\bhow far\b": "distance, amount",
    r"\bbite\b": "pick-up position",
}
"""What is not written, as a pattern, and the word of the field in its place."""

GENERATED = {"nomenclature.md", "validation.md", "benchmarks.md"}
KEYS = re.compile(r"`[^`]*`|https?:\S+|\]\([^)]*\)|\b[\w-]+[._/][\w./_-]+\b")
"""Keys, names of quantities, files and addresses, which are fixed."""


def _literals(path: Path) -> Iterator[str]:
    """The prose among the strings of a module; the compiler drops docstrings and the descriptions of constants."""
    source = path.read_bytes().replace(b"from __future__ import annotations", b"")  # annotations are no texts
    yield from _constants(compile(source, path, "exec", dont_inherit=True, optimize=2))


def _constants(value: object) -> Iterator[str]:
    if isinstance(value, str) and " " in value:
        yield value
    elif isinstance(value, (CodeType, tuple, frozenset)):
        for each in value.co_consts if isinstance(value, CodeType) else value:
            yield from _constants(each)


def _strings(data: object) -> Iterator[str]:
    if isinstance(data, str):
        yield data
    elif isinstance(data, dict):
        for key, value in data.items():
            if key != "also":  # words that users may type in place of the field's
                yield from _strings(value)
    elif isinstance(data, list):
        for value in data:
            yield from _strings(value)


@cache
def _texts() -> dict[str, list[str]]:
    """Every text that a user reads, by the file that it stands in."""
    found = {}
    for top in ("core", "cli"):
        for path in sorted((ROOT / top).rglob("*.py")):
            found[str(path.relative_to(ROOT))] = list(_literals(path))
    for path in sorted((ROOT / "cli" / "texts").glob("*.json")):
        strings = _strings(json.loads(path.read_text(encoding="utf-8")))
        found[str(path.relative_to(ROOT))] = [text for text in strings if " " in text]
    for path in [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]:
        if path.name not in GENERATED:
            text = re.sub(r"(?ms)^```.*?^```|^\* Also:.*?$", "", path.read_text(encoding="utf-8"))
            found[str(path.relative_to(ROOT))] = [KEYS.sub("", text)]
    for path in sorted((ROOT / "designs").rglob("*.yaml")):
        comments = re.findall(r"(?m)(?:^|\s)#(.*)$", path.read_text(encoding="utf-8"))
        found[str(path.relative_to(ROOT))] = [KEYS.sub("", text) for text in comments]
    return found


@cache
def _joined() -> tuple[str, list[int], list[str]]:
    """Every text once, in small letters and a line each, where each begins and the file that it is in."""
    whose = {" ".join(text.split()).lower(): file for file, texts in _texts().items() for text in texts}
    starts = list(accumulate((len(text) + 1 for text in whose), initial=0))
    return "\n".join(whose), starts, list(whose.values())


@pytest.mark.parametrize("pattern", WORDS)
def test_texts_have_the_words_of_the_field(pattern: str) -> None:
    text, starts, files = _joined()
    found = [
        f"{files[bisect_right(starts, hit.start()) - 1]}: {text[max(0, hit.start() - 40) : hit.end() + 30]!r}"
        for hit in re.finditer(pattern, text)
    ]
    assert not found, f"{len(found)} times, write {WORDS[pattern]!r}:\n" + "\n".join(found)


def test_the_texts_are_read() -> None:
    text, _, files = _joined()
    assert len(text) > 500_000
    assert {Path(file).suffix for file in files} == {".py", ".json", ".md", ".yaml"}
    assert re.search(r"\bmaximum\b", text)


def test_speeds_have_one_unit() -> None:
    """Messages and figures said rev/min where tables say 1/min; a file may say either."""
    pages = [*(ROOT / "docs").rglob("*.md"), *(ROOT / "designs").rglob("*.yaml"), ROOT / "README.md"]
    texts = [_joined()[0], *(path.read_text(encoding="utf-8") for path in pages)]
    assert not [text for text in texts if "rev/min" in text]
