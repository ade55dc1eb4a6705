"""Samples in replications, each scrambled anew: estimates with an interval that covers."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.quasi_random import Sobol

REPLICATIONS = 16
_CONFIDENCE = 0.975  # two-sided 95 %


def rounded_up(samples: int) -> int:
    """The number of samples that is taken: 16 replications of a power of two each.

    Example
        >>> rounded_up(100_000)
        131072
    """
    each = max(2, -(-samples // REPLICATIONS))
    return REPLICATIONS * (1 << (each - 1).bit_length())


def replication(coordinates: int, samples: int, seed: int, number: int) -> Reals:
    """Scrambled Sobol' points of the unit cube: one of the 16 replications.

    Parameters
        coordinates : int - dimensions
        samples : int - of all replications, as `rounded_up` gives it
        seed : int - replication r is scrambled by [seed, r]: the same points whatever computes them
        number : int - r, from 0
    Returns
        points : (samples/16, coordinates) array - in (0, 1)
    Notes
        A power of two of points, or their balance is lost. 53 bits of scrambling keep equal points apart.
    Source
        A. B. Owen, Ann. Statist. 25 (1997) 1541; S. Joe, F. Y. Kuo, SIAM J. Sci. Comput. 30 (2008) 2635
    """
    rng = np.random.default_rng(np.random.SeedSequence([seed, number], spawn_key=(0,)))
    return Sobol(coordinates, rng, bits=53).points(0, samples // REPLICATIONS)


def replications(coordinates: int, samples: int, seed: int) -> Iterator[Reals]:
    """All replications, as `replication` gives each."""
    for number in range(REPLICATIONS):
        yield replication(coordinates, samples, seed, number)


@dataclass(frozen=True, slots=True)
class Estimate:
    """A mean over replications and the half-width of its 95 % interval."""

    value: float
    half_width: float

    @property
    def low(self) -> float:
        """Lower end of the interval."""
        return self.value - self.half_width

    @property
    def high(self) -> float:
        """Upper end of the interval."""
        return self.value + self.half_width


def estimate(values: Reals) -> Estimate:
    """Mean of independent replications with its interval by Student's t.

    Parameters
        values : (R,) array - one value of each replication
    Example
        >>> found = estimate(np.array([1.0, 2.0, 3.0, 4.0]))
        >>> round(found.value, 6), round(found.half_width, 6)
        (2.5, 2.05426)

    Source
        W. S. Gosset (Student), Biometrika 6 (1908) 1
    """
    count = len(values)
    spread = float(np.std(values, ddof=1)) if count > 1 else float("nan")
    return Estimate(float(np.mean(values)), student(count) * spread / count**0.5)


def student(count: int) -> float:
    """Student's t of a two-sided 95 % interval by so many replications.

    Example
        >>> round(student(16), 6)
        2.13145
    """
    from scipy.special import stdtrit

    return float(stdtrit(count - 1, _CONFIDENCE))


def share_estimate(shares: Reals, samples: int) -> tuple[float, float, float]:
    """A yield with its 95 % interval: value, low, high, all within 0 and 1.

    1 - 0.05^(1/N) where every sample passes, or every one fails

    Parameters
        shares : (R,) array - yield of each replication
        samples : int - N, of all replications
    Notes
        Replications that all agree have no spread and yet no certainty: the bound is the exact one of N trials.
    Example
        >>> value, low, high = share_estimate(np.ones(16), 131072)
        >>> value, high, low > 0.99997
        (1.0, 1.0, True)

    Source
        rule of three, exact: J. A. Hanley, A. Lippman-Hand, JAMA 249 (1983) 1743
    """
    value = float(np.mean(shares))
    bound = 1.0 - 0.05 ** (1.0 / samples)
    if value == 1.0:
        return 1.0, 1.0 - bound, 1.0
    if value == 0.0:
        return 0.0, 0.0, bound
    found = estimate(shares)
    return value, max(0.0, found.low), min(1.0, found.high)
