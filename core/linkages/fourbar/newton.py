"""The four-bar's vector loop by Newton-Raphson, the second and independent way, and its refinement to the last bit.

    a e(phi) + b e(theta_b) = d + c e(theta_c),    e(x) = exp(i x)

in the two unknowns theta_b (coupler) and theta_c (rocker), in the frame of `position`. It serves to check the closed
form, which is faster, and to gain the digits near a dead point that no plain formula gives.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearlink.core.errors import NoSolution
from gearlink.core.linkages.fourbar import position as fourbar
from gearlink.core.linkages.fourbar.position import FourBar
from gearlink.core.linkages.fourbar.vectors import loop_opening, loop_rates, loop_step, unit_rates, unit_vector
from gearlink.core.numerics.arrays import Reals

MOST_ITERATIONS = 20
_EPS = 2.0**-52
_ANCHOR_STEP = math.radians(5.0)
_SMALLEST_STEP = 1e-12


@dataclass(frozen=True, slots=True)
class NewtonSweep:
    """Positions found by Newton-Raphson, and what they took.

    coupler_angle, rocker_angle [rad], iterations (whole numbers; of all steps that led from the last known
    position), residual |r| of the loop [mm]; all of the shape of the crank angles.
    """

    coupler_angle: Reals
    rocker_angle: Reals
    iterations: NDArray[np.int64]
    residual: Reals


def start_is_safe(
    linkage: FourBar, crank_angle: ArrayLike, coupler_angle: ArrayLike, rocker_angle: ArrayLike
) -> NDArray[np.bool_]:
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
    phi, b, c = (np.asarray(x, dtype=np.float64) for x in (crank_angle, coupler_angle, rocker_angle))
    e_a, e_b, e_c = (unit_vector(x) for x in (phi, b, c))
    r = loop_opening(linkage, e_a, e_b, e_c)
    turn = e_c * e_b.conjugate()
    half_square = turn.imag**2 / (2.0 + 2.0 * np.abs(turn.real))
    near = np.abs(r) <= min(linkage.coupler, linkage.rocker) * half_square
    return np.asarray(near & (linkage.assembly * turn.imag > 0.0))


def polish(linkage: FourBar, crank_angle: ArrayLike, coupler_angle: ArrayLike, rocker_angle: ArrayLike) -> NewtonSweep:
    """Newton-Raphson from given starts, all positions at once.

    Parameters
        linkage : FourBar
        crank_angle, coupler_angle, rocker_angle : arrays that broadcast [rad] - the starts
    Returns
        sweep : NewtonSweep
    Raises
        NoSolution - when the loop is not closed within 16 eps of the sum of lengths after 20 iterations (no
            position exists, or a dead point is too near), or the assembly changed sides
    Notes
        Stops where max(b |d_b|, c |d_c|) <= 16 eps max(length)/sin(gamma), or where the step no longer shrinks: near
        a dead point the noise of the step is eps/gamma. `start_is_safe` tells beforehand.
    Example
        >>> sweep = polish(FourBar(18.0, 50.0, 100.0, 121.4), 0.0, 1.26, 2.65)
        >>> round(float(np.degrees(sweep.rocker_angle)), 6), int(sweep.iterations)
        (151.60249, 4)

    Source
        swing-gripper paper (4); stop rule and checks: own derivation
    """
    starts = np.broadcast_arrays(crank_angle, coupler_angle, rocker_angle)
    phi, b, c = (np.array(x, dtype=np.float64) for x in starts)
    shape = phi.shape
    phi, b, c = phi.ravel(), b.ravel(), c.ravel()
    e_a = unit_vector(phi)
    iterations = np.zeros(phi.size, dtype=np.int64)
    last = np.full(phi.size, np.inf)
    active = np.arange(phi.size)
    for _ in range(MOST_ITERATIONS):
        e_b, e_c = (unit_vector(x[active]) for x in (b, c))
        with np.errstate(divide="ignore", invalid="ignore"):
            d_b, d_c, _, sine = loop_step(linkage, e_a[active], e_b, e_c)
            size = np.maximum(linkage.coupler * np.abs(d_b), linkage.rocker * np.abs(d_c))
            small = size * np.abs(sine) <= 16.0 * _EPS * _longest(linkage)
        useful = size < last[active]
        b[active] += np.where(useful, d_b, 0.0)
        c[active] += np.where(useful, d_c, 0.0)
        iterations[active] += 1
        last[active] = size
        active = active[useful & ~small]
        if active.size == 0:
            break
    e_b, e_c = (unit_vector(x) for x in (b, c))
    residual = _checked(linkage, phi, b, c, e_a, e_b, e_c)
    return NewtonSweep(b.reshape(shape), c.reshape(shape), iterations.reshape(shape), residual.reshape(shape))


def _longest(linkage: FourBar) -> float:
    return max(linkage.crank, linkage.coupler, linkage.rocker, linkage.frame)


def _checked(linkage: FourBar, phi: Reals, b: Reals, c: Reals, e_a: Any, e_b: Any, e_c: Any) -> Reals:
    """|r| of every position; refuse one that is open, or that lies on the other side of BD."""
    r = loop_opening(linkage, e_a, e_b, e_c)
    residual: Reals = np.abs(r)
    total = linkage.crank + linkage.coupler + linkage.rocker + linkage.frame
    # Angles of several turns carry the rounding of their own size into the loop.
    limit = 16.0 * _EPS * total * np.maximum(1.0, np.maximum(np.abs(b), np.abs(c)))
    side = linkage.assembly * (e_c * e_b.conjugate()).imag
    good = (residual <= limit) & (side > -math.sqrt(_EPS))
    if not good.all():
        i = int(np.argmin(good))
        raise NoSolution(
            f"Newton-Raphson found no position of assembly {linkage.assembly:+d} at crank angle "
            f"{math.degrees(phi[i]):.9g} deg: the loop is open by {residual[i]:.3g} mm (limit {limit[i]:.3g} mm) after "
            f"at most {MOST_ITERATIONS} iterations; the linkage does not close there, or the start lies too far off: "
            f"take the closed form's position as the start"
        )
    return residual


@dataclass(frozen=True, slots=True)
class _Place:
    """A position on the way: angles and iterations spent since the last place asked for."""

    phi: float
    b: float
    c: float
    iterations: int


def _first(linkage: FourBar, phi: float) -> _Place:
    start = fourbar.solve(linkage, phi)
    b, c, iterations = _iterate(linkage, phi, start.coupler_angle, start.rocker_angle)
    return _Place(phi, b, c, iterations)


def _advance(linkage: FourBar, place: _Place, target: float) -> _Place:
    """Next place of the motion, in as many safe steps as it takes."""
    phi, b, c, spent = place.phi, place.b, place.c, 0
    step = target - phi
    while phi != target:
        if abs(step) < _SMALLEST_STEP * max(1.0, abs(target)):
            raise NoSolution(
                f"the motion ends at crank angle {math.degrees(phi):.9g} deg, where coupler and rocker align, on the "
                f"way to {math.degrees(target):.9g} deg; keep the crank within its range or change a length"
            )
        there = target if abs(step) >= abs(target - phi) else phi + step
        start = _predict(linkage, phi, b, c, there - phi)
        if not _safe(linkage, there, *start):
            step = 0.5 * (there - phi)
            continue
        b, c, iterations = _iterate(linkage, there, *start)
        phi, spent, step = there, spent + iterations, 2.0 * step
    return _Place(phi, b, c, spent)


def _predict(linkage: FourBar, phi: float, b: float, c: float, h: float) -> tuple[float, float]:
    e_a, e_b, e_c = (cmath.rect(1.0, x) for x in (phi, b, c))
    if (e_c * e_b.conjugate()).imag == 0.0:
        return b, c
    w_b, w_c, a_b, a_c = unit_rates(linkage, e_a, e_b, e_c, 2, 1.0, 0.0, 0.0)
    return b + h * (w_b + 0.5 * h * a_b), c + h * (w_c + 0.5 * h * a_c)


def _safe(linkage: FourBar, phi: float, b: float, c: float) -> bool:
    """`start_is_safe` of one position."""
    e_a, e_b, e_c = (cmath.rect(1.0, x) for x in (phi, b, c))
    r = loop_opening(linkage, e_a, e_b, e_c)
    turn = e_c * e_b.conjugate()
    half_square = turn.imag**2 / (2.0 + 2.0 * abs(turn.real))
    return abs(r) <= min(linkage.coupler, linkage.rocker) * half_square and linkage.assembly * turn.imag > 0.0


def _iterate(linkage: FourBar, phi: float, b: float, c: float) -> tuple[float, float, int]:
    """`polish` of one position, without its checks."""
    e_a, last = cmath.rect(1.0, phi), math.inf
    for n in range(1, MOST_ITERATIONS + 1):
        e_b, e_c = cmath.rect(1.0, b), cmath.rect(1.0, c)
        if (e_b * e_c.conjugate()).imag == 0.0:
            return b, c, n
        d_b, d_c, _, sine = loop_step(linkage, e_a, e_b, e_c)
        size = max(linkage.coupler * abs(d_b), linkage.rocker * abs(d_c))
        if size >= last:
            return b, c, n
        b, c, last = b + d_b, c + d_c, size
        if size * abs(sine) <= 16.0 * _EPS * _longest(linkage):
            return b, c, n
    return b, c, MOST_ITERATIONS


def solve(linkage: FourBar, crank_angle: ArrayLike, over: tuple[float, float] | None = None) -> NewtonSweep:
    """Positions over an array of crank angles: anchors every five degrees are followed, the rest fan out from them.

    Parameters
        linkage : FourBar
        crank_angle : array of any shape [rad] - in any order
        over : (first, last) [rad] - range of the motion that they are taken from, so that each has the same anchors
            among any others; None: the range of the angles themselves
    Returns
        sweep : NewtonSweep - angles continuous in the crank angle, starting from the closed form at the first one
    Raises
        NoSolution - where no motion leads from the first crank angle to another without passing a dead point
    Notes
        One call of the closed form, at the first angle; all else is Newton-Raphson, so the result is an
        independent check of `sweep.solve`. A fan start that is not safe is reached step by step.
    Example
        >>> sweep = solve(FourBar(18.0, 50.0, 100.0, 121.4), np.radians([45.0, 300.0]))
        >>> np.round(np.degrees(sweep.rocker_angle), 9).tolist()
        [146.168778216, 161.772190585]

    Source
        swing-gripper paper (4); anchors: own derivation
    """
    angle = np.asarray(crank_angle, dtype=np.float64)
    phi = angle.ravel()
    if phi.size == 0:
        return NewtonSweep(angle.copy(), angle.copy(), np.zeros(angle.shape, dtype=np.int64), angle.copy())
    anchors = _anchors(linkage, phi if over is None else np.array(over))
    at = np.array([(p.phi, p.b, p.c) for p in anchors]).T
    nearest = np.abs(np.rint((phi - at[0, 0]) / _ANCHOR_STEP)).astype(np.int64)
    nearest = np.minimum(nearest, len(anchors) - 1)
    from_phi, b, c = at[:, nearest]
    h = phi - from_phi
    w_b, w_c, a_b, a_c = loop_rates(linkage, from_phi, b, c)
    start_b, start_c = b + h * (w_b + 0.5 * h * a_b), c + h * (w_c + 0.5 * h * a_c)
    extra = np.zeros(phi.size, dtype=np.int64)
    for i in np.flatnonzero(~start_is_safe(linkage, phi, start_b, start_c)):
        place = _advance(linkage, anchors[nearest[i]], float(phi[i]))
        start_b[i], start_c[i], extra[i] = place.b, place.c, place.iterations
    found = polish(linkage, phi, start_b, start_c)
    return NewtonSweep(
        found.coupler_angle.reshape(angle.shape),
        found.rocker_angle.reshape(angle.shape),
        (found.iterations + extra).reshape(angle.shape),
        found.residual.reshape(angle.shape),
    )


def _anchors(linkage: FourBar, phi: Reals) -> list[_Place]:
    """Places every five degrees from the smallest crank angle to the largest, followed from the first given one."""
    low, high, first = float(phi.min()), float(phi.max()), float(phi[0])
    count = max(1, math.ceil((high - low) / _ANCHOR_STEP))
    ladder = [low + k * _ANCHOR_STEP for k in range(count)] + [high]
    above = [x for x in ladder if x >= first]
    below = [x for x in reversed(ladder) if x < first]
    start = _first(linkage, first)
    places: list[_Place] = []
    for way in (above, below):
        place = start
        for x in way:
            place = _advance(linkage, place, x)
            places.append(place)
    return sorted(places, key=lambda p: p.phi)
