"""Outcomes as bytes and back; back only what has every field, each of its own type and in its range."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from dataclasses import fields, is_dataclass
from functools import cache
from types import NoneType, UnionType
from typing import Any, Literal, Union, get_args, get_origin, get_type_hints

from gearlink.cli.batch.outcome import Outcome
from gearlink.cli.reading.diagnostics import Diagnostic
from gearlink.core.report import Report, Table


class _Column:
    """Stands for the type of a table's column: numbers, words, and nothing where a value does not exist."""


_NAMES = {"Column": _Column}


def as_bytes(results: Sequence[Outcome]) -> bytes:
    """Outcomes as JSON.

    Raises
        ValueError - for a number that is not finite
    """
    return json.dumps(results, default=_fields, allow_nan=False).encode()


def _fields(item: Any) -> dict[str, Any]:
    record = {field.name: getattr(item, field.name) for field in fields(item)}
    if isinstance(item, Table):
        record["data"] = list(zip(*item.each_row(), strict=True)) or [[] for _ in item.columns]
    return record


def restored(data: bytes) -> list[Outcome]:
    """The outcomes that `as_bytes` wrote.

    Raises
        ValueError - for anything else
    """
    try:
        found = [_restored(Outcome, item) for item in json.loads(data)]
    except (TypeError, KeyError, RecursionError) as error:
        raise ValueError(f"{type(error).__name__}: {error}") from error
    if not found:
        raise ValueError("no outcome")
    for outcome in found:
        _require_sense(outcome)
    return found


def _restored(kind: Any, value: Any) -> Any:
    """A value as the type says: dataclasses from mappings, tuples from lists, all else as it is."""
    if kind is _Column:
        return _column(value)
    if isinstance(kind, type) and is_dataclass(kind):
        types = _types(kind)
        if not isinstance(value, dict) or value.keys() != types.keys():
            raise ValueError(f"no {kind.__name__}")
        return kind(**{name: _restored(types[name], value[name]) for name in value})
    origin, inner = get_origin(kind), get_args(kind)
    if origin in (Union, UnionType):
        return _first_that_fits(inner, value)
    if origin in (tuple, list) and isinstance(value, list):
        each = inner[:1] * len(value) if origin is list or Ellipsis in inner else inner
        return origin(_restored(t, item) for t, item in zip(each, value, strict=True))
    fits = value in inner if origin is Literal else _is(kind, value)
    if not fits:
        raise ValueError(f"{value!r:.60} is no {getattr(kind, '__name__', kind)}")
    return value


@cache
def _types(kind: type) -> dict[str, Any]:
    """The fields of a dataclass and their types, which stand in its module as words."""
    hints = get_type_hints(kind, localns=_NAMES)
    return {field.name: hints[field.name] for field in fields(kind)}


def _first_that_fits(kinds: Sequence[Any], value: Any) -> Any:
    for kind in kinds:
        try:
            return _restored(kind, value)
        except ValueError as error:
            wrong = error
    raise wrong


def _is(kind: Any, value: Any) -> bool:
    """Whether a plain value is of a plain type; a whole number serves for a float, a truth value for neither."""
    if kind in (float, int):
        return type(value) in {kind, int} and math.isfinite(value)
    return type(value) is kind


def _column(value: Any) -> list[Any]:
    if not isinstance(value, list) or not {type(item) for item in value} <= {float, int, str, NoneType}:
        raise ValueError("no column of a table")
    return value


def _require_sense(outcome: Outcome) -> None:
    """What the types do not say."""
    places = [(error.line, error.column) for error in outcome.errors] + list(outcome.places)
    if any(line < 1 or column < 1 for line, column in places):
        raise ValueError("a place before the first line or column")
    if not all(map(_is_error, outcome.errors)) or (outcome.report is None) == (not outcome.errors):
        raise ValueError("neither a report nor errors")
    if len(outcome.places) not in (0, len(outcome.to_repair)) or len(outcome.fixes) != len(outcome.places):
        raise ValueError("places of other findings")
    if outcome.report is not None:
        _require_tables(outcome.report)
        if any(_is_nothing(each.value) for each in outcome.report.quantities):
            raise ValueError("a quantity without a value")


def _is_nothing(value: Any) -> bool:
    """Whether a value is a list of nothing; an empty one is a value: no crank angle of zero speed, say."""
    return isinstance(value, list) and value != [] and all(item is None for item in value)


def _is_error(error: Diagnostic) -> bool:
    return error.severity == "error" and error.code.startswith("GL") and error.code[2:].isdecimal()


def _require_tables(report: Report) -> None:
    for table in report.tables:
        lengths = {len(column) for column in table.data}
        if not len(table.columns) == len(table.units) == len(table.data) or len(lengths) > 1:
            raise ValueError(f"table {table.name:.60} has columns of other lengths")
