"""Frames of the momentary dwell of a three-gear four-bar, for many designs."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.three_gear.dwell.momentary_dwell import angle_of_poles, pole_lengths, touching
from gearlink.core.numerics.arrays import Mask, Reals
from gearlink.core.numerics.elementary_sweep import ARRAYS

_BLOCK = 8192


@dataclass(frozen=True, slots=True)
class MomentaryDwells:
    """Momentary-dwell designs: frame length [mm], crank angle of the standstill [rad], both NaN where not `exists`."""

    frame: Reals
    crank_angle: Reals
    exists: Mask


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
        own derivation; scalar form in `gearlink.core.machines.three_gear.dwell.momentary_dwell`
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
    u, v = pole_lengths(r1, r3, r5, ARRAYS)
    share = (r1 / (u + v)) ** 2
    s = r1 + 2.0 * r3 + r5
    e_lo = share * s
    exists: Mask = (e_lo < e) & (e < r1 - 2.0 * np.maximum(0.0, r1 - r5) * share)
    found = touching(r1, r3, r5, e, e_lo, ARRAYS)
    x = found.cos_beta
    turned = angle_of_poles(r1, r5, s * x, e_lo * x, found.sin_beta, ARRAYS)
    np.add(turned, 2.0 * math.pi, out=turned, where=turned < 0.0)
    frame[:], angle[:] = found.frame, turned
    if not exists.all():
        frame[~exists] = angle[~exists] = math.nan
    return exists
