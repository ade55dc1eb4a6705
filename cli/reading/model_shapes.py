"""What a pydantic model allows at a key path: its keys, its range, whether true and false are welcome."""

from __future__ import annotations

import math
import re
import types
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, Literal, Union, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from gearlink.core.base.spec import Deferred, Entries, OfFollower

if TYPE_CHECKING:
    from gearlink.cli.reading.loaded_file import KeyPath


_MOST_KEYS = 12
Shape = tuple[Any, tuple[Any, ...]]
"""A type without unions around it, and the constraints that its annotations carry."""


@dataclass(frozen=True, slots=True)
class _Unit:
    """What a number is measured in, among its constraints."""

    name: str


@dataclass(frozen=True, slots=True)
class Stated:
    """A range that a validator of the model holds, among the constraints of a number."""

    ge: Any
    le: Any
    without: Any


def fields_at(model: type[BaseModel], path: KeyPath, data: Any) -> dict[str, FieldInfo]:
    """The keys that a section may have, by the name that a file writes."""
    shapes, section = shapes_at(model, path, data)
    return {
        name: field for shape, _ in shapes if _is_model(shape) and _fits(shape, section) for name, field in _keys(shape)
    }


def members_at(model: type[BaseModel], path: KeyPath, data: Any, tag: str) -> Iterator[tuple[type[BaseModel], Any]]:
    """The models that a section may have, each with the words of the key that tells them apart."""
    for shape, _ in shapes_at(model, path, data)[0]:
        if _is_model(shape) and tag in shape.model_fields:
            yield shape, get_args(shape.model_fields[tag].annotation)


def aliases_at(model: type[BaseModel], path: KeyPath, data: Any) -> dict[str, str]:
    """The standard terms that a section takes instead of the names of its keys, each with the name."""
    found = {}
    for name, field in fields_at(model, path, data).items():
        said = field.json_schema_extra
        if isinstance(said, dict):
            terms: Any = said.get("also", ())
            found.update(dict.fromkeys(terms, name))
    return found


def allowed_range(model: type[BaseModel], path: KeyPath, data: Any) -> str:
    """The range of a number that is bounded on both sides, or nothing."""
    low, high = _limits(model, path, data)
    return f"{low} {'' if high.startswith('to') else 'and '}{high}" if low and high else ""


def meaning_at(model: type[BaseModel], path: KeyPath, data: Any) -> str:
    """What a key is for: its words, its unit and limits, or the keys of a section; of an element those of its list.

    Example
        >>> from gearlink.core.machines.slider_crank.spec import SliderCrankSpec
        >>> meaning_at(SliderCrankSpec, ("rod",), {})
        'rod: connecting rod (mm, above 0)'
    """
    while path and isinstance(path[-1], int):
        path = path[:-1]
    name = str(path[-1]) if path else ""
    field = fields_at(model, path[:-1], data).get(name)
    if field is None:  # an entry whose name the user chose, or nothing that is known
        entry = bool(path[:-1]) and bool(shapes_at(model, path, data)[0])
        return "; ".join(filter(None, [meaning_at(model, path[:-1], data), _its_keys(model, path)])) if entry else ""
    unit = unit_at(model, path, data)
    limits = " ".join(filter(None, _limits(model, path, data)))
    number = ", ".join(filter(None, ["" if unit == "1" else unit, limits, _choices(model, path, data)]))
    words = (field.description or "").removesuffix(f" [{unit}]")
    words = f"{words} ({number})" if words and number else words or number
    text = "; ".join(filter(None, [words, _its_keys(model, path)]))
    begins = text.lower().startswith(name.replace("_", " "))  # "module: module; of helical gears ..."
    return text if begins or not text else f"{name}: {text}"


def _choices(model: type[BaseModel], path: KeyPath, data: Any) -> str:
    """The words of which a value is one; nothing where it may be another, or where they are many."""
    shapes = [shape for shape, _ in shapes_at(model, path, data)[0]]
    words = list(dict.fromkeys(word for shape in shapes for word in get_args(shape)))
    if any(get_origin(shape) is not Literal for shape in shapes) or not 1 <= len(words) <= _MOST_KEYS:
        return ""
    return " or ".join(filter(None, [", ".join(map(str, words[:-1])), str(words[-1])]))


def _its_keys(model: type[BaseModel], path: KeyPath) -> str:
    """The keys of a section or of the entries of a list, those that it needs first; nothing where a path holds none."""

    def listed(at: KeyPath) -> str:
        inner = fields_at(model, at, None)
        keys = sorted(inner, key=lambda key: not inner[key].is_required())
        return f"{', '.join(keys[:_MOST_KEYS])}{', ...' if len(keys) > _MOST_KEYS else ''}"

    section, entries = listed(path), listed((*path, 0))
    said = [f"the keys of an entry are {entries}"] if entries else []
    if section:
        said.append(f"those of a section are {section}" if said else f"its keys are {section}")
    return "; ".join(said)


def _limits(model: type[BaseModel], path: KeyPath, data: Any) -> tuple[str, str]:
    low = high = ""
    for _, constraints in shapes_at(model, path, data)[0]:
        for constraint in constraints:
            low = _limit(constraint, ("gt", "above"), ("ge", "from")) or low
            high = _limit(constraint, ("lt", "below"), ("le", "to")) or high
    return low, high


def unit_at(model: type[BaseModel], path: KeyPath, data: Any) -> str:
    """The unit of a number; empty where it has none, or one that another key names."""
    if own := entry_unit_at(model, path, data):
        return own
    said = [each for _, found in shapes_at(model, path, data)[0] for each in found]
    units = {each.name for each in said if isinstance(each, _Unit)}
    unit = units.pop() if len(units) == 1 else ""
    turning = next((each.turning for each in said if isinstance(each, OfFollower)), None)
    if turning is not None:
        unit = _of_follower(path, data, unit, turning)
    return "" if unit.startswith("the ") else _of_source(model, path, data, unit)


_SIZES_OF_A_SOURCE = ("plus_minus", "lower", "upper", "limits", "sigma", "mode", "measured")


def _of_source(model: type[BaseModel], path: KeyPath, data: Any, unit: str) -> str:
    """The unit of a key of `tolerance`: the size of a source has that of the key that the source names.

    A source that names a part, as `pins.A` and `centers.crank_idler` do, is in mm.
    """
    places = (i for i in range(len(path) - 3) if path[i : i + 2] == ("tolerance", "sources"))
    at = next(places, None)
    if at is None or path[at + 3] not in _SIZES_OF_A_SOURCE:
        return unit
    steps = tuple(int(step) if step.isdecimal() else step for step in re.findall(r"[^.\[\]]+", str(path[at + 2])))
    key = (*path[:at], *steps)
    if any(shape is float for shape, _ in shapes_at(model, key, data)[0]):
        return unit_at(model, key, data)
    return "" if steps[:1] == ("members",) else unit


def entry_unit_at(model: type[BaseModel], path: KeyPath, data: Any) -> str:
    """The unit that a list states for one of its entries alone, as a column of a table."""
    if not path or not isinstance(path[-1], int):
        return ""
    around = (each for _, found in shapes_at(model, path[:-1], data)[0] for each in found)
    return next((each.unit(path[-1]) for each in around if isinstance(each, Entries)), "")


def _of_follower(path: KeyPath, data: Any, sliding: str, turning: str) -> str:
    """The unit that goes with the follower of the nearest section around a path; empty where that is only a link."""
    found, node = None, data
    for step in path:
        if isinstance(node, dict) and "follower" in node:
            found = node["follower"]
        node = _child(node, step)
    if isinstance(found, dict):
        turns = str(found["type"]).startswith("oscillating") if "type" in found else "arm" in found
        return turning if turns else sliding
    return sliding if found is None else ""


def list_at(model: type[BaseModel], path: KeyPath, data: Any) -> tuple[int, str, str]:
    """Length of a list that has one, else 0; its entries with their unit; an example.

    Example
        >>> from gearlink.core.machines.gear_pair.spec import GearPairSpec
        >>> list_at(GearPairSpec, ("teeth",), {})
        (2, '[gear 1, gear 2]', '[25, 40]')
    """
    length, names, example = 0, "", ""
    for shape, constraints in shapes_at(model, path, data)[0]:
        origin: Any = get_origin(shape)
        if origin not in (list, tuple):
            continue
        least, most = (_only(constraints, name) for name in ("min_length", "max_length"))
        length = least if least == most and least is not None else 0
        for each in constraints:
            if isinstance(each, Entries):
                unit = unit_at(model, (*path, 0), data)
                of_all = "" if each.units or unit in ("", "1", "teeth") else f" in {unit}"
                names, example = each.names + of_all, each.example
    return length, names, example


def _only(constraints: Iterable[Any], name: str) -> Any:
    return next((getattr(each, name) for each in constraints if getattr(each, name, None) is not None), None)


def takes_truth_value(model: type[BaseModel], path: KeyPath, data: Any) -> bool:
    """Whether true and false mean something at a path; False only where a Literal of numbers would take them."""
    shapes = [shape for shape, _ in shapes_at(model, path, data)[0]]
    literals = [value for shape in shapes if get_origin(shape) is Literal for value in get_args(shape)]
    numbers = any(type(value) is int for value in literals)
    return not numbers or bool in shapes or Any in shapes or any(isinstance(value, bool) for value in literals)


def takes_no_number(model: type[BaseModel], path: KeyPath, data: Any) -> bool:
    """Whether a path is known and only words, sections or lists are welcome there."""
    shapes = [shape for shape, _ in shapes_at(model, path, data)[0]]
    literals = [value for shape in shapes if get_origin(shape) is Literal for value in get_args(shape)]
    if any(isinstance(value, (int, float)) for value in literals):
        return False
    return bool(shapes) and all(
        shape in (str, type(None)) or get_origin(shape) in (Literal, list, tuple, dict) or _is_model(shape)
        for shape in shapes
    )


def shapes_at(model: type[BaseModel], path: KeyPath, data: Any) -> tuple[list[Shape], Any]:
    """The types that a value at a path may have, and the data there."""
    shapes: list[Shape] = [(model, ())]
    for step in path:
        shapes = [inner for shape, said in shapes for inner in _inside(_meant(shape, said, data), step, data)]
        data = _child(data, step)
    return shapes, data


def _meant(shape: Any, said: Iterable[Any], section: Any) -> Any:
    """The model that a section is read by where its key chooses one by what the section says, as motion laws do."""
    chosen = (each.model_of(section) for each in said if hasattr(each, "model_of"))
    return next((model for model in chosen if model is not None), shape)


def _child(node: Any, step: str | int) -> Any:
    if isinstance(node, dict):
        return node.get(step)
    return node[step] if isinstance(node, list) and isinstance(step, int) and step < len(node) else None


def _inside(shape: Any, step: str | int, section: Any) -> Iterator[Shape]:
    """The shapes of a key of a section, or of an element of a list."""
    if _is_model(shape):
        if _fits(shape, section):
            for name, field in _keys(shape):
                if name == step:
                    yield from _flat(field.annotation, (*field.metadata, *_said(field)))
        return
    arguments = get_args(shape)
    if get_origin(shape) is dict and isinstance(step, str):
        yield from _flat(arguments[1])
    elif get_origin(shape) is tuple and isinstance(step, int) and arguments[-1:] != (...,):
        yield from _flat(arguments[step]) if step < len(arguments) else ()
    elif get_origin(shape) in (list, tuple) and isinstance(step, int):
        yield from _flat(arguments[0])


def _flat(annotation: Any, constraints: tuple[Any, ...] = ()) -> Iterator[Shape]:
    origin = get_origin(annotation)
    if annotation is Any and (deferred := next((each for each in constraints if isinstance(each, Deferred)), None)):
        yield from _flat(deferred.model(), tuple(each for each in constraints if each is not deferred))
    elif origin is Annotated:
        inner, *extra = get_args(annotation)
        yield from _flat(inner, constraints + tuple(_constraints(extra)))
    elif origin in (Union, types.UnionType):
        for member in get_args(annotation):
            yield from _flat(member, constraints)
    elif hasattr(annotation, "__value__"):
        yield from _flat(annotation.__value__, constraints)
    else:
        yield annotation, constraints


def _constraints(extra: Iterable[Any]) -> Iterator[Any]:
    for item in extra:
        if isinstance(item, FieldInfo):
            yield from item.metadata
            yield from _said(item)
        else:
            yield item


def _said(field: FieldInfo) -> Iterator[_Unit | Stated]:
    """What the JSON Schema says of a field beside its constraints, which a validator of its own then holds."""
    said = field.json_schema_extra
    if not isinstance(said, dict):
        return
    if isinstance(said.get("unit"), str):
        yield _Unit(str(said["unit"]))
    low, high, without = (said.get(name) for name in ("minimum", "maximum", "not"))
    if low is not None or high is not None or without is not None:
        yield Stated(low, high, without.get("const") if isinstance(without, dict) else None)


def _is_model(shape: Any) -> bool:
    return isinstance(shape, type) and issubclass(shape, BaseModel)


def _keys(model: type[BaseModel]) -> Iterator[tuple[str, FieldInfo]]:
    for name, field in model.model_fields.items():
        yield field.alias or name, field


def _fits(model: type[BaseModel], section: Any) -> bool:
    """Whether a section can be meant for this member of a union: its literal keys (`type: spring`) agree."""
    if not isinstance(section, dict):
        return True
    for name, field in _keys(model):
        if get_origin(field.annotation) is Literal and isinstance(section.get(name), str):
            values = get_args(field.annotation)
            if field.is_required() and len(values) == 1 and section[name] not in values:
                return False
    return True


def _as_given(value: Any) -> str:
    """A limit that is allowed as it is printed: 16777216, not 1.67772e+07, which is beyond it."""
    return f"{value:.15g}" if isinstance(value, (int, float)) else f"{value}"


def _limit(constraint: Any, *sides: tuple[str, str]) -> str:
    for attribute, word in sides:
        value = getattr(constraint, attribute, None)
        if value is not None:
            return f"{word} {_as_given(value)}"
    return ""


def allowed_numbers(model: type[BaseModel], path: KeyPath, data: Any, least: float, most: float) -> str:
    """The numbers that may stand at a key path; every number that is named may.

    Parameters
        minimum, most : float - sizes of numbers, 0 aside, that a file may hold
    Returns
        str - "from 1e-30 to 1e+12"; empty where nothing is known of the key
    """
    shapes: list[tuple[Any, tuple[Any, ...]]] = shapes_at(model, path, data)[0]
    numbers = [(shape, constraints) for shape, constraints in shapes if shape in (int, float)]
    broad = [constraints for shape, constraints in numbers if shape is float]  # a whole number is one of these
    words = [_words(*each, least, most) for each in numbers if each[0] is float or each[1] not in broad]
    for shape, _ in shapes:
        listed = get_args(shape) if get_origin(shape) is Literal else ()
        words += [str(each) for each in listed if isinstance(each, (int, float)) and not isinstance(each, bool)]
    if not words and any(shape is Any for shape, _ in shapes):
        return _words(float, (), least, most)
    return " or ".join(dict.fromkeys(words))


def _words(kind: Any, constraints: tuple[Any, ...], least: float, most: float) -> str:
    low, above = bound(constraints, ("ge", "gt"), max, -most)
    high, below = bound(constraints, ("le", "lt"), min, most)
    if kind is int:
        first = math.floor(low) + 1 if above else math.ceil(low)
        last = math.ceil(high) - 1 if below else math.floor(high)
        if first < 0 < last and any(getattr(each, "without", None) == 0 for each in constraints):
            return f"whole numbers from {first} to -1 or 1 to {last}"
        return f"whole numbers from {first} to {last}"
    if low == -most and high == most:
        return f"0, or {_plain(least)} to {_plain(most)} in size"
    ending = f"and below {_plain(high)}" if below else f"to {_plain(high)}"
    if high == 0.0:
        ending = f"to {_plain(-least)}" + ("" if below else ", or 0")
    if low == 0.0:
        return f"from {_plain(least)} {ending}" if above else f"0, or from {_plain(least)} {ending}"
    between = f", 0 or at least {_plain(least)} in size" if low < 0.0 < high else ""
    return f"{'above' if above else 'from'} {_plain(low)} {ending}{between}"


def bound(constraints: tuple[Any, ...], names: tuple[str, str], nearer: Any, end: float) -> tuple[float, bool]:
    """The narrower of the bounds of one side, and whether it is itself left out."""
    found = [(end, False)]
    for constraint in constraints:
        for name in names:
            value = getattr(constraint, name, None)
            if value is not None:
                found.append((value, name in ("gt", "lt")))
    bound = nearer(value for value, _ in found)
    return bound, any(out for value, out in found if value == bound)


def _plain(number: float) -> str:
    """A number to its last digit, in the shorter way: 1e+12, 16777216."""
    short = f"{number:g}"
    return short if float(short) == number else f"{number:.15g}"
