"""The section `loads` of a wide-swing mechanism: inertia and device stand in its own sections."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from gearlink.core.loads.spec import CommonLoads, Material, Roller

Direction = Annotated[float, Field(ge=-360, le=360, json_schema_extra={"unit": "deg"})]


class SwingLoads(CommonLoads):
    """Forces, rollers and vibration of a wide-swing mechanism; its speed, inertia and device are its own."""

    device_direction: Direction | None = Field(
        None, description="direction from the rocker's axis D to the base pin of the device; left out: no force at D"
    )
    roller: Roller | None = None
    material: Material | None = None
