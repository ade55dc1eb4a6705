"""A cam on the rocker of a crank-rocker: the drive, the profile, and the way home over it.

The cam does not turn evenly but swings by chi(k) between the dead centres of the crank-rocker while its crank
turns evenly; the wide-swing rocker follows its law of motion over the same stroke.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from functools import partial
from typing import NamedTuple

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short
from gearlink.core.machines.wide_swing.cam import (
    LEAST_SPEED_RATIO,
    SMALLEST,
    CamPoints,
    StrokeLaw,
    covered,
    fitting_roller,
    too_small_swing,
)
from gearlink.core.machines.wide_swing.law import MiddleView
from gearlink.core.machines.wide_swing.slider import SliderLaw
from gearlink.core.numerics.arrays import Points, Reals
from gearlink.core.numerics.extremes import Extreme, extremes_of_parts, maximum_over
from gearlink.core.numerics.gauss import gauss_legendre
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.parts.linkages.fourbar.position import FourBar
from gearlink.core.parts.linkages.fourbar.sweep import solve


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
        middle = solve(self.linkage, np.array([0.5 * sum(self.crank_angles)]), 1)
        return float(middle.rocker_angle[0]), math.copysign(1.0, float(middle.rocker_velocity[0]))

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
        sweep = solve(self.linkage, self.crank_angles[0] + k * self.crank_span, order, velocity=self.crank_span)
        place, sign = self._middle
        rates = (sweep.rocker_velocity, sweep.rocker_acceleration, sweep.rocker_jerk)[:order]
        return (sign * (sweep.rocker_angle - place), *(sign * rate for rate in rates))

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
_NOISE = 1e-15
"""How far from a stop, in strokes, the roller must have left its circle there for a profile to be left."""


@dataclass(frozen=True, slots=True, eq=False)
class Step:
    """Where the roller stands on the cam and how it goes on, at fractions of the stroke.

    Fields
        view : MiddleView - of the rocker's motion
        chi : three (N,) arrays [rad] - cam angle from mid-swing and its derivatives with respect to k
        arm : (N,) complex array - roller centre from the cam axis
        first, second : (N,) complex arrays - its derivatives with respect to k in the cam, turned back with the cam
        along : (N,) complex array - unit vector of its way, at a stop the limit of the way there
    """

    view: MiddleView
    chi: tuple[Reals, ...]
    arm: Points
    first: Points
    second: Points
    along: Points


_ASIDE = 0.2
"""Part of the stroke beside mid-swing in which the roller may pass the line of centres."""
_JERK = 1e-4  # of the stroke, for a difference of accelerations


@dataclass(frozen=True)
class AimedLaw:
    """Law of a rocker with a slider, seen from k*, where its roller passes the line of centres of a cam that swings.

    phi'' chi' = phi' chi'' at k*, nearest to mid-swing: d phi/d chi has its extremum, and the pressure angle is 0

    Parameters
        law : SliderLaw
        drive : CrankRockerDrive
    Notes
        Without such a place within 0.2 of the stroke of mid-swing, k* is that of mid-swing.
    """

    law: SliderLaw
    drive: CrankRockerDrive

    @property
    def swing(self) -> float:
        """gamma [rad]."""
        return self.law.swing

    @cached_property
    def place(self) -> float:
        """k*."""
        middle = self.law.middle_place
        k = np.linspace(max(middle - _ASIDE, 1e-3), min(middle + _ASIDE, 1.0 - 1e-3), 161)
        bend = self._bend(k)
        turns = np.flatnonzero(bend[:-1] * bend[1:] <= 0.0)
        found = [
            bracketed_root(lambda at: float(self._bend(np.array([at]))[0]), float(k[i]), float(k[i + 1])) for i in turns
        ]
        return min(found, key=lambda at: abs(at - middle), default=middle)

    def _bend(self, k: Reals) -> Reals:
        """c chi' - b chi''."""
        _, b, c = self.law.invariants(k)
        _, first, second = self.drive.motion(k)
        return np.asarray(c * first - b * second)

    @cached_property
    def _at(self) -> tuple[float, float, float]:
        return tuple(float(x[0]) for x in self.law.invariants(np.array([self.place])))  # type: ignore[return-value]

    @property
    def offset(self) -> float:
        """phi_0 = phi(k*) [rad]."""
        return self.swing * (self._at[0] - 0.5)

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
        before, after = self.law.invariants(np.array([self.place - _JERK, self.place + _JERK]))[2]
        return float(after - before) / (2.0 * _JERK)

    def middle_view(self, k: Reals) -> MiddleView:
        """The motion seen from k*, its angle counted from there."""
        a, b, c = self.law.invariants(np.asarray(k, dtype=np.float64))
        return MiddleView(self.swing * (a - 0.5) - self.offset, b, self.velocity_peak - b, c)


@dataclass(frozen=True)
class OscillatingCam:
    """External cam on the rocker of a crank-rocker, guiding a wide-swing rocker.

    z = e^{i chi}(-1 + lambda e^{i (phi - phi_0)}) a, lambda = r/a = 1/(1 + gamma b/|chi'|) at k*, phi_0 = phi(k*)

    Parameters
        drive : CrankRockerDrive
        law : StrokeLaw or AimedLaw - law of motion of the wide-swing rocker; the roller passes the line of centres
            at mid-swing, k* = 1/2, or with a slider where d phi/d chi has its extremum
        center_distance, roller_radius : float [mm] - a, r_p
    Raises
        NoSolution - for lengths that are not positive
    Notes
        The pitch curve has cusps at mid-swing and, because cam and rocker stop together, at both ends, where the
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
    law: StrokeLaw | AimedLaw
    center_distance: float
    roller_radius: float

    def __post_init__(self) -> None:
        for name, value in (("centre distance", self.center_distance), ("roller radius", self.roller_radius)):
            if not 0.0 < value < math.inf:
                raise NoSolution(f"{name}: {value:.4g} mm (limit > 0)")

    @property
    def cycle_angle(self) -> float:
        """Crank angle of one stroke [rad]."""
        return self.drive.crank_span

    @property
    def middle(self) -> float:
        """k*, fraction of the stroke at which the roller is on the line of centres."""
        return self.law.place if isinstance(self.law, AimedLaw) else 0.5

    @property
    def arm_offset(self) -> float:
        """phi_0, rocker angle from mid-swing at which the roller is on the line of centres [rad]."""
        return self.law.offset if isinstance(self.law, AimedLaw) else 0.0

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
        own = self.law.swing * self.law.acceleration if isinstance(self.law, AimedLaw) else 0.0
        across = self.ratio * own - (1.0 - self.ratio) * second
        return math.atan(across / (first * self.law.swing * self.law.velocity_peak))

    @property
    def loop_margin(self) -> float:
        """What must be positive for the profile to exist: the sense of the cusp at mid-swing, negative for a loop."""
        return self._stop(self.middle)[0]

    @cached_property
    def _stops(self) -> dict[float, tuple[float, float]]:
        return {k: self._stop_at(k) for k in (0.0, self.middle, 1.0)}

    def _stop(self, k: float) -> tuple[float, float]:
        """Im(conj(z2) z3)/|z2|^2, positive for a bulge, and |z2| at mid-swing or an end, where z'(k) = 0."""
        return self._stops[k]

    def _stop_at(self, k: float) -> tuple[float, float]:
        _, chi1, chi2, chi3 = (float(x[0]) for x in self.drive.motion(np.array([k]), 3))
        swing, r = self.law.swing, self.ratio
        view = self.law.middle_view(np.array([k]))
        phi1, phi2 = swing * float(view.velocity[0]), swing * float(view.acceleration[0])
        # at the ends the rocker stands still, and the jerk that the law gives it with it
        phi3 = swing * self.law.middle_jerk if k == self.middle else 0.0
        arm = r * cmath.exp(1j * float(view.angle[0]))
        f, f1 = arm - 1.0, 1j * phi1 * arm
        f2, f3 = (1j * phi2 - phi1**2) * arm, (1j * phi3 - 3.0 * phi1 * phi2 - 1j * phi1**3) * arm
        second = f2 + 2j * chi1 * f1 + (1j * chi2 - chi1**2) * f
        third = f3 + 3j * chi1 * f2 + 3.0 * (1j * chi2 - chi1**2) * f1
        third += (1j * chi3 - 3.0 * chi1 * chi2 - 1j * chi1**3) * f
        return (second.conjugate() * third).imag / abs(second) ** 2, abs(second)

    @property
    def transition_zone_estimate(self) -> float:
        """`transition_zone` to leading order in r_p/a.

        Dk = q r_p/p^2 = 2 r_p Im(conj(z2) z3)/(3 a |z2|^3), p = |z2|/2, q = Im(conj(z2) z3)/(6 |z2|)

        Raises
            NoSolution - where the pitch curve has a loop
        """
        self.require_profile()
        return self._left(self._stop(self.middle))

    def _left(self, stop: tuple[float, float]) -> float:
        """Part of the stroke over which the roller leaves a stop, to leading order."""
        bend, second = stop
        return 2.0 * bend * self.roller_radius / (3.0 * second * self.center_distance)

    @cached_property
    def contact(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Parts of the stroke in which the roller touches the profile.

        Raises
            NoSolution - for a loop, or where the roller, standing at a stop, covers the profile of half the stroke
        Notes
            Cam and rocker stop together at both ends, so the pitch curve begins and ends with radius 0. Where it
            bulges there, the standing roller covers the first points of the profile as its slot does at mid-swing.
        """
        self.require_profile()
        start, end = self._cover(0.0, 1.0), self._cover(1.0, -1.0)
        return (start, self._cover(self.middle, -1.0)), (self._cover(self.middle, 1.0), end)

    def _cover(self, stop: float, side: float) -> float:
        """How far from a stop, on one side of it, the roller that stands there covers the profile."""
        shape = self._stop(stop)
        if shape[0] <= 0.0:
            return stop
        estimate = self._left(shape)
        if estimate < SMALLEST:
            return stop + side * estimate
        other = self.middle if stop in (0.0, 1.0) else 0.5 + 0.5 * side
        far = _FAR * abs(other - stop)
        return stop + side * covered(
            lambda t: self._step(stop + side * t, stop), self.roller_radius, far, estimate, _NOISE
        )

    def _step(self, k: Reals, stop: float) -> tuple[Reals, Reals]:
        """Lengths of the pitch point's steps from a stop, and their parts against the profile's normal [mm]."""
        points = self.points(np.append(k, stop))
        step = points.pitch[:-1] - points.pitch[-1]
        near = np.abs(k - stop) <= _SHORT  # of two places nearly alike few digits would be left
        if near.any():
            step[near] = self._short_step(k[near], stop)
        normal = (points.profile - points.pitch)[:-1] / self.roller_radius
        return np.abs(step), -(step * np.conj(normal)).real

    def _short_step(self, k: Reals, stop: float) -> Points:
        """The steps [mm] as integrals of the velocity, whose digits are right down to the stop."""
        nodes, weights = gauss_legendre(12)
        half = 0.5 * (k - stop)
        step = self.step((stop + half[:, None] * (1.0 + nodes)).ravel())
        velocity = (np.exp(1j * step.chi[0]) * step.first).reshape(k.size, nodes.size)
        return np.asarray(self.center_distance * half * (velocity @ weights))

    @cached_property
    def transition_zone(self) -> float:
        """Part of the stroke beside mid-swing, on its wider side, where the roller has left the profile in its slot.

        Raises
            NoSolution - where the pitch curve has a loop
        Notes
            1/2 where the roller covers the profile of half the stroke.
        """
        self.require_profile()
        try:
            (_, before), (after, _) = self.contact
        except NoSolution:
            return 0.5
        return max(self.middle - before, after - self.middle)

    def largest_roller(self, zone: float) -> float:
        """Radius of the roller whose transition zone is a given share of the stroke [mm]."""
        lengths, depths = self._step(np.array([self.middle - zone, self.middle + zone]), self.middle)
        return min(map(fitting_roller, lengths.tolist(), depths.tolist()))

    @property
    def middle_radius(self) -> float:
        """Pitch radius at mid-swing, a - r [mm]."""
        return (1.0 - self.ratio) * self.center_distance

    @cached_property
    def end_radius(self) -> float:
        """Pitch radius at the ends of the stroke, with a slider at the farther one [mm]."""
        half = 0.5 * self.law.swing + abs(self.arm_offset)  # the farther end
        return self.center_distance * math.hypot(1.0 - self.ratio * math.cos(half), self.ratio * math.sin(half))

    @property
    def min_radius(self) -> float:
        """Minimum pitch radius [mm]."""
        return min(self.middle_radius, self.end_radius)

    @property
    def max_radius(self) -> float:
        """Largest pitch radius [mm]."""
        return max(self.middle_radius, self.end_radius)

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
        return max(inside, float(size(np.array([0.0, 1.0])).max()))

    def pressure_angle(self, k: Reals) -> Reals:
        """Pressure angle at fractions of the stroke [rad].

        Raises
            NoSolution - for a pitch curve with a loop
        """
        return self.points(k).pressure_angle

    @cached_property
    def min_curvature_radius(self) -> float:
        """Minimum radius of the pitch curve where it bulges from the body and the roller touches it [mm].

        Raises
            NoSolution - for a loop, or where the roller touches nothing
        Notes
            Outside `contact` the radius falls to zero at mid-swing, and at an end that bulges, whatever the design.
            At an end that is hollow nothing is to be found.
        """
        (first, start), (end, last) = self.contact
        parts = ((max(first, _STOP), start), (end, min(last, 1.0 - _STOP)))
        peak = max(found[0].value for found in extremes_of_parts([(self.bulge, True)], parts, samples=128))
        return 1.0 / peak if peak > 0.0 else math.inf

    def bulge(self, k: Reals) -> Reals:
        """Curvature of the pitch curve [1/mm], positive where it bulges from the body."""
        radius = self.points(k).curvature_radius
        curvature = np.full_like(radius, math.inf)
        np.divide(1.0, radius, out=curvature, where=radius != 0.0)
        for end in (0.0, 1.0):  # infinite as it is in the middle, but towards a hollow where the curve leaves it so
            curvature[k == end] *= math.copysign(1.0, self._stop(end)[0])
        return curvature

    def require_profile(self) -> None:
        """Refuse a pitch curve with a loop.

        Raises
            NoSolution - with what to change
        """
        if self.loop_margin <= 0.0:
            raise NoSolution(
                (f"the pitch curve has a loop at mid-swing (measure {self.loop_margin:.4g}, must be above 0)"),
                fix="put mid-swing nearer to the cam's largest speed by changing the link lengths",
            )

    def points(self, k: Reals) -> CamPoints:
        """Pitch curve, profile, pressure angle and curvature at given fractions of the stroke.

        tan delta = [lambda (chi' + phi') - chi' cos phi]/(chi' sin phi)

        Parameters
            k : (N,) array - fractions of the stroke, 0 to 1
        Returns
            points : CamPoints - cam_angle is chi, from mid-swing
        Raises
            NoSolution - for k outside 0 to 1, or a pitch curve with a loop at mid-swing
        Notes
            Curvature by the parametric formula; at k = 0, k* and 1 its radius is zero.
        """
        self.require_profile()
        step = self.step(k)
        (chi, chi1, chi2), view, first, second = step.chi, step.view, step.first, step.second
        phi1, phi2 = self.law.swing * view.velocity, self.law.swing * view.acceleration
        turn: Points = np.exp(1j * chi)
        pitch, along = turn * step.arm, turn * step.along
        stop = (k == 0.0) | (k == self.middle) | (k == 1.0)
        size = np.where(stop, 1.0, np.abs(first))
        bend = np.where(stop, math.inf, (np.conj(first) * second).imag / size**3)
        profile = pitch + self.roller_radius / self.center_distance * 1j * along
        with np.errstate(divide="ignore"):
            radius = self.center_distance / bend
        return CamPoints(
            k=k,
            cam_angle=chi,
            polar_angle=np.angle(-pitch),
            pitch=self.center_distance * pitch,
            profile=self.center_distance * profile,
            pressure_angle=self._pressure_angle(view.angle, (chi1, chi2), (phi1, phi2), k),
            curvature_radius=radius,
        )

    def step(self, k: Reals) -> Step:
        """The roller's centre and its way over the cam, in centre distances and in the frame of the line of centres.

        Parameters
            k : (N,) array - fractions of the stroke, 0 to 1
        """
        view = self.law.middle_view(k)
        chi, chi1, chi2 = self.drive.motion(k)
        phi1, phi2 = self.law.swing * view.velocity, self.law.swing * view.acceleration
        reach: Points = self.ratio * np.exp(1j * view.angle)
        arm = reach - 1.0
        first = 1j * (chi1 * arm + phi1 * reach)
        second = 1j * (chi2 * arm + phi2 * reach) - chi1**2 * arm - phi1 * reach * (phi1 + 2.0 * chi1)
        stops = np.array([0.0, self.middle, 1.0])
        near = np.abs(k[..., None] - stops).min(axis=-1) <= _AT_STOP
        # where the curve stops its direction is that of the second derivative: before the stop it points back
        along: Points = np.where(
            near,
            np.where((k < 0.5 * self.middle) | ((k > self.middle) & (k < 0.5 + 0.5 * self.middle)), second, -second),
            first,
        )
        return Step(view, (chi, chi1, chi2), arm, first, second, along / np.abs(along))

    def _pressure_angle(
        self,
        phi: Reals,
        chi: tuple[Reals, Reals],
        rate: tuple[Reals, Reals],
        k: Reals,
    ) -> Reals:
        """delta; where cam and rocker stand still the ratio of their accelerations takes the velocities' place.

        Notes
            So it does next to a standstill, where the ratio of the velocities has no right digits: off by 1e-8 there.
        """
        end = np.minimum(k, 1.0 - k) <= _AT_STOP
        cam, rocker = np.where(end, chi[1], chi[0]), np.where(end, rate[1], rate[0])
        across, along = self.ratio * (cam + rocker) - cam * np.cos(phi), cam * np.sin(phi)
        side = np.where(along < 0.0, -1.0, 1.0)
        return np.where(k == self.middle, self.middle_pressure_angle, np.arctan2(across * side, np.abs(along)))


# The way home of an oscillating cam: its crank goes on evenly, and the profile leads the rocker back


_TURN = 2.0 * np.pi


class Home(NamedTuple):
    """Where the cam stands on its way home, and how it goes on.

    Fields
        k : (N,) array - fraction of the stroke at which it stood there, from 1 to 0
        first, second, third : (N,) arrays - derivatives of k by the crank angle; the third empty unless asked for
    """

    k: Reals
    first: Reals
    second: Reals
    third: Reals


def way_home(cam: OscillatingCam, turned: Reals, order: int = 2) -> Home:
    """The cam at crank angles of its way home.

    psi(k) = 2 arg C - psi,  psi'(k) = 2 Im(C'/C) - 1,  psi''(k) = 2 Im(C''/C - (C'/C)^2)
    psi'''(k) = 2 Im(C'''/C - 3 C'' C'/C^2 + 2 (C'/C)^3)

    Parameters
        cam : OscillatingCam
        turned : (N,) array [rad] - crank angle from the start of the stroke, from the stroke's to a whole revolution
        order : 2 or 3 - of the derivatives
    Notes
        C is the end of the rocker that carries the cam, seen from the crank's pivot: the crank pins of both ways are
        mirror images on that line. At both ends, where cam and rocker stand still, nothing is 0/0.
    """
    bar, span = cam.drive.linkage, cam.drive.crank_span
    found = solve(bar, cam.drive.crank_angles[0] + turned, order)
    arm = bar.rocker * np.exp(1j * found.rocker_angle)
    end = bar.frame + arm
    speed = found.rocker_velocity
    rate = 1j * speed * arm / end
    curve = (1j * found.rocker_acceleration - speed**2) * arm / end
    bend = curve - rate * rate
    third = np.empty(0)
    if order > 2:
        jerk = (1j * (found.rocker_jerk - speed**3) - 3.0 * speed * found.rocker_acceleration) * arm / end
        third = 2.0 * (jerk - 3.0 * curve * rate + 2.0 * rate**3).imag / span
    forth = _from(0.5 * (span - _TURN), 2.0 * np.angle(end) - 2.0 * cam.drive.crank_angles[0] - turned)
    return Home(_within(forth, 0.0, span) / span, (2.0 * rate.imag - 1.0) / span, 2.0 * bend.imag / span, third)


def crank_angle(cam: OscillatingCam, k: Reals) -> Reals:
    """Crank angle from the start of the stroke at which the cam, on its way home, stands as at k [rad].

    Parameters
        cam : OscillatingCam
        k : (N,) array - fractions of the stroke
    Returns
        turned : (N,) array [rad] - from a whole revolution at k = 0 down to the stroke's at k = 1
    """
    bar, start, span = cam.drive.linkage, cam.drive.crank_angles[0], cam.drive.crank_span
    forth = k * span
    end = bar.frame + bar.rocker * np.exp(1j * solve(bar, start + forth, 0).rocker_angle)
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

    Parameters
        cam : OscillatingCam
    Returns
        need : Extreme - at least 1, for at both ends the crank is the same; among places where the roller touches
    Raises
        NoSolution - for a loop, or where the roller touches nothing
    """
    found = [each for (each,) in extremes_of_parts([(partial(need_home, cam), True)], cam.contact, samples=128)]
    return max(*found, Extreme(1.0, 0.0), key=lambda extreme: extreme.value)


def need_home(cam: OscillatingCam, k: Reals) -> Reals:
    """Torque of inertia on the way home over that of the stroke, where the cam stands as at k.

    (m k'^2 + j phi_k k'')/(m/span^2), m that of the stroke; of a rocker alone j = 1 and m its acceleration

    Parameters
        cam : OscillatingCam
        k : (N,) array - fractions of the stroke, without 1/2, where the rocker has no acceleration in it
    """
    back = way_home(cam, crank_angle(cam, k))
    span = cam.drive.crank_span
    if isinstance(cam.law, AimedLaw):
        law = cam.law.law
        a, b = law.invariants(k, 1)
        inertia = np.array([law.inertia_at(share) for share in a.ravel().tolist()]).reshape(a.shape)
        pace = inertia * b / law.device_torque(k)
    else:
        view = cam.law.middle_view(k)
        pace = view.velocity / view.acceleration
    found: Reals = span**2 * (back.first**2 + back.second * pace)
    return found
