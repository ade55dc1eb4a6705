"""Momentary dwell of the three-gear four-bar with any teeth: closed forms for frame and crank angle.

The output stands still where A, the pole F of crank gear and idler (on BC, r1 from B) and the pole E of idler and
output gear (on CD, r3 from C) lie on one line. The triangle CFE is isosceles; with its base angle beta, x = cos(beta),
e = AB, S = r1 + 2 r3 + r5 and w = sqrt(e^2 - r1^2 + r1^2 x^2), signed,

    AD^2 = (S x - w)^2 + r5^2 (1 - x^2)

A dwell of just a moment is a stationary value of AD over beta. There w = e_t x: everything is rational in
e_t = r1 (U -+ V)/(U +- V), U = sqrt(b (b + r5)), V = sqrt(r3 c), where the upper signs hold for a crank shorter than
r1 (crank-rocker), the lower ones for a longer one (drag link).

The radius of a gear in internal mesh counts negative. With r1 < 0 where the mesh of crank gear and idler is internal,
r5 < 0 where that of idler and output gear is, one theory holds for all arrangements: b = |r1 + r3|, c = |r3 + r5|,
T = r1 + r3 + r5,

    P = S^2 + r1^2 - r5^2,   Q = P^2 - 4 S^2 r1^2 = 16 r3 (r3 + r5)(r1 + r3) T,   h = e^2 - r1^2,   g = h + r5^2 - d^2

and X = cos^2(beta) at a standstill is a root of Q X^2 + (2 P g - 4 S^2 h) X + g^2 = 0. With sigma = sign(T) the output
just stops where g = h (P + sigma sqrt Q)/(2 r1^2): it steps back with a longer frame for sigma = +1, and with a shorter
one for sigma = -1, a ring gear 5 round the whole train.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_above
from gearlink.core.base.wording import short, unlike, within
from gearlink.core.numerics.elementary import SCALARS, Elementary
from gearlink.core.parts.linkages.fourbar.position import FourBar

if TYPE_CHECKING:
    from gearlink.core.parts.linkages.geared_output import GearedOutput

_NEWTON_STEPS = 4
_ZERO = 1e-11  # speed ratio at a standstill, of the terms that cancel there
_APART = 1e-7  # crank angle [rad] below which two candidates are one standstill


class Tangency(NamedTuple):
    """Where the output just stops: the frame length [mm] of that, cosine and sine of beta, and e_t [mm]."""

    frame: float
    cos_beta: float
    sin_beta: float
    pole_offset: float


class Intermediates(NamedTuple):
    """The thesis's steps to the frame of a momentary dwell: K, L, M [mm^6], beta, alpha [rad], AF, FE, EG, GD [mm]."""

    k: float
    l: float  # noqa: E741 - the thesis's letter
    m: float
    beta: float
    alpha: float
    af: float
    fe: float
    eg: float
    gd: float


def intermediates(r1: float, r3: float, r5: float, eccentricity: float) -> Intermediates:
    """The steps of thesis (4-26) to (4-33), with its slips corrected.

    K cos^4 b + L cos^2 b + M = 0,   sin alpha = r1 sin b/e,   AF = r1 cos b - e cos alpha,
    FE = 2 r3 cos b,   EG = r5 cos b,   GD = r5 sin b,   AD = sqrt((AF + FE + EG)^2 + GD^2)

    Parameters
        r1, r3, r5 : float [mm] - reference radii of crank gear, idler and output gear
        eccentricity : float [mm] - e = AB, crank length
    Raises
        NoSolution - as `tangency`
    Example
        >>> steps = intermediates(25.0, 25.0, 75.0, 18.0)
        >>> round(steps.af, 9), round(math.degrees(steps.beta), 9), round(math.degrees(steps.alpha), 9)
        (13.797431469, 44.5807655, 77.130662947)

    Source
        thesis (4-26) to (4-33); K with the 2 that its numbers lack, AF with the minus that its formula lacks
    """
    found = tangency(r1, r3, r5, eccentricity)
    s, h = r1 + 2.0 * r3 + r5, (eccentricity - r1) * (eccentricity + r1)
    k = 16.0 * r1 * r1 * r3 * (r3 + r5) * (r1 + r3) * (r1 + r3 + r5)
    along = found.pole_offset * found.cos_beta  # e cos(alpha), positive where the pole F lies beyond A
    sine = r1 * found.sin_beta
    return Intermediates(
        k,
        k * h / (r1 * r1),
        -((s * h) ** 2),
        math.atan2(found.sin_beta, found.cos_beta),
        math.atan2(sine, along),
        r1 * found.cos_beta - along,
        2.0 * r3 * found.cos_beta,
        r5 * found.cos_beta,
        r5 * found.sin_beta,
    )


def least_eccentricity(r1: float, r3: float, r5: float) -> float:
    """Crank length down to which a momentary dwell exists; there the linkage stretches straight.

    e_lo = r1 (U - V)/(U + V) = r1^2 S/(U + V)^2

    Parameters
        r1, r3, r5 : float [mm] - reference radii of crank gear, idler and output gear
    Returns
        e_lo : float [mm] - below r1
    Raises
        NoSolution - for a radius that is not positive and finite
    Example
        >>> round(least_eccentricity(25.0, 25.0, 75.0), 9)
        5.628705664

    Source
        own derivation: cos(beta) = 1 in thesis (4-26)
    """
    return r1 * r1 * (r1 + 2.0 * r3 + r5) / _pole_sum(r1, r3, r5) ** 2


def tangency_range(r1: float, r3: float, r5: float) -> tuple[float, float]:
    """Crank lengths between which some frame just stops the output, in crank-rocker or drag link.

    e_lo < e < e_hi,   e_hi = r1^2/e_lo

    Parameters
        r1, r3, r5 : float [mm] - reference radii of crank gear, idler and output gear
    Returns
        e_lo, e_hi : float, float [mm] - `least_eccentricity` and its counterpart above r1
    Raises
        NoSolution - for a radius that is not positive and finite
    Example
        >>> [round(e, 9) for e in tangency_range(25.0, 25.0, 75.0)]
        [5.628705664, 111.037961003]

    Source
        own derivation: cos(beta) = 1 with either sign of the root
    """
    e_lo = least_eccentricity(r1, r3, r5)
    return e_lo, r1 * (r1 / e_lo)


def pole_lengths(r1: Any, r3: Any, r5: Any, fn: Elementary = SCALARS) -> tuple[Any, Any]:
    """U = sqrt(b (b + r5)) and V = sqrt(r3 c), of numbers or of arrays."""
    b = r1 + r3
    return fn.sqrt(b * (b + r5)), fn.sqrt(r3 * (r3 + r5))


def eccentricity_range(r1: float, r3: float, r5: float) -> tuple[float, float]:
    """Crank lengths between which a crank-rocker with a momentary dwell exists.

    e_lo < e < e_up,   e_up = r1 - 2 max(0, r1 - r5) r1^2/(U + V)^2

    Parameters
        r1, r3, r5 : float [mm] - reference radii of crank gear, idler and output gear
    Returns
        e_lo, e_up : float, float [mm] - at e_lo the linkage stretches straight, at e_up it folds
    Raises
        NoSolution - for a radius that is not positive and finite, and where the range is empty: an output gear
            smaller than the crank gear with a small idler
    Notes
        e_up is the root of d* - e = r1 - r5 = |b - c|; the other root is -r1. For r5 >= r1 it is r1.
    Example
        >>> [round(e, 9) for e in eccentricity_range(25.0, 25.0, 75.0)]
        [5.628705664, 25.0]
        >>> [round(e, 9) for e in eccentricity_range(13.0, 5.0, 5.0)]
        [6.294646736, 9.403059008]
    """
    low = least_eccentricity(r1, r3, r5)
    high = r1 - 2.0 * max(0.0, r1 - r5) * (r1 / _pole_sum(r1, r3, r5)) ** 2
    if not low < high:
        raise NoSolution(
            f"no crank-rocker with a momentary dwell has gears of {short(2 * r1)}, {short(2 * r3)} and {short(2 * r5)} "
            f"mm reference diameter: crank above {unlike(low, high)} and below {unlike(high, low)} mm",
            fix="use a larger idler or an output gear not smaller than the crank gear",
        )
    return low, high


def tangency(r1: float, r3: float, r5: float, eccentricity: float) -> Tangency:
    """Frame length at which the output of given gears and crank just stops, in crank-rocker or drag link.

    cos^2(beta) = (r1^2 - e^2)/(r1^2 - e_t^2),   d*^2 = (S - e_t)^2 cos^2(beta) + r5^2 sin^2(beta)

    Parameters
        r1, r3, r5 : float [mm] - reference radii
        eccentricity : float [mm] - e = AB, crank length, e_lo < e < e_hi; the linkage is a crank-rocker for
            e < r1 and a drag link, if it turns at all, for e > r1
    Raises
        NoSolution - for a crank outside (e_lo, e_hi): there the output stops for no frame
    Notes
        cos^2 and sin^2 come from products of differences of the lengths: no loss at either end of the range.
    Example
        >>> round(tangency(25.0, 25.0, 75.0, 18.0).frame, 12)
        115.522215624713

    Source
        own derivation; replaces thesis (4-26)..(4-33), in whose printed example the numbers have slips
    """
    e = eccentricity
    e_lo, e_hi = tangency_range(r1, r3, r5)
    if not e_lo < e < e_hi:
        inside = strictly_within(e_lo, e_hi)
        raise NoSolution(
            f"crank: {unlike(e, e_lo if e <= e_lo else e_hi)} mm (for the output to stop {inside})",
            fix=f"set the crank to {inside}, or change the gears",
        )
    return touching(r1, r3, r5, e, e_lo if e < r1 else e_hi)


def touching(r1: Any, r3: Any, r5: Any, e: Any, e_t: Any, fn: Elementary = SCALARS) -> Tangency:
    """`tangency` whose e_t is known, of numbers or of arrays."""
    span = (r1 - e_t) * (r1 + e_t)
    cos_beta, sin_beta = fn.sqrt((r1 - e) * (r1 + e) / span), fn.sqrt((e - e_t) * (e + e_t) / span)
    along, beside = (r1 + 2.0 * r3 + r5 - e_t) * cos_beta, r5 * sin_beta
    return Tangency(fn.sqrt(along * along + beside * beside), cos_beta, sin_beta, e_t)


def momentary_frame_length(r1: float, r3: float, r5: float, eccentricity: float) -> float:
    """Frame length of the crank-rocker whose output stops just once a revolution, without stepping back.

    d*^2 = r5^2 + (r1^2 - e^2) {[(sqrt(r3 c) + sqrt(b (b + r5)))/r1]^2 - 1},   b = r1 + r3, c = r3 + r5

    Parameters
        r1, r3, r5 : float [mm] - reference radii of crank gear, idler and output gear
        eccentricity : float [mm] - e, crank length, within `eccentricity_range`
    Returns
        frame : float [mm]
    Raises
        NoSolution - for a crank outside the range: shorter ones never stop the output, ones from r1 on always make
            it step back, and between e_up and r1 the linkage does not turn
    Example
        >>> round(momentary_frame_length(25.0, 25.0, 75.0, 16.0), 12)
        122.839414791868

    Source
        own derivation; thesis (4-26)..(4-33) solve the same task in steps
    """
    return _wanted(r1, r3, r5, eccentricity).frame


def momentary_crank_angle(r1: float, r3: float, r5: float, eccentricity: float, assembly: int = 1) -> float:
    """Crank angle at which the output of a momentary-dwell linkage stands still.

    phi = arg(-e_lo x, -r1 s) - arg((S - e_lo) x, -r5 s),   x, s = cos(beta), sin(beta)

    Parameters
        r1, r3, r5, eccentricity : float [mm] - as in `momentary_frame_length`
        assembly : +1 or -1 - the mirrored linkage stops at 2 pi - phi
    Returns
        phi : float [rad] - 0 <= phi < 2 pi
    Raises
        NoSolution - as `momentary_frame_length`
    Notes
        Full precision, where the search for a double root of the speed keeps half the digits.
    Example
        >>> round(math.degrees(momentary_crank_angle(25.0, 25.0, 75.0, 18.0)), 10)
        284.240687259
    """
    found = _wanted(r1, r3, r5, eccentricity)
    w = found.pole_offset * found.cos_beta
    return crank_angle(r1, r5, (r1 + 2.0 * r3 + r5) * found.cos_beta, w, found.sin_beta, assembly)


def momentary_linkage(r1: float, r3: float, r5: float, eccentricity: float, assembly: int = 1) -> FourBar:
    """Four-bar with a momentary dwell: crank e, coupler r1 + r3, rocker r3 + r5, frame d*.

    Raises
        NoSolution - as `momentary_frame_length`
    Example
        >>> momentary_linkage(25.0, 25.0, 75.0, 16.0).kind()
        'crank-rocker'
    """
    return FourBar(eccentricity, r1 + r3, r3 + r5, momentary_frame_length(r1, r3, r5, eccentricity), assembly)


def crank_angle(r1: float, r5: float, reach: float, w: float, sin_beta: float, assembly: int) -> float:
    """Crank angle of a standstill from its pole triangle: reach = S cos(beta), w = AF's part along the pole line.

    Returns
        phi : float [rad] - 0 <= phi < 2 pi

    Source
        own derivation: direction of AB less direction of AD, pole line as x axis
    """
    return wrap(assembly * angle_of_poles(r1, r5, reach, w, sin_beta))


def angle_of_poles(r1: Any, r5: Any, reach: Any, w: Any, sin_beta: Any, fn: Elementary = SCALARS) -> Any:
    """`crank_angle` in the assembly 1 and within any turn, of numbers or of arrays."""
    return fn.atan2(-r1 * sin_beta, -w) - fn.atan2(-r5 * sin_beta, reach - w)


def wrap(angle: float) -> float:
    """Angle reduced to 0 <= angle < 2 pi.

    Example
        >>> wrap(-1e-20), wrap(7.0) == 7.0 - 2.0 * math.pi
        (0.0, True)
    """
    turned = angle % (2.0 * math.pi)
    return turned if turned < 2.0 * math.pi else 0.0


def _pole_sum(r1: float, r3: float, r5: float) -> float:
    """U + V = sqrt(b (b + r5)) + sqrt(r3 c)."""
    for name, radius in (("r1", r1), ("r3", r3), ("r5", r5)):
        if not 0.0 < radius < math.inf:
            raise NoSolution(f"the reference radius {name} is {radius:g} mm; it must be positive and finite")
    u, v = pole_lengths(r1, r3, r5)
    found: float = u + v
    return found


def strictly_within(low: float, high: float) -> str:
    """The cranks between two lengths which are none themselves, as a range that holds as printed."""
    return within(math.nextafter(low, math.inf), math.nextafter(high, 0.0), "mm")


def _wanted(r1: float, r3: float, r5: float, eccentricity: float) -> Tangency:
    """The tangency of a crank-rocker, or the refusal with its limits."""
    low, high = eccentricity_range(r1, r3, r5)
    if not low < eccentricity < high:
        what = "never stops the output, whatever the frame"
        if eccentricity >= r1:
            what = "always makes the output step back, whatever the frame"
        elif eccentricity >= high:
            what = "cannot turn with the frame of its momentary dwell"
        raise NoSolution(
            f"crank: {unlike(eccentricity, low if eccentricity <= low else high)} mm, which {what} (for a "
            f"momentary dwell of these gears {strictly_within(low, high)})",
            fix=f"set the crank to {strictly_within(low, high)}, or change the gears",
        )
    return tangency(r1, r3, r5, eccentricity)


def eccentricity_for_frame(r1: float, r3: float, r5: float, frame: float) -> float:
    """Crank length whose momentary dwell has a given frame.

    e^2 = r1^2 - (d^2 - r5^2)/kappa,   kappa = (U + V)^2/r1^2 - 1

    Parameters
        r1, r3, r5 : float [mm] - reference radii
        frame : float [mm] - d*(e_up) < d < d*(e_lo)
    Returns
        eccentricity : float [mm]
    Raises
        NoSolution - for a frame outside the range
    Example
        >>> round(eccentricity_for_frame(25.0, 25.0, 75.0, 122.839414791868), 9)
        16.0
        >>> round(eccentricity_for_frame(24.0, 17.0, -54.0, 49.53221205192578), 9)
        22.0
    """
    found = shape(r1, r3, r5)
    square = r1 * r1 - (frame - r5) * (frame + r5) / found.kappa
    if not found.low**2 < square < found.high**2:
        low, high = sorted(math.sqrt(max(0.0, found.frame_squared(e))) for e in (found.low, found.high))
        raise NoSolution(
            f"frame: {unlike(frame, low if frame <= low else high)} mm (for a momentary dwell of these gears "
            f"{strictly_within(low, high)})",
            fix=f"set the frame to {strictly_within(low, high)}",
        )
    return math.sqrt(square)


def crank_with_room(r1: float, r3: float, r5: float, distance: float) -> float | None:
    """Longest crank of a momentary-dwell design that keeps B so far from D; None where none does.

    d*(e) - e = G:   e = (-G + sqrt(G^2 + (1 + kappa)(kappa r1^2 + r5^2 - G^2)))/(1 + kappa)

    Parameters
        r1, r3, r5 : float [mm] - reference radii
        distance : float [mm] - G, sum of the tip radii of gears 1 and 5 and the wanted gap
    Returns
        crank : float [mm]
    Notes
        d* falls as e rises, so every shorter crank within `eccentricity_range` has more room.
    Example
        >>> round(crank_with_room(25.0, 25.0, 75.0, 105.0), 3)
        16.418
    """
    try:
        found = shape(r1, r3, r5)
    except NoSolution:
        return None
    if distance >= (r1 + 2.0 * r3 + r5) - 2.0 * found.low:
        return None
    rest = found.kappa * r1 * r1 + (r5 - distance) * (r5 + distance)
    crank = (math.sqrt(distance * distance + (1.0 + found.kappa) * rest) - distance) / (1.0 + found.kappa)
    return min(crank, found.high)


def balanced_eccentricity(r1: float, r3: float, r5: float) -> float:
    """Crank length of the momentary dwell with the maximum minimum transmission angle: e^2 + d*^2 = b^2 + c^2.

    e_bal^2 = (r5^2 + kappa r1^2 - b^2 - c^2)/(kappa - 1)

    Parameters
        r1, r3, r5 : float [mm] - reference radii
    Returns
        eccentricity : float [mm]
    Raises
        NoSolution - where the balanced linkage has no momentary dwell
    Example
        >>> round(balanced_eccentricity(40.0, 72.0, 40.0), 6)
        28.762469
        >>> round(balanced_eccentricity(24.0, 17.0, -60.0), 9)
        22.063426867
    """
    found, square = shape(r1, r3, r5), (r1 + r3) ** 2 + (r3 + r5) ** 2
    crank2 = (r5 * r5 + found.kappa * r1 * r1 - square) / (found.kappa - 1.0)
    if not found.low**2 < crank2 < min(found.high**2, (r1 + r3) ** 2, (r3 + r5) ** 2):
        raise NoSolution(
            f"no balanced linkage with a momentary dwell has gears of {short(2 * abs(r1))}, {short(2 * r3)} and "
            f"{short(2 * abs(r5))} mm reference diameter",
            fix="omit balanced, give crank or frame",
        )
    return math.sqrt(crank2)


def is_internal(*radii: float) -> bool:
    """Whether one of the meshes is internal."""
    return any(radius < 0.0 for radius in radii)


class Shape(NamedTuple):
    """What the radii of gears with a momentary dwell give.

    sigma : +1 or -1 - on which side of d* the output steps back
    r1, r5 : float [mm]
    kappa : float - d*^2 = r5^2 + (r1^2 - e^2) kappa
    low, high : float [mm] - cranks between which some frame just stops the output
    offset : float [mm] - e_t = w/x of the tangency
    facing : +1 or -1 - sign of (r1 + r3)(r3 + r5)
    """

    sigma: int
    r1: float
    r5: float
    kappa: float
    low: float
    high: float
    offset: float
    facing: int

    def frame_squared(self, e: float) -> float:
        """d*^2 of a crank [mm^2]."""
        return self.r5 * self.r5 + (self.r1 - e) * (self.r1 + e) * self.kappa


def shape(r1: float, r3: float, r5: float) -> Shape:
    """Side, range and factor of the momentary dwell of a crank-rocker.

    d*^2 = r5^2 + (r1^2 - e^2) kappa,   kappa = (P + sigma sqrt Q)/(2 r1^2) - 1,   S/e_lo - 1 without a ring

    Parameters
        r1, r3, r5 : float [mm] - reference radii, negative for a gear in internal mesh with the idler
    Raises
        NoSolution - for gears whose output never just stops: a crank gear that is a ring round the idler, or an output
            ring that does not reach round the whole train; without a ring as `eccentricity_range`
    Example
        >>> found = shape(24.0, 17.0, -54.0)
        >>> found.sigma, round(found.kappa, 9)
        (-1, -5.027825753)
    """
    s, t = r1 + 2.0 * r3 + r5, r1 + r3 + r5
    if not is_internal(r1, r3, r5):
        low, high = eccentricity_range(r1, r3, r5)
        return Shape(1, r1, r5, s / low - 1.0, low, high, low, 1)
    q = 16.0 * r3 * (r3 + r5) * (r1 + r3) * t
    if r1 < -r3:
        raise NoSolution(
            "a crank gear that is a ring round the idler never stops the output",
            key="gears.crank",
            fix="give gears.crank teeth above 0, an external gear",
        )
    if not q > 0.0:
        least = safely_above(2.0 * (r1 + r3))
        raise NoSolution(
            f"reference diameter of the ring gear: {abs(2.0 * r5):.4g} mm (limit > {least} mm): it never stops the "
            "output, as it does not reach round the crank gear and the idler",
            fix="use more teeth on the output gear, or fewer on crank gear and idler",
        )
    sigma = 1 if t > 0.0 else -1
    p, root = s * s + (r1 - r5) * (r1 + r5), math.sqrt(q)
    whole = p + sigma * root
    slope = -sigma * whole / (2.0 * r1 * r1 * root)  # X* = slope h
    reach = r1 * r1 + 1.0 / slope
    if not slope < 0.0 or reach >= r1 * r1:
        raise NoSolution("no crank makes these gears stop the output momentarily", fix="change the teeth")
    facing = 1 if (r1 + r3) * (r3 + r5) > 0.0 else -1
    low = math.sqrt(max(0.0, reach))
    return Shape(sigma, r1, r5, whole / (2.0 * r1 * r1) - 1.0, low, abs(r1), 2.0 * s * r1 * r1 / whole, facing)


def ring_tangency(r1: float, r3: float, r5: float, eccentricity: float) -> Tangency | None:
    """Where the output of given gears and crank just stops; None where no frame does that.

    X* = -sigma g*/sqrt Q,   d*^2 = r5^2 + (r1^2 - e^2) kappa

    Parameters
        r1, r3, r5 : float [mm] - signed reference radii
        eccentricity : float [mm] - crank length
    Example
        >>> found = ring_tangency(24.0, 17.0, -54.0, 22.0)
        >>> round(found.frame, 12)
        49.532212051926
    """
    try:
        found = shape(r1, r3, r5)
    except NoSolution:
        return None
    span = (r1 - found.low) * (r1 + found.low)
    x2 = (r1 - eccentricity) * (r1 + eccentricity) / span
    square = found.frame_squared(eccentricity)
    if not 0.0 < x2 < 1.0 or square <= 0.0:
        return None
    sine = math.sqrt((eccentricity - found.low) * (eccentricity + found.low) / span)
    return Tangency(math.sqrt(square), math.sqrt(x2), found.facing * sine, found.offset)


def ring_standstills(output: GearedOutput, radii: tuple[float, float, float]) -> list[float]:
    """Crank angles of both standstills of an output with an internal mesh, or none.

    phi = atan2(-r1 s, -w) - atan2(-r5 s, S x - w),   w = (P X + g)/(2 S x),   s = sign((r1 + r3)(r3 + r5)) sqrt(1 - X)

    Parameters
        radii : r1, r3, r5, signed [mm]
    Returns
        places : list of float [rad] - ascending in [0, 2 pi)
    Notes
        Each root of the quadratic is followed by Newton steps on the speed ratio, which take out what cancels where
        both roots are near each other: always so for S near 0, a ring output with coupler and rocker of equal length.
    """
    linkage, (r1, r3, r5) = output.linkage, radii
    s, facing = r1 + 2.0 * r3 + r5, math.copysign(1.0, (r1 + r3) * (r3 + r5))
    h = (linkage.crank - r1) * (linkage.crank + r1)
    found: list[float] = []
    for x2 in _roots(linkage, radii):
        reach, square = s * math.sqrt(x2), h + r1 * r1 * x2
        if square < 0.0:
            continue
        for w in (math.sqrt(square), -math.sqrt(square)):
            start = crank_angle(r1, r5, reach, w, facing * math.sqrt(1.0 - x2), linkage.assembly)
            place = _polished(output, start)
            if place is not None and all(abs(math.remainder(place - other, math.tau)) > _APART for other in found):
                found.append(place)
    return sorted(found) if len(found) == 2 else []


def _roots(linkage: FourBar, radii: tuple[float, float, float]) -> list[float]:
    """Roots X of the quadratic in (0, 1); a discriminant that rounding made negative counts as 0."""
    r1, r3, r5 = radii
    s = r1 + 2.0 * r3 + r5
    p = s * s + (r1 - r5) * (r1 + r5)
    q = 16.0 * r3 * (r3 + r5) * (r1 + r3) * (r1 + r3 + r5)
    h = (linkage.crank - r1) * (linkage.crank + r1)
    g = h + (r5 - linkage.frame) * (r5 + linkage.frame)
    half = p * g - 2.0 * s * s * h
    # P^2 - Q = 4 S^2 r1^2 takes the squares out of the discriminant
    rest = s * s * (r1 * r1 * g * g - p * g * h + s * s * h * h)
    if rest < -1e-12 * half * half:
        return []
    top = -(half + math.copysign(2.0 * math.sqrt(max(0.0, rest)), half))
    found = {top / q if q else math.inf, g * g / top if top else math.inf}
    return [x for x in found if 0.0 < x < 1.0]


def _polished(output: GearedOutput, place: float) -> float | None:
    """The standstill that Newton steps reach from a place near it; None from a place that is none."""
    size = abs(output.train.ratio) + abs(output.train.coupler_share) + abs(output.train.rocker_share)
    for _ in range(_NEWTON_STEPS):
        speed, slope = output.speed(place), output.acceleration(place)
        if slope == 0.0 or abs(speed) > 0.1 * size:
            return None
        step = speed / slope
        if abs(step) > 0.1:
            return None
        place -= step
        if abs(step) <= 1e-15:
            break
    return wrap(place) if abs(output.speed(place)) <= _ZERO * size else None
