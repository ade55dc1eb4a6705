"""The four-bar linkage over arrays of crank angles: one tangent a position, in blocks that stay in the cache.

Frame, names and closed form are those of `core.parts.linkages.fourbar.position`. With t = tan(phi/2) every sum of
`core.parts.linkages.fourbar.loop`, multiplied by 1 + t^2, is linear in t^2: the sweep needs no sine or cosine. Of the
angles each is half a revolution wide at most, so that three arc tangents of quotients give them; one with two
arguments takes twice as long where the processor has no AVX-512. What `loop.rates` computes stands here again, in rows
that are filled in place: that function over arrays takes 1.15 (360 positions) to 2.5 times (3600) as long.

The vector loop by Newton-Raphson is the second way, which checks the closed form.

    r = a e(phi) + b e(theta_b) - d - c e(theta_c) = 0,    e(x) = exp(i x)

in the two unknowns theta_b (coupler) and theta_c (rocker), in the frame of `position`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.wording import short
from gearlink.core.numerics.arrays import Mask, Reals
from gearlink.core.parts.linkages.fourbar.loop import BY_ANGLE, Reading, in_motion, refusal
from gearlink.core.parts.linkages.fourbar.position import FourBar, FourBarInverseState, FourBarState, inverse_reading

BLOCK = 8192


def solve(
    linkage: FourBar,
    crank_angle: ArrayLike,
    order: int = 0,
    *,
    velocity: ArrayLike = 1.0,
    acceleration: ArrayLike = 0.0,
    jerk: ArrayLike = 0.0,
) -> FourBarState[Reals]:
    """Angles of coupler and rocker over an array of crank angles, and their rates up to the wanted order.

    Parameters
        linkage : FourBar - of which the lengths may be columns; the angles then have a row for each, or are for all
        crank_angle : array of any shape [rad]
        order : 0..3 - 0 angles only, 1 velocities, 2 accelerations, 3 jerks too
        velocity, acceleration, jerk : float or array that broadcasts [rad/s, rad/s2, rad/s3] - motion of the
            crank; the defaults give the derivatives with respect to the crank angle
    Returns
        sweep : FourBarState - angles continuous in the crank angle as in `position.solve`
    Raises
        NoSolution - when the linkage does not close at one of the angles, or rates are wanted at a dead centre
    Example
        >>> sweep = solve(FourBar(18.0, 50.0, 100.0, 121.4), np.radians([45.0, 90.0]), order=1)
        >>> np.round(np.degrees(sweep.rocker_angle), 6).tolist()
        [146.168778, 148.374385]

    Source
        as `position.solve`
    """
    return FourBarState(*_driven(_angles(linkage.reading, crank_angle, order), velocity, acceleration, jerk))


def solve_inverse(
    linkage: FourBar | Reading,
    rocker_angle: ArrayLike,
    order: int = 0,
    *,
    velocity: ArrayLike = 1.0,
    acceleration: ArrayLike = 0.0,
    jerk: ArrayLike = 0.0,
) -> FourBarInverseState[Reals]:
    """Angles of crank and coupler over an array of rocker angles, the rocker driving, and their rates.

    Parameters
        linkage : FourBar - its assembly reads here: sign of sin(crank angle - coupler angle); or its inverse reading
        rocker_angle : array of any shape [rad]
        order : 0..3
        velocity, acceleration, jerk : float or array that broadcasts - motion of the rocker
    Returns
        sweep : FourBarInverseState - angles continuous in the rocker angle as in `position.solve_inverse`
    Raises
        NoSolution - as in `position.solve_inverse`
    Example
        >>> drag = FourBar(50.0, 45.0, 48.0, 20.0)
        >>> turn = np.array([0.0, 3.0, 12.5])
        >>> np.round(solve_inverse(drag, solve(drag, turn).rocker_angle).crank_angle, 12).tolist()
        [0.0, 3.0, 12.5]

    Source
        own derivation: exchange symmetry of the loop equation
    """
    reading = inverse_reading(linkage) if isinstance(linkage, FourBar) else linkage
    rows = _angles(reading, rocker_angle, order)
    rows[1] += math.pi
    coupler, crank, transmission, *rates = _driven(rows, velocity, acceleration, jerk)
    rates[0::2], rates[1::2] = rates[1::2], rates[0::2]
    return FourBarInverseState(crank, coupler, transmission, *rates)


def dead_point_distance(transmission_angle: ArrayLike) -> Reals:
    """Distance of the transmission angle from a dead centre, min(gamma, pi - gamma) [rad].

    Example
        >>> dead_point_distance(np.radians([30.0, 170.0])).round(6).tolist()
        [0.523599, 0.174533]
    """
    gamma = np.asarray(transmission_angle, dtype=np.float64)
    return np.minimum(gamma, np.pi - gamma)


def least_transmission_angle(crank: Reals, coupler: Reals, rocker: Reals, frame: Reals) -> Reals:
    """Minimum transmission angle of a revolution [rad], `FourBar.min_transmission_angle`; NaN where the crank stops.

    tan^2(gamma/2) = (x - (b - c))(x + (b - c))/((b + c - x)(b + c + x)),   x = |d - a| and d + a

    Example
        >>> lengths = (np.array([x]) for x in (18.0, 50.0, 100.0, 121.4))
        >>> np.degrees(least_transmission_angle(*lengths)).round(6).tolist()
        [46.113185]
    """
    found = []
    for apart in (np.abs(frame - crank), frame + crank):
        q = (apart - (coupler - rocker)) * (apart + (coupler - rocker))
        p = (coupler + rocker - apart) * (coupler + rocker + apart)
        found.append(dead_point_distance(2.0 * np.arctan2(np.sqrt(q), np.sqrt(p))))
    return np.asarray(np.minimum(*found))


def _driven(rows: list[Reals], velocity: ArrayLike, acceleration: ArrayLike, jerk: ArrayLike) -> list[Reals]:
    """Rows whose derivatives with respect to the driving angle became time derivatives for the driver's motion."""
    motion = (velocity, acceleration, jerk)
    if len(rows) == 3 or (all(np.ndim(x) == 0 for x in motion) and motion == BY_ANGLE):
        return rows
    return [*rows[:3], *in_motion(rows[3:], *(np.asarray(x, dtype=np.float64) for x in motion))]


def _angles(reading: Reading, driving: ArrayLike, order: int) -> list[Reals]:
    """Rows of `_write_angles` and `_rates` in the shape of the driving angles, or of many linkages' constants."""
    angle = np.asarray(driving, dtype=np.float64)
    constants: tuple[Any, ...] = reading
    columns = [len(each) for each in constants if isinstance(each, np.ndarray)]
    if columns:
        angle = np.broadcast_to(angle, (columns[0], angle.shape[-1]))
    phi = np.ascontiguousarray(angle)
    rows = _sweep(reading, phi if columns else phi.ravel(), order)
    return [row.reshape(angle.shape) for row in rows]


Scratch = tuple[Reals, ...]


def _sweep(reading: Reading, phi: Reals, order: int) -> Reals:
    """Rows of the angles and then the pairs of rates, block by block.

    Where constants are columns phi has rows, of which a block holds some.
    """
    if not 0 <= order <= 3:
        raise ValueError(f"order is {order}; the rates go from 0 to 3")
    out = np.empty((3 + 2 * order, *phi.shape))
    size = BLOCK if phi.ndim == 1 else max(1, BLOCK // max(1, phi.shape[1]))
    scratch = np.empty((11, min(len(phi), size), *phi.shape[1:]))
    with np.errstate(invalid="ignore", divide="ignore"):
        for start in range(0, len(phi), size):
            some = slice(start, start + size)
            angle, block = phi[some], out[:, some]
            own = reading if phi.ndim == 1 else _of_some(reading, some)
            rows = tuple(scratch[:, : len(angle)])
            _triangle(own, angle, order, rows)
            _write_angles(own, angle, rows, block)
            if order > 0:
                _rates(own, rows, block[3:])
    return out


def _of_some(reading: Reading, some: slice) -> Reading:
    """The constants of some of many linkages."""
    constants: tuple[Any, ...] = reading
    return Reading._make(each[some] if isinstance(each, np.ndarray) else each for each in constants)


def _triangle(reading: Reading, phi: Reals, order: int, rows: Scratch) -> None:
    """Rows t, t^2, 1 + t^2, and times 1 + t^2: n^2, R, (P - Q)/2, then Q/P; refuse where P Q is not positive."""
    t, tt, one, n, r, z, q, ratio, *_ = rows
    np.multiply(phi, 0.5, out=t)
    np.tan(t, out=t)
    np.multiply(t, t, out=tt)
    np.add(tt, 1.0, out=one)
    _linear(reading.n_0, reading.n_pi, tt, n)
    _linear(reading.p_0, reading.p_pi, tt, z)
    _linear(reading.q_0, reading.q_pi, tt, q)
    np.multiply(z, q, out=r)
    if not r.min() > 0.0:
        _refuse(reading, phi, order, z, q, n)
    np.sqrt(r, out=r)
    np.divide(q, z, out=ratio)
    np.subtract(z, q, out=z)
    np.multiply(z, 0.5, out=z)


def _linear(at_0: float, at_pi: float, tt: Reals, out: Reals) -> None:
    """at_0 + at_pi t^2."""
    np.multiply(tt, at_pi, out=out)
    np.add(out, at_0, out=out)


def _refuse(reading: Reading, phi: Reals, order: int, p: Reals, q: Reals, n: Reals) -> None:
    """Raise for the first angle that has no position, or no rates when rates are wanted."""
    if phi.ndim > 1:
        raise NoSolution("one of the four-bars does not close, or has no rates")
    product = p * q
    good = (product > 0.0) | ((product == 0.0) & (n > 0.0)) if order == 0 else product > 0.0
    if not good.all():
        i = int(np.argmin(good))
        raise refusal(reading, float(phi[i]), float(p[i]), float(q[i]))


def _write_angles(reading: Reading, phi: Reals, rows: Scratch, out: Reals) -> None:
    """Coupler, rocker and transmission angle, continuous as in `loop.solve_loop`.

    tan^2(gamma/2) = Q/P,   rocker = coupler + s gamma. R is at least 0, and D seen from B is never behind it, so that
    the arc tangents of quotients are in their quadrants; a dead centre makes a quotient infinite, and its angle exact.

    Of many linkages all have a driving link that is longer than the frame, or none has, and are read the same way.
    """
    t, tt, one, n, r, _, x, y, nu, *_ = rows
    coupler, rocker, gamma = out[:3]
    a, d, s = reading.a, reading.d, float(reading.s)
    np.sqrt(y, out=y)
    np.arctan(y, out=y)
    np.multiply(y, 2.0, out=gamma)
    ahead, longer = (d > 0.0, a > abs(d)) if phi.ndim == 1 else (np.all(d > 0.0), np.all(a > abs(d)))
    if longer:
        _arg(2.0 * d, a - d, a + d, t, tt, x, nu)
        np.add(nu, phi, out=nu)
    else:
        side = 1.0 if ahead else -1.0
        _arg(-2.0 * a * side, (d - a) * side, (d + a) * side, t, tt, x, nu)
    np.multiply(one, reading.e, out=x)
    np.add(x, n, out=x)
    np.divide(x, r, out=x)
    np.arctan(x, out=x)
    # From B the coupler is s (pi/2 - x) off the direction of D; of the crank's own half revolution see `loop`.
    np.subtract(s * (0.5 * math.pi) - (math.pi if longer and ahead else 0.0), np.multiply(x, s, out=x), out=x)
    np.add(nu, x, out=coupler)
    np.add(coupler, np.multiply(gamma, s, out=x), out=rocker)


def _arg(sine: float, at_0: float, at_pi: float, t: Reals, tt: Reals, scratch: Reals, out: Reals) -> None:
    """Angle of the vector (at_0 + at_pi t^2, sine t), of which the first part is positive."""
    _linear(at_0, at_pi, tt, scratch)
    np.multiply(t, sine, out=out)
    np.divide(out, scratch, out=out)
    np.arctan(out, out=out)


def _rates(reading: Reading, rows: Scratch, out: Reals) -> None:
    """Pairs (coupler, rocker) of derivatives, as many as `out` has rows for; see `loop.rates`.

    Rows used: 1/n^2 = one m and 1/R = one r instead of n and R, g' and h.
    """
    t, tt, one, m, r, _, hn, g_1, h, _, u_1 = rows
    a, d, e, s = reading.a, reading.d, reading.e, float(reading.s)
    ad = a * d
    np.divide(s, r, out=r)
    np.divide(1.0, m, out=m)
    np.multiply(one, m, out=hn)
    np.multiply(t, 4.0 * ad, out=g_1)
    np.multiply(g_1, r, out=g_1)
    np.multiply(hn, 0.5 * e, out=h)
    np.add(h, 0.5, out=h)
    np.multiply(g_1, h, out=out[1])
    _linear(a * (a - d), a * (a + d), tt, u_1)
    np.multiply(u_1, m, out=u_1)
    np.add(out[1], u_1, out=out[1])
    np.subtract(out[1], g_1, out=out[0])
    if len(out) > 2:
        _second(ad, e, reading.f, rows, out[2:])


def _second(ad: float, e: float, f: float, rows: Scratch, out: Reals) -> None:
    """Accelerations; afterwards m holds 1/n^4 over 1 + t^2, z s cot(gamma), u_1 (n^2)'/(2 n^4)."""
    t, tt, _, m, r, z, hn, g_1, h, g_2, u_1 = rows
    np.multiply(z, r, out=z)
    np.multiply(tt, -2.0 * ad, out=g_2)
    np.add(g_2, 2.0 * ad, out=g_2)
    np.multiply(g_2, r, out=g_2)
    np.multiply(g_1, g_1, out=u_1)
    np.multiply(u_1, z, out=u_1)
    np.subtract(g_2, u_1, out=g_2)
    np.multiply(hn, m, out=m)
    np.multiply(t, 2.0 * ad, out=u_1)
    np.multiply(u_1, m, out=u_1)
    np.multiply(g_1, e, out=out[0])
    np.add(out[0], 2.0 * f, out=out[0])
    np.multiply(out[0], u_1, out=out[0])
    np.multiply(g_2, h, out=out[1])
    np.subtract(out[1], out[0], out=out[1])
    np.subtract(out[1], g_2, out=out[0])
    if len(out) > 2:
        _third(ad, e, f, rows, out[2:])


def _third(ad: float, e: float, f: float, rows: Scratch, out: Reals) -> None:
    """Jerks; not on the fast path, so written plainly. Rows as `_second` leaves them."""
    t, tt, one, m, _, cot, hn, g_1, h, g_2, u_1 = rows
    u_2 = ad * (1.0 - tt) * m - 8.0 * ad * t / one * hn * u_1
    g_3 = g_1 * (g_1 * g_1 - 1.0) - 3.0 * g_1 * g_2 * cot
    out[1] = g_3 * h - 2.0 * e * g_2 * u_1 - u_2 * (2.0 * f + e * g_1)
    np.subtract(out[1], g_3, out=out[0])


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


def solve_by_newton(
    linkage: FourBar, crank_angle: ArrayLike, over: tuple[float | Reals, float | Reals] | None = None
) -> NewtonSweep:
    """Positions over an array of crank angles, each from the motion's place at an anchor up to 2.5 degrees away.

    theta = theta(anchor) + h theta' + h^2 theta''/2,   h = phi - anchor,   then `polish`

    Parameters
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
        >>> found = solve_by_newton(FourBar(18.0, 50.0, 100.0, 121.4), np.radians([45.0, 300.0]))
        >>> np.round(np.degrees(found.rocker_angle), 9).tolist()
        [146.168778216, 161.772190585]

    Source
        swing-gripper paper (4); anchors: own derivation
    """
    phi = np.asarray(crank_angle, dtype=np.float64)
    if phi.size == 0:
        return NewtonSweep(phi.copy(), phi.copy(), np.zeros(phi.shape, dtype=np.int64), phi.copy())
    low, high = (phi.min(), phi.max()) if over is None else (np.minimum(*over), np.maximum(*over))
    h = phi - np.minimum(low + _ANCHOR_STEP * np.rint((phi - low) / _ANCHOR_STEP), high)
    for _ in range(_MOST_HALVINGS):
        at = solve(linkage, phi - h, 2)
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
    near = r <= np.minimum(linkage.coupler, linkage.rocker) * sine**2 / (2.0 + 2.0 * np.abs(cosine))
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
        crank_angle, coupler_angle, rocker_angle : arrays that broadcast [rad] - the starts
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
    lengths = np.maximum(linkage.crank, linkage.coupler), np.maximum(linkage.rocker, linkage.frame)
    longest = np.maximum(*lengths)
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
        at, limit = np.unravel_index(np.argmin(good), good.shape), np.broadcast_to(limit, good.shape)
        raise NoSolution(
            f"Newton-Raphson found no position of assembly {linkage.assembly:+d} at crank angle "
            f"{short(math.degrees(phi[at]))} deg: the loop is open by {residual[at]:.3g} mm (limit "
            f"{limit[at]:.3g} mm) after at most {MOST_ITERATIONS} iterations; the linkage does not "
            "close there, or the start lies too far off",
            fix="use the closed form's position as the start",
        )
    return np.asarray(residual)
