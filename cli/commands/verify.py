"""`gearlink verify`: the program computes published cases where it is installed."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import TYPE_CHECKING, Any, NamedTuple

from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.options import Format, Options
from gearlink.cli.render.lists import hanging, width
from gearlink.cli.verification.cases import Case, Number, decimals, names, sources
from gearlink.core.base.errors import GearlinkError, named
from gearlink.core.base.report import Quantity, Report, Table

if TYPE_CHECKING:
    from gearlink.cli.reading.diagnostics import Diagnostic
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


def tooth_tolerances(given: Given) -> Results:
    """Tolerances [um] of ISO 1328-1:2013."""
    from gearlink.core.parts.gears.measures.iso_1328 import ToothTolerances

    sizes = {name: given[name] for name in ("module", "diameter", "width")}
    found = ToothTolerances(grade=given["class"], **sizes)
    return {
        "f_pt": found.single_pitch,
        "F_p": found.cumulative_pitch,
        "f_H,alpha": found.profile_slope,
        "f_f,alpha": found.profile_form,
        "F_alpha": found.profile_total,
        "f_H,beta": found.helix_slope,
        "f_f,beta": found.helix_form,
        "F_beta": found.helix_total,
    }


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
    "iso-1328": tooth_tolerances,
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


def run_verify(prefixes: Sequence[str], options: Options, *, everything: bool = False) -> int:
    """Compute the cases that begin with one of some prefixes, without a prefix all, and give the exit status.

    Parameters
        everything : bool - in the table form every number, as where prefixes are given
    """
    from gearlink.cli.progress import patience
    from gearlink.cli.render.errors import show_errors

    cases = [case for source in sources(prefixes) for case in source.cases]
    if unknown := _unknown(prefixes, [case.id for case in cases]):
        show_errors(unknown, options)
        return ExitCode.WRONG_INPUT
    with patience(f"computing {len(cases)} published cases", quiet=options.quiet):
        outcomes = list(computed(cases))
    report = report_of(outcomes)
    if options.format is Format.TABLE:
        print(as_text(outcomes, everything=everything or bool(prefixes)))
    else:
        from gearlink.cli.commands.design import print_report

        print_report(report, options)
    return ExitCode.OK if report.ok else ExitCode.FINDING


def _unknown(prefixes: Sequence[str], ids: Sequence[str]) -> list[Diagnostic]:
    from gearlink.cli.reading.diagnostics import Diagnostic

    unknown = [each for each in dict.fromkeys(prefixes) if not any(name.startswith(each.lower()) for name in ids)]
    known, where = f"cases begin with: {', '.join(names())}", "<command line>"
    return [Diagnostic("GL115", f"no case begins with {named(each)}", where, key=each, help=known) for each in unknown]


_NO_UNIT = "1"


@dataclass(frozen=True, slots=True)
class Verification(Report):
    """A report that is in order where every number is met."""

    @property
    def ok(self) -> bool:
        """False where a number is not met."""
        return all(self.tables[0].data[-2])


def report_of(outcomes: Sequence[Outcome]) -> Verification:
    """Counts, and a row for each number."""
    counts = {
        "cases": (len({each.case.id for each in outcomes}), "cases that were computed"),
        "numbers": (len(outcomes), "published numbers in these cases"),
        "met": (sum(each.met for each in outcomes), "numbers within their limit"),
    }
    columns: dict[str, Sequence[object]] = {
        "case": [each.case.id for each in outcomes],
        "source": [", ".join(filter(None, (each.case.source, each.case.place))) for each in outcomes],
        "name": [each.number.name for each in outcomes],
        "published": [each.number.value for each in outcomes],
        "computed": [each.computed for each in outcomes],
        "difference": [each.difference for each in outcomes],
        "limit": [each.number.limit for each in outcomes],
        "ok": [each.met for each in outcomes],
        "unit": [each.unit for each in outcomes],
    }
    return Verification(
        kind="verification",
        name="published-cases",
        command="verify",
        quantities=tuple(Quantity(name, count, _NO_UNIT, "", words) for name, (count, words) in counts.items()),
        tables=(Table.of("cases", {name: (data, _NO_UNIT) for name, data in columns.items()}),),
    )


_DOUBLE = 15
"""Digits of a double; the last is rounding."""


def computed_digits(outcome: Outcome) -> str:
    """The computed number with a digit more than is published, but none far below its limit, where rounding begins."""
    value = outcome.computed
    if value is None:
        return "-"
    size = 0 if value == 0.0 else math.floor(math.log10(abs(value))) + 1
    below = 1 - math.floor(math.log10(outcome.number.limit))
    places = min(1 - decimals(outcome.number.published), below, _DOUBLE - size - 1)
    return f"{value:.{max(places, 0)}f}"


def difference(outcome: Outcome) -> str:
    """The difference to two digits of its limit.

    A tenth of the limit is its last digit but one, so that what another processor rounds otherwise does not show.
    """
    found = outcome.difference
    if found is None:
        return "-"
    places = 1 - math.floor(math.log10(outcome.number.limit))
    shown = round(found, places)
    return _plain(shown + 0.0, places)


def limit(outcome: Outcome) -> str:
    """The limit."""
    return f"{outcome.number.limit:.3g}"


def share(outcome: Outcome) -> str:
    """The difference in percent of its limit."""
    return "-" if outcome.computed is None else f"{100.0 * outcome.share:.0f} %"


def _plain(value: float, places: int) -> str:
    if value == 0.0:
        return "0"
    return f"{value:.{max(places, 0)}f}" if places <= 7 else f"{value:.1e}"


_NAME_AT_LEAST = 8
_HEADS = ("published", "computed", "difference", "limit")


def as_text(outcomes: Sequence[Outcome], *, everything: bool = False) -> str:
    """Cases under their sources, and how many numbers are met.

    Parameters
        everything : bool - every number; else a line for each case, and the numbers that are off
    """
    lines: list[str] = []
    column = max(len(each.case.id) for each in outcomes)
    for source, group in groupby(outcomes, key=lambda each: each.case.source):
        lines += [hanging(source), *_cases(list(group), column, everything), ""]
    met = sum(each.met for each in outcomes)
    return "\n".join([*lines, f"{met} of {len(outcomes)} numbers within their limit"])


def _cases(outcomes: Sequence[Outcome], column: int, everything: bool) -> Iterator[str]:
    for _, group in groupby(outcomes, key=lambda each: each.case.id):
        own = list(group)
        yield _case(own[0].case, own, column)
        shown = own if everything else [each for each in own if not each.met]
        if shown:
            yield from _numbers(shown)
            reasons = {each.number.because: None for each in shown if each.number.because}
            yield from (hanging(f"limit: {reason}", "    ", "    ") for reason in reasons if everything)
            refusals = {each.refusal: None for each in shown if each.refusal}
            yield from (hanging(f"refused: {refusal}", "    ", "    ") for refusal in refusals)


def _case(case: Case, outcomes: Sequence[Outcome], column: int) -> str:
    met = sum(each.met for each in outcomes)
    worst = max(outcomes, key=lambda each: each.share)
    count = f"{met} of {len(outcomes)}"
    line = f"  {case.id:<{column}}  {count:>8}  {share(worst):>5} of the limit"
    named = f"{line}: {worst.number.name}"
    return named if len(named) <= width() else line


def _numbers(outcomes: Sequence[Outcome]) -> Iterator[str]:
    """A line for each number; names that do not fit stand on a line of their own."""
    rows = [
        (
            each.number.name + (f" [{each.unit}]" if each.unit not in ("", "1") else ""),
            (each.number.published, computed_digits(each), difference(each), limit(each)),
            "" if each.met else "  OFF",
        )
        for each in outcomes
    ]
    wide = [max(len(head), *(len(cells[i]) for _, cells, _ in rows)) for i, head in enumerate(_HEADS)]
    room = max(_NAME_AT_LEAST, width() - 4 - sum(wide) - 2 * len(wide) - 5)
    name_column = min(room, max(len(name) for name, _, _ in rows))
    yield _line("", _HEADS, wide, name_column, "")
    for name, cells, mark in rows:
        if len(name) > name_column:
            yield hanging(name, "      ", "    ")
            name = ""
        yield _line(name, cells, wide, name_column, mark)


def _line(name: str, cells: Sequence[str], wide: Sequence[int], column: int, mark: str) -> str:
    shown = "".join(f"  {cell:>{size}}" for cell, size in zip(cells, wide, strict=True))
    return f"    {name:<{column}}{shown}{mark}".rstrip()
