"""External cam of a wide-swing rocker that drives a slider: a law without symmetry, as two half strokes.

The roller's arm is set so that the roller passes the line of centres where the rocker is fastest, at k*: then, as with
a symmetric law, it passes the velocity pole there without pressure angle, and the pitch curve has its cusp. Run-up and
run-out are each half of a symmetric stroke of their own, with the same rocker radius.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlink.core.base.results import cached_property
from gearlink.core.machines.wide_swing.cams.cam import CamPoints, WideSwingCam
from gearlink.core.machines.wide_swing.law.elastic_law import MiddleView
from gearlink.core.machines.wide_swing.slider import SliderLaw
from gearlink.core.numerics.arrays import Mask, Points, Reals
from gearlink.core.numerics.roots import bracketed_root

_GAUSS = np.polynomial.legendre.leggauss(12)
_NEAR = 0.05
_STEP = 1e-4  # of the stroke, for the jerk at k*, which only starts a search


@dataclass(frozen=True)
class HalfLaw:
    """Run-up or run-out of a law without symmetry, as half of a symmetric one; a law of motion for `WideSwingCam`.

    Parameters
        law : SliderLaw
        place : float - k*, where the rocker is fastest
        late : bool - the run-out, taken backwards in time
    """

    law: SliderLaw
    place: float
    late: bool

    @property
    def span(self) -> float:
        """Fractions of the real stroke in one of this law's: 2 k* or 2 (1 - k*)."""
        return 2.0 * ((1.0 - self.place) if self.late else self.place)

    @cached_property
    def fastest(self) -> float:
        """Displacement invariant at k*."""
        return float(self.law.invariants(np.array([self.place]), 0)[0][0])

    @cached_property
    def swing(self) -> float:
        """Twice the rocker's angle from k* to its end of the stroke [rad]."""
        return 2.0 * self.law.swing * ((1.0 - self.fastest) if self.late else self.fastest)

    @property
    def _scale(self) -> float:
        return self.law.swing / self.swing

    @property
    def velocity_peak(self) -> float:
        """B of this half."""
        return self.law.velocity_peak * self.span * self._scale

    @cached_property
    def middle_jerk(self) -> float:
        """dc/dk at k* of this half, negative."""
        places = np.array([self.place - _STEP, self.place + _STEP])
        before, after = (float(c) for c in self.law.invariants(places, 2)[2])
        return (after - before) / (2.0 * _STEP) * self.span**3 * self._scale

    def middle_view(self, k: Reals) -> MiddleView:
        """The motion seen from k*, over fractions of this half's symmetric stroke.

        Notes
            B - b is the integral of the acceleration, whose error is some ulp of its peak: beside k* the deficit keeps
            1e-15/|k - 1/2| of itself.
        """
        k = np.asarray(k, dtype=np.float64)
        second, folded = k > 0.5, np.where(k > 0.5, 1.0 - k, k)
        side = -1.0 if self.late else 1.0
        real = 1.0 - folded * self.span if self.late else folded * self.span
        a, b, c = self.law.invariants(real, 2)
        angle = side * self.law.swing * (a - self.fastest)
        sign = np.where(second, -1.0, 1.0)
        return MiddleView(
            sign * angle,
            self.span * self._scale * b,
            self.span * self._scale * self._deficit(real, b),
            sign * side * self.span**2 * self._scale * c,
        )

    def _deficit(self, real: Reals, velocity: Reals) -> Reals:
        """B - b of the real law; near k* as the integral of its acceleration up to there."""
        found = np.asarray(self.law.velocity_peak - velocity)
        near = np.abs(self.place - real) <= _NEAR
        if near.any():
            at = real[near]
            nodes, weights = _GAUSS
            half = 0.5 * (self.place - at)
            places = (0.5 * (self.place + at))[:, None] + half[:, None] * nodes
            acceleration = self.law.invariants(np.clip(places, 0.0, 1.0).ravel(), 2)[2].reshape(places.shape)
            found[near] = half * np.sum(acceleration * weights, axis=1)
        return found


@dataclass(frozen=True)
class SliderCam:
    """One cam of a twin-cam mechanism whose rocker drives a slider.

    r = a/(1 + B alpha), the roller on the line of centres at k*, where b = B

    Parameters
        law : SliderLaw
        cycle_angle : float [rad] - phi_ud, cam angle of the stroke
        center_distance, roller_radius : float [mm] - a, r_p
    Raises
        NoSolution - as `WideSwingCam`
    Notes
        The return stroke runs the same law backwards: the same cam, turning the other way, serves it.
    Example
        >>> import math
        >>> from gearlink.core.machines.wide_swing.law.elastic_law import Pneumatic
        >>> from gearlink.core.machines.wide_swing.slider import SliderDrive
        >>> law = SliderLaw(Pneumatic(2.5), math.radians(120), SliderDrive(1.0, 3.0, math.pi / 2), 0.3)
        >>> cam = SliderCam(law, math.radians(150), 200.0, 8.0)
        >>> round(cam.middle, 9)
        0.690248221
    """

    law: SliderLaw
    cycle_angle: float
    center_distance: float
    roller_radius: float
    sense = 1

    @cached_property
    def middle(self) -> float:
        """k*, where the rocker is fastest and the roller on the line of centres."""
        k = np.linspace(0.0, 1.0, 257)
        top = int(np.argmax(self.law.invariants(k, 1)[1]))

        def acceleration(at: float) -> float:
            return float(self.law.invariants(np.array([at]), 2)[2][0])

        return bracketed_root(acceleration, float(k[max(top - 1, 0)]), float(k[min(top + 1, 256)]))

    @cached_property
    def halves(self) -> tuple[WideSwingCam, WideSwingCam]:
        """The symmetric cams of which run-up and run-out are halves."""
        made = [HalfLaw(self.law, self.middle, late) for late in (False, True)]
        return tuple(  # type: ignore[return-value]
            WideSwingCam("twin-cam", law, law.span * self.cycle_angle, self.center_distance, self.roller_radius)
            for law in made
        )

    @property
    def _spans(self) -> tuple[float, float]:
        return 2.0 * self.middle, 2.0 * (1.0 - self.middle)

    @property
    def arm_offset(self) -> float:
        """Rocker angle from mid-swing at which the roller passes the line of centres [rad]."""
        return self.law.swing * (HalfLaw(self.law, self.middle, False).fastest - 0.5)

    @property
    def rocker_radius(self) -> float:
        """r [mm]; the same for both halves."""
        return self.halves[0].rocker_radius

    @property
    def middle_radius(self) -> float:
        """Pitch radius on the line of centres [mm]."""
        return self.halves[0].middle_radius

    @property
    def end_radius(self) -> float:
        """The greater of the pitch radii at the ends of the stroke [mm]."""
        return max(half.end_radius for half in self.halves)

    @property
    def min_radius(self) -> float:
        """Minimum pitch radius [mm]."""
        return min(half.min_radius for half in self.halves)

    @property
    def max_radius(self) -> float:
        """Largest pitch radius [mm]."""
        return max(half.max_radius for half in self.halves)

    @property
    def loop_margin(self) -> float:
        """The lesser margin of both halves."""
        return min(half.loop_margin for half in self.halves)

    def require_profile(self) -> None:
        """Refuse a profile of which a half does not exist.

        Raises
            NoSolution
        """
        for half in self.halves:
            half.require_profile()

    @property
    def contact(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Parts of the stroke in which the roller touches the profile."""
        before, after = (half.contact[0][1] * span for half, span in zip(self.halves, self._spans, strict=True))
        return (0.0, before), (1.0 - after, 1.0)

    @property
    def transition_zone(self) -> float:
        """Part of the stroke beside k*, on its wider side, where the roller has left the profile in its slot.

        Notes
            1/2 where it covers the profile of a whole half.
        """
        zones = [half.transition_zone for half in self.halves]
        if 0.5 in zones:
            return 0.5
        return max(zone * span for zone, span in zip(zones, self._spans, strict=True))

    @property
    def transition_zone_estimate(self) -> float:
        """`transition_zone` to leading order."""
        pairs = zip(self.halves, self._spans, strict=True)
        return max(half.transition_zone_estimate * span for half, span in pairs)

    def largest_roller(self, zone: float) -> float:
        """Radius of the roller whose transition zone is a given share of the stroke [mm]."""
        pairs = zip(self.halves, self._spans, strict=True)
        return min(half.largest_roller(min(0.49, zone / span)) for half, span in pairs)

    @property
    def max_pressure_angle(self) -> float:
        """Largest magnitude of the pressure angle where the roller touches the profile [rad]."""
        return max(half.max_pressure_angle for half in self.halves)

    @property
    def min_curvature_radius(self) -> float:
        """Minimum radius of the pitch curve where it bulges and the roller touches it [mm]."""
        return min(half.min_curvature_radius for half in self.halves)

    def split(self, k: Reals) -> tuple[tuple[WideSwingCam, Mask, Reals], ...]:
        """Each half with the rows that are its own, and their fractions of its symmetric stroke."""
        early = k <= self.middle
        first, second = self._spans
        return (self.halves[0], early, k / first), (self.halves[1], ~early, (1.0 - k) / second)

    def pressure_angle(self, k: Reals) -> Reals:
        """Pressure angle at fractions of the stroke [rad], in the sign of `WideSwingCam`."""
        found = np.empty_like(k)
        for number, (half, rows, own) in enumerate(self.split(k)):
            found[rows] = (-1.0 if number else 1.0) * half.pressure_angle(own[rows])
        return found

    def bulge(self, k: Reals) -> Reals:
        """Curvature of the pitch curve [1/mm], positive where it bulges from the body."""
        found = np.empty_like(k)
        for half, rows, own in self.split(k):
            found[rows] = half.bulge(own[rows])
        return found

    def points(self, k: Reals) -> CamPoints:
        """Pitch curve, profile, pressure angle and curvature at fractions of the stroke; as `WideSwingCam.points`.

        Raises
            NoSolution - for a profile of which a half does not exist
        """
        k = np.asarray(k, dtype=np.float64)
        real = {name: np.empty_like(k) for name in ("cam_angle", "polar_angle", "pressure_angle", "curvature_radius")}
        pitch: Points = np.empty(k.shape, dtype=np.complex128)
        profile: Points = np.empty(k.shape, dtype=np.complex128)
        for number, (half, rows, own) in enumerate(self.split(k)):
            at = half.points(own[rows])
            side = -1.0 if number else 1.0
            pitch[rows] = at.pitch.conj() if number else at.pitch
            profile[rows] = at.profile.conj() if number else at.profile
            for name, column in real.items():
                sign = 1.0 if name == "curvature_radius" else side
                column[rows] = sign * getattr(at, name)
        return CamPoints(k=k, pitch=pitch, profile=profile, **real)
