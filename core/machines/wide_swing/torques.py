"""Torques of a wide swing: balance over the speed, elastic drive, and the blow where the roller changes flanks.

The device is tuned to one speed n0, at which it carries the whole inertia load; at any other the drive is left
with the difference J gamma c (1/T^2 - 1/T0^2).

q'' + 2 zeta w q' + w^2 q = -gamma c(k) (1/T^2 - 1/T0^2), torque M = -J w^2 q; in units of the calculated torque's
scale y'' + 2 zeta W y' + W^2 y = W^2 c(k) with W = w T and derivatives with respect to k.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.base.errors import MissingSection, NoSolution, at_key
from gearlink.core.base.report import Check, Table
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short, unlike
from gearlink.core.machines.wide_swing.codes import FLANK_IMPACT
from gearlink.core.machines.wide_swing.law import LegacyLaw, legacy_law
from gearlink.core.machines.wide_swing.oscillating_cam import OscillatingCam, need_home
from gearlink.core.machines.wide_swing.sizing import DeviceSize
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.extremes import Extreme, extremes_of_parts, greatest, maximum_over
from gearlink.core.numerics.periodic import CosineSeries, cosine_coefficients, cosine_series
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.numerics.together import kept_last

if TYPE_CHECKING:
    from gearlink.core.machines.wide_swing.cam import WideSwingCam
    from gearlink.core.machines.wide_swing.design import WideSwingDesign
    from gearlink.core.machines.wide_swing.motion import Motion
    from gearlink.core.machines.wide_swing.spec import SwingShaft, WideSwingSpec
    from gearlink.core.machines.wide_swing.strokes import AnyCam


# What the device must bear, and what it leaves to the drive


class Unloading:
    """Size of the device and torques of the shafts, from the design file and the rocker's motion."""

    def __init__(self, spec: WideSwingSpec, motion: Motion, way_back: Callable[[], Extreme] | None = None) -> None:
        self.spec, self.motion, self._way_back = spec, motion, way_back

    # Size

    @cached_property
    def size(self) -> DeviceSize:
        """Lengths, force and energy of the device."""
        return DeviceSize(self.spec, self.motion)

    @property
    def _whole(self) -> float:
        """1 + rho, force of the device over the one that balances the inertia at the design speed."""
        return 1.0 + self.size.reserve

    @property
    def force(self) -> float | None:
        """Force of a pneumatic device, as given or with its reserve [N]."""
        return self.size.strength if self.spec.unloader.type == "pneumatic" else None

    @property
    def spring_rate(self) -> float | None:
        """Rate of a spring, as given or with its reserve [N/mm]."""
        return self.size.strength if self.spec.unloader.type == "spring" else None

    @cached_property
    def iteration(self) -> LegacyLaw:
        """The source's own iteration, for comparison; with a slider over the whole stroke."""
        motion, inertia = self.motion, None if self.spec.slider is None else self.motion.slider.inertia_at
        return legacy_law(motion.device, motion.swing, inertia, steps=self.spec.iteration_steps)

    @property
    def iteration_error(self) -> float:
        """Relative error of the iteration's N."""
        return float(self.iteration.energy_parameter) / self.motion.law.energy_parameter - 1.0

    # Torque and drive

    @property
    def drive_torque_peak(self) -> float:
        """Torque of the cam shaft without the device and without `linkage_share` at the design speed [N m].

        M_dr = J gamma^2 max|m b|/(T^2 phi_ud)
        """
        motion = self.motion
        scale = motion.inertia * motion.swing**2 / (motion.stroke_time**2 * motion.device_angle)
        return scale * motion.law.power_peak

    def _left(self, speed_ratio: Reals) -> Reals:
        """Torque that is left on the rocker axis over n/n0, as a part of the inertia torque at n0."""
        left: Reals = np.abs((speed_ratio - 1.0) * (speed_ratio + 1.0) - self.size.reserve)
        return left + self.spec.unloader.residual

    def torque_peaks(self, speed_ratio: Reals) -> tuple[Reals, Reals]:
        """Torque peaks on the rocker axis without and with the device, over n/n0 [N m].

        M_in = J gamma C/T^2, M_1 = M_in/K_y1, K_y1 = K_y2 of `balancing_ratios` with g = 0

        Source
            wide-swing dissertation (1) and chapter 5; own derivation
        """
        motion = self.motion
        design = self.even_inertia * motion.swing * motion.plain_law.acceleration_peak / motion.stroke_time**2
        return design * speed_ratio**2, design * self._left(speed_ratio)

    def balancing_ratios(self, speed_ratio: Reals) -> Reals:
        """How many times the device lowers the torque on the cam shaft, over n/n0; infinite where none is left.

        K_y2 = n^2 (1 + g)/(|n^2 - (1 + rho) n0^2| + f n0^2 + g n^2)

        Notes
            g `shaft.linkage_share`, rho the reserve, f `unloader.residual`, of which 1/4.6 and 1/3.4 were measured.
            Assumes that both peaks fall together, so it is the minimum favourable case. g = 0 gives the ratio on the
            rocker axis: below 1, where the device harms, for n < n0 sqrt((1 + rho + f)/2).
        Source
            wide-swing dissertation, chapter 5; own derivation
        """
        linkage, square = self._shaft.linkage_share, speed_ratio**2
        with np.errstate(divide="ignore"):
            result: Reals = square * (1.0 + linkage) / (self._left(speed_ratio) + linkage * square)
        return result

    @property
    def drive_balancing_ratio(self) -> float | None:
        """K_y2 at the design speed; None where no torque is left."""
        found = float(self.balancing_ratios(np.ones(1))[0])
        return found if math.isfinite(found) else None

    @cached_property
    def _torque_series(self) -> CosineSeries:
        with at_key("shaft"):
            return acceleration_series(self.motion.law.device_torque)

    @property
    def dynamic_coefficient(self) -> float:
        """K_d, torque with the drive's elasticity over the calculated torque."""
        return self.dynamic_coefficients([1.0])[0]

    def dynamic_coefficients(self, speed_ratios: Iterable[float]) -> list[float]:
        """K_d over n/n0; not a number where a slow stroke finds the drive rigid.

        Raises
            NoSolution - at the design speed, where the drive is rigid to it
        """
        shaft, found = self._shaft, []
        calculated = self.motion.law.torque_peak
        for ratio in speed_ratios:
            stiffness = 2.0 * math.pi * shaft.natural_frequency * self.motion.stroke_time / ratio
            if ratio < 1.0 and stiffness > STIFFEST:
                found.append(math.nan)
                continue
            with at_key("shaft"):
                found.append(dynamic_coefficient(self._torque_series, stiffness, shaft.damping, calculated)[0])
        return found

    @property
    def left_share(self) -> float:
        """Torque with the device over that without it in the working stroke at the design speed, negative where the
        device is the stronger.

        sgn(g)(|g| + f q^2), g = 1 - (1 + rho) q^2, q = T/T0, T0 the time of the shorter stroke
        """
        square = (self.motion.working_time / self.motion.stroke_time) ** 2
        left = 1.0 - self._whole * square
        return math.copysign(abs(left) + self.spec.unloader.residual * square, left if left > 0.0 else -1.0)

    def history(self) -> Table:
        """Torques of rocker shaft and main shaft over the working stroke and the rest after it.

        M_e'' + 2 zeta w M_e' + w^2 M_e = w^2 (share M) from rest at the start; on the main shaft times gamma b/phi_ud

        Notes
            The first natural frequency is that of the mean inertia. What the stroke before has left is not counted.
        """
        motion, shaft, time = self.motion, self._shaft, self.motion.working_time
        stroke = math.degrees(motion.cycle_angle)
        rest = stroke if self.spec.cycle is None else self.spec.cycle.lengths[1]
        angle = np.arange(math.floor((stroke + rest) * (1.0 + 1e-12)) + 1.0)
        inside = angle <= stroke * (1.0 + 1e-12)
        k = np.minimum(angle[inside] / stroke, 1.0)
        with at_key("shaft"):
            response = TorsionResponse(
                self._torque_series, 2.0 * math.pi * shaft.natural_frequency * time, shaft.damping
            )
        scale, share = motion.inertia * motion.swing / time**2, self.left_share
        rigid, elastic, ratio = (np.zeros_like(angle) for _ in range(3))
        rigid[inside] = scale * motion.law.device_torque(k)
        elastic[inside], elastic[~inside] = response(k), response.after(angle[~inside] / stroke)
        ratio[inside] = motion.swing / motion.cycle_angle * motion.law.invariants(k, 1)[1]
        torques = {"": rigid, "_balanced": share * rigid, "_elastic": share * scale * elastic}
        columns = {
            "time": (angle / (6e-3 * self.spec.speed), "ms"),
            "cam_angle": (angle, "deg"),
            **{f"rocker_torque{end}": (values, "N m") for end, values in torques.items()},
            **{f"drive_torque{end}": (values * ratio, "N m") for end, values in torques.items()},
        }
        return Table.of("history", columns)

    @property
    def _shaft(self) -> SwingShaft:
        if self.spec.shaft is None:
            raise MissingSection("the command needs the section shaft: natural_frequency, damping", key="shaft")
        return self.spec.shaft

    @property
    def even_inertia(self) -> float:
        """Inertia of a rocker alone that would need the same device [kg m^2]."""
        motion = self.motion
        if self.spec.slider is None:
            return motion.inertia
        return motion.reference_inertia * motion.slider.energy_parameter / motion.plain_law.energy_parameter

    @property
    def harmful_speed(self) -> float:
        """Speed up to which the device raises the torque, n0 sqrt((1 + rho + f)/2) [1/min]."""
        return self.spec.speed * math.sqrt(0.5 * (self._whole + self.spec.unloader.residual))

    # Force closure

    @cached_property
    def way_back(self) -> Extreme | None:
        """The place where an oscillating cam that swings home asks most of the device; None with no such way back."""
        try:
            return None if self._way_back is None else self._way_back()
        except NoSolution:  # of a cam that cannot be, which fails in checks of its own
            return None

    @property
    def need(self) -> float:
        """k_b, greatest acceleration of the rocker on its way back over that of the stroke; 1 where they are alike."""
        return 1.0 if self.way_back is None else self.way_back.value

    @property
    def lift_off_speed(self) -> float:
        """Speed above which the roller leaves its cam, n0 sqrt((1 + rho - f)/k_b); 0 where f is more [1/min]."""
        whole = self._whole - self.spec.unloader.residual
        return self.spec.speed * math.sqrt(whole / self.need) if whole > 0.0 else 0.0

    def contact_force(
        self, cam: AnyCam, k: Reals, speed_ratio: float | Reals = 1.0, need: float | Reals = 1.0
    ) -> Reals:
        """Force of the roller on a cam, along their normal.

        F = J gamma |c| ((1 + rho) - k_b (n T0/(n0 T))^2)/(T0^2 r cos delta), with a slider +-(N/2) E_a instead of |c|

        Parameters
            cam : WideSwingCam or OscillatingCam
            k : (N,) array - fractions of the stroke, mid-swing left out
            speed_ratio : float or (N,) array - n/n0
            need : float or (N,) array - k_b, the rocker's acceleration over that of the stroke
        Returns
            force : (N,) array [N] - positive where the profile is pressed, in run-up and run-out; negative where the
                roller leaves it
        Notes
            Friction is left out. In run-up the device is stronger than the inertia and the cam holds the rocker back;
            in run-out the inertia is weaker than the device and the cam pushes. T0 is the time of the shorter of two
            strokes, T that of the cam's own. With a slider the force reverses at mid-swing, the roller where the
            rocker is fastest: between the two the force is negative.
        """
        return np.asarray(self._pressing(cam, speed_ratio, need) * self._along(cam, k))

    def _along(self, cam: AnyCam, k: Reals) -> Reals:
        """m/cos delta, negative in run-out."""
        torque = self.motion.law.device_torque(k) * np.where(k < cam.middle, 1.0, -1.0)
        return np.asarray(torque / np.cos(cam.pressure_angle(k)))

    def greatest_force(self, cam: AnyCam) -> float:
        """Maximum force of the roller on a cam over the stroke, and on one that swings itself home, at the design
        speed [N]."""
        along = kept_last(partial(self._along, cam))
        wanted = [(lambda k: self._pressing(cam, 1.0, 1.0) * along(k), True)]
        if isinstance(cam, OscillatingCam):
            wanted.append((lambda k: self._pressing(cam, 1.0, need_home(cam, k)) * along(k), True))
        found = extremes_of_parts(wanted, cam.contact, samples=128)
        return greatest([each.value for of_part in found for each in of_part])

    def _pressing(self, cam: AnyCam, speed_ratio: Any, need: Any) -> Any:
        """Force along the normal by torque over J gamma/T^2 and cos delta [N]."""
        motion = self.motion
        speed_ratio = speed_ratio * (motion.device_angle / cam.cycle_angle)
        scale = 1e3 * motion.inertia * motion.swing / (motion.stroke_time**2 * cam.rocker_radius)
        return scale * (self.size.reserve - (speed_ratio - 1.0) * (speed_ratio + 1.0) * need - (need - 1.0))

    def even_contact_force(self, cam: WideSwingCam) -> float:
        """Maximum force of the roller on a cam that turns evenly, at the design speed [N]."""
        pressing: float = self._pressing(cam, 1.0, 1.0)
        most, least = cam.pressing
        return max(pressing * most.value, pressing * least.value)

    def dwell_force(self, cams: Iterable[AnyCam]) -> float:
        """Maximum force of a roller on its cam during the rests, when the cam bears the whole device [N].

        F = (1 + rho) J gamma c(0)/(T0^2 r cos delta0)

        Parameters
            cams : of both strokes
        Returns
            force : float [N] - it also acts at the ends of the strokes of a machine that barely turns
        """
        return max(float(self.contact_force(cam, np.array([0.0, 1.0]), 0.0).max()) for cam in cams)


# Dynamic coefficient of a wide-swing drive: what its torsional elasticity adds to the calculated torque


STIFFEST = 20_000.0
"""Natural frequency times stroke time from which the search for the peak takes seconds and finds the step's alone."""
_NEAR = 1.0
"""Distance of a wave, j pi, from the free oscillation below which the difference of both is not formed."""


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
        "increase unloader.pivot_ratio, reduce swing, or omit shaft"
    )
    probe = cosine_series(lambda k: acceleration(k) * np.cos(math.pi * k), 1.0, refusal, first=32)
    values = acceleration((np.arange(probe.nodes) + 0.5) / probe.nodes)
    return CosineSeries(1.0, cosine_coefficients(values), probe.nodes, probe.difference)


@dataclass(frozen=True)
class TorsionResponse:
    """Torque over a stroke of a drive with torsional elasticity, at rest when the stroke begins.

    y = (W^2/W_d) Im z, z' = m z + c from z(0) = 0, m = -zeta W + i W_d, c = sum c_j cos(j pi k)
    z = sum (c_j/2) [(e^{i j pi k} - e^{m k})/(i j pi - m) + (e^{-i j pi k} - e^{m k})/(-i j pi - m)]

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

    @property
    def _free(self) -> complex:
        """m, in units of the stroke."""
        return self.stiffness * complex(-self.damping, math.sqrt(1.0 - self.damping**2))

    def __call__(self, k: Reals) -> Reals:
        """y at fractions k of the stroke.

        Parameters
            k : (N,) array
        Returns
            y : (N,) array - in the unit of c
        """
        return self._part(k, 1.0)

    def after(self, k: Reals) -> Reals:
        """y at k > 1, where the oscillation that the stroke leaves dies out, z = z(1) e^{m (k - 1)}."""
        end = np.ones(1)
        left = complex(float(self._part(end, 1j)[0]), float(self._part(end, 1.0)[0]))
        return np.asarray((left * np.exp(self._free * (k - 1.0))).imag)

    def _part(self, k: Reals, factor: complex) -> Reals:
        """(W^2/W_d) Im(factor z) at fractions k of the stroke.

        Notes
            A wave near resonance is k e^{(i j pi + m) k/2} sinh(x)/x, x = (i j pi - m) k/2, free of cancellation.
        """
        free, waves = self._free, 1j * math.pi * np.arange(len(self.series.coefficients))
        sizes = 0.5 * factor * self.stiffness**2 / free.imag * self.series.coefficients
        apart = waves - free
        near = np.abs(apart) < _NEAR
        forth, back = np.where(near, 0.0, sizes / np.where(near, 1.0, apart)), -sizes / (waves + free)
        # the waves are powers of the first: a product each, and no sine; those that run back as their mirror images
        first, total = np.exp(1j * math.pi * k), np.zeros(k.shape, dtype=np.complex128)
        for amplitude in (forth - back.conj())[::-1].tolist():
            total = amplitude + total * first
        found: Reals = (total - np.exp(free * k) * complex(forth.sum() + back.sum())).imag
        for j in np.flatnonzero(near):
            x = 0.5 * apart[j] * k
            ratio = np.sinh(x) / np.where(x == 0.0, 1.0, x) + (x == 0.0)
            found += (sizes[j] * k * np.exp(0.5 * (waves[j] + free) * k) * ratio).imag
        return found


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
            f"natural frequency times stroke time: {unlike(stiffness, STIFFEST)} (limit <= {STIFFEST:g}; "
            f"{stiffness / (2.0 * math.pi):.4g} oscillations in a stroke, a rigid drive)",
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

    @cached_property
    def _slope(self) -> tuple[float, float]:
        """|dc/dk| at mid-swing of the force that is left, with a slider |dm/dk|/j; and j there."""
        motion = self.design.motion
        if self.design.spec.slider is None:
            return abs(motion.plain_law.middle_jerk), 1.0
        law, g = motion.slider, motion.slider.geometry
        speed = float(law.invariants(np.array([law.middle_place]), 1)[1][0])
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
        motion = self.design.motion
        return None if self._time is None else motion.law.middle_place + self._time / motion.working_time

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


def flank_impact(design: WideSwingDesign) -> Iterator[Check]:
    """GL542: the speed of the blow, where the file has a limit."""
    limit = design.spec.limits.impact_speed
    if limit is None or not design.has_profile:
        return
    speed, place = design.impact.speed, design.impact.place
    if speed is None or place is None:
        return
    yield FLANK_IMPACT.check(
        "warn" if speed > limit else "pass",
        "speed at which the roller changes flanks",
        speed,
        limit,
        "mm/s",
        at=f"k = {short(place)}",
        fix="reduce cam.roller_clearance",
    )
