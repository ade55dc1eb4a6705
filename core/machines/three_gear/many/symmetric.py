"""Roots of the symmetric family (I = 1, equal gears 1 and 5) for arrays of designs; its closed forms: `family`.

With n = 1 - i3 and h = phi12/2, as in `symmetric.back_step`. Its equation stands here again, with derivatives: there it
is an integral where h is small and has none, and one form for both takes a single design 1.2 to 1.4 times as long.
Roots are Newton's inside a bracket; a design that rests is frozen, so that its last bit does not depend on its
neighbours.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gearlink.core.numerics.arrays import Mask, Reals
from gearlink.core.numerics.roots_sweep import newton_roots

_QUARTER = 0.5 * math.pi


def half_angle_for_dwell(n: Reals, phi13: Reals) -> Reals:
    """h = phi12/2 [rad] whose dwell angle is phi13.

    n [asin(k sin(y)) + asin(k sin(h))] = phi13,   y = phi13 - h

    Source
        thesis (4-16), as `back_step.crank_angle_for_dwell`
    """
    return newton_roots(_missing_dwell, 0.25 * phi13, np.minimum(0.5 * phi13, _QUARTER), phi13 / 3.0, n, phi13)


def _missing_dwell(h: Reals, n: Reals, phi13: Reals) -> tuple[Reals, Reals]:
    """The equation of `half_angle_for_dwell`, and its derivative with respect to h."""
    y = phi13 - h
    sin_h, cos_h, sin_y, cos_y = np.sin(h), np.cos(h), np.sin(y), np.cos(y)
    rest = n * n - 1.0
    square = rest * cos_h * cos_h + cos_y * cos_y
    root = np.sqrt(square)
    value = n * (np.arctan2(sin_y, root) + np.arctan2(sin_h, n * cos_h)) - phi13
    whole = square + sin_y * sin_y
    slope = (n * sin_y * rest * cos_h * sin_h / whole - n * cos_y) / root + n * n / whole
    return value, slope


def dwell_angle(n: Reals, h: Reals) -> Reals:
    """phi13 [rad] of a back-step over 2 h: the same equation solved for y.

    Source
        as `back_step.dwell_angle`
    """
    limit = 2.0 * math.pi * n / (n + 1.0)
    high = np.minimum(3.0 * h, limit - h)
    # At y = h the value is least: beyond it it rises, and the root lies at about 2 h.
    return h + newton_roots(_regained, h, high, np.minimum(2.0 * h, high), n, h)


def half_angle_for_window(n: Reals, window: Reals) -> Reals:
    """h [rad] of the back-step whose band the output touches twice over a window [rad]: y = window/2 is given.

    Source
        as `back_step.crank_angle_for_window`
    """
    y = 0.5 * window
    return newton_roots(_missing_window, y / 3.0, np.minimum(y, _QUARTER), np.minimum(0.5 * y, 0.9 * _QUARTER), n, y)


def _missing_window(h: Reals, n: Reals, y: Reals) -> tuple[Reals, Reals]:
    """What `_regained` gives, of the other sign, and its derivative with respect to h."""
    sin_h, cos_h, sin_y, cos_y = np.sin(h), np.cos(h), np.sin(y), np.cos(y)
    rest = n * n - 1.0
    root = np.sqrt(rest * cos_h * cos_h + cos_y * cos_y)
    value = n * (np.arctan2(sin_y, root) + np.arctan2(sin_h, n * cos_h)) - h - y
    whole = rest * cos_h * cos_h + 1.0
    return value, n * sin_y * rest * cos_h * sin_h / (root * whole) + n * n / whole - 1.0


def longest_window(n: Reals, h: Reals) -> Reals:
    """2 phi13 - phi12 [rad] of a back-step over 2 h: the window over which the output stays within it."""
    return 2.0 * (dwell_angle(n, h) - h)


def _regained(y: Reals, n: Reals, h: Reals) -> tuple[Reals, Reals]:
    """How far the output at 270 deg + y stands above its place at 270 deg - h, and its speed there."""
    sin_h, cos_h, sin_y, cos_y = np.sin(h), np.cos(h), np.sin(y), np.cos(y)
    root = np.sqrt((n * n - 1.0) * cos_h * cos_h + cos_y * cos_y)
    value = h + y - n * (np.arctan2(sin_y, root) + np.arctan2(sin_h, n * cos_h))
    return value, 1.0 - n * cos_y / root


def half_angle_for_back_step(n: Reals, angle: Reals) -> Reals:
    """h [rad] whose back-step is `angle` [rad].

    2 n atan(tan(h)/n) - 2 h = angle

    Source
        thesis (4-19), as `back_step.crank_angle_for_back_step`
    """
    start = np.minimum(np.cbrt(1.5 * angle / (1.0 - 1.0 / (n * n))), 0.9 * _QUARTER)
    return newton_roots(_missing_back_step, np.zeros(n.shape), np.full(n.shape, _QUARTER), start, n, angle)


def _missing_back_step(h: Reals, n: Reals, angle: Reals) -> tuple[Reals, Reals]:
    sin_h, cos_h = np.sin(h), np.cos(h)
    value = 2.0 * (n * np.arctan2(sin_h, n * cos_h) - h) - angle
    whole = n * n * cos_h * cos_h + sin_h * sin_h
    return value, 2.0 * (n * n - 1.0) * sin_h * sin_h / whole


def back_step(n: Reals, h: Reals) -> Reals:
    """The back-step [rad] over 2 h (thesis (4-19))."""
    return np.asarray(2.0 * (n * np.arctan2(np.sin(h), n * np.cos(h)) - h))


def in_range(value: Reals, low: Any, high: Any) -> Mask:
    """Where low < value < high."""
    return np.asarray((low < value) & (value < high))
