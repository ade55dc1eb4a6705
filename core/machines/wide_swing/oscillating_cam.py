"""A cam on the rocker of a crank-rocker: the drive, the profile, and the way home over it.

The cam does not turn evenly but swings by chi(k) between the dead centres of the crank-rocker while its crank
turns evenly; the wide-swing rocker follows its law of motion over the same stroke.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short
from gearlink.core.machines.wide_swing.cam import (
    END,
    LEAST_SPEED_RATIO,
    MIDDLE,
    SMALLEST,
    START,
    CurveState,
    StrokeCam,
    StrokeLaw,
    covered,
    require_lengths,
    too_small_swing,
)
from gearlink.core.machines.wide_swing.slider import AimedLaw, SliderLaw
from gearlink.core.mechanism.rates import Rates, Turn, carried, cross, fixed, mixed
from gearlink.core.numerics.arrays import Points, Reals, number_of, unit_vector
from gearlink.core.numerics.extremes import Extreme, extremes_of_parts, maximum_over
from gearlink.core.numerics.gauss import gauss_legendre
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.parts.linkages.fourbar.mechanism import turns
from gearlink.core.parts.linkages.fourbar.position import FourBar


@dataclass(frozen=True)
class CrankRockerDrive:
    """Swing of a cam on the rocker of a crank-rocker, from one dead centre to the other.

    Parameters
        linkage : FourBar - a crank-rocker
        outward : bool - True from the extended to the folded dead centre, False back
    Raises
        NoSolution - for a linkage that is no crank-rocker
    Example
        >>> drive = CrankRockerDrive(FourBar(crank=1.0, coupler=3.0, rocker=2.5, frame=4.0))
        >>> [round(math.degrees(x), 6) for x in (*drive.crank_angles, drive.swing)]
        [36.419914, 210.75352, 47.643195]

    Source
        wide-swing dissertation, chapter 4, combined cam mechanisms; own derivation
    """

    linkage: FourBar
    outward: bool = True

    def __post_init__(self) -> None:
        kind = self.linkage.kind()
        if kind != "crank-rocker":
            bar = self.linkage
            shortest, p, q, longest = sorted((bar.crank, bar.coupler, bar.rocker, bar.frame))
            found = "the four links cannot be assembled" if kind == "impossible" else f"the drive is a {kind}"
            wrong = f"crank {short(bar.crank)} mm is not the shortest link"
            if shortest + longest >= p + q:
                wrong = f"Grashof: {short(shortest)} + {short(longest)} mm against {short(p)} + {short(q)} mm"
            raise NoSolution(f"{found}, not a crank-rocker ({wrong})", fix="change the link lengths")

    @cached_property
    def crank_angles(self) -> tuple[float, float]:
        """Crank angles at the start and the end of the stroke [rad]."""
        bar = self.linkage
        side = float(bar.assembly)
        extended = side * self._base_angle(bar.coupler + bar.crank)
        folded = side * self._base_angle(bar.coupler - bar.crank) + math.pi
        first, last = (extended, folded) if self.outward else (folded, extended)
        return first, first + math.fmod(last - first + 4.0 * math.pi, 2.0 * math.pi)

    def _base_angle(self, reach: float) -> float:
        """Angle at the crank pivot of the triangle reach, frame, rocker."""
        bar = self.linkage
        over = (bar.rocker - bar.frame + reach) * (bar.rocker + bar.frame - reach)
        under = (bar.frame + reach - bar.rocker) * (bar.frame + reach + bar.rocker)
        return 2.0 * math.atan(math.sqrt(over / under))

    @property
    def crank_span(self) -> float:
        """Crank angle of the stroke [rad]; not a half turn in general."""
        return self.crank_angles[1] - self.crank_angles[0]

    @cached_property
    def _middle(self) -> tuple[float, float]:
        """Rocker angle at k = 1/2, and the sign of its velocity."""
        _, rocker = turns(self.linkage, np.array([0.5 * sum(self.crank_angles)]), 1)
        return float(rocker.value[0]), math.copysign(1.0, float(rocker.first[0]))

    @property
    def rising(self) -> float:
        """+1 where the rocker turns counter-clockwise in the stroke, else -1."""
        return self._middle[1]

    def motion(self, k: Reals, order: int = 2) -> tuple[Reals, ...]:
        """Cam angle from k = 1/2, counted in its direction of motion, and its derivatives with respect to k.

        Parameters
            k : (N,) array - fraction of the stroke
            order : int - 0 to 3
        Returns
            rates : tuple of order + 1 (N,) arrays [rad] - chi and its derivatives
        """
        span, (place, sign) = self.crank_span, self._middle
        _, rocker = turns(self.linkage, self.crank_angles[0] + k * span, order, velocity=span)
        return (sign * (rocker.value - place), *(sign * rate for rate in rocker[1:]))

    @property
    def swing(self) -> float:
        """Swing of the cam [rad]."""
        ends = self.motion(np.array([0.0, 1.0]))[0]
        return float(ends[1] - ends[0])


# Oscillating cam of a wide-swing mechanism: the cam rides on the rocker of a crank-rocker


_STOP = 1e-4
"""Nearer to a stop, in strokes, the curve bends as it does at the stop, and its curvature has few digits."""
_AT_STOP = 1e-8
"""So near to a stop the first derivative has no more right digits in its direction than the limit there."""
_FAR = 0.98
"""Part of the way from one stop to the next over which a roller that stands is looked at."""
_SHORT = 0.02
"""Part of the stroke beside a stop in which a step is integrated: the differences of places keep 11 digits beyond."""
NOISE = 1e-15
"""How far from a stop, in strokes, the roller must have left its circle there for a profile to be left."""


_ASIDE = 0.2
"""Part of the stroke beside mid-swing in which the roller may pass the line of centres."""


def aimed_law(law: SliderLaw, drive: CrankRockerDrive) -> AimedLaw:
    """The law seen from k*, nearest to mid-swing, where d phi/d chi has its extremum and the pressure angle is 0.

    phi'' chi' = phi' chi'' at k*

    Notes
        Without such a place within 0.2 of the stroke of mid-swing, k* is that of mid-swing.
    """
    k = places_beside(law.middle_place)
    values = bend(law, drive, k)
    turns = np.flatnonzero(values[:-1] * values[1:] <= 0.0)

    def bend_at(at: float) -> float:
        return float(bend(law, drive, np.array([at]))[0])

    return aimed_at(law, [bracketed_root(bend_at, float(k[i]), float(k[i + 1])) for i in turns])


def aimed_at(law: SliderLaw, places: Sequence[float]) -> AimedLaw:
    """The law seen from the one of these places that is nearest to mid-swing; from there where there is none."""
    middle = law.middle_place
    return AimedLaw(law, min(places, key=lambda at: abs(at - middle), default=middle), near=0.0)


def places_beside(middle: Any) -> Reals:
    """Fractions of the stroke about mid-swing, of many a row for each."""
    return np.linspace(np.maximum(middle - _ASIDE, 1e-3), np.minimum(middle + _ASIDE, 1.0 - 1e-3), 161, axis=-1)


def bend(law: SliderLaw, drive: CrankRockerDrive, k: Reals) -> Reals:
    """phi'' chi' - phi' chi'', over the swing."""
    (b, c), (_, first, second) = law.rates(k), drive.motion(k)
    return np.asarray(c * first - b * second)


@dataclass(frozen=True, eq=False)
class StoppingState(CurveState):
    """That of a cam on a crank-rocker, by the limits at k* and where cam and rocker stop together.

    Fields
        cam : OscillatingCam - whose theta is counted from k = 1/2
        seconds : two (N,) arrays - chi'', psi''
    """

    cam: OscillatingCam
    seconds: tuple[Reals, Reals]

    @property
    def heading(self) -> Points:
        """The gradient, at a stop its derivative: before the stop that points back."""
        k, middle, (chi, psi) = self.k, self.cam.middle, self.seconds
        near = np.minimum(np.minimum(k, 1.0 - k), np.abs(k - middle)) <= _AT_STOP
        if not near.any():
            return self.gradient
        bent = (chi + psi) + 1j * self.a * (self.a - self.turning)
        onward = chi - self.ratio * bent * np.exp(1j * self.psi)
        begins = (k < 0.5 * middle) | ((k > middle) & (k < 0.5 + 0.5 * middle))
        return np.where(near, np.where(begins, onward, -onward), self.gradient)

    @property
    def curvature(self) -> Reals:
        """Infinite at the stops, on the side to which the curve bends there."""
        found = super().curvature
        for place, (bend, *_) in zip(self.cam.places, self.cam.stops, strict=True):
            found = np.where(self.k == place, np.copysign(math.inf, bend), found)
        return found

    @property
    def pressure_angle(self) -> Reals:
        """delta; where cam and rocker stand still the ratio of their accelerations takes the velocities' place.

        Notes
            So it does next to a standstill, where the ratio of the velocities has no right digits: off by 1e-8 there.
        """
        end, found = np.minimum(self.k, 1.0 - self.k) <= _AT_STOP, super().pressure_angle
        if end.any():
            chi, psi = self.seconds
            standing = replace(self, turning=chi, e=(1.0 - self.ratio) * chi - self.ratio * psi)
            found = np.where(end, super(StoppingState, standing).pressure_angle, found)
        return np.where(self.k == self.cam.middle, self.cam.middle_pressure_angle, found)


@dataclass(frozen=True)
class OscillatingCam(StrokeCam):
    """External cam on the rocker of a crank-rocker, guiding a wide-swing rocker.

    z = e^{i chi}(-1 + lambda e^{i (phi - phi_0)}) a, lambda = r/a = 1/(1 + gamma b/|chi'|) at k*, phi_0 = phi(k*)

    Parameters
        law : StrokeLaw - law of motion of the wide-swing rocker; with a slider that of `aimed_law`
        center_distance, roller_radius : float [mm] - a, r_p
    Raises
        NoSolution - for lengths that are not positive
    Notes
        The pitch curve has cusps at k* and, because cam and rocker stop together, at both ends, where the
        third derivative of the cam's motion leaves its curvature without bound.
    Example
        >>> from gearlink.core.parts.linkages.fourbar.position import FourBar
        >>> from gearlink.core.machines.wide_swing.law import ElasticLaw, Pneumatic
        >>> drive = CrankRockerDrive(FourBar(crank=1.0, coupler=3.0, rocker=2.5, frame=4.0))
        >>> cam = OscillatingCam(drive, ElasticLaw(Pneumatic(2.5), math.radians(120)), 1.0, 0.02)
        >>> round(cam.rocker_radius, 12), round(math.degrees(cam.middle_pressure_angle), 9)
        (0.267872782028, 1.946891616)

    Source
        wide-swing dissertation, chapter 4, combined cam mechanisms; own derivation
    """

    drive: CrankRockerDrive
    law: StrokeLaw
    center_distance: float
    roller_radius: float
    sense = 1

    def __post_init__(self) -> None:
        require_lengths(self.center_distance, self.roller_radius)

    @property
    def cycle_angle(self) -> float:
        """Crank angle of one stroke [rad]."""
        return self.drive.crank_span

    @cached_property
    def _middle(self) -> tuple[float, float]:
        """chi' and chi'' at k*."""
        _, first, second = self.drive.motion(np.array([self.middle]))
        return float(first[0]), float(second[0])

    @cached_property
    def ratio(self) -> float:
        """lambda = r/a."""
        peak = self.law.swing * self.law.velocity_peak / self._middle[0]
        if peak < LEAST_SPEED_RATIO:
            raise too_small_swing(self.law.swing, peak)
        return 1.0 / (1.0 + peak)

    @property
    def rocker_radius(self) -> float:
        """r, from the rocker's pivot to the roller centre [mm]."""
        return self.ratio * self.center_distance

    @cached_property
    def middle_pressure_angle(self) -> float:
        """Pressure angle that remains at k*, in the sign of `WideSwingCam` [rad].

        tan delta = [lambda phi'' - (1 - lambda) chi'']/(chi' phi'): zero where d phi/d chi has its extremum
        """
        first, second = self._middle
        across = self.ratio * self.law.swing * self.law.acceleration - (1.0 - self.ratio) * second
        return math.atan(across / (first * self.law.swing * self.law.velocity_peak))

    @property
    def loop_margin(self) -> float:
        """What must be positive for the profile to exist: the sense of the cusp at mid-swing, negative for a loop."""
        return self.stops[MIDDLE][0]

    @property
    def places(self) -> tuple[float, float, float]:
        """k of both ends and between them k*, where z'(k) = 0."""
        return 0.0, self.middle, 1.0

    @cached_property
    def stops(self) -> tuple[tuple[float, float, complex], ...]:
        """Im(conj(z2) z3)/|z2|^2, positive for a bulge, |z2| and z at these places."""
        return tuple(self._stop_at(stop) for stop in (START, MIDDLE, END))

    def _stop_at(self, stop: int) -> tuple[float, float, complex]:
        k = np.atleast_1d(self.places[stop])
        swing, view = self.law.swing, self.law.middle_view(k)
        # at the ends the rocker stands still, and the jerk that the law gives it with it
        jerk = np.asarray(swing * self.law.middle_jerk if stop == MIDDLE else 0.0)
        cam = Turn(*self.drive.motion(k, 3))
        rocker = Turn(view.angle, swing * view.velocity, swing * view.acceleration, jerk)
        z = carried(carried(fixed(0j, k, order=3), cam, -1.0), mixed((1.0, cam), (1.0, rocker)), self.ratio)
        size, place = np.abs(z.second), np.exp(1j * cam.value) * (self.ratio * np.exp(1j * view.angle) - 1.0)
        return number_of(cross(z.second, z.third) / size**2), number_of(size), number_of(place)

    @property
    def transition_zone_estimate(self) -> float:
        """`transition_zone` to leading order in r_p/a.

        Dk = q r_p/p^2 = 2 r_p Im(conj(z2) z3)/(3 a |z2|^3), p = |z2|/2, q = Im(conj(z2) z3)/(6 |z2|)

        Raises
            NoSolution - where the pitch curve has a loop
        """
        self.require_profile()
        return self.left(MIDDLE)

    def left(self, stop: int) -> float:
        """Part of the stroke over which the roller leaves a stop, to leading order."""
        bend, second, _ = self.stops[stop]
        return 2.0 * bend * self.roller_radius / (3.0 * second * self.center_distance)

    @cached_property
    def contact(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Parts of the stroke in which the roller touches the profile.

        Raises
            NoSolution - for a loop, or where the roller, standing at a stop, covers the profile of half the stroke
        Notes
            Cam and rocker stop together at both ends, so the pitch curve begins and ends with radius 0. Where it
            bulges there, the standing roller covers the first points of the profile as its slot does at k*.
        """
        self.require_profile()
        start, end = self._cover(START, 1.0), self._cover(END, -1.0)
        return (start, self._cover(MIDDLE, -1.0)), (self._cover(MIDDLE, 1.0), end)

    def _cover(self, stop: int, side: float) -> float:
        """How far from a stop, on one side of it, the roller that stands there covers the profile."""
        place = self.places[stop]
        if self.stops[stop][0] <= 0.0:
            return place
        estimate = self.left(stop)
        if estimate < SMALLEST:
            return place + side * estimate
        far = self.far_from(stop, side)
        return place + side * covered(
            lambda t: self.step(place + side * t, stop), self.roller_radius, far, estimate, NOISE
        )

    def far_from(self, stop: int, side: float) -> float:
        """Way from a stop, on one side of it, at which the profile must be free of the roller that stands there."""
        other = 0.5 + 0.5 * side if stop == MIDDLE else self.middle
        return _FAR * abs(other - self.places[stop])

    def state(self, k: Reals) -> StoppingState:
        """Cam and roller at fractions k of the stroke."""
        view, span, ratio = self.law.middle_view(k), self.cycle_angle, self.ratio
        chi, *of_cam = self.drive.motion(k)
        first, second = of_cam[0] / span, of_cam[1] / span**2
        speed, bend = self.law.swing / span * view.velocity, self.law.swing / span**2 * view.acceleration
        return StoppingState(
            k=k,
            theta=chi,
            psi=view.angle,
            turning=first,
            a=first + speed,
            e=(1.0 - ratio) * first - ratio * speed,
            s=2.0 * np.sin(0.5 * view.angle) ** 2,
            bend=bend * first - speed * second,
            sense=self.sense,
            ratio=ratio,
            cam=self,
            seconds=(second, bend),
        )

    def step(self, k: Reals, stop: int) -> tuple[Reals, Reals]:
        """Lengths of the pitch point's steps from a stop, and their parts against the profile's normal [mm]."""
        state, size, place = self.state(k), self.center_distance, self.places[stop]
        step = state.pitch - self.stops[stop][2]
        near = np.abs(k - place) <= _SHORT  # of two places nearly alike few digits would be left
        some = near.reshape(-1, k.shape[-1]).any(axis=0)
        if some.any():
            step[..., some] = np.where(near[..., some], self._short_step(k[..., some], place), step[..., some])
        return size * np.abs(step), -size * (step * np.conj(state.normal)).real

    def _short_step(self, k: Reals, place: float) -> Points:
        """The steps as integrals of the velocity, whose digits are right down to the stop."""
        nodes, weights = gauss_legendre(12)
        half = 0.5 * (k - place)
        between = np.asarray(place)[..., None] + half[..., None] * (1.0 + nodes)
        state = self.state(between.reshape(*k.shape[:-1], -1))
        velocity = -1j * np.exp(1j * state.theta) * state.gradient
        return np.asarray(self.cycle_angle * half * (velocity.reshape(*k.shape, nodes.size) @ weights))

    @cached_property
    def max_pressure_angle(self) -> float:
        """Largest magnitude of the pressure angle over the whole stroke [rad].

        Raises
            NoSolution - for a pitch curve with a loop
        """

        def size(k: Reals) -> Reals:
            return np.abs(self.pressure_angle(k))

        # next to a standstill both rates vanish and their ratio has no digits; the end itself has the limit
        inside = maximum_over(size, 1e-3, 1.0 - 1e-3, joints=(self.middle,), samples=256).value
        steepest: float = number_of(np.maximum(inside, size(np.array([0.0, 1.0])).max(axis=-1, keepdims=True)))
        return steepest

    def pressure_angle(self, k: Reals) -> Reals:
        """Pressure angle at fractions of the stroke [rad].

        Raises
            NoSolution - for a pitch curve with a loop
        """
        self.require_profile()
        return super().pressure_angle(k)

    @cached_property
    def tops(self) -> list[list[Extreme]]:
        """Maximum bulge where the roller touches the profile; at an end that is hollow nothing is to be found."""
        (first, start), (end, last) = self.contact
        parts = ((number_of(np.maximum(first, _STOP)), start), (end, number_of(np.minimum(last, 1.0 - _STOP))))
        return extremes_of_parts([(lambda k: self.state(k).bulge, True)], parts, samples=128)

    def require_profile(self) -> None:
        """Refuse a pitch curve with a loop.

        Raises
            NoSolution - with what to change
        """
        if np.any(self.loop_margin <= 0.0):
            raise NoSolution(
                (f"the pitch curve has a loop at mid-swing (measure {self.loop_margin:.4g}, must be above 0)"),
                fix="put mid-swing nearer to the cam's largest speed by changing the link lengths",
            )


# The way home of an oscillating cam: its crank goes on evenly, and the profile leads the rocker back


_TURN = 2.0 * np.pi


def way_home(cam: OscillatingCam, turned: Reals, order: int = 2) -> Rates[Reals]:
    """Fraction of the stroke at which the cam stood as at crank angles of its way home, from 1 to 0.

    psi(k) = 2 arg C - psi,  psi'(k) = 2 Im(C'/C) - 1,  psi''(k) = 2 Im(C''/C - (C'/C)^2)
    psi'''(k) = 2 Im(C'''/C - 3 C'' C'/C^2 + 2 (C'/C)^3)

    Parameters
        turned : (N,) array [rad] - crank angle from the start of the stroke, from the stroke's to a whole revolution
        order : 2 or 3 - of the derivatives by the crank angle
    Notes
        C is the end of the rocker that carries the cam, seen from the crank's pivot: the crank pins of both ways are
        mirror images on that line. At both ends, where cam and rocker stand still, nothing is 0/0.
    """
    bar, start, span = cam.drive.linkage, cam.drive.crank_angles[0], cam.drive.crank_span
    _, rocker = turns(bar, start + turned, order)
    arm = bar.rocker * unit_vector(rocker.value)
    end = bar.frame + arm
    share, speed = arm / end, rocker.first
    rate, curve = 1j * speed * share, (1j * rocker.second - speed**2) * share
    rates = [2.0 * rate.imag - 1.0, 2.0 * (curve - rate * rate).imag]
    if order > 2:
        jerk = (1j * (rocker.third - speed**3) - 3.0 * speed * rocker.second) * share
        rates.append(2.0 * (jerk - 3.0 * curve * rate + 2.0 * rate**3).imag)
    forth = _from(0.5 * (span - _TURN), 2.0 * np.angle(end) - 2.0 * start - turned)
    return Rates(_within(forth, 0.0, span) / span, *(each / span for each in rates))


def crank_angle(cam: OscillatingCam, k: Reals) -> Reals:
    """Crank angle from the start of the stroke at which the cam, on its way home, stands as at k [rad].

    Parameters
        k : (N,) array - fractions of the stroke
    Returns
        turned : (N,) array [rad] - from a whole revolution at k = 0 down to the stroke's at k = 1
    """
    bar, start, span = cam.drive.linkage, cam.drive.crank_angles[0], cam.drive.crank_span
    forth = k * span
    end = bar.frame + bar.rocker * np.exp(1j * turns(bar, start + forth, 0)[1].value)
    return _within(_from(0.5 * span, 2.0 * np.angle(end) - 2.0 * start - forth), span, _TURN)


def _from(low: float, angle: Reals) -> Reals:
    """The angle in the turn that begins at `low`, far from every angle of the stroke or of the way home."""
    return np.asarray(low + np.mod(angle - low, _TURN))


def _within(angle: Reals, low: float, high: float) -> Reals:
    """Rounding beyond an end is the end."""
    return np.asarray(np.minimum(np.maximum(angle, low), high))


def greatest_need(cam: OscillatingCam) -> Extreme:
    """Maximum acceleration of the rocker on the way home over that of the stroke at the same place, and the place k.

    Where the device holds the rocker of the stroke to its cam with a force above J phi'', it holds it on the way home
    only with a force above that ratio of it.

    Returns
        need : Extreme - at least 1, for at both ends the crank is the same; among places where the roller touches;
            inf where it does so at the place at which a slider's device has no torque
    Raises
        NoSolution - for a loop, or where the roller touches nothing
    """
    with np.errstate(invalid="ignore"):  # next to the place without torque, which counts by itself
        (one,), (other,) = extremes_of_parts([(partial(need_home, cam), True)], cam.contact, samples=128)
    later = np.greater(other.value, one.value)
    value, place = np.where(later, other.value, one.value), np.where(later, other.place, one.place)
    value, place = np.maximum(value, 1.0), np.where(value < 1.0, 0.0, place)
    if isinstance(cam.law, AimedLaw):
        middle = cam.law.law.middle_place
        lost = np.any([(start <= middle) & (middle <= end) for start, end in cam.contact], axis=0)
        value, place = np.where(lost, np.inf, value), np.where(lost, middle, place)
    return Extreme(number_of(value), number_of(place))


def need_home(cam: OscillatingCam, k: Reals) -> Reals:
    """Torque of inertia on the way home over that of the stroke, where the cam stands as at k.

    (m k'^2 + j phi_k k'')/(m/span^2), m that of the stroke; of a rocker alone j = 1 and m its acceleration

    Parameters
        k : (N,) array - fractions of the stroke, without 1/2, where the rocker has no acceleration in it
    """
    back = way_home(cam, crank_angle(cam, k))
    span = cam.drive.crank_span
    if isinstance(cam.law, AimedLaw):
        way, torque = cam.law.law.push(k)
        with np.errstate(divide="ignore"):
            pace = way / torque
    else:
        view = cam.law.middle_view(k)
        pace = view.velocity / view.acceleration
    found: Reals = span**2 * (back.first**2 + back.second * pace)
    return found
