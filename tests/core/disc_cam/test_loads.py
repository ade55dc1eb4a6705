"""Forces on a follower: equilibrium by the joints against the closed forms along the lift."""

from __future__ import annotations

import math
import re
from typing import Any

import factory
import numpy as np
import pytest

from gearlink.core.base.errors import NoSolution

MOTION = [
    {"to": 120, "lift": 10, "law": "cycloidal"},
    {"to": 180},
    {"to": 300, "lift": 0, "law": "cycloidal"},
    {"to": 360},
]
SLIDE = {
    "kind": "disc-cam",
    "name": "cam",
    "speed": 400,
    "motion": MOTION,
    "follower": {"type": "translating-roller", "roller_radius": 10, "mass": 1.8, "offset": 6, "direction": 60},
    "cam": {"prime_radius": 40},
    "spring": {"preload": 60, "rate": 15},
    "loads": {"roller": {"width": 15}, "gravity": [0, -9.81], "forces": [{"on": "follower", "force": -12}]},
}
FLAT = {"type": "translating-flat", "mass": 1.8, "direction": 60}
EDGE = {"type": "translating-knife-edge", "mass": 1.8, "offset": 6, "direction": 60}
ROCKING_FLAT = {"type": "oscillating-flat", "center_distance": 120, "face_offset": 4, "inertia": 0.02}
PHI = np.linspace(0.0, 2.0 * math.pi, 361)[:-1]


def loads(**keys: Any) -> Any:
    return factory.design({**SLIDE, **keys}, command="loads")


@pytest.mark.parametrize("follower", [SLIDE["follower"], FLAT], ids=["roller", "flat"])
def test_a_pressure_without_a_width_is_told_of_any_contact(follower: dict[str, Any]) -> None:
    cam = {"prime_radius": 40} if follower is not FLAT else {"base_radius": 40}
    told = loads(follower=follower, cam=cam, loads={"material": {"allowed_pressure": 700}}).check("contact-pressure")
    assert [check.what for check in told] == ["no contact pressure without the width of the contact"]


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("follower", [SLIDE["follower"], FLAT, EDGE], ids=["roller", "flat", "edge"])
def test_the_force_of_the_joints_is_that_along_the_lift(sense: int, follower: dict[str, Any]) -> None:
    body = {"prime_radius": 40} if follower is SLIDE["follower"] else {"base_radius": 40}
    section = {key: value for key, value in SLIDE["loads"].items() if follower is not EDGE or key != "roller"}
    design = loads(follower=follower, cam={**body, "sense": sense}, loads=section)
    assert design.contact_force("main", PHI) == pytest.approx(design.closing.contact_force(PHI), rel=1e-11)
    torque = sense * design.machine.torque(PHI)
    assert torque == pytest.approx(design.cam_torque(PHI), abs=1e-11)


@pytest.mark.quick(1)
@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("touching", ["roller", "flat", "edge"])
def test_the_same_of_a_rocker(side: int, touching: str) -> None:
    arm = {"arm": 90, "center_distance": 120, "inertia": 0.02}
    follower: dict[str, Any] = {"type": "oscillating-roller", "roller_radius": 10, **arm}
    body = {"prime_radius": 60}
    if touching != "roller":
        body = {"base_radius": 45 if touching == "flat" else 60}
        follower = ROCKING_FLAT if touching == "flat" else {"type": "oscillating-knife-edge", **arm}
    spring, section = {"preload": 6, "rate": 9}, {"forces": [{"on": "follower", "torque": 0.7}]}
    design = loads(follower={**follower, "side": side}, cam=body, spring=spring, loads=section)
    assert design.contact_force("main", PHI) == pytest.approx(design.closing.contact_force(PHI), rel=1e-10)
    assert design.machine.torque(PHI) == pytest.approx(design.cam_torque(PHI), abs=1e-11)


def test_the_follower_leaves_its_cam_at_the_speed_of_lift_off() -> None:
    speed = loads().lift_off_speed
    below, above = (loads(speed=share * speed).raw("contact_force_min") for share in (0.999, 1.001))
    assert above < 0.0 < below
    assert loads(speed=speed).raw("contact_force_min") == pytest.approx(0.0, abs=1e-8)


ROCKER = {"type": "oscillating-roller", "roller_radius": 10, "arm": 90, "center_distance": 120, "inertia": 0.02}
STRAIN = {"between": ["frame", "follower"], "points": [[30, 190], [12, 5]], "rate": 0.4, "free_length": 60}


@pytest.mark.parametrize("rocks", [False, True])
def test_what_acts_at_points_and_what_resists_count_at_the_speed_of_lift_off(rocks: bool) -> None:
    acting = [{"on": "follower", "resistance": 1.3}, {"on": "follower", "force": [9, -7], "point": [14, 6]}]
    given: dict[str, Any] = {"loads": {"forces": acting, "springs": [STRAIN], "gravity": [0, -9.81]}}
    if rocks:
        given |= {"follower": ROCKER, "cam": {"prime_radius": 60}, "spring": {"preload": 14, "rate": 9}}
    speed = loads(**given).lift_off_speed
    assert loads(**given, speed=speed).raw("contact_force_min") == pytest.approx(0.0, abs=1e-7)
    given["loads"]["forces"] = given["loads"]["springs"] = []
    assert loads(**given).lift_off_speed != pytest.approx(speed, rel=0.01)


@pytest.mark.quick(2)
@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("follower", [SLIDE["follower"], FLAT, ROCKER], ids=["roller", "flat", "rocker"])
def test_friction_counts_in_the_torque_on_the_cam_and_the_width(sense: int, follower: dict[str, Any]) -> None:
    """The torque is that of the shaft less what the pin O takes, mu r |O|; the pressure falls with the root of b."""
    friction = {"pins": 0.1, "pin_radius": 9, "guides": 0.14} | ({"contacts": 0.1} if follower is FLAT else {})
    if follower is ROCKER:
        del friction["guides"]
    section = {"roller": {"width": 15}, "material": {"allowed_pressure": 300}, "friction": friction}
    body = {"base_radius": 40} if follower is FLAT else {"prime_radius": 60}
    given = {"follower": follower, "cam": {**body, "sense": sense}, "spring": {"preload": 90, "rate": 15}}
    design = loads(**given, loads=section)
    borne = abs(design.machine.reactions(PHI).force("O"))
    assert design.cam_torque(PHI) == pytest.approx(sense * (design.machine.torque(PHI) - 9e-4 * borne), abs=1e-9)
    wide = loads(**given, loads=section | {"roller": {"width": design.face_width_needed}})
    assert wide.raw("hertz_pressure_max") == pytest.approx(300.0, rel=1e-9)


def test_the_preload_of_the_fix_is_in_the_unit_of_the_follower() -> None:
    rocks = {"type": "oscillating-roller", "roller_radius": 10, "arm": 90, "center_distance": 120, "inertia": 0.2}
    for follower, unit in ((SLIDE["follower"], "N"), (rocks, "N m")):
        keys = {"follower": follower, "spring": {"preload": 1}, "cam": {"prime_radius": 60}, "loads": None}
        design = factory.design(dict(SLIDE, **keys))
        (check,) = [each for each in design.check("lift-off") if each.code == "GL406"]
        assert check.status == "fail"
        assert re.fullmatch(rf"increase spring.preload to [\d.]+ {unit} \(10 % speed margin\)", check.advice)


@pytest.mark.quick(3)
@pytest.mark.parametrize("follower", ["translating-roller", "translating-flat", "oscillating-roller"])
@pytest.mark.parametrize("sized", [True, False])
def test_a_cam_within_its_shaft_is_told_the_radius_with_which_it_is_not(follower: str, sized: bool) -> None:
    flat = "flat" in follower
    keys: dict[str, Any] = {"type": follower} | ({} if flat else {"roller_radius": 10})
    if follower.startswith("oscillating"):
        keys |= {"arm": 90} if sized else {"arm": 90, "center_distance": 105}
    radius, size = ("base_radius", "curvature_radius") if flat else ("prime_radius", "pressure_angle")
    small: dict[str, Any] = {"size": {size: 20 if flat else 40}} if sized else {radius: 28}
    data: dict[str, Any] = {
        "kind": "disc-cam",
        "motion": [{"to": 180, "lift": 5}, {"to": 360, "lift": 0}],
        "follower": keys,
    }
    (check,) = factory.design(data | {"cam": small | {"shaft_radius": 30}}, command="cam").check("shaft-clearance")
    words = f"replace cam.size by cam.{radius}:" if sized else f"set cam.{radius} to"
    told = re.fullmatch(rf"{words} ([\d.]+)(?:, with follower.center_distance: ([\d.]+))?", check.fix)
    assert check.status == "fail"
    assert told is not None
    if told[2]:
        keys = keys | {"center_distance": float(told[2])}
    larger = {radius: float(told[1]), "shaft_radius": 30}
    (again,) = factory.design(data | {"follower": keys, "cam": larger}, command="cam").check("shaft-clearance")
    assert again.status == "pass"


def test_the_least_preload_keeps_the_least_force() -> None:
    design = loads(spring={"rate": 15, "least_force": 40})
    along = design.contact_force("main", PHI) * np.cos(design.design.cams.main.pressure_angle(PHI))
    assert along.min() == pytest.approx(40.0, rel=1e-4)
    assert design.closing.force(np.linspace(0.0, 6.283, 20_001)).min() == pytest.approx(40.0, rel=1e-7)


def test_the_width_that_is_needed_has_the_allowed_pressure() -> None:
    design = loads(loads={"roller": {"width": 15}, "material": {"allowed_pressure": 300}})
    wide = loads(loads={"roller": {"width": design.face_width_needed}, "material": {"allowed_pressure": 300}})
    assert wide.raw("hertz_pressure_max") == pytest.approx(300.0, rel=1e-9)


def test_a_conjugate_pair_carries_either_sense() -> None:
    keys: dict[str, Any] = {"closure": "conjugate", "return_roller": {"radius": 10}, "spring": None}
    design = loads(**keys, loads={"roller": {"width": 15, "preload": 200}}, follower={**SLIDE["follower"], "offset": 0})
    one, other = (design.contact_force(name, PHI) for name in ("main", "return"))
    assert one - other == pytest.approx(design.side_force(PHI), rel=1e-12, abs=1e-10)
    assert [len(design.raw(name)) for name in ("contact_force_max", "hertz_pressure_max")] == [2, 2]


@pytest.mark.quick(1)
@pytest.mark.parametrize("side", [1, -1])
def test_both_rollers_of_a_conjugate_pair_on_one_side_are_refused(side: int) -> None:
    """Along the arc of its arm each roller must leave the cam axis as the other comes nearer."""
    given = {"closure": "conjugate", "spring": None, "cam": {"prime_radius": 60}, "loads": {"roller": {"width": 15}}}
    pair = {"radius": 10, "arm": 90}
    follower = {**ROCKER, "side": side}
    for angle in (-40, 20, 70, 150):
        design = loads(follower=follower, return_roller={**pair, "angle": side * angle}, **given)
        psi = math.pi - side * (math.acos((90**2 + 120**2 - 60**2) / (2 * 90 * 120)) + np.radians([0.0, 10.0]))
        arms = np.exp(1j * np.array([psi, psi + math.radians(side * angle)]))
        apart = np.sign(((120 + 90 * arms).conj() * 1j * arms).real)
        if np.all(apart[0] == -apart[1]):
            assert min(design.contact_force_max) > 0.0
        else:
            with pytest.raises(NoSolution, match="push the rocker the same way"):
                _ = design.contact_force_max


def test_the_preload_of_a_conjugate_pair_is_parted_by_the_stiffness() -> None:
    """With the preload that is needed one roller is about to open and none does; each takes its share of the force."""
    keys: dict[str, Any] = {"closure": "conjugate", "return_roller": {"radius": 10}, "spring": None}
    keys |= {"follower": {**SLIDE["follower"], "offset": 0}}
    roller = {"width": 15, "stiffness": [1e5, 3e5]}
    needed = loads(**keys, loads={"roller": roller}).preload_needed
    design = loads(**keys, loads={"roller": {**roller, "preload": needed}})
    phi = np.linspace(0.0, 2.0 * math.pi, 7201)
    one, other = (design.contact_force(name, phi) for name in ("main", "return"))
    assert one == pytest.approx(needed + 0.25 * design.side_force(phi), rel=1e-9, abs=1e-9)
    assert min(one.min(), other.min()) == pytest.approx(0.0, abs=1e-4 * needed)
    assert [check.status for check in design.check("preload")] == ["pass"]


def test_a_pair_that_changes_cams_is_told_the_preload_that_holds_it() -> None:
    """Followed as it is written, the advice leaves neither a strike nor a roller that opens."""
    keys: dict[str, Any] = {"closure": "conjugate", "return_roller": {"radius": 10}, "spring": None}
    keys |= {"follower": {**SLIDE["follower"], "offset": 0}}
    (found,) = loads(**keys).check("load-reversal")
    key, value = re.fullmatch(r"set (\S+) to ([\d.]+)", found.fix).groups()  # type: ignore[union-attr]
    assert (found.status, key) == ("warn", "loads.roller.preload")
    design = loads(**keys, loads={**SLIDE["loads"], "roller": {"width": 15, "preload": float(value)}})
    assert [check.status for name in ("load-reversal", "preload") for check in design.check(name)] == ["pass"]


@pytest.mark.parametrize("key", ["preload", "stiffness"])
@pytest.mark.parametrize("closure", ["groove", "spring"])
def test_one_roller_has_no_preload(closure: str, key: str) -> None:
    """It silenced GL602 of a groove, and did nothing."""
    value = 50 if key == "preload" else [1e5, 1e5]
    design = loads(closure=closure, loads={"roller": {"width": 15, key: value}})
    with pytest.raises(NoSolution, match="two rollers of one follower") as refused:
        _ = design.power_identity
    assert refused.value.key == f"loads.roller.{key}"


def test_a_roller_that_changes_walls_is_told_what_holds_it() -> None:
    follower, quick = {**SLIDE["follower"], "offset": 0}, {"closure": "groove", "loads": {"roller": {"width": 15}}}
    design = loads(**quick, spring=None, follower=follower)
    (found,) = design.check("load-reversal")
    assert found.what.startswith("the roller changes walls 2 times")
    assert found.fix == "give spring: {preload: N, rate: N/mm}, which keeps the roller on one wall"
    strong = loads(**quick, follower=follower, speed=100)
    assert [check.status for check in strong.check("load-reversal")] == ["pass"]


def test_a_flat_face_has_a_pressure_and_no_roller() -> None:
    section = {"roller": {"width": 15, "inertia": 1e-5}, "material": {"allowed_pressure": 300}}
    design = loads(follower=FLAT, cam={"base_radius": 40}, loads=section)
    assert design.raw("roller_speed_max") is None
    assert design.raw("traction_needed") is None
    assert "roller_speed" not in design.table("contact").columns
    expected = np.sqrt(
        design.contact_force("main", PHI) * 113_186.813 / (math.pi * 15.0 * design.closing.relative_radius(PHI))
    )
    assert design.raw("hertz_pressure_max") == pytest.approx(expected.max(), rel=1e-4)


def test_a_spring_that_does_not_reach_holds_at_no_speed() -> None:
    lowered = [{"to": 90, "lift": -8, "law": "cycloidal"}, {"to": 200, "lift": 0}, {"to": 360}]
    design = factory.design({**SLIDE, "motion": lowered, "loads": None}, command="cam")
    assert design.lift_off_speed == 0.0
    assert [check.status for check in design.check("lift-off")] == ["fail"]


@pytest.mark.quick(1)
@pytest.mark.parametrize("follower", [FLAT, {**SLIDE["follower"], "offset": 0}], ids=["flat", "roller"])
def test_a_follower_without_a_spring_is_told_a_preload_that_holds_it(follower: dict[str, Any]) -> None:
    cam = {"base_radius": 40} if follower is FLAT else SLIDE["cam"]
    given = {"follower": follower, "cam": cam, "loads": {"roller": {"width": 15}}, "speed": 600}
    design = loads(**given, spring=None)
    (found,) = design.check("contact-loss")
    assert found.status == "fail"
    ((_, preload),) = next(iter(design.candidates("contact-loss")))
    for share, holds in ((1.0, True), (1.0 / 1.2, False)):
        (after,) = loads(**given, spring={"preload": share * preload}).check("contact-loss")
        assert (after.value > 0.0) is holds


@pytest.mark.quick(1)
@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("follower", [FLAT, EDGE], ids=["flat", "edge"])
def test_what_slides_on_the_cam_rubs(follower: dict[str, Any], sense: int) -> None:
    """N (n.u - mu w t.u) = F along the travel u, w the sense of sliding along t; the torque by the power of all forces.

    The guide takes what is across without friction.
    """
    section = SLIDE["loads"] if follower is FLAT else {k: v for k, v in SLIDE["loads"].items() if k != "roller"}
    given = {"follower": follower, "cam": {"base_radius": 40, "sense": sense}, "spring": {"preload": 90, "rate": 15}}
    plain, rubbing = (loads(**given, loads=section | more) for more in ({}, {"friction": {"contacts": 0.12}}))
    cams, force = plain.design.cams, plain.closing.force(PHI)
    lift, rate = cams.motion.evaluate(PHI, 1)
    if follower is FLAT:
        normal, place = np.full(PHI.size, cams.direction), cams.flat.touch(PHI).point
    else:
        normal = cams.main.normals(PHI)
        place = cams.direction * (cams.start_height + lift - 1j * cams.place.offset)
    tangent = 1j * normal
    sliding = ((rate * cams.direction - 1j * sense * place) * tangent.conj()).real
    across, along = ((each * np.conj(cams.direction)).real for each in (tangent, normal))
    pressed = force / (along - 0.12 * np.sign(sliding) * across)
    assert rubbing.contact_force("main", PHI) == pytest.approx(pressed, rel=1e-12)
    torque = 1e-3 * (force * rate + 0.12 * pressed * np.abs(sliding))
    assert rubbing.machine.torque(PHI) == pytest.approx(torque, rel=1e-11, abs=1e-13)
    assert rubbing.power_identity == pytest.approx(0.0, abs=1e-12)
    named = loads(**given, loads=section | {"friction": {"joints": {"main": 0.12}}})
    assert named.machine.torque(PHI) == pytest.approx(torque, rel=1e-11, abs=1e-13)


def test_a_roller_does_not_slide() -> None:
    with pytest.raises(NoSolution, match="no joint 'main'"):
        _ = loads(loads=SLIDE["loads"] | {"friction": {"joints": {"main": 0.1}}}).friction
    rolling = loads(loads=SLIDE["loads"] | {"friction": {"contacts": 0.1}})
    assert rolling.machine.torque(PHI) == pytest.approx(loads().machine.torque(PHI), rel=1e-12, abs=1e-13)
