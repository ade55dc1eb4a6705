"""Names of what the drawing of a mesh inside a machine gives, beside the quantities that every mesh has."""

from __future__ import annotations

from gearlink.core.parts.gears.codes import TIP_FOULING
from gearlink.core.parts.gears.drawing_names import DRAWING_CHECKS, PLACES

_OF_EVERY_MESH = "tip_fouling_margin"
TRAIN_QUANTITIES = tuple(name for name in PLACES if name != _OF_EVERY_MESH)
TRAIN_CHECKS = tuple(name for name in DRAWING_CHECKS if name != TIP_FOULING.name)
