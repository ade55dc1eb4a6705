"""The six-phase law of the swing gripper.

Tolerances, EPS = 2^-52:
* reference values: 8 EPS of the derivative's peak - laws are within 8 ulp of their peak, scaled by w and the span;
* integrals of a derivative: 1e-13 of the function's peak - Gauss's rule on panels that end at no jump is exact to
  rounding, which the sum of 60 panels of 20 points multiplies by some ten;
* joints: 16 EPS of the peak for the value and both derivatives - one law ends and another begins there;
* symmetries: exact, because they hold for each operation, or one rounding of the peak where u' = 1 - u.
"""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sweeps import examples

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.swing_gripper.law import PHASES, SixPhaseLaw
from gearlink.core.parts.cams.laws import REST_TO_REST, REST_TO_SPEED, law

EPS = 2.0**-52
REFERENCE = json.loads((Path(__file__).parents[2] / "reference" / "swing_gripper.json").read_text())
CASES = {case["id"]: case for case in REFERENCE["cases"]}
LENGTHS = (100.0, 12.0, 50.0, 8.0, 120.0, 70.0)
RUN_UPS = [*REST_TO_SPEED, {"quintic": 0.44}, {"septic": 0.55}]
RISES = [name for name in REST_TO_REST if name != "simple-harmonic"]


def made(accelerate="velocity-345", decelerate="half-cycloidal", return_="modified-sine", lengths=LENGTHS, speed=0.45):
    return SixPhaseLaw(lengths, speed, law(accelerate), law(decelerate), law(return_))


EXAMPLE = made()


def peaks(motion: SixPhaseLaw) -> list[float]:
    return [float(np.abs(values).max()) for values in motion.evaluate(np.arange(0.0, 360.0, 0.25), 3)]


def test_boundaries_of_the_example() -> None:
    expected = CASES["SIX-01"]["expected"]
    beta = np.degrees(EXAMPLE.evaluate(np.array([100.0, 112.0, 162.0, 106.0]), 0)[0])
    for name, value in zip(("beta_A1_deg", "beta_A2_deg", "beta_total_deg", "beta_at_theta_A_deg"), beta, strict=True):
        assert value == pytest.approx(float(expected[name]), rel=4 * EPS, abs=0.0)
    assert math.degrees(EXAMPLE.total_swing) == pytest.approx(39.15, rel=4 * EPS, abs=0.0)
    assert EXAMPLE.starts == (0.0, 100.0, 112.0, 162.0, 170.0, 290.0, 360.0)


def test_reference_values() -> None:
    case, scale = CASES["SIX-02"], peaks(EXAMPLE)
    for theta in case["inputs"]["theta_deg"]:
        for order, values in enumerate(EXAMPLE.evaluate(np.array([theta]), 3)):
            name = f"{'beta' if order == 0 else f'b{order}'}({theta})"
            assert values[0] == pytest.approx(float(case["expected"][name]), rel=0.0, abs=8 * EPS * scale[order]), name


@pytest.mark.quick(3)
@pytest.mark.parametrize("phase", range(6))
@pytest.mark.parametrize("order", [0, 1])
def test_every_derivative_integrates_to_the_one_before(phase: int, order: int) -> None:
    nodes, weights = np.polynomial.legendre.leggauss(20)
    start, end = EXAMPLE.starts[phase : phase + 2]
    # Sixteenths of the phase hold every joint of the three laws' zones.
    edges = np.linspace(start, end, 65)
    middle, half = 0.5 * (edges[1:] + edges[:-1]), 0.5 * np.diff(edges)
    places = middle[:, None] + half[:, None] * nodes
    rate = EXAMPLE.evaluate(places.ravel(), order + 1)[order + 1].reshape(places.shape)
    gained = np.cumsum(np.radians(half) * (rate @ weights))
    inside = EXAMPLE.evaluate(edges[1:-1], order)[order]
    first = EXAMPLE.in_phase(phase, np.array([0.0]), order)[order][0]
    assert np.abs(inside - first - gained[:-1]).max() <= 1e-13 * peaks(EXAMPLE)[order]


@pytest.mark.quick(11)
@pytest.mark.parametrize("run_up", RUN_UPS, ids=str)
def test_joints_are_continuous_for_every_run_up(run_up: object) -> None:
    motion = made(run_up, run_up)
    for order in range(3):
        assert np.abs(motion.joints[:, order]).max() <= 16 * EPS * peaks(motion)[order]


@pytest.mark.quick(3)
@pytest.mark.parametrize("rise", RISES)
def test_joints_are_continuous_for_every_return(rise: str) -> None:
    motion = made(return_=rise)
    for order in range(3):
        assert np.abs(motion.joints[:, order]).max() <= 16 * EPS * peaks(motion)[order]


def test_a_step_of_the_jerk_is_told() -> None:
    # The half-cycloidal law ends at the constant speed with j = -pi^2/2, at the dwell with +pi^2/2 by w/D^2.
    jumps = EXAMPLE.joints[:, 3]
    span = math.radians(50.0)
    assert jumps[PHASES.index("decelerate")] == pytest.approx(-0.45 * math.pi**2 / 2 / span**2, rel=1e-14, abs=0.0)
    assert jumps[PHASES.index("constant")] == 0.0
    smooth = made("velocity-4567", {"septic": 0.5}, "polynomial-4567")
    assert np.abs(smooth.joints[:, 3]).max() <= 64 * EPS * peaks(smooth)[3]


def test_without_a_far_dwell_deceleration_and_return_meet_in_one_joint() -> None:
    """Against one-sided limits: third differences of the swing on either side of 162 deg, by steps of 0.01 deg.

    Their error is h times the derivative's slope, 1e-3 of its peak; the step counts 16 EPS of the peak as above.
    """
    motion = made(lengths=(100.0, 12.0, 50.0, 0.0, 120.0, 78.0))
    assert motion.phase(np.array([161.9, 162.0])).tolist() == [2, 4]
    for order in range(3):
        assert np.abs(motion.joints[:, order]).max() <= 16 * EPS * peaks(motion)[order]
    step = 0.01
    rate = [motion.evaluate(162.0 + sign * step * np.arange(1.0, 3.0), 2)[2] for sign in (-1.0, 1.0)]
    before, after = (float(a - b) / math.radians(step) for a, b in ((rate[0][0], rate[0][1]), (rate[1][1], rate[1][0])))
    jumps = motion.joints[:, 3]
    assert jumps[PHASES.index("far-dwell")] == 0.0
    assert jumps[PHASES.index("return")] == pytest.approx(after - before, rel=0.0, abs=1e-3 * peaks(motion)[3])


def test_the_constant_phase_runs_at_exactly_the_speed() -> None:
    _, rate, second = EXAMPLE.evaluate(np.linspace(100.0, 112.0, 33)[:-1], 2)
    assert (rate == 0.45).all()
    assert (second == 0.0).all()


def test_periodic_in_whole_turns() -> None:
    degrees = np.arange(0.0, 360.0, 0.5)
    for one, other in zip(EXAMPLE.evaluate(degrees, 3), EXAMPLE.evaluate(degrees + 720.0, 3), strict=True):
        assert (one == other).all()


def test_a_joint_belongs_to_the_phase_that_starts_there() -> None:
    assert EXAMPLE.phase(np.array(EXAMPLE.starts)).tolist() == [0, 1, 2, 3, 4, 5, 0]


def test_deceleration_is_acceleration_backwards() -> None:
    motion = made("half-modified-sine", "half-modified-sine", lengths=(80.0, 20.0, 80.0, 40.0, 100.0, 40.0))
    degrees = np.linspace(0.0, 80.0, 321)
    up, down = motion.evaluate(degrees, 3), motion.evaluate(180.0 - degrees, 3)
    for order, sign in enumerate((-1.0, 1.0, -1.0, 1.0)):
        mirrored = sign * down[order] + (motion.total_swing if order == 0 else 0.0)
        inside = slice(1, -1) if order == 3 else slice(None)
        assert np.abs(up[order] - mirrored)[inside].max() <= 32 * EPS * peaks(motion)[order]


def test_scales_with_the_speed() -> None:
    degrees = np.arange(0.0, 360.0, 1.0)
    for one, other in zip(EXAMPLE.evaluate(degrees), made(speed=0.9).evaluate(degrees), strict=True):
        assert (2.0 * one == other).all()


@given(
    parts=st.lists(st.floats(1.0, 10.0), min_size=6, max_size=6),
    speed=st.floats(0.05, 2.0),
    laws=st.tuples(st.sampled_from(RUN_UPS), st.sampled_from(RUN_UPS), st.sampled_from(RISES)),
)
@examples(60)
def test_out_and_home_without_turning_back(parts: list[float], speed: float, laws: tuple) -> None:
    lengths = tuple(360.0 * part / sum(parts) for part in parts)
    motion = made(*laws, lengths=lengths, speed=speed)
    beta, rate = motion.evaluate(np.linspace(0.0, 360.0, 721)[:-1], 1)
    phase = motion.phase(np.linspace(0.0, 360.0, 721)[:-1])
    total = motion.total_swing
    assert beta.min() >= -8 * EPS * total
    assert beta.max() <= total * (1.0 + 8 * EPS)
    assert (rate[phase < 3] >= -8 * EPS * speed).all()
    assert (rate[phase == 4] <= 8 * EPS * speed).all()
    assert (rate[phase < 3] <= speed * (1.0 + 8 * EPS)).all()
    kappas = motion.accelerate.kappa * lengths[0] + lengths[1] + motion.decelerate.kappa * lengths[2]
    assert total == pytest.approx(speed * math.radians(kappas), rel=16 * EPS, abs=0.0)


@given(share=st.floats(0.001, 0.999))
@examples(50)
def test_reaches_inverts_the_stroke(share: float) -> None:
    swing = share * EXAMPLE.total_swing
    back = EXAMPLE.evaluate(np.array([EXAMPLE.reaches(swing)]), 0)[0][0]
    assert back == pytest.approx(swing, rel=0.0, abs=16 * EPS * EXAMPLE.total_swing)


def test_a_law_with_a_jump_inside_is_told() -> None:
    assert made(return_={"scca": [0.5, 0.5, 0.0, 0.0]}).inner_steps == ("return",)
    assert EXAMPLE.inner_steps == ()


@pytest.mark.parametrize(
    ("laws", "key", "words"),
    [
        ({"accelerate": "cycloidal"}, "laws.accelerate", "use velocity-345 or half-cycloidal"),
        ({"decelerate": "modified-sine"}, "laws.decelerate", "rest-to-speed"),
        ({"return_": "half-cycloidal"}, "laws.return", "use cycloidal or modified-sine"),
        ({"return_": "simple-harmonic"}, "laws.return", "acceleration of simple-harmonic is not zero at its ends"),
    ],
)
def test_laws_that_do_not_fit_are_refused(laws: dict, key: str, words: str) -> None:
    with pytest.raises(NoSolution, match=words) as refused:
        made(**laws)
    assert refused.value.key == key
