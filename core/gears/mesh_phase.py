"""How the teeth of gears in mesh stand to each other while their axes move."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from gearlink.core.gears.internal_mesh import InternalMesh
from gearlink.core.gears.involute import involute
from gearlink.core.gears.pair import GearPair
from gearlink.core.gears.ring_cutter import ShapedRing
from gearlink.core.numerics.arrays import Points, Reals


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


def ring_outline(mesh: InternalMesh, points_on_flank: int = 6) -> Points:
    """Inner outline of a ring gear with involute flanks, closed; the x axis is the middle of a tooth.

    z(t) = r_b (1 - i t) exp(i (pi/(2 z) - inv(alpha) + t)),   tan(alpha_a2) <= t <= tan(alpha_f2)

    Parameters
        mesh : InternalMesh
        points_on_flank : int - at least 2
    Returns
        points : (N,) array [mm] - counter-clockwise
    Raises
        NoSolution - where the ring's tips lie inside its base circle
    Example
        >>> ring = ring_outline(InternalMesh(2.0, (48, 62)))
        >>> round(float(abs(ring).min()), 9), round(float(abs(ring).max()), 9)
        (60.0, 64.5)

    Source
        own derivation: the space of the ring is the tooth of an outer gear of as many teeth
    """
    z, alpha = mesh.teeth[1], mesh.pressure_angle
    at_base = math.pi / (2.0 * z) - (math.tan(alpha) - alpha)
    base, tip, root = mesh.base_radius[1], mesh.tip_radius[1], mesh.root_radius[1]
    return _ring_teeth(z, at_base, (base, tip, root), math.tan(mesh.tip_pressure_angle[1]), points_on_flank)


def ring_of(pair: GearPair, points_on_flank: int = 12) -> Points:
    """Inner outline of the ring of a pair in the transverse section, closed; the x axis is the middle of a tooth.

    Parameters
        pair : GearPair - with a ring as gear 2
        points_on_flank : int - at least 2
    Returns
        points : (N,) array [mm] - counter-clockwise; root corners are sharp where no cutter is known
    Raises
        NoSolution - where the ring's tips lie inside its base circle
    Example
        >>> ring = ring_of(GearPair(module=2.0, teeth=(48, -62), given_shift=(0.0, 0.0)))
        >>> round(float(abs(ring).min()), 9), round(float(abs(ring).max()), 9)
        (60.0, 64.5)

    Source
        own derivation: the space of the ring is the tooth of an outer gear of as many teeth and the opposite shift
    """
    z, alpha = -pair.teeth[1], pair.transverse_pressure_angle
    half_tooth = (math.pi / 2.0 + 2.0 * pair.profile_shift[1] * math.tan(pair.pressure_angle)) / z
    radii = -pair.base_radius[1], -pair.tip_radius[1], -pair.root_radius[1]
    low = math.tan(pair.tip_pressure_angle[1])
    return _ring_teeth(z, half_tooth - involute(alpha), radii, low, points_on_flank, pair.shaped)


def signed_pair(mesh: GearPair | InternalMesh) -> GearPair:
    """A mesh as a gear pair whose ring, where it has one, has negative teeth.

    Example
        >>> signed_pair(InternalMesh(2.0, (48, 62))).center_distance
        -14.0

    Source
        ISO 21771, whose signs of a ring are those of `GearPair`
    """
    if isinstance(mesh, GearPair):
        return mesh
    return GearPair(
        module=mesh.module,
        teeth=(mesh.teeth[0], -mesh.teeth[1]),
        pressure_angle=mesh.pressure_angle,
        given_shift=(0.0, 0.0),
        addendum=mesh.addendum,
        clearance=mesh.clearance,
    )


def _ring_teeth(
    z: int,
    at_base: float,
    radii: tuple[float, float, float],
    low: float,
    points_on_flank: int,
    shaped: ShapedRing | None = None,
) -> Points:
    """Outline of a ring: half a tooth's angle on the base circle, its radii (base, tip, root) and the tip's roll."""
    base, tip, root = radii
    end = root if shaped is None else shaped.form_radius
    high = math.sqrt((end / base - 1.0) * (end / base + 1.0))
    roll = np.linspace(low, high, points_on_flank)
    flank = base * (1.0 - 1j * roll) * np.exp(1j * (at_base + roll))
    fillet: list[complex] = []
    if shaped is not None:
        middle = np.exp(1j * math.pi / z)
        fillet = [
            middle * shaped.fillet(turn).conjugate() for turn in np.linspace(*shaped.turns[::-1], points_on_flank)
        ]
    half = np.concatenate([[tip + 0j], flank, fillet, [root * np.exp(1j * math.pi / z)]])
    tooth = np.concatenate([half[:0:-1].conj(), half[:-1]])
    turns = np.exp(2j * math.pi / z * np.arange(z))
    ring: Points = (turns[:, None] * tooth[None, :]).ravel()
    return np.concatenate([ring, ring[:1]])
