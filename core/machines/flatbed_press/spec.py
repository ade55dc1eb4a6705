"""The design file of a flatbed cylinder press."""

from math import cos, radians
from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator

from gearlink.core.base.spec import (
    AcuteAngle,
    Angle,
    Assembly,
    Deferred,
    Distance,
    DrawingLimits,
    Entries,
    GearLimits,
    Length,
    LoadLimits,
    Ratio,
    SignedLength,
    Spec,
    Teeth,
    TolerancedSpec,
    also,
    only_one,
    refused,
    require_offset_below_rod,
    unit,
)
from gearlink.core.parts.cams.spec import MotionLaw
from gearlink.core.parts.gears.keys.pair import PairKeys

TurnAngle = Annotated[float, unit("deg", ge=0, lt=360)]
PartOfTurn = Annotated[float, unit("deg", gt=0, lt=360)]


class InputGears(PairKeys):
    """The 1:1 pair that brings the power in; its centre distance follows from the machine."""

    horizontal_distance: Length = Field(description="horizontal distance w of the two axes")
    teeth: Teeth | None = Field(None, description="teeth of each of the two gears; default: as many as fit unshifted")


class DoubleCrank(Spec):
    """A drag link: the frame is the shortest link and both cranks turn fully."""

    crank: Length = Field(description="driving crank")
    coupler: Length = Field(description="coupler")
    rocker: Length = Field(description="driven crank")
    frame: Length = Field(description="frame")
    assembly: Assembly = Field(1, description="+1: coupler pin left of the vector crank pin -> far pivot")


class CylinderGears(PairKeys):
    """Gear 3 on MN and gear 4 on the cylinder."""

    teeth: Annotated[list[Teeth], Field(min_length=2, max_length=2), Entries("[gear 3, gear 4]", "[68, 68]")] = Field(
        description="teeth of gears 3 and 4"
    )


class Cylinder(Spec):
    """The cylinder drive."""

    radius: Length = Field(description="radius of the printing cylinder")
    gear_ratio: Ratio = Field(
        1.0, description="cylinder revolutions per revolution of MN; with gears that of their teeth"
    )
    gears: CylinderGears | None = Field(None, description="gears 3 and 4, for geometry, drawing and loads")
    double_crank: DoubleCrank
    initial_crank_angle: Angle = Field(description="angle of GH from the line G-N at the start")

    @property
    def ratio(self) -> float:
        """Cylinder turns per revolution of MN, by the teeth where they are given."""
        return self.gear_ratio if self.gears is None else self.gears.teeth[0] / self.gears.teeth[1]

    @model_validator(mode="after")
    def _same_ratio(self) -> Self:
        if self.gears is not None and "gear_ratio" in self.model_fields_set and self.gear_ratio != self.ratio:
            message = (
                f"the teeth of gears 3 and 4 give a ratio of {self.ratio:.9g}\nomit gear_ratio, or change the teeth"
            )
            raise refused(message, "gear_ratio")
        return self


class Pinion(PairKeys):
    """The pinion at F between the two racks."""

    teeth: Teeth = Field(description="teeth of the pinion")


class Bed(Spec):
    """The bed drive: drag link, slider-crank, pinion between two racks."""

    stroke: Length | None = Field(None, description="stroke of the bed, twice the slider's")
    crank: Length | None = Field(None, description="crank DE of the slider, instead of stroke")
    double_crank: DoubleCrank
    crank_offset_angle: Angle = Field(description="angle CDE between the driven crank and the slider's crank")
    rod: Length = Field(description="connecting rod EF")
    offset: SignedLength = Field(0.0, description="offset e of the slide line from D")
    pinion: Pinion | None = Field(None, description="pinion of both racks, for geometry, drawing and loads")
    rack_teeth: (
        Annotated[list[Teeth], Field(min_length=2, max_length=2), Entries("[lower, upper]", "[28, 28]")] | None
    ) = Field(None, description="teeth of the lower and of the upper rack; default: as many as the travel takes")

    @model_validator(mode="after")
    def _one_size(self) -> Self:
        only_one(self, "stroke", "crank", needed="give stroke, or crank instead")
        return self

    @model_validator(mode="after")
    def _reachable(self) -> Self:
        require_offset_below_rod(self.rod, self.offset, "offset")
        if self.rack_teeth is not None and self.pinion is None:
            message = "rack_teeth needs pinion: {module, teeth}"
            raise refused(message, "pinion", "GL106")
        return self


class Sync(Spec):
    """The synchronous zone."""

    length: Length = Field(420.0, description="cylinder travel of the zone")
    print_length: Distance = Field(0.0, description="print length that the zone must cover; 0: not checked")
    start: TurnAngle | None = Field(None, description="input angle at the start, instead of the equal-speed point")
    end: TurnAngle | None = Field(None, description="input angle at the end, instead of `length`")


class PressCam(Spec):
    """The compensation cam pair."""

    base_radius: Length | None = Field(
        None,
        description="cam axis to roller centre at zero lift; default: chosen by the section `size`",
        json_schema_extra=also("prime_radius"),
    )
    roller_radius: Length = Field(description="radius of both rollers")
    transition: Literal["arc", "parabola", "quartic"] = Field(
        "quartic", description="how the end slope is brought to 0"
    )
    lead_in: TurnAngle = Field(0.0, description="cam angle before the zone; 0: none")
    transition_end: PartOfTurn | None = Field(
        None, description="cam angle at which the lift is largest; this or `transition_angle`"
    )
    transition_angle: PartOfTurn | None = Field(
        None, description="cam angle from the end of the zone to the maximum lift, instead of `transition_end`"
    )
    return_angle: PartOfTurn = Field(description="cam angle of the return")
    return_law: MotionLaw = Field("cycloidal", description="motion law of the return, from rest to rest")
    shaft_radius: Distance = Field(0.0, description="cam shaft; 0: not checked")

    @model_validator(mode="after")
    def _one_transition(self) -> Self:
        needed = "either transition_end or transition_angle is needed"
        needed += "\ngive transition_angle, the cam angle from the end of the zone to the maximum lift"
        only_one(self, "transition_end", "transition_angle", needed=needed)
        return self


class PressSize(Spec):
    """Choice of a base radius that is not given: the smallest cams that keep a pressure angle, roller and shaft."""

    pressure_angle: Annotated[float, unit("deg", gt=0, lt=90)] = Field(
        description="pressure angle that neither cam exceeds"
    )


class PressLimits(DrawingLimits, GearLimits, LoadLimits):
    """Limits of the checks."""

    transmission_angle: AcuteAngle = Field(30.0, description="minimum transmission angle of both chains")
    pressure_angle: AcuteAngle = Field(30.0, description="maximum pressure angle of the cams")


class FlatbedPressSpec(TolerancedSpec):
    """Cylinder drive, bed drive, synchronous zone and compensation cams."""

    kind: Literal["flatbed-press"]
    speed: Annotated[float, unit("sheets/h", gt=0)] = Field(description="sheets per hour")
    input_gears: InputGears | None = None
    cylinder: Cylinder
    bed: Bed
    sync: Sync = Sync.model_construct()
    cam: PressCam | None = None
    size: PressSize | None = None
    limits: PressLimits = PressLimits.model_construct()
    loads: Annotated[Any, Deferred("machines.flatbed_press.loads_spec:PressLoads")] | None = Field(
        None, description="masses, forces and drive, for the command loads"
    )

    @model_validator(mode="after")
    def _one_radius(self) -> Self:
        """A radius that the loads give beside teeth must be that of the teeth."""
        pinion, gears = self.bed.pinion, self.cylinder.gears
        for key, teeth in (
            ("pinion_radius", None if pinion is None else (pinion, pinion.teeth)),
            ("cylinder_gear_radius", None if gears is None else (gears, gears.teeth[1])),
        ):
            given = getattr(self.loads, key, None)
            if teeth is None or given is None:
                continue
            keys, z = teeth
            found = 0.5 * keys.module * z / cos(radians(keys.helix_angle))
            if keys.profile_shift is None and abs(given - found) > 1e-9 * found:
                message = f"the teeth give a radius of {found:.9g} mm\nomit {key}, or give the same"
                raise refused(message, f"loads.{key}")
        return self

    @property
    def has_gears(self) -> bool:
        """Whether there are any gears to look at."""
        return any(each is not None for each in (self.input_gears, self.cylinder.gears, self.bed.pinion))

    def commands(self) -> tuple[str, ...]:
        gears: tuple[str, ...] = ("gear",) if self.has_gears else ()
        gears += ("loads",) if self.loads is not None else ()
        return ("press", "cam", *gears) if self.cam is not None else ("press", *gears)
