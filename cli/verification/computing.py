"""Published cases computed: each number beside what its source prints."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

from gearlink.cli.verification.cases import Case, Number

if TYPE_CHECKING:
    from gearlink.core.base.design import Design


# What published cases compute that no design file asks for alone: a fixed set of functions by name

Given = Mapping[str, Any]
Results = dict[str, Any]


def four_bar(given: Given) -> Results:
    """A four-bar at a crank angle [deg] and crank speed, rates in the unit of time of that speed.

    Angles in rad from the frame line, those of the coupler from the crank pin, of the rocker from its pivot.
    """
    from gearlink.core.parts.linkages.fourbar.position import FourBar, solve

    crank, coupler, rocker, frame = (float(given[link]) for link in ("crank", "coupler", "rocker", "frame"))
    linkage = FourBar(crank, coupler, rocker, frame, given.get("assembly", 1))
    state = solve(linkage, math.radians(given["angle"]), 2, velocity=given.get("speed", 1.0))
    return {
        f"{link}_{rate}": getattr(state, f"{link}_{rate}")
        for link in ("coupler", "rocker")
        for rate in ("angle", "velocity", "acceleration")
    }


def motion_law(given: Given) -> Results:
    """Constants of a law of motion, and its rise and derivatives at a share of the time."""
    from gearlink.core.parts.cams.laws import law

    found = law(given["law"])
    return {
        "Cv": found.peak_velocity,
        "Ca": found.peak_acceleration,
        "Cj": found.interior_jerk,
        "at": list(found.evaluate(given.get("at", 0.0), 3)),
    }


def iso_limits(given: Given) -> Results:
    """Limit deviations [um] of tolerance classes at a size, and standard tolerances of grades."""
    from gearlink.core.studies.tolerance.iso_286 import limit_deviations, standard_tolerance

    return {
        "limits": [[1e3 * each for each in limit_deviations(given["size"], one)] for one in given.get("classes", ())],
        "tolerances": [1e3 * standard_tolerance(given["size"], grade) for grade in given.get("grades", ())],
    }


def cumulative_pitch(given: Given) -> Results:
    """Cumulative pitch tolerance [um] of ISO 1328-1."""
    from gearlink.core.parts.gears.measures.iso_1328 import cumulative_pitch

    return {"F_p": 1e3 * cumulative_pitch(given["class"], given["module"], given["diameter"], given["width"])}


def thickness_allowances(given: Given) -> Results:
    """Upper and lower tooth thickness allowance [um] of DIN 3967, of each reference diameter."""
    from gearlink.core.parts.gears.measures.allowances import thickness_allowances

    found = [thickness_allowances(given["series"], diameter) for diameter in given["diameters"]]
    return {"allowances": [[1e3 * each for each in pair] for pair in found]}


def bearing_clearance(given: Given) -> Results:
    """Minimum and maximum radial clearance [um] of deep groove ball bearings, ISO 5753-1."""
    from gearlink.core.studies.tolerance.sources import radial_clearance

    return {"clearance": [1e3 * each for each in radial_clearance(given["bore"], given["group"])]}


def flywheel(given: Given) -> Results:
    """Fluctuation of energy [J] of a torque [N m] against its mean, sum of a sin(n x) + b cos(n x) of `[n, a, b]`.

    With `fluctuation` the flywheel [kg m^2] that keeps the speed within it, with `inertia` the fluctuation it leaves.
    """
    import numpy as np
    from numpy.typing import NDArray

    from gearlink.core.studies.loads.flywheel import Energy
    from gearlink.core.studies.loads.panels import Panels

    def load(angle: NDArray[np.float64]) -> NDArray[np.float64]:
        waves = [a * np.sin(n * angle) + b * np.cos(n * angle) for n, a, b in given["torque"]]
        return np.asarray(-np.sum(waves, axis=0))

    energy = Energy.from_functions(load, np.zeros_like, Panels.over(2.0 * math.pi, []))
    speed = given["speed"] * math.pi / 30.0
    found: Results = {"energy_fluctuation": energy.fluctuation}
    if "fluctuation" in given:
        found["flywheel_inertia"] = energy.flywheel_for(given["fluctuation"], speed)
    if "inertia" in given:
        found["speed_fluctuation"] = energy.fluctuation / (given["inertia"] * speed**2)
    return found


KERNELS: dict[str, Callable[[Given], Results]] = {
    "four-bar": four_bar,
    "law-constants": motion_law,
    "iso-286": iso_limits,
    "iso-1328": cumulative_pitch,
    "din-3967": thickness_allowances,
    "bearing-clearance": bearing_clearance,
    "flywheel": flywheel,
}


_ROUNDING = 1e-9
"""Of the limit, and of the place of a row: what a difference of doubles carries."""


class Outcome(NamedTuple):
    """One number computed.

    Fields
        computed : float, or None where the program has none
        unit : str
        refusal : str - why there is none
    """

    case: Case
    number: Number
    computed: float | None
    unit: str
    refusal: str = ""

    @property
    def difference(self) -> float | None:
        """Computed less published."""
        return None if self.computed is None else self.computed - self.number.value

    @property
    def share(self) -> float:
        """The difference as a share of its limit; infinite where nothing is computed."""
        return math.inf if self.difference is None else abs(self.difference) / self.number.limit

    @property
    def met(self) -> bool:
        """Whether the difference is within its limit."""
        return self.share <= 1.0 + _ROUNDING


def computed(cases: Iterable[Case]) -> Iterator[Outcome]:
    """The numbers of some cases, each case computed once.

    Example
        >>> from gearlink.cli.verification.cases import read
        >>> case = next(case for case in read("khurmi").cases if case.id == "khurmi-12.7-internal")
        >>> [(round(each.computed, 3), each.met) for each in computed([case])]
        [(28.035, True)]
    """
    from gearlink.core.base.errors import GearlinkError

    for case in cases:
        try:
            ask = _Kernel(case) if case.kernel else _Designed(case)
        except GearlinkError as error:
            yield from (Outcome(case, number, None, number.unit, str(error)) for number in case.numbers)
            continue
        for number in case.numbers:
            try:
                value, unit = ask.value(number)
            except GearlinkError as error:
                yield Outcome(case, number, None, number.unit, str(error))
                continue
            scaled = None if value is None else float(value) * number.scale
            yield Outcome(case, number, scaled, number.unit or unit)


class _Kernel:
    """Results of a case that a function computes."""

    def __init__(self, case: Case) -> None:

        self._results = KERNELS[case.kernel](case.given)

    def value(self, number: Number) -> tuple[Any, str]:
        return _at(self._results[number.quantity], number.places), ""


class _Designed:
    """Results of a case that is a design."""

    def __init__(self, case: Case) -> None:
        from gearlink.cli.opening import design

        self._design: Design = design(case.command, **case.design)
        self._samples = case.samples
        self._tables: dict[str, tuple[tuple[str, ...], list[list[Any]], tuple[str, ...]]] = {}

    def value(self, number: Number) -> tuple[Any, str]:
        if number.table:
            return self._cell(number)
        found = self._design.quantity(number.quantity)
        return (None, "") if found is None else (_at(found.value, number.places), found.unit)

    def _cell(self, number: Number) -> tuple[Any, str]:
        if number.table not in self._tables:
            table = self._design.table(number.table, samples=self._samples)
            self._tables[number.table] = (table.columns, table.rows(), table.units)
        columns, rows, units = self._tables[number.table]
        at = columns.index(number.column)
        found = [row[at] for row in rows if _stands(dict(zip(columns, row, strict=True)), number.where)]
        return _at(found[0], number.places) if len(found) == 1 else None, units[at]


def _stands(row: Mapping[str, Any], where: Mapping[str, float | str]) -> bool:
    """Whether a row of a table is the one that is meant."""
    return all(
        row[column] == value
        if isinstance(value, str)
        else row[column] is not None and math.isclose(row[column], value, rel_tol=_ROUNDING, abs_tol=_ROUNDING)
        for column, value in where.items()
    )


def _at(value: Any, places: tuple[int, ...]) -> Any:
    for place in places:
        value = None if value is None else value[place]
    return value
