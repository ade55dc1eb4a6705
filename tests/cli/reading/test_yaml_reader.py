"""The YAML traps, each with its exact place, and what may cost neither time nor memory.

Places are compared exactly. Time limits are ten times what was measured on a slow machine (0.2 s for the worst
file of 1 MiB), memory limits three times (40 MB), so that they fail for quadratic work and not for a busy machine.
"""

from __future__ import annotations

import json
import math
import time
import tracemalloc
from typing import Any

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st
from sweeps import examples, mostly_slow

from gearlink.cli.reading import yaml_reader
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.reading.yaml_reader import MAX_BYTES, MAX_DEPTH, MAX_NODES, format_path, plain_value, read

SECONDS = 2.0
PEAK_BYTES = 120e6

PARSERS = [pytest.param(yaml.SafeLoader, id="python")]
if yaml.__with_libyaml__:
    PARSERS.append(pytest.param(yaml.CSafeLoader, id="libyaml"))


@pytest.fixture(params=PARSERS)
def parser(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Any:
    monkeypatch.setattr(yaml_reader, "EventParser", request.param)
    return request.param


def data(text: str) -> Any:
    return read(text.encode(), "f").data


def errors(text: str | bytes) -> list[Diagnostic]:
    with pytest.raises(DesignFileError) as caught:
        read(text.encode() if isinstance(text, str) else text, "f")
    return caught.value.diagnostics


def first(text: str | bytes) -> tuple[str, int, int]:
    wrong = errors(text)[0]
    return wrong.code, wrong.line, wrong.column


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1e-6", 1e-6),
        ("1E6", 1e6),
        ("-.5", -0.5),
        ("+.5e1", 5.0),
        ("1.", 1.0),
        ("010", 10),
        ("0o10", 8),
        ("0x1F", 31),
        ("-12", -12),
        ("+3", 3),
        ("40:20", "40:20"),
        ("no", "no"),
        ("Yes", "Yes"),
        ("on", "on"),
        ("off", "off"),
        ("2024-01-02", "2024-01-02"),
        ("1_000", "1_000"),
        ("0b11", "0b11"),
        ("-0x1", "-0x1"),
        ("1e", "1e"),
        (".", "."),
        ("-", "-"),
        ("+", "+"),
        ("１２", "１２"),
        ("٣", "٣"),
        ("true", True),
        ("FALSE", False),
        ("tRUE", "tRUE"),
        ("~", None),
        ("Null", None),
        ("", None),
        (".inf", math.inf),
        ("-.INF", -math.inf),
        ("inf", "inf"),
        ("nan", "nan"),
        ("1e999", math.inf),
        ("9" * 400, math.inf),
        ("0x" + "f" * 400, math.inf),
        ("1" + "0" * 22, 1e22),
    ],
)
def test_plain_scalars_of_yaml_1_2(text: str, value: Any) -> None:
    got = plain_value(text)
    assert got == value
    assert type(got) is type(value)


def test_not_a_number() -> None:
    assert math.isnan(plain_value(".nan"))


@examples(200)
@given(st.floats(allow_nan=False, allow_infinity=False) | st.integers(-(10**13), 10**14))
def test_numbers_as_python_writes_them_come_back(number: float) -> None:
    got = plain_value(repr(number))
    assert got == number
    assert type(got) is type(number)


def test_quoted_scalars_are_text(parser: Any) -> None:
    assert data("a: '1'\nb: \"no\"\nc: ''\nd: \"x\\ty\"\n") == {"a": "1", "b": "no", "c": "", "d": "x\ty"}


def test_keys_are_text_as_written(parser: Any) -> None:
    assert data("no: 1\n010: 2\n~: 3\n") == {"no": 1, "010": 2, "~": 3}


def test_places_of_keys_values_and_elements(parser: Any) -> None:
    marks = read(b"a: 1\nteeth: [72,\n  36]\nb:\n  - x: 3\n  - 4\n", "f").marks
    assert marks is not None
    assert marks["a"] == (0, 3, None)
    at, value_at, teeth = marks["teeth"]
    assert (at, value_at) == (5, 12)
    assert teeth is not None
    assert (teeth[0][0], teeth[1][0]) == (13, 19)
    elements = marks["b"][2]
    assert elements is not None
    assert elements[0][2] == {"x": (30, 33, None)}
    assert elements[1] == (39, 39, None)


@pytest.mark.parametrize("breaks", ["\n", "\r\n", "\r"])
def test_line_breaks_of_every_system(parser: Any, breaks: str) -> None:
    assert first(breaks.join(["ä: 1", "ö: {x: 1,", " y: 2, é: @}", ""])) == ("GL103", 3, 11)


def test_byte_order_mark_is_no_part_of_the_text(parser: Any) -> None:
    tree = read(b"\xef\xbb\xbfa: 1\na: 2\n", "f")
    assert tree.data == {"a": 1}
    assert (tree.problems[0].line, tree.problems[0].column) == (2, 1)


@pytest.mark.parametrize(
    ("text", "place", "says"),
    [
        ("", (1, 1), "empty"),
        ("# nothing\n\n", (1, 1), "empty"),
        ("---\n", (2, 1), "empty"),
        ("- 1\n", (1, 1), "not of a list"),
        ("gear-pair\n", (1, 1), "not of a single value"),
        ("a:\n\tb: 1\n", (2, 1), "tab"),
        ("a:\n  b: 1\n\tc: 2\n", (3, 1), "tab"),
        ("a:\n  b: 1\n  \tc: 2\n", (3, 3), "tab"),
        ("gears:\n  module:\u00a02\n  crank: 4\n", (2, 10), "U+00A0"),
        ("gears:\n\u00a0\u00a0crank: 2\n", (2, 1), "U+00A0"),
        ("a: 1\nb\u3000c: 2\n", (2, 2), "U+3000"),
        ("a: 1\n\ufeffb: 2\n", (2, 1), "U+FEFF"),
        ("kind：gear-pair\n", (1, 5), "U+FF1A"),
        ("kind：gear-pair\nmodule: 4\n", (1, 5), "U+FF1A"),
        ("a: 1\nb：2\nc: 3\n", (2, 2), "U+FF1A"),
        ("{a： 1}\n", (1, 3), "U+FF1A"),
        ("module:4\ncrank: 3\n", (1, 7), "no space after the colon of 'module'"),
        ("teeth:\n  - 20\n  -40\ncrank: 3\n", (3, 3), "no space after the hyphen of a list entry"),
        ("a: 1\nmodule:4\n", (2, 7), "no space after the colon of 'module'"),
        ("a: 1\n---\nb: 2\n", (2, 1), "second document"),
        ("a: 1\n...\nb: 2\n", (3, 1), "second document"),
        ("{a: 1} b\n", (1, 8), "after the end"),
        ("%YAML 1.1\n---\na: 1\n", (1, 1), "directives"),
        ("a: !!python/object:os.system 1\n", (1, 4), "tags"),
        ("a: !!float 1\n", (1, 4), "tags"),
        ("a: ! 1\n", (1, 4), "tags"),
        ("a: !x {b: 1}\n", (1, 4), "tags"),
        ("b: &b {x: 1}\na:\n  <<: *b\n", (3, 3), "merge keys"),
        ("? [a]\n: 1\n", (1, 3), "a key must be"),
        ("x: &x k\n*x : 1\n", (2, 1), "cannot be a key"),
        ("a: *x\n", (1, 4), "no anchor '&x'"),
        ("a: &x [*x]\n", (1, 8), "inside its own value"),
        ("a: 1\nb: {x: 1\n", (2, 4), "'{' is never closed"),
        ("a: 'x\n", (1, 4), "not closed"),
        ("a: [1, 2\nb: 3\n", (2, 2), "'[' of line 1"),
        ("a: @x\n", (1, 4), "cannot begin with '@'"),
        ("a: b: c\n", (1, 5), "colon"),
        ("a: 1\n b: 2\n", (2, 3), "indentation"),
        ("a:\n  b: 1\n c: 2\n", (3, 2), "indentation"),
        ('a: "x\\q"\n', (1, 6), "escape"),
        ('a: "x\\u0007"\n', (1, 4), "U+0007"),
        ('"\\u0007": 1\n', (1, 1), "in a key"),
    ],
)
def test_syntax_errors_name_place_and_cause(parser: Any, text: str, place: tuple[int, int], says: str) -> None:
    wrong = errors(text)[0]
    if parser is yaml.SafeLoader and wrong.line == place[0] and ("indentation" in wrong.message or says == "escape"):
        place = (wrong.line, wrong.column)  # of these the pure Python parser tells another column
    assert (wrong.code, wrong.line, wrong.column) == ("GL103", *place)
    assert says in wrong.message


@pytest.mark.parametrize(
    ("before", "key", "place"),
    [
        ("a: 1\n", "k" * 1100, (2, 1)),
        ("", "k" * 1100, (1, 1)),
        ("a: 1\n", "'" + "k" * 1100 + "'", (2, 1)),
        ("a:\n  ", "k" * 1100, (2, 3)),
        ("a:\n  - ", "k" * 1100, (2, 5)),
        ("a: {b: 1, ", "k" * 1100, (1, 11)),
    ],
)
def test_a_key_that_is_too_long_is_named_as_that(parser: Any, before: str, key: str, place: tuple[int, int]) -> None:
    wrong = errors(f"{before}{key}: 1{'}' if '{' in before else ''}\n")[0]
    assert (wrong.code, wrong.line, wrong.column) == ("GL103", *place)
    assert wrong.message == f"a key of {len(key)} characters: YAML takes 1024"


def test_the_longest_key_and_a_long_line_without_a_colon(parser: Any) -> None:
    assert len(next(iter(data("k" * 1024 + ": 1\n")))) == 1024
    assert "colon is missing" in errors("a: 1\n" + "k" * 1100 + " # a note: no colon\nb: 2\n")[0].message


def test_each_hint_says_what_to_type() -> None:
    assert "spaces" in errors("a:\n\tb: 1\n")[0].help
    assert errors("kind：x\n")[0].help == "type : instead"
    assert errors("module:4\ncrank: 3\n")[0].help == "write 'module: ...'"


def test_odd_signs_in_text_and_comments_are_a_writers_own() -> None:
    """A full-width colon in a name must not be taken for the cause of an error elsewhere."""
    assert data("# 注：一\nname: 印刷机：甲\nb: 'x\u00a0y'\n") == {"name": "印刷机：甲", "b": "x\u00a0y"}
    wrong = errors("# 注：一\nname: 印刷机：甲\nb: 1\n c: 2\n")[0]
    assert (wrong.line, wrong.column) == (4, 3)
    assert "colon that is not allowed here" in wrong.message


def test_tabs_that_yaml_allows(parser: Any) -> None:
    if parser is yaml.SafeLoader:
        pytest.skip("the pure Python parser refuses them")
    assert data("a:\t1\nb: {\n\tc: 2\n}\n") == {"a": 1, "b": {"c": 2}}


def test_duplicates_are_all_told_and_the_first_is_kept(parser: Any) -> None:
    tree = read(b"a: 1\na: {x: 3}\nb: {c: 1, c: 2}\nd:\n  - {e: 1, e: 2}\n", "f")
    assert tree.data == {"a": 1, "b": {"c": 1}, "d": [{"e": 1}]}
    assert [(d.code, d.line, d.column, d.key) for d in tree.problems] == [
        ("GL104", 2, 1, "a"),
        ("GL104", 3, 11, "b.c"),
        ("GL104", 5, 12, "d[0].e"),
    ]
    assert "line 1" in tree.problems[0].message


def test_duplicates_are_told_together_with_the_syntax_error_after_them() -> None:
    assert [d.code for d in errors("a: 1\na: 2\nb: [1\n")] == ["GL104", "GL103"]


@pytest.mark.parametrize(
    ("raw", "place", "says"),
    [
        ("a: 1".encode("utf-16"), (1, 1), "UTF-16"),
        ("a: 1".encode("utf-16-be"), (1, 1), "NUL"),
        (b"\xfe\xff" + "a: 1".encode("utf-16-be"), (1, 1), "UTF-16"),
        ("a: 1".encode("utf-32"), (1, 1), "UTF-32"),
        (b"a: 1\nb: \xe4\n", (2, 4), "0xe4"),
        ("ä: 1\nö: ".encode() + b"\x80", (2, 4), "0x80"),
        (b"a: 1\nb: \0\n", (2, 4), "NUL"),
        (b"a: \x1b[31m\n", (1, 4), "U+001B"),
        ("a: x\u2028b: 1\n".encode(), (1, 5), "U+2028"),
        (b"\x89PNG\r\n\x1a\n" + bytes(range(256)), (1, 1), "0x89"),
        (bytes(range(256)) * 4000, (1, 1), "0x80"),
    ],
)
def test_encoding_errors(raw: bytes, place: tuple[int, int], says: str) -> None:
    wrong = errors(raw)[0]
    assert wrong.code == "GL102"
    assert says in wrong.message
    if "0x80" not in says or len(raw) < 100:
        assert (wrong.line, wrong.column) == place


def test_aliases_are_written_out(parser: Any) -> None:
    tree = read(b"a: &x {m: 1}\nb: *x\nc: &y 2\nd: [*y, *x]\n", "f")
    assert tree.data == {"a": {"m": 1}, "b": {"m": 1}, "c": 2, "d": [2, {"m": 1}]}
    assert tree.marks is not None
    assert tree.marks["b"][2] == {"m": (7, 10, None)}


def test_depth_cap_is_exact_and_counts_what_aliases_hold(parser: Any) -> None:
    def nested(levels: int, inner: str = "1") -> str:
        return "[" * levels + inner + "]" * levels

    data(f"a: {nested(MAX_DEPTH - 1)}\n")
    assert first(f"a: {nested(MAX_DEPTH)}\n") == ("GL110", 1, 3 + MAX_DEPTH)
    half = MAX_DEPTH // 2
    data(f"a: &a {nested(half)}\nb: {nested(half - 1, '*a')}\n")
    assert first(f"a: &a {nested(half)}\nb: {nested(half, '*a')}\n")[:2] == ("GL110", 2)


def _limited(context: str) -> type:
    """A parser that ends with the words of PyYAML 6.0.4 in front of its 1001st bracket, before it gives any event."""

    class Limited:
        def __init__(self, text: str) -> None:
            self.text = text

        def get_event(self) -> Any:
            start, end = (yaml.Mark("f", at, 0, at, None, None) for at in (0, self.text.index("[") + 1000))
            raise yaml.scanner.ScannerError(context, start, "exceeded maximum nesting depth", end)

    return Limited


@pytest.mark.parametrize("context", ["while increasing flow level", "while increasing block level"])
def test_a_parser_s_own_limit_of_nesting_is_ours(context: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """PyYAML 6.0.4 has one, 6.0.3 has none: files and --set are refused alike, for the same reason."""
    monkeypatch.setattr(yaml_reader, "EventParser", _limited(context))
    (wrong,) = errors("a: 1\nb: " + "[" * 2000)
    assert (wrong.code, wrong.message) == ("GL110", f"nested deeper than {MAX_DEPTH} levels")
    assert (wrong.line, wrong.column) == (2, 1004)


def test_a_template_that_nobody_filled_in_says_what_to_do() -> None:
    (wrong,) = errors("module: {{ m }}\n")
    assert wrong.message == "a key must be one word, not a list or a section"
    assert wrong.help == "take the braces or brackets away, or put text with them in quotes"


@pytest.mark.slow
def test_node_cap_is_exact() -> None:
    data("a: [" + "1," * (MAX_NODES - 2) + "]\n")
    assert first("a: [" + "1," * (MAX_NODES - 1) + "]\n")[0] == "GL110"


LAUGHS = "".join(f"a{i}: &a{i} [{','.join([f'*a{i - 1}' if i else 'x'] * 10)}]\n" for i in range(12))
ATTACKS = {
    "alias bomb": (LAUGHS, "GL110"),
    "deep flow lists": ("[" * 50_000, "GL110"),
    "deep flow lists, a line each": ("[\n" * 50_000, "GL110"),
    "deep flow mappings": ("{a: " * 50_000, "GL110"),
    "deep block lists": ("- " * 50_000, "GL110"),
    "deep block mappings": ("".join(" " * i + "a:\n" for i in range(1_400)), "GL110"),
    "deep complex keys": ("? " * 50_000, "GL103"),
    "too large": ("#" * (MAX_BYTES + 1), "GL110"),
    "many elements": ("a: [" + "1," * 500_000 + "]", "GL110"),
    "many duplicates": ("a: 1\n" * 200_000, "GL110"),
    "many directives": ("".join(f"%TAG !a{i}! x\n" for i in range(55_000)), "GL103"),
    "many directives after the end": ("a: 1\n...\n" + "".join(f"%TAG !a{i}! x\n" for i in range(55_000)), "GL103"),
    "empty lines": ("\n" * MAX_BYTES, "GL103"),
    "one comment": ("#" * MAX_BYTES, "GL103"),
    "quotes": ('"' * MAX_BYTES, "GL103"),
    "colons": (":" * MAX_BYTES, "GL103"),
    "anchors": ("&a " * 300_000, "GL103"),
    "an open quotation": ('a: "' + "x\n" * 500_000, "GL103"),
    "odd keys": ("\u00a0k: 1\n" * 20_000, "GL103"),
    "full-width colons": ("：" * 300_000, "GL103"),
}


@pytest.mark.quick(8)
@pytest.mark.skipif(not yaml.__with_libyaml__, reason="the pure Python parser needs a minute for 1 MiB")
@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=pytest.mark.slow) if name in ("empty lines", "quotes", "many duplicates") else name
        for name in ATTACKS
    ],
)
def test_attacks_are_refused_at_once(name: str) -> None:
    text, code = ATTACKS[name]
    start = time.process_time()
    wrong = errors(text)[-1]
    assert time.process_time() - start < SECONDS
    assert wrong.code == code or name in ("many duplicates", "odd keys")
    assert len(wrong.as_text()) < 1_000


@pytest.mark.slow
@pytest.mark.skipif(not yaml.__with_libyaml__, reason="the pure Python parser needs a minute for 1 MiB")
@pytest.mark.parametrize("name", mostly_slow(["many elements", "empty lines", "odd keys"], 1))
def test_attacks_take_little_memory(name: str) -> None:
    tracemalloc.start()
    try:
        errors(ATTACKS[name][0])
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    print(f"\n{name}: {peak / 1e6:.0f} MB")
    assert peak < PEAK_BYTES


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", [name for name in ATTACKS if name.startswith(("deep", "alias"))])
def test_nesting_attacks_on_the_pure_python_parser(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(yaml_reader, "EventParser", yaml.SafeLoader)
    text, code = ATTACKS[name]
    assert errors(text)[-1].code == code


@pytest.mark.skipif(not yaml.__with_libyaml__, reason="the pure Python parser needs a minute for 1 MiB")
@pytest.mark.parametrize("text", ["9" * 1_000_000, "0x" + "f" * 1_000_000, "x" * 1_000_000, "1." + "1" * 1_000_000])
def test_long_scalars_cost_no_time(text: str) -> None:
    start = time.process_time()
    data(f"a: {text}")
    assert time.process_time() - start < SECONDS


KEYS = st.text("abcdefgh_-", min_size=1, max_size=6)
WORDS = st.text(
    st.characters(min_codepoint=32, max_codepoint=0xFFFD, exclude_categories=("Cs", "Cc", "Zl", "Zp", "Cn"))
)
LEAVES = (
    st.none() | st.booleans() | st.integers(-(10**9), 10**9) | st.floats(allow_nan=False, allow_infinity=False) | WORDS
)
TREES = st.dictionaries(
    KEYS,
    st.recursive(LEAVES, lambda t: st.lists(t, max_size=4) | st.dictionaries(KEYS, t, max_size=4), max_leaves=12),
    min_size=1,
    max_size=5,
)


@pytest.mark.slow
@examples(200)
@given(TREES, st.sampled_from([None, 1, 3]), st.booleans())
def test_json_is_read_as_it_was_written(tree: dict[str, Any], indent: int | None, ascii_only: bool) -> None:
    text = json.dumps(tree, indent=indent, ensure_ascii=ascii_only)
    got = read(text.encode(), "f")
    assert got.data == tree
    assert json.dumps(got.data) == json.dumps(tree)  # 1 and 1.0, true and 1 are distinguished
    assert got.marks is not None
    for key, (at, value_at, _) in got.marks.items():
        assert text.startswith(json.dumps(key), at)
        assert text.startswith(json.dumps(tree[str(key)], ensure_ascii=ascii_only)[:1], value_at)
    if indent == 1:
        lines = [i for i, row in enumerate(text.split("\n"), 1) if row[:2] == ' "']
        assert [got.source.place(mark[0])[0] for mark in got.marks.values()] == lines


DESIGN = "kind: gear-pair\ngears: {module: 2, teeth: [72, 36]}  # two\nlinks:\n  - a: 'x'\n    b: &b 1e-6\nc: *b\n"
PIECES = st.sampled_from(
    [*"\t\u00a0：:[]{}'\"\n#!%|>,@\r\0\ufeffa", ": ", "- ", "? ", "\n  ", "&b ", "*b", "---\n", "...", "<<: ", "\\u"]
)


@examples(400)
@given(st.binary(max_size=200) | st.lists(PIECES, max_size=30).map(lambda some: "".join(some).encode()))
def test_no_bytes_raise_anything_else(raw: bytes) -> None:
    _read_or_refuse(raw)


@examples(400)
@given(st.lists(st.tuples(st.integers(0, len(DESIGN)), st.integers(0, 3), PIECES), min_size=1, max_size=4))
def test_no_mutation_raises_anything_else(edits: list[tuple[int, int, str]]) -> None:
    text = DESIGN
    for at, cut, piece in edits:
        text = text[:at] + piece + text[at + cut :]
    _read_or_refuse(text.encode())


def _read_or_refuse(raw: bytes) -> None:
    found: list[Diagnostic] = []
    try:
        assert isinstance(read(raw, "f").data, dict)
    except DesignFileError as error:
        found = error.diagnostics
    for wrong in found:
        assert wrong.code in ("GL102", "GL103", "GL104", "GL110")
        assert 1 <= wrong.column <= len(wrong.source) + 1
        wrong.as_text("ascii").encode("ascii")


def test_format_path() -> None:
    assert format_path(("a", 0, 1, "b")) == "a[0][1].b"
    assert format_path(()) == ""


def test_speed_of_a_typical_design() -> None:
    """Printed with -s: about 0.12 ms for 30 lines, 1.4 ms with PyYAML's own pure Python loader."""
    text = "kind: flatbed-press\n" + "".join(
        f"section_{i}:\n  radius: 140   # mm\n  links: {{crank: 100, coupler: 100.5, rocker: 95, frame: 40}}\n"
        for i in range(10)
    )
    start = time.perf_counter()
    for _ in range(100):
        read(text.encode(), "f")
    print(f"\n{len(text.splitlines())} lines: {(time.perf_counter() - start) * 10:.3f} ms")
