"""The whole cycle of a wide swing: closed contours, their sectors and joints, what the device has to spare.

Tolerances: 1e-10 against references of 16 digits; places against the machine set up in the world 1e-12 of the centre
distance (one revolution of coordinates of some hundred mm); the roller's distance from points 0.1 mm apart of a contour
exceeds that from the contour by up to 0.05^2/(2 r_p), below 5e-4 mm; radii by differences over 1e-4 rad keep 5e-3
beside a law that starts with a step.
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from factory import changed, design, worked
from pydantic import ValidationError

from gearlink.core.machines.wide_swing.cycle import ClosedCam
from gearlink.core.numerics.extremes import maximum_over, minimum_over
from gearlink.core.parts.cams.undercut import undercut

TURN = 2.0 * math.pi
CASES = json.loads((Path(__file__).parents[2] / "reference" / "dwell.json").read_text())
ROCKER = "wide_swing_cycle"
TWIN: dict[str, Any] = {
    "layout": "twin-cam",
    "swing": 120,
    "cycle": {"working": 100, "far_dwell": 60, "return": 120, "near_dwell": 80},
    "unloader": {"type": "pneumatic", "pivot_ratio": 2.6, "arm": 120},
    "cam": {"center_distance": 200, "roller_radius": 5},
}


def twin(**keys: Any) -> Any:
    return design(changed(worked(ROCKER), **(TWIN | keys)), command="cam")


def rocker(**keys: Any) -> Any:
    return design(ROCKER, command="cam", **keys)


def case(name: str) -> dict[str, Any]:
    return next(found for found in CASES if found["name"].startswith(name))


def degrees(angles: Any) -> list[float]:
    return [math.degrees(angle) for angle in angles]


def test_reference() -> None:
    want = case("C1.1")["expected"]
    made = twin(layout="twin-rocker", cycle={"working": 120, "far_dwell": 80, "return": 100, "near_dwell": 60})
    inner, outer = made.cycle.main, made.cycle.back
    # the reference's external profile drives its working stroke: here the return
    assert degrees(made.cycle.sectors_external) == pytest.approx(want["external_sectors"], rel=1e-10)
    driven, *_ = degrees(made.cycle.sectors_internal)
    assert driven == pytest.approx(want["internal_sectors"][2], rel=1e-10)
    free = degrees(made.cycle.sectors_internal)[2]
    assert free == pytest.approx(want["internal_sectors"][0], rel=1e-10)
    for cam, name in ((outer, "external"), (inner, "internal")):
        a = cam.cam.center_distance
        assert abs(cam.cam.ratio) == pytest.approx(want[f"lam_{name}"], rel=1e-10)
        assert cam.rest_radius / a == pytest.approx(want[f"dwell_radius_{name}"], rel=1e-10)
        assert cam.joints[0].after / a == pytest.approx(want[f"start_curvature_{name}"], rel=1e-10)
        assert cam.joints[0].before == pytest.approx(cam.rest_radius, rel=1e-14)
    reserve = made.cycle.longer_stroke_reserve
    assert reserve == pytest.approx((1.0 + made.spec.unloader.reserve) * 1.44 - 1.0, rel=1e-14)
    assert twin().cycle.longer_stroke_reserve == pytest.approx(want["reserve_of_longer_stroke"], rel=1e-14)


@pytest.mark.parametrize("made", [rocker(), twin()], ids=["twin-rocker", "twin-cam"])
def test_pitch_curves_are_the_rollers_paths_in_the_turning_cams(made: Any) -> None:
    """The machine set up in the world: pivot at the origin, cam axis at a, both rollers on their arms."""
    cycle, a, swing = made.cycle, made.section.center_distance, made.motion.swing
    theta = np.linspace(0.0, TURN, 721)[:-1]
    share = np.interp(theta, np.cumsum((0.0, *cycle.angles)), (0.0, 1.0, 1.0, 0.0, 0.0))
    phi = (made.motion.law.invariants(share, 0)[0] - 0.5) * swing
    start = cycle.angles[0] + cycle.angles[1]
    late = np.mod(theta - start, TURN)
    one_body = not cycle.external_working
    arms = (-1.0 if one_body else 1.0) * cycle.main.cam.rocker_radius, cycle.back.cam.rocker_radius
    # the twin-rocker's cam turns against the swing of its external roller's stroke; a twin-cam's first one so too
    for arm, sense, found in (
        (arms[0], 1.0 if one_body else -1.0, cycle.of_main(cycle.main.pitch(theta))),
        (arms[1], 1.0, cycle.of_back(cycle.back.pitch(late))),
    ):
        path = np.exp(-1j * sense * theta) * (arm * np.exp(1j * phi) - a)
        turned = found / path
        assert np.abs(turned - turned[0]).max() < 1e-12
        assert abs(turned[0]) == pytest.approx(1.0, abs=1e-12)
        if arm == arms[0]:
            first = turned[0]
    if one_body:  # one rotation brings both into the frame of the table
        assert turned[0] == pytest.approx(first, abs=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("made", [rocker(), twin(), rocker(cam__free_clearance=0)], ids=["rocker", "twin", "tight"])
def test_roller_clears_the_contour_and_is_guided_by_it(made: Any) -> None:
    for cam in made.cycle.contours.values():
        assert isinstance(cam, ClosedCam)
        steps = np.linspace(0.0, TURN, 20001)[:-1]
        contour = cam.contour(steps)
        size, clearance = cam.cam.roller_radius, cam.clearance
        for sector, least, most in ((0, 0.0, 0.0), (1, 0.0, 0.0), (2, 0.0, clearance), (3, 0.0, 0.0)):
            low, high = cam.starts[sector], cam.starts[sector + 1]
            t = low + (high - low) * np.array([0.0, 0.02, 0.2, 0.35, 0.65, 0.8, 0.98])
            room = np.abs(contour[None, :] - cam.pitch_of(sector, t)[:, None]).min(axis=1) - size
            assert room.min() > least - 1e-9
            assert room.max() < most + 5e-4
            if sector == 2:
                assert room[2:-2] == pytest.approx(clearance, abs=5e-4)
        assert cam.cut.depth < 1e-9
        bands = np.diff(np.unwrap(np.angle(cam.pitch(steps))))
        assert bands.min() > -1e-12
        assert bands.sum() + bands[-1] == pytest.approx(TURN, abs=1e-3)


def test_sectors_are_the_polar_angles_of_the_joints() -> None:
    for made in (rocker(), twin()):
        for cam in made.cycle.contours.values():
            t = np.array([*cam.starts[:4], TURN])
            fine = np.unwrap(np.angle(cam.pitch(np.sort(np.concatenate([t, np.linspace(0.0, TURN, 2000)])))))
            at = np.searchsorted(np.sort(np.concatenate([t, np.linspace(0.0, TURN, 2000)])), t)
            polar = fine[at]
            polar[-1] = fine[0] + TURN
            np.testing.assert_allclose(np.diff(polar), cam.sectors, rtol=0.0, atol=1e-12)
            assert math.fsum(cam.sectors) == pytest.approx(TURN, rel=1e-15)


def test_joints_by_differences() -> None:
    h = 1e-4
    for made in (rocker(), twin()):
        for cam in made.cycle.contours.values():
            for i, joint in enumerate(cam.joints):
                place = joint.cam_angle
                for sector, t in (
                    ((i - 1) % 4, (place or TURN) - h * np.array([2, 1, 0])),
                    (i, place + h * np.arange(3)),
                ):
                    z = cam.pitch_of(sector, t)
                    sides = np.abs([z[1] - z[0], z[2] - z[1], z[2] - z[0]])
                    area = 0.5 * ((z[1] - z[0]).conjugate() * (z[2] - z[0])).imag
                    radius = sides.prod() / (4.0 * area)
                    assert radius == pytest.approx(joint.before if sector != i else joint.after, rel=5e-3)
                z = cam.pitch(np.array([(place - h) % TURN, place, place + h]))
                corner = np.angle((z[2] - z[1]) / (z[1] - z[0]))
                assert abs(corner) < 10.0 * h
                assert abs(joint.tangent_step) < 1e-14


def test_contour_runs_without_gap_or_corner_but_at_its_slot() -> None:
    for made in (rocker(), twin()):
        for cam in made.cycle.contours.values():
            pieces = cam.outline(400)
            assert [name for name, _ in pieces] == ["profile", "slot", "profile", "arc", "free", "arc"]
            turns = []
            for (_, one), (_, other) in zip(pieces, [*pieces[1:], pieces[0]], strict=True):
                assert abs(one[-1] - other[0]) < 1e-9
                turns.append(abs(np.angle((other[1] - other[0]) / (one[-1] - one[-2]))))
            assert max(turns[2:]) < 0.02 < min(turns[:2])


# What the device has to spare


def test_device_is_sized_by_the_shorter_stroke() -> None:
    both = {"working": 100, "far_dwell": 80, "return": 100, "near_dwell": 80}
    for shorter in ("working", "return"):
        longer = {"working": "return", "return": "working"}[shorter]
        made = twin(cycle=both | {longer: 125, "near_dwell": 55})
        assert made.unloading.force == pytest.approx(twin(cycle=both).unloading.force, rel=1e-14)
        slow = made.cycle.contours["return cam" if longer == "return" else "cam"].cam
        k = np.array([0.1, 0.3])
        force = made.unloading.contact_force(slow, k)
        # at the design speed the longer stroke needs (100/125)^2 of the device: the rest presses the roller
        c = made.motion.law.invariants(k, 2)[2]
        time = 100.0 / 6.0 / made.spec.speed
        moment = made.spec.inertia * made.motion.swing * c / time**2 * (1.0 - 0.64)
        want = 1e3 * moment / (slow.rocker_radius * np.cos(slow.pressure_angle(k)))
        np.testing.assert_allclose(force, want, rtol=1e-12)


def test_dwell_force() -> None:
    want = case("C2.1")
    given = want["input"]
    keys = {
        "cycle": None,
        "cycle_angle": given["cycle_angle"],
        "speed": given["design_speed"],
        "inertia": given["inertia"],
    }
    made = twin(**keys, unloader__reserve=given["reserve"])
    assert made.dwell_force == pytest.approx(want["expected"]["dwell_force"], rel=1e-9)


# Checks


def status(made: Any, name: str) -> list[str]:
    return [check.status for check in made.check(name)]


def test_checks_hold_for_the_worked_design() -> None:
    made = rocker()
    assert status(made, "closed-contour") == ["pass", "pass"]
    assert status(made, "profile-planes") == ["pass"]
    assert status(made, "acceleration-step") == ["warn", "warn"]
    assert status(twin(), "profile-planes") == []


@pytest.mark.slow
def test_large_roller_cuts_into_the_contour() -> None:
    made = rocker(cam__roller_radius=60)
    fails = [check for check in made.check("closed-contour") if check.status == "fail"]
    assert [check.code for check in fails] == ["GL512"]
    assert fails[0].value < 0.0
    assert status(made, "profile-planes") == ["warn"]


@pytest.mark.slow
def test_clearance_beyond_the_bend_crosses_and_its_remedy_holds() -> None:
    made = rocker(cam__free_clearance=90)
    failed = [check for check in made.check("closed-contour") if check.status == "fail"]
    assert len(failed) == 1
    assert "clearance of the roller in the free sector" in failed[0].message
    most = float(failed[0].fix.split("cam.free_clearance below ")[1].split()[0])
    assert status(rocker(cam__free_clearance=most), "closed-contour") == ["pass", "pass"]
    assert "fail" in status(rocker(cam__free_clearance=1.01 * most), "closed-contour")


def test_contour_in_the_shaft_fails() -> None:
    made = rocker(cam__free_clearance=40, cam__shaft_radius=65)
    assert [
        check.message
        for check in made.check("closed-contour")
        if "minimum radius of the contour of the" in check.message
    ]


@pytest.mark.slow
def test_contour_without_a_hub_is_warned_of() -> None:
    """Half the shaft's radius is the usual minimum hub; a free sector that left 0.9 mm of it had passed."""
    slot = min(cam.least_radius for cam in rocker(cam__free_clearance=0).cycle.contours.values())
    clearance = 40.0
    made = rocker(cam__free_clearance=clearance, cam__shaft_radius=slot - clearance - 0.9)
    (found,) = [check for check in made.check("closed-contour") if check.status == "warn"]
    assert "minimum radius of the contour of the external profile" in found.message
    assert found.value - made.section.shaft_radius == pytest.approx(0.9, abs=0.2)


def test_rest_of_no_length_warns() -> None:
    made = rocker(cycle__far_dwell=0, cycle__near_dwell=180)
    found = made.check("cycle-angles")
    assert [check.status for check in found] == ["warn"]
    assert "cycle.far_dwell" in found[0].fix


def test_profile_without_phase_angle_is_a_finding_with_the_key_of_its_stroke() -> None:
    made = rocker(cycle__working=10, cycle__near_dwell=180)
    assert "fail" in [
        check.status for name in ("profile-exists", "cam-undercut", "transition-zone") for check in made.check(name)
    ]


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        (
            {"cycle__working": 90, "cycle__near_dwell": 110},
            r"1 validation error for WideSwingSpec\
cycle\
  working, far_dwell, return and near",
        ),
        ({"cycle_angle": 90}, "exclude each other"),
        ({"cycle__far_dwell": -1, "cycle__near_dwell": 181}, "greater than or equal to 0"),
        ({"cycle": None}, "cycle_angle"),
    ],
)
def test_wrong_cycles(keys: dict[str, Any], words: str) -> None:
    with pytest.raises(ValidationError, match=words):
        rocker(**keys)


def test_table() -> None:
    made = rocker()
    table = made.table("contour", samples=72)
    assert table.length == 72
    angle, phase = table["rocker_angle"], list(table["phase"])
    assert [phase[i] for i in (0, 16, 30, 50)] == ["working", "far-dwell", "return", "near-dwell"]
    assert angle[16] == pytest.approx(75.0, rel=1e-12) == -angle[50]
    gone = np.isnan(table["x"])
    assert list(table["cam_angle"][gone]) == [40.0]  # the slot at mid-swing
    main = made.table("main_cam", samples=16)
    np.testing.assert_allclose(table["x"][:8], main["x"][:8], rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(table["pitch_y"][:8], main["pitch_y"][:8], rtol=0.0, atol=1e-9)
    twins = twin()
    back, late = twins.table("return_cam", samples=12), twins.table("contour", samples=36)
    np.testing.assert_allclose(late["return_x"][16:21], back["x"][:5], rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(late["return_pitch_y"][16:28], back["pitch_y"][:12], rtol=0.0, atol=1e-9)


def test_a_turn_that_is_missed_by_little_is_said_with_its_digits() -> None:
    cycle = {"working": 90.0, "far_dwell": 90.0, "return": 90.0, "near_dwell": 90.0000001}
    with pytest.raises(
        ValidationError,
        match=r"1 validation error for WideSwingSpec\
cycle\
  working, far_dwell, return and near",
    ):
        design(changed(worked("wide_swing_cycle"), cycle=cycle))


@pytest.mark.quick(1)
@pytest.mark.parametrize("clearance", [0.0, 0.5])
def test_the_free_sector_by_the_cam_angle(clearance: float) -> None:
    """Over the whole sector and the time, of which half of it is sought by the angle of the law."""
    for closed in rocker(cam__free_clearance=clearance).cycle.contours.values():
        place, roller = closed.starts[2:4], closed.cam.roller_radius

        def bend(t: Any, closed: Any = closed) -> Any:
            return np.maximum(0.0, closed.state(2, t).bulge / closed.cam.center_distance)

        sharpest, worst, least = (each.value for each in closed.free)
        assert sharpest == pytest.approx(maximum_over(bend, *place, samples=256).value, rel=1e-12)
        near = minimum_over(lambda t, c=closed: np.abs(c.contour_of(2, t)), *place, samples=256)  # type: ignore[misc]
        assert least == pytest.approx(near.value, rel=1e-12)
        ratio = maximum_over(
            lambda t, c=closed, b=bend, r=roller: c._share(t) * b(t) / (1.0 - r * b(t)),
            *place,
            samples=256,  # type: ignore[misc]
        )
        assert worst == pytest.approx(ratio.value, rel=1e-11)


@pytest.mark.quick(1)
@pytest.mark.parametrize("roller", [4.0, 40.0])
def test_the_cut_by_the_cam_angle(roller: float) -> None:
    for closed in twin(cam__roller_radius=roller).cycle.contours.values():
        found = closed.cut
        other = undercut(lambda t, c=closed: (c.pitch(t), c.contour(t)), roller)  # type: ignore[misc]
        assert found.depth == pytest.approx(other.depth, abs=1e-8)
        if found.depth > 1e-6:
            assert found.cam_angle == pytest.approx(other.cam_angle, abs=1e-4)
