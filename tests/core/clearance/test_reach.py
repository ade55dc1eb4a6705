"""Reaches of axes over a motion against closed forms of a four-bar, and against brute force."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from gearlink.core.parts.linkages.fourbar.mechanism import four_bar_motion
from gearlink.core.parts.linkages.fourbar.position import FourBar
from gearlink.core.studies.clearance import reaches

BAR = FourBar(18.0, 50.0, 100.0, 121.4)
AXES = {"A": ("frame", 0j), "B": ("crank", "B"), "C": ("rocker", "C"), "D": ("rocker", "D")}


def test_links_and_the_crank_pin_in_closed_form() -> None:
    found = reaches(four_bar_motion(BAR), AXES)
    for pair, length in (("AB", 18.0), ("BC", 50.0), ("CD", 100.0), ("AD", 121.4)):
        assert (found[pair].nearest, found[pair].farthest) == pytest.approx((length, length), rel=1e-13)
    assert found["BD"].nearest == pytest.approx(BAR.frame - BAR.crank, rel=1e-13)
    assert found["BD"].farthest == pytest.approx(BAR.frame + BAR.crank, rel=1e-13)
    # crank and coupler in line: the dead centres of the rocker
    assert found["AC"].nearest == pytest.approx(BAR.coupler - BAR.crank, rel=1e-13)
    assert found["AC"].farthest == pytest.approx(BAR.coupler + BAR.crank, rel=1e-13)


def test_a_point_of_the_coupler_by_brute_force() -> None:
    motion, point = four_bar_motion(BAR), 20.0 + 15.0j
    found = reaches(motion, {"P": ("coupler", point), "Q": ("frame", 60.0 + 40.0j)}, ["PQ"])["PQ"]
    low, high = 0.0, 2.0 * np.pi
    for _ in range(4):
        phi = np.linspace(low, high, 20001)
        apart = np.abs(motion.at(phi, 0).links["coupler"].at(point).value - (60.0 + 40.0j))
        at = int(np.argmin(apart))
        low, high = phi[max(at - 1, 0)], phi[min(at + 1, phi.size - 1)]
    assert found.nearest == pytest.approx(float(apart.min()), rel=1e-12)
    assert all(one <= other for one, other in pairwise((found.nearest, float(apart.max()), found.farthest)))
