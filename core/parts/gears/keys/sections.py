"""Keys of a design file that describe gears beyond their teeth: tools, tips, widths."""

import re
from typing import Annotated, Self

from pydantic import AfterValidator, Field, model_validator

from gearlink.core.base.spec import Coefficient, Spec, only_one, refused, unit
from gearlink.core.parts.gears.keys.types import Factor, OneOrTwo, Shift, Two

Protuberance = Annotated[float, unit("1", ge=0, le=1)]
Rounding = Annotated[float, unit("1", ge=0, le=3)]


class ToolSpec(Spec):
    """A rack tool (hob, rack cutter), in modules of the normal section."""

    addendum: Coefficient = Field(1.25, description="tip of the tool below its datum line")
    rounding: Rounding | None = Field(
        None, description="radius of the tool's tip; default: 0.38, or less where clearance or full round require it"
    )
    residual_undercut: Protuberance = Field(
        0.0, description="protuberance, as high as the rounding, less the machining allowance"
    )


class CutterSpec(Spec):
    """The pinion cutter that shapes a ring, in modules of the normal section."""

    teeth: Annotated[int, unit("teeth", ge=3, le=10_000)] = Field(description="teeth of the cutter")
    shift: Shift = Field(0.0, description="profile shift of the cutter as it is ground")
    addendum: Coefficient = Field(1.25, description="addendum coefficient of the cutter")
    rounding: Rounding = Field(0.25, description="radius of the cutter's tip corner")


OneOrTwoTools = ToolSpec | Two[ToolSpec | None]
Allowance = Annotated[float, unit("mm", ge=-100, le=100)]
_TOLERANCE, _ROW = "(2[1-9]|30)", "(ab|a|bc|b|cd|c|d|e|f|g|h)"
_SERIES = f"^({_TOLERANCE} ?{_ROW}|{_ROW} ?{_TOLERANCE})$"
"""Of DIN 3967, as 25cd on drawings, or cd25 in other programs."""


def _a_series(name: str) -> str:
    found = re.fullmatch(_SERIES, name)
    if not found:
        message = (
            f"DIN 3967 has no series {name}\ntake a tolerance 21 to 30 and a row a, ab, b, bc, c, cd, d ... h, as 25cd"
        )
        raise refused(message, "", "GL108")
    _, tolerance, row, other_row, other_tolerance = found.groups()
    return f"{tolerance or other_tolerance}{row or other_row}"


Series = Annotated[str, AfterValidator(_a_series), Field(json_schema_extra={"pattern": _SERIES})]


class AllowanceSpec(Spec):
    """Allowances of the tooth thickness in the normal section: a series of DIN 3967, or limits in mm."""

    series: OneOrTwo[Series] | None = Field(None, description="of DIN 3967, such as 25cd; one, or one for each gear")
    upper: Two[Allowance] | None = Field(
        None, description="upper allowances E_sns of gear 1 and 2, usually negative [mm]"
    )
    lower: Two[Allowance] | None = Field(None, description="lower allowances E_sni of gear 1 and 2 [mm]")

    @model_validator(mode="after")
    def _one_way(self) -> Self:
        limits = self.upper is not None or self.lower is not None
        if self.series is not None and limits:
            message = "series excludes upper and lower\nomit series, or upper and lower"
            raise refused(message, "upper" if self.upper is not None else "lower")
        if self.series is None and (self.upper is None or self.lower is None):
            missing = "series" if not limits else "upper" if self.upper is None else "lower"
            raise refused("give series, or both upper and lower", missing, "GL106")
        for place in (0, 1):
            if self.upper is not None and self.lower is not None and self.upper[place] < self.lower[place]:
                message = f"the lower allowance of gear {place + 1} is above its upper one: exchange them"
                raise refused(message, f"lower[{place}]")
        return self


class FactorSpec(Spec):
    """The K factors of ISO 6336: computed only with `rating`, else 1 unless given."""

    application: Factor = Field(1.0, description="K_A")
    distribution: Factor = Field(1.0, description="K_gamma, uneven share of several meshes such as planets")
    dynamic: Factor = Field(1.0, description="K_v")
    face_contact: Factor = Field(1.0, description="K_Hbeta")
    transverse_contact: Factor = Field(1.0, description="K_Halpha")
    face_bending: Factor = Field(1.0, description="K_Fbeta")
    transverse_bending: Factor = Field(1.0, description="K_Falpha")


class LoadSpec(Spec):
    """What the pair carries: torque, power with speed, or tangential force."""

    torque: Annotated[float, unit("N m", gt=0, le=1e9)] | None = Field(None, description="torque of gear 1")
    power: Annotated[float, unit("kW", gt=0, le=1e6)] | None = Field(
        None, description="power, with speed, instead of torque"
    )
    speed: Annotated[float, unit("1/min", gt=0, le=1e6)] | None = Field(
        None, description="speed of gear 1; with torque or force for the sliding speeds of the table path alone"
    )
    tangential_force: Annotated[float, unit("N", gt=0, le=1e12)] | None = Field(
        None, description="force on the reference circle, instead of torque"
    )
    factors: FactorSpec = FactorSpec.model_construct()

    @model_validator(mode="after")
    def _one_load(self) -> Self:
        needed = "give torque, power with speed, or tangential_force"
        only_one(self, "torque", "power", "tangential_force", needed=needed)
        if self.power is not None and self.speed is None:
            raise refused("power needs speed", "speed", "GL106")
        return self
