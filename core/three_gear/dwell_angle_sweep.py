"""Dwell angles of the symmetric family for many designs at once: steps of third order in blocks that stay in the cache.

With h = phi12/2, n = 1 - i3, s^2 = 1 + (n^2 - 1) cos^2(h) and k = 1/s the output regains its place at y where

    F(y) = n [asin(k sin(y)) + asin(k sin(h))] - h - y = 0,   phi13 = h + y

Near y both sides of F cancel; the last step therefore takes F in terms of asin(x) - x and y - sin(y).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gearlink.core.numerics.arrays import Reals

_BLOCK = 8192
_MOST_STEPS = 12
_SMALL = 0.75  # h [rad] below which the last step avoids the cancellation
_TINY = 1e-3  # h [rad] below which the steps of F are noise and y = 2 h (1 + O(h^2)) is the better start
_FITTED_BELOW = -0.2  # i3 above which the fitted start may lie in the reach of the root y = h
_START = (0.249, -0.434, 0.058, 0.163)
# (asin(x) - x)/x^3 as a rational function of x^2, |x| <= 1/2: relative error 2e-18 of asin(x), of the fdlibm library
_ASIN_TOP = (
    3.47933107596021167570e-05,
    7.91534994289814532176e-04,
    -4.00555345006794114027e-02,
    2.01212532134862925881e-01,
    -3.25565818622400915405e-01,
    1.66666666666666657415e-01,
)
_ASIN_BOTTOM = (
    7.70381505559019352791e-02,
    -6.88283971605453293030e-01,
    2.02094576023350569471e00,
    -2.40339491173441421878e00,
    1.0,
)
# (y - sin(y))/y^3 as a series of y^2, y <= 2
_SINE = tuple((-1.0) ** m / math.factorial(2 * m + 3) for m in reversed(range(11)))


def regained(ratio: Reals, h: Reals) -> tuple[Reals, NDArray[np.bool_]]:
    """Where the output regains its place, y above the symmetry line, for flat arrays of i3 and h.

    Parameters
        ratio, h : (N,) arrays [1, rad] - i3 < 0, 0 < h < pi/2
    Returns
        y : (N,) array [rad]
        settled : (N,) array - False where the steps did not come to rest inside the bracket [h, 3 h]
    Notes
        Measured against 40 digits: phi13 = h + y within 4 ulp for i3 <= -0.5, above it 1/|i3| times as much.
    Example
        >>> y, settled = regained(np.array([-2.0]), np.array([math.pi / 4]))
        >>> round(math.degrees(y[0] + math.pi / 4), 12), settled.tolist()
        (135.0, [True])
    """
    y, settled = np.empty(h.size), np.empty(h.size, dtype=bool)
    space = np.empty((9, min(_BLOCK, h.size)))
    with np.errstate(divide="ignore", invalid="ignore"):
        for start in range(0, h.size, _BLOCK):
            block = slice(start, start + _BLOCK)
            rows = space[:, : h[block].size]
            settled[block] = _settle(ratio[block], h[block], y[block], rows)
    return y, settled


def _settle(ratio: Reals, h: Reals, y: Reals, rows: Reals) -> NDArray[np.bool_]:
    """Steps until every design of a block rests; y is filled."""
    n, c, shift, high, *work = rows
    np.subtract(1.0, ratio, out=n)
    np.tan(h, out=shift)
    np.multiply(shift, shift, out=c)
    c += 1.0
    np.divide(ratio * (ratio - 2.0), c, out=c)  # (n^2 - 1) cos^2(h)
    shift /= n
    np.arctan(shift, out=shift)
    shift *= n
    shift -= h
    np.divide(n, n + 1.0, out=high)
    _start(high, h, y, work)
    np.multiply(h, 2.0, out=y, where=ratio > _FITTED_BELOW)
    high *= 2.0 * math.pi
    high -= h
    np.minimum(high, 3.0 * h, out=high)
    np.minimum(y, high, out=y)
    for _ in range(_MOST_STEPS):
        step = _step(n, c, shift, y, work)
        y -= step
        np.maximum(y, h, out=y)
        np.minimum(y, high, out=y)
        np.abs(step, out=step)
        step -= 3e-6 * y + 1e-14 / h  # what is left is the cube of the step, or the noise of F
        if step.max() <= 0.0:
            break
    settled: NDArray[np.bool_] = step <= 0.0
    tiny = h < _TINY
    if tiny.any():
        np.multiply(h, 2.0, out=y, where=tiny)
        settled |= tiny
    for part in (tiny, h < _SMALL):
        rows_of = np.flatnonzero(part)
        if rows_of.size:
            y[rows_of] -= _last_step(*(row[rows_of] for row in (ratio, n, c, h, y)))
    return settled


def _start(share: Reals, h: Reals, y: Reals, work: list[Reals]) -> None:
    """y = h (2 + w h^2 (c0 + c1 w + h^2 (c2 + c3 w))), w = (n - 3)/(n + 1), from share = n/(n + 1).

    Exact for i3 = -2 and for h to 0; fitted to 2.3 % for i3 from -12 to -0.2, which spares a step of third order.
    """
    w, square, outer, *_ = work
    np.multiply(share, 4.0, out=w)
    w -= 3.0
    np.multiply(h, h, out=square)
    np.multiply(w, _START[3], out=outer)
    outer += _START[2]
    outer *= square
    np.multiply(w, _START[1], out=y)
    y += outer
    y += _START[0]
    y *= square
    y *= w
    y += 2.0
    y *= h


def _step(n: Reals, c: Reals, shift: Reals, y: Reals, work: list[Reals]) -> Reals:
    """Halley's step of F, with u = tan(y/2) for sine and cosine.

    F' = n cos(y)/r - 1,  F'' = -n c sin(y)/r^3,  r^2 = c + cos^2(y)
    """
    u, one, cosine, root, value = work
    np.multiply(y, 0.5, out=u)
    np.tan(u, out=u)
    np.multiply(u, u, out=root)
    np.add(root, 1.0, out=one)
    np.subtract(1.0, root, out=cosine)
    np.multiply(one, one, out=root)
    root *= c
    np.multiply(cosine, cosine, out=value)
    root += value
    np.sqrt(root, out=root)  # r (1 + u^2)
    u *= 2.0
    np.arctan2(u, root, out=value)
    value *= n
    value += shift
    value -= y
    cosine *= n
    cosine /= root
    cosine -= 1.0  # F'
    value /= cosine  # F/F'
    one /= root  # 1/r
    u /= root  # sin(y)/r
    u *= c
    u *= n
    u *= one
    u *= one  # -F''
    u *= value
    u /= cosine
    u *= 0.5
    u += 1.0
    value /= u
    return value


def _last_step(ratio: Reals, n: Reals, c: Reals, h: Reals, y: Reals) -> Reals:
    """Newton's step of F = (n k - 1)(y + h) + n [p(y) + p(h)],  p(v) = (asin(k sin(v)) - k sin(v)) - k (v - sin(v))."""
    rest = ratio * (ratio - 2.0)
    v_h, v_y = _less_sine(h), _less_sine(y)
    sin_h, sin_y = h - v_h, y - v_y
    square = sin_h * sin_h
    s = np.sqrt(1.0 + c)
    k = 1.0 / s
    value = rest * square / (s * (n + s)) * (y + h)
    value += n * ((_asin_rise(k * sin_y) - k * v_y) + (_asin_rise(k * sin_h) - k * v_h))
    # F' as a difference of squares: it vanishes with the square of h
    cosine_square = 1.0 - sin_y * sin_y
    root, cosine = np.sqrt(c + cosine_square), np.copysign(np.sqrt(cosine_square), 0.5 * math.pi - y)
    slope = rest * (square - sin_y * sin_y) / (root * (n * cosine + root))
    step: Reals = value / slope
    return step


def _less_sine(v: Reals) -> Reals:
    """v - sin(v)."""
    w = v * v
    total = np.full(w.shape, _SINE[0])
    for coefficient in _SINE[1:]:
        total *= w
        total += coefficient
    total *= w
    total *= v
    return total


def _asin_rise(x: Reals) -> Reals:
    """asin(x) - x."""
    w = x * x
    top, bottom = np.full(w.shape, _ASIN_TOP[0]), np.full(w.shape, _ASIN_BOTTOM[0])
    for coefficient in _ASIN_TOP[1:]:
        top *= w
        top += coefficient
    for coefficient in _ASIN_BOTTOM[1:]:
        bottom *= w
        bottom += coefficient
    top /= bottom
    top *= w
    top *= x
    large = x > 0.5
    if large.any():
        top[large] = np.arcsin(x[large]) - x[large]
    return top
