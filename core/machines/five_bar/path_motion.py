"""The geared five-bar: two links geared to each other move both ends of a pair of couplers, whose point M draws a path.

Frame: input pivot A = 0, output pivot E = (d, 0); input a = AB, coupler b = BC, follower c = CD, output e = ED. With
the input at phi the output link stands at delta + k phi, k the gear ratio. C is the pin of the dyad BC, CD; M lies on
the coupler, u along B->C and v to the left of it:

    M = B + (u + i v) e^(i t2)
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from fractions import Fraction

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.numerics.harmonic_sum import HarmonicSum
from gearlink.core.parts.linkages.dyad import close_dyad, require_lengths, require_span, worst_transmission

TURN = 2.0 * math.pi


@dataclass(frozen=True)
class PathFiveBar:
    """Links, gear ratio and phase of a geared five-bar.

    Parameters
        input, coupler, follower, output, frame : float [mm] - a, b, c, e, d
        ratio : Fraction - k = output over input speed, negative for a direct external mesh
        phase : float [rad] - delta, direction of the output link at input angle 0
        assembly : +1 or -1 - +1: C left of the vector B->D
    Raises
        NoSolution - for a length that is not positive and finite, or a ratio of zero
    Notes
        A five-bar that opens somewhere may be made; `closure` refuses it.
    Example
        >>> bar = PathFiveBar(20.0, 60.0, 60.0, 20.0, 50.0, Fraction(-1), math.radians(90.0))
        >>> point = bar.point(0.0, complex(60.0, 0.0))
        >>> round(point.real, 9), round(point.imag, 9)
        (3.255830335, 57.616254497)

    Source
        thesis 2.2.1, figure 2-1; formulas: own derivation
    """

    input: float
    coupler: float
    follower: float
    output: float
    frame: float
    ratio: Fraction
    phase: float
    assembly: int = 1

    def __post_init__(self) -> None:
        require_lengths(
            input=self.input, coupler=self.coupler, follower=self.follower, output=self.output, frame=self.frame
        )
        if self.ratio == 0:
            raise NoSolution("gear ratio is 0; the output link would be at rest")

    @property
    def period_turns(self) -> int:
        """Input turns after which everything repeats: the denominator of the reduced ratio."""
        return self.ratio.denominator

    @property
    def period(self) -> float:
        """Input angle of the period [rad]."""
        return TURN * self.period_turns

    def ends(self, phi: float) -> tuple[complex, complex]:
        """The pins B and D [mm]."""
        pin = cmath.rect(self.input, phi)
        return pin, self.frame + cmath.rect(self.output, self.phase + float(self.ratio) * phi)

    @cached_property
    def span_squared(self) -> HarmonicSum:
        """|BD|^2 over the input angle.

        a^2 + d^2 + e^2 + 2 d e cos(delta + k phi) - 2 a d cos(phi) - 2 a e cos((1 - k) phi - delta)
        """
        a, d, e, k = self.input, self.frame, self.output, float(self.ratio)
        terms = ((2.0 * d * e, k, self.phase), (-2.0 * a * d, 1.0, 0.0), (-2.0 * a * e, 1.0 - k, -self.phase))
        return HarmonicSum(math.fsum((a * a, d * d, e * e)), terms)

    @cached_property
    def span_extremes(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Minimum and maximum |BD| over the period, each as (input angle [rad], distance [mm]).

        Example
            >>> bar = PathFiveBar(20.0, 60.0, 60.0, 20.0, 50.0, Fraction(-1), math.radians(90.0))
            >>> [round(distance, 9) for _, distance in bar.span_extremes]
            [35.355339059, 83.237173935]
        """
        (low, least), (high, greatest) = self.span_squared.extremes(0.0, self.period)
        return (low % self.period, math.sqrt(max(least, 0.0))), (high % self.period, math.sqrt(greatest))

    def closure(self) -> None:
        """Refuse a five-bar whose couplers do not reach from B to D at every input angle.

        |b - c| < |BD| < b + c  over the period

        Raises
            NoSolution - naming the worst input angle, the distance there, the limit, and by how much to change it
        """
        links = {"coupler": self.coupler, "follower": self.follower}
        ways = (", or shorten input or output",) * 2
        require_span("BD", links, self.span_extremes, ways, aside=f" (of {360 * self.period_turns})")

    def min_transmission_angle(self) -> tuple[float, float]:
        """Minimum angle between coupler and follower over the period, an obtuse one counted from the other side.

        Returns
            angle, place : float, float [rad] - and the input angle at which it occurs
        Raises
            NoSolution - where the five-bar opens
        Source
            own derivation; VDI 2142
        """
        self.closure()
        return worst_transmission(self.span_extremes, self.coupler, self.follower)

    def coupler_angle(self, phi: float) -> float:
        """Direction of the coupler B->C in (-pi, pi] [rad].

        Raises
            NoSolution - where the five-bar opens at that input angle
        """
        start, end = self.ends(phi)
        return cmath.phase(close_dyad(start, end, self.coupler, self.follower, self.assembly) - start)

    def point(self, phi: float, offset: complex) -> complex:
        """The coupler point M [mm].

        Parameters
            phi : float [rad]
            offset : complex [mm] - u + i v: u along B->C, v to its left
        Raises
            NoSolution - as `coupler_angle`
        """
        start, end = self.ends(phi)
        joint = close_dyad(start, end, self.coupler, self.follower, self.assembly)
        return start + offset * (joint - start) / self.coupler
