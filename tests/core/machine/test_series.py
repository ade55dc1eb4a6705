"""Members over the machine angle: the chain rule against differences at 30 digits, runs and events against tables."""

from __future__ import annotations

import math
from typing import Any

import mpmath
import numpy as np
import pytest
from machines import FEED, GRIPPER, ROCKER, SWUNG, cam, machine, of

from gearlink.cli.opening import design
from gearlink.core.base.errors import GearlinkError

CRANK = {"kind": "slider-crank", "stroke": 60, "rod": 120}


def four_bar(crank: Any, links: tuple[float, ...]) -> Any:
    """Direction of the rocker by the cosine law, C to the left of B -> D."""
    a, b, c, d = (mpmath.mpf(each) for each in links)
    way = d - a * mpmath.expj(crank)
    far = abs(way)
    return mpmath.arg(way) - mpmath.acos((far**2 + c**2 - b**2) / (2 * far * c)) + mpmath.pi


@pytest.mark.parametrize("degrees", [0.0, 77.0, 203.0, 331.0])
@pytest.mark.parametrize("ratio", [1.0, -1.0])
def test_a_row_of_three_by_the_chain_rule_up_to_jerk(degrees: float, ratio: float) -> None:
    """A crank-rocker swings a second one, whose output turns a gear: 30 digits, derivatives by differences of 1e-7."""
    members = {
        "first": of(ROCKER, phase=30, ratio=ratio),
        "second": of(SWUNG, input="first.output", phase=60),
        "third": of(
            {"kind": "gear-pair", "teeth": [20, 40], "module": 2, "center_distance": 60},
            input="second.output",
            ratio=-2,
        ),
    }
    found = machine(members)
    angle = math.radians(degrees - 30.0)
    with mpmath.workdps(30):

        def whole(x: Any) -> Any:
            first = four_bar(mpmath.mpf(ratio) * x, (40, 110, 80, 120))
            second = four_bar(first - mpmath.radians(60), (60, 90, 80, 100))
            return second * (-2) * mpmath.mpf(-1) / 2

        want = [float(mpmath.diff(whole, mpmath.mpf(angle), n, h=mpmath.mpf(10) ** -7)) for n in range(4)]
    got = [float(each[0]) for each in found.members["third"].rates(np.array([angle]), 3)]
    # differences of order 3 at 30 digits with steps of 1e-7 leave 1e-9, those of the motion itself 1e-12
    assert got[1:] == pytest.approx(want[1:], rel=1e-7, abs=1e-8)
    assert math.remainder(got[0] - want[0], 2.0 * math.pi) == pytest.approx(0.0, abs=1e-10)


PAIRS = {
    "disc-cam": cam(FEED),
    "crank-rocker": ROCKER,
    "slider-crank": CRANK,
    "gear-pair": {"kind": "gear-pair", "teeth": [20, 40], "module": 2, "center_distance": 60},
}


@pytest.mark.quick(5)
@pytest.mark.parametrize("driver", list(PAIRS))
@pytest.mark.parametrize("driven", list(PAIRS))
def test_every_pair_of_kinds_against_differences(driver: str, driven: str) -> None:
    slides = driver in ("disc-cam", "slider-crank")
    members = {
        "one": of(PAIRS[driver], phase=15),
        "two": of(PAIRS[driven], input="one.output", phase=-50, ratio=2.0 if slides else 1.0),
    }
    two = machine(members).members["two"]
    angle, h = np.radians([40.0, 73.0, 250.0]), 1e-5
    got = two.rates(angle, 2)
    for order in (1, 2):
        below, above = (two.rates(angle + sign * h, order - 1)[order - 1] for sign in (-1.0, 1.0))
        # central differences: h^2/6 of the third derivative and the rounding of values over h
        scale = max(1.0, float(np.abs(got[order]).max()))
        np.testing.assert_allclose(got[order], (above - below) / (2.0 * h), rtol=0.0, atol=1e-7 * scale)


def test_a_rate_that_jumps_is_taken_on_the_side_to_which_the_member_goes() -> None:
    """At 90 deg of its own cam a parabola ends: run backwards, what comes just after is what comes just before."""
    motion = [{"to": 90, "lift": 20, "law": "simple-harmonic"}, {"to": 180}, {"to": 360, "lift": 0}]
    data = {**cam(FEED), "motion": motion}
    forth, back = machine({"m": of(data)}).members["m"], machine({"m": of(data, ratio=-1)}).members["m"]
    at = np.radians([90.0])
    peak = -20.0 / 2.0 * 4.0  # h/2 (pi/b)^2 of a harmonic at its end, b = pi/2
    assert forth.rates(at, 2)[2][0] == 0.0
    assert forth.rates(at, 2, side=-1)[2][0] == pytest.approx(peak, rel=1e-12)
    assert back.rates(-at, 2)[2][0] == pytest.approx(peak, rel=1e-12)
    assert back.rates(-at, 2, side=-1)[2][0] == 0.0


def test_runs_of_a_member_at_twice_the_speed_and_backwards() -> None:
    runs = machine({"m": of(cam(FEED), phase=20, ratio=2)}).table("timing")
    assert [(a, b) for a, b in zip(runs["motion"], runs["start"], strict=True)] == [
        ("rise", 20.0), ("dwell", 65.0), ("return", 105.0), ("dwell", 165.0),
        ("rise", 200.0), ("dwell", 245.0), ("return", 285.0), ("dwell", 345.0),
    ]  # fmt: skip
    back = machine({"m": of(cam(FEED), phase=20, ratio=-1)}).table("timing")
    rows = {(a, b, c) for a, b, c in zip(back["motion"], back["start"], back["end"], strict=True)}
    assert rows == {("dwell", 20.0, 90.0), ("rise", 90.0, 210.0), ("dwell", 210.0, 290.0), ("return", 290.0, 20.0)}


def test_events_stand_where_the_table_says() -> None:
    members = {"feed": of(cam(FEED), phase=20), "arm": of(ROCKER, phase=7)}
    events = {"half": {"of": "feed", "output": 30, "on": "return"}, "up": {"of": "arm", "output": 120}}
    found = machine(
        members, events=events, require=["half before feed.velocity_minimum by -1", "up before arm.maximum"]
    )
    timing, phases = found.timing, found.phases
    for name, of_member, value in (("half", "feed", 30.0), ("up", "arm", 120.0)):
        angle = timing.angle(found.spec.relations[0].one._replace(what=name), phases)  # type: ignore[union-attr]
        assert timing.value(of_member, "position", angle, phases) == pytest.approx(value, abs=1e-9)
    fastest = timing.angle(found.spec.relations[0].two, phases)  # type: ignore[union-attr]
    rows = found.table("motion", samples=3600)
    assert timing.value("feed", "velocity", fastest, phases) <= rows["feed.velocity"].min() + 1e-9
    assert fastest == pytest.approx(250.0, abs=1e-4)  # an extreme is flat: the root of rounding
    dead = timing.angle(found.spec.relations[1].two, phases)  # type: ignore[union-attr]
    assert timing.value("arm", "velocity", dead, phases) == pytest.approx(0.0, abs=1e-10)


def test_value_relations_have_margins_in_their_own_unit() -> None:
    members = {"feed": of(cam(FEED), phase=20)}
    found = machine(members, require=["feed.velocity at 65 <= 60", "feed.position at feed.rise_end >= 60"])
    (fast, top) = found.check("timing-relation")
    assert found.least_margin is None
    speed = found.table("motion")["feed.velocity"][65]
    assert fast.status == "fail"
    assert fast.value == pytest.approx(60.0 - speed, abs=1e-9)
    assert fast.unit == "mm/rad"
    assert (top.status, top.unit) == ("pass", "mm")


@pytest.mark.parametrize(
    ("change", "key"),
    [
        ({"require": ["gripper.rise_end before fed.rise_start"]}, "require[0]"),
        ({"require": ["feed.rise_and before gripper.rise_start"]}, "require[0]"),
        ({"require": ["feed.dwell[3]_start before gripper.rise_start"]}, "require[0]"),
        ({"require": ["feed rises before gripper"]}, "require[0]"),
        ({"events": {"feed": {"of": "gripper", "output": 3}}}, "events.feed"),
        (
            {"events": {"x": {"of": "gripper", "output": 30}}, "require": ["x before feed.rise_start"]},
            "events.x.output",
        ),
    ],
)
def test_what_is_not_there_is_refused_at_its_key(change: dict[str, Any], key: str) -> None:
    members = {"feed": of(cam(FEED), phase=20), "gripper": of(cam(GRIPPER))}
    with pytest.raises(GearlinkError) as wrong:
        machine(members, **change).report("analyze")
    assert wrong.value.key == key


def test_members_in_a_circle_and_wrong_members_are_refused_at_their_key() -> None:
    for members, key in (
        ({"a": of(cam(FEED), input="b.output"), "b": of(cam(FEED), input="a.output")}, "members.a.input"),
        ({"a": of(cam(FEED), input="c.output")}, "members.a.input"),
        ({"a": of(cam(FEED), input="a.output")}, "members.a.input"),
        ({"a": of(cam(FEED), ratio=math.sqrt(2.0))}, "members.a.ratio"),
        ({"a": of(SWUNG)}, "members.a.input"),
        ({"a": of({**cam(FEED), "closure": "rope"})}, "members.a.design.closure"),
    ):
        with pytest.raises(GearlinkError) as wrong:
            machine(members).report("analyze")
        assert wrong.value.key == key


@pytest.mark.parametrize("quantity", ["a.prime_radius", "second.crank_length"])
def test_a_quantity_of_one_member_names_the_other_that_is_wrong(quantity: str) -> None:
    """It was `members.a.design.members.second.design.links`, the key in the section of who asked."""
    wrong = {**ROCKER, "links": {"crank": 90, "coupler": 110, "rocker": 80, "frame": 120}}
    found = machine({"a": of(cam(FEED)), "second": of(wrong)})
    for ask in (found.quantity, found.raw):
        with pytest.raises(GearlinkError) as refused:
            ask(quantity)
        assert refused.value.key == "members.second.design.links"


def test_a_driver_that_swings_beyond_the_range_is_refused_before_any_table() -> None:
    """Of the rocker's whole swing, at the range of the driven crank; a range that holds all of it is taken."""
    narrow = {**SWUNG, "range": [50, 60]}
    with pytest.raises(GearlinkError) as refused:
        _ = machine({"first": of(ROCKER), "second": of(narrow, input="first.output", phase=60)}).cycle_turns
    assert refused.value.key == "members.second.range"
    assert machine({"first": of(ROCKER), "second": of(SWUNG, input="first.output", phase=60)}).cycle_turns == 1


def test_the_table_of_a_drive_in_place_of_a_member() -> None:
    """Over the machine angle, ratio and phase in it; as exact between rows as that of the cam alone."""
    members = {"feed": of(cam(FEED), phase=20), "arm": of(ROCKER, phase=7, ratio=-2)}
    found = machine(members, servo={"member": "feed", "rows": 73})
    alone = design("cam", **cam(FEED), servo={"rows": 73})
    table, own = found.table("servo"), alone.table("servo")
    for name in ("slave_position", "slave_velocity", "slave_acceleration", "slave_jerk"):  # 20 deg are 4 rows of 5
        np.testing.assert_allclose(np.roll(table[name][:-1], -4), own[name][:-1], rtol=0.0, atol=1e-10)
    assert found.servo_error == pytest.approx(alone.quantity("servo_error").value, rel=1e-6)
    swung = machine(members, servo={"member": "arm", "tolerance": 0.001})
    rows, error = swung.quantity("servo_rows"), swung.quantity("servo_error")
    assert rows is not None
    assert error is not None
    assert (error.unit, swung.table("servo").units[1]) == ("deg", "deg")
    assert 0.0 < float(error.value) <= 0.001  # type: ignore[arg-type]
    with pytest.raises(GearlinkError) as wrong:
        machine({**members, "arm": of(ROCKER, ratio=0.5)}, servo={"member": "arm", "rows": 73}).report("analyze")
    assert wrong.value.key == "servo.member"
