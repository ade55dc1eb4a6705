"""Many designs at once: what a kind's array form takes and gives, so that a study need not know the kind.

A kind that can compute many designs names, in `gearlink.core.kinds`, what makes its `Axis` from a base design; the axis
gives the `Evaluated` designs for arrays of some keys' values. Names, units, codes, limits and refusals are those of
the design class's, with which it must agree.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from gearlink.core.numerics.arrays import Mask, Reals


@dataclass(frozen=True, slots=True)
class Findings:
    """One finding of a check on every design.

    Fields
        code : str - "GL301"
        value, limit : (N,) arrays - in the units of design files; NaN where there is none
        fails, warns : (N,) arrays
        unit : str
    """

    code: str
    value: Reals
    limit: Reals
    fails: Mask
    warns: Mask
    unit: str


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
    """Values that an array form can compute with, and the designs that have others: those are left to the class.

    Parameters
        columns : (N,) arrays by path
        domains : by path, the least and the greatest value, and one between that stands in for those beyond
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
