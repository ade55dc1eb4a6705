"""Designs as manufactured: computed, judged, summed up replication by replication; the band of their output.

Replications are shares of a study's work: each depends on the study's text and its own number alone.
"""

from __future__ import annotations

import cmath
import json
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache, partial
from time import perf_counter
from typing import Any, TypeAlias, TypeVar

import numpy as np

from gearlink.core.base.design import in_unit
from gearlink.core.base.design_axis import Evaluated, Single, as_arrays, put_in
from gearlink.core.base.errors import NoSolution
from gearlink.core.base.kinds import KINDS
from gearlink.core.numerics.arrays import Mask, Points, Reals
from gearlink.core.studies.explore.base import Refused, checks_of, findings_of
from gearlink.core.studies.tolerance.sampling import (
    REPLICATIONS,
    is_shared,
    of_replications,
    replication,
    rounded_up,
    seen,
)
from gearlink.core.studies.tolerance_study.problem import Problem, problem

Columns = Mapping[str, Reals | Points]
_BLOCK = 8192  # of the array form; of one by one, from `at_once` up to what takes so many seconds
_SECONDS = 0.05


@dataclass(frozen=True)
class Judged:
    """One replication.

    Fields
        quantities : (N,) arrays by name - in the units of design files, NaN where one does not apply
        passes : (N,) masks by code that is judged on any of them, and by line of `require`
        exists, good : (N,) masks - whether the mechanism exists, and passes everything
    """

    quantities: Mapping[str, Reals]
    passes: Mapping[str, Mask]
    exists: Mask
    good: Mask


def judged(made: Problem, points: Reals) -> Judged:
    """Compute and judge the designs of some random points, block by block.

    Notes
        Blocks of the array form are all of one size, since the last bit of a design may depend on those beside it;
        designs computed one by one depend on nothing, and their blocks are such as take a tenth of a second.
    """
    blocks: list[Judged] = []
    first, size = 0, _BLOCK if made.is_quick else made.nominal.at_once
    while first < len(points):
        start = perf_counter()
        block = points[first : first + size]
        blocks.append(_judged(made, block))
        first += len(block)
        seen(len(block))
        if not made.is_quick and perf_counter() - start < _SECONDS:
            size *= 2
    return blocks[0] if len(blocks) == 1 else _together(blocks)


def _together(blocks: Sequence[Judged]) -> Judged:
    """Blocks as one; where a check says nothing of a block's designs, all that exist pass it."""
    return Judged(
        {name: np.concatenate([one.quantities[name] for one in blocks]) for name in blocks[0].quantities},
        {
            name: np.concatenate([one.passes.get(name, one.exists) for one in blocks])
            for name in dict.fromkeys(name for one in blocks for name in one.passes)
        },
        np.concatenate([one.exists for one in blocks]),
        np.concatenate([one.good for one in blocks]),
    )


def _judged(made: Problem, points: Reals) -> Judged:
    found = evaluated(made, made.sizes(points))
    exists: Mask = found.refused == 0
    judged_by = {finding.code for finding in found.findings}
    if not made.is_quick:  # a sample by itself finds no warnings, nor a code that has nothing else
        judged_by |= made.judged_codes
    passes: dict[str, Mask] = {code: exists.copy() for code in made.base.codes if code in judged_by}
    for finding in found.findings:
        passes[finding.code] &= ~finding.fails
    for one in made.requirements:
        passes[one.text] = exists & one.holds(one.expression.value(found.quantities))
    good = exists.copy()
    for mask in passes.values():
        good &= mask
    return Judged(found.quantities, passes, exists, good)


def evaluated(made: Problem, columns: Columns) -> Evaluated:
    """Designs of given sizes, over arrays where the kind has them."""
    if made.is_quick and made.axis is not None:
        found = made.axis.evaluate(columns, made.quick_names)
        if found.unsure is None or not found.unsure.any():
            return found
        few = _one_by_one(made, {key: value[found.unsure] for key, value in columns.items()}, made.quick_names)
        return put_in(found, found.unsure, few)
    return _one_by_one(made, columns, made.names)


def _one_by_one(made: Problem, columns: Columns, names: Sequence[str]) -> Evaluated:
    """Designs of given sizes, each by its class; what that seeks for all of them at once is sought first."""
    designs = [_tried(made, row) for row in rows_of(columns)]
    there = [design for design in designs if not isinstance(design, Single)]
    if there:
        type(there[0]).find_together(there, (*names, *checks_of(made.base, list(made.base.codes))))
    return as_arrays([_single(made, design, names) for design in designs], names, list(made.base.codes))


def rows_of(columns: Columns) -> Iterator[dict[str, Any]]:
    """The sizes of each design by itself."""
    for i in range(len(next(iter(columns.values())))):
        yield {key: value[i].item() for key, value in columns.items()}


def design_of(made: Problem, row: Mapping[str, Any]) -> Any:
    """One design as manufactured.

    Raises
        Refused, NoSolution - where there is no such mechanism
    """
    if made.axis is None:
        return made.base.design(row.items())
    own = {key: value for key, value in row.items() if made.axis.sets(key)}
    cut = made.base.design([one for one in row.items() if one[0] not in own]) if len(own) < len(row) else None
    return made.axis.design(own, cut)


def _tried(made: Problem, row: Mapping[str, Any]) -> Any:
    """A design as manufactured; a `Single` that is refused where there is none."""
    try:
        return design_of(made, row)
    except (Refused, NoSolution) as error:
        return Single({}, (), error.key or "kind", str(error))


def _single(made: Problem, design: Any, names: Sequence[str]) -> Single:
    if isinstance(design, Single):
        return design
    try:
        own = _extra(made)
        plain, codes = [name for name in names if name not in own], list(made.base.codes)
        values = made.base.values(design, plain, checks_of(made.base, codes))
        values |= {name: in_unit(design.raw(name), made.base.unit(name)) for name in names if name in own}
        return Single(values, tuple(findings_of(made.base, design, codes)))
    except (Refused, NoSolution) as error:
        return Single({}, (), error.key or "kind", str(error))


def _extra(made: Problem) -> Sequence[str]:
    return () if made.axis is None else made.axis.extra


def judged_replication(made: Problem, number: int) -> Judged:
    """One replication of the study."""
    return judged(made, replication(made.coordinates, rounded_up(made.samples), made.section.seed, number))


def replication_size(made: Problem) -> int:
    """Samples of a replication."""
    return rounded_up(made.samples) // REPLICATIONS


Found = TypeVar("Found")


def replicated(made: Problem, function: Callable[[Problem, int], Found], work: int = 1) -> Iterable[Found]:
    """What a function finds in every replication, in order.

    Parameters
        function : of the problem and the replication's number - of a module, so that it can be sent elsewhere
        work : int - designs of a replication, as it tells `seen`
    """
    if is_shared():
        return of_replications(partial(_by_text, function, text_of(made)), work)
    return of_replications(partial(function, made), work)


def _by_text(function: Callable[[Problem, int], Found], text: str, number: int) -> Found:
    return function(problem_of(text), number)


def text_of(made: Problem) -> str:
    """A study as text, from which `problem_of` makes the same study anywhere."""
    section = made.section.model_dump(mode="json", exclude_unset=True, exclude_none=True, by_alias=True)
    section["command"] = made.base.command
    return json.dumps({**made.base.data, "tolerance": section})


@lru_cache(maxsize=4)
def problem_of(text: str) -> Problem:
    """The study of a text."""
    return problem(KINDS[json.loads(text)["kind"]].spec_model().model_validate_json(text))


SHARES = (0.00135, 0.05, 0.5, 0.95, 0.99865)
_SCALAR_SAMPLES = 8 * REPLICATIONS
_PLACES = 120
_LEAST_TAIL = 5  # samples beyond a percentile, or it is none


@dataclass(frozen=True)
class Course:
    """An output over the cycle.

    Fields
        output, over : str - columns of the design's table; units : of `over`, of the output
        places, nominal : (K,) arrays - where, and the output of the nominal design there
        percentiles : (5, K) array - by how much the designs as made lie above, at `SHARES`; NaN where too few do
        reference : float or None - where designs and nominal design are taken to agree
    """

    output: str
    over: str
    units: tuple[str, str]
    places: Reals
    nominal: Reals
    percentiles: Reals
    reference: float | None

    @property
    def period(self) -> float | None:
        """Where the cycle begins again; None of a motion that ends. A table leaves the end of a cycle out."""
        steps = len(self.places)
        return float(self.places[0] + steps * (self.places[1] - self.places[0])) if steps == _PLACES else None


def courses(made: Problem) -> list[Course]:
    """The outputs of a kind over its cycle; none where it has no motion.

    Notes
        Over arrays 16384 designs; of kinds whose designs are computed one by one 128, which leave no far percentiles.
        Where the nominal design dwells, the outputs are set to agree where the dwell begins.
    """
    outputs = outputs_of(made)
    if outputs is None:
        return []
    nominal = made.nominal.table(outputs[0], samples=_PLACES)
    over, unit = nominal.columns[0], nominal.units[0]
    places = np.asarray(nominal.data[0], dtype=float)
    rows = list(replicated(made, deviations))
    return [
        Course(
            name,
            over,
            (unit, nominal.units[nominal.columns.index(name)]),
            places,
            np.asarray(nominal[name], dtype=float),
            _percentiles(np.concatenate([row[i] for row in rows], axis=1)),
            _reference(made),
        )
        for i, name in enumerate(outputs[1])
    ]


def outputs_of(made: Problem) -> tuple[str, tuple[str, ...]] | None:
    """Table and columns of the outputs of a design: of those that its kind may have the ones that it has."""
    shown = made.nominal.outline("analyze").tables
    for table, names in made.nominal.output_columns.items():
        if table in shown:
            columns = made.nominal.table(table, samples=_PLACES).columns
            return table, tuple(name for name in names if name in columns)
    return None


def _reference(made: Problem) -> float | None:
    return None if made.axis is None else made.axis.reference


def deviations(made: Problem, number: int) -> list[Reals]:
    """Outputs of one replication less those of the nominal design; a (K, N) array each."""
    table, names = outputs_of(made) or ("", ())
    nominal = made.nominal.table(table, samples=_PLACES)
    places = np.asarray(nominal.data[0], dtype=float)
    units = [nominal.units[nominal.columns.index(name)] for name in names]
    axis = made.axis if made.is_quick else None
    if axis is not None and not (len(units) == 1 and units[0] in axis.course_units):
        axis = None
    count = rounded_up(_SCALAR_SAMPLES if axis is None else axis.samples // 8)
    columns = made.sizes(replication(made.coordinates, count, made.section.seed, number))
    if axis is not None:
        off = axis.course(columns, np.radians(places))
        return [np.degrees(off) if units == ["deg"] else off]
    tables = [_table(made, row, table, len(places)) for row in rows_of(columns)]
    found = []
    for name in names:
        off = np.array([np.full(len(places), math.nan) if one is None else one[name] for one in tables]).T
        off = off - np.asarray(nominal[name], dtype=float)[:, None]
        if nominal.units[nominal.columns.index(name)] == "deg":
            off = np.remainder(off + 180.0, 360.0) - 180.0
        found.append(_agreeing(off, places, _reference(made)))
    return found


def _table(made: Problem, row: Mapping[str, Any], table: str, count: int) -> Any:
    """The table of one design as manufactured; None where there is no such mechanism."""
    try:
        found = design_of(made, row).table(table, samples=_PLACES)
    except (Refused, NoSolution):
        return None
    return found if found.length == count else None


def _agreeing(off: Reals, places: Reals, reference: float | None) -> Reals:
    if reference is None:
        return off
    at = int(np.argmin(np.abs(np.remainder(places - reference + 180.0, 360.0) - 180.0)))
    agreeing: Reals = off - off[at]
    return agreeing


def _percentiles(off: Reals) -> Reals:
    """Order statistics of the designs that exist, at every place."""
    ordered = np.sort(off, axis=1)  # NaN last
    there = np.count_nonzero(~np.isnan(ordered), axis=1)
    rows = [[_at(row, int(count), share) for row, count in zip(ordered, there, strict=True)] for share in SHARES]
    return np.array(rows)


def _at(ordered: Reals, count: int, share: float) -> float:
    if count * min(share, 1.0 - share) < _LEAST_TAIL:
        return math.nan
    return float(ordered[min(count - 1, max(0, math.ceil(share * count) - 1))])


def columns_of(found: Sequence[Course]) -> tuple[tuple[str, ...], list[tuple[Any, ...]]]:
    """Columns and rows of all courses as a table."""
    names = ("output", "unit", "input", "nominal", "q00135", "q05", "q50", "q95", "q99865")
    rows = []
    for one in found:
        for i, place in enumerate(one.places):
            parts = (None if math.isnan(value) else float(value) for value in one.percentiles[:, i])
            rows.append((one.output, one.units[1], float(place), float(one.nominal[i]), *parts))
    return names, rows


_AROUND = 24
"""Directions in which the play of a pin is tried."""
Effects: TypeAlias = dict[str, list[tuple[str, float, float]]]


def effects(made: Problem, names: list[str]) -> tuple[Effects, dict[str, float]]:
    """What each tolerance does by itself, all others nominal.

    Returns
        changes : by quantity that the samples have, the widest first - the source, the change at its lower and at its
            upper limit
        nominal : by quantity
    Notes
        The play of a pin acts in the direction of the smallest and of the largest value, of 24.
    """
    shifts: list[dict[str, complex]] = [{}]
    owner: list[str] = [""]
    for source in made.sources:
        ends: list[complex] = [source.law.lower, source.law.upper] if source.kind != "pin" else [
            cmath.rect(source.limit, 2.0 * cmath.pi * k / _AROUND) for k in range(_AROUND)
        ]  # fmt: skip
        for end in ends:
            shifts.append({one.key: end if one.key == source.key else 0.0 for one in made.sources})
            owner.append(source.key)
    values = evaluated(made, made.offsets(shifts)).quantities
    found: dict[str, list[tuple[str, float, float]]] = {}
    names = [name for name in names if name in values]
    for name in names:
        change = np.asarray(values[name], dtype=float) - float(values[name][0])
        rows = []
        for source in made.sources:
            own = change[[k for k, key in enumerate(owner) if key == source.key]]
            low, high = (own[0], own[1]) if source.kind != "pin" else (float(np.nanmin(own)), float(np.nanmax(own)))
            rows.append((source.key, float(low), float(high)))
        found[name] = sorted(rows, key=lambda row: -max(abs(row[1]), abs(row[2])))
    return found, {name: float(values[name][0]) for name in names}
