"""Places where functions of the input angle change their sign, to the last bits, those of several at once."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.roots_sweep import narrowed, next_share
from gearlink.core.numerics.together import Search, together

_STEPS = 150
_BESIDE = 8.0


def zeros(f: Callable[[Reals], Reals], period: float, turns: int = 1) -> list[float]:
    """Places within a period where a function changes its sign, to the last bits, all at once.

    Notes
        Brackets from 720 rows a revolution; a zero that is touched without a change of sign is none.
    Source
        T. R. Chandrupatla, Adv. Eng. Softw. 28 (1997) 145-149
    """
    return zeros_of([f], period, turns)[0]


def zeros_of(
    functions: Sequence[Callable[[Reals], Reals]],
    period: float,
    turns: int = 1,
    *,
    jumps: Sequence[float] = (),
    any_zero: bool = False,
) -> list[list[float]]:
    """The zeros of several functions, searched together.

    Parameters
        functions, period, turns : as of `zeros`
        jumps : floats - where they may jump, so that one across 0 is not sought by halving
        any_zero : bool - any place will do where a function is 0 over a way, else the first or the last one
    """
    return together(functions, [_zeros(period, turns, jumps, any_zero=any_zero) for _ in functions])


def _zeros(period: float, turns: int, jumps: Sequence[float], *, any_zero: bool) -> Search[list[float]]:
    grid, beside = np.linspace(0.0, period, 720 * turns + 1), _BESIDE * float(np.spacing(period))
    if jumps:
        sides = np.add.outer(np.asarray(jumps), [-beside, beside]).ravel()
        grid = np.unique(np.concatenate((grid, sides[(sides > 0.0) & (sides < period)])))
    values = yield grid
    rows = np.flatnonzero((values[:-1] > 0.0) != (values[1:] > 0.0))
    if rows.size == 0:
        return []
    # A value is above 0 or it is not: where the function leaves 0 is found, and so is a jump. Each bracket rests by
    # itself, so that what jumps does not have the others computed again.
    b, a, fb, fa = grid[rows], grid[rows + 1], values[rows], values[rows + 1]
    found, left, near = np.empty(rows.size), np.arange(rows.size), 4.0 * np.spacing(period)
    share: Reals = np.full(rows.size, 0.5)
    for step in range(_STEPS):
        x = a + share * (b - a)
        fx = yield x
        with np.errstate(all="ignore"):
            a, b, c, fa, fb, fc = narrowed(x, a, b, fx, fa, fb)
            width = np.abs(b - a)
            found[left] = np.where(np.abs(fa) < np.abs(fb), a, b)
            going = (width > near) & (fx != 0.0) if any_zero else width > near
            left = left[going]
            if not left.size:
                break
            a, b, c, fa, fb, fc, width = (each[going] for each in (a, b, c, fa, fb, fc, width))
            least = np.minimum(0.5, 0.5 * near / width)
            share = next_share(a, b, c, fa, fb, fc)
            if step % 2:  # where a force bends as it changes sides, the line from its own side leads to the zero
                line = fa * (a - c) / (fa - fc) / (a - b)
                share = np.where((share == 0.5) & (line > 0.0) & (line < 1.0), line, share)
            share = np.minimum(1.0 - least, np.maximum(least, share))
    return found.tolist()
