"""Designs side by side: driven gears for required times, rods for a dwell on an arc."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gearlink.core.base.candidates import Sought, nothing_sought, pairs, table

if TYPE_CHECKING:
    from gearlink.core.base.report import Table
    from gearlink.core.machines.dwell_gears.hypocycloid_design import HypocycloidDwell
    from gearlink.core.machines.dwell_gears.mutilated_design import MutilatedGearDwell

_DRIVEN = (17, 20, 24, 30, 36)
_GROUPS = (1, 2)
_SIZES = ("full_teeth", "group_teeth", "reduction", "center_distance", "motion_turns", "dwell_turns")
_MOVES = ("driven_speed_ratio", "rocker_start_speed", "min_transmission_angle")
_RODS = ("rod_length", "stroke", "dwell_ripple", "ripple_share", "tolerance_carrier_angle", "min_transmission_angle")


def mutilated(design: MutilatedGearDwell) -> Table:
    """Driven gears and groups of teeth for the required times."""
    spec = design.asked
    if spec.target is None or spec.reduction is not None:
        raise nothing_sought("give target: {motion_turns, dwell_turns} and omit reduction and teeth")
    keys = {"gears.groups": ("groups", "1"), "gears.driven": ("driven_teeth", "1")}
    driven = sorted({*_DRIVEN, design.driven_teeth})
    rows = pairs(sorted({*_GROUPS, spec.gears.groups}), driven)
    # Each candidate chooses its teeth anew, from what the file asks for.
    return table(design, Sought("analyze", keys, rows, (*_SIZES, *_MOVES)), spec)


def hypocycloid(design: HypocycloidDwell) -> Table:
    """The rods of every rule, and those that are found for a quality."""
    if design.spec.is_arm or design.spec.point.ratio != 1.0:
        raise nothing_sought("the rod is found only for a slider whose point lies on the pitch circle")
    rules = ["tangent-circle", "osculating", "minimax"]
    qualities = ["least-ripple", *(["widest-dwell"] if design.spec.dwell.tolerance is not None else [])]
    rows = [({"rule": rule}, None) for rule in rules] + [(None, {"quality": quality}) for quality in qualities]
    keys = {"rod": ("", ""), "target": ("", "")}
    return table(design, Sought("analyze", keys, rows, _RODS, "rod", [*rules, *qualities]))
