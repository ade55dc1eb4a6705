"""Integer search: whole teeth for a ratio at a centre distance with a bearable sum of shifts, and pairs for a load.

A pair that carries a load for a life has the minimum face width by the rating; the smallest centre distance is found.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import Table
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.parts.gears.data import GearData
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.rating.conditions import Conditions
from gearlink.core.parts.gears.rating.load import Factors, Load, Required
from gearlink.core.parts.gears.rating.materials import Quality, gear_steel
from gearlink.core.parts.gears.shifts.contour import BlockingContour
from gearlink.core.parts.gears.shifts.contour_lines import Line
from gearlink.core.parts.gears.shifts.shift_split import Diagonal
from gearlink.core.parts.gears.tooth.involute import involute
from gearlink.core.parts.gears.tooth.teeth import transverse

if TYPE_CHECKING:
    from gearlink.core.base.report import Column


MODULES = (1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 16.0, 20.0)
"""ISO 54, series I, from 1 mm."""
_BLOCKING = ("undercut", "tip 1 0.2", "tip 2 0.2", "fillet", "base circle", "contact ratio 1.1", "tip fouling")
MOST_TEETH = 2000
MOST_PAIRS = 1000
_ROUNDING = 1e-12


@dataclass(frozen=True, kw_only=True)
class PairTask:
    """What is asked of a pair.

    Fields
        ratio : float - z_2/z_1, positive
        distance : float [mm] - centre distance
        modules : normal modules to try [mm]
        shift_sum : (float, float) - minimum and maximum x_1 + x_2 (ISO signs, of a ring too)
        tolerance : float - maximum relative error of the ratio
        helix_angle, pressure_angle : float [rad]
        internal : bool - gear 2 is a ring
        least_teeth : int - of gear 1
    """

    ratio: float
    distance: float
    modules: tuple[float, ...] = MODULES
    shift_sum: tuple[float, float] = (-0.5, 1.0)
    tolerance: float = 0.02
    helix_angle: float = 0.0
    pressure_angle: float = math.radians(20.0)
    internal: bool = False
    least_teeth: int = 17


class Candidate(NamedTuple):
    """A pair that meets a task; `margin` is how far x_1 may move until a line of the contour is met, negative where
    one is crossed already.
    """

    pair: GearPair
    ratio: float
    ratio_error: float
    margin: float

    @property
    def hunting(self) -> bool:
        """Whether every tooth of one gear meets every tooth of the other."""
        return math.gcd(*self.pair.teeth) == 1


def teeth_sums(task: PairTask, module: float) -> range:
    """Whole |z_1 + z_2| with which the shift sum lies in its window.

    x_1 + x_2 = (z_1 + z_2)(inv(alpha_wt) - inv(alpha_t))/(2 tan(alpha_n)) falls strictly with z_1 + z_2

    Example
        >>> teeth_sums(PairTask(ratio=3.2, distance=120.0, shift_sum=(0.0, 1.0)), 4.0)
        range(59, 61)
    """
    low, high = task.shift_sum if not task.internal else (-task.shift_sum[1], -task.shift_sum[0])
    alpha = transverse(task.pressure_angle, task.helix_angle)
    most = 2.0 * task.distance * math.cos(task.helix_angle) / (module * math.cos(alpha))

    def shift_sum(total: float) -> float:
        working = math.acos(min(1.0, total / most))
        return total * (involute(working) - involute(alpha)) / (2.0 * math.tan(task.pressure_angle))

    tiny = 1e-3 * most
    if shift_sum(most) > high or shift_sum(tiny) < low:
        return range(0)
    first = tiny if shift_sum(tiny) <= high else bracketed_root(lambda z: shift_sum(z) - high, tiny, most)
    last = most if shift_sum(most) >= low else bracketed_root(lambda z: shift_sum(z) - low, tiny, most)
    return range(max(1, math.ceil(first - 1e-9)), math.floor(last + 1e-9) + 1)


def _teeth(task: PairTask, total: int) -> Iterator[tuple[int, int]]:
    """Teeth of a sum (of a difference, with a ring) whose ratio lies in its tolerance."""
    side = -1.0 if task.internal else 1.0
    few, many = (task.ratio * (1.0 + way * task.tolerance) + side for way in (1.0, -1.0))
    if few <= 0.0:
        return
    last = math.floor(min(total / many, MOST_TEETH) + _ROUNDING) if many > 0.0 else MOST_TEETH
    for first in range(max(task.least_teeth, math.ceil(total / few - _ROUNDING)), last + 1):
        second = first + total if task.internal else total - first
        if second < 1:
            continue
        if abs(second / first / task.ratio - 1.0) <= task.tolerance + _ROUNDING:
            yield first, -second if task.internal else second


def pairs_of_teeth(task: PairTask, module: float) -> Iterator[tuple[int, int]]:
    """Every (z_1, z_2) of a module whose ratio and shift sum meet the task."""
    for total in teeth_sums(task, module):
        if total <= MOST_TEETH:
            yield from _teeth(task, total)


def candidates(task: PairTask) -> list[Candidate]:
    """Every pair that meets the task, the best first: unblocked, near the ratio, hunting teeth, large margins.

    Notes
        Where more than `MOST_PAIRS` meet it, those nearest to the ratio.
    Example
        >>> best = candidates(PairTask(ratio=3.2, distance=120.0, modules=(3.0, 4.0)))[0]
        >>> best.pair.module, best.pair.teeth
        (3.0, (19, 61))
    """
    found = [each for pair in _pairs(task) if (each := _candidate(task, pair)) is not None]
    return sorted(found, key=_rank)


def _pairs(task: PairTask) -> Iterator[GearPair]:
    """Every pair that meets the task, its shifts shared for equal sliding."""
    every = [(module, teeth) for module in task.modules for teeth in pairs_of_teeth(task, module)]
    if len(every) > MOST_PAIRS:
        every = sorted(every, key=lambda one: abs(abs(one[1][1] / one[1][0]) - task.ratio))[:MOST_PAIRS]
    for module, teeth in every:
        if (pair := _pair(task, module, teeth)) is not None:
            yield pair


def _rank(each: Candidate) -> tuple[bool, float, bool, float]:
    return each.margin < 0.0, round(abs(each.ratio_error), 9), not each.hunting, -each.margin


def _pair(task: PairTask, module: float, teeth: tuple[int, int]) -> GearPair | None:
    try:
        pair = _placed(task, module, teeth)
        diagonal = Diagonal(pair)
        try:
            pair = diagonal.at(diagonal.equal_sliding().first)
        except NoSolution:
            pair = diagonal.at(diagonal.shift_sum / 2.0)
        _ = pair.tip_pressure_angle
    except NoSolution:
        return None
    return pair


def _placed(task: PairTask, module: float, teeth: tuple[int, int]) -> GearPair:
    alpha, beta = task.pressure_angle, task.helix_angle
    return GearPair(module=module, teeth=teeth, pressure_angle=alpha, helix_angle=beta, given_distance=task.distance)


def _candidate(task: PairTask, pair: GearPair) -> Candidate | None:
    ratio = abs(pair.gear_ratio)
    try:
        return Candidate(pair, ratio, ratio / task.ratio - 1.0, _margin(GearData(pair=pair)))
    except NoSolution:
        return None


def _margin(data: GearData) -> float:
    """The way of x_1 to the nearest line that blocks, as far as lines are traced; negative where one is crossed."""
    contour = BlockingContour(data)
    total = sum(data.pair.profile_shift)
    first = data.pair.profile_shift[0]
    low, high = contour.reach(total)
    room, way = min(first - low, high - first), contour.ways(total, first)
    lines = [line for line in contour.lines if line.name.startswith(_BLOCKING)]
    if bad := [line for line in lines if not _good(line, data)]:
        return -max(found if (found := way(line, math.inf)) < math.inf else room for line in bad)
    least = math.inf
    for line in lines:  # one that is not met counts as far as lines are traced
        known = least <= room
        nearest = way(line, least if known else math.inf)
        least = min(least, nearest if known or nearest < math.inf else room)
    return least


def _good(line: Line, data: GearData) -> bool:
    try:
        value = line.value(data)
    except NoSolution:
        return False
    return value is None or value >= 0.0


def table_of(found: list[Candidate]) -> Table:
    """The table `candidates` of a search."""
    columns: dict[str, tuple[Column, str]] = {
        "teeth1": ([each.pair.teeth[0] for each in found], "1"),
        "teeth2": ([each.pair.teeth[1] for each in found], "1"),
        "module": ([each.pair.module for each in found], "mm"),
        "ratio": ([each.ratio for each in found], "1"),
        "ratio_error": ([each.ratio_error for each in found], "1"),
        "shift_sum": ([each.pair.shift_sum for each in found], "1"),
        "contact_ratio": ([each.pair.contact_ratio for each in found], "1"),
        "margin": ([each.margin for each in found], "1"),
        "x1": ([each.pair.profile_shift[0] for each in found], "1"),
        "x2": ([each.pair.profile_shift[1] for each in found], "1"),
        "common_factor": ([math.gcd(*each.pair.teeth) for each in found], "1"),
    }
    return Table.of("candidates", columns)


_LEAST_WIDTH = 4.0
"""Of ISO 1328-1 [mm]."""
_STEPS = 24
_R20 = (
    10.0, 11.2, 12.5, 14.0, 16.0, 18.0, 20.0, 22.4, 25.0, 28.0, 31.5, 35.5, 40.0, 45.0, 50.0, 56.0, 63.0, 71.0, 80.0,
    90.0,
)  # fmt: skip
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
    found: list[float] = []
    # The flanks first: they decide most widths, in half the time that both take.
    for name, least in (("safety_pitting", carried.required.pitting), ("safety_bending", carried.required.bending)):
        try:
            both = getattr(data, name)
        except NoSolution:
            return None
        if both is None or None in both or min(both) < least:
            return None
        found.append(min(both))
    return found[0], found[1]


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
    for pair in _pairs(task):
        width = least_width(pair, carried)
        if width is not None and (each := _candidate(task, pair)) is not None:
            found.append(Carrying(each, *width))

    def rank(one: Carrying) -> tuple[bool, float, float, tuple[bool, float, bool, float]]:
        return one.candidate.margin < 0.0, one.width, abs(one.candidate.ratio_error), _rank(one.candidate)

    return sorted(found, key=rank)


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
    relaxed = replace(carried, required=Required(0.9 * carried.required.pitting, 0.5 * carried.required.bending))
    for module in task.modules:
        for teeth in pairs_of_teeth(task, module):
            try:
                pair = _placed(task, module, teeth)
                most = math.floor(carried.width_ratio * 2.0 * pair.reference_radius[0])
                widths = (math.floor(share * most) for share in _QUICK if share * most >= _LEAST_WIDTH)
                if any(_safe(pair, relaxed, width) is not None for width in widths):
                    yield teeth
            except NoSolution:
                continue


def rated_table(found: list[Carrying]) -> Table:
    """The table `candidates` of a search under a load."""
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
