"""`--profile`: what a command computed and how long each took, reported on standard error."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass, field
from functools import cached_property, wraps
from time import perf_counter
from typing import Any

_RESULTS = ("table_", "check_")


@dataclass(slots=True)
class Step:
    """A result that was computed: with what it took itself, and with what it asked others for."""

    name: str
    depth: int
    total: float = 0.0
    own: float = 0.0


@dataclass(slots=True)
class Profile:
    """The steps of a run in the order in which they were begun."""

    steps: list[Step] = field(default_factory=list)
    _open: list[Step] = field(default_factory=list)

    @contextmanager
    def step(self, name: str) -> Iterator[None]:
        """Time what is done within; what is begun inside counts to the total, not to its own time."""
        step = Step(name, len(self._open))
        self.steps.append(step)
        self._open.append(step)
        begun = perf_counter()
        try:
            yield
        finally:
            took = perf_counter() - begun
            step.total += took
            step.own += took
            self._open.pop()
            if self._open:
                self._open[-1].own -= took

    @contextmanager
    def stage(self, name: str) -> Iterator[None]:
        """Time a stage of a command; while it computes, every result of gearlink.core is a step below it."""
        with watched(self) if name == "compute" else nullcontext(), self.step(name):
            yield

    def lines(self) -> list[str]:
        """The profile as text, one line per step, indented under the one that asked for it.

        Example
            >>> profile = Profile([Step("read", 0, 0.002, 0.002)])
            >>> profile.lines()
            ['   total ms     own ms  computed', '      2.000      2.000  read']
        """
        rows = [
            f"{step.total * 1e3:11.3f}{step.own * 1e3:11.3f}  {'  ' * step.depth}{step.name}" for step in self.steps
        ]
        return [f"{'total ms':>11}{'own ms':>11}  computed", *rows]


@contextmanager
def watched(profile: Profile) -> Iterator[None]:
    """Every result that a class of gearlink.core computes within is a step of the profile.

    The results are looked up in the classes that are loaded now; nothing is in their way when none is watched.
    """
    undo: list[Callable[[], None]] = []
    for owner in list(_classes()):
        for name, value in list(vars(owner).items()):
            label = f"{owner.__name__}.{name}"
            if isinstance(value, cached_property):
                undo.append(_replace(value, "func", _timed(profile, label, value.func)))
            elif name.startswith(_RESULTS) and callable(value):
                undo.append(_replace(owner, name, _timed(profile, label, value)))
    try:
        yield
    finally:
        for each in undo:
            each()


def _classes() -> Iterator[type]:
    for module in list(sys.modules.values()):
        name = getattr(module, "__name__", "")
        if name.startswith("gearlink.core."):
            yield from (each for each in vars(module).values() if isinstance(each, type) and each.__module__ == name)


def _replace(owner: Any, name: str, value: Any) -> Callable[[], None]:
    before = vars(owner)[name] if isinstance(owner, type) else getattr(owner, name)
    setattr(owner, name, value)
    return lambda: setattr(owner, name, before)


def _timed(profile: Profile, label: str, function: Callable[..., Any]) -> Callable[..., Any]:
    @wraps(function)
    def timed(*arguments: Any, **named: Any) -> Any:
        with profile.step(label):
            return function(*arguments, **named)

    return timed
