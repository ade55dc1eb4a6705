"""The bodies of a three-gear four-bar: crank gear on B, idler on C, output gear on D, shafts at A and D."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gearlink.core.clearance.bodies import Gear, Layout, Shaft, least_shaft
from gearlink.core.clearance.reach import constant, coupler_joint, crank_pin
from gearlink.core.three_gear.motion import tip_radius

if TYPE_CHECKING:
    from gearlink.core.linkages.fourbar import FourBar
    from gearlink.core.three_gear.motion import GearTrain
    from gearlink.core.three_gear.spec import ThreeGearSpec


def layout(links: FourBar, train: GearTrain, spec: ThreeGearSpec) -> Layout:
    """Gears, shafts and distances; the crank gear is one body with crank and input shaft."""
    module, shafts = spec.gears.module, spec.shafts
    crank, idler, output = (tip_radius(teeth, module) for teeth in (train.crank, train.idler, train.output))
    return Layout(
        gears=(
            Gear("the crank gear", "B", crank, mates="C"),
            Gear("the idler", "C", idler, mates="BD"),
            Gear("the output gear", "D", output, mates="C"),
        ),
        shafts=(
            Shaft("input shaft", "A", shafts.input_radius if shafts else None, "shafts.input_radius"),
            Shaft("output shaft", "D", shafts.output_radius if shafts else None, "shafts.output_radius"),
        ),
        reaches={
            "AC": coupler_joint(links),
            "AD": constant(links.frame),
            "BD": crank_pin(links.crank, links.frame),
            "CD": constant(links.rocker),
        },
        least_shaft=least_shaft(spec.limits, module),
    )
