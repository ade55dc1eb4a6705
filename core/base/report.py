"""The result of a command as plain data: quantities with unit and symbol, checks with code and limit, tables.

Notebooks show reports and tables as HTML instead of text.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import chain, islice
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias

from gearlink.core.base.wording import DIGITS, amount, apart, compared, directed, in_unit, plain, short

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from gearlink.core.base.key_results import KeyResult

    Column: TypeAlias = Sequence[Any] | NDArray[Any]

Value = float | int | str | bool | list[float] | list[int] | list[str] | list[float | None] | list[list[float] | None]
"""What a quantity may be: of some gears or meshes a list, with None where one has none, and a pair of limits each."""
Status = Literal["pass", "warn", "fail"]
Side = Literal[">=", "<=", ""]
"""How a value that passes stands to its limit; no word where the limit is what was asked for, or decides not alone."""
Remedy: TypeAlias = tuple[tuple[str, float | str | tuple[float, ...] | None], ...]
"""Keys of the design file with the values that repair a finding, to be put in together; None leaves a key out."""
_BLOCK = 4096


@dataclass(frozen=True, slots=True)
class Quantity:
    """A named result in the unit of the design files.

    Fields
        name : str - as in docs/nomenclature.md
        value : float, int, str, bool or a list of them, None for an entry that does not exist
        unit : str - "mm", "deg", "1/min"; "1" without a dimension
        symbol : str - of the sources; empty where they have none
        words : str - what it is
    """

    name: str
    value: Value
    unit: str
    symbol: str
    words: str


class Shown(NamedTuple):
    """What a message compares, where that is not the value and limit that are judged.

    Fields
        value : float, text or None - None: the message states no number
        side : how a value that passes stands to the limit
        word : str - what the limit is called
    """

    value: float | str | None = None
    limit: float | None = None
    unit: str = "1"
    side: Side = ">="
    word: str = "limit"


NO_NUMBER = Shown()
"""Of a finding that is a statement without a number."""
_MOST_CHARACTERS = 240
"""Of a message, before its fix."""


class Check(NamedTuple):
    """One finding: `status` follows from comparing `value` with `limit`; the message is formed from its parts.

    WHAT: value unit (limit op limit unit; aside) at PLACE

    Fields
        code, name : str - "GL303" and the check, "transmission-angle"
        status : "pass", "warn" or "fail"
        value, limit : float or None - the compared numbers in `unit`, unrounded
        side : ">=", "<=" or "" - how a value that passes is related to the limit
        what : str - what was measured, or a statement where no number is shown
        remedy : the change of the file that was tried
        at : str - where in the cycle, with its unit
        advice : str - what would repair it in general; shown as the fix where none was found by trial
        note : what is to be known besides, such as warnings that a remedy leaves
        shown : what the message compares instead of value and limit
        aside : str - what stands behind the limit in its parentheses
        relaxes : bool - the remedy asks less of the machine
    """

    code: str
    name: str
    status: Status
    what: str
    value: float | None = None
    limit: float | None = None
    unit: str = "1"
    remedy: Remedy = ()
    side: Side = ">="
    at: str = ""
    advice: str = ""
    note: tuple[str, ...] = ()
    shown: Shown | None = None
    aside: str = ""
    relaxes: bool = False

    @property
    def message(self) -> str:
        """The text of the finding, at most 240 characters, without the fix."""
        for aside in (self.aside, ""):
            text = self._worded(aside)
            if len(text) <= _MOST_CHARACTERS:
                return text
        return f"{text[: _MOST_CHARACTERS - 3]}..."

    @property
    def brief(self) -> str:
        """Code, name, value and limit as the message has them, for a stamp on a picture.

        Example
            >>> rule = Rule("GL303", "", "", "", "", checks=("transmission-angle",))
            >>> rule.check("fail", "the angle", 31.25, 40.0, "deg").brief
            'GL303 transmission-angle 31.25 deg (limit >= 40 deg)'
        """
        shown = self.shown or Shown(self.value, self.limit, self.unit, self.side)
        value, bound = self._compared(shown)
        text = f"{self.code} {self.name}" + (f" {in_unit(value, shown.unit)}" if value else "")
        return f"{text} ({bound})" if bound else text

    def _worded(self, aside: str) -> str:
        shown = self.shown or Shown(self.value, self.limit, self.unit, self.side)
        value, bound = self._compared(shown)
        text = f"{self.what}: {in_unit(value, shown.unit)}" if value else self.what
        inside = "; ".join(part for part in (bound, aside) if part)
        text += f" ({inside})" if inside else ""
        return f"{text} at {self.at}" if self.at else text

    def _compared(self, shown: Shown) -> tuple[str, str]:
        """Value and condition in words; no condition that a finding meets which does not pass."""
        value, limit = shown.value, shown.limit
        if value is None or isinstance(value, str):
            return value or "", ""
        if limit is None or math.isnan(value):
            return short(value), ""
        passes = self.status == "pass"
        if not shown.side:
            now, bound = apart(value, limit)
            return now, f"required {in_unit(bound, shown.unit)}"
        met = value >= limit if shown.side == ">=" else value <= limit
        if met is not passes and value != limit:
            return short(value), ""
        side = shown.side if passes or value != limit else shown.side[0]
        now, bound = compared(value, limit, shown.side, met)
        return now, f"{shown.word} {side} {in_unit(bound, shown.unit)}"

    @property
    def fix(self) -> str | None:
        """The one change that repairs the finding: a tested one, else general advice; None where there is none."""
        if self.remedy:
            return fix_words(self.remedy, relaxes=self.relaxes)
        return self.advice or None

    @property
    def lines(self) -> tuple[str, ...]:
        """The message, its fix and its notes, each to stand on a line of its own."""
        fix = self.fix
        return (self.message, *((f"fix: {fix}",) if fix else ()), *(f"note: {each}" for each in self.note))


class Rule(NamedTuple):
    """A code with its texts, which `gearlink explain` prints; the findings of a check are made from it.

    Fields
        code : str - "GL301"
        title : str - a few words
        what, why : str - what was found, and why it matters
        remedy : str - what to change
        formula, source : str - the quantity that was compared, and where it comes from; empty for file errors
        checks : names of the checks that report with the code; empty for file errors
        keys : dotted paths of the design file's keys that a finding belongs to, the most telling first
        side : how a value that passes stands to its limit
    """

    code: str
    title: str
    what: str
    why: str
    remedy: str
    formula: str = ""
    source: str = ""
    checks: tuple[str, ...] = ()
    keys: tuple[str, ...] = ()
    side: Side = ">="

    @property
    def name(self) -> str:
        """Name of its check, the first where it has several."""
        return self.checks[0]

    def check(
        self,
        status: Status,
        what: str,
        value: float | None = None,
        limit: float | None = None,
        unit: str = "1",
        *,
        name: str = "",
        side: Side | None = None,
        at: str = "",
        fix: str = "",
        note: str = "",
        shown: Shown | None = None,
        aside: str = "",
        recommended: float | None = None,
        overlap: str = "",
    ) -> Check:
        """A finding of the rule; its message is formed from the parts: see `Check`.

        Parameters
            status, value, limit, unit : as they are judged
            what : str - what was measured ("transmission angle of the bed drive"), no number, no advice
            name : str - of the check, where the rule has several
            side : how a value that passes stands to the limit, where that is not the rule's
            at : str - where in the cycle: "input angle 40 deg"
            fix : str - one change that would repair it in general, in the imperative; of no use where it passes
            note : str - what is to be known besides
            shown : what the message compares instead of value and limit
            aside : str - what stands beside the limit
            recommended : float - the limit at which it warns, where that is not the one at which it fails
            overlap : str - what a value below 0 is called, which is shown without its sign
        Raises
            ArithmeticError - where what passes is not a number: that no comparison holds is no reason to pass
        Example
            >>> angle = Rule("GL303", "", "", "", "", checks=("transmission-angle",))
            >>> angle.check("fail", "transmission angle", 21.34, 40.0, "deg", at="input angle 40 deg").message
            'transmission angle: 21.34 deg (limit >= 40 deg) at input angle 40 deg'
        """
        if status == "pass" and value is not None and math.isnan(value):
            raise ArithmeticError(f"{self.code} {name or self.name} evaluates what is not a number")
        side = self.side if side is None else side
        if shown is None and overlap and value is not None and value < 0.0:
            what, shown = overlap, Shown(-value, max(0.0, -(limit or 0.0)), unit, "<=")
        elif shown is None and recommended is not None and status == "warn":
            shown = Shown(value, recommended, unit, side, "recommended")
        advice = "" if status == "pass" else fix
        notes = (note,) if note else ()
        return Check(
            self.code, name or self.name, status, what, value, limit, unit, (), side, at, advice, notes, shown, aside
        )

    def below(
        self, value: float, limit: float, warn: float, unit: str, what: str, fix: str, *, at: str = "", note: str = ""
    ) -> Check:
        """A finding that fails where `value` < `limit` and warns where it is below `warn`.

        Example
            >>> angle = Rule("GL303", "", "", "", "", checks=("transmission-angle",))
            >>> found = angle.below(42.0, 40.0, 45.0, "deg", "transmission angle", "lengthen l4")
            >>> found.lines
            ('transmission angle: 42 deg (recommended >= 45 deg)', 'fix: lengthen l4')
        """
        status: Status = "fail" if value < limit else "warn" if value < warn else "pass"
        return self.check(status, what, value, limit, unit, fix=fix, recommended=warn, at=at, note=note)


@dataclass(frozen=True, slots=True)
class Table:
    """Columns of equal length, sequences or one-dimensional arrays; `data[i]` is `columns[i]` in `units[i]`.

    Arrays of `data` are read-only, for a design may keep them; a column by name is the reader's own.
    """

    name: str
    columns: tuple[str, ...]
    units: tuple[str, ...]
    data: tuple[Column, ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "data", tuple(map(_read_only, self.data)))

    @classmethod
    def of(cls, name: str, columns: Mapping[str, tuple[Column, str]]) -> Table:
        """A table from its columns by name, each the data and their unit.

        Example
            >>> Table.of("law", {"x": ([0.0, 0.5], "1"), "velocity": ([0.0, 2.0], "mm/s")}).units
            ('1', 'mm/s')
        """
        data, units = zip(*columns.values(), strict=True)
        return cls(name, tuple(columns), units, data)

    def __getitem__(self, column: str) -> NDArray[Any]:
        """A column by name, as a new array; where all else are numbers, NaN stands for what does not exist.

        Raises
            KeyError - for a name that is not among the columns
        """
        import numpy as np

        if column not in self.columns:
            raise KeyError(f"no column {column!r}; the columns are {', '.join(self.columns)}")
        found = np.array(self.data[self.columns.index(column)])
        if found.dtype == object and all(item is None or isinstance(item, (int, float)) for item in found):
            return found.astype(float)
        return found

    def __repr__(self) -> str:
        return f"<table {self.name}: {self._size} of {', '.join(self.columns)}>"

    @property
    def _size(self) -> str:
        return amount(self.length, "row")

    def _repr_html_(self) -> str:
        return table_as_html(self)

    @property
    def length(self) -> int:
        """How many rows it has."""
        return max(map(len, self.data), default=0)

    def each_row(self) -> Iterator[tuple[float | str | None, ...]]:
        """The rows one after the other, made a few thousand at a time; as `rows`."""
        for start in range(0, self.length, _BLOCK):
            yield from zip(*(_plain(column[start : start + _BLOCK]) for column in self.data), strict=True)

    def rows(self) -> list[list[float | str | None]]:
        """The table turned into rows; None where a value does not exist (infinite or not a number)."""
        return [list(row) for row in self.each_row()]

    def thinned(self, step: int) -> Table:
        """The table with every `step`-th row."""
        return replace(self, data=tuple(column[::step] for column in self.data))


@dataclass(frozen=True, slots=True, repr=False)
class TableInParts(Table):
    """A table of any length whose rows are computed while they are read; `data` are those of its first part alone."""

    parts: Callable[[], Iterator[Table]]

    @property
    def _size(self) -> str:
        return "rows in parts"

    def each_row(self) -> Iterator[tuple[float | str | None, ...]]:
        """The rows of one part after the other."""
        for part in self.parts():
            yield from part.each_row()


@dataclass(frozen=True, slots=True)
class Report:
    """All results of a command for one design, as data.

    Fields
        kind, name, command : str - kind and name of the design, and the command
        quantities : tuple of Quantity - in the units of the design files
        checks : tuple of Check - all findings, those that pass among them
        tables : tuple of Table
        key : tuple of KeyResult - the results that the command line shows first
        left_out : tuple of str - names of tables that were not computed
    """

    kind: str
    name: str
    command: str
    quantities: tuple[Quantity, ...] = ()
    checks: tuple[Check, ...] = ()
    tables: tuple[Table, ...] = field(default=())
    key: tuple[KeyResult, ...] = ()
    left_out: tuple[str, ...] = ()

    def __repr__(self) -> str:
        held = f"{amount(len(self.quantities), 'quantity', 'quantities')}, {amount(len(self.checks), 'check')}"
        tables = f", tables {', '.join(table.name for table in self.tables)}" if self.tables else ""
        return f"<report of {self.command}, {self.kind} {self.name!r}: {held}{tables}>"

    def _repr_html_(self) -> str:
        return report_as_html(self)

    @property
    def ok(self) -> bool:
        """False where a check fails."""
        return all(check.status != "fail" for check in self.checks)

    @property
    def counted(self) -> str:
        """What a verdict counts: with tolerances checks of the design as drawn, and of a yield that has a target."""
        if self.command != "tolerance":
            return "checks"
        if any(check.name == "target-yield" for check in self.checks):
            return "checks of the nominal design and of the yield"
        return "checks of the nominal design (no tolerance.target_yield)"


def _read_only(column: Column) -> Column:
    """A column as it is, an array as a view that cannot be written to."""
    if not hasattr(column, "flags") or not column.flags.writeable:
        return column
    view: NDArray[Any] = column.view()  # type: ignore[union-attr]  # what has flags is an array
    view.flags.writeable = False
    return view


def _plain(column: Column) -> Sequence[float | str | None]:
    """A column's numbers as Python's own, None where they do not exist."""
    items = _listed(column)
    try:
        if all(map(math.isfinite, items)):
            return items
    except (TypeError, ValueError, OverflowError):  # words, nothing at a place, integers beyond all floats
        pass
    return [None if isinstance(item, float) and not math.isfinite(item) else item for item in items]


def _listed(column: Any) -> Sequence[Any]:
    """A column, an array as a list in which a zero has no sign."""
    if not hasattr(column, "tolist"):
        return column  # type: ignore[no-any-return]
    return (column + 0.0 if column.dtype.kind == "f" else column).tolist()  # type: ignore[no-any-return]


def remedy_words(remedy: Remedy) -> str:
    """A remedy in words.

    Example
        >>> remedy_words((("gears.crank", 42), ("gears.output", 42), ("sync.end", None)))
        'set gears.crank to 42 and gears.output to 42 and remove sync.end'
    """
    sets = [f"{key} to {_shown(value)}" for key, value in remedy if value is not None]
    verbs = [f"set {' and '.join(sets)}"] if sets else []
    return " and ".join((*verbs, *(f"remove {key}" for key, value in remedy if value is None)))


def fix_words(remedy: Remedy, *, relaxes: bool) -> str:
    """A remedy as a fix, which says where it asks less of the machine."""
    return remedy_words(remedy) + (" (relaxes the requirement)" if relaxes else "")


def _shown(value: float | str | tuple[float, ...]) -> str:
    if isinstance(value, tuple):
        return f"[{', '.join(map(_shown, value))}]"
    return value if isinstance(value, str) else f"{value:.12g}"


def without_noise(value: float, scale: float) -> float:
    """The value, or 0 where it is below the rounding error of what has the size `scale`.

    A closed form in double precision is off by a few ulp of its largest term; 8 ulp are taken, twice the most that
    the residuals of the examples show.

    Example
        >>> without_noise(-4.46e-13, 2970.0), without_noise(-4.46e-10, 2970.0)
        (0.0, -4.46e-10)
    """
    return value if abs(value) > 8.0 * math.ulp(scale) else 0.0


def safely_below(value: float, digits: int = DIGITS) -> str:
    """A recommended upper bound, rounded down to so many digits: applied as printed, it holds.

    Example
        >>> safely_below(16.41765), safely_below(0.000123456, 3)
        ('16.41', '0.000123')
    """
    return plain(directed(value, -1, digits))


def safely_above(value: float, digits: int = DIGITS) -> str:
    """A recommended lower bound, rounded up to so many digits: applied as printed, it holds.

    Example
        >>> safely_above(2.52430607), safely_above(3.0)
        ('2.525', '3')
    """
    return plain(directed(value, 1, digits))


_ENDS = 10
"""Rows shown at either end of a long table."""


def report_as_html(report: Report) -> str:
    """Quantities, then checks, then tables of a report."""
    parts = [f"<h4>{_escaped(report.name)}: {_escaped(report.command)}</h4>"]
    if report.quantities:
        rows = ((q.name, q.symbol, q.value, "" if q.unit == "1" else q.unit) for q in report.quantities)
        parts.append(_grid(("quantity", "symbol", "value", "unit"), rows))
    if report.checks:
        parts.append(
            _grid(
                ("status", "check", "finding"),
                ((c.status, f"{c.code} {c.name}", "\n".join(c.lines)) for c in report.checks),
            )
        )
    return "\n".join(chain(parts, map(table_as_html, report.tables)))


def table_as_html(table: Table) -> str:
    """The first and last rows of a table; all of them where they are few."""
    heads = [name if unit == "1" else f"{name} [{unit}]" for name, unit in zip(table.columns, table.units, strict=True)]
    rows: Iterable[Sequence[Any]] = table.each_row()
    if table.length > 2 * _ENDS:
        last = replace(table, data=tuple(column[-_ENDS:] for column in table.data))
        rows = chain(islice(rows, _ENDS), [["…"] * len(heads)], last.each_row())
    return f"<p>{_escaped(table.name)}, {amount(table.length, 'row')}</p>\n" + _grid(heads, rows)


def _grid(heads: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    lines = (f"<tr>{''.join(f'<td>{_cell(cell)}</td>' for cell in row)}</tr>" for row in rows)
    head = "".join(f"<th>{_escaped(name)}</th>" for name in heads)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{''.join(lines)}</tbody></table>"


def _cell(value: Any) -> str:
    if isinstance(value, (list, tuple)):
        return ", ".join(map(_cell, value))
    if isinstance(value, float):
        return f"{value:.9g}"
    return "" if value is None else _escaped(str(value)).replace("\n", "<br>")


def _escaped(text: str) -> str:
    from html import escape

    return escape(text)
