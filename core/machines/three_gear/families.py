"""Linkages of any three gears in one unknown length, along which every task rises: one bracketed root solves each.

Gears fix coupler and rocker; a task (a back-step, a dwell, a swing of the speed) fixes one of crank and frame. The
other is given, or the linkage is balanced: its transmission angle deviates equally at both ends,

    given crank e:   unknown d in (max(d*(e), |b - c| + e, e), b + c - e)
    given frame d:   unknown e in (e*(d), min(d - |b - c|, b + c - d))
    balanced:        d^2 = b^2 + c^2 - e^2, unknown e in (e_bal, min(b, c))

with d*(e), e*(d) and e_bal of the momentary dwell, where the back-step begins. Back-step, phi12, phi13 and the window
of equal ripple rise along each of them; the speed swing W_max - W_min too. With a ring gear round the whole train the
output steps back with a frame shorter than d*. `met_between` and `rooms` are the lengths of one link, the others as
they are, with which the output stays within a band over a window.

A task may be a window in which the output runs at a nearly even speed: a window of the crank angle whose ends stand on
one level of the speed ratio W, an extreme of W between them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.remedies.ways import at_least, at_most
from gearlink.core.base.report import safely_above, safely_below
from gearlink.core.base.wording import short, unlike, within
from gearlink.core.machines.three_gear.dwell import Output
from gearlink.core.machines.three_gear.momentary import (
    Shape,
    balanced_eccentricity,
    eccentricity_for_frame,
    is_internal,
    least_eccentricity,
    shape,
    strictly_within,
)
from gearlink.core.machines.three_gear.train import GearTrain
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.parts.linkages.fourbar.position import FourBar
from gearlink.core.parts.linkages.standstills import TURN, Turning

if TYPE_CHECKING:
    from gearlink.core.machines.three_gear.design import ThreeGearFourBar


_AFTER_LOW, _BEFORE_HIGH = 1e-12, 1e-6  # shares of a range left out: at its high end stands a change-point linkage
_BESIDE = 1e-6
"""Share of the family beside the length that fills the band: at that length itself rounding decides the window."""
_STEPS = (0.1, 0.01, 0.001)


@dataclass(frozen=True, slots=True)
class Family:
    """Linkages in one unknown length.

    linkage : of the unknown [mm]
    least, high : the range of the unknown [mm]
    low : the value [mm] at which the output just stops, or `least`; None where it never stops
    why : str - the reason for that, or why none steps back
    key : str - the key of the file that is to blame
    """

    linkage: Callable[[float], FourBar]
    least: float
    low: float | None
    high: float
    why: str = ""
    key: str = ""

    def ends(self) -> tuple[float, float]:
        """The range of linkages that turn, without its ends."""
        return self._inside(self.least, _BEFORE_HIGH)

    def stepping(self) -> tuple[float, float]:
        """The range of linkages whose output steps back, without its ends.

        Raises
            NoSolution - where none does
        """
        if self.low is None:
            raise NoSolution(self.why, key=self.key)
        return self._inside(self.low, _AFTER_LOW)

    def _inside(self, low: float, margin: float) -> tuple[float, float]:
        width = self.high - low
        return low + margin * width, self.high - _BEFORE_HIGH * width


def frames_of(crank: float, b: float, c: float) -> tuple[float, float]:
    """The shortest and the longest frame in which a crank turns [mm].

    Raises
        NoSolution - for a crank that turns in none
    """
    least, high = max(abs(b - c) + crank, crank), b + c - crank
    if not least < high:
        raise NoSolution(
            f"crank: {unlike(crank, min(b, c))} mm (limit < {unlike(min(b, c), crank)} mm to turn fully; coupler "
            f"{short(b)}, rocker {short(c)} mm)",
            fix=f"set the crank below {safely_below(min(b, c))} mm",
        )
    return least, high


def longest_crank(frame: float, b: float, c: float) -> float:
    """The longest crank that turns in a frame [mm].

    Raises
        NoSolution - for a frame in which none turns
    """
    high = min(frame - abs(b - c), b + c - frame, frame)
    if not high > 0.0:
        raise NoSolution(
            f"frame: {short(frame)} mm, in which no crank turns fully (coupler {short(b)}, rocker {short(c)} mm)",
            fix=f"set the frame to {within(abs(b - c), b + c, 'mm')}",
        )
    return high


def _never_stops(crank: float, low: float) -> str:
    return (
        f"crank: {unlike(crank, low)} mm (limit > {unlike(low, crank)} mm for the output to stop)\n"
        f"set the crank above {safely_above(low)} mm"
    )


def with_crank(r1: float, r3: float, r5: float, crank: float, assembly: int = 1) -> Family:
    """The linkages of a given crank.

    Parameters
        r1, r3, r5 : float [mm] - reference radii of crank gear, idler and output gear, negative for an internal mesh
        crank : float [mm] - e
    Raises
        NoSolution - for a crank that cannot turn
    Example
        >>> family = with_crank(24.0, 17.0, -54.0, 22.0)
        >>> round(family.low, 9), family.high
        (49.532212052, 26.0)
    """
    b, c = abs(r1 + r3), abs(r3 + r5)
    shortest, longest = frames_of(crank, b, c)
    found = _shape(r1, r3, r5)
    # on the side where the output steps back: of a ring round the whole train a frame shorter than d*
    least, high = (shortest, longest) if found.sigma > 0 else (longest, shortest)

    def linkage(d: float) -> FourBar:
        return FourBar(crank, b, c, d, assembly)

    if crank <= found.low:
        return Family(linkage, least, None, high, _never_stops(crank, found.low))
    if crank >= found.high:  # steps back with every frame
        return Family(linkage, least, least, high)
    inside = min(max(math.sqrt(found.frame_squared(crank)), shortest), longest)
    if inside == high:
        why = f"crank: {short(crank)} mm, of which no crank-rocker steps back\nchange the crank or the gears"
        return Family(linkage, least, None, high, why)
    return Family(linkage, least, inside, high)


def with_frame(r1: float, r3: float, r5: float, frame: float, assembly: int = 1) -> Family:
    """The linkages of a given frame.

    Raises
        NoSolution - for a frame with which no crank-rocker exists
    """
    b, c = abs(r1 + r3), abs(r3 + r5)
    high = longest_crank(frame, b, c)

    def linkage(e: float) -> FourBar:
        return FourBar(e, b, c, frame, assembly)

    if is_internal(r1, r3, r5):
        words = f"frame: {short(frame)} mm, with which no crank makes the output step back"
        return _rising(r1, r3, r5, linkage, min(high, abs(r1)), f"{words}\nchange the frame or the gears")
    low, why = 0.0, ""
    try:
        low = eccentricity_for_frame(r1, r3, r5, frame)
    except NoSolution as error:
        why = f"{error.message}\n{error.fix}"
    return Family(linkage, 0.0, min(low, high), high, why)


def balanced(r1: float, r3: float, r5: float, assembly: int = 1) -> Family:
    """The linkages whose transmission angle deviates from 90 deg equally at both ends.

    Raises
        NoSolution - for a train with a ring whose output never just stops
    """
    b, c = abs(r1 + r3), abs(r3 + r5)

    def linkage(e: float) -> FourBar:
        return FourBar(e, b, c, math.sqrt((b - e) * (b + e) + c * c), assembly)

    if is_internal(r1, r3, r5):
        why = "these gears have no balanced linkage whose output steps back\nomit balanced, give crank or frame"
        return _rising(r1, r3, r5, linkage, min(b, c, abs(r1)), why)
    try:
        return Family(linkage, 0.0, balanced_eccentricity(r1, r3, r5), min(b, c))
    except NoSolution as error:
        return Family(linkage, 0.0, None, min(b, c), f"{error.message}\n{error.fix}")


def solved(
    family: Family, measure: Callable[[FourBar], float], target: float, what: str, share: float = 1.0, key: str = ""
) -> FourBar:
    """The linkage of a family whose output steps back and whose rising measure meets a target.

    Parameters
        measure : of a back-step [rad], such as `window_of`; rises along the family
        target : float [rad]
        what : str - the request in words, for a refusal
        share : float - of the target that the words speak of: a tolerance is half a back-step
        key : str - the key of the request, for the remedy
    Raises
        NoSolution - for a target beyond the family, naming its limits
    """
    low, high = family.stepping()
    least, most = measure(family.linkage(low)), measure(family.linkage(high))
    if most <= 0.0:
        why = family.why or f"{what} is impossible: no linkage with this crank or frame makes the output step back"
        raise NoSolution(why, key=family.key if family.why else "")
    if not target <= most:
        angle = f"{math.degrees(family.linkage(high).min_transmission_angle()):.3g}"
        limit = safely_below(math.degrees(share * most))
        raise NoSolution(
            f"{what} is out of reach: at most {limit} deg with these gears (transmission angle {angle} deg)",
            fix=f"set {key or 'it'} to at most {limit} deg, or change the gears",
        )
    if not target >= least:
        limit = safely_above(math.degrees(share * least))
        raise NoSolution(
            f"{what} is out of reach: at least {limit} deg as a crank-rocker with this crank, whose output steps back "
            "with every frame",
            fix=f"set {key or 'it'} to at least {limit} deg, or use a shorter crank",
        )
    ends = (least - target, most - target)
    return family.linkage(bracketed_root(lambda x: measure(family.linkage(x)) - target, low, high, ends=ends))


def filling(family: Family, train: GearTrain, band: float) -> FourBar | None:
    """The linkage whose back-step fills a band, of which the dwell is longest; None where none steps back so far.

    Parameters
        band : float [rad] - the tolerance to either side
    Raises
        NoSolution - for a family of which each back-step is wider
    """
    measure = back_step_of(train)
    if 0.0 < measure(family.linkage(family.stepping()[1])) < 2.0 * band:
        return None
    return solved(family, measure, 2.0 * band, f"a tolerance of {_deg(band)} deg", 0.5)


def with_speed_quotient(family: Family, train: GearTrain, quotient: float, maximum: float = 1.0) -> FourBar:
    """The linkage of a family whose minimum output speed is a given part of the greatest.

    W_min/W_max = quotient

    Parameters
        quotient : float - below 1; negative for an output that steps back
        maximum : float [1/min] - W_max of the request, for the remedy
    Raises
        NoSolution - for a quotient that the family does not reach, naming its limits
    """

    def reached(x: float) -> float:
        values = [each.value for each in Output(family.linkage(x), train).ahead_turnings]
        return min(values) / max(values)

    low, high = family.ends()
    most, least = reached(low), reached(high)
    below, above = sorted((least, most))
    if not below <= quotient <= above:
        limits = f"from {safely_above(below, 4)} to {safely_below(above, 4)} with these gears"
        slow = quotient < below
        bound = (
            f"at least {safely_above(below * maximum, 4)}" if slow else f"at most {safely_below(above * maximum, 4)}"
        )
        cranks = "a longer crank" if slow else "a shorter crank"
        lengths = {"crank": cranks, "frame": "another frame"}
        other = lengths.get(family.key.rpartition(".")[2], "other gears")
        raise NoSolution(
            f"min/max of the output speed: {short(quotient)} ({limits})",
            fix=f"set speed.min to {bound}, or use {other}",
        )
    ends = (most - quotient, least - quotient)
    return family.linkage(bracketed_root(lambda x: reached(x) - quotient, low, high, ends=ends))


def back_step_of(train: GearTrain) -> Callable[[FourBar], float]:
    """Measure: the back-step D [rad]."""
    return _measure(train, lambda output: output.back_step.angle)


def back_step_crank_angle_of(train: GearTrain) -> Callable[[FourBar], float]:
    """Measure: the crank angle phi12 [rad] of the back-step."""
    return _measure(train, lambda output: output.back_step.crank_angle)


def dwell_angle_of(train: GearTrain) -> Callable[[FourBar], float]:
    """Measure: phi13 [rad]."""
    return _measure(train, lambda output: output.dwell_angle)


def window_of(train: GearTrain) -> Callable[[FourBar], float]:
    """Measure: the window of equal ripple [rad]."""
    return _measure(train, lambda output: output.ripple.crank_angle)


def _measure(train: GearTrain, of_stepping: Callable[[Any], float]) -> Callable[[FourBar], float]:
    def measure(linkage: FourBar) -> float:
        output = Output(linkage, train)
        with suppress(NoSolution):
            return 0.0 if output.back_step is None else of_stepping(output)
        return 0.0

    return measure


def _shape(r1: float, r3: float, r5: float) -> Shape:
    """`shape`; of gears without a ring that have no momentary dwell an empty range of cranks."""
    try:
        return shape(r1, r3, r5)
    except NoSolution:
        if is_internal(r1, r3, r5):
            raise
    low = least_eccentricity(r1, r3, r5)
    return Shape(1, r1, r5, 0.0, low, low, low, 1)


def _deg(angle: float) -> str:
    return short(math.degrees(angle))


class Room(NamedTuple):
    """The lengths of a link [mm], the others as they are, that meet a window; `given` is that of the file."""

    key: str
    given: float
    low: float
    high: float

    @property
    def change(self) -> float:
        """The change that the file needs, as a share of its length."""
        return max(self.low / self.given, self.given / self.high) - 1.0

    def built(self) -> Iterator[float]:
        """Lengths of the coarsest grid that has one here: the one nearest to the middle, then those at the ends."""
        for step in _STEPS:
            ends = at_least(self.low, step), at_most(self.high, step)
            if ends[0] <= ends[1]:
                middle = at_most(0.5 * (self.low + self.high) + 0.5 * step, step)
                yield from dict.fromkeys((min(max(middle, ends[0]), ends[1]), *ends))
                return


def met_between(
    family: Family,
    train: GearTrain,
    window: float,
    band: float,
    length: Callable[[FourBar], float],
    serving: float | None = None,
) -> tuple[float, float] | None:
    """The lengths of a family between which a window is met.

    At the one the back-step fills the band or the crank turns just so, at the other the window is just as long as
    asked, or the crank turns just so.

    Parameters
        window, band : float [rad] - the crank angle, and the tolerance to either side
        length : of a linkage, the length that the family varies [mm]
        serving : float [mm] - a length that meets the window; without it the longest window is looked at
    Returns
        low, high : float [mm]; None where the longest window is too short
    Raises
        NoSolution - for a family whose output does not step back, or always by more than the band
    """

    from gearlink.core.parts.linkages.band_dwell import least_band

    def spare(x: float) -> float:  # falls with the band that the window takes: one root, not two in each other
        return band - least_band(Output(family.linkage(x), train).valley, window)

    filled = length(filling(family, train, band) or family.linkage(family.stepping()[1]))
    end = family.ends()[0]
    inside = filled + _BESIDE * (end - filled) if serving is None else serving
    ends = spare(end), spare(inside)
    if ends[1] <= 0.0 and serving is None:
        return None
    just = end
    if ends[0] < 0.0:
        # A window as long as the limit leaves one length, where rounding decides the sign.
        just = bracketed_root(spare, end, inside, ends=ends) if ends[1] > 0.0 else inside
    return min(just, filled), max(just, filled)


def rooms(design: ThreeGearFourBar, window: float, band: float) -> tuple[Room, ...]:
    """The frames that meet a window with the crank of a design, and the cranks with its frame: the nearer first.

    Parameters
        window, band : float [rad]
    Returns
        rooms : none for gears whose profile shifts change the centre distances, of which there is no synthesis
    """
    if design.off_center:
        return ()
    module, links, assembly = design.spec.gears.transverse_module, design.linkage, design.spec.assembly
    radii = [0.5 * module * teeth for teeth in design.signed_teeth]
    found = []
    ways: tuple[tuple[str, Any, float, Callable[[FourBar], float]], ...] = (
        ("links.frame", with_crank, links.crank, lambda each: each.frame),
        ("links.crank", with_frame, links.frame, lambda each: each.crank),
    )
    for key, form, other, length in ways:
        with suppress(NoSolution):
            family: Family = form(*radii, other, assembly)
            if met := met_between(family, design.train, window, band, length):
                found.append(Room(key, length(links), *met))
    return tuple(sorted(found, key=lambda room: room.change))


def words(found: tuple[Room, ...]) -> str:
    """What the length with the smallest change may be, in words."""
    return f"set {found[0].key} from {within(found[0].low, found[0].high, 'mm')}" if found else ""


# Trains with a ring


def momentary_ring_linkage(r1: float, r3: float, r5: float, crank: float, assembly: int = 1) -> FourBar:
    """The crank-rocker of a given crank whose output just stops.

    Raises
        NoSolution - where no crank-rocker of these gears and crank does so
    Example
        >>> round(momentary_ring_linkage(24.0, 17.0, -54.0, 22.0).frame, 9)
        49.532212052
    """
    found = shape(r1, r3, r5)  # gears that never just stop are refused whatever the crank
    family = with_crank(r1, r3, r5, crank, assembly)
    if family.low is None:
        raise NoSolution(family.why)
    if crank >= found.high:
        raise NoSolution(
            f"crank: {unlike(crank, found.high)} mm (for a momentary dwell {strictly_within(found.low, found.high)})",
            fix=f"set the crank to {strictly_within(found.low, found.high)}",
        )
    if family.low == family.least:
        raise NoSolution(
            f"crank: {short(crank)} mm, which does not turn fully with the frame of its momentary dwell",
            fix=f"set the crank to {strictly_within(found.low, found.high)}",
        )
    return family.linkage(family.low)


def _rising(r1: float, r3: float, r5: float, linkage: Callable[[float], FourBar], high: float, why: str) -> Family:
    """The family along the crank from where the output just stops; the frame of a linkage is compared with d* of it.

    sigma (d^2 - d*^2), linear in e^2, rises through zero there.
    """
    found = shape(r1, r3, r5)

    def beyond(e: float) -> float:
        return found.sigma * (linkage(e).frame ** 2 - found.frame_squared(e))

    most = high * (1.0 - 1e-12)
    if beyond(most) <= 0.0:
        return Family(linkage, 0.0, None, high, why)
    at_zero = beyond(1e-9 * high)
    if at_zero >= 0.0:
        return Family(linkage, 0.0, found.low if found.low < high else None, high, why)
    low = max(found.low, most * math.sqrt(at_zero / (at_zero - beyond(most))))
    return Family(linkage, 0.0, low, high, why)


_UNIFORM_STEPS = 720
_FIRST, _GROWTH, _MOST = 1e-9, 1.02, 1e6
Speed = Callable[[float], float]


class Uniform(NamedTuple):
    """The longest stretch: crank angle, start [rad], and level of the speed ratio."""

    angle: float
    start: float
    level: float


def uniform(speed: Speed, extremes: Sequence[Turning], share: float) -> Uniform | None:
    """The longest crank angle in which the speed ratio stays within a share of a level above 0.

    max W/min W <= rho = (1 + p)/(1 - p):  about a maximum down to W_max/rho, about a minimum above 0 up to W_min rho

    Parameters
        speed : function of the crank angle [rad] - W
        extremes : all turnings of W over a revolution
        share : float - p
    Returns
        uniform : Uniform - None where the output never runs forwards
    Source
        thesis 4.2.1; own derivation
    """
    rho = (1.0 + share) / (1.0 - share)
    values = [each.value for each in extremes]
    top, low = max(values), min(values)
    if top <= 0.0:
        return None
    if top <= rho * low:
        return Uniform(TURN, 0.0, 0.5 * (top + low))
    best: Uniform | None = None
    for place, value in extremes:
        if value <= 0.0:
            continue
        for bottom, ceiling in ((value / rho, value), (value, value * rho)):
            ends = [_leaves(speed, place, way, bottom, ceiling) for way in (-1.0, 1.0)]
            angle = ends[1] - ends[0]
            if best is None or angle > best.angle * (1.0 + 1e-12):
                best = Uniform(angle, ends[0] % TURN, 0.5 * (bottom + ceiling))
    return best


def _leaves(speed: Speed, place: float, way: float, bottom: float, ceiling: float) -> float:
    """Where the speed leaves a band, going one way from a place within it [rad]."""
    step, inside, slack = TURN / _UNIFORM_STEPS, place, 1e-12 * ceiling
    for k in range(1, _UNIFORM_STEPS + 1):
        there = place + way * k * step
        value = speed(there)
        if value < bottom - slack or value > ceiling + slack:
            edge = bottom if value < bottom else ceiling
            if abs(speed(inside) - edge) <= slack:
                return inside
            return bracketed_root(lambda x, edge=edge: speed(x) - edge, *sorted((inside, there)))  # type: ignore[misc]
        inside = there
    return place + way * TURN


def window_of_family(d: float, n: float, share: float) -> float:
    """Window about the maximum speed of equal gears [rad].

    W = 1 + n G,  G up to k = 2 d/(1 + d^2):  sin phi_1 = (d^2 - 1) G/(2 d sqrt(1 - G^2)) at G = ((1 + n k)/rho - 1)/n,
    window 180 deg - 2 phi_1

    Parameters
        d, n : float - frame over crank, 1 - i3
        share : float - p
    Source
        thesis (4-7); own derivation
    """
    rho, k = (1.0 + share) / (1.0 - share), 2.0 * d / (1.0 + d * d)
    g = ((1.0 + n * k) / rho - 1.0) / n
    if g <= -k:
        return TURN
    return math.pi - 2.0 * math.asin((d * d - 1.0) * g / (2.0 * d * math.sqrt(1.0 - g * g)))


def frame_ratio_for_window(angle: float, share: float, n: float, transmission: float) -> float:
    """Minimum frame over crank of equal gears without back-step that has a window [rad] about its maximum speed.

    d >= max(tan(45 deg + mu/2), n + sqrt(n^2 - 1))

    Parameters
        transmission : float [rad] - mu, minimum transmission angle
    Raises
        NoSolution - where no frame that could be built has it
    """
    d = max(math.tan(0.25 * math.pi + 0.5 * transmission), n + math.sqrt(n * n - 1.0))
    if window_of_family(d, n, share) >= angle:
        return d
    before, step = d, _FIRST
    while window_of_family(d, n, share) < angle:
        before, step = d, max(step * 2.0, d * (_GROWTH - 1.0)) if step < d * (_GROWTH - 1.0) else d * (_GROWTH - 1.0)
        d = before + step
        if d > _MOST:
            raise NoSolution(
                f"frame over crank for {short(math.degrees(angle))} deg within +-{100.0 * share:g} %: above {_MOST:g} "
                "(not computed)",
                fix="reduce the uniform angle, or increase uniform_tolerance",
            )
    return bracketed_root(lambda x: window_of_family(x, n, share) - angle, before, d)
