"""Sheets of a tolerance study: histograms with their limits, contributions, output over the cycle; tornado charts.

A tornado chart has each source at its limits, all others nominal, the widest effect on top.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from gearlink.cli.views.figures.drawing import panels, style
from gearlink.core.base.kinds import KINDS

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.studies.tolerance_study.design import Slope, ToleranceStudy
    from gearlink.core.studies.tolerance_study.samples import Course


_MOST = 4
_MOST_BINS = 60
_NOTHING = 1e-12  # of the motion
_ROUNDING = 1e-12  # of a quantity that is 0 [mm, deg]
_NO_GAIN = 1e-9  # of a size on itself
_LETTERS = 39  # below a histogram
_STILL = "no tolerance of this file changes a result"


def draw(study: ToleranceStudy) -> Figure:
    """The sheet: a row for each quantity, those of the requirements first, and one for each output over the cycle."""
    names, courses = _of_interest(study.varying, study.slopes), [one for one in study.courses if _scatters(one)]
    height = max(1, len(names)) + len(courses)
    title = f"{study.spec.name}: tolerance"
    if study.result.passes:
        title += f", yield {style.number(100.0 * study.result.good.value, 4)} %"
    made = panels.page(title, 0.12 + 0.22 * height)
    grid = made.add_gridspec(height, 2, width_ratios=[1.25, 1.0])
    for row, name in enumerate(names):
        _histogram(made.add_subplot(grid[row, 0]), study, name)
        _contributions(made.add_subplot(grid[row, 1]), study, name)
    if not names:
        panels.message(made.add_subplot(grid[0, :]), _STILL, 10)
    for i, course in enumerate(courses, start=max(1, len(names))):
        _course(made.add_subplot(grid[i, :]), course)
    return made


def _of_interest(names: Iterable[str], slopes: Mapping[str, Sequence[Slope]]) -> list[str]:
    """Quantities of a sheet; last those that are a toleranced size itself, such as a given length of a link."""

    def is_size(name: str) -> bool:
        moved = [gain for slope in slopes[name] for gain in slope.gain if abs(gain) > _NO_GAIN]
        return len(moved) == 1 and abs(moved[0] - 1.0) <= _NO_GAIN

    return sorted(names, key=is_size)[:_MOST]


def _scatters(course: Course) -> bool:
    """Whether an output leaves its place at all: one that a law prescribes has no band."""
    return bool(np.nanmax(np.abs(course.percentiles)) > _NOTHING * np.ptp(course.nominal))


def _course(axes: Axes, course: Course) -> None:
    """Percentiles of an output over the cycle, about that of the nominal design."""
    places, (low, five, middle, most, high) = _closed(course)
    over, unit = course.units
    label = "deviation from nominal" + ("" if unit == "1" else f" [{unit}]")
    panels.curves(axes, f"{course.over.replace('_', ' ')} [{over}]", label)
    far = bool((low == low).any())
    if far:
        axes.fill_between(places, low, high, color=style.SKY, alpha=0.35, linewidth=0, label="99.73 %")
    axes.fill_between(places, five, most, color=style.SKY, alpha=0.8, linewidth=0, label="90 %")
    axes.plot(places, middle, color=style.BLUE, linewidth=1.2, label="50 %")
    for line in (low, high) if far else (five, most):
        axes.plot(places, line, color=style.BLUE, linewidth=0.6)
    if course.reference is not None:
        look: dict[str, Any] = {"color": style.GREY, "linewidth": 1.0, "linestyle": style.DOTTED}
        axes.axvline(course.reference, **look, label="the dwell begins")
    axes.set_xlim(places[0], places[-1])
    if over == "deg" and course.period == 360.0:
        style.full_turn(axes)
    panels.legend_under_heading(axes, f"{_words(course.output)}: designs as manufactured over the cycle", 4)


def _closed(course: Course) -> tuple[Any, Any]:
    """Places and percentiles, those of a cycle up to its end, where it begins again."""
    if course.period is None:
        return course.places, course.percentiles
    return np.append(course.places, course.period), np.hstack((course.percentiles, course.percentiles[:, :1]))


def _histogram(axes: Axes, study: ToleranceStudy, name: str) -> None:
    """Density of a quantity, its nominal value, its quantiles and its limits."""
    values = study.result.values[name]
    values = values[~np.isnan(values)]
    unit = study.units[name]
    words = _words(name)
    panels.curves(axes, f"{words} [{unit}]" if unit != "1" else words, "density")
    axes.ticklabel_format(axis="x", useOffset=False)
    bins = min(_MOST_BINS, math.ceil(2.0 * math.cbrt(len(values))))  # more show the few samples, not the density
    axes.hist(values, bins=bins, density=True, histtype="stepfilled", color=style.SKY, gid="density")  # one patch
    axes.axvline(study.nominal[name], color=style.BLACK, linewidth=1.2, label="nominal")
    low, _, high = study.result.spreads[name].quantiles
    for place, label in ((low.value, "0.135 and 99.865 %"), (high.value, None)):
        axes.axvline(place, color=style.BLUE, linewidth=1.0, linestyle=style.DASHED, label=label)
    for i, limit in enumerate(one for one in study.limits(name) if one is not None):
        axes.axvline(limit, color=style.RED, linewidth=1.6, linestyle=style.CHAIN, label=None if i else "limit")
    _beyond(axes, *study.limits(name))
    axes.set_yticks([])
    _numbers_that_fit(axes)
    panels.legend_under_heading(axes, _headline(study, name), 3)


def _beyond(axes: Axes, lower: float | None, upper: float | None) -> None:
    """What lies beyond the limits, tinted."""
    left, right = axes.get_xlim()
    words: str | None = "rejected"
    for start, end in ((left, lower), (upper, right)):
        if start is not None and end is not None and start < end:
            look: dict[str, Any] = {"color": style.WRONG, "alpha": 0.13, "linewidth": 0, "gid": "beyond"}
            axes.axvspan(max(start, left), min(end, right), **look, label=words)
            words = None
    axes.set_xlim(left, right)


def _numbers_that_fit(axes: Axes) -> None:
    """So few numbers below a histogram that all of their digits have room: 154.2075 takes that of two short ones."""
    words = axes.xaxis.get_major_formatter().format_ticks(axes.get_xticks().tolist())
    panels.few_ticks(axes.xaxis, max(2, min(6, _LETTERS // (2 + max(map(len, words))))))


def _words(name: str) -> str:
    """A quantity or an output in words, as long as fits above a panel."""
    return panels.abridged(name.replace("_", " "))


def _headline(study: ToleranceStudy, name: str) -> str:
    """The name of a quantity, its deviation, and its capability where it has a limit."""
    from gearlink.core.studies.tolerance_study.statistics import capabilities

    spread = study.result.spreads[name]
    unit = "" if study.units[name] == "1" else f" {study.units[name]}"
    capability = capabilities(spread, *study.limits(name))[1]
    able = "" if capability is None else f", Cpk {style.number(capability.value, 3)}"
    return f"{_words(name)}: σ {style.number(spread.sigma.value, 3, scale=0.0)}{unit}{able}"


def _contributions(axes: Axes, study: ToleranceStudy, name: str) -> None:
    """Shares of the variance: total Sobol' indices where they were asked for, else by the slopes."""
    table = study.table_contributions()
    every = (dict(zip(table.columns, row, strict=True)) for row in zip(*table.data, strict=True))
    rows = [row for row in every if row["quantity"] == name]
    kind = "total" if rows[0]["total"] is not None else "linear"
    shares: list[tuple[str, Any, Any]] = [(row["source"], row[kind], row["total_pm"]) for row in rows]
    what = "total Sobol' index" if kind == "total" else "share of the variance"
    panels.curves(axes, what, "", "Contributions")
    if any(share is None for _, share, _ in shares):
        panels.message(axes, "the quantity has a kink here:\nno linear shares; use --sobol")
        return
    shares.sort(key=lambda row: row[1])
    error = [row[2] for row in shares] if kind == "total" else None
    places = range(len(shares))
    bars = axes.barh(places, [row[1] for row in shares], xerr=error, color=style.ORANGE, height=0.7)
    axes.bar_label(bars, [f"{100.0 * row[1]:.0f} %" for row in shares], padding=2.0, fontsize=7)
    panels.bars_named(axes, [row[0] for row in shares])
    axes.set_xlim(0.0, 1.12 * axes.get_xlim()[1])


_MOST_BARS = 12
"""Bars of a quantity at most."""
_LEAST_SHARE = 0.1
"""Of the height of A4, for a panel: heading, legend, numbers and label leave a bar its room."""


def study_of(design: Any) -> ToleranceStudy | None:
    """The tolerance study of a file; None where it has no tolerances."""
    kind = KINDS.get(design.kind)
    if kind is None or "tolerance" not in kind.commands or getattr(design.spec, "tolerance", None) is None:
        return None
    return cast("ToleranceStudy", design.of_command("tolerance"))


def draw_tornado(design: Any) -> Figure:
    """A panel for each quantity of the study: its change with each source at its lower and its upper limit."""
    from gearlink.core.studies.tolerance_study.design import slopes
    from gearlink.core.studies.tolerance_study.samples import effects

    study = study_of(design)
    assert study is not None, "asked for only where there is one"
    found, nominal = effects(study.problem, list(study.problem.names))
    moved = [name for name, rows in found.items() if _is_moved(rows, nominal[name])]
    names = _of_interest(moved, slopes(study.problem, moved))
    bars = min(_MOST_BARS, len(study.problem.sources))
    each = max(_LEAST_SHARE, 0.05 + 0.022 * bars)
    made = panels.page(f"{study.spec.name}: effect of each tolerance", 0.08 + max(len(names), 1) * each)
    grid = made.add_gridspec(max(len(names), 1), 1)
    for row, name in enumerate(names):
        _panel(made.add_subplot(grid[row, 0]), study, name, found[name], nominal[name])
    if not names:
        panels.message(made.add_subplot(grid[0, 0]), _STILL, 10)
    return made


def _is_moved(rows: list[tuple[str, float, float]], nominal: float) -> bool:
    """Whether some source changes a quantity by more than rounding."""
    most = max((abs(end) for _, *ends in rows for end in ends), default=0.0)
    return most > max(_NOTHING * abs(nominal), _ROUNDING)


def _panel(axes: Axes, study: ToleranceStudy, name: str, rows: list[tuple[str, float, float]], nominal: float) -> None:
    unit = study.units[name]
    least = 1e-6 * max(abs(end) for _, *ends in rows for end in ends)
    shown = [row for row in rows[:_MOST_BARS] if max(abs(row[1]), abs(row[2])) > least][::-1]
    words = _words(name)
    panels.curves(axes, f"change of {words}" + ("" if unit == "1" else f" [{unit}]"), "")
    looks = (1, style.SKY, "at the lower limit", 0.7), (2, style.ORANGE, "at the upper limit", 0.42)
    for side, color, label, height in looks:
        values = [row[side] for row in shown]
        axes.barh(range(len(shown)), values, color=color, height=height, label=label, gid=label)
    axes.axvline(0.0, color=style.BLACK, linewidth=0.9)
    panels.bars_named(axes, [row[0] for row in shown])
    for i, limit in enumerate(one for one in study.limits(name) if one is not None):
        once = None if i else "limit"
        axes.axvline(limit - nominal, color=style.RED, linewidth=1.4, linestyle=style.CHAIN, label=once)
    panels.legend_under_heading(axes, f"{words}: nominal {style.number(nominal, 6)} {unit}".removesuffix(" 1"), 4)
