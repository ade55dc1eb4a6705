"""The integer search of gear pairs and the blocking contour, against trying everything and against a scan."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

from bench.timing import Family, Method, measure, mpmath
from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.gears.data import GearData
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.shifts.contour import BlockingContour
from gearlink.core.parts.gears.shifts.search import PairTask, candidates, pairs_of_teeth

TASK = PairTask(ratio=3.2, distance=120.0, modules=(2.0, 2.5, 3.0, 4.0, 5.0))
_MOST = 100
TEETH, MODULE, ANGLE = (17, 40), 2.0, math.radians(20.0)
SHIFT_SUM = 0.5
LINES = {"pointed tip 1": 1.0, "tip 1 0.2 m": 0.9, "undercut 1": 0.0}
"""Lines that are looked for, and a shift near each."""


def search(quick: bool) -> Family:
    """The table of the search."""
    found = [(module, teeth) for module in TASK.modules for teeth in pairs_of_teeth(TASK, module)]
    tried = list(_all_pairs())
    if sorted(found) != sorted(tried):
        raise AssertionError("the search and trying all pairs differ")
    methods = [
        Method("sums of teeth from the ends of the window", 1, lambda: list(map(_pairs, TASK.modules)), _worst(found)),
        Method(f"every pair with up to {_MOST} teeth of gear 1", 1, lambda: list(_all_pairs()), _worst(tried)),
        Method("the candidates with their shifts and margins", 1, lambda: candidates(TASK)),
    ]
    rows = measure(methods, methods[0].run, 1, 3 if quick else 5)
    return Family(
        "gear-search",
        "Integer search of gear pairs: ratio 3.2 at 120 mm, modules 2 to 5 mm",
        "module",
        "the search for the teeth alone",
        rows,
        ("error: worst shift sum of the pairs that are found; both ways find the same pairs",),
    )


def _pairs(module: float) -> list[tuple[int, int]]:
    return list(pairs_of_teeth(TASK, module))


def _all_pairs() -> Iterator[tuple[float, tuple[int, int]]]:
    """The textbook way: the shift sum of every pair of teeth whose ratio will do."""
    low, high = TASK.shift_sum
    for module in TASK.modules:
        for one in range(TASK.least_teeth, _MOST):
            first, last = (TASK.ratio * (1.0 + sign * TASK.tolerance) * one for sign in (-1.0, 1.0))
            for other in range(math.ceil(first), math.floor(last) + 1):
                try:
                    total = GearPair(module=module, teeth=(one, other), given_distance=TASK.distance).shift_sum
                except NoSolution:
                    continue
                if low <= total <= high:
                    yield module, (one, other)


def _worst(found: list[tuple[float, tuple[int, int]]]) -> float:
    """Worst error of the shift sum against 30 digits."""
    mp = mpmath(30)
    alpha = mp.mpf(TASK.pressure_angle)

    def true(module: float, teeth: tuple[int, int]) -> Any:
        total = sum(teeth)
        working = mp.acos(total * module * mp.cos(alpha) / (2 * mp.mpf(TASK.distance)))
        return total * ((mp.tan(working) - working) - (mp.tan(alpha) - alpha)) / (2 * mp.tan(alpha))

    def own(module: float, teeth: tuple[int, int]) -> float:
        return GearPair(module=module, teeth=teeth, given_distance=TASK.distance).shift_sum

    return max(float(abs(own(*each) - true(*each))) for each in found)


def contour(quick: bool) -> Family:
    """The table of the contour."""
    blocking = BlockingContour(_data(SHIFT_SUM))
    known = {name: _true(name) for name in LINES}

    def error(found: Callable[[str], float]) -> float:
        return max(float(abs(found(name) - true)) for name, true in known.items())

    def method(name: str, found: Callable[[str], float]) -> Method:
        return Method(name, len(LINES), lambda: [found(line) for line in LINES], error(found))

    methods = [
        method("bracketed roots on a diagonal", partial(_crossing, blocking)),
        *(method(f"scan, step {step:g}", partial(_scanned, blocking, step)) for step in (0.1, 0.01, 0.001)),
    ]
    rows = measure(methods, methods[0].run, len(LINES), 3 if quick else 5)
    return Family(
        "contour",
        "Blocking contour: where a diagonal x1 + x2 = 0.5 meets pointed tip, tip of 0.2 m and undercut",
        "module",
        "bracketed roots",
        rows,
        ("scan: the sign of the line's value along the diagonal, its zero by interpolation; z = 17 and 40",),
    )


def _data(shift_sum: float, first: float = 0.3) -> GearData:
    shifts = (first, shift_sum - first)
    return GearData(pair=GearPair(module=MODULE, teeth=TEETH, pressure_angle=ANGLE, given_shift=shifts, tip="none"))


def _crossing(blocking: BlockingContour, name: str) -> float:
    found = blocking.crossings(blocking.line(name), SHIFT_SUM)
    return min(found, key=lambda first: abs(first - LINES[name]))


def _scanned(blocking: BlockingContour, step: float, name: str) -> float:
    """The textbook way: values at equal steps, and the straight line between those of different signs."""
    value, (low, high) = blocking.line(name).value, blocking.reach(SHIFT_SUM)
    places = [low + step * k for k in range(int((high - low) / step) + 1)]
    values = [value(_data(SHIFT_SUM, first)) or 0.0 for first in places]
    found = [
        places[k] - step * values[k] / (values[k + 1] - values[k])
        for k in range(len(places) - 1)
        if (values[k] > 0.0) != (values[k + 1] > 0.0)
    ]
    return min(found, key=lambda first: abs(first - LINES[name]))


def _true(name: str) -> Any:
    """x1 in 30 digits: zero of the tip thickness less its limit, or of the undercut in closed form."""
    mp = mpmath(30)
    z, alpha = mp.mpf(TEETH[0]), mp.mpf(ANGLE)
    if name.startswith("undercut"):
        return 1 - z * mp.sin(alpha) ** 2 / 2
    limit = mp.mpf(0.2) if "0.2" in name else mp.mpf(0)

    def thickness(x: Any) -> Any:
        tip = z / 2 + 1 + x
        at_tip = mp.acos(z / 2 * mp.cos(alpha) / tip)
        own = (mp.pi / 2 + 2 * x * mp.tan(alpha)) / z + mp.tan(alpha) - alpha
        return 2 * tip * (own - (mp.tan(at_tip) - at_tip)) - limit

    return mp.findroot(thickness, LINES[name])
