"""Meshes of external spur gears without profile shift, for arrays of tooth numbers.

All that a gear has of itself depends on its teeth, the pressure angle and the module alone: it is taken once for each
tooth number from a `GearPair` of module 1 with itself, and from its checks. What two gears have of each other is formed
from these rows.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.base.design_axis import Findings
from gearlink.core.numerics.arrays import Reals, distinct
from gearlink.core.parts.gears.checks import contact_measure, gear_check, most_sliding
from gearlink.core.parts.gears.codes import (
    CONTACT_RATIO,
    INTERFERENCE,
    ROOT_CLEARANCE,
    SLIDING,
    TIP_THICKNESS,
    TOOTH_FORM,
    UNDERCUT,
)
from gearlink.core.parts.gears.mesh.pair import GearPair

if TYPE_CHECKING:
    from gearlink.core.base.spec import GearLimits

_LENGTHS = (
    "reference_radius",
    "base_radius",
    "working_radius",
    "tip_radius",
    "root_radius",
    "tooth_thickness",
    "tip_thickness",
    "span_measurement",
)
_PLAIN = ("profile_shift", "min_shift_no_undercut", "span_teeth", "tip_pressure_angle")
_OWN_CHECKS = (UNDERCUT, TIP_THICKNESS, ROOT_CLEARANCE, TOOTH_FORM)
MOST_TEETH = 10_000


@dataclass(frozen=True)
class _Gears:
    """Gears by their columns in the table of all tooth numbers."""

    table: Reals
    places: Any

    def __getitem__(self, row: int) -> Reals:
        """A row of the table for these gears; one that is the same for all tooth numbers is not spread out."""
        values = self.table[row]
        if (values == values[0]).all():
            return np.broadcast_to(values[0], self.places.shape)
        found: Reals = values[self.places]
        return found


class UnshiftedMeshes:
    """Meshes of gears of one pressure angle.

    Parameters
        pressure_angle : float [rad]
        limits : of the checks
    Notes
        Agrees with `GearPair` to a few ulp; the checks of one gear are `gear_check`'s own.
    """

    def __init__(self, pressure_angle: float, limits: GearLimits) -> None:
        self._angle, self._limits = pressure_angle, limits
        self._place = np.full(MOST_TEETH + 1, -1, dtype=np.intp)
        self._rows: list[tuple[float, ...]] = []
        self._table: Reals = np.empty((0, 0))

    def _at(self, teeth: Reals) -> _Gears:
        """The rows of gears."""
        numbers = np.asarray(teeth, dtype=np.int64)
        places = self._place[numbers]
        if places.size and places.min() < 0:
            for z in distinct(numbers[places < 0]).tolist():
                self._place[z] = len(self._rows)
                self._rows.append(self._row(z))
            self._table = np.array(self._rows).T
            places = self._place[numbers]
        return _Gears(self._table, places)

    def _row(self, teeth: int) -> tuple[float, ...]:
        """At module 1: quantities, the way of contact at the tip, value, limit, fails and warns of each check."""
        pair = GearPair.from_shift(1.0, (teeth, teeth), (0.0, 0.0), pressure_angle=self._angle)
        row = [*(float(getattr(pair, name)[0]) for name in (*_LENGTHS, *_PLAIN)), pair.contact_ratio * math.pi]
        for rule in _OWN_CHECKS:
            found = next(gear_check(rule.name, pair, self._limits))
            assert found.value is not None, "all of them compare"
            assert found.limit is not None, "all of them compare"
            row += [found.value, found.limit, float(found.status == "fail"), float(found.status == "warn")]
        return tuple(row)

    def meshes(self, first: Reals, second: Reals, module: Reals) -> Mesh:
        """The meshes of arrays of gears.

        Parameters
            first, second : (N,) arrays - teeth, whole numbers from 1 to 10,000
            module : (N,) array [mm]
        """
        return Mesh(self._angle, self._limits, (first, second), module, (self._at(first), self._at(second)))


@dataclass(frozen=True)
class Mesh:
    """Meshes over arrays; made by `UnshiftedMeshes`."""

    pressure_angle: float
    limits: GearLimits
    teeth: tuple[Reals, Reals]
    module: Reals
    rows: tuple[_Gears, _Gears]

    def quantity(self, name: str) -> Any:
        """A quantity of GEAR_QUANTITIES [mm, rad], that of a gear with its index; None where this form has it not."""
        plain, _, index = name.partition("[")
        if index in ("0]", "1]"):
            row = self.rows[int(index[0])]
            if plain in _LENGTHS:
                return row[_LENGTHS.index(plain)] * self.module
            return row[len(_LENGTHS) + _PLAIN.index(plain)] if plain in _PLAIN else None
        if index:
            return None
        if plain in ("center_distance", "reference_center_distance"):
            return self.module * (self.teeth[0] + self.teeth[1]) / 2.0
        constant = {"working_pressure_angle": self.pressure_angle, "shift_sum": 0.0, "tip_shortening": 0.0}
        constant["center_distance_modification"] = 0.0
        if plain in constant:
            return np.full(self.module.shape, constant[plain])
        return self.contact_ratio if plain == "contact_ratio" else None

    def _action(self, gear: int) -> Reals:
        return self.rows[gear][len(_LENGTHS) + len(_PLAIN)]

    @property
    def contact_ratio(self) -> Reals:
        """eps_alpha."""
        return (self._action(0) + self._action(1)) / (2.0 * math.pi)

    def _left_at_root(self, gear: int) -> Reals:
        """What the mating gear's tip leaves of the line of action, as `GearPair` has it."""
        return self.teeth[gear] * math.tan(self.pressure_angle) - self._action(1 - gear)

    def findings(self) -> Iterator[Findings]:
        """The findings of the checks of gears on every mesh."""
        for gear in (0, 1):
            yield from self._own(gear)
        ratio = self.contact_ratio
        _, least, usual = contact_measure(ratio, self.limits)
        fails = ratio < least
        yield Findings(CONTACT_RATIO.code, ratio, np.full(ratio.shape, least), fails, ~fails & (ratio < usual), "1")
        nothing = np.zeros(ratio.shape, dtype=bool)
        scale = 0.5 * self.module * math.cos(self.pressure_angle)
        margins = [scale * self._left_at_root(1), scale * self._left_at_root(0)]
        for margin in margins:
            yield Findings(INTERFERENCE.code, margin, np.zeros(ratio.shape), margin < 0.0, nothing, "mm")
        yield from self._sliding(np.minimum(*margins) > 0.0, nothing)

    def _own(self, gear: int) -> Iterator[Findings]:
        start = len(_LENGTHS) + len(_PLAIN) + 1
        for i, rule in enumerate(_OWN_CHECKS):
            value, limit, fails, warns = (self.rows[gear][start + 4 * i + j] for j in range(4))
            length = rule is TOOTH_FORM
            shown = value * self.module if length else value
            yield Findings(rule.code, shown, limit, fails > 0.0, warns > 0.0, "mm" if length else "1")

    def _sliding(self, slides: Any, nothing: Any) -> Iterator[Findings]:
        limit = most_sliding(self.limits)
        for gear in (0, 1):
            mate = self.teeth[1 - gear]
            with np.errstate(all="ignore"):
                size = np.abs(self._action(1 - gear) * (mate + self.teeth[gear]) / (mate * self._left_at_root(gear)))
            warns = slides & (size > limit)
            value = np.where(slides, size, np.nan)
            yield Findings(SLIDING.code, value, np.full(value.shape, limit), nothing, warns, "1")
