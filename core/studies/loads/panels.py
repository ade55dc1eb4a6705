"""The period of a machine in panels between the places where something jumps, with Gauss nodes."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from gearlink.core.mechanism.rates import TURNING_BACK
from gearlink.core.numerics.arrays import Reals, distinct
from gearlink.core.numerics.gauss import gauss_legendre

NODES = 16
PANEL = math.radians(10.0)
MANY = 100
"""Breaks of a period from which on fewer nodes and samples are taken between each two."""
_FEW_NODES, _NARROW = 6, math.radians(1.0)
APART = 64.0
"""Places nearer to each other than so many roundings of the period are one."""


class Parts(NamedTuple):
    """Stretches anywhere with Gauss nodes.

    Fields
        nodes : (n * order,) array
        widths : (n,) array
        weights : (order,) array - of a stretch of length 1
    """

    nodes: Reals
    widths: Reals
    weights: Reals

    def each(self, values: Reals) -> Reals:
        """Integral over each stretch of a function given at the nodes."""
        return np.asarray((values.reshape(-1, len(self.weights)) @ self.weights) * self.widths)


@dataclass(frozen=True)
class Panels:
    """An interval in panels with Gauss nodes.

    Fields
        edges : (n + 1,) array
        nodes : (n * order,) array - ascending
        weights : (order,) array - of a panel of length 1
    """

    edges: Reals
    nodes: Reals
    weights: Reals

    @classmethod
    def over(cls, period: float, breaks: Sequence[float], width: float = PANEL) -> Panels:
        """Panels of at most 10 deg, or another width, between the breaks.

        Notes
            16 Gauss nodes over 10 deg: 1e-13 for a function whose nearest singularity is 5 deg off the real axis, as
            that of a linkage whose transmission angle falls to 5 deg. Between many breaks, 6 nodes over 1 deg do.
        """
        many = len(breaks) > MANY
        bounds, width = [0.0, *breaks, period], min(width, _NARROW) if many else width
        parts = [
            np.linspace(low, high, max(1, math.ceil((high - low) / width - 1e-9)) + 1)[:-1]
            for low, high in itertools.pairwise(bounds)
        ]
        edges = np.append(np.concatenate(parts), period)
        x, weights = gauss_legendre(_FEW_NODES if many else NODES)
        nodes = (edges[:-1, None] + np.diff(edges)[:, None] * (0.5 * (x + 1.0))).ravel()
        return cls(edges, nodes, 0.5 * weights)

    @property
    def order(self) -> int:
        """Nodes of a panel."""
        return len(self.weights)

    def some(self, rows: slice) -> Panels:
        """Some of the panels, one after the other."""
        last = min(rows.stop, len(self.edges) - 1)
        return Panels(
            self.edges[rows.start : last + 1], self.nodes[rows.start * self.order : last * self.order], self.weights
        )

    def cut(self, places: Sequence[float]) -> tuple[Any, Parts]:
        """Numbers of the panels within which some of the places lie, and these panels in parts between the places."""
        at = np.sort(np.asarray(places, dtype=float))
        row, apart = self.row(at), max(2.0 * TURNING_BACK, APART * float(np.spacing(self.edges[-1])))
        inside = (at - self.edges[row] > apart) & (self.edges[row + 1] - at > apart)
        at, rows = at[inside], distinct(row[inside])
        starts, ends = (np.sort(np.append(at, self.edges[rows + end])) for end in (0, 1))
        x, _ = gauss_legendre(self.order)
        nodes = (starts[:, None] + (ends - starts)[:, None] * (0.5 * (x + 1.0))).ravel()
        return rows, Parts(nodes, ends - starts, self.weights)

    def row(self, phi: Reals) -> Any:
        """Number of the panel in which each place lies; the very end belongs to the last one."""
        return np.searchsorted(self.edges[1:-1], phi, side="right")

    def each(self, values: Reals) -> Reals:
        """Integral over each panel of a function given at the nodes."""
        return Parts(self.nodes, np.diff(self.edges), self.weights).each(values)

    def integral(self, values: Reals) -> float:
        """Integral over the whole of a function given at the nodes."""
        return math.fsum(self.each(values).tolist())

    def within(self, values: Reals, phi: Reals) -> Reals:
        """Integral from the start of its panel to each place, of the polynomials through values at the nodes."""
        row = self.row(phi)
        width = self.edges[row + 1] - self.edges[row]
        series = (values.reshape(-1, self.order) @ to_integral(self.order))[row]  # a place rounds as it does alone
        # a panel between two breaks that are one but for rounding is narrower than the rounding of its places
        place = np.clip(2.0 * (phi - self.edges[row]) / width - 1.0, -1.0, 1.0)
        terms = np.polynomial.legendre.legvander(place, self.order)
        return np.where(phi > self.edges[row], width * np.sum(terms * series, axis=1), 0.0)

    def running(self, values: Reals) -> Reals:
        """Integral from the start to each edge."""
        return np.concatenate(([0.0], np.cumsum(self.each(values))))


def fewest_samples(breaks: Sequence[float]) -> int:
    """Samples between two breaks in which an extreme is sought at least."""
    return 5 if len(breaks) > MANY else 33


@lru_cache
def to_integral(order: int) -> Reals:
    """From values at the Gauss nodes of a panel of length 1 to the Legendre series of their integral from its start."""
    x, _ = gauss_legendre(order)
    to_series = np.linalg.inv(np.polynomial.legendre.legvander(x, order - 1))
    return np.asarray(0.5 * np.polynomial.legendre.legint(to_series, lbnd=-1.0).T)
