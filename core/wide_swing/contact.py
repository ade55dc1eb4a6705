"""Curvature and contact of a wide-swing cam about mid-swing: the exact limits and the dissertation's estimates."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from gearlink.core.errors import NoSolution
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.wide_swing.cam import WideSwingCam


def undercut_start(cam: WideSwingCam) -> float:
    """Fraction of the stroke where the pitch curve's radius has fallen to the roller's: k with R(k) = r_p.

    Parameters
        cam : WideSwingCam
    Returns
        k : float - below 1/2
    Raises
        NoSolution - where the radius is below the roller's at the start already
    Example
        >>> from gearlink.core.wide_swing.elastic_law import ElasticLaw, Pneumatic
        >>> law = ElasticLaw(Pneumatic(2.5), math.radians(120))
        >>> round(undercut_start(WideSwingCam("twin-cam", law, math.radians(120), 200.0, 8.0)), 9)
        0.471778076
    """
    limit = cam.center_distance / cam.roller_radius

    def excess(k: float) -> float:
        return cam.sense * float(cam.curve.curvature(cam.curve.state(np.array([k])))[0]) - limit

    if excess(0.0) >= 0.0:
        raise NoSolution(
            f"roller radius {cam.roller_radius:.6g} mm: the pitch curve's radius at the start is "
            f"{abs(cam.start_curvature_radius):.6g} mm; make the roller smaller or the centre distance larger"
        )
    return bracketed_root(excess, 0.0, 0.5 - 1e-9)


def contact_end(cam: WideSwingCam) -> float:
    """Fraction of the stroke where the roller leaves the profile, whose rest its slot at mid-swing has cut away.

    |z(k) + r_p n(k) - z(1/2)| = r_p

    Parameters
        cam : WideSwingCam
    Returns
        k : float - below 1/2; the mirror image 1 - k is where contact begins again
    Raises
        NoSolution - where the roller at mid-swing reaches the start of the profile, or is too large there
    Notes
        1/2 - k is 4/3 of 1/2 - undercut_start as the roller radius tends to zero. With a rocker radius below that of
        (18), (24) the pitch curve turns smoothly at mid-swing; 1/2 where nothing is cut away then.
    Example
        >>> from gearlink.core.wide_swing.elastic_law import ElasticLaw, Pneumatic
        >>> law = ElasticLaw(Pneumatic(2.5), math.radians(120))
        >>> round(contact_end(WideSwingCam("twin-cam", law, math.radians(120), 200.0, 8.0)), 9)
        0.462338155
    """
    middle = -(1.0 - cam.ratio)
    diameter = 2.0 * cam.roller_radius / cam.center_distance

    def clearance(k: float) -> float:
        state = cam.curve.state(np.array([k]))
        step = complex(cam.curve.pitch(state)[0]) - middle
        normal = cam.sense * complex(cam.curve.normal(state)[0])
        return abs(step) ** 2 + diameter * (step * normal.conjugate()).real

    if cam.rocker_radius < cam.nominal_rocker_radius:
        return _first_fall(clearance)
    if clearance(0.0) <= 0.0:
        raise NoSolution(
            f"roller radius {cam.roller_radius:.6g} mm: the roller at mid-swing covers the start of the profile; "
            "make it smaller or the centre distance larger"
        )
    return bracketed_root(clearance, 0.0, undercut_start(cam))


def _first_fall(clearance: Callable[[float], float]) -> float:
    """The first place before mid-swing where the clearance falls below 0, or 1/2."""
    last = 0.0
    for i in range(1, 60):
        k = 0.5 - 0.5 * 0.7**i
        if clearance(k) < 0.0:
            return bracketed_root(clearance, last, k)
        last = k
    return 0.5


def start_radius_estimate(cam: WideSwingCam, k: float = 0.1) -> float:
    """The dissertation's estimate of the curvature radius at the start of the stroke.

    R = (rho0^2 + rho1^2 - 2 rho0 rho1 cos M)/(2 (rho0 - rho1 cos M)), M = Theta(k) - Theta(0)

    Parameters
        cam : WideSwingCam
        k : float - the second point of the circle, the dissertation's is 0.1
    Returns
        R : float [mm] - negative with the centre away from the cam axis
    Raises
        NoSolution - for a profile that does not exist
    Notes
        A circle centred on the first radius; 3 % above to 11 % below `start_curvature_radius` for a twin-cam,
        no use for a twin-rocker.
    Example
        >>> from gearlink.core.wide_swing.elastic_law import ElasticLaw, Pneumatic
        >>> law = ElasticLaw(Pneumatic(2.5), math.radians(120))
        >>> round(start_radius_estimate(WideSwingCam("twin-cam", law, math.radians(120), 200.0, 8.0)), 9)
        91.984628813

    Source
        wide-swing dissertation (23)
    """
    points = cam.points(np.array([0.0, k]))
    start, other = (float(x) for x in np.abs(points.pitch))
    versed = 2.0 * math.sin(0.5 * float(points.polar_angle[1] - points.polar_angle[0])) ** 2
    drop = start - other
    return (drop * drop + 2.0 * start * other * versed) / (2.0 * (drop + other * versed))


def middle_radius_estimate(cam: WideSwingCam, k: float = 0.45) -> float:
    """The dissertation's estimate of the curvature radius at mid-swing.

    R = (rho_k^2 + rho_m^2 - 2 rho_k rho_m cos M)/(2 rho_k sin M), M = |Theta(k)|

    Parameters
        cam : WideSwingCam
        k : float - the second point of the circle, the dissertation's is 0.45
    Returns
        R : float [mm]
    Raises
        NoSolution - for a profile that does not exist
    Notes
        The circle tangent to the radial line at mid-swing. The true radius falls to zero there; this is 3/8 of the
        true one at k, and equal to it near k = 0.481.
    Example
        >>> from gearlink.core.wide_swing.elastic_law import ElasticLaw, Pneumatic
        >>> law = ElasticLaw(Pneumatic(2.5), math.radians(120))
        >>> round(middle_radius_estimate(WideSwingCam("twin-rocker", law, math.radians(80), 200.0, 4.0)), 9)
        4.696585663

    Source
        wide-swing dissertation (27)
    """
    points = cam.points(np.array([k]))
    rho, angle = abs(complex(points.pitch[0])), abs(float(points.polar_angle[0]))
    drop, middle = rho - cam.middle_radius, cam.middle_radius
    square = drop * drop + 4.0 * rho * middle * math.sin(0.5 * angle) ** 2
    return square / (2.0 * rho * math.sin(angle))
