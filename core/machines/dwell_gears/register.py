"""What the errors of hypocycloid dwell and mutilated gear move."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from gearlink.core.mechanism.dual import Shift, longer
from gearlink.core.mechanism.links import FRAME
from gearlink.core.studies.register.movable import Movable, Turned
from gearlink.core.studies.tolerance.sources import GearOfSource

if TYPE_CHECKING:
    from gearlink.core.machines.dwell_gears.hypocycloid_design import HypocycloidDwell
    from gearlink.core.machines.dwell_gears.mutilated_design import MutilatedGearDwell
    from gearlink.core.mechanism.links import Mechanism


def hypocycloid(design: HypocycloidDwell, mechanism: Mechanism) -> Movable:
    """The rod, the carrier, which is the centre distance of planet and ring, and the planet's teeth."""
    gears, arm = design.spec.gears, design.carrier_length
    ends = {"centers.planet_ring": ("carrier", arm)}
    if not design.spec.is_arm:
        ends["rod.length"] = ("rod", design.slider.rod)
    sizes = longer(mechanism, ends)
    alpha = math.radians(gears.pressure_angle)
    teeth = {name: GearOfSource(gears.module, gears.module * z, alpha) for name, z in
             (("planet", gears.planet), ("ring", gears.ring))}  # fmt: skip
    links = {"planet": "planet", "ring": FRAME}
    return Movable(
        sizes,
        {"planet_ring": arm},
        gears={name: Turned(links[name], each) for name, each in teeth.items()},
        radius=arm if design.spec.is_arm else 0.0,
    )


def mutilated(design: MutilatedGearDwell, mechanism: Mechanism) -> Movable:
    """The links of the four-bar, the angle at which it starts, and the runout of the driven gear."""
    bar, gears = design.linkage, design.spec.gears
    diameter = gears.module * design.driven_teeth
    driven = GearOfSource(gears.module, diameter, math.radians(gears.pressure_angle))
    found = {"driven": Turned("crank", driven)}
    if bar is None:
        return Movable(gears=found, radius=0.5 * diameter)
    ends = {f"links.{name}": (name, getattr(bar, name)) for name in ("crank", "coupler", "rocker")}
    sizes = longer(mechanism, ends | {"links.frame": (FRAME, bar.frame)})
    sizes["start_angle"] = (Shift("crank", ("B",), math.radians(1.0), turned=True),)
    return Movable(sizes, gears=found, radius=bar.rocker)
