"""The design file of a cylindrical cam."""

from __future__ import annotations

from typing import Literal

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from gearlink.core.base.spec import Assembly, Distance, Length, Spec, TolerancedSpec
from gearlink.core.parts.cams.motion_spec import OfFollowerKeys, SteepAngle


class DrumFollower(Spec):
    """A roller whose axis is radial, on a slide along the drum."""

    type: Literal["translating-roller"] = Field(description="how the follower moves, and what touches the cam")
    roller_radius: Length = Field(description="radius of the roller")


class DrumBody(Spec):
    """The drum."""

    radius: Length = Field(description="outside radius of the drum")
    depth: Length = Field(description="depth of the track below it")
    sense: Assembly = Field(1, description="+1: the cam turns counter-clockwise; -1: clockwise")


class DrumLimits(Spec):
    """Limits of the checks."""

    pressure_angle: SteepAngle = Field(30.0, description="maximum pressure angle, at the bottom of the track")
    jerk_step: Distance | None = Field(None, description="maximum jump of the jerk, mm per rad^3")


class CylindricalCamSpec(OfFollowerKeys, TolerancedSpec):
    """A cylindrical cam with its follower."""

    kind: Literal["cylindrical-cam"]
    follower: DrumFollower = Field(description="the roller")
    cam: DrumBody = Field(description="the drum")
    limits: DrumLimits = DrumLimits.model_construct()

    @model_validator(mode="after")
    def _has_a_track(self) -> CylindricalCamSpec:
        if self.cam.depth >= self.cam.radius:
            words = {"key": "cam.depth", "depth": f"{self.cam.depth:g}", "radius": f"{self.cam.radius:g}"}
            raise PydanticCustomError(
                "GL111", "depth: {depth} mm (limit < {radius} mm, radius)\nset cam.depth below {radius} mm", words
            )
        return self
