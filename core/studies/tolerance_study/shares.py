"""Replications as shares of a study's work: each depends on the study's text and its own number alone."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from functools import lru_cache, partial
from typing import TypeVar

from gearlink.core.base.kinds import KINDS
from gearlink.core.studies.tolerance.shares import is_shared, of_replications
from gearlink.core.studies.tolerance_study.problem import Problem, problem

Found = TypeVar("Found")


def replicated(made: Problem, function: Callable[[Problem, int], Found], work: int = 1) -> Iterable[Found]:
    """What a function finds in every replication, in order.

    Parameters
        made : Problem
        function : of the problem and the replication's number - of a module, so that it can be sent elsewhere
        work : int - designs of a replication, as it tells `seen`
    """
    if is_shared():
        return of_replications(partial(_by_text, function, text_of(made)), work)
    return of_replications(partial(function, made), work)


def _by_text(function: Callable[[Problem, int], Found], text: str, number: int) -> Found:
    return function(problem_of(text), number)


def text_of(made: Problem) -> str:
    """A study as text, from which `problem_of` makes the same study anywhere."""
    section = made.section.model_dump(mode="json", exclude_unset=True, exclude_none=True, by_alias=True)
    section["command"] = made.base.command
    return json.dumps({**made.base.data, "tolerance": section})


@lru_cache(maxsize=4)
def problem_of(text: str) -> Problem:
    """The study of a text."""
    return problem(KINDS[json.loads(text)["kind"]].spec_model().model_validate_json(text))
