"""Disc cams with a roller follower: pitch curve, profile, pressure angle and curvature.

One formulation serves oscillating and translating followers. The cam axis is the origin; the plane is the complex
plane; primes are derivatives with respect to the cam angle phi >= 0; eps = +1 for a cam that turns
counter-clockwise, -1 for clockwise. World rates of the pitch curve: D1 = B' - i eps B, D2 = B'' - 2 i eps B' - B.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.wording import short
from gearlink.core.numerics.arrays import BLOCK, Mask, Points, Reals
from gearlink.core.parts.cams.codes import LARGER

_STRAIGHT = 1e-12
"""Curvature times size: below it a curve is straight but for rounding, some ulp of |D2|/|D1|^2 times its size."""


@dataclass(frozen=True, slots=True)
class RollerPath:
    """The roller centre in the world, moved by the follower law.

    Attributes
        position, first, second : complex arrays [mm] - B, B', B'' (derivatives by the cam angle)
        direction : complex array or scalar - unit vector u of the follower's motion
    """

    position: Points
    first: Points
    second: Points
    direction: Points


@dataclass(frozen=True, slots=True)
class CamProfile:
    """A cam over its angle; points stand in the cam's own frame, which is the world's at cam angle 0.

    Attributes
        pitch, profile : (N,) complex arrays [mm] - roller centre and contact point
        pressure_angle : (N,) array [rad] - signed
        curvature : (N,) array [1/mm] - of the pitch curve, positive where convex
    """

    pitch: Points
    profile: Points
    pressure_angle: Reals
    curvature: Reals

    @property
    def curvature_radius(self) -> Reals:
        """Radius of curvature of the pitch curve [mm], positive where convex, inf where it is straight to rounding."""
        bend, straight = self.curvature, np.full(self.curvature.shape, math.inf)
        inverse: Reals = np.divide(1.0, bend, out=straight, where=np.abs(bend) * np.abs(self.pitch) > _STRAIGHT)
        return inverse


def oscillating(pivot: complex, arm: float, angle: ArrayLike, first: ArrayLike, second: ArrayLike = 0.0) -> RollerPath:
    """Path of a roller on a rocking arm.

    B = A + l e^(i psi),  B' = i l psi' e^(i psi),  B'' = l (i psi'' - psi'^2) e^(i psi)

    Parameters
        pivot : complex [mm] - A, seen from the cam axis
        arm : float [mm] - l, from the pivot to the roller centre
        angle : (N,) array [rad] - psi, direction of the arm from the pivot, counter-clockwise positive
        first, second : (N,) arrays - psi', psi'' by the cam angle; the second serves the curvature only
    Returns
        path : RollerPath - its direction is i e^(i psi)
    Example
        >>> oscillating(200.0, 50.0, [0.0], [0.1]).first
        array([0.+5.j])
    """
    psi, psi1, psi2 = np.broadcast_arrays(*(np.asarray(a, dtype=float) for a in (angle, first, second)))
    e = _unit(psi, 1)
    along: Points = 1j * e
    second_rate: Points = arm * (psi2 * along - psi1 * psi1 * e)
    return RollerPath(pivot + arm * e, (arm * psi1) * along, second_rate, along)


def translating(
    displacement: ArrayLike, first: ArrayLike, second: ArrayLike = 0.0, *, direction: complex = 1.0, offset: float = 0.0
) -> RollerPath:
    """Path of a roller on a slide.

    B = u (y - i e),  B' = u y',  B'' = u y''

    Parameters
        displacement : (N,) array [mm] - y, of the roller centre along the travel from the foot of the
            perpendicular out of the cam axis: sqrt(r_p^2 - e^2) + lift
        first, second : (N,) arrays [mm/rad, mm/rad^2] - y', y''; the second serves the curvature only
        direction : complex - u, unit vector of the travel (1 along +x, -1 along -x, 1j along +y)
        offset : float [mm] - e, distance of the line of travel from the cam axis on the right of u
    Raises
        NoSolution - direction is not a unit vector
    Example
        >>> translating([90.0], [0.0], direction=1j, offset=10.0).position
        array([10.+90.j])
    """
    if not abs(abs(direction) - 1.0) <= 1e-9:
        message = f"direction of travel {direction} has length {abs(direction):.4g} (required 1)"
        raise NoSolution(message, fix="give a unit vector")
    u = complex(direction) / abs(direction)
    y, y1, y2 = np.broadcast_arrays(*(np.asarray(a, dtype=float) for a in (displacement, first, second)))
    return RollerPath(u * (y - 1j * offset), u * y1, u * y2, np.broadcast_to(np.complex128(u), y.shape))


def pitch_points(cam_angle: ArrayLike, path: RollerPath, *, sense: int) -> Points:
    """Pitch curve in the cam's frame.

    P = e^(-i eps phi) B

    Parameters
        cam_angle : (N,) array [rad] - phi, angle turned by the cam, growing for either sense
        path : RollerPath - at these angles
        sense : +1 or -1 - eps
    Returns
        points : (N,) complex array [mm]
    Example
        >>> pitch_points([0.0], translating([90.0], [0.0]), sense=1)
        array([90.+0.j])
    """
    return _back_turn(cam_angle, sense) * path.position


def profile_points(cam_angle: ArrayLike, path: RollerPath, *, sense: int, roller_radius: float) -> Points:
    """Cam profile in the cam's frame: the point that the roller touches.

    C = e^(-i eps phi) (B + r_g N),  N = -i eps D1/|D1|

    Parameters
        cam_angle, path, sense : as of pitch_points
        roller_radius : float [mm] - r_g
    Returns
        points : (N,) complex array [mm]
    Raises
        NoSolution - the pitch curve stands still (D1 = 0)
    Example
        >>> profile_points([0.0], translating([90.0], [0.0]), sense=1, roller_radius=25.0).real
        array([65.])

    Source
        own derivation: envelope of the roller
    """
    d1 = _pitch_rate(path, sense)
    reach = sense * roller_radius / _speed(cam_angle, path, d1)
    return _back_turn(cam_angle, sense) * _contact(path, d1, reach)


def normals(cam_angle: ArrayLike, path: RollerPath, *, sense: int) -> Points:
    """Direction from the profile to the roller's centre, in the frame in which the roller is given.

    -N = i eps D1/|D1|

    Parameters
        cam_angle, path, sense : as of pitch_points
    Returns
        normals : (N,) complex array - unit vectors, exact however small the roller is
    Raises
        NoSolution - the pitch curve stands still (D1 = 0)
    Example
        >>> normals([0.0], translating([90.0], [0.0]), sense=1)
        array([1.+0.j])

    Source
        own derivation: envelope of the roller
    """
    d1 = _pitch_rate(path, sense)
    return np.asarray(1j * sense * d1 / _speed(cam_angle, path, d1))


def support(cam_angle: ArrayLike, path: RollerPath, *, sense: int) -> Reals:
    """Distance of the cam axis from the tangent of the pitch curve, positive where it lies on the cam's side of it.

    h = -eps Im(conj(B) D1)/|D1|

    Parameters
        cam_angle, path, sense : as of pitch_points
    Returns
        h : (N,) array [mm] - of the profile h - r_g: where that is positive all over a profile without a cusp, the
            polar angle runs one way
    Raises
        NoSolution - the pitch curve stands still (D1 = 0)
    Example
        >>> support([0.0], translating([90.0], [0.0]), sense=1)
        array([90.])

    Source
        own derivation: Im(conj(C) C') = (1 - r_g kappa) (Im(conj(B) D1) + eps r_g |D1|)
    """
    d1, at = _pitch_rate(path, sense), path.position
    return np.asarray(sense * (at.imag * d1.real - at.real * d1.imag) / _speed(cam_angle, path, d1))


def _contact(path: RollerPath, d1: Points, reach: Reals) -> Points:
    # B - i reach D1
    contact = np.empty(np.broadcast_shapes(d1.shape, reach.shape), dtype=np.complex128)
    np.add(path.position.real, reach * d1.imag, out=contact.real)
    np.subtract(path.position.imag, reach * d1.real, out=contact.imag)
    return contact


def pressure_angle(cam_angle: ArrayLike, path: RollerPath, *, sense: int) -> Reals:
    """Angle between the follower's motion and the common normal at the contact.

    tan alpha = Im(q/u)/Re(q/u),  q = i B' + eps B

    Parameters
        cam_angle, path, sense : as of pitch_points
    Returns
        alpha : (N,) array [rad] - in (-pi/2, pi/2); translating: tan alpha = (eps y' - e)/y
    Raises
        NoSolution - Re(q/u) vanishes or changes sign: the roller passes the relative pole
    Example
        >>> pressure_angle([0.0], translating([40.0], [30.0]), sense=1).round(6)
        array([0.643501])

    Source
        own derivation: the normal passes through the relative pole of cam and follower
    """
    lever = _lever(path, _pitch_rate(path, sense))
    _check_lever(cam_angle, lever.real)
    return np.arctan(lever.imag / lever.real)


def _lever(path: RollerPath, d1: Points) -> Points:
    # q = i D1, along the normal of the pitch curve
    u = path.direction
    lever = np.empty(d1.shape, dtype=np.complex128)
    np.subtract(d1.real * u.imag, d1.imag * u.real, out=lever.real)
    np.add(d1.real * u.real, d1.imag * u.imag, out=lever.imag)
    return lever


def stands(path: RollerPath, *, sense: int) -> Mask:
    """Whether the roller keeps off the relative pole all along a path; of many paths, one by one.

    Source
        own derivation: Re(q/u) of `pressure_angle` keeps its sign
    """
    return _keeps_sign(_lever(path, _pitch_rate(path, sense)).real)


def _keeps_sign(across: Reals) -> Mask:
    return np.asarray((across.min(axis=-1) > 0.0) | (across.max(axis=-1) < 0.0))


def _check_lever(cam_angle: ArrayLike, across: Reals) -> None:
    if across.size and not _keeps_sign(across).all():
        place = _angle_at(cam_angle, across.shape, int(np.argmin(np.abs(across))))
        message = f"pressure angle: 90 deg at cam angle {short(place)} deg, where the roller passes the relative pole"
        raise NoSolution(message, fix=f"{LARGER} or lengthen the rise")


def curvature(cam_angle: ArrayLike, path: RollerPath, *, sense: int) -> Reals:
    """Curvature of the pitch curve, positive where convex.

    kappa = -eps Im(conj(D1) D2)/|D1|^3

    Parameters
        cam_angle, path, sense : as of pitch_points; the path must carry its second derivative
    Returns
        kappa : (N,) array [1/mm] - the profile's is kappa/(1 - r_g kappa)
    Raises
        NoSolution - the pitch curve stands still (D1 = 0)
    Example
        >>> curvature([0.0], translating([90.0], [0.0]), sense=1)
        array([0.01111111])
    """
    d1 = _pitch_rate(path, sense)
    return _curvature(path, sense, d1, _speed(cam_angle, path, d1))


def _curvature(path: RollerPath, sense: int, d1: Points, speed: Reals) -> Reals:
    # D2 = B'' - 2 i eps B' - B
    d2_x = path.second.real + (2.0 * sense) * path.first.imag - path.position.real
    d2_y = path.second.imag - (2.0 * sense) * path.first.real - path.position.imag
    bend: Reals = sense * (d1.imag * d2_x - d1.real * d2_y) / (speed * speed * speed)
    return bend


def profile(cam_angle: ArrayLike, path: RollerPath, *, sense: int, roller_radius: float) -> CamProfile:
    """Pitch curve, profile, pressure angle and curvature of a cam in one pass.

    Parameters
        cam_angle, path, sense, roller_radius : as of profile_points
    Raises
        NoSolution - the pitch curve stands still, or the roller passes the relative pole
    Notes
        Works in blocks of 8000 angles. Where one result is wanted, its own function computes only that.
    Example
        >>> profile([0.0], translating([90.0], [0.0]), sense=1, roller_radius=25.0).curvature_radius
        array([90.])
    """
    phi = np.asarray(cam_angle, dtype=float)
    shape = np.broadcast_shapes(phi.shape, path.position.shape)
    whole = (phi, path.position, path.first, path.second, path.direction)
    phi, *parts = (np.broadcast_to(part, shape).ravel() for part in whole)
    pitch, contact = (np.empty(phi.size, dtype=np.complex128) for _ in range(2))
    bend, across, slope = (np.empty(phi.size) for _ in range(3))
    for start in range(0, phi.size, BLOCK):
        block = slice(start, start + BLOCK)
        part = RollerPath(*(each[block] for each in parts))
        d1 = _pitch_rate(part, sense)
        speed = _speed(phi[block], part, d1)
        turn = _back_turn(phi[block], sense)
        pitch[block] = turn * part.position
        contact[block] = turn * _contact(part, d1, sense * roller_radius / speed)
        bend[block] = _curvature(part, sense, d1, speed)
        lever = _lever(part, d1)
        across[block], slope[block] = lever.real, lever.imag
    _check_lever(phi, across)
    np.divide(slope, across, out=slope)
    angle = np.arctan(slope, out=slope).reshape(shape)
    return CamProfile(pitch.reshape(shape), contact.reshape(shape), angle, bend.reshape(shape))


def _back_turn(cam_angle: ArrayLike, sense: int) -> Points:
    return _unit(np.asarray(cam_angle, dtype=float), -sense)


def _unit(angle: Reals, sign: int) -> Points:
    # e^(i sign angle) from t = tan(angle/2): numpy's tan costs a tenth of its sine, the error stays near 1 ulp.
    t = np.tan(0.5 * angle)
    square = t * t
    share = 1.0 / (1.0 + square)
    e = np.empty(angle.shape, dtype=np.complex128)
    np.multiply(1.0 - square, share, out=e.real)
    np.multiply((2.0 * sign) * t, share, out=e.imag)
    return e


def _pitch_rate(path: RollerPath, sense: int) -> Points:
    # D1 = B' - i eps B, term by term: a complex product costs three times as much
    d1 = np.empty(path.position.shape, dtype=np.complex128)
    np.add(path.first.real, sense * path.position.imag, out=d1.real)
    np.subtract(path.first.imag, sense * path.position.real, out=d1.imag)
    return d1


def _speed(cam_angle: ArrayLike, path: RollerPath, d1: Points) -> Reals:
    speed = np.sqrt(d1.real * d1.real + d1.imag * d1.imag)
    still = speed <= 1e-13 * np.maximum(np.abs(path.position.real), np.abs(path.position.imag))
    if still.any():
        place = _angle_at(cam_angle, speed.shape, int(np.argmax(still)))
        message = f"the pitch curve has a cusp at cam angle {short(place)} deg, where the follower moves with the cam"
        raise NoSolution(message, fix=f"{LARGER} or change the law")
    return speed


def _angle_at(cam_angle: ArrayLike, shape: tuple[int, ...], index: int) -> float:
    return math.degrees(float(np.broadcast_to(np.asarray(cam_angle, dtype=float), shape).ravel()[index]))
