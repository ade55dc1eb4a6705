"""What a gear train ties on a closed loop of links: one linear relation of their directions."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import TypeAlias

from gearlink.core.base.errors import NoSolution

LINKS = 6
Row: TypeAlias = tuple[Fraction, ...]
_ZERO, _ONE = Fraction(0), Fraction(1)


def train_relation(first_pin: int, teeth: Sequence[int]) -> Row:
    """Coefficients of the directions of the six links in the relation that a train ties.

    z_k (g_k - t_c) + z_(k+1) (g_(k+1) - t_c) = const on each carrier c;   sum r_j t_j = const over the train

    Parameters
        first_pin : int - of the first gear, 0 to 5; link j leads from pin j - 1 to pin j, link 0 is the frame
        teeth : two to five int - of the gears on this pin and those after it, negative for a ring
    Returns
        r : six Fraction - their sum is 0, since a revolution of the whole changes nothing
    Notes
        The first gear is fixed to the link before its pin, the last one to the link after it, so that each train takes
        one degree of freedom away.
    Example
        A gear on A fixed to the frame, one on B fixed to the coupler BC: t2 = (1 + z_A/z_B) t1 + const.

        >>> [str(r) for r in train_relation(0, (20, 40))]
        ['-1/2', '3/2', '-1', '0', '0', '0']

    Source
        thesis 2.1, rule (3); Willis's equation
    """
    gear = _unit(first_pin)
    for k in range(1, len(teeth)):
        carrier, ratio = _unit(first_pin + k), Fraction(teeth[k - 1], teeth[k])
        gear = tuple((1 + ratio) * c - ratio * g for g, c in zip(gear, carrier, strict=True))
    held = _unit(first_pin + len(teeth))
    return tuple(g - h for g, h in zip(gear, held, strict=True))


def _unit(link: int) -> Row:
    return tuple(_ONE if j == link % LINKS else _ZERO for j in range(LINKS))


def reduced(rows: Sequence[Row]) -> tuple[list[Row], list[int]]:
    """The relations solved for as many of the links 2 to 5 (Gauss and Jordan, exactly).

    Parameters
        rows : two rows from `train_relation`
    Returns
        rows, pivots : the k-th row has 1 at link pivots[k], where the other has 0
    Raises
        NoSolution - where the two trains tie the same
    Example
        >>> rows, pivots = reduced([train_relation(0, (20, 20)), train_relation(4, (16, 24))])
        >>> pivots, [str(r) for r in rows[0]], [str(r) for r in rows[1]]
        ([2, 4], ['1', '-2', '1', '0', '0', '0'], ['3/2', '0', '0', '0', '1', '-5/2'])
    """
    left: list[list[Fraction]] = [list(row) for row in rows]
    pivots: list[int] = []
    for column in range(2, LINKS):
        k = len(pivots)
        found = next((i for i in range(k, len(left)) if left[i][column]), None)
        if found is None:
            continue
        left[k], left[found] = left[found], left[k]
        left[k] = [value / left[k][column] for value in left[k]]
        for i in range(len(left)):
            if i != k:
                left[i] = [a - left[i][column] * b for a, b in zip(left[i], left[k], strict=True)]
        pivots.append(column)
        if len(pivots) == len(left):
            return [tuple(row) for row in left], pivots
    raise NoSolution(
        "both trains tie the same links in the same ratio, the second takes no freedom away",
        key="trains",
        fix="put it on other pins",
    )
