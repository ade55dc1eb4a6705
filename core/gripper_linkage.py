"""The linkage of a swing gripper over the turn: gripper arm known, cam rocker sought.

A is the pivot of the cam rocker AC, E that of the gripper ED; the coupler CD joins them. The gripper follows
the six-phase law; the motion of rocker and coupler comes from the inverse four-bar. Derivatives are taken by
the cylinder angle theta; multiply by powers of its angular velocity for rates in time.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from gearlink.core.errors import NoSolution
from gearlink.core.fourbar import FourBar
from gearlink.core.fourbar_sweep import FourBarInverseSweep, solve_inverse
from gearlink.core.six_phase_law import SixPhaseLaw

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class GripperMotion:
    """Angles [rad] and derivatives by theta at the angles asked for; arrays of one shape.

    `input` is AC, `coupler` C->D, `output` E->D. Derivatives beyond the order asked for are empty.
    """

    theta: Array
    beta: Array
    input_angle: Array
    coupler_angle: Array
    output_angle: Array
    input_velocity: Array
    coupler_velocity: Array
    output_velocity: Array
    input_acceleration: Array
    coupler_acceleration: Array
    output_acceleration: Array


@dataclass(frozen=True)
class GripperLinkage:
    """Four-bar A-C-D-E driven at ED by the law of the gripper.

    Parameters
        law : SixPhaseLaw
        input_pivot, output_pivot : complex [mm] - A and E
        input, coupler, output : float [mm] - AC, CD, ED
        output_direction : float [rad] - of ED at the bite
        swing_sense : +1 or -1 - sense of the working stroke
        assembly : +1 or -1 - sign of sin(input angle - coupler angle)
    Source
        swing-gripper paper (4)-(7), signs of l3 cos(theta3) put right
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

    def motion(self, degrees: Array, order: int = 2) -> GripperMotion:
        """Motion of all links at cylinder angles.

        Parameters
            degrees : (N,) array [deg]
            order : 0, 1 or 2
        Raises
            NoSolution - where the linkage does not close; the message gives the cylinder angle
        """
        beta = self.law.evaluate(degrees, order)
        return self.at(degrees, beta)

    def at(self, degrees: Array, beta: tuple[Array, ...]) -> GripperMotion:
        """Motion of all links where the swing angle and its derivatives are known already."""
        self._require_assembly(degrees, beta[0])
        order = len(beta) - 1
        sense = self.swing_sense
        output = self.output_direction + sense * beta[0]
        rates = {
            name: sense * values for name, values in zip(("velocity", "acceleration"), beta[1:3], strict=False)
        } or {"velocity": 0.0}
        state = solve_inverse(self.four_bar, output - self.frame_direction, order, **rates)
        nothing = np.empty(0)
        return GripperMotion(
            theta=np.radians(degrees),
            beta=beta[0],
            input_angle=_start_in_first_turn(state.crank_angle + self.frame_direction),
            coupler_angle=_start_in_first_turn(state.coupler_angle + self.frame_direction),
            output_angle=_start_in_first_turn(output),
            input_velocity=state.crank_velocity,
            coupler_velocity=state.coupler_velocity,
            output_velocity=sense * beta[1] if order >= 1 else nothing,
            input_acceleration=state.crank_acceleration,
            coupler_acceleration=state.coupler_acceleration,
            output_acceleration=sense * beta[2] if order >= 2 else nothing,
        )

    def ratios(self, beta: Array) -> FourBarInverseSweep:
        """Speed ratios w_input/w_output and w_coupler/w_output as geometry, defined in the dwells too."""
        output = self.output_direction + self.swing_sense * beta - self.frame_direction
        return solve_inverse(self.four_bar, output, 1)

    @cached_property
    def min_transmission_angles(self) -> tuple[float, float]:
        """Least angle between CD and ED (at D) and between AC and CD (at C) over the swing, folded [rad].

        Notes
            At C it falls out of |AD|, monotonic over a swing that does not cross the frame line; at D out of
            |EC|; both are refined on a grid of the swing, not of the turn.
        """
        swing = np.linspace(0.0, self.law.total_swing, 181)
        step = swing[1]
        for _ in range(6):
            values = self._transmission(swing)
            places = [swing[int(np.argmin(v))] for v in values]
            least = [float(np.min(v)) for v in values]
            swing = np.concatenate([np.linspace(p - step, p + step, 33) for p in places])
            swing = np.clip(swing, 0.0, self.law.total_swing)
            step /= 16.0
        return least[0], least[1]

    def _transmission(self, beta: Array) -> tuple[Array, Array]:
        motion = self.at(np.zeros_like(beta), (beta,))
        at_d = _folded(motion.output_angle - motion.coupler_angle)
        return at_d, _folded(motion.input_angle - motion.coupler_angle)

    def _require_assembly(self, degrees: Array, beta: Array) -> None:
        direction = self.output_direction + self.swing_sense * beta
        reach = np.abs(self.output_pivot + self.output * np.exp(1j * direction) - self.input_pivot)
        low, high = abs(self.input - self.coupler), self.input + self.coupler
        wrong = (reach > high) | (reach < low)
        if not wrong.any():
            return
        first = int(np.argmax(wrong))
        over = float(reach[first]) > high
        worst = float(reach.max()) - high if over else low - float(reach.min())
        change = (
            f"lengthen input or coupler by {worst:.4g} mm" if over else f"bring input and coupler {worst:.4g} mm nearer"
        )
        raise NoSolution(
            f"the linkage does not close at cylinder angle {float(np.atleast_1d(degrees)[first]):g} deg: |AD| = "
            f"{float(reach[first]):.6g} mm, input and coupler span {low:.6g} to {high:.6g} mm; {change}",
            key="links",
        )


def _folded(angle: Array) -> Array:
    """Angle between two lines, 0 to pi/2."""
    folded: Array = np.abs(np.arctan2(np.sin(angle), np.cos(angle)))
    return np.minimum(folded, math.pi - folded)


def _start_in_first_turn(angle: Array) -> Array:
    """The same continuous angle, shifted by whole turns so that the first lies in (-pi, pi]."""
    if not angle.size:
        return angle
    turns = math.ceil((float(angle.flat[0]) - math.pi) / (2.0 * math.pi))
    return angle - 2.0 * math.pi * turns if turns else angle
