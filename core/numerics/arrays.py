"""Types of the arrays that kernels take and give, and the angles of a table's rows."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from gearlink.core.numerics.rows import row_numbers

Reals: TypeAlias = NDArray[np.float64]
Points: TypeAlias = NDArray[np.complex128]
"""Points or vectors of the plane, x + i y."""
Mask: TypeAlias = NDArray[np.bool_]


def turn_degrees(samples: int | None = None, turns: int = 1) -> Reals:
    """Angles that divide turns into equal steps, from 0.

    Parameters
        samples : int - angles of a turn, 360 where none are given; `Rows`: a part of all angles
        turns : int
    Returns
        angles : (samples * turns,) array [deg], or the part
    Example
        >>> turn_degrees(3).tolist()
        [0.0, 120.0, 240.0]
    """
    count = (samples or 360) * turns
    rows = row_numbers(samples, count)
    angles: Reals = np.arange(rows.start, rows.stop, dtype=np.float64) * (360.0 * turns / count)
    return angles
