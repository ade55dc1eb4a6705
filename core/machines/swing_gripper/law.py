"""The six-phase law of a swing gripper: accelerate, run with the cylinder, decelerate, dwell, return, dwell.

beta is the swing angle of the gripper arm, theta the angle of the cylinder shaft, one revolution a sheet; both in
radians. The phases accelerate and decelerate join the constant speed w = R/l_EF of the handover; the total swing
follows from w and the phase lengths.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.numerics.arrays import Reals, largest
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.parts.cams.laws import Law

PHASES = ("accelerate", "constant", "decelerate", "far-dwell", "return", "near-dwell")
_FAR_DWELL, _NEAR_DWELL = 3, 5
_RADIAN = math.pi / 180.0
_HALF_DEGREES = np.arange(0.0, 360.0, 0.5)
_HALF_DEGREES.flags.writeable = False
_MOST_KEPT = 16
"""Grids at which a law is kept."""


class SixPhases(NamedTuple):
    """A value for each phase of a revolution, in their order."""

    accelerate: float
    constant: float
    decelerate: float
    far_dwell: float
    return_: float
    near_dwell: float


def balanced(rest: tuple[float, float, float], ratio: float, laws: tuple[Law, Law, Law]) -> SixPhases:
    """Phases whose accelerations have equal peaks before and after the constant speed, and `ratio` times it on return.

    D_d = D_a a_d/a_a,  D_r = S - D_a - D_d,  (k_a D_a + D_c + k_d D_d) C_a/D_r^2 = q a_a/D_a

    Parameters
        rest : three floats [deg] - constant, far dwell and near dwell; S is what they leave of 360
        ratio : float - q, peak of the return over that of the other two
        laws : accelerate, decelerate, return
    Notes
        The left side over the right rises from 0 to infinity as D_a goes from 0 to S/(1 + a_d/a_a): one root.
    Source
        own derivation; the swing-gripper paper, 1, asks for a long phase accelerate and gives no rule
    """
    (constant, far, near), (fast, slow, back) = rest, laws
    room, share = 360.0 - sum(rest), slow.peak_acceleration / fast.peak_acceleration

    def excess(first: float) -> float:
        left = room - (1.0 + share) * first
        swing = (fast.kappa + slow.kappa * share) * first + constant
        return swing * back.peak_acceleration * first - ratio * fast.peak_acceleration * left * left

    first = bracketed_root(excess, 0.0, room / (1.0 + share))
    return SixPhases(first, constant, share * first, far, room - (1.0 + share) * first, near)


def heights(lengths: Sequence[float], speed: float, fast: Law, slow: Law) -> tuple[float, float, float]:
    """Swing at the ends of accelerate, constant and decelerate [rad]; the phases in deg."""
    spans = [length * _RADIAN for length in lengths]
    first = speed * fast.kappa * spans[0]
    second = first + speed * spans[1]
    return first, second, second + speed * slow.kappa * spans[2]


class LawOfEach:
    """The laws of one phase of many grippers.

    Parameters
        laws : Law of each
    """

    def __init__(self, laws: Sequence[Law]) -> None:
        self.laws = list({id(law): law for law in laws}.values())
        self.numbers = np.array([next(k for k, own in enumerate(self.laws) if own is law) for law in laws])
        self.kappa = np.array([[law.kappa] for law in laws])

    def evaluate(self, u: Reals, order: int, rows: NDArray[np.intp]) -> tuple[Reals, ...]:
        """As of a `Law`, of places whose grippers `rows` tells."""
        found, numbers = np.empty((order + 1, u.size)), self.numbers[rows]
        for number, law in enumerate(self.laws):
            own = numbers == number
            found[:, own] = law.evaluate(u[own], order)
        return tuple(found)


@dataclass(frozen=True)
class SixPhaseLaw:
    """Swing angle over the revolution; of many laws, whose numbers are columns, a row for each.

    Parameters
        lengths : six floats [deg] - phase lengths that add up to 360; degrees, so that joints on whole degrees
            are met exactly
        speed : float - w = d beta/d theta in the constant phase
        accelerate, decelerate : Law - rest-to-speed
        return_ : Law - rest-to-rest
    Raises
        NoSolution - for a law of the wrong kind, or one whose acceleration is not zero where it joins a dwell
    Source
        swing-gripper paper 2 (the six phases); joints continuous to the second derivative: own derivation
    """

    lengths: tuple[float, ...]
    speed: float
    accelerate: Law
    decelerate: Law
    return_: Law

    def __post_init__(self) -> None:
        for phase, law in (("accelerate", self.accelerate), ("decelerate", self.decelerate), ("return", self.return_)):
            require_law(phase, law)

    @cached_property
    def starts(self) -> tuple[float, ...]:
        """Angles at which the phases start, and 360 [deg]."""
        starts = [0.0]
        for length in self.lengths[:-1]:
            starts.append(starts[-1] + length)
        return (*starts, 360.0)

    @cached_property
    def _heights(self) -> tuple[float, float, float]:
        return heights(self.lengths, self.speed, self.accelerate, self.decelerate)

    @property
    def total_swing(self) -> float:
        """Swing from bite to the far dwell [rad]: w (k_a D_a + D_c + k_d D_d)."""
        return self._heights[2]

    @property
    def inner_steps(self) -> tuple[str, ...]:
        """Phases whose law lets the acceleration jump between its ends."""
        moving = (("accelerate", self.accelerate), ("decelerate", self.decelerate), ("return", self.return_))
        return tuple(phase for phase, law in moving if math.isinf(law.peak_jerk))

    @cached_property
    def peaks(self) -> tuple[float, float]:
        """Largest magnitudes of the first and the second derivative of the swing by theta, every half degree."""
        _, first, second = self.evaluate(_HALF_DEGREES, 2)
        return largest(np.abs(first)), largest(np.abs(second))

    def reaches(self, swing: float) -> float:
        """Cylinder angle [deg] at which the working stroke has the swing [rad], from 0 to the total swing."""
        ends = (-swing, self.total_swing - swing)
        return bracketed_root(lambda degrees: self.swing(degrees) - swing, 0.0, self.starts[_FAR_DWELL], ends=ends)

    def swing(self, degrees: float) -> float:
        """Swing [rad] at one cylinder angle: that of `evaluate`, without an array."""
        theta = math.fmod(degrees, 360.0)
        index = bisect_right(self.starts, theta) - 1
        if index in (_FAR_DWELL, _NEAR_DWELL):
            return self.total_swing if index == _FAR_DWELL else 0.0
        u = (theta - self.starts[index]) / (self.starts[index + 1] - self.starts[index])
        return float(self.in_phase(index, u, 0)[0])

    def phase(self, degrees: Any) -> NDArray[np.intp]:
        """Index of the phase at angles in degrees; a joint belongs to the phase that starts there."""
        return self._phase_of(np.fmod(degrees, 360.0))

    def _phase_of(self, theta: Any) -> NDArray[np.intp]:
        """The same at angles below 360; of many laws with a row of angles for each."""
        index: NDArray[np.intp]
        if self._many:
            index = np.add.reduce([theta >= start for start in self.starts[1:-1]], axis=0, dtype=np.intp)
        else:
            index = self._edges.searchsorted(theta, side="right") - 1
        return index

    @cached_property
    def _edges(self) -> Reals:
        return np.array(self.starts)

    @cached_property
    def _many(self) -> int:
        """How many laws it is whose numbers are columns; 0 of one."""
        laws = (self.accelerate, self.decelerate, self.return_)
        numbers: tuple[Any, ...] = (self.speed, *self.lengths, *(law.kappa for law in laws))
        return max((len(each) for each in numbers if isinstance(each, np.ndarray)), default=0)

    def evaluate(self, degrees: Any, order: int = 2) -> tuple[Reals, ...]:
        """Swing and its derivatives by theta.

        Parameters
            degrees : (N,) array [deg] - cylinder angle, not negative; reduced to one revolution exactly, in degrees
            order : 0..3
        Returns
            beta[, beta'[, beta''[, beta''']]] : (N,) arrays [rad], per radian of theta
        Notes
            At an array that cannot be written to, the grid of a search, it is kept: designs of a study share the law.
        """
        if isinstance(degrees, np.ndarray) and not degrees.flags.writeable:
            return self._kept_at(degrees, order, lambda: self._evaluate(degrees, order))
        return self._evaluate(degrees, order)

    def over(self, angles: Reals, order: int = 2) -> tuple[Reals, ...]:
        """The same at cylinder angles [rad]."""
        if angles.flags.writeable:
            return self._evaluate(np.degrees(angles), order)
        return self._kept_at(angles, order, lambda: self._evaluate(np.degrees(angles), order))

    def _kept_at(self, grid: Reals, order: int, compute: Callable[[], tuple[Reals, ...]]) -> tuple[Reals, ...]:
        last = self._kept.get(id(grid))
        if last is None or last[0] is not grid or len(last[1]) <= order:
            last = grid, compute()
            for values in last[1]:
                values.flags.writeable = False
            if len(self._kept) < _MOST_KEPT:
                self._kept[id(grid)] = last
        return last[1][: order + 1]

    @cached_property
    def _kept(self) -> dict[int, tuple[Reals, tuple[Reals, ...]]]:
        """By grid, which is held so that no other array has its number."""
        return {}

    def _evaluate(self, degrees: Any, order: int) -> tuple[Reals, ...]:
        given = np.atleast_1d(np.asarray(degrees, dtype=np.float64))
        if self._many:
            given = np.broadcast_to(given, (self._many, given.shape[-1]))
        theta = np.fmod(given, 360.0)
        phase = self._phase_of(theta)
        out = np.zeros((order + 1, *theta.shape))
        for index in range(_NEAR_DWELL):  # in which it rests at zero
            places = (phase == index).nonzero()
            if places[0].size:
                start, end = of_rows(places[0], self.starts[index], self.starts[index + 1])
                values = self.in_phase(index, (theta[places] - start) / (end - start), order, places[0])
                for target, value in zip(out, values, strict=True):
                    target[places] = value
        return tuple(out)

    def in_phase(self, index: int, u: Any, order: int, rows: NDArray[np.intp] | None = None) -> tuple[Any, ...]:
        """Swing and derivatives within a phase, at its local coordinate u in [0, 1] (both ends included), an array.

        The swing alone in a phase that moves is known of a number too. Of many laws, `rows` tells whose each is.
        """
        first, _, top = self._heights
        span = (self.starts[index + 1] - self.starts[index]) * _RADIAN
        span, first, top, w = of_rows(rows, span, first, top, self.speed)
        if index == 0:
            return tuple(w * span * s / span**n for n, s in enumerate(_shape(self.accelerate, u, order, rows)))
        if index == 1:
            return (first + w * span * u, *(np.full_like(u, w if n == 1 else 0.0) for n in range(1, order + 1)))
        if index == 2:
            shape = _shape(self.decelerate, 1.0 - u, order, rows)
            scaled = [w * span * s / span**n * (-1.0) ** n for n, s in enumerate(shape)]
            return (top - scaled[0], *(-s for s in scaled[1:]))
        if index == 4:
            shape = _shape(self.return_, u, order, rows)
            return (top * (1.0 - shape[0]), *(-top * s / span**n for n, s in enumerate(shape) if n))
        level = top if index == 3 else 0.0
        return (np.full_like(u, level), *(np.zeros_like(u) for _ in range(order)))

    @cached_property
    def joints(self) -> Reals:
        """Jumps of beta and its three derivatives at the six joints, (6, 4); row i is the start of phase i."""
        ends = np.array([self.in_phase(i, np.array([0.0, 1.0]), 3) for i in range(6)])
        jumps: Reals = ends[:, :, 0] - np.roll(ends[:, :, 1], 1, axis=0)
        if self.lengths[_FAR_DWELL] == 0.0:  # deceleration and return meet, without a rest between them
            jumps[_FAR_DWELL + 1] += jumps[_FAR_DWELL]
            jumps[_FAR_DWELL] = 0.0
        return jumps


def _shape(law: Any, u: Any, order: int, rows: NDArray[np.intp] | None) -> tuple[Any, ...]:
    """A law in its phase, or those of many grippers."""
    found: tuple[Any, ...] = law.evaluate(u, order) if isinstance(law, Law) else law.evaluate(u, order, rows)
    return found


def of_rows(rows: NDArray[np.intp] | None, *numbers: Any) -> Iterator[Any]:
    """Numbers, of columns those of some rows."""
    for each in numbers:
        yield each[rows, 0] if isinstance(each, np.ndarray) else each


def require_law(phase: str, law: Law) -> None:
    """Refuse a law of the wrong kind for a moving phase, or one that jumps where it joins a dwell."""
    kind = "rest-to-rest" if phase == "return" else "rest-to-speed"
    if law.kind != kind:
        usual = "cycloidal or modified-sine" if kind == "rest-to-rest" else "velocity-345 or half-cycloidal"
        raise NoSolution(
            f"phase {phase} needs a {kind} law; {law.name} is {law.kind}", key=f"laws.{phase}", fix=f"use {usual}"
        )
    if law.end_jumps:
        raise NoSolution(
            f"the acceleration of {law.name} is not zero at its ends, where phase {phase} joins a dwell",
            key=f"laws.{phase}",
            fix="use cycloidal, modified-sine or polynomial-345",
        )
