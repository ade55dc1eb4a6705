"""Hypocycloid train with a slotted arm, and with a point beside the pitch circle: against the point's own path.

Tolerances: windows by a sliding window over fine rows are good to two rows; differences of a step of 1e-5 to 1e-9.
"""

from __future__ import annotations

import math
from functools import partial
from typing import Any

import numpy as np
import pytest
from factory import design
from hypothesis import given
from hypothesis import strategies as st
from oracles.hypocycloid import acceleration, jerk

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.dwell_gears.hypocycloid_design import HypocycloidSlider, SlottedArm
from gearlink.core.numerics.roots import roots_on

GIVEN: dict[str, Any] = {
    "kind": "hypocycloid-dwell",
    "gears": {"module": 1.6, "planet": 25, "ring": 75},
    "output": "slotted-arm",
    "dwell": {"tolerance": 0.5},
}


@given(n=st.floats(1.5, 8.0), share=st.floats(0.05, 0.95))
def test_the_arm_points_at_the_point(n: float, share: float) -> None:
    arm = SlottedArm(n, share * (n - 1.0))
    t = np.linspace(0.0, 2.0 * math.pi, 4001)
    point = (n - 1.0) * np.exp(1j * t) - arm.ratio * np.exp(-1j * (n - 1.0) * t)
    turn = arm.turn(t, 3)
    assert np.abs(np.exp(1j * turn.value) - point / np.abs(point)).max() < 1e-12
    assert turn.first.max() <= arm.speed_max * (1.0 + 1e-9)
    assert arm.turn(np.zeros(1), 1).first[0] == pytest.approx(arm.speed_max, rel=1e-9)
    assert arm.turn(np.array([math.pi / n]), 1).first[0] == pytest.approx(arm.speed_min, rel=1e-9, abs=1e-12)
    h, scale = 1e-5, 1.0 + np.abs(turn.third).max()
    for k in range(3):
        there, back = (arm.turn(t + way * h, 3)[k] for way in (1.0, -1.0))
        assert np.abs((there - back) / (2.0 * h) - turn[k + 1]).max() < 1e-4 * scale


@pytest.mark.quick(3)
@pytest.mark.parametrize("ratio", [0.7, 1.0, 1.02, 1.15, 1.5])
@pytest.mark.parametrize("tolerance", [0.1, 0.5, 3.0])
def test_windows_are_those_of_a_sliding_window(ratio: float, tolerance: float) -> None:
    arm, rows = SlottedArm(3.0, ratio), 6_000
    t = np.linspace(0.0, 4.0 * math.pi / 3.0, rows + 1)
    angle = np.degrees(arm.turn(t, 1).value)
    best, start, first = 0, 0, 0
    low, high = [], []  # queues of places of minimum and maximum
    for last in range(rows + 1):
        while low and angle[low[-1]] >= angle[last]:
            low.pop()
        while high and angle[high[-1]] <= angle[last]:
            high.pop()
        low.append(last)
        high.append(last)
        while angle[high[0]] - angle[low[0]] > 2.0 * tolerance:
            first += 1
            low, high = [k for k in low if k >= first], [k for k in high if k >= first]
        if last - first > best:
            best, start = last - first, first
    step = t[1]
    found, at = arm.dwell(math.radians(tolerance))
    assert found == pytest.approx(best * step, abs=3.0 * step)
    inside = np.degrees(arm.turn(np.linspace(at, at + found, 2001), 1).value)
    assert np.ptp(inside) == pytest.approx(2.0 * tolerance, rel=1e-6)
    assert at == pytest.approx(start * step % (2.0 * math.pi / 3.0), abs=0.1)  # flat: length tells little of place
    assert 0.0 <= at < 2.0 * math.pi / 3.0


def test_back_step_is_the_way_back_of_the_table() -> None:
    found = design(GIVEN, point={"ratio": 1.3})
    angle = found.table("motion", samples=36_000)["output_angle"]
    back = -np.diff(angle)
    assert math.degrees(found.back_step_angle) == pytest.approx(back[back > 0.0].sum() / 3.0, rel=1e-6)
    assert design(GIVEN).back_step_angle is None
    assert design(GIVEN).steps == 3
    whole = design(GIVEN, gears={"module": 1.6, "planet": 30, "ring": 75})
    assert whole.steps is None
    assert whole.moving.input.turns == 2


def test_forces_by_virtual_work() -> None:
    """Torque of the carrier by the speed of the arm; the slot pushes across at the point's distance."""
    loads = design(GIVEN, command="loads", dwell=None,
                   loads={"speed": 60.0, "forces": [{"on": "arm", "torque": -10.0}]})  # fmt: skip
    phi = np.linspace(0.1, 6.2, 19)
    reactions = loads.machine.reactions(phi)
    assert reactions.torque == pytest.approx(10.0 * loads.design.arm.turn(phi, 1).first, abs=1e-9)
    point = 20.0 * np.abs(2.0 * np.exp(1j * phi) - np.exp(-2j * phi))
    assert np.abs(reactions.unknowns["slot"][0]) == pytest.approx(1e4 / point, rel=1e-9)
    assert loads.power_identity < 1e-9


@pytest.mark.parametrize("ratio", [0.6, 1.0, 1.4])
def test_slider_of_any_point(ratio: float) -> None:
    """The kernel's place, speed, acceleration and jerk against the links in motion."""
    found = design("hypocycloid_slider", point={"ratio": ratio}, rod={"length": 160.0})
    phi = np.linspace(0.05, 6.2, 23)
    slider: HypocycloidSlider = found.slider
    way = found.moving.outputs[0].course.rates(found.moving, phi, 3)
    rates = (lambda t: -slider.deviation(t), slider.speed, partial(acceleration, slider), partial(jerk, slider))
    for k, exact in enumerate(rates):
        assert way[k] == pytest.approx([exact(t) for t in phi], abs=1e-9)
    assert slider.widest_offset == pytest.approx(
        max(abs(slider.point(t).imag) for t in np.linspace(0.0, 6.3, 20_001)), rel=1e-6
    )
    assert (found.osculating_length is None) is (ratio != 1.0)


@pytest.mark.parametrize(("ring", "ratio"), [(75, 1.0), (125, 1.4)])
def test_extremes_of_the_slider_by_hand(ring: int, ratio: float) -> None:
    """Velocity and acceleration by derivatives that were derived by hand, with their zeros over the whole turn."""
    gears = {"module": 1.6, "planet": 25, "ring": ring}
    found = design("hypocycloid_slider", gears=gears, point={"ratio": ratio}, rod={"length": 260.0})
    slider, grid = found.slider, np.linspace(-1.0, 2.0 * math.pi - 1.0, 4001).tolist()
    for name, rate, slope in (
        ("velocity", slider.speed, partial(acceleration, slider)),
        ("acceleration", partial(acceleration, slider), partial(jerk, slider)),
    ):
        values = {rate(t): t % (2.0 * math.pi) for t in roots_on(slope, grid)}
        for side, value in (("max", max(values)), ("min", min(values))):
            assert getattr(found, f"{name}_{side}") == pytest.approx(value, rel=1e-13)
            place, mirrored = getattr(found, f"{name}_{side}_at"), 2.0 * math.pi - values[value]
            alike = (values[value], mirrored) if name == "acceleration" else (values[value],)
            assert min(abs(place - each) for each in alike) < 1e-12


def test_refusals() -> None:
    for keys, key in (({"point": {"ratio": 2.0}}, "point.ratio"), ({"dwell": {"tolerance": 61.0}}, "dwell.tolerance")):
        with pytest.raises(NoSolution) as refused:
            design(GIVEN, **keys).report("analyze")
        assert refused.value.key == key
    for keys, words in (
        ({"rod": {"length": 100.0}}, "omit it"),
        ({"point": {"ratio": 0.0}}, "above 0"),
        ({"output": "slider", "point": {"ratio": 1.2}, "rod": {"rule": "minimax"}}, "rod.length"),
    ):
        with pytest.raises(ValueError, match=words):
            design(GIVEN, **keys)
