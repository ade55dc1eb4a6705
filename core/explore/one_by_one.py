"""Designs computed each by its own class: the form that every kind has, and the judge of the array form."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from gearlink.core.design_axis import Evaluated, Findings
from gearlink.core.errors import NoSolution
from gearlink.core.explore.base import Base, Changes, Refused
from gearlink.core.report import Check


@dataclass(frozen=True)
class Single:
    """One design: quantities by name in the units of design files, findings, and the key it is refused for, if it is.

    `what` says why it is refused.
    """

    values: dict[str, Any]
    findings: tuple[Check, ...] = ()
    refused: str = ""
    what: str = ""


def single(base: Base, changes: Changes, names: Iterable[str], codes: Sequence[str]) -> Single:
    """Compute a design by its class.

    Parameters
        base : Base
        changes : paths and values that differ from it
        names : quantities that are wanted
        codes : of the checks that are wanted
    """
    try:
        design = base.design(changes)
        values = base.values(design, names)
        return Single(values, tuple(findings_of(base, design, codes)))
    except Refused as error:
        return Single({}, (), error.key or "kind", str(error))


def findings_of(base: Base, design: Any, codes: Sequence[str]) -> Iterable[Check]:
    """The findings of a design under some codes.

    Raises
        Refused - where a check finds that there is no mechanism
    """
    names = {name for code in codes for name in base.codes[code]}
    try:
        shown = dict.fromkeys(name for name in design.outline(base.command).checks if name in names)
        return [check for name in shown for check in design.check(name)]
    except NoSolution as error:
        raise Refused(error.key, error.message, error.code) from error


def as_arrays(singles: Sequence[Single], names: Sequence[str], codes: Sequence[str]) -> Evaluated:
    """Designs computed one by one in the form of many."""
    reasons = list(dict.fromkeys(one.refused for one in singles if one.refused))
    refused = np.array([reasons.index(one.refused) + 1 if one.refused else 0 for one in singles], dtype=np.intp)
    findings = [found for code in codes for found in _of_code(code, singles)]
    return Evaluated(
        {name: column([one.values.get(name) for one in singles]) for name in names}, findings, refused, reasons
    )


def put_in(many: Evaluated, places: Any, few: Evaluated) -> Evaluated:
    """Designs with those at some places exchanged for others, computed in another way."""
    quantities = {}
    for name, values in many.quantities.items():
        new = few.quantities[name]
        quantities[name] = values.astype(new.dtype if new.dtype.kind == "U" else values.dtype)
        quantities[name][places] = new
    reasons = list(dict.fromkeys([*many.reasons, *few.reasons]))
    refused = np.array(many.refused)
    refused[places] = [reasons.index(few.reasons[i - 1]) + 1 if i else 0 for i in few.refused]
    kept = np.ones(len(refused), dtype=bool)
    kept[places] = False
    findings = [replace(each, fails=each.fails & kept, warns=each.warns & kept) for each in many.findings]
    findings += [_widened(each, places, len(refused)) for each in few.findings]
    return Evaluated(quantities, findings, refused, reasons)


def _widened(each: Findings, places: Any, count: int) -> Findings:
    """A finding of some designs as one of all; the others have none."""
    value, limit = np.full(count, np.nan), np.full(count, np.nan)
    fails, warns = np.zeros(count, dtype=bool), np.zeros(count, dtype=bool)
    value[places], limit[places], fails[places], warns[places] = each.value, each.limit, each.fails, each.warns
    return Findings(each.code, value, limit, fails, warns, each.unit)


def column(values: Sequence[Any]) -> Any:
    """Values of a quantity as an array: NaN or "" where one is missing; lists, which no array holds, are missing."""
    if any(isinstance(value, str) for value in values):
        return np.array([value if isinstance(value, str) else "" for value in values])
    numbers = [value if isinstance(value, (int, float)) else np.nan for value in values]
    return np.array(numbers, dtype=float)


def _of_code(code: str, singles: Sequence[Single]) -> Iterable[Findings]:
    """The findings of a code: as many as the design with the most of them has."""
    lists = [[check for check in one.findings if check.code == code] for one in singles]
    for i in range(max(map(len, lists), default=0)):
        row = [found[i] if i < len(found) else None for found in lists]
        yield Findings(
            code,
            column([check and check.value for check in row]),
            column([check and check.limit for check in row]),
            np.array([check is not None and check.status == "fail" for check in row]),
            np.array([check is not None and check.status == "warn" for check in row]),
            next((check.unit for check in row if check is not None), "1"),
        )
