"""The function-generating geared five-bar, a planet on the coupler and a fixed sun, and its structural error.

The figure that the source gives for it is lost, so this is a reading: gear 5 fixed to the frame at A, planet 2 fixed to
the coupler BC at B, so that the coupler turns in a fixed ratio to the input; link 4 follows by the dyad CD, DE.

    t2 = t20 + m phi,   m = 1 + z5/z2 (sun), 1 - z5/z2 (ring gear)
    C = a e^(i phi) + b e^(i t2),   D on circles about C (radius c) and E = (d, 0) (radius e)
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from gearlink.core.base.results import cached_property
from gearlink.core.numerics.arrays import Points, Reals, product, unit_vector
from gearlink.core.numerics.extremes import maximum_over
from gearlink.core.numerics.harmonic_sum import HarmonicSum
from gearlink.core.parts.linkages.dyad import close_dyad, require_lengths, require_span, worst_transmission
from gearlink.core.parts.linkages.functions import Wanted

Positions = Sequence[tuple[float, float]]


@dataclass(frozen=True)
class FunctionFiveBar:
    """Links, coupler ratio and phase.

    Parameters
        input, coupler, follower, output, frame : float [mm] - a, b, c, e, d
        coupler_ratio : float - m, coupler turns per input turn
        phase : float [rad] - t20, direction of BC at input angle 0
        assembly : +1 or -1 - +1: D left of the vector C->E
    Raises
        NoSolution - for a length that is not positive and finite
    Example
        >>> bar = FunctionFiveBar(40.0, 30.0, 80.0, 50.0, 100.0, 2.5, math.radians(60.0))
        >>> round(math.degrees(bar.output_angle(math.radians(30.0))), 9)
        98.051641637

    Source
        thesis 2.2.2, figure 2-7, in a reading of its own
    """

    input: float
    coupler: float
    follower: float
    output: float
    frame: float
    coupler_ratio: float
    phase: float
    assembly: int = 1

    def __post_init__(self) -> None:
        require_lengths(
            input=self.input, coupler=self.coupler, follower=self.follower, output=self.output, frame=self.frame
        )

    def joint(self, phi: float) -> complex:
        """The pin C [mm]."""
        return cmath.rect(self.input, phi) + cmath.rect(self.coupler, self.phase + self.coupler_ratio * phi)

    def end(self, phi: float) -> complex:
        """The pin D [mm].

        Raises
            NoSolution - where follower and output do not reach
        """
        return close_dyad(self.joint(phi), complex(self.frame), self.follower, self.output, self.assembly)

    def output_angle(self, phi: float) -> float:
        """Direction of the output link E->D in (-pi, pi] [rad].

        Raises
            NoSolution - where follower and output do not reach
        """
        return cmath.phase(self.end(phi) - self.frame)

    def output_rates(self, phi: Reals) -> tuple[Reals, Reals]:
        """Output speed per input speed, and output acceleration per square of that; NaN where the five-bar opens.

        w4 = Re[C' e^(-i t3)]/(e sin(t3 - psi)),   t3 the direction C->D
        a4 = (Re[C'' e^(-i t3)] - c w3^2 + e w4^2 cos(psi - t3))/(e sin(t3 - psi))

        Parameters
            phi : (N,) array [rad]
        Source
            own derivation: the loop C + c e^(i t3) = E + e e^(i psi), differentiated twice
        """
        m = self.coupler_ratio
        crank, coupler, end = self._ends(phi)
        along, arm = (end - crank - coupler) / self.follower, (end - self.frame) / self.output
        turn, speed = product(along, arm.conj()), 1j * (crank + m * coupler)
        w3 = (speed.real * arm.real + speed.imag * arm.imag) / (self.follower * turn.imag)
        w4 = (speed.real * along.real + speed.imag * along.imag) / (self.output * turn.imag)
        bend = crank + m * m * coupler
        pull = self.output * w4 * w4 * turn.real - self.follower * w3 * w3
        pull -= bend.real * along.real + bend.imag * along.imag
        return w4, pull / (self.output * turn.imag)

    def _ends(self, phi: Reals) -> tuple[Points, Points, Points]:
        """The vectors of crank and coupler, and the pin D [mm]; NaN where the five-bar opens."""
        crank = self.input * unit_vector(phi)
        coupler = self.coupler * unit_vector(self.phase + self.coupler_ratio * phi)
        joint = crank + coupler
        way = self.frame - joint
        n = np.abs(way)
        c, e = self.follower, self.output
        with np.errstate(invalid="ignore", divide="ignore"):
            rise = 0.5 * np.sqrt((n - c + e) * (n + c - e) * (c + e - n) * (c + e + n))
            along = 0.5 * (n * n + (c - e) * (c + e))
            return crank, coupler, joint + way * (along + 1j * self.assembly * rise) / (n * n)

    def directions(self, phi: Reals) -> Reals:
        """Directions of the output link in (-pi, pi] [rad]; NaN where the five-bar opens."""
        return np.asarray(np.angle(self._ends(phi)[2] - self.frame))

    @cached_property
    def reach_squared(self) -> HarmonicSum:
        """|CE|^2 over the input angle."""
        a, b, d, m = self.input, self.coupler, self.frame, self.coupler_ratio
        terms = ((2.0 * a * b, m - 1.0, self.phase), (-2.0 * a * d, 1.0, 0.0), (-2.0 * b * d, m, self.phase))
        return HarmonicSum(math.fsum((a * a, b * b, d * d)), terms)

    def reach_extremes(self, start: float, end: float) -> tuple[tuple[float, float], tuple[float, float]]:
        """Minimum and maximum |CE| over a range of the input, each as (input angle [rad], distance [mm])."""
        (low, least), (high, greatest) = self.reach_squared.extremes(start, end)
        return (low, math.sqrt(max(least, 0.0))), (high, math.sqrt(greatest))

    def closure(
        self, start: float, end: float, *, free: bool = True
    ) -> tuple[tuple[float, float], tuple[float, float]]:
        """Refuse a five-bar whose follower and output do not reach from C to E all over a range of the input.

        |c - e| < |CE| < c + e

        Parameters
            start, end : float [rad]
            free : bool - whether a narrower range is a remedy
        Returns
            minimum, maximum : (float, float) - the extremes of |CE|, as `reach_extremes`
        Raises
            NoSolution - naming the worst input angle, the distance there, the limit, and by how much to change it
        """
        extremes, links = self.reach_extremes(start, end), {"follower": self.follower, "output": self.output}
        ways = [_or(words, free) for words in ("shorten the coupler", "lengthen the frame")]
        require_span("CE", links, extremes, (ways[0], ways[1]))
        return extremes

    def min_transmission_angle(self, start: float, end: float) -> tuple[float, float]:
        """Minimum angle between follower and output over a range, an obtuse one counted from the other side.

        Returns
            angle, place : float, float [rad] - and the input angle at which it occurs
        Raises
            NoSolution - where the five-bar opens
        Source
            own derivation; VDI 2142
        """
        return worst_transmission(self.closure(start, end), self.follower, self.output)

    def position_errors(self, positions: Positions) -> list[float]:
        """Output angle reached less that asked for at each position, on one continuous motion [rad].

        Parameters
            positions : sequence of (phi, psi) [rad] - phi ascending
        Raises
            NoSolution - where the five-bar opens between the first and the last
        Notes
            Whole turns count: a linkage that reaches the second angle by going round the other way misses it.
        """
        reached = self.output_angles([phi for phi, _ in positions])
        turns = 2.0 * math.pi * round((reached[0] - positions[0][1]) / (2.0 * math.pi))
        return [angle - turns - psi for angle, (_, psi) in zip(reached, positions, strict=True)]

    def output_angles(self, angles: list[float]) -> list[float]:
        """Output angles over ascending input angles, without jumps from the first on [rad].

        Raises
            NoSolution - where the five-bar opens between the first and the last
        Notes
            Between two of them the angle is followed in steps in which it cannot turn by half a revolution:
            |w4| <= (a + |m| b)/(e sin(mu)).
        """
        least, _ = self.min_transmission_angle(angles[0], angles[-1])
        bound = (self.input + abs(self.coupler_ratio) * self.coupler) / (self.output * math.sin(least))
        result = [self.output_angle(angles[0])]
        for one, other in pairwise(angles):
            parts = max(1, math.ceil((other - one) * bound / (0.5 * math.pi)))
            value = result[-1]
            for i in range(1, parts + 1):
                new = self.output_angle(one + (other - one) * i / parts)
                # whole revolutions alone are carried on, so that an angle does not depend on those before it
                value = new + 2.0 * math.pi * round((value - new) / (2.0 * math.pi))
            result.append(value)
        return result


def _or(words: str, free: bool) -> str:
    return f", {words}, or narrow the range" if free else f", or {words}"


_LEVEL = 0.02
"""Extremes that differ by no more than this share of the maximum count as of one size."""


@dataclass(frozen=True, slots=True)
class StructuralError:
    """How far a five-bar is from a function.

    Fields
        greatest : float [rad] - maximum magnitude, the output gear set on its shaft as is best
        zero : float [rad] - psi0, output angle at which the function starts, so set
        places : tuple of float - shares of the input's swing at which the error is extreme, ends included
        errors : tuple of float [rad] - there
    """

    greatest: float
    zero: float
    places: tuple[float, ...]
    errors: tuple[float, ...]

    @property
    def alternations(self) -> int:
        """Extremes of the maximum size that follow each other with changing sign; 8 where nothing can be gained."""
        count, last = 0, 0.0
        for error in self.errors:
            if abs(error) >= (1.0 - _LEVEL) * self.greatest and error * last <= 0.0:
                count, last = count + 1, error
        return count


def outputs(bar: FunctionFiveBar, phi: Reals) -> Reals:
    """Output angles over ascending input angles, continuous; NaN where the five-bar opens [rad].

    Notes
        The steps must be so small that the output turns by less than half a revolution in each.
    """
    return np.unwrap(bar.directions(phi))


def structural_error(bar: FunctionFiveBar, start: float, wanted: Wanted) -> StructuralError:
    """The structural error of a five-bar over the swing that starts at an input angle.

    r(s) = psi(phi0 + dphi s) - psi_wanted(s) - psi0,   psi0 the middle of its maximum and minimum

    Parameters
        start : float [rad] - phi0
    Raises
        NoSolution - where the five-bar opens
    Example
        >>> bar = FunctionFiveBar(1.0, 0.110143, 1.18548, 0.320633, 0.503643, 2.0, 0.375818)
        >>> log = Wanted("log", (1.0, 2.0), math.radians(60.0), math.radians(90.0))
        >>> round(math.degrees(structural_error(bar, 1.343624, log).greatest), 6)
        0.005921

    Source
        own derivation; the error that is alike at its extremes: P. L. Chebyshev
    """
    bar.closure(start, start + wanted.input_swing)
    s = np.linspace(0.0, 1.0, 721)
    base = outputs(bar, start + wanted.input_swing * s)

    def error(share: Reals) -> Reals:
        near = np.asarray(np.interp(share, s, base))
        each = bar.directions(start + wanted.input_swing * np.atleast_1d(share))
        psi = near + np.remainder(each - near + math.pi, 2.0 * math.pi) - math.pi
        return np.asarray(psi - wanted.output(share))

    rough = base - wanted.output(s)
    rise, fall = rough[1:-1] - rough[:-2], rough[2:] - rough[1:-1]
    inside, places = np.flatnonzero(rise * fall < 0.0)[:, None] + 1, [0.0, 1.0]
    if inside.size:
        side = np.sign(rise[inside - 1])
        tops: Any = maximum_over(lambda x: side * error(x), s[inside - 1], s[inside + 1], samples=4)  # type: ignore[arg-type]
        places[1:1] = tops.place.ravel().tolist()
    values = error(np.array(places))
    middle = 0.5 * float(values.max() + values.min())
    return StructuralError(
        0.5 * float(values.max() - values.min()), middle, tuple(places), tuple((values - middle).tolist())
    )
