"""Formulas of gears against geometry: the helicoid in space, strings of flanks, the cut fillet, teeth pushed together.

Tolerances: closed forms against each other at 1e-11 relative (a few ulp times the pitches that they sum); tangents by
central differences at 1e-6; outlines that are pushed together within their chords, 2e-3 mm, which no case is near.
"""

from __future__ import annotations

import cmath
import math
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from matplotlib.path import Path
from sweeps import examples

from gearlink.core.parts.gears.data import GearData
from gearlink.core.parts.gears.measures.allowances import MeshPlay
from gearlink.core.parts.gears.mesh.contact import PathOfContact
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.mesh.ring_cutter import InternalInterference
from gearlink.core.parts.gears.outline.mesh_geometry import MeshGeometry
from gearlink.core.parts.gears.outline.ring_profile import RingProfile
from gearlink.core.parts.gears.outline.tooth_profile import ToothProfile, outline
from gearlink.core.parts.gears.rating.flank_strength import FlankStrength
from gearlink.core.parts.gears.rating.load import Load, Material
from gearlink.core.parts.gears.rating.root_stress import RootSection
from gearlink.core.parts.gears.tooth.root_fillet import RackCutRoot
from gearlink.core.parts.gears.tooth.tools import RackTool

TEETH, SHIFT = st.integers(12, 90), st.floats(-0.3, 0.7)
HELIX = st.floats(0.0, 32.0)
ALPHA = st.floats(15.0, 25.0)


def inv(angle: float) -> float:
    return math.tan(angle) - angle


class Helicoid:
    """A flank in space: base radius, start on the base circle, side +1 (opens to larger angles) or -1, twist."""

    def __init__(self, pair: GearPair, gear: int, center: float, side: int) -> None:
        z = pair.teeth[gear]
        half = (math.pi / 2.0 + 2.0 * pair.profile_shift[gear] * math.tan(pair.pressure_angle)) / z
        at_base = half + inv(pair.transverse_pressure_angle)
        self.base, self.side = pair.base_radius[gear], side
        self.start = center - side * at_base
        self.twist = math.tan(pair.helix_angle) / pair.reference_radius[gear]

    def point(self, roll: float, z: float) -> np.ndarray[Any, Any]:
        turn = self.start + self.side * roll + self.twist * z
        p = self.base * (1.0 - 1j * self.side * roll) * cmath.exp(1j * turn)
        return np.array([p.real, p.imag, z])

    def tangents(self, roll: float, z: float) -> tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]:
        turn = self.start + self.side * roll + self.twist * z
        p = self.point(roll, z)
        along = np.array([math.cos(turn), math.sin(turn), 0.0]) * self.base * roll
        return along, np.array([-self.twist * p[1], self.twist * p[0], 1.0])


@examples(40)
@given(z=TEETH, x=SHIFT, beta=HELIX, alpha=ALPHA, roll=st.floats(0.2, 0.6), high=st.floats(-5.0, 5.0))
def test_span_is_the_distance_of_parallel_tangent_planes(
    z: int, x: float, beta: float, alpha: float, roll: float, high: float
) -> None:
    pair = GearPair(
        module=2.0,
        teeth=(z, z),
        pressure_angle=math.radians(alpha),
        helix_angle=math.radians(beta),
        given_shift=(x, -x),
    )
    k = pair.span_teeth[0]
    assume(k is not None)
    first, last = Helicoid(pair, 0, 0.0, 1), Helicoid(pair, 0, (k - 1) * 2.0 * math.pi / z, -1)
    normal = np.cross(*first.tangents(roll, 0.0))
    other_roll = last.start - first.start - roll + last.twist * high
    other = np.cross(*last.tangents(other_roll, high))
    normal, other = normal / np.linalg.norm(normal), other / np.linalg.norm(other)
    assert abs(normal @ other) == pytest.approx(1.0, abs=1e-12)
    apart = abs(normal @ (last.point(other_roll, high) - first.point(roll, 0.0)))
    assert pair.span_measurement[0] == pytest.approx(apart, rel=1e-11)


@examples(40)
@given(z=TEETH, x=SHIFT, beta=HELIX, alpha=ALPHA, ring=st.booleans(), size=st.floats(1.6, 1.9))
def test_a_ball_of_the_measure_touches_the_helicoid(
    z: int, x: float, beta: float, alpha: float, ring: bool, size: float
) -> None:
    """Newton on the two conditions of the nearest point, from the plane of the ball's centre."""
    teeth = (12, -(40 + z)) if ring else (z, z)
    pair = GearPair(
        module=2.0,
        teeth=teeth,
        pressure_angle=math.radians(alpha),
        helix_angle=math.radians(beta),
        given_shift=(-x, x) if ring else (x, -x),
        tip="none",
    )
    gear = int(ring)
    data = GearData(pair=pair, pins=(2.0 * size, 2.0 * size))
    ball = data.ball(gear)
    assume(ball is not None and ball.pressure_angle > 0.15)
    radius = abs(ball.center_radius)
    sign = pair.signs[gear]
    # the space's middle is half a pitch from a tooth's; a ring's space is bounded by the same helicoids from outside
    count = abs(pair.teeth[gear])
    half = (math.pi / 2.0 + sign * 2.0 * pair.profile_shift[gear] * math.tan(pair.pressure_angle)) / count
    flank = Helicoid(pair, gear, 0.0, 1)
    flank.base, flank.twist = abs(flank.base), abs(flank.twist)
    if ring:  # the tooth of a ring narrows outwards: its flank opens to the middle of the space, as an outer gear's
        tooth = (math.pi / 2.0 + 2.0 * pair.profile_shift[gear] * math.tan(pair.pressure_angle)) / count
        flank.start = tooth - inv(pair.transverse_pressure_angle)
        center = math.pi / count
    else:
        flank.start = -(half + inv(pair.transverse_pressure_angle))
        center = -math.pi / count
    place = np.array([radius * math.cos(center), radius * math.sin(center), 0.0])

    def conditions(v: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
        apart = flank.point(*v) - place
        return np.array([apart @ each for each in flank.tangents(*v)])

    v = np.array([math.tan(math.acos(min(1.0, flank.base / radius))), 0.0])
    for _ in range(40):
        step = 1e-7
        jacobian = np.column_stack([(conditions(v + e) - conditions(v - e)) / (2 * step) for e in step * np.eye(2)])
        move = np.linalg.solve(jacobian, conditions(v))
        v = v - move
        if np.abs(move).max() < 1e-13:
            break
    assert np.linalg.norm(flank.point(*v) - place) == pytest.approx(size, rel=1e-9)
    over = data.measure_over_balls[gear]
    even = count % 2 == 0
    across = 2.0 * radius * (1.0 if even else math.cos(math.pi / (2 * count)))
    assert over == pytest.approx(across + (-2.0 * size if ring else 2.0 * size), rel=1e-12)


@examples(40)
@given(z1=TEETH, z2=TEETH, x1=SHIFT, x2=SHIFT, beta=HELIX, less=st.floats(0.0, 0.2))
def test_shifts_that_a_given_distance_does_not_use_leave_backlash(
    z1: int, z2: int, x1: float, x2: float, beta: float, less: float
) -> None:
    """Both given: teeth that are thinner, by 2 x m tan(alpha_n) in the normal section."""
    assume(x1 + x2 > 0.0)
    keys: dict[str, Any] = {"module": 3.0, "teeth": (z1, z2), "helix_angle": math.radians(beta)}
    full = GearPair(given_shift=(x1, x2), **keys)
    thinner = GearPair(given_shift=(x1 - less, x2), given_distance=full.center_distance, **keys)
    thickness = -2.0 * less * 3.0 * math.tan(full.pressure_angle)
    wanted = MeshPlay(full, 0.0, thickness)
    assert MeshPlay(thinner, 0.0, 0.0).circumferential == pytest.approx(wanted.circumferential, abs=1e-11 * (z1 + z2))


@examples(40)
@given(z1=TEETH, z2=TEETH, x1=SHIFT, x2=SHIFT, beta=HELIX, off=st.floats(0.0, 0.1), thin=st.floats(-0.3, 0.0))
def test_backlash_is_what_the_strings_of_both_flanks_leave(
    z1: int, z2: int, x1: float, x2: float, beta: float, off: float, thin: float
) -> None:
    """A tooth in the middle of a space: each flank's string from its base circle, and the line of action between."""
    assume(x1 + x2 > -0.2)
    pair = GearPair(module=3.0, teeth=(z1, z2), given_shift=(x1, x2), helix_angle=math.radians(beta))
    play = MeshPlay(pair, off, thin)
    r1, r2 = pair.base_radius
    working = math.acos((r1 + r2) / (pair.center_distance + off))

    def half(gear: int) -> float:
        thickness = pair.tooth_thickness[gear] + (thin if gear == 0 else 0.0)
        at = thickness / math.cos(pair.helix_angle) / (2.0 * pair.reference_radius[gear])
        return at + inv(pair.transverse_pressure_angle)

    line = (r1 + r2) * math.tan(working)
    strings = r1 * (half(0) + working) + r2 * (working - math.pi / z2 + half(1))
    gap = 2.0 * (line - strings) * math.cos(pair.base_helix_angle)
    assert play.normal == pytest.approx(gap, rel=1e-9, abs=1e-11 * r2)


@examples(40)
@given(z=st.integers(14, 90), x=st.floats(-0.1, 0.5), depth=st.floats(1.2, 1.4), rho=st.floats(0.15, 0.3))
def test_root_section_is_where_the_fillet_leans_thirty_degrees(z: int, x: float, depth: float, rho: float) -> None:
    pair = GearPair(module=1.0, teeth=(z, z), given_shift=(x, -x))
    tool = RackTool(addendum=depth, rounding=rho)
    section = RootSection(pair=pair, gear=0, tool=tool, shift=x)
    root = RackCutRoot(teeth=z, shift=x, tool=tool)
    at = section.theta
    to_tooth = cmath.exp(-1j * math.pi / z)  # the fillet is drawn about the middle of a space, on the i axis
    point, step = root.fillet(at) * to_tooth.conjugate(), 1e-6
    way = (root.fillet(at + step) - root.fillet(at - step)) * to_tooth.conjugate()
    assert abs(point.real) * 2.0 == pytest.approx(section.chord, rel=1e-9)
    assert abs(math.atan2(way.real, way.imag)) == pytest.approx(math.radians(30.0), abs=1e-6)
    before, behind = root.fillet(at - 1e-4), root.fillet(at + 1e-4)
    middle = root.fillet(at)
    first, second = (behind - before) / 2e-4, (behind - 2.0 * middle + before) / 1e-8
    bend = abs(first) ** 3 / abs((first.conjugate() * second).imag)
    assert section.fillet_radius == pytest.approx(bend, rel=1e-5)


@examples(40)
@given(z1=TEETH, z2=TEETH, x1=st.floats(0.0, 0.5), beta=HELIX, ring=st.booleans())
def test_zone_and_elasticity_factor_are_the_pressure_of_cylinders_at_the_pitch_point(
    z1: int, z2: int, x1: float, beta: float, ring: bool
) -> None:
    teeth = (z1, -(z1 + z2 + 30)) if ring else (z1, z2)
    pair = GearPair(module=3.0, teeth=teeth, given_shift=(x1, -0.1), helix_angle=math.radians(beta))
    materials = (Material(), Material(elastic_modulus=110e3, poisson=0.25))
    flank = FlankStrength(path=PathOfContact(pair, 40.0), load=Load(force=5000.0), materials=materials)
    sine = math.sin(pair.working_pressure_angle) / math.cos(pair.base_helix_angle)
    one, other = (radius * sine for radius in pair.working_radius)
    normal = 5000.0 / math.cos(pair.transverse_pressure_angle) / math.cos(pair.base_helix_angle)
    length = 40.0 / math.cos(pair.base_helix_angle)
    compliance = sum((1.0 - m.poisson**2) / m.elastic_modulus for m in materials)
    pressure = math.sqrt(normal / length * (1.0 / one + 1.0 / other) / (math.pi * compliance))
    u = pair.gear_ratio
    line = 5000.0 / (2.0 * pair.reference_radius[0] * 40.0) * (u + 1.0) / u
    assert flank.zone_factor * flank.elasticity_factor * math.sqrt(line) == pytest.approx(pressure, rel=1e-11)


def depth_in(points: Any, ring: Any) -> float:
    """How far points lie outside the opening of a ring [mm]."""
    opening = Path(np.column_stack([ring.real, ring.imag]))
    out = points[~opening.contains_points(np.column_stack([points.real, points.imag]))]
    if not out.size:
        return 0.0
    start, way = ring[:-1], np.diff(ring)
    keep = np.abs(way) > 0.0
    start, way = start[keep], way[keep]
    apart = out[:, None] - start
    along = np.clip((apart * way.conj()).real / np.abs(way) ** 2, 0.0, 1.0)
    return float(np.min(np.abs(apart - along * way), axis=1).max())


PUSHED = [
    ((20, -60), (0.3, -0.2), 0.0, True),
    ((30, -39), (0.2, -0.4), 0.0, False),
    ((43, -60), (0.2, 0.0), 0.0, False),
    ((18, -38), (0.3, -0.1), 0.0, True),
    ((32, -48), (0.2, 0.0), 0.0, False),
    ((26, -46), (0.2, 0.0), 12.0, True),
    ((30, -48), (0.2, 0.0), 12.0, False),
    ((30, -39), (0.2, -0.4), 25.0, True),
    ((30, -45), (0.2, 0.0), 25.0, False),
]


def turned_sections(pair: GearPair, count: int) -> list[tuple[float, float]]:
    """How far pinion and ring are turned on [rad]: phases of a pitch, of helical gears at heights of an axial pitch."""
    if not pair.helix_angle:
        return [
            (2.0 * math.pi * k / count / pair.teeth[0], -2.0 * math.pi * k / count / pair.teeth[1])
            for k in range(count)
        ]
    heights = [math.pi * pair.module / math.sin(pair.helix_angle) * k / count for k in range(count)]
    slope = math.tan(pair.helix_angle)
    return [(slope * h / pair.reference_radius[0], -slope * h / pair.reference_radius[1]) for h in heights]


@pytest.mark.slow
@pytest.mark.parametrize(("teeth", "shift", "beta", "goes"), PUSHED)
def test_a_pinion_that_is_pushed_into_its_ring_fits_as_the_margin_says(
    teeth: tuple[int, int], shift: tuple[float, float], beta: float, goes: bool
) -> None:
    """Every phase of the teeth, which helical gears have at some height each, and every place on the way out."""
    pair = GearPair(module=2.0, teeth=teeth, given_shift=shift, helix_angle=math.radians(beta))
    angle = InternalInterference(pair).radial_assembly_angle
    assert angle is not None
    assert (angle >= 0.0) == goes
    pinion = outline(ToothProfile.of(pair, 0), 1e-3)
    pinion = pinion[np.abs(pinion) > pair.reference_radius[0]]  # its tips: corners decide
    ring = RingProfile(pair).outline(24)
    a, first = abs(pair.center_distance), MeshGeometry(pair).first_space
    worst = 0.0
    for one, other in turned_sections(pair, 6):
        turned = pinion * np.exp(1j * (first[0] + one))
        still = ring * np.exp(1j * (first[1] + other))
        worst = max(worst, *(depth_in(turned + a - back, still) for back in np.linspace(0.0, 4.5, 19)))
    assert (worst < 4e-3) == goes, worst
