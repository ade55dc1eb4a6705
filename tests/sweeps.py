"""How far the tests that try many inputs go: `make test` takes a share, `make check-full` all."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from typing import Any

import pytest
from hypothesis import settings

ALL = os.environ.get("GEARLINK_EXAMPLES") == "all"
SHARE = 10
FEWEST = 10


def examples(count: int) -> Any:
    """So many examples of a property in `make check-full`, a tenth of them in `make test`, at least 10.

    The cases that a property test must not miss stand beside it as examples of their own or as reference cases.
    """
    return settings(max_examples=count if ALL else max(count // SHARE, min(count, FEWEST)))


def spread(cases: Iterable[Any], quick: int) -> list[Any]:
    """What a test compares one by one: all in `make check-full`, in `make test` so many, evenly spread."""
    every = list(cases)
    return every if ALL or len(every) <= quick else [every[i * len(every) // quick] for i in range(quick)]


def mostly_slow(cases: Sequence[Any], quick: int) -> list[Any]:
    """Cases for `pytest.mark.parametrize`, of which all but the first few belong to `make check-full` alone."""
    return [*cases[:quick], *(pytest.param(*_row(case), marks=pytest.mark.slow) for case in cases[quick:])]


def _row(case: Any) -> tuple[Any, ...]:
    return case if isinstance(case, tuple) else (case,)
