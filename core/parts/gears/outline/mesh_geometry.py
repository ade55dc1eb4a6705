"""Where the teeth of a gear pair stand in mesh, also while the axes move: line of action, path of contact, both gears.

Frame: the axis of gear 1 is the origin, that of gear 2 lies on the x axis at the centre distance; points are complex
numbers x + i y. Gear 1 drives counter-clockwise, so that its upper flanks push, and a pair of flanks touches at the
pitch point.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from gearlink.core.base.results import cached_property
from gearlink.core.numerics.arrays import Reals
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.tooth.involute import involute


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


@dataclass(frozen=True)
class MeshGeometry:
    """A gear pair at the moment when two flanks touch at the pitch point.

    Returns
        Properties: points in mm, angles in rad.
    Raises
        NoSolution - from a property, where a tip circle lies inside its base circle
    Example
        >>> mesh = MeshGeometry(GearPair.from_shift(2.0, (40, 72)))
        >>> round(abs(mesh.contact_end - mesh.contact_start) / mesh.base_pitch - mesh.pair.contact_ratio, 12)
        0.0

    Source
        own derivation; ISO 21771 for the names
    """

    pair: GearPair

    @cached_property
    def axes(self) -> tuple[complex, complex]:
        """Axes of both gears [mm]."""
        return 0j, complex(self.pair.center_distance)

    @cached_property
    def pitch_point(self) -> complex:
        """Where the working circles roll on each other [mm]."""
        return complex(self.pair.working_radius[0])

    @cached_property
    def direction(self) -> complex:
        """Unit vector of the line of action, the way the contact moves: sin(alpha') + i cos(alpha')."""
        return 1j * cmath.exp(-1j * self.pair.working_pressure_angle)

    @cached_property
    def base_tangents(self) -> tuple[complex, complex]:
        """Where the line of action touches the base circles of gear 1 and gear 2 [mm]."""
        sine = math.sin(self.pair.working_pressure_angle)
        r1, r2 = self.pair.working_radius
        return self.pitch_point - r1 * sine * self.direction, self.pitch_point + r2 * sine * self.direction

    @cached_property
    def contact_start(self) -> complex:
        """Where contact begins: the line of action on the tip circle of gear 2 [mm]."""
        return self.base_tangents[0] + self.pair.interference_margin[1] * self.direction

    @cached_property
    def contact_end(self) -> complex:
        """Where contact ends: the line of action on the tip circle of gear 1 [mm]."""
        return self.base_tangents[1] - self.pair.signs[1] * self.pair.interference_margin[0] * self.direction

    @cached_property
    def base_pitch(self) -> float:
        """p_et = pi m_t cos(alpha_t) [mm], from one contact point to the next."""
        return self.pair.base_pitch

    @cached_property
    def contacts(self) -> list[complex]:
        """All points where flanks touch at this moment, along the path of contact [mm]."""
        return contact_points(self.pitch_point, self.base_pitch * self.direction, self.contact_start, self.contact_end)

    @cached_property
    def first_space(self) -> tuple[float, float]:
        """Polar angle of the middle of a tooth space of each gear, about its own axis [rad]; of a ring that of a tooth.

        half a space on the working circle = pi/z - s/(2 r cos(beta)) + inv(alpha_wt) - inv(alpha_t): above the centre
        line on gear 1, below it on gear 2
        """
        if self.pair.internal:
            return self._half_space(0), self._half_space(1) - math.pi / self.pair.teeth[1]
        return self._half_space(0), math.pi + self._half_space(1)

    def _half_space(self, gear: int) -> float:
        pair = self.pair
        tooth = pair.tooth_thickness[gear] / (2.0 * pair.reference_radius[gear] * math.cos(pair.helix_angle))
        rise = involute(pair.working_pressure_angle) - involute(pair.transverse_pressure_angle)
        return math.pi / pair.teeth[gear] - tooth + rise


def contact_points(pitch_point: complex, step: complex, start: complex, end: complex) -> list[complex]:
    """The pitch point and all places so many base pitches from it, as far as they lie between A and E [mm].

    Parameters
        step : complex [mm] - a base pitch along the line of action
        start, end : complex [mm] - A and E, which may lie on one side of the pitch point
    """
    first, last = (((place - pitch_point) / step).real for place in (start, end))
    return [pitch_point + k * step for k in range(math.ceil(first), math.floor(last) + 1)]
