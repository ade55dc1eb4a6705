"""Bracketed roots of many functions at once; all zeros of several functions within a period."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.numerics.arrays import Reals, distinct
from gearlink.core.numerics.together import Search, together

_STEPS = 200
_UNIT = np.linspace(0.0, 1.0, 17)
_NEWTON_STEPS = 60
_FAINTEST = 1e-300  # as good as no step: subnormal numbers have no full set of digits to settle in
_NO_STEP, _BY_SQUARES = 1e-18, 1e-5  # a step so short is none; they converge by the square from there on
_RESTS = 1e-9  # of x, the last Newton step; the error that it leaves is its square


def bracketed_roots(
    f: Callable[[Reals], Reals],
    low: Reals,
    high: Reals,
    *,
    ends: tuple[Reals, Reals] | None = None,
    tolerance: float | Reals = 0.0,
) -> Reals:
    """Roots between two arrays of places where a function has opposite signs, as `roots.bracketed_root` finds one.

    Parameters
        f : function of an (N,) array, element by element
        low, high : (N,) arrays
        ends : ((N,) array, (N,) array) - f(low) and f(high) where the caller has them already
        tolerance : float or (N,) array - absolute tolerance in x besides two ulp of x
    Returns
        roots : (N,) array - NaN where the signs are equal, or the function gives NaN
    Notes
        Each element rests by itself, at its tolerance: no bit of its root depends on the others. Where f jumps
        across 0 that place is found, by bisection.
    Example
        >>> bracketed_roots(lambda x: x * x - np.array([2.0, 9.0]), np.zeros(2), np.full(2, 5.0)).round(9).tolist()
        [1.414213562, 3.0]

    Source
        T. R. Chandrupatla, Adv. Eng. Softw. 28 (1997) 145-149
    """
    a, b = np.array(high, dtype=float), np.array(low, dtype=float)
    with np.errstate(all="ignore"):
        fb, fa = (f(b), f(a)) if ends is None else ends
        found = (fa == 0.0) | (fb == 0.0)
        valid = found | (np.sign(fa) == -np.sign(fb))
        best, rests = np.where(fa == 0.0, a, b), found | ~valid
        share: Reals = np.full(a.shape, 0.5)
        for _ in range(_STEPS):
            if rests.all():
                break
            x = np.where(rests, best, a + share * (b - a))
            fx = f(x)
            valid &= rests | (fx == fx)
            a, b, c, fa, fb, fc = narrowed(x, a, b, fx, fa, fb)
            nearest = np.abs(fa) < np.abs(fb)
            best = np.where(rests, best, np.where(nearest, a, b))
            reach = 2.0 * np.spacing(np.abs(best)) + tolerance
            rests |= ~valid | (np.where(nearest, fa, fb) == 0.0) | (np.abs(b - a) <= reach)
            least = np.minimum(0.5, reach / np.abs(b - a))
            share = np.minimum(1.0 - least, np.maximum(least, next_share(a, b, c, fa, fb, fc)))
    return np.where(valid, best, np.nan)


def root_between(f: Callable[[Reals], Reals], low: float, high: float, *, tolerance: float = 0.0) -> float:
    """Root of a function of arrays between two places where its signs differ: each round looks at 17 of them.

    Parameters
        f : function of a float64 array, returning one like it
        low, high : float - f has opposite signs there; where it has several roots, the first of those that are seen
        tolerance : float - absolute tolerance in x besides two ulp of x
    Notes
        Where a call costs more than its places, a few serve for the dozen of `roots.bracketed_root`: after a round the
        next one looks round the root of the inverse polynomial through five places, four times as far as that
        through four lies from it. Where the root is not there, the interval between two places is looked at anew.
    Example
        >>> root_between(lambda x: x * x - 2.0, 0.0, 2.0)
        1.4142135623730951
    """
    inside, missed = (low, high), False
    for _ in range(_STEPS):
        x = low + (high - low) * _UNIT
        values = f(x)
        changes = ((values[:-1] > 0.0) != (values[1:] > 0.0)).nonzero()[0]
        if not changes.size:
            if (low, high) == inside:
                break
            (low, high), missed = inside, True
            continue
        i = int(changes[0])
        low, high = inside = float(x[i]), float(x[i + 1])
        if high - low <= 2.0 * np.spacing(abs(high)) + tolerance:
            return low if abs(values[i]) < abs(values[i + 1]) else high
        first = min(max(i - 2, 0), _UNIT.size - 5)
        near = slice(first, first + 5)
        guess, other = _inverse(values[near], x[near])
        reach = max(4.0 * abs(guess - other), 0.5 * tolerance, float(np.spacing(abs(high))))
        if not missed and reach < 0.5 * (high - low):  # not a number: no
            low, high = max(low, guess - reach), min(high, guess + reach)
        missed = False
    raise NoSolution(f"no sign change between {inside[0]!r} and {inside[1]!r}")


def _inverse(values: Reals, places: Reals) -> tuple[float, float]:
    """Where the polynomials of the places by their values, through all five and through the first four, have 0."""
    v, x = values.tolist(), places.tolist()
    four = math.nan
    for width in range(1, 5):
        for k in range(5 - width):
            apart = v[k] - v[k + width]
            x[k] = (v[k] * x[k + 1] - v[k + width] * x[k]) / apart if apart else math.nan
        if width == 3:
            four = x[0]
    return x[0], four


def newton_roots(
    function: Callable[..., tuple[Reals, Reals]], low: Reals, high: Reals, start: Reals, *given: Any, rest: float = 0.0
) -> Reals:
    """Roots of rising functions by Newton's method inside brackets; a step that leaves its bracket halves it.

    Parameters
        function : of x and `given` - value and slope
        low, high : (N,) arrays - function(low) <= 0 <= function(high)
        start : (N,) array - inside
        given : (N,) arrays that the function takes as well
        rest : float - a step that is no longer is the last one, beside one of 1e-9 of x
    Returns
        x : (N,) array - each as if it stood alone
    Example
        >>> ends = np.zeros(2), np.full(2, 5.0)
        >>> newton_roots(lambda x, c: (x * x - c, 2.0 * x), *ends, np.ones(2), np.array([2.0, 9.0]))
        array([1.41421356, 3.        ])
    """
    result = np.array(start)
    live: Any = np.arange(result.size)
    x, low, high, moves = result, np.array(low), np.array(high), np.ones(result.shape, dtype=bool)
    for _ in range(_NEWTON_STEPS):
        value, slope = function(x, *given)
        low, high = np.where(value < 0.0, x, low), np.where(value < 0.0, high, x)
        with np.errstate(all="ignore"):
            new = x - value / slope
        new = np.where((new >= low) & (new <= high), new, 0.5 * (low + high))
        new = np.where(moves & (value != 0.0), new, x)  # what rests stays
        moves &= np.abs(new - x) > _RESTS * np.abs(new) + rest
        x, left = new, np.count_nonzero(moves)
        if not left:
            break
        if 2 * left < x.size:  # to copy all that is given takes as long as a step
            result[live] = x
            live, x, low, high = live[moves], x[moves], low[moves], high[moves]
            given, moves = tuple(row[moves] for row in given), moves[moves]
    result[live] = x
    return result


def newton_places(
    excess: Callable[[Reals, Any], tuple[Reals, Reals]], start: Reals, high: float, floor: float = 0.0
) -> Reals | None:
    """Places between 0 and an end where rising functions are 0, by Newton's steps from near.

    Parameters
        excess : of places and the columns that they are of - values and slopes
        start : (N,) array, or rows of such - near the places
        high : float - the end
        floor : float - values up to which a place rests
    Returns
        x : array as start, or None - each as if it stood alone; None where some do not rest
    Notes
        The last step is at most 1e-9 of x. What it leaves is f''/(2 f') of its square: rounding, unless a slope doubles
        within a hundredth of x.
    Example
        >>> c = np.array([2.0, 9.0])
        >>> newton_places(lambda x, rows: (x * x - c[rows], 2.0 * x), np.ones(2), 5.0)
        array([1.41421356, 3.        ])
    """
    x, left, moves = np.array(start), np.arange(start.shape[-1]), np.ones(start.shape, dtype=bool)
    for _ in range(_NEWTON_STEPS):
        if not left.size:
            return x
        before = x[..., left]
        value, slope = excess(before, left)
        step = value / slope
        # a step past an end stops there; the next one starts from the end
        at = np.clip(before - step, 0.0, high)
        x[..., left] = np.where(moves, at, before)
        moves &= ~((np.abs(step) <= _RESTS * at + _FAINTEST) | (np.abs(value) <= floor))
        going = moves if moves.ndim < 2 else moves.any(axis=0)
        left, moves = left[going], moves[..., going]
    return None


def newton_closed(step: Callable[[Reals, Any], Reals], near: Reals) -> Reals | None:
    """Unknowns of many systems from approximate ones, by Newton's steps until these are rounding.

    Parameters
        step : of the unknowns, (N, K), and the rows that they are of - Newton's steps
        near : (M, K) array [rad or shares of a size]
    Returns
        found : (M, K) array or None - each row as if it stood alone; None where steps are no numbers or do not end
    Example
        >>> c = np.array([[2.0], [9.0]])
        >>> newton_closed(lambda x, rows: (c[rows] - x * x) / (2.0 * x), np.ones((2, 1))).ravel()
        array([1.41421356, 3.        ])
    """
    found, rows, finest = near.copy(), np.arange(len(near)), np.full(len(near), np.inf)
    for _ in range(_NEWTON_STEPS):
        change = step(found[rows], rows)
        size = np.abs(change).max(axis=1)
        if not np.isfinite(size).all():
            return None
        taken = size < finest  # steps shrink until rounding is reached
        found[rows[taken]] += change[taken]
        # the next one would be as much shorter again, squared: s_(k+1) = s_k (s_k/s_(k-1))^2
        going = taken & (size**3 >= _NO_STEP * np.minimum(finest, _BY_SQUARES) ** 2)
        if not going.any():
            return found
        rows, finest = rows[going], size[going]
    return None


def narrowed(x: Reals, a: Reals, b: Reals, fx: Reals, fa: Reals, fb: Reals) -> tuple[Reals, ...]:
    """The brackets from x on, with the places before and the values at all three."""
    same = (fx > 0.0) == (fa > 0.0)
    return x, np.where(same, b, a), np.where(same, a, b), fx, np.where(same, fb, fa), np.where(same, fa, fb)


def next_share(a: Reals, b: Reals, c: Reals, fa: Reals, fb: Reals, fc: Reals) -> Reals:
    """How far from a to b the next place is: by inverse quadratic interpolation where that is safe, else half."""
    xi, phi = (a - b) / (c - b), (fa - fb) / (fc - fb)
    safe = (phi * phi < xi) & ((1.0 - phi) * (1.0 - phi) < 1.0 - xi)
    curved = fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
    return np.where(safe, curved, 0.5)


_ZERO_STEPS = 150
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
        grid = distinct(np.concatenate((grid, sides[(sides > 0.0) & (sides < period)])))
    values = yield grid
    rows = np.flatnonzero((values[:-1] > 0.0) != (values[1:] > 0.0))
    if rows.size == 0:
        return []
    # A value is above 0 or it is not: where the function leaves 0 is found, and so is a jump. Each bracket rests by
    # itself, so that what jumps does not have the others computed again.
    b, a, fb, fa = grid[rows], grid[rows + 1], values[rows], values[rows + 1]
    found, left, near = np.empty(rows.size), np.arange(rows.size), 4.0 * np.spacing(period)
    share: Reals = np.full(rows.size, 0.5)
    for step in range(_ZERO_STEPS):
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
