"""How well the joints of a planar mechanism close over the rows of its period or range."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from gearlink.core.machines.planar.course import Course


def greatest_gap(course: Course) -> float:
    """Greatest gap of a pin, a line or a mesh [mm], directions taken at the unit of length."""
    q = course.grid[:-1] if course.turns is not None else course.grid
    scaled, jets = course.walked(q), course.jets(q, 0)
    gaps = np.abs(course.system.values(jets, 0, scaled))
    return float(gaps.max()) * course.structure.size
