"""Standstills, back-step and dwell angle.

Tolerances: 1e-13 rad for simple standstills well apart (a few ulp over the slope of the speed, 0.05..1); for random
linkages the residual speed itself, 1e-13 times its terms; double roots 1e-9 of the frame by definition of a momentary
dwell, their place 1e-13 rad (it is well conditioned). The back-step angle has an absolute error of some ulp of 2 pi.
"""

import json
import math
import random
from pathlib import Path

import mpmath
import pytest
from sweeps import ALL

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.three_gear.dwell import Output, motion
from gearlink.core.machines.three_gear.momentary import momentary_linkage, tangency
from gearlink.core.machines.three_gear.symmetric import back_step_angle, frame_ratio_for_back_step, symmetric_linkage
from gearlink.core.machines.three_gear.symmetric import dwell_angle as closed_dwell_angle
from gearlink.core.machines.three_gear.train import GearTrain
from gearlink.core.parts.linkages.fourbar.position import FourBar, solve

REFERENCE = Path(__file__).parents[2] / "reference"
CASES = {case["id"]: case for case in json.loads((REFERENCE / "gear_linkage.json").read_text())["cases"]}
EX3 = FourBar(18.0, 50.0, 100.0, 121.4)
EX3_TRAIN = GearTrain(20, 20, 60)


def mirrored(linkage):
    return FourBar(linkage.crank, linkage.coupler, linkage.rocker, linkage.frame, -linkage.assembly)


def random_drives(count, seed):
    """Grashof crank-rockers and drag links of all proportions, drawn from a fixed seed."""
    draw = random.Random(seed)
    while count:
        teeth = [math.exp(draw.uniform(math.log(10), math.log(100))) for _ in range(3)]
        a, d = math.exp(draw.uniform(0, math.log(200))), math.exp(draw.uniform(0, math.log(300)))
        linkage = FourBar(a, teeth[0] + teeth[1], teeth[1] + teeth[2], d, draw.choice((1, -1)))
        if linkage.kind() in ("crank-rocker", "drag-link"):
            count -= 1
            yield linkage, GearTrain(*teeth)


def terms(linkage, train, phi):
    state = solve(linkage, phi, 1)
    return (
        train.ratio
        + abs(train.coupler_share * state.coupler_velocity)
        + abs(train.rocker_share * state.rocker_velocity)
    )


def check_against_counting(count, seed):
    """The closed quadratic against the sign changes of the speed on a grid of 0.5 deg."""
    seen = set()
    for linkage, train in random_drives(count, seed):
        places = Output(linkage, train).places
        speeds = [Output(linkage, train).speed(math.radians(0.5 * i)) for i in range(720)]
        changes = sum((speeds[i] < 0.0) != (speeds[i - 1] < 0.0) for i in range(720))
        if len(places) != changes:  # two standstills within one step of the grid
            assert (Output(linkage, train).speed_ratio_min < 0.0) == (len(places) == 2)
        for phi in places:
            condition = terms(linkage, train, phi) / math.sin(solve(linkage, phi).transmission_angle) ** 2
            assert abs(Output(linkage, train).speed(phi)) < 1e-13 * condition
        seen.add((linkage.kind(), len(places)))
    return seen


def test_published_standstills_of_example_3_as_printed():
    out = CASES["ex3_source_d"]["outputs"]
    places = Output(EX3, EX3_TRAIN).places
    assert places == pytest.approx([math.radians(out["dwell1_deg"]), math.radians(out["dwell2_deg"])], abs=1e-13)
    step = Output(EX3, EX3_TRAIN).back_step
    assert (step.start, step.end) == tuple(places)
    assert math.degrees(step.crank_angle) == pytest.approx(out["phi12_deg"], rel=1e-13)
    assert math.degrees(step.angle) == pytest.approx(out["backoff_deg"], abs=1e-12)
    assert math.degrees(Output(EX3, EX3_TRAIN).dwell_angle) == pytest.approx(out["phi13_exact_deg"], rel=1e-12)
    assert motion(places) == "back-step"


@pytest.mark.parametrize("case", ["phi13_i3_-1", "phi13_i3_-2", "phi13_i3_-3"])
def test_published_dwell_angles(case):
    inputs, out = CASES[case]["inputs"], CASES[case]["outputs"]
    b = math.sqrt((1.0 + out["d"] ** 2) / 2.0)
    linkage, train = FourBar(1.0, b, b, out["d"]), GearTrain(1.0, -inputs["i3"], 1.0)
    step = Output(linkage, train).back_step
    assert math.degrees(step.crank_angle) == pytest.approx(inputs["phi12_deg"], rel=1e-13)
    assert math.degrees(step.angle) == pytest.approx(out["backoff_deg"], abs=1e-12)
    assert math.degrees(Output(linkage, train).dwell_angle) == pytest.approx(out["phi13_exact_deg"], rel=1e-13)


@pytest.mark.parametrize("name", ["synth", "analyze"])
def test_published_designs(name):
    """Each example of the command line, from its link lengths."""
    for case in json.loads((REFERENCE / "contract" / f"{name}.json").read_text()):
        gears, out = case["spec"]["gears"], case["quantities"]
        links = case["spec"].get("links", {})
        train = GearTrain(gears["crank"], out.get("idler_teeth", gears.get("idler")), gears["output"])
        m = gears["module"]
        a = links.get("crank", out.get("crank_length", case["spec"].get("momentary", {}).get("eccentricity")))
        d = links.get("frame", out.get("frame_length"))
        linkage = FourBar(a, m * (train.crank + train.idler) / 2, m * (train.idler + train.output) / 2, d)
        places = Output(linkage, train).places
        assert motion(places) == out["motion"]
        if "dwell_crank_angles" in out:
            assert [math.degrees(p) for p in places] == pytest.approx(out["dwell_crank_angles"], rel=1e-12)
        if out["motion"] == "back-step":
            step = Output(linkage, train).back_step
            assert math.degrees(step.angle) == pytest.approx(out["back_step_angle"], abs=1e-12)
            assert math.degrees(Output(linkage, train).dwell_angle) == pytest.approx(out["dwell_angle"], rel=1e-12)


def test_counting_signs_finds_the_same_standstills():
    seen = check_against_counting(300 if ALL else 40, 7)
    assert seen == {(kind, n) for kind in ("crank-rocker", "drag-link") for n in (0, 2)}


@pytest.mark.slow
def test_counting_signs_finds_the_same_standstills_in_many_linkages():
    check_against_counting(6000, 8)


def test_standstills_agree_with_a_search_at_40_digits():
    a, b, c, d = 16.0, 50.0, 100.0, 124.0

    def speed(phi):
        reach = d - a * mpmath.expj(phi)
        t2 = mpmath.arg(reach) + mpmath.acos((b * b - c * c + abs(reach) ** 2) / (2 * b * abs(reach)))
        t3 = mpmath.arg(a * mpmath.expj(phi) + b * mpmath.expj(t2) - d)
        w2 = a * mpmath.sin(phi - t3) / (b * mpmath.sin(t3 - t2))
        w3 = a * mpmath.sin(phi - t2) / (c * mpmath.sin(t3 - t2))
        return mpmath.mpf(1) / 3 - w2 * 2 / 3 + w3 * 4 / 3

    places = Output(FourBar(a, b, c, d), EX3_TRAIN).places
    with mpmath.workdps(40):
        exact = [float(mpmath.findroot(speed, phi)) for phi in places]
    assert places == pytest.approx(exact, abs=1e-13)


@pytest.mark.quick(3)
@pytest.mark.parametrize("assembly", [1, -1])
@pytest.mark.parametrize(
    ("eccentricity", "off"),
    [(e, off) for e in (6.0, 10.0, 16.0, 18.0, 24.9, 24.999999) for off in (0.0, 1e-12, -1e-12)]
    + [(e, off) for e in (10.0, 16.0, 18.0, 24.9) for off in (1e-10, -1e-10)],
)
def test_rounded_momentary_dwell_is_one(eccentricity, off, assembly):
    exact = momentary_linkage(25.0, 25.0, 75.0, eccentricity, assembly)
    linkage = FourBar(exact.crank, exact.coupler, exact.rocker, exact.frame * (1.0 + off), assembly)
    places = Output(linkage, EX3_TRAIN).places
    least = Output(linkage, EX3_TRAIN).slowest
    assert motion(places) == "momentary-dwell"
    assert places[0] == pytest.approx(least.place, abs=1e-12)
    assert abs(least.value) < 1e-9


@pytest.mark.quick(3)
@pytest.mark.parametrize("assembly", [1, -1])
@pytest.mark.parametrize("eccentricity", [6.0, 10.0, 16.0, 18.0, 24.9])
@pytest.mark.parametrize("off", [1e-7, 1e-5, 1e-3, 1e-2])
def test_longer_frame_steps_back_and_shorter_turns_one_way(eccentricity, off, assembly):
    exact = momentary_linkage(25.0, 25.0, 75.0, eccentricity, assembly)
    long, short = (
        FourBar(exact.crank, exact.coupler, exact.rocker, exact.frame * factor, assembly)
        for factor in (1.0 + off, 1.0 - off)
    )
    if long.kind() == "crank-rocker":
        step = Output(long, EX3_TRAIN).back_step
        condition = 1e-14 * exact.frame / (long.frame - exact.frame)
        for phi in (step.start, step.end):
            assert abs(Output(long, EX3_TRAIN).speed(phi)) < 1e-13 + 10 * condition * step.crank_angle**2
    assert Output(short, EX3_TRAIN).places == []


def test_drag_links_have_a_momentary_dwell_too():
    """A crank above r1 just stops the output at the tangency of the other sign."""
    train, r1, r3, r5 = GearTrain(40, 20, 40), 40.0, 20.0, 40.0
    a = 45.0
    limit = tangency(r1, r3, r5, a)
    assert limit.frame < r5
    found = [
        Output(FourBar(a, 60.0, 60.0, limit.frame * factor), train).places for factor in (1.0 - 1e-4, 1.0, 1.0 + 1e-4)
    ]
    assert [len(places) for places in found] == [0, 1, 2]
    linkage = FourBar(a, 60.0, 60.0, limit.frame)
    assert linkage.kind() == "drag-link"
    assert abs(Output(linkage, train).speed(found[1][0])) < 1e-14
    assert abs(Output(linkage, train).acceleration(found[1][0])) < 1e-13


def test_crank_of_the_gear_radius_is_no_exception():
    linkage = FourBar(25.0, 50.0, 100.0, 110.0)
    places = Output(linkage, EX3_TRAIN).places
    assert len(places) == 2
    assert max(abs(Output(linkage, EX3_TRAIN).speed(phi)) for phi in places) < 1e-14


def test_back_step_in_every_linkage_that_has_one():
    """Start and end by the sign of the speed, width and angle by the output itself, both assemblies."""
    kinds = set()
    for linkage, train in random_drives(400, 11):
        if len(Output(linkage, train).places) < 2:
            continue
        kinds.add(linkage.kind())
        step = Output(linkage, train).back_step
        assert step.crank_angle == pytest.approx((step.end - step.start) % (2.0 * math.pi), abs=1e-15)
        assert Output(linkage, train).speed(step.start + 0.5 * step.crank_angle) < 0.0
        assert Output(linkage, train).speed(step.start - 1e-3) > 0.0
        assert Output(linkage, train).speed(step.start + step.crank_angle + 1e-3) > 0.0
        assert step.angle > 0.0
        regained = Output(linkage, train).dwell_angle
        assert step.crank_angle < regained < 2.0 * math.pi
        level = Output(linkage, train).angle(step.start)
        assert Output(linkage, train).angle(step.start + regained) == pytest.approx(level, abs=1e-12)

        mirror = Output(mirrored(linkage), train).back_step
        assert mirror.crank_angle == pytest.approx(step.crank_angle, abs=1e-13)
        assert mirror.angle == pytest.approx(step.angle, abs=1e-12)
        assert mirror.start == pytest.approx(-step.end % (2.0 * math.pi), abs=1e-13)
        scaled = FourBar(
            *(0.37 * x for x in (linkage.crank, linkage.coupler, linkage.rocker, linkage.frame)), linkage.assembly
        )
        assert Output(scaled, train).back_step.angle == pytest.approx(step.angle, abs=1e-12)
    assert kinds == {"crank-rocker", "drag-link"}


@pytest.mark.parametrize("half", [0.3, 1e-2, 1e-3, 2e-4])
def test_short_back_steps_keep_their_digits(half):
    """Against the closed forms of the symmetric family; the frame's last digit moves phi12 by ulp/phi12^2."""
    i3, phi12 = -1.8, 2.0 * half
    linkage = symmetric_linkage(frame_ratio_for_back_step(i3, phi12), 112.0)
    step = Output(linkage, GearTrain(40, 72, 40)).back_step
    slack = 1e-14 / phi12**2 + 1e-13
    assert step.crank_angle == pytest.approx(phi12, rel=slack)
    assert step.angle == pytest.approx(back_step_angle(i3, phi12), rel=3 * slack)
    assert Output(linkage, GearTrain(40, 72, 40)).dwell_angle == pytest.approx(closed_dwell_angle(i3, phi12), rel=slack)


def test_back_step_may_run_through_the_crank_angle_zero():
    """Among the drag links are some whose standstills lie on either side of the frame line."""
    wrapped = 0
    for linkage, train in random_drives(400, 11):
        if len(Output(linkage, train).places) == 2:
            wrapped += Output(linkage, train).back_step.end > 2.0 * math.pi
    assert wrapped > 0


def test_has_no_back_step_where_there_is_none():
    for crank, frame in ((18.0, 110.0), (5.0, 121.4)):
        output = Output(FourBar(crank, 50.0, 100.0, frame), EX3_TRAIN)
        assert (output.back_step, output.dwell_angle, output.ripple) == (None, None, None)


def test_refuses_links_that_are_not_the_centre_distances():
    with pytest.raises(NoSolution, match="required 100 mm"):
        _ = Output(FourBar(18.0, 50.0, 101.0, 121.4), EX3_TRAIN).places
    with pytest.raises(NoSolution, match="double-rocker"):
        _ = Output(FourBar(40.0, 50.0, 100.0, 121.4), EX3_TRAIN).places
