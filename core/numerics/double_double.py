"""Sums, products, sines and cosines in double-double: pairs of floats that carry about 106 bits.

A pair (high, low) stands for high + low with |low| <= ulp(high)/2. Only what the residual of a vector loop needs.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gearlink.core.numerics.arrays import Reals


class Pair(NamedTuple):
    """Unevaluated sum high + low."""

    high: Reals
    low: Reals


_SPLIT = 2.0**27 + 1.0
# sin(k pi/16), k = 0..8, as pairs; cos(k pi/16) = sin((8 - k) pi/16).
_SINES = np.array(
    [
        (0.0, 0.0),
        (0.19509032201612828, -7.991079068461731e-18),
        (0.3826834323650898, -1.0050772696461588e-17),
        (0.5555702330196022, 4.709410940561677e-17),
        (0.7071067811865476, -4.833646656726457e-17),
        (0.8314696123025452, 1.4073856984728024e-18),
        (0.9238795325112867, 1.7645047084336677e-17),
        (0.9807852804032304, 1.8546939997825006e-17),
        (1.0, 0.0),
    ]
)
# pi/16 in three parts: with a whole number k of turns' sixteenths, k times what the parts leave out is below 2^-145.
_STEP = (0.19634954084936207, 7.654042494670958e-18, -1.8717311310739623e-34)
_SIN_TERMS = (
    (-0.16666666666666666, -9.25185853854297e-18),
    (0.008333333333333333, 1.1564823173178714e-19),
    (-0.0001984126984126984, -1.7209558293420705e-22),
    (2.7557319223985893e-06, -1.858393274046472e-22),
)  # -1/3!, 1/5!, -1/7!, 1/9!
_COS_TERMS = (
    (-0.5, 0.0),
    (0.041666666666666664, 2.3129646346357427e-18),
    (-0.001388888888888889, 5.300543954373577e-20),
    (2.48015873015873e-05, 2.1511947866775882e-23),
)  # -1/2!, 1/4!, -1/6!, 1/8!


def two_sum(x: Reals, y: Reals) -> Pair:
    """Exact sum of two floats as a pair.

    Example
        >>> [float(part) for part in two_sum(np.float64(1.0), np.float64(1e-20))]
        [1.0, 1e-20]

    Source
        D. E. Knuth, The Art of Computer Programming 2, 4.2.2, theorem B
    """
    high = x + y
    y_seen = high - x
    return Pair(high, (x - (high - y_seen)) + (y - y_seen))


def two_product(x: Reals, y: Reals) -> Pair:
    """Exact product of two floats as a pair (no overflow above 2^996).

    Example
        >>> high, low = two_product(np.float64(0.1), np.float64(0.1))
        >>> float(low)
        -8.326672684688674e-19

    Source
        T. J. Dekker, Numer. Math. 18 (1971) 224-242, with G. W. Veltkamp's splitting
    """
    high = x * y
    x_big, y_big = _SPLIT * x, _SPLIT * y
    x_1, y_1 = x_big - (x_big - x), y_big - (y_big - y)
    x_2, y_2 = x - x_1, y - y_1
    return Pair(high, ((x_1 * y_1 - high) + x_1 * y_2 + x_2 * y_1) + x_2 * y_2)


def add(x: Pair, y: Pair) -> Pair:
    """Sum of two pairs, to about 2^-104 of the larger; exact cancellation of the high parts is kept.

    Example
        >>> one = Pair(np.float64(1.0), np.float64(1e-20))
        >>> float(add(one, Pair(np.float64(-1.0), np.float64(0.0))).high)
        1e-20

    Source
        X. S. Li et al., ACM Trans. Math. Softw. 28 (2002) 152-205 (accurate addition)
    """
    high, low = two_sum(x.high, y.high)
    tail, rest = two_sum(x.low, y.low)
    high, low = two_sum(high, low + tail)
    return two_sum(high, low + rest)


def multiply(x: Pair, y: Pair) -> Pair:
    """Product of two pairs, to about 2^-103 of itself.

    Example
        >>> tenth = Pair(np.float64(0.1), np.float64(-5.551115123125783e-18))
        >>> float(multiply(tenth, Pair(np.float64(10.0), np.float64(0.0))).high)
        1.0

    Source
        T. J. Dekker, Numer. Math. 18 (1971) 224-242
    """
    high, low = two_product(x.high, y.high)
    return two_sum(high, low + (x.high * y.low + x.low * y.high))


def cos_sin(angle: Reals) -> tuple[Pair, Pair]:
    """Cosine and sine of floats as pairs.

    angle = k pi/16 + rest, |rest| <= pi/32; Taylor's series of the rest, then the addition theorem

    Parameters
        angle : array of any shape [rad] - up to about 1e5 in magnitude
    Returns
        cosine, sine : Pair of arrays - absolute error below 2^-104 (measured)
    Example
        >>> cosine, sine = cos_sin(np.array([1.0]))
        >>> float(sine.high[0]), float(sine.low[0])
        (0.8414709848078965, 1.776845092935536e-18)
    """
    angle = np.asarray(angle, dtype=np.float64)
    count = np.rint(angle / _STEP[0])
    rest = Pair(angle, np.zeros_like(angle))
    for part in _STEP:
        rest = add(rest, two_product(-count, np.full_like(count, part)))
    cosine, sine = _short_cos_sin(rest)
    anchor_cos, anchor_sin = _anchor(count.astype(np.int64) + 8), _anchor(count.astype(np.int64))
    minus_sine = Pair(-anchor_sin.high, -anchor_sin.low)
    return (
        add(multiply(anchor_cos, cosine), multiply(minus_sine, sine)),
        add(multiply(anchor_sin, cosine), multiply(anchor_cos, sine)),
    )


def _anchor(k: NDArray[np.int64]) -> Pair:
    """sin(k pi/16)."""
    fold = k % 16
    table = _SINES[np.minimum(fold, 16 - fold)]
    sign = np.where(k % 32 < 16, 1.0, -1.0)
    return Pair(sign * table[..., 0], sign * table[..., 1])


def _short_cos_sin(x: Pair) -> tuple[Pair, Pair]:
    """Cosine and sine of |x| <= pi/32; the terms below 2^-53 of the first are summed in single floats."""
    xx = multiply(x, x)
    y = xx.high
    sine = _horner(xx, _SIN_TERMS, _tail(y, 11))
    cosine = _horner(xx, _COS_TERMS, _tail(y, 10))
    one = Pair(np.ones_like(y), np.zeros_like(y))
    return add(one, multiply(xx, cosine)), add(x, multiply(x, multiply(xx, sine)))


def _tail(y: Reals, first: int) -> Reals:
    """The four terms of sine or cosine from x^first on, divided by x^first; y = x^2."""
    total = np.zeros_like(y)
    for n in range(first + 6, first - 1, -2):
        total = (-1.0 if n % 4 in (2, 3) else 1.0) / math.factorial(n) + y * total
    return total


def _horner(xx: Pair, terms: tuple[tuple[float, float], ...], tail: Reals) -> Pair:
    total = Pair(tail, np.zeros_like(tail))
    for high, low in reversed(terms):
        total = add(multiply(xx, total), Pair(np.full_like(tail, high), np.full_like(tail, low)))
    return total
