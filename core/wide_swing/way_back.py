"""The way back of an oscillating cam: the acceleration that its profile asks of the rocker when the cam swings home."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.linkages.fourbar.sweep import solve
from gearlink.core.numerics.extremes import Extreme, maximum_over

if TYPE_CHECKING:
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.wide_swing.cams.oscillating_cam import OscillatingCam

_STOP = 1e-4
"""Nearer to a stop, in strokes, both accelerations are as good as one, and their ratio has few digits."""


def need(cam: OscillatingCam) -> Extreme:
    """Greatest acceleration of the rocker on the way back over that of the stroke at the same place, and the place k.

    Where the device holds the rocker of the stroke to its cam with a force above J phi'', it holds it on the way back
    only with a force above that ratio of it.

    Parameters
        cam : OscillatingCam
    Returns
        need : Extreme - at least 1, for at both ends the crank is the same; among places where the roller touches
    Raises
        NoSolution - for a loop, or where the roller touches nothing
    """
    found = [maximum_over(lambda k: ratio(cam, k), *part, samples=128) for part in parts(cam)]
    return max(*found, Extreme(1.0, 0.0), key=lambda extreme: extreme.value)


def parts(cam: OscillatingCam) -> tuple[tuple[float, float], tuple[float, float]]:
    """Parts of the stroke in which the roller touches the profile, without the stops, where the ratio is 0/0.

    Raises
        NoSolution - for a loop, or where the roller touches nothing
    """
    (first, start), (end, last) = cam.contact
    return (max(first, _STOP), start), (end, min(last, 1.0 - _STOP))


def ratio(cam: OscillatingCam, k: Reals) -> Reals:
    """Acceleration of the rocker on the way back over that of the stroke, where the cam stands as at k.

    phi_b'' = phi_cc chi_b'^2 + phi_c chi_b'',  phi_c = phi'/chi',  phi_cc = (phi'' - phi_c chi'')/chi'^2

    Parameters
        cam : OscillatingCam
        k : (N,) array - fractions of the stroke, without 0, 1/2 and 1
    Notes
        The crank pins of the two ways are mirror images on the line from the crank's pivot to the rocker's end; primes
        are derivatives by the crank angle.
    Source
        own derivation
    """
    drive, span, swing = cam.drive, cam.drive.crank_span, cam.law.swing
    bar = drive.linkage
    forth = drive.crank_angles[0] + k * span
    there = solve(bar, forth, 2)
    tip = bar.frame + bar.rocker * np.exp(1j * there.rocker_angle)
    here = solve(bar, 2.0 * np.angle(tip) - forth, 2)
    view = cam.law.middle_view(k)
    first, second = swing * view.velocity / span, swing * view.acceleration / span**2
    sense = drive.rising
    chi1, chi2 = sense * there.rocker_velocity, sense * there.rocker_acceleration
    slope = first / chi1
    bend = (second - slope * chi2) / (chi1 * chi1)
    back: Reals = bend * here.rocker_velocity**2 + slope * sense * here.rocker_acceleration
    return back / second
