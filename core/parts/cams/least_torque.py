"""Motion laws of minimum inertia torque, |s' s''|: found step by step, and bounded by the kinetic energy.

The product is not convex in the coefficients of s'': each step solves the programme of the product's linear part
within a trust region, and what is found is smallest of its neighbours alone.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.polynomial import chebyshev

from gearlink.core.base.errors import NoSolution
from gearlink.core.numerics import bernstein
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.linear_program import proved_bound, solution
from gearlink.core.parts.cams import optimal
from gearlink.core.parts.cams.optimal import Course, Optimum, Program, Programme, Solved, Wish

_PLACES, _FINE = 129, 2049
_STEPS, _SETTLED = 40, 3e-6
_INTERVALS, _CUTS = 200, 6


@lru_cache(maxsize=64)
def least_torque(wish: Wish) -> Optimum:
    """A law whose |s' s''| is less than that of its neighbours.

    Raises
        NoSolution - as `optimum`
    Notes
        `lower_bound` holds for every law with the same maximum acceleration, whatever its form and jerk.
    """
    optimal.require_possible(wish)
    search = _Search(wish)
    coefficients = search.shipped()[0]
    value = _torque(coefficients)
    bound = optimal.bound_of_all_laws(wish)
    assert bound is not None
    lower = bound if wish.to_speed else max(bound, _bound_by_energy(wish, value))
    return Optimum(tuple(coefficients.tolist()), value, lower, bound)


def _torque(coefficients: Reals) -> float:
    velocity = bernstein.integral(coefficients)
    return bernstein.peak(bernstein.product(velocity, coefficients))


class _Search(Programme):
    """The programme of the linear part of |s' s''| about the best law so far."""

    def __init__(self, wish: Wish) -> None:
        half = 0.5 if wish.symmetric else 1.0
        super().__init__(wish, Course(self._linear_part, 0.0, half, None))
        self.fine = np.linspace(0.0, half, _FINE)

    def _linear_part(self, x: Reals) -> Reals:
        """v0 a + a0 v - v0 a0 times the rise, or the speed, which is 1."""
        v, a = self.basis.rows(1, x), self.basis.rows(2, x)
        if not hasattr(self, "best"):
            return a
        v0, a0 = v @ self.best, a @ self.best
        one = self.basis.rows(1 if self.wish.to_speed else 0, np.ones(1))[0]
        return np.asarray(v0[:, None] * a + a0[:, None] * v - (v0 * a0)[:, None] * one)

    def _value(self, series: Reals) -> float:
        return float(
            np.max(np.abs((self.basis.rows(1, self.fine) @ series) * (self.basis.rows(2, self.fine) @ series)))
        )

    def _begin(self) -> None:
        """From the law of minimum acceleration that keeps the other limits."""
        wish = self.wish
        start = optimal.optimum(wish._replace(minimize="acceleration", acceleration=None))
        if wish.acceleration is not None and start.value > wish.acceleration:
            raise self._impossible()
        c, n = np.array(start.coefficients), wish.degree
        self.best = chebyshev.chebinterpolate(lambda u: bernstein.evaluate(c, 0.5 * (u + 1.0)), n)[self.basis.orders]

    def solved(self, slack: float = 0.0) -> Solved:
        """The last programme of the search."""
        if not hasattr(self, "best"):
            self._begin()
        value = math.inf  # what was best may pass a limit that is tighter now
        size = float(np.max(np.abs(self.best)))
        reach = 0.3 * size
        for _ in range(_STEPS):
            self.known[0] = optimal.begun(self.courses[0], _PLACES)
            self.around = self.best - reach, self.best + reach
            found = super().solved(slack)
            reached = self._value(found.series)
            promised = value - found.scale * float(found.found.x[-1])
            if value < math.inf and (promised <= _SETTLED * value or reach < _SETTLED * size):
                break
            if reached < value:
                reach *= 2.0 if value - reached > 0.7 * promised else 0.7
                self.best, value = found.series, reached
            else:
                reach *= 0.25
        found.series = self.best
        return found


class _Energy(NamedTuple):
    """Columns v_0..v_N, K_0..K_N, M of the programme over half the phase."""

    intervals: int
    step: float
    acceleration: float

    @property
    def columns(self) -> int:
        return 2 * self.intervals + 3

    def rows(self) -> tuple[Reals, Reals]:
        """Rows and their upper limits that hold for every law: steps of v and K, and the rise."""
        n, h, top = self.intervals, self.step, self.acceleration
        v, k = np.eye(n + 1, self.columns), np.eye(n + 1, self.columns, n + 1)
        torque = np.zeros((n, self.columns))
        torque[:, -1] = h
        dv, dk, mean = v[1:] - v[:-1], k[1:] - k[:-1], 0.5 * (v[1:] + v[:-1])
        blocks = [dv, -dv, dk - torque, -dk - torque, dk - top * h * mean, -dk - top * h * mean]
        bend = 0.25 * (top * h) ** 2
        limits = [np.full(n, top * h)] * 2 + [np.zeros(n)] * 2 + [np.full(n, bend)] * 2
        rise = -h * mean.sum(axis=0, keepdims=True)
        return np.concatenate([*blocks, rise]), np.append(np.concatenate(limits), 0.25 * top * h * n * h - 0.5)

    def cuts(self, at: Reals) -> tuple[Reals, Reals]:
        """v_j below the tangents of sqrt(2 K) at places of K."""
        root = np.sqrt(2.0 * at)
        rows = np.zeros((self.intervals + 1, self.columns))
        j = np.arange(self.intervals + 1)
        rows[j, j], rows[j, self.intervals + 1 + j] = 1.0, -1.0 / root
        return rows, 0.5 * root


def _bound_by_energy(wish: Wish, value: float) -> float:
    """Below it |s' s''| of no law with |s''| <= A and |s'| <= V lies, by K = s'^2/2 at equal steps of half the phase.

    |dK| <= M h,  |dv| <= A h,  |dK| <= A h (v_j + v_j+1)/2 + A^2 h^2/4,  v <= sqrt(2 K),  sum of the rise >= 1/2

    Notes
        Every condition is necessary, and what holds for a law and its mirror image holds for their mean.
    """
    accelerations = [each for each in (wish.acceleration, None if wish.jerk is None else 0.5 * wish.jerk) if each]
    if not accelerations:
        return 0.0
    top = min(accelerations)
    fastest = min(0.5 * top, math.inf if wish.velocity is None else wish.velocity)
    energy = _Energy(_INTERVALS, 0.5 / _INTERVALS, top)
    lower = np.zeros(energy.columns)
    upper = np.concatenate([np.full(_INTERVALS + 1, fastest), np.full(_INTERVALS + 1, 0.5 * fastest**2), [2.0 * value]])
    lower[: _INTERVALS + 1] = -fastest
    upper[[0, _INTERVALS + 1]] = lower[0] = 0.0
    cost = np.zeros(energy.columns)
    cost[-1] = 1.0
    rows, limits = energy.rows()
    x = np.arange(_INTERVALS + 1) / _INTERVALS
    at = np.maximum(0.5 * np.minimum(top * 0.5 * x, min(fastest, 2.0)) ** 2, 1e-8)
    best = 0.0
    for _ in range(_CUTS):
        more, most = energy.cuts(at)
        rows, limits = np.concatenate([rows, more]), np.append(limits, most)
        program = Program(cost, rows, np.full(limits.size, -np.inf), limits, lower, upper)
        found = solution(*program)
        if found is None:
            raise NoSolution(f"no law keeps acceleration {top:g} and velocity {fastest:g}", fix="raise a limit")
        best = max(best, proved_bound(found, *program))
        at = np.maximum(found.x[_INTERVALS + 1 : -1], 1e-8)
    return best
