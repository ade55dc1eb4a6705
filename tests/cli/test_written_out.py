"""A key that is written as null, or as its default, asks for what the file asks for that leaves it out."""

from __future__ import annotations

import copy
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from factory import DESIGNS, each_kind, worked
from pydantic import BaseModel, ValidationError

from gearlink.core.base.kinds import KINDS

_ASKS = {"gear", "analyze"}
"""What a default that is written out may ask for besides: the gears, or the motion, that it is a key of."""

FOUND: dict[tuple[str, tuple[str | int, ...]], str] = {
    ("rated_pair", ("load", "factors", "face_contact")): "face load factor",
    ("rated_pair", ("material",)): "rating computes the factors",
    ("rated_pair", ("material", "contact_factors")): "rating computes the factors",
    ("rated_pair", ("material", "bending_factors")): "rating computes the factors",
    ("slider_crank_quick_return", ("offset",)): "found for quick_return_ratio",
}
"""What the file has computed by another key: its default, written, would say something else, and is refused."""


def left_out(spec: BaseModel, path: tuple[str | int, ...] = ()) -> Iterator[tuple[tuple[str | int, ...], Any]]:
    """Every key that the file leaves out, with its default as a file would hold it."""
    for name, field in type(spec).model_fields.items():
        key, value = (*path, field.alias or name), getattr(spec, name)
        if name not in spec.model_fields_set and key != ("name",):
            yield key, value.model_dump(mode="json", by_alias=True) if isinstance(value, BaseModel) else value
        parts: Any = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
        for step, part in [*parts, *([((), value)] if isinstance(value, BaseModel) else [])]:
            if isinstance(part, BaseModel):
                yield from left_out(part, key if step == () else (*key, step))


def written(data: Any, path: tuple[str | int, ...], value: Any) -> Any:
    found = place = copy.deepcopy(data)
    for step in path[:-1]:
        place = place[step] if isinstance(step, int) else place.setdefault(step, {})
    place[path[-1]] = value
    return found


@pytest.mark.parametrize("file", each_kind(sorted(DESIGNS.glob("*.yaml"))), ids=lambda file: file.stem)
def test_keys_that_are_left_out_may_be_written(file: Path) -> None:
    data = worked(file.stem)
    model = KINDS[data["kind"]].spec_model()
    spec = model.model_validate(data)
    keys = list(left_out(spec))
    assert keys
    for path, value in keys:
        if words := FOUND.get((file.stem, path)):
            with pytest.raises(ValidationError, match=rf"(?s){words}.*omit"):
                model.model_validate(written(data, path, value))
            continue
        again = model.model_validate(written(data, path, value))
        assert again.model_dump() == spec.model_dump(), path
        more = set(again.commands()) - set(spec.commands())
        assert more <= (set() if value is None else _ASKS), path


def test_null_asks_for_no_more_than_nothing() -> None:
    """Neither gears of a drawing nor the motion of a slider-crank is computed for the name of a key alone."""
    for base, path in (("candy_feed", ("gears", "profile_shift")), ("ty460_slider_crank", ("input_speed",))):
        data = worked(base)
        model = KINDS[data["kind"]].spec_model()
        commands = [model.model_validate(each).commands() for each in (data, written(data, path, None))]
        assert commands[0] == commands[1], path
