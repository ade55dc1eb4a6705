"""Phases of a gripper that follow from others: the remainder, and those that balance sizes."""

from __future__ import annotations

import math
from contextlib import suppress
from typing import Any

import factory
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from gearlink.core.base.errors import MissingSection, NoSolution

LENGTHS = {"accelerate": 100.0, "constant": 12.0, "decelerate": 50.0, "far_dwell": 8.0, "return": 120.0}
SIZED = ("accelerate", "decelerate", "return")


def gripper(phases: dict[str, float], **changed: Any) -> Any:
    return factory.design("swing_gripper", command="gripper", phases=phases, **changed)


def degrees(design: Any, name: str) -> float:
    return math.degrees(design.raw(name))


@pytest.mark.parametrize("omitted", [*LENGTHS, "near_dwell"])
def test_any_one_phase_is_the_remainder(omitted: str) -> None:
    whole = LENGTHS | {"near_dwell": 70.0}
    design = gripper({key: value for key, value in whole.items() if key != omitted})
    assert design.motion.phases == tuple(whole.values())
    assert degrees(design, f"{omitted}_angle") == pytest.approx(whole[omitted], abs=1e-12)


@pytest.mark.quick(1)
@pytest.mark.parametrize(("name", "command"), [("swing_gripper_stop", "gripper"), ("loaded_gripper", "loads")])
def test_a_gripper_without_a_far_dwell_is_that_of_a_dwell_that_vanishes(name: str, command: str) -> None:
    """Each quantity against that with a dwell of 1e-9 deg, which moves the return by 1e-11 of its length: 1e-7.

    But the vibration: the motion from near dwell to near dwell is one, see below.
    """
    none, short = (factory.design(name, command=command, phases={**LENGTHS, "far_dwell": far}) for far in (0.0, 1e-9))
    for quantity in set(none.quantity_names()) - {"rise_periods", "residual_amplitude", "residual_speed_limit"}:
        with suppress(MissingSection):
            value = none.raw(quantity)
            if np.asarray(value).dtype == np.float64:
                assert value == pytest.approx(short.raw(quantity), rel=1e-7, abs=1e-7), quantity


def test_without_a_far_dwell_the_whole_way_leaves_its_vibration_in_the_near_dwell() -> None:
    """Duhamel's integral by the midpoint rule with 200000 steps, error of (w dt)^2 = 1e-6 and less."""
    design = factory.design("loaded_gripper", command="loads", phases={**LENGTHS, "far_dwell": 0.0})
    turn, natural, damping = 0.3, 2.0 * math.pi * 110.0, 0.03
    assert design.raw("rise_periods") == pytest.approx(282.0 / 360.0 * turn * 110.0, rel=1e-12)
    moving, count = 282.0 / 360.0 * turn, 200_000
    time = (np.arange(count) + 0.5) * (moving / count)
    second = design.design.motion.law.evaluate(time / turn * 360.0, 2)[2] * (2.0 * math.pi / turn) ** 2
    damped = natural * math.sqrt(1.0 - damping**2)
    answer = np.sum(second * np.exp((-damping * natural + 1j * damped) * (moving - time))) * (moving / count)
    assert design.raw("residual_amplitude") == pytest.approx(abs(answer) / damped, rel=1e-5)


def test_without_a_handover_it_is_the_middle_of_the_constant_phase() -> None:
    design = gripper(LENGTHS, handover=None)
    assert design.motion.handover == 106.0
    assert degrees(design, "handover_angle") == pytest.approx(106.0, abs=1e-12)


@pytest.mark.parametrize(
    ("phases", "words"),
    [
        ({"accelerate": 100, "constant": 12, "decelerate": 50, "far_dwell": 8}, "at most one phase may be omitted"),
        (LENGTHS | {"return": 200}, "the given phases add up to 370 deg; nothing is left for near_dwell"),
        (LENGTHS | {"balance": 1.5}, "balance sizes accelerate"),
        ({"constant": 12, "far_dwell": 8, "balance": 1.5}, "balance sizes accelerate"),
        (LENGTHS | {"near_dwell": 71}, "sum of the six phases: 361 deg"),
    ],
)
def test_phases_that_leave_nothing_or_too_much_open_are_refused(phases: dict[str, float], words: str) -> None:
    with pytest.raises(ValueError, match=words):
        gripper(phases)


@pytest.mark.parametrize(
    ("changed", "fix"),
    [
        ({"return": 60}, "set phases.near_dwell to 130 deg"),
        ({"accelerate": 110}, "set phases.near_dwell to 60 deg"),
        ({"decelerate": 130}, "set phases.decelerate to 50 deg"),
    ],
)
def test_the_last_phase_takes_up_the_change(changed: dict[str, float], fix: str) -> None:
    """With a longer acceleration, as it was, the handover of the file lay before the constant phase."""
    with pytest.raises(ValidationError) as refused:
        gripper(LENGTHS | {"near_dwell": 70} | changed)
    assert refused.value.errors()[0]["msg"].partition("\n")[2] == fix


def peaks(design: Any) -> list[float]:
    """Maximum |beta''| in accelerate, decelerate and return, off a dense grid of the turn."""
    law, found = design.motion.law, []
    for k in (0, 2, 4):
        inside = np.linspace(law.starts[k], law.starts[k + 1], 20_001)[:-1]
        found.append(float(np.abs(law.evaluate(inside, 2)[2]).max()))
    return found


@pytest.mark.slow
@settings(max_examples=25)
@given(
    ratio=st.floats(0.3, 4.0),
    constant=st.floats(2.0, 40.0),
    near=st.floats(20.0, 120.0),
    laws=st.sampled_from([("velocity-345", "half-cycloidal"), ("half-345", "velocity-4567"), ("half-mcv-33",) * 2]),
)
def test_balanced_phases_have_the_peaks_that_are_asked_for(
    ratio: float, constant: float, near: float, laws: tuple[str, str]
) -> None:
    phases = {"constant": constant, "far_dwell": 8.0, "near_dwell": near, "balance": ratio}
    named = {"accelerate": laws[0], "decelerate": laws[1], "return": "modified-sine"}
    design = gripper(phases, handover=None, laws=named)
    first, second, back = peaks(design)
    assert sum(design.motion.phases) == pytest.approx(360.0, abs=1e-10)
    # The grid misses a peak by a relative (pi/2 * 1/20000)^2/2 at most, here 1e-8.
    assert second == pytest.approx(first, rel=1e-6)
    assert back == pytest.approx(ratio * first, rel=1e-6)


def test_a_handover_outside_the_balanced_constant_phase_is_refused() -> None:
    design = gripper({"constant": 12, "far_dwell": 8, "near_dwell": 70, "balance": 1.5}, handover=106)
    with pytest.raises(NoSolution, match=r"balanced: 82\.21 to 94\.2 deg") as refused:
        design.raw("total_swing")
    assert refused.value.key == "handover"


def test_a_limit_of_the_return_is_judged_and_repaired_by_balanced_phases() -> None:
    phases = LENGTHS | {"return": 90.0, "near_dwell": 100.0}
    design = gripper(phases, limits={"return_acceleration": 2.0})
    (found,) = design.check("phase-allotment")
    first, _, back = peaks(design)
    assert (found.code, found.status, found.limit) == ("GL420", "fail", 2.0)
    assert found.value == pytest.approx(back / first, rel=1e-6)
    remedy = next(iter(type(design).candidates(design, "phase-allotment")))
    mended = dict(remedy)
    better = gripper(
        phases | {key: mended[f"phases.{key}"] for key in SIZED},
        handover=mended["handover"],
        limits={"return_acceleration": 2.0},
    )
    assert [each.status for each in better.check("phase-allotment")] == ["pass"]


def test_without_that_limit_nothing_is_said_of_the_allotment() -> None:
    assert "phase-allotment" not in gripper(LENGTHS).outline("gripper").checks
