"""The section `loads` of a swing gripper: masses and spring stand in its own sections."""

from __future__ import annotations

from gearlink.core.studies.loads.spec import CommonLoads, Material, Roller


class GripperLoads(CommonLoads):
    """Forces, rollers and vibration of a swing gripper; its speed, masses and spring are the gripper's own."""

    roller: Roller | None = None
    material: Material | None = None
