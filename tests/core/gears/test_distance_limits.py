"""Pairs of gears whose axes stand as near to each other, or as far apart, as the drawing lets them.

Tolerances
* contact ratio and interference against tip circles cut with the common base tangent in the plane: 1e-9 modules.
* tips against roots by their circles: 1e-12 of the size.
"""

import math
import random

import pytest
from factory import design
from sweeps import ALL

from gearlink.core.parts.gears.codes import AT_LIMITS


def at_limits(made):
    return [check for name in AT_LIMITS for check in made.check(name)]


def drawn(rng, *, ring):
    planet = rng.randint(12, 60)
    teeth = [planet, -rng.randint(planet + 12, planet + 60)] if ring else [planet, rng.randint(12, 90)]
    data = {"kind": "gear-pair", "module": rng.choice([0.5, 1.0, 4.0]), "teeth": teeth,
            "pressure_angle": rng.choice([17.5, 20.0, 25.0]),
            "profile_shift": [round(rng.uniform(-0.2, 0.3), 2), round(rng.uniform(-0.5, 0.0 if ring else 0.4), 2)],
            "clearance": round(rng.uniform(0.1, 0.3), 2)}  # fmt: skip
    data["center_distance_allowance"] = round(data["module"] * rng.uniform(0.05, 0.7), 3)
    if rng.random() < 0.6:
        thin = -round(data["module"] * rng.uniform(0.0, 0.6), 3)
        data["allowances"] = {"upper": [thin, 0.0], "lower": [thin - 0.1, -0.1]}
    return data


def in_the_plane(made, off):
    """Contact ratio, least way from a tip to the mate's base tangent point, and both tips over both roots [mm]."""
    pair = made.gear_pair
    sign = 1.0 if pair.teeth[1] > 0 else -1.0
    (tip1, tip2), (root1, root2) = ([abs(each) for each in radii] for radii in (pair.tip_radius, pair.root_radius))
    base1, base2 = (abs(each) for each in pair.base_radius)
    distance = abs(pair.center_distance) + sign * off
    # Along the common tangent of the base circles, from where it touches that of gear 1.
    end2 = sign * math.sqrt(distance**2 - (base1 + sign * base2) ** 2)
    way1, way2 = math.sqrt(tip1**2 - base1**2), math.sqrt(tip2**2 - base2**2)
    start = end2 - way2 if sign > 0.0 else -abs(end2) + way2
    pitch = 2.0 * math.pi * base1 / pair.teeth[0]
    eps = (way1 - start) / pitch
    beyond = min(start, end2 - way1) if sign > 0.0 else start
    tangent = 2.0 * math.tan(pair.pressure_angle)
    thin = [0.0, 0.0] if made.spec.allowances is None else [-each / tangent for each in made.spec.allowances.upper]
    if sign > 0.0:
        rooms = (distance - tip1 - root2 + thin[1], distance - tip2 - root1 + thin[0])
    else:
        rooms = (root2 + thin[1] - distance - tip1, tip2 - distance - root1 + thin[0])
    return eps, beyond, rooms


@pytest.mark.quick(1)
@pytest.mark.parametrize("ring", [False, True])
def test_what_fails_at_the_limits_alone_is_told(ring):
    rng, seen = random.Random(11 + ring), dict.fromkeys(("GL203", "GL204", "GL205"), 0)
    for _ in range(250 if ALL else 120):
        data = drawn(rng, ring=ring)
        made = design(data, command="gear")
        if made.gear_pair.interference_margin[1] < 0.0 and ring:
            continue
        off = data["center_distance_allowance"]
        if abs(made.gear_pair.center_distance) - off < abs(sum(made.gear_pair.base_radius)):
            continue  # refused: no pressure angle is left
        told = {check.code for check in at_limits(made)} - {"GL206"}
        (eps, beyond, rooms), (apart, *_), (_, close, tight) = (in_the_plane(made, each) for each in (0.0, off, -off))
        nominal = {check.code for name in ("contact-ratio", "involute-interference", "root-clearance")
                   for check in made.check(name) if check.status == "fail"}  # fmt: skip
        wanted = {"GL203"} if apart < 1.0 <= eps else set()
        wanted |= {"GL204"} if close < 0.0 <= beyond else set()
        wanted |= {"GL205"} if any(now <= 0.0 for now in tight) and min(rooms) > 0.0 else set()
        assert told - nominal == wanted - nominal, data
        for code in wanted:
            seen[code] += 1
    assert min(seen.values()) > (5 if ALL else 1)


def test_a_drawing_of_usual_fits_says_nothing():
    for name in ("drawn_feed", "drawn_lever", "drawn_ring", "gear_pair", "rack_drive"):
        made = design(name, command="gear")
        assert at_limits(made) == [], name


def test_remedy_holds():
    data = {"kind": "gear-pair", "module": 0.5, "teeth": [30, 60], "profile_shift": [0, 0],
            "allowances": {"upper": [-0.2, -0.2], "lower": [-0.25, -0.25]},
            "center_distance_allowance": 0.45}  # fmt: skip
    failed = [check for check in design(data, command="gear").report("gear").checks if check.status == "fail"]
    assert {check.name for check in failed} <= set(AT_LIMITS)
    assert "GL203" in {check.code for check in failed}
    ((path, value),) = failed[0].remedy
    assert path == "center_distance_allowance"
    assert at_limits(design(data | {path: value}, command="gear")) == []


def test_ring_tips_foul_at_a_limit():
    """Where play lets the pinion lean on one flank, its tips meet the ring's on the other side: pairs drawn as polygons
    overlapped by 0.018 mm there, by nothing at the nominal distance."""
    data = {"kind": "gear-pair", "module": 2.0, "teeth": [30, -38], "profile_shift": [0.0, -0.1],
            "tip_shortening": [-0.1, -0.2], "center_distance_allowance": 0.4}  # fmt: skip
    made = design(data, command="gear")
    assert [check.status for check in made.check("tip-fouling")] == ["pass"]
    (told,) = (check for check in at_limits(made) if check.code == "GL206")
    pair = made.gear_pair
    placed = {
        "center_distance": abs(pair.center_distance) - 0.4,
        "tip_diameter": [2.0 * abs(r) for r in pair.tip_radius],
    }
    left = {key: value for key, value in data.items() if key not in ("tip_shortening", "center_distance_allowance")}
    (direct,) = design(left | placed, command="gear").check("tip-fouling")
    assert (told.status, direct.status) == ("fail", "fail")
    assert told.value == pytest.approx(direct.value, rel=1e-9)


def test_a_rack_too_far_from_its_gear():
    data = {"kind": "gear-pair", "module": 1.0, "teeth": [20, "rack"], "profile_shift": [0, 0],
            "center_distance_allowance": 0.1}  # fmt: skip
    assert at_limits(design(data, command="gear")) == []
    sine, pitch = math.sin(math.radians(20.0)), math.pi * math.cos(math.radians(20.0))
    base = 10.0 * math.cos(math.radians(20.0))
    for off in (0.2, 0.3, 0.4, 0.6):
        # Path from the rack's tip line, off the datum line by 1 module, to the gear's tip circle.
        eps = (math.sqrt(121.0 - base**2) - 10.0 * sine + (1.0 - off) / sine) / pitch
        found = {check.code for check in at_limits(design(data | {"center_distance_allowance": off}, command="gear"))}
        assert ("GL203" in found) == (eps < 1.0), (off, eps)
        assert ("GL205" in found) == (off >= 0.25)


def test_a_drive_that_the_file_lets_be_interrupted_is_told():
    data = {"kind": "gear-pair", "module": 1.0, "teeth": [20, "rack"], "profile_shift": [0, 0],
            "center_distance_allowance": 0.9, "limits": {"contact_ratio": 0.5}}  # fmt: skip
    (found,) = (check for check in at_limits(design(data, command="gear")) if check.code == "GL203")
    assert (found.status, found.limit, 0.5 < found.value < 1.0) == ("warn", 1.0, True)
