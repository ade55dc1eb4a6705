"""Landen's transformation against mpmath.

Tolerances: K a few ulp (each rung rounds once); F 8 ulp relative; am 4 ulp of pi/2 absolute, since the amplitude
is formed from angles of that size; cn relative 1e-16/sqrt(k') at K/2, where its two branches meet.
"""

from __future__ import annotations

import math

import mpmath as mp
import numpy as np
import pytest

from gearlink.core.base.errors import NoSolution
from gearlink.core.numerics.elliptic import (
    amplitude,
    complete_integral,
    incomplete_integral,
    jacobi_sn_cn,
    landen_ladder,
)

ULP = 2.0**-52
COMPLEMENTS = [1.0, 0.999, 0.6, 1e-3, 1e-8]


def modulus(complement: float) -> float:
    return math.sqrt((1.0 - complement) * (1.0 + complement))


@pytest.mark.parametrize("complement", [*COMPLEMENTS, 1e-15])
def test_complete_integral(complement: float) -> None:
    with mp.workdps(60):
        exact = float(mp.ellipk(1 - mp.mpf(complement) ** 2))
    assert complete_integral(complement) == pytest.approx(exact, rel=3 * ULP)


@pytest.mark.parametrize("complement", COMPLEMENTS)
def test_incomplete_integral_and_its_inverse(complement: float) -> None:
    phi = np.array([1e-9, 1e-3, 0.3, 1.0, 1.5])
    values = incomplete_integral(np.sin(phi), np.cos(phi), modulus(complement), complement)
    with mp.workdps(40):
        exact = [float(mp.ellipf(mp.mpf(x), 1 - mp.mpf(complement) ** 2)) for x in phi.tolist()]
    np.testing.assert_allclose(values, exact, rtol=8 * ULP)
    np.testing.assert_allclose(amplitude(values, modulus(complement), complement), phi, rtol=0, atol=4 * ULP)


@pytest.mark.parametrize("complement", [0.999, 0.6, 1e-3, 1e-8])
def test_sn_cn_keep_relative_accuracy_at_both_ends(complement: float) -> None:
    quarter = complete_integral(complement)
    z = quarter * np.array([1e-6, 0.2, 0.5, 0.8, 1.0 - 2.0**-20])
    sn, cn = jacobi_sn_cn(z, modulus(complement), complement)
    with mp.workdps(40):
        m = 1 - mp.mpf(complement) ** 2
        exact_sn = [float(mp.ellipfun("sn", mp.mpf(x), m=m)) for x in z.tolist()]
        exact_cn = [float(mp.ellipfun("cn", mp.mpf(x), m=m)) for x in z.tolist()]
    np.testing.assert_allclose(sn, exact_sn, rtol=8 * ULP)
    # z itself is rounded: near K its last bit moves cn by quarter * ulp / (K - z)
    condition = 1.0 + np.abs(z) / np.maximum(quarter - z, 1e-30)
    error = np.abs(cn - exact_cn) / np.abs(exact_cn)
    assert np.all(error <= 4 * ULP * (condition + 1.0 / math.sqrt(complement)))


@pytest.mark.parametrize("complement", [0.0, -0.1, 1.5, math.nan])
def test_modulus_outside_its_range(complement: float) -> None:
    with pytest.raises(NoSolution, match=r"complementary modulus .* \(0, 1\]"):
        landen_ladder(0.5, complement)


def test_columns_of_moduli_give_a_row_for_each() -> None:
    angles, complements = np.linspace(0.0, 0.5 * math.pi, 9), np.array([[each] for each in COMPLEMENTS])
    moduli = np.array([[modulus(each)] for each in COMPLEMENTS])
    found = incomplete_integral(np.sin(angles), np.cos(angles), moduli, complements)  # type: ignore[arg-type]
    for row, complement in zip(found, COMPLEMENTS, strict=True):
        alone = incomplete_integral(np.sin(angles), np.cos(angles), modulus(complement), complement)
        np.testing.assert_allclose(row, alone, rtol=8 * ULP)
