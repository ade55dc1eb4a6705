"""The bodies of the planet linkages: a gear on the coupler, one on a pivot, shafts at A and D."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gearlink.core.studies.clearance import (
    Gear,
    Layout,
    constant,
    coupler_joint,
    crank_pin,
    least_shaft,
    ring_gear,
    shafts_at,
)

if TYPE_CHECKING:
    from gearlink.core.machines.planet_linkages.rocker_design import GearedRocker
    from gearlink.core.machines.planet_linkages.two_gear_design import TwoGearFourBar


def two_gear_layout(design: TwoGearFourBar) -> Layout:
    """Planet on B, sun or ring gear on A."""
    links, spec, mesh = design.linkage, design.spec, design.mesh
    planet = Gear("the planet", "B", mesh.tip_radius[0], mates="A")
    output = (
        ring_gear("A", mesh, rim=design.outer_rim())
        if design.internal
        else Gear("the sun", "A", mesh.tip_radius[1], root=mesh.root_radius[1])
    )
    return Layout(
        gears=(planet, output),
        shafts=shafts_at("AD", spec.shafts),
        reaches={"AB": constant(links.crank), "AD": constant(links.frame), "BD": crank_pin(links.crank, links.frame)},
        least_shaft=least_shaft(spec.limits, spec.gears.module),
    )


def rocker_layout(design: GearedRocker) -> Layout:
    """Coupler gear on C, output gear on D."""
    links, spec = design.linkage, design.spec
    coupler, output = design.mesh.tip_radius
    return Layout(
        gears=(
            Gear("the coupler gear", "C", coupler, mates="D"),
            Gear("the output gear", "D", output, root=design.mesh.root_radius[1]),
        ),
        shafts=shafts_at("AD", spec.shafts),
        reaches={"AC": coupler_joint(links), "AD": constant(links.frame), "CD": constant(links.rocker)},
        least_shaft=least_shaft(spec.limits, spec.gears.module),
    )
