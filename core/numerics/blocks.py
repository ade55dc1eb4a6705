"""Crank angles in blocks: more positions than memory holds, for any function of arrays of angles."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from gearlink.core.errors import NoSolution
from gearlink.core.numerics.arrays import Reals

# The intermediate arrays of a block stay in the cache; above 8192 complex numbers the C library maps and clears new
# pages for each of them, which doubles the time.
BLOCK = 8000


def turn_blocks(samples: int, block: int = BLOCK) -> Iterator[Reals]:
    """Angles that divide the turn into equal steps, from 0, a block at a time.

    Parameters
        samples : int - angles of the whole turn, at least 1
        block : int - angles of a block, at least 1; the last block may be shorter
    Returns
        blocks : iterator of (block,) arrays [rad] - together the angles of `gear_linkage_sweep.turn`, to the last bit
    Raises
        NoSolution - for fewer than one sample, or blocks of fewer than one
    Notes
        What a block leads to may be dropped before the next: memory is that of one block, whatever the samples. Time
        per position of the four-bar, the three-gear four-bar and the cam profile is the same for 1e5 and 1e7.
    Example
        >>> from gearlink.core.linkages.fourbar import FourBar
        >>> from gearlink.core.linkages.fourbar_sweep import solve
        >>> linkage = FourBar(18.0, 50.0, 100.0, 121.4)
        >>> fastest = max(solve(linkage, phi, 1).rocker_velocity.max() for phi in turn_blocks(100_000))
        >>> round(float(fastest), 6)
        0.212891
    """
    if samples < 1 or block < 1:
        raise NoSolution(f"{samples} samples in blocks of {block} divide no turn; take at least 1 of both")
    return _blocks(samples, block)


def _blocks(samples: int, block: int) -> Iterator[Reals]:
    step = 2.0 * math.pi / samples
    for start in range(0, samples, block):
        yield np.arange(start, min(start + block, samples), dtype=np.float64) * step
