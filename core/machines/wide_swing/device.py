"""The unloading device of a wide swing without dimension: cylinder, spring, pendulum; energy, least pivot ratio.

A tension device (pneumatic cylinder of constant force, or spring) joins a pin on the rocker at radius r_d to a
base pin at a_d from the pivot; pins and pivot are collinear at mid-swing, where the device is shortest.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short, unlike
from gearlink.core.numerics.arrays import Reals

WIDEST_SWING = math.radians(340.0)
STANDARD_EXTENSION_RATIO = 13.0 / 9.0


@dataclass(frozen=True, slots=True)
class Pneumatic:
    """Cylinder of constant force; pivot_ratio lambda_d = a_d/r_d > 1 (base pin distance over arm).

    Source
        wide-swing dissertation, chapter 2, figures 1 to 3
    """

    pivot_ratio: float

    def __post_init__(self) -> None:
        _require_pivot_ratio(self.pivot_ratio)


@dataclass(frozen=True, slots=True)
class Spring:
    """Tension spring; pivot_ratio lambda_d > 1, stretch_ratio epsilon = mounting stretch over stroke, >= 0.

    Source
        wide-swing dissertation, chapter 2, figures 1 to 3
    """

    pivot_ratio: float
    stretch_ratio: float

    def __post_init__(self) -> None:
        _require_pivot_ratio(self.pivot_ratio)
        if not 0.0 <= self.stretch_ratio < math.inf:
            raise NoSolution(
                f"stretch ratio {short(self.stretch_ratio)}: the spring is slack at mid-swing",
                fix="give it a mounting stretch of at least 0 times its stroke",
            )


@dataclass(frozen=True, slots=True)
class Gravity:
    """A mass that hangs from the rocker axis, lowest at mid-swing: E = cos phi - cos(gamma/2), the pendulum.

    The same energy as that of a spring without free length at any pivot ratio, which here is 2, over that ratio.

    Source
        own derivation; the dissertation's first publication is on the physical pendulum
    """

    pivot_ratio: float = field(default=2.0, init=False)


Device = Pneumatic | Spring | Gravity


def _require_pivot_ratio(ratio: float) -> None:
    if not 1.0 < ratio < math.inf:
        raise NoSolution(
            f"pivot ratio: {unlike(ratio, 1.0)} (limit > 1: the base pin is outside the circle of the arm)",
            fix="increase the pivot distance or reduce the arm",
        )


def require_swing(swing: float) -> None:
    """Refuse a swing outside (0, 340 deg].

    Raises
        NoSolution - with the limit and the remedy
    Source
        wide-swing dissertation, chapter 2 (swings up to 300 deg), conclusion 3 (above)
    """
    if not 0.0 < swing <= WIDEST_SWING * (1.0 + 1e-14):
        raise NoSolution(
            f"swing: {unlike(math.degrees(swing), 340.0)} deg (above 0, at most 340 deg)",
            fix="reduce swing, or add a gear stage",
        )


@dataclass(frozen=True)
class DeviceGeometry:
    """Length of the device over the swing, in arms r_d, written so that no digits cancel.

    l(phi) = sqrt(1 + lambda^2 - 2 lambda cos phi) = sqrt(l0^2 + 4 lambda sin^2(phi/2)), phi from mid-swing
    x = L - l;  available energy E = x (pneumatic), (1 + eps) D x - x^2/2 (spring);  D = L - l0

    Source
        wide-swing dissertation (2), (6), (11); the product forms are own derivation
    """

    device: Device
    swing: float

    @cached_property
    def ratio(self) -> float:
        """lambda_d."""
        return self.device.pivot_ratio

    @cached_property
    def half_sine(self) -> float:
        """m = sin(swing/4)."""
        return math.sin(0.25 * self.swing)

    @cached_property
    def half_cosine(self) -> float:
        """cos(swing/4)."""
        return math.cos(0.25 * self.swing)

    @cached_property
    def shortest(self) -> float:
        """l0 = lambda - 1, at mid-swing."""
        return self.ratio - 1.0

    @cached_property
    def longest(self) -> float:
        """L, at the ends of the swing."""
        return math.hypot(self.shortest, self.reach * self.half_sine)

    @cached_property
    def reach(self) -> float:
        """2 sqrt(lambda)."""
        return 2.0 * math.sqrt(self.ratio)

    @cached_property
    def stroke(self) -> float:
        """D = L - l0."""
        return (self.reach * self.half_sine) ** 2 / (self.longest + self.shortest)

    def length(self, sine: Reals) -> Reals:
        """l where sin(phi/2) = m * sine."""
        return np.hypot(self.shortest, self.reach * self.half_sine * sine)

    def half_cosine_at(self, cosine: Reals) -> Reals:
        """cos(phi/2); cosine that of the pendulum angle."""
        return np.hypot(self.half_cosine, self.half_sine * cosine)

    def angle(self, sine: Reals, cosine: Reals) -> Reals:
        """phi."""
        return np.asarray(2.0 * np.arctan2(self.half_sine * sine, self.half_cosine_at(cosine)))

    def lever(self, sine: Reals, cosine: Reals) -> Reals:
        """dl/dphi = lambda sin(phi)/l."""
        sine_of_swing = 2.0 * self.half_sine * sine * self.half_cosine_at(cosine)
        return np.asarray(self.ratio * sine_of_swing / self.length(sine))

    def extension(self, sine: Reals) -> Reals:
        """l - l0 where sin(phi/2) = m * sine."""
        return (self.reach * self.half_sine * sine) ** 2 / (self.length(sine) + self.shortest)

    @cached_property
    def mounting(self) -> float:
        """Stretch at mid-swing, in arms; of a pendulum's spring that without free length."""
        if isinstance(self.device, Spring):
            return self.device.stretch_ratio * self.stroke
        return self.shortest

    @cached_property
    def stiffness(self) -> float:
        """-dX/dx: 1 for a spring, 0 for a cylinder, 1/lambda for a pendulum."""
        if isinstance(self.device, Gravity):
            return 1.0 / self.ratio
        return 0.0 if isinstance(self.device, Pneumatic) else 1.0

    def mean_force(self, sine: Reals) -> Reals:
        """w = E/x: force over stretch, mean between here and the end of the swing."""
        return self._force(0.5 * self.stroke + self.mounting + 0.5 * self.extension(sine))

    def mean_force_to_middle(self, sine: Reals) -> Reals:
        """(E(mid) - E)/(l - l0): the mean between here and mid-swing."""
        return self._force(self.mounting + 0.5 * self.extension(sine))

    def force(self, sine: Reals) -> Reals:
        """X = dE/dx: the force here."""
        return self._force(self.mounting + self.extension(sine))

    def energy(self, sine: Reals, cosine: Reals) -> Reals:
        """E where sin(phi/2) = m * sine; cosine that of the pendulum angle."""
        x = (self.reach * self.half_sine * cosine) ** 2 / (self.longest + self.length(sine))
        return np.asarray(x * self.mean_force(sine))

    def _force(self, stretch: Reals) -> Reals:
        if isinstance(self.device, Pneumatic):
            return np.ones_like(stretch)
        return self.stiffness * stretch


def least_pivot_ratio_pneumatic(swing: float, extension_ratio: float = STANDARD_EXTENSION_RATIO) -> float:
    """Minimum pivot ratio at which a cylinder of given extended over retracted length turns with the rocker.

    lambda_min = p + sqrt(p^2 - 1), p = (q^2 - cos(gamma/2))/(q^2 - 1)

    Parameters
        swing : float [rad] - gamma, 0 to 340 deg
        extension_ratio : float - q = extended over retracted length, above 1; 13/9 is the dissertation's
    Raises
        NoSolution - for a swing outside (0, 340 deg] or q not above 1
    Notes
        Written with p - 1 = 2 sin^2(gamma/4)/(q^2 - 1), so lambda - 1 keeps its digits for small swings.
    Example
        >>> round(least_pivot_ratio_pneumatic(math.radians(120)), 12)
        2.524306070569

    Source
        wide-swing dissertation (3); the general q: own derivation
    """
    require_swing(swing)
    q = extension_ratio
    if not 1.0 < q < math.inf:
        raise NoSolution(f"extension ratio of the cylinder: {unlike(q, 1.0)} (limit > 1; usual 13/9)")
    excess = 2.0 * math.sin(0.25 * swing) ** 2 / ((q - 1.0) * (q + 1.0))
    return 1.0 + excess + math.sqrt(excess * (excess + 2.0))


def least_pivot_ratio_spring(
    swing: float, stretch_ratio: float, arm: float, closed_length: float, end_fittings: float = 0.0
) -> float:
    """Minimum pivot ratio at which a spring of given closed length fits between the pins at mid-swing.

    lambda = 1 + (l_0 + l_k + S_0)/r_d with the mounting stretch S_0 = epsilon r_d D(lambda, gamma)

    Parameters
        swing : float [rad] - gamma, 0 to 340 deg
        stretch_ratio : float - epsilon = mounting stretch over stroke, >= 0
        arm, closed_length, end_fittings : float [mm] - r_d, length of the closed coils l_0, of the hooks l_k
    Raises
        NoSolution - for a swing outside (0, 340 deg], a length that is not positive, or epsilon < 0
    Notes
        D depends on lambda: the equation, a quadratic for D, is solved for the ratio that just fits. A larger
        ratio needs less stretch, so every ratio above it fits.
    Example
        >>> round(least_pivot_ratio_spring(math.radians(180), 0.5, 120.0, 150.0, 40.0), 9)
        3.160547185

    Source
        wide-swing dissertation (4)
    """
    require_swing(swing)
    Spring(2.0, stretch_ratio)
    for name, value in (("arm", arm), ("closed length of the spring", closed_length)):
        if not 0.0 < value < math.inf:
            raise NoSolution(f"{name}: {value:.4g} mm (limit > 0)")
    if not 0.0 <= end_fittings < math.inf:
        raise NoSolution(f"length of the end fittings: {end_fittings:.4g} mm (limit >= 0)")
    dead, square = (closed_length + end_fittings) / arm, 4.0 * math.sin(0.25 * swing) ** 2
    # (1 + 2 eps) D^2 + (2 dead - eps square) D - square (1 + dead) = 0
    half = dead - 0.5 * stretch_ratio * square
    root = math.sqrt(half * half + (1.0 + 2.0 * stretch_ratio) * square * (1.0 + dead))
    stroke = (root - half) / (1.0 + 2.0 * stretch_ratio) if half < 0.0 else square * (1.0 + dead) / (root + half)
    return 1.0 + dead + stretch_ratio * stroke


def least_pivot_ratio_spring_material(
    swing: float, stretch_ratio: float, stretch_capacity: float, end_fittings_ratio: float = 0.0
) -> float:
    """Minimum pivot ratio of a spring whose closed length follows from the stretch that its wire bears.

    l_0 = S (1 + eps)/eta;  q = 1 + 1/kappa, kappa = eps + (1 + eps)/eta, mu = (l_k/r_d)/kappa
    lambda = [h + sqrt(h^2 - (q^2 - 1)((q + mu)^2 - 1))]/(q^2 - 1), h = q (q + mu) - cos(gamma/2)

    Parameters
        swing : float [rad] - gamma, 0 to 340 deg
        stretch_ratio : float - epsilon, >= 0
        stretch_capacity : float - eta = allowable stretch over closed length, about 1 to 2 for steel
        end_fittings_ratio : float - l_k/r_d, >= 0
    Raises
        NoSolution - for a swing outside (0, 340 deg], epsilon < 0, eta <= 0 or l_k < 0
    Example
        >>> round(least_pivot_ratio_spring_material(math.radians(120), 0.2, 1.5, 0.3), 12)
        2.028314441376

    Source
        wide-swing dissertation (4), with the closed length as a function of the stroke: own derivation
    """
    require_swing(swing)
    Spring(2.0, stretch_ratio)
    if not (0.0 < stretch_capacity < math.inf and 0.0 <= end_fittings_ratio < math.inf):
        raise NoSolution(
            f"stretch capacity {stretch_capacity:.4g} (limit > 0; steel 1 to 2), end fittings {end_fittings_ratio:.4g} "
            "arms (limit >= 0)"
        )
    kappa = stretch_ratio + (1.0 + stretch_ratio) / stretch_capacity
    q, mu = 1.0 + 1.0 / kappa, end_fittings_ratio / kappa
    square, versed = (q - 1.0) * (q + 1.0), 2.0 * math.sin(0.25 * swing) ** 2
    h = square + q * mu + versed
    # h^2 - (q^2 - 1)((q + mu)^2 - 1) with the products multiplied out: a sum of positive terms
    discriminant = mu * mu + versed * (2.0 * (square + q * mu) + versed)
    return (h + math.sqrt(discriminant)) / square
