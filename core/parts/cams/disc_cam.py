"""A closed disc cam with a roller: its extremes, refined between the joints of its law, and its undercut."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from gearlink.core.base.errors import at_key
from gearlink.core.base.report import Table
from gearlink.core.base.results import cached_property, keep
from gearlink.core.numerics.arrays import Points, Reals, turn_degrees
from gearlink.core.numerics.extremes import Extreme, convex_radius, extremes_over, larger, maximum_over, minimum_over
from gearlink.core.numerics.together import Function, kept_last
from gearlink.core.parts.cams import profile
from gearlink.core.parts.cams.profile import CamProfile, RollerPath
from gearlink.core.parts.cams.undercut import Undercut, undercut

_TURN = 2.0 * math.pi
SAMPLES = 512
_BESIDE = 1e-7
"""Of a joint [rad]: there a profile goes on by more than rounding, and a corner that no roller feels goes unseen."""
AT_CORNER, _TURNS = 1e-9, 1e-6
_NEAR_CORNER = 257
"""So near to a joint [rad] a curve that has no corner there turns by less [rad]."""
_WITH_PLACE = ("max_pressure_angle", "most_convex")
FOUND_TOGETHER = (*_WITH_PLACE, "max_radius", "min_radius", "least_support")


def seek_together(cams: Sequence[DiscCam], names: Sequence[str] = FOUND_TOGETHER) -> None:
    """Seek pressure angle, curvature and radii of cams of one motion in common rounds; the cams keep what is found.

    Notes
        The values are those of each search alone: only the motion is computed once a round.
    """
    functions: list[tuple[Function, bool]] = []
    for cam in cams:
        near = replace(cam, path=_kept(cam.path))
        functions += [near.sought[name] for name in names]
    found = iter(extremes_over(functions, joints=cams[0].bounds, samples=SAMPLES))
    for cam in cams:
        extremes = [(name, next(found)) for name in names]
        keep(cam, **{name: found if name in _WITH_PLACE else found.value for name, found in extremes})


def largest_pressure_angles(cams: Sequence[DiscCam], start: float, end: float, samples: int = 128) -> list[Extreme]:
    """Pressure angle of largest magnitude of each cam between two cam angles [rad], its sign kept."""
    near = [replace(cam, path=_kept(cam.path, 1)) for cam in cams]
    wanted = [(cam.pressure_angle, greatest) for cam in near for greatest in (True, False)]
    found = iter(extremes_over(wanted, start, end, samples=samples))
    return [larger(next(found), next(found)) for _ in cams]


def _kept(path: Callable[[Reals, int], RollerPath], order: int = 2) -> Callable[[Reals, int], RollerPath]:
    """A path that keeps what it last gave, with as many derivatives as any will ask for, for the very same array."""
    kept = kept_last(lambda cam_angle: path(cam_angle, order))
    return lambda cam_angle, _order: kept(cam_angle)


@dataclass(frozen=True)
class DiscCam:
    """A cam over one revolution; nothing is computed before it is asked for.

    Parameters
        name : str - what messages call it
        path : function (cam angles (N,) [rad], order) -> RollerPath with that many derivatives filled
        sense : +1 or -1 - the cam turns counter-clockwise or clockwise
        roller_radius : float [mm]
        joints : cam angles [rad] - where the law changes; extremes are sought on each side
        key : str - of the design file, which refusals name that have none of their own
    """

    name: str
    path: Callable[[Reals, int], RollerPath]
    sense: int
    roller_radius: float
    joints: tuple[float, ...] = ()
    key: str = ""

    @cached_property
    def bounds(self) -> tuple[float, ...]:
        """The joints within the turn."""
        return tuple(joint % _TURN for joint in self.joints)

    def at(self, cam_angle: Reals) -> CamProfile:
        """Points, pressure angle and curvature at cam angles [rad]."""
        with at_key(self.key):
            path = self.path(cam_angle, 2)
            return profile.profile(cam_angle, path, sense=self.sense, roller_radius=self.roller_radius)

    def pressure_angle(self, cam_angle: Reals) -> Reals:
        """Signed pressure angle [rad] at cam angles."""
        with at_key(self.key):
            return profile.pressure_angle(cam_angle, self.path(cam_angle, 1), sense=self.sense)

    def size_of_pressure_angle(self, cam_angle: Reals) -> Reals:
        """Its magnitude."""
        return np.abs(self.pressure_angle(cam_angle))

    def curvature(self, cam_angle: Reals) -> Reals:
        """Curvature of the pitch curve [1/mm], convex positive, at cam angles."""
        with at_key(self.key):
            return profile.curvature(cam_angle, self.path(cam_angle, 2), sense=self.sense)

    def support(self, cam_angle: Reals) -> Reals:
        """Distance of the cam axis from the tangent of the pitch curve [mm] at cam angles."""
        with at_key(self.key):
            return profile.support(cam_angle, self.path(cam_angle, 1), sense=self.sense)

    def points(self, cam_angle: Reals) -> tuple[Points, Points]:
        """Pitch and profile points [mm] at cam angles, in the cam's frame."""
        with at_key(self.key):
            path = self.path(cam_angle, 1)
            pitch = profile.pitch_points(cam_angle, path, sense=self.sense)
            contact = profile.profile_points(cam_angle, path, sense=self.sense, roller_radius=self.roller_radius)
            return pitch, contact

    def normals(self, cam_angle: Reals) -> Points:
        """Direction from the profile to the roller's centre at cam angles, in the frame of the machine."""
        with at_key(self.key):
            return profile.normals(cam_angle, self.path(cam_angle, 1), sense=self.sense)

    def radius(self, cam_angle: Reals) -> Reals:
        """Distance of the roller from the cam axis [mm] at cam angles.

        Notes
            Where the pitch curve is farthest from the axis or nearest to it, its normal passes through the axis:
            the extremes of |P| - r_g are those of the profile. Where the profile loops, the body that the roller
            leaves has the same minimum radius and stays within the maximum; the loop does not.
        """
        return np.abs(self.path(cam_angle, 1).position) - self.roller_radius

    @property
    def sought(self) -> dict[str, tuple[Function, bool]]:
        """By the names of `FOUND_TOGETHER` the function whose extreme each is, and whether it is the greatest."""
        found = ((self.size_of_pressure_angle, True), (self.curvature, True))
        rest = ((self.radius, True), (self.radius, False), (self.support, False))
        return dict(zip(FOUND_TOGETHER, (*found, *rest), strict=True))

    @cached_property
    def max_pressure_angle(self) -> Extreme:
        """Maximum magnitude of the pressure angle [rad] and its place."""
        return maximum_over(self.size_of_pressure_angle, joints=self.bounds, samples=SAMPLES)

    @cached_property
    def most_convex(self) -> Extreme:
        """Maximum curvature of the pitch curve [1/mm] and its place."""
        return maximum_over(self.curvature, joints=self.bounds, samples=SAMPLES)

    @cached_property
    def most_hollow(self) -> Extreme:
        """Minimum curvature of the pitch curve [1/mm], negative where it is hollow, and its place."""
        return minimum_over(self.curvature, joints=self.bounds, samples=SAMPLES)

    @property
    def min_curvature_radius(self) -> Extreme:
        """Minimum convex radius of the pitch curve [mm] and its place."""
        return convex_radius(self.most_convex)

    @cached_property
    def corners(self) -> list[Extreme]:
        """Turns of the pitch curve where the lift's velocity jumps [rad], convex positive, and their places."""
        if not self.bounds:  # a measured cam, whose spline is smooth all round
            return []
        places = np.array(self.bounds)
        sides = np.mod(np.stack((places - AT_CORNER, places + AT_CORNER)), _TURN)
        before, after = self.normals(sides.ravel()).reshape(sides.shape)
        turns = -self.sense * np.angle(after * np.conj(before))
        return [
            Extreme(turn, place) for turn, place in zip(turns.tolist(), self.bounds, strict=True) if abs(turn) > _TURNS
        ]

    @cached_property
    def max_radius(self) -> float:
        """Largest radius of the profile; where that loops, of its parts that no roller cuts away at most [mm]."""
        return maximum_over(self.radius, joints=self.bounds, samples=SAMPLES).value

    @cached_property
    def min_radius(self) -> float:
        """Smallest radius of the profile [mm]."""
        return minimum_over(self.radius, joints=self.bounds, samples=SAMPLES).value

    @cached_property
    def undercut(self) -> Undercut:
        """Deepest cut of the roller into the profile.

        Notes
            A profile without a cusp whose polar angle runs one way cannot cross itself, and an offset curve
            that neither has a cusp nor crosses itself is the true one; the search for far cuts is left to the
            others. A cut at a corner may be narrower than a step of that search.
        """
        if self.roller_radius < self.min_curvature_radius.value and self.star_shaped:
            return Undercut(0.0, 0.0, 0.0)
        found = undercut(self.points, self.roller_radius)
        convex = [corner for corner in self.corners if corner.value > 0.0]
        return max(found, *map(self._cut_at, convex)) if convex else found

    def _cut_at(self, corner: Extreme) -> Undercut:
        """The cut at a convex corner of the pitch curve, within some roller radii times its turn."""
        away = float(self.radius(np.array([corner.place]))[0]) + self.roller_radius
        reach = min(4.0 * self.roller_radius * corner.value / away, 0.5)

        def points(phi: Reals) -> tuple[Points, Points]:
            return self.points(np.mod(phi, _TURN))

        start, end = corner.place - reach, corner.place + reach
        found = undercut(points, self.roller_radius, start=start, end=end, closed=False, samples=_NEAR_CORNER)
        return found._replace(cam_angle=found.cam_angle % _TURN, roller_angle=found.roller_angle % _TURN)

    @cached_property
    def least_support(self) -> float:
        """Minimum distance of the cam axis from the tangents of the pitch curve [mm]."""
        return minimum_over(self.support, joints=self.bounds, samples=SAMPLES).value

    @cached_property
    def star_shaped(self) -> bool:
        """Whether the polar angle of a profile without a cusp runs one way, at each corner of the pitch curve too."""
        found: Any = self.least_support > self.roller_radius
        if not np.any(found) or not self.bounds:
            return found  # type: ignore[no-any-return]
        sides = np.concatenate([np.atleast_1d(joint) + way for joint in self.bounds for way in (-_BESIDE, _BESIDE)], -1)
        profile = self.points(np.mod(sides, _TURN))[1]
        onwards = -self.sense * np.imag(np.conj(profile[..., ::2]) * profile[..., 1::2])
        runs = np.all(onwards > 0.0, axis=-1)
        return found & runs.reshape(np.shape(found))  # type: ignore[no-any-return]

    def table(self, name: str, samples: int | None = None) -> Table:
        """The cam as a table over the cam angle, as many rows as asked for; under an edge the profile alone."""
        degrees = turn_degrees(samples)
        cam = self.at(np.radians(degrees))
        pitch = {"pitch_x": (cam.pitch.real, "mm"), "pitch_y": (cam.pitch.imag, "mm")} if self.roller_radius else {}
        columns = {
            "cam_angle": (degrees, "deg"),
            **pitch,
            "x": (cam.profile.real, "mm"),
            "y": (cam.profile.imag, "mm"),
            "pressure_angle": (np.degrees(cam.pressure_angle), "deg"),
            "curvature_radius": (cam.curvature_radius, "mm"),
        }
        return Table.of(name, columns)
