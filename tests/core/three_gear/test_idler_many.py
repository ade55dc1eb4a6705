"""What the choice of idlers over arrays rests on: in the symmetric family those that keep the limits have no gaps."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from gearlink.core.machines.three_gear import symmetric
from gearlink.core.machines.three_gear.axis import Tried, smallest_idlers
from gearlink.core.numerics.elementary_sweep import ARRAYS

N = 1.0 + np.geomspace(1e-3, 50.0, 4000)  # of 1 tooth to 1000, up to 400 to 8


def of_dwell(degrees: float) -> Any:
    reached = 2.0 * math.pi * N / (N + 1.0) > math.radians(degrees) * (1.0 + 1e-9)
    n = N[reached]
    return symmetric.frame_ratio(
        1.0 - n, symmetric.half_angle_for_dwell(n, np.full(n.shape, math.radians(degrees)), ARRAYS), ARRAYS
    )


def of_back_step(degrees: float) -> Any:
    n = N[math.pi * (N - 1.0) > math.radians(degrees) * (1.0 + 1e-9)]
    return symmetric.frame_ratio(
        1.0 - n, symmetric.half_angle_for_back_step(n, np.full(n.shape, math.radians(degrees)), ARRAYS), ARRAYS
    )


@pytest.mark.quick(3)
@pytest.mark.parametrize("degrees", [1.0, 30.0, 90.0, 135.0, 179.0, 181.0, 240.0, 300.0, 340.0])
@pytest.mark.parametrize("family", [of_dwell, of_back_step])
def test_the_frame_ratio_rises_with_the_idler(family: Any, degrees: float) -> None:
    found = family(degrees)
    assert found.size > 50
    assert (np.diff(found) > 0.0).all()


def test_the_frame_ratio_of_a_speed_band_rises_with_the_idler() -> None:
    found = symmetric.frame_ratio_between(1.0 - N, np.full(N.shape, 20.0), np.full(N.shape, 21.0), ARRAYS)
    assert (np.diff(found) > 0.0).all()


def trial_of(least: Any, clear_from: Any) -> Any:
    def trial(teeth: Any, places: Any) -> Tried:
        return Tried(teeth >= least[places], teeth >= clear_from[places], teeth == 60.0)

    return trial


@pytest.mark.parametrize("rising", [True, False])
def test_edges_of_the_range(rising: bool) -> None:
    least = np.array([1.0, 17.0, 18.0, 399.0, 400.0, 401.0])
    found = smallest_idlers(trial_of(least, least), 6, rising=rising, shafts=False)
    assert np.array_equal(found.teeth, [17.0, 17.0, 18.0, 399.0, 400.0, np.nan], equal_nan=True)


@pytest.mark.parametrize("rising", [True, False])
def test_shafts_do_not_count_where_no_idler_clears_them(rising: bool) -> None:
    least, clear = np.array([50.0, 50.0, 401.0]), np.array([90.0, 401.0, 17.0])
    found = smallest_idlers(trial_of(least, clear), 3, rising=rising, shafts=True)
    assert np.array_equal(found.teeth, [90.0, 50.0, np.nan], equal_nan=True)
    assert found.doubtful[0]  # 60 teeth came next to a limit on the way
