"""Links and rollers of random grippers against a brute force over the axes of the frame, with joints of its own.

Tolerance: six rounds of 600 samples narrow the turn of the cylinder 100-fold each, so that a flat minimum and a link
that sweeps over an axis are met to rounding; distances are compared at 1e-9 of the largest length. The cylinder angle
that the engine names has the same distance within 1e-6 of that length: where a link sweeps over an axis, the distance
goes with the angle.
"""

from __future__ import annotations

import cmath
import math
import re
from collections import Counter
from collections.abc import Callable
from random import Random
from typing import Any

import factory
import numpy as np
import pytest

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.swing_gripper.design import Passes, links

Data = dict[str, Any]
Lines = dict[str, tuple[Any, Any, float]]


def drawn(random: Random) -> Data:
    """A gripper of the usual proportions; its cam may stand anywhere, since only its axis counts here."""
    arm, radius = random.uniform(150.0, 400.0), random.uniform(60.0, 160.0)
    phases = [random.uniform(70, 110), random.uniform(6, 15), random.uniform(40, 70), random.uniform(3, 15), 110.0]
    place = [cmath.rect(random.uniform(50.0, 250.0), random.uniform(0.0, math.tau)) for _ in range(3)]
    data: Data = {
        "kind": "swing-gripper",
        "speed": 9000,
        "cylinder": {"radius": radius},
        "arm": {"length": arm, "direction": random.uniform(-180, 180)},
        "links": {
            "input": random.uniform(60, 350),
            "coupler": random.uniform(60, 350),
            "output": random.uniform(60, 250),
        },
        "pivots": {"input": [place[0].real, place[0].imag], "output": [place[1].real, place[1].imag]},
        "output_direction": random.uniform(-180, 180),
        "swing_sense": random.choice([1, -1]),
        "assembly": random.choice([1, -1]),
        "phases": dict(zip(["accelerate", "constant", "decelerate", "far_dwell", "return"], phases, strict=True)),
        "handover": phases[0] + 0.5 * phases[1],
        "cam": {
            "center": [place[2].real, place[2].imag],
            "sense": random.choice([1, -1]),
            "shaft_radius": random.choice([0.0, random.uniform(10.0, 60.0)]),
            "roller": {"arm": random.uniform(60, 250), "angle": random.uniform(-180, 180), "radius": 25.0},
        },
        "limits": {"transmission_angle": 0.0},
    }
    data["phases"]["near_dwell"] = 360.0 - sum(phases)
    if random.random() < 0.7:
        data["cam"]["return_roller"] = data["cam"]["roller"] | {"angle": random.uniform(60, 110)}
    return data


def joints(data: Data, beta: Any) -> Lines:
    """Ends of every link and the radius of every roller where the gripper has swung by beta."""
    a, e = (complex(*data["pivots"][key]) for key in ("input", "output"))
    ac, cd, ed = (data["links"][key] for key in ("input", "coupler", "output"))
    d = e + ed * np.exp(1j * (math.radians(data["output_direction"]) + data["swing_sense"] * beta))
    along = (np.abs(d - a) ** 2 + ac**2 - cd**2) / (2.0 * np.abs(d - a))
    c = a + (d - a) / np.abs(d - a) * (along + 1j * data["assembly"] * np.sqrt(ac**2 - along**2))
    fixed = [joint + 0.0 * d for joint in (a, e)]
    found = {"coupler CD": (c, d, 0.0), "cam rocker AC": (fixed[0], c, 0.0), "output link ED": (fixed[1], d, 0.0)}
    ahead = 0.0
    for name, key in (("main", "roller"), ("return", "return_roller")):
        roller = data["cam"].get(key)
        if roller is not None:
            ahead += math.radians(roller["angle"])
            b = a + (c - a) / ac * roller["arm"] * cmath.exp(1j * ahead)
            found |= {f"{name} roller's arm": (fixed[0], b, 0.0), f"{name} roller": (b, b + 1e-300, roller["radius"])}
    return found


OWN = {"cam rocker AC": "A", "output link ED": "E", "main roller's arm": "A", "return roller's arm": "A"}


def distance(place: complex, start: Any, end: Any) -> Any:
    """By the area of the triangle where the foot lies on the line, else to the nearer end."""
    one, other, length = np.abs(place - start), np.abs(place - end), np.abs(end - start)
    if not length.any():
        return one
    beside = np.abs((np.conj(end - start) * (place - start)).imag) / length
    return np.where(np.abs(one**2 - other**2) < length**2, beside, np.minimum(one, other))


def brute(data: Data, beta_of: Callable[[Any], Any], place: complex, body: str) -> float:
    """The minimum distance over a revolution of the cylinder."""
    low, high = 0.0, 360.0
    for _ in range(6):
        theta = np.linspace(low, high, 601)
        start, end, _ = joints(data, beta_of(np.clip(theta, 0.0, 360.0)))[body]
        values = distance(place, start, end)
        best, step = theta[int(np.argmin(values))], 3.0 * (theta[1] - theta[0])
        low, high = best - step, best + step
    return float(values.min())


def judged(made: Any, data: Data) -> Counter[str]:
    """Every pair by its own distance and rightly warned of; how often each was and was not."""
    size, passes, statuses = 1000.0, Passes(made), Counter[str]()
    warnings = [check.message for check in links(made)]

    def beta_of(theta: Any) -> Any:
        return made.law.evaluate(theta, 0)[0]

    drum = made.handover_center
    axes = {"O": complex(*data["cam"]["center"]), "A": complex(*data["pivots"]["input"])}
    axes |= {"E": complex(*data["pivots"]["output"]), "T": complex(drum)}
    found = {(one.body, one.axis.letter): one for one in passes}
    bodies = joints(data, beta_of(np.zeros(1)))
    pairs = {(body, axis) for body in bodies for axis in axes if axis not in OWN.get(body, "")}
    pairs -= {(body, axis) for body in bodies if body.endswith("roller") for axis in "AO"}
    assert found.keys() == pairs
    for (body, letter), one in found.items():
        least = brute(data, beta_of, axes[letter], body)
        assert math.isclose(one.distance, least, rel_tol=0.0, abs_tol=1e-9 * size), (body, letter)
        start, end, radius = joints(data, beta_of(np.array([passes.cylinder_angle(one)])))[body]
        assert abs(float(distance(axes[letter], start, end)[0]) - least) < 1e-6 * size, (body, letter)
        needed = (data["cam"]["shaft_radius"] if letter == "O" else 0.0) or 25.0
        told = sum(
            re.match(rf"(the |overlap of the )?{body} ", text) is not None and one.axis.name in text
            for text in warnings
        )
        assert told == (least - radius < needed), (body, letter)
        statuses["warn" if told else "pass"] += 1
    assert len(warnings) == statuses["warn"]
    return statuses


def try_designs(count: int, seed: int) -> Counter[str]:
    random, tried, statuses = Random(seed), 0, Counter[str]()
    while tried < count:
        data = drawn(random)
        made = factory.design(data)
        try:
            _ = made.linkage
        except NoSolution:
            continue  # a linkage that does not close, or comes to a dead centre
        statuses += judged(made, data)
        tried += 1
    return statuses


@pytest.mark.slow
def test_no_link_over_a_shaft_is_missed_and_none_told_of_that_is_clear() -> None:
    statuses = try_designs(8, seed=1)
    assert min(statuses["warn"], statuses["pass"]) > 5


@pytest.mark.slow
def test_three_hundred_grippers() -> None:
    assert min(try_designs(300, seed=2).values()) > 200


def given(text: str) -> Data:
    """A gripper of one line: speed, R, EF and its direction, links, A, E, direction of ED, senses, phases, cam."""
    x = [float(word) for word in text.split()]
    roller = {"arm": x[24], "angle": x[25], "radius": x[26]}
    return {
        "kind": "swing-gripper",
        "speed": x[0],
        "cylinder": {"radius": x[1]},
        "arm": {"length": x[2], "direction": x[3]},
        "links": {"input": x[4], "coupler": x[5], "output": x[6]},
        "pivots": {"input": x[7:9], "output": x[9:11]},
        "output_direction": x[11],
        "swing_sense": int(x[12]),
        "assembly": int(x[13]),
        "phases": dict(
            zip(("accelerate", "constant", "decelerate", "far_dwell", "return", "near_dwell"), x[14:20], strict=True)
        ),
        "handover": x[14] + 0.5 * x[15],
        "cam": {
            "center": x[20:22],
            "sense": int(x[22]),
            "shaft_radius": x[23],
            "roller": roller,
            "return_roller": {"arm": x[27], "angle": x[28], "radius": x[26]},
        },
        "inertia": {"input": 0.05, "output": 0.2, "coupler": 0.02, "coupler_mass": 1.5, "return_rocker": 0.03},
        "spring": {"torque": 1500.0},
    }


NAMED = {
    ("coupler CD", "the cam shaft"): "9562.314 168.037 407.831 83.515 304.296 288.329 197.83 221.607 119.308 419.202 "
    "128.881 -50.242 1 -1 81.6 9.5 47.5 5.8 115.7 99.9 385.815 -125.72 -1 28.285 261.106 41.698 24.683 207.748 -75.772",
    ("cam rocker AC", "the cam shaft"): "8243.614 141.86 304.864 -149.461 364.7 367.194 148.349 -47.027 222.276 "
    "-195.359 433.696 64.33 1 -1 109.7 8 53.7 14.9 129.6 44.1 47.561 329.787 1 36.464 93.548 47.459 25.614 120 "
    "-100.149",
    ("output link ED", "the cam shaft"): "6062.064 93.714 308.492 -74.597 316.933 163.028 288.386 9.114 -247.417 "
    "47.265 -378.643 167.948 1 1 105.3 6.5 54.4 7.5 97.8 88.5 -193.371 -426.318 -1 33.975 216.618 -56.138 21.888 "
    "223.218 79.293",
    ("cam rocker AC", "the gripper's axis"): "4119.375 128.514 382.34 91.126 376.372 315.956 272.841 165.404 144.417 "
    "134.138 273.404 39.465 -1 1 74.8 9.5 51.1 3.4 115.1 106.1 302.278 -112.519 1 32.957 211.982 157.5 28.771 183.365 "
    "82.168",
    ("return roller's arm", "the gripper's axis"): "9110.609 102.034 342.498 -91.569 379.49 279.073 191.396 -164.517 "
    "-111.063 -327.315 -70.587 135.114 -1 1 91.6 8.2 45.7 12.9 119.9 81.7 -304.184 62.527 -1 33.775 199.118 -86.237 "
    "24.772 177.525 57.389",
    ("coupler CD", "takes the sheet"): "8270.999 62.15 213.801 2.305 362.069 271.763 243.092 -98.264 222.353 -149.081 "
    "438.082 49.533 1 -1 82.1 10.7 41.5 9.5 103 113.2 37.409 -12.107 1 21.444 233.11 -136.952 23.204 219.123 81.284",
    ("cam rocker AC", "takes the sheet"): "7731.716 65.358 164.711 114.814 348.209 307.047 222.361 131.424 -130.965 "
    "345.949 -203.167 4.987 1 1 86.5 15 69.3 9.5 101.5 78.2 -9.839 133.878 -1 31.526 218.496 118.759 31.591 228.257 "
    "-95.013",
    ("output link ED", "takes the sheet"): "9076.15 62.621 184.786 149.883 345.208 302.471 295.541 -75.399 219.42 "
    "-102.832 384.131 134.935 -1 1 93.3 9.5 59 9.5 115.8 72.9 70.797 252.854 -1 31.4 117.023 -100.343 26.543 78.451 "
    "-92.046",
    ("main roller's arm", "takes the sheet"): "5972.758 65.761 278.075 148.422 256.955 304.16 291.446 194.758 -146.841 "
    "473.173 -130.803 96.565 1 1 93.8 12.4 47.5 5.8 122.8 77.7 -80.36 -26.416 -1 23.193 221.722 0.24 21.829 209.726 "
    "84.352",
    ("main cam", "takes the sheet"): "7463.693 63.744 163.666 -88.425 370.894 297.904 212.864 154.075 146.372 189.432 "
    "328.141 -5.354 1 -1 77.9 7.7 54.8 10.2 125.8 83.6 374.684 94.977 -1 29.183 155.34 -47.254 26.526 157.303 81.371",
}


@pytest.mark.quick(2)
@pytest.mark.parametrize(("body", "axis"), NAMED)
def test_a_gripper_that_had_passed_every_check(body: str, axis: str) -> None:
    """Grippers whose links sweep over a shaft, of which nothing was said."""
    made = factory.design(given(NAMED[body, axis]), command="cam")
    found = [check for check in made.check("shaft-clearance") if check.status == "warn"]
    (check,) = [check for check in found if body in check.message and axis in check.message]
    assert (check.value or 0.0) < 2.0
    assert "overhung" in check.fix or "move" in check.fix or "turn" in check.fix
    assert made.check("transmission-angle")[0].status != "fail"


def test_no_shaft_is_thin_enough_where_a_link_sweeps_over_its_axis() -> None:
    data = given(NAMED["cam rocker AC", "the gripper's axis"])
    made = factory.design(data, limits={"least_shaft": 1e-9})
    assert ["cam rocker AC sweeps over the gripper's axis" in check.message for check in links(made)] == [True]


def test_the_worked_gripper_is_clear_of_every_shaft() -> None:
    assert not list(links(factory.design("swing_gripper")))


def test_a_cam_on_the_drum_has_one_axis_with_it() -> None:
    """Links beside that axis are told of once, by the radius of the cam shaft."""
    made = factory.design(given(NAMED["coupler CD", "takes the sheet"]))
    center = made.handover_center
    coaxial = factory.design(
        given(NAMED["coupler CD", "takes the sheet"]), cam__center=[center.real, center.imag], cam__shaft_radius=35.0
    )
    (text,) = [check.message for check in links(coaxial) if "coupler CD" in check.message]
    assert "the middle of the cam shaft (radius 35 mm)" in text
    assert text.endswith("at cylinder angle 0 deg")
