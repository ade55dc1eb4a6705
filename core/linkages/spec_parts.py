"""Sections that the design files of several gear-linkages share."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field
from pydantic_core import PydanticCustomError

from gearlink.core.spec import AcuteAngle, Distance, GearLimits, Length, LoadLimits, SignedLength, Spec


class LinkageLimits(GearLimits, LoadLimits):
    """Limits of the checks."""

    transmission_angle: AcuteAngle = Field(40.0, description="least transmission angle")
    gear_gap: SignedLength = Field(0.0, description="least gap between gears that do not mesh")
    least_shaft: Distance | None = Field(
        None, description="radius of the thinnest shaft that would be built; left out: 2 modules"
    )


class PivotShafts(Spec):
    """Shafts of the frame that pass through the plane of the gears; one that is left out may end before it."""

    A_radius: Length | None = Field(None, description="radius of the input shaft at A")
    D_radius: Length | None = Field(None, description="radius of the rocker's shaft at D")


class DwellBand(Spec):
    """A dwell within a tolerance: a crank angle, a tolerance, or both."""

    window: Annotated[float, Field(gt=0, lt=360, json_schema_extra={"unit": "deg"})] | None = Field(
        None, description="crank angle over which the output stays within +-tolerance"
    )
    tolerance: Annotated[float, Field(gt=0, lt=180, json_schema_extra={"unit": "deg"})] | None = Field(
        None, description="output tolerance +- of the window; alone: the longest window is sought"
    )
    margin: Annotated[float, Field(ge=0, lt=1, json_schema_extra={"unit": "1"})] | None = Field(
        None, description="share of the tolerance that the design keeps in hand, with tolerance alone; default 0.01"
    )


class FourLinks(Spec):
    """A whole four-bar."""

    crank: Length = Field(description="crank AB")
    coupler: Length = Field(description="coupler BC")
    rocker: Length = Field(description="rocker CD")
    frame: Length = Field(description="frame AD")


def require_rim(rim: float | None, ring: int | None, module: float) -> None:
    """Refuse a rim without a ring gear, and one that does not lie outside its root circle, m (z/2 + 1.25)."""
    if rim is None:
        return
    if ring is None:
        raise PydanticCustomError("GL111", "rim goes with a ring gear: leave it out", {"key": "rim"})
    root = module * (0.5 * ring + 1.25)
    if rim <= root:
        raise PydanticCustomError(
            "GL111",
            "the rim's radius {rim} mm lies within the root circle of the ring gear, {root} mm: make it larger",
            {"key": "rim", "rim": f"{rim:g}", "root": f"{root:g}"},
        )
