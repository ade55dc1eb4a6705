"""Motion laws through the points of a table: the quintic spline that is at rest, or at speed, where the phase ends."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from gearlink.core.numerics import bernstein
from gearlink.core.numerics.arrays import Reals

# Coefficients of t^3, t^4, t^5 by s0, v0, a0, s1, v1, a1 of an interval of width 1; t^0 to t^2 are s0, v0, a0/2.
_UPPER = np.array(
    [
        [-10.0, -6.0, -1.5, 10.0, -4.0, 0.5],
        [15.0, 8.0, 1.5, -15.0, 7.0, -1.0],
        [-6.0, -3.0, -0.5, 6.0, -3.0, 0.5],
    ]
)
# Integral of (6 c3 + 24 c4 t + 60 c5 t^2)^2 over the interval, as a form of these.
_ENERGY = _UPPER.T @ np.array([[36.0, 72.0, 120.0], [72.0, 192.0, 360.0], [120.0, 360.0, 720.0]]) @ _UPPER


class TableSpline:
    """The quintic spline through points (x, s), four times continuously differentiable, with v and a given at its ends.

    Parameters
        x : (n,) array - ascending
        s : (n,) array
        end_speed : float - v at the last point; at the first it is 0, and so is a at both
    Notes
        It is the curve with the minimum integral of s'''^2 through the points; v and a at the inner ones solve a
        system of 2 x 2 blocks, three to a row, which is positive definite and needs no pivoting.
    Source
        own derivation; Schoenberg, natural splines
    """

    def __init__(self, x: Sequence[float], s: Sequence[float], end_speed: float) -> None:
        self.x, self.s = np.asarray(x, dtype=np.float64), np.asarray(s, dtype=np.float64)
        self.width = np.diff(self.x)
        rates = np.zeros((self.x.size, 2))
        rates[-1, 0] = end_speed
        rates[1:-1] = self._inner_rates(end_speed)
        h = self.width
        ends = [
            self.s[:-1],
            rates[:-1, 0] * h,
            rates[:-1, 1] * h * h,
            self.s[1:],
            rates[1:, 0] * h,
            rates[1:, 1] * h * h,
        ]
        # Differences of s, not s itself: they lose no digits.
        step = np.array([np.zeros_like(h), ends[1], ends[2], np.diff(self.s), ends[4], ends[5]])
        self.coefficients = np.array([ends[0], ends[1], 0.5 * ends[2], *(_UPPER @ step)]).T

    def _inner_rates(self, end_speed: float) -> Reals:
        """v and a at the inner points, by elimination of blocks."""
        n = self.x.size - 2
        diagonal, beside, right = np.zeros((n, 2, 2)), np.zeros((n, 2, 2)), np.zeros((n, 2))
        for k, h in enumerate(self.width):
            scale = np.array([h, h * h])
            both = np.concatenate([scale, scale])
            form = _ENERGY[np.ix_([1, 2, 4, 5], [1, 2, 4, 5])] * np.outer(both, both) / h**5
            pull = _ENERGY[[1, 2, 4, 5], 3] * both * (self.s[k + 1] - self.s[k]) / h**5
            if k == self.width.size - 1:
                pull = pull + form[:, 2] * end_speed
            if k > 0:
                diagonal[k - 1] += form[:2, :2]
                right[k - 1] -= pull[:2]
            if k < n:
                diagonal[k] += form[2:, 2:]
                right[k] -= pull[2:]
            if 0 < k < n:
                beside[k - 1] = form[:2, 2:]
        for k in range(1, n):
            share = np.linalg.solve(diagonal[k - 1], beside[k - 1]).T
            diagonal[k] -= share @ beside[k - 1]
            right[k] -= share @ right[k - 1]
        found = np.zeros((n, 2))
        for k in range(n - 1, -1, -1):
            after = beside[k] @ found[k + 1] if k + 1 < n else 0.0
            found[k] = np.linalg.solve(diagonal[k], right[k] - after)
        return found

    def derivatives(self, x: Any, low: int, high: int) -> tuple[Any, ...]:
        """Derivatives low to high at x, a float or an array."""
        at = np.asarray(x, dtype=np.float64)
        k = np.minimum(np.maximum(np.searchsorted(self.x, at, side="right") - 1, 0), self.width.size - 1)
        t, h, found = (at - self.x[k]) / self.width[k], self.width[k], []
        c = self.coefficients[k]
        for order in range(high + 1):
            if order >= low:
                value = np.zeros_like(t)
                for power in range(c.shape[-1] - 1, -1, -1):
                    value = value * t + c[..., power]
                found.append(value / h**order)
            c = c[..., 1:] * np.arange(1, c.shape[-1]) if c.shape[-1] > 1 else 0.0 * c
        return tuple(float(value) for value in found) if isinstance(x, float) else tuple(found)

    def peaks(self) -> tuple[float, float, float, float]:
        """Maximum |v|, |a|, |j| and |v a|, proved by the coefficients of Bernstein polynomials."""
        orders = [self._bernstein(order) for order in (1, 2, 3)]
        power = np.array([bernstein.product(v, a) for v, a in zip(orders[0], orders[1], strict=True)])
        v, a, j, p = (bernstein.peak(each) for each in (*orders, power))
        return v, a, j, p

    def least_speed(self) -> tuple[float, float]:
        """The minimum velocity and its x."""
        a = np.array([np.polynomial.polynomial.polyder(c, 2) for c in self.coefficients])
        places = [*self.x.tolist()]
        for k, c in enumerate(a):
            roots = np.polynomial.polynomial.polyroots(np.trim_zeros(c, "b"))
            real = roots.real[(np.abs(roots.imag) < 1e-9) & (roots.real > 0.0) & (roots.real < 1.0)]
            places += (self.x[k] + self.width[k] * real).tolist()
        speeds = self.derivatives(np.array(places), 1, 1)[0]
        least = int(np.argmin(speeds))
        return float(speeds[least]), places[least]

    def _bernstein(self, order: int) -> Reals:
        rows = [
            np.polynomial.polynomial.polyder(c, order) / h**order
            for c, h in zip(self.coefficients, self.width, strict=True)
        ]
        return np.array([bernstein.from_powers(row.tolist()) for row in rows])
