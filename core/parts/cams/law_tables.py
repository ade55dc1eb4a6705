"""The motion laws as tables: their constants side by side, and the course of the ones that are asked for."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from gearlink.core.base.design import Design, Outline
from gearlink.core.base.report import Report, Table
from gearlink.core.parts.cams.laws import REST_TO_REST, REST_TO_SPEED, Law, law

# Laws with a number are shown at their symmetric value.
FREE_LAWS: tuple[Mapping[str, object], ...] = ({"quintic": 0.5}, {"septic": 0.5})


@dataclass(frozen=True, slots=True)
class LawChoice:
    """The laws that were asked for; none: all of them, by their constants."""

    laws: tuple[Law, ...] = ()
    name: str = "motion"


class MotionLaws(Design):
    """Constants of laws, and rise, velocity, acceleration and jerk over x in [0, 1]."""

    kind = "motion-laws"
    spec: LawChoice
    outlines = {"laws": Outline(tables=("rest_to_rest", "rest_to_speed"))}

    @property
    def groups(self) -> dict[str, list[Law]]:
        """The laws by kind, rest-to-rest first; kinds without a law left out."""
        laws = self.spec.laws or tuple(law(each) for each in (*REST_TO_REST, *REST_TO_SPEED, *FREE_LAWS))
        kinds = {"rest_to_rest": "rest-to-rest", "rest_to_speed": "rest-to-speed"}
        found = {name: [each for each in laws if each.kind == kind] for name, kind in kinds.items()}
        return {name: group for name, group in found.items() if group}

    def report(self, command: str, *, samples: int | None = None, **_asked: Any) -> Report:
        """The tables of constants, and a table for each law that was asked for."""
        tables = [constants(name, group) for name, group in self.groups.items()]
        tables += [course(each, samples or 100) for each in self.spec.laws]
        return Report(self.kind, self.spec.name, command, tables=tuple(tables))


_BESIDE = 1e-9
"""So far beside a joint its two pieces are compared; a continuous acceleration changes by no more than 1e-9 jerk."""


def constants(name: str, laws: Sequence[Law]) -> Table:
    """Peak values of laws: velocity, acceleration, jerk (beside jumps of the acceleration), power, and s(1).

    Cv = max v,  Ca = max |a|,  Cj = max |j|,  Cm = max v a,  kappa = s(1)

    Parameters
        name : str - of the table
        laws : sequence of Law
    Returns
        table : Table - `jumps` says where the acceleration jumps and Cj would be infinite: at the ends or inside
    Example
        >>> constants("one", [law("cycloidal")]).rows()[0][:4]
        ['cycloidal', 2.0, 6.283185307179586, 39.47841760435743]

    Source
        own derivation; constants as VDI 2143
    """
    fields = {"law": "name", "Cv": "peak_velocity", "Ca": "peak_acceleration", "Cj": "interior_jerk"}
    fields |= {"Cm": "peak_power", "kappa": "kappa"}
    columns = {column: [getattr(each, field) for each in laws] for column, field in fields.items()}
    inside = ("inside" if math.isinf(each.peak_jerk) else "none" for each in laws)
    columns["jumps"] = ["at the ends" if each.end_jumps else other for each, other in zip(laws, inside, strict=True)]
    return Table.of(name, {column: (data, "1") for column, data in columns.items()})


def acceleration_jumps(law: Law) -> list[tuple[float, float]]:
    """Where the acceleration of a law jumps, with the jump; at the ends against an acceleration of zero.

    Example
        >>> from gearlink.core.parts.cams.laws import law
        >>> [(x, round(jump, 3)) for x, jump in acceleration_jumps(law("simple-harmonic"))]
        [(0.0, 4.935), (1.0, 4.935)]
    """
    if math.isfinite(law.peak_jerk):
        return []

    def at(x: float) -> float:
        return float(law.evaluate(x, 2)[2])

    found = [(0.0, at(0.0)), *((x, at(x + _BESIDE) - at(x - _BESIDE)) for x in law.joints), (1.0, -at(1.0))]
    return [(x, jump) for x, jump in found if abs(jump) > 1e-6 * law.peak_acceleration]


def course(law: Law, steps: int) -> Table:
    """Rise and its derivatives over x, ends included.

    Parameters
        steps : int - equal steps of x
    Returns
        table : Table - named after the law, steps + 1 rows
    Example
        >>> course(law("polynomial-345"), 2).rows()[1]
        [0.5, 0.5, 1.875, 0.0, -30.0]
    """
    import numpy as np

    x = np.arange(steps + 1) / steps
    columns = zip("xsvaj", (x, *law.evaluate(x, 3)), strict=True)
    return Table.of(law.name, {column: (data, "1") for column, data in columns})
