"""The blocking contour: a reference point, every point on its line, margins that lead there.

Tolerances: roots to the last bit of x_1, so values vanish to 1e-9 of their own size; the reference case has its own.
"""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest
from sweeps import ALL

from gearlink.core.gears.contour import BlockingContour
from gearlink.core.gears.data import GearData
from gearlink.core.gears.pair import GearPair

CASES = json.loads((Path(__file__).parents[2] / "reference" / "gears.json").read_text())["cases"]


def contour(teeth: tuple[int, int], shift: tuple[float, float]) -> BlockingContour:
    return BlockingContour(GearData(pair=GearPair(module=1.0, teeth=teeth, given_shift=shift)))


def test_a_point_in_forty_digits() -> None:
    case = next(case for case in CASES if case["name"].startswith("contour-17-40"))
    wanted = case["expected"]["profile_shift_2"]
    first = case["input"]["profile_shift_1"]
    found = contour((17, 40), (0.3, 0.2))
    roots = found.crossings(found.line("contact ratio 1.2"), first + wanted["value"])
    assert min(abs(root - first) for root in roots) < wanted["tolerance"]


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
