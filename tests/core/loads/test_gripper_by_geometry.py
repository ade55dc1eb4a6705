"""All forces of the swing gripper, link by link, from its circles and the places of its rollers alone.

Of the program this takes the swing's angle. The rest is written down anew: places over each phase of the law as
Chebyshev polynomials of degree 60 (24 over the 12 deg of constant speed), differentiated; cams as the ways of their
rollers. Tolerance 1e-8 of the largest force.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import factory
import numpy as np
import pytest
from numpy.polynomial import chebyshev

DEGREE, SHORT = 60, 24
INPUT, COUPLER, OUTPUT, MM = 150.0, 260.0, 100.0, 1e-3
A, E = 230.0 + 0j, 498.0 + 55.0j
SPEED = 12000.0 / 3600.0 * 2.0 * math.pi
GRAVITY = 3.0 - 9.0j
LOADS = {
    "gravity": [3.0, -9.0],
    "forces": [{"on": "output", "torque": -35.0}, {"on": "coupler", "point": [90, 20], "force": [60, -25]}],
}


def _course(f: Callable[[Any], Any], low: float, high: float) -> Callable[..., Any]:
    degree = DEGREE if high - low > 0.5 else SHORT
    series = chebyshev.chebinterpolate(lambda x: f(0.5 * (low + high) + 0.5 * (high - low) * x), degree)

    def value(theta: Any, order: int = 0) -> Any:
        found = chebyshev.chebder(series, order) if order else series
        return chebyshev.chebval((2.0 * theta - low - high) / (high - low), found) * (2.0 / (high - low)) ** order

    return value


def _cross(a: Any, b: Any) -> Any:
    return (np.conj(a) * b).imag


@pytest.mark.parametrize(("start", "end"), [(0.0, 100.0), (100.0, 112.0), (112.0, 162.0), (170.0, 230.0)])
def test_gripper(start: float, end: float) -> None:
    """Of a modified sine the first half: its pieces meet in the middle, and at an eighth, which is left out."""
    design = factory.design("loaded_gripper", command="loads", loads=LOADS)
    if start == 170.0:
        start, end = 170.0 + 120.0 / 8.0, 170.0 + 120.0 * 7.0 / 8.0
    low, high = math.radians(start), math.radians(end)
    spec, law = design.spec, design.design.law

    def output(theta: Any) -> Any:
        return math.radians(110.0) - law.evaluate(np.clip(np.degrees(theta), start, end * (1.0 - 1e-15)), 0)[0]

    def pin_d(theta: Any) -> Any:
        return MM * (E + OUTPUT * np.exp(1j * output(theta)))

    def pin_c(theta: Any) -> Any:
        way = pin_d(theta) - MM * A
        n, one, two = np.abs(way), MM * INPUT, MM * COUPLER
        along = (one**2 - two**2 + n * n) / (2.0 * n)
        # left of A->D for assembly +1
        return MM * A + way / n * (along + 1j * np.sqrt((one - along) * (one + along)))

    def rocker(theta: Any) -> Any:
        return np.angle((pin_c(theta) - MM * A) / 1j) + 0.5 * math.pi

    def coupler(theta: Any) -> Any:
        return np.unwrap(np.angle(pin_d(theta) - pin_c(theta)))

    def roller(degrees: float) -> Callable[[Any], Any]:
        return lambda theta: MM * (A + 160.0 * np.exp(1j * (rocker(theta) + math.radians(degrees))))

    theta = low + (high - low) * np.array([0.04, 0.3, 0.55, 0.8, 0.97])
    turns = {name: _course(f, low, high) for name, f in (("in", rocker), ("cp", coupler), ("out", output))}
    middle = _course(lambda t: 0.5 * (pin_c(t) + pin_d(t)), low, high)
    point = pin_c(theta) + MM * complex(90, 20) * np.exp(1j * coupler(theta))
    given, mass = spec.inertia, spec.inertia.coupler_mass
    load = 60.0 - 25.0j
    wanted = mass * (middle(theta, 2) * SPEED**2 - GRAVITY) - load
    c, d = pin_c(theta), pin_d(theta)
    moment = given.coupler * turns["cp"](theta, 2) * SPEED**2 + _cross(middle(theta) - c, wanted + load)
    moment -= _cross(point - c, load)
    on_output = given.output * turns["out"](theta, 2) * SPEED**2 + 35.0
    # the coupler's moment about C and the output's about E: what D bears
    arm, lever = d - c, d - MM * E
    rows = np.array([[arm.imag, -arm.real], [-lever.imag, lever.real]]).transpose(2, 0, 1)
    x, y = np.linalg.solve(rows, np.array([moment, on_output]).T[..., None])[..., 0].T
    force_d = x + 1j * y
    force_c = wanted + force_d

    def normal(place: Callable[[Any], Any]) -> Any:
        """Out of a cam that turns clockwise with the cylinder."""
        way = _course(lambda t: place(t) * np.exp(1j * t), low, high)
        along = way(theta, 1) * np.exp(-1j * theta)
        found = 1j * along / np.abs(along)
        return found * np.sign((np.conj(place(theta)) * found).real)

    main, back = roller(49.0), roller(49.0 + 88.0)
    n1, n2 = normal(main), normal(back)
    lever1, lever2 = _cross(main(theta) - MM * A, n1), _cross(back(theta) - MM * A, n2)
    closing = 400.0 * np.sign(lever1)
    assert (np.sign(lever2) == -np.sign(lever1)).all()
    turning = turns["in"](theta, 2) * SPEED**2
    first = (given.input * turning + closing + _cross(c - MM * A, force_c)) / lever1
    second = (given.return_rocker * turning - closing) / lever2
    found = design.machine.reactions(theta)
    expected = {"D": force_d, "C": force_c, "A": force_c - first * n1, "A_return": -second * n2,
                "E": -force_d, "O": first * n1 + second * n2}  # fmt: skip
    largest = max(np.abs(force).max() for force in expected.values())
    for name, force in expected.items():
        assert np.abs(found.force(name) - force).max() <= 1e-8 * largest, name
    assert np.abs(found.unknowns["main"][0] - first).max() <= 1e-8 * largest
    assert np.abs(found.unknowns["return"][0] - second).max() <= 1e-8 * largest

    def energy(t: Any) -> Any:
        moving = 0.5 * mass * np.abs(middle(t, 1)) ** 2 + 0.5 * given.coupler * turns["cp"](t, 1) ** 2
        moving += 0.5 * (given.input + given.return_rocker) * turns["in"](t, 1) ** 2
        moving += 0.5 * given.output * turns["out"](t, 1) ** 2
        return moving * SPEED**2 - mass * (np.conj(GRAVITY) * middle(t)).real + 35.0 * turns["out"](t)

    hung = _course(lambda t: pin_c(t) + MM * complex(90, 20) * np.exp(1j * coupler(t)), low, high)
    torque = _course(energy, low, high)(theta, 1) - (np.conj(load) * hung(theta, 1)).real
    size = np.abs(torque).max()
    assert np.abs(found.torque - torque).max() <= 1e-8 * size
    assert np.abs(design.machine.torque(theta) - torque).max() <= 1e-8 * size
