"""The bodies of a geared five-bar: gears on A and E with or without an idler on O, or a planet about A; shafts."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gearlink.core.studies.clearance.bodies import Gear, Layout, least_shaft, ring_gear, shafts_at
from gearlink.core.studies.clearance.reach import Reach, constant, crank_pin

if TYPE_CHECKING:
    from gearlink.core.machines.five_bar.design import GearedFiveBar


def layout(design: GearedFiveBar) -> Layout:
    """The bodies of either form."""
    gears, reaches = _path(design) if design.is_path else _function(design)
    spec, axes = design.spec, "AEO" if design.spec.gears.idler is not None else "AE"
    return Layout(gears, shafts_at(axes, spec.shafts), reaches, least_shaft(spec.limits, spec.gears.module))


def _path(design: GearedFiveBar) -> tuple[tuple[Gear, ...], dict[str, Reach]]:
    """Each gear is one body with its link; the idler turns on O in the frame."""
    reaches = {"AE": constant(design.frame_length)}
    first, *more = design.meshes.values()
    if first.internal:
        ring, pinion = ("A", "E") if design.signed_teeth[0] < 0 else ("E", "A")
        name = {"A": "the input gear", "E": "the output gear"}[pinion]
        return (
            ring_gear(ring, first, rim=design.outer_rim(design.mesh_names[0])),
            Gear(name, pinion, first.tip_radius[0], mates=ring, root=first.root_radius[0]),
        ), reaches
    driven = more[0] if more else first
    ends = (
        Gear("the input gear", "A", first.tip_radius[0], mates="O" if more else "E", root=first.root_radius[0]),
        Gear("the output gear", "E", driven.tip_radius[1], mates="O" if more else "A", root=driven.root_radius[1]),
    )
    if not more:
        return ends, reaches
    reaches |= {"AO": constant(design.center_distance[0]), "EO": constant(design.center_distance[1])}
    return (*ends, Gear("the idler", "O", first.tip_radius[1], root=first.root_radius[1])), reaches


def _function(design: GearedFiveBar) -> tuple[tuple[Gear, ...], dict[str, Reach]]:
    """The planet goes round the fixed gear as far as the range of the input takes it."""
    (mesh,), bar = design.meshes.values(), design.function_bar
    planet = Gear("the planet", "B", mesh.tip_radius[0], mates="A")
    rim = design.outer_rim(design.mesh_names[0])
    fixed = (
        ring_gear("A", mesh, rim=rim)
        if mesh.internal
        else Gear("the sun", "A", mesh.tip_radius[1], root=mesh.root_radius[1])
    )
    return (planet, fixed), {
        "AB": constant(bar.input),
        "AE": constant(bar.frame),
        "BE": crank_pin(bar.input, bar.frame, *design.input_range),
    }
