"""Springs that hold a translating follower on its cam: preload, and the speed at which it lifts off.

N cos(alpha) = F_0 + k s + m s'' Om^2 + F_ext: linear in Om^2, so that the worst speed is 0 or the greatest.
"""

from __future__ import annotations

import math

import numpy as np

from gearlink.core.numerics.arrays import Reals


def requirement(
    lift: Reals, acceleration: Reals, mass: float, speed: float, least: float, external: Reals | float = 0.0
) -> Reals:
    """Spring force that keeps the contact at every speed up to the greatest [N].

    max(F_min - F_ext, F_min - F_ext - m s'' Om^2)

    Parameters
        lift, acceleration : (N,) arrays [m, m/rad^2] - s and s'' by the cam angle
        mass : float [kg]
        speed : float [rad/s] - Om, greatest speed of the cam
        least : float [N] - F_min, contact force that must remain
        external : float or (N,) array [N] - F_ext, pressing on the cam
    """
    static = least - np.asarray(external) + np.zeros_like(lift)
    return np.asarray(np.maximum(static, static - mass * acceleration * speed * speed))


def preload(
    lift: Reals,
    acceleration: Reals,
    mass: float,
    speed: float,
    rate: float,
    least: float,
    external: Reals | float = 0.0,
) -> float:
    """Least preload of a spring of given rate [N].

    F_0 = max over the cycle of (requirement - k s)

    Parameters
        rate : float [N/m] - k; the others as of `requirement`
    Example
        >>> angle = np.linspace(0.0, 2.0 * math.pi, 721)
        >>> lift, bend = 0.01 * (1.0 - np.cos(angle)), 0.01 * np.cos(angle)
        >>> round(preload(lift, bend, 2.0, 20.0, 0.0, 30.0), 9)
        38.0
    """
    return float(np.max(requirement(lift, acceleration, mass, speed, least, external) - rate * lift))


def lift_off_speed(
    lift: Reals, acceleration: Reals, mass: float, preload: float, rate: float, external: Reals | float = 0.0
) -> float:
    """Speed of the cam at which the follower leaves it [rad/s]; inf where nothing lifts it.

    Om^2 = min over s'' < 0 of (F_0 + k s + F_ext)/(-m s'')
    """
    lifting = acceleration < 0.0
    if not np.any(lifting) or mass == 0.0:
        return math.inf
    force = preload + rate * lift + np.asarray(external)
    return math.sqrt(max(0.0, float(np.min(force[lifting] / (-mass * acceleration[lifting])))))
