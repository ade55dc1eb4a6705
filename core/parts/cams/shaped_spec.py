"""Motion laws that a design file shapes by numbers: end values, polydyne, optimal, solved."""

from itertools import pairwise
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import Field, model_validator

from gearlink.core.base.spec import Entries, Spec, only_one, refused, unit
from gearlink.core.base.wording import short, unlike

PLAIN = {"unit": "1"}
Number = Annotated[float, Field(ge=-1e6, le=1e6, json_schema_extra=PLAIN)]
Bound = Annotated[float, Field(gt=0, le=1e9, json_schema_extra=PLAIN)]
Hertz = Annotated[float, unit("Hz", gt=0, le=1e7)]
Periods = Annotated[float, Field(gt=0, le=100, json_schema_extra=PLAIN)]
Damping = Annotated[float, Field(ge=0, lt=1, json_schema_extra=PLAIN)]
Rate = Annotated[float, Field(gt=0, le=1e7, json_schema_extra=PLAIN)]
Coefficients = Annotated[
    list[Number], Field(min_length=3, max_length=4), Entries("[s, v, a] or [s, v, a, j]", "[1, 0.8, 0]")
]


class EndInFile(Spec):
    """What a law has at an end, by the lift's unit and rad of the cam angle."""

    speed: Number = Field(0.0, description="velocity of the lift there, lift per rad of the cam angle")
    acceleration: Number = Field(0.0, description="acceleration of the lift there, lift per rad^2")


End = Coefficients | Literal["join"] | EndInFile


class _WithEnds(Spec):
    type: Literal["polynomial", "harmonic"] = Field(description="type of the law")
    start: End = Field(
        [0.0, 0.0, 0.0], description="s, v, a (, j) at x = 0; in a cam also join, or speed and acceleration"
    )
    end: End = Field([1.0, 0.0, 0.0], description="the same at x = 1")

    @property
    def joins(self) -> bool:
        """Whether an end is taken from the neighbour, or given in the file's units."""
        return not (isinstance(self.start, list) and isinstance(self.end, list))


class PolynomialEnds(_WithEnds):
    """The polynomial of minimum degree with given end values: quintic, with the jerk septic."""

    type: Literal["polynomial"] = Field(description="type of the law")

    @model_validator(mode="after")
    def _alike(self) -> Self:
        start, end = self.start, self.end
        if isinstance(start, list) and isinstance(end, list) and len(start) != len(end):
            raise refused("start and end need the same number of values: 3, or 4 with the jerk", "end")
        return self


class HarmonicEnds(_WithEnds):
    """Sum of 1, x, cos pi x, sin pi x, cos 2 pi x, sin 2 pi x with given end values."""

    type: Literal["harmonic"] = Field(description="type of the law")

    @model_validator(mode="after")
    def _three(self) -> Self:
        for key in ("start", "end"):
            if isinstance(value := getattr(self, key), list) and len(value) != 3:
                raise refused("a harmonic law has s, v and a at its ends: three values", key)
        return self


class Polydyne(Spec):
    """A law that leaves no vibration at its design speed."""

    type: Literal["polydyne"] = Field(description="type of the law")
    periods: Periods | None = Field(None, description="natural periods per phase, at least 0.5")
    frequency: Hertz | None = Field(None, description="natural frequency, instead of periods; default: that of loads")
    damping: Damping = Field(0.0, description="damping ratio")
    speed: Rate | None = Field(None, description="speed for which the law is computed; default: the design's")

    @model_validator(mode="after")
    def _one(self) -> Self:
        if self.periods is not None and self.frequency is not None:
            raise refused("periods and frequency specify the same\nomit periods or frequency", "frequency")
        if self.periods is not None and self.speed is not None:
            raise refused("speed applies only with frequency; periods need no speed", "speed")
        return self


class LawLimits(Spec):
    """Limits of a law in the units of the file, at the design's speed: mm (deg of what turns) and s."""

    velocity: Bound | None = Field(None, description="maximum velocity")
    acceleration: Bound | None = Field(None, description="maximum acceleration")
    jerk: Bound | None = Field(None, description="maximum jerk")


class OptimalLaw(Spec):
    """The polynomial law that minimizes something and keeps limits."""

    type: Literal["optimal"] = Field(description="type of the law")
    minimize: Literal["acceleration", "velocity", "jerk", "residual", "torque"] = Field(description="what is minimized")
    degree: Annotated[int, Field(ge=9, le=31, json_schema_extra=PLAIN)] = Field(
        15, description="degree of the acceleration"
    )
    symmetric: bool = Field(True, description="the second half mirrors the first")
    velocity: Bound | None = Field(None, description="maximum |ds/dx|, rise 1 over x from 0 to 1")
    acceleration: Bound | None = Field(None, description="maximum second derivative by x; bernstein: its coefficients")
    jerk: Bound | None = Field(None, description="maximum third derivative by x")
    limit: LawLimits | None = Field(None, description="the same limit in the units of the file, at the design's speed")
    band: Annotated[list[Bound], Field(min_length=2, max_length=2), Entries("[from, to]", "[8000, 12000]")] | None = (
        Field(
            None, description="band of minimum residual vibration: speeds (design's unit) or natural periods per phase"
        )
    )
    unit: Literal["periods"] | None = Field(None, description="periods: the band is in natural periods per phase")
    frequency: Hertz | None = Field(None, description="natural frequency; default: loads.vibration")
    damping: Damping | None = Field(None, description="damping ratio; default: loads.vibration, else 0")

    KEYS: ClassVar[tuple[str, ...]] = ("velocity", "acceleration", "jerk")

    @model_validator(mode="after")
    def _meaning(self) -> Self:
        if (self.band is None) != (self.minimize != "residual"):
            raise refused("band is required with minimize: residual, and only with it", "band")
        if self.band is not None and self.band[0] >= self.band[1]:
            raise refused(f"the band runs from {self.band[0]:g} to {self.band[1]:g}\nlet it ascend", "band")
        if self.minimize in self.KEYS and getattr(self, self.minimize) is not None:
            raise refused(f"{self.minimize} is minimized and cannot have a limit\nomit it", self.minimize)
        for key in self.KEYS if self.limit is not None else ():
            if getattr(self.limit, key) is not None and (getattr(self, key) is not None or key == self.minimize):
                raise refused(f"{key} already has another limit, or is minimized\nomit this one", f"limit.{key}")
        places = [at for at in (self, self.limit) if at is not None]
        bounded = any(getattr(at, key) is not None for at in places for key in ("acceleration", "jerk"))
        if self.minimize == "residual" and not bounded:
            raise refused("minimize: residual needs a limit\nadd acceleration or jerk", "acceleration")
        return self


class BernsteinLaw(Spec):
    """A solved law by its acceleration."""

    type: Literal["bernstein"] = Field(description="type of the law")
    acceleration: Annotated[
        list[Annotated[float, Field(ge=-1e12, le=1e12, json_schema_extra=PLAIN)]],
        Field(min_length=2, max_length=64),
        Entries("[c0, c1, ...]", "[0, 12, -12, 0]"),
    ] = Field(description="coefficients of the second derivative by x, of Bernstein polynomials")


TablePoint = Annotated[list[Number], Field(min_length=2, max_length=2), Entries("[x, s]")]
FEWEST_POINTS = 6


class TableLaw(Spec):
    """A law through the points of a table: the quintic spline that begins at rest and ends at rest or at speed."""

    type: Literal["table"] = Field(description="type of the law")
    points: Annotated[list[TablePoint], Field(max_length=2000)] | None = Field(
        None,
        description="[x, s] from [0, 0] to [1, 1], 6 at least; from rest to speed s over end speed and phase, its last "
        "free",
    )
    file: str | None = Field(None, description="CSV file with these columns, instead of points")

    @model_validator(mode="after")
    def _ascends(self) -> Self:
        only_one(self, "points", "file")
        if self.points is None:
            raise refused("a table law needs points, or file", "points")
        if len(self.points) < FEWEST_POINTS:
            raise refused(f"points of a table law: {len(self.points)} (at least {FEWEST_POINTS})", "points")
        x = [place for place, _ in self.points]
        if x[0] != 0.0 or x[-1] != 1.0:
            message = f"x of a table law runs from 0 to 1, not from {unlike(x[0], 0.0)} to {unlike(x[-1], 1.0)}"
            raise refused(message, "points")
        for k, (before, after) in enumerate(pairwise(x), 1):
            if after <= before:
                message = f"x of a table law ascends: {unlike(after, before)} follows {unlike(before, after)}"
                raise refused(message, f"points[{k}]")
        if self.points[0][1] != 0.0:
            raise refused(f"the first s of a table law is 0, not {short(self.points[0][1])}", "points[0]")
        return self


MODELS: dict[str, type[Spec]] = {
    "polynomial": PolynomialEnds,
    "harmonic": HarmonicEnds,
    "polydyne": Polydyne,
    "optimal": OptimalLaw,
    "bernstein": BernsteinLaw,
    "table": TableLaw,
}


def shaped(definition: Any) -> Any:
    """The model of a mapping; anything else as it is.

    Raises
        ValidationError - with the places within the mapping
    """
    kind = definition.get("type") if isinstance(definition, dict) else None
    model = MODELS.get(kind) if isinstance(kind, str) else None
    return definition if model is None else model.model_validate(definition)
