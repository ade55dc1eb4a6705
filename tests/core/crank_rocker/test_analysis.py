"""The crank-rocker of given links: against scipy on the loop's equation, and refusals.

Tolerances: the loop solved by scipy is good to some ulp over sin(mu), mu above 40 deg; extremes of a dense search are
flat, their places good to the root of that.
"""

from __future__ import annotations

import cmath
import math
from typing import Any

import numpy as np
import pytest
from factory import design
from scipy.optimize import brentq, minimize_scalar

from gearlink.core.base.errors import MissingSection, NoSolution

LINKS = {"crank": 40.0, "coupler": 110.0, "rocker": 80.0, "frame": 120.0}
GIVEN: dict[str, Any] = {"kind": "crank-rocker", "name": "given", "links": LINKS}
DOUBLE_ROCKER = {"crank": 100.0, "coupler": 60.0, "rocker": 90.0, "frame": 120.0}


def rocker_at(phi: float, assembly: int = 1, links: dict[str, float] = LINKS) -> float:
    """Direction D->C by a root of |C - B| = b on the side of BD that the assembly names [rad]."""
    pin = cmath.rect(links["crank"], phi)
    back = cmath.phase(links["frame"] - pin) + math.pi
    sides = (back - math.pi, back) if assembly > 0 else (back, back + math.pi)

    def gap(psi: float) -> float:
        return abs(links["frame"] + cmath.rect(links["rocker"], psi) - pin) - links["coupler"]

    return float(brentq(gap, *sides, xtol=1e-15, rtol=1e-15))


@pytest.mark.parametrize("assembly", [1, -1])
def test_table_is_the_loop_solved_by_scipy(assembly: int) -> None:
    table = design(GIVEN, assembly=assembly).table("motion", samples=24)
    for degrees, angle, speed, acceleration in zip(
        *(table[name] for name in ("crank_angle", "rocker_angle", "speed_ratio", "acceleration_ratio")), strict=True
    ):
        phi, h = math.radians(degrees), 1e-4
        low, here, high = (rocker_at(phi + step, assembly) for step in (-h, 0.0, h))
        assert cmath.rect(1.0, math.radians(angle)) == pytest.approx(cmath.rect(1.0, here), abs=1e-12)
        assert speed == pytest.approx((high - low) / (2 * h), abs=1e-8)
        assert acceleration == pytest.approx((high - 2 * here + low) / h**2, abs=1e-6)


@pytest.mark.parametrize("assembly", [1, -1])
def test_dead_centers_swing_and_ratio_are_those_of_a_search(assembly: int) -> None:
    found = design(GIVEN, assembly=assembly)
    grid = np.linspace(0.0, 2.0 * math.pi, 721)
    angles = np.unwrap([rocker_at(phi, assembly) for phi in grid])
    places = []
    for sign, index in ((1.0, int(np.argmin(angles))), (-1.0, int(np.argmax(angles)))):
        near = grid[index]
        best = minimize_scalar(
            lambda phi, sign=sign: sign * rocker_at(phi, assembly),
            bounds=(near - 0.02, near + 0.02), method="bounded", options={"xatol": 1e-11},
        )  # fmt: skip
        places.append((float(best.x), sign * float(best.fun)))
    (least_at, least), (most_at, most) = places
    assert found.rocker_swing == pytest.approx(most - least, rel=1e-12)
    expected = sorted((least_at % (2 * math.pi), most_at % (2 * math.pi)))
    assert sorted((found.outer_dead_center, found.inner_dead_center)) == pytest.approx(expected, abs=1e-7)
    one = (most_at - least_at) % (2 * math.pi)
    strokes = sorted((one, 2 * math.pi - one))
    assert found.quick_return_ratio == pytest.approx(strokes[1] / strokes[0], rel=1e-7)
    stretched = cmath.rect(LINKS["crank"] + LINKS["coupler"], found.outer_dead_center)
    assert abs(stretched - LINKS["frame"]) == pytest.approx(LINKS["rocker"], rel=1e-12)


def test_path_is_that_of_the_point_on_the_coupler() -> None:
    made = design(GIVEN, coupler_point=[55.0, 30.0])
    assert made.outline("analyze").tables == ("motion", "path")
    table = made.table("path", samples=12)

    def point(phi: float) -> complex:
        pin = cmath.rect(LINKS["crank"], phi)
        joint = LINKS["frame"] + cmath.rect(LINKS["rocker"], rocker_at(phi))
        return pin + (55.0 + 30.0j) * (joint - pin) / LINKS["coupler"]

    rows = zip(*(table[name] for name in ("crank_angle", "x", "y", "speed", "curvature_radius")), strict=True)
    for degrees, x, y, speed, radius in rows:
        phi, h = math.radians(degrees), 1e-4
        low, here, high = point(phi - h), point(phi), point(phi + h)
        assert complex(x, y) == pytest.approx(here, abs=1e-9)
        velocity, bend = (high - low) / (2 * h), (high - 2 * here + low) / h**2
        assert speed == pytest.approx(abs(velocity), rel=1e-6)
        assert radius == pytest.approx(abs(velocity) ** 3 / (velocity.conjugate() * bend).imag, rel=1e-4)
    with pytest.raises(MissingSection, match="coupler_point"):
        design(GIVEN).table("path")


@pytest.mark.slow
def test_range_of_a_linkage_that_does_not_turn() -> None:
    made = design(GIVEN, links=DOUBLE_ROCKER, range=[20.0, 60.0])
    table = made.table("motion", samples=40)
    assert (table["crank_angle"][0], table["crank_angle"][-1], len(table["crank_angle"])) == (20.0, 60.0, 41)
    phi = np.radians(np.linspace(20.0, 60.0, 4001))
    angles = np.array([rocker_at(x, 1, DOUBLE_ROCKER) for x in phi])
    rates = np.gradient(angles, phi, edge_order=2)
    assert np.radians(table["rocker_angle"]) == pytest.approx(angles[::100], abs=1e-9)
    assert made.speed_ratio_max == pytest.approx(rates.max(), rel=1e-5)
    assert made.speed_ratio_min == pytest.approx(rates.min(), rel=1e-5)
    assert made.rocker_swing is None
    assert made.quick_return_ratio is None
    across = [abs(math.sin(math.radians(mu))) for mu in table["transmission_angle"]]
    assert math.sin(made.min_transmission_angle) == pytest.approx(min(across), rel=1e-12)
    report = made.report("analyze")
    assert {check.code for check in report.checks} == {"GL303"}


def test_drag_link_has_no_dead_centers() -> None:
    made = design(GIVEN, links={"crank": 50.0, "coupler": 45.0, "rocker": 48.0, "frame": 20.0})
    assert made.rocker_swing is made.outer_dead_center is None
    first = made.table("motion", samples=8)["rocker_angle"][0]
    assert -180.0 < first <= 180.0
    assert made.report("analyze").quantities


@pytest.mark.parametrize(
    ("keys", "key"),
    [
        ({"links": DOUBLE_ROCKER}, "links"),
        ({"links": {"crank": 40.0, "coupler": 90.0, "rocker": 40.0, "frame": 90.0}}, "links"),
        ({"links": DOUBLE_ROCKER, "range": [20.0, 90.0]}, "range"),
        ({"links": None}, "links"),
    ],
)
def test_refused(keys: dict[str, Any], key: str) -> None:
    with pytest.raises(NoSolution) as refused:
        design(GIVEN, **keys).report("analyze")
    assert refused.value.key == key


def test_real_speed_and_loads_of_a_range() -> None:
    made = design(GIVEN, input_speed=120.0)
    w = 4.0 * math.pi
    assert made.rocker_speed_max == pytest.approx(w * made.speed_ratio_max, rel=1e-15)
    assert made.rocker_acceleration_min == pytest.approx(w * w * made.acceleration_ratio_min, rel=1e-15)
    loads = {"speed": 60, "links": {"rocker": {"mass": 2.0, "inertia": 0.01}}}
    with pytest.raises(NoSolution) as refused:
        design(GIVEN, command="loads", range=[20.0, 60.0], loads=loads).report("loads")
    assert refused.value.key == "range"


@pytest.mark.parametrize("assembly", [1, -1])
def test_input_torque_is_the_power_of_the_masses(assembly: int) -> None:
    """M = d/dphi of the kinetic energy per w^2, energies by the loop that scipy solves, differences of 1e-3 rad."""
    masses = {
        "crank": {"mass": 1.2, "center": [10.0, 4.0], "inertia": 0.001},
        "coupler": {"mass": 0.8, "center": [55.0, -7.0], "inertia": 0.002},
        "rocker": {"mass": 2.0, "center": [40.0, 3.0], "inertia": 0.02},
    }
    loads = design(GIVEN, command="loads", assembly=assembly, loads={"speed": 120.0, "links": masses})
    table, w, h = loads.table("torque", samples=24), 4.0 * math.pi, 1e-3

    def centers(phi: float) -> list[tuple[complex, float]]:
        psi, pin = rocker_at(phi, assembly), cmath.rect(LINKS["crank"], phi)
        joint = LINKS["frame"] + cmath.rect(LINKS["rocker"], psi)
        coupler = cmath.phase(joint - pin)
        frames = {"crank": (0j, phi), "coupler": (pin, coupler), "rocker": (LINKS["frame"], psi)}
        return [
            (origin + complex(*masses[name]["center"]) * cmath.rect(1.0, angle), angle)
            for name, (origin, angle) in frames.items()
        ]

    def energy(phi: float) -> float:
        total = 0.0
        for body, (low, a), (high, b) in zip(masses.values(), centers(phi - h), centers(phi + h), strict=True):
            turn = math.remainder(b - a, 2.0 * math.pi) / (2 * h)
            total += 0.5 * body["mass"] * abs((high - low) / (2 * h) * 1e-3) ** 2 + 0.5 * body["inertia"] * turn**2
        return total

    expected = [(energy(phi + h) - energy(phi - h)) / (2 * h) * w**2 for phi in np.radians(table["input_angle"])]
    assert table["input_torque"] == pytest.approx(expected, abs=2e-5 * max(map(abs, expected)))


@pytest.mark.parametrize(
    ("links", "low", "high"),
    [((80, 60, 70, 100), -91.79, 91.79), ((90, 70, 30, 100), 23.56, 63.25), ((90, 30, 90, 100), 36.34, 78.13)],
)
def test_a_crank_that_does_not_turn_is_told_where_it_moves(links: tuple[int, ...], low: float, high: float) -> None:
    """The linkage closes at both ends of that range, and not a tenth of a degree beyond them."""
    data = {
        "kind": "crank-rocker",
        "name": "x",
        "links": dict(zip(("crank", "coupler", "rocker", "frame"), links, strict=True)),
    }
    with pytest.raises(NoSolution) as refused:
        _ = design(data).linkage
    assert refused.value.fix == f"set range to [{low}, {high}]"
    assert design(data | {"range": [low, high]}).raw("min_transmission_angle") > 0.0
    for ends in ([low - 0.1, high], [low, high + 0.1]):
        with pytest.raises(NoSolution):
            design(data | {"range": ends}).raw("min_transmission_angle")
