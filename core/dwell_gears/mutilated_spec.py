"""The design file of a dwell by a mutilated gear."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from gearlink.core.linkages.spec_parts import FourLinks, LinkageLimits, PivotShafts
from gearlink.core.spec import Angle, Assembly, Deferred, DrivenSpec, Length, PressureAngle, Spec, Teeth


class MutilatedGears(Spec):
    """The mutilated wheel and the gear that it drives."""

    module: Length = Field(description="module of both")
    full_teeth: Teeth = Field(description="teeth for which the wheel's pitch circle has room")
    group_teeth: Teeth = Field(description="teeth in a group")
    groups: Teeth = Field(1, description="groups evenly round the wheel")
    driven: Teeth = Field(description="teeth of the driven gear")
    stops: Teeth = Field(1, description="locking arcs evenly round the driven gear")
    pressure_angle: PressureAngle = Field(20.0, description="pressure angle of the reference profile")


class MutilatedShafts(PivotShafts):
    """Shafts of the frame that pass through the plane of the gears; one that is left out may end before it."""

    A_radius: Length | None = Field(None, description="radius of the shaft at A, of driven gear and crank")
    W_radius: Length | None = Field(None, description="radius of the shaft of the mutilated wheel, W")


class MutilatedGearDwellSpec(DrivenSpec):
    """Reduction, mutilated wheel, driven gear and, on its shaft, the crank of a four-bar."""

    kind: Literal["mutilated-gear-dwell"]
    reduction: Annotated[float, Field(gt=0, le=1e6, json_schema_extra={"unit": "1"})] = Field(
        description="input turns per turn of the mutilated wheel"
    )
    gears: MutilatedGears
    links: FourLinks | None = Field(None, description="the four-bar that the driven gear turns")
    assembly: Assembly = Field(1, description="+1: C left of the vector from B to D; -1: its mirror image")
    start_angle: Angle | None = Field(
        None, description="crank angle at which the crank stands; left out: crank and coupler stretched"
    )
    limits: LinkageLimits = LinkageLimits()
    shafts: MutilatedShafts | None = None
    loads: Annotated[Any, Deferred("dwell_gears.loads_spec:MutilatedLoads")] | None = Field(
        None, description="masses, forces and drive, for the command loads"
    )

    @model_validator(mode="after")
    def _shaft_of_the_rocker(self) -> MutilatedGearDwellSpec:
        if self.links is None and self.shafts is not None and self.shafts.D_radius is not None:
            raise PydanticCustomError(
                "GL111", "D_radius goes with the four-bar: give links, or leave it out", {"key": "shafts.D_radius"}
            )
        return self

    def commands(self) -> tuple[str, ...]:
        """What the file asks for."""
        return ("analyze", "gear", *(("loads",) if self.loads is not None and self.links is not None else ()))
