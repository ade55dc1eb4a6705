"""The section `loads` of a wide-swing mechanism: inertia and device stand in its own sections."""

from __future__ import annotations

from gearlink.core.loads.spec import Material, Roller, Vibration
from gearlink.core.spec import Spec


class SwingLoads(Spec):
    """Roller, material and vibration of a wide-swing mechanism."""

    roller: Roller | None = None
    material: Material | None = None
    vibration: Vibration | None = None
