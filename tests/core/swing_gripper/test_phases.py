"""Phases of a gripper that follow from others: the remainder, and those that balance sizes."""

from __future__ import annotations

import math
from typing import Any

import factory
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gearlink.core.base.errors import NoSolution

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
