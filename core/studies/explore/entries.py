"""Lists and their entries in the expressions of a study: which entry is whose, and what is no entry at all."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import Any

from gearlink.core.base.nomenclature import term
from gearlink.core.studies.explore.requirements import Condition, Objective
from gearlink.core.studies.study.faults import Fault, Place

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
            yield Fault("GL152", f"{plain} is no list: it has no entry {index.rstrip(']')}", place, f"take {plain}")


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
            helps = f"take one of them, {name}[0]{f'; {entries}' if entries else ''}"
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
            message = f"{name} is a real number, which equals nothing exactly"
            yield Fault("GL152", message, place, "compare it by >= and <=")
