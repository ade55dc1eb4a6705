"""Random design files of every kind that has remedies, good and bad ones: what their remedies are tried on."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import factory
from six_bars import SIX_BARS

Data = dict[str, Any]
Drawn = tuple[Data, str]
"""The data of a design file and a command for it."""
Change = tuple[str, Callable[[], Any]]
"""A key and what draws its value."""


def gear_pair(rng: random.Random) -> Drawn:
    """Pairs by shifts or by centre distance, many of them cut too deep, too pointed or too high."""
    teeth = [rng.randint(6, 40), rng.randint(8, 60)]
    data: Data = {"kind": "gear-pair", "module": rng.choice([1, 2, 3, 4]), "teeth": teeth}
    if rng.random() < 0.6:
        data["profile_shift"] = [_within(rng, -0.8, 1.2), _within(rng, -0.8, 1.2)]
    else:
        data["center_distance"] = round(data["module"] * (sum(teeth) / 2.0 + rng.uniform(-1.0, 1.5)), 2)
    if rng.random() < 0.3:
        data["clearance"] = _within(rng, 0.0, 0.3)
    if rng.random() < 0.3:
        data["addendum"] = _within(rng, 0.6, 1.4)
    return data, "gear"


def helical(rng: random.Random) -> Drawn:
    """Helical pairs, some in a ring, with tolerances and loads that they may not bear."""
    first, ring = rng.randint(7, 40), rng.random() < 0.25
    teeth = [first, -(first + rng.randint(8, 60)) if ring else rng.randint(8, 80)]
    module, helix = rng.choice([1.5, 2, 2.5, 4]), _within(rng, 5, 35)
    data: Data = {"kind": "gear-pair", "module": module, "teeth": teeth, "helix_angle": helix}
    data["face_width"] = _within(rng, 4, 14) * module
    if ring or rng.random() < 0.6:
        data["profile_shift"] = [_within(rng, -0.6, 0.9), _within(rng, -0.6, 0.9)]
    else:
        near = module * sum(teeth) / 2.0 / math.cos(math.radians(helix))
        data["center_distance"] = round(near + module * rng.uniform(-0.8, 1.2), 2)
    if not ring and rng.random() < 0.5:
        _loaded(rng, data)
    return data, "gear"


def rack(rng: random.Random) -> Drawn:
    """Pinions of few teeth on a rack, straight and helical, with tolerances and loads."""
    data: Data = {"kind": "gear-pair", "module": rng.choice([2, 3, 5]), "teeth": [rng.randint(6, 40), "rack"]}
    data |= {"profile_shift": [_within(rng, -0.5, 1.0), 0], "face_width": _within(rng, 10, 60)}
    if rng.random() < 0.4:
        data["helix_angle"] = _within(rng, 5, 30)
    if rng.random() < 0.4:
        data["addendum"] = _within(rng, 0.7, 1.3)
    if rng.random() < 0.5:
        _loaded(rng, data)
    return data, "gear"


def _loaded(rng: random.Random, data: Data) -> None:
    data["load"] = {"torque": _within(rng, 5, 400), "factors": {"application": 1.25}}
    data["material"] = {"contact_limit": _within(rng, 600, 1500), "bending_limit": _within(rng, 150, 450)}
    if rng.random() < 0.5:
        data["allowances"] = {"series": rng.choice(["25cd", "24e", "27h"])}
        data["center_distance_allowance"] = rng.choice(["js6", "js8"])


def three_gear(rng: random.Random) -> Drawn:
    """Analyses of given links, with and without shafts."""
    teeth = {"crank": rng.randint(12, 60), "idler": rng.randint(12, 90), "output": rng.randint(12, 60)}
    links = {"crank": _within(rng, 5, 70), "frame": _within(rng, 10, 220)}
    data: Data = {"kind": "three-gear-four-bar", "gears": {"module": 2, **teeth}, "links": links}
    if rng.random() < 0.4:
        data["shafts"] = {"input_radius": _within(rng, 3, 15), "output_radius": _within(rng, 3, 15)}
    return data, "analyze"


def synthesis(rng: random.Random) -> Drawn:
    """The four syntheses with an idler that may be too small or too large."""
    crank = rng.randint(12, 60)
    gears = {"module": 2, "crank": crank, "idler": rng.randint(12, 120), "output": crank}
    data: Data = {"kind": "three-gear-four-bar", "gears": gears}
    command = rng.choice(["dwell", "back-step", "variable-speed", "momentary-dwell"])
    if command == "dwell":
        data["dwell"] = {"angle": _within(rng, 30, 180)}
    elif command == "back-step":
        data["back_step"] = {"crank_angle": _within(rng, 20, 140)}
    elif command == "variable-speed":
        data["speed"] = {"min": _within(rng, 20, 150), "max": _within(rng, 160, 400)}
    else:
        data["momentary"] = {"eccentricity": _within(rng, 3, 40)}
        gears["output"] = rng.randint(12, 80)
    return data, f"synth {command}"


def two_gear(rng: random.Random) -> Drawn:
    """Sun or ring on crank-rockers and drag links, some with a motion that is wanted."""
    gears = {"module": 2, "planet": rng.randint(12, 60), rng.choice(["sun", "ring"]): rng.randint(40, 140)}
    links = {"coupler": _within(rng, 40, 200), "rocker": _within(rng, 40, 200), "frame": _within(rng, 20, 200)}
    data: Data = {"kind": "two-gear-four-bar", "gears": gears, "links": links}
    if rng.random() < 0.5:
        data["target"] = {"motion": rng.choice(["unidirectional", "back-step"])}
    return data, "analyze"


def geared_rocker(rng: random.Random) -> Drawn:
    """Rockers with small gears and poor transmission angles."""
    gears = {"module": 2, "coupler": rng.randint(12, 60), "output": rng.randint(12, 60)}
    links = {"crank": _within(rng, 10, 40), "coupler": _within(rng, 50, 150), "frame": _within(rng, 50, 150)}
    return {"kind": "geared-rocker", "gears": gears, "links": links}, "analyze"


def five_bar(rng: random.Random) -> Drawn:
    """Both forms."""
    data: Data = {"kind": "geared-five-bar", "phase": _within(rng, 0, 180)}
    if rng.random() < 0.5:
        teeth = rng.randint(14, 40)
        data |= {"form": "path", "coupler_point": {"along": 30}}
        data["gears"] = {"module": 2, "input": teeth, "output": rng.choice([1, 2, 3]) * teeth}
        data["links"] = {"input": _within(rng, 10, 30), "output": _within(rng, 10, 40)}
        data["links"] |= {"coupler": _within(rng, 40, 100), "follower": _within(rng, 40, 100)}
    else:
        data["form"] = "function"
        data["gears"] = {"module": 2, "planet": rng.randint(12, 40), rng.choice(["sun", "ring"]): rng.randint(20, 120)}
        data["links"] = {"coupler": _within(rng, 10, 60), "follower": _within(rng, 40, 150)}
        data["links"] |= {"output": _within(rng, 40, 150), "frame": _within(rng, 40, 150)}
    return data, "analyze"


def hypocycloid(rng: random.Random) -> Drawn:
    """Rods by length and by rule, dwells that are too long."""
    planet = rng.randint(10, 40)
    gears = {"module": 2, "planet": planet, "ring": rng.randint(3, 6) * planet}
    rod = rng.choice([{"length": _within(rng, 40, 300)}, {"rule": "minimax"}, {"rule": "tangent-circle"}])
    dwell = {"angle": _within(rng, 20, 100), "tolerance": _within(rng, 0.02, 0.6)}
    return {"kind": "hypocycloid-dwell", "gears": gears, "rod": rod, "dwell": dwell}, "analyze"


def mutilated(rng: random.Random) -> Drawn:
    """Small driven gears, four-bars with poor transmission angles."""
    driven = rng.randint(10, 40)
    gears = {"module": 2, "full_teeth": rng.randint(driven + 5, 160), "group_teeth": driven, "driven": driven}
    links = {"crank": _within(rng, 20, 60), **{name: _within(rng, 60, 150) for name in ("coupler", "rocker", "frame")}}
    return {"kind": "mutilated-gear-dwell", "reduction": rng.randint(1, 6), "gears": gears, "links": links}, "analyze"


def press(rng: random.Random) -> Drawn:
    """The worked press with a few numbers changed."""
    changes: list[Change] = [
        ("cam.base_radius", lambda: _within(rng, 10, 120)),
        ("cam.roller_radius", lambda: _within(rng, 5, 90)),
        ("cam.return_angle", lambda: _within(rng, 40, 200)),
        ("cam.transition_end", lambda: _within(rng, 105, 160)),
        ("cam.lead_in", lambda: float(rng.choice([0, 5, 30]))),
        ("cam.transition", lambda: rng.choice(["arc", "parabola"])),
        ("cam.return_law", lambda: rng.choice(["cycloidal", "modified-trapezoid", "simple-harmonic"])),
        ("cam.shaft_radius", lambda: _within(rng, 10, 80)),
        ("sync.start", lambda: _within(rng, 5, 60)),
        ("sync.length", lambda: _within(rng, 300, 600)),
        ("sync.print_length", lambda: _within(rng, 300, 600)),
        ("bed.double_crank.frame", lambda: _within(rng, 10, 60)),
        ("cylinder.double_crank.coupler", lambda: _within(rng, 100, 250)),
        ("cylinder.gear_ratio", lambda: _within(rng, 0.5, 3.5)),
    ]
    return _varied(rng, "ty460", changes), rng.choice(["press", "cam"])


def gripper(rng: random.Random) -> Drawn:
    """The worked gripper with a few numbers changed."""
    changes: list[Change] = [
        ("cam.center", lambda: [_within(rng, -40, 40), _within(rng, -40, 40)]),
        ("cam.roller.radius", lambda: _within(rng, 10, 120)),
        ("cam.return_roller.radius", lambda: _within(rng, 10, 120)),
        ("cam.return_roller.angle", lambda: _within(rng, 10, 140)),
        ("cam.shaft_radius", lambda: _within(rng, 20, 90)),
        ("spring.torque", lambda: _within(rng, 100, 500)),
        ("output_direction", lambda: _within(rng, 60, 160)),
        ("links.coupler", lambda: _within(rng, 220, 320)),
        ("links.input", lambda: _within(rng, 120, 180)),
        ("laws.accelerate", lambda: rng.choice(["velocity-345", "half-cycloidal", "half-mcv-50"])),
        ("laws.return", lambda: rng.choice(["modified-sine", "polynomial-345", "simple-harmonic"])),
        ("limits.jerk_step", lambda: _within(rng, 0.1, 6)),
        ("release.window", lambda: _within(rng, 0.5, 5)),
        ("cylinder.center", lambda: [_within(rng, 423, 425), _within(rng, 483, 485)]),
    ]
    return _varied(rng, "swing_gripper", changes), rng.choice(["gripper", "cam"])


def wide_swing(rng: random.Random) -> Drawn:
    """The worked mechanisms with a few numbers changed."""
    changes: list[Change] = [
        ("swing", lambda: _within(rng, 40, 200)),
        ("cam.roller_radius", lambda: _within(rng, 2, 40)),
        ("cam.center_distance", lambda: _within(rng, 80, 300)),
        ("cam.shaft_radius", lambda: _within(rng, 5, 120)),
        ("unloader.pivot_ratio", lambda: _within(rng, 0.8, 4)),
        ("unloader.reserve", lambda: _within(rng, 0, 0.5)),
        ("unloader.residual", lambda: _within(rng, 0, 0.5)),
        ("limits.pressure_angle", lambda: _within(rng, 15, 60)),
    ]
    name = rng.choice(["twin_cam", "twin_cam", "twin_rocker", "twin_rocker", "oscillating_cam"])
    if name == "twin_cam":
        changes.append(("cam.rocker_radius", lambda: _within(rng, 40, 90)))
    if name != "oscillating_cam":
        changes.append(("cycle_angle", lambda: _within(rng, 40, 190)))
    return _varied(rng, f"wide_swing_{name}", changes), "swing"


def cycle(rng: random.Random) -> Drawn:
    """The worked whole cycle, both layouts, with other phases of the turn and other numbers."""
    changes: list[Change] = [
        ("layout", lambda: "twin-cam"),
        ("swing", lambda: _within(rng, 60, 200)),
        ("cycle", lambda: _phases(rng)),
        ("cam.roller_radius", lambda: _within(rng, 2, 30)),
        ("cam.center_distance", lambda: _within(rng, 90, 300)),
        ("cam.shaft_radius", lambda: _within(rng, 10, 80)),
        ("cam.free_clearance", lambda: _within(rng, 0, 3)),
        ("unloader.pivot_ratio", lambda: _within(rng, 0.8, 4)),
        ("unloader.reserve", lambda: _within(rng, 0, 0.5)),
        ("limits.pressure_angle", lambda: _within(rng, 15, 60)),
    ]
    return _varied(rng, "wide_swing_cycle", changes), rng.choice(["swing", "cam"])


def _phases(rng: random.Random) -> Data:
    working, far, back = (rng.randint(30, 150) for _ in range(3))
    near = 360 - working - far - back
    return {"working": working, "far_dwell": far, "return": back, "near_dwell": max(near, 10)}


def six_bar(rng: random.Random) -> Drawn:
    """The worked six-bars and one for each place of a train, with other links, some with shafts."""
    base = rng.choice([*(factory.worked(name) for name in ("geared_six_bar", "six_bar_swing")), *SIX_BARS.values()])
    data = factory.changed(base, loads=None)
    links = data["links"]
    for name in rng.sample(sorted(links), rng.choice([1, 1, 2])):
        links[name] = round(links[name] * rng.uniform(0.6, 1.5), 1)
    if rng.random() < 0.3:
        data["shafts"] = {"A_radius": _within(rng, 3, 15), "F_radius": _within(rng, 3, 25)}
    return data, "analyze"


def loads(rng: random.Random) -> Drawn:
    """The worked machines under load with other speeds, drives, bearings and springs."""
    feed: list[Change] = [
        ("loads.speed", lambda: _within(rng, 30, 400)),
        ("loads.motor.rated_torque", lambda: _within(rng, 0.5, 5)),
        ("loads.motor.max_torque", lambda: _within(rng, 0.5, 9)),
        ("loads.flywheel", lambda: {"inertia": _within(rng, 0.02, 5), "fluctuation": _within(rng, 0.01, 0.1)}),
        ("loads.bearings.C.dynamic_rating", lambda: _within(rng, 500, 20000)),
        ("loads.vibration.frequency", lambda: _within(rng, 20, 120)),
        ("loads.vibration.damping", lambda: rng.choice([0, 0.01, 0.05])),
        ("loads.vibration.allowed_residual", lambda: _within(rng, 0.02, 0.3)),
        ("loads.forces", lambda: [{"on": "output", "torque": -_within(rng, 0.5, 40)}]),
        ("loads.friction", lambda: {"pins": _within(rng, 0.02, 0.9), "pin_radius": _within(rng, 4, 60)}),
    ]
    gripper: list[Change] = [
        ("spring.torque", lambda: _within(rng, 100, 500)),
        ("loads.material.allowed_pressure", lambda: _within(rng, 200, 1500)),
    ]
    swing: list[Change] = [
        ("loads.material.allowed_pressure", lambda: _within(rng, 150, 1500)),
        ("loads.vibration.allowed_residual", lambda: _within(rng, 0.02, 0.3)),
        ("unloader.reserve", lambda: _within(rng, 0.05, 0.5)),
    ]
    name, changes = rng.choice(
        [("loaded_feed", feed), ("loaded_feed", feed), ("loaded_gripper", gripper), ("loaded_wide_swing", swing)]
    )
    drawn = rng.sample(changes, rng.choice([1, 1, 2]))
    return factory.changed(factory.worked(name), **{key.replace(".", "__"): draw() for key, draw in drawn}), "loads"


def _varied(rng: random.Random, name: str, changes: Sequence[Change]) -> Data:
    """An example with one to three of the changes."""
    drawn = rng.sample(changes, rng.choice([1, 1, 2, 3]))
    return factory.changed(factory.worked(name), **{key.replace(".", "__"): draw() for key, draw in drawn})


KINDS: dict[str, Callable[[random.Random], Drawn]] = {
    make.__name__: make
    for make in (
        *(gear_pair, three_gear, synthesis, two_gear, geared_rocker, five_bar, hypocycloid, mutilated),
        *(press, gripper, wide_swing),
        *(helical, rack, cycle, six_bar, loads),
    )
}


def draw(kind: str, seed: int, count: int) -> Iterator[Drawn]:
    """So many random designs of a kind; the same ones for the same seed."""
    rng = random.Random(f"{kind} {seed}")
    for _ in range(count):
        yield KINDS[kind](rng)


def _within(rng: random.Random, low: float, high: float) -> float:
    return round(rng.uniform(low, high), 2)
