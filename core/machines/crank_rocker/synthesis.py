"""Syntheses of a crank-rocker: from swing and time ratio of the rocker, and through three pairs of angles.

Frame of all equations: A at 0, D at (d, 0); crank a, coupler b, rocker c, frame d.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from gearlink.core.base.design import Found, Outline, placed
from gearlink.core.base.errors import NoSolution, at_key, section_of
from gearlink.core.base.remedies.ways import either
from gearlink.core.base.report import Check, Remedy, safely_above, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.spec_paths import changed
from gearlink.core.base.wording import short, unlike
from gearlink.core.machines.crank_rocker.design import LENGTHS, MOTION, CrankRocker, DeadCenters, inner_places
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.parts.linkages.checks import recommended_angle
from gearlink.core.parts.linkages.codes import FULL_TURN
from gearlink.core.parts.linkages.fourbar.position import FourBar, solve

if TYPE_CHECKING:
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.parts.linkages.functions import Wanted

_FIT = 1e-7
"""Of swing and time ratio, relative: what the dead centres of a linkage give back; rounding leaves far less."""
_IN_LINE = 1e-9
_SINGULAR = 1e-13
_EASED = 200  # steps of tasks that ask for less


# Swing and time ratio


class Ratios(NamedTuple):
    """Links in proportion: coupler, rocker and frame of a crank of length 1."""

    coupler: float
    rocker: float
    frame: float


def half_angles(swing: float, ratio: float, same: bool) -> tuple[float, float]:
    """p, half of the angle by which the strokes of the crank differ from half a turn, and q, half of the swing [rad].

    alpha = 180 deg (K - 1)/(K + 1),   p = alpha/2, negative where the rocker turns against the crank in the slow stroke

    Parameters
        swing : float [rad]
        ratio : float - K, slow over fast stroke, 1 or more
        same : bool - whether the rocker turns with the crank in the slow stroke
    Example
        >>> [round(math.degrees(angle), 9) for angle in half_angles(math.radians(80.0), 2.0, True)]
        [30.0, 40.0]

    Source
        dead-position synthesis (H. Alt; VDI 2130)
    """
    p = 0.5 * math.pi * (ratio - 1.0) / (ratio + 1.0)
    return (p if same else -p), 0.5 * swing


def best_ratios(p: float, q: float) -> Ratios:
    """Links with the maximum minimum transmission angle that a swing and a time ratio allow.

    t^2 x^3 + 2 x^2 - x - (1 + 1/t^2) tan^2(q - p) = 0,   (b/a)^2 = 1/x,   t = cot p,   0 < x < 1
    d^2 sin^2 q = a^2 cos^2(q - p) + b^2 sin^2(q - p),   c^2 sin^2 q = a^2 cos^2 p + b^2 sin^2 p

    Parameters
        p, q : float [rad] - of `half_angles`; p not 0
    Raises
        NoSolution - where no crank-rocker has this swing and ratio
    Example
        >>> found = best_ratios(*half_angles(math.radians(80.0), 10.0 / 9.0, True))
        >>> [round(120.0 / found.frame * length, 4) for length in (1.0, *found)]
        [46.6717, 116.161, 73.8832, 120.0]

    Source
        F. Freudenstein and E. J. F. Primrose, 1973: Q^3 + 2 Q^2 - t^2 Q - (t^2/u^2)(1 + t^2) = 0 with Q = t^2 x, here
        found as the stationary point of the worse transmission angle over b/a; the triangles of both dead centres
    """
    t2, turned = 1.0 / math.tan(p) ** 2, math.tan(q - p) ** 2

    def cubic(x: float) -> float:
        return ((t2 * x + 2.0) * x - 1.0) * x - (1.0 + 1.0 / t2) * turned

    if not cubic(1.0) > 0.0:
        alpha = 2.0 * abs(math.degrees(p))
        bound = f"< {safely_below(180.0 - 2.0 * alpha)}" if p < 0.0 else f"> {safely_above(2.0 * alpha - 180.0)}"
        raise NoSolution(
            f"swing: {short(2.0 * math.degrees(q))} deg (limit {bound} deg with strokes of {short(180.0 + alpha)} and "
            f"{short(180.0 - alpha)} deg of the crank)",
            fix=_easier(p),
        )
    if turned == 0.0:  # of q = p the root x = 0 is none of a linkage
        return ratios_of(math.sqrt(1.0 + math.sqrt(1.0 + t2)), p, q)
    return ratios_of(1.0 / math.sqrt(bracketed_root(cubic, 0.0, 1.0)), p, q)


def ratios_of(coupler: float, p: float, q: float) -> Ratios:
    """The links of one coupler over crank: the triangles A, C outer, C inner, and the same with the frame turned."""
    rocker = math.hypot(math.cos(p), coupler * math.sin(p)) / math.sin(q)
    frame = math.hypot(math.cos(q - p), coupler * math.sin(q - p)) / math.sin(q)
    return Ratios(coupler, rocker, frame)


def ratios_with_frame(frame: float, p: float, q: float) -> Ratios:
    """The links of one frame over crank.

    Raises
        NoSolution - where no coupler gives that frame
    Example
        >>> found = ratios_with_frame(2.0, *half_angles(math.radians(80.0), 10.0 / 9.0, True))
        >>> [round(60.0 * length, 3) for length in found]
        [103.197, 93.965, 120.0]
    """
    room = (frame * math.sin(q) - math.cos(q - p)) * (frame * math.sin(q) + math.cos(q - p))
    turn = abs(math.sin(q - p))
    if room <= 0.0 or turn == 0.0:
        least = abs(math.cos(q - p)) / math.sin(q)
        raise NoSolution(
            f"frame over crank: {unlike(frame, least)} (limit > {safely_above(least)} with this swing and time ratio)",
            fix="shorten the crank, or lengthen the frame",
        )
    found = ratios_of(math.sqrt(room) / turn, p, q)
    return found._replace(frame=frame)


def _nowhere(p: float, q: float) -> NoSolution:
    alpha = math.degrees(2.0 * abs(p))
    return NoSolution(
        f"no crank-rocker swings by {short(math.degrees(2.0 * q))} deg with strokes of {short(180.0 + alpha)} and "
        f"{short(180.0 - alpha)} deg of the crank",
        fix=_easier(p),
    )


def _easier(p: float) -> str:
    return "set slow_stroke to same" if p < 0.0 else "use a quick_return_ratio nearer to 1"


def require_task(linkage: FourBar, swing: float, ratio: float, same: bool) -> None:
    """Refuse links whose dead centres, on their one assembly, are not those that were asked for.

    Raises
        NoSolution
    """
    p, q = half_angles(swing, ratio, same)
    if linkage.kind() == "crank-rocker":
        dead = DeadCenters(linkage)
        sense = ratio == 1.0 or dead.same is same
        if sense and abs(dead.swing - swing) <= _FIT * swing and abs(dead.ratio - ratio) <= _FIT * ratio:
            return
    raise _nowhere(p, q)


# Three pairs of angles


class ThroughPairs(NamedTuple):
    """A linkage through three pairs of angles.

    crank, coupler, rocker : float [mm] - magnitudes
    crank_offset, rocker_offset : float [rad] - 0 or pi, to be added to the given angles
    assembly : +1 or -1 - of the linkage so turned
    """

    crank: float
    coupler: float
    rocker: float
    crank_offset: float
    rocker_offset: float
    assembly: int


def through_pairs(pairs: Sequence[Sequence[float]], frame: float) -> ThroughPairs:
    """The four-bar that goes through three pairs of crank and rocker angle.

    k1 cos psi - k2 cos phi + k3 = cos(phi - psi),   a = d/k1,   c = d/k2,   b^2 = a^2 + c^2 + d^2 - 2 a c k3

    Parameters
        pairs : three of (phi, psi) [rad]
        frame : float - d [mm]
    Raises
        NoSolution - where the equations are singular, the coupler is not real, the pairs lie on different assemblies,
            or coupler and rocker are collinear at one of them, so that it belongs to none
    Example
        >>> pairs = [[math.radians(angle) for angle in pair] for pair in ((40, 50), (90, 80), (160, 110))]
        >>> found = through_pairs(pairs, 100.0)
        >>> round(found.crank, 9), round(found.coupler, 9), round(found.rocker, 9), found.assembly
        (17.489141449, 95.634157854, 28.557521937, -1)

    Source
        F. Freudenstein's equation; a negative length points the other way, hence the offsets
    """
    k1, k2, k3 = _constants(pairs)
    a, c = frame / k1, frame / k2
    square = math.fsum((a * a, c * c, frame * frame, -2.0 * a * c * k3))
    if not square > 0.0 or math.isinf(square):
        raise NoSolution(
            "no linkage goes through these pairs: its coupler would have no real length",
            fix="move one of function.pairs",
        )
    b = math.sqrt(square)
    sides = set()
    for number, (phi, psi) in enumerate(pairs, 1):
        pin, joint = cmath.rect(a, phi), frame + cmath.rect(c, psi)
        across = ((joint - pin).conjugate() * (joint - frame)).imag / (b * abs(c))
        if abs(across) < _IN_LINE:
            raise NoSolution(
                f"coupler and rocker are collinear at pair {number}, which then is a dead centre",
                fix=f"move function.pairs[{number - 1}]",
            )
        sides.add(across > 0.0)
    if len(sides) > 1:
        raise NoSolution(
            "the pairs need different assemblies of the linkage, and it cannot move from one to the other",
            fix="move one of function.pairs",
        )
    crank_offset, rocker_offset = (math.pi if length < 0.0 else 0.0 for length in (a, c))
    return ThroughPairs(abs(a), b, abs(c), crank_offset, rocker_offset, 1 if sides.pop() else -1)


def _constants(pairs: Sequence[Sequence[float]]) -> tuple[float, float, float]:
    """k1, k2, k3 of the equation; differences of cosines as products of sines, so that near pairs keep their digits."""
    (phi, psi), *others = pairs
    rows = []
    for other_phi, other_psi in others:
        first = _cosine_step(psi, other_psi)
        rows.append((first, -_cosine_step(phi, other_phi), _cosine_step(phi - psi, other_phi - other_psi)))
    (a1, b1, r1), (a2, b2, r2) = rows
    det, size = a1 * b2 - a2 * b1, abs(a1 * b2) + abs(a2 * b1)
    over, under = r1 * b2 - r2 * b1, a1 * r2 - a2 * r1
    sizes = (det, size), (over, abs(r1 * b2) + abs(r2 * b1)), (under, abs(a1 * r2) + abs(a2 * r1))
    if any(abs(each) <= _SINGULAR * terms for each, terms in sizes):
        raise NoSolution(
            "these pairs give no linkage of finite length: two of them are equal, or rocker and crank turn in "
            "proportion",
            fix="move one of function.pairs",
        )
    k1, k2 = over / det, under / det
    return k1, k2, math.cos(phi - psi) - k1 * math.cos(psi) + k2 * math.cos(phi)


def _cosine_step(start: float, end: float) -> float:
    """cos(end) - cos(start)."""
    return -2.0 * math.sin(0.5 * (start + end)) * math.sin(0.5 * (end - start))


# A function


class Generated(NamedTuple):
    """A linkage that goes through a function at three places.

    Fields
        start, zero : float [rad] - crank and rocker angle at the first x, without offsets
        pairs : three of (phi, psi) [rad]
        error : float [rad] - maximum structural error
        place : float - share of the crank's swing at which it is
    """

    start: float
    zero: float
    pairs: tuple[tuple[float, float], ...]
    error: float
    place: float


_PLACES = tuple(0.5 - 0.5 * math.cos(math.radians(30.0 * k)) for k in (1, 3, 5))
"""Shares of the swing at which a polynomial through three points is nearest to a function: P. L. Chebyshev's."""
_STARTS = 24  # directions of crank and rocker that are tried, before the best is refined
_LAST_STEP = math.radians(0.001)
_DESCENTS = 8


def generated(wanted: Wanted, start: float, zero: float, least: float) -> Generated | None:
    """The linkage of frame 1 through a function from a start on; None where there is none, or where it opens.

    Parameters
        start, zero : float [rad] - crank and rocker angle at the first x
        least : float [rad] - transmission angle that it keeps over the swing
    """
    from gearlink.core.numerics.extremes import maximum_over

    at = wanted.output(np.array(_PLACES))
    pairs = tuple((start + s * wanted.input_swing, zero + float(y)) for s, y in zip(_PLACES, at, strict=True))
    try:
        bar = through_pairs(pairs, 1.0)
    except NoSolution:
        return None

    def angles(s: Reals) -> tuple[Reals, Reals]:
        """Error of the rocker, and sine of the transmission angle; NaN where the linkage opens."""
        pin = bar.crank * np.exp(1j * (start + bar.crank_offset + s * wanted.input_swing))
        way = 1.0 - pin
        n = np.abs(way)
        along = 0.5 * (n * n + (bar.coupler - bar.rocker) * (bar.coupler + bar.rocker))
        with np.errstate(invalid="ignore"):
            across = np.sqrt((bar.coupler * n - along) * (bar.coupler * n + along))
        joint = pin + way * (along + 1j * bar.assembly * across) / (n * n)
        meant = np.exp(1j * (zero + bar.rocker_offset + wanted.output(s)))
        return np.angle((joint - 1.0) / meant), across / (bar.coupler * bar.rocker)

    # the sine is least at an end of the swing, or where the crank lies along the frame
    first, swing = start + bar.crank_offset, wanted.input_swing
    low, high = sorted((first / math.pi, (first + swing) / math.pi))
    along_frame = [(math.pi * k - first) / swing for k in range(math.ceil(low), math.floor(high) + 1)]
    if not float(np.min(angles(np.array([0.0, 1.0, *along_frame]))[1])) >= math.sin(least):
        return None
    worst = maximum_over(lambda s: np.abs(angles(s)[0]), 0.0, 1.0, samples=129)
    return Generated(start, zero, pairs, worst.value, worst.place)


def best_start(wanted: Wanted, given: tuple[float | None, float | None], least: float) -> Generated:
    """The start of least structural error: of what is not given a grid of directions, then downhill from those of its
    best that lie apart.

    Raises
        NoSolution - where no linkage goes through the function
    """
    grid = [2.0 * math.pi * k / _STARTS for k in range(_STARTS)]
    starts, zeros = ([each] if each is not None else grid for each in given)
    found = [one for a in starts for b in zeros if (one := generated(wanted, a, b, least)) is not None]
    if not found:
        raise NoSolution(
            f"no linkage generates this function with a transmission angle of {math.degrees(least):g} deg",
            key="function",
            fix="use smaller swings, or reduce limits.transmission_angle",
        )
    best = min((_descended(wanted, one, given, least) for one in _apart(found)), key=lambda one: one.error)
    offsets = through_pairs(best.pairs, 1.0)
    turns = math.floor((best.start + offsets.crank_offset) / (2.0 * math.pi)) * (given[0] is None)
    if turns:  # the first turn of the crank is meant
        best = generated(wanted, best.start - 2.0 * math.pi * turns, best.zero, least) or best
    return best


def _apart(found: list[Generated]) -> list[Generated]:
    """The best of the grid, each farther than two of its steps from all that are better."""
    chosen: list[Generated] = []
    for one in sorted(found, key=lambda one: one.error):
        ways = (max(_between(one.start, other.start), _between(one.zero, other.zero)) for other in chosen)
        if all(way > 4.5 * math.pi / _STARTS for way in ways):
            chosen.append(one)
            if len(chosen) == _DESCENTS:
                break
    return chosen


def _between(one: float, other: float) -> float:
    """Angle between two directions, of which opposite ones give the same linkage."""
    return abs(math.remainder(one - other, math.pi))


def _descended(wanted: Wanted, best: Generated, given: tuple[float | None, float | None], least: float) -> Generated:
    """The least structural error downhill from a start, in what is not given.

    Source
        J. A. Nelder and R. Mead, The Computer Journal 7 (1965) 308, by scipy: the error has an edge, not a slope, at
        its minimum, and the linkages that keep the transmission angle end beside it
    """
    from scipy.optimize import minimize

    here = [best.start, best.zero]
    free = [k for k, each in enumerate(given) if each is None]

    def at(x: Reals) -> Generated | None:
        start, zero = (x[free.index(k)] if k in free else here[k] for k in (0, 1))
        return generated(wanted, float(start), float(zero), least)

    def error(x: Reals) -> float:
        found = at(x)
        return math.tau if found is None else found.error

    if not free:
        return best
    first = np.array([here[k] for k in free])
    simplex = np.vstack([first, first + math.pi / _STARTS * np.eye(len(free))])
    options = {"initial_simplex": simplex, "xatol": _LAST_STEP, "fatol": _LAST_STEP**2}
    found = at(minimize(error, first, method="Nelder-Mead", options=options).x)
    return best if found is None or found.error > best.error else found


# The designs

_OF_PAIRS = Outline(
    (
        *(*LENGTHS, "crank_offset", "rocker_offset", "assembly"),
        *("structural_error", "structural_error_at", "function_start", "output_zero"),
        *MOTION,
    ),
    ("full-turn", "transmission-angle"),
    ("motion",),
)


class _Synthesis(CrankRocker):
    """Links that are found: they complete the file instead of the task."""

    section = ""

    def completion(self) -> Iterator[Found]:
        """The links, their assembly, and none of the task."""
        bar = self.linkage
        links = {name: getattr(bar, name) for name in ("crank", "coupler", "rocker", "frame")}
        yield Found("links", links, f"found by synth {self.section}")
        yield Found("assembly", bar.assembly)
        if self.crank_range is not None and self.spec.range is None:
            yield Found("range", [math.degrees(angle) for angle in self.crank_range], f"from {self.section}")
        yield from (Found(section, None) for section in ("swing", "function"))


class SwingSynthesis(_Synthesis):
    """`synth swing`: swing and time ratio of the rocker, with the best transmission angle or a crank and a frame."""

    section = "swing"
    keys = dict.fromkeys(
        ("synth swing", "analyze"),
        (
            *(("rocker_swing", "swing.angle"), ("quick_return_ratio", "swing.quick_return_ratio")),
            *(("min_transmission_angle", ">limits.transmission_angle"), "crank_length", "coupler_length"),
            *("rocker_length", "frame_length", "outer_dead_center", "inner_dead_center", "rocker_acceleration_max"),
            *("rocker_acceleration_min", "speed_ratio_max", "speed_ratio_min", "acceleration_ratio_max"),
        ),
    )
    outlines = {"synth swing": CrankRocker.outlines["analyze"], "analyze": CrankRocker.outlines["analyze"]}
    ways = {"transmission-angle": either("swing.crank")}
    requirements = CrankRocker.requirements | {"swing.slow_stroke"}
    remedy = "specify a smaller swing with a quick_return_ratio nearer to 1"

    def candidates(self, check: str, /) -> Iterable[Remedy]:
        """The other sense, a smaller time ratio, a smaller swing, or both; see `_eased`."""
        return _eased(self) if check == "transmission-angle" else ()

    @property
    def task(self) -> Any:
        """The section `swing`."""
        return section_of(self.spec, "swing", "angle (deg), quick_return_ratio, and a length (mm)")

    @cached_property
    def linkage(self) -> FourBar:
        """The four-bar with the dead centres that are asked for."""
        task = self.task
        swing, same = math.radians(task.angle), task.slow_stroke == "same"
        ratio: float = task.quick_return_ratio
        p, q = half_angles(swing, ratio, same)
        if len(task.given) == 2:
            with at_key("swing"):
                found, crank = ratios_with_frame(task.frame / task.crank, p, q), task.crank
        elif p == 0.0:
            raise NoSolution(
                "with a quick_return_ratio of 1 there is no optimum: the shorter the crank, the better the "
                "transmission angle",
                key="swing.quick_return_ratio",
                fix="give crank and frame, or a ratio above 1",
            )
        else:
            with at_key("swing"):
                found = best_ratios(p, q)
            (name,) = task.given
            crank = getattr(task, name) / (1.0 if name == "crank" else getattr(found, name))
        lengths = {"crank": crank, **{name: crank * ratio for name, ratio in found._asdict().items()}}
        lengths |= {name: getattr(task, name) for name in task.given}
        with at_key("swing"):
            linkage = FourBar(**lengths, assembly=self.spec.assembly)
            require_task(linkage, swing, ratio, same)
        return linkage


def _eased(design: SwingSynthesis) -> Iterator[Remedy]:
    """Tasks with better transmission angles: slow_stroke: same, where crank and rocker may have that sense; then less.

    Each is the most that can be asked for, first with what is recommended, then within the limit.
    """
    task, limit = design.task, design.spec.limits.transmission_angle
    turned: Remedy = (("swing.slow_stroke", "same"),) if task.slow_stroke == "opposite" else ()
    if turned:
        yield turned
    for least in (recommended_angle(limit), limit):
        for sense in ((), turned) if turned else ((),):
            for of_ratio, of_swing in ((1.0, 0.0), (0.0, 1.0), (1.0, 1.0)):
                yield from _most(design, sense, (of_ratio, of_swing), math.radians(least))


def _most(design: SwingSynthesis, sense: Remedy, shares: tuple[float, float], least: float) -> Iterator[Remedy]:
    """The largest time ratio, swing, or both in proportion, with a minimum transmission angle; none where none does."""
    task = design.task

    def at(i: int) -> Remedy:
        ratio = math.floor(100.0 * (task.quick_return_ratio - 1.0) * (1.0 - shares[0] * i / _EASED)) / 100.0 + 1.0
        angle = math.floor(2.0 * task.angle * (1.0 - shares[1] * i / _EASED)) / 2.0
        values = (("quick_return_ratio", round(ratio, 2)), ("angle", angle))
        return (*sense, *((f"swing.{key}", value) for (key, value), share in zip(values, shares, strict=True) if share))

    def holds(i: int) -> bool:
        spec = changed(design.given, at(i))
        if spec is None or spec.swing.quick_return_ratio == 1.0:
            return False
        try:
            return SwingSynthesis(spec).min_transmission_angle >= least
        except NoSolution:
            return False

    bad, good = 0, next((i for i in range(_EASED - 1, 0, -1) if holds(i)), 0)
    if not good:
        return
    while good - bad > 1:
        middle = (bad + good) // 2
        bad, good = (bad, middle) if holds(middle) else (middle, good)
    yield at(good)


class FunctionSynthesis(_Synthesis):
    """`synth function`: the linkage through three pairs of angles."""

    section = "function"
    keys = dict.fromkeys(
        ("synth function", "analyze"),
        (
            *("crank_length", "coupler_length", "rocker_length", "frame_length", "crank_offset", "rocker_offset"),
            *("structural_error", "function_start", "output_zero"),
            *(("min_transmission_angle", ">limits.transmission_angle"), "rocker_swing", "assembly"),
            *("rocker_acceleration_max", "quick_return_ratio"),
        ),
    )
    outlines = {"synth function": _OF_PAIRS, "analyze": _OF_PAIRS}
    ways = {}
    remedy = "specify a smaller swing of the rocker, or move a pair"

    @cached_property
    def found(self) -> ThroughPairs:
        """Lengths, offsets and assembly."""
        task = section_of(
            self.spec, "function", "pairs (deg) and frame (mm); or name, x, input_swing, output_swing (deg) and frame"
        )
        with at_key("function" if task.pairs is None else "function.pairs"):
            return through_pairs(self.pairs, task.frame)

    @cached_property
    def generated(self) -> Generated | None:
        """The function and its error; None of given pairs."""
        task = self.spec.function
        if task is None or task.pairs is not None:
            return None
        from gearlink.core.parts.linkages.functions import Wanted

        with at_key("function"):
            wanted = Wanted.of(task)
        starts = [None if each is None else math.radians(each) for each in (task.input_start, task.output_start)]
        free = None in starts
        least = math.radians(self.spec.limits.transmission_angle) if free else 0.0
        return best_start(wanted, (starts[0], starts[1]), least)

    @cached_property
    def pairs(self) -> list[list[float]]:
        """Crank and rocker angle, three times [rad]."""
        if self.generated is not None:
            return [list(pair) for pair in self.generated.pairs]
        assert self.spec.function is not None
        return [[math.radians(angle) for angle in pair] for pair in self.spec.function.pairs or ()]

    structural_error: float | None = placed("generated.error")

    @property
    def structural_error_at(self) -> list[float] | None:
        """Crank angle at which it is [rad], the offset added."""
        if self.generated is None or self.spec.function is None:
            return None
        swing = math.radians(self.spec.function.input_swing or 0.0)
        return [self.generated.start + self.crank_offset + self.generated.place * swing]

    @property
    def function_start(self) -> float | None:
        """Crank angle at the first x [rad], the offset added."""
        return None if self.generated is None else self.generated.start + self.crank_offset

    @property
    def output_zero(self) -> float | None:
        """Rocker angle at the first y [rad], the offset added."""
        return None if self.generated is None else self.generated.zero + self.rocker_offset

    crank_offset: float = placed("found.crank_offset")
    rocker_offset: float = placed("found.rocker_offset")
    assembly: int = placed("found.assembly")

    @cached_property
    def linkage(self) -> FourBar:
        """The four-bar, with the offsets added to the given angles."""
        found = self.found
        assert self.spec.function is not None
        return FourBar(found.crank, found.coupler, found.rocker, self.spec.function.frame, found.assembly)

    def outline(self, command: str) -> Outline:
        """Of a linkage that opens between the pairs there is no motion through them to show."""
        found = super().outline(command)
        if command not in self.outlines or self._turns or self._between is not None:
            return found
        shown = tuple(name for name in found.quantities if name not in MOTION)
        return Outline(shown, ("full-turn",))

    @cached_property
    def _turns(self) -> bool:
        return self.linkage.kind() in ("crank-rocker", "drag-link")

    @cached_property
    def _between(self) -> tuple[float, float] | None:
        """First and last crank angle [rad] of a way through the pairs, the short one where it closes."""
        given = [pair[0] + self.crank_offset for pair in self.pairs]
        short = given[:1]
        for angle in given[1:]:
            short.append(short[-1] + math.remainder(angle - short[-1], 2.0 * math.pi))
        for angles in (short, given):
            try:
                for angle in inner_places(min(angles), max(angles)):
                    solve(self.linkage, angle, order=1)
            except NoSolution:
                continue
            return min(angles), max(angles)
        return None

    @cached_property
    def crank_range(self) -> tuple[float, float] | None:
        """From the first to the last pair [rad], where the crank does not turn fully; None where it turns.

        Raises
            NoSolution - where the linkage opens between the pairs
        """
        if self._turns:
            return None
        if self._between is None:
            raise NoSolution(_APART, key="function.pairs", fix="move one of function.pairs")
        return self._between

    def check_full_turn(self) -> Check:
        """GL330: whether the crank turns fully."""
        kind = self.linkage.kind()
        if self._turns:
            return FULL_TURN.check("pass", f"the linkage is a {kind}: its crank turns fully")
        what = f"the linkage is a {kind}, its crank cannot turn fully"
        if self._between is None:
            return FULL_TURN.check("warn", f"{what}, and {_APART}", fix="move one of function.pairs")
        start, end = (short(math.degrees(angle)) for angle in self._between)
        return FULL_TURN.check("warn", what, aside=f"it moves from {start} to {end} deg")


_APART = "it does not close between the pairs, and reaches all of them only if it is reassembled"


def class_of(spec: Any) -> type[CrankRocker]:
    """The class of the design of a file, its links given or found."""
    classes = {"": CrankRocker, "synth swing": SwingSynthesis, "synth function": FunctionSynthesis}
    return classes[spec.sized_by("analyze")]
