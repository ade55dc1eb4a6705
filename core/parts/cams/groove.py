"""A groove that a roller is held in: its profile by inversion of a prescribed motion, whatever carries the roller.

P is the path of the roller's centre in the coordinates of the body with the groove, primes by the input angle; u the
direction in which the roller would go with the input held. N = i P'/|P'|, walls P +- r_g N,

    pressure angle between N and u,   kappa = Im(conj(P') P'')/|P'|^3
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import Check, Shown, Status, Table
from gearlink.core.base.wording import short
from gearlink.core.numerics.arrays import Points, Reals, turn_degrees
from gearlink.core.numerics.extremes import Extreme, extremes_over, least_convex_radius
from gearlink.core.parts.cams.checks import ROLLER_SHARE, against_curvature, is_steep
from gearlink.core.parts.cams.codes import CAM_UNDERCUT, PRESSURE_ANGLE
from gearlink.core.parts.cams.undercut import undercut

if TYPE_CHECKING:
    from gearlink.core.numerics.together import Function

_SAMPLES = 1024
_STANDS = 1e-12
_CUT = 1e-9


class Path(NamedTuple):
    """The roller's centre at input angles: P, P', P'' and u, (N,) complex arrays [mm]; u has any length."""

    place: Points
    first: Points
    second: Points
    way: Points


@dataclass(frozen=True)
class Groove:
    """A closed groove about the axis of the input.

    Parameters
        path : function of input angles (N,) [rad] - gives the Path
        roller_radius : float [mm]
        joints : input angles [rad] at which the law changes
    Raises
        NoSolution - where the roller stands still in the groove
    """

    path: Callable[[Reals], Path]
    roller_radius: float
    joints: tuple[float, ...] = ()

    @cached_property
    def sense(self) -> float:
        """+1 where the path goes round counter-clockwise, -1 where clockwise."""
        place = self.path(np.radians(turn_degrees(720))).place
        area = float(np.sum((np.conj(place) * np.roll(place, -1)).imag))
        return 1.0 if area >= 0.0 else -1.0

    def _tangents(self, path: Path, theta: Reals) -> Points:
        speed = np.abs(path.first)
        still = speed <= _STANDS * np.max(np.abs(path.place))
        if np.any(still):
            place = math.degrees(float(theta[int(np.argmax(still))]))
            raise NoSolution(
                f"the roller is at rest in its groove at input angle {short(place)} deg", fix="change the motion"
            )
        return np.asarray(path.first / speed)

    def pressure_angle(self, theta: Reals) -> Reals:
        """Between the normal and the roller's own way, -90 to 90 deg [rad]."""
        path = self.path(theta)
        seen = np.conj(self._tangents(path, theta)) * path.way
        return np.arctan2(seen.real * np.sign(seen.imag) + 0.0 * seen.real, np.abs(seen.imag))

    def curvature(self, theta: Reals) -> Reals:
        """Curvature of the path [1/mm], convex seen from within positive."""
        path = self.path(theta)
        bend = (np.conj(path.first) * path.second).imag / np.abs(path.first) ** 3
        return np.asarray(self.sense * bend)

    def radius(self, theta: Reals) -> Reals:
        """Distance of the roller from the axis of the input [mm]."""
        return np.abs(self.path(theta).place)

    def walls(self, theta: Reals) -> tuple[Points, Points]:
        """Inner and outer wall [mm]."""
        path = self.path(theta)
        inwards = 1j * self.sense * self._tangents(path, theta) * self.roller_radius
        return np.asarray(path.place + inwards), np.asarray(path.place - inwards)

    @cached_property
    def extremes(self) -> list[Extreme]:
        """Maximum pressure angle, maximum and minimum distance of the roller from the axis."""
        wanted: list[tuple[Function, bool]] = [
            (lambda theta: np.abs(self.pressure_angle(theta)), True),
            (self.radius, True),
            (self.radius, False),
        ]
        return extremes_over(wanted, joints=self.joints, samples=_SAMPLES)

    @property
    def steepest(self) -> Extreme:
        """Maximum pressure angle [rad] and its place."""
        return self.extremes[0]

    @property
    def max_radius(self) -> float:
        """Maximum distance of the roller's centre from the axis [mm]."""
        return self.extremes[1].value

    @property
    def min_radius(self) -> float:
        """Minimum distance [mm]."""
        return self.extremes[2].value

    @cached_property
    def sharpest(self) -> Extreme:
        """Minimum convex radius of the path [mm] and its place."""
        return least_convex_radius(self.curvature, joints=self.joints, samples=_SAMPLES)

    @cached_property
    def hollow(self) -> Extreme:
        """Minimum hollow radius of the path [mm] and its place."""
        return least_convex_radius(lambda theta: -self.curvature(theta), joints=self.joints, samples=_SAMPLES)

    def table(self, samples: int | None = None) -> Table:
        """Path, walls, pressure angle and radius of curvature over the input angle."""
        degrees = turn_degrees(samples)
        theta = np.radians(degrees)
        place, (inner, outer), bend = self.path(theta).place, self.walls(theta), self.curvature(theta)
        with np.errstate(divide="ignore"):
            radius = np.where(bend == 0.0, np.inf, 1.0 / bend)
        columns = {"input_angle": (degrees, "deg")}
        for name, points in (("pitch", place), ("inner", inner), ("outer", outer)):
            columns |= {f"{name}_x": (points.real, "mm"), f"{name}_y": (points.imag, "mm")}
        columns["pressure_angle"] = np.degrees(self.pressure_angle(theta)), "deg"
        columns["curvature_radius"] = radius, "mm"
        return Table.of("main_cam", columns)

    @cached_property
    def star_shaped(self) -> tuple[bool, bool]:
        """Whether the polar angle of inner and outer wall runs one way: without a cusp none then crosses itself."""
        closed = np.radians(turn_degrees(2 * _SAMPLES))
        found = []
        for wall in self.walls(closed):
            turn = self.sense * (np.conj(wall) * np.roll(wall, -1, axis=-1)).imag
            found.append(np.all(turn > 0.0, axis=-1))
        return found[0], found[1]

    def _wall(self, side: int) -> Callable[[Reals], tuple[Points, Points]]:
        return lambda theta: (self.path(theta).place, self.walls(theta)[side])

    # Checks

    def check_pressure_angle(self, limit: float, remedy: str) -> Check:
        """GL401; the limit in degrees."""
        value, place = math.degrees(self.steepest.value), math.degrees(self.steepest.place)
        status: Status = "fail" if is_steep(value, limit) else "pass"
        what, at = "pressure angle in the groove", f"input angle {short(place)} deg"
        return PRESSURE_ANGLE.check(status, what, value, limit, "deg", at=at, fix=remedy)

    def check_undercut(self, remedy: str) -> Iterator[Check]:
        """GL402 of both walls: the roller against the minimum radius of the path, and what it cuts elsewhere."""
        for name, found, side in (("inner", self.sharpest, 0), ("outer", self.hollow, 1)):
            share = self.roller_radius / found.value
            status: Status = "fail" if share >= 1.0 else "warn" if share > ROLLER_SHARE else "pass"
            what, at = f"roller radius, {name} wall", f"input angle {short(math.degrees(found.place))} deg"
            shown = against_curvature(self.roller_radius, found.value, status)
            if status == "pass" and not self.star_shaped[side]:
                cut = undercut(self._wall(side), self.roller_radius)
                if cut.depth > _CUT * self.roller_radius:
                    status, what = "fail", f"cut of the roller into the {name} wall"
                    shown, at = (
                        Shown(cut.depth, 0.0, "mm", "<="),
                        f"input angle {short(math.degrees(cut.cam_angle))} deg",
                    )
            yield CAM_UNDERCUT.check(status, what, share, 1.0, shown=shown, at=at, fix=remedy)
