"""The synchronous zone of a flatbed press: where the speeds meet, where the zone ends, what is refused.

Tolerances
* published and reference angles: 1e-12 deg relative to some 100 deg.
* oracle (tests/oracles/press.py): an equality of speeds is known to noise/slope. The speeds are exact to 1e-13 of
  some 200 mm/rad and the slope is 60 to 300 mm/rad^2: 1e-13 rad. A nearly double root, at a hump that rises to a share
  `e` above zero, has a slope of sqrt(e): 1e-13/sqrt(e) rad.
"""

import json
import math
import re
from dataclasses import replace
from pathlib import Path

import mpmath as mp
import numpy as np
import pytest
from oracles.press import PRESSES, TY460, Press

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.flatbed_press.chains import BedChain, CylinderChain, difference
from gearlink.core.machines.flatbed_press.zone import (
    equal_speed_angle,
    equal_speed_angles,
    forward_stroke_end,
    zone_end,
)
from gearlink.core.parts.linkages.fourbar.position import FourBar
from gearlink.core.parts.linkages.slider_crank import SliderCrank

REFERENCE = json.loads((Path(__file__).parents[2] / "reference" / "flatbed_press.json").read_text())
EXACT = REFERENCE["flatbed_press"][0]["expect"]["sync_exact"]


pytestmark = pytest.mark.usefixtures("forty_digits")


def chains(press: Press) -> tuple[BedChain, CylinderChain]:
    crank = SliderCrank(press.stroke / 2.0, press.rod, press.offset).crank_length
    bed = BedChain(FourBar(*press.bed), math.radians(press.crank_offset_angle), crank, press.rod, press.offset)
    angle = math.radians(press.initial_crank_angle)
    return bed, CylinderChain(FourBar(*press.cylinder), angle, press.radius, press.gear_ratio)


def test_zone_of_the_ty460():
    bed, cylinder = chains(TY460)
    start = equal_speed_angle(bed, cylinder)
    assert math.degrees(start) == pytest.approx(EXACT["start"], abs=1e-11)
    assert math.degrees(zone_end(cylinder, start, 420.0)) == pytest.approx(EXACT["end"], abs=1e-11)


def test_report_takes_the_first_equality_and_not_a_later_one():
    # The report rounds it to whole degrees: 34.
    assert round(math.degrees(equal_speed_angle(*chains(TY460)))) == 34


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", PRESSES)
def test_start_and_end_against_the_cosine_rule(name):
    press = PRESSES[name]
    bed, cylinder = chains(press)
    start = equal_speed_angle(bed, cylinder)
    assert start == pytest.approx(float(press.equal_speed), abs=1e-12)
    for length in (1.0, 0.3 * press.stroke, press.stroke):
        end = zone_end(cylinder, start, length)
        assert end == pytest.approx(float(press.end_of(press.equal_speed, length)), abs=1e-12)


@pytest.mark.parametrize("name", PRESSES)
def test_bed_turns_where_its_slider_folds(name):
    press = PRESSES[name]
    bed, _ = chains(press)
    end = forward_stroke_end(bed)
    assert bed.travel(end).value == pytest.approx(press.stroke, rel=1e-13)
    # folded: E, D and F in line, the crank's direction pi/2 - asin(e/(L - r)), from -pi/2 - asin(e/(L + r))
    rod, e, crank = mp.mpf(press.rod), mp.mpf(press.offset), press.crank
    turned = mp.pi - mp.asin(e / (rod - crank)) + mp.asin(e / (rod + crank))
    assert bed.cam_angle(end).value == pytest.approx(float(turned), abs=1e-13)


@pytest.mark.parametrize("k", [1e-3, 1e3])
@pytest.mark.parametrize("name", PRESSES)
def test_angles_do_not_depend_on_the_scale(name, k):
    small, large = chains(PRESSES[name]), chains(PRESSES[name].scaled(k))
    start, length = equal_speed_angle(*small), 0.5 * PRESSES[name].stroke
    assert equal_speed_angle(*large) == pytest.approx(start, abs=1e-12)
    assert zone_end(large[1], start, k * length) == pytest.approx(zone_end(small[1], start, length), abs=1e-13)


# Nearly double roots


def radius_of_tangency():
    """Radius of cylinder at which the first two equalities of the TY-460 fall together, and where."""
    unit = replace(TY460, radius=1.0)

    def slope(phi):
        """Of p'/q' but for a positive factor."""
        p1, p2, q1, q2 = (mp.diff(travel, phi, n) for travel in (TY460.p, unit.q) for n in (1, 2))
        return p2 * q1 - p1 * q2

    phi = mp.findroot(slope, (mp.radians(41), mp.radians(44)), solver="anderson")
    return mp.diff(TY460.p, phi) / mp.diff(unit.q, phi), phi


@pytest.fixture(scope="module")
def tangent():
    with mp.workdps(40):
        return radius_of_tangency()


@pytest.mark.slow
@pytest.mark.parametrize("share", [1e-3, 1e-5, 1e-7, 1e-9, 1e-11])
def test_nearly_double_equality_is_not_stepped_over(tangent, share):
    radius, phi = tangent
    press = replace(TY460, radius=float(radius * (1 - mp.mpf(share))))

    def excess(x):
        return mp.diff(press.gap, x)

    width = 2 * mp.sqrt(share)
    exact = mp.findroot(excess, (phi - width, phi), solver="anderson", tol=mp.mpf(10) ** -60)
    found = equal_speed_angle(*chains(press))
    assert found == pytest.approx(float(exact), abs=1e-13 / math.sqrt(share))
    assert found < float(phi)


@pytest.mark.slow
def test_beyond_the_tangency_the_zone_starts_at_the_next_equality(tangent):
    radius, phi = tangent
    press = replace(TY460, radius=float(radius * (1 + mp.mpf("1e-9"))))
    start = equal_speed_angle(*chains(press))
    assert start > float(phi) + math.radians(30.0)
    assert start == pytest.approx(float(press.equal_speed), abs=1e-12)


# Refusals


@pytest.mark.quick(2)
@pytest.mark.parametrize(
    ("radius", "initial"), [(160.0, 57.109), (160.0, 57.109 - 360.0), (170.0, 57.109), (250.0, 57.109), (250.0, 359.5)]
)
def test_the_shift_that_is_named_makes_the_speeds_meet(radius, initial):
    press = replace(TY460, radius=radius, initial_crank_angle=initial)
    bed, cylinder = chains(press)
    with pytest.raises(NoSolution) as caught:
        equal_speed_angle(bed, cylinder)
    refusal = caught.value
    assert refusal.key == "cylinder.initial_crank_angle"
    named = re.search(r"initial_crank_angle to (-?[\d.]+) deg \(([+-]\d+) deg\)", refusal.fix)
    assert named
    value, shift = float(named[1]), int(named[2])
    assert -360.0 <= value <= 360.0
    assert math.remainder(value - initial - shift, 360.0) == pytest.approx(0.0, abs=1e-6)
    repaired = replace(cylinder, initial_angle=math.radians(value))
    start = equal_speed_angle(bed, repaired)
    assert difference(bed, repaired, start, 1).first == pytest.approx(0.0, abs=1e-9)
    # and it is the smallest: a degree less does not help
    less = replace(cylinder, initial_angle=math.radians(initial + shift - math.copysign(1.0, shift)))
    with pytest.raises(NoSolution):
        equal_speed_angle(bed, less)


@pytest.mark.slow
def test_cylinder_much_too_large_is_told_so():
    with pytest.raises(
        NoSolution, match=r"the bed \(max\. 236\.6 mm/rad\) never reaches the cylinder speed"
    ) as refusal:
        equal_speed_angle(*chains(replace(TY460, radius=1000.0)))
    assert refusal.value.key == "cylinder.radius"
    most = float(re.search(r"at most ([\d.]+) mm$", str(refusal.value))[1])
    assert 0.0 < equal_speed_angle(*chains(replace(TY460, radius=most))) < math.pi


def test_zone_longer_than_a_turn_of_the_cylinder():
    _, cylinder = chains(TY460)
    circumference = 2.0 * math.pi * 140.0
    assert zone_end(cylinder, 0.5, circumference - 1e-6) == pytest.approx(0.5 + 2.0 * math.pi, abs=1e-6)
    with pytest.raises(
        NoSolution, match=r"length of the zone: 900 mm .limit < 879.6 mm, the cylinder's travel"
    ) as refusal:
        zone_end(cylinder, 0.5, 900.0)
    assert refusal.value.key == "sync.length"


def test_equal_speeds_of_both_strokes():
    bed, cylinder = chains(TY460)
    found = equal_speed_angles(bed, cylinder)
    assert found[0] == equal_speed_angle(bed, cylinder)
    assert [round(math.degrees(phi), 1) for phi in found] == [34.0, 55.2, 78.4, 179.2]
    for phi in found:
        # both speeds carry some 1e-13 of their size, on a crossing that is not steep
        assert bed.travel(phi, 1).first == pytest.approx(cylinder.travel(phi, 1).first, rel=1e-12)


def test_speeds_that_never_meet_give_no_angles():
    bed, cylinder = chains(TY460)
    assert equal_speed_angles(bed, replace(cylinder, radius=14000.0)) == []


@pytest.mark.parametrize("name", PRESSES)
def test_equal_speeds_against_a_fine_grid(name):
    bed, cylinder = chains(PRESSES[name])
    grid = np.radians((np.arange(7201) - 0.5) / 20.0)
    gap = np.asarray(difference(bed, cylinder, grid, 1).first)
    sides = np.flatnonzero(gap[:-1] * gap[1:] < 0.0)
    found = equal_speed_angles(bed, cylinder)
    assert len(found) == sides.size
    for phi, i in zip(found, sides, strict=True):
        assert grid[i] <= phi <= grid[i + 1]


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("initial", "radius"),
    [
        (-2.6427969115019043, 402.66735520377773),
        (-0.14253938537315447, 206.89339613909962),
        (0.9712882117, 138.480237915),
    ],
)
def test_a_pair_of_equal_speeds_may_stand_on_both_sides_of_a_point_of_the_grid(initial, radius):
    bed, cylinder = chains(TY460)
    cylinder = replace(cylinder, initial_angle=initial, radius=radius)
    grid = np.linspace(0.0, 2.0 * math.pi, 200_003)[1:-1]
    gap = np.asarray(difference(bed, cylinder, grid, 1).first)
    sides = grid[np.flatnonzero(gap[:-1] * gap[1:] < 0.0)]
    assert equal_speed_angles(bed, cylinder) == pytest.approx(sides, abs=grid[1])
