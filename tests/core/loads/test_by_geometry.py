"""Loads of machines written down anew from circles and lines, against free bodies that know nothing of the program.

Tolerance 1e-9 of the largest value: second derivatives by 512 Fourier coefficients lose 256^2 eps = 1.5e-11, the
integration of nothing. Kinds and forms that no published case has: five-bars for a function with sun and with ring, a
two-gear four-bar with a ring, an unbalanced hypocycloid, a mutilated gear, an offset slider-crank.
"""

from __future__ import annotations

import math
from typing import Any

import factory
import numpy as np
import pytest
from oracles.free_bodies import ROWS, Body, Machine, angle, circle_meet, cis, phi

MM, RPM = 1e-3, 2.0 * math.pi / 60.0
ALPHA = math.radians(20.0)
CRANK = {"mass": 1.4, "inertia": 0.0021, "center": [12, 3]}
COUPLER = {"mass": 2.2, "inertia": 0.0065, "center": [25, -8]}
ROCKER = {"mass": 1.9, "inertia": 0.0054, "center": [48, 6]}
WHEEL = {"mass": 1.1, "inertia": 0.016}
GRAVITY = [2.0, -9.0]


def body(origin: Any, turn: Any, given: dict[str, Any] | None = None) -> Body:
    place = np.asarray(origin) + np.zeros(ROWS, dtype=complex)
    given = given or {}
    center = complex(*given.get("center", [0.0, 0.0]))
    return Body(place, turn + np.zeros(ROWS), given.get("mass", 0.0), given.get("inertia", 0.0), center)


def compare(spec: dict[str, Any], machine: Machine) -> None:
    """Torque both ways, pins and teeth."""
    design = factory.design(spec, command="loads")
    found = design.machine.reactions(phi())
    forces, drive = machine.forces()
    torque = machine.torque()
    size = np.abs(torque).max()
    assert np.abs(drive - torque).max() <= 1e-9 * size
    assert np.abs(design.machine.torque(phi()) - torque).max() <= 1e-9 * size
    assert np.abs(found.torque - torque).max() <= 1e-9 * size
    largest = max(np.abs(forces[name]).max() for name in machine.pins)
    for name in machine.pins:
        assert np.abs(found.force(name) - forces[name]).max() <= 1e-9 * largest, name
    for name in machine.guides:
        assert np.abs(found.unknowns[name][0] - forces[name]).max() <= 1e-9 * largest, name
    for name in machine.teeth:
        both = found.force(name) + found.radial(name)
        assert np.abs(np.abs(both) - forces[name]).max() <= 1e-9 * largest, name
    assert design.power_identity <= 1e-12


@pytest.mark.parametrize(("planet", "fixed", "ring"), [(30, 30, False), (20, 60, True)])
def test_five_bar_for_a_function(planet: int, fixed: int, ring: bool) -> None:
    """The planet is fixed to the coupler and rolls on the sun, or in the ring, that stands still about A."""
    links = {"coupler": 15.0, "follower": 120.0, "output": 110.0, "frame": 100.0}
    masses = {"input": CRANK, "coupler": COUPLER | {"center": [8, -8]}, "follower": ROCKER, "output": ROCKER}
    spec = {
        "kind": "geared-five-bar",
        "form": "function",
        "gears": {"module": 1.0, "planet": planet, "ring" if ring else "sun": fixed},
        "links": links,
        "phase": 60,
        "loads": {
            "speed": 240,
            "gravity": GRAVITY,
            "links": masses,
            "forces": [{"on": "output", "torque": -4.0}],
            "springs": [{"between": ["follower", "frame"], "points": [[60, 5], [40, 150]], "rate": 3.0,
                         "free_length": 40, "preload": -20}],
        },
    }  # fmt: skip
    sign = -1.0 if ring else 1.0
    length = 0.5 * (fixed + sign * planet)
    turn = math.radians(60.0) + (1.0 + sign * fixed / planet) * phi()
    b = MM * length * np.exp(1j * phi())
    c = b + MM * links["coupler"] * np.exp(1j * turn)
    e = MM * links["frame"] + np.zeros(ROWS)
    d = circle_meet(c, e, MM * links["follower"], MM * links["output"], 1)
    bodies = {
        "input": body(0j, phi(), masses["input"]),
        "coupler": body(b, turn, masses["coupler"]),
        "follower": body(c, angle(d - c), masses["follower"]),
        "output": body(e, angle(d - e), masses["output"]),
    }
    bodies["output"].loads.append((0j * b, e + 0j, np.full(ROWS, -4.0)))
    hook = bodies["follower"].at(complex(60, 5))
    way = MM * complex(40, 150) - hook
    pull = (-20.0 + 3.0 * (np.abs(way) / MM - 40.0)) * way / np.abs(way)
    bodies["follower"].loads.append((pull, hook, np.zeros(ROWS)))
    unit = np.exp(1j * phi())
    pitch = MM * 0.5 * fixed * unit
    pins = {"A": ("frame", "input", 0j * b), "B": ("input", "coupler", b), "C": ("coupler", "follower", c),
            "D": ("follower", "output", d), "E": ("frame", "output", e + 0j)}  # fmt: skip
    teeth = {"mesh_25": ("frame", "coupler", pitch, unit, sign * ALPHA)}
    compare(spec, Machine(bodies, pins, "input", 240.0 * RPM, complex(*GRAVITY), {}, teeth))


def test_two_gears_with_a_ring_on_the_crank_shaft() -> None:
    """Ring output on A, planet fixed to the coupler at B, inside of it."""
    a, b, c, d = 14.0, 30.0, 40.0, 45.0
    masses = {"crank": CRANK, "coupler": COUPLER, "rocker": ROCKER, "output": WHEEL}
    spec = {
        "kind": "two-gear-four-bar",
        "gears": {"module": 2, "planet": 48, "ring": 62},
        "links": {"coupler": b, "rocker": c, "frame": d},
        "loads": {"speed": -150, "gravity": GRAVITY, "links": masses, "forces": [{"on": "output", "torque": 7.0}]},
    }
    pin = MM * a * np.exp(1j * phi())
    end = circle_meet(pin, MM * d + np.zeros(ROWS), MM * b, MM * c, 1)
    turn = angle(end - pin)
    bodies = {
        "crank": body(0j, phi(), masses["crank"]),
        "coupler": body(pin, turn, masses["coupler"]),
        "rocker": body(MM * d, angle(end - MM * d), masses["rocker"]),
        "output": body(0j, phi() + 48 / 62 * (turn - phi()), masses["output"]),
    }
    # the ring's own turning over a crank turn is no whole number: its angle is taken less the mean of that
    bodies["output"].turn = bodies["output"].turn - (1.0 - 48 / 62) * phi()
    steady = 1.0 - 48 / 62
    bodies["output"].loads.append((0j * pin, 0j * pin, np.full(ROWS, 7.0)))
    unit = np.exp(1j * phi())
    pins = {"A": ("frame", "crank", 0j * pin), "B": ("crank", "coupler", pin), "C": ("coupler", "rocker", end),
            "D": ("frame", "rocker", MM * d + 0j * pin), "A_output": ("frame", "output", 0j * pin)}  # fmt: skip
    teeth = {"mesh_25": ("output", "coupler", MM * 62.0 * unit, unit, -ALPHA)}
    machine = Machine(bodies, pins, "crank", -150.0 * RPM, complex(*GRAVITY), {}, teeth)
    plain = machine.torque

    def torque() -> Any:
        """With the even part of the ring's turning, which has energy and takes the load's work."""
        from oracles.free_bodies import derivative

        rate = derivative(bodies["output"].turn)
        even = derivative(0.5 * 0.016 * ((rate + steady) ** 2 - rate**2)) * machine.speed**2
        return plain() + even - 7.0 * steady

    machine.torque = torque  # type: ignore[method-assign]
    compare(spec, machine)


def test_unbalanced_hypocycloid() -> None:
    """Planet and rod with their masses aside."""
    masses = {"carrier": CRANK, "planet": WHEEL | {"center": [4, -3]}, "rod": COUPLER | {"center": [70, 9]},
              "slider": {"mass": 2.5}}  # fmt: skip
    spec = {
        "kind": "hypocycloid-dwell",
        "gears": {"module": 1.6, "planet": 25, "ring": 75},
        "rod": {"length": 140},
        "loads": {"speed": 200, "gravity": GRAVITY, "links": masses, "forces": [{"on": "slider", "force": -120}]},
    }
    r = MM * 20.0
    axis = 2.0 * r * np.exp(1j * phi())
    point = axis - r * np.exp(-2j * phi())
    end = point.real + np.sqrt((MM * 140.0) ** 2 - point.imag**2) + 0j
    bodies = {
        "carrier": body(0j, phi(), masses["carrier"]),
        "planet": body(axis, -2.0 * phi(), masses["planet"]),
        "rod": body(point, angle(end - point), masses["rod"]),
        "slider": body(end, 0.0, masses["slider"]),
    }
    bodies["slider"].loads.append((-120.0 + 0j * end, end, np.zeros(ROWS)))
    unit = np.exp(1j * phi())
    pins = {"O": ("frame", "carrier", 0j * end), "planet": ("carrier", "planet", axis), "M": ("planet", "rod", point),
            "F": ("rod", "slider", end)}  # fmt: skip
    teeth = {"mesh_ring": ("frame", "planet", 3.0 * r * unit, unit, -ALPHA)}
    machine = Machine(bodies, pins, "carrier", 200.0 * RPM, complex(*GRAVITY), {"guide": ("slider", 1.0)}, teeth)
    compare(spec, machine)


@pytest.mark.parametrize("offset", [50.0, -120.0])
def test_offset_slider_crank(offset: float) -> None:
    """F lies below D on x = -offset; a force on the slider is positive away from D."""
    masses = {"crank": CRANK | {"center": [-40, 30]}, "rod": COUPLER | {"center": [200, 15]}, "slider": {"mass": 9.0}}
    spec = {
        "kind": "slider-crank",
        "crank": 100.0,
        "rod": 520.0,
        "offset": offset,
        "loads": {"speed": 180, "gravity": GRAVITY, "links": masses, "forces": [{"on": "slider", "force": 60.0}]},
    }
    pin = MM * 100.0 * np.exp(1j * phi())
    across = pin.real + MM * offset
    end = -MM * offset + 1j * (pin.imag - np.sqrt((MM * 520.0) ** 2 - across**2))
    bodies = {
        "crank": body(0j, phi(), masses["crank"]),
        "rod": body(pin, angle(end - pin), masses["rod"]),
        "slider": body(end, 0.0, masses["slider"]),
    }
    bodies["slider"].loads.append((-60j + 0j * end, end, np.zeros(ROWS)))
    pins = {"D": ("frame", "crank", 0j * end), "E": ("crank", "rod", pin), "F": ("rod", "slider", end)}
    machine = Machine(bodies, pins, "crank", 180.0 * RPM, complex(*GRAVITY), {"guide": ("slider", cis(-90.0))})
    compare(spec, machine)


def test_mutilated_gear_while_it_moves() -> None:
    """The driven gear turns the crank; a tooth of the wheel presses it where `wheel_direction` says."""
    masses = {"crank": CRANK, "coupler": COUPLER | {"center": [55, -8]}, "rocker": ROCKER}
    spec = {
        "kind": "mutilated-gear-dwell",
        "reduction": 6,
        "gears": {"module": 3, "full_teeth": 80, "group_teeth": 20, "groups": 1, "driven": 20},
        "links": {"crank": 40, "coupler": 120, "rocker": 100, "frame": 140},
        "loads": {"speed": 90, "gravity": GRAVITY, "links": masses, "forces": [{"on": "rocker", "torque": -25}],
                  "wheel_direction": 110},
    }  # fmt: skip
    rate = 80 / (20 * 6)
    pin = MM * 40.0 * np.exp(1j * phi())
    end = circle_meet(pin, MM * 140.0 + np.zeros(ROWS), MM * 120.0, MM * 100.0, 1)
    bodies = {
        "crank": body(0j, phi(), masses["crank"]),
        "coupler": body(pin, angle(end - pin), masses["coupler"]),
        "rocker": body(MM * 140.0, angle(end - MM * 140.0), masses["rocker"]),
    }
    bodies["rocker"].loads.append((0j * pin, bodies["rocker"].origin, np.full(ROWS, -25.0)))
    pins = {"A": ("frame", "crank", 0j * pin), "B": ("crank", "coupler", pin), "C": ("coupler", "rocker", end),
            "D": ("frame", "rocker", bodies["rocker"].origin)}  # fmt: skip
    machine = Machine(bodies, pins, "crank", 90.0 * RPM * rate, complex(*GRAVITY))
    forces, drive = machine.forces()
    design = factory.design(spec, command="loads")
    start = design.design.start_crank_angle  # where the machine stands between its motions
    found = design.machine.reactions(np.mod(phi() - start, 2.0 * math.pi) / rate)
    toward, tangential = cis(110.0), drive / (MM * 30.0)
    forces["A"] = forces["A"] - (1j * tangential - np.abs(tangential) * math.tan(ALPHA)) * toward
    assert np.abs(found.torque - rate * machine.torque()).max() <= 1e-9 * np.abs(rate * drive).max()
    assert np.abs(found.unknowns["mesh_wheel"][0] - tangential).max() <= 1e-9 * np.abs(tangential).max()
    largest = np.abs(forces["A"]).max()
    for name, force in forces.items():
        assert np.abs(found.force(name) - force).max() <= 1e-9 * largest, name
    standing = design.machine.reactions(np.array([2.0 * math.pi * 3.0]))
    assert standing.torque[0] == 0.0
