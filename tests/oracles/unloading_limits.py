"""Closed forms of the unloading laws: the pendulum, the device whose pins meet, and the small swing.

A general device leads to hyperelliptic integrals; these limits are elliptic or elementary, and hold the
quadrature of `gearlink.core.machines.wide_swing.law` to account.
"""

from __future__ import annotations

import math

import numpy as np

from gearlink.core.machines.wide_swing.device import Device, Pneumatic, require_swing
from gearlink.core.machines.wide_swing.law import ElasticLaw
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.elliptic import complete_integral, incomplete_integral, jacobi_sn_cn
from gearlink.core.numerics.roots import bracketed_root


def pendulum_stretch_ratio(pivot_ratio: float, swing: float) -> float:
    """Stretch ratio that gives a spring zero free length, so that the rocker swings as a pendulum.

    epsilon* = (lambda - 1)/D

    Parameters
        pivot_ratio : float - lambda_d above 1
        swing : float [rad] - gamma, 0 to 300 deg
    Returns
        stretch_ratio : float
    Raises
        NoSolution - for a swing outside (0, 300 deg]
    Example
        >>> round(pendulum_stretch_ratio(3.0, math.radians(120)), 12)
        3.09716754071

    Source
        own derivation: E = lambda (cos phi - cos(gamma/2))
    """
    require_swing(swing)
    shortest, chord = pivot_ratio - 1.0, 2.0 * math.sqrt(pivot_ratio) * math.sin(0.25 * swing)
    return shortest * (math.hypot(shortest, chord) + shortest) / chord**2


def pendulum_peaks(swing: float) -> tuple[float, float, float]:
    """Velocity peak, acceleration at the start, and acceleration peak of the pendulum law.

    B = 4 K m/gamma, c(0) = 4 K^2 sin(gamma/2)/gamma, C = c(0) or, beyond 180 deg, 4 K^2/gamma; m = sin(gamma/4)

    Parameters
        swing : float [rad] - gamma, 0 to 300 deg
    Returns
        B, c0, C : floats
    Raises
        NoSolution - for a swing outside (0, 300 deg]
    Example
        >>> [round(x, 12) for x in pendulum_peaks(math.radians(240))]
        [1.783424084844, 3.845981945093, 4.440957422596]

    Source
        own derivation; limit of the wide-swing dissertation's (8), (10) for a large pivot ratio
    """
    require_swing(swing)
    quarter = complete_integral(math.cos(0.25 * swing))
    peak = 4.0 * quarter**2 / swing
    start = peak * math.sin(0.5 * swing)
    return 4.0 * quarter * math.sin(0.25 * swing) / swing, start, start if swing <= math.pi else peak


def pendulum_displacement(k: Reals, swing: float) -> Reals:
    """Displacement invariant of the pendulum law.

    a = 1/2 - (2/gamma) asin(m sn(K (1 - 2k), m))

    Parameters
        k : (N,) array - fraction of the stroke, 0 to 1
        swing : float [rad] - gamma, 0 to 300 deg
    Returns
        a : (N,) array
    Raises
        NoSolution - for a swing outside (0, 300 deg]
    Example
        >>> pendulum_displacement(np.array([0.25]), math.radians(120)).round(12).tolist()
        [0.142154976126]

    Source
        own derivation
    """
    require_swing(swing)
    m, complement = math.sin(0.25 * swing), math.cos(0.25 * swing)
    sn, _ = jacobi_sn_cn(complete_integral(complement) * np.abs(1.0 - 2.0 * k), m, complement)
    return 0.5 - np.sign(1.0 - 2.0 * k) * 2.0 / swing * np.arcsin(m * sn)


def touching_pins_energy_parameter(swing: float) -> float:
    """Energy parameter of a cylinder whose base pin lies on the circle of the arm (pivot ratio 1).

    N = (4/gamma)^2 [K(n) - F(asin(1/(n sqrt 2)), n)]^2, n = cos(pi/4 - gamma/8)

    Parameters
        swing : float [rad] - gamma, 0 to 300 deg
    Returns
        N : float
    Raises
        NoSolution - for a swing outside (0, 300 deg]
    Notes
        Not a device that can be built; the limit of the law for a pivot ratio falling to 1.
    Example
        >>> round(touching_pins_energy_parameter(math.radians(120)), 12)
        4.240801955201

    Source
        own derivation
    """
    require_swing(swing)
    angle = 0.25 * math.pi - 0.125 * swing
    n, complement = math.cos(angle), abs(math.sin(angle))
    # 1 - 1/(2 n^2) = cos(2 angle)/(2 n^2) = sin(gamma/4)/(2 n^2)
    sine, cosine = np.array([1.0]), np.array([math.sqrt(math.sin(0.25 * swing))])
    part = float(incomplete_integral(sine, cosine, n, complement)[0])
    return (4.0 / swing * (complete_integral(complement) - part)) ** 2


def small_swing_peaks(device: Device) -> tuple[float, float]:
    """Velocity and acceleration peaks that the law tends to as the swing falls to zero.

    cylinder (harmonic): B = pi/2, C = pi^2/2
    spring (Duffing), mu = 1/(2 + 2 eps): B = sqrt((1 + 2 eps) mu) K(mu), C = 2 K(mu)^2

    Parameters
        device : Pneumatic or Spring
    Returns
        B, C : floats
    Notes
        K is the complete elliptic integral of parameter mu = k^2.
    Example
        >>> from gearlink.core.machines.wide_swing.device import Spring
        >>> [round(x, 12) for x in small_swing_peaks(Spring(3.0, 0.5))]
        [1.415737208426, 6.012935529965]

    Source
        own derivation
    """
    if isinstance(device, Pneumatic):
        return 0.5 * math.pi, 0.5 * math.pi**2
    slack = 1.0 + 2.0 * device.stretch_ratio
    quarter = complete_integral(math.sqrt(slack / (1.0 + slack)))
    return math.sqrt(slack / (1.0 + slack)) * quarter, 2.0 * quarter**2


def invariants(law: ElasticLaw, k: float, order: int = 2) -> tuple[float, ...]:
    """Those of a law at one place."""
    return tuple(float(x[0]) for x in law.invariants(np.array([k]), order))


def energy_parameter(law: ElasticLaw, nodes: int) -> float:
    """N = ((2/gamma) Int F du)^2 from a given number of nodes over half the stroke: the convergence of the quadrature.

    Example
        >>> law = ElasticLaw(Pneumatic(2.5), math.radians(120))
        >>> [f"{energy_parameter(law, n) - law.energy_parameter:.0e}" for n in (2, 4, 8)]
        ['-4e-03', '-1e-06', '-2e-13']
    """
    span, g = complete_integral(law.modulus_complement), law.geometry
    z = (np.arange(nodes) + 0.5) * (span / nodes)
    cosine, sine = jacobi_sn_cn(z, law.modulus, law.modulus_complement)
    slowness = law.slowness(sine, cosine) * g.length(sine) / g.longest
    return (2.0 / law.swing * span * math.fsum(slowness.tolist()) / nodes) ** 2


def iterated(ratio: float, swing: float, *, steps: int, exponent: int) -> tuple[float, int]:
    """N of a cylinder, and the passes that it takes, by the dissertation's iteration N <- mu^exponent N from B = 2.

    a_{i+1} = a_i + (b_i + b_{i+1}) dk/2 to k = 1/2, b = sqrt(N (l(0) - l(a))), l by the cosine rule; mu = 0.5/a(1/2)

    Raises
        ArithmeticError - where mu has not come within 1e-12 of 1 in 100 passes, or a march leaves the swing
    """

    def speed(a: float, parameter: float) -> float:
        length, longest = (
            math.sqrt(1.0 + ratio * ratio - 2.0 * ratio * math.cos(phi)) for phi in ((0.5 - a) * swing, 0.5 * swing)
        )
        if length > longest * (1.0 + 1e-15):
            raise ArithmeticError("the march leaves the swing")
        return math.sqrt(parameter * max(0.0, longest - length))

    parameter, dk = (2.0 / speed(0.5, 1.0)) ** 2, 0.5 / steps
    for passes in range(1, 101):
        a = b = 0.0
        for _ in range(steps):
            step = max(4.0 * speed(0.5, parameter) * dk, 1e-9)

            def left(end: float, a: float = a, b: float = b, parameter: float = parameter) -> float:
                return end - a - 0.5 * (b + speed(end, parameter)) * dk

            a = bracketed_root(left, a + 1e-3 * b * dk + 1e-9, min(a + step, 1.0))
            b = speed(a, parameter)
        mu = 0.5 / a
        if abs(mu - 1.0) <= 1e-12:
            return parameter, passes
        parameter *= mu**exponent
    raise ArithmeticError("no end in 100 passes")
