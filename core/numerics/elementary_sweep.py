"""The functions of `gearlink.core.numerics.elementary` for arrays; what one number refuses is NaN here."""

from __future__ import annotations

from typing import Any

import numpy as np

from gearlink.core.numerics.elementary import Elementary
from gearlink.core.numerics.roots_sweep import newton_roots

FUNCTIONS: dict[str, Any] = {
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "asin": np.arcsin,
    "acos": np.arccos,
    "atan": np.arctan,
    "sqrt": np.sqrt,
    "cbrt": np.cbrt,
    "hypot": np.hypot,
    "atan2": np.arctan2,
    "copysign": np.copysign,
    "floor": np.floor,
    "round": np.round,
    "turn": lambda angle: np.exp(1j * angle),
    "phase": np.angle,
    "least": np.minimum,
    "greatest": np.maximum,
    "where": np.where,
    "root": newton_roots,
}
ARRAYS = Elementary(**FUNCTIONS)
