"""Samples in replications, each scrambled anew: estimates with an interval that covers.

Replications are shares of a command's work, computed here or by whatever the command line names.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextvars import ContextVar
from dataclasses import dataclass
from typing import Protocol, TypeVar

import numpy as np

from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.quasi_random import Sobol

REPLICATIONS = 16
ARRAY_SAMPLES, SCALAR_SAMPLES = 131_072, 4096
"""By default, of array forms and of designs that are computed one by one."""
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


Found = TypeVar("Found")


class Compute(Protocol):
    """Computes a module's function, or a partial of one, at some numbers, and gives what it found in their order."""

    def __call__(self, function: Callable[[int], Found], numbers: Sequence[int], work: int) -> Iterable[Found]:
        """What the function gives for each number, for each of which so many designs are computed."""
        ...


COMPUTED_BY: ContextVar[Compute | None] = ContextVar("COMPUTED_BY", default=None)
"""By what replications are computed; None: here, one after the other."""
SEEN: ContextVar[Callable[[int], None] | None] = ContextVar("SEEN", default=None)
"""Who counts the designs that are computed, if anybody does."""


def seen(count: int) -> None:
    """Say that so many more designs are computed."""
    told = SEEN.get()
    if told is not None:
        told(count)


def is_shared() -> bool:
    """Whether replications may be computed elsewhere."""
    return COMPUTED_BY.get() is not None


def of_replications(function: Callable[[int], Found], work: int = 1) -> Iterable[Found]:
    """What a function finds in every replication, in order.

    Parameters
        function : of the replication's number - of a module, or a partial of one, so that it can be sent elsewhere
        work : int - designs of a replication, as it tells `seen`; 1 where it tells nothing
    """
    by = COMPUTED_BY.get()
    if by is None:
        return (function(number) for number in range(REPLICATIONS))
    return by(function, range(REPLICATIONS), work)
