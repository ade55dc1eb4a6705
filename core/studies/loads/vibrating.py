"""The vibration of one design: its output on a spring, in its dwells and over the period."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.base.errors import MissingSection, NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.mechanism.rates import dot
from gearlink.core.numerics.extremes import extremes_over
from gearlink.core.studies.loads.vibration import (
    ASSUMED_DAMPING,
    Oscillator,
    Panelled,
    PeriodicResponse,
    bounded,
    speed_limit,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.studies.loads.design import LoadsDesign

_DEGREES = 180.0 / math.pi
_MOST_PERIODS = 40.0
_PER_UNIT = 50
_PER_TURN, _PER_PERIOD, _MOST_ROWS = 115.0, 2.0, 20_000  # by radians: two a degree, and twelve a natural period


class Vibrating:
    """The output of a design as a mass on a spring; places in deg where it turns, in mm where it slides.

    Parameters
        design : LoadsDesign - with the section `vibration`
    """

    def __init__(self, design: LoadsDesign) -> None:
        self.design, self.section = design, design.section.vibration

    @property
    def slides(self) -> bool:
        """Whether the output slides."""
        return self.design.output in self.design.sliding

    @cached_property
    def inertia(self) -> float:
        """Mass [kg] or moment of inertia [kg m^2] of the output."""
        mass = self.design.masses.get(self.design.output)
        found = 0.0 if mass is None else mass.mass if self.slides else mass.inertia
        if found == 0.0 and self.section.stiffness is not None:
            what = "mass" if self.slides else "inertia"
            raise MissingSection(
                f"loads.vibration.stiffness needs the {what} of {self.design.output}",
                key="loads.vibration.stiffness",
                fix="give it, or frequency instead",
            )
        return found

    @cached_property
    def oscillator(self) -> Oscillator:
        """Natural frequency and damping."""
        if self.design.jumps:
            raise NoSolution(
                "the speed of this machine jumps: its vibration after a blow is not in the model",
                key="loads.vibration",
                fix="omit vibration",
            )
        damping = ASSUMED_DAMPING if self.section.damping is None else self.section.damping
        given = "stiffness" if self.section.frequency is None else "frequency"
        if given == "frequency":
            frequency = 2.0 * math.pi * self.section.frequency
        else:
            frequency = math.sqrt(self.section.stiffness * (1e3 if self.slides else 1.0) / self.inertia)
        frequency = bounded(frequency, self.design.speed, f"loads.vibration.{given}")
        return Oscillator(frequency, damping)

    @cached_property
    def period(self) -> float:
        """Input angle after which the output repeats [rad]: forces of gears out of balance do not move it."""
        design = self.design
        return design.machine.period * design.motion_turns / design.turns

    @cached_property
    def _breaks(self) -> list[float]:
        """Places within it where its acceleration may jump [rad]."""
        apart = 64.0 * float(np.spacing(self.period))
        return [place for place in self.design.machine.breaks if place < self.period - apart]

    @property
    def frequency(self) -> float:
        """Natural frequency [Hz], to the bit where the file gives it."""
        found = self.oscillator.frequency  # refuses what has none
        return found / (2.0 * math.pi) if self.section.frequency is None else float(self.section.frequency)

    @property
    def frequency_ratio(self) -> float:
        """Natural frequency over that of the input: 60 Hz over 120 revolutions a minute are exactly 30."""
        return self.frequency * self.design.speed_seconds / abs(self.design.given_speed)

    def bend(self, phi: Reals) -> Reals:
        """Second derivative of the output's place by the input angle [deg/rad^2 or mm/rad^2]."""
        mechanism = self.design.machine.at(phi)
        link = mechanism.links[self.design.output]
        if self.slides:
            return dot(mechanism.travel[self.design.output], link.origin.second)
        return _DEGREES * link.turn.second

    def place(self, phi: Reals) -> Reals:
        """Place of the output [deg or mm]."""
        mechanism = self.design.machine.at(phi)
        link = mechanism.links[self.design.output]
        if self.slides:
            return dot(mechanism.travel[self.design.output], link.origin.value)
        return _DEGREES * link.turn.value

    @cached_property
    def response(self) -> PeriodicResponse:
        """The periodic steady state, by the angle that the input has turned through in its own sense."""
        breaks = sorted(-place % self.period for place in self._breaks) if self._backwards else self._breaks
        bend: Callable[[Reals], Reals] = self._bend_backwards if self._backwards else self.bend
        return PeriodicResponse(bend, self.period, tuple(breaks), self.oscillator, abs(self.design.speed))

    def _bend_backwards(self, turned: Reals) -> Reals:
        return self.bend(np.mod(-turned, self.period))

    @property
    def _backwards(self) -> bool:
        """Whether the input turns towards smaller angles: what comes after a motion is then before it."""
        return self.design.speed < 0.0

    # Motions between the dwells

    @cached_property
    def dwells(self) -> list[tuple[float, float]]:
        """Start and width of each dwell of the output within its own period, ascending [rad]."""
        design, zones = self.design, self.design.dwell_zones
        own = zones[: len(zones) * design.motion_turns // design.turns]
        return sorted((start % self.period, width) for start, width in own)

    @cached_property
    def motions(self) -> list[tuple[float, float]]:
        """Start and end of each motion that ends in a dwell; the end lies within the period or after it [rad]."""
        period, found = self.period, []
        for i, (start, _) in enumerate(self.dwells):
            before, width = self.dwells[i - 1]
            left = before + width
            found.append((left - period if left > start else left, start))
        return found

    def _panelled(self, start: float, end: float, slowest: float) -> Panelled:
        breaks = [place + turn for place in self._breaks for turn in (-self.period, 0.0, self.period)]
        breaks += [0.0, -self.period]
        return Panelled.of(
            lambda phi: self.bend(np.mod(phi, self.period)), start, end, breaks, self.oscillator.frequency / slowest
        )

    @cached_property
    def rise_periods(self) -> float | None:
        """Natural periods in the shortest motion between two dwells; None without dwells."""
        if not self.motions:
            return None
        angle = min(end - start for start, end in self.motions)
        return angle / abs(self.design.speed) * self.oscillator.frequency / (2.0 * math.pi)

    @cached_property
    def residual(self) -> float | None:
        """Maximum amplitude that a motion from rest leaves in the dwell after it [deg or mm]; None without dwells."""
        if not self.motions or not self.design.stands:
            return None
        speed = abs(self.design.speed)
        return max(self._panelled(a, b, speed).residual(self.oscillator, speed) for a, b in self.motions)

    @cached_property
    def lift(self) -> float:
        """Maximum less minimum place over the period [deg or mm]."""
        low, high = (self.design.extreme(self.place, greatest) for greatest in (False, True))
        return high.value - low.value

    @cached_property
    def speed_limit(self) -> float | None:
        """Minimum speed of the input at which a motion leaves more than is allowed [rad/s]."""
        allowed = self.section.allowed_residual
        if allowed is None or not self.motions or not self.design.stands:
            return None
        found = []
        for start, end in self.motions:
            slowest = (end - start) * self.frequency / _MOST_PERIODS
            ratios = np.linspace(_MOST_PERIODS, 1.0, round(_MOST_PERIODS - 1.0) * _PER_UNIT + 1)
            speeds = (end - start) * self.frequency / ratios
            found.append(speed_limit(self._panelled(start, end, slowest), self.oscillator, speeds, allowed))
        return min((speed for speed in found if speed is not None), default=None)

    def spectrum(self, count: int) -> tuple[Reals, Reals, Reals]:
        """Shares of the design's speed from 0.1 to 1.3, r and residual there."""
        shares = np.linspace(0.1, 1.3, count)
        speed = abs(self.design.speed)
        motions = [self._panelled(a, b, 0.1 * speed) for a, b in self.motions] if self.design.stands else []
        left = [motion.residuals(self.oscillator, shares * speed) for motion in motions]
        return shares, (self.rise_periods or math.nan) / shares, np.max(left or [np.full(count, np.nan)], axis=0)

    # In the dwell

    @cached_property
    def twist(self) -> float | None:
        """Maximum deflection in the dwells in the steady state [deg or mm]; None without dwells or a steady state."""
        if not self.dwells or self.response.unbounded:
            return None
        return max(self._in_dwell(lambda phi: np.abs(self.deflection(phi)), zone)[1] for zone in self.dwells)

    @cached_property
    def twisted_ripple(self) -> float | None:
        """Maximum less minimum place of the output with its deflection in a dwell [deg or mm]."""
        if not self.dwells or self.response.unbounded:
            return None
        ranges = [self._in_dwell(lambda phi: self.place(phi) + self.deflection(phi), zone)
                  for zone in self.dwells]  # fmt: skip
        return max(high - low for low, high in ranges)

    def deflection(self, phi: Reals) -> Reals:
        """Deflection in the steady state [deg or mm]."""
        turned = np.negative(phi) if self._backwards else phi
        return self.response.deflection(np.mod(turned, self.period))

    def rows(self, width: float) -> int:
        """Rows over an angle of the input [rad] in which each natural period is seen, at most 20000."""
        return min(max(math.ceil(_PER_TURN * width), math.ceil(_PER_PERIOD * width * self.frequency_ratio)), _MOST_ROWS)

    def _in_dwell(self, f: Callable[[Reals], Reals], zone: tuple[float, float]) -> tuple[float, float]:
        """Minimum and maximum value in a dwell of a function of the input angle, refined."""
        start, width = zone
        wanted = [(f, False), (f, True)]
        low, high = extremes_over(wanted, start, start + width, samples=self.rows(width))
        return low.value, high.value
