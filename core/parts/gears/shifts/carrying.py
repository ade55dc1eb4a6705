"""Which pairs carry a load for a life: the minimum face width by the rating, and the smallest centre distance."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.gears.data import GearData
from gearlink.core.parts.gears.rating.conditions import Conditions
from gearlink.core.parts.gears.rating.load import Factors, Load, Required
from gearlink.core.parts.gears.rating.materials import Quality, gear_steel
from gearlink.core.parts.gears.shifts.search import Candidate, PairTask, candidates, pairs_of_teeth

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gearlink.core.base.report import Table
    from gearlink.core.parts.gears.mesh.pair import GearPair

_LEAST_WIDTH = 4.0
"""Of ISO 1328-1 [mm]."""
_STEPS = 24
_R20: tuple[float, ...] = (
    10.0,
    11.2,
    12.5,
    14.0,
    16.0,
    18.0,
    20.0,
    22.4,
    25.0,
    28.0,
    31.5,
    35.5,
    40.0,
    45.0,
    50.0,
    56.0,
    63.0,
    71.0,
)
_R20 += (80.0, 90.0)
DISTANCES = (*_R20, *(10.0 * each for each in _R20), 1000.0)
"""Centre distances that are tried [mm]: preferred numbers of the series R20."""
_QUICK = (0.5, 0.75, 1.0)
"""Of the maximum width, where a centre distance is tried before shifts are shared."""


@dataclass(frozen=True, kw_only=True)
class Carried:
    """What a pair has to carry, and of what it is made.

    Fields
        torque : float [N m] - of gear 1
        speed : float [1/min] - of gear 1
        life : float [h]
        materials : (str, str) - steels or classes whose strength needs no hardness
        application : float - K_A
        grade : int - of ISO 1328-1:2013
        viscosity : float [mm^2/s] - at 40 deg C
        quality : str
        crowned : bool - the helix is crowned
        width_ratio : float - maximum b/d_1
        required : Required
    """

    torque: float
    speed: float
    life: float
    materials: tuple[str, str]
    application: float = 1.0
    grade: int = 6
    viscosity: float = 220.0
    quality: Quality = "MQ"
    crowned: bool = False
    width_ratio: float = 1.0
    required: Required = Required()  # noqa: RUF009 - a tuple

    def data(self, pair: GearPair, width: float) -> GearData:
        """The pair under the load with a face width [mm]."""
        one, other = (gear_steel(name, self.quality) for name in self.materials)
        conditions = Conditions(
            life=self.life,
            steels=(one, other),
            quality=self.quality,
            grades=(self.grade, self.grade),
            viscosity_40=self.viscosity,
            modification="crowning" if self.crowned else "none",
        )
        load = Load(torque=self.torque, speed=self.speed, factors=Factors(application=self.application))
        return GearData(pair=pair, face_width=(width, width), load=load, conditions=conditions, required=self.required)


class Carrying(NamedTuple):
    """A pair that carries a load: its candidate, the minimum whole face width [mm], and its minimum safeties."""

    candidate: Candidate
    width: float
    pitting: float
    bending: float


def least_width(pair: GearPair, carried: Carried) -> tuple[float, float, float] | None:
    """The minimum whole face width that carries a load [mm], and the lesser safeties S_H and S_F; None without one.

    Notes
        The safety rises with the width until the load stands on one end: widths are tried from the minimum up, then
        every one between the last that does not carry and the first that does.
    """
    most = math.floor(carried.width_ratio * 2.0 * pair.reference_radius[0])
    least = math.ceil(max(_LEAST_WIDTH, 0.25 * most))
    if most < least:
        return None
    step, before = max(1, math.ceil((most - least) / _STEPS)), least - 1
    for width in range(least, most + 1, step):
        if _safe(pair, carried, width) is None:
            before = width
            continue
        for each in range(before + 1, width + 1):
            if (found := _safe(pair, carried, each)) is not None:
                return (float(each), *found)
    return None


def _safe(pair: GearPair, carried: Carried, width: int) -> tuple[float, float] | None:
    """The lesser safeties with a width; None where one is below what is required, or is not known."""
    data = carried.data(pair, float(width))
    try:
        contact, root = data.safety_pitting, data.safety_bending
    except NoSolution:
        return None
    if contact is None or root is None:
        return None
    found = [[each for each in both if each is not None] for both in (contact, root)]
    if min(map(len, found)) < 2:
        return None
    pitting, bending = min(found[0]), min(found[1])
    return (pitting, bending) if pitting >= carried.required.pitting and bending >= carried.required.bending else None


def carrying(task: PairTask, carried: Carried) -> list[Carrying]:
    """The pairs of a task that carry a load, the narrowest first; blocked ones last.

    Example
        >>> task = PairTask(ratio=3.0, distance=120.0, modules=(3.0, 4.0))
        >>> load = Carried(torque=200.0, speed=480.0, life=20000.0, materials=("16MnCr5", "16MnCr5"))
        >>> best = carrying(task, load)[0]
        >>> best.candidate.pair.teeth, best.width, round(best.pitting, 3), round(best.bending, 3)
        ((20, 60), 21.0, 1.006, 2.028)
    """
    found = []
    for each in candidates(task):
        width = least_width(each.pair, carried)
        if width is not None:
            found.append(Carrying(each, *width))
    return sorted(found, key=lambda one: (one.candidate.margin < 0.0, one.width, abs(one.candidate.ratio_error)))


def smallest(task: PairTask, carried: Carried) -> tuple[float, list[Carrying]]:
    """The first of `DISTANCES` at which a pair carries a load, and the pairs there; the last and none without one.

    Notes
        `task.distance` is not read.
    """
    distance = 0.0
    for distance in DISTANCES:
        at = replace(task, distance=distance)
        if not any(True for _ in _promising(at, carried)):
            continue
        found = carrying(at, carried)
        if found and found[0].candidate.margin >= 0.0:
            return distance, found
    return distance, []


def _promising(task: PairTask, carried: Carried) -> Iterator[tuple[int, int]]:
    """Teeth that nearly carry the load with shifts shared equally: quick to find."""
    from gearlink.core.parts.gears.mesh.pair import GearPair

    relaxed = replace(carried, required=Required(0.9 * carried.required.pitting, 0.5 * carried.required.bending))
    for module in task.modules:
        for teeth in pairs_of_teeth(task, module):
            try:
                pair = GearPair(
                    module=module,
                    teeth=teeth,
                    pressure_angle=task.pressure_angle,
                    helix_angle=task.helix_angle,
                    given_distance=task.distance,
                )
                most = math.floor(carried.width_ratio * 2.0 * pair.reference_radius[0])
                widths = (math.floor(share * most) for share in _QUICK if share * most >= _LEAST_WIDTH)
                if any(_safe(pair, relaxed, width) is not None for width in widths):
                    yield teeth
            except NoSolution:
                continue


def rated_table(found: list[Carrying]) -> Table:
    """The table `candidates` of a search under a load."""
    from gearlink.core.base.report import Table
    from gearlink.core.parts.gears.shifts.search import table_of

    table = table_of([each.candidate for each in found])
    distances = [abs(each.candidate.pair.center_distance) for each in found]
    columns: dict[str, tuple[list[float], str]] = {
        "center_distance": (distances, "mm"),
        "face_width": ([each.width for each in found], "mm"),
        "safety_pitting": ([each.pitting for each in found], "1"),
        "safety_bending": ([each.bending for each in found], "1"),
    }
    names = (*table.columns[:3], *columns, *table.columns[3:])
    units = (*table.units[:3], *(unit for _, unit in columns.values()), *table.units[3:])
    data = (*table.data[:3], *(values for values, _ in columns.values()), *table.data[3:])
    return Table("candidates", names, units, data)
