"""The design file of a measured cam."""

import cmath
import math
from itertools import pairwise
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import Field, model_validator

from gearlink.core.base.spec import (
    Assembly,
    Deferred,
    Distance,
    Entries,
    Length,
    SignedLength,
    Spec,
    Speed,
    TolerancedSpec,
    refused,
    unit,
)
from gearlink.core.machines.disc_cam.spec import (
    CamBody,
    DiscCamLimits,
    OscillatingRoller,
    Spring,
    Translating,
    TranslatingRoller,
    usual_pressure_limits,
)
from gearlink.core.machines.disc_cam.spec import Inertia as FollowerInertia

ProfilePoint = Annotated[
    list[SignedLength], Field(min_length=2, max_length=2), Entries("[angle, radius]", "[30, 52.4]", ("deg",))
]
Point = Annotated[list[SignedLength], Field(min_length=2, max_length=2), Entries("[x, y]", "[130, 0]")]
MOST_HARMONICS = 60
_FEWEST = 5


class OscillatingFollower(Spec):
    """A roller on a rocker; the cam axis is the origin."""

    type: Literal["oscillating"] = Field(description="motion of the follower")
    pivot: Point = Field(description="axis of the rocker in coordinates of the cam axis")
    arm: Length = Field(description="pivot to roller centre")
    side: Assembly = Field(1, description="1: roller centre left of the direction from cam axis to pivot; -1: right")
    inertia: FollowerInertia | None = Field(
        None, description="moment of inertia about the pivot, for lift-off and loads"
    )


class TranslatingFollower(Translating):
    """A roller on a slide; the cam axis is the origin."""

    type: Literal["translating"] = Field(description="motion of the follower")
    offset: SignedLength = Field(0.0, description="distance of the line of travel from the cam axis on its right")


class Profile(Spec):
    """Points of the cam's profile, polar, in the cam at cam angle 0."""

    points: Annotated[list[ProfilePoint], Field(min_length=_FEWEST, max_length=100_000)] | None = Field(
        None, description="[angle, radius] in deg and mm, angles ascending over less than a revolution"
    )
    file: str | None = Field(None, description="CSV file with these columns, instead of points")

    @model_validator(mode="after")
    def _turn(self) -> Self:
        if (self.points is None) == (self.file is None):
            given = self.points is not None
            raise refused("give points or file" + (", not both" if given else ""), "file" if given else "points")
        if self.points is None:
            raise refused("the file is read with the design file\ngive points here", "file")
        angles = [angle for angle, _ in self.points]
        for k, (before, after) in enumerate(pairwise(angles), 1):
            if after <= before:
                raise refused(f"angles of a profile ascend: {after:.9g} deg follows {before:.9g} deg", f"points[{k}]")
        if angles[-1] - angles[0] >= 360.0:
            message = f"angles of a profile: over {angles[-1] - angles[0]:.9g} deg (below 360 deg)"
            raise refused(f"{message}\nomit the points that repeat after a revolution", "points")
        for k, (_, radius) in enumerate(self.points):
            if radius <= 0.0:
                raise refused(f"radius of a profile: {radius:.9g} mm (above 0)", f"points[{k}]")
        return self


class MeasuredCamSpec(TolerancedSpec):
    """A measured cam profile and the follower that runs on it."""

    kind: Literal["measured-cam"]
    follower: Annotated[
        OscillatingFollower | TranslatingFollower, Field(discriminator="type", description="the follower on the cam")
    ]
    roller_radius: Length = Field(description="radius of the roller")
    sense: Assembly = Field(1, description="1: the cam turns counter-clockwise; -1: clockwise")
    profile: Profile
    harmonics: Annotated[int, unit("1", ge=1, le=MOST_HARMONICS)] | None = Field(
        None, description="of the Fourier series through the points; default: a quarter of the points, at most 60"
    )
    dwell_tolerance: Distance = Field(0.02, description="range of the follower within a dwell: mm, oscillating deg")
    speed: Speed | None = Field(None, description="speed of the cam")
    shaft_radius: Distance = Field(0.0, description="radius of the cam shaft; 0: not checked")
    closure: Literal["spring", "groove"] = Field("spring", description="what keeps the follower on the cam")
    spring: Spring | None = Field(None, description="what presses the follower on the cam")
    limits: DiscCamLimits = DiscCamLimits.model_construct()
    loads: Annotated[Any, Deferred("studies.loads.spec:CamLoads")] | None = Field(
        None, description="forces, roller and vibration, for the command loads"
    )

    @model_validator(mode="after")
    def _enough(self) -> Self:
        count, order = len(self.profile.points or ()), self.order
        if count < 2 * order + 1:
            message = f"harmonics through {count} points: {order} (at most {(count - 1) // 2})"
            raise refused(f"{message}\nset harmonics to at most {(count - 1) // 2}, or give more points", "harmonics")
        return self

    @property
    def order(self) -> int:
        """Harmonics of the series."""
        count = len(self.profile.points or ())
        return min((count - 1) // 4, MOST_HARMONICS) if self.harmonics is None else self.harmonics

    # What a disc cam has

    is_flat: ClassVar[bool] = False
    is_edge: ClassVar[bool] = False
    rolls: ClassVar[bool] = True
    radius_key: ClassVar[str] = "cam.prime_radius"
    radius: ClassVar[None] = None
    arcs: ClassVar[None] = None
    return_roller: ClassVar[None] = None
    errors: ClassVar[None] = None
    servo: ClassVar[None] = None

    @property
    def oscillates(self) -> bool:
        """Whether the follower rocks."""
        return self.follower.type == "oscillating"

    @property
    def cam(self) -> CamBody:
        """Sense and shaft of the cam; its size is that of the profile."""
        return CamBody.model_construct(sense=self.sense, shaft_radius=self.shaft_radius)

    @property
    def disc_follower(self) -> OscillatingRoller | TranslatingRoller:
        """The follower in the words of a disc cam, of numbers that have been validated or of columns of them."""
        given = self.follower
        if isinstance(given, TranslatingFollower):
            return TranslatingRoller.model_construct(
                type="translating-roller",
                roller_radius=self.roller_radius,
                direction=given.direction,
                offset=given.offset,
                mass=given.mass,
            )
        pivot = complex(*given.pivot)
        return OscillatingRoller.model_construct(
            type="oscillating-roller",
            roller_radius=self.roller_radius,
            pivot_direction=math.degrees(cmath.phase(pivot)),
            side=given.side,
            arm=given.arm,
            center_distance=abs(pivot),
            inertia=given.inertia,
        )

    def pressure_limits(self) -> tuple[float, float]:
        """Maximum pressure angle of rise and return [deg], of the limits or the usual."""
        return usual_pressure_limits(self.limits.pressure_angle, self.oscillates)
