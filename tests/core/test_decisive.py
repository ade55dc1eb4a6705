"""What `require` leaves out refuses nothing: the same files are refused whether or not it is computed."""

from __future__ import annotations

import json
import random
from collections.abc import Callable, Iterable, Iterator
from copy import deepcopy
from functools import cache
from typing import Any

import pytest
from pydantic import ValidationError

from gearlink.core.base.design import Design
from gearlink.core.base.errors import NoSolution
from gearlink.core.base.kinds import KINDS
from tests.factory import DESIGNS, worked

_STUDIES = ("tolerance", "register")
_FACTORS = (0.3, 0.6, 0.8, 0.9, 1.1, 1.2, 1.5, 2.5)


@cache
def _files(kind: str) -> list[dict[str, Any]]:
    """The examples of a kind, without the studies that they ask for besides."""
    text = f"kind: {kind}\n"
    names = [path.stem for path in sorted(DESIGNS.glob("*.yaml")) if text in path.read_text(encoding="utf-8")]
    found = [worked(name) for name in names]
    return [
        {key: value for key, value in data.items() if key not in _STUDIES} for data in found if data["kind"] == kind
    ]


def _numbers(data: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    for key, value in data.items() if isinstance(data, dict) else enumerate(data):
        if isinstance(value, (dict, list)):
            yield from _numbers(value, (*path, key))
        elif isinstance(value, (int, float)) and not isinstance(value, bool):
            yield (*path, key)


def _changed(draw: random.Random, data: dict[str, Any]) -> dict[str, Any]:
    """A file with one to four of its numbers changed."""
    data = deepcopy(data)
    paths = list(_numbers(data))
    for path in draw.sample(paths, k=min(len(paths), draw.randint(1, 4))):
        place: Any = data
        for step in path[:-1]:
            place = place[step]
        value, factor = place[path[-1]], draw.choice(_FACTORS)
        place[path[-1]] = round(value * factor) if isinstance(value, int) else value * factor
    return data


def _refusal(what: Callable[..., Any], given: Iterable[Any]) -> str:
    try:
        for each in given:
            what(each)
    except NoSolution as error:
        return str(error)
    return ""


def _computed(made: Design, command: str) -> str:
    """As a report asks: every quantity."""
    try:
        names = made.outline(command).quantities
    except NoSolution as error:
        return str(error)
    return _refusal(made.raw, names)


def _checked(made: Design, command: str) -> str:
    """As `check` asks: every check, then what is decisive."""
    try:
        names = made.outline(command).checks
    except NoSolution as error:
        return str(error)
    return _refusal(made.check, names) or _refusal(made.require, [command])


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "count"), [("slider-crank", 60), ("three-gear-four-bar", 60), ("wide-swing-cam", 24), ("machine", 16)]
)
def test_what_require_leaves_out_refuses_nothing(kind: str, count: int) -> None:
    draw, files, refused = random.Random(11), _files(kind), 0
    for _ in range(count):
        data = _changed(draw, draw.choice(files))
        try:
            spec = KINDS[kind].spec_model().model_validate_json(json.dumps(data))
        except ValidationError:  # what the model refuses is refused in every way
            continue
        for command in spec.commands():
            made, whole = KINDS[kind].design(command, spec), KINDS[kind].design(command, spec)
            asked = _computed(whole, command)
            said = _checked(made, command)
            assert said or not asked, (data, command, asked)
            refused += bool(asked)
    assert refused


@pytest.mark.parametrize(
    ("kind", "command"),
    [
        ("machine", "loads"),
        ("wide-swing-cam", "swing"),
        ("wide-swing-cam", "analyze"),
        ("slider-crank", "analyze"),
        ("three-gear-four-bar", "analyze"),
    ],
)
def test_extremes_and_runs_are_left_out(kind: str, command: str) -> None:
    """Of what the class says that refuses nothing, `require` asks for nothing."""
    data = next(data for data in _files(kind) if command in ("swing", "analyze") or "loads" in data)
    made = KINDS[kind].design(command, KINDS[kind].spec_model().model_validate_json(json.dumps(data)))
    shown, asked = made.outline(command).quantities, set(made.decisive(command))
    assert made.derived & set(shown), "nothing to leave out"
    assert not asked & made.derived
    assert asked


@pytest.mark.parametrize("fed", [True, False])
def test_what_a_file_without_a_feed_has_not_is_not_asked_for(fed: bool) -> None:
    data = next(data for data in _files("three-gear-four-bar") if ("feed" in data) is fed)
    kind = KINDS["three-gear-four-bar"]
    made = kind.design("analyze", kind.spec_model().model_validate_json(json.dumps(data)))
    assert ("feed_per_turn" in made.decisive("analyze")) is fed
