"""Dynamic coefficient of a wide-swing drive: what its torsional elasticity adds to the calculated torque.

q'' + 2 zeta w q' + w^2 q = -gamma c(k) (1/T^2 - 1/T0^2), torque M = -J w^2 q; in units of the calculated torque's
scale y'' + 2 zeta W y' + W^2 y = W^2 c(k) with W = w T and derivatives with respect to k.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.extremes import maximum_over
from gearlink.core.numerics.periodic import CosineSeries, cosine_coefficients, cosine_series

STIFFEST = 20_000.0
"""Natural frequency times stroke time from which the search for the peak takes seconds and finds the step's alone."""


def acceleration_series(acceleration: Callable[[Reals], Reals]) -> CosineSeries:
    """Acceleration invariant of a stroke from rest to rest as a cosine series.

    c(k) = sum c_j cos(j pi k)

    Parameters
        acceleration : c(k), vectorised
    Returns
        series : CosineSeries over 0..1
    Raises
        NoSolution - when c, continued evenly, is not smooth enough for 8192 terms
    Notes
        The free motion of an unloading device goes on as an even oscillation of period 2, so its series falls
        geometrically. The number of nodes is settled on the integral of c cos(pi k): c itself, odd about
        mid-swing, integrates to zero with any number.
    Example
        >>> series = acceleration_series(lambda k: 0.5 * math.pi**2 * np.cos(math.pi * k))
        >>> round(float(series.coefficients[1]), 12), float(np.abs(series.coefficients[2:]).max()) < 1e-14
        (4.934802200545, True)
    """
    refusal = (
        "the rocker turns over so sharply within the stroke that its drive's oscillations cannot be summed: raise the "
        "pivot ratio, reduce the swing, or omit the drive (shaft)"
    )
    probe = cosine_series(lambda k: acceleration(k) * np.cos(math.pi * k), 1.0, refusal, first=32)
    values = acceleration((np.arange(probe.nodes) + 0.5) / probe.nodes)
    return CosineSeries(1.0, cosine_coefficients(values), probe.nodes, probe.difference)


@dataclass(frozen=True)
class TorsionResponse:
    """Torque over a stroke of a drive with torsional elasticity, at rest when the stroke begins.

    y = sum c_j W^2 Re[(e^{i j pi k} - transient)/(W^2 - (j pi)^2 + 2 i zeta W j pi)]

    Parameters
        series : CosineSeries - of the acceleration invariant
        stiffness : float - W = w T, natural frequency of the drive times time of the stroke
        damping : float - zeta, 0 to below 1
    Raises
        NoSolution - for W not positive or zeta outside [0, 1)
    Source
        wide-swing dissertation, chapter 5; own derivation
    """

    series: CosineSeries
    stiffness: float
    damping: float = 0.0

    def __post_init__(self) -> None:
        if not 0.0 < self.stiffness < math.inf:
            raise NoSolution(f"natural frequency times stroke time is {self.stiffness:.6g}; it must be above 0")
        if not 0.0 <= self.damping < 1.0:
            raise NoSolution(f"damping ratio {self.damping:.6g}: it must be at least 0 and below 1")

    def __call__(self, k: Reals) -> Reals:
        """y at fractions k of the stroke.

        Parameters
            k : (N,) array
        Returns
            y : (N,) array - in the unit of c
        Notes
            Undamped terms near resonance are products of sines, free of cancellation.
        """
        result = np.zeros_like(k)
        for j, amplitude in enumerate(self.series.coefficients.tolist()):
            wave = j * math.pi
            result += (
                amplitude
                * self.stiffness**2
                * (self._undamped(k, wave) if self.damping == 0.0 else self._damped(k, wave))
            )
        return result

    def rate(self, k: Reals) -> Reals:
        """dy/dk at fractions k of the stroke."""
        result = np.zeros_like(k)
        for j, amplitude in enumerate(self.series.coefficients.tolist()):
            wave = j * math.pi
            rate = self._undamped_rate(k, wave) if self.damping == 0.0 else self._damped_rate(k, wave)
            result += amplitude * self.stiffness**2 * rate
        return result

    def after(self, k: Reals) -> Reals:
        """y at k > 1, where the oscillation that the stroke leaves dies out.

        y = e^{-zeta W t}(y_1 cos W_d t + (y_1' + zeta W y_1) sin(W_d t)/W_d), t = k - 1
        """
        end = np.ones(1)
        value, rate, time = float(self(end)[0]), float(self.rate(end)[0]), k - 1.0
        decay, free = self.damping * self.stiffness, self.stiffness * math.sqrt(1.0 - self.damping**2)
        swing = value * np.cos(free * time) + (rate + decay * value) / free * np.sin(free * time)
        return np.asarray(np.exp(-decay * time) * swing)

    def _undamped_rate(self, k: Reals, wave: float) -> Reals:
        total, difference = 0.5 * (self.stiffness + wave), 0.5 * (self.stiffness - wave)
        first = np.cos(total * k) * np.sinc(difference * k / math.pi)
        result: Reals = 0.5 * k * (first + np.sinc(total * k / math.pi) * np.cos(difference * k))
        return result

    def _damped_rate(self, k: Reals, wave: float) -> Reals:
        decay, free = self.damping * self.stiffness, self.stiffness * math.sqrt(1.0 - self.damping**2)
        forced = 1.0 / complex(self.stiffness**2 - wave**2, 2.0 * decay * wave)
        sine = (forced * 1j * wave).real + decay * forced.real
        cosine, turned = np.cos(free * k), np.sin(free * k)
        dying = decay * (forced.real * cosine + sine / free * turned) + free * forced.real * turned - sine * cosine
        result: Reals = (1j * wave * forced * np.exp(1j * wave * k)).real + np.exp(-decay * k) * dying
        return result

    def _undamped(self, k: Reals, wave: float) -> Reals:
        """(cos wave k - cos W k)/(W^2 - wave^2)."""
        total, difference = 0.5 * (self.stiffness + wave), 0.5 * (self.stiffness - wave)
        # np.sinc(x) = sin(pi x)/(pi x)
        result: Reals = 0.5 * k**2 * np.sinc(total * k / math.pi) * np.sinc(difference * k / math.pi)
        return result

    def _damped(self, k: Reals, wave: float) -> Reals:
        decay, free = self.damping * self.stiffness, self.stiffness * math.sqrt(1.0 - self.damping**2)
        forced = 1.0 / complex(self.stiffness**2 - wave**2, 2.0 * decay * wave)
        steady = (forced * np.exp(1j * wave * k)).real
        sine = (forced * 1j * wave).real + decay * forced.real
        result: Reals = steady - np.exp(-decay * k) * (forced.real * np.cos(free * k) + sine / free * np.sin(free * k))
        return result


def dynamic_coefficient(series: CosineSeries, stiffness: float, damping: float = 0.0) -> tuple[float, float]:
    """Peak torque with torsional elasticity over the calculated peak, and where in the stroke it occurs.

    K_d = max |y|/max |c|

    Parameters
        series : CosineSeries - of the acceleration invariant, from `acceleration_series`
        stiffness : float - W = w T
        damping : float - zeta, 0 to below 1
    Returns
        K_d, k : floats
    Raises
        NoSolution - for W not positive or above 20000, or zeta outside [0, 1)
    Notes
        The step of c at the start alone gives 1 + exp(-pi zeta/sqrt(1 - zeta^2)), about 2.
    Example
        >>> harmonic = acceleration_series(lambda k: 0.5 * math.pi**2 * np.cos(math.pi * k))
        >>> [round(x, 6) for x in dynamic_coefficient(harmonic, 20.0)]
        [2.0343, 0.943856]

    Source
        wide-swing dissertation, chapter 5 (K_d about 2); own derivation
    """
    response = TorsionResponse(series, stiffness, damping)
    if stiffness > STIFFEST:
        raise NoSolution(
            (
                f"natural frequency times stroke time is {stiffness:.6g}, "
                f"{stiffness / (2.0 * math.pi):.4g} oscillations in a stroke: above {STIFFEST:g} the "
                "drive is rigid to the stroke"
            ),
            fix=(
                f"leave the section shaft out, or make speed {stiffness / STIFFEST:.4g} times higher or "
                "natural_frequency as much lower"
            ),
        )
    fastest = max(stiffness, math.pi * len(series.coefficients))
    samples = 65 + int(6.0 * fastest)
    top = maximum_over(lambda k: np.abs(response(k)), 0.0, 1.0, samples=samples)
    waves = math.pi * np.arange(len(series.coefficients))
    calculated = maximum_over(
        lambda k: np.abs(np.cos(np.outer(k, waves)) @ series.coefficients), 0.0, 1.0, samples=samples
    )
    return top.value / calculated.value, top.place
