"""The tolerance study of a design file as a design: yields, spreads, contributions, and the grade of each part.

Contributions are slopes at the nominal design, and Sobol' indices over the whole scatter. Grades are the cheapest
choice of IT grades that reaches a yield.
"""

from __future__ import annotations

import cmath
import itertools
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from gearlink.core.base.design import Design, Outline, placed
from gearlink.core.base.errors import MissingSection, NoSolution
from gearlink.core.base.report import Check, Shown, Table, safely_above, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.numerics.arrays import Points, Reals
from gearlink.core.studies.codes import NO_MECHANISM, NOT_LINEAR, TARGET_YIELD
from gearlink.core.studies.study.faults import WrongStudy
from gearlink.core.studies.tolerance.correlation import groups, pairs, together
from gearlink.core.studies.tolerance.iso_286 import standard_tolerance
from gearlink.core.studies.tolerance.laws import Law
from gearlink.core.studies.tolerance.sampling import REPLICATIONS, Estimate, estimate, replication, rounded_up
from gearlink.core.studies.tolerance.sources import Scatter, numbers_of
from gearlink.core.studies.tolerance_study.problem import MOST_WITH_INDICES, Problem, no, problem
from gearlink.core.studies.tolerance_study.samples import (
    Course,
    columns_of,
    courses,
    evaluated,
    judged,
    replicated,
    replication_size,
)
from gearlink.core.studies.tolerance_study.statistics import Result, Spread, capabilities, result

_MOST_TRIED = 1_000_000
_SHIFTS = (-2, -1, 1, 2)  # grades by which sources are changed together, three of up to so many, else two
_FEW_SOURCES = 12
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
        All combinations up to a million; beyond that a greedy search from the finest grades, then changes of a few
        grades at once that save cost: in 300 requirements of 3 to 5 parts 0.1 % above the cheapest on average.
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
    table = (
        sorted(itertools.product(*ranges), key=cost) if every <= _MOST_TRIED else _greedy(ranges, cost, reached, target)
    )
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
    """Grades made coarser one at a time, with the smallest loss of yield for the cost saved; the cheapest first."""
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
            return [*path, *_exchanged(path[-1], ranges, cost, reached, target)][::-1]
        loss = reached(grades)
        grades = min(there, key=lambda step: (loss - step[0]) / step[1])[2]
        path.append(tuple(grades))


def _exchanged(
    grades: tuple[int, ...], ranges: list[range], cost: Any, reached: LinearYield, target: float
) -> Iterator[tuple[int, ...]]:
    """Cheaper and cheaper grades: each time the cheapest that differ in a few sources and reach the target."""
    most = 3 if len(ranges) <= _FEW_SOURCES else 2

    def like(now: tuple[int, ...]) -> Iterator[tuple[int, ...]]:
        for count in range(1, most + 1):
            for places in itertools.combinations(range(len(now)), count):
                for shifts in itertools.product(_SHIFTS, repeat=count):
                    moved = dict(zip(places, shifts, strict=True))
                    trial = tuple(grade + moved.get(i, 0) for i, grade in enumerate(now))
                    if all(grade in row for grade, row in zip(trial, ranges, strict=True)):
                        yield trial

    found: tuple[int, ...] | None = grades
    while found is not None:
        now = cost(found)
        cheaper = sorted((price, trial) for trial in like(found) if (price := cost(trial)) < now * (1.0 - _WORTH))
        found = next((trial for _, trial in cheaper if reached(trial) >= target), None)
        if found is not None:
            yield found


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
    return f"by the sensitivities alone; samples prove no more than {safely_below(100 * sampled)} %"


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
            f"--allocate chooses by the sensitivities of quantities, and a check names none\nadd require: [{line}]"
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
            "GL171",
            "no source moves what the lines of require compare with numbers: --allocate cannot choose",
            "require",
        )
    by_grade = [_by_grade(made.sources[i]) for i in places]
    alone = len(asked) == 1 and made.correlation is None
    if alone and all(source.kind != "pin" and source.law.form in ("normal", "fixed") for source in made.sources):
        return normal_yield(
            [{g: one.law for g, one in row.items()} for row in by_grade], _requirement(study, asked[0], places)
        )
    drawn = replication(made.coordinates, REPLICATIONS * _DRAWS, made.section.seed, REPLICATIONS)
    points = together(drawn, made.correlation)
    own = numbers_of(made.sources)
    columns = [
        {g: one.law.deviations(points[:, own[i].start]) for g, one in row.items()}
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
        message = "even the finest grades miss the target yield\nwiden grades, or relax the requirement"
        raise no("GL171", message, "target_yield")
    low, best = max(tried, key=lambda one: one[0])
    named = ", ".join(f"{made.sources[i].key} IT{grade}" for i, grade in zip(places, best.grades, strict=True))
    message = f"by the sensitivities {named} reach the target yield, samples prove {safely_below(100 * low)} %"
    raise no("GL171", f"{message}\ntake finer grades or more --samples, or relax the requirement", "target_yield")


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


_KINK = 0.1  # of the whole scatter: sides that differ by more belong to no line


@dataclass(frozen=True)
class Slope:
    """Slope of a quantity in one source [unit of the quantity per unit of the source]; of a pin in both directions.

    `sigma` is what the source adds to the quantity's standard deviation by that slope, `bend` what it adds by the
    difference of the slopes to either side. `kink`: that is so much of the whole that no linear share applies.
    """

    gain: tuple[float, ...]
    sigma: float
    bend: float
    kink: bool = False


def slopes(made: Problem, names: Sequence[str]) -> dict[str, list[Slope]]:
    """Slopes of quantities in every source, at the nominal design.

    (4 D(h/2) - D(h))/3 with the central differences D over h, half of the tolerance or 1e-5 of the size

    Returns
        slopes : by quantity, one for each source
    Notes
        One-sided slopes that differ tell of a kink, a place where one of several extremes takes over, or of a bend: a
        drive that is best as it is has slope 0.
    Source
        L. F. Richardson, Phil. Trans. R. Soc. A 210 (1911) 307
    """
    steps = [(source, axis, _step(source)) for source in made.sources for axis in _axes(source)]
    shifts: list[Mapping[str, complex]] = [{}]
    for source, axis, h in steps:
        shifts += [{source.key: share * h * axis} for share in (1.0, -1.0, 0.5, -0.5)]
    found = evaluated(made, made.offsets(shifts)).quantities
    result: dict[str, list[Slope]] = {}
    for name in names:
        values = found[name]
        per_axis = [_slope(values[0], values[1 + 4 * i : 5 + 4 * i], h) for i, (_, _, h) in enumerate(steps)]
        rows = iter(per_axis)
        found_slopes = [_of_source(source, [next(rows) for _ in _axes(source)]) for source in made.sources]
        whole = math.hypot(*(row.sigma for row in found_slopes), *(row.bend for row in found_slopes))
        result[name] = [replace(row, kink=not row.bend <= _KINK * whole) for row in found_slopes]
    return result


def _axes(source: Scatter) -> tuple[complex, ...]:
    return (1.0, 1j) if source.kind == "pin" else (1.0,)


def _step(source: Scatter) -> float:
    """Half of the width of the scatter, or a small part of the size."""
    width = abs(source.law.upper - source.law.lower) if source.kind != "pin" else source.limit
    return max(0.25 * width, 1e-5 * abs(source.nominal), 1e-9)


def _slope(middle: float, values: Reals, h: float) -> tuple[float, float]:
    """Slope, and by how much those to either side differ."""
    up, down, half_up, half_down = values.tolist()
    wide, narrow = (up - down) / (2.0 * h), (half_up - half_down) / h
    return (4.0 * narrow - wide) / 3.0, abs(half_up - 2.0 * middle + half_down) / (0.5 * h)


def _of_source(source: Scatter, rows: list[tuple[float, float]]) -> Slope:
    gain = tuple(row[0] for row in rows)
    return Slope(gain, math.hypot(*gain) * source.sigma, math.hypot(*(row[1] for row in rows)) * source.sigma)


def linear_shares(
    rows: Sequence[Slope], sources: Sequence[Scatter], correlations: Mapping[tuple[str, str], float]
) -> list[float | None]:
    """Shares of the variance by the slopes; None for all where one of them has a kink, or nothing varies.

    A source's share is its covariance with the whole: with correlations it may be negative, and all still add up to 1.
    """
    signed = [math.copysign(row.sigma, row.gain[0]) for row in rows]
    parts = [
        one
        * sum(correlations.get((a.key, b.key), float(a is b)) * other for b, other in zip(sources, signed, strict=True))
        for a, one in zip(sources, signed, strict=True)
    ]
    whole = sum(parts)
    if whole <= 0.0 or not math.isfinite(whole) or any(row.kink for row in rows):
        return [None] * len(rows)
    return [part / whole for part in parts]


@dataclass(frozen=True)
class Indices:
    """First and total Sobol' index of a source, none negative, the first not above the total."""

    first: Estimate
    total: Estimate


def indices(made: Problem, names: Sequence[str]) -> dict[str, list[Indices]]:
    """Sobol' indices of quantities in every source.

    S_i = [mean(f_B f_C) - f0^2]/V (Janon),   T_i = mean((f_A - f_C)^2)/(2 V) (Jansen)

    Notes
        C is A with the source's columns of B; sources that vary together have one index, that of their group.
        Each replication by itself, with the mean and variance of its own; the
        interval is that of the replications.
    Source
        I. M. Sobol', Math. Comput. Simul. 55 (2001) 271; A. Janon et al., ESAIM P&S 18 (2014) 342; M. J. W. Jansen,
        Comput. Phys. Comm. 117 (1999) 35
    """
    work = replication_size(made) * (2 + len(made.sources))
    rows = list(replicated(made, partial(_indices_of, names=tuple(names)), work))
    return {
        name: [_estimated(np.array([row[name][i] for row in rows])) for i in range(len(made.sources))] for name in names
    }


def _indices_of(made: Problem, number: int, names: Sequence[str]) -> Mapping[str, list[tuple[float, float]]]:
    """First and total index of every source, by quantity, of one replication."""
    width = made.coordinates
    points = replication(2 * width, rounded_up(made.samples), made.section.seed, number)
    a, b = points[:, :width], points[:, width:]
    one, other = (judged(made, part).quantities for part in (a, b))
    mixed = [judged(made, _swapped(a, b, group)).quantities for group in _columns(made)]
    return {name: [_indices(one[name], other[name], each[name]) for each in mixed] for name in names}


def _columns(made: Problem) -> list[list[int]]:
    """Which random numbers are a source's, and those of the sources that scatter with it."""
    group = groups(made.section, made.sources)
    own = [range(one.start, one.stop) for one in numbers_of(made.sources)]
    return [[i for j, columns in enumerate(own) if group[j] == number for i in columns] for number in group]


def _swapped(a: Reals, b: Reals, group: list[int]) -> Reals:
    mixed = a.copy()
    mixed[:, group] = b[:, group]
    return mixed


def _indices(a: Reals, b: Reals, mixed: Reals) -> tuple[float, float]:
    """First and total index of one replication."""
    there = ~(np.isnan(a) | np.isnan(b) | np.isnan(mixed))
    a, b, mixed = a[there], b[there], mixed[there]
    if a.size < 2:
        return math.nan, math.nan
    middle = b[0]
    a, b, mixed = a - middle, b - middle, mixed - middle
    mean = 0.5 * float(np.mean(b + mixed))
    variance = 0.5 * float(np.mean(b * b + mixed * mixed)) - mean * mean
    if variance <= 0.0:
        return math.nan, math.nan
    return (float(np.mean(b * mixed)) - mean * mean) / variance, float(np.mean((a - mixed) ** 2)) / (2.0 * variance)


def _estimated(rows: Reals) -> Indices:
    """Indices with their intervals; where chance puts the first above the total, the less certain gives way."""
    first, total = (_not_negative(estimate(rows[:, i])) for i in (0, 1))
    if first.value > total.value:
        if first.half_width <= total.half_width:
            total = _moved(total, first)
        else:
            first = _moved(first, total)
    return Indices(first, total)


def _not_negative(one: Estimate) -> Estimate:
    return Estimate(max(0.0, one.value), one.half_width)


def _moved(one: Estimate, to: Estimate) -> Estimate:
    """An estimate at the value of a more certain one; the far end of its interval stays, or is that of the other."""
    return Estimate(to.value, max(to.half_width, one.half_width - abs(one.value - to.value)))


_EXPLAINED = 0.9
_ROUNDING = 1e-13
_FEW = 256


class ToleranceStudy(Design):
    """Samples of a design as manufactured; its nominal design's checks stand beside."""

    kind = ""  # that of its design file
    repairable = False
    outlines = {
        "tolerance": Outline(
            ("yield", "yield_low", "yield_high", "samples", "seed", "no_mechanism"),
            ("target-yield", "no-mechanism", "linear-shares"),
            ("quantities", "requirements", "contributions"),
        )
    }
    key_tables = ("requirements", "contributions", "not_sampled")
    extra_tables = ("corners", "allocation", "band", "not_sampled")
    advises = False

    def __init__(self, spec: Any) -> None:
        super().__init__(spec)
        vars(self)["kind"] = spec.kind

    @cached_property
    def _made(self) -> Problem:
        return problem(self.spec)

    @cached_property
    def problem(self) -> Problem:
        """The study made ready."""
        if self.spec.tolerance is None:
            words = "`tolerance` needs the section tolerance, such as tolerance: {sources: {KEY: {plus_minus: 0.02}}}"
            raise MissingSection(f"{words}, KEY a size of this file by its path, as --set takes it", key="tolerance")
        made = self._made
        _ = (
            made.requirements,
            made.sources,
            made.correlation,
        )  # what is wrong with them is said before anything is computed
        if self.spec.tolerance.sobol and made.coordinates > MOST_WITH_INDICES:
            message = f"Sobol' indices are possible for at most {MOST_WITH_INDICES} coordinates, not {made.coordinates}"
            raise no("GL175", message, "sources")
        return made

    @property
    def is_short(self) -> bool:
        """Whether its samples take a second or so: over arrays, or few of them; True as well where it is wrong."""
        try:
            made = self._made
            return not made.of_register_alone and (made.is_quick or made.samples <= _FEW)
        except (WrongStudy, NoSolution):
            return True

    def require_named(self) -> None:
        """Refuse sources and requirements that the design does not have; play of machines whose register counts it
        is left to that."""
        if self.spec.tolerance is not None and not self._made.of_register_alone:
            _ = self.problem

    @cached_property
    def result(self) -> Result:
        """Everything that came of the samples."""
        return result(self.problem)

    def raw(self, name: str) -> Any:
        """The six quantities."""
        if name == "yield":
            return self.result.good.value
        return super().raw(name)

    yield_low: float = placed("result.good.low")
    yield_high: float = placed("result.good.high")
    samples: int = placed("result.samples")

    @property
    def seed(self) -> int:
        """Seed of the samples."""
        return int(self.problem.section.seed)

    no_mechanism: float = placed("result.missing")

    # Tables

    @cached_property
    def varying(self) -> tuple[str, ...]:
        """Quantities that scatter."""
        spreads = self.result.spreads
        return tuple(name for name in self.problem.names if name in spreads and _scatters(spreads[name]))

    @cached_property
    def units(self) -> dict[str, str]:
        """Units of the quantities."""
        return {name: self.problem.base.unit(name) for name in self.problem.names}

    @cached_property
    def nominal(self) -> dict[str, float]:
        """Quantities of the nominal design."""
        made = self.problem
        found = evaluated(made, made.offsets([{}])).quantities
        return {name: float(found[name][0]) for name in self.varying}

    def limits(self, name: str) -> tuple[float | None, float | None]:
        """Lower and upper limit of a quantity, from the requirements that name it alone."""
        lower, upper = None, None
        for one in self.problem.requirements:
            if one.expression.tree != name or isinstance(one.limit, str):
                continue
            if one.sign in (">=", ">"):
                lower = max(one.limit, -math.inf if lower is None else lower)
            elif one.sign in ("<=", "<"):
                upper = min(one.limit, math.inf if upper is None else upper)
        return lower, upper

    def table_quantities(self, _samples: int | None = None) -> Table:
        """Spread and capability of every quantity that varies."""
        rows = []
        for name in self.varying:
            spread = self.result.spreads[name]
            estimates = (spread.mean, spread.sigma, *spread.quantiles, *capabilities(spread, *self.limits(name)))
            rows.append((name, self.units[name], self.nominal[name], *(part for one in estimates for part in _pm(one))))
        heads = ("mean", "sigma", "q00135", "q50", "q99865", "cp", "cpk")
        return _table(
            "quantities", ("quantity", "unit", "nominal", *(h for one in heads for h in (one, f"{one}_pm"))), rows
        )

    def table_requirements(self, _samples: int | None = None) -> Table:
        """Yield of each check and of each line of require."""
        checks = self.problem.base.codes
        rows = [
            (name, one.value, one.low, one.high, next(iter(checks.get(name, ())), ""))
            for name, one in self.result.passes.items()
        ]
        return _table("requirements", ("name", "yield", "low", "high", "check"), rows)

    def table_not_sampled(self, _samples: int | None = None) -> Table:
        """Checks without a row among the requirements, and why."""
        return _table("not_sampled", ("name", "reason"), self.problem.not_sampled)

    @cached_property
    def slopes(self) -> dict[str, list[Slope]]:
        """Slopes of the quantities at the nominal design."""
        return slopes(self.problem, self.varying)

    @cached_property
    def _indices(self) -> dict[str, list[Indices]] | None:
        return indices(self.problem, self.varying) if self.problem.section.sobol else None

    def table_contributions(self, _samples: int | None = None) -> Table:
        """What each source adds to each quantity's variance."""
        rows, correlations = [], pairs(self.problem.section, self.problem.sources)
        for name in self.varying:
            shares = linear_shares(self.slopes[name], self.problem.sources, correlations)
            for i, source in enumerate(self.problem.sources):
                found = None if self._indices is None else self._indices[name][i]
                estimates = (None, None) if found is None else (found.first, found.total)
                parts = (part for one in estimates for part in _pm(one))
                rows.append((name, source.key, shares[i], *parts, self.slopes[name][i].kink))
        columns = ("quantity", "source", "linear", "first", "first_pm", "total", "total_pm", "kink")
        return _table("contributions", columns, rows)

    def table_corners(self, _samples: int | None = None) -> Table:
        """Minimum and maximum value at the corners of the limits; the signs of the sources at the maximum."""
        found = corners(self.problem, self.varying, self.slopes)
        rows = [(name, self.units[name], *found[name]) for name in self.varying]
        return _table("corners", ("quantity", "unit", "least", "greatest", "signs"), rows)

    def table_allocation(self, _samples: int | None = None) -> Table:
        """The cheapest grades that reach the target yield, and which of them may be loosened for free."""
        rows = table_rows(self)
        columns = ("source", "grade", "plus_minus", "cost", "yield_low", "one_coarser_holds", "remark")
        return _table("allocation", columns, rows)

    def require_table(self, name: str) -> None:
        """Refuse an allocation that has nothing to choose by."""
        if name == "allocation":
            require(self.problem)

    @cached_property
    def courses(self) -> list[Course]:
        """The outputs over the cycle."""
        return courses(self.problem)

    def table_band(self, _samples: int | None = None) -> Table:
        """Percentiles of the output over the cycle, less that of the nominal design."""
        return _table("band", *columns_of(self.courses))

    # Checks

    def outline(self, command: str) -> Outline:
        """Besides the study's own checks those of the nominal design."""
        own, nominal = super().outline(command), self.problem.nominal.outline(self.problem.base.command)
        tables = (*own.tables, *(("not_sampled",) if self.problem.not_sampled else ()))
        return Outline(own.quantities, (*nominal.checks, *own.checks), tables)

    def check(self, name: str) -> list[Check]:
        """A check of the study, or of its nominal design."""
        own = name in self.outlines["tolerance"].checks
        return super().check(name) if own else self.problem.nominal.check(name)

    def check_target_yield(self) -> Iterator[Check]:
        """GL179 where the file names a target."""
        target = self.problem.section.target_yield
        if target is None:
            return
        good = self.result.good
        short_of = good.low < target
        aside = f"95 % interval {safely_below(100 * good.low)} to {safely_above(100 * good.high)} %"
        shown = Shown(100.0 * good.low if short_of else 100.0 * good.value, 100.0 * target, "%", ">=")
        what = "lower bound of the yield" if short_of else "yield"
        fix = self._remedy(good.value, target) if short_of else ""
        note = "too few samples to prove the yield, which may be reached" if short_of and good.high >= target else ""
        yield TARGET_YIELD.check(
            "fail" if short_of else "pass", what, good.low, target, shown=shown, aside=aside, fix=fix, note=note
        )

    def _remedy(self, value: float, target: float) -> str:
        """More samples where the yield may well be there, else what to tighten."""
        if value == 1.0:
            needed = math.ceil(math.log(0.05) / math.log(target))
            return f"set --samples {needed}"
        return self._what_to_tighten()

    def _what_to_tighten(self) -> str:
        """The source that adds most to the requirement that fails most, or the check that fails more than that."""
        passes = {name: one.value for name, one in self.result.passes.items()}
        if not passes:
            return "tighten what contributes most (table contributions)"
        text = min(passes, key=lambda name: passes[name])
        worst = next((one for one in self.problem.requirements if one.text == text), None)
        if worst is None:
            return f"give the check {text}, which fails most, more margin in the design"
        name = next(iter(worst.expression.names), "")
        if name not in self.slopes:
            return f"relax the requirement {text}, which fails most"
        rows = self.slopes[name]
        most = max(range(len(rows)), key=lambda i: rows[i].sigma if math.isfinite(rows[i].sigma) else 0.0)
        return f"tighten {self.problem.sources[most].key}, which contributes most to {name}"

    def check_no_mechanism(self) -> Iterator[Check]:
        """GL177 where samples do not exist."""
        missing = self.result.missing
        if missing > 0.0:
            what, shown = "manufactured designs that do not exist", Shown(100.0 * missing, 0.0, "%", "<=")
            yield NO_MECHANISM.check("warn", what, missing, 0.0, shown=shown, fix="tighten the tolerances of the links")

    def check_linear_shares(self) -> Iterator[Check]:
        """GL178 for the quantities of requirements whose slopes do not explain their scatter."""
        asked = {name for one in self.problem.requirements for name in one.expression.names}
        for name in self.varying:
            rows = self.slopes[name]
            if name not in asked or self.problem.section.correlated or any(row.kink for row in rows):
                continue
            share = sum(row.sigma**2 for row in rows) / self.result.spreads[name].sigma.value ** 2
            if share < _EXPLAINED:
                what = f"variance of {name} that the sensitivities explain"
                shown = Shown(100.0 * share, 100.0 * _EXPLAINED, "%", ">=")
                yield NOT_LINEAR.check("warn", what, share, _EXPLAINED, shown=shown, fix="use --sobol")


def _scatters(spread: Spread) -> bool:
    """Whether a quantity scatters by more than rounding does, as the residual of a solver would."""
    return spread.sigma.value > _ROUNDING * max(1.0, abs(spread.mean.value))


def _pm(one: Estimate | None) -> tuple[float | None, float | None]:
    if one is None:
        return None, None
    return one.value, None if math.isnan(one.half_width) else one.half_width


def _table(name: str, columns: Sequence[str], rows: Sequence[Sequence[Any]]) -> Table:
    data = tuple(zip(*rows, strict=True)) if rows else tuple(() for _ in columns)
    return Table(name, tuple(columns), ("1",) * len(columns), data)


_MOST = 12
"""Sizes of which all corners are computed."""

_ROUND = np.linspace(0.0, math.tau, 32, endpoint=False)
_NARROWINGS = 3
"""Times that directions are tried about the best one, 16 times as near each: 1e-3 rad costs 1e-6 of the play."""

_WORTH = 1e-9


@dataclass(frozen=True)
class _Corner:
    """Where the sizes stand, +1 at the upper limit and -1 at the lower one, and how far each pin is off [mm]."""

    signs: Reals
    plays: Points


def corners(
    made: Problem, names: Sequence[str], gains: Mapping[str, list[Slope]]
) -> dict[str, tuple[float, float, str]]:
    """Minimum and maximum value of quantities at the corners of the limits, and where the maximum is.

    Returns
        found : by quantity - minimum, maximum, a sign for each source: + or - a size at its limit, o the play of a pin
    Notes
        Of up to 12 sizes all corners, of more that of the linear signs. From the best one single sizes are turned
        about, and each pin goes round its hole at half the maximum clearance, until none helps. What lies inside may
        be worse where the quantity is not monotone.
    """
    pins = [source for source in made.sources if source.kind == "pin"]
    sizes = len(made.sources) - len(pins)
    still = np.zeros(len(pins), dtype=complex)
    every = sizes <= _MOST
    bits = (np.arange(2**sizes if every else 1)[:, None] >> np.arange(sizes)) & 1
    first = [_Corner(row, still) for row in np.where(bits, -1.0, 1.0)]
    of_first = evaluated(made, _offsets(made, first)).quantities if every else {}
    found: dict[str, tuple[float, float, str]] = {}
    for name in names:
        ends = []
        for sense in (-1.0, 1.0):
            if every:
                at = _best(sense * of_first[name])
                best, start = float(sense * of_first[name][at]), first[at]
            else:
                start = _Corner(sense * _linear(made, gains[name]), still)
                best = float(_values(made, name, sense, [start])[0])
            known = every and not pins
            ends.append((best, start) if known else _climbed(partial(_values, made, name, sense), best, start, pins))
        (least, _), (most, place) = ends
        found[name] = (-least, most, "" if math.isnan(most) else _shown(made, place))
    return found


def _linear(made: Problem, gains: Sequence[Slope]) -> Reals:
    """The signs of the slopes in the sizes."""
    rows = zip(gains, made.sources, strict=True)
    return np.array([1.0 if row.gain[0] >= 0.0 else -1.0 for row, source in rows if source.kind != "pin"])


def _values(made: Problem, name: str, sense: float, places: Sequence[_Corner]) -> Reals:
    return sense * evaluated(made, _offsets(made, places)).quantities[name]


def _offsets(made: Problem, places: Sequence[_Corner]) -> dict[str, Reals | Points]:
    shifts: list[Mapping[str, complex]] = []
    for place in places:
        signs, plays = iter(place.signs), iter(place.plays)
        shifts.append({one.key: next(plays) if one.kind == "pin" else _limit(one, next(signs)) for one in made.sources})
    return made.offsets(shifts)


def _limit(source: Scatter, sign: float) -> float:
    return source.law.upper if sign > 0.0 else source.law.lower


def _best(values: Reals) -> int:
    """Where the maximum value is; a design that does not exist has none."""
    return int(np.argmax(np.where(np.isnan(values), -math.inf, values)))


def _climbed(
    values: Callable[[Sequence[_Corner]], Reals], best: float, place: _Corner, pins: Sequence[Scatter]
) -> tuple[float, _Corner]:
    """The maximum value that moving single sources from a place finds, and where it is."""

    def take(tried: Sequence[_Corner]) -> bool:
        nonlocal best, place
        found = values(tried)
        at = _best(found)
        worth = -math.inf if math.isnan(best) else best + _WORTH * abs(best)
        if not found[at] > worth:
            return False
        best, place = float(found[at]), tried[at]
        return True

    moved = True
    while moved:
        moved = bool(place.signs.size) and take(_turned_about(place))
        for i, pin in enumerate(pins):
            around = _ROUND
            for _ in range(1 + _NARROWINGS):
                moved |= take([_with_play(place, i, cmath.rect(pin.limit, angle)) for angle in around])
                around = cmath.phase(place.plays[i]) + (around - around.mean()) / _ROUND.size * 2.0
    return best, place


def _turned_about(place: _Corner) -> list[_Corner]:
    """Those that differ in one sign."""
    count = np.arange(place.signs.size)
    return [_Corner(np.where(count == i, -place.signs, place.signs), place.plays) for i in count]


def _with_play(place: _Corner, i: int, play: complex) -> _Corner:
    plays = place.plays.copy()
    plays[i] = play
    return _Corner(place.signs, plays)


def _shown(made: Problem, place: _Corner) -> str:
    signs = iter(place.signs)
    return "".join("o" if one.kind == "pin" else "+" if next(signs) > 0.0 else "-" for one in made.sources)
