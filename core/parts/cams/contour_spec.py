"""A disc cam that is given by the arcs of its profile, as a key of design files."""

from typing import Annotated, ClassVar, Literal, Self

from pydantic import Field, model_validator

from gearlink.core.base.spec import Length, SignedLength, Spec, also, refused, unit

ActionAngle = Annotated[float, unit("deg", gt=0, le=360)]
DwellAngle = Annotated[float, unit("deg", ge=0, lt=360)]
ArcAngle = Annotated[float, unit("deg", gt=0, lt=180)]


class _Lobe(Spec):
    """Base circle and nose, with one flank on either side."""

    wanted: ClassVar[int]
    sizes: ClassVar[tuple[str, ...]] = ("nose_radius", "nose_distance", "lift", "action_angle")

    base_radius: Length = Field(description="radius of the base circle")
    nose_radius: Length | None = Field(None, description="radius of the nose")
    nose_distance: Length | None = Field(None, description="cam axis to the centre of the nose")
    lift: Length | None = Field(None, description="height of the nose above the base circle")
    action_angle: ActionAngle | None = Field(
        None,
        description="from the start of the rise to the end of the return: twice the angle of ascent, and dwell_angle",
        json_schema_extra={"unit": "deg", **also("angle_of_action")},
    )
    dwell_angle: DwellAngle = Field(0.0, description="of the arc about the cam axis at the top, for a dwell there")

    def given(self) -> dict[str, float]:
        """The sizes that the file gives."""
        return {name: value for name in self.sizes if (value := getattr(self, name)) is not None}

    @model_validator(mode="after")
    def _as_many(self) -> Self:
        given = [*self.given()]
        if len(given) != self.wanted:
            names = f"{', '.join(self.sizes[:-1])} and {self.sizes[-1]}"
            count = {2: "two", 3: "three"}[self.wanted]
            missing = len(given) < self.wanted
            message = f"sizes of the profile: {len(given)} of {names} (required {self.wanted})"
            message += f"\n{'give' if missing else 'keep'} {count} of them; the other sizes follow"
            raise refused(message, "type" if missing else given[-1])
        if self.action_angle is not None and self.dwell_angle >= self.action_angle:
            message = f"dwell_angle: {self.dwell_angle:g} deg (limit < {self.action_angle:g} deg, action_angle)"
            raise refused(f"{message}\nset profile.dwell_angle below {self.action_angle:g} deg", "dwell_angle")
        return self


class TangentProfile(_Lobe):
    """Flanks that are straight."""

    wanted = 2

    type: Literal["tangent"] = Field(description="shape of the flanks")


class CircularArcProfile(_Lobe):
    """Flanks that are arcs of circles."""

    wanted = 3
    sizes = (*_Lobe.sizes, "flank_radius", "flank_angle")

    type: Literal["circular-arc"] = Field(description="shape of the flanks")
    flank_radius: SignedLength | None = Field(None, description="radius of the flanks; negative: concave")
    flank_angle: ArcAngle | None = Field(
        None, description="with action_angle: angle of a flank's arc, under a flat face the cam angle on it"
    )

    @model_validator(mode="after")
    def _of_flanks(self) -> Self:
        if set(self.given()) == {"nose_radius", "nose_distance", "lift"}:
            message = "nose_radius, nose_distance and lift do not determine the flanks: two of them give the third"
            raise refused(f"{message}\ngive action_angle or flank_radius instead of lift", "lift")
        return self

    @model_validator(mode="after")
    def _of_action(self) -> Self:
        if self.flank_angle is not None:
            if self.action_angle is None:
                raise refused("flank_angle needs action_angle\ngive action_angle", "flank_angle")
            most = 0.5 * (self.action_angle - self.dwell_angle)
            if self.flank_angle >= most:
                message = f"flank_angle: {self.flank_angle:g} deg (limit < {most:g} deg, the angle of ascent)"
                raise refused(f"{message}\nset profile.flank_angle below {most:g} deg", "flank_angle")
        if self.flank_radius == 0.0:
            raise refused("flank_radius: 0 mm (must not be 0)\nfor straight flanks set type: tangent", "flank_radius")
        return self


class EccentricProfile(Spec):
    """A circular disc whose centre is not its axis."""

    type: Literal["eccentric"] = Field(description="shape of the flanks")
    radius: Length = Field(description="radius of the disc")
    eccentricity: Length = Field(description="cam axis to the centre of the disc")

    @model_validator(mode="after")
    def _around(self) -> Self:
        if self.eccentricity >= self.radius:
            message = f"eccentricity: {self.eccentricity:g} mm (limit < {self.radius:g} mm, radius)"
            raise refused(f"{message}\nset profile.eccentricity below {self.radius:g} mm", "eccentricity")
        return self

    @property
    def base_radius(self) -> float:
        """Smallest radius [mm]."""
        return self.radius - self.eccentricity


CamProfile = Annotated[TangentProfile | CircularArcProfile | EccentricProfile, Field(discriminator="type")]
