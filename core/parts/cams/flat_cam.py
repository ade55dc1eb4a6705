"""A disc cam with a flat-faced follower: contact, curvature, reach of the face, extremes.

The cam axis is the origin; ' is by the cam angle phi; eps is the sense of the cam, points are in its frame.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import Table
from gearlink.core.numerics.arrays import Points, Reals, turn_degrees
from gearlink.core.numerics.extremes import Extreme, maximum_over, minimum_over
from gearlink.core.parts.cams.disc_cam import AT_CORNER, SAMPLES
from gearlink.core.parts.cams.follower_motion import FollowerMotion

_STANDS = 1e-9
"""Of the cam's speed: a rocking face that is slower against the cam is as fast as it, but for rounding."""
_CROSSES = 1e-6
"""Of the largest radius: more than what the contact moves between both sides of a joint."""


class Touch(NamedTuple):
    """Contact of cam and face.

    Fields
        point : (N,) complex array [mm] - in the machine's frame
        normal : (N,) complex array - unit vector from the cam into the face
        radius : (N,) array [mm] - rho of the profile, positive where convex
        place : (N,) array [mm] - along the face, from the line of travel (positive on its right) or from the pivot
        pressure_angle : (N,) array [rad] - signed
    """

    point: Points
    normal: Points
    radius: Reals
    place: Reals
    pressure_angle: Reals


def sliding_face(
    motion: FollowerMotion, base_radius: float, direction: complex, sense: int
) -> Callable[[Reals], Touch]:
    """A face across its travel.

    C = u ((r_b + s) - i eps s'),  rho = r_b + s + s'',  at eps s' on the right of the travel

    Source
        own derivation: the normal passes the relative pole -i eps s' u
    """

    def touch(phi: Reals) -> Touch:
        s, s1, s2 = motion.evaluate(phi, 2)
        point = direction * ((base_radius + s) - 1j * sense * s1)
        still = np.zeros_like(s)
        return Touch(point, np.full(s.shape, np.complex128(direction)), base_radius + s + s2, sense * s1, still)

    return touch


def rocking_face(
    motion: FollowerMotion, start: float, distance: float, direction: float, offset: float, side: int, sense: int
) -> Callable[[Reals], Touch]:
    """A face on a rocker.

    t = f cos Psi/(1 + sigma s'),  tan alpha = d/t,  sigma = side eps
    rho = d + f sin Psi (1 + 2 sigma s')/(1 + sigma s')^2 + f cos Psi s''/(1 + sigma s')^3

    Parameters
        start, distance, direction, offset : Psi_0 [rad], f [mm], delta [rad], d [mm]
        side : +1 where the face lies left of the vector cam axis -> pivot
    Raises
        NoSolution - the follower overtakes the cam
    Source
        own derivation: rho = p + d2p/dchi2 of the face as a tangent with the support p
    """
    sigma = side * sense
    pivot = distance * complex(math.cos(direction), math.sin(direction))

    def touch(phi: Reals) -> Touch:
        s, s1, s2 = motion.evaluate(phi, 2)
        relative = 1.0 + sigma * s1
        if not np.all(relative > _STANDS):
            place = math.degrees(float(np.atleast_1d(phi)[int(np.argmin(relative))]))
            message = f"at cam angle {place:.5g} deg the follower moves as fast as the cam, or faster"
            raise NoSolution(message, key="motion", fix="give its motion more cam angle")
        across, along = distance * np.sin(start + s), distance * np.cos(start + s)
        t = along / relative
        arm = np.exp(1j * (direction + math.pi - side * (start + s)))
        rho = offset + across * (1.0 + 2.0 * sigma * s1) / relative**2 + along * s2 / relative**3
        point = pivot + arm * (t - 1j * side * offset)
        return Touch(point, -1j * side * arm, rho, t, np.arctan2(offset, t))

    return touch


@dataclass(frozen=True)
class FlatCam:
    """A cam under a flat face over one revolution; nothing is computed before it is asked for.

    Parameters
        name : str - what messages call it
        touch : function (cam angles [rad]) -> Touch
        sense : +1 or -1
        joints : cam angles [rad] - where the law changes
    """

    name: str
    touch: Callable[[Reals], Touch]
    sense: int
    joints: tuple[float, ...]

    def points(self, phi: Reals) -> tuple[Points, Points]:
        """Points of the profile and outward normals there, in the cam's frame."""
        found, back = self.touch(phi), np.exp(-1j * self.sense * phi)
        return back * found.point, back * found.normal

    def outside(self, distance: float) -> FlatCam:
        """The curve at a distance outside the profile, such as the path of a cutter of that radius [mm]."""

        def touch(phi: Reals) -> Touch:
            found = self.touch(phi)
            return found._replace(point=found.point + distance * found.normal, radius=found.radius + distance)

        return replace(self, name="cutter path", touch=touch)

    def _most(self, course: Callable[[Reals], Reals]) -> Extreme:
        return maximum_over(course, joints=self.joints, samples=SAMPLES)

    def _least(self, course: Callable[[Reals], Reals]) -> Extreme:
        return minimum_over(course, joints=self.joints, samples=SAMPLES)

    def pressure_angle(self, phi: Reals) -> Reals:
        """Signed pressure angle [rad]."""
        return self.touch(phi).pressure_angle

    def size_of_pressure_angle(self, phi: Reals) -> Reals:
        """Its magnitude."""
        return np.abs(self.touch(phi).pressure_angle)

    @cached_property
    def max_pressure_angle(self) -> Extreme:
        """Maximum magnitude [rad] and its place."""
        return self._most(self.size_of_pressure_angle)

    @cached_property
    def min_curvature_radius(self) -> Extreme:
        """Minimum radius of the profile [mm] and its place; not positive where it is undercut."""
        return self._least(lambda phi: self.touch(phi).radius)

    @cached_property
    def crossing(self) -> Extreme | None:
        """Greatest length by which the contact runs back along the profile at a step of the velocity [mm], and its
        cam angle; None without one. There the profile crosses itself: a face of any cam leaves it.

        Source
            own derivation: the integral of rho over the step; a step up leaves a straight part
        """
        places = np.array(self.joints)
        sides = np.mod(np.stack((places - AT_CORNER, places + AT_CORNER)), 2.0 * math.pi)
        points, normals = self.points(sides.ravel())
        before, after = points.reshape(sides.shape)
        back = np.real(np.conj(1j * self.sense * normals.reshape(sides.shape)[0]) * (after - before))
        found = [Extreme(length, place) for length, place in zip(back.tolist(), self.joints, strict=True)]
        return max((each for each in found if each.value > _CROSSES * self.max_radius), default=None)

    @cached_property
    def max_radius(self) -> float:
        """Largest radius of the profile [mm]."""
        return self._most(lambda phi: np.abs(self.touch(phi).point)).value

    @cached_property
    def min_radius(self) -> float:
        """Smallest radius of the profile [mm]."""
        return self._least(lambda phi: np.abs(self.touch(phi).point)).value

    @cached_property
    def contact_places(self) -> tuple[float, float]:
        """Minimum and maximum place of the contact along the face [mm]."""
        return self._least(lambda phi: self.touch(phi).place).value, self._most(lambda phi: self.touch(phi).place).value

    def table(self, name: str, samples: int | None = None) -> Table:
        """The cam as a table over the cam angle."""
        degrees = turn_degrees(samples)
        phi = np.radians(degrees)
        point, radius = self.points(phi)[0], self.touch(phi).radius
        columns = {
            "cam_angle": (degrees, "deg"),
            "x": (point.real, "mm"),
            "y": (point.imag, "mm"),
            "curvature_radius": (radius, "mm"),
        }
        return Table.of(name, columns)
