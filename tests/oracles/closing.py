"""Crank angles at which a four-bar closes, by the signs of its loop's two squares."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearlink.core.parts.linkages.fourbar.position import FourBar


def assembles(linkage: FourBar, crank_angle: ArrayLike) -> NDArray[np.bool_]:
    """Whether the linkage closes, for every crank angle of an array."""
    half = 0.5 * np.asarray(crank_angle, dtype=np.float64)
    reading, cc, ss = linkage.reading, np.cos(half) ** 2, np.sin(half) ** 2
    p = reading.p_0 * cc + reading.p_pi * ss
    q = reading.q_0 * cc + reading.q_pi * ss
    return np.asarray((p >= 0.0) & (q >= 0.0))
