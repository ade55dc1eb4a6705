"""The bodies of a geared six-bar: its gears and shafts, train by train.

Trains that share a pin lie in planes of their own; all others are taken to lie in one.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.clearance.bodies import Gear, Layout, least_shaft, ring_gear, shafts_at
from gearlink.core.clearance.reach import Reach, constant
from gearlink.core.gears.internal_mesh import InternalMesh
from gearlink.core.numerics.extremes import maximum_over, minimum_over
from gearlink.core.six_bar.loop import pins
from gearlink.core.six_bar.spec import PINS

if TYPE_CHECKING:
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.six_bar.design import GearedSixBar


def layouts(design: GearedSixBar) -> tuple[Layout, ...]:
    """The bodies of each plane."""
    spec = design.spec
    one, other = (set(train.pins) for train in spec.trains)
    planes = ((0,), (1,)) if one & other else ((0, 1),)
    shafts = shafts_at("AF", spec.shafts)
    least = least_shaft(spec.limits, max(train.module for train in spec.trains))
    gears = [tuple(gear for i in plane for gear in _gears(design, i)) for plane in planes]
    return tuple(Layout(each, shafts, _reaches(design, each), least) for each in gears)


def _gears(design: GearedSixBar, number: int) -> list[Gear]:
    """The gears of a train, called by their pins."""
    train, meshes = design.spec.trains[number], design.train_meshes[number]
    found = []
    for k, (pin, teeth) in enumerate(zip(train.pins, train.gears, strict=True)):
        mesh = meshes[min(k, len(meshes) - 1)]
        mates = "".join(train.pins[j] for j in (k - 1, k + 1) if 0 <= j < len(train.pins))
        if teeth < 0:
            assert isinstance(mesh, InternalMesh), "a ring makes its mesh internal"
            found.append(replace(ring_gear(pin, mesh, mates), name=f"the ring gear on {pin}"))
            continue
        tip = 0.5 * train.module * teeth + train.module
        found.append(Gear(f"the gear on {pin}", pin, tip, mates=mates))
    return found


def _reaches(design: GearedSixBar, gears: tuple[Gear, ...]) -> dict[str, Reach]:
    axes = sorted({gear.axis for gear in gears} | {"A", "F"})
    return {a + b: _reach(design, a, b) for a, b in combinations(axes, 2)}


def _reach(design: GearedSixBar, one: str, other: str) -> Reach:
    """Least and greatest distance of two pins over the course."""
    i, j = (PINS.index(pin) for pin in (one, other))
    if j - i == 1:
        return constant(design.bar.lengths[j])
    if (one, other) == (PINS[0], PINS[-1]):
        return constant(design.bar.lengths[0])

    def distance(phi: Reals) -> Reals:
        placed = pins(design.bar, phi, design.course.angles(phi))
        return np.asarray(np.abs(placed[i] - placed[j]))

    ends = design.course.start, design.course.end
    near = minimum_over(distance, *ends, samples=design.course.samples)
    far = maximum_over(distance, *ends, samples=design.course.samples)
    return Reach(near.value, far.value, near.place, far.place)
