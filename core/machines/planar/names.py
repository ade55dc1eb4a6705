"""Names, units and words of the quantities of a planar mechanism, which follow the names of its file."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

from gearlink.core.mechanism import courses

if TYPE_CHECKING:
    from gearlink.core.machines.planar.outputs import Moved

GENERAL = (
    "degrees_of_freedom",
    "period_turns",
    "grashof",
    "min_transmission_angle",
    "min_transmission_angle_at",
    "free_range",
    "closure_error",
)
_SIDES = ("max", "max_at", "min", "min_at")
_RATES = {
    "link": ("angle", "speed_ratio", "acceleration_ratio", "jerk_ratio"),
    "line": ("position", "velocity_ratio", "acceleration_ratio", "jerk_ratio"),
}
_REAL = {"link": ("speed", "acceleration"), "line": ("velocity", "acceleration")}
_PER_TIME = {"link": ("rad/s", "rad/s^2"), "line": ("mm/s", "mm/s^2")}


class Meaning(NamedTuple):
    """What a quantity of an output is.

    Fields
        output : Moved - the number that it is of
        order : int - of the derivative
        side : "max", "max_at", "min", "min_at", or what else it is: "span", "turns", "path"
        timed : bool - in real time
        unit : str
    """

    output: Moved
    order: int
    side: str
    timed: bool
    unit: str


def meanings(parts: tuple[Moved, ...], name: str, per: str, *, timed: bool) -> Iterator[tuple[str, Meaning]]:
    """The quantities of an output of the file.

    Parameters
        parts : its numbers: one, or both coordinates of a point
        per : unit of the input, rad or mm
        timed : bool - whether the speed of the input is known
    """
    at = "deg" if per == "rad" else "mm"
    for part in parts:
        if part.sort in ("x", "y"):
            yield from ((f"{name}.{part.sort}_{side}", Meaning(part, 0, side, False, at if "at" in side else "mm"))
                        for side in _SIDES)  # fmt: skip
            continue
        for order, rate in enumerate(_RATES[part.sort]):
            unit = "deg" if (part.unit, order) == ("rad", 0) else courses.unit_of(part.unit, order, per)
            yield from ((f"{name}.{rate}_{side}", Meaning(part, order, side, False, at if "at" in side else unit))
                        for side in _SIDES)  # fmt: skip
            if order == 0:
                span = "swing" if part.sort == "link" else "stroke"
                yield f"{name}.{span}", Meaning(part, 0, "span", False, unit)
                if part.sort == "link":
                    yield f"{name}.turns", Meaning(part, 0, "turns", False, "1")
        if timed:
            for order, (rate, unit) in enumerate(zip(_REAL[part.sort], _PER_TIME[part.sort], strict=True), 1):
                yield from (
                    (f"{name}.{rate}_{side}", Meaning(part, order, side, True, unit)) for side in ("max", "min")
                )
    if len(parts) == 2:
        yield f"{name}.path_length", Meaning(parts[0], 0, "path", False, "mm")


def generic() -> tuple[str, ...]:
    """The names that an output may have, under one name for all."""
    found = [f"{name}_{side}" for sort in _RATES for name in _RATES[sort] for side in _SIDES]
    found += [f"{axis}_{side}" for axis in "xy" for side in _SIDES]
    found += ["swing", "turns", "stroke", "path_length"]
    found += [f"{name}_{side}" for sort in _REAL for name in _REAL[sort] for side in ("max", "min")]
    return tuple(f"output.{name}" for name in dict.fromkeys(found))


_WORDS = {
    "angle": "direction",
    "position": "place",
    "speed_ratio": "speed per input speed",
    "velocity_ratio": "velocity per input speed",
    "acceleration_ratio": "acceleration per square of the input speed",
    "jerk_ratio": "jerk per cube of the input speed",
    "speed": "speed",
    "velocity": "velocity",
    "acceleration": "acceleration",
}
_WHOLE = {
    "swing": "swing of {}",
    "stroke": "stroke of {}",
    "turns": "net turns of {} over the period",
    "path_length": "length of the path of {} over the period or range",
}


def words_of(name: str) -> str:
    """In words, what a quantity of an output is.

    Example
        >>> words_of("rocker.speed_ratio_max_at")
        'input of the greatest speed per input speed of rocker'
    """
    output, _, rest = name.partition(".")
    if rest in _WHOLE:
        return _WHOLE[rest].format(output)
    where, rest = ("input of the ", rest.removesuffix("_at")) if rest.endswith("_at") else ("", rest)
    what, _, side = rest.rpartition("_")
    return f"{where}{'greatest' if side == 'max' else 'least'} {_WORDS.get(what, what)} of {output}"
