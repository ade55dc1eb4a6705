"""A slider that the rocker of a wide swing moves: its law of motion, and that law as a cam sees it.

The unloading device swings rocker and slider together; the reduced inertia changes with the swing and with it
the law of motion loses its symmetry about mid-swing.

The roller's arm is set so that the roller passes the line of centres where the rocker is fastest, at k*: then, as with
a symmetric law, it passes the velocity pole there without pressure angle, and the pitch curve has its cusp. The return
stroke runs the same law backwards: the same cam, turning the other way, serves it.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import TypeVar

import numpy as np

from gearlink.core.base.design import placed
from gearlink.core.base.errors import NoSolution, at_key
from gearlink.core.base.report import safely_above
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import unlike
from gearlink.core.machines.wide_swing.device import Device, DeviceGeometry
from gearlink.core.machines.wide_swing.law import (
    Clock,
    ElasticLaw,
    Kept,
    MiddleView,
    columns_of,
    for_each,
    kept_for,
    require_share,
)
from gearlink.core.numerics.arrays import Reals, number_of
from gearlink.core.numerics.elliptic import complete_integral, incomplete_integral, jacobi_sn_cn
from gearlink.core.numerics.extremes import Extreme, extremes_over
from gearlink.core.numerics.gauss import gauss_legendre
from gearlink.core.numerics.periodic import CosineSeries, cosine_series
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.numerics.together import kept_last
from gearlink.core.parts.linkages.slider_crank import slider as slider_place
from gearlink.core.parts.linkages.slider_crank import slider_sweep

Number = TypeVar("Number", float, Reals)

_TOO_SHARP = (
    "the slider changes the inertia of the rocker too sharply within the stroke\nmove slider.middle_angle away from "
    "the position where rod and arm are collinear, or lengthen slider.rod"
)


def reference_inertia(rocker_inertia: float, mass: float, stroke: float, swing: float) -> tuple[float, float]:
    """Inertia that takes J's place in the energy parameter, and the rocker's share in it.

    J_ref = J0 + m H^2/gamma^2, j0 = J0/J_ref

    Parameters
        rocker_inertia : float [kg m^2] - J0 of what turns with the rocker
        mass : float [kg] - m of what moves with the slider
        stroke : float [mm] - H of the slider
        swing : float [rad] - gamma
    Returns
        J_ref, j0 : float [kg m^2], float
    Raises
        NoSolution - when the sum is not positive
    Example
        >>> [round(x, 12) for x in reference_inertia(0.02, 4.0, 200.0, 2.0)]
        [0.06, 0.333333333333]

    Source
        own derivation after the wide-swing dissertation (16), (17)
    """
    total = rocker_inertia + mass * (1e-3 * stroke / swing) ** 2
    if not (rocker_inertia >= 0.0 and mass >= 0.0 and 0.0 < total < math.inf):
        raise NoSolution(
            f"inertia {rocker_inertia:.4g} kg m^2 and mass {mass:.4g} kg: neither may be negative, one must be above 0"
        )
    return total, rocker_inertia / total


@dataclass(frozen=True)
class SliderDrive:
    """Slider moved by the rocker through a rod.

    Parameters
        crank, rod : float [mm] - rocker arm R and rod l
        middle_angle : float [rad] - arm at mid-swing, counted from the direction in which the slider is farthest
        offset : float [mm] - of the slide line, signed
    Raises
        NoSolution - when the rod does not exceed crank plus offset
    Source
        wide-swing dissertation, chapter 2, combined mechanisms
    """

    crank: float
    rod: float
    middle_angle: float
    offset: float = 0.0

    def __post_init__(self) -> None:
        if not 0.0 < self.crank + abs(self.offset) < self.rod:
            reach = self.crank + abs(self.offset)
            raise NoSolution(
                f"rod: {unlike(self.rod, reach)} mm (limit > {unlike(reach, self.rod)} mm, crank + offset)",
                fix=f"lengthen the rod above {safely_above(reach)} mm, best to {safely_above(3.0 * reach)} mm or more",
            )

    def depth(self, phi: Reals, order: int = 0) -> tuple[Reals, ...]:
        """Slider position at rocker angles phi from mid-swing, with derivatives with respect to phi up to 2 [mm]."""
        return slider_sweep(phi + (self.middle_angle - 0.5 * math.pi), self.crank, self.rod, self.offset, order)

    def least_transmission(self, swing: float) -> float:
        """Minimum angle between the rod and the normal of the slide line over a swing [rad].

        mu = 90 deg - max |asin((R sin psi + e)/l)|, psi the arm's angle, middle_angle +- swing/2

        Parameters
            swing : float [rad]
        Example
            >>> drive = SliderDrive(crank=1.0, rod=2.0, middle_angle=0.0)
            >>> [round(math.degrees(drive.least_transmission(math.radians(each)))) for each in (60, 180)]
            [76, 60]
        """
        start, end = self.middle_angle - 0.5 * swing, self.middle_angle + 0.5 * swing
        square = (0.5 + math.ceil(start / math.pi - 0.5)) * math.pi  # the first place of a square arm from the start on
        places = (start, end, *(place for place in (square, square + math.pi) if place <= end))
        return math.acos(max(abs(self.crank * math.sin(psi) + self.offset) for psi in places) / self.rod)

    def dead_centers(self) -> tuple[float, float]:
        """Rocker angles from mid-swing, within one revolution, where arm and rod are in line [rad]."""
        extended = -math.asin(self.offset / (self.rod + self.crank))
        folded = math.pi - math.asin(self.offset / (self.rod - self.crank))
        return extended - self.middle_angle, folded - self.middle_angle


@dataclass(frozen=True)
class SliderLaw:
    """Law of motion of a rocker with a slider, swung by an unloading device.

    b^2 = N E(a)/j(a), j = j0 + (1 - j0) b_kp^2, b_kp = (gamma/H) ds/dphi;  sqrt N = (1/gamma) Int sqrt(j) F du

    Parameters
        device : Pneumatic or Spring
        swing : float [rad] - gamma
        rocker_share : float - j0 = J0/J_ref in [0, 1]; 0 is the pure slider mass of the dissertation
    Raises
        NoSolution - for a swing outside (0, 340 deg], j0 outside [0, 1], a slider without stroke, and, where
            j0 = 0, a dead centre of the slider in the swing, at which the speed would have no bound
    Notes
        The integral runs over the whole stroke; b(1/2) is neither the velocity at mid-swing nor the peak.
    Example
        >>> from gearlink.core.machines.wide_swing.device import Pneumatic
        >>> drive = SliderDrive(crank=1.0, rod=3.0, middle_angle=math.pi / 2)
        >>> law = SliderLaw(Pneumatic(2.5), math.radians(120), drive)
        >>> round(law.energy_parameter, 12), round(law.middle_place, 12)
        (3.317777365941, 0.592915351375)

    Source
        wide-swing dissertation (16), (17); with the rocker's own inertia and the quadrature: own derivation
    """

    device: Device
    swing: float
    drive: SliderDrive
    rocker_share: float = 0.0

    def __post_init__(self) -> None:
        if not 0.0 <= self.rocker_share <= 1.0:
            raise NoSolution(f"share of the rocker in the inertia: {self.rocker_share:.4g} (0 to 1)")
        if abs(self._stroke) <= 1e-12 * self.drive.crank:
            raise NoSolution("the slider ends where it began", fix="turn the arm's mid-swing away from the slide line")
        if self.rocker_share == 0.0:
            self._require_no_dead_center()

    def _require_no_dead_center(self) -> None:
        for angle in self.drive.dead_centers():
            nearest = math.remainder(angle, 2.0 * math.pi)
            if abs(nearest) <= 0.5 * self.swing:
                raise NoSolution(
                    f"the slider's dead centre lies {math.degrees(nearest):.4g} deg from mid-swing, inside "
                    f"the half swing of {math.degrees(0.5 * self.swing):.4g} deg",
                    fix="turn the swing away from it, or count the rocker's own inertia",
                )

    @cached_property
    def _half(self) -> ElasticLaw:
        """The same device with the rocker alone: its integrand and its geometry."""
        return ElasticLaw(self.device, self.swing)

    @property
    def geometry(self) -> DeviceGeometry:
        """Lengths of the device in arms."""
        return self._half.geometry

    @cached_property
    def _stroke(self) -> float:
        ends = self.drive.depth(np.array([-0.5, 0.5]) * self.swing)[0]
        return float(ends[1] - ends[0])

    @cached_property
    def stroke(self) -> float:
        """H, distance of the slider's positions at the ends of the swing [mm]."""
        return abs(self._stroke)

    def _slider_rate(self, phi: Reals) -> tuple[Reals, Reals]:
        """b_kp and its derivative with respect to a."""
        _, first, second = self.drive.depth(phi, 2)
        return self.swing / self.stroke * first, self.swing**2 / self.stroke * second

    def inertia_at(self, share: float) -> float:
        """j where the rocker has passed a share of the swing, in plain scalars.

        Example
            >>> from gearlink.core.machines.wide_swing.device import Pneumatic
            >>> law = SliderLaw(Pneumatic(2.5), 2.0, SliderDrive(1.0, 3.0, math.pi / 2), 1.0)
            >>> law.inertia_at(0.2)
            1.0
        """
        psi = (share - 0.5) * self.swing + self.drive.middle_angle - 0.5 * math.pi
        _, first = slider_place(psi, self.drive.crank, self.drive.rod, self.drive.offset, 1)
        return self._inertia(self.swing / self.stroke * first)

    def _inertia(self, rate: Number) -> Number:
        return self.rocker_share + (1.0 - self.rocker_share) * rate * rate

    def _angle(self, sine: Reals, cosine: Reals) -> Reals:
        """phi where sin(phi/2) = -m sin u."""
        return -self.geometry.angle(sine, cosine)

    def _slowness(self, sine: Reals, cosine: Reals) -> Reals:
        root = np.sqrt(self._inertia(self._slider_rate(self._angle(sine, cosine))[0]))
        return root * self._half.slowness(sine, cosine)

    def _integrand(self, z: Reals) -> Reals:
        quarter = complete_integral(self._half.modulus_complement)
        second = z > quarter
        folded = np.where(second, 2.0 * quarter - z, z)
        cosine, sine = jacobi_sn_cn(folded, self._half.modulus, self._half.modulus_complement)
        sine = np.where(second, -sine, sine)
        return self._slowness(sine, cosine) * self.geometry.length(sine) / self.geometry.longest

    @cached_property
    def clock(self) -> CosineSeries:
        """gamma sqrt(N) dk/dz as a cosine series over the whole stroke."""
        with at_key("slider"):
            return cosine_series(self._integrand, 2.0 * complete_integral(self._half.modulus_complement), _TOO_SHARP)

    @cached_property
    def _clock_from_end(self) -> CosineSeries:
        return self.clock.from_far_end()

    @cached_property
    def _total(self) -> float:
        """gamma sqrt(N)."""
        return self.clock.total

    @cached_property
    def energy_parameter(self) -> float:
        """N = 2 P r_d T^2/(J_ref gamma^2) [-]."""
        return (self._total / self.swing) ** 2

    @cached_property
    def middle_place(self) -> float:
        """k at which the rocker passes mid-swing."""
        return self.share_at(0.5 * math.pi)

    velocity_peak, acceleration_peak = placed("peaks.0.value"), placed("peaks.1.value")
    slider_velocity_peak, slider_acceleration_peak = placed("peaks.2.value"), placed("peaks.3.value")
    torque_peak, power_peak = placed("peaks.4.value"), placed("peaks.5.value")

    @cached_property
    def peaks(self) -> tuple[Extreme, ...]:
        """Maxima over the stroke, of one motion: of b, |c|, |b_s|, |c_s|, |m| and |m b|, m that torque."""

        def each(v: Reals) -> tuple[Reals, ...]:
            b, c, rate, change = self._motion(np.cos(v), np.sin(v))
            torque = self._torque(b, c, rate, change)
            return b, c, rate * b, rate * c + change * b**2, torque, torque * b

        of = kept_last(each)
        wanted = [(lambda v, i=i: np.abs(of(v)[i]), True) for i in range(6)]
        return tuple(extremes_over(wanted, 0.0, math.pi, samples=128))

    @cached_property
    def fastest_turn(self) -> float:
        """Angle v from the start at which the rocker is fastest [rad]."""
        v = np.linspace(0.0, math.pi, 257)
        top = int(np.argmax(self._rates(np.cos(v), np.sin(v))[0]))

        def acceleration(at: float) -> float:
            turn = np.array([at])
            return float(self._rates(np.cos(turn), np.sin(turn))[1][0])

        return bracketed_root(acceleration, float(v[max(top - 1, 0)]), float(v[min(top + 1, 256)]))

    def share_at(self, v: float) -> float:
        """k at an angle v from the start."""
        return float(self.share_from(np.array([v]), late=False)[0])

    def invariants(self, k: Reals, order: int = 2) -> tuple[Reals, ...]:
        """Displacement, velocity and acceleration invariants of the rocker.

        c = (N/2)(E_a/j - E j_a/j^2)

        Parameters
            k : (N,) array - fraction of the stroke, 0 to 1
            order : int - 0 to 2
        Returns
            invariants : tuple of order + 1 arrays
        Raises
            NoSolution - for k outside 0 to 1
        """
        sine, cosine = self.pendulum(k)
        first_half = self._half.displacement(np.abs(sine), cosine)
        return (np.where(sine < 0.0, 1.0 - first_half, first_half), *self._rates(sine, cosine))[: order + 1]

    def device_torque(self, k: Reals) -> Reals:
        """Torque of the device over J_ref gamma/T^2.

        (N/2) E_a = j c + b^2 j_a/2,   j_a = 2 (1 - j0) b_kp b_kp,a

        Parameters
            k : (N,) array - fraction of the stroke, 0 to 1
        Raises
            NoSolution - for k outside 0 to 1
        """
        return self._torque(*self._motion(*self.pendulum(k)))

    def _torque(self, b: Reals, c: Reals, rate: Reals, change: Reals) -> Reals:
        return np.asarray(self._inertia(rate) * c + (1.0 - self.rocker_share) * rate * change * b * b)

    def push(self, k: Reals) -> tuple[Reals, Reals]:
        """j b, of rocker and slider, and that torque of the device."""
        b, c, rate, change = self._motion(*self.pendulum(k))
        return np.asarray(self._inertia(rate) * b), self._torque(b, c, rate, change)

    def kinetic(self, k: Reals) -> Reals:
        """Energy of motion over J_ref (gamma/T)^2/2: j b^2."""
        b, _, rate, _ = self._motion(*self.pendulum(k))
        return np.asarray(self._inertia(rate) * b**2)

    def rates(self, k: Reals) -> tuple[Reals, Reals]:
        """b and c at fractions of the stroke."""
        return self._rates(*self.pendulum(k))

    def slider_invariants(self, k: Reals) -> tuple[Reals, Reals, Reals]:
        """Displacement, velocity and acceleration invariants of the slider.

        a_s = (s - s_0)/H, b_s = b_kp b, c_s = b_kp c + b_kp,a b^2

        Parameters
            k : (N,) array - fraction of the stroke, 0 to 1
        Returns
            a_s, b_s, c_s : (N,) arrays - negative where the slider comes nearer
        Raises
            NoSolution - for k outside 0 to 1
        """
        sine, cosine = self.pendulum(k)
        start = self.drive.depth(np.array([-0.5 * self.swing]))[0]
        place = self.drive.depth(self._angle(sine, cosine))[0]
        b, c, rate, change = self._motion(sine, cosine)
        return (place - start) / self.stroke, rate * b, rate * c + change * b**2

    def rates_at(self, sine: Reals, cosine: Reals) -> tuple[Reals, Reals, Reals]:
        """Rocker angle from mid-swing [rad], velocity and acceleration invariants from sin u and cos u."""
        return self._angle(sine, cosine), *self._rates(sine, cosine)

    def pace(self, sine: Reals, cosine: Reals) -> Reals:
        """|dk/du| from sin u and cos u."""
        return self._slowness(sine, cosine) / self._total

    def share_from(self, v: Reals, *, late: bool) -> Reals:
        """Fraction of the stroke to an angle v counted from its start, or back from its end."""
        return (self._from_end if late else self._from_start).time(v) / self._total

    def _rates(self, sine: Reals, cosine: Reals) -> tuple[Reals, Reals]:
        return self._motion(sine, cosine)[:2]

    def _motion(self, sine: Reals, cosine: Reals) -> tuple[Reals, Reals, Reals, Reals]:
        """b and c, b_kp and its derivative with respect to a."""
        g, parameter = self.geometry, self.energy_parameter
        rate, change = self._slider_rate(self._angle(sine, cosine))
        inertia = self._inertia(rate)
        inertia_change = 2.0 * (1.0 - self.rocker_share) * rate * change
        energy = g.energy(sine, cosine)
        push = self.swing * g.force(sine) * g.lever(sine, cosine)
        b = np.sqrt(parameter * energy / inertia)
        return b, 0.5 * parameter * (push - energy * inertia_change / inertia) / inertia, rate, change

    def pendulum(self, k: Reals) -> tuple[Reals, Reals]:
        """sin u and cos u of every k, sin(phi/2) = -sin(gamma/4) sin u."""
        return kept_for(self._kept, for_each(self.clock, k), self._turned)

    @cached_property
    def _kept(self) -> Kept[tuple[Reals, Reals]]:
        return {}

    def _turned(self, k: Reals) -> tuple[Reals, Reals]:
        require_share(k)
        late = k > 0.5
        sine, cosine = np.empty(k.shape), np.empty(k.shape)
        for part, fraction, clock, side in ((~late, k, self._from_start, 1.0), (late, 1.0 - k, self._from_end, -1.0)):
            some = columns_of(part)
            if not some.size:
                continue
            v, here = clock.angles(np.minimum(fraction[..., some], 0.5)), part[..., some]
            if v is None:
                raise NoSolution(_TOO_SHARP, key="slider")
            sine[..., some] = np.where(here, side * np.cos(v), sine[..., some])
            cosine[..., some] = np.where(here, np.sin(v), cosine[..., some])
        return sine, cosine

    @cached_property
    def _from_start(self) -> Clock:
        """gamma sqrt(N) times the fraction of the stroke from the start to v = pi/2 - u."""
        return self._from(self.clock, 1.0)

    @cached_property
    def _from_end(self) -> Clock:
        """The same, backwards from the end."""
        return self._from(self._clock_from_end, -1.0)

    def _from(self, clock: CosineSeries, side: float) -> Clock:
        def time(v: Reals) -> Reals:
            complement = self._half.modulus_complement
            z = incomplete_integral(np.sin(v), np.abs(np.cos(v)), self._half.modulus, complement)
            return clock.integral(np.where(np.cos(v) < 0.0, clock.span - z, z))

        return Clock(time, lambda v: self._slowness(side * np.cos(v), np.sin(v)), self._total, math.pi)


# The law without symmetry, as a cam sees it


_NEAR = 0.15
"""Angle of the law beside k* [rad] within which differences of places keep too few digits."""
_STEP = 1e-4  # of the stroke, for the jerk at k*, which only starts a search


@dataclass(frozen=True)
class AimedLaw:
    """Law of a rocker with a slider, seen from k*, where its roller passes the line of centres of its cam.

    Parameters
        place : float - k*
        near : float [rad] - how far beside it times and B - b are integrated; 0 for a cam that does not turn evenly,
            which needs none
    """

    law: SliderLaw
    place: float
    near: float = _NEAR
    symmetric = False

    @property
    def swing(self) -> float:
        """gamma [rad]."""
        return self.law.swing

    @cached_property
    def _there(self) -> tuple[Reals, Reals]:
        """sin u and cos u at k*."""
        return self.law.pendulum(np.atleast_1d(self.place))

    @cached_property
    def turns(self) -> tuple[float, float]:
        """Angle of the law at the start and the end of the stroke, from k* [rad]."""
        sine, cosine = self._there
        return number_of(-np.arctan2(cosine, sine)), number_of(np.arctan2(cosine, -sine))

    @cached_property
    def _at(self) -> tuple[float, float, float]:
        """Rocker angle from mid-swing [rad], b and c at k*."""
        angle, b, c = map(number_of, self.law.rates_at(*self._there))
        return angle, b, c

    @property
    def offset(self) -> float:
        """phi_0 = phi(k*) [rad]."""
        return self._at[0]

    @property
    def velocity_peak(self) -> float:
        """b at k*; not the peak, where the cam does not turn evenly."""
        return self._at[1]

    @property
    def acceleration(self) -> float:
        """c at k*."""
        return self._at[2]

    @cached_property
    def middle_jerk(self) -> float:
        """dc/dk at k*."""
        beside = np.concatenate(np.atleast_1d(self.place - _STEP, self.place + _STEP), axis=-1)
        found: float = number_of(np.diff(self.law.rates(beside)[1])) / (2.0 * _STEP)
        return found

    def middle_view(self, k: Reals) -> MiddleView:
        """The motion seen from k*, its angle counted from there.

        Notes
            B - b is the integral of the acceleration, whose error is some ulp of its peak: beside k* the deficit keeps
            1e-15/|k - k*| of itself.
        """
        k = np.asarray(k, dtype=np.float64)
        return self._view(*self.law.pendulum(k), self._turn_of(k))

    def _turn_of(self, k: Reals) -> Reals:
        """Angles of the law from k*."""
        sine, cosine = self.law.pendulum(k)
        behind = np.maximum(self.turns[1] - np.arctan2(cosine, -sine), 0.0)
        before = np.minimum(self.turns[0] + np.arctan2(cosine, sine), 0.0)
        return np.where(k > self.place, behind, np.where(k < self.place, before, 0.0))

    def view_at(self, turn: Reals) -> MiddleView:
        """The same at angles of the law from k*, negative before it."""
        late = turn > 0.0
        v = np.where(late, self.turns[1], -self.turns[0]) - np.abs(turn)
        return self._view(np.where(late, -1.0, 1.0) * np.cos(v), np.sin(v), turn)

    def _view(self, sine: Reals, cosine: Reals, turn: Reals) -> MiddleView:
        angle, b, c = self.law.rates_at(sine, cosine)
        backwards = partial(self._integrate, lambda sine, cosine: -self.law.rates_at(sine, cosine)[2], turn)
        return MiddleView(
            np.where(turn == 0.0, 0.0, angle - self._at[0]), b, backwards(np.asarray(self.velocity_peak - b)), c
        )

    def share_from_middle(self, turn: Reals) -> Reals:
        """k - k* at angles of the law from k*."""
        late, (start, end) = turn > 0.0, self.turns
        if not late.any():
            found = self._share(turn, -start, late=False)
        elif late.all():
            found = self._share(turn, end, late=True)
        else:
            found = np.where(late, self._share(turn, end, late=True), self._share(turn, -start, late=False))
        return self._integrate(lambda sine, _: np.ones_like(sine), turn, found)

    def _share(self, turn: Reals, whole: float, *, late: bool) -> Reals:
        at_place, at = (self.law.share_from(v, late=late) for v in (np.atleast_1d(whole), whole - np.abs(turn)))
        return np.asarray((at_place - at) * (1.0 if late else -1.0))

    def turn_near(self, share: float) -> float:
        """About the angle of the law from k* at k - k*, by the pace there."""
        return share / float(self.law.pace(*self._there)[0])

    def turn_at(self, share: float) -> float:
        """The angle of the law from k* at k - k*."""
        return float(self._turn_of(np.array([self.place + share]))[0])

    def _integrate(self, of: Callable[[Reals, Reals], Reals], turn: Reals, found: Reals) -> Reals:
        """Put integrals over the time from k* on where a turn is near: their digits are right down to there."""
        near = np.abs(turn) <= self.near
        if near.any():
            some = np.flatnonzero(near.any(axis=tuple(range(near.ndim - 1))))
            nodes, weights = gauss_legendre(12)
            half = 0.5 * turn[..., some]
            flat = (half[..., None] * (1.0 + nodes)).reshape(*half.shape[:-1], -1) - self.turns[0]
            sine, cosine = np.cos(flat), np.sin(flat)
            values = of(sine, cosine) * self.law.pace(sine, cosine)
            values = values.reshape(*values.shape[:-1], some.size, nodes.size)
            found[..., some] = np.where(near[..., some], half * np.sum(values * weights, axis=-1), found[..., some])
        return found


def fastest_place(law: SliderLaw) -> float:
    """k at which the rocker is fastest.

    Example
        >>> from gearlink.core.machines.wide_swing.device import Pneumatic
        >>> law = SliderLaw(Pneumatic(2.5), math.radians(120), SliderDrive(1.0, 3.0, math.pi / 2), 0.3)
        >>> round(fastest_place(law), 9)
        0.690248221
    """
    return law.share_at(law.fastest_turn)
