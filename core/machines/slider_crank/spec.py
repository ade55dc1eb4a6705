"""The design file of a slider-crank."""

from typing import Annotated, Any, Literal, Self

from pydantic import AfterValidator, Field, ValidationInfo, model_validator
from pydantic_core import PydanticKnownError

from gearlink.core.base.errors import at_key
from gearlink.core.base.spec import (
    AcuteAngle,
    Deferred,
    DrawingLimits,
    DrivenSpec,
    GearLimits,
    Length,
    LoadLimits,
    SignedLength,
    only_one,
    refused,
    require_offset_below_rod,
    unit,
)
from gearlink.core.parts.linkages.slider_crank import SliderCrank, quick_return


class SliderLimits(DrawingLimits, GearLimits, LoadLimits):
    """Limits of the checks."""

    transmission_angle: AcuteAngle = Field(
        40.0, description="minimum transmission angle, 90 deg less the rod's inclination"
    )


def _given_or_found(rod: float | None, keys: ValidationInfo) -> float | None:
    """The rod, which only a time ratio leaves to be found."""
    if rod is None and keys.data.get("quick_return_ratio", 0.0) is None:
        raise PydanticKnownError("missing")
    return rod


class SliderCrankSpec(DrivenSpec):
    """An offset slider-crank given by its stroke or its crank."""

    kind: Literal["slider-crank"]
    stroke: Length | None = Field(None, description="stroke of the slider")
    crank: Length | None = Field(
        None, description="crank, instead of stroke; in addition to it with quick_return_ratio"
    )
    quick_return_ratio: Annotated[float, unit("1", ge=1)] | None = Field(
        None,
        description="time of the slow over the fast stroke: the offset is found for it, and the rod if it is not given",
    )
    rod: Annotated[Length | None, AfterValidator(_given_or_found)] = Field(
        None, validate_default=True, description="connecting rod"
    )
    offset: SignedLength = Field(0.0, description="offset of the slide line from the crank's axis")
    racks: Annotated[Any, Deferred("machines.slider_crank.racks:Racks")] | None = Field(
        None, description="pinion at the rod end between a fixed and a moving rack, which is then the output"
    )
    limits: SliderLimits = SliderLimits.model_construct()

    loads: Annotated[Any, Deferred("machines.slider_crank.loads_spec:SliderCrankLoads")] | None = Field(
        None, description="masses, forces and drive, for the command loads"
    )

    @model_validator(mode="after")
    def _of_time_ratio(self) -> Self:
        if self.quick_return_ratio is None:
            return self
        if self.stroke is None:
            raise refused("quick_return_ratio needs stroke\ngive it", "stroke", "GL106")
        if "offset" in self.model_fields_set:
            raise refused("the offset is found for quick_return_ratio\nomit it", "offset")
        if self.rod is not None and self.crank is not None:
            raise refused("stroke and quick_return_ratio leave only rod or crank free\nomit crank", "crank")
        return self

    @model_validator(mode="after")
    def _one_size(self) -> Self:
        if self.quick_return_ratio is not None:
            return self
        only_one(self, "stroke", "crank", needed="give stroke, or crank instead")
        return self

    def slider_crank(self) -> SliderCrank:
        """The mechanism."""
        if self.quick_return_ratio is not None:
            return self._quick_return()
        assert self.rod is not None
        with at_key("stroke" if self.crank is None else "crank"):
            if self.crank is not None:
                return SliderCrank.of_crank(self.crank, self.rod, self.offset)
            assert self.stroke is not None
            return SliderCrank(self.stroke, self.rod, self.offset)

    def _quick_return(self) -> SliderCrank:
        assert self.stroke is not None
        assert self.quick_return_ratio is not None
        found = quick_return(self.stroke, self.quick_return_ratio, self.rod, self.crank)
        with at_key("quick_return_ratio"):
            if self.rod is not None:
                return SliderCrank(self.stroke, found.rod, found.offset)
            return SliderCrank.of_crank(*found)

    @model_validator(mode="after")
    def _reachable(self) -> Self:
        if self.rod is not None and self.quick_return_ratio is None:
            require_offset_below_rod(self.rod, self.offset, "offset")
        return self

    def commands(self) -> tuple[str, ...]:
        """What the file asks for: the crank, the motion with its checks, the loads with theirs."""
        return ("crank", "analyze", *self._loads())

    def pages(self) -> tuple[str, ...]:
        """`analyze` gives all of `crank`, and the same sheet."""
        return self.commands()[1:]
