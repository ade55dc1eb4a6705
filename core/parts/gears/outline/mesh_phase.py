"""How the teeth of gears in mesh stand to each other while their axes move."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from gearlink.core.numerics.arrays import Reals


def driven_turn(teeth: tuple[int, int], line_of_centres: ArrayLike, turn: ArrayLike) -> Reals:
    """Place of the second gear of an external mesh for a place of the first.

    z_1 (t_1 - psi) + z_2 (t_2 - psi - pi) = -pi

    Parameters
        teeth : (int, int) - z_1, z_2
        line_of_centres : array [rad] - psi, direction from the first axis to the second; continuous over a motion
        turn : array [rad] - t_1, direction of the middle of a tooth space of the first gear
    Returns
        turn : array [rad] - t_2, direction of the middle of a tooth space of the second gear
    Notes
        A tooth of gear 1 on the line of centres stands in the middle of a space of gear 2; from there both roll. In a
        mesh without backlash both flanks then touch.
    Example
        >>> round(float(driven_turn((20, 40), 0.0, -math.pi / 20)), 9)
        3.141592654

    Source
        own derivation: rolling of the working circles, counted from the line of centres
    """
    z1, z2 = teeth
    psi, first = np.asarray(line_of_centres, dtype=float), np.asarray(turn, dtype=float)
    return np.asarray(psi + math.pi - (math.pi + z1 * (first - psi)) / z2)


def ring_turn(teeth: tuple[int, int], line_of_centres: ArrayLike, turn: ArrayLike) -> Reals:
    """Place of a ring gear for a place of the gear inside it.

    z_1 (t_1 - psi) = z_2 (t_2 - psi)

    Parameters
        teeth : (int, int) - z_1 of the gear, z_2 of the ring
        line_of_centres : array [rad] - psi, direction from the ring's axis to that of the gear; continuous
        turn : array [rad] - t_1, direction of the middle of a tooth space of the gear
    Returns
        turn : array [rad] - t_2, direction of the middle of a tooth of the ring
    Example
        >>> round(float(ring_turn((20, 40), 0.0, math.pi / 20)), 9)
        0.078539816

    Source
        own derivation, as `driven_turn`
    """
    z1, z2 = teeth
    psi, first = np.asarray(line_of_centres, dtype=float), np.asarray(turn, dtype=float)
    return np.asarray(psi + z1 * (first - psi) / z2)
