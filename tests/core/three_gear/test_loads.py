"""Loads of gears that are out of balance: they come home with their own turns, not with the crank's."""

from __future__ import annotations

import numpy as np
import pytest
from factory import design

FEED = "loaded_feed"


def test_an_eccentric_idler_comes_home_after_its_own_turns() -> None:
    """Gear 1 of 40 teeth turns the idler of 72 by 5/9 of a turn each time; 1e-12 of the greatest torque."""
    loads = design(FEED, command="loads", loads__links__idler__center=[20.0, 0.0])
    assert loads.turns == 9
    phi = np.linspace(0.0, 6.0, 40)
    here, turn, period = (loads.machine.torque(phi + at) for at in (0.0, 2.0 * np.pi, loads.machine.period))
    size = np.abs(here).max()
    assert np.abs(period - here).max() < 1e-12 * size
    assert np.abs(turn - here).max() > 1e-3 * size
    assert loads.input_torque_mean == pytest.approx(design(FEED, command="loads").input_torque_mean, abs=1e-10 * size)


def test_balanced_gears_leave_one_turn() -> None:
    assert design(FEED, command="loads", loads__links__idler__center=[0.0, 0.0]).turns == 1
    assert design(FEED, command="loads").turns == 1
