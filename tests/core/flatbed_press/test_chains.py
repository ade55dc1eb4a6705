"""The two chains of a flatbed press against a second calculation in 40 digits; the report's numbers are cases of
`gearlink verify`.

Tolerances
* reference cases: 1e-12 of the maximum value of the column; they are printed to 17 digits.
* oracle (tests/oracles/press.py): 2e-14 of the maximum magnitude over a revolution. Measured: 4e-16 for travels, 2e-15
  for their derivatives; the minimum transmission angle of 35 deg costs 1/sin^2, a factor of 3.
* scale invariance: a power of two changes nothing, another factor 1e-14 relative (rounding of the factor itself).
"""

import json
import math
from dataclasses import replace
from pathlib import Path

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracles.press import PRESSES, TY460, Press
from sweeps import examples

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.flatbed_press.chains import BedChain, CylinderChain, difference
from gearlink.core.parts.linkages.fourbar.position import FourBar
from gearlink.core.parts.linkages.slider_crank import SliderCrank

REFERENCE = json.loads((Path(__file__).parents[2] / "reference" / "flatbed_press.json").read_text())
EXPECTED = REFERENCE["flatbed_press"][0]["expect"]
OMEGA = 4500.0 / 3600.0 * 2.0 * math.pi
DEGREES = (0, 7, 34, 90, 155, 179, 222.5, 300, 359)


pytestmark = pytest.mark.usefixtures("forty_digits")


def bed_of(press: Press) -> BedChain:
    crank = SliderCrank(press.stroke / 2.0, press.rod, press.offset).crank_length
    return BedChain(FourBar(*press.bed), math.radians(press.crank_offset_angle), crank, press.rod, press.offset)


def cylinder_of(press: Press) -> CylinderChain:
    angle = math.radians(press.initial_crank_angle)
    return CylinderChain(FourBar(*press.cylinder), angle, press.radius, press.gear_ratio)


def peaks(function, order):
    """Maximum magnitude over the revolution of a function of an array of input angles."""
    travel = function(np.radians(np.arange(0.0, 360.0, 2.0)), order)
    return [float(np.abs(v).max()) for v in (travel.value, travel.first, travel.second)[: order + 1]]


def test_twelve_positions_of_the_reference():
    bed, cylinder = bed_of(TY460), cylinder_of(TY460)
    columns = EXPECTED["positions"]["columns"]
    rows = np.array(EXPECTED["positions"]["rows"])
    phi = np.radians(rows[:, 0])
    cam, p, q = bed.cam_angle(phi), bed.travel(phi, 1), cylinder.travel(phi, 1)
    for name, found in (
        ("cam_angle", np.degrees(cam.value)),
        ("bed_displacement", p.value),
        ("bed_velocity", OMEGA * p.first),
        ("cylinder_displacement", q.value),
        ("cylinder_velocity", OMEGA * q.first),
    ):
        column = rows[:, columns.index(name)]
        np.testing.assert_allclose(found, column, rtol=0.0, atol=1e-12 * np.abs(column).max(), err_msg=name)


# A second way


@pytest.mark.parametrize("name", PRESSES)
def test_start_of_the_bed_chain(name):
    press, bed = PRESSES[name], bed_of(PRESSES[name])
    assert bed.slider_crank_length == pytest.approx(float(press.crank), rel=1e-14, abs=0.0)
    assert bed.initial_crank_angle == pytest.approx(float(press.crank_start), abs=1e-14)


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", PRESSES)
@pytest.mark.parametrize("what", ["cam_angle", "bed", "cylinder", "difference"])
def test_travel_and_derivatives_against_the_cosine_rule(name, what):
    press, bed, cylinder = PRESSES[name], bed_of(PRESSES[name]), cylinder_of(PRESSES[name])
    program, oracle = {
        "cam_angle": (bed.cam_angle, press.cam),
        "bed": (bed.travel, press.p),
        "cylinder": (cylinder.travel, press.q),
        "difference": (lambda phi, order: difference(bed, cylinder, phi, order), press.gap),
    }[what]
    size = peaks(program, 2)
    for degrees in DEGREES:
        phi = math.radians(degrees)
        found = program(phi, 2)
        exact = [float(oracle(mp.mpf(phi))), *(float(mp.diff(oracle, mp.mpf(phi), n)) for n in (1, 2))]
        for value, wanted, scale in zip((found.value, found.first, found.second), exact, size, strict=True):
            assert value == pytest.approx(wanted, abs=2e-14 * scale, rel=0.0), (degrees, scale)


@pytest.mark.parametrize("name", PRESSES)
def test_arrays_and_floats_agree_in_every_order(name):
    bed, cylinder = bed_of(PRESSES[name]), cylinder_of(PRESSES[name])
    phi = np.radians(np.linspace(-400.0, 800.0, 37))
    for function in (bed.cam_angle, bed.travel, cylinder.travel, lambda x, n: difference(bed, cylinder, x, n)):
        size = peaks(function, 2)
        for order in (0, 1, 2):
            sweep = function(phi, order)
            single = [function(float(x), order) for x in phi]
            for n, field in enumerate(("value", "first", "second")[: order + 1]):
                alone = [getattr(t, field) for t in single]
                np.testing.assert_allclose(getattr(sweep, field), alone, rtol=1e-13, atol=1e-13 * size[n])
            if order < 2:
                assert math.isnan(sweep.second)
                assert math.isnan(single[0].second)


# Invariance


@pytest.mark.parametrize("name", PRESSES)
def test_a_turn_brings_the_bed_home_and_the_cylinder_round(name):
    press, bed, cylinder = PRESSES[name], bed_of(PRESSES[name]), cylinder_of(PRESSES[name])
    turn, circumference = 2.0 * math.pi, 2.0 * math.pi * press.radius * press.gear_ratio
    for phi in (0.0, 1.0, 4.0):
        here, later = bed.travel(phi, 2), bed.travel(phi + turn, 2)
        assert later.value == pytest.approx(here.value, abs=1e-12 * press.stroke)
        assert later.first == pytest.approx(here.first, abs=1e-12 * press.stroke)
        gained = cylinder.travel(phi + turn).value - cylinder.travel(phi).value
        assert gained == pytest.approx(circumference, rel=1e-13)
        assert bed.cam_angle(phi + turn).value - bed.cam_angle(phi).value == pytest.approx(turn, rel=1e-14)


@pytest.mark.parametrize("name", PRESSES)
def test_bed_travels_its_stroke_and_no_more(name):
    press, bed = PRESSES[name], bed_of(PRESSES[name])
    travel = bed.travel(np.radians(np.arange(0.0, 360.0, 0.05))).value
    # the turning point lies within 0.025 deg of a row, where the travel is off by some 1e-6 of the stroke
    assert travel.max() == pytest.approx(press.stroke, rel=2e-6)
    assert travel.max() <= press.stroke * (1.0 + 1e-13)
    assert travel.min() == pytest.approx(0.0, abs=1e-13 * press.stroke)
    assert bed.travel(0.0, 1).first == pytest.approx(0.0, abs=1e-13 * press.stroke)


@pytest.mark.quick(3)
@pytest.mark.parametrize("name", PRESSES)
@pytest.mark.parametrize(("k", "tolerance"), [(1e-3, 1e-13), (2.0**-10, 0.0), (1e3, 1e-13)])
def test_scale(name, k, tolerance):
    small, large = PRESSES[name], PRESSES[name].scaled(k)
    for phi in (0.3, 2.0, 5.0):
        for order, field in enumerate(("value", "first", "second")):
            for make in (bed_of, cylinder_of):
                one, other = (getattr(make(press).travel(phi, order), field) for press in (small, large))
                assert other == pytest.approx(k * one, rel=tolerance, abs=tolerance * k * small.stroke)


@pytest.mark.parametrize("name", PRESSES)
def test_mirror_image_of_the_cylinder_chain_turns_backwards(name):
    chain = cylinder_of(PRESSES[name])
    mirror = replace(
        chain,
        linkage=replace(chain.linkage, assembly=-chain.linkage.assembly),
        initial_angle=-chain.initial_angle,
    )
    for phi in (0.5, 2.5, 4.5):
        there, here = mirror.travel(-phi, 2), chain.travel(phi, 2)
        assert (there.value, there.second) == pytest.approx((-here.value, -here.second), rel=1e-13)
        assert there.first == pytest.approx(here.first, rel=1e-13)


@examples(100)
@given(name=st.sampled_from(sorted(PRESSES)), phi=st.floats(-20.0, 20.0))
def test_cam_angle_leads_back_to_the_input_angle(name, phi):
    bed = bed_of(PRESSES[name])
    # d(cam)/d(input) lies between 0.4 and 2.5
    assert bed.input_angle(bed.cam_angle(phi).value) == pytest.approx(phi, abs=2e-14 * (1.0 + abs(phi)))


def test_gear_ratio_multiplies_the_travel():
    once = cylinder_of(TY460)
    twice = replace(once, gear_ratio=2.0)
    assert twice.travel(2.0, 2).value == 2.0 * once.travel(2.0, 2).value
    assert twice.travel(2.0, 2).second == 2.0 * once.travel(2.0, 2).second


# Refusals


@pytest.mark.parametrize(
    ("links", "kind"),
    [
        ((40.0, 100.0, 95.0, 100.0), "crank-rocker"),
        ((100.0, 40.0, 95.0, 100.0), "double-rocker"),
        ((100.0, 95.0, 40.0, 100.0), "rocker-crank"),
        ((100.0, 100.0, 100.0, 100.0), "change-point"),
        ((100.0, 20.0, 30.0, 40.0), "impossible"),
    ],
)
@pytest.mark.parametrize("chain", ["bed", "cylinder"])
def test_only_drag_links_serve(chain, links, kind):
    make, numbers = {"bed": (BedChain, (3.0, 150.0, 520.0, 50.0)), "cylinder": (CylinderChain, (1.0, 140.0, 1.0))}[
        chain
    ]
    with pytest.raises(NoSolution) as refusal:
        make(FourBar(*links), *numbers)
    assert refusal.value.key == f"{chain}.double_crank"
    assert refusal.value.message.startswith(f"{chain} drive: ")
    shown = {"impossible": "cannot be assembled", "change-point": "at its change point"}
    assert shown.get(kind, kind) in refusal.value.message
