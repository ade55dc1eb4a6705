"""The design file of a wide-swing cam mechanism with an unloading device."""

import math
from typing import Annotated, Any, Literal, Self, TypeAlias

from pydantic import AfterValidator, Field, ValidationInfo, field_validator, model_validator

from gearlink.core.base.spec import (
    AcuteAngle,
    Angle,
    Assembly,
    Deferred,
    Distance,
    Length,
    LoadLimits,
    Ratio,
    Share,
    SignedLength,
    Spec,
    Teeth,
    TolerancedSpec,
    also,
    only_one,
    refused,
    unit,
)
from gearlink.core.parts.gears.keys.pair import PairKeys

Phase: TypeAlias = Annotated[float, unit("deg", ge=0, lt=360)]
Stroke: TypeAlias = Annotated[float, unit("deg", gt=0, lt=360)]
Force: TypeAlias = Annotated[float, unit("N", gt=0)]
Mass: TypeAlias = Annotated[float, unit("kg", gt=0)]
Residual: TypeAlias = Annotated[
    float,
    Field(
        ge=0,
        le=1,
        description="share of the inertia torque that friction and force error leave at the design speed",
        json_schema_extra={"unit": "1"},
    ),
]
Reserve: TypeAlias = Annotated[
    float,
    Field(
        ge=0,
        description="force above the one that balances the inertia at the design speed, as a share of it",
        json_schema_extra={"unit": "1"},
    ),
]


class Pneumatic(Spec):
    """A cylinder under constant pressure."""

    type: Literal["pneumatic"] = Field(description="kind of device")
    pivot_ratio: Ratio = Field(description="pivot distance over arm; must be above 1")
    arm: Length = Field(description="arm r_d on the rocker")
    extension_ratio: Annotated[float, unit("1", gt=1, lt=2)] = Field(
        13 / 9, description="extended over retracted length, q; below 2, since a cylinder holds its rod"
    )
    force: Force | None = Field(None, description="force of a given cylinder, instead of reserve")
    pressure: Annotated[float, unit("N/mm^2", gt=0)] | None = Field(
        None, description="gauge pressure, 0.6 for 6 bar; sizes the bore"
    )
    bore: Length | None = Field(None, description="bore of a given cylinder, instead of pressure")
    rod_diameter: Distance = Field(0.0, description="diameter of the rod; the cylinder pulls, with the rod side")
    efficiency: Annotated[float, unit("1", gt=0, le=1)] = Field(
        1.0, description="share of the cylinder's force that reaches the pin"
    )
    reservoir: Annotated[float, unit("l", gt=0)] | None = Field(
        None, description="volume of the air, that of the chamber at mid-swing included"
    )
    residual: Residual = 0.0
    reserve: Reserve = 0.0

    @model_validator(mode="before")
    @classmethod
    def _no_rate(cls, data: Any) -> Any:
        if isinstance(data, dict) and "rate" in data:
            raise refused("a cylinder has no rate\ngive its force, or type: spring", "rate")
        return data

    @model_validator(mode="after")
    def _one_size(self) -> Self:
        _refuse_reserve(self, "force")
        if self.bore is not None and self.pressure is not None:
            raise refused("bore and pressure exclude each other\nomit bore or pressure: it is a result", "bore")
        if self.bore is not None and self.bore <= self.rod_diameter:
            words = f"bore {self.bore:g} mm: it must be above rod_diameter, {self.rod_diameter:g} mm"
            raise refused(f"{words}\nraise bore, or reduce rod_diameter", "bore", "GL108")
        if self.reservoir is not None and self.bore is None and self.pressure is None:
            raise refused("a reservoir needs the size of the cylinder\ngive pressure or bore", "reservoir")
        return self


class SpringDevice(Spec):
    """A tension spring."""

    type: Literal["spring"] = Field(description="kind of device")
    pivot_ratio: Ratio = Field(description="pivot distance over arm; must be above 1")
    arm: Length = Field(description="arm r_d on the rocker")
    rate: Annotated[float, unit("N/mm", gt=0)] | None = Field(
        None, description="rate of a given spring, instead of reserve"
    )
    free_length: Length | None = Field(None, description="distance of the pins at zero force, instead of stretch_ratio")
    stretch_ratio: Share | None = Field(
        None, validate_default=True, description="mounting stretch at mid-swing over the stroke; or free_length"
    )
    closed_length: Length | None = Field(None, description="closed-coil length; with it the pivot ratio is checked")
    stretch_capacity: Ratio | None = Field(
        None, description="allowable stretch over closed length, instead of closed_length; steel 1 to 2"
    )
    end_fittings: Distance = Field(0.0, description="length of the end fittings")
    residual: Residual = 0.0
    reserve: Reserve = 0.0

    @model_validator(mode="before")
    @classmethod
    def _no_force(cls, data: Any) -> Any:
        if isinstance(data, dict) and "force" in data:
            raise refused("a spring has no constant force\ngive its rate, or type: pneumatic", "force")
        return data

    @field_validator("stretch_ratio")
    @classmethod
    def _stretched(cls, value: float | None, info: ValidationInfo) -> float | None:
        free = info.data.get("free_length", ...)
        if value is None and free is None:
            words = "stretch_ratio: mounting stretch at mid-swing over the stroke; or free_length of a given spring"
            raise refused(f"the key 'stretch_ratio' is missing\n{words}", "stretch_ratio", "GL106")
        return value

    @model_validator(mode="after")
    def _one_length(self) -> Self:
        _refuse_reserve(self, "rate")
        only_one(self, "free_length", "stretch_ratio", at="free_length")
        only_one(self, "closed_length", "stretch_capacity")
        return self


class GravityDevice(Spec):
    """A mass that hangs from the rocker axis and stands lowest at mid-swing."""

    type: Literal["gravity"] = Field(description="kind of device")
    distance: Length = Field(description="distance of the mass from the rocker axis")
    mass: Mass | None = Field(
        None, description="mass of a given pendulum, instead of reserve; its own inertia is included"
    )
    gravity: Annotated[float, unit("m/s^2", gt=0)] = Field(9.80665, description="acceleration of gravity")
    residual: Residual = 0.0
    reserve: Reserve = 0.0

    @model_validator(mode="after")
    def _one_mass(self) -> Self:
        _refuse_reserve(self, "mass")
        return self


def _refuse_reserve(device: Pneumatic | SpringDevice | GravityDevice, given: str) -> None:
    if getattr(device, given) is not None and "reserve" in device.model_fields_set:
        raise refused(f"{given} and reserve exclude each other: the reserve of a given device is a result", "reserve")


class SecondShaft(Spec):
    """The shaft of the return cam, next to that of the working cam."""

    direction: Annotated[float, unit("deg", gt=-360, lt=360)] = Field(
        description="from the rocker axis, counter-clockwise from the direction to the first shaft"
    )
    center_distance: Length | None = Field(None, description="from the rocker axis; default: that of the first cam")


class ShaftGears(PairKeys):
    """The pair 1:1 between two parallel cam shafts; its centre distance is that of the shafts."""

    teeth: Teeth | None = Field(None, description="teeth of both gears; default: as many as the distance takes")


class SwingCam(Spec):
    """The cam pair."""

    center_distance: Length = Field(description="cam axis to rocker axis")
    roller_radius: Length = Field(description="radius of the roller")
    rocker_radius: Length | None = Field(None, description="rocker radius, instead of the one with no pressure angle")
    shaft_radius: Distance = Field(0.0, description="cam shaft; 0: not checked")
    free_clearance: Distance = Field(
        0.5, description="clearance between a roller and the sector of a closed contour in which the other cam guides"
    )
    second: SecondShaft | None = Field(None, description="shaft of the return cam of a twin-cam-parallel")
    planes: Literal["separate", "same"] = Field(
        "separate", description="of the two cams of a twin-cam-parallel: next to each other, or in one plane"
    )
    roller_clearance: Distance | None = Field(
        None, description="total clearance of the roller in its slot; with it the impact at mid-swing is computed"
    )
    contact_stiffness: Annotated[float, unit("N/mm", gt=0)] | None = Field(
        None, description="stiffness of roller and flank; with it the force of the impact is computed"
    )


class SwingCycle(Spec):
    """Cam angles of a whole cycle, instead of cycle_angle: they add up to 360 deg; one may be omitted."""

    working: Stroke | None = Field(None, description="working stroke, run-up and run-out")
    far_dwell: Phase | None = Field(None, description="rest at the far end")
    return_: Stroke | None = Field(None, alias="return", description="return stroke")
    near_dwell: Phase | None = Field(
        None, description="rest at the near end; one of the four may be omitted: the remainder of 360 deg"
    )

    @model_validator(mode="after")
    def _one_turn(self) -> Self:
        given = {key: value for key, value in self._by_key().items() if value is not None}
        missing, total = [key for key in self._by_key() if key not in given], math.fsum(given.values())
        if len(missing) > 1:
            words = "at most one angle of a cycle may be omitted"
            raise refused(f"{words}\ngive all but one of {', '.join(missing)}")
        if missing and total >= 360.0:
            longest = max(given, key=lambda key: given[key])
            words = f"the given angles add up to {total:.13g} deg; nothing is left for {missing[0]}"
            raise refused(f"{words}\nshorten {longest}, so that they add up to less than 360 deg")
        if not missing and abs(total - 360.0) > 1e-9:
            required = "required 360 deg, one revolution of the cam"
            words = f"working, far_dwell, return and near_dwell: {total:.13g} deg ({required})"
            raise refused(f"{words}\n{self._help(given, 360.0 - total)}", "near_dwell", "GL108")
        return self

    @staticmethod
    def _help(angles: dict[str, float], change: float) -> str:
        """Which angle may take up the change [deg]: one that stays an angle."""
        for name in ("near_dwell", "far_dwell", "return", "working"):
            if angles[name] + change > 0.0:
                return f"set {name} to {angles[name] + change:.7g} deg, or omit it"
        return f"reduce the four angles by {-change:.7g} deg together"

    def _by_key(self) -> dict[str, float | None]:
        return {
            "working": self.working,
            "far_dwell": self.far_dwell,
            "return": self.return_,
            "near_dwell": self.near_dwell,
        }

    @property
    def lengths(self) -> tuple[float, ...]:
        """The four angles in their order [deg], the remainder among them."""
        found = self._by_key().values()
        rest = 360.0 - math.fsum(value for value in found if value is not None)
        return tuple(rest if value is None else value for value in found)


class SwingShaft(Spec):
    """The drive of the cam shaft; with it go the dynamic coefficient and the torque of the cam shaft."""

    natural_frequency: Annotated[float, unit("Hz", gt=0)] = Field(
        description="natural frequency of the drive in torsion, in Hz"
    )
    damping: Annotated[float, unit("1", ge=0, lt=1)] = Field(0.0, description="damping ratio of the drive")
    linkage_share: Share = Field(
        0.0,
        description="torque of the links that the device does not balance, as a share of the rocker's inertia torque",
    )


class SwingSlider(Spec):
    """A slider that the rocker moves through a rod."""

    crank: Length = Field(description="arm of the rocker that the rod is joined to")
    rod: Length = Field(description="connecting rod")
    middle_angle: Angle = Field(description="that arm at mid-swing, from the direction in which the slider is farthest")
    offset: SignedLength = Field(
        0.0, description="offset of the slide line; positive: the rod's height is crank sin(angle) + offset"
    )
    mass: Annotated[float, unit("kg", gt=0)] = Field(description="mass of the slider")


def _fixed_stroke(stroke: str) -> str:
    return "homeward" if stroke == "return" else stroke


class SwingDrive(Spec):
    """A crank-rocker whose rocker carries the cam."""

    crank: Length = Field(description="crank, turning at constant `speed`")
    coupler: Length = Field(description="coupler")
    rocker: Length = Field(description="rocker that carries the cam")
    frame: Length = Field(description="distance of the two pivots")
    assembly: Assembly = Field(1, description="+1: the coupler's end left of the vector from crank pin to rocker pivot")
    stroke: Annotated[Literal["outward", "homeward", "return"], AfterValidator(_fixed_stroke)] = Field(
        "outward", description="outward: from the extended to the folded dead centre; homeward, or return: back"
    )


class SwingLimits(LoadLimits):
    """Limits of the checks."""

    pressure_angle: AcuteAngle = Field(45.0, description="maximum pressure angle outside the transition zone")
    transmission_angle: AcuteAngle = Field(
        40.0, description="minimum transmission angle of `drive` and of a slider's rod"
    )
    transition_zone: Annotated[float, unit("1", gt=0, lt=0.5)] = Field(
        0.05, description="largest half-width of the contact change at mid-swing, share of the stroke"
    )
    cam_gap: Distance = Field(0.0, description="minimum clearance of cams on parallel shafts")
    impact_speed: Annotated[float, unit("mm/s", gt=0)] | None = Field(
        None, description="maximum impact speed of the roller where it changes flanks; default: not checked"
    )


class WideSwingSpec(TolerancedSpec):
    """Twin-cam or twin-rocker mechanism with spring or pneumatic unloading."""

    kind: Literal["wide-swing-cam"]
    layout: Literal["twin-cam", "twin-rocker", "twin-cam-parallel"] = Field(
        description="twin-cam: external profile; twin-rocker: internal profile; twin-cam-parallel: two shafts"
    )
    drive: SwingDrive | None = None
    cycle: SwingCycle | None = None
    swing: Annotated[float, unit("deg", gt=0, le=340)] = Field(description="whole swing")
    cycle_angle: Annotated[float, unit("deg", gt=0, lt=360)] | None = Field(
        None, validate_default=True, description="cam angle of one stroke; optional with a cycle or a drive"
    )
    speed: Annotated[float, unit("1/min", gt=0)] = Field(description="of the cam")
    inertia: Annotated[float, unit("kg m^2", ge=0)] = Field(
        description="moment of inertia on the rocker axis; 0 only where a slider carries the mass"
    )
    unloader: Pneumatic | SpringDevice | GravityDevice = Field(
        discriminator="type", description="device that balances the inertia", json_schema_extra=also("balancing_device")
    )
    output_radius: Length | None = Field(
        None, description="radius on the rocker at which the error of its end positions is computed"
    )
    operating_speed_min: Annotated[float, unit("1/min", gt=0)] | None = Field(
        None, description="minimum operating speed, at which the device is checked for increased torque"
    )
    method: Literal["exact", "iteration"] = Field(
        "exact", description="iteration: show the source's own iteration and its error against the exact law"
    )
    iteration_steps: Annotated[int, unit("1", ge=1, le=100_000)] = Field(
        20, description="steps of the iteration per half stroke"
    )
    cam: SwingCam | None = None
    gears: ShaftGears | None = None
    slider: SwingSlider | None = None
    shaft: SwingShaft | None = None
    limits: SwingLimits = SwingLimits.model_construct()
    loads: Annotated[Any, Deferred("machines.wide_swing.loads_spec:SwingLoads")] | None = Field(
        None, description="roller, material and vibration, for the command loads"
    )

    @field_validator("cycle_angle")
    @classmethod
    def _given_unless_driven(cls, value: float | None, info: ValidationInfo) -> float | None:
        """With the other fields, so that a missing key is reported together with every other error of the file."""
        drive, cycle = (info.data.get(name, ...) for name in ("drive", "cycle"))
        if value is None and drive is None and cycle is None:
            words = (
                "cycle_angle: cam angle of one stroke, run-up and run-out; or the section cycle of a whole revolution"
            )
            raise refused(f"the key 'cycle_angle' is missing\n{words}", "cycle_angle", "GL106")
        return value

    @model_validator(mode="after")
    def _sections_agree(self) -> Self:
        if self.slider is None and self.inertia == 0.0:
            raise refused("inertia: 0 (limit > 0): no slider carries a mass\nset inertia above 0", "inertia", "GL108")
        only_one(self, "cycle_angle", "cycle", at="cycle_angle")
        if self.drive is not None:
            self._agree_with_drive()
        self._shafts_agree()
        if self.slider is not None and self.cam is not None:
            self._cam_with_slider(self.cam)
        return self

    def _shafts_agree(self) -> None:
        parallel = self.layout == "twin-cam-parallel"
        if parallel and self.cam is not None and self.cam.second is None:
            words = "second: {direction: 110}, the shaft of the return cam"
            raise refused(f"the key 'second' is missing\n{words}", "cam.second", "GL106")
        if not parallel and self.cam is not None and self.cam.second is not None:
            raise refused(
                "cam.second applies only to layout: twin-cam-parallel\nremove it, or set that layout", "cam.second"
            )
        if not parallel and self.gears is not None:
            raise refused("gears apply only to layout: twin-cam-parallel\nremove them, or set that layout", "gears")
        if parallel and self.gears is not None and self.cam is None:
            raise refused("the gears need the section cam: center_distance, roller_radius, second", "cam", "GL106")

    def _cam_with_slider(self, cam: SwingCam) -> None:
        if self.layout != "twin-cam":
            raise refused(
                "the cam of a rocker with a slider has an external profile: layout must be twin-cam", "layout"
            )
        if self.cycle is not None:
            raise refused("cycle applies only to a rocker without a slider\ngive cycle_angle", "cycle")
        if cam.rocker_radius is not None:
            raise refused(
                "the law of a slider determines the rocker radius\nomit cam.rocker_radius", "cam.rocker_radius"
            )

    def _agree_with_drive(self) -> None:
        if self.cycle is not None:
            raise refused(
                "the dead centres of the drive determine the crank angles of both strokes\nomit cycle", "cycle"
            )
        if self.cycle_angle is not None:
            raise refused(
                "the dead centres of the drive determine the crank angle of the stroke\nomit cycle_angle", "cycle_angle"
            )
        if self.cam is None:
            raise refused("a drive needs the section cam: center_distance, roller_radius", "cam", "GL106")
        if self.layout != "twin-cam":
            raise refused("an oscillating cam has an external profile: layout must be twin-cam", "layout")
        if self.cam.rocker_radius is not None:
            raise refused("the drive determines the rocker radius\nomit cam.rocker_radius", "cam.rocker_radius")

    def commands(self) -> tuple[str, ...]:
        cam = ("cam",) if self.cam is not None else ()
        return ("swing", *cam, *self._loads())
