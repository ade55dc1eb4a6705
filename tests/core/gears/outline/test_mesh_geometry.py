"""Mesh geometry: line of action, path of contact, places of the teeth.

Tolerances
* identities of the line of action: 1e-12 of the centre distance, some ten operations on it.
* contact points against the outlines of the teeth: 2e-6 module, twice the chord error of the outlines.
"""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.path import Path
from sweeps import examples

from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.outline.mesh_geometry import MeshGeometry
from gearlink.core.parts.gears.outline.ring_profile import RingProfile
from gearlink.core.parts.gears.outline.tooth_profile import ToothProfile, outline

PAIRS = st.builds(
    lambda m, z1, z2, x1, x2: GearPair.from_shift(m, (z1, z2), (x1, x2)),
    st.sampled_from([1e-6, 2.5, 1e6]),
    st.integers(18, 120),
    st.integers(18, 120),
    st.floats(-0.2, 0.5),
    st.floats(-0.2, 0.5),
)


@given(PAIRS)
@examples(60)
def test_line_of_action(pair):
    mesh, near = MeshGeometry(pair), 1e-12 * pair.center_distance
    for gear in (0, 1):
        radius = mesh.base_tangents[gear] - mesh.axes[gear]
        assert abs(radius) == pytest.approx(pair.base_radius[gear], abs=near)
        assert abs((radius * mesh.direction.conjugate()).real) < near
    assert abs(mesh.contact_start - mesh.axes[1]) == pytest.approx(pair.tip_radius[1], abs=near)
    assert abs(mesh.contact_end - mesh.axes[0]) == pytest.approx(pair.tip_radius[0], abs=near)
    length = abs(mesh.contact_end - mesh.contact_start)
    assert length / mesh.base_pitch == pytest.approx(pair.contact_ratio, rel=1e-9)
    assert len(mesh.contacts) in (math.floor(pair.contact_ratio), math.ceil(pair.contact_ratio))
    assert (mesh.contact_end - mesh.contact_start).imag > 0.0


def distance(point, line):
    chord = np.diff(line)
    along = (point - line[:-1]) * chord.conj() / np.abs(chord)
    beyond = np.maximum(np.maximum(-along.real, along.real - np.abs(chord)), 0.0)
    return np.hypot(along.imag, beyond).min()


@pytest.mark.parametrize(
    ("teeth", "shift"),
    [((40, 72), (0.0, 0.0)), ((18, 31), (0.4, 0.1)), ((25, 25), (-0.1, 0.3)), ((90, 20), (0.0, 0.2))],
)
def test_both_outlines_pass_every_contact_point(teeth, shift):
    pair = GearPair.from_shift(3.0, teeth, shift)
    mesh = MeshGeometry(pair)
    assert mesh.pitch_point in mesh.contacts
    for gear in (0, 1):
        flanks = outline(ToothProfile.of(pair, gear), 3e-6, first=mesh.first_space[gear]) + mesh.axes[gear]
        for point in mesh.contacts:
            assert distance(point, flanks) < 6e-6


def to_line(point, line):
    """Distance of a point from a line of chords."""
    start, way = line[:-1], np.diff(line)
    keep = np.abs(way) > 0.0
    start, way = start[keep], way[keep]
    along = np.clip(((point - start) * way.conj()).real / np.abs(way) ** 2, 0.0, 1.0)
    return np.min(np.abs(start + along * way - point))


def test_flanks_of_a_ring_and_its_pinion_touch_and_do_not_overlap():
    """Within 2e-3 of the module, twice the chord error of both outlines."""
    pair = GearPair(module=2.0, teeth=(21, -67), given_shift=(0.3, -0.2))
    mesh = MeshGeometry(pair)
    pinion = outline(ToothProfile.of(pair, 0), 1e-3) * np.exp(1j * mesh.first_space[0])
    ring = RingProfile(pair).outline(60) * np.exp(1j * mesh.first_space[1]) + mesh.axes[1]
    assert len(mesh.contacts) >= 1
    for contact in mesh.contacts:
        assert to_line(contact, pinion) < 4e-3
        assert to_line(contact, ring) < 4e-3
    opening = Path(np.column_stack([ring.real, ring.imag]))
    outside = pinion[~opening.contains_points(np.column_stack([pinion.real, pinion.imag]))]
    assert max((to_line(point, ring) for point in outside), default=0.0) < 4e-3


def test_a_path_of_contact_behind_the_pitch_point_has_no_contact_there():
    mesh = MeshGeometry(GearPair(module=2.0, teeth=(20, 60), given_shift=(1.2, -1.2), tip=(0.0, -0.3)))
    ends = [((end - mesh.pitch_point) / mesh.direction).real for end in (mesh.contact_start, mesh.contact_end)]
    assert 0.0 < ends[0] < mesh.base_pitch < ends[1]
    (contact,) = mesh.contacts
    assert (contact - mesh.pitch_point) / mesh.direction == pytest.approx(mesh.base_pitch, rel=1e-12)
