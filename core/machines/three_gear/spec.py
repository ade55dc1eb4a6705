"""The design file of a three-gear four-bar."""

from typing import Annotated, Any, ClassVar, Literal, Self, TypeAlias

from pydantic import AfterValidator, Field, model_validator

from gearlink.core.base.real_speed import other_speed
from gearlink.core.base.spec import (
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
from gearlink.core.parts.linkages.spec_parts import DwellTolerance, LinkageLimits, require_rim


def _some_teeth(teeth: int) -> int:
    if teeth == 0:
        raise refused("teeth must be 1 or more, or -1 or less for a ring gear, not 0", "", "GL108")
    return teeth


SignedTeeth: TypeAlias = Annotated[
    int,
    Field(ge=-10_000, le=10_000, json_schema_extra={"unit": "teeth", "not": {"const": 0}}),
    AfterValidator(_some_teeth),
]


class Gears(TrainKeys):
    """The three gears in mesh; the idler stands on the pin of coupler and rocker."""

    drawn: ClassVar[tuple[str, ...]] = ("crank", "idler", "output")

    module: Length = Field(description="module of all three gears")
    crank: SignedTeeth = Field(description="teeth of the gear fixed to the crank; negative: a ring round the idler")
    idler: Teeth | None = Field(None, description="teeth of the idler; default: chosen by the synthesis")
    output: SignedTeeth = Field(description="teeth of the output gear on the rocker's axis; negative: a ring gear")
    i3: Annotated[float, unit("1", lt=0)] | None = Field(None, description="-idler/output, instead of idler")
    rim: Length | None = Field(
        None, description="outer radius of the output ring; default: 2 modules outside its root circle"
    )
    pressure_angle: PressureAngle = Field(20.0, description="pressure angle of the reference profile")

    def rings(self) -> tuple[bool, ...]:
        """Crank and output gear may be rings."""
        return self.crank < 0, False, self.output < 0

    @model_validator(mode="after")
    def _rings_are_larger(self) -> Self:
        for key, teeth in (("crank", self.crank), ("output", self.output)):
            if teeth < 0 and self.idler is not None and -teeth <= self.idler:
                message = f"an idler of {self.idler} teeth does not fit into a ring gear of {-teeth}"
                raise refused(f"{message}\nset gears.{key} to at most -{self.idler + 1}", key)
        if self.i3 is not None and min(self.crank, self.output) < 0:
            message = "i3 applies only to external gears\ngive idler instead of i3"
            raise refused(message, "i3")
        ring = -self.output if self.output < 0 else None
        require_rim(self.rim, ring, self.module, own_teeth=self.own_teeth)
        return self

    @model_validator(mode="after")
    def _one_ratio(self) -> Self:
        only_one(self, "i3", "idler", at="i3")
        if self.i3 is not None and self.crank != self.output:
            message = (
                f"i3 applies only to equal crank and output teeth\nset gears.output to {self.crank}, or give idler "
                "instead of i3"
            )
            raise refused(message, "output")
        return self


UniformTolerance = Annotated[float, unit("1", gt=0, lt=1)]


class Links(Spec):
    """The links that the gears do not fix."""

    crank: Length = Field(description="crank AB")
    frame: Length = Field(description="frame AD")


class ThreeGearSpec(DrivenSpec):
    """Gear on the crank, idler on the coupler pin, output gear on the rocker's axis."""

    kind: Literal["three-gear-four-bar"]
    gears: Gears
    links: Links | None = None
    assembly: Assembly = Field(1, description="+1: C left of the vector from B to D; -1: its mirror image")
    dwell: Annotated[Any, Deferred("machines.three_gear.dwell_spec:Dwell")] | None = Field(
        None,
        description="specification for `synth dwell`: a crank angle until the output is back, or one within a "
        "tolerance",
    )
    back_step: Annotated[Any, Deferred("machines.three_gear.task_spec:BackStep")] | None = Field(
        None, description="specification for `synth back-step`"
    )
    speed: Annotated[Any, Deferred("machines.three_gear.task_spec:Speed")] | None = Field(
        None, description="specification for `synth variable-speed`; the input turns at the mean of the two"
    )
    momentary: Annotated[Any, Deferred("machines.three_gear.task_spec:Momentary")] | None = Field(
        None, description="for `synth momentary-dwell`: exactly one of eccentricity, frame, gap, balanced"
    )
    dwell_tolerance: DwellTolerance | None = Field(None, description="output tolerance +- for the tolerance dwell")
    dwell_window: Annotated[float, unit("deg", gt=0, lt=360)] | None = Field(
        None, description="crank angle over which the output must stay within that tolerance"
    )
    dwell_backlash: Annotated[Length, Field(ge=1e-9)] | None = Field(
        None, description="play at the output gear's reference circle, instead of dwell_tolerance"
    )
    uniform_tolerance: UniformTolerance | None = Field(
        None,
        description=(
            "permitted relative deviation of the output speed from a level: the longest crank angle of such nearly "
            "uniform speed is given"
        ),
    )
    feed: Annotated[Any, Deferred("parts.linkages.spec_sections:Feed")] | None = Field(
        None, description="what the output feeds: a roller or belt by its radius, or a chain by pitch and teeth"
    )
    limits: LinkageLimits = LinkageLimits.model_construct()
    shafts: Annotated[Any, Deferred("machines.three_gear.task_spec:Shafts")] | None = Field(
        None, description="shafts that pass through the plane of the gears"
    )
    loads: Annotated[Any, Deferred("machines.three_gear.loads_spec:ThreeGearLoads")] | None = Field(
        None, description="masses, forces and drive, for the command loads"
    )

    @model_validator(mode="after")
    def _one_tolerance(self) -> Self:
        only_one(self, "dwell_tolerance", "dwell_backlash")
        if self.dwell is not None and self.dwell.tolerance is not None and self.dwell_tolerance is not None:
            message = "dwell_tolerance and dwell.tolerance specify the same\nomit dwell_tolerance or dwell.tolerance"
            raise refused(message, "dwell_tolerance")
        if self.dwell_window is not None and self.dwell_tolerance is None and self.dwell_backlash is None:
            message = "dwell_window needs dwell_tolerance or dwell_backlash\nadd dwell_tolerance or dwell_backlash"
            raise refused(message, "dwell_window")
        return self

    @model_validator(mode="after")
    def _lay_has_a_speed(self) -> Self:
        if self.feed is not None and self.feed.lay is not None and self.input_speed is None and self.speed is None:
            message = "the speed at the lay needs the input speed\ngive input_speed"
            raise refused(message, "input_speed", "GL106")
        return self

    @model_validator(mode="after")
    def _one_speed(self) -> Self:
        if (
            self.speed is None
            or self.speed.uniform_angle is not None
            or self.gears.crank != self.gears.output
            or self.speed.crank
            or self.speed.frame
        ):
            return self
        if wrong := other_speed(self.input_speed, 0.5 * (self.speed.min + self.speed.max)):
            raise refused(wrong, "input_speed")
        return self

    def syntheses(self) -> tuple[str, ...]:
        """The syntheses that the file has a section for."""
        asked = {
            "synth dwell": self.dwell,
            "synth back-step": self.back_step,
            "synth variable-speed": self.speed,
            "synth momentary-dwell": self.momentary,
        }
        return tuple(command for command, section in asked.items() if section is not None)

    def commands(self) -> tuple[str, ...]:
        """What the file asks for: a synthesis per section, an analysis of given links, the loads with theirs."""
        analysis = ("analyze",) if self.links is not None else ()
        loads = self._loads()
        gears = ("gear",) if self.gears.drawing else ()
        return (*((*self.syntheses(), *analysis) or ("analyze",)), *loads, *gears)

    def sized_by(self, command: str) -> str:
        """The one synthesis of the file, where it leaves out what an analysis or the gears need."""
        needs_links = command == "analyze" and self.links is None
        needs_idler = command == "gear" and self.gears.idler is None and self.gears.i3 is None
        asked = self.syntheses()
        return asked[0] if (needs_links or needs_idler) and len(asked) == 1 else ""
