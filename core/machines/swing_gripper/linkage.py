"""The linkage of a swing gripper: gripper arm known, cam rocker sought; where it may swing; its loop both ways.

A is the pivot of the cam rocker AC, E that of the gripper ED; the coupler CD joins them. The gripper follows
the six-phase law; the motion of rocker and coupler comes from the inverse four-bar. Derivatives are taken by
the cylinder angle theta; multiply by powers of its angular velocity for rates in time.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from dataclasses import dataclass
from decimal import Decimal, localcontext

import numpy as np
from numpy.typing import NDArray

from gearlink.core.base.errors import NoSolution, at_key
from gearlink.core.base.report import safely_above, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short, unlike, within
from gearlink.core.machines.swing_gripper.law import SixPhaseLaw
from gearlink.core.mechanism.rates import Turn
from gearlink.core.numerics.arrays import Points, Reals, unit_vector
from gearlink.core.numerics.extremes import Extreme, extremes_over, least_of
from gearlink.core.numerics.together import kept_last
from gearlink.core.parts.linkages.fourbar.loop import Reading, in_motion
from gearlink.core.parts.linkages.fourbar.position import FourBar, inverse_reading
from gearlink.core.parts.linkages.fourbar.position import solve_inverse as solve_one_inverse
from gearlink.core.parts.linkages.fourbar.sweep import dead_point_distance, solve_by_newton, solve_inverse
from gearlink.core.studies.clearance import beside_line

_MOST_KEPT = 8  # as many arrays as the grids of a design's searches, with room


@dataclass(frozen=True, slots=True)
class GripperMotion:
    """Angles [rad] with derivatives by theta as far as asked for; arrays of one shape.

    `input` is AC, `coupler` C->D, `output` E->D. `input_ratio` and `coupler_ratio` are derivatives by the output's
    angle, geometry that there is in the dwells too; of order 0 empty.
    """

    beta: Reals
    input: Turn
    coupler: Turn
    output: Turn
    input_ratio: Reals
    coupler_ratio: Reals


@dataclass(frozen=True)
class GripperLinkage:
    """Four-bar A-C-D-E driven at ED by the law of the gripper; of many, whose numbers are columns, a row for each.

    Parameters
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
    def inverse(self) -> FourBar:
        """The linkage read from E to A."""
        return self.four_bar.inverse()

    @cached_property
    def reading(self) -> Reading:
        """Constants of its loop with ED driving."""
        return inverse_reading(self.four_bar)

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
        return self.at(self.law.evaluate(degrees, order))

    def kept_motion(self, angles: Reals, order: int) -> GripperMotion:
        """Motion of all links at cylinder angles [rad], kept for who asks next at the very same array: both cams do.

        Notes
            At an array that cannot be written to, a grid, it is kept for the cams of other designs too. What is kept
            is replaced as a whole, so that threads may share a linkage.
        """
        place = 0 if angles.flags.writeable else id(angles)
        last = self._kept.get(place)
        if last is None or angles is not last[0] or order > last[1]:
            last = angles, order, self.at(self.law.over(angles, order))
            if place == 0 or len(self._kept) < _MOST_KEPT:
                self._kept[place] = last
        return last[2]

    @cached_property
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

    def at(self, beta: tuple[Reals, ...]) -> GripperMotion:
        """Motion of all links where the swing angle and its derivatives are known already."""
        order = len(beta) - 1
        sense = self.swing_sense
        output = self.output_direction + sense * beta[0]
        nothing, rates = np.empty(0), [sense * rate for rate in beta[1:]]
        with at_key("links"):
            first, second, _, *by_output = solve_inverse(self.reading, output - self.frame_direction, order)
        links = in_motion(by_output[: 2 * order], *rates, *[nothing] * (3 - order)) if order else []
        ratios = by_output[:2] if order else (nothing, nothing)
        turns = (
            Turn(first + self._shifts[0], *links[::2]),
            Turn(second + self._shifts[1], *links[1::2]),
            Turn(output + self.output_shift, *rates),
        )
        return GripperMotion(beta[0], *turns, *ratios)

    @cached_property
    def least_transmission(self) -> tuple[Extreme, Extreme]:
        """Minimum angle between CD and ED (at D) and between AC and CD (at C), folded [rad], and the swing [rad] there.

        Notes
            Sought over the swing, not over a revolution: every row of the motion lies within it, its ends too.
        """
        both = kept_last(lambda swing: self.transmission(self.local_output(swing)))
        total = self.law.total_swing
        wanted = [(lambda swing, i=i: both(swing)[i], False) for i in (0, 1)]
        inside = extremes_over(wanted, 0.0, total, samples=180)
        ends = np.concatenate(np.broadcast_arrays(*(np.reshape(end, (-1, 1)) for end in (0.0, total))), axis=1)
        d, c = (least_of(least, values, ends) for least, values in zip(inside, both(ends), strict=True))
        return d, c

    @cached_property
    def surely_reaches(self) -> bool:
        """Whether |AD| stays within the reach of rocker and coupler over the whole swing, by more than rounding.

        |AD| has its extremes at the ends of the swing and where ED lies in line with the frame.
        """
        start = self.output_direction - self.frame_direction
        low, high = sorted((start, start + self.swing_sense * self.law.total_swing))
        between = [k * math.pi for k in range(math.ceil(low / math.pi), math.floor(high / math.pi) + 1)]
        frame = self.four_bar.frame
        reach = [abs(frame + cmath.rect(self.output, direction)) for direction in (low, high, *between)]
        folded, stretched = abs(self.input - self.coupler), self.input + self.coupler
        rounding = _ROUNDING * (frame + self.output + stretched)
        return folded + rounding < min(reach) and max(reach) < stretched - rounding

    def beside_coupler(self, places: Sequence[complex]) -> tuple[Extreme, ...]:
        """Minimum distance of each place from the coupler over the swing [mm], and the swing [rad] there."""

        def ends(swing: Reals) -> tuple[Points, Points]:
            motion = self.at((swing,))
            c = self.input_pivot + self.input * unit_vector(motion.input.value)
            return c, self.output_pivot + self.output * unit_vector(motion.output.value)

        both = kept_last(ends)
        wanted = [(lambda swing, place=place: beside_line(place, *both(swing)), False) for place in places]
        return tuple(extremes_over(wanted, 0.0, self.law.total_swing, samples=256))

    def transmission(self, direction: Reals) -> tuple[Reals, Reals]:
        """Angles between CD and ED and between AC and CD, folded [rad], at directions of ED from the frame line."""
        state = solve_inverse(self.reading, direction)
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


# Where the links of a gripper may swing: refusal of a swing that they cannot make, and the remedy in degrees


DEAD_POINT = 1e-3
_LEAST_AIM = math.radians(10.0)
_STEP = math.radians(0.1)
_ROUNDING = 1e-12
_JOINTS = (("D", "coupler", "output"), ("C", "input", "coupler"))


def require_swing(linkage: GripperLinkage, limit: float) -> None:
    """Refuse a linkage that cannot make its swing: open somewhere, or within 1e-3 rad of a dead centre.

    |AC - CD| <= |AD| <= AC + CD,   mu_C >= 1e-3,   mu_D >= 1e-3 for every swing angle

    Parameters
        limit : float [rad] - transmission angle that the remedy aims at
    Raises
        NoSolution - with the cylinder angle, and what to change by how much
    Source
        own derivation; a sign change of sin(th4 - th3) passes mu_D = 0
    """
    low, high = abs(linkage.input - linkage.coupler), linkage.input + linkage.coupler
    swing = np.linspace(0.0, linkage.law.total_swing, 1801) if not linkage.surely_reaches else np.empty(0)
    reach = _reach(linkage, linkage.local_output(swing))
    wrong = (reach > high) | (reach < low)
    if wrong.any():
        first = int(np.argmax(wrong))
        off = float(reach.max()) - high
        change = f"lengthen input or coupler by {safely_above(off, 4)} mm"
        if off <= 0.0:
            change = f"bring input and coupler {safely_above(low - float(reach.min()), 4)} mm nearer"
        raise NoSolution(
            f"the linkage cannot be assembled at cylinder angle {short(linkage.law.reaches(float(swing[first])))} deg: "
            f"AD {unlike(reach[first], low if reach[first] < low else high)} mm (reach {within(low, high, 'mm')})",
            key="links",
            fix=change,
        )
    for extreme, (joint, one, other) in zip(linkage.least_transmission, _JOINTS, strict=True):
        if extreme.value < DEAD_POINT:
            raise NoSolution(
                f"dead centre at joint {joint} ({one} and {other} collinear): {math.degrees(extreme.value):.2g} deg "
                f"(limit >= {safely_above(math.degrees(DEAD_POINT), 2)} deg) at cylinder angle "
                f"{short(linkage.law.reaches(extreme.place))} deg",
                key="links",
                fix=turn_remedy(linkage, limit),
            )


def turn_remedy(linkage: GripperLinkage, limit: float, *, tells: bool = True) -> str:
    """Words for what brings the whole swing to a transmission angle [rad]: a revolution of ED, or a lesser swing.

    Parameters
        tells : bool - by how much ED is to be turned; not where cams stand that the turn may make impossible
    """
    limit = max(limit, _LEAST_AIM)
    turn, widest = clear_turn(linkage, limit)
    aim = f"(transmission angle {math.degrees(limit):g} deg)"
    if turn is not None:
        sign = "+" if turn > 0.0 else "-"
        angle = f" by {sign}{safely_above(abs(math.degrees(turn)), 4)} deg" if tells else ""
        return f"turn output_direction{angle} {aim}"
    swing = math.degrees(linkage.law.total_swing)
    if widest > 0.0:
        return (
            f"reduce the swing from {short(swing)} to {safely_below(math.degrees(widest))} deg {aim} by shorter phases"
        )
    return f"change links or pivots {aim}"


def clear_turn(linkage: GripperLinkage, limit: float) -> tuple[float | None, float]:
    """How to turn ED on the gripper so that both transmission angles keep a limit over the whole swing.

    Parameters
        linkage : GripperLinkage - the swing need not close
        limit : float [rad] - minimum angle between CD and ED and between AC and CD
    Returns
        turn : float [rad] or None - what to add to the output direction, the smallest; None where no direction
            serves the swing
        widest : float [rad] - the largest swing that keeps the limit with these links; 0 where none does
    Notes
        Directions of ED are tried every 0.1 deg; the result lies inside the exact range.
    """
    four_bar = linkage.four_bar
    directions = np.arange(-math.pi, 3.0 * math.pi, _STEP)
    reach = _reach(linkage, directions)
    low, high = abs(four_bar.crank - four_bar.coupler), four_bar.crank + four_bar.coupler
    good = (reach > low * (1.0 + 1e-9)) & (reach < high * (1.0 - 1e-9))
    if good.any():
        at_d, at_c = linkage.transmission(directions[good])
        good[good] = np.minimum(at_d, at_c) >= limit
    swing = linkage.law.total_swing
    start = math.remainder(linkage.output_direction - linkage.frame_direction, 2.0 * math.pi)
    first, last = sorted((start, start + linkage.swing_sense * swing))
    turns, widest = [], 0.0
    for left, right in _runs(directions, good):
        widest = max(widest, min(right - left, 2.0 * math.pi))
        if right - left >= swing:
            for turns_away in (-2.0 * math.pi, 0.0):
                window = (left + turns_away - first, right + turns_away - last)
                turns.append(min(max(0.0, window[0]), window[1]))
    return min(turns, key=abs, default=None), widest


def _reach(linkage: GripperLinkage, directions: Reals) -> Reals:
    """|AD| [mm] at directions of ED from the frame line."""
    reach: Reals = np.abs(linkage.four_bar.frame + linkage.output * np.exp(1j * directions))
    return reach


def _runs(places: Reals, good: NDArray[np.bool_]) -> list[tuple[float, float]]:
    """First and last place of every unbroken run of good ones."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], good.astype(np.int8), [0]))))
    return [(float(places[i]), float(places[j - 1])) for i, j in zip(edges[::2], edges[1::2], strict=True)]


# The gripper's loop both ways: closed form against Newton-Raphson, and the closed form against 40 digits


@dataclass(frozen=True, slots=True)
class TwoWays:
    """Closed form and Newton-Raphson at the same positions.

    Attributes
        deviation : (N,) array [rad] - larger difference of the two in the angles of cam rocker and coupler
        iterations : (N,) array of whole numbers - Newton-Raphson steps
        residual : (N,) array [mm] - opening of the loop that Newton-Raphson left
    """

    deviation: Reals
    iterations: NDArray[np.int64]
    residual: Reals


def two_ways(linkage: GripperLinkage, motion: GripperMotion) -> TwoWays:
    """Check the closed form of the linkage by Newton-Raphson on the vector loop.

    Parameters
        motion : GripperMotion - of any order
    Raises
        NoSolution - where Newton-Raphson finds no position of the assembly
    Notes
        Both lose 8 eps/mu_C near a dead centre, mu_C the angle of cam rocker and coupler; `closed_form_error` tells how
        much of it is the closed form's.
    Source
        swing-gripper paper (4), there called Newton-Simpson; loop in the inverse reading: own derivation
    """
    driving, coupler, rocker = _inverse_angles(linkage, motion)
    bite = linkage.output_direction + linkage.output_shift - linkage.frame_direction + math.pi
    swing = (bite, bite + linkage.swing_sense * linkage.law.total_swing)
    newton = solve_by_newton(linkage.inverse, driving, swing)
    return TwoWays(
        deviation=np.maximum(_apart(newton.coupler_angle, coupler), _apart(newton.rocker_angle, rocker)),
        iterations=newton.iterations,
        residual=newton.residual,
    )


def closed_form_error(linkage: GripperLinkage, motion: GripperMotion) -> Reals:
    """Errors of the closed form in the angles of cam rocker and coupler, the larger of both [rad].

    The Newton-Raphson step from the closed form's position, whose residual is computed with 40 digits

    Parameters
        motion : GripperMotion - of any order
    Returns
        error : (N,) array [rad]
    """
    inverse, angles = linkage.inverse, _inverse_angles(linkage, motion)
    r = np.array([_opening(inverse, *row) for row in zip(*(x.tolist() for x in angles), strict=True)])
    _, coupler, rocker = angles
    sine = np.abs(np.sin(coupler - rocker))
    of_coupler = np.abs((r * np.exp(-1j * rocker)).real) / (inverse.coupler * sine)
    of_rocker = np.abs((r * np.exp(-1j * coupler)).real) / (inverse.rocker * sine)
    return np.asarray(np.maximum(of_coupler, of_rocker))


def _inverse_angles(linkage: GripperLinkage, motion: GripperMotion) -> tuple[Reals, Reals, Reals]:
    """Angles of driving link, coupler and driven link of the linkage read from E to A."""
    turned = linkage.frame_direction
    return motion.output.value - turned + math.pi, motion.coupler.value - turned, motion.input.value - turned - math.pi


def _opening(links: FourBar, phi: float, coupler: float, rocker: float) -> complex:
    """a e(phi) + b e(theta_b) - c e(theta_c) - d, rounded once."""
    with localcontext() as context:
        context.prec = 40
        x, y = -Decimal(links.frame), Decimal(0)
        for length, angle in ((links.crank, phi), (links.coupler, coupler), (-links.rocker, rocker)):
            cosine, sine = _cos_sin(Decimal(angle))
            x, y = x + Decimal(length) * cosine, y + Decimal(length) * sine
        return complex(x, y)


def _cos_sin(angle: Decimal) -> tuple[Decimal, Decimal]:
    """By their series."""
    sums, term, n = [Decimal(0), Decimal(0)], Decimal(1), 0
    while abs(term) > Decimal("1e-40"):
        sums[n % 2] += term if n % 4 < 2 else -term
        n += 1
        term *= angle / n
    return sums[0], sums[1]


def _apart(one: Reals, other: Reals) -> Reals:
    difference = one - other
    turns: Reals = np.abs(difference - 2.0 * math.pi * np.rint(difference / (2.0 * math.pi)))
    return turns
