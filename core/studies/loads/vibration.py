"""Vibration of what is driven through a spring: residual in the dwells, periodic response, harmonics; of one design.

z'' + 2 zeta w_n z' + w_n^2 z = -x''  with x imposed and z the deflection. With lam = -zeta w_n + i w_d it is
z = -Im Z/w_d, Z(t) = int x''(s) e^(lam (t - s)) ds; where x rests |Z|/w_d is the amplitude that is left.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.base.errors import MissingSection, NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.base.torsion import torsional_stiffness
from gearlink.core.mechanism.joints import NEWTON_METER, Pin
from gearlink.core.mechanism.links import FRAME
from gearlink.core.mechanism.rates import dot
from gearlink.core.numerics.arrays import Points, Reals, distinct
from gearlink.core.numerics.extremes import extremes_over
from gearlink.core.numerics.gauss import gauss_legendre

if TYPE_CHECKING:
    from gearlink.core.studies.loads.design import LoadsDesign


ASSUMED_DAMPING = 0.03
_NODES = 16
_PHASE = 6.0
"""Phase of the vibration over a panel [rad]: 16 Gauss nodes take it to rounding."""
_STEP = math.radians(10.0)
_UNBOUNDED, _STANDING, _ROUNDING = 1e-6, 1e-9, 1e-11
_LEAST_RATIO, _MOST_RATIO = 1e-6, 1e4
_BLOCK, _AT_ONCE = 8192, 100
_DIGITS = 13
"""Of the widths of panels that count as one."""
_TOUCH = 1e-9
"""Angle between dwells that are one [rad]."""
Function = Callable[[Reals], Reals]


def bounded(frequency: float, speed: float, key: str) -> float:
    """A natural frequency [rad/s] whose vibration over a revolution of the input [rad/s] can be followed.

    Raises
        NoSolution - outside of 1e-6 to 10000 times the input's speed, with the key of the file
    """
    ratio = frequency / abs(speed)
    if _LEAST_RATIO <= ratio <= _MOST_RATIO:
        return frequency
    what, fix = "moves as a rigid one does", "omit vibration"
    if ratio < _LEAST_RATIO:
        what, fix = "does not follow its drive", f"raise {key}"
    message = f"the natural frequency is {ratio:.3g} times that of the input, outside of {_LEAST_RATIO:g} to "
    raise NoSolution(f"{message}{_MOST_RATIO:g}; such an output {what}", key=key, fix=fix)


@dataclass(frozen=True)
class Oscillator:
    """Natural frequency w_n [rad/s] and damping ratio zeta of one degree of freedom."""

    frequency: float
    damping: float = ASSUMED_DAMPING

    @property
    def damped(self) -> float:
        """w_d [rad/s]."""
        return self.frequency * math.sqrt(1.0 - self.damping**2)

    @property
    def exponent(self) -> complex:
        """lam = -zeta w_n + i w_d [1/s]."""
        return complex(-self.damping * self.frequency, self.damped)


@dataclass(frozen=True)
class Panelled:
    """Second derivative of a motion at the Gauss nodes of panels over an interval of the input angle.

    Fields
        edges : (n + 1,) array [rad]
        nodes, weights : (n, 16) arrays [rad]
        values : (n, 16) array [per rad^2] - x''
    """

    edges: Reals
    nodes: Reals
    weights: Reals
    values: Reals

    @classmethod
    def of(cls, bend: Function, start: float, end: float, breaks: Sequence[float], phase: float) -> Panelled:
        """A motion between two input angles.

        Parameters
            bend : function of input angles - x''
            start, end : float [rad]
            breaks : input angles where x'' or a derivative jumps [rad]
            phase : float [1] - phase of the vibration per input angle, w_n/Om, at the slowest speed that is asked for
        """
        step = min(_STEP, _PHASE / phase)
        bounds = [start, *sorted(place for place in breaks if start < place < end), end]
        parts = [np.linspace(a, b, math.ceil((b - a) / step) + 1)[:-1] for a, b in pairwise(bounds)]
        edges = np.append(np.concatenate(parts), end)
        x, w = gauss_legendre(_NODES)
        width = np.diff(edges)[:, None]
        nodes = edges[:-1, None] + width * (0.5 * (x + 1.0))
        return cls(edges, nodes, 0.5 * width * w, bend(nodes.ravel()).reshape(nodes.shape))

    def state(self, oscillator: Oscillator, speed: float) -> complex:
        """Z at the end, from rest at the start; x in its own unit times the frequency.

        Parameters
            speed : float [rad/s] - Om > 0
        """
        rate = oscillator.exponent / speed
        return complex(speed * np.sum(self.weights * self.values * np.exp(rate * (self.edges[-1] - self.nodes))))

    def residual(self, oscillator: Oscillator, speed: float) -> float:
        """Amplitude that is left at the end, in the unit of x.

        Example
            >>> rise = Panelled.of(lambda u: 2.0 * math.pi * np.sin(2.0 * math.pi * u), 0.0, 1.0, [], 10.0)
            >>> round(rise.residual(Oscillator(2.0 * math.pi, 0.0), 1.0), 12)  # a cycloid of one natural period: h/2
            0.5
        """
        return abs(self.state(oscillator, speed)) / oscillator.damped

    def residuals(self, oscillator: Oscillator, speeds: Reals) -> Reals:
        """The residual at each of some speeds; no value depends on the others."""
        exponent, left = oscillator.exponent, (self.edges[-1] - self.nodes).ravel()
        rates, values = exponent.real / speeds + 1j * (exponent.imag / speeds), (self.weights * self.values).ravel()
        at_once, found = max(1, _BLOCK // left.size), np.empty(len(speeds))
        for start in range(0, len(speeds), at_once):
            part = slice(start, start + at_once)
            found[part] = np.abs(speeds[part] * np.sum(values * np.exp(rates[part, None] * left), axis=1))
        return found / oscillator.damped

    def rough_residuals(self, oscillator: Oscillator, speeds: Reals) -> Reals:
        """The same to some 1e-13 of the largest, by an eighth of the exponentials.

        e^(lam (b - s)) = e^(lam (b - e)) e^(lam (e - s)),  e the end of the panel: panels of one width share the second
        """
        rates, ends = (oscillator.exponent / speeds)[:, None], self.edges[1:]
        found: Points = np.zeros(len(speeds), dtype=np.complex128)
        widths = np.round(np.diff(self.edges), _DIGITS)
        for width in distinct(widths):
            alike = widths == width
            inner = np.exp(rates * (ends[alike][0] - self.nodes[alike][0])) @ (self.weights * self.values)[alike].T
            found += np.sum(np.exp(rates * (self.edges[-1] - ends[alike])) * inner, axis=1)
        return np.abs(speeds * found) / oscillator.damped


@dataclass(frozen=True)
class PeriodicResponse:
    """Steady state of a motion that repeats, exact for any law that is smooth between its breaks.

    Parameters
        bend : function of input angles - x'' [per rad^2]
        period : float [rad]
        breaks : input angles where x'' or a derivative jumps
        speed : float [rad/s] - Om > 0
    """

    bend: Function
    period: float
    breaks: tuple[float, ...]
    oscillator: Oscillator
    speed: float

    @cached_property
    def _rate(self) -> complex:
        return self.oscillator.exponent / self.speed

    @cached_property
    def _panels(self) -> Panelled:
        phase = max(self.oscillator.frequency / self.speed, 1e-9)
        return Panelled.of(self.bend, 0.0, self.period, self.breaks, phase)

    @cached_property
    def gain(self) -> float:
        """|1 - e^(lam T)|: next to nothing where a harmonic of an undamped motion is the natural frequency."""
        return abs(_one_less_exp(self._rate * self.period))

    @property
    def unbounded(self) -> bool:
        """Whether the amplitude grows without limit: no damping, and a harmonic at the natural frequency."""
        if self.oscillator.damping or self.gain >= _UNBOUNDED:
            return False
        # the harmonics beside the natural frequency give as much as the gain
        size = self.speed * float(np.sum(self._panels.weights * np.abs(self._panels.values)))
        return abs(self._of_period) > (_ROUNDING + 10.0 * self.gain) * size

    @cached_property
    def _pieces(self) -> Points:
        """What each panel adds to Z at its end."""
        panels, rate = self._panels, self._rate
        decay = np.exp(rate * (panels.edges[1:, None] - panels.nodes))
        return np.asarray(self.speed * np.sum(panels.weights * panels.values * decay, axis=1))

    @cached_property
    def _of_period(self) -> complex:
        """What a period adds to Z at its end."""
        return complex(np.sum(self._pieces * np.exp(self._rate * (self.period - self._panels.edges[1:]))))

    def _start(self) -> complex:
        """Z at the start of the steady state, F/(1 - e^(lam T)).

        Notes
            Of a motion without the harmonic that would be at rest in it, whose F is rounding, the state without that
            harmonic: the mean of Z e^(-lam t) vanishes.
        """
        panels, rate = self._panels, self._rate
        if self.oscillator.damping or self.gain >= _STANDING:
            return self._of_period / _one_less_exp(rate * self.period)
        left = (1.0 - panels.nodes / self.period) * np.exp(-rate * panels.nodes)
        return complex(-self.speed * np.sum(panels.weights * panels.values * left))

    @cached_property
    def _states(self) -> Points:
        """Z at the edges of the panels."""
        panels, rate, pieces = self._panels, self._rate, self._pieces
        states = np.empty(len(panels.edges), dtype=np.complex128)
        states[0] = self._start()
        for k, decay in enumerate(np.exp(rate * np.diff(panels.edges))):
            states[k + 1] = states[k] * decay + pieces[k]
        return states

    def state(self, phi: Reals) -> Points:
        """Z at input angles within the period."""
        panels, rate = self._panels, self._rate
        row = np.searchsorted(panels.edges[1:-1], phi, side="right")
        start = panels.edges[row]
        x, w = gauss_legendre(_NODES)
        width = (phi - start)[:, None]
        nodes = start[:, None] + width * (0.5 * (x + 1.0))
        values = self.bend(nodes.ravel()).reshape(nodes.shape)
        added = self.speed * np.sum(0.5 * width * w * values * np.exp(rate * (phi[:, None] - nodes)), axis=1)
        return np.asarray(self._states[row] * np.exp(rate * (phi - start)) + added)

    def deflection(self, phi: Reals) -> Reals:
        """z at input angles, in the unit of x."""
        return np.asarray(-self.state(phi).imag / self.oscillator.damped)


def _one_less_exp(z: complex) -> complex:
    """1 - e^z without loss near z = 0."""
    if abs(z) > 0.5:
        return 1.0 - cmath.exp(z)
    half = 0.5 * z
    return -2.0 * cmath.exp(half) * cmath.sinh(half)


def speed_limit(motion: Panelled, oscillator: Oscillator, speeds: Reals, allowed: float) -> float | None:
    """Minimum speed at which the residual of a motion passes what is allowed; None where it does at none of them.

    Parameters
        speeds : ascending array [rad/s]
        allowed : float - in the unit of x
    Returns
        speed : float [rad/s] - refined between two of the speeds by bisection
    Notes
        The lobes between the zeros move with damping and load: this is where the first of them passes.
    """
    first = _first_above(motion, oscillator, speeds, allowed)
    if first is None:
        return None
    if first == 0:
        return float(speeds[0])
    low, high = float(speeds[first - 1]), float(speeds[first])
    for _ in range(48):
        middle = 0.5 * (low + high)
        if motion.residual(oscillator, middle) > allowed:
            high = middle
        else:
            low = middle
    return high


def _first_above(motion: Panelled, oscillator: Oscillator, speeds: Reals, allowed: float) -> int | None:
    """Number of the first speed at which the residual passes what is allowed; those behind it are not looked at."""
    for start in range(0, len(speeds), _AT_ONCE):
        above = motion.rough_residuals(oscillator, speeds[start : start + _AT_ONCE]) > allowed
        if above.any():
            return start + int(np.argmax(above))
    return None


def harmonics(values: Reals, orders: int) -> Reals:
    """Amplitudes of the harmonics 1, 2 ... of a function given at equal steps of its period.

    Example
        >>> x = np.arange(64) * (2.0 * math.pi / 64)
        >>> [round(float(a), 12) for a in harmonics(3.0 + 2.0 * np.cos(x) - 0.5 * np.sin(3.0 * x), 3)]
        [2.0, 0.0, 0.5]
    """
    spectrum = np.fft.rfft(values) / len(values)
    return np.asarray(2.0 * np.abs(spectrum[1 : orders + 1]))


_DEGREES = 180.0 / math.pi
_MOST_PERIODS = 40.0
_PER_UNIT = 50
_PER_TURN, _PER_PERIOD, _MOST_ROWS = 115.0, 2.0, 20_000  # by radians: two a degree, and twelve a natural period


def _joined(zones: Sequence[tuple[float, float]], period: float) -> list[tuple[float, float]]:
    """Ascending dwells, those that touch as one, also over the end of the period."""
    found: list[tuple[float, float]] = []
    for start, width in zones:
        if found and start - sum(found[-1]) <= _TOUCH:
            before = found.pop()[0]
            found.append((before, start + width - before))
        else:
            found.append((start, width))
    if len(found) > 1 and found[0][0] + period - sum(found[-1]) <= _TOUCH:
        (start, width), last = found.pop(0), found.pop()[0]
        found.append((last, start + period + width - last))
    return found


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

    @property
    def swung(self) -> float:
        """Mass of the output [kg], or I + m c^2 about its pin on the frame [kg m^2]; 0 where the file gives none."""
        design = self.design
        mass = design.masses.get(design.output)
        if mass is None or self.slides:
            return 0.0 if mass is None else mass.mass
        mechanism = design.machine.at(np.zeros(1))
        axes = [each.at[0] for each in mechanism.connections
                if isinstance(each, Pin) and (each.first, each.second) == (FRAME, design.output)]  # fmt: skip
        if not axes:
            return mass.inertia
        off = abs(mechanism.links[design.output].at(mass.center).value[0] - axes[0])
        return float(mass.inertia + mass.mass * (off / NEWTON_METER) ** 2)

    @cached_property
    def inertia(self) -> float:
        """Mass [kg] or moment of inertia about its axis [kg m^2] of the output."""
        found = self.swung
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
            stiffness = torsional_stiffness(self.section.stiffness)
            if self.slides and not isinstance(self.section.stiffness, float):
                message = f"the output {self.design.output} slides: the sizes of a shaft tell nothing of its drive"
                raise NoSolution(
                    message, key="loads.vibration.stiffness", fix="give the stiffness in N/mm, or frequency"
                )
            frequency = math.sqrt(stiffness * (1e3 if self.slides else 1.0) / self.inertia)
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
        return self._course(phi, 2)

    def place(self, phi: Reals) -> Reals:
        """Place of the output [deg or mm]."""
        return self._course(phi, 0)

    def _course(self, phi: Reals, order: int) -> Reals:
        mechanism = self.design.machine.at(phi)
        link = mechanism.links[self.design.output]
        if self.slides:
            return dot(mechanism.travel[self.design.output], link.origin[order])
        return _DEGREES * link.turn[order]

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
        """Start and width of each dwell of the output within its own period, ascending [rad]; touching ones are one."""
        design, zones = self.design, self.design.dwell_zones
        own = zones[: len(zones) * design.motion_turns // design.turns]
        return _joined(sorted((start % self.period, width) for start, width in own), self.period)

    @cached_property
    def motions(self) -> list[tuple[float, float]]:
        """Start and end of each motion that ends in a dwell; the end lies within the period or after it [rad]."""
        period, found = self.period, []
        for i, (start, _) in enumerate(self.dwells):
            before, width = self.dwells[i - 1]
            left = before + width
            left -= period if left > start else 0.0
            if start - left > _TOUCH:  # else the output stands all the time
                found.append((left, start))
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
        """Maximum less minimum place over the output's own period [deg or mm]."""
        wanted, joints = [(self.place, False), (self.place, True)], self._breaks
        low, high = extremes_over(wanted, 0.0, self.period, joints=joints, samples=360 * self.design.motion_turns)
        return high.value - low.value

    @cached_property
    def speed_limit(self) -> float | None:
        """Minimum speed of the input at which a motion leaves more than is allowed [rad/s]."""
        allowed = self.section.allowed_residual
        return None if allowed is None else self.speed_leaving(allowed)

    def speed_leaving(self, amplitude: float) -> float | None:
        """Minimum speed of the input at which a motion leaves more than an amplitude [deg or mm], in rad/s."""
        if not self.motions or not self.design.stands:
            return None
        found = []
        for start, end in self.motions:
            slowest = (end - start) * self.frequency / _MOST_PERIODS
            ratios = np.linspace(_MOST_PERIODS, 1.0, round(_MOST_PERIODS - 1.0) * _PER_UNIT + 1)
            speeds = (end - start) * self.frequency / ratios
            found.append(speed_limit(self._panelled(start, end, slowest), self.oscillator, speeds, amplitude))
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
