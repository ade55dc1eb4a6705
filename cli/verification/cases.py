"""The published cases as data: a file for each source, whose name every case of it begins with.

A file has `source` (author, title, edition), `read_at` where the text was read, `cases`, and `differs`: cases whose
numbers are known not to be met, with the reason, which are shown on the page "Validation" and nowhere else. A case has

* `id`, `place` (example, table or page of the source) and, for both, `note`;
* what is computed: `command` and `design`, the keys of a design file, or `kernel` and `given`; `like` takes the keys of
  an earlier case of the file, or of an example (`ty460.yaml`), over which those of `design` are put;
* `numbers`, each with its `name`, `published` as it is printed, in quotation marks so that no digit is lost, and where
  the program has it: `quantity`, or `table`, `column` and `where: {column: value}`; `scale` is what the program's value
  is multiplied by. A list of published numbers is a list of the quantity: of its gears, or of two limits each.

A number is met where the difference is at most half a unit of its last printed digit. Another `limit`, of a number or
of a case, needs its reason, `because`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from decimal import Decimal
from pathlib import Path
from typing import Any, NamedTuple

FOLDER = Path(__file__).parent / "sources"


class Number(NamedTuple):
    """One published number, and where the program has it.

    Fields
        name : str - as the source calls it
        published : str - as it is printed
        limit : float - maximum difference that is met
        because : str - reason of a limit that is not half a unit of the last printed digit
        quantity : str - name of a quantity; of a kernel, name of a result
        places : place in the quantity's list, and within that; `index` in the data
        table, column, where : the row and column of a table instead
        scale : float - the program's value times this is compared
        unit : str - empty: that of the program
    """

    name: str
    published: str
    limit: float
    because: str = ""
    quantity: str = ""
    places: tuple[int, ...] = ()
    table: str = ""
    column: str = ""
    where: Mapping[str, float | str] = {}
    scale: float = 1.0
    unit: str = ""

    @property
    def value(self) -> float:
        """The published value."""
        return float(self.published)


class Case(NamedTuple):
    """What a source computes once: an example, a line of a table, a report.

    Fields
        source, place : where it is published
        command, design : what the program computes, the keys of a design file
        kernel, given : the same for what no design file asks for
        samples : rows of its tables
        why : str - of a case that is known not to be met
    """

    id: str
    source: str
    place: str
    numbers: tuple[Number, ...]
    command: str = ""
    design: Mapping[str, Any] = {}
    kernel: str = ""
    given: Mapping[str, Any] = {}
    samples: int | None = None
    note: str = ""
    why: str = ""


class Source(NamedTuple):
    """The cases of one source."""

    name: str
    source: str
    read_at: str
    cases: tuple[Case, ...]
    differs: tuple[Case, ...]


def names() -> list[str]:
    """The sources, as cases begin: "khurmi"."""
    return sorted(path.stem for path in FOLDER.glob("*.yaml"))


def sources(prefixes: Sequence[str] = ()) -> Iterator[Source]:
    """The sources with the cases that begin with one of some prefixes; without a prefix all.

    Example
        >>> [case.id for source in sources(["khurmi-12.7"]) for case in source.cases]
        ['khurmi-12.7-internal']
    """
    wanted = tuple(prefix.lower() for prefix in prefixes)
    for name in names():
        if not wanted or any(name.startswith(each) or each.startswith(name) for each in wanted):
            found = read(name)
            cases = tuple(case for case in found.cases if not wanted or case.id.startswith(wanted))
            if cases or (not wanted and found.differs):
                yield found._replace(cases=cases)


def read(name: str) -> Source:
    """The cases of one source.

    Parameters
        name : one of `names`
    Raises
        DesignFileError, TypeError, KeyError - where the file is not as it must be
    """
    from gearlink.cli.reading.yaml_reader import read as read_yaml

    data = read_yaml((FOLDER / f"{name}.yaml").read_bytes(), f"{name}.yaml").data
    made: dict[str, Case] = {}
    for part in ("cases", "differs"):
        for raw in data.get(part, ()):
            case = _case(raw, data["source"], made)
            made[case.id] = case
    differing = {raw["id"] for raw in data.get("differs", ())}
    return Source(
        name,
        data["source"],
        data.get("read_at", ""),
        tuple(case for case in made.values() if case.id not in differing),
        tuple(case for case in made.values() if case.id in differing),
    )


def _case(raw: dict[str, Any], source: str, made: Mapping[str, Case]) -> Case:
    raw = dict(raw)
    base = _base(raw.pop("like", ""), made)
    shared = {key: raw.pop(key) for key in ("limit", "because") if key in raw}
    numbers = tuple(each for row in raw.pop("numbers") for each in _numbers(shared | row))
    design = {key: value for key, value in {**base, **raw.pop("design", {})}.items() if value is not None}
    return Case(source=source, place=raw.pop("place", ""), design=design, numbers=numbers, **raw)


def _base(like: str, made: Mapping[str, Case]) -> Mapping[str, Any]:
    """The design that another is like: of an earlier case, or a worked one."""
    if not like.endswith(".yaml"):
        return made[like].design if like else {}
    from gearlink import designs
    from gearlink.cli.reading.yaml_reader import read as read_yaml

    path = Path(str(designs.__file__)).with_name(like)
    found: dict[str, Any] = read_yaml(path.read_bytes(), like).data
    return found


def _numbers(row: Mapping[str, Any], places: tuple[int, ...] = ()) -> Iterator[Number]:
    """The numbers of a row of data; those of a list carry their places, counted from 1, behind the name."""
    published = row["published"]
    if isinstance(published, list):
        for place, each in enumerate(published):
            yield from _numbers({**row, "published": each}, (*places, place))
        return
    fields = {key: value for key, value in row.items() if key != "index"}
    if places:
        fields["name"] = f"{row['name']} ({', '.join(str(place + 1) for place in places)})"
    elif "index" in row:
        places = (row["index"],)
    fields |= {"limit": float(row.get("limit", half_unit(published))), "scale": float(row.get("scale", 1.0))}
    yield Number(**fields, places=places)


def half_unit(published: str) -> float:
    """Half a unit of the last digit that is printed.

    Example
        >>> half_unit("22.856"), half_unit("13"), half_unit("-2.0385e9")
        (0.0005, 0.5, 50000.0)
    """
    return float(Decimal(5).scaleb(decimals(published) - 1))


def decimals(published: str) -> int:
    """The power of ten of the last printed digit: -3 of 22.856."""
    exponent = Decimal(published).as_tuple().exponent
    if isinstance(exponent, str):
        raise ValueError(f"{published} is not a number")
    return exponent
