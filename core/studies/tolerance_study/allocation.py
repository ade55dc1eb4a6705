"""Which grade each part needs: the cheapest choice of IT grades that reaches a yield."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from gearlink.core.numerics.arrays import Reals
from gearlink.core.studies.tolerance.correlation import together
from gearlink.core.studies.tolerance.iso_286 import standard_tolerance
from gearlink.core.studies.tolerance.laws import Law
from gearlink.core.studies.tolerance.sampling import REPLICATIONS, replication
from gearlink.core.studies.tolerance.sources import Scatter
from gearlink.core.studies.tolerance_study.problem import Problem, no
from gearlink.core.studies.tolerance_study.statistics import result

_MOST = 1_000_000
_DRAWS, _FIRST_LOOK, _FAR = 1 << 14, 1 << 10, 0.1
_MIDDLE_GRADE = 9
_TRIALS = 8  # choices that are put to the samples

Grades = Sequence[int]
LinearYield = Callable[[Grades], float]


@dataclass(frozen=True)
class Graded:
    """A source whose grade may be chosen: finest and coarsest IT grade, cost at IT9."""

    finest: int
    coarsest: int
    cost: float = 1.0


@dataclass(frozen=True)
class Requirement:
    """A requirement in its linear form.

    Fields
        gains : per unit of each graded source
        below, above : room to either limit (inf: none)
        rest : (N,) array or float - error by the sources without grades, of the draws that the yield is taken from
        spread : float - their standard deviation, where the yield is exact; `rest` is then their mean
    """

    gains: tuple[float, ...]
    below: float
    above: float
    rest: Reals | float = 0.0
    spread: float = 0.0


@dataclass(frozen=True)
class Choice:
    """Grades, their cost, and the yield that the linear model gives them."""

    grades: tuple[int, ...]
    cost: float
    reached: float


def choices(sources: Sequence[Graded], reached: LinearYield, target: float, ratio: float) -> Iterator[Choice]:
    """Choices of grades that reach the target by the linear model, the cheapest first.

    cost = sum cost_i ratio^(9 - grade)

    Parameters
        reached : the yield of some grades, `normal_yield` or `drawn_yield`
        target : float - yield, 0..1
        ratio : float - cost of one grade finer
    Yields
        choices : Choice - none where even the finest grades miss
    Notes
        All combinations up to a million; beyond that the path of a greedy search from the finest grades.
    Example
        >>> def part(size: float, grade: int) -> Law:
        ...     half = 0.5 * standard_tolerance(size, grade)
        ...     return Law("normal", -half, half, 0.0, half / 3.0)
        >>> laws = [{g: part(size, g) for g in range(5, 12)} for size in (38.94, 112.0, 112.0, 153.53)]
        >>> requirement = Requirement((2.9581448247, 1.0285307299, 1.0285307299, 0.7503110467), 0.05, 0.05)
        >>> next(choices([Graded(5, 11)] * 4, normal_yield(laws, requirement), 0.9973, 1.6)).grades
        (6, 7, 8, 8)

    Source
        own formulation; cost per grade is an assumption of the file
    """
    ranges = [range(one.finest, one.coarsest + 1) for one in sources]

    def cost(grades: Grades) -> float:
        return sum(one.cost * ratio ** (_MIDDLE_GRADE - grade) for one, grade in zip(sources, grades, strict=True))

    every = math.prod(len(grades) for grades in ranges)
    table = sorted(itertools.product(*ranges), key=cost) if every <= _MOST else _greedy(ranges, cost, reached, target)
    for grades in table:
        share = reached(grades)
        if share >= target:
            yield Choice(tuple(grades), cost(grades), share)


def normal_yield(laws: Sequence[Mapping[int, Law]], requirement: Requirement) -> LinearYield:
    """Yield of one requirement in parts that scatter normally and apart from each other, exactly.

    Y = Phi((above - mean)/sigma) - Phi((-below - mean)/sigma)

    Parameters
        laws : of each source by grade
    """
    moments = [{grade: law.moments() for grade, law in one.items()} for one in laws]

    def reached(grades: Grades) -> float:
        rows = [(g, *one[grade]) for g, one, grade in zip(requirement.gains, moments, grades, strict=True)]
        mean = float(requirement.rest) + sum(g * part for g, part, _ in rows)
        sigma = math.hypot(requirement.spread, *(g * part for g, _, part in rows))
        upper, lower = requirement.above - mean, requirement.below + mean
        if sigma == 0.0:
            return 1.0 if min(upper, lower) >= 0.0 else 0.0
        root = sigma * math.sqrt(2.0)
        return 1.0 - 0.5 * math.erfc(upper / root) - 0.5 * math.erfc(lower / root)

    return reached


def drawn_yield(
    columns: Sequence[Mapping[int, Reals]], requirements: Sequence[Requirement], target: float
) -> LinearYield:
    """Yield of all requirements together, of any laws, from the same draws for all grades.

    Parameters
        columns : (N,) arrays of the deviations of each source by grade
        target : float - what is far below it is left at a first look at some of the draws
    """

    def share(grades: Grades, count: int | None) -> float:
        parts = [one[grade][:count] for one, grade in zip(columns, grades, strict=True)]
        good: Any = True
        for requirement in requirements:
            rest = requirement.rest[:count] if isinstance(requirement.rest, np.ndarray) else requirement.rest
            off = rest + sum(g * part for g, part in zip(requirement.gains, parts, strict=True))
            good = good & (off <= requirement.above) & (off >= -requirement.below)
        return float(np.mean(good))

    def reached(grades: Grades) -> float:
        first = share(grades, _FIRST_LOOK)
        return first if first < target - _FAR else share(grades, None)

    return reached


def _greedy(ranges: list[range], cost: Any, reached: LinearYield, target: float) -> list[tuple[int, ...]]:
    """Grades made coarser one at a time, where the yield falls minimum for the cost saved; the cheapest first."""
    grades = [row[0] for row in ranges]
    path = [tuple(grades)]
    while True:
        steps = []
        for i, row in enumerate(ranges):
            if grades[i] < row[-1]:
                trial = [*grades]
                trial[i] += 1
                steps.append((reached(trial), cost(grades) - cost(trial), trial))
        there = [step for step in steps if step[0] >= target]
        if not there:
            return path[::-1]
        loss = reached(grades)
        grades = min(there, key=lambda step: (loss - step[0]) / step[1])[2]
        path.append(tuple(grades))


def table_rows(study: Any) -> list[tuple[Any, ...]]:
    """The grades that a study needs: chosen by the slopes, confirmed by samples of the design, else the next choice.

    Parameters
        study : ToleranceStudy
    Returns
        rows : (source, grade, plus_minus [mm], cost, yield of the samples, whether one grade coarser keeps the target
            by the slopes, and in words why it is not taken then)
    Raises
        WrongStudy - without target, or without a source whose grade may be chosen, or where no grades reach it
    """
    made = study.problem
    places = _places(made)
    target, ratio = made.section.target_yield, made.section.cost.ratio
    entries = [made.sources[i].entry for i in places]
    graded = [Graded(entry.grades[0], entry.grades[1], entry.cost) for entry in entries if entry.grades]
    linear = _linear_yield(study, places)
    found, reached, refused = _confirmed(made, places, choices(graded, linear, target, ratio))
    rows = []
    for i, one, grade in zip(places, graded, found.grades, strict=True):
        coarser = [grade + (place == i) for place, grade in zip(places, found.grades, strict=True)]
        free = grade < one.coarsest and linear(coarser) >= target
        source = made.sources[i]
        half = 0.5 * standard_tolerance(abs(source.nominal), grade)
        cost = one.cost * ratio ** (_MIDDLE_GRADE - grade)
        rows.append(
            (source.key, grade, half, cost, reached, free, _why_not(refused.get(tuple(coarser))) if free else "")
        )
    return rows


def _why_not(sampled: float | None) -> str:
    """Why grades that reach the target by the slopes are not taken."""
    if sampled is None:
        return "by the sensitivities alone; samples of like grades missed the target"
    return f"by the sensitivities alone; samples prove no more than {100 * sampled:.6g} %"


def require(made: Problem) -> None:
    """Refuse what gives no grades, before anything is computed.

    Raises
        WrongStudy - without target, without a source whose grade may be chosen, without a requirement that has slopes
    """
    _places(made)
    if not _limited(made):
        window = getattr(made.base.spec(), "dwell_window", None)
        line = "QUANTITY >= NUMBER" if window is None else f"tolerance_dwell_angle >= {window:g} deg"
        message = (
            f"--allocate chooses by the sensitivities of quantities, and a check names none: add require: [{line}]"
        )
        raise no("GL171", message, "require")


def _limited(made: Problem) -> set[str]:
    """Quantities that a requirement compares with a number."""
    trees = {one.expression.tree for one in made.requirements if not isinstance(one.limit, str)}
    return {tree for tree in trees if isinstance(tree, str)}


def _places(made: Problem) -> list[int]:
    """Which sources have grades to choose from."""
    if made.section.target_yield is None:
        raise no("GL171", "--allocate needs a yield to reach, such as target_yield: 0.997", "target_yield")
    found = [i for i, source in enumerate(made.sources) if source.entry.grades is not None and source.kind != "pin"]
    if not found:
        key = made.sources[0].key
        raise no(
            "GL171", f"--allocate needs grades to choose from, such as {key}: {{class: js8, grades: [5, 9]}}", "sources"
        )
    return found


def _linear_yield(study: Any, places: Sequence[int]) -> LinearYield:
    """The yield of grades by the slopes, with the laws and correlations of the file: exact where it can be."""
    made = study.problem
    asked = [name for name in study.varying if name in _limited(made)]
    if not asked:
        raise no(
            "GL171", "no source moves what the lines of require compare with numbers: nothing to choose by", "require"
        )
    by_grade = [_by_grade(made.sources[i]) for i in places]
    alone = len(asked) == 1 and made.correlation is None
    if alone and all(source.kind != "pin" and source.law.form in ("normal", "fixed") for source in made.sources):
        return normal_yield(
            [{g: one.law for g, one in row.items()} for row in by_grade], _requirement(study, asked[0], places)
        )
    drawn = replication(made.coordinates, REPLICATIONS * _DRAWS, made.section.seed, REPLICATIONS)
    points = together(drawn, made.correlation)
    starts = list(itertools.accumulate((source.coordinates for source in made.sources), initial=0))
    columns = [
        {g: one.law.deviations(points[:, starts[i]]) for g, one in row.items()}
        for i, row in zip(places, by_grade, strict=True)
    ]
    return drawn_yield(columns, [_requirement(study, name, places, drawn) for name in asked], made.section.target_yield)


def _by_grade(source: Scatter) -> dict[int, Scatter]:
    """A source made to each of its grades, to either side of its size."""
    finest, coarsest = source.entry.grades or (0, -1)
    return {
        grade: source.within(0.5 * standard_tolerance(abs(source.nominal), grade))
        for grade in range(finest, coarsest + 1)
    }


def _requirement(study: Any, name: str, places: Sequence[int], drawn: Reals | None = None) -> Requirement:
    """What the requirements say of a quantity, about its nominal value."""
    made, rows, middle = study.problem, study.slopes[name], study.nominal[name]
    lower, upper = study.limits(name)
    others = [(source, rows[i]) for i, source in enumerate(made.sources) if i not in places]
    rest: Reals | float = sum(row.gain[0] * source.law.moments()[0] for source, row in others)
    if drawn is not None:
        sizes = made.sizes(drawn)
        rest = sum(
            (_along(row.gain, sizes[source.key] - source.nominal) for source, row in others), np.zeros(len(drawn))
        )
    return Requirement(
        tuple(rows[i].gain[0] for i in places),
        math.inf if lower is None else middle - lower,
        math.inf if upper is None else upper - middle,
        rest,
        math.hypot(*(row.sigma for _, row in others), 0.0),
    )


def _along(gain: Sequence[float], off: Any) -> Reals:
    """Error by a deviation, of a pin by its vector."""
    error: Reals = gain[0] * np.real(off) + (gain[1] * np.imag(off) if len(gain) > 1 else 0.0)
    return error


def _confirmed(
    made: Problem, places: Sequence[int], found: Iterator[Choice]
) -> tuple[Choice, float, dict[tuple[int, ...], float]]:
    """The first choice whose samples reach the target, the lower end of their yield, and that of what missed it.

    Notes
        What fails more often in the samples than by the slopes is expected to do so with the next choices too: those
        that would then miss are passed over.
    Raises
        WrongStudy - where none does
    """
    target, more = made.section.target_yield or 0.0, 1.0
    tried: list[tuple[float, Choice]] = []
    for choice in found:
        if tried and _expected_to_miss(choice, more, target):
            continue
        low = _sampled(made, places, choice.grades)
        if low >= target:
            return choice, low, {choice.grades: low for low, choice in tried}
        tried.append((low, choice))
        if len(tried) == _TRIALS:
            break
        if choice.reached < 1.0:
            more = max(more, (1.0 - low) / (1.0 - choice.reached))
    if not tried:
        message = "even the finest grades miss the target yield: widen grades, or loosen the requirement"
        raise no("GL171", message, "target_yield")
    low, best = max(tried, key=lambda one: one[0])
    named = ", ".join(f"{made.sources[i].key} IT{grade}" for i, grade in zip(places, best.grades, strict=True))
    message = f"by the slopes {named} reach the target yield, but samples of them prove no more than {100 * low:.6g} %"
    raise no("GL171", f"{message}: take finer grades or more --samples, or loosen the requirement", "target_yield")


def _expected_to_miss(choice: Choice, more: float, target: float) -> bool:
    """Whether a choice misses the target if it fails so many times as often as by the slopes."""
    return (1.0 - choice.reached) * more > 1.0 - target


def _sampled(made: Problem, places: Sequence[int], grades: Grades) -> float:
    """Lower end of the yield of the design itself with these grades."""
    sources = dict(made.section.sources)
    for i, grade in zip(places, grades, strict=True):
        source = made.sources[i]
        sources[source.key] = source.within(0.5 * standard_tolerance(abs(source.nominal), grade)).entry
    changed = replace(made, section=made.section.model_copy(update={"sources": sources}))
    return result(changed).good.low
