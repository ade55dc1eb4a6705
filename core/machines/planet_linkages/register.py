"""What the errors of two-gear four-bar and geared rocker move."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from gearlink.core.mechanism.dual import longer
from gearlink.core.mechanism.links import FRAME
from gearlink.core.studies.register.movable import Movable, Turned
from gearlink.core.studies.tolerance.sources import GearOfSource

if TYPE_CHECKING:
    from gearlink.core.machines.planet_linkages.rocker_design import GearedRocker
    from gearlink.core.machines.planet_linkages.two_gear_design import TwoGearFourBar
    from gearlink.core.mechanism.links import Mechanism


def two_gears(design: TwoGearFourBar, mechanism: Mechanism) -> Movable:
    """Links, the centre distance of the gears, which is the crank, and both gears."""
    output = "ring" if design.internal else "sun"
    return _movable(design, mechanism, "crank", "planet", output, design.planet_teeth)


def geared_rocker(design: GearedRocker, mechanism: Mechanism) -> Movable:
    """Links, the centre distance of the gears, which is the rocker, and both gears."""
    return _movable(design, mechanism, "rocker", "coupler", "output", design.coupler_gear_teeth)


def _movable(
    design: Any, mechanism: Mechanism, carrier: str, coupler_gear: str, output_gear: str, coupler_teeth: int
) -> Movable:
    bar, gears = design.linkage, design.spec.gears
    ends = {f"links.{name}": (name, getattr(bar, name)) for name in ("crank", "coupler", "rocker")}
    sizes = longer(mechanism, ends | {"links.frame": (FRAME, bar.frame)})
    center, alpha = f"{coupler_gear}_{output_gear}", math.radians(gears.pressure_angle)
    sizes[f"centers.{center}"] = sizes[f"links.{carrier}"]
    teeth = {coupler_gear: ("coupler", coupler_teeth), output_gear: ("output", design.output_teeth)}
    return Movable(
        sizes,
        {center: getattr(bar, carrier)},
        gears={
            name: Turned(link, GearOfSource(gears.module, gears.module * abs(z), alpha))
            for name, (link, z) in teeth.items()
        },
        radius=0.5 * gears.module * abs(design.output_teeth),
    )
