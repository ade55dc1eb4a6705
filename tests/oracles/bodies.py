"""Bodies of the geared linkages by brute force: where every axis is over the cycle, and which two bodies come how near.

A second way that shares nothing with the engine: joints by the intersection of circles in complex numbers, from the
data of a design file alone; gaps sampled over the whole cycle and sampled again round the minimum.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np

Path = Callable[[np.ndarray], np.ndarray]
_SAMPLES, _ROUNDS = 1440, 4


@dataclass(frozen=True)
class Circle:
    """A gear (with `inner` where it is a ring) or a shaft on the path of its axis; a bare axis has no radius."""

    name: str
    path: Path
    radius: float | None
    inner: float | None = None
    shaft: bool = False


@dataclass(frozen=True)
class Machine:
    """Bodies, the range of the input, and the pairs that cannot meet: in mesh, on one axis, one rigid body, or free."""

    bodies: tuple[Circle, ...]
    apart: frozenset[frozenset[str]]
    start: float = 0.0
    end: float = 2.0 * math.pi

    def gaps(self) -> Iterator[tuple[frozenset[str], float]]:
        """Names of every two bodies that could meet, and their minimum gap [mm]."""
        for one, other in combinations(self.bodies, 2):
            names = frozenset((one.name, other.name))
            if names not in self.apart:
                yield names, self._least(one, other)

    def gap_at(self, names: frozenset[str], angle: float) -> float:
        """Gap of two bodies at an input angle [mm]."""
        one, other = (body for body in self.bodies if body.name in names)
        where = np.array([angle])
        return float(_gap(one, other, np.abs(one.path(where) - other.path(where)))[0])

    def _least(self, one: Circle, other: Circle) -> float:
        start, end = self.start, self.end
        for _ in range(_ROUNDS):
            angles = np.linspace(start, end, _SAMPLES)
            gap = _gap(one, other, np.abs(one.path(angles) - other.path(angles)))
            best, step = int(np.argmin(gap)), angles[1] - angles[0]
            start, end = max(self.start, angles[best] - step), min(self.end, angles[best] + step)
        return float(gap[best])


def _gap(one: Circle, other: Circle, distance: np.ndarray) -> np.ndarray:
    """Beside each other, or one of them within the other's ring, whichever leaves more."""
    ways = [distance - (one.radius or 0.0) - (other.radius or 0.0)]
    for ring, body in ((one, other), (other, one)):
        if ring.inner is not None:
            ways.append(ring.inner - distance - (body.radius or 0.0))
    return np.max(ways, axis=0)


def machine(data: dict[str, Any]) -> Machine:
    """The machine of a design file's data."""
    return _KINDS[data["kind"]](data)


def _still(point: complex) -> Path:
    return lambda angles: np.full(angles.shape, complex(point))


def _turning(radius: float) -> Path:
    return lambda angles: radius * np.exp(1j * angles)


def _joint(crank: float, coupler: float, rocker: float, frame: float, assembly: int) -> Path:
    """C by the cosine rule in the triangle BCD."""

    def path(angles: np.ndarray) -> np.ndarray:
        pin = crank * np.exp(1j * angles)
        line = frame - pin
        reach = np.abs(line)
        cosine = (coupler**2 + reach**2 - rocker**2) / (2.0 * coupler * reach)
        return pin + coupler * line / reach * np.exp(1j * assembly * np.arccos(cosine))

    return path


def _tip(data: dict[str, Any], teeth: int) -> float:
    return data["gears"]["module"] * (teeth + 2) / 2.0


def _ring(data: dict[str, Any], name: str, path: Path, teeth: int) -> Circle:
    gears = data["gears"]
    m = gears["module"]
    return Circle(name, path, gears.get("rim") or m * (teeth / 2 + 1.25 + 2.0), m * (teeth / 2 - 1.0))


def _shaft(data: dict[str, Any], name: str, point: complex, key: str) -> Circle:
    return Circle(name, _still(point), data.get("shafts", {}).get(key), shaft=True)


def _apart(*pairs: tuple[str, str]) -> frozenset[frozenset[str]]:
    return frozenset(frozenset(pair) for pair in pairs)


def _three_gear(data: dict[str, Any]) -> Machine:
    gears, links = data["gears"], data["links"]
    m, z1, z3, z5 = (gears[key] for key in ("module", "crank", "idler", "output"))
    lengths = links["crank"], m * (z1 + z3) / 2, m * (z3 + z5) / 2, links["frame"]
    frame = links["frame"]
    bodies = (
        Circle("the crank gear", _turning(links["crank"]), _tip(data, z1)),
        Circle("the idler", _joint(*lengths, data.get("assembly", 1)), _tip(data, z3)),
        Circle("the output gear", _still(frame), _tip(data, z5)),
        _shaft(data, "input shaft", 0, "input_radius"),
        _shaft(data, "output shaft", frame, "output_radius"),
    )
    meshes = (("the crank gear", "the idler"), ("the idler", "the output gear"))
    return Machine(
        bodies, _apart(*meshes, ("the output gear", "output shaft"), ("the crank gear", "input shaft"))
    )  # the crank gear is fixed to crank and input shaft


def _two_gear(data: dict[str, Any]) -> Machine:
    gears, frame = data["gears"], data["links"]["frame"]
    m, planet, ring = gears["module"], gears["planet"], gears.get("ring")
    crank = m * (ring - planet) / 2 if ring else m * (gears["sun"] + planet) / 2
    output = (
        _ring(data, "the ring gear", _still(0), ring)
        if ring
        else Circle("the sun", _still(0), _tip(data, gears["sun"]))
    )
    bodies = (
        Circle("the planet", _turning(crank), _tip(data, planet)),
        output,
        _shaft(data, "shaft at A", 0, "A_radius"),
        _shaft(data, "shaft at D", frame, "D_radius"),
    )
    return Machine(bodies, _apart(("the planet", output.name), (output.name, "shaft at A")))


def _rocker(data: dict[str, Any]) -> Machine:
    gears, links = data["gears"], data["links"]
    rocker = gears["module"] * (gears["coupler"] + gears["output"]) / 2
    joint = _joint(links["crank"], links["coupler"], rocker, links["frame"], data.get("assembly", 1))
    bodies = (
        Circle("the coupler gear", joint, _tip(data, gears["coupler"])),
        Circle("the output gear", _still(links["frame"]), _tip(data, gears["output"])),
        _shaft(data, "shaft at A", 0, "A_radius"),
        _shaft(data, "shaft at D", links["frame"], "D_radius"),
    )
    return Machine(bodies, _apart(("the coupler gear", "the output gear"), ("the output gear", "shaft at D")))


def _five_bar(data: dict[str, Any]) -> Machine:
    return _function(data) if data.get("form") == "function" else _path(data)


def _path(data: dict[str, Any]) -> Machine:
    gears = data["gears"]
    m, z1, z4, idler = gears["module"], gears["input"], gears["output"], gears.get("idler")
    internal = gears.get("mesh") == "internal"
    frame = data["links"].get("frame") or m * (abs(z4 - z1) if internal else z1 + z4) / 2
    ends = [
        Circle("the input gear", _still(0), _tip(data, z1)),
        Circle("the output gear", _still(frame), _tip(data, z4)),
    ]
    if internal:
        larger = 0 if z1 > z4 else 1
        ends[larger] = _ring(data, "the ring gear", ends[larger].path, max(z1, z4))
    shafts = [_shaft(data, "shaft at A", 0, "A_radius"), _shaft(data, "shaft at E", frame, "E_radius")]
    apart = [(end.name, shaft.name) for end, shaft in zip(ends, shafts, strict=True)]
    if idler is None:
        return Machine((*ends, *shafts), _apart(*apart, (ends[0].name, ends[1].name)))
    first, second = m * (z1 + idler) / 2, m * (idler + z4) / 2
    along = (frame**2 + first**2 - second**2) / (2 * frame)
    axis = complex(along, math.sqrt(first**2 - along**2))
    ends.append(Circle("the idler", _still(axis), _tip(data, idler)))
    shafts.append(_shaft(data, "shaft at O", axis, "O_radius"))
    meshes = [("the idler", end.name) for end in ends[:2]]
    return Machine((*ends, *shafts), _apart(*apart, *meshes, ("the idler", "shaft at O")))


def _function(data: dict[str, Any]) -> Machine:
    span = data.get("range") or {}
    two = _two_gear(data | {"links": {"frame": data["links"]["frame"]}})
    planet, fixed, at_a, _ = two.bodies
    at_e = _shaft(data, "shaft at E", data["links"]["frame"], "E_radius")
    start, end = math.radians(span.get("start", 0.0)), math.radians(span.get("end", 360.0))
    return Machine((planet, fixed, at_a, at_e), two.apart, start, end)


def _hypocycloid(data: dict[str, Any]) -> Machine:
    gears = data["gears"]
    bodies = (
        Circle(
            "the planet", _turning(gears["module"] * (gears["ring"] - gears["planet"]) / 2), _tip(data, gears["planet"])
        ),
        _ring(data, "the ring gear", _still(0), gears["ring"]),
        _shaft(data, "shaft at O", 0, "O_radius"),
    )
    return Machine(bodies, _apart(("the planet", "the ring gear"), ("the ring gear", "shaft at O")))


def _mutilated(data: dict[str, Any]) -> Machine:
    """The wheel stands on any side of A: what depends on its distance from D is free."""
    gears, frame = data["gears"], data.get("links", {}).get("frame")
    wheel = -1j * gears["module"] * (gears["full_teeth"] + gears["driven"]) / 2
    bodies = [
        Circle("the mutilated wheel", _still(wheel), _tip(data, gears["full_teeth"])),
        Circle("the driven gear", _still(0), _tip(data, gears["driven"])),
        _shaft(data, "shaft at A", 0, "A_radius"),
        _shaft(data, "shaft at W", wheel, "W_radius"),
    ]
    if frame is not None:
        bodies.append(_shaft(data, "shaft at D", frame, "D_radius"))
    same = (
        ("the mutilated wheel", "shaft at W"),
        ("the driven gear", "shaft at A"),
        ("the mutilated wheel", "the driven gear"),
    )
    return Machine(tuple(bodies), _apart(*same, ("the mutilated wheel", "shaft at D"), ("shaft at W", "shaft at D")))


_KINDS: dict[str, Callable[[dict[str, Any]], Machine]] = {
    "three-gear-four-bar": _three_gear,
    "two-gear-four-bar": _two_gear,
    "geared-rocker": _rocker,
    "geared-five-bar": _five_bar,
    "hypocycloid-dwell": _hypocycloid,
    "mutilated-gear-dwell": _mutilated,
}
