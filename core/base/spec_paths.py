"""Values of a spec by the dotted paths of the design file."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import Any

LEAST_SIZE, LARGEST_SIZE = 1e-30, 1e12
"""Between them the fourth powers of a number and of its ratios to others neither overflow nor vanish."""
_STEP = r"[^.\[\]]+"


def has_size(value: float) -> bool:
    """Whether a number can be one of a machine, so that a design file may hold it.

    Example
        >>> has_size(0), has_size(-40.5), has_size(6e14), has_size(float("nan"))
        (True, True, False, False)
    """
    return value == 0 or LEAST_SIZE <= abs(value) <= LARGEST_SIZE


def value_at(spec: Any, path: str) -> Any:
    """The value that a path leads to.

    Parameters
        spec : a spec, or anything with attributes; of a section whose keys the file chooses, as links are named, a dict
        path : str - such as `cam.roller_radius`
    Raises
        AttributeError, LookupError, TypeError - where it leads nowhere
    Example
        >>> from types import SimpleNamespace
        >>> value_at(SimpleNamespace(cam=SimpleNamespace(roller_radius=8.0)), "cam.roller_radius")
        8.0
    """
    for step in _steps(path):
        inside = isinstance(step, int) or isinstance(spec, dict)
        spec = spec[step] if inside else getattr(spec, _name_of(spec, str(step)))
    return spec


def _name_of(spec: Any, key: str) -> str:
    """The attribute of a key: its own name, but for words like `return` that Python keeps for itself."""
    fields = getattr(type(spec), "model_fields", {})
    return key if key in fields else next((name for name, field in fields.items() if field.alias == key), key)


_KEY_IN_TEXT = re.compile(r"(?<![\w.])(set )?([a-z]\w*(?:\[\d+\])?(?:\.[a-z]\w*(?:\[\d+\])?)*)")


def whole_paths(text: str, spec: Any, section: str) -> str:
    """A text in which the keys of a spec have their whole paths in a file where that spec stands in a section.

    Keys are recognized by a dot within them, or behind `set`.

    Example
        >>> from types import SimpleNamespace
        >>> class Spec:
        ...     model_fields = {"cam": SimpleNamespace(alias=None), "stroke": SimpleNamespace(alias=None)}
        >>> whole_paths("set stroke to 5, or reduce cam.offset of the cam", Spec(), "members.lift.design")
        'set members.lift.design.stroke to 5, or reduce members.lift.design.cam.offset of the cam'
    """
    keys = {field.alias or name for name, field in type(spec).model_fields.items()}

    def whole(found: re.Match[str]) -> str:
        before, path = found[1] or "", found[2]
        is_key = re.split(r"[.\[]", path)[0] in keys and ("." in path or bool(before))
        return f"{before}{section}.{path}" if is_key else found[0]

    return _KEY_IN_TEXT.sub(whole, text)


def replaced(spec: Any, path: str, value: Any) -> Any:
    """A copy of a spec with the value of one path changed; the spec itself stays as it is.

    Parameters
        spec : pydantic model
        path : str - such as `cam.roller_radius`
        value - not validated: it must be one that the spec allows
    """
    head, _, rest = path.partition(".")
    inner = replaced(getattr(spec, head), rest, value) if rest else value
    return spec.model_copy(update={head: inner})


def number_at(spec: Any, path: str) -> float | None:
    """The number that a path leads to; None where no number stands there.

    Example
        >>> from types import SimpleNamespace
        >>> spec = SimpleNamespace(teeth=[17, 40], cam=None)
        >>> number_at(spec, "teeth[1]"), number_at(spec, "cam.base_radius")
        (40, None)
    """
    value = given_at(spec, path)
    return value if isinstance(value, (int, float)) and not isinstance(value, bool) else None


def given_at(spec: Any, path: str) -> Any:
    """The value that a path leads to; None where it leads nowhere, as into a section that the file leaves out."""
    try:
        return value_at(spec, path)
    except (AttributeError, TypeError, LookupError):
        return None


def numbers_at(spec: Any, path: str) -> Iterator[str]:
    """The paths of the number, or of every number of the section or list, that a path leads to.

    Parameters
        spec : pydantic model
        path : str - such as `links`, or `links.frame`
    """
    try:
        value = value_at(spec, path)
    except (AttributeError, TypeError, LookupError):
        return
    if number_at(spec, path) is not None:
        yield path
    elif isinstance(value, (list, tuple)):
        for i in range(len(value)):
            yield from numbers_at(spec, f"{path}[{i}]")
    elif isinstance(value, dict):
        for name in value:
            if str(name).isidentifier():  # one with a dot is quoted in a path
                yield from numbers_at(spec, f"{path}.{name}")
    else:
        for name, field in getattr(type(value), "model_fields", {}).items():
            yield from numbers_at(spec, f"{path}.{field.alias or name}")


STEPS_BY_UNIT = {"1": 0.01, "deg": 0.5}


def step_of(spec: Any, path: str) -> float:
    """The step in which a number of a spec can be built: whole teeth, 0.1 mm, half a degree, 0.01 of a ratio."""
    if isinstance(number_at(spec, path), int):
        return 1.0
    return STEPS_BY_UNIT.get(unit_at(spec, path), 0.1)


def unit_at(spec: Any, path: str) -> str:
    """The unit of the key that a path leads to, "" where it says none."""
    from gearlink.core.base.spec import Entries, OfFollower

    head, _, last = path.rpartition(".")
    section = value_at(spec, head) if head else spec
    name, *places = _steps(last)
    field = getattr(type(section), "model_fields", {}).get(_name_of(section, str(name)))
    if field is None:
        return ""
    said = [*_said(field), *_said(field.annotation)]
    entries = [each.unit(int(places[-1])) for each in said if places and isinstance(each, Entries)]
    turning = [each.turning for each in said if isinstance(each, OfFollower) and _turns(spec, path)]
    return next(filter(None, [*entries, *turning]), "") or next(_units(said), "")


def _turns(spec: Any, path: str) -> bool:
    """Whether the follower of the nearest section around a path oscillates."""
    around = [spec, *(value_at(spec, path[: dot.start()]) for dot in re.finditer(r"\.", path))]
    followers = [getattr(section, "follower", None) for section in around]
    found = next((each for each in reversed(followers) if each is not None), None)
    return str(getattr(found, "type", "")).startswith("oscillating")


def _units(said: Iterable[Any]) -> Iterator[str]:
    extras = (getattr(each, "json_schema_extra", None) for each in said)
    return (str(extra["unit"]) for extra in extras if isinstance(extra, dict) and "unit" in extra)


def _said(part: Any) -> Iterator[Any]:
    """What a field or a type says of itself, the outermost first."""
    yield part
    for inner in (*getattr(part, "metadata", ()), *getattr(part, "__metadata__", ()), *getattr(part, "__args__", ())):
        yield from _said(inner)


def changed(spec: Any, values: Iterable[tuple[str, Any]]) -> Any:
    """A spec with other values at some paths, validated; None where the model or the reader of files refuses them.

    Parameters
        spec : pydantic model
        values : (path, value) pairs; None leaves the key out
    """
    data = spec.model_dump(exclude_unset=True, by_alias=True)
    for path, value in values:
        if isinstance(value, (int, float)) and not has_size(value):
            return None
        if value is None:
            _leave_out(data, path)
        else:
            put(data, path, list(value) if isinstance(value, tuple) else value)
    try:
        return type(spec).model_validate(data)
    except ValueError:
        return None


def put(data: Any, path: str, value: Any) -> None:
    """Set a value in the data of a design file; sections that are missing, or empty, are made.

    Raises
        LookupError, TypeError - where the path leads through something that is no section, or beyond a list
    Example
        >>> data = {"teeth": [17, 40]}
        >>> put(data, "teeth[1]", 41)
        >>> put(data, "limits.gear_gap", 0.5)
        >>> data
        {'teeth': [17, 41], 'limits': {'gear_gap': 0.5}}
    """
    *sections, last = _steps(path)
    for step in sections:
        if not isinstance(step, int) and data.setdefault(step, {}) is None:
            data[step] = {}
        data = data[step]
    data[last] = value


def _leave_out(data: Any, path: str) -> None:
    """Delete a key in the data of a design file, if it is there; an entry of a list becomes null."""
    *sections, last = _steps(path)
    for step in sections:
        data = data[step] if isinstance(step, int) else data.get(step, {})
    if isinstance(last, int):
        data[last] = None
    else:
        data.pop(last, None)


def part_at(data: Any, path: str) -> Any:
    """What stands at a path in the data of a design file; None where nothing does, all of it for an empty path."""
    for step in _steps(path):
        data = data.get(step) if isinstance(data, dict) else None
    return data


def _steps(path: str) -> list[str | int]:
    return [int(step) if step.isdecimal() else step for step in re.findall(_STEP, path)]
