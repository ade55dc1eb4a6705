"""The design file of a wide-swing cam mechanism with an unloading device."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from gearlink.core.specs.common import AcuteAngle, DesignSpec, Distance, Length, Ratio, Share, Spec


class Pneumatic(Spec):
    """A cylinder under constant pressure."""

    type: Literal["pneumatic"] = Field(description="kind of device")
    pivot_ratio: Ratio = Field(description="pivot distance over arm, above 1")
    arm: Length = Field(description="arm r_d on the rocker")
    extension_ratio: Annotated[float, Field(gt=1, json_schema_extra={"unit": "1"})] = Field(
        13 / 9, description="extended over retracted length, q"
    )
    residual: Annotated[float, Field(ge=0, le=1, json_schema_extra={"unit": "1"})] = Field(
        0.0, description="share of the inertia torque that friction and force error leave at the design speed"
    )


class SpringDevice(Spec):
    """A tension spring."""

    type: Literal["spring"] = Field(description="kind of device")
    pivot_ratio: Ratio = Field(description="pivot distance over arm, above 1")
    arm: Length = Field(description="arm r_d on the rocker")
    stretch_ratio: Share = Field(description="mounting stretch at mid-swing over the stroke")
    closed_length: Length | None = Field(None, description="closed-coil length; then the pivot ratio is checked")
    end_fittings: Distance = Field(0.0, description="length of the end fittings")
    residual: Annotated[float, Field(ge=0, le=1, json_schema_extra={"unit": "1"})] = Field(
        0.0, description="share of the inertia torque that friction and force error leave at the design speed"
    )


class SwingCam(Spec):
    """The cam pair."""

    center_distance: Length = Field(description="cam axis to rocker axis")
    roller_radius: Length = Field(description="radius of the roller")
    rocker_radius: Length | None = Field(None, description="rocker radius, in place of the one with no pressure angle")
    shaft_radius: Distance = Field(0.0, description="cam shaft; 0: not checked")


class SwingLimits(Spec):
    """Limits of the checks."""

    pressure_angle: AcuteAngle = Field(45.0, description="greatest pressure angle outside the transition zone")
    transition_zone: Annotated[float, Field(gt=0, lt=0.5, json_schema_extra={"unit": "1"})] = Field(
        0.05, description="largest half-width of the contact change at mid-swing, share of the stroke"
    )


class WideSwingSpec(DesignSpec):
    """Twin-cam or twin-rocker mechanism with spring or pneumatic unloading."""

    kind: Literal["wide-swing-cam"]
    layout: Literal["twin-cam", "twin-rocker"] = Field(
        description="twin-cam: external profile; twin-rocker: internal profile"
    )
    swing: Annotated[float, Field(gt=0, le=300, json_schema_extra={"unit": "deg"})] = Field(description="whole swing")
    cycle_angle: Annotated[float, Field(gt=0, lt=360, json_schema_extra={"unit": "deg"})] = Field(
        description="cam angle of one stroke, run-up and run-out"
    )
    speed: Annotated[float, Field(gt=0, json_schema_extra={"unit": "1/min"})] = Field(description="of the cam")
    inertia: Annotated[float, Field(gt=0, json_schema_extra={"unit": "kg m^2"})] = Field(
        description="moment of inertia on the rocker axis"
    )
    unloader: Pneumatic | SpringDevice = Field(discriminator="type", description="device that bears the inertia")
    operating_speed_min: Annotated[float, Field(gt=0, json_schema_extra={"unit": "1/min"})] | None = Field(
        None, description="least speed at which the machine works; then the device is checked for harm there"
    )
    method: Literal["exact", "iteration"] = Field(
        "exact", description="iteration: show the source's own iteration and its error beside the exact law"
    )
    iteration_steps: Annotated[int, Field(ge=1, le=100_000, json_schema_extra={"unit": "1"})] = Field(
        20, description="its steps per half stroke"
    )
    cam: SwingCam | None = None
    limits: SwingLimits = SwingLimits()

    def commands(self) -> tuple[str, ...]:
        """What the file asks for."""
        return ("swing", "cam") if self.cam is not None else ("swing",)
