"""The blocking contour: a reference point, every point on its line, margins that lead there.

Tolerances: roots to the last bit of x_1, so values vanish to 1e-9 of their own size; the reference case has its own.
"""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest
from sweeps import ALL

from gearlink.core.gears import contour as kernel
from gearlink.core.gears.contour import BlockingContour
from gearlink.core.gears.data import GearData
from gearlink.core.gears.pair import GearPair

CASES = json.loads((Path(__file__).parents[2] / "reference" / "gears.json").read_text())["cases"]


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
        for x1, x2 in found.points[line.name][:: 5 if ALL else 40]:
            data = replace(found.data, pair=replace(found.pair, given_shift=(x1, x2)))
            value = line.value(data)
            assert value is not None
            assert abs(value) < 1e-6, (line.name, x1, x2)


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
    for strip in strips[::7]:
        x1, x2 = (sum(corner[k] for corner in strip) / 4.0 for k in (0, 1))
        assert found.is_free(replace(found.data, pair=replace(found.pair, given_shift=(x1, x2))))
        (left, up), (right, down) = strip[0], strip[1]
        for x, y, way in ((left, up, -1e-6), (right, down, 1e-6)):
            if not (low1 < x < high1 and low2 < y < high2):
                continue
            pair = replace(found.pair, given_shift=(x + way, y - way))
            assert not found.is_free(replace(found.data, pair=pair))


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
