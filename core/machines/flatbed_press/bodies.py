"""Bodies of a flatbed press that meet outside of the print: cranks and the other gear's axis, cylinder and forme."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from gearlink.core.base.report import Check
from gearlink.core.base.wording import short
from gearlink.core.machines.flatbed_press import codes
from gearlink.core.parts.linkages.codes import SHAFT_CLEARANCE
from gearlink.core.studies.clearance.bodies import LEAST_SHAFT_MODULES

if TYPE_CHECKING:
    from gearlink.core.machines.flatbed_press.design import FlatbedPress

_TURN = 2.0 * math.pi
_ROWS = 721
_NAME = SHAFT_CLEARANCE.checks[2]


def crank_axes(design: FlatbedPress) -> Iterator[Check]:
    """GL302: crank AB, which gear 2 carries, over the axis G of gear 1, and crank GH over A.

    AB + r_s <= AG, the crank pin on its circle about A; r_s of the thinnest shaft
    """
    gears = design.spec.input_gears
    if gears is None:
        return
    bed = design.spec.bed
    apart, least = (
        math.hypot(gears.horizontal_distance, bed.offset - bed.double_crank.frame),
        LEAST_SHAFT_MODULES * gears.module,
    )
    cranks = (("AB", "G", bed), ("GH", "A", design.spec.cylinder))
    for name, other, part in cranks:
        reach = part.double_crank.crank
        gap = apart - reach - least
        yield SHAFT_CLEARANCE.check(
            "pass" if gap >= 0.0 else "warn",
            f"crank {name} to the minimum shaft at {other}",
            gap,
            0.0,
            "mm",
            name=_NAME,
            overlap=f"overlap of the crank {name} and the minimum shaft at {other}",
            aside=f"axes {short(apart)} mm apart",
            fix=f"end the shaft at {other} before the plane of the crank (overhung)",
        )


def return_overlap(design: FlatbedPress) -> Iterator[Check]:
    """GL506: whether the print's arc of the cylinder comes round again while the forme stands at the printing line.

    q(phi) - q(phi_s) in [j C, j C + L] with p(phi) - p(phi_s) in [0, L], C the circumference, L the print

    Notes
        p is the travel of the bed's chain; the lift of the cams, some per cent of it, is left out.
    """
    turns = max(1, round(design.spec.cylinder.ratio))
    if turns == 1 or abs(turns - design.spec.cylinder.ratio) > 1e-9:
        return
    import numpy as np

    motion, spec = design.motion, design.spec
    start, about = motion.sync_start, _TURN * spec.cylinder.radius
    length = spec.sync.print_length or motion.zone_length
    phi = np.linspace(start, start + _TURN, _ROWS)
    rolled = motion.cylinder.travel(phi).value - motion.cylinder.travel(start).value
    first = motion.bed.travel(start).value
    for again in range(1, turns):
        ends = np.interp([again * about, again * about + length], rolled, phi)
        places = np.linspace(ends[0], ends[1], _ROWS)
        passed = motion.bed.travel(places).value - first
        beneath = places[(passed > 0.0) & (passed < length)]
        if beneath.size:
            low, high = (math.degrees(end) % 360.0 for end in beneath[[0, -1]])
            what, aside = "revolutions of the cylinder per sheet", "the printed area passes the forme again"
            at, fix = f"input angles {short(low)} to {short(high)} deg", "set cylinder.gear_ratio to 1"
            yield codes.REGISTER.check("warn", what, float(turns), 1.0, aside=aside, at=at, fix=fix)
            return
