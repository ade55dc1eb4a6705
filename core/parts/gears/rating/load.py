"""What a gear pair carries, and of what it is made: inputs of the rating."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple


@dataclass(frozen=True, kw_only=True)
class Factors:
    """The K factors of ISO 6336, 1 unless given, or computed by `rated`.

    Fields
        application, distribution, dynamic : K_A, K_gamma, K_v
        face_contact, transverse_contact : K_Hbeta, K_Halpha
        face_bending, transverse_bending : K_Fbeta, K_Falpha
    """

    application: float = 1.0
    dynamic: float = 1.0
    face_contact: float = 1.0
    transverse_contact: float = 1.0
    face_bending: float = 1.0
    transverse_bending: float = 1.0
    distribution: float = 1.0

    @property
    def contact(self) -> float:
        """K_A K_gamma K_v K_Hbeta K_Halpha."""
        return self.application * self.distribution * self.dynamic * self.face_contact * self.transverse_contact

    @property
    def bending(self) -> float:
        """K_A K_gamma K_v K_Fbeta K_Falpha."""
        return self.application * self.distribution * self.dynamic * self.face_bending * self.transverse_bending


@dataclass(frozen=True, kw_only=True)
class Load:
    """The load of a pair: one of torque of gear 1, or tangential force on its reference circle.

    Fields
        torque : float or None [N m] - T_1
        force : float or None [N] - F_t
        speed : float or None [1/min] - n_1, for sliding speeds
        given : frozenset of str - names of the factors that the file gives
    """

    torque: float | None = None
    force: float | None = None
    speed: float | None = None
    factors: Factors = Factors()
    given: frozenset[str] = frozenset()

    def tangential_force(self, reference_radius: float) -> float:
        """F_t = 2000 T_1/d_1 on the reference circle of gear 1 [N].

        Example
            >>> Load(torque=120.0).tangential_force(30.0)
            4000.0
        """
        if self.force is not None:
            return self.force
        return 1000.0 * (self.torque or 0.0) / reference_radius


def torque_of(power: float, speed: float) -> float:
    """T = P/omega [N m], from a power [kW] and a speed [1/min].

    Example
        >>> round(torque_of(10.0, 1500.0), 4)
        63.662
    """
    return 1000.0 * power / (speed * math.pi / 30.0)


class Required(NamedTuple):
    """The safeties that a file asks for."""

    pitting: float = 1.0
    bending: float = 1.4
    scuffing: float = 1.8


@dataclass(frozen=True, kw_only=True)
class Material:
    """The material of a gear.

    Fields
        elastic_modulus : float [N/mm^2] - E
        poisson : float - nu
        contact_limit, bending_limit : float or None [N/mm^2] - sigma_Hlim, sigma_Flim
        contact_factors, bending_factors : float - products Z_N Z_L Z_v Z_R Z_W Z_X, Y_N Y_drelT Y_RrelT Y_X
    """

    elastic_modulus: float = 206000.0
    poisson: float = 0.3
    contact_limit: float | None = None
    bending_limit: float | None = None
    contact_factors: float = 1.0
    bending_factors: float = 1.0

    @property
    def compliance(self) -> float:
        """(1 - nu^2)/E [mm^2/N]."""
        return (1.0 - self.poisson) * (1.0 + self.poisson) / self.elastic_modulus
