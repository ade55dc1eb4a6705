"""GL302 of links and rollers: how near each comes to the axes of the frame that it does not turn about.

All positions of the linkage are those of the swing from 0 to its total, run through forth and back in a turn. The cam
rocker turns one way meanwhile, since it may not come to a dead centre.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from gearlink.core.base.results import cached_property
from gearlink.core.numerics.arrays import Points, Reals
from gearlink.core.numerics.together import kept_last
from gearlink.core.studies.clearance.bodies import beside_line, beside_turning_arm, beside_turning_pin

if TYPE_CHECKING:
    from gearlink.core.machines.swing_gripper.design import SwingGripper
    from gearlink.core.machines.swing_gripper.linkage import GripperLinkage

_SAMPLES = 256
_ROUNDS, _PARTS = 5, 64
_DRUM_REMEDY = "turn arm.direction"


ONE_SHAFT = 0.1
"""Axes that stand no farther apart [mm] are those of one shaft: two shafts never do."""


class Axis(NamedTuple):
    """An axis of the frame.

    Parameters
        letter : str - A, E, O of the cam, T of the cylinder that takes the sheet
        name : str - "the cam shaft"
        place : complex [mm]
        radius : float [mm] - of its shaft, 0 where the file does not name it
        remedy : str - what moves it
    """

    letter: str
    name: str
    place: complex
    radius: float
    remedy: str


class Pass(NamedTuple):
    """A link or a roller at its nearest to an axis.

    Parameters
        body : str - "coupler CD"
        radius : float [mm] - of a roller, 0 of a link
        axis : Axis
        distance : float [mm] - of the axis from the line of the link or the roller's centre
        turned : float [rad] - how far the gripper has swung then, or the cam rocker turned where it is `by_rocker`
    """

    body: str
    radius: float
    axis: Axis
    distance: float
    turned: float
    by_rocker: bool = False


def drum_axis(design: SwingGripper) -> complex:
    """Axis of the cylinder that takes the sheet [mm]: the file's, or the one that fits."""
    given = design.spec.cylinder.center
    return complex(*given) if given is not None else design.handover.center


def cam_turns_drum(design: SwingGripper) -> bool:
    """Whether the cam stands on the shaft of the cylinder that takes the sheet."""
    return abs(drum_axis(design) - design.cams.center) <= ONE_SHAFT


def axes_of(design: SwingGripper) -> tuple[Axis, ...]:
    """The axes of the frame; that of the cylinder unless the cam stands on it."""
    spec, shaft = design.spec, design.cams.section.shaft_radius
    named = f"the cam shaft (radius {shaft:g} mm)" if shaft > 0.0 else "the cam axis"
    axes = (
        Axis("O", named, design.cams.center, shaft, "move cam.center"),
        Axis("A", "the cam rocker's axis", complex(*spec.pivots.input), 0.0, "move pivots.input"),
        Axis("E", "the gripper's axis", complex(*spec.pivots.output), 0.0, "move pivots.output"),
    )
    if cam_turns_drum(design):
        return axes
    return (*axes, Axis("T", "the axis of the cylinder that takes the sheet", drum_axis(design), 0.0, _DRUM_REMEDY))


class Passes:
    """What passes the axes of a gripper with cams."""

    def __init__(self, design: SwingGripper) -> None:
        self.axes, self.section, self.linkage = axes_of(design), design.cams.section, design.motion.linkage

    def __iter__(self) -> Iterator[Pass]:
        """Every link and roller against every axis that is not its own."""
        linkage, section = self.linkage, self.section
        rocker, ahead = self._rocker, cmath.exp(1j * math.radians(section.roller.angle))
        yield from self._coupler()
        yield from self._turning("cam rocker AC", "A", linkage.input * rocker)
        sense = linkage.swing_sense * linkage.law.total_swing
        for axis in self.axes:
            if axis.letter != "E":
                arm = cmath.rect(linkage.output, linkage.output_direction)
                near = beside_turning_arm(axis.place - linkage.output_pivot, arm, sense)
                yield Pass("output link ED", 0.0, axis, near.distance, near.turned)
        yield from self._roller("main", section.roller.arm * rocker * ahead, section.roller.radius)
        back = section.return_roller
        if back is not None:
            arm = back.arm * rocker * ahead * cmath.exp(1j * math.radians(back.angle))
            yield from self._roller("return", arm, back.radius)

    def _roller(self, name: str, arm: complex, radius: float) -> Iterator[Pass]:
        yield from self._turning(f"{name} roller's arm", "A", arm)
        yield from self._turning(f"{name} roller", "AO", arm, radius)

    def _turning(self, body: str, own: str, arm: complex, radius: float = 0.0) -> Iterator[Pass]:
        """What turns with the cam rocker; a roller where there is a radius. It rides on its cam beside O."""
        beside = beside_turning_pin if radius else beside_turning_arm
        for axis in self.axes:
            if axis.letter not in own:
                near = beside(axis.place - self.linkage.input_pivot, arm, self._sweep)
                yield Pass(body, radius, axis, near.distance, near.turned, by_rocker=True)

    def _coupler(self) -> Iterator[Pass]:
        from gearlink.core.numerics.extremes import extremes_over

        total, ends = self.linkage.law.total_swing, kept_last(partial(_coupler_ends, self.linkage))
        wanted = [(lambda swing, place=axis.place: beside_line(place, *ends(swing)), False) for axis in self.axes]
        found = extremes_over(wanted, 0.0, total, samples=_SAMPLES)
        for axis, least in zip(self.axes, found, strict=True):
            yield Pass("coupler CD", 0.0, axis, least.value, least.place)

    # The turn of the cam rocker over the swing

    @cached_property
    def _ends(self) -> Reals:
        """Angles of the cam rocker at both ends of the swing [rad]."""
        return _input_angle(self.linkage, np.array([0.0, self.linkage.law.total_swing]))

    @property
    def _rocker(self) -> complex:
        """Direction of AC at the pick-up position."""
        return cmath.rect(1.0, float(self._ends[0]))

    @property
    def _sweep(self) -> float:
        return float(self._ends[1] - self._ends[0])

    def cylinder_angle(self, found: Pass) -> float:
        """Cylinder angle of a pass in the working stroke [deg]."""
        swing = self._swing_at(found.turned) if found.by_rocker else found.turned
        return self.linkage.law.reaches(min(max(swing, 0.0), self.linkage.law.total_swing))

    def _swing_at(self, turned: float) -> float:
        """The swing [rad] at which the cam rocker has turned so far."""
        low, high = 0.0, self.linkage.law.total_swing
        if turned in (0.0, abs(self._sweep)):
            return high if turned else low
        for _ in range(_ROUNDS):
            swing = np.linspace(low, high, _PARTS + 1)
            part = int(np.searchsorted(np.abs(_input_angle(self.linkage, swing) - self._ends[0]), turned))
            part = min(max(part, 1), _PARTS)
            low, high = float(swing[part - 1]), float(swing[part])
        return 0.5 * (low + high)


def _coupler_ends(linkage: GripperLinkage, swing: Reals) -> tuple[Points, Points]:
    """C and D [mm] at swing angles [rad]."""
    motion = linkage.at(swing, (swing,))
    c = linkage.input_pivot + linkage.input * np.exp(1j * motion.input_angle)
    d = linkage.output_pivot + linkage.output * np.exp(1j * motion.output_angle)
    return c, d


def _input_angle(linkage: GripperLinkage, swing: Reals) -> Reals:
    return linkage.at(swing, (swing,)).input_angle
