"""The design file of a Geneva drive."""

from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator

from gearlink.core.base.report import safely_below
from gearlink.core.base.spec import Deferred, DrivenSpec, Length, LoadLimits, Ratio, Spec, refused, unit
from gearlink.core.base.wording import short, unlike
from gearlink.core.parts.linkages.spec_parts import DwellTolerance

Clearance = Annotated[float, unit("mm", ge=0, le=1e3)]
Pins = Annotated[int, unit("1", ge=1, le=6)]


class _WithoutKind(Deferred):
    """A design inside another file, whose kind is known."""

    def __init__(self, place: str, kind: str) -> None:
        super().__init__(place)
        self._kind = kind

    def _validated(self, value: Any) -> Any:
        return super()._validated({**value, "kind": self._kind} if isinstance(value, dict) else value)

    def __get_pydantic_json_schema__(self, _schema: Any, _handler: Any) -> dict[str, Any]:
        return {"type": "object"}


class Wheel(Spec):
    """What the wheel drives."""

    inertia: Annotated[float, unit("kg m^2", ge=0, le=1e12)] = Field(
        0.0, description="moment of inertia of all that turns with the wheel"
    )
    resistance: Annotated[float, unit("N m", ge=0, le=1e12)] = Field(0.0, description="torque against its motion")


class GenevaLimits(LoadLimits):
    """Limits of the checks."""

    steps_per_minute: Ratio = Field(200.0, description="maximum number of steps per minute")


class GenevaDriveSpec(DrivenSpec):
    """A wheel with radial slots, and a crank whose pin enters them."""

    own_commands = ("analyze",)
    kind: Literal["geneva-drive"]
    type: Literal["external", "internal"] = Field(
        description="external: the crank's axis is outside the wheel; internal: within it"
    )
    slots: Annotated[int, unit("1", ge=3, le=1000)] = Field(
        description="slots of the wheel, which turns by 360/slots in a step"
    )
    center_distance: Length = Field(description="distance of both axes")
    pin_radius: Length = Field(description="radius of the pin, or of its roller")
    pins: Pins = Field(1, description="pins of the crank, equally spaced")
    slot_clearance: Clearance = Field(0.0, description="width of a slot less the diameter of its pin")
    locking_radius: Length | None = Field(None, description="radius of the disc that locks the wheel in the dwell")
    locking_clearance: Clearance = Field(0.0, description="radius of the wheel's locking arcs less that of the disc")
    hub_radius: Length | None = Field(None, description="radius of the wheel's hub or shaft")
    shaft_radius: Length | None = Field(None, description="radius of the crank's shaft")
    wheel: Wheel | None = Field(None, description="load of the wheel: with it contact force and torque are computed")
    compare: Annotated[Any, _WithoutKind("machines.three_gear.spec:ThreeGearSpec", "three-gear-four-bar")] | None = (
        Field(None, description="a three-gear-four-bar, without its key kind, of the same step: table comparison")
    )
    compare_tolerance: DwellTolerance = Field(
        0.25, description="permitted deviation +- of the output in a dwell of the comparison"
    )
    limits: GenevaLimits = GenevaLimits.model_construct()
    loads: Annotated[Any, Deferred("machines.geneva.loads:GenevaSection")] | None = Field(
        None, description="masses, forces and drive, for the command loads"
    )

    @model_validator(mode="after")
    def _pins_in_turn(self) -> Self:
        sign = 1.0 if self.type == "external" else -1.0
        step = 180.0 - sign * 360.0 / self.slots
        if self.pins * step > 360.0 + 1e-9:
            pins = int((360.0 + 1e-9) // step)
            message = f"a step takes {short(step)} deg of the crank: at most {pins} pins fit in a revolution"
            raise refused(f"{message}\nset pins to at most {pins}", "pins")
        if self.pin_radius >= (crank := self._crank(sign)):
            limit = safely_below(crank)
            message = f"the pin covers the axis of the crank: {self.pin_radius:g} mm (limit < {limit} mm)"
            raise refused(f"{message}\nset pin_radius below {limit} mm", "pin_radius")
        if self.slot_clearance >= (most := 2.0 * self._nearest(sign)):
            message = (
                f"slot_clearance: {unlike(self.slot_clearance, most)} mm (limit < {safely_below(most)} mm, with which "
                "a slot turns freely about its pin)\nreduce slot_clearance"
            )
            raise refused(message, "slot_clearance")
        if self.locking_clearance and self.locking_radius is None:
            raise refused("locking_clearance needs the locking disc\ngive locking_radius", "locking_clearance")
        return self

    def _crank(self, _sign: float) -> float:
        from math import pi, sin

        return self.center_distance * sin(pi / self.slots)

    def _nearest(self, sign: float) -> float:
        """Minimum distance of a pin in its slot from the wheel's axis: in the middle of a step, of an internal wheel at
        both ends [mm]."""
        from math import cos, pi

        if sign > 0.0:
            return self.center_distance - self._crank(sign)
        return self.center_distance * cos(pi / self.slots)
