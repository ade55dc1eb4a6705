"""What each tolerance does by itself: the change of quantities with one source at its limits, all others nominal."""

from __future__ import annotations

import cmath
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from gearlink.core.studies.tolerance_study.samples import evaluated

if TYPE_CHECKING:
    from gearlink.core.studies.tolerance_study.design import ToleranceStudy

_AROUND = 24
"""Directions in which the play of a pin is tried."""
Effects: TypeAlias = dict[str, list[tuple[str, float, float]]]


def effects(study: ToleranceStudy, names: list[str]) -> tuple[Effects, dict[str, float]]:
    """Source, change at its lower and at its upper limit, by quantity, the widest first; and the nominal values.

    Notes
        The play of a pin acts in the direction of the smallest and of the largest value, of 24.
    """
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
