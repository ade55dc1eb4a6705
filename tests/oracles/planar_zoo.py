"""Planar mechanisms of every sort of joint, as files."""

from __future__ import annotations

from typing import Any

FOUR_BAR = {
    "frame": {"A": [0, 0], "D": [120, 15]},
    "links": {"crank": ["A", "B", 32], "coupler": {"B": [0, 0], "C": [96, 0], "P": [50, 38]}, "rocker": ["D", "C", 78]},
    "drive": {"link": "crank"},
    "start": {"crank": 20, "coupler": 45, "rocker": 115},
    "outputs": ["rocker", "P"],
}
WATT = {
    "frame": {"A": [0, 0], "D": [110, 0]},
    "links": {
        "crank": ["A", "B", 40],
        "coupler": {"B": [0, 0], "C": [100, 0], "E": [130, 60]},
        "rocker": {"D": [0, 0], "C": [90, 0], "F": [120, -60]},
        "arm": ["E", "G", 120],
        "output": ["F", "G", 130],
    },
    "drive": {"link": "crank"},
    "start": {"crank": 0, "coupler": 60, "rocker": 105, "arm": 65, "output": 110},
    "outputs": ["output", "G"],
    "limits": {"transmission_angle": 10},
}
QUICK_RETURN = {
    "frame": {"A": [0, 0], "C": [-300, 0]},
    "links": {
        "crank": ["A", "B", 150],
        "lever": {"C": [0, 0], "D": [-200, 0]},
        "rod": ["D", "E", 140],
        "ram": {"E": [0, 0]},
    },
    "slots": {"slot": {"point": "B", "on": "lever", "through": [0, 0], "direction": 0}},
    "slides": {"guide": {"link": "ram", "on": "frame", "through": [-550, 0], "direction": 90}},
    "drive": {"link": "crank"},
    "start": {"crank": 0, "lever": 0, "rod": 115, "guide": 125},
    "outputs": ["guide", "lever", "slot"],
}
SLIDE_ON_LEVER = {
    "frame": {"A": [0, 0], "C": [-300, 0]},
    "links": {"crank": ["A", "B", 150], "lever": {"C": [0, 0], "D": [400, 30]}, "block": {"B": [0, 0], "K": [9, 4]}},
    "slides": {"way": {"link": "block", "on": "lever", "through": [0, 12], "direction": 5, "angle": 20}},
    "drive": {"link": "crank"},
    "start": {"crank": 10, "lever": 0},
    "outputs": ["lever", "way", "K"],
}
PLANET = {
    "frame": {"A": [0, 0]},
    "links": {
        "carrier": ["A", "B", 40],
        "planet": {"B": [0, 0], "P": [40, 0]},
        "rod": ["P", "R", 200],
        "ram": {"R": [0, 0]},
    },
    "slides": {"guide": {"link": "ram", "through": [-300, 5], "direction": 180}},
    "meshes": {"ring": {"gears": ["planet", "frame"], "at": ["B", "A"], "teeth": [20, -60]}},
    "drive": {"link": "carrier"},
    "start": {"carrier": 30, "planet": 0, "rod": 180, "guide": 0},
    "outputs": ["guide", "P", "planet"],
}
CYLINDER = {
    "frame": {"A": [0, 0]},
    "links": {"ram": {"E": [0, 0]}, "rod": ["E", "C", 140], "lever": ["A", "C", 90]},
    "slides": {"cylinder": {"link": "ram", "through": [-200, -10], "direction": 4}},
    "drive": {"slide": "cylinder"},
    "start": {"cylinder": 20, "rod": 40, "lever": 120},
    "range": {"start": -10, "end": 50},
    "outputs": ["lever", "C"],
}
TWO_DRIVES = {
    "frame": {"A": [0, 0], "E": [150, 0]},
    "links": {
        "crank": ["A", "B", 30],
        "coupler": {"B": [0, 0], "C": [120, 0], "M": [60, 40]},
        "follower": ["D", "C", 110],
        "other": ["E", "D", 25],
    },
    "drive": {"link": "crank", "with": {"other": -0.5}},
    "start": {"crank": 0, "other": 60, "coupler": 50, "follower": 120},
    "outputs": ["M", "follower"],
}
WITH_SLIDE = {
    "frame": {"A": [0, 0]},
    "links": {"crank": ["A", "B", 30], "coupler": ["B", "C", 160], "ram": {"D": [0, 0]}, "follower": ["D", "C", 140]},
    "slides": {"guide": {"link": "ram", "through": [150, 0], "direction": 80}},
    "drive": {"link": "crank", "with": {"guide": 5}},
    "range": {"start": -60, "end": 90},
    "start": {"crank": 0, "coupler": 50, "follower": 120},
    "outputs": ["follower", "guide", "C"],
}
RACK_ON_LINK = {
    "frame": {"A": [0, 0], "P": [100, 0]},
    "links": {
        "crank": ["A", "B", 30],
        "bar": {"B": [0, 0], "X": [200, 0]},
        "pinion": {"P": [0, 0], "Y": [0, 30]},
    },
    "slots": {"guide": {"point": "P", "on": "bar", "through": [0, 20], "direction": 0}},
    "meshes": {
        "teeth": {"rack": "bar", "pinion": "pinion", "at": "P", "direction": 0, "side": 1, "teeth": 20, "module": 2}
    },
    "drive": {"link": "crank"},
    "start": {"crank": 0, "bar": 0, "pinion": 0},
    "outputs": ["pinion", "bar", "guide"],
}
STEPHENSON = {  # no dyad: the loop of the coupler is driven from its far side
    "frame": {"A": [0, 0], "D": [110, 0]},
    "links": WATT["links"],
    "drive": {"link": "output"},
    "start": {"crank": 0, "coupler": 60.94, "rocker": 103.77, "arm": 67.39, "output": 109.25992423479073},
    "range": {"start": -3, "end": 2},
    "outputs": ["crank"],
}
ZOO: dict[str, dict[str, Any]] = {
    "four-bar": FOUR_BAR,
    "watt": WATT,
    "quick-return": QUICK_RETURN,
    "slide-on-lever": SLIDE_ON_LEVER,
    "planet": PLANET,
    "cylinder": CYLINDER,
    "two-drives": TWO_DRIVES,
    "with-slide": WITH_SLIDE,
    "rack-on-link": RACK_ON_LINK,
    "loop-of-four": STEPHENSON,
}
LOADS: dict[str, dict[str, Any]] = {
    "watt": {
        "links": {"coupler": {"mass": 1.9, "inertia": 0.0041, "center": [62, 20]}, "output": {"mass": 1.4}},
        "forces": [{"on": "output", "torque": -7.5}, {"on": "arm", "point": [40, 5], "force": [12, -30]}],
    },
    "quick-return": {
        "links": {"lever": {"mass": 4, "inertia": 0.2, "center": [90, 8]}, "ram": {"mass": 6}},
        "forces": [{"on": "ram", "force": -50}],
    },
    "slide-on-lever": {
        "links": {"lever": {"mass": 3, "inertia": 0.1}, "block": {"mass": 1, "inertia": 0.001, "center": [4, 2]}},
        "forces": [{"on": "lever", "torque": -5}],
        "friction": {"guides": 0.08, "pins": 0.1, "pin_radius": 10},
    },
    "planet": {
        "links": {"planet": {"mass": 3, "inertia": 0.1, "center": [1, 5]}, "ram": {"mass": 5}},
        "forces": [{"on": "ram", "force": 30}],
    },
    "two-drives": {"links": {"coupler": {"mass": 2, "inertia": 0.01, "center": [60, 5]}, "other": {"inertia": 0.01}}},
    "with-slide": {"links": {"coupler": {"mass": 2, "inertia": 0.01, "center": [60, 5]}, "ram": {"mass": 1}}},
    "rack-on-link": {
        "links": {"bar": {"mass": 1, "inertia": 0.001, "center": [40, 0]}, "pinion": {"mass": 2, "inertia": 0.002}},
        "forces": [{"on": "pinion", "torque": -3}],
    },
}


def made(name: str, **more: Any) -> Any:
    """The spec of a mechanism of the zoo with further keys."""
    from gearlink.core.machines.planar.spec import PlanarSpec

    return PlanarSpec.model_validate({"kind": "planar-mechanism", "name": name, **ZOO[name], **more})
