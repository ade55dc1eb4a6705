"""The design files of mechanisms of gears or links with cams."""

from itertools import pairwise
from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator

from gearlink.core.base.spec import (
    AcuteAngle,
    Angle,
    Assembly,
    Deferred,
    Distance,
    DrawingLimits,
    DrivenSpec,
    Entries,
    GearLimits,
    Length,
    LoadLimits,
    SignedLength,
    Spec,
    Teeth,
    only_one,
    refused,
    unit,
)
from gearlink.core.parts.cams.motion_spec import SteepAngle
from gearlink.core.parts.cams.output_motion import OutputLaw
from gearlink.core.parts.gears.keys.pair import PairKeys

Number = Annotated[float, unit("1")]
Harmonic = Annotated[
    list[Number], Field(min_length=3, max_length=3), Entries("[n, cos, sin]", "[1, 20, 0]", ("1", "mm", "mm"))
]
Waves = Annotated[list[Harmonic], Field(min_length=1, max_length=60)]
PathPoint = Annotated[
    list[SignedLength], Field(min_length=3, max_length=3), Entries("[angle, x, y]", "[90, 20, 5]", ("deg",))
]


class CamDriveLimits(DrawingLimits, GearLimits, LoadLimits):
    """Limits of the checks."""

    pressure_angle: SteepAngle = Field(45.0, description="maximum pressure angle")


class CamLinkageLimits(CamDriveLimits):
    """Limits of the checks."""

    transmission_angle: AcuteAngle = Field(30.0, description="minimum transmission angle of follower and output, at D")


Roller = Annotated[Length, Field(description="radius of the roller in the groove")]
Output = Annotated[
    OutputLaw, Field(description="output over a revolution of the input: segments with laws, or a table")
]


class SunAndPlanet(PairKeys):
    """Sun on the output, planet on the carrier."""

    sun: Teeth = Field(description="teeth of the sun, which is the output")
    planet: Teeth = Field(description="teeth of the planet")


class Lever(Spec):
    """The lever on the planet that carries the roller."""

    length: Length = Field(description="distance of the roller's axis from the planet's")
    angle: Angle = Field(description="angle from the direction sun to planet to the lever, at input angle 0")


class CamGearSpec(DrivenSpec):
    """A planet whose lever runs in a groove of the frame: carrier the input, sun the output."""

    own_commands = ("analyze",)
    kind: Literal["cam-gear"]
    gears: SunAndPlanet
    lever: Lever
    roller_radius: Roller
    motion: Output
    limits: CamDriveLimits = CamDriveLimits.model_construct()
    loads: Annotated[Any, Deferred("machines.cam_drives.loads:CamGearSection")] | None = Field(
        None, description="masses, forces and drive, for the command loads"
    )


class FiveLinks(Spec):
    """The links of the five-bar."""

    input: Length = Field(description="input link AB")
    coupler: Length = Field(description="coupler BC, from the input to the roller at C")
    follower: Length = Field(description="follower CD, from the output to the roller at C")
    output: Length = Field(description="output link ED")
    frame: Distance = Field(description="frame AE; 0: input and output on one axis")


class CamLinkageSpec(DrivenSpec):
    """A five-bar whose middle joint C runs in a groove of the frame: AB the input, ED the output."""

    own_commands = ("analyze",)
    kind: Literal["cam-linkage"]
    links: FiveLinks
    phase: Angle = Field(0.0, description="direction of ED at output angle 0")
    assembly: Assembly = Field(1, description="+1: C left of the vector from B to D")
    roller_radius: Roller
    motion: Output
    limits: CamLinkageLimits = CamLinkageLimits.model_construct()
    loads: Annotated[Any, Deferred("machines.cam_drives.loads:CamLinkageSection")] | None = Field(
        None, description="masses, forces and drive, for the command loads"
    )


class Harmonics(Spec):
    """Both coordinates of the path as sums of harmonics of the input angle."""

    x: Waves = Field(description="n, and amounts of cos and sin")
    y: Waves = Field(description="the same of y")

    @model_validator(mode="after")
    def _whole(self) -> Self:
        for key in ("x", "y"):
            for place, (n, *_) in enumerate(getattr(self, key)):
                if n < 1 or n != int(n) or n > 1000:
                    message = f"the order of a harmonic must be a whole number from 1 to 1000, not {n:g}"
                    raise refused(message, f"{key}[{place}][0]", "GL108")
        return self


class LinkedPath(Spec):
    """The path of the slide."""

    harmonics: Harmonics | None = Field(None, description="both coordinates by harmonics of the input angle")
    points: Annotated[list[PathPoint], Field(min_length=5, max_length=2000)] | None = Field(
        None,
        description="input angle and position, ascending from 0 to 360, closed; a quintic spline goes through them",
    )

    @model_validator(mode="after")
    def _one(self) -> Self:
        only_one(self, "harmonics", "points", needed="give harmonics, or points instead")
        rows = self.points or [[0.0, 0.0, 0.0], [360.0, 0.0, 0.0]]
        ascending = all(before[0] < after[0] for before, after in pairwise(rows))
        if not ascending or rows[0][0] != 0.0 or rows[-1][0] != 360.0 or rows[0][1:] != rows[-1][1:]:
            raise refused("points ascend from input angle 0 to 360 and end where they start", "points")
        return self


class LinkedCam(Spec):
    """One of both cams, with an in-line roller."""

    base_radius: Length = Field(description="cam axis to the roller's centre at lift 0")
    roller_radius: Length = Field(description="radius of the roller")


class LinkedCamPair(Spec):
    """The cams of both coordinates, on one shaft."""

    x: LinkedCam
    y: LinkedCam


class LinkedCamsSpec(DrivenSpec):
    """A cross slide that two cams on one shaft move along a path."""

    own_commands = ("analyze",)
    kind: Literal["linked-cams"]
    path: LinkedPath
    cams: LinkedCamPair
    limits: CamDriveLimits = CamDriveLimits.model_construct()
    loads: Annotated[Any, Deferred("machines.cam_drives.loads:LinkedCamsSection")] | None = Field(
        None, description="masses, forces and drive, for the command loads"
    )
