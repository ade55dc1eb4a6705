"""Remedies that were tried: for a check that fails, the keys and the nearest values that repair it.

A kind of design names, for each of its checks, the ways in which a file may be changed: keys, and the step in which
their values can be built (whole teeth, 0.1 mm, 0.01 of profile shift). Values of that grid are tried from the file's
own onwards. A remedy is one with which the check passes, no other finding becomes worse, and nothing that the file
asks for is refused: whoever follows it gets what it says.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import replace
from itertools import islice
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

from gearlink.core.errors import NoSolution
from gearlink.core.report import Check, Remedy, remedy_words
from gearlink.core.results import cached_property
from gearlink.core.spec_paths import changed, number_at, numbers_at, step_of

if TYPE_CHECKING:
    from gearlink.core.design import Design

_GROWTH = 1.35
_FARTHEST, _LEAST_STEPS = 3.0, 30
_RANK = {"pass": 0, "warn": 1, "fail": 2}
_PASSES, _HOLDS = 2, 1
_COSTLY = 4
"""Trials that are costly, of a design that is not; and for each finding those of commands that another class serves."""
REFUSAL = "refusal"
"""Name under which a design gives candidates where it is refused."""


class Way(NamedTuple):
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
        """Every key with its value `count` steps on; empty where a tooth would be split, or a gear become a ring."""
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
        if any(isinstance(was, int) and was * now <= 0 for was, now in zip(old, new, strict=True)):
            return ()
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


def at_most(value: float, step: float = 0.1) -> float:
    """The greatest value that can be built up to a bound; of one below the step to two digits.

    Example
        >>> at_most(7.3421), at_most(0.0562), at_most(43.2, 0.5)
        (7.3, 0.056, 43.0)
    """
    return _built(value, step, math.floor)


def at_least(value: float, step: float = 0.1) -> float:
    """The least value that can be built from a bound on; of one below the step to two digits.

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


def left_out(key: str) -> Way:
    """The way to the default."""
    return Way((key,), 0.0)


def with_remedies(design: Design, command: str, findings: tuple[Check, ...]) -> tuple[Check, ...]:
    """The findings of a check; those that fail have the best remedy that was found, in data and words."""
    if all(found.status == "pass" for found in findings):
        return findings
    bench = design.benches.setdefault(command, Bench(design, command))
    return tuple(_with(bench.remedy(found, index), found) for index, found in enumerate(findings))


def _with(remedy: Remedy, found: Check) -> Check:
    return replace(found, message=f"{found.message}; {remedy_words(remedy)}", remedy=remedy) if remedy else found


class Bench:
    """A design on which changes are tried; what was tried once is kept.

    Parameters
        design, command : the design, and the command whose findings are to be repaired
        patient : bool - what warns is to be repaired as well
    """

    def __init__(self, design: Design, command: str, *, patient: bool = False) -> None:
        self._design = design
        self._command = command
        self._patient = patient
        self._left = 0
        self._costly = 0
        self._trials: dict[Remedy, Design | None] = {}
        self._candidates: dict[str, tuple[list[Remedy], Iterator[Remedy]]] = {}
        self._grades: dict[tuple[Remedy, str, int], int] = {}
        self._refused: set[Remedy] = set()  # whatever finding they are tried for, the same check is refused again

    @cached_property
    def _commands(self) -> tuple[str, ...]:
        """The command, and the others that the file asks for and this class serves."""
        asked = (name for name in self._design.spec.commands() if name in self._design.outlines)
        return tuple(dict.fromkeys((self._command, *asked)))

    def remedy(self, found: Check, index: int) -> Remedy:
        """The best remedy of a finding, the `index`-th of its check; empty where no way leads to one.

        Notes
            A failing check is to pass and no other finding to become worse; where no way leads there, it may warn and
            so may others. A check that warns is to pass.
        """
        if found.status == "pass" or (found.status == "warn" and not self._patient):
            return ()  # what warns may be built: no report waits for its trials
        self._left = self._design.trials - self._design.effort
        for wanted in (_PASSES, _HOLDS) if found.status == "fail" else (_PASSES,):

            def good(tried: Remedy, wanted: int = wanted) -> bool:
                return self._grade(tried, found, index) >= wanted

            few = islice(self._all(found.name, good), _COSTLY)
            if remedy := next((each for each in few if self._grade_elsewhere(each) >= wanted), ()):
                return remedy
        return ()

    def detour(self, found: Check, index: int) -> Remedy:
        """What repairs a finding at the price of others, from where a design may be repaired further."""
        self._left = self._design.trials - self._design.effort

        def good(remedy: Remedy) -> bool:
            trial = self._trial(remedy)
            with suppress(NoSolution):
                return trial is not None and self._own_grade(trial, found, index) > 0 and self._exists(trial)
            return False

        return next(self._all(found.name, good), ())

    def of_refusal(self, error: NoSolution) -> Iterator[Remedy]:
        """Remedies of a design that is refused: nothing of what its file asks for is refused then."""
        self._left = self._design.trials - self._design.effort
        ways = refusal_ways(self._design.spec, error.key)
        yield from (remedy for remedy in self._closed(REFUSAL) if self._stands(remedy))
        yield from (remedy for remedy in (self._along(way, self._stands) for way in ways) if remedy)

    def _all(self, name: str, good: Callable[[Remedy], bool]) -> Iterator[Remedy]:
        """The remedies that are good, the best first."""
        for remedy in self._closed(name):
            if self._left <= 0 and self._design.effort and remedy not in self._trials:
                return  # the few of a closed form count where each takes as long as many
            if good(remedy):
                yield remedy
        found = (self._along(way, good) for way in self._design.ways_of(name))
        yield from (remedy for remedy in found if remedy)

    def _closed(self, name: str) -> Iterator[Remedy]:
        """The remedies from closed forms, computed one after the other; none more where the next is refused."""
        kept, more = self._candidates.setdefault(name, ([], iter(self._design.candidates(name))))
        yield from tuple(kept)
        with suppress(NoSolution):
            for remedy in more:
                kept.append(remedy)
                yield remedy

    def _along(self, way: Way, good: Callable[[Remedy], bool]) -> Remedy:
        """The nearest remedy on a way: steps that grow until one is good, then halving back."""
        values = [number_at(self._design.spec, key) for key in way.keys]
        old = [value for value in values if value is not None]
        if len(old) < len(values):
            return ()
        bad = 0
        for count in _counts(way.most(old)):
            if self._left <= 0:
                return ()
            if good(way.remedy(old, count)):
                break
            bad = count
        else:
            return ()
        while count - bad > 1:
            middle = (bad + count) // 2
            bad, count = (bad, middle) if good(way.remedy(old, middle)) else (middle, count)
        return way.remedy(old, count)

    # Trials

    def _trial(self, remedy: Remedy) -> Design | None:
        """The design after a remedy; None where the file cannot say so."""
        if remedy not in self._trials:
            spec = changed(self._design.spec, remedy) if remedy else None
            trial = None if spec is None else self._affordable(self._design.varied(spec))
            if trial is not None:
                self._left -= 1
                trial.advises = False
            self._trials[remedy] = trial
        return self._trials[remedy]

    def _affordable(self, trial: Design) -> Design | None:
        """The trial; None where it costs much more than the design, and as much was spent already."""
        if trial.costly and not self._design.costly:
            self._costly += 1
            return trial if self._costly <= _COSTLY else None
        return trial

    def _stands(self, remedy: Remedy) -> bool:
        trial = self._trial(remedy)
        try:
            return trial is not None and self._exists(trial)
        except NoSolution:
            return False

    def _grade(self, remedy: Remedy, found: Check, index: int) -> int:
        """What a remedy makes of a finding."""
        key = (remedy, found.name, index)
        if key not in self._grades:
            trial = self._trial(remedy)
            before = 0 if trial is None else trial.effort
            try:
                out = trial is None or remedy in self._refused
                self._grades[key] = 0 if trial is None or out else self._graded(trial, found, index)
            except NoSolution:
                self._grades[key] = 0
                self._refused.add(remedy)
            self._left -= 0 if trial is None else trial.effort - before
        return self._grades[key]

    def _graded(self, trial: Design, found: Check, index: int) -> int:
        grade = self._own_grade(trial, found, index)
        for name in dict.fromkeys((*self._before, *self._checks(trial))):
            if grade <= 0:
                return 0
            grade = min(grade, self._against(trial, name))
        return grade if grade > 0 and self._exists(trial) else 0

    def _own_grade(self, trial: Design, found: Check, index: int) -> int:
        """What becomes of the finding itself; where findings are gone or new the worst of its check counts."""
        now = _ranks(trial, found.name)
        same = len(now) == len(_ranks(self._design, found.name))
        return _PASSES - (now[index] if same else max(now, default=0))

    def _against(self, trial: Design, name: str) -> int:
        """Whether a check is no worse than before; findings that are new or gone are counted by their status.

        A cam that there was not yet has checks of its own, all of them new.
        """
        before, now = self._before.get(name, ()), _ranks(trial, name)
        if any(now) and not self._shown(name):
            before = ()
        return _against(before, now)

    def _grade_elsewhere(self, remedy: Remedy) -> int:
        """What a remedy leaves of the commands of the file that another class serves: none of them becomes worse."""
        trial, grade = self._trials.get(remedy), _PASSES
        for command, before in self._elsewhere.items():
            if trial is not None and before is not None and command in trial.spec.commands():
                now = self._found_elsewhere(command, trial.spec)
                if now is None:
                    return 0
                grade = min(grade, *(_against(before.get(name, ()), ranks) for name, ranks in now.items()), _PASSES)
        return grade

    @cached_property
    def _elsewhere(self) -> dict[str, dict[str, tuple[int, ...]] | None]:
        """How bad the findings are of each command that another class serves, None where it is refused."""
        spec = self._design.spec
        others = () if self._design.kin is None else (c for c in spec.commands() if c not in self._design.outlines)
        return {command: self._found_elsewhere(command, spec) for command in others}

    def _found_elsewhere(self, command: str, spec: Any) -> dict[str, tuple[int, ...]] | None:
        made: Any = self._design.kin.design(command, spec)  # type: ignore[union-attr]  # without it there are none
        made.advises = False
        found = None
        with suppress(NoSolution):
            made.require(command)
            found = {name: _ranks(made, name) for name in made.outline(command).checks}
        self._left -= made.effort
        return found

    @cached_property
    def _before(self) -> dict[str, tuple[int, ...]]:
        """How bad the findings of each check are in the design as it stands."""
        return {name: _ranks(self._design, name) for name in self._checks(self._design)}

    def _shown(self, name: str) -> bool:
        """Whether the design as it stands shows a check: a command that is refused shows none."""
        asked = [command for command in self._commands if name in self._design.outline(command).checks]
        return self._command in asked or any(self._made(command) for command in asked)

    def _made(self, command: str) -> bool:
        """Whether the design as it stands is not refused to a command."""
        try:
            self._design.require(command)
        except NoSolution:
            return False
        return True

    def _checks(self, design: Design) -> dict[str, None]:
        """The checks of every command that counts."""
        return dict.fromkeys(name for command in self._commands for name in design.outline(command).checks)

    def _exists(self, trial: Design) -> bool:
        for command in self._commands:
            trial.require(command)
        return True


def refusal_ways(spec: Any, key: str) -> Iterator[Way]:
    """Ways to change what a refusal names: its number, or each number of its section; a key that may be left out."""
    if not key:
        return
    if number_at(spec, key) is not None:
        yield left_out(key)
    for path in numbers_at(spec, key):
        yield from either(path, step=step_of(spec, path))


def _ranks(design: Design, name: str) -> tuple[int, ...]:
    return tuple(_RANK[check.status] for check in design.check(name))


def _against(before: tuple[int, ...], now: tuple[int, ...]) -> int:
    """What the findings of a check leave of a grade; where there are more or fewer of them the worst are compared."""
    if len(before) != len(now):
        before, now = tuple(sorted(before, reverse=True)), tuple(sorted(now, reverse=True))
        before += (0,) * (len(now) - len(before))
    worse = [rank for was, rank in zip(before, now, strict=False) if rank > was]
    return _PASSES - max(worse, default=0)


def _counts(most: int) -> Iterator[int]:
    """1, 2, 3, 4, 6, 8, ... and `most`."""
    count = 1
    while count < most:
        yield count
        count = max(count + 1, int(count * _GROWTH))
    yield most
