"""Pitch curve of a wide-swing cam in lengths of the centre distance, for both layouts by one set of formulas.

With sigma = +1 for the twin-cam (cam and rocker turn against each other) and -1 for the twin-rocker (they turn
together), the signed radius ratio lambda = sigma r/a and rocker angle psi = sigma phi give the pitch curve
w = e^{i theta} (-1 + lambda e^{i psi}); the twin-rocker's is -conj(w).

About mid-swing the pitch curve is a cusp, and all that vanishes there is formed from the products
e = 1 - lambda A with A = 1 + dpsi/dtheta, and s = 1 - cos psi, never from differences.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from gearlink.core.machines.wide_swing.law.elastic_law import MiddleView
from gearlink.core.numerics.arrays import Points, Reals


class StrokeLaw(Protocol):
    """What a cam needs of the rocker's law of motion; `ElasticLaw` has it."""

    @property
    def swing(self) -> float: ...
    @property
    def velocity_peak(self) -> float: ...
    @property
    def middle_jerk(self) -> float: ...
    def middle_view(self, k: Reals) -> MiddleView: ...


@dataclass(frozen=True, slots=True, eq=False)
class CurveState:
    """The products e, s and the vector g = 1 - lambda A e^{i psi} from which the profile is made."""

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
        view = self.law.middle_view(k)
        speed_ratio = self.law.swing / self.cycle_angle
        turn = self.sense * speed_ratio
        return CurveState(
            k=k,
            theta=(k - 0.5) * self.cycle_angle,
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

    def loop_measure(self, state: CurveState) -> Reals:
        """(dTheta/dtheta) rho^2/(1 - cos phi) = (1 - lambda) e/s + lambda (1 + A), away from mid-swing."""
        result: Reals = (1.0 - self.ratio) * state.e / state.s + self.ratio * (1.0 + state.a)
        return result
