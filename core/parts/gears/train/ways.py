"""What every mesh inside a machine gives: quantities, checks, and the ways to change a file where one fails."""

from __future__ import annotations

from gearlink.core.base.remedies.ways import Way, down, either, modules, shared, up, wider
from gearlink.core.parts.gears.checks import gear_ways
from gearlink.core.parts.gears.codes import AT_LIMITS, BACKLASH, BENDING, FILLET, PITTING, ROOT_CLEARANCE, TIP_FOULING
from gearlink.core.parts.gears.drawing_names import DRAWING_CHECKS, PLACES

_OF_EVERY_MESH = "tip_fouling_margin"
TRAIN_QUANTITIES = tuple(name for name in PLACES if name != _OF_EVERY_MESH)
TRAIN_CHECKS = tuple(name for name in DRAWING_CHECKS if name != TIP_FOULING.name)


_THINNER = -0.005


def train_ways(gears: int, *teeth: Way) -> dict[str, tuple[Way, ...]]:
    """Ways for every check of a mesh: shifts and tools where the file gives them, teeth, lower teeth last.

    Parameters
        gears : int - as many entries have the lists of the section
        teeth : the ways to more teeth
    """
    shifts = [f"gears.profile_shift[{i}]" for i in range(gears)]
    moved = (
        *(way for i in range(gears - 1) for way in shared(shifts[i], shifts[i + 1], step=0.01)),
        *either(*shifts, step=0.01),
    )
    lower = down("gears.addendum", step=0.01)
    ways = {name: (*moved, *others, lower) for name, others in gear_ways(*teeth).items()}
    stronger = (
        wider("gears.face_width"),
        wider(*(f"gears.face_width[{i}]" for i in range(gears))),
        modules("gears.module")[0],
    )
    thinner = tuple(
        Way((f"gears.allowances.upper[{i}]", f"gears.allowances.lower[{i}]"), _THINNER) for i in range(gears)
    )
    fewer = tuple(Way(way.keys, -way.step, way.tie) for way in teeth)
    return ways | {
        ROOT_CLEARANCE.name: (up("gears.clearance", step=0.01), up("gears.tool.addendum", step=0.01)),
        FILLET.name: (down("gears.tool.rounding", step=0.01), *moved, *teeth, lower),
        BACKLASH.name: (*thinner, down("gears.center_distance_allowance", step=0.001), *moved),
        **dict.fromkeys(AT_LIMITS, (down("gears.center_distance_allowance", step=0.001), *moved)),
        TIP_FOULING.checks[1]: (*moved, *teeth, *fewer, lower),
        PITTING.name: (*stronger, *moved, *teeth),
        BENDING.name: (*stronger, up("gears.tool.rounding", step=0.01), *moved, *teeth),
    }
