"""The section `loads` of a disc cam: mass, inertia, spring and speed stand in its own sections."""

from __future__ import annotations

from gearlink.core.studies.loads.spec import CommonLoads, Material, Roller


class DiscCamLoads(CommonLoads):
    """Forces, roller and vibration of a cam follower."""

    roller: Roller | None = None
    material: Material | None = None
