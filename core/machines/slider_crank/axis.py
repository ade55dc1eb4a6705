"""Slider-cranks over arrays of designs: `core.base.design_axis` for the crank of a stroke and the motion of the slider.

Every quantity is that of `SliderCrankDesign`, whose formulas take arrays for the lengths; only the extremes of the
motion are sought for all designs at once.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from types import SimpleNamespace
from typing import Any, ClassVar

import numpy as np

from gearlink.core.base.design_axis import Evaluated, Findings, kept_inside
from gearlink.core.base.nomenclature import term
from gearlink.core.base.spec_paths import number_at
from gearlink.core.machines.slider_crank.design import FOUND, SliderCrankDesign
from gearlink.core.numerics.arrays import Mask, Reals
from gearlink.core.numerics.elementary import Elementary
from gearlink.core.numerics.elementary_sweep import ARRAYS
from gearlink.core.numerics.roots_sweep import bracketed_roots
from gearlink.core.parts.linkages.checks import transmission_judged
from gearlink.core.parts.linkages.codes import TRANSMISSION_ANGLE
from gearlink.core.parts.linkages.slider_crank import SliderCrank, slider_sweep
from gearlink.core.parts.linkages.standstills import SLIDER_GRID, TURN, Turning

_LENGTH = (1e-6, 1e9, 1.0)
_DOMAIN = {
    "stroke": _LENGTH,
    "crank": _LENGTH,
    "rod": _LENGTH,
    "offset": (-1e9, 1e9, 0.0),
    "input_speed": (1e-6, 1e6, 1.0),
    "limits.transmission_angle": (0.0, 90.0, 40.0),
}
"""Keys that may vary: minimum and maximum value computed here, and one that stands in for others."""
_CHECKS: dict[str, set[str]] = {"crank": set(), "analyze": {TRANSMISSION_ANGLE.name}}
"""Commands that are served, with the checks that are judged here."""
_NEAR = 1e-9
_BARELY = 1e-6
_BLOCK = 64


def axis(
    spec: Any, command: str, paths: Sequence[str], quantities: Sequence[str], checks: Sequence[str]
) -> SliderCrankAxis | None:
    """The array form of a study of slider-cranks; None where the design class has to serve.

    Parameters
        spec, command, paths, quantities, checks : as of `core.base.design_axis.Maker`
    """
    sizes = [name for name in ("stroke", "crank") if getattr(spec, name) is not None or name in paths]
    served = spec.racks is None and spec.quick_return_ratio is None and "quick_return_ratio" not in paths
    served = served and command in _CHECKS and set(paths) <= _DOMAIN.keys() and len(sizes) == 1
    served = served and set(checks) <= _CHECKS[command]
    if not served or not set(quantities) <= {*SliderCrankDesign.outlines["analyze"].quantities} - {*FOUND}:
        return None
    return SliderCrankAxis(spec, command, tuple(quantities))


@dataclass(frozen=True)
class SliderCrankAxis:
    """The array form; made by `axis`."""

    spec: Any
    command: str
    wanted: tuple[str, ...]

    def evaluate(self, columns: Mapping[str, Reals]) -> Evaluated:
        """As `core.base.design_axis.Axis`."""
        inside, outside = kept_inside(columns, _DOMAIN)
        values = {path: inside.get(path, number_at(self.spec, path)) for path in _DOMAIN}
        with np.errstate(all="ignore"):
            return self._evaluated(SliderCrankDesigns(values, outside.size), outside, values)

    def _evaluated(self, designs: SliderCrankDesigns, outside: Mask, values: Mapping[str, Any]) -> Evaluated:
        refused = np.where(designs.reached, np.where(designs.exist, 0, 2), 1)
        there, doubtful = refused == 0, designs.doubtful
        quantities = {name: _shown(designs, name, there) for name in self.wanted}
        findings = [_transmission(designs, values["limits.transmission_angle"], there)]
        near = np.abs(findings[0].value - findings[0].limit) <= _NEAR * 90.0
        if any(name.endswith("_at") for name in self.wanted):
            doubtful = doubtful | designs.tied
        reasons = ("offset", "stroke" if values["crank"] is None else "crank")
        unsure = outside | doubtful | (near & there)
        if self.command == "crank":
            findings = []
        return Evaluated(quantities, findings, refused, reasons, unsure)


def _shown(designs: SliderCrankDesigns, name: str, there: Mask) -> Reals:
    value = designs.raw(name)
    value = np.nan if value is None else np.degrees(value) if term(name).unit == "deg" else value
    return np.where(there, value, np.nan)


def _transmission(designs: SliderCrankDesigns, limit: Any, there: Mask) -> Findings:
    """GL303."""
    value = np.broadcast_to(np.degrees(designs.min_transmission_angle), there.shape)
    found = transmission_judged(value, limit).of(there.size)
    return replace(found, fails=found.fails & there, warns=found.warns & there)


@dataclass(frozen=True)
class SliderCranks(SliderCrank):
    """Slider-cranks over arrays; where none exists their results are NaN."""

    fn: ClassVar[Elementary] = ARRAYS

    def __post_init__(self) -> None:
        """Nothing is refused."""

    @classmethod
    def _require_turn(cls, crank: float, rod: float, offset: float) -> None:
        """Nothing is refused."""


class SliderCrankDesigns(SliderCrankDesign):
    """Slider-cranks as designs.

    Parameters
        values : by key, (N,) arrays, numbers, or None where a design has none
        count : int - N
    """

    spec: Any

    def __init__(self, values: Mapping[str, Any], count: int) -> None:
        keys = {path: value for path, value in values.items() if "." not in path}
        super().__init__(SimpleNamespace(**keys, quick_return_ratio=None, racks=None))
        self.count = count

    @cached_property
    def slider_crank(self) -> SliderCranks:
        """The mechanisms."""
        given = self.spec
        if given.crank is not None:
            return SliderCranks.of_crank(given.crank, given.rod, given.offset)  # type: ignore[return-value]
        return SliderCranks(given.stroke, given.rod, given.offset)

    def _spread(self, value: Any) -> Any:
        return np.broadcast_to(value, (self.count,))

    @cached_property
    def reached(self) -> Mask:
        """Where the rod reaches the slide line."""
        return np.asarray(self._spread(abs(self.spec.offset) < self.spec.rod))

    @cached_property
    def _room(self) -> Any:
        """Rod less offset and crank [mm]."""
        return self._spread(self.spec.rod - abs(self.spec.offset) - self.crank_length)

    @cached_property
    def exist(self) -> Mask:
        """Where the crank makes a full revolution."""
        if self.spec.crank is not None:
            return np.asarray(self._room >= 0.0)
        return np.asarray(self._spread(self.spec.stroke < self.max_stroke))

    @cached_property
    def doubtful(self) -> Mask:
        """Where that hangs by few digits, or the rod comes near to the normal of the slide line."""
        near = np.abs(self._room) <= _BARELY * self.spec.rod
        if self.spec.crank is None:
            near |= self._spread(abs(self.spec.stroke - self.max_stroke) <= _BARELY * self.max_stroke)
        return np.asarray(self._spread(near))

    # Extremes of the motion

    @cached_property
    def _some(self) -> Any:
        """Places of the designs whose motion is computed here."""
        return np.flatnonzero(self.reached & self.exist & ~self.doubtful)

    def _depth(self, some: Any, order: int) -> Callable[[Any], Any]:
        crank, rod, offset = (
            self._spread(value)[some] for value in (self.crank_length, self.spec.rod, self.spec.offset)
        )
        return lambda angle: slider_sweep(angle, crank, rod, offset, order)[order]

    def _brackets(self, order: int) -> tuple[Any, Any]:
        """Which designs, and steps of the grid, in which a derivative changes its sign."""
        grid = np.array(SLIDER_GRID)
        found: list[tuple[Any, Any]] = [(np.empty(0, dtype=int), np.empty(0, dtype=int))]
        for first in range(0, len(self._some), _BLOCK):
            some = self._some[first : first + _BLOCK]
            values = self._depth(some[:, None], order)(grid[None, :])
            before, after = values[:, :-1], values[:, 1:]
            changes = (before == 0.0) | ((before < 0.0) & (after > 0.0)) | ((before > 0.0) & (after < 0.0))
            rows, steps = np.nonzero(changes)
            found.append((some[rows], steps))
        return np.concatenate([rows for rows, _ in found]), np.concatenate([steps for _, steps in found])

    def _turnings(self, order: int) -> list[Turning]:
        rows, steps = self._brackets(order + 1)
        grid = np.array(SLIDER_GRID)
        places = bracketed_roots(self._depth(rows, order + 1), grid[steps], grid[steps + 1])
        speeds, places = self._depth(rows, order)(places), places % TURN % TURN
        return [self._extreme(rows, places, speeds, sign) for sign in (1.0, -1.0)]

    def _extreme(self, rows: Any, places: Reals, speeds: Reals, sign: float) -> Turning:
        """The maximum (sign 1) or minimum of each design's turnings; of equal ones the last, or the first."""
        ranked = np.lexsort((sign * places, sign * speeds, rows))
        last = ranked[np.flatnonzero(np.append(rows[ranked][1:] != rows[ranked][:-1], rows.size > 0))]
        best, place = np.full(self.count, np.nan), np.full(self.count, np.nan)
        best[rows[last]], place[rows[last]] = speeds[last], places[last]
        close = np.abs(speeds - best[rows]) <= _NEAR * np.maximum(1.0, np.abs(speeds))
        self.tied[rows[close & (places != place[rows])]] = True
        return Turning(place, best)  # type: ignore[arg-type]

    @cached_property
    def tied(self) -> Mask:
        """Where an extreme, once it was asked for, stands at two places, of which rounding chooses one."""
        return np.zeros(self.count, dtype=bool)
