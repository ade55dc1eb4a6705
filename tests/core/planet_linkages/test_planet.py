"""Two-gear four-bar and geared rocker.

Tolerances: reference cases (40 digits, rounded to double) 1e-13 relative, angles 1e-12 deg. Standstills against the
cubic of the pitch-point condition, whose roots numpy gives to about 1e-12 of the condition of a cubic root. Swings
against golden-section search, exact to rounding in the value at a smooth extreme.
"""

import itertools
import json
import math
import random
from pathlib import Path

import factory
import numpy as np
import pytest
from sweeps import ALL

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.planet_linkages.planet import PlanetLinkage, standstill_coupler_ratio
from gearlink.core.machines.planet_linkages.rocker_design import (
    crank_for_swing,
    extreme_crank_angles,
    longest_crank,
    output_swing,
)
from gearlink.core.numerics.roots import maximum
from gearlink.core.parts.linkages.fourbar.position import FourBar, solve
from gearlink.core.parts.linkages.standstills import standstills, turnings

REFERENCE = Path(__file__).parents[2] / "reference"
CASES = {case["id"]: case for case in json.loads((REFERENCE / "gear_linkage.json").read_text())["cases"]}
DRAG = {"coupler": 48.0, "rocker": 50.0, "frame": 24.0}
CRANK_ROCKER = {"coupler": 30.0, "rocker": 40.0, "frame": 45.0}
LEVER = {"crank": 20.0, "coupler": 70.0, "frame": 80.0}


def two_gear(links, module=2.0, **keys):
    gears = {"module": module} | {k: keys.pop(k) for k in ("planet", "sun", "ring") if k in keys}
    data = {"kind": "two-gear-four-bar", "gears": gears, "links": links} | keys
    return factory.design(data)


def rocker(links, coupler=30, output=20, module=2.4, **keys):
    gears = {"module": module, "coupler": coupler, "output": output}
    return factory.design({"kind": "geared-rocker", "gears": gears, "links": links} | keys)


def random_linkages(count, seed):
    draw = random.Random(seed)
    while count:
        a, b, c, d = (math.exp(draw.uniform(0.0, 3.0)) for _ in range(4))
        linkage = FourBar(a, b, c, d, draw.choice((1, -1)))
        if linkage.kind() in ("crank-rocker", "drag-link"):
            count -= 1
            yield linkage, draw.uniform(0.2, 3.0)


# Two-gear four-bar


def test_reference_two_gear():
    given, out = CASES["two_gear_crank_rocker"]["inputs"], CASES["two_gear_crank_rocker"]["outputs"]
    external = two_gear(CRANK_ROCKER, planet=16, sun=12, module=1.0)
    assert external.crank_length == given["a"]
    assert external.coupler_ratio_min == pytest.approx(out["w2_min"], rel=1e-13)
    assert external.coupler_ratio_max == pytest.approx(out["w2_max"], rel=1e-13)
    places = {t.value: math.degrees(t.place) for t in external.coupler_turnings}
    assert places[external.coupler_ratio_min] == pytest.approx(out["phi_w2min_deg"], abs=1e-12)
    assert places[external.coupler_ratio_max] == pytest.approx(out["phi_w2max_deg"], abs=1e-12)
    assert external.drive.speed(math.radians(60.0)) == pytest.approx(out["W5_ext_z2_16_z5_12_at60"], rel=1e-13)
    assert external.speed_ratio_min == pytest.approx(out["W5_ext_min"], rel=1e-13)
    ring = two_gear(CRANK_ROCKER, planet=48, ring=62)
    assert ring.crank_length == given["a"]
    assert ring.speed_ratio_min == pytest.approx(out["W5_int_z2_48_z5_62_min"], rel=1e-13)
    assert ring.dwell_teeth_ratio == pytest.approx(out["max_int_ratio_z5_over_z2"], rel=1e-13)
    assert external.dwell_teeth_ratio is None


def pitch_point_standstills(linkage, ratio):
    """Standstills from the line CD through the pitch point: a cubic in cos(phi), then the right assembly."""
    a, b, c, d = linkage.crank, linkage.coupler, linkage.rocker, linkage.frame
    p = a / (1.0 - ratio)  # the pitch point lies on AB at this distance from A: r5 = a z5/(z5 +- z2)
    bd, pd = [-2 * a * d, a * a + d * d], [-2 * p * d, p * p + d * d]
    left = np.polymul(np.polymul(np.polyadd(bd, [c * c - b * b]), np.polyadd(bd, [c * c - b * b])), pd)
    foot = [-(a + p) * d, a * p + d * d]
    found = []
    for root in np.roots(np.polysub(left, 4 * c * c * np.polymul(foot, foot))):
        if abs(root.imag) < 1e-7 and abs(root.real) <= 1.0:
            angle = math.acos(root.real)
            for phi in (angle, 2.0 * math.pi - angle):
                w2 = solve(linkage, phi, 1).coupler_velocity
                if abs((1 - ratio) + ratio * w2) < 1e-6:
                    found.append(phi)
    return sorted(found)


def test_standstills_against_the_cubic_of_the_pitch_point():
    seen = set()
    for linkage, share in random_linkages(150 if ALL else 50, 3):
        ratio = -share if linkage.kind() == "drag-link" else 0.3 + 0.2 * share
        drive = PlanetLinkage(linkage, ratio, "crank")
        extremes = turnings(drive.speed, drive.acceleration)
        places = standstills(drive.speed, extremes, 1e-9)
        if min(abs(t.value) for t in extremes) < 1e-3:
            continue
        expected = pitch_point_standstills(linkage, ratio)
        assert places == pytest.approx(expected, abs=1e-7)  # double numbers under the cubic's own condition
        for place in places:
            assert abs(drive.speed(place)) < 1e-12 / math.sin(solve(linkage, place).transmission_angle) ** 2
        seen.add((linkage.kind(), len(places)))
    assert seen >= {("drag-link", 0), ("drag-link", 2), ("crank-rocker", 0), ("crank-rocker", 2)}


@pytest.mark.slow
def test_a_sun_never_stops_on_a_crank_rocker():
    """The statement that thesis 2.2.1 lacks: w2/w1 < 1 in every crank-rocker."""
    for linkage, share in random_linkages(200, 5):
        if linkage.kind() == "crank-rocker":
            drive = PlanetLinkage(linkage, -share, "crank")
            assert min(t.value for t in turnings(drive.speed, drive.acceleration)) > 1.0


def test_drag_link_stops_twice():
    made = two_gear(DRAG, planet=36, sun=18)
    assert made.motion == "back-step"
    assert len(made.dwell_crank_angles) == 2
    step = made.back_step
    lost = maximum(lambda x: made.drive.angle(x), step.start - 0.5, step.start + 0.5)[1] - made.drive.angle(step.end)
    assert made.back_step_angle == pytest.approx(lost, abs=1e-14)
    assert made.mean_ratio == pytest.approx(made.drive.angle(2.0 * math.pi) / (2.0 * math.pi), rel=1e-14)


@pytest.mark.parametrize("links", [DRAG, CRANK_ROCKER])
def test_mirror_image(links):
    gears = {"planet": 36, "sun": 18} if links is DRAG else {"planet": 48, "ring": 62}
    one, other = two_gear(links, **gears), two_gear(links, assembly=-1, **gears)
    turned = sorted(2.0 * math.pi - phi for phi in other.dwell_crank_angles)
    assert one.dwell_crank_angles == pytest.approx(turned, abs=1e-13)
    assert one.back_step_angle == pytest.approx(other.back_step_angle, rel=1e-12)


def test_table_follows_the_scalar_kernel():
    made = two_gear(DRAG, planet=36, sun=18)
    data = dict(zip(made.table("motion").columns, made.table("motion").data, strict=True))
    for i in (0, 17, 200, 359):
        phi = math.radians(data["crank_angle"][i])
        assert math.radians(data["output_angle"][i]) == pytest.approx(made.drive.angle(phi), abs=1e-13)
        assert data["speed_ratio"][i] == pytest.approx(made.drive.speed(phi), abs=1e-13)
        assert data["acceleration_ratio"][i] == pytest.approx(made.drive.acceleration(phi), abs=1e-12)
    h = 1e-5
    slope = (made.drive.speed(1 + h) - made.drive.speed(1 - h)) / (2 * h)
    assert made.drive.acceleration(1.0) == pytest.approx(slope, abs=1e-9)


@pytest.mark.parametrize("carrier", ["crank", "rocker"])
@pytest.mark.parametrize("lengths", [(14.0, 30.0, 40.0, 45.0), (50.0, 48.0, 50.0, 24.0)])
def test_each_rate_is_the_slope_of_the_one_before(lengths, carrier):
    """Central differences of 1e-5 rad: their own error is 1e-10 of the second rate above, and eps/1e-5."""
    drive, step = PlanetLinkage(FourBar(*lengths), -16.0 / 12.0, carrier), 1e-5
    curves = (drive.angle, drive.speed, drive.acceleration, drive.jerk)
    for phi in (0.3, 1.7, 2.9, 4.0, 5.6):
        for lower, upper in itertools.pairwise(curves):
            slope = (lower(phi + step) - lower(phi - step)) / (2.0 * step)
            assert upper(phi) == pytest.approx(slope, rel=1e-8, abs=1e-8)


def test_standstill_condition():
    ratio = standstill_coupler_ratio(-36 / 18)
    assert ratio == 1.0 + 18 / 36
    made = two_gear(DRAG, planet=36, sun=18)
    for phi in made.dwell_crank_angles:
        assert solve(made.linkage, phi, 1).coupler_velocity == pytest.approx(ratio, rel=1e-13)


def test_limit_of_teeth_is_the_momentary_dwell():
    limit = two_gear(CRANK_ROCKER, planet=48, ring=62).dwell_teeth_ratio
    linkage = two_gear(CRANK_ROCKER, planet=48, ring=62).linkage
    drive = PlanetLinkage(linkage, 1.0 / limit, "crank")
    assert min(t.value for t in turnings(drive.speed, drive.acceleration)) == pytest.approx(0.0, abs=1e-15)


def test_dwell_asked_of_a_sun_on_a_crank_rocker_is_refused():
    made = two_gear(CRANK_ROCKER, planet=16, sun=12, module=1.0, target={"motion": "momentary-dwell"})
    with pytest.raises(NoSolution, match="momentary-dwell is impossible: the output stops where w2/w1 =") as refused:
        made.check("dwell-condition")
    assert refused.value.key == "target.motion"


def test_other_motion_than_asked_for_fails_with_the_limit():
    made = two_gear(DRAG, planet=36, sun=18, target={"motion": "unidirectional"})
    (found,) = made.check("dwell-condition")
    assert found.status == "fail"
    assert "no unidirectional, maximum coupler ratio w2/w1" in found.message
    assert two_gear(DRAG, planet=20, sun=34, target={"motion": "unidirectional"}).check("dwell-condition")


@pytest.mark.parametrize(
    ("links", "gears", "key"),
    [
        (CRANK_ROCKER | {"crank": 14.001}, {"planet": 48, "ring": 62}, "links.crank"),
        (CRANK_ROCKER | {"frame": 100.0}, {"planet": 48, "ring": 62}, "links"),
        (CRANK_ROCKER, {"planet": 30, "sun": 30}, "links"),
    ],
)
def test_refused_links(links, gears, key):
    with pytest.raises(NoSolution) as refused:
        _ = two_gear(links, **gears).motion
    assert refused.value.key == key


# Geared rocker


def test_reference_rocker():
    out = CASES["rocker_amp"]["outputs"]
    made = rocker(LEVER)
    assert [math.degrees(phi) for phi in made.extreme_crank_angles] == pytest.approx(out["extreme_deg"], abs=1e-12)
    assert math.degrees(made.output_swing) == pytest.approx(out["swing5_deg"], rel=1e-13)
    assert math.degrees(made.rocker_swing) == pytest.approx(out["rocker_swing_deg"], rel=1e-13)
    assert made.swing_multiple == pytest.approx(out["multiple"], rel=1e-13)
    assert made.naive_multiple == out["naive_1_plus_q"]


@pytest.mark.slow
def test_swing_against_a_search_for_the_extremes():
    for linkage, share in random_linkages(60, 11):
        if linkage.kind() != "crank-rocker":
            continue
        drive = PlanetLinkage(linkage, -share, "rocker")
        places = extreme_crank_angles(drive)
        assert len(places) == 2
        ends = [
            maximum(lambda x, s=s, drive=drive: s * drive.angle(x), p - 0.3, p + 0.3)[1]
            for p in places
            for s in (1, -1)
        ]
        tops = max(ends[0], ends[2]) + max(ends[1], ends[3])
        assert output_swing(drive) == pytest.approx(tops, rel=1e-12)


def test_line_of_the_crank_passes_the_pitch_point_at_the_extremes():
    made = rocker(LEVER)
    d = complex(made.frame_length)
    for phi in made.extreme_crank_angles:
        state = solve(made.linkage, phi)
        direction = complex(math.cos(state.rocker_angle), math.sin(state.rocker_angle))
        pole = d + made.mesh.reference_radius[1] * direction
        across = (pole * complex(math.cos(phi), -math.sin(phi))).imag
        assert abs(across) < 1e-12 * made.frame_length


@pytest.mark.quick(2)
@pytest.mark.parametrize("swing", [30.0, 101.175579601631, 160.0, 240.0])
def test_synthesis_reaches_the_swing_on_the_real_motion(swing):
    links = {k: v for k, v in LEVER.items() if k != "crank"}
    made = rocker(links, target={"swing": swing})
    assert math.degrees(made.output_swing) == pytest.approx(swing, abs=1e-11)
    (found,) = made.check("target")
    assert (found.code, found.status) == ("GL307", "pass")
    if swing == 101.175579601631:
        assert made.crank_length == pytest.approx(20.0, rel=1e-12)


def test_longest_crank_is_the_change_point():
    assert longest_crank(70.0, 60.0, 80.0) == 50.0
    assert FourBar(50.0, 70.0, 60.0, 80.0).kind() == "change-point"
    with pytest.raises(NoSolution, match="130 mm"):
        longest_crank(60.0, 70.0, 140.0)


def test_swing_out_of_reach_names_the_greatest():
    with pytest.raises(NoSolution, match=r"swing: 700 deg \(limit <= ") as refused:
        crank_for_swing(70.0, 60.0, 80.0, 1, -1.5, math.radians(700.0))
    reach = float(str(refused.value).split("limit <= ")[1].split()[0])
    assert crank_for_swing(70.0, 60.0, 80.0, 1, -1.5, math.radians(reach - 0.1)) < 50.0


@pytest.mark.parametrize(
    ("links", "key"),
    [
        (LEVER | {"rocker": 61.0}, "links.rocker"),
        (LEVER | {"crank": 55.0}, "links"),
        ({"crank": 90.0, "coupler": 70.0, "frame": 20.0}, "links"),
    ],
)
def test_refused_rockers(links, key):
    with pytest.raises(NoSolution) as refused:
        _ = rocker(links).output_swing
    assert refused.value.key == key


@pytest.mark.parametrize("ratio", [0.0, 1.0, math.inf, math.nan])
def test_refused_ratio(ratio):
    with pytest.raises(NoSolution, match="gear ratio"):
        PlanetLinkage(FourBar(20.0, 70.0, 60.0, 80.0), ratio, "rocker")
