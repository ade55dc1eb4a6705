"""Limits, value types and refusals that the specs of several geared linkages share."""

from typing import Annotated

from pydantic import Field

from gearlink.core.base.spec import (
    AcuteAngle,
    Distance,
    DrawingLimits,
    GearLimits,
    LoadLimits,
    SignedLength,
    refused,
    unit,
)

TurnAngle = Annotated[float, unit("deg", ge=-3600, le=3600)]


class LinkageLimits(DrawingLimits, GearLimits, LoadLimits):
    """Limits of the checks."""

    transmission_angle: AcuteAngle = Field(40.0, description="minimum transmission angle")
    gear_gap: SignedLength = Field(
        0.0, description="minimum gap between gears that do not mesh; below 0 for gears in separate planes"
    )
    least_shaft: Distance | None = Field(
        None, description="minimum shaft radius where the file gives none; default: 2 modules"
    )


LEAST_TOLERANCE = 1e-9
"""[deg]; of a smaller one double precision leaves fewer than five digits of the dwell's crank angle."""
DwellTolerance = Annotated[float, unit("deg", ge=LEAST_TOLERANCE)]


def require_rim(rim: float | None, ring: int | None, module: float, *, own_teeth: bool = False) -> None:
    """Refuse a rim without a ring gear, and one that does not lie outside its root circle, m (z/2 + 1.25).

    Where the ring has teeth of its own, its mesh is what knows that circle.
    """
    if rim is None:
        return
    if ring is None:
        raise refused("rim applies only to a ring gear\nomit it", "rim")
    if own_teeth:
        return
    root = module * (0.5 * ring + 1.25)
    if rim <= root:
        message = f"radius of the rim: {rim:g} mm (limit > {root:g} mm, the root radius of the ring gear)"
        raise refused(f"{message}\nraise rim above {root} mm", "rim")
