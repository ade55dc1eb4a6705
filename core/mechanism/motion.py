"""The motion of a machine: its links and joints at any input, with derivatives with respect to the input.

A machine is described once, by its `Motion`, which tables, curves, animations, clearance, loads and register read.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal, NamedTuple

import numpy as np

from gearlink.core.mechanism.links import Mechanism
from gearlink.core.numerics.arrays import Reals

TURN = 2.0 * math.pi
_KEPT = 24
_ROWS_KEPT = 100_000
BLOCK = 4096
"""Rows of a long table that are computed at a time, for the memory's sake."""
_FEW = 340
"""Rows at most of what a search looks at on the way; the grids that searches begin with are kept apart from it."""


@dataclass(frozen=True)
class Input:
    """The input of a machine.

    Fields
        column : str - the first column of its tables
        unit : "rad" or "mm"
        start, end : float [unit] - its period, or its range
        turns : int or None - revolutions of the period; None: a range that does not repeat, or no whole revolutions
        joints : floats [unit] - inputs at which a rate may jump, ascending, from start to end
    """

    column: str = "input_angle"
    unit: Literal["rad", "mm"] = "rad"
    start: float = 0.0
    end: float = TURN
    turns: int | None = 1
    joints: tuple[float, ...] = ()


@dataclass(frozen=True)
class Motion:
    """The links and joints of one design over its input.

    Fields
        make : function of an array of inputs (N,) [rad or mm], of the order of the highest derivative, and of the side
        outputs : what moves in the end, as sheets and animations show it; of the first one `register` counts the errors
        highest : int - the highest derivative there is; 2 where a law has no third
        transmission : the least transmission angle; None where no coupler moves a link of the frame

    A rate that jumps at an input is the one just after it, with `side` -1 the one just before.
    """

    make: Callable[[Reals, int, int], Mechanism]
    input: Input = Input()
    outputs: tuple[Output, ...] = ()
    highest: int = 3
    transmission: Course | None = None
    kept: dict[tuple[int, bytes], Mechanism] = field(default_factory=dict, repr=False, compare=False)
    kept_few: dict[tuple[int, bytes], Mechanism] = field(default_factory=dict, repr=False, compare=False)

    def at(self, q: Reals, order: int = 2, *, side: int = 1) -> Mechanism:
        """The links and joints at inputs; the last few answers are kept, and serve lower orders too.

        Parameters
            q : (N,) array [rad or mm]
            order : int - highest derivative, 0 to 3; no more than `highest` is given
            side : +1 or -1 - of inputs at which a rate jumps
        Raises
            NoSolution - where the mechanism does not close
        """
        order = min(order, self.highest)
        kept = self.kept if q.size > _FEW else self.kept_few
        rows = q.tobytes()
        for higher in range(order, self.highest + 1):
            if (found := kept.get((side * (higher + 1), rows))) is not None:
                return found
        # The oldest go; of long arrays few are held, so that a table of a million rows does not fill the memory.
        while kept and (len(kept) >= _KEPT or (len(kept) + 1) * q.size > _ROWS_KEPT):
            kept.pop(next(iter(tuple(kept)), (0, b"")), None)  # several threads may do so at once
        made = self.make(q, order, side)
        kept[side * (order + 1), rows] = made
        return made

    def anew(self) -> Motion:
        """The same motion without stored results."""
        return replace(self, kept={}, kept_few={})


@dataclass(frozen=True)
class Course:
    """One number over the input.

    Fields
        unit : "rad", "mm" or "1" - of its value; of a derivative that per rad (or mm) of the input, to its power
        of : function of the links - (N,) arrays, value and as many derivatives as the links have
    """

    unit: str
    of: Callable[[Mechanism], Sequence[Reals]]

    def rates(self, motion: Motion, q: Reals, order: int = 2, *, side: int = 1) -> list[Reals]:
        """Value and derivatives up to an order at inputs, block by block.

        Parameters
            q : (N,) array [rad or mm]
        Returns
            rates : list of (N,) arrays - order + 1 of them, or as many as the motion has
        Raises
            NoSolution - where the mechanism does not close
        """
        if q.size <= BLOCK:
            return list(self.of(motion.at(q, order, side=side)))[: order + 1]
        parts = [
            list(self.of(motion.make(q[at : at + BLOCK], order, side)))[: order + 1] for at in range(0, q.size, BLOCK)
        ]
        return [np.concatenate(part) for part in zip(*parts, strict=True)]

    def scaled(self, factor: float, unit: str = "") -> Course:
        """The course times a factor, in another unit where one is given."""
        return Course(unit or self.unit, lambda links: [factor * np.asarray(rate) for rate in self.of(links)])

    def less(self, start: float) -> Course:
        """The course with another zero."""

        def shifted(links: Mechanism) -> list[Reals]:
            value, *rates = self.of(links)
            return [np.asarray(value) - start, *rates]

        return Course(self.unit, shifted)


class Output(NamedTuple):
    """An output of a machine, with its name.

    Fields
        name : str - as sheets and charts show it
        phases : stretches of the input with a name and ends [rad or mm], in which one law holds
    """

    name: str
    course: Course
    phases: tuple[tuple[str, float, float], ...] = ()
