"""Where the maximum of a bracket lies by its samples, and how narrow the next bracket may be: a step of `extremes`."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gearlink.core.numerics.arrays import Reals

POINTS = 17
"""Samples of a bracket."""
_AROUND = np.arange(-3, 4)
_NEWTON = 3
_WIDE, _NARROW = 0.125, 2.0**-10  # of a step: half of the next bracket round a vertex, at most and at least
_END_SHARE = 2.0**-7  # of a step: where the samples fall from an end, little else than that end is left to see
_SURE_ULPS = 32.0
_JUMPS = 16.0
_TURNS_OF_NOISE = 4


def vertex_of(x: Reals, v: Reals, i: NDArray[np.intp]) -> tuple[Reals, Reals]:
    """Where the maximum of a bracket lies by its largest samples, and half of the next bracket.

    Parameters
        x, v : (N, POINTS) arrays - places of the samples, evenly spaced, and values
        i : (N,) array of int - the largest sample of each
    Returns
        vertex, half : (N,) arrays - place, and half the width of the next bracket
    Notes
        The vertex of the parabola through three samples, and that of the quartic through five where these are at hand:
        the latter's error is far below the way between both, a quarter of which serves as the next bracket, or what
        rounding moves it by. At a kink, where the lines from both sides meet; at a jump, between the samples beside it.
    """
    rows = np.arange(i.size)
    middle = np.clip(i, 1, POINTS - 2)
    low, mid, high = v[rows, middle - 1], v[rows, middle], v[rows, middle + 1]
    bend = low - 2.0 * mid + high
    step = x[:, 1] - x[:, 0]
    interior = (i == middle) & (bend < 0.0)
    shift = np.divide(0.5 * (low - high), bend, out=np.zeros_like(bend), where=interior)
    half = np.where(interior, _WIDE, np.where(_falls_from_its_end(v, i), _END_SHARE, 1.0))
    inside = np.flatnonzero(interior & (i == np.clip(i, 3, POINTS - 4)))
    with np.errstate(invalid="ignore"):  # what is infinite is enlarged as a parabola
        samples = v[inside[:, None], i[inside, None] + _AROUND]
        better = _quartic_shift(samples[:, 1:-1], shift[inside])
        noise = np.max(np.abs(np.diff(v[inside], 6, axis=1)), axis=1) / -bend[inside]  # of what no smooth curve leaves
        rounding = _SURE_ULPS * np.spacing(np.abs(mid[inside])) / -bend[inside]
        for place, reach in ((better, np.fmax(0.25 * np.abs(better - shift[inside]), noise)), _crossing(samples)):
            reach = np.fmax(reach, np.fmax(rounding, _NARROW))
            close = reach < half[inside]
            shift[inside[close]], half[inside[close]] = place[close], reach[close]
    jump, at = _jump(v)
    beside = jump & ((at == i) | (at == i - 1))
    shift, half = np.where(beside, at - i + 0.5, shift), np.where(beside, 0.5, half)
    return x[rows, i] + shift * step, half * step


def _quartic_shift(v: Reals, shift: Reals) -> Reals:
    """Vertex of the quartic through five samples a row, in steps from the middle one, from that of the parabola on."""
    far, near = v[:, 4] - v[:, 0], v[:, 3] - v[:, 1]
    far_sum, near_sum = v[:, 4] + v[:, 0] - 2.0 * v[:, 2], v[:, 3] + v[:, 1] - 2.0 * v[:, 2]
    a, b = (8.0 * near - far) / 12.0, (16.0 * near_sum - far_sum) / 12.0
    c, d = (far - 2.0 * near) / 4.0, (far_sum - 4.0 * near_sum) / 6.0
    with np.errstate(all="ignore"):  # what is none is told by its distance from the parabola's
        for _ in range(_NEWTON):
            shift = shift - (a + shift * (b + shift * (c + shift * d))) / (b + shift * (2.0 * c + shift * 3.0 * d))
    return shift


def _crossing(v: Reals) -> tuple[Reals, Reals]:
    """Where the lines from both sides meet, by seven samples a row, in steps from the middle one, and its error."""
    before, after = v[:, 2] - v[:, 1], v[:, 5] - v[:, 4]
    bends = np.abs(before - v[:, 1] + v[:, 0]) + np.abs(v[:, 6] - v[:, 5] - after)
    with np.errstate(all="ignore"):  # lines that are one do not meet
        place = (v[:, 4] - v[:, 2] - before - after) / (before - after)
        error = 4.0 * bends / np.abs(before - after)
    return place, np.where(np.abs(place) <= 1.0, error, 1.0)


def _jump(v: Reals) -> tuple[NDArray[np.bool_], NDArray[np.intp]]:
    """Whether a function jumps within a bracket, and after which sample: there it moves far more than anywhere else."""
    with np.errstate(invalid="ignore"):  # what is infinite is enlarged as it was
        steps = np.abs(np.diff(v, axis=1))
        two = np.partition(steps, -2, axis=1)
        jumps: NDArray[np.bool_] = two[:, -1] > _JUMPS * two[:, -2]
    return jumps, np.argmax(steps, axis=1)


def _falls_from_its_end(v: Reals, i: NDArray[np.intp]) -> NDArray[np.bool_]:
    """Whether the samples fall from the end of the bracket, without a vertex between the first two."""
    last = POINTS - 1
    first_step = np.where(i == 0, v[:, 0] - v[:, 1], v[:, last] - v[:, last - 1])
    next_step = np.where(i == 0, v[:, 1] - v[:, 2], v[:, last - 1] - v[:, last - 2])
    falls: NDArray[np.bool_] = ((i == 0) | (i == last)) & (next_step > 0.0) & (2.0 * first_step > next_step)
    return falls


def is_level(v: Reals, i: NDArray[np.intp]) -> NDArray[np.bool_]:
    """Whether the largest sample is the first of three or more alike: the edge of what is cut off at a level."""
    rows, first = np.arange(i.size), np.minimum(i, POINTS - 3)
    level: NDArray[np.bool_] = (v[rows, first + 1] == v[rows, first]) & (v[rows, first + 2] == v[rows, first])
    level &= first == i
    return level


def is_noise(v: Reals) -> NDArray[np.bool_]:
    """Whether the samples of a bracket go up and down too often for a function that the first samples resolved."""
    signs = np.sign(np.diff(v, axis=1))
    noise: NDArray[np.bool_] = np.count_nonzero(signs[:, :-1] * signs[:, 1:] < 0.0, axis=1) >= _TURNS_OF_NOISE
    return noise
