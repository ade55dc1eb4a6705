"""The design file of a dwell by a mutilated gear."""

from typing import Annotated, Any, ClassVar, Literal, Self, TypeAlias

from pydantic import Field, model_validator

from gearlink.core.base.spec import (
    Angle,
    Assembly,
    Deferred,
    DrivenSpec,
    Length,
    PressureAngle,
    Spec,
    Teeth,
    only_one,
    refused,
    unit,
)
from gearlink.core.parts.gears.train.keys import TrainKeys
from gearlink.core.parts.linkages.spec_parts import LinkageLimits
from gearlink.core.parts.linkages.spec_sections import FourLinks, PivotShafts

Turns: TypeAlias = Annotated[float, unit("1", gt=0, le=1e6)]
Millis: TypeAlias = Annotated[float, unit("ms", gt=0, le=1e9)]


class MutilatedGears(TrainKeys):
    """The mutilated wheel and the gear that it drives."""

    drawn: ClassVar[tuple[str, ...]] = ("wheel", "driven")

    module: Length = Field(description="module of both")
    full_teeth: Teeth | None = Field(
        None,
        description="number of teeth on the whole pitch circle of the wheel; chosen where required times are given",
    )
    group_teeth: Teeth | None = Field(None, description="teeth in a group; chosen where required times are given")
    groups: Teeth = Field(1, description="groups of teeth, evenly spaced on the wheel")
    driven: Teeth | None = Field(None, description="teeth of the driven gear; default with required times: chosen")
    stops: Teeth | None = Field(
        None,
        description="locking arcs, evenly spaced on the driven gear; default: 1, or as many as the required times need",
    )
    pressure_angle: PressureAngle = Field(20.0, description="pressure angle of the reference profile")


class MutilatedShafts(PivotShafts):
    """Shafts of the frame that pass through the plane of the gears; a shaft without an entry may end before it."""

    A_radius: Length | None = Field(None, description="radius of the shaft at A, of driven gear and crank")
    W_radius: Length | None = Field(None, description="radius of the shaft of the mutilated wheel, W")


class Locking(Spec):
    """A disc next to the wheel and a plate with concave arcs next to the driven gear, which hold it in its dwell."""

    radius: Length | None = Field(None, description="radius of the disc's arcs; default: pitch radius of the wheel")
    plate_radius: Length = Field(description="outer radius of the plate")
    clearance: Annotated[float, unit("mm", ge=0, le=10)] = Field(
        0.0, description="radius of the plate's arcs less that of the disc"
    )


class WantedTimes(Spec):
    """The required motion and dwell, in revolutions of the input or, at input_speed, in time; teeth are chosen."""

    motion_turns: Turns | None = Field(None, description="input turns while the driven gear turns")
    dwell_turns: Turns | None = Field(None, description="input revolutions while it dwells")
    motion_time: Millis | None = Field(None, description="instead of motion_turns, at input_speed")
    dwell_time: Millis | None = Field(None, description="instead of dwell_turns, at input_speed")
    driven_turn: Turns = Field(1.0, description="turns of the driven gear in a motion, a fraction of whole teeth")
    most_teeth: Teeth = Field(200, description="maximum number of teeth on the whole pitch circle of the wheel")
    tolerance: Annotated[float, unit("1", gt=0, lt=1)] = Field(
        0.01, description="maximum relative deviation of motion or dwell"
    )

    @model_validator(mode="after")
    def _one_each(self) -> Self:
        for name in ("motion", "dwell"):
            needed = f"give {name}_turns, or {name}_time with input_speed"
            only_one(self, f"{name}_turns", f"{name}_time", needed=needed)
        return self


class MutilatedGearDwellSpec(DrivenSpec):
    """Reduction, mutilated wheel, driven gear and, on its shaft, the crank of a four-bar."""

    kind: Literal["mutilated-gear-dwell"]
    reduction: Annotated[float, unit("1", gt=0, le=1e6)] | None = Field(
        None, description="input revolutions per revolution of the mutilated wheel; required times give it"
    )
    target: WantedTimes | None = Field(None, description="required motion and dwell")
    gears: MutilatedGears
    links: FourLinks | None = Field(None, description="the four-bar that the driven gear drives")
    assembly: Assembly = Field(1, description="+1: C left of the vector from B to D; -1: its mirror image")
    start_angle: Angle | None = Field(
        None, description="crank angle at which the crank is at rest; default: crank and coupler stretched"
    )
    locking: Locking | None = Field(None, description="disc and plate that hold the driven gear in its dwell")
    limits: LinkageLimits = LinkageLimits.model_construct()
    shafts: MutilatedShafts | None = None
    loads: Annotated[Any, Deferred("machines.dwell_gears.loads_spec:MutilatedLoads")] | None = Field(
        None, description="masses, forces and drive, for the command loads"
    )

    @model_validator(mode="after")
    def _teeth_or_times(self) -> Self:
        values = {
            "reduction": self.reduction,
            "gears.full_teeth": self.gears.full_teeth,
            "gears.group_teeth": self.gears.group_teeth,
            "gears.driven": self.gears.driven,
        }
        if self.target is None:
            missing = [key for key, value in values.items() if value is None]
            if missing:
                message = f"the key {missing[0]} is missing; or give the section target: motion_turns, dwell_turns"
                raise refused(message, missing[0], "GL106")
            return self
        given = [key for key in ("reduction", "gears.full_teeth", "gears.group_teeth") if values[key] is not None]
        if given:
            raise refused(f"{given[0]} follows from the times in target\nomit it", given[0])
        timed = self.target.motion_time is not None or self.target.dwell_time is not None
        if timed and self.input_speed is None:
            message = "a time needs the input's speed\ngive input_speed, or turns instead of times"
            raise refused(message, "input_speed", "GL106")
        return self

    def wanted_turns(self) -> tuple[float, float]:
        """Input turns of motion and dwell that target asks for."""
        assert self.target is not None, "needed where there is a target"
        turn = 60_000.0 / self.input_speed if self.input_speed else 0.0
        pairs = ((self.target.motion_turns, self.target.motion_time), (self.target.dwell_turns, self.target.dwell_time))
        motion, dwell = (turns if turns is not None else (time or 0.0) / turn for turns, time in pairs)
        return motion, dwell

    @model_validator(mode="after")
    def _shaft_of_the_rocker(self) -> Self:
        if self.links is None and self.shafts is not None and self.shafts.D_radius is not None:
            raise refused("D_radius applies only with the four-bar\ngive links, or omit it", "shafts.D_radius")
        return self
