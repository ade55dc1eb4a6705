"""What numbers a key takes, in words: the range of its model, within the sizes that a file may have at all."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Literal, get_args, get_origin

from gearlink.cli.reading.model_shapes import shapes_at

if TYPE_CHECKING:
    from pydantic import BaseModel

    from gearlink.cli.reading.loaded_file import KeyPath


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
