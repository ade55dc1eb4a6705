"""How the commands of a file stand under a design, and what a change leaves of them."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING

from gearlink.core.errors import NoSolution

if TYPE_CHECKING:
    from gearlink.core.design import Design
    from gearlink.core.report import Check

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
    def effort(self) -> int:
        """What was computed of the design so far, in trials."""
        return 0 if self.design is None else self.design.effort

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
