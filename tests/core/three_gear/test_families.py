"""Three external gears in one unknown length, against 38-digit cases, scans and round trips.

Tolerances: a root in a length is known to its last bit, and the back-step there to the condition number of the frame,
(d/D)(dD/dd), some hundred for the cases here; windows are its cube root.
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.three_gear import families
from gearlink.core.machines.three_gear.dwell import Output
from gearlink.core.machines.three_gear.momentary import (
    balanced_eccentricity,
    crank_with_room,
    eccentricity_for_frame,
    eccentricity_range,
    momentary_frame_length,
)
from gearlink.core.machines.three_gear.train import GearTrain

CASES = json.loads((Path(__file__).parents[2] / "reference" / "dwell.json").read_text())


def cases(letter: str) -> list[Any]:
    return [pytest.param(c["input"], c["expected"], id=c["name"]) for c in CASES if c["name"].startswith(letter)]


def train_of(radii: list[float]) -> GearTrain:
    return GearTrain(*(2.0 * r for r in radii))  # type: ignore[arg-type]


@pytest.mark.parametrize(("given_", "wanted"), cases("B1."))
def test_frame_for_a_tolerance(given_: Any, wanted: Any) -> None:
    radii = [given_[name] for name in ("r1", "r3", "r5")]
    train = train_of(radii)
    request = math.radians(2.0 * given_["tolerance_deg"])
    linkage = families.solved(families.with_crank(*radii, given_["crank"]), families.back_step_of(train), request, "")
    found = Output(linkage, train).ripple
    assert linkage.frame == pytest.approx(wanted["frame"], rel=1e-13)
    assert math.degrees(found.crank_angle) == pytest.approx(wanted["window"], rel=1e-11)
    assert math.degrees(found.start) == pytest.approx(wanted["start"], rel=1e-11)


@pytest.mark.parametrize(("given_", "wanted"), cases("B2."))
def test_balanced_for_a_tolerance(given_: Any, wanted: Any) -> None:
    radii = [given_[name] for name in ("r1", "r3", "r5")]
    train = train_of(radii)
    request = math.radians(2.0 * given_["tolerance_deg"])
    linkage = families.solved(families.balanced(*radii), families.back_step_of(train), request, "")
    assert (linkage.crank, linkage.frame) == pytest.approx((wanted["crank"], wanted["frame"]), rel=1e-12)
    angle = math.degrees(linkage.min_transmission_angle())
    assert angle == pytest.approx(wanted["transmission_angle"], rel=1e-12)
    assert math.degrees(Output(linkage, train).ripple.crank_angle) == pytest.approx(wanted["window"], rel=1e-11)


@pytest.mark.parametrize(("given_", "wanted"), cases("B4."))
def test_frame_for_a_dwell_angle(given_: Any, wanted: Any) -> None:
    radii = [given_[name] for name in ("r1", "r3", "r5")]
    train = train_of(radii)
    family = families.with_crank(*radii, given_["crank"])
    linkage = families.solved(family, families.dwell_angle_of(train), math.radians(given_["dwell_angle"]), "")
    assert linkage.frame == pytest.approx(wanted["frame"], rel=1e-12)
    assert math.degrees(Output(linkage, train).back_step.angle) == pytest.approx(wanted["back_step"], rel=1e-10)


@pytest.mark.parametrize("radii", [(40.0, 72.0, 40.0), (40.0, 20.0, 60.0)])
def test_a_crank_as_long_as_the_radius_of_its_gear(radii: tuple[float, float, float]) -> None:
    """Equal crank and output gears had 1/0 at the end of the family, where the links fold to a kite; the frame is
    between those of its neighbours, half the second difference of steps of 1e-6 from their mean."""
    train = train_of(list(radii))

    def frame(crank: float) -> float:
        family = families.with_crank(*radii, crank)
        return families.solved(family, families.back_step_crank_angle_of(train), math.radians(60.0), "").frame

    step = 1e-6 * radii[0]
    mean = 0.5 * (frame(radii[0] - step) + frame(radii[0] + step))
    assert frame(radii[0]) == pytest.approx(mean, rel=1e-11)


def test_momentary_from_frame_and_from_room() -> None:
    wanted = {c["name"]: c["expected"]["crank"] for c in CASES if c["name"].startswith("B3.")}
    given_ = {c["name"]: c["input"] for c in CASES if c["name"].startswith("B3.")}
    frame, room = "B3.1 momentary from frame", "B3.3 momentary from distance"
    assert eccentricity_for_frame(25.0, 25.0, 75.0, given_[frame]["frame"]) == pytest.approx(wanted[frame], rel=1e-14)
    assert crank_with_room(25.0, 25.0, 75.0, given_[room]["distance"]) == pytest.approx(wanted[room], rel=1e-14)


# An output gear not smaller than the crank gear has a momentary dwell with every idler.
gears = st.tuples(st.floats(15.0, 60.0), st.floats(15.0, 120.0), st.floats(1.0, 3.0)).map(
    lambda r: (r[0], r[1], r[0] * r[2])
)


@given(gears, st.floats(0.02, 0.98))
def test_momentary_round_trips(radii: tuple[float, float, float], share: float) -> None:
    low, high = eccentricity_range(*radii)
    crank = low + share * (high - low)
    frame = momentary_frame_length(*radii, crank)
    # the frame changes by kappa e/d of the crank: that much of its rounding comes back enlarged by the inverse
    kappa = (radii[0] + 2.0 * radii[1] + radii[2]) / low - 1.0
    gain = 1.0 + frame * frame / (kappa * crank * crank)
    assert eccentricity_for_frame(*radii, frame) == pytest.approx(crank, rel=8.0 * 2.0**-52 * gain)
    longest = crank_with_room(*radii, frame - crank)
    assert longest is not None
    assert momentary_frame_length(*radii, longest) - longest == pytest.approx(frame - crank, rel=1e-13)


@given(gears)
def test_balanced_momentary_dwell_is_balanced(radii: tuple[float, float, float]) -> None:
    try:
        crank = balanced_eccentricity(*radii)
    except NoSolution:
        assume(False)
    b, c = radii[0] + radii[1], radii[1] + radii[2]
    frame = momentary_frame_length(*radii, crank)
    assert crank * crank + frame * frame == pytest.approx(b * b + c * c, rel=1e-12)


@pytest.mark.slow
@settings(max_examples=12)
@given(gears, st.floats(0.3, 0.95), st.floats(0.1, 3.0))
def test_no_frame_stands_longer(radii: tuple[float, float, float], share: float, tolerance: float) -> None:
    """Along a given crank, the longest interval of other frames, found without the equal ripple."""
    train, tau = train_of(list(radii)), math.radians(tolerance)
    low, high = eccentricity_range(*radii)
    family = families.with_crank(*radii, low + share * (high - low))
    try:
        best = families.solved(family, families.back_step_of(train), 2.0 * tau, "")
    except NoSolution:
        assume(False)
    window = Output(best, train).ripple.crank_angle
    for part in (0.2, 0.9, 0.999):
        for frame in (
            family.low + part * (best.frame - family.low),
            best.frame + (1.0 - part) * (family.high - best.frame),
        ):
            assert Output(family.linkage(frame), train).within(tau).crank_angle <= window * (1.0 + 1e-9)


@pytest.mark.slow
@settings(max_examples=12)
@given(gears, st.floats(0.3, 0.95), st.sampled_from(["crank", "frame", "balanced"]), st.floats(0.05, 0.9))
def test_tasks_are_met_on_the_motion_itself(
    radii: tuple[float, float, float], share: float, way: str, part: float
) -> None:
    train = train_of(list(radii))
    low, high = eccentricity_range(*radii)
    crank = low + share * (high - low)
    try:
        family = {
            "crank": lambda: families.with_crank(*radii, crank),
            "frame": lambda: families.with_frame(*radii, momentary_frame_length(*radii, crank)),
            "balanced": lambda: families.balanced(*radii),
        }[way]()
    except NoSolution:
        assume(False)
    for measure in (families.window_of, families.dwell_angle_of, families.back_step_crank_angle_of):
        ends = [measure(train)(family.linkage(x)) for x in family.ends()]
        request = ends[0] + part * (ends[1] - ends[0])
        linkage = families.solved(family, measure(train), request, "")
        assert measure(train)(linkage) == pytest.approx(request, rel=1e-9)
        assert len(Output(linkage, train).places) == 2


def test_ripple_touches_both_edges_twice() -> None:
    linkage, train = families.with_crank(25.0, 25.0, 75.0, 18.0).linkage(121.4), GearTrain(20, 20, 60)
    found, step = Output(linkage, train).ripple, Output(linkage, train).back_step
    places = [found.start, step.start, step.end, found.start + found.crank_angle]
    start, top, bottom, end = (Output(linkage, train).angle(phi) for phi in places)
    assert start == pytest.approx(bottom, abs=1e-14)
    assert end == pytest.approx(top, abs=1e-14)
    inside = [Output(linkage, train).angle(found.start + i / 500 * found.crank_angle) for i in range(501)]
    assert max(inside) <= top + 1e-14
    assert min(inside) >= bottom - 1e-14
    assert top - bottom == pytest.approx(step.angle, rel=1e-12)
    assert found.output_angle == pytest.approx(0.5 * (top + bottom), abs=1e-14)


def test_speed_quotient() -> None:
    train, family = GearTrain(20, 20, 60), families.with_crank(25.0, 25.0, 75.0, 18.0)
    for quotient in (0.1, 0.0, -0.02):
        extremes = Output(families.with_speed_quotient(family, train, quotient), train)
        assert extremes.speed_ratio_min / extremes.speed_ratio_max == pytest.approx(quotient, rel=1e-11, abs=1e-14)
    with pytest.raises(NoSolution, match="min/max of the output speed"):
        families.with_speed_quotient(family, train, -0.9)


class TestRefusals:
    def test_crank_that_never_stops_the_output(self) -> None:
        with pytest.raises(NoSolution, match=r"limit > 5\.629 mm"):
            families.with_crank(25.0, 25.0, 75.0, 5.0).stepping()

    def test_crank_that_cannot_turn(self) -> None:
        with pytest.raises(NoSolution, match="to turn fully"):
            families.with_crank(25.0, 25.0, 75.0, 60.0)

    def test_frame_without_a_crank(self) -> None:
        with pytest.raises(NoSolution, match="in which no crank turns fully"):
            families.with_frame(25.0, 25.0, 75.0, 151.0)

    def test_request_beyond_the_family(self) -> None:
        train = GearTrain(20, 20, 60)
        with pytest.raises(NoSolution, match=r"a back-step of 400 deg is out of reach: at most 19\.77 deg") as refused:
            families.solved(
                families.with_crank(25.0, 25.0, 75.0, 18.0),
                families.back_step_of(train),
                math.radians(400.0),
                "a back-step of 400 deg",
                key="back_step.angle",
            )
        assert refused.value.fix == "set back_step.angle to at most 19.77 deg, or change the gears"
