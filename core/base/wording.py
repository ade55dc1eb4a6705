"""Numbers as text in messages: four significant digits, rounded so that a comparison is never reversed."""

from __future__ import annotations

import math
import operator
from collections.abc import Sequence
from itertools import pairwise


def amount(count: float, one: str, many: str = "", spec: str = "") -> str:
    """A number with what it counts, in the singular where it is one.

    Parameters
        count : float - how many
        one, many : str - a word in the singular, and its plural where that is not formed by s
        spec : str - how the number is written, "," or "g"
    Example
        >>> amount(1, "input"), amount(2, "input"), amount(1.0, "tooth", "teeth", "g"), amount(1200, "row", spec=",")
        ('1 input', '2 inputs', '1 tooth', '1,200 rows')
    """
    return f"{count:{spec}} {one if count == 1 else many or one + 's'}"


DIGITS = 4
"""Significant digits of a number in a message."""
_MOST_IN_FULL = 1e7
_TYPED, _NOISE = 6, 1e-12
"""A limit of no more digits, but for rounding, is one that somebody wrote, and is shown as it stands."""


def first_of(names: Sequence[str], most: int = 4) -> str:
    """Names for one line of a message: all of a few, the first of many and their number.

    Example
        >>> first_of(["cam", "loads"]), first_of(["a", "b", "c", "d", "e", "f"])
        ('cam, loads', 'a, b, c, d and 2 others')
    """
    if len(names) <= most + 1:
        return ", ".join(names)
    return f"{', '.join(names[:most])} and {len(names) - most} others"


def short(value: float, digits: int = DIGITS) -> str:
    """A number to so many significant digits, the nearest.

    Example
        >>> short(221.4577), short(10412.8), short(-0.5), short(3e-9)
        ('221.5', '10410', '-0.5', '3e-09')
    """
    return plain(directed(value, 0, digits))


def plain(value: float) -> str:
    """A rounded number without needless zeros, from ten million on with an exponent.

    Example
        >>> plain(10410.0), plain(1338000000.0), plain(-0.0)
        ('10410', '1.338e9', '0')
    """
    if not _MOST_IN_FULL <= abs(value) < math.inf:
        return f"{value + 0.0:.12g}"
    mantissa, exponent = f"{value:.11e}".split("e")
    return f"{mantissa.rstrip('0').rstrip('.')}e{int(exponent)}"


def directed(value: float, way: int, digits: int = DIGITS) -> float:
    """A number rounded to so many significant digits.

    Parameters
        way : int - -1: down; 1: up; 0: to the nearest
    Example
        >>> directed(39.99999, -1), directed(40.00001, 1), directed(1.1, 1), directed(10412.8, -1)
        (39.99, 40.01, 1.1, 10410.0)
    """
    if value == 0.0 or value - value != 0.0:
        return value
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    whole, power = int(mantissa.replace(".", "")), int(exponent) - digits + 1
    near = float(f"{whole}e{power}")
    if near != value and (near > value) is (way < 0):
        whole += way
    return float(f"{whole}e{power}")


def compared(value: float, limit: float, side: str, met: bool) -> tuple[str, str]:
    """A value and the limit that it meets or not, rounded to the safe side so that what is shown says the same.

    Parameters
        side : str - ">=" or "<=", how a value that passes stands to the limit
    Example
        >>> compared(39.999999, 40.0, ">=", False), compared(40.00004, 40.00002, ">=", True)
        (('39.99', '40'), ('40.00004', '40.00002'))
    """
    way = -1 if side == ">=" else 1
    bound = float(f"{limit:.{_TYPED}g}")
    stands = operator.ge if side == ">=" else operator.le
    if limit != bound and math.isclose(limit, bound, rel_tol=_NOISE) and stands(value, bound) is stands(value, limit):
        limit = bound
    for digits in range(DIGITS, 17):
        low = directed(value, way, digits)
        high = limit if bound == limit else directed(limit, -way, digits)
        if (low >= high if side == ">=" else low <= high) is met:
            return plain(low) if digits < 12 else repr(low), plain(high) if digits < 12 else repr(high)
    return repr(value), repr(limit)


def apart(one: float, other: float) -> tuple[str, str]:
    """Two numbers to as many digits as tell them apart, at least four.

    Example
        >>> apart(1.0, 1.00001), apart(2.5, 2.5)
        (('1', '1.00001'), ('2.5', '2.5'))
    """
    for digits in range(DIGITS, 17):
        if one == other or short(one, digits) != short(other, digits):
            return short(one, digits), short(other, digits)
    return repr(one), repr(other)


def unlike(value: float, other: float) -> str:
    """A number to as many digits as tell it from another, at least four.

    Example
        >>> unlike(1.00001, 1.0), unlike(114.8527, 40.0)
        ('1.00001', '114.9')
    """
    return apart(value, other)[0]


def within(low: float, high: float, unit: str) -> str:
    """A range rounded inwards, to as many digits as leave one, at least four.

    Example
        >>> within(114.6512, 115.2338, "mm"), within(1.000011, 1.000019, "mm")
        ('114.7 to 115.2 mm', '1.000011 to 1.000019 mm')
    """
    for digits in range(DIGITS, 17):
        ends = directed(low, 1, digits), directed(high, -1, digits)
        if ends[0] < ends[1]:
            return f"{plain(ends[0])} to {in_unit(plain(ends[1]), unit)}"
    return f"{low!r} to {in_unit(repr(high), unit)}"


def ascending(values: Sequence[float], path: str, first: float | None = None, last: float | None = None) -> str:
    """The one value with which numbers ascend, in the widest steps, as a fix; empty where one is not enough.

    Parameters
        path : str - of a number, with its place in the list: "motion[{}].to"
        first, last : float - what all are above, and what the last one must be; None: nothing
    Example
        >>> ascending([90.0, 180.0, 150.0], "at[{}]"), ascending([90.0, 60.0, 30.0], "at[{}]")
        ('set at[1] to 120', '')
        >>> ascending([90.0, 400.0, 200.0, 360.0], "motion[{}].to", 0.0, 360.0)
        'set motion[1].to to 145'
    """
    found: list[tuple[float, int, float]] = []
    for i in range(len(values)):
        low = values[i - 1] if i else first
        high = last if i == len(values) - 1 else values[i + 1]
        if last is not None and i == len(values) - 1:
            value = last
        elif low is None or high is None:
            value = (low or 0.0) + 1.0 if high is None else high - 1.0
        else:
            value = 0.5 * (low + high)
        whole = [*([] if first is None else [first]), *values[:i], value, *values[i + 1 :]]
        steps = [after - before for before, after in pairwise(whole)]
        if min(steps) > 0.0 and last in (None, whole[-1]):
            found.append((min(steps), i, value))
    if not found:
        return ""
    _, i, value = max(found)
    return f"set {path.format(i)} to {value:.9g}"


def in_unit(number: str, unit: str) -> str:
    """A number with its unit; one without a dimension alone."""
    return number if unit == "1" else f"{number} {unit}"
