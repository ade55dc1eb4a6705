"""Three gears with an internal mesh: standstills, momentary dwell, and the dwell of a ring output within a tolerance.

Tolerances: references of 16 digits 1e-10 (roots of roots); standstills against sign changes of the speed 1e-11 rad, the
condition number of two standstills that lie apart; a window found on 2000 crank angles is short of the true one by up
to two steps, so the brute-force optimum is compared within 0.4 deg from above and never exceeds the answer.
"""

from __future__ import annotations

import json
import math
import random
from pathlib import Path
from typing import Any

import mpmath as mp
import numpy as np
import pytest
from factory import changed, design, worked
from pydantic import ValidationError
from sweeps import ALL

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.three_gear import families, momentary
from gearlink.core.machines.three_gear.dwell import Output
from gearlink.core.machines.three_gear.families import back_step_of, solved
from gearlink.core.machines.three_gear.train import GearTrain
from gearlink.core.parts.linkages import standstills
from gearlink.core.parts.linkages.checks import check_linkage
from gearlink.core.parts.linkages.fourbar.position import FourBar
from tests.oracles.three_gear_output import output_motion

CASES = json.loads((Path(__file__).parents[2] / "reference" / "dwell.json").read_text())


def case(name: str) -> Any:
    return next(found for found in CASES if found["name"].startswith(name))


def linkage_of(radii: Any, crank: float, frame: float, assembly: int = 1) -> FourBar:
    r1, r3, r5 = radii
    return FourBar(crank, abs(r1 + r3), abs(r3 + r5), frame, assembly)


@pytest.mark.parametrize("name", ["B5.1", "B5.3"])
def test_standstills_of_the_reference(name: str) -> None:
    given, want = case(name)["input"], case(name)["expected"]
    radii = [given[key] for key in ("r1", "r3", "r5")]
    train, linkage = GearTrain(*radii), linkage_of(radii, given["crank"], given["frame"], given["assembly"])
    assert [math.degrees(x) for x in Output(linkage, train).places] == pytest.approx(want["standstills"], rel=1e-11)
    assert math.degrees(Output(linkage, train).back_step.angle) == pytest.approx(want["back_step"], rel=1e-10)
    assert Output(linkage, train).mean_ratio == pytest.approx(want["mean_ratio"], rel=1e-15)


def test_momentary_dwell_of_the_reference() -> None:
    given, want = case("A6.4")["input"], case("A6.4")["expected"]
    radii = given["r1"], given["r3"], given["r5"]
    linkage = families.momentary_ring_linkage(*radii, given["crank"])
    assert linkage.frame == pytest.approx(want["frame"], rel=1e-13)
    (place,) = Output(linkage, GearTrain(*radii)).places
    assert math.degrees(place) == pytest.approx(want["crank_angle"], rel=1e-11)
    assert Output(linkage, GearTrain(*radii)).jerk(place) == pytest.approx(want["jerk_ratio"], rel=1e-8)


def test_longest_window_of_the_reference() -> None:
    given, want = case("B7.1")["input"], case("B7.1")["expected"]
    gears = {"module": 2, "crank": 24, "idler": 17, "output": -54}
    request = {"tolerance": given["tolerance_deg"], "margin": 0, "crank": given["crank"]}
    made = design({"kind": "three-gear-four-bar", "name": "x", "gears": gears, "dwell": request}, command="synth dwell")
    found = {name: made.quantity(name).value for name in ("frame_length", "back_step_angle", "min_transmission_angle")}
    assert found["frame_length"] == pytest.approx(want["frame"], rel=1e-12)
    assert found["back_step_angle"] == pytest.approx(want["back_step"], rel=1e-10)
    assert found["min_transmission_angle"] == pytest.approx(want["transmission_angle"], rel=1e-11)
    assert made.quantity("tolerance_dwell_angle").value == pytest.approx(want["window"], rel=1e-11)
    assert made.quantity("tolerance_dwell_start").value == pytest.approx(want["start"], rel=1e-11)


def arrangements(count: int, seed: int) -> list[tuple[FourBar, GearTrain, tuple[float, float, float]]]:
    """Random linkages that turn, crank-rockers and drag links, with one or two internal meshes; some with S = 0."""
    draw, found = random.Random(seed), []
    while len(found) < count:
        r3 = draw.uniform(5.0, 40.0)
        r1, r5 = (draw.choice((1, -1)) * draw.uniform(5.0, most) for most in (80.0, 120.0))
        if r1 > 0.0 and draw.random() < 0.2:
            r5 = -(r1 + 2.0 * r3)
        b, c = abs(r1 + r3), abs(r3 + r5)
        if min(r1, r5) > 0.0 or min(b, c) < 1.0:
            continue
        short = draw.uniform(0.05, 1.0) * min(b, c)
        if abs(b - c) + short >= b + c - short:
            continue
        other = draw.uniform(max(abs(b - c) + short, short), b + c - short)
        ends = (short, other) if draw.random() < 0.7 else (other, short)
        linkage = FourBar(ends[0], b, c, ends[1], draw.choice((1, -1)))
        try:
            check_linkage(linkage)
        except NoSolution:
            continue
        found.append((linkage, GearTrain(r1, r3, r5), (r1, r3, r5)))
    return found


def test_standstills_against_sign_changes_of_the_speed() -> None:
    seen = 0
    for linkage, train, _ in arrangements(125 if ALL else 50, seed=5):

        def speed(phi: float, linkage: FourBar = linkage, train: GearTrain = train) -> float:
            return Output(linkage, train).speed(phi)

        def slope(phi: float, linkage: FourBar = linkage, train: GearTrain = train) -> float:
            return Output(linkage, train).acceleration(phi)

        want = standstills.standstills(speed, standstills.turnings(speed, slope), 1e-12)
        got = Output(linkage, train).places
        assert len(got) == len(want)
        seen += len(got) == 2
        np.testing.assert_allclose(np.sort(got), np.sort(want), rtol=0.0, atol=1e-11)
    assert seen > (12 if ALL else 4)


def test_extremes_of_a_linkage_with_equal_coupler_and_rocker_lie_on_the_frame_line() -> None:
    train, linkage = GearTrain(50.0, 8.0, -66.0), FourBar(50.0, 58.0, 58.0, 57.0)
    found, turn = Output(linkage, train), output_motion(linkage, train, np.linspace(0.0, math.tau, 3601))
    assert found.speed_ratio_min == pytest.approx(turn.speed_ratio.min(), rel=1e-6)
    assert found.speed_ratio_max == pytest.approx(turn.speed_ratio.max(), rel=1e-6)


def test_momentary_dwell_at_forty_digits() -> None:
    """d* by a root of the discriminant of the quadratic, whose coefficients are written out."""
    draw = random.Random(8)
    with mp.workdps(40):
        for _ in range(20):
            r1, r3 = (mp.mpf(draw.uniform(8.0, 60.0)) for _ in range(2))
            r5 = -(r1 + r3) * mp.mpf(draw.uniform(1.03, 2.5))
            found = momentary.shape(float(r1), float(r3), float(r5))
            e = mp.mpf(draw.uniform(found.low, found.high))
            s, t = r1 + 2 * r3 + r5, r1 + r3 + r5
            p, q = s * s + r1**2 - r5**2, 16 * r3 * (r3 + r5) * (r1 + r3) * t
            h = e * e - r1 * r1
            root = mp.sqrt(q)
            g = 2 * s * s * h / (p + root)  # sigma = -1
            assert abs((2 * p * g - 4 * s * s * h) ** 2 - 4 * q * g * g) < mp.mpf(10) ** -25 * p**4
            frame = mp.sqrt(h + r5 * r5 - g)
            star = momentary.ring_tangency(float(r1), float(r3), float(r5), float(e))
            assert star is not None
            # float arguments cost eps times the condition number, some tens at the ends of the range
            assert star.frame == pytest.approx(float(frame), rel=1e-12)


def test_back_step_rises_from_the_momentary_frame_to_the_end_of_the_turning_range() -> None:
    draw, tried = random.Random(4), 0
    while tried < 12:
        r1, r3 = draw.uniform(8.0, 60.0), draw.uniform(8.0, 60.0)
        radii = r1, r3, -(r1 + r3) * draw.uniform(1.03, 2.5)
        found = momentary.shape(*radii)
        crank = draw.uniform(found.low, min(found.high, r1 + r3, -r3 - radii[2]))
        try:
            family = families.with_crank(*radii, crank)
        except NoSolution:
            continue
        if family.low is None:
            continue
        tried += 1
        low, high = family.stepping()
        assert high < low  # a ring round the train: shorter frames step back
        steps = [back_step_of(GearTrain(*radii))(family.linkage(low + (high - low) * k / 8.0)) for k in range(9)]
        assert steps == sorted(steps)
        assert steps[-1] > 0.0


def brute_window(linkage: FourBar, train: GearTrain, tolerance: float) -> float:
    """Longest run of crank angles on a grid of 2000 whose outputs lie within the band."""
    count = 2000
    phi = np.arange(2 * count) * math.tau / count
    angle = output_motion(linkage, train, phi).output_angle
    best, left = 0, 0
    high, low = [0], [0]  # monotone queues
    for right in range(1, 2 * count):
        while high and angle[high[-1]] <= angle[right]:
            high.pop()
        while low and angle[low[-1]] >= angle[right]:
            low.pop()
        high.append(right)
        low.append(right)
        while angle[high[0]] - angle[low[0]] > 2.0 * tolerance:
            left += 1
            high = [i for i in high if i >= left] or [right]
            low = [i for i in low if i >= left] or [right]
        best = max(best, right - left)
    return best * math.tau / count


@pytest.mark.slow
@pytest.mark.parametrize(("radii", "crank"), [((24.0, 17.0, -54.0), 22.0), ((30.0, 20.0, -70.0), 27.0)])
def test_no_frame_has_a_longer_window(radii: tuple[float, float, float], crank: float) -> None:
    """The whole turning range of frames, by brute force."""
    train, tolerance = GearTrain(*radii), math.radians(0.5)
    family = families.with_crank(*radii, crank)
    linkage = solved(family, back_step_of(train), 2.0 * tolerance, "")
    window = Output(linkage, train).ripple.crank_angle
    low, high = sorted((family.least, family.high))
    frames = [low + (high - low) * share for share in np.linspace(0.02, 0.98, 33)]
    reached = [brute_window(family.linkage(frame), train, tolerance) for frame in frames]
    assert max(reached) < window + 1e-9
    here = brute_window(linkage, train, tolerance * (1.0 + 1e-9))
    assert window - math.radians(0.4) < here <= window + 1e-9


@pytest.mark.slow
def test_tolerance_dwell_against_brute_force() -> None:
    for linkage, train, _ in arrangements(12, seed=21):
        tolerance = 0.03 * math.pi * abs(Output(linkage, train).mean_ratio)
        found = Output(linkage, train).within(tolerance)
        brute = brute_window(linkage, train, tolerance)
        assert brute <= found.crank_angle + 1e-9
        assert found.crank_angle - brute < math.radians(0.4)
        inside = found.start + found.crank_angle * np.linspace(0.0, 1.0, 200)
        angle = output_motion(linkage, train, inside).output_angle
        assert np.abs(angle - found.output_angle).max() < tolerance * (1.0 + 1e-9)


def test_families_meet_in_the_same_linkage() -> None:
    radii, request = (24.0, 18.0, -59.0), math.radians(1.0)
    measure = back_step_of(GearTrain(*radii))
    even = solved(families.balanced(*radii), measure, request, "")
    least, most = (even.coupler**2 + even.rocker**2 - (even.frame + side * even.crank) ** 2 for side in (1.0, -1.0))
    assert least == pytest.approx(-most, rel=1e-9)
    framed = solved(families.with_frame(*radii, even.frame), measure, request, "")
    cranked = solved(families.with_crank(*radii, even.crank), measure, request, "")
    assert framed.crank == pytest.approx(even.crank, rel=1e-10)
    assert cranked.frame == pytest.approx(even.frame, rel=1e-10)
    e = momentary.balanced_eccentricity(*radii)
    once = families.momentary_ring_linkage(*radii, e)
    assert once.crank**2 + once.frame**2 == pytest.approx(once.coupler**2 + once.rocker**2, rel=1e-12)
    assert momentary.eccentricity_for_frame(*radii, once.frame) == pytest.approx(e, rel=1e-12)


def test_forward_counts_the_output_along_its_mean() -> None:
    for linkage, train, _ in arrangements(30, seed=2):
        assert Output(linkage, Output(linkage, train).ahead.train).mean_ratio > 0.0


# The design file


def made(command: str = "synth dwell", **keys: Any) -> Any:
    return design(changed(worked("ring_feed"), **keys), command=command)


def test_worked_design_beats_external_gears() -> None:
    ring, external = made(), made(gears__output=118, limits__transmission_angle=20)
    assert ring.tolerance_dwell_angle > 1.25 * external.tolerance_dwell_angle
    assert ring.mean_ratio == -48 / 118
    assert ring.gear_gap is None
    assert [check.status for check in ring.check("gear-collision")] == ["warn"]


def test_interval_of_frames_meets_the_request() -> None:
    found = made(dwell={"window": 130, "tolerance": 0.5})
    low, high = found.frame_length_interval
    for frame, inside in ((low + 1e-6, True), (high - 1e-6, True), (low - 1e-4, False), (high + 1e-4, False)):
        linkage = FourBar(found.linkage.crank, found.linkage.coupler, found.linkage.rocker, frame)
        reached = Output(linkage, found.train).within(math.radians(0.5)).crank_angle
        assert (reached >= math.radians(130.0)) is inside


def test_meshes_carry_both_kinds_of_numbers() -> None:
    found = made("gear", links={"crank": 22, "frame": 53})
    assert found.quantity("idler_output.center_distance").value == 41.0
    assert found.quantity("idler_output.tip_fouling_margin").value > 0.0
    assert found.quantity("crank_idler.tip_fouling_margin") is None
    statuses = {check.name: check.status for name in ("tip-fouling", "contact-ratio") for check in found.check(name)}
    assert statuses == {"tip-fouling": "pass", "contact-ratio": "pass"}


def test_ring_on_the_crank_is_analysed_and_refused_by_syntheses() -> None:
    gears = {"crank": -60, "idler": 20, "output": 40}
    found = made("analyze", gears__crank=-60, gears__idler=20, gears__output=40, links={"crank": 8, "frame": 24})
    assert found.motion == "unidirectional"
    assert found.quantity("crank_idler.reference_radius").value == [30.0, 10.0]
    with pytest.raises(NoSolution, match="never stops the output") as caught:
        _ = made(**{f"gears__{key}": value for key, value in gears.items()}).linkage
    assert caught.value.key == "gears.crank"


def test_the_printed_range_of_cranks_of_a_ring_excludes_its_end() -> None:
    """The crank as long as the radius of gear 1, 16 mm, was refused as not "0.7143 to 16 mm"."""
    with pytest.raises(NoSolution, match=r"0\.7143 to 15\.99 mm"):
        families.momentary_ring_linkage(16.0, 16.0, -43.5, 16.0)
    assert families.momentary_ring_linkage(16.0, 16.0, -43.5, 15.99).kind() == "crank-rocker"


@pytest.mark.parametrize("idler", [34, None])
@pytest.mark.parametrize(
    ("command", "asked"),
    [
        ("synth dwell", {"dwell": {"window": 40.9, "tolerance": 0.5}}),
        ("synth dwell", {"dwell": {"window": 69.3, "tolerance": 0.5, "balanced": True}}),
        ("synth back-step", {"back_step": {"angle": 3}}),
        ("synth variable-speed", {"speed": {"min": 100, "max": 200}}),
        ("synth momentary-dwell", {"momentary": {"eccentricity": 20}}),
    ],
)
def test_two_equal_rings_are_refused_at_the_crank_gear(command: str, asked: dict[str, Any], idler: int | None) -> None:
    """A file was told "i3: 0.5574 (limit < 0)" at its task, and to give a ratio, which it does not contain."""
    gears = {"module": 1, "crank": -61, "output": -61} | ({} if idler is None else {"idler": idler})
    made = design({"kind": "three-gear-four-bar", "name": "x", "gears": gears, **asked}, command=command)
    with pytest.raises(NoSolution, match="ring") as caught:
        made.report(command)
    assert caught.value.key == "gears.crank"


@pytest.mark.parametrize(
    ("keys", "key", "words"),
    [
        ({"gears__output": -80}, "gears.output", "84 mm"),
        ({"dwell": {"tolerance": 0.5, "crank": 60}}, "dwell.crank", "below 41 mm"),
        (
            {"dwell": {"window": 150, "tolerance": 0.5}},
            "dwell.window",
            r"dwell within \+-0\.5 deg: 150 deg \(limit <= .* with these gears",
        ),
        ({"dwell": {"tolerance": 0.5, "frame": 100}}, "dwell.frame", "no crank turns"),
    ],
)
def test_refusals_name_key_and_limit(keys: dict[str, Any], key: str, words: str) -> None:
    with pytest.raises(NoSolution, match=words) as caught:
        _ = made(**keys).linkage
    assert caught.value.key == key


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"gears__output": 0}, "not 0"),
        ({"gears__output": -36}, "does not fit into a ring gear"),
        ({"gears__rim": 55}, r"rim: 55 mm \(limit > 60\.25 mm"),
        ({"gears__output": 118, "gears__rim": 70}, "applies only to a ring gear"),
        ({"gears__idler": None, "gears__i3": -0.5, "gears__crank": 118}, "i3 applies only to"),
    ],
)
def test_wrong_files(keys: dict[str, Any], words: str) -> None:
    with pytest.raises(ValidationError, match=words):
        made(**keys)


def test_speeds_of_an_output_that_turns_against_the_crank() -> None:
    found = made("synth variable-speed", speed={"min": 20, "max": 60, "balanced": True})
    assert found.input_speed * -found.speed_ratio_min == pytest.approx(60.0, rel=1e-12)
    assert found.input_speed * -found.speed_ratio_max == pytest.approx(20.0, rel=1e-9)


def test_drawn_teeth_roll_in_mesh() -> None:
    """Over a turn each drawn gear turns as the kinematics say, and the places of the teeth agree at the pitch point."""
    from gearlink.cli.views.figures.three_gear_four_bar import build
    from gearlink.core.parts.gears.outline.mesh_geometry import ring_turn

    fraction = np.linspace(0.0, 1.0, 25)
    links = {"crank": 8, "frame": 24}
    ring_crank = made("analyze", gears__crank=-60, gears__idler=20, gears__output=40, links=links)
    for found in (made(), ring_crank):
        parts = {
            part.label: part for part in build(found, fraction).parts if getattr(part, "label", "") in ("1", "3", "5")
        }
        sweep = output_motion(found.linkage, found.train, math.tau * fraction).output_angle
        turned = parts["5"].turn - parts["5"].turn[0]
        np.testing.assert_allclose(turned, sweep, rtol=0.0, atol=1e-11)
    line = np.angle(parts["3"].place - parts["1"].place)
    teeth = ring_crank.meshes["crank_idler"].teeth
    off = ring_turn((teeth[0], -teeth[1]), line, parts["3"].turn) - parts["1"].turn
    pitch = math.tau / teeth[1]
    np.testing.assert_allclose(np.abs(np.exp(1j * math.tau * off / pitch) - 1.0), 0.0, rtol=0.0, atol=1e-9)


@pytest.mark.parametrize(
    ("gears", "links", "radius"),
    [((48, 36, -118), (22.0, 53.0), 0.059), ((-60, 20, 40), (8.0, 24.0), 0.02)],
)
def test_tooth_force_accelerates_the_output(gears: Any, links: Any, radius: float) -> None:
    teeth = dict(zip(("gears__crank", "gears__idler", "gears__output"), gears, strict=True))
    masses = {"output": {"mass": 2, "inertia": 0.01}, "crank": {"mass": 1}}
    found = made(
        "loads", **teeth, links={"crank": links[0], "frame": links[1]}, input_speed=100, loads={"links": masses}
    )
    force = found.table("teeth", samples=72)["mesh_35"]
    speed = 100.0 * math.tau / 60.0
    motion = made("analyze", **teeth, links={"crank": links[0], "frame": links[1]}).table("motion", samples=72)
    want = 0.01 * motion["acceleration_ratio"] * speed**2 / radius
    np.testing.assert_allclose(np.abs(force), np.abs(want), rtol=0.0, atol=1e-9 * np.abs(want).max())
    assert [check.status for check in found.check("power-identity")] == ["pass"]


@pytest.mark.quick(1)
@pytest.mark.parametrize(("command", "options"), [("tolerance", ("--samples", "16")), ("register", ())])
def test_tolerances_of_a_ring_are_answered(
    command: str, options: tuple[str, ...], gearlink: Any, tmp_path: Path
) -> None:
    """By the command line; the numbers against the exact chain are those of test_toleranced.py and test_register.py."""
    sources = {"links.crank": {"limits": [-0.02, 0.02]}}
    data = changed(worked("ring_feed"), dwell=None, links={"crank": 22, "frame": 53}, tolerance={"sources": sources})
    path = tmp_path / "ring.yaml"
    path.write_text(json.dumps(data))
    ended = gearlink(command, path, *options, "--format", "json")
    assert ended.status == 0
    quantities = {name: each["value"] for name, each in ended.json["quantities"].items()}
    if command == "register":
        assert min(quantities["worst"]) > 0.0
        assert quantities["rss"] == pytest.approx([worst / 3.0 for worst in quantities["worst"]], rel=1e-12)  # 3 sigma
    else:
        assert quantities["no_mechanism"] == 0


def test_a_study_of_rings_is_left_to_the_design_classes() -> None:
    from gearlink.core.machines.three_gear.axis import axis

    ring = made("analyze", dwell=None, links={"crank": 22, "frame": 53}).spec
    assert axis(ring, "analyze", ["links.crank"], ["frame_length"], []) is None
    external = made("analyze", dwell=None, gears__output=118, links={"crank": 22, "frame": 110}).spec
    assert axis(external, "analyze", ["links.crank"], ["frame_length"], []) is not None


def test_findings_in_a_ring_call_the_idler_by_its_key() -> None:
    """A chosen idler of 17 teeth was "the planet", which no key of the file has."""
    keys = {"gears": {"module": 1.25, "crank": 28, "output": -96}, "dwell": {"window": 90, "tolerance": 0.3}}
    made = design({"kind": "three-gear-four-bar", **keys}, command="synth dwell")
    failed = [check for check in made.check("involute-interference") if check.status == "fail"]
    assert [check.fix for check in failed] == ["use more teeth on the idler, or a larger pressure angle"]
    assert not any(
        "planet" in check.message for name in made.outline("synth dwell").checks for check in made.check(name)
    )
