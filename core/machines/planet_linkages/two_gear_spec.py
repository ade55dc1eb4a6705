"""The design file of a two-gear four-bar."""

from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator

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
from gearlink.core.parts.linkages.dwell_band_spec import DwellBand
from gearlink.core.parts.linkages.spec_parts import DwellTolerance, LinkageLimits, require_rim


class PlanetGears(TrainKeys):
    """Planet on the coupler at B, in mesh with a sun or a ring gear free on A."""

    module: Length = Field(description="module")
    planet: Teeth = Field(description="teeth z2 of the gear fixed to the coupler at B")
    sun: Teeth | None = Field(None, description="teeth z5 of an external output gear on A")
    ring: Teeth | None = Field(None, description="teeth z5 of an internal output gear on A, instead of sun")
    rim: Length | None = Field(
        None, description="outer radius of the ring gear; default: 2 modules outside its root circle"
    )
    pressure_angle: PressureAngle = Field(20.0, description="pressure angle of the reference profile")

    def gear_names(self) -> tuple[str, ...]:
        """Planet, and sun or ring."""
        return "planet", "sun" if self.ring is None else "ring"

    def rings(self) -> tuple[bool, ...]:
        """The output gear may be a ring."""
        return False, self.ring is not None

    @model_validator(mode="after")
    def _one_output(self) -> Self:
        only_one(self, "sun", "ring", needed="give sun or ring, the output gear on A")
        if self.ring is not None and self.ring <= self.planet:
            message = f"a planet of {self.planet} teeth does not fit into a ring gear of {self.ring}"
            raise refused(f"{message}\nset gears.ring to at least {self.planet + 1}", "ring")
        require_rim(self.rim, self.ring, self.module, own_teeth=self.own_teeth)
        return self


class TwoGearLinks(Spec):
    """The links that the gears do not fix."""

    crank: Length | None = Field(None, description="crank AB; default: the centre distance of the gears")
    coupler: Length = Field(description="coupler BC")
    rocker: Length = Field(description="rocker CD")
    frame: Length | None = Field(None, description="frame AD; not given if the synthesis determines it")


class StandingDwell(DwellBand):
    """Specification for `synth dwell`: crank angle over which the output stays within a tolerance; gives the frame."""

    @model_validator(mode="after")
    def _one_request(self) -> Self:
        if self.window is None and self.tolerance is None:
            raise refused("give window, tolerance or both", "tolerance", "GL106")
        if self.margin is not None and self.window is not None:
            raise refused("margin applies only with tolerance alone\nomit it", "margin")
        return self


class BackStepAngle(Spec):
    """Specification for `synth back-step`; the frame is sought."""

    angle: Annotated[float, unit("deg", gt=0, lt=360)] = Field(description="back-step of the output")


class MotionTarget(Spec):
    """What the output shall do; otherwise there is an error or a failed check."""

    motion: Literal["unidirectional", "momentary-dwell", "back-step"] = Field(description="kind of output motion")


class TwoGearFourBarSpec(DrivenSpec):
    """A four-bar whose coupler carries a gear that drives one on the crank's axis."""

    kind: Literal["two-gear-four-bar"]
    gears: PlanetGears
    links: TwoGearLinks
    assembly: Assembly = Field(1, description="+1: C left of the vector from B to D; -1: its mirror image")
    target: MotionTarget | None = None
    dwell: StandingDwell | None = None
    back_step: BackStepAngle | None = None
    dwell_tolerance: Annotated[DwellTolerance, Field(lt=180)] | None = Field(
        None, description="output tolerance +- within which a dwell is measured"
    )
    dwell_window: Annotated[float, unit("deg", gt=0, lt=360)] | None = Field(
        None, description="crank angle over which the output must stay within that tolerance"
    )
    feed: Annotated[Any, Deferred("parts.linkages.spec_sections:Feed")] | None = Field(
        None, description="what the output feeds: a roller or belt by its radius, or a chain by pitch and teeth"
    )
    limits: LinkageLimits = LinkageLimits.model_construct()
    shafts: Annotated[Any, Deferred("parts.linkages.spec_sections:PivotShafts")] | None = Field(
        None,
        description="shafts of the frame through the plane of the gears; a shaft without an entry may end before it",
    )
    loads: Annotated[Any, Deferred("machines.planet_linkages.loads_spec:PlanetLoads")] | None = Field(
        None, description="masses, forces and drive, for the command loads"
    )

    @model_validator(mode="after")
    def _frame_given_or_sought(self) -> Self:
        syntheses = self._syntheses()
        if self.links.frame is None and not syntheses:
            message = (
                "frame is missing, and nothing determines it\ngive frame, or dwell, back_step, or target with motion: "
                "momentary-dwell"
            )
            raise refused(message, "links.frame", "GL106")
        sections = [name for name in ("dwell", "back_step") if getattr(self, name) is not None]
        if self.links.frame is not None and sections:
            message = f"{sections[0]} determines links.frame\nomit one of them"
            raise refused(message, "links.frame")
        return self

    @model_validator(mode="after")
    def _one_tolerance(self) -> Self:
        if self.dwell_tolerance is not None and self.dwell is not None:
            message = "dwell_tolerance evaluates a given frame, but dwell determines the frame\nomit one of them"
            raise refused(message, "dwell_tolerance")
        if self.dwell_window is not None and self.dwell_tolerance is None:
            raise refused("dwell_window needs dwell_tolerance\ngive it too", "dwell_window")
        return self

    @model_validator(mode="after")
    def _lay_has_a_speed(self) -> Self:
        if self.feed is not None and self.feed.lay is not None and self.input_speed is None:
            message = "the speed at the lay needs the input speed\ngive input_speed"
            raise refused(message, "input_speed", "GL106")
        return self

    def _syntheses(self) -> tuple[str, ...]:
        """The syntheses that the file asks for."""
        momentary = self.target is not None and self.target.motion == "momentary-dwell" and self.links.frame is None
        asked = {
            "synth dwell": self.dwell is not None,
            "synth back-step": self.back_step is not None,
            "synth momentary-dwell": momentary,
        }
        return tuple(command for command, wanted in asked.items() if wanted)

    def sized_by(self, command: str) -> str:
        """The one synthesis of the file, where it leaves the frame to it."""
        asked = self._syntheses()
        return asked[0] if command == "analyze" and self.links.frame is None and len(asked) == 1 else ""

    def commands(self) -> tuple[str, ...]:
        loads = self._loads()
        return (*(self._syntheses() or ("analyze",)), "gear", *loads)
