"""Phases of gears in mesh: against the geometry of the mesh, and by the outlines of the teeth.

Tolerances: phases follow from a few sums of angles below 100 rad, 1e-13 of a pitch; the outlines are polygons with
a chord error of 1e-3 module each, so that flanks that touch may cross by twice that.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from matplotlib.path import Path

from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.outline.mesh_geometry import MeshGeometry, driven_turn, ring_turn
from gearlink.core.parts.gears.outline.ring_profile import RingProfile
from gearlink.core.parts.gears.outline.tooth_profile import ToothProfile, outline

_CHORD = 1e-3


def depth(points: np.ndarray, body: np.ndarray, *, inside: bool = True) -> float:
    """How deep points stand inside (or outside) a polygon."""
    path = Path(np.column_stack([body.real, body.imag]))
    near = points[path.contains_points(np.column_stack([points.real, points.imag])) == inside]
    if not near.size:
        return 0.0
    start, way = body[:-1, None], np.diff(body)[:, None]
    length = np.maximum(np.abs(way) ** 2, 1e-300)
    along = np.clip(((near[None, :] - start) * way.conj()).real / length, 0.0, 1.0)
    return float(np.abs(near[None, :] - start - along * way).min(axis=0).max())


@pytest.mark.parametrize(
    "pair",
    [
        GearPair.from_shift(2.0, (20, 41)),
        GearPair(module=4.0, teeth=(72, 72), given_distance=290.2912330746487),
        GearPair.from_shift(3.0, (14, 33), (0.4, -0.1)),
    ],
)
def test_external_phase_agrees_with_the_mesh_geometry(pair: GearPair) -> None:
    # The geometry lets flanks touch at the pitch point, the phase starts from a tooth in a space: the same mesh.
    first, second = MeshGeometry(pair).first_space
    found = float(driven_turn(pair.teeth, 0.0, first))
    pitches = (found - second) * pair.teeth[1] / (2.0 * math.pi)
    assert pitches == pytest.approx(round(pitches), abs=1e-9)


@pytest.mark.quick(2)
@pytest.mark.parametrize("place", [0.0, 0.31, 0.77, 5.2])
def test_external_teeth_touch_and_do_not_cross(place: float) -> None:
    pair = GearPair.from_shift(2.0, (20, 41))
    first, second = (outline(ToothProfile.of(pair, i), _CHORD * 2.0) for i in (0, 1))
    psi = 0.4 * place
    turn = float(driven_turn(pair.teeth, psi, place))
    gear = first * np.exp(1j * place)
    other = pair.center_distance * np.exp(1j * psi) + second * np.exp(1j * turn)
    assert depth(gear, other) < 2.0 * _CHORD * 2.0
    # Turned by a tenth of a pitch it would cross: the test can fail.
    wrong = pair.center_distance * np.exp(1j * psi) + second * np.exp(1j * (turn + 0.1 * math.pi / 20.5))
    assert depth(gear, wrong) > 10.0 * _CHORD * 2.0


@pytest.mark.quick(1)
@pytest.mark.parametrize("place", [0.0, 0.31, 0.77, 5.2])
def test_teeth_in_a_ring_touch_and_do_not_cross(place: float) -> None:
    mesh = GearPair.from_shift(2.0, (25, -75))
    pair = GearPair.from_shift(2.0, (25, 25))
    psi = 0.4 * place
    turn = float(ring_turn((25, 75), psi, place))
    planet = -mesh.center_distance * np.exp(1j * psi) + outline(ToothProfile.of(pair, 0), 2.0 * _CHORD) * np.exp(
        1j * place
    )
    ring = RingProfile(mesh).outline(40)
    # The tips of the ring reach below the involute that a rack tool leaves the planet, by half a percent of a module.
    assert depth(planet, ring * np.exp(1j * turn), inside=False) < 0.01 * mesh.module
    assert depth(planet, ring * np.exp(1j * (turn + 0.1 * math.pi / 37.5)), inside=False) > 0.05 * mesh.module


def test_a_ring_takes_its_gear_back() -> None:
    turn = ring_turn((25, 75), 0.7, 1.9)
    assert float(ring_turn((75, 25), 0.7, turn)) == pytest.approx(1.9, abs=1e-13)
