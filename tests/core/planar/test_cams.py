"""Cams in planar mechanisms: motion, profile and forces against the kind disc-cam, rates against differences."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from sweeps import mostly_slow

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.disc_cam.design import DiscCamDesign
from gearlink.core.machines.disc_cam.loads import DiscCamLoads
from gearlink.core.machines.disc_cam.spec import DiscCamSpec
from gearlink.core.machines.planar.design import PlanarMechanism
from gearlink.core.machines.planar.loads import PlanarLoads
from gearlink.core.machines.planar.samples import PlanarSamples
from gearlink.core.machines.planar.spec import PlanarSpec
from gearlink.core.machines.planar.system import Jets

MOTION = [{"to": 110, "lift": 18}, {"to": 170}, {"to": 300, "lift": 0, "law": "polynomial-345"}, {"to": 360}]
STROKE = [{"to": 110, "lift": 9, "law": "cycloidal"}, {"to": 170}, {"to": 300, "lift": 0}, {"to": 360}]


def _slid(face: bool, way: float, sense: int) -> tuple[dict[str, Any], dict[str, Any]]:
    touch: dict[str, Any] = {"face": 90.0} if face else {"roller_radius": 11.0}
    u, offset = np.exp(1j * math.radians(way)), 0.0 if face else 9.0
    foot = -1j * u * offset
    mine = {
        "frame": {"O": [0, 0]},
        "links": {"cam": {"O": [0, 0]}, "follower": {"B": [0, 0]}},
        "slides": {"guide": {"link": "follower", "through": [foot.real, foot.imag], "direction": way}},
        "cams": {
            "main": {"cam": "cam", "follower": "follower", "point": "B", "motion": STROKE, "sense": sense} | touch
        },
        "start": {"guide": 52.0},
    }
    sort = {"type": "translating-flat"} if face else {"type": "translating-roller", "roller_radius": 11, "offset": 9}
    radius = {"base_radius": 52.0} if face else {"prime_radius": math.hypot(52.0, 9.0)}
    return mine, {"motion": STROKE, "follower": {**sort, "direction": way, "mass": 2.0}, "cam": radius}


def _rocked(face: bool, way: float, side: int) -> tuple[dict[str, Any], dict[str, Any]]:
    arm, distance, pivot = 95.0, 130.0, np.exp(1j * math.radians(way))
    psi0 = math.radians(28.0 if face else 24.0)
    psi = math.radians(way) + math.pi - side * psi0
    away = 130.0 * pivot
    # a face 6 mm off its pivot, away from the cam
    place = [0.0, 0.0] if not face else [40.0, -6.0 * side]
    touch: dict[str, Any] = {"face": 0.0} if face else {"roller_radius": 14.0}
    mine = {
        "frame": {"O": [0, 0], "A": [away.real, away.imag]},
        "links": {"cam": {"O": [0, 0]}, "follower": {"A": [0, 0], "B": place if face else [arm, 0.0]}},
        "cams": {"main": {"cam": "cam", "follower": "follower", "point": "B", "motion": MOTION} | touch},
        "start": {"follower": math.degrees(psi)},
    }
    radius = abs(away + arm * np.exp(1j * psi))
    sort: dict[str, Any] = {"type": "oscillating-roller", "roller_radius": 14, "arm": arm}
    if face:
        sort, radius = {"type": "oscillating-flat", "face_offset": 6.0}, 6.0 + distance * math.sin(psi0)
    sort |= {"center_distance": distance, "pivot_direction": way, "side": side, "inertia": 0.02}
    return mine, {"motion": MOTION, "follower": sort, "cam": {"base_radius" if face else "prime_radius": radius}}


CASES = {
    "slid roller": _slid(False, 90.0, 1),
    "slid face": _slid(True, 40.0, -1),
    "rocked roller": _rocked(False, 0.0, 1),
    "rocked roller, other side": _rocked(False, 200.0, -1),
    "rocked face": _rocked(True, 0.0, 1),
    "rocked face, other side": _rocked(True, 75.0, -1),
}


def pair(name: str, **more: Any) -> tuple[PlanarMechanism, DiscCamDesign]:
    mine, other = CASES[name]
    file = {"kind": "planar-mechanism", "name": "mine", "drive": {"link": "cam"}, **mine, **more}
    disc = {"kind": "disc-cam", "name": "other", "speed": 240, **other}
    disc["cam"] = {**other["cam"], "sense": 1}
    return PlanarMechanism(PlanarSpec.model_validate(file)), DiscCamDesign(DiscCamSpec.model_validate(disc))


@pytest.mark.parametrize("name", mostly_slow(list(CASES), 3))
def test_motion_and_profile_are_those_of_a_disc_cam(name: str) -> None:
    mine, other = pair(name)
    cam, sense = mine.structure.cams["main"], mine.spec.cams["main"].sense
    phi = np.radians(np.arange(0.0, 360.0, 7.3))
    q = sense * phi  # the cam turns with the input, its angle counts in its own sense
    jets = mine.course.jets(q, 3, sense)  # at a joint what is just after it by the cam angle
    follower = mine.structure.numbers["follower"]
    if cam.slide is not None:
        line = cam.slide.line
        way = np.exp(-1j * line.direction)
        found = [(jets.x[k][:, follower] * way).real * mine.structure.size for k in range(4)]
    else:
        found = [jets.t[k][:, follower] for k in range(4)]
    wanted = other.follower_motion.evaluate(phi, 3)
    for k in range(4):
        value = found[k] * math.factorial(k) * sense**k
        value = cam.away * (value - cam.zero) if k == 0 else cam.away * value
        if k == 0 and cam.slide is None:
            value = np.remainder(value + 1.0, 2.0 * math.pi) - 1.0
        assert value == pytest.approx(wanted[k], abs=1e-12 * max(1.0, np.abs(wanted[k]).max())), k
    if sense < 0:
        return
    profile, kernel = cam.profile, other.profiles[0]
    for mine_points, other_points in zip(profile.points(phi), kernel.points(phi), strict=True):
        assert np.abs(mine_points - other_points).max() < 1e-11
    assert profile.max_pressure_angle.value == pytest.approx(kernel.max_pressure_angle.value, abs=1e-12)
    assert profile.min_curvature_radius.value == pytest.approx(kernel.min_curvature_radius.value, rel=1e-11)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["slid roller", "slid face", "rocked roller, other side", "rocked face"])
def test_forces_are_those_of_a_disc_cam(name: str) -> None:
    """Contact force and torque of the cam under the follower's inertia and a force against it; a face rubs."""
    mine, other = pair(name)
    slides = other.spec.follower.type.startswith("translating")
    push = {"force": -400.0} if slides else {"torque": 60.0 * mine.structure.cams["main"].away * -1.0}
    body = {"mass": 2.0} if slides else {"mass": 1e-12, "inertia": 0.02}
    of_both: dict[str, Any] = {"forces": [{"on": "follower", **push}], "friction": {"contacts": 0.15}}
    loads = {"speed": 240, "links": {"follower": body}, **of_both}
    one = PlanarLoads(
        PlanarSpec.model_validate(mine.spec.model_dump(exclude_unset=True, by_alias=True) | {"loads": loads})
    )
    file = other.spec.model_dump(exclude_unset=True, by_alias=True)
    two = DiscCamLoads(DiscCamSpec.model_validate(file | {"loads": of_both}))
    joints = one.table("joints", samples=48)
    phi = mine.spec.cams["main"].sense * np.radians(np.arange(0.0, 360.0, 7.5))  # the cam turns with the input
    contact = two.machine.reactions(np.mod(phi, 2.0 * math.pi)).unknowns["main"][0]
    mine_force = np.asarray(joints.data[joints.columns.index("main")])
    assert mine_force == pytest.approx(np.asarray(contact), rel=1e-10, abs=1e-7)
    if mine.spec.cams["main"].sense > 0:  # the other runs backwards, and friction does not
        assert one.raw("input_torque_max") == pytest.approx(two.raw("input_torque_max"), rel=1e-9)


CHAIN: dict[str, Any] = {
    "kind": "planar-mechanism",
    "name": "chain",
    "frame": {"A": [0, 0], "D": [120, 15], "P": [225, 60]},
    "links": {
        "crank": ["A", "B", 32],
        "coupler": {"B": [0, 0], "C": [96, 0]},
        "rocker": {"D": [0, 0], "C": [78, 0]},
        "lever": ["P", "R", 70],
        "rod": ["R", "S", 150],
        "ram": {"S": [0, 0]},
    },
    "slides": {"guide": {"link": "ram", "through": [60, -40], "direction": 90}},
    "cams": {
        "cam": {"cam": "rocker", "follower": "lever", "point": "R", "roller_radius": 9, "phase": 40, "motion": MOTION}
    },
    "drive": {"link": "crank"},
    "start": {"crank": 20, "coupler": 45, "rocker": 115, "lever": 160, "rod": 200},
    "outputs": ["guide", "lever"],
}


@pytest.mark.slow
def test_a_cam_on_a_rocker_moves_a_chain() -> None:
    """Places and rates beyond a cam that swings, against differences of the places on both sides; a mobility of one."""
    design = PlanarMechanism(PlanarSpec.model_validate(CHAIN))
    assert design.degrees_of_freedom == 1
    course = design.course
    assert course.joints  # the swing passes places at which the law changes
    q = np.array([0.4, 2.1, 4.4])
    assert min(abs(a - b) for a in q for b in course.joints) > 0.05
    steps, h = np.arange(-4, 5), 2e-3
    weights = {
        1: np.array([3, -32, 168, -672, 0, 672, -168, 32, -3]) / 840,
        2: np.array([-9, 128, -1008, 8064, -14350, 8064, -1008, 128, -9]) / 5040,
        3: np.array([-7, 72, -338, 488, 0, -488, 338, -72, 7]) / 240,
    }
    for each in (meaning.output for name, meaning in design.meanings.items() if name.endswith("_max")):
        rates = course.derivatives(each.coefficient, course.jets(q, 3), 3)
        rows = course.derivatives(each.coefficient, course.jets((q[:, None] + h * steps).ravel(), 0), 0)[0]
        for order, weight in weights.items():
            wanted = rows.reshape(3, 9) @ weight / h**order
            assert rates[order] == pytest.approx(wanted, rel=1e-5, abs=1e-5 * np.abs(rates[order]).max()), order
    rows = course.derivatives(each.coefficient, course.jets(np.linspace(0.0, course.end, 4001), 2), 2)[2]
    assert design.raw("lever.acceleration_ratio_max") >= rows.max() - 1e-12
    assert design.raw("lever.acceleration_ratio_max") == pytest.approx(rows.max(), rel=1e-3)


def test_a_law_run_through_backwards_has_the_side_of_the_input() -> None:
    """A cam as cut, swinging over the end of a rise that stops with an acceleration: both ways at once, against places
    a little later and earlier."""
    motion = [{"law": "simple-harmonic", **each} if "lift" in each else each for each in MOTION]
    cams = {"cam": {**CHAIN["cams"]["cam"], "phase": 75, "motion": motion}}
    design = PlanarMechanism(PlanarSpec.model_validate({**CHAIN, "cams": cams}))
    course, system, lever = design.course, PlanarSamples(design).system, design.structure.numbers["lever"]
    angles = course.at_start.lifts["cam"].angle(course.jets(np.array(course.joints), 1), 0)
    q = np.array(course.joints)[np.abs(angles - math.radians(110.0)) < 1e-9]
    assert q.size == 2  # there and back

    def bend(places: Any, side: int) -> Any:
        near = course.jets(places, 0)
        return system.onward(Jets(near.x, near.t, side=side), course.walked(places), 2).t[2][:, lever]

    for side in (1, -1):
        assert bend(q, side) == pytest.approx(bend(q + side * 1e-7, side), abs=1e-7)
    assert np.abs(bend(q, 1) - bend(q, -1)).min() > 0.01


@pytest.mark.parametrize(
    ("change", "key"),
    [
        ({"roller_radius": 60}, "cams.main.roller_radius"),
        ({"motion": [{"to": 90, "lift": 9, "law": "constant-velocity"}, {"to": 360, "lift": 0}]}, "cams.main.motion"),
        ({"motion": [{"to": 90, "lift": 9, "mirrored": True}, {"to": 360, "lift": 0}]}, "cams.main.motion[0].law"),
    ],
)
def test_cams_that_cannot_be(change: dict[str, Any], key: str) -> None:
    file = {"kind": "planar-mechanism", "name": "x", "drive": {"link": "cam"}, **CASES["slid roller"][0]}
    file["cams"] = {"main": {**file["cams"]["main"], **change}}
    with pytest.raises(NoSolution) as refused:
        _ = PlanarMechanism(PlanarSpec.model_validate(file)).report("analyze")
    assert refused.value.key == key


@pytest.mark.parametrize("way", [0.0, 45.0, 90.0])
def test_a_roller_square_beside_the_axis_moves_neither_way(way: float) -> None:
    """Where its slide begins, 50 mm beside the axis, in directions whose cosines are rounded."""
    file, _ = _slid(False, way, 1)
    foot = -50j * np.exp(1j * math.radians(way))
    file["slides"]["guide"]["through"], file["start"] = [foot.real, foot.imag], {"guide": 0.0}
    made = PlanarSpec.model_validate({"kind": "planar-mechanism", "name": "x", "drive": {"link": "cam"}, **file})
    with pytest.raises(NoSolution, match="does not move away") as refused:
        _ = PlanarMechanism(made).structure.cams["main"].away
    assert refused.value.fix == "change start.guide"


def test_a_cam_counts_as_one_constraint() -> None:
    file = {"kind": "planar-mechanism", "name": "x", "drive": {"link": "cam"}, **CASES["slid roller"][0]}
    assert PlanarMechanism(PlanarSpec.model_validate(file)).structure.freedoms == 1
    del file["cams"]
    assert PlanarMechanism(PlanarSpec.model_validate(file)).structure.freedoms == 2
