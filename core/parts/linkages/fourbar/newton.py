"""The four-bar's vector loop by Newton-Raphson, the second way, which checks the closed form.

    r = a e(phi) + b e(theta_b) - d - c e(theta_c) = 0,    e(x) = exp(i x)

in the two unknowns theta_b (coupler) and theta_c (rocker), in the frame of `position`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.wording import short
from gearlink.core.numerics.arrays import Mask, Reals
from gearlink.core.parts.linkages.fourbar import sweep
from gearlink.core.parts.linkages.fourbar.position import FourBar

MOST_ITERATIONS = 20
_EPS = 2.0**-52
_ANCHOR_STEP = math.radians(5.0)
_MOST_HALVINGS = 40


@dataclass(frozen=True, slots=True)
class NewtonSweep:
    """Positions found by Newton-Raphson, and what they took.

    coupler_angle, rocker_angle [rad], iterations (whole numbers), residual |r| of the loop [mm]; all of the shape of
    the crank angles.
    """

    coupler_angle: Reals
    rocker_angle: Reals
    iterations: NDArray[np.int64]
    residual: Reals


def solve(linkage: FourBar, crank_angle: ArrayLike, over: tuple[float, float] | None = None) -> NewtonSweep:
    """Positions over an array of crank angles, each from the motion's place at an anchor up to 2.5 degrees away.

    theta = theta(anchor) + h theta' + h^2 theta''/2,   h = phi - anchor,   then `polish`

    Parameters
        linkage : FourBar
        crank_angle : array of any shape [rad] - in any order
        over : (first, last) [rad] - range of the motion: anchors stand every five degrees from its lower end, and at
            its upper one; None: the range of the angles themselves
    Returns
        sweep : NewtonSweep - angles continuous in the crank angle
    Raises
        NoSolution - where an anchor or a position does not exist, or is a dead centre
    Notes
        Anchors are the closed form's; positions are roots of the loop that `start_is_safe` makes unique. A start that
        is not safe is taken at half the distance.
    Example
        >>> found = solve(FourBar(18.0, 50.0, 100.0, 121.4), np.radians([45.0, 300.0]))
        >>> np.round(np.degrees(found.rocker_angle), 9).tolist()
        [146.168778216, 161.772190585]

    Source
        swing-gripper paper (4); anchors: own derivation
    """
    phi = np.asarray(crank_angle, dtype=np.float64)
    if phi.size == 0:
        return NewtonSweep(phi.copy(), phi.copy(), np.zeros(phi.shape, dtype=np.int64), phi.copy())
    ends = phi if over is None else np.array(over)
    low, high = float(ends.min()), float(ends.max())
    h = phi - np.minimum(low + _ANCHOR_STEP * np.rint((phi - low) / _ANCHOR_STEP), high)
    for _ in range(_MOST_HALVINGS):
        at = sweep.solve(linkage, phi - h, 2)
        coupler = at.coupler_angle + h * (at.coupler_velocity + 0.5 * h * at.coupler_acceleration)
        rocker = at.rocker_angle + h * (at.rocker_velocity + 0.5 * h * at.rocker_acceleration)
        safe = start_is_safe(linkage, phi, coupler, rocker)
        if safe.all():
            break
        h = np.where(safe, h, 0.5 * h)
    return polish(linkage, phi, coupler, rocker)


def start_is_safe(linkage: FourBar, crank_angle: ArrayLike, coupler_angle: ArrayLike, rocker_angle: ArrayLike) -> Mask:
    """Whether Newton-Raphson is certain to converge from a start, quadratically and to the same assembly.

    |r| <= min(b, c) sin^2(g/2),   g = min(gamma, pi - gamma),   and sin(theta_c - theta_b) has the assembly's sign

    Parameters
        linkage, crank_angle, coupler_angle, rocker_angle - a position [rad]
    Returns
        safe : array of bool
    Notes
        Kantorovich's condition in the unknowns b theta_b, c theta_c: the Jacobian has unit columns, its inverse the
        norm 1/(sqrt(2) sin(g/2)), its Lipschitz constant is 1/min(b, c).
    Example
        >>> linkage = FourBar(18.0, 50.0, 100.0, 121.4)
        >>> bool(start_is_safe(linkage, 0.0, 1.26, 2.65)), bool(start_is_safe(linkage, 0.0, -1.26, -2.65))
        (True, False)
    """
    _, _, r, sine = loop_step(linkage, crank_angle, coupler_angle, rocker_angle)
    cosine = np.cos(np.subtract(rocker_angle, coupler_angle))
    near = r <= min(linkage.coupler, linkage.rocker) * sine**2 / (2.0 + 2.0 * np.abs(cosine))
    return np.asarray(near & (linkage.assembly * sine < 0.0))


def loop_step(
    linkage: FourBar, crank_angle: ArrayLike, coupler_angle: ArrayLike, rocker_angle: ArrayLike
) -> tuple[Reals, Reals, Reals, Reals]:
    """Newton-Raphson steps of both angles [rad], |r| before [mm], and sin(theta_b - theta_c).

    d_b = Re(r conj(e_c)) / (b sin(theta_b - theta_c)),   d_c = Re(r conj(e_b)) / (c sin(theta_b - theta_c))

    Source
        swing-gripper paper (4), there called Newton-Simpson, with the sign of l3 cos theta3 corrected
    """
    e_a, e_b, e_c = (np.cos(x) + 1j * np.sin(x) for x in (crank_angle, coupler_angle, rocker_angle))
    r = linkage.crank * e_a + linkage.coupler * e_b - linkage.frame - linkage.rocker * e_c
    sine = (e_b * e_c.conjugate()).imag
    with np.errstate(divide="ignore", invalid="ignore"):
        d_b = (r * e_c.conjugate()).real / (linkage.coupler * sine)
        d_c = (r * e_b.conjugate()).real / (linkage.rocker * sine)
    return d_b, d_c, np.abs(r), sine


def polish(linkage: FourBar, crank_angle: ArrayLike, coupler_angle: ArrayLike, rocker_angle: ArrayLike) -> NewtonSweep:
    """Newton-Raphson from given starts, all positions at once.

    Parameters
        linkage : FourBar
        crank_angle, coupler_angle, rocker_angle : arrays that broadcast [rad] - the starts
    Returns
        sweep : NewtonSweep
    Raises
        NoSolution - when the loop is not closed within 16 eps of the sum of lengths after 20 iterations (no
            position exists, or a dead centre is too near), or the assembly changed sides
    Notes
        Stops where max(b |d_b|, c |d_c|) <= 16 eps max(length)/sin(gamma), or where the step no longer shrinks: near
        a dead centre the noise of the step is eps/gamma. `start_is_safe` tells beforehand.
    Example
        >>> sweep = polish(FourBar(18.0, 50.0, 100.0, 121.4), 0.0, 1.26, 2.65)
        >>> round(float(np.degrees(sweep.rocker_angle)), 6), int(sweep.iterations)
        (151.60249, 4)

    Source
        swing-gripper paper (4); stop rule and checks: own derivation
    """
    starts = np.broadcast_arrays(crank_angle, coupler_angle, rocker_angle)
    phi, b, c = (np.array(x, dtype=np.float64) for x in starts)
    longest = max(linkage.crank, linkage.coupler, linkage.rocker, linkage.frame)
    iterations, last, active = np.zeros(phi.shape, dtype=np.int64), np.full(phi.shape, np.inf), np.ones(phi.shape, bool)
    for _ in range(MOST_ITERATIONS):
        d_b, d_c, _, sine = loop_step(linkage, phi, b, c)
        size = np.maximum(linkage.coupler * np.abs(d_b), linkage.rocker * np.abs(d_c))
        useful = active & (size < last)
        b, c = b + np.where(useful, d_b, 0.0), c + np.where(useful, d_c, 0.0)
        iterations += active
        last = np.where(active, size, last)
        active = useful & ~(size * np.abs(sine) <= 16.0 * _EPS * longest)
        if not active.any():
            break
    return NewtonSweep(b, c, iterations, _checked(linkage, phi, b, c))


def _checked(linkage: FourBar, phi: Reals, b: Reals, c: Reals) -> Reals:
    """|r| of every position; refuse one that is open, or that lies on the other side of BD."""
    _, _, residual, sine = loop_step(linkage, phi, b, c)
    total = linkage.crank + linkage.coupler + linkage.rocker + linkage.frame
    # Angles of several turns carry the rounding of their own size into the loop.
    limit = 16.0 * _EPS * total * np.maximum(1.0, np.maximum(np.abs(b), np.abs(c)))
    good = (residual <= limit) & (linkage.assembly * sine < math.sqrt(_EPS))
    if not good.all():
        at = np.unravel_index(np.argmin(good), good.shape)
        raise NoSolution(
            (
                f"Newton-Raphson found no position of assembly {linkage.assembly:+d} at crank angle "
                f"{short(math.degrees(phi[at]))} deg: the loop is open by {residual[at]:.3g} mm (limit "
                f"{limit[at]:.3g} mm) after at most {MOST_ITERATIONS} iterations; the linkage does not "
                "close there, or the start lies too far off"
            ),
            fix="take the closed form's position as the start",
        )
    return np.asarray(residual)
