"""Random designs of every kind with gears against a brute force over all bodies (tests/oracles/bodies.py).

Tolerance: four rounds of 1,440 samples narrow the cycle 720-fold each, so that a flat minimum is met to rounding; gaps
are compared at 1e-9 of the largest length of the design, also at the input angle that the engine names. A gap nearer to
its limit than that may be judged either way.
"""

from __future__ import annotations

import math
from collections import Counter
from random import Random
from typing import Any

import pytest
from factory import design
from oracles.bodies import Machine, machine

from gearlink.core.base.errors import NoSolution

MODULES = (1, 1.25, 2, 2.5, 4)
Data = dict[str, Any]


def turning_links(random: Random, coupler: float, rocker: float) -> tuple[float, float] | None:
    """Crank and frame with which the crank of a four-bar goes all the way round: crank-rocker or drag link."""
    least, most = abs(coupler - rocker), coupler + rocker
    total = random.uniform(least, most)
    apart = random.uniform(least, total)
    short, long = 0.5 * (total - apart), 0.5 * (total + apart)
    if short < 0.02 * most or apart < least + 0.01 * most or total > 0.99 * most:
        return None
    return (short, long) if random.random() < 0.5 else (long, short)


def radii(random: Random, largest: float, *keys: str) -> Data:
    """Some of the shafts, thin ones and thick ones."""
    return {key: random.uniform(0.02, 0.5) * largest for key in keys if random.random() < 0.5}


def limits(random: Random, module: float) -> Data:
    found: Data = {"transmission_angle": 0.0, "gear_gap": random.choice([0.0, 1.5, -2.0])}
    return found | ({"least_shaft": random.uniform(0.0, 15.0 * module)} if random.random() < 0.3 else {})


def three_gear(random: Random) -> Data | None:
    m, teeth = random.choice(MODULES), [random.randint(10, 70) for _ in range(3)]
    links = turning_links(random, m * (teeth[0] + teeth[1]) / 2, m * (teeth[1] + teeth[2]) / 2)
    return links and {
        "gears": {"module": m, "crank": teeth[0], "idler": teeth[1], "output": teeth[2]},
        "links": {"crank": links[0], "frame": links[1]},
        "shafts": radii(random, min(links), "input_radius", "output_radius"),
    }


def planet_gears(random: Random) -> tuple[Data, float]:
    """Planet with sun or ring, and their centre distance."""
    m, planet, other = random.choice(MODULES), random.randint(12, 60), random.randint(12, 60)
    if random.random() < 0.5:
        return {"module": m, "planet": planet, "sun": other}, m * (planet + other) / 2
    ring = max(planet + other, 40)
    gears = {"module": m, "planet": planet, "ring": ring}
    if random.random() < 0.4:
        gears["rim"] = m * (ring / 2 + 1.25) * random.uniform(1.001, 1.3)
    return gears, m * (ring - planet) / 2


def two_gear(random: Random) -> Data | None:
    gears, crank = planet_gears(random)
    frame = crank * random.choice([random.uniform(0.1, 0.9), random.uniform(1.1, 6.0)])
    total = (crank + frame) * random.uniform(1.05, 2.0)
    apart = abs(frame - crank) * random.uniform(-0.9, 0.9)
    return {
        "gears": gears,
        "links": {"coupler": (total + apart) / 2, "rocker": (total - apart) / 2, "frame": frame},
        "shafts": radii(random, frame, "A_radius", "D_radius"),
    }


def rocker(random: Random) -> Data | None:
    m, coupler, output = random.choice(MODULES), random.randint(12, 60), random.randint(12, 60)
    length, other = m * (coupler + output) / 2, m * random.uniform(20, 80)
    links = turning_links(random, other, length)
    return links and {
        "gears": {"module": m, "coupler": coupler, "output": output},
        "links": {"crank": min(links), "coupler": other, "frame": max(links)},
        "shafts": radii(random, max(links), "A_radius", "D_radius"),
    }


def path(random: Random) -> Data | None:
    m, z1, z4 = random.choice(MODULES), random.randint(12, 70), random.randint(12, 70)
    gears: Data = {"module": m, "input": z1, "output": z4}
    frame, links = m * (z1 + z4) / 2, {}
    form = random.choice(["direct", "internal", "idler", "idler"])
    if form == "internal":
        gears["mesh"] = "internal"
        gears[random.choice(["input", "output"])] = larger = max(z1, z4) + 35
        frame = m * (larger - min(gears["input"], gears["output"])) / 2
    elif form == "idler":
        gears["idler"] = random.randint(5, 60)
        first, second = m * (z1 + gears["idler"]) / 2, m * (z4 + gears["idler"]) / 2
        links["frame"] = frame = random.uniform(1.01 * abs(first - second) + 0.1, 0.99 * (first + second))
    short = frame * random.uniform(0.05, 0.2)
    keys = ("A_radius", "E_radius", *(("O_radius",) if form == "idler" else ()))
    return {
        "gears": gears,
        "links": {"input": short, "output": short, "coupler": 2 * frame, "follower": 2 * frame} | links,
        "phase": random.uniform(-180, 180),
        "coupler_point": {"along": 1.0},
        "shafts": radii(random, frame, *keys),
    }


def function(random: Random) -> Data | None:
    gears, length = planet_gears(random)
    frame = length * random.choice([random.uniform(0.1, 0.9), random.uniform(1.1, 5.0)])
    coupler = 0.3 * abs(frame - length) * random.random() + 0.5
    start = random.uniform(-400.0, 400.0)
    span = {"range": {"start": start, "end": start + random.uniform(5.0, 500.0)}} if random.random() < 0.6 else {}
    return {
        "form": "function",
        "gears": gears,
        "links": {"coupler": coupler, "follower": length + frame, "output": length + frame, "frame": frame},
        "phase": random.uniform(-180, 180),
        "shafts": radii(random, frame, "A_radius", "E_radius"),
    } | span


def hypocycloid(random: Random) -> Data | None:
    m, planet = random.choice(MODULES), random.randint(6, 40)
    ring = planet * random.randint(3, 4)
    return {
        "gears": {"module": m, "planet": planet, "ring": ring},
        "rod": {"length": 3.0 * m * ring},
        "shafts": radii(random, 1.5 * m * (ring - planet) / 2, "O_radius"),
    }


def mutilated(random: Random) -> Data | None:
    m, driven = random.choice(MODULES), random.randint(12, 40)
    found: Data = {
        "reduction": random.uniform(1, 10),
        "gears": {"module": m, "full_teeth": driven + random.randint(5, 60), "group_teeth": driven, "driven": driven},
        "shafts": radii(random, 2.0 * m * driven, "A_radius", "W_radius"),
    }
    links = turning_links(random, m * random.uniform(10, 60), rocker_length := m * random.uniform(10, 60))
    if links is None or random.random() < 0.3:
        return found
    total = (sum(links) + rocker_length) * 1.2
    found["links"] = {"crank": min(links), "coupler": total, "rocker": total, "frame": max(links)}
    found["shafts"] |= radii(random, max(links), "D_radius")
    return found


KINDS = {
    "three-gear-four-bar": three_gear,
    "two-gear-four-bar": two_gear,
    "geared-rocker": rocker,
    "geared-five-bar path": path,
    "geared-five-bar function": function,
    "hypocycloid-dwell": hypocycloid,
    "mutilated-gear-dwell": mutilated,
}


def drawn(random: Random, kind: str) -> Data:
    while True:
        data = KINDS[kind](random)
        if data is not None:
            return {"kind": kind.partition(" ")[0], "limits": limits(random, data["gears"]["module"])} | data


def judged(found: Any, data: Data, brute: Machine, size: float) -> Counter[str]:
    """Every pair of the brute force is judged, by its own gap and rightly; how often each status was given."""
    tolerance = 1e-9 * size
    radius = {body.name: body.radius for body in brute.bodies if body.shaft}
    least_shaft = data["limits"].get("least_shaft", 2.0 * data["gears"]["module"])
    pairs = [*found.layout.gear_pairs, *found.layout.shaft_pairs]
    checks = [*(found.check("gear-collision") if found.layout.gear_pairs else ()), *found.check("shaft-clearance")]
    wanted = dict(brute.gaps())
    assert sorted(map(sorted, wanted)) == sorted(sorted((p.one.name, p.other.name)) for p in pairs)
    for pair, check in zip(pairs, checks, strict=True):
        names = frozenset((pair.one.name, pair.other.name))
        assert math.isclose(check.value, wanted[names], rel_tol=0.0, abs_tol=tolerance), names
        for angle in (0.3, 2.0, 4.0) if pair.angle is None else (pair.angle,):
            assert math.isclose(brute.gap_at(names, angle), check.value, rel_tol=0.0, abs_tol=tolerance), names
        bare = sum(name in radius and radius[name] is None for name in names)
        limit = least_shaft * bare if names & radius.keys() else data["limits"]["gear_gap"]
        assert check.limit == limit
        if min(abs(wanted[names] - limit), abs(wanted[names])) > tolerance:
            low = "warn" if bare else "fail"
            # a limit below 0 lets gears overlap, which is told
            high = "warn" if wanted[names] < 0.0 else "pass"
            assert check.status == (high if wanted[names] > limit else low), (names, check.message)
    return Counter(check.status for check in checks)


def try_designs(kind: str, count: int, seed: int) -> Counter[str]:
    random, tried, statuses = Random(seed), 0, Counter[str]()
    while tried < count:
        data = drawn(random, kind)
        found = design(data)
        try:
            layout = found.layout
        except NoSolution:
            continue  # a linkage that does not close
        size = max(reach.farthest for reach in layout.reaches.values()) + max(gear.outer for gear in layout.gears)
        statuses += judged(found, data, machine(data), size)
        tried += 1
    return statuses


@pytest.mark.quick(1)
@pytest.mark.parametrize("kind", KINDS)
def test_no_collision_missed_and_no_false_alarm(kind: str) -> None:
    statuses = try_designs(kind, 40, seed=1)
    assert set(statuses) == {"pass", "warn", "fail"}


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_a_thousand_designs_of_each_kind(kind: str) -> None:
    statuses = try_designs(kind, 1000, seed=2)
    assert min(statuses[status] for status in ("pass", "warn", "fail")) > 20
