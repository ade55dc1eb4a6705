"""The worked example of the swing gripper as data, machines derived from it, and its kinetic energy taken apart.

The energy is summed over the links from velocities alone; nothing of it goes through the principle of virtual work
that the program takes.
"""

from __future__ import annotations

import copy
import json
import math
from functools import partial
from pathlib import Path
from typing import Any

import factory
import numpy as np

from gearlink.core.machines.swing_gripper.design import SwingGripper
from gearlink.core.machines.swing_gripper.forces import Masses
from gearlink.core.machines.swing_gripper.linkage import GripperLinkage

REFERENCE = json.loads((Path(__file__).parents[1] / "reference" / "swing_gripper.json").read_text())
CASES = {case["id"]: case for case in REFERENCE["cases"]}
TABLE = REFERENCE["example_table"]

EXAMPLE: dict[str, Any] = {
    "kind": "swing-gripper",
    "speed": 12000.0,
    "cylinder": {"radius": 135.0},
    "arm": {"length": 300.0, "direction": 125.0},
    "links": {"input": 150.0, "coupler": 260.0, "output": 100.0},
    "pivots": {"input": [230.0, 0.0], "output": [498.0, 55.0]},
    "output_direction": 110.0,
    "swing_sense": -1,
    "assembly": 1,
    "phases": {
        "accelerate": 100.0,
        "constant": 12.0,
        "decelerate": 50.0,
        "far_dwell": 8.0,
        "return": 120.0,
        "near_dwell": 70.0,
    },
    "handover": 106.0,
    "laws": {"accelerate": "velocity-345", "decelerate": "half-cycloidal", "return": "modified-sine"},
    "cam": {
        "center": [0.0, 0.0],
        "sense": -1,
        "roller": {"arm": 160.0, "angle": 49.0, "radius": 30.0},
        "return_roller": {"arm": 160.0, "angle": 88.0, "radius": 30.0},
    },
    "inertia": {"input": 0.11, "output": 0.42, "coupler": 0.018, "coupler_mass": 3.2, "return_rocker": 0.05},
    "spring": {"torque": 400.0},
}


machine = partial(factory.design, EXAMPLE)
"""The example with changes."""


def turned(angle: float, shift: complex = 0j) -> SwingGripper:
    """The example turned about the origin by an angle [deg] and shifted."""
    data = copy.deepcopy(EXAMPLE)
    turn = complex(math.cos(math.radians(angle)), math.sin(math.radians(angle)))
    for section, key in (("pivots", "input"), ("pivots", "output"), ("cam", "center")):
        moved = complex(*data[section][key]) * turn + shift
        data[section][key] = [moved.real, moved.imag]
    data["arm"]["direction"] += angle
    data["output_direction"] += angle

    return factory.design(data)


def mirrored() -> SwingGripper:
    """The example in a mirror on the x axis."""
    data = copy.deepcopy(EXAMPLE)
    for section, key in (("pivots", "input"), ("pivots", "output"), ("cam", "center")):
        x, y = data[section][key]
        data[section][key] = [x, 0.0 - y]
    for place, key in (
        (data["arm"], "direction"),
        (data, "output_direction"),
        (data, "swing_sense"),
        (data, "assembly"),
        (data["cam"], "sense"),
        (data["cam"]["roller"], "angle"),
        (data["cam"]["return_roller"], "angle"),
    ):
        place[key] = -place[key]

    return factory.design(data)


def kinetic_energy(linkage: GripperLinkage, masses: Masses, shaft_speed: float, degrees: Any) -> Any:
    """Energy [J] of cam rocker, coupler and gripper, from the velocities of their points."""
    motion = linkage.motion(degrees, 1)
    w1, w3, w4 = (shaft_speed * rate for rate in (motion.input.first, motion.coupler.first, motion.output.first))
    c = 1e-3j * w1 * linkage.input * np.exp(1j * motion.input.value)
    d = 1e-3j * w4 * linkage.output * np.exp(1j * motion.output.value)
    middle = 0.5 * (c + d)
    translation = masses.coupler_mass * np.abs(middle) ** 2
    return 0.5 * (translation + masses.input * w1**2 + masses.coupler * w3**2 + masses.output * w4**2)
