"""Linear programs of a few unknowns."""

from __future__ import annotations

from typing import Any

import numpy as np

from gearlink.core.numerics.arrays import Reals


def least(cost: Reals, rows: Reals, limits: Reals, lower: Reals, upper: Reals) -> Reals | None:
    """The x of least cost @ x with rows @ x <= limits and lower <= x <= upper, by the dual simplex method.

    Parameters
        cost, lower, upper : (N,) arrays - bounds may be infinite
        rows : (M, N) array - finite
        limits : (M,) array
    Returns
        x : (N,) array - to 1e-7 in each limit, so state the program in numbers about 1; None where no x keeps the
            limits, or the cost falls without end

    Source
        Q. Huangfu, J. A. J. Hall, Mathematical Programming Computation 10 (2018) 119
    """
    from highspy import HighsLp, HighsModelStatus, HighsStatus, MatrixFormat

    program = HighsLp()
    program.num_row_, program.num_col_ = rows.shape
    program.col_cost_, program.col_lower_, program.col_upper_ = cost, lower, upper
    program.row_lower_, program.row_upper_ = np.full(limits.size, -np.inf), limits
    row, column = np.nonzero(rows)
    program.a_matrix_.format_ = MatrixFormat.kRowwise
    program.a_matrix_.start_ = np.searchsorted(row, np.arange(limits.size + 1))
    program.a_matrix_.index_, program.a_matrix_.value_ = column, rows[row, column]
    solver = _silent()
    solver.setOptionValue("presolve", "off")  # takes longer than it saves
    solver.setOptionValue("solver", "simplex")
    solver.setOptionValue("threads", 1)  # so that a process may fork afterwards
    solver.passModel(program)
    if solver.run() == HighsStatus.kError:  # of its threads there is one number in a process: who came first set it
        solver.setOptionValue("threads", 0)
        solver.run()
    if solver.getModelStatus() != HighsModelStatus.kOptimal:
        return None
    return np.array(solver.getSolution().col_value)


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
