"""Angles in blocks: the same bits as all at once."""

from __future__ import annotations

import numpy as np
import pytest

from gearlink.core.errors import NoSolution
from gearlink.core.numerics.blocks import BLOCK, turn_blocks
from gearlink.core.three_gear.sweep import turn


@pytest.mark.parametrize("samples", [1, 7, BLOCK, BLOCK + 1, 3 * BLOCK])
def test_blocks_make_up_the_turn(samples: int) -> None:
    blocks = list(turn_blocks(samples))
    assert all(phi.size == BLOCK for phi in blocks[:-1])
    assert np.array_equal(np.concatenate(blocks), turn(samples))


def test_blocks_are_made_as_they_are_asked_for() -> None:
    step = 2.0 * np.pi / 10**15
    assert next(turn_blocks(10**15, 4)).tolist() == [0.0, step, 2.0 * step, 3.0 * step]


@pytest.mark.parametrize(("samples", "block"), [(0, 8), (-1, 8), (8, 0)])
def test_no_angles_are_refused_at_once(samples: int, block: int) -> None:
    with pytest.raises(NoSolution, match="at least 1"):
        turn_blocks(samples, block)
