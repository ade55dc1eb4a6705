"""What an error of a link costs at the rocker of a four-bar: the linear map of its loop, and the loop closed anew."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlink.core.numerics.arrays import Points, Reals


@dataclass(frozen=True, slots=True)
class LoopGains:
    """Turn of the rocker per mm of each cause, the crank held; (N,) arrays.

    Real [rad/mm]: crank, coupler, rocker, frame. Complex: pin, of an error vector v of the loop (A, B or C moved on by
    v; D back), the rocker turns by Re(v pin).
    """

    crank: Reals
    coupler: Reals
    rocker: Reals
    frame: Reals
    pin: Points


def loop_gains(crank_angle: Reals, coupler_angle: Reals, rocker_angle: Reals, rocker: float) -> LoopGains:
    """Gains of a closed loop a e1 + b e2 = d + c e3.

    d t3 = Re(eps conj(e2))/(c sin(t2 - t3)),   eps = da e1 + db e2 - dc e3 - dd + v

    Parameters
        crank_angle, coupler_angle, rocker_angle : (N,) arrays [rad] - from the line A-D
        rocker : float [mm] - c
    Returns
        gains : LoopGains
    Notes
        1/sin(t2 - t3) is the condition of the loop, infinite in a dead centre.
    Example
        >>> from gearlink.core.parts.linkages.fourbar import sweep
        >>> from gearlink.core.parts.linkages.fourbar.position import FourBar
        >>> angles = np.array([1.0])
        >>> state, longer = (sweep.solve(FourBar(18.0, 50.0 + d, 100.0, 121.4), angles) for d in (0.0, 1e-6))
        >>> slope = (longer.rocker_angle - state.rocker_angle) / 1e-6
        >>> gains = loop_gains(angles, state.coupler_angle, state.rocker_angle, 100.0)
        >>> bool(abs(gains.coupler - slope)[0] < 1e-8)
        True

    Source
        own derivation: the loop differentiated and crossed with the coupler
    """
    lever = rocker * np.sin(coupler_angle - rocker_angle)
    pin: Points = np.exp(-1j * coupler_angle) / lever
    return LoopGains(
        crank=np.cos(crank_angle - coupler_angle) / lever,
        coupler=1.0 / lever,
        rocker=-np.cos(rocker_angle - coupler_angle) / lever,
        frame=-pin.real,
        pin=pin,
    )


def closed_pin(start: Points, end: Points, first: Reals | float, second: Reals | float, side: int) -> Points:
    """Pin of two links between points, many at once.

    Parameters
        start, end : complex arrays [mm] - that broadcast, with the lengths too
        first, second : float or array [mm] - length of the link from start, of that from end
        side : +1 or -1 - +1: the pin lies left of the line from start to end
    Returns
        pin : complex array [mm] - NaN where the links do not reach
    Example
        >>> closed_pin(np.array([0j]), np.array([6.0 + 0j]), 5.0, 5.0, 1).tolist()
        [(3+4j)]

    Source
        own derivation: the triangle of the links and the distance
    """
    line = end - start
    length = np.abs(line)
    along = (length * length + (first - second) * (first + second)) / (2.0 * length)
    with np.errstate(invalid="ignore"):
        across = side * np.sqrt((first - along) * (first + along))
    pin: Points = start + (along + 1j * across) * line / length
    return pin
