"""Elliptic integrals and amplitude by Landen's transformation, in numpy alone (scipy.special costs start-up time).

The complementary modulus k' is the argument everywhere: k near 1, where 1 - k^2 would lose it, is the case that
the unloading devices need.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.numerics.arrays import Reals


@lru_cache(maxsize=16)
def landen_ladder(modulus: float, complement: float) -> tuple[tuple[float, float, float], ...]:
    """Arithmetic-geometric means (a, b, c) from a = 1, b = k', c = k down to c = 0 at rounding.

    a_{n+1} = (a + b)/2, b_{n+1} = sqrt(a b), c_{n+1} = c^2/(4 a_{n+1})

    Parameters
        modulus, complement : float - k in [0, 1) and k' in (0, 1], k^2 + k'^2 = 1
    Returns
        ladder : tuple of (a, b, c)
    Raises
        NoSolution - when k' is not in (0, 1]
    Notes
        c from its own recurrence keeps its digits where (a - b)/2 would lose them; 11 rungs for k' = 1e-15.
    Example
        >>> len(landen_ladder(0.8, 0.6))
        6

    Source
        Abramowitz and Stegun 17.6
    """
    if not 0.0 < complement <= 1.0:
        raise NoSolution(f"the complementary modulus is {complement:.6g}; it must lie in (0, 1]")
    ladder = [(1.0, complement, modulus)]
    while ladder[-1][2] > 1e-17 * ladder[-1][0]:
        a, b, c = ladder[-1]
        mean = 0.5 * (a + b)
        ladder.append((mean, math.sqrt(a * b), c * c / (4.0 * mean)))
    return tuple(ladder)


def complete_integral(complement: float) -> float:
    """Complete elliptic integral of the first kind, K = pi/(2 agm(1, k')).

    Parameters
        complement : float - complementary modulus k' in (0, 1]
    Raises
        NoSolution - when k' is not in (0, 1]
    Notes
        Two ulp for every k'.
    Example
        >>> round(complete_integral(math.sqrt(0.5)), 12)
        1.854074677301

    Source
        Abramowitz and Stegun 17.6.3
    """
    ladder = landen_ladder(math.sqrt((1.0 - complement) * (1.0 + complement)), complement)
    return math.pi / (2.0 * ladder[-1][0])


def _ladder(modulus: float, complement: float) -> Sequence[tuple[float, float, float]]:
    """The ladder of a modulus; of a column of them one of columns, where last rungs are repeated if some have more."""
    if not isinstance(modulus, np.ndarray):
        return landen_ladder(modulus, complement)
    pairs = zip(modulus.ravel().tolist(), np.ravel(complement).tolist(), strict=True)
    ladders = [landen_ladder(*pair) for pair in pairs]
    most = max(map(len, ladders))
    rungs = np.array([(*ladder, *ladder[-1:] * (most - len(ladder))) for ladder in ladders])
    return [tuple(rungs[:, rung, i, None] for i in range(3)) for rung in range(most)]


def incomplete_integral(sine: Reals, cosine: Reals, modulus: float, complement: float) -> Reals:
    """Incomplete elliptic integral of the first kind F(phi, k) for amplitudes of the first quadrant.

    tan(phi_{n+1} - phi_n) = (b/a) tan phi_n, F = phi_n/(2^n a_n)

    Parameters
        sine, cosine : (N,) arrays - proportional to sin phi and cos phi, both >= 0
        modulus, complement : float - k and k'; of columns a row for each
    Returns
        F : (N,) array
    Notes
        Landen's rising amplitudes. Every term is positive, so the relative error stays at a few ulp, also for
        small phi; the pair instead of the angle keeps the digits of cos(phi) near pi/2.
    Example
        >>> incomplete_integral(np.array([0.0, 1.0]), np.array([1.0, 0.0]), 0.8, 0.6).round(12).tolist()
        [0.0, 1.995302777665]

    Source
        Abramowitz and Stegun 17.6.8
    """
    ladder = _ladder(modulus, complement)
    phi = np.arctan2(sine, cosine)
    for a, b, _ in ladder[:-1]:
        step = np.arctan2(b * sine, a * cosine)
        phi = phi + step + 2.0 * math.pi * np.round((phi - step) / (2.0 * math.pi))
        sine, cosine = np.sin(phi), np.cos(phi)
    return phi / (2.0 ** (len(ladder) - 1) * ladder[-1][0])


def amplitude(z: Reals, modulus: float, complement: float) -> Reals:
    """Jacobi's amplitude am(z, k), the inverse of the incomplete integral.

    Parameters
        z : (N,) array - argument, 0 to K
        modulus, complement : float - k and k'
    Returns
        phi : (N,) array [rad]
    Notes
        Absolute error a few ulp; see `jacobi_sn_cn` for relative accuracy of cos(phi) near K.
    Example
        >>> amplitude(np.array([0.0, 1.995302777664730]), 0.8, 0.6).round(12).tolist()
        [0.0, 1.570796326795]

    Source
        Abramowitz and Stegun 16.4
    """
    ladder = landen_ladder(modulus, complement)
    phi = 2.0 ** (len(ladder) - 1) * ladder[-1][0] * np.asarray(z, dtype=np.float64)
    for a, b, c in ladder[:0:-1]:
        sine, cosine = np.sin(phi), np.cos(phi)
        # arcsin(c sin(phi)/a), which loses half the digits where its argument is near 1
        phi = 0.5 * (phi + np.arctan2(c * sine, np.hypot(a * cosine, b * sine)))
    return phi


def jacobi_sn_cn(z: Reals, modulus: float, complement: float) -> tuple[Reals, Reals]:
    """Jacobi's sn(z, k) and cn(z, k) on [0, K], cn with its digits also near K.

    sn(K - y) = cn(y)/dn(y), cn(K - y) = k' sn(y)/dn(y)

    Parameters
        z : (N,) array - argument, 0 to K
        modulus, complement : float - k and k'
    Returns
        sn, cn : (N,) arrays
    Notes
        The upper half of the range is taken from its complement; the worst relative error of cn, at K/2, is
        about 1e-16/sqrt(k').
    Example
        >>> sn, cn = jacobi_sn_cn(np.array([0.5]), 0.8, 0.6)
        >>> round(float(sn[0]), 12), round(float(cn[0]), 12)
        (0.468328835388, 0.883554243917)

    Source
        Abramowitz and Stegun 16.8
    """
    quarter = complete_integral(complement)
    upper = z > 0.5 * quarter
    phi = amplitude(np.where(upper, quarter - z, z), modulus, complement)
    sine, cosine = np.sin(phi), np.cos(phi)
    delta = np.hypot(cosine, complement * sine)
    return np.where(upper, cosine / delta, sine), np.where(upper, complement * sine / delta, cosine)
