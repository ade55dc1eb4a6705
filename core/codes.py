"""Every code of a check with its rule; each stands beside the checks that judge by it, and none needs a kernel."""

from __future__ import annotations

from functools import cache

from gearlink.core.cams import codes as cams
from gearlink.core.dwell_gears import codes as dwell_gears
from gearlink.core.five_bar import codes as five_bar
from gearlink.core.flatbed_press import codes as flatbed_press
from gearlink.core.gears import codes as gears
from gearlink.core.linkages import codes as linkages
from gearlink.core.loads import codes as loads
from gearlink.core.planet_linkages import codes as planet_linkages
from gearlink.core.report import Rule
from gearlink.core.study import codes as studies
from gearlink.core.swing_gripper import codes as swing_gripper
from gearlink.core.three_gear import codes as three_gear
from gearlink.core.tolerance import codes as tolerance
from gearlink.core.wide_swing import codes as wide_swing

_ROOMS = (
    gears,
    linkages,
    three_gear,
    planet_linkages,
    five_bar,
    dwell_gears,
    cams,
    flatbed_press,
    swing_gripper,
    wide_swing,
    studies,
    loads,
    tolerance,
)


@cache
def rules() -> dict[str, Rule]:
    """The rules by their codes, in the order of the codes."""
    found = [rule for room in _ROOMS for rule in vars(room).values() if isinstance(rule, Rule)]
    return {rule.code: rule for rule in sorted(found, key=lambda rule: rule.code)}
