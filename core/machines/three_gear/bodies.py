"""The bodies of a three-gear four-bar: crank gear on B, idler on C, output gear on D, shafts at A and D."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from gearlink.core.machines.three_gear.motion import tip_radius
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.tooth.teeth import rim_radius
from gearlink.core.parts.linkages.codes import GEAR_COLLISION
from gearlink.core.studies.clearance.bodies import FULL_HEIGHT, Gear, Layout, Shaft, least_gap, least_shaft
from gearlink.core.studies.clearance.reach import constant, coupler_joint, crank_pin

if TYPE_CHECKING:
    from gearlink.core.base.report import Check
    from gearlink.core.machines.three_gear.motion import GearTrain
    from gearlink.core.machines.three_gear.spec import Gears, ThreeGearSpec
    from gearlink.core.parts.linkages.fourbar.position import FourBar


def layout(links: FourBar, train: GearTrain, spec: ThreeGearSpec, own: Mapping[str, Any] | None = None) -> Layout:
    """Gears, shafts and distances; the crank gear is one body with crank and input shaft.

    Parameters
        links : FourBar [mm]
        train : GearTrain
        spec : ThreeGearSpec
        own : dict of GearPair - meshes with teeth of their own; None: standard teeth
    """
    module, shafts = spec.gears.module, spec.shafts
    gears = (
        _own(own, train, spec.gears)
        if own is not None
        else (
            _gear("the crank gear", "B", train.crank, train, spec.gears, "CD" if train.internal else "C"),
            Gear("the idler", "C", tip_radius(train.idler, module), mates="BD"),
            _gear("the output gear", "D", train.output, train, spec.gears, "C"),
        )
    )
    return Layout(
        gears=gears,
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


def _gear(name: str, axis: str, teeth: float, train: GearTrain, gears: Gears, mates: str) -> Gear:
    """A gear by its teeth; a ring for negative ones. Rings stand in a plane of their own, apart from the other gear."""
    if teeth > 0:
        tip = tip_radius(teeth, gears.module)
        return Gear(name, axis, tip, mates=mates, root=tip - FULL_HEIGHT * gears.module)
    mesh = GearPair.from_shift(gears.module, (int(train.idler), int(teeth)))
    return Gear(f"{name}, a ring,", axis, _outer(axis, mesh, gears), -mesh.tip_radius[1], mates)


def _outer(axis: str, mesh: Any, gears: Gears) -> float:
    """Outer radius of a ring on B or D [mm]; the key `rim` is that of the output ring."""
    root, given = mesh.root_radius[1], gears.rim if axis == "D" else None
    return rim_radius(root, mesh.module, gears.rim_at(0 if axis == "B" else 2, root) if given is None else given)


def _own(meshes: Mapping[str, Any], train: GearTrain, gears: Gears) -> tuple[Gear, Gear, Gear]:
    """Gears with tips of their own; in the pair of a ring the idler is the first."""
    first, second = meshes.values()
    idler = first.tip_radius[0 if first.internal else 1]
    mates = "CD" if train.internal else "C"
    crank = "the crank gear, a ring," if first.internal else "the crank gear"
    output = "the output gear, a ring," if second.internal else "the output gear"
    return (
        _end("B", first, crank, gears, mates),
        Gear("the idler", "C", idler, mates="BD"),
        _end("D", second, output, gears, "C"),
    )


def _end(axis: str, pair: Any, name: str, gears: Gears, mates: str) -> Gear:
    """Crank or output gear of its pair."""
    if pair.internal:
        return Gear(name, axis, _outer(axis, pair, gears), -pair.tip_radius[1], mates)
    place = 0 if axis == "B" else 1
    return Gear(name, axis, pair.tip_radius[place], mates=mates, root=pair.root_radius[place])


def ring_planes(layout: Layout, train: GearTrain, limit: float) -> Check:
    """GL301 of a train with a ring: the third gear stays within it, or must stand in another plane.

    Parameters
        layout : Layout - gears 1, idler and 5
        train : GearTrain
        limit : float [mm] - least gap
    """
    crank, _, output = layout.gears
    gap = least_gap(crank, output, layout.reaches["BD"]).gap
    ring, other = ("the output ring", "the crank gear") if train.output < 0 else ("the crank ring", "the output gear")
    if gap >= limit:
        text = f"{other} turns within {ring} and keeps {gap:.6g} mm from its tips at the closest"
        return GEAR_COLLISION.check("pass", text, gap, limit, "mm")
    text = f"{other} sweeps through {ring}: put them side by side on a wide idler, in planes of their own"
    return GEAR_COLLISION.check("warn", text)
