"""The design file of a crank-rocker."""

from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator

from gearlink.core.base.spec import (
    AcuteAngle,
    Angle,
    Assembly,
    Deferred,
    DrivenSpec,
    Entries,
    Length,
    LoadLimits,
    SignedLength,
    Spec,
    refused,
    unit,
)
from gearlink.core.parts.linkages.spec_parts import TurnAngle
from gearlink.core.parts.linkages.spec_sections import FourLinks, Plain, require_function

_SIZES = ("crank", "coupler", "rocker", "frame")


class RockerLimits(LoadLimits):
    """Limits of the checks."""

    transmission_angle: AcuteAngle = Field(40.0, description="minimum transmission angle")


class Swing(Spec):
    """Swing and time ratio of the rocker, and one or two lengths."""

    angle: Annotated[float, unit("deg", gt=0, lt=180)] = Field(
        description="swing of the rocker between its dead centres"
    )
    quick_return_ratio: Annotated[float, unit("1", ge=1)] = Field(description="time of the slow over the fast stroke")
    slow_stroke: Literal["same", "opposite"] = Field(
        "same", description="sense of the rocker in the slow stroke: the crank's (same) or against it (opposite)"
    )
    crank: Length | None = Field(None, description="crank AB; alone it scales the best design")
    coupler: Length | None = Field(None, description="coupler BC; it scales the best design")
    rocker: Length | None = Field(None, description="rocker CD; it scales the best design")
    frame: Length | None = Field(None, description="frame AD; alone it scales the best design, with crank it gives one")

    @property
    def given(self) -> tuple[str, ...]:
        """The lengths that are given."""
        return tuple(name for name in _SIZES if getattr(self, name) is not None)

    @model_validator(mode="after")
    def _lengths(self) -> Self:
        if not self.given:
            raise refused("give one of crank, coupler, rocker and frame, or crank and frame", "frame", "GL106")
        if len(self.given) > 1 and self.given != ("crank", "frame"):
            message = "one length gives the design with the best transmission angle, crank and frame give another: "
            key = next(name for name in self.given if name in ("coupler", "rocker"))
            raise refused(f"{message}omit {key}", key)
        return self


_Pair = Annotated[list[Angle], Field(min_length=2, max_length=2), Entries("[crank angle, rocker angle]", "[40, 50]")]


class Function(Spec):
    """Three pairs of crank and rocker angle that the linkage goes through, given or of a function."""

    pairs: (
        Annotated[
            list[_Pair], Field(min_length=3, max_length=3), Entries("three pairs", "[[40, 50], [90, 80], [160, 110]]")
        ]
        | None
    ) = Field(None, description="crank angle and rocker angle, three times; or name, x and both swings instead of them")
    frame: Length = Field(description="frame AD")
    name: Literal["log", "exp", "power", "sine", "cosine", "tangent"] | None = Field(
        None, description="function y of x: the crank's swing represents x, the rocker's y"
    )
    exponent: SignedLength | None = Field(None, description="of a power", json_schema_extra={"unit": "1"})
    x: Annotated[list[Plain], Field(min_length=2, max_length=2), Entries("[start, end]", "[1, 2]")] | None = Field(
        None, description="x at the start and the end of the swing; of sine, cosine and tangent in deg"
    )
    input_swing: Annotated[float, unit("deg", gt=0, le=180)] | None = Field(
        None, description="rotation of the crank from the first x to the last"
    )
    output_swing: Annotated[float, unit("deg", ge=-180, le=180)] | None = Field(
        None, description="rotation of the rocker from the first y to the last, negative clockwise"
    )
    input_start: Angle | None = Field(
        None, description="crank angle at the first x; default: that of the smallest error"
    )
    output_start: Angle | None = Field(
        None, description="rocker angle at the first y; default: that of the smallest error"
    )

    @model_validator(mode="after")
    def _given_or_named(self) -> Self:
        needed, more = ("name", "x", "input_swing", "output_swing"), ("exponent", "input_start", "output_start")
        if self.pairs is not None:
            if wrong := next((key for key in (*needed, *more) if getattr(self, key) is not None), ""):
                raise refused(f"{wrong} together with pairs, which already define the function\nomit {wrong}", wrong)
            return self
        if missing := next((key for key in needed if getattr(self, key) is None), ""):
            if missing == "name":
                raise refused("give pairs, or name, x, input_swing, output_swing", "pairs", "GL106")
            raise refused(f"a function needs {missing}", missing, "GL106")
        require_function(self.name, self.exponent, self.x, self.output_swing)
        return self


class CrankRockerSpec(DrivenSpec):
    """A four-bar whose rocker is the output: its links, or what they are found from."""

    kind: Literal["crank-rocker"]
    links: FourLinks | None = None
    assembly: Assembly = Field(1, description="+1: C left of the vector from B to D; -1: its mirror image")
    range: Annotated[list[TurnAngle], Field(min_length=2, max_length=2), Entries("[from, to]", "[60, 120]")] | None = (
        Field(None, description="range of the crank angle; default: whole revolutions")
    )
    coupler_point: (
        Annotated[list[SignedLength], Field(min_length=2, max_length=2), Entries("[x, y]", "[55, 40]")] | None
    ) = Field(None, description="point of the coupler whose path is required, from B along BC and to the left of it")
    swing: Swing | None = Field(None, description="requirements of `synth swing`")
    function: Function | None = Field(None, description="requirements of `synth function`")
    limits: RockerLimits = RockerLimits.model_construct()
    loads: Annotated[Any, Deferred("machines.crank_rocker.loads_spec:CrankRockerLoads")] | None = Field(
        None, description="masses, forces and drive, for the command loads"
    )

    @model_validator(mode="after")
    def _range_goes_up(self) -> Self:
        if self.range is not None and self.range[1] <= self.range[0]:
            raise refused("the range ends before it starts\ngive a greater end", "range")
        return self

    def syntheses(self) -> tuple[str, ...]:
        """The syntheses that the file has a section for."""
        asked = {"synth swing": self.swing, "synth function": self.function}
        return tuple(command for command, section in asked.items() if section is not None)

    def commands(self) -> tuple[str, ...]:
        """What the file asks for: a synthesis per section, an analysis of given links, the loads with theirs."""
        analysis = ("analyze",) if self.links is not None else ()
        loads = self._loads()
        return (*((*self.syntheses(), *analysis) or ("analyze",)), *loads)

    def sized_by(self, command: str) -> str:
        """The one synthesis of a file that leaves out the links that an analysis needs."""
        asked = self.syntheses()
        return asked[0] if command == "analyze" and self.links is None and len(asked) == 1 else ""
