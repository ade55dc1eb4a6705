"""The design file of a machine: members, events, relations, main shaft."""

import json
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, Self

from pydantic import BeforeValidator, Field, ValidationError, WithJsonSchema, model_validator

from gearlink.core.base.errors import NoSolution, named
from gearlink.core.base.spec import (
    Deferred,
    DesignSpec,
    Entries,
    Length,
    Ratio,
    Share,
    Spec,
    Speed,
    TolerancedSpec,
    plain_name,
    refused,
    unit,
)
from gearlink.core.base.spec_paths import put
from gearlink.core.base.torsion import OfShaft
from gearlink.core.base.wording import amount
from gearlink.core.machines.machine.relations import NotARelation, Relation, parse

if TYPE_CHECKING:
    from collections.abc import Iterable

    from gearlink.core.base.kind import Kind

AboveZero = Annotated[float, Field(gt=0, le=1e12)]
Inertia = Annotated[float, unit("kg m^2", gt=0, le=1e12)]
Stiffness = Annotated[float, unit("N m/rad", gt=0, le=1e15)]
Turns = Annotated[float, unit("1", ge=-1e6, le=1e6)]
MachineAngle = Annotated[float, unit("deg", ge=-36_000, le=36_000)]


def _first_wrong(error: ValidationError) -> tuple[str, str, str]:
    """Code, key and message of the first thing that the model of a member refuses."""
    item = error.errors(include_url=False)[0]
    steps = [step for step in item["loc"] if isinstance(step, int) or step.isidentifier()]
    below = str((item.get("ctx") or {}).get("key", ""))
    key = "".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in (*steps, *filter(None, [below])))
    code = item["type"] if item["type"].startswith("GL") else "GL108"
    message = (
        "this key is missing" if item["type"] == "missing" else item["msg"].replace("Input should be", "it must be")
    )
    return code, key.removeprefix("."), message


@lru_cache(maxsize=64)
def _spec_of(kind: str, text: str) -> Any:
    """The spec of a member, one and the same for machines that differ elsewhere."""
    from gearlink.core.base.kinds import KINDS

    return KINDS[kind].spec_model().model_validate_json(text)


def _made(design: Any) -> Any:
    """The spec of a member from the data of its file; one that is made already as it is."""
    from gearlink.core.base.kinds import KINDS

    if not isinstance(design, dict):
        if isinstance(design, DesignSpec):
            return design
        raise refused("a design is a section: {kind: disc-cam, ...}", code="GL107")
    name = design.get("kind")
    moving = {each: kind for each, kind in KINDS.items() if kind.motion}
    if not isinstance(name, str) or name not in moving:
        raise refused(f"no kind of member {named(str(name))}: the kinds are {', '.join(moving)}", "kind", "GL109")
    try:
        return _spec_of(name, json.dumps(design))
    except ValidationError as error:
        code, key, message = _first_wrong(error)
        raise refused(message, key, code) from None
    except NoSolution as error:
        raise refused(error.message, error.key, error.code) from None


class Member(Spec):
    """A mechanism of the machine."""

    of: str | None = Field(None, description="its design file, relative to that of the machine")
    design: Annotated[Any, BeforeValidator(_made), WithJsonSchema({"type": "object"})] | None = Field(
        None, description="the design itself, instead of of"
    )
    phase: Annotated[float, unit("deg")] | Literal["free"] = Field(
        0.0, description="machine angle at which its input angle is 0, in the driver's unit where it has one; or free"
    )
    ratio: Turns = Field(
        1.0,
        description="revolutions of its input per revolution of the main shaft, negative: reversed; of the driver with "
        "input; of a driver that slides in deg/mm",
    )
    input: str | None = Field(None, description="output of another member that drives it, such as feed.output")

    @model_validator(mode="before")
    @classmethod
    def _not_both(cls, data: Any) -> Any:
        if isinstance(data, dict) and data.get("of") is not None and data.get("design") is not None:
            raise refused("give `of` or `design`, exactly one", "design")
        return data

    @model_validator(mode="after")
    def _one_design(self) -> Self:
        if self.of is None and self.design is None:
            raise refused("give `of` or `design`, exactly one", "of", "GL106")
        if self.ratio == 0.0:
            raise refused("with ratio 0 the member does not move\nset another ratio", "ratio", "GL108")
        if self.phase == "free" and self.input is not None:
            raise refused("a member with input moves with its driver\ngive a number for its phase", "phase")
        return self

    @property
    def spec(self) -> Any:
        """The spec of its design.

        Raises
            NoSolution - where its file was not read
        """
        if self.design is None:
            raise NoSolution(f"the file {self.of} was not read", key="of", fix="give its keys under design")
        return self.design

    @property
    def kind(self) -> "Kind":
        """The kind of its design."""
        from gearlink.core.base.kinds import KINDS

        return KINDS[self.spec.kind]

    def changed(self, changes: "Iterable[tuple[str, Any]]") -> Any:
        """The spec of its design with other values at some paths.

        Raises
            NoSolution - at the key below `design`
        """
        data = self.spec.model_dump(mode="json", by_alias=True, exclude_unset=True)
        for path, value in changes:
            put(data, path, value)
        try:
            return type(self.spec).model_validate_json(json.dumps(data))
        except ValidationError as error:
            _, key, message = _first_wrong(error)
            raise NoSolution(message, key=key) from None


class Event(Spec):
    """A moment at which a member passes a value."""

    of: str = Field(description="a member, or one of its outputs as MEMBER.OUTPUT")
    output: Annotated[float, unit("1")] = Field(description="value that the output passes, mm or deg")
    on: str | None = Field(None, description="motion in which it does so: rise, return, rise[2]; default: the first")


class MainShaft(Spec):
    """The main shaft as a chain of discs and springs."""

    inertias: Annotated[list[Inertia], Field(min_length=2, max_length=200), Entries("one of each disc")] = Field(
        description="moments of inertia of the discs, with what they drive"
    )
    stiffnesses: Annotated[
        list[Stiffness | OfShaft], Field(min_length=1, max_length=199), Entries("between neighbours")
    ] = Field(
        description=(
            "torsional stiffness between neighbouring discs, related to the shaft of the first one, or the dimensions "
            "of that shaft; through a mesh the tooth stiffness times the square of its base radius"
        )
    )
    members: Annotated[list[str | list[str]], Field(max_length=200)] | None = Field(
        None, description="names of the discs, of a disc with several members a list; other members act on the first"
    )
    ratios: Annotated[list[Turns], Field(max_length=200)] | None = Field(
        None, description="revolutions of each disc per revolution of the main shaft; default 1"
    )
    fixed: bool = Field(False, description="the first disc is fixed")
    damping: Annotated[float, unit("1", ge=0, lt=1)] | None = Field(
        None, description="damping ratio of every mode; default: 0.03, assumed"
    )

    @model_validator(mode="after")
    def _as_many(self) -> Self:
        count = len(self.inertias)
        if len(self.stiffnesses) != count - 1:
            springs = amount(count - 1, "stiffness", "stiffnesses")
            raise refused(f"{count} discs have {springs} between them, not {len(self.stiffnesses)}", "stiffnesses")
        for name in ("members", "ratios"):
            given = getattr(self, name)
            if given is not None and len(given) != count:
                free = "; a disc without a mechanism may have any name, such as motor" if name == "members" else ""
                message = f"{name}: {amount(len(given), 'entry', 'entries')} for {count} discs\ngive one for each{free}"
                raise refused(message, name)
        if self.ratios is not None and 0.0 in self.ratios:
            raise refused("a disc with ratio 0 does not move", f"ratios[{self.ratios.index(0.0)}]", "GL108")
        names = [name for disc in self.acting for name in disc]
        if twice := [name for name in names if names.count(name) > 1]:
            raise refused(f"{named(twice[0])} is on two discs\nput it on one", "members")
        if [] in self.acting:
            raise refused("a disc without a name\ngive it one, such as motor", "members", "GL108")
        return self

    @property
    def acting(self) -> list[list[str]]:
        """Names that stand on each disc; the first one names it."""
        if self.members is None:
            return [[str(i)] for i in range(1, len(self.inertias) + 1)]
        return [[disc] if isinstance(disc, str) else disc for disc in self.members]

    @property
    def discs(self) -> list[str]:
        """Names of the discs."""
        return [names[0] for names in self.acting]


class MachineLimits(Spec):
    """Limits of the checks."""

    timing_margin: Share = Field(0.0, description="minimum margin of the relations, deg; below it a warning")
    torque_margin: Ratio = Field(1.0, description="minimum ratio of the motor's torque to the required one")


class MachineLoads(Spec):
    """Motor and flywheel on the main shaft."""

    flywheel: Annotated[Any, Deferred("studies.loads.spec:Flywheel")] | None = Field(
        None, description="flywheel on the main shaft"
    )
    motor: Annotated[Any, Deferred("studies.loads.spec:Motor")] | None = Field(
        None, description="motor of the main shaft"
    )


class MachineServo(Spec):
    """The table of a drive that makes the motion of a member over the machine angle."""

    member: str = Field(description="the member whose output the drive makes")
    rows: Annotated[int, unit("rows", ge=2, le=100_000)] | None = Field(
        None, description="rows of the table, both ends"
    )
    tolerance: Annotated[float, unit("1", gt=0)] | None = Field(
        None, description="maximum position error between rows, mm or deg, instead of rows"
    )

    @model_validator(mode="after")
    def _one(self) -> Self:
        if (self.rows is None) == (self.tolerance is None):
            key = "rows" if self.rows is None else "tolerance"
            raise refused("give rows, or tolerance instead", key, "GL106" if self.rows is None else "GL111")
        return self


class MachineRegister(Spec):
    """The register between members at the print."""

    at: MachineAngle = Field(0.0, description="machine angle of the print")
    chain: Annotated[dict[str, Annotated[float, unit("1")]], Field(min_length=1)] = Field(
        description="factor of each member's error in the register error at the print, with its sign"
    )
    tolerance: Length | None = Field(None, description="maximum error that is allowed, to either side")


class MachineSpec(TolerancedSpec):
    """A machine of several mechanisms on one main shaft."""

    section_of_members: ClassVar[str] = "members"
    """The section whose entries are designs of their own, read from their files."""

    kind: Literal["machine"]
    speed: Speed | None = Field(None, description="speed of the main shaft")
    members: Annotated[dict[str, Member], Field(min_length=1, max_length=400)] = Field(
        description="the mechanisms by name, each {of: FILE} or {design: {...}}"
    )
    events: Annotated[dict[str, Event], Field(max_length=2000)] = Field(
        {}, description="named events at which a member passes a value"
    )
    require: Annotated[list[str], Field(max_length=2000)] = Field(
        [], description="relations: EVENT before EVENT by DEG; RUN within RUN by DEG; MEMBER.velocity at EVENT <= VALUE"
    )
    shaft: MainShaft | None = Field(None, description="the main shaft as a torsional chain")
    limits: MachineLimits = MachineLimits.model_construct()
    loads: MachineLoads | None = Field(None, description="motor and flywheel on the main shaft")
    servo: MachineServo | None = Field(None, description="table of a drive instead of a member")
    register_: MachineRegister | None = Field(None, alias="register", description="register between members")

    @cached_property
    def relations(self) -> tuple[Relation, ...]:
        """The relations of `require`."""
        return tuple(parse(text) for text in self.require)

    @model_validator(mode="after")
    def _drivers(self) -> Self:
        for name, member in self.members.items():
            plain_name(name, f'members."{name}"')
            if member.input is None:
                continue
            driver = member.input.partition(".")[0]
            if driver not in self.members:
                message = f"no member {named(driver)}: there are {', '.join(self.members)}"
                raise refused(message, f"members.{name}.input", "GL109")
        for name in self.members:
            if loop := self._circle(name):
                message = (
                    f"{' <- '.join(loop)} drive each other in a closed loop\nlet one of them be driven by the shaft"
                )
                raise refused(message, f"members.{name}.input")
        return self

    def _circle(self, name: str) -> list[str]:
        seen = [name]
        while (given := self.members[seen[-1]].input) is not None:
            seen.append(given.partition(".")[0])
            if seen[-1] in seen[:-1]:
                return seen[seen.index(seen[-1]) :] if seen[-1] == name else []
        return []

    @model_validator(mode="after")
    def _named(self) -> Self:
        for name, event in self.events.items():
            plain_name(name, f'events."{name}"')
            if name in self.members:
                raise refused(f"{name} is a member: give the event another name", f"events.{name}")
            if event.of.partition(".")[0] not in self.members:
                message = f"no member {named(event.of)}: there are {', '.join(self.members)}"
                raise refused(message, f"events.{name}.of", "GL109")
        for i, text in enumerate(self.require):
            try:
                parse(text).require_names(tuple(self.members), tuple(self.events))
            except NotARelation as error:
                raise refused(str(error), f"require[{i}]", error.code) from None
        places = [(name, f"register.chain.{name}") for name in (self.register_.chain if self.register_ else ())]
        places += [] if self.servo is None else [(self.servo.member, "servo.member")]
        for name, key in places:
            if name not in self.members:
                raise refused(f"no member {named(name)}: there are {', '.join(self.members)}", key, "GL109")
        return self

    @property
    def free(self) -> tuple[str, ...]:
        """Members whose phase is sought."""
        return tuple(name for name, member in self.members.items() if member.phase == "free")

    def root(self, name: str) -> str:
        """The member on the main shaft that drives a member, itself where the shaft does."""
        while (given := self.members[name].input) is not None:
            name = given.partition(".")[0]
        return name

    def commands(self) -> tuple[str, ...]:
        more = (("loads", self.loads), ("register", self.register_))
        return ("analyze", *(name for name, section in more if section is not None))
