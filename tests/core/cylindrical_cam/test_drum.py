"""The track of a drum against its own points in space: normals, pressure angle, regularity of the walls."""

from __future__ import annotations

import math
from typing import Any

import factory
import numpy as np
import pytest
from scipy.optimize import brentq

DATA = {
    "kind": "cylindrical-cam",
    "name": "barrel",
    "motion": [
        {"to": 120, "lift": 60, "law": "cycloidal"},
        {"to": 180},
        {"to": 330, "lift": 0, "law": "cycloidal"},
        {"to": 360},
    ],
    "follower": {"type": "translating-roller", "roller_radius": 10},
    "cam": {"radius": 60, "depth": 12},
}
PHI = np.linspace(0.02, 6.27, 300)


def drum(sense: int = 1, **keys: Any) -> Any:
    return factory.design({**DATA, "cam": {**DATA["cam"], "sense": sense}, **keys}, command="cam").drum  # type: ignore[dict-item]


def slopes(one: Any, x: float, side: int, h: float = 1e-5) -> tuple[np.ndarray, np.ndarray]:
    """dP/dphi and dP/dx of a wall, by differences."""
    ahead, back = (np.array(one.wall(x, side, PHI + step)) for step in (h, -h))
    out, inside = (np.array(one.wall(x + step, side, PHI)) for step in (1e-4, -1e-4))
    return (ahead - back) / (2.0 * h), (out - inside) / 2e-4


@pytest.mark.quick(3)
@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("x", [48.0, 60.0])
def test_walls_in_space(sense: int, side: int, x: float) -> None:
    one = drum(sense)
    axis = np.stack([np.cos(sense * PHI), -np.sin(sense * PHI), 0.0 * PHI])
    center = x * axis + np.stack([0.0 * PHI, 0.0 * PHI, one.motion.evaluate(PHI, 0)[0]])
    normal = (np.array(one.wall(x, side, PHI)) - center) / 10.0
    assert np.linalg.norm(normal, axis=0) == pytest.approx(1.0, rel=1e-12)
    along, outwards = slopes(one, x, side)
    # the roller's radius is a normal of the wall, and square to its axis
    assert (normal * axis).sum(axis=0) == pytest.approx(0.0, abs=1e-12)
    assert (normal * along).sum(axis=0) == pytest.approx(0.0, abs=1e-5)
    assert (normal * outwards).sum(axis=0) == pytest.approx(0.0, abs=1e-5)
    assert np.abs(normal[2]) == pytest.approx(np.cos(one.pressure_angle(x, PHI)), rel=1e-12)
    # the wall turns over where the normal component of dP/dphi x dP/dx changes its sign
    area = (np.cross(along, outwards, axis=0) * normal).sum(axis=0) / np.hypot(x, one.motion.evaluate(PHI, 1)[1])
    factor = one.wall_factor(x, side * sense, PHI)
    assert np.abs(area) == pytest.approx(np.abs(factor), abs=1e-5)
    assert np.all(np.sign(area) == np.sign(area[0]))


def test_a_large_roller_turns_a_wall_over_where_the_factor_says_so() -> None:
    one = drum(follower={"type": "translating-roller", "roller_radius": 60})
    along, outwards = slopes(one, 48.0, 1)
    axis = np.stack([np.cos(PHI), -np.sin(PHI), 0.0 * PHI])
    center = 48.0 * axis + np.stack([0.0 * PHI, 0.0 * PHI, one.motion.evaluate(PHI, 0)[0]])
    normal = np.array(one.wall(48.0, 1, PHI)) - center
    area, factor = (np.cross(along, outwards, axis=0) * normal).sum(axis=0), one.wall_factor(48.0, 1, PHI)
    clear = np.abs(factor) > 1e-3
    assert factor.min() < 0.0 < factor.max()
    assert len({*np.sign(area * factor)[clear].tolist()}) == 1


def test_quantities_by_close_places() -> None:
    design = factory.design(DATA, command="cam")
    close = np.linspace(0.0, 2.0 * math.pi, 100_001)
    one = design.drum
    assert design.max_pressure_angle == pytest.approx(np.abs(one.pressure_angle(48.0, close)).max(), rel=1e-8)
    assert design.pressure_angle_outside == pytest.approx(np.abs(one.pressure_angle(60.0, close)).max(), rel=1e-8)
    bend = max(np.abs(one.curvature(x, close)).max() for x in (48.0, 60.0))
    assert design.min_curvature_radius == pytest.approx(1.0 / bend, rel=1e-7)
    factors = [one.wall_factor(x, side, close).min() for x in (48.0, 60.0) for side in (1, -1)]
    assert design.least_wall_factor == pytest.approx(min(factors), rel=1e-7)


@pytest.mark.quick(1)
@pytest.mark.parametrize("x", [48.0, 60.0])
def test_how_far_a_wall_on_the_cylinder_lies_from_its_development(x: float) -> None:
    """The point of a wall whose distance from the axis is x, sought along the roller, against the developed line."""
    one = drum(1)
    found = one.off_development(x, PHI)
    for phi, off in zip(PHI[::7], found[::7], strict=True):
        at = np.array([phi])
        place = brentq(lambda u, at=at: float(np.hypot(*one.wall(u, 1, at)[:2])[0]) - x, 0.7 * x, 1.01 * x)
        east, north, along = (float(each[0]) for each in one.wall(place, 1, at))
        arc = x * float(np.angle((east + 1j * north) * np.exp(1j * phi)))
        s1 = float(one.motion.evaluate(at, 1)[1][0])
        rise = along - float(one.motion.evaluate(at, 0)[0][0])
        beside = (s1 * arc + x * rise) / np.hypot(x, s1)  # at right angles to the pitch line, which falls to the left
        assert off == pytest.approx(abs(beside - 10.0), abs=1e-10)
    assert found.max() > 1e-4
    assert one.off_development(x, np.zeros(1))[0] == pytest.approx(0.0, abs=1e-12)


def test_the_development_is_the_pitch_line_and_walls_a_radius_beside_it() -> None:
    one = drum(-1)
    pitch, upper, lower = (np.array(one.developed(60.0, side, PHI)) for side in (0, 1, -1))
    assert np.linalg.norm(upper - pitch, axis=0) == pytest.approx(10.0, rel=1e-12)
    assert upper - pitch == pytest.approx(pitch - lower, abs=1e-12)
    assert pitch[0] == pytest.approx(60.0 * PHI, rel=1e-14)


@pytest.mark.parametrize(("roller", "status"), [(10, "pass"), (30, "warn"), (60, "fail")])
def test_undercut_by_the_wall_factor(roller: float, status: str) -> None:
    data = {**DATA, "follower": {"type": "translating-roller", "roller_radius": roller}}
    design = factory.design(data, command="cam")
    assert [check.status for check in design.check("cam-undercut")] == [status]


def test_a_track_without_lift_has_no_curvature_radius() -> None:
    """It is a circle about the axis, developed a straight line: no infinite number, which JSON does not have."""
    motion = [{"to": 180, "lift": 0, "law": "cycloidal"}, {"to": 360}]
    made = factory.design({**DATA, "motion": motion}, command="cam")
    assert math.isinf(made.raw("min_curvature_radius"))
    assert made.quantity("min_curvature_radius") is None
    assert made.quantity("max_pressure_angle").value == 0.0
