"""Rollers, pendulum and parallel shafts of a wide swing under load, each by a second way.

Tolerances: 1e-6 against differences over 1e-6 rad (their own error is 1e-9 of the speed); 1e-5 for a life by the
trapezoidal rule over 4000 rows a part; 1e-11 of closed forms against the equilibrium of the links.
"""

from __future__ import annotations

import cmath
import math
from typing import Any

import factory
import numpy as np
import pytest

from gearlink.core.base.errors import NoSolution

ROLLER = {"roller": {"width": 20}, "bearings": {"roller": {"dynamic_rating": 5000.0, "life": 20000.0}}}
CYCLE = {"working": 120.0, "far_dwell": 40.0, "return": 130.0}
PENDULUM = {"type": "gravity", "distance": 400.0, "reserve": 0.24}


def parallel(**more: Any) -> Any:
    second = {"direction": 110.0, "center_distance": 220.0}
    keys: dict[str, Any] = {"layout": "twin-cam-parallel", "cycle_angle": None, "cycle": CYCLE, "cam__second": second}
    loads = ROLLER | {"device_direction": 200.0}
    return factory.design("wide_swing_twin_cam", command="loads", gears={"module": 4}, loads=loads, **keys | more)


def pendulum(**more: Any) -> Any:
    keys: dict[str, Any] = {"swing": 80.0, "cycle_angle": 150.0, "speed": 18.0, "unloader": PENDULUM, "shaft": None}
    keys["operating_speed_min"] = None
    loads = {"roller": {"width": 20}, "device_direction": -90.0} | more
    return factory.design("wide_swing_twin_cam", command="loads", loads=loads, **keys)


def spins(loads: Any, stroke: Any, k: Any) -> tuple[Any, Any]:
    """Speeds of the roller about its axis and on its pin [rad/s]: its point of contact moves as the cam does there."""
    step, phi = 1e-6, stroke.angle(k)
    cam = "return_cam" if stroke.name == "return" and loads.has_return_cam else "cam"

    def at(angles: Any) -> tuple[Any, Any]:
        made = loads.machine.at(angles)
        return made, next(each for each in made.connections if each.name == "roller")

    (here, contact), (after, later), (before, sooner) = at(phi), at(phi + step), at(phi - step)
    velocity = (later.at - sooner.at) / (2.0 * step)
    turning = {
        name: np.angle(after.links[name].unit / before.links[name].unit) / (2.0 * step) for name in (cam, "rocker")
    }
    against = velocity - 1j * turning[cam] * (contact.at - here.links[cam].origin.value)
    spin = (against / (1j * stroke.cam.roller_radius * contact.normal)).real + turning[cam]
    return spin * loads.speed, (spin - turning["rocker"]) * loads.speed


@pytest.mark.quick(2)
@pytest.mark.parametrize("base", ["wide_swing_twin_cam", "wide_swing_cycle", "wide_swing_oscillating_cam"])
def test_speed_of_the_roller_by_the_contact_at_rest(base: str) -> None:
    loads = factory.design(base, command="loads", loads={"roller": {"width": 20}})
    k = np.array([0.1, 0.3, 0.7, 0.9])
    for stroke in loads.strokes:
        spin, on_pin = spins(loads, stroke, k)
        sense = -1.0 if stroke.at.mirrored else 1.0
        assert stroke.roller_speed(k) == pytest.approx(sense * spin, rel=1e-6)
        assert stroke.bearing_speed(k) == pytest.approx(sense * on_pin, rel=1e-6)


def test_life_of_the_rollers_by_the_trapezoidal_rule() -> None:
    loads, p = parallel(), 10.0 / 3.0
    found = []
    for stroke, (start, width) in zip(loads.strokes, loads.dwell_zones, strict=True):
        borne = way = 0.0
        for first, last in stroke.parts:
            k = np.linspace(first, last, 4001)
            speed, force = np.abs(stroke.bearing_speed(k)), np.abs(stroke.force(k))
            time = k * stroke.width / loads.speed
            borne, way = borne + np.trapezoid(force**p * speed, time), way + np.trapezoid(speed, time)
        bends = stroke.cam.end_radius / stroke.cam.roller_radius  # rolled in the frame of the cam
        spin = loads.speed * (bends - 1.0)
        rest = loads.machine.reactions(np.array([start + 0.5 * width])).unknowns["roller"][0][0]
        time = width / loads.speed
        borne, way = borne + abs(rest) ** p * spin * time, way + spin * time
        equivalent = (borne / way) ** (1.0 / p)
        turns = way / math.tau
        found.append((1e6 * (5000.0 / equivalent) ** p / (turns * loads.speed / math.tau * 3600.0), equivalent))
    life, equivalent = min(found)
    assert loads.rollers_found.life == pytest.approx(life, rel=1e-5)
    assert loads.rollers_found.equivalent == pytest.approx(equivalent, rel=1e-5)
    (check,) = loads.check("bearing-life")
    assert (check.status, check.code) == ("fail", "GL606")


def test_pair_of_parallel_shafts_drives_the_second_cam() -> None:
    """The tooth force by the moments of contact about the second shaft, and the work of both against the rocker's."""
    loads = parallel()
    stroke = loads.strokes[1]
    phi = stroke.angle(np.array([0.2, 0.4, 0.8]))
    found = loads.machine.reactions(phi)
    contact = next(each for each in found.mechanism.connections if each.name == "roller")
    force = found.unknowns["roller"][0]
    shaft = found.mechanism.links["return_cam"].origin.value
    push = -force * contact.normal  # on the cam
    moment = ((contact.at - shaft).conj() * push).imag
    radius = 0.5 * abs(complex(shaft[0]))
    assert abs(complex(shaft[0])) == pytest.approx(loads.design.shafts.shaft_distance, rel=1e-12)
    assert loads.mesh("shaft_gears").force(phi) * radius == pytest.approx(
        moment, rel=1e-11
    )  # the pitch point is on the near side
    assert loads.machine.torque(phi) == pytest.approx(loads.machine.reduced(phi).torque(loads.speed), rel=1e-9)
    at_rocker = found.mechanism.links["rocker"].origin.value
    assert np.abs(contact.at - at_rocker) == pytest.approx(stroke.cam.rocker_radius, rel=1e-12)


def test_pendulum_by_its_weight_and_by_its_law() -> None:
    loads = pendulum()
    stroke, size = loads.strokes[0], loads.design.unloading.size
    k = np.array([0.05, 0.2, 0.4, 0.6, 0.9])
    lever = 1e-3 * stroke.cam.rocker_radius * np.cos(stroke.cam.pressure_angle(k))
    turned = stroke.at.turn(k, 2)
    inertia = loads.spec.inertia + size.mass * 0.4**2
    weight = -size.mass * 9.80665 * 0.4 * np.sin(turned.value)
    needed = inertia * turned.second * loads.speed**2 - weight
    assert np.abs(stroke.force(k)) * lever == pytest.approx(np.abs(needed), rel=1e-11)
    assert stroke.force(k) == pytest.approx(loads.design.unloading.contact_force(stroke.cam, k), rel=1e-11)


def test_bearing_of_a_pendulum_takes_its_weight_and_what_swings_it() -> None:
    loads = pendulum(gravity=[0.0, -9.81])
    stroke, mass = loads.strokes[0], loads.design.unloading.size.mass
    k = np.array([0.2, 0.7])
    found, turned = loads.machine.reactions(stroke.angle(k)), stroke.at.turn(k, 2)
    contact = next(each for each in found.mechanism.connections if each.name == "roller")
    place = 0.4 * cmath.rect(1.0, -0.5 * math.pi) * np.exp(1j * turned.value)
    first, second = turned.first * loads.speed, turned.second * loads.speed**2
    accelerated = (1j * second - first**2) * place
    push = found.unknowns["roller"][0] * contact.normal
    expected = mass * (accelerated + 9.80665j) - push
    assert found.force("D") == pytest.approx(expected, rel=1e-10)


def test_pendulum_beside_gravity_of_another_direction_is_refused() -> None:
    with pytest.raises(NoSolution) as refused:
        _ = pendulum(gravity=[9.81, 0.0]).machine
    assert refused.value.key == "loads.device_direction"
    assert "set loads.device_direction to 0" in str(refused.value.fix)


@pytest.mark.slow
def test_the_rollers_bear_a_torque_that_jumps_within_a_stroke() -> None:
    """As closely as one that does not: against the midpoint rule over 40000 rows a part, 1e-6 with a jump in one."""
    zones = [{"from": 3, "to": 17.3, "value": 60.0}]
    loads = {**ROLLER, "forces": [{"on": "rocker", "torque": {"zones": zones}}]}
    made = factory.design("loaded_swing_cycle", command="loads", loads=loads)
    stroke, exponent = made.strokes[0], made.rollers_found.exponent
    borne = way = 0.0
    for first, last in stroke.parts:
        k = first + (np.arange(40_000) + 0.5) * (last - first) / 40_000
        turned = np.abs(stroke.bearing_speed(k)) * stroke.width / made.speed * (last - first) / 40_000
        borne += float(np.sum(np.abs(stroke.force(k)) ** exponent * turned))
        way += float(np.sum(turned))
    rest = next(each for each in made.rests if each.stroke is stroke).run(exponent)
    equivalent = ((borne + rest[0]) / (way + rest[1])) ** (1.0 / exponent)
    assert made.rollers_found.borne[0][0] == pytest.approx(equivalent, rel=2e-6)
