"""The bodies of the dwells by gears: planet in a ring about O; mutilated wheel on W, driven gear on A; shafts."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING

from gearlink.core.studies.clearance import Gear, Layout, constant, least_shaft, ring_gear, shafts_at

if TYPE_CHECKING:
    from gearlink.core.machines.dwell_gears.hypocycloid_design import HypocycloidDwell
    from gearlink.core.machines.dwell_gears.mutilated_design import MutilatedGearDwell


def hypocycloid_layout(design: HypocycloidDwell) -> Layout:
    """The planet on its carrier goes round the shaft O."""
    spec, mesh = design.spec, design.mesh
    return Layout(
        gears=(Gear("the planet", "M", mesh.tip_radius[0], mates="O"), ring_gear("O", mesh, rim=design.rim_of(""))),
        shafts=shafts_at("O", spec.shafts),
        reaches={"MO": constant(design.carrier_length)},
        least_shaft=least_shaft(spec.limits, spec.gears.module),
    )


def mutilated_layout(design: MutilatedGearDwell) -> Layout:
    """The wheel stands on any side of A, its distance from the rocker's shaft D free, unless the loads say where."""
    spec, mesh, linkage = design.spec, design.mesh, design.linkage
    (wheel, driven), roots = mesh.tip_radius, mesh.root_radius
    reaches = {"AW": constant(mesh.center_distance)}
    if linkage is not None:
        reaches["AD"] = constant(linkage.frame)
        if spec.loads is not None and spec.loads.wheel_direction is not None:
            place = cmath.rect(mesh.center_distance, math.radians(spec.loads.wheel_direction))
            reaches["DW"] = constant(abs(place - linkage.frame))
    return Layout(
        gears=(
            Gear("the mutilated wheel", "W", wheel, mates="A", root=roots[0]),
            Gear("the driven gear", "A", driven, root=roots[1]),
        ),
        shafts=shafts_at("AW" if linkage is None else "ADW", spec.shafts),
        reaches=reaches,
        least_shaft=least_shaft(spec.limits, spec.gears.module),
    )
