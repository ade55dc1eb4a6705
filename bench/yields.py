"""Yields of published reliability problems: replications of scrambled points against plain random ones."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from bench.timing import Family, Method, Row, measure, numpy_pass
from gearlink.core.numerics.arrays import Mask, Reals
from gearlink.core.studies.tolerance.sampling import REPLICATIONS, estimate, replications

_SEEDS = 8
_FAR = 7.0 / math.sqrt(2.0)


def four_branch(z: Reals) -> Mask:
    """Failures of the four-branch problem; their probability is 0.00222279506619."""
    a, b = z[:, 0], z[:, 1]
    straight, bent = 3.0 + 0.1 * (a - b) ** 2, (a + b) / math.sqrt(2.0)
    failed: Mask = np.min((straight - bent, straight + bent, a - b + _FAR, b - a + _FAR), axis=0) < 0.0
    return failed


def rp22(z: Reals) -> Mask:
    """Failures of the problem RP22; their probability is 0.00420730551130."""
    failed: Mask = 2.5 - (z[:, 0] + z[:, 1]) / math.sqrt(2.0) + 0.1 * (z[:, 0] - z[:, 1]) ** 2 < 0.0
    return failed


PROBLEMS: dict[str, tuple[Callable[[Reals], Mask], float]] = {
    "four-branch": (four_branch, 0.0022227950661944398),
    "RP22": (rp22, 0.004207305511299618),
}


def family(quick: bool) -> Family:
    """The table of the family; the error is that of the failure probability, root of the mean square of eight runs."""
    size = 2**14 if quick else 2**17
    methods = []
    for name, (failed, exact) in PROBLEMS.items():
        for way, share in (("scrambled", _scrambled), ("random", _random)):
            offs = [share(failed, size, seed) / exact - 1.0 for seed in range(_SEEDS)]
            run = partial(share, failed, size, 0)
            methods.append(Method(f"{name}, {way} points", size, run, float(np.sqrt(np.mean(np.square(offs))))))
    rows: tuple[Row, ...] = measure(methods, numpy_pass(size), size, 3)
    return Family(
        "yields",
        "Failure probabilities of published problems by samples",
        "relative",
        f"one numpy pass of sin + cos + arctan2 + sqrt over {size} numbers",
        rows,
        (
            "exact: the reference values of otbenchmark; scrambled: 16 replications of Sobol' points with an interval, "
            "random: plain Monte Carlo, whose error is sqrt((1 - p)/(p N))",
        ),
    )


def _scrambled(failed: Callable[[Reals], Mask], size: int, seed: int) -> float:
    from scipy.special import ndtri

    shares = [float(np.mean(failed(ndtri(points)))) for points in replications(2, size, seed)]
    assert len(shares) == REPLICATIONS
    return estimate(np.array(shares)).value


def _random(failed: Callable[[Reals], Mask], size: int, seed: int) -> float:
    points: Any = np.random.default_rng(seed).normal(size=(size, 2))
    return float(np.mean(failed(points)))
