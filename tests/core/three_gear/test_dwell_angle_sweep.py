"""Dwell angles of many designs at once against 40 digits.

ULPS: the last step takes F without cancellation and rounds some twenty times; 3.3 ulp of phi13 were seen in 1500
designs, so 6 are allowed. For i3 above -0.5 the symmetric design tends to a drive without back-step: the terms of
F cancel 1/|i3| to one, and the error grows alike.
"""

from __future__ import annotations

import math

import mpmath as mp
import numpy as np
import pytest
from sweeps import ALL

from gearlink.core.three_gear.dwell_angle_sweep import regained
from gearlink.core.three_gear.sweep import dwell_angles
from gearlink.core.three_gear.symmetric_back_step import dwell_angle

ULPS = 6.0


def exact(i3: float, h: float, near: float) -> mp.mpf:
    """phi13 in 40 digits."""
    with mp.workdps(40):
        n, half = 1 - mp.mpf(i3), mp.mpf(h)
        rest = (n * n - 1) * mp.cos(half) ** 2

        def f(y: mp.mpf) -> mp.mpf:
            return n * (mp.atan2(mp.sin(y), mp.sqrt(rest + mp.cos(y) ** 2)) + mp.atan(mp.tan(half) / n)) - half - y

        start = mp.mpf(near) - half
        return half + mp.findroot(f, (start * (1 + mp.mpf(10) ** -8), start * (1 - mp.mpf(10) ** -8)), tol=1e-60)


def ulps(found: float, true: mp.mpf) -> float:
    return float(abs(mp.mpf(found) - true) / mp.mpf(math.ulp(float(true))))


@pytest.mark.quick(2)
@pytest.mark.parametrize(
    ("i3", "h"), [((-4.0, -0.5), (0.1, 1.55)), ((-4.0, -0.5), (1e-5, 0.1)), ((-100.0, -4.0), (0.01, 1.5))]
)
def test_dwell_angles_keep_their_digits(i3: tuple[float, float], h: tuple[float, float]) -> None:
    rng = np.random.default_rng(1)
    ratio, half = rng.uniform(*i3, 50), rng.uniform(*h, 50)
    found = dwell_angles(ratio, 2.0 * half)
    worst = max(ulps(float(p), exact(float(a), float(b), float(p))) for a, b, p in zip(ratio, half, found, strict=True))
    assert worst <= ULPS


def test_slow_ratios_lose_in_proportion() -> None:
    for i3 in (-0.3, -0.03, -0.003):
        for h in (0.05, 0.3, 1.2):
            found = float(dwell_angles(i3, 2.0 * h))
            assert ulps(found, exact(i3, h, found)) <= ULPS / abs(i3)


def test_every_design_of_a_wide_field_has_an_answer_inside_its_bracket() -> None:
    rng = np.random.default_rng(2)
    count = 20_000 if ALL else 4_000
    ratio, h = -(10.0 ** rng.uniform(-6, 4, count)), 10.0 ** rng.uniform(-6, math.log10(1.57), count)
    found = dwell_angles(ratio, 2.0 * h)
    # the bracket's ends are rounded too
    assert np.all((found >= 2.0 * h * (1 - 1e-14)) & (found <= 4.0 * h * (1 + 1e-14)))


def test_single_designs_agree_with_the_scalar_way() -> None:
    for i3 in (-0.7, -1.8, -3.0):
        for phi12 in (0.4, 1.5, 2.9):
            # two ways with a few roundings each
            assert float(dwell_angles(i3, phi12)) == pytest.approx(dwell_angle(i3, phi12), rel=2e-14, abs=0.0)


def test_blocks_join_without_a_seam() -> None:
    ratio, h = np.full(20_001, -1.8), np.linspace(0.01, 1.5, 20_001)
    y, settled = regained(ratio, h)
    assert settled.all()
    assert np.all(np.diff(y) > 0.0)
    alone = regained(ratio[8000:8400], h[8000:8400])[0]
    assert np.allclose(y[8000:8400], alone, rtol=1e-15, atol=0.0)  # a block stops stepping when all of it rests
