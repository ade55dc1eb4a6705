"""Sources that vary together: their normal coordinates are correlated (a Gaussian copula)."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np

from gearlink.core.numerics.arrays import Reals
from gearlink.core.studies.study.faults import Fault, WrongStudy
from gearlink.core.studies.tolerance.sources import Scatter, numbers_of
from gearlink.core.studies.tolerance.spec import Tolerance

_ROUNDING = 1e-12


def coordinate_root(section: Tolerance, sources: Sequence[Scatter]) -> Reals | None:
    """What makes normal coordinates scatter together, a root of their correlation matrix; None where all are apart.

    Raises
        WrongStudy - GL176 where no scatter has these correlations
    """
    if not section.correlated:
        return None
    columns = numbers_of(sources)
    place = {one.key: range(own.start, own.stop) for one, own in zip(sources, columns, strict=True)}
    matrix = np.eye(columns[-1].stop)
    for group in section.correlated:
        keys = [key for key in group.sources if key in place]
        for key, other in itertools.permutations(keys, 2):
            for i, j in zip(place[key], place[other], strict=False):
                matrix[i, j] = group.rho
    values, vectors = np.linalg.eigh(matrix)
    if values[0] < -_ROUNDING:
        message = f"these correlations contradict each other (minimum eigenvalue {values[0]:.3g})\nreduce rho"
        raise WrongStudy([Fault("GL176", message, ("tolerance", "correlated"))])
    # The symmetric root: coordinates that are apart from all others stay their own.
    root: Reals = (vectors * np.sqrt(np.maximum(values, 0.0))) @ vectors.T
    return root


def groups(section: Tolerance, sources: Sequence[Scatter]) -> list[int]:
    """Which sources scatter together: the number of its group for each, that of its first member."""
    keys = [one.key for one in sources]
    found = list(range(len(keys)))
    for group in section.correlated:
        members = [keys.index(key) for key in group.sources if key in keys]
        joined = {found[i] for i in members}
        if joined:
            found = [min(joined) if number in joined else number for number in found]
    return found


def together(points: Reals, root: Reals | None) -> Reals:
    """Random numbers in (0, 1) that scatter together as a root says."""
    if root is None:
        return points
    from scipy.special import ndtr, ndtri

    found: Reals = ndtr(ndtri(points) @ root.T)
    return found


def pairs(section: Tolerance, sources: Sequence[Scatter]) -> dict[tuple[str, str], float]:
    """Correlations by pairs of sizes, both ways round."""
    sizes = {one.key for one in sources if one.coordinates == 1}
    return {
        pair: group.rho
        for group in section.correlated
        for pair in itertools.permutations(group.sources, 2)
        if sizes.issuperset(pair)
    }


def of_sizes(section: Tolerance, sources: Sequence[Scatter]) -> dict[tuple[str, str], float]:
    """Correlations of sizes, by pairs of keys.

    Raises
        WrongStudy - GL176 for contradictions, and for play and runout, whose directions no number ties together
    """
    kinds = {one.key: one.kind for one in sources}
    for i, group in enumerate(section.correlated):
        vectors = [key for key in group.sources if kinds.get(key) in ("pin", "gear")]
        if vectors:
            message = (
                f"{vectors[0]} has a direction, but a register can correlate only sizes\nremove it from this group"
            )
            raise WrongStudy([Fault("GL176", message, ("tolerance", "correlated", i))])
    coordinate_root(section, sources)
    return pairs(section, sources)
