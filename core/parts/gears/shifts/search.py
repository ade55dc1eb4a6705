"""Integer search: which whole teeth make a ratio at a centre distance, with a sum of shifts that gears bear."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import Table
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.parts.gears.data import GearData
from gearlink.core.parts.gears.mesh.pair import GearPair
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
    every = [(module, teeth) for module in task.modules for teeth in pairs_of_teeth(task, module)]
    if len(every) > MOST_PAIRS:
        every = sorted(every, key=lambda one: abs(abs(one[1][1] / one[1][0]) - task.ratio))[:MOST_PAIRS]
    found = [each for module, teeth in every if (each := _candidate(task, module, teeth)) is not None]
    return sorted(found, key=_rank)


def _rank(each: Candidate) -> tuple[bool, float, bool, float]:
    return each.margin < 0.0, round(abs(each.ratio_error), 9), not each.hunting, -each.margin


def _candidate(task: PairTask, module: float, teeth: tuple[int, int]) -> Candidate | None:
    known = {"module": module, "teeth": teeth, "pressure_angle": task.pressure_angle, "helix_angle": task.helix_angle}
    try:
        pair = GearPair(**known, given_distance=task.distance)  # type: ignore[arg-type]
        diagonal = Diagonal(pair)
        try:
            pair = diagonal.at(diagonal.equal_sliding().first)
        except NoSolution:
            pair = diagonal.at(diagonal.shift_sum / 2.0)
        _ = pair.tip_pressure_angle
        ratio = abs(pair.gear_ratio)
        return Candidate(pair, ratio, ratio / task.ratio - 1.0, _margin(GearData(pair=pair)))
    except NoSolution:
        return None


def _margin(data: GearData) -> float:
    """The way of x_1 to the nearest line that blocks, as far as lines are traced; negative where one is crossed."""
    contour = BlockingContour(data)
    total = sum(data.pair.profile_shift)
    first = data.pair.profile_shift[0]
    low, high = contour.reach(total)
    room, ways = min(first - low, high - first), []
    lines = [line for line in contour.lines if line.name.startswith(_BLOCKING)]
    crossed = contour.crossed(lines, total)
    for line in lines:
        way = min((abs(root - first) for each, root in crossed if each is line), default=room)
        ways.append(way if _good(line, data) else -way)
    return min(ways)


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
