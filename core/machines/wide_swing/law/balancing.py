"""What an unloading device does to the torques of a wide-swing mechanism over the speed.

The device is tuned to one speed n0, at which it carries the whole inertia load; at any other the drive is left
with the difference J gamma c (1/T^2 - 1/T0^2).
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.wide_swing.law.elastic_law import ElasticLaw
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.extremes import maximum_over


def stroke_time(cycle_angle: float, speed: float) -> float:
    """Time of one stroke.

    T = phi_ud/omega

    Parameters
        cycle_angle : float [rad] - phi_ud
        speed : float [rad/s] - of the cam
    Returns
        T : float [s]
    Raises
        NoSolution - when one is not positive
    Example
        >>> round(stroke_time(math.radians(120), 2 * math.pi * 1.66), 15)
        0.200803212851406

    Source
        wide-swing dissertation, chapter 2
    """
    if not (0.0 < cycle_angle < math.inf and 0.0 < speed < math.inf):
        raise NoSolution(
            f"cycle angle {math.degrees(cycle_angle):.6g} deg and speed {speed * 30.0 / math.pi:.6g} rev/min: "
            "both must be above 0"
        )
    return cycle_angle / speed


def inertia_torque_peak(inertia: float, law: ElasticLaw, time: float) -> float:
    """Largest inertia torque of the rocker over a stroke.

    M_in = J gamma C/T^2

    Parameters
        inertia : float [kg m^2] - J
        law : ElasticLaw
        time : float [s] - T of one stroke
    Returns
        torque : float [N m]
    Raises
        NoSolution - when inertia or time is not positive
    Example
        >>> from gearlink.core.machines.wide_swing.law.elastic_law import Pneumatic
        >>> law = ElasticLaw(Pneumatic(2.5), math.radians(120))
        >>> round(inertia_torque_peak(0.5, law, 0.20080321285140562), 9)
        113.235429407

    Source
        wide-swing dissertation (1)
    """
    if not (0.0 < inertia < math.inf and 0.0 < time < math.inf):
        raise NoSolution(f"moment of inertia {inertia:.6g} kg m^2 and time {time:.6g} s must both be above 0")
    return inertia * law.swing * law.acceleration_peak / time**2


def _left(speed_ratio: Reals, residual_fraction: float, reserve: float) -> Reals:
    """Torque that is left on the rocker axis, as a part of the inertia torque at n0."""
    if residual_fraction < 0.0 or reserve <= -1.0 or bool(np.any(speed_ratio < 0.0)):
        raise NoSolution("speeds and the residual fraction must be 0 or more, the reserve above -1")
    left: Reals = np.abs((speed_ratio - 1.0) * (speed_ratio + 1.0) - reserve) + residual_fraction
    return left


def speed_sweep(
    inertia: float,
    law: ElasticLaw,
    time: float,
    speed_ratio: Reals,
    residual_fraction: float = 0.0,
    reserve: float = 0.0,
) -> tuple[Reals, Reals]:
    """Torque peaks on the rocker axis with and without the device over the speed.

    M_in = J gamma C/T^2, M_1 = M_in/K_y1, K_y1 = K_y2 of `drive_balancing_ratio` with g = 0

    Parameters
        inertia : float [kg m^2] - J
        law : ElasticLaw
        time : float [s] - T0 of one stroke at the design speed
        speed_ratio : (N,) array - n/n0
        residual_fraction, reserve : float - f and rho of `drive_balancing_ratio`
    Returns
        without, with : (N,) arrays [N m] - peaks
    Raises
        NoSolution - when inertia or time is not positive, or a speed or f is negative
    Example
        >>> from gearlink.core.machines.wide_swing.law.elastic_law import Pneumatic
        >>> law = ElasticLaw(Pneumatic(2.5), math.radians(120))
        >>> without, left = speed_sweep(0.5, law, 0.20080321285140562, np.array([0.5, 1.2]))
        >>> without.round(6).tolist(), left.round(6).tolist()
        ([28.308857, 163.059018], [84.926572, 49.823589])

    Source
        wide-swing dissertation, chapter 5; own derivation
    """
    design = inertia_torque_peak(inertia, law, time)
    return design * speed_ratio**2, design * _left(speed_ratio, residual_fraction, reserve)


def power_peak(product: Callable[[Reals], Reals]) -> float:
    """Largest product of velocity invariant and torque over J gamma/T^2: the peak of the power of the inertia load.

    max |b m|, m = c of a rocker alone

    Parameters
        product : b m over fractions of the stroke
    Returns
        peak : float
    Notes
        pi^3/8 = 3.876 for the harmonic law.
    Example
        >>> from gearlink.core.machines.wide_swing.law.elastic_law import Pneumatic
        >>> law = ElasticLaw(Pneumatic(2.5), math.radians(120))
        >>> round(power_peak(lambda k: law.invariants(k)[1] * law.invariants(k)[2]), 12)
        4.608259092935
    """
    return maximum_over(lambda k: np.abs(product(k)), 0.0, 1.0, samples=256).value


def drive_balancing_ratio(
    speed_ratio: Reals, linkage_fraction: float, residual_fraction: float = 0.0, reserve: float = 0.0
) -> Reals:
    """How many times the device lowers the torque on the cam shaft.

    K_y2 = n^2 (1 + g)/(|n^2 - (1 + rho) n0^2| + f n0^2 + g n^2)

    Parameters
        speed_ratio : (N,) array - n/n0, 0 or more
        linkage_fraction : float - g, torque of the links that the device does not unload, as a part of the
            rocker's inertia torque on the same shaft and at the same speed
        residual_fraction : float - f, what friction, force error and linkage inertia leave at n0, as a part of
            the inertia torque there; 1/4.6 and 1/3.4 were measured
        reserve : float - rho, force of the device above the one that balances at n0, as a share of it
    Returns
        ratio : (N,) array - infinite at n0 when f = g = rho = 0
    Raises
        NoSolution - when a speed or g is negative
    Notes
        Assumes that both peaks fall together, so it is the minimum favourable case. g = 0 gives the ratio on the rocker
        axis: below 1, where the device harms, for n < n0 sqrt((1 + rho + f)/2).
    Example
        >>> drive_balancing_ratio(np.array([1.0]), 0.25).tolist()
        [5.0]

    Source
        wide-swing dissertation, chapter 5; own derivation
    """
    if linkage_fraction < 0.0:
        raise NoSolution("the linkage fraction must be 0 or more")
    square = speed_ratio**2
    left = _left(speed_ratio, residual_fraction, reserve) + linkage_fraction * square
    with np.errstate(divide="ignore"):
        result: Reals = square * (1.0 + linkage_fraction) / left
    return result
