"""Values with units: the text NUMBER UNIT at a key becomes a number in the key's unit, rounded once."""

from __future__ import annotations

import re
from collections.abc import Iterator
from difflib import get_close_matches
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from gearlink.cli.reading.yaml_reader import format_path

if TYPE_CHECKING:
    from pydantic import BaseModel

    from gearlink.cli.reading.diagnostics import Diagnostic
    from gearlink.cli.reading.loaded_file import KeyPath, LoadedFile

_PI = Fraction("3.14159265358979323846264338327950288419716939937510582")
_INCH, _FOOT = Fraction("25.4"), Fraction("304.8")  # mm
_POUND, _GRAVITY = Fraction("0.45359237"), Fraction("9.80665")  # kg, m/s^2
_LBF = _POUND * _GRAVITY  # N
_PSI = _LBF / _INCH**2  # N/mm^2
_RADIAN = 180 / _PI  # deg
_HORSEPOWER = 550 * _LBF * _FOOT / 10**6  # kW, of 550 lbf ft/s


def _f(text: str) -> Fraction:
    return Fraction(text)


_REVS = dict.fromkeys(("1/min", "rev/min", "rpm", "r/min", "min^-1"), _f("1"))
_COUNTED = ("sheets", "sheet", "prints", "impressions", "copies", "cycles", "strokes")
_HOURLY = ("1/h", "/h", *(f"{each}/h" for each in _COUNTED), "iph", "sph")
_MINUTELY = tuple(f"{each}/min" for each in _COUNTED)
UNITS: dict[str, dict[str, Fraction]] = {
    "mm": {"mm": _f("1"), "um": _f("0.001"), "µm": _f("0.001"), "cm": _f("10"), "dm": _f("100"), "m": _f("1000")}
    | dict.fromkeys(("in", "inch", '"'), _INCH)
    | {"ft": _FOOT, "thou": _INCH / 1000, "mil": _INCH / 1000},
    "deg": dict.fromkeys(("deg", "degree", "degrees", "°"), _f("1"))
    | {"rad": _RADIAN, "mrad": _RADIAN / 1000, "arcmin": _f("1/60"), "'": _f("1/60"), "arcsec": _f("1/3600")},
    "1/min": _REVS
    | {"1/s": _f("60"), "Hz": _f("60"), "rad/s": 30 / _PI, "deg/s": _f("1/6")}
    | dict.fromkeys(_HOURLY, _f("1/60"))
    | dict.fromkeys(_MINUTELY, _f("1")),
    "sheets/h": dict.fromkeys(_HOURLY, _f("1"))
    | dict.fromkeys((*_REVS, *_MINUTELY), _f("60"))
    | dict.fromkeys(("1/s", "Hz"), _f("3600")),
    "N": {"N": _f("1"), "kN": _f("1000"), "lbf": _LBF, "kgf": _GRAVITY},
    "N m": {"Nm": _f("1"), "kNm": _f("1000"), "Nmm": _f("0.001"), "kgfm": _GRAVITY}
    | {"lbfin": _LBF * _INCH / 1000, "lbfft": _LBF * _FOOT / 1000},
    "N/mm": {"N/mm": _f("1"), "kN/m": _f("1"), "N/m": _f("0.001"), "lbf/in": _LBF / _INCH},
    "N/mm^2": {"N/mm^2": _f("1"), "MPa": _f("1"), "GPa": _f("1000"), "kPa": _f("0.001"), "Pa": _f("0.000001")}
    | {"bar": _f("0.1"), "psi": _PSI, "ksi": 1000 * _PSI},
    "kg": {"kg": _f("1"), "g": _f("0.001"), "t": _f("1000"), "lb": _POUND},
    "kg m^2": {"kgm^2": _f("1"), "kgcm^2": _f("1e-4"), "kgmm^2": _f("1e-6"), "gcm^2": _f("1e-7")}
    | {"lbin^2": _POUND * _INCH**2 / 10**6, "lbft^2": _POUND * _FOOT**2 / 10**6, "lbfins^2": _LBF * _INCH / 1000},
    "kW": {"kW": _f("1"), "W": _f("0.001"), "hp": _HORSEPOWER, "PS": 75 * _GRAVITY / 1000},
    "Hz": {"Hz": _f("1"), "1/s": _f("1"), "kHz": _f("1000")},
    "m/s^2": {"m/s^2": _f("1"), "mm/s^2": _f("0.001"), "g0": _GRAVITY},
    "h": {"h": _f("1"), "min": _f("1/60")},
    "s": {"s": _f("1"), "ms": _f("0.001")},
    "ms": {"ms": _f("1"), "s": _f("1000")},
    "1": {"1": _f("1"), "%": _f("0.01")},
}
"""By the unit of a key, the units that may stand there, without blanks, and how much of it each is; exact."""

_WORDS = {
    "mm": "a length", "deg": "an angle", "1/min": "a speed", "sheets/h": "a speed", "N": "a force", "N m": "a torque",
    "N/mm": "a stiffness", "N/mm^2": "a pressure", "kg": "a mass", "kg m^2": "an inertia", "kW": "a power",
    "Hz": "a frequency", "m/s^2": "an acceleration", "h": "a time", "s": "a time", "ms": "a time", "1": "a share",
}  # fmt: skip
_NUMBER = r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?"
_VALUE = re.compile(rf"\s*({_NUMBER})\s*((?:1?/)?[a-zA-Zµ°%'\"][\w/^°%²· *-]*?)\s*", re.ASCII)
_PITCH = "DP"
_LONGEST = 100


def split(text: str) -> tuple[str, str] | None:
    """Number and unit of a text NUMBER UNIT, the unit without blanks and dots; None where it is none.

    Example
        >>> split("4.5 in"), split("12 N m"), split("x")
        (('4.5', 'in'), ('12', 'Nm'), None)
    """
    found = _VALUE.fullmatch(text) if len(text) <= _LONGEST else None
    return (found[1], _plain(found[2])) if found else None


def _plain(unit: str) -> str:
    return re.sub(r"[ ·*]", "", unit).replace("²", "^2")


def converted(number: str, written: str, unit: str, key: str = "") -> float | None:
    """A number with a unit in the unit of its key, rounded once; None where the unit does not belong there.

    Parameters
        number, written : str - as `split` gives them
        unit : str - of the key
        key : str - its last name: a diametral pitch goes with `module` alone
    Example
        >>> converted("4.5", "in", "mm"), converted("12", "DP", "mm", "module"), converted("5", "deg", "mm")
        (114.3, 2.1166666666666667, None)
        >>> converted("8000", "sheets/h", "1/min")
        133.33333333333334
    """
    value = Fraction(number)
    try:
        if written == _PITCH:
            return float(_INCH / value) if unit == "mm" and key == "module" and value else None
        factor = _factors(unit).get(written)
        return None if factor is None else float(value * factor)
    except OverflowError:
        return None


def _factors(unit: str) -> dict[str, Fraction]:
    return UNITS.get(unit) or {_plain(unit): Fraction(1)}


def wrong_unit(written: str, unit: str, key: str) -> tuple[str, str, str]:
    """Code, message and help for a unit that a key does not take.

    Example
        >>> wrong_unit("kg", "mm", "stroke")[:2]
        ('GL181', 'kg is a mass, stroke is in mm')
    """
    taken = list(_factors(unit))
    listed = f"allowed units: {', '.join(taken)}"
    if written == _PITCH:
        return "GL181", f"a diametral pitch applies only to module; {key} is in {unit}", listed
    others = [name for name, names in UNITS.items() if written in names]
    if others:
        return "GL181", f"{written} is {_WORDS[others[0]]}, {key} is {_measured(unit)}", listed
    near = ["deg"] if unit == "deg" and written.lower() == "grad" else get_close_matches(written, taken, 1, 0.5)
    listed = f"did you mean {near[0]}? {listed}" if near else listed
    return "GL180", f"no unit {written!r} for {key}, which is {_measured(unit)}", listed


def _measured(unit: str) -> str:
    return "a number without a unit" if unit == "1" else f"in {unit}"


def convert(loaded: LoadedFile, model: type[BaseModel]) -> list[Diagnostic]:
    """Put numbers instead of the values with units of a file; what is wrong with the others.

    Notes
        What stood in the file is kept in `loaded.as_written`, for `--save`.
    """
    found = [(path, text, parts) for path, text in _texts(loaded.data, ()) if (parts := split(text)) is not None]
    if not found:
        return []
    from gearlink.cli.reading.model_shapes import entry_unit_at, shapes_at, unit_at

    wrong: list[Diagnostic] = []
    for path, text, (number, written) in found:
        shapes = [shape for shape, _ in shapes_at(model, path, loaded.data)[0]]
        unit = unit_at(model, path, loaded.data)
        if float not in shapes or not unit or (str in shapes and not entry_unit_at(model, path, loaded.data)):
            continue
        name = next((str(step) for step in reversed(path) if isinstance(step, str)), "")
        value = converted(number, written, unit, name)
        if value is not None:
            loaded.data = _with(loaded.data, path, value)
            loaded.as_written = {**loaded.as_written, path: (text, value)}
        elif _is_unit(text):
            code, message, help = wrong_unit(written, unit, format_path(path))
            wrong.append(loaded.report(code, message, path, help=help))
    return wrong


def _is_unit(text: str) -> bool:
    """Whether what follows the number is meant as a unit, and not as a digit or an exponent."""
    from gearlink.cli.reading.model_errors import NO_UNIT, number_remedy

    return number_remedy(text).startswith(NO_UNIT)


def _texts(node: Any, path: KeyPath) -> Iterator[tuple[KeyPath, str]]:
    items = node.items() if isinstance(node, dict) else enumerate(node)
    for step, value in items:
        if isinstance(value, (dict, list)):
            yield from _texts(value, (*path, step))
        elif isinstance(value, str):
            yield (*path, step), value


def _with(node: Any, path: KeyPath, value: float) -> Any:
    """A copy of the data with one value put in; what is beside the path is shared."""
    if not path:
        return value
    step, rest = path[0], path[1:]
    if isinstance(step, int):
        return [*node[:step], _with(node[step], rest, value), *node[step + 1 :]]
    return {**node, step: _with(node[step], rest, value)}
