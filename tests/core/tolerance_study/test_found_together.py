"""Samples of cams whose searches run together have what each finds by itself."""

from __future__ import annotations

import random
from typing import Any

import factory
import pytest

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.many_designs import sought
from gearlink.core.studies.explore.base import Base

FILES = {
    "barrel_cam": ("cam", {"cam.radius": 0.5, "cam.depth": 0.2, "follower.roller_radius": 0.2}),
    "loaded_measured_cam": ("analyze", {"roller_radius": 0.3, "follower.offset": 1.0}),
    "cam_gear": ("analyze", {"lever.length": 0.5, "lever.angle": 1.0, "roller_radius": 0.2}),
    "cam_linkage": ("analyze", {"links.coupler": 0.5, "links.follower": 0.5, "phase": 0.5, "roller_radius": 0.2}),
    "linked_cams": ("analyze", {"cams.x.base_radius": 0.5, "cams.y.base_radius": 0.5, "cams.x.roller_radius": 0.2}),
    "cycloidal_reducer": (
        "analyze",
        {"pin_radius": 0.01, "eccentricity": 0.01, "output_pins.radius": 0.01, "width": 1, "torque": 5},
    ),
}
KEPT = {"cam_gear": "groove.hollow", "cam_linkage": "groove.hollow", "barrel_cam": "walls",
        "loaded_measured_cam": "rates", "linked_cams": "cams.1.star_shaped",
        "cycloidal_reducer": "_stressed"}  # fmt: skip
"""A search that is run together."""


def _value(data: Any, path: str) -> float:
    for key in path.split("."):
        data = data[key]
    return float(data)


def _pairs(name: str, count: int) -> tuple[str, list[tuple[Any, Any]]]:
    """Designs alone, and the same found together."""
    (command, widths), random_numbers, data = FILES[name], random.Random(5), factory.worked(name)
    data = {key: value for key, value in data.items() if key not in ("tolerance", "register")}
    base = Base(data, command)
    rows = [[(k, _value(data, k) + random_numbers.uniform(-w, w)) for k, w in widths.items()] for _ in range(count)]
    alone, many = [base.design(row) for row in rows], [base.design(row) for row in rows]
    type(many[0]).find_together(many, ())
    return command, list(zip(alone, many, strict=True))


@pytest.mark.slow
@pytest.mark.parametrize("name", FILES)
def test_samples_found_together_are_those_found_alone(name: str) -> None:
    command, pairs = _pairs(name, 8)
    *way, last = KEPT[name].split(".")
    kept = pairs[0][1]
    for place in way:
        kept = kept[int(place)] if place.isdigit() else getattr(kept, place)
    assert last in vars(kept), "found together"
    for alone, many in pairs:
        for quantity in alone.outline(command).quantities:
            expected, own = alone.raw(quantity), many.raw(quantity)
            assert own == (expected if expected is None else pytest.approx(expected, rel=1e-10, abs=1e-10)), quantity
        found = [
            [(c.code, c.status) for check in d.outline(command).checks for c in d.check(check)] for d in (alone, many)
        ]
        assert found[0] == found[1]
    differing = "contact_stress" if name == "cycloidal_reducer" else "max_pressure_angle"
    assert len({str(pair[1].raw(differing)) for pair in pairs}) == len(pairs)


def test_what_does_not_exist_is_left_out_of_what_is_found_together() -> None:
    found: list[int] = []

    def find(some: Any) -> None:
        if 3 in some:
            raise NoSolution("3 does not exist")
        found.extend(some)

    sought(find, range(64))
    assert found == list(range(8, 64))
