"""The linkage of the swing gripper: both ways of its loop, its dead centres, what brings it clear of them.

Tolerances, EPS = 2^-52; the example keeps 70 deg of transmission, so conditions are near 1:
* angles of the 18-digit table: 8 EPS of a half turn; rates 16 EPS and accelerations 64 EPS of their peak - three
  sums of rotating terms, each rounded, divided by sin(mu);
* closed form against Newton-Raphson: 64 EPS over sin(mu) - both read the driving angle shifted by half a revolution;
* turned, shifted and mirrored machines: 16 EPS of a turn, for the pivots are rounded anew; the mirror image is exact
  but for the sign of the rounding in the angles' reduction.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import replace

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracles.gripper import CASES, TABLE, machine, mirrored, turned
from oracles.vector_loop import exact_angles
from sweeps import examples

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.swing_gripper.linkage import (
    DEAD_POINT,
    clear_turn,
    closed_form_error,
    require_swing,
    two_ways,
)
from gearlink.core.parts.linkages.fourbar import sweep as fourbar_sweep

EPS = 2.0**-52
DEGREES = np.arange(0.0, 360.0, 1.0)
EXAMPLE = machine()
LINKAGE = EXAMPLE.linkage
OMEGA = EXAMPLE.shaft_speed


def apart(one, other):
    return np.abs(np.remainder(one - other + math.pi, 2.0 * math.pi) - math.pi)


@pytest.mark.quick(3)
@pytest.mark.parametrize("row", TABLE, ids=lambda row: str(row["theta_deg"]))
def test_positions_of_the_table(row: dict) -> None:
    motion = LINKAGE.motion(np.array([float(row["theta_deg"])]), 2)
    for key, angle in (
        ("beta_deg", motion.beta),
        ("th1_deg", motion.input.value),
        ("th3_deg", motion.coupler.value),
        ("th4_deg", motion.output.value),
    ):
        assert math.degrees(angle[0]) == pytest.approx(float(row[key]), rel=0.0, abs=8 * EPS * 180.0), key
    for key, rate in (
        ("w1", motion.input.first),
        ("w3", motion.coupler.first),
        ("w4", motion.output.first),
    ):
        assert rate[0] * OMEGA == pytest.approx(float(row[key]), rel=0.0, abs=16 * EPS * 12.0), key
    for key, rate in (
        ("a1", motion.input.second),
        ("a3", motion.coupler.second),
        ("a4", motion.output.second),
    ):
        assert rate[0] * OMEGA**2 == pytest.approx(float(row[key]), rel=0.0, abs=64 * EPS * 380.0), key
    at_d, at_c = LINKAGE.transmission(LINKAGE.local_output(motion.beta))
    for key, angle in (("muD_deg", at_d), ("muC_deg", at_c)):
        expected = float(row[key])
        assert math.degrees(angle[0]) == pytest.approx(min(expected, 180.0 - expected), rel=0.0, abs=16 * EPS * 180.0)


@pytest.mark.parametrize("name", ["INV-01", "INV-03"])
def test_inverse_reading_up_to_the_jerk(name: str) -> None:
    case = CASES[name]
    degrees = np.array([case["inputs"]["theta_deg"]])
    beta = LINKAGE.law.evaluate(degrees, 3)
    state = fourbar_sweep.solve_inverse(
        LINKAGE.four_bar,
        LINKAGE.local_output(beta[0]),
        3,
        **{name: -rate for name, rate in zip(("velocity", "acceleration", "jerk"), beta[1:], strict=True)},
    )
    frame = LINKAGE.frame_direction
    values = {
        "th1": state.crank_angle + frame,
        "th3": state.coupler_angle + frame,
        "w1": state.crank_velocity,
        "w3": state.coupler_velocity,
        "a1": state.crank_acceleration,
        "a3": state.coupler_acceleration,
        "j1": state.crank_jerk,
        "j3": state.coupler_jerk,
    }
    for key, value in values.items():
        assert value[0] == pytest.approx(float(case["expected"][key]), rel=0.0, abs=64 * EPS), key


def test_the_cam_rocker_drives_the_gripper_back() -> None:
    """Exchange: the forward four-bar, driven as the inverse one says, gives the law of the gripper."""
    motion = LINKAGE.motion(DEGREES, 2)
    at_d = np.sin(motion.output.value - motion.coupler.value)
    assert (at_d > 0.0).all()
    state = fourbar_sweep.solve(
        LINKAGE.four_bar,
        motion.input.value - LINKAGE.frame_direction,
        2,
        velocity=motion.input.first,
        acceleration=motion.input.second,
    )
    assert apart(state.rocker_angle + LINKAGE.frame_direction, motion.output.value).max() <= 16 * EPS * math.pi
    assert apart(state.coupler_angle + LINKAGE.frame_direction, motion.coupler.value).max() <= 16 * EPS * math.pi
    assert np.abs(state.rocker_velocity - motion.output.first).max() <= 32 * EPS
    assert np.abs(state.rocker_acceleration - motion.output.second).max() <= 64 * EPS


def test_both_ways_agree_on_the_example() -> None:
    motion = LINKAGE.motion(DEGREES, 0)
    ways = two_ways(LINKAGE, motion)
    assert ways.deviation.max() <= 16 * EPS
    assert closed_form_error(LINKAGE, motion).max() <= 8 * EPS
    assert ways.iterations.min() >= 1
    assert ways.iterations.max() <= 4
    assert ways.residual.max() <= 16 * EPS * 780.0


def test_error_of_the_closed_form_is_its_distance_from_60_digits() -> None:
    motion, links = LINKAGE.motion(DEGREES[::23], 0), LINKAGE.four_bar.inverse()
    found = closed_form_error(LINKAGE, motion)
    assert found.max() > EPS / 2
    turned = LINKAGE.frame_direction
    for i, error in enumerate(found):
        exact = exact_angles(links, float((motion.output.value - turned + math.pi)[i]))
        closed = (motion.coupler.value - turned)[i], (motion.input.value - turned - math.pi)[i]
        with mp.workdps(60):
            turns = [(mp.mpf(float(x)) - y) / (2 * mp.pi) for x, y in zip(closed, exact, strict=True)]
            off = max(float(abs(x - mp.nint(x)) * 2 * mp.pi) for x in turns)
        assert error == pytest.approx(off, abs=EPS / 1000)


def test_a_direction_of_another_turn_is_the_same_direction() -> None:
    """Of a gripper that could not go round: Newton-Raphson is not sought a revolution away."""
    links = {"input": 150.0, "coupler": 215.0, "output": 100.0}
    for direction in (-250.0, 110.0):
        linkage = machine(links=links, output_direction=direction).linkage
        motion = linkage.motion(DEGREES, 0)
        assert math.degrees(motion.output.value[0]) == pytest.approx(110.0, abs=1e-12)
        assert two_ways(linkage, motion).iterations.max() <= 4


def test_a_part_of_the_turn_is_part_of_the_same_motion() -> None:
    """The whole machine turned so that each link passes 180 deg on its way: no row depends on the first one."""
    for degrees in range(0, 360, 20):
        turn = cmath.rect(1.0, math.radians(degrees))
        linkage = replace(
            LINKAGE,
            input_pivot=LINKAGE.input_pivot * turn,
            output_pivot=LINKAGE.output_pivot * turn,
            output_direction=LINKAGE.output_direction + math.radians(degrees),
        )
        whole = linkage.motion(DEGREES, 0)
        for first in (97, 200):
            part = linkage.motion(DEGREES[first:], 0)
            for name in ("input", "coupler", "output"):
                assert np.array_equal(getattr(part, name).value, getattr(whole, name).value[first:])
            assert two_ways(linkage, part).iterations.max() <= 4


@pytest.mark.quick(1)
@pytest.mark.parametrize("direction", [137.0, 60.0, 40.0, 26.0, 24.4])
def test_both_ways_agree_near_dead_points(direction: float) -> None:
    linkage = machine(output_direction=direction, limits={"transmission_angle": 1.0}).linkage
    motion = linkage.motion(DEGREES, 0)
    at_c = linkage.transmission(linkage.local_output(motion.beta))[1]
    ways = two_ways(linkage, motion)
    assert (ways.deviation * np.sin(at_c)).max() <= 64 * EPS
    assert (closed_form_error(linkage, motion) * np.sin(at_c)).max() <= 8 * EPS * math.pi


@given(
    links=st.tuples(*(st.floats(60.0, 320.0) for _ in range(3))),
    direction=st.floats(-180.0, 180.0),
    assembly=st.sampled_from([1, -1]),
    sense=st.sampled_from([1, -1]),
)
@examples(80)
def test_every_machine_is_refused_or_closes(links: tuple, direction: float, assembly: int, sense: int) -> None:
    design = machine(
        links=dict(zip(("input", "coupler", "output"), links, strict=True)),
        output_direction=direction,
        assembly=assembly,
        swing_sense=sense,
        limits={"transmission_angle": 20.0},
    )
    key, linkage = "", LINKAGE
    try:
        linkage = design.linkage
    except NoSolution as refused:
        key = refused.key
    if key:
        assert key == "links"
        return
    assert linkage is not LINKAGE
    motion = linkage.motion(DEGREES, 0)
    at_d, at_c = linkage.least_transmission
    assert min(at_d.value, at_c.value) >= DEAD_POINT
    ways = two_ways(linkage, motion)
    assert ways.deviation.max() <= 256 * EPS / math.sin(at_c.value)
    side = assembly * np.sin(motion.input.value - motion.coupler.value)
    assert side.min() > 0.0
    far = np.sin(motion.output.value - motion.coupler.value)
    assert far.min() * far.max() > 0.0
    c = linkage.input_pivot + linkage.input * np.exp(1j * motion.input.value)
    d = linkage.output_pivot + linkage.output * np.exp(1j * motion.output.value)
    loop = c + linkage.coupler * np.exp(1j * motion.coupler.value) - d
    assert np.abs(loop).max() <= 64 * EPS * 1000.0 / math.sin(at_c.value)


@pytest.mark.parametrize("angle", [17.0, -120.5, 200.0])
def test_turning_the_machine_turns_the_directions_alone(angle: float) -> None:
    one, other = LINKAGE.motion(DEGREES, 2), turned(angle, 40.0 - 300.0j).linkage.motion(DEGREES, 2)
    for name in ("input", "coupler", "output"):
        first, second = getattr(one, name), getattr(other, name)
        assert apart(second.value - first.value - math.radians(angle), 0.0).max() <= 32 * EPS * math.pi, name
        assert np.abs(second.first - first.first).max() <= 32 * EPS, name
        assert np.abs(second.second - first.second).max() <= 128 * EPS, name


def test_the_mirror_image_turns_the_other_way() -> None:
    one, other = LINKAGE.motion(DEGREES, 2), mirrored().linkage.motion(DEGREES, 2)
    for name in ("input", "coupler", "output"):
        assert apart(getattr(other, name).value, -getattr(one, name).value).max() <= 4 * EPS * math.pi, name
    for name, order in (("input", 1), ("coupler", 1), ("output", 2), ("input", 2)):
        assert np.abs(getattr(other, name)[order] + getattr(one, name)[order]).max() <= 16 * EPS, name


def test_least_transmission_angles_against_a_fine_sweep() -> None:
    for design in (EXAMPLE, machine(output_direction=60.0), machine(links__output=160.0)):
        linkage = design.linkage
        swing = np.linspace(0.0, linkage.law.total_swing, 20001)
        for least, angles in zip(
            linkage.least_transmission, linkage.transmission(linkage.local_output(swing)), strict=True
        ):
            assert least.value <= angles.min() + 4 * EPS
            assert least.value >= angles.min() - 1e-8


def test_transmission_angles_of_the_example() -> None:
    scanned = {key: math.radians(float(value)) for key, value in (("D", "69.7178346241"), ("C", "73.0626895763"))}
    at_d, at_c = LINKAGE.least_transmission
    # Printed with 12 digits, and minimum at the end of the stroke, where the scan stood.
    assert at_d.value == pytest.approx(scanned["D"], rel=0.0, abs=1e-12)
    assert at_c.value == pytest.approx(scanned["C"], rel=0.0, abs=1e-12)
    assert at_d.place == LINKAGE.law.total_swing


@pytest.mark.quick(2)
@pytest.mark.parametrize(
    ("changes", "swing"),
    [
        ({}, 1.0),
        ({"links__coupler": 270.0}, 0.0),
        ({"output_direction": 60.0}, 1.0),
        ({"output_direction": 45.0}, None),
    ],
)
def test_the_least_angle_stands_on_the_working_stroke(changes: dict[str, float], swing: float | None) -> None:
    """At an end of the stroke it is the very end; within it (None) the cylinder angle is that of the swing."""
    made = machine(**changes)
    place = math.degrees(made.motion.extremes["min_transmission_angle_at"][1])
    least, law = made.linkage.least_transmission[1], made.linkage.law
    if swing is not None:
        assert least.place == swing * law.total_swing
        assert place == pytest.approx(swing * law.starts[3], rel=1e-15)
    assert 0.0 <= place <= law.starts[3] * (1.0 + EPS)
    assert law.evaluate(place, 0)[0][0] == pytest.approx(least.place, abs=1e-14)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"links__coupler": 115.5}, r"cannot be assembled at cylinder angle 0 deg: AD 277.2 mm"),
        ({"links__coupler": 127.5}, "cannot be assembled at cylinder angle [1-9]"),
        ({"output_direction": 23.6}, "dead centre at joint D .* at cylinder angle 154.3"),
        ({"output_direction": 23.7}, "dead centre at joint D .* at cylinder angle 162 deg"),
    ],
)
def test_refusals_name_the_cylinder_angle(changes: dict, words: str) -> None:
    with pytest.raises(NoSolution, match=words) as refused:
        _ = machine(**changes).linkage
    assert refused.value.key == "links"


def test_the_coupler_that_is_asked_for_closes_the_linkage() -> None:
    with pytest.raises(NoSolution) as refused:
        _ = machine(links__coupler=115.5).linkage
    missing = float(str(refused.value).split("lengthen input or coupler by ")[1].split()[0])
    # Rounded to four digits; a tenth of a millimetre more takes it off the dead centre.
    assert machine(links__coupler=115.5 + missing + 0.1).linkage.least_transmission[1].value > DEAD_POINT


@pytest.mark.parametrize("direction", [150.0, 60.0, 137.2, 23.0, -120.0])
def test_the_turn_that_is_recommended_serves(direction: float) -> None:
    limit = math.radians(40.0)
    linkage = replace(LINKAGE, output_direction=math.radians(direction))
    turn, widest = clear_turn(linkage, limit)
    assert turn is not None
    assert widest >= linkage.law.total_swing
    repaired = machine(output_direction=direction + math.degrees(turn)).linkage
    assert min(least.value for least in repaired.least_transmission) >= limit
    if turn:
        short = machine(output_direction=direction + math.degrees(turn) * 0.9).linkage
        assert min(least.value for least in short.least_transmission) < limit + math.radians(1.0)


def test_no_turn_serves_too_wide_a_swing() -> None:
    turn, widest = clear_turn(LINKAGE, math.radians(80.0))
    assert turn is None
    assert 0.0 < widest < LINKAGE.law.total_swing
    turn, widest = clear_turn(LINKAGE, math.radians(89.9))
    assert turn is None
    assert widest < math.radians(0.5)


def test_a_good_linkage_is_let_pass() -> None:
    require_swing(LINKAGE, math.radians(40.0))
