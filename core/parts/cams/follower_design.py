"""What every cam with a follower of its own has: motion, its extremes and table, steps at the joints of its laws."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

from gearlink.core.base.design import Found
from gearlink.core.base.errors import MissingSection
from gearlink.core.base.real_speed import OF_TIME
from gearlink.core.base.report import Check, Status, Table, without_noise
from gearlink.core.base.results import cached_property
from gearlink.core.numerics.motion_extremes import WithExtremes, extremes, names
from gearlink.core.parts.cams.checks import step_check
from gearlink.core.parts.cams.codes import ACCELERATION_STEP, JERK_STEP, VELOCITY_STEP
from gearlink.core.parts.cams.shaped_design import WithShapedLaws

if TYPE_CHECKING:
    from gearlink.core.parts.cams.follower_motion import FollowerMotion, Piece
    from gearlink.core.parts.cams.laws import Law
    from gearlink.core.parts.cams.shaped import Phase

_CURVES = ("lift", "velocity", "acceleration", "jerk")
_EXTREMES = ("lift_max", "lift_max_at", *names(*_CURVES[1:]))
_RATES = tuple((f"{curve}_{side}", order) for order, curve in enumerate(_CURVES[1:3], 1) for side in ("max", "min"))
FOLLOWER_QUANTITIES = (*_EXTREMES, *(f"follower_{name}" for name, _ in _RATES))


def in_time(of: Callable[[Any], float], order: int) -> Any:
    """A quantity in real time [mm/s^order or rad/s^order] from one per rad^order of the cam; None without a speed."""
    return property(lambda design: None if design.speed is None else of(design) * design.speed**order)


class OfFollower(WithExtremes, WithShapedLaws):
    """A design whose file gives the motion of a follower over the cam angle."""

    extreme_names: tuple[str, ...] = _EXTREMES
    spec: Any

    @property
    def follower_motion(self) -> FollowerMotion:
        """Lift over the cam angle [mm or rad]."""
        raise NotImplementedError

    @property
    def law_definitions(self) -> Mapping[str, Any]:
        """The laws of the segments that have one of their own."""
        motion = self.spec.motion if isinstance(self.spec.motion, list) else []
        return {f"motion[{k}].law": one.law for k, one in enumerate(motion) if one.return_ is None}

    def law_at(self, path: str, /) -> Law | None:
        """The law of a segment."""
        return next((each.law for each in self._pieces_at(path)), None)

    def law_phase(self, path: str, /) -> Phase:
        """The phase of a segment."""
        from gearlink.core.parts.cams.shaped import Drive

        return Drive.of(self.spec).phase(self._pieces_at(path)[0].width)

    def _pieces_at(self, path: str) -> list[Piece]:
        return [each for each in self.follower_motion.pieces if path == f"motion[{each.number - 1}].law"]

    def completion(self) -> Iterator[Found]:
        """The optimal laws as they were solved."""
        return self.solved_laws()

    smoother: str = "use laws that end with zero acceleration, such as cycloidal"
    """What avoids steps of the acceleration."""

    @property
    def rocks(self) -> bool:
        """Whether the follower oscillates."""
        return False

    @cached_property
    def motion_extremes(self) -> Mapping[str, float]:
        """Extremes of the lift and its derivatives."""
        motion = self.follower_motion
        curves = {
            name: (lambda phi, order=order: motion.evaluate(phi, order)[order]) for order, name in enumerate(_CURVES)
        }
        return extremes(curves, 0.0, 2.0 * math.pi, joints=motion.joints)

    @property
    def speed(self) -> float | None:
        """Speed of the cam [rad/s]."""
        return None if self.spec.speed is None else self.spec.speed * math.pi / 30.0

    follower_velocity_max: float | None = in_time(lambda design: design.motion_extremes["velocity_max"], 1)
    follower_velocity_min: float | None = in_time(lambda design: design.motion_extremes["velocity_min"], 1)
    follower_acceleration_max: float | None = in_time(lambda design: design.motion_extremes["acceleration_max"], 2)
    follower_acceleration_min: float | None = in_time(lambda design: design.motion_extremes["acceleration_min"], 2)

    def table_follower(self, samples: int | None = None) -> Table:
        """Lift and its derivatives over the cam angle, with the segment's number."""
        import numpy as np

        from gearlink.core.numerics.arrays import turn_degrees

        degrees = turn_degrees(samples)
        phi = np.radians(degrees)
        s, *rates = self.follower_motion.evaluate(phi, 3)
        columns: dict[str, tuple[Any, str]] = {"cam_angle": (degrees, "deg")}
        columns["lift"] = (np.degrees(s), "deg") if self.rocks else (s, "mm")
        columns |= dict(zip(_CURVES[1:], zip(rates, self._units, strict=True), strict=True))
        return Table.of("follower", {**columns, "segment": (self.follower_motion.numbers(phi), "1")})

    def table_segments(self, _samples: int | None = None) -> Table:
        """Each segment with its law and the extremes of its velocity and acceleration, in time as well at a speed."""
        if not isinstance(self.spec.motion, list | None):
            raise MissingSection("the table segments needs motion by segments", key="motion")
        pieces = self.follower_motion.pieces
        found = [_extremes_within(piece) for piece in pieces]
        lifts = [math.degrees(piece.high) if self.rocks else piece.high for piece in pieces]
        columns: dict[str, tuple[Any, str]] = {
            "segment": ([piece.number for piece in pieces], "1"),
            "start": ([ends_of(piece)[0] for piece in pieces], "deg"),
            "end": ([ends_of(piece)[1] for piece in pieces], "deg"),
            "law": ([piece.name for piece in pieces], "1"),
            "lift": (lifts, "deg" if self.rocks else "mm"),
        }
        columns |= {name: ([each[name] for each in found], self._units[order - 1]) for name, order in _RATES}
        if (speed := self.speed) is not None:
            for name, order in _RATES:
                values = [each[name] * speed**order for each in found]
                columns[f"follower_{name}"] = (values, ("rad" if self.rocks else "mm") + OF_TIME[order])
        return Table.of("segments", columns)

    @property
    def _units(self) -> tuple[str, str, str]:
        return ("1", "1/rad", "1/rad^2") if self.rocks else ("mm/rad", "mm/rad^2", "mm/rad^3")

    def _steps(self, order: int) -> tuple[list[tuple[str, float]], float, str]:
        peak = max(abs(self.motion_extremes[f"{_CURVES[order]}_{side}"]) for side in ("max", "min"))
        return self.follower_motion.steps(order), peak, self._units[order - 1]

    def check_velocity_step(self) -> Check:
        """GL403."""
        return step_check(
            VELOCITY_STEP, *self._steps(1), "fail", "use laws with the same velocity on both sides of the joint"
        )

    def check_acceleration_step(self) -> Check:
        """GL404."""
        return step_check(ACCELERATION_STEP, *self._steps(2), "warn", self.smoother)

    def check_jerk_step(self) -> Check:
        """GL407."""
        steps, _, unit = self._steps(3)
        place, step = max(steps, key=lambda each: abs(each[1]))
        limit = self.spec.limits.jerk_step
        status: Status = "warn" if limit is not None and abs(step) > limit else "pass"
        what, fix = "step of the lift's jerk", "use the law polynomial-4567"
        return JERK_STEP.check(status, what, abs(step), limit, unit, at=place, fix=fix)


def _extremes_within(piece: Piece) -> Mapping[str, float]:
    """Extremes of velocity and acceleration of a segment by the cam angle, both ends as its own law has them."""
    curves = {
        name: (lambda x, order=order: piece.evaluate(x, order)[order]) for order, name in enumerate(_CURVES[1:3], 1)
    }
    found = extremes(curves, 0.0, 1.0, joints=piece.joints)
    peaks = {name: max(abs(found[f"{name}_{side}"]) for side in ("max", "min")) for name in curves}
    return {name: without_noise(value, peaks.get(name.rpartition("_")[0], 0.0)) for name, value in found.items()}


def ends_of(piece: Piece) -> tuple[float, float]:
    """Cam angles at which a segment begins and ends [deg], without the rounding of their conversion to rad and back."""
    return round(math.degrees(piece.start), 12), round(math.degrees(piece.end), 12)
