"""The output of a drive over the angle of its input, by segments with laws or through points: it turns on, stands, and
turns back as the file says.
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING, Annotated

from pydantic import AfterValidator, Field

from gearlink.core.base.errors import at_key
from gearlink.core.base.spec import Entries, Spec, refused, unit
from gearlink.core.base.wording import ascending, unlike
from gearlink.core.parts.cams.motion_spec import FEWEST_POINTS, FromFile, Segment
from gearlink.core.parts.cams.spec import SegmentLaw

if TYPE_CHECKING:
    from gearlink.core.numerics.arrays import Reals

TURN = 2.0 * math.pi
_FIT = 1e-9
OutputAngle = Annotated[float, unit("deg", ge=-36_000, le=36_000)]


OutputRow = Annotated[
    list[OutputAngle], Field(min_length=2, max_length=2), Entries("[input angle, output angle]", "[90, 20]")
]


class OutputTable(FromFile):
    """Outputs through which the quintic spline is laid that goes on with each revolution."""

    table: Annotated[list[OutputRow], Field(min_length=FEWEST_POINTS, max_length=2000)] | None = Field(
        None, description="pairs [input angle, output angle], the input ascending from 0 to 360"
    )


class OutputSegment(Spec):
    """A stretch of the input angle with one law; it begins where the one before ends."""

    to: Annotated[float, unit("deg", gt=0, le=360)] = Field(
        description="input angle at the end of the segment; of the last one 360"
    )
    output: OutputAngle | None = Field(
        None, description="output angle at the end of the segment, counted from 0 at input angle 0; default: a dwell"
    )
    law: SegmentLaw | None = Field(None, description="law of motion; default: modified-sine, or a dwell")


def _whole_turns(motion: list[OutputSegment] | OutputTable) -> list[OutputSegment] | OutputTable:
    """Refuse a motion that does not take a revolution of the input, or leaves the output between whole revolutions."""
    if isinstance(motion, OutputTable):
        ends, gained = [row[0] for row in motion.rows], motion.rows[-1][1] - motion.rows[0][1]
        first = ends[0]
    else:
        ends = [segment.to for segment in motion]
        first, gained = 0.0, next((each.output for each in reversed(motion) if each.output is not None), 0.0)
    if any(after <= before for before, after in pairwise(ends)):
        fix = "" if isinstance(motion, OutputTable) else ascending(ends, "motion[{}].to", 0.0, 360.0)
        raise refused(f"the input angles of the motion must ascend\n{fix or 'count each from input angle 0'}")
    last = len(ends) - 1
    if first != 0.0 or ends[-1] != 360.0:
        to = "motion.table[{}][0]" if isinstance(motion, OutputTable) else "motion[{}].to"
        fix = f"set {to.format(0)} to 0" if first != 0.0 else f"set {to.format(last)} to 360"
        raise refused(
            f"end of the last segment: input angle {unlike(ends[-1], 360.0)} deg (required 360 deg)\n{fix}"
            if first == 0.0
            else f"start of the table: input angle {first:g} deg (required 0 deg)\n{fix}"
        )
    whole = 360.0 * round(gained / 360.0)
    if abs(gained - whole) > _FIT:
        if isinstance(motion, OutputTable):
            to, whole = f"motion.table[{last}][1]", motion.rows[0][1] + whole
        else:
            to = f"motion[{max(i for i, each in enumerate(motion) if each.output is not None)}].output"
        raise refused(
            f"end of the output: {gained:.6g} deg (required whole revolutions, such as 0 or 360 deg)\nset {to} to "
            f"{whole:.9g}"
        )
    return motion


OutputLaw = Annotated[
    Annotated[list[OutputSegment], Field(min_length=1, max_length=200)] | OutputTable, AfterValidator(_whole_turns)
]


class OutputMotion:
    """Output angle over the input angle.

    Parameters
        given : the key of the file
    """

    def __init__(self, given: list[OutputSegment] | OutputTable) -> None:
        from gearlink.core.parts.cams.follower_motion import motion_of, spline

        self.even = 0.0
        if isinstance(given, OutputTable):
            rows = [(math.radians(angle), math.radians(output)) for angle, output in given.rows]
            self.even = (rows[-1][1] - rows[0][1]) / TURN
            self._base = spline([angle for angle, _ in rows], [output - self.even * angle for angle, output in rows])
        else:
            made = Segment.model_construct
            segments = [made(to=each.to, lift=each.output, law=each.law, mirrored=False) for each in given]
            with at_key("motion"):
                self._base = motion_of(segments, unit=math.radians(1.0), whole=TURN)
        self.gained = self._base.pieces[-1].high - self._base.pieces[0].low + TURN * self.even

    @property
    def joints(self) -> tuple[float, ...]:
        """Input angles at which the law changes [rad]."""
        return self._base.joints

    @property
    def dwells(self) -> list[tuple[float, float]]:
        """Start and width of the segments in which the output stands [rad]; a spline has none."""
        strokes = () if self.even else self._base.strokes
        return [(stroke.start, stroke.end - stroke.start) for stroke in strokes if stroke.sense == 0]

    def evaluate(self, theta: Reals, order: int = 3, *, side: int = 1) -> list[Reals]:
        """Output angle and its derivatives by the input angle [rad], running on over its turns."""
        import numpy as np

        value, *rates = self._base.evaluate(theta, order, side=side)
        turns = np.floor(theta / TURN)
        value = value + self.even * np.mod(theta, TURN) + self.gained * turns
        if rates and self.even:
            rates[0] = rates[0] + self.even
        return [value, *rates]
