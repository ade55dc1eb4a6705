"""Contour of a wide-swing cam and the places of its rocker, in the cam's own frame: what a drawing shows."""

from __future__ import annotations

import numpy as np

from gearlink.core.machines.wide_swing.cams.cam import CamPoints, WideSwingCam
from gearlink.core.machines.wide_swing.cams.oscillating_cam import OscillatingCam
from gearlink.core.machines.wide_swing.cams.slider_cam import SliderCam
from gearlink.core.numerics.arrays import Points, Reals

AnyCam = WideSwingCam | OscillatingCam | SliderCam


def is_external(cam: AnyCam) -> bool:
    """Whether the cam's body lies inside its profile."""
    return isinstance(cam, OscillatingCam) or cam.sense > 0


def middle_of(cam: AnyCam) -> float:
    """Fraction of the stroke at which the roller passes the line of centres."""
    return 0.5 if isinstance(cam, WideSwingCam) else cam.middle


def rocker_pivots(cam: AnyCam, points: CamPoints) -> Points:
    """Places of the rocker's pivot in the cam's frame, the cam held still.

    -a e^{i theta} external, a e^{-i theta} internal

    Parameters
        cam : WideSwingCam or OscillatingCam
        points : CamPoints - of that cam
    Returns
        pivots : (N,) complex array [mm]
    Example
        >>> import math
        >>> from gearlink.core.machines.wide_swing.law.elastic_law import ElasticLaw, Pneumatic
        >>> law = ElasticLaw(Pneumatic(2.5), math.radians(120))
        >>> cam = WideSwingCam("twin-rocker", law, math.radians(80), 200.0, 4.0)
        >>> points = cam.points(np.array([0.0, 0.5]))
        >>> np.abs(points.pitch - rocker_pivots(cam, points)).round(9).tolist()
        [130.609218127, 130.609218127]

    Source
        wide-swing dissertation, figures of chapters 3 and 4
    """
    sense = 1.0 if is_external(cam) else -1.0
    pivots: Points = -sense * cam.center_distance * np.exp(1j * sense * points.cam_angle)
    return pivots


def contour(cam: AnyCam, slot: tuple[float, float], count: int = 400) -> tuple[Points, Points, Points]:
    """The cam's contour over the stroke: run-up, slot of the roller at mid-swing, run-out.

    Parameters
        cam : WideSwingCam or OscillatingCam
        slot : (float, float) - fractions of the stroke between which the profile is cut away
        count : int - points of each profile branch
    Returns
        run_up, slot, run_out : complex arrays [mm] - each begins where the one before it ends
    Raises
        NoSolution - for a profile that does not exist
    """
    run_up = cam.points(np.linspace(cam.contact[0][0], slot[0], count)).profile
    run_out = cam.points(np.linspace(slot[1], cam.contact[1][1], count)).profile
    middle = complex(cam.points(np.array([middle_of(cam)])).pitch[0])
    return run_up, _slot_bottom(cam, middle, run_up[-1], run_out[0]), run_out


def _slot_bottom(cam: AnyCam, middle: complex, start: complex, end: complex) -> Points:
    """Arc of the roller at mid-swing from one contact point to the other, by way of the body."""
    into_body = -middle / abs(middle) if is_external(cam) else middle / abs(middle)
    first, last = (float(np.angle((point - middle) / into_body)) for point in (start, end))
    angles = np.linspace(first, last, 81)
    result: Points = middle + cam.roller_radius * into_body * np.exp(1j * angles)
    return result


def dwell_arc(cam: AnyCam) -> Points:
    """The rest of the turn, from the end of the stroke back to its start, about the cam axis.

    Parameters
        cam : WideSwingCam or OscillatingCam
    Returns
        arc : (181,) complex array [mm] - a circle's where the cam turns evenly and the rocker dwells
    Raises
        NoSolution - for a profile that does not exist
    """
    (begin, _), (_, end) = cam.contact
    last, first = (complex(z) for z in cam.points(np.array([end, begin])).profile)
    middle = complex(cam.points(np.array([middle_of(cam)])).pitch[0])
    start, stop = (float(np.angle(z / -middle)) for z in (last, first))
    share: Reals = np.linspace(0.0, 1.0, 181)
    radius = abs(last) ** (1.0 - share) * abs(first) ** share
    result: Points = -middle / abs(middle) * radius * np.exp(1j * (start + (stop - start) * share))
    return result
