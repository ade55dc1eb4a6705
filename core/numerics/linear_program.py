"""Linear programs of a few unknowns."""

from __future__ import annotations

import math
from threading import local
from typing import Any, NamedTuple

import numpy as np

from gearlink.core.numerics.arrays import Reals


class Solution(NamedTuple):
    """What solves a linear program.

    Fields
        x : (N,) array
        duals : (M,) array - of the rows; of a row at its upper limit none is positive
        basis : where the solver ended
    """

    x: Reals
    duals: Reals
    basis: Any


def least(
    cost: Reals, rows: Reals, limits: Reals, lower: Reals, upper: Reals, near: Solution | None = None
) -> Solution | None:
    """The x of minimum cost @ x with rows @ x <= limits and lower <= x <= upper, by the dual simplex method.

    Parameters
        cost, lower, upper : (N,) arrays - bounds may be infinite
        rows : (M, N) array - finite
        limits : (M,) array
        near : Solution - of a like program; where it has as many rows, the solver begins at its basis
    Returns
        found : Solution - to 1e-7 in each limit, so state the program in numbers about 1; None where no x keeps the
            limits, or the cost falls without end

    Source
        Q. Huangfu, J. A. J. Hall, Mathematical Programming Computation 10 (2018) 119
    """
    return solution(cost, rows, np.full(limits.size, -np.inf), limits, lower, upper, near=near)


def solution(
    cost: Reals,
    rows: Reals,
    least_: Reals,
    most: Reals,
    lower: Reals,
    upper: Reals,
    *,
    tolerance: float = 1e-7,
    near: Solution | None = None,
) -> Solution | None:
    """The x of minimum cost @ x with least_ <= rows @ x <= most and lower <= x <= upper, and the duals of the rows.

    Parameters
        as of `least`; tolerance : float - of limits and reduced costs
    """
    from highspy import HighsModelStatus, HighsStatus, MatrixFormat, ObjSense

    row, column = np.nonzero(rows)
    start, form = np.searchsorted(row, np.arange(most.size + 1)), MatrixFormat.kRowwise.value
    sizes, real = (*rows.shape[::-1], row.size), np.zeros(cost.size, dtype=np.int32)
    limits, matrix = (lower, upper, least_, most), (start.astype(np.int32), column.astype(np.int32), rows[row, column])
    solver = _solver()
    solver.setOptionValue("primal_feasibility_tolerance", tolerance)
    solver.setOptionValue("dual_feasibility_tolerance", tolerance)
    solver.passModel(*sizes, form, ObjSense.kMinimize.value, 0.0, cost, *limits, *matrix, real)
    if near is not None and near.duals.size == most.size:
        solver.setBasis(near.basis)
    if solver.run() == HighsStatus.kError:  # of its threads there is one number in a process: who came first set it
        solver.setOptionValue("threads", 0)
        solver.run()
    if solver.getModelStatus() != HighsModelStatus.kOptimal:
        return None
    found = solver.getSolution()
    return Solution(np.array(found.col_value), np.array(found.row_dual), solver.getBasis())


def proved_bound(
    found: Solution, cost: Reals, rows: Reals, least_: Reals, most: Reals, lower: Reals, upper: Reals
) -> float:
    """A bound that cost @ x of no x within all limits lies below, whatever the duals are worth.

    y b + sum min over lower <= x <= upper of (c - y A) x,  y with the sign that its row's limits allow

    Parameters
        found : Solution - whose duals are taken; the rest as of `solution`, all of lower and upper finite
    Source
        weak duality of linear programs
    """
    y = np.where(np.isinf(least_), np.minimum(found.duals, 0.0), found.duals)
    y = np.where(np.isinf(most), np.maximum(y, 0.0), y)
    limits = np.where(y == 0.0, 0.0, np.where(y > 0.0, least_, most))
    left = cost - y @ rows
    terms = np.concatenate([y * limits, np.minimum(left * lower, left * upper)])
    return math.fsum(terms.tolist()) - 1e-14 * float(np.sum(np.abs(terms)))


_made = local()


def _solver() -> Any:
    """The solver of this thread, made once: to make one takes half as long as to solve a program of eight unknowns."""
    if not hasattr(_made, "solver"):
        solver = _made.solver = _silent()
        solver.setOptionValue("presolve", "off")  # takes longer than it saves
        solver.setOptionValue("solver", "simplex")
        solver.setOptionValue("threads", 1)  # so that a process may fork afterwards
    return _made.solver


def _silent() -> Any:
    """A solver that prints nothing: from 1.16 on it names itself on standard output as it enables callbacks."""
    from highspy import Highs

    class WithoutCallbacks(Highs):
        def enableCallbacks(self) -> None:
            """Not while its output is on; none is used."""

    made: Any = WithoutCallbacks
    solver = made()
    solver.setOptionValue("output_flag", False)
    return solver
