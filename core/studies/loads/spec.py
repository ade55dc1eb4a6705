"""The section `loads` of a design file: what all kinds share; each machine names its own links."""

import itertools
import math
from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator

from gearlink.core.base.spec import Angle, Distance, Entries, Length, Spec, only_one, refused, unit
from gearlink.core.base.torsion import OfShaft
from gearlink.core.base.wording import unlike

Kilograms = Annotated[float, unit("kg", ge=0, le=1e9)]
Inertia = Annotated[float, unit("kg m^2", ge=0, le=1e12)]
Place = Annotated[float, unit("mm", ge=-1e6, le=1e6)]
Vector = Annotated[list[Place], Field(min_length=2, max_length=2), Entries("[x, y]")]
Newton = Annotated[float, unit("N", ge=-1e12, le=1e12)]
NewtonMetre = Annotated[float, unit("N m", ge=-1e12, le=1e12)]
Gravity = Annotated[float, unit("m/s^2", ge=-1e3, le=1e3)]
Speed = Annotated[float, unit("1/min", ge=-1e6, le=1e6)]
Number = Annotated[float, unit("1", ge=-1e12, le=1e12)]
Coefficient = Annotated[float, unit("1", ge=0, lt=1)]
Pair = Annotated[list[Number], Field(min_length=2, max_length=2), Entries("[angle, value]", units=("deg",))]
AboveZero = Annotated[float, unit("N/mm", gt=0, le=1e12)]


def masses(of: type[Spec]) -> Any:
    """The key `links` of a section `loads`, by default without any mass."""
    return Field(of.model_construct(), description="masses of the links; a part without an entry has no mass")


class Body(Spec):
    """Mass of a link; keys that are not given are zero."""

    mass: Kilograms = Field(0.0, description="mass")
    inertia: Inertia = Field(0.0, description="moment of inertia about the centre of mass; 0: a point mass")
    center: Vector | None = Field(
        None, description="centre of mass in link coordinates: origin at the first joint, x to the second"
    )


class Zone(Spec):
    """A stretch of the input's turn with a constant value; zero outside of all zones."""

    start: Angle = Field(alias="from", description="input angle at the start of the zone")
    end: Angle = Field(alias="to", description="input angle at the end of the zone")
    value: Number = Field(description="torque (N m) or force (N) in the zone")

    @model_validator(mode="after")
    def _some_width(self) -> Self:
        if self.start == self.end:
            raise refused("this zone is empty: its end equals its start", "to")
        return self


class Course(Spec):
    """A value over the input angle, repeated every 360 deg: a table of [angle, value], or zones."""

    table: Annotated[list[Pair], Field(min_length=1, max_length=10_000)] | None = Field(
        None, description="pairs [input angle, value], ascending, within one revolution"
    )
    interpolation: Literal["step", "linear", "cubic"] = Field("linear", description="between the pairs of the table")
    zones: Annotated[list[Zone], Field(min_length=1, max_length=1000)] | None = Field(
        None, description="zones of constant value, instead of a table"
    )

    @model_validator(mode="after")
    def _one(self) -> Self:
        if (self.table is None) == (self.zones is None):
            raise refused("give either table or zones", "zones" if self.table else "table")
        if self.table is not None:
            angles = [angle for angle, _ in self.table]
            back = next((i for i, (a, b) in enumerate(itertools.pairwise(angles), 1) if b <= a), 0)
            if back:
                message = (
                    f"the angles of a table must ascend: table[{back}] is at "
                    f"{unlike(angles[back], angles[back - 1])} deg, after {unlike(angles[back - 1], angles[back])} deg"
                )
                raise refused(message, f"table[{back}]")
            if angles[-1] - angles[0] > 360.0:
                raise refused("a table covers one revolution at most", "table")
            if angles[-1] - angles[0] == 360.0 and self.table[0][1] != self.table[-1][1]:
                message = "a table over a whole revolution must end with its first value, or omit the last pair"
                raise refused(message, "table")
            if self.interpolation == "cubic" and len(angles) < 3:
                raise refused("cubic needs at least three pairs", "interpolation")
        return self


class Load(Spec):
    """One applied force or torque."""

    on: str = Field(description="the link that it acts on")
    torque: NewtonMetre | Course | None = Field(None, description="torque, positive counter-clockwise")
    force: Newton | Course | Annotated[list[Newton], Field(min_length=2, max_length=2), Entries("[x, y]")] | None = (
        Field(
            None,
            description="on a slider: along its travel; with `point`: the vector [x, y] in the frame's coordinates",
        )
    )
    point: Vector | None = Field(None, description="point of the link where the vector acts, in link coordinates")
    resistance: Annotated[float, unit("1", ge=0, le=1e12)] | None = Field(
        None, description="force (N) or torque (N m) opposite to the motion"
    )

    @model_validator(mode="after")
    def _one(self) -> Self:
        given = [name for name in ("torque", "force", "resistance") if getattr(self, name) is not None]
        if len(given) != 1:
            message = "give torque, force or resistance" if not given else "give one of torque, force and resistance"
            raise refused(message, given[1] if given else "on")
        if isinstance(self.force, list) and self.point is None:
            raise refused("a force [x, y] needs the point where it acts", "force", "GL106")
        if self.point is not None and not isinstance(self.force, list):
            raise refused("point applies only to a force [x, y]", "point")
        return self


class Spring(Spec):
    """A helical spring between points of two links, or of a link and the frame."""

    between: Annotated[list[str], Field(min_length=2, max_length=2), Entries("[link, link or frame]")] = Field(
        description="two links, or one and frame"
    )
    points: Annotated[list[Vector], Field(min_length=2, max_length=2), Entries("[[x, y], [x, y]]")] = Field(
        description="end points of the spring, each in the coordinates of its link; on the frame in those of the design"
    )
    rate: Annotated[float, unit("N/mm", ge=0, le=1e9)] = Field(description="spring rate")
    free_length: Length = Field(description="length without force (with preload: at the preload)")
    preload: Newton = Field(0.0, description="pull at the free length")


class Friction(Spec):
    """Coefficients of friction; a joint of its own has its own key."""

    pins: Coefficient = Field(0.0, description="coefficient of friction in all pins")
    pin_radius: Annotated[float, unit("mm", ge=0, le=1e5)] = Field(0.0, description="radius of the pins")
    guides: Coefficient = Field(0.0, description="coefficient of friction in all guides")
    contacts: Coefficient = Field(
        0.0, description="coefficient of friction of flat faces and knife edges on their cams"
    )
    meshes: Annotated[float, unit("1", gt=0, le=1)] = Field(
        1.0, description="efficiency of all gear meshes, output over input power whichever gear drives"
    )
    joints: dict[str, Annotated[float, unit("1", ge=0, le=1)]] = Field(
        {}, description="coefficient of a pin, guide, face or edge, or efficiency of a mesh, by its name"
    )


class Flywheel(Spec):
    """A flywheel on the input shaft."""

    inertia: Annotated[float, unit("kg m^2", ge=0, le=1e12)] | None = Field(
        None, description="moment of inertia of the flywheel"
    )
    fluctuation: Annotated[float, unit("1", gt=0, lt=1)] | None = Field(
        None, description="allowed (maximum - minimum)/mean speed, mean of these two; alone: the inertia is found"
    )

    @model_validator(mode="after")
    def _something(self) -> Self:
        if self.inertia is None and self.fluctuation is None:
            raise refused("give inertia, fluctuation or both", "inertia", "GL106")
        return self


class Motor(Spec):
    """A motor whose torque falls linearly with its speed."""

    no_load_speed: Annotated[float, unit("1/min", gt=0, le=1e7)] = Field(
        description="no-load speed of the motor's shaft"
    )
    rated_speed: Annotated[float, unit("1/min", gt=0, le=1e7)] | None = Field(None, description="speed at rated_torque")
    rated_torque: Annotated[float, unit("N m", gt=0, le=1e9)] | None = Field(
        None, description="rated continuous torque"
    )
    slope: Annotated[float, unit("N m s", gt=0, le=1e12)] | None = Field(
        None, description="torque lost per rad/s, instead of rated_speed and rated_torque"
    )
    inertia: Inertia = Field(0.0, description="moment of inertia at the motor's shaft")
    ratio: Annotated[float, unit("1", gt=0, le=1e6)] = Field(
        1.0, description="motor revolutions per revolution of the input"
    )
    max_torque: Annotated[float, unit("N m", gt=0, le=1e9)] | None = Field(
        None, description="maximum short-time torque"
    )

    @model_validator(mode="after")
    def _characteristic(self) -> Self:
        if self.slope is None and (self.rated_speed is None or self.rated_torque is None):
            raise refused("give rated_speed and rated_torque, or slope", "rated_speed", "GL106")
        only_one(self, "slope", "rated_speed", at="slope")
        if self.rated_speed is not None and self.rated_speed >= self.no_load_speed:
            message = (
                f"rated_speed, {self.rated_speed:g} 1/min, must lie below no_load_speed, {self.no_load_speed:g} 1/min"
            )
            raise refused(message, "rated_speed")
        return self


class Bearing(Spec):
    """A bearing of a pin."""

    kind: Literal["ball", "roller", "needle", "plain"] = Field(description="rolling or plain bearing")
    dynamic_rating: Annotated[float, unit("N", gt=0, le=1e12)] | None = Field(
        None, description="basic dynamic load rating C"
    )
    life: Annotated[float, unit("h", gt=0, le=1e9)] | None = Field(None, description="minimum life")
    reliability: Annotated[float, unit("%", ge=90, le=99.95)] = Field(
        90.0, description="share of bearings that reach the life"
    )
    width: Length | None = Field(None, description="plain: width b")
    diameter: Length | None = Field(None, description="plain: diameter d")
    rolling_bodies: Annotated[int, unit("1", ge=3, le=1000)] | None = Field(
        None, description="number of rolling elements in a row"
    )

    @model_validator(mode="after")
    def _complete(self) -> Self:
        if self.kind == "plain" and (self.width is None or self.diameter is None):
            raise refused("a plain bearing needs width and diameter", "kind", "GL106")
        rating = next((name for name in ("life", "dynamic_rating") if getattr(self, name) is not None), None)
        if self.kind == "plain" and rating is not None:
            raise refused(f"a plain bearing has no rating life, only bearing_pressure\nomit {rating}", rating)
        if self.kind != "plain" and self.dynamic_rating is None:
            raise refused("a rolling bearing needs dynamic_rating", "kind", "GL106")
        return self

    @property
    def reliability_factor(self) -> float:
        """a_1 of ISO 281: life of that reliability over the one that 90 % reach.

        a_1 = 0.05 + 0.95 (ln(100/S)/ln(100/90))^(2/3)

        Source
            ISO/TR 1281-2, Weibull's distribution with slope 1.5 above 0.05 L_10; rounded it is table 12 of ISO 281:2007
        """
        share: float = math.log(100.0 / self.reliability) / math.log(100.0 / 90.0)
        return 0.05 + 0.95 * math.cbrt(share * share)


class Vibration(Spec):
    """The output as a mass on a spring."""

    frequency: Annotated[float, unit("Hz", gt=0, le=1e7)] | None = Field(None, description="natural frequency")
    stiffness: Annotated[float, unit("1", gt=0, le=1e12)] | OfShaft | None = Field(
        None, description="instead of frequency: of the output shaft (N m/rad or its sizes) or a slider's drive (N/mm)"
    )
    damping: Coefficient | None = Field(None, description="damping ratio; default: 0.03, assumed")
    allowed_residual: Annotated[float, unit("1", gt=0, le=1e6)] | None = Field(
        None, description="maximum residual vibration in the dwell, deg or mm like the output"
    )

    @model_validator(mode="after")
    def _one(self) -> Self:
        if (self.frequency is None) == (self.stiffness is None):
            raise refused("give either frequency or stiffness", "frequency", "GL106")
        return self


class Roller(Spec):
    """The cam's rollers."""

    width: Length = Field(description="width of the contact")
    inertia: Inertia = Field(0.0, description="moment of inertia of a roller about its axis")
    friction: Coefficient = Field(0.08, description="coefficient of friction of roller and cam")
    bearing_moment: Annotated[float, unit("N m", ge=0, le=1e9)] = Field(
        0.0, description="friction torque of the roller's bearing"
    )
    preload: Annotated[float, unit("N", ge=0, le=1e12)] = Field(
        0.0, description="force between both rollers and their cams at rest, where two rollers run on two cams"
    )
    stiffness: (
        Annotated[list[AboveZero], Field(min_length=2, max_length=2), Entries("[main roller, return roller]")] | None
    ) = Field(None, description="stiffness of the contact of main and return roller, N/mm")


class Material(Spec):
    """Cam and roller, of one material."""

    modulus: Annotated[float, unit("N/mm^2", gt=0, le=1e7)] = Field(206_000.0, description="modulus of elasticity")
    poisson: Annotated[float, unit("1", ge=0, lt=0.5)] = Field(0.3, description="Poisson's ratio")
    allowed_pressure: Annotated[float, unit("N/mm^2", gt=0, le=1e7)] | None = Field(
        None, description="maximum Hertzian pressure"
    )


class Balance(Spec):
    """Counterweights."""

    share: Annotated[float, unit("1", ge=0, le=1)] = Field(1.0, description="share of the full force balance")


class CommonLoads(Spec):
    """What the loads of every kind may say."""

    gravity: Annotated[list[Gravity], Field(min_length=2, max_length=2), Entries("[x, y]", "[0, -9.81]")] = Field(
        [0.0, 0.0], description="acceleration of gravity in the design's frame"
    )
    forces: Annotated[list[Load], Field(max_length=1000)] = Field([], description="applied forces and torques")
    springs: Annotated[list[Spring], Field(max_length=1000)] = Field([], description="springs between links")
    friction: Friction | None = None
    flywheel: Flywheel | None = None
    motor: Motor | None = None
    bearings: Annotated[dict[str, Bearing], Field(max_length=100)] = Field({}, description="bearings by the pin's name")
    backlash: Distance | dict[str, Distance] | None = Field(
        None, description="play of the teeth at the pitch circle, of all meshes or by mesh"
    )
    vibration: Vibration | None = None


class Loads(CommonLoads):
    """The loads of a kind that is driven at a speed of its own."""

    speed: Speed | None = Field(None, description="speed of the input, signed; default: input_speed")


class CamLoads(CommonLoads):
    """Forces, rollers and vibration of a cam's follower; masses, spring and speed stand in sections of their own."""

    roller: Roller | None = None
    material: Material | None = None


def of_body(spec: Any, name: str) -> Body:
    """The mass that a section `links` gives a link; a link of no mass where it gives none."""
    found: Body | None = getattr(spec, name, None)
    return Body() if found is None else found
