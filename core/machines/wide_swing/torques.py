"""Torques of a wide swing: balance over the speed, elastic drive, and the blow where the roller changes flanks.

The device is tuned to one speed n0, at which it carries the whole inertia load; at any other the drive is left
with the difference J gamma c (1/T^2 - 1/T0^2).

q'' + 2 zeta w q' + w^2 q = -gamma c(k) (1/T^2 - 1/T0^2), torque M = -J w^2 q; in units of the calculated torque's
scale y'' + 2 zeta W y' + W^2 y = W^2 c(k) with W = w T and derivatives with respect to k.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short, unlike
from gearlink.core.machines.wide_swing.law import ElasticLaw
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.extremes import maximum_over
from gearlink.core.numerics.periodic import CosineSeries, cosine_coefficients, cosine_series
from gearlink.core.numerics.roots import bracketed_root

if TYPE_CHECKING:
    from gearlink.core.base.report import Check
    from gearlink.core.machines.wide_swing.design import WideSwingDesign


def stroke_time(cycle_angle: float, speed: float) -> float:
    """Time of one stroke.

    T = phi_ud/omega

    Parameters
        cycle_angle : float [rad] - phi_ud
        speed : float [rad/s] - of the cam
    Returns
        T : float [s]
    Raises
        NoSolution - when one is not positive
    Example
        >>> round(stroke_time(math.radians(120), 2 * math.pi * 1.66), 15)
        0.200803212851406

    Source
        wide-swing dissertation, chapter 2
    """
    if not (0.0 < cycle_angle < math.inf and 0.0 < speed < math.inf):
        raise NoSolution(
            f"cycle angle {math.degrees(cycle_angle):.4g} deg and speed {speed * 30.0 / math.pi:.4g} rev/min: "
            "both must be above 0"
        )
    return cycle_angle / speed


def inertia_torque_peak(inertia: float, law: ElasticLaw, time: float) -> float:
    """Largest inertia torque of the rocker over a stroke.

    M_in = J gamma C/T^2

    Parameters
        inertia : float [kg m^2] - J
        law : ElasticLaw
        time : float [s] - T of one stroke
    Returns
        torque : float [N m]
    Raises
        NoSolution - when inertia or time is not positive
    Example
        >>> from gearlink.core.machines.wide_swing.device import Pneumatic
        >>> law = ElasticLaw(Pneumatic(2.5), math.radians(120))
        >>> round(inertia_torque_peak(0.5, law, 0.20080321285140562), 9)
        113.235429407

    Source
        wide-swing dissertation (1)
    """
    if not (0.0 < inertia < math.inf and 0.0 < time < math.inf):
        raise NoSolution(f"moment of inertia {inertia:.4g} kg m^2 and time {time:.4g} s must both be above 0")
    return inertia * law.swing * law.acceleration_peak / time**2


def _left(speed_ratio: Reals, residual_fraction: float, reserve: float) -> Reals:
    """Torque that is left on the rocker axis, as a part of the inertia torque at n0."""
    if residual_fraction < 0.0 or reserve <= -1.0 or bool(np.any(speed_ratio < 0.0)):
        raise NoSolution("speeds and the residual fraction must be 0 or more, the reserve above -1")
    left: Reals = np.abs((speed_ratio - 1.0) * (speed_ratio + 1.0) - reserve) + residual_fraction
    return left


def speed_sweep(
    inertia: float,
    law: ElasticLaw,
    time: float,
    speed_ratio: Reals,
    residual_fraction: float = 0.0,
    reserve: float = 0.0,
) -> tuple[Reals, Reals]:
    """Torque peaks on the rocker axis with and without the device over the speed.

    M_in = J gamma C/T^2, M_1 = M_in/K_y1, K_y1 = K_y2 of `drive_balancing_ratio` with g = 0

    Parameters
        inertia : float [kg m^2] - J
        law : ElasticLaw
        time : float [s] - T0 of one stroke at the design speed
        speed_ratio : (N,) array - n/n0
        residual_fraction, reserve : float - f and rho of `drive_balancing_ratio`
    Returns
        without, with : (N,) arrays [N m] - peaks
    Raises
        NoSolution - when inertia or time is not positive, or a speed or f is negative
    Example
        >>> from gearlink.core.machines.wide_swing.device import Pneumatic
        >>> law = ElasticLaw(Pneumatic(2.5), math.radians(120))
        >>> without, left = speed_sweep(0.5, law, 0.20080321285140562, np.array([0.5, 1.2]))
        >>> without.round(6).tolist(), left.round(6).tolist()
        ([28.308857, 163.059018], [84.926572, 49.823589])

    Source
        wide-swing dissertation, chapter 5; own derivation
    """
    design = inertia_torque_peak(inertia, law, time)
    return design * speed_ratio**2, design * _left(speed_ratio, residual_fraction, reserve)


def power_peak(product: Callable[[Reals], Reals]) -> float:
    """Largest product of velocity invariant and torque over J gamma/T^2: the peak of the power of the inertia load.

    max |b m|, m = c of a rocker alone

    Parameters
        product : b m over fractions of the stroke
    Returns
        peak : float
    Notes
        pi^3/8 = 3.876 for the harmonic law.
    Example
        >>> from gearlink.core.machines.wide_swing.device import Pneumatic
        >>> law = ElasticLaw(Pneumatic(2.5), math.radians(120))
        >>> round(power_peak(lambda k: law.invariants(k)[1] * law.invariants(k)[2]), 12)
        4.608259092935
    """
    return maximum_over(lambda k: np.abs(product(k)), 0.0, 1.0, samples=256).value


def drive_balancing_ratio(
    speed_ratio: Reals, linkage_fraction: float, residual_fraction: float = 0.0, reserve: float = 0.0
) -> Reals:
    """How many times the device lowers the torque on the cam shaft.

    K_y2 = n^2 (1 + g)/(|n^2 - (1 + rho) n0^2| + f n0^2 + g n^2)

    Parameters
        speed_ratio : (N,) array - n/n0, 0 or more
        linkage_fraction : float - g, torque of the links that the device does not unload, as a part of the
            rocker's inertia torque on the same shaft and at the same speed
        residual_fraction : float - f, what friction, force error and linkage inertia leave at n0, as a part of
            the inertia torque there; 1/4.6 and 1/3.4 were measured
        reserve : float - rho, force of the device above the one that balances at n0, as a share of it
    Returns
        ratio : (N,) array - infinite at n0 when f = g = rho = 0
    Raises
        NoSolution - when a speed or g is negative
    Notes
        Assumes that both peaks fall together, so it is the minimum favourable case. g = 0 gives the ratio on the rocker
        axis: below 1, where the device harms, for n < n0 sqrt((1 + rho + f)/2).
    Example
        >>> drive_balancing_ratio(np.array([1.0]), 0.25).tolist()
        [5.0]

    Source
        wide-swing dissertation, chapter 5; own derivation
    """
    if linkage_fraction < 0.0:
        raise NoSolution("the linkage fraction must be 0 or more")
    square = speed_ratio**2
    left = _left(speed_ratio, residual_fraction, reserve) + linkage_fraction * square
    with np.errstate(divide="ignore"):
        result: Reals = square * (1.0 + linkage_fraction) / left
    return result


# Dynamic coefficient of a wide-swing drive: what its torsional elasticity adds to the calculated torque


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
        "the rocker reverses so sharply within the stroke that the oscillations of its drive cannot be summed\n"
        "raise unloader.pivot_ratio, reduce swing, or omit shaft"
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
            raise NoSolution(f"natural frequency times stroke time: {self.stiffness:.4g} (limit > 0)")
        if not 0.0 <= self.damping < 1.0:
            raise NoSolution(f"damping ratio: {self.damping:.4g} (at least 0, below 1)")

    def __call__(self, k: Reals) -> Reals:
        """y at fractions k of the stroke.

        Parameters
            k : (N,) array
        Returns
            y : (N,) array - in the unit of c
        Notes
            Undamped terms near resonance are products of sines, free of cancellation.
        """
        if self.damping > 0.0:
            return self._damped(k)
        result = np.zeros_like(k)
        for j, amplitude in enumerate(self.series.coefficients.tolist()):
            result += amplitude * self.stiffness**2 * self._undamped(k, j * math.pi)
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

    def _damped(self, k: Reals) -> Reals:
        """All waves together: what dies out is one oscillation, whatever has started it."""
        decay, free = self.damping * self.stiffness, self.stiffness * math.sqrt(1.0 - self.damping**2)
        waves = math.pi * np.arange(len(self.series.coefficients))
        forced = self.series.coefficients * self.stiffness**2 / (self.stiffness**2 - waves**2 + 2j * decay * waves)
        # the waves are powers of the first: a product each, and no sine
        first, total = np.exp(1j * math.pi * k), np.zeros(k.shape, dtype=np.complex128)
        for amplitude in forced[::-1].tolist():
            total = amplitude + total * first
        result: Reals = total.real
        cosine = float(forced.real.sum())
        sine = float((1j * waves * forced).real.sum()) + decay * cosine
        result -= np.exp(-decay * k) * (cosine * np.cos(free * k) + sine / free * np.sin(free * k))
        return result


def peak_of(series: CosineSeries) -> float:
    """max |c| over the stroke, which a drive's elasticity is compared with."""
    waves = math.pi * np.arange(len(series.coefficients))
    samples = 65 + int(6.0 * math.pi * len(series.coefficients))
    return maximum_over(
        lambda k: np.abs(np.cos(np.outer(k, waves)) @ series.coefficients), 0.0, 1.0, samples=samples
    ).value


def dynamic_coefficient(
    series: CosineSeries, stiffness: float, damping: float = 0.0, calculated: float | None = None
) -> tuple[float, float]:
    """Peak torque with torsional elasticity over the calculated peak, and where in the stroke it occurs.

    K_d = max |y|/max |c|

    Parameters
        series : CosineSeries - of the acceleration invariant, from `acceleration_series`
        stiffness : float - W = w T
        damping : float - zeta, 0 to below 1
        calculated : float - `peak_of` the series, for who has it
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
                f"natural frequency times stroke time: {unlike(stiffness, STIFFEST)} (limit <= {STIFFEST:g}; "
                f"{stiffness / (2.0 * math.pi):.4g} oscillations in a stroke, a rigid drive)"
            ),
            fix=(
                f"omit the section shaft, or make speed {stiffness / STIFFEST:.4g} times higher or "
                "natural_frequency as much lower"
            ),
        )
    fastest = max(stiffness, math.pi * len(series.coefficients))
    samples = 65 + int(6.0 * fastest)
    top = maximum_over(lambda k: np.abs(response(k)), 0.0, 1.0, samples=samples)
    return top.value / (peak_of(series) if calculated is None else calculated), top.place


# The blow where the roller changes flanks at mid-swing, and what an error of the profile moves at the ends


FARTHEST = 0.15
"""Part of the stroke after mid-swing up to which the formula, of leading order, is taken."""


_ABOVE = 1.0 + 2.0**-48
"""Past the rounding of a cube and its root."""


def crossing_time(free: float, clearance: float, growth: float) -> float:
    """Time from mid-swing to the blow on the other flank.

    (tau - 2 tau_e)(tau + tau_e)^2 = 6 s/kappa, the minimum tau >= 2 tau_e

    Parameters
        free : float [s] - tau_e, before mid-swing, since the wall ended
        clearance : float [mm] - s, of the roller in its slot, both flanks together
        growth : float [mm/s^3] - kappa of the force that turns over, delta'' = -kappa tau
    Returns
        tau : float [s]
    Example
        >>> crossing_time(0.5, 0.0, 4.0), crossing_time(0.0, 18.0, 4.0)
        (1.0, 3.0)

    Source
        own derivation, to leading order in the time
    """
    volume = 6.0 * clearance / growth
    most = float(np.cbrt(volume)) * _ABOVE  # reached by itself where the wall ends at mid-swing
    return 2.0 * free + bracketed_root(lambda late: late * (late + 3.0 * free) ** 2 - volume, 0.0, most)


@dataclass(frozen=True)
class FlankImpact:
    """The blow of the roller on the far flank, in mm, s and J; from the design of a rocker with a cam.

    Source
        own derivation, to leading order: 2 to 5 % high against the free rocker integrated
    """

    design: WideSwingDesign

    @property
    def _middle(self) -> float:
        """Fraction of the stroke at which the device changes sides."""
        motion = self.design.motion
        return 0.5 if self.design.spec.slider is None else motion.slider.middle_place

    @cached_property
    def _slope(self) -> tuple[float, float]:
        """|dc/dk| at mid-swing of the force that is left, with a slider |dm/dk|/j; and j there."""
        motion = self.design.motion
        if self.design.spec.slider is None:
            return abs(motion.plain_law.middle_jerk), 1.0
        law, g = motion.slider, motion.slider.geometry
        speed = float(law.invariants(np.array([self._middle]), 1)[1][0])
        pull = float(g.force(np.zeros(1))[0]) * g.ratio / g.shortest
        inertia = law.inertia_at(0.5)
        return 0.5 * law.energy_parameter * motion.swing**2 * pull * speed / inertia, inertia

    @property
    def _reserve(self) -> float:
        """That of the working stroke, which a device sized by a shorter return stroke has more of."""
        motion = self.design.motion
        return (1.0 + self.design.unloading.size.reserve) * (motion.working_time / motion.stroke_time) ** 2 - 1.0

    @cached_property
    def _growth(self) -> float:
        """kappa = r rho gamma |dc/dk|/T^3 [mm/s^3]."""
        motion, slope = self.design.motion, self._slope[0]
        return self.design.cam.rocker_radius * self._reserve * motion.swing * slope / motion.working_time**3

    @property
    def _free(self) -> float:
        """tau_e, from the end of the wall to mid-swing [s]."""
        return self.design.cam.transition_zone * self.design.motion.working_time

    @cached_property
    def _time(self) -> float | None:
        """tau of the blow [s]; None without a reserve, and farther from mid-swing than the formula holds."""
        clearance = self.design.section.roller_clearance
        if clearance is None or self._growth <= 0.0:
            return None
        time = crossing_time(self._free, clearance, self._growth)
        return time if time <= FARTHEST * self.design.motion.working_time else None

    @property
    def speed(self) -> float | None:
        """v = kappa (tau^2 - tau_e^2)/2 of the roller against the flank [mm/s]."""
        time = self._time
        return None if time is None else 0.5 * self._growth * (time - self._free) * (time + self._free)

    @property
    def place(self) -> float | None:
        """Fraction of the stroke at the blow."""
        return None if self._time is None else self._middle + self._time / self.design.motion.working_time

    @property
    def _turning(self) -> tuple[float, float] | None:
        """Inertia [kg m^2] and speed v/r [rad/s] that the blow stops."""
        speed = self.speed
        if speed is None:
            return None
        return self.design.motion.inertia * self._slope[1], speed / self.design.cam.rocker_radius

    @property
    def energy(self) -> float | None:
        """(J/2)(v/r)^2 [J]."""
        found = self._turning
        return None if found is None else 0.5 * found[0] * found[1] ** 2

    @property
    def force(self) -> float | None:
        """Peak force v sqrt(k J)/r on a contact of stiffness k [N]."""
        found, stiffness = self._turning, self.design.section.contact_stiffness
        return None if found is None or stiffness is None else found[1] * math.sqrt(1e3 * stiffness * found[0])


def end_position_gain(design: WideSwingDesign) -> float:
    """Way at `output_radius` over an error of the profile, at the end of the swing where it is greater.

    (R/r) rho/(a sin phi_e): at rest the roller stands on the arc, rho^2 = a^2 + r^2 - 2 a r cos phi_e
    """
    cam, radius = design.cam, design.spec.output_radius
    assert radius is not None, "asked for where the file has it"
    arms = cam.rocker_radius * cam.center_distance
    return max((radius * cam.pitch_radius(end) / (arms * math.sin(end)) for end in cam.ends), key=abs)


def flank_impact(design: WideSwingDesign) -> Iterator[Check]:
    """GL542: the speed of the blow, where the file has a limit."""
    from gearlink.core.machines.wide_swing import codes

    limit = design.spec.limits.impact_speed
    if limit is None or not design.has_profile:
        return
    speed, place = design.impact.speed, design.impact.place
    if speed is None or place is None:
        return
    yield codes.FLANK_IMPACT.check(
        "warn" if speed > limit else "pass",
        "speed at which the roller changes flanks",
        speed,
        limit,
        "mm/s",
        at=f"k = {short(place)}",
        fix="reduce cam.roller_clearance" if speed > limit else "",
    )
