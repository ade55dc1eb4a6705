"""The linkage of a swing gripper over the turn: gripper arm known, cam rocker sought.

A is the pivot of the cam rocker AC, E that of the gripper ED; the coupler CD joins them. The gripper follows
the six-phase law; the motion of rocker and coupler comes from the inverse four-bar. Derivatives are taken by
the cylinder angle theta; multiply by powers of its angular velocity for rates in time.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass

import numpy as np

from gearlink.core.base.errors import at_key
from gearlink.core.base.results import cached_property
from gearlink.core.machines.swing_gripper.law import SixPhaseLaw
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.extremes import Extreme, extremes_over
from gearlink.core.numerics.together import kept_last
from gearlink.core.parts.linkages.fourbar.position import FourBar
from gearlink.core.parts.linkages.fourbar.position import solve_inverse as solve_one_inverse
from gearlink.core.parts.linkages.fourbar.sweep import FourBarInverseSweep, dead_point_distance, solve_inverse

_MOST_KEPT = 8  # as many arrays as the grids of a design's searches, with room


@dataclass(frozen=True, slots=True)
class GripperMotion:
    """Angles [rad] and derivatives by theta at the angles asked for; arrays of one shape.

    `input` is AC, `coupler` C->D, `output` E->D. Derivatives beyond the order asked for are empty.
    """

    theta: Reals
    beta: Reals
    input_angle: Reals
    coupler_angle: Reals
    output_angle: Reals
    input_velocity: Reals
    coupler_velocity: Reals
    output_velocity: Reals
    input_acceleration: Reals
    coupler_acceleration: Reals
    output_acceleration: Reals
    input_jerk: Reals
    coupler_jerk: Reals
    output_jerk: Reals


@dataclass(frozen=True)
class GripperLinkage:
    """Four-bar A-C-D-E driven at ED by the law of the gripper.

    Parameters
        law : SixPhaseLaw
        input_pivot, output_pivot : complex [mm] - A and E
        input, coupler, output : float [mm] - AC, CD, ED
        output_direction : float [rad] - of ED at the pick-up position
        swing_sense : +1 or -1 - sense of the working stroke
        assembly : +1 or -1 - sign of sin(input angle - coupler angle)
    Source
        swing-gripper paper (4)-(7), signs of l3 cos(theta3) corrected
    """

    law: SixPhaseLaw
    input_pivot: complex
    output_pivot: complex
    input: float
    coupler: float
    output: float
    output_direction: float
    swing_sense: int
    assembly: int

    @cached_property
    def four_bar(self) -> FourBar:
        """The linkage in the frame of its pivots, read from A to E."""
        frame = abs(self.output_pivot - self.input_pivot)
        return FourBar(self.input, self.coupler, self.output, frame, self.assembly)

    @cached_property
    def frame_direction(self) -> float:
        """Direction of E seen from A [rad]."""
        return cmath.phase(self.output_pivot - self.input_pivot)

    def motion(self, degrees: Reals, order: int = 2) -> GripperMotion:
        """Motion of all links at cylinder angles.

        Parameters
            degrees : (N,) array [deg]
            order : 0..3
        Raises
            NoSolution - where the linkage does not close; `swing.require_swing` says why beforehand
        """
        beta = self.law.evaluate(degrees, order)
        return self.at(degrees, beta)

    def kept_motion(self, angles: Reals, order: int) -> GripperMotion:
        """Motion of all links at cylinder angles [rad], kept for who asks next at the very same array: both cams do.

        Notes
            At an array that cannot be written to, a grid, it is kept for the cams of other designs too. What is kept
            is replaced as a whole, so that threads may share a linkage.
        """
        place = 0 if angles.flags.writeable else id(angles)
        last = self._kept.get(place)
        if last is None or angles is not last[0] or order > last[1]:
            last = angles, order, self.motion(np.degrees(angles), order)
            if place == 0 or len(self._kept) < _MOST_KEPT:
                self._kept[place] = last
        return last[2]

    @property
    def output_shift(self) -> float:
        """Whole turns that bring the direction of ED at the pick-up position into the first one, (-pi, pi]."""
        return _into_first_turn(self.output_direction)

    @cached_property
    def _shifts(self) -> tuple[float, float]:
        """What turns the directions of AC and CD into the machine's frame, at the pick-up position in the first turn.

        From the bite, not from the first of the angles that are asked for: a part of a turn is part of the same motion.
        """
        with at_key("links"):
            bite = solve_one_inverse(self.four_bar, self.output_direction - self.frame_direction)
        first, second = (x + self.frame_direction for x in (bite.crank_angle, bite.coupler_angle))
        return self.frame_direction + _into_first_turn(first), self.frame_direction + _into_first_turn(second)

    @cached_property
    def _kept(self) -> dict[int, tuple[Reals, int, GripperMotion]]:
        return {}

    def at(self, degrees: Reals, beta: tuple[Reals, ...]) -> GripperMotion:
        """Motion of all links where the swing angle and its derivatives are known already."""
        order = len(beta) - 1
        sense = self.swing_sense
        output = self.output_direction + sense * beta[0]
        nothing = np.empty(0)
        velocity, acceleration, jerk = (sense * beta[n] if n <= order else nothing for n in (1, 2, 3))
        with at_key("links"):
            state = solve_inverse(
                self.four_bar,
                output - self.frame_direction,
                order,
                velocity=velocity,
                acceleration=acceleration if order > 1 else 0.0,
                jerk=jerk if order > 2 else 0.0,
            )
        return GripperMotion(
            theta=np.radians(degrees),
            beta=beta[0],
            input_angle=state.crank_angle + self._shifts[0],
            coupler_angle=state.coupler_angle + self._shifts[1],
            output_angle=output + self.output_shift,
            input_velocity=state.crank_velocity,
            coupler_velocity=state.coupler_velocity,
            output_velocity=velocity,
            input_acceleration=state.crank_acceleration,
            coupler_acceleration=state.coupler_acceleration,
            output_acceleration=acceleration,
            input_jerk=state.crank_jerk,
            coupler_jerk=state.coupler_jerk,
            output_jerk=jerk,
        )

    def ratios(self, beta: Reals) -> FourBarInverseSweep:
        """Speed ratios w_input/w_output and w_coupler/w_output as geometry, defined in the dwells too."""
        return solve_inverse(self.four_bar, self.local_output(beta), 1)

    @cached_property
    def least_transmission(self) -> tuple[Extreme, Extreme]:
        """Minimum angle between CD and ED (at D) and between AC and CD (at C), folded [rad], and the swing [rad] there.

        Notes
            Sought over the swing, not over the turn: every row of the motion lies within it, its very ends among them.
        """

        both = kept_last(lambda swing: self.transmission(self.local_output(swing)))
        ends = np.array([0.0, self.law.total_swing])
        wanted = [(lambda swing, i=i: both(swing)[i], False) for i in (0, 1)]
        inside = extremes_over(wanted, 0.0, self.law.total_swing, samples=180)
        d, c = (
            min(least, *map(Extreme, values.tolist(), ends.tolist()))
            for least, values in zip(inside, both(ends), strict=True)
        )
        return d, c

    def transmission(self, direction: Reals) -> tuple[Reals, Reals]:
        """Angles between CD and ED and between AC and CD, folded [rad], at directions of ED from the frame line."""
        state = solve_inverse(self.four_bar, direction)
        return _folded(direction - state.coupler_angle), _folded(state.crank_angle - state.coupler_angle)

    def local_output(self, beta: Reals) -> Reals:
        """Direction of ED from the frame line A-E at swing angles [rad]."""
        return self.output_direction - self.frame_direction + self.swing_sense * beta


def _folded(angle: Reals) -> Reals:
    """Angle between two lines, 0 to pi/2."""
    return dead_point_distance(np.abs(np.arctan2(np.sin(angle), np.cos(angle))))


def _into_first_turn(angle: float) -> float:
    """Whole turns that bring an angle into (-pi, pi]."""
    return -2.0 * math.pi * math.ceil((angle - math.pi) / (2.0 * math.pi))
