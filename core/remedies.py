"""Remedies that were tried: for a check that fails, the keys and the nearest values that repair it.

A kind of design names, for each of its checks, the ways in which a file may be changed: keys, and the step in which
their values can be built (whole teeth, 0.1 mm, 0.01 of profile shift). Values of that grid are tried from the file's
own onwards. A remedy is one with which the check passes, no check that held fails, and nothing that the file asks
for is refused: whoever follows it gets what it says.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Literal

from gearlink.core.errors import NoSolution
from gearlink.core.report import Check, Remedy, remedy_words
from gearlink.core.results import cached_property
from gearlink.core.spec_paths import changed, number_at

if TYPE_CHECKING:
    from gearlink.core.design import Design

_GROWTH = 1.35
_FARTHEST, _LEAST_STEPS = 3.0, 30


@dataclass(frozen=True, slots=True)
class Way:
    """A way to change a design file.

    Fields
        keys : dotted paths, changed together
        step : float - grid of the values, with the sign of the way to go; 0: the keys are left out
        tie : str - what the others do: as many "steps", or they keep their "ratio" to the first, or the "sum"
    """

    keys: tuple[str, ...]
    step: float
    tie: Literal["steps", "ratio", "sum"] = "steps"

    def remedy(self, old: list[float], count: int) -> Remedy:
        """Every key with its value `count` steps on; empty where a tooth would be split."""
        if self.step == 0.0:
            return tuple((key, None) for key in self.keys)
        first, *others = old
        new = [_on_grid(first, self.step, count)]
        if self.tie == "steps":
            new += [_on_grid(value, self.step, count) for value in others]
        elif self.tie == "sum":
            new += [math.fsum((first, value, -new[0])) for value in others]
        elif any(value * new[0] % first for value in others):
            return ()
        else:
            new += [value * new[0] // first for value in others]
        return tuple(zip(self.keys, new, strict=True))

    def most(self, old: list[float]) -> int:
        """How many steps are tried."""
        return 1 if self.step == 0.0 else int(_FARTHEST * abs(old[0] / self.step)) + _LEAST_STEPS


def _on_grid(old: float, step: float, count: int) -> float:
    """The value `count` steps on; a value between the steps of the grid reaches it with the first."""
    if isinstance(old, int) and step == int(step):
        return old + count * int(step)
    size, side = abs(step), math.copysign(1.0, step)
    start = side * math.floor(side * old / size + 1e-9)
    return round((start + side * count) * size, max(0, 2 - math.floor(math.log10(size))))


def up(*keys: str, step: float = 0.1) -> Way:
    """The way to greater values."""
    return Way(keys, step)


def down(*keys: str, step: float = 0.1) -> Way:
    """The way to smaller values."""
    return Way(keys, -step)


def either(*keys: str, step: float = 0.1) -> tuple[Way, ...]:
    """For each key the ways up and down."""
    return tuple(Way((key,), sign * step) for key in keys for sign in (1.0, -1.0))


def shared(*keys: str, step: float) -> tuple[Way, ...]:
    """The ways in which one key takes over what the other gives."""
    return Way(keys, step, "sum"), Way(keys, -step, "sum")


def left_out(key: str) -> Way:
    """The way to the default."""
    return Way((key,), 0.0)


def with_remedies(design: Design, command: str, findings: tuple[Check, ...]) -> tuple[Check, ...]:
    """The findings of a check; those that fail have the first remedy that holds, in data and words."""
    bench = _Bench(design, command)
    return tuple(
        _with(bench.remedy(found.name, index), found) if found.status == "fail" else found
        for index, found in enumerate(findings)
    )


def _with(remedy: Remedy, found: Check) -> Check:
    return replace(found, message=f"{found.message}; {remedy_words(remedy)}", remedy=remedy) if remedy else found


class _Bench:
    """A design on which changes are tried."""

    def __init__(self, design: Design, command: str) -> None:
        self._design = design
        self._command = command
        self._left = 0

    @cached_property
    def _commands(self) -> tuple[str, ...]:
        """The command, and the others that the file asks for and this class serves."""
        asked = (name for name in self._design.spec.commands() if name in self._design.outlines)
        return tuple(dict.fromkeys((self._command, *asked)))

    def remedy(self, name: str, index: int) -> Remedy:
        """The first remedy of a finding, the `index`-th of its check; empty where no way leads to one."""
        self._left = self._design.trials

        def good(trial: Design) -> bool:
            return self._repairs(trial, name, index)

        for remedy in self._design.candidates(name):
            if self._holds(remedy, good):
                return remedy
        found = (self._along(way, good) for way in self._design.ways.get(name, ()))
        return next((remedy for remedy in found if remedy), ())

    def _along(self, way: Way, good: Callable[[Design], bool]) -> Remedy:
        """The nearest remedy on a way: steps that grow until one is good, then halving back."""
        values = [number_at(self._design.spec, key) for key in way.keys]
        old = [value for value in values if value is not None]
        if len(old) < len(values):
            return ()
        bad = 0
        for count in _counts(way.most(old)):
            if self._left <= 0:
                return ()
            if self._holds(way.remedy(old, count), good):
                break
            bad = count
        else:
            return ()
        while count - bad > 1:
            middle = (bad + count) // 2
            bad, count = (bad, middle) if self._holds(way.remedy(old, middle), good) else (middle, count)
        return way.remedy(old, count)

    def _holds(self, remedy: Remedy, good: Callable[[Design], bool]) -> bool:
        if not remedy:
            return False
        spec = changed(self._design.spec, remedy)
        try:
            return spec is not None and good(self._trial(spec))
        except NoSolution:
            return False

    def _trial(self, spec: Any) -> Design:
        self._left -= 1
        trial = type(self._design)(spec)
        trial.advises = False
        return trial

    def _repairs(self, trial: Design, name: str, index: int) -> bool:
        found = _failing(trial, name)
        if index < len(found) and found[index]:
            return False
        return all(self._no_worse(trial, other) for other in self._before) and self._exists(trial)

    def _no_worse(self, trial: Design, name: str) -> bool:
        before, now = self._before[name], _failing(trial, name)
        if len(before) != len(now):
            return not any(now) or sum(now) < sum(before)
        return all(was or not fails for was, fails in zip(before, now, strict=True))

    @cached_property
    def _before(self) -> dict[str, tuple[bool, ...]]:
        """Which findings of each check fail in the design as it stands."""
        names = dict.fromkeys(name for command in self._commands for name in self._design.outline(command).checks)
        return {name: _failing(self._design, name) for name in names}

    def _exists(self, trial: Design) -> bool:
        for command in self._commands:
            trial.require(command)
        return True


def _failing(design: Design, name: str) -> tuple[bool, ...]:
    return tuple(check.status == "fail" for check in design.check(name))


def _counts(most: int) -> Iterator[int]:
    """1, 2, 3, 4, 6, 8, ... and `most`."""
    count = 1
    while count < most:
        yield count
        count = max(count + 1, int(count * _GROWTH))
    yield most
