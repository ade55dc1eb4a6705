"""The functions of `gearlink.core.parts.gears.tooth.functions` for arrays; what one number refuses is NaN here."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from gearlink.core.base.errors import NoSolution
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.elementary_sweep import FUNCTIONS
from gearlink.core.parts.gears.tooth.functions import GearFunctions


def _involute(alpha: Any) -> Any:
    angles = np.asarray(alpha, dtype=float)
    good = np.abs(angles) < 0.5 * math.pi
    if good.all():
        return involute(angles)
    return np.where(good, involute(np.where(good, angles, 0.0)), np.nan)


def _inverse_involute(v: Reals) -> Reals:
    good = (v >= 0.0) & (v < math.inf)
    if good.all():
        return inverse_involute(v)
    return np.where(good, inverse_involute(np.where(good, v, 0.0)), np.nan)


def _involute_rise(alpha: Any, rise: Any) -> Any:
    return _involute(rise) + np.tan(rise) * np.tan(alpha) * np.tan(alpha + rise)


def _rise_of_involute(alpha: Any, difference: Any) -> Any:
    rise = _inverse_involute(np.asarray(_involute(alpha) + difference)) - alpha
    finer = rise
    for _ in range(2):
        finer = finer - (_involute_rise(alpha, finer) - difference) / np.tan(alpha + finer) ** 2
    return np.where(np.abs(rise) > 0.5 * alpha, rise, finer)


ARRAYS = GearFunctions(
    **FUNCTIONS, involute=_involute, involute_rise=_involute_rise, rise_of_involute=_rise_of_involute
)


_BLOCK = 8192
_SPLIT = 2.0**36 + 1.0  # leaves the upper 17 bits of a double: their cube is exact
_DIRECT = 0.9  # from here on tan(a) - a loses less than the rational form gains
_LAST = 2.0  # the rational forms of the inverse end here

# (inv a)/(a^3/3) = 1 + w N(w)/D(w), w = a^2: relative error 2e-16 of the second term for a <= 1
_CUBIC_TOP = (0.00025617902645565054, -0.02383080179654133, 0.39999999999999997)
_CUBIC_BOTTOM = (-0.00025623292284188164, 0.02456598490947275, -0.46433890925326576, 1.0)
# alpha/c, c = cbrt(3 v), as a function of c^2: relative error 3e-9 for v <= 2
_START_TOP = (0.000510174231457081, 0.030806259854765993, 0.2164747465587811, 0.9999999977766952)
_START_BOTTOM = (0.0038231201481075134, 0.060304900663855875, 0.34980800147156677, 1.0)
# (pi^2/4 - w) (inv a)/a^3, w = a^2: relative error 6e-18 for a <= 1.28
_POLE_TOP = (0.0006460240453031124, -0.05377753195692445, 0.8224670334241132)
_POLE_BOTTOM = (2.519912699940214e-10, 7.151751063605589e-08, 0.0006769856505923604, -0.06010090372552, 1.0)


def involute(alpha: ArrayLike) -> Reals:
    """Involutes of many pressure angles.

    inv(alpha) = tan(alpha) - alpha

    Parameters
        alpha : float array of any shape [rad] - -pi/2 < alpha < pi/2
    Returns
        v : float array of that shape [rad] - odd in alpha
    Raises
        NoSolution - when an angle lies beyond +-90 deg or is no number
    Notes
        tan(a) - a from 0.9 rad on, below it a rational form with the cube of the angle's upper 17 bits kept
        exact. Measured against 50 digits: 2.1 ulp or better; 5 to 10 ns a value.
    Example
        >>> involute([0.0, 0.35])
        array([0.        , 0.01502849])

    Source
        TY-460 report 1.1; rational form fitted for this program
    """
    angles = np.asarray(alpha, dtype=np.float64)
    if angles.size and not np.abs(angles).max() < math.pi / 2:
        worst = angles.flat[int(np.argmax(~(np.abs(angles) < math.pi / 2)))]
        raise NoSolution(f"pressure angle: {math.degrees(worst):.4g} deg (within -90 and 90 deg: no involute)")
    return _in_blocks(_involute_block, angles, 4)


def inverse_involute(v: ArrayLike) -> Reals:
    """Pressure angles of many involutes.

    tan(alpha) - alpha = v

    Parameters
        v : float array of any shape [rad] - v >= 0
    Returns
        alpha : float array of that shape [rad] - 0 <= alpha < pi/2; exactly 0 at 0
    Raises
        NoSolution - when a value is negative, infinite or no number
    Notes
        Up to v = 2 a rational start in cbrt(3 v), good to 3e-9, and one Newton step with the derivative
        tan^2(alpha); beyond it alpha = atan(v + alpha). Measured against 50 digits: 1.7 ulp or better;
        about 7 ns a value up to v = 2, 17 where larger ones are mixed in. Below v = 1e-300, where the cube
        underflows, the start's own error remains.
    Example
        >>> inverse_involute([0.0, 0.0149, 10.0])
        array([0.        , 0.34903275, 1.48393727])

    Source
        own derivation; rational forms fitted for this program
    """
    values = np.asarray(v, dtype=np.float64)
    if not values.size:
        return np.empty(values.shape)
    if not (values.min() >= 0.0 and values.max() < math.inf):
        worst = values.flat[int(np.argmax(~((values >= 0.0) & (values < math.inf))))]
        raise NoSolution(
            f"involute of the pressure angle: {worst:.4g} (limit >= 0)",
            fix="raise the sum of the profile shifts, or the centre distance",
        )
    if values.max() <= _LAST:
        return _in_blocks(_inverse_block, values, 4)
    low = values <= _LAST
    alpha = np.empty(values.shape)
    alpha[low] = _in_blocks(_inverse_block, values[low], 4)
    alpha[~low] = _inverse_near_pole(values[~low])
    return alpha


def _in_blocks(kernel: Callable[..., None], values: Reals, buffers: int) -> Reals:
    """Run a kernel over blocks of the flattened array; its buffers are made once."""
    flat = np.ascontiguousarray(values).reshape(-1)
    result = np.empty(flat.size)
    space = np.empty((buffers, min(_BLOCK, flat.size)))
    for first in range(0, flat.size, _BLOCK):
        block = flat[first : first + _BLOCK]
        kernel(block, result[first : first + _BLOCK], *space[:, : block.size])
    return result.reshape(values.shape)


def _polynomial(coefficients: tuple[float, ...], x: Reals, out: Reals) -> Reals:
    """Horner's rule in place, highest power first."""
    np.multiply(x, coefficients[0], out=out)
    out += coefficients[1]
    for c in coefficients[2:]:
        out *= x
        out += c
    return out


def _involute_block(a: Reals, out: Reals, w: Reals, second: Reals, p: Reals, q: Reals) -> None:
    np.multiply(a, a, out=w)
    _polynomial(_CUBIC_TOP, w, second)
    second /= _polynomial(_CUBIC_BOTTOM, w, p)
    second *= w
    np.multiply(a, _SPLIT, out=p)
    np.subtract(p, a, out=q)
    p -= q  # the upper part of a
    np.subtract(a, p, out=q)
    np.add(a, p, out=out)
    out *= p
    out += w
    out *= q  # a^3 less the cube of the upper part
    out *= 1.0 / 3.0
    np.multiply(p, p, out=w)
    w *= p
    w /= 3.0
    np.add(w, out, out=p)
    p *= second
    out += p
    out += w
    np.abs(a, out=q)
    if q.max() >= _DIRECT:
        np.tan(a, out=w)
        w -= a
        np.copyto(out, w, where=q >= _DIRECT)


def _inverse_block(v: Reals, out: Reals, w: Reals, p: Reals, q: Reals, inv: Reals) -> None:
    np.multiply(v, 3.0, out=q)
    np.cbrt(q, out=out)
    np.multiply(out, out, out=w)
    out *= _polynomial(_START_TOP, w, p)
    out /= _polynomial(_START_BOTTOM, w, p)
    np.multiply(out, out, out=w)
    _polynomial(_POLE_TOP, w, inv)
    inv *= w
    inv *= out
    _polynomial(_POLE_BOTTOM, w, p)
    np.subtract(math.pi**2 / 4.0, w, out=q)
    p *= q
    inv /= p
    np.add(inv, out, out=p)  # tan(alpha)
    p *= p
    p += 1e-300  # v = 0: a step of 0/1e-300 instead of 0/0
    inv -= v
    inv /= p
    out -= inv


def _inverse_near_pole(v: Reals) -> Reals:
    alpha = np.arctan(v + 1.3)
    for _ in range(3):
        tangent = v + alpha
        alpha -= (alpha - np.arctan(tangent)) * (1.0 + 1.0 / tangent / tangent)
    return np.asarray(np.arctan(v + alpha))
