"""Contact of a wide-swing roller about mid-swing: its exact end, and the dissertation's estimates of curvature."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_below
from gearlink.core.numerics.extremes import maximum_over
from gearlink.core.numerics.roots import bracketed_root

if TYPE_CHECKING:
    from gearlink.core.machines.wide_swing.cams.cam import WideSwingCam
    from gearlink.core.numerics.arrays import Reals

Step: TypeAlias = Callable[["Reals"], tuple["Reals", "Reals"]]

_SMALLEST = 1e-4
"""Below this share of the stroke the leading order, good to the square of the zone, is nearer than the solution."""
_SHRINK = 0.7
_SETTLED = 1e-13
_BESIDE = 0.01
"""Share of the way to mid-swing below which a step is too short to tell the bend between its ends."""
_KNOWN = 1e-16
"""Fractions of the stroke are known no better."""


def covered(step: Step, roller_radius: float, far: float, estimate: float | None, noise: float = 0.0) -> float:
    """Part of the stroke beside a stop of the pitch curve over which the roller, standing there, covers the profile.

    |z + r_p n - z(stop)| = r_p

    Parameters
        step : function of parts t of the stroke from the stop, an array - lengths of the pitch point's way from the
            stop, and their components against the profile's normal [mm]
        roller_radius : float [mm]
        far : float - t at which the profile must be free
        estimate : float or None - leading order at a cusp; None where the pitch curve runs smoothly
        noise : float - rounding of t times t, where steps are differences of places
    Returns
        t : float - 0 where nothing is covered
    Raises
        NoSolution - where the profile is covered as far as `far`
    Notes
        At a cusp t has a relative error of at most 1e-7, at t = 1e-4.
    """
    if estimate is not None and estimate < _SMALLEST:
        return estimate

    def clearance(t: Reals) -> Reals:
        length, depth = step(t)
        room: Reals = length * length - 2.0 * roller_radius * depth
        return room

    nearest = min(_SHRINK * far, 0.01 * (_SMALLEST if estimate is None else estimate))
    t: Reals = np.float64(far) * np.power(_SHRINK, np.arange(math.ceil(math.log(nearest / far, _SHRINK)) + 1))
    room = clearance(t)
    if room[0] <= 0.0:
        most = fitting_roller(*(float(part[0]) for part in step(t[:1])))
        raise NoSolution(
            (f"roller radius {roller_radius:.6g} mm: where the roller is at rest it covers the whole profile"),
            fix=f"make it less than {safely_below(most)} mm, or the centre distance larger",
        )
    within = np.flatnonzero(room < 0.0)
    if not within.size:
        return 0.0
    (low, high), ends = (rows[[within[0], within[0] - 1]].tolist() for rows in (t, room))
    known = _KNOWN + noise / low
    return bracketed_root(lambda part: float(clearance(np.array([part]))[0]), low, high, tolerance=known, ends=ends)


def fitting_roller(length: float, depth: float) -> float:
    """Radius of the roller that is just free of the profile after a step from its stop [mm]; infinite where all are.

    r_p = |d|^2/(-2 d n)

    Parameters
        length, depth : float [mm] - |d| and -d n of the step
    """
    return length * length / (2.0 * depth) if depth > 0.0 else math.inf


def contact_end(cam: WideSwingCam) -> float:
    """Fraction of the stroke where the roller leaves the profile, whose rest its slot at mid-swing has cut away.

    Parameters
        cam : WideSwingCam
    Returns
        k : float - at most 1/2; the mirror image 1 - k is where contact begins again
    Raises
        NoSolution - where the roller at mid-swing covers the start of the profile, or the pitch curve has a loop
    Notes
        With a rocker radius below that of (18), (24) the pitch curve turns smoothly at mid-swing; 1/2 where the
        roller, standing there, cuts nothing away. Where it does, it cuts more just before mid-swing.
    Example
        >>> from gearlink.core.machines.wide_swing.cams.cam import WideSwingCam
        >>> from gearlink.core.machines.wide_swing.law.elastic_law import ElasticLaw, Pneumatic
        >>> law = ElasticLaw(Pneumatic(2.5), math.radians(120))
        >>> round(contact_end(WideSwingCam("twin-cam", law, math.radians(120), 200.0, 8.0)), 9)
        0.462338155
    """
    smooth = cam.rocker_radius < cam.nominal_rocker_radius
    estimate = None if smooth else cam.transition_zone_estimate
    end = 0.5 - covered(partial(middle_step, cam), cam.roller_radius, 0.5, estimate)
    return _cut_on_the_way(cam, end) if smooth and end < 0.5 else end


def _cut_on_the_way(cam: WideSwingCam, end: float) -> float:
    """Where the profile of a smooth bend ends, which the roller on its way to mid-swing cuts deeper than at rest."""

    def room(k: float) -> float:
        return roller_before_middle(cam, k) - cam.roller_radius

    high, low = end, _SHRINK * end
    while room(low) <= 0.0 and low > _SMALLEST:
        high, low = low, _SHRINK * low
    return bracketed_root(room, low, high, tolerance=_SETTLED) if room(high) < 0.0 < room(low) else high


def roller_before_middle(cam: WideSwingCam, k: float) -> float:
    """Largest roller that leaves the profile at k free on the rest of its way to mid-swing [mm].

    r_p = min over t of |d|^2/(-2 d n), d = z(k) - z(t), k < t <= 1/2

    Parameters
        cam : WideSwingCam
        k : float - below 1/2
    Returns
        r_p : float [mm] - infinite where every roller does
    """
    here = cam.curve.state(np.array([k]))
    place, normal = cam.curve.pitch(here)[0], cam.sense * np.conj(cam.curve.normal(here)[0])

    def needed(part: Reals) -> Reals:
        step = place - cam.curve.pitch(cam.curve.state(k + (0.5 - k) * part))
        found: Reals = -2.0 * (step * normal).real / np.abs(step) ** 2
        return found

    bend = maximum_over(needed, _BESIDE, 1.0, samples=256).value
    return cam.center_distance / bend if bend > 0.0 else math.inf


def middle_step(cam: WideSwingCam, t: Reals) -> tuple[Reals, Reals]:
    """Lengths of the pitch point's steps to mid-swing from t before it, and their parts along the profile's normal
    [mm]."""
    state = cam.curve.state(0.5 - t)
    # z(k) - z(1/2) in terms that vanish at mid-swing, each of them exact
    half = np.exp(0.5j * state.theta)
    turned = -2j * np.sin(0.5 * state.theta) * half * (1.0 - cam.ratio)
    step = turned + cam.ratio * half * half * (1j * np.sin(state.psi) - state.s)
    size = cam.center_distance
    return size * np.abs(step), -size * cam.sense * (step * np.conj(cam.curve.normal(state))).real


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
        >>> from gearlink.core.machines.wide_swing.cams.cam import WideSwingCam
        >>> from gearlink.core.machines.wide_swing.law.elastic_law import ElasticLaw, Pneumatic
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
        >>> from gearlink.core.machines.wide_swing.cams.cam import WideSwingCam
        >>> from gearlink.core.machines.wide_swing.law.elastic_law import ElasticLaw, Pneumatic
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
