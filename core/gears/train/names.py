"""Names of what the drawing of a mesh inside a machine gives, beside the quantities that every mesh has."""

from __future__ import annotations

from gearlink.core.gears.codes import AT_LIMITS
from gearlink.core.gears.drawing_names import PLACES

_OF_EVERY_MESH = "tip_fouling_margin"
TRAIN_QUANTITIES = tuple(name for name in PLACES if name != _OF_EVERY_MESH)
TRAIN_CHECKS = (
    "radial-assembly",
    "fillet-interference",
    "backlash",
    "inspection",
    *AT_LIMITS,
    "pitting",
    "bending",
)
