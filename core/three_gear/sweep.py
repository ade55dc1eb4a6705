"""The three-gear four-bar over arrays: motion over a turn, and the closed forms of the synthesis for many designs."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from gearlink.core.errors import NoSolution
from gearlink.core.linkages import fourbar, fourbar_sweep
from gearlink.core.linkages.fourbar import FourBar
from gearlink.core.linkages.fourbar_refine import dead_point_distance
from gearlink.core.numerics.arrays import Mask, Reals
from gearlink.core.numerics.gauss import GAUSS_NODES, GAUSS_WEIGHTS
from gearlink.core.three_gear.dwell_angle_sweep import regained
from gearlink.core.three_gear.motion import GearTrain
from gearlink.core.three_gear.symmetric_many import newton

_BLOCK = 8192
_INTEGRAL_BELOW = 0.2  # h [rad], as in `gearlink.core.three_gear.symmetric_back_step`
_FAR_FROM_1 = -0.5  # i3 above which small dwell angles need the integral
_NODES = np.array([-x for x in reversed(GAUSS_NODES)] + list(GAUSS_NODES))
_WEIGHTS = np.array([*reversed(GAUSS_WEIGHTS), *GAUSS_WEIGHTS])


@dataclass(frozen=True, slots=True)
class OutputMotion:
    """Motion over crank angles, fields of their shape.

    crank_angle [rad], output_angle [rad] (0 at crank angle 0, continuous), speed_ratio, acceleration_ratio [1/rad],
    transmission_angle [rad] (0..pi/2)
    """

    crank_angle: Reals
    output_angle: Reals
    speed_ratio: Reals
    acceleration_ratio: Reals
    transmission_angle: Reals


@dataclass(frozen=True, slots=True)
class MomentaryDwells:
    """Momentary-dwell designs: frame length [mm], crank angle of the standstill [rad], both NaN where not `exists`."""

    frame: Reals
    crank_angle: Reals
    exists: Mask


def output_motion(linkage: FourBar, train: GearTrain, crank_angle: ArrayLike) -> OutputMotion:
    """Output angle, speed and acceleration ratio and transmission angle over an array of crank angles.

    phi5 = I phi + (1 - i2) i3 t2 + (1 - i3) t3, and its first and second derivative after phi

    Parameters
        linkage : FourBar
        train : GearTrain
        crank_angle : array of any shape [rad]
    Returns
        motion : OutputMotion
    Raises
        NoSolution - when the linkage does not close, or stands in a dead point, at one of the angles
    Notes
        Agrees with `gearlink.core.three_gear.motion` to a few ulp times the condition number.
    Example
        >>> motion = output_motion(FourBar(18.0, 50.0, 100.0, 121.4), GearTrain(20, 20, 60), np.radians([0.0, 90.0]))
        >>> np.round(motion.speed_ratio, 9).tolist()
        [0.217279175, 0.724759]

    Source
        thesis (4-23)..(4-25)
    """
    phi = np.asarray(crank_angle, dtype=float)
    state, start = fourbar_sweep.solve(linkage, phi, 2), fourbar.solve(linkage, 0.0)
    p, q = train.coupler_share, train.rocker_share
    coupler, rocker = state.coupler_angle - start.coupler_angle, state.rocker_angle - start.rocker_angle
    return OutputMotion(
        phi,
        train.ratio * phi + p * coupler + q * rocker,
        train.ratio + p * state.coupler_velocity + q * state.rocker_velocity,
        p * state.coupler_acceleration + q * state.rocker_acceleration,
        dead_point_distance(state.transmission_angle),
    )


def momentary_dwells(r1: ArrayLike, r3: ArrayLike, r5: ArrayLike, eccentricity: ArrayLike) -> MomentaryDwells:
    """Frame length and crank angle of the momentary dwell for many gears and cranks.

    d*^2 = (S - e_lo)^2 cos^2(beta) + r5^2 sin^2(beta),   cos^2(beta) = (r1^2 - e^2)/(r1^2 - e_lo^2)

    Parameters
        r1, r3, r5, eccentricity : arrays that broadcast [mm] - positive
    Returns
        dwells : MomentaryDwells - `exists` where a crank-rocker has one: e_lo < e < e_up as in
            `momentary_dwell.eccentricity_range`; assembly +1
    Raises
        NoSolution - for a length that is not positive and finite
    Example
        >>> found = momentary_dwells(25.0, 25.0, 75.0, [5.0, 16.0, 18.0, 26.0])
        >>> found.exists.tolist(), np.round(found.frame[1:3], 9).tolist()
        ([False, True, True, False], [122.839414792, 115.522215625])

    Source
        own derivation; scalar form in `gearlink.core.three_gear.momentary_dwell`
    """
    arrays = np.broadcast_arrays(*(np.asarray(x, dtype=float) for x in (r1, r3, r5, eccentricity)))
    if not all(x.size == 0 or (x.min() > 0.0 and x.max() < np.inf) for x in arrays):
        raise NoSolution("radii and eccentricities must all be positive and finite")
    shape = arrays[0].shape
    flat = [x.reshape(-1) for x in arrays]
    frame, angle, exists = np.empty(flat[0].size), np.empty(flat[0].size), np.empty(flat[0].size, dtype=bool)
    with np.errstate(invalid="ignore"):
        for start in range(0, frame.size, _BLOCK):
            block = slice(start, start + _BLOCK)
            exists[block] = _momentary_block([x[block] for x in flat], frame[block], angle[block])
    return MomentaryDwells(frame.reshape(shape), angle.reshape(shape), exists.reshape(shape))


def _momentary_block(given: list[Reals], frame: Reals, angle: Reals) -> Mask:
    """Frame lengths and crank angles of one block; NaN where there is no momentary dwell."""
    r1, r3, r5, e = given
    b, outer = r1 + r3, r3 + r5
    s = b + outer
    share = r1 / (np.sqrt(b * (b + r5)) + np.sqrt(r3 * outer))
    share *= share
    e_lo = share * s
    exists: Mask = e_lo < e
    share *= -2.0
    share *= np.maximum(0.0, r1 - r5)
    share += r1
    exists &= e < share
    span = (r1 - e_lo) * (r1 + e_lo)
    x, sine = (r1 - e) * (r1 + e), (e - e_lo) * (e + e_lo)
    for square in (x, sine):
        square /= span
        np.sqrt(square, out=square)
    reach, rise = (s - e_lo) * x, r5 * sine
    e_lo *= x
    sine *= r1
    np.subtract(np.arctan2(rise, reach), np.arctan2(sine, -e_lo), out=angle)
    np.add(angle, 2.0 * math.pi, out=angle, where=angle < 0.0)
    reach *= reach
    rise *= rise
    reach += rise
    np.sqrt(reach, out=frame)
    if not exists.all():
        frame[~exists] = angle[~exists] = math.nan
    return exists


def dwell_angles(i3: ArrayLike, back_step_crank_angle: ArrayLike) -> Reals:
    """Dwell angle phi13 of the symmetric family (I = 1) for many ratios and crank angles of the back-step.

    n [asin(k sin(y)) + asin(k sin(h))] = h + y,   phi13 = y + h,   h = phi12/2

    Parameters
        i3, back_step_crank_angle : arrays that broadcast [1, rad] - i3 < 0, 0 < phi12 < pi
    Returns
        dwell_angle : array [rad]
    Raises
        NoSolution - for a value outside its range
    Notes
        Steps of third order, all designs at once, see `gearlink.core.three_gear.dwell_angle_sweep`; Newton steps kept
        inside a bracket for those that do not settle.
    Example
        >>> np.round(np.degrees(dwell_angles([-1.0, -2.0, -3.0], math.radians(90.0))), 9).tolist()
        [131.409622109, 135.0, 136.359742972]

    Source
        own derivation; scalar form in `gearlink.core.three_gear.symmetric_back_step`
    """
    ratio, h = _pair(i3, 0.5 * np.asarray(back_step_crank_angle, dtype=float))
    if h.size and not (h.min() > 0.0 and h.max() < 0.5 * math.pi):
        raise NoSolution("crank angles of the back-step must lie above 0 and below 180 deg")
    y, settled = regained(ratio.reshape(-1), h.reshape(-1))
    if ratio.size and ratio.max() > _FAR_FROM_1:
        settled &= (ratio.ravel() <= _FAR_FROM_1) | (h.ravel() >= _INTEGRAL_BELOW)
    if not settled.all():
        rest = np.flatnonzero(~settled)
        y[rest] = _regained_by_bracket(ratio.flat[rest], h.flat[rest])
    result = y.reshape(h.shape)
    result += h
    return result


def _regained_by_bracket(ratio: Reals, h: Reals) -> Reals:
    """Where the output regains its place: Newton steps kept inside the bracket [h, 3 h]."""
    limit = 2.0 * math.pi * (1.0 - ratio) / (2.0 - ratio)
    high = np.minimum(3.0 * h, limit - h)
    return newton(_regains, h, high, np.minimum(2.0 * h, high), ratio, h)


def _regains(y: Reals, ratio: Reals, h: Reals) -> tuple[Reals, Reals]:
    return -_fallen(ratio, h, y), _speed(ratio, h, y)


def _pair(i3: ArrayLike, angle: ArrayLike) -> tuple[Reals, Reals]:
    """Ratios and angles, broadcast; ratios checked."""
    ratio, phi = np.broadcast_arrays(np.asarray(i3, dtype=float), np.asarray(angle, dtype=float))
    if ratio.size and not (ratio.min() > -np.inf and ratio.max() < 0.0):
        raise NoSolution("i3 = -z3/z5 must be negative and finite in every design: external meshes")
    return ratio, phi


def _fallen(i3: Reals, h: Reals, y: Reals) -> Reals:
    """How far the output at 270 deg + y stands below its place at 270 deg - h."""
    n = 1.0 - i3
    root = np.sqrt(i3 * (i3 - 2.0) * np.cos(h) ** 2 + np.cos(y) ** 2)
    fallen = np.asarray(n * (np.arctan2(np.sin(y), root) + np.arctan(np.tan(h) / n)) - h - y)
    small = h < _INTEGRAL_BELOW
    if np.any(small):
        fallen[small] = _fallen_by_integral(i3[small], h[small], y[small])
    return fallen


def _fallen_by_integral(i3: Reals, h: Reals, y: Reals) -> Reals:
    """The same for small h, without its cancellation: the integral of the backward speed."""
    i3, h, y = i3[:, None], h[:, None], y[:, None]
    half, at = 0.5 * (y + h), 0.5 * (y - h) + 0.5 * (y + h) * _NODES
    rest = i3 * (i3 - 2.0)
    root = np.sqrt(rest * np.cos(h) ** 2 + np.cos(at) ** 2)
    backward = rest * np.sin(h - at) * np.sin(h + at) / (root * (root + (1.0 - i3) * np.cos(at)))
    result: Reals = (half * backward) @ _WEIGHTS
    return result


def _speed(i3: Reals, h: Reals, y: Reals) -> Reals:
    """Speed ratio W at 270 deg + y, the derivative of -`_fallen` after y."""
    cos_y = np.cos(y)
    speed: Reals = 1.0 - (1.0 - i3) * cos_y / np.sqrt(i3 * (i3 - 2.0) * np.cos(h) ** 2 + cos_y**2)
    return speed
