"""The motion of a cam follower over a revolution, as a key of design files."""

from itertools import pairwise
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from gearlink.core.base.spec import Entries, OfFollower, Spec, Speed, refused, unit
from gearlink.core.base.wording import ascending, unlike
from gearlink.core.parts.cams.spec import SegmentLaw

Lift = Annotated[float, unit("mm", ge=-1e6, le=1e6), OfFollower("deg")]
Row = Annotated[list[Lift], Field(min_length=2, max_length=2), Entries("[cam angle, lift]", "[50, 2]", ("deg",))]
SteepAngle = Annotated[float, unit("deg", gt=0, lt=90)]
FEWEST_POINTS = 4


class Segment(Spec):
    """A stretch of the cam angle with one law of motion; it begins where the one before ends."""

    to: Annotated[float, unit("deg", gt=0, le=360)] = Field(
        description="cam angle at the end of the segment; of the last one 360"
    )
    lift: Lift | None = Field(
        None, description="lift at the end of the segment (oscillating follower: deg); default: a dwell"
    )
    law: SegmentLaw | None = Field(None, description="law of motion; default: modified-sine, or a dwell")
    mirrored: bool = Field(False, description="run a law from rest to speed backwards: from speed to rest")
    return_: Literal["mirrored"] | None = Field(
        None, alias="return", description="mirrored: the last rise backwards over this segment"
    )
    end_velocity: Lift | None = Field(
        None, description="of a polynomial: velocity at the end of the segment, lift per rad"
    )
    end_acceleration: Lift | None = Field(
        None, description="of a polynomial: acceleration at the end of the segment, lift per rad^2"
    )

    @model_validator(mode="after")
    def _one_meaning(self) -> Self:
        if self.return_ is not None:
            for key in ("lift", "law"):
                if getattr(self, key) is not None:
                    message = "return: mirrored uses lift and law of the rise\nomit them"
                    raise refused(message, key)
        if self.law != "polynomial":
            for key in ("end_velocity", "end_acceleration"):
                if getattr(self, key) is not None:
                    raise refused("end values apply only to law: polynomial", key)
        return self


Column = Annotated[int, unit("1", ge=1, le=1000)]


class FromFile(Spec):
    """A table that may stand in a file of numbers, which is read with the design file."""

    table: list[list[float]] | None = None
    file: str | None = Field(None, description="CSV file with these columns, instead of table")
    columns: Annotated[list[Column], Field(min_length=2, max_length=2), Entries("[angle, value]", "[1, 2]")] | None = (
        Field(None, description="of a file: numbers of the two columns; default: the first two")
    )
    degrees: bool = Field(True, description="of a file: true if its angles are in deg, false if in rad")

    @property
    def rows(self) -> list[list[float]]:
        """The rows of the table."""
        assert self.table is not None, "read with the design file"
        return self.table

    @model_validator(mode="after")
    def _one(self) -> Self:
        if (self.table is None) == (self.file is None):
            message = "table and file exclude each other\nomit table or file" if self.file else "give table, or file"
            raise refused(message, "file" if self.file else "table")
        if self.table is None:
            message = "the file is read with the design file\ngive a table here"
            raise refused(message, "file")
        return self


class MotionTable(FromFile):
    """Measured or computed lifts, through which the periodic quintic spline is laid."""

    table: Annotated[list[Row], Field(min_length=FEWEST_POINTS, max_length=2000)] | None = Field(
        None, description="pairs [cam angle, lift], ascending from 0 to 360"
    )


FollowerMotion = Annotated[list[Segment], Field(min_length=1, max_length=200)] | MotionTable


class OfFollowerKeys(Spec):
    """The keys of every cam that turns evenly and moves one follower."""

    speed: Speed | None = Field(None, description="speed of the cam")
    motion: FollowerMotion = Field(
        description="lift over the revolution (mm; oscillating follower: deg): segments with laws, or a table"
    )
    initial_lift: Lift = Field(0.0, description="lift at cam angle 0")

    @model_validator(mode="after")
    def _runs(self) -> Self:
        require_closed(self.motion, self.initial_lift)
        return self

    def commands(self) -> tuple[str, ...]:
        """What the file asks for."""
        return ("cam", *(("loads",) if getattr(self, "loads", None) is not None else ()))


def require_closed(motion: list[Segment] | MotionTable, initial_lift: float) -> None:
    """Refuse a motion that does not run over one revolution and come back.

    Raises
        PydanticCustomError - at the key `motion`
    """
    if isinstance(motion, MotionTable):
        _require_table(motion.rows)
        return
    ends = [segment.to for segment in motion]
    for before, after in pairwise(ends):
        if after <= before:
            words = f"one ends at {unlike(after, before)} deg, after {unlike(before, after)} deg"
            fix = ascending(ends, "motion[{}].to", 0.0, 360.0) or "count each `to` from cam angle 0"
            raise refused(f"the segments must ascend: {words}\n{fix}", "motion")
    if ends[-1] != 360.0:
        words = f"end of the last segment: {unlike(ends[-1], 360.0)} deg (required 360 deg)"
        raise refused(f"{words}\nset motion[{len(ends) - 1}].to to 360", "motion")
    if motion[-1].return_ is None:
        strokes = [(i, each.lift) for i, each in enumerate(motion) if each.lift is not None]
        place, last = strokes[-1] if strokes else (0, initial_lift)
        if any(each.return_ for each in motion):
            return  # the lift after a mirrored rise is known with the laws
        if last != initial_lift:
            words = f"the lift ends at {unlike(last, initial_lift)} and starts at {unlike(initial_lift, last)}"
            many = len(strokes) > 1
            fix = f"set motion[{place}].lift to {initial_lift:.9g}" if many else "add a segment that returns"
            raise refused(f"{words}\n{fix}", "motion")


def _require_table(rows: list[list[float]]) -> None:
    for (before, _), (after, _) in pairwise(rows):
        if after <= before:
            words = f"{unlike(after, before)} deg follows {unlike(before, after)} deg"
            raise refused(f"the cam angles of a table must ascend: {words}\nsort its rows, each angle once", "motion")
    (start, first), (end, last) = rows[0], rows[-1]
    if start != 0.0 or end != 360.0:
        words = f"a table runs from cam angle 0 to 360 deg, not from {unlike(start, 0.0)} to {unlike(end, 360.0)} deg"
        fix = f"add the row 360, {first:.12g}" if start == 0.0 and end < 360.0 else "give it the rows 0 and 360"
        raise refused(f"{words}\n{fix}", "motion")
    if first != last:
        words = f"a table ends with the lift that it starts with: {unlike(first, last)}, not {unlike(last, first)}"
        raise refused(f"{words}\nset the lift at 360 to {first:.12g}", "motion")
