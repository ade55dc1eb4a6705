"""The bodies of a geared six-bar: its gears and shafts, train by train.

Trains that share a pin lie in planes of their own; all others are taken to lie in one.
"""

from __future__ import annotations

from collections.abc import Iterable
from itertools import chain, combinations
from typing import TYPE_CHECKING

from gearlink.core.machines.six_bar.spec import LINKS, PINS
from gearlink.core.studies.clearance.bodies import FULL_HEIGHT, Gear, Layout, least_shaft, ring_gear, shafts_at
from gearlink.core.studies.clearance.reach import Reach, constant, reaches

if TYPE_CHECKING:
    from gearlink.core.machines.six_bar.design import GearedSixBar


def layouts(design: GearedSixBar) -> tuple[Layout, ...]:
    """The bodies of each plane."""
    spec = design.spec
    one, other = (set(train.pins) for train in spec.trains)
    planes = ((0,), (1,)) if one & other else ((0, 1),)
    shafts = shafts_at("AF", spec.shafts)
    least = least_shaft(spec.limits, max(train.module for train in spec.trains))
    gears = [tuple(gear for i in plane for gear in _gears(design, i)) for plane in planes]
    reaches = _reaches(design, chain(*gears))
    return tuple(Layout(each, shafts, reaches, least) for each in gears)


def _gears(design: GearedSixBar, number: int) -> list[Gear]:
    """The gears of a train, called by their pins.

    Notes
        The end gears are fixed to links: a first gear on B to the input link AB, a last gear on E to the output link
        EF. Each is one body with the shaft of that link.
    """
    train, meshes = design.spec.trains[number], design.train_meshes[number]
    found = []
    for k, (pin, teeth) in enumerate(zip(train.pins, train.gears, strict=True)):
        mesh = meshes[min(k, len(meshes) - 1)]
        mates = "".join(train.pins[j] for j in (k - 1, k + 1) if 0 <= j < len(train.pins))
        shaft = "A" if pin == "B" and k == 0 else "F" if pin == "E" and k == len(train.pins) - 1 else ""
        if teeth < 0:
            ring = ring_gear(pin, mesh, mates, train.rim)
            found.append(ring._replace(name=f"the ring gear on {pin}", turns_with=shaft))
            continue
        tip = 0.5 * train.module * teeth + train.module
        found.append(
            Gear(f"the gear on {pin}", pin, tip, mates=mates, turns_with=shaft, root=tip - FULL_HEIGHT * train.module)
        )
    return found


def _reaches(design: GearedSixBar, gears: Iterable[Gear]) -> dict[str, Reach]:
    """Least and greatest distances of the pins with gears, and of A and F, over the course."""
    axes = sorted({gear.axis for gear in gears} | {"A", "F"})
    found: dict[str, Reach] = {}
    moving: list[str] = []
    for pair in combinations(axes, 2):
        i, j = (PINS.index(pin) for pin in pair)
        if j - i in (1, 5):  # a link, the frame among them
            found["".join(pair)] = constant(design.bar.lengths[j if j - i == 1 else 0])
        else:
            moving.append("".join(pair))
    if not moving:
        return found
    held = dict(zip("ABCDEF", (*LINKS[1:5], "output", "output"), strict=True))
    return found | reaches(
        design.moving, {pin: (held[pin], pin) for pin in axes}, moving, samples=design.course.samples
    )
