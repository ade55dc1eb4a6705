"""Sections that the design files of several gear-linkages share."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from gearlink.core.spec import (
    AcuteAngle,
    Distance,
    DrawingLimits,
    GearLimits,
    Length,
    LoadLimits,
    Ratio,
    SignedLength,
    Spec,
)

TurnAngle = Annotated[float, Field(ge=-3600, le=3600, json_schema_extra={"unit": "deg"})]


class InputRange(Spec):
    """Input angles over which a linkage moves."""

    start: TurnAngle = Field(0.0, description="first input angle")
    end: TurnAngle = Field(description="last input angle")


class LinkageLimits(DrawingLimits, GearLimits, LoadLimits):
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


class Feed(Spec):
    """What the output carries on: a roller or belt by its radius, or a chain by its pitch and the sprocket's teeth."""

    radius: Length | None = Field(None, description="radius of the roller, or of the pulley under the belt")
    belt_thickness: Distance = Field(
        0.0, description="thickness of the belt, which runs at half of it above the radius"
    )
    pitch: Length | None = Field(None, description="pitch of the chain, with teeth in place of radius")
    teeth: Annotated[int, Field(ge=5, le=1000, json_schema_extra={"unit": "teeth"})] | None = Field(
        None, description="teeth of the chain's sprocket"
    )
    ratio: Ratio = Field(1.0, description="speed of the feed's shaft over that of the output gear")

    @model_validator(mode="after")
    def _one_form(self) -> Feed:
        chain = [name for name in ("pitch", "teeth") if getattr(self, name) is not None]
        if self.radius is not None and chain:
            message = "radius goes with a roller or a belt, pitch and teeth with a chain: give one of them"
            raise PydanticCustomError("GL111", message, {"key": chain[0]})
        if self.radius is None and len(chain) < 2:
            raise PydanticCustomError("GL106", "give radius, or pitch and teeth of a chain", {"key": "radius"})
        if chain and self.belt_thickness:
            raise PydanticCustomError("GL111", "a chain has no belt_thickness: leave it out", {"key": "belt_thickness"})
        return self


LEAST_TOLERANCE = 1e-9
"""[deg]; of a smaller one double precision leaves fewer than five digits of the dwell's crank angle."""
DwellTolerance = Annotated[float, Field(ge=LEAST_TOLERANCE, json_schema_extra={"unit": "deg"})]


class DwellBand(Spec):
    """A dwell within a tolerance: a crank angle, a tolerance, or both."""

    window: Annotated[float, Field(gt=0, lt=360, json_schema_extra={"unit": "deg"})] | None = Field(
        None, description="crank angle over which the output stays within +-tolerance"
    )
    tolerance: Annotated[DwellTolerance, Field(lt=180)] | None = Field(
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


def require_rim(rim: float | None, ring: int | None, module: float, *, own_teeth: bool = False) -> None:
    """Refuse a rim without a ring gear, and one that does not lie outside its root circle, m (z/2 + 1.25).

    Where the ring has teeth of its own, its mesh is what knows that circle.
    """
    if rim is None:
        return
    if ring is None:
        raise PydanticCustomError("GL111", "rim goes with a ring gear: leave it out", {"key": "rim"})
    if own_teeth:
        return
    root = module * (0.5 * ring + 1.25)
    if rim <= root:
        raise PydanticCustomError(
            "GL111",
            "the rim's radius {rim} mm lies within the root circle of the ring gear, {root} mm: make it larger",
            {"key": "rim", "rim": f"{rim:g}", "root": f"{root:g}"},
        )
