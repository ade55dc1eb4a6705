"""Linkages in one unknown length whose output steps back with each of them: back-step, longest dwell, flattest window.

Without a momentary dwell in the range the back-step has a minimum value above 0 there. A wider band is filled by the
back-step of a linkage to either side of that place, as everywhere; a narrower one by none, and the output dwells about
one of its two standstills. The window as a function of the length has several humps then and jumps where the back-step
fills the band, so it is looked at over the whole range.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property

from gearlink.core.numerics.roots import bracketed_root, maximum, roots_on
from gearlink.core.parts.linkages.band_dwell import Valley, band_of_window, longest_in_band

_NODES = 24
_INSIDE = math.radians(1e-3)  # beside a limit of the transmission angle, for the digits of a printed frame


@dataclass(frozen=True)
class AlwaysStepping:
    """A range of a length within which every output steps back once a revolution.

    Fields
        valley_of : the valley of the output's speed at a length
        low, high : float [mm] - the range, of linkages that turn
    """

    valley_of: Callable[[float], Valley]
    low: float
    high: float
    kept: dict[float, Valley] = field(default_factory=dict, repr=False)

    def within(self, low: float, high: float) -> AlwaysStepping | None:
        """The part of it between two lengths [mm]; None where there is none."""
        low, high = max(low, self.low), min(high, self.high)
        return AlwaysStepping(self.valley_of, low, high, self.kept) if low < high else None

    def valley(self, length: float) -> Valley:
        """The valley at a length, found once."""
        if length not in self.kept:
            self.kept[length] = self.valley_of(length)
        return self.kept[length]

    def step(self, length: float) -> float:
        """The back-step D [rad] of a length."""
        valley = self.valley(length)
        return valley.angle(valley.first) - valley.angle(valley.second)

    def window(self, length: float, tolerance: float) -> float:
        """The longest crank angle [rad] within +- a tolerance [rad] at a length."""
        return longest_in_band(self.valley(length), tolerance).crank_angle

    def ripple(self, length: float) -> float:
        """The window [rad] within the band that the back-step fills: all of a revolution that gains no more than it."""
        half, mean = 0.5 * self.step(length), self.valley(length).mean
        return self.window(length, half) if half < math.pi * mean else 2.0 * math.pi

    @cached_property
    def _even(self) -> list[float]:
        return [self.low + k / _NODES * (self.high - self.low) for k in range(_NODES + 1)]

    @cached_property
    def least_step(self) -> tuple[float, float]:
        """Length and back-step [rad] of the smallest one."""
        place, value = self._best(lambda length: -self.step(length), self._even)
        return place, -value

    @cached_property
    def _nodes(self) -> list[float]:
        """Lengths between which the back-step runs one way."""
        return sorted({*self._even, self.least_step[0]})

    def with_step(self, angle: float) -> list[float]:
        """Lengths whose back-step is an angle [rad]; to either side of the smallest one, or none."""
        return roots_on(lambda length: self.step(length) - angle, self._nodes)

    def longest(self, tolerance: float) -> tuple[float, float]:
        """Length with the longest window within a tolerance [rad], and that window [rad]."""
        filled = [(length, self.ripple(length)) for length in self.with_step(2.0 * tolerance)]
        return max(
            [*filled, self._best(lambda length: self.window(length, tolerance), self._nodes)], key=lambda at: at[1]
        )

    def flattest(self, window: float) -> tuple[float, float]:
        """Length with which the output keeps nearest to its place over a window [rad], and how near [rad]."""
        even = [(x, -0.5 * self.step(x)) for x in roots_on(lambda x: self.ripple(x) - window, self._nodes)]
        least = self._best(lambda length: -band_of_window(self.valley(length), window), self._nodes)
        place, value = max([*even, least], key=lambda at: at[1])
        return place, -value

    def interval(self, length: float, window: float, tolerance: float) -> list[float]:
        """Lengths about one that meets a request between which all meet it, [low, high] [mm]."""

        def spare(other: float) -> float:
            return self.window(other, tolerance) - window

        def end(ahead: list[float]) -> float:
            near, room = length, spare(length)
            for other in ahead:
                if (lack := spare(other)) < 0.0:
                    return bracketed_root(spare, near, other, ends=(room, lack)) if room > 0.0 else near
                near, room = other, lack
            return near

        before = [x for x in reversed(self._nodes) if x < length]
        return [end(before), end([x for x in self._nodes if x > length])]

    def _best(self, measure: Callable[[float], float], nodes: list[float]) -> tuple[float, float]:
        """Length and value of the maximum value of a measure, between the neighbours of the best node."""
        values = [measure(node) for node in nodes]
        at = max(range(len(nodes)), key=values.__getitem__)
        return maximum(measure, nodes[max(0, at - 1)], nodes[min(len(nodes) - 1, at + 1)])


def keeping(always: AlwaysStepping, crank: float, coupler: float, rocker: float, angle: float) -> list[AlwaysStepping]:
    """The frames of crank-rockers whose transmission angle is nowhere less than an angle, if any, and then all frames.

    d - a >= sqrt(b^2 + c^2 - 2 b c cos mu),   d + a <= sqrt(b^2 + c^2 + 2 b c cos mu)

    Parameters
        always : AlwaysStepping - of the frames
        crank, coupler, rocker : float [mm] - a, b, c
        angle : float [rad] - mu
    """
    squares, both = coupler**2 + rocker**2, 2.0 * coupler * rocker * math.cos(angle + _INSIDE)
    kept = always.within(math.sqrt(squares - both) + crank, math.sqrt(squares + both) - crank)
    return [always] if kept is None else [kept, always]


def flattest_of(parts: list[AlwaysStepping], window: float, band: float | None) -> tuple[float, float]:
    """Length and tolerance [rad] of a window [rad] in the first part that holds it within a band [rad], or the last."""
    for part in parts:
        length, least = part.flattest(window)
        if band is None or least <= band:
            break
    return length, least
