"""The output of a three-gear four-bar over arrays of crank angles, from the four-bar's kernel: a second way."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from gearlink.core.machines.three_gear.train import GearTrain
from gearlink.core.numerics.arrays import Reals
from gearlink.core.parts.linkages.fourbar import position as fourbar
from gearlink.core.parts.linkages.fourbar import sweep as fourbar_sweep
from gearlink.core.parts.linkages.fourbar.position import FourBar
from gearlink.core.parts.linkages.fourbar.sweep import dead_point_distance


@dataclass(frozen=True, slots=True)
class OutputMotion:
    """Motion over crank angles, fields of their shape.

    output_angle [rad] (0 at crank angle 0, continuous), speed_ratio, acceleration_ratio [1/rad],
    transmission_angle [rad] (0..pi/2)
    """

    output_angle: Reals
    speed_ratio: Reals
    acceleration_ratio: Reals
    transmission_angle: Reals


def output_motion(linkage: FourBar, train: GearTrain, crank_angle: ArrayLike) -> OutputMotion:
    """Output angle, speed and acceleration ratio and transmission angle over an array of crank angles.

    phi5 = I phi + (1 - i2) i3 t2 + (1 - i3) t3, and its first and second derivative with respect to phi

    Parameters
        linkage : FourBar
        train : GearTrain
        crank_angle : array of any shape [rad]
    Returns
        motion : OutputMotion
    Raises
        NoSolution - when the linkage does not close, or stands in a dead centre, at one of the angles
    Notes
        By the four-bar's kernel alone, without links.
    Source
        thesis (4-23)..(4-25)
    """
    phi = np.asarray(crank_angle, dtype=float)
    state, start = fourbar_sweep.solve(linkage, phi, 2), fourbar.solve(linkage, 0.0)
    p, q = train.coupler_share, train.rocker_share
    coupler, rocker = state.coupler_angle - start.coupler_angle, state.rocker_angle - start.rocker_angle
    return OutputMotion(
        train.ratio * phi + p * coupler + q * rocker,
        train.ratio + p * state.coupler_velocity + q * state.rocker_velocity,
        p * state.coupler_acceleration + q * state.rocker_acceleration,
        dead_point_distance(state.transmission_angle),
    )
