"""`gearlink diff`: what changed between two designs, or between two results that were kept as JSON."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass, field
from functools import partial
from io import BytesIO
from typing import TYPE_CHECKING, Any

from gearlink.cli.evaluate import open_design, read_spec, refusals_located
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.options import Format, Options
from gearlink.cli.printable import json_text, visible
from gearlink.cli.progress import patience
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.reading.places import is_named_pipe, piped
from gearlink.cli.render.json_report import FORMAT, as_plain
from gearlink.core.base.report import Report
from gearlink.core.base.wording import amount

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table as Grid

    from gearlink.cli.reading.loaded_file import LoadedFile
    from gearlink.core.base.design import Design
    from gearlink.core.base.kind import Kind


@dataclass(frozen=True, slots=True)
class Change:
    """One difference; `old` or `new` is None where one side does not have it.

    Fields
        name : str - 'gears.idler', 'frame_length', 'min_transmission_angle[1]', 'GL301 gear-collision'
        relative : float - (new - old)/|old|; None for text, lists of other length and old = 0
        command : str - the command whose result it is; empty for inputs
        detail : str - 'pass -> fail' of a check, 'row 3' of a table
    """

    name: str
    old: Any
    new: Any
    unit: str = ""
    relative: float | None = None
    command: str = ""
    detail: str = ""


@dataclass(frozen=True, slots=True)
class Difference:
    """All that changed."""

    old: str
    new: str
    tolerance: float
    inputs: list[Change] = field(default_factory=list)
    quantities: list[Change] = field(default_factory=list)
    checks: list[Change] = field(default_factory=list)
    tables: list[Change] = field(default_factory=list)

    @property
    def equal(self) -> bool:
        """Nothing changed beyond the tolerance."""
        return not (self.inputs or self.quantities or self.checks or self.tables)


def same(old: Any, new: Any, tolerance: float, least: float = 1.0) -> bool:
    """Whether two values count as equal; numbers do within tolerance * max(minimum, |old|, |new|).

    Example
        >>> same(100.0, 100.0 + 1e-8, 1e-9), same(0.0, 1e-10, 1e-9), same("a", "b", 1.0), same(0.0, 1e-10, 1e-9, 0.0)
        (True, True, False, False)
    """
    if is_number(old) and is_number(new):
        if math.isinf(old) or math.isinf(new):
            return bool(old == new)
        return bool(abs(new - old) <= tolerance * max(least, abs(old), abs(new)))
    return bool(old == new) and isinstance(old, bool) == isinstance(new, bool)


def relative_change(old: Any, new: Any) -> float | None:
    """(new - old)/|old| of two numbers; None where there is none."""
    if not (is_number(old) and is_number(new)) or old == 0:
        return None
    change = (new - old) / abs(old)
    return change if math.isfinite(change) else None


def is_number(value: Any) -> bool:
    """Whether a value is a number, which yes and no are not."""
    return isinstance(value, (int, float)) and not isinstance(value, bool)


# A result that was kept as JSON, read as what it may be: another program's, edited, or no result at all

LARGEST = 1 << 26
"""Bytes; the results of a batch of some thousand designs, without tables."""
_DEEPEST = 12  # a result of a batch has 6 levels, and a value may be a list of lists
_MOST_DIGITS = 308  # beyond them a whole number is beyond all floats
_HEAD = 4096


def read_result(file: str) -> dict[str, Any] | None:
    """The result that a file holds; None where only the reader of design files can judge it.

    Raises
        DesignFileError - GL117 where it is too large, nested too deeply, or has a number beyond all floats
    """
    text = _text(file)
    if text is None:
        return None
    try:
        data = json.loads(text, parse_int=lambda digits: _whole(digits, file))
    except ValueError:
        return None
    except RecursionError:
        raise incomparable(file, _TOO_DEEP) from None
    if not isinstance(data, dict) or "gearlink" not in data:
        return None
    if _deeper(data, _DEEPEST):
        raise incomparable(file, _TOO_DEEP)
    return data


_TOO_DEEP = f"nested deeper than {_DEEPEST} levels, the maximum of a result"


def incomparable(file: str, message: str) -> DesignFileError:
    """Why a file cannot be compared."""
    return DesignFileError([Diagnostic("GL117", message, file=file)])


def _text(file: str) -> bytes | None:
    """What a file holds that begins as a JSON object does."""
    if file == "-" or is_named_pipe(file):
        return None
    held = piped(file, LARGEST + 1)
    try:
        with BytesIO(held) if held is not None else open(file, "rb") as stream:
            data = stream.read(_HEAD)
            if data.lstrip()[:1] != b"{":
                return None
            data += stream.read(LARGEST + 1 - len(data))
    except (OSError, ValueError):
        return None
    if len(data) > LARGEST:
        help_ = "compare results without their tables, or of fewer designs"
        message = f"larger than {LARGEST >> 20} MiB, the maximum for a comparison"
        raise DesignFileError([Diagnostic("GL117", message, file=file, help=help_)])
    return data


def _whole(digits: str, file: str) -> int:
    if len(digits.lstrip("-")) > _MOST_DIGITS:
        raise incomparable(file, f"a whole number of {len(digits.lstrip('-'))} digits is not a value of a design")
    return int(digits)


def _deeper(node: Any, levels: int) -> bool:
    if not isinstance(node, (dict, list)):
        return False
    inner = node.values() if isinstance(node, dict) else node
    return levels == 0 or any(_deeper(each, levels - 1) for each in inner if isinstance(each, (dict, list)))


TOLERANCE = 1e-9


@dataclass(frozen=True, slots=True)
class Side:
    """One of the two files: inputs by key path (none in a result), and results by command."""

    kind: str
    inputs: dict[str, Any]
    units: dict[str, str]
    results: dict[str, dict[str, Any]]


def run_diff(old: str, new: str, options: Options, tolerance: float = TOLERANCE) -> int:
    """Print what changed from `old` to `new`; 0 where nothing did, 1 where something did."""
    from gearlink.cli.render.errors import show_refusal

    try:
        with patience(f"computing {old} and {new}", quiet=options.quiet):
            found = difference(old, new, options, tolerance)
    except DesignFileError as error:
        return show_refusal(error, new, options)
    show_difference(found, options)
    return ExitCode.OK if found.equal else ExitCode.FINDING


def difference(old: str, new: str, options: Options, tolerance: float = TOLERANCE) -> Difference:
    """What changed between two design files or two results.

    Parameters
        old, new : str - file names, or - for one of them
        tolerance : float - results count as equal within tolerance * max(1, |old|, |new|), since what is zero is
            computed as some ulp of the lengths and angles it is made of; inputs within tolerance * max(|old|, |new|),
            since they are typed
    Raises
        DesignFileError - for files that cannot be read, or not be compared with each other (GL117)
    """
    return compared(_side(old, options), _side(new, options), (old, new), tolerance)


def compared(before: Side, after: Side, files: tuple[str, str], tolerance: float = TOLERANCE) -> Difference:
    """As `difference`, of two sides that have been read.

    Parameters
        files : their names
    """
    old, new = files
    if bool(before.inputs) != bool(after.inputs):
        raise incomparable(new, "one file is a design, the other a result\ngive two designs or two results")
    if before.kind != after.kind:
        words = f"a {before.kind} and a {after.kind} cannot be compared\ngive two files of the same kind"
        raise incomparable(new, words)
    found = Difference(old, new, tolerance)
    units = {**before.units, **after.units}
    for path in _union(before.inputs, after.inputs):
        values = before.inputs.get(path), after.inputs.get(path)
        unit = units.get(path.partition("[")[0], "")
        found.inputs.extend(_changes(path, *values, unit, tolerance, least=0.0))
    # Results that the program has just computed are in its own form: an error there is its fault, not the user's.
    with nullcontext() if before.inputs else _results_as_gearlink_writes_them(f"{old}, {new}"):
        for command in _union(before.results, after.results):
            _compare_results(found, command, before.results.get(command), after.results.get(command))
    return found


@contextmanager
def _results_as_gearlink_writes_them(file: str) -> Iterator[None]:
    """A result that was edited, or written by another program, is the user's to repair."""
    try:
        yield
    except (KeyError, TypeError, AttributeError, IndexError, ValueError) as error:
        raise incomparable(file, f"not in the form of `--format json`: {type(error).__name__} {error}") from error


# Reading


def _side(file: str, options: Options) -> Side:
    data = read_result(file)
    if data is None:
        return side_of(*open_design(file, options))
    with _results_as_gearlink_writes_them(file):
        return _result_side(file, data)


def _result_side(file: str, data: dict[str, Any]) -> Side:
    """A result of a design command, or of a batch, whose designs are distinguished by their names."""
    several = isinstance(data.get("designs"), list)
    if not several and "quantities" not in data:
        errors = "this JSON contains errors, not a result"
        raise incomparable(file, errors if "errors" in data else "no result of a design in this JSON")
    named: dict[str, dict[str, Any]] = {}
    for result in data["designs"] if several else [data]:
        name = f"{result['name']}: {result['command']}" if several else str(result["command"])
        named[f"{name} ({result['file']})" if name in named else name] = {"quantities": {}, "checks": (), **result}
    return Side("batch" if several else str(data["kind"]), {}, {}, named)


def side_of(loaded: LoadedFile, kind: Kind) -> Side:
    """A design that has been read: its inputs with defaults filled in, and the results of the commands it asks for.

    Raises
        DesignFileError - where it is refused
    """
    from gearlink.cli.texts.schema import spec_keys

    spec = read_spec(loaded, kind, "-")  # named as it stands: names of files are no difference
    designs = {kind.class_for(command, spec): kind.design(command, spec) for command in spec.commands()}
    with refusals_located(loaded):
        results = {c: as_plain(_report(designs[kind.class_for(c, spec)], c)) for c in spec.commands()}
    inputs = dict(_flat("", spec.model_dump(mode="json", by_alias=True)))
    return Side(kind.name, inputs, {key.path: key.unit for key in spec_keys(kind)}, results)


def _report(design: Design, command: str) -> Report:
    """The command's report without its tables, which follow from the inputs and are not compared."""
    outline = design.outline(command)
    quantities = [quantity for name in outline.quantities if (quantity := design.quantity(name)) is not None]
    checks = [check for name in outline.checks for check in design.check(name)]
    return Report(design.kind, design.spec.name, command, tuple(quantities), tuple(checks))


def _flat(path: str, value: Any) -> Iterator[tuple[str, Any]]:
    """Values by key path; what is left out has no entry."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from _flat(f"{path}.{key}" if path else str(key), inner)
    elif isinstance(value, list) and any(isinstance(item, dict) for item in value):
        for place, item in enumerate(value):
            yield from _flat(f"{path}[{place}]", item)
    elif value is not None:
        yield path, value


# Comparing


def _compare_results(found: Difference, command: str, old: dict[str, Any] | None, new: dict[str, Any] | None) -> None:
    """Add what changed in the result of a command; a result that only one side has is one change."""
    if old is None or new is None:
        has = ("required", None) if new is None else (None, "required")
        found.inputs.append(Change(f"command {command}", *has))
        return
    for name in _union(old["quantities"], new["quantities"]):
        was, now = (side["quantities"].get(name, {}) for side in (old, new))
        unit = str(now.get("unit") or was.get("unit") or "")
        changes = _changes(name, was.get("value"), now.get("value"), unit, found.tolerance, command)
        # A quantity that several commands show is listed once.
        known = [(c.name, c.old, c.new) for c in found.quantities]
        found.quantities.extend(c for c in changes if (c.name, c.old, c.new) not in known)
    known_checks = [(c.name, c.old, c.new, c.detail) for c in found.checks]
    changed = _changed_checks(command, old.get("checks", ()), new.get("checks", ()), found.tolerance)
    found.checks.extend(c for c in changed if (c.name, c.old, c.new, c.detail) not in known_checks)
    for name in _union(old.get("tables", {}), new.get("tables", {})):
        tables = (old.get("tables", {}).get(name), new.get("tables", {}).get(name))
        found.tables.extend(_changed_table(command, name, *tables, found.tolerance))


def _changes(
    name: str, old: Any, new: Any, unit: str, tolerance: float, command: str = "", least: float = 1.0
) -> Iterator[Change]:
    """The change of a value; lists of equal length are compared member by member."""
    if isinstance(old, list) and isinstance(new, list) and len(old) == len(new):
        for place, (was, now) in enumerate(zip(old, new, strict=True)):
            yield from _changes(f"{name}[{place}]", was, now, unit, tolerance, command, least)
    elif not same(old, new, tolerance, least):
        yield Change(name, old, new, unit, relative_change(old, new), command)


def _changed_checks(
    command: str, old: Sequence[dict[str, Any]], new: Sequence[dict[str, Any]], tolerance: float
) -> Iterator[Change]:
    """Checks whose status, value or limit changed; several of one name are distinguished by their order."""
    before, after = _numbered(old), _numbered(new)
    for name in _union(before, after):
        was, now = before.get(name), after.get(name)
        if was is None or now is None:
            only = f"only in {'new' if was is None else 'old'}: {(now or was or {}).get('status')}"
            values = (was or {}).get("value"), (now or {}).get("value")
            yield Change(name, *values, str((now or was or {}).get("unit", "")), None, command, only)
        elif was["status"] != now["status"] or not all(same(was[k], now[k], tolerance) for k in ("value", "limit")):
            status = f"{was['status']} -> {now['status']}" if was["status"] != now["status"] else now["status"]
            if not same(was["limit"], now["limit"], tolerance):
                status += f", limit {_short(was['limit'])} -> {_short(now['limit'])}"
            # What is zero but for rounding has no relative change worth telling.
            equal = same(was["value"], now["value"], tolerance)
            relative = None if equal else relative_change(was["value"], now["value"])
            yield Change(name, was["value"], now["value"], str(now.get("unit", "")), relative, command, status)


def _short(value: Any) -> str:
    return f"{value:.6g}" if is_number(value) else "none"


def _numbered(checks: Sequence[dict[str, Any]]) -> dict[str, dict[str, Any]]:
    """Checks by code and name, the second of a name with #2."""
    found: dict[str, dict[str, Any]] = {}
    for check in checks:
        name = plain = f"{check['code']} {check['name']}"
        count = 1
        while name in found:
            count += 1
            name = f"{plain} #{count}"
        found[name] = check
    return found


def _changed_table(command: str, name: str, old: Any, new: Any, tolerance: float) -> Iterator[Change]:
    """For each column of a table the row that changed most; a table of another shape is one change."""
    shapes = [t and f"{amount(len(t['rows']), 'row')} of {', '.join(t['columns'])}" for t in (old, new)]
    if shapes[0] != shapes[1]:
        yield Change(name, shapes[0], shapes[1], command=command)
        return
    for place, column in enumerate(old["columns"]):
        pairs = [(a[place], b[place], row) for row, (a, b) in enumerate(zip(old["rows"], new["rows"], strict=True))]
        changed = [pair for pair in pairs if not same(pair[0], pair[1], tolerance)]
        if changed:
            was, now, row = max(changed, key=lambda pair: _distance(pair[0], pair[1]))
            detail = f"{len(changed)} of {amount(len(pairs), 'row')}, most in row {row}"
            unit = str(new["units"][place])
            yield Change(f"{name}.{column}", was, now, unit, relative_change(was, now), command, detail)


def _distance(old: Any, new: Any) -> float:
    return float(abs(new - old)) if is_number(old) and is_number(new) else math.inf


def _union(old: Any, new: Any) -> list[str]:
    return list(dict.fromkeys([*old, *new]))


_PARTS = {"inputs": "input", "quantities": "quantity", "checks": "check", "tables": "table"}
_NO_MEMBERS = "[]"
_PERCENT = len("+1.23e-05 %")
_NAME = 16
_WORD = 18  # columns of the longest words of values, where a table is wider than the terminal
_HEADS = ("old", "new", "unit", "change", "command")


def show_difference(found: Difference, options: Options) -> None:
    """Print the difference."""
    if options.format is Format.JSON:
        print(json_text(_plain(found)))
    elif options.format is Format.MARKDOWN:
        print(_as_markdown(found))
    else:
        _show(found, options)


def _plain(found: Difference) -> dict[str, Any]:
    head = {"gearlink": FORMAT, "command": "diff", "old": found.old, "new": found.new}
    head |= {"tolerance": found.tolerance, "equal": found.equal}
    keys = ("name", "command", "old", "new", "unit", "relative", "detail")
    records = {
        part: [{key: _plain_value(getattr(c, key)) for key in keys} for c in getattr(found, part)] for part in _PARTS
    }
    return head | records


def _plain_value(value: Any) -> Any:
    """A value as JSON knows it; what is not finite, which only a result of other programs holds, as a word."""
    if isinstance(value, list):
        return [_plain_value(item) for item in value]
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value


def parts_of(found: Difference, text: Callable[[object], str]) -> Iterator[tuple[str, list[Sequence[str]]]]:
    """Each part that changed, as rows of text: name, old, new, unit, change, command."""
    for part in _PARTS:
        changes: list[Change] = getattr(found, part)
        rows: list[Sequence[str]] = []
        for c in changes:
            percent = "" if c.relative is None else f"{100.0 * c.relative:+.3g} %"
            told = "; ".join(words for words in (percent, c.detail) if words)
            unit = "" if c.unit == "1" else c.unit
            # A check may be here for its limit alone: values that count as equal look equal, some ulp of zero too.
            old = c.new if part == "checks" and same(c.old, c.new, found.tolerance) else c.old
            values = (_NO_MEMBERS if value == [] else text(value) for value in (old, c.new))
            rows.append((c.name, *values, unit, told, c.command))
        if rows:
            yield part, rows


def lines_of(found: Difference) -> Iterator[str]:
    """What changed, a line each, and in how many places."""
    from gearlink.cli.render.numbers import number

    yield _verdict(found)
    for part, rows in parts_of(found, partial(number, digits=9)):
        yield from ("", f"{part}: old, new")
        yield from ("  " + "  ".join(filter(None, (name, f"{old} -> {new}", *more))) for name, old, new, *more in rows)


def _verdict(found: Difference) -> str:
    old, new = visible(found.old), visible(found.new)
    if found.equal:
        return f"{old} and {new} are equal (tolerance {found.tolerance:g})"
    counts = ", ".join(amount(n, one, part) for part, one in _PARTS.items() if (n := len(getattr(found, part))))
    return f"changed from {old} to {new}: {counts}"


def _as_markdown(found: Difference) -> str:
    from gearlink.cli.render.markdown_report import inline, markdown_table, text_of

    sections = [f"## {part}\n\n" + markdown_table((part, *_HEADS), rows) for part, rows in parts_of(found, text_of)]
    return "\n\n".join([*sections, inline(_verdict(found))])


def _show(found: Difference, options: Options) -> None:
    from gearlink.cli.render.numbers import number
    from gearlink.cli.render.terminal import console_for, folded, room_for_names, show_grid

    def broken(text: str) -> str:
        """Words of a value, those that are long broken within."""
        return " ".join(folded(word, _WORD) for word in text.split())

    console = console_for(options)
    digits = 9 if options.digits is None else options.digits  # by default as many as show a change that counts
    for part, told in parts_of(found, partial(number, digits=17 if isinstance(digits, str) else digits)):
        rows = [tuple(map(visible, row)) for row in told]
        grid = _grid(part, rows, console)
        if room_for_names(grid, console) >= max(len(row[0]) for row in rows):
            show_grid(grid, console)
            console.print()
            continue
        # Names and words on several lines, and the command above its rows.
        commands = list(dict.fromkeys(row[-1] for row in rows))
        for command in commands:
            own = [(row[0], *map(broken, row[1:3]), *row[3:]) for row in rows if row[-1] == command]
            head = part if len(commands) == 1 else f"{part} of {command}"
            room = max(_NAME, room_for_names(_grid(head, own, console), console))
            show_grid(_grid(head, own, console, room), console)
            console.print()
    print(_verdict(found))


def _grid(head: str, rows: Sequence[Sequence[str]], console: Console, room: int | None = None) -> Grid:
    """A table of changes, its names folded to some columns."""
    from rich.text import Text

    from gearlink.cli.render.terminal import folded, grid_for

    grid, heads = grid_for(console), (head, *_HEADS)
    # A column that says nothing takes room from the numbers.
    shown = [i for i in range(len(heads)) if heads[i] in (head, "old", "new") or any(row[i] for row in rows)]
    if len({row[-1] for row in rows}) == 1:
        shown = [i for i in shown if heads[i] != "command"]
    for i in shown:
        # Words and members of a list may stand on lines of their own, a number and its per cent sign not.
        whole = heads[i] in (head, "unit") or (heads[i] == "change" and all(len(row[i]) <= _PERCENT for row in rows))
        side: Any = "right" if heads[i] in ("old", "new") else "left"
        grid.add_column(heads[i], justify=side, no_wrap=whole, overflow="fold")
    for name, *others in ([row[i] for i in shown] for row in rows):
        grid.add_row(Text(name if room is None else folded(name, room)), *map(Text, others))
    return grid
