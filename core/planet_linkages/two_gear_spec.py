"""The design file of a two-gear four-bar."""

from __future__ import annotations

from typing import Literal

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from gearlink.core.linkages.spec_parts import LinkageLimits, PivotShafts, require_rim
from gearlink.core.spec import Assembly, DesignSpec, Length, PressureAngle, Spec, Teeth


class PlanetGears(Spec):
    """Planet on the coupler at B, in mesh with a sun or a ring gear free on A."""

    module: Length = Field(description="module")
    planet: Teeth = Field(description="teeth z2 of the gear fixed to the coupler at B")
    sun: Teeth | None = Field(None, description="teeth z5 of an external output gear on A")
    ring: Teeth | None = Field(None, description="teeth z5 of an internal output gear on A, in place of sun")
    rim: Length | None = Field(
        None, description="outer radius of the ring gear; left out: 2 modules outside its root circle"
    )
    pressure_angle: PressureAngle = Field(20.0, description="pressure angle of the reference profile")

    @model_validator(mode="after")
    def _one_output(self) -> PlanetGears:
        if self.sun is None and self.ring is None:
            raise PydanticCustomError("GL106", "give sun or ring, the output gear on A", {"key": "sun"})
        if self.sun is not None and self.ring is not None:
            raise PydanticCustomError("GL111", "sun and ring exclude each other: give one", {"key": "ring"})
        if self.ring is not None and self.ring <= self.planet:
            raise PydanticCustomError(
                "GL111",
                "a ring gear of {ring} teeth does not take a planet of {planet}: give it more teeth",
                {"key": "ring", "ring": str(self.ring), "planet": str(self.planet)},
            )
        require_rim(self.rim, self.ring, self.module)
        return self


class TwoGearLinks(Spec):
    """The links that the gears do not fix."""

    crank: Length | None = Field(None, description="crank AB; left out: the centre distance of the gears")
    coupler: Length = Field(description="coupler BC")
    rocker: Length = Field(description="rocker CD")
    frame: Length = Field(description="frame AD")


class MotionTarget(Spec):
    """What the output shall do; otherwise the design is refused or fails."""

    motion: Literal["unidirectional", "momentary-dwell", "back-step"] = Field(description="kind of output motion")


class TwoGearFourBarSpec(DesignSpec):
    """A four-bar whose coupler carries a gear that drives one on the crank's axis."""

    kind: Literal["two-gear-four-bar"]
    gears: PlanetGears
    links: TwoGearLinks
    assembly: Assembly = Field(1, description="+1: C left of the vector from B to D; -1: its mirror image")
    target: MotionTarget | None = None
    limits: LinkageLimits = LinkageLimits()
    shafts: PivotShafts | None = None

    def commands(self) -> tuple[str, ...]:
        """What the file asks for."""
        return ("analyze", "gear")
