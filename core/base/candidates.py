"""Designs for the same task side by side: one file with some keys changed, row by row, and what each gives.

A kind that finds something for its file names the keys and values that are tried (`Sought`), and the quantities that
a designer compares; `table` computes each as a design of its own. A mechanism that does not exist says why in its row.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from copy import copy
from dataclasses import dataclass, field
from itertools import product
from typing import TYPE_CHECKING, Any

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.remedies.ways import MODULES
from gearlink.core.base.report import Table
from gearlink.core.base.spec_paths import changed

if TYPE_CHECKING:
    from gearlink.core.base.design import Design

_SHARES = (0.8, 0.9, 1.0, 1.1, 1.25, 1.5)


@dataclass(frozen=True)
class Sought:
    """The keys that a table of candidates varies and the quantities that it shows.

    Parameters
        command : str - whose checks are the findings
        keys : mapping of a path of the file to the column and unit under which its value is shown, "" for none
        rows : the values of those keys, a tuple a row
        quantities : names of quantities, a column each
        label, labels : a first column that names the rows, where the keys' values are no words
        counted : further columns without unit, each a function of the row's design
    """

    command: str
    keys: dict[str, tuple[str, str]]
    rows: Sequence[tuple[Any, ...]]
    quantities: tuple[str, ...]
    label: str = ""
    labels: Sequence[str] = ()
    counted: dict[str, Callable[[Any], Any]] = field(default_factory=dict)


def table(design: Design, sought: Sought, spec: Any = None) -> Table:
    """The table `candidates` of a design, from its own spec or the spec it was derived from."""
    found = [_row(design, sought, values, spec or design.spec) for values in sought.rows]
    for row, label in zip(found, sought.labels, strict=False):
        row[sought.label] = label
    units = {sought.label: "1"} if sought.labels else {}
    units |= {name: unit for name, unit in sought.keys.values() if name}
    units["findings"] = "1"  # before the quantities: what does not pass is looked for first
    units |= dict.fromkeys(sought.counted, "1")
    units |= {name: design.unit_of(name) for name in sought.quantities}
    shown = {name: unit for name, unit in units.items() if any(row.get(name) is not None for row in found)}
    return Table.of("candidates", {name: ([row.get(name) for row in found], unit) for name, unit in shown.items()})


def _row(design: Design, sought: Sought, values: tuple[Any, ...], own: Any) -> dict[str, Any]:
    """One candidate; a mechanism that does not exist has its reason among the findings."""
    row = {name: value for (name, _), value in zip(sought.keys.values(), values, strict=True)}
    spec = changed(own, zip(sought.keys, values, strict=True))
    if spec is None:
        return row | {"findings": "refused"}
    try:
        # The file's own row is what has been found already: a search is not made twice.
        trial = copy(design) if own is design.spec and spec == own else type(design)(spec)
        trial.advises = False
        counts = {name: count(trial) for name, count in sought.counted.items()}
        quantities = {name: _number(trial, name) for name in sought.quantities}
        return row | counts | quantities | {"findings": findings(trial, sought.command)}
    except NoSolution as refused:
        return row | {"findings": f"{refused.code} {refused.key}".rstrip()}


def _number(trial: Design, name: str) -> Any:
    """The value of a quantity; of a pair the one that both gears share, else the worse, which is the less."""
    quantity = trial.quantity(name)
    value = None if quantity is None else quantity.value
    if not isinstance(value, list):
        return value
    return min((each for each in value if isinstance(each, int | float)), default=None)


def findings(trial: Design, command: str) -> str:
    """The codes of the checks that do not pass, failures first; "pass" where all pass."""
    checks = [found for name in trial.outline(command).checks for found in trial.check(name)]
    named = (
        f"{check.status} {check.code}" for status in ("fail", "warn") for check in checks if check.status == status
    )
    return ", ".join(dict.fromkeys(named)) or "pass"


def modules(own: float) -> list[float]:
    """A module and the next of the series to either side.

    Example
        >>> modules(2.0), modules(2.3), modules(100.0)
        ([1.5, 2.0, 2.5], [2.0, 2.3, 2.5], [20.0, 100.0])
    """
    below = [module for module in MODULES if module < own]
    above = [module for module in MODULES if module > own]
    return [*below[-1:], own, *above[:1]]


def around(teeth: int) -> list[int]:
    """Numbers of teeth about a given one.

    Example
        >>> around(40)
        [32, 36, 40, 44, 50, 60]
    """
    return sorted({max(1, round(teeth * share)) for share in _SHARES})


def pairs(one: Iterable[Any], other: Iterable[Any]) -> list[tuple[Any, Any]]:
    """Every value of the one with every value of the other."""
    return list(product(one, other))


def nothing_sought(words: str) -> NoSolution:
    """The refusal of candidates for a file that determines everything."""
    return NoSolution(f"the file determines everything, so there are no candidates: {words}", key="kind")
