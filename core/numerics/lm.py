"""Least squares by Levenberg's and Marquardt's steps, many searches at once, each row with its own damping."""

from __future__ import annotations

from collections.abc import Callable
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
    state: Callable[[Reals], State],
    step: Callable[[Reals, State, Reals], Reals],
    x: Reals,
    steps: int,
    *,
    damping: Reals | float = DAMPING,
    least: float = 1e-12,
    most: float = 1e8,
) -> tuple[Reals, State, Reals, int]:
    """Rows of unknowns after so many steps, of which only those that lower the cost of their row are taken.

    Parameters
        state : function - of x (K, N); a cost that is not a number is never taken
        step : function - of x, its state and the damping (K,), what is tried next, inside its bounds
        x : (K, N) array - starts
        steps : int - at most; fewer once no row gains
        damping : (K,) array or float - to begin with; it falls with each gain and rises with each loss
        least, most : floats - bounds of it
    Returns
        x : (K, N) array; state : as given, there; damping : (K,) array; taken : int - steps that were tried
    Source
        D. W. Marquardt, J. SIAM 11 (1963) 431-441
    """
    damping, known, idle = np.broadcast_to(damping, len(x)), state(x), 0
    for i in range(steps):
        new = step(x, known, damping)
        found = state(new)
        better: Mask = found[0] < known[0]
        idle = 0 if np.any(found[0] < (1.0 - _GAIN) * known[0]) else idle + 1
        if idle == _IDLE:
            return x, known, damping, i + 1
        x = chosen(better, new, x)
        known = tuple(chosen(better, one, other) for one, other in zip(found, known, strict=True))
        damping = np.clip(np.where(better, _SOFTER, _HARDER) * damping, least, most)
    return x, known, damping, steps


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
    across = np.swapaxes(slopes, 1, 2)
    square, slope = across @ slopes, np.squeeze(across @ value[..., None], axis=2)
    if free is not None:
        square, slope = square * free[:, :, None] * free[:, None, :], free * slope
    size = np.einsum("kii->ki", square)
    floor = 1e-14 * size.sum(axis=1, keepdims=True) + 1e-300
    scale = size + 1e-3 * size.max(axis=1, keepdims=True) if scaled else np.ones_like(size)
    each = range(size.shape[1])
    square[:, each, each] += damping[:, None] * scale + floor
    return np.asarray(-np.squeeze(np.linalg.solve(square, slope[..., None]), axis=2))
