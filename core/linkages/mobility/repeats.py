"""Constraints that say again what others say: where the count of joints and trains misses the freedom that is there.

Each link moves with a velocity of its origin and a turning speed, in a general position of its pins; a pin joins two
links, a mesh ties two gears and the link between their pins. All is computed modulo a prime of 61 bits, in which ranks
are exact but for a chance of 1e-16.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import count, pairwise
from typing import TYPE_CHECKING, TypeAlias

from gearlink.core.linkages.mobility.freedom import common_links, pin_names
from gearlink.core.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.linkages.mobility.spec import Gear, Train

_PRIME = 2**61 - 1
_BASE = 0x1E3779B97F4A7C15
"""Its powers to the squares are spread over the numbers below the prime: a general position, the same every time."""
Row: TypeAlias = dict[tuple[str, ...], int]
"""Coefficients of the velocities, by link or gear and component."""


class _Rows:
    """Equations that do not follow from each other, each without the unknowns that those before it give."""

    def __init__(self) -> None:
        self.kept: dict[tuple[str, ...], Row] = {}

    def left_of(self, row: Row) -> Row:
        """What is left of an equation once the others are put into it; empty where it says nothing new."""
        left = dict(row)
        for pivot, known in self.kept.items():
            if share := left.get(pivot, 0):
                for name, value in known.items():
                    left[name] = (left.get(name, 0) - share * value) % _PRIME
        return {name: value for name, value in left.items() if value % _PRIME}

    def add(self, row: Row) -> bool:
        """Keep an equation; whether it says something new."""
        left = self.left_of(row)
        if not left:
            return False
        pivot = next(iter(left))
        inverse = pow(left[pivot], -1, _PRIME)
        self.kept[pivot] = {name: value * inverse % _PRIME for name, value in left.items()}
        return True


@dataclass(frozen=True)
class Constraints:
    """The joints of a linkage and the meshes of the trains on it.

    Parameters
        links : mapping - name of each link and the pins that it carries
        trains : Trains of the file, whose gears sit on pins of links that carry their neighbours too
    Example
        A third bar to the point that two hold says again what they say: the crank besides moves, the count is 0.

        >>> truss = {"frame": "ABDP", "one": "AC", "two": "BC", "three": "DC"}
        >>> held = Constraints({**truss, "crank": "PQ"}, ())
        >>> held.freedom, held.repeated
        (1, ['pin C'])
    """

    links: Mapping[str, Sequence[str]]
    trains: Sequence[Train]

    @cached_property
    def _found(self) -> tuple[_Rows, list[str]]:
        rows, again, numbers = _Rows(), list[str](), (pow(_BASE, k * k, _PRIME) for k in count(1))
        for pin in pin_names(self.links):
            x, y = next(numbers), next(numbers)
            one, *others = (name for name, pins in self.links.items() if pin in pins)
            for other in others:
                across: Row = {(one, "x"): 1, (other, "x"): -1, (one, "w"): -y, (other, "w"): y}
                along: Row = {(one, "y"): 1, (other, "y"): -1, (one, "w"): x, (other, "w"): -x}
                if not all([rows.add(across), rows.add(along)]):
                    again.append(f"pin {pin}")
        for i, train in enumerate(self.trains, start=1):
            known = all(gear.teeth is not None for gear in train.gears)
            radii = [gear.teeth if known and gear.teeth else next(numbers) for gear in train.gears]
            for j in range(len(train.gears) - 1):
                row = self._mesh(i, train, j, radii)
                if row is not None and not rows.add(row):
                    again.append(f"train {i}")
        return rows, list(dict.fromkeys(again))

    def _mesh(self, i: int, train: Train, j: int, radii: Sequence[int]) -> Row | None:
        """r_1 (w_1 - w_c) +- r_2 (w_2 - w_c) = 0, minus where one of the gears is a ring."""
        one, other = train.gears[j : j + 2]
        carriers = common_links(self.links, one.at, other.at)
        if not carriers:
            return None
        ring = -1 if one.ring or other.ring else 1
        row: Row = {}
        terms = ((_turn(i, j, one), radii[j]), (_turn(i, j + 1, other), ring * radii[j + 1]))
        for name, radius in terms:
            for key, value in ((name, radius), ((carriers[0], "w"), -radius)):
                row[key] = row.get(key, 0) + value
        return row

    @property
    def repeated(self) -> list[str]:
        """The pins and trains that say again what those before them say."""
        return self._found[1]

    @cached_property
    def freedom(self) -> int:
        """Degrees of freedom against any one link."""
        free = sum(gear.fixed_to is None for train in self.trains for gear in train.gears)
        return 3 * len(self.links) + free - len(self._found[0].kept) - 3

    def held(self) -> Iterator[int]:
        """Numbers of the trains, from 1 on, of which no gear can turn against its link while other parts move."""
        rows = self._found[0]
        if not self.freedom:
            return
        for i, train in enumerate(self.trains, start=1):
            turns: list[Row] = []
            for j, (one, other) in enumerate(pairwise(train.gears)):
                carriers = common_links(self.links, one.at, other.at)
                turns += [
                    {_turn(i, k, gear): 1, (carrier, "w"): -1}
                    for k, gear in ((j, one), (j + 1, other))
                    for carrier in carriers[:1]
                    if _turn(i, k, gear) != (carrier, "w")
                ]
            if turns and not any(rows.left_of(turn) for turn in turns):
                yield i


def _turn(i: int, j: int, gear: Gear) -> tuple[str, ...]:
    """The turning speed of a gear: that of the link that it is fixed to, or its own."""
    return (gear.fixed_to, "w") if gear.fixed_to is not None else ("gear", str(i), str(j))
