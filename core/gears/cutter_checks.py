"""Checks of the pinion cutter that shapes a ring."""

from __future__ import annotations

from collections.abc import Iterator

from gearlink.core.gears.codes import INTERFERENCE, TIP_FOULING
from gearlink.core.gears.data import GearData
from gearlink.core.gears.mesh.pair import GearPair
from gearlink.core.report import Check


def _cutting(data: GearData) -> GearPair | None:
    """The pinion cutter and the ring that it shapes, while the last cut is taken; None without one."""
    pair, shaped = data.pair, data.pair.shaped
    if shaped is None or pair.cutter is None:
        return None
    return GearPair(
        module=pair.module,
        teeth=(pair.cutter.teeth, pair.teeth[1]),
        pressure_angle=pair.pressure_angle,
        helix_angle=pair.helix_angle,
        given_shift=(pair.cutter.shift, pair.profile_shift[1]),
        given_tip_radius=(shaped.cutter_tip, -pair.tip_radius[1]),
    )


def fed_in(data: GearData) -> Iterator[Check]:
    """A pinion cutter feeds in along the line of centres and must not cut off the ring's tips."""
    cutting = _cutting(data)
    if cutting is None:
        return
    from gearlink.core.gears.mesh.ring_interference import InternalInterference

    angle = InternalInterference(cutting).radial_assembly_angle
    if angle is None or angle >= 0.0:
        return
    text = f"the cutter of {cutting.teeth[0]} teeth cuts off tips of the ring while it feeds in: take a smaller one"
    yield TIP_FOULING.check("fail", text, None, 0.0, "mm", name="radial-assembly")


def tip_beyond_cutter(data: GearData) -> Iterator[Check]:
    """The flanks of a pinion cutter must reach the ring's tips: below its base circle they are no involutes."""
    cutting = _cutting(data)
    if cutting is None:
        return
    margin = cutting.interference_margin[1]
    if margin >= 0.0:
        return
    text = (
        f"the tip of the ring goes {-margin:.4g} mm beyond the base tangent point of its cutter, which leaves no "
        f"involute there: take a cutter of more than {cutting.teeth[0]} teeth, or lower the addendum of the ring"
    )
    yield INTERFERENCE.check("fail", text, margin, 0.0, "mm")
