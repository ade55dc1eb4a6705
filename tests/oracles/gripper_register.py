"""The register of a swing gripper by hand: gains of its loop and of its roller on the cam, and the loop closed anew."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from oracles.gripper_register_contact import ROLLER, roller_contact
from oracles.loop_gains import closed_pin, loop_gains

from gearlink.core.machines.swing_gripper.design import SwingGripper
from gearlink.core.numerics.arrays import Reals

LINKS = {"links.input": "crank", "links.coupler": "coupler", "links.output": "rocker"}
PINS = ("A", "C", "D", "E")
VECTORS = {
    "pivots.input[0]": ("A", 1.0),
    "pivots.input[1]": ("A", 1j),
    "pivots.output[0]": ("E", 1.0),
    "pivots.output[1]": ("E", 1j),
    "cam.center[0]": ("center", 1.0),
    "cam.center[1]": ("center", 1j),
}


class GripperByHand:
    """A gripper with its cam at cylinder angles [rad]."""

    def __init__(self, design: SwingGripper, input_angle: Reals) -> None:
        self.spec, self.motion = design.spec, design.linkage.motion(np.degrees(input_angle), 0)
        self.contact = roller_contact(design.cams, self.motion, input_angle)
        lead = math.radians(self.spec.arm.direction - self.spec.output_direction)
        self.along = 1j * np.exp(1j * (self.motion.output.value + lead))

    def gain(self, key: str) -> Any:
        """Gain of a source: the gripper turns, and the axis E takes the tip along."""
        arm, links, motion = self.spec.arm.length, self.spec.links, self.motion
        loop = loop_gains(motion.input.value, motion.coupler.value, motion.output.value, links.output)
        mu_c, mu_d = motion.input.value - motion.coupler.value, motion.output.value - motion.coupler.value
        per_turn = arm * links.input * np.sin(mu_c) / (links.output * np.sin(mu_d))
        rolled = per_turn * self.contact.pivot
        vectors = dict.fromkeys(PINS, arm * loop.pin) | {
            "E": np.conj(self.along) - arm * loop.pin,
            "A": arm * loop.pin + rolled,
            "center": -rolled,
        }
        if key.startswith("pins."):
            return vectors[key.partition(".")[2]]
        if key in LINKS:
            return arm * getattr(loop, LINKS[key])
        if key in VECTORS:
            part, way = VECTORS[key]
            return (vectors[part] * way).real
        if key == "arm.direction":
            return np.full(np.shape(motion.output.value), math.radians(arm))
        turns = {"arm": self.contact.length, "radius": self.contact.radius, "angle": -math.radians(1.0)}
        return per_turn * turns[ROLLER[key]]

    def error(self, parts: Mapping[str, Any]) -> Reals:
        """Errors of the tip along the cylinder; (places, N) array [mm]."""
        off: dict[str, Any] = dict.fromkeys((*LINKS, *PINS, *ROLLER.values(), "center", "arm.direction"), 0.0)
        for key, error in parts.items():
            name, way = VECTORS.get(key, (ROLLER.get(key, key.removeprefix("pins.")), 1.0))
            off[name] = off[name] + error * way
        links = self.spec.links
        first, last = self.motion.input.value[:, None], self.motion.output.value[:, None]
        a, e = (complex(*pivot) for pivot in (self.spec.pivots.input, self.spec.pivots.output))
        pin, joint = a + links.input * np.exp(1j * first), e + links.output * np.exp(1j * last)
        side = int(np.sign(((joint - pin) / (e - pin)).imag[0, 0]))
        rocker = (links.input + off["links.input"]) * np.exp(1j * (first + self.contact.turned(off)))
        start = a + off["A"] + rocker + off["C"] + off["D"]
        coupler, output = links.coupler + off["links.coupler"], links.output + off["links.output"]
        moved = closed_pin(start, e + off["E"], coupler, output, side) - e - off["E"]
        turned = np.angle(moved * np.exp(-1j * last)) + np.radians(off["arm.direction"])
        along = (off["E"] * np.conj(self.along[:, None])).real
        error: Reals = along + self.spec.arm.length * np.sin(turned)
        return error
