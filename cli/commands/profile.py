"""`--profile`: what a command computed and how long each took, reported on standard error."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass, field
from time import perf_counter

from gearlink.core.base.results import observed


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
        with observed(self.step) if name == "compute" else nullcontext(), self.step(name):
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
