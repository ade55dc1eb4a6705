"""The way home of an oscillating cam: its crank goes on evenly, and the profile leads the rocker back."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from gearlink.core.machines.wide_swing.cams.oscillating_cam import AimedLaw
from gearlink.core.numerics.extremes import Extreme, maximum_over
from gearlink.core.parts.linkages.fourbar.sweep import solve

if TYPE_CHECKING:
    from gearlink.core.machines.wide_swing.cams.oscillating_cam import OscillatingCam
    from gearlink.core.numerics.arrays import Reals

_TURN = 2.0 * np.pi


class Home(NamedTuple):
    """Where the cam stands on its way home, and how it goes on.

    Fields
        k : (N,) array - fraction of the stroke at which it stood there, from 1 to 0
        first, second, third : (N,) arrays - derivatives of k by the crank angle; the third empty unless asked for
    """

    k: Reals
    first: Reals
    second: Reals
    third: Reals


def home(cam: OscillatingCam, turned: Reals, order: int = 2) -> Home:
    """The cam at crank angles of its way home.

    psi(k) = 2 arg C - psi,  psi'(k) = 2 Im(C'/C) - 1,  psi''(k) = 2 Im(C''/C - (C'/C)^2)
    psi'''(k) = 2 Im(C'''/C - 3 C'' C'/C^2 + 2 (C'/C)^3)

    Parameters
        cam : OscillatingCam
        turned : (N,) array [rad] - crank angle from the start of the stroke, from the stroke's to a whole revolution
        order : 2 or 3 - of the derivatives
    Notes
        C is the end of the rocker that carries the cam, seen from the crank's pivot: the crank pins of both ways are
        mirror images on that line. At both ends, where cam and rocker stand still, nothing is 0/0.
    """
    bar, span = cam.drive.linkage, cam.drive.crank_span
    found = solve(bar, cam.drive.crank_angles[0] + turned, order)
    arm = bar.rocker * np.exp(1j * found.rocker_angle)
    end = bar.frame + arm
    speed = found.rocker_velocity
    rate = 1j * speed * arm / end
    curve = (1j * found.rocker_acceleration - speed**2) * arm / end
    bend = curve - rate * rate
    third = np.empty(0)
    if order > 2:
        jerk = (1j * (found.rocker_jerk - speed**3) - 3.0 * speed * found.rocker_acceleration) * arm / end
        third = 2.0 * (jerk - 3.0 * curve * rate + 2.0 * rate**3).imag / span
    forth = _from(0.5 * (span - _TURN), 2.0 * np.angle(end) - 2.0 * cam.drive.crank_angles[0] - turned)
    return Home(_within(forth, 0.0, span) / span, (2.0 * rate.imag - 1.0) / span, 2.0 * bend.imag / span, third)


def crank_angle(cam: OscillatingCam, k: Reals) -> Reals:
    """Crank angle from the start of the stroke at which the cam, on its way home, stands as at k [rad].

    Parameters
        cam : OscillatingCam
        k : (N,) array - fractions of the stroke
    Returns
        turned : (N,) array [rad] - from a whole revolution at k = 0 down to the stroke's at k = 1
    """
    bar, start, span = cam.drive.linkage, cam.drive.crank_angles[0], cam.drive.crank_span
    forth = k * span
    end = bar.frame + bar.rocker * np.exp(1j * solve(bar, start + forth, 0).rocker_angle)
    return _within(_from(0.5 * span, 2.0 * np.angle(end) - 2.0 * start - forth), span, _TURN)


def _from(low: float, angle: Reals) -> Reals:
    """The angle in the turn that begins at `low`, far from every angle of the stroke or of the way home."""
    return np.asarray(low + np.mod(angle - low, _TURN))


def _within(angle: Reals, low: float, high: float) -> Reals:
    """Rounding beyond an end is the end."""
    return np.asarray(np.minimum(np.maximum(angle, low), high))


def need(cam: OscillatingCam) -> Extreme:
    """Maximum acceleration of the rocker on the way home over that of the stroke at the same position, and the place k.

    Where the device holds the rocker of the stroke to its cam with a force above J phi'', it holds it on the way home
    only with a force above that ratio of it.

    Parameters
        cam : OscillatingCam
    Returns
        need : Extreme - at least 1, for at both ends the crank is the same; among places where the roller touches
    Raises
        NoSolution - for a loop, or where the roller touches nothing
    """
    found = [maximum_over(lambda k: ratio(cam, k), *part, samples=128) for part in cam.contact]
    return max(*found, Extreme(1.0, 0.0), key=lambda extreme: extreme.value)


def ratio(cam: OscillatingCam, k: Reals) -> Reals:
    """Torque of inertia on the way home over that of the stroke, where the cam stands as at k.

    (m k'^2 + j phi_k k'')/(m/span^2), m that of the stroke; of a rocker alone j = 1 and m its acceleration

    Parameters
        cam : OscillatingCam
        k : (N,) array - fractions of the stroke, without 1/2, where the rocker has no acceleration in it
    """
    back = home(cam, crank_angle(cam, k))
    span = cam.drive.crank_span
    if isinstance(cam.law, AimedLaw):
        law = cam.law.law
        a, b = law.invariants(k, 1)
        inertia = np.array([law.inertia_at(share) for share in a.ravel().tolist()]).reshape(a.shape)
        pace = inertia * b / law.device_torque(k)
    else:
        view = cam.law.middle_view(k)
        pace = view.velocity / view.acceleration
    found: Reals = span**2 * (back.first**2 + back.second * pace)
    return found
