"""Sizes at the ends of ranges, as rounding leaves them."""

from __future__ import annotations

import math

import pytest

from gearlink.core.parts.gears.measures.allowances import js7, thickness_allowances
from gearlink.core.parts.gears.measures.iso_1328 import ToothTolerances
from gearlink.core.studies.clearance import collision_judged, shaft_judged
from gearlink.core.studies.tolerance.iso_286 import standard_tolerance
from gearlink.core.studies.tolerance.sources import radial_clearance


def test_the_end_of_a_range_keeps_its_row_within_its_rounding() -> None:
    """50 mm as 0.1 mm times 500 and the like; 50.001 mm is the next range."""

    def pitch(size: float) -> float:
        return ToothTolerances(grade=6, module=size, diameter=100.0, width=30.0, edition=1995).single_pitch

    for size, of in (
        (50.0, lambda size: thickness_allowances("27cd", size)),
        (120.0, js7),
        (2.0, pitch),
        (80.0, lambda size: standard_tolerance(size, 7)),
        (50.0, lambda size: radial_clearance(size, "CN")),
    ):
        above = math.nextafter(math.nextafter(size, math.inf), math.inf)
        assert of(above) == of(size) == of(math.nextafter(size, 0.0)), size
        assert of(size + 1e-3) != of(size), size


@pytest.mark.parametrize("judged", [collision_judged, lambda gap, limit: shaft_judged(gap, limit, False)])
def test_a_gap_that_meets_its_limit_passes(judged: object) -> None:
    """70.1 - 60.1 - 6 is 4 less two roundings."""
    gap = 70.1 - 60.1 - 6.0
    assert gap < 4.0
    assert callable(judged)
    assert not judged(gap, 4.0).fails
    assert judged(gap - 1e-6, 4.0).fails
