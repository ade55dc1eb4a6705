"""Least squares by Levenberg's and Marquardt's steps, many searches at once, each row with its own damping."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeAlias

import numpy as np

from gearlink.core.numerics.arrays import Mask, Reals

State: TypeAlias = tuple[np.ndarray, ...]
"""What is known of K searches at one place: their costs (K,), then any arrays (K, ...) that a step needs."""

DAMPING = 1e-2
_SOFTER, _HARDER = 0.3, 4.0
# So many steps in which no row gained as much end a descent.
_IDLE, _GAIN = 6, 1e-9


def descend(
    state: Callable[..., State],
    step: Callable[[Reals, State, Reals], Reals],
    x: Reals,
    steps: int,
    *,
    slopes: Callable[[Reals, State], State] | None = None,
    given: Sequence[np.ndarray] = (),
    damping: Reals | float = DAMPING,
    least: float = 1e-12,
    most: float = 1e8,
) -> tuple[Reals, State, Reals, int]:
    """Rows of unknowns after so many steps, of which only those that lower the cost of their row are taken.

    Parameters
        state : function - of x (K, N) and what is given; a cost that is not a number is never taken
        step : function - of x, its state with the slopes, and the damping (K,): what is tried next, inside its bounds
        x : (K, N) array - starts
        steps : int - at most; fewer once no row gains
        slopes : function - of x and its state: what else a step needs, computed anew for rows that have moved
        given : (K, ...) arrays - what the state of each row needs besides
        damping : (K,) array or float - to begin with; it falls with each gain and rises with each loss
        least, most : floats - bounds of it
    Returns
        x : (K, N) array; state : as given, there; damping : (K,) array; taken : int - steps that were tried
    Notes
        No row sees another. One whose step fails at the most damping would fail at every step to come: it is left out.
    Source
        D. W. Marquardt, J. SIAM 11 (1963) 431-441
    """
    known, idle, rows = state(x, *given), 0, np.arange(len(x))
    damping = np.array(np.broadcast_to(damping, len(x)))
    bent: State = () if slopes is None else slopes(x, known)
    whole = x.copy(), damping.copy(), *(one.copy() for one in known)
    taken = steps
    for i in range(steps):
        new = step(x, (*known, *bent), damping)
        found = state(new, *given)
        better: Mask = found[0] < known[0]
        idle = 0 if np.any(found[0] < (1.0 - _GAIN) * known[0]) else idle + 1
        if idle == _IDLE:
            taken = i + 1
            break
        stuck = ~better & (damping >= most)
        x = chosen(better, new, x)
        known = tuple(chosen(better, one, other) for one, other in zip(found, known, strict=True))
        damping = np.clip(np.where(better, _SOFTER, _HARDER) * damping, least, most)
        if slopes is not None:
            _put(bent, better, slopes(x[better], tuple(one[better] for one in known)))
        if stuck.any():
            _put(whole, rows[stuck], tuple(one[stuck] for one in (x, damping, *known)))
            going = ~stuck
            rows, x, damping = rows[going], x[going], damping[going]
            known, bent, given = (tuple(one[going] for one in some) for some in (known, bent, given))
            if not rows.size:
                taken = min(steps, i + 1 + _IDLE - idle)
                break
    _put(whole, rows, (x, damping, *known))
    x, damping, *known_at_end = whole
    return x, tuple(known_at_end), damping, taken


def _put(arrays: State, rows: np.ndarray, values: State) -> None:
    """Write the values of some rows."""
    for array, value in zip(arrays, values, strict=True):
        array[rows] = value


def chosen(rows: Mask, one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Some rows from one array, the rest from another of the same shape."""
    return np.where(rows.reshape(-1, *(1,) * (one.ndim - 1)), one, other)


def damped(slopes: Reals, value: Reals, damping: Reals, *, free: Mask | None = None, scaled: bool = True) -> Reals:
    """Steps of damped least squares for every row: (J^T J + damping D) step = -J^T value.

    Parameters
        slopes : (K, M, N) array - J; value : (K, M) array; damping : (K,) array
        free : (K, N) array - unknowns that may move; None: all
        scaled : bool - Marquardt's D, the diagonal of J^T J and a thousandth of its maximum; else Levenberg's, 1
    Returns
        step : (K, N) array
    """
    square, slope = normal(slopes, value)
    if free is not None:
        square, slope = square * free[:, :, None] * free[:, None, :], free * slope
    return damped_normal(square, slope, damping, scaled=scaled)


def normal(slopes: Reals, value: Reals) -> tuple[Reals, Reals]:
    """J^T J (K, N, N) and J^T value (K, N), which stay while a row does."""
    across = np.swapaxes(slopes, 1, 2)
    return across @ slopes, np.squeeze(across @ value[..., None], axis=2)


def damped_normal(square: Reals, slope: Reals, damping: Reals, *, scaled: bool = True) -> Reals:
    """The steps of `damped` by what `normal` gives."""
    size = np.einsum("kii->ki", square)
    floor = 1e-14 * size.sum(axis=1, keepdims=True) + 1e-300
    scale = size + 1e-3 * size.max(axis=1, keepdims=True) if scaled else np.ones_like(size)
    each, held = range(size.shape[1]), square.copy()
    held[:, each, each] += damping[:, None] * scale + floor
    return np.asarray(-np.squeeze(np.linalg.solve(held, slope[..., None]), axis=2))
