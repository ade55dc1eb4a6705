"""The design file of a planar mechanism: its links, what joins them, what drives it."""

from typing import Annotated, Any, Literal, Self

from pydantic import AfterValidator, Field, model_validator

from gearlink.core.base.spec import (
    AcuteAngle,
    Assembly,
    Deferred,
    Entries,
    Length,
    LoadLimits,
    PressureAngle,
    SignedLength,
    Spec,
    TolerancedSpec,
    plain_name,
    refused,
    unit,
)
from gearlink.core.parts.cams.motion_spec import FollowerMotion, SteepAngle, require_closed

FRAME = "frame"
MOST_LINKS = 40


Name = Annotated[str, AfterValidator(plain_name)]
Vector = Annotated[list[SignedLength], Field(min_length=2, max_length=2), Entries("[x, y]", "[100, 0]")]
Direction = Annotated[float, unit("deg", ge=-1e6, le=1e6)]
Place = Annotated[float, unit("deg", ge=-1e6, le=1e6)]
Number = Annotated[float, unit("1", ge=-1e6, le=1e6)]
TeethOrRing = Annotated[int, Field(ge=-10_000, le=10_000, json_schema_extra={"unit": "teeth", "not": {"const": 0}})]
Bar = Annotated[
    list[Name | Length],
    Field(min_length=3, max_length=3),
    Entries("[first point, second point, length]", "[A, B, 40]", ("", "", "mm")),
]
Points = Annotated[dict[Name, Vector], Field(min_length=1, max_length=100)]


class Slide(Spec):
    """A guide along which a link slides without turning against the body that has it."""

    link: Name = Field(description="the link that slides")
    on: Name = Field(FRAME, description="frame, or the link on which it slides")
    through: Vector = Field(description="a point of the line, in coordinates of `on`")
    direction: Direction = Field(description="direction of the line in coordinates of `on`")
    point: Name | None = Field(None, description="point of the link that runs on the line; default: its first")
    angle: Direction = Field(0.0, description="angle from the direction to the link's x axis")


class Slot(Spec):
    """A slot of a body in which a pin of another one runs."""

    point: Name = Field(description="the point that runs in the slot")
    on: Name = Field(description="frame, or the link that has the slot")
    through: Vector = Field(description="a point of the slot's line, in coordinates of `on`")
    direction: Direction = Field(description="direction of the line in coordinates of `on`")


class Teeth(Spec):
    """Two gears in mesh, or a rack and a pinion."""

    gears: Annotated[list[Name], Field(min_length=2, max_length=2), Entries("[link, link]")] | None = Field(
        None, description="the links of the two gears; frame for one that is fixed"
    )
    rack: Name | None = Field(None, description="the link of a rack, or frame; instead of gears")
    pinion: Name | None = Field(None, description="the link of the pinion that meshes with the rack")
    at: Annotated[list[Name], Field(min_length=2, max_length=2), Entries("[point, point]")] | Name = Field(
        description="the centres of the gears; the centre of the pinion"
    )
    teeth: Annotated[list[TeethOrRing], Field(min_length=2, max_length=2), Entries("[z1, z2]")] | TeethOrRing = Field(
        description="teeth of the gears, negative for a ring; of the pinion"
    )
    module: Length | None = Field(None, description="module; default: twice the centre distance over the teeth's sum")
    pressure_angle: PressureAngle = Field(20.0, description="pressure angle of the reference profile")
    carrier: Name | None = Field(
        None, description="the body that carries both centres; default: the first that has both points"
    )
    direction: Direction | None = Field(None, description="direction of the pitch line of the rack, in its coordinates")
    side: Literal[1, -1] | None = Field(None, description="1: the pinion is to the left of the direction; -1: right")

    @model_validator(mode="after")
    def _one_sort(self) -> Self:
        of_rack = {"rack": self.rack, "pinion": self.pinion, "direction": self.direction, "side": self.side}
        if self.gears is not None:
            if wrong := next((key for key, value in of_rack.items() if value is not None), ""):
                raise refused(f"{wrong} applies only to rack and pinion\nomit it or gears", wrong)
            if not isinstance(self.at, list) or not isinstance(self.teeth, list):
                raise refused(
                    "two gears need a list of two, [.., ..]", "at" if not isinstance(self.at, list) else "teeth"
                )
            if isinstance(self.teeth, list):
                _require_gears(self.teeth)
            return self
        missing = next((key for key, value in (*of_rack.items(), ("module", self.module)) if value is None), "")
        if missing:
            words = "give gears: [link, link], or rack, pinion, at, direction, side, teeth and module"
            raise refused(f"{missing} is missing: {words}", "rack", "GL106")
        if isinstance(self.at, list) or isinstance(self.teeth, list):
            raise refused(
                "a rack meshes with one pinion\ngive one value instead of a list",
                "at" if isinstance(self.at, list) else "teeth",
            )
        if isinstance(self.teeth, int) and self.teeth < 1:
            raise refused("a pinion has 1 tooth or more", "teeth")
        if self.carrier is not None:
            raise refused("a rack needs no carrier: its slide keeps its distance from the pinion", "carrier")
        return self


def _require_gears(teeth: list[int]) -> None:
    if 0 in teeth:
        raise refused("a gear has 1 tooth or more, a ring -1 or less\nwrite its teeth", f"teeth[{teeth.index(0)}]")
    if max(teeth) < 0:
        raise refused("two rings cannot mesh\nmake one of them an external gear", "teeth")
    if min(teeth) < 0 <= sum(teeth):
        raise refused("a ring gear needs more teeth than the gear in it\nchange one of the two", "teeth")


class CamPair(Spec):
    """A cam on a link, and the follower that it moves by a law; the start position is that of lift 0."""

    cam: Name = Field(description="the link that carries the cam; it turns on `on`")
    follower: Name = Field(description="the link that the cam moves; it turns or slides on `on`")
    point: Name = Field(description="of the follower: centre of its roller, or a point of its flat face")
    motion: FollowerMotion = Field(
        description="lift over the revolution of the cam, away from the cam; of a follower that turns in deg"
    )
    roller_radius: Length | None = Field(None, description="radius of the roller")
    face: Direction | None = Field(
        None, description="of a flat face instead of a roller: its direction in coordinates of the follower"
    )
    phase: Direction = Field(0.0, description="cam angle in the start position")
    sense: Assembly = Field(1, description="+1: the cam turns counter-clockwise against `on`; -1: clockwise")
    on: Name | None = Field(None, description="body that carries both; default: the first that does")

    @model_validator(mode="after")
    def _one_contact(self) -> Self:
        if (self.roller_radius is None) == (self.face is None):
            words = "give roller_radius or face"
            code = "GL106" if self.face is None else "GL111"
            raise refused(words, "roller_radius", code)
        require_closed(self.motion, 0.0)
        return self


class Drive(Spec):
    """What is driven: a link that turns, or a slide."""

    link: Name | None = Field(None, description="the link that the input turns")
    slide: Name | None = Field(None, description="the slide that the input moves, instead of link")
    others: Annotated[dict[Name, Number], Field(max_length=40)] = Field(
        {}, alias="with", description="further drives, links or slides by name, and their travel per input"
    )

    @model_validator(mode="after")
    def _one(self) -> Self:
        if (self.link is None) == (self.slide is None):
            words = "give link or slide" if self.link is None else "give either link or slide: one input drives"
            raise refused(words, "slide", "GL106" if self.link is None else "GL111")
        return self

    @property
    def main(self) -> str:
        """The link or slide that the input moves."""
        return self.link or self.slide or ""


class Range(Spec):
    """Where the input swings or slides."""

    start: Place = Field(0.0, description="first input, in deg or mm from the start position")
    end: Place = Field(description="last input")

    @model_validator(mode="after")
    def _ascending(self) -> Self:
        if self.end <= self.start:
            raise refused("the range ends before it starts\ngive a greater end", "end")
        return self


class PlanarLimits(LoadLimits):
    """Limits of the checks."""

    transmission_angle: AcuteAngle = Field(40.0, description="minimum transmission angle of a dyad")
    gear_gap: SignedLength = Field(0.0, description="minimum gap between gears that do not mesh")
    pressure_angle: SteepAngle | None = Field(
        None, description="maximum pressure angle of cams; 30 for followers that slide, 45 for those that turn"
    )
    least_shaft: Annotated[float, unit("mm", ge=0)] | None = Field(
        None, description="minimum radius for a shaft where none is given; default: one module"
    )


class PlanarSpec(TolerancedSpec):
    """Links with points, joined by pins, slides, slots, teeth and cams, that one or more drives move."""

    kind: Literal["planar-mechanism"]
    frame: Points = Field(description="points of the frame")
    links: Annotated[dict[Name, Bar | Points], Field(min_length=1, max_length=MOST_LINKS)] = Field(
        description="links by name: [P, Q, length], a bar whose x axis leads from P to Q; or points in coordinates of "
        "the link, of a slider {P: [0, 0]} alone. A point that several bodies have is a pin"
    )
    slides: Annotated[dict[Name, Slide], Field(max_length=MOST_LINKS)] = Field({}, description="slides by name")
    slots: Annotated[dict[Name, Slot], Field(max_length=MOST_LINKS)] = Field({}, description="slots by name")
    meshes: Annotated[dict[Name, Teeth], Field(max_length=MOST_LINKS)] = Field(
        {}, description="gears in mesh, and racks, by name"
    )
    cams: Annotated[dict[Name, CamPair], Field(max_length=MOST_LINKS)] = Field(
        {}, description="cams and their followers by name"
    )
    drive: Drive
    start: Annotated[dict[Name, Place], Field(max_length=2 * MOST_LINKS)] = Field(
        {},
        description=(
            "directions of the links [deg] and positions of slides [mm] at input 0: exact for driven links, links "
            "tied by a mesh and followers of cams (at lift 0); approximate for all others, where they select the "
            "assembly"
        ),
    )
    range: Range | None = Field(None, description="range of the input if it oscillates; default: it turns")
    outputs: Annotated[list[Name], Field(min_length=1, max_length=100)] | None = Field(
        None,
        description=(
            "links, slides, slots and points whose motion is given; of a link that slides on the frame its slide; "
            "default: all links but the driven one, then slides"
        ),
    )
    input_speed: Annotated[float, unit("1/min", ge=1e-6, le=1e6)] | None = Field(
        None, description="speed of the input, of a slide in mm/s: with it real speeds and times are given"
    )
    limits: PlanarLimits = PlanarLimits.model_construct()
    shafts: Annotated[dict[Name, Length], Field(max_length=100)] = Field(
        {}, description="radii of shafts at points of the frame, by POINT_radius"
    )
    loads: Annotated[Any, Deferred("machines.planar.loads_spec:PlanarLoads")] | None = Field(
        None, description="masses, forces and drive, for the command loads"
    )

    @model_validator(mode="after")
    def _wired(self) -> Self:
        from gearlink.core.machines.planar.wiring import faults

        for code, key, message in faults(self):
            raise refused(message, key, code)
        return self

    @property
    def bodies(self) -> dict[str, dict[str, complex]]:
        """Points of every body in its own coordinates [mm], the frame first."""
        found = {FRAME: {name: complex(*place) for name, place in self.frame.items()}}
        for name, link in self.links.items():
            found[name] = (
                {name: complex(*place) for name, place in link.items()}
                if isinstance(link, dict)
                else {str(link[0]): 0j, str(link[1]): complex(link[2])}
            )
        return found

    @property
    def slid(self) -> dict[str, str]:
        """By link that slides, its slide."""
        return {each.link: name for name, each in self.slides.items()}

    @property
    def shown(self) -> list[str]:
        """The outputs: those of the file, or all links but the driven one and all slides."""
        links = (name for name in self.links if name != self.drive.main)
        names = [*links, *self.slides] if self.outputs is None else self.outputs
        return list(dict.fromkeys(map(self.output, names)))

    def output(self, name: str) -> str:
        """What is looked at under a name: of a link that slides on the frame and does not turn, its slide."""
        slide = self.slid.get(name, "")
        return slide if slide and self.slides[slide].on == FRAME else name
