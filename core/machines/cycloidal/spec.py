"""The design file of a cycloidal reducer."""

from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator

from gearlink.core.base.report import safely_below
from gearlink.core.base.spec import Deferred, DrivenSpec, Length, LoadLimits, Ratio, SignedLength, Spec, refused, unit

Count = Annotated[int, unit("1", ge=3, le=1000)]
Friction = Annotated[float, unit("1", ge=0, lt=1)]
Stress = Annotated[float, unit("N/mm^2", gt=0, le=1e7)]


class OutputPins(Spec):
    """Pins of the output in holes of the discs."""

    count: Count = Field(description="number of pins")
    circle_radius: Length = Field(description="radius of the circle of the pin centres")
    radius: Length = Field(description="radius of each pin; the holes are larger by the eccentricity")


class ReducerFriction(Spec):
    """Coefficients of friction, for the efficiency."""

    pins: Friction = Field(0.0, description="of the ring pins; of pins with rollers an effective one")
    output_pins: Friction = Field(0.0, description="of the output pins")
    bearing: Friction = Field(0.0, description="of the eccentric's bearing, at bearing_radius")


class Modification(Spec):
    """How the disc is ground otherwise than for the pins as they are."""

    offset: SignedLength = Field(0.0, description="increase of the pin radius for which the disc is ground")
    pin_circle: SignedLength = Field(0.0, description="increase of the pin circle radius for which the disc is ground")


class ReducerMaterial(Spec):
    """Disc and pins, of one material."""

    elastic_modulus: Stress = Field(206_000.0, description="modulus of elasticity")
    poisson: Annotated[float, unit("1", ge=0, lt=0.5)] = Field(0.3, description="Poisson's ratio")
    contact_limit: Stress | None = Field(None, description="permissible contact stress")


class ReducerLimits(LoadLimits):
    """Limits of the checks."""

    safety_pitting: Ratio = Field(1.0, description="contact_limit over the contact stress, at least")


class CycloidalReducerSpec(DrivenSpec):
    """Discs with lobes on an eccentric that roll in a ring of pins."""

    own_commands = ("analyze",)
    kind: Literal["cycloidal-reducer"]
    pins: Annotated[int, unit("1", ge=4, le=1000)] = Field(description="pins of the ring; the disc has one lobe less")
    pin_circle_radius: Length = Field(description="radius of the circle of the centres of the ring pins")
    pin_radius: Length = Field(description="radius of a ring pin")
    eccentricity: Length = Field(description="eccentricity of the discs")
    discs: Annotated[int, unit("1", ge=1, le=3)] = Field(
        1, description="discs, evenly spaced about the eccentric shaft"
    )
    fixed: Literal["ring", "output"] = Field(
        "ring",
        description=(
            "ring: the ring is fixed and the output pins drive the output; output: the output pins are fixed and the "
            "ring turns"
        ),
    )
    width: Length | None = Field(None, description="width of a disc: with torque the contact stress is computed")
    torque: Annotated[float, unit("N m", gt=0, le=1e12)] | None = Field(None, description="torque of the output")
    uneven: Annotated[float, unit("1", ge=1, le=10)] = Field(
        1.0, description="torque of the most loaded disc over the mean of all discs"
    )
    output_pins: OutputPins | None = None
    friction: ReducerFriction | None = Field(
        None, description="coefficients of friction: with them the efficiency is computed"
    )
    bearing_radius: Length | None = Field(None, description="radius of the bearing between eccentric and disc")
    modification: Modification | None = Field(
        None, description="modification of the profile: with it the backlash is computed"
    )
    material: ReducerMaterial = ReducerMaterial.model_construct()
    limits: ReducerLimits = ReducerLimits.model_construct()
    loads: Annotated[Any, Deferred("machines.cycloidal.loads:ReducerSection")] | None = Field(
        None, description="masses, forces and drive, for the command loads"
    )

    @model_validator(mode="after")
    def _no_loops(self) -> Self:
        most = self.pin_circle_radius / self.pins
        if self.eccentricity >= most or self.eccentricity * self.pins / self.pin_circle_radius >= 1.0:
            limit = safely_below(most)
            message = (
                f"the lobes have loops: eccentricity {self.eccentricity:g} mm (limit < {limit} mm, "
                f"pin_circle_radius/pins)\nset eccentricity below {limit} mm"
            )
            raise refused(message, "eccentricity")
        if self.pin_radius >= (most := self.pin_circle_radius - self.eccentricity):
            limit = safely_below(most)
            message = (
                f"no disc is left: pin_radius {self.pin_radius:g} mm (limit < {limit} mm, "
                f"pin_circle_radius - eccentricity)\nset pin_radius below {limit} mm"
            )
            raise refused(message, "pin_radius")
        if self.friction is not None and self.friction.bearing > 0.0 and self.bearing_radius is None:
            message = "friction of the bearing acts at its radius\ngive bearing_radius (mm)"
            raise refused(message, "bearing_radius", "GL106")
        if self.friction is not None and self.output_pins is None:
            raise refused("the efficiency needs output_pins: {count, circle_radius, radius}", "output_pins", "GL106")
        return self
