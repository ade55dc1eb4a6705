"""The design file of a rocker whose swing a gear multiplies."""

from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import Field, model_validator

from gearlink.core.base.spec import Assembly, Deferred, DrivenSpec, Length, PressureAngle, Spec, Teeth, refused, unit
from gearlink.core.parts.gears.train.keys import TrainKeys
from gearlink.core.parts.linkages.spec_parts import LinkageLimits


class RockerGears(TrainKeys):
    """A gear fixed to the coupler at C, in mesh with the output gear on the rocker's axis."""

    drawn: ClassVar[tuple[str, ...]] = ("coupler", "output")

    module: Length = Field(description="module")
    coupler: Teeth = Field(description="teeth z2 of the gear fixed to the coupler at C")
    output: Teeth = Field(description="teeth z5 of the output gear on D")
    pressure_angle: PressureAngle = Field(20.0, description="pressure angle of the reference profile")


class RockerLinks(Spec):
    """The links that the gears do not fix."""

    crank: Length | None = Field(None, description="crank AB; default: found from target.swing")
    coupler: Length = Field(description="coupler BC")
    rocker: Length | None = Field(None, description="rocker CD; default: the centre distance of the gears")
    frame: Length = Field(description="frame AD")


class SwingTarget(Spec):
    """The crank is found for it."""

    swing: Annotated[float, unit("deg", gt=0, lt=3600)] = Field(description="swing of the output gear")


class GearedRockerSpec(DrivenSpec):
    """A crank-rocker whose coupler carries a gear that drives one on the rocker's axis."""

    kind: Literal["geared-rocker"]
    gears: RockerGears
    links: RockerLinks
    assembly: Assembly = Field(1, description="+1: C left of the vector from B to D; -1: its mirror image")
    target: SwingTarget | None = None
    limits: LinkageLimits = LinkageLimits.model_construct()
    shafts: Annotated[Any, Deferred("parts.linkages.spec_sections:PivotShafts")] | None = Field(
        None,
        description="shafts of the frame through the plane of the gears; a shaft without an entry may end before it",
    )
    loads: Annotated[Any, Deferred("machines.planet_linkages.loads_spec:PlanetLoads")] | None = Field(
        None, description="masses, forces and drive, for the command loads"
    )

    @model_validator(mode="after")
    def _crank_or_swing(self) -> Self:
        if self.links.crank is None and self.target is None:
            raise refused("give links.crank, or target.swing to have it found", "links.crank", "GL106")
        if self.links.crank is not None and self.target is not None:
            raise refused(
                "links.crank and target.swing exclude each other\nomit links.crank to have it found", "links.crank"
            )
        return self
