"""Types of the arrays that kernels take and give."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Reals: TypeAlias = NDArray[np.float64]
Points: TypeAlias = NDArray[np.complex128]
"""Points or vectors of the plane, x + i y."""
Mask: TypeAlias = NDArray[np.bool_]
