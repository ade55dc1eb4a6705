"""The four-bar in closed form at one position.

Tolerances, with dev = min(gamma, pi - gamma) and EPS = 2^-52:
* angles: 8 EPS/dev - rounding of the vector B->D, divided by the condition 1/dev; an ulp of the angle more where
  it has wound beyond pi. That is for links within 1:6 of each other; lengths of any ratio have
  (l_max/n + l_max/l_min)/sin(gamma), n the diagonal, which the way there and back is held to;
* velocities: 8 EPS/dev^2, accelerations and jerks 32 EPS/dev^2 of the larger of coupler and rocker (and of the
  driver's own): one more division by sin(gamma), whose relative error is EPS/dev^2; single values cancel;
* against mpmath (acos form and Taylor coefficients, 50 digits) and between two routes the same multiples hold;
* exact symmetries (mirror, scale by a power of two) hold bit by bit;
* published rows of 16 digits: 1e-13 deg, the printed digits with the rounding of degrees.
"""

from __future__ import annotations

import itertools
import json
import math
import re
from pathlib import Path

import mpmath as mp
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sweeps import examples

from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.linkages.fourbar.loop import closing_range, rocker_and_rate, rocker_rate
from gearlink.core.parts.linkages.fourbar.position import FourBar, FourBarState, inverse_reading, solve, solve_inverse

EPS = 2.0**-52
REFERENCE = Path(__file__).parents[2] / "reference"
SWING = {case["id"]: case for case in json.loads((REFERENCE / "swing_gripper.json").read_text())["cases"]}
GEAR = {case["id"]: case for case in json.loads((REFERENCE / "gear_linkage.json").read_text())["cases"]}
FORWARD = [name for name in SWING if name.startswith(("FB-", "TOG-"))]

CRANK_ROCKER = FourBar(18.0, 50.0, 100.0, 121.4)
DRAG_LINK = FourBar(50.0, 45.0, 48.0, 20.0)
DOUBLE_ROCKER = FourBar(150.0, 160.0, 100.0, 300.0)
ROCKER_CRANK = FourBar(100.0, 50.0, 18.0, 121.4)


def apart(x: float, y: float) -> float:
    """Distance of two angles, whole revolutions aside."""
    return abs(math.remainder(x - y, math.tau))


def deviation(gamma: float) -> float:
    return min(gamma, math.pi - gamma)


def oracle(linkage: FourBar, phi: float, order: int) -> list[list[mp.mpf]]:
    """Taylor derivatives 0..order of coupler and rocker angle after phi: law of cosines, 50 digits."""
    a, b, c, d = (mp.mpf(x) for x in (linkage.crank, linkage.coupler, linkage.rocker, linkage.frame))

    def triangle(x: mp.mpf) -> tuple[mp.mpf, mp.mpf, mp.mpf]:
        n2 = a * a + d * d - 2 * a * d * mp.cos(x)
        return n2, mp.sqrt(n2), mp.atan2(-a * mp.sin(x), d - a * mp.cos(x))

    def coupler(x: mp.mpf) -> mp.mpf:
        n2, n, nu = triangle(x)
        return nu + linkage.assembly * mp.acos((n2 + b * b - c * c) / (2 * b * n))

    def rocker(x: mp.mpf) -> mp.mpf:
        n2, n, nu = triangle(x)
        return nu + linkage.assembly * (mp.pi - mp.acos((n2 + c * c - b * b) / (2 * c * n)))

    with mp.workdps(50):
        return [
            [t * mp.factorial(i) for i, t in enumerate(mp.taylor(f, mp.mpf(phi), order))] for f in (coupler, rocker)
        ]


def rates(state: object, order: int) -> list[tuple[float, float]]:
    names = ("velocity", "acceleration", "jerk")[:order]
    return [(getattr(state, f"coupler_{n}"), getattr(state, f"rocker_{n}")) for n in names]


# published cases


@pytest.mark.parametrize("name", FORWARD)
def test_forward_cases_of_the_swing_gripper(name: str) -> None:
    given_, expected = SWING[name]["inputs"], {k: float(v) for k, v in SWING[name]["expected"].items()}
    linkage = FourBar(given_["l1"], given_["l3"], given_["l4"], given_["l0"], given_["branch"])
    motion = {"velocity": given_["omega1"], "acceleration": given_["alpha1"], "jerk": given_["jerk1"]}
    state = solve(linkage, given_["theta1"] - given_["theta0"], 3, **motion)
    dev = deviation(expected["gamma"])
    assert apart(state.coupler_angle + given_["theta0"], expected["theta3"]) <= 8 * EPS / dev
    assert apart(state.rocker_angle + given_["theta0"], expected["theta4"]) <= 8 * EPS / dev
    assert abs(state.transmission_angle - expected["gamma"]) <= 8 * EPS / dev
    for (coupler, rocker), symbol, factor in zip(rates(state, 3), ("omega", "alpha", "jerk"), (8, 32, 32), strict=True):
        pair = expected[f"{symbol}3"], expected[f"{symbol}4"]
        limit = factor * EPS / dev**2 * max(abs(pair[0]), abs(pair[1]))
        assert abs(coupler - pair[0]) <= limit
        assert abs(rocker - pair[1]) <= limit


@pytest.mark.parametrize(("name", "law"), [("INV-01", "33.0"), ("INV-03", "130.0")])
def test_inverse_cases_of_the_swing_gripper(name: str, law: str) -> None:
    expected = {k: float(v) for k, v in SWING[name]["expected"].items()}
    beta = {k: float(v) for k, v in SWING["SIX-02"]["expected"].items()}
    frame, direction = math.hypot(268.0, 55.0), math.atan2(55.0, 268.0)
    state = solve_inverse(
        FourBar(150.0, 260.0, 100.0, frame),
        expected["th4"] - direction,
        3,
        velocity=-beta[f"b1({law})"],
        acceleration=-beta[f"b2({law})"],
        jerk=-beta[f"b3({law})"],
    )
    # The direction of the frame and the rocker angle carry one rounding each: 8 EPS in angles as at dev = 1.
    assert apart(state.crank_angle + direction, expected["th1"]) <= 8 * EPS
    assert apart(state.coupler_angle + direction, expected["th3"]) <= 8 * EPS
    for symbol, kind in (("w", "velocity"), ("a", "acceleration"), ("j", "jerk")):
        assert abs(getattr(state, f"crank_{kind}") - expected[f"{symbol}1"]) <= 16 * EPS
        assert abs(getattr(state, f"coupler_{kind}") - expected[f"{symbol}3"]) <= 16 * EPS


def test_example_three_of_the_thesis() -> None:
    case = GEAR["ex3_kinematics"]
    linkage = FourBar(*(float(case["inputs"][k]) for k in "abcd"))
    for phi, t2, t3, w2, w3, e2, e3, *_ in case["outputs"]["rows"]:
        state = solve(linkage, math.radians(phi), 2)
        assert math.degrees(apart(state.coupler_angle, math.radians(t2))) <= 1e-13
        assert math.degrees(apart(state.rocker_angle, math.radians(t3))) <= 1e-13
        assert rates(state, 2)[0] == pytest.approx((w2, w3), abs=4 * EPS)
        assert rates(state, 2)[1] == pytest.approx((e2, e3), abs=8 * EPS)


def test_assembly_limits() -> None:
    expected = SWING["LIM-01"]["expected"]
    stretched, folded = FourBar(150.0, 160.0, 100.0, 300.0), FourBar(90.0, 160.0, 100.0, 140.0)
    assert closing_range(stretched.reading) == (0.0, pytest.approx(float(expected["A_ext"]), abs=4 * EPS))
    assert closing_range(folded.reading) == (pytest.approx(float(expected["B_fold"]), abs=4 * EPS), math.pi)
    for linkage, inside, outside in ((stretched, 1.04847, 1.04849), (folded, 0.29656, 0.29655)):
        solve(linkage, inside, 3)
        with pytest.raises(NoSolution):
            solve(linkage, outside)


def test_transmission_angles_of_the_working_example() -> None:
    low, high = FourBar(16.0, 50.0, 100.0, 122.83941479186771).transmission_extremes()
    assert (round(math.degrees(low), 2), round(math.degrees(high), 2)) == (83.77, 132.66)
    assert math.degrees(FourBar(16.0, 50.0, 100.0, 122.83941479186771).min_transmission_angle()) == pytest.approx(
        47.34, abs=0.005
    )


# a second method


@pytest.mark.quick(1)
@pytest.mark.parametrize("linkage", [CRANK_ROCKER, DRAG_LINK, DOUBLE_ROCKER, ROCKER_CRANK], ids=FourBar.kind)
@pytest.mark.parametrize("assembly", [1, -1])
def test_angles_and_derivatives_against_mpmath(linkage: FourBar, assembly: int) -> None:
    linkage = FourBar(linkage.crank, linkage.coupler, linkage.rocker, linkage.frame, assembly)
    low, high = closing_range(linkage.reading)
    for share, side in itertools.product((0.02, 0.3, 0.55, 0.98), (1.0, -1.0)):
        phi = side * (low + share * (high - low))
        state = solve(linkage, phi, 3)
        exact = oracle(linkage, phi, 3)
        dev = deviation(state.transmission_angle)
        for angle, true_angle in ((state.coupler_angle, exact[0][0]), (state.rocker_angle, exact[1][0])):
            assert apart(angle, float(true_angle)) <= 8 * EPS / dev + math.ulp(angle)
        for n, (pair, factor) in enumerate(zip(rates(state, 3), (8, 32, 32), strict=True), start=1):
            true = [float(x[n]) for x in exact]
            limit = factor * EPS / dev**2 * max(1.0, abs(true[0]), abs(true[1]))
            assert abs(pair[0] - true[0]) <= limit
            assert abs(pair[1] - true[1]) <= limit


@pytest.mark.parametrize("gap", [1e-3, 1e-8, 1e-12])
@pytest.mark.parametrize("phi", [0.0, 1e-9, 1e-5, math.pi, math.pi - 1e-7])
def test_no_digit_is_lost_at_a_dead_centre_on_the_line_of_the_frame(gap: float, phi: float) -> None:
    """A crank that barely turns fully: coupler and rocker nearly fold at phi = 0 and nearly stretch at pi."""
    for linkage in (FourBar(20.0, 60.0, 100.0 - gap, 60.0 + gap / 2), FourBar(20.0, 60.0 + gap, 40.0, 80.0)):
        with mp.workdps(60):
            a, b, c, d = (mp.mpf(x) for x in (linkage.crank, linkage.coupler, linkage.rocker, linkage.frame))
            n2 = a * a + d * d - 2 * a * d * mp.cos(mp.mpf(phi))
            p, q = (b + c) ** 2 - n2, n2 - (b - c) ** 2
            gamma = 2 * mp.atan(mp.sqrt(q / p))
            rate = a * d * mp.sin(mp.mpf(phi)) * 2 / mp.sqrt(p * q)
        state = solve(linkage, phi, 1)
        assert state.transmission_angle == pytest.approx(float(gamma), rel=4 * EPS)
        lead = state.rocker_velocity - state.coupler_velocity
        assert lead == pytest.approx(float(rate), rel=4 * EPS, abs=4 * EPS * abs(state.rocker_velocity))


@pytest.mark.parametrize("phi", [1e-9, 1e-6, -1e-3, 0.5])
def test_short_diagonal_keeps_its_digits(phi: float) -> None:
    """B next to D with crank = frame and coupler = rocker: D - B must not come from a difference."""
    linkage = FourBar(200.0, 150.0, 150.0, 200.0)
    state, exact = solve(linkage, phi), oracle(linkage, phi, 0)
    assert apart(state.coupler_angle, float(exact[0][0])) <= 2 * EPS
    assert apart(state.rocker_angle, float(exact[1][0])) <= 2 * EPS
    assert state.transmission_angle == pytest.approx(float(exact[1][0] - exact[0][0]), rel=4 * EPS)


@pytest.mark.parametrize("crank", [1e-2, 1e-4, 1e-8])
def test_velocities_of_a_short_crank_keep_their_digits(crank: float) -> None:
    """They are as small as crank/frame; nu' = 1/2 + f/n^2 would leave them an error of eps, whatever their size."""
    linkage = FourBar(crank, 1.1, 0.9, 1.3)
    for phi in (0.7, 1.0, 4.0):
        state, exact = solve(linkage, phi, 1), oracle(linkage, phi, 1)
        velocities = (state.coupler_velocity, exact[0][1]), (state.rocker_velocity, exact[1][1])
        limit = 8 * EPS * max(abs(velocity) for velocity, _ in velocities)
        assert max(abs(found - true) for found, true in velocities) <= limit


def test_paper_matrix_in_turned_axes() -> None:
    """The corrected determinant sin(theta3 - theta4) gives the same rates however the axes are turned."""
    state = solve(FourBar(120.0, 260.0, 150.0, 300.0), 1.125, 1)
    for turn in (0.0, 0.6, 2.0, -1.3):
        phi, b, c = 1.125 + turn, state.coupler_angle + turn, state.rocker_angle + turn
        matrix = (-260.0 * math.sin(b), 150.0 * math.sin(c), 260.0 * math.cos(b), -150.0 * math.cos(c))
        right = (120.0 * math.sin(phi), -120.0 * math.cos(phi))
        det = matrix[0] * matrix[3] - matrix[1] * matrix[2]
        w_b = (right[0] * matrix[3] - matrix[1] * right[1]) / det
        w_c = (matrix[0] * right[1] - matrix[2] * right[0]) / det
        assert w_b == pytest.approx(state.coupler_velocity, abs=8 * EPS)
        assert w_c == pytest.approx(state.rocker_velocity, abs=8 * EPS)


# invariance

LENGTHS = st.tuples(*[st.floats(10.0, 200.0)] * 4)


def closing(lengths: tuple[float, ...], share: float, assembly: int) -> tuple[FourBar, float] | None:
    """A linkage and a crank angle inside its range, or None where it closes nowhere or hardly."""
    linkage = FourBar(*lengths, assembly)
    if linkage.kind() == "impossible":
        return None
    low, high = closing_range(linkage.reading)
    return (linkage, low + share * (high - low)) if high - low > 0.1 else None


@examples(150)
@given(LENGTHS, st.floats(0.05, 0.95), st.sampled_from([1, -1]))
def test_the_loop_closes_on_the_side_asked_for(lengths: tuple[float, ...], share: float, assembly: int) -> None:
    case = closing(lengths, share, assembly)
    if case is None:
        return
    linkage, phi = case
    state = solve(linkage, phi)
    b, c = state.coupler_angle, state.rocker_angle
    x = linkage.crank * math.cos(phi) + linkage.coupler * math.cos(b) - linkage.frame - linkage.rocker * math.cos(c)
    y = linkage.crank * math.sin(phi) + linkage.coupler * math.sin(b) - linkage.rocker * math.sin(c)
    dev = deviation(state.transmission_angle)
    assert math.hypot(x, y) <= 8 * EPS / dev * sum(lengths)
    assert assembly * math.sin(c - b) > 0.0
    assert abs(assembly * (c - b) - state.transmission_angle) <= 4 * EPS * condition(linkage, phi, state)


@examples(100)
@given(LENGTHS, st.floats(0.05, 0.95))
def test_mirror_and_scale_hold_bit_by_bit(lengths: tuple[float, ...], share: float) -> None:
    case = closing(lengths, share, 1)
    if case is None:
        return
    linkage, phi = case
    state = solve(linkage, phi, 3)
    # Where the crank is the longer, nu winds as phi - pi, which mirrors only up to the whole revolution.
    mirror = solve(FourBar(*lengths, -1), -phi, 3)
    turn = math.tau if linkage.crank > linkage.frame else 0.0
    assert abs(mirror.rocker_angle + state.rocker_angle + turn) <= 8 * EPS
    for (b, c), (b_m, c_m), sign in zip(rates(state, 3), rates(mirror, 3), (1, -1, 1), strict=True):
        assert (b_m, c_m) == (sign * b, sign * c)
    assert solve(FourBar(*(0.125 * x for x in lengths)), phi, 3) == state


def condition(linkage: FourBar, phi: float, state: FourBarState[float]) -> float:
    """Condition of the angles of coupler and rocker, (l_max/n + l_max/l_min)/sin(gamma)."""
    a, b, c, d = linkage.crank, linkage.coupler, linkage.rocker, linkage.frame
    to_d = math.hypot(d - a * math.cos(phi), a * math.sin(phi))
    return max(a, b, c, d) * (1.0 / to_d + 1.0 / min(b, c)) / math.sin(state.transmission_angle)


def condition_there_and_back(linkage: FourBar, phi: float, there: FourBarState[float], gain: float) -> float:
    """Condition of the angles after both ways: the return stroke passes on the error of the rocker angle by its gain,
    d phi/d psi, and adds its own."""
    a, b, c, d = linkage.crank, linkage.coupler, linkage.rocker, linkage.frame
    side, psi = math.sin(phi - there.coupler_angle), there.rocker_angle
    to_a = math.hypot(d + c * math.cos(psi), c * math.sin(psi))
    back = max(a, b, c, d) * (1.0 / to_a + 1.0 / min(a, b)) / abs(side)
    return gain * condition(linkage, phi, there) + back


@pytest.mark.parametrize(
    ("lengths", "assembly", "phi"),
    [
        ((12.0, 141.0, 185.0, 176.0), -1, 2.412535855102838),  # the worst of 60,000: 54 eps, 52 of them passed on
        ((129.59896424524004, 117.2072908203983, 138.19402218428715, 123.31563349712695), 1, 1.8326126950006585),
        ((196.7529973437077, 106.46340469841964, 196.22255647778945, 177.8850944545843), 1, 0.7761805554302457),
        ((12.327514604330442, 194.18201991156542, 86.66036671705211, 199.92275618249948), 1, 2.4779102420593153),
    ],
)
def test_the_way_back_passes_on_the_error_of_a_rounded_rocker_angle(
    lengths: tuple[float, ...], assembly: int, phi: float
) -> None:
    """Against 50 digits: the crank angle comes back off by (error of psi) d phi/d psi, but for the return stroke's own
    rounding; so the gain belongs to the condition of the exchange."""
    linkage = FourBar(*lengths, assembly)
    there, exact = solve(linkage, phi), oracle(linkage, phi, 1)[1]
    side = math.sin(phi - there.coupler_angle)
    back = solve_inverse(FourBar(*lengths, 1 if side > 0.0 else -1), there.rocker_angle, 1)
    with mp.workdps(50):
        rounding = mp.mpf(there.rocker_angle) - exact[0]
        passed_on = float((rounding - 2 * mp.pi * mp.nint(rounding / (2 * mp.pi))) / exact[1])
    assert back.crank_velocity == pytest.approx(float(1 / exact[1]), rel=64 * EPS)
    own = condition_there_and_back(linkage, phi, there, 0.0)
    assert apart(back.crank_angle - passed_on, phi) <= 4 * EPS * own


@examples(150)
@given(LENGTHS, st.floats(0.05, 0.95), st.sampled_from([1, -1]))
def test_exchange_of_crank_and_rocker(lengths: tuple[float, ...], share: float, assembly: int) -> None:
    case = closing(lengths, share, assembly)
    if case is None:
        return
    linkage, phi = case
    there = solve(linkage, phi, 3)
    side = math.sin(phi - there.coupler_angle)
    if abs(side) < 0.05 or math.sin(there.transmission_angle) < 0.05:
        return  # a dead centre of one of the two drives: tested on its own
    drive = {
        "velocity": there.rocker_velocity,
        "acceleration": there.rocker_acceleration,
        "jerk": there.rocker_jerk,
    }
    back = solve_inverse(FourBar(*lengths, 1 if side > 0.0 else -1), there.rocker_angle, 3, **drive)
    unit = solve_inverse(FourBar(*lengths, 1 if side > 0.0 else -1), there.rocker_angle, 3)
    cond = condition_there_and_back(linkage, phi, there, max(1.0, abs(unit.crank_velocity), abs(unit.coupler_velocity)))
    assert apart(back.crank_angle, phi) <= 4 * EPS * cond
    assert apart(back.coupler_angle, there.coupler_angle) <= 4 * EPS * cond
    v, e, j = drive.values()
    first, second, third = (
        max(abs(getattr(unit, f"crank_{name}")), abs(getattr(unit, f"coupler_{name}")))
        for name in ("velocity", "acceleration", "jerk")
    )
    terms = (
        abs(v) * first,
        max(v * v * second, abs(e) * first),
        max(abs(v) ** 3 * third, 3.0 * abs(v * e) * second, abs(j) * first),
    )
    for name, crank, term in zip(("velocity", "acceleration", "jerk"), (1.0, 0.0, 0.0), terms, strict=True):
        # Each drive divides by its own sine once more in the rates, of which the largest term counts.
        limit = 8 * EPS * cond * (1.0 / abs(side) + 1.0 / math.sin(there.transmission_angle)) * max(1.0, term)
        assert abs(getattr(back, f"crank_{name}") - crank) <= limit
        assert abs(getattr(back, f"coupler_{name}") - getattr(there, f"coupler_{name}")) <= limit


def test_inverse_linkage_by_its_angle_map() -> None:
    for linkage in (DRAG_LINK, FourBar(50.0, 45.0, 48.0, 20.0, -1), CRANK_ROCKER):
        psi = solve(linkage, 0.7).rocker_angle
        direct, mapped = solve_inverse(linkage, psi, 2), solve(linkage.inverse(), psi + math.pi, 2)
        # psi + pi is rounded to 2 EPS; the crank runs up to 23 times as fast as the rocker, the rest follows.
        ratio = max(1.0, abs(direct.crank_velocity))
        assert direct.crank_angle == pytest.approx(mapped.rocker_angle + math.pi, abs=4 * EPS * ratio)
        assert direct.coupler_angle == pytest.approx(mapped.coupler_angle, abs=4 * EPS * ratio)
        assert direct.crank_acceleration == pytest.approx(mapped.rocker_acceleration, rel=8 * EPS * ratio**2)
        assert linkage.inverse().inverse() == linkage


# continuity


@pytest.mark.parametrize("assembly", [1, -1])
@pytest.mark.parametrize(("lengths", "winding"), [((18.0, 50.0, 100.0, 121.4), 0), ((50.0, 45.0, 48.0, 20.0), 1)])
def test_angles_are_continuous_and_close_the_period(lengths: tuple[float, ...], winding: int, assembly: int) -> None:
    linkage = FourBar(*lengths, assembly)
    step = math.radians(1.0)
    states = [solve(linkage, k * step, 1) for k in range(-720, 1081)]
    for before, after in itertools.pairwise(states):
        for name in ("coupler", "rocker"):
            w = max(abs(getattr(before, f"{name}_velocity")), abs(getattr(after, f"{name}_velocity")))
            moved = getattr(after, f"{name}_angle") - getattr(before, f"{name}_angle")
            assert abs(moved) <= 1.1 * step * max(w, 0.05)
    for k in (0, 100, 359):
        for turns in (1, 2, 4):
            first, later = states[k], states[k + 360 * turns]
            for name in ("coupler_angle", "rocker_angle"):
                # Crank angles of up to three revolutions are rounded to 4 EPS, amplified by the velocity ratio (< 4).
                gone = getattr(later, name) - getattr(first, name)
                assert gone == pytest.approx(math.tau * winding * turns, abs=32 * EPS)


@pytest.mark.parametrize("assembly", [1, -1])
def test_inverse_drag_link_returns_the_crank_angle_with_its_turns(assembly: int) -> None:
    linkage = FourBar(50.0, 45.0, 48.0, 20.0, assembly)
    for k in range(-30, 31):
        phi = 0.7 * k
        state = solve(linkage, phi, 1)
        back = solve_inverse(linkage, state.rocker_angle, 1)
        assert back.crank_angle == pytest.approx(phi, abs=8 * EPS * max(4.0, abs(phi)))
        assert back.coupler_angle == pytest.approx(state.coupler_angle, abs=8 * EPS * max(4.0, abs(phi)))
        assert back.crank_velocity * state.rocker_velocity == pytest.approx(1.0, abs=64 * EPS)


# classes and the change point


@pytest.mark.parametrize(
    ("lengths", "kind", "turns"),
    [
        ((18.0, 50.0, 100.0, 121.4), "crank-rocker", True),
        ((100.0, 50.0, 18.0, 121.4), "rocker-crank", False),
        ((50.0, 45.0, 48.0, 20.0), "drag-link", True),
        ((100.0, 18.0, 50.0, 121.4), "double-rocker", False),
        ((150.0, 160.0, 100.0, 300.0), "double-rocker", False),
        ((40.0, 90.0, 40.0, 90.0), "change-point", True),
        ((0.1, 0.2, 0.4, 0.3), "change-point", None),
        ((0.1, 0.7, 0.2, 0.8), "change-point", None),
        ((10.0, 20.0, 30.0, 60.0), "impossible", False),
        ((10.0, 20.0, 30.0, 61.0), "impossible", False),
    ],
)
def test_kind(lengths: tuple[float, ...], kind: str, turns: bool | None) -> None:
    linkage = FourBar(*lengths)
    assert linkage.kind() == kind
    if turns is not None:
        assert linkage.turns_fully() is turns


@pytest.mark.parametrize("offset", [1e-2, 1e-5, 1e-8])
def test_parallelogram_keeps_its_digits_next_to_the_change_point(offset: float) -> None:
    for phi in (offset, math.pi - offset, 1.0):
        state = solve(FourBar(40.0, 90.0, 40.0, 90.0), phi, 3)
        assert state.coupler_angle == pytest.approx(0.0, abs=4 * EPS)
        assert state.rocker_angle == pytest.approx(phi, abs=4 * EPS)
        assert rates(state, 1)[0] == pytest.approx((0.0, 1.0), abs=8 * EPS)
        # The higher rates are differences of terms that grow as 1/sin(phi) and 1/sin^2(phi).
        assert rates(state, 2)[1] == pytest.approx((0.0, 0.0), abs=32 * EPS / offset)
        assert rates(state, 3)[2] == pytest.approx((0.0, 0.0), abs=64 * EPS / offset**2)


def test_change_point_itself_has_a_position_and_no_rates() -> None:
    linkage = FourBar(40.0, 90.0, 40.0, 90.0)
    assert solve(linkage, 0.0).rocker_angle == 0.0
    with pytest.raises(NoSolution, match="the four-bar is in a dead centre at crank angle"):
        solve(linkage, 0.0, 1)
    with pytest.raises(NoSolution, match="not determined"):
        solve(FourBar(50.0, 70.0, 70.0, 50.0), 0.0)


# failures


def test_refusal_names_angle_distance_limits_and_remedy() -> None:
    with pytest.raises(NoSolution) as caught:
        solve(DOUBLE_ROCKER, math.radians(75.0))
    for part in ("crank angle 75 deg", "BD 298.7 mm", "60 to 260 mm", "60.07 deg", "too long"):
        assert part in str(caught.value)
    with pytest.raises(NoSolution, match=r"too short \(reach 60 to 260 mm\)"):
        solve(FourBar(90.0, 160.0, 100.0, 140.0), 0.1)
    with pytest.raises(NoSolution, match=r"rocker angle 10 deg: AC .* too long.* to .* deg"):
        solve_inverse(CRANK_ROCKER, math.radians(10.0))
    with pytest.raises(
        NoSolution,
        match=r"BD 56\.23 mm is .* too long .reach 10 to 50 mm.; shorten the longest link, 61 mm, below 60 mm",
    ):
        solve(FourBar(10.0, 20.0, 30.0, 61.0), 1.0)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_hair_beyond_the_limit_is_refused_and_a_hair_before_it_solved(side: float) -> None:
    for linkage, sign in ((DOUBLE_ROCKER, 1.0), (FourBar(90.0, 160.0, 100.0, 140.0), -1.0)):
        limit = max(x for x in closing_range(linkage.reading) if x not in (0.0, math.pi))
        solve(linkage, side * (limit - sign * 1e-14), 3)
        with pytest.raises(NoSolution):
            solve(linkage, side * (limit + sign * 1e-14))


@pytest.mark.parametrize("lengths", [(0.0, 1.0, 1.0, 1.0), (1.0, -1.0, 1.0, 1.0), (1.0, 1.0, math.nan, 1.0)])
def test_lengths_must_be_positive_and_finite(lengths: tuple[float, ...]) -> None:
    with pytest.raises(NoSolution, match="must be positive and finite"):
        FourBar(*lengths)


def test_other_refusals() -> None:
    with pytest.raises(NoSolution, match="assembly is 0"):
        FourBar(1.0, 2.0, 2.0, 2.0, 0)
    for angle in (math.nan, math.inf):
        with pytest.raises(NoSolution, match=r"crank angle is .* finite"):
            solve(CRANK_ROCKER, angle)
    with pytest.raises(NoSolution, match="rocker angle is nan"):
        solve_inverse(CRANK_ROCKER, math.nan)
    for linkage in (DOUBLE_ROCKER, FourBar(10.0, 20.0, 30.0, 61.0)):
        with pytest.raises(NoSolution, match="does not turn fully"):
            linkage.min_transmission_angle()
    with pytest.raises(ValueError, match="order is 4"):
        solve(CRANK_ROCKER, 0.0, 4)


def test_rates_that_were_not_asked_for_are_nan() -> None:
    assert math.isnan(solve(CRANK_ROCKER, 0.0).rocker_velocity)
    assert math.isnan(solve(CRANK_ROCKER, 0.0, 2).rocker_jerk)


def test_the_constants_of_the_inverse_are_made_once():
    linkage = FourBar(50.0, 45.0, 48.0, 20.0)
    assert inverse_reading(linkage) is inverse_reading(FourBar(50.0, 45.0, 48.0, 20.0))
    assert inverse_reading(linkage) is not inverse_reading(linkage.inverse())


@pytest.mark.parametrize("assembly", [1, -1])
@pytest.mark.parametrize("lengths", [(18.0, 50.0, 100.0, 121.4), (50.0, 45.0, 48.0, 20.0)])
def test_the_rocker_alone_is_that_of_the_whole_solution_to_the_last_bit(lengths, assembly):
    linkage = FourBar(*lengths, assembly)
    for reading in (linkage.reading, FourBar(*lengths, assembly).inverse().reading):
        for k in range(-40, 41):
            try:
                whole = solve(linkage if reading is linkage.reading else linkage.inverse(), 0.31 * k, 1)
            except NoSolution as error:
                with pytest.raises(NoSolution, match=re.escape(error.message)):
                    rocker_rate(reading, 0.31 * k)
                continue
            assert rocker_and_rate(reading, 0.31 * k) == (whole.rocker_angle, whole.rocker_velocity)
            assert rocker_rate(reading, 0.31 * k) == whole.rocker_velocity


def test_no_rate_is_given_in_a_dead_point_or_at_no_angle() -> None:
    for phi in (math.nan, math.inf):
        with pytest.raises(NoSolution):
            rocker_rate(FourBar(18.0, 50.0, 100.0, 121.4).reading, phi)
    with pytest.raises(NoSolution):
        rocker_and_rate(FourBar(40.0, 90.0, 40.0, 90.0).reading, 0.0)
