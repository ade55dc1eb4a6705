"""Many designs at once: the interface of the array form of a kind, so that a study need not know the kind.

A kind that can compute many designs names, in `core.base.kinds`, the function that makes its `Axis` from a base
design; the axis returns the `Evaluated` designs for arrays of values of some keys. Names, units, codes, limits and
refusals must agree with those of the design class.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray

from gearlink.core.base.report import Check

if TYPE_CHECKING:
    from gearlink.core.numerics.arrays import Mask, Reals


@dataclass(frozen=True, slots=True)
class Findings:
    """One finding of a check on every design.

    Fields
        code : str - "GL301"
        value, limit : (N,) arrays - in the units of design files; NaN where there is none
        fails, warns : (N,) arrays
    """

    code: str
    value: Reals
    limit: Reals
    fails: Mask
    warns: Mask
    unit: str

    @classmethod
    def alike(cls, check: Check, count: int) -> Findings:
        """The finding of a check that all designs share."""
        value, limit = (np.full(count, each, dtype=float) for each in (check.value, check.limit))
        fails, warns = (np.full(count, check.status == status) for status in ("fail", "warn"))
        return cls(check.code, value, limit, fails, warns, check.unit)


@dataclass(frozen=True, slots=True)
class Evaluated:
    """Some designs.

    Fields
        quantities : arrays by name, those of lists with their index, in the units of design files; NaN (of words: "")
            where one does not apply
        findings : of the checks; a check that finds several things on a design gives several
        refused : (N,) array - 0 where the mechanism exists, else 1 + the place in `reasons`; what is refused has NaN
            in every quantity and fails no check
        reasons : keys of the design file that refusals belong to
        unsure : (N,) array - designs that this form leaves to the design class: next to a limit, or badly conditioned
    """

    quantities: Mapping[str, NDArray[Any]]
    findings: Sequence[Findings]
    refused: NDArray[np.intp]
    reasons: Sequence[str]
    unsure: Mask | None = None


@dataclass(frozen=True)
class Single:
    """One design: quantities by name in the units of design files, findings, and the key it is refused for, if it is.

    `what` says why it is refused.
    """

    values: dict[str, Any]
    findings: tuple[Check, ...] = ()
    refused: str = ""
    what: str = ""


class Axis(Protocol):
    """A kind's array form, made by `Maker`."""

    def evaluate(self, columns: Mapping[str, Reals]) -> Evaluated:
        """The designs that differ from the base by these values of its keys.

        Parameters
            columns : (N,) arrays by path
        """
        ...


class Maker(Protocol):
    """Makes a kind's array form, or None where it cannot serve; then each design is computed by its class.

    Parameters
        spec : the base design's spec
        command : whose checks are wanted
        paths : keys that will be varied
        quantities : names that are wanted, those of lists with their index
        checks : names of the checks that are wanted; findings of others are of no use, and refuse no design. Where
            the form does not judge one of them as the class does, it cannot serve
    """

    def __call__(
        self, spec: Any, command: str, paths: Sequence[str], quantities: Sequence[str], checks: Sequence[str]
    ) -> Axis | None: ...


def kept_inside(
    columns: Mapping[str, Reals], domains: Mapping[str, tuple[float, float, float]]
) -> tuple[dict[str, Reals], Mask]:
    """Values that an array form can compute, and the designs with other values, which the design class computes.

    Parameters
        columns : (N,) arrays by path
        domains : by path, the minimum and the maximum value, and one between that stands in for those beyond
    Example
        >>> inside, outside = kept_inside({"teeth": np.array([20.0, -90.0])}, {"teeth": (1.0, 1e4, 30.0)})
        >>> inside["teeth"].tolist(), outside.tolist()
        ([20.0, 30.0], [False, True])
    """
    inside = dict(columns)
    outside = np.zeros(len(next(iter(columns.values()))), dtype=bool)
    for path, (low, high, between) in domains.items():
        if path in columns:
            beyond = ~((columns[path] >= low) & (columns[path] <= high))
            inside[path] = np.where(beyond, between, columns[path])
            outside |= beyond
    return inside, outside


def as_arrays(singles: Sequence[Single], names: Sequence[str], codes: Sequence[str]) -> Evaluated:
    """Results of designs that were computed one by one, in the form of `Evaluated`."""
    reasons = list(dict.fromkeys(one.refused for one in singles if one.refused))
    refused = np.array([reasons.index(one.refused) + 1 if one.refused else 0 for one in singles], dtype=np.intp)
    findings = [found for code in codes for found in _of_code(code, singles)]
    return Evaluated(
        {name: column([one.values.get(name) for one in singles]) for name in names}, findings, refused, reasons
    )


def put_in(many: Evaluated, places: Any, few: Evaluated) -> Evaluated:
    """Designs in which those at some indices are replaced by others that were computed separately."""
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
    findings = [_only(each, kept) for each in many.findings]
    findings += [_widened(each, places, len(refused)) for each in few.findings]
    return Evaluated(quantities, findings, refused, reasons)


def _only(each: Findings, kept: Mask) -> Findings:
    """A finding of some of the designs; it says nothing of the others."""
    value, limit = np.where(kept, each.value, np.nan), np.where(kept, each.limit, np.nan)
    return Findings(each.code, value, limit, each.fails & kept, each.warns & kept, each.unit)


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
