"""The tolerance study of a design file as a design: yields, spreads, contributions."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from gearlink.core.base.design import Design, Outline, placed
from gearlink.core.base.errors import MissingSection, NoSolution
from gearlink.core.base.report import Check, Shown, Table, safely_above, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.numerics.arrays import Points, Reals
from gearlink.core.studies.study.faults import WrongStudy
from gearlink.core.studies.tolerance.codes import NO_MECHANISM, NOT_LINEAR, TARGET_YIELD
from gearlink.core.studies.tolerance.correlation import pairs
from gearlink.core.studies.tolerance.sampling import Estimate
from gearlink.core.studies.tolerance.sources import Scatter
from gearlink.core.studies.tolerance_study import allocation
from gearlink.core.studies.tolerance_study.band import Course, columns_of, courses
from gearlink.core.studies.tolerance_study.problem import MOST_WITH_INDICES, Problem, no, problem
from gearlink.core.studies.tolerance_study.samples import evaluated
from gearlink.core.studies.tolerance_study.sensitivity import Indices, Slope, indices, linear_shares, slopes
from gearlink.core.studies.tolerance_study.statistics import Result, Spread, capabilities, result

_EXPLAINED = 0.9
_ROUNDING = 1e-13
_FEW = 256


class ToleranceStudy(Design):
    """Samples of a design as manufactured; its nominal design's checks stand beside."""

    kind = ""  # that of its design file
    outlines = {
        "tolerance": Outline(
            ("yield", "yield_low", "yield_high", "samples", "seed", "no_mechanism"),
            ("target-yield", "no-mechanism", "linear-shares"),
            ("quantities", "requirements", "contributions"),
        )
    }
    key_tables = ("requirements", "contributions")
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
            message = f"Sobol' indices take at most {MOST_WITH_INDICES} coordinates, here are {made.coordinates}"
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
        """Spread and capability of every quantity that scatters."""
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
        rows = [(name, one.value, one.low, one.high) for name, one in self.result.passes.items()]
        return _table("requirements", ("name", "yield", "low", "high"), rows)

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
        """Minimum and maximum value at the corners of the limits; the signs of the sources at the greatest."""
        found = corners(self.problem, self.varying, self.slopes)
        rows = [(name, self.units[name], *found[name]) for name in self.varying]
        return _table("corners", ("quantity", "unit", "least", "greatest", "signs"), rows)

    def table_allocation(self, _samples: int | None = None) -> Table:
        """The cheapest grades that reach the target yield, and which of them may be loosened for free."""
        rows = allocation.table_rows(self)
        columns = ("source", "grade", "plus_minus", "cost", "yield_low", "one_coarser_holds", "remark")
        return _table("allocation", columns, rows)

    def require_table(self, name: str) -> None:
        """Refuse an allocation that has nothing to choose by."""
        if name == "allocation":
            allocation.require(self.problem)

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
        note = "the yield may well be reached: too few samples" if short_of and good.high >= target else ""
        yield TARGET_YIELD.check(
            "fail" if short_of else "pass", what, good.low, target, shown=shown, aside=aside, fix=fix, note=note
        )

    def _remedy(self, value: float, target: float) -> str:
        """More samples where the yield may well be there, else what to tighten."""
        if value == 1.0:
            needed = math.ceil(math.log(0.05) / math.log(target))
            return f"take --samples {needed}"
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
        return f"tighten {self.problem.sources[most].key}, which adds most to {name}"

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
