"""Integrals of even, periodic, analytic functions by the equal-weight rule; values of rising functions.

The cosine series goes with the rule. Where a rising function has a given value is found nearly, for Newton's steps.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.numerics.arrays import Reals

_BLOCK = 1024
_SETTLED = 8.0 * 2.0**-52
_MOST_NODES = 8192


def midpoint_mean(f: Callable[[Reals], Reals], span: float, nodes: int) -> float:
    """Mean of a function over [0, span] by the equal-weight midpoint rule.

    mean = (1/n) sum f((i + 1/2) span/n)

    Parameters
        f : the function, vectorised
        span : float - length of the interval
        nodes : int - number of nodes n
    Notes
        For f even about both ends and analytic the error falls geometrically, as exp(-2 pi n d/span) with d
        the distance of the nearest singularity from the real axis.
    Example
        >>> midpoint_mean(lambda z: np.cos(z) ** 2, math.pi, 4)
        0.5

    Source
        Trefethen and Weideman, SIAM Review 56 (2014) 385
    """
    return math.fsum(f(_midpoints(span, nodes)).tolist()) / nodes


def _midpoints(span: float, nodes: int) -> Reals:
    points: Reals = (np.arange(nodes, dtype=np.float64) + 0.5) * (span / nodes)
    return points


@dataclass(frozen=True, slots=True, eq=False)
class CosineSeries:
    """f(z) = sum f_j cos(pi j z/span) on [0, span], with its integral; of many, whose span is a column, a row for each.

    Fields
        span : float - the interval
        coefficients : (n,) array - f_0, f_1 ..., or a row of as many for each
        nodes : int - nodes of the rule that gave them
        difference : float - relative change of the integral from half as many nodes
    """

    span: float
    coefficients: Reals
    nodes: int
    difference: float

    @property
    def total(self) -> float:
        """Integral over the whole span."""
        return float(self.coefficients[0]) * self.span

    def integral(self, z: Reals) -> Reals:
        """Integral from 0 to z, of small relative error also for small z (times sum |f_j| over f(0))."""
        if self.coefficients.ndim > 1:
            return self._integrals(z)
        wave = np.arange(1, len(self.coefficients)) * (math.pi / self.span)
        weights = self.coefficients[1:] / wave
        places, result = z.ravel(), np.empty(z.size)
        for start in range(0, z.size, _BLOCK):
            part = places[start : start + _BLOCK]
            # no product of matrices, which rounds a row otherwise among other rows
            waves = np.sin(np.outer(part, wave)) * weights
            result[start : start + _BLOCK] = self.coefficients[0] * part + waves.sum(axis=1)
        return result.reshape(z.shape)

    def _integrals(self, z: Reals) -> Reals:
        """Of many."""
        first = math.pi / self.span
        weights = self.coefficients[:, 1:] / (np.arange(1, self.coefficients.shape[1]) * first)
        # the waves are powers of the first: a product each, and no sine; all sines keep the digits of the first one
        wave = np.exp(1j * first * z)
        total = np.zeros_like(wave)
        for weight in weights.T[::-1]:
            total += weight[:, None]
            total *= wave
        return np.asarray(self.coefficients[:, :1] * z + total.imag)

    @classmethod
    def of_many(cls, series: Sequence[CosineSeries]) -> CosineSeries:
        """Some series as one."""
        most = max(len(one.coefficients) for one in series)
        rows = [np.pad(one.coefficients, (0, most - len(one.coefficients))) for one in series]
        spans: Any = np.array([[one.span] for one in series])
        return cls(spans, np.array(rows), max(one.nodes for one in series), max(one.difference for one in series))

    def from_far_end(self) -> CosineSeries:
        """The same function with z counted back from the end of the span."""
        signs = np.where(np.arange(len(self.coefficients)) % 2 == 0, 1.0, -1.0)
        return CosineSeries(self.span, self.coefficients * signs, self.nodes, self.difference)


def cosine_series(f: Callable[[Reals], Reals], span: float, refusal: str, *, first: int = 16) -> CosineSeries:
    """Cosine series of an even, periodic, analytic function, with as many nodes as it takes.

    Parameters
        f : the function, vectorised; even about 0 and about span
        span : float - half of its period
        refusal : str - what is wrong, and its remedy, where the integral does not settle: the function is too sharp
        first : int - nodes to begin with
    Raises
        NoSolution - of that text, when the integral has not settled to 8 ulp with 8192 nodes
    Notes
        The number of nodes doubles until the integral settles. The rule with n nodes errs by the coefficient
        of order 2n, so when n and 2n nodes agree, a series of 2n terms is complete to rounding.
    Example
        >>> s = cosine_series(lambda z: 1.0 / (2.0 + np.cos(z)), math.pi, "too sharp")
        >>> round(s.total / math.pi * math.sqrt(3.0), 14), s.nodes
        (1.0, 32)

    Source
        Trefethen and Weideman, SIAM Review 56 (2014) 385
    """
    nodes, mean = first, midpoint_mean(f, span, first)
    while nodes < _MOST_NODES:
        nodes, before = 2 * nodes, mean
        values = f(_midpoints(span, nodes))
        mean = math.fsum(values.tolist()) / nodes
        difference = abs(mean - before) / abs(mean)
        if difference <= _SETTLED:
            return CosineSeries(span, cosine_coefficients(values), nodes, difference)
    raise NoSolution(refusal)


def cosine_coefficients(values: Reals) -> Reals:
    """Coefficients of the cosine series through values at the midpoints of equal parts of the span.

    f_j = (2/n) sum f(z_i) cos(pi j z_i/span), f_0 half of that

    Parameters
        values : (n,) array - f((i + 1/2) span/n)
    Returns
        coefficients : (m,) array - without the tail that is below rounding, m <= n
    Example
        >>> cosine_coefficients(np.array([3.0, 3.0, 3.0])).tolist()
        [3.0]

    Source
        discrete cosine transform of the second kind
    """
    n = len(values)
    spectrum = np.fft.rfft(np.concatenate([values, values[::-1]]))[:n]
    coefficients: Reals = (spectrum * np.exp(-0.5j * math.pi / n * np.arange(n))).real / n
    coefficients[0] = math.fsum(values.tolist()) / n
    size = float(np.max(np.abs(values)))
    significant = np.flatnonzero(np.abs(coefficients) > 1e-17 * size)
    return coefficients[: int(significant[-1]) + 1] if len(significant) else coefficients[:1]


@dataclass(frozen=True, slots=True, eq=False)
class RisingTable:
    """A rising function at some places, read backwards; or many such functions, a row for each.

    Fields
        places : (N,) array - ascending
        values : (N,) array, or rows of such - of the function there, ascending
        slopes : as values - of the function there, not negative
    """

    places: Reals
    values: Reals
    slopes: Reals

    def places_of(self, values: Reals) -> Reals:
        """About where the function has these values, by cubics with the slopes of the inverse at both neighbours.

        Parameters
            values : (M,) array, of many functions a row for each - within those of the table
        Returns
            places : array as values - between the neighbours
        Notes
            The error falls as the fourth power of the step. A slope above three times that of the chord counts as
            three times, with which a cubic rises all the way.
        Example
            >>> x = np.linspace(0.0, 1.0, 17)
            >>> table = RisingTable(x, np.expm1(x), np.exp(x))
            >>> round(float(table.places_of(np.array([0.5]))[0]), 6), round(float(np.log(1.5)), 6)
            (0.405465, 0.405465)

        Source
            Fritsch and Carlson, SIAM J. Numer. Anal. 17 (1980) 238, for the bound on the slopes
        """
        left = np.clip(self._rank(values) - 1, 0, len(self.places) - 2)
        at = (left,) if self.values.ndim < 2 else (np.arange(len(left))[:, None], left)
        start, width = self.values[at], np.diff(self.values)[at]
        rise = np.diff(self.places)[left]
        with np.errstate(divide="ignore"):
            slopes = 1.0 / self.slopes
        t = (values - start) / width
        first, last = (np.minimum(width * slopes[*at[:-1], row], 3.0 * rise) for row in (left, left + 1))
        cubic = t * (first + t * ((3.0 * rise - 2.0 * first - last) + t * (first + last - 2.0 * rise)))
        found: Reals = self.places[left] + np.clip(cubic, 0.0, rise)
        return found

    def _rank(self, values: Reals) -> Any:
        """How many values of the table are not above each."""
        if self.values.ndim < 2:
            return np.searchsorted(self.values, values, side="right")
        return np.array([np.searchsorted(*row, side="right") for row in zip(self.values, values, strict=True)])
