"""The design file of a swing gripper."""

from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator

from gearlink.core.base.spec import (
    AcuteAngle,
    Angle,
    Assembly,
    Deferred,
    Distance,
    Entries,
    Length,
    LoadLimits,
    SignedLength,
    Spec,
    TolerancedSpec,
    also,
    refused,
    unit,
)
from gearlink.core.parts.cams.spec import MotionLaw

InertiaMoment = Annotated[float, unit("kg m^2", ge=0)]
Phase = Annotated[float, unit("deg", gt=0, lt=360)]
Point = Annotated[list[SignedLength], Field(min_length=2, max_length=2), Entries("[x, y]")]


class Cylinder(Spec):
    """The cylinder that takes the sheet over."""

    radius: Length = Field(description="radius R of the cylinder")
    center: Point | None = Field(None, description="axis of the cylinder; default: the axis that fits is reported")


class Arm(Spec):
    """The gripper arm EF, rigid with the output link ED."""

    length: Length = Field(description="EF")
    direction: Angle = Field(description="direction of EF at the pick-up position")


class Links(Spec):
    """The linkage from the cam rocker to the gripper."""

    input: Length = Field(description="AC, on the cam rocker")
    coupler: Length = Field(description="CD")
    output: Length = Field(description="ED, rigid with the gripper arm")


class Pivots(Spec):
    """The fixed pivots."""

    input: Point = Field(description="A, pivot of the cam rocker")
    output: Point = Field(description="E, pivot of the gripper")


class Phases(Spec):
    """The six phases of a revolution: they add up to 360 deg; one may be omitted; or three are sized by balance."""

    accelerate: Phase | None = Field(None, description="from the pick-up to the constant speed")
    constant: Phase | None = Field(None, description="at the speed of the cylinder; the handover lies in it")
    decelerate: Phase | None = Field(None, description="to the far dwell")
    far_dwell: Annotated[float, unit("deg", ge=0, lt=360)] | None = Field(
        None, description="dwell at the far end; 0: the arm reverses at once"
    )
    return_: Phase | None = Field(None, alias="return", description="back to the pick-up position")
    near_dwell: Phase | None = Field(
        None, description="dwell at the pick-up position; one phase without a value takes the remaining angle"
    )
    balance: Annotated[float, unit("1", ge=0.01, le=100)] | None = Field(
        None,
        description=(
            "peak acceleration of the return over that of accelerate and decelerate, which are equal: determines "
            "these three phases"
        ),
    )

    @model_validator(mode="after")
    def _whole_turn(self) -> Self:
        given = {key: value for key, value in self._by_key().items() if value is not None}
        total, missing = sum(given.values()), [key for key in self._by_key() if key not in given]
        if self.balance is not None:
            self._require_sized(missing)
        elif len(missing) > 1:
            raise refused(f"at most one phase may be omitted\ngive all but one of {', '.join(missing)}")
        if missing and total >= 360.0:
            left = "accelerate, decelerate and return" if self.balance is not None else missing[0]
            longest = max(given, key=lambda key: given[key])
            text = f"the given phases add up to {total:g} deg; nothing is left for {left}"
            raise refused(f"{text}\nshorten {longest}, so that they add up to less than 360 deg")
        if not missing and abs(total - 360.0) > 1e-9:
            text = f"sum of the six phases: {total:g} deg (required 360 deg)"
            raise refused(f"{text}\n{self._help(given, 360.0 - total)}")
        return self

    def _require_sized(self, missing: list[str]) -> None:
        """Refuse a balance beside a phase that it sizes, or without one that it needs."""
        surplus = [key for key in SIZED if key not in missing]
        lacking = [key for key in missing if key not in SIZED]
        if surplus or lacking:
            fix = f"leave out {', '.join(surplus)}" if surplus else f"give {', '.join(lacking)}"
            raise refused(f"balance sizes accelerate, decelerate and return, from the other three\n{fix}")

    def _help(self, given: dict[str, float], change: float) -> str:
        """Which phase may take up the change [deg]: the last, behind which no other moves, or else the longest."""
        name = "near_dwell" if given["near_dwell"] + change > 0.0 else max(given, key=lambda key: given[key])
        if given[name] + change > 0.0:
            return f"set phases.{name} to {given[name] + change:g} deg"
        return f"reduce the phases by {-change:g} deg together"

    def _by_key(self) -> dict[str, float | None]:
        return {
            "accelerate": self.accelerate,
            "constant": self.constant,
            "decelerate": self.decelerate,
            "far_dwell": self.far_dwell,
            "return": self.return_,
            "near_dwell": self.near_dwell,
        }

    def given(self, key: str) -> float | None:
        """The length of a phase as the file has it [deg]; None where it is left out."""
        return self._by_key()[key]

    def lengths(self) -> tuple[float, ...] | None:
        """The six lengths in their order [deg], the remainder among them; None where balance sizes three."""
        if self.balance is not None:
            return None
        found = [*self._by_key().values()]
        rest = 360.0 - sum(value for value in found if value is not None)
        return tuple(rest if value is None else value for value in found)


SIZED = ("accelerate", "decelerate", "return")
"""The phases that `balance` sizes."""


class Laws(Spec):
    """The laws of motion of the three moving phases."""

    accelerate: MotionLaw = Field("velocity-345", description="rest-to-speed law")
    decelerate: MotionLaw = Field("half-cycloidal", description="rest-to-speed law, run backwards")
    return_: MotionLaw = Field("modified-sine", alias="return", description="rest-to-rest law")


class Roller(Spec):
    """A cam roller on its rocker."""

    arm: Length = Field(description="rocker pivot A to roller centre")
    angle: Angle = Field(description="from AC (main roller) or from the main roller's arm (return roller)")
    radius: Length = Field(description="radius of the roller")


class GripperCam(Spec):
    """The cam pair on the cylinder's shaft."""

    center: Point | None = Field(None, description="cam axis; default: chosen by the section `size`")
    sense: Assembly = Field(description="+1: cam turns counter-clockwise; -1: clockwise")
    roller: Roller
    return_roller: Roller | None = None
    shaft_radius: Distance = Field(0.0, description="cam shaft; 0: not checked")


class Size(Spec):
    """Choice of a cam centre that is not given: the smallest cam for a pressure angle."""

    pressure_angle: Annotated[float, unit("deg", gt=0, lt=90)] = Field(
        description="pressure angle that no roller exceeds"
    )
    side: Assembly | None = Field(
        None, description="+1: cam left of the main roller's arm, seen from A; default: on the return roller's side"
    )


class Release(Spec):
    """The cylinder angles over which one gripper opens and the other closes on the sheet."""

    window: Annotated[float, unit("deg", gt=0, lt=90)] = Field(
        description="cylinder angle before and after the handover"
    )
    gap: Length = Field(0.03, description="allowed distance of the gripper tip from the pitch circle")


class Inertia(Spec):
    """Moments of inertia about the links' own axes, and the coupler's mass."""

    input: InertiaMoment = Field(0.0, description="cam rocker about A")
    output: InertiaMoment = Field(0.0, description="gripper about E")
    coupler: InertiaMoment = Field(0.0, description="coupler about its centre of mass")
    coupler_mass: Annotated[float, unit("kg", ge=0)] = Field(
        0.0, description="mass of the coupler, its centre at mid-length"
    )
    return_rocker: InertiaMoment = Field(0.0, description="return rocker about A")


class ClosingSpring(Spec):
    """The spring that pulls the two rockers together: its torque, or the levers and the pull that make it."""

    torque: Annotated[float, unit("N m", gt=0)] | None = Field(
        None, description="torque on each rocker; alternatively arms, angle, preload"
    )
    arms: Annotated[list[Length], Field(min_length=2, max_length=2), Entries("[cam rocker, return rocker]")] | None = (
        Field(None, description="A to the spring's ends on cam rocker and return rocker")
    )
    angle: Annotated[float, unit("deg", gt=0, lt=180)] | None = Field(None, description="angle between these two arms")
    preload: Annotated[float, unit("N", ge=0)] | None = Field(
        None, description="pull of the spring; at `length` where a rate is given"
    )
    rate: Annotated[float, unit("N/mm", gt=0)] | None = Field(None, description="rate of the spring")
    length: Length | None = Field(None, description="length at which the spring pulls with `preload`")
    reserve: Annotated[float, unit("N m", ge=0)] = Field(0.0, description="minimum torque that must remain")

    @model_validator(mode="after")
    def _torque_or_levers(self) -> Self:
        needed = {"arms": self.arms, "angle": self.angle, "preload": self.preload}
        missing = [key for key, value in needed.items() if value is None]
        given = [key for key in (*needed, "rate", "length") if getattr(self, key) is not None]
        if self.torque is not None and given:
            text = f"torque and {given[0]} exclude each other\ngive the torque, or the levers that produce it"
            raise refused(text, "torque")
        if self.torque is None and missing:
            raise refused(f"give torque, or arms, angle and preload; {', '.join(missing)} missing", "torque")
        if (self.rate is None) != (self.length is None):
            raise refused("rate and length go together: the spring pulls with preload at that length", "rate")
        return self


class ArmStop(Spec):
    """A stop on which the arm rests in the near dwell, while the main roller clears its cam."""

    radius: Length = Field(description="E to the stop")
    clearance: Length = Field(description="gap between main roller and cam while the arm rests on the stop")
    restitution: Annotated[float, unit("1", gt=0, lt=1)] = Field(
        0.5, description="speed after an impact on the stop over that before it"
    )
    stiffness: Annotated[float, unit("N/mm", gt=0)] | None = Field(
        None, description="stiffness of the stop: gives the maximum force of the impact"
    )


class FingersOpen(Spec):
    """Where the fingers open."""

    from_: Phase = Field(alias="from", description="cylinder angle at which the fingers begin to open")
    over: Phase = Field(description="cylinder angle of this motion")
    law: MotionLaw = Field("cycloidal", description="rest-to-rest law")


class FingersClose(Spec):
    """Where the fingers close again."""

    to: Annotated[float, unit("deg", gt=0, le=360)] = Field(
        description="cylinder angle at which the fingers are closed"
    )
    over: Phase = Field(description="cylinder angle of this motion")
    law: MotionLaw = Field("cycloidal", description="rest-to-rest law")


class FingerSection(Spec):
    """Fingers at the tip, opened by a roller lever on the arm and a cam about E that turns with the cylinder."""

    lever: Length = Field(description="pivot of the roller lever to roller centre")
    pivot: Length = Field(description="E to the pivot of the roller lever, along the arm")
    angle: Angle = Field(description="from the arm to the roller lever, fingers closed")
    roller_radius: Length = Field(description="radius of the roller")
    length: Length = Field(description="length of the fingers")
    open_angle: Annotated[float, unit("deg", gt=0, lt=180)] = Field(description="angle by which lever and fingers turn")
    open: FingersOpen
    close: FingersClose

    @model_validator(mode="after")
    def _one_after_the_other(self) -> Self:
        opened, closing = self.open.from_ + self.open.over, self.close.to - self.close.over
        if opened > closing:
            text = (
                f"the fingers are open from {opened:g} deg and begin to close at {closing:g} deg\nlet them close later"
            )
            raise refused(text, "close")
        return self


class GripperLimits(LoadLimits):
    """Limits of the checks."""

    transmission_angle: AcuteAngle = Field(40.0, description="minimum transmission angle, at D and at C")
    pressure_angle: AcuteAngle = Field(45.0, description="maximum pressure angle of the cams")
    accelerate_pressure_angle: AcuteAngle = Field(
        30.0, description="maximum pressure angle in the phase accelerate; only warns"
    )
    condition_number: Annotated[float, unit("1", gt=1)] = Field(
        100.0, description="maximum condition number of the loop, 1/sin(mu); only warns"
    )
    handover_place: Length = Field(
        0.01,
        description="gripper tip off the line of centres at the handover",
        json_schema_extra={"unit": "mm", **also("handover_position")},
    )
    least_shaft: Length | None = Field(
        None, description="minimum shaft radius where the file gives none; default: that of the roller"
    )
    return_acceleration: Annotated[float, unit("1", gt=0)] | None = Field(
        None, description="peak acceleration of the return over that of the phase accelerate; none: no limit"
    )
    jerk_step: Annotated[float, unit("1", ge=0)] | None = Field(
        None, description="jump of the swing's third derivative by the cylinder angle; only warns; none: no limit"
    )


class SwingGripperSpec(TolerancedSpec):
    """Six-phase swing gripper with cam rocker, four-bar and cam pair."""

    kind: Literal["swing-gripper"]
    speed: Annotated[float, unit("sheets/h", gt=0)] = Field(description="sheets per hour")
    cylinder: Cylinder
    arm: Arm
    links: Links
    pivots: Pivots
    output_direction: Angle = Field(description="direction of ED at the pick-up position")
    swing_sense: Assembly = Field(description="-1: the working stroke turns clockwise")
    assembly: Assembly = Field(1, description="sign of sin(input angle - coupler angle); +1: C left of A->D")
    phases: Phases
    handover: Phase | None = Field(
        None, description="cylinder angle of the handover; default: the middle of the phase constant"
    )
    total_swing: Phase | None = Field(None, description="stated swing: rejected if law and phases give another")
    release: Release | None = None
    laws: Laws = Laws.model_construct()
    cam: GripperCam | None = None
    size: Size | None = None
    inertia: Inertia | None = None
    spring: ClosingSpring | None = None
    stop: ArmStop | None = None
    fingers: FingerSection | None = None
    limits: GripperLimits = GripperLimits.model_construct()
    loads: Annotated[Any, Deferred("studies.loads.spec:CamLoads")] | None = Field(
        None, description="masses, forces and drive, for the command loads"
    )

    @model_validator(mode="after")
    def _handover_at_speed(self) -> Self:
        lengths = self.phases.lengths()
        if lengths is None or self.handover is None:
            return self
        start, end = lengths[0], lengths[0] + lengths[1]
        if not start <= self.handover <= end:
            text = f"the handover at {self.handover:g} deg lies outside the constant-speed phase"
            raise refused(f"{text}\nset handover from {start:g} to {end:g} deg", "handover", "GL108")
        return self

    @model_validator(mode="after")
    def _stop_with_its_sections(self) -> Self:
        missing = [key for key in ("cam", "spring", "inertia") if getattr(self, key) is None]
        if self.stop is not None and missing:
            raise refused(f"a stop needs the sections cam, spring and inertia: {', '.join(missing)} missing", "stop")
        return self

    def commands(self) -> tuple[str, ...]:
        cam = ("cam",) if self.cam is not None else ()
        return ("gripper", *cam, *self._loads())
