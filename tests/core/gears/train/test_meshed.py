"""Shifts, tools, helix, measures, backlash and strength of the meshes inside geared linkages.

Tolerances
* a mesh against the gear pair of the same data: 1e-12.
* links against the equation of the working pressure angle, solved by bisection: 1e-12 relative.
* backlash against teeth that are turned until they touch: the nearest of 20000 points of a flank, to 1e-9 rad.
"""

import math
from dataclasses import replace

import numpy as np
import pytest
from factory import design
from pydantic import ValidationError

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.spec_paths import changed
from gearlink.core.mechanism.joints import meshes_of
from gearlink.core.parts.gears.drawing_names import RATING
from gearlink.core.parts.gears.keys.pair import PairKeys
from gearlink.core.parts.gears.train.keys import TrainKeys
from gearlink.core.parts.gears.train.meshed import QUANTITIES

DRAWN = {
    "tool": {"rounding": 0.3},
    "face_width": [22.0, 20.0],
    "allowances": {"upper": [-0.05, -0.06], "lower": [-0.08, -0.1]},
    "center_distance_allowance": 0.015,
    "pin_diameter": [3.5, 4.0],
    "rim_thickness": [7.0, 9.0],
    "accuracy_grade": 4,
    "load": {"torque": 45.0, "factors": {"application": 1.25}},
    "material": {"contact_limit": 1400.0, "bending_limit": [430.0, 390.0], "poisson": [0.3, 0.28]},
}
LINKS = {"coupler": 30.0, "rocker": 40.0, "frame": 45.0}
PATH = {
    "links": {"input": 30.0, "coupler": 90.0, "follower": 90.0, "output": 30.0},
    "phase": 60.0,
    "coupler_point": {"along": 40.0},
}
KINDS = {
    "sun": {"kind": "two-gear-four-bar", "gears": {"module": 2.0, "planet": 31, "sun": 19},
            "links": {"coupler": 80.0, "rocker": 90.0, "frame": 20.0}},
    "ring": {"kind": "two-gear-four-bar", "gears": {"module": 2.0, "planet": 48, "ring": 62}, "links": LINKS},
    "rocker": {"kind": "geared-rocker", "gears": {"module": 2.0, "coupler": 28, "output": 20},
               "links": {"crank": 20.0, "coupler": 60.0, "frame": 62.0}},
    "hypocycloid": {"kind": "hypocycloid-dwell", "gears": {"module": 2.0, "planet": 24, "ring": 72},
                    "rod": {"rule": "osculating"}},
    "mutilated": {"kind": "mutilated-gear-dwell", "reduction": 6.0,
                  "gears": {"module": 2.0, "full_teeth": 80, "group_teeth": 20, "driven": 20}},
    "path": {"kind": "geared-five-bar", "gears": {"module": 2.0, "input": 30, "output": 30}, **PATH},
    "path in a ring": {"kind": "geared-five-bar", "gears": {"module": 2.0, "input": 72, "output": 36,
                       "mesh": "internal"}, **PATH},
    "function": {"kind": "geared-five-bar", "form": "function", "gears": {"module": 2.0, "planet": 20, "sun": 40},
                 "links": {"coupler": 30.0, "follower": 120.0, "output": 120.0, "frame": 70.0}, "phase": 0.0},
    "function in a ring": {"kind": "geared-five-bar", "form": "function",
                           "gears": {"module": 2.0, "planet": 24, "ring": 72},
                           "links": {"coupler": 30.0, "follower": 120.0, "output": 120.0, "frame": 70.0},
                           "phase": 0.0},
}  # fmt: skip
THREE = {
    "kind": "three-gear-four-bar",
    "gears": {"module": 2.0, "crank": 24, "idler": 28, "output": 60},
    "links": {"crank": 18.0, "frame": 110.0},
}
SHIFTS = {"sun": [0.1, 0.3], "path in a ring": [-0.1, 0.25]}


def made(name, **gears):
    base = KINDS[name]
    return design(base | {"gears": base["gears"] | gears}, command="analyze")


def shifts_of(name):
    return SHIFTS.get(name, [0.2, -0.05])


def teeth_of(one):
    """Teeth with the ring second, and the places of these gears in the lists of the file."""
    teeth = one.signed_teeth
    return (teeth, (0, 1)) if teeth[0] > 0 else (teeth[::-1], (1, 0))


def flat(value):
    if isinstance(value, (tuple, list)):
        return [one for each in value for one in flat(each)]
    return [-1.0 if value is None else value]


def pair_of_the_same_data(one, places, keys):
    """A gear-pair design of the numbers of a mesh with the places of its gears in the lists."""
    own = {key: value for key, value in keys.items() if key != "load"}
    for key in ("face_width", "pin_diameter", "profile_shift", "rim_thickness"):
        own[key] = [keys[key][i] for i in places]
    own["allowances"] = {key: [values[i] for i in places] for key, values in keys["allowances"].items()}
    own["material"] = {
        key: [value[i] for i in places] if isinstance(value, list) else value for key, value in keys["material"].items()
    }
    teeth, _ = teeth_of(one)
    torque = keys["load"]["torque"] * abs(teeth[0] / one.signed_teeth[0])
    own["load"] = keys["load"] | {"torque": torque}
    return design({"kind": "gear-pair", "module": 2.0, "teeth": list(teeth), **own})


@pytest.mark.quick(9)
@pytest.mark.parametrize("helix", [0.0, 17.0])
@pytest.mark.parametrize("name", KINDS)
def test_a_mesh_is_the_gear_pair_of_the_same_data(name, helix):
    keys = DRAWN | {"profile_shift": shifts_of(name), "helix_angle": helix}
    one = made(name, **keys)
    _, places = teeth_of(one)
    alone = pair_of_the_same_data(one, places, keys)
    both = [q for q in QUANTITIES if q not in one.own_quantities]
    assert len(both) > 60
    for quantity in both:
        mine, theirs = one.raw(quantity), alone.raw(quantity)
        per_gear = isinstance(theirs, tuple) and not quantity.startswith(("backlash_c", "backlash_n"))
        if places == (1, 0) and per_gear:
            theirs = theirs[::-1]
        assert flat(mine) == pytest.approx(flat(theirs), rel=1e-12, abs=1e-13), quantity
    assert one.raw("safety_bending")[0] > 0.0
    assert flat(one.center_distance) == [pytest.approx(alone.raw("center_distance"), rel=1e-14)] * len(
        flat(one.center_distance)
    )


@pytest.mark.quick(3)
@pytest.mark.parametrize("name", KINDS)
def test_checks_are_those_of_the_gear_pair(name):
    keys = DRAWN | {"profile_shift": shifts_of(name), "helix_angle": 12.0}
    one = made(name, **keys)
    alone = pair_of_the_same_data(one, teeth_of(one)[1], keys)
    for check in ("contact-ratio", "undercut", "tip-thickness", "involute-interference", "fillet-interference",
                  "backlash", "pitting", "bending", "tip-fouling"):  # fmt: skip
        mine, theirs = ([(c.code, c.status, c.value) for c in each.check(check)] for each in (one, alone))
        near = [
            (code, status, value if value is None else pytest.approx(value, rel=1e-12))
            for code, status, value in theirs
        ]
        assert mine == near, check


def bisected_distance(module, teeth, shifts, helix):
    """a_w from inv(alpha_wt) = inv(alpha_t) + 2 tan(alpha_n) (x1 + x2)/(z1 + z2), by bisection."""
    beta, alpha = math.radians(helix), math.radians(20.0)
    transverse = math.atan(math.tan(alpha) / math.cos(beta))
    total = sum(teeth)
    wanted = math.tan(transverse) - transverse + 2.0 * math.tan(alpha) * sum(shifts) / total
    low, high = 1e-6, 1.2
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if math.tan(middle) - middle < wanted else (low, middle)
    return abs(0.5 * module / math.cos(beta) * total * math.cos(transverse) / math.cos(low))


@pytest.mark.quick(3)
@pytest.mark.parametrize("helix", [0.0, 17.0])
@pytest.mark.parametrize(
    ("name", "link"),
    [
        ("sun", "crank_length"),
        ("ring", "crank_length"),
        ("rocker", "rocker_length"),
        ("hypocycloid", "carrier_length"),
        ("path", "frame_length"),
        ("path in a ring", "frame_length"),
        ("function", "input_length"),
        ("function in a ring", "input_length"),
    ],
)
def test_links_are_working_centre_distances(name, link, helix):
    one = made(name, profile_shift=shifts_of(name), helix_angle=helix)
    wanted = bisected_distance(2.0, one.signed_teeth, shifts_of(name), helix)
    assert getattr(one, link) == pytest.approx(wanted, rel=1e-12)
    assert all(math.isfinite(shaft.gap) for shaft in one.layout.shaft_pairs)


def test_the_point_of_a_hypocycloid_lies_on_the_working_circle():
    """It stands still where it touches the ring's working circle: a cusp."""
    one = made("hypocycloid", profile_shift=[0.3, 0.1])
    cusp = math.pi / one.cusps
    step = 1e-6
    assert abs(one.slider.point(cusp + step) - one.slider.point(cusp - step)) < 1e-9
    assert abs(one.slider.point(cusp)) == pytest.approx(one.raw("working_radius")[1], rel=1e-13)


def test_an_idler_has_one_tip_and_two_working_circles():
    base = KINDS["path"]
    gears = {"module": 2.0, "input": 30, "idler": 17, "output": 30, "profile_shift": [0.1, 0.4, -0.1]}
    one = design(base | {"gears": gears, "links": base["links"] | {"frame": 70.0}}, command="analyze")
    assert one.raw("input_idler.tip_radius")[1] == one.raw("idler_output.tip_radius")[0]
    assert one.raw("input_idler.center_distance") == one.center_distance[0] > one.center_distance[1]
    assert one.raw("span_measurement") is None
    assert len(one.table("drawing").columns) == 6


# Teeth that are turned until they touch


def _half_tooth(module, z, x, helix, radius):
    """Half the angle of a tooth on a circle; of a ring as of an external gear with the signs of ISO 21771."""
    beta, alpha = math.radians(helix), math.radians(20.0)
    transverse = math.atan(math.tan(alpha) / math.cos(beta))
    at = np.arccos(_base(module, z, helix) / radius)
    half = (0.5 * math.pi + 2.0 * x * math.tan(alpha)) / z
    return np.abs(half + (math.tan(transverse) - transverse) - (np.tan(at) - at))


def _base(module, z, helix):
    beta = math.radians(helix)
    transverse = math.atan(math.tan(math.radians(20.0)) / math.cos(beta))
    return 0.5 * module * abs(z) / math.cos(beta) * math.cos(transverse)


def _free_turn(module, teeth, shifts, helix, distance, tips):
    """Angle by which gear 2 revolutions between its flanks, gear 1 held with a tooth towards it."""
    (z1, z2), external = teeth, teeth[1] > 0
    low = max(abs(distance - tips[1]), _base(module, z1, helix) * (1.0 + 1e-12))
    radius, pitch = np.linspace(low, tips[0], 20_001), 2.0 * math.pi / abs(z2)
    room = []
    for side in (1.0, -1.0):
        left = []
        for k in range(-2, 3):  # the teeth beside may touch first
            point = radius * np.exp(
                1j * (side * _half_tooth(module, z1, shifts[0], helix, radius) + 2.0 * math.pi * k / z1)
            )
            seen = distance - point if external else point + distance  # from axis 2, towards gear 1
            at = np.abs(seen)
            meets = (at > _base(module, z2, helix)) & (at < tips[1] if external else at > tips[1])
            space = 0.5 * pitch - _half_tooth(module, z2, shifts[1], helix, at[meets])
            turn = np.angle(seen[meets]) + (k if external else -k) * pitch
            left.append(np.min(space - (-side if external else side) * turn, initial=math.inf))
        room.append(min(left))
    return sum(room)


@pytest.mark.quick(1)
@pytest.mark.parametrize("helix", [0.0, 20.0])
@pytest.mark.parametrize("name", ["sun", "ring"])
def test_backlash_is_what_turned_teeth_leave(name, helix):
    keys = {key: DRAWN[key] for key in ("allowances", "center_distance_allowance")}
    one = made(name, profile_shift=shifts_of(name), helix_angle=helix, **keys)
    away = 0.015 if one.signed_teeth[1] > 0 else -0.015
    tips = one.raw("tip_radius")
    for end, sign in ((0, -1.0), (1, 1.0)):
        generated = [one.raw("generating_shift")[gear][1 - end] for gear in (0, 1)]
        turned = _free_turn(2.0, one.signed_teeth, generated, helix, one.crank_length + sign * away, tips)
        assert one.raw("backlash_angle")[1][end] == pytest.approx(turned, abs=1e-9)


def test_play_of_an_output_behind_an_idler():
    """Plays add up at the pitch circles: the idler's free turn carries the output along by its teeth."""
    allowances = {"upper": [-0.05, -0.06, -0.07], "lower": [-0.08, -0.1, -0.12]}
    one = design(THREE | {"gears": THREE["gears"] | {"allowances": allowances}}, command="analyze")
    first, second = (one.raw(f"{mesh}.backlash_circumferential") for mesh in one.mesh_names)
    radius = one.raw("idler_output.working_radius")[1]
    assert one.output_play == pytest.approx([(a + b) / radius for a, b in zip(first, second, strict=True)], rel=1e-13)
    assert (
        made("rocker", allowances=DRAWN["allowances"]).output_play
        == made("rocker", allowances=DRAWN["allowances"]).raw("backlash_angle")[1]
    )
    assert made("rocker").output_play is None


# Links of the file beside shifts


def test_a_given_link_beside_shifts_leaves_backlash():
    base = KINDS["rocker"]
    keys = {"profile_shift": [0.1, 0.1]}
    free = design(base | {"gears": base["gears"] | keys}, command="analyze")
    longer = design(
        base | {"gears": base["gears"] | keys, "links": base["links"] | {"rocker": free.rocker_length + 0.05}},
        command="analyze",
    )
    assert longer.rocker_length == pytest.approx(free.rocker_length + 0.05, rel=1e-12)
    play = longer.raw("backlash_circumferential")
    assert play[0] == play[1] == pytest.approx(2.0 * 0.05 * math.tan(longer.raw("working_pressure_angle")), rel=0.02)
    (found,) = longer.check("backlash")
    assert found.status == "pass"
    shorter = base | {"gears": base["gears"] | keys, "links": base["links"] | {"rocker": free.rocker_length - 0.05}}
    (found,) = design(shorter, command="analyze").check("backlash")
    assert found.status == "fail"


def test_a_given_link_without_shifts_is_the_centre_distance():
    base = KINDS["ring"]
    with pytest.raises(NoSolution, match="omit it"):
        design(base | {"links": LINKS | {"crank": 14.1}}, command="analyze").linkage  # noqa: B018


def test_a_synthesis_needs_shifts_that_cancel():
    spec = {
        "kind": "two-gear-four-bar",
        "gears": {"module": 2.0, "planet": 48, "ring": 62, "profile_shift": [0.1, 0.1]},
        "links": {"coupler": 30.0, "rocker": 40.0},
        "target": {"motion": "momentary-dwell"},
    }
    with pytest.raises(NoSolution, match="add up to 0") as refusal:
        design(spec, command="synth momentary-dwell")
    assert refusal.value.key == "gears.profile_shift"


# What is not asked for is not computed


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", KINDS)
def test_a_design_without_the_keys_computes_nothing_of_them(name):
    one = made(name)
    one.report("analyze")
    assert not {"mesh_data", "_own_pairs"} & vars(one).keys()
    shown = {quantity.name.rpartition(".")[2] for quantity in one.report("gear").quantities}
    assert "span_teeth" in shown or "input_idler.span_teeth" in shown
    assert not shown & RATING


@pytest.mark.parametrize("name", KINDS)
def test_analyze_asks_nothing_of_the_rating(name):
    one = made(name, profile_shift=shifts_of(name), load=DRAWN["load"])
    outline = one.outline("analyze")
    assert [one.raw(quantity) for quantity in outline.quantities]
    assert [one.check(check) for check in outline.checks]
    assert "mesh_data" not in vars(one) or one.meshes[""].internal  # whose tips foul


# Load and hands


def test_a_train_takes_every_key_of_a_pair():
    of_the_machine = {"module", "pressure_angle"}
    assert PairKeys.model_fields.keys() - of_the_machine <= TrainKeys.model_fields.keys()


def test_one_force_goes_through_all_meshes():
    gears = THREE["gears"] | {"face_width": 20.0, "load": {"torque": 100.0, "gear": "output"}}
    one = design(THREE | {"gears": gears}, command="analyze")
    forces = [one.raw(f"{mesh}.tangential_force") for mesh in one.mesh_names]
    assert forces == [pytest.approx(100.0e3 / 60.0, rel=1e-14)] * 2
    same = design(THREE | {"gears": gears | {"load": {"tangential_force": forces[0]}}}, command="analyze")
    assert same.raw("idler_output.root_stress") == pytest.approx(one.raw("idler_output.root_stress"), rel=1e-13)
    speed = {"power": 10.0, "speed": 500.0, "gear": "idler"}
    turned = design(THREE | {"gears": gears | {"load": speed}}, command="analyze")
    assert turned.mesh_data["crank_idler"].load.speed == pytest.approx(500.0 * 28 / 24, rel=1e-12)
    assert turned.raw("crank_idler.tangential_force") == pytest.approx(10e3 / (500 * math.pi / 30) / 0.028, rel=1e-12)


def test_teeth_of_an_idler_are_bent_both_ways():
    """IACS UR M56.3.9: seven tenths of what they bear one way, in either mesh."""
    rated = {"face_width": 20.0, "load": {"torque": 100.0}, "material": {"bending_limit": 300.0}}
    one = design(THREE | {"gears": THREE["gears"] | rated}, command="gear")
    for mesh, idler in (("crank_idler", 1), ("idler_output", 0)):
        one_way = replace(one.mesh_data[mesh], idlers=(False, False)).root.safety
        factors = [pytest.approx(0.7 if gear == idler else 1.0, rel=1e-12) for gear in (0, 1)]
        rated_both_ways = one.raw(f"{mesh}.safety_bending")
        assert [found / alone for found, alone in zip(rated_both_ways, one_way, strict=True)] == factors
        assert list(one.raw(f"{mesh}.load_reversal_factor")) == factors
    least = 0.9 * min(replace(data, idlers=(False, False)).root.safety[0] for data in one.mesh_data.values())
    judged = design(THREE | {"gears": THREE["gears"] | rated, "limits": {"safety_bending": least}}, command="gear")
    failing = [check.message for check in judged.check("bending") if check.status == "fail"]
    assert failing
    assert all("idler bent both ways" in message for message in failing)
    path = {"kind": "geared-five-bar", "phase": 40, "coupler_point": {"along": 60}}
    links = {"input": 20, "coupler": 60, "follower": 60, "output": 20, "frame": 70}
    gears = {"module": 2.5, "input": 20, "idler": 30, "output": 30, **rated}
    bars = design({**path, "links": links, "gears": gears}, command="gear")
    assert [data.idlers for data in bars.mesh_data.values()] == [(False, True), (True, False)]


def test_an_idler_is_heated_by_both_of_its_mates():
    """X_mp = 1.5: 0.7 of it and 1.5 of the flash temperature above the oil, in either mesh."""
    oil = {"vg": 220, "viscosity_100": 19, "temperature": 60, "scuffing_stage": 12}
    rating = {"life": 20000, "material": "16MnCr5", "grade": 6, "lubricant": oil}
    keys = {"face_width": 20.0, "load": {"torque": 20.0, "speed": 300.0}, "rating": rating}
    one = design(THREE | {"gears": THREE["gears"] | keys}, command="gear")
    for mesh, data in one.mesh_data.items():
        alone = replace(data, idlers=(False, False)).rated.scuffing.integral_temperature
        rise = (one.raw(f"{mesh}.integral_temperature") - 60.0) / (alone - 60.0)
        assert rise == pytest.approx((0.7 * 1.5 + 1.5) / 2.2, rel=1e-12)


def test_helix_widens_the_links_of_three_gears_and_nothing_else():
    spur = design(THREE, command="analyze")
    gears = THREE["gears"] | {"helix_angle": 15.0}
    scale = 1.0 / math.cos(math.radians(15.0))
    links = {key: value * scale for key, value in THREE["links"].items()}
    helical = design(THREE | {"gears": gears, "links": links}, command="analyze")
    assert helical.coupler_length == pytest.approx(spur.coupler_length * scale, rel=1e-15)
    for name in ("speed_ratio_max", "min_transmission_angle", "acceleration_ratio_max"):
        assert helical.raw(name) == pytest.approx(spur.raw(name), rel=1e-12)


@pytest.mark.parametrize(("crank", "output"), [(24, -82), (-82, 24), (-82, -90)])
def test_rings_of_three_gears_have_teeth_of_their_own(crank, output):
    gears = {"module": 2.0, "crank": crank, "idler": 30, "output": output, "profile_shift": [0.1, 0.2, -0.1]}
    one = design({"kind": THREE["kind"], "gears": gears, "links": {"crank": 8.0, "frame": 60.0}}, command="analyze")
    assert one.coupler_length == pytest.approx(bisected_distance(2.0, (crank, 30), (0.1, 0.2), 0.0), rel=1e-12)
    assert one.rocker_length == pytest.approx(bisected_distance(2.0, (30, output), (0.2, -0.1), 0.0), rel=1e-12)
    assert one.raw("crank_idler.profile_shift") == (0.1, 0.2)
    assert one.raw("crank_idler.reference_radius") == (abs(crank), 30.0)
    inner = next(gear for gear in one.layout.gears if gear.inner > 0.0)
    assert inner.inner < inner.outer


def test_gears_of_a_ring_on_the_crank_stand_in_the_order_of_the_file():
    gears = {"module": 2.0, "crank": -82, "idler": 30, "output": 24, "profile_shift": [0.1, -0.9, 0.9]}
    one = design({"kind": THREE["kind"], "gears": gears, "links": {"crank": 8.0, "frame": 60.0}}, command="analyze")
    table = one.table("drawing")
    rows = list(zip(*(table.data[i] for i in (0, 1, 3, 4)), strict=True))
    assert ("crank_idler", "number of teeth", -82, 30) in rows
    assert ("idler_output", "number of teeth", 30, 24) in rows
    (idler,) = [
        check
        for check in one.check("undercut")
        if check.message.startswith("crank-idler") and "gear 2" in check.message
    ]
    assert "crank-idler mesh: profile shift x of gear 2 (30 teeth)" in idler.message


def test_hands_are_given_or_follow_from_the_meshes():
    gears = THREE["gears"] | {"helix_angle": 15.0}
    assert design(THREE | {"gears": gears}).spec.gears.hands() == ["right", "left", "right"]
    given = design(THREE | {"gears": gears | {"helix_hand": ["left", "right", "left"]}})
    assert ("idler_output", "hand of helix", "right", "left") in list(
        zip(*(given.table("drawing").data[i] for i in (0, 1, 3, 4)), strict=True)
    )
    assert made("ring", helix_angle=10.0).spec.gears.hands() == ["right", "right"]


# Input


@pytest.mark.parametrize(
    ("name", "keys"),
    [
        ("ring", {"profile_shift": [0.1]}),
        ("ring", {"profile_shift": [0.1, 6.0]}),
        ("sun", {"cutter": {"teeth": 20}}),
        ("sun", {"assembly": "radial"}),
        ("rocker", {"face_width": [10.0, 10.0, 10.0]}),
        ("rocker", {"helix_hand": ["right", "left"]}),
        ("rocker", {"helix_angle": 10.0, "helix_hand": ["right", "right"]}),
        ("ring", {"helix_angle": 10.0, "helix_hand": ["right", "left"]}),
        ("hypocycloid", {"load": {}}),
        ("hypocycloid", {"load": {"torque": 5.0, "gear": "sun"}}),
        ("mutilated", {"material": {"bending_limit": [400.0, 400.0, 400.0]}}),
        ("path", {"span_teeth": [3, 0]}),
        ("path", {"tool": [{"rounding": 0.3}]}),
        ("path", {"tip_shortening": [0.0]}),
        ("path", {"edition": 2007}),
    ],
)
def test_refusals_of_the_file(name, keys):
    with pytest.raises(ValidationError):
        made(name, **keys)


@pytest.mark.parametrize(
    ("name", "keys", "key"),
    [
        ("path", {"span_teeth": [3, 31]}, "gears.span_teeth[1]"),
        ("ring", {"cutter": {"teeth": 62}}, "gears.cutter.teeth"),
        ("ring", {"rim": 65.0, "addendum": 1.6}, "gears.rim"),
        ("path", {"allowances": {"series": "25cd"}, "module": 2000.0}, "gears.allowances.series"),
        ("path", {"tool": {"addendum": 2.9}}, "gears.tool"),
    ],
)
def test_refusals_name_their_key(name, keys, key):
    with pytest.raises(NoSolution) as refusal:
        made(name, **keys).report("gear")
    assert refusal.value.key == key


@pytest.mark.parametrize(
    ("name", "key"), [("ring", "ring"), ("function in a ring", "ring"), ("path in a ring", "input")]
)
def test_a_ring_whose_tips_have_no_involute_is_refused_at_its_teeth(name, key):
    """Quantities, findings and table named teeth[1], which no such file has."""
    one = made(name, addendum=2.9)
    for asked in (
        lambda: one.report("gear"),
        lambda: one.quantity("tip_fouling_margin"),
        lambda: one.table("drawing"),
    ):
        with pytest.raises(NoSolution, match="tip radius of the ring") as refusal:
            asked()
        assert refusal.value.key == f"gears.{key}"


def test_a_ring_whose_tips_have_no_involute_still_has_its_findings():
    gears = {"module": 2, "planet": 20, "ring": 25, "center_distance_allowance": "js7", "load": {"torque": 5.0}}
    spec = {"kind": "two-gear-four-bar", "gears": gears, "links": LINKS}
    report = design(spec, command="analyze").report("gear")
    assert {check.status for check in report.checks if check.code == "GL204"} == {"fail"}


def test_what_a_quantity_needs_is_said():
    one = made("ring", load={"torque": 5.0})
    assert one.needs("safety_bending") == "give gears.face_width, gears.material.bending_limit"
    assert one.needs("tangential_force") == ""
    assert made("sun").needs("backlash_normal") == "give gears.allowances"


# Remedies


@pytest.mark.quick(3)
@pytest.mark.parametrize(
    ("name", "keys", "check"),
    [
        ("sun", {"allowances": {"upper": [0.02, 0.0], "lower": [-0.02, -0.03]}}, "backlash"),
        ("ring", {"allowances": {"upper": [0.02, 0.0], "lower": [-0.02, -0.03]}}, "backlash"),
        ("rocker", {"tool": {"rounding": 0.3}, "profile_shift": [-0.8, 0.0]}, "undercut"),
        ("path", {"clearance": 0.02}, "root-clearance"),
        ("hypocycloid", {"load": {"torque": 90.0}, "face_width": 10.0, "material": {"bending_limit": 200.0}},
         "bending"),
        ("mutilated", {"load": {"torque": 90.0}, "face_width": [9.0, 9.0], "material": {"contact_limit": 500.0}},
         "pitting"),
        pytest.param(
            "function", {"tool": {"rounding": 0.38}, "addendum": 1.17, "profile_shift": [-0.3, 0.3]},
            "fillet-interference", marks=pytest.mark.slow),  # of all other checks together
        ("ring", {"assembly": "radial"}, "radial-assembly"),
        ("ring", {"ring": 54, "tool": {}}, "tip-fouling"),
    ],
)  # fmt: skip
def test_remedies_repair_what_they_are_for(name, keys, check):
    one = made(name, **keys)
    found = one.findings("gear", check)
    failing = [index for index, finding in enumerate(found) if finding.status == "fail"]
    assert failing, [(finding.status, finding.message) for finding in found]
    for index in failing:
        assert found[index].remedy, found[index].message
        mended = type(one)(changed(one.spec, found[index].remedy))
        again = mended.check(check)
        assert len(again) == len(found)
        assert again[index].status != "fail"
        mended.require("gear")


# Loads


def loaded(name, **gears):
    base = KINDS[name]
    loads = {"speed": 60.0, "forces": [{"on": "output", "torque": -5.0}]}
    return design(base | {"loads": loads, "gears": base["gears"] | gears}, command="loads")


@pytest.mark.parametrize("name", ["sun", "ring", "rocker", "path", "path in a ring", "function", "function in a ring"])
def test_loads_roll_on_the_working_circles(name):
    machine = loaded(name, profile_shift=[0.1, 0.17], helix_angle=14.0)
    (mesh,) = meshes_of(machine.moving.at(np.linspace(0.0, 6.0, 4)))
    distance = mesh.radius - mesh.mate_radius if mesh.internal else mesh.radius + mesh.mate_radius
    assert distance == pytest.approx(machine.design.distance(), rel=1e-14)
    radii = {round(radius, 9) for radius in (mesh.radius, mesh.mate_radius)}
    assert radii == {round(radius, 9) for radius in machine.design.raw("working_radius")}
    assert math.atan(mesh.tangent) == pytest.approx(machine.design.raw("working_pressure_angle"), rel=1e-14)


@pytest.mark.parametrize("name", ["sun", "ring", "rocker"])
def test_input_torque_of_shifted_gears_by_virtual_work(name):
    machine = loaded(name, profile_shift=[0.1, 0.17], helix_angle=14.0)
    for end in ("max", "min"):
        wanted = 5.0 * machine.design.raw(f"speed_ratio_{end}")
        assert machine.raw(f"input_torque_{end}") == pytest.approx(wanted, rel=1e-6, abs=1e-9)
