"""The design file of a disc cam."""

from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator

from gearlink.core.base.spec import (
    Angle,
    Assembly,
    Deferred,
    Distance,
    Entries,
    Length,
    LoadLimits,
    OfFollower,
    SignedLength,
    Spec,
    TolerancedSpec,
    also,
    refused,
    unit,
)
from gearlink.core.parts.cams.contour_spec import CamProfile
from gearlink.core.parts.cams.motion_spec import FollowerMotion, OfFollowerKeys, SteepAngle, require_closed

Strokes = Annotated[list[SteepAngle], Field(min_length=2, max_length=2), Entries("[rise, return]")]
Kilograms = Annotated[float, unit("kg", gt=0)]
Inertia = Annotated[float, unit("kg m^2", gt=0)]
Reach = Annotated[list[SignedLength], Field(min_length=2, max_length=2), Entries("[from, to]")]
ROLLER_SHARE = 0.8
"""Of the minimum curvature radius of the pitch curve: the usual maximum roller."""


class Translating(Spec):
    """A follower that slides."""

    direction: Angle = Field(90.0, description="direction of its travel, away from the cam, from +x")
    mass: Kilograms | None = Field(None, description="moved mass, for lift-off and loads")


class Oscillating(Spec):
    """A follower that rocks about a pivot."""

    pivot_direction: Angle = Field(0.0, description="direction from the cam axis to the pivot, from +x")
    side: Assembly = Field(1, description="+1: roller, edge or face left of the vector cam axis -> pivot; -1: right")
    inertia: Inertia | None = Field(None, description="moment of inertia about the pivot, for lift-off and loads")


class OnSlide(Translating):
    """A roller or an edge on a slide."""

    offset: SignedLength | Literal["best"] = Field(
        0.0,
        description="distance of the line of travel from the cam axis on its right; "
        "best: of the smallest cam for the pressure angle",
    )


class TranslatingRoller(OnSlide):
    """A roller on a slide."""

    type: Literal["translating-roller"] = Field(description="motion of the follower, and its contact with the cam")
    roller_radius: Length = Field(description="radius of the roller")


class TranslatingKnifeEdge(OnSlide):
    """A knife edge on a slide."""

    type: Literal["translating-knife-edge"] = Field(description="motion of the follower, and its contact with the cam")


class TranslatingFlat(Translating):
    """A flat face across the travel."""

    type: Literal["translating-flat"] = Field(description="motion of the follower, and its contact with the cam")
    face: Reach | None = Field(None, description="reach of the face to the left and to the right of the travel")


class OnRocker(Oscillating):
    """A roller or an edge on a rocking arm."""

    arm: Length = Field(description="pivot to roller centre or edge")
    center_distance: Length | None = Field(
        None, description="cam axis to pivot; default with cam.size: that of the smallest cam"
    )


class OscillatingRoller(OnRocker):
    """A roller on a rocking arm."""

    type: Literal["oscillating-roller"] = Field(description="motion of the follower, and its contact with the cam")
    roller_radius: Length = Field(description="radius of the roller")


class OscillatingKnifeEdge(OnRocker):
    """A knife edge on a rocking arm."""

    type: Literal["oscillating-knife-edge"] = Field(description="motion of the follower, and its contact with the cam")


class OscillatingFlat(Oscillating):
    """A flat face on a rocking arm."""

    type: Literal["oscillating-flat"] = Field(description="motion of the follower, and its contact with the cam")
    center_distance: Length = Field(description="cam axis to pivot")
    face_offset: SignedLength = Field(0.0, description="distance of the face from the pivot, away from the cam")
    face: Reach | None = Field(None, description="[start, end] of the face, measured along it from the pivot")


Follower = Annotated[
    TranslatingRoller
    | TranslatingKnifeEdge
    | TranslatingFlat
    | OscillatingRoller
    | OscillatingKnifeEdge
    | OscillatingFlat,
    Field(discriminator="type"),
]


class Size(Spec):
    """What the smallest cam keeps."""

    pressure_angle: SteepAngle | Strokes | None = Field(
        None, description="maximum pressure angle, or [rise, return]; default: limits.pressure_angle"
    )
    curvature_radius: Length | None = Field(
        None, description="minimum curvature radius of the pitch curve (flat: of the profile); of a roller radius/0.8"
    )


class CamBody(Spec):
    """The cam."""

    sense: Assembly = Field(1, description="+1: the cam turns counter-clockwise; -1: clockwise")
    prime_radius: Length | None = Field(None, description="cam axis to roller centre at lift 0")
    base_radius: Length | None = Field(None, description="of a face or an edge: cam axis to the surface at lift 0")
    size: Size | None = Field(None, description="the smallest cam that keeps these limits, instead of a radius")
    shaft_radius: Distance = Field(0.0, description="radius of the cam shaft; 0: not checked")
    cutter_radius: Length | None = Field(None, description="radius of the cutter or grinding wheel")

    @property
    def radius(self) -> float | None:
        """Of both radii the given one [mm]."""
        return self.base_radius if self.prime_radius is None else self.prime_radius


class ReturnRoller(Spec):
    """The second roller of a conjugate pair."""

    radius: Length = Field(description="radius of the roller")
    distance: Length | None = Field(
        None, description="translating: distance of both rollers; default: that of equal pitch curves"
    )
    arm: Length | None = Field(None, description="oscillating: pivot to roller centre")
    angle: Angle | None = Field(None, description="oscillating: angle from the first roller's arm to the second's")


class Spring(Spec):
    """The spring that holds the follower on the cam."""

    preload: Annotated[float, unit("N", ge=0), OfFollower("N m")] | None = Field(
        None, description="force at lift 0 (oscillating: N m)"
    )
    rate: Annotated[float, unit("N/mm", ge=0), OfFollower("N m/rad")] = Field(
        0.0, description="rate (oscillating: N m/rad)"
    )
    least_force: Annotated[float, unit("N", ge=0), OfFollower("N m")] | None = Field(
        None, description="minimum contact force required (oscillating: N m), instead of preload"
    )

    @model_validator(mode="after")
    def _one(self) -> Self:
        if (self.preload is None) == (self.least_force is None):
            key = "preload" if self.preload is None else "least_force"
            raise refused("give preload, or least_force instead", key)
        return self


class Errors(Spec):
    """Errors of the cam as manufactured."""

    profile: Distance = Field(0.0, description="error of the profile along its normal")
    run_out: Distance = Field(
        0.0,
        description="total indicator reading of the cam on its shaft",
        json_schema_extra={"unit": "mm", **also("runout")},
    )
    key: Annotated[float, unit("deg", ge=0)] = Field(0.0, description="angular error of the cam on its shaft")
    roller_radius: Distance = Field(0.0, description="error of the roller's radius")
    waves: Annotated[int, unit("1", ge=1, le=10_000)] | None = Field(
        None, description="waves of the profile per revolution"
    )


class Servo(Spec):
    """The table of a drive that makes the motion instead of a cam."""

    rows: Annotated[int, unit("rows", ge=2, le=100_000)] | None = Field(
        None, description="rows of the table, both ends"
    )
    tolerance: Length | None = Field(None, description="maximum position error between rows, instead of rows")

    @model_validator(mode="after")
    def _one(self) -> Self:
        if (self.rows is None) == (self.tolerance is None):
            raise refused("give rows, or tolerance instead", "rows" if self.rows is None else "tolerance")
        return self


class DiscCamLimits(LoadLimits):
    """Limits of the checks."""

    pressure_angle: SteepAngle | Strokes | None = Field(
        None, description="maximum pressure angle, or [rise, return]; 30 translating, 45 oscillating"
    )
    curvature_radius: Distance = Field(
        0.0, description="of a face or an edge: convex radius of the profile below which it warns"
    )
    jerk_step: Distance | None = Field(None, description="maximum jump of the jerk, lift per rad^3")


class DiscCamSpec(OfFollowerKeys, TolerancedSpec):
    """A disc cam with its follower."""

    kind: Literal["disc-cam"]
    motion: FollowerMotion | None = Field(  # type: ignore[assignment]
        None, description="lift over the revolution (mm; oscillating follower: deg): segments with laws, or a table"
    )
    profile: CamProfile | None = Field(
        None, description="arcs of the cam, from which its motion and radius follow, instead of motion"
    )
    follower: Follower = Field(description="follower: roller, knife edge or flat face, translating or oscillating")
    cam: CamBody = Field(CamBody.model_construct(), description="sense and size of the cam")
    closure: Literal["spring", "groove", "conjugate"] = Field(
        "spring", description="what keeps the follower on the cam"
    )
    return_roller: ReturnRoller | None = Field(None, description="the second roller of a conjugate pair")
    spring: Spring | None = Field(None, description="what presses the follower on the cam")
    errors: Errors | None = Field(None, description="errors of the cam as manufactured")
    servo: Servo | None = Field(None, description="table of a drive instead of the cam")
    limits: DiscCamLimits = DiscCamLimits.model_construct()
    loads: Annotated[Any, Deferred("studies.loads.spec:CamLoads")] | None = Field(
        None, description="forces, roller and vibration, for the command loads"
    )

    @property
    def is_flat(self) -> bool:
        """Whether the follower has a flat face."""
        return self.follower.type.endswith("flat")

    @property
    def is_edge(self) -> bool:
        """Whether the follower has a knife edge."""
        return self.follower.type.endswith("edge")

    @property
    def rolls(self) -> bool:
        """Whether the follower has a roller."""
        return self.follower.type.endswith("roller")

    @property
    def radius_key(self) -> str:
        """Key of the cam's radius."""
        if self.profile is not None:
            return "profile.radius" if self.profile.type == "eccentric" else "profile.base_radius"
        return "cam.prime_radius" if self.rolls else "cam.base_radius"

    @property
    def oscillates(self) -> bool:
        """Whether the follower rocks."""
        return self.follower.type.startswith("oscillating")

    @property
    def arcs(self) -> CamProfile | None:
        """The profile that the file gives by its arcs; that of a measured cam is one of points."""
        return self.profile

    @property
    def radius(self) -> float | None:
        """The radius of the cam that the file gives [mm]."""
        if self.profile is None:
            return self.cam.radius
        return self.profile.base_radius + getattr(self.follower, "roller_radius", 0.0)

    @model_validator(mode="after")
    def _runs(self) -> Self:
        if self.motion is not None:
            if self.profile is not None:
                raise refused("profile determines the motion\nomit one of them", "profile")
            require_closed(self.motion, self.initial_lift)
            return self
        if self.profile is None:
            message = "the key 'motion' is missing\ngive motion, a list of segments such as {to: 120, lift: 20, law: "
            message += "cycloidal}, or a table; or profile, such as {type: tangent}"
            raise refused(message, "motion", "GL106")
        if self.oscillates and self.is_flat:
            raise refused("profile does not apply to a flat face that rocks\ngive motion", "profile")
        if self.oscillates and getattr(self.follower, "center_distance", None) is None:
            raise refused("with profile the position of the pivot is not sought\ngive follower.center_distance",
                          "follower.center_distance")  # fmt: skip
        if self.initial_lift:
            raise refused("a profile begins at lift 0\nomit initial_lift", "initial_lift")
        return self

    @model_validator(mode="after")
    def _one_radius(self) -> Self:
        cam = self.cam
        if self.profile is not None:
            for key in ("prime_radius", "base_radius", "size"):
                if getattr(cam, key) is not None:
                    raise refused(f"profile determines the radius of the cam\nomit cam.{key}", f"cam.{key}")
            return self
        wanted, other = ("prime_radius", "base_radius") if self.rolls else ("base_radius", "prime_radius")
        if (given := getattr(cam, other)) is not None:
            message = f"{other} applies only to a roller\ngive cam.base_radius instead"
            if self.rolls:
                whole = given + getattr(self.follower, "roller_radius", 0.0)
                message = f"{other} applies only to a flat face or an edge\ngive cam.prime_radius: {whole:g} (with the "
                message += "roller's radius)"
            raise refused(message, f"cam.{other}")
        if (getattr(cam, wanted) is None) == (cam.size is None):
            both = cam.size is not None
            message = f"{wanted} and size exclude each other\ngive one of them; --set cam.size=null removes the size"
            raise refused(message if both else f"give cam.{wanted}, or cam.size", "cam")
        return self

    @model_validator(mode="after")
    def _size_of_follower(self) -> Self:
        size, follower = self.cam.size, self.follower
        if size is not None and self.is_flat:
            if size.curvature_radius is None:
                raise refused("a flat face is sized by curvature_radius\ngive it", "cam.size")
            if size.pressure_angle is not None:
                raise refused("a flat face is sized by curvature_radius alone\nomit pressure_angle", "cam.size")
        if isinstance(follower, OnSlide):
            if follower.offset == "best":
                if size is None:
                    message = "offset: best applies only with cam.size\ngive cam.size, or a number in mm"
                    raise refused(message, "follower.offset")
            elif (most := self.radius) is not None and abs(follower.offset) >= most:
                limit = f"limit < {most:g} mm, {self.radius_key}"
                message = f"magnitude of the offset: {abs(follower.offset):g} mm ({limit})"
                message += f"\nset follower.offset within -{most:g} and {most:g} mm"
                raise refused(message, "follower.offset")
        if isinstance(follower, OnRocker) and follower.center_distance is None and size is None:
            raise refused("give follower.center_distance, or cam.size that finds the pivot", "follower")
        return self

    @model_validator(mode="after")
    def _closed(self) -> Self:
        roller = self.return_roller
        if not self.rolls and self.closure != "spring":
            raise refused(f"{self.closure} applies only to a roller\nset closure to spring", "closure")
        if (roller is not None) != (self.closure == "conjugate"):
            if roller is None:
                raise refused("give return_roller: {radius: ...}", "closure")
            message = "return_roller needs closure: conjugate\nset closure to conjugate, or omit return_roller"
            raise refused(message, "return_roller")
        if roller is not None:
            own, foreign = (("arm", "angle"), ("distance",)) if self.oscillates else ((), ("arm", "angle"))
            for key in foreign:
                if getattr(roller, key) is not None:
                    raise refused(f"this follower's return roller has no {key}\nomit it", f"return_roller.{key}")
            if any(getattr(roller, key) is None for key in own):
                message = "the return roller of an oscillating follower needs arm and angle\ngive both"
                raise refused(message, "return_roller")
        return self

    @model_validator(mode="after")
    def _without_a_roller(self) -> Self:
        if not self.is_edge:
            return self
        if self.errors is not None and self.errors.roller_radius:
            raise refused("roller_radius applies only to a roller\nomit it", "errors.roller_radius")
        material = None if self.loads is None else self.loads.material
        pressed = {
            "roller": None if self.loads is None else self.loads.roller,
            "material.allowed_pressure": None if material is None else material.allowed_pressure,
        }
        for key, given in pressed.items():
            if given is not None:
                message = "a knife edge has no contact pressure, since its radius is 0"
                message += f"\nomit loads.{key}, or use a roller"
                raise refused(message, f"loads.{key}")
        return self

    def pressure_limits(self) -> tuple[float, float]:
        """Maximum pressure angle of rise and return [deg], of the limits, the size or the usual."""
        size = None if self.cam.size is None else self.cam.size.pressure_angle
        return usual_pressure_limits(self.limits.pressure_angle or size, self.oscillates)


def usual_pressure_limits(given: float | list[float] | None, oscillates: bool) -> tuple[float, float]:
    """Maximum pressure angle of rise and return [deg], as given or the usual 30 deg, of a rocker 45 deg."""
    limit = given or (45.0 if oscillates else 30.0)
    rise, back = limit if isinstance(limit, list) else (limit, limit)
    return rise, back
