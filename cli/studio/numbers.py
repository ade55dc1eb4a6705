"""Every number of a design file as what a slider needs: range from the schema, step from what can be built."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, get_args, get_origin

from gearlink.cli.reading.model_shapes import aliases_at, bound, meaning_at, shapes_at, unit_at
from gearlink.cli.reading.units import converted, split
from gearlink.cli.reading.yaml_reader import format_path
from gearlink.core.base.remedies.ways import MODULES
from gearlink.core.base.spec_paths import LARGEST_SIZE, STEPS_BY_UNIT

if TYPE_CHECKING:
    from gearlink.cli.reading.loaded_file import KeyPath, LoadedFile

_ALL = 4.0
"""A range that the schema gives is shown as a whole up to so many times the value."""
_FEWEST, _FEWEST_WHOLE = 60, 10
"""Steps of a slider, at least."""
_FORCED = ("tolerance", "register", "limits", "loads", "clearance", "require")
"""Sections that say what is asked of a mechanism, or what becomes of it; not where its joints stand."""


@dataclass(frozen=True, slots=True)
class Number:
    """A number of the file.

    Fields
        path, name : its place in the file; as it is written
        value : float - as the file has it
        unit, factor : the unit in which the file has it; how much of the key's unit one of it is
        minimum, most, left_out : float, float, bounds that are themselves out - what the schema allows, in that unit
        step : float - in which it can be built; 1 where it is whole
        choices : the only values that it may have; empty where it has a range
        words : str - what it is
    """

    path: KeyPath
    name: str
    value: float
    unit: str
    factor: float
    least: float
    most: float
    left_out: tuple[bool, bool]
    step: float
    whole: bool
    choices: tuple[float, ...]
    words: str

    @property
    def section(self) -> str:
        """The section in which it stands; empty at the top."""
        return str(self.path[0]) if len(self.path) > 1 else ""

    @property
    def is_geometry(self) -> bool:
        """Whether a joint that is dragged may change it, as long as it is not locked."""
        return not self.whole and self.section not in _FORCED and self.unit in _GEOMETRIC and self.path[-1] != "module"

    @property
    def range(self) -> tuple[float, float]:
        """From where to where a slider goes: all that is allowed where that is near, else half the value to either
        side, on the grid of the steps."""
        if self.choices:
            return min(self.choices), max(self.choices)
        fewest = _FEWEST_WHOLE if self.whole else _FEWEST
        reach = max(0.5 * abs(self.value), 0.5 * fewest * self.step)
        low, high = self.value - reach, self.value + reach
        if self.most - self.least <= max(_ALL * abs(self.value), 2.0 * reach):
            low, high = self.least, self.most
        first, last = (
            math.ceil(max(low, self.least) / self.step - 1e-9),
            math.floor(min(high, self.most) / self.step + 1e-9),
        )
        if self.left_out[0] and first * self.step <= self.least:
            first += 1
        if self.left_out[1] and last * self.step >= self.most:
            last -= 1
        return self.rounded(min(first * self.step, self.value)), self.rounded(max(last * self.step, self.value))

    def rounded(self, value: float) -> float:
        """A value without the digits that come of reckoning in steps."""
        return float(round(value, max(0, 2 - math.floor(math.log10(self.step)))))

    def on_grid(self, value: float) -> float:
        """The nearest value that can be built; of a module the nearest of ISO 54."""
        series = self.choices or (MODULES if self.path[-1] == "module" and self.factor == 1.0 else ())
        if series:
            return min(series, key=lambda each: abs(each - value))
        value = self.rounded(round(value / self.step) * self.step)
        return int(value) if self.whole else value


_GEOMETRIC = ("mm", "deg", "cm", "m", "in", "inch", "rad")


def numbers(loaded: LoadedFile, model: Any, known: dict[KeyPath, Any]) -> list[Number]:
    """The numbers that stand in a file, in its order.

    Parameters
        loaded : as it was read; whether it is valid does not matter
        known : what the schema says of paths, kept from one text to the next of a file of one kind
    """
    found = []
    for path, given in _leaves(loaded.tree.data, ()):
        parts = split(given) if isinstance(given, str) else None
        if isinstance(given, str) and parts is None:
            continue
        if path not in known:
            known[path] = _said(model, path, loaded.data)
        shapes, unit, words = known[path]
        factor = 1.0
        if parts is not None:
            one = converted("1", parts[1], unit, str(path[-1])) if float in [shape for shape, _ in shapes] else None
            if one is None or parts[1] == "DP":
                continue
            given, unit, factor = float(parts[0]), parts[1], one
        found.append(_number(path, given, unit, factor, shapes, words))
    return found


def _leaves(node: Any, path: KeyPath) -> Iterator[tuple[KeyPath, Any]]:
    for step, value in node.items() if isinstance(node, dict) else enumerate(node):
        if isinstance(value, (dict, list)):
            yield from _leaves(value, (*path, step))
        elif isinstance(value, (int, float, str)) and not isinstance(value, bool):
            yield (*path, step), value


def _said(model: Any, path: KeyPath, data: Any) -> tuple[Any, str, str]:
    """Shapes, unit and words of a key, under whatever name the file has it."""
    fixed: KeyPath = ()
    for step in path:
        fixed = (*fixed, aliases_at(model, fixed, data).get(str(step), step) if isinstance(step, str) else step)
    return shapes_at(model, fixed, data)[0], unit_at(model, fixed, data), meaning_at(model, fixed, data)


def _number(path: KeyPath, value: float, unit: str, factor: float, shapes: Any, words: str) -> Number:
    kinds = [shape for shape, _ in shapes if shape in (int, float)]
    listed = (each for shape, _ in shapes if get_origin(shape) is Literal for each in get_args(shape))
    choices = tuple(sorted(each for each in listed if type(each) in (int, float)))
    constraints = tuple(each for shape, found in shapes if shape in (int, float) for each in found)
    least, above = bound(constraints, ("ge", "gt"), max, -LARGEST_SIZE)
    most, below = bound(constraints, ("le", "lt"), min, LARGEST_SIZE)
    whole = float not in kinds and bool(kinds or choices)
    step = 1.0 if whole else _step(value, unit, factor)
    name = format_path(path)
    bounds = least / factor, most / factor, (above, below)
    return Number(path, name, value, unit, factor, *bounds, step, whole, () if kinds else choices, words)


def _step(value: float, unit: str, factor: float) -> float:
    """What can be built (0.1 mm, half a degree); finer where the file has more digits or the value is small, coarser
    for numbers of many thousand steps."""
    step = STEPS_BY_UNIT.get(unit, 0.1) / factor
    if factor != 1.0:
        step = 10.0 ** math.floor(math.log10(step))
    digits = f"{value:.12g}".partition("e")[0].partition(".")[2]
    step = min(step, max(10.0 ** -len(digits), 1e-3)) if digits else step
    if value:
        while step > abs(value) / 20.0:
            step /= 10.0
        while step < abs(value) / 20_000.0:
            step *= 10.0
    return step
