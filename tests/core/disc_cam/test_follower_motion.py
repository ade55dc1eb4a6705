"""The motion of a follower: derivatives by differences, the spline and joined polynomials by other ways."""

from __future__ import annotations

import math
from typing import Any

import factory
import numpy as np
import pytest
from scipy.interpolate import make_interp_spline

from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.cams.follower_motion import FollowerMotion, motion_of, spline
from gearlink.core.parts.cams.motion_spec import Segment
from gearlink.core.parts.cams.servo import deviation, greatest_error, rows_for

LAWS: list[Any] = [
    "modified-sine",
    "mcv-33",
    {"scca": [0.25, 0, 0.75, 0]},
    {"type": "blend", "laws": ["cycloidal", "polynomial-345"], "share": 0.3},
    {"type": "shifted", "law": "modified-sine", "inflection": 0.4},
    {"type": "harmonic"},
    {"type": "polydyne", "periods": 2.5, "damping": 0.05},
    {"type": "optimal", "minimize": "jerk", "degree": 9},
]


def made(*segments: dict[str, Any], initial: float = 0.0) -> FollowerMotion:
    return motion_of([Segment.model_validate(segment) for segment in segments], initial)


def holds_derivatives(motion: FollowerMotion) -> None:
    """Each derivative is the one before by differences, away from the joints."""
    phi, h = np.linspace(0.013, 6.27, 997), 1e-5
    phi = phi[np.min(np.abs(phi[:, None] - np.array(motion.joints)[None, :]), axis=1) > 3.0 * h]
    below, above, at = (motion.evaluate(phi + shift, 3) for shift in (-h, h, 0.0))
    for order in range(3):
        slope = (above[order] - below[order]) / (2.0 * h)
        assert slope == pytest.approx(at[order + 1], abs=1e-6 * (1.0 + np.abs(at[order + 1]).max()))


@pytest.mark.quick(3)
@pytest.mark.parametrize("law", LAWS, ids=str)
def test_derivatives_of_laws(law: Any) -> None:
    motion = made({"to": 100, "lift": 20, "law": law}, {"to": 150}, {"to": 360, "lift": 0, "law": law})
    holds_derivatives(motion)
    assert motion.evaluate(np.radians([100.0, 149.0]), 0)[0] == pytest.approx([20.0, 20.0], rel=1e-15)


def test_from_rest_to_speed_and_back() -> None:
    motion = made(
        {"to": 60, "lift": 10, "law": "half-cycloidal"},
        {"to": 120, "lift": 30, "law": "constant-velocity"},
        {"to": 180, "lift": 40, "law": "half-cycloidal", "mirrored": True},
        {"to": 300, "return": "mirrored"},
        {"to": 360},
    )
    holds_derivatives(motion)
    assert [jump for _, jump in motion.steps(1)] == pytest.approx([0.0] * 7, abs=1e-12)
    phi = np.linspace(0.0, math.pi, 50)[1:-1]
    rise, back = motion.evaluate(phi, 2), motion.evaluate(math.pi + (math.pi - phi) * 2.0 / 3.0, 2)
    assert back[0] == pytest.approx(rise[0], abs=1e-11)
    assert back[1] == pytest.approx(-1.5 * rise[1], abs=1e-11)
    assert back[2] == pytest.approx(2.25 * rise[2], abs=1e-10)


def test_a_symmetric_reversal_has_its_closed_form() -> None:
    """a = -20 h/(3 b^2), and no jerk there."""
    motion = made({"to": 90, "lift": 10, "law": "polynomial"}, {"to": 180, "lift": 0, "law": "polynomial"}, {"to": 360})
    values = motion.evaluate(np.array([0.5 * math.pi]), 3)
    assert float(values[2][0]) == pytest.approx(-200.0 / (3.0 * (0.5 * math.pi) ** 2), rel=1e-14)
    assert float(values[1][0]) == 0.0
    assert float(values[3][0]) == pytest.approx(0.0, abs=1e-12)


def test_free_values_have_the_least_integral_of_the_squared_jerk() -> None:
    keys = {"law": "polynomial"}
    ends = ({"to": 40}, {"to": 100, "lift": 10, **keys})
    rest = ({"to": 180, "lift": 35, **keys}, {"to": 260, "lift": 0, "law": "cycloidal"}, {"to": 360})

    def cost(v: float, a: float) -> float:
        motion = made(ends[0], {**ends[1], "end_velocity": v, "end_acceleration": a}, *rest)
        x, w = np.polynomial.legendre.leggauss(8)
        total = 0.0
        for piece in motion.pieces[1:3]:
            phi = piece.start + 0.5 * (x + 1.0) * piece.width
            total += 0.5 * piece.width * float(w @ motion.evaluate(phi, 3)[3] ** 2)
        return total

    v, a = (float(each[0]) for each in made(*ends, *rest).evaluate(np.radians([100.0]), 2)[1:])
    least = cost(v, a)
    for dv, da in ((1e-3, 0.0), (-1e-3, 0.0), (0.0, 1e-3), (0.0, -1e-3), (1e-3, 1e-3)):
        assert cost(v + dv, a + da) > least


def test_given_end_values_hold() -> None:
    segments = [{"to": 90, "lift": 10, "law": "polynomial", "end_velocity": 7.0, "end_acceleration": -3.0}]
    motion = made(*segments, {"to": 200, "lift": 20, "law": "polynomial"}, {"to": 360, "lift": 0, "law": "polynomial"})
    assert [float(each[0]) for each in motion.evaluate(np.array([0.5 * math.pi]), 2)] == pytest.approx(
        [10.0, 7.0, -3.0], rel=1e-13
    )


def test_the_spline_is_the_periodic_quintic_one() -> None:
    rng = np.random.default_rng(4)
    angles = np.radians(np.concatenate(([0.0], np.sort(rng.uniform(5.0, 355.0, 17)), [360.0])))
    lifts = np.concatenate((values := rng.uniform(0.0, 20.0, 18), values[:1]))
    ours, theirs = spline(angles.tolist(), lifts.tolist()), make_interp_spline(angles, lifts, 5, bc_type="periodic")
    phi = np.linspace(0.0, 6.28, 999)
    for order, values in enumerate(ours.evaluate(phi, 3)):
        wanted = theirs(phi, nu=order)
        assert values == pytest.approx(wanted, abs=1e-9 * np.abs(wanted).max())


@pytest.mark.parametrize(
    "segment",
    [
        {"law": {"type": "shifted", "law": "mcv-33", "inflection": 2.0}},
        {"law": {"type": "twist"}},
        {"law": "no-such-law"},
        {"law": "cycloidal", "mirrored": True},
    ],
)
def test_refusals_stand_at_the_motion(segment: dict[str, Any]) -> None:
    with pytest.raises(NoSolution, match="segment 1") as refused:
        made({"to": 180, "lift": 5, **segment}, {"to": 360, "lift": 0})
    assert refused.value.key.startswith("motion[0]")


def test_a_rise_is_not_repeated_backwards_from_another_lift() -> None:
    """The lift would step from 4 to 12."""
    returns = {"to": 200, "lift": 4}, {"to": 280, "return": "mirrored"}, {"to": 360}
    with pytest.raises(NoSolution, match=r"segment 3 begins at lift 4 and .* ends at 12") as refused:
        made({"to": 100, "lift": 12}, *returns)
    assert (refused.value.key, refused.value.fix) == ("motion", "give lift and law")


def test_strokes_divide_a_polynomial_where_it_turns() -> None:
    keys = {"law": "polynomial"}
    motion = made({"to": 120, "lift": 10, **keys, "end_velocity": -30.0}, {"to": 360, "lift": 0, **keys})
    for stroke in motion.strokes:
        inside = np.linspace(stroke.start, stroke.end, 60)[1:-1]
        assert np.all(np.sign(motion.evaluate(inside, 1)[1]) == stroke.sense)
    assert motion.strokes[0].end < math.radians(120.0)


@pytest.mark.slow
def test_a_servo_table_errs_as_much_between_its_rows_as_close_places_show() -> None:
    motion = made({"to": 100, "lift": 20}, {"to": 160}, {"to": 360, "lift": 0, "law": "simple-harmonic"})
    for rows in (25, 73):
        close = np.abs(deviation(motion, rows, np.linspace(1e-9, 6.28318, 200_001))).max()
        assert greatest_error(motion, rows) == pytest.approx(close, rel=1e-6)
    rows = rows_for(motion, 1e-3, rocks=False)
    assert greatest_error(motion, rows) <= 1e-3


class Bump:
    """(x (b - x))^3 on one of equal intervals and 0 elsewhere: the quintics between the rows know nothing of it."""

    joints = ()

    def __init__(self, interval: int, count: int) -> None:
        self.start, self.width = 2.0 * math.pi * interval / count, 2.0 * math.pi / count

    def evaluate(self, phi: Any, order: int = 3, **_side: int) -> list[Any]:
        x = np.clip((phi - self.start) / self.width, 0.0, 1.0)
        cube = np.polynomial.Polynomial([0.0, 1.0, -1.0]) ** 3
        return [self.width ** (6 - n) * cube.deriv(n)(x) if n else self.width**6 * cube(x) for n in range(order + 1)]


@pytest.mark.quick(2)
@pytest.mark.parametrize(("interval", "count"), [(0, 8), (3, 8), (7, 8), (2, 3600), (1802, 3600)])
def test_a_servo_table_errs_by_what_lies_between_two_rows(interval: int, count: int) -> None:
    """(b/2)^6 in the middle, also where 2048 points about the turn leave the interval out."""
    motion = Bump(interval, count)
    assert greatest_error(motion, count + 1) == pytest.approx((math.pi / count) ** 6, rel=1e-6)
    places = (np.arange(count) + 0.5) * 2.0 * math.pi / count
    found = np.abs(deviation(motion, count + 1, places)) > 1e-9 * (math.pi / count) ** 6  # rounding of a row beside it
    assert np.flatnonzero(found).tolist() == [interval]


class Waves:
    """sin(n phi): at 0.1 deg of the master a row stands every quarter of a wave."""

    joints, count = (), 900

    def evaluate(self, phi: Any, order: int = 3, **_side: int) -> list[Any]:
        return [self.count**n * np.sin(self.count * phi + 0.5 * n * math.pi) for n in range(order + 1)]


@pytest.mark.parametrize(("rocks", "unit"), [(False, "mm"), (True, "deg")])
def test_a_tolerance_that_no_step_meets_names_one_that_a_step_meets(rocks: bool, unit: str) -> None:
    """It was called too small in rad, and to be increased by an unknown amount."""
    with pytest.raises(NoSolution, match=rf"\(limit <= 1e-06 {unit}\)") as refused:
        rows_for(Waves(), 1e-6, rocks=rocks)
    assert rows_for(Waves(), float(refused.value.fix.removeprefix("set servo.tolerance to ")), rocks=rocks) == 3601


# Laws with given ends


def test_ends_that_join_and_ends_in_the_units_of_the_file() -> None:
    motion = made(
        {"to": 60, "lift": 10, "law": "half-cycloidal"},
        {
            "to": 100,
            "lift": 25,
            "law": {"type": "polynomial", "start": "join", "end": {"speed": 30.0, "acceleration": -8.0}},
        },
        {"to": 150, "lift": 40, "law": {"type": "harmonic", "start": "join"}},
        {"to": 200},
        {"to": 280, "lift": 15, "law": {"type": "polynomial", "end": [1, 0.4, 0]}},
        {"to": 360, "lift": 0, "law": {"type": "polynomial", "start": "join", "end": "join"}},
    )
    holds_derivatives(motion)
    for order in (0, 1, 2):
        steps = [jump for _, jump in motion.steps(order)]
        assert steps == pytest.approx([0.0] * len(steps), abs=1e-11 * 10.0**order)
    at = motion.evaluate(np.radians([100.0]), 2, side=-1)
    assert [float(each[0]) for each in at] == pytest.approx([25.0, 30.0, -8.0], rel=1e-12)
    assert float(motion.evaluate(np.radians([280.0]), 1)[1][0]) == pytest.approx(
        -0.4 * 25.0 / math.radians(80.0), rel=1e-12
    )


def test_a_polynomial_takes_the_end_of_a_law_that_joins_at_its_other_end() -> None:
    """Without the law's own end values the lift had a step of its velocity."""
    joined = {"type": "polynomial", "start": "join", "end": {"speed": 5.0, "acceleration": 3.0}}
    motion = made(
        {"to": 60},
        {"to": 100, "lift": 36, "law": joined},
        {"to": 260, "lift": -17, "law": "polynomial"},
        {"to": 360, "lift": 0},
    )
    at = motion.evaluate(np.radians([100.0]), 2)
    assert [float(each[0]) for each in at] == pytest.approx([36.0, 5.0, 3.0], rel=1e-12)
    for order in (1, 2):
        assert max(abs(step) for _, step in motion.steps(order)) < 1e-9


def test_a_law_that_turns_round_is_divided_there() -> None:
    steep = {"type": "polynomial", "start": [0, -1.5, 0], "end": [1, 0, 0]}
    motion = made({"to": 90}, {"to": 180, "lift": 10, "law": steep}, {"to": 360, "lift": 0})
    senses = [stroke.sense for stroke in motion.strokes]
    assert senses == [0, -1, 1, -1]
    turn = motion.strokes[1].end
    assert float(motion.evaluate(np.array([turn]), 1)[1][0]) == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize(
    ("segments", "key"),
    [
        (
            [
                {"to": 90, "lift": 9, "law": {"type": "polynomial", "start": "join"}},
                {"to": 360, "lift": 0, "law": {"type": "polynomial", "end": "join"}},
            ],
            "motion[0].law.start",
        ),
        (
            [{"to": 90, "lift": 9, "law": {"type": "optimal", "minimize": "jerk", "acceleration": 3.0}}],
            "motion[0].law.acceleration",
        ),
        ([{"to": 90, "lift": 9, "law": {"type": "polydyne", "frequency": 20}}], "motion[0].law.frequency"),
        ([{"to": 90, "lift": 9, "law": {"type": "polynomial", "end": [0, 1, 0]}}], "motion[0].law"),
    ],
    ids=["join", "limit", "frequency", "no rise"],
)
def test_a_law_that_cannot_be_is_refused_at_its_key(segments: list[dict[str, Any]], key: str) -> None:
    with pytest.raises(NoSolution) as caught:
        made(*segments, *([{"to": 360, "lift": 0}] if segments[-1]["to"] != 360 else []))
    assert caught.value.key == key


def test_a_table_of_segments_has_no_rounding_noise() -> None:
    """160 deg as in the file, and 0 where a rise begins: neither 119.99999999999999 nor 1e-30."""
    motion = [{"to": 120, "lift": 20, "law": "modified-sine"}, {"to": 160}, {"to": 280.1, "lift": 0}, {"to": 360}]
    table = factory.design("loaded_cam", motion=motion).table("segments")
    assert [str(end) for end in table["end"]] == ["120.0", "160.0", "280.1", "360.0"]
    least = np.abs([table[name] for name in ("velocity_max", "velocity_min")])
    assert not least[(least > 0.0) & (least < 1e-12)].size
