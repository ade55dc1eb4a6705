"""The lobed disc of a cycloidal reducer: profile, levers and gaps at the pins, and how forces share among them.

u is the angle from the eccentric's direction to a pin, Q = sqrt(1 + K^2 - 2 K cos u), K = e Z/R. All common normals
pass through the pitch point, e Z from the ring's centre on the line of the eccentricity.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from gearlink.core.numerics.arrays import Points, Reals, units

TURN = 2.0 * math.pi
_IDLE = 1e-12
"""Sine of u below which a pin stands on the line of the eccentricity, where it carries nothing."""


def deep(value: Any) -> Any:
    """A number, or a column of them with an axis more: one for the pins."""
    return value[..., None] if isinstance(value, np.ndarray) else value


class Shares(NamedTuple):
    """Forces at some angles of the eccentric, per N mm of the torque on a disc; the last axis is that of the pins.

    Fields
        pins, normals, places : (N, Z) arrays [1/mm], unit vectors from the pin, contact points [mm], in the frame whose
            x axis is the eccentric's direction
        outputs : (N, n) array [1/mm] - of the output pins, empty where there are none
    """

    pins: Reals
    normals: Points
    places: Points
    outputs: Reals

    @property
    def of_ring(self) -> Points:
        """Resultant of the ring pins on the disc, which acts at the pitch point."""
        return np.asarray(np.sum(self.pins * self.normals, axis=-1))


@dataclass(frozen=True)
class Disc:
    """A disc and its ring.

    Fields
        pins : int - Z of the ring; lobes are one less
        circle, pin, eccentricity : float [mm] - R, r_p, e; columns (K, 1) for a row of results for each disc
    Source
        thesis 2.2.2 II; own derivation
    """

    pins: int
    circle: float
    pin: float
    eccentricity: float

    @property
    def lobes(self) -> int:
        """z = Z - 1."""
        return self.pins - 1

    @property
    def deepened(self) -> Disc:
        """The same for angles whose last axis is that of the pins."""
        return replace(self, circle=deep(self.circle), pin=deep(self.pin), eccentricity=deep(self.eccentricity))

    @cached_property
    def shortening(self) -> float:
        """K = e Z/R."""
        return self.eccentricity * self.pins / self.circle

    @property
    def pitch_radius(self) -> float:
        """Radius of the circle that rolls in that of the ring, e z [mm]."""
        return self.eccentricity * self.lobes

    def q(self, u: Reals) -> Reals:
        """Q = sqrt(1 + K^2 - 2 K cos u), as (1 - K)^2 + 4 K sin^2(u/2) without cancellation."""
        k = self.shortening
        return np.sqrt((1.0 - k) ** 2 + 4.0 * k * np.sin(0.5 * u) ** 2)

    def curvature(self, u: Reals) -> Reals:
        """Curvature of the pitch curve, convex positive [1/mm]: (1 + Z K^2 - (Z + 1) K cos u)/(R Q^3)."""
        k, count = self.shortening, self.pins
        above = (1.0 - k) * (1.0 - count * k) + 2.0 * (count + 1) * k * np.sin(0.5 * u) ** 2
        return np.asarray(above / (self.circle * self.q(u) ** 3))

    @cached_property
    def min_convex_radius(self) -> float:
        """Minimum convex radius of curvature of the pitch curve [mm].

        K > (Z - 2)/(2 Z - 1):  R sqrt(27 (1 - K^2)(Z - 1)/(Z + 1)^3);  else  R (1 + K)^2/(1 + Z K)
        """
        k, count = self.shortening, self.pins
        if k > (count - 2) / (2 * count - 1):
            return self.circle * math.sqrt(27.0 * (1.0 - k * k) * (count - 1) / (count + 1) ** 3)
        return self.circle * (1.0 + k) ** 2 / (1.0 + count * k)

    def profile(self, tau: Reals) -> tuple[Points, Reals]:
        """Points of the profile in the disc's frame and radius of curvature there [mm]; infinite where straight.

        P = R e^(i tau) - e e^(i Z tau),  C = P - r_p n,  n = -i P'/|P'|;  rho - r_p

        Parameters
            tau : (N,) array [rad] - 0 to 2 pi
        """
        once, often = units(tau), units(self.pins * tau)
        pitch = self.circle * once - self.eccentricity * often
        rate = 1j * (self.circle * once - self.eccentricity * self.pins * often)
        normal = -1j * rate / np.abs(rate)
        bend = self.curvature(self.lobes * tau)
        with np.errstate(divide="ignore"):
            radius = np.where(bend == 0.0, np.inf, 1.0 / bend - self.pin)
        return np.asarray(pitch - self.pin * normal), radius

    def ground(self, offset: float, pin_circle: float) -> Disc:
        """The disc as it is ground for other pins."""
        return replace(self, circle=self.circle + pin_circle, pin=self.pin + offset)

    def lever(self, u: Reals) -> Reals:
        """Lever of a pin's normal about the disc's centre [mm], positive where it pushes: e z sin u/Q."""
        return np.asarray(self.pitch_radius * np.sin(u) / self.q(u))

    def gap(self, u: Reals, offset: float, pin_circle: float) -> Reals:
        """Gap along the normal between a pin and a disc ground otherwise [mm]: dr - dR (1 - K cos u)/Q."""
        return np.asarray(offset - pin_circle * (1.0 - self.shortening * np.cos(u)) / self.q(u))

    def shares(self, phi: Reals, outputs: int = 0, output_circle: float = 1.0) -> Shares:
        """How the torque of a disc shares among the pins that push, those of equal stiffness.

        F_j = l_j/sum l^2,  Q_k = sin g_k/(R_w sum sin^2 g);  g as u of the output pins

        Parameters
            phi : (N,) array [rad] - angles of the eccentric, a ring pin and an output pin at 0
        """
        disc = self.deepened
        u = (TURN / self.pins) * np.arange(self.pins) - phi[..., None]
        lever = np.where(np.sin(u) > _IDLE, disc.lever(u), 0.0)
        pin = disc.circle * units(u)
        way = disc.eccentricity * self.pins - pin
        normal = way / np.abs(way)
        g = (TURN / max(outputs, 1)) * np.arange(outputs) - phi[..., None]
        side = np.where(np.sin(g) > _IDLE, np.sin(g), 0.0)
        found = side if outputs == 0 else side / (deep(output_circle) * np.sum(side**2, axis=-1, keepdims=True))
        share = lever / np.sum(lever**2, axis=-1, keepdims=True)
        return Shares(share, np.asarray(normal), np.asarray(pin + disc.pin * normal), found)
