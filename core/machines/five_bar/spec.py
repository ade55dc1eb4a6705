"""The design file of a geared five-bar, for a path or for a function."""

from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator

from gearlink.core.base.spec import (
    Angle,
    Assembly,
    Deferred,
    DrivenSpec,
    Entries,
    Length,
    PressureAngle,
    SignedLength,
    Spec,
    Teeth,
    refused,
    unit,
)
from gearlink.core.parts.gears.train.keys import TrainKeys
from gearlink.core.parts.linkages.spec_parts import LinkageLimits, TurnAngle, require_rim
from gearlink.core.parts.linkages.spec_sections import InputRange, Plain, require_function


class FiveBarGears(TrainKeys):
    """The gears: input and output for a path, planet and sun or ring for a function."""

    module: Length = Field(description="module")
    input: Teeth | None = Field(None, description="path: teeth z1 of the gear on the input link")
    output: Teeth | None = Field(None, description="path: teeth z4 of the gear on the output link")
    idler: Teeth | None = Field(None, description="path: teeth of an idler between them; then both turn the same way")
    mesh: Literal["external", "internal"] = Field(
        "external", description="path, without an idler: internal where the larger gear is a ring"
    )
    planet: Teeth | None = Field(None, description="function: teeth z2 of the gear fixed to the coupler at B")
    sun: Teeth | None = Field(None, description="function: teeth z5 of the gear fixed to the frame at A")
    ring: Teeth | None = Field(None, description="function: teeth z5 of a fixed ring gear about A, instead of sun")
    rim: Length | None = Field(
        None, description="outer radius of the ring gear; default: 2 modules outside its root circle"
    )
    pressure_angle: PressureAngle = Field(20.0, description="pressure angle of the reference profile")
    idler_side: Literal[1, -1] = Field(
        1, description="path, with an idler: +1: its axis O left of A->E; -1: right of it"
    )

    @property
    def ring_teeth(self) -> int | None:
        """Teeth of the ring gear of either form, where there is one."""
        return max(self.input or 0, self.output or 0) if self.mesh == "internal" else self.ring

    def gear_names(self) -> tuple[str, ...]:
        """Input, idler and output of a path; planet and sun or ring of a function."""
        if self.planet is not None:
            return "planet", "sun" if self.ring is None else "ring"
        return ("input", "output") if self.idler is None else ("input", "idler", "output")

    def rings(self) -> tuple[bool, ...]:
        """Of a path in direct internal mesh the larger gear, of a function the second."""
        if self.mesh == "internal" and self.idler is None and self.planet is None:
            first = (self.input or 0) > (self.output or 0)
            return first, not first
        return tuple(name == "ring" for name in self.gear_names())

    @model_validator(mode="after")
    def _rim(self) -> Self:
        require_rim(self.rim, self.ring_teeth, self.module, own_teeth=self.own_teeth)
        return self


class FiveLinks(Spec):
    """The links; with `target` they are a start."""

    input: Length | None = Field(None, description="AB; function: default the centre distance of planet and sun")
    coupler: Length = Field(description="BC")
    follower: Length = Field(description="CD")
    output: Length = Field(description="DE")
    frame: Length | None = Field(None, description="AE; path with gears in direct mesh: default their centre distance")


class FiveBarShafts(Spec):
    """Shafts of the frame that pass through the plane of the gears; a shaft without an entry may end before it."""

    A_radius: Length | None = Field(None, description="radius of the input shaft at A")
    E_radius: Length | None = Field(None, description="radius of the output shaft at E")
    O_radius: Length | None = Field(None, description="path, with an idler: radius of the idler's shaft O")


class CouplerPoint(Spec):
    """A point on the coupler."""

    along: SignedLength = Field(description="from B towards C")
    across: SignedLength = Field(0.0, description="to the left of B->C")


class WantedFunction(Spec):
    """A function over an interval: the input's swing stands for x, the output's for y."""

    name: Literal["log", "exp", "power", "sine", "cosine", "tangent"] = Field(description="y of x")
    exponent: SignedLength | None = Field(None, description="of a power", json_schema_extra={"unit": "1"})
    x: Annotated[list[Plain], Field(min_length=2, max_length=2), Entries("[start, end]")] = Field(
        description="x at the start and the end of the swing; of sine, cosine and tangent in deg"
    )
    input_swing: Annotated[float, unit("deg", gt=0, le=360)] = Field(
        description="turn of the input from the first x to the last"
    )
    output_swing: Annotated[float, unit("deg", ge=-360, le=360)] = Field(
        description="turn of the output from the first y to the last, negative clockwise"
    )
    tolerance: Annotated[float, unit("deg", gt=0)] | None = Field(
        None, description="maximum structural error that is accepted"
    )
    links: Literal["sought", "given"] = Field(
        "sought", description="given: the links of the file are evaluated, from range.start on"
    )

    @model_validator(mode="after")
    def _whole(self) -> Self:
        require_function(self.name, self.exponent, self.x, self.output_swing)
        return self


_EXACT_POSES = {"fixed": 3, "free": 5}


class FiveBarTarget(Spec):
    """The links are found for it."""

    points: (
        Annotated[
            list[Annotated[list[SignedLength], Field(min_length=2, max_length=2), Entries("[x, y]")]],
            Field(min_length=3, max_length=200),
        ]
        | None
    ) = Field(None, description="of a path: points [x, y] through which the coupler point must pass, in any order")
    positions: (
        Annotated[
            list[Annotated[list[TurnAngle], Field(min_length=2, max_length=2), Entries("[input, output]")]],
            Field(min_length=2, max_length=5),
        ]
        | None
    ) = Field(None, description="of a function: two to five pairs [input angle, output angle]")
    function: WantedFunction | None = Field(None, description="a function over an interval, instead of positions")
    input_angles: Annotated[list[TurnAngle], Field(min_length=3, max_length=200)] | None = Field(
        None, description="of a path: input angle of each point, counted from the first's, so that the points are timed"
    )
    poses: (
        Annotated[
            list[
                Annotated[
                    list[SignedLength],
                    Field(min_length=3, max_length=3),
                    Entries("[x, y, angle]", units=("", "", "deg")),
                ]
            ],
            Field(min_length=2, max_length=12),
        ]
        | None
    ) = Field(None, description="of a path: poses [x, y, angle] through which a body on the coupler must pass")
    frame: Literal["fixed", "free"] = Field("fixed", description="of poses: A and E as in the file, or anywhere")
    keep: list[Literal["links.input", "links.follower", "links.output", "phase"]] = Field(
        [], description="of poses: keys of the file that stay as they are"
    )
    angle_tolerance: Annotated[float, unit("deg", gt=0, le=180)] | None = Field(
        None, description="of poses: maximum angular deviation of the body from a pose"
    )
    tolerance: Length | None = Field(None, description="path: maximum distance of a point that is accepted")
    budget: Annotated[float, unit("s", gt=0, le=3600)] | None = Field(
        None, description="time limit of the search for a function or for timed points; default: a fixed effort"
    )

    @model_validator(mode="after")
    def _one_target(self) -> Self:
        given = [name for name in ("poses", "points", "positions", "function") if getattr(self, name) is not None]
        if len(given) > 1:
            message = f"{given[0]} and {given[1]} exclude each other\nomit {given[0]} or {given[1]}"
            raise refused(message, given[1])
        if self.poses is not None and self.tolerance is None and len(self.poses) > (exact := _EXACT_POSES[self.frame]):
            message = f"with a {self.frame} frame at most {exact} poses are met exactly"
            raise refused(f"{message}\ngive tolerance for {len(self.poses)}", "poses")
        timed = self.input_angles is not None
        if timed and len(self.points or ()) != len(self.input_angles or ()):
            counts = f"{len(self.input_angles or ())} for {len(self.points or ())}"
            raise refused(f"give an input angle for each point: {counts}", "input_angles")
        if self.input_angles is not None and self.input_angles[0] != 0.0:
            raise refused("input angles count from the first point's, 0", "input_angles[0]", "GL108")
        if self.budget is not None and not timed and (self.function is None or self.function.links == "given"):
            message = "budget applies only to a function whose links are found, or to timed points\nomit it"
            raise refused(message, "budget")
        return self


class GearedFiveBarSpec(DrivenSpec):
    """Two couplers between two links that gears hold in ratio."""

    kind: Literal["geared-five-bar"]
    form: Literal["path", "function"] = Field("path", description="path of a coupler point, or output over input angle")
    gears: FiveBarGears
    links: FiveLinks
    phase: Angle = Field(
        description="at input angle 0: direction of the output link (path) or of the coupler (function)"
    )
    coupler_point: CouplerPoint | None = Field(None, description="path: the point M")
    range: InputRange | None = Field(None, description="function: default one revolution of the input")
    assembly: Assembly = Field(1, description="path, +1: C left of B->D; function, +1: D left of C->E")
    target: FiveBarTarget | None = None
    limits: LinkageLimits = LinkageLimits.model_construct()
    shafts: FiveBarShafts | None = None
    loads: Annotated[Any, Deferred("machines.five_bar.loads_spec:FiveBarLoads")] | None = Field(
        None, description="masses, forces and drive, for the command loads"
    )

    @model_validator(mode="after")
    def _form(self) -> Self:
        for key, needed in _NEEDED[self.form].items():
            section, _, name = key.partition(".")
            value = getattr(self, section)
            if (getattr(value, name) if name else value) is None:
                raise refused(f"the form {self.form} needs {needed}", key, "GL106")  # fmt: skip
        _refuse(self.gears.idler is None and self.shafts is not None and self.shafts.O_radius is not None,
                "shafts.O_radius", "O_radius applies only with an idler\ngive gears.idler, or omit it")  # fmt: skip
        if self.form == "path":
            self._path()
        else:
            self._function()
        return self

    def _path(self) -> None:
        gears, links = self.gears, self.links
        _refuse(self.target is not None and self.target.positions is not None, "target.positions",
                "positions apply only to form: function\ngive points")  # fmt: skip
        _refuse(self.target is not None and self.target.function is not None, "target.function",
                "a function applies only to form: function\ngive points")  # fmt: skip
        _refuse(self.range is not None, "range", "range applies only to form: function; a path covers its whole period")
        _refuse(any(z is not None for z in (gears.planet, gears.sun, gears.ring)), "gears",
                "planet, sun and ring apply only to form: function\ngive input and output")  # fmt: skip
        _refuse(gears.mesh == "internal" and gears.idler is not None, "gears.mesh",
                "an idler meshes outside both gears\nomit mesh or idler")  # fmt: skip
        _refuse(gears.mesh == "internal" and gears.input == gears.output, "gears.output",
                "a ring gear needs more teeth than the gear in it\nchange input or output")  # fmt: skip
        _refuse(gears.idler is not None and links.frame is None, "links.frame",
                "with an idler the gears do not fix the frame\ngive links.frame")  # fmt: skip

    def _function(self) -> None:
        gears = self.gears
        _refuse(self.target is not None and self.target.poses is not None, "target.poses",
                "poses apply only to form: path\ngive positions")  # fmt: skip
        _refuse(self.target is not None and self.target.points is not None, "target.points",
                "points apply only to form: path\ngive positions")  # fmt: skip
        sought = self.target is not None and self.target.function is not None
        judged = sought and self.target is not None and self.target.function.links == "given"  # type: ignore[union-attr]
        _refuse(sought and not judged and self.range is not None, "range",
                "the start of the interval of a function is found\nomit range")  # fmt: skip
        _refuse(judged and self.range is None, "range",
                "given links are evaluated from range.start on\ngive range: {start, end}")  # fmt: skip
        _refuse(any(z is not None for z in (gears.input, gears.output, gears.idler)), "gears",
                "input, output and idler apply only to form: path\ngive planet and sun or ring")  # fmt: skip
        _refuse((gears.sun is None) == (gears.ring is None), "gears.sun", "give either sun or ring")
        _refuse(gears.ring is not None and gears.planet is not None and gears.ring <= gears.planet, "gears.ring",
                "a ring gear needs more teeth than the gear in it\nchange ring or planet")  # fmt: skip
        _refuse(self.range is not None and self.range.end <= self.range.start, "range.end",
                "the range ends before it starts\ngive a greater end")  # fmt: skip


_NEEDED = {
    "path": {
        "gears.input": "gears.input and gears.output",
        "gears.output": "gears.input and gears.output",
        "links.input": "links.input",
        "coupler_point": "coupler_point: {along: mm, across: mm}",
    },
    "function": {"gears.planet": "gears.planet and gears.sun or gears.ring", "links.frame": "links.frame"},
}


def _refuse(wrong: bool, key: str, message: str) -> None:
    if wrong:
        raise refused(message, key)
