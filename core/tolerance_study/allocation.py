"""Which grade each part needs: the cheapest choice of IT grades that reaches a yield."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np

from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.sobol import MOST_DIMENSIONS, Sobol
from gearlink.core.tolerance.iso_286 import standard_tolerance
from gearlink.core.tolerance_study.problem import Problem, no
from gearlink.core.tolerance_study.statistics import result

_MOST = 1_000_000
_DRAWS = 1 << 14
_MIDDLE_GRADE = 9
_TRIALS = 2  # choices that are confirmed by samples


@dataclass(frozen=True)
class Graded:
    """A source whose grade may be chosen.

    Parameters
        size : float [mm]; finest, coarsest : int - IT grades; cost : float - at IT9; capability : float - C_p
    """

    size: float
    finest: int
    coarsest: int
    cost: float = 1.0
    capability: float = 1.0

    def sigma(self, grade: int) -> float:
        """Standard deviation at a grade [mm]."""
        return standard_tolerance(self.size, grade) / (6.0 * self.capability)


@dataclass(frozen=True)
class Wish:
    """A requirement in its linear form: gains per mm of each graded source, the room to either limit (inf: none), and
    the standard deviation that sources without grades leave."""

    gains: tuple[float, ...]
    below: float
    above: float
    rest: float = 0.0


@dataclass(frozen=True)
class Choice:
    """Grades and their cost."""

    grades: tuple[int, ...]
    cost: float


def choices(sources: Sequence[Graded], wishes: Sequence[Wish], target: float, ratio: float) -> Iterator[Choice]:
    """Choices of grades that reach the target by the linear model, the cheapest first.

    cost = sum cost_i ratio^(9 - grade)

    Parameters
        target : float - yield, 0..1
        ratio : float - cost of one grade finer
    Yields
        choices : Choice - none where even the finest grades miss
    Notes
        All combinations up to a million; beyond that the path of a greedy search from the finest grades.
    Example
        >>> sizes = (38.94, 112.0, 112.0, 153.53)
        >>> wish = Wish((2.9581448247, 1.0285307299, 1.0285307299, 0.7503110467), 0.05, 0.05)
        >>> next(choices([Graded(size, 5, 11) for size in sizes], [wish], 0.9973, 1.6)).grades
        (6, 7, 8, 8)

    Source
        own formulation; cost per grade is an assumption of the file
    """
    ranges = [range(one.finest, one.coarsest + 1) for one in sources]
    sigmas = [{grade: one.sigma(grade) for grade in grades} for one, grades in zip(sources, ranges, strict=True)]

    def cost(grades: Sequence[int]) -> float:
        return sum(one.cost * ratio ** (_MIDDLE_GRADE - grade) for one, grade in zip(sources, grades, strict=True))

    def reached(grades: Sequence[int]) -> float:
        return _yield([sigmas[i][grade] for i, grade in enumerate(grades)], wishes)

    every = math.prod(len(grades) for grades in ranges)
    table = sorted(itertools.product(*ranges), key=cost) if every <= _MOST else _greedy(ranges, cost, reached, target)
    for grades in table:
        if reached(grades) >= target:
            yield Choice(tuple(grades), cost(grades))


def _yield(sigmas: Sequence[float], wishes: Sequence[Wish]) -> float:
    """Yield of the linear model: exact for one wish, from fixed normal draws for several that share sources."""
    single = [
        _within(wish, math.hypot(wish.rest, *(g * s for g, s in zip(wish.gains, sigmas, strict=True))))
        for wish in wishes
    ]
    if len(wishes) < 2 or (max(single, default=1.0) == 1.0 and sum(value < 1.0 for value in single) < 2):
        return min(single, default=1.0)
    draws = _draws(len(sigmas) + len(wishes))
    good = np.ones(len(draws), dtype=bool)
    for i, wish in enumerate(wishes):
        off = draws[:, : len(sigmas)] @ (np.array(wish.gains) * sigmas) + wish.rest * draws[:, len(sigmas) + i]
        good &= (off <= wish.above) & (off >= -wish.below)
    return min(float(good.mean()), *single)


def _within(wish: Wish, sigma: float) -> float:
    if sigma == 0.0:
        return 1.0 if min(wish.above, wish.below) >= 0.0 else 0.0
    upper, lower = wish.above / (sigma * math.sqrt(2.0)), wish.below / (sigma * math.sqrt(2.0))
    return 1.0 - 0.5 * math.erfc(upper) - 0.5 * math.erfc(lower)


@lru_cache(maxsize=2)
def _draws(width: int) -> Reals:
    """Normal draws, the same for all grades that are weighed."""
    from scipy.special import ndtri

    rng = np.random.default_rng(np.random.SeedSequence(0, spawn_key=(0,)))
    found: Reals = ndtri(Sobol(width, rng, bits=53).points(0, _DRAWS))
    return found


def _greedy(ranges: list[range], cost: object, reached: object, target: float) -> list[tuple[int, ...]]:
    """Grades made coarser one at a time, where the yield falls least for the cost saved; the cheapest first."""
    grades = [row[0] for row in ranges]
    path = [tuple(grades)]
    while True:
        steps = []
        for i, row in enumerate(ranges):
            if grades[i] < row[-1]:
                trial = [*grades]
                trial[i] += 1
                steps.append((reached(trial), cost(grades) - cost(trial), trial))  # type: ignore[operator]
        there = [step for step in steps if step[0] >= target]
        if not there:
            return path[::-1]
        loss = reached(grades)  # type: ignore[operator]
        grades = min(there, key=lambda step: (loss - step[0]) / step[1])[2]
        path.append(tuple(grades))


def table_rows(study: Any) -> list[tuple[Any, ...]]:
    """The grades that a study needs: chosen by the slopes, confirmed by samples of the design, else one choice on.

    Parameters
        study : ToleranceStudy
    Returns
        rows : (source, grade, plus_minus [mm], cost, yield of the samples, whether one grade coarser keeps the target)
    Raises
        WrongStudy - without target, or without a source whose grade may be chosen, or where no grades reach it
    """
    made = study.problem
    target = made.section.target_yield
    places = [i for i, source in enumerate(made.sources) if source.entry.grades is not None and source.kind != "pin"]
    if target is None or not places:
        what = "target_yield" if target is None else "grades: [finest, coarsest] on a source"
        raise no("GL171", f"--allocate needs {what}")
    graded = [_graded(made.sources[i]) for i in places]
    wishes = list(_wishes(study, places))
    if not wishes:
        raise no("GL171", "--allocate needs a line of require that compares one quantity with a number", "require")
    if len(wishes) > MOST_DIMENSIONS - len(places):
        most = MOST_DIMENSIONS - len(places)
        raise no(
            "GL171", f"--allocate weighs {most} quantities at most beside so many grades: ask for fewer", "require"
        )
    ratio = made.section.cost.ratio
    found = None
    for found in itertools.islice(choices(graded, wishes, target, ratio), _TRIALS):
        reached = _sampled(made, places, found.grades)
        if reached >= target:
            break
    if found is None:
        raise no(
            "GL171",
            "even the finest grades miss the target yield: widen grades, or loosen the requirement",
            "target_yield",
        )
    rows = []
    for i, one, grade in zip(places, graded, found.grades, strict=True):
        coarser = [grade + (place == i) for place, grade in zip(places, found.grades, strict=True)]
        free = grade < one.coarsest and _linear(graded, wishes, coarser) >= target
        half = 0.5 * standard_tolerance(one.size, grade)
        rows.append((made.sources[i].key, grade, half, one.cost * ratio ** (_MIDDLE_GRADE - grade), reached, free))
    return rows


def _graded(source: Any) -> Graded:
    finest, coarsest = source.entry.grades
    return Graded(abs(source.nominal), finest, coarsest, source.entry.cost, source.entry.cp)


def _wishes(study: Any, places: Sequence[int]) -> Iterator[Wish]:
    """Requirements that compare one quantity with a number, about the nominal value."""
    names = {one.expression.tree for one in study.problem.requirements if isinstance(one.expression.tree, str)}
    for name in study.varying:
        if name not in names:
            continue
        lower, upper = study.limits(name)
        rows, middle = study.slopes[name], study.nominal[name]
        rest = math.hypot(*(row.sigma for i, row in enumerate(rows) if i not in places), 0.0)
        gains = tuple(rows[i].gain[0] for i in places)
        below = math.inf if lower is None else middle - lower
        yield Wish(gains, below, math.inf if upper is None else upper - middle, rest)


def _linear(graded: Sequence[Graded], wishes: Sequence[Wish], grades: Sequence[int]) -> float:
    return _yield([one.sigma(grade) for one, grade in zip(graded, grades, strict=True)], wishes)


def _sampled(made: Problem, places: Sequence[int], grades: Sequence[int]) -> float:
    """Lower end of the yield of the design itself with these grades."""
    sources = dict(made.section.sources)
    for i, grade in zip(places, grades, strict=True):
        source = made.sources[i]
        half = 0.5 * standard_tolerance(abs(source.nominal), grade)
        changes = dict.fromkeys(("lower", "upper", "limits", "sigma", "class_", "measured"))
        sources[source.key] = source.entry.model_copy(update={**changes, "plus_minus": half})
    changed = replace(made, section=made.section.model_copy(update={"sources": sources}))
    return result(changed).good.low
