"""A geared five-bar whose coupler point runs through given points, at any or at given input angles: least squares.

A search starts from five-bars that are scattered about a given one, close, and have their coupler points settled.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.wording import amount
from gearlink.core.machines.five_bar.family import UNKNOWNS, FiveBarFamily, near_places, nearest
from gearlink.core.machines.five_bar.function_fit import Round
from gearlink.core.machines.five_bar.path import distances, points
from gearlink.core.machines.five_bar.path_motion import PathFiveBar
from gearlink.core.numerics.arrays import Mask, Points, Reals
from gearlink.core.numerics.lm import DAMPING, State, damped, damped_normal, descend, normal
from gearlink.core.numerics.quasi_random import halton

# So many starts, fewer where starts times targets times places would pass the work of a round.
_TRIED, _ROUND = 600, 3_000_000
_ROUNDS = 5
# Lengths stay within this of the first's, by their logarithms.
_WIDEST = 2.5
# Scatter of the logarithms of the lengths; the coupler point lies within so many couplers.
_SCATTER, _START_REACH = 0.7, 1.5
# Starts close with this much to spare [rad], with couplers that differ by one of these shares of what was scattered.
_START_MARGIN = math.radians(0.5)
_SHARES = (1.0, 0.5, 0.25, 0.0)


def bounds(first: Reals) -> tuple[Reals, Reals]:
    """Minimum and maximum unknowns of a search: lengths from e^-2.5 to e^2.5 times those of the start."""
    reach = np.where(np.arange(UNKNOWNS) < 4, _WIDEST, math.inf)
    return first - reach, first + reach


def scattered_starts(
    family: FiveBarFamily, first: Reals, targets: Points, transmission_angle: float, number: int = 0
) -> Reals:
    """Five-bars that close, at fixed places about a given one (no random numbers), the most promising first.

    Parameters
        first : (7,) array - unknowns of the given one
        targets : (N,) complex array
        transmission_angle : float [rad] - the minimum that is allowed
        number : int - of the round; each has places of its own
    Returns
        x : (K, 7) array - up to 600 rows, by the mean square of the targets' distances from their paths
    Notes
        Couplers that do not reach, or not with this transmission angle, are made as long as the spans need.
    """
    count, begin = min(_TRIED, _ROUND // (targets.size * family.count)), number * _TRIED
    share = halton(begin + 1, count, UNKNOWNS)
    x = np.tile(first, (len(share), 1))
    x[:, :4] += _SCATTER * (2.0 * share[:, :4] - 1.0)
    x[:, 4] += 2.0 * math.pi * share[:, 4]
    x, closed = _closing(family, x, first, min(transmission_angle + _START_MARGIN, 0.5 * math.pi))
    x[:, 5:] = 0.5 * first[5:] + _START_REACH * np.exp(x[:, 1:2]) * (2.0 * share[:, 5:] - 1.0)
    return _settled(family, x[closed], targets)


def _closing(family: FiveBarFamily, x: Reals, first: Reals, least: float) -> tuple[Reals, Mask]:
    """The same with couplers as long as the spans need, and which rows such couplers exist for."""
    low, high = bounds(first)
    short, long = family.spans(x)
    middle, unlike = 0.5 * (x[:, 1] + x[:, 2]), x[:, 2] - x[:, 1]
    x, closed = x.copy(), np.zeros(len(x), dtype=bool)
    for differ in (share * unlike for share in _SHARES):
        least_b, most_b = _coupler_bounds(differ, short, long, math.cos(least))
        least_b = np.maximum(least_b, np.maximum(low[1], low[2] - differ))
        most_b = np.minimum(most_b, np.minimum(high[1], high[2] - differ))
        new = (least_b < most_b) & ~closed
        coupler = np.clip(middle - 0.5 * differ, least_b, most_b)
        x[new, 1], x[new, 2] = coupler[new], (coupler + differ)[new]
        closed |= new
    return x, closed


def _coupler_bounds(differ: Reals, short: Reals, long: Reals, cosine: float) -> tuple[Reals, Reals]:
    """Bounds of ln b at a given ln(c/b), so that the transmission angle keeps its limit at both spans.

    long^2/(1 + r^2 + 2 r cos) <= b^2 <= short^2/(1 + r^2 - 2 r cos),   r = c/b
    """
    r = np.exp(differ)
    low = np.log(long) - 0.5 * np.log(1.0 + r * r + 2.0 * r * cosine)
    high = np.log(short) - 0.5 * np.log(1.0 + r * r - 2.0 * r * cosine)
    return low, high


def _settled(family: FiveBarFamily, x: Reals, targets: Points) -> Reals:
    """The same with the coupler points that suit the targets best, sorted by the mean square of the distances.

    With the nearest places known, the best u + i v is a mean: the path is linear in it. Both steps take turns.
    """
    start, unit = family.grid_path(x)
    offset = x[:, 5:6] + 1j * x[:, 6:7]
    for _ in range(_ROUNDS):
        places = nearest(start + offset * unit, targets)
        turned, gap = np.take_along_axis(unit, places, axis=1), targets - np.take_along_axis(start, places, axis=1)
        offset = np.mean(np.conj(turned) * gap, axis=1, keepdims=True)
    square = np.mean(np.abs(gap - offset * turned) ** 2, axis=1)
    order = np.argsort(np.where(np.isfinite(square), square, math.inf), kind="stable")
    return np.concatenate((x[:, :5], offset.real, offset.imag), axis=1)[order]


_LEAST_DAMPING = 1e-15
# Longest step of a logarithm, of the phase, and of an input angle [rad].
_REACH, _PHI_REACH = 0.5, 0.3
_MATCHED_EVERY = 10
_FOOT_STEPS = 3
# So many branches of a path that crosses itself are tried for each target.
_BRANCHES = 3
# How far the limit of the cosine is drawn in against the give of a penalty.
_MOST_SHIFT = 0.3
_SLOW = 1e-9


@dataclass(frozen=True, slots=True)
class PathProblem:
    """Points that the paths of a family shall meet.

    Parameters
        targets : (N,) complex array - about 1 apart
        low, high : (7,) arrays - bounds of the unknowns
        cosine : float - maximum |cos| of the transmission angle
        weight : float - of its excess, against distances
    """

    family: FiveBarFamily
    targets: Points
    low: Reals
    high: Reals
    cosine: float
    weight: float


def descended(problem: PathProblem, x: Reals, phi: Reals, steps: int) -> tuple[Reals, Reals, Reals]:
    """Rows of unknowns after so many Levenberg-Marquardt steps, each row with its own damping.

    sum |M(phi_j) - P_j|^2 + weight^2 sum max(0, |cos| - limit)^2 -> min over x and every phi_j

    Parameters
        x : (K, 7) array - starts; phi : (K, N) array [rad] - places of their paths for each target
        steps : int - at most; fewer once no row gains
    Returns
        x, phi : as given; cost : (K,) array - mean square of the distances and penalties; inf where the row opens
    Notes
        Each phi_j occurs in its own point alone and is eliminated: in the direction of the path a miss counts only as
        far as the damping holds phi_j. What is left are normal equations for seven unknowns. Every ten steps the
        targets are matched with the paths anew, and the limit is drawn in by what the penalty gave way (method of
        multipliers), so that it is met at a moderate weight.
    Source
        D. W. Marquardt, J. SIAM 11 (1963) 431-441; M. J. D. Powell, in: Optimization (1969) 283-298; own derivation
    """
    limit, damping = np.full((len(x), 2), problem.cosine), np.full(len(x), DAMPING)
    z, targets = np.concatenate((x, phi), axis=1), phi.shape[1]
    state, step = partial(_state, problem), partial(_step, problem)
    for first in range(0, steps, _MATCHED_EVERY):
        if first:
            x = z[:, :UNKNOWNS]
            z = np.concatenate((x, matched(problem, x, z[:, UNKNOWNS:])), axis=1)
            limit, damping = _drawn_in(problem, x, limit), np.minimum(damping, DAMPING)
        few = min(_MATCHED_EVERY, steps - first)
        found = descend(state, step, z, few, given=(limit,), damping=damping, least=_LEAST_DAMPING)
        z, (cost, *_), damping, taken = found
        if taken < few:
            break
    return z[:, :UNKNOWNS], z[:, UNKNOWNS:], cost / targets


def matched(problem: PathProblem, x: Reals, phi: Reals | None = None) -> Reals:
    """Input angles of the places of each path nearest to each target.

    Parameters
        x : (K, 7) array
        phi : (K, N) array [rad] - places so far, kept where they are nearer
    Returns
        phi : (K, N) array [rad]
    Notes
        Of the three nearest branches on the grid, the feet of the perpendiculars in three steps of Gauss and Newton.
    """
    family = problem.family
    point, velocity = family.path(x, family.grid[None, :])
    tried = family.grid[near_places(point, velocity, family.step, problem.targets, _BRANCHES)]
    if phi is not None:
        tried = np.concatenate((tried, phi[..., None]), axis=2)
    feet, away = _feet(problem, x, tried)
    best = np.argmin(np.where(np.isfinite(away), away, np.inf), axis=2)
    return np.asarray(np.squeeze(np.take_along_axis(feet, best[..., None], axis=2), axis=2))


def _feet(problem: PathProblem, x: Reals, tried: Reals) -> tuple[Reals, Reals]:
    """Feet of the perpendiculars, sought within a step of the grid, and the distances; (K, N, tries) arrays."""
    targets = np.repeat(problem.targets, tried.shape[2])
    start = tried.reshape(len(x), -1)
    phi, step = start, problem.family.step
    for _ in range(_FOOT_STEPS):
        point, velocity = problem.family.path(x, phi)
        along = (np.conj(velocity) * (point - targets)).real / np.maximum(np.abs(velocity) ** 2, _SLOW**2)
        phi = np.clip(phi - np.nan_to_num(along), start - step, start + step)
    away = np.abs(problem.family.path(x, phi)[0] - targets)
    return phi.reshape(tried.shape), away.reshape(tried.shape)


def _state(problem: PathProblem, z: Reals, limit: Reals) -> State:
    """Cost (K,), misses (K, N), path velocities (K, N), slopes (K, N, 7), penalties (K, 8) with slopes (K, 8, 7)."""
    x = z[:, :UNKNOWNS]
    found = problem.family.path_slopes(x, z[:, UNKNOWNS:])
    cosine, slopes = problem.family.cosines(x)
    excess = cosine - np.repeat(limit, cosine.shape[1] // 2, axis=1)
    on, miss = excess > 0.0, found.point - problem.targets
    penalty = problem.weight * np.where(on, excess, 0.0)
    slopes = problem.weight * np.where(on[..., None], slopes, 0.0)
    cost = np.sum(miss.real**2 + miss.imag**2, axis=1) + np.sum(penalty**2, axis=1)
    return np.where(np.isfinite(cost), cost, np.inf), miss, found.velocity, found.slopes, penalty, slopes


def _drawn_in(problem: PathProblem, x: Reals, limit: Reals) -> Reals:
    """The limits at the minimum and the maximum span, lowered by the excess there, raised where there is room."""
    cosine = problem.family.cosines(x)[0].reshape(len(x), 2, -1).max(axis=2)
    shift = np.clip(limit - cosine, -_MOST_SHIFT, 0.0)
    return np.asarray(problem.cosine + np.where(np.isfinite(shift), shift, 0.0))


def _step(problem: PathProblem, z: Reals, state: State, damping: Reals) -> Reals:
    """Steps of the unknowns and of the input angles; an unknown at its bound that is pushed outward stays there."""
    _, miss, velocity, slopes, penalty, penalty_slopes = state
    x, speed = z[:, :UNKNOWNS], np.maximum(np.abs(velocity), _SLOW)
    back = np.conj(np.where(np.abs(velocity) > _SLOW, velocity / speed, 1.0))
    slopes, miss = slopes * back[..., None], miss * back
    held = np.sqrt(damping / (1.0 + damping))[:, None]
    rows = np.concatenate((slopes.imag, held[..., None] * slopes.real, penalty_slopes), axis=1)
    value = np.concatenate((miss.imag, held * miss.real, penalty), axis=1)
    slope = np.squeeze(np.swapaxes(rows, 1, 2) @ value[..., None], axis=2)
    free = ~((x <= problem.low) & (slope > 0.0) | (x >= problem.high) & (slope < 0.0))
    step = damped(rows, value, damping, free=free)
    longest = np.max(np.abs(step[:, :5]), axis=1, keepdims=True)
    step = step * np.minimum(1.0, _REACH / np.maximum(longest, 1e-300))
    left = miss.real + np.squeeze(slopes.real @ step[..., None], axis=2)
    turned = np.clip(-left / (speed * (1.0 + damping[:, None])), -_PHI_REACH, _PHI_REACH)
    return np.concatenate((np.clip(x + step, problem.low, problem.high), z[:, UNKNOWNS:] + turned), axis=1)


def thinned(problem: PathProblem, most: int) -> PathProblem:
    """The same with at most so many of the targets, evenly taken from their row."""
    count = problem.targets.size
    if count <= most:
        return problem
    return replace(problem, targets=problem.targets[np.linspace(0, count - 1, most).round().astype(int)])


# Places of the grid by wave of the fastest part, how few and many they are in all: for the starts, and for a stage,
# where rows times targets times places are limited.
_PER_WAVE, _FEWEST, _MOST = 120, 240, 480
_STAGE_PER_WAVE, _STAGE_FEWEST, _WORK = 60, 120, 200_000
# As many for the span, finer at the end, when the extremes of a long period must not be missed.
_SPANS, _FEWEST_SPANS, _MOST_SPANS = 12, 120, 2400
_SPANS_TO_FINISH, _MOST_SPANS_TO_FINISH = 40, 20_000
# Targets that choose the starts. Stages: rows, steps, weight of the limit, targets; the last looks at all of them.
_CHOOSING = 16
_STAGES = ((64, 15, 3.0, 24), (16, 30, 10.0, 64))
_LAST, _STEPS, _MORE_STEPS = 3, 120, 20
# The search aims so much higher than the limit, against rounding; higher where a penalty gave way [rad].
_MARGIN, *_MARGINS = (math.radians(margin) for margin in (0.005, 0.02, 0.1, 0.5, 2.0))


@dataclass(frozen=True, slots=True)
class Fit:
    """A five-bar, its coupler point u + i v [mm], and the distance of each point from its path [mm]."""

    bar: PathFiveBar
    offset: complex
    distance: NDArray[np.float64]

    @property
    def rms(self) -> float:
        """Root of the mean square of the distances [mm]."""
        return float(np.sqrt(np.mean(self.distance**2)))


def judge(bar: PathFiveBar, offset: complex, targets: Points) -> Fit:
    """A five-bar with the distances of the points from its real path.

    Raises
        NoSolution - where the five-bar opens
    """
    return Fit(bar, offset, distances(bar, offset, targets)[0])


def fit_path(start: PathFiveBar, offset: complex, targets: Points, transmission_angle: float) -> Fit:
    """Links, phase and coupler point with which the path comes nearest to given points.

    sum |M(phi_j) - P_j|^2 -> min over a, b, c, e, delta, u, v and every phi_j

    Parameters
        start : PathFiveBar - a start; frame, gear ratio and assembly are kept
        offset : complex [mm] - u + i v to start with
        targets : (N,) complex array [mm] - in the frame of the five-bar, any order, N >= 3
        transmission_angle : float [rad] - the minimum that is allowed, between coupler and follower
    Returns
        fit : Fit - the distances are those from the path of the five-bar that is given, over its whole period
    Raises
        NoSolution - for fewer than three points, or where no start closes
    Notes
        The budget is fixed, in evaluations, not in time: the same points give the same fit. Up to 600 scattered starts
        (no random numbers), their couplers made to close, are compared in five rounds of at most 3 million distances;
        the 64 best and the given one take 15 steps of Levenberg and Marquardt, the 17 best of them 30 more, the 3 best
        120 more, and at most 80 more where the transmission angle is missed. The first two stages look at no more than
        24 and 64 of the points, and matching points with paths takes at most 200 000 distances a time, or 120 places of
        each path. Only the search's best five-bar that closes is judged by its real path, beside the given one.
    Source
        thesis 2.2.1, figure 2-1; own derivation
    """
    if targets.size < 3:
        raise NoSolution(amount(targets.size, "point"), fix="give at least three for a path")
    scale = _widest(targets)
    given = [judge(start, offset, targets)] if closes(start, 0.0) else []
    with np.errstate(all="ignore"):  # rows that open are NaN and drop out
        rows = _search(start, offset, targets / scale, transmission_angle, scale)
    known = rows[np.all(np.isfinite(rows), axis=1)]
    closing = (one for row in known if closes((one := row_as_bar(start, row, scale))[0], transmission_angle))
    found = [judge(bar, m, targets) for bar, m in islice(closing, 1)]
    if not given and not found:
        raise NoSolution(_NONE_CLOSES, fix=_LONGER)
    return min(found + given, key=lambda fit: fit.rms)


_NONE_CLOSES = "none of the starts closes over a whole revolution with the required transmission angle"
_LONGER = "start from links that do (longer coupler and follower), or reduce limits.transmission_angle"


def _widest(targets: Points) -> float:
    """Distance of the two points farthest apart."""
    scale = float(np.max(np.abs(targets[:, None] - targets[None, :])))
    if not scale > 0.0:
        raise NoSolution("all points are the same: a path needs at least two different ones")
    return scale


def closes(bar: PathFiveBar, least: float) -> bool:
    """Whether a five-bar closes over its whole period with a transmission angle [rad]."""
    try:
        return bar.min_transmission_angle()[0] >= least
    except NoSolution:
        return False


def _search(start: PathFiveBar, offset: complex, targets: Points, least: float, scale: float) -> Reals:
    """Rows of unknowns at the ends of the search, lengths by the scale, the best first."""
    family = family_of(start, scale)
    first = as_row(start, offset, scale)
    problem = PathProblem(family, targets, *bounds(first), math.cos(least), 1.0)
    x = scattered_starts(family, first, thinned(problem, _CHOOSING).targets, least)
    x = np.concatenate((first[None, :], x))
    for rows, steps, weight, most in _STAGES:
        stage = _refined(replace(thinned(problem, most), weight=weight), rows)
        x = x[: rows + 1]
        x, _, cost = descended(stage, x, matched(stage, x), steps)
        x = x[np.argsort(cost, kind="stable")]
    return _finished(_refined(replace(problem, weight=weight), _LAST), x[:_LAST], least)


def _finished(problem: PathProblem, x: Reals, least: float) -> Reals:
    """The last stage, over all targets, and more steps for rows that still miss the transmission angle."""
    x, phi, cost = descended(replace(problem, cosine=math.cos(least + _MARGIN)), x, matched(problem, x), _STEPS)
    spans = _between(_SPANS_TO_FINISH * problem.family.waves, _FEWEST_SPANS, _MOST_SPANS_TO_FINISH)
    problem = replace(problem, family=replace(problem.family, span_count=spans))
    for margin in _MARGINS:
        missing = ~(np.max(problem.family.cosines(x)[0], axis=1) <= math.cos(least))
        if not np.any(missing):
            break
        aimed = replace(problem, cosine=math.cos(least + margin))
        x[missing], phi[missing], cost[missing] = descended(aimed, x[missing], phi[missing], _MORE_STEPS)
    return np.asarray(x[np.argsort(cost, kind="stable")])


def _refined(problem: PathProblem, rows: int) -> PathProblem:
    """The same with as fine a grid as the work of a stage allows."""
    most = max(_WORK // (rows * problem.targets.size), _STAGE_FEWEST)
    count = _between(_STAGE_PER_WAVE * problem.family.waves, _STAGE_FEWEST, most)
    return replace(problem, family=replace(problem.family, count=count))


def _between(places: float, fewest: int, most: int) -> int:
    return math.ceil(min(max(places, fewest), most))


def family_of(bar: PathFiveBar, scale: float) -> FiveBarFamily:
    """Five-bars of the same frame, gears and assembly, lengths by a scale, on grids for a search of starts."""
    family = FiveBarFamily(bar.frame / scale, float(bar.ratio), bar.assembly, bar.period, _FEWEST, _FEWEST_SPANS)
    spans = _between(_SPANS * family.waves, _FEWEST_SPANS, _MOST_SPANS)
    return replace(family, count=_between(_PER_WAVE * family.waves, _FEWEST, _MOST), span_count=spans)


def as_row(bar: PathFiveBar, offset: complex, scale: float) -> Reals:
    """Unknowns (7,) of a five-bar and its coupler point."""
    lengths = np.array([bar.input, bar.coupler, bar.follower, bar.output])
    return np.array([*np.log(lengths / scale), bar.phase, offset.real / scale, offset.imag / scale])


def row_as_bar(bar: PathFiveBar, row: Reals, scale: float) -> tuple[PathFiveBar, complex]:
    """Five-bar and coupler point of a row."""
    a, b, c, e = (scale * math.exp(float(x)) for x in row[:4])
    phase = math.remainder(float(row[4]), 2.0 * math.pi)
    return replace(bar, input=a, coupler=b, follower=c, output=e, phase=phase), scale * complex(row[5], row[6])


_PLACES = 48  # of the first point over the period, for each start
_FOLLOWED, _TIMED_STEPS, _BEST = 48, 120, 6
_WEIGHT = 10.0
_TIMED_MARGIN = math.radians(0.05)


@dataclass(frozen=True, slots=True)
class TimedFit:
    """A five-bar with its misses, the input angle of the first point [rad], and how the search came to it."""

    fit: Fit
    first_angle: float
    rounds: tuple[Round, ...]


def fit_timed(
    start: PathFiveBar,
    offset: complex,
    targets: Points,
    angles: Reals,
    transmission_angle: float,
    seconds: float | None = None,
) -> TimedFit:
    """Links, phase, coupler point and start with which the point is nearest to where it shall be at each time.

    sum |M(phi_0 + theta_j) - P_j|^2 -> min over a, b, c, e, delta, u, v, phi_0

    Parameters
        start : PathFiveBar - a start; frame, gear ratio and assembly are kept
        offset : complex [mm] - u + i v to start with
        targets : (N,) complex array [mm] - N >= 3
        angles : (N,) array [rad] - theta_j, input angles from the first point's
        transmission_angle : float [rad] - the minimum that is allowed
        seconds : float or None - budget of time: rounds are begun until it is spent; without one there is one round,
            and the same points give the same fit
    Returns
        fit : TimedFit - the distances are those from the points at their own times
    Raises
        NoSolution - for points that are all the same, or where no start closes
    Notes
        Each round: up to 600 scattered starts that close, the 48 whose paths come nearest tried at 48 places of the
        first point, 120 steps of Levenberg and Marquardt; the transmission angle is a penalty.
    """
    scale = _widest(targets)
    begun, best, rounds, tried = time.monotonic(), None, [], 0
    for number in range(1 if seconds is None else 1_000_000):
        with np.errstate(all="ignore"):  # rows that open are NaN and drop out
            count, rows = _searched(start, offset, targets / scale, angles, transmission_angle, scale, number)
        tried += count
        for found in _judged(start, rows, targets, angles, transmission_angle, scale):
            best = found if best is None or found.fit.rms < best.fit.rms else best
        rounds.append(Round(tried, math.nan if best is None else best.fit.rms))
        if seconds is not None and time.monotonic() - begun >= seconds:
            break
    if best is None:
        raise NoSolution(_NONE_CLOSES, fix=_LONGER)
    return TimedFit(best.fit, best.first_angle, tuple(rounds))


def _judged(
    start: PathFiveBar, rows: Reals, targets: Points, angles: Reals, least: float, scale: float
) -> Iterator[TimedFit]:
    """The best rows that close, measured on their own motion."""
    for row in rows[np.all(np.isfinite(rows), axis=1)][:_BEST]:
        bar, offset = row_as_bar(start, row[:7], scale)
        if closes(bar, least):
            distance = np.abs(points(bar, row[7] + angles, offset) - targets)
            yield TimedFit(Fit(bar, offset, distance), float(row[7]) % bar.period, ())


def _searched(
    start: PathFiveBar, offset: complex, targets: Points, angles: Reals, least: float, scale: float, number: int
) -> tuple[int, Reals]:
    """Number of starts, and rows of the seven unknowns and phi_0 at the ends of the search, the best first."""
    family = family_of(start, scale)
    first = as_row(start, offset, scale)
    x = scattered_starts(family, first, targets, least, number)
    count = len(x) + (number == 0)
    x = np.concatenate((first[None, :], x[:_FOLLOWED])) if number == 0 else x[:_FOLLOWED]
    if not len(x):
        return count, np.empty((0, 8))
    z = _placed(family, x, targets, angles)
    return count, _descended(family, z, targets, angles, math.cos(least + _TIMED_MARGIN), bounds(first))


def _placed(family: FiveBarFamily, x: Reals, targets: Points, angles: Reals) -> Reals:
    """Each row with the place of the first point, and the coupler point, that suit the points best."""
    best, square = np.concatenate((x, np.zeros((len(x), 1))), axis=1), np.full(len(x), np.inf)
    for first in family.period * np.arange(_PLACES) / _PLACES:
        phi = np.broadcast_to(first + angles, (len(x), angles.size))
        at = family.path_slopes(x, phi)
        unit = at.slopes[..., 5]
        base = at.point - (x[:, 5:6] + 1j * x[:, 6:7]) * unit
        offset = np.mean(np.conj(unit) * (targets - base), axis=1, keepdims=True)
        miss = np.mean(np.abs(base + offset * unit - targets) ** 2, axis=1)
        nearer = miss < square
        square[nearer] = miss[nearer]
        best[nearer, 5], best[nearer, 6], best[nearer, 7] = offset[nearer, 0].real, offset[nearer, 0].imag, first
    return best


def _descended(
    family: FiveBarFamily, z: Reals, targets: Points, angles: Reals, cosine: float, limits: tuple[Reals, Reals]
) -> Reals:
    """Rows after Levenberg's and Marquardt's steps, the best first."""

    def slopes(_z: Reals, state: State) -> State:
        _, value, slopes = state
        return normal(np.nan_to_num(slopes), np.nan_to_num(value))

    def step(z: Reals, state: State, damping: Reals) -> Reals:
        moved = damped_normal(state[3], state[4], damping)
        new = z + np.clip(moved, -0.4, 0.4)
        new[:, :7] = np.clip(new[:, :7], *limits)
        return new

    z, (cost, *_), _, _ = descend(
        lambda z: _timed_state(family, z, targets, angles, cosine), step, z, _TIMED_STEPS, slopes=slopes
    )
    return np.asarray(z[np.argsort(cost, kind="stable")])


def _timed_state(family: FiveBarFamily, z: Reals, targets: Points, angles: Reals, cosine: float) -> State:
    """Squares, misses and excess of the cosine with their derivatives for every row; infinite where it opens."""
    x = z[:, :7]
    at = family.path_slopes(x, z[:, 7:8] + angles)
    miss = at.point - targets
    slopes = np.concatenate((at.slopes, at.velocity[..., None]), axis=2)
    limit, limit_slopes = family.cosines(x)
    excess = _WEIGHT * np.maximum(0.0, limit - cosine)
    over = np.where((excess > 0.0)[..., None], _WEIGHT * limit_slopes, 0.0)
    over = np.concatenate((over, np.zeros((*over.shape[:2], 1))), axis=2)
    value = np.concatenate((miss.real, miss.imag, excess), axis=1)
    cost = np.sum(value**2, axis=1)
    return np.where(np.isfinite(cost), cost, np.inf), value, np.concatenate((slopes.real, slopes.imag, over), axis=1)
