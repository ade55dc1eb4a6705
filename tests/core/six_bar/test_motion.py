"""The geared six-bar: closed form against Newton's steps, rates against 40 digits, its course against small steps.

Tolerances: positions and rates to some ulp of a turn times the condition 1/sin(mu) of the loop, squared for each order
of a rate; 40-digit values come from the loop and the trains' rolling alone.
"""

from __future__ import annotations

import math
from itertools import combinations, pairwise
from typing import Any

import mpmath
import numpy as np
import pytest
from factory import changed, design, worked
from hypothesis import given
from hypothesis import strategies as st
from sweeps import examples, mostly_slow, spread

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.remedies.trials import BUDGET
from gearlink.core.machines.six_bar import loop
from gearlink.core.machines.six_bar.loop import Course, Follower, SixBar, reduced, train_relation
from gearlink.core.machines.six_bar.mechanism import pins
from gearlink.core.machines.six_bar.spec import GearedSixBarSpec, SixStart
from gearlink.core.mechanism.follow import onwards

EPS = 2.0**-52
CLOSED, FOLLOWED = "geared_six_bar", "six_bar_swing"
TURNS = np.radians(np.arange(0.0, 360.0, 7.0))
MANY_TURNS = [
    {"pins": ["E", "F", "A"], "module": 2, "gears": [20, 30, 4]},
    {"pins": ["A", "B"], "module": 2, "gears": [20, 20]},
]
OPEN = {"coupler_1": 240, "output": -60}


def gap(bar: SixBar, phi: Any, angles: Any) -> Any:
    """What the loop lacks to close, the links one after the other [mm]."""
    directions = np.vstack([phi, angles])
    return sum(a * np.exp(1j * t) for a, t in zip(bar.lengths[1:], directions, strict=True)) - bar.lengths[0]


def six_bar(name: str, **keys: Any) -> Any:
    return design(name, **keys)


@pytest.mark.parametrize("name", [CLOSED, FOLLOWED])
def test_the_loop_closes_and_its_gears_roll(name: str) -> None:
    machine = six_bar(name)
    phi = np.append(TURNS, 2.0 * math.pi)
    angles = machine.course.angles(phi)
    size = sum(machine.lengths)
    assert np.abs(gap(machine.bar, phi, angles)).max() < 8.0 * EPS * size
    links = np.vstack([np.full(phi.shape, math.pi), phi, angles])
    for train in machine.spec.trains:
        gear = links[train.first_pin]
        for k, (one, other) in enumerate(pairwise(train.gears), start=1):
            carrier = links[(train.first_pin + k) % 6]
            # Willis: what gear 1 rolls against the carrier, gear 2 rolls back, tooth by tooth.
            gear = carrier - one / other * (gear - carrier)
        turned = gear - links[(train.first_pin + len(train.gears)) % 6]
        assert np.ptp(turned) < 200.0 * EPS * max(1.0, float(np.abs(links).max()))


def test_closed_form_and_newton_agree() -> None:
    machine = six_bar(CLOSED)
    bar = machine.bar
    assert bar.is_closed_form
    angles = machine.course.angles(TURNS)
    near = angles[[j - 2 for j in bar.free]] - bar.numbers[1][[j - 2 for j in bar.free]][:, None]
    newton = bar._by_newton(TURNS, near + 1e-3)
    condition = 1.0 / np.sin(bar.transmission(angles))
    assert (np.abs(newton - angles).max(axis=0) < 60.0 * EPS * condition).all()


def test_no_bit_of_a_place_depends_on_the_others() -> None:
    """Tables are made a part at a time: BLAS rounds the last columns of a product otherwise than those before."""
    machine = six_bar(CLOSED)
    phi = np.linspace(0.0, 2.0 * math.pi, 112)[:-1]
    angles = machine.course.angles(phi)
    whole = np.vstack(machine.bar.rates(phi, angles))
    for part in (slice(start, start + 43) for start in range(0, phi.size, 43)):
        assert (np.vstack(machine.bar.rates(phi[part], angles[:, part])) == whole[:, part]).all()


def test_transmission_is_the_acute_angle_of_the_dyad() -> None:
    """By the cosine rule of its triangle; beyond a right angle it falls again, down to 0 in a dead centre."""
    machine = six_bar(CLOSED)
    bar = machine.bar
    angles = machine.course.angles(TURNS)
    one, other = (j - 2 for j in bar.free)
    links = bar.numbers[0][:, None] * np.exp(1j * angles)
    b, c = bar.lengths[one + 2], bar.lengths[other + 2]
    chord = np.abs(links[one] + links[other])
    between = np.arccos((b * b + c * c - chord * chord) / (2.0 * b * c))
    found = bar.transmission(angles)
    assert found == pytest.approx(np.minimum(between, math.pi - between), abs=1e-13)
    turned = angles.copy()
    turned[other] = angles[one] + math.radians(140.0)
    assert bar.transmission(turned) == pytest.approx(np.full(TURNS.shape, math.radians(40.0)), abs=1e-13)


@pytest.mark.parametrize("name", mostly_slow([CLOSED, FOLLOWED], 1))
def test_rates_against_forty_digits(name: str) -> None:
    machine = six_bar(name)
    bar = machine.bar
    for phi in spread((0.7, 2.9, 5.1), 1):
        found = np.array(machine.course.rates(np.array([phi])))[:, :, 0]
        wanted = taylor(bar, phi, found[0])
        condition = 1.0 / math.sin(float(bar.transmission(found[0][:, None])[0]))
        for order in range(4):
            scale = max(1.0, float(np.abs(wanted[order]).max())) * condition ** (order + 1)
            assert np.abs(found[order] - wanted[order]).max() < 300.0 * EPS * scale, (phi, order)


def taylor(bar: SixBar, phi: float, near: Any) -> Any:
    """Directions and three derivatives at 40 digits: the loop and the relations solved, then differences of order 4."""
    with mpmath.workdps(40):
        rows = [[mpmath.mpf(r.numerator) / r.denominator for r in row] for row in bar.relations]
        start = polished(bar, rows, mpmath.mpf(0), bar.start_angles, None)
        ties = [sum(r * t for r, t in zip(row[2:], start, strict=True)) for row in rows]
        step = mpmath.mpf(10) ** -6
        places = [polished(bar, rows, mpmath.mpf(phi) + k * step, near, ties) for k in range(-3, 4)]
        weights = (
            (0, 0, 0, 1, 0, 0, 0),
            tuple(mpmath.mpf(w) / 60 for w in (-1, 9, -45, 0, 45, -9, 1)),
            tuple(mpmath.mpf(w) / 180 for w in (2, -27, 270, -490, 270, -27, 2)),
            tuple(mpmath.mpf(w) / 8 for w in (1, -8, 13, 0, -13, 8, -1)),
        )
        return np.array(
            [
                [float(sum(w * p[j] for w, p in zip(row, places, strict=True)) / step**order) for j in range(4)]
                for order, row in enumerate(weights)
            ]
        )


def polished(bar: SixBar, rows: Any, phi: Any, near: Any, ties: Any) -> list[Any]:
    """The four directions that close the loop and keep the trains' relations; at the start two given ones instead."""
    a, d, lengths = mpmath.mpf(bar.lengths[1]), mpmath.mpf(bar.lengths[0]), bar.lengths[2:]

    def unit(angle: Any) -> Any:
        return mpmath.mpc(mpmath.cos(angle), mpmath.sin(angle))

    def lacking(*angles: Any) -> list[Any]:
        reach = a * unit(phi) + sum(length * unit(t) for length, t in zip(lengths, angles, strict=True)) - d
        if ties is None:
            kept = [angles[j - 2] - mpmath.mpf(angle) for j, angle in bar.start.items()]
        else:
            sums = (row[1] * phi + sum(r * t for r, t in zip(row[2:], angles, strict=True)) for row in rows)
            kept = [total - tie for total, tie in zip(sums, ties, strict=True)]
        return [reach.real, reach.imag, *kept]

    found = mpmath.findroot(lacking, [mpmath.mpf(float(t)) for t in near], tol=mpmath.mpf(10) ** -70)
    return list(found)


@pytest.mark.slow
def test_a_place_costs_few_steps_and_rests_by_itself(monkeypatch: pytest.MonkeyPatch) -> None:
    """Over fifty turns: some four steps a place, and the standstills of all turns in the calls of one."""
    links = {"coupler_1": 180, "coupler_2": 180, "coupler_3": 180}
    trains = [MANY_TURNS[0] | {"gears": [20, 30, 40]}, MANY_TURNS[1] | {"gears": [22, 20]}]
    machine = six_bar(FOLLOWED, links=links, trains=trains, start=OPEN, assembly=1)
    course, asked = machine.course, list[int]()
    assert course.period_turns == 50
    plain = loop.turned
    monkeypatch.setattr(loop, "turned", lambda angles: asked.append(angles.size) or plain(angles))
    angles = course.angles(course.grid)
    assert sum(asked) < 4.0 * 4.5 * course.grid.size
    few = np.linspace(0, course.grid.size - 1, 5000).astype(int)
    assert np.abs(course.angles(course.grid[few]) - angles[:, few]).max() < 2.0 * EPS * np.abs(angles).max()
    _ = machine.speed_turnings
    asked.clear()
    assert len(machine.dwell_crank_angles) == 206
    assert len(asked) < 200  # one after the other, 206 places took ten thousand


@pytest.mark.slow
def test_the_course_is_that_of_small_steps() -> None:
    """Half a degree at a time, Newton's steps from the place before: no closing is changed."""
    bar = six_bar(FOLLOWED).bar
    free = [j - 2 for j in bar.free]
    u, found = np.zeros((2, 1)), []
    for phi in np.radians(np.arange(0.0, 360.0, 0.5)):
        angles = bar.closed(np.array([phi]), u)
        u = angles[free] - bar.numbers[1][free][:, None]
        found.append(angles[:, 0])
    course = Course(bar, None)
    straight = course.angles(np.radians(np.arange(0.0, 360.0, 0.5)))
    assert np.abs(np.array(found).T - straight).max() < 1e-12


def test_periods_and_ranges() -> None:
    trains = [{"pins": ["A", "B"], "module": 1.5, "gears": [20, 40]}, worked(FOLLOWED)["trains"][1]]
    machine = six_bar(FOLLOWED, trains=trains, links__coupler_1=10, links__coupler_2=170)
    assert machine.period_turns == 2
    phi = np.array([0.3, 0.3 + 4.0 * math.pi, 0.3 - 4.0 * math.pi])
    pinned = np.vstack(pins(machine, phi))
    assert np.ptp(pinned.real, axis=1).max() < 1e-11
    part = six_bar(FOLLOWED, range={"start": -40, "end": 75})
    whole = six_bar(FOLLOWED)
    at = np.radians([-40.0, -3.0, 0.0, 20.0, 75.0])
    assert np.abs(part.output(at) - whole.output(at)).max() < 1e-13
    assert part.period_turns is None
    assert part.mean_ratio is None
    assert part.table("motion").data[0][0] == -40.0
    assert part.table("motion").data[0][-1] == 75.0


def test_extremes_against_a_dense_grid() -> None:
    machine = six_bar(CLOSED)
    phi = np.linspace(0.0, 2.0 * math.pi, 20001)
    angles, speed, acceleration, _ = machine.course.rates(phi)
    for values, name in ((speed[3], "speed_ratio"), (acceleration[3], "acceleration_ratio")):
        for side, pick in (("max", np.max), ("min", np.min)):
            most = float(pick(values))
            assert abs(getattr(machine, f"{name}_{side}") - most) < 1e-6
            place = np.array([getattr(machine, f"{name}_{side}_at")])
            there = machine.rate(1 if name == "speed_ratio" else 2)(place)[0]  # an array of one: other rounding
            assert there == pytest.approx(getattr(machine, f"{name}_{side}"), rel=8.0 * EPS)
    signs = int((np.sign(speed[3][1:]) != np.sign(speed[3][:-1])).sum())
    assert len(machine.dwell_crank_angles) == signs == 4
    assert np.abs(machine.rate(1)(np.array(machine.dwell_crank_angles))).max() < 1e-14
    output = machine.output(phi)
    assert abs(machine.output_swing - (output.max() - output.min())) < 1e-6
    assert abs(machine.min_transmission_angle - machine.bar.transmission(angles).min()) < 1e-6


def test_a_dead_centre_is_told_with_the_range_that_is_free() -> None:
    with pytest.raises(NoSolution, match=r"dead centre at input angle .* set range.start to") as refused:
        _ = six_bar(FOLLOWED, links__coupler_2=90.0).period_turns
    words = refused.value.fix.removeprefix("set range.start to ").split(" deg")[0]
    low, high = (float(word) for word in words.split(" and range.end to "))
    for off in (0.0, 0.01):  # as they are printed, the bounds are free as well
        inside = six_bar(FOLLOWED, links__coupler_2=90.0, range={"start": low + off, "end": high - off})
        assert inside.min_transmission_angle < math.radians(2.0)
    beyond = six_bar(FOLLOWED, links__coupler_2=90.0, range={"start": low + 0.01, "end": high + 0.01})
    with pytest.raises(NoSolution, match="dead centre"):
        _ = beyond.course.angles(np.zeros(1))


@given(
    st.tuples(*[st.floats(20.0, 100.0)] * 5),
    st.sampled_from([(0, 1), (0, 4), (1, 3), (2, 4), (3, 5), (1, 2), (2, 3), (0, 5), (4, 5), (0, 3)]),
    st.floats(-3.0, 3.0),
    st.floats(-3.0, 3.0),
    st.sampled_from([1, -1]),
)
@examples(25)
def test_any_two_trains(lengths: Any, first: Any, one: float, other: float, assembly: int) -> None:
    """Wherever the trains sit, a course that is found closes, and it runs on smoothly."""
    rows = train_relation(first[0], (20, 30)), train_relation(first[1], (36, 24))
    try:
        bar = SixBar((150.0, *lengths), rows, {2: one, 4: other}, assembly)
        course = Course(bar, (-0.05, 0.05))
        phi = np.linspace(-0.05, 0.05, 11)
        angles, speed, _, _ = course.rates(phi)
    except NoSolution:
        return
    assert np.abs(gap(bar, phi, angles)).max() < 1e-11
    assert np.isfinite(speed).all()
    assert np.abs(angles[:, 5] - bar.start_angles).max() < 1e-9


def test_trains_that_tie_the_same_are_refused() -> None:
    with pytest.raises(NoSolution, match="couple the same"):
        reduced([train_relation(1, (20, 30)), train_relation(1, (40, 60))])
    assert sum(train_relation(2, (20, -55, 31))) == 0


def test_a_ring_and_a_train_of_three() -> None:
    """A ring turns the same way; a train over two links has the rates of its two meshes in turn."""
    ring = train_relation(0, (-60, 20))
    assert [str(r) for r in ring[:3]] == ["3", "-2", "-1"]
    long, (one, other) = train_relation(0, (20, 30, 20)), (20 / 30, 30 / 20)
    links = np.array([0.0, 1.0, 0.4, 0.0, 0.0, 0.0])
    middle = links[1] - one * (links[0] - links[1])
    links[3] = links[2] - other * (middle - links[2])
    assert abs(sum(float(r) * w for r, w in zip(long, links, strict=True))) < 1e-15


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"links__input": 31}, "its gears' centre distance is 30"),
        ({"links__frame": None}, "no train fixes the length of frame"),
        ({"links__coupler_2": 1000}, "the difference of the two links"),
    ],
)
def test_refusals(keys: Any, message: str) -> None:
    with pytest.raises(NoSolution, match=message):
        _ = six_bar(FOLLOWED, **keys).bar


def test_gears_of_one_plane_are_judged() -> None:
    apart = six_bar(FOLLOWED)
    near = six_bar(FOLLOWED, links__frame=110.0, start__output=90.0)
    assert apart.gear_gap is not None
    assert all(check.status == "pass" for check in apart.check("gear-collision"))
    phi = np.linspace(0.0, 2.0 * math.pi, 4001)
    placed = np.vstack(pins(apart, phi))
    tips = 0.5 * 1.5 * 20 + 1.5 + 0.5 * 3 * 20 + 3
    assert abs(apart.gear_gap - (np.abs(placed[1] - placed[4]).min() - tips)) < 1e-4
    assert near.lengths[0] == 110.0
    assert changed(worked(CLOSED))["kind"] == "geared-six-bar"
    assert six_bar(CLOSED).gear_gap is None  # trains that share the pin B lie in planes of their own


@pytest.mark.slow
def test_a_motion_of_many_turns_is_not_followed_for_seconds_to_find_a_remedy() -> None:
    """By counts, which do not depend on the machine: places that were followed, 25 at the cost of half a design."""
    machine = six_bar(
        FOLLOWED, trains=MANY_TURNS, links={"coupler_1": 180, "coupler_2": 180, "coupler_3": 180}, start=OPEN
    )
    assert machine.period_turns == 25
    failing = [found for name in machine.outlines["analyze"].checks for found in machine.findings("analyze", name)]
    failing = [found for found in failing if found.status == "fail"]
    trials = [trial for trial in machine.bench("analyze")._trials.values() if trial is not None]
    longest = max(trial.cost for trial in trials)
    assert longest > 5
    assert sum(trial.cost for trial in trials) <= len(failing) * (BUDGET + longest)


@pytest.mark.parametrize("name", [CLOSED, FOLLOWED])
def test_one_place_after_the_other_against_arrays(name: str) -> None:
    """Places and rates by Python's numbers against the loop's own over arrays, by the dyad where it has one."""
    bar = six_bar(name).bar
    follower = Follower(bar)
    places = list(onwards(follower, follower.place(0.0, (0.0, 0.0)), 2.0 * math.pi))  # type: ignore[arg-type]
    phi, u = np.array([place.q for place in places]), np.array([place.u for place in places]).T
    angles = bar.closed(phi, u + 1e-4)
    free = [j - 2 for j in bar.free]
    condition = 1.0 / np.sin(bar.transmission(angles))
    assert (np.abs(angles[free] - bar.numbers[1][free][:, None] - u).max(axis=0) < 60.0 * EPS * condition).all()
    rates = np.array([place.rates for place in places]).T
    assert (np.abs(bar.rates(phi, angles)[0][free] - rates).max(axis=0) < 100.0 * EPS * condition**2).all()


def test_the_certain_step_is_that_of_the_least_singular_value() -> None:
    bar = six_bar(FOLLOWED).bar
    place = Follower(bar).place(0.0, (0.0, 0.0))
    assert place is not None
    length, first, _, shares = bar.numbers
    one, other = shares.T @ (1j * length * np.exp(1j * first))
    beta = 1.0 / np.linalg.svd(np.array([[one.real, other.real], [one.imag, other.imag]]))[1][-1]
    turned = bar.rates(np.zeros(1), first[:, None])[0][:, 0]
    size = np.linalg.norm(shares, axis=1)
    k, k_rate = length @ size**2, length @ (size * np.abs(turned))
    reach = 1.0 / (beta * (math.sqrt(k * (length @ turned**2 + bar.lengths[1])) + k_rate))
    assert place.reach == pytest.approx(reach, rel=1e-13)


@pytest.mark.parametrize("assembly", [1, -1])
@pytest.mark.parametrize("left_out", list(combinations(("coupler_1", "coupler_2", "coupler_3", "output"), 2)))
def test_the_words_of_assembly_are_those_of_the_linkage(left_out: tuple[str, str], assembly: int) -> None:
    """Taken on the way from A to F, +1 has the first of the two closing links to the left of the second.

    `start` counts the output the other way, F->E, by which words the sides of half of these pairs would be exchanged.
    """
    names = ("coupler_1", "coupler_2", "coupler_3", "output")
    known = dict(zip(names, np.degrees(six_bar(FOLLOWED).start_directions).tolist(), strict=True))
    start = {name: angle for name, angle in known.items() if name not in left_out}
    found = six_bar(FOLLOWED, start=start, assembly=assembly)
    ahead = dict(zip(names, found.start_directions, strict=True))
    ahead["output"] += math.pi  # E->F
    first, second = (ahead[name] for name in left_out)
    assert math.copysign(1.0, math.sin(first - second)) == assembly
    words = GearedSixBarSpec.model_fields["assembly"].description or ""
    assert "both directed from A to F (the output E->F" in words
    assert "the first points to the left of the second; -1: to the right" in words
    assert SixStart.model_fields["output"].description == "direction F->E"
