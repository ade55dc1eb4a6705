"""The motion of every link of a four-bar over a turn of its crank, as columns of a table."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from gearlink.core.linkages.fourbar import sweep as fourbar_sweep

if TYPE_CHECKING:
    from gearlink.core.linkages.fourbar.position import FourBar
    from gearlink.core.numerics.arrays import Reals

Motion: TypeAlias = tuple[Any, Any, Any, Any]
"""Angle [rad] and its first three derivatives with respect to the crank angle."""
_RATES = ("speed", "acceleration", "jerk")


def four_bar_motions(linkage: FourBar, crank_angle: Reals) -> dict[str, Motion]:
    """Angle, speed, acceleration and jerk of coupler and rocker.

    Parameters
        linkage : FourBar - whose crank turns fully
        crank_angle : (N,) array [rad]
    Returns
        motions : dict - "coupler" and "rocker", each four (N,) arrays per radian of the crank
    Raises
        NoSolution - where the linkage does not close
    Example
        >>> from gearlink.core.linkages.fourbar.position import FourBar
        >>> rocker = four_bar_motions(FourBar(18.0, 50.0, 100.0, 121.4), np.radians([0.0, 90.0]))["rocker"]
        >>> np.round(rocker[1], 9).tolist()
        [-0.174081238, 0.135008599]

    Source
        own derivation: the loop of the four-bar, differentiated three times
    """
    state = fourbar_sweep.solve(linkage, crank_angle, 3)
    return {
        "coupler": (state.coupler_angle, state.coupler_velocity, state.coupler_acceleration, state.coupler_jerk),
        "rocker": (state.rocker_angle, state.rocker_velocity, state.rocker_acceleration, state.rocker_jerk),
    }


def combined(*parts: tuple[float, Motion]) -> Motion:
    """A motion that is a sum of others, each with a factor; none of them may be left out.

    Example
        >>> combined((2.0, (1.0, 1.0, 0.0, 0.0)), (-1.0, (0.5, 0.0, 3.0, 0.0)))
        (1.5, 2.0, -3.0, 0.0)
    """
    return tuple(sum(factor * motion[order] for factor, motion in parts) for order in range(4))


def columns(motions: Mapping[str, Motion]) -> tuple[dict[str, tuple[Any, str]], dict[str, tuple[str, int]]]:
    """Columns of a table for the motions of some links, and the rates that become real with the input's speed.

    Returns
        columns : name -> (data, unit) - `coupler_angle` [deg], `coupler_speed_ratio`, `..._acceleration_ratio`, ...
        rates : new name -> (column, order), as `RealSpeed.timed` takes them
    """
    found: dict[str, tuple[Any, str]] = {}
    rates: dict[str, tuple[str, int]] = {}
    for name, (angle, *derivatives) in motions.items():
        found[f"{name}_angle"] = (np.degrees(angle), "deg")
        for order, (rate, data) in enumerate(zip(_RATES, derivatives, strict=True), 1):
            found[f"{name}_{rate}_ratio"] = (data, "1")
            rates[f"{name}_{rate}"] = (f"{name}_{rate}_ratio", order)
    return found, rates
