"""Sections that the design files of several geared linkages may have, each imported by the machines that read them."""

from typing import Annotated, Self

from pydantic import Field, model_validator

from gearlink.core.base.spec import Distance, Length, Ratio, Spec, refused, unit
from gearlink.core.parts.linkages.spec_parts import TurnAngle

Plain = Annotated[float, unit("1", ge=-1e6, le=1e6)]


class InputRange(Spec):
    """Input angles over which a linkage moves."""

    start: TurnAngle = Field(0.0, description="first input angle")
    end: TurnAngle = Field(description="last input angle")


class PivotShafts(Spec):
    """Shafts of the frame that pass through the plane of the gears; a shaft without an entry may end before it."""

    A_radius: Length | None = Field(None, description="radius of the input shaft at A")
    D_radius: Length | None = Field(None, description="radius of the rocker's shaft at D")


class FrontLay(Spec):
    """The front lay that a sheet arrives at."""

    distance: Length = Field(description="distance before the lay over which the speed is checked")
    speed: Annotated[float, unit("mm/s", gt=0)] = Field(description="maximum speed of the sheet over that distance")
    angle: Annotated[float, unit("deg", ge=0, lt=360)] | None = Field(
        None, description="crank angle of the arrival; default: that with the lowest maximum speed"
    )


class Feed(Spec):
    """What the output carries on: a roller or belt by its radius, or a chain by its pitch and the sprocket's teeth."""

    radius: Length | None = Field(None, description="radius of the roller, or of the pulley under the belt")
    belt_thickness: Distance = Field(
        0.0, description="thickness of the belt, whose neutral line lies half of it above the radius"
    )
    pitch: Length | None = Field(None, description="pitch of the chain, with teeth instead of radius")
    teeth: Annotated[int, unit("teeth", ge=5, le=1000)] | None = Field(
        None, description="teeth of the chain's sprocket"
    )
    ratio: Ratio = Field(1.0, description="speed of the feed shaft over that of the output gear")
    step: Length | None = Field(
        None, description="required travel per revolution of the input: radius, or for a chain ratio or teeth, is found"
    )
    lay: FrontLay | None = Field(None, description="the front lay, at which the sheet must be slow; needs input_speed")

    @model_validator(mode="after")
    def _one_form(self) -> Self:
        chain = [name for name in ("pitch", "teeth") if getattr(self, name) is not None]
        if self.step is not None:
            return self._of_step()
        if self.radius is not None and chain:
            message = (
                "radius applies to a roller or a belt, pitch and teeth to a chain\nomit radius, or pitch and teeth"
            )
            raise refused(message, chain[0])
        if self.radius is None and len(chain) < 2:
            raise refused("give radius, or pitch and teeth of a chain", "radius", "GL106")
        if chain and self.belt_thickness:
            raise refused("a chain has no belt_thickness\nomit it", "belt_thickness")
        return self

    def _of_step(self) -> Self:
        """A step leaves one size to be found."""
        ratio = "ratio" in self.model_fields_set
        if self.radius is not None:
            raise refused("step determines the radius\nomit one of them", "radius")
        if self.teeth is not None and self.pitch is None:
            raise refused("teeth needs pitch\ngive it", "pitch", "GL106")
        if self.teeth is not None and ratio:
            raise refused("step determines the ratio or the teeth\nomit one of them", "ratio")
        if self.pitch is not None and self.teeth is None and not ratio:
            raise refused("for a chain, step needs pitch and teeth, or pitch and ratio", "teeth", "GL106")
        if self.pitch is not None and self.belt_thickness:
            raise refused("a chain has no belt_thickness\nomit it", "belt_thickness")
        return self


def require_function(
    name: str | None, exponent: float | None, x: list[float] | None, output_swing: float | None
) -> None:
    """Refuse a function whose exponent, interval or output swing does not go with it."""
    if (name == "power") != (exponent is not None):
        message = "exponent is required with power, and only with it\n"
        message += "give exponent" if name == "power" else "omit exponent"
        raise refused(message, "exponent")
    if x is not None and x[0] == x[1]:
        raise refused("x has the same value at both ends\ngive an interval", "x[1]")
    if output_swing == 0.0:
        raise refused("a function needs a moving output\ngive output_swing above or below 0", "output_swing", "GL108")


class FourLinks(Spec):
    """A whole four-bar."""

    crank: Length = Field(description="crank AB")
    coupler: Length = Field(description="coupler BC")
    rocker: Length = Field(description="rocker CD")
    frame: Length = Field(description="frame AD")
