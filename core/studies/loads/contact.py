"""Roller on cam: normals, curvature, force by lever, Hertzian pressure, roller and entrainment speed.

World coordinates with the cam axis at 0, B the roller's centre, ' by the turned angle of the cam, eps its sense.
Lengths in mm, forces in N, pressures in N/mm^2.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.mechanism.joints import NEWTON_METER
from gearlink.core.mechanism.rates import cross, dot
from gearlink.core.numerics.arrays import Points, Reals

if TYPE_CHECKING:
    from gearlink.core.parts.cams.disc_cam import DiscCam

_PHI = 0.5 * (1.0 + math.sqrt(5.0))
SHEAR_DEPTH = _PHI**-0.5
"""Depth of the maximum shear stress of a line contact over its half width."""


@dataclass(frozen=True)
class RollerOnCam:
    """A roller over the turned angle of its cam.

    Fields
        position, first, second : (N,) complex arrays [mm] - B, B', B''
        sense : +1 or -1 - eps
        radius : float [mm] - r_g
    """

    position: Points
    first: Points
    second: Points
    sense: int
    radius: float

    @cached_property
    def rate(self) -> Points:
        """D1 = B' - i eps B, the roller's velocity seen from the cam."""
        return np.asarray(self.first - 1j * self.sense * self.position)

    @cached_property
    def bend(self) -> Points:
        """D2 = B'' - 2 i eps B' - B."""
        return np.asarray(self.second - 2j * self.sense * self.first - self.position)

    @cached_property
    def normal(self) -> Points:
        """n_out = i eps D1/|D1|, the direction in which the flank pushes the roller."""
        return np.asarray(1j * self.sense * self.rate / np.abs(self.rate))

    @cached_property
    def curvature(self) -> Reals:
        """kappa of the pitch curve [1/mm], positive where it is convex."""
        return np.asarray(-self.sense * cross(self.rate, self.bend) / np.abs(self.rate) ** 3)

    @cached_property
    def relative_radius(self) -> Reals:
        """R = r_g (1 - r_g kappa) [mm], of roller and profile in contact; 0 at a cusp."""
        return np.asarray(self.radius * (1.0 - self.radius * self.curvature))

    @cached_property
    def roller_speed(self) -> Reals:
        """Turning of the roller that rolls, per cam speed: eps (1 - |D1|/r_g)."""
        return np.asarray(self.sense * (1.0 - np.abs(self.rate) / self.radius))

    @cached_property
    def roller_acceleration(self) -> Reals:
        """Its derivative: -eps (D1 . (B'' - i eps B'))/(|D1| r_g)."""
        along = dot(self.rate, self.second - 1j * self.sense * self.first) / np.abs(self.rate)
        return np.asarray(-self.sense * along / self.radius)

    @cached_property
    def entrainment(self) -> Reals:
        """Speed of both surfaces through the contact per cam speed [mm]: |D1| (1 - r_g kappa)."""
        return np.asarray(np.abs(self.rate) * (1.0 - self.radius * self.curvature))

    def cam_torque(self, force: Reals) -> Reals:
        """Torque that drives the cam, counter-clockwise [N m]: B x N n_out."""
        push: Points = np.asarray(force * self.normal)
        return cross(self.position, push) / NEWTON_METER


def plane_modulus(modulus: float, poisson: float) -> float:
    """E* of two bodies of one material, E/(2 (1 - nu^2)) [N/mm^2].

    Example
        >>> round(plane_modulus(206_000.0, 0.3), 3)
        113186.813
    """
    return modulus / (2.0 * (1.0 - poisson * poisson))


def roller_on(cam: DiscCam, phi: Reals) -> RollerOnCam:
    """The roller of a cam that turns as far as the input, from the cam axis."""
    path = cam.path(phi, 2)
    return RollerOnCam(path.position, path.first, path.second, cam.sense, cam.roller_radius)


@dataclass(frozen=True)
class LineContact:
    """Hertzian contact of two cylinders.

    Parameters
        force : array [N] - N; a negative one is taken as none
        radius : array [mm] - R, relative radius of curvature
        width : float [mm]
        modulus : float [N/mm^2] - E*
    Notes
        Where R is not positive there is no such contact: the results are not numbers.
    Example
        >>> contact = LineContact(np.array([1000.0]), np.array([20.0]), 30.0, plane_modulus(206_000.0, 0.3))
        >>> round(float(contact.pressure[0]), 3), round(float(contact.half_width[0]), 6)
        (245.046, 0.086599)

    Source
        H. Hertz, line contact
    """

    force: Reals
    radius: Reals
    width: float
    modulus: float

    @cached_property
    def _load(self) -> Reals:
        """N/R, not a number where the contact does not exist."""
        force = np.maximum(self.force, 0.0)
        ratio: Reals = np.divide(force, self.radius, out=np.full(np.shape(force), math.nan), where=self.radius > 0.0)
        return ratio

    @cached_property
    def pressure(self) -> Reals:
        """p_max = sqrt(N E*/(pi b R)) [N/mm^2]."""
        return np.asarray(np.sqrt(self._load * self.modulus / (math.pi * self.width)))

    @cached_property
    def half_width(self) -> Reals:
        """b = sqrt(4 N R/(pi b_c E*)) [mm]."""
        force = np.where(np.isnan(self._load), math.nan, np.maximum(self.force, 0.0))
        return np.asarray(np.sqrt(4.0 * force * np.abs(self.radius) / (math.pi * self.width * self.modulus)))

    @cached_property
    def shear_depth(self) -> Reals:
        """Depth of the maximum shear stress, Phi^(-1/2) b [mm]."""
        return np.asarray(SHEAR_DEPTH * self.half_width)


def contact_of(section: Any, force: Reals, radius: Reals) -> LineContact | None:
    """The contact of a roller of the section `loads`; None where the file gives no width.

    Parameters
        force, radius : arrays [N, mm] - N, R
    """
    from gearlink.core.studies.loads.spec import Material

    if section.roller is None:
        return None
    material = section.material or Material()
    return LineContact(force, radius, section.roller.width, plane_modulus(material.modulus, material.poisson))


def positive_drive(force: Reals, preload: float, stiffness: tuple[float, float]) -> tuple[Reals, Reals]:
    """Forces of the two rollers of a positive drive with preload.

    N_1 = P + F k_1/(k_1 + k_2),  N_2 = P - F k_2/(k_1 + k_2)  while both are positive, else the loaded one has |F|

    Parameters
        force : (N,) array [N] - F, net, positive on the first roller
        preload : float [N] - P
        stiffness : k_1, k_2 - of the two contacts, in one unit
    Example
        >>> positive_drive(np.array([0.0, 100.0, 900.0]), 300.0, (1.0, 1.0))
        (array([300., 350., 900.]), array([300., 250.,   0.]))
    """
    share = stiffness[0] / (stiffness[0] + stiffness[1])
    one, other = preload + force * share, preload - force * (1.0 - share)
    closed = (one > 0.0) & (other > 0.0)
    return np.where(closed, one, np.maximum(force, 0.0)), np.where(closed, other, np.maximum(-force, 0.0))
