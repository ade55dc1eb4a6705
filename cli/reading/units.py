"""Units that people write behind the numbers of a design file, and how much each is in the unit of the key."""

from __future__ import annotations

import math

_EQUAL = 1.0
_DEGREES = math.degrees(1.0)
_FACTORS: dict[str, dict[str, float]] = {
    "mm": {"mm": 1, "cm": 10, "dm": 100, "m": 1000, "µm": 1e-3, "um": 1e-3, "in": 25.4, "inch": 25.4, '"': 25.4},
    "deg": {"deg": 1, "degree": 1, "degrees": 1, "°": 1, "rad": _DEGREES, "mrad": 1e-3 * _DEGREES, "'": 1 / 60},
    "1/min": {"1/min": 1, "rpm": 1, "rev/min": 1, "r/min": 1, "min^-1": 1, "1/s": 60, "Hz": 60, "rad/s": 30 / math.pi}
    | dict.fromkeys(("sheets/h", "sheet/h", "1/h", "/h"), 1 / 60),
    "sheets/h": {
        "sheets/h": 1,
        "rpm": 60,
        "rev/min": 60,
        "r/min": 60,
        "1/min": 60,
        "1/h": 1,
        "/h": 1,
        "sheets/min": 60,
    },
    "N": {"N": 1, "kN": 1000},
    "N m": {"Nm": 1, "kNm": 1000, "Nmm": 1e-3},
    "N/mm": {"N/mm": 1, "kN/m": 1, "N/m": 1e-3},
    "N/mm^2": {"N/mm^2": 1, "N/mm²": 1, "MPa": 1, "GPa": 1000},
    "kg": {"kg": 1, "g": 1e-3, "t": 1000},
    "kg m^2": {"kgm^2": 1, "kgm²": 1, "kgcm^2": 1e-4, "kgcm²": 1e-4, "kgmm^2": 1e-6, "kgmm²": 1e-6},
    "kW": {"kW": 1, "W": 1e-3},
    "Hz": {"Hz": 1, "1/s": 1, "kHz": 1000},
    "m/s^2": {"m/s^2": 1, "m/s²": 1, "mm/s^2": 1e-3},
    "h": {"h": 1, "min": 1 / 60},
    "s": {"s": 1, "ms": 1e-3},
    "ms": {"ms": 1, "s": 1000},
    "1": {"%": 0.01},
}


def without_unit(number: str, written: str, unit: str) -> str:
    """What to write in place of a number with a unit.

    Parameters
        number, written : str - as they stand in the file
        unit : str - of the key; empty where it is not known
    Example
        >>> without_unit("5", "cm", "mm"), without_unit("5", "deg", "mm")
        ('keys carry no unit, this one is in mm: write 50', 'keys carry no unit, this one is in mm')
        >>> without_unit("8000", "sheets/h", "1/min")
        'keys carry no unit, this one is in 1/min: write 133.3333333 (one sheet each turn)'
    """
    factors = _FACTORS.get(unit, {}) if unit else _own()
    factor = factors.get(written.replace(" ", ""))
    if factor == _EQUAL:
        return f"keys carry no unit: write {number}"
    where = "" if unit in ("", "1") else f", this one is in {unit}"
    if factor is None:
        return f"keys carry no unit{where}"
    turns = written in ("rpm", "rev/min", "r/min", "1/min") if unit == "sheets/h" else written.endswith("/h")
    each = " (one sheet each turn)" if turns and unit in ("1/min", "sheets/h") else ""
    return f"keys carry no unit{where}: write {float(number) * factor:.10g}{each}"


def _own() -> dict[str, float]:
    """The units that some key has."""
    return {name: factor for names in _FACTORS.values() for name, factor in names.items() if factor == _EQUAL}
