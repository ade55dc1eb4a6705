"""What a study seeks: objectives with their resolution, conditions on quantities, and entries of lists in both."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from gearlink.core.base.nomenclature import term
from gearlink.core.numerics.arrays import Mask
from gearlink.core.studies.study.expressions import Expression, NotAnExpression, parse, with_definitions
from gearlink.core.studies.study.faults import Fault, Place

_AMOUNT = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(\S.*)?")
_CONDITION = re.compile(r"(.*?)(>=|<=|==|<|>)(.*)", re.DOTALL)
_SHOWN = 80
_WORD = re.compile(r"[A-Za-z][\w-]*")
_LEAST_RESOLUTION = 1e-12
"""Below it the millionths of a resolution, in which objectives are counted, pass the range of numbers."""
COMPARED: dict[str, Callable[[Any, Any], Any]] = {
    ">=": np.greater_equal,
    "<=": np.less_equal,
    "==": np.equal,
    ">": np.greater,
    "<": np.less,
}
_TURNED = {">=": "<=", "<=": ">=", "==": "==", ">": "<", "<": ">"}


@dataclass(frozen=True)
class Objective:
    """A quantity to be made small or large.

    Parameters
        name : str - of a quantity or of a defined one
        sign : float - 1 to be minimised, -1 to be maximised
        resolution : float - a difference that is worth nothing, in `unit`
    """

    name: str
    expression: Expression
    sign: float
    resolution: float
    unit: str


@dataclass(frozen=True)
class Condition:
    """A condition that a design must meet.

    Parameters
        text : str - as the file has it
        expression : Expression - what is compared
        sign : str - one of `COMPARED`
        limit : float or str - a number, or a word
    """

    text: str
    expression: Expression
    sign: str
    limit: float | str
    unit: str

    def holds(self, value: Any) -> Mask:
        """Where it holds; nowhere where the quantity does not apply."""
        with np.errstate(invalid="ignore"):
            held: Mask = np.asarray(COMPARED[self.sign](value, self.limit), dtype=bool)
        return held


@dataclass(frozen=True)
class Names:
    """The names that expressions may have: quantities with their units, and what the study defines.

    Parameters
        unit_of : function - the unit of a quantity without index
        known : names of the quantities
        defined : expressions by name
        nearest : function - the nearest known names of one, in words
        wrong : names that the study defines wrongly, which is a fault of their own
        later : names that it defines below
    """

    unit_of: Callable[[str], str]
    known: frozenset[str]
    defined: Mapping[str, Expression]
    nearest: Callable[[str, Any], str]
    wrong: frozenset[str] = frozenset()
    later: frozenset[str] = frozenset()

    def expression(self, text: str, place: Place) -> Expression:
        """An expression of quantities alone, what is defined put in.

        Raises
            FaultFound
        """
        try:
            found = parse(text)
            for name in found.names:
                self._require(name, place)
            return with_definitions(found, self.defined)
        except NotAnExpression as error:
            raise FaultFound(Fault("GL152", f"{_short(text)!r} cannot be read: {error}", place)) from None

    def _require(self, name: str, place: Place) -> None:
        """Refuse a name that neither the kind nor the study knows."""
        if name in self.wrong:
            raise FaultFound(None)
        if name in self.defined or name.partition("[")[0] in self.known:
            return
        helps = self.nearest(name, [*self.defined, *self.known])
        if name in self.later:
            helps = f"define {name} before it is used; no definition may depend on itself"
        raise FaultFound(Fault("GL152", f"no quantity {name!r} of this kind of design", place, helps))

    def unit(self, expression: Expression) -> str | None:
        """The unit of an expression, None where any will do."""
        return expression.unit(lambda name: self.unit_of(name.partition("[")[0]))


class FaultFound(Exception):
    """One fault, where reading cannot go on without what is wrong; None where it is noted already."""

    def __init__(self, fault: Fault | None) -> None:
        super().__init__("" if fault is None else fault.message)
        self.faults = [] if fault is None else [fault]


def _short(text: str) -> str:
    """The beginning of a text that fills a line."""
    text = text.strip()
    return text if len(text) <= _SHOWN else f"{text[: _SHOWN - 3]}..."


def objective(name: str, given: float | str, sign: float, names: Names, place: Place) -> Objective:
    """An objective of the file.

    Raises
        FaultFound - GL152 for its name, GL153 for the unit, GL154 for the resolution
    """
    expression = names.expression(name, place)
    amount = _AMOUNT.fullmatch(given) if isinstance(given, str) else None
    size = float(given) if isinstance(given, (int, float)) else float(amount[1]) if amount else 0.0
    if not _LEAST_RESOLUTION <= size < np.inf:
        least = "above 0" if size <= 0.0 or size == np.inf else f"of {_LEAST_RESOLUTION:g} at least"
        message = f"{name} needs a resolution {least}, not {given!r}: the largest difference that does not matter"
        raise FaultFound(Fault("GL154", message, place, "such as 10 mm"))
    unit = _same_unit(name, expression, (amount[2] or "").strip() if amount else "", names, place)
    return Objective(name, expression, sign, size, unit)


def condition(text: str, names: Names, place: Place) -> Condition:
    """A condition of the file.

    Raises
        FaultFound - GL152, GL153
    """
    parts = _CONDITION.fullmatch(text)
    if parts is None:
        helps = "such as min_transmission_angle >= 45 deg"
        raise FaultFound(
            Fault("GL152", f"{_short(text)!r} is not a comparison: it has none of >=, <=, ==, <, >", place, helps)
        )
    left, sign, right = (part.strip() for part in parts.groups())
    if any(mark in right for mark in COMPARED):
        helps = "write two lines, each with the quantity on its left"
        raise FaultFound(Fault("GL152", f"{_short(text)!r} compares twice", place, helps))
    if _AMOUNT.fullmatch(left) and not _AMOUNT.fullmatch(right):
        helps = f"write {right} {_TURNED[sign]} {left}"
        raise FaultFound(Fault("GL152", f"{_short(left)!r} is a number: write the quantity on the left", place, helps))
    expression = names.expression(left, place)
    amount = _AMOUNT.fullmatch(right)
    if amount is not None:
        limit = float(amount[1])
        if not np.isfinite(limit):
            raise FaultFound(Fault("GL152", f"{amount[1]} is too large for a number", place))
        return Condition(text, expression, sign, limit, _same_unit(left, expression, amount[2] or "", names, place))
    if sign != "==" or not _WORD.fullmatch(right):
        message = f"{_short(right)!r} is no number" + ("" if sign == "==" else ": words are compared by == alone")
        raise FaultFound(Fault("GL152", message, place, "such as frame_length <= 220 mm, or motion == back-step"))
    return Condition(text, expression, sign, right, "1")


def _same_unit(name: str, expression: Expression, given: str, names: Names, place: Place) -> str:
    own, given = names.unit(expression), given.strip()
    if own is not None and given not in ("", own):
        shown = "a pure number" if own == "1" else f"in {own}"
        raise FaultFound(Fault("GL153", f"{name} is {shown}, not in {given}", place, f"give it in {own}"))
    return own or given or "1"


def contradiction(conditions: list[Condition]) -> tuple[int, int] | None:
    """The places of two conditions on one quantity that no value meets; None where there are none."""
    for j, one in enumerate(conditions):
        for i, other in enumerate(conditions[:j]):
            if one.expression.tree == other.expression.tree and _exclude(one, other):
                return i, j
    return None


def _exclude(one: Condition, other: Condition) -> bool:
    if isinstance(one.limit, str) or isinstance(other.limit, str):
        return one.limit != other.limit
    limits = [(requirement.sign, float(requirement.limit)) for requirement in (one, other)]
    low = max((limit for sign, limit in limits if sign in (">=", ">", "==")), default=-np.inf)
    high = min((limit for sign, limit in limits if sign in ("<=", "<", "==")), default=np.inf)
    open_end = any(sign in ("<", ">") for sign, _ in limits)
    return bool(low > high or (low == high and open_end))


OF_ANY_LENGTH = {"dwell_crank_angles", "extreme_crank_angles", "start_directions", "mobility_changes", "flips"}
"""Quantities whose lists are longer on some designs of a study than on others."""
_GEARS = re.compile(r"mesh_(\w)(\w)")
_NAMED = re.compile(r"\(a list: (\w+), (\w+)")


def whose(name: str, count: int, kind: str) -> list[str]:
    """What the entries of a quantity's list belong to, in words; empty where nothing says so.

    Parameters
        name : str - of the quantity, with its mesh
        count : int - how many entries it has
        kind : str - of the design
    Example
        >>> whose("crank_idler.tip_radius", 2, "three-gear-four-bar"), whose("max_radius", 2, "swing-gripper")
        (['crank', 'idler'], ['main', 'return'])
    """
    mesh, _, plain = name.rpartition(".")
    gears = _GEARS.fullmatch(mesh)
    if gears:
        found = [f"gear {gear}" for gear in gears.groups()]
    elif mesh and not mesh.startswith(("mesh_", "pin_", "rack_")):
        found = mesh.split("_")
    elif not mesh and kind == "gear-pair":
        found = ["gear 1", "gear 2"]
    else:
        words = _NAMED.search(term(plain).words)
        found = list(words.groups()) if words else []
    return found if len(found) == count else []


def _listed(name: str, count: int, kind: str) -> str:
    """The entries that a list has, each with what it belongs to."""
    if not count:
        return "it is empty"
    words = whose(name, count, kind)
    if not words:
        return f"counted from 0, the last is {name}[{count - 1}]"
    return "counted from 0: " + ", ".join(f"[{i}] {word}" for i, word in enumerate(words))


def no_lists(names: Iterable[str], whole: dict[str, Any], place: Place) -> Iterator[Fault]:
    """Entries that are asked of numbers and words; `whole`: the quantities without index."""
    for name in names:
        plain, _, index = name.partition("[")
        if index and whole[plain] is not None and not isinstance(whole[plain], (list, tuple)):
            yield Fault("GL152", f"{plain} is not a list: it has no entry {index.rstrip(']')}", place, f"use {plain}")


def beyond_lists(names: Iterable[str], whole: dict[str, Any], place: Place, kind: str) -> Iterator[Fault]:
    """Entries that are asked of lists that do not have them; `whole`: those of the quantities that are judged."""
    for name in names:
        plain, _, index = name.partition("[")
        value = whole.get(plain)
        if index and isinstance(value, (list, tuple)) and int(index.rstrip("]")) >= len(value):
            message = f"{plain} is a list of {len(value)}: it has no {name}"
            yield Fault("GL152", message, place, _listed(plain, len(value), kind))


def odd_comparisons(
    requirement: Objective | Condition, names: Iterable[str], values: dict[str, Any], place: Place, kind: str
) -> Iterator[Fault]:
    """What is wrong with some quantities of a requirement, by their values in the base."""
    expression = requirement.expression
    words = isinstance(requirement, Condition) and isinstance(requirement.limit, str)
    for name in names:
        value = values[name]
        if isinstance(value, (list, tuple)):
            entries = _listed(name, len(value), kind) if whose(name, len(value), kind) else ""
            helps = f"use one of them, {name}[0]{f'; {entries}' if entries else ''}"
            yield Fault("GL152", f"{name} is a list of {len(value)}", place, helps)
        elif isinstance(value, str) and not words:
            yield Fault("GL152", f"{name} is a word ({value}), not a number", place, f"where: {name} == {value}")
        elif value is not None and not isinstance(value, str) and words:
            yield Fault("GL152", f"{name} is a number, not a word", place)
        elif (
            isinstance(requirement, Condition)
            and requirement.sign == "=="
            and isinstance(value, float)
            and name == expression.text
        ):
            message = f"{name} is a real number, which cannot be compared by =="
            yield Fault("GL152", message, place, "compare it by >= and <=")
