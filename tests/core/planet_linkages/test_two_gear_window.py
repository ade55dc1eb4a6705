"""The dwell of given links: its window by a dense scan of the closed form, GL313, and what a synthesis hands over.

Tolerance of the scan: the output leaves the band at its edges with a finite speed, so that a step of 0.01 deg of the
crank finds each end to 0.01 deg.
"""

from __future__ import annotations

import math
from collections import deque
from typing import Any

import factory
import numpy as np
import pytest
from pydantic import ValidationError

from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.linkages.fourbar import sweep

STEP = math.radians(0.01)
FRAME = 83.70093140551192
LINKS: dict[str, Any] = {"dwell": None, "links__frame": FRAME, "dwell_tolerance": 0.5, "dwell_window": 60}


def standing(**keys: Any) -> Any:
    return factory.design("two_gear_standing", **(LINKS | keys))


def scanned(design: Any, tolerance: float) -> float:
    """Longest stretch of crank angles over which the output covers at most twice a tolerance [rad]."""
    phi = np.arange(0.0, 4.0 * math.pi, STEP)
    coupler = sweep.solve(design.linkage, phi).coupler_angle
    output = phi + design.gear_ratio * (coupler - phi)
    output = output.tolist()
    longest, start, least, most = 0, 0, deque[int](), deque[int]()
    for end, angle in enumerate(output):
        for kept, sign in ((least, 1.0), (most, -1.0)):  # places of the minimum and of the maximum since `start`
            while kept and sign * output[kept[-1]] >= sign * angle:
                kept.pop()
            kept.append(end)
        while output[most[0]] - output[least[0]] > 2.0 * tolerance:
            start += 1
            for kept in (least, most):
                while kept[0] < start:
                    kept.popleft()
        longest = max(longest, end - start)
    return longest * STEP


@pytest.mark.quick(1)
@pytest.mark.parametrize("frame", [FRAME, 84.9])
def test_the_window_is_that_of_a_scan(frame: float) -> None:
    design = standing(links__frame=frame)
    assert design.tolerance_dwell_angle == pytest.approx(scanned(design, math.radians(0.5)), abs=2.0 * STEP)


def test_a_window_that_is_missed_fails_and_the_frame_of_the_synthesis_repairs_it() -> None:
    check = next(iter(standing(links__frame=84.9).findings("analyze", "dwell-window")))
    assert (check.status, check.code, check.limit) == ("fail", "GL313", pytest.approx(60.0, rel=1e-15))
    ((key, frame),) = check.remedy
    assert key == "links.frame"
    (again,) = standing(links__frame=frame).check("dwell-window")
    assert again.status == "pass"


def test_a_synthesis_hands_window_and_tolerance_over() -> None:
    synthesis = factory.design("two_gear_standing", command="synth dwell")
    found = {each.path: each.value for each in synthesis.completion()}
    assert (found["dwell_tolerance"], found["dwell_window"]) == (0.5, 60.0)
    again = standing(links__frame=found["links.frame"])
    assert again.tolerance_dwell_angle == pytest.approx(synthesis.tolerance_dwell_angle, rel=1e-12)
    assert again.tolerance_dwell_start == pytest.approx(synthesis.tolerance_dwell_start, rel=1e-12)


@pytest.mark.slow
def test_samples_are_judged_by_the_window() -> None:
    """Frames to either side of where the window is met: the yield is the share of frames that meet it alone."""
    section = {"sources": {"links.frame": {"plus_minus": 1.5, "law": "uniform"}}, "samples": 256}
    study = factory.design("two_gear_standing", command="tolerance", **LINKS, tolerance=section)
    frames = np.linspace(FRAME - 1.5, FRAME + 1.5, 41)
    met = [all(c.status == "pass" for c in standing(links__frame=float(f)).check("dwell-window")) for f in frames]
    found = {name: one.value for name, one in study.result.passes.items()}
    assert 0.0 < found["GL313"] < 1.0
    assert found["GL313"] == pytest.approx(np.mean(met), abs=0.05)


@pytest.mark.parametrize(
    ("keys", "key"),
    [
        ({"dwell_tolerance": None}, "dwell_window"),
        ({"dwell": {"tolerance": 0.5}, "links__frame": None}, "dwell_tolerance"),
    ],
)
def test_keys_that_contradict_each_other_are_refused(keys: dict[str, Any], key: str) -> None:
    with pytest.raises(ValidationError) as caught:
        standing(**keys)
    assert [error["ctx"]["key"] for error in caught.value.errors()] == [key]


def test_a_band_that_holds_the_whole_turn_is_refused_at_its_key() -> None:
    with pytest.raises(NoSolution, match="72 deg") as caught:
        _ = standing(dwell_tolerance=170, dwell_window=None).tolerance_dwell
    assert caught.value.key == "dwell_tolerance"
