"""The design file of a slider that dwells on an arc of a hypocycloid."""

from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import Field, model_validator

from gearlink.core.base.spec import Deferred, DrivenSpec, Length, PressureAngle, Spec, Teeth, only_one, refused, unit
from gearlink.core.parts.gears.train.keys import TrainKeys
from gearlink.core.parts.linkages.spec_parts import LinkageLimits

CarrierAngle = Annotated[float, unit("deg", gt=0, lt=360)]


class HypocycloidGears(TrainKeys):
    """Planet in a fixed ring gear."""

    drawn: ClassVar[tuple[str, ...]] = ("planet", "ring")

    module: Length = Field(description="module")
    planet: Teeth = Field(description="teeth of the planet; the point lies on its pitch circle")
    ring: Teeth = Field(description="teeth of the ring gear, a whole multiple of the planet's, at least 3 times")
    pressure_angle: PressureAngle = Field(20.0, description="pressure angle of the reference profile")

    def rings(self) -> tuple[bool, ...]:
        """The second is one."""
        return False, True

    @model_validator(mode="after")
    def _planet_goes_into_ring(self) -> Self:
        if self.ring <= self.planet:
            message = f"a planet of {self.planet} teeth does not fit into a ring gear of {self.ring}"
            raise refused(f"{message}\nset gears.ring to {3 * self.planet}", "ring")
        return self


class Rod(Spec):
    """The rod from the point to the slider, by length or by rule."""

    length: Length | None = Field(None, description="length of the rod")
    rule: Literal["tangent-circle", "osculating", "minimax"] | None = Field(
        None,
        description="tangent-circle: through the ends of the dwell and its middle; osculating: circle of curvature; "
        "minimax: smallest maximum deviation from the position in mid-dwell",
    )

    @model_validator(mode="after")
    def _one(self) -> Self:
        if self.length is None and self.rule is None:
            raise refused("give length or rule", "rule", "GL106")
        only_one(self, "length", "rule")
        return self


class HypocycloidDwellSection(Spec):
    """The required dwell."""

    angle: CarrierAngle | None = Field(None, description="carrier angle of the dwell; default: the whole arc")
    tolerance: Length | None = Field(
        None, description="+- tolerance of the slider's position; of a slotted arm of its angle, in deg"
    )


class DwellTarget(Spec):
    """The rod is found for it."""

    quality: Literal["least-ripple", "widest-dwell"] = Field(
        description="least-ripple over dwell.angle, or the widest dwell within dwell.tolerance"
    )


class CarrierShaft(Spec):
    """The shaft of the frame, where it passes through the plane of the gears."""

    O_radius: Length | None = Field(None, description="radius of the carrier's shaft, in the middle of the ring gear")


class DrivingPoint(Spec):
    """The point of the planet that moves the output."""

    ratio: Annotated[float, unit("1")] = Field(
        1.0, description="distance of the point from the planet's axis over the pitch radius"
    )


class HypocycloidDwellSpec(DrivenSpec):
    """Ring gear, planet on a carrier, and a rod from a point of the planet to a slider, or an arm with a slot."""

    kind: Literal["hypocycloid-dwell"]
    gears: HypocycloidGears
    output: Literal["slider", "slotted-arm"] = Field(
        "slider", description="slider: on a rod; slotted-arm: turns about the ring's centre, the point in its slot"
    )
    point: DrivingPoint = DrivingPoint.model_construct()
    rod: Rod | None = None
    dwell: HypocycloidDwellSection = HypocycloidDwellSection.model_construct()
    target: DwellTarget | None = None
    limits: LinkageLimits = LinkageLimits.model_construct()
    shafts: CarrierShaft | None = None
    loads: Annotated[Any, Deferred("machines.dwell_gears.loads_spec:HypocycloidLoads")] | None = Field(
        None, description="masses, forces and drive, for the command loads"
    )

    @property
    def is_arm(self) -> bool:
        """Whether an arm with a slot is the output."""
        return self.output == "slotted-arm"

    @model_validator(mode="after")
    def _rod_or_target(self) -> Self:
        if not self.point.ratio > 0.0:
            message = f"point.ratio: {self.point.ratio:g} (limit > 0)\nset point.ratio above 0"
            raise refused(message, "point.ratio", "GL108")
        if self.is_arm:
            for key in ("rod", "target"):
                if getattr(self, key) is not None:
                    raise refused(f"{key} applies only with output: slider\nomit it", key)
            return self
        if self.point.ratio != 1.0 and (self.target is not None or self.rod is None or self.rod.rule is not None):
            message = "rod.rule and target apply only to a point on the pitch circle\ngive rod.length, or point.ratio 1"
            raise refused(message, "point.ratio")
        if self.rod is None and self.target is None:
            raise refused("give rod, or target to have it found", "rod", "GL106")
        if self.rod is not None and self.target is not None:
            raise refused("rod and target exclude each other\nomit rod to have it found", "rod")
        wants_tolerance = self.target is not None and self.target.quality == "widest-dwell"
        if wants_tolerance and self.dwell.tolerance is None:
            raise refused("widest-dwell needs dwell.tolerance", "dwell.tolerance", "GL106")
        return self
