"""The cam of a wide swing: pitch curve, contact with the roller, profile; of one that turns evenly its sizes too.

With sigma = +1 for the twin-cam (cam and rocker turn against each other) and -1 for the twin-rocker (they turn
together), the signed radius ratio lambda = sigma r/a and rocker angle psi = sigma phi give the pitch curve
w = e^{i theta} (-1 + lambda e^{i psi}); the twin-rocker's is -conj(w).

Both angles are counted from k*, where the roller passes the line of centres: mid-swing, but for a rocker with a slider
the place where it is fastest. There the pitch curve is a cusp, and all that vanishes there is formed from the products
e = chi' - lambda A with A = chi' + psi' (chi' = 1 of a cam that turns evenly), and s = 1 - cos psi, never from
differences.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, TypeVar

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_above, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short, unlike
from gearlink.core.machines.wide_swing.law import ElasticLaw, MiddleView
from gearlink.core.machines.wide_swing.slider import AimedLaw
from gearlink.core.numerics.arrays import Points, Reals
from gearlink.core.numerics.extremes import Extreme, extremes_of_parts, extremes_over, maximum_over
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.numerics.roots_sweep import root_between
from gearlink.core.numerics.together import kept_last

StrokeLaw: TypeAlias = ElasticLaw | AimedLaw
"""A law of motion of the rocker, as its cam sees it: from the place where the roller passes the line of centres."""


def roller_arm(ratio: float, versed: Any, sine: Any) -> Any:
    """The roller centre from the cam axis, -1 + lambda e^{i psi}, of 1 - cos psi and sin psi, numbers or arrays."""
    return -((1.0 - ratio) + ratio * versed) + 1j * ratio * sine


@dataclass(frozen=True, eq=False)
class CurveState:
    """Cam and roller at fractions of the stroke, in centre distances, rates by the input angle; and what follows.

    Fields
        k : (N,) array - like theta no number where nobody asks for it
        theta, psi : (N,) arrays [rad] - cam angle and signed rocker angle from k*
        turning : (N,) array - chi', speed of the cam; 1 of one that turns evenly
        a, e : (N,) arrays - A = chi' + psi', e = chi' - lambda A
        s : (N,) array - 1 - cos psi
        bend : (N,) array - psi'' chi' - psi' chi''
        sense : int - sigma, +1 external, -1 internal profile
        ratio : float - signed lambda = sigma r/a
    Source
        wide-swing dissertation, chapter 3 and (26); curvature and product forms: own derivation
    """

    k: Reals
    theta: Reals
    psi: Reals
    turning: Reals
    a: Reals
    e: Reals
    s: Reals
    bend: Reals
    sense: int
    ratio: float

    @cached_property
    def sine(self) -> Reals:
        """sin psi."""
        return np.sin(self.psi)

    @property
    def correction(self) -> Reals:
        """beta, polar angle of the roller centre against the centre line."""
        return np.asarray(np.angle(-np.conj(self.arm)))

    @property
    def arm(self) -> Points:
        """The roller centre from the cam axis, in the frame of the line of centres."""
        return np.asarray(roller_arm(self.ratio, self.s, self.sine))

    @property
    def pitch(self) -> Points:
        """w, the roller centre in the cam's frame."""
        result: Points = np.exp(1j * self.theta) * self.arm
        return result

    @cached_property
    def gradient(self) -> Points:
        """g = chi' - lambda A e^{i psi}, along the inward normal in the centre line's frame; |g| the roller's way."""
        pull = self.ratio * self.a
        result: Points = (self.e + pull * self.s) - 1j * pull * self.sine
        return result

    @property
    def heading(self) -> Points:
        """What has its direction."""
        return self.gradient

    @cached_property
    def unit(self) -> Points:
        """Its direction; at the cusp the limit of the run-up."""
        heading = self.heading
        size = np.abs(heading)
        cusp = size == 0.0
        result: Points = heading / np.where(cusp, 1.0, size) + np.where(cusp, 1j * self.sense, 0.0)
        return result

    @property
    def outward(self) -> Points:
        """Direction in which the profile pushes the roller, in the frame of the line of centres."""
        return np.asarray(-self.sense * self.unit)

    @property
    def normal(self) -> Points:
        """Unit normal in the cam's frame with an inward radial part."""
        result: Points = np.exp(1j * self.theta) * self.unit
        return result

    @property
    def curvature(self) -> Reals:
        """Curvature times centre distance, positive with the centre towards the cam axis, infinite at the cusp."""
        ratio, a, turning = self.ratio, self.a, self.turning
        turn = self.e * (turning * turning - ratio * a * a) + self.s * ratio * a * turning * (turning + a)
        turn = turn - ratio * self.bend * self.sine
        size = np.abs(self.gradient) ** 3
        cusp = size == 0.0
        return np.where(cusp, self.sense * math.inf, turn / np.where(cusp, 1.0, size))

    @property
    def bulge(self) -> Reals:
        """The same, positive where the pitch curve bulges from the body."""
        return np.asarray(self.sense * self.curvature)

    @property
    def pressure_angle(self) -> Reals:
        """delta from tan delta = (lambda A - chi' cos phi)/(chi' sin phi)."""
        sine = self.sense * self.sine * self.turning
        return np.arctan2((self.turning * self.s - self.e) * np.where(sine < 0.0, -1.0, 1.0), np.abs(sine))

    @property
    def loop_measure(self) -> Reals:
        """(dTheta/dtheta) rho^2/(1 - cos phi) = (1 - lambda) e/s + lambda (1 + A), away from mid-swing."""
        result: Reals = (1.0 - self.ratio) * self.e / self.s + self.ratio * (1.0 + self.a)
        return result

    def resting(self) -> CurveState:
        """The same places with the rocker at rest: on the arc beside the stroke."""
        ones = np.ones_like(self.k)
        return replace(self, a=ones, e=(1.0 - self.ratio) * ones, bend=0.0 * ones)


# Contact of a wide-swing roller about mid-swing: its exact end, and the dissertation's estimates of curvature


Part = TypeVar("Part")
Step: TypeAlias = Callable[["Reals"], tuple["Reals", "Reals"]]

SMALLEST = 1e-4
"""Below this share of the stroke the leading order, good to the square of the zone, is nearer than the solution."""
SHRINK = 0.7
_SETTLED = 1e-13
_BESIDE = 0.01
"""Share of the way to mid-swing below which a step is too short to tell the bend between its ends."""
KNOWN = 1e-16
"""Fractions of the stroke are known no better."""


def covered(step: Step, roller_radius: float, far: float, estimate: float, noise: float = 0.0) -> float:
    """Way t from a stop of the pitch curve over which the roller, standing there, covers the profile.

    |z + r_p n - z(stop)| = r_p

    Parameters
        step : function of ways t from the stop, an array - lengths of the pitch point's way from the stop, and their
            components against the profile's normal [mm]
        roller_radius : float [mm]
        far : float - t at which the profile must be free
        estimate : float - t is sought from a hundredth of it on
        noise : float - rounding of t times t, where steps are differences of places
    Returns
        t : float - 0 where nothing is covered
    Raises
        NoSolution - where the profile is covered as far as `far`
    """

    def clearance(t: Reals) -> Reals:
        return roller_room(step(t), roller_radius)

    t = shrinking(far, 0.01 * estimate / far)
    room = clearance(t)
    if room[0] <= 0.0:
        most = fitting_roller(*(float(part[0]) for part in step(t[:1])))
        raise NoSolution(
            f"roller radius: {unlike(roller_radius, most)} mm (limit < {unlike(most, roller_radius)} mm, where the "
            "roller at rest covers the whole profile)",
            fix=f"set cam.roller_radius below {safely_below(most)} mm, or increase cam.center_distance",
        )
    within = np.flatnonzero(room < 0.0)
    if not within.size:
        return 0.0
    (low, high), ends = (rows[[within[0], within[0] - 1]].tolist() for rows in (t, room))
    if not noise:
        return root_between(clearance, low, high, tolerance=KNOWN)
    # of the places that rounding takes for roots the last one is found as before: a curvature beside it has no bound
    known = KNOWN + noise / low
    return bracketed_root(lambda part: float(clearance(np.array([part]))[0]), low, high, tolerance=known, ends=ends)


def shrinking(far: Any, share: float) -> Reals:
    """Places from the farthest on, number or column, each 0.7 of the one before, as far as a share of it."""
    return np.asarray(far * np.power(SHRINK, np.arange(math.ceil(math.log(min(SHRINK, share), SHRINK)) + 1)))


def fitting_roller(length: float, depth: float) -> float:
    """Radius of the roller that is just free of the profile after a step from its stop [mm]; infinite where all are.

    r_p = |d|^2/(-2 d n)

    Parameters
        length, depth : float [mm] - |d| and -d n of the step
    """
    return length * length / (2.0 * depth) if depth > 0.0 else math.inf


def end_of_contact(cam: WideSwingCam, side: float = -1.0) -> tuple[float, float]:
    """Where the roller leaves the profile on one side of k*, whose rest its slot there has cut away.

    Parameters
        side : float - -1 before k*, 1 behind it
    Returns
        k, turn : floats - fraction of the stroke, and angle of the law there
    Raises
        NoSolution - where the roller at k* covers a whole side of the profile, or the pitch curve has a loop
    Notes
        With a rocker radius below that of (18), (24) the pitch curve turns smoothly at mid-swing; 1/2 where the
        roller, standing there, cuts nothing away. Where it does, it cuts more just before mid-swing. At a cusp the
        rest has a relative error of at most 1e-7, where it is 1e-4 of the stroke.
    Example
        >>> from gearlink.core.machines.wide_swing.cam import WideSwingCam
        >>> from gearlink.core.machines.wide_swing.law import ElasticLaw, Pneumatic
        >>> law = ElasticLaw(Pneumatic(2.5), math.radians(120))
        >>> round(end_of_contact(WideSwingCam("twin-cam", law, math.radians(120), 200.0, 8.0))[0], 9)
        0.462338155
    """
    law, smooth = cam.law, cam.rocker_radius < cam.nominal_rocker_radius
    estimate = SMALLEST if smooth else min(cam.transition_zone_estimate, 0.5)
    if estimate < SMALLEST:
        return cam.middle + side * estimate, law.turn_at(side * estimate)
    far = abs(law.turns[side > 0.0])
    turn = side * covered(lambda t: cam.step_at(side * t), cam.roller_radius, far, law.turn_near(estimate))
    end = cam.middle + float(law.share_from_middle(np.array([turn]))[0])
    if smooth and turn < 0.0:
        end = _cut_on_the_way(cam, end)
        turn = law.turn_at(end - cam.middle)
    return end, turn


def _cut_on_the_way(cam: WideSwingCam, end: float) -> float:
    """Where the profile of a smooth bend ends, which the roller on its way to mid-swing cuts deeper than at rest."""

    def room(k: float) -> float:
        return roller_before_middle(cam, k) - cam.roller_radius

    high, low = end, SHRINK * end
    while room(low) <= 0.0 and low > SMALLEST:
        high, low = low, SHRINK * low
    return bracketed_root(room, low, high, tolerance=_SETTLED) if room(high) < 0.0 < room(low) else high


def roller_before_middle(cam: WideSwingCam, k: float) -> float:
    """Largest roller that leaves the profile at k free on the rest of its way to mid-swing [mm].

    r_p = min over t of |d|^2/(-2 d n), d = z(k) - z(t), k < t <= 1/2

    Parameters
        k : float - below 1/2
    Returns
        r_p : float [mm] - infinite where every roller does
    """
    here = cam.state(np.array([k]))
    place, normal = here.pitch[0], cam.sense * np.conj(here.normal[0])

    def needed(part: Reals) -> Reals:
        step = place - cam.state(k + (0.5 - k) * part).pitch
        found: Reals = -2.0 * (step * normal).real / np.abs(step) ** 2
        return found

    bend = maximum_over(needed, _BESIDE, 1.0, samples=256).value
    return cam.center_distance / bend if bend > 0.0 else math.inf


def roller_room(step: tuple[Reals, Reals], roller_radius: float) -> Reals:
    """By how much the square of a step's length exceeds that on the circle of the roller at the stop [mm^2]."""
    length, depth = step
    room: Reals = length * length - 2.0 * roller_radius * depth
    return room


def start_radius_estimate(cam: WideSwingCam, k: float = 0.1) -> float:
    """The dissertation's estimate of the curvature radius at the start of the stroke.

    R = (rho0^2 + rho1^2 - 2 rho0 rho1 cos M)/(2 (rho0 - rho1 cos M)), M = Theta(k) - Theta(0)

    Parameters
        k : float - the second point of the circle, the dissertation's is 0.1
    Returns
        R : float [mm] - negative with the centre away from the cam axis
    Raises
        NoSolution - for a profile that does not exist
    Notes
        A circle centred on the first radius; 3 % above to 11 % below `start_curvature_radius` for a twin-cam,
        no use for a twin-rocker.
    Example
        >>> from gearlink.core.machines.wide_swing.cam import WideSwingCam
        >>> from gearlink.core.machines.wide_swing.law import ElasticLaw, Pneumatic
        >>> law = ElasticLaw(Pneumatic(2.5), math.radians(120))
        >>> round(start_radius_estimate(WideSwingCam("twin-cam", law, math.radians(120), 200.0, 8.0)), 9)
        91.984628813

    Source
        wide-swing dissertation (23)
    """
    points = cam.points(np.array([0.0, k]))
    start, other = (float(x) for x in np.abs(points.pitch))
    versed = 2.0 * math.sin(0.5 * float(points.polar_angle[1] - points.polar_angle[0])) ** 2
    drop = start - other
    return (drop * drop + 2.0 * start * other * versed) / (2.0 * (drop + other * versed))


def middle_radius_estimate(cam: WideSwingCam, k: float = 0.45) -> float:
    """The dissertation's estimate of the curvature radius at mid-swing.

    R = (rho_k^2 + rho_m^2 - 2 rho_k rho_m cos M)/(2 rho_k sin M), M = |Theta(k)|

    Parameters
        k : float - the second point of the circle, the dissertation's is 0.45
    Returns
        R : float [mm]
    Raises
        NoSolution - for a profile that does not exist
    Notes
        The circle tangent to the radial line at mid-swing. The true radius falls to zero there; this is 3/8 of the
        true one at k, and equal to it near k = 0.481.
    Example
        >>> from gearlink.core.machines.wide_swing.cam import WideSwingCam
        >>> from gearlink.core.machines.wide_swing.law import ElasticLaw, Pneumatic
        >>> law = ElasticLaw(Pneumatic(2.5), math.radians(120))
        >>> round(middle_radius_estimate(WideSwingCam("twin-rocker", law, math.radians(80), 200.0, 4.0)), 9)
        4.696585663

    Source
        wide-swing dissertation (27)
    """
    points = cam.points(np.array([k]))
    rho, angle = abs(complex(points.pitch[0])), abs(float(points.polar_angle[0]))
    drop, middle = rho - cam.middle_radius, cam.middle_radius
    square = drop * drop + 4.0 * rho * middle * math.sin(0.5 * angle) ** 2
    return square / (2.0 * rho * math.sin(angle))


# Cams of wide-swing mechanisms: the twin-cam with external and the twin-rocker with internal profile


LEAST_SPEED_RATIO = 1e-10  # B gamma/phi_ud; 1 - lambda, about as large, keeps six digits

Layout = Literal["twin-cam", "twin-rocker"]


@dataclass(frozen=True, slots=True, eq=False)
class CamPoints:
    """Points of a cam in its own frame, origin on the cam axis, mid-swing on the x axis.

    Fields
        k : (N,) array - fraction of the stroke
        cam_angle, polar_angle : (N,) arrays [rad] - theta = (k - 1/2) phi_ud, and Theta of the pitch point, both
            from mid-swing
        pitch, profile : (N,) complex arrays [mm] - roller centre and contact point
        pressure_angle : (N,) array [rad]
        curvature_radius : (N,) array [mm] - of the pitch curve, positive with the centre towards the cam axis,
            infinite where straight
    """

    k: Reals
    cam_angle: Reals
    polar_angle: Reals
    pitch: Points
    profile: Points
    pressure_angle: Reals
    curvature_radius: Reals


START, MIDDLE, END = range(3)
"""Places at which the pitch curve may stop: k = 0, k* and 1."""


class StrokeCam:
    """What the cams of all layouts share: radii, contact and profile, out of the pitch curve of a subclass.

    Fields
        law : StrokeLaw - law of motion of the rocker, which gives k*
        center_distance, roller_radius : float [mm] - a, r_p
        sense : int - +1 of an external, -1 of an internal profile
        ratio : float - signed lambda = sense r/a
    """

    law: StrokeLaw
    center_distance: float
    roller_radius: float

    if TYPE_CHECKING:

        @property
        def sense(self) -> int: ...
        @property
        def ratio(self) -> float: ...
        @property
        def contact(self) -> tuple[tuple[float, float], tuple[float, float]]: ...
        @property
        def tops(self) -> list[list[Extreme]]: ...
        def state(self, k: Reals, /) -> CurveState: ...
        def step(self, k: Reals, stop: int, /) -> tuple[Reals, Reals]: ...
        def require_profile(self) -> None: ...

    @property
    def symmetric(self) -> bool:
        """Whether both parts of the profile beside k* are mirror images."""
        return False

    def sides(self, *parts: Part) -> tuple[Part, ...]:
        """Of something on each side of k* those that say different things."""
        return parts[:1] if self.symmetric else parts

    @property
    def middle(self) -> float:
        """k*, fraction of the stroke at which the roller is on the line of centres."""
        return self.law.place

    @property
    def arm_offset(self) -> float:
        """phi_0, rocker angle from mid-swing at which the roller is on the line of centres [rad]."""
        return self.law.offset

    @property
    def ends(self) -> tuple[float, float]:
        """Rocker angles between the line of centres and both ends of the swing [rad]."""
        half = 0.5 * self.law.swing
        return half + self.law.offset, half - self.law.offset

    def pitch_radius(self, phi: float) -> float:
        """Pitch radius at a rocker angle from the line of centres [mm] (dissertation (20))."""
        return self.center_distance * abs(self._arm_at(phi))

    def _arm_at(self, phi: float) -> complex:
        arm: complex = roller_arm(self.ratio, 2.0 * math.sin(0.5 * phi) ** 2, self.sense * math.sin(phi))
        return arm

    @cached_property
    def middle_radius(self) -> float:
        """Pitch radius at k*, a - r external, a + r internal [mm]."""
        return abs(1.0 - self.ratio) * self.center_distance

    @cached_property
    def end_radius(self) -> float:
        """Pitch radius at the ends of the stroke, the greater one [mm]."""
        return max(map(self.pitch_radius, self.ends))

    @property
    def min_radius(self) -> float:
        """Minimum pitch radius [mm]."""
        return min(self.middle_radius, self.end_radius)

    @property
    def max_radius(self) -> float:
        """Largest pitch radius [mm]."""
        return max(self.middle_radius, self.end_radius)

    @cached_property
    def transition_zone(self) -> float:
        """Part of the stroke beside k*, on its wider side, where the roller, in its slot, has left the profile.

        Raises
            NoSolution - for a profile that does not exist
        Notes
            1/2 where the roller at k* covers the profile of a whole side.
        """
        self.require_profile()
        try:
            (_, before), (after, _) = self.contact
        except NoSolution:
            return 0.5
        return max(self.sides(self.middle - before, after - self.middle))

    @property
    def slot(self) -> tuple[float, float]:
        """Fractions of the stroke between which the roller at k* has cut the profile away."""
        (_, start), (end, _) = self.contact
        return start, end

    @cached_property
    def _slot_ends(self) -> tuple[complex, complex, float, float]:
        """Roller centre at k*, its radius into the body, and the directions of both ends of the slot from it [rad]."""
        state = self.state(np.array([*self.slot, self.middle]))
        pitch, size = self.center_distance * state.pitch, self.roller_radius
        middle = complex(pitch[2])
        into = -self.sense * size * middle / abs(middle)
        ends = pitch[:2] + self.sense * size * state.normal[:2]
        first, last = (float(np.angle((end - middle) / into)) for end in ends)
        return middle, into, first, last

    def slot_bottom(self, share: Reals) -> Points:
        """Arc of the roller at k*, from the end of the run-up's profile to the start of the run-out's, in the frame of
        `CurveState` [mm]."""
        middle, into, first, last = self._slot_ends
        arc: Points = middle + into * np.exp(1j * (first + (last - first) * share))
        return arc

    def largest_roller(self, zone: float) -> float:
        """Radius of the roller whose transition zone is a given share of the stroke [mm]."""
        places = np.array(self.sides(self.middle - zone, self.middle + zone))
        lengths, depths = self.step(np.clip(places, 0.0, 1.0), MIDDLE)
        return min(map(fitting_roller, lengths.tolist(), depths.tolist()))

    def pressure_angle(self, k: Reals) -> Reals:
        """Pressure angle at fractions of the stroke [rad], of the pitch curve even where it has a loop."""
        return self.state(k).pressure_angle

    def bulge(self, k: Reals) -> Reals:
        """Curvature of the pitch curve [1/mm], positive where it bulges from the body."""
        return np.asarray(self.state(k).bulge / self.center_distance)

    @cached_property
    def min_curvature_radius(self) -> float:
        """Minimum radius of the pitch curve where it bulges from the body and the roller touches it [mm].

        Raises
            NoSolution - where it touches nothing
        Notes
            In the transition zone the radius falls to zero at k* whatever the design, and so it does at an end of the
            stroke of a cam that stops and bulges there. Infinite where the curve bulges nowhere outside.
        """
        peak = max(each[-1].value for each in self.tops)
        return self.center_distance / peak if peak > 0.0 else math.inf

    def points(self, k: Reals) -> CamPoints:
        """Pitch curve, profile, pressure angle and curvature at given fractions of the stroke.

        z = e^{i theta}(-1 + lambda e^{i phi}), tan delta = (lambda A - cos phi)/sin phi
        R = |1 - lambda A e^{i phi}|^3/(1 - lambda A (1 + A) cos phi + lambda^2 A^3 - lambda phi'' sin phi)

        Parameters
            k : (N,) array - fractions of the stroke, 0 to 1
        Raises
            NoSolution - for k outside 0 to 1, or a profile that does not exist
        Notes
            The body lies inside an external and outside an internal profile. k* is taken as the end of the
            run-up. The profile points between the two parts of `contact` are cut away by the slot that the
            roller needs at k*. The curvature of a cam that turns evenly keeps a relative accuracy of about 1e-13
            up to the cusp itself.
        Example
            >>> from gearlink.core.machines.wide_swing.law import ElasticLaw, Pneumatic
            >>> law = ElasticLaw(Pneumatic(2.5), math.radians(120))
            >>> points = WideSwingCam("twin-cam", law, math.radians(120), 1.0, 0.04).points(np.array([0.25]))
            >>> points.profile.round(9).tolist()
            [(-0.724642568+0.156427799j)]

        Source
            wide-swing dissertation, chapter 3 and (26); curvature: own derivation
        """
        self.require_profile()
        state = self.state(np.asarray(k, dtype=np.float64))
        pitch, place = state.pitch, self.center_distance
        profile = pitch + self.sense * self.roller_radius / place * state.normal
        with np.errstate(divide="ignore"):
            radius = place / state.curvature + 0.0
        return CamPoints(
            k=state.k,
            cam_angle=state.theta,
            polar_angle=state.theta - state.correction,
            pitch=place * mirrored(pitch, self.sense),
            profile=place * mirrored(profile, self.sense),
            pressure_angle=state.pressure_angle,
            curvature_radius=radius,
        )


@dataclass(frozen=True)
class WideSwingCam(StrokeCam):
    """One cam of a twin-cam or twin-rocker mechanism that turns evenly; every property is computed when it is read.

    r = a/(B alpha + 1) external, a/(B alpha - 1) internal, alpha = gamma/phi_ud

    Parameters
        layout : "twin-cam" (external profile) or "twin-rocker" (internal profile)
        law : StrokeLaw - law of motion of the rocker; of one with a slider an `AimedLaw`, seen from where it is fastest
        cycle_angle : float [rad] - phi_ud, cam angle of one stroke
        center_distance, roller_radius : float [mm] - a, r_p
        given_rocker_radius : float or None [mm] - instead of the r of (18) or (24)
        angle_words : str - what a refusal calls the cam angle of the stroke
    Raises
        NoSolution - for lengths that are not positive, a cycle angle outside (0, 360 deg], and a twin-rocker with
            B alpha <= 1
    Notes
        With the r of (18), (24) the roller centre passes the velocity pole at mid-swing: the pressure angle is
        zero there and the pitch curve has a cusp, rho - rho_mid = p t^2, tangential q t^3.
    Example
        >>> from gearlink.core.machines.wide_swing.law import ElasticLaw, Pneumatic
        >>> law = ElasticLaw(Pneumatic(2.5), math.radians(120))
        >>> cam = WideSwingCam("twin-cam", law, math.radians(120), 200.0, 8.0)
        >>> round(cam.rocker_radius, 9), round(math.degrees(cam.phase_angle), 9)
        (74.417949578, 38.401731774)
        >>> round(cam.contact[0][1], 9)
        0.462338155

    Source
        wide-swing dissertation (18) to (22), (24) to (26); cusp, transition zone and existence: own derivation
    """

    layout: Layout
    law: StrokeLaw
    cycle_angle: float
    center_distance: float
    roller_radius: float
    given_rocker_radius: float | None = None
    angle_words: str = field(default="the cycle angle", compare=False)

    def __post_init__(self) -> None:
        require_lengths(self.center_distance, self.roller_radius, self.given_rocker_radius)
        if not 0.0 < self.cycle_angle <= 2.0 * math.pi:
            raise NoSolution(
                f"cam angle of the stroke: {unlike(math.degrees(self.cycle_angle), 360.0)} deg (above 0, at most 360 "
                "deg)"
            )
        if self.speed_ratio_peak < LEAST_SPEED_RATIO:
            raise too_small_swing(self.law.swing, self.speed_ratio_peak)
        if self.layout == "twin-rocker" and self.speed_ratio_peak <= 1.0:
            limit = math.degrees(self.law.velocity_peak * self.law.swing)
            raise NoSolution(
                f"peak speed of the rocker over that of the cam: {unlike(self.speed_ratio_peak, 1.0)} (limit > 1 "
                "for a twin-rocker)",
                fix=(
                    f"reduce {self.angle_words} to at most {safely_below(0.5 * limit)} deg (with up to "
                    f"{safely_below(limit)} deg the rocker is longer than the centre distance), or increase the swing"
                ),
            )

    @property
    def sense(self) -> int:
        """sigma: +1 where cam and rocker turn against each other (twin-cam), -1 where together (twin-rocker)."""
        return 1 if self.layout == "twin-cam" else -1

    @property
    def symmetric(self) -> bool:
        """As the law is, of a cam that turns evenly."""
        return self.law.symmetric

    @property
    def speed_ratio(self) -> float:
        """alpha = gamma/phi_ud, mean speed of the rocker over the cam's."""
        return self.law.swing / self.cycle_angle

    @cached_property
    def speed_ratio_peak(self) -> float:
        """B alpha."""
        return self.law.velocity_peak * self.speed_ratio

    @property
    def nominal_rocker_radius(self) -> float:
        """r of (18) or (24) [mm]."""
        return self.center_distance / (self.speed_ratio_peak + self.sense)

    @property
    def rocker_radius(self) -> float:
        """r, from the rocker's pivot to the roller centre [mm]."""
        return self.nominal_rocker_radius if self.given_rocker_radius is None else self.given_rocker_radius

    @cached_property
    def ratio(self) -> float:
        """Signed lambda = sigma r/a."""
        return self.sense * self.rocker_radius / self.center_distance

    @cached_property
    def _middle_gap(self) -> float:
        """e at mid-swing: 0 but for a given rocker radius."""
        if self.given_rocker_radius is None:
            return 0.0
        return 1.0 - self.given_rocker_radius / self.nominal_rocker_radius

    def state(self, k: Reals) -> CurveState:
        """Cam and roller at fractions k of the stroke."""
        return self.state_of(self.law.middle_view(k), k - self.middle)

    def state_at(self, turn: Reals) -> CurveState:
        """The same at angles of the law, but for where the cam stands: neither pressure angle nor curvature ask it."""
        return self.state_of(self.law.view_at(turn), np.full_like(turn, math.nan))

    def state_of(self, view: MiddleView, share: Reals) -> CurveState:
        """The same of a view of the law at k - k*."""
        a, bend = self.rates(view, self.cycle_angle)
        return CurveState(
            k=self.middle + share,
            theta=share * self.cycle_angle,
            psi=self.sense * view.angle,
            turning=np.ones_like(share),
            a=a,
            e=self._middle_gap + abs(self.ratio) * self.speed_ratio * view.deficit,
            s=2.0 * np.sin(0.5 * view.angle) ** 2,
            bend=bend,
            sense=self.sense,
            ratio=self.ratio,
        )

    def rates(self, view: MiddleView, angle: float) -> tuple[Reals, Reals]:
        """A = 1 + psi' and psi'' of a stroke over a cam angle [rad]; negative where the law runs backwards."""
        pace = self.sense * self.law.swing / angle
        return 1.0 + pace * view.velocity, pace / angle * view.acceleration

    def step(self, k: Reals, _stop: int, /) -> tuple[Reals, Reals]:
        """Lengths of the pitch point's steps to k*, and their parts along the profile's normal [mm]."""
        return self._step(self.state(k))

    def step_at(self, turn: Reals) -> tuple[Reals, Reals]:
        """The same from angles of the law."""
        return self._step(self.state_of(self.law.view_at(turn), self.law.share_from_middle(turn)))

    def room_at(self, turn: Reals) -> Reals:
        """How far the profile at angles of the law is from the roller at k*: |d|^2 + 2 r_p d n [mm^2]."""
        return roller_room(self.step_at(turn), self.roller_radius)

    def _step(self, state: CurveState) -> tuple[Reals, Reals]:
        # z(k) - z(k*) in terms that vanish there, each of them exact
        half = np.exp(0.5j * state.theta)
        turned = -2j * np.sin(0.5 * state.theta) * half * (1.0 - self.ratio)
        step = turned + self.ratio * half * half * (1j * state.sine - state.s)
        size = self.center_distance
        return size * np.abs(step), -size * self.sense * (step * np.conj(state.normal)).real

    @cached_property
    def profile_correction(self) -> float:
        """xi, polar angle of the roller against the centre line at the end of the stroke [rad] ((19), (25))."""
        return cmath.phase(-self._arm_at(0.5 * self.law.swing).conjugate())

    @cached_property
    def largest_profile_correction(self) -> float:
        """Largest xi of the stroke: asin lambda where the roller arm touches the pitch point's ray [rad]."""
        ratio = self.ratio
        if abs(ratio) < 1.0 and math.cos(0.5 * self.law.swing) < ratio:
            return math.asin(abs(ratio))
        return self.profile_correction

    @property
    def zero_end_swing(self) -> float | None:
        """Swing at whose ends a cam of this rocker radius has no pressure angle, 2 acos(lambda) [rad]; None above 1."""
        return 2.0 * math.acos(self.ratio) if abs(self.ratio) < 1.0 else None

    @property
    def phase_angle(self) -> float:
        """Phi = phi_ud/2 - xi, cam angle of the run-up profile [rad] ((21), (22))."""
        return 0.5 * self.cycle_angle - self.profile_correction

    @cached_property
    def start_curvature_radius(self) -> float:
        """R of the pitch curve at the start of the stroke, negative with its centre away from the cam axis [mm].

        R0 = rho^2/(rho + lambda sin(gamma/2) psi''(0)/rho)
        """
        curvature = float(self.state(np.zeros(1)).curvature[0])
        return self.center_distance / curvature if curvature != 0.0 else math.inf

    @cached_property
    def cusp(self) -> tuple[float, float]:
        """p and q of the pitch curve's cusp, rho - rho_mid = p t^2, tangential q t^3, t cam angle [mm, mm]."""
        ratio, arm = self.ratio, abs(self.ratio)
        third = self.law.swing * abs(self.law.middle_jerk) / self.cycle_angle**3
        bracket = (1.0 + ratio) / ratio**2 + arm * third / (1.0 - ratio)
        a = self.center_distance
        return 0.5 * a * self.speed_ratio_peak, a * (1.0 - ratio) / 6.0 * bracket

    @cached_property
    def transition_zone_estimate(self) -> float:
        """`transition_zone` to leading order in r_p/a.

        Dk = (4/3) t_c/phi_ud, t_c = 3 q r_p/(4 p^2): the pitch curvature radius has fallen to r_p at t_c

        Raises
            NoSolution - where the pitch curve has a loop instead of the cusp (q <= 0)
        """
        p, q = self.cusp
        if q <= 0.0:
            raise self._loop(q)
        return q * self.roller_radius / (p * p * self.cycle_angle)

    @cached_property
    def contact(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Parts of the stroke in which the roller touches the profile, whose rest its slot at k* has cut away.

        Raises
            NoSolution - for a profile that does not exist, or where the roller at k* covers a whole side of it
        Notes
            With a rocker radius below that of (18), (24) the pitch curve turns smoothly at mid-swing; 1/2 where the
            roller, standing there, cuts nothing away. Where it does, it cuts more just before mid-swing.
        """
        self.require_profile()
        ends = [end for end, _ in self.contact_ends]
        return (0.0, ends[0]), (1.0 - ends[0] if self.symmetric else ends[1], 1.0)

    @cached_property
    def contact_ends(self) -> tuple[tuple[float, float], ...]:
        """Where the roller leaves the profile on the sides of k*: fraction of the stroke, and angle of the law."""
        self.require_profile()
        return tuple(end_of_contact(self, side) for side in self.sides(-1.0, 1.0))

    def largest_roller(self, zone: float) -> float:
        most = super().largest_roller(zone)
        return most if self._middle_gap == 0.0 else min(most, roller_before_middle(self, 0.5 - zone))

    @cached_property
    def loop_margin(self) -> float:
        """Minimum of (dTheta/dtheta) rho^2/(1 - cos phi) over the stroke: the profile exists where it is positive.

        h = (1 - lambda) e/s + lambda (1 + A), at mid-swing 6 q lambda^2/rho_mid, infinite there where e is
        """
        if self._middle_gap < 0.0:
            return -math.inf
        there = math.inf if self._middle_gap > 0.0 else 6.0 * self.cusp[1] * self.ratio**2 / self.middle_radius
        return min(*self.least_loop_measures, there)

    @cached_property
    def least_loop_measures(self) -> tuple[float, ...]:
        """Minima of it on the sides of k*; nearer than a thousandth it is as good as that at k*."""
        start, end = self.law.turns
        sides = self.sides((start, 1e-3 * start), (1e-3 * end, end))
        found = extremes_of_parts([(lambda turn: self.state_at(turn).loop_measure, False)], sides, samples=256)
        return tuple(each.value for (each,) in found)

    def _loop(self, value: float) -> NoSolution:
        safe = math.degrees(0.5 * self.law.velocity_peak * self.law.swing)
        fix = f"reduce {self.angle_words} to {safely_below(safe)} deg or less"
        if self.given_rocker_radius is not None:
            fix = f"omit the rocker radius, and {fix}"
        return NoSolution(f"the pitch curve has a loop at mid-swing (measure {short(value)}, limit > 0)", fix=fix)

    def require_profile(self) -> None:
        """Refuse a profile that does not exist.

        Raises
            NoSolution - for a rocker radius above that of (18), (24), or a loop
        Notes
            Without one the polar angle rises over the whole stroke, and the phase angle is above 0.
        Source
            wide-swing dissertation (21), (22), (25); the loop condition: own derivation
        """
        if self._middle_gap < 0.0:
            raise NoSolution(
                f"rocker radius: {unlike(self.rocker_radius, self.nominal_rocker_radius)} mm (limit <= "
                f"{unlike(self.nominal_rocker_radius, self.rocker_radius)} mm, beyond it the pitch curve has a loop)",
                fix=f"omit the rocker radius, or set it to at most {safely_below(self.nominal_rocker_radius)} mm",
            )
        if self.loop_margin <= 0.0:
            raise self._loop(self.loop_margin)

    @cached_property
    def pressing(self) -> tuple[Extreme, Extreme]:
        """Maximum and minimum of the rocker's acceleration |c|/cos delta where the roller touches before k*.

        Raises
            NoSolution - where it touches nothing
        """

        def press(turn: Reals) -> Reals:
            state = self.state_at(turn)
            size = self.cycle_angle**2 / self.law.swing
            found: Reals = size * np.abs(state.bend) / np.cos(state.pressure_angle)
            return found

        most, least = extremes_over([(press, True), (press, False)], *self._touching[0], samples=128)
        return most, least

    @property
    def _touching(self) -> tuple[tuple[float, float], ...]:
        """Angles of the law between which the roller touches the profile, on the sides of k*."""
        (start, end), (before, *after) = self.law.turns, (turn for _, turn in self.contact_ends)
        return ((start, before), *((turn, end) for turn in after))

    @cached_property
    def max_pressure_angle(self) -> float:
        """Largest magnitude of the pressure angle where the roller touches the profile [rad].

        Raises
            NoSolution - where it touches nothing
        Notes
            With a rocker radius below that of (18), (24) the contact lasts to mid-swing, where the angle is 90 deg.
        """
        return max(angle.value for angle, _ in self.tops)

    @cached_property
    def tops(self) -> list[list[Extreme]]:
        """Maximum pressure angle and bulge where the roller touches the profile, of one state of the curve."""
        state = kept_last(self.state_at)
        wanted = [(lambda turn: np.abs(state(turn).pressure_angle), True), (lambda turn: state(turn).bulge, True)]
        return extremes_of_parts(wanted, self._touching, samples=128)


def too_small_swing(swing: float, speed_ratio_peak: float) -> NoSolution:
    """The refusal of a swing whose cam rounding would not distinguish from a circle.

    Parameters
        swing : float [rad]
        speed_ratio_peak : float - below LEAST_SPEED_RATIO, to which it grows with the swing
    Returns
        error : NoSolution - names the minimum swing
    Example
        >>> print(too_small_swing(math.radians(1e-9), 1e-11).fix)
        set swing to at least 1.001e-08 deg
    """
    least = safely_above(math.degrees(swing * LEAST_SPEED_RATIO / speed_ratio_peak))
    return NoSolution(
        (f"swing: {short(math.degrees(swing))} deg, too small to compute a cam with"),
        key="swing",
        fix=f"set swing to at least {least} deg",
    )


def mirrored(w: Points, sense: int) -> Points:
    """From the common form to the layout's own frame."""
    result: Points = w if sense > 0 else -np.conj(w)
    return result


def require_lengths(center_distance: float, roller_radius: float, rocker_radius: float | None = None) -> None:
    """Refuse lengths [mm] that are not positive."""
    lengths = {"centre distance": center_distance, "roller radius": roller_radius}
    if rocker_radius is not None:
        lengths["rocker radius"] = rocker_radius
    for name, value in lengths.items():
        if not 0.0 < value < math.inf:
            raise NoSolution(f"{name}: {value:.4g} mm (limit > 0)")
