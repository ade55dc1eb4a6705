"""What a message says that a key takes, the key takes: for each number of each kind, found by walking the models.

Limits are tried as they are printed and one unit in the last place (of whole numbers 1) beyond.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable, Iterator
from typing import Any, Literal, get_args, get_origin

import pytest
from sweeps import mostly_slow

from gearlink.cli.reading import model_shapes
from gearlink.cli.reading.design_file import parse, validate
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.reading.yaml_reader import format_path
from gearlink.core.base.kinds import FILES

Build = Callable[[Any], Any]


def numbers(shape: Any, constraints: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[tuple[Any, ...], Any, Build]]:
    """Every number below a type: its path, its type with constraints, and what makes the data that hold it."""
    arguments = get_args(shape)
    if shape in (int, float):
        yield path, (shape, constraints), lambda value: value
    elif model_shapes._is_model(shape):
        tags = {name: get_args(f.annotation)[0] for name, f in model_shapes._keys(shape) if is_tag(f)}
        for name, field in model_shapes._keys(shape):
            said = (*field.metadata, *model_shapes._said(field))
            for way, kind, build in below(field.annotation, said, (*path, name)):
                yield way, kind, lambda value, name=name, build=build: {**tags, name: build(value)}
    elif get_origin(shape) is dict:
        for way, kind, build in below(arguments[1], (), (*path, "x")):
            yield way, kind, lambda value, build=build: {"x": build(value)}
    elif get_origin(shape) is tuple and arguments[-1:] != (...,):
        for place, member in enumerate(arguments):
            for way, kind, build in below(member, (), (*path, place)):
                yield (
                    way,
                    kind,
                    lambda value, build=build, place=place: [
                        build(value) if each == place else 1 for each in range(len(arguments))
                    ],
                )
    elif get_origin(shape) in (list, tuple):
        for way, kind, build in below(arguments[0], (), (*path, 0)):
            yield way, kind, lambda value, build=build: [build(value)]


def below(annotation: Any, said: Any, path: tuple[Any, ...]) -> Iterator[tuple[tuple[Any, ...], Any, Build]]:
    for shape, constraints in model_shapes._flat(annotation, said):
        yield from numbers(shape, constraints, path)


def is_tag(field: Any) -> bool:
    return get_origin(field.annotation) is Literal and len(get_args(field.annotation)) == 1 and field.is_required()


def every_key() -> list[Any]:
    """Keys of all kinds, of those with the same name in the same section and the same range one."""
    found: dict[Any, Any] = {}
    for kind, file in FILES.items():
        for path, (shape, constraints), build in numbers(file.spec_model(), ()):
            if path != ("kind",):
                found.setdefault((path[-2:], shape, repr(constraints)), (kind, format_path(path), build))
    ranges = {repr(sign[1:]): sign for sign in found}  # first one key of each range, then the rest
    return [found[sign] for sign in [*ranges.values(), *(each for each in found if each not in ranges.values())]]


KEYS = every_key()


def refused(kind: str, data: Any, key: str) -> list[Diagnostic]:
    try:
        validate(parse(json.dumps({"kind": kind, **data}).encode(), "f"), FILES[kind].spec_model())
    except DesignFileError as error:
        return [each for each in error.diagnostics if each.key == key and each.code in ("GL107", "GL108")]
    return []


def test_the_walk_finds_the_keys() -> None:
    keys = {(kind, key) for kind, key, *_ in KEYS}
    assert len(keys) > 400
    assert {key for _, key in keys} >= {"module", "teeth[0]", "gears.i3", "tolerance.sources.x.grade", "sync.length"}


@pytest.mark.quick(12)
@pytest.mark.parametrize(
    ("kind", "key", "build"),
    mostly_slow(KEYS, 60),
    ids=lambda part: part if isinstance(part, str) else "",
)
def test_what_is_allowed_is_accepted_and_what_lies_beyond_is_not(kind: str, key: str, build: Build) -> None:
    (tiny,), (huge,) = (refused(kind, build(value), key) for value in (1e-300, 1e300))
    assert tiny.help == huge.help
    allowed = huge.help.removeprefix("allowed: ")
    whole = "whole" in allowed
    named = re.findall(r"(above |below |from |to |at least |)(-?\d[\d.e+-]*)", allowed)
    assert named
    for word, number in named:
        value = int(number) if whole else float(number)
        left_out = word in ("above ", "below ")
        assert bool(refused(kind, build(value), key)) == left_out, (allowed, value)
        assert left_out or word not in ("from ", "to ") or beyond_is_refused(kind, key, build, value, word, whole)


def beyond_is_refused(kind: str, key: str, build: Build, value: float, word: str, whole: bool) -> bool:
    way = -1 if word == "from " else 1
    beyond = value + way if whole else math.nextafter(value, way * math.inf)
    data = build(beyond)
    try:
        validate(parse(json.dumps({"kind": kind, **data}).encode(), "f"), FILES[kind].spec_model())
    except DesignFileError as error:
        return any(each.key.startswith(key[:3]) for each in error.diagnostics)
    return False
