"""Changes of a design are tried: for a check that fails, the keys and the nearest values that repair it.

A kind of design names, for each of its checks, the ways in which a file may be changed: keys, and the step in which
their values can be built (whole teeth, 0.1 mm, 0.01 of profile shift). Values of that grid are tried from the file's
own onwards. A remedy is one with which the check passes, no other finding becomes worse, and nothing that the file
asks for is refused: whoever follows it gets what it says.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from itertools import chain, islice
from typing import TYPE_CHECKING

from gearlink.core.base.errors import MissingSection, NoSolution, anew
from gearlink.core.base.remedies.ways import (
    FAILS,
    HOLDS,
    PASSES,
    REFUSAL,
    Standing,
    Way,
    can_be_built,
    counts,
    greatest_length,
    left_of,
    other_ways,
    own_grade,
    printed,
    refusal_ways,
    steps_to_limit,
    warned,
)
from gearlink.core.base.report import Check, Remedy, fix_words
from gearlink.core.base.results import cached_property
from gearlink.core.base.spec_paths import changed, number_at

if TYPE_CHECKING:
    from gearlink.core.base.design import Design

BUDGET = 150.0
"""What the trials for one finding may cost, that of most designs being 1: a tenth of a second or so."""
_FINDINGS, _REST = 5, 10
"""All findings together may cost as much as so many; then each has its share of a tenth."""
_ELSEWHERE = 50.0
"""What judging commands that another class serves may cost, for all findings together."""
_BESIDE = 0.3
"""Share of it for numbers that a refusal does not name."""
_MUCH, _OF_WAY = 2.0, 3
"""A trial that costs so many times as much as the design is dear; values of one way that are worth one."""


def with_remedies(design: Design, command: str, findings: tuple[Check, ...]) -> tuple[Check, ...]:
    """The findings of a check; those that fail have the best remedy that was found, in data and words."""
    if not any(found.status == "fail" or _is_sought(design, found) for found in findings):
        return findings  # what warns may be built: no report waits for its trials
    bench = design.bench(command)
    with _unheard():
        return tuple(_with(design, bench, found, index) for index, found in enumerate(findings))


def with_fix(design: Design, command: str, error: NoSolution) -> NoSolution:
    """A refusal with a fix that was tried: that which it tells, or another with which nothing fails, or that leads to a
    design that is not refused; as it was where none was found.

    Notes
        What misses in a file is to be given, and the refusal says what.
    """
    if isinstance(error, MissingSection) or not design.repairable:
        return error
    bench, told = design.bench(command), printed(error.fix)
    known = [] if design.kin is None else design.kin.remedies
    with _unheard():
        leads = bool(told) and bench.leads(told)
        if leads and bench.holds(told):
            return error
        remedy = next(filter(bench.holds, known), ()) or next(filter(bench.leads, bench.of_refusal(error)), ())
        if not remedy or (leads and not bench.holds(remedy)):
            return error
    known.append(remedy)
    again = anew(error)
    again.fix = fix_words(remedy, relaxes=design.asks_less(key for key, _ in remedy))
    return again


@contextmanager
def _unheard() -> Iterator[None]:
    """Whoever reads a terminal did not ask for a changed design, which may divide by zero before it is refused."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        yield


def _is_sought(design: Design, found: Check) -> bool:
    """Whether a finding that warns has a remedy that is computed rather than tried."""
    return found.status == "warn" and found.name in design.repaired_where_they_warn


def _with(design: Design, bench: Bench, found: Check, index: int) -> Check:
    remedy = bench.remedy(found, index)
    if not remedy:
        return found
    left = bench.warnings_left(remedy, found, index)
    notes = (f"warnings that remain: {', '.join(left)}",) if left else ()
    relaxes = design.asks_less(key for key, _ in remedy)
    return found._replace(remedy=remedy, relaxes=relaxes, note=(*found.note, *notes))


class Bench:
    """A design on which changes are tried; what was tried once is kept.

    Parameters
        design, command : the design, and the command whose findings are to be repaired
        patient : bool - what warns is to be repaired as well
    """

    def __init__(self, design: Design, command: str, *, patient: bool = False) -> None:
        self._design = design
        self._patient = patient
        self._commands = commands_of(design, command)
        self._before = Standing(design)
        self._left = 0.0
        self._elsewhere_left = _ELSEWHERE * (_FINDINGS if patient else 1)
        self._paid: dict[Remedy, float] = {}
        self._spent: dict[Remedy, float] = {}
        self._trials: dict[Remedy, Standing | None] = {}
        self._candidates: dict[str, tuple[list[Remedy], Iterator[Remedy]]] = {}
        self._grades: dict[tuple[Remedy, str, int], int] = {}
        self._found: dict[tuple[str, int], Remedy] = {}
        self._others: dict[tuple[Remedy, str], Standing] = {}

    def remedy(self, found: Check, index: int) -> Remedy:
        """The best remedy of a finding, the `index`-th of its check; empty where no way leads to one.

        Notes
            A failing check is to pass and no other finding to become worse; where no way leads there, it may warn and
            so may others. A check that warns is to pass.
        """
        if found.status == "pass" or (
            found.status == "warn" and not (self._patient or _is_sought(self._design, found))
        ):
            return ()
        if (found.name, index) not in self._found:
            self._found[found.name, index] = self._sought(found, index)
        return self._found[found.name, index]

    def _sought(self, found: Check, index: int) -> Remedy:
        self._begin()
        for wanted in (PASSES, HOLDS) if found.status == "fail" else (PASSES,):

            def good(tried: Remedy, wanted: int = wanted) -> bool:
                return self._grade(tried, found.name, index) >= wanted

            whole = self._whole(chain(self._of_earlier(found.name), self._closed(found.name)), good)
            for remedy in chain(whole, self._all(found.name, good, index)):
                if not self._is_affordable_elsewhere(remedy):
                    break
                if self._grade_elsewhere(remedy) >= wanted:
                    return next(self._farther(remedy, found.name, good), remedy)
        return next(self._beside(found, index), ()) if found.status == "fail" and self._design.has_ways else ()

    def _beside(self, found: Check, index: int) -> Iterator[Remedy]:
        """Remedies by numbers of the file that the kind names no way of, where its own ways lead nowhere."""
        self._begin()
        named = {way.keys for way in self._design.ways_of(found.name)}
        ways = (way for way in other_ways(self._design.given, "") if way.keys not in named)
        ways = (way for way in ways if not self._design.asks_less(way.keys))

        def good(tried: Remedy) -> bool:
            return self._grade(tried, found.name, index) >= HOLDS

        for way, first in self._led(ways, good, found.name, index):
            for remedy in islice(self._along(way, good, first), 1):
                if self._is_affordable_elsewhere(remedy) and self._grade_elsewhere(remedy) >= HOLDS:
                    yield remedy

    def _of_earlier(self, name: str) -> Iterator[Remedy]:
        """The closed forms of what fails before a check: where one of them repairs both, both name it.

        They are trials of that check, and do not count for this one.
        """
        left = self._left
        with suppress(NoSolution):  # then there are no findings of a command, and none before this one
            for each in chain.from_iterable(map(self._before.checks, self._commands)):
                if each == name:
                    return
                if any(rank == FAILS for rank in self._before.ranks(each)):
                    for remedy in self._closed(each):
                        yield remedy
                        self._left = left

    def _whole(self, remedies: Iterable[Remedy], good: Callable[[Remedy], bool]) -> Iterator[Remedy]:
        """Those that are good and with which nothing fails, before those that repair one of several findings."""
        for remedy in remedies:
            if not self._is_paid(remedy, -BUDGET):
                return
            if not self._design.asks_less(key for key, _ in remedy) and good(remedy) and self.holds(remedy):
                yield remedy

    def _farther(self, remedy: Remedy, name: str, good: Callable[[Remedy], bool]) -> Iterator[Remedy]:
        """Where the same way repairs other failing findings: the nearest value that repairs them all.

        Each of them then names it, and whoever follows the first advice has followed the others.
        """
        keys = tuple(key for key, _ in remedy)
        ways = [way for way in self._design.ways_of(name) if way.keys == keys]
        others = [] if not ways else self._failing_of(ways)
        if len(others) > 1:

            def repairs(tried: Remedy) -> bool:
                return good(tried) and all(self._grade(tried, *each) == PASSES for each in others)

            for each in self._along(ways[0], repairs):
                if self._is_affordable_elsewhere(each) and self._grade_elsewhere(each) == PASSES:
                    yield each
                return

    def _failing_of(self, ways: list[Way]) -> list[tuple[str, int]]:
        """The failing findings that one of the ways bears on: the check, and which of its findings."""
        with suppress(NoSolution):
            names = dict.fromkeys(chain.from_iterable(map(self._before.checks, self._commands)))
            return [
                (name, index)
                for name in names
                if any(way in ways for way in self._design.ways_of(name))
                for index, rank in enumerate(self._before.ranks(name))
                if rank == FAILS
            ]
        return []

    def _begin(self) -> None:
        """What trials for one finding may cost, those counted that are known from another: what it gets does not
        depend on others, until all have cost too much."""
        whole = sum(self._spent.values()) < _FINDINGS * BUDGET
        self._left = (BUDGET if whole else BUDGET / _REST) - self._before.cost
        self._paid = {}

    def _pay(self, remedy: Remedy) -> None:
        """Take from what is left for the finding what a trial costs by now, once."""
        trial = self._trials[remedy]
        cost = 0.0 if trial is None else trial.cost
        self._left -= cost - self._paid.get(remedy, 0.0)
        self._paid[remedy] = self._spent[remedy] = cost

    def _is_paid(self, remedy: Remedy, down_to: float = 0.0) -> bool:
        """Whether a trial is paid already for this finding, or can be; closed forms are few, and may overdraw."""
        return self._left > down_to or remedy in self._paid

    def warnings_left(self, remedy: Remedy, found: Check, index: int) -> tuple[str, ...]:
        """The checks that warn after a remedy: its own, and those that passed before."""
        if min(self._grade(remedy, found.name, index), self._grade_elsewhere(remedy)) >= PASSES:
            return ()
        trial = self._trials[remedy]
        assert trial is not None
        left = warned(self._commands, self._before, trial)
        for command in self._elsewhere:
            left |= warned((command,), self._other((), command), self._other(remedy, command))
        own = {found.name: None} if own_grade(self._before, trial, found.name, index) < PASSES else {}
        return tuple(own | left)

    def detour(self, found: Check, index: int) -> Remedy:
        """What repairs a finding at the price of others, from where a design may be repaired further."""
        self._begin()

        def good(remedy: Remedy) -> bool:
            trial = self._trial(remedy)
            with suppress(NoSolution):
                return (
                    trial is not None
                    and own_grade(self._before, trial, found.name, index) > 0
                    and all(map(trial.stands, self._commands))
                )
            return False

        return next(self._all(found.name, good, index), ())

    def of_refusal(self, error: NoSolution) -> Iterator[Remedy]:
        """Remedies of a design that is refused: nothing of what its file asks for is refused then, and first those with
        which nothing of it fails; numbers beside the one that the refusal names come last."""
        given = self._design.given
        own, beside = tuple(refusal_ways(given, error.key)), tuple(other_ways(given, error.key))
        for ways in (own, tuple(way for way in beside if not self._design.asks_less(way.keys))):
            self._begin()
            self._left *= 1.0 if ways is own or self._patient else _BESIDE
            for good in (self.holds, self._stands):
                if self._patient:
                    self._begin()
                if ways is own:
                    yield from (remedy for remedy in self._closed(REFUSAL) if good(remedy))
                for less in (False, True):
                    some = (way for way in ways if self._design.asks_less(way.keys) is less)
                    yield from (remedy for way in some for remedy in islice(self._along(way, good), 1))

    def leads(self, remedy: Remedy) -> bool:
        """Whether nothing that the commands ask for is refused after a change, nor worse elsewhere, where that can be
        judged."""
        return self._stands(remedy) and (
            not self._is_affordable_elsewhere(remedy) or self._grade_elsewhere(remedy) >= HOLDS
        )

    def _all(self, name: str, good: Callable[[Remedy], bool], index: int) -> Iterator[Remedy]:
        """The remedies of a finding that are good, the best first."""
        for less in (False, True):
            for remedy in self._closed(name):
                if not self._is_paid(remedy, -BUDGET):
                    break
                if self._design.asks_less(key for key, _ in remedy) is less and good(remedy):
                    yield remedy
            ways = (way for way in self._design.ways_of(name) if self._design.asks_less(way.keys) is less)
            for way, first in self._led(ways, good, name, index):
                yield from islice(self._along(way, good, first), _OF_WAY)

    def _led(
        self, ways: Iterable[Way], good: Callable[[Remedy], bool], name: str, index: int
    ) -> Iterator[tuple[Way, int]]:
        """Ways that bear on a finding, by the first step of each, and the count of steps to try first.

        Notes
            Where a trial takes long, those whose first step leads to the limit come first, from half the steps on
            that it seems to take, and ways that seem to lead elsewhere last.
        """
        later: list[tuple[Way, int]] = []
        for way in ways:
            old = self._numbers(way)
            step = way.remedy(old, 1) if old else ()
            known = self._is_paid(step) and not good(step)
            trial = self._trials.get(step)
            steps = steps_to_limit(self._before, trial, name, index) if known and trial is not None else 1.0
            if not old or steps == math.inf:
                continue
            if steps is None or self._before.cost <= 1.0:
                yield way, 1
            elif 0.0 <= steps <= way.most(old):
                yield way, max(1, int(0.5 * steps))
            else:
                later.append((way, 1))
        yield from later

    def _numbers(self, way: Way) -> list[float]:
        """The numbers of the file that a way changes; none where one of them is missing."""
        values = [number_at(self._design.given, key) for key in way.keys]
        old = [value for value in values if value is not None]
        return old if len(old) == len(values) else []

    def _closed(self, name: str) -> Iterator[Remedy]:
        """The remedies from closed forms, computed one after the other; none more where the next is refused."""
        kept, more = self._candidates.setdefault(name, ([], iter(self._design.candidates(name))))
        yield from tuple(kept)
        with suppress(NoSolution):
            for remedy in more:
                kept.append(remedy)
                yield remedy

    def _along(self, way: Way, good: Callable[[Remedy], bool], first: int = 1) -> Iterator[Remedy]:
        """The nearest remedy on a way: steps that grow until one is good, then halving back; then those farther on."""
        old = self._numbers(way)
        if not old:
            return
        bad = 0
        nearest: Remedy = ()
        for count in counts(way.most(old), first):
            remedy = way.remedy(old, count)
            if not self._is_paid(remedy):
                return
            if not good(remedy):
                bad = bad if nearest else count
                continue
            if not nearest:
                yield (nearest := self._back(way, old, bad, count, good))
            if remedy != nearest:
                yield remedy

    def _back(self, way: Way, old: list[float], bad: int, found: int, good: Callable[[Remedy], bool]) -> Remedy:
        """The nearest that is good, by halving between one that is not and one that is; it may overdraw by a half."""
        while found - bad > 1 and 2.0 * self._left > -BUDGET:
            middle = (bad + found) // 2
            bad, found = (bad, middle) if good(way.remedy(old, middle)) else (middle, found)
        return way.remedy(old, found)

    # Trials

    def _trial(self, remedy: Remedy) -> Standing | None:
        """The design after a remedy; None where the file cannot say so, or there is none."""
        if remedy not in self._trials:
            given, spec, trial = self._design.given, None, None
            if remedy and can_be_built(given, remedy, self._greatest):
                spec = changed(given, remedy)
            if spec is not None:
                with suppress(NoSolution):
                    trial = self._affordable(Standing(self._design.varied(spec)))
            self._trials[remedy] = trial
        self._pay(remedy)
        return self._trials[remedy]

    @cached_property
    def _greatest(self) -> float:
        return greatest_length(self._design.given)

    def _affordable(self, trial: Standing) -> Standing | None:
        """The trial; None where it is dear, and would take more than half of what is left."""
        assert trial.design is not None
        trial.design.advises = False
        return None if trial.cost > max(_MUCH * self._before.cost, 0.5 * self._left) else trial

    def _stands(self, remedy: Remedy) -> bool:
        trial = self._trial(remedy)
        stands = trial is not None and all(map(trial.stands, self._commands))
        self._pay(remedy)
        return stands

    def holds(self, remedy: Remedy) -> bool:
        """Whether nothing of the commands is refused or fails after a change."""
        trial = self._trial(remedy)
        holds = trial is not None and all(trial.holds(command) for command in self._commands)
        self._pay(remedy)
        return holds

    def _grade(self, remedy: Remedy, name: str, index: int) -> int:
        """What a remedy makes of a finding, and leaves of the commands of its class."""
        key, trial = (remedy, name, index), self._trial(remedy)
        if trial is None:
            return 0
        if key not in self._grades:
            self._grades[key] = self._graded(trial, name, index)
        self._pay(remedy)
        return self._grades[key]

    def _graded(self, trial: Standing, name: str, index: int) -> int:
        try:
            grade = own_grade(self._before, trial, name, index)
        except NoSolution:
            return 0
        return min(grade, left_of(self._commands, self._before, trial)) if grade > 0 else 0

    # Commands that other classes serve

    @cached_property
    def _elsewhere(self) -> tuple[str, ...]:
        """The commands of the file that another class serves."""
        design = self._design
        asked = () if design.kin is None else design.given.commands()
        return tuple(command for command in asked if command not in design.outlines)

    def _is_affordable_elsewhere(self, remedy: Remedy) -> bool:
        """Whether the commands of the file that another class serves may be judged once more."""
        new = [command for command in self._elsewhere if (remedy, command) not in self._others]
        self._elsewhere_left -= max((self._other(remedy, command).cost for command in new), default=0.0)
        return self._elsewhere_left >= 0.0

    def _grade_elsewhere(self, remedy: Remedy) -> int:
        """What a remedy leaves of them: none becomes worse, none is refused that was not."""
        grade = PASSES
        for command in self._elsewhere:
            grade = min(grade, left_of((command,), self._other((), command), self._other(remedy, command)))
            if grade <= 0:
                return 0
        return grade

    def _other(self, remedy: Remedy, command: str) -> Standing:
        """The design that serves a command after a remedy, none that no longer asks for it; before it without one."""
        key = (remedy, command)
        if key not in self._others:
            kin = self._design.kin
            assert kin is not None
            spec, made = changed(self._design.given, remedy) if remedy else self._design.given, None
            if command in spec.commands():
                with suppress(NoSolution):
                    made = (kin.changed(spec) if remedy else kin).of(command)
            self._others[key] = Standing(made, command)
        return self._others[key]


def commands_of(design: Design, command: str) -> tuple[str, ...]:
    """The command, and the others that the file asks for and the design's class serves."""
    asked = (name for name in design.given.commands() if name in design.outlines)
    return tuple(dict.fromkeys((command, *asked)))
