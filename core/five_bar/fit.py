"""A geared five-bar whose coupler point runs through given points, by least squares."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from gearlink.core.errors import NoSolution
from gearlink.core.five_bar.descent import PathProblem, descend, matched, thinned
from gearlink.core.five_bar.family import FiveBarFamily
from gearlink.core.five_bar.path import distances
from gearlink.core.five_bar.path_motion import PathFiveBar
from gearlink.core.five_bar.starts import bounds, scattered_starts
from gearlink.core.numerics.arrays import Points, Reals
from gearlink.core.wording import amount

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
        transmission_angle : float [rad] - the least that is allowed, between coupler and follower
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
        raise NoSolution(f"{amount(targets.size, 'point')}: give at least three for a path")
    scale = float(np.max(np.abs(targets[:, None] - targets[None, :])))
    if not scale > 0.0:
        raise NoSolution("all points are the same: a path needs at least two different ones")
    given = [judge(start, offset, targets)] if closes(start, 0.0) else []
    with np.errstate(all="ignore"):  # rows that open are NaN and drop out
        rows = _search(start, offset / scale, targets / scale, transmission_angle, scale)
    known = rows[np.all(np.isfinite(rows), axis=1)]
    closing = (one for row in known if closes((one := row_as_bar(start, row, scale))[0], transmission_angle))
    found = [judge(bar, m, targets) for bar, m in islice(closing, 1)]
    if not given and not found:
        raise NoSolution(
            "none of the starts closes over a whole turn with the transmission angle that is asked for: start from "
            "links that do (longer coupler and follower), or lower limits.transmission_angle"
        )
    return min(found + given, key=lambda fit: fit.rms)


def closes(bar: PathFiveBar, least: float) -> bool:
    """Whether a five-bar closes over its whole period with a transmission angle [rad]."""
    try:
        return bar.min_transmission_angle()[0] >= least
    except NoSolution:
        return False


def _search(start: PathFiveBar, offset: complex, targets: Points, least: float, scale: float) -> Reals:
    """Rows of unknowns at the ends of the search, lengths by the scale, the best first."""
    family = family_of(start, scale)
    lengths = np.log((start.input, start.coupler, start.follower, start.output)) - math.log(scale)
    first = np.array([*lengths, start.phase, offset.real, offset.imag])
    problem = PathProblem(family, targets, *bounds(first), math.cos(least), 1.0)
    x = scattered_starts(family, first, thinned(problem, _CHOOSING).targets, least)
    x = np.concatenate((first[None, :], x))
    for rows, steps, weight, most in _STAGES:
        stage = _refined(replace(thinned(problem, most), weight=weight), rows)
        x = x[: rows + 1]
        x, _, cost = descend(stage, x, matched(stage, x), steps)
        x = x[np.argsort(cost, kind="stable")]
    return _finished(_refined(replace(problem, weight=weight), _LAST), x[:_LAST], least)


def _finished(problem: PathProblem, x: Reals, least: float) -> Reals:
    """The last stage, over all targets, and more steps for rows that still miss the transmission angle."""
    x, phi, cost = descend(_aimed(problem, least + _MARGIN), x, matched(problem, x), _STEPS)
    spans = _between(_SPANS_TO_FINISH * problem.family.waves, _FEWEST_SPANS, _MOST_SPANS_TO_FINISH)
    problem = replace(problem, family=replace(problem.family, span_count=spans))
    for margin in _MARGINS:
        missing = ~(np.max(problem.family.cosines(x)[0], axis=1) <= math.cos(least))
        if not np.any(missing):
            break
        more = descend(_aimed(problem, least + margin), x[missing], phi[missing], _MORE_STEPS)
        x[missing], phi[missing], cost[missing] = more
    return np.asarray(x[np.argsort(cost, kind="stable")])


def _aimed(problem: PathProblem, angle: float) -> PathProblem:
    return replace(problem, cosine=math.cos(angle))


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


def row_as_bar(bar: PathFiveBar, row: Reals, scale: float) -> tuple[PathFiveBar, complex]:
    """Five-bar and coupler point of a row."""
    a, b, c, e = (math.exp(float(x) + math.log(scale)) for x in row[:4])
    phase = math.remainder(float(row[4]), 2.0 * math.pi)
    return replace(bar, input=a, coupler=b, follower=c, output=e, phase=phase), scale * complex(row[5], row[6])
