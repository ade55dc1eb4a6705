"""The blocking contour: a reference point, every point on its line, margins that lead there.

Tolerances: roots to the last bit of x_1, so values vanish to 1e-9 of their own size; the reference case has its own.
"""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from sweeps import ALL

from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.gears.data import GearData
from gearlink.core.parts.gears.drawing_checks import corner_in_fillet
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.shifts import contour as kernel
from gearlink.core.parts.gears.shifts.contour import BlockingContour
from gearlink.core.parts.gears.shifts.contour_lines import Line, value_of
from gearlink.core.parts.gears.tooth.tools import PinionCutter, RackTool

CASES = json.loads((Path(__file__).parents[3] / "reference" / "gears.json").read_text())["cases"]


@pytest.fixture(autouse=True)
def _fewer_diagonals(monkeypatch: pytest.MonkeyPatch) -> None:
    """Half as many lines across the window, all in `make check-full`."""
    if not ALL:
        monkeypatch.setattr(kernel, "_DIAGONALS", 41)
        monkeypatch.setattr(kernel, "_UPRIGHTS", 21)


def contour(teeth: tuple[int, int], shift: tuple[float, float]) -> BlockingContour:
    return BlockingContour(GearData(pair=GearPair(module=1.0, teeth=teeth, given_shift=shift)))


def test_a_point_in_forty_digits() -> None:
    case = next(case for case in CASES if case["name"].startswith("contour-17-40"))
    wanted = case["expected"]["profile_shift_2"]
    first = case["input"]["profile_shift_1"]
    found = contour((17, 40), (0.3, 0.2))
    roots = found.crossings(found.line("contact ratio 1.2"), first + wanted["value"])
    assert min(abs(root - first) for root in roots) < wanted["tolerance"]


@pytest.mark.quick(1)
@pytest.mark.parametrize(("teeth", "shift"), [((17, 40), (0.3, 0.2)), ((21, -67), (0.3, -0.3))])
def test_every_point_lies_on_its_line(teeth: tuple[int, int], shift: tuple[float, float]) -> None:
    found = contour(teeth, shift)
    assert sum(map(len, found.points.values())) > 100
    for line in found.lines:
        for x1, x2 in found.points[line.name][:: 5 if ALL else 100]:
            data = replace(found.data, pair=replace(found.pair, given_shift=(x1, x2)))
            value = line.value(data)
            assert value is not None
            assert abs(value) < 1e-6, (line.name, x1, x2)


def test_shifts_whose_corners_cut_into_fillets_are_not_free() -> None:
    """Whole tips at a large shift sum: contact ends on every flank, and a corner cuts beyond it."""
    pair = GearPair(module=1.0, teeth=(40, 60), given_shift=(0.8, 0.8), tip="none", tools=(RackTool(), RackTool()))
    found = BlockingContour(GearData(pair=pair))
    corner = corner_in_fillet(pair, 0)
    assert corner is not None
    assert value_of(found.line("fillet 1"), found.placed) == corner.gap < -0.002
    assert found.data.path.used_root_radius[0] > (pair.form_radius[0] or math.inf)
    assert not found.is_free(found.placed)
    shortened = replace(found.placed, pair=replace(found.pair, tip="full"))
    assert found.is_free(shortened)


@pytest.mark.slow
@pytest.mark.parametrize(
    "keys",
    [
        {"teeth": (8, 8), "given_shift": (0.4, 0.4), "helix_angle": 0.5},
        {"teeth": (12, 31), "tools": (RackTool(addendum=1.4, rounding=0.2, residual_undercut=0.03), None)},
        {"teeth": (20, 33), "tip": "none", "clearance": 0.0, "pressure_angle": 0.25},
        {"teeth": (17, 40), "given_tip_radius": (9.8, 21.1)},
        {"teeth": (20, -45), "cutter": PinionCutter(teeth=12, shift=0.1, addendum=1.25, rounding=0.1)},
        {"teeth": (12, -13), "given_shift": (0.3, -0.4), "pressure_angle": 0.5, "helix_angle": 0.3},
    ],
)
def test_many_diagonals_at_once_are_crossed_where_each_is_alone(
    keys: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Arrays against scalars, root by root; a line that only touches a diagonal is known to the root of an ulp."""
    monkeypatch.setattr(kernel, "_DIAGONALS", 8)
    pair = GearPair(**{"module": 1.0, "given_shift": (0.3, -0.1)} | keys)
    found = BlockingContour(GearData(pair=pair, face_width=(9.0, 8.0)))
    many = [(total, line.name, first) for total, crossed, _ in found._diagonals for line, first in crossed]
    alone = [
        (total, line.name, first) for total, *_ in found._diagonals for line, first in _crossed_alone(found, total)
    ]
    assert len({name for _, name, _ in many}) > 6
    assert [row[:2] for row in many] == [row[:2] for row in alone]
    assert [row[2] for row in many] == pytest.approx([row[2] for row in alone], rel=0.0, abs=1e-8)


def _crossed_alone(found: BlockingContour, total: float) -> list[tuple[Line, float]]:
    try:
        return found.crossed(found.lines, total)
    except NoSolution:
        return []


def test_margins_lead_to_the_lines() -> None:
    found = contour((17, 40), (0.3, 0.2))
    fall, rise = found.margins["undercut 1"]
    assert rise is None
    assert 0.3 + fall == pytest.approx(found.pair.min_shift_no_undercut[0], abs=1e-12)
    _, thinner = found.margins["tip 1 0.2 m"]
    tips = replace(found.pair, given_shift=(0.3 + thinner, 0.2 - thinner)).tip_thickness
    assert tips[0] == pytest.approx(0.2, abs=1e-12)


def test_the_free_region_is_free_and_ends_at_its_limits() -> None:
    """The middle of every strip is inside all limits, and a little beyond its ends some limit is violated."""
    found = contour((17, 40), (0.3, 0.2))
    (low1, high1), (low2, high2) = found.window
    strips = list(found.free)
    assert len(strips) > 20
    for strip in strips[:: 7 if ALL else 25]:
        x1, x2 = (sum(corner[k] for corner in strip) / 4.0 for k in (0, 1))
        assert found.is_free(replace(found.data, pair=replace(found.pair, given_shift=(x1, x2))))
        (left, up), (right, down) = strip[0], strip[1]
        for x, y, way in ((left, up, -1e-6), (right, down, 1e-6)):
            if not (low1 < x < high1 and low2 < y < high2):
                continue
            pair = replace(found.pair, given_shift=(x + way, y - way))
            assert not found.is_free(replace(found.data, pair=pair))


@pytest.mark.slow
def test_lines_that_run_along_the_diagonals_are_found_too() -> None:
    """The root fillet of gear 1 goes on beyond the last diagonal that it crosses twice."""
    found = contour((23, 71), (0.3, 0.2))
    fillet = found.points["fillet 1"]
    for x1, x2 in fillet:
        value = found.line("fillet 1").value(replace(found.data, pair=replace(found.pair, given_shift=(x1, x2))))
        assert value is not None
        assert abs(value) < 1e-6
    assert max(x1 for x1, _ in fillet) > found.pair.min_shift_no_undercut[0] + 0.1


def test_the_nearest_limits_are_those_of_the_margins() -> None:
    found = contour((17, 40), (0.3, 0.2))
    below, above = found.nearest_limits
    assert below == ("undercut 1", found.margins["undercut 1"][0])
    assert above is not None
    name, way = above
    assert way == min(more for key, (_, more) in found.margins.items() if more is not None and found.line(key).limits)
    assert found.line(name).limits


@pytest.mark.quick(1)
@pytest.mark.parametrize("teeth", [(20, 60), (9, 31), (25, 25), (7, 14), (20, -60)])
@pytest.mark.parametrize("shift", [(0.1, 0.1), (0.8, -0.4), (-0.3, 0.5), (0.45, 0.0)])
def test_the_way_to_the_nearest_crossing_is_that_of_all_crossings(
    teeth: tuple[int, int], shift: tuple[float, float]
) -> None:
    """To the last bit: the same steps are refined in the same way, those that are farther are left."""
    found = contour(teeth, shift)
    crossed, way = found.crossed(found.lines, sum(shift)), found.ways(sum(shift), shift[0])
    for line in found.lines:
        nearest = min((abs(first - shift[0]) for each, first in crossed if each is line), default=math.inf)
        assert way(line, math.inf) == nearest
        assert way(line, 0.3) == nearest or nearest >= 0.3 <= way(line, 0.3)
