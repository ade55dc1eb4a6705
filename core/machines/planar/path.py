"""The length of the path of a point."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.machines.planar.extremes import turning_points
from gearlink.core.numerics.gauss import GAUSS_NODES, GAUSS_WEIGHTS

if TYPE_CHECKING:
    from gearlink.core.machines.planar.course import Course
    from gearlink.core.machines.planar.outputs import Moved
    from gearlink.core.machines.planar.system import Jets
    from gearlink.core.numerics.arrays import Reals


def length(course: Course, x_of: Moved, y_of: Moved) -> float:
    """Length of the path over the period or range [mm]: the integral of |P'|.

    Notes
        Panels end where |P'| is least, at a kink where the point turns back.
    """
    point, arm = x_of, x_of.place / x_of.size

    def square(jets: Jets, k: int) -> Reals:
        rates = [(j + 1) * jets.point(point.body, arm, j + 1) for j in range(k + 1)]
        return np.asarray(sum((np.conj(rates[j]) * rates[k - j]).real for j in range(k + 1)))

    places = turning_points(course, square, ahead=1)
    edges = np.unique(np.concatenate([course.grid, places]))
    x = np.array([*(-node for node in GAUSS_NODES), *GAUSS_NODES])
    w = np.array([*GAUSS_WEIGHTS, *GAUSS_WEIGHTS])
    width = np.diff(edges)
    q = edges[:-1, None] + 0.5 * width[:, None] * (1.0 + x)
    jets = course.jets(q.ravel(), 1)
    rates = [course.derivatives(each.coefficient, jets, 1)[1] for each in (x_of, y_of)]
    speed = np.hypot(*rates)
    return float(np.sum(0.5 * width * (speed.reshape(q.shape) @ w)))
