"""The design file of a geared six-bar: a loop A B C D E F of six links, and the two trains on it."""

from itertools import pairwise
from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator

from gearlink.core.base.spec import Angle, Assembly, Deferred, DrivenSpec, Length, PressureAngle, Spec, refused
from gearlink.core.parts.linkages.spec_parts import LinkageLimits, require_rim
from gearlink.core.parts.linkages.spec_sections import InputRange

PINS = "ABCDEF"
LINKS = ("frame", "input", "coupler_1", "coupler_2", "coupler_3", "output")
HOLDING = ("frame", *LINKS[1:5], "frame")
"""By pin, the link that it is held in: what else turns on the pin runs against this one."""
Pin = Literal["A", "B", "C", "D", "E", "F"]
TeethOrRing = Annotated[int, Field(ge=-10_000, le=10_000, json_schema_extra={"unit": "teeth", "not": {"const": 0}})]


class SixLinks(Spec):
    """The links; one that carries a mesh is its centre distance: optional."""

    input: Length | None = Field(None, description="input link AB")
    coupler_1: Length | None = Field(None, description="coupler BC")
    coupler_2: Length | None = Field(None, description="coupler CD")
    coupler_3: Length | None = Field(None, description="coupler DE")
    output: Length | None = Field(None, description="output link EF")
    frame: Length | None = Field(None, description="frame AF")


class SixTrain(Spec):
    """Gears on pins that follow each other, the first fixed to the link before them, the last to the link after."""

    pins: Annotated[list[Pin], Field(min_length=2, max_length=5)] = Field(
        description="pins on which the gears sit, neighbours of the loop A B C D E F A, in its order"
    )
    module: Length = Field(description="module")
    gears: Annotated[list[TeethOrRing], Field(min_length=2, max_length=5)] = Field(
        description="teeth of the gears on these pins, negative for a ring"
    )
    pressure_angle: PressureAngle = Field(20.0, description="pressure angle of the reference profile")
    rim: Length | None = Field(
        None, description="outer radius of the ring gear; default: 2 modules outside its root circle"
    )

    @property
    def first_pin(self) -> int:
        """Number of the first pin, 0 for A."""
        return PINS.index(self.pins[0])

    @model_validator(mode="after")
    def _whole(self) -> Self:
        if any((PINS.index(b) - PINS.index(a)) % 6 != 1 for a, b in pairwise(self.pins)):
            raise refused(
                "a train's pins follow each other in the order A B C D E F A\nwrite them so, as [F, A]", "pins"
            )
        if len(self.gears) != len(self.pins):
            raise refused(f"give the teeth of a gear on each pin: {len(self.gears)} for {len(self.pins)} pins", "gears")
        if 0 in self.gears:
            raise refused(
                "a gear has 1 tooth or more, a ring -1 or less\nwrite its teeth", f"gears[{self.gears.index(0)}]"
            )
        for k, (one, other) in enumerate(pairwise(self.gears)):
            if one < 0 and other < 0:
                raise refused("two rings cannot mesh\nmake one of them an external gear", f"gears[{k + 1}]")
            if one + other >= 0 and min(one, other) < 0:
                raise refused("a ring gear needs more teeth than the gear in it\nchange one of the two", f"gears[{k}]")
        if sum(z < 0 for z in self.gears) > 1:
            raise refused("a train has at most one ring gear\nmake the other gears external", "gears")
        require_rim(self.rim, -min(self.gears) if min(self.gears) < 0 else None, self.module)
        return self


class SixStart(Spec):
    """How the linkage is put together at input angle 0, where AB points to F: the directions of two of its links."""

    coupler_1: Angle | None = Field(None, description="direction B->C")
    coupler_2: Angle | None = Field(None, description="direction C->D")
    coupler_3: Angle | None = Field(None, description="direction D->E")
    output: Angle | None = Field(None, description="direction F->E")

    @model_validator(mode="after")
    def _two(self) -> Self:
        if len(self.given) != 2:
            raise refused(
                "give the directions of two of coupler_1, coupler_2, coupler_3 and output; the loop closes the others",
                next(iter(self.given), "coupler_1"),
            )
        return self

    @property
    def given(self) -> dict[str, float]:
        """The directions of the file [deg]."""
        return {name: value for name in LINKS[2:] if (value := getattr(self, name)) is not None}


class SixShafts(Spec):
    """Shafts of the frame that pass through the planes of the gears; a shaft without an entry may end before them."""

    A_radius: Length | None = Field(None, description="radius of the input shaft at A")
    F_radius: Length | None = Field(None, description="radius of the output shaft at F")


class GearedSixBarSpec(DrivenSpec):
    """A loop of six links, which has three degrees of freedom, and two gear trains that take away two of them."""

    kind: Literal["geared-six-bar"]
    links: SixLinks
    trains: Annotated[list[SixTrain], Field(min_length=2, max_length=2)] = Field(
        description="the two gear trains; each couples the links before, under and after it"
    )
    start: SixStart
    assembly: Assembly = Field(
        1,
        description=(
            "+1: of the two links that start omits, both directed from A to F (the output E->F, opposite to its "
            "direction in start), the first points to the left of the second; -1: to the right"
        ),
    )
    range: InputRange | None = Field(
        None,
        description=(
            "range of the input if it oscillates; default: it turns until all links are back in their starting "
            "positions"
        ),
    )
    limits: LinkageLimits = LinkageLimits.model_construct()
    shafts: SixShafts | None = None
    loads: Annotated[Any, Deferred("machines.six_bar.loads_spec:SixBarLoads")] | None = Field(
        None, description="masses, forces and drive, for the command loads"
    )

    @model_validator(mode="after")
    def _swing(self) -> Self:
        if self.range is not None and self.range.end <= self.range.start:
            raise refused("the range ends before it starts\ngive a greater end", "range.end")
        return self


def gear_bodies(train: SixTrain, number: int) -> list[str]:
    """What each gear of a train is fixed to, or its own name where it turns freely; trains count from 1."""
    free = [f"gear_{number}{pin}" for pin in train.pins[1:-1]]
    return [LINKS[train.first_pin], *free, LINKS[(train.first_pin + len(train.pins)) % 6]]
