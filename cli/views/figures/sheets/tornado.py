"""Tornado charts of a tolerance study: each source at its limits, all others nominal, the widest effect on top."""

from __future__ import annotations

import cmath
from typing import TYPE_CHECKING, Any, TypeAlias, cast

import numpy as np

from gearlink.cli.views.figures.drawing import panels, style
from gearlink.core.base.kinds import KINDS

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.studies.tolerance_study.design import ToleranceStudy

_MOST, _MOST_BARS, _AROUND = 4, 12, 24
"""Quantities and bars at most, and the directions in which the play of a pin is tried."""


def study_of(design: Any) -> ToleranceStudy | None:
    """The tolerance study of a file; None where it has no tolerances."""
    kind = KINDS.get(design.kind)
    if kind is None or "tolerance" not in kind.commands or getattr(design.spec, "tolerance", None) is None:
        return None
    return cast("ToleranceStudy", kind.design("tolerance", design.spec))


def draw(design: Any) -> Figure:
    """A panel for each quantity of the study: its change with each source at its lower and its upper limit."""
    study = study_of(design)
    assert study is not None, "asked for only where there is one"
    names = list(study.problem.names)[:_MOST]
    found, nominal = effects(study, names)
    bars = min(_MOST_BARS, len(study.problem.sources))
    share = min(1.0, 0.08 + len(names) * (0.05 + 0.022 * bars))
    made = panels.page(f"{study.spec.name}: effect of each tolerance", share)
    grid = made.add_gridspec(max(len(names), 1), 1)
    for row, name in enumerate(names):
        _panel(made.add_subplot(grid[row, 0]), study, name, found[name], nominal[name])
    return made


Effects: TypeAlias = dict[str, list[tuple[str, float, float]]]


def effects(study: ToleranceStudy, names: list[str]) -> tuple[Effects, dict[str, float]]:
    """Source, change at its lower and at its upper limit, by quantity, the widest first; and the nominal values.

    Notes
        The play of a pin acts in the direction of the smallest and of the largest value, of 24.
    """
    from gearlink.core.studies.tolerance_study.samples import evaluated

    made = study.problem
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
    for name in names:
        change = np.asarray(values[name], dtype=float) - float(values[name][0])
        rows = []
        for source in made.sources:
            own = change[[k for k, key in enumerate(owner) if key == source.key]]
            low, high = (own[0], own[1]) if source.kind != "pin" else (float(np.nanmin(own)), float(np.nanmax(own)))
            rows.append((source.key, float(low), float(high)))
        found[name] = sorted(rows, key=lambda row: -max(abs(row[1]), abs(row[2])))
    return found, {name: float(values[name][0]) for name in names}


def _panel(axes: Axes, study: ToleranceStudy, name: str, rows: list[tuple[str, float, float]], nominal: float) -> None:
    unit = study.units[name]
    shown = rows[:_MOST_BARS][::-1]
    words = name.replace("_", " ")
    style.curves(axes, f"change of {words}" + ("" if unit == "1" else f" [{unit}]"), "")
    panels.small_ticks(axes)
    looks = (1, style.SKY, "at the lower limit", 0.7), (2, style.ORANGE, "at the upper limit", 0.42)
    for side, color, label, height in looks:
        values = [row[side] for row in shown]
        axes.barh(range(len(shown)), values, color=color, height=height, label=label, gid=label)
    axes.axvline(0.0, color=style.BLACK, linewidth=0.9)
    axes.set_yticks(range(len(shown)), [row[0] for row in shown])
    for limit in study.limits(name):
        if limit is not None:
            axes.axvline(limit - nominal, color=style.RED, linewidth=1.4, linestyle=style.CHAIN, label="limit")
    panels.legend_under_heading(axes, f"{words}: nominal {style.number(nominal, 6)} {unit}".removesuffix(" 1"), 4)
