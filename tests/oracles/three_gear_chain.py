"""The three-gear drive with errors of its parts, solved exactly: loop, involutes and eccentricities together.

A mesh is a crossed belt over the base circles: r_b1 (th1 - beta) + r_b2 (th2 - beta) + s [(r_b1 + r_b2)(inv alpha' -
inv alpha) + K] is constant on the flank s, with beta the direction of the line of centres and
cos alpha' = |r_b1 + r_b2|/|C1 C2|. The radius of a ring is negative.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from oracles.loop_gains import closed_pin
from oracles.three_gear_gains import Drive, gear_angles, signs

from gearlink.core.numerics.arrays import Points, Reals
from gearlink.core.parts.gears.mesh.pair_sweep import involute
from gearlink.core.parts.linkages.fourbar import sweep as fourbar_sweep

_STEPS = 12


@dataclass(frozen=True, slots=True)
class Errors:
    """Errors of the parts, floats or arrays that broadcast with the crank angles.

    Lengths [mm] crank, crank_idler, idler_output, frame; vectors [mm] loop (pin at A less pin at D, in the frame) and
    crank_gear, idler, output_gear (eccentricity, in the gear); input_angle [rad]; crank_idler_play, idler_output_play
    (half of what a mesh has of normal play beyond that of its centre distance [mm])
    """

    values: Mapping[str, Reals | Points] = field(default_factory=dict)

    def __getitem__(self, name: str) -> Any:
        return self.values.get(name, np.zeros(1))


def output_error(drive: Drive, crank_angle: Reals, torque_sign: int, errors: Errors) -> Reals:
    """Error of the output at its circle, exactly.

    Parameters
        drive : Drive
        crank_angle : array [rad]
        torque_sign : +1 or -1 - sign of the torque that the idler puts on the output
        errors : Errors - of shapes that broadcast with `crank_angle`
    Returns
        error : array [mm] - NaN where the loop does not close
    Notes
        The eccentricity of a gear moves with the angle that is sought: steps of a contraction by e/r, to rest.
    Example
        >>> from gearlink.core.parts.linkages.fourbar.position import FourBar
        >>> from gearlink.core.machines.three_gear.train import (GearTrain)
        >>> linkage = FourBar(38.94178567, 112.0, 112.0, 153.53024891)
        >>> drive = Drive(linkage, GearTrain(40, 72, 40), math.radians(20.0), 40.0)
        >>> error = output_error(drive, np.array([math.radians(270.0)]), 1, Errors({"frame": np.array([0.01])}))
        >>> round(float(error[0]), 5)
        0.01371

    Source
        own derivation; agrees with `register_gains` to first order
    """
    return drive.train.sense * drive.radius * _Chain(drive, crank_angle, torque_sign, errors).output()


class _Chain:
    """The two meshes, each on one flank; angles are deviations from the drive without errors, so no branch is lost."""

    def __init__(self, drive: Drive, crank_angle: Reals, torque_sign: int, errors: Errors) -> None:
        self.drive, self.phi, self.errors = drive, crank_angle, errors
        linkage, train = drive.linkage, drive.train
        state = fourbar_sweep.solve(linkage, crank_angle)
        self.coupler_direction, self.rocker_direction = state.coupler_angle, state.rocker_angle
        self.idler, self.output_gear = gear_angles(linkage, train, crank_angle)
        cosine = math.cos(drive.pressure_angle)
        b, c, counted = signs(train)
        self.flank = torque_sign * counted
        crank_gear = b * linkage.coupler * train.crank / (train.crank + train.idler) * cosine
        output_gear = c * linkage.rocker * train.output / (train.idler + train.output) * cosine
        idler = train.idler / train.crank * crank_gear
        self.base = (crank_gear, idler, output_gear)

    def output(self) -> Reals:
        """By how much the output gear has turned too far [rad]."""
        links, errors = self.drive.linkage, self.errors
        turned = np.asarray(errors["input_angle"])
        crank = np.exp(1j * (self.phi + turned))
        crank_pin = errors["loop"] + (links.crank + errors["crank"]) * crank
        output_pin = links.frame + errors["frame"] + 0j
        lengths = links.coupler + errors["crank_idler"], links.rocker + errors["idler_output"]
        knee = closed_pin(crank_pin, output_pin, *lengths, links.assembly)
        first = crank_pin + errors["crank_gear"] * crank
        mesh = ("crank_idler_play", "idler", self.idler, self.coupler_direction)
        idler = self._turned(self.base[:2], -self.flank, turned, first, knee, mesh)
        middle = knee + errors["idler"] * np.exp(1j * (self.idler + idler))
        last = ("idler_output_play", "output_gear", self.output_gear, self.rocker_direction + math.pi)
        return self._turned(self.base[1:], self.flank, idler, middle, output_pin, last)

    def _turned(
        self,
        base: tuple[float, ...],
        flank: float,
        first: Reals,
        at: Points,
        pin: Points,
        mesh: tuple[str, str, Reals, Reals],
    ) -> Reals:
        """By how much the second gear of a mesh has turned too far; its own eccentricity moves with that."""
        play, gear, angle, direction = mesh
        r1, r2 = base
        eccentricity, turned = self.errors[gear], np.zeros(1)
        for _ in range(_STEPS):
            line = pin + eccentricity * np.exp(1j * (angle + turned)) - at
            swung = np.angle(line * np.exp(-1j * direction))
            working = np.arccos(abs(r1 + r2) / np.abs(line))
            slack = (r1 + r2) * (involute(working) - involute(self.drive.pressure_angle)) + self.errors[play]
            new = swung - (r1 * (first - swung) + flank * slack) / r2
            if np.array_equal(new, turned):
                break
            turned = new
        return turned
