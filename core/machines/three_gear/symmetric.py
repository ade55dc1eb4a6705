"""The three-gear four-bar with I = 1, the symmetric family: its links, back-step and dwells, exactly.

Crank and output gear have equal teeth and b = c. With the crank as unit the family has the frame ratio d > 1 and
coupler and rocker b = c = sqrt((1 + d^2)/2); the angle between them then swings symmetrically about 90 deg,
cos(gamma) = k cos(phi) with k = 2d/(1 + d^2), and the speed ratio of the output is

    W = 1 + 2 d (1 - i3) sin(phi)/sqrt((d^2 - 1)^2 + (2 d sin(phi))^2)

Back-step and dwell follow from two numbers, n = 1 - i3 > 1 and h = phi12/2, half the crank angle of the back-step:
around the crank angle 270 deg (90 deg in the mirrored assembly)

    W(270 deg + y) = 1 - n k cos(y)/sqrt(1 - k^2 sin^2(y)),    1/k = sqrt(n^2 cos^2(h) + sin^2(h))

Differences that vanish like h^3 (back-step, regained place) are formed from series or integrals, not from the
angles themselves, so a design next to the momentary dwell keeps all its digits.

Within +-tau of a place that is free to choose the output stays longest where the back-step D equals the whole band
2 tau: it then touches both edges twice, as a Chebyshev polynomial does. With half the window Y,

    D(h) = 2 tau,   phi5(270 deg + Y) - phi5(270 deg - h) = 0,   window = 2 Y = 2 phi13 - phi12

which for tau -> 0 is 4/3 of phi13 and 4^(1/3) = 1.59 times the window of the momentary dwell. A back-step that exceeds
the band by a last bit leaves only phi13 of it: the window jumps there, so no design aims at the limit itself.

Other teeth: `gearlink.core.machines.three_gear.dwell` and `momentary`.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, Any, NamedTuple

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_above, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short, unlike
from gearlink.core.machines.three_gear.dwell import Output
from gearlink.core.machines.three_gear.momentary import wrap
from gearlink.core.machines.three_gear.train import GearTrain
from gearlink.core.numerics.elementary import SCALARS, Elementary
from gearlink.core.numerics.gauss import GAUSS_NODES, GAUSS_WEIGHTS
from gearlink.core.numerics.roots import bracketed_root, maximum, newton_root
from gearlink.core.parts.linkages.fourbar.position import FourBar
from gearlink.core.parts.linkages.standstills import BackStep, Turning

if TYPE_CHECKING:
    from gearlink.core.parts.linkages.band_dwell import ToleranceDwell

# tan h: the closed form then loses no more than 12 ulp, and the 29th term is below 1e-17 of the first.
_SERIES_BELOW = 0.5
_INTEGRAL_BELOW = 0.2  # h [rad]; ten Gauss points over 4 h are then exact to rounding
_POLISHED_BELOW = 0.75  # h [rad]; the closed form loses some ulp / h^2, which a step with the integral gives back
_POLISHED_I3 = -0.1
_QUARTER = 0.5 * math.pi
_PART = 0.6  # longest stretch [rad] of that integral for ten Gauss points
_NODES = tuple((s * x, w) for x, w in zip(GAUSS_NODES, GAUSS_WEIGHTS, strict=True) for s in (-1.0, 1.0))
_INSIDE = 1e-9
_NEAREST, _FARTHEST = 0.1, 1e3  # -i3 between which the maximum idler is sought


class SpeedLimits(NamedTuple):
    """Maximum and minimum output speed per input speed."""

    greatest: Any
    least: Any


def frame_ratio_for_back_step(i3: float, back_step_crank_angle: float) -> float:
    """Frame ratio d that gives a wanted crank angle of the back-step.

    d = s cos(h) + sqrt(s^2 cos^2(h) + 1),   s = sqrt(i3 (i3 - 2)),   h = phi12/2

    Parameters
        i3 : float - ratio of idler and output gear, -z3/z5, negative
        back_step_crank_angle : float [rad] - phi12, crank angle between the two standstills, 0 <= phi12 < pi;
            0 is the momentary dwell
    Returns
        frame_ratio : float - frame over crank, above 1
    Raises
        NoSolution - for i3 >= 0 or phi12 outside [0, pi)
    Example
        >>> round(frame_ratio_for_back_step(-1.8, math.radians(90.0)), 13)
        3.9517038050536

    Source
        thesis (4-18)
    """
    check_ratio(i3)
    check_back_step_crank_angle(back_step_crank_angle)
    found: float = frame_ratio(i3, 0.5 * back_step_crank_angle)
    return found


def frame_ratio(i3: Any, h: Any, fn: Elementary = SCALARS) -> Any:
    """d of a back-step over 2 h, as `frame_ratio_for_back_step`, of numbers or of arrays."""
    sc = fn.sqrt(i3 * (i3 - 2.0)) * fn.cos(h)
    return sc + fn.hypot(sc, 1.0)


def frame_ratio_for_speed_band(i3: float, lowest_speed: float, highest_speed: float) -> float:
    """Frame ratio d that makes the output run between two speeds, the input turning at their mean.

    d = q + sqrt(q^2 - 1),   q = 2 (1 - i3)/delta,   delta = 2 (n_max - n_min)/(n_max + n_min)

    Parameters
        i3 : float - negative
        lowest_speed, highest_speed : float [any unit of speed] - 0 <= n_min < n_max; 0 is the momentary dwell
    Returns
        frame_ratio : float - above 1
    Raises
        NoSolution - for i3 >= 0, n_min < 0 or n_max <= n_min
    Example
        >>> round(frame_ratio_for_speed_band(-1.05, 100.0, 300.0), 14)
        8.07617907041421

    Source
        thesis (4-20)
    """
    check_ratio(i3)
    low, high = lowest_speed, highest_speed
    if not (0.0 <= low < high < math.inf):
        raise NoSolution(
            f"speed: {short(low)} to {short(high)} 1/min (0 <= min < max: the output of this synthesis turns one way)",
            fix="set speed.max above speed.min" if low >= 0.0 else "set speed.min to 0 or more, or use synth back-step",
        )
    found: float = frame_ratio_between(i3, low, high)
    return found


def frame_ratio_between(i3: Any, low: Any, high: Any, fn: Elementary = SCALARS) -> Any:
    """d of a speed band, as `frame_ratio_for_speed_band`, of numbers or of arrays."""
    q = (1.0 - i3) * ((high + low) / (high - low))
    return q + fn.sqrt((q - 1.0) * (q + 1.0))


def speed_ratio_limits(i3: Any, frame_ratio: Any) -> SpeedLimits:
    """Maximum and minimum speed ratio of the output, taken at the crank angles 90 and 270 deg.

    W_max, W_min = 1 +- 2 (1 - i3) d/(d^2 + 1)

    Parameters
        i3, frame_ratio : float or array - i3 < 0, d > 1
    Returns
        W_max, W_min : SpeedLimits
    Example
        >>> [round(w, 12) for w in speed_ratio_limits(-1.05, 8.07617907041421)]
        [1.5, 0.5]

    Source
        thesis (4-13)
    """
    swing = 2.0 * (1.0 - i3) * frame_ratio / (frame_ratio * frame_ratio + 1.0)
    return SpeedLimits(1.0 + swing, 1.0 - swing)


def peak_acceleration_ratio(i3: float, frame_ratio: float) -> float:
    """Maximum acceleration ratio of the output, taken at the crank angles 0 and 180 deg.

    |e5|max/w1^2 = 2 (1 - i3) d/(d^2 - 1)

    Raises
        NoSolution - for i3 >= 0 or d <= 1
    Example
        >>> round(peak_acceleration_ratio(-1.8, 3.951703805053557), 12)
        1.51406659722

    Source
        thesis (4-13), differentiated
    """
    check_ratio(i3)
    _check_frame_ratio(frame_ratio)
    return 2.0 * (1.0 - i3) * frame_ratio / ((frame_ratio - 1.0) * (frame_ratio + 1.0))


def symmetric_linkage(frame_ratio: float, center_distance: float, assembly: int = 1) -> FourBar:
    """Four-bar of the family from its frame ratio and the gears' centre distance.

    b = c = m (z1 + z3)/2,   a = b/sqrt((1 + d^2)/2),   frame = d a

    Parameters
        frame_ratio : float - d > 1
        center_distance : float [mm] - of gears 1 and 3, which is that of 3 and 5
        assembly : +1 or -1
    Returns
        linkage : FourBar [mm] - a crank-rocker for every d > 1
    Raises
        NoSolution - for d <= 1
    Example
        >>> linkage = symmetric_linkage(3.951703805053557, 112.0)
        >>> round(linkage.crank, 9), round(linkage.frame, 9)
        (38.857089061, 153.551706697)

    Source
        thesis (4-10)
    """
    _check_frame_ratio(frame_ratio)
    crank = crank_length(frame_ratio, center_distance)
    return FourBar(crank, center_distance, center_distance, frame_ratio * crank, assembly)


def crank_length(d: Any, center_distance: Any, fn: Elementary = SCALARS) -> Any:
    """a of `symmetric_linkage`, of numbers or of arrays."""
    return center_distance / fn.sqrt(0.5 * (1.0 + d * d))


def check_ratio(i3: float) -> None:
    """Refuse a ratio of idler and output gear that is not an external mesh's."""
    if not -math.inf < i3 < 0.0:
        raise NoSolution(
            f"i3: {short(i3)} (limit < 0: i3 = -z3/z5, idler and output gear mesh externally)",
            fix="give a ratio below 0, such as -1.2",
        )


def check_back_step_crank_angle(phi12: float) -> None:
    """Refuse a crank angle of the back-step outside [0, pi)."""
    if not 0.0 <= phi12 < math.pi:
        raise NoSolution(
            f"crank angle of the back-step: {unlike(math.degrees(phi12), 180.0)} deg (from 0, a momentary dwell, to "
            "below 180 deg)"
        )


def _check_frame_ratio(d: float) -> None:
    if not 1.0 < d < math.inf:
        raise NoSolution(f"frame over crank: {unlike(d, 1.0)} (limit > 1, where the linkage folds flat)")


def back_step_angle(i3: float, back_step_crank_angle: float) -> float:
    """Angle by which the output turns back, as a magnitude.

    |phi5(2) - phi5(1)| = 2 n atan(tan(h)/n) - 2 h,   n = 1 - i3,   h = phi12/2

    Parameters
        i3 : float - negative
        back_step_crank_angle : float [rad] - phi12, 0 <= phi12 < pi
    Returns
        angle : float [rad] - 0 at phi12 = 0, below 2 tan(h) - 2 h and below -i3 pi
    Raises
        NoSolution - for i3 >= 0 or phi12 outside [0, pi)
    Notes
        A series in tan(h) for small h and an addition theorem for larger: some ulp everywhere, where the plain
        formula keeps 1 ulp / h^2.
    Example
        >>> round(math.degrees(back_step_angle(-2.0, math.radians(120.0))), 12)
        60.0

    Source
        thesis (4-19)
    """
    check_ratio(i3)
    check_back_step_crank_angle(back_step_crank_angle)
    return _back_step(i3 / (i3 - 1.0), 0.5 * back_step_crank_angle)


def i3_for_back_step(back_step_angle: float, back_step_crank_angle: float) -> float:
    """Gear ratio i3 that turns the output back by a wanted angle within a wanted crank angle.

    2 n atan(tan(h)/n) - 2 h = angle   solved for   n = 1 - i3

    Parameters
        back_step_angle : float [rad] - magnitude, 0 < angle < 2 tan(h) - 2 h
        back_step_crank_angle : float [rad] - phi12 = 2 h, 0 < phi12 < pi
    Returns
        i3 : float - negative
    Raises
        NoSolution - for an angle outside the range: i3 -> 0 and i3 -> -infinity are its ends
    Notes
        Bracketed root in (n - 1)/n, monotone; the condition number grows at the upper limit, where i3 -> -infinity.
    Example
        >>> round(i3_for_back_step(math.radians(20.0), math.radians(90.0)), 12)
        -1.779808035671

    Source
        thesis (4-19), inverted; thesis figure 4-5
    """
    check_back_step_crank_angle(back_step_crank_angle)
    h = 0.5 * back_step_crank_angle
    limit = _back_step(1.0, h)
    if not 0.0 < back_step_angle < limit:
        raise NoSolution(
            f"back-step within {_deg(2.0 * h)} deg of the crank: {_deg(back_step_angle, limit)} deg (above 0, "
            f"below {_deg(limit, back_step_angle)} deg)",
            fix=f"set back_step.angle below {safely_below(math.degrees(limit))} deg, or increase back_step.crank_angle",
        )
    v = bracketed_root(lambda v: _back_step(v, h) - back_step_angle, 0.0, 1.0)
    if v == 1.0:
        raise NoSolution(
            f"a back-step of {_deg(back_step_angle)} deg within {_deg(2.0 * h)} deg of the crank is the limit, "
            f"{_deg(limit)} deg, to rounding, and needs an infinite idler",
            fix=f"set back_step.angle below {safely_below(math.degrees(limit))} deg, or increase back_step.crank_angle",
        )
    return -v / (1.0 - v)


def crank_angle_for_back_step(i3: float, back_step_angle: float) -> float:
    """Crank angle phi12 for which the output of given gears turns back by a wanted angle.

    Parameters
        i3 : float - negative
        back_step_angle : float [rad] - magnitude, 0 < angle < -i3 pi
    Returns
        phi12 : float [rad] - 0 < phi12 < pi
    Raises
        NoSolution - for an angle outside the range
    Notes
        Bracketed root of `back_step_angle`, which rises monotonically from 0 to -i3 pi.
    Example
        >>> round(math.degrees(crank_angle_for_back_step(-2.0, math.radians(60.0))), 9)
        120.0

    Source
        thesis (4-19), inverted
    """
    check_ratio(i3)
    limit = -i3 * math.pi
    if not 0.0 < back_step_angle < limit:
        raise NoSolution(
            f"back-step: {_deg(back_step_angle, limit)} deg (above 0, below -i3 * 180 = "
            f"{_deg(limit, back_step_angle)} deg; i3 {short(i3)})",
            fix=f"set back_step.angle below {safely_below(math.degrees(limit))} deg, or use an idler of more teeth",
        )
    n, v = 1.0 - i3, i3 / (i3 - 1.0)
    h: float = half_angle_for_back_step(n, back_step_angle)
    return 2.0 * newton_root(lambda h: (_back_step(v, h) - back_step_angle, back_step(n, h)[1]), 0.0, _QUARTER, h)


def dwell_angle(i3: float, back_step_crank_angle: float) -> float:
    """Crank angle phi13 from the start of the back-step to where the output is back at its starting position, exactly.

    n [asin(k sin(y)) + asin(k sin(h))] = h + y,   phi13 = y + h,   h = phi12/2

    Parameters
        i3 : float - negative
        back_step_crank_angle : float [rad] - phi12, 0 <= phi12 < pi
    Returns
        phi13 : float [rad] - between phi12 and 2 phi12; 1.5 phi12 exactly for i3 = -2 and for phi12 -> 0
    Raises
        NoSolution - for i3 >= 0 or phi12 outside [0, pi)
    Notes
        Bracketed root of a function that falls monotonically from y = h on; within 6 ulp for i3 <= -0.1. The thesis
        takes 1.5 phi12 (4-17), which is within 3 % for phi12 <= 90 deg and i3 <= -1.
    Example
        >>> round(math.degrees(dwell_angle(-1.0, math.radians(90.0))), 10)
        131.4096221093

    Source
        own derivation: thesis (4-16) set to zero; thesis (4-17) is its approximation
    """
    check_ratio(i3)
    check_back_step_crank_angle(back_step_crank_angle)
    h = 0.5 * back_step_crank_angle
    if h == 0.0:
        return 0.0
    y: float = regained(1.0 - i3, h)
    if _by_integral(i3, h):
        ends = 0.5 * y, 2.0 * y
        y = newton_root(lambda y: (-_fallen_by_integral(i3, h, y), above(y, 1.0 - i3, h)[1]), *ends, y)
    return h + y


def dwell_angle_limit(i3: Any) -> Any:
    """Upper limit of the dwell angle phi13, approached as phi12 -> pi and the frame ratio -> 1; of one i3 < 0 or many.

    phi13 < 2 pi (1 - i3)/(2 - i3)

    Example
        >>> round(math.degrees(dwell_angle_limit(-1.0)), 9)
        240.0
    """
    return 2.0 * math.pi * (1.0 - i3) / (2.0 - i3)


def crank_angle_for_dwell(i3: float, dwell_angle: float) -> float:
    """Crank angle of the back-step phi12 for which the dwell angle phi13 is met exactly.

    Parameters
        i3 : float - negative
        dwell_angle : float [rad] - phi13, 0 < phi13 < 2 pi (1 - i3)/(2 - i3)
    Returns
        phi12 : float [rad] - between phi13/2 and phi13; about phi13/1.5
    Raises
        NoSolution - for a dwell angle outside the range
    Notes
        Bracketed root in h of the equation of `dwell_angle` with y = phi13 - h.
    Example
        >>> round(math.degrees(crank_angle_for_dwell(-1.8, math.radians(135.0))), 9)
        90.30114714

    Source
        own derivation: thesis (4-16) set to zero
    """
    check_ratio(i3)
    limit: float = dwell_angle_limit(i3)
    if not 0.0 < dwell_angle < limit:
        raise NoSolution(
            f"dwell angle: {_deg(dwell_angle, limit)} deg (above 0, below 360 (1 - i3)/(2 - i3) = "
            f"{_deg(limit, dwell_angle)} deg; i3 {short(i3)})",
            fix=f"reduce dwell.angle{_ratio_remedy(dwell_angle)}",
        )
    h: float = half_angle_for_dwell(1.0 - i3, dwell_angle)
    return 2.0 * _polished(i3, h, -1.0, dwell_angle - h)


def window_limit(i3: Any) -> Any:
    """Upper limit of the crank angle of an equal-ripple dwell, whatever the tolerance; of one i3 or many.

    Phi < 4 pi n/(n + 1) - pi,   n = 1 - i3

    Example
        >>> round(math.degrees(window_limit(-1.8)), 9)
        350.526315789
    """
    return math.pi * (3.0 * (1.0 - i3) - 1.0) / (2.0 - i3)


def crank_angle_for_window(i3: float, window: float) -> float:
    """Crank angle phi12 of the back-step whose whole band the output touches twice over a window: the flattest.

    n [asin(k sin(Y)) + asin(k sin(h))] = Y + h,   Y = window/2,   h = phi12/2

    Parameters
        i3 : float - negative
        window : float [rad] - Phi, 0 < Phi < `window_limit`
    Returns
        phi12 : float [rad] - between Phi/3 and Phi; Phi/2 exactly for i3 = -2 and for Phi -> 0
    Raises
        NoSolution - for a window outside the range
    Notes
        Bracketed root in h of the equation of `dwell_angle` with y = Phi/2, polished as there.
    Example
        >>> round(math.degrees(crank_angle_for_window(-1.8, math.radians(90.0))), 9)
        45.052599378

    Source
        own derivation: by the oddness of the motion about 270 deg the output spans the band from phi(2) on one side
        to phi(1) on the other
    """
    check_ratio(i3)
    limit: float = window_limit(i3)
    if not 0.0 < window < limit:
        raise NoSolution(
            f"dwell window: {_deg(window, limit)} deg (above 0, below {_deg(limit, window)} deg with any "
            f"tolerance that a back-step fills; i3 {short(i3)})",
            fix=f"set dwell.window below {safely_below(math.degrees(limit))} deg",
        )
    h: float = half_angle_for_window(1.0 - i3, window)
    return 2.0 * _polished(i3, h, 0.0, 0.5 * window)


# One design or many; many do without the last digits, which series and integrals give to one


def _back_step(v: float, h: float) -> float:
    """Equation (4-19) in v = (n - 1)/n, 0 <= v <= 1 (1: i3 = -infinity), and h, to the last digits."""
    t, x = math.tan(h), 1.0 - v
    if t < _SERIES_BELOW:
        log_x = math.log1p(-v) if v < 1.0 else -math.inf
        terms = ((-1.0) ** j * t ** (2 * j + 1) / (2 * j + 1) * math.expm1(2 * j * log_x) for j in range(28, 0, -1))
        return 2.0 * sum(terms)
    # n atan(t/n) - atan(t) with the part (n - 1) drawn out of both terms
    first = v * math.atan(t * x) / x if x > 0.0 else t
    return 2.0 * (first - math.atan(v / (1.0 / t + x * t)))


def back_step(n: Any, h: Any, fn: Elementary = SCALARS) -> tuple[Any, Any]:
    """The back-step [rad] over 2 h as a difference, which loses digits as 1/h^2, and its derivative by h."""
    squares = n * n - 1.0
    slope = 2.0 * squares * fn.sin(h) ** 2 / (1.0 + squares * fn.cos(h) ** 2)
    return 2.0 * (n * fn.atan2(fn.sin(h), n * fn.cos(h)) - h), slope


def half_angle_for_back_step(n: Any, angle: Any, fn: Elementary = SCALARS) -> Any:
    """h of a back-step [rad]."""

    def missing(h: Any, n: Any, angle: Any) -> tuple[Any, Any]:
        value, slope = back_step(n, h, fn)
        return value - angle, slope

    start = fn.least(fn.cbrt(1.5 * angle / (1.0 - 1.0 / (n * n))), 0.9 * _QUARTER)
    return fn.root(missing, 0.0 * n, 0.0 * n + _QUARTER, start, n, angle)


def above(y: Any, n: Any, h: Any, fn: Elementary = SCALARS) -> tuple[Any, Any, Any]:
    """How far the output at 270 deg + y stands above its place at 270 deg - h, and its derivatives by y and by h.

    h + y - n [asin(k sin(y)) + asin(k sin(h))]
    """
    sin_h, cos_h, sin_y, cos_y, squares = fn.sin(h), fn.cos(h), fn.sin(y), fn.cos(y), n * n - 1.0
    constant = squares * cos_h * cos_h
    root, whole = fn.sqrt(constant + cos_y * cos_y), constant + 1.0
    value = h + y - n * (fn.atan2(sin_y, root) + fn.atan2(sin_h, n * cos_h))
    ahead = squares * (sin_y - sin_h) * (sin_y + sin_h) / (root * (root + n * abs(cos_y)))  # no digit lost at y = h
    by_h = -squares * sin_h / whole * (sin_h + n * sin_y * cos_h / root)
    return value, fn.where(cos_y > 0.0, ahead, 1.0 - n * cos_y / root), by_h


def regained(n: Any, h: Any, fn: Elementary = SCALARS) -> Any:
    """y where the output regains the place that it has at -h: phi13 = y + h."""
    high = fn.least(3.0 * h, 2.0 * math.pi * n / (n + 1.0) - h)
    # At y = h the value is smallest: beyond it it rises, and the root lies at about 2 h.
    return fn.root(lambda y, n, h: above(y, n, h, fn)[:2], h, high, fn.least(2.0 * h, high), n, h)


def half_angle_for_dwell(n: Any, phi13: Any, fn: Elementary = SCALARS) -> Any:
    """h whose place is regained after phi13: y = phi13 - h."""

    def missing(h: Any, n: Any, phi13: Any) -> tuple[Any, Any]:
        value, by_y, by_h = above(phi13 - h, n, h, fn)
        return -value, by_y - by_h

    high = fn.least(0.5 * phi13, _QUARTER)
    return fn.root(missing, 0.25 * phi13, high, fn.least(phi13 / 3.0, high), n, phi13)


def half_angle_for_window(n: Any, window: Any, fn: Elementary = SCALARS) -> Any:
    """h of the back-step whose band the output touches twice over a window: y = window/2 is given."""

    def missing(h: Any, n: Any, y: Any) -> tuple[Any, Any]:
        value, _, by_h = above(y, n, h, fn)
        return -value, -by_h

    y = 0.5 * window
    return fn.root(missing, y / 3.0, fn.least(y, _QUARTER), fn.least(0.5 * y, 0.9 * _QUARTER), n, y)


def _by_integral(i3: float, h: float) -> bool:
    """Whether the integral keeps digits that differences lose: ten Gauss points need a singularity far enough away."""
    return h < _INTEGRAL_BELOW or (i3 <= _POLISHED_I3 and h < _POLISHED_BELOW)


def _polished(i3: float, h: float, share: float, y: float) -> float:
    """h to the last digits by the integral.

    Parameters
        share : float - by what y = (y at h) + share times the change of h goes with h
    """
    if not _by_integral(i3, h):
        return h

    def missing(x: float) -> tuple[float, float]:
        _, by_y, by_h = above(y + share * (x - h), 1.0 - i3, x)
        return _fallen_by_integral(i3, x, y + share * (x - h)), -share * by_y - by_h

    return newton_root(missing, 0.5 * h, 2.0 * h, h)


def _fallen_by_integral(i3: float, h: float, y: float) -> float:
    """How far the output stands below: the integral of its backward speed from -h to y, without cancellation."""
    n, rest = 1.0 - i3, i3 * (i3 - 2.0)
    square, constant = math.sin(h) ** 2, rest * math.cos(h) ** 2
    count = math.ceil((h + y) / _PART)
    half = 0.5 * (h + y) / count
    total = 0.0
    for part in range(count):
        mean = (2 * part + 1) * half - h
        for x, w in _NODES:
            place = mean + x * half
            cosine = math.cos(place)
            root = math.sqrt(constant + cosine * cosine)
            if cosine < 0.0:
                total += w * (n * cosine / root - 1.0) / rest
            else:
                total += w * (square - math.sin(place) ** 2) / (root * (root + n * cosine))
    return rest * half * total


def _ratio_remedy(phi13: float) -> str:
    """The i3 from which on a dwell angle is within reach, where there is one."""
    if not 0.0 < phi13 < 2.0 * math.pi:
        return ""
    least = 2.0 * (phi13 - math.pi) / (2.0 * math.pi - phi13)
    return f" or use -i3 above {safely_above(least)} (an idler of more teeth)"


def longest_window(i3: float, tolerance: float) -> float:
    """Longest crank angle over which the output of given gears can stay within +- tolerance.

    window = 2 phi13 - phi12   of the mechanism whose back-step is 2 tau

    Parameters
        i3 : float - negative
        tolerance : float [rad] - tau, 0 < tau < min(pi, -i3 pi/2)
    Returns
        window : float [rad]
    Raises
        NoSolution - for a tolerance outside the range
    Notes
        Rises with the tolerance; falls with -i3 (an idler of more teeth) for narrow bands, see `reaching_ratios`.
    Example
        >>> round(math.degrees(longest_window(-1.8, math.radians(0.5))), 9)
        70.436491503

    Source
        own derivation: phi5 is odd about 270 deg and convex behind it, so no other frame has a longer window
    """
    phi12 = crank_angle_for_tolerance(i3, tolerance)
    return 2.0 * dwell_angle(i3, phi12) - phi12


def crank_angle_for_tolerance(i3: float, tolerance: float) -> float:
    """Crank angle phi12 of the back-step that fills the band: the mechanism of the longest window.

    Parameters
        i3 : float - negative
        tolerance : float [rad] - tau, 0 < tau < min(pi, -i3 pi/2)
    Returns
        phi12 : float [rad]
    Raises
        NoSolution - for a tolerance outside the range
    Example
        >>> round(math.degrees(crank_angle_for_tolerance(-1.8, math.radians(0.5))), 9)
        35.243222439
    """
    check_tolerance(i3, tolerance)
    return crank_angle_for_back_step(i3, 2.0 * tolerance)


def check_tolerance(i3: float, tolerance: float) -> None:
    """Refuse a tolerance that has no longest window.

    Raises
        NoSolution - naming the limit
    """
    check_ratio(i3)
    if not (tolerance > 0.0 and fills(i3, tolerance)):
        limit = min(math.pi, -0.5 * i3 * math.pi)
        raise NoSolution(
            f"dwell tolerance: {_deg(tolerance, limit)} deg (above 0, below {_deg(limit, tolerance)} deg; i3 "
            f"{short(i3)})",
            fix=f"set dwell.tolerance below {safely_below(math.degrees(limit))} deg",
        )


def least_tolerance(i3: float, window: float) -> float:
    """Minimum tolerance within which the output of given gears can stay over a window.

    Parameters
        i3 : float - negative
        window : float [rad] - below `window_limit`
    Returns
        tolerance : float [rad] - half the back-step of the flattest mechanism
    Raises
        NoSolution - for a window outside the range
    Example
        >>> round(math.degrees(least_tolerance(-1.8, math.radians(90.0))), 12)
        1.065660185005
    """
    return 0.5 * back_step_angle(i3, crank_angle_for_window(i3, window))


def frame_ratio_interval(i3: float, window: float, tolerance: float) -> tuple[float, float]:
    """Ratios of frame to crank between which the output stays within +- tolerance over a window.

    k_L from the back-step 2 tau,   k_X = sin((Phi/2 - tau)/n)/sin(Phi/2),   d = (1 + sqrt(1 - k^2))/k

    Parameters
        i3 : float - negative
        window : float [rad] - Phi, above 2 tau
        tolerance : float [rad] - tau, at least `least_tolerance`
    Returns
        low, high : float, float - at low the back-step fills the band (1 where none does: there the linkage folds, and
            does not turn), at high both ends of the window lie on its edges
    Raises
        NoSolution - where no frame meets both, or a linkage that turns evenly does
    Notes
        The window jumps at low, never at high: aim between.
    Example
        >>> low, high = frame_ratio_interval(-1.8, math.radians(60.0), math.radians(0.5))
        >>> round(low, 9), round(high, 9)
        (5.178348984, 5.279603809)
    """
    if not window > 2.0 * tolerance:
        raise NoSolution(
            f"a uniform motion stays within +-{_deg(tolerance)} deg over {_deg(2.0 * tolerance)} deg of the crank: "
            f"a window of {_deg(window)} deg needs no linkage",
            fix=f"set dwell.window above {safely_above(math.degrees(2.0 * tolerance))} deg",
        )
    check_reach(i3, window, tolerance)
    k = math.sin((0.5 * window - tolerance) / (1.0 - i3)) / math.sin(0.5 * window)
    high = (1.0 + math.sqrt((1.0 - k) * (1.0 + k))) / k
    if not fills(i3, tolerance):
        return 1.0, high
    return min(frame_ratio_for_back_step(i3, crank_angle_for_tolerance(i3, tolerance)), high), high


def reach(i3: float, tolerance: float) -> float:
    """The windows that given gears have a flattest mechanism for within a tolerance lie below this or, where a
    back-step fills the band, are this at most.

    Parameters
        i3 : float - negative
        tolerance : float [rad] - below pi
    Returns
        window : float [rad] - `longest_window`; `window_limit` where every back-step is narrower than the band
    """
    return longest_window(i3, tolerance) if fills(i3, tolerance) else window_limit(i3)


def fills(i3: float, tolerance: float) -> bool:
    """Whether a back-step of given gears fills the band of a tolerance [rad]: below -i3 pi/2, half of the greatest."""
    return tolerance < min(math.pi, -0.5 * i3 * math.pi)


def check_reach(i3: float, window: float, tolerance: float) -> None:
    """Refuse a window that no frame of given gears reaches within a tolerance.

    Raises
        NoSolution - naming the longest window, the minimum tolerance and the nearest idler ratio
    """
    longest = reach(i3, tolerance)
    if window < longest or (window == longest and fills(i3, tolerance)):
        return
    most = safely_below(math.degrees(longest))
    limits = f"limit {'<=' if fills(i3, tolerance) else '<'} {most} deg with i3 {short(i3)}"
    if window < window_limit(i3):
        limits += f", or +-{safely_above(math.degrees(least_tolerance(i3, window)))} deg"
    raise NoSolution(
        f"dwell within +-{_deg(tolerance)} deg: {_deg(window)} deg ({limits})",
        fix=f"set dwell.window to at most {most} deg{_other_idler(i3, window, tolerance)}",
    )


def _other_idler(i3: float, window: float, tolerance: float) -> str:
    """The idler that reaches a window which this one does not, in words; empty where none does."""
    ratios = reaching_ratios(window, tolerance)
    if ratios is None:
        return ""
    if -i3 < ratios[0]:
        return f", or use -i3 of at least {safely_above(ratios[0])} (a larger idler)"
    return f", or use -i3 of at most {safely_below(ratios[1])} (a smaller idler)"


@lru_cache
def reaching_ratios(window: float, tolerance: float) -> tuple[float, float] | None:
    """Minimum and maximum -i3 with which the output can stay within +- tolerance over a window.

    Parameters
        window, tolerance : float [rad]
    Returns
        low, high : float - idler teeth over output teeth, from 0.1 up; infinite where every greater ratio will do
        or None where none from 0.1 to 1000 does
    Notes
        The reach rises with -i3 up to a maximum, which lies at -i3 = 0.15 for a tolerance of 10 deg, at 2 for 30 deg
        and at infinity from 32 deg on, and falls from there. Kept, for where an idler is sought all that are refused
        ask for it.
    Example
        >>> round(reaching_ratios(math.radians(70.0), math.radians(0.5))[1], 6)
        2.020462
        >>> reaching_ratios(math.radians(60.0), math.radians(0.5))
        (0.1, inf)
        >>> [round(ratio, 6) for ratio in reaching_ratios(math.radians(218.0), math.radians(20.0))]
        [0.264135, 1.043444]
    """

    def spare(logarithm: float) -> float:
        return reach(-math.exp(logarithm), tolerance) - window

    nearest, farthest = math.log(_NEAREST), math.log(_FARTHEST)
    best, most = maximum(spare, nearest, farthest)
    if most < 0.0:
        return None
    low, high = _NEAREST, _FARTHEST
    if spare(nearest) < 0.0:
        low = math.exp(bracketed_root(spare, nearest, best)) * (1.0 + _INSIDE)  # where no band is filled it is none yet
    if window <= window_of_large_idler(tolerance):
        high = math.inf
    elif spare(farthest) < 0.0:
        high = math.exp(bracketed_root(spare, best, farthest))
    return low, high


def window_of_large_idler(tolerance: float) -> float:
    """Longest window within a tolerance that remains for i3 -> -infinity.

    tau = tan(h) - h,   Y - sin(Y)/cos(h) = tau,   window = 2 Y

    Parameters
        tolerance : float [rad] - tau > 0
    Returns
        window : float [rad]
    Example
        >>> round(math.degrees(window_of_large_idler(math.radians(1.0))), 2)
        84.75
    """
    h = bracketed_root(lambda x: math.tan(x) - x - tolerance, 0.0, math.atan(4.0 * tolerance + 4.0))
    y = bracketed_root(lambda x: x - math.sin(x) / math.cos(h) - tolerance, h, math.pi + tolerance)
    return 2.0 * y


def _deg(angle: float, other: float = math.nan) -> str:
    return unlike(math.degrees(angle), math.degrees(other))


class SymmetricOutput(Output):
    """The output of the symmetric family in closed form.

    Parameters
        linkage : FourBar [mm] - of `symmetric_linkage`
        train : GearTrain - equal crank and output gear
        frame_ratio : float - d
        phi12 : float [rad] or None - crank angle of the back-step, 0: it just stops, None: it never stands
    """

    def __init__(self, linkage: FourBar, train: GearTrain, frame_ratio: float, phi12: float | None) -> None:
        super().__init__(linkage, train)
        self._frame_ratio, self._phi12 = frame_ratio, phi12

    @property
    def frame_ratio(self) -> float:
        """As given."""
        return self._frame_ratio

    @property
    def middle(self) -> float:
        """Crank angle of the minimum speed [rad]: 270 deg, mirrored with the assembly."""
        return 1.5 * math.pi if self.linkage.assembly == 1 else 0.5 * math.pi

    @cached_property
    def speed_turnings(self) -> list[Turning]:
        """Half a revolution apart (thesis (4-13))."""
        limits = speed_ratio_limits(self.train.i3, self.frame_ratio)
        return [Turning((self.middle + math.pi) % math.tau, limits.greatest), Turning(self.middle, limits.least)]

    @cached_property
    def acceleration_turnings(self) -> list[Turning]:
        """A quarter turn after and before the minimum speed."""
        peak = peak_acceleration_ratio(self.train.i3, self.frame_ratio)
        after, before = (self.middle + 0.5 * math.pi) % math.tau, (self.middle - 0.5 * math.pi) % math.tau
        return [Turning(after, peak), Turning(before, -peak)]

    @cached_property
    def places(self) -> list[float]:
        """270 deg -+ phi12/2 (thesis (4-15)), or its mirror image."""
        if self._phi12 is None:
            return []
        half = 0.5 * self._phi12
        return [self.middle - half, self.middle + half] if half else [self.middle]

    @cached_property
    def back_step(self) -> BackStep | None:
        """Thesis (4-15), (4-19)."""
        if not self._phi12:
            return None
        start, end = self.places
        return BackStep(start, end, self._phi12, back_step_angle(self.train.i3, self._phi12))

    @cached_property
    def dwell_angle(self) -> float | None:
        """phi13 from its own equation."""
        return dwell_angle(self.train.i3, self._phi12) if self._phi12 else None

    @cached_property
    def ripple(self) -> ToleranceDwell | None:
        """As far before the back-step as the output regains its place behind it: the motion is odd about 270 deg."""
        from gearlink.core.parts.linkages.band_dwell import ToleranceDwell

        step, phi13 = self.back_step, self.dwell_angle
        if step is None or phi13 is None:
            return None
        start = wrap(step.start - (phi13 - step.crank_angle))
        return ToleranceDwell(start, 2.0 * phi13 - step.crank_angle, self.angle(start) + 0.5 * step.angle)
