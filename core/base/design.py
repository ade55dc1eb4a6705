"""The base class of all designs: results by name, each computed on request and only once.

A design's results are `cached_property`s that depend on each other, in mm and radians; their names are those of
`gearlink.core.base.nomenclature`. Requesting a result computes only what it depends on. A design has no other state,
so there is no order in which results must be requested.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cache
from itertools import count
from operator import index
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple, Protocol, TypeVar

from gearlink.core.base.errors import GearlinkError, named
from gearlink.core.base.key_results import Key, key_results
from gearlink.core.base.nomenclature import TERMS, fixed_name, term
from gearlink.core.base.remedies.trials import Bench, commands_of, with_remedies
from gearlink.core.base.remedies.ways import Way
from gearlink.core.base.report import Check, Quantity, Remedy, Report, Table, TableInParts
from gearlink.core.base.results import cached_property, step
from gearlink.core.base.rows import FEWEST_ROWS, MOST_ROWS, Rows

if TYPE_CHECKING:
    from gearlink.core.mechanism.motion import Motion

_PART_SIZES = (65_521, 65_537)


class Outline(NamedTuple):
    """What a command shows of a design: names of quantities, checks and tables."""

    quantities: tuple[str, ...] = ()
    checks: tuple[str, ...] = ()
    tables: tuple[str, ...] = ()


class Found(NamedTuple):
    """What a design adds to its file so that it is complete: a key by its path, its value, and where that is from.

    A value is in the units of design files; a dict is a section, None leaves a key out that is answered.
    """

    path: str
    value: Any
    why: str = ""


Made = TypeVar("Made", bound="Design")


class Kin(Protocol):
    """The designs of one file, one for each of its commands.

    `remedies` are those that were found for commands which refuse the design: the others try them first.
    """

    remedies: list[Remedy]

    def of(self, command: str) -> Design:
        """The design for a command; the same object each time while it is in use."""

    def of_class(self, cls: type[Made], spec: Any) -> Made:
        """The design of a class, the same one each time while it is in use; another one for another spec."""

    def changed(self, spec: Any) -> Kin:
        """The designs of another file of the kind."""


def placed(path: str) -> Any:
    """A quantity whose value is an attribute of another object of the design.

    Parameters
        path : str - from the design on, "slider_crank.crank_length", "fastest.0.speed"; "cams.*.max_radius" is a list
            of those of each; None on the way makes the quantity, or that of one, None
    Returns
        quantity : property, to be annotated with the type of the value
    """
    whole, _, of_each = path.partition(".*.")
    way, more = (_way(each) for each in (whole, of_each))

    def value(design: Any) -> Any:
        found = _at(design, way)
        return [_at(each, more) for each in found] if of_each and found is not None else found

    found = _Placed(value)
    found.path = path
    return found


class _Placed(property):
    """A property that `help` describes in the words of its quantity."""

    path: str

    def __set_name__(self, owner: type, name: str) -> None:
        place = f"Stands at `{self.path}`."
        words = term(name, getattr(owner, "kind", "")).words if name in TERMS else ""
        self.__doc__ = f"{words[:1].upper()}{words[1:]}. {place}" if words else place


def _way(path: str) -> tuple[str | int, ...]:
    return tuple(int(name) if name.isdecimal() else name for name in path.split("."))


def _at(found: Any, way: Sequence[str | int]) -> Any:
    for place in way:
        if found is None:
            return None
        found = getattr(found, place) if isinstance(place, str) else found[place]
    return found


_LISTED = 12
_DOOR = ("check", "kind", "quantity", "quantity_names", "report", "spec", "table", "table_names", "warnings")


class UnknownName(GearlinkError):
    """A quantity, table or command was asked for that this design does not have."""

    def __init__(self, what: str, name: str, known: Sequence[str], kind: str = "") -> None:
        shown = f"named {named(name)}" if isinstance(name, str) else f"by {type(name).__name__}: names are text"
        super().__init__(f"this design has no {what} {shown}")
        self.what, self.name, self.known, self.kind = what, name, tuple(known), kind

    def __str__(self) -> str:
        where = "`quantity_names()` lists"
        if self.what == "command" and self._is_elsewhere:
            return f"{self.args[0]}; give `load`, or `design`, command={self.name!r}"
        return f"{self.args[0]}; {self._names(where)}" if isinstance(self.name, str) else str(self.args[0])

    @property
    def _is_elsewhere(self) -> bool:
        """Whether another class of the kind has the command."""
        from gearlink.core.base.kinds import KINDS

        return isinstance(self.name, str) and self.kind in KINDS and self.name in KINDS[self.kind].commands

    @property
    def remedy(self) -> str:
        """The nearest names; where none is near, those that there are, for the command line."""
        return self._names("--all shows")

    def _names(self, where: str) -> str:
        from gearlink.core.base.nearest import near_quantities

        if near := near_quantities(self.name, self.known):
            return f"nearest: {', '.join(near)}"
        plain = [name for name in self.known if "." not in name]  # those of each mesh are many, and the same again
        shown = _LISTED if self.what == "quantity" else len(plain)
        more = f", and {len(plain) - shown} more, which {where}" if len(plain) > shown else ""
        meshes = ", and those of a mesh as MESH.NAME" if plain != [*self.known] else ""
        return f"known: {', '.join(plain[:shown])}{more}{meshes}"


class Design:
    """Base of the design classes.

    `outlines` says what each command shows, `extra_tables` what can be added, `ways` how a file may be changed where
    a check fails. A design that `advises` says in the words of a failing check what would help; one that does not judge
    `warnings` leaves out findings that can only warn. Where `checks_need_search` a design is the result of a search:
    where files alone are checked it is made ready, not searched.
    """

    kind: ClassVar[str]
    outlines: ClassVar[dict[str, Outline]]
    keys: ClassVar[Mapping[str, tuple[Key, ...]]] = {}
    """Key results of its own commands, in the form of `core.base.key_results`, which has those that all kinds share."""
    titles: Mapping[str, str] = {}
    """What it calls key results otherwise than other designs do."""
    key_tables: ClassVar[tuple[str, ...]] = ()  # tables that stand beside them
    extra_tables: ClassVar[tuple[str, ...]] = ()
    page_tables: ClassVar[tuple[str, ...]] = ()  # extra ones that the page of `report` shows
    beside_tables: ClassVar[Mapping[str, Outline]] = {}
    """Quantities and checks that an extra table brings along, which are dear without it."""
    ways: ClassVar[Mapping[str, tuple[Way, ...]]] = {}
    requirements: ClassVar[frozenset[str]] = frozenset(
        ("speed", "input_speed", "loads.speed", "target", "dwell.angle", "dwell.window", "dwell.tolerance", "back_step")
    )
    """Keys of what the machine has to do: a fix that changes one asks for less, and is sought last."""
    repaired_where_they_warn: ClassVar[frozenset[str]] = frozenset()
    """Checks whose remedy is computed, and so is named where they only warn as well; trials wait for what fails."""
    derived: ClassVar[frozenset[str]] = frozenset()  # quantities with a value or None wherever there is a mechanism
    advises = True
    kin: Kin | None = None  # the designs of its file's other commands; None where it was made by itself
    warnings = True
    checks_need_search: ClassVar[bool] = False
    repairable: ClassVar[bool] = True
    """Whether changes of the file are tried where it is refused; not where each would be a study of its own."""

    def __init__(self, spec: Any) -> None:
        self.spec = spec

    @property
    def cost(self) -> float:
        """What judging the design takes, as far as that is known, that of most being 1 (0.7 ms): by what there is to
        compute, not by a clock. As many changes are tried for a finding as take a tenth of a second or so."""
        return 1.0

    def of_file(self, cls: type[Made], /) -> Made:
        """The design of another class for the same spec: of a file's designs the one that its other commands have."""
        return cls(self.spec) if self.kin is None else self.kin.of_class(cls, self.spec)

    def of_command(self, command: str) -> Design:
        """The design that serves another command of the same file."""
        from gearlink.core.base.kinds import KINDS

        return KINDS[self.kind].design(command, self.spec) if self.kin is None else self.kin.of(command)

    @cached_property
    def moving(self) -> Motion:
        """The links and joints over the input; only for kinds that move."""
        from gearlink.core.base.kinds import KINDS

        return KINDS[self.kind].motion_of(self)

    @property
    def traced(self) -> Sequence[str]:
        """Points of links whose paths count, by name."""
        return ()

    @property
    def output_columns(self) -> Mapping[str, tuple[str, ...]]:
        """Columns of the output over the cycle, by table: those of the kind."""
        from gearlink.core.base.kinds import KINDS

        return KINDS[self.kind].outputs

    def outline(self, command: str) -> Outline:
        """The outline of a command."""
        return self.outlines[command]

    @classmethod
    def judged(cls, command: str, _spec: Any, /) -> tuple[str, ...]:
        """Names of all checks that a command may judge of designs with the sections of a spec."""
        return cls.outlines[command].checks

    @classmethod
    def tables_of_page(cls, _command: str, _spec: Any, /) -> tuple[str, ...]:
        """The extra tables that the page of `report` shows of a command."""
        return cls.page_tables

    def tables_of_data(self, _command: str, /) -> tuple[str, ...]:
        """The extra tables of a command's result as JSON."""
        return ()

    @classmethod
    def quantity_names(cls) -> tuple[str, ...]:
        """Names of all quantities of the kind.

        Returns
            names : tuple of str - each once; those of docs/nomenclature.md
        """
        return _quantities_of(cls)  # type: ignore[arg-type]  # mypy takes a class for unhashable

    @classmethod
    def table_names(cls) -> tuple[str, ...]:
        """Names of all tables of the kind.

        Returns
            names : tuple of str - each once
        """
        return _tables_of(cls)  # type: ignore[arg-type]

    @classmethod
    def names_for(cls, _spec: Any, /) -> tuple[str, ...]:
        """Every quantity of the design of a spec, of a kind whose files name what they have."""
        return cls.quantity_names()

    @classmethod
    def unit_for(cls, _spec: Any, name: str, /) -> str:
        """The unit of a quantity of the design of a spec."""
        return term(name).unit

    def unit_of(self, name: str) -> str:
        """The unit of a quantity of this design."""
        return self.unit_for(self.spec, name)

    def raw(self, name: str) -> Any:
        """The value of a quantity in mm and radians.

        Parameters
            name : str - of `quantity_names`
        Returns
            value : float, int, str, bool, list or None - mm, rad, N, s; None where it does not apply to the design
        Raises
            NoSolution - where no mechanism exists
        """
        return object.__getattribute__(self, name)

    if not TYPE_CHECKING:  # types know the attributes that the classes name, and no others

        def __getattr__(self, name: str) -> Any:
            """A quantity that the class has no attribute for, that of a mesh: only `raw` knows its place."""
            if hasattr(type(self), name) or name not in self.quantity_names():
                return object.__getattribute__(self, name)  # raises what is missing
            return self.raw(name)

    def __repr__(self) -> str:
        return f"<{self.kind} {self.spec.name!r}>"

    def __dir__(self) -> list[str]:
        """What is documented of all designs, and every quantity: what a notebook completes."""
        return sorted({*_DOOR, *self.quantity_names()})

    def quantity(self, name: str) -> Quantity | None:
        """A quantity in the units of the design files.

        Parameters
            name : str - of `quantity_names`, or a standard term that `explain` lists for it
        Returns
            quantity : Quantity or None - name, value, unit ("mm", "deg", "1"), symbol and words; None where it does
                not apply to this design
        Raises
            UnknownName - for a name that the kind does not have
            NoSolution - where no mechanism exists
        """
        name = fixed_name(name, self.quantity_names())
        if name not in self.quantity_names():
            raise UnknownName("quantity", name, self.quantity_names())
        value = _bounded(self.raw(name))
        if value is None:
            return None
        entry, unit = term(name, self.kind), self.unit_of(name)
        return Quantity(name, in_unit(value, unit), unit, entry.symbol, entry.words)

    def needs(self, _name: str, /) -> str:
        """In words, what the file must give for a quantity that is None; empty where nothing is missing."""
        return ""

    def rests_on(self, _name: str, /) -> str:
        """In words, the assumed inputs of a quantity that a reader could mistake for computed ones; empty where there
        are none."""
        return ""

    def table(self, name: str, *, samples: int | None = None) -> Table:
        """A table by name, in the units of the design files.

        Parameters
            samples : int - rows per revolution or stroke, 2 to ten million; without it the table's own number of rows
        Raises
            UnknownName
            GearlinkError - for a number of rows that no table has
        """
        if name not in self.table_names():
            raise UnknownName("table", name, self.table_names())
        self.require_table(name)
        rows = None if samples is None else _rows(samples)
        with step(f"{type(self).__name__}.table_{name}"):
            table: Table = getattr(self, f"table_{name}")(rows)
        return table

    def _require_names(self, quantities: Sequence[str], tables: Sequence[str]) -> None:
        """Refuse a name that the design does not have before a search begins."""
        for what, names, known in (
            ("quantity", quantities, self.quantity_names()),
            ("table", tables, self.table_names()),
        ):
            if wrong := [name for name in names if name not in known]:
                raise UnknownName(what, wrong[0], known)
        for name in tables:
            self.require_table(name)

    def require_table(self, _name: str, /) -> None:
        """Refuse a table that needs a section which the file does not have, before anything is computed.

        Raises
            MissingSection
        """

    def table_in_parts(self, name: str, samples: int) -> Table:
        """A table by name that holds some ten thousand of its rows at a time, where they can be computed so."""
        # Two primes above the turns of any table: one leaves a last part neither full nor empty.
        size = next(prime for prime in _PART_SIZES if samples % prime)

        def part(first: int) -> tuple[Table, bool]:
            """So many rows from one on, and whether others follow: not in a table that is whole."""
            rows = Rows.part(samples, first, size)
            made = self.table(name, samples=rows)
            return made, rows.cut and made.length == size

        def parts() -> Iterator[Table]:
            for first in count(0, size):
                made, has_more = part(first)
                yield made
                if not has_more:
                    return

        made, has_more = part(0)
        return TableInParts(name, made.columns, made.units, made.data, parts) if has_more else made

    def check(self, name: str) -> list[Check]:
        """The findings of a check.

        Parameters
            name : str - such as "transmission-angle"
        Returns
            findings : list of Check - empty where the check does not apply to this design; without tested fixes,
                which `findings` adds
        Raises
            UnknownName - for a name that the kind does not have
            NoSolution - where no mechanism exists
        """
        method = "check_" + name.replace("-", "_") if isinstance(name, str) else ""
        if not hasattr(type(self), method):
            known = dict.fromkeys(each for outline in self.outlines.values() for each in outline.checks)
            raise UnknownName("check", name, tuple(known))
        with step(f"{type(self).__name__}.{method}"):
            found: Check | Iterable[Check] = getattr(self, method)()
            return [found] if isinstance(found, Check) else list(found)

    def completion(self) -> Iterable[Found]:
        """The keys that complete the file: the links that a synthesis found, in place of its task."""
        return ()

    def as_found(self) -> Iterable[Found]:
        """What completes the file for samples of the design as manufactured: its links, and what still judges them."""
        return self.completion()

    @property
    def given(self) -> Any:
        """The spec of the file, where the design goes on with one that it has completed."""
        return self.spec

    @cached_property
    def _benches(self) -> dict[frozenset[str], Bench]:
        return {}

    def bench(self, command: str) -> Bench:
        """The bench on which changes of this design are tested against the findings of a command and of the related
        commands."""
        commands = frozenset(commands_of(self, command))
        if commands not in self._benches:
            self._benches[commands] = Bench(self, command)
        return self._benches[commands]

    at_once: ClassVar[int] = 16
    """Designs that are computed one after the other before anything is said of them."""

    alone: ClassVar[frozenset[str]] = frozenset()
    """Checks that judge nothing which is found for many designs together."""

    @classmethod
    def find_together(cls, _designs: Sequence[Any], _names: Sequence[str], /) -> None:
        """Let designs of this class keep what is found for all of them at once; of most kinds nothing is.

        Parameters
            designs : made, nothing of them asked for yet
            names : of quantities and checks that will be asked for
        """

    def varied(self, spec: Any) -> Design:
        """The design of another file, with the results of this one that the change leaves as they are."""
        return type(self)(spec)

    def findings(self, command: str, check: str) -> tuple[Check, ...]:
        """The findings of a check, with tested fixes.

        Parameters
            command : str - the command for which the design is checked, "synth dwell"
            check : str - name of the check
        Returns
            findings : tuple of Check - those that fail have a `remedy`, where one was found with which this and every
                other command of the file can be computed
        Raises
            NoSolution - where no mechanism exists
        """
        return with_remedies(self, command, tuple(self.check(check)))

    @property
    def has_ways(self) -> bool:
        """Whether its findings may be repaired by changes that are tried."""
        return self.repairable and (bool(self.ways) or type(self).ways_of is not Design.ways_of)

    def ways_of(self, check: str) -> Iterable[Way]:
        """The changes of the file that may repair a failing check."""
        return self.ways.get(check, ())

    def candidates(self, _check: str, /) -> Iterable[Remedy]:
        """Remedies of a check from closed forms; they are tried before the `ways`."""
        return ()

    def asks_less(self, keys: Iterable[str]) -> bool:
        """Whether a change relaxes the task: one of its keys, or the section of the key, specifies what the machine
        must do."""
        return any(head in self.requirements for key in keys for head in _heads(key))

    def require(self, command: str) -> None:
        """Compute the decisive quantities of a command: where no mechanism exists, one of them says so.

        Raises
            NoSolution
        """
        names = tuple(self.decisive(command))
        self._prepare_as_step(names)
        for name in names:
            self.raw(name)

    def require_named(self) -> None:
        """Refuse names in the sections of a command that the design does not have; nothing else is computed.

        Raises
            NoSolution, WrongStudy - at the name
        """

    def prepare(self, quantities: Iterable[str], /) -> None:
        """Compute what these quantities share, where that takes less than one after the other; refuse nothing.

        Names of checks may stand among them, for what they share with each other and with the quantities.
        """

    def _prepare_as_step(self, quantities: Iterable[str]) -> None:
        """Seek together what some quantities share, as a step of its own where the design has such."""
        if type(self).prepare is not Design.prepare:
            with step(f"{type(self).__name__}.prepare"):
                self.prepare(quantities)

    def decisive(self, command: str) -> Iterable[str]:
        """The quantities of a command that may say that no mechanism exists."""
        return (name for name in self.outline(command).quantities if name.rpartition(".")[2] not in self.derived)

    def report(
        self,
        command: str,
        *,
        quantities: Sequence[str] = (),
        tables: Sequence[str] = (),
        samples: int | None = None,
        only: bool = False,
        findings_only: bool = False,
        in_parts: bool = False,
        key_tables: bool = False,
    ) -> Report:
        """The report of a command.

        Parameters
            command : str - "synth dwell", "press", ...
            quantities : sequence of str - give these alone, without checks and tables of the command
            tables : sequence of str - tables in addition to those of the command
            samples : int - rows of the tables per revolution or stroke; without it each table's own number
            only : bool - give the named tables alone
            findings_only : bool - give the checks that do not pass alone; the command's quantities are computed all
                the same, since a mechanism that does not exist has none, its tables are not
            in_parts : bool - compute the rows of long tables while they are read
            key_tables : bool - of the command's tables give those alone that stand beside its key results
        Raises
            UnknownName - for a name that the design does not have
            NoSolution - where no mechanism exists
        """
        known = self.quantity_names()
        quantities, tables = [fixed_name(name, known) for name in _several(quantities)], _several(tables)
        self._require_names(quantities, tables)
        if not (quantities or only or (isinstance(command, str) and command in self.outlines)):
            raise UnknownName("command", command, tuple(self.outlines), self.kind)
        outline = Outline(tuple(quantities)) if quantities or only else self._with_tables(self.outline(command), tables)
        own = () if findings_only else outline.tables
        beside = self.key_tables if key_tables and own and outline.quantities else own
        asked = dict.fromkeys([*(name for name in own if name in beside), *tables])
        found: Iterable[Quantity | None] = ()
        if findings_only:
            self.require(command)
        else:
            self._prepare_as_step((*outline.quantities, *outline.checks))
            found = [self.quantity(name) for name in outline.quantities]
        shown = tuple(quantity for quantity in found if quantity is not None)
        checks = [check for name in outline.checks for check in self.findings(command, name)]
        return Report(
            kind=self.kind,
            name=self.spec.name,
            command=command,
            quantities=shown,
            checks=tuple(check for check in checks if check.status != "pass" or not findings_only),
            tables=tuple(
                self.table_in_parts(name, samples) if in_parts and samples else self.table(name, samples=samples)
                for name in asked
            ),
            key=() if quantities or only or findings_only else key_results(self, command, shown),
            left_out=tuple(name for name in own if name not in asked),
        )

    def _with_tables(self, outline: Outline, tables: Sequence[str]) -> Outline:
        """An outline with what the extra tables bring along."""
        for name in tables:
            if beside := self.beside_tables.get(name):
                outline = Outline(
                    outline.quantities + beside.quantities, outline.checks + beside.checks, outline.tables
                )
        return outline


def _several(names: Sequence[str]) -> Sequence[str]:
    """Names, of which a single one may stand alone."""
    return (names,) if isinstance(names, str) else names


def _bounded(value: Any) -> Any:
    """A value, None for an infinite one: a straight curve has no radius, and JSON no number for it. A zero has no sign.

    Example
        >>> _bounded(math.inf), _bounded([2.5, -0.0]), _bounded("inf")
        (None, [2.5, 0.0], 'inf')
    """
    if isinstance(value, (list, tuple)):
        return [_bounded(each) for each in value]
    if not isinstance(value, float):
        return value
    return None if math.isinf(value) else value + 0.0


def _heads(key: str) -> Iterator[str]:
    """A dotted path and the sections that it stands in.

    Example
        >>> list(_heads("motion[0].to"))
        ['motion', 'motion[0]', 'motion[0].to']
    """
    yield from (key[: found.start()] for found in re.finditer(r"[.\[]", key))
    yield key


def _rows(samples: Any) -> int:
    """A number of rows as Python's own, in which products do not overflow; what is none is refused."""
    try:
        rows = samples if isinstance(samples, int) else index(samples)
    except TypeError:
        rows = 0
    if FEWEST_ROWS <= rows <= MOST_ROWS:
        return rows
    shown = samples if isinstance(samples, (int, float)) else type(samples).__name__
    raise GearlinkError(f"samples is the number of rows, a whole one from {FEWEST_ROWS} to {MOST_ROWS}, not {shown}")


@cache
def _quantities_of(kind: type[Design]) -> tuple[str, ...]:
    outlines = (*kind.outlines.values(), *kind.beside_tables.values())
    return tuple(dict.fromkeys(name for outline in outlines for name in outline.quantities))


class NamesOfFile:
    """Names of quantities that follow the names of a file: of a class those that there may be, of a design its own."""

    def __get__(self, design: Any, cls: Any) -> Callable[[], tuple[str, ...]]:
        return (lambda: _quantities_of(cls)) if design is None else lambda: design.own_names


@cache
def _tables_of(kind: type[Design]) -> tuple[str, ...]:
    shown = [name for outline in kind.outlines.values() for name in outline.tables]
    return tuple(dict.fromkeys([*shown, *kind.extra_tables]))


def in_unit(value: Any, unit: str) -> Any:
    """A value in the unit of design files: radians to degrees where it is an angle; pairs and lists become lists."""
    if isinstance(value, (list, tuple)):
        return [in_unit(item, unit) for item in value]
    return math.degrees(value) if unit == "deg" and value is not None else value


def geometry(cls: type[Made]) -> cached_property[Made]:
    """A result that a class of loads or register keeps: the design of another class for the same file.

    Example
        >>> class Loads(Design):
        ...     design = geometry(Design)
        >>> type(Loads.design).__name__
        'cached_property'
    """
    return cached_property(lambda self: self.of_file(cls))
