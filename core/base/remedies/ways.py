"""Ways to change a design file, the grids on which their values can be built, what a change leaves of its commands."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable, Iterable, Iterator
from itertools import chain
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import Check, Remedy
from gearlink.core.base.spec_paths import number_at, numbers_at, step_of, unit_at

if TYPE_CHECKING:
    from gearlink.core.base.design import Design

_GROWTH = 1.35
_FARTHEST, _LEAST_STEPS, _FINE = 3.0, 30, 200
MODULES = (0.5, 0.6, 0.8, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 16.0, 20.0)
"""Series I of ISO 54 [mm]."""
THINNEST = 0.75
"""Of a shaft's radius: nothing thinner is advised, since it bears less than half of the torque."""
REFUSAL = "refusal"
"""Name under which a design gives candidates where it is refused."""


class Way(NamedTuple):
    """A way to change a design file.

    Fields
        keys : dotted paths, changed together
        step : float - grid of the values, with the sign of the way to go; 0: the keys are left out
        tie : str - what the others do: as many "steps", or they keep their "ratio" to the first, or the "sum";
            "series": each key goes along the standard modules, of which a step is one
        growth : float - the first key changes by at most so many times its value
    """

    keys: tuple[str, ...]
    step: float
    tie: Literal["steps", "ratio", "sum", "series"] = "steps"
    growth: float = _FARTHEST

    def remedy(self, old: list[float], count: int) -> Remedy:
        """Every key with its value `count` steps on; empty where a tooth would be split, or a gear become a ring."""
        if self.step == 0.0:
            return tuple((key, None) for key in self.keys)
        if self.tie == "series":
            farther = [_modules(value, self.step)[count - 1 : count] for value in old]
            return tuple((key, value) for key, values in zip(self.keys, farther, strict=True) for value in values)
        first, *others = old
        new, whole = [_on_grid(first, self.step, count)], all(isinstance(value, int) for value in old)
        if self.tie == "steps":
            new += [_on_grid(value, self.step, count) for value in others]
        elif self.tie == "sum":
            new += [first + value - new[0] if whole else math.fsum((first, value, -new[0])) for value in others]
        elif any(value * new[0] % first for value in others):
            return ()
        else:
            new += [value * new[0] // first for value in others]
        if any(isinstance(was, int) and was * now <= 0 for was, now in zip(old, new, strict=True)):
            return ()
        return tuple(zip(self.keys, new, strict=True))

    def most(self, old: list[float]) -> int:
        """How many steps are tried."""
        if self.tie == "series":
            return len(_modules(old[0], self.step))
        least = _LEAST_STEPS if self.growth == _FARTHEST else 0
        return 1 if self.step == 0.0 else int(self.growth * abs(old[0] / self.step)) + least


def _modules(old: float, side: float) -> tuple[float, ...]:
    """The standard modules beyond one, to one side, the nearest first, as far as lengths may go."""
    most = 1.0 + _FARTHEST
    if side > 0.0:
        return tuple(each for each in MODULES if old < each <= most * old)
    return tuple(each for each in reversed(MODULES) if old / most <= each < old)


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


def wider(*keys: str) -> Way:
    """The way to wider gears, to twice the width: far beyond it the load is carried by one end of the teeth."""
    return Way(keys, 1.0, growth=1.0)


def down(*keys: str, step: float = 0.1) -> Way:
    """The way to smaller values."""
    return Way(keys, -step)


def thinner(*keys: str) -> tuple[Way, ...]:
    """For each key the way to thinner shafts, down to `THINNEST` of them: they have a torque to carry."""
    return tuple(Way((key,), -0.1, growth=1.0 - THINNEST) for key in keys)


def either(*keys: str, step: float = 0.1) -> tuple[Way, ...]:
    """For each key the ways up and down."""
    return tuple(Way((key,), sign * step) for key in keys for sign in (1.0, -1.0))


def shared(*keys: str, step: float) -> tuple[Way, ...]:
    """The ways in which one key takes over what the other gives."""
    return Way(keys, step, "sum"), Way(keys, -step, "sum")


def at_most(value: float, step: float = 0.1) -> float:
    """The maximum value that can be built up to a bound; of one below the step to two digits.

    Example
        >>> at_most(7.3421), at_most(0.0562), at_most(43.2, 0.5)
        (7.3, 0.056, 43.0)
    """
    return _built(value, step, math.floor)


def at_least(value: float, step: float = 0.1) -> float:
    """The minimum value that can be built from a bound on; of one below the step to two digits.

    Example
        >>> at_least(7.3421), at_least(0.0562), at_least(2.52431, 0.01)
        (7.4, 0.057, 2.53)
    """
    return _built(value, step, math.ceil)


def _built(value: float, step: float, way: Callable[[float], int]) -> float:
    if value == 0.0 or not math.isfinite(value):
        return value
    if abs(value) < 2.0 * step:
        step = float(10.0 ** (math.floor(math.log10(abs(value))) - 1))
    return round(way(round(value / step, 9)) * step, max(0, 2 - math.floor(math.log10(step))))


def modules(*keys: str) -> tuple[Way, ...]:
    """For each key the ways to greater and to smaller standard modules."""
    return tuple(Way((key,), side, "series") for key in keys for side in (1.0, -1.0))


def left_out(key: str) -> Way:
    """The way to the default."""
    return Way((key,), 0.0)


def greatest_length(spec: Any) -> float:
    """The maximum length in a design file [mm]."""
    paths = (path for name, field in type(spec).model_fields.items() for path in numbers_at(spec, field.alias or name))
    return max((abs(number_at(spec, path) or 0.0) for path in paths if unit_at(spec, path) == "mm"), default=0.0)


def can_be_built(spec: Any, remedy: Remedy, greatest: float) -> bool:
    """Whether the lengths of a remedy suit the machine.

    Parameters
        greatest : float [mm] - that of the file: no length becomes greater by more than four times, and greater than it
    """
    for path, value in remedy:
        old = number_at(spec, path)
        if old is None or not isinstance(value, (int, float)) or path.endswith("]") or unit_at(spec, path) != "mm":
            continue
        if abs(value) > max((1.0 + _FARTHEST) * abs(old), greatest):
            return False
    return True


def refusal_ways(spec: Any, key: str) -> Iterator[Way]:
    """Ways to change what a refusal names: its number, or each number of its section; a key that may be left out."""
    if not key:
        return
    if number_at(spec, key) is not None:
        yield left_out(key)
    for path in numbers_at(spec, key):
        yield from either(path, step=step_of(spec, path))


def other_ways(spec: Any, key: str) -> Iterator[Way]:
    """Ways to change the numbers beside a key, those of its own section first; nothing of the file's other tasks."""
    sections = [key[: dot.start()] for dot in reversed(list(re.finditer(r"[.\[]", key)))]
    top = (field.alias or name for name, field in getattr(type(spec), "model_fields", {}).items())
    paths = chain.from_iterable(numbers_at(spec, each) for each in (*sections, *(t for t in top if t not in _TASKS)))
    own = set(numbers_at(spec, key)) if key else ()
    for path in dict.fromkeys(paths):
        if path not in own:
            yield from either(path, step=step_of(spec, path))


_TASKS = ("limits", "tolerance", "register", "loads")
"""Sections that say how a machine is judged, and what else is computed of it."""
_KEY = r"[a-z]\w*(?:\[\d+\])*(?:\.[a-z]\w*(?:\[\d+\])*)*"
_VALUE = r"\[[^\]]*\]|-?\d[\d.]*(?:e[-+]?\d+)?|[a-z][a-z\d-]*(?![\w-])"
_SET = re.compile(rf"({_KEY}) (?:to at most|to at least|to|below|above|from) ({_VALUE})")
_REMOVED = re.compile(rf" and remove ({_KEY})")


def printed(fix: str) -> Remedy:
    """The change that a fix tells, as one makes it who follows its first words; empty where it names no value.

    Example
        >>> printed("set stroke below 988.7 mm, lengthen the rod or reduce the offset")
        (('stroke', 988.7),)
        >>> printed("set teeth[0] to 42 and pivots.input to [1, -2.5] and remove sync.end")
        (('teeth[0]', 42), ('pivots.input', (1, -2.5)), ('sync.end', None))
        >>> printed("set the centre distance to at least 40 mm"), printed("shorten the rod")
        ((), ())
    """
    found: list[tuple[str, float | str | tuple[float, ...] | None]] = []
    text, start = fix, "set "
    while text.startswith(start) and (match := _SET.match(text, len(start))):
        found.append((match[1], _read(match[2])))
        text, start = text[match.end() :], " and "
    if not found:
        text, start = " and " + fix, ""
    while match := _REMOVED.match(text):
        found.append((match[1], None))
        text = text[match.end() :]
    return tuple(found)


def _read(text: str) -> float | str | tuple[float, ...]:
    return tuple(value) if isinstance(value := _number(text), list) else value


def _number(text: str) -> Any:
    try:
        return json.loads(text)
    except ValueError:
        return text


def counts(most: int, first: int = 1) -> Iterator[int]:
    """1, 2, 3, 4, 6, 8, ... from `first` on, and `most`; of many of a fine grid the second is half a hundredth."""
    count = first
    while count < most:
        yield count
        count = max(count + 1, int(count * _GROWTH), most // _FINE)
    yield most


# What a change leaves

PASSES, HOLDS = 2, 1
"""Grades of a change: what is to pass passes and nothing is worse; something warns. 0: something fails."""
Ranks = tuple[int, ...]
"""How bad the findings of a check are."""
FAILS = 2
"""The rank of a finding that fails."""
_RANK = {"pass": 0, "warn": 1, "fail": FAILS}


class Standing:
    """A design with the ranks of its findings and whether its commands are refused, each computed once.

    Parameters
        design : None where it is refused before it is made
        whole : str - a command that is looked at as a whole: what its results share is computed first, and once
    """

    def __init__(self, design: Design | None, whole: str = "") -> None:
        self.design = design
        self._whole = whole
        self._ranks: dict[str, Ranks] = {}
        self._found: dict[str, tuple[Check, ...]] = {}
        self._stands: dict[str, bool] = {}

    @property
    def cost(self) -> float:
        """What judging the design costs, as far as that is known."""
        try:
            return 0.0 if self.design is None else self.design.cost
        except NoSolution:
            return 1.0

    def ranks(self, check: str) -> Ranks:
        """How bad the findings of a check are.

        Raises
            NoSolution
        """
        if check not in self._ranks:
            self._prepare()
            self._found[check] = () if self.design is None else tuple(self.design.check(check))
            self._ranks[check] = tuple(_RANK[finding.status] for finding in self._found[check])
        return self._ranks[check]

    def found(self, check: str) -> tuple[Check, ...]:
        """The findings of a check; none where they were not asked for."""
        return self._found.get(check, ())

    def _prepare(self) -> None:
        if self.design is not None and self._whole:
            self.design.prepare(self.design.decisive(self._whole))
            self._whole = ""

    def stands(self, command: str) -> bool:
        """Whether the design is not refused to a command, nor to one of its checks."""
        if command not in self._stands:
            self._stands[command] = self._exists(command)
        return self._stands[command]

    def _exists(self, command: str) -> bool:
        try:
            if self.design is not None:
                self.design.require(command)
                for name in self.checks(command):
                    self.ranks(name)
        except NoSolution:
            return False
        return self.design is not None

    def holds(self, command: str) -> bool:
        """Whether it is not refused, and nothing of the command fails."""
        return self.stands(command) and all(max(self.ranks(name), default=0) < FAILS for name in self.checks(command))

    def checks(self, command: str) -> tuple[str, ...]:
        """The checks that a command shows."""
        return () if self.design is None else self.design.outline(command).checks


def own_grade(before: Standing, now: Standing, check: str, index: int) -> int:
    """What becomes of a finding, the `index`-th of its check; where findings are gone or new the worst counts."""
    ranks = now.ranks(check)
    same = len(ranks) == len(before.ranks(check))
    return PASSES - (ranks[index] if same else max(ranks, default=0))


def steps_to_limit(before: Standing, now: Standing, check: str, index: int) -> float | None:
    """How many steps like the one tried bring what a finding judges to its limit, if it goes on so.

    Returns
        steps : float or None - below 0 where it went the other way, infinite where it did not move; None unless known
    """
    was, found = before.found(check), now.found(check)
    if not found or len(was) != len(found):
        return None
    first, then, limit = was[index].value, found[index].value, was[index].limit
    if first is None or then is None or limit is None:
        return None
    return math.inf if then == first else (limit - first) / (then - first)


def left_of(commands: Iterable[str], before: Standing, now: Standing) -> int:
    """What a change leaves of commands that one class serves: a grade."""
    commands, grade = tuple(commands), PASSES
    for command in commands:
        grade = min(grade, _left_of(command, commands, before, now))
        if grade <= 0:
            return 0
    return grade


def warned(commands: Iterable[str], before: Standing, now: Standing) -> dict[str, None]:
    """The checks of which a change leaves a warning that was not there."""
    commands = tuple(commands)
    shown = dict.fromkeys(name for command in commands if now.stands(command) for name in now.checks(command))
    bad = (name for name in shown if any(now.ranks(name)))
    return {name: None for name in bad if _against(_known(name, commands, before), now.ranks(name)) < PASSES}


def _left_of(command: str, commands: tuple[str, ...], before: Standing, now: Standing) -> int:
    """What is refused already may stay so; what is possible after the change alone is held to all of its checks, and a
    check that a command had not to show is new to it, though another showed it."""
    grade = PASSES
    try:
        for name in now.checks(command):
            ranks = now.ranks(name)
            if any(ranks):
                new = before.stands(command) and name not in before.checks(command)
                grade = min(grade, _against(() if new else _known(name, commands, before), ranks))
            if grade <= 0:
                break
        if now.stands(command):
            return max(0, grade)
    except NoSolution:
        pass
    return 0 if before.stands(command) else PASSES


def _known(name: str, commands: tuple[str, ...], before: Standing) -> Ranks:
    """How bad the findings of a check were; none where every command that shows it was refused."""
    try:
        asked = [command for command in commands if name in before.checks(command)]
        return before.ranks(name) if any(map(before.stands, asked)) else ()
    except NoSolution:
        return ()


def _against(before: Ranks, now: Ranks) -> int:
    """What the findings of a check leave of a grade; where there are more or fewer of them the worst are compared."""
    if len(before) != len(now):
        before, now = tuple(sorted(before, reverse=True)), tuple(sorted(now, reverse=True))
        before += (0,) * (len(now) - len(before))
    worse = [rank for was, rank in zip(before, now, strict=False) if rank > was]
    return PASSES - max(worse, default=0)
