"""How a disc cam is made: cutter path, radii, what errors of the profile do; and the table of a drive instead."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import Table
from gearlink.core.base.results import cached_property
from gearlink.core.numerics.arrays import Points, Reals, turn_degrees
from gearlink.core.numerics.extremes import maximum_over
from gearlink.core.parts.cams import profile
from gearlink.core.parts.cams.disc_cam import SAMPLES
from gearlink.core.parts.cams.servo import greatest_error, rows_for, servo_table

if TYPE_CHECKING:
    from gearlink.core.machines.disc_cam.cams import FollowerCams
    from gearlink.core.machines.disc_cam.spec import DiscCamSpec

_TURN = 2.0 * math.pi
_CLOSE = 4097
_HALVINGS = 60


class Making:
    """Cutter, radii, errors and servo table of a design file."""

    def __init__(self, spec: DiscCamSpec, cams: FollowerCams) -> None:
        self.spec, self.cams = spec, cams
        self.follower: Any = spec.follower

    def points(self, phi: Reals) -> Points:
        """Points of the profile [mm], in the cam's frame."""
        return self.cams.flat.points(phi)[0] if self.spec.is_flat else self.cams.main.points(phi)[1]

    def wall_table(self, samples: int | None) -> Table:
        """The outer wall of a groove over the cam angle."""
        degrees = turn_degrees(samples)
        points = self.cams.outer_wall.points(np.radians(degrees))[1]
        return Table.of("outer_wall", _xy(degrees, points))

    def cutter_points(self, phi: Reals) -> Points:
        """Centre of the cutter [mm], in the cam's frame: C + r_c n, n outward."""
        radius = self.spec.cam.cutter_radius
        assert radius is not None, "needed with a cutter alone"
        if self.spec.is_flat:
            point, normal = self.cams.flat.points(phi)
            return point + radius * normal
        main = self.cams.main
        reach = main.roller_radius - radius
        return profile.profile_points(phi, main.path(phi, 1), sense=main.sense, roller_radius=reach)

    def cutter_table(self, samples: int | None) -> Table:
        """The cutter's centre over the cam angle."""
        degrees = turn_degrees(samples)
        points = self.cutter_points(np.radians(degrees))
        return Table.of("cutter", _xy(degrees, points))

    def radius_table(self, samples: int | None) -> Table:
        """Radius of the profile over its polar angle.

        Raises
            NoSolution - where the profile is not star-shaped
        """
        degrees = turn_degrees(samples)
        sense = self.spec.cam.sense
        near = np.linspace(0.0, _TURN, _CLOSE)
        back = -sense * np.unwrap(np.angle(self.points(near)))
        if not np.all(np.diff(back) > 0.0):
            message = "a ray from the cam axis meets the profile more than once: it has no radius over the polar angle"
            raise NoSolution(message, key="cam")
        wanted = back[0] + np.mod(-sense * np.radians(degrees) - back[0], _TURN)
        after = np.clip(np.searchsorted(back, wanted, side="right"), 1, _CLOSE - 1)
        low, high = near[after - 1], near[after]
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            ahead = np.angle(self.points(middle) * np.exp(1j * sense * wanted)) * -sense > 0.0
            low, high = np.where(ahead, low, middle), np.where(ahead, middle, high)
        phi = np.where(0.5 * (low + high) > _TURN - 1e-13, 0.0, 0.5 * (low + high))
        columns = {
            "polar_angle": (degrees, "deg"),
            "radius": (np.abs(self.points(phi)), "mm"),
            "cam_angle": (np.degrees(phi), "deg"),
        }
        return Table.of("radius", columns)

    # Errors

    def _per_normal(self, phi: Reals) -> Reals:
        """Lift by a displacement of the profile along its normal: 1/cos alpha, 1/(l cos alpha), 1, 1/t [1, 1/mm]."""
        cams = self.cams
        if self.spec.is_flat:
            return 1.0 / cams.flat.touch(phi).place if self.spec.oscillates else np.ones_like(phi)
        lever = self.follower.arm if self.spec.oscillates else 1.0
        return np.asarray(1.0 / (lever * np.cos(cams.main.pressure_angle(phi))))

    def parts(self, phi: Reals) -> dict[str, Reals]:
        """Errors of the lift by their sources [mm, or rad]."""
        given = self.spec.errors
        assert given is not None, "needed with errors alone"
        share = np.abs(self._per_normal(phi))
        roller = 0.0 if self.spec.is_flat else given.roller_radius
        return {
            "profile": given.profile * share,
            "run_out": 0.5 * given.run_out * share,
            "key": np.abs(self.cams.motion.evaluate(phi, 1)[1]) * math.radians(given.key),
            "roller_radius": roller * share,
        }

    def _worst(self, phi: Reals) -> Reals:
        return np.asarray(sum(self.parts(phi).values()))

    def _rss(self, phi: Reals) -> Reals:
        return np.asarray(np.sqrt(sum(part**2 for part in self.parts(phi).values())))

    @cached_property
    def lift_error_worst(self) -> float | None:
        """Maximum sum of the errors [mm, or rad]; None without errors."""
        return None if self.spec.errors is None else self._most(self._worst)

    @cached_property
    def lift_error_rss(self) -> float | None:
        """Maximum root of the sum of their squares [mm, or rad]."""
        return None if self.spec.errors is None else self._most(self._rss)

    @cached_property
    def acceleration_error(self) -> float | None:
        """Maximum acceleration that waves of the profile make, n^2 Omega^2 delta/cos alpha [mm/s^2, or rad/s^2]."""
        given = self.spec.errors
        if given is None or given.waves is None or self.spec.speed is None:
            return None
        speed = self.spec.speed * math.pi / 30.0
        return (given.waves * speed) ** 2 * given.profile * self._most(lambda phi: np.abs(self._per_normal(phi)))

    def _most(self, course: Callable[[Reals], Reals]) -> float:
        return maximum_over(course, joints=self.cams.motion.joints, samples=SAMPLES).value

    def errors_table(self, samples: int | None) -> Table:
        """Errors of the lift over the cam angle."""
        degrees = turn_degrees(samples)
        phi = np.radians(degrees)
        found = {**self.parts(phi), "worst": self._worst(phi), "rss": self._rss(phi)}
        rocks = self.spec.oscillates
        columns = {name: (np.degrees(v), "deg") if rocks else (v, "mm") for name, v in found.items()}
        return Table.of("errors", {"cam_angle": (degrees, "deg"), **columns})

    # The table of a drive

    @cached_property
    def servo_rows(self) -> int | None:
        """Rows of the table, both ends; None without the section."""
        servo = self.spec.servo
        if servo is None:
            return None
        if servo.rows is not None:
            return servo.rows
        assert servo.tolerance is not None, "one of both stands in the file"
        tolerance = math.radians(servo.tolerance) if self.spec.oscillates else servo.tolerance
        return rows_for(self.cams.motion, tolerance)

    @cached_property
    def servo_error(self) -> float | None:
        """Maximum error of the position between the rows [mm, or rad]."""
        rows = self.servo_rows
        return None if rows is None else greatest_error(self.cams.motion, rows)

    def servo_table(self) -> Table:
        """Positions and derivatives per degree at equal steps of the cam angle."""
        rows = self.servo_rows
        assert rows is not None, "needed with the section alone"
        return servo_table(self.cams.motion, rows, rocks=self.spec.oscillates)


def _xy(degrees: Reals, points: Points) -> dict[str, tuple[Reals, str]]:
    return {"cam_angle": (degrees, "deg"), "x": (points.real, "mm"), "y": (points.imag, "mm")}
