"""Changes of sign over a period, against closed forms.

Tolerance: four spacings of the period, to which brackets are narrowed, or what the rounding of the function leaves.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.roots_sweep import zeros, zeros_of
from gearlink.core.studies.loads.machine import TURN

_NEAR = 4.0 * float(np.spacing(TURN))


class Counted:
    """A function that knows at how many arrays and places it was asked."""

    def __init__(self, f: Callable[[Reals], Reals]) -> None:
        self.f, self.rounds, self.places = f, 0, 0

    def __call__(self, phi: Reals) -> Reals:
        self.rounds, self.places = self.rounds + 1, self.places + phi.size
        return self.f(phi)


def test_smooth_zeros_take_few_rounds() -> None:
    f = Counted(lambda phi: np.cos(3.0 * phi - 0.2))
    assert zeros(f, TURN) == pytest.approx([(0.2 + (i + 0.5) * math.pi) / 3.0 for i in range(6)], abs=_NEAR)
    assert f.rounds <= 9


def test_a_jump_is_found_by_halving_and_what_is_smooth_rests_meanwhile() -> None:
    f = Counted(lambda phi: np.where(phi < 2.0, -1.0, 1.0) * np.cos(0.5 * phi - 0.3))
    found = zeros(f, TURN)
    assert found == pytest.approx([2.0, math.pi + 0.6], abs=_NEAR)
    assert f.rounds > 30
    assert f.places < 721 + 80


def test_a_jump_that_is_known_is_not_sought() -> None:
    f = Counted(lambda phi: np.where(phi < 2.0, -1.0, 1.0) + 0.0 * phi)
    assert zeros_of([f], TURN, jumps=[2.0])[0] == pytest.approx([2.0], abs=8.0 * _NEAR)
    assert f.rounds <= 6


def test_a_jump_beside_where_it_was_said_to_be_is_found() -> None:
    f = Counted(lambda phi: np.where(phi < 2.0 + 1e-9, -1.0, 1.0) + 0.0 * phi)
    assert zeros_of([f], TURN, jumps=[2.0])[0] == pytest.approx([2.0 + 1e-9], abs=_NEAR)


def test_end_of_a_dwell_is_where_the_function_leaves_zero() -> None:
    def f(phi: Reals) -> Reals:
        return np.where(phi < 1.0, 0.0, np.where(phi > 4.0, 0.0, np.sin((phi - 1.0) * math.pi / 3.0) ** 3))

    lasting = [place for place in zeros(f, TURN) if place < 3.0]
    assert lasting == pytest.approx([1.0], abs=1e-9)  # a share of 1e-27 of the maximum value beyond it
    anywhere = zeros_of([f], TURN, any_zero=True)[0][0]
    assert float(f(np.array([anywhere]))[0]) == pytest.approx(0.0, abs=1e-20)
