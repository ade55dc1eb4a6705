"""The output over the cycle in the designs as manufactured: by how much it leaves its nominal place, in percentiles."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.numerics.arrays import Reals
from gearlink.core.studies.explore.base import Refused
from gearlink.core.studies.tolerance.sampling import REPLICATIONS, replication, rounded_up
from gearlink.core.studies.tolerance_study.problem import ARRAY_SAMPLES, Problem
from gearlink.core.studies.tolerance_study.samples import design_of, replicated, rows_of

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
    """Table and columns of the outputs of a design."""
    shown = made.nominal.outline("analyze").tables
    return next((each for each in made.nominal.output_columns.items() if each[0] in shown), None)


def _reference(made: Problem) -> float | None:
    return None if made.axis is None else made.axis.reference


def deviations(made: Problem, number: int) -> list[Reals]:
    """Outputs of one replication less those of the nominal design; a (K, N) array each."""
    table, names = outputs_of(made) or ("", ())
    nominal = made.nominal.table(table, samples=_PLACES)
    places = np.asarray(nominal.data[0], dtype=float)
    units = [nominal.units[nominal.columns.index(name)] for name in names]
    known = getattr(made.axis, "course_units", ("deg",))
    over_arrays = made.is_quick and made.axis is not None and len(units) == 1 and units[0] in known
    count = rounded_up(getattr(made.axis, "samples", ARRAY_SAMPLES) // 8 if over_arrays else _SCALAR_SAMPLES)
    columns = made.sizes(replication(made.coordinates, count, made.section.seed, number))
    if over_arrays and made.axis is not None:
        off = made.axis.course(columns, np.radians(places))
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
