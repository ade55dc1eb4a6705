"""Random cams of every follower against all places of their followers, by geometry alone.

A profile is what no place of the follower cuts and every point of which one touches: over 3600 places a roller's centre
is nowhere nearer than its radius, 1e-9 mm for rounding, and at the place of its own row just as far. A face is a line.
Both walls of a groove keep off the roller like that, opposite each other; a conjugate pair has two rollers.
"""

from __future__ import annotations

import cmath
import math
import random
from typing import Any

import factory
import numpy as np
import pytest

from gearlink.core.base.errors import NoSolution

FOLLOWERS = ("translating-roller", "translating-flat", "oscillating-roller", "oscillating-flat")
LAWS: list[Any] = [
    "modified-sine",
    "cycloidal",
    "polynomial-4567",
    "mcv-33",
    {"type": "polydyne", "periods": 2.0},
    {"type": "optimal", "minimize": "acceleration", "jerk": 60.0},
    {"type": "harmonic"},
]
ROWS, ROUNDING = 3600, 1e-9
CHECKS = {"spring": ("cam-undercut",), "groove": ("cam-undercut", "outer-wall"), "conjugate": ("cam-undercut",)}


def drawn(seed: int, follower: str, closure: str = "spring") -> tuple[dict[str, Any], Any]:
    """A random cam without undercut, as data and design."""
    dice = random.Random(f"{follower} {seed}")
    while True:
        rocks, flat = follower.startswith("oscillating"), follower.endswith("flat")
        rise, dwell = dice.uniform(70.0, 130.0), dice.uniform(10.0, 40.0)
        lift = dice.uniform(4.0, 15.0) if rocks else dice.uniform(5.0, 30.0)
        back = {"to": rise + dwell + dice.uniform(80.0, 140.0), "lift": 0, "law": dice.choice(LAWS)}
        motion = [{"to": rise, "lift": lift, "law": dice.choice(LAWS)}, {"to": rise + dwell}, back, {"to": 360}]
        body: dict[str, Any] = {"sense": dice.choice([1, -1])}
        body["base_radius" if flat else "prime_radius"] = dice.uniform(60.0, 110.0)
        parts: dict[str, Any] = {"type": follower}
        if not flat:
            parts["roller_radius"] = dice.uniform(5.0, 20.0)
        if rocks:
            parts |= {"center_distance": dice.uniform(130.0, 200.0), "pivot_direction": dice.uniform(-180.0, 180.0)}
            parts |= {"side": dice.choice([1, -1])}
            parts |= {"face_offset": dice.uniform(-10.0, 10.0)} if flat else {"arm": dice.uniform(90.0, 150.0)}
        else:
            parts |= {"direction": dice.uniform(-180.0, 180.0)} | (
                {} if flat else {"offset": dice.uniform(-25.0, 25.0)}
            )
        data = {"kind": "disc-cam", "name": "random", "motion": motion, "follower": parts, "cam": body}
        if closure != "spring":
            data["closure"] = closure
        if closure == "conjugate":
            data["return_roller"] = {"radius": dice.uniform(5.0, 20.0)} | (
                {"arm": dice.uniform(90.0, 150.0), "angle": parts["side"] * dice.uniform(60.0, 100.0)} if rocks else {}
            )
        design = factory.design(data, command="cam")
        try:
            found = [check.status for name in CHECKS[closure] for check in design.check(name)]
        except NoSolution:  # no triangle
            continue
        if "fail" not in found:
            return data, design


def turned_back(data: dict[str, Any], phi: Any) -> Any:
    """What turns the machine's frame into the cam's."""
    return np.exp(-1j * data["cam"]["sense"] * phi)


def arm(data: dict[str, Any], start: float, swing: Any) -> Any:
    """Direction of a rocker's arm in the machine's frame."""
    parts = data["follower"]
    return np.exp(1j * (math.radians(parts["pivot_direction"]) + math.pi - parts["side"] * (start + swing)))


def pivot_of(data: dict[str, Any]) -> complex:
    parts = data["follower"]
    return cmath.rect(parts["center_distance"], math.radians(parts["pivot_direction"]))


def centres(data: dict[str, Any], lift: Any, phi: Any, *, back: bool = False) -> Any:
    """The centre of the roller, or of the return roller, in the cam's frame."""
    parts, prime = data["follower"], data["cam"]["prime_radius"]
    if parts["type"] == "translating-roller":
        u = cmath.rect(1.0, math.radians(parts["direction"]))
        height = math.sqrt(prime**2 - parts["offset"] ** 2)
        apart = 2.0 * height + lift.max() + lift.min() if back else 0.0
        found = u * (height - apart + lift - 1j * parts["offset"])
    else:
        f, length = parts["center_distance"], parts["arm"]
        start = math.acos((f * f + length * length - prime * prime) / (2.0 * f * length))
        along = arm(data, start, np.radians(lift))
        if back:
            length = data["return_roller"]["arm"]
            along = along * cmath.rect(1.0, math.radians(data["return_roller"]["angle"]))
        found = pivot_of(data) + length * along
    return found * turned_back(data, phi)


def faces(data: dict[str, Any], lift: Any, phi: Any) -> tuple[Any, Any]:
    """Normals of the face, away from the cam axis, and its distances from there, in the cam's frame."""
    parts, base = data["follower"], data["cam"]["base_radius"]
    if parts["type"] == "translating-flat":
        normal = np.full(phi.shape, cmath.rect(1.0, math.radians(parts["direction"])))
        return normal * turned_back(data, phi), base + lift
    f, offset = parts["center_distance"], parts["face_offset"]
    start = math.asin((base - offset) / f)
    along = arm(data, start, np.radians(lift))
    normal = 1j * along
    normal = np.where((normal * np.conj(pivot_of(data))).real > 0.0, normal, -normal)
    return normal * turned_back(data, phi), offset + f * np.sin(start + np.radians(lift))


CASES = [
    pytest.param(name, seed, marks=[] if seed == 0 else pytest.mark.slow) for name in FOLLOWERS for seed in range(100)
]


@pytest.mark.quick(2)
@pytest.mark.parametrize(("follower", "seed"), CASES)
def test_no_place_of_the_follower_cuts_the_profile(follower: str, seed: int) -> None:
    data, design = drawn(seed, follower)
    table, lifts = design.table("main_cam", samples=ROWS), design.table("follower", samples=ROWS)
    phi, lift = np.radians(lifts["cam_angle"]), lifts["lift"]
    points = (table["x"] + 1j * table["y"])[::12]
    own = np.arange(ROWS)[::12]
    if follower.endswith("flat"):
        normals, supports = faces(data, lift, phi)
        gaps = supports[None, :] - (points[:, None] * np.conj(normals[None, :])).real
    else:
        gaps = np.abs(points[:, None] - centres(data, lift, phi)[None, :]) - data["follower"]["roller_radius"]
    assert float(gaps.min()) >= -ROUNDING
    assert np.abs(gaps[np.arange(len(own)), own]).max() <= ROUNDING


CLOSED = [(name, closure, seed) for name in FOLLOWERS[::2] for closure in ("groove", "conjugate") for seed in range(15)]


@pytest.mark.slow
@pytest.mark.parametrize(("follower", "closure", "seed"), CLOSED)
def test_no_roller_cuts_walls_or_return_cams(follower: str, closure: str, seed: int) -> None:
    data, design = drawn(seed, follower, closure)
    lifts = design.table("follower", samples=ROWS)
    phi, lift = np.radians(lifts["cam_angle"]), lifts["lift"]
    own, radius = np.arange(ROWS)[::12], data["follower"]["roller_radius"]
    other, back = ("outer_wall", radius) if closure == "groove" else ("return_cam", data["return_roller"]["radius"])
    sides = []
    for name, far in (("main_cam", radius), (other, back)):
        places = centres(data, lift, phi, back=name == "return_cam")
        table = design.table(name, samples=ROWS)
        points = (table["x"] + 1j * table["y"])[::12]
        gaps = np.abs(points[:, None] - places[None, :]) - far
        assert float(gaps.min()) >= -ROUNDING, name
        assert np.abs(gaps[np.arange(len(own)), own]).max() <= ROUNDING, name
        sides.append(points - places[::12])
    if closure == "groove":
        assert np.abs(sides[0] + sides[1]).max() <= ROUNDING
