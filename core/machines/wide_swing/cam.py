"""The cam of a wide swing that turns evenly: pitch curve, contact with the roller, profile.

With sigma = +1 for the twin-cam (cam and rocker turn against each other) and -1 for the twin-rocker (they turn
together), the signed radius ratio lambda = sigma r/a and rocker angle psi = sigma phi give the pitch curve
w = e^{i theta} (-1 + lambda e^{i psi}); the twin-rocker's is -conj(w).

About mid-swing the pitch curve is a cusp, and all that vanishes there is formed from the products
e = 1 - lambda A with A = 1 + dpsi/dtheta, and s = 1 - cos psi, never from differences.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from typing import Literal, Protocol, TypeAlias

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_above, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short, unlike
from gearlink.core.machines.wide_swing.law import MiddleView
from gearlink.core.numerics.arrays import Points, Reals
from gearlink.core.numerics.extremes import Extreme, extremes_over, maximum_over, minimum_over
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.numerics.roots_sweep import root_between
from gearlink.core.numerics.together import kept_last


class StrokeLaw(Protocol):
    """What a cam needs of the rocker's law of motion; `ElasticLaw` has it."""

    @property
    def swing(self) -> float: ...
    @property
    def velocity_peak(self) -> float: ...
    @property
    def middle_jerk(self) -> float: ...
    def middle_view(self, k: Reals) -> MiddleView: ...

    # by an angle that rises with k, 0 at mid-swing and alike on both sides of it
    @property
    def end_turn(self) -> float: ...
    def view_at(self, turn: Reals) -> MiddleView: ...
    def share_from_middle(self, turn: Reals) -> Reals: ...
    def turn_near(self, share: float) -> float: ...
    def turn_at(self, share: float) -> float: ...


@dataclass(frozen=True, slots=True, eq=False)
class CurveState:
    """The products e, s and the vector g = 1 - lambda A e^{i psi} from which the profile is made.

    k and theta are no numbers where nobody asks for them.
    """

    k: Reals
    theta: Reals
    psi: Reals
    a: Reals  # A = 1 + dpsi/dtheta
    e: Reals
    s: Reals
    second: Reals  # d2 psi/dtheta2


@dataclass(frozen=True, slots=True)
class PitchCurve:
    """Pitch curve, normal, curvature and pressure angle over the stroke, in centre distances.

    Parameters
        law : StrokeLaw - law of motion of the rocker
        cycle_angle : float [rad] - phi_ud, cam angle of the stroke
        sense : int - sigma, +1 twin-cam, -1 twin-rocker
        ratio : float - signed lambda = sigma r/a
        middle_gap : float - e at mid-swing, 0 with the rocker radius of (18), (24)
    Source
        wide-swing dissertation, chapter 3 and (26); curvature and product forms: own derivation
    """

    law: StrokeLaw
    cycle_angle: float
    sense: int
    ratio: float
    middle_gap: float

    def state(self, k: Reals) -> CurveState:
        """The state at fractions k of the stroke."""
        return self.state_of(self.law.middle_view(k), k - 0.5)

    def state_at(self, turn: Reals) -> CurveState:
        """The state at angles of the law, but for where the cam stands: neither pressure angle nor curvature ask it."""
        return self.state_of(self.law.view_at(turn), np.full_like(turn, math.nan))

    def timed_state_at(self, turn: Reals) -> CurveState:
        """The whole state at angles of the law."""
        return self.state_of(self.law.view_at(turn), self.law.share_from_middle(turn))

    def state_of(self, view: MiddleView, share: Reals) -> CurveState:
        """The state of a view of the law at k - 1/2."""
        speed_ratio = self.law.swing / self.cycle_angle
        turn = self.sense * speed_ratio
        return CurveState(
            k=0.5 + share,
            theta=share * self.cycle_angle,
            psi=self.sense * view.angle,
            a=1.0 + turn * view.velocity,
            e=self.middle_gap + abs(self.ratio) * speed_ratio * view.deficit,
            s=2.0 * np.sin(0.5 * view.angle) ** 2,
            second=self.sense * self.law.swing / self.cycle_angle**2 * view.acceleration,
        )

    def correction(self, state: CurveState) -> Reals:
        """beta, polar angle of the roller centre against the centre line."""
        ratio = self.ratio
        return np.arctan2(ratio * np.sin(state.psi), (1.0 - ratio) + ratio * state.s)

    def pitch(self, state: CurveState) -> Points:
        """w, the roller centre in the cam's frame."""
        ratio = self.ratio
        arm = -((1.0 - ratio) + ratio * state.s) + 1j * ratio * np.sin(state.psi)
        result: Points = np.exp(1j * state.theta) * arm
        return result

    def gradient(self, state: CurveState) -> Points:
        """g = 1 - lambda A e^{i psi}, along the inward normal in the centre line's frame."""
        pull = self.ratio * state.a
        result: Points = (state.e + pull * state.s) - 1j * pull * np.sin(state.psi)
        return result

    def normal(self, state: CurveState) -> Points:
        """Unit normal with an inward radial part; at the cusp the limit of the run-up."""
        g = self.gradient(state)
        size = np.abs(g)
        cusp = size == 0.0
        unit = g / np.where(cusp, 1.0, size) + np.where(cusp, 1j * self.sense, 0.0)
        result: Points = np.exp(1j * state.theta) * unit
        return result

    def curvature(self, state: CurveState) -> Reals:
        """Curvature times centre distance, positive with the centre towards the cam axis, infinite at the cusp."""
        ratio, a = self.ratio, state.a
        turn = state.e * (1.0 - ratio * a * a) + state.s * ratio * a * (1.0 + a)
        turn = turn - ratio * state.second * np.sin(state.psi)
        size = np.abs(self.gradient(state)) ** 3
        cusp = size == 0.0
        return np.where(cusp, self.sense * math.inf, turn / np.where(cusp, 1.0, size))

    def pressure_angle(self, state: CurveState) -> Reals:
        """delta from tan delta = (lambda A - cos phi)/sin phi."""
        sine = np.sin(self.sense * state.psi)
        return np.arctan2((state.s - state.e) * np.where(sine < 0.0, -1.0, 1.0), np.abs(sine))

    def acceleration(self, state: CurveState) -> Reals:
        """|c| of the law."""
        return np.asarray(np.abs(state.second) * self.cycle_angle**2 / self.law.swing)

    def loop_measure(self, state: CurveState) -> Reals:
        """(dTheta/dtheta) rho^2/(1 - cos phi) = (1 - lambda) e/s + lambda (1 + A), away from mid-swing."""
        result: Reals = (1.0 - self.ratio) * state.e / state.s + self.ratio * (1.0 + state.a)
        return result


# Contact of a wide-swing roller about mid-swing: its exact end, and the dissertation's estimates of curvature


Step: TypeAlias = Callable[["Reals"], tuple["Reals", "Reals"]]

SMALLEST = 1e-4
"""Below this share of the stroke the leading order, good to the square of the zone, is nearer than the solution."""
SHRINK = 0.7
_SETTLED = 1e-13
_BESIDE = 0.01
"""Share of the way to mid-swing below which a step is too short to tell the bend between its ends."""
_KNOWN = 1e-16
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
        return _room(step(t), roller_radius)

    nearest = min(SHRINK * far, 0.01 * estimate)
    t: Reals = np.float64(far) * np.power(SHRINK, np.arange(math.ceil(math.log(nearest / far, SHRINK)) + 1))
    room = clearance(t)
    if room[0] <= 0.0:
        most = fitting_roller(*(float(part[0]) for part in step(t[:1])))
        raise NoSolution(
            f"roller radius: {unlike(roller_radius, most)} mm (limit < {unlike(most, roller_radius)} mm, where the "
            "roller at rest covers the whole profile)",
            fix=f"set cam.roller_radius below {safely_below(most)} mm, or raise cam.center_distance",
        )
    within = np.flatnonzero(room < 0.0)
    if not within.size:
        return 0.0
    (low, high), ends = (rows[[within[0], within[0] - 1]].tolist() for rows in (t, room))
    if not noise:
        return root_between(clearance, low, high, tolerance=_KNOWN)
    # of the places that rounding takes for roots the last one is found as before: a curvature beside it has no bound
    known = _KNOWN + noise / low
    return bracketed_root(lambda part: float(clearance(np.array([part]))[0]), low, high, tolerance=known, ends=ends)


def fitting_roller(length: float, depth: float) -> float:
    """Radius of the roller that is just free of the profile after a step from its stop [mm]; infinite where all are.

    r_p = |d|^2/(-2 d n)

    Parameters
        length, depth : float [mm] - |d| and -d n of the step
    """
    return length * length / (2.0 * depth) if depth > 0.0 else math.inf


def contact_end(cam: WideSwingCam) -> float:
    """Fraction of the stroke of `end_of_contact`."""
    return end_of_contact(cam)[0]


def end_of_contact(cam: WideSwingCam) -> tuple[float, float]:
    """Fraction of the stroke where the roller leaves the profile, whose rest its slot at mid-swing has cut away.

    Parameters
        cam : WideSwingCam
    Returns
        k : float - at most 1/2; the mirror image 1 - k is where contact begins again
        turn : float - the angle of the law there
    Raises
        NoSolution - where the roller at mid-swing covers the start of the profile, or the pitch curve has a loop
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
        return 0.5 - estimate, law.turn_at(-estimate)
    turn = covered(partial(step_before_middle, cam), cam.roller_radius, law.end_turn, law.turn_near(estimate))
    end = 0.5 + float(law.share_from_middle(np.array([-turn]))[0])
    if smooth and turn > 0.0:
        end = _cut_on_the_way(cam, end)
        turn = -law.turn_at(end - 0.5)
    return end, -turn


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
        cam : WideSwingCam
        k : float - below 1/2
    Returns
        r_p : float [mm] - infinite where every roller does
    """
    here = cam.curve.state(np.array([k]))
    place, normal = cam.curve.pitch(here)[0], cam.sense * np.conj(cam.curve.normal(here)[0])

    def needed(part: Reals) -> Reals:
        step = place - cam.curve.pitch(cam.curve.state(k + (0.5 - k) * part))
        found: Reals = -2.0 * (step * normal).real / np.abs(step) ** 2
        return found

    bend = maximum_over(needed, _BESIDE, 1.0, samples=256).value
    return cam.center_distance / bend if bend > 0.0 else math.inf


def middle_step(cam: WideSwingCam, t: Reals) -> tuple[Reals, Reals]:
    """Lengths of the pitch point's steps to mid-swing from t before it, and their parts along the profile's normal
    [mm]."""
    return _step_to_middle(cam, cam.curve.state(0.5 - t))


def step_before_middle(cam: WideSwingCam, turn: Reals) -> tuple[Reals, Reals]:
    """The same from angles of the law before mid-swing."""
    return _step_to_middle(cam, cam.curve.timed_state_at(-turn))


def room_before_middle(cam: WideSwingCam, turn: Reals) -> Reals:
    """How far the profile at angles of the law before mid-swing is from the roller there: |d|^2 + 2 r_p d n [mm^2]."""
    return _room(step_before_middle(cam, turn), cam.roller_radius)


def _room(step: tuple[Reals, Reals], roller_radius: float) -> Reals:
    length, depth = step
    room: Reals = length * length - 2.0 * roller_radius * depth
    return room


def _step_to_middle(cam: WideSwingCam, state: CurveState) -> tuple[Reals, Reals]:
    # z(k) - z(1/2) in terms that vanish at mid-swing, each of them exact
    half = np.exp(0.5j * state.theta)
    turned = -2j * np.sin(0.5 * state.theta) * half * (1.0 - cam.ratio)
    step = turned + cam.ratio * half * half * (1j * np.sin(state.psi) - state.s)
    size = cam.center_distance
    return size * np.abs(step), -size * cam.sense * (step * np.conj(cam.curve.normal(state))).real


def start_radius_estimate(cam: WideSwingCam, k: float = 0.1) -> float:
    """The dissertation's estimate of the curvature radius at the start of the stroke.

    R = (rho0^2 + rho1^2 - 2 rho0 rho1 cos M)/(2 (rho0 - rho1 cos M)), M = Theta(k) - Theta(0)

    Parameters
        cam : WideSwingCam
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
        cam : WideSwingCam
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


@dataclass(frozen=True)
class WideSwingCam:
    """One cam of a twin-cam or twin-rocker mechanism; every property is computed when it is read.

    r = a/(B alpha + 1) external, a/(B alpha - 1) internal, alpha = gamma/phi_ud

    Parameters
        layout : "twin-cam" (external profile) or "twin-rocker" (internal profile)
        law : StrokeLaw - law of motion of the rocker
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
        _require_lengths(self.center_distance, self.roller_radius, self.given_rocker_radius)
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
                (
                    f"peak speed of the rocker over that of the cam: {unlike(self.speed_ratio_peak, 1.0)} (limit > 1 "
                    "for a twin-rocker)"
                ),
                fix=(
                    f"reduce {self.angle_words} to at most {safely_below(0.5 * limit)} deg (possible below "
                    f"{safely_below(limit)} deg), or increase the swing"
                ),
            )

    @property
    def sense(self) -> int:
        """sigma: +1 where cam and rocker turn against each other (twin-cam), -1 where together (twin-rocker)."""
        return 1 if self.layout == "twin-cam" else -1

    @property
    def speed_ratio(self) -> float:
        """alpha = gamma/phi_ud, mean speed of the rocker over the cam's."""
        return self.law.swing / self.cycle_angle

    @property
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

    @cached_property
    def curve(self) -> PitchCurve:
        """The pitch curve in centre distances."""
        return PitchCurve(self.law, self.cycle_angle, self.sense, self.ratio, self._middle_gap)

    @cached_property
    def middle_radius(self) -> float:
        """Pitch radius at mid-swing, a - r external, a + r internal [mm]."""
        return abs(1.0 - self.ratio) * self.center_distance

    @cached_property
    def end_radius(self) -> float:
        """Pitch radius at the ends of the stroke [mm] (dissertation (20))."""
        half = self.ratio * math.sin(0.5 * self.law.swing)
        return self.center_distance * math.hypot(1.0 - self.ratio * math.cos(0.5 * self.law.swing), half)

    @property
    def min_radius(self) -> float:
        """Minimum pitch radius [mm]."""
        return min(self.middle_radius, self.end_radius)

    @property
    def max_radius(self) -> float:
        """Largest pitch radius [mm]."""
        return max(self.middle_radius, self.end_radius)

    @cached_property
    def profile_correction(self) -> float:
        """xi at the end of the stroke, polar angle of the roller against the centre line [rad] ((19), (25))."""
        half = 0.5 * self.law.swing
        ratio = abs(self.ratio)
        return math.atan2(ratio * math.sin(half), 1.0 - self.ratio * math.cos(half))

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
        curvature = float(self.curve.curvature(self.curve.state(np.zeros(1)))[0])
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
        """Parts of the stroke in which the roller touches the profile.

        Raises
            NoSolution - for a profile that does not exist, or where the roller at mid-swing covers its start
        """
        end, _ = self.contact_end
        return (0.0, end), (1.0 - end, 1.0)

    @cached_property
    def contact_end(self) -> tuple[float, float]:
        """Where the roller leaves the profile before mid-swing: fraction of the stroke, and angle of the law."""
        self.require_profile()
        return end_of_contact(self)

    @cached_property
    def transition_zone(self) -> float:
        """Part of the stroke each side of mid-swing where the roller, in its slot, has left the profile.

        Raises
            NoSolution - for a profile that does not exist
        Notes
            1/2 where the roller at mid-swing covers the profile of the whole run-up.
        """
        self.require_profile()
        try:
            return 0.5 - self.contact[0][1]
        except NoSolution:
            return 0.5

    def largest_roller(self, zone: float) -> float:
        """Radius of the roller whose transition zone is a given share of the stroke [mm]."""
        most = fitting_roller(*(float(part[0]) for part in middle_step(self, np.array([zone]))))
        return most if self._middle_gap == 0.0 else min(most, roller_before_middle(self, 0.5 - zone))

    @cached_property
    def loop_margin(self) -> float:
        """Minimum of (dTheta/dtheta) rho^2/(1 - cos phi) over the stroke: the profile exists where it is positive.

        h = (1 - lambda) e/s + lambda (1 + A), at mid-swing 6 q lambda^2/rho_mid
        """
        if self._middle_gap != 0.0:
            return math.inf if self._middle_gap > 0.0 else -math.inf
        return min(self.least_loop_measure, 6.0 * self.cusp[1] * self.ratio**2 / self.middle_radius)

    @cached_property
    def least_loop_measure(self) -> float:
        """Minimum of it before mid-swing; nearer than a thousandth it is as good as that at mid-swing."""
        curve, end = self.curve, self.law.end_turn
        return minimum_over(lambda turn: curve.loop_measure(curve.state_at(turn)), -end, -1e-3 * end, samples=256).value

    def _loop(self, value: float) -> NoSolution:
        safe = math.degrees(0.5 * self.law.velocity_peak * self.law.swing)
        fix = f"reduce {self.angle_words} to {safely_below(safe)} deg or less"
        return NoSolution(f"the pitch curve has a loop at mid-swing (measure {short(value)}, limit > 0)", fix=fix)

    def require_profile(self) -> None:
        """Refuse a profile that does not exist.

        Raises
            NoSolution - for a rocker radius above that of (18), (24), a loop, or a phase angle that is not positive
        Source
            wide-swing dissertation (21), (22), (25); the loop condition: own derivation
        """
        if self._middle_gap < 0.0:
            raise NoSolution(
                (
                    f"rocker radius: {unlike(self.rocker_radius, self.nominal_rocker_radius)} mm (limit <= "
                    f"{unlike(self.nominal_rocker_radius, self.rocker_radius)} mm, beyond it the pitch curve has a "
                    "loop)"
                ),
                fix=f"omit the rocker radius, or set it to at most {safely_below(self.nominal_rocker_radius)} mm",
            )
        if self.loop_margin <= 0.0:
            raise self._loop(self.loop_margin)
        if self.phase_angle <= 0.0:
            raise NoSolution(
                f"phase angle {math.degrees(self.phase_angle):.4g} deg of the run-up is not above 0",
                fix=(
                    f"increase {self.angle_words} above {safely_above(math.degrees(2.0 * self.profile_correction))} deg"
                ),
            )

    @cached_property
    def pressing(self) -> tuple[Extreme, Extreme]:
        """Maximum and minimum of the rocker's acceleration |c|/cos delta where the roller touches the profile.

        Raises
            NoSolution - where it touches nothing
        """
        curve = self.curve

        def press(turn: Reals) -> Reals:
            state = curve.state_at(turn)
            found: Reals = curve.acceleration(state) / np.cos(curve.pressure_angle(state))
            return found

        most, least = extremes_over([(press, True), (press, False)], *self._touching, samples=128)
        return most, least

    @property
    def _touching(self) -> tuple[float, float]:
        """Angles of the law before mid-swing between which the roller touches the profile."""
        return -self.law.end_turn, self.contact_end[1]

    @cached_property
    def max_pressure_angle(self) -> float:
        """Largest magnitude of the pressure angle where the roller touches the profile [rad].

        Raises
            NoSolution - where it touches nothing
        Notes
            With a rocker radius below that of (18), (24) the contact lasts to mid-swing, where the angle is 90 deg.
        """
        return self.tops[0].value

    @cached_property
    def tops(self) -> list[Extreme]:
        """Maximum pressure angle and bulge where the roller touches the profile, of one state of the curve."""
        state = kept_last(self.curve.state_at)
        wanted = [
            (lambda turn: np.abs(self.curve.pressure_angle(state(turn))), True),
            (lambda turn: self._bulge(state(turn)), True),
        ]
        return extremes_over(wanted, *self._touching, samples=128)

    def pressure_angle(self, k: Reals) -> Reals:
        """Pressure angle at fractions k < 1/2 of the stroke [rad], of the pitch curve even where it has a loop.

        tan delta = (lambda A - cos phi)/sin phi
        """
        return self.curve.pressure_angle(self.curve.state(k))

    @cached_property
    def min_curvature_radius(self) -> float:
        """Minimum radius of the pitch curve where it bulges from the body and the roller touches it [mm].

        Raises
            NoSolution - where it touches nothing
        Notes
            In the transition zone the radius falls to zero at mid-swing whatever the design. Infinite where the
            curve bulges nowhere outside it.
        """
        peak = self.tops[1].value
        return 1.0 / peak if peak > 0.0 else math.inf

    def bulge(self, k: Reals) -> Reals:
        """Curvature of the pitch curve [1/mm], positive where it bulges from the body."""
        return self._bulge(self.curve.state(k))

    def _bulge(self, state: CurveState) -> Reals:
        curvature: Reals = self.sense / self.center_distance * self.curve.curvature(state)
        return curvature

    def points(self, k: Reals) -> CamPoints:
        """Pitch curve, profile, pressure angle and curvature at given fractions of the stroke.

        z = e^{i theta}(-1 + lambda e^{i phi}), tan delta = (lambda A - cos phi)/sin phi
        R = |1 - lambda A e^{i phi}|^3/(1 - lambda A (1 + A) cos phi + lambda^2 A^3 - lambda phi'' sin phi)

        Parameters
            k : (N,) array - fractions of the stroke, 0 to 1
        Returns
            points : CamPoints
        Raises
            NoSolution - for k outside 0 to 1, or a profile that does not exist
        Notes
            The body lies inside an external and outside an internal profile. k = 1/2 is taken as the end of the
            run-up. The profile points between the two parts of `contact` are cut away by the slot that the
            roller needs at mid-swing. The curvature keeps a relative accuracy of about 1e-13 up to the cusp itself.
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
        state = self.curve.state(np.asarray(k, dtype=np.float64))
        pitch = self.curve.pitch(state)
        profile = pitch + self.sense * self.roller_radius / self.center_distance * self.curve.normal(state)
        curvature, place = self.curve.curvature(state), self.center_distance
        with np.errstate(divide="ignore"):
            radius = self.center_distance / curvature
        return CamPoints(
            k=state.k,
            cam_angle=state.theta,
            polar_angle=state.theta - self.curve.correction(state),
            pitch=place * _mirrored(pitch, self.sense),
            profile=place * _mirrored(profile, self.sense),
            pressure_angle=self.curve.pressure_angle(state),
            curvature_radius=radius,
        )


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


def _mirrored(w: Points, sense: int) -> Points:
    """From the common form to the layout's own frame."""
    result: Points = w if sense > 0 else -np.conj(w)
    return result


def _require_lengths(center_distance: float, roller_radius: float, rocker_radius: float | None) -> None:
    lengths = {"centre distance": center_distance, "roller radius": roller_radius}
    if rocker_radius is not None:
        lengths["rocker radius"] = rocker_radius
    for name, value in lengths.items():
        if not 0.0 < value < math.inf:
            raise NoSolution(f"{name}: {value:.4g} mm (limit > 0)")
